!> What the system says of its last refusal.
module system_errors
   use, intrinsic :: iso_c_binding, only: c_f_pointer, c_int, c_ptr
   use c_strings, only: fortran_text
   use text, only: lower_case
   implicit none (type, external)
   private
   public :: system_reason, write_refusal, error_number, refused_by_other

   !> Linux' numbers of the errors that tell why a file cannot be written, or a lock not be had.
   integer, parameter :: no_entry = 2, io_error = 5, try_again = 11, no_access = 13, too_big = 27, disk_full = 28, &
      & read_only = 30, over_quota = 122

   interface
      type(c_ptr) function c_errno_location() bind(c, name='__errno_location')
         import :: c_ptr
      end function c_errno_location

      type(c_ptr) function c_strerror(number) bind(c, name='strerror')
         import :: c_int, c_ptr
         integer(c_int), value :: number
      end function c_strerror
   end interface

contains

   !> The system's words for what went wrong last.
   function system_reason() result(reason)
      character(len=:), allocatable :: reason
      reason = lower_case(fortran_text(c_strerror(int(error_number(), c_int))))
   end function system_reason

   !> The same where it is a reason for which files cannot be written; else empty.
   function write_refusal() result(reason)
      character(len=:), allocatable :: reason
      reason = ''
      select case (error_number())
      case (no_entry, io_error, no_access, too_big, disk_full, read_only, over_quota)
         reason = system_reason()
      case default
      end select
   end function write_refusal

   !> Whether the lock just refused is held by another process (otherwise locks are not known here).
   logical function refused_by_other()
      refused_by_other = any(error_number() == [try_again, no_access])
   end function refused_by_other

   !> C's errno.
   integer function error_number()
      integer(c_int), pointer :: number
      call c_f_pointer(c_errno_location(), number)
      error_number = number
   end function error_number
end module system_errors
