!> An HDF5 file with datasets and dimension scales. After a failure every routine does nothing; `failure` says what
!> failed first. Datasets whose values lie in other files are refused, and those whose chunks claim too much memory.
module hdf5_file
   use, intrinsic :: iso_c_binding, only: c_char, c_loc, c_null_char, c_ptr
   use hdf5, only: hid_t, hsize_t, size_t, h5screate_f, h5screate_simple_f, h5sclose_f, h5s_scalar_f, &
      & h5sget_simple_extent_npoints_f, h5sget_simple_extent_ndims_f, h5tclose_f, h5tcopy_f, h5tequal_f, &
      & h5tget_size_f, h5tset_size_f, h5tset_strpad_f, h5t_fortran_s1, h5t_str_nullpad_f, h5dcreate_f, h5dopen_f, &
      & h5dwrite_f, h5dread_f, h5dclose_f, h5dget_space_f, h5dget_type_f, h5dget_create_plist_f, h5pget_layout_f, &
      & h5pget_chunk_f, h5pget_external_count_f, h5pclose_f, h5d_virtual_f, h5d_chunked_f, h5p_default_f, &
      & h5t_native_double, h5kind_to_type, h5_integer_kind
   use h5ds, only: h5dsset_scale_f, h5dsattach_scale_f
   use kinds, only: wp, i8
   use hdf5_base, only: hdf5_base_type
   implicit none (type, external)
   private
   public :: hdf5_type

   !> Most bytes of a chunk (ours have 32 kB a value of a sample), and most dimensions of a dataset.
   real(wp), parameter :: largest_chunk = 2.0_wp**26
   integer, parameter :: most_dimensions = 32

   type, extends(hdf5_base_type) :: hdf5_type
   contains
      !> Datasets by path; one of the name and size is overwritten. `scales` names the dimension scales, slowest
      !> dimension first, as h5py shows them, separated by blanks; a dataset whose only scale is itself becomes
      !> that scale.
      procedure :: put_count
      procedure :: put_array
      procedure :: put_labels
      procedure :: get_count
      procedure :: get_real
      procedure :: get_list
      procedure :: list_size
      !> For hdf5_series: opens a dataset; refuses numbers of another kind; describes a dataset.
      procedure :: open_dataset
      procedure :: expect_type
      procedure :: describe
   end type hdf5_type

   !> Numbers in a list; only a damaged file says more.
   integer(hsize_t), parameter :: largest_list = 100000000

contains

   subroutine put_count(self, path, value, long_name)
      class(hdf5_type), intent(inout) :: self
      character(len=*), intent(in) :: path, long_name
      integer(i8), intent(in) :: value
      integer(i8), target :: buffer
      integer(hid_t) :: dataset, kind
      if (allocated(self%failure)) return
      buffer = value
      kind = h5kind_to_type(i8, h5_integer_kind)
      call open_or_create(self, path, kind, [integer(hsize_t) ::], '1', long_name, '', dataset)
      call write_all(self, dataset, kind, c_loc(buffer), path)
   end subroutine put_count

   !> A number, or values in the order of Fortran, with these numbers in each dimension, the fastest first.
   subroutine put_array(self, path, values, counts, units, long_name, scales)
      class(hdf5_type), intent(inout) :: self
      character(len=*), intent(in) :: path, units, long_name, scales
      real(wp), intent(in) :: values(:)
      integer, intent(in) :: counts(:)
      real(wp), target :: buffer(size(values))
      integer(hid_t) :: dataset
      if (allocated(self%failure)) return
      buffer = values
      call open_or_create(self, path, h5t_native_double, int(counts, hsize_t), units, long_name, scales, dataset)
      call write_all(self, dataset, h5t_native_double, c_loc(buffer), path)
   end subroutine put_array

   !> Texts, all of one length in the file, filled up with zero bytes.
   subroutine put_labels(self, path, labels, counts, long_name, scales)
      class(hdf5_type), intent(inout) :: self
      character(len=*), intent(in) :: path, labels(:), long_name, scales
      integer, intent(in) :: counts(:)
      character(kind=c_char, len=len(labels)), target :: buffer(size(labels))
      integer(hid_t) :: dataset, kind
      integer :: status, i
      if (allocated(self%failure)) return
      do i = 1, size(labels)
         buffer(i) = trim(labels(i))//repeat(c_null_char, len(labels) - len_trim(labels(i)))
      end do
      call h5tcopy_f(h5t_fortran_s1, kind, status)
      call h5tset_size_f(kind, len(labels, size_t), status)
      call h5tset_strpad_f(kind, h5t_str_nullpad_f, status)
      call open_or_create(self, path, kind, int(counts, hsize_t), '1', long_name, scales, dataset)
      call write_all(self, dataset, kind, c_loc(buffer), path)
      call h5tclose_f(kind, status)
   end subroutine put_labels

   !> Opens a dataset whose values are in this file, in chunks of a size that HDF5 may take memory for; a failure, and
   !> a negative status, where there is none.
   subroutine open_dataset(self, path, dataset, status, access)
      class(hdf5_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      integer(hid_t), intent(out) :: dataset
      integer, intent(out) :: status
      !> How it is accessed, HDF5's list of properties.
      integer(hid_t), intent(in), optional :: access
      integer(hid_t) :: creation, chosen
      integer :: layout, files, ignored
      chosen = h5p_default_f
      if (present(access)) chosen = access
      call h5dopen_f(self%id, path, dataset, status, chosen)
      call self%check_read(status, 'open '//path)
      if (status < 0) return
      call h5dget_create_plist_f(dataset, creation, status)
      call h5pget_layout_f(creation, layout, status)
      if (status >= 0) call h5pget_external_count_f(creation, files, status)
      if (status >= 0 .and. (layout == h5d_virtual_f .or. files > 0)) status = -1
      call self%check_read(status, 'take the values of '//path//', which are in other files')
      if (status >= 0 .and. layout == h5d_chunked_f) then
         if (chunk_bytes(dataset, creation) > largest_chunk) status = -1
         call self%check_read(status, 'take memory for the chunks of '//path)
      end if
      call h5pclose_f(creation, ignored)
      if (status < 0) call h5dclose_f(dataset, ignored)
   end subroutine open_dataset

   !> Bytes of a chunk of a dataset, by its properties; very many where it does not say.
   real(wp) function chunk_bytes(dataset, creation) result(bytes)
      integer(hid_t), intent(in) :: dataset, creation
      integer(hsize_t) :: chunk(most_dimensions)
      integer(size_t) :: letter
      integer(hid_t) :: kind, space
      integer :: dimensions, status, ignored
      bytes = huge(bytes)
      call h5dget_type_f(dataset, kind, status)
      if (status < 0) return
      call h5tget_size_f(kind, letter, status)
      call h5tclose_f(kind, ignored)
      call h5dget_space_f(dataset, space, ignored)
      call h5sget_simple_extent_ndims_f(space, dimensions, ignored)
      call h5sclose_f(space, ignored)
      if (status < 0 .or. dimensions < 1 .or. dimensions > most_dimensions) return
      call h5pget_chunk_f(creation, dimensions, chunk, status)
      if (status == dimensions) bytes = product(real(chunk(:dimensions), wp))*letter
   end function chunk_bytes

   !> Opens or creates a dataset. One that is there must be the same: a damaged type may claim numbers of any size.
   subroutine open_or_create(self, path, kind, dims, units, long_name, scales, dataset)
      class(hdf5_type), intent(inout) :: self
      character(len=*), intent(in) :: path, units, long_name, scales
      integer(hid_t), intent(in) :: kind
      integer(hsize_t), intent(in) :: dims(:)
      integer(hid_t), intent(out) :: dataset
      integer(hid_t) :: space
      integer :: status
      if (self%has(path)) then
         call open_expected(self, path, kind, product(dims), dataset)
         return
      end if
      if (size(dims) == 0) then
         call h5screate_f(h5s_scalar_f, space, status)
      else
         call h5screate_simple_f(size(dims), dims, space, status)
      end if
      call h5dcreate_f(self%id, path, kind, space, dataset, status)
      call self%check(status, 'create '//path)
      call self%describe(dataset, units, long_name, scales, path)
      call h5sclose_f(space, status)
   end subroutine open_or_create

   !> Writes all of a dataset and closes it.
   subroutine write_all(self, dataset, kind, buffer, path)
      class(hdf5_type), intent(inout) :: self
      integer(hid_t), intent(in) :: dataset, kind
      type(c_ptr), intent(in) :: buffer
      character(len=*), intent(in) :: path
      integer :: status
      if (.not. allocated(self%failure)) call h5dwrite_f(dataset, kind, buffer, status)
      if (.not. allocated(self%failure)) call self%check(status, 'write '//path)
      call h5dclose_f(dataset, status)
      ! some of it is written only now
      call self%check(status, 'write '//path)
   end subroutine write_all

   integer(i8) function get_count(self, path)
      class(hdf5_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      integer(i8), target :: buffer
      buffer = 0
      call read_all(self, path, h5kind_to_type(i8, h5_integer_kind), 1, c_loc(buffer))
      get_count = buffer
   end function get_count

   real(wp) function get_real(self, path)
      class(hdf5_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      real(wp), target :: buffer
      buffer = 0
      call read_all(self, path, h5t_native_double, 1, c_loc(buffer))
      get_real = buffer
   end function get_real

   !> A list of this size.
   subroutine get_list(self, path, values)
      class(hdf5_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      real(wp), intent(out), contiguous, target :: values(:)
      values = 0
      call read_all(self, path, h5t_native_double, size(values), c_loc(values))
   end subroutine get_list

   !> Numbers in a dataset; 0, and a failure, where there is none.
   integer function list_size(self, path)
      class(hdf5_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      integer(hid_t) :: dataset, space
      integer(hsize_t) :: points
      integer :: status
      list_size = 0
      if (.not. self%has(path)) call self%check_read(-1, 'find '//path)
      if (allocated(self%failure)) return
      call self%open_dataset(path, dataset, status)
      if (status < 0) return
      call h5dget_space_f(dataset, space, status)
      call h5sget_simple_extent_npoints_f(space, points, status)
      if (status >= 0 .and. points > largest_list) status = -1
      call self%check_read(status, 'find the size of '//path)
      if (.not. allocated(self%failure)) list_size = int(points)
      call h5sclose_f(space, status)
      call h5dclose_f(dataset, status)
   end function list_size

   !> Reads a dataset of n numbers; a failure where it has another size.
   subroutine read_all(self, path, kind, n, buffer)
      class(hdf5_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      integer(hid_t), intent(in) :: kind
      integer, intent(in) :: n
      type(c_ptr), value :: buffer
      integer(hid_t) :: dataset
      integer :: status
      if (allocated(self%failure)) return
      if (.not. self%has(path)) call self%check_read(-1, 'find '//path)
      call open_expected(self, path, kind, int(n, hsize_t), dataset)
      if (dataset < 0) return
      status = 0
      if (.not. allocated(self%failure)) call h5dread_f(dataset, kind, buffer, status)
      call self%check_read(status, 'read '//path)
      call h5dclose_f(dataset, status)
   end subroutine read_all

   !> Opens a dataset of n values of a kind; a failure where it has others, and a negative number where it is not open.
   subroutine open_expected(self, path, kind, n, dataset)
      class(hdf5_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      integer(hid_t), intent(in) :: kind
      integer(hsize_t), intent(in) :: n
      integer(hid_t), intent(out) :: dataset
      integer(hid_t) :: space
      integer(hsize_t) :: points
      integer :: status
      dataset = -1
      if (allocated(self%failure)) return
      call self%open_dataset(path, dataset, status)
      if (status < 0) dataset = -1
      if (status < 0) return
      call self%expect_type(dataset, kind, path)
      call h5dget_space_f(dataset, space, status)
      call h5sget_simple_extent_npoints_f(space, points, status)
      if (status >= 0 .and. points /= n) status = -1
      call self%check_read(status, 'find the right size of '//path)
      call h5sclose_f(space, status)
   end subroutine open_expected

   !> Refuses numbers that are not stored as in memory: HDF5 would convert the rubbish in a damaged file.
   subroutine expect_type(self, dataset, kind, path)
      class(hdf5_type), intent(inout) :: self
      integer(hid_t), intent(in) :: dataset, kind
      character(len=*), intent(in) :: path
      integer(hid_t) :: found
      integer :: status
      logical :: same
      same = .false.
      call h5dget_type_f(dataset, found, status)
      if (status >= 0) call h5tequal_f(found, kind, same, status)
      if (.not. same) call self%check_read(-1, 'find numbers of the right kind in '//path)
      call h5tclose_f(found, status)
   end subroutine expect_type

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
         call h5dopen_f(self%id, name, scale, status)
         call h5dsattach_scale_f(dataset, scale, dimension, status)
         call self%check(status, 'attach '//name//' to '//path)
         call h5dclose_f(scale, status)
      end do
   end subroutine describe
end module hdf5_file
