!> Splits namelist text into assignments, each with its origin. Values are not interpreted.
module namelist_text
   use text, only: to_text, lower_case, shortened, newline
   use errors, only: error_type, require, refuse
   use assignments, only: namelist_type, assignment_type, token_type, put_assignment, append, undoes, split_subscript, &
      & assignment_text, place_of, study_group, counted, kind_of, bearing_of, is_counted, may_have_bearing, &
      & naming_variable, is_name, longest_bearing
   use case_parameter, only: meant_variable
   use read_files, only: read_input, require_text, control_character, tab, carriage
   implicit none (type, external)
   private
   public :: parse_namelist, parse_override, read_text, parse_case

   !> Maximum number of groups or of values of one assignment, of assignments (the resolved input of a machine has some
   !> eighty for each bearing), and maximum length of a name.
   integer, parameter :: most_items = 1000, most_assignments = 4000, longest_name = 60
   character(len=*), parameter :: too_many = ': more than 1000 ', too_many_given = ': more than 4000 values given'
   character(len=*), parameter :: name_characters = 'abcdefghijklmnopqrstuvwxyz_0123456789'

   !> Longest input file, bytes.
   integer, parameter :: longest_file = 100000

   !> Moves over namelist text, character by character and word by word: the text, and the position in it.
   type :: scanner
      character(len=:), allocatable :: text, file
      integer :: at = 1, line = 1
   contains
      procedure :: peek
      procedure :: skip_blank
      procedure :: word
      procedure :: origin
   end type scanner

contains

   !> Parses the text of a file; `file` is for messages.
   subroutine parse_namelist(text, file, parsed, error)
      character(len=*), intent(in) :: text, file
      type(namelist_type), intent(out) :: parsed
      type(error_type), allocatable, intent(out) :: error
      type(scanner) :: scan
      type(assignment_type) :: group
      type(assignment_type), allocatable :: list(:)
      character(len=:), allocatable :: kind
      integer :: first, last

      parsed%file = file
      allocate (parsed%groups(0), list(0))
      last = 0
      call require_text(text, file, error)
      if (allocated(error)) return
      scan%text = text
      scan%file = file
      ! a UTF-8 byte order mark
      if (index(text, char(239)//char(187)//char(191)) == 1) scan%at = 4
      do
         call scan%skip_blank(',')
         if (scan%peek() == '') exit
         group%origin = scan%origin()
         if (scan%peek() /= '&') then
            group%name = scan%word()
            if (group%name == '') group%name = scan%peek()
            call refuse(group%origin//': '''//shortened(group%name)//''' stands outside a group' &
               & //meant_variable('', lower_case(group%name))//'; expected &group ... /', error)
            return
         end if
         scan%at = scan%at + 1
         group%group = lower_case(scan%word())
         call require(group%group /= '', group%origin//': a group''s name is missing behind &', error)
         call require(len(group%group) <= longest_name, group%origin//': unknown group &' &
            & //shortened(group%group), error)
         ! --set and messages have a number or a bearing's name behind the name of a group
         kind = kind_of(group%group)
         call require(kind == group%group .or. .not. is_counted(kind), group%origin//': unknown group &' &
            & //shortened(group%group)//'; groups &'//kind//' are counted in their order, without a number', error)
         call require(kind == group%group .or. .not. may_have_bearing(kind), group%origin//': unknown group &' &
            & //shortened(group%group)//'; the bearing of a group &'//kind//' is named in it: ' &
            & //naming_variable(kind)//' = ''...''', error)
         call require(size(parsed%groups) < most_items, group%origin//too_many//'groups', error)
         if (allocated(error)) return
         kind = group%group
         first = last + 1
         call parse_group(scan, group, list, last, error)
         if (.not. allocated(error)) call name_group()
         if (allocated(error)) return
         parsed%groups = [parsed%groups, group]
      end do
      parsed%assignments = list(:last)
      call require(size(parsed%groups) > 0, file//': no namelist group in it; expected &name ... /', error)
   contains
      !> Gives a group and its assignments its number, where it is one of several, or the name of the bearing that one
      !> of them says, which is taken out. Refuses what is given twice.
      subroutine name_group()
         character(len=:), allocatable :: ending
         integer :: i, at
         ending = ''
         if (is_counted(kind)) then
            ending = counted(1 + count([(kind_of(parsed%groups(i)%group) == kind, i=1, size(parsed%groups))]))
         else if (may_have_bearing(kind)) then
            at = first - 1 + findloc([(list(i)%name == naming_variable(kind), i=first, last)], .true., dim=1)
            if (at >= first) then
               associate (named => list(at), value => list(at)%values(1))
                  call require(size(named%values) == 1 .and. named%subscript == 0 .and. value%quoted &
                     & .and. is_name(lower_case(value%text)), named%origin//': '//assignment_text(named)//': must be ' &
                     & //'one name in quotes, of at most '//to_text(longest_bearing)//' letters, digits and ' &
                     & //'underscores behind a letter', error)
                  ending = ':'//lower_case(value%text)
               end associate
               do i = at + 1, last
                  list(i - 1) = list(i)
               end do
               last = last - 1
            end if
         end if
         if (allocated(error)) return
         group%group = kind//ending
         do i = first, last
            list(i)%group = group%group
         end do
         at = findloc([(parsed%groups(i)%group == group%group, i=1, size(parsed%groups))], .true., dim=1)
         if (at == 0) return
         if (ending /= '') ending = ' of bearing '''//bearing_of(group%group)//''''
         call refuse(group%origin//': group &'//kind//ending//' is given twice, first at ' &
            & //parsed%groups(at)%origin, error)
      end subroutine name_group
   end subroutine parse_namelist

   !> Parses the argument of --set, "group%name=value"; it replaces what the file says.
   subroutine parse_override(text, parsed, error)
      character(len=*), intent(in) :: text
      type(namelist_type), intent(inout) :: parsed
      type(error_type), allocatable, intent(out) :: error
      type(scanner) :: scan
      type(assignment_type) :: group
      type(assignment_type), allocatable :: new(:)
      integer :: percent, n
      percent = index(text, '%')
      group%origin = '--set '//shortened(text)
      call require(control_character(text) == 0, group%origin//': a control character is no part of a value', error)
      if (percent <= 1 .or. index(text, '=') < percent) call refuse(group%origin//': expected group%name=value' &
         & //meant_variable('', lower_case(trim(adjustl(text(:index(text//'=', '=') - 1))))), error)
      if (allocated(error)) return
      group%group = lower_case(trim(adjustl(text(:percent - 1))))
      call require(len(group%group) <= longest_name, group%origin//': unknown group '//shortened(group%group), error)
      if (allocated(error)) return
      scan%text = text(percent + 1:)//' /'
      scan%file = group%origin
      allocate (new(0))
      n = 0
      call parse_group(scan, group, new, n, error)
      call scan%skip_blank('')
      call require(n == 1 .and. scan%peek() == '', group%origin//': expected one group%name=value; a text ' &
         & //'with a / stands in quotes within those of the shell: "group%name=''a/b''"', error)
      if (allocated(error)) return
      new(1)%origin = '--set'
      new(1)%overrides = .true.
      call put_assignment(new(1), parsed)
   end subroutine parse_override

   !> Reads a group from behind its name to behind its end. What it gives comes behind the first `last` assignments, and
   !> `last` is then the last of its own.
   subroutine parse_group(scan, group, assignments, last, error)
      type(scanner), intent(inout) :: scan
      type(assignment_type), intent(in) :: group
      type(assignment_type), allocatable, intent(inout) :: assignments(:)
      integer, intent(inout) :: last
      type(error_type), allocatable, intent(out) :: error
      type(assignment_type) :: new
      character(len=:), allocatable :: next
      integer :: i, first
      first = last + 1
      do
         call scan%skip_blank(',')
         next = lower_case(scan%text(scan%at:min(scan%at + 3, len(scan%text))))
         if (next == '&end' .or. index(next, '/') == 1) then
            scan%at = scan%at + merge(1, 4, next(1:1) == '/')
            return
         end if
         if (next == '' .or. index(next, '&') == 1) call refuse(group%origin//': group &'//group%group &
            & //' is not closed by /', error)
         if (allocated(error)) return
         new = group
         new%origin = scan%origin()
         call parse_target()
         if (.not. allocated(error)) call parse_values()
         if (allocated(error)) return
         do i = first, last
            if (undoes(new, assignments(i))) call refuse(place_of(new)//' is given twice, first at ' &
               & //assignments(i)%origin, error)
         end do
         call require(last < most_assignments, new%origin//too_many_given, error)
         if (allocated(error)) return
         call append(new, assignments, last)
      end do
   contains
      !> Reads "name [(subscript)] =".
      subroutine parse_target()
         character(len=:), allocatable :: found, allowed
         logical :: ok
         found = lower_case(scan%word())
         call split_subscript(found, new%name, new%subscript, ok)
         allowed = name_characters
         if (new%group == study_group) allowed = name_characters//'%:()'
         call scan%skip_blank('')
         call require(index(found, '(0)') == 0, new%origin//': '//new%group//'%'//shortened(found) &
            & //': elements count from 1', error)
         call require(ok .and. len(new%name) > 0 .and. verify(new%name, allowed) == 0 .and. scan%peek() == '=', &
            & new%origin//': '''//shortened(found)//''' in group &'//new%group//': expected name = value', error)
         call require(len(new%name) <= longest_name, new%origin//': unknown variable '//new%group//'%' &
            & //shortened(new%name), error)
         scan%at = scan%at + 1
      end subroutine parse_target

      !> Reads values up to the next name, the end of the group or of the text.
      subroutine parse_values()
         type(token_type) :: token
         character(len=:), allocatable :: found
         logical :: comma
         integer :: at, line
         allocate (new%values(0))
         comma = .true.
         do
            call scan%skip_blank('')
            if (scan%peek() == ',') then
               if (comma) exit
               comma = .true.
               scan%at = scan%at + 1
               cycle
            end if
            if (index('/&', scan%peek()) > 0) exit
            if (size(new%values) == most_items) call refuse(place_of(new)//too_many//'values', error)
            if (allocated(error)) return
            if (scan%peek() == '''' .or. scan%peek() == '"') then
               call quoted(token)
            else
               at = scan%at
               line = scan%line
               found = scan%word()
               token%text = found
               token%quoted = .false.
               call scan%skip_blank('')
               if (scan%peek() == '=') then
                  ! a word before '=' is the next name; a second '=' is no value
                  scan%at = at
                  scan%line = line
                  exit
               end if
            end if
            new%values = [new%values, token]
            comma = .false.
         end do
         call require(size(new%values) > 0 .and. scan%peek() /= ',' .and. scan%peek() /= '=', place_of(new) &
            & //': a value is missing', error)
      end subroutine parse_values

      !> Reads a text in quotes on one line; a doubled quote means one.
      subroutine quoted(token)
         type(token_type), intent(out) :: token
         character :: quote
         quote = scan%peek()
         token%text = ''
         token%quoted = .true.
         do
            scan%at = scan%at + 1
            if (len(scan%peek()) == 0 .or. scan%peek() == newline) then
               call refuse(place_of(new)//': the quote is not closed', error)
               return
            else if (scan%peek() == quote) then
               scan%at = scan%at + 1
               if (scan%peek() /= quote) return
            end if
            token%text = token%text//scan%text(scan%at:scan%at)
         end do
      end subroutine quoted
   end subroutine parse_group

   ! How the scanner moves.

   !> The character here; empty at the end.
   pure function peek(self) result(here)
      class(scanner), intent(in) :: self
      character(len=:), allocatable :: here
      here = self%text(self%at:min(self%at, len(self%text)))
   end function peek

   !> Moves over blanks, ends of lines, comments, and the characters of `also`.
   pure subroutine skip_blank(self, also)
      class(scanner), intent(inout) :: self
      character(len=*), intent(in) :: also
      do while (self%at <= len(self%text))
         associate (c => self%text(self%at:self%at))
            if (c == '!') then
               do while (self%at < len(self%text))
                  if (self%text(self%at + 1:self%at + 1) == newline) exit
                  self%at = self%at + 1
               end do
            else if (c == newline) then
               self%line = self%line + 1
            else if (index(' '//tab//carriage//also, c) == 0) then
               return
            end if
         end associate
         self%at = self%at + 1
      end do
   end subroutine skip_blank

   !> The run of characters from here to a separator; moves behind it.
   function word(self) result(found)
      class(scanner), intent(inout) :: self
      character(len=:), allocatable :: found
      integer :: length
      length = scan(self%text(self%at:), ' ,=/&!''"'//tab//newline//carriage) - 1
      if (length < 0) length = len(self%text(self%at:))
      found = self%text(self%at:self%at + length - 1)
      self%at = self%at + length
   end function word

   !> The position for messages: "case.nml line 3".
   pure function origin(self)
      class(scanner), intent(in) :: self
      character(len=:), allocatable :: origin
      origin = self%file
      if (index(self%file, '--set') /= 1) origin = self%file//' line '//to_text(self%line)
   end function origin

   ! A case file, read and split into assignments.

   !> The text of a case file.
   subroutine read_text(file, text, error)
      character(len=*), intent(in) :: file
      character(len=:), allocatable, intent(out) :: text
      type(error_type), allocatable, intent(out) :: error
      call read_input(file, 'case', longest_file, '; tiltpad-collect makes a study of a folder of results', &
         & '; tiltpad-plot draws it, tiltpad --resume '//file//' continues a result', text, error)
   end subroutine read_text

   !> The assignments of a case's text, with the overrides ("group%name=value"); `file` is for messages.
   subroutine parse_case(text, file, overrides, parsed, error)
      character(len=*), intent(in) :: text, file, overrides(:)
      type(namelist_type), intent(out) :: parsed
      type(error_type), allocatable, intent(out) :: error
      integer :: i
      call parse_namelist(text, file, parsed, error)
      do i = 1, size(overrides)
         if (.not. allocated(error)) call parse_override(trim(overrides(i)), parsed, error)
      end do
   end subroutine parse_case
end module namelist_text
