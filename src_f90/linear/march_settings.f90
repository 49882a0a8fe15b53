!> How a rotor is marched: the tolerances of its input, and what pivots and friction of its bearings ask for.
module march_settings
   use kinds, only: wp, i8, pi
   use marching, only: march_options
   use state_layout, only: pivot_deflection
   use abstract_element, only: element_pointer
   use equations_of_motion, only: machine_model
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
   !> And of an elastic rotor: in its light vibrations above the speed BDF of the orders 3 to 5 is unstable, so that
   !> they go on as large as the error test lets them. The run-up of tests/bench/machines.py errs by 3e-3 of its largest
   !> amplitude with 1, and by 3e-4 with 0.1, for a quarter more steps.
   real(wp), parameter :: elastic_tolerance = 0.1_wp

   !> Steps in a revolution from which on low orders are tried. Of 70 cases of the stress test (seed 1) with lightly
   !> damped modes or many steps, 100 completes all that any way completes; 300 and 1000 leave one, and take up to 3 and
   !> 11 times as many steps in others.
   real(wp), parameter :: many_steps = 100

contains

   !> Those of a model after this many steps.
   type(march_options) function march_settings_of(model, steps) result(options)
      type(machine_model), intent(in), target :: model
      integer(i8), intent(in) :: steps
      logical :: smooth
      type(element_pointer), allocatable :: elements(:)
      integer :: e
      associate (integration => model%inputs%integration)
         options%relative_tolerance = integration%relative_tolerance
         options%absolute_tolerance = integration%relative_tolerance*integration%tolerance_scale*model%scale
         options%max_step = integration%max_step
         options%max_steps = integration%max_steps - steps
         options%short_step = 2*pi/(model%inputs%highest_speed()*many_steps)
      end associate
      associate (tolerance => options%absolute_tolerance)
         elements = model%elements()
         smooth = all([(elements(e)%to%is_smooth(), e=1, size(elements))])
         if (smooth) options%derivatives_age = smooth_derivatives_age
         if (.not. model%rotor%is_identity) then
            tolerance = elastic_tolerance*tolerance
         else if (.not. all([(model%layout%elements(e)%has(pivot_deflection), e=1, size(model%bearings))])) then
            tolerance = rigid_tolerance*tolerance
         else if (.not. smooth) then
            tolerance = friction_tolerance*tolerance
         end if
      end associate
   end function march_settings_of
end module march_settings
