!> The cells of a line of comma-separated values (RFC 4180): texts between commas, in double quotes where they have
!> commas themselves. Blanks around a cell do not belong to it.
module csv_line
   implicit none (type, external)
   private
   public :: cell_type, next_cell, content

   character(len=*), parameter :: blank = ' ', tab = achar(9)

   type :: cell_type
      !> Its place in the line, without the quotes.
      integer :: first = 1, last = 0
      logical :: quoted = .false.
      !> What is wrong with it, if anything is.
      character(len=:), allocatable :: fault
   end type cell_type

contains

   !> The cell that begins at `at`, which moves behind the comma after it. There is none where `at` is beyond the
   !> line's length and one.
   pure subroutine next_cell(line, at, cell)
      character(len=*), intent(in) :: line
      integer, intent(inout) :: at
      type(cell_type), intent(out) :: cell
      call skip_blanks(line, at)
      cell%first = at
      if (at <= len(line)) cell%quoted = line(at:at) == '"'
      if (cell%quoted) then
         cell%first = at + 1
         call find_quote(line, at)
         cell%last = at - 1
         if (at > len(line)) cell%fault = 'the quote is not closed on its line'
         at = at + 1
         call skip_blanks(line, at)
         if (at <= len(line)) then
            if (line(at:at) /= ',') cell%fault = 'text behind the closing quote'
         end if
      end if
      do while (at <= len(line))
         if (line(at:at) == ',') exit
         at = at + 1
      end do
      if (.not. cell%quoted) then
         cell%last = at - 1
         do while (cell%last >= cell%first)
            if (line(cell%last:cell%last) /= blank .and. line(cell%last:cell%last) /= tab) exit
            cell%last = cell%last - 1
         end do
      end if
      at = at + 1
   end subroutine next_cell

   !> Moves from a quote to the one that closes it, or behind the line.
   pure subroutine find_quote(line, at)
      character(len=*), intent(in) :: line
      integer, intent(inout) :: at
      at = at + 1
      do while (at <= len(line))
         if (line(at:at) == '"') then
            if (line(at + 1:min(at + 1, len(line))) /= '"') return
            ! two within quotes are one
            at = at + 1
         end if
         at = at + 1
      end do
   end subroutine find_quote

   pure subroutine skip_blanks(line, at)
      character(len=*), intent(in) :: line
      integer, intent(inout) :: at
      do while (at <= len(line))
         if (line(at:at) /= blank .and. line(at:at) /= tab) return
         at = at + 1
      end do
   end subroutine skip_blanks

   !> The text of a cell.
   pure function content(line, cell) result(text)
      character(len=*), intent(in) :: line
      type(cell_type), intent(in) :: cell
      character(len=:), allocatable :: text
      integer :: i, length
      text = line(cell%first:cell%last)
      if (.not. cell%quoted) return
      length = 0
      i = 1
      do while (i <= len(text))
         length = length + 1
         text(length:length) = text(i:i)
         if (text(i:i) == '"') i = i + 1
         i = i + 1
      end do
      text = text(:length)
   end function content
end module csv_line
