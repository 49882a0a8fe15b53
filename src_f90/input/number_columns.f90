!> Reads columns of numbers from a CSV file whose first line names them.
module number_columns
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   use text, only: to_text, lower_case, shortened, filled
   use errors, only: error_type, raise, require, refuse, add_context, input_error
   use case_groups, only: pivot_type
   use case_inputs, only: case_type
   use other_units, only: in_other_units
   use csv_table, only: csv_table_type, read_csv, cell_type, next_cell, content
   use assignments, only: read_number
   implicit none (type, external)
   private
   public :: read_tables

   !> Longest file, bytes.
   integer, parameter :: longest_file = 100000000
   !> Least time between two rows, s.
   real(wp), parameter :: shortest_time = 1e-9_wp

   !> A column, and what is allowed of its numbers, in this unit.
   type :: column_type
      character(len=10) :: name
      real(wp) :: low, high
      character(len=1) :: unit
   end type column_type

   type(column_type), parameter :: of_pivots(2) = [column_type('deflection', 0.0_wp, 0.1_wp, 'm'), &
      & column_type('force', 0.0_wp, 1e12_wp, 'N')]
   type(column_type), parameter :: of_excitations(3) = [column_type('time', 0.0_wp, 1e6_wp, 's'), &
      & column_type('force_y', -1e12_wp, 1e12_wp, 'N'), column_type('force_z', -1e12_wp, 1e12_wp, 'N')]

contains

   !> Reads the tables of a case's excitations and pivots.
   subroutine read_tables(inputs, error)
      type(case_type), intent(inout) :: inputs
      type(error_type), allocatable, intent(out) :: error
      integer :: b
      call read_excitations(inputs, error)
      do b = 1, size(inputs%bearings)
         if (allocated(error)) return
         associate (own => inputs%bearings(b))
            call read_pivots('pivot'//own%suffix()//'%file', own%pivot, error)
         end associate
      end do
   end subroutine read_tables

   !> The measured law of the pivots of a bearing, whose file a variable names: deflection and force rise from row to
   !> row. A first row of zeros says nothing.
   subroutine read_pivots(variable, pivot, error)
      character(len=*), intent(in) :: variable
      type(pivot_type), intent(inout) :: pivot
      type(error_type), allocatable, intent(inout) :: error
      real(wp), allocatable :: numbers(:, :)
      real(wp) :: before(2)
      integer :: i, k, first
      if (pivot%law /= 'table') return
      call read_columns(pivot%file, of_pivots, numbers, error)
      if (.not. allocated(error)) then
         first = merge(2, 1, all(abs(numbers(:, 1)) <= 0))
         before = 0
         do k = first, size(numbers, 2)
            do i = 1, 2
               if (.not. numbers(i, k) > before(i)) call refuse(pivot%file//filled(' line {i}: ' &
                  & //trim(of_pivots(i)%name)//' = {}: must be above {}'//trim(merge(repeat(' ', 25), &
                  & ', that of the line before', k == first)), [real(wp) :: k + 1, numbers(i, k), before(i)]), error)
            end do
            before = numbers(:, k)
         end do
         pivot%points = numbers(:, first:)
         if (size(pivot%points, 2) < 2) call refuse(pivot%file//': has one point of force over deflection; it needs ' &
            & //'two or more above 0', error)
      end if
      call add_context(error, variable)
   end subroutine read_pivots

   !> Reads the tables of a case's excitations.
   subroutine read_excitations(inputs, error)
      type(case_type), intent(inout) :: inputs
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: numbers(:, :)
      integer :: i, k
      do i = 1, size(inputs%excitations)
         associate (x => inputs%excitations(i))
            if (x%kind /= 'table') cycle
            call read_columns(x%file, of_excitations, numbers, error)
            if (.not. allocated(error)) then
               x%time = numbers(1, :)
               x%table = numbers(2:, :)
               do k = 2, size(x%time)
                  if (.not. x%time(k) - x%time(k - 1) >= shortest_time) call raise(error, input_error, x%file &
                     & //filled(' line {i}: time = {}: must be {} s or more above that of the line before, {}', &
                     & [real(wp) :: k + 1, x%time(k), shortest_time, x%time(k - 1)]))
               end do
            end if
            call add_context(error, 'excitation('//to_text(i)//')%file')
            if (allocated(error)) return
         end associate
      end do
   end subroutine read_excitations

   !> Numbers of a file, (column, row), two rows at least. Its columns must be these in this order.
   subroutine read_columns(file, columns, numbers, error)
      character(len=*), intent(in) :: file
      type(column_type), intent(in) :: columns(:)
      real(wp), allocatable, intent(out) :: numbers(:, :)
      type(error_type), allocatable, intent(out) :: error
      type(csv_table_type) :: table
      integer :: k
      call read_csv(file, longest_file, table, error)
      if (allocated(error)) return
      allocate (numbers(size(columns), max(0, table%rows)))
      do k = 0, table%rows
         if (k == 0) then
            call check_names(table%row(0), file, columns%name, error)
         else
            call read_row(table%row(k), table%origin(k), columns, numbers(:, k), error)
         end if
         if (allocated(error)) return
      end do
      if (table%rows < 2) call raise(error, input_error, file//': has '//to_text(max(0, table%rows))//' rows of ' &
         & //'numbers; it needs a line of names, '//listed(columns%name)//', and two rows or more')
   end subroutine read_columns

   !> The first line names the columns.
   subroutine check_names(line, file, names, error)
      character(len=*), intent(in) :: line, file, names(:)
      type(error_type), allocatable, intent(inout) :: error
      type(cell_type) :: cell
      integer :: at, i
      logical :: fit
      at = 1
      fit = .true.
      do i = 1, size(names)
         call next_cell(line, at, cell)
         fit = fit .and. lower_case(content(line, cell)) == trim(names(i))
      end do
      if (.not. fit .or. at <= len(line) + 1) call raise(error, input_error, file//' line 1: ' &
         & //shortened(line)//': must name the columns, '//listed(names))
   end subroutine check_names

   !> A number for each column.
   subroutine read_row(line, origin, columns, numbers, error)
      character(len=*), intent(in) :: line, origin
      type(column_type), intent(in) :: columns(:)
      real(wp), intent(out) :: numbers(:)
      type(error_type), allocatable, intent(inout) :: error
      type(cell_type) :: cell
      integer :: at, i
      logical :: ok
      at = 1
      numbers = 0
      do i = 1, size(columns)
         call next_cell(line, at, cell)
         call read_number(lower_case(content(line, cell)), numbers(i), ok)
         if (ok) ok = ieee_is_finite(numbers(i))
         if (.not. ok) then
            call raise(error, input_error, origin//': '//trim(columns(i)%name)//' = ' &
               & //shortened(content(line, cell))//': must be a finite number; commas separate the columns, and ' &
               & //'decimals have a point')
            return
         end if
         associate (c => columns(i), x => numbers(i))
            if (x >= c%low .and. x <= c%high) cycle
            call raise(error, input_error, origin//': '//trim(c%name)//filled(' = {}: must be {} to {} ', [x, c%low, &
               & c%high])//c%unit//in_other_units(x, trim(c%name), c%unit, c%low, c%high))
         end associate
         return
      end do
      call require(at > len(line) + 1, origin//': has more than '//to_text(size(columns))//' numbers; the columns ' &
         & //'are '//listed(columns%name), error)
   end subroutine read_row

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
end module number_columns
