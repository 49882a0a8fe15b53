!> How a bearing is marched: the tolerances of its input, and what its pivots and its light modes ask for.
module march_settings
   use kinds, only: wp, i8, pi
   use marching, only: march_options
   use equations_of_motion, only: bearing_model
   use static_model, only: make_static
   use small_vibrations, only: has_light_modes
   implicit none (type, external)
   private
   public :: march_settings_of

   !> Steps after which the derivatives are taken anew without friction: the motion is smooth, the steps are long.
   integer, parameter :: smooth_derivatives_age = 2
   !> Absolute tolerances of rigid pivots over those of pivots that yield: without their damping the errors of the steps
   !> live longer.
   real(wp), parameter :: rigid_tolerance = 0.3_wp
   !> And with friction over those without: what its moment errs by is above what the states do.
   real(wp), parameter :: friction_tolerance = 0.5_wp

   !> Steps in a revolution from which on low orders are tried.
   real(wp), parameter :: many_steps = 1000

contains

   !> Those of a model after so many steps; where no state is given in which its modes are looked at, orders stay.
   type(march_options) function march_settings_of(model, steps, y) result(options)
      type(bearing_model), intent(in) :: model
      integer(i8), intent(in) :: steps
      real(wp), intent(in), optional :: y(:)
      type(bearing_model) :: static
      associate (integration => model%scene%integration)
         options%relative_tolerance = integration%relative_tolerance
         options%absolute_tolerance = integration%relative_tolerance*integration%tolerance_scale*model%scale
         options%max_step = integration%max_step
         options%max_steps = integration%max_steps - steps
         options%short_step = 2*pi/(model%scene%highest_speed()*many_steps)
      end associate
      associate (tolerance => options%absolute_tolerance)
         if (model%smooth()) options%derivatives_age = smooth_derivatives_age
         if (.not. model%layout%radial) then
            tolerance = rigid_tolerance*tolerance
         else if (.not. model%smooth()) then
            tolerance = friction_tolerance*tolerance
         end if
      end associate
      if (.not. present(y)) return
      call make_static(model, model%point%rupture, static)
      options%lowers_orders = has_light_modes(static, y, model%scene%highest_speed())
   end function march_settings_of
end module march_settings
