!> The full film of a dimensionless pad: force = S M w, with a symmetric M of three functions of the film thicknesses at
!> both edges (docs/theory/film.md), and that of a pressure 1 at the leading edge. Here both are solved where
!> they are asked for, with exact derivatives; full_film_table interpolates them.
module full_film
   use kinds, only: wp, i8
   use film_solver, only: film_motion, film_response, film_ok
   use dimensionless_pad, only: dimensionless_pad_type, unit_oil, thickness_scale
   use fourier_film, only: fourier_film_type, converged_film
   use square_patch, only: simd_width
   implicit none (type, external)
   private
   public :: full_film_type, solved_full_film_type, new_solved_full_film

   !> Error of what is solved over the tolerance.
   real(wp), parameter :: share_of_nodes = 0.1_wp

   type, abstract :: full_film_type
      !> Cells of a table built ever, and the time it took, s.
      integer(i8) :: built = 0
      real(wp) :: seconds = 0
   contains
      procedure(look_up_driven), deferred :: look_up
      procedure(look_up_supplied), deferred :: look_up_supply
      procedure(look_up_pressure), deferred :: highest_pressure
   end type full_film_type

   abstract interface
      !> M_11, M_12, M_22, 0 and, if they are wanted, their derivatives over both thicknesses, (function, edge), of an
      !> open film with these thicknesses at its edges. `last` is the caller's memory of the place in a table, 0 at
      !> first. `good` is false where the functions are not as close as they should be: next to a film that closes.
      subroutine look_up_driven(self, edges, want_slopes, last, value, slope, good)
         import :: full_film_type, wp, simd_width
         class(full_film_type), intent(inout) :: self
         real(wp), intent(in) :: edges(2)
         logical, intent(in) :: want_slopes
         integer, intent(inout) :: last
         real(wp), intent(out) :: value(simd_width), slope(simd_width, 2)
         logical, intent(out) :: good
      end subroutine look_up_driven

      !> The same for the force, (along, outward, 0, 0), of a pressure 1 at the leading edge.
      subroutine look_up_supplied(self, edges, want_slopes, last, value, slope)
         import :: full_film_type, wp, simd_width
         class(full_film_type), intent(inout) :: self
         real(wp), intent(in) :: edges(2)
         logical, intent(in) :: want_slopes
         integer, intent(inout) :: last
         real(wp), intent(out) :: value(simd_width), slope(simd_width, 2)
      end subroutine look_up_supplied

      !> The highest pressure in the middle plane, or 0, where the film is open and has these thicknesses at its edges,
      !> for w and a pressure at the leading edge.
      subroutine look_up_pressure(self, edges, w, supply, last, pressure, good)
         import :: full_film_type, wp
         class(full_film_type), intent(inout) :: self
         real(wp), intent(in) :: edges(2), w(2), supply
         integer, intent(inout) :: last
         real(wp), intent(out) :: pressure
         logical, intent(out) :: good
      end subroutine look_up_pressure
   end interface

   type, extends(full_film_type) :: solved_full_film_type
      type(dimensionless_pad_type), private :: pad
      !> Without pressure around the pad, and with a pressure 1 at its leading edge.
      type(fourier_film_type) :: film, supplied_film
   contains
      procedure :: look_up
      procedure :: look_up_supply
      procedure :: highest_pressure
   end type solved_full_film_type

contains

   !> The full films of a pad, closer than a tolerance over the norm of M.
   function new_solved_full_film(pad, tolerance) result(films)
      type(dimensionless_pad_type), intent(in) :: pad
      real(wp), intent(in) :: tolerance
      type(solved_full_film_type) :: films
      films%pad = pad
      films%film = converged_film(pad%gap(0.0_wp), .false., share_of_nodes*tolerance)
      films%supplied_film = converged_film(pad%gap(1.0_wp), .false., share_of_nodes*tolerance)
   end function new_solved_full_film

   !> From the columns of M; `last` stays.
   subroutine look_up(self, edges, want_slopes, last, value, slope, good)
      class(solved_full_film_type), intent(inout) :: self
      real(wp), intent(in) :: edges(2)
      logical, intent(in) :: want_slopes
      integer, intent(inout) :: last
      real(wp), intent(out) :: value(simd_width), slope(simd_width, 2)
      logical, intent(out) :: good
      type(film_response), dimension(1) :: along, outward
      integer :: i
      call self%film%evaluate([film_motion(self%pad%position(edges), [1.0_wp, 0.0_wp])], [unit_oil], &
         & 0.0_wp, want_slopes, along)
      call self%film%evaluate([film_motion(self%pad%position(edges), [0.0_wp, 1.0_wp])], [unit_oil], &
         & 0.0_wp, want_slopes, outward)
      good = along(1)%status == film_ok
      value = symmetric(along(1)%force, outward(1)%force)/thickness_scale(edges(1), edges(2))
      slope = 0
      if (.not. want_slopes) return
      associate (of_along => over_edges(self%pad, along(1)), of_outward => over_edges(self%pad, outward(1)))
         do i = 1, 2
            slope(:, i) = symmetric(of_along(:, i), of_outward(:, i))/thickness_scale(edges(1), edges(2)) &
               & + 1.5_wp*value/edges(i)
         end do
      end associate
   end subroutine look_up

   subroutine look_up_supply(self, edges, want_slopes, last, value, slope)
      class(solved_full_film_type), intent(inout) :: self
      real(wp), intent(in) :: edges(2)
      logical, intent(in) :: want_slopes
      integer, intent(inout) :: last
      real(wp), intent(out) :: value(simd_width), slope(simd_width, 2)
      type(film_response) :: still(1)
      call self%supplied_film%evaluate([film_motion(self%pad%position(edges))], [unit_oil], 0.0_wp, want_slopes, still)
      value = [still(1)%force, 0.0_wp, 0.0_wp]
      slope = 0
      if (want_slopes) slope(:2, :) = over_edges(self%pad, still(1))
   end subroutine look_up_supply

   !> That of a pressure 1 at the leading edge, scaled.
   subroutine highest_pressure(self, edges, w, supply, last, pressure, good)
      class(solved_full_film_type), intent(inout) :: self
      real(wp), intent(in) :: edges(2), w(2), supply
      integer, intent(inout) :: last
      real(wp), intent(out) :: pressure
      logical, intent(out) :: good
      type(film_response) :: film(1)
      if (abs(supply) > 0) then
         call self%supplied_film%evaluate([film_motion(self%pad%position(edges), w/supply)], [unit_oil], &
            & 0.0_wp, .false., film)
         pressure = max(supply*film(1)%max_pressure, supply*film(1)%min_pressure)
      else
         call self%film%evaluate([film_motion(self%pad%position(edges), w)], [unit_oil], 0.0_wp, .false., film)
         pressure = film(1)%max_pressure
      end if
      good = film(1)%status == film_ok
   end subroutine highest_pressure

   !> M_11, M_12, M_22, 0 from the columns of M, which is symmetric by reciprocity; what the discretisation adds to that
   !> is shared.
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
