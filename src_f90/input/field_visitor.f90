!> The record of an input variable, and the abstract visitor that all readers and writers of variables extend.
module field_visitor
   use kinds, only: wp
   use text, only: to_text
   implicit none (type, external)
   private
   public :: field_type, field, choice, visitor_type, logical_words

   !> The words of a variable that is true or false.
   character(len=*), parameter :: logical_words = '.true. .false.'

   !> An input variable, without its value.
   type :: field_type
      !> Its name in its group.
      character(len=:), allocatable :: name
      !> Of numbers: unit, and allowed values.
      character(len=:), allocatable :: unit
      real(wp) :: low = -huge(1.0_wp), high = huge(1.0_wp)
      !> Of texts: the allowed words, separated by blanks; empty where any text is allowed.
      character(len=:), allocatable :: choices
      !> For the input reference.
      character(len=:), allocatable :: meaning
      !> True for the list whose length is the number of pads.
      logical :: fixes_pads = .false.
   contains
      procedure :: allows
      procedure :: range_text
   end type field_type

   type, abstract :: visitor_type
   contains
      !> The next group.
      procedure(visit_group), deferred :: group
      procedure(visit_word), deferred :: word
      procedure(visit_whole), deferred :: whole
      !> A fixed number of reals.
      procedure(visit_numbers), deferred :: numbers
      !> One real for each pad.
      procedure(visit_per_pad), deferred :: per_pad
      !> A list of reals of any length up to a largest one.
      procedure(visit_list), deferred :: list
      !> One real.
      procedure, non_overridable :: number
      !> A logical, by its words.
      procedure, non_overridable :: flag
   end type visitor_type

   abstract interface
      subroutine visit_group(self, name, meaning)
         import :: visitor_type
         class(visitor_type), intent(inout) :: self
         character(len=*), intent(in) :: name, meaning
      end subroutine visit_group

      subroutine visit_word(self, value, field)
         import :: visitor_type, field_type
         class(visitor_type), intent(inout) :: self
         character(len=:), allocatable, intent(inout) :: value
         type(field_type), intent(in) :: field
      end subroutine visit_word

      subroutine visit_whole(self, value, field)
         import :: visitor_type, field_type
         class(visitor_type), intent(inout) :: self
         integer, intent(inout) :: value
         type(field_type), intent(in) :: field
      end subroutine visit_whole

      subroutine visit_numbers(self, values, field)
         import :: visitor_type, field_type, wp
         class(visitor_type), intent(inout) :: self
         real(wp), intent(inout) :: values(:)
         type(field_type), intent(in) :: field
      end subroutine visit_numbers

      subroutine visit_per_pad(self, values, field)
         import :: visitor_type, field_type, wp
         class(visitor_type), intent(inout) :: self
         real(wp), allocatable, intent(inout) :: values(:)
         type(field_type), intent(in) :: field
      end subroutine visit_per_pad

      subroutine visit_list(self, values, most, field)
         import :: visitor_type, field_type, wp
         class(visitor_type), intent(inout) :: self
         real(wp), allocatable, intent(inout) :: values(:)
         integer, intent(in) :: most
         type(field_type), intent(in) :: field
      end subroutine visit_list
   end interface

contains

   !> A variable of numbers from `low` to `high`.
   pure function field(name, low, high, unit, meaning, fixes_pads) result(new)
      character(len=*), intent(in) :: name, unit, meaning
      real(wp), intent(in) :: low, high
      logical, intent(in), optional :: fixes_pads
      type(field_type) :: new
      new%name = name
      new%low = low
      new%high = high
      new%unit = unit
      new%choices = ''
      new%meaning = meaning
      if (present(fixes_pads)) new%fixes_pads = fixes_pads
   end function field

   !> A variable that is a text: one of the words in `choices`, or any text where `choices` is empty.
   pure function choice(name, choices, meaning) result(new)
      character(len=*), intent(in) :: name, choices, meaning
      type(field_type) :: new
      new%name = name
      new%unit = ''
      new%choices = choices
      new%meaning = meaning
   end function choice

   subroutine number(self, value, field)
      class(visitor_type), intent(inout) :: self
      real(wp), intent(inout) :: value
      type(field_type), intent(in) :: field
      real(wp) :: values(1)
      values = value
      call self%numbers(values, field)
      value = values(1)
   end subroutine number

   subroutine flag(self, value, field)
      class(visitor_type), intent(inout) :: self
      logical, intent(inout) :: value
      type(field_type), intent(in) :: field
      character(len=:), allocatable :: word
      word = trim(merge('.true. ', '.false.', value))
      call self%word(word, field)
      value = word == '.true.'
   end subroutine flag

   pure logical function allows(self, x)
      class(field_type), intent(in) :: self
      real(wp), intent(in) :: x
      allows = x >= self%low .and. x <= self%high
   end function allows

   !> The allowed numbers: "0 to 1".
   pure function range_text(self) result(string)
      class(field_type), intent(in) :: self
      character(len=:), allocatable :: string
      string = to_text(self%low)//' to '//to_text(self%high)
   end function range_text
end module field_visitor
