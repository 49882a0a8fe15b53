!> The motion itself as the way to rest: without unbalance and friction it ends where a stable equilibrium is.
module motion_to_rest
   use kinds, only: wp, pi
   use errors, only: error_type, asked_to_stop, asked
   use cvode_integrator, only: integrator_type, integrator_options
   use equations_of_motion, only: bearing_model
   implicit none (type, external)
   private
   public :: march_to_rest

   !> Loose tolerances, as only the end counts; when to give up, in steps and revolutions.
   real(wp), parameter :: tolerance = 1e-4_wp
   integer, parameter :: max_steps = 1000
   real(wp), parameter :: revolutions = 200
   !> Velocities at rest, in scales of the positions per radian of the shaft.
   real(wp), parameter :: slow = 1e-4_wp

contains

   !> Marches y until it is nearly at rest; `ok` is false where it does not come to rest.
   subroutine march_to_rest(model, y, ok, give_up)
      type(bearing_model), intent(inout), target :: model
      real(wp), intent(inout) :: y(:)
      logical, intent(out) :: ok
      procedure(asked_to_stop), optional :: give_up
      type(integrator_type) :: integrator
      type(integrator_options) :: options
      type(error_type), allocatable :: error
      integer :: steps
      real(wp) :: rates(model%n), end
      ok = .false.
      options%relative_tolerance = tolerance
      options%absolute_tolerance = tolerance*model%scale
      options%derivatives_age = 2
      options%keeps_outputs = .false.
      end = revolutions*2*pi/model%point%speed(0.0_wp)
      call integrator%start(model, options, 0.0_wp, y, end, error)
      do steps = 1, max_steps
         if (allocated(error)) return
         if (asked(give_up) .or. integrator%time() >= end) return
         call integrator%step(error)
         if (allocated(error)) return
         y = integrator%state()
         call model%rhs(integrator%time(), y, rates, ok)
         if (.not. ok) return
         associate (x => model%layout%positions(), v => model%layout%rates())
            ok = maxval(abs(y(v)/model%scale(x))) < slow*model%point%speed(0.0_wp) &
               & .and. maxval(abs(rates(v)/model%scale(x))) < slow*model%point%speed(0.0_wp)**2
            if (ok) y(v) = 0
         end associate
         if (ok) return
      end do
      ok = .false.
   end subroutine march_to_rest
end module motion_to_rest
