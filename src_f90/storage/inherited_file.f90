!> An HDF5 file that is open while child processes are started, which inherit it.
module inherited_file
   use, intrinsic :: iso_c_binding, only: c_f_pointer, c_int, c_int64_t, c_ptr
   use hdf5, only: h5p_default_f
   use files, only: unlock_file, empty_file
   use hdf5_file, only: hdf5_type
   implicit none (type, external)
   private
   public :: unlock, empty

   interface
      !> The system's number of an open file.
      integer(c_int) function file_handle(file, access, handle) bind(c, name='H5Fget_vfd_handle')
         import :: c_int, c_int64_t, c_ptr
         integer(c_int64_t), value :: file, access
         type(c_ptr), intent(out) :: handle
      end function file_handle
   end interface

contains

   !> Frees HDF5's own lock of an open file: children would keep it, and readers from the file once it is published.
   subroutine unlock(file)
      type(hdf5_type), intent(inout) :: file
      integer(c_int), pointer :: number
      call find_number(file, number)
      if (associated(number)) call unlock_file(number)
   end subroutine unlock

   !> In a child, before it closes the file: what HDF5 then writes is lost, and the child does not keep the file's room
   !> on the disk after it was deleted.
   subroutine empty(file)
      type(hdf5_type), intent(inout) :: file
      integer(c_int), pointer :: number
      call find_number(file, number)
      if (associated(number)) call empty_file(number)
   end subroutine empty

   !> The system's number of an open file; not associated where none is open.
   subroutine find_number(file, number)
      type(hdf5_type), intent(inout) :: file
      integer(c_int), pointer, intent(out) :: number
      type(c_ptr) :: handle
      integer :: status
      nullify (number)
      if (file%id < 0) return
      status = file_handle(int(file%id, c_int64_t), int(h5p_default_f, c_int64_t), handle)
      call file%check(status, 'find the number of the file')
      if (status >= 0) call c_f_pointer(handle, number)
   end subroutine find_number
end module inherited_file
