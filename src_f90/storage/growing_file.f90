!> An HDF5 file that grows by samples and can be continued: series over one axis (time, or whatever a task follows) grow
!> together, a sample at a time, and are written a chunk at a time.
!>
!> It is written beside its final name and published whole, at checkpoints and at the end, so that a crash at any
!> moment leaves the last checkpoint, or before the first one the previous file as it was.
module growing_file
   use kinds, only: wp, i8
   use errors, only: error_type
   use clock, only: wall_clock
   use hdf5_file, only: hdf5_type
   use hdf5_series, only: hdf5_series_type, chunk_samples
   use working_file, only: working_file_type
   implicit none (type, external)
   private
   public :: growing_file_type

   type :: series_type
      character(len=:), allocatable :: name
      type(hdf5_series_type) :: data
      !> Values of a sample before its own; its own.
      integer :: before = 0, width = 0
   end type series_type

   type, extends(hdf5_type) :: growing_file_type
      type(working_file_type) :: working
      !> Name of the series that is the scale of all; it is declared first.
      character(len=:), allocatable, private :: axis
      !> How many samples there will be, if this is known.
      integer(i8), private :: expected = 0
      type(series_type), allocatable, private :: series(:)
      !> Samples held back, series after series with room for a chunk each, and how many there are.
      real(wp), allocatable, private :: buffer(:)
      integer, private :: held = 0
      !> Of each value of a sample: its place in the buffer for the first sample, and from there to the next.
      integer, allocatable, private :: place(:), stride(:)
      !> Samples added, held or in the file, also before the run was resumed.
      integer(i8) :: samples = 0
      !> Wall time of writing samples, s.
      real(wp) :: writing_seconds = 0
   contains
      !> Locks the name of the file, so that no other run writes it, until `abandon`.
      procedure :: claim
      procedure :: begin
      procedure :: reopen
      procedure :: begin_series
      !> Names a series; all before the first sample.
      procedure :: declare
      procedure :: add
      procedure :: part_of_samples
      procedure :: publish
      !> Deletes what was not published, and frees the lock.
      procedure :: abandon
   end type growing_file_type

contains

   subroutine claim(self, path, error)
      class(growing_file_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      type(error_type), allocatable, intent(out) :: error
      self%series = [series_type ::]
      call self%working%claim(path, error)
   end subroutine claim

   !> Starts a new file under the name claimed.
   subroutine begin(self, error)
      class(growing_file_type), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error
      call self%working%make_part(error)
      if (.not. allocated(error)) call self%create(self%working%part)
   end subroutine begin

   !> Opens a copy of the file of the name claimed, to continue it.
   subroutine reopen(self, error)
      class(growing_file_type), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error
      call self%working%copy_published(error)
      if (.not. allocated(error)) call open_part(self, error)
   end subroutine reopen

   !> Opens the part, unless another run has taken the place of this one, whose part then has the name.
   subroutine open_part(self, error)
      class(growing_file_type), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error
      call self%working%check_part(error)
      if (.not. allocated(error)) call self%open(self%working%part, writing=.true.)
   end subroutine open_part

   !> Series over an axis, 'time' or another, follow; they start from the samples that are in the file, if any.
   !> `expected`: how many there will be in the end, if this is known.
   subroutine begin_series(self, axis, expected)
      class(growing_file_type), intent(inout) :: self
      character(len=*), intent(in) :: axis
      integer(i8), intent(in) :: expected
      type(hdf5_series_type) :: scale
      self%axis = axis
      self%expected = expected
      if (allocated(self%buffer)) deallocate (self%buffer)
      self%series = [series_type ::]
      self%place = [integer ::]
      self%stride = [integer ::]
      self%held = 0
      self%samples = 0
      if (.not. self%has(axis)) return
      call scale%open(self%hdf5_type, axis)
      self%samples = scale%length
      call scale%close(self%hdf5_type)
   end subroutine begin_series

   !> A series of this number of values over the axis, or, where `across` names another scale, over both. One that is in
   !> the file must have this width and be as long as all others.
   subroutine declare(self, name, width, across, units, long_name)
      class(growing_file_type), intent(inout) :: self
      character(len=*), intent(in) :: name, across, units, long_name
      integer, intent(in) :: width
      type(series_type) :: new
      integer :: i
      new%name = name
      new%width = width
      new%before = size(self%place)
      if (self%samples == 0) then
         call new%data%create(self%hdf5_type, name, merge(width, 0, across /= ''), units, long_name, &
            & trim(self%axis//' '//across), self%expected)
      else
         call new%data%open(self%hdf5_type, name)
         if (new%data%length /= self%samples .or. new%data%width /= width) call self%check_read(-1, &
            & 'find all samples of '//name)
      end if
      self%series = [self%series, new]
      self%place = [self%place, (chunk_samples*new%before + i, i=1, width)]
      self%stride = [self%stride, (width, i=1, width)]
   end subroutine declare

   !> A sample: the values of all series, in the order in which they were declared.
   subroutine add(self, values)
      class(growing_file_type), intent(inout) :: self
      real(wp), intent(in), contiguous :: values(:)
      integer :: i
      if (.not. allocated(self%buffer)) allocate (self%buffer(chunk_samples*size(values)))
      ! chunks of the file are filled up, also after a checkpoint in the middle of one
      if (self%held > 0 .and. mod(self%samples, int(chunk_samples, i8)) == 0) call write_held(self)
      do i = 1, size(values)
         self%buffer(self%place(i) + self%stride(i)*self%held) = values(i)
      end do
      self%held = self%held + 1
      self%samples = self%samples + 1
   end subroutine add

   subroutine write_held(self)
      class(growing_file_type), intent(inout), target :: self
      real(wp), pointer, contiguous :: values(:, :)
      real(wp) :: started
      integer :: k, o
      if (self%held == 0) return
      started = wall_clock()
      do k = 1, size(self%series)
         associate (width => self%series(k)%width)
            o = chunk_samples*self%series(k)%before
            values(1:width, 1:self%held) => self%buffer(o + 1:o + width*self%held)
            call self%series(k)%data%append(self%hdf5_type, values)
         end associate
      end do
      self%held = 0
      self%writing_seconds = self%writing_seconds + wall_clock() - started
   end subroutine write_held

   !> The n samples of a series behind the first `skip` ones, (width, n).
   subroutine part_of_samples(self, name, skip, n, values)
      class(growing_file_type), intent(inout) :: self
      character(len=*), intent(in) :: name
      integer(i8), intent(in) :: skip
      integer, intent(in) :: n
      real(wp), allocatable, intent(out) :: values(:, :)
      type(hdf5_series_type) :: data
      integer :: k
      call write_held(self)
      do k = 1, size(self%series)
         if (self%series(k)%name /= name) cycle
         call self%series(k)%data%read(self%hdf5_type, skip, n, values)
         return
      end do
      ! not one of this run's own: from before it was resumed
      call data%open(self%hdf5_type, name)
      call data%read(self%hdf5_type, skip, n, values)
      call data%close(self%hdf5_type)
   end subroutine part_of_samples

   !> Publishes what there is. With `continued` the writing continues; otherwise the file is closed and the lock freed.
   !> `behind`: the file that is written on has all samples, but of the rest what it had before the last publication.
   subroutine publish(self, continued, error, behind)
      class(growing_file_type), intent(inout) :: self
      logical, intent(in) :: continued
      type(error_type), allocatable, intent(out) :: error
      logical, intent(out) :: behind
      logical :: exchanged
      behind = .false.
      call write_held(self)
      call close_part(self)
      call self%error_of(self%working%path, error)
      if (.not. allocated(error)) call self%working%publish(exchanged, error)
      if (.not. allocated(error) .and. continued) call catch_up(self, exchanged, error, behind)
      if (allocated(error) .or. .not. continued) call self%abandon()
   end subroutine publish

   !> Makes the part what was just published: adds the last stretch to what was published before, or, where that
   !> cannot be written (a reader has it open), copies it all.
   subroutine catch_up(self, exchanged, error, behind)
      class(growing_file_type), intent(inout) :: self
      logical, intent(in) :: exchanged
      type(error_type), allocatable, intent(out) :: error
      logical, intent(inout) :: behind
      type(hdf5_type) :: published
      if (exchanged) then
         call open_part(self, error)
         if (allocated(error)) return
         call published%open(self%working%path, writing=.false.)
         call open_series(self)
         call copy_missing(self, published)
         call published%close()
         behind = .not. allocated(self%failure) .and. .not. allocated(published%failure)
         if (behind) return
         call close_part(self)
      end if
      call self%working%copy_published(error)
      if (.not. allocated(error)) call open_part(self, error)
      if (allocated(error)) return
      call open_series(self)
      call self%error_of(self%working%path, error)
   end subroutine catch_up

   !> Adds to a file, whose series are open, the samples that it lacks from another that has them all.
   subroutine copy_missing(self, whole)
      class(growing_file_type), intent(inout) :: self
      type(hdf5_type), intent(inout) :: whole
      type(hdf5_series_type) :: source
      real(wp), allocatable :: values(:, :)
      integer(i8) :: missing
      integer :: k
      do k = 1, size(self%series)
         associate (data => self%series(k)%data)
            call source%open(whole, self%series(k)%name)
            do
               missing = source%length - data%length
               if (missing <= 0 .or. allocated(self%failure) .or. allocated(whole%failure)) exit
               ! up to the end of a chunk
               missing = min(missing, chunk_samples - mod(data%length, int(chunk_samples, i8)))
               call source%read(whole, data%length, int(missing), values)
               call data%append(self%hdf5_type, values)
            end do
            call source%close(whole)
         end associate
      end do
   end subroutine copy_missing

   subroutine open_series(self)
      class(growing_file_type), intent(inout) :: self
      integer :: k
      do k = 1, size(self%series)
         call self%series(k)%data%open(self%hdf5_type, self%series(k)%name)
      end do
   end subroutine open_series

   subroutine close_part(self)
      class(growing_file_type), intent(inout) :: self
      integer :: k
      do k = 1, size(self%series)
         call self%series(k)%data%close(self%hdf5_type)
      end do
      call self%close()
   end subroutine close_part

   subroutine abandon(self)
      class(growing_file_type), intent(inout) :: self
      call close_part(self)
      call self%working%release()
   end subroutine abandon
end module growing_file
