!> The table of cavitated films: jumps between cells, both ends of T, and that neither the order of visits nor a table
!> that was full changes a bit. That its films are right is for test_film_accuracy.
program test_cavitation_table
   use kinds, only: wp, degree
   use text, only: to_text
   use pad_gap, only: pad_gap_type
   use dimensionless_pad, only: dimensionless_pad_type, new_dimensionless_pad
   use effective_velocity, only: effective_velocity_type, drive_type, new_effective_velocity
   use cubic_patch, only: simd_width
   use logarithmic_grid, only: interval, lower_end
   use cavitation_table, only: cavitation_table_type, new_cavitation_table
   use check, only: runs, expect, expect_close, between, report
   implicit none (type, external)

   real(wp), parameter :: half_arc = 35*degree, tolerance = 1e-4_wp
   type(dimensionless_pad_type) :: pad

   associate (gap => pad_gap_type(0.0_wp, 1.0_wp, 2.0_wp, half_arc, half_arc, 0.0_wp, 0.0_wp, 0.0_wp))
      pad = new_dimensionless_pad(gap)
   end associate
   if (runs('between_cells')) call between_cells()
   if (runs('both_ends')) call both_ends(.false.)
   if (runs('both_ends')) call both_ends(.true.)
   if (runs('full_table')) call full_table(.false.)
   if (runs('full_table')) call full_table(.true.)
   call report()

contains

   !> Thicknesses and T of an orbit's size: few cells.
   function random_place() result(place)
      real(wp) :: place(3)
      place = [between(0.3_wp, 0.9_wp), between(0.2_wp, 0.9_wp), between(0.0_wp, 1.0_wp)]
   end function random_place

   !> Cells of the same level meet to rounding; where one of them is cut they differ by the error of either.
   subroutine between_cells()
      type(cavitation_table_type) :: table
      type(effective_velocity_type) :: solver
      type(drive_type) :: drive
      real(wp) :: place(3), below(3), jump, worst
      real(wp), dimension(simd_width) :: value, value_below
      real(wp) :: slope(simd_width, 3)
      integer :: trial, last, axis, meet
      logical :: good
      table = new_cavitation_table(pad, .true., tolerance)
      solver = new_effective_velocity(pad, .true., tolerance)
      last = 0
      meet = 0
      worst = 0
      do trial = 1, 30
         place = random_place()
         axis = 1 + mod(trial, 3)
         if (axis < 3) place(axis) = lower_end(interval(place(axis), 1) + 1, 1)
         if (axis == 3) place(axis) = ceiling(8*place(3))/8.0_wp - 0.125_wp
         if (.not. place(3) > 0) cycle
         below = place
         below(axis) = nearest(place(axis), -1.0_wp)
         call table%look_up(place(:2), place(3), .true., last, value, slope, good)
         call table%look_up(below(:2), below(3), .true., last, value_below, slope, good)
         drive = solver%at(place(:2), pad%tangent*(1 - 2*place(3)))
         jump = norm2(matmul(drive%weight, value(:2) - value_below(:2)))
         if (jump < 1e-12_wp) meet = meet + 1
         worst = max(worst, jump)
      end do
      call expect(meet > 10, to_text(meet)//' cells meet')
      call expect(worst < 2*tolerance, 'the others differ by '//to_text(worst))
   end subroutine between_cells

   !> At T next to 0 the drive is w, next to 1 and at 1 it is nothing.
   subroutine both_ends(gumbel)
      logical, intent(in) :: gumbel
      type(cavitation_table_type) :: table
      real(wp) :: value(simd_width), slope(simd_width, 3)
      real(wp), parameter :: next_to_0(2) = [epsilon(1.0_wp), tiny(1.0_wp)], next_to_1(2) = [nearest(1.0_wp, &
         & -1.0_wp), 1.0_wp]
      integer :: last, k
      logical :: good
      table = new_cavitation_table(pad, gumbel, tolerance)
      last = 0
      do k = 1, 2
         call table%look_up([0.8_wp, 0.4_wp], next_to_0(k), .true., last, value, slope, good)
         call expect(good, 'there is a cell')
         call expect_close(norm2(value(:2)), 0.0_wp, 1e-12_wp, 'w at T = 0')
         call expect_close(norm2(slope(:2, :)), 0.0_wp, tolerance, 'and its slopes, to an error''s')
         call expect_close(value(3), 1.0_wp, 1e-12_wp, 'the pressure is that of the full film')
         call table%look_up([0.8_wp, 0.4_wp], next_to_1(k), .true., last, value, slope, good)
         call expect(good, 'there is a cell')
         call expect_close(norm2([1.0_wp, -pad%tangent] + value(:2)), 0.0_wp, 1e-12_wp, 'nothing at T = 1')
         call expect_close(value(3), 0.0_wp, 1e-12_wp, 'and no pressure')
      end do
   end subroutine both_ends

   !> Values and slopes of a table that is visited in another order and has room for 20 nodes alone.
   subroutine full_table(gumbel)
      logical, intent(in) :: gumbel
      integer, parameter :: n = 12
      type(cavitation_table_type) :: table, other
      real(wp) :: places(3, n), value(simd_width, n), slope(simd_width, 3, n), value_there(simd_width), &
         & slope_there(simd_width, 3)
      integer :: k, last, different
      logical :: good
      places = reshape([(random_place(), k=1, n)], [3, n])
      table = new_cavitation_table(pad, gumbel, tolerance)
      last = 0
      do k = 1, n
         call table%look_up(places(:2, k), places(3, k), .true., last, value(:, k), slope(:, :, k), good)
      end do
      other = new_cavitation_table(pad, gumbel, tolerance, 20)
      last = 0
      different = 0
      do k = n, 1, -1
         call other%look_up(places(:2, k), places(3, k), .true., last, value_there, slope_there, good)
         if (any(abs(value_there - value(:, k)) > 0)) different = different + 1
         if (any(abs(slope_there - slope(:, :, k)) > 0)) different = different + 1
      end do
      call expect(different == 0, to_text(different)//' of '//to_text(n)//' are others')
      call expect(other%built_nodes > table%built_nodes, 'nodes are built again')
   end subroutine full_table
end program test_cavitation_table
