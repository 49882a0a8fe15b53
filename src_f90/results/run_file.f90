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
   use recent_samples, only: recent_samples_type
   use result_size, only: figure_samples
   use summary_group, only: put_figure
   use machine_results, only: put_bearings
   use provenance, only: provenance_type, running
   use run_statistics, only: run_statistics_type
   implicit none (type, external)
   private
   public :: run_file_type

   type, extends(record_type) :: run_file_type
      !> Whether the results go to a file, which of the samples (output%keep), and how many of the last are wanted.
      logical :: filed = .true.
      character(len=:), allocatable, private :: keep
      integer(i8), private :: wanted = 0
      character(len=:), allocatable, private :: axis
      type(growing_file_type) :: hdf5
      !> Whether the series have names.
      logical :: declared = .false.
      type(recent_samples_type), private :: recent
      !> Samples added, also before the run was resumed.
      integer(i8) :: samples = 0
      type(provenance_type), private :: provenance
   contains
      procedure :: start
      procedure :: reopen
      procedure :: resume
      procedure :: put_tag
      !> Datasets, and series.
      procedure :: has => has_result
      procedure :: begin_series
      procedure :: declare
      procedure :: add
      procedure :: first_sample
      procedure :: last_samples
      procedure :: part_of_samples
      procedure :: begin_checkpoint
      procedure :: checkpoint
      procedure :: finish
      procedure :: publish
      procedure :: abandon
      procedure :: beat
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
   subroutine resume(self, inputs, t, statistics, error, state)
      class(run_file_type), intent(inout) :: self
      type(case_type), intent(in) :: inputs
      real(wp), intent(out) :: t
      !> The list of figures, which get the values in the file.
      type(run_statistics_type), intent(inout) :: statistics
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
      call statistics%read(self%record_type)
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

   logical function has_result(self, path)
      class(run_file_type), intent(in) :: self
      character(len=*), intent(in) :: path
      has_result = self%record_type%has(path)
      if (has_result) return
      if (self%keep == 'all') then
         has_result = self%hdf5%has(path)
      else
         has_result = self%recent%has(path)
      end if
   end function has_result

   !> Series over an axis, 'time' or another, follow; they start from the samples that are in the file, if any.
   !> `expected`: how many there will be in the end, if this is known.
   subroutine begin_series(self, axis, expected)
      class(run_file_type), intent(inout) :: self
      character(len=*), intent(in) :: axis
      integer(i8), intent(in) :: expected
      logical :: ok
      self%axis = axis
      if (self%keep == 'all') then
         ! the scales of the series
         call write_record(self, self%hdf5, .false.)
         call self%hdf5%begin_series(axis, expected)
         self%samples = self%hdf5%samples
         self%declared = .false.
      else
         call self%recent%begin(int(min(self%wanted, expected)))
         call self%recent%restore(self%record_type, ok)
         if (.not. ok) call self%hdf5%check_read(-1, 'find all samples of the checkpoint')
         self%samples = self%recent%count
         self%declared = size(self%recent%series) > 0
      end if
   end subroutine begin_series

   !> A series of this number of values over the axis, or, where `across` names another scale, over both.
   subroutine declare(self, name, width, across, units, long_name)
      class(run_file_type), intent(inout) :: self
      character(len=*), intent(in) :: name, across, units, long_name
      integer, intent(in) :: width
      if (self%keep == 'all') then
         call self%hdf5%declare(name, width, across, units, long_name)
      else
         call self%recent%declare(name, width, across, units, long_name)
      end if
      self%declared = .true.
   end subroutine declare

   !> A sample: the values of all series, in the order in which they were declared.
   subroutine add(self, values)
      class(run_file_type), intent(inout) :: self
      real(wp), intent(in), contiguous :: values(:)
      if (self%keep == 'all') then
         call self%hdf5%add(values)
      else
         call self%recent%add(values)
      end if
      self%samples = self%samples + 1
   end subroutine add

   !> Number of the first sample, from 0, from which on all are kept.
   pure integer(i8) function first_sample(self)
      class(run_file_type), intent(in) :: self
      first_sample = 0
      if (self%keep /= 'all') first_sample = self%recent%first()
   end function first_sample

   !> The last n samples of a series, (width, n); n at most those that are kept.
   subroutine last_samples(self, name, n, values)
      class(run_file_type), intent(inout) :: self
      character(len=*), intent(in) :: name
      integer, intent(in) :: n
      real(wp), allocatable, intent(out) :: values(:, :)
      call self%part_of_samples(name, self%samples - n, n, values)
   end subroutine last_samples

   !> The n samples of a series behind the first `skip` ones, (width, n): all kept, or the first one alone.
   subroutine part_of_samples(self, name, skip, n, values)
      class(run_file_type), intent(inout) :: self
      character(len=*), intent(in) :: name
      integer(i8), intent(in) :: skip
      integer, intent(in) :: n
      real(wp), allocatable, intent(out) :: values(:, :)
      if (self%keep == 'all') then
         call self%hdf5%part_of_samples(name, skip, n, values)
      else
         call self%recent%part(name, skip, n, values)
      end if
   end subroutine part_of_samples

   !> Begins a new checkpoint, at time t, s: what the run goes on from belongs into its group.
   subroutine begin_checkpoint(self, t)
      class(run_file_type), intent(inout) :: self
      real(wp), intent(in) :: t
      ! what it holds may have another size than in the last
      call self%delete('checkpoint')
      call self%put_real('checkpoint/time', t, 's', 'time from which the run can go on')
   end subroutine begin_checkpoint

   !> Publishes what there is, with the checkpoint that was begun or, of a march, with the state y. With an exit status
   !> other than `running`, which needs its reason, this is the end of the file's writing. What is not filed has none.
   subroutine checkpoint(self, t, statistics, status, reason, error, y)
      class(run_file_type), intent(inout) :: self
      real(wp), intent(in) :: t
      type(run_statistics_type), intent(in) :: statistics
      integer, intent(in) :: status
      character(len=*), intent(in) :: reason
      type(error_type), allocatable, intent(out) :: error
      real(wp), intent(in), optional :: y(:)
      if (.not. self%filed) return
      if (present(y)) then
         call self%begin_checkpoint(t)
         call self%put_list('checkpoint/state', y, '1', 'state of the march at that time', '')
         if (self%keep /= 'all') call self%recent%save(self%record_type)
      end if
      call statistics%write(self%record_type)
      call self%provenance%note(self%record_type, t, status, reason)
      call self%publish(status == running, error)
   end subroutine checkpoint

   !> Closes the file and publishes it. An exit status other than 0 needs its reason; t is the simulated time
   !> reached, s.
   subroutine finish(self, t, statistics, status, reason, error)
      class(run_file_type), intent(inout) :: self
      real(wp), intent(in) :: t
      type(run_statistics_type), intent(in) :: statistics
      integer, intent(in) :: status
      character(len=*), intent(in) :: reason
      type(error_type), allocatable, intent(out) :: error
      call self%delete('checkpoint')
      call statistics%write(self%record_type)
      call self%provenance%note(self%record_type, t, status, reason)
      if (status == 0) call self%put_flag('complete', 1)
      if (.not. self%filed) return
      if (self%keep == 'last_revolutions') call write_recent(self)
      call self%publish(.false., error)
   end subroutine finish

   !> Writes the samples that were held in memory.
   subroutine write_recent(self)
      class(run_file_type), intent(inout) :: self
      integer(i8) :: k
      if (self%samples == 0) return
      call write_record(self, self%hdf5, .false.)
      call self%hdf5%begin_series(self%axis, self%samples - self%recent%first())
      do k = 1, size(self%recent%series)
         associate (own => self%recent%series(k))
            call self%hdf5%declare(own%name, own%width, own%across, own%units, own%long_name)
         end associate
      end do
      do k = self%recent%first(), self%samples - 1
         call self%hdf5%add(self%recent%sample(k))
      end do
   end subroutine write_recent

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
   subroutine beat(self, now)
      class(run_file_type), intent(inout) :: self
      integer, intent(in) :: now
      if (self%filed) call self%hdf5%working%beat(now)
   end subroutine beat

   subroutine error_of(self, error)
      class(run_file_type), intent(in) :: self
      type(error_type), allocatable, intent(out) :: error
      if (self%filed) call self%hdf5%error_of(self%hdf5%working%path, error)
   end subroutine error_of
end module run_file
