!> Watches a march: samples, checkpoints and progress go where they belong.
module recorder
   use kinds, only: wp, i8
   use text, only: to_text
   use errors, only: error_type, raise, stopped
   use marching, only: march_observer_type
   use ode_model, only: integrator_counts_type
   use loops, only: periodicity, new_periodicity
   use bearing_samples, only: bearing_sample, take_sample
   use march_results, only: add_sample
   use stop_signals, only: stop_requested, stop_reason
   use case_run, only: case_run_type
   use clock, only: wall_clock
   use progress, only: progress_type, new_progress
   implicit none (type, external)
   private
   public :: recorder_type, begin_recording

   type, extends(march_observer_type) :: recorder_type
      type(case_run_type), pointer, private :: run => null()
      type(progress_type) :: progress
      logical, private :: checkpoint_due = .false.
      type(periodicity), private :: orbit
      !> The last sample, and how many there were; its memory is used again.
      type(bearing_sample), private :: taken
      integer(i8), private :: samples = 0
   contains
      procedure :: sample
      procedure :: report
      procedure :: wants_state
      procedure :: take_state
      procedure, private :: record
      procedure, private :: follow_orbit
   end type recorder_type

   !> One of this number of samples is timed.
   integer(i8), parameter :: timing_stride = 16

contains

   !> Readies the recording of a run's march from time t, s; its file has its series.
   subroutine begin_recording(self, run, t)
      type(recorder_type), intent(out) :: self
      type(case_run_type), intent(inout), target :: run
      real(wp), intent(in) :: t
      self%run => run
      self%progress = new_progress(t, run%inputs%operation%duration, run%quiet)
      if (run%inputs%integration%stop_when_periodic > 0) call self%follow_orbit()
   end subroutine begin_recording

   !> Readies the watch for a periodic orbit, with what was sampled before the run was resumed.
   subroutine follow_orbit(self)
      class(recorder_type), intent(inout) :: self
      real(wp), allocatable :: y(:, :), z(:, :), tilt(:, :), none(:)
      integer :: passed, n, i, watched
      associate (samples => self%run%inputs%output%samples_per_revolution, pads => self%run%inputs%pad_count())
         ! the last whole revolution and what came after it; comparing begins with the revolution after
         passed = max(0, int(self%run%file%samples/samples) - 1)
         n = int(self%run%file%samples - int(passed, i8)*samples)
         watched = 2 + merge(pads, 0, self%run%inputs%tilting())
         self%orbit = new_periodicity(samples, watched, passed)
         if (n == 0) return
         call self%run%file%last_samples('journal_y', n, y)
         call self%run%file%last_samples('journal_z', n, z)
         if (self%run%inputs%tilting()) then
            call self%run%file%last_samples('pad_tilt', n, tilt)
         else
            allocate (tilt(pads, n), source=0.0_wp)
         end if
         allocate (none(pads), source=0.0_wp)
         do i = 1, n
            call self%orbit%add(self%run%model%positions(self%run%model%static_state([y(1, i), z(1, i)], tilt(:, i), &
               & none)))
         end do
      end associate
   end subroutine follow_orbit

   !> Some samples are timed, for all; writing times itself.
   subroutine sample(self, t, y, output, error)
      class(recorder_type), intent(inout) :: self
      real(wp), intent(in) :: t, y(:), output(:)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: started
      logical :: timed
      timed = mod(self%samples, timing_stride) == timing_stride - 1
      if (timed) started = wall_clock() - self%run%file%writing_seconds()
      call self%record(t, y, output, error)
      if (timed) self%run%sampling = self%run%sampling &
         & + timing_stride*(wall_clock() - self%run%file%writing_seconds() - started)
      self%samples = self%samples + 1
   end subroutine sample

   !> Adds a sample to the file, and looks whether the orbit repeats.
   subroutine record(self, t, y, output, error)
      class(recorder_type), intent(inout) :: self
      real(wp), intent(in) :: t, y(:), output(:)
      type(error_type), allocatable, intent(out) :: error
      call take_sample(self%run%model, t, y, output, 1, self%taken)
      call add_sample(self%run%file, self%taken, error)
      call self%run%extremes%add(self%taken)
      self%run%reached = t
      associate (limit => self%run%inputs%integration%stop_when_periodic)
         if (limit > 0) then
            call self%orbit%add(self%run%model%positions(y))
            self%satisfied = self%orbit%change <= limit
         end if
      end associate
   end subroutine record

   subroutine report(self, t, steps)
      class(recorder_type), intent(inout) :: self
      real(wp), intent(in) :: t
      integer(i8), intent(in) :: steps
      real(wp) :: now
      now = wall_clock()
      call self%progress%report(t, steps, now)
      call self%run%file%beat(int(now - self%run%started))
      self%checkpoint_due = self%run%wants_checkpoint(now)
   end subroutine report

   logical function wants_state(self)
      class(recorder_type), intent(in) :: self
      wants_state = self%checkpoint_due
      if (.not. wants_state) wants_state = stop_requested()
   end function wants_state

   !> A checkpoint; the last one where a signal asks for the end.
   subroutine take_state(self, t, y, counts, error)
      class(recorder_type), intent(inout) :: self
      real(wp), intent(in) :: t, y(:)
      type(integrator_counts_type), intent(in) :: counts
      type(error_type), allocatable, intent(out) :: error
      self%run%reached = t
      self%run%counts = counts
      if (stop_requested()) then
         call raise(error, stopped, stop_reason()//' at t = '//to_text(t)//' s')
         call self%run%stop_here(t, error, y)
      else
         call self%run%checkpoint(t, error, y)
         call self%progress%note('checkpoint at t = '//to_text(t)//' s')
         self%checkpoint_due = .false.
      end if
   end subroutine take_state
end module recorder
