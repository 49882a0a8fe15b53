!> Variables of the input by their names: what a wrong name may stand for; and a number, 'group%name' or
!> 'group%name(element)': what it may be, its value in a case, and cases with other values of it, which a branch runs
!> over.
module case_parameter
   use kinds, only: wp
   use text, only: lower_case, filled, find_similar, did_you_mean
   use errors, only: error_type, require, refuse, add_context
   use case_groups, only: is_set, in_range, unset
   use case_inputs, only: case_type
   use case_checks, only: check_case
   use variable_table, only: variable_type, variable_table_type
   use case_fields, only: list_variables, list_all_variables, change_number
   use assignments, only: split_subscript, kind_of
   implicit none (type, external)
   private
   public :: group_names, names_in, meant_variable, meant_group, meant_word
   public :: case_parameter_type, find_parameter, complete_branch, check_branch_parameter

   !> The groups whose numbers describe the bearing; and the one number of operation that does.
   character(len=*), parameter :: groups = ' rotor operation bearing oil pads pivot friction asperity shaft disc ' &
      & //'unbalance load element support damper '
   character(len=*), parameter :: speed = 'speed_rpm'
   !> First steps from one end of a branch to the other where the step is left out.
   integer, parameter :: first_steps = 20

   !> Names that have changed, each with today's, in pairs: 'group%name', 'group%name=word' or '--option'.
   character(len=*), parameter :: former_names(2, 6) = reshape([character(len=27) :: &
      & 'pivot%penetration_factor', 'pivot%deflection_factor', &
      & 'oil%wall_exchange', 'oil%shaft_nusselt', &
      & 'start%pad_penetration', 'start%pivot_deflection', &
      & 'start%pad_penetration_rate', 'start%pivot_deflection_rate', &
      & 'film%solver=modal', 'fourier', &
      & '--member', '--run'], [2, 6])

   !> Names as data sheets and other programs have them, each with what is meant, in pairs.
   character(len=*), parameter :: common_names(2, 30) = reshape([character(len=47) :: &
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
      & 'offset', 'pads%pivot_ratio', &
      & 'pad_offset', 'pads%pivot_ratio', &
      & 'offset_factor', 'pads%pivot_ratio', &
      & 'pad_arc_length', 'pads%arc_deg', &
      & 'span', 'pads%arc_deg', &
      & 'bore', 'bearing%journal_radius and the clearances', &
      & 'n_pads', 'pads%pivot_angle_deg, one for each pad', &
      & 'inlet_temperature', 'oil%supply_temperature', &
      & 'vg', 'oil%grade', &
      & 'iso_vg', 'oil%grade', &
      & 'viscosity_grade', 'oil%grade', &
      & 'pivot_stiffness', 'pivot%stiffness', &
      & 'stiffness', 'pivot%stiffness', &
      & 'number', 'pads%pivot_angle_deg, one for each pad', &
      & 'number_of_pads', 'pads%pivot_angle_deg, one for each pad', &
      & 'clearance_ratio', 'bearing%assembled_clearance', &
      & 'weight', 'rotor%mass in kg', &
      & 'elastic_modulus', 'young_modulus', &
      & 'load', 'rotor%static_load along y and z, or rotor%mass'], [2, 30])

   type, extends(variable_type) :: case_parameter_type
      !> 0: all elements have the value.
      integer, private :: element = 0
   contains
      procedure :: value
      procedure :: set
   end type case_parameter_type

contains

   !> The groups, each with a blank before it.
   function group_names() result(names)
      character(len=:), allocatable :: names
      type(variable_table_type) :: table
      integer :: i
      call list_all_variables(case_type(), table)
      names = ''
      do i = 1, table%count
         if (index(names//' ', ' '//table%variables(i)%group//' ') == 0) names = names//' '//table%variables(i)%group
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
      k = findloc(common_names(1, :) == name, .true., dim=1)
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
      k = findloc(former_names(1, :) == former, .true., dim=1)
      text = ''
      if (k > 0) text = ' (is called '//trim(former_names(2, k))//' now)'
   end function new_name

   ! A number by its name.

   !> The number of this name in a case; an error says why there is none.
   subroutine find_parameter(inputs, name, parameter, error)
      type(case_type), intent(in) :: inputs
      character(len=*), intent(in) :: name
      type(case_parameter_type), intent(out) :: parameter
      type(error_type), allocatable, intent(out) :: error
      type(variable_table_type) :: table
      integer :: at
      logical :: ok
      at = index(name, '%')
      parameter%group = lower_case(name(:at - 1))
      call split_subscript(lower_case(name(at + 1:)), parameter%name, parameter%element, ok)
      call require(ok .and. parameter%group /= '' .and. parameter%name /= '', 'must be group%name or ' &
         & //'group%name(element)', error)
      if (allocated(error)) return
      call list_variables(inputs, table, documented=.true.)
      at = table%find(parameter%group, parameter%name)
      if (at == 0) call refuse('there is no such variable'//meant_variable(kind_of(parameter%group), &
         & parameter%name), error)
      if (allocated(error)) return
      parameter%variable_type = table%variables(at)
      call require(.not. (parameter%is_text .or. parameter%whole), 'must be a real number, no text and no whole ' &
         & //'number', error)
      call require(index(groups, ' '//kind_of(parameter%group)//' ') > 0 .and. (parameter%group /= 'operation' &
         & .or. parameter%name == speed), 'must be operation%'//speed//' or a number of rotor, bearing, oil, ' &
         & //'pads, pivot, friction, asperity, shaft, disc, unbalance, load, element, support or damper', error)
      if (allocated(error)) return
      associate (n => size(parameter%values))
         call require(parameter%element <= n, 'has {} element'//trim(merge('s', ' ', n /= 1)), [real(n, wp)], error)
         call require(parameter%element > 0 .or. n <= 1 .or. parameter%each /= '', 'needs the number of an element, ' &
            & //parameter%group//'%'//parameter%name//'(1) to ({})', [real(n, wp)], error)
         if (allocated(error)) return
         call require(is_set(parameter%values(max(1, parameter%element))), 'has no value of its own here (tiltpad ' &
            & //'--check prints those that have)', error)
      end associate
   end subroutine find_parameter

   !> Its value in a case; where several elements change together, that of the first.
   real(wp) function value(self, inputs)
      class(case_parameter_type), intent(in) :: self
      type(case_type), intent(in) :: inputs
      type(variable_table_type) :: table
      type(case_type) :: copy
      copy = inputs
      call table%seek(self%group, self%name, self%element)
      call change_number(table, copy)
      value = table%value
   end function value

   !> Gives it another value in a case. An error says why the case cannot be; it is changed all the same.
   subroutine set(self, value, inputs, error)
      class(case_parameter_type), intent(in) :: self
      real(wp), intent(in) :: value
      type(case_type), intent(inout) :: inputs
      type(error_type), allocatable, intent(out) :: error
      type(variable_table_type) :: table
      call table%seek(self%group, self%name, self%element, value)
      call change_number(table, inputs)
      ! a run-up has no orbit
      inputs%operation%final_speed_rpm = inputs%operation%speed_rpm
      if (value < self%low .or. value > self%high) then
         call refuse(filled(self%group//'%'//self%name//' = {}: must be {} to {}', [value, self%low, self%high]), &
            & error)
      else
         call check_case(inputs, error)
      end if
   end subroutine set

   !> Where the end of a branch is left out, twice its first value; where its step is, a part of the way.
   subroutine complete_branch(inputs)
      type(case_type), intent(inout) :: inputs
      real(wp) :: first
      if (inputs%about%task /= 'branch') return
      associate (b => inputs%branch)
         if (b%of == 'curve' .and. b%second_parameter /= '') call complete(b%second_parameter, b%second_last)
         call complete(b%parameter, b%last)
         if (is_set(first) .and. is_set(b%last) .and. .not. is_set(b%step)) b%step = (b%last - first)/first_steps
      end associate
   contains
      subroutine complete(name, last)
         character(len=*), intent(in) :: name
         real(wp), intent(inout) :: last
         type(case_parameter_type) :: parameter
         type(error_type), allocatable :: error
         first = unset
         call find_parameter(inputs, name, parameter, error)
         if (allocated(error)) return
         first = parameter%value(inputs)
         ! from 0 there is no telling where to
         if (.not. is_set(last) .and. abs(first) > 0) last = min(max(2*first, parameter%low), parameter%high)
      end subroutine complete
   end subroutine complete_branch

   !> Refuses a branch over what is no number of the input, to where it may not go, or that starts the wrong way.
   subroutine check_branch_parameter(inputs, error)
      type(case_type), intent(in) :: inputs
      type(error_type), allocatable, intent(out) :: error
      type(case_parameter_type) :: parameter, second
      real(wp) :: first
      if (inputs%about%task /= 'branch') return
      associate (b => inputs%branch)
         if (b%of == 'curve') call check(b%second_parameter, 'branch%second_', b%second_last, second)
         if (.not. allocated(error)) call check(b%parameter, 'branch%', b%last, parameter)
         if (allocated(error)) return
         call require(b%of /= 'curve' .or. .not. (parameter%group == second%group .and. parameter%name == second%name &
            & .and. (parameter%element == second%element .or. min(parameter%element, second%element) == 0)), &
            & 'branch%second_parameter = '''//b%second_parameter//''': is branch%parameter already; a curve is ' &
            & //'over two different numbers', error)
         call require(b%step*(b%last - first) > 0, 'branch%step = {}: must be '//merge('> 0', '< 0', b%last > first) &
            & //', from '//b%parameter//' = {} towards branch%last = {}', [b%step, first, b%last], error)
         call require(abs(b%step) <= abs(b%last - first), 'branch%step = {}: must be smaller than the way from ' &
            & //b%parameter//' = {} to branch%last = {}', [b%step, first, b%last], error)
      end associate
   contains

      !> One parameter and its last value.
      subroutine check(name, which, last, parameter)
         character(len=*), intent(in) :: name, which
         real(wp), intent(in) :: last
         type(case_parameter_type), intent(out) :: parameter
         !> Whether the parameter is an unbalance.
         logical :: drives
         call find_parameter(inputs, name, parameter, error)
         call add_context(error, which//'parameter = '''//name//'''')
         if (allocated(error)) return
         first = parameter%value(inputs)
         drives = kind_of(parameter%group) == 'unbalance' .or. parameter%name == 'unbalance' &
            & .or. index(parameter%name, 'balance_') == 1
         call require(inputs%followed() /= 'equilibrium' .or. .not. (drives .or. kind_of(parameter%group) &
            & == 'friction' .and. inputs%branch%point /= 'hopf'), which//'parameter = '''//name//''': has no effect ' &
            & //'on equilibria, which are without friction and unbalance', error)
         call require(inputs%followed() /= 'limit_cycle' .or. .not. drives, which//'parameter = '''//name//''': ' &
            & //'limit cycles are without unbalance; branch%of = ''periodic'' follows orbits over it', error)
         call require(is_set(last), which//'last: must be given, as twice '//name//' = {} is no other value', &
            & [first], error)
         if (allocated(error)) return
         call require(in_range(last, [parameter%low, parameter%high]), which//'last = {}: must be {} to {}, as ' &
            & //name, [last, parameter%low, parameter%high], error)
         call require(abs(last - first) > 0, which//'last = {}: is the value of '//name//' already, where the ' &
            & //trim(merge('curve ', 'branch', inputs%branch%of == 'curve'))//' starts', [last], error)
      end subroutine check
   end subroutine check_branch_parameter
end module case_parameter
