!> Series over one axis (time, or whatever a task follows) that grow together, a sample at a time; they are written a
!> chunk at a time.
module sample_table
   use kinds, only: wp, i8
   use clock, only: wall_clock
   use hdf5_file, only: hdf5_type
   use hdf5_series, only: hdf5_series_type, chunk_samples
   implicit none (type, external)
   private
   public :: sample_table_type

   type :: series_type
      character(len=:), allocatable :: name
      type(hdf5_series_type) :: data
      !> Values of a sample before its own; its own.
      integer :: before = 0, width = 0
   end type series_type

   type :: sample_table_type
      private
      !> Name of the series that is the scale of all; it is declared first.
      character(len=:), allocatable :: axis
      !> How many samples there will be, if this is known.
      integer(i8) :: expected = 0
      type(series_type), allocatable :: series(:)
      !> Samples held back, series after series with room for a chunk each, and how many there are.
      real(wp), allocatable :: buffer(:)
      integer :: held = 0
      !> Of each value of a sample: its place in the buffer for the first sample, and from there to the next.
      integer, allocatable :: place(:), stride(:)
      !> Samples added, held or in the file.
      integer(i8), public :: samples = 0
      !> Wall time of writing, s.
      real(wp), public :: seconds = 0
   contains
      !> Starts from the samples that are in the file, if any.
      procedure :: begin
      !> Names a series; all before the first sample.
      procedure :: declare
      procedure :: is_declared
      procedure :: add
      procedure :: write => write_held
      procedure :: last
      procedure :: part
      procedure :: copy_missing
      procedure :: open => open_all
      procedure :: close => close_all
   end type sample_table_type

contains

   subroutine begin(self, file, axis, expected)
      class(sample_table_type), intent(inout) :: self
      type(hdf5_type), intent(inout) :: file
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
      if (.not. file%has(axis)) return
      call scale%open(file, axis)
      self%samples = scale%length
      call scale%close(file)
   end subroutine begin

   !> A series of this number of values over the axis, or, where `across` names another scale, over both. One that is in
   !> the file must have this width and be as long as all others.
   subroutine declare(self, file, name, width, across, units, long_name)
      class(sample_table_type), intent(inout) :: self
      type(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: name, across, units, long_name
      integer, intent(in) :: width
      type(series_type) :: new
      integer :: i
      new%name = name
      new%width = width
      new%before = size(self%place)
      if (self%samples == 0) then
         call new%data%create(file, name, merge(width, 0, across /= ''), units, long_name, &
            & trim(self%axis//' '//across), self%expected)
      else
         call new%data%open(file, name)
         if (new%data%length /= self%samples .or. new%data%width /= width) call file%check_read(-1, &
            & 'find all samples of '//name)
      end if
      self%series = [self%series, new]
      self%place = [self%place, (chunk_samples*new%before + i, i=1, width)]
      self%stride = [self%stride, (width, i=1, width)]
   end subroutine declare

   !> Whether the series have names.
   pure logical function is_declared(self)
      class(sample_table_type), intent(in) :: self
      is_declared = size(self%series) > 0
   end function is_declared

   !> A sample: the values of all series, in the order in which they were declared.
   subroutine add(self, file, values)
      class(sample_table_type), intent(inout) :: self
      type(hdf5_type), intent(inout) :: file
      real(wp), intent(in), contiguous :: values(:)
      integer :: i
      if (.not. allocated(self%buffer)) allocate (self%buffer(chunk_samples*size(values)))
      ! chunks of the file are filled up, also after a checkpoint in the middle of one
      if (self%held > 0 .and. mod(self%samples, int(chunk_samples, i8)) == 0) call self%write(file)
      do i = 1, size(values)
         self%buffer(self%place(i) + self%stride(i)*self%held) = values(i)
      end do
      self%held = self%held + 1
      self%samples = self%samples + 1
   end subroutine add

   subroutine write_held(self, file)
      class(sample_table_type), intent(inout), target :: self
      type(hdf5_type), intent(inout) :: file
      real(wp), pointer, contiguous :: values(:, :)
      real(wp) :: started
      integer :: k, o
      if (self%held == 0) return
      started = wall_clock()
      do k = 1, size(self%series)
         associate (width => self%series(k)%width)
            o = chunk_samples*self%series(k)%before
            values(1:width, 1:self%held) => self%buffer(o + 1:o + width*self%held)
            call self%series(k)%data%append(file, values)
         end associate
      end do
      self%held = 0
      self%seconds = self%seconds + wall_clock() - started
   end subroutine write_held

   !> The last n samples of a series, (width, n); n at most the samples there are.
   subroutine last(self, file, name, n, values)
      class(sample_table_type), intent(inout) :: self
      type(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: name
      integer, intent(in) :: n
      real(wp), allocatable, intent(out) :: values(:, :)
      call self%part(file, name, self%samples - n, n, values)
   end subroutine last

   !> The n samples of a series behind the first `skip` ones, (width, n).
   subroutine part(self, file, name, skip, n, values)
      class(sample_table_type), intent(inout) :: self
      type(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: name
      integer(i8), intent(in) :: skip
      integer, intent(in) :: n
      real(wp), allocatable, intent(out) :: values(:, :)
      type(hdf5_series_type) :: data
      integer :: k
      call self%write(file)
      do k = 1, size(self%series)
         if (self%series(k)%name /= name) cycle
         call self%series(k)%data%read(file, skip, n, values)
         return
      end do
      ! not one of this run's own: from before it was resumed
      call data%open(file, name)
      call data%read(file, skip, n, values)
      call data%close(file)
   end subroutine part

   !> Adds to a file, whose series are open, the samples that it lacks from another that has them all.
   subroutine copy_missing(self, file, whole)
      class(sample_table_type), intent(inout) :: self
      type(hdf5_type), intent(inout) :: file, whole
      type(hdf5_series_type) :: source
      real(wp), allocatable :: values(:, :)
      integer(i8) :: missing
      integer :: k
      if (.not. allocated(self%series)) return
      do k = 1, size(self%series)
         associate (data => self%series(k)%data)
            call source%open(whole, self%series(k)%name)
            do
               missing = source%length - data%length
               if (missing <= 0 .or. allocated(file%failure) .or. allocated(whole%failure)) exit
               ! up to the end of a chunk
               missing = min(missing, chunk_samples - mod(data%length, int(chunk_samples, i8)))
               call source%read(whole, data%length, int(missing), values)
               call data%append(file, values)
            end do
            call source%close(whole)
         end associate
      end do
   end subroutine copy_missing

   subroutine open_all(self, file)
      class(sample_table_type), intent(inout) :: self
      type(hdf5_type), intent(inout) :: file
      integer :: k
      if (.not. allocated(self%series)) return
      do k = 1, size(self%series)
         call self%series(k)%data%open(file, self%series(k)%name)
      end do
   end subroutine open_all

   subroutine close_all(self, file)
      class(sample_table_type), intent(inout) :: self
      type(hdf5_type), intent(inout) :: file
      integer :: k
      if (.not. allocated(self%series)) return
      do k = 1, size(self%series)
         call self%series(k)%data%close(file)
      end do
   end subroutine close_all
end module sample_table
