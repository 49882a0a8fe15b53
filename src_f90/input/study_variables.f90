!> The group &sweep: which variables are varied, and their values in each run of a study, from lists, ranges and a
!> table.
module study_variables
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp, i8
   use text, only: to_text, exact_text, lower_case, shortened, checksum, newline
   use errors, only: error_type, raise, require, refuse, add_context, input_error
   use assignments, only: namelist_type, assignment_type, token_type, undoes, assignment_text, target_text, &
      & value_text, read_number, study_group
   use study_table, only: study_table_type, read_table
   use case_fields, only: title_variable
   use variable_names, only: meant_variable
   use files, only: real_path
   implicit none (type, external)
   private
   public :: study_variables_type, varied_values_type, read_varied_values

   !> Most runs of a study, and variables that a message lists.
   integer, parameter :: most_runs = 1000000, most_listed = 8

   !> Most values of a range.
   integer, parameter :: most_values = 1000000
   !> Part of a stride by which the last value of a range may miss its end.
   real(wp), parameter :: rounding = 1e-6_wp
   !> Numbers of a range are 0 or between these in size, so that nothing overflows on the way.
   real(wp), parameter :: smallest = 1e-100_wp, largest = 1e100_wp

   !> A single value, or the numbers of a range.
   type :: piece_type
      type(token_type) :: token
      integer :: count = 1
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

   type :: line_type
      character(len=:), allocatable :: text
   end type line_type

   type :: study_variables_type
      private
      !> True where all factors change together.
      logical :: zip = .false.
      type(variable_type), allocatable, public :: variables(:)
      !> How many values each factor has; every list is one, and so is the table.
      integer, allocatable :: counts(:)
      type(study_table_type) :: table
   contains
      procedure, public :: begin
      procedure, public :: read => read_assignment
      procedure, public :: count_runs
      procedure, public :: targets
      procedure, public :: assignment_of_run
      procedure, public :: value
      procedure, public :: number_of_run
      procedure, public :: values_text
      procedure, public :: find_checksums
      procedure, public :: text => group_text
      procedure :: add
      procedure :: line
   end type study_variables_type

contains

   !> Nothing is varied yet.
   subroutine begin(self)
      class(study_variables_type), intent(out) :: self
      allocate (self%variables(0), self%counts(0))
   end subroutine begin

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
         call read_file(self, given, base, error)
      case default
         percent = index(given%name, '%')
         new%target = given
         new%target%group = given%name(:max(0, percent - 1))
         new%target%name = given%name(percent + 1:)
         if (percent <= 1 .or. new%target%name == '' .or. index(new%target%name, '%') > 0) then
            call raise(error, input_error, given%origin//': unknown variable '//given%group//'%'//given%name &
               & //meant_variable('', new%target%name)//'; expected order, file or group%name = values')
            return
         end if
         call read_varied_values(given%values, given%origin//': '//study_group//'%'//given%name, new%values, error)
         if (allocated(error)) return
         deallocate (new%target%values)
         self%counts = [self%counts, new%values%count()]
         call self%add(new, base, '; give the study other values with --set sweep%'//given%name//'=...', error)
      end select
   end subroutine read_assignment

   !> Reads the table: in the folder of the case where the case names it, for --set in the working folder.
   subroutine read_file(self, given, base, error)
      class(study_variables_type), intent(inout) :: self
      type(assignment_type), intent(in) :: given
      type(namelist_type), intent(in) :: base
      type(error_type), allocatable, intent(out) :: error
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
      if (allocated(error)) then
         error%message = given%origin//': '//study_group//'%file: '//error%message
         return
      end if
      self%counts = [self%counts, self%table%rows]
      do i = 1, size(self%table%columns)
         new%target = self%table%columns(i)
         new%column = i
         call self%add(new, base, '', error)
         if (allocated(error)) return
      end do
   end subroutine read_file

   !> Adds a variable of the last factor. `advice` is for who gives it another value by --set.
   subroutine add(self, new, base, advice, error)
      class(study_variables_type), intent(inout) :: self
      type(variable_type), intent(inout) :: new
      type(namelist_type), intent(in) :: base
      character(len=*), intent(in) :: advice
      type(error_type), allocatable, intent(inout) :: error
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

   !> The assignments to the varied variables, without values.
   function targets(self) result(found)
      class(study_variables_type), intent(in) :: self
      type(assignment_type), allocatable :: found(:)
      integer :: i
      allocate (found(size(self%variables)))
      do i = 1, size(found)
         found(i) = self%variables(i)%target
      end do
   end function targets

   !> How many runs there are; `origin` of the study is for messages.
   subroutine count_runs(self, origin, found, error)
      class(study_variables_type), intent(in) :: self
      character(len=*), intent(in) :: origin
      integer, intent(out) :: found
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: list
      integer(i8) :: runs
      integer :: i, first
      found = 1
      if (size(self%variables) == 0) then
         call raise(error, input_error, origin//': &sweep sweeps nothing; expected group%name = values')
         return
      end if
      list = ''
      runs = 1
      do i = 1, size(self%counts)
         if (i > 1 .and. i <= most_listed + 1) list = list//', '
         first = findloc(self%variables%factor, i, dim=1)
         if (i == most_listed + 1) then
            list = list//'...'
         else if (i <= most_listed .and. self%variables(first)%column > 0) then
            list = list//self%table%file//' has '//to_text(self%counts(i))
         else if (i <= most_listed) then
            list = list//self%variables(first)%target%group//'%'//self%variables(first)%target%name//' has ' &
               & //to_text(self%counts(i))
         end if
         runs = merge(int(self%counts(i), i8), min(runs*self%counts(i), 2_i8*most_runs), self%zip)
      end do
      if (self%zip .and. any(self%counts /= runs)) then
         call raise(error, input_error, origin//': &sweep with order = ''zip'' needs as many values of each: '//list)
      else if (runs > most_runs) then
         call raise(error, input_error, origin//': &sweep has more than '//to_text(most_runs)//' runs: '//list)
      end if
      found = int(runs)
   end subroutine count_runs

   !> Which value of its factor the i-th variable has in the k-th run. The first factor changes slowest.
   pure integer function row_of(self, i, k) result(row)
      class(study_variables_type), intent(in) :: self
      integer, intent(in) :: i, k
      integer :: j
      row = k - 1
      if (.not. self%zip) then
         do j = size(self%counts), self%variables(i)%factor + 1, -1
            row = row/self%counts(j)
         end do
         row = mod(row, self%counts(self%variables(i)%factor))
      end if
      row = row + 1
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
         text = text//self%line(i, k)
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
               if (row /= rows(i)) lines(i)%text = self%line(i, k)//newline
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
      end do
   end subroutine read_varied_values

   !> A value, first:last:stride or first:last:*factor.
   subroutine read_piece(token, piece, error)
      type(token_type), intent(in) :: token
      type(piece_type), intent(out) :: piece
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: parts(:), word
      real(wp) :: numbers(3)
      integer :: first, second, i
      logical :: ok
      piece%token = token
      first = index(token%text, ':')
      if (token%quoted .or. first == 0) then
         if (.not. token%quoted .and. index(token%text, '*') > 0) call raise(error, input_error, &
            & 'n*value is not for a study, where each value is a run''s; a range is first:last:*factor')
         return
      end if
      piece%is_range = .true.
      second = first + index(token%text(first + 1:), ':')
      parts = [character(len=len(token%text)) :: token%text(:first - 1), token%text(first + 1:second - 1), &
         & token%text(second + 1:)]
      piece%geometric = parts(3) (1:1) == '*'
      if (piece%geometric) parts(3) = parts(3) (2:)
      do i = 1, 3
         word = lower_case(trim(parts(i)))
         call read_number(word, numbers(i), ok)
         if (.not. ok .or. second == first) then
            call raise(error, input_error, 'a range is first:last:stride or first:last:*factor, of numbers')
            return
         else if (.not. ieee_is_finite(numbers(i)) .or. abs(numbers(i)) > largest &
            & .or. abs(numbers(i)) > 0 .and. abs(numbers(i)) < smallest) then
            call raise(error, input_error, 'numbers of a range must be 1e-100 to 1e100 in size, or 0')
            return
         end if
      end do
      piece%first = numbers(1)
      piece%step = numbers(3)
      call count_steps(numbers(2), piece, error)
   end subroutine read_piece

   !> How many values a range has whose first value, and stride or factor, are known.
   subroutine count_steps(last, piece, error)
      real(wp), intent(in) :: last
      type(piece_type), intent(inout) :: piece
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: steps
      if (piece%geometric) then
         if (.not. piece%first*sign(1.0_wp, last) > 0 .or. .not. abs(last) > 0) then
            call raise(error, input_error, 'first and last must be of one sign, and not 0, for a factor')
         else if (piece%step <= 0 .or. .not. abs(piece%step - 1) > 0) then
            call raise(error, input_error, 'the factor must be > 0, and not 1')
         else if ((abs(last) - abs(piece%first))*(piece%step - 1) < 0) then
            call raise(error, input_error, 'from first the factor leads away from last; it must be ' &
               & //trim(merge('> 1', '< 1', piece%step < 1)))
         else
            steps = log(last/piece%first)/log(piece%step)
         end if
      else if (.not. abs(piece%step) > 0) then
         call raise(error, input_error, 'the stride must not be 0')
      else if ((last - piece%first)*piece%step < 0) then
         call raise(error, input_error, 'from first the stride leads away from last; it must be ' &
            & //trim(merge('> 0', '< 0', piece%step < 0)))
      else
         steps = (last - piece%first)/piece%step
      end if
      if (allocated(error)) return
      if (steps >= most_values) then
         call raise(error, input_error, 'more than '//to_text(most_values)//' values')
      else
         piece%count = 1 + floor(steps + rounding)
      end if
   end subroutine count_steps

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
      integer :: i, before
      call find_piece(self, n, i, before)
      token = self%pieces(i)%token
      if (.not. self%pieces(i)%is_range) return
      x = number_in_range(self%pieces(i), n - before - 1)
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
      integer :: i, before
      call find_piece(self, n, i, before)
      if (self%pieces(i)%is_range) then
         x = number_in_range(self%pieces(i), n - before - 1)
         ok = .true.
      else
         call read_number(lower_case(self%pieces(i)%token%text), x, ok)
      end if
   end subroutine number_of_list

   !> Which piece has the n-th value, and how many values come before that piece.
   pure subroutine find_piece(self, n, i, before)
      class(varied_values_type), intent(in) :: self
      integer, intent(in) :: n
      integer, intent(out) :: i, before
      before = 0
      do i = 1, size(self%pieces)
         if (n <= before + self%pieces(i)%count) exit
         before = before + self%pieces(i)%count
      end do
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
end module study_variables
