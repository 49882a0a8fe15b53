!> What a case of another bearing leaves to the paper's: values that no designer would leave out knowingly.
module paper_values
   use case_groups, only: is_set
   use case_inputs, only: case_type
   use variable_table, only: variable_table_type, variable_type
   use case_fields, only: list_variables
   use assignments, only: assignment_type
   use machine_names, only: kind_of, bearing_of
   use namelist_writer, only: lines_of
   implicit none (type, external)
   private
   public :: note_values_of_paper

   !> Variables that make a bearing another one, and those that are then to be given.
   character(len=*), parameter :: own_size = ' bearing%journal_radius bearing%axial_length '
   character(len=*), parameter :: to_be_given = ' rotor%mass rotor%unbalance operation%speed_rpm ' &
      & //'bearing%journal_radius bearing%machined_clearance bearing%assembled_clearance bearing%axial_length ' &
      & //'bearing%viscosity pads%pivot_angle_deg pads%arc_deg '

contains

   !> Notes in a complete case "rotor%mass = 2000 kg, bearing%viscosity = 0.019 Pa s" where its assignments give a
   !> bearing the size of another than the paper's and leave these out.
   subroutine note_values_of_paper(given, inputs)
      type(assignment_type), intent(in) :: given(:)
      type(case_type), intent(inout) :: inputs
      character(len=:), allocatable :: text, line
      character(len=len(own_size)) :: names(size(given))
      type(variable_table_type) :: table
      type(variable_type) :: shown
      integer :: i
      text = ''
      do i = 1, size(given)
         names(i) = kind_of(given(i)%group)//'%'//given(i)%name
      end do
      if (.not. any([(index(own_size, ' '//trim(names(i))//' ') > 0, i=1, size(given))])) return
      call list_variables(inputs, table)
      do i = 1, table%count
         associate (v => table%variables(i))
            if (index(to_be_given, ' '//kind_of(v%group)//'%'//v%name//' ') == 0) cycle
            if (has_own(v) .or. .not. matters(v)) cycle
            shown = v
            if (all(abs(v%values - v%values(1)) <= 0)) shown%values = v%values(:1)
            line = lines_of(shown, '')
            text = text//', '//v%group//'%'//line(3:len(line) - 1)
            if (v%unit /= '1') text = text//' '//v%unit
         end associate
      end do
      if (text /= '') inputs%about%of_paper = text(3:)
   contains
      !> Whether the case gives it, or what it follows from.
      logical function has_own(v)
         type(variable_type), intent(in) :: v
         integer :: k
         has_own = any([(given(k)%group == v%group .and. (given(k)%name == v%name .or. is_source(given(k)%name, &
            & v%name)), k=1, size(given))])
      end function has_own

      !> Whether a variable that is left out has an effect; of a bearing, whether the case gives it a size.
      logical function matters(v)
         type(variable_type), intent(in) :: v
         integer :: k
         matters = all(is_set(v%values))
         if (v%name == 'unbalance') matters = inputs%moves()
         if (bearing_of(v%group) == '') return
         matters = matters .and. any([(index(own_size, ' '//trim(names(k))//' ') > 0 &
            & .and. bearing_of(given(k)%group) == bearing_of(v%group), k=1, size(given))])
      end function matters
   end subroutine note_values_of_paper

   !> Whether a variable follows from this one.
   pure logical function is_source(source, name)
      character(len=*), intent(in) :: source, name
      is_source = source == 'preload' .and. name == 'machined_clearance' .or. source == 'balance_grade' &
         & .and. name == 'unbalance'
   end function is_source
end module paper_values
