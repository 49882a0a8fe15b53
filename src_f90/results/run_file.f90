!> The results of a run: a record of them, its samples, and the file that both go to, with its checkpoints, how a run
!> goes on from one, and its end. A run of a study may have no file. Where not all samples are kept, the last are in
!> memory.
module run_file
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp, i8, pi
   use errors, only: error_type, raise, system_error
   use case_inputs, only: case_type
   use namelist_writer, only: namelist_of
   use parameter_study, only: run_tag
   use record, only: record_type
   use record_file, only: write_record, read_record
   use growing_file, only: growing_file_type
   use result_size, only: figure_samples
   use summary_group, only: put_figure
   use machine_results, only: put_bearings
   use provenance, only: provenance_type, running
   implicit none (type, external)
   private
   public :: run_file_type

   type, extends(record_type) :: run_file_type
      !> Whether the results go to a file, which of the samples (output%keep), and how many of the last are wanted.
      logical :: filed = .true.
      character(len=:), allocatable, private :: keep
      integer(i8), private :: wanted = 0
      !> The samples, and the file.
      type(growing_file_type) :: hdf5
      type(provenance_type), private :: provenance
   contains
      procedure :: start
      procedure :: reopen
      procedure :: resume
      procedure :: put_tag
      procedure :: begin_series
      procedure :: sampled_revolutions
      procedure :: last_revolutions
      procedure :: begin_checkpoint
      procedure :: checkpoint
      procedure :: finish
      procedure :: publish
      procedure :: abandon
      procedure :: heartbeat
      !> What has gone wrong with the file so far.
      procedure :: error_of
   end type run_file_type

contains

   !> Starts the results of a case, in a file under the name claimed if they are filed, with its resolved namelist.
   subroutine start(self, inputs, error)
      class(run_file_type), intent(inout) :: self
      type(case_type), intent(in) :: inputs
      type(error_type), allocatable, intent(out) :: error
      self%keep = inputs%output%keep
      self%wanted = figure_samples(inputs)
      if (self%filed) then
         call self%hdf5%begin(error)
         if (allocated(error)) then
            call self%abandon()
            return
         end if
      end if
      call self%provenance%begin(self%record_type, .not. inputs%rotor%is_rigid())
      call self%put_flag('complete', 0)
      call self%put_text('title', inputs%about%title)
      call self%put_text('task', inputs%about%task)
      if (self%filed) call self%put_text('input', namelist_of(inputs))
      if (allocated(inputs%about%of_paper)) call self%put_text('of_paper', inputs%about%of_paper)
      call put_bearings(self, inputs)
      if (inputs%about%task /= 'branch') call put_figure(self, 'speed', inputs%operation%speed_rpm*pi/30, 'rad/s', &
         & 'shaft speed at the end')
      if (.not. self%filed) return
      call write_record(self, self%hdf5, .false.)
      call self%error_of(error)
      if (allocated(error)) call self%abandon()
   end subroutine start

   !> Opens a copy of the file of the name claimed, to change it; the record has all of it but its series.
   subroutine reopen(self, inputs, error)
      class(run_file_type), intent(inout) :: self
      type(case_type), intent(in) :: inputs
      type(error_type), allocatable, intent(out) :: error
      self%keep = inputs%output%keep
      self%wanted = figure_samples(inputs)
      call self%hdf5%reopen(error)
      if (allocated(error)) return
      call read_record(self%hdf5, self%record_type)
      call self%error_of(error)
   end subroutine reopen

   !> Continues the file of the name claimed from its checkpoint: simulated time t, s, and state.
   subroutine resume(self, inputs, t, error, state)
      class(run_file_type), intent(inout) :: self
      type(case_type), intent(in) :: inputs
      real(wp), intent(out) :: t
      type(error_type), allocatable, intent(out) :: error
      !> Of a march; of the size that the case has.
      real(wp), intent(inout), optional :: state(:)
      character(len=:), allocatable :: history
      logical :: ok
      t = 0
      call self%reopen(inputs, error)
      if (.not. allocated(error)) then
         t = self%get_real('checkpoint/time')
         call self%get_text('history', history)
         ok = self%has('statistics/steps')
         if (ok) ok = self%has('checkpoint/time')
         ok = ok .and. ieee_is_finite(t) .and. history /= ''
         if (present(state)) then
            if (ok) ok = self%list_size('checkpoint/state') == size(state)
            call self%get_list('checkpoint/state', state)
            ok = ok .and. all(ieee_is_finite(state))
         end if
         if (.not. ok) call raise(error, system_error, self%hdf5%working%path//': damaged: its checkpoint is not whole')
      end if
      if (allocated(error)) then
         call self%abandon()
         return
      end if
      call self%provenance%resume(self%record_type, t)
   end subroutine resume

   !> Notes which run of a study the run is.
   subroutine put_tag(self, tag)
      class(run_file_type), intent(inout) :: self
      type(run_tag), intent(in) :: tag
      call self%put_flag('run', tag%number)
      call self%put_flag('runs', tag%runs)
      call self%put_text('sweep', tag%study)
      call self%put_text('study_marks', tag%marks)
   end subroutine put_tag

   !> Series over an axis, 'time' or another, follow; they start from the samples that there are, if any. `expected`:
   !> how many there will be in the end, if this is known.
   subroutine begin_series(self, axis, expected)
      class(run_file_type), intent(inout) :: self
      character(len=*), intent(in) :: axis
      integer(i8), intent(in) :: expected
      if (self%keep == 'all') then
         ! the scales of the series
         call write_record(self, self%hdf5, .false.)
         call self%hdf5%begin_series(axis, expected)
      else
         call self%hdf5%begin_series(axis, expected, int(min(self%wanted, expected)))
         call self%hdf5%restore(self%record_type)
      end if
   end subroutine begin_series

   !> Revolutions from the first sample to the last.
   real(wp) function sampled_revolutions(self) result(revolutions)
      class(run_file_type), intent(inout) :: self
      real(wp), allocatable :: first(:, :), last(:, :)
      call self%hdf5%part_of_samples('shaft_angle', 0_i8, 1, first)
      call self%hdf5%last_samples('shaft_angle', 1, last)
      revolutions = (last(1, 1) - first(1, 1))/(2*pi)
   end function sampled_revolutions

   !> Samples of the last `count` revolutions, both ends included; all where there are fewer.
   integer function last_revolutions(self, count) result(n)
      class(run_file_type), intent(inout) :: self
      integer, intent(in) :: count
      real(wp), allocatable :: angle(:, :)
      real(wp) :: start
      integer(i8) :: low, high, middle
      high = self%hdf5%samples - 1
      low = self%hdf5%first()
      if (high > low) then
         call self%hdf5%last_samples('shaft_angle', 2, angle)
         ! half a sample more, so that rounding loses none
         start = angle(1, 2) - 2*pi*count - 0.5_wp*(angle(1, 2) - angle(1, 1))
         do while (low < high)
            middle = (low + high)/2
            call self%hdf5%part_of_samples('shaft_angle', middle, 1, angle)
            if (angle(1, 1) < start) then
               low = middle + 1
            else
               high = middle
            end if
         end do
      end if
      n = int(self%hdf5%samples - low)
   end function last_revolutions

   !> Begins a new checkpoint, at time t, s: what the run goes on from belongs into its group.
   subroutine begin_checkpoint(self, t)
      class(run_file_type), intent(inout) :: self
      real(wp), intent(in) :: t
      ! what it holds may have another size than in the last
      call self%delete('checkpoint')
      call self%put('checkpoint/time', t, 's', 'time from which the run can go on')
   end subroutine begin_checkpoint

   !> Publishes what there is, with the checkpoint that was begun or, of a march, with the state y. With an exit status
   !> other than `running`, which needs its reason, this is the end of the file's writing. What is not filed has none.
   subroutine checkpoint(self, t, status, reason, error, y)
      class(run_file_type), intent(inout) :: self
      real(wp), intent(in) :: t
      integer, intent(in) :: status
      character(len=*), intent(in) :: reason
      type(error_type), allocatable, intent(out) :: error
      real(wp), intent(in), optional :: y(:)
      if (.not. self%filed) return
      if (present(y)) then
         call self%begin_checkpoint(t)
         call self%put('checkpoint/state', y, '1', 'state of the march at that time')
         call self%hdf5%save(self%record_type)
      end if
      call self%provenance%note(self%record_type, t, status, reason)
      call self%publish(status == running, error)
   end subroutine checkpoint

   !> Closes the file and publishes it. An exit status other than 0 needs its reason; t is the simulated time
   !> reached, s.
   subroutine finish(self, t, status, reason, error)
      class(run_file_type), intent(inout) :: self
      real(wp), intent(in) :: t
      integer, intent(in) :: status
      character(len=*), intent(in) :: reason
      type(error_type), allocatable, intent(out) :: error
      call self%delete('checkpoint')
      call self%provenance%note(self%record_type, t, status, reason)
      if (status == 0) call self%put_flag('complete', 1)
      if (.not. self%filed) return
      if (self%keep == 'last_revolutions') then
         ! the scales of the series
         call write_record(self, self%hdf5, .false.)
         call self%hdf5%write_kept()
      end if
      call self%publish(.false., error)
   end subroutine finish

   !> Writes all that is not in the file yet and publishes it. With `continued` the writing continues; otherwise the
   !> file is closed.
   subroutine publish(self, continued, error)
      class(run_file_type), intent(inout) :: self
      logical, intent(in) :: continued
      type(error_type), allocatable, intent(out) :: error
      logical :: behind
      call write_record(self, self%hdf5, .false.)
      call self%hdf5%publish(continued, error, behind)
      if (behind .and. .not. allocated(error)) call write_record(self, self%hdf5, .true.)
   end subroutine publish

   subroutine abandon(self)
      class(run_file_type), intent(inout) :: self
      if (self%filed) call self%hdf5%abandon()
   end subroutine abandon

   !> Shows other programs that this one lives; to be called often with a clock, s.
   subroutine heartbeat(self, now)
      class(run_file_type), intent(inout) :: self
      integer, intent(in) :: now
      if (self%filed) call self%hdf5%working%heartbeat(now)
   end subroutine heartbeat

   subroutine error_of(self, error)
      class(run_file_type), intent(in) :: self
      type(error_type), allocatable, intent(out) :: error
      if (self%filed) call self%hdf5%error_of(self%hdf5%working%path, error)
   end subroutine error_of
end module run_file
