!> Performs the runs of a study in child processes, as many at a time as are asked for.
module study_runs
   use kinds, only: wp
   use text, only: to_text, fixed_text, replaced
   use errors, only: error_type, raise, system_error, stopped
   use case_inputs, only: case_type
   use parameter_study, only: study_type, run_tag
   use processes, only: open_pipe, wait_for_record, ended, stop_process
   use study_child, only: child_type, report_type, read_report, study_runner, pause
   use hdf5_base, only: start_hdf5
   use stop_signals, only: stop_requested, stop_reason
   use clock, only: wall_clock
   use progress, only: progress_type, new_progress
   implicit none (type, external)
   private
   public :: perform_runs, check_runs

   !> What became of the runs so far.
   type :: tally_type
      integer :: done = 0, failed = 0, stopped = 0
      !> Status and message of each failed run.
      type(error_type), allocatable :: errors(:)
   end type tally_type

contains

   !> Reads and checks every run; the error is the first bad run's, or that a signal came.
   subroutine check_runs(study, error)
      type(study_type), intent(in) :: study
      type(error_type), allocatable, intent(out) :: error
      type(case_type) :: inputs
      integer :: k
      do k = 1, study%runs
         call study%inputs(k, inputs, error)
         if (stop_requested()) call raise(error, stopped, stop_reason()//'; no run was started')
         if (allocated(error)) return
      end do
   end subroutine check_runs

   !> Performs all runs of a checked study into a prepared folder, `jobs` at a time. A failed run stops no other;
   !> a noted signal does: then those that run are sent it, and waited for. `failures` has one error a failed run;
   !> `error` says how many failed, or which signal came.
   subroutine perform_runs(study, folder, jobs, quiet, perform_run, failures, error)
      type(study_type), intent(in) :: study
      character(len=*), intent(in) :: folder
      integer, intent(in) :: jobs
      logical, intent(in) :: quiet
      procedure(study_runner) :: perform_run
      type(error_type), allocatable, intent(out) :: failures(:)
      type(error_type), allocatable, intent(out) :: error
      type(child_type) :: children(min(jobs, study%runs))
      type(tally_type) :: tally
      type(progress_type) :: progress
      real(wp) :: started
      integer :: pipe(2), next, i
      logical :: stopping, children_know

      allocate (failures(0), tally%errors(study%runs))
      if (.not. open_pipe(pipe)) then
         call raise(error, system_error, 'the system has no pipe for the runs of the study')
         return
      end if
      call start_hdf5()
      started = wall_clock()
      progress = new_progress(0.0_wp, real(study%runs, wp), quiet)
      next = 1
      children_know = .false.
      do
         stopping = stop_requested()
         do i = 1, size(children)
            if (children(i)%run /= 0 .or. next > study%runs .or. stopping) cycle
            if (children(i)%process == 0) call children(i)%start(study, folder, pipe(2), perform_run)
            if (children(i)%process /= 0) then
               call children(i)%order(next)
            else
               ! no process could be started: later, when one of ours has ended, if there is one
               if (any(children%run /= 0)) exit
               call note(next, system_error, 'no process could be started for it', tally)
            end if
            next = next + 1
         end do
         if (stopping .and. .not. children_know) then
            children_know = .true.
            do i = 1, size(children)
               if (children(i)%run /= 0) call stop_process(children(i)%process)
            end do
         end if
         if (all(children%run == 0) .and. (next > study%runs .or. stopping)) exit
         call look(children, pipe(1), tally)
         call progress%report_runs(tally%done + tally%failed, tally%failed)
      end do
      do i = 1, size(children)
         if (children(i)%process /= 0) call children(i)%dismiss()
      end do
      call progress%clear()
      call conclude(study, tally, failures, error)
      if (.not. quiet) print '(a)', to_text(study%runs)//' runs: '//totals(study, tally)//'; ' &
         & //fixed_text(wall_clock() - started, 2)//' s; in '//folder
   end subroutine perform_runs

   !> Waits a while for a report, reads all that are there, and enters the runs that have ended.
   subroutine look(children, pipe, tally)
      type(child_type), intent(inout) :: children(:)
      integer, intent(in) :: pipe
      type(tally_type), intent(inout) :: tally
      type(report_type) :: report
      character(len=:), allocatable :: how
      integer :: i
      logical :: ok
      if (.not. wait_for_record(pipe, pause)) then
         do i = 1, size(children)
            if (children(i)%process == 0) cycle
            if (ended(children(i)%process, .false., how)) children(i)%how = how
         end do
      end if
      do while (wait_for_record(pipe, 0))
         call read_report(pipe, report, ok)
         if (.not. ok) exit
         call note(report%run, report%error%status, report%error%message, tally)
         i = findloc(children%run, report%run, dim=1)
         children(i)%run = 0
         if (.not. report%stays) call children(i)%wait_for_end()
      end do
      ! their reports have been read
      do i = 1, size(children)
         if (.not. allocated(children(i)%how)) cycle
         if (children(i)%run /= 0) call note(children(i)%run, system_error, children(i)%how, tally)
         call children(i)%wait_for_end()
      end do
   end subroutine look

   !> Enters what became of a run.
   subroutine note(k, status, message, tally)
      integer, intent(in) :: k, status
      character(len=*), intent(in) :: message
      type(tally_type), intent(inout) :: tally
      select case (status)
      case (0)
         tally%done = tally%done + 1
      case (stopped)
         tally%stopped = tally%stopped + 1
      case default
         tally%failed = tally%failed + 1
         tally%errors(k)%status = status
         tally%errors(k)%message = message
      end select
   end subroutine note

   !> The failed runs' errors, in order, and the error of the whole: 4 after a signal; else 3 if any had that;
   !> else the highest.
   subroutine conclude(study, tally, failures, error)
      type(study_type), intent(in) :: study
      type(tally_type), intent(in) :: tally
      type(error_type), allocatable, intent(out) :: failures(:)
      type(error_type), allocatable, intent(out) :: error
      type(run_tag) :: tag
      integer :: k, n
      allocate (failures(tally%failed))
      n = 0
      do k = 1, study%runs
         if (tally%errors(k)%status == 0) cycle
         n = n + 1
         failures(n) = tally%errors(k)
         call study%tag(k, tag)
         failures(n)%message = 'run '//to_text(k)//' ('//replaced(tag%study, achar(10), ', ')//'): ' &
            & //failures(n)%message
      end do
      if (stop_requested()) then
         call raise(error, stopped, stop_reason()//'; of ' &
            & //to_text(study%runs)//' runs '//totals(study, tally))
      else if (tally%stopped > 0) then
         call raise(error, stopped, to_text(tally%stopped)//' of '//to_text(study%runs) &
            & //' runs were stopped by a signal')
      else if (n > 0) then
         call raise(error, maxval(failures%status), to_text(n)//' of '//to_text(study%runs)//' runs failed')
      end if
   end subroutine conclude

   !> "997 done, 3 failed".
   function totals(study, tally)
      type(study_type), intent(in) :: study
      type(tally_type), intent(in) :: tally
      character(len=:), allocatable :: totals
      integer :: rest
      totals = to_text(tally%done)//' done, '//to_text(tally%failed)//' failed'
      rest = study%runs - tally%done - tally%failed - tally%stopped
      if (tally%stopped > 0) totals = totals//', '//to_text(tally%stopped)//' stopped'
      if (rest > 0) totals = totals//', '//to_text(rest)//' not started'
   end function totals
end module study_runs
