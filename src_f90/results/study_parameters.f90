!> The parameters of a study: its varied variables, a column each with the values of all runs.
module study_parameters
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use kinds, only: wp
   use text, only: to_text, replaced
   use assignments, only: assignment_type, token_type, target_text, kind_of, identifier_of
   use case_inputs, only: case_type
   use variable_table, only: variable_table_type
   use case_fields, only: list_all_variables
   use parameter_study, only: study_type
   use hdf5_file, only: hdf5_type
   use hdf5_rows, only: hdf5_rows_type, most_rows
   use hdf5_texts, only: hdf5_texts_type, text_type
   use study_columns, only: run_scale
   implicit none (type, external)
   private
   public :: parameter_type, parameters_of, write_parameters

   type :: parameter_type
      !> speed_rpm, arc_deg_1; operation%speed_rpm, pads%arc_deg(1); speed; arc, 1.
      character(len=:), allocatable :: name, variable, long_name, units
      logical :: is_text = .false.
   end type parameter_type

   !> Names of variables, among others, that other datasets of a study have.
   character(len=*), parameter :: taken = ' run pad revolution pivot frequency_ratio row column position_row ' &
      & //'position_column mode reason file runs status complete resumes checkpoint_seconds revolutions '

contains

   !> The parameters of a study, the slowest first. A name that another group or another dataset has, too, gets its
   !> group before it, and so does every name in a group of which there are several.
   function parameters_of(study) result(found)
      type(study_type), intent(in) :: study
      type(parameter_type), allocatable :: found(:)
      type(variable_table_type) :: table
      type(assignment_type), allocatable :: targets(:)
      character(len=:), allocatable :: names, suffix
      integer :: i
      call list_all_variables(case_type(), table)
      targets = study%varied%targets()
      names = taken
      do i = 1, size(targets)
         names = names//short_name(targets(i))//' '
      end do
      allocate (found(size(targets)))
      do i = 1, size(targets)
         associate (own => found(i), target => targets(i), &
            & variable => table%variables(table%find(kind_of(targets(i)%group), targets(i)%name)))
            own%variable = target_text(target)
            own%name = short_name(target)
            own%long_name = in_words(target%name)
            if (kind_of(target%group) /= target%group &
               & .or. index(names, ' '//own%name//' ') /= index(names, ' '//own%name//' ', back=.true.)) then
               own%name = identifier_of(target%group)//'_'//own%name
               own%long_name = own%long_name//' ('//target%group//')'
            end if
            suffix = ''
            if (target%subscript > 0) suffix = ', '//to_text(target%subscript)
            own%long_name = own%long_name//suffix
            own%is_text = variable%is_text
            own%units = in_symbols(variable%unit)
            if (own%is_text) then
               own%units = ''
               own%long_name = singular(kind_of(target%group))//' '//own%long_name
            end if
         end associate
      end do
   end function parameters_of

   !> arc_deg_1 of pads%arc_deg(1).
   pure function short_name(target) result(name)
      type(assignment_type), intent(in) :: target
      character(len=:), allocatable :: name
      name = target%name
      if (target%subscript > 0) name = name//'_'//to_text(target%subscript)
   end function short_name

   !> The name of a variable without its unit: "pivot angle" of pivot_angle_deg.
   pure function in_words(name) result(text)
      character(len=*), intent(in) :: name
      character(len=:), allocatable :: text
      integer :: length
      length = len(name)
      if (any(name(max(1, length - 3):) == ['_deg', '_rpm'])) length = length - 4
      text = replaced(name(:length), '_', ' ')
   end function in_words

   pure function singular(group) result(text)
      character(len=*), intent(in) :: group
      character(len=:), allocatable :: text
      text = group
      if (group(len(group):) == 's') text = group(:len(group) - 1)
   end function singular

   !> A unit as Python writes it, UTF-8: m², °C.
   pure function in_symbols(unit) result(symbols)
      character(len=*), intent(in) :: unit
      character(len=:), allocatable :: symbols
      integer :: i
      symbols = ''
      do i = 1, len(unit)
         if (unit(i:i) == '^') cycle
         if (i > 1) then
            if (unit(i - 1:i) == '^2') then
               symbols = symbols//char(194)//char(178)
               cycle
            else if (unit(i - 1:i) == '^3') then
               symbols = symbols//char(194)//char(179)
               cycle
            end if
         end if
         symbols = symbols//unit(i:i)
      end do
      if (unit == 'C') symbols = char(194)//char(176)//'C'
      if (unit == '') symbols = '1'
   end function in_symbols

   !> Writes the values of runs `first` to `last`; into new datasets, or, with `again`, into those that the file has,
   !> which may have fewer runs.
   subroutine write_parameters(file, study, parameters, first, last, again)
      class(hdf5_type), intent(inout) :: file
      type(study_type), intent(in) :: study
      type(parameter_type), intent(in) :: parameters(:)
      integer, intent(in) :: first, last
      logical, intent(in) :: again
      integer :: i
      do i = 1, size(parameters)
         if (allocated(file%failure)) return
         if (parameters(i)%is_text) then
            call write_texts(file, study, i, parameters(i), first, last, again)
         else
            call write_numbers(file, study, i, parameters(i), first, last, again)
         end if
      end do
   end subroutine write_parameters

   subroutine write_texts(file, study, i, own, first, last, again)
      class(hdf5_type), intent(inout) :: file
      type(study_type), intent(in) :: study
      integer, intent(in) :: i, first, last
      type(parameter_type), intent(in) :: own
      logical, intent(in) :: again
      type(hdf5_texts_type) :: list
      type(text_type) :: texts(most_rows)
      type(token_type) :: token
      integer :: from, n, k
      if (again) then
         call list%open(file, own%name)
         call list%resize(file, study%runs)
      else
         call list%create(file, own%name, study%runs)
         call file%describe(list%id, own%units, own%long_name, run_scale, own%name)
      end if
      do from = first, last, most_rows
         n = min(most_rows, last - from + 1)
         do k = 1, n
            call study%varied%value(i, from + k - 1, token)
            texts(k)%text = token%text
         end do
         call list%write(file, from, texts(:n))
      end do
      call list%close(file)
   end subroutine write_texts

   subroutine write_numbers(file, study, i, own, first, last, again)
      class(hdf5_type), intent(inout) :: file
      type(study_type), intent(in) :: study
      integer, intent(in) :: i, first, last
      type(parameter_type), intent(in) :: own
      logical, intent(in) :: again
      type(hdf5_rows_type) :: column
      real(wp) :: values(1, most_rows), nan
      integer :: from, n, k
      logical :: ok
      nan = ieee_value(nan, ieee_quiet_nan)
      if (again) then
         call column%open(file, own%name)
         call column%resize(file, [integer ::], study%runs)
      else
         call column%create(file, own%name, [integer ::], study%runs, nan, .false.)
         call file%describe(column%id, own%units, own%long_name, run_scale, own%name)
      end if
      do from = first, last, most_rows
         n = min(most_rows, last - from + 1)
         do k = 1, n
            call study%varied%number_of_run(i, from + k - 1, values(1, k), ok)
            if (.not. ok) values(1, k) = nan
         end do
         call column%write(file, from, values(:, :n))
      end do
      call column%close(file)
   end subroutine write_numbers
end module study_parameters
