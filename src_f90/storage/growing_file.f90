!> A file that grows by samples and can be gone on with.
!>
!> It is written beside its place and put there whole, at checkpoints and at the end, so that a crash at any moment
!> leaves the last checkpoint, or before the first one the previous file as it was.
module growing_file
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp, i8
   use errors, only: error_type, raise, system_error
   use hdf5_file, only: hdf5_type
   use sample_table, only: sample_table_type
   use run_statistics, only: run_statistics_type
   use provenance, only: provenance_type, running
   use working_file, only: working_file_type
   implicit none (type, external)
   private
   public :: growing_file_type

   type :: growing_file_type
      type(working_file_type), private :: place
      !> What is written, for those who extend this, and its series over time.
      type(hdf5_type) :: file
      type(sample_table_type) :: table
      type(provenance_type), private :: provenance
      !> Clock of the last beat, s.
      integer, private :: last_beat = 0
   contains
      !> Locks the place of the file, so that no other run writes it, until `finish`, `abandon` or the last
      !> `checkpoint`.
      procedure :: claim
      procedure :: begin
      procedure :: resume
      procedure :: samples
      procedure :: last_samples
      procedure :: checkpoint
      procedure :: finish
      !> Gives up what was not published, and the lock.
      procedure :: abandon
      !> Shows other programs that this one lives, and has the system write; to be called often with a clock, s.
      procedure :: beat
      !> The dead process that held the file's lock; empty where there was none.
      procedure :: taken_from
      !> What has gone wrong with the file so far.
      procedure :: error_of
      procedure, private :: close_parts
      procedure, private :: catch_up
   end type growing_file_type

contains

   subroutine claim(self, path, error)
      class(growing_file_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      type(error_type), allocatable, intent(out) :: error
      call self%place%claim(path, error)
   end subroutine claim

   !> Starts a new file in the place claimed.
   subroutine begin(self)
      class(growing_file_type), intent(inout) :: self
      call self%file%create(self%place%part)
      call self%provenance%begin(self%file)
      call self%file%put_flag('complete', 0)
      call self%table%begin(self%file)
   end subroutine begin

   !> Goes on with the file that stands in the place claimed, from its checkpoint: simulated time t, s, and state.
   subroutine resume(self, t, state, statistics, error)
      class(growing_file_type), intent(inout) :: self
      real(wp), intent(out) :: t
      !> Of the size that the scene has.
      real(wp), intent(out) :: state(:)
      type(run_statistics_type), intent(out) :: statistics
      type(error_type), allocatable, intent(out) :: error
      t = 0
      state = 0
      call self%place%copy_published(error)
      if (.not. allocated(error)) then
         call self%file%open(self%place%part, writing=.true.)
         t = self%file%get_real('checkpoint/time')
         call self%file%get_list('checkpoint/state', state)
         call statistics%get(self%file)
         call self%provenance%resume(self%file, t)
         call self%table%begin(self%file)
         call self%error_of(error)
         if (.not. allocated(error) .and. .not. all(ieee_is_finite([t, state]))) call raise(error, system_error, &
            & self%place%path//': damaged: its checkpoint is not a number')
      end if
      if (allocated(error)) call self%abandon()
   end subroutine resume

   !> Samples added, also before the run was resumed.
   integer(i8) function samples(self)
      class(growing_file_type), intent(in) :: self
      samples = self%table%samples
   end function samples

   !> The last n samples of a series, (width, n); n at most the samples there are.
   subroutine last_samples(self, name, n, values)
      class(growing_file_type), intent(inout) :: self
      character(len=*), intent(in) :: name
      integer, intent(in) :: n
      real(wp), allocatable, intent(out) :: values(:, :)
      call self%table%last(self%file, name, n, values)
   end subroutine last_samples

   !> Publishes what there is, with the state y at time t, s, to go on from, and goes on writing. With an exit
   !> status other than `running`, which needs its reason, that was the end.
   subroutine checkpoint(self, t, y, statistics, status, reason, error)
      class(growing_file_type), intent(inout) :: self
      real(wp), intent(in) :: t, y(:)
      type(run_statistics_type), intent(in) :: statistics
      integer, intent(in) :: status
      character(len=*), intent(in) :: reason
      type(error_type), allocatable, intent(out) :: error
      logical :: exchanged
      associate (file => self%file)
         if (.not. file%has('checkpoint')) call file%make_group('checkpoint')
         call file%put_real('checkpoint/time', t, 's', 'time from which the run can go on')
         call file%put_list('checkpoint/state', y, '1', 'state of the march at that time', '')
         call statistics%put(file)
         call self%provenance%note(file, t, status, reason)
      end associate
      call self%close_parts()
      call self%error_of(error)
      if (.not. allocated(error)) call self%place%publish(exchanged, error)
      if (.not. allocated(error) .and. status == running) call self%catch_up(exchanged, error)
      if (allocated(error) .or. status /= running) call self%abandon()
   end subroutine checkpoint

   !> Makes the part what was just published: adds the last stretch to what was published before, or, where that
   !> cannot be written (a reader has it open), copies it all.
   subroutine catch_up(self, exchanged, error)
      class(growing_file_type), intent(inout) :: self
      logical, intent(in) :: exchanged
      type(error_type), allocatable, intent(out) :: error
      type(hdf5_type) :: published
      if (exchanged) then
         call self%file%open(self%place%part, writing=.true.)
         call published%open(self%place%path, writing=.false.)
         call self%table%open(self%file)
         call self%table%copy_missing(self%file, published)
         call published%close()
         if (.not. allocated(self%file%failure) .and. .not. allocated(published%failure)) return
         call self%table%close(self%file)
         call self%file%close()
      end if
      call self%place%copy_published(error)
      if (allocated(error)) return
      call self%file%open(self%place%part, writing=.true.)
      call self%table%open(self%file)
      call self%error_of(error)
   end subroutine catch_up

   !> Closes the file and puts it in its place. An exit status other than 0 needs its reason; t is the simulated
   !> time reached, s.
   subroutine finish(self, t, statistics, status, reason, error)
      class(growing_file_type), intent(inout) :: self
      real(wp), intent(in) :: t
      type(run_statistics_type), intent(in) :: statistics
      integer, intent(in) :: status
      character(len=*), intent(in) :: reason
      type(error_type), allocatable, intent(out) :: error
      logical :: exchanged
      call self%file%delete('checkpoint')
      call statistics%put(self%file)
      call self%provenance%note(self%file, t, status, reason)
      if (status == 0) call self%file%put_flag('complete', 1)
      call self%close_parts()
      call self%error_of(error)
      if (.not. allocated(error)) call self%place%publish(exchanged, error)
      call self%abandon()
   end subroutine finish

   subroutine abandon(self)
      class(growing_file_type), intent(inout) :: self
      call self%table%close(self%file)
      call self%file%close()
      call self%place%release()
   end subroutine abandon

   subroutine close_parts(self)
      class(growing_file_type), intent(inout) :: self
      call self%table%write(self%file)
      call self%table%close(self%file)
      call self%file%close()
   end subroutine close_parts

   subroutine beat(self, now)
      class(growing_file_type), intent(inout) :: self
      integer, intent(in) :: now
      if (now == self%last_beat) return
      self%last_beat = now
      call self%place%lock%beat(now)
      call self%place%begin_sync()
   end subroutine beat

   function taken_from(self)
      class(growing_file_type), intent(in) :: self
      character(len=:), allocatable :: taken_from
      taken_from = self%place%lock%taken_from
   end function taken_from

   subroutine error_of(self, error)
      class(growing_file_type), intent(in) :: self
      type(error_type), allocatable, intent(out) :: error
      if (.not. allocated(self%file%failure)) return
      if (self%file%damaged) then
         call raise(error, system_error, self%place%path//': damaged: '//self%file%failure)
      else
         call raise(error, system_error, 'cannot write '//self%place%path//': '//self%file%failure)
      end if
   end subroutine error_of
end module growing_file
