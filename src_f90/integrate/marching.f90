!> A march: an integration that gives samples, states for checkpoints and its progress to an observer.
module marching
   use kinds, only: wp, i8
   use text, only: to_text
   use errors, only: error_type, raise, add_context, numerics_error, asked_to_stop
   use ode_model, only: ode_model_type, integrator_counts_type
   use cvode_integrator, only: integrator_type, integrator_options
   use linear_algebra, only: find_eigenvalues
   implicit none (type, external)
   private
   public :: march, march_options, sample_plan, march_observer_type, order_control_type, stable_order

   !> Steps that are looked at together.
   integer(i8), parameter :: window = 250
   !> Windows in a row with short steps before low orders are first tried; windows with low orders before high ones are
   !> tried again; and how many times as many after a trial in vain.
   integer, parameter :: first_wait = 4, stay = 40, longer = 4
   !> Windows of a half of a trial. In the first, what the orders before have left dies away; the trial ends with it
   !> where it does not go the same part of the way. How much further than before the second must go for low orders to
   !> stay; high ones stay where they go no less far.
   integer, parameter :: half = 2
   real(wp), parameter :: part = 0.5_wp, gain = 1.5_wp
   !> Damping ratios from which on vibrations of any frequency are stable with the orders 2 to 5.
   real(wp), parameter :: stable_damping(2:5) = [0.0_wp, 0.0692_wp, 0.2865_wp, 0.6180_wp]
   !> Radians of a vibration in a step below which the steps resolve it, whatever the order.
   real(wp), parameter :: resolved = 0.2_wp

   type :: order_control_type
      !> Mean step, s, below which low orders are tried; 0: they never are.
      real(wp) :: short_step = 0
      !> Time at the end of the last window, s, where the march begins at first.
      real(wp) :: time = 0
      !> Whether low orders are in force; whether the orders in force are on trial.
      logical :: low = .false.
      logical, private :: tried = .false.
      !> Mean step before the trial, s.
      real(wp) :: mean_step = 0
      !> Where the steps that count began, s; windows since then, and how many of these lead to a trial.
      real(wp), private :: since = 0
      integer, private :: windows = 0, wait = first_wait
   contains
      procedure :: changes
   end type order_control_type

   type, extends(integrator_options) :: march_options
      !> Most steps before the march gives up.
      integer(i8) :: max_steps = huge(1_i8)
      !> Mean step, s, below which low orders are tried; 0: they never are.
      real(wp) :: short_step = 0
      !> Asked now and then by who marches period by period (march_settings), where it is set.
      procedure(asked_to_stop), pointer, nopass :: give_up => null()
   end type march_options

   !> When the observer sees the state: at first + k interval, k = 0 .. count - 1; those before `next` it has seen.
   type :: sample_plan
      real(wp) :: first = 0, interval = 0
      integer(i8) :: count = 0, next = 0
   contains
      procedure :: time => sample_time
   end type sample_plan

   !> Who receives the samples of a march.
   type, abstract :: march_observer_type
      !> Set by the observer: the march has reached what it was for, and ends.
      logical :: satisfied = .false.
   contains
      procedure(take_sample), deferred :: sample
      procedure(take_progress), deferred :: report
      !> True where the observer wants the state in which the next step starts; asked before every step.
      procedure :: wants_state
      !> The state at time t, s; all samples up to it were given. Setting `error` ends the march.
      procedure :: take_state
   end type march_observer_type

   abstract interface
      !> The state y at a sample time t, s, and the model's outputs; setting `error` ends the march.
      subroutine take_sample(self, t, y, output, error)
         import :: error_type, march_observer_type, wp
         class(march_observer_type), intent(inout) :: self
         real(wp), intent(in) :: t, y(:), output(:)
         type(error_type), allocatable, intent(out) :: error
      end subroutine take_sample

      !> Called now and then with the time reached, s, and the steps done.
      subroutine take_progress(self, t, steps)
         import :: i8, march_observer_type, wp
         class(march_observer_type), intent(inout) :: self
         real(wp), intent(in) :: t
         integer(i8), intent(in) :: steps
      end subroutine take_progress
   end interface

   !> Steps between two calls of the observer's report.
   integer(i8), parameter :: steps_per_report = 64

contains

   !> Time of sample k = 0, 1, ..., s.
   pure function sample_time(self, k) result(t)
      class(sample_plan), intent(in) :: self
      integer(i8), intent(in) :: k
      real(wp) :: t
      t = self%first + real(k, wp)*self%interval
   end function sample_time

   !> Marches y from t_start to t_end, s, or until the observer is satisfied. Numerics errors say why, where and when
   !> the march stopped; samples taken before them stand.
   subroutine march(model, options, t_start, t_end, plan, y, observer, counts, error)
      class(ode_model_type), intent(inout), target :: model
      type(march_options), intent(in) :: options
      real(wp), intent(in) :: t_start, t_end
      type(sample_plan), intent(in) :: plan
      !> State at t_start on entry, at the time reached on return.
      real(wp), intent(inout) :: y(:)
      class(march_observer_type), intent(inout) :: observer
      type(integrator_counts_type), intent(out) :: counts
      type(error_type), allocatable, intent(out) :: error
      type(integrator_type) :: integrator
      type(integrator_counts_type) :: earlier
      type(order_control_type) :: watch
      real(wp) :: t
      !> Number of the sample that comes next; the highest order in force.
      integer(i8) :: next
      integer :: order

      t = t_start
      watch = order_control_type(options%short_step, t)
      order = options%max_order
      next = plan%next
      call integrator%start(model, options, t, y, t_end, error)
      if (allocated(error)) call add_context(error, stopped_at(t, counts%steps))
      do while (.not. allocated(error))
         call give_samples()
         if (allocated(error) .or. observer%satisfied .or. t >= t_end) exit
         if (observer%wants_state()) call observer%take_state(t, integrator%state(), earlier + integrator%counts(), &
            & error)
         if (allocated(error)) exit
         if (counts%steps >= options%max_steps) then
            call raise(error, numerics_error, 'the march gave up at t = '//to_text(t)//' s, after ' &
               & //to_text(counts%steps)//' steps (integration%max_steps)')
            exit
         end if
         if (watch%changes(t, counts%steps)) call change_orders()
         if (.not. allocated(error)) call integrator%step(error)
         t = integrator%time()
         if (allocated(error)) then
            call add_context(error, stopped_at(t, counts%steps))
            exit
         end if
         counts%steps = counts%steps + 1
         if (mod(counts%steps, steps_per_report) == 0) call observer%report(t, counts%steps)
      end do
      y = integrator%state()
      counts = earlier + integrator%counts()
   contains

      !> Goes on from the state reached, whose samples are given, with all orders, or with those that are stable in
      !> every vibration.
      subroutine change_orders()
         type(march_options) :: changed
         real(wp) :: rates(model%n), jacobian(model%n, model%n)
         logical :: ok
         changed = options
         if (watch%low) then
            call model%rhs_and_jacobian(integrator%time(), integrator%state(), rates, jacobian, ok)
            if (ok) changed%max_order = min(options%max_order, stable_order(jacobian, watch%mean_step))
         end if
         if (changed%max_order == order) return
         order = changed%max_order
         earlier = earlier + integrator%counts()
         call integrator%start(model, changed, integrator%time(), integrator%state(), t_end, error)
      end subroutine change_orders

      !> Gives the observer the samples that the time reached has passed. They never shorten a step.
      subroutine give_samples()
         real(wp) :: values(model%n + model%outputs), at
         do while (next < plan%count)
            if (plan%time(next) > t .and. t < t_end) return
            ! the last sample may lie a rounding error past the end
            at = min(plan%time(next), t)
            call integrator%interpolate(at, values)
            call observer%sample(at, values(:model%n), values(model%n + 1:), error)
            if (allocated(error) .or. observer%satisfied) return
            next = next + 1
         end do
      end subroutine give_samples
   end subroutine march

   function stopped_at(t, steps) result(context)
      real(wp), intent(in) :: t
      integer(i8), intent(in) :: steps
      character(len=:), allocatable :: context
      context = 'the march stopped at t = '//to_text(t)//' s, after '//to_text(steps)//' steps'
   end function stopped_at

   logical function wants_state(self)
      class(march_observer_type), intent(in) :: self
      wants_state = .false.
   end function wants_state

   subroutine take_state(self, t, y, counts, error)
      class(march_observer_type), intent(inout) :: self
      real(wp), intent(in) :: t, y(:)
      type(integrator_counts_type), intent(in) :: counts
      type(error_type), allocatable, intent(out) :: error
   end subroutine take_state

   ! Watches how far the steps of a march go, and says when low orders may go further: in a light vibration BDF of the
   ! orders 3 to 5 is unstable, so that the error test keeps the steps short where nothing happens.

   !> True where the orders change now, at time t, s, after this many steps: to those of `low`.
   logical function changes(self, t, steps)
      class(order_control_type), intent(inout) :: self
      real(wp), intent(in) :: t
      integer(i8), intent(in) :: steps
      changes = .false.
      if (mod(steps, window) /= 0) return
      self%windows = self%windows + 1
      if (self%windows == 1) self%since = self%time
      if (self%tried) then
         call judge_trial(self, t, changes)
      else
         if (.not. self%low .and. t - self%time > window*self%short_step) self%windows = 0
         changes = self%windows == self%wait
         if (changes) self%mean_step = (t - self%since)/(self%wait*window)
      end if
      self%time = t
      if (.not. changes) return
      self%low = .not. self%low
      self%tried = .not. self%tried
      self%windows = 0
   end function changes

   !> After each half of a trial, at time t, s: whether it was in vain. Where it was not, its orders stay.
   subroutine judge_trial(self, t, in_vain)
      class(order_control_type), intent(inout) :: self
      real(wp), intent(in) :: t
      logical, intent(out) :: in_vain
      real(wp) :: least
      in_vain = .false.
      if (mod(self%windows, half) /= 0) return
      least = part
      if (self%windows > half) least = merge(gain, 1.0_wp, self%low)
      in_vain = t - self%since < least*half*window*self%mean_step
      self%since = t
      if (in_vain) then
         self%wait = longer*self%wait
      else if (self%windows > half) then
         self%wait = merge(stay, first_wait, self%low)
         self%tried = .false.
         self%windows = 0
      end if
   end subroutine judge_trial

   !> The highest order that is stable in all vibrations that steps of this length, s, do not resolve, of a motion with
   !> this Jacobian.
   integer function stable_order(jacobian, step) result(order)
      real(wp), intent(in) :: jacobian(:, :), step
      complex(wp) :: values(size(jacobian, 1))
      logical :: ok
      call find_eigenvalues(jacobian, values, ok)
      do order = ubound(stable_damping, 1), lbound(stable_damping, 1) + 1, -1
         if (ok .and. all(-values%re >= stable_damping(order)*abs(values) .or. abs(values%im)*step < resolved)) return
      end do
   end function stable_order
end module marching
