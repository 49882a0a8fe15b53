!> Watches a march: samples, checkpoints and progress go where they belong.
module recorder
   use kinds, only: wp, i8, pi
   use text, only: to_text
   use errors, only: error_type, raise, stopped
   use marching, only: march_observer_type
   use ode_model, only: integrator_counts_type
   use loops, only: periodicity, new_periodicity
   use state_layout, only: pad_state, tilt
   use operating_point, only: operating_point_type
   use bearing_samples, only: bearing_sample, take_sample, element_forces, element_positions
   use march_results, only: add_sample, put_spectra
   use machine_results, only: put_turned_rotor
   use result_size, only: sample_interval
   use bearing_file, only: bearing_file_type
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
      !> The last sample of each bearing, and how many there were; their memory is used again.
      type(bearing_sample), allocatable, private :: taken(:)
      type(bearing_file_type), allocatable, private :: bearings(:)
      !> y and z of the stations in the last sample, (2, station), m.
      real(wp), allocatable, private :: stations(:, :)
      !> Forces of the excitations, (2, excitation), and of other elements, N, and the displacements of these, m,
      !> (2, element, force and displacement), in the last sample.
      real(wp), allocatable, private :: excitations(:, :), elements(:, :, :)
      !> All values of a sample.
      real(wp), allocatable, private :: values(:)
      integer(i8), private :: samples = 0
   contains
      procedure :: sample
      procedure :: report
      procedure :: wants_state
      procedure :: take_state
      procedure :: put_spectra => put_all_spectra
   end type recorder_type

   !> One of this number of samples is timed.
   integer(i8), parameter :: timing_stride = 16

contains

   !> Readies the recording of a run's march from time t, s; its file has its series.
   subroutine begin_recording(self, run, t)
      type(recorder_type), intent(out) :: self
      type(case_run_type), intent(inout), target :: run
      real(wp), intent(in) :: t
      integer :: b
      self%run => run
      allocate (self%taken(size(run%inputs%bearings)), self%bearings(size(run%inputs%bearings)))
      do b = 1, size(self%bearings)
         self%bearings(b) = run%bearing(b)
      end do
      allocate (self%stations(2, run%model%rotor%stations), self%excitations(2, size(run%inputs%excitations)), &
         & self%elements(2, run%model%rotor%elements + size(run%model%others), 2))
      self%progress = new_progress(t, run%inputs%operation%duration, run%quiet)
      if (run%inputs%integration%stop_when_periodic > 0) call follow_orbit(self)
   end subroutine begin_recording

   !> Readies the watch for a periodic orbit, with what was sampled before the run was resumed.
   subroutine follow_orbit(self)
      class(recorder_type), intent(inout) :: self
      real(wp), allocatable :: rotor(:, :), values(:, :)
      type(pad_state), allocatable :: pads(:, :)
      integer :: passed, n, b, i
      associate (samples => self%run%inputs%output%samples_per_revolution, model => self%run%model)
         ! the last whole revolution and what came after it; comparing begins with the revolution after
         passed = max(0, int(self%run%file%hdf5%samples/samples) - 1)
         n = int(self%run%file%hdf5%samples - int(passed, i8)*samples)
         self%orbit = new_periodicity(samples, 2*model%rotor%journals + size(model%layout%tilts()), passed)
         if (n == 0) return
         allocate (rotor(model%rotor%positions, n), source=0.0_wp)
         allocate (pads(model%layout%pads, n))
         do b = 1, size(self%bearings)
            call self%bearings(b)%last_samples('journal_y', n, values)
            rotor(2*b - 1, :) = values(1, :)
            call self%bearings(b)%last_samples('journal_z', n, values)
            rotor(2*b, :) = values(1, :)
            if (.not. model%layout%elements(b)%has(tilt)) cycle
            call self%bearings(b)%last_samples('pad_tilt', n, values)
            pads(model%layout%elements(b)%all_pads(), :)%x(tilt) = values
         end do
         do i = 1, n
            call self%orbit%add(watched(self, model%static_state(rotor(:, i), pads(:, i))))
         end do
      end associate
   end subroutine follow_orbit

   !> What tells whether the orbit repeats: the journals in their bearings, and the tilts.
   pure function watched(self, y)
      class(recorder_type), intent(in) :: self
      real(wp), intent(in) :: y(:)
      real(wp), allocatable :: watched(:)
      watched = self%run%model%positions(y)
      associate (rotor => self%run%model%rotor)
         watched = [watched(:2*rotor%journals), watched(rotor%positions + 1:)]
      end associate
   end function watched

   !> Some samples are timed, for all; writing times itself.
   subroutine sample(self, t, y, output, error)
      class(recorder_type), intent(inout) :: self
      real(wp), intent(in) :: t, y(:), output(:)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: started
      logical :: timed
      timed = mod(self%samples, timing_stride) == timing_stride - 1
      if (timed) started = wall_clock() - self%run%file%hdf5%writing_seconds
      call record(self, t, y, output, error)
      if (timed) self%run%sampling = self%run%sampling &
         & + timing_stride*(wall_clock() - self%run%file%hdf5%writing_seconds - started)
      self%samples = self%samples + 1
   end subroutine sample

   !> Adds a sample to the file, and looks whether the orbit repeats.
   subroutine record(self, t, y, output, error)
      class(recorder_type), intent(inout) :: self
      real(wp), intent(in) :: t, y(:), output(:)
      type(error_type), allocatable, intent(out) :: error
      integer :: b
      do b = 1, size(self%taken)
         call take_sample(self%run%model, t, y, output, b, self%taken(b))
         call self%run%extremes(b)%add(self%taken(b))
      end do
      associate (rotor => self%run%model%rotor)
         if (rotor%stations > 0) then
            self%stations(:, :) = rotor%station_displacements(y(:rotor%states))
            if (is_turned(self%run%model%point, t, sample_interval(self%run%inputs))) call put_turned_rotor( &
               & self%run%file, t, y(:rotor%states))
         end if
      end associate
      if (size(self%excitations) > 0) self%excitations(:, :) = self%run%model%point%excitation_forces(t)
      if (size(self%elements) > 0) then
         self%elements(:, :, 1) = element_forces(self%run%model, t, y)
         self%elements(:, :, 2) = element_positions(self%run%model, y)
      end if
      call add_sample(self%run%file, self%run%model%point, t, self%bearings, self%taken, self%stations, &
         & self%excitations, self%elements, self%values, error)
      self%run%reached = t
      associate (limit => self%run%inputs%integration%stop_when_periodic)
         if (limit > 0) then
            call self%orbit%add(watched(self, y))
            self%satisfied = self%orbit%change <= limit
         end if
      end associate
   end subroutine record

   !> Whether the shaft has turned whole revolutions at a time, as closely as samples at this interval are, s.
   pure logical function is_turned(point, t, interval)
      type(operating_point_type), intent(in) :: point
      real(wp), intent(in) :: t, interval
      associate (angle => point%shaft_angle(t))
         is_turned = abs(angle - 2*pi*anint(angle/(2*pi))) <= 0.501_wp*point%speed(t)*interval
      end associate
   end function is_turned

   !> Writes the spectra of all bearings, from samples at this interval, s; the row of a run without file has none.
   subroutine put_all_spectra(self, interval)
      class(recorder_type), intent(inout) :: self
      real(wp), intent(in) :: interval
      integer :: b
      if (.not. self%run%file%filed) return
      do b = 1, size(self%bearings)
         call put_spectra(self%bearings(b), self%run%inputs, b, interval)
      end do
   end subroutine put_all_spectra

   subroutine report(self, t, steps)
      class(recorder_type), intent(inout) :: self
      real(wp), intent(in) :: t
      integer(i8), intent(in) :: steps
      real(wp) :: now
      now = wall_clock()
      call self%progress%report(t, steps, now)
      call self%run%file%heartbeat(int(now - self%run%started))
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
