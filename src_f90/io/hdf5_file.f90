!> A thin face of HDF5: groups, attributes, dimension scales, fixed and growing datasets. The only file
!> that knows HDF5. After a failure every routine does nothing; `failure` says what failed first.
module hdf5_file
   use, intrinsic :: iso_c_binding, only: c_char, c_loc, c_null_char, c_ptr
   use hdf5, only: hid_t, hsize_t, h5open_f, h5dont_atexit_f, h5eset_auto_f, h5fcreate_f, h5fclose_f, h5fflush_f, &
      & h5f_acc_trunc_f, h5f_scope_local_f, h5gcreate_f, h5gclose_f, h5screate_f, h5screate_simple_f, &
      & h5sclose_f, h5s_scalar_f, h5s_unlimited_f, h5sget_simple_extent_ndims_f, &
      & h5sselect_hyperslab_f, h5s_select_set_f, h5tcopy_f, &
      & h5tclose_f, h5tset_cset_f, h5t_string, h5t_cset_utf8_f, h5acreate_f, h5awrite_f, h5aclose_f, &
      & h5adelete_f, h5aexists_f, h5dcreate_f, h5dopen_f, h5dwrite_f, h5dread_f, h5dclose_f, &
      & h5dset_extent_f, h5dget_space_f, h5pcreate_f, h5pclose_f, h5pset_chunk_f, h5p_dataset_create_f, &
      & h5pset_chunk_cache_f, h5p_dataset_access_f, size_t, &
      & h5t_native_double, h5t_native_integer, h5kind_to_type, h5_integer_kind
   use h5ds, only: h5dsset_scale_f, h5dsattach_scale_f
   use kinds, only: wp, i8
   implicit none (type, external)
   private
   public :: hdf5_type, growing_type

   !> Samples in a chunk of a growing dataset.
   integer(hsize_t), parameter :: chunk_samples = 1024

   !> A dataset that grows along time, `width` values a sample.
   type :: growing_type
      private
      integer(hid_t) :: id = -1
      integer(hsize_t) :: width = 1, length = 0
   end type growing_type

   type :: hdf5_type
      private
      integer(hid_t) :: file = -1
      !> What failed first; not allocated while all is well.
      character(len=:), allocatable, public :: failure
   contains
      !> Creates a file (replacing one of the name), closes it, writes what is pending.
      procedure :: create
      procedure :: close => close_file
      procedure :: flush => flush_file
      procedure :: make_group
      !> Root attributes.
      procedure :: put_text
      procedure :: put_flag
      !> Datasets by path. `scales` names the dimension scales, slowest dimension first, as h5py shows
      !> them, separated by blanks; a dataset whose only scale is itself becomes that scale.
      procedure :: put_count
      procedure :: put_real
      procedure :: put_list
      procedure :: put_table
      procedure :: make_growing
      procedure :: append
      procedure :: read_tail
      procedure :: close_growing
      procedure, private :: check
      procedure, private :: describe
      procedure, private :: write_reals
      procedure, private :: write_attribute
   end type hdf5_type

contains

   subroutine create(self, path)
      class(hdf5_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      integer :: status
      ! what is open is closed here; at exit HDF5 would crash over a file it could not write
      call h5dont_atexit_f(status)
      call h5open_f(status)
      ! HDF5 would print its own stack of errors
      call h5eset_auto_f(0, status)
      call h5fcreate_f(path, h5f_acc_trunc_f, self%file, status)
      call self%check(status, 'create the file')
   end subroutine create

   subroutine close_file(self)
      class(hdf5_type), intent(inout) :: self
      integer :: status
      if (self%file < 0) return
      call h5fclose_f(self%file, status)
      call self%check(status, 'close the file')
      self%file = -1
   end subroutine close_file

   subroutine flush_file(self)
      class(hdf5_type), intent(inout) :: self
      integer :: status
      if (allocated(self%failure)) return
      call h5fflush_f(self%file, h5f_scope_local_f, status)
      call self%check(status, 'flush the file')
   end subroutine flush_file

   subroutine make_group(self, name)
      class(hdf5_type), intent(inout) :: self
      character(len=*), intent(in) :: name
      integer(hid_t) :: group
      integer :: status
      if (allocated(self%failure)) return
      call h5gcreate_f(self%file, name, group, status)
      call self%check(status, 'create group '//name)
      call h5gclose_f(group, status)
   end subroutine make_group

   !> Root attribute, UTF-8 of variable length.
   subroutine put_text(self, name, text)
      class(hdf5_type), intent(inout) :: self
      character(len=*), intent(in) :: name, text
      if (.not. allocated(self%failure)) call self%write_attribute(self%file, name, text)
   end subroutine put_text

   !> Integer root attribute; replaces one of the name.
   subroutine put_flag(self, name, value)
      class(hdf5_type), intent(inout) :: self
      character(len=*), intent(in) :: name
      integer, intent(in) :: value
      integer, target :: buffer
      integer(hid_t) :: space, attribute
      integer :: status
      logical :: exists
      if (allocated(self%failure)) return
      buffer = value
      call h5aexists_f(self%file, name, exists, status)
      if (exists) call h5adelete_f(self%file, name, status)
      call h5screate_f(h5s_scalar_f, space, status)
      call h5acreate_f(self%file, name, h5t_native_integer, space, attribute, status)
      call self%check(status, 'create attribute '//name)
      call h5awrite_f(attribute, h5t_native_integer, c_loc(buffer), status)
      call self%check(status, 'write attribute '//name)
      call h5aclose_f(attribute, status)
      call h5sclose_f(space, status)
   end subroutine put_flag

   subroutine put_count(self, path, value, long_name)
      class(hdf5_type), intent(inout) :: self
      character(len=*), intent(in) :: path, long_name
      integer(i8), intent(in) :: value
      integer(i8), target :: buffer
      integer(hid_t) :: space, dataset, kind
      integer :: status
      if (allocated(self%failure)) return
      buffer = value
      kind = h5kind_to_type(i8, h5_integer_kind)
      call h5screate_f(h5s_scalar_f, space, status)
      call h5dcreate_f(self%file, path, kind, space, dataset, status)
      call self%check(status, 'create '//path)
      call h5dwrite_f(dataset, kind, c_loc(buffer), status)
      call self%check(status, 'write '//path)
      call self%describe(dataset, '1', long_name, '', path)
      call h5dclose_f(dataset, status)
      call h5sclose_f(space, status)
   end subroutine put_count

   subroutine put_real(self, path, value, units, long_name)
      class(hdf5_type), intent(inout) :: self
      character(len=*), intent(in) :: path, units, long_name
      real(wp), intent(in) :: value
      call self%write_reals(path, [value], [integer(hsize_t) ::], units, long_name, '')
   end subroutine put_real

   subroutine put_list(self, path, values, units, long_name, scales)
      class(hdf5_type), intent(inout) :: self
      character(len=*), intent(in) :: path, units, long_name, scales
      real(wp), intent(in) :: values(:)
      call self%write_reals(path, values, int([size(values)], hsize_t), units, long_name, scales)
   end subroutine put_list

   subroutine put_table(self, path, values, units, long_name, scales)
      class(hdf5_type), intent(inout) :: self
      character(len=*), intent(in) :: path, units, long_name, scales
      real(wp), intent(in) :: values(:, :)
      call self%write_reals(path, [values], int(shape(values), hsize_t), units, long_name, scales)
   end subroutine put_table

   subroutine write_reals(self, path, values, dims, units, long_name, scales)
      class(hdf5_type), intent(inout) :: self
      character(len=*), intent(in) :: path, units, long_name, scales
      real(wp), intent(in) :: values(:)
      integer(hsize_t), intent(in) :: dims(:)
      real(wp), target :: buffer(size(values))
      integer(hid_t) :: space, dataset
      integer :: status
      if (allocated(self%failure)) return
      buffer = values
      if (size(dims) == 0) then
         call h5screate_f(h5s_scalar_f, space, status)
      else
         call h5screate_simple_f(size(dims), dims, space, status)
      end if
      call h5dcreate_f(self%file, path, h5t_native_double, space, dataset, status)
      call self%check(status, 'create '//path)
      call h5dwrite_f(dataset, h5t_native_double, c_loc(buffer), status)
      call self%check(status, 'write '//path)
      call self%describe(dataset, units, long_name, scales, path)
      call h5dclose_f(dataset, status)
      call h5sclose_f(space, status)
   end subroutine write_reals

   !> A dataset over time; with width > 0 of (time, width), with width 0 of (time).
   subroutine make_growing(self, path, width, units, long_name, scales, growing)
      class(hdf5_type), intent(inout) :: self
      character(len=*), intent(in) :: path, units, long_name, scales
      integer, intent(in) :: width
      type(growing_type), intent(out) :: growing
      integer(hsize_t), allocatable :: dims(:), most(:), chunk(:)
      integer(hid_t) :: space, properties, access
      integer :: status
      if (allocated(self%failure)) return
      growing%width = max(width, 1)
      dims = int([0], hsize_t)
      most = int([h5s_unlimited_f], hsize_t)
      chunk = [chunk_samples]
      if (width > 0) then
         dims = [growing%width, dims]
         most = [growing%width, most]
         chunk = [growing%width, chunk]
      end if
      call h5screate_simple_f(size(dims), dims, space, status, most)
      call h5pcreate_f(h5p_dataset_create_f, properties, status)
      call h5pset_chunk_f(properties, size(chunk), chunk, status)
      ! whole chunks are written as they come: a cache of them would only cost memory
      call h5pcreate_f(h5p_dataset_access_f, access, status)
      call h5pset_chunk_cache_f(access, 0_size_t, 0_size_t, 0.0, status)
      call h5dcreate_f(self%file, path, h5t_native_double, space, growing%id, status, properties, &
         & dapl_id=access)
      call self%check(status, 'create '//path)
      call self%describe(growing%id, units, long_name, scales, path)
      call h5pclose_f(access, status)
      call h5pclose_f(properties, status)
      call h5sclose_f(space, status)
   end subroutine make_growing

   !> Adds samples, values(width, samples), in memory order.
   subroutine append(self, growing, values)
      class(hdf5_type), intent(inout) :: self
      type(growing_type), intent(inout) :: growing
      real(wp), intent(in), contiguous, target :: values(:, :)
      integer(hid_t) :: memory, space
      integer :: status
      if (allocated(self%failure) .or. size(values) == 0) return
      growing%length = growing%length + size(values, 2)
      call select_tail(growing, size(values, 2), memory, space, status, grow=.true.)
      if (status >= 0) call h5dwrite_f(growing%id, h5t_native_double, c_loc(values), status, memory, space)
      call self%check(status, 'write samples')
      call h5sclose_f(space, status)
      call h5sclose_f(memory, status)
   end subroutine append

   !> The last n samples, values(width, n).
   subroutine read_tail(self, growing, n, values)
      class(hdf5_type), intent(inout) :: self
      type(growing_type), intent(in) :: growing
      integer, intent(in) :: n
      real(wp), allocatable, target, intent(out) :: values(:, :)
      integer(hid_t) :: memory, space
      integer :: status
      type(c_ptr) :: buffer
      allocate (values(growing%width, n), source=0.0_wp)
      buffer = c_loc(values)
      if (allocated(self%failure) .or. n == 0) return
      call select_tail(growing, n, memory, space, status, grow=.false.)
      if (status >= 0) call h5dread_f(growing%id, h5t_native_double, buffer, status, memory, space)
      call self%check(status, 'read samples')
      call h5sclose_f(space, status)
      call h5sclose_f(memory, status)
   end subroutine read_tail

   !> Selects the last n samples in file and memory, after growing the dataset to its length if asked.
   subroutine select_tail(growing, n, memory, space, status, grow)
      type(growing_type), intent(in) :: growing
      integer, intent(in) :: n
      integer(hid_t), intent(out) :: memory, space
      integer, intent(out) :: status
      logical, intent(in) :: grow
      integer(hsize_t), allocatable :: start(:), count(:), dims(:)
      integer :: rank
      start = [growing%length - n]
      count = int([n], hsize_t)
      dims = [growing%length]
      call h5dget_space_f(growing%id, space, status)
      call h5sget_simple_extent_ndims_f(space, rank, status)
      if (rank == 2) then
         start = [0_hsize_t, start]
         count = [growing%width, count]
         dims = [growing%width, dims]
      end if
      if (grow) then
         call h5sclose_f(space, status)
         call h5dset_extent_f(growing%id, dims, status)
         if (status < 0) return
         call h5dget_space_f(growing%id, space, status)
      end if
      call h5screate_simple_f(rank, count, memory, status)
      call h5sselect_hyperslab_f(space, h5s_select_set_f, start, count, status)
   end subroutine select_tail

   subroutine close_growing(self, growing)
      class(hdf5_type), intent(inout) :: self
      type(growing_type), intent(inout) :: growing
      integer :: status
      if (growing%id < 0) return
      call h5dclose_f(growing%id, status)
      call self%check(status, 'close a dataset')
      growing%id = -1
   end subroutine close_growing

   !> Units, long name and dimension scales of a dataset.
   subroutine describe(self, dataset, units, long_name, scales, path)
      class(hdf5_type), intent(inout) :: self
      integer(hid_t), intent(in) :: dataset
      character(len=*), intent(in) :: units, long_name, scales, path
      character(len=:), allocatable :: rest, name
      integer(hid_t) :: scale
      integer :: status, blank, dimension
      if (allocated(self%failure)) return
      call self%write_attribute(dataset, 'units', units)
      call self%write_attribute(dataset, 'long_name', long_name)
      if (scales == path) then
         call h5dsset_scale_f(dataset, status, path(index(path, '/', back=.true.) + 1:))
         call self%check(status, 'make '//path//' a scale')
         return
      end if
      rest = trim(scales)
      dimension = 0
      do while (len(rest) > 0)
         blank = index(rest//' ', ' ')
         name = rest(:blank - 1)
         rest = rest(min(blank + 1, len(rest) + 1):)
         dimension = dimension + 1
         call h5dopen_f(self%file, name, scale, status)
         call h5dsattach_scale_f(dataset, scale, dimension, status)
         call self%check(status, 'attach '//name//' to '//path)
         call h5dclose_f(scale, status)
      end do
   end subroutine describe

   subroutine write_attribute(self, object, name, text)
      class(hdf5_type), intent(inout) :: self
      integer(hid_t), intent(in) :: object
      character(len=*), intent(in) :: name, text
      character(kind=c_char, len=:), allocatable, target :: buffer
      type(c_ptr), target :: pointer(1)
      integer(hid_t) :: space, attribute, kind
      integer :: status
      if (allocated(self%failure)) return
      buffer = text//c_null_char
      pointer(1) = c_loc(buffer)
      call h5tcopy_f(h5t_string, kind, status)
      call h5tset_cset_f(kind, h5t_cset_utf8_f, status)
      call h5screate_f(h5s_scalar_f, space, status)
      call h5acreate_f(object, name, kind, space, attribute, status)
      call self%check(status, 'create attribute '//name)
      call h5awrite_f(attribute, kind, c_loc(pointer), status)
      call self%check(status, 'write attribute '//name)
      call h5aclose_f(attribute, status)
      call h5sclose_f(space, status)
      call h5tclose_f(kind, status)
   end subroutine write_attribute

   !> Keeps the first failure.
   subroutine check(self, status, action)
      class(hdf5_type), intent(inout) :: self
      integer, intent(in) :: status
      character(len=*), intent(in) :: action
      if (status < 0 .and. .not. allocated(self%failure)) self%failure = 'HDF5 could not '//action
   end subroutine check
end module hdf5_file
