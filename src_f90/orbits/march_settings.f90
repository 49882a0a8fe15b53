!> How a rotor is marched: the tolerances of its input, and what pivots and friction of its bearings ask for; and the
!> march that brings a periodic orbit near, period after period, and the last one as intervals of a collocation.
module march_settings
   use kinds, only: wp, i8, pi, rpm
   use marching, only: march_options
   use state_layout, only: tilt, pivot_deflection
   use abstract_element, only: element_pointer
   use equations_of_motion, only: machine_model
   use text, only: to_text
   use errors, only: error_type, raise, add_context, numerics_error, stopped, asked
   use cvode_integrator, only: integrator_type
   use linear_algebra, only: find_eigenvalues
   use orbit_polynomials, only: orbit_type, points, place
   implicit none (type, external)
   private
   public :: march_settings_of, has_light_vibrations, march_period, mesh_options, do_step


   !> Steps after which the derivatives are taken anew without friction: the motion is smooth, the steps are long.
   integer, parameter :: smooth_derivatives_age = 2
   !> Absolute tolerances of rigid pivots over those of pivots that yield: without their damping the errors of the steps
   !> live longer.
   real(wp), parameter :: rigid_tolerance = 0.3_wp
   !> Tolerances of fixed pads over those of pads that move: the whirl of a plain bearing has no phase of its own, so
   !> that in it the errors of all steps add up.
   real(wp), parameter :: fixed_tolerance = 0.3_wp
   !> And with friction over those without: what its moment errs by is above what the states do.
   real(wp), parameter :: friction_tolerance = 0.5_wp
   !> And of light vibrations above the speed, which elastic rotors have: there BDF of the orders 3 to 5 is unstable, so
   !> that they go on as large as the error test lets them. The run-up of tests/bench/machines.py errs by 3e-3 of its
   !> largest amplitude with 1, and by 3e-4 with 0.1, for a quarter more steps.
   real(wp), parameter :: light_tolerance = 0.1_wp
   !> How fast a light vibration is at least, over the speed of the shaft.
   real(wp), parameter :: fast = 2

   !> Steps in a revolution from which on low orders are tried. Of 70 cases of the stress test (seed 1) with lightly
   !> damped modes or many steps, 100 completes all that any way completes; 300 and 1000 leave one, and take up to 3 and
   !> 11 times as many steps in others.
   real(wp), parameter :: many_steps = 100


   !> Tolerance of the march over what is asked for: on its steps the collocation is that much more accurate.
   !> Not so where the march would become too coarse to start from.
   real(wp), parameter :: looser = 10, loosest = 1e-4_wp
   !> Fewest steps of the march, and so intervals, in a revolution: a motion that hardly moves would take few.
   real(wp), parameter :: fewest = 24
   !> Steps between two questions whether to stop.
   integer(i8), parameter :: steps_between_questions = 64

contains

   !> Those of a model after this many steps.
   type(march_options) function march_settings_of(model, steps, light) result(options)
      type(machine_model), intent(in), target :: model
      integer(i8), intent(in) :: steps
      !> Whether a rigid journal and its pads have light vibrations; an elastic rotor always has.
      logical, intent(in), optional :: light
      logical :: smooth
      type(element_pointer), allocatable :: elements(:)
      integer :: e
      associate (integration => model%inputs%integration)
         options%relative_tolerance = integration%relative_tolerance
         if (size(model%bearings) > 0 .and. .not. any([(model%layout%elements(e)%has(tilt), e=1, &
            & size(model%bearings))])) options%relative_tolerance = fixed_tolerance*integration%relative_tolerance
         options%absolute_tolerance = options%relative_tolerance*integration%tolerance_scale*model%scale
         options%max_step = integration%max_step
         options%max_steps = integration%max_steps - steps
         options%short_step = 2*pi/(model%inputs%highest_speed()*many_steps)
      end associate
      associate (tolerance => options%absolute_tolerance)
         elements = model%elements()
         smooth = all([(elements(e)%to%is_smooth(), e=1, size(elements))])
         if (smooth) options%derivatives_age = smooth_derivatives_age
         if (.not. model%rotor%is_identity) then
            tolerance = light_tolerance*tolerance
         else if (.not. all([(model%layout%elements(e)%has(pivot_deflection), e=1, size(model%bearings))])) then
            tolerance = rigid_tolerance*tolerance
         else if (.not. smooth) then
            tolerance = friction_tolerance*tolerance
         end if
         if (present(light)) tolerance = merge(light_tolerance, 1.0_wp, light)*tolerance
      end associate
   end function march_settings_of

   !> Whether there are light vibrations about the state y at time t, s: faster than the shaft, and they lose or gain
   !> less than a factor e in a revolution, so that what the integrator raises of them stays. In a run-up each may be so
   !> at another speed: it passes them.
   logical function has_light_vibrations(model, t, y)
      type(machine_model), intent(inout) :: model
      real(wp), intent(in) :: t, y(:)
      real(wp) :: rates(size(y)), jacobian(size(y), size(y))
      complex(wp) :: values(size(y))
      logical :: ok
      call model%rhs_and_jacobian(t, y, rates, jacobian, ok)
      if (ok) call find_eigenvalues(jacobian, values, ok)
      associate (operation => model%inputs%operation, highest => model%inputs%highest_speed())
         has_light_vibrations = ok .and. any(abs(values%im) > fast*min(operation%speed_rpm, operation%final_speed_rpm) &
            & *rpm .and. abs(values%re) < highest/(2*pi))
      end associate
   end function has_light_vibrations

   !> How to march for a mesh, where a march would be so, and a revolution takes this time, s.
   pure type(march_options) function mesh_options(march, revolution) result(options)
      type(march_options), intent(in) :: march
      real(wp), intent(in) :: revolution
      real(wp) :: factor
      options = march
      factor = max(1.0_wp, min(looser, loosest/march%relative_tolerance))
      options%relative_tolerance = factor*march%relative_tolerance
      options%absolute_tolerance = factor*march%absolute_tolerance
      options%keeps_outputs = .false.
      options%max_step = revolution/fewest
      if (march%max_step > 0) options%max_step = min(options%max_step, march%max_step)
   end function mesh_options

   !> Marches over period number `period` = 0, 1, .., in whose first step the integrator stands; its steps become the
   !> intervals of the orbit. An error says why, where and when the march ended.
   subroutine march_period(integrator, options, period, length, orbit, error)
      type(integrator_type), intent(inout) :: integrator
      type(march_options), intent(in) :: options
      integer, intent(in) :: period
      !> s.
      real(wp), intent(in) :: length
      type(orbit_type), intent(inout) :: orbit
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: ends(:), at(:, :, :)
      real(wp) :: t, before
      integer :: n, i
      call integrator%interpolate(period*length, orbit%start)
      allocate (ends(64), at(size(orbit%start), points, 64))
      n = 0
      before = 0
      do
         t = min(length, integrator%time() - period*length)
         if (t > before) then
            if (n == size(ends)) then
               ends = [ends, ends]
               at = reshape(at, [size(at, 1), points, 2*n], pad=at)
            end if
            n = n + 1
            ends(n) = t
            do i = 1, points
               call integrator%interpolate(period*length + before + place(i)*(t - before), at(:, i, n))
            end do
            before = t
         end if
         if (t >= length) exit
         call do_step(integrator, options, error)
         if (allocated(error)) return
      end do
      call orbit%set_mesh([0.0_wp, ends(:n)], at(:, :, :n))
   end subroutine march_period

   !> A step, unless there were too many or `give_up` of the options says so.
   subroutine do_step(integrator, options, error)
      type(integrator_type), intent(inout) :: integrator
      type(march_options), intent(in) :: options
      type(error_type), allocatable, intent(out) :: error
      logical :: stops
      associate (counts => integrator%counts())
         stops = .false.
         if (mod(counts%steps, steps_between_questions) == 0) stops = asked(options%give_up)
         if (stops) then
            call raise(error, stopped, 'asked to stop')
         else if (counts%steps >= options%max_steps) then
            call raise(error, numerics_error, 'too many steps (integration%max_steps)')
         else
            call integrator%step(error)
         end if
         ! the text takes longer than a step
         if (allocated(error)) call add_context(error, 'the march stopped at t = '//to_text(integrator%time()) &
            & //' s, after '//to_text(counts%steps)//' steps')
      end associate
   end subroutine do_step
end module march_settings
