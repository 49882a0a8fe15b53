!> The drive of a cavitated film: its slopes. The table of drives: jumps between cells, both ends of T, and that neither
!> the order of visits nor a table that was full changes a bit. That films are right is for test_film_accuracy.
program test_cavitation_table
   use kinds, only: wp, degree
   use text, only: to_text
   use pad_gap, only: pad_gap_type
   use dimensionless_pad, only: dimensionless_pad_type, new_dimensionless_pad
   use effective_velocity, only: effective_velocity_type, drive_type, new_effective_velocity
   use cell_polynomials, only: simd_width
   use cell_index, only: interval, lower_end
   use cavitation_table, only: cavitation_table_type, new_cavitation_table
   use check, only: runs, expect, expect_close, between, report
   use film_solver, only: film_counters
   implicit none (type, external)

   real(wp), parameter :: half_arc = 35*degree, tolerance = 1e-4_wp
   !> Thicknesses at the edges, and T.
   real(wp), parameter :: films(3, 4) = reshape([0.8_wp, 0.4_wp, 0.15_wp, 0.5_wp, 0.9_wp, 0.4_wp, &
      & 0.3_wp, 0.3_wp, 0.7_wp, 1.5_wp, 0.2_wp, 0.3_wp], [3, 4])
   !> Most cells and nodes of a table.
   integer, parameter :: most = 20000
   type(dimensionless_pad_type) :: pad
   type(film_counters) :: counters
   integer :: i

   associate (gap => pad_gap_type(0.0_wp, 1.0_wp, 2.0_wp, half_arc, half_arc, 0.0_wp, 0.0_wp, 0.0_wp))
      pad = new_dimensionless_pad(gap)
   end associate
   do i = 1, size(films, 2)
      if (runs('slopes')) call slopes(.false., films(:2, i), films(3, i))
      if (runs('slopes')) call slopes(.true., films(:2, i), films(3, i))
      if (runs('rim')) call rim(films(:2, i), films(3, i))
   end do
   if (runs('closed')) call closed(.false.)
   if (runs('closed')) call closed(.true.)
   if (runs('between_cells')) call between_cells()
   if (runs('both_ends')) call both_ends(.false.)
   if (runs('both_ends')) call both_ends(.true.)
   if (runs('full_table')) call full_table(.false.)
   if (runs('full_table')) call full_table(.true.)
   call report()

contains

   !> Slopes against central differences over 0.02: of cells that cavitate one by one the differences keep the noise,
   !> some of the tolerance over the step; measured over the force at onset, as in the table.
   subroutine slopes(gumbel, edges, t)
      logical, intent(in) :: gumbel
      real(wp), intent(in) :: edges(2), t
      real(wp), parameter :: step = 0.02_wp
      type(effective_velocity_type) :: solver
      type(drive_type) :: drive, ahead, back, shorter_ahead, shorter_back
      real(wp) :: shift(3), difference(2), shorter(2)
      integer :: k
      solver = new_effective_velocity(pad, gumbel, 0.1_wp*tolerance)
      associate (w_2 => pad%tangent*(1 - 2*t))
         drive = solver%at(edges, w_2)
         do k = 1, 3
            shift = 0
            shift(k) = step*merge(minval(edges), pad%tangent, k < 3)
            ahead = solver%at(edges + shift(:2), w_2 + shift(3))
            back = solver%at(edges - shift(:2), w_2 - shift(3))
            difference = (ahead%value - back%value)/(2*shift(k))
            shorter_ahead = solver%at(edges + 0.5_wp*shift(:2), w_2 + 0.5_wp*shift(3))
            shorter_back = solver%at(edges - 0.5_wp*shift(:2), w_2 - 0.5_wp*shift(3))
            shorter = (shorter_ahead%value - shorter_back%value)/shift(k)
            ! the error of the longer difference is 4/3 of how far the two are apart, and the noise comes to it
            call expect_close(norm2(matmul(drive%weight, drive%slopes(:, k) - (4*shorter - difference)/3))*shift(k), &
               & 0.0_wp, 0.5_wp*tolerance, 'slope '//to_text(k)//merge(' gumbel  ', ' reynolds', gumbel)//' T = ' &
               & //to_text(t))
         end do
      end associate
   end subroutine slopes

   !> Slopes fall with the square of the cells like forces: extrapolated ones of 12 rows are within 4e-4 of those of 48,
   !> over the force at onset. Without the end of the film between the cells they are up to 5e-3 apart.
   subroutine rim(edges, t)
      real(wp), intent(in) :: edges(2), t
      type(effective_velocity_type) :: solver
      type(drive_type) :: drive, finer
      integer :: k
      solver = new_effective_velocity(pad, .false., 1.8e-5_wp)
      drive = solver%at(edges, pad%tangent*(1 - 2*t))
      solver = new_effective_velocity(pad, .false., 1.1e-6_wp)
      finer = solver%at(edges, pad%tangent*(1 - 2*t))
      do k = 1, 3
         call expect_close(norm2(matmul(finer%weight, drive%slopes(:, k) - finer%slopes(:, k))) &
            & *merge(edges(min(k, 2)), pad%tangent, k < 3), 0.0_wp, 5e-4_wp, 'slope '//to_text(k)//', T = '//to_text(t))
      end do
   end subroutine rim

   !> A film that closes between its edges has none.
   subroutine closed(gumbel)
      logical, intent(in) :: gumbel
      type(effective_velocity_type) :: solver
      type(drive_type) :: drive
      solver = new_effective_velocity(pad, gumbel, tolerance)
      drive = solver%at([0.1_wp, 0.1_wp], 0.0_wp)
      call expect(.not. drive%ok, 'a closed film')
   end subroutine closed

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
      table = new_cavitation_table(pad, .true., tolerance, most)
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
         call table%look_up(place(:2), place(3), .true., last, counters, value, slope, good)
         call table%look_up(below(:2), below(3), .true., last, counters, value_below, slope, good)
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
      table = new_cavitation_table(pad, gumbel, tolerance, most)
      last = 0
      do k = 1, 2
         call table%look_up([0.8_wp, 0.4_wp], next_to_0(k), .true., last, counters, value, slope, good)
         call expect(good, 'there is a cell')
         call expect_close(norm2(value(:2)), 0.0_wp, 1e-12_wp, 'w at T = 0')
         call expect_close(norm2(slope(:2, :)), 0.0_wp, tolerance, 'and its slopes, to an error''s')
         call expect_close(value(3), 1.0_wp, 1e-12_wp, 'the pressure is that of the full film')
         call table%look_up([0.8_wp, 0.4_wp], next_to_1(k), .true., last, counters, value, slope, good)
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
      type(film_counters) :: again
      real(wp) :: places(3, n), value(simd_width, n), slope(simd_width, 3, n), value_there(simd_width), &
         & slope_there(simd_width, 3)
      integer :: k, last, different
      logical :: good
      places = reshape([(random_place(), k=1, n)], [3, n])
      table = new_cavitation_table(pad, gumbel, tolerance, most)
      counters = film_counters()
      last = 0
      do k = 1, n
         call table%look_up(places(:2, k), places(3, k), .true., last, counters, value(:, k), slope(:, :, k), good)
      end do
      other = new_cavitation_table(pad, gumbel, tolerance, 20)
      last = 0
      different = 0
      do k = n, 1, -1
         call other%look_up(places(:2, k), places(3, k), .true., last, again, value_there, slope_there, good)
         if (any(abs(value_there - value(:, k)) > 0)) different = different + 1
         if (any(abs(slope_there - slope(:, :, k)) > 0)) different = different + 1
      end do
      call expect(different == 0, to_text(different)//' of '//to_text(n)//' are others')
      call expect(again%nodes > counters%nodes, 'nodes are built again')
   end subroutine full_table
end program test_cavitation_table
