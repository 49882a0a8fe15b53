!> A whole study: its file, with a row for each run, and where runs have files of their own the folder of these.
module whole_study
   use kinds, only: wp, i8
   use text, only: to_text, checksum, is_first, newline
   use errors, only: error_type, raise, input_error, stopped
   use case_inputs, only: case_type
   use case_completion, only: fill_replaced
   use result_size, only: size_note, result_bytes
   use assignments, only: assignment_type, token_type, target_text
   use parameter_study, only: study_type, run_tag
   use namelist_writer, only: namelist_of
   use files, only: is_regular, real_path
   use read_files, only: read_tables, file_marks, file_checksum
   use rotor_file, only: read_rotor
   use processes, only: processors, is_terminal
   use working_file, only: clear_leftovers
   use record, only: record_type
   use study_child, only: study_runner_type
   use study_file, only: study_file_type
   use study_log, only: not_run, stays
   use study_source, only: log_path, read_states
   use study_blocks, only: block_type, path_type, block_paths, refuse_written
   use study_folder, only: result_path, prepare_folder, check_folder
   use study_runs, only: perform_runs, tally_type, new_tally, tell
   use joined_blocks, only: study_place_type, open_study, delete_blocks, join_blocks, find_rows
   use run_case, only: run_task, way_out
   use stop_signals, only: stop_requested, stop_reason
   implicit none (type, external)
   private
   public :: perform_study, mark_study, refuse_large

   !> Performs a run of a study as a run of its own, or what is left of it.
   type, extends(study_runner_type) :: case_runner_type
      type(study_place_type) :: place
      integer :: runs = 0, verified_states = 0
   contains
      procedure :: perform
      procedure :: own_file
   end type case_runner_type

   !> Variables that decide which files a run reads.
   character(len=*), parameter :: deciding(4) = ['file', 'kind', 'law ', 'from']
   !> Bytes of results, above which a study is refused.
   real(wp), parameter :: huge_size = 1e9_wp

contains

   !> Refuses the runs of a study that write more than a gigabyte together, where someone sits at a terminal.
   subroutine refuse_large(study, share, error)
      type(study_type), intent(in) :: study
      type(block_type), intent(in) :: share
      type(error_type), allocatable, intent(out) :: error
      type(case_type) :: first
      character(len=:), allocatable :: note
      integer :: runs
      if (.not. is_terminal()) return
      runs = share%last(study%runs) - share%first(study%runs) + 1
      call study%inputs(1, first, error)
      if (allocated(error) .or. runs < 1) return
      if (runs*result_bytes(first) <= huge_size) return
      note = size_note(first, runs)
      call raise(error, input_error, note(7:)//'; --yes performs them all the same')
   end subroutine refuse_large

   !> Performs the runs of a block of a checked and marked study into its file, or of the whole study into `output`.h5,
   !> and where they keep samples into files in the folder `output`; those that have their rows are not run again.
   !> The block that finds all others finished joins them. `failures` has an error for each of the first failed runs.
   subroutine perform_study(study, share, output, jobs, verified_states, overwrite, quiet, failures, error)
      type(study_type), intent(in) :: study
      type(block_type), intent(in) :: share
      character(len=*), intent(in) :: output
      !> Runs at a time; 0 for as many as there are processors.
      integer, intent(in) :: jobs, verified_states
      logical, intent(in) :: overwrite, quiet
      type(error_type), allocatable, intent(out) :: failures(:)
      type(error_type), allocatable, intent(out) :: error
      type(case_runner_type) :: runner
      type(error_type), allocatable :: of_joining
      type(tally_type) :: tally
      character(len=:), allocatable :: path
      type(case_type) :: first
      logical, allocatable :: filed(:), missing(:)
      integer :: runs, k
      allocate (failures(0))
      runs = share%last(study%runs) - share%first(study%runs) + 1
      call study%inputs(1, first, error)
      if (allocated(error)) return
      if (.not. quiet .and. runs > 0) then
         if (size_note(first, runs) /= '') print '(a)', size_note(first, runs)
      end if
      filed = which_have_files(study, first)
      runner = case_runner_type(study_place_type(output, any(filed), overwrite, quiet), study%runs, verified_states)
      if (any(filed)) call prepare_folder(output, error)
      if (any(filed) .and. .not. allocated(error)) call check_folder(study, share, output, overwrite, error)
      if (allocated(error)) return
      allocate (missing(study%runs), source=.false.)
      do k = share%first(study%runs), share%last(study%runs)
         ! a file that is gone is made again
         if (.not. filed(k)) cycle
         missing(k) = .not. is_regular(result_path(output, k, study%runs))
         if (.not. missing(k)) call clear_leftovers(result_path(output, k, study%runs))
      end do
      call perform_block(study, share, missing, first%output%checkpoint_seconds, &
         & merge(jobs, processors(), jobs > 0), runner, tally, path, error)
      if (allocated(error)) return
      call tell(study, tally, path, runs, quiet, failures, error)
      if (share%of == 1) return
      if (stop_requested()) return
      call join_blocks(study, runner%place, share%of, of_joining)
      if (allocated(of_joining)) call move_alloc(of_joining, error)
   end subroutine perform_study

   !> Performs the runs of a block that have no row to stay, or whose own file is missing. `path` is the file of the
   !> rows.
   subroutine perform_block(study, share, missing, checkpoint_seconds, jobs, runner, tally, path, error)
      type(study_type), intent(in) :: study
      type(block_type), intent(in) :: share
      logical, intent(in) :: missing(:)
      real(wp), intent(in) :: checkpoint_seconds
      integer, intent(in) :: jobs
      type(case_runner_type), intent(in) :: runner
      type(tally_type), intent(out) :: tally
      character(len=:), allocatable, intent(out) :: path
      type(error_type), allocatable, intent(out) :: error
      type(study_file_type) :: table
      type(path_type), allocatable :: taken(:)
      integer :: status(study%runs), k, first, last
      logical :: wanted(study%runs), joined
      first = share%first(study%runs)
      last = share%last(study%runs)
      path = share%path(runner%place%name)
      status = not_run
      if (share%of == 1) then
         call refuse_written(runner%place%name, error)
      else
         call find_rows(study, runner%place, runner%place%name//'.h5', way_out, status, error)
      end if
      joined = all(stays(status(first:last)))
      if (.not. allocated(error) .and. any(status(first:last) == 0)) call refuse_joined(study, share, runner, &
         & status == 0, error)
      if (.not. allocated(error)) call find_rows(study, runner%place, path, way_out, status, error)
      if (allocated(error)) return
      tally = new_tally(status(first:last))
      if (all(stays(status(first:last)) .and. .not. missing(first:last)) .and. (joined .or. &
         & runner%verified_states == 0) .and. .not. is_begun(runner%place%name, path, share)) then
         call clear_leftovers(path)
         ! a block that has been joined
         if (.not. is_regular(path)) path = runner%place%name//'.h5'
         return
      end if
      call open_study(study, runner%place, share, table, taken, error)
      if (.not. allocated(error)) then
         status = [(merge(table%status(k), status(k), table%has_row(k)), k=1, study%runs)]
         wanted = .not. stays(status) .or. missing
         if (runner%verified_states > 0) wanted = wanted .or. [(lacks_states(table, k, runner%verified_states), &
            & k=1, study%runs)]
         wanted(:first - 1) = .false.
         wanted(last + 1:) = .false.
         tally = new_tally(pack(status(first:last), .not. wanted(first:last)))
         call perform_runs(study, table, wanted, last - first + 1, checkpoint_seconds, jobs, runner%place%quiet, &
            & runner, tally, error)
      end if
      if (.not. allocated(error)) call delete_blocks(taken)
      call table%abandon()
   end subroutine perform_block

   !> Refuses to verify runs of a block that the whole study has, `done`, and without films in as many states: a run has
   !> its row in one file.
   subroutine refuse_joined(study, share, runner, done, error)
      type(study_type), intent(in) :: study
      type(block_type), intent(in) :: share
      type(case_runner_type), intent(in) :: runner
      logical, intent(in) :: done(:)
      type(error_type), allocatable, intent(out) :: error
      integer, allocatable :: states(:)
      integer :: k
      if (runner%verified_states == 0) return
      call read_states(runner%place%name//'.h5', study, states, error)
      if (allocated(error)) return
      do k = share%first(study%runs), share%last(study%runs)
         if (done(k) .and. states(k) /= runner%verified_states) call raise(error, input_error, runner%place%name &
            & //'.h5: has run '//to_text(k)//' of this block already; --verify '//to_text(runner%verified_states) &
            & //' without --block looks at its films')
         if (allocated(error)) return
      end do
   end subroutine refuse_joined

   !> Whether the row of a run that is done is without films that were solved closely in this number of states.
   logical function lacks_states(table, k, states)
      type(study_file_type), intent(inout) :: table
      integer, intent(in) :: k, states
      lacks_states = table%status(k) == 0
      if (lacks_states) lacks_states = table%verified_states(k) /= states
   end function lacks_states

   !> Whether rows wait to be written into the file of a study or block, or of blocks to be joined.
   logical function is_begun(name, path, share)
      character(len=*), intent(in) :: name, path
      type(block_type), intent(in) :: share
      is_begun = is_regular(log_path(path))
      if (share%of == 1 .and. .not. is_begun) is_begun = size(block_paths(name)) > 0
   end function is_begun

   !> Which runs of a study have files of their own.
   function which_have_files(study, first) result(filed)
      type(study_type), intent(in) :: study
      !> Its first run.
      type(case_type), intent(in) :: first
      logical :: filed(study%runs)
      type(case_type) :: inputs
      type(error_type), allocatable :: ignored
      integer :: k
      filed = first%output%keep /= 'summary'
      if (.not. keeps_differ(study)) return
      do k = 1, study%runs
         call study%inputs(k, inputs, ignored)
         filed(k) = inputs%output%keep /= 'summary'
      end do
   end function which_have_files

   !> Whether some runs may have files and others not: which they have follows from the task, where it is not given.
   logical function keeps_differ(study)
      type(study_type), intent(in) :: study
      type(assignment_type), allocatable :: varied(:)
      integer :: i
      varied = study%varied%variables%target
      keeps_differ = any([(any(target_text(varied(i)) == [character(len=11) :: 'case%task', 'output%keep']), &
         & i=1, size(varied))])
   end function keeps_differ

   !> Performs a run, and prints nothing.
   subroutine perform(self, inputs, tag, results, error)
      class(case_runner_type), intent(in) :: self
      type(case_type), intent(in) :: inputs
      type(run_tag), intent(in) :: tag
      type(record_type), intent(inout) :: results
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: path
      path = ''
      if (inputs%output%keep /= 'summary') path = result_path(self%place%name, tag%number, tag%runs)
      call run_task(inputs, path, tag, self%verified_states, .true., self%place%overwrite, .true., results, error)
   end subroutine perform

   !> The folder is beside the file of the study.
   function own_file(self, k) result(name)
      class(case_runner_type), intent(in) :: self
      integer, intent(in) :: k
      character(len=:), allocatable :: name
      name = ''
      if (.not. self%place%filed) return
      name = result_path(self%place%name, k, self%runs)
      if (is_regular(name)) then
         name = name(1 + index(self%place%name, '/', back=.true.):)
      else
         name = ''
      end if
   end function own_file

   !> The checksums of a study are those of its first run's case, of files that runs read, and of the runs' values.
   !> Files in the folder of its own results are not among them. An error where a signal came.
   subroutine mark_study(study, folder, error)
      type(study_type), intent(inout) :: study
      character(len=*), intent(in) :: folder
      type(error_type), allocatable, intent(out) :: error
      type(case_type) :: first
      type(error_type), allocatable :: refusal
      character(len=:), allocatable :: marks
      call study%inputs(1, first, refusal)
      if (allocated(refusal)) then
         ! others may be good, and run by --run
         call study%mark('')
         return
      end if
      ! only the time between checkpoints may differ
      first%output%checkpoint_seconds = 0
      call fill_replaced(first)
      call find_marks(study, folder, marks, error)
      if (.not. allocated(error)) call study%mark(namelist_of(first)//marks)
   end subroutine mark_study

   !> Checksums of the files that runs read: of the first run, and of those in which a value that decides which file is
   !> read stands for the first or the last time. Empty where there are none.
   subroutine find_marks(study, folder, marks, error)
      type(study_type), intent(in) :: study
      character(len=*), intent(in) :: folder
      character(len=:), allocatable, intent(out) :: marks
      type(error_type), allocatable, intent(out) :: error
      type(assignment_type), allocatable :: varied(:)
      type(token_type) :: token
      integer(i8) :: values(study%runs)
      logical :: wanted(study%runs)
      integer :: i, k
      varied = study%varied%variables%target
      marks = ''
      do i = 0, size(varied)
         wanted = [(i == 0 .and. k == 1, k=1, study%runs)]
         if (i > 0) then
            if (all(varied(i)%name /= deciding)) cycle
            do k = 1, study%runs
               call study%varied%value(i, k, token)
               values(k) = checksum(token%text, 0_i8)
            end do
            wanted = is_first(values)
            wanted(study%runs:1:-1) = wanted(study%runs:1:-1) .or. is_first(values(study%runs:1:-1))
         end if
         do k = 1, study%runs
            if (stop_requested()) call raise(error, stopped, stop_reason()//'; no run was started')
            if (allocated(error)) return
            if (wanted(k)) marks = marks//marks_of_run(study, k, folder)
         end do
      end do
   end subroutine find_marks

   !> Those of one run; empty where it is not possible or a file cannot be read, as its row says.
   function marks_of_run(study, k, folder) result(marks)
      type(study_type), intent(in) :: study
      integer, intent(in) :: k
      character(len=*), intent(in) :: folder
      character(len=:), allocatable :: marks
      type(case_type) :: inputs
      type(error_type), allocatable :: error
      marks = ''
      call study%inputs(k, inputs, error)
      if (.not. allocated(error)) call read_rotor(inputs%rotor, error)
      if (.not. allocated(error)) call read_tables(inputs, error)
      if (allocated(error)) return
      marks = file_marks(inputs)
      associate (start => inputs%start%file)
         ! a run may start from the end of another of its study
         if (start /= '' .and. index(real_path(start), real_path(folder)//'/') /= 1) marks = marks//'start%file ' &
            & //to_text(file_checksum(start))//newline
      end associate
   end function marks_of_run
end module whole_study
