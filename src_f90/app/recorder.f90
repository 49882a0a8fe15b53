!> Watches a march: samples, checkpoints and progress go where they belong.
module recorder
   use kinds, only: wp, i8
   use text, only: to_text
   use errors, only: error_type, raise, stopped
   use march_observer, only: march_observer_type
   use integrator_counts, only: integrator_counts_type
   use loops, only: periodicity, new_periodicity
   use equations_of_motion, only: bearing_model
   use run_file, only: run_file_type
   use run_statistics, only: run_statistics_type
   use provenance, only: running
   use signals, only: stop_requested, stop_reason
   use progress, only: progress_type, wall_clock
   implicit none (type, external)
   private
   public :: recorder_type, init_recorder

   !> Completes each sample on a model of its own, so that sampling never changes the march.
   type, extends(march_observer_type) :: recorder_type
      type(bearing_model) :: model
      !> The model that is marched, for its counters.
      type(bearing_model), pointer :: marched => null()
      type(run_file_type) :: file
      type(progress_type) :: progress
      !> What the run cost before it was resumed.
      type(run_statistics_type) :: earlier
      !> Simulated time reached, s.
      real(wp) :: reached = 0
      real(wp), private :: started = 0, sampling = 0, checkpoints = 0, last_checkpoint = 0
      logical, private :: checkpoint_due = .false.
      type(periodicity), private :: orbit
   contains
      procedure :: sample
      procedure :: report
      procedure :: wants_state
      procedure :: take_state
      !> What the run has cost so far, with these figures of the march.
      procedure :: cost
      procedure :: follow_orbit
   end type recorder_type

contains

   !> Starts the clock.
   subroutine init_recorder(self)
      class(recorder_type), intent(inout) :: self
      self%started = wall_clock()
      self%last_checkpoint = self%started
   end subroutine init_recorder

   !> Readies the watch for a periodic orbit, with what was sampled before the run was resumed.
   subroutine follow_orbit(self)
      class(recorder_type), intent(inout) :: self
      real(wp), allocatable :: y(:, :), z(:, :), tilt(:, :), none(:)
      integer :: passed, n, i
      associate (samples => self%model%scene%output%samples_per_revolution, pads => self%model%scene%pad_count())
         ! the last whole revolution and what came after it; comparing begins with the revolution after
         passed = max(0, int(self%file%samples()/samples) - 1)
         n = int(self%file%samples() - int(passed, i8)*samples)
         self%orbit = new_periodicity(samples, 2 + pads, passed)
         if (n == 0) return
         call self%file%last_samples('journal_y', n, y)
         call self%file%last_samples('journal_z', n, z)
         call self%file%last_samples('pad_tilt', n, tilt)
         allocate (none(pads), source=0.0_wp)
         do i = 1, n
            call self%orbit%add(self%model%positions(self%model%at_rest([y(1, i), z(1, i)], tilt(:, i), none)))
         end do
      end associate
   end subroutine follow_orbit

   subroutine sample(self, t, y, output, error)
      class(recorder_type), intent(inout) :: self
      real(wp), intent(in) :: t, y(:), output(:)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: started
      started = wall_clock()
      call self%model%recall(y, output)
      call self%file%add_sample(self%model, t, y, error)
      self%reached = t
      associate (limit => self%model%scene%integration%stop_when_periodic)
         if (limit > 0) then
            call self%orbit%add(self%model%positions(y))
            self%satisfied = self%orbit%change <= limit
         end if
      end associate
      self%sampling = self%sampling + wall_clock() - started
   end subroutine sample

   subroutine report(self, t, steps)
      class(recorder_type), intent(inout) :: self
      real(wp), intent(in) :: t
      integer(i8), intent(in) :: steps
      real(wp) :: now
      now = wall_clock()
      call self%progress%report(t, steps, now)
      call self%file%beat(int(now - self%started))
      associate (pause => self%model%scene%output%checkpoint_seconds)
         self%checkpoint_due = pause > 0 .and. now - self%last_checkpoint >= pause
      end associate
   end subroutine report

   logical function wants_state(self)
      class(recorder_type), intent(in) :: self
      wants_state = self%checkpoint_due .or. stop_requested()
   end function wants_state

   !> A checkpoint; the last one where a signal asks for the end.
   subroutine take_state(self, t, y, counts, error)
      class(recorder_type), intent(inout) :: self
      real(wp), intent(in) :: t, y(:)
      type(integrator_counts_type), intent(in) :: counts
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: reason
      real(wp) :: started
      self%reached = t
      started = wall_clock()
      if (stop_requested()) then
         reason = stop_reason()//' at t = '//to_text(t)//' s'
         call self%file%checkpoint(t, y, self%cost(counts), stopped, reason, error)
         if (.not. allocated(error)) call raise(error, stopped, reason)
      else
         call self%file%checkpoint(t, y, self%cost(counts), running, '', error)
         call self%progress%note('checkpoint at t = '//to_text(t)//' s')
         self%checkpoint_due = .false.
         self%last_checkpoint = wall_clock()
         self%checkpoints = self%checkpoints + self%last_checkpoint - started
      end if
   end subroutine take_state

   function cost(self, march) result(total)
      class(recorder_type), intent(in) :: self
      type(integrator_counts_type), intent(in) :: march
      type(run_statistics_type) :: total
      total%steps = march%steps
      total%rhs_evaluations = march%rhs_evaluations
      total%jacobian_evaluations = march%jacobian_evaluations
      total%error_test_failures = march%error_test_failures
      total%convergence_failures = march%convergence_failures
      if (associated(self%marched)) then
         total%film_modal = self%marched%film%counters%modal
         total%film_sor = self%marched%film%counters%sor
         total%sor_sweeps = self%marched%film%counters%sweeps
         total%film_seconds = self%marched%film_seconds
      end if
      total%output_seconds = self%sampling
      total%checkpoint_seconds = self%checkpoints
      total%wall_seconds = wall_clock() - self%started
      total = self%earlier + total
   end function cost
end module recorder
