!> Parameter studies: in a case with the group &sweep variables have several values; the case describes many runs.
module parameter_study
   use kinds, only: i8
   use text, only: to_text, lower_case, checksum
   use errors, only: error_type, raise, require, input_error
   use case_inputs, only: case_type
   use assignments, only: namelist_type, assignment_type, put_assignment, undoes, assignment_text, target_text, &
      & value_text, study_group
   use varied_values, only: varied_values_type, read_varied_values
   use case_text, only: read_text, parse_case
   use case_fields, only: title_variable
   use variable_names, only: meant_variable
   use case_namelist, only: case_from_namelist, fill_case
   use namelist_writer, only: namelist_of
   use checked_case, only: marked_text, derived_text
   implicit none (type, external)
   private
   public :: study_type, run_tag, read_study, study_from_text

   !> Most runs of a study, and variables that a message lists.
   integer, parameter :: most_runs = 100000, most_listed = 8
   character(len=*), parameter :: newline = achar(10)

   !> A varied variable: its assignment without values, and the values.
   type :: variable_type
      type(assignment_type) :: target
      type(varied_values_type) :: values
   end type variable_type

   !> Which run of a study a run is.
   type :: run_tag
      !> From 1; 0 for a run of its own.
      integer :: number = 0, runs = 0
      !> A line for each varied variable: "operation%speed_rpm = 1500".
      character(len=:), allocatable :: study
      !> Checksums of the study: of its runs before this one, up to this one, and of all, separated by blanks. A
      !> study that has grown keeps those of its former runs. Empty where they are not known.
      character(len=:), allocatable :: marks
   contains
      procedure :: same_up_to
   end type run_tag

   type :: study_type
      !> False for a case without a study; it has one run.
      logical :: given = .false.
      integer :: runs = 1
      type(namelist_type), private :: base
      logical, private :: zip = .false.
      type(variable_type), allocatable, private :: variables(:)
      !> Checksums of the base and of the runs up to the k-th, k = 0, ..., runs.
      integer(i8), allocatable, private :: marks(:)
   contains
      procedure :: mark
      procedure :: inputs => case_of_run
      procedure :: tag
      procedure :: resolved
      procedure :: checked
      procedure, private :: value_of_run
      procedure, private :: namelist_of_run
   end type study_type

contains

   !> Reads a case file and applies the overrides ("group%name=value"). Runs' values are checked when their
   !> cases are made.
   subroutine read_study(file, overrides, study, error)
      character(len=*), intent(in) :: file, overrides(:)
      type(study_type), intent(out) :: study
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: text
      call read_text(file, text, error)
      if (.not. allocated(error)) call study_from_text(text, file, overrides, study, error)
   end subroutine read_study

   !> The same from text; `file` is for messages.
   subroutine study_from_text(text, file, overrides, study, error)
      character(len=*), intent(in) :: text, file, overrides(:)
      type(study_type), intent(out) :: study
      type(error_type), allocatable, intent(out) :: error
      type(namelist_type) :: parsed
      character(len=:), allocatable :: origin
      integer :: i
      allocate (study%variables(0))
      call parse_case(text, file, overrides, parsed, error)
      if (allocated(error)) return
      do i = 1, size(parsed%groups)
         if (parsed%groups(i)%group == study_group) origin = parsed%groups(i)%origin
      end do
      study%base = parsed
      study%base%groups = pack(parsed%groups, [(parsed%groups(i)%group /= study_group, i=1, size(parsed%groups))])
      study%base%assignments = pack(parsed%assignments, &
         & [(parsed%assignments(i)%group /= study_group, i=1, size(parsed%assignments))])
      do i = 1, size(parsed%assignments)
         if (parsed%assignments(i)%group /= study_group) cycle
         if (.not. allocated(origin)) origin = parsed%assignments(i)%origin
         call read_variable(parsed%assignments(i), study, error)
         if (allocated(error)) return
      end do
      study%given = allocated(origin)
      if (study%given) call count_runs(origin, study, error)
   end subroutine study_from_text

   !> One assignment of the group &sweep.
   subroutine read_variable(given, study, error)
      type(assignment_type), intent(in) :: given
      type(study_type), intent(inout) :: study
      type(error_type), allocatable, intent(out) :: error
      type(variable_type) :: new
      character(len=:), allocatable :: order, name
      integer :: percent, i
      if (given%name == 'order') then
         order = lower_case(trim(adjustl(given%values(1)%text)))
         call require(size(given%values) == 1 .and. given%subscript == 0 .and. any(order == ['product', 'zip    ']), &
            & given%origin//': '//assignment_text(given)//': must be one of ''product'', ''zip''', error)
         study%zip = order == 'zip'
         return
      end if
      percent = index(given%name, '%')
      name = given%name(percent + 1:)
      if (percent <= 1 .or. name == '' .or. index(name, '%') > 0) then
         call raise(error, input_error, given%origin//': unknown variable '//given%group//'%'//given%name &
            & //meant_variable('', name)//'; expected order or group%name = values')
         return
      end if
      new%target = given
      new%target%group = given%name(:percent - 1)
      new%target%name = name
      new%target%overrides = .true.
      call require(new%target%group /= study_group .and. given%name /= title_variable, given%origin//': '//given%name &
         & //' cannot be swept', error)
      do i = 1, size(study%variables)
         associate (other => study%variables(i)%target)
            call require(.not. (undoes(new%target, other) .or. undoes(other, new%target)), given%origin//': ' &
               & //given%name//' is swept twice, first at '//other%origin, error)
         end associate
      end do
      do i = 1, size(study%base%assignments)
         associate (a => study%base%assignments(i))
            call require(a%origin /= '--set' .or. .not. undoes(new%target, a), '--set '//assignment_text(a) &
               & //': is swept ('//given%origin//'); give the study other values with --set sweep%'//given%name &
               & //'=...', error)
         end associate
      end do
      if (allocated(error)) return
      call read_varied_values(given%values, given%origin//': '//study_group//'%'//given%name, new%values, error)
      if (allocated(error)) return
      deallocate (new%target%values)
      study%variables = [study%variables, new]
   end subroutine read_variable

   !> How many runs there are; `origin` of the study is for messages.
   subroutine count_runs(origin, study, error)
      character(len=*), intent(in) :: origin
      type(study_type), intent(inout) :: study
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: list
      integer(i8) :: runs
      integer :: i
      if (size(study%variables) == 0) then
         call raise(error, input_error, origin//': &sweep sweeps nothing; expected group%name = values')
         return
      end if
      list = ''
      runs = 1
      do i = 1, size(study%variables)
         associate (v => study%variables(i))
            if (i > 1 .and. i <= most_listed + 1) list = list//', '
            if (i <= most_listed) list = list//v%target%group//'%'//v%target%name//' has '//to_text(v%values%count())
            if (i == most_listed + 1) list = list//'...'
            if (study%zip) then
               runs = v%values%count()
            else
               runs = min(runs*v%values%count(), 2_i8*most_runs)
            end if
         end associate
      end do
      if (study%zip .and. any([(study%variables(i)%values%count() /= runs, i=1, size(study%variables))])) then
         call raise(error, input_error, origin//': &sweep with order = ''zip'' needs as many values of each: '//list)
      else if (runs > most_runs) then
         call raise(error, input_error, origin//': &sweep has more than '//to_text(most_runs)//' runs: '//list)
      end if
      study%runs = int(runs)
   end subroutine count_runs

   !> The case of the k-th run, everything checked; messages name the run.
   subroutine case_of_run(self, k, inputs, error)
      class(study_type), intent(in) :: self
      integer, intent(in) :: k
      type(case_type), intent(out) :: inputs
      type(error_type), allocatable, intent(out) :: error
      type(namelist_type) :: parsed
      call self%namelist_of_run(k, parsed)
      call case_from_namelist(parsed, inputs, error)
   end subroutine case_of_run

   !> Calculates the checksums that tags then have. `base` is a text of what all runs have in common.
   subroutine mark(self, base)
      class(study_type), intent(inout) :: self
      character(len=*), intent(in) :: base
      integer(i8) :: marks(0:self%runs)
      type(run_tag) :: found
      integer :: k
      marks(0) = checksum(base, 0_i8)
      do k = 1, self%runs
         call self%tag(k, found)
         marks(k) = checksum(found%study//newline, marks(k - 1))
      end do
      allocate (self%marks(0:self%runs), source=marks)
   end subroutine mark

   !> True where two tags of one number are of studies that have the same runs up to it, or where that is not known.
   pure logical function same_up_to(self, other)
      class(run_tag), intent(in) :: self, other
      same_up_to = self%marks == '' .or. other%marks == ''
      if (.not. same_up_to) same_up_to = up_to(self%marks) == up_to(other%marks)
   contains
      !> All but the last checksum.
      pure function up_to(marks)
         character(len=*), intent(in) :: marks
         character(len=:), allocatable :: up_to
         up_to = marks(:index(marks, ' ', back=.true.))
      end function up_to
   end function same_up_to

   !> Number and values of the k-th run.
   subroutine tag(self, k, found)
      class(study_type), intent(in) :: self
      integer, intent(in) :: k
      type(run_tag), intent(out) :: found
      type(assignment_type) :: a
      integer :: i
      found%number = k
      found%runs = self%runs
      found%study = ''
      do i = 1, size(self%variables)
         if (i > 1) found%study = found%study//newline
         call self%value_of_run(i, k, a)
         found%study = found%study//target_text(a)//' = '//value_text(a%values(1))
      end do
      found%marks = ''
      if (allocated(self%marks)) found%marks = to_text(self%marks(k - 1))//' '//to_text(self%marks(k))//' ' &
         & //to_text(self%marks(self%runs))
   end subroutine tag

   !> The k-th run's case with every default, marked, and what follows from it.
   subroutine checked(self, k, text, error)
      class(study_type), intent(in) :: self
      integer, intent(in) :: k
      character(len=:), allocatable, intent(out) :: text
      type(error_type), allocatable, intent(out) :: error
      type(namelist_type) :: parsed
      type(case_type) :: inputs
      call self%inputs(k, inputs, error)
      if (allocated(error)) return
      call self%namelist_of_run(k, parsed)
      text = marked_text(inputs, parsed)//derived_text(inputs)
   end subroutine checked

   !> The case with every default, followed by the study, as namelist text. A varied variable has the first run's
   !> value; what follows from other variables is left out.
   subroutine resolved(self, text, error)
      class(study_type), intent(in) :: self
      character(len=:), allocatable, intent(out) :: text
      type(error_type), allocatable, intent(out) :: error
      type(namelist_type) :: parsed
      type(case_type) :: inputs
      integer :: i
      call self%namelist_of_run(1, parsed)
      call fill_case(parsed, inputs, error)
      if (allocated(error)) return
      text = namelist_of(inputs)//'&'//study_group//newline//'  order = '''//trim(merge('zip    ', 'product', &
         & self%zip))//''''//newline
      do i = 1, size(self%variables)
         associate (v => self%variables(i))
            text = text//'  '//target_text(v%target)//' = '//v%values%text()//newline
         end associate
      end do
      text = text//'/'//newline
   end subroutine resolved

   !> The case's assignments with those of the k-th run.
   subroutine namelist_of_run(self, k, parsed)
      class(study_type), intent(in) :: self
      integer, intent(in) :: k
      type(namelist_type), intent(out) :: parsed
      type(assignment_type) :: new
      integer :: i
      parsed = self%base
      if (.not. self%given) return
      do i = 1, size(self%variables)
         call self%value_of_run(i, k, new)
         call put_assignment(new, parsed)
      end do
      parsed%file = parsed%file//', run '//to_text(k)
      do i = 1, size(parsed%assignments)
         associate (a => parsed%assignments(i))
            a%origin = a%origin//', run '//to_text(k)
         end associate
      end do
   end subroutine namelist_of_run

   !> The k-th run's assignment to the i-th varied variable. The first variable changes slowest.
   subroutine value_of_run(self, i, k, found)
      class(study_type), intent(in) :: self
      integer, intent(in) :: i, k
      type(assignment_type), intent(out) :: found
      integer :: at, j
      at = k - 1
      if (.not. self%zip) then
         do j = size(self%variables), i + 1, -1
            at = at/self%variables(j)%values%count()
         end do
         at = mod(at, self%variables(i)%values%count())
      end if
      found = self%variables(i)%target
      allocate (found%values(1))
      call self%variables(i)%values%value(at + 1, found%values(1))
   end subroutine value_of_run
end module parameter_study
