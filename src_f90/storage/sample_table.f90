!> Series over one axis (time, or whatever a task follows) that grow together, a sample at a time; they are written a
!> chunk at a time.
module sample_table
   use kinds, only: wp, i8
   use hdf5_file, only: hdf5_type
   use hdf5_series, only: hdf5_series_type, chunk_samples
   implicit none (type, external)
   private
   public :: sample_table_type

   type :: series_type
      character(len=:), allocatable :: name
      type(hdf5_series_type) :: data
      real(wp), allocatable :: buffer(:, :)
   end type series_type

   type :: sample_table_type
      private
      !> Name of the series that is the scale of all; the first of a sample.
      character(len=:), allocatable :: axis
      type(series_type), allocatable :: series(:)
      !> Samples held back; the series whose value comes next.
      integer :: held = 0, next = 1
      !> Samples added, held or in the file.
      integer(i8), public :: samples = 0
   contains
      !> Starts from the samples that are in the file, if any.
      procedure :: begin
      !> A sample: `new_sample`, and `add` for each series, always in the same order.
      procedure :: new_sample
      procedure :: add
      procedure :: write => write_held
      procedure :: last
      procedure :: copy_missing
      procedure :: open => open_all
      procedure :: close => close_all
      procedure, private :: open_series
   end type sample_table_type

contains

   subroutine begin(self, file, axis)
      class(sample_table_type), intent(inout) :: self
      type(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: axis
      type(hdf5_series_type) :: scale
      self%axis = axis
      if (allocated(self%series)) deallocate (self%series)
      allocate (self%series(0))
      self%held = 0
      self%samples = 0
      if (.not. file%has(axis)) return
      call scale%open(file, axis)
      self%samples = scale%length
      call scale%close(file)
   end subroutine begin

   subroutine new_sample(self, file)
      class(sample_table_type), intent(inout) :: self
      type(hdf5_type), intent(inout) :: file
      ! chunks of the file are filled up, also after a checkpoint in the middle of one
      if (self%held > 0 .and. mod(self%samples, int(chunk_samples, i8)) == 0) call self%write(file)
      self%held = self%held + 1
      self%samples = self%samples + 1
      self%next = 1
   end subroutine new_sample

   !> The next value of the sample: of a series over the axis, or, where `across` names another scale, over both.
   subroutine add(self, file, name, values, across, units, long_name)
      class(sample_table_type), intent(inout) :: self
      type(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: name, across, units, long_name
      real(wp), intent(in) :: values(:)
      integer :: k
      k = self%next
      self%next = k + 1
      if (k > size(self%series)) then
         if (self%samples > 1) then
            call self%open_series(file, name, size(values))
         else
            call new_series(self, name)
            call self%series(k)%data%create(file, name, merge(size(values), 0, across /= ''), units, long_name, &
               & trim(self%axis//' '//across))
         end if
         if (size(self%series) < k) return
         allocate (self%series(k)%buffer(size(values), chunk_samples))
      end if
      self%series(k)%buffer(:, self%held) = values
   end subroutine add

   subroutine new_series(self, name)
      class(sample_table_type), intent(inout) :: self
      character(len=*), intent(in) :: name
      type(series_type), allocatable :: longer(:)
      integer :: k
      ! the buffers are moved; assigning the array would copy them all
      allocate (longer(size(self%series) + 1))
      do k = 1, size(self%series)
         longer(k)%data = self%series(k)%data
         call move_alloc(self%series(k)%name, longer(k)%name)
         call move_alloc(self%series(k)%buffer, longer(k)%buffer)
      end do
      longer(size(longer))%name = name
      call move_alloc(longer, self%series)
   end subroutine new_series

   !> A series that is in the file; it must have this width and be as long as all others.
   subroutine open_series(self, file, name, width)
      class(sample_table_type), intent(inout) :: self
      type(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: name
      integer, intent(in) :: width
      integer(i8) :: expected
      call new_series(self, name)
      expected = self%samples - self%held
      associate (data => self%series(size(self%series))%data)
         call data%open(file, name)
         if (data%length /= expected .or. data%width /= width) call file%check_read(-1, 'find all samples of '//name)
      end associate
   end subroutine open_series

   subroutine write_held(self, file)
      class(sample_table_type), intent(inout) :: self
      type(hdf5_type), intent(inout) :: file
      integer :: k
      if (self%held == 0) return
      do k = 1, size(self%series)
         call self%series(k)%data%append(file, self%series(k)%buffer(:, :self%held))
      end do
      self%held = 0
   end subroutine write_held

   !> The last n samples of a series, (width, n); n at most the samples there are.
   subroutine last(self, file, name, n, values)
      class(sample_table_type), intent(inout) :: self
      type(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: name
      integer, intent(in) :: n
      real(wp), allocatable, intent(out) :: values(:, :)
      type(hdf5_series_type) :: data
      integer :: k
      call self%write(file)
      do k = 1, size(self%series)
         if (self%series(k)%name /= name) cycle
         call self%series(k)%data%read(file, self%samples - n, n, values)
         return
      end do
      ! not one of this run's own: from before it was resumed
      call data%open(file, name)
      call data%read(file, self%samples - n, n, values)
      call data%close(file)
   end subroutine last

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
