!> Texts that C gives.
module c_strings
   use, intrinsic :: iso_c_binding, only: c_char, c_f_pointer, c_ptr, c_size_t
   implicit none (type, external)
   private
   public :: fortran_text

   interface
      integer(c_size_t) function c_strlen(text) bind(c, name='strlen')
         import :: c_ptr, c_size_t
         type(c_ptr), value :: text
      end function c_strlen
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
end module c_strings
