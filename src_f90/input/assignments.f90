!> Assignments of namelist text, their texts in messages, and what counts as a number in them.
module assignments
   use, intrinsic :: ieee_arithmetic, only: ieee_overflow, ieee_get_halting_mode, ieee_set_flag, &
      & ieee_set_halting_mode
   use kinds, only: wp
   use text, only: to_text, exact_text, shortened, replaced, whole_number
   implicit none (type, external)
   private
   public :: namelist_type, assignment_type, token_type, put_assignment, append, undoes, assignment_text, &
      & target_text, place_of, variable_text, value_text, study_group, split_subscript, is_special, read_number, &
      & meant_range, counted, kind_of, bearing_of, is_counted, may_have_bearing, naming_variable, group_heading, &
      & identifier_of, is_name, is_spelled, longest_bearing

   !> Groups of what there may be several of on a rotor, and of each bearing.
   character(len=*), parameter :: several = ' disc unbalance bow load element impeller excitation '
   character(len=*), parameter :: of_bearings = ' bearing support damper oil pads pivot friction asperity film '
   character(len=*), parameter :: letters = 'abcdefghijklmnopqrstuvwxyz'
   !> Longest name of a bearing.
   integer, parameter :: longest_bearing = 30

   !> The group of a study. Its variables are those of other groups, `group%name = values`, with one value for each run.
   character(len=*), parameter :: study_group = 'sweep'

   !> One value; `repeat*value` stands for several of them.
   type :: token_type
      character(len=:), allocatable :: text
      logical :: quoted = .false.
   end type token_type

   !> `group%name(subscript) = values`, and where it was found: "case.nml line 3" or "--set".
   type :: assignment_type
      character(len=:), allocatable :: group, name, origin
      !> The group as the case names it, where that is the one of all bearings.
      character(len=:), allocatable :: named
      !> First element that the values go to; 0 where no subscript is given.
      integer :: subscript = 0
      !> True for an assignment of --set or of a run of a study: it may set an element that the file sets too.
      logical :: overrides = .false.
      !> True for one that the group of all bearings gives a bearing, which may have a value of its own.
      logical :: of_all = .false.
      type(token_type), allocatable :: values(:)
   end type assignment_type

   type :: namelist_type
      character(len=:), allocatable :: file
      !> Groups in their order, and where they start.
      type(assignment_type), allocatable :: groups(:)
      type(assignment_type), allocatable :: assignments(:)
   end type namelist_type

contains

   ! How assignments name the groups of a machine that a case has several times: disc(2) is the second group &disc,
   ! pads:drive_end the group &pads of the bearing drive_end; pads alone is that of all bearings.

   !> Behind the name of a group: "(2)".
   pure function counted(number) result(text)
      integer, intent(in) :: number
      character(len=:), allocatable :: text
      text = '('//to_text(number)//')'
   end function counted

   !> "disc" of disc(2), "pads" of pads:drive_end.
   pure function kind_of(group) result(kind)
      character(len=*), intent(in) :: group
      character(len=:), allocatable :: kind
      kind = group(:scan(group//':', ':(') - 1)
   end function kind_of

   !> "drive_end" of pads:drive_end; empty where it is the group of no bearing, or of all.
   pure function bearing_of(group) result(name)
      character(len=*), intent(in) :: group
      character(len=:), allocatable :: name
      name = group(min(len(group) + 1, index(group//':', ':') + 1):)
   end function bearing_of

   !> Whether groups of this kind have numbers.
   pure logical function is_counted(kind)
      character(len=*), intent(in) :: kind
      is_counted = index(several, ' '//kind//' ') > 0
   end function is_counted

   !> Whether each bearing may have a group of this kind.
   pure logical function may_have_bearing(kind)
      character(len=*), intent(in) :: kind
      may_have_bearing = index(of_bearings, ' '//kind//' ') > 0
   end function may_have_bearing

   !> What names the bearing in a group of this kind: "name" in &bearing itself.
   pure function naming_variable(kind) result(name)
      character(len=*), intent(in) :: kind
      character(len=:), allocatable :: name
      name = 'bearing'
      if (kind == 'bearing') name = 'name'
   end function naming_variable

   !> The start of a group in a case, and the line that names its bearing.
   pure function group_heading(group) result(text)
      character(len=*), intent(in) :: group
      character(len=:), allocatable :: text
      text = '&'//kind_of(group)//new_line('a')
      if (bearing_of(group) /= '') text = text//'  '//naming_variable(kind_of(group))//' = '''//bearing_of(group) &
         & //''''//new_line('a')
   end function group_heading

   !> "pads_drive_end" of pads:drive_end, "disc_2" of disc(2).
   pure function identifier_of(group) result(text)
      character(len=*), intent(in) :: group
      character(len=:), allocatable :: text
      text = replaced(replaced(replaced(group, ':', '_'), '(', '_'), ')', '')
   end function identifier_of

   !> Whether a bearing may have this name: letters, digits and underscores behind a letter.
   pure logical function is_name(name)
      character(len=*), intent(in) :: name
      is_name = len(name) > 0 .and. len(name) <= longest_bearing .and. verify(name, letters//'0123456789_') == 0
      if (is_name) is_name = index(letters, name(1:1)) > 0
   end function is_name

   !> Whether a group is spelled as one: alone, with a number, disc(2), or with the name of a bearing, pads:drive_end,
   !> where there are such groups of its kind.
   pure logical function is_spelled(group)
      character(len=*), intent(in) :: group
      character(len=:), allocatable :: kind, number
      kind = kind_of(group)
      is_spelled = kind == group
      if (index(group, ':') > 0) is_spelled = may_have_bearing(kind) .and. is_name(bearing_of(group))
      if (index(group, '(') /= len(kind) + 1) return
      number = group(len(kind) + 2:max(len(group) - 1, len(kind) + 1))
      is_spelled = is_counted(kind) .and. group == kind//'('//number//')' .and. number /= '' &
         & .and. verify(number, '0123456789') == 0
   end function is_spelled

   !> Puts an assignment behind the first n of a list, whose room doubles when it is full.
   pure subroutine append(new, list, n)
      type(assignment_type), intent(in) :: new
      type(assignment_type), allocatable, intent(inout) :: list(:)
      integer, intent(inout) :: n
      type(assignment_type), allocatable :: larger(:)
      if (n == size(list)) then
         allocate (larger(2*n + 1))
         larger(:n) = list
         call move_alloc(larger, list)
      end if
      n = n + 1
      list(n) = new
   end subroutine append

   !> Adds an assignment and removes those that it replaces. It comes last; only that of a study takes the position of
   !> the first one that it replaces, as the order of varied variables is the order of the runs.
   subroutine put_assignment(new, parsed)
      type(assignment_type), intent(in) :: new
      type(namelist_type), intent(inout) :: parsed
      type(assignment_type), allocatable :: together(:)
      logical, allocatable :: keep(:)
      integer, allocatable :: order(:)
      integer :: at, i, n
      n = size(parsed%assignments)
      keep = [(.not. replaces(new, parsed%assignments(i)), i=1, n)]
      at = n + 1
      if (new%group == study_group) at = findloc([keep, .false.], .false., dim=1)
      ! n + 1 stands for the new one
      order = [pack([(i, i=1, at - 1)], keep(:at - 1)), n + 1, pack([(i, i=at, n)], keep(at:))]
      ! one by one, as the compiler forgets to free what a constructor with pack copies
      allocate (together(size(order)))
      do i = 1, size(order)
         if (order(i) <= n) together(i) = parsed%assignments(order(i))
      end do
      together(findloc(order, n + 1, dim=1)) = new
      call move_alloc(together, parsed%assignments)
   end subroutine put_assignment

   !> True where the new assignment would undo all of an earlier one. One of --set to a group of all bearings undoes
   !> that of any of them.
   pure logical function undoes(new, earlier)
      type(assignment_type), intent(in) :: new, earlier
      undoes = new%name == earlier%name .and. (new%subscript == 0 .or. new%subscript == earlier%subscript)
      if (undoes .and. new%group /= earlier%group) undoes = new%overrides .and. new%group == kind_of(earlier%group) &
         & .and. bearing_of(earlier%group) /= ''
   end function undoes

   !> True where it also sets all that the earlier one set: an element does not replace a list that starts there.
   pure logical function replaces(new, earlier)
      type(assignment_type), intent(in) :: new, earlier
      replaces = undoes(new, earlier)
      if (new%subscript == 0 .or. new%group == study_group) return
      replaces = replaces .and. size(earlier%values) == 1 .and. index(earlier%values(1)%text, '*') == 0
   end function replaces

   !> "rotor%mass = -1", with at most four values, for messages.
   pure function assignment_text(a) result(text)
      type(assignment_type), intent(in) :: a
      character(len=:), allocatable :: text
      integer :: i
      text = target_text(a)//' = '//shortened(value_text(a%values(1)))
      do i = 2, min(4, size(a%values))
         text = text//', '//shortened(value_text(a%values(i)))
      end do
      if (size(a%values) > 4) text = text//', ... ('//to_text(size(a%values))//' values)'
   end function assignment_text

   !> "case.nml line 3: pads%mass", for messages.
   pure function place_of(a) result(text)
      type(assignment_type), intent(in) :: a
      character(len=:), allocatable :: text
      text = a%origin//': '//variable_text(a)
   end function place_of

   !> "pads%mass", as the case names it.
   pure function variable_text(a) result(text)
      type(assignment_type), intent(in) :: a
      character(len=:), allocatable :: text
      text = a%group
      if (allocated(a%named)) text = a%named
      text = text//'%'//a%name
   end function variable_text

   !> "pads%mass(2)".
   pure function target_text(a) result(text)
      type(assignment_type), intent(in) :: a
      character(len=:), allocatable :: text
      text = variable_text(a)
      if (a%subscript > 0) text = text//'('//to_text(a%subscript)//')'
   end function target_text

   !> A value as a case has it: a text in quotes, and quotes within the text doubled.
   pure function value_text(token) result(text)
      type(token_type), intent(in) :: token
      character(len=:), allocatable :: text
      text = token%text
      if (token%quoted) text = ''''//replaced(text, '''', '''''')//''''
   end function value_text

   !> Name and subscript of "name(subscript)", which is 0 where there is none; `ok` is false where it is none from 1 to
   !> 9999. In "disc(2)%mass(1)" the name is "disc(2)%mass".
   pure subroutine split_subscript(word, name, subscript, ok)
      character(len=*), intent(in) :: word
      character(len=:), allocatable, intent(out) :: name
      integer, intent(out) :: subscript
      logical, intent(out) :: ok
      integer :: percent, open
      percent = index(word, '%', back=.true.)
      open = index(word(percent + 1:), '(')
      name = word
      subscript = 0
      ok = open == 0
      if (ok) return
      open = percent + open
      name = word(:open - 1)
      subscript = whole_number(word(open + 1:max(open, len(word) - 1)))
      ok = subscript > 0 .and. subscript < 10000 .and. word(len(word):) == ')'
   end subroutine split_subscript

   !> [sign] digits [. digits] [e|d [sign] digits], with a digit before or after the point. Fortran itself
   !> would take more, such as 1+2 for 100.
   pure logical function is_number(word)
      character(len=*), intent(in) :: word
      character(len=*), parameter :: digits = '0123456789'
      character(len=:), allocatable :: mantissa, exponent
      integer :: e, point
      e = scan(word//'e', 'ed')
      mantissa = unsigned(word(:e - 1))
      exponent = unsigned(word(e + 1:))
      point = index(mantissa//'.', '.')
      mantissa = mantissa(:point - 1)//mantissa(point + 1:)
      is_number = len(word) <= 60 .and. len(mantissa) > 0 .and. verify(mantissa//exponent, digits) == 0 &
         & .and. (e > len(word) .or. len(exponent) > 0)
   end function is_number

   !> The number that a word in lower case means, infinite where it is too large; `ok` is false where it is no number.
   subroutine read_number(word, x, ok)
      character(len=*), intent(in) :: word
      real(wp), intent(out) :: x
      logical, intent(out) :: ok
      logical :: halting
      integer :: status
      x = 0
      ok = is_number(word)
      if (.not. ok) return
      ! 1e400 overflows in the reading; a build that traps overflow must not stop there
      call ieee_get_halting_mode(ieee_overflow, halting)
      call ieee_set_halting_mode(ieee_overflow, .false.)
      read (word, *, iostat=status) x
      call ieee_set_flag(ieee_overflow, .false.)
      call ieee_set_halting_mode(ieee_overflow, halting)
      ok = status == 0
   end subroutine read_number

   !> The range first:last:stride that a word such as 1000-6000 or 1000..6000 means, with a tenth of the way as its
   !> stride; empty for others.
   function meant_range(word) result(range)
      character(len=*), intent(in) :: word
      character(len=:), allocatable :: range
      real(wp) :: ends(2)
      integer :: last
      logical :: ok(2)
      range = ''
      last = len(word) - scan(word, '-.', back=.true.)
      if (last == 0 .or. last == len(word)) return
      associate (first => verify(word(:len(word) - last), '-.', back=.true.))
         if (first == 0) return
         call read_number(word(:first), ends(1), ok(1))
         call read_number(word(len(word) - last + 1:), ends(2), ok(2))
      end associate
      if (all(ok) .and. ends(2) > ends(1)) range = exact_text(ends(1))//':'//exact_text(ends(2))//':' &
         & //exact_text((ends(2) - ends(1))/10)
   end function meant_range

   !> True for words that mean infinity or no number.
   pure logical function is_special(word)
      character(len=*), intent(in) :: word
      is_special = any(unsigned(word) == [character(len=8) :: 'nan', 'inf', 'infinity'])
   end function is_special

   !> A word without its sign.
   pure function unsigned(word)
      character(len=*), intent(in) :: word
      character(len=:), allocatable :: unsigned
      unsigned = word(1 + scan(word(:min(1, len(word))), '+-'):)
   end function unsigned
end module assignments
