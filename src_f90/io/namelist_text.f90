!> Splits namelist text into assignments that know where they stand. Values are not interpreted.
module namelist_text
   use text, only: to_text, lower_case, shortened
   use errors, only: error_type, raise, input_error
   implicit none (type, external)
   private
   public :: namelist_type, assignment_type, token_type, parse_namelist, parse_override
   public :: put_assignment, undoes, assignment_text, target_text, value_text, sweep_group

   !> The group whose variables are those of other groups, with values for one run each: `group%name = values`.
   character(len=*), parameter :: sweep_group = 'sweep'

   !> One value; `repeat*value` stands for several of them.
   type :: token_type
      character(len=:), allocatable :: text
      logical :: quoted = .false.
   end type token_type

   !> `group%name(subscript) = values`, and where: "case.nml line 3" or "--set".
   type :: assignment_type
      character(len=:), allocatable :: group, name, place
      !> First element that the values go to; 0 where no subscript is given.
      integer :: subscript = 0
      !> Comes after what the file says, and may give elements again: from --set, or a member's of a sweep.
      logical :: overrides = .false.
      type(token_type), allocatable :: values(:)
   end type assignment_type

   type :: namelist_type
      character(len=:), allocatable :: file
      !> Groups in their order, and where they start.
      type(assignment_type), allocatable :: groups(:)
      type(assignment_type), allocatable :: assignments(:)
   end type namelist_type

   !> Most groups, assignments, or values of one assignment: far more than any case has; longest name.
   integer, parameter :: most_items = 1000, longest_name = 60

   !> Where the scanner is.
   type :: scanner
      character(len=:), allocatable :: text, file
      integer :: at = 1, line = 1
   contains
      procedure :: peek
      procedure :: skip_blank
      procedure :: word
      procedure :: place
   end type scanner

   character(len=*), parameter :: newline = achar(10), tab = achar(9), carriage = achar(13)
   character(len=*), parameter :: letters = 'abcdefghijklmnopqrstuvwxyz_'
   character(len=*), parameter :: name_characters = letters//'0123456789'

contains

   !> Parses the text of a file; `file` is for messages.
   subroutine parse_namelist(text, file, parsed, error)
      character(len=*), intent(in) :: text, file
      type(namelist_type), intent(out) :: parsed
      type(error_type), allocatable, intent(out) :: error
      type(scanner) :: scan
      type(assignment_type) :: group
      integer :: i

      parsed%file = file
      allocate (parsed%groups(0), parsed%assignments(0))
      i = control_character(text)
      if (i > 0) then
         call raise(error, input_error, file//': not a text file (byte '//to_text(i)//' is a control character)')
         return
      end if
      scan%text = text
      scan%file = file
      ! a UTF-8 byte order mark
      if (index(text, char(239)//char(187)//char(191)) == 1) scan%at = 4
      do
         call scan%skip_blank(',')
         if (scan%peek() == '') exit
         if (scan%peek() /= '&') then
            group%place = scan%place()
            group%name = scan%word()
            if (group%name == '') group%name = scan%peek()
            call raise(error, input_error, group%place//': '''//shortened(group%name)//''' stands outside a group;' &
               & //' expected &name')
            return
         end if
         scan%at = scan%at + 1
         group%place = scan%place()
         group%group = lower_case(scan%word())
         if (group%group == '') then
            call raise(error, input_error, group%place//': a group''s name is missing behind &')
            return
         end if
         if (len(group%group) > longest_name) then
            call raise(error, input_error, group%place//': unknown group &'//shortened(group%group))
            return
         end if
         if (size(parsed%groups) == most_items) then
            call raise(error, input_error, group%place//': more than '//to_text(most_items)//' groups')
            return
         end if
         do i = 1, size(parsed%groups)
            if (parsed%groups(i)%group == group%group) then
               call raise(error, input_error, group%place//': group &'//group%group//' is given twice, first at ' &
                  & //parsed%groups(i)%place)
               return
            end if
         end do
         parsed%groups = [parsed%groups, group]
         call parse_group(scan, group, parsed%assignments, error)
         if (allocated(error)) return
      end do
      if (size(parsed%groups) == 0) call raise(error, input_error, &
         & file//': no namelist group in it; expected &name ... /')
   end subroutine parse_namelist

   !> Parses the argument of --set, "group%name=value", and puts it in place of what the file says.
   subroutine parse_override(text, parsed, error)
      character(len=*), intent(in) :: text
      type(namelist_type), intent(inout) :: parsed
      type(error_type), allocatable, intent(out) :: error
      type(scanner) :: scan
      type(assignment_type) :: group
      type(assignment_type), allocatable :: new(:)
      integer :: percent
      percent = index(text, '%')
      group%place = '--set '//shortened(text)
      if (control_character(text) > 0) then
         call raise(error, input_error, group%place//': a control character is no part of a value')
         return
      end if
      if (percent > 1) group%group = lower_case(trim(adjustl(text(:percent - 1))))
      if (percent <= 1 .or. index(text, '=') < percent) then
         call raise(error, input_error, group%place//': expected group%name=value')
         return
      end if
      if (len(group%group) > longest_name) then
         call raise(error, input_error, group%place//': unknown group '//shortened(group%group))
         return
      end if
      scan%text = text(percent + 1:)//' /'
      scan%file = group%place
      allocate (new(0))
      call parse_group(scan, group, new, error)
      if (allocated(error)) return
      call scan%skip_blank('')
      if (size(new) /= 1 .or. scan%peek() /= '') then
         call raise(error, input_error, group%place//': expected one group%name=value')
         return
      end if
      new(1)%place = '--set'
      new(1)%overrides = .true.
      call put_assignment(new(1), parsed)
   end subroutine parse_override

   !> Puts an assignment in place of those it replaces: behind all others, but a sweep's where the first of them stood,
   !> as their order is that of the members.
   subroutine put_assignment(new, parsed)
      type(assignment_type), intent(in) :: new
      type(namelist_type), intent(inout) :: parsed
      type(assignment_type), allocatable :: together(:)
      logical, allocatable :: keep(:)
      integer :: at, i, k
      keep = [(.not. replaces(new, parsed%assignments(i)), i=1, size(parsed%assignments))]
      at = size(keep) + 1
      if (new%group == sweep_group) at = findloc([keep, .false.], .false., dim=1)
      ! one by one, as the compiler forgets to free what a constructor with pack copies
      allocate (together(count(keep) + 1))
      k = 0
      do i = 1, size(keep) + 1
         if (i == at) then
            k = k + 1
            together(k) = new
         end if
         if (i > size(keep)) exit
         if (.not. keep(i)) cycle
         k = k + 1
         together(k) = parsed%assignments(i)
      end do
      call move_alloc(together, parsed%assignments)
   end subroutine put_assignment

   !> From behind the group's name to behind its end.
   subroutine parse_group(scan, group, assignments, error)
      type(scanner), intent(inout) :: scan
      type(assignment_type), intent(in) :: group
      type(assignment_type), allocatable, intent(inout) :: assignments(:)
      type(error_type), allocatable, intent(out) :: error
      type(assignment_type) :: new
      integer :: i
      do
         call scan%skip_blank(',')
         select case (scan%peek())
         case ('/')
            scan%at = scan%at + 1
            return
         case ('&', '')
            if (scan%peek() == '&' .and. lower_case(scan%text(scan%at:min(scan%at + 3, len(scan%text)))) == '&end') then
               scan%at = scan%at + 4
               return
            end if
            call raise(error, input_error, group%place//': group &'//group%group//' is not closed by /')
            return
         case default
            continue
         end select
         new = group
         new%place = scan%place()
         call parse_target(scan, new, error)
         if (.not. allocated(error)) call parse_values(scan, new, error)
         if (allocated(error)) return
         do i = 1, size(assignments)
            if (undoes(new, assignments(i))) then
               call raise(error, input_error, new%place//': '//new%group//'%'//new%name//' is given twice, first at ' &
                  & //assignments(i)%place)
               return
            end if
         end do
         if (size(assignments) == most_items) then
            call raise(error, input_error, new%place//': more than '//to_text(most_items)//' values given')
            return
         end if
         assignments = [assignments, new]
      end do
   end subroutine parse_group

   !> name [(subscript)] =
   subroutine parse_target(scan, new, error)
      type(scanner), intent(inout) :: scan
      type(assignment_type), intent(inout) :: new
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: found, subscript, allowed
      integer :: open, status
      found = lower_case(scan%word())
      open = index(found, '(')
      status = 0
      new%name = found
      if (open > 0) then
         new%name = found(:open - 1)
         subscript = found(open + 1:max(open, len(found) - 1))
         if (subscript == '' .or. verify(subscript, '0123456789') /= 0 .or. len(subscript) > 4 &
            & .or. found(len(found):) /= ')') then
            status = 1
         else
            read (subscript, *) new%subscript
            if (new%subscript < 1) status = 1
         end if
      end if
      allowed = name_characters
      if (new%group == sweep_group) allowed = name_characters//'%'
      call scan%skip_blank('')
      if (status /= 0 .or. len(new%name) == 0 .or. verify(new%name, allowed) /= 0 .or. scan%peek() /= '=') then
         call raise(error, input_error, new%place//': '''//shortened(found)//''' in group &'//new%group &
            & //': expected name = value')
         return
      end if
      if (len(new%name) > longest_name) then
         call raise(error, input_error, new%place//': unknown variable '//new%group//'%'//shortened(new%name))
         return
      end if
      scan%at = scan%at + 1
   end subroutine parse_target

   !> Values up to the next name, the end of the group or of the text.
   subroutine parse_values(scan, new, error)
      type(scanner), intent(inout) :: scan
      type(assignment_type), intent(inout) :: new
      type(error_type), allocatable, intent(out) :: error
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
         if (size(new%values) == most_items) then
            call raise(error, input_error, new%place//': '//new%group//'%'//new%name//': more than ' &
               & //to_text(most_items)//' values')
            return
         end if
         if (scan%peek() == '''' .or. scan%peek() == '"') then
            call quoted(scan, token, new, error)
            if (allocated(error)) return
         else
            at = scan%at
            line = scan%line
            found = scan%word()
            token%text = found
            token%quoted = .false.
            call scan%skip_blank('')
            if (scan%peek() == '=') then
               ! a word before '=' is the next name; a second '=' is no value
               if (found == '') exit
               scan%at = at
               scan%line = line
               exit
            end if
         end if
         new%values = [new%values, token]
         comma = .false.
      end do
      if (size(new%values) == 0 .or. scan%peek() == ',' .or. scan%peek() == '=') then
         call raise(error, input_error, new%place//': '//new%group//'%'//new%name//': a value is missing')
      end if
   end subroutine parse_values

   !> A string in quotes on one line; a doubled quote stands for itself.
   subroutine quoted(scan, token, new, error)
      type(scanner), intent(inout) :: scan
      type(token_type), intent(out) :: token
      type(assignment_type), intent(in) :: new
      type(error_type), allocatable, intent(out) :: error
      character :: quote
      quote = scan%peek()
      token%text = ''
      token%quoted = .true.
      do
         scan%at = scan%at + 1
         if (len(scan%peek()) == 0 .or. scan%peek() == newline) then
            call raise(error, input_error, new%place//': '//new%group//'%'//new%name//': the quote is not closed')
            return
         else if (scan%peek() == quote) then
            scan%at = scan%at + 1
            if (scan%peek() /= quote) return
         end if
         token%text = token%text//scan%text(scan%at:scan%at)
      end do
   end subroutine quoted

   !> Where the first character stands that is no text; 0 if there is none. A carriage return alone is one: it would
   !> neither end a comment nor count as a line.
   pure integer function control_character(text) result(at)
      character(len=*), intent(in) :: text
      character :: c
      do at = 1, len(text)
         c = text(at:at)
         if (c == carriage .and. at < len(text)) then
            if (text(at + 1:at + 1) /= newline) return
         else if (c == achar(127) .or. c < ' ' .and. c /= newline .and. c /= tab) then
            return
         end if
      end do
      at = 0
   end function control_character

   !> True where the new assignment would undo all of an earlier one.
   pure logical function undoes(new, earlier)
      type(assignment_type), intent(in) :: new, earlier
      undoes = new%group == earlier%group .and. new%name == earlier%name &
         & .and. (new%subscript == 0 .or. new%subscript == earlier%subscript)
   end function undoes

   !> The same, and nothing of the earlier one's is lost: an element does not stand for a list that starts there.
   pure logical function replaces(new, earlier)
      type(assignment_type), intent(in) :: new, earlier
      replaces = undoes(new, earlier)
      if (new%subscript == 0 .or. new%group == sweep_group) return
      replaces = replaces .and. size(earlier%values) == 1 .and. index(earlier%values(1)%text, '*') == 0
   end function replaces

   !> "rotor%mass = -1", with at most four values, for messages.
   pure function assignment_text(a) result(text)
      type(assignment_type), intent(in) :: a
      character(len=:), allocatable :: text
      integer :: i
      text = target_text(a)//' = '
      do i = 1, min(4, size(a%values))
         if (i > 1) text = text//', '
         text = text//shortened(value_text(a%values(i)))
      end do
      if (size(a%values) > 4) text = text//', ... ('//to_text(size(a%values))//' values)'
   end function assignment_text

   !> "pads%mass(2)".
   pure function target_text(a) result(text)
      type(assignment_type), intent(in) :: a
      character(len=:), allocatable :: text
      text = a%group//'%'//a%name
      if (a%subscript > 0) text = text//'('//to_text(a%subscript)//')'
   end function target_text

   !> A value as it stands in a case: a quoted one in quotes, those in it doubled.
   pure function value_text(token) result(text)
      type(token_type), intent(in) :: token
      character(len=:), allocatable :: text
      integer :: i
      text = token%text
      if (.not. token%quoted) return
      text = ''''
      do i = 1, len(token%text)
         text = text//token%text(i:i)
         if (token%text(i:i) == '''') text = text//''''
      end do
      text = text//''''
   end function value_text

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
      length = scan(self%text(self%at:)//' ', ' ,=/&!''"'//tab//newline//carriage) - 1
      found = self%text(self%at:self%at + length - 1)
      self%at = self%at + length
   end function word

   pure function place(self)
      class(scanner), intent(in) :: self
      character(len=:), allocatable :: place
      place = self%file
      if (index(self%file, '--set') /= 1) place = self%file//' line '//to_text(self%line)
   end function place
end module namelist_text
