!> A thin face of HDF5: groups, attributes, dimension scales, datasets. With hdf5_series the only file that knows
!> HDF5. After a failure every routine does nothing; `failure` says what failed first.
module hdf5_file
   use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_f_pointer, c_loc, c_null_char, c_null_ptr, c_ptr, &
      & c_size_t
   use hdf5, only: hid_t, hsize_t, h5open_f, h5dont_atexit_f, h5eset_auto_f, h5fcreate_f, h5fopen_f, h5fclose_f, &
      & h5f_acc_trunc_f, h5f_acc_rdonly_f, h5f_acc_rdwr_f, h5gcreate_f, h5gclose_f, h5screate_f, h5screate_simple_f, &
      & h5sclose_f, h5s_scalar_f, h5sget_simple_extent_npoints_f, h5tcopy_f, h5tclose_f, h5tset_cset_f, &
      & h5tis_variable_str_f, h5t_string, h5t_cset_utf8_f, h5acreate_f, h5aopen_f, h5aread_f, h5awrite_f, h5aclose_f, &
      & h5aget_type_f, h5adelete_f, h5aexists_f, h5dcreate_f, h5dopen_f, h5dwrite_f, h5dread_f, h5dclose_f, &
      & h5dget_space_f, h5lexists_f, h5ldelete_f, h5t_native_double, h5t_native_integer, h5kind_to_type, h5_integer_kind
   use h5ds, only: h5dsset_scale_f, h5dsattach_scale_f
   use kinds, only: wp, i8
   use posix, only: set_environment, system_reason
   implicit none (type, external)
   private
   public :: hdf5_type

   type :: hdf5_type
      private
      !> HDF5's number of the open file, for hdf5_series.
      integer(hid_t), public :: id = -1
      !> What failed first; not allocated while all is well.
      character(len=:), allocatable, public :: failure
   contains
      !> Creates a file (replacing one of the name), opens one, closes it.
      procedure :: create
      procedure :: open => open_file
      procedure :: close => close_file
      procedure :: make_group
      !> True where there is a dataset, group or root attribute of that name.
      procedure :: has
      procedure :: has_attribute
      !> Deletes a dataset or group.
      procedure :: delete
      !> Root attributes; one of the name is replaced.
      procedure :: put_text
      procedure :: put_flag
      procedure :: get_text
      procedure :: get_flag
      !> Datasets by path; one of the name and size is overwritten. `scales` names the dimension scales, slowest
      !> dimension first, as h5py shows them, separated by blanks; a dataset whose only scale is itself becomes
      !> that scale.
      procedure :: put_count
      procedure :: put_real
      procedure :: put_list
      procedure :: put_table
      procedure :: get_count
      procedure :: get_real
      procedure :: get_list
      !> For hdf5_series: notes a failed action; describes a dataset.
      procedure :: check
      procedure :: describe
      procedure, private :: begin
      procedure, private :: place
      procedure, private :: write_all
      procedure, private :: read_all
      procedure, private :: write_reals
      procedure, private :: write_attribute
   end type hdf5_type

   interface
      integer(c_size_t) function c_strlen(text) bind(c, name='strlen')
         import :: c_ptr, c_size_t
         type(c_ptr), value :: text
      end function c_strlen

      subroutine c_free(memory) bind(c, name='free')
         import :: c_ptr
         type(c_ptr), value :: memory
      end subroutine c_free
   end interface

contains

   !> Readies the library.
   subroutine begin(self)
      class(hdf5_type), intent(inout) :: self
      integer :: status
      ! HDF5's own locks are for readers in the middle of a write; many file systems know none
      call set_environment('HDF5_USE_FILE_LOCKING', 'BEST_EFFORT')
      ! what is open is closed here; at exit HDF5 would crash over a file it could not write
      call h5dont_atexit_f(status)
      call h5open_f(status)
      ! HDF5 would print its own stack of errors
      call h5eset_auto_f(0, status)
      if (allocated(self%failure)) deallocate (self%failure)
   end subroutine begin

   subroutine create(self, path)
      class(hdf5_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      integer :: status
      call self%begin()
      call h5fcreate_f(path, h5f_acc_trunc_f, self%id, status)
      call self%check(status, 'create the file')
   end subroutine create

   subroutine open_file(self, path, writing)
      class(hdf5_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      logical, intent(in) :: writing
      integer :: status
      call self%begin()
      call h5fopen_f(path, merge(h5f_acc_rdwr_f, h5f_acc_rdonly_f, writing), self%id, status)
      call self%check(status, 'open the file')
      if (status < 0) self%id = -1
   end subroutine open_file

   subroutine close_file(self)
      class(hdf5_type), intent(inout) :: self
      integer :: status
      if (self%id < 0) return
      call h5fclose_f(self%id, status)
      call self%check(status, 'close the file')
      self%id = -1
   end subroutine close_file

   logical function has(self, path)
      class(hdf5_type), intent(in) :: self
      character(len=*), intent(in) :: path
      integer :: status, slash
      slash = index(path, '/')
      has = .not. allocated(self%failure)
      ! HDF5 wants to be asked for the group first
      if (has .and. slash > 0) call h5lexists_f(self%id, path(:slash - 1), has, status)
      if (has) call h5lexists_f(self%id, path, has, status)
   end function has

   logical function has_attribute(self, name) result(has)
      class(hdf5_type), intent(in) :: self
      character(len=*), intent(in) :: name
      integer :: status
      has = .false.
      if (.not. allocated(self%failure)) call h5aexists_f(self%id, name, has, status)
   end function has_attribute

   subroutine delete(self, path)
      class(hdf5_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      integer :: status
      if (.not. self%has(path)) return
      call h5ldelete_f(self%id, path, status)
      call self%check(status, 'delete '//path)
   end subroutine delete

   subroutine make_group(self, name)
      class(hdf5_type), intent(inout) :: self
      character(len=*), intent(in) :: name
      integer(hid_t) :: group
      integer :: status
      if (allocated(self%failure)) return
      call h5gcreate_f(self%id, name, group, status)
      call self%check(status, 'create group '//name)
      call h5gclose_f(group, status)
   end subroutine make_group

   !> Root attribute, UTF-8 of variable length.
   subroutine put_text(self, name, text)
      class(hdf5_type), intent(inout) :: self
      character(len=*), intent(in) :: name, text
      integer :: status
      if (self%has_attribute(name)) call h5adelete_f(self%id, name, status)
      call self%write_attribute(self%id, name, text)
   end subroutine put_text

   !> Text attribute; empty, and a failure, where there is none.
   subroutine get_text(self, name, text)
      class(hdf5_type), intent(inout) :: self
      character(len=*), intent(in) :: name
      character(len=:), allocatable, intent(out) :: text
      type(c_ptr), target :: pointer(1)
      type(c_ptr) :: buffer
      character(kind=c_char), pointer :: characters(:)
      integer(hid_t) :: attribute, kind
      integer :: i
      integer :: status
      logical :: variable
      text = ''
      if (allocated(self%failure)) return
      call h5aopen_f(self%id, name, attribute, status)
      call self%check(status, 'find attribute '//name)
      if (status < 0) return
      call h5aget_type_f(attribute, kind, status)
      call h5tis_variable_str_f(kind, variable, status)
      if (status >= 0 .and. .not. variable) status = -1
      pointer(1) = c_null_ptr
      buffer = c_loc(pointer)
      if (status >= 0) call h5aread_f(attribute, kind, buffer, status)
      call self%check(status, 'read attribute '//name)
      if (c_associated(pointer(1))) then
         call c_f_pointer(pointer(1), characters, [c_strlen(pointer(1))])
         text = repeat(' ', size(characters))
         do i = 1, size(characters)
            text(i:i) = characters(i)
         end do
         call c_free(pointer(1))
      end if
      call h5tclose_f(kind, status)
      call h5aclose_f(attribute, status)
   end subroutine get_text

   !> Integer root attribute; replaces one of the name.
   subroutine put_flag(self, name, value)
      class(hdf5_type), intent(inout) :: self
      character(len=*), intent(in) :: name
      integer, intent(in) :: value
      integer, target :: buffer
      integer(hid_t) :: space, attribute
      integer :: status
      if (allocated(self%failure)) return
      buffer = value
      if (self%has_attribute(name)) call h5adelete_f(self%id, name, status)
      call h5screate_f(h5s_scalar_f, space, status)
      call h5acreate_f(self%id, name, h5t_native_integer, space, attribute, status)
      call self%check(status, 'create attribute '//name)
      call h5awrite_f(attribute, h5t_native_integer, c_loc(buffer), status)
      call self%check(status, 'write attribute '//name)
      call h5aclose_f(attribute, status)
      call h5sclose_f(space, status)
   end subroutine put_flag

   !> Integer attribute; 0, and a failure, where there is none.
   subroutine get_flag(self, name, value)
      class(hdf5_type), intent(inout) :: self
      character(len=*), intent(in) :: name
      integer, intent(out) :: value
      integer, target :: buffer
      type(c_ptr) :: pointer
      integer(hid_t) :: attribute
      integer :: status
      value = 0
      if (allocated(self%failure)) return
      buffer = 0
      pointer = c_loc(buffer)
      call h5aopen_f(self%id, name, attribute, status)
      if (status >= 0) then
         call h5aread_f(attribute, h5t_native_integer, pointer, status)
         call self%check(status, 'read attribute '//name)
         call h5aclose_f(attribute, status)
      else
         call self%check(status, 'find attribute '//name)
      end if
      value = buffer
   end subroutine get_flag

   subroutine put_count(self, path, value, long_name)
      class(hdf5_type), intent(inout) :: self
      character(len=*), intent(in) :: path, long_name
      integer(i8), intent(in) :: value
      integer(i8), target :: buffer
      integer(hid_t) :: dataset, kind
      if (allocated(self%failure)) return
      buffer = value
      kind = h5kind_to_type(i8, h5_integer_kind)
      call self%place(path, kind, [integer(hsize_t) ::], '1', long_name, '', dataset)
      call self%write_all(dataset, kind, c_loc(buffer), path)
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
      integer(hid_t) :: dataset
      if (allocated(self%failure)) return
      buffer = values
      call self%place(path, h5t_native_double, dims, units, long_name, scales, dataset)
      call self%write_all(dataset, h5t_native_double, c_loc(buffer), path)
   end subroutine write_reals

   !> Opens a dataset, or makes it.
   subroutine place(self, path, kind, dims, units, long_name, scales, dataset)
      class(hdf5_type), intent(inout) :: self
      character(len=*), intent(in) :: path, units, long_name, scales
      integer(hid_t), intent(in) :: kind
      integer(hsize_t), intent(in) :: dims(:)
      integer(hid_t), intent(out) :: dataset
      integer(hid_t) :: space
      integer :: status
      if (self%has(path)) then
         call h5dopen_f(self%id, path, dataset, status)
         call self%check(status, 'open '//path)
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
   end subroutine place

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
   end subroutine write_all

   integer(i8) function get_count(self, path)
      class(hdf5_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      integer(i8), target :: buffer
      buffer = 0
      call self%read_all(path, h5kind_to_type(i8, h5_integer_kind), 1, c_loc(buffer))
      get_count = buffer
   end function get_count

   real(wp) function get_real(self, path)
      class(hdf5_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      real(wp), target :: buffer
      buffer = 0
      call self%read_all(path, h5t_native_double, 1, c_loc(buffer))
      get_real = buffer
   end function get_real

   !> A list of this size.
   subroutine get_list(self, path, values)
      class(hdf5_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      real(wp), intent(out), contiguous, target :: values(:)
      values = 0
      call self%read_all(path, h5t_native_double, size(values), c_loc(values))
   end subroutine get_list

   !> Reads a dataset of n numbers; a failure where it has another size.
   subroutine read_all(self, path, kind, n, buffer)
      class(hdf5_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      integer(hid_t), intent(in) :: kind
      integer, intent(in) :: n
      type(c_ptr), value :: buffer
      integer(hid_t) :: dataset, space
      integer(hsize_t) :: points
      integer :: status
      if (allocated(self%failure)) return
      status = -1
      if (self%has(path)) call h5dopen_f(self%id, path, dataset, status)
      call self%check(status, 'open '//path)
      if (status < 0) return
      call h5dget_space_f(dataset, space, status)
      call h5sget_simple_extent_npoints_f(space, points, status)
      if (status >= 0 .and. points /= n) status = -1
      if (status >= 0) call h5dread_f(dataset, kind, buffer, status)
      call self%check(status, 'read '//path)
      call h5sclose_f(space, status)
      call h5dclose_f(dataset, status)
   end subroutine read_all

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
      character(len=:), allocatable :: reason
      if (status >= 0 .or. allocated(self%failure)) return
      reason = system_reason()
      self%failure = 'HDF5 could not '//action
      if (reason /= '') self%failure = self%failure//': '//reason
   end subroutine check
end module hdf5_file
