!> Texts that C and the system give, and the system's words for its last refusal.
module system_texts
   use, intrinsic :: iso_c_binding, only: c_bool, c_char, c_f_pointer, c_ptr, c_size_t
   use text, only: lower_case
   implicit none (type, external)
   private
   public :: fortran_text, system_reason, write_refusal, forget_missing

   interface
      integer(c_size_t) function c_strlen(text) bind(c, name='strlen')
         import :: c_ptr, c_size_t
         type(c_ptr), value :: text
      end function c_strlen

      type(c_ptr) function c_reason() bind(c, name='tiltpad_reason')
         import :: c_ptr
      end function c_reason

      logical(c_bool) function writing_refused() bind(c, name='tiltpad_writing_refused')
         import :: c_bool
      end function writing_refused

      !> What went wrong last was not that something is missing.
      subroutine forget_missing() bind(c, name='tiltpad_forget_missing')
      end subroutine forget_missing
   end interface

contains

   !> A text that ends with C's null character, which is not part of it.
   function fortran_text(string) result(text)
      type(c_ptr), intent(in) :: string
      character(len=:), allocatable :: text
      character(kind=c_char), pointer :: letters(:)
      integer :: i
      call c_f_pointer(string, letters, [c_strlen(string)])
      text = repeat(' ', size(letters))
      do i = 1, size(letters)
         text(i:i) = letters(i)
      end do
   end function fortran_text

   !> The system's words for what went wrong last.
   function system_reason() result(reason)
      character(len=:), allocatable :: reason
      reason = lower_case(fortran_text(c_reason()))
   end function system_reason

   !> The same where it is a reason for which files cannot be written; else empty.
   function write_refusal() result(reason)
      character(len=:), allocatable :: reason
      reason = ''
      if (writing_refused()) reason = system_reason()
   end function write_refusal
end module system_texts
