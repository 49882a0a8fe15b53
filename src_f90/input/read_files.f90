!> Reads input files: their text whole; tables of comma-separated values (RFC 4180), whose first line names columns; and
!> the columns of numbers that a case names, with checksums that tell whether they have changed since.
!>
!> Cells stand between commas, in double quotes where they have commas themselves; blanks around a cell do not belong to
!> it. The text of a table stays as it is, and a cell is looked up where it stands, so that a million rows take little
!> more memory than their file.
module read_files
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp, i8, pi, rpm
   use text, only: to_text, lower_case, shortened, filled, checksum, newline
   use errors, only: error_type, raise, require, refuse, add_context, system_error
   use files, only: is_regular
   use case_groups, only: pivot_type, station_element_type, in_range
   use case_inputs, only: case_type
   use machine_checks, only: check_element_tables
   use other_units, only: in_other_units
   use assignments, only: read_number
   implicit none (type, external)
   private
   public :: read_input, require_text, control_character, tab, carriage
   public :: csv_table_type, read_csv, cell_type, next_cell, content, blanks
   public :: read_tables, file_marks, changed_file, marks_name, file_checksum

   character(len=*), parameter :: blank = ' ', tab = achar(9), carriage = achar(13)
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

   !> What the list of marks is called in a result.
   character(len=*), parameter :: marks_name = 'file_marks'
   !> Longest file, bytes.
   integer, parameter :: longest_file = 100000000
   !> Bytes of a file that are read at once.
   integer, parameter :: bytes_at_once = 8192
   !> Least time between two rows, s.
   real(wp), parameter :: shortest_time = 1e-9_wp

   !> A column, and what is allowed of its numbers, in this unit.
   type :: column_type
      character(len=12) :: name
      real(wp) :: low, high
      character(len=5) :: unit
      !> Whether a file may have it or not.
      logical :: optional = .false.
   end type column_type

   type(column_type), parameter :: of_pivots(2) = [column_type('deflection', 0.0_wp, 0.1_wp, 'm'), &
      & column_type('force', 0.0_wp, 1e12_wp, 'N')]
   type(column_type), parameter :: of_excitations(3) = [column_type('time', 0.0_wp, 1e6_wp, 's'), &
      & column_type('force_y', -1e12_wp, 1e12_wp, 'N'), column_type('force_z', -1e12_wp, 1e12_wp, 'N')]

   character(len=2), parameter :: cross(4) = ['yy', 'yz', 'zy', 'zz']
   integer :: i
   type(column_type), parameter :: of_elements(14) = [column_type('speed_rpm', 0.0_wp, 1e6_wp, 'rpm'), &
      & column_type('frequency_hz', 0.0_wp, 1e7_wp, 'Hz', .true.), &
      & (column_type('k_'//cross(i), -1e15_wp, 1e15_wp, 'N/m'), i=1, 4), &
      & (column_type('c_'//cross(i), -1e12_wp, 1e12_wp, 'N s/m'), i=1, 4), &
      & (column_type('m_'//cross(i), -1e9_wp, 1e9_wp, 'kg', .true.), i=1, 4)]

contains

   !> The text of a file. `what` it should be, "case", and hints for a folder and for a result in its place are for
   !> messages.
   subroutine read_input(file, what, longest, folder_hint, result_hint, text, error)
      character(len=*), intent(in) :: file, what, folder_hint, result_hint
      !> Most bytes.
      integer, intent(in) :: longest
      character(len=:), allocatable, intent(out) :: text
      type(error_type), allocatable, intent(out) :: error
      !> The first bytes of an HDF5 file.
      character(len=*), parameter :: signature = char(137)//'HDF'
      character(len=len(signature)) :: first
      character(len=200) :: message
      logical :: exists
      integer :: unit, status
      integer(i8) :: length
      ! Fortran leaves blanks at the end of a name away
      call require(len_trim(file) == len(file), file//': the name of a '//what//' must not end in a blank', error)
      inquire (file=file, exist=exists)
      call require(exists, file//': no such file', error)
      call require(logical(is_regular(file)), file//': a directory, device or pipe, where a '//what//' belongs' &
         & //folder_hint, error)
      if (allocated(error)) return
      open (newunit=unit, file=file, access='stream', form='unformatted', action='read', status='old', &
         & iostat=status, iomsg=message)
      if (status == 0) then
         inquire (unit=unit, size=length)
         if (length < 0) message = 'the system does not tell its size'
         if (length < 0) status = -1
         first = ''
         if (length >= len(first)) read (unit, pos=1, iostat=status, iomsg=message) first
         call require(first /= signature, file//': a result or study (an HDF5 file), where a '//what//' belongs' &
            & //result_hint, error)
         call require(length <= longest, file//': '//to_text(length)//' bytes; a '//what//' has at most ' &
            & //to_text(longest), error)
         if (status == 0 .and. .not. allocated(error)) then
            allocate (character(len=length) :: text)
            if (length > 0) read (unit, pos=1, iostat=status, iomsg=message) text
         end if
         close (unit)
      end if
      if (status /= 0) call raise(error, system_error, file//': cannot be read: '//trim(message))
   end subroutine read_input

   !> Refuses text with a control character.
   pure subroutine require_text(text, file, error)
      character(len=*), intent(in) :: text, file
      type(error_type), allocatable, intent(inout) :: error
      integer :: at
      at = control_character(text)
      if (at > 0) call refuse(file//': not a text file (byte '//to_text(at)//' is a control character)', error)
   end subroutine require_text

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

   ! Tables.

   !> Reads a file of this number of bytes at most; blank lines at its end are none.
   subroutine read_csv(file, longest, table, error)
      character(len=*), intent(in) :: file
      integer, intent(in) :: longest
      class(csv_table_type), intent(inout) :: table
      type(error_type), allocatable, intent(out) :: error
      integer :: start, finish, length, i
      call read_input(file, 'table', longest, '', '', table%text, error)
      if (.not. allocated(error)) call require_text(table%text, file, error)
      if (allocated(error)) return
      table%file = file
      associate (text => table%text)
         start = 1
         ! a UTF-8 byte order mark
         if (index(text(:min(3, len(text))), char(239)//char(187)//char(191)) == 1) start = 4
         finish = verify(text, blanks, back=.true.)
         table%rows = -1
         do i = start, finish
            if (text(i:i) == newline .or. i == finish) table%rows = table%rows + 1
         end do
         allocate (table%first(0:table%rows), table%last(0:table%rows))
         do i = 0, table%rows
            length = index(text(start:finish), newline) - 1
            if (length < 0) length = finish - start + 1
            table%first(i) = start
            table%last(i) = start - 1 + verify(text(start:start + length - 1), carriage, back=.true.)
            start = start + length + 1
         end do
      end associate
   end subroutine read_csv

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
      at = stop_at(line, at, verify(line(at:), blank//tab))
      cell%first = at
      cell%quoted = line(at:min(at, len(line))) == '"'
      if (cell%quoted) then
         cell%first = at + 1
         call find_quote(line, at)
         cell%last = at - 1
         if (at > len(line)) cell%fault = 'the quote is not closed on its line'
         at = stop_at(line, at + 1, verify(line(at + 1:), blank//tab))
         if (verify(line(at:min(at, len(line))), ',') > 0) cell%fault = 'text behind the closing quote'
      end if
      at = stop_at(line, at, index(line(at:), ','))
      if (.not. cell%quoted) cell%last = cell%first - 1 + verify(line(cell%first:at - 1), blank//tab, back=.true.)
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

   !> The place that was found in a line from `start` on; behind the line where nothing was.
   pure integer function stop_at(line, start, found) result(at)
      character(len=*), intent(in) :: line
      integer, intent(in) :: start, found
      at = merge(start + found - 1, len(line) + 1, found > 0)
   end function stop_at

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

   ! Columns of numbers.

   !> Reads the tables of a case's excitations and pivots that it has not read.
   subroutine read_tables(inputs, error)
      type(case_type), intent(inout) :: inputs
      type(error_type), allocatable, intent(out) :: error
      integer :: b
      call read_excitations()
      if (.not. allocated(error)) call read_elements()
      do b = 1, size(inputs%bearings)
         if (allocated(error)) return
         associate (own => inputs%bearings(b))
            call read_pivots('pivot'//own%suffix()//'%file', own%pivot)
         end associate
      end do
   contains
      !> The measured laws of the pivots of a bearing, whose files a variable names.
      subroutine read_pivots(variable, pivot)
         character(len=*), intent(in) :: variable
         type(pivot_type), intent(inout) :: pivot
         integer :: i, k
         if (pivot%law /= 'table' .or. allocated(pivot%measured)) return
         allocate (pivot%measured(size(pivot%socket_radius)))
         do i = 1, size(pivot%measured)
            do k = 1, i - 1
               if (pivot%file_of(k) == pivot%file_of(i)) exit
            end do
            if (k < i) then
               pivot%measured(i) = pivot%measured(k)
            else
               call read_pivot(pivot%file_of(i), pivot%measured(i)%points)
            end if
            if (allocated(error)) exit
         end do
         call add_context(error, variable)
      end subroutine read_pivots

      !> The measured law of a file: deflection and force rise from row to row. A first row of zeros says nothing.
      subroutine read_pivot(file, points)
         character(len=*), intent(in) :: file
         real(wp), allocatable, intent(out) :: points(:, :)
         real(wp), allocatable :: numbers(:, :)
         real(wp) :: before(2)
         integer :: i, k, first
         call read_columns(file, of_pivots, numbers, error)
         if (allocated(error)) return
         first = merge(2, 1, all(abs(numbers(:, 1)) <= 0))
         before = 0
         do k = first, size(numbers, 2)
            do i = 1, 2
               if (.not. numbers(i, k) > before(i)) call refuse(file//filled(' line {i}: '//trim(of_pivots(i)%name) &
                  & //' = {}: must be above {}'//trim(merge(repeat(' ', 25), ', that of the line before', &
                  & k == first)), [real(wp) :: k + 1, numbers(i, k), before(i)]), error)
            end do
            before = numbers(:, k)
         end do
         points = numbers(:, first:)
         if (size(points, 2) < 2) call refuse(file//': has one point of force over deflection; it needs two or more ' &
            & //'above 0', error)
      end subroutine read_pivot

      !> Reads the coefficients of elements over the speed, and over the frequency: every speed has the same ones.
      subroutine read_elements()
         integer :: i
         if (inputs%rotor%is_rigid()) return
         associate (elements => inputs%rotor%elastic%elements, linear => inputs%rotor%elastic%linear)
            do i = 1, size(elements)
               if (.not. allocated(error)) call read_element('element('//to_text(i)//')', elements(i))
            end do
            do i = 1, size(linear)
               if (.not. allocated(error)) call read_element('bearing'//linear(i)%suffix(), linear(i)%of)
            end do
         end associate
         if (.not. allocated(error)) call check_element_tables(inputs, error)
      end subroutine read_elements

      subroutine read_element(name, e)
         character(len=*), intent(in) :: name
         type(station_element_type), intent(inout) :: e
         real(wp), allocatable :: numbers(:, :)
         logical :: given(size(of_elements))
         integer :: n
         if (e%file == '' .or. allocated(e%table)) return
         call read_columns(e%file, of_elements, numbers, error, given)
         if (.not. allocated(error) .and. any(given(11:) .neqv. given(11))) call refuse(e%file//' line 1: must ' &
            & //'have all of m_yy, m_yz, m_zy, m_zz or none', error)
         if (.not. allocated(error)) then
            n = 1
            if (given(2)) n = count(numbers(1, :) <= numbers(1, 1))
            call check_grid(e%file, numbers(:2, :), n)
         end if
         call add_context(error, name//'%file')
         if (allocated(error)) return
         e%speeds = numbers(1, ::n)*rpm
         allocate (e%whirls(0))
         if (given(2)) e%whirls = numbers(2, :n)*2*pi
         e%table = reshape(numbers(3:, :), [12, n, size(e%speeds)])
      end subroutine read_element

      !> Speeds and frequencies, (2, row), rise, and the n frequencies of the first speed are those of every other.
      subroutine check_grid(file, rows, n)
         character(len=*), intent(in) :: file
         real(wp), intent(in) :: rows(:, :)
         integer, intent(in) :: n
         character(len=:), allocatable :: place
         logical :: fits
         integer :: k
         do k = 2, size(rows, 2)
            if (mod(k - 1, n) > 0) then
               fits = abs(rows(1, k) - rows(1, k - 1)) <= 0 .and. rows(2, k) > rows(2, k - 1)
            else
               fits = rows(1, k) > rows(1, k - 1)
            end if
            if (k > n) fits = fits .and. abs(rows(2, k) - rows(2, k - n)) <= 0
            if (k == size(rows, 2)) fits = fits .and. mod(k, n) == 0
            if (fits) cycle
            place = file//filled(' line {i}: speed_rpm = {}', [real(wp) :: k + 1, rows(1, k)])
            if (n > 1) place = place//filled(', frequency_hz = {}', [rows(2, k)])
            call refuse(place//': speeds must rise from row to row, and each must have the frequencies of the first, ' &
               & //'rising', error)
            return
         end do
      end subroutine check_grid

      !> Reads the tables of a case's excitations.
      subroutine read_excitations()
         real(wp), allocatable :: numbers(:, :)
         integer :: i, k
         do i = 1, size(inputs%excitations)
            associate (x => inputs%excitations(i))
               if (x%kind /= 'table' .or. allocated(x%table)) cycle
               call read_columns(x%file, of_excitations, numbers, error)
               if (.not. allocated(error)) then
                  x%time = numbers(1, :)
                  x%table = numbers(2:, :)
                  k = findloc(x%time(2:) - x%time(:size(x%time) - 1) >= shortest_time, .false., dim=1) + 1
                  if (k > 1) call refuse(x%file//filled(' line {i}: time = {}: must be {} s or more above that of ' &
                     & //'the line before, {}', [real(wp) :: k + 1, x%time(k), shortest_time, x%time(k - 1)]), error)
               end if
               call add_context(error, 'excitation('//to_text(i)//')%file')
               if (allocated(error)) return
            end associate
         end do
      end subroutine read_excitations
   end subroutine read_tables

   !> Numbers of a file, (column, row), two rows at least. Its columns must be these in this order, but for those that
   !> may be left out, whose numbers are 0.
   subroutine read_columns(file, columns, numbers, error, given)
      character(len=*), intent(in) :: file
      type(column_type), intent(in) :: columns(:)
      real(wp), allocatable, intent(out) :: numbers(:, :)
      type(error_type), allocatable, intent(out) :: error
      !> Which columns there are.
      logical, intent(out), optional :: given(:)
      type(csv_table_type) :: table
      logical :: there(size(columns))
      integer :: k
      call read_csv(file, longest_file, table, error)
      if (allocated(error)) return
      allocate (numbers(size(columns), max(0, table%rows)), source=0.0_wp)
      there = .true.
      if (table%rows >= 0) call check_names(table%row(0))
      do k = 1, table%rows
         if (allocated(error)) return
         call read_row(table%row(k), table%origin(k), numbers(:, k))
      end do
      if (table%rows < 2) call refuse(file//': has '//to_text(max(0, table%rows))//' rows of numbers; it needs a ' &
         & //'line of names, '//listed(columns%name)//', and two rows or more', error)
   contains
      !> The first line names the columns.
      subroutine check_names(line)
         character(len=*), intent(in) :: line
         type(cell_type) :: cell
         integer :: at, i
         logical :: fit
         integer :: before
         at = 1
         fit = .true.
         do i = 1, size(columns)
            before = at
            call next_cell(line, at, cell)
            there(i) = lower_case(content(line, cell)) == trim(columns(i)%name)
            fit = fit .and. (there(i) .or. columns(i)%optional)
            if (.not. there(i)) at = before
         end do
         if (present(given)) given = there
         call require(fit .and. at > len(line) + 1, file//' line 1: '//shortened(line)//': must name the columns, ' &
            & //listed(columns%name), error)
      end subroutine check_names

      !> A number for each column.
      subroutine read_row(line, origin, numbers)
         character(len=*), intent(in) :: line, origin
         real(wp), intent(out) :: numbers(:)
         type(cell_type) :: cell
         character(len=:), allocatable :: text
         integer :: at, i
         logical :: ok
         at = 1
         do i = 1, size(columns)
            if (.not. there(i)) cycle
            call next_cell(line, at, cell)
            text = content(line, cell)
            associate (c => columns(i), x => numbers(i))
               call read_number(lower_case(text), x, ok)
               if (ok) ok = ieee_is_finite(x)
               if (.not. ok) then
                  call refuse(origin//': '//trim(c%name)//' = '//shortened(text)//': must be a finite number; commas ' &
                     & //'separate the columns, and decimals have a point', error)
               else if (.not. in_range(x, [c%low, c%high])) then
                  call refuse(origin//': '//trim(c%name)//filled(' = {}: must be {} to {} ', [x, c%low, c%high]) &
                     & //trim(c%unit)//in_other_units(x, trim(c%name), trim(c%unit), c%low, c%high), error)
               end if
            end associate
         end do
         call require(at > len(line) + 1, origin//': has more than '//to_text(count(there))//' numbers; the columns ' &
            & //'are '//listed(pack(columns%name, there)), error)
      end subroutine read_row
   end subroutine read_columns

   !> "time, force_y, force_z"
   pure function listed(names) result(text)
      character(len=*), intent(in) :: names(:)
      character(len=:), allocatable :: text
      integer :: i
      text = trim(names(1))
      do i = 2, size(names)
         text = text//', '//trim(names(i))
      end do
   end function listed

   ! Checksums.

   !> A line for each file that was read: the variable that names it, and the checksum of its numbers. Empty where none
   !> was.
   pure function file_marks(inputs) result(lines)
      type(case_type), intent(in) :: inputs
      character(len=:), allocatable :: lines
      type(station_element_type), allocatable :: elements(:)
      integer :: i
      lines = ''
      do i = 1, size(inputs%bearings)
         associate (own => inputs%bearings(i))
            if (allocated(own%pivot%measured)) lines = lines//'pivot'//own%suffix()//'%file ' &
               & //mark(numbers_of(own%pivot))//newline
         end associate
      end do
      if (.not. inputs%rotor%is_rigid()) then
         elements = inputs%station_elements()
         do i = 1, size(elements)
            associate (e => elements(i))
               if (allocated(e%table)) lines = lines//e%label//'%file '//mark([e%speeds, e%whirls, e%table])//newline
            end associate
         end do
         if (allocated(inputs%rotor%elastic%given)) then
            associate (g => inputs%rotor%elastic%given)
               lines = lines//'rotor%file '//mark([g%slope, g%station, g%stiffness, g%gyroscopic, g%damping, g%mass, &
                  & g%total_mass, g%weighed])//newline
            end associate
         end if
      end if
      if (.not. allocated(inputs%excitations)) return
      do i = 1, size(inputs%excitations)
         associate (x => inputs%excitations(i))
            if (.not. allocated(x%table)) cycle
            lines = lines//'excitation('//to_text(i)//')%file '//mark([x%table, x%time])//newline
         end associate
      end do
   end function file_marks

   !> The numbers of the files of pivots, of each pad where they differ.
   pure function numbers_of(pivot) result(numbers)
      type(pivot_type), intent(in) :: pivot
      real(wp), allocatable :: numbers(:)
      integer :: i
      numbers = [pivot%measured(1)%points]
      do i = 2, merge(size(pivot%measured), 1, index(pivot%file, newline) > 0)
         numbers = [numbers, pivot%measured(i)%points]
      end do
   end function numbers_of

   !> Checksum of numbers, to the last bit.
   pure function mark(numbers) result(text)
      real(wp), intent(in) :: numbers(:)
      character(len=:), allocatable :: text
      integer(i8) :: total
      integer :: i
      total = 0
      do i = 1, size(numbers)
         total = checksum(transfer(numbers(i), repeat(' ', storage_size(numbers)/8)), total)
      end do
      text = to_text(total)
   end function mark

   !> Checksum of the bytes of a file; 0 where it cannot be read.
   integer(i8) function file_checksum(file) result(total)
      character(len=*), intent(in) :: file
      character(len=bytes_at_once) :: bytes
      integer(i8) :: length, at
      integer :: unit, status
      total = 0
      if (.not. is_regular(file)) return
      open (newunit=unit, file=file, access='stream', form='unformatted', action='read', status='old', iostat=status)
      if (status /= 0) return
      inquire (unit=unit, size=length)
      do at = 1, length, bytes_at_once
         associate (n => int(min(length - at + 1, int(bytes_at_once, i8))))
            read (unit, pos=at, iostat=status) bytes(:n)
            if (status /= 0) exit
            total = checksum(bytes(:n), total)
         end associate
      end do
      close (unit)
      if (status /= 0) total = 0
   end function file_checksum

   !> The variable that names a file whose numbers are others than they were, by both lists of marks; empty where there
   !> is none. What either list lacks was not read.
   pure function changed_file(marks, before) result(variable)
      character(len=*), intent(in) :: marks, before
      character(len=:), allocatable :: variable
      integer :: first, last
      first = 1
      do while (first <= len(marks))
         last = first + index(marks(first:), newline) - 1
         associate (own => marks(first:last))
            variable = own(:index(own, ' '))
            if (index(newline//before, newline//variable) > 0 .and. index(newline//before, newline//own) == 0) then
               variable = trim(variable)
               return
            end if
         end associate
         first = last + 1
      end do
      variable = ''
   end function changed_file
end module read_files
