!> A table of the values of a study: a CSV file whose first line names variables; every other line has a value of each.
!> The text stays as it is, and a value is looked up where it stands, so that a million rows take little more memory
!> than their file.
module study_table
   use text, only: to_text, lower_case, shortened
   use errors, only: error_type, raise, input_error
   use case_inputs, only: case_type
   use variable_table, only: variable_table_type
   use case_fields, only: list_all_variables
   use variable_names, only: meant_variable, meant_group, group_names
   use assignments, only: assignment_type, token_type, target_text, split_subscript
   use machine_names, only: kind_of, is_spelled
   use text_scanner, only: control_character
   use csv_line, only: cell_type, next_cell, content
   use input_file, only: read_input
   implicit none (type, external)
   private
   public :: study_table_type, read_table, table_from_text

   !> Longest file, bytes: forty columns of a million rows.
   integer, parameter :: longest_file = 1000000000
   integer, parameter :: most_columns = 1000
   character(len=*), parameter :: newline = achar(10), tab = achar(9), carriage = achar(13)
   character(len=*), parameter :: blanks = ' '//tab//carriage//newline

   type :: study_table_type
      character(len=:), allocatable :: file
      !> The variables of the columns, without values.
      type(assignment_type), allocatable :: columns(:)
      integer :: rows = 0
      !> Whether they take texts.
      logical, allocatable, private :: is_text(:)
      character(len=:), allocatable, private :: text
      !> First and last character of each line.
      integer, allocatable, private :: first(:), last(:)
   contains
      procedure :: value
      procedure :: origin
   end type study_table_type

contains

   !> Reads a file.
   subroutine read_table(file, table, error)
      character(len=*), intent(in) :: file
      type(study_table_type), intent(out) :: table
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: text
      call read_input(file, 'table', longest_file, '', '', text, error)
      if (.not. allocated(error)) call table_from_text(text, file, table, error)
   end subroutine read_table

   !> The same from text, which becomes the table's; `file` is for messages.
   subroutine table_from_text(text, file, table, error)
      character(len=:), allocatable, intent(inout) :: text
      character(len=*), intent(in) :: file
      type(study_table_type), intent(out) :: table
      type(error_type), allocatable, intent(out) :: error
      integer :: at
      at = control_character(text)
      if (at > 0) then
         call raise(error, input_error, file//': not a text file (byte '//to_text(at)//' is a control character)')
         return
      end if
      call move_alloc(text, table%text)
      table%file = file
      call find_lines(table)
      if (size(table%first) == 0) then
         call raise(error, input_error, file//': is empty; its first line must name variables, group%name')
         return
      end if
      call read_names(table%text(table%first(1):table%last(1)), table, error)
      do at = 1, table%rows
         if (allocated(error)) return
         call check_row(table%text(table%first(at + 1):table%last(at + 1)), at, table, error)
      end do
      if (.not. allocated(error) .and. table%rows == 0) call raise(error, input_error, file//': has no rows of ' &
         & //'values below its first line')
   end subroutine table_from_text

   !> Finds the lines; blank ones at the end are none.
   subroutine find_lines(table)
      type(study_table_type), intent(inout) :: table
      integer :: start, finish, lines, i
      associate (text => table%text)
         start = 1
         ! a UTF-8 byte order mark
         if (index(text(:min(3, len(text))), char(239)//char(187)//char(191)) == 1) start = 4
         finish = verify(text, blanks, back=.true.)
         lines = 0
         do i = start, finish
            if (text(i:i) == newline) lines = lines + 1
         end do
         if (finish >= start) lines = lines + 1
         allocate (table%first(lines), table%last(lines))
         table%rows = max(0, lines - 1)
         lines = 0
         do i = start, finish
            if (text(i:i) /= newline .and. i < finish) cycle
            lines = lines + 1
            table%first(lines) = start
            table%last(lines) = merge(i - 1, i, text(i:i) == newline)
            if (i > start) then
               if (text(i:i) == newline .and. text(i - 1:i - 1) == carriage) table%last(lines) = i - 2
            end if
            start = i + 1
         end do
      end associate
   end subroutine find_lines

   !> Where a row stands, for messages: "members.csv line 5".
   function origin(self, row)
      class(study_table_type), intent(in) :: self
      integer, intent(in) :: row
      character(len=:), allocatable :: origin
      origin = self%file//' line '//to_text(row + 1)
   end function origin

   !> The value of a row in a column. What is no number is a text, which is refused where a number belongs.
   subroutine value(self, row, column, token)
      class(study_table_type), intent(in) :: self
      integer, intent(in) :: row, column
      type(token_type), intent(out) :: token
      call find_value(self%text(self%first(row + 1):self%last(row + 1)), column, token%text)
      token%quoted = self%is_text(column) .or. verify(token%text, '0123456789.-eE+dD') > 0
   end subroutine value

   subroutine find_value(line, column, value)
      character(len=*), intent(in) :: line
      integer, intent(in) :: column
      character(len=:), allocatable, intent(out) :: value
      type(cell_type) :: cell
      integer :: at, i
      at = 1
      do i = 1, column
         call next_cell(line, at, cell)
      end do
      value = content(line, cell)
   end subroutine find_value

   !> Refuses a row that has not one value for each column.
   subroutine check_row(line, row, table, error)
      character(len=*), intent(in) :: line
      integer, intent(in) :: row
      type(study_table_type), intent(in) :: table
      type(error_type), allocatable, intent(out) :: error
      type(cell_type) :: cell
      character(len=:), allocatable :: names
      integer :: at, cells
      if (verify(line, blanks) == 0) then
         call raise(error, input_error, table%origin(row)//': is empty, with others below it')
         return
      end if
      at = 1
      cells = 0
      do while (at <= len(line) + 1)
         call next_cell(line, at, cell)
         cells = cells + 1
         if (cells > size(table%columns)) cycle
         if (.not. allocated(cell%fault) .and. cell%last < cell%first) cell%fault = 'a value is missing'
         if (.not. allocated(cell%fault)) cycle
         call raise(error, input_error, table%origin(row)//': '//target_text(table%columns(cells))//': '//cell%fault)
         return
      end do
      names = to_text(size(table%columns))//' columns'
      if (cells < size(table%columns)) then
         call raise(error, input_error, table%origin(row)//': has '//to_text(cells)//' values for '//names//'; ' &
            & //target_text(table%columns(cells + 1))//' has none')
      else if (cells > size(table%columns)) then
         call raise(error, input_error, table%origin(row)//': has '//to_text(cells)//' values for '//names &
            & //'; a comma ends a value, and decimals have a point')
      end if
   end subroutine check_row

   !> Reads the first line.
   subroutine read_names(line, table, error)
      character(len=*), intent(in) :: line
      type(study_table_type), intent(inout) :: table
      type(error_type), allocatable, intent(out) :: error
      type(variable_table_type) :: known
      type(assignment_type) :: new
      type(cell_type) :: cell
      integer :: at, variable
      call list_all_variables(case_type(), known)
      allocate (table%columns(0), table%is_text(0))
      at = 1
      do while (at <= len(line) + 1)
         call next_cell(line, at, cell)
         new%origin = table%file//' line 1, column '//to_text(size(table%columns) + 1)
         if (size(table%columns) == most_columns) cell%fault = 'more than '//to_text(most_columns)//' columns'
         if (.not. allocated(cell%fault)) call read_name(lower_case(content(line, cell)), known, new, variable, &
            & cell%fault)
         if (allocated(cell%fault)) then
            call raise(error, input_error, new%origin//': '//cell%fault)
            return
         end if
         table%columns = [table%columns, new]
         table%is_text = [table%is_text, known%variables(variable)%is_text]
      end do
   end subroutine read_names

   !> The variable, "group%name" or "group%name(element)", and its place among the known ones.
   subroutine read_name(name, known, new, variable, fault)
      character(len=*), intent(in) :: name
      type(variable_table_type), intent(in) :: known
      type(assignment_type), intent(inout) :: new
      integer, intent(out) :: variable
      character(len=:), allocatable, intent(inout) :: fault
      integer :: percent, i
      logical :: ok
      variable = 0
      percent = index(name, '%')
      call split_subscript(name(percent + 1:), new%name, new%subscript, ok)
      new%group = name(:max(0, percent - 1))
      if (scan(name, ';'//tab) > 0) then
         fault = 'commas must separate the columns, not semicolons or tabs; decimals have a point'
      else if (.not. ok .or. new%group == '' .or. new%name == '' .or. index(name, ' ') > 0) then
         fault = ''''//shortened(name)//''': expected a variable, group%name or group%name(element)' &
            & //meant_variable('', new%name)
      else if (all([(known%variables(i)%group /= kind_of(new%group), i=1, known%count)]) &
         & .or. .not. is_spelled(new%group)) then
         fault = 'unknown group '//shortened(new%group)//meant_group(kind_of(new%group))//'; known:'//group_names()
      else
         variable = known%find(kind_of(new%group), new%name)
         if (variable == 0) fault = 'unknown variable '//shortened(name)//meant_variable(kind_of(new%group), new%name)
      end if
   end subroutine read_name
end module study_table
