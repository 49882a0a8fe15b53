!> Parameter studies: in a case with the group &sweep variables have several values; the case describes many runs.
module parameter_study
   use kinds, only: i8
   use text, only: to_text, checksum
   use errors, only: error_type
   use case_inputs, only: case_type
   use assignments, only: namelist_type, assignment_type, put_assignment, study_group
   use study_variables, only: study_variables_type
   use namelist_text, only: read_text, parse_case
   use case_namelist, only: case_from_namelist, fill_case
   use namelist_writer, only: namelist_of, marked_text, derived_text
   use read_files, only: read_tables
   implicit none (type, external)
   private
   public :: study_type, run_tag, read_study, study_from_text

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
      !> The varied variables, and their values in each run.
      type(study_variables_type) :: varied
      !> Checksums of the base and of the runs up to the k-th, k = 0, ..., runs.
      integer(i8), allocatable, private :: marks(:)
   contains
      procedure :: mark
      procedure :: inputs => case_of_run
      procedure :: tag
      procedure :: resolved
      procedure :: checked
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
      allocate (study%varied%variables(0), study%varied%counts(0))
      call parse_case(text, file, overrides, parsed, error)
      if (allocated(error)) return
      i = findloc([(parsed%groups(i)%group == study_group, i=1, size(parsed%groups))], .true., dim=1)
      if (i > 0) origin = parsed%groups(i)%origin
      study%base = parsed
      study%base%groups = pack(parsed%groups, [(parsed%groups(i)%group /= study_group, i=1, size(parsed%groups))])
      study%base%assignments = pack(parsed%assignments, &
         & [(parsed%assignments(i)%group /= study_group, i=1, size(parsed%assignments))])
      do i = 1, size(parsed%assignments)
         if (parsed%assignments(i)%group /= study_group) cycle
         if (.not. allocated(origin)) origin = parsed%assignments(i)%origin
         call study%varied%read(parsed%assignments(i), study%base, error)
         if (allocated(error)) return
      end do
      study%given = allocated(origin)
      if (study%given) call study%varied%count_runs(origin, study%runs, error)
   end subroutine study_from_text

   !> The case of the k-th run, everything checked; messages name the run.
   subroutine case_of_run(self, k, inputs, error)
      class(study_type), intent(in) :: self
      integer, intent(in) :: k
      type(case_type), intent(out) :: inputs
      type(error_type), allocatable, intent(out) :: error
      type(namelist_type) :: parsed
      call namelist_of_run(self, k, parsed)
      call case_from_namelist(parsed, inputs, error)
   end subroutine case_of_run

   !> Calculates the checksums that tags then have. `base` is a text of what all runs have in common.
   subroutine mark(self, base)
      class(study_type), intent(inout) :: self
      character(len=*), intent(in) :: base
      call self%varied%find_checksums(self%runs, checksum(base, 0_i8), self%marks)
   end subroutine mark

   !> True where two tags of one number are of studies that have the same runs up to it, or where that is not known.
   pure logical function same_up_to(self, other)
      class(run_tag), intent(in) :: self, other
      ! all but the last checksum
      associate (own => self%marks, others => other%marks)
         same_up_to = own == '' .or. others == '' &
            & .or. own(:index(own, ' ', back=.true.)) == others(:index(others, ' ', back=.true.))
      end associate
   end function same_up_to

   !> Number and values of the k-th run.
   subroutine tag(self, k, found)
      class(study_type), intent(in) :: self
      integer, intent(in) :: k
      type(run_tag), intent(out) :: found
      found%number = k
      found%runs = self%runs
      found%study = self%varied%values_text(k)
      found%marks = ''
      if (allocated(self%marks)) found%marks = to_text(self%marks(k - 1))//' '//to_text(self%marks(k))//' ' &
         & //to_text(self%marks(self%runs))
   end subroutine tag

   !> The k-th run's case with every default, marked, and what follows from it; its tables are read as a run reads them.
   subroutine checked(self, k, text, error)
      class(study_type), intent(in) :: self
      integer, intent(in) :: k
      character(len=:), allocatable, intent(out) :: text
      type(error_type), allocatable, intent(out) :: error
      type(namelist_type) :: parsed
      type(case_type) :: inputs
      call self%inputs(k, inputs, error)
      if (.not. allocated(error)) call read_tables(inputs, error)
      if (allocated(error)) return
      call namelist_of_run(self, k, parsed)
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
      call namelist_of_run(self, 1, parsed)
      call fill_case(parsed, inputs, error)
      if (allocated(error)) return
      text = namelist_of(inputs)//self%varied%text()
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
      do i = 1, size(self%varied%variables)
         call self%varied%assignment_of_run(i, k, new)
         call put_assignment(new, parsed)
      end do
      parsed%file = parsed%file//', run '//to_text(k)
      do i = 1, size(parsed%assignments)
         associate (a => parsed%assignments(i))
            a%origin = a%origin//', run '//to_text(k)
         end associate
      end do
   end subroutine namelist_of_run
end module parameter_study
