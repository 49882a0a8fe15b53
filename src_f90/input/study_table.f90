!> A table of the values of a study: a CSV file whose first line names variables; every other line has a value of each.
module study_table
   use text, only: to_text, lower_case, shortened
   use errors, only: error_type, raise, require, input_error
   use case_inputs, only: case_type
   use variable_table, only: variable_table_type
   use case_fields, only: list_all_variables
   use variable_names, only: meant_variable, meant_group, group_names
   use assignments, only: assignment_type, token_type, target_text, split_subscript, kind_of, is_spelled
   use input_file, only: tab
   use csv_table, only: csv_table_type, read_csv, cell_type, next_cell, content, blanks
   implicit none (type, external)
   private
   public :: study_table_type, read_table, table_from_text

   !> Longest file, bytes: forty columns of a million rows.
   integer, parameter :: longest_file = 1000000000
   integer, parameter :: most_columns = 1000

   type, extends(csv_table_type) :: study_table_type
      !> The variables of the columns, without values.
      type(assignment_type), allocatable :: columns(:)
      !> Whether they take texts.
      logical, allocatable, private :: is_text(:)
   contains
      procedure :: value
   end type study_table_type

contains

   !> Reads a file.
   subroutine read_table(file, table, error)
      character(len=*), intent(in) :: file
      type(study_table_type), intent(out) :: table
      type(error_type), allocatable, intent(out) :: error
      call read_csv(file, longest_file, table, error)
      if (.not. allocated(error)) call check_table(table, error)
   end subroutine read_table

   !> The same from text, which becomes the table's; `file` is for messages.
   subroutine table_from_text(text, file, table, error)
      character(len=:), allocatable, intent(inout) :: text
      character(len=*), intent(in) :: file
      type(study_table_type), intent(out) :: table
      type(error_type), allocatable, intent(out) :: error
      call table%take(text, file, error)
      if (.not. allocated(error)) call check_table(table, error)
   end subroutine table_from_text

   !> Reads the names, and checks the rows.
   subroutine check_table(table, error)
      type(study_table_type), intent(inout) :: table
      type(error_type), allocatable, intent(inout) :: error
      integer :: k
      call require(table%rows >= 0, table%file//': is empty; its first line must name variables, group%name', error)
      if (.not. allocated(error)) call read_names(table%row(0), table, error)
      do k = 1, table%rows
         if (allocated(error)) return
         call check_row(table%row(k), k, table, error)
      end do
      call require(table%rows > 0, table%file//': has no rows of values below its first line', error)
   end subroutine check_table

   !> The value of a row in a column. What is no number is a text, which is refused where a number belongs.
   subroutine value(self, row, column, token)
      class(study_table_type), intent(in) :: self
      integer, intent(in) :: row, column
      type(token_type), intent(out) :: token
      character(len=:), allocatable :: line
      type(cell_type) :: cell
      integer :: at, i
      line = self%row(row)
      at = 1
      do i = 1, column
         call next_cell(line, at, cell)
      end do
      token%text = content(line, cell)
      token%quoted = self%is_text(column) .or. verify(token%text, '0123456789.-eE+dD') > 0
   end subroutine value

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
