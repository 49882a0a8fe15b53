!> The full film of a dimensionless pad: force = S M w, with a symmetric M of three functions of the film thicknesses at
!> both edges (docs/theory/film.md); the highest pressure, over S, of the film that is just full, a fourth; and the
!> force of a second load: of a pressure 1 at the leading edge, or, over S, of what drives uneven oil besides w
!> (uneven_drive). Here all are solved where they are asked for, the forces with exact
!> derivatives; full_film_table interpolates them.
module full_film
   use kinds, only: wp
   use film_solver, only: film_motion, film_response, film_counters, film_ok
   use dimensionless_pad, only: dimensionless_pad_type, unit_oil, thickness_scale
   use fourier_film, only: fourier_film_type, converged_film
   use uneven_drive, only: uneven_drive_type
   use cell_polynomials, only: simd_width
   implicit none (type, external)
   private
   public :: full_film_type, new_full_film, loads

   !> Loads of a film: the velocity w; a pressure at the leading edge, or the drive D of uneven oil.
   integer, parameter :: loads = 2
   !> Error of what is solved over the tolerance.
   real(wp), parameter :: share_of_nodes = 0.3_wp

   type :: full_film_type
      type(dimensionless_pad_type) :: pad
      type(uneven_drive_type) :: drive
      !> Whether there is a pressure at the leading edge.
      logical :: supplied = .false.
      !> Without pressure around the pad, and, where there is one, with a pressure 1 at its leading edge.
      type(fourier_film_type) :: film, supplied_film
   contains
      procedure :: look_up
      procedure :: highest_pressure
   end type full_film_type

contains

   !> The full films of a pad with its drive, with a pressure at its leading edge (of even oil) or without, to a
   !> tolerance over the norm of M.
   function new_full_film(pad, drive, supplied, tolerance) result(films)
      type(dimensionless_pad_type), intent(in) :: pad
      type(uneven_drive_type), intent(in) :: drive
      logical, intent(in) :: supplied
      real(wp), intent(in) :: tolerance
      type(full_film_type) :: films
      films%pad = pad
      films%drive = drive
      films%supplied = supplied
      films%film = converged_film(drive%gap, .false., share_of_nodes*tolerance)
      if (supplied) films%supplied_film = converged_film(pad%gap(1.0_wp), .false., share_of_nodes*tolerance)
   end function new_full_film

   !> By load the functions M_11, M_12, M_22 and the highest pressure at w = (1, tan(half the arc)), both over S; and,
   !> where there is a pressure at the leading edge, the force (along, outward, 0, 0) of a pressure 1 there; of uneven
   !> oil that of D at t = 1, over S. If they are
   !> wanted, derivatives of the forces over both thicknesses, (function, edge, load). For an open film with these
   !> thicknesses at its edges. `last` is the caller's memory of the place in a table, 0 at first. `good` is false where
   !> the film has no solution.
   subroutine look_up(self, edges, want_slopes, last, counters, value, slope, good)
      class(full_film_type), intent(inout) :: self
      real(wp), intent(in) :: edges(2)
      logical, intent(in) :: want_slopes
      integer, intent(inout) :: last
      type(film_counters), intent(inout) :: counters
      real(wp), intent(out) :: value(simd_width, loads), slope(simd_width, 2, loads)
      logical, intent(out) :: good
      type(film_response) :: along, onset, still
      integer :: i
      associate (pad => self%pad, position => self%pad%position(edges), drive => self%drive, &
         & scale => self%drive%force_unit*thickness_scale(edges(1), edges(2)))
         call self%film%evaluate_pad(1, film_motion(position, [1.0_wp, 0.0_wp]), drive%oil, 0.0_wp, want_slopes, along)
         call self%film%evaluate_pad(1, film_motion(position, [1.0_wp, pad%tangent]), drive%oil, 0.0_wp, want_slopes, &
            & onset)
         if (self%supplied) call self%supplied_film%evaluate_pad(1, film_motion(position), unit_oil, 0.0_wp, &
            & want_slopes, still)
         if (drive%acts) call self%film%evaluate_pad(1, film_motion(position, drive%still(position)), drive%oil, &
            & drive%speed_unit, want_slopes, still)
         good = along%status == film_ok
         value(:, 1) = symmetric(along%force, (onset%force - along%force)/pad%tangent)/scale
         value(4, 1) = onset%max_pressure/(drive%pressure_unit*scale/drive%force_unit)
         value(:, 2) = [still%force, 0.0_wp, 0.0_wp]
         if (drive%acts) value(:, 2) = value(:, 2)/scale
         slope = 0
         if (.not. want_slopes) return
         associate (of_along => over_edges(pad, along), of_onset => over_edges(pad, onset))
            do i = 1, 2
               slope(:, i, 1) = symmetric(of_along(:, i), (of_onset(:, i) - of_along(:, i))/pad%tangent)/scale &
                  & + 1.5_wp*value(:, 1)/edges(i)
            end do
         end associate
         if (drive%acts) then
            ! w = 0 in every place
            still%derivatives(:, :2) = still%derivatives(:, :2) - matmul(still%derivatives(:, 3:), drive%by_rotation())
            slope(:2, :, 2) = over_edges(pad, still)/scale
            do i = 1, 2
               slope(:2, i, 2) = slope(:2, i, 2) + 1.5_wp*value(:2, 2)/edges(i)
            end do
         else
            slope(:2, :, 2) = over_edges(pad, still)
         end if
      end associate
   end subroutine look_up

   !> The highest pressure in the middle plane, or 0, where the film is open and has these thicknesses at its edges, for
   !> w and a pressure at the leading edge or, of uneven oil, t. `last` as in `look_up`.
   subroutine highest_pressure(self, edges, w, load, last, counters, pressure)
      class(full_film_type), intent(inout) :: self
      real(wp), intent(in) :: edges(2), w(2), load
      integer, intent(inout) :: last
      type(film_counters), intent(inout) :: counters
      real(wp), intent(out) :: pressure
      type(film_response) :: film
      associate (position => self%pad%position(edges), drive => self%drive)
         if (drive%acts) then
            call self%film%evaluate_pad(1, film_motion(position, w + load*drive%still(position)), drive%oil, &
               & load*drive%speed_unit, .false., film)
            pressure = film%max_pressure/drive%pressure_unit
         else if (abs(load) > 0) then
            ! that of a pressure 1 at the leading edge, scaled
            call self%supplied_film%evaluate_pad(1, film_motion(position, w/load), unit_oil, 0.0_wp, .false., film)
            pressure = max(load*film%max_pressure, load*film%min_pressure)
         else
            call self%film%evaluate_pad(1, film_motion(position, w), unit_oil, 0.0_wp, .false., film)
            pressure = film%max_pressure
         end if
      end associate
   end subroutine highest_pressure

   !> M_11, M_12, M_22, 0 from the columns of M, which is symmetric by reciprocity; what the discretisation adds is
   !> shared.
   pure function symmetric(along, outward) result(m)
      real(wp), intent(in) :: along(2), outward(2)
      real(wp) :: m(simd_width)
      m = [along(1), 0.5_wp*(along(2) + outward(1)), outward(2), 0.0_wp]
   end function symmetric

   !> Derivatives of a force over the thicknesses at both edges, (component, edge).
   pure function over_edges(pad, film) result(slopes)
      type(dimensionless_pad_type), intent(in) :: pad
      type(film_response), intent(in) :: film
      real(wp) :: slopes(2, 2)
      slopes(1, :) = pad%over_edges(film%derivatives(1, :2))
      slopes(2, :) = pad%over_edges(film%derivatives(2, :2))
   end function over_edges
end module full_film
