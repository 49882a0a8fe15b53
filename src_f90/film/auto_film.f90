!> Axial modes while the film is whole, over-relaxation for a pad at an instant where it ruptures.
module auto_film
   use kinds, only: wp
   use film_solver, only: film_solver_type, film_motion, film_response, film_ok
   use pad_film, only: pad_film_type
   use modal_film, only: modal_film_type, new_modal_film
   use sor_film, only: sor_film_type, sor_options, new_sor_film
   implicit none (type, external)
   private
   public :: auto_film_type, new_auto_film

   !> How far below the cavitation pressure the whole film may fall, over its highest pressure, before it
   !> counts as ruptured: the force left out is of the second order in it, below the discretisation error.
   real(wp), parameter :: slight_tension = 1e-3_wp

   type, extends(film_solver_type) :: auto_film_type
      private
      real(wp), allocatable :: cavitation_pressure(:)
      type(modal_film_type) :: modal
      type(sor_film_type) :: sor
   contains
      procedure :: evaluate
   end type auto_film_type

contains

   !> Both solvers for the same films: cells along the arc and modes of the one, options of the other.
   pure function new_auto_film(films, cells, modes, options) result(solver)
      type(pad_film_type), intent(in) :: films(:)
      integer, intent(in) :: cells, modes
      type(sor_options), intent(in) :: options
      type(auto_film_type) :: solver
      solver%cavitation_pressure = films%cavitation_pressure
      solver%modal = new_modal_film(films, cells, modes, .false.)
      solver%sor = new_sor_film(films, options)
   end function new_auto_film

   subroutine evaluate(self, motion, speed, want_slopes, response)
      class(auto_film_type), intent(inout) :: self
      type(film_motion), intent(in) :: motion(:)
      real(wp), intent(in) :: speed
      logical, intent(in) :: want_slopes
      type(film_response), intent(out) :: response(:)
      real(wp) :: depth
      integer :: i
      call self%modal%evaluate(motion, speed, want_slopes, response)
      do i = 1, size(motion)
         if (response(i)%status /= film_ok) cycle
         depth = slight_tension*(response(i)%max_pressure - self%cavitation_pressure(i))
         if (response(i)%min_pressure < self%cavitation_pressure(i) - depth) then
            call self%sor%evaluate_pad(i, motion(i), speed, want_slopes, response(i))
         else
            self%counters%modal = self%counters%modal + 1
         end if
      end do
      self%counters%sor = self%sor%counters%sor
      self%counters%sweeps = self%sor%counters%sweeps
   end subroutine evaluate
end module auto_film
