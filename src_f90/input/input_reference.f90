!> The input reference, written from the list of input variables itself.
module input_reference
   use kinds, only: wp
   use text, only: to_text
   use scene, only: scene_type, max_pads
   use scene_fields, only: field_visitor, range_type, visit_scene
   implicit none (type, external)
   private
   public :: reference_text

   !> Writes one table row a variable.
   type, extends(field_visitor) :: reference_writer
      character(len=:), allocatable :: text
   contains
      procedure :: group => write_group
      procedure :: word => write_word
      procedure :: whole => write_whole
      procedure :: numbers => write_numbers
      procedure :: per_pad => write_per_pad
      procedure, private :: row
   end type reference_writer

   character(len=*), parameter :: newline = achar(10)

contains

   !> Markdown tables of all groups: variable, default, unit, allowed values, meaning.
   function reference_text() result(text)
      character(len=:), allocatable :: text
      type(scene_type) :: scene
      type(reference_writer) :: writer
      scene = scene_type()
      scene%operation%final_speed_rpm = -1
      writer%text = ''
      call visit_scene(scene, writer)
      text = writer%text
   end function reference_text

   subroutine write_group(self, name, meaning)
      class(reference_writer), intent(inout) :: self
      character(len=*), intent(in) :: name, meaning
      if (self%text /= '') self%text = self%text//newline
      self%text = self%text//'## &'//name//newline//meaning//'.'//newline//newline &
         & //'| variable | default | unit | allowed | meaning |'//newline//'|---|---|---|---|---|'//newline
   end subroutine write_group

   subroutine row(self, name, default, unit, allowed, meaning)
      class(reference_writer), intent(inout) :: self
      character(len=*), intent(in) :: name, default, unit, allowed, meaning
      self%text = self%text//'| `'//name//'` | '//default//' | '//unit//' | '//allowed//' | '//meaning//' |'//newline
   end subroutine row

   subroutine write_word(self, name, value, choices, meaning)
      class(reference_writer), intent(inout) :: self
      character(len=*), intent(in) :: name, choices, meaning
      character(len=:), allocatable, intent(inout) :: value
      if (choices == '') then
         call self%row(name, '`'''//value//'''`', '', 'any text', meaning)
      else
         call self%row(name, '`'''//value//'''`', '', choices, meaning)
      end if
   end subroutine write_word

   subroutine write_whole(self, name, value, allowed, meaning)
      class(reference_writer), intent(inout) :: self
      character(len=*), intent(in) :: name, meaning
      integer, intent(inout) :: value
      type(range_type), intent(in) :: allowed
      call self%row(name, to_text(value), '1', 'whole, '//allowed%text(), meaning)
   end subroutine write_whole

   subroutine write_numbers(self, name, values, allowed, unit, meaning)
      class(reference_writer), intent(inout) :: self
      character(len=*), intent(in) :: name, unit, meaning
      real(wp), intent(inout) :: values(:)
      type(range_type), intent(in) :: allowed
      character(len=:), allocatable :: list
      integer :: i
      list = to_text(values(1))
      do i = 2, size(values)
         list = list//', '//to_text(values(i))
      end do
      call self%row(name, list, unit, allowed%text(), meaning)
   end subroutine write_numbers

   subroutine write_per_pad(self, name, values, fixes_pads, allowed, unit, meaning)
      class(reference_writer), intent(inout) :: self
      character(len=*), intent(in) :: name, unit, meaning
      real(wp), allocatable, intent(inout) :: values(:)
      logical, intent(in) :: fixes_pads
      type(range_type), intent(in) :: allowed
      if (fixes_pads) then
         call self%numbers(name, values, allowed, unit, meaning//'; 1 to '//to_text(max_pads)//' of them')
      else
         call self%numbers(name, values(1:1), allowed, unit, meaning)
      end if
   end subroutine write_per_pad
end module input_reference
