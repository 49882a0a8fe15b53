!> A column of a table: a dataset with a value for each row, or an array of values for each row, which may become larger
!> in any dimension. Where nothing was written it has a value of its own, and takes no room in the file. After a
!> failure, which the file keeps, every routine does nothing.
module hdf5_rows
   use, intrinsic :: iso_c_binding, only: c_loc, c_ptr
   use hdf5, only: hid_t, hsize_t, size_t, h5s_unlimited_f, h5screate_simple_f, h5sclose_f, &
      & h5sget_simple_extent_ndims_f, h5sget_simple_extent_dims_f, h5dcreate_f, h5dwrite_f, &
      & h5dread_f, h5dclose_f, h5dset_extent_f, h5dget_space_f, h5dget_type_f, h5pcreate_f, h5pclose_f, &
      & h5pset_chunk_f, h5pset_fill_value_f, h5p_dataset_create_f, h5tequal_f, h5tclose_f, h5t_native_double, &
      & h5p_dataset_xfer_f, h5pset_buffer_f, h5kind_to_type, h5_integer_kind
   use kinds, only: wp, i8
   use hdf5_file, only: hdf5_type
   use hdf5_series, only: without_cache, select_part
   implicit none (type, external)
   private
   public :: hdf5_rows_type, rows_a_chunk, most_rows, small_transfers

   !> Rows in a chunk, at least and at most, and most numbers in one.
   integer, parameter :: least_rows = 64, most_rows = 512, most_numbers = 65536
   !> Bytes of the memory in which HDF5 converts numbers and texts; it would clear a megabyte of it for each row.
   integer(size_t), parameter :: conversion_bytes = 16384
   !> Most dimensions, and most values a row; only a damaged file says more.
   integer, parameter :: most_dimensions = 8, widest = 10000000

   type :: hdf5_rows_type
      integer(hid_t) :: id = -1
      !> Of the accesses to it, HDF5's list of properties.
      integer(hid_t), private :: transfer = -1
      !> Sizes of the dimensions of a row, the fastest first, and how many rows there are.
      integer, allocatable :: extents(:)
      integer :: rows = 0
   contains
      procedure :: create
      procedure :: open => open_rows
      procedure :: close => close_rows
      procedure :: width
      procedure :: write => write_rows
      procedure :: read => read_rows
      procedure :: resize
   end type hdf5_rows_type

contains

   !> A new dataset of rows with these extents, all filled with a value, in groups that are made where they are not
   !> there. With `whole` the file has whole numbers.
   subroutine create(self, file, name, extents, rows, fill, whole)
      class(hdf5_rows_type), intent(inout) :: self
      class(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: name
      integer, intent(in) :: extents(:), rows
      real(wp), intent(in) :: fill
      logical, intent(in) :: whole
      real(wp), target :: value
      integer(hsize_t) :: most(size(extents) + 1)
      integer(hid_t) :: space, properties, access, kind
      integer :: status
      if (allocated(file%failure)) return
      self%extents = extents
      self%rows = rows
      value = fill
      most = h5s_unlimited_f
      kind = h5t_native_double
      if (whole) kind = h5kind_to_type(i8, h5_integer_kind)
      call h5screate_simple_f(size(most), dimensions(self, rows), space, status, most)
      call h5pcreate_f(h5p_dataset_create_f, properties, status)
      call h5pset_chunk_f(properties, size(most), int([max(extents, 1), rows_a_chunk(rows, product(extents))], &
         & hsize_t), status)
      call h5pset_fill_value_f(properties, h5t_native_double, c_loc(value), status)
      access = without_cache()
      call file%make_group(name(:index(name, '/', back=.true.) - 1))
      call h5dcreate_f(file%id, name, kind, space, self%id, status, properties, dapl_id=access)
      call file%check(status, 'create '//name)
      if (status < 0) self%id = -1
      self%transfer = small_transfers()
      call h5pclose_f(access, status)
      call h5pclose_f(properties, status)
      call h5sclose_f(space, status)
   end subroutine create

   !> Properties of accesses that convert little at a time; to be closed.
   integer(hid_t) function small_transfers() result(properties)
      integer :: status
      call h5pcreate_f(h5p_dataset_xfer_f, properties, status)
      call h5pset_buffer_f(properties, conversion_bytes, status)
   end function small_transfers

   !> Rows in a chunk of a dataset that has this number of them, each of this width.
   pure integer function rows_a_chunk(rows, width)
      integer, intent(in) :: rows, width
      rows_a_chunk = max(1, min(max(rows, least_rows), most_rows, most_numbers/max(1, width)))
   end function rows_a_chunk

   !> An existing dataset of numbers; a failure for any other.
   subroutine open_rows(self, file, name)
      class(hdf5_rows_type), intent(inout) :: self
      class(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: name
      integer(hsize_t) :: dims(most_dimensions), most(most_dimensions)
      integer(hid_t) :: space, access
      integer :: status, rank
      if (allocated(file%failure)) return
      access = without_cache()
      call file%open_dataset(name, self%id, status, access)
      call h5pclose_f(access, rank)
      if (status < 0) self%id = -1
      if (status < 0) return
      self%transfer = small_transfers()
      call expect_numbers(self%id, file, name)
      call h5dget_space_f(self%id, space, status)
      call h5sget_simple_extent_ndims_f(space, rank, status)
      if (rank < 1 .or. rank > most_dimensions) status = -1
      dims = 1
      if (status >= 0) call h5sget_simple_extent_dims_f(space, dims(:rank), most(:rank), status)
      if (status >= 0 .and. product(real(dims(:max(1, rank) - 1), wp)) > widest) status = -1
      if (status >= 0 .and. any(dims > huge(1))) status = -1
      call file%check_read(status, 'read the size of '//name)
      call h5sclose_f(space, rank)
      if (status < 0) then
         call self%close(file)
      else
         self%extents = int(dims(:status - 1))
         self%rows = int(dims(status))
      end if
   end subroutine open_rows

   !> Refuses a dataset of anything but this machine's reals or whole numbers.
   subroutine expect_numbers(dataset, file, name)
      integer(hid_t), intent(in) :: dataset
      class(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: name
      integer(hid_t) :: found
      integer :: status
      logical :: real_kind, whole_kind
      real_kind = .false.
      whole_kind = .false.
      call h5dget_type_f(dataset, found, status)
      if (status >= 0) call h5tequal_f(found, h5t_native_double, real_kind, status)
      if (status >= 0) call h5tequal_f(found, h5kind_to_type(i8, h5_integer_kind), whole_kind, status)
      if (.not. (real_kind .or. whole_kind)) call file%check_read(-1, 'find numbers of the right kind in '//name)
      call h5tclose_f(found, status)
   end subroutine expect_numbers

   !> Sizes of the dimensions of n rows, the fastest first.
   pure function dimensions(self, n) result(dims)
      type(hdf5_rows_type), intent(in) :: self
      integer, intent(in) :: n
      integer(hsize_t) :: dims(size(self%extents) + 1)
      dims = int([self%extents, n], hsize_t)
   end function dimensions

   !> Values a row.
   pure integer function width(self)
      class(hdf5_rows_type), intent(in) :: self
      width = product(self%extents)
   end function width

   !> Makes it larger or smaller; what is new has the value of what was not written.
   subroutine resize(self, file, extents, rows)
      class(hdf5_rows_type), intent(inout) :: self
      class(hdf5_type), intent(inout) :: file
      integer, intent(in) :: extents(:), rows
      integer :: status
      if (allocated(file%failure)) return
      self%extents = extents
      self%rows = rows
      call h5dset_extent_f(self%id, dimensions(self, rows), status)
      call file%check(status, 'change the size of a dataset')
   end subroutine resize

   !> Writes rows from the `first` on, values(width, rows).
   subroutine write_rows(self, file, first, values)
      class(hdf5_rows_type), intent(in) :: self
      class(hdf5_type), intent(inout) :: file
      integer, intent(in) :: first
      real(wp), intent(in), contiguous, target :: values(:, :)
      integer(hid_t) :: memory, space
      integer :: status
      if (allocated(file%failure) .or. size(values) == 0) return
      call select_part(self%id, first - 1_i8, dimensions(self, size(values, 2)), memory, space, status)
      if (status >= 0) call h5dwrite_f(self%id, h5t_native_double, c_loc(values), status, memory, space, &
         & self%transfer)
      call file%check(status, 'write rows')
      call h5sclose_f(space, status)
      call h5sclose_f(memory, status)
   end subroutine write_rows

   !> Reads n rows from the `first` on, values(width, n).
   subroutine read_rows(self, file, first, n, values)
      class(hdf5_rows_type), intent(in) :: self
      class(hdf5_type), intent(inout) :: file
      integer, intent(in) :: first, n
      real(wp), allocatable, target, intent(out) :: values(:, :)
      integer(hid_t) :: memory, space
      integer :: status
      type(c_ptr) :: buffer
      if (allocated(file%failure)) then
         allocate (values(0, n))
         return
      end if
      allocate (values(self%width(), n), source=0.0_wp)
      if (size(values) == 0) return
      buffer = c_loc(values)
      call select_part(self%id, first - 1_i8, dimensions(self, n), memory, space, status)
      if (status >= 0) call h5dread_f(self%id, h5t_native_double, buffer, status, memory, space, &
         & self%transfer)
      call file%check_read(status, 'read rows')
      call h5sclose_f(space, status)
      call h5sclose_f(memory, status)
   end subroutine read_rows

   subroutine close_rows(self, file)
      class(hdf5_rows_type), intent(inout) :: self
      class(hdf5_type), intent(inout) :: file
      integer :: status
      if (self%id < 0) return
      call h5pclose_f(self%transfer, status)
      call h5dclose_f(self%id, status)
      call file%check(status, 'close a dataset')
      self%id = -1
   end subroutine close_rows
end module hdf5_rows
