!> The integrator step by step: accuracy between the ends of steps, what outputs belong to, starting anew, several at
!> once.
module swinging
   use kinds, only: wp
   use small_ode, only: small_ode_type
   implicit none (type, external)
   private
   public :: oscillator, exact

   !> y'' = -w^2 y as (y, y'), whose outputs are the states themselves.
   type, extends(small_ode_type) :: oscillator
      real(wp) :: w = 1
   contains
      procedure :: rates
      procedure :: jacobian
      procedure :: output
   end type oscillator

contains

   !> From (1, 0) at t = 0.
   pure function exact(w, t) result(y)
      real(wp), intent(in) :: w, t
      real(wp) :: y(2)
      y = [cos(w*t), -w*sin(w*t)]
   end function exact

   pure function rates(self, t, y)
      class(oscillator), intent(in) :: self
      real(wp), intent(in) :: t, y(:)
      real(wp) :: rates(size(y))
      rates = [y(2), -self%w**2*y(1)]
   end function rates

   pure function jacobian(self, t, y) result(matrix)
      class(oscillator), intent(in) :: self
      real(wp), intent(in) :: t, y(:)
      real(wp) :: matrix(size(y), size(y))
      matrix = reshape([0.0_wp, -self%w**2, 1.0_wp, 0.0_wp], [2, 2])
   end function jacobian

   function output(self, correction)
      class(oscillator), intent(inout) :: self
      real(wp), intent(in) :: correction(:)
      real(wp) :: output(self%outputs)
      output = self%seen + correction
   end function output
end module swinging

!> The integrator step by step: accuracy between the ends of steps, what outputs belong to, starting anew, several at
!> once; the history of its steps; when it tries low orders of BDF.
program test_cvode_integrator
   use kinds, only: wp, i8
   use text, only: to_text
   use errors, only: error_type, numerics_error
   use cvode_integrator, only: integrator_type, integrator_options, step_history_type, new_step_history
   use ode_model, only: integrator_counts_type
   use swinging, only: oscillator, exact
   use marching, only: order_control_type, stable_order
   use check, only: runs, expect, expect_close, report
   implicit none (type, external)
   real(wp), parameter :: tolerance = 1e-8_wp

   if (runs('between_steps')) call between_steps()
   if (runs('outputs_of_steps')) call outputs_of_steps()
   if (runs('starting_anew')) call starting_anew()
   if (runs('side_by_side')) call side_by_side()
   if (runs('refusal')) call refusal()
   if (runs('polynomials')) call polynomials()
   if (runs('youngest_points')) call youngest_points()
   if (runs('few_points')) call few_points()
   if (runs('long_steps')) call long_steps()
   if (runs('stays')) call stays()
   if (runs('returns')) call returns()
   if (runs('in_vain')) call in_vain()
   if (runs('orders')) call orders()
   if (runs('many_modes')) call many_modes()
   call report()

contains

   type(integrator_options) function tolerances()
      tolerances%relative_tolerance = tolerance
      tolerances%absolute_tolerance = [tolerance, tolerance]
   end function tolerances

   subroutine expect_well(error)
      type(error_type), allocatable, intent(in) :: error
      if (allocated(error)) call expect(.false., error%message)
   end subroutine expect_well

   !> A step's error is at most the tolerance times (|y| + 1) sqrt(2), |y| <= 1, and adds up over the steps; states
   !> between the ends of a step are as good, and the last step ends at the time given.
   subroutine between_steps()
      type(oscillator), target :: model
      type(integrator_type) :: integrator
      type(integrator_counts_type) :: counts
      type(error_type), allocatable :: error
      real(wp) :: before, t, found(4), allowed
      integer :: k
      model = oscillator(n=2, outputs=2)
      call integrator%start(model, tolerances(), 0.0_wp, exact(1.0_wp, 0.0_wp), 6.0_wp, error)
      call expect_well(error)
      call integrator%interpolate(0.0_wp, found)
      call expect_close(norm2(found - [exact(1.0_wp, 0.0_wp), exact(1.0_wp, 0.0_wp)]), 0.0_wp, 0.0_wp, &
         & 'the start is what was given')
      do while (integrator%time() < 6)
         before = integrator%time()
         call integrator%step(error)
         call expect_well(error)
         if (allocated(error)) return
         counts = integrator%counts()
         allowed = 3*counts%steps*tolerance
         do k = 0, 4
            t = before + 0.25_wp*k*(integrator%time() - before)
            call integrator%interpolate(t, found)
            call expect_close(norm2(found(:2) - exact(1.0_wp, t)), 0.0_wp, allowed, 'state at '//to_text(t))
         end do
         call expect_close(norm2(found(:2) - integrator%state()), 0.0_wp, 4*epsilon(t), 'the step ends in its state')
      end do
      call expect_close(integrator%time(), 6.0_wp, 0.0_wp, 'the end is met')
      call expect(counts%rhs_evaluations > counts%steps .and. counts%jacobian_evaluations > 0, 'work is counted')
   end subroutine between_steps

   !> Newton's last correction leads from the state evaluated last to the one accepted, so the outputs at the end of a
   !> step are those of its state.
   subroutine outputs_of_steps()
      type(oscillator), target :: model
      type(integrator_type) :: integrator
      type(error_type), allocatable :: error
      real(wp) :: found(4), largest
      integer :: k
      model = oscillator(n=2, outputs=2)
      call integrator%start(model, tolerances(), 0.0_wp, exact(1.0_wp, 0.0_wp), 6.0_wp, error)
      largest = 0
      do k = 1, 50
         call integrator%step(error)
         call expect_well(error)
         largest = max(largest, norm2(model%seen - integrator%state()))
         call integrator%interpolate(integrator%time(), found)
         call expect_close(norm2(found(3:) - integrator%state()), 0.0_wp, 8*epsilon(found), &
            & 'outputs of step '//to_text(k))
      end do
      call expect(largest > 100*epsilon(found), 'without the correction they would be of another state')
   end subroutine outputs_of_steps

   !> Times and states of the first steps from where the integrator stands.
   subroutine take_steps(integrator, found)
      type(integrator_type), intent(inout) :: integrator
      real(wp), intent(out) :: found(:, :)
      type(error_type), allocatable :: error
      integer :: k
      do k = 1, size(found, 2)
         call integrator%step(error)
         call expect_well(error)
         found(:, k) = [integrator%time(), integrator%state()]
      end do
   end subroutine take_steps

   !> After another start every bit is as from a fresh integrator.
   subroutine starting_anew()
      type(oscillator), target :: model, fast
      type(integrator_type) :: integrator, fresh
      type(integrator_counts_type) :: counts, fresh_counts
      type(error_type), allocatable :: error
      real(wp), parameter :: from(2) = [0.3_wp, -2.0_wp]
      real(wp) :: first(3, 40), again(3, 40)
      model = oscillator(n=2, outputs=2)
      fast = oscillator(n=2, outputs=2, w=50.0_wp)
      call fresh%start(model, tolerances(), 1.5_wp, from, 8.0_wp, error)
      call take_steps(fresh, first)
      fresh_counts = fresh%counts()
      call integrator%start(model, tolerances(), 0.0_wp, exact(1.0_wp, 0.0_wp), 6.0_wp, error)
      call take_steps(integrator, again)
      call integrator%start(model, tolerances(), 1.5_wp, from, 8.0_wp, error)
      call expect_well(error)
      call take_steps(integrator, again)
      call expect_close(norm2(again - first), 0.0_wp, 0.0_wp, 'a second start is a start')
      counts = integrator%counts()
      call expect(counts%steps == 40_i8 .and. counts%rhs_evaluations == fresh_counts%rhs_evaluations, &
         & 'and counts from there')
      call integrator%start(fast, tolerances(), 0.0_wp, from, 8.0_wp, error)
      call take_steps(integrator, again)
      call integrator%finish()
      call integrator%finish()
      call integrator%start(model, tolerances(), 1.5_wp, from, 8.0_wp, error)
      call take_steps(integrator, again)
      call expect_close(norm2(again - first), 0.0_wp, 0.0_wp, 'another start is a start')
   end subroutine starting_anew

   !> Two integrators that take turns, with models of their own, each do what they do alone.
   subroutine side_by_side()
      type(oscillator), target :: slow, fast
      type(integrator_type) :: first, second
      type(error_type), allocatable :: error
      real(wp) :: alone(3, 40, 2), together(3, 40, 2)
      integer :: k
      slow = oscillator(n=2, outputs=2)
      fast = oscillator(n=2, outputs=2, w=50.0_wp)
      call first%start(slow, tolerances(), 0.0_wp, exact(1.0_wp, 0.0_wp), 6.0_wp, error)
      call take_steps(first, alone(:, :, 1))
      call first%start(fast, tolerances(), 0.0_wp, exact(50.0_wp, 0.0_wp), 6.0_wp, error)
      call take_steps(first, alone(:, :, 2))
      call first%start(slow, tolerances(), 0.0_wp, exact(1.0_wp, 0.0_wp), 6.0_wp, error)
      call second%start(fast, tolerances(), 0.0_wp, exact(50.0_wp, 0.0_wp), 6.0_wp, error)
      do k = 1, 40
         call take_steps(first, together(:, k:k, 1))
         call take_steps(second, together(:, k:k, 2))
      end do
      call expect_close(norm2(together - alone), 0.0_wp, 0.0_wp, 'neither knows of the other')
      call expect(alone(1, 40, 1) > 5*alone(1, 40, 2), 'each goes at its own pace')
   end subroutine side_by_side

   !> Where the model refuses, steps end with its reason; after a start elsewhere they go on.
   subroutine refusal()
      type(oscillator), target :: model
      type(integrator_type) :: integrator
      type(error_type), allocatable :: error
      real(wp) :: reached
      model = oscillator(n=2, outputs=2, refuse_after=0.5_wp)
      call integrator%start(model, tolerances(), 1.0_wp, exact(1.0_wp, 1.0_wp), 2.0_wp, error)
      call expect(allocated(error), 'a start that the model refuses is an error')
      call integrator%start(model, tolerances(), 0.0_wp, exact(1.0_wp, 0.0_wp), 2.0_wp, error)
      call expect_well(error)
      do while (.not. allocated(error) .and. integrator%time() < 1)
         call integrator%step(error)
      end do
      call expect(allocated(error), 'no step beyond')
      if (.not. allocated(error)) return
      call expect(error%status == numerics_error .and. index(error%message, 'the problem ends') == 1, &
         & 'the error gives the reason: '//error%message)
      reached = integrator%time()
      call expect(reached <= 0.5_wp .and. reached > 0.49_wp, 'the time reached stands: '//to_text(reached))
      call expect_close(norm2(integrator%state() - exact(1.0_wp, reached)), 0.0_wp, 300*tolerance, 'and its state')
   end subroutine refusal

   !> A polynomial of the step's order comes back to rounding, on uneven steps, at both ends and between.
   subroutine polynomials()
      type(step_history_type) :: history
      real(wp), parameter :: times(8) = [0.0_wp, 0.1_wp, 0.25_wp, 0.3_wp, 0.5_wp, 0.52_wp, 0.7_wp, 1.0_wp]
      real(wp) :: t, found(2)
      integer :: order, k
      do order = 0, 5
         history = new_step_history(2)
         do k = 1, size(times)
            call history%add(times(k), [times(k)**order], [3 - 2*times(k)**order])
         end do
         do k = 0, 4
            t = 0.7_wp + 0.075_wp*k
            call history%at(t, order, found)
            call expect_close(found(1), t**order, 1e-12_wp, 'order '//to_text(order)//' at '//to_text(t))
            call expect_close(found(2), 3 - 2*t**order, 1e-12_wp, 'its second value at '//to_text(t))
         end do
      end do
   end subroutine polynomials

   !> A step of first order looks at its two ends alone: no older switching point is seen.
   subroutine youngest_points()
      type(step_history_type) :: history
      real(wp) :: found(1)
      integer :: k
      history = new_step_history(1)
      do k = 0, 9
         call history%add(real(k, wp), [max(0.0_wp, k - 8.0_wp)], [real(wp) ::])
      end do
      call history%at(8.25_wp, 1, found)
      call expect_close(found(1), 0.25_wp, 1e-14_wp, 'a line between the ends of the step')
   end subroutine youngest_points

   !> At the start there are fewer points than the order asks for.
   subroutine few_points()
      type(step_history_type) :: history
      real(wp) :: found(1)
      history = new_step_history(1)
      call history%add(0.0_wp, [real(wp) ::], [2.0_wp])
      call history%at(0.0_wp, 3, found)
      call expect_close(found(1), 2.0_wp, 0.0_wp, 'one point')
      call history%add(1.0_wp, [real(wp) ::], [4.0_wp])
      call history%at(0.5_wp, 3, found)
      call expect_close(found(1), 3.0_wp, 1e-14_wp, 'two points')
   end subroutine few_points

   !> Goes on from a step with steps of this length, s, until the orders change; the number of the step then.
   subroutine go_on(watch, t, steps, length, last)
      type(order_control_type), intent(inout) :: watch
      real(wp), intent(inout) :: t
      integer(i8), intent(inout) :: steps
      real(wp), intent(in) :: length
      integer(i8), intent(in) :: last
      do while (steps < last)
         t = t + length
         steps = steps + 1
         if (watch%changes(t, steps)) exit
      end do
   end subroutine go_on

   !> Where the steps are long nothing is tried, nor where they are not short for long.
   subroutine long_steps()
      type(order_control_type) :: watch
      real(wp) :: t
      integer(i8) :: steps
      integer :: k
      t = 5
      steps = 0
      watch = order_control_type(1.0_wp, t)
      do k = 1, 20
         call go_on(watch, t, steps, merge(0.1_wp, 1.1_wp, modulo(k, 4) > 0), 250_i8*k)
      end do
      call expect(steps == 5000 .and. .not. watch%low, 'no trial at step '//to_text(steps))
   end subroutine long_steps

   !> Low orders that go twice as far stay, until high ones are tried; these stay where they go no less far, and
   !> low ones are then tried as soon as at first.
   subroutine stays()
      type(order_control_type) :: watch
      real(wp) :: t
      integer(i8) :: steps
      t = 5
      steps = 0
      watch = order_control_type(1.0_wp, t)
      call go_on(watch, t, steps, 0.1_wp, 100000_i8)
      call expect(watch%low .and. steps == 1000, 'a trial at step '//to_text(steps))
      call expect(abs(watch%mean_step - 0.1_wp) < 1e-9_wp, 'after a mean step of '//to_text(watch%mean_step))
      call go_on(watch, t, steps, 0.06_wp, 1500_i8)
      call expect(watch%low .and. steps == 1500, 'its second half is waited for: '//to_text(steps))
      call go_on(watch, t, steps, 0.2_wp, 100000_i8)
      call expect(.not. watch%low .and. steps == 12000, 'low orders stay until step '//to_text(steps))
      call expect(abs(watch%mean_step - 0.2_wp) < 1e-9_wp, 'they had a mean step of '//to_text(watch%mean_step))
      call go_on(watch, t, steps, 0.21_wp, 13000_i8)
      call expect(.not. watch%low .and. steps == 13000, 'high orders that go as far stay: '//to_text(steps))
      call go_on(watch, t, steps, 0.1_wp, 100000_i8)
      call expect(watch%low .and. steps == 14000, 'the next trial at step '//to_text(steps))
   end subroutine stays

   !> High orders that go less far than low ones are left, and tried again after a longer wait.
   subroutine returns()
      type(order_control_type) :: watch
      real(wp) :: t
      integer(i8) :: steps
      t = 0
      steps = 0
      watch = order_control_type(1.0_wp, t)
      call go_on(watch, t, steps, 0.1_wp, 1000_i8)
      call go_on(watch, t, steps, 0.2_wp, 100000_i8)
      call go_on(watch, t, steps, 0.19_wp, 100000_i8)
      call expect(watch%low .and. steps == 13000, 'high orders are left at step '//to_text(steps))
      call go_on(watch, t, steps, 0.2_wp, 100000_i8)
      call expect(.not. watch%low .and. steps == 53000, 'and tried again at step '//to_text(steps))
   end subroutine returns

   !> Low orders that go much less far are left after half the trial, those that go hardly further after the whole. The
   !> waits grow.
   subroutine in_vain()
      type(order_control_type) :: watch
      real(wp) :: t
      integer(i8) :: steps
      t = 0
      steps = 0
      watch = order_control_type(1.0_wp, t)
      call go_on(watch, t, steps, 0.1_wp, 1000_i8)
      call go_on(watch, t, steps, 0.04_wp, 100000_i8)
      call expect(.not. watch%low .and. steps == 1500, 'much less far: until step '//to_text(steps))
      call go_on(watch, t, steps, 0.1_wp, 100000_i8)
      call expect(watch%low .and. steps == 5500, 'the second trial at step '//to_text(steps))
      call go_on(watch, t, steps, 0.14_wp, 100000_i8)
      call expect(.not. watch%low .and. steps == 6500, 'hardly further: until step '//to_text(steps))
      call go_on(watch, t, steps, 0.1_wp, 100000_i8)
      call expect(watch%low .and. steps == 22500, 'the third trial at step '//to_text(steps))
   end subroutine in_vain

   !> BDF of the orders 3, 4 and 5 is stable in any vibration from damping ratios of 0.069, 0.287 and 0.618 on (the
   !> cosines of its angles of stability, 86.0, 73.4 and 51.8 degrees).
   subroutine orders()
      real(wp), parameter :: damping(8) = [-0.01_wp, 0.0_wp, 0.06_wp, 0.08_wp, 0.28_wp, 0.3_wp, 0.6_wp, 0.7_wp]
      integer, parameter :: expected(8) = [2, 2, 2, 3, 3, 4, 4, 5]
      integer :: k, found
      do k = 1, size(damping)
         found = stable_order(vibration(100.0_wp, damping(k)), 0.01_wp)
         call expect(found == expected(k), 'order '//to_text(found)//' at damping ratio '//to_text(damping(k)))
         found = stable_order(vibration(100.0_wp, damping(k)), 0.001_wp)
         call expect(found == 5, 'order '//to_text(found)//' where steps resolve it, at '//to_text(damping(k)))
      end do
   end subroutine orders

   !> The lightest vibration decides, whatever else there is: decay, growth, states that stay.
   subroutine many_modes()
      real(wp) :: jacobian(8, 8)
      integer :: found
      jacobian = 0
      jacobian(1:2, 1:2) = vibration(1.0_wp, 0.01_wp)
      jacobian(3:4, 3:4) = vibration(500.0_wp, 0.4_wp)
      jacobian(5, 5) = -1e6_wp
      jacobian(6, 6) = 10
      found = stable_order(jacobian, 0.01_wp)
      call expect(found == 4, 'order '//to_text(found)//' with one fast vibration')
      jacobian(7:8, 7:8) = vibration(3000.0_wp, 0.1_wp)
      found = stable_order(jacobian, 0.01_wp)
      call expect(found == 3, 'order '//to_text(found)//' with a lighter one')
   end subroutine many_modes

   !> x'' + 2 damping frequency x' + frequency**2 x = 0.
   pure function vibration(frequency, damping) result(matrix)
      real(wp), intent(in) :: frequency, damping
      real(wp) :: matrix(2, 2)
      matrix(1, :) = [0.0_wp, 1.0_wp]
      matrix(2, :) = [-frequency**2, -2*damping*frequency]
   end function vibration
end program test_cvode_integrator
