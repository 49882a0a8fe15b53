!> A whole study: its file, with a row for each run, and where runs have files of their own the folder of these.
module whole_study
   use errors, only: error_type
   use case_inputs, only: case_type
   use result_size, only: size_note
   use assignments, only: assignment_type, target_text
   use parameter_study, only: study_type, run_tag
   use namelist_writer, only: namelist_of
   use files, only: is_regular
   use processes, only: processors
   use working_file, only: clear_leftovers
   use record, only: record_type
   use study_child, only: study_runner_type
   use study_file, only: study_file_type
   use study_marks, only: is_collected
   use hdf5_file, only: hdf5_type
   use restart, only: open_result
   use study_folder, only: result_path, prepare_folder, check_folder
   use study_runs, only: perform_runs
   use run_case, only: run_task, way_out
   implicit none (type, external)
   private
   public :: perform_study, mark_study

   !> Performs a run of a study as a run of its own, or what is left of it.
   type, extends(study_runner_type) :: case_runner_type
      !> Whether there are runs that have files.
      logical :: filed = .false.
      !> Where runs have files.
      character(len=:), allocatable :: folder
      integer :: runs = 0, verified_states = 0
      logical :: overwrite = .false.
   contains
      procedure :: perform
      procedure :: own_file
   end type case_runner_type

contains

   !> Performs the runs of a checked and marked study into `output`.h5, and where they keep samples into files in the
   !> folder `output`; those that have their rows are not run again, unless the file may be overwritten. `failures`
   !> has an error for each of the first failed runs.
   subroutine perform_study(study, output, jobs, verified_states, overwrite, quiet, failures, error)
      type(study_type), intent(in) :: study
      character(len=*), intent(in) :: output
      !> Runs at a time; 0 for as many as there are processors.
      integer, intent(in) :: jobs, verified_states
      logical, intent(in) :: overwrite, quiet
      type(error_type), allocatable, intent(out) :: failures(:)
      type(error_type), allocatable, intent(out) :: error
      type(study_file_type) :: table
      type(case_runner_type) :: runner
      type(case_type) :: first, inputs
      logical :: wanted(study%runs), filed, mixed
      integer :: k
      allocate (failures(0))
      call study%inputs(1, first, error)
      if (allocated(error)) return
      if (.not. quiet) then
         if (size_note(first, study%runs) /= '') print '(a)', size_note(first, study%runs)
      end if
      mixed = keeps_differ(study)
      filed = mixed .or. first%output%keep /= 'summary'
      if (filed) call prepare_folder(output, error)
      if (filed .and. .not. allocated(error)) call check_folder(study, output, overwrite, error)
      if (.not. allocated(error)) call open_table(study, output//'.h5', filed, overwrite, quiet, table, error)
      if (allocated(error)) return
      wanted = [(.not. table%has_row(k), k=1, study%runs)]
      inputs = first
      do k = 1, study%runs
         if (.not. filed .or. wanted(k)) cycle
         if (mixed) call study%inputs(k, inputs, error)
         ! a file that is gone is made again
         if (inputs%output%keep == 'summary') cycle
         wanted(k) = .not. is_regular(result_path(output, k, study%runs))
         if (.not. wanted(k)) call clear_leftovers(result_path(output, k, study%runs))
      end do
      runner%filed = filed
      runner%folder = output
      runner%runs = study%runs
      runner%verified_states = verified_states
      runner%overwrite = overwrite
      call perform_runs(study, table, wanted, first%output%checkpoint_seconds, merge(jobs, processors(), jobs > 0), &
         & quiet, runner, failures, error)
   end subroutine perform_study

   !> Whether some runs may have files and others not: which they have follows from the task, where it is not given.
   logical function keeps_differ(study)
      type(study_type), intent(in) :: study
      type(assignment_type), allocatable :: varied(:)
      integer :: i
      varied = study%variables()
      keeps_differ = any([(any(target_text(varied(i)) == [character(len=11) :: 'case%task', 'output%keep']), &
         & i=1, size(varied))])
   end function keeps_differ

   !> Opens the file of a study: a new one, or that of the same study to go on with. `filed`: runs have files of their
   !> own, from which tiltpad-collect may have made one.
   subroutine open_table(study, path, filed, overwrite, quiet, table, error)
      type(study_type), intent(in) :: study
      character(len=*), intent(in) :: path
      logical, intent(in) :: filed, overwrite, quiet
      type(study_file_type), intent(inout) :: table
      type(error_type), allocatable, intent(out) :: error
      call table%claim(path, error)
      if (allocated(error)) return
      if (.not. quiet .and. table%taken_from() /= '') print '(a)', path//': '//table%taken_from() &
         & //', which wrote it, has ended'
      if (is_regular(path)) then
         if (filed) then
            ! it is made anew of the same files
            if (is_collected(path)) then
               call table%begin(study, error)
               return
            end if
         end if
         call table%reopen(study, error)
         if (.not. allocated(error)) return
         call refuse_foreign(path, overwrite, error)
         if (allocated(error)) return
         call table%claim(path, error)
         if (allocated(error)) return
      end if
      call table%begin(study, error)
   end subroutine open_table

   !> Keeps the error that a file is in the way, unless it may be overwritten; what is no result never is.
   subroutine refuse_foreign(path, overwrite, error)
      character(len=*), intent(in) :: path
      logical, intent(in) :: overwrite
      type(error_type), allocatable, intent(inout) :: error
      type(error_type), allocatable :: foreign
      type(hdf5_type) :: file
      logical :: older
      call open_result(path, file, foreign, older)
      if (allocated(foreign) .and. .not. older) then
         error%message = error%message//'; it is not replaced'
      else if (overwrite) then
         deallocate (error)
      else
         error%message = error%message//way_out
      end if
      call file%close()
   end subroutine refuse_foreign

   !> Performs a run, and prints nothing.
   subroutine perform(self, inputs, tag, results, error)
      class(case_runner_type), intent(in) :: self
      type(case_type), intent(in) :: inputs
      type(run_tag), intent(in) :: tag
      type(record_type), intent(inout) :: results
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: path
      path = ''
      if (inputs%output%keep /= 'summary') path = result_path(self%folder, tag%number, tag%runs)
      call run_task(inputs, path, tag, self%verified_states, .true., self%overwrite, .true., results, error)
   end subroutine perform

   !> The folder is beside the file of the study.
   function own_file(self, k) result(name)
      class(case_runner_type), intent(in) :: self
      integer, intent(in) :: k
      character(len=:), allocatable :: name
      name = ''
      if (.not. self%filed) return
      name = result_path(self%folder, k, self%runs)
      if (is_regular(name)) then
         name = name(1 + index(self%folder, '/', back=.true.):)
      else
         name = ''
      end if
   end function own_file

   !> The checksums of a study are those of its first run's case and of the runs' values.
   subroutine mark_study(study)
      type(study_type), intent(inout) :: study
      type(case_type) :: first
      type(error_type), allocatable :: error
      call study%inputs(1, first, error)
      ! only the time between checkpoints may differ
      first%output%checkpoint_seconds = 0
      if (allocated(error)) then
         ! others may be good, and run by --run
         call study%mark('')
      else
         call study%mark(namelist_of(first))
      end if
   end subroutine mark_study
end module whole_study
