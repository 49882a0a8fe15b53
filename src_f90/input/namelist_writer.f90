!> A case as namelist text that reads back to the same bits.
module namelist_writer
   use kinds, only: wp
   use text, only: to_text, exact_text
   use case_inputs, only: case_type, is_set
   use assignments, only: token_type, value_text
   use field_visitor, only: visitor_type, field_type, logical_words
   use case_fields, only: visit_case
   implicit none (type, external)
   private
   public :: namelist_of

   !> Writes a case as namelist text.
   type, extends(visitor_type) :: case_writer
      character(len=:), allocatable :: text
   contains
      procedure :: group => write_group
      procedure :: word => write_word
      procedure :: whole => write_whole
      procedure :: numbers => write_numbers
      procedure :: per_pad => write_per_pad
      procedure :: list => write_list
      procedure, private :: line
   end type case_writer

   character(len=*), parameter :: newline = achar(10)

contains

   !> The whole case as namelist text, every number to the last bit; what is unset is left out.
   function namelist_of(inputs) result(text)
      type(case_type), intent(in) :: inputs
      character(len=:), allocatable :: text
      type(case_type) :: copy
      type(case_writer) :: writer
      copy = inputs
      writer%text = ''
      call visit_case(copy, writer)
      text = writer%text//'/'//newline
   end function namelist_of

   subroutine write_group(self, name, meaning)
      class(case_writer), intent(inout) :: self
      character(len=*), intent(in) :: name, meaning
      if (self%text /= '') self%text = self%text//'/'//newline
      self%text = self%text//'&'//name//newline
   end subroutine write_group

   subroutine line(self, name, value)
      class(case_writer), intent(inout) :: self
      character(len=*), intent(in) :: name, value
      self%text = self%text//'  '//name//' = '//value//newline
   end subroutine line

   subroutine write_word(self, value, field)
      class(case_writer), intent(inout) :: self
      character(len=:), allocatable, intent(inout) :: value
      type(field_type), intent(in) :: field
      type(token_type) :: token
      if (value == '' .and. field%choices /= '') return
      token%text = value
      ! a logical value is a word that needs no quotes
      token%quoted = field%choices /= logical_words
      call self%line(field%name, value_text(token))
   end subroutine write_word

   subroutine write_whole(self, value, field)
      class(case_writer), intent(inout) :: self
      integer, intent(inout) :: value
      type(field_type), intent(in) :: field
      call self%line(field%name, to_text(value))
   end subroutine write_whole

   subroutine write_numbers(self, values, field)
      class(case_writer), intent(inout) :: self
      real(wp), intent(inout) :: values(:)
      type(field_type), intent(in) :: field
      character(len=:), allocatable :: list
      integer :: i
      if (all(is_set(values))) then
         list = exact_text(values(1))
         do i = 2, size(values)
            list = list//', '//exact_text(values(i))
         end do
         call self%line(field%name, list)
      else
         do i = 1, size(values)
            if (is_set(values(i))) call self%line(field%name//'('//to_text(i)//')', exact_text(values(i)))
         end do
      end if
   end subroutine write_numbers

   subroutine write_per_pad(self, values, field)
      class(case_writer), intent(inout) :: self
      real(wp), allocatable, intent(inout) :: values(:)
      type(field_type), intent(in) :: field
      call self%numbers(values, field)
   end subroutine write_per_pad

   subroutine write_list(self, values, most, field)
      class(case_writer), intent(inout) :: self
      real(wp), allocatable, intent(inout) :: values(:)
      integer, intent(in) :: most
      type(field_type), intent(in) :: field
      call self%numbers(values, field)
   end subroutine write_list
end module namelist_writer
