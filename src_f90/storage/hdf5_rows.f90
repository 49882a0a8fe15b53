!> A dataset with a value, or an array of values, for each row: a column of a table, or a series, to which samples are
!> appended. Where nothing was written it has a value of its own, and takes no room in the file. After a failure, which
!> the file keeps, every routine does nothing.
module hdf5_rows
   use, intrinsic :: iso_c_binding, only: c_int, c_int32_t, c_int64_t, c_loc, c_ptr, c_size_t
   use hdf5, only: hid_t, hsize_t, size_t, h5s_unlimited_f, h5s_select_set_f, h5screate_simple_f, h5sclose_f, &
      & h5sselect_hyperslab_f, h5dcreate_f, h5dwrite_f, h5dread_f, h5dclose_f, h5dset_extent_f, h5dget_space_f, &
      & h5pcreate_f, h5pclose_f, h5pset_chunk_f, h5pset_chunk_cache_f, h5pset_fill_value_f, h5p_dataset_create_f, &
      & h5p_dataset_access_f, h5p_dataset_xfer_f, h5pset_buffer_f, h5t_native_double, h5kind_to_type, h5_integer_kind
   use kinds, only: wp, i8
   use hdf5_file, only: hdf5_type, opened_type, is_of_kind
   implicit none (type, external)
   private
   public :: hdf5_rows_type, rows_a_chunk, most_rows, chunk_samples, small_transfers, select_part, max_dimensions

   !> Samples in a chunk, at most: a series that is known to be shorter has chunks of its own length.
   integer, parameter :: chunk_samples = 4096
   !> Rows in a chunk, and numbers in one, at most.
   integer, parameter :: most_rows = 512, most_numbers = 65536
   !> Bytes of the memory in which HDF5 converts numbers and texts; it would clear a megabyte of it for each row.
   integer(size_t), parameter :: conversion_bytes = 16384
   !> Most dimensions, and most values a row; only a damaged file says more.
   integer, parameter :: most_dimensions = 8, widest = 10000000

   type :: hdf5_rows_type
      integer(hid_t) :: id = -1
      !> Of the accesses to it, HDF5's list of properties.
      integer(hid_t), private :: transfer = -1
      !> Rows in a chunk, where it was created to be appended to.
      integer, private :: chunk = 0
      !> Sizes of the dimensions of a row, the fastest first, and how many rows there are; `length` is the same for
      !> series, which may be longer than `rows` can say.
      integer, allocatable :: extents(:)
      integer :: rows = 0
      integer(i8) :: length = 0
      !> What messages call the rows.
      character(len=7) :: called = 'rows'
   contains
      procedure :: create
      procedure :: open => open_rows
      procedure :: close => close_rows
      procedure :: width
      procedure :: write => write_rows
      procedure :: append
      procedure :: read => read_rows
      procedure :: read_behind
   end type hdf5_rows_type

   interface
      !> Writes a whole chunk, which no filter has changed (filters 0); < 0 after a failure.
      integer(c_int) function h5dwrite_chunk(dataset, transfer, filters, start, bytes, values) &
         & bind(c, name='H5Dwrite_chunk')
         import :: c_int, c_int32_t, c_int64_t, c_ptr, c_size_t
         !> hid_t, which is 64 bits wide since HDF5 1.10.
         integer(c_int64_t), value :: dataset, transfer
         integer(c_int32_t), value :: filters
         !> The slowest dimension first; hsize_t.
         integer(c_int64_t), intent(in) :: start(*)
         integer(c_size_t), value :: bytes
         type(c_ptr), value :: values
      end function h5dwrite_chunk
   end interface

contains

   !> A new dataset of rows with these extents, all filled with a value, in groups that are made where they are not
   !> there; one without rows may grow. With `whole` the file has whole numbers. `expected` tells how many samples a
   !> series will have, if this is known; HDF5 takes room for whole chunks.
   subroutine create(self, file, name, extents, rows, fill, whole, expected)
      class(hdf5_rows_type), intent(inout) :: self
      class(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: name
      integer, intent(in) :: extents(:), rows
      real(wp), intent(in), optional :: fill
      logical, intent(in), optional :: whole
      integer(i8), intent(in), optional :: expected
      real(wp), target :: value
      integer(hsize_t) :: most(size(extents) + 1)
      integer(hid_t) :: space, properties, access, kind
      integer :: status, chunk
      if (allocated(file%failure)) return
      self%extents = extents
      call set_length(self, int(rows, i8))
      most = max_dimensions(dimensions(self, self%length))
      kind = h5t_native_double
      if (present(whole)) then
         if (whole) kind = h5kind_to_type(i8, h5_integer_kind)
      end if
      chunk = rows_a_chunk(rows, product(extents))
      if (present(expected)) then
         chunk = int(max(1_i8, min(expected, int(chunk_samples, i8))))
         self%chunk = chunk
      end if
      call h5screate_simple_f(size(most), dimensions(self, self%length), space, status, most)
      call h5pcreate_f(h5p_dataset_create_f, properties, status)
      call h5pset_chunk_f(properties, size(most), int([max(extents, 1), chunk], hsize_t), status)
      if (present(fill)) then
         value = fill
         call h5pset_fill_value_f(properties, h5t_native_double, c_loc(value), status)
      end if
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

   !> Whole chunks are written as they come: a cache of them would only cost memory.
   integer(hid_t) function without_cache() result(access)
      integer :: status
      call h5pcreate_f(h5p_dataset_access_f, access, status)
      call h5pset_chunk_cache_f(access, 0_size_t, 0_size_t, 0.0, status)
   end function without_cache

   !> Properties of accesses that convert little at a time; to be closed.
   integer(hid_t) function small_transfers() result(properties)
      integer :: status
      call h5pcreate_f(h5p_dataset_xfer_f, properties, status)
      call h5pset_buffer_f(properties, conversion_bytes, status)
   end function small_transfers

   !> Rows in a chunk of a dataset that has this number of them, each of this width.
   pure integer function rows_a_chunk(rows, width)
      integer, intent(in) :: rows, width
      rows_a_chunk = max(1, min(rows, most_rows, most_numbers/max(1, width)))
   end function rows_a_chunk

   !> How large each dimension may become: as it is, as HDF5's own default; but one of size 0 may grow. Readers of
   !> unlimited dimensions ask all datasets for their size, again and again (h5netcdf).
   elemental integer(hsize_t) function max_dimensions(dims)
      integer(hsize_t), intent(in) :: dims
      max_dimensions = merge(int(h5s_unlimited_f, hsize_t), dims, dims == 0)
   end function max_dimensions

   !> An existing dataset of this machine's reals or whole numbers; a failure for any other.
   subroutine open_rows(self, file, name)
      class(hdf5_rows_type), intent(inout) :: self
      class(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: name
      type(opened_type) :: found
      integer(hid_t) :: access
      integer :: status, rank
      logical :: known
      if (allocated(file%failure)) return
      access = without_cache()
      call file%open_dataset(name, found, access)
      call h5pclose_f(access, status)
      self%id = found%id
      if (self%id < 0) return
      self%transfer = small_transfers()
      known = is_of_kind(self%id, h5t_native_double)
      if (.not. known) known = is_of_kind(self%id, h5kind_to_type(i8, h5_integer_kind))
      if (.not. known) call file%check_read(-1, 'find numbers of the right kind in '//name)
      rank = size(found%extents)
      known = rank >= 1 .and. rank <= most_dimensions .and. product(real(found%extents(:rank - 1), wp)) <= widest
      if (.not. known) call file%check_read(-1, 'read the size of '//name)
      if (allocated(file%failure)) then
         call self%close(file)
      else
         self%extents = int(found%extents(:rank - 1))
         call set_length(self, int(found%extents(rank), i8))
      end if
   end subroutine open_rows

   pure subroutine set_length(self, length)
      class(hdf5_rows_type), intent(inout) :: self
      integer(i8), intent(in) :: length
      self%length = length
      self%rows = int(min(length, int(huge(1), i8)))
   end subroutine set_length

   !> Sizes of the dimensions of n rows, the fastest first.
   pure function dimensions(self, n) result(dims)
      type(hdf5_rows_type), intent(in) :: self
      integer(i8), intent(in) :: n
      integer(hsize_t) :: dims(size(self%extents) + 1)
      dims = [int(self%extents, hsize_t), int(n, hsize_t)]
   end function dimensions

   !> Values a row.
   pure integer function width(self)
      class(hdf5_rows_type), intent(in) :: self
      width = 1
      if (allocated(self%extents)) width = product(self%extents)
   end function width

   !> Writes rows from the `first` on, values(width, rows).
   subroutine write_rows(self, file, first, values)
      class(hdf5_rows_type), intent(in) :: self
      class(hdf5_type), intent(inout) :: file
      integer, intent(in) :: first
      real(wp), intent(in), contiguous :: values(:, :)
      call write_behind(self, file, first - 1_i8, values)
   end subroutine write_rows

   !> Adds rows, values(width, rows).
   subroutine append(self, file, values)
      class(hdf5_rows_type), intent(inout) :: self
      class(hdf5_type), intent(inout) :: file
      real(wp), intent(in), contiguous :: values(:, :)
      integer :: status
      if (allocated(file%failure) .or. size(values) == 0) return
      call h5dset_extent_f(self%id, dimensions(self, self%length + size(values, 2)), status)
      call file%check(status, 'lengthen a dataset')
      if (size(values, 2) == self%chunk .and. modulo(self%length, size(values, 2, i8)) == 0) then
         call write_chunk(self, file, values)
      else
         call write_behind(self, file, self%length, values)
      end if
      call set_length(self, self%length + size(values, 2))
   end subroutine append

   !> Writes a whole chunk behind all rows as it lies in memory: HDF5 would clear one and copy into it.
   subroutine write_chunk(self, file, values)
      class(hdf5_rows_type), intent(in) :: self
      class(hdf5_type), intent(inout) :: file
      real(wp), intent(in), contiguous, target :: values(:, :)
      integer(c_int64_t) :: start(size(self%extents) + 1)
      integer :: status
      if (allocated(file%failure)) return
      start = 0
      start(1) = self%length
      status = h5dwrite_chunk(int(self%id, c_int64_t), int(self%transfer, c_int64_t), 0_c_int32_t, start, &
         & int(size(values)*(storage_size(values)/8), c_size_t), c_loc(values))
      call file%check(status, 'write '//trim(self%called))
   end subroutine write_chunk

   !> Writes rows behind the first `skip` ones.
   subroutine write_behind(self, file, skip, values)
      class(hdf5_rows_type), intent(in) :: self
      class(hdf5_type), intent(inout) :: file
      integer(i8), intent(in) :: skip
      real(wp), intent(in), contiguous, target :: values(:, :)
      integer(hid_t) :: memory, space
      integer :: status
      if (allocated(file%failure) .or. size(values) == 0) return
      call select_part(self%id, skip, dimensions(self, size(values, 2, i8)), memory, space, status)
      if (status >= 0) call h5dwrite_f(self%id, h5t_native_double, c_loc(values), status, memory, space, &
         & self%transfer)
      call file%check(status, 'write '//trim(self%called))
      call h5sclose_f(space, status)
      call h5sclose_f(memory, status)
   end subroutine write_behind

   !> Reads n rows from the `first` on, values(width, n).
   subroutine read_rows(self, file, first, n, values)
      class(hdf5_rows_type), intent(in) :: self
      class(hdf5_type), intent(inout) :: file
      integer, intent(in) :: first, n
      real(wp), allocatable, intent(out) :: values(:, :)
      call self%read_behind(file, first - 1_i8, n, values)
   end subroutine read_rows

   !> Reads the n rows behind the first `skip` ones, values(width, n); 0 after a failure.
   subroutine read_behind(self, file, skip, n, values)
      class(hdf5_rows_type), intent(in) :: self
      class(hdf5_type), intent(inout) :: file
      integer(i8), intent(in) :: skip
      integer, intent(in) :: n
      real(wp), allocatable, target, intent(out) :: values(:, :)
      integer(hid_t) :: memory, space
      integer :: status
      type(c_ptr) :: buffer
      allocate (values(self%width(), n))
      if (allocated(file%failure)) values = 0
      if (allocated(file%failure) .or. size(values) == 0) return
      buffer = c_loc(values)
      call select_part(self%id, skip, dimensions(self, int(n, i8)), memory, space, status)
      if (status >= 0) call h5dread_f(self%id, h5t_native_double, buffer, status, memory, space, &
         & self%transfer)
      call file%check_read(status, 'read '//trim(self%called))
      if (status < 0) values = 0
      call h5sclose_f(space, status)
      call h5sclose_f(memory, status)
   end subroutine read_behind

   !> Selects a part of a dataset that has these extents, the last of them behind the first `skip`, in file and memory.
   subroutine select_part(dataset, skip, extents, memory, space, status)
      integer(hid_t), intent(in) :: dataset
      integer(i8), intent(in) :: skip
      integer(hsize_t), intent(in) :: extents(:)
      integer(hid_t), intent(out) :: memory, space
      integer, intent(out) :: status
      integer(hsize_t) :: start(size(extents))
      start = 0
      start(size(start)) = skip
      call h5screate_simple_f(size(extents), extents, memory, status)
      call h5dget_space_f(dataset, space, status)
      call h5sselect_hyperslab_f(space, h5s_select_set_f, start, extents, status)
   end subroutine select_part

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
