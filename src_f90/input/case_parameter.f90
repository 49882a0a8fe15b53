!> A number of the input by its name, 'group%name' or 'group%name(element)': what it may be, its value in a case, and
!> cases with other values of it. What a branch runs over.
module case_parameter
   use kinds, only: wp
   use text, only: lower_case, filled
   use errors, only: error_type, raise, require, refuse, input_error
   use case_groups, only: is_set, in_range
   use case_inputs, only: case_type
   use case_checks, only: check_case
   use variable_table, only: variable_table_type
   use case_fields, only: list_variables, put_variables
   use variable_names, only: meant_variable
   use assignments, only: split_subscript, kind_of
   implicit none (type, external)
   private
   public :: case_parameter_type, find_parameter, complete_branch, check_branch_parameter

   !> The groups whose numbers describe the bearing; and the one number of operation that does.
   character(len=*), parameter :: groups = ' rotor operation bearing oil pads pivot friction asperity shaft disc ' &
      & //'unbalance load support '
   character(len=*), parameter :: speed = 'speed_rpm'
   !> First steps from one end of a branch to the other where the step is left out.
   integer, parameter :: first_steps = 20

   type :: case_parameter_type
      !> Group, name, and element; 0: all elements have the value.
      character(len=:), allocatable, private :: group, variable
      integer, private :: element = 0
      !> Unit, and what it is, for the file.
      character(len=:), allocatable :: unit, meaning
      !> Allowed values.
      real(wp) :: low = 0, high = 0
   contains
      procedure :: value
      procedure :: set
   end type case_parameter_type

contains

   !> The number of this name in a case; an error says why there is none.
   subroutine find_parameter(inputs, name, parameter, error)
      type(case_type), intent(in) :: inputs
      character(len=*), intent(in) :: name
      type(case_parameter_type), intent(out) :: parameter
      type(error_type), allocatable, intent(out) :: error
      type(variable_table_type) :: table
      integer :: at
      logical :: ok
      call split(lower_case(name), parameter, ok)
      if (.not. ok) then
         call raise(error, input_error, 'must be group%name or group%name(element)')
         return
      end if
      call list_variables(inputs, table)
      at = table%find(parameter%group, parameter%variable)
      if (at == 0) then
         call raise(error, input_error, 'there is no such variable' &
            & //meant_variable(kind_of(parameter%group), parameter%variable))
         return
      end if
      associate (v => table%variables(at))
         parameter%unit = v%unit
         parameter%meaning = v%meaning
         parameter%low = v%low
         parameter%high = v%high
         call require(.not. (v%is_text .or. v%whole), 'must be a real number, no text and no whole number', error)
         call require(index(groups, ' '//kind_of(parameter%group)//' ') > 0 .and. (parameter%group /= 'operation' &
            & .or. parameter%variable == speed), 'must be operation%'//speed//' or a number of rotor, bearing, oil, ' &
            & //'pads, pivot, friction, asperity, shaft, disc, unbalance, load or support', error)
         if (allocated(error)) return
         associate (n => size(v%values))
            call require(parameter%element <= n, 'has {} element'//trim(merge('s', ' ', n /= 1)), [real(n, wp)], error)
            call require(parameter%element > 0 .or. n <= 1 .or. v%each /= '', 'needs the number of an element, ' &
               & //parameter%group//'%'//parameter%variable//'(1) to ({})', [real(n, wp)], error)
            if (allocated(error)) return
            call require(is_set(v%values(max(1, parameter%element))), 'has no value of its own here (tiltpad --check ' &
               & //'prints those that have)', error)
         end associate
      end associate
   end subroutine find_parameter

   !> Parts of "group%name(element)". `ok` is false where it is none.
   subroutine split(name, parameter, ok)
      character(len=*), intent(in) :: name
      type(case_parameter_type), intent(inout) :: parameter
      logical, intent(out) :: ok
      integer :: percent
      percent = index(name, '%')
      parameter%group = name(:percent - 1)
      call split_subscript(name(percent + 1:), parameter%variable, parameter%element, ok)
      ok = ok .and. parameter%group /= '' .and. parameter%variable /= ''
   end subroutine split

   !> Its value in a case; where several elements change together, that of the first.
   real(wp) function value(self, inputs)
      class(case_parameter_type), intent(in) :: self
      type(case_type), intent(in) :: inputs
      type(variable_table_type) :: table
      call list_variables(inputs, table)
      associate (v => table%variables(table%find(self%group, self%variable)))
         value = v%values(max(1, self%element))
      end associate
   end function value

   !> Gives it another value in a case. An error says why the case cannot be; it is changed all the same.
   subroutine set(self, value, inputs, error)
      class(case_parameter_type), intent(in) :: self
      real(wp), intent(in) :: value
      type(case_type), intent(inout) :: inputs
      type(error_type), allocatable, intent(out) :: error
      type(variable_table_type) :: table
      call list_variables(inputs, table)
      associate (v => table%variables(table%find(self%group, self%variable)))
         if (self%element > 0) then
            v%values(self%element) = value
         else
            v%values = spread(value, 1, size(v%values))
         end if
      end associate
      call put_variables(table, inputs)
      ! a run-up has no orbit
      inputs%operation%final_speed_rpm = inputs%operation%speed_rpm
      if (value < self%low .or. value > self%high) then
         call refuse(filled(self%group//'%'//self%variable//' = {}: must be {} to {}', [value, self%low, self%high]), &
            & error)
      else
         call check_case(inputs, error)
      end if
   end subroutine set

   !> Where the end of a branch is left out, twice its first value; where its step is, a part of the way.
   subroutine complete_branch(inputs)
      type(case_type), intent(inout) :: inputs
      type(case_parameter_type) :: parameter
      type(error_type), allocatable :: error
      real(wp) :: first
      if (inputs%about%task /= 'branch') return
      associate (b => inputs%branch)
         if (is_set(b%last) .and. is_set(b%step)) return
         call find_parameter(inputs, b%parameter, parameter, error)
         if (allocated(error)) return
         first = parameter%value(inputs)
         ! from 0 there is no telling where to
         if (.not. is_set(b%last) .and. abs(first) > 0) b%last = min(max(2*first, parameter%low), parameter%high)
         if (is_set(b%last) .and. .not. is_set(b%step)) b%step = (b%last - first)/first_steps
      end associate
   end subroutine complete_branch

   !> Refuses a branch over what is no number of the input, to where it may not go, or that starts the wrong way.
   subroutine check_branch_parameter(inputs, error)
      type(case_type), intent(in) :: inputs
      type(error_type), allocatable, intent(out) :: error
      type(case_parameter_type) :: parameter
      real(wp) :: first
      if (inputs%about%task /= 'branch') return
      associate (b => inputs%branch)
         call find_parameter(inputs, b%parameter, parameter, error)
         if (allocated(error)) then
            error%message = 'branch%parameter = '''//b%parameter//''': '//error%message
            return
         end if
         first = parameter%value(inputs)
         call require(b%of /= 'equilibrium' .or. .not. (any(kind_of(parameter%group) == [character(len=9) :: &
            & 'friction', 'unbalance']) .or. parameter%variable == 'unbalance' .or. index(parameter%variable, &
            & 'balance_') == 1), 'branch%parameter = '''//b%parameter//''': has no effect on equilibria, which are ' &
            & //'without friction and unbalance', error)
         call require(is_set(b%last), 'branch%last: must be given, as twice '//b%parameter//' = {} is no other value', &
            & [first], error)
         if (allocated(error)) return
         call require(in_range(b%last, [parameter%low, parameter%high]), 'branch%last = {}: must be {} ' &
            & //'to {}, as '//b%parameter, [b%last, parameter%low, parameter%high], error)
         call require(abs(b%last - first) > 0, 'branch%last = {}: is the value of '//b%parameter//' already, where ' &
            & //'the branch starts', [b%last], error)
         call require(b%step*(b%last - first) > 0, 'branch%step = {}: must be '//merge('> 0', '< 0', b%last > first) &
            & //', from '//b%parameter//' = {} towards branch%last = {}', [b%step, first, b%last], error)
         call require(abs(b%step) <= abs(b%last - first), 'branch%step = {}: must be smaller than the way from ' &
            & //b%parameter//' = {} to branch%last = {}', [b%step, first, b%last], error)
      end associate
   end subroutine check_branch_parameter
end module case_parameter
