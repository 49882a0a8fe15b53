!> A table of all input variables with their values. The list of variables (case_fields) fills it from a case, or the
!> case from it; what reads, writes, describes or changes a case goes along the table.
module variable_table
   use kinds, only: wp
   use text, only: to_text
   use case_groups, only: is_set
   implicit none (type, external)
   private
   public :: variable_type, variable_table_type, logical_words

   !> The words of a variable that is true or false.
   character(len=*), parameter :: logical_words = '.true. .false.'
   !> Room in a table for variables, which is doubled where it is too small.
   integer, parameter :: first_room = 200

   type :: variable_type
      character(len=:), allocatable :: group, name
      !> For the input reference: of the group, and of the variable.
      character(len=:), allocatable :: group_meaning, meaning
      !> A text: its value, and the allowed words, separated by blanks; empty where any text is allowed.
      logical :: is_text = .false.
      character(len=:), allocatable :: word, choices
      !> Numbers: their values and unit, what is allowed, and whether only whole numbers are.
      real(wp), allocatable :: values(:)
      character(len=:), allocatable :: unit
      real(wp) :: low = 0, high = 0
      logical :: whole = .false.
      !> Whether it is not set in the case that the table was filled from.
      logical :: may_be_unset = .false.
      !> Whether the list may have any length, up to the most values; what it tells the number of, "pads", and what
      !> has one value each; else empty.
      logical :: any_length = .false.
      character(len=:), allocatable :: counts, each
      integer :: most = 1
   contains
      procedure :: range_text
      procedure :: allowed
   end type variable_type

   type :: variable_table_type
      type(variable_type), allocatable :: variables(:)
      integer :: count = 0
      !> False while the table is filled, true while a case is filled from it.
      logical, private :: filled = .false.
      !> The variable just seen, and its group.
      integer, private :: at = 0
      character(len=:), allocatable, private :: this_group, group_meaning
      !> What stands behind the names of groups.
      character(len=:), allocatable, private :: ending
   contains
      procedure :: begin
      procedure :: find
      !> The next variable or group of the list.
      procedure :: behind_group
      procedure :: group
      procedure :: word
      procedure :: flag
      procedure :: whole
      procedure :: number
      procedure :: numbers
      procedure :: each
      procedure :: list
   end type variable_table_type

contains

   !> Readies a table for the list: to fill it, or a case from it.
   subroutine begin(self, filled)
      class(variable_table_type), intent(inout) :: self
      logical, intent(in) :: filled
      self%filled = filled
      self%at = 0
      self%ending = ''
      if (filled) return
      if (allocated(self%variables)) deallocate (self%variables)
      allocate (self%variables(first_room))
      self%count = 0
   end subroutine begin

   !> Number of a variable in the table; 0 if there is none of this name.
   pure integer function find(self, group, name) result(at)
      class(variable_table_type), intent(in) :: self
      character(len=*), intent(in) :: group, name
      do at = self%count, 1, -1
         if (self%variables(at)%group == group .and. self%variables(at)%name == name) return
      end do
   end function find

   !> The names of the groups to come have this ending, which tells them from others of their kind.
   subroutine behind_group(self, ending)
      class(variable_table_type), intent(inout) :: self
      character(len=*), intent(in) :: ending
      self%ending = ending
   end subroutine behind_group

   subroutine group(self, name, meaning)
      class(variable_table_type), intent(inout) :: self
      character(len=*), intent(in) :: name, meaning
      self%this_group = name//self%ending
      self%group_meaning = meaning
   end subroutine group

   !> Goes on to the next variable; true where it is to be entered in the table.
   logical function next(self, name, meaning) result(new)
      class(variable_table_type), intent(inout) :: self
      character(len=*), intent(in) :: name, meaning
      self%at = self%at + 1
      new = .not. self%filled
      if (.not. new) return
      if (self%at > size(self%variables)) call enlarge(self)
      self%count = self%at
      associate (v => self%variables(self%at))
         v%group = self%this_group
         v%group_meaning = self%group_meaning
         v%name = name
         v%meaning = meaning
         v%unit = '1'
         v%counts = ''
         v%each = ''
      end associate
   end function next

   !> Twice the room.
   subroutine enlarge(self)
      class(variable_table_type), intent(inout) :: self
      type(variable_type), allocatable :: more(:)
      integer :: i
      allocate (more(2*size(self%variables)))
      do i = 1, self%count
         more(i) = self%variables(i)
      end do
      call move_alloc(more, self%variables)
   end subroutine enlarge

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
         value = v%word
      end associate
   end subroutine word

   !> A logical, by its words.
   subroutine flag(self, value, name, meaning)
      class(variable_table_type), intent(inout) :: self
      logical, intent(inout) :: value
      character(len=*), intent(in) :: name, meaning
      character(len=:), allocatable :: word
      word = trim(merge('.true. ', '.false.', value))
      call self%word(word, name, logical_words, meaning)
      value = word == '.true.'
   end subroutine flag

   !> A fixed number of reals from `low` to `high`.
   subroutine numbers(self, values, name, low, high, unit, meaning)
      class(variable_table_type), intent(inout) :: self
      real(wp), intent(inout) :: values(:)
      real(wp), intent(in) :: low, high
      character(len=*), intent(in) :: name, unit, meaning
      logical :: new
      new = next(self, name, meaning)
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

   !> The same with the unit: "1e-4 to 10 m".
   pure function allowed(self) result(string)
      class(variable_type), intent(in) :: self
      character(len=:), allocatable :: string
      string = self%range_text()
      if (self%unit /= '1' .and. self%unit /= '') string = string//' '//self%unit
   end function allowed

   !> The allowed numbers: "0 to 1".
   pure function range_text(self) result(string)
      class(variable_type), intent(in) :: self
      character(len=:), allocatable :: string
      string = to_text(self%low)//' to '//to_text(self%high)
   end function range_text
end module variable_table
