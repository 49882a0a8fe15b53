!> What a study says of itself: its case, how many runs it has, its checksums, and its parameters, the varied variables,
!> with their values in all runs.
module study_header
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use kinds, only: wp
   use text, only: to_text, replaced
   use errors, only: error_type
   use build_info, only: program_version, program_commit
   use assignments, only: assignment_type, token_type, target_text, kind_of, identifier_of
   use case_inputs, only: case_type
   use variable_table, only: variable_table_type
   use case_fields, only: list_all_variables
   use namelist_writer, only: namelist_of
   use parameter_study, only: study_type, run_tag
   use packet, only: packet_type, text_type
   use hdf5_scales, only: word => scale_name
   use provenance, only: format_version, machine_version, now
   implicit none (type, external)
   private
   public :: header_type, header_of, names_taken, own_build

   type :: parameter_type
      !> speed_rpm, arc_deg_1; operation%speed_rpm, pads%arc_deg(1); speed; arc, 1.
      character(len=:), allocatable :: name, variable, long_name, units
      logical :: is_text = .false.
      !> Its value in each row.
      real(wp), allocatable :: numbers(:)
      type(text_type), allocatable :: texts(:)
   end type parameter_type

   type :: header_type
      integer :: format_version = 0
      !> The builds that made its rows, separated by commas.
      character(len=:), allocatable :: version
      character(len=:), allocatable :: created, title, input
      !> Runs of the whole study, and the number of the run of each row; 0 where the row is not this file's.
      integer :: runs = 0
      real(wp), allocatable :: numbers(:)
      !> Checksums of what all runs have in common, and of all runs; empty where they are not known. A study that was
      !> collected from the files of its runs has none, but the numbers of those that are missing.
      character(len=:), allocatable :: marks, missing
      logical :: is_collected = .false.
      type(parameter_type), allocatable :: parameters(:)
   contains
      !> The names of the parameters, and their variables.
      procedure :: names
      procedure :: variables
      procedure :: exchange
      procedure :: has_build
      procedure :: add_builds
   end type header_type

   character(len=*), parameter :: own_build = program_version//' ('//program_commit//')', comma = ', '
   !> Names of variables, among others, that other datasets of a study have.
   character(len=*), parameter :: taken = ' run pad revolution pivot frequency_ratio row column position_row ' &
      & //'position_column mode reason file runs status complete resumes checkpoint_seconds revolutions '

contains

   !> That of a study, with rows for all runs; those from `first` to `last` are its file's.
   function header_of(study, first, last) result(header)
      type(study_type), intent(in) :: study
      integer, intent(in) :: first, last
      type(header_type) :: header
      type(case_type) :: inputs
      type(error_type), allocatable :: error
      integer :: k
      header%version = own_build
      header%created = now()
      ! the first run that is possible; runs that are not become rows with their reason
      do k = 1, study%runs
         call study%inputs(k, inputs, error)
         if (.not. allocated(error)) exit
      end do
      header%format_version = merge(format_version, machine_version, inputs%rotor%is_rigid())
      header%title = ''
      header%input = ''
      if (.not. allocated(error)) then
         header%title = inputs%about%title
         header%input = namelist_of(inputs)
      end if
      header%runs = study%runs
      header%numbers = [(real(merge(k, 0, k >= first .and. k <= last), wp), k=1, study%runs)]
      header%marks = marks_of(study)
      header%missing = ''
      header%parameters = parameters_of(study)
      do k = 1, size(header%parameters)
         call take_values(header%parameters(k), study, k, first, last)
      end do
   end function header_of

   !> The names that no column of a study may have, separated by blanks.
   function names_taken(study) result(names)
      type(study_type), intent(in) :: study
      character(len=:), allocatable :: names
      type(header_type) :: header
      header%parameters = parameters_of(study)
      names = 'run reason remarks file runs '//header%names()
   end function names_taken

   !> The checksums of what all runs of a study have in common, and of all runs.
   function marks_of(study) result(marks)
      type(study_type), intent(in) :: study
      character(len=:), allocatable :: marks
      type(run_tag) :: first, last
      call study%tag(1, first)
      call study%tag(study%runs, last)
      marks = trim(word(first%marks, 1)//' '//word(last%marks, 3))
   end function marks_of

   !> The values of the i-th parameter in the runs from `first` to `last`.
   subroutine take_values(self, study, i, first, last)
      type(parameter_type), intent(inout) :: self
      type(study_type), intent(in) :: study
      integer, intent(in) :: i, first, last
      type(token_type) :: token
      logical :: ok
      integer :: k
      allocate (self%numbers(merge(0, study%runs, self%is_text)), source=ieee_value(1.0_wp, ieee_quiet_nan))
      allocate (self%texts(merge(study%runs, 0, self%is_text)), source=text_type(''))
      do k = first, last
         if (self%is_text) then
            call study%varied%value(i, k, token)
            self%texts(k)%text = token%text
         else
            call study%varied%number_of_run(i, k, self%numbers(k), ok)
            if (.not. ok) self%numbers(k) = ieee_value(1.0_wp, ieee_quiet_nan)
         end if
      end do
   end subroutine take_values

   !> Separated by blanks.
   pure function names(self)
      class(header_type), intent(in) :: self
      character(len=:), allocatable :: names
      integer :: i
      names = ''
      do i = 1, size(self%parameters)
         if (i > 1) names = names//' '
         names = names//self%parameters(i)%name
      end do
   end function names

   pure function variables(self)
      class(header_type), intent(in) :: self
      character(len=:), allocatable :: variables
      integer :: i
      variables = ''
      do i = 1, size(self%parameters)
         if (i > 1) variables = variables//achar(10)
         variables = variables//self%parameters(i)%variable
      end do
   end function variables

   !> All of it, into a packet or out of it; `ok` of the packet is false where it has no header.
   pure subroutine exchange(self, packed)
      class(header_type), intent(inout) :: self
      type(packet_type), intent(inout) :: packed
      integer :: n, i, k, kind
      call packed%whole(self%format_version)
      call packed%text(self%version)
      call packed%text(self%created)
      call packed%text(self%title)
      call packed%text(self%input)
      call packed%whole(self%runs)
      call packed%reals(self%numbers)
      n = merge(1, 0, self%is_collected)
      call packed%whole(n)
      self%is_collected = n == 1
      call packed%text(self%marks)
      call packed%text(self%missing)
      if (.not. packed%reading) n = size(self%parameters)
      call packed%count(n)
      if (packed%reading) allocate (self%parameters(n))
      do i = 1, n
         associate (own => self%parameters(i))
            call packed%text(own%name)
            call packed%text(own%variable)
            call packed%text(own%long_name)
            call packed%text(own%units)
            kind = merge(1, 0, own%is_text)
            call packed%whole(kind)
            own%is_text = kind == 1
            if (packed%reading) allocate (own%texts(merge(size(self%numbers), 0, own%is_text)), own%numbers(0))
            if (.not. own%is_text) call packed%reals(own%numbers)
            do k = 1, size(own%texts)
               call packed%text(own%texts(k)%text)
            end do
            packed%ok = packed%ok .and. size(own%numbers) + size(own%texts) == size(self%numbers)
         end associate
      end do
      packed%ok = packed%ok .and. self%runs >= 1 .and. size(self%numbers) >= 1
   end subroutine exchange

   !> Whether a build is among those that made its rows.
   pure logical function has_build(self, build)
      class(header_type), intent(in) :: self
      character(len=*), intent(in) :: build
      has_build = index(comma//self%version//comma, comma//build//comma) > 0
   end function has_build

   !> Adds those of some builds, separated by commas, that it does not have.
   pure subroutine add_builds(self, builds)
      class(header_type), intent(inout) :: self
      character(len=*), intent(in) :: builds
      character(len=:), allocatable :: own
      integer :: first, last
      if (.not. allocated(self%version)) self%version = ''
      first = 1
      do while (first <= len(builds))
         last = first + index(builds(first:)//comma, comma) - 2
         own = builds(first:last)
         if (self%version == '') then
            self%version = own
         else if (.not. self%has_build(own)) then
            self%version = self%version//comma//own
         end if
         first = last + len(comma) + 1
      end do
   end subroutine add_builds

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
      targets = study%varied%variables%target
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
            own%units = in_symbols(trim(variable%unit))
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
end module study_header
