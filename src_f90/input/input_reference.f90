!> The input reference, written from the list of input variables itself.
module input_reference
   use kinds, only: wp
   use text, only: to_text
   use case_inputs, only: case_type, max_pads, is_set
   use field_visitor, only: visitor_type, field_type, logical_words
   use case_fields, only: visit_case
   implicit none (type, external)
   private
   public :: reference_text

   !> Writes one table row a variable.
   type, extends(visitor_type) :: reference_writer
      character(len=:), allocatable :: text
   contains
      procedure :: group => write_group
      procedure :: word => write_word
      procedure :: whole => write_whole
      procedure :: numbers => write_numbers
      procedure :: per_pad => write_per_pad
      procedure :: list => write_list
      procedure, private :: row
   end type reference_writer

   character(len=*), parameter :: newline = achar(10)

contains

   !> Markdown tables of all groups: variable, default, unit, allowed values, meaning.
   function reference_text() result(text)
      character(len=:), allocatable :: text
      type(case_type) :: inputs
      type(reference_writer) :: writer
      inputs = case_type()
      inputs%operation%final_speed_rpm = -1
      writer%text = ''
      call visit_case(inputs, writer)
      text = writer%text
   end function reference_text

   subroutine write_group(self, name, meaning)
      class(reference_writer), intent(inout) :: self
      character(len=*), intent(in) :: name, meaning
      if (self%text /= '') self%text = self%text//newline
      self%text = self%text//'## &'//name//newline//meaning//'.'//newline//newline &
         & //'| variable | default | unit | allowed | meaning |'//newline//'|---|---|---|---|---|'//newline
   end subroutine write_group

   subroutine row(self, field, default, allowed)
      class(reference_writer), intent(inout) :: self
      type(field_type), intent(in) :: field
      character(len=*), intent(in) :: default, allowed
      self%text = self%text//'| `'//field%name//'` | '//default//' | '//field%unit//' | '//allowed//' | ' &
         & //field%meaning//' |'//newline
   end subroutine row

   subroutine write_word(self, value, field)
      class(reference_writer), intent(inout) :: self
      character(len=:), allocatable, intent(inout) :: value
      type(field_type), intent(in) :: field
      character(len=:), allocatable :: allowed
      allowed = field%choices
      if (allowed == '') allowed = 'any text'
      if (allowed == logical_words) then
         call self%row(field, '`'//value//'`', allowed)
      else
         call self%row(field, '`'''//value//'''`', allowed)
      end if
   end subroutine write_word

   subroutine write_whole(self, value, field)
      class(reference_writer), intent(inout) :: self
      integer, intent(inout) :: value
      type(field_type), intent(in) :: field
      call self%row(field, to_text(value), 'whole, '//field%range_text())
   end subroutine write_whole

   subroutine write_numbers(self, values, field)
      class(reference_writer), intent(inout) :: self
      real(wp), intent(inout) :: values(:)
      type(field_type), intent(in) :: field
      character(len=:), allocatable :: list
      integer :: i
      list = ''
      do i = 1, size(values)
         if (i > 1) list = list//', '
         if (is_set(values(i))) then
            list = list//to_text(values(i))
         else
            list = list//'-'
         end if
      end do
      call self%row(field, list, field%range_text())
   end subroutine write_numbers

   subroutine write_per_pad(self, values, field)
      class(reference_writer), intent(inout) :: self
      real(wp), allocatable, intent(inout) :: values(:)
      type(field_type), intent(in) :: field
      type(field_type) :: shown
      if (field%fixes_pads) then
         shown = field
         shown%meaning = field%meaning//'; 1 to '//to_text(max_pads)//' of them'
         call self%numbers(values, shown)
      else
         call self%numbers(values(1:1), field)
      end if
   end subroutine write_per_pad

   subroutine write_list(self, values, most, field)
      class(reference_writer), intent(inout) :: self
      real(wp), allocatable, intent(inout) :: values(:)
      integer, intent(in) :: most
      type(field_type), intent(in) :: field
      type(field_type) :: shown
      shown = field
      shown%meaning = field%meaning//'; 1 to '//to_text(most)//' of them'
      call self%numbers(values, shown)
   end subroutine write_list
end module input_reference
