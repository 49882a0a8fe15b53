!> A table of all input variables with their values. The list of variables (case_fields) fills it from a case, or the
!> case from it; what reads, writes, describes or changes a case goes along the table.
module variable_table
   use kinds, only: wp, i8
   use text, only: to_text, exact_text, newline, replaced
   use case_groups, only: is_set
   use assignments, only: token_type, value_text, group_heading
   implicit none (type, external)
   private
   public :: variable_type, variable_table_type, lines_of, group_start, word_text, exact

   !> The words of a variable that is true or false.
   character(len=*), parameter :: logical_words = '.true. .false.'
   !> Room in a table for variables, which is doubled where it is too small.
   integer, parameter :: first_room = 200

   type :: variable_type
      character(len=:), allocatable :: group, name
      !> Of the group, and of the variable; where the table is documented.
      character(len=:), allocatable :: group_meaning, meaning
      !> A text: its value, and the allowed words, separated by blanks; empty where any text is allowed.
      logical :: is_text = .false.
      character(len=:), allocatable :: word, choices
      !> Numbers: their values and unit, what is allowed, and whether only whole numbers are.
      real(wp), allocatable :: values(:)
      character(len=16) :: unit = '1'
      real(wp) :: low = 0, high = 0
      logical :: whole = .false.
      !> Whether it is not set in the case that the table was filled from.
      logical :: may_be_unset = .false.
      !> Whether the list may have any length, up to the most values; what it tells the number of, "pads", and what
      !> has one value each; else empty.
      logical :: any_length = .false.
      character(len=16) :: counts = '', each = ''
      integer :: most = 1
   contains
      procedure :: allowed
      procedure :: is_same
   end type variable_type

   type :: variable_table_type
      type(variable_type), allocatable :: variables(:)
      integer :: count = 0
      !> False while the table is filled, true while a case is filled from it; whether it has the meanings.
      logical :: filled = .false., documented = .false.
      !> The variable just seen, and its group.
      integer :: at = 0
      character(len=:), allocatable :: this_group, group_meaning
      !> Instead of all variables: the numbers of this one, whose elements from one to another are changed where they
      !> have a new value; the first of them as it was.
      character(len=:), allocatable, private :: sought_group, sought_name
      integer, private :: first = 0, last = 0
      real(wp), allocatable, private :: new_value
      real(wp) :: value = 0
   contains
      procedure :: seek
      procedure :: find
      procedure :: group
      !> The next variable of the list.
      procedure :: word
      procedure :: words
      procedure :: flag
      procedure :: whole
      procedure :: number
      procedure :: numbers
      procedure :: each
      procedure :: list
   end type variable_table_type

contains

   !> Lets the list be gone along for the numbers of one variable alone, one element of them or, with 0, all; they get
   !> the new value, if there is one.
   subroutine seek(self, group, name, element, new_value)
      class(variable_table_type), intent(inout) :: self
      character(len=*), intent(in) :: group, name
      integer, intent(in) :: element
      real(wp), intent(in), optional :: new_value
      self%sought_group = group
      self%sought_name = name
      self%first = max(1, element)
      self%last = merge(element, huge(element), element > 0)
      if (present(new_value)) self%new_value = new_value
      allocate (self%variables(1))
   end subroutine seek

   !> Number of a variable in the table; 0 if there is none of this name.
   pure integer function find(self, group, name) result(at)
      class(variable_table_type), intent(in) :: self
      character(len=*), intent(in) :: group, name
      do at = self%count, 1, -1
         if (self%variables(at)%group == group .and. self%variables(at)%name == name) return
      end do
   end function find

   !> Goes on to the next variable; true where it is to be entered in the table.
   logical function next(self, name, meaning) result(new)
      class(variable_table_type), intent(inout) :: self
      character(len=*), intent(in) :: name, meaning
      self%at = self%at + 1
      new = .not. self%filled
      if (allocated(self%sought_name)) then
         ! one place serves for all
         self%at = 1
         new = .false.
      end if
      if (.not. new) return
      call make_room(self)
      self%count = self%at
      associate (v => self%variables(self%at))
         v%group = self%this_group
         v%name = name
         if (.not. self%documented) return
         v%group_meaning = self%group_meaning
         v%meaning = meaning
      end associate
   end function next

   !> Room for one more; twice as much where there is none.
   subroutine make_room(self)
      class(variable_table_type), intent(inout) :: self
      type(variable_type), allocatable :: more(:)
      if (.not. allocated(self%variables)) allocate (self%variables(first_room))
      if (self%at <= size(self%variables)) return
      allocate (more(2*self%count))
      more(:self%count) = self%variables
      call move_alloc(more, self%variables)
   end subroutine make_room

   !> Begins a group; its variables follow.
   pure subroutine group(self, name, meaning)
      class(variable_table_type), intent(inout) :: self
      character(len=*), intent(in) :: name, meaning
      self%this_group = name
      self%group_meaning = meaning
   end subroutine group

   !> .true. or .false.
   subroutine flag(self, value, name, meaning)
      class(variable_table_type), intent(inout) :: self
      logical, intent(inout) :: value
      character(len=*), intent(in) :: name, meaning
      character(len=:), allocatable :: word
      word = trim(merge('.true. ', '.false.', value))
      call self%word(word, name, logical_words, meaning)
      value = word == '.true.'
   end subroutine flag

   !> A text: one of the words in `choices`, or any text where `choices` is empty.
   subroutine word(self, value, name, choices, meaning)
      class(variable_table_type), intent(inout) :: self
      character(len=:), allocatable, intent(inout) :: value
      character(len=*), intent(in) :: name, choices, meaning
      logical :: new
      new = next(self, name, meaning)
      associate (v => self%variables(self%at))
         if (new) then
            v%is_text = .true.
            v%choices = choices
            v%unit = ''
            v%word = value
         end if
         if (.not. allocated(self%sought_name)) value = v%word
      end associate
   end subroutine word

   !> A text, or one for each of this number of things: then a line each.
   subroutine words(self, value, things, number, name, meaning)
      class(variable_table_type), intent(inout) :: self
      character(len=:), allocatable, intent(inout) :: value
      character(len=*), intent(in) :: things, name, meaning
      integer, intent(in) :: number
      call self%word(value, name, '', meaning)
      associate (v => self%variables(self%at))
         v%each = things
         v%most = number
      end associate
   end subroutine words

   !> A fixed number of reals from `low` to `high`.
   subroutine numbers(self, values, name, low, high, unit, meaning)
      class(variable_table_type), intent(inout) :: self
      real(wp), intent(inout) :: values(:)
      real(wp), intent(in) :: low, high
      character(len=*), intent(in) :: name, unit, meaning
      logical :: new
      new = next(self, name, meaning)
      if (allocated(self%sought_name)) then
         call look_at(self, values, name)
         return
      end if
      associate (v => self%variables(self%at))
         if (new) then
            v%unit = unit
            v%low = low
            v%high = high
            v%values = values
            v%most = size(values)
            v%may_be_unset = .not. all(is_set(values))
         end if
         values = v%values
      end associate
   end subroutine numbers

   !> Looks at numbers of this name, and changes them, if they are those that are sought.
   pure subroutine look_at(self, values, name)
      class(variable_table_type), intent(inout) :: self
      real(wp), intent(inout) :: values(:)
      character(len=*), intent(in) :: name
      if (name /= self%sought_name .or. self%this_group /= self%sought_group) return
      self%value = values(self%first)
      if (allocated(self%new_value)) values(self%first:min(self%last, size(values))) = self%new_value
   end subroutine look_at

   !> One real; with `whole` only a whole one is allowed.
   subroutine number(self, value, name, low, high, unit, meaning, whole)
      class(variable_table_type), intent(inout) :: self
      real(wp), intent(inout) :: value
      real(wp), intent(in) :: low, high
      character(len=*), intent(in) :: name, unit, meaning
      logical, intent(in), optional :: whole
      real(wp) :: values(1)
      values = value
      call self%numbers(values, name, low, high, unit, meaning)
      if (present(whole)) self%variables(self%at)%whole = whole
      value = values(1)
   end subroutine number

   !> One whole number.
   subroutine whole(self, value, name, low, high, meaning)
      class(variable_table_type), intent(inout) :: self
      integer, intent(inout) :: value
      real(wp), intent(in) :: low, high
      character(len=*), intent(in) :: name, meaning
      real(wp) :: x
      x = value
      call self%number(x, name, low, high, '1', meaning, .true.)
      value = nint(x)
   end subroutine whole

   !> A list of reals of any length up to `most`. It may tell the number of what lists with one value each belong to:
   !> `counts` is "pads".
   subroutine list(self, values, most, name, low, high, unit, meaning, counts)
      class(variable_table_type), intent(inout) :: self
      real(wp), allocatable, intent(inout) :: values(:)
      integer, intent(in) :: most
      real(wp), intent(in) :: low, high
      character(len=*), intent(in) :: name, unit, meaning
      character(len=*), intent(in), optional :: counts
      if (self%filled) values = self%variables(self%at + 1)%values
      call self%numbers(values, name, low, high, unit, meaning)
      associate (v => self%variables(self%at))
         v%any_length = .true.
         v%most = most
         if (present(counts)) v%counts = counts
      end associate
   end subroutine list

   !> One real for each of what another list counts: for each of the pads.
   subroutine each(self, values, things, name, low, high, unit, meaning)
      class(variable_table_type), intent(inout) :: self
      real(wp), allocatable, intent(inout) :: values(:)
      real(wp), intent(in) :: low, high
      character(len=*), intent(in) :: things, name, unit, meaning
      call self%list(values, size(values), name, low, high, unit, meaning)
      self%variables(self%at)%any_length = .false.
      self%variables(self%at)%each = things
   end subroutine each

   !> The allowed numbers with their unit: "1e-4 to 10 m".
   pure function allowed(self) result(string)
      class(variable_type), intent(in) :: self
      character(len=:), allocatable :: string
      string = to_text(self%low)//' to '//to_text(self%high)
      if (self%unit /= '1' .and. self%unit /= '') string = string//' '//trim(self%unit)
   end function allowed

   !> Whether it has the value of another one.
   pure logical function is_same(self, other)
      class(variable_type), intent(in) :: self
      type(variable_type), intent(in) :: other
      if (self%is_text) then
         is_same = self%word == other%word
      else
         is_same = size(self%values) == size(other%values)
         if (is_same) is_same = all(abs(self%values - other%values) <= 0)
      end if
   end function is_same

   ! Variables as namelist text.

   !> What stands before the first variable of a group: the end of the group before it, and its own start.
   pure function group_start(table, i) result(text)
      type(variable_table_type), intent(in) :: table
      integer, intent(in) :: i
      character(len=:), allocatable :: text
      text = ''
      if (i > 1) then
         if (table%variables(i - 1)%group == table%variables(i)%group) return
         text = '/'//newline
      end if
      text = text//group_heading(table%variables(i)%group)
   end function group_start

   !> "  name = value", or a line for each element that is set where not all are, each with a mark behind it.
   pure function lines_of(v, mark) result(text)
      type(variable_type), intent(in) :: v
      character(len=*), intent(in) :: mark
      character(len=:), allocatable :: text, list, one
      integer :: i
      text = ''
      if (v%is_text) then
         if (v%word /= '' .or. v%choices == '') call add(v%name, word_text(v))
      else if (all(is_set(v%values))) then
         list = ''
         do i = 1, size(v%values)
            if (i > 1) list = list//', '
            ! of equal pads once
            if (.not. repeats(i)) one = exact(v, i)
            list = list//one
         end do
         call add(v%name, list)
      else
         do i = 1, size(v%values)
            if (is_set(v%values(i))) call add(v%name//'('//to_text(i)//')', exact(v, i))
         end do
      end if
   contains
      pure subroutine add(name, value)
         character(len=*), intent(in) :: name, value
         !> Column of the marks.
         integer, parameter :: column = 46
         text = text//'  '//name//' = '//value
         if (mark /= '') text = text//repeat(' ', max(2, column - len('  '//name//' = '//value)))//mark
         text = text//newline
      end subroutine add

      !> Whether a number has the bits of the one before it.
      pure logical function repeats(k)
         integer, intent(in) :: k
         repeats = k > 1
         if (repeats) repeats = transfer(v%values(k), 1_i8) == transfer(v%values(k - 1), 1_i8)
      end function repeats
   end function lines_of

   !> The word of a text, or its lines, in quotes, which a logical value does not need.
   pure function word_text(v) result(text)
      type(variable_type), intent(in) :: v
      character(len=:), allocatable :: text
      type(token_type) :: token
      token%text = v%word
      token%quoted = v%choices /= logical_words
      text = replaced(value_text(token), newline, ''', ''')
   end function word_text

   !> The i-th number, to the last bit.
   pure function exact(v, i) result(text)
      type(variable_type), intent(in) :: v
      integer, intent(in) :: i
      character(len=:), allocatable :: text
      if (v%whole) then
         text = to_text(nint(v%values(i)))
      else
         text = exact_text(v%values(i))
      end if
   end function exact
end module variable_table
