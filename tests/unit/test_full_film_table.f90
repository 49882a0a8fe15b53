!> The table of full films: against finer modes at two tolerances, jumps between cells, and that neither the order of
!> visits nor a table that was full changes a bit.
program test_full_film_table
   use kinds, only: wp, degree
   use text, only: to_text
   use film_solver, only: film_motion, film_response
   use pad_gap, only: pad_gap_type
   use dimensionless_pad, only: unit_oil, dimensionless_pad_type, new_dimensionless_pad, thickness_scale
   use fourier_film, only: fourier_film_type, new_fourier_film
   use square_patch, only: simd_width
   use logarithmic_grid, only: interval, lower_end
   use full_film_table, only: full_film_table_type, new_full_film_table
   use check, only: runs, expect, between, report
   implicit none (type, external)

   real(wp), parameter :: half_arc = 35*degree, tolerance = 1e-5_wp
   type(dimensionless_pad_type) :: pad
   type(fourier_film_type) :: fine, fine_supplied

   associate (gap => pad_gap_type(0.0_wp, 1.0_wp, 2.0_wp, half_arc, half_arc, 0.0_wp, 0.0_wp, 0.0_wp))
      pad = new_dimensionless_pad(gap)
   end associate
   fine = new_fourier_film([pad%gap(0.0_wp)], 96, 32, .false., 1e-7_wp)
   fine_supplied = new_fourier_film([pad%gap(1.0_wp)], 96, 32, .false., 1e-7_wp)
   if (runs('against_modes')) call against_modes(1e-3_wp)
   if (runs('against_modes')) call against_modes(tolerance)
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

   !> M_11, M_12, M_22, and the force of a pressure at the leading edge, by fine modes.
   subroutine exact(edges, driven, supplied)
      real(wp), intent(in) :: edges(2)
      real(wp), intent(out) :: driven(3), supplied(2)
      type(film_response) :: along(1), outward(1), still(1)
      associate (position => pad%position(edges))
         call fine%evaluate([film_motion(position, [1.0_wp, 0.0_wp])], [unit_oil], 0.0_wp, .false., along)
         call fine%evaluate([film_motion(position, [0.0_wp, 1.0_wp])], [unit_oil], 0.0_wp, .false., outward)
         call fine_supplied%evaluate([film_motion(position)], [unit_oil], 0.0_wp, .false., still)
      end associate
      driven = [along(1)%force, outward(1)%force(2)]/thickness_scale(edges(1), edges(2))
      supplied = still(1)%force
   end subroutine exact

   !> The tolerance holds at a cell's corners and middle; elsewhere the polynomials err by a few times that at most.
   subroutine against_modes(tolerance)
      real(wp), intent(in) :: tolerance
      type(full_film_table_type) :: table
      real(wp) :: edges(2), driven(3), supplied(2), value(simd_width), slope(simd_width, 2), worst, worst_supplied
      integer :: trial, last
      logical :: good
      table = new_full_film_table(pad, .true., tolerance)
      last = 0
      worst = 0
      worst_supplied = 0
      do trial = 1, 60
         edges = random_edges()
         call exact(edges, driven, supplied)
         call table%look_up(edges, .true., last, value, slope, good)
         call expect(good, 'a film that is open')
         worst = max(worst, norm2(value(1:3) - driven)/norm2(driven))
         call table%look_up_supply(edges, .true., last, value, slope)
         worst_supplied = max(worst_supplied, norm2(value(1:2) - supplied)/norm2(supplied))
      end do
      call expect(worst < 5*tolerance, 'driven, error '//to_text(worst))
      ! the modes of a pressure that jumps at the corners of the pad converge slowly, by themselves
      call expect(worst_supplied < max(5*tolerance, 1e-4_wp), 'supplied, error '//to_text(worst_supplied))
   end subroutine against_modes

   !> On both sides of an end of a cell the values are the same to twice the error. The slope of a polynomial of degree
   !> n is up to n^2 times its values over half a cell, which is an eighth of the thickness or more (Markov).
   subroutine between_cells()
      type(full_film_table_type) :: table
      real(wp) :: edges(2), below(2), worst, worst_slope
      real(wp), dimension(simd_width) :: value, value_below
      real(wp), dimension(simd_width, 2) :: slope, slope_below
      integer :: trial, last, axis
      logical :: good
      table = new_full_film_table(pad, .false., tolerance)
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
         call table%look_up(edges, .true., last, value, slope, good)
         call table%look_up(below, .true., last, value_below, slope_below, good)
         worst = max(worst, norm2(value - value_below)/norm2(value))
         do axis = 1, 2
            worst_slope = max(worst_slope, edges(axis)*norm2(slope(:, axis) - slope_below(:, axis))/norm2(value))
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
      real(wp) :: edges(2, n), value(simd_width, n), slope(simd_width, 2, n), pressure(n)
      real(wp) :: value_there(simd_width), slope_there(simd_width, 2), pressure_there, w(2)
      integer :: k, last, different
      logical :: good(n), good_there
      w = [1.0_wp, 0.5_wp]
      edges = reshape([(random_edges(), k=1, n)], [2, n])
      edges(:, n) = [0.05_wp, 0.9_wp]
      table = new_full_film_table(pad, .true., tolerance)
      last = 0
      do k = 1, n
         call table%look_up(edges(:, k), .true., last, value(:, k), slope(:, :, k), good(k))
         call table%highest_pressure(edges(:, k), w, 0.1_wp, last, pressure(k), good(k))
      end do
      other = new_full_film_table(pad, .true., tolerance, 3)
      last = 0
      different = 0
      do k = n, 1, -1
         call other%look_up(edges(:, k), .true., last, value_there, slope_there, good_there)
         if (any(abs(value_there - value(:, k)) > 0)) different = different + 1
         if (any(abs(slope_there - slope(:, :, k)) > 0)) different = different + 1
         call other%highest_pressure(edges(:, k), w, 0.1_wp, last, pressure_there, good_there)
         if (abs(pressure_there - pressure(k)) > 0) different = different + 1
         if (good(k) .neqv. good_there) different = different + 1
      end do
      call expect(different == 0, to_text(different)//' of '//to_text(n)//' are others')
      call expect(other%built > table%built, 'cells are built again')
   end subroutine full_table
end program test_full_film_table
