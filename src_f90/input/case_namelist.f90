!> Case from namelist text. Each value is checked where it is read, so that the message can say where it stands.
module case_namelist
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   use text, only: newline, to_text, lower_case, shortened, replaced, whole_number, is_utf8, did_you_mean
   use errors, only: error_type, require, refuse, add_context
   use case_groups, only: bearing_type, mount_type, damper_type, max_pads, unset, most_sections, most_bearings
   use case_inputs, only: case_type
   use excitations, only: make_excitations
   use case_checks, only: check_case
   use case_completion, only: leave_out, leave_out_replaced, complete_case
   use variable_table, only: variable_type, variable_table_type
   use case_fields, only: list_variables, list_all_variables, put_variables
   use branch_checks, only: check_threshold_cycles
   use case_parameter, only: complete_branch, check_branch_parameter, group_names, names_in, meant_variable, &
      & meant_group, meant_word
   use assignments, only: namelist_type, assignment_type, study_group, token_type, assignment_text, place_of, &
      & variable_text, is_special, read_number, meant_range, undoes, counted, kind_of, bearing_of, is_counted, &
      & may_have_bearing, naming_variable
   use namelist_text, only: parse_namelist
   use case_remarks, only: note_values_of_paper
   use other_units, only: in_other_units
   implicit none (type, external)
   private
   public :: case_from_text, case_from_namelist, fill_case

   !> Longest text in a case, bytes.
   integer, parameter :: longest_text = 1000
   !> Groups that only a machine has.
   character(len=*), parameter :: of_machine = ' shaft disc unbalance load element impeller lateral support damper ' &
      & //'reduction '
   !> What they are refused without.
   character(len=*), parameter :: needs_shaft = &
      & 'needs a shaft (&shaft) in bearings that have names (&bearing name = ...)'
   !> Most values of a list that has one for each of something.
   integer, parameter :: most_each = max(max_pads, most_sections)

contains

   !> The case of a text, everything checked; a study is refused. `file` is for messages. That of a result may have what
   !> another variable replaces.
   subroutine case_from_text(text, file, inputs, error, of_result)
      character(len=*), intent(in) :: text, file
      type(case_type), intent(out) :: inputs
      type(error_type), allocatable, intent(out) :: error
      logical, intent(in), optional :: of_result
      type(namelist_type) :: parsed
      integer :: i
      call parse_namelist(text, file, parsed, error)
      do i = 1, size(parsed%groups)
         call require(parsed%groups(i)%group /= study_group, parsed%groups(i)%origin//': a study, where one case is ' &
            & //'expected; tiltpad --check --run K prints those of a study', error)
      end do
      if (.not. allocated(error)) call case_from_namelist(parsed, inputs, error, of_result)
   end subroutine case_from_text

   !> The case of assignments, everything checked.
   subroutine case_from_namelist(parsed, inputs, error, of_result)
      type(namelist_type), intent(in) :: parsed
      type(case_type), intent(out) :: inputs
      type(error_type), allocatable, intent(out) :: error
      logical, intent(in), optional :: of_result
      type(namelist_type) :: given
      call fill_case(parsed, inputs, error, given)
      if (allocated(error)) return
      if (present(of_result)) then
         if (of_result) call leave_out_replaced(inputs)
      end if
      call complete_case(inputs, error)
      if (.not. allocated(error)) call complete_branch(inputs)
      if (.not. allocated(error)) call note_values_of_paper(given%assignments, inputs)
      if (.not. allocated(error)) call check_case(inputs, error)
      if (.not. allocated(error)) call check_branch_parameter(inputs, error)
      if (.not. allocated(error)) call check_threshold_cycles(inputs, error)
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
         call give_to_bearings(parsed, inputs%mounts(), of_each)
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
      integer :: at(size(parsed%assignments)), i, k
      call list_variables(inputs, table)
      call find_variables(parsed, table, inputs, at, error)
      do i = 1, table%count
         if (allocated(error)) return
         associate (list => table%variables(i))
            if (list%counts == '' .or. .not. any(at == i)) cycle
            call fill_variable(parsed, at == i, list, error)
            do k = 1, table%count
               associate (v => table%variables(k))
                  if (v%each /= list%counts) cycle
                  if (bearing_of(v%group) /= bearing_of(list%group)) cycle
                  v%most = size(list%values)
                  if (.not. v%is_text) v%values = spread(v%values(1), 1, v%most)
               end associate
            end do
         end associate
      end do
      do i = 1, table%count
         if (allocated(error)) return
         if (table%variables(i)%counts == '' .and. any(at == i)) call fill_variable(parsed, at == i, &
            & table%variables(i), error)
      end do
      if (.not. allocated(error)) call put_variables(table, inputs)
   end subroutine fill_variables

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
      integer :: i, k
      elastic = .not. inputs%rotor%is_rigid()
      do i = 1, size(parsed%groups)
         if (elastic .and. may_have_bearing(parsed%groups(i)%group)) cycle
         call refuse_unknown_group(parsed%groups(i), '&')
      end do
      do i = 1, size(at)
         associate (a => parsed%assignments(i))
            at(i) = table%find(a%group, a%name)
            if (at(i) > 0 .or. allocated(error)) cycle
            ! what is said of all bearings holds for those that it is of
            if (allocated(a%named) .and. any([(kind_of(table%variables(k)%group) == kind_of(a%group) .and. &
               & table%variables(k)%name == a%name, k=1, table%count)])) cycle
            call refuse_other_rotor(a)
            call refuse_unknown_group(a, '')
            if (.not. allocated(error)) call refuse(a%origin//': unknown variable '//variable_text(a) &
               & //meant_variable(kind_of(a%group), a%name)//'; known:'//names_in(kind_of(a%group)), error)
         end associate
      end do
   contains
      !> Refuses a variable that a machine does not have, or that only a machine has, and says what is to be given
      !> instead.
      subroutine refuse_other_rotor(a)
         type(assignment_type), intent(in) :: a
         type(variable_table_type) :: all
         character(len=:), allocatable :: instead
         call list_all_variables(case_type(), all)
         if (all%find(kind_of(a%group), a%name) == 0) return
         instead = needs_shaft
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
            if (may_have_bearing(kind_of(a%group))) instead = 'has no effect on a bearing of this kind (bearing%kind)'
         end if
         call refuse(a%origin//': '//assignment_text(a)//': '//instead, error)
      end subroutine refuse_other_rotor

      !> Refuses an assignment or the start of a group that there is not; the message has `prefix` before the group's
      !> name.
      subroutine refuse_unknown_group(found, prefix)
         type(assignment_type), intent(in) :: found
         character(len=*), intent(in) :: prefix
         integer :: k
         if (allocated(error) .or. any([(table%variables(k)%group == found%group, k=1, table%count)])) return
         call refuse(found%origin//': unknown group '//prefix//found%group//meant_group(found%group)//'; known:' &
            & //group_names(), error)
      end subroutine refuse_unknown_group
   end subroutine find_variables

   !> Gives a variable the values of an assignment, checked against what it allows. A message names file, line, group,
   !> variable, value and what is allowed.
   subroutine assign(a, v, taken, error)
      type(assignment_type), intent(in) :: a
      type(variable_type), intent(inout) :: v
      !> The elements that assignments of the file before have given.
      logical, intent(inout) :: taken(:)
      type(error_type), allocatable, intent(inout) :: error
      real(wp), allocatable :: given(:)
      integer :: first
      if (v%is_text) then
         call read_word(all_texts())
         return
      end if
      first = max(1, a%subscript)
      call read_reals()
      if (allocated(error)) return
      if (v%any_length) then
         if (a%subscript > 0) call refuse_it('takes a list; give all of it without subscript')
         v%values = given
         return
      end if
      ! an element may be set after the whole list, unless the list has only one; --set may set anything again
      if (.not. (a%overrides .or. a%subscript == 0 .and. v%most > 1)) then
         associate (elements => taken(first:first + size(given) - 1))
            if (any(elements)) call refuse_it('given twice')
            elements = .true.
         end associate
      end if
      if (allocated(error)) return
      if (v%whole .and. verify(a%values(1)%text, '+-0123456789*') /= 0) then
         call refuse_it('must be a whole number, '//v%allowed())
      else if (a%subscript > 0 .or. size(given) == v%most) then
         v%values(first:first + size(given) - 1) = given
      else if (v%each == '') then
         call refuse_it('takes '//to_text(v%most)//' values')
      else if (size(given) == 1) then
         v%values = spread(given(1), 1, v%most)
      else
         call refuse_it('takes one value for all '//trim(v%each)//' or one each ('//to_text(v%most)//')')
      end if
   contains
      !> "case.nml line 3: rotor%mass = -1: must be ...".
      subroutine refuse_it(reason)
         character(len=*), intent(in) :: reason
         call refuse(a%origin//': '//assignment_text(a)//': '//reason, error)
      end subroutine refuse_it

      !> Its texts, a line each.
      function all_texts() result(text)
         character(len=:), allocatable :: text
         integer :: i
         text = a%values(1)%text
         do i = 2, size(a%values)
            text = text//newline//a%values(i)%text
         end do
      end function all_texts

      !> Its one text; a word out of several is in lower case, without blanks around it. A shell has taken the quotes of
      !> --set away, so a bare word is a text there.
      subroutine read_word(text)
         character(len=*), intent(in) :: text
         character(len=:), allocatable :: word
         word = text
         if (v%choices /= '') word = lower_case(trim(adjustl(text)))
         if (v%each /= '' .and. (a%subscript > 0 .or. size(a%values) /= 1 .and. size(a%values) /= v%most)) then
            call refuse_it('takes one text for all '//trim(v%each)//' or one each ('//to_text(v%most)//')')
         else if (size(a%values) > 1 .and. v%choices == '' .and. v%each == '') then
            call refuse_it('takes one text, in quotes where it has blanks or commas')
         else if (size(a%values) > 1 .and. v%each == '' .or. a%subscript > 0) then
            call refuse_it('takes one text'//several_runs())
         else if (v%choices == '' .and. .not. (all(a%values%quoted) .or. a%overrides)) then
            call refuse_it('text must stand in quotes')
         else if (v%choices /= '' .and. (scan(word, ' ') > 0 .or. index(' '//v%choices//' ', ' '//word//' ') == 0)) then
            call refuse_it('must be one of '''//replaced(v%choices, ' ', ''', ''')//'''' &
               & //meant_word(word, v%choices, a%group//'%'//a%name//'='))
         else if (len(word) > longest_text) then
            call refuse(place_of(a)//': '//to_text(len(word))//' characters; a text has at most ' &
               & //to_text(longest_text), error)
         else if (.not. is_utf8(word)) then
            call refuse_it('must be UTF-8 text')
         else
            v%word = word
         end if
      end subroutine read_word

      !> Its values as reals, each within the range; at most as many as the variable takes up to the last element.
      subroutine read_reals()
         real(wp) :: x
         integer :: i, repeat
         allocate (given(0))
         if (v%most == 1 .and. is_number_with_comma()) call refuse_it('takes one value; a decimal has a point (' &
            & //a%values(1)%text//'.'//a%values(2)%text//'), and thousands have no comma ('//a%values(1)%text &
            & //a%values(2)%text//')')
         do i = 1, size(a%values)
            if (allocated(error)) return
            call read_real(a%values(i), x, repeat)
            if (first - 1 + size(given) + repeat > v%most) then
               if (v%most == 1 .and. size(a%values) > 1) call refuse_it('takes one value'//several_runs())
               call refuse_it('at most '//to_text(v%most)//' values')
            end if
            if (.not. allocated(error)) given = [given, spread(x, 1, repeat)]
         end do
      end subroutine read_reals

      !> Whether two values are digits, the second with 0 before others or three of them: 9,000 or 0,019.
      logical function is_number_with_comma() result(is)
         is = size(a%values) == 2
         if (.not. is) return
         associate (whole => a%values(1)%text, part => a%values(2)%text)
            is = whole /= '' .and. len(part) > 1 .and. verify(whole//part, '0123456789') == 0
            if (is) is = len(part) == 3 .or. part(1:1) == '0'
         end associate
      end function is_number_with_comma

      !> One value and how often it stands there: `repeat*value`. Of what a case may leave out and what is never below
      !> 0, the value -1 says that it is not set.
      subroutine read_real(token, x, repeat)
         type(token_type), intent(in) :: token
         real(wp), intent(out) :: x
         integer, intent(out) :: repeat
         character(len=:), allocatable :: digits, range
         integer :: star
         logical :: ok
         digits = lower_case(token%text)
         star = index(digits, '*')
         repeat = 1
         if (star > 0) repeat = whole_number(digits(:star - 1))
         digits = digits(star + 1:)
         call read_number(digits, x, ok)
         if (.not. token%quoted .and. is_special(digits)) then
            call refuse_it('must be finite, '//v%allowed())
         else if (index(token%text, ':') > 0 .and. .not. token%quoted) then
            call refuse_it('must be a number, '//v%allowed()//several_runs())
         else if (repeat < 1 .or. repeat >= 1000000 .or. token%quoted .or. .not. ok) then
            range = meant_range(digits)
            if (range /= '') range = '; for one run of each value: '//study_group//'%'//a%group//'%'//a%name//' = ' &
               & //range
            call refuse_it('must be a number, '//v%allowed()//range)
         else if (.not. ieee_is_finite(x)) then
            call refuse_it('must be finite, '//v%allowed())
         else if (v%may_be_unset .and. v%low >= 0 .and. abs(x + 1) <= 0) then
            x = unset
         else if (x < v%low .or. x > v%high) then
            call refuse_it('must be '//v%allowed()//in_other_units(x, a%group//'%'//a%name, v%unit, v%low, v%high))
         end if
      end subroutine read_real

      !> How to write what has several values or a range, where one value is expected: a run for each of them.
      function several_runs() result(text)
         character(len=:), allocatable :: text
         text = '; for one run of each value: '//study_group//'%'//shortened(assignment_text(a))
      end function several_runs
   end subroutine assign

   ! Which groups a case has of those that there may be several of: excitations, and of a machine discs, bearings with
   ! their names and others. And what groups without a bearing's name say of all bearings.

   !> Gives a case its excitations and its machine, with default values, where its namelist has groups of them.
   subroutine make_several(parsed, inputs, error)
      type(namelist_type), intent(in) :: parsed
      type(case_type), intent(inout) :: inputs
      type(error_type), allocatable, intent(inout) :: error
      logical :: of_shaft(size(parsed%groups) + size(parsed%assignments))
      integer :: i
      call make_excitations(count_of(parsed, 'excitation('), inputs%excitations)
      associate (groups => parsed%groups, a => parsed%assignments)
         of_shaft = [(groups(i)%group == 'shaft', i=1, size(groups)), (a(i)%group == 'shaft' .or. a(i)%group//'%' &
            & //a(i)%name == 'rotor%file', i=1, size(a))]
         if (any(of_shaft)) then
            call make_machine(parsed, inputs, error)
         else
            do i = 1, size(groups)
               call require(.not. is_of_machine(groups(i)%group), groups(i)%origin//': &'//kind_of(groups(i)%group) &
                  & //': '//needs_shaft, error)
            end do
            do i = 1, size(a)
               call require(.not. is_of_machine(a(i)%group), place_of(a(i))//': '//needs_shaft, error)
            end do
         end if
         do i = 1, size(groups)
            call look_at(groups(i), inputs, error)
         end do
         do i = 1, size(a)
            call look_at(a(i), inputs, error)
         end do
      end associate
   end subroutine make_several

   !> Groups whose names begin so.
   pure integer function count_of(parsed, beginning)
      type(namelist_type), intent(in) :: parsed
      character(len=*), intent(in) :: beginning
      integer :: k
      count_of = count([(index(parsed%groups(k)%group, beginning) == 1, k=1, size(parsed%groups))])
   end function count_of

   pure logical function is_of_machine(group)
      character(len=*), intent(in) :: group
      is_of_machine = index(group, ':') > 0 .or. index(of_machine, ' '//kind_of(group)//' ') > 0
   end function is_of_machine

   !> Gives a case its machine.
   subroutine make_machine(parsed, inputs, error)
      type(namelist_type), intent(in) :: parsed
      type(case_type), intent(inout) :: inputs
      type(error_type), allocatable, intent(inout) :: error
      type(mount_type), allocatable :: mounts(:)
      integer :: i, b
      allocate (inputs%rotor%elastic)
      call inputs%rotor%elastic%begin(count_of(parsed, 'disc('), count_of(parsed, 'unbalance('), &
         & count_of(parsed, 'load('), count_of(parsed, 'element('), count_of(parsed, 'impeller('), &
         & count_of(parsed, 'bow('), count_of(parsed, 'lateral') > 0)
      deallocate (inputs%bearings)
      allocate (mounts(count_of(parsed, 'bearing:')))
      associate (groups => parsed%groups)
         call require(size(mounts) <= most_bearings, parsed%file//': '//to_text(size(mounts))//' groups &bearing ' &
            & //'with names; a machine has at most '//to_text(most_bearings)//' bearings', error)
         b = 0
         do i = 1, size(groups)
            if (index(groups(i)%group, 'bearing:') /= 1) cycle
            b = b + 1
            mounts(b)%name = bearing_of(groups(i)%group)
            mounts(b)%kind = kind_given(mounts(b))
            if (has('support', mounts(b))) allocate (mounts(b)%support)
            if (has('damper', mounts(b))) mounts(b)%damper = damper_type(film='pi')
         end do
      end associate
      associate (linear => [(mounts(b)%kind == 'linear', b=1, size(mounts))])
         allocate (inputs%bearings(count(.not. linear)))
         deallocate (inputs%rotor%elastic%linear)
         allocate (inputs%rotor%elastic%linear(count(linear)))
         do b = 1, size(mounts)
            if (linear(b)) then
               associate (of => inputs%rotor%elastic%linear(count(linear(:b))))
                  of%mount_type = mounts(b)
                  call of%of%begin()
               end associate
            else
               associate (of => inputs%bearings(count(.not. linear(:b))))
                  of = bearing_type()
                  of%mount_type = mounts(b)
               end associate
            end if
         end do
      end associate
   contains
      !> What the case says of the kind of a bearing: what is said of all bearings in the file comes first.
      function kind_given(bearing) result(kind)
         type(mount_type), intent(in) :: bearing
         character(len=:), allocatable :: kind
         integer :: k, pass
         kind = 'film'
         do pass = 1, 2
            do k = 1, size(parsed%assignments)
               associate (a => parsed%assignments(k))
                  if (a%name /= 'kind' .or. all(a%group /= [character(len=50) :: 'bearing', 'bearing' &
                     & //bearing%suffix()])) cycle
                  if ((a%group == 'bearing' .and. .not. a%overrides) .eqv. pass == 1) kind = lower_case(trim(adjustl( &
                     & a%values(1)%text)))
               end associate
            end do
         end do
      end function kind_given

      !> Whether a bearing has such a group; without a name it is that of all bearings.
      pure logical function has(kind, bearing)
         character(len=*), intent(in) :: kind
         type(mount_type), intent(in) :: bearing
         integer :: k
         has = any([(parsed%groups(k)%group == kind .or. parsed%groups(k)%group == kind//bearing%suffix(), k=1, &
            & size(parsed%groups))])
      end function has
   end subroutine make_machine

   !> Refuses a group or an assignment of what the case does not have.
   subroutine look_at(a, inputs, error)
      type(assignment_type), intent(in) :: a
      type(case_type), intent(in) :: inputs
      type(error_type), allocatable, intent(inout) :: error
      character(len=:), allocatable :: kind, name, names
      type(mount_type), allocatable :: bearings(:)
      integer :: b
      bearings = inputs%mounts()
      kind = kind_of(a%group)
      name = bearing_of(a%group)
      if (kind == 'excitation') call look_at_number(size(inputs%excitations))
      if (inputs%rotor%is_rigid() .or. allocated(error)) return
      call require(kind /= 'held', a%origin//': &held holds the rigid journal of one bearing, not a shaft; run ' &
         & //'each bearing alone, where &held takes the places that the machine gives its journal', error)
      associate (elastic => inputs%rotor%elastic)
         if (kind == 'disc') call look_at_number(size(elastic%discs))
         if (kind == 'unbalance') call look_at_number(size(elastic%unbalances))
         if (kind == 'bow') call look_at_number(size(elastic%bows))
         if (kind == 'load') call look_at_number(size(elastic%loads))
         if (kind == 'element') call look_at_number(size(elastic%elements))
         if (kind == 'impeller') call look_at_number(size(elastic%impellers))
         call require(kind /= 'lateral' .or. allocated(elastic%lateral), place_of(a)//': the case has no group ' &
            & //'&lateral', error)
         if (name == '' .and. size(bearings) > 0 .and. .not. any([(.not. lacks(bearings(b)), b=1, &
            & size(bearings))])) call refuse(place_of(a)//': the case has no group &'//kind, error)
         if (a%group == 'bearing' .and. a%name == 'station') call refuse(place_of(a)//': must be in a group &bearing ' &
            & //'with a name, as each bearing has a station of its own', error)
         if (a%group /= kind .and. .not. is_counted(kind) .and. (name == '' .or. .not. may_have_bearing(kind) &
            & .or. a%group /= kind//':'//name)) call refuse(a%origin//': unknown group '//a%group//'; the name of a ' &
            & //'bearing stands behind its own groups alone, as in pads:left', error)
         if (name == '' .or. allocated(error)) return
         b = findloc([(bearings(b)%name == name, b=1, size(bearings))], .true., dim=1)
         if (b == 0) then
            names = ''
            do b = 1, size(bearings)
               names = names//' '//bearings(b)%name
            end do
            if (names == '') names = ' none'
            call refuse(a%origin//': &'//kind//' '//naming_variable(kind)//' = '''//name//''': there is no group ' &
               & //'&bearing of this name'//did_you_mean(name, names)//'; there are:'//names, error)
         else if (lacks(bearings(b))) then
            call refuse(place_of(a)//': the case has no group &'//kind//' of this bearing', error)
         end if
      end associate
   contains
      !> Whether this kind is of a group that a bearing has not.
      pure logical function lacks(bearing)
         type(mount_type), intent(in) :: bearing
         lacks = kind == 'support' .and. .not. allocated(bearing%support) .or. kind == 'damper' .and. .not. &
            & allocated(bearing%damper)
      end function lacks

      !> Refuses the number of a group that there are fewer of.
      subroutine look_at_number(number)
         integer, intent(in) :: number
         character(len=:), allocatable :: allowed
         integer :: i
         if (any([(a%group == kind//counted(i), i=1, number)])) return
         allowed = kind//counted(1)//'%'//a%name
         if (number > 1) allowed = allowed//' to '//kind//counted(number)//'%'//a%name
         call require(number > 0, place_of(a)//': the case has no group &'//kind, error)
         call require(number == 0, place_of(a)//': must be '//allowed//', as the case has '//to_text(number) &
            & //' of these groups', error)
      end subroutine look_at_number
   end subroutine look_at

   !> The assignments of a machine, where those to a group of all bearings are one to each: those of the case before the
   !> bearings' own, which take their place, those of --set in the order in which they are given.
   subroutine give_to_bearings(parsed, bearings, given)
      type(namelist_type), intent(in) :: parsed
      type(mount_type), intent(in) :: bearings(:)
      type(namelist_type), intent(out) :: given
      type(assignment_type), allocatable :: longer(:)
      type(assignment_type) :: own
      logical, dimension(size(parsed%assignments)) :: defaults, general
      integer :: order(size(parsed%assignments)), i, k, b, n
      general = [(may_have_bearing(parsed%assignments(k)%group), k=1, size(general))]
      defaults = general .and. .not. parsed%assignments%overrides
      order = [pack([(k, k=1, size(general))], defaults), pack([(k, k=1, size(general))], .not. defaults)]
      given%file = parsed%file
      given%groups = parsed%groups
      allocate (longer(size(general) + count(general)*max(0, size(bearings) - 1)))
      n = 0
      do i = 1, size(order)
         k = order(i)
         do b = 1, merge(size(bearings), 1, general(k))
            own = parsed%assignments(k)
            if (general(k)) then
               own%named = own%group
               own%group = own%group//bearings(b)%suffix()
            end if
            own%of_all = defaults(k)
            if (is_undone()) cycle
            n = n + 1
            longer(n) = own
         end do
      end do
      ! one by one, as the compiler forgets to free what a constructor copies
      allocate (given%assignments(n))
      do k = 1, n
         given%assignments(k) = longer(k)
      end do
   contains
      !> Whether what follows gives all of it another value.
      pure logical function is_undone()
         integer :: j
         is_undone = general(k) .and. any([(undoes(parsed%assignments(j), own) .and. (j > k .or. defaults(k)), &
            & j=1, size(general))])
      end function is_undone
   end subroutine give_to_bearings
end module case_namelist
