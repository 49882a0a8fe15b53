!> The table of full films: against finer modes, slopes, jumps between cells, closing films, and that neither the order
!> of visits nor a table that was full changes a bit.
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
   use check, only: runs, expect, expect_close, between, report
   implicit none (type, external)

   real(wp), parameter :: half_arc = 35*degree, tolerance = 1e-5_wp
   type(dimensionless_pad_type) :: pad
   type(fourier_film_type) :: fine, fine_supplied
   integer :: i

   associate (gap => pad_gap_type(0.0_wp, 1.0_wp, 2.0_wp, half_arc, half_arc, 0.0_wp, 0.0_wp, 0.0_wp))
      pad = new_dimensionless_pad(gap)
   end associate
   fine = new_fourier_film([pad%gap(0.0_wp)], 96, 32, .false., 1e-7_wp)
   fine_supplied = new_fourier_film([pad%gap(1.0_wp)], 96, 32, .false., 1e-7_wp)
   if (runs('against_modes')) call against_modes()
   if (runs('slopes')) call slopes()
   if (runs('between_cells')) call between_cells()
   if (runs('closing_films')) call closing_films()
   if (runs('order_of_visits')) call same_bits(.false.)
   if (runs('full_table')) call same_bits(.true.)
   if (runs('highest_pressure')) then
      do i = 1, 20
         call highest_pressure(0.0_wp)
         call highest_pressure(0.02_wp)
      end do
   end if
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
   subroutine against_modes()
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
      call expect(worst_supplied < 1e-4_wp, 'supplied, error '//to_text(worst_supplied))
   end subroutine against_modes

   !> Slopes are those of the polynomials: against differences over 1e-5 of the thickness.
   subroutine slopes()
      type(full_film_table_type) :: table
      real(wp) :: edges(2), shift(2), error
      real(wp), dimension(simd_width) :: value, ahead, back
      real(wp), dimension(simd_width, 2) :: slope, slope_of_supply, unused
      integer :: trial, last, axis
      logical :: good
      table = new_full_film_table(pad, .true., tolerance)
      last = 0
      error = 0
      do trial = 1, 10
         ! not at an end of a cell
         edges = [between(0.2_wp, 1.0_wp), between(0.2_wp, 1.0_wp)]
         edges = lower_end(interval(edges, 6), 6) + 1e-3_wp
         call table%look_up(edges, .true., last, value, slope, good)
         call table%look_up_supply(edges, .true., last, value, slope_of_supply)
         do axis = 1, 2
            shift = 0
            shift(axis) = 1e-5_wp*edges(axis)
            call table%look_up(edges + shift, .true., last, ahead, unused, good)
            call table%look_up(edges - shift, .true., last, back, unused, good)
            error = max(error, norm2((ahead - back)/(2*shift(axis)) - slope(:, axis))/norm2(slope))
            call table%look_up_supply(edges + shift, .true., last, ahead, unused)
            call table%look_up_supply(edges - shift, .true., last, back, unused)
            error = max(error, norm2((ahead - back)/(2*shift(axis)) - slope_of_supply(:, axis))/norm2(slope_of_supply))
         end do
      end do
      call expect_close(error, 0.0_wp, 1e-6_wp, 'slopes')
   end subroutine slopes

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

   !> Towards a film that closes, in the middle or at an edge, down to 1e-4 of the clearance, what is called good errs
   !> by no more than the solver that would stand in, 1e-4.
   subroutine closing_films()
      type(full_film_table_type) :: table
      real(wp) :: edges(2), driven(3), supplied(2), value(simd_width), slope(simd_width, 2), worst, h
      integer :: k, last, found
      logical :: good
      table = new_full_film_table(pad, .false., tolerance)
      last = 0
      worst = 0
      found = 0
      do k = 1, 8
         h = 0.1_wp**(0.5_wp*k)
         edges = [1 - (1 - h)*pad%cosine, 1 - (1 - h)*pad%cosine]
         if (mod(k, 2) == 0) edges = [1.0_wp, h]
         call table%look_up(edges, .true., last, value, slope, good)
         if (.not. good) cycle
         found = found + 1
         call exact(edges, driven, supplied)
         worst = max(worst, norm2(value(1:3) - driven)/norm2(driven))
      end do
      call expect(found >= 4, to_text(found)//' of 8 films are in the table')
      call expect(worst < 1e-4_wp, 'error '//to_text(worst))
   end subroutine closing_films

   !> Values, slopes and pressures of a table that is visited in another order, or that has room for 3 cells alone.
   subroutine same_bits(full)
      logical, intent(in) :: full
      integer, parameter :: n = 16
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
      other = new_full_film_table(pad, .true., tolerance)
      if (full) other = new_full_film_table(pad, .true., tolerance, 3)
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
      if (full) call expect(other%built > table%built, 'cells are built again')
      if (.not. full) call expect(other%built == table%built, 'the same cells are built')
   end subroutine same_bits

   !> Against the pressures of fine modes at 200 places; between two of them a parabola rises by a part of 1e-4 at most.
   subroutine highest_pressure(supply)
      real(wp), intent(in) :: supply
      integer, parameter :: n = 200
      type(full_film_table_type), save :: tables(2)
      type(fourier_film_type) :: film
      real(wp) :: edges(2), w(2), phi(n, 1), pressure(1, n, 1), found, onset(1, n, 1)
      integer :: last, k, t
      logical :: good
      t = merge(2, 1, supply > 0)
      if (tables(t)%built == 0) tables(t) = new_full_film_table(pad, supply > 0, tolerance)
      edges = random_edges()
      w = [between(-1.0_wp, 1.0_wp), between(-1.0_wp, 1.0_wp)]
      last = 0
      call tables(t)%highest_pressure(edges, w, supply/minval(edges)**2, last, found, good)
      call expect(good, 'a film that is open')
      film = new_fourier_film([pad%gap(supply/minval(edges)**2)], 48, 16, .false., 1e-6_wp)
      phi(:, 1) = [((2*k - 1.0_wp - n)/n*half_arc, k=1, n)]
      call film%field([film_motion(pad%position(edges), w)], [unit_oil], 0.0_wp, phi, [0.0_wp], pressure)
      ! over that of the same film squeezed as fast
      call film%field([film_motion(pad%position(edges), norm2(w)*[0.0_wp, 1.0_wp])], [unit_oil], 0.0_wp, phi, &
         & [0.0_wp], onset)
      call expect_close(found/maxval(onset), max(0.0_wp, supply/minval(edges)**2, maxval(pressure))/maxval(onset), &
         & 5e-3_wp, 'highest pressure')
   end subroutine highest_pressure
end program test_full_film_table
