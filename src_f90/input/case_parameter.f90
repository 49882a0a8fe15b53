!> A number of the input by its name, 'group%name' or 'group%name(element)': what it may be, its value in a case, and
!> cases with other values of it. What a branch runs over.
module case_parameter
   use kinds, only: wp
   use text, only: to_text, lower_case
   use errors, only: error_type, raise, input_error
   use case_inputs, only: case_type, is_set
   use case_checks, only: check_case
   use field_visitor, only: visitor_type, field_type
   use case_fields, only: visit_case
   use variable_names, only: meant_variable
   implicit none (type, external)
   private
   public :: case_parameter_type, find_parameter, check_branch_parameter

   !> The groups whose numbers describe the bearing; and the one number of operation that does.
   character(len=*), parameter :: groups = ' rotor operation bearing oil pads pivot friction asperity '
   character(len=*), parameter :: speed = 'speed_rpm'

   type :: case_parameter_type
      !> Group, name, and element; 0: all elements have the value.
      character(len=:), allocatable, private :: group, variable
      integer, private :: element = 0
      !> Unit, and what it is, for the file.
      character(len=:), allocatable :: unit, meaning
      !> Allowed values, and as text.
      real(wp) :: low = 0, high = 0
      character(len=:), allocatable :: range
   contains
      procedure :: value
      procedure :: set
   end type case_parameter_type

   !> Looks for a variable, reads its value and puts another one there.
   type, extends(visitor_type) :: seeker
      character(len=:), allocatable :: group_name, name, this_group
      integer :: element = 0
      !> Whether there is such a variable, and whether it is one of real numbers.
      logical :: exists = .false., real_number = .false.
      !> Its elements, and whether they are one for each pad.
      integer :: elements = 0
      logical :: of_pads = .false.
      real(wp) :: value = 0
      real(wp), allocatable :: new_value
      type(field_type) :: field
   contains
      procedure :: group => visit_group
      procedure :: word => visit_word
      procedure :: whole => visit_whole
      procedure :: numbers => visit_numbers
      procedure :: per_pad => visit_per_pad
      procedure :: list => visit_list
      procedure, private :: is_it
   end type seeker

contains

   !> The number of this name in a case; an error says why there is none.
   subroutine find_parameter(inputs, name, parameter, error)
      type(case_type), intent(in) :: inputs
      character(len=*), intent(in) :: name
      type(case_parameter_type), intent(out) :: parameter
      type(error_type), allocatable, intent(out) :: error
      type(case_type) :: copy
      type(seeker) :: found
      logical :: ok
      call split(lower_case(name), parameter, ok)
      if (.not. ok) then
         call raise(error, input_error, 'must be group%name or group%name(element)')
         return
      end if
      copy = inputs
      call seek(parameter, copy, found)
      if (.not. found%exists) then
         call raise(error, input_error, 'there is no such variable' &
            & //meant_variable(parameter%group, parameter%variable))
      else if (.not. found%real_number) then
         call raise(error, input_error, 'must be a real number, no text and no whole number')
      else if (index(groups, ' '//parameter%group//' ') == 0 .or. parameter%group == 'operation' &
         & .and. parameter%variable /= speed) then
         call raise(error, input_error, 'must be operation%'//speed//' or a number of rotor, bearing, oil, pads, ' &
            & //'pivot, friction or asperity')
      else if (parameter%element > found%elements) then
         call raise(error, input_error, 'has '//to_text(found%elements)//trim(merge(' element ', ' elements', &
            & found%elements == 1)))
      else if (parameter%element == 0 .and. found%elements > 1 &
         & .and. (found%field%fixes_pads .or. .not. found%of_pads)) then
         call raise(error, input_error, 'needs the number of an element, '//parameter%group//'%'//parameter%variable &
            & //'(1) to ('//to_text(found%elements)//')')
      else if (.not. is_set(found%value)) then
         call raise(error, input_error, 'has no value of its own here (tiltpad --check prints those that have)')
      end if
      parameter%unit = found%field%unit
      parameter%meaning = found%field%meaning
      parameter%low = found%field%low
      parameter%high = found%field%high
      if (.not. allocated(error)) parameter%range = found%field%range_text()
   end subroutine find_parameter

   !> Parts of "group%name(element)". `ok` is false where it is none.
   subroutine split(name, parameter, ok)
      character(len=*), intent(in) :: name
      type(case_parameter_type), intent(inout) :: parameter
      logical, intent(out) :: ok
      integer :: percent, open
      percent = index(name, '%')
      open = index(name, '(')
      if (open == 0) open = len(name) + 1
      ok = percent > 1 .and. open > percent + 1
      if (.not. ok) return
      parameter%group = name(:percent - 1)
      parameter%variable = name(percent + 1:open - 1)
      if (open > len(name)) return
      associate (digits => name(open + 1:max(open, len(name) - 1)))
         ok = len(digits) > 0 .and. len(digits) < 5 .and. verify(digits, '0123456789') == 0
         if (ok) ok = name(len(name):) == ')'
         if (ok) read (digits, *) parameter%element
         if (ok) ok = parameter%element > 0
      end associate
   end subroutine split

   !> Walks along the variables of a case to that of a parameter.
   subroutine seek(parameter, inputs, found)
      class(case_parameter_type), intent(in) :: parameter
      type(case_type), intent(inout) :: inputs
      type(seeker), intent(inout) :: found
      found%this_group = ''
      found%group_name = parameter%group
      found%name = parameter%variable
      found%element = parameter%element
      call visit_case(inputs, found)
   end subroutine seek

   !> Its value in a case; where several elements change together, that of the first.
   real(wp) function value(self, inputs)
      class(case_parameter_type), intent(in) :: self
      type(case_type), intent(in) :: inputs
      type(case_type) :: copy
      type(seeker) :: found
      copy = inputs
      call seek(self, copy, found)
      value = found%value
   end function value

   !> Gives it another value in a case. An error says why the case cannot be; it is changed all the same.
   subroutine set(self, value, inputs, error)
      class(case_parameter_type), intent(in) :: self
      real(wp), intent(in) :: value
      type(case_type), intent(inout) :: inputs
      type(error_type), allocatable, intent(out) :: error
      type(seeker) :: found
      found%new_value = value
      call seek(self, inputs, found)
      ! a run-up has no orbit
      inputs%operation%final_speed_rpm = inputs%operation%speed_rpm
      if (value < self%low .or. value > self%high) then
         call raise(error, input_error, self%group//'%'//self%variable//' = '//to_text(value)//': must be '//self%range)
      else
         call check_case(inputs, error)
      end if
   end subroutine set

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
         if (b%of == 'equilibrium' .and. (parameter%group == 'friction' .or. parameter%variable == 'unbalance' &
            & .or. index(parameter%variable, 'balance_') == 1)) then
            call raise(error, input_error, 'branch%parameter = '''//b%parameter &
               & //''': has no effect on equilibria, which are without friction and unbalance')
         else if (b%last < parameter%low .or. b%last > parameter%high) then
            call raise(error, input_error, 'branch%last = '//to_text(b%last)//': must be '//parameter%range//', as ' &
               & //b%parameter)
         else if (.not. abs(b%last - first) > 0) then
            call raise(error, input_error, 'branch%last = '//to_text(b%last)//': is the value of '//b%parameter &
               & //' already, where the branch starts')
         else if (.not. b%step*(b%last - first) > 0) then
            call raise(error, input_error, 'branch%step = '//to_text(b%step)//': must be ' &
               & //trim(merge('> 0', '< 0', b%last > first))//', from '//b%parameter//' = '//to_text(first) &
               & //' towards branch%last = '//to_text(b%last))
         else if (abs(b%step) > abs(b%last - first)) then
            call raise(error, input_error, 'branch%step = '//to_text(b%step)//': must be smaller than the way from ' &
               & //b%parameter//' = '//to_text(first)//' to branch%last = '//to_text(b%last))
         end if
      end associate
   end subroutine check_branch_parameter

   subroutine visit_group(self, name, meaning)
      class(seeker), intent(inout) :: self
      character(len=*), intent(in) :: name, meaning
      self%this_group = name
   end subroutine visit_group

   !> Whether this is the variable; then it is noted.
   logical function is_it(self, field, real_number, elements)
      class(seeker), intent(inout) :: self
      type(field_type), intent(in) :: field
      logical, intent(in) :: real_number
      integer, intent(in) :: elements
      is_it = self%this_group == self%group_name .and. field%name == self%name
      if (.not. is_it) return
      self%exists = .true.
      self%real_number = real_number
      self%elements = elements
      self%field = field
   end function is_it

   subroutine visit_word(self, value, field)
      class(seeker), intent(inout) :: self
      character(len=:), allocatable, intent(inout) :: value
      type(field_type), intent(in) :: field
      logical :: ignored
      ignored = self%is_it(field, .false., 1)
   end subroutine visit_word

   subroutine visit_whole(self, value, field)
      class(seeker), intent(inout) :: self
      integer, intent(inout) :: value
      type(field_type), intent(in) :: field
      logical :: ignored
      ignored = self%is_it(field, .false., 1)
   end subroutine visit_whole

   subroutine visit_numbers(self, values, field)
      class(seeker), intent(inout) :: self
      real(wp), intent(inout) :: values(:)
      type(field_type), intent(in) :: field
      integer :: first, last
      if (.not. self%is_it(field, .true., size(values))) return
      if (self%element > size(values)) return
      first = max(1, self%element)
      last = merge(self%element, size(values), self%element > 0)
      if (allocated(self%new_value)) values(first:last) = self%new_value
      self%value = values(first)
   end subroutine visit_numbers

   subroutine visit_per_pad(self, values, field)
      class(seeker), intent(inout) :: self
      real(wp), allocatable, intent(inout) :: values(:)
      type(field_type), intent(in) :: field
      if (self%is_it(field, .true., size(values))) self%of_pads = .true.
      call self%numbers(values, field)
   end subroutine visit_per_pad

   subroutine visit_list(self, values, most, field)
      class(seeker), intent(inout) :: self
      real(wp), allocatable, intent(inout) :: values(:)
      integer, intent(in) :: most
      type(field_type), intent(in) :: field
      call self%numbers(values, field)
   end subroutine visit_list
end module case_parameter
