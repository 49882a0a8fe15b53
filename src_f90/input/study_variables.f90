!> The group &sweep: which variables are varied, and their values in each run of a study, from lists, ranges and a
!> table: a CSV file whose first line names variables; every other line has a value of each.
module study_variables
   use kinds, only: wp, i8
   use text, only: to_text, exact_text, lower_case, shortened, checksum, newline, did_you_mean
   use errors, only: error_type, require, refuse, add_context
   use files, only: real_path
   use case_inputs, only: case_type
   use assignments, only: namelist_type, assignment_type, token_type, undoes, assignment_text, target_text, &
      & value_text, read_number, study_group, split_subscript, kind_of, is_spelled
   use variable_table, only: variable_table_type
   use case_fields, only: title_variable, list_all_variables
   use case_parameter, only: meant_variable, group_names
   use read_files, only: csv_table_type, read_csv, cell_type, next_cell, content, blanks, tab
   implicit none (type, external)
   private
   public :: study_variables_type, varied_values_type, read_varied_values, study_table_type, read_table

   !> Most runs of a study, values of a range, and variables that a message lists.
   integer, parameter :: most_runs = 1000000, most_values = 1000000, most_listed = 8
   !> Longest table, bytes: forty columns of a million rows.
   integer, parameter :: longest_file = 1000000000
   integer, parameter :: most_columns = 1000
   !> Part of a stride by which the last value of a range may miss its end.
   real(wp), parameter :: rounding = 1e-6_wp
   !> Numbers of a range are 0 or between these in size, so that nothing overflows on the way.
   real(wp), parameter :: smallest = 1e-100_wp, largest = 1e100_wp

   !> A single value, or the numbers of a range.
   type :: piece_type
      type(token_type) :: token
      !> Values of the pieces before it, and its own.
      integer :: before = 0, count = 1
      logical :: is_range = .false., geometric = .false.
      !> Stride, or factor where the range is geometric.
      real(wp) :: first = 0, step = 0
   end type piece_type

   type :: varied_values_type
      private
      type(piece_type), allocatable :: pieces(:)
   contains
      procedure :: count => count_of_list
      procedure :: value => value_of_list
      procedure :: number => number_of_list
      procedure :: text => text_of_list
   end type varied_values_type

   !> A varied variable: its assignment without values, and where its values come from.
   type :: variable_type
      type(assignment_type) :: target
      !> A list, or the column of the table where that is not 0.
      type(varied_values_type) :: values
      integer :: column = 0
      !> Which of the factors it belongs to: variables of one change together.
      integer :: factor = 0
   end type variable_type

   type, extends(csv_table_type) :: study_table_type
      !> The variables of the columns, without values.
      type(assignment_type), allocatable :: columns(:)
      !> Whether they take texts.
      logical, allocatable, private :: is_text(:)
   contains
      procedure :: value => value_in_table
   end type study_table_type

   type :: line_type
      character(len=:), allocatable :: text
   end type line_type

   type :: study_variables_type
      private
      !> True where all factors change together.
      logical :: zip = .false.
      type(variable_type), allocatable, public :: variables(:)
      !> How many values each factor has; every list is one, and so is the table.
      integer, allocatable, public :: counts(:)
      type(study_table_type) :: table
   contains
      procedure, public :: read => read_assignment
      procedure, public :: count_runs
      procedure, public :: assignment_of_run
      procedure, public :: value
      procedure, public :: number_of_run
      procedure, public :: values_text
      procedure, public :: find_checksums
      procedure, public :: text => group_text
   end type study_variables_type

contains

   !> One assignment of the group. `base` has those of the case; its folder is that of a table.
   subroutine read_assignment(self, given, base, error)
      class(study_variables_type), intent(inout) :: self
      type(assignment_type), intent(in) :: given
      type(namelist_type), intent(in) :: base
      type(error_type), allocatable, intent(out) :: error
      type(variable_type) :: new
      character(len=:), allocatable :: order
      integer :: percent
      select case (given%name)
      case ('order')
         order = lower_case(trim(adjustl(given%values(1)%text)))
         call require(size(given%values) == 1 .and. given%subscript == 0 .and. any(order == ['product', 'zip    ']), &
            & given%origin//': '//assignment_text(given)//': must be one of ''product'', ''zip''', error)
         self%zip = order == 'zip'
      case ('file')
         call read_file()
      case default
         percent = index(given%name, '%')
         new%target = given
         new%target%group = given%name(:max(0, percent - 1))
         new%target%name = given%name(percent + 1:)
         if (percent <= 1 .or. new%target%name == '' .or. index(new%target%name, '%') > 0) call refuse(given%origin &
            & //': unknown variable '//given%group//'%'//given%name//meant_variable('', new%target%name) &
            & //'; expected order, file or group%name = values', error)
         if (.not. allocated(error)) call read_varied_values(given%values, given%origin//': '//study_group//'%' &
            & //given%name, new%values, error)
         if (allocated(error)) return
         deallocate (new%target%values)
         self%counts = [self%counts, new%values%count()]
         call add(new, '; give the study other values with --set sweep%'//given%name//'=...')
      end select
   contains
      !> Reads the table: in the folder of the case where the case names it, for --set in the working folder.
      subroutine read_file()
         type(variable_type) :: new
         character(len=:), allocatable :: path
         integer :: i
         path = given%values(1)%text
         call require(size(given%values) == 1 .and. given%subscript == 0 .and. path /= '' &
            & .and. (given%values(1)%quoted .or. given%overrides), given%origin//': '//assignment_text(given) &
            & //': must be the name of one file, in quotes', error)
         if (allocated(error)) return
         if (.not. given%overrides .and. path(1:1) /= '/') path = base%file(:index(base%file, '/', back=.true.))//path
         call read_table(path, self%table, error)
         call add_context(error, given%origin//': '//study_group//'%file')
         if (allocated(error)) return
         self%counts = [self%counts, self%table%rows]
         do i = 1, size(self%table%columns)
            new%target = self%table%columns(i)
            new%column = i
            call add(new, '')
         end do
      end subroutine read_file

      !> Adds a variable of the last factor. `advice` is for who gives it another value by --set.
      subroutine add(new, advice)
         type(variable_type), intent(inout) :: new
         character(len=*), intent(in) :: advice
         integer :: i
         new%factor = size(self%counts)
         new%target%overrides = .true.
         associate (name => new%target%group//'%'//new%target%name)
            call require(new%target%group /= study_group .and. name /= title_variable, new%target%origin//': '//name &
               & //' cannot be swept', error)
            do i = 1, size(self%variables)
               associate (other => self%variables(i)%target)
                  if (undoes(new%target, other) .or. undoes(other, new%target)) call refuse( &
                     & new%target%origin//': '//name//' is swept twice, first at '//other%origin, error)
               end associate
            end do
         end associate
         do i = 1, size(base%assignments)
            associate (a => base%assignments(i))
               if (a%origin == '--set' .and. undoes(new%target, a)) call refuse('--set '//assignment_text(a) &
                  & //': is swept ('//new%target%origin//')'//advice, error)
            end associate
         end do
         if (.not. allocated(error)) self%variables = [self%variables, new]
      end subroutine add
   end subroutine read_assignment

   !> How many runs there are; `origin` of the study is for messages.
   subroutine count_runs(self, origin, found, error)
      class(study_variables_type), intent(in) :: self
      character(len=*), intent(in) :: origin
      integer, intent(out) :: found
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: list, name
      integer(i8) :: runs
      integer :: i
      call require(size(self%variables) > 0, origin//': &sweep names no variable; expected group%name = values', error)
      list = ''
      runs = 1
      do i = 1, size(self%counts)
         runs = merge(int(self%counts(i), i8), min(runs*self%counts(i), 2_i8*most_runs), self%zip)
         if (i > most_listed) cycle
         associate (first => self%variables(findloc(self%variables%factor, i, dim=1)))
            name = first%target%group//'%'//first%target%name
            if (first%column > 0) name = self%table%file
         end associate
         list = list//', '//name//' has '//to_text(self%counts(i))
      end do
      if (size(self%counts) > most_listed) list = list//', ...'
      call require(.not. self%zip .or. all(self%counts == runs), origin//': &sweep with order = ''zip'' needs as ' &
         & //'many values of each: '//list(3:), error)
      call require(runs <= most_runs, origin//': &sweep has more than '//to_text(most_runs)//' runs: '//list(3:), error)
      found = int(runs)
   end subroutine count_runs

   !> Which value of its factor the i-th variable has in the k-th run. The first factor changes slowest.
   pure integer function row_of(self, i, k) result(row)
      class(study_variables_type), intent(in) :: self
      integer, intent(in) :: i, k
      row = k
      if (self%zip) return
      associate (factor => self%variables(i)%factor)
         row = 1 + mod((k - 1)/product(self%counts(factor + 1:)), self%counts(factor))
      end associate
   end function row_of

   !> The value of the i-th variable in the k-th run.
   subroutine value(self, i, k, token)
      class(study_variables_type), intent(in) :: self
      integer, intent(in) :: i, k
      type(token_type), intent(out) :: token
      associate (v => self%variables(i), row => row_of(self, i, k))
         if (v%column > 0) then
            call self%table%value(row, v%column, token)
         else
            call v%values%value(row, token)
         end if
      end associate
   end subroutine value

   !> The same as a number, to the last bit; `ok` is false where it is none.
   subroutine number_of_run(self, i, k, x, ok)
      class(study_variables_type), intent(in) :: self
      integer, intent(in) :: i, k
      real(wp), intent(out) :: x
      logical, intent(out) :: ok
      type(token_type) :: token
      if (self%variables(i)%column > 0) then
         call self%value(i, k, token)
         call read_number(lower_case(token%text), x, ok)
      else
         call self%variables(i)%values%number(row_of(self, i, k), x, ok)
      end if
   end subroutine number_of_run

   !> The k-th run's assignment to the i-th variable.
   subroutine assignment_of_run(self, i, k, found)
      class(study_variables_type), intent(in) :: self
      integer, intent(in) :: i, k
      type(assignment_type), intent(out) :: found
      found = self%variables(i)%target
      allocate (found%values(1))
      call self%value(i, k, found%values(1))
      if (self%variables(i)%column > 0) found%origin = self%table%origin(row_of(self, i, k))
   end subroutine assignment_of_run

   !> The values of the k-th run, a line for each variable.
   function values_text(self, k) result(text)
      class(study_variables_type), intent(in) :: self
      integer, intent(in) :: k
      character(len=:), allocatable :: text
      integer :: i
      text = ''
      do i = 1, size(self%variables)
         if (i > 1) text = text//newline
         text = text//line(self, i, k)
      end do
   end function values_text

   function line(self, i, k)
      class(study_variables_type), intent(in) :: self
      integer, intent(in) :: i, k
      character(len=:), allocatable :: line
      type(token_type) :: token
      call self%value(i, k, token)
      line = target_text(self%variables(i)%target)//' = '//value_text(token)
   end function line

   !> Checksums of the values of the runs up to each, behind one of something else.
   subroutine find_checksums(self, runs, before, marks)
      class(study_variables_type), intent(in) :: self
      integer, intent(in) :: runs
      integer(i8), intent(in) :: before
      integer(i8), allocatable, intent(out) :: marks(:)
      !> The lines of the last run, and which values they have: most stay from one run to the next.
      type(line_type) :: lines(size(self%variables))
      integer :: rows(size(self%variables)), i, k
      allocate (marks(0:runs))
      rows = 0
      marks(0) = before
      do k = 1, runs
         marks(k) = marks(k - 1)
         do i = 1, size(lines)
            associate (row => row_of(self, i, k))
               if (row /= rows(i)) lines(i)%text = line(self, i, k)//newline
               rows(i) = row
            end associate
            marks(k) = checksum(lines(i)%text, marks(k))
         end do
      end do
   end subroutine find_checksums

   !> The group as namelist text; of a table the name of its file, which holds in any folder.
   function group_text(self) result(text)
      class(study_variables_type), intent(in) :: self
      character(len=:), allocatable :: text
      integer :: i
      text = '&'//study_group//newline//'  order = '''//trim(merge('zip    ', 'product', self%zip))//''''//newline
      do i = 1, size(self%variables)
         associate (v => self%variables(i))
            if (v%column == 1) then
               text = text//'  file = '//value_text(token_type(real_path(self%table%file), .true.))//newline
            else if (v%column == 0) then
               text = text//'  '//target_text(v%target)//' = '//v%values%text()//newline
            end if
         end associate
      end do
      text = text//'/'//newline
   end function group_text

   ! The values of a varied variable: single values, and the numbers of ranges.

   !> The values of an assignment; `name`, what is assigned, is for messages.
   subroutine read_varied_values(tokens, name, values, error)
      type(token_type), intent(in) :: tokens(:)
      character(len=*), intent(in) :: name
      type(varied_values_type), intent(out) :: values
      type(error_type), allocatable, intent(out) :: error
      integer :: i
      allocate (values%pieces(size(tokens)))
      do i = 1, size(tokens)
         call read_piece(tokens(i), values%pieces(i), error)
         call add_context(error, name//' = '//shortened(value_text(tokens(i))))
         if (allocated(error)) return
         if (i > 1) values%pieces(i)%before = values%pieces(i - 1)%before + values%pieces(i - 1)%count
      end do
   end subroutine read_varied_values

   !> A value, first:last:stride or first:last:*factor.
   subroutine read_piece(token, piece, error)
      type(token_type), intent(in) :: token
      type(piece_type), intent(out) :: piece
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: parts(:)
      real(wp) :: numbers(3)
      integer :: first, second, i
      logical :: ok
      piece%token = token
      first = index(token%text, ':')
      if (token%quoted) return
      call require(first > 0 .or. index(token%text, '*') == 0, 'n*value is not for a study, where each value is a ' &
         & //'run''s; a range is first:last:*factor', error)
      if (first == 0) return
      piece%is_range = .true.
      second = first + index(token%text(first + 1:), ':')
      parts = [character(len=len(token%text)) :: token%text(:first - 1), token%text(first + 1:second - 1), &
         & token%text(second + 1:)]
      piece%geometric = parts(3) (1:1) == '*'
      if (piece%geometric) parts(3) = parts(3) (2:)
      do i = 1, 3
         call read_number(lower_case(trim(parts(i))), numbers(i), ok)
         call require(ok .and. second > first, 'a range is first:last:stride or first:last:*factor, of numbers', error)
         call require(abs(numbers(i)) <= largest .and. (abs(numbers(i)) >= smallest .or. abs(numbers(i)) <= 0), &
            & 'numbers of a range must be 1e-100 to 1e100 in size, or 0', error)
      end do
      if (allocated(error)) return
      piece%first = numbers(1)
      piece%step = numbers(3)
      call count_steps(numbers(2))
   contains
      !> How many values a range has whose first value, and stride or factor, are known.
      subroutine count_steps(last)
         real(wp), intent(in) :: last
         real(wp) :: steps
         if (piece%geometric) then
            call require(piece%first*sign(1.0_wp, last) > 0 .and. abs(last) > 0, 'first and last must be of one ' &
               & //'sign, and not 0, for a factor', error)
            call require(piece%step > 0 .and. abs(piece%step - 1) > 0, 'the factor must be > 0, and not 1', error)
            call require((abs(last) - abs(piece%first))*(piece%step - 1) >= 0, 'from first the factor leads away ' &
               & //'from last; it must be '//trim(merge('> 1', '< 1', piece%step < 1)), error)
            if (.not. allocated(error)) steps = log(last/piece%first)/log(piece%step)
         else
            call require(abs(piece%step) > 0, 'the stride must not be 0', error)
            call require((last - piece%first)*piece%step >= 0, 'from first the stride leads away from last; it must ' &
               & //'be '//trim(merge('> 0', '< 0', piece%step < 0)), error)
            if (.not. allocated(error)) steps = (last - piece%first)/piece%step
         end if
         if (allocated(error)) return
         call require(steps < most_values, 'more than '//to_text(most_values)//' values', error)
         if (.not. allocated(error)) piece%count = 1 + floor(steps + rounding)
      end subroutine count_steps
   end subroutine read_piece

   pure integer function count_of_list(self)
      class(varied_values_type), intent(in) :: self
      count_of_list = sum(self%pieces%count)
   end function count_of_list

   !> The n-th value.
   subroutine value_of_list(self, n, token)
      class(varied_values_type), intent(in) :: self
      integer, intent(in) :: n
      type(token_type), intent(out) :: token
      real(wp) :: x
      integer :: i
      call find_piece(self, n, i, x)
      token = self%pieces(i)%token
      if (.not. self%pieces(i)%is_range) return
      token%text = exact_text(x)
      ! whole numbers without an exponent, as variables that take only these want them
      if (.not. abs(x - anint(x)) > 0 .and. abs(x) < 1e15_wp) token%text = to_text(nint(x, i8))
   end subroutine value_of_list

   !> The same as a number, to the last bit; `ok` is false where it is none. A range needs no text for this.
   subroutine number_of_list(self, n, x, ok)
      class(varied_values_type), intent(in) :: self
      integer, intent(in) :: n
      real(wp), intent(out) :: x
      logical, intent(out) :: ok
      integer :: i
      call find_piece(self, n, i, x)
      ok = self%pieces(i)%is_range
      if (.not. ok) call read_number(lower_case(self%pieces(i)%token%text), x, ok)
   end subroutine number_of_list

   !> Which piece has the n-th value, by halving, and its number where that is a range.
   subroutine find_piece(self, n, i, x)
      class(varied_values_type), intent(in) :: self
      integer, intent(in) :: n
      integer, intent(out) :: i
      real(wp), intent(out) :: x
      integer :: beyond, middle
      i = 1
      beyond = size(self%pieces) + 1
      do while (beyond - i > 1)
         middle = (i + beyond)/2
         if (self%pieces(middle)%before < n) then
            i = middle
         else
            beyond = middle
         end if
      end do
      x = 0
      if (self%pieces(i)%is_range) x = number_in_range(self%pieces(i), n - self%pieces(i)%before - 1)
   end subroutine find_piece

   !> The number this many steps from the first of a range.
   real(wp) function number_in_range(piece, steps) result(x)
      type(piece_type), intent(in) :: piece
      integer, intent(in) :: steps
      ! a product rounded by itself, not as part of a fused addition: the same bits on every machine
      real(wp), volatile :: product
      if (piece%geometric) then
         ! a real exponent, as repeated products would round at every step
         x = piece%first*piece%step**real(steps, wp)
      else
         product = steps*piece%step
         x = piece%first + product
      end if
   end function number_in_range

   !> All values as the case has them.
   pure function text_of_list(self) result(text)
      class(varied_values_type), intent(in) :: self
      character(len=:), allocatable :: text
      integer :: i
      text = value_text(self%pieces(1)%token)
      do i = 2, size(self%pieces)
         text = text//', '//value_text(self%pieces(i)%token)
      end do
   end function text_of_list

   ! A table.

   !> Reads a file: the names, and the rows, which are checked.
   subroutine read_table(file, table, error)
      character(len=*), intent(in) :: file
      type(study_table_type), intent(out) :: table
      type(error_type), allocatable, intent(out) :: error
      integer :: k
      call read_csv(file, longest_file, table, error)
      if (allocated(error)) return
      call require(table%rows >= 0, file//': is empty; its first line must name variables, group%name', error)
      if (.not. allocated(error)) call read_names(table%row(0))
      do k = 1, table%rows
         if (allocated(error)) return
         call check_row(table%row(k), k)
      end do
      call require(table%rows > 0, file//': has no rows of values below its first line', error)
   contains
      !> Refuses a row that has not one value for each column.
      subroutine check_row(line, row)
         character(len=*), intent(in) :: line
         integer, intent(in) :: row
         type(cell_type) :: cell
         integer :: at, cells
         if (verify(line, blanks) == 0) call refuse(table%origin(row)//': is empty, with others below it', error)
         at = 1
         cells = 0
         do while (at <= len(line) + 1)
            call next_cell(line, at, cell)
            cells = cells + 1
            if (cells > size(table%columns)) cycle
            if (.not. allocated(cell%fault) .and. cell%last < cell%first) cell%fault = 'a value is missing'
            if (allocated(cell%fault)) call refuse(table%origin(row)//': '//target_text(table%columns(cells))//': ' &
               & //cell%fault, error)
         end do
         associate (columns => size(table%columns))
            if (cells < columns) call refuse(table%origin(row)//': has '//to_text(cells)//' values for ' &
               & //to_text(columns)//' columns; '//target_text(table%columns(cells + 1))//' has none', error)
            if (cells > columns) call refuse(table%origin(row)//': has '//to_text(cells)//' values for ' &
               & //to_text(columns)//' columns; a comma ends a value, and decimals have a point', error)
         end associate
      end subroutine check_row

      !> Reads the first line.
      subroutine read_names(line)
         character(len=*), intent(in) :: line
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
            if (allocated(cell%fault)) call refuse(new%origin//': '//cell%fault, error)
            if (allocated(error)) return
            table%columns = [table%columns, new]
            table%is_text = [table%is_text, known%variables(variable)%is_text]
         end do
      end subroutine read_names
   end subroutine read_table

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
      else if (new%group == study_group) then
         fault = shortened(name)//' cannot be swept; the columns are variables of the case'
      else if (all([(known%variables(i)%group /= kind_of(new%group), i=1, known%count)]) &
         & .or. .not. is_spelled(new%group)) then
         fault = 'unknown group '//shortened(new%group)//did_you_mean(kind_of(new%group), group_names())//'; known:' &
            & //group_names()
      else
         variable = known%find(kind_of(new%group), new%name)
         if (variable == 0) fault = 'unknown variable '//shortened(name)//meant_variable(kind_of(new%group), new%name)
      end if
   end subroutine read_name

   !> The value of a row in a column. What is no number is a text, which is refused where a number belongs.
   subroutine value_in_table(self, row, column, token)
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
   end subroutine value_in_table
end module study_variables
