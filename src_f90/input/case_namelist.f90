!> Case from namelist text. Each value is checked where it is read, so that the message can say where it stands.
module case_namelist
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   use text, only: to_text, lower_case, shortened, replaced, whole_number, is_utf8
   use errors, only: error_type, raise, add_context, input_error
   use case_groups, only: max_pads, unset, most_sections
   use case_inputs, only: case_type
   use case_checks, only: check_case
   use case_completion, only: leave_out, complete_case
   use variable_table, only: variable_type, variable_table_type
   use case_fields, only: list_variables, list_all_variables, put_variables
   use case_parameter, only: complete_branch, check_branch_parameter
   use assignments, only: namelist_type, assignment_type, study_group, token_type, assignment_text, is_special, &
      & read_number, kind_of, bearing_of, may_have_bearing
   use machine_structure, only: make_several, give_to_bearings
   use variable_names, only: group_names, names_in, meant_variable, meant_group, meant_word
   use namelist_text, only: parse_namelist
   use case_remarks, only: note_values_of_paper
   use other_units, only: in_other_units
   implicit none (type, external)
   private
   public :: case_from_text, case_from_namelist, fill_case

   !> Longest text in a case, bytes.
   integer, parameter :: longest_text = 1000

   !> Most values of a list that has one for each of something.
   integer, parameter :: most_each = max(max_pads, most_sections)

contains

   !> The case of a text, everything checked; a study is refused. `file` is for messages.
   subroutine case_from_text(text, file, inputs, error)
      character(len=*), intent(in) :: text, file
      type(case_type), intent(out) :: inputs
      type(error_type), allocatable, intent(out) :: error
      type(namelist_type) :: parsed
      integer :: i
      call parse_namelist(text, file, parsed, error)
      if (allocated(error)) return
      do i = 1, size(parsed%groups)
         if (parsed%groups(i)%group == study_group) call raise(error, input_error, parsed%groups(i)%origin &
            & //': a study, where one case is expected; tiltpad --check --run K prints those of a study')
      end do
      if (.not. allocated(error)) call case_from_namelist(parsed, inputs, error)
   end subroutine case_from_text

   !> The case of assignments, everything checked.
   subroutine case_from_namelist(parsed, inputs, error)
      type(namelist_type), intent(in) :: parsed
      type(case_type), intent(out) :: inputs
      type(error_type), allocatable, intent(out) :: error
      type(namelist_type) :: given
      call fill_case(parsed, inputs, error, given)
      if (allocated(error)) return
      call complete_case(inputs, error)
      if (.not. allocated(error)) call complete_branch(inputs)
      if (.not. allocated(error)) call note_values_of_paper(given%assignments, inputs)
      if (.not. allocated(error)) call check_case(inputs, error)
      if (.not. allocated(error)) call check_branch_parameter(inputs, error)
      call add_context(error, parsed%file)
   end subroutine case_from_namelist

   !> The case before `complete_case`: each value is checked by itself; what follows from other variables is left out.
   !> `given` are its assignments, in a machine those to each bearing.
   subroutine fill_case(parsed, inputs, error, given)
      type(namelist_type), intent(in) :: parsed
      type(case_type), intent(out) :: inputs
      type(error_type), allocatable, intent(out) :: error
      type(namelist_type), intent(out), optional :: given
      type(namelist_type) :: of_each
      inputs = case_type()
      call make_several(parsed, inputs, error)
      if (allocated(error)) return
      call leave_out(inputs)
      if (inputs%rotor%is_rigid()) then
         of_each = parsed
      else
         call give_to_bearings(parsed, inputs%bearings, of_each)
      end if
      call fill_variables(of_each, inputs, error)
      if (present(given)) given = of_each
   end subroutine fill_case

   !> Gives the variables of a case the values of its assignments.
   subroutine fill_variables(parsed, inputs, error)
      type(namelist_type), intent(in) :: parsed
      type(case_type), intent(inout) :: inputs
      type(error_type), allocatable, intent(out) :: error
      type(variable_table_type) :: table
      integer :: at(size(parsed%assignments)), i
      call list_variables(inputs, table)
      call find_variables(parsed, table, inputs, at, error)
      do i = 1, table%count
         if (allocated(error)) return
         if (table%variables(i)%counts /= '') call fill_variable(parsed, at == i, table%variables(i), error)
      end do
      do i = 1, table%count
         if (allocated(error)) return
         associate (v => table%variables(i))
            if (v%counts /= '') cycle
            if (v%each /= '') then
               v%most = number_of(v, table)
               v%values = spread(v%values(1), 1, v%most)
            end if
            call fill_variable(parsed, at == i, v, error)
         end associate
      end do
      if (.not. allocated(error)) call put_variables(table, inputs)
   end subroutine fill_variables

   !> How many values a variable has that has one for each of something.
   pure integer function number_of(v, table)
      type(variable_type), intent(in) :: v
      type(variable_table_type), intent(in) :: table
      integer :: k
      do k = 1, table%count
         associate (list => table%variables(k))
            if (list%counts /= v%each) cycle
            if (bearing_of(list%group) == bearing_of(v%group)) number_of = size(list%values)
         end associate
      end do
   end function number_of

   !> Gives a variable the values of its assignments.
   subroutine fill_variable(parsed, its_own, v, error)
      type(namelist_type), intent(in) :: parsed
      logical, intent(in) :: its_own(:)
      type(variable_type), intent(inout) :: v
      type(error_type), allocatable, intent(inout) :: error
      !> The elements that are given, without those that groups of all bearings give.
      logical :: taken(most_each, 2)
      integer :: k
      taken = .false.
      do k = 1, size(its_own)
         if (its_own(k) .and. .not. allocated(error)) call assign(parsed%assignments(k), v, &
            & taken(:, merge(1, 2, parsed%assignments(k)%of_all)), error)
      end do
   end subroutine fill_variable

   !> Where in the table the variable of each assignment is. Refuses a group or variable that there is not.
   subroutine find_variables(parsed, table, inputs, at, error)
      type(namelist_type), intent(in) :: parsed
      type(variable_table_type), intent(in) :: table
      type(case_type), intent(in) :: inputs
      integer, intent(out) :: at(:)
      type(error_type), allocatable, intent(out) :: error
      logical :: elastic
      integer :: i
      elastic = .not. inputs%rotor%is_rigid()
      do i = 1, size(parsed%groups)
         if (elastic .and. may_have_bearing(parsed%groups(i)%group)) cycle
         call refuse_unknown_group(parsed%groups(i), '&', table, error)
      end do
      do i = 1, size(at)
         associate (a => parsed%assignments(i))
            at(i) = table%find(a%group, a%name)
            if (at(i) > 0 .or. allocated(error)) cycle
            call refuse_other_rotor(a, elastic, error)
            call refuse_unknown_group(a, '', table, error)
            if (.not. allocated(error)) call raise(error, input_error, a%origin//': unknown variable '//a%group//'%' &
               & //a%name//meant_variable(kind_of(a%group), a%name)//'; known:'//names_in(kind_of(a%group)))
         end associate
      end do
   end subroutine find_variables

   !> Refuses a variable that a machine does not have, or that only a machine has, and says what is to be given instead.
   subroutine refuse_other_rotor(a, elastic, error)
      type(assignment_type), intent(in) :: a
      logical, intent(in) :: elastic
      type(error_type), allocatable, intent(inout) :: error
      type(variable_table_type) :: all
      character(len=:), allocatable :: instead
      call list_all_variables(case_type(), all)
      if (allocated(error) .or. all%find(kind_of(a%group), a%name) == 0) return
      instead = 'needs a shaft (&shaft) in bearings that have names (&bearing name = ...)'
      if (elastic) then
         select case (a%name)
         case ('mass')
            instead = 'has no effect beside a shaft; the rotor''s masses are in &shaft and &disc'
         case ('static_load')
            instead = 'has no effect beside a shaft; give a group &load with station and force'
         case ('unbalance', 'balance_grade', 'balance_speed_rpm')
            instead = 'has no effect beside a shaft; give a group &unbalance with station and moment'
         case default
            instead = 'is for a rigid journal in one bearing; a shaft in several starts from its equilibrium'
         end select
      end if
      call refuse_values(a, instead, error)
   end subroutine refuse_other_rotor

   !> Refuses an assignment or the start of a group that there is not; the message has `prefix` before the group's name.
   subroutine refuse_unknown_group(found, prefix, table, error)
      type(assignment_type), intent(in) :: found
      character(len=*), intent(in) :: prefix
      type(variable_table_type), intent(in) :: table
      type(error_type), allocatable, intent(inout) :: error
      integer :: i
      if (allocated(error) .or. any([(table%variables(i)%group == found%group, i=1, table%count)])) return
      call raise(error, input_error, found%origin//': unknown group '//prefix//found%group &
         & //meant_group(found%group)//'; known:'//group_names())
   end subroutine refuse_unknown_group

   !> Gives a variable the values of an assignment.
   subroutine assign(a, v, taken, error)
      type(assignment_type), intent(in) :: a
      type(variable_type), intent(inout) :: v
      !> The elements that assignments before have given.
      logical, intent(inout) :: taken(:)
      type(error_type), allocatable, intent(inout) :: error
      real(wp), allocatable :: given(:)
      character(len=:), allocatable :: word
      if (v%is_text) then
         call read_word(a, v, word, error)
         if (.not. allocated(error)) v%word = word
         return
      end if
      call read_reals(a, v, given, error)
      if (allocated(error)) return
      if (v%any_length) then
         if (a%subscript > 0) call refuse_values(a, 'takes a list; give all of it without subscript', error)
         v%values = given
         return
      end if
      call take(a, size(given), taken(:v%most), error)
      if (allocated(error)) return
      if (v%whole .and. verify(a%values(1)%text, '+-0123456789*') /= 0) then
         call refuse_values(a, 'must be a whole number, '//v%range_text(), error)
      else if (a%subscript > 0) then
         v%values(a%subscript:a%subscript + size(given) - 1) = given
      else if (size(given) == size(v%values)) then
         v%values = given
      else if (v%each == '') then
         call refuse_values(a, 'takes '//to_text(v%most)//' values', error)
      else if (size(given) == 1) then
         v%values = spread(given(1), 1, v%most)
      else
         call refuse_values(a, 'takes one value for all '//v%each//' or one each ('//to_text(v%most)//')', error)
      end if
   end subroutine assign

   !> Marks the elements that an assignment of the file sets, and refuses those that were set before. An element may be
   !> set after the whole list, unless the list has only one. An assignment of --set may set anything again.
   subroutine take(a, count, taken, error)
      type(assignment_type), intent(in) :: a
      integer, intent(in) :: count
      logical, intent(inout) :: taken(:)
      type(error_type), allocatable, intent(inout) :: error
      if (a%overrides .or. a%subscript == 0 .and. size(taken) > 1) return
      associate (elements => taken(max(1, a%subscript):max(1, a%subscript) + count - 1))
         if (any(elements)) call refuse_values(a, 'given twice', error)
         elements = .true.
      end associate
   end subroutine take

   ! The values of an assignment, checked against what its variable allows. The message names file, line, group,
   ! variable, value and what is allowed.

   !> The one text of an assignment; a word out of several is in lower case, without blanks around it. A shell has
   !> taken the quotes of --set away, so a bare word is a text there.
   subroutine read_word(a, v, word, error)
      type(assignment_type), intent(in) :: a
      type(variable_type), intent(in) :: v
      character(len=:), allocatable, intent(out) :: word
      type(error_type), allocatable, intent(out) :: error
      word = a%values(1)%text
      if (v%choices /= '') word = lower_case(trim(adjustl(word)))
      if (size(a%values) > 1 .and. v%choices == '') then
         call refuse_values(a, 'takes one text, in quotes where it has blanks or commas', error)
      else if (size(a%values) > 1 .or. a%subscript > 0) then
         call refuse_values(a, 'takes one text'//several_runs(a), error)
      else if (v%choices /= '' .and. .not. is_choice(word, v%choices)) then
         call refuse_values(a, 'must be one of '''//replaced(v%choices, ' ', ''', ''')//'''' &
            & //meant_word(word, v%choices, a%group//'%'//a%name//'='), error)
      else if (v%choices == '' .and. .not. (a%values(1)%quoted .or. a%overrides)) then
         call refuse_values(a, 'text must stand in quotes', error)
      else if (len(word) > longest_text) then
         call raise(error, input_error, a%origin//': '//a%group//'%'//a%name//': '//to_text(len(word)) &
            & //' characters; a text has at most '//to_text(longest_text))
      else if (.not. is_utf8(word)) then
         call refuse_values(a, 'must be UTF-8 text', error)
      end if
   end subroutine read_word

   !> The values of an assignment as reals, each within the range; at most as many as the variable takes up to the last
   !> element.
   subroutine read_reals(a, v, values, error)
      type(assignment_type), intent(in) :: a
      type(variable_type), intent(in) :: v
      real(wp), allocatable, intent(out) :: values(:)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: x
      integer :: i, repeat
      allocate (values(0))
      if (v%most == 1 .and. is_number_with_comma(a)) then
         call refuse_values(a, 'takes one value; a decimal has a point ('//a%values(1)%text//'.'//a%values(2)%text &
            & //'), and thousands have no comma ('//a%values(1)%text//a%values(2)%text//')', error)
         return
      end if
      do i = 1, size(a%values)
         call read_real(a, a%values(i), v, x, repeat, error)
         if (allocated(error)) return
         if (max(1, a%subscript) - 1 + size(values) + repeat > v%most) then
            if (v%most == 1 .and. size(a%values) > 1) then
               call refuse_values(a, 'takes one value'//several_runs(a), error)
            else
               call refuse_values(a, 'at most '//to_text(v%most)//' values', error)
            end if
            return
         end if
         values = [values, spread(x, 1, repeat)]
      end do
   end subroutine read_reals

   !> Whether two values are digits, the second with 0 before others or three of them: 9,000 or 0,019.
   pure logical function is_number_with_comma(a) result(is)
      type(assignment_type), intent(in) :: a
      is = size(a%values) == 2
      if (.not. is) return
      associate (first => a%values(1)%text, second => a%values(2)%text)
         is = first /= '' .and. len(second) > 1 .and. verify(first//second, '0123456789') == 0
         if (is) is = len(second) == 3 .or. second(1:1) == '0'
      end associate
   end function is_number_with_comma

   !> One value of an assignment and how often it stands there: `repeat*value`. Of what a case may leave out and what is
   !> never below 0, the value -1 says that it is not set.
   subroutine read_real(a, token, v, x, repeat, error)
      type(assignment_type), intent(in) :: a
      type(token_type), intent(in) :: token
      type(variable_type), intent(in) :: v
      real(wp), intent(out) :: x
      integer, intent(out) :: repeat
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: digits
      integer :: star
      logical :: repeat_ok, ok
      digits = lower_case(token%text)
      star = index(digits, '*')
      repeat = 1
      repeat_ok = .true.
      if (star > 0) then
         repeat = whole_number(digits(:star - 1))
         repeat_ok = repeat > 0 .and. repeat < 1000000
         digits = digits(star + 1:)
      end if
      x = 0
      if (.not. token%quoted .and. is_special(digits)) then
         call refuse_values(a, 'must be finite, '//v%allowed(), error)
         return
      end if
      call read_number(digits, x, ok)
      if (index(token%text, ':') > 0 .and. .not. token%quoted) then
         call refuse_values(a, 'must be a number, '//v%allowed()//several_runs(a), error)
      else if (.not. repeat_ok .or. token%quoted .or. .not. ok) then
         call refuse_values(a, 'must be a number, '//v%allowed(), error)
      else if (.not. ieee_is_finite(x)) then
         call refuse_values(a, 'must be finite, '//v%allowed(), error)
      else if (v%may_be_unset .and. v%low >= 0 .and. abs(x + 1) <= 0) then
         x = unset
      else if (x < v%low .or. x > v%high) then
         call refuse_values(a, 'must be '//v%allowed()//in_other_units(x, a%group//'%'//a%name, v%unit, v%low, &
            & v%high), error)
      end if
   end subroutine read_real

   !> How to write what has several values or a range, where one value is expected: a run for each of them.
   pure function several_runs(a) result(text)
      type(assignment_type), intent(in) :: a
      character(len=:), allocatable :: text
      text = '; for one run of each value: '//study_group//'%'//shortened(assignment_text(a))
   end function several_runs

   !> "case.nml line 3: rotor%mass = -1: must be ...".
   subroutine refuse_values(a, reason, error)
      type(assignment_type), intent(in) :: a
      character(len=*), intent(in) :: reason
      type(error_type), allocatable, intent(inout) :: error
      call raise(error, input_error, a%origin//': '//assignment_text(a)//': '//reason)
   end subroutine refuse_values

   !> True for one of the words that `choices` lists, separated by blanks.
   pure logical function is_choice(word, choices)
      character(len=*), intent(in) :: word, choices
      is_choice = scan(word, ' ') == 0 .and. index(' '//choices//' ', ' '//word//' ') > 0
   end function is_choice
end module case_namelist
