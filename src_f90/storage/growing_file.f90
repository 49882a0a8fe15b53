!> A file that grows by samples and can be continued.
!>
!> It is written beside its final name and published whole, at checkpoints and at the end, so that a crash at any
!> moment leaves the last checkpoint, or before the first one the previous file as it was.
module growing_file
   use kinds, only: wp, i8
   use errors, only: error_type, raise, system_error
   use hdf5_file, only: hdf5_type
   use sample_table, only: sample_table_type
   use working_file, only: working_file_type
   implicit none (type, external)
   private
   public :: growing_file_type

   type :: growing_file_type
      type(working_file_type), private :: working
      !> The open file, and its series, to which samples are added.
      type(hdf5_type) :: file
      type(sample_table_type) :: table
      !> Clock of the last beat, s.
      integer, private :: last_beat = 0
   contains
      !> Locks the name of the file, so that no other run writes it, until `abandon`.
      procedure :: claim
      procedure :: begin
      procedure :: reopen
      procedure :: begin_series
      procedure :: samples
      procedure :: last_samples
      procedure :: part_of_samples
      procedure :: publish
      !> Deletes what was not published, and frees the lock.
      procedure :: abandon
      procedure :: path
      !> Shows other programs that this one lives, and has the system write; to be called often with a clock, s.
      procedure :: beat
      !> The dead process that held the file's lock; empty where there was none.
      procedure :: taken_from
      !> What has gone wrong with the file so far.
      procedure :: error_of
      procedure, private :: open_part
      procedure, private :: catch_up
   end type growing_file_type

contains

   subroutine claim(self, path, error)
      class(growing_file_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      type(error_type), allocatable, intent(out) :: error
      call self%working%claim(path, error)
   end subroutine claim

   !> Starts a new file under the name claimed.
   subroutine begin(self, error)
      class(growing_file_type), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error
      call self%working%make_part(error)
      if (.not. allocated(error)) call self%file%create(self%working%part)
   end subroutine begin

   !> Opens a copy of the file of the name claimed, to continue it.
   subroutine reopen(self, error)
      class(growing_file_type), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error
      call self%working%copy_published(error)
      if (.not. allocated(error)) call self%open_part(error)
   end subroutine reopen

   !> Opens the part, unless another run has taken the place of this one, whose part then has the name.
   subroutine open_part(self, error)
      class(growing_file_type), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error
      call self%working%check_part(error)
      if (.not. allocated(error)) call self%file%open(self%working%part, writing=.true.)
   end subroutine open_part

   !> Series over an axis, 'time' or another, follow; they start from the samples that are in the file, if any.
   !> `expected`: how many there will be in the end, if this is known.
   subroutine begin_series(self, axis, expected)
      class(growing_file_type), intent(inout) :: self
      character(len=*), intent(in) :: axis
      integer(i8), intent(in) :: expected
      call self%table%begin(self%file, axis, expected)
   end subroutine begin_series

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

   !> The n samples of a series behind the first `skip` ones, (width, n).
   subroutine part_of_samples(self, name, skip, n, values)
      class(growing_file_type), intent(inout) :: self
      character(len=*), intent(in) :: name
      integer(i8), intent(in) :: skip
      integer, intent(in) :: n
      real(wp), allocatable, intent(out) :: values(:, :)
      call self%table%part(self%file, name, skip, n, values)
   end subroutine part_of_samples

   !> Publishes what there is. With `continued` the writing continues; otherwise the file is closed and the lock freed.
   subroutine publish(self, continued, error)
      class(growing_file_type), intent(inout) :: self
      logical, intent(in) :: continued
      type(error_type), allocatable, intent(out) :: error
      logical :: exchanged
      call self%table%write(self%file)
      call self%table%close(self%file)
      call self%file%close()
      call self%error_of(error)
      if (.not. allocated(error)) call self%working%publish(exchanged, error)
      if (.not. allocated(error) .and. continued) call self%catch_up(exchanged, error)
      if (allocated(error) .or. .not. continued) call self%abandon()
   end subroutine publish

   !> Makes the part what was just published: adds the last stretch to what was published before, or, where that
   !> cannot be written (a reader has it open), copies it all.
   subroutine catch_up(self, exchanged, error)
      class(growing_file_type), intent(inout) :: self
      logical, intent(in) :: exchanged
      type(error_type), allocatable, intent(out) :: error
      type(hdf5_type) :: published
      if (exchanged) then
         call self%open_part(error)
         if (allocated(error)) return
         call published%open(self%working%path, writing=.false.)
         call self%table%open(self%file)
         call self%table%copy_missing(self%file, published)
         call published%close()
         if (.not. allocated(self%file%failure) .and. .not. allocated(published%failure)) return
         call self%table%close(self%file)
         call self%file%close()
      end if
      call self%working%copy_published(error)
      if (.not. allocated(error)) call self%open_part(error)
      if (allocated(error)) return
      call self%table%open(self%file)
      call self%error_of(error)
   end subroutine catch_up

   subroutine abandon(self)
      class(growing_file_type), intent(inout) :: self
      call self%table%close(self%file)
      call self%file%close()
      call self%working%release()
   end subroutine abandon

   subroutine beat(self, now)
      class(growing_file_type), intent(inout) :: self
      integer, intent(in) :: now
      if (now == self%last_beat) return
      self%last_beat = now
      call self%working%lock%beat(now)
      call self%working%begin_sync()
   end subroutine beat

   function taken_from(self)
      class(growing_file_type), intent(in) :: self
      character(len=:), allocatable :: taken_from
      taken_from = self%working%lock%taken_from
   end function taken_from

   !> Name of the file, links followed.
   function path(self)
      class(growing_file_type), intent(in) :: self
      character(len=:), allocatable :: path
      path = self%working%path
   end function path

   subroutine error_of(self, error)
      class(growing_file_type), intent(in) :: self
      type(error_type), allocatable, intent(out) :: error
      if (.not. allocated(self%file%failure)) return
      if (self%file%damaged) then
         call raise(error, system_error, self%working%path//': damaged: '//self%file%failure)
      else
         call raise(error, system_error, 'cannot write '//self%working%path//': '//self%file%failure)
      end if
   end subroutine error_of
end module growing_file
