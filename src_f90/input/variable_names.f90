!> The names of all input variables, and what a wrong name may stand for.
module variable_names
   use text, only: find_similar, did_you_mean
   use case_inputs, only: case_type
   use variable_table, only: variable_table_type
   use case_fields, only: list_variables, list_all_variables
   implicit none (type, external)
   private
   public :: group_names, names_in, meant_variable, meant_group, meant_word

   !> Names that have changed, each with today's, in pairs: 'group%name', 'group%name=word' or '--option'.
   character(len=*), parameter :: former_names(2, 6) = reshape([character(len=27) :: &
      & 'pivot%penetration_factor', 'pivot%deflection_factor', &
      & 'oil%wall_exchange', 'oil%shaft_nusselt', &
      & 'start%pad_penetration', 'start%pivot_deflection', &
      & 'start%pad_penetration_rate', 'start%pivot_deflection_rate', &
      & 'film%solver=modal', 'fourier', &
      & '--member', '--run'], [2, 6])

   !> Names as data sheets and other programs have them, each with what is meant, in pairs.
   character(len=*), parameter :: common_names(2, 17) = reshape([character(len=47) :: &
      & 'clearance', 'machined_clearance or assembled_clearance', &
      & 'radial_clearance', 'bearing%assembled_clearance', &
      & 'bearing_clearance', 'bearing%assembled_clearance', &
      & 'diametral_clearance', 'bearing%assembled_clearance, half of it', &
      & 'pad_clearance', 'bearing%machined_clearance', &
      & 'diameter', 'bearing%journal_radius, half of it', &
      & 'journal_diameter', 'bearing%journal_radius, half of it', &
      & 'shaft_diameter', 'bearing%journal_radius, half of it', &
      & 'width', 'bearing%axial_length', &
      & 'length', 'bearing%axial_length', &
      & 'pivot_offset', 'pads%pivot_ratio', &
      & 'number', 'pads%pivot_angle_deg, one for each pad', &
      & 'number_of_pads', 'pads%pivot_angle_deg, one for each pad', &
      & 'clearance_ratio', 'bearing%assembled_clearance', &
      & 'weight', 'rotor%mass in kg', &
      & 'elastic_modulus', 'young_modulus', &
      & 'load', 'rotor%static_load along y and z, or rotor%mass'], [2, 17])

contains

   !> The groups, each with a blank before it.
   function group_names() result(names)
      character(len=:), allocatable :: names
      type(variable_table_type) :: table
      integer :: i
      call list_all_variables(case_type(), table)
      names = ''
      do i = 1, table%count
         associate (v => table%variables(i))
            if (index(names//' ', ' '//v%group//' ') == 0) names = names//' '//v%group
         end associate
      end do
   end function group_names

   !> The variables of a group, each with a blank before it; of all groups, as group%name, where it is empty. Those of
   !> machines are left out if `rigid` is there.
   function names_in(group, rigid) result(names)
      character(len=*), intent(in) :: group
      logical, intent(in), optional :: rigid
      character(len=:), allocatable :: names
      type(variable_table_type) :: table
      integer :: i
      if (present(rigid)) then
         call list_variables(case_type(), table)
      else
         call list_all_variables(case_type(), table)
      end if
      names = ''
      do i = 1, table%count
         associate (v => table%variables(i))
            if (v%group == group) names = names//' '//v%name
            if (group == '') names = names//' '//v%group//'%'//v%name
         end associate
      end do
   end function names_in

   !> " (did you mean rotor%mass?)" for a variable that its group does not have; the group may be empty or unknown.
   !> For the former name of a variable its new one.
   function meant_variable(group, name) result(text)
      character(len=*), intent(in) :: group, name
      character(len=:), allocatable :: text, own, other
      integer :: own_score, other_score, k
      text = new_name(group//'%'//name)
      if (text /= '') return
      k = findloc(common_names(1, :), name, dim=1)
      if (k > 0) text = ' (did you mean '//trim(common_names(2, k))//'?)'
      if (k > 0) return
      call find_similar(name, names_in(group), own, own_score)
      ! a machine has many names several times
      call find_similar(name, names_in('', rigid=.true.), other, other_score)
      if (other == '') call find_similar(name, names_in(''), other, other_score)
      if (own /= '' .and. own_score <= other_score) other = own
      if (other /= '') text = ' (did you mean '//other//'?)'
   end function meant_variable

   !> " (did you mean rotor?)" for a group that does not exist.
   function meant_group(group) result(text)
      character(len=*), intent(in) :: group
      character(len=:), allocatable :: text
      text = did_you_mean(group, group_names()//' sweep')
   end function meant_group

   !> What a wrong word may stand for, an option or a value of a variable, `of`: today's name of a former one, or one of
   !> the words that it is like.
   pure function meant_word(word, words, of) result(text)
      character(len=*), intent(in) :: word, words, of
      character(len=:), allocatable :: text
      text = new_name(of//word)
      if (text == '') text = did_you_mean(word, words)
   end function meant_word

   !> " (is called pivot%deflection_factor now)" for a former name; else empty.
   pure function new_name(former) result(text)
      character(len=*), intent(in) :: former
      character(len=:), allocatable :: text
      integer :: k
      k = findloc(former_names(1, :), former, dim=1)
      text = ''
      if (k > 0) text = ' (is called '//trim(former_names(2, k))//' now)'
   end function new_name
end module variable_names
