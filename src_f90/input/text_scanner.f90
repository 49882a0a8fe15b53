!> Moves over namelist text, character by character and word by word.
module text_scanner
   use text, only: to_text
   implicit none (type, external)
   private
   public :: scanner, control_character, newline

   !> The text, and the position in it.
   type :: scanner
      character(len=:), allocatable :: text, file
      integer :: at = 1, line = 1
   contains
      procedure :: peek
      procedure :: skip_blank
      procedure :: word
      procedure :: origin
   end type scanner

   character(len=*), parameter :: newline = achar(10), tab = achar(9), carriage = achar(13)

contains

   !> Position of the first character that is no text; 0 if there is none. A carriage return that ends no line is such a
   !> character: it would neither end a comment nor count as a line.
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

   !> The position for messages: "case.nml line 3".
   pure function origin(self)
      class(scanner), intent(in) :: self
      character(len=:), allocatable :: origin
      origin = self%file
      if (index(self%file, '--set') /= 1) origin = self%file//' line '//to_text(self%line)
   end function origin
end module text_scanner
