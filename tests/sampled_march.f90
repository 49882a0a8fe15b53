!> States of a model's motion at even times.
module sampled_march
   use kinds, only: wp, i8
   use errors, only: error_type
   use ode_model, only: ode_model_type, integrator_counts_type
   use cvode_integrator, only: integrator_type, integrator_options
   use check, only: expect_no_error
   implicit none (type, external)
   private
   public :: march_samples

contains

   !> Marches from y at t = 0 with these tolerances of the states' scales; states(:, k) is the one at
   !> first + (k - 1) interval.
   subroutine march_samples(model, scale, tolerances, y, first, interval, states, steps)
      class(ode_model_type), intent(inout), target :: model
      real(wp), intent(in) :: scale(:), tolerances(2), y(:), first, interval
      real(wp), intent(out) :: states(:, :)
      integer(i8), intent(out), optional :: steps
      type(integrator_type) :: integrator
      type(integrator_options) :: options
      type(integrator_counts_type) :: counts
      type(error_type), allocatable :: error
      real(wp) :: values(model%n + model%outputs)
      integer :: k
      options%relative_tolerance = tolerances(1)
      options%absolute_tolerance = tolerances(2)*scale
      call integrator%start(model, options, 0.0_wp, y, first + (size(states, 2) - 1)*interval, error)
      k = 1
      do while (.not. allocated(error) .and. k <= size(states, 2))
         call integrator%step(error)
         do while (k <= size(states, 2))
            if (first + (k - 1)*interval > integrator%time()) exit
            call integrator%interpolate(first + (k - 1)*interval, values)
            states(:, k) = values(:size(states, 1))
            k = k + 1
         end do
      end do
      call expect_no_error(error, 'the march ends well')
      counts = integrator%counts()
      if (present(steps)) steps = counts%steps
   end subroutine march_samples
end module sampled_march
