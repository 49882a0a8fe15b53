!> The variables of a case as text: namelist text that reads back to the same bits, and the input reference.
module namelist_writer
   use text, only: to_text, exact_text
   use case_groups, only: is_set, unset
   use case_inputs, only: case_type
   use assignments, only: token_type, value_text, group_heading
   use variable_table, only: variable_type, variable_table_type, logical_words
   use case_fields, only: list_variables, list_all_variables
   implicit none (type, external)
   private
   public :: namelist_of, lines_of, group_start, reference_text

   character(len=*), parameter :: newline = achar(10)

contains

   !> The whole case as namelist text, every number to the last bit; what is not set is left out.
   function namelist_of(inputs) result(text)
      type(case_type), intent(in) :: inputs
      character(len=:), allocatable :: text
      type(variable_table_type) :: table
      integer :: i
      call list_variables(inputs, table)
      text = ''
      do i = 1, table%count
         text = text//group_start(table, i)//lines_of(table%variables(i), '')
      end do
      text = text//'/'//newline
   end function namelist_of

   !> What stands before the first variable of a group: the end of the group before it, and its own start.
   pure function group_start(table, i) result(text)
      type(variable_table_type), intent(in) :: table
      integer, intent(in) :: i
      character(len=:), allocatable :: text
      text = ''
      if (i > 1) then
         if (table%variables(i - 1)%group == table%variables(i)%group) return
         text = '/'//newline
      end if
      text = text//group_heading(table%variables(i)%group)
   end function group_start

   !> "  name = value", or a line for each element that is set where not all are, each with a mark behind it.
   pure function lines_of(v, mark) result(text)
      type(variable_type), intent(in) :: v
      character(len=*), intent(in) :: mark
      character(len=:), allocatable :: text, list
      integer :: i
      text = ''
      if (v%is_text) then
         if (v%word /= '' .or. v%choices == '') call add(v%name, word_text(v))
      else if (all(is_set(v%values))) then
         list = exact(v, 1)
         do i = 2, size(v%values)
            list = list//', '//exact(v, i)
         end do
         call add(v%name, list)
      else
         do i = 1, size(v%values)
            if (is_set(v%values(i))) call add(v%name//'('//to_text(i)//')', exact(v, i))
         end do
      end if
   contains
      pure subroutine add(name, value)
         character(len=*), intent(in) :: name, value
         !> Column of the marks.
         integer, parameter :: column = 46
         text = text//'  '//name//' = '//value
         if (mark /= '') text = text//repeat(' ', max(2, column - len('  '//name//' = '//value)))//mark
         text = text//newline
      end subroutine add
   end function lines_of

   !> The word of a text, in quotes, which a logical value does not need.
   pure function word_text(v) result(text)
      type(variable_type), intent(in) :: v
      character(len=:), allocatable :: text
      type(token_type) :: token
      token%text = v%word
      token%quoted = v%choices /= logical_words
      text = value_text(token)
   end function word_text

   !> The i-th number, to the last bit.
   pure function exact(v, i) result(text)
      type(variable_type), intent(in) :: v
      integer, intent(in) :: i
      character(len=:), allocatable :: text
      if (v%whole) then
         text = to_text(nint(v%values(i)))
      else
         text = exact_text(v%values(i))
      end if
   end function exact

   !> The input reference, Markdown tables of all groups: variable, default, unit, allowed values, meaning.
   function reference_text() result(text)
      character(len=:), allocatable :: text
      type(case_type) :: inputs
      type(variable_table_type) :: table
      integer :: i
      inputs = case_type()
      inputs%operation%final_speed_rpm = unset
      call list_all_variables(inputs, table)
      text = ''
      do i = 1, table%count
         associate (v => table%variables(i))
            if (group_start(table, i) /= '') then
               if (i > 1) text = text//newline
               text = text//'## &'//v%group//newline//v%group_meaning//'.'//newline//newline &
                  & //'| variable | default | unit | allowed | meaning |'//newline//'|---|---|---|---|---|'//newline
            end if
            text = text//row(v)
         end associate
      end do
   end function reference_text

   !> The row of a variable.
   function row(v) result(text)
      type(variable_type), intent(in) :: v
      character(len=:), allocatable :: text, default, allowed, meaning
      integer :: i
      meaning = v%meaning
      if (v%is_text) then
         default = '`'//word_text(v)//'`'
         allowed = v%choices
         if (allowed == '') allowed = 'any text'
      else
         default = ''
         do i = 1, merge(1, size(v%values), v%each /= '')
            if (i > 1) default = default//', '
            if (.not. is_set(v%values(i))) then
               default = default//'-'
            else if (v%whole) then
               default = default//exact(v, i)
            else
               default = default//to_text(v%values(i))
            end if
         end do
         allowed = v%range_text()
         if (v%whole) allowed = 'whole, '//allowed
         if (v%any_length) meaning = meaning//'; 1 to '//to_text(v%most)//' of them'
         if (v%each /= '') meaning = meaning//'; one for all '//v%each//' or one each'
      end if
      text = '| `'//v%name//'` | '//default//' | '//v%unit//' | '//allowed//' | '//meaning//' |'//newline
   end function row
end module namelist_writer
