!> An HDF5 file: opening, groups, root attributes. After a failure every routine does nothing; `failure` says what
!> failed first. No other file is opened on behalf of one: links out of it are not followed, and HDF5 loads no library.
module hdf5_base
   use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_int, c_loc, c_null_char, c_null_ptr, c_ptr
   use hdf5, only: hid_t, hsize_t, size_t, h5open_f, h5dont_atexit_f, h5eset_auto_f, h5fcreate_f, h5fopen_f, &
      & h5fclose_f, h5f_acc_trunc_f, h5f_acc_rdonly_f, h5f_acc_rdwr_f, h5f_libver_v110_f, h5p_file_access_f, &
      & h5pcreate_f, h5pset_libver_bounds_f, h5pclose_f, h5gcreate_f, h5gclose_f, h5screate_f, h5sclose_f, &
      & h5s_scalar_f, h5tcopy_f, h5tclose_f, h5tset_cset_f, h5tis_variable_str_f, h5tget_super_f, h5tget_size_f, &
      & h5t_string, h5t_cset_utf8_f, h5acreate_f, h5aopen_f, h5aread_f, h5awrite_f, h5aclose_f, h5aget_type_f, &
      & h5adelete_f, h5aexists_f, h5aget_space_f, h5sget_simple_extent_npoints_f, h5lexists_f, h5ldelete_f, &
      & h5t_native_integer
   use errors, only: error_type, raise, system_error
   use processes, only: set_environment
   use system_texts, only: fortran_text, write_refusal, forget_missing
   implicit none (type, external)
   private
   public :: hdf5_base_type, start_hdf5, is_of_texts, kind_of_texts, c_free

   !> Version of a file's first structure from which on all have checksums (HDF5 1.10) but the heaps that hold texts of
   !> attributes and lists of scales; its byte in the file.
   integer, parameter :: first_with_checksums = 3, version_place = 9
   !> HDF5's number of the class of links to other files.
   integer(c_int), parameter :: external_links = 64

   type :: hdf5_base_type
      !> HDF5's number of the open file; negative where none is open.
      integer(hid_t) :: id = -1
      !> What failed first; not allocated while all is well.
      character(len=:), allocatable :: failure
      !> True where that was in reading.
      logical :: damaged = .false.
   contains
      !> Creates a file (replacing one of the name), opens one, closes it.
      procedure :: create
      procedure :: open => open_file
      procedure :: close => close_file
      !> Makes a group and those above it. True where there is a dataset, group or root attribute of that name.
      procedure :: make_group
      procedure :: has
      procedure :: has_attribute
      !> Deletes a dataset or group.
      procedure :: delete
      !> Root attributes; one of the name is replaced.
      procedure :: put_text
      procedure :: put_flag
      procedure :: get_text
      procedure :: get_flag
      !> What has gone wrong so far, as an error with a file of this name.
      procedure :: error_of
      !> For modules that build on it: keep a failed action, in writing and reading; write an attribute of any object.
      procedure :: check
      procedure :: check_read
      procedure :: write_attribute
   end type hdf5_base_type

   interface
      integer(c_int) function c_unregister_links(class) bind(c, name='H5Lunregister')
         import :: c_int
         integer(c_int), value :: class
      end function c_unregister_links

      integer(c_int) function c_allow_libraries(mask) bind(c, name='H5PLset_loading_state')
         import :: c_int
         integer(c_int), value :: mask
      end function c_allow_libraries

      subroutine c_free(memory) bind(c, name='free')
         import :: c_ptr
         type(c_ptr), value :: memory
      end subroutine c_free
   end interface

contains

   !> Readies the library. Files do so by themselves; a process that does it before it starts children saves them the
   !> time.
   subroutine start_hdf5()
      ! each further start would make HDF5's types anew and keep the old ones, through which every closing goes
      logical, save :: started = .false.
      integer :: status
      integer(c_int) :: ignored
      if (started) return
      started = .true.
      ! HDF5's own locks are for readers in the middle of a write; many file systems know none
      call set_environment('HDF5_USE_FILE_LOCKING', 'BEST_EFFORT')
      ! what is open is closed here; at exit HDF5 would crash over a file it could not write
      call h5dont_atexit_f(status)
      call h5open_f(status)
      ! HDF5 would print its own stack of errors
      call h5eset_auto_f(0, status)
      ! a link to another file is an error from now on
      ignored = c_unregister_links(external_links)
      ! it would look for libraries with filters that a file names
      ignored = c_allow_libraries(0_c_int)
   end subroutine start_hdf5

   subroutine ready(self)
      class(hdf5_base_type), intent(inout) :: self
      call start_hdf5()
      if (allocated(self%failure)) deallocate (self%failure)
      self%damaged = .false.
   end subroutine ready

   subroutine create(self, path)
      class(hdf5_base_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      integer(hid_t) :: access
      integer :: status
      call ready(self)
      call h5pcreate_f(h5p_file_access_f, access, status)
      ! in this version structures have checksums: damaged ones are refused before they are changed
      call h5pset_libver_bounds_f(access, h5f_libver_v110_f, h5f_libver_v110_f, status)
      if (status >= 0) call h5fcreate_f(path, h5f_acc_trunc_f, self%id, status, access_prp=access)
      call self%check(status, 'create the file')
      call h5pclose_f(access, status)
   end subroutine create

   subroutine open_file(self, path, writing)
      class(hdf5_base_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      logical, intent(in) :: writing
      integer :: status
      logical :: exists
      call ready(self)
      call h5fopen_f(path, merge(h5f_acc_rdwr_f, h5f_acc_rdonly_f, writing), self%id, status)
      ! where it could not write HDF5 looks for other files, too
      inquire (file=path, exist=exists)
      if (status < 0 .and. exists) call forget_missing()
      call self%check(status, 'open the file')
      if (status < 0) self%id = -1
      if (status < 0 .or. .not. writing) return
      ! HDF5 may crash where it changes damaged structures that have none
      if (.not. has_checksums(path)) call self%check(-1, 'find checksums in it; start the run anew')
   end subroutine open_file

   !> Whether the structures of an HDF5 file have checksums.
   logical function has_checksums(path)
      character(len=*), intent(in) :: path
      character :: version
      integer :: unit, status
      has_checksums = .false.
      open (newunit=unit, file=path, access='stream', action='read', iostat=status)
      if (status /= 0) return
      read (unit, pos=version_place, iostat=status) version
      if (status == 0) has_checksums = ichar(version) >= first_with_checksums
      close (unit)
   end function has_checksums

   subroutine close_file(self)
      class(hdf5_base_type), intent(inout) :: self
      integer :: status
      if (self%id < 0) return
      call h5fclose_f(self%id, status)
      call self%check(status, 'close the file')
      self%id = -1
   end subroutine close_file

   logical function has(self, path)
      class(hdf5_base_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      integer :: status, slash
      has = .not. allocated(self%failure)
      ! HDF5 wants to be asked for the groups first
      status = 0
      do slash = 2, len(path)
         if (has .and. path(slash:slash) == '/') call h5lexists_f(self%id, path(:slash - 1), has, status)
      end do
      if (has .and. status >= 0) call h5lexists_f(self%id, path, has, status)
      call self%check_read(status, 'look for '//path)
      has = has .and. status >= 0
   end function has

   logical function has_attribute(self, name) result(has)
      class(hdf5_base_type), intent(inout) :: self
      character(len=*), intent(in) :: name
      integer :: status
      has = .false.
      status = 0
      if (.not. allocated(self%failure)) call h5aexists_f(self%id, name, has, status)
      call self%check_read(status, 'look for '//name)
      has = has .and. status >= 0
   end function has_attribute

   subroutine delete(self, path)
      class(hdf5_base_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      integer :: status
      if (.not. self%has(path)) return
      call h5ldelete_f(self%id, path, status)
      call self%check(status, 'delete '//path)
   end subroutine delete

   recursive subroutine make_group(self, name)
      class(hdf5_base_type), intent(inout) :: self
      character(len=*), intent(in) :: name
      integer(hid_t) :: group
      integer :: status
      if (allocated(self%failure) .or. name == '') return
      if (self%has(name)) return
      call self%make_group(name(:index(name, '/', back=.true.) - 1))
      call h5gcreate_f(self%id, name, group, status)
      call self%check(status, 'create group '//name)
      call h5gclose_f(group, status)
   end subroutine make_group

   !> Root attribute, UTF-8 of variable length.
   subroutine put_text(self, name, text)
      class(hdf5_base_type), intent(inout) :: self
      character(len=*), intent(in) :: name, text
      integer :: status
      if (self%has_attribute(name)) call h5adelete_f(self%id, name, status)
      call self%write_attribute(self%id, name, text)
   end subroutine put_text

   !> Text attribute; empty, and a failure, where there is none.
   subroutine get_text(self, name, text)
      class(hdf5_base_type), intent(inout) :: self
      character(len=*), intent(in) :: name
      character(len=:), allocatable, intent(out) :: text
      type(c_ptr), target :: pointer(1)
      text = ''
      pointer(1) = c_null_ptr
      call read_value(self, name, .true., c_loc(pointer))
      if (.not. c_associated(pointer(1))) return
      text = fortran_text(pointer(1))
      call c_free(pointer(1))
   end subroutine get_text

   !> Whether a type is that of texts of any length. A damaged one may claim letters of any size, and HDF5 would take
   !> memory for them.
   logical function is_of_texts(kind) result(is)
      integer(hid_t), intent(in) :: kind
      integer(hid_t) :: letter
      integer(size_t) :: bytes
      integer :: status
      call h5tis_variable_str_f(kind, is, status)
      is = is .and. status >= 0
      if (.not. is) return
      bytes = 0
      call h5tget_super_f(kind, letter, status)
      if (status >= 0) call h5tget_size_f(letter, bytes, status)
      if (status >= 0) call h5tclose_f(letter, status)
      is = bytes == 1
   end function is_of_texts

   !> The type of texts of any length, UTF-8; to be closed.
   integer(hid_t) function kind_of_texts() result(kind)
      integer :: status
      call h5tcopy_f(h5t_string, kind, status)
      call h5tset_cset_f(kind, h5t_cset_utf8_f, status)
   end function kind_of_texts

   !> Integer root attribute; replaces one of the name.
   subroutine put_flag(self, name, value)
      class(hdf5_base_type), intent(inout) :: self
      character(len=*), intent(in) :: name
      integer, intent(in) :: value
      integer, target :: buffer
      integer :: status
      buffer = value
      if (self%has_attribute(name)) call h5adelete_f(self%id, name, status)
      call write_value(self, self%id, name, h5t_native_integer, c_loc(buffer))
   end subroutine put_flag

   !> Integer attribute; 0, and a failure, where there is none.
   subroutine get_flag(self, name, value)
      class(hdf5_base_type), intent(inout) :: self
      character(len=*), intent(in) :: name
      integer, intent(out) :: value
      integer, target :: buffer
      buffer = 0
      call read_value(self, name, .false., c_loc(buffer))
      value = buffer
   end subroutine get_flag

   !> Reads a root attribute of one value, a text or a whole number; a failure where there is none.
   subroutine read_value(self, name, is_text, buffer)
      class(hdf5_base_type), intent(inout) :: self
      character(len=*), intent(in) :: name
      logical, intent(in) :: is_text
      type(c_ptr), intent(in) :: buffer
      type(c_ptr) :: place
      integer(hid_t) :: attribute, space, kind
      integer(hsize_t) :: values
      integer :: status, ignored
      if (allocated(self%failure)) return
      call h5aopen_f(self%id, name, attribute, status)
      call self%check_read(status, 'find attribute '//name)
      if (status < 0) return
      call h5aget_space_f(attribute, space, status)
      call h5sget_simple_extent_npoints_f(space, values, status)
      call h5sclose_f(space, ignored)
      if (values /= 1) status = -1
      call self%check_read(status, 'find one value in attribute '//name)
      call h5aget_type_f(attribute, kind, status)
      if (is_text) then
         if (.not. is_of_texts(kind)) status = -1
      end if
      place = buffer
      if (status >= 0 .and. .not. allocated(self%failure)) call h5aread_f(attribute, merge(kind, h5t_native_integer, &
         & is_text), place, status)
      call self%check_read(status, 'read attribute '//name)
      call h5tclose_f(kind, ignored)
      call h5aclose_f(attribute, ignored)
   end subroutine read_value

   subroutine write_attribute(self, object, name, text)
      class(hdf5_base_type), intent(inout) :: self
      integer(hid_t), intent(in) :: object
      character(len=*), intent(in) :: name, text
      character(kind=c_char, len=:), allocatable, target :: buffer
      type(c_ptr), target :: pointer(1)
      integer(hid_t) :: kind
      integer :: status
      buffer = text//c_null_char
      pointer(1) = c_loc(buffer)
      kind = kind_of_texts()
      call write_value(self, object, name, kind, c_loc(pointer))
      call h5tclose_f(kind, status)
   end subroutine write_attribute

   !> A new attribute of one value.
   subroutine write_value(self, object, name, kind, buffer)
      class(hdf5_base_type), intent(inout) :: self
      integer(hid_t), intent(in) :: object, kind
      character(len=*), intent(in) :: name
      type(c_ptr), intent(in) :: buffer
      integer(hid_t) :: space, attribute
      integer :: status
      if (allocated(self%failure)) return
      call h5screate_f(h5s_scalar_f, space, status)
      call h5acreate_f(object, name, kind, space, attribute, status)
      call self%check(status, 'create attribute '//name)
      call h5awrite_f(attribute, kind, buffer, status)
      call self%check(status, 'write attribute '//name)
      call h5aclose_f(attribute, status)
      call h5sclose_f(space, status)
   end subroutine write_value

   !> Keeps the first failure, in writing.
   subroutine check(self, status, action)
      class(hdf5_base_type), intent(inout) :: self
      integer, intent(in) :: status
      character(len=*), intent(in) :: action
      character(len=:), allocatable :: reason
      if (status >= 0 .or. allocated(self%failure)) return
      reason = write_refusal()
      self%failure = 'HDF5 could not '//action
      if (reason /= '') self%failure = self%failure//': '//reason
   end subroutine check

   !> The same in reading: the file is not what it should be.
   subroutine check_read(self, status, action)
      class(hdf5_base_type), intent(inout) :: self
      integer, intent(in) :: status
      character(len=*), intent(in) :: action
      if (status >= 0 .or. allocated(self%failure)) return
      self%failure = 'HDF5 could not '//action
      self%damaged = .true.
   end subroutine check_read

   subroutine error_of(self, path, error)
      class(hdf5_base_type), intent(in) :: self
      character(len=*), intent(in) :: path
      type(error_type), allocatable, intent(out) :: error
      if (.not. allocated(self%failure)) return
      if (self%damaged) then
         call raise(error, system_error, path//': damaged: '//self%failure)
      else
         call raise(error, system_error, 'cannot write '//path//': '//self%failure)
      end if
   end subroutine error_of
end module hdf5_base
