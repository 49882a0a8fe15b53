!> The march on small problems with known solutions: accuracy, samples, refusals, limits.
module march_problems
   use kinds, only: wp, i8
   use errors, only: error_type, raise, numerics_error, stopped
   use small_ode, only: small_ode_type
   use marching, only: march_observer_type
   use ode_model, only: integrator_counts_type
   implicit none (type, external)
   private
   public :: stiff_cosine, robertson, light_vibration, keeper

   !> y' = -k (y - cos t) - sin t, beside a damped oscillator of its own: y = cos t from y(0) = 1.
   type, extends(small_ode_type) :: stiff_cosine
      real(wp) :: stiffness = 1e5_wp
   contains
      procedure :: rates => cosine_rates
      procedure :: jacobian => cosine_jacobian
   end type stiff_cosine

   !> y'' + 2 zeta w y' + w^2 y = w^2 cos t, fast and hardly damped: in the orders 3 to 5 of BDF it grows.
   type, extends(small_ode_type) :: light_vibration
      real(wp) :: frequency = 400, damping = 0.0045_wp
   contains
      procedure :: rates => light_rates
      procedure :: jacobian => light_jacobian
   end type light_vibration

   !> Robertson's chemical reaction.
   type, extends(small_ode_type) :: robertson
   contains
      procedure :: rates => robertson_rates
      procedure :: jacobian => robertson_jacobian
   end type robertson

   !> Keeps its samples; sets an error at sample `stop_at`.
   type, extends(march_observer_type) :: keeper
      real(wp), allocatable :: t(:), y(:, :)
      integer :: stop_at = 0, reports = 0
      !> Wants the state once this many samples are there, and ends the march then.
      integer :: leave_at = huge(1)
      real(wp) :: left_at = -1
   contains
      procedure :: sample => keep_sample
      procedure :: report => keep_report
      procedure :: wants_state => keeper_leaves
      procedure :: take_state => keep_state
   end type keeper

contains

   pure function cosine_rates(self, t, y) result(rates)
      class(stiff_cosine), intent(in) :: self
      real(wp), intent(in) :: t, y(:)
      real(wp) :: rates(size(y))
      rates = [-self%stiffness*(y(1) - cos(t)) - sin(t), y(3), -4*y(2)]
   end function cosine_rates

   pure function cosine_jacobian(self, t, y) result(matrix)
      class(stiff_cosine), intent(in) :: self
      real(wp), intent(in) :: t, y(:)
      real(wp) :: matrix(size(y), size(y))
      matrix = 0
      matrix(1, 1) = -self%stiffness
      matrix(2, 3) = 1
      matrix(3, 2) = -4
   end function cosine_jacobian

   pure function light_rates(self, t, y) result(rates)
      class(light_vibration), intent(in) :: self
      real(wp), intent(in) :: t, y(:)
      real(wp) :: rates(size(y))
      rates = matmul(self%jacobian(t, y), y) + [0.0_wp, self%frequency**2*cos(t)]
   end function light_rates

   pure function light_jacobian(self, t, y) result(matrix)
      class(light_vibration), intent(in) :: self
      real(wp), intent(in) :: t, y(:)
      real(wp) :: matrix(size(y), size(y))
      matrix(1, :) = [0.0_wp, 1.0_wp]
      matrix(2, :) = [-self%frequency**2, -2*self%damping*self%frequency]
   end function light_jacobian

   pure function robertson_rates(self, t, y) result(rates)
      class(robertson), intent(in) :: self
      real(wp), intent(in) :: t, y(:)
      real(wp) :: rates(size(y))
      rates(1) = -0.04_wp*y(1) + 1e4_wp*y(2)*y(3)
      rates(3) = 3e7_wp*y(2)**2
      rates(2) = -rates(1) - rates(3)
   end function robertson_rates

   pure function robertson_jacobian(self, t, y) result(matrix)
      class(robertson), intent(in) :: self
      real(wp), intent(in) :: t, y(:)
      real(wp) :: matrix(size(y), size(y))
      matrix(1, :) = [-0.04_wp, 1e4_wp*y(3), 1e4_wp*y(2)]
      matrix(3, :) = [0.0_wp, 6e7_wp*y(2), 0.0_wp]
      matrix(2, :) = -matrix(1, :) - matrix(3, :)
   end function robertson_jacobian

   subroutine keep_sample(self, t, y, output, error)
      class(keeper), intent(inout) :: self
      real(wp), intent(in) :: t, y(:), output(:)
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: grown(:, :)
      integer :: n
      if (.not. allocated(self%t)) allocate (self%t(0), self%y(size(y), 0))
      n = size(self%t)
      allocate (grown(size(y), n + 1))
      grown(:, :n) = self%y
      grown(:, n + 1) = y
      call move_alloc(grown, self%y)
      self%t = [self%t, t]
      if (n + 1 == self%stop_at) call raise(error, numerics_error, 'the keeper is full')
   end subroutine keep_sample

   subroutine keep_report(self, t, steps)
      class(keeper), intent(inout) :: self
      real(wp), intent(in) :: t
      integer(i8), intent(in) :: steps
      self%reports = self%reports + 1
   end subroutine keep_report

   logical function keeper_leaves(self)
      class(keeper), intent(in) :: self
      keeper_leaves = .false.
      if (allocated(self%t)) keeper_leaves = size(self%t) >= self%leave_at
   end function keeper_leaves

   subroutine keep_state(self, t, y, counts, error)
      class(keeper), intent(inout) :: self
      real(wp), intent(in) :: t, y(:)
      type(integrator_counts_type), intent(in) :: counts
      type(error_type), allocatable, intent(out) :: error
      self%left_at = t
      if (counts%rhs_evaluations > 0) call raise(error, stopped, 'left')
   end subroutine keep_state
end module march_problems

program test_marching
   use kinds, only: wp, i8
   use text, only: to_text
   use errors, only: error_type, numerics_error
   use marching, only: march, march_options, sample_plan
   use ode_model, only: integrator_counts_type
   use march_problems, only: stiff_cosine, robertson, light_vibration, keeper
   use check, only: runs, expect, expect_close, expect_no_error, expect_error, report
   implicit none (type, external)

   !> A march of the cosine with all that it needs and leaves.
   type :: trial
      type(stiff_cosine) :: model
      type(keeper) :: observer
      type(integrator_counts_type) :: counts
      type(error_type), allocatable :: error
      real(wp) :: y(3) = 0
   end type trial

   if (runs('accuracy')) call accuracy()
   if (runs('samples_in_time')) call samples_in_time()
   if (runs('last_sample_past_the_end')) call last_sample_past_the_end()
   if (runs('chemistry')) call chemistry()
   if (runs('refusal')) call refusal()
   if (runs('passing_refusal')) call passing_refusal()
   if (runs('step_limits')) call step_limits()
   if (runs('observer_stops')) call observer_stops()
   if (runs('going_on')) call going_on()
   if (runs('orders')) call orders()
   call report()

contains

   !> Low orders are tried where steps are short, and stay where they go much further: with the same samples, an error
   !> within the tolerances of the steps (of the position: a rate errs by the frequency times more), and all counted.
   !> Where steps are short for good reason, a trial costs little.
   subroutine orders()
      integer(i8) :: with_all, with_low, none, worst(2)
      integer :: k
      call vibrate(0.0045_wp, 0.0_wp, with_all)
      call vibrate(0.0045_wp, 0.05_wp, with_low)
      call expect(4*with_low < with_all, 'they go further: '//to_text(with_low)//' steps, not '//to_text(with_all))
      ! whether one that is stable with order 3 holds up the higher orders follows rounding: of many, the worst
      worst = 0
      do k = 0, 20
         call vibrate(0.07_wp + 0.004_wp*k, 0.0_wp, with_all)
         call vibrate(0.07_wp + 0.004_wp*k, 0.05_wp, with_low)
         worst = max(worst, [with_all, with_low])
      end do
      call expect(2*worst(2) < worst(1), 'order 3: '//to_text(worst(2))//' steps, not '//to_text(worst(1)))
      call vibrate(1.0_wp, 0.0_wp, none)
      call vibrate(1.0_wp, 1.0_wp, with_low)
      call expect(with_low < 1.3_wp*none, 'a trial in vain: '//to_text(with_low)//' steps, not '//to_text(none))
   end subroutine orders

   !> Marches a vibration that begins at its forced response.
   subroutine vibrate(damping, short_step, steps)
      real(wp), intent(in) :: damping, short_step
      integer(i8), intent(out) :: steps
      type(light_vibration) :: model
      type(keeper) :: observer
      type(march_options) :: options
      type(integrator_counts_type) :: counts
      type(error_type), allocatable :: error
      real(wp) :: y(2), found
      complex(wp) :: response
      integer :: k
      model%n = 2
      model%damping = damping
      response = model%frequency**2/cmplx(model%frequency**2 - 1, 2*damping*model%frequency, wp)
      y = [response%re, -response%im]
      options%relative_tolerance = 1e-5_wp
      options%absolute_tolerance = [1e-5_wp, 1e-4_wp]
      options%short_step = short_step
      call march(model, options, 0.0_wp, 60.0_wp, sample_plan(0.0_wp, 0.1_wp, 601_i8), y, observer, counts, error)
      call expect_no_error(error, 'the march ends well')
      call expect(size(observer%t) == 601, 'as many samples as planned')
      steps = counts%steps
      call expect(counts%rhs_evaluations >= steps, 'work is counted over all orders')
      found = 0
      do k = 1, size(observer%t)
         found = max(found, abs(observer%y(1, k) - real(response*exp((0.0_wp, 1.0_wp)*observer%t(k)), wp)))
      end do
      call expect(found < 3*steps*1e-5_wp, 'error '//to_text(found)//' after '//to_text(steps)//' steps')
   end subroutine vibrate

   !> A march left at a state goes on from it: no sample twice, none missing, as accurate as in one go.
   subroutine going_on()
      type(trial) :: it
      type(sample_plan) :: plan
      real(wp), parameter :: tolerance = 1e-8_wp
      real(wp) :: t
      integer(i8) :: steps
      integer :: k
      plan = sample_plan(0.25_wp, 0.01_wp, 576_i8)
      it%y = exact(0.0_wp)
      t = 0
      steps = 0
      do k = 1, 4
         it%observer%leave_at = merge(huge(1), 150*k, k == 4)
         call go(it, tolerances(tolerance), t, 6.0_wp, plan)
         steps = steps + it%counts%steps
         if (k == 4) exit
         call expect(allocated(it%error), 'leave '//to_text(k))
         t = it%observer%left_at
         plan%next = size(it%observer%t)
         call expect(plan%time(plan%next - 1) <= t .and. plan%time(plan%next) > t, 'all samples up to the state')
         call expect_close(norm2(it%y - exact(t)), 0.0_wp, 6*steps*tolerance, 'the state is the one at its time')
      end do
      call expect_no_error(it%error, 'the last part ends well')
      associate (samples => it%observer)
         call expect(size(samples%t) == 576, 'as many samples as planned: '//to_text(size(samples%t)))
         do k = 1, size(samples%t)
            call expect_close(samples%t(k), plan%time(k - 1_i8), 0.0_wp, 'time of sample '//to_text(k))
            call expect_close(norm2(samples%y(:, k) - exact(samples%t(k))), 0.0_wp, 6*steps*tolerance, &
               & 'sample '//to_text(k))
         end do
      end associate
   end subroutine going_on

   !> Marches from the state of the trial.
   subroutine go(it, options, from, to, plan)
      type(trial), intent(inout) :: it
      type(march_options), intent(in) :: options
      real(wp), intent(in) :: from, to
      type(sample_plan), intent(in) :: plan
      it%model%n = 3
      call march(it%model, options, from, to, plan, it%y, it%observer, it%counts, it%error)
   end subroutine go

   !> A march of the cosine from the exact state.
   type(trial) function marched(options, from, to, plan) result(it)
      type(march_options), intent(in) :: options
      real(wp), intent(in) :: from, to
      type(sample_plan), intent(in) :: plan
      it%y = exact(from)
      call go(it, options, from, to, plan)
   end function marched

   !> y = (cos t, sin 2t, 2 cos 2t).
   pure function exact(t)
      real(wp), intent(in) :: t
      real(wp) :: exact(3)
      exact = [cos(t), sin(2*t), 2*cos(2*t)]
   end function exact

   pure type(march_options) function tolerances(relative)
      real(wp), intent(in) :: relative
      tolerances%relative_tolerance = relative
      tolerances%absolute_tolerance = spread(relative, 1, 3)
   end function tolerances

   !> Largest error of the samples over 0 to 6 s.
   subroutine sampled_error(tolerance, error_found, steps)
      real(wp), intent(in) :: tolerance
      real(wp), intent(out) :: error_found
      integer(i8), intent(out) :: steps
      type(trial) :: it
      integer :: k
      it = marched(tolerances(tolerance), 0.0_wp, 6.0_wp, sample_plan(0.0_wp, 0.01_wp, 601_i8))
      call expect_no_error(it%error, 'the march ends well at tolerance '//to_text(tolerance))
      error_found = 0
      do k = 1, size(it%observer%t)
         error_found = max(error_found, maxval(abs(it%observer%y(:, k) - exact(it%observer%t(k)))))
      end do
      steps = it%counts%steps
      call expect(it%counts%rhs_evaluations >= steps .and. it%counts%jacobian_evaluations > 0, 'work is counted')
      call expect(it%observer%reports == steps/64, 'a report every 64 steps')
   end subroutine sampled_error

   !> A step's error is at most the tolerance times (|y| + 1) sqrt(3), with |y| <= 2 (a weighted root mean
   !> square of three states), and adds up over the steps of an undamped oscillator; it falls with the
   !> tolerance. An explicit method would need 6 k/2 = 3e5 steps for the stiff part.
   subroutine accuracy()
      real(wp) :: found, before
      integer(i8) :: steps
      integer :: e
      before = 1
      do e = -4, -10, -2
         call sampled_error(10.0_wp**e, found, steps)
         call expect(found < 6*steps*10.0_wp**e, 'error '//to_text(found)//' at tolerance 1e'//to_text(e))
         call expect(found < 0.1_wp*before, 'the error falls with the tolerance, at 1e'//to_text(e))
         call expect(steps < 10000, 'stiffness does not bind the step: '//to_text(steps)//' steps')
         before = found
      end do
   end subroutine accuracy

   !> Samples come once each, at their very times, the first and the last among them.
   subroutine samples_in_time()
      type(trial) :: it
      type(sample_plan) :: plan
      integer :: k
      plan = sample_plan(0.5_wp, 0.125_wp, 13_i8)
      it = marched(tolerances(1e-8_wp), 0.5_wp, 2.0_wp, plan)
      call expect_no_error(it%error, 'the march ends well')
      associate (samples => it%observer)
         call expect(size(samples%t) == 13, 'as many samples as planned')
         do k = 1, size(samples%t)
            call expect_close(samples%t(k), 0.5_wp + 0.125_wp*(k - 1), 0.0_wp, 'time of sample '//to_text(k))
            call expect_close(plan%time(k - 1_i8), samples%t(k), 0.0_wp, 'planned time of sample '//to_text(k))
         end do
         call expect_close(norm2(samples%y(:, 1) - exact(0.5_wp)), 0.0_wp, 0.0_wp, 'the first sample is the start')
         call expect_close(norm2(samples%y(:, 13) - it%y), 0.0_wp, 4*epsilon(it%y), 'the last sample is the end')
      end associate
      call expect_close(norm2(it%y - exact(2.0_wp)), 0.0_wp, 6*it%counts%steps*1e-8_wp, &
         & 'the state at the end is returned')
   end subroutine samples_in_time

   !> A last sample that rounding puts past the end is taken at the end; a late first one is waited for.
   subroutine last_sample_past_the_end()
      type(trial) :: it
      it = marched(tolerances(1e-8_wp), 0.0_wp, 1.0_wp, sample_plan(0.4_wp, 0.1_wp*(1 + 1e-9_wp), 7_i8))
      call expect(size(it%observer%t) == 7, 'all samples are taken')
      call expect_close(it%observer%t(1), 0.4_wp, 0.0_wp, 'a late first sample')
      call expect_close(it%observer%t(7), 1.0_wp, 0.0_wp, 'a sample just past the end is taken at the end')
      call expect_close(norm2(it%observer%y(:, 1) - exact(0.4_wp)), 0.0_wp, 6*it%counts%steps*1e-8_wp, 'its state')
   end subroutine last_sample_past_the_end

   !> Robertson's reaction at t = 40: reference values to ten digits; mass is conserved by the equations and,
   !> being linear, by the method up to its Newton iteration.
   subroutine chemistry()
      type(robertson) :: model
      type(keeper) :: observer
      type(integrator_counts_type) :: statistics
      type(march_options) :: options
      type(error_type), allocatable :: error
      real(wp), parameter :: expected(3) = [0.7158270688_wp, 9.185534765e-6_wp, 0.2841637457_wp]
      real(wp) :: y(3)
      model%n = 3
      options%relative_tolerance = 1e-8_wp
      options%absolute_tolerance = [1e-10_wp, 1e-14_wp, 1e-10_wp]
      y = [1.0_wp, 0.0_wp, 0.0_wp]
      call march(model, options, 0.0_wp, 40.0_wp, sample_plan(), y, observer, statistics, error)
      call expect_no_error(error, 'Robertson''s reaction ends well')
      call expect(.not. allocated(observer%t), 'no samples where none are planned')
      call expect_close(maxval(abs(y/expected - 1)), 0.0_wp, 6*statistics%steps*1e-8_wp, &
         & 'Robertson''s reaction at t = 40')
      call expect_close(sum(y), 1.0_wp, 1e-8_wp, 'mass is conserved')
   end subroutine chemistry

   !> A problem that has no solution beyond t = 0.5 ends there, with its own words and the time.
   subroutine refusal()
      type(trial) :: it
      integer :: before
      it%model%refuse_after = 0.5_wp
      it%y = exact(0.0_wp)
      call go(it, tolerances(1e-6_wp), 0.0_wp, 1.0_wp, sample_plan(0.0_wp, 0.1_wp, 11_i8))
      call expect_error(it%error, numerics_error, 'the problem ends', 'refusal is an error')
      if (.not. allocated(it%error)) return
      associate (message => it%error%message)
         call expect(index(message, 't = 0.5 s') > 0 .or. index(message, 't = 0.49') > 0, 'gives the time: '//message)
         call expect(index(message, 'after '//to_text(it%counts%steps)//' steps') > 0, 'counts the steps: '//message)
      end associate
      before = size(it%observer%t)
      call expect(before == 5 .or. before == 6, 'samples before the end stand: '//to_text(before))
      call expect_close(norm2(it%observer%y(:, before) - exact(it%observer%t(before))), 0.0_wp, &
         & 6*it%counts%steps*1e-6_wp, 'and are good')
   end subroutine refusal

   !> A refusal at the first evaluation is an error at the start.
   subroutine passing_refusal()
      type(trial) :: it
      it%model%refuse_first = 1
      it%y = exact(0.0_wp)
      call go(it, tolerances(1e-6_wp), 0.0_wp, 1.0_wp, sample_plan())
      call expect_error(it%error, numerics_error, 't = 0 s', 'refusal of the start is an error')
   end subroutine passing_refusal

   subroutine step_limits()
      type(trial) :: it
      type(march_options) :: options
      options = tolerances(1e-6_wp)
      options%max_steps = 20
      it = marched(options, 0.0_wp, 6.0_wp, sample_plan())
      call expect(allocated(it%error), 'too many steps are an error')
      if (allocated(it%error)) call expect(index(it%error%message, 'max_steps') > 0 &
         & .and. index(it%error%message, 't = ') > 0, 'which names the limit and the time: '//it%error%message)
      call expect(it%counts%steps == 20, 'the limit is kept: '//to_text(it%counts%steps)//' steps')
      options = tolerances(1e-2_wp)
      options%max_step = 1e-3_wp
      it = marched(options, 0.0_wp, 1.0_wp, sample_plan())
      call expect(it%counts%steps >= 1000, 'no step is longer than max_step: '//to_text(it%counts%steps)//' steps')
   end subroutine step_limits

   subroutine observer_stops()
      type(trial) :: it
      it%observer%stop_at = 3
      it%y = exact(0.0_wp)
      call go(it, tolerances(1e-6_wp), 0.0_wp, 1.0_wp, sample_plan(0.0_wp, 0.1_wp, 11_i8))
      call expect(allocated(it%error), 'an error of the observer ends the march')
      if (allocated(it%error)) call expect(it%error%message == 'the keeper is full', 'and comes back unchanged')
      call expect(size(it%observer%t) == 3, 'at once')
   end subroutine observer_stops
end program test_marching
