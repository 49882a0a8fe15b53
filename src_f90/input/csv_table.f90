!> Tables as text, of comma-separated values (RFC 4180): a first line that names columns, and rows below it. Cells stand
!> between commas, in double quotes where they have commas themselves; blanks around a cell do not belong to it.
!>
!> The text stays as it is, and a cell is looked up where it stands, so that a million rows take little more memory than
!> their file.
module csv_table
   use text, only: to_text, newline
   use errors, only: error_type
   use input_file, only: read_input, require_text, carriage
   implicit none (type, external)
   private
   public :: csv_table_type, read_csv, cell_type, next_cell, content, blanks

   character(len=*), parameter :: blank = ' ', tab = achar(9)
   !> What separates nothing.
   character(len=*), parameter :: blanks = blank//tab//carriage//newline

   type :: csv_table_type
      character(len=:), allocatable :: file
      !> Below the line of names; -1 where even that is missing.
      integer :: rows = 0
      character(len=:), allocatable, private :: text
      !> First and last character of each line, from 0, that of the names.
      integer, allocatable, private :: first(:), last(:)
   contains
      procedure :: take
      procedure :: row
      procedure :: origin
   end type csv_table_type

   type :: cell_type
      !> Its place in the line, without the quotes.
      integer :: first = 1, last = 0
      logical :: quoted = .false.
      !> What is wrong with it, if anything is.
      character(len=:), allocatable :: fault
   end type cell_type

contains

   !> Reads a file of this number of bytes at most.
   subroutine read_csv(file, longest, table, error)
      character(len=*), intent(in) :: file
      integer, intent(in) :: longest
      class(csv_table_type), intent(inout) :: table
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: text
      call read_input(file, 'table', longest, '', '', text, error)
      if (.not. allocated(error)) call table%take(text, file, error)
   end subroutine read_csv

   !> The same from text, which becomes the table's; blank lines at its end are none. `file` is for messages.
   subroutine take(self, text, file, error)
      class(csv_table_type), intent(inout) :: self
      character(len=:), allocatable, intent(inout) :: text
      character(len=*), intent(in) :: file
      type(error_type), allocatable, intent(out) :: error
      integer :: start, finish, lines, i
      call require_text(text, file, error)
      if (allocated(error)) return
      self%file = file
      start = 1
      ! a UTF-8 byte order mark
      if (index(text(:min(3, len(text))), char(239)//char(187)//char(191)) == 1) start = 4
      finish = verify(text, blanks, back=.true.)
      lines = 0
      do i = start, finish
         if (text(i:i) == newline .or. i == finish) lines = lines + 1
      end do
      self%rows = lines - 1
      allocate (self%first(0:self%rows), self%last(0:self%rows))
      lines = 0
      do i = start, finish
         if (text(i:i) /= newline .and. i < finish) cycle
         self%first(lines) = start
         self%last(lines) = merge(i - 1, i, text(i:i) == newline)
         if (i > start) then
            if (text(i:i) == newline .and. text(i - 1:i - 1) == carriage) self%last(lines) = i - 2
         end if
         start = i + 1
         lines = lines + 1
      end do
      call move_alloc(text, self%text)
   end subroutine take

   !> The text of a row; 0: the names.
   pure function row(self, k)
      class(csv_table_type), intent(in) :: self
      integer, intent(in) :: k
      character(len=:), allocatable :: row
      row = self%text(self%first(k):self%last(k))
   end function row

   !> Where it stands, for messages: "members.csv line 5".
   pure function origin(self, k)
      class(csv_table_type), intent(in) :: self
      integer, intent(in) :: k
      character(len=:), allocatable :: origin
      origin = self%file//' line '//to_text(k + 1)
   end function origin

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
end module csv_table
