!> Performs the runs of a study in child processes, as many at a time as are asked for, and gives each its row.
module study_runs
   use kinds, only: wp
   use text, only: to_text, fixed_text, replaced
   use errors, only: error_type, raise, system_error, stopped
   use case_inputs, only: case_type
   use parameter_study, only: study_type, run_tag
   use processes, only: open_pipe, wait_for_record, ended, stop_process
   use study_child, only: child_type, report_type, read_report, study_runner_type, pause
   use study_file, only: study_file_type
   use study_row, only: study_row_type
   use study_blocks, only: block_type
   use hdf5_base, only: start_hdf5
   use stop_signals, only: stop_requested, stop_reason
   use clock, only: wall_clock
   use progress, only: progress_type, new_progress
   use study_digest, only: study_digest_type, new_digest
   implicit none (type, external)
   private
   public :: perform_runs, check_runs, tally_type, new_tally, tell

   !> Seconds of rows that a kill may lose, where a checkpoint does not take longer than a twentieth of it.
   real(wp), parameter :: longest_loss = 10
   !> Failures that are told at most: the file of the study has all.
   integer, parameter :: most_told = 100

   !> What became of the runs so far.
   type :: tally_type
      integer :: done = 0, failed = 0, stopped = 0
      !> How many of those performed now have remarks.
      integer :: remarked = 0
      !> The highest exit status of those that failed.
      integer :: status = 0
      !> Number, status and message of the first failed runs.
      integer, allocatable :: runs(:)
      type(error_type), allocatable :: errors(:)
      !> Clock when the first was started, s.
      real(wp) :: started = 0
      !> What is shown of the runs that are performed now.
      type(study_digest_type) :: digest
   end type tally_type

contains

   !> Reads and checks every run of a block; the error is the first bad run's, or that a signal came.
   subroutine check_runs(study, share, error)
      type(study_type), intent(in) :: study
      type(block_type), intent(in) :: share
      type(error_type), allocatable, intent(out) :: error
      type(case_type) :: inputs
      integer :: k
      do k = share%first(study%runs), share%last(study%runs)
         call study%inputs(k, inputs, error)
         if (stop_requested()) call raise(error, stopped, stop_reason()//'; no run was started')
         if (allocated(error)) return
      end do
   end subroutine check_runs

   !> Performs the runs of a checked study that are wanted, `jobs` at a time, each into its row of the open file, which
   !> is published at the end. A failed run stops no other; a noted signal does, and a file that cannot be written: then
   !> those that run are sent a signal, and waited for.
   subroutine perform_runs(study, table, wanted, runs, checkpoint_seconds, jobs, quiet, runner, tally, error)
      type(study_type), intent(in) :: study
      type(study_file_type), intent(inout) :: table
      logical, intent(in) :: wanted(:)
      !> How many there are, with those that have their rows.
      integer, intent(in) :: runs
      !> Wall time between checkpoints, s; 0: none.
      real(wp), intent(in) :: checkpoint_seconds
      integer, intent(in) :: jobs
      logical, intent(in) :: quiet
      class(study_runner_type), intent(in) :: runner
      type(tally_type), intent(inout) :: tally
      type(error_type), allocatable, intent(out) :: error
      type(child_type) :: children(max(1, min(jobs, count(wanted))))
      type(progress_type) :: progress
      real(wp) :: now
      integer :: pipe(2), next, i
      logical :: stopping, children_know

      if (.not. open_pipe(pipe)) then
         call raise(error, system_error, 'the system has no pipe for the runs of the study')
         return
      end if
      call start_hdf5()
      progress = new_progress(real(tally%done + tally%failed, wp), real(runs, wp), quiet)
      tally%digest = new_digest(wanted, quiet)
      next = next_run(wanted, 1)
      children_know = .false.
      do
         stopping = stop_requested() .or. allocated(error)
         if (.not. stopping) call give_orders(children, study, pipe(2), runner, wanted, next, tally)
         if (stopping .and. .not. children_know) then
            children_know = .true.
            do i = 1, size(children)
               if (children(i)%run /= 0) call stop_process(children(i)%process)
            end do
         end if
         if (all(children%run == 0) .and. (next > size(wanted) .or. stopping)) exit
         call look(children, pipe(1), table, runner, tally)
         call progress%report_runs(tally%done + tally%failed, tally%failed)
         now = wall_clock()
         call table%working%heartbeat(int(now))
         if (.not. allocated(error)) call table%checkpoint_if_due(now, min(checkpoint_seconds, longest_loss), error)
      end do
      do i = 1, size(children)
         if (children(i)%process /= 0) call children(i)%dismiss()
      end do
      call progress%clear()
      if (.not. allocated(error)) call table%publish(error)
   end subroutine perform_runs

   !> Orders each child that waits to perform the next run that is wanted.
   subroutine give_orders(children, study, pipe, runner, wanted, next, tally)
      type(child_type), intent(inout) :: children(:)
      type(study_type), intent(in) :: study
      integer, intent(in) :: pipe
      class(study_runner_type), intent(in) :: runner
      logical, intent(in) :: wanted(:)
      integer, intent(inout) :: next
      type(tally_type), intent(inout) :: tally
      integer :: i
      do i = 1, size(children)
         if (children(i)%run /= 0 .or. next > size(wanted)) cycle
         if (children(i)%process == 0) call children(i)%start(study, pipe, runner)
         if (children(i)%process /= 0) then
            call children(i)%order(next)
         else
            ! no process could be started: later, when one of ours has ended, if there is one
            if (any(children%run /= 0)) exit
            call note(next, error_type(system_error, 'no process could be started for it'), tally)
         end if
         next = next_run(wanted, next + 1)
      end do
   end subroutine give_orders

   !> The first run from the k-th on that is wanted; behind the last where there is none.
   pure integer function next_run(wanted, k) result(next)
      logical, intent(in) :: wanted(:)
      integer, intent(in) :: k
      next = findloc(wanted(k:), .true., dim=1)
      next = merge(size(wanted) + 1, k - 1 + next, next == 0)
   end function next_run

   !> Begins with runs that have their rows and ended so.
   function new_tally(status) result(tally)
      integer, intent(in) :: status(:)
      type(tally_type) :: tally
      allocate (tally%runs(0), tally%errors(0))
      tally%started = wall_clock()
      tally%done = count(status == 0)
      tally%failed = size(status) - tally%done
      tally%status = max(0, maxval(status))
   end function new_tally

   !> Waits a while for a report, takes all that are there, and enters the runs that have ended.
   subroutine look(children, pipe, table, runner, tally)
      type(child_type), intent(inout) :: children(:)
      integer, intent(in) :: pipe
      type(study_file_type), intent(inout) :: table
      class(study_runner_type), intent(in) :: runner
      type(tally_type), intent(inout) :: tally
      type(report_type) :: report
      type(study_row_type) :: lost
      character(len=:), allocatable :: how
      integer :: i
      logical :: ok
      call lost%begin('')
      if (.not. wait_for_record(pipe, pause)) then
         do i = 1, size(children)
            if (children(i)%process == 0) cycle
            if (ended(children(i)%process, .false., how)) children(i)%how = how
         end do
      end if
      do while (wait_for_record(pipe, 0))
         call read_report(pipe, report, ok)
         if (.not. ok) exit
         i = findloc(children%run, report%run, dim=1)
         call children(i)%receive(report, ok)
         ! one that was killed meanwhile will be told below
         if (.not. ok) cycle
         call note(report%run, report%error, tally)
         call tally%digest%take(report%run, report%error%status, report%error%message, children(i)%row)
         if (children(i)%row%remarks /= '') tally%remarked = tally%remarked + 1
         if (report%error%status /= stopped) call table%add(report%run, report%error%status, report%error%message, &
            & children(i)%row, runner%own_file(report%run))
         children(i)%run = 0
         if (.not. report%stays) call children(i)%wait_for_end()
      end do
      ! their reports have been read
      do i = 1, size(children)
         if (.not. allocated(children(i)%how)) cycle
         how = children(i)%how
         if (children(i)%run /= 0 .and. how == '') then
            ! a signal came before its order, and ended it
            call note(children(i)%run, error_type(stopped, ''), tally)
         else if (children(i)%run /= 0) then
            call note(children(i)%run, error_type(system_error, how), tally)
            call table%add(children(i)%run, system_error, how, lost, '')
         end if
         call children(i)%wait_for_end()
      end do
   end subroutine look

   !> Enters what became of a run.
   subroutine note(k, error, tally)
      integer, intent(in) :: k
      type(error_type), intent(in) :: error
      type(tally_type), intent(inout) :: tally
      integer :: before
      select case (error%status)
      case (0)
         tally%done = tally%done + 1
      case (stopped)
         tally%stopped = tally%stopped + 1
      case default
         tally%failed = tally%failed + 1
         tally%status = max(tally%status, error%status)
         before = count(tally%runs < k)
         if (before == most_told) return
         tally%runs = [tally%runs(:before), k, tally%runs(before + 1:min(size(tally%runs), most_told - 1))]
         tally%errors = [tally%errors(:before), error, tally%errors(before + 1:min(size(tally%errors), most_told - 1))]
      end select
   end subroutine note

   !> Prints what became of this number of runs. `failures` are the first failed ones' errors, in order; `error` is that
   !> of the whole: 4 after a signal; else the highest.
   subroutine tell(study, tally, path, runs, quiet, failures, error)
      type(study_type), intent(in) :: study
      type(tally_type), intent(in) :: tally
      !> The file of the rows.
      character(len=*), intent(in) :: path
      integer, intent(in) :: runs
      logical, intent(in) :: quiet
      type(error_type), allocatable, intent(out) :: failures(:)
      type(error_type), allocatable, intent(out) :: error
      type(run_tag) :: tag
      integer :: n
      failures = tally%errors
      do n = 1, size(failures)
         call study%tag(tally%runs(n), tag)
         failures(n)%message = 'run '//to_text(tally%runs(n))//' ('//replaced(tag%study, achar(10), ', ')//'): ' &
            & //failures(n)%message
      end do
      if (.not. quiet) call tally%digest%print(study)
      if (.not. quiet) print '(a)', to_text(runs)//' runs: '//totals(runs, tally)//'; ' &
         & //fixed_text(wall_clock() - tally%started, 2)//' s; in '//path
      if (tally%remarked > 0 .and. .not. quiet) print '(a)', 'remarks on '//to_text(tally%remarked)//' of the runs: ' &
         & //'its column remarks has them, and tiltpad-report counts them'
      if (stop_requested()) then
         call raise(error, stopped, stop_reason()//'; of '//to_text(runs)//' runs '//totals(runs, tally))
      else if (tally%stopped > 0) then
         call raise(error, stopped, to_text(tally%stopped)//' of '//to_text(runs)//' runs were stopped by a signal')
      else if (tally%failed > 0) then
         call raise(error, tally%status, to_text(tally%failed)//' of '//to_text(runs)//' runs failed')
      end if
   end subroutine tell

   !> "997 done, 3 failed".
   function totals(runs, tally)
      integer, intent(in) :: runs
      type(tally_type), intent(in) :: tally
      character(len=:), allocatable :: totals
      integer :: rest
      totals = to_text(tally%done)//' done, '//to_text(tally%failed)//' failed'
      rest = runs - tally%done - tally%failed - tally%stopped
      if (tally%stopped > 0) totals = totals//', '//to_text(tally%stopped)//' stopped'
      if (rest > 0) totals = totals//', '//to_text(rest)//' not started'
   end function totals
end module study_runs
