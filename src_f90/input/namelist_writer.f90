!> A case as text: namelist text that reads back to the same bits; the same with marks, and what follows from the
!> values, as --check prints it; and the input reference.
module namelist_writer
   use kinds, only: wp
   use text, only: to_text, behind, newline
   use errors, only: error_type
   use case_groups, only: bearing_type, is_set, unset
   use case_inputs, only: case_type
   use bearing_numbers, only: preload, clearance_ratio, length_over_diameter, load, specific_load, sommerfeld_number, &
      & of_supply
   use result_size, only: result_bytes, sample_count
   use oil_properties, only: viscosity, kinematic_points
   use case_completion, only: complete_case
   use variable_table, only: variable_type, variable_table_type, lines_of, group_start, word_text, exact
   use case_fields, only: list_variables, list_all_variables, counting_variables
   use assignments, only: namelist_type, kind_of
   use case_namelist, only: fill_case
   use case_remarks, only: remarks_on_case
   implicit none (type, external)
   private
   public :: namelist_of, reference_text, marked_text, derived_text, first_equal

   !> Temperatures of warm oil, C.
   real(wp), parameter :: warm(3) = [60.0_wp, 80.0_wp, 100.0_wp]
   !> The only group that may have no lines.
   character(len=*), parameter :: nothing_held = '&held'//newline//'/'//newline

contains

   !> The whole case as namelist text, every number to the last bit; what is not set is left out.
   function namelist_of(inputs) result(text)
      type(case_type), intent(in) :: inputs
      character(len=:), allocatable :: text
      type(variable_table_type) :: table
      integer :: i
      call list_variables(inputs, table)
      text = ''
      do i = 1, table%count
         text = text//group_start(table, i)//lines_of(table%variables(i), '')
      end do
      text = without_empty_group(text//'/'//newline)
   end function namelist_of

   !> The input reference, Markdown tables of all groups: variable, default, unit, allowed values, meaning.
   function reference_text() result(text)
      character(len=:), allocatable :: text
      type(case_type) :: inputs
      type(variable_table_type) :: table
      integer :: i
      inputs = case_type()
      inputs%operation%final_speed_rpm = unset
      call list_all_variables(inputs, table)
      text = ''
      do i = 1, table%count
         associate (v => table%variables(i))
            if (group_start(table, i) /= '') then
               if (i > 1) text = text//newline
               text = text//'## &'//v%group//newline//v%group_meaning//'.'//newline//newline &
                  & //'| variable | default | unit | allowed | meaning |'//newline//'|---|---|---|---|---|'//newline
            end if
            text = text//row(v)
         end associate
      end do
   end function reference_text

   !> The row of a variable.
   function row(v) result(text)
      type(variable_type), intent(in) :: v
      character(len=:), allocatable :: text, default, allowed, meaning
      integer :: i
      meaning = v%meaning
      if (v%is_text) then
         default = '`'//word_text(v)//'`'
         allowed = v%choices
         if (allowed == '') allowed = 'any text'
      else
         default = ''
         do i = 1, merge(1, size(v%values), v%each /= '')
            if (i > 1) default = default//', '
            if (.not. is_set(v%values(i))) then
               default = default//'-'
            else if (v%whole) then
               default = default//exact(v, i)
            else
               default = default//to_text(v%values(i))
            end if
         end do
         allowed = to_text(v%low)//' to '//to_text(v%high)
         if (v%whole) allowed = 'whole, '//allowed
         if (v%any_length) meaning = meaning//'; 1 to '//to_text(v%most)//' of them'
         if (v%each /= '') meaning = meaning//'; one for all '//trim(v%each)//' or one each'
      end if
      text = '| `'//v%name//'` | '//default//' | '//trim(v%unit)//' | '//allowed//' | '//meaning//' |'//newline
   end function row

   !> A text without the one group that may have no lines, where it has none.
   pure function without_empty_group(text) result(shorter)
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: shorter
      shorter = text
      associate (at => index(text, nothing_held))
         if (at > 0) shorter = text(:at - 1)//text(at + len(nothing_held):)
      end associate
   end function without_empty_group

   ! What --check prints: the resolved case, where each value comes from, and what follows from the values.

   !> The text of a case with a mark behind each value that its assignments do not give: a default, or derived from
   !> others.
   function marked_text(inputs, parsed) result(text)
      type(case_type), intent(in) :: inputs
      type(namelist_type), intent(in) :: parsed
      character(len=:), allocatable :: text, mark
      type(case_type) :: default
      type(namelist_type) :: given, pivots
      type(error_type), allocatable :: error
      type(variable_table_type) :: table, defaults
      integer :: i, k
      call fill_case(parsed, default, error, given)
      ! the paper's bearing with the pivots of the case, a machine with as many sections or the same matrices
      pivots%file = parsed%file
      pivots%groups = parsed%groups
      pivots%assignments = pack(parsed%assignments, [(any(kind_of(parsed%assignments(i)%group)//'%' &
         & //parsed%assignments(i)%name == [counting_variables, 'rotor%file          ', 'bearing%kind        ']), i=1, &
         & size(parsed%assignments))])
      call fill_case(pivots, default, error)
      if (.not. allocated(error)) call complete_case(default, error)
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
      text = without_empty_group(text//'/'//newline)
   end function marked_text

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
      if (inputs%held%is_wanted()) return
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
      text = said(name, values(1), meaning)
      if (all(abs(values - values(1)) <= 0)) return
      text = ''
      do i = 1, size(values)
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
      integer :: i
      text = ''
      if (inputs%bearings(b)%name == '') return
      do i = b, size(inputs%bearings)
         if (first_equal(inputs, i) == b) text = text//', '''//inputs%bearings(i)%name//''''
      end do
      text = '! '//trim(merge('bearings', 'bearing ', index(text(2:), ',') > 0))//text(2:)//newline
   end function names_of_equals
end module namelist_writer
