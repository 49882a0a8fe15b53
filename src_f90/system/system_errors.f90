!> What the system says of its last refusal.
module system_errors
   use, intrinsic :: iso_c_binding, only: c_int, c_ptr
   use c_strings, only: fortran_text
   use text, only: lower_case
   implicit none (type, external)
   private
   public :: system_reason, write_refusal, forget_missing

   interface
      type(c_ptr) function c_reason() bind(c, name='tiltpad_reason')
         import :: c_ptr
      end function c_reason

      integer(c_int) function c_writing_refused() bind(c, name='tiltpad_writing_refused')
         import :: c_int
      end function c_writing_refused

      !> What went wrong last was not that something is missing.
      subroutine forget_missing() bind(c, name='tiltpad_forget_missing')
      end subroutine forget_missing
   end interface

contains

   !> The system's words for what went wrong last.
   function system_reason() result(reason)
      character(len=:), allocatable :: reason
      reason = lower_case(fortran_text(c_reason()))
   end function system_reason

   !> The same where it is a reason for which files cannot be written; else empty.
   function write_refusal() result(reason)
      character(len=:), allocatable :: reason
      reason = ''
      if (c_writing_refused() == 1) reason = system_reason()
   end function write_refusal
end module system_errors
