!> The table of full films: jumps between cells, and that neither the order of visits nor a table that was full changes
!> a bit. That its films are right is for test_table_film and test_film_accuracy.
program test_full_film_table
   use kinds, only: wp, degree
   use text, only: to_text
   use film_solver, only: film_counters
   use pad_gap, only: pad_gap_type
   use dimensionless_pad, only: dimensionless_pad_type, new_dimensionless_pad
   use cell_polynomials, only: simd_width
   use cell_index, only: interval, lower_end
   use full_film_table, only: full_film_table_type, new_full_film_table
   use check, only: runs, expect, between, report
   use full_film, only: loads
   implicit none (type, external)

   real(wp), parameter :: half_arc = 35*degree, tolerance = 1e-5_wp
   !> Most cells of a table.
   integer, parameter :: most = 4000
   type(dimensionless_pad_type) :: pad
   type(film_counters) :: counters

   associate (gap => pad_gap_type(0.0_wp, 1.0_wp, 2.0_wp, half_arc, half_arc, 0.0_wp, 0.0_wp, 0.0_wp))
      pad = new_dimensionless_pad(gap)
   end associate
   if (runs('between_cells')) call between_cells()
   if (runs('full_table')) call full_table()
   call report()

contains

   !> Thicknesses of any size that leave the film open: 0.05 thick at least.
   function random_edges() result(edges)
      real(wp) :: edges(2)
      do
         edges = [0.1_wp*15**between(0.0_wp, 1.0_wp), 0.1_wp*15**between(0.0_wp, 1.0_wp)]
         if (minval(edges) > 0 .and. norm2(pad%position(edges)) < 0.95_wp) exit
      end do
   end function random_edges

   !> On both sides of an end of a cell the values are the same to twice the error. The slope of a polynomial of degree
   !> n is up to n^2 times its values over half a cell, which is an eighth of the thickness or more (Markov).
   subroutine between_cells()
      type(full_film_table_type) :: table
      real(wp) :: edges(2), below(2), worst, worst_slope
      real(wp), dimension(simd_width, loads) :: value, value_below
      real(wp), dimension(simd_width, 2, loads) :: slope, slope_below
      integer :: trial, last, axis
      logical :: good
      table = new_full_film_table(pad, .false., tolerance, most)
      last = 0
      worst = 0
      worst_slope = 0
      do trial = 1, 40
         edges = random_edges()
         axis = 1 + mod(trial, 2)
         edges(axis) = lower_end(interval(edges(axis), 1) + 1, 1)
         if (norm2(pad%position(edges)) > 0.95_wp) cycle
         below = edges
         below(axis) = nearest(edges(axis), -1.0_wp)
         call table%look_up(edges, .true., last, counters, value, slope, good)
         call table%look_up(below, .true., last, counters, value_below, slope_below, good)
         worst = max(worst, norm2(value(:, 1) - value_below(:, 1))/norm2(value(:, 1)))
         do axis = 1, 2
            worst_slope = max(worst_slope, edges(axis)*norm2(slope(:, axis, 1) - slope_below(:, axis, 1)) &
               & /norm2(value(:, 1)))
         end do
      end do
      call expect(worst > 0, 'there are ends of cells')
      call expect(worst < 10*tolerance, 'values jump by '//to_text(worst))
      call expect(worst_slope < 2*25*8*tolerance, 'slopes jump by '//to_text(worst_slope))
   end subroutine between_cells

   !> Values, slopes and pressures of a table that is visited in another order and has room for 3 cells alone.
   subroutine full_table()
      integer, parameter :: n = 40
      type(full_film_table_type) :: table, other
      type(film_counters) :: again
      real(wp) :: edges(2, n), value(simd_width, loads, n), slope(simd_width, 2, loads, n)
      real(wp) :: value_there(simd_width, loads), slope_there(simd_width, 2, loads), pressure(n), pressure_there, w(2)
      integer :: k, last, different
      logical :: good(n), good_there
      w = [1.0_wp, 0.5_wp]
      edges = reshape([(random_edges(), k=1, n)], [2, n])
      edges(:, n) = [0.05_wp, 0.9_wp]
      table = new_full_film_table(pad, .true., tolerance, most)
      counters = film_counters()
      last = 0
      do k = 1, n
         call table%look_up(edges(:, k), .true., last, counters, value(:, :, k), slope(:, :, :, k), good(k))
         call table%highest_pressure(edges(:, k), w, 0.1_wp, last, counters, pressure(k), good(k))
      end do
      other = new_full_film_table(pad, .true., tolerance, 3)
      last = 0
      different = 0
      do k = n, 1, -1
         call other%look_up(edges(:, k), .true., last, again, value_there, slope_there, good_there)
         if (any(abs(value_there - value(:, :, k)) > 0)) different = different + 1
         if (any(abs(slope_there - slope(:, :, :, k)) > 0)) different = different + 1
         call other%highest_pressure(edges(:, k), w, 0.1_wp, last, again, pressure_there, good_there)
         if (abs(pressure_there - pressure(k)) > 0) different = different + 1
         if (good(k) .neqv. good_there) different = different + 1
      end do
      call expect(different == 0, to_text(different)//' of '//to_text(n)//' are others')
      call expect(again%cells > counters%cells, 'cells are built again')
   end subroutine full_table
end program test_full_film_table
