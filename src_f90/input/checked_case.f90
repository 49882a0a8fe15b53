!> What --check prints: the resolved case, where each value comes from, and what follows from the values.
module checked_case
   use kinds, only: wp
   use text, only: to_text, behind, newline
   use errors, only: error_type
   use case_groups, only: bearing_type, is_set
   use case_inputs, only: case_type
   use bearing_numbers, only: preload, clearance_ratio, length_over_diameter, load, specific_load, sommerfeld_number, &
      & of_supply
   use result_size, only: result_bytes, sample_count
   use oil_properties, only: viscosity, kinematic_points
   use case_completion, only: complete_case
   use variable_table, only: variable_table_type
   use case_fields, only: list_variables, counting_variables
   use assignments, only: namelist_type, kind_of
   use case_namelist, only: fill_case
   use namelist_writer, only: lines_of, group_start, namelist_of
   use case_remarks, only: remarks_on_case
   implicit none (type, external)
   private
   public :: marked_text, derived_text, first_equal

   !> Temperatures of warm oil, C.
   real(wp), parameter :: warm(3) = [60.0_wp, 80.0_wp, 100.0_wp]

contains

   !> The text of a case with a mark behind each value that its assignments do not give: a default, or derived from
   !> others.
   function marked_text(inputs, parsed) result(text)
      type(case_type), intent(in) :: inputs
      type(namelist_type), intent(in) :: parsed
      character(len=:), allocatable :: text, mark
      type(case_type) :: default
      type(namelist_type) :: given
      type(error_type), allocatable :: error
      type(variable_table_type) :: table, defaults
      integer :: i, k
      call fill_case(parsed, default, error, given)
      call find_default_case(parsed, default)
      call list_variables(inputs, table)
      call list_variables(default, defaults)
      text = ''
      do i = 1, table%count
         associate (v => table%variables(i))
            mark = '! derived'
            if (lines_of(v, '') == lines_of(defaults%variables(i), '')) mark = '! default'
            do k = 1, size(given%assignments)
               if (given%assignments(k)%group == v%group .and. given%assignments(k)%name == v%name) mark = ''
            end do
            text = text//group_start(table, i)//lines_of(v, mark)
         end associate
      end do
      text = text//'/'//newline
   end function marked_text

   !> The paper's bearing with the pivots of the case, a machine with as many sections.
   subroutine find_default_case(parsed, inputs)
      type(namelist_type), intent(in) :: parsed
      type(case_type), intent(out) :: inputs
      type(namelist_type) :: pivots
      type(error_type), allocatable :: error
      integer :: i
      pivots%file = parsed%file
      pivots%groups = parsed%groups
      pivots%assignments = pack(parsed%assignments, [(any(kind_of(parsed%assignments(i)%group)//'%' &
         & //parsed%assignments(i)%name == counting_variables), i=1, size(parsed%assignments))])
      call fill_case(pivots, inputs, error)
      if (.not. allocated(error)) call complete_case(inputs, error)
   end subroutine find_default_case

   !> What follows from a complete case, as comments.
   function derived_text(inputs) result(text)
      type(case_type), intent(in) :: inputs
      character(len=:), allocatable :: text
      integer :: b
      text = '! derived values'//newline
      if (inputs%rotor%station_count() > 0) text = text//said('mass', inputs%rotor%elastic%mass(), &
         & 'kg, shaft and discs')
      do b = 1, size(inputs%bearings)
         if (first_equal(inputs, b) == b) text = text//names_of_equals(inputs, b) &
            & //derived_of_bearing(inputs%bearings(b))
      end do
      if (inputs%rotor%is_rigid()) text = text//derived_of_load(inputs)
      if (result_bytes(inputs) > 0) text = text//said('result', 0.1_wp*anint(result_bytes(inputs)/1e5_wp), &
         & 'MB, '//to_text(sample_count(inputs))//' samples')
      text = text//behind('! remark: ', remarks_on_case(inputs))
   end function derived_text

   !> What follows for a bearing and its oil, whatever its load.
   function derived_of_bearing(bearing) result(text)
      type(bearing_type), intent(in) :: bearing
      character(len=:), allocatable :: text
      integer :: i
      text = said_of_pads('preload', preload(bearing), '1 - c_r/c_m') &
         & //said('clearance ratio', clearance_ratio(bearing), 'c_r/R_J') &
         & //said('length ratio', length_over_diameter(bearing), 'L/D')
      if (bearing%oil%law == 'constant') return
      associate (oil => bearing%oil, points => kinematic_points(bearing%oil))
         text = text//said('viscosity', viscosity(oil, oil%supply_temperature), &
            & 'Pa s at oil%supply_temperature = '//to_text(oil%supply_temperature)//' C')
         do i = 1, size(warm)
            text = text//said('viscosity', viscosity(oil, warm(i)), 'Pa s at '//to_text(warm(i))//' C')
         end do
         do i = 1, merge(2, 0, is_set(oil%grade))
            text = text//said('kinematic', points(i), 'm^2/s at '//to_text(oil%at_temperature(i))//' C')
         end do
      end associate
   end function derived_of_bearing

   !> What follows from the rigid journal in the one bearing of a case.
   function derived_of_load(inputs) result(text)
      type(case_type), intent(in) :: inputs
      character(len=:), allocatable :: text
      text = ''
      if (is_set(inputs%rotor%balance_grade)) text = said('unbalance', inputs%unbalance(), &
         & 'kg m, by rotor%balance_grade')
      text = text//said('load', load(inputs), 'N, weight and static load') &
         & //said('specific load', specific_load(inputs), 'Pa, W/(L D)')
      if (load(inputs) > 0) text = text//said('Sommerfeld number', sommerfeld_number(inputs), &
         & 'mu N L D/W (R_J/c_r)^2, N in 1/s at the start, mu '//of_supply(inputs%bearings(1)))
   end function derived_of_load

   !> A value of each pad, one line where all are equal.
   function said_of_pads(name, values, meaning) result(text)
      character(len=*), intent(in) :: name, meaning
      real(wp), intent(in) :: values(:)
      character(len=:), allocatable :: text
      integer :: i
      text = ''
      do i = 1, size(values)
         if (all(abs(values - values(1)) <= 0)) then
            text = said(name, values(1), meaning)
            return
         end if
         text = text//said(name, values(i), meaning//', pad '//to_text(i))
      end do
   end function said_of_pads

   function said(name, value, meaning) result(line)
      character(len=*), intent(in) :: name, meaning
      real(wp), intent(in) :: value
      character(len=:), allocatable :: line
      character(len=18) :: padded
      padded = name
      line = '!   '//padded//' '//to_text(value)//'  '//meaning//newline
   end function said

   !> The first bearing that is as bearing b, wherever they stand: it, or one before it.
   integer function first_equal(inputs, b) result(first)
      type(case_type), intent(in) :: inputs
      integer, intent(in) :: b
      do first = 1, b - 1
         if (namelist_of(inputs%alone(first)) == namelist_of(inputs%alone(b))) return
      end do
   end function first_equal

   !> "! bearings 'left', 'right'", a line: bearing b and those behind it that are as it is; empty for one without name.
   function names_of_equals(inputs, b) result(text)
      type(case_type), intent(in) :: inputs
      integer, intent(in) :: b
      character(len=:), allocatable :: text
      integer :: i, equals
      text = ''
      if (inputs%bearings(b)%name == '') return
      equals = 0
      do i = b, size(inputs%bearings)
         if (first_equal(inputs, i) /= b) cycle
         equals = equals + 1
         if (equals > 1) text = text//', '
         text = text//''''//inputs%bearings(i)%name//''''
      end do
      text = '! '//trim(merge('bearing ', 'bearings', equals == 1))//' '//text//newline
   end function names_of_equals
end module checked_case
