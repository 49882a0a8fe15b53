!> Datasets that grow along an axis. After a failure, which the file keeps, every routine does nothing.
module hdf5_series
   use, intrinsic :: iso_c_binding, only: c_loc, c_ptr
   use hdf5, only: hid_t, hsize_t, size_t, h5s_unlimited_f, h5s_select_set_f, h5screate_simple_f, h5sclose_f, &
      & h5sget_simple_extent_ndims_f, h5sget_simple_extent_dims_f, h5sselect_hyperslab_f, h5dcreate_f, &
      & h5dwrite_f, h5dread_f, h5dclose_f, h5dset_extent_f, h5dget_space_f, h5pcreate_f, h5pclose_f, h5pset_chunk_f, &
      & h5pset_chunk_cache_f, h5p_dataset_create_f, h5p_dataset_access_f, h5t_native_double
   use kinds, only: wp, i8
   use hdf5_file, only: hdf5_type
   implicit none (type, external)
   private
   public :: hdf5_series_type, chunk_samples, without_cache, select_part

   !> Samples in a chunk, at most: a series that is known to be shorter has chunks of its own length.
   integer, parameter :: chunk_samples = 4096
   !> Most values a sample; only a damaged file says more.
   integer, parameter :: widest = 1000

   !> `width` values a sample: (axis) or, in the order of h5py, (axis, width).
   type :: hdf5_series_type
      private
      integer(hid_t) :: id = -1
      integer :: rank = 1
      integer, public :: width = 1
      !> Samples in the file.
      integer(i8), public :: length = 0
   contains
      procedure :: create
      procedure :: open => open_series
      procedure :: close => close_series
      procedure :: append
      procedure :: read => read_part
   end type hdf5_series_type

contains

   !> A new dataset; with width > 0 of (axis, width), with width 0 of (axis). `scales` as in hdf5_file. `expected`: how
   !> many samples it will have, if this is known; HDF5 takes room for whole chunks.
   subroutine create(self, file, path, width, units, long_name, scales, expected)
      class(hdf5_series_type), intent(inout) :: self
      class(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: path, units, long_name, scales
      integer, intent(in) :: width
      integer(i8), intent(in) :: expected
      integer(hsize_t), allocatable :: dims(:), most(:), chunk(:)
      integer(hid_t) :: space, properties, access
      integer :: status
      if (allocated(file%failure)) return
      self%width = max(width, 1)
      self%rank = merge(2, 1, width > 0)
      dims = int([0], hsize_t)
      most = int([h5s_unlimited_f], hsize_t)
      chunk = int([max(1_i8, min(expected, int(chunk_samples, i8)))], hsize_t)
      if (width > 0) then
         dims = [int(width, hsize_t), dims]
         most = [int(width, hsize_t), most]
         chunk = [int(width, hsize_t), chunk]
      end if
      call h5screate_simple_f(self%rank, dims, space, status, most)
      call h5pcreate_f(h5p_dataset_create_f, properties, status)
      call h5pset_chunk_f(properties, self%rank, chunk, status)
      access = without_cache()
      call h5dcreate_f(file%id, path, h5t_native_double, space, self%id, status, properties, dapl_id=access)
      call file%check(status, 'create '//path)
      call file%describe(self%id, units, long_name, scales, path)
      call h5pclose_f(access, status)
      call h5pclose_f(properties, status)
      call h5sclose_f(space, status)
   end subroutine create

   !> An existing dataset, of (axis) or (axis, width).
   subroutine open_series(self, file, path)
      class(hdf5_series_type), intent(inout) :: self
      class(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: path
      integer(hsize_t) :: dims(2), most(2)
      integer(hid_t) :: space, access
      integer :: status
      if (allocated(file%failure)) return
      access = without_cache()
      call file%open_dataset(path, self%id, status, access)
      if (status < 0) self%id = -1
      if (status >= 0) then
         call h5dget_space_f(self%id, space, status)
         call file%expect_type(self%id, h5t_native_double, path)
         call h5sget_simple_extent_ndims_f(space, self%rank, status)
         if (self%rank < 1 .or. self%rank > 2) status = -1
         dims = 1
         if (status >= 0) call h5sget_simple_extent_dims_f(space, dims, most, status)
         if (self%rank == 2 .and. dims(1) > widest) status = -1
         call file%check_read(status, 'read the size of '//path)
         if (status < 0) then
            self%rank = 1
            dims = 1
         end if
         self%width = merge(int(dims(1)), 1, self%rank == 2)
         self%length = dims(self%rank)
         call h5sclose_f(space, status)
      end if
      call h5pclose_f(access, status)
   end subroutine open_series

   !> Whole chunks are written as they come: a cache of them would only cost memory.
   integer(hid_t) function without_cache() result(access)
      integer :: status
      call h5pcreate_f(h5p_dataset_access_f, access, status)
      call h5pset_chunk_cache_f(access, 0_size_t, 0_size_t, 0.0, status)
   end function without_cache

   !> Adds samples, values(width, samples), in memory order.
   subroutine append(self, file, values)
      class(hdf5_series_type), intent(inout) :: self
      class(hdf5_type), intent(inout) :: file
      real(wp), intent(in), contiguous, target :: values(:, :)
      integer(hid_t) :: memory, space
      integer :: status
      if (allocated(file%failure) .or. size(values) == 0) return
      call h5dset_extent_f(self%id, extents(self, self%length + size(values, 2)), status)
      call file%check(status, 'lengthen a dataset')
      if (status < 0) return
      call select_part(self%id, self%length, extents(self, size(values, 2, i8)), memory, space, status)
      if (status >= 0) call h5dwrite_f(self%id, h5t_native_double, c_loc(values), status, memory, space)
      call file%check(status, 'write samples')
      self%length = self%length + size(values, 2)
      call h5sclose_f(space, status)
      call h5sclose_f(memory, status)
   end subroutine append

   !> The n samples behind the first `skip` ones, values(width, n).
   subroutine read_part(self, file, skip, n, values)
      class(hdf5_series_type), intent(in) :: self
      class(hdf5_type), intent(inout) :: file
      integer(i8), intent(in) :: skip
      integer, intent(in) :: n
      real(wp), allocatable, target, intent(out) :: values(:, :)
      integer(hid_t) :: memory, space
      integer :: status
      type(c_ptr) :: buffer
      allocate (values(self%width, n))
      buffer = c_loc(values)
      if (allocated(file%failure)) values = 0
      if (allocated(file%failure) .or. n == 0) return
      call select_part(self%id, skip, extents(self, int(n, i8)), memory, space, status)
      if (status >= 0) call h5dread_f(self%id, h5t_native_double, buffer, status, memory, space)
      call file%check_read(status, 'read samples')
      if (status < 0) values = 0
      call h5sclose_f(space, status)
      call h5sclose_f(memory, status)
   end subroutine read_part

   !> Sizes of the dimensions of n samples, the fastest first.
   pure function extents(self, n)
      type(hdf5_series_type), intent(in) :: self
      integer(i8), intent(in) :: n
      integer(hsize_t) :: extents(self%rank)
      extents(1) = self%width
      extents(self%rank) = n
   end function extents

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

   subroutine close_series(self, file)
      class(hdf5_series_type), intent(inout) :: self
      class(hdf5_type), intent(inout) :: file
      integer :: status
      if (self%id < 0) return
      call h5dclose_f(self%id, status)
      call file%check(status, 'close a dataset')
      self%id = -1
   end subroutine close_series
end module hdf5_series
