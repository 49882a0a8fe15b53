!> A child process that performs runs of a study one after another: its parent orders each. A new process for each would
!> cost as much as a short run.
module study_child
   use, intrinsic :: iso_fortran_env, only: output_unit, error_unit
   use errors, only: error_type
   use case_inputs, only: case_type
   use parameter_study, only: study_type, run_tag
   use processes, only: process_id, record_length, new_process, end_child, end_with_parent, open_pipe, close_pipe, &
      & send_record, receive_record, wait_for_record, ended
   use study_folder, only: result_path
   use stop_signals, only: stop_requested
   implicit none (type, external)
   private
   public :: child_type, report_type, read_report, study_runner, pause

   abstract interface
      !> Performs one run to its result file, and prints nothing.
      subroutine study_runner(inputs, path, tag, error)
         import :: case_type, run_tag, error_type
         type(case_type), intent(in) :: inputs
         character(len=*), intent(in) :: path
         type(run_tag), intent(in) :: tag
         type(error_type), allocatable, intent(out) :: error
      end subroutine study_runner
   end interface

   !> Milliseconds between two looks for children that ended without a report.
   integer, parameter :: pause = 100
   !> Runs that a child runs before a new one replaces it, so that what they may leave in memory does not add up.
   integer, parameter :: runs_a_child = 50
   !> In the report of a run: its number, its status, and whether its child stays; its message follows.
   character(len=*), parameter :: head_format = '(ss,2i12,l1,a)'
   integer, parameter :: head = 25

   !> What a child reports of a run that has ended.
   type :: report_type
      integer :: run = 0
      type(error_type) :: error
      !> Whether the child waits for the order of another.
      logical :: stays = .false.
   end type report_type

   !> A child process, if its number is not 0, and the run that it runs; 0: it waits for the order of another.
   type :: child_type
      integer :: process = 0, run = 0
      !> The pipe of its orders.
      integer :: orders(2) = 0
      !> How it ended, where that is known before its last report is read.
      character(len=:), allocatable :: how
   contains
      procedure :: start
      procedure :: order
      procedure :: dismiss
      procedure :: wait_for_end
   end type child_type

contains

   !> Orders a child that waits to perform the k-th run.
   subroutine order(child, k)
      class(child_type), intent(inout) :: child
      integer, intent(in) :: k
      character(len=record_length) :: record
      child%run = k
      ! the bits of the number: a child needs no memory to read that there is nothing more to do
      record = transfer(k, repeat(' ', storage_size(k)/8))
      call send_record(child%orders(2), record)
   end subroutine order

   !> Orders a child that waits to end, and waits for it.
   subroutine dismiss(child)
      class(child_type), intent(inout) :: child
      call child%order(0)
      call child%wait_for_end()
   end subroutine dismiss

   !> Waits for the end of a child that has nothing more to do.
   subroutine wait_for_end(child)
      class(child_type), intent(inout) :: child
      character(len=:), allocatable :: how
      logical :: ignored
      if (allocated(child%how)) then
         deallocate (child%how)
      else
         ignored = ended(child%process, .true., how)
      end if
      call close_pipe(child%orders)
      child%process = 0
      child%run = 0
   end subroutine wait_for_end

   !> Starts a child, which waits for orders; `child` has no process where none could be started.
   subroutine start(child, study, folder, pipe, perform_run)
      class(child_type), intent(inout) :: child
      type(study_type), intent(in) :: study
      character(len=*), intent(in) :: folder
      integer, intent(in) :: pipe
      procedure(study_runner) :: perform_run
      integer :: parent, process
      if (.not. open_pipe(child%orders)) return
      parent = process_id()
      ! what is buffered here would else be written by both
      flush (output_unit)
      flush (error_unit)
      process = new_process()
      if (process == 0) then
         call end_with_parent(parent)
         call run_in_child(study, folder, child%orders(1), pipe, perform_run)
      else if (process < 0) then
         call close_pipe(child%orders)
      else
         child%process = process
      end if
   end subroutine start

   !> What a child does: it performs the runs that it is ordered to, and sends a report of each. It ends after one that
   !> failed, as a library may then be in a bad state.
   subroutine run_in_child(study, folder, orders, pipe, perform_run)
      type(study_type), intent(in) :: study
      character(len=*), intent(in) :: folder
      !> The end of a pipe that its orders come from, and that of one for its reports.
      integer, intent(in) :: orders, pipe
      procedure(study_runner) :: perform_run
      integer :: k, count
      logical :: stays
      do count = 1, runs_a_child
         call receive_order(orders, k)
         if (k == 0) exit
         call run_one(study, folder, k, pipe, count < runs_a_child, perform_run, stays)
         if (.not. stays) exit
      end do
      call end_child(0)
   end subroutine run_in_child

   !> Waits for an order: the number of a run; 0 for the end, also where a signal has come.
   subroutine receive_order(orders, k)
      integer, intent(in) :: orders
      integer, intent(out) :: k
      character(len=record_length) :: record
      logical :: stop_now
      k = 0
      do
         ! what was ordered before a signal waits by the time that this is seen
         stop_now = stop_requested()
         if (wait_for_record(orders, merge(0, pause, stop_now))) exit
         if (stop_now) return
      end do
      if (receive_record(orders, record)) k = transfer(record, k)
   end subroutine receive_order

   !> Performs a run and sends its report, with whether the child stays for another.
   subroutine run_one(study, folder, k, pipe, may_stay, perform_run, stays)
      type(study_type), intent(in) :: study
      character(len=*), intent(in) :: folder
      integer, intent(in) :: k, pipe
      logical, intent(in) :: may_stay
      procedure(study_runner) :: perform_run
      logical, intent(out) :: stays
      type(case_type) :: inputs
      type(run_tag) :: tag
      type(error_type), allocatable :: error
      character(len=record_length) :: record
      call study%tag(k, tag)
      call study%inputs(k, inputs, error)
      if (.not. allocated(error)) call perform_run(inputs, result_path(folder, k, study%runs), tag, error)
      if (.not. allocated(error)) error = error_type(0, '')
      stays = may_stay .and. error%status == 0
      write (record, head_format) k, error%status, stays, error%message(:min(len(error%message), record_length - head))
      call send_record(pipe, record)
   end subroutine run_one

   !> A report that waits in the pipe; ok is false where there is none.
   subroutine read_report(pipe, report, ok)
      integer, intent(in) :: pipe
      type(report_type), intent(out) :: report
      logical, intent(out) :: ok
      character(len=record_length) :: record
      ok = receive_record(pipe, record)
      if (.not. ok) return
      read (record(:head), head_format) report%run, report%error%status, report%stays
      report%error%message = trim(record(head + 1:))
   end subroutine read_report
end module study_child
