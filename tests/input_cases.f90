!> Cases of namelist texts: what test programs take from the program's own reader, and what it must refuse.
module input_cases
   use kinds, only: wp
   use text, only: exact_text
   use errors, only: error_type, input_error
   use case_inputs, only: case_type
   use case_namelist, only: case_from_text
   use check, only: expect, expect_error, expect_no_error
   implicit none (type, external)
   private
   public :: case_of, listed, expect_refused

contains

   !> The case of a text, which must be accepted.
   type(case_type) function case_of(text) result(inputs)
      character(len=*), intent(in) :: text
      type(error_type), allocatable :: error
      call case_from_text(text, 'case.nml', inputs, error)
      call expect_no_error(error, 'accepted: '//text)
   end function case_of

   !> Values as they stand in a case, to the last bit.
   pure function listed(values) result(text)
      real(wp), intent(in) :: values(:)
      character(len=:), allocatable :: text
      integer :: i
      text = exact_text(values(1))
      do i = 2, size(values)
         text = text//', '//exact_text(values(i))
      end do
   end function listed

   !> The text must be refused with these words; the message names the file first.
   subroutine expect_refused(text, words)
      character(len=*), intent(in) :: text, words
      type(case_type) :: inputs
      type(error_type), allocatable :: error
      call case_from_text(text, 'case.nml', inputs, error)
      call expect_error(error, input_error, words, 'refused: '//text)
      if (allocated(error)) call expect(index(error%message, 'case.nml') == 1, 'names the file: '//error%message)
   end subroutine expect_refused
end module input_cases
