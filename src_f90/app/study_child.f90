!> A child process that performs runs of a study one after another: its parent orders each, and takes the results. A new
!> process for each would cost as much as a short run.
module study_child
   use, intrinsic :: iso_c_binding, only: c_loc, c_size_t
   use, intrinsic :: iso_fortran_env, only: output_unit, error_unit
   use errors, only: error_type, numerics_error
   use case_inputs, only: case_type
   use parameter_study, only: study_type, run_tag
   use record, only: record_type
   use study_header, only: names_taken
   use study_row, only: study_row_type
   use packet, only: packet_type, packet_of
   use processes, only: process_id, record_length, new_process, end_child, end_with_parent, open_pipe, close_pipe, &
      & close_end, send_record, receive_record, wait_for_record, send_bytes, receive_bytes, ended
   use stop_signals, only: stop_requested
   implicit none (type, external)
   private
   public :: child_type, report_type, read_report, study_runner_type, pause

   !> Who performs the runs of a study.
   type, abstract :: study_runner_type
   contains
      procedure(perform_run), deferred :: perform
      procedure(name_of_file), deferred :: own_file
   end type study_runner_type

   abstract interface
      !> Performs a run of a study, and prints nothing. Its results are in the record, which may be used again.
      subroutine perform_run(self, inputs, tag, results, error)
         import :: study_runner_type, case_type, run_tag, record_type, error_type
         class(study_runner_type), intent(in) :: self
         type(case_type), intent(in) :: inputs
         type(run_tag), intent(in) :: tag
         type(record_type), intent(inout) :: results
         type(error_type), allocatable, intent(out) :: error
      end subroutine perform_run

      !> The file of a run that has ended, relative to the folder of the study's file; empty where it has none.
      function name_of_file(self, k) result(name)
         import :: study_runner_type
         class(study_runner_type), intent(in) :: self
         integer, intent(in) :: k
         character(len=:), allocatable :: name
      end function name_of_file
   end interface

   !> Milliseconds between two looks for children that ended without a report.
   integer, parameter :: pause = 100
   !> Runs that a child runs before a new one replaces it, so that what they may leave in memory does not add up.
   integer, parameter :: runs_a_child = 50
   !> In the report of a run: its number and status, the length of its row, and whether its child stays; its message
   !> follows.
   character(len=*), parameter :: head_format = '(ss,3i12,l1,a)'
   integer, parameter :: head = 37

   !> What a child reports of a run that has ended.
   type :: report_type
      integer :: run = 0
      type(error_type) :: error
      !> Bytes of its row, which wait in the child's own pipe.
      integer, private :: bytes = 0
      !> Whether the child waits for the order of another.
      logical :: stays = .false.
   end type report_type

   !> A child process, if its number is not 0, and the run that it runs; 0: it waits for the order of another.
   type :: child_type
      integer :: process = 0, run = 0
      !> The pipes of its orders and of its results.
      integer :: orders(2) = -1, returns(2) = -1
      !> The row of its last run.
      type(study_row_type) :: row
      !> How it ended, where that is known before its last report is read.
      character(len=:), allocatable :: how
   contains
      procedure :: start
      procedure :: order
      procedure :: receive
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

   !> Takes the row that a report announces; `ok` is false where the child has ended before it sent it.
   subroutine receive(child, report, ok)
      class(child_type), intent(inout) :: child
      type(report_type), intent(in) :: report
      logical, intent(out) :: ok
      character(len=:), allocatable, target :: bytes
      type(packet_type) :: packed
      allocate (character(len=report%bytes) :: bytes)
      ok = receive_bytes(child%returns(1), c_loc(bytes), int(report%bytes, c_size_t))
      if (.not. ok) return
      packed = packet_of(bytes)
      call child%row%exchange(packed)
   end subroutine receive

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
      call close_end(child%returns(1))
      child%process = 0
      child%run = 0
   end subroutine wait_for_end

   !> Starts a child, which waits for orders; `child` has no process where none could be started.
   subroutine start(child, study, pipe, runner)
      class(child_type), intent(inout) :: child
      type(study_type), intent(in) :: study
      integer, intent(in) :: pipe
      class(study_runner_type), intent(in) :: runner
      integer :: parent, process
      if (.not. open_pipe(child%orders)) return
      if (.not. open_pipe(child%returns)) then
         call close_pipe(child%orders)
         return
      end if
      parent = process_id()
      ! what is buffered here would else be written by both
      flush (output_unit)
      flush (error_unit)
      process = new_process()
      if (process == 0) then
         call end_with_parent(parent)
         call close_end(child%returns(1))
         call run_in_child(study, child%orders(1), child%returns(2), pipe, runner)
      else if (process < 0) then
         call close_pipe(child%orders)
         call close_pipe(child%returns)
      else
         child%process = process
         ! so that the end of the child is the end of its results
         call close_end(child%returns(2))
      end if
   end subroutine start

   !> What a child does: it performs the runs that it is ordered to, and sends a report and the results of each. It ends
   !> after one that failed at a file or for want of memory, as a library may then be in a bad state.
   subroutine run_in_child(study, orders, returns, pipe, runner)
      type(study_type), intent(in) :: study
      !> The end of a pipe that its orders come from, and those of the pipes for its results and for its reports.
      integer, intent(in) :: orders, returns, pipe
      class(study_runner_type), intent(in) :: runner
      type(record_type) :: results
      type(study_row_type) :: row
      integer :: k, count
      logical :: stays
      call row%begin(names_taken(study))
      do count = 1, runs_a_child
         call receive_order(orders, k)
         if (k == 0) exit
         call run_one(study, k, returns, pipe, count < runs_a_child, runner, results, row, stays)
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

   !> Performs a run and sends its report, with whether the child stays for another, and its results.
   subroutine run_one(study, k, returns, pipe, may_stay, runner, results, row, stays)
      type(study_type), intent(in) :: study
      integer, intent(in) :: k, returns, pipe
      logical, intent(in) :: may_stay
      class(study_runner_type), intent(in) :: runner
      type(record_type), intent(inout) :: results
      type(study_row_type), intent(inout) :: row
      logical, intent(out) :: stays
      type(case_type) :: inputs
      type(run_tag) :: tag
      type(error_type), allocatable :: error
      character(len=record_length) :: record
      character(len=:), allocatable, target :: bytes
      type(packet_type) :: packed
      call study%tag(k, tag)
      call study%inputs(k, inputs, error)
      call results%clear()
      if (.not. allocated(error)) call runner%perform(inputs, tag, results, error)
      if (.not. allocated(error)) error = error_type(0, '')
      stays = may_stay .and. any(error%status == [0, numerics_error])
      call row%make(results, error%status == 0)
      call row%exchange(packed)
      bytes = packed%bytes()
      write (record, head_format) k, error%status, len(bytes), stays, &
         & error%message(:min(len(error%message), record_length - head))
      call send_record(pipe, record)
      ! where the parent has gone, so does this process
      stays = send_bytes(returns, c_loc(bytes), len(bytes, c_size_t)) .and. stays
   end subroutine run_one

   !> Takes a report out of a pipe where one waits; `ok` is false where that failed.
   subroutine read_report(pipe, report, ok)
      integer, intent(in) :: pipe
      type(report_type), intent(out) :: report
      logical, intent(out) :: ok
      character(len=record_length) :: record
      ok = receive_record(pipe, record)
      if (.not. ok) return
      read (record(:head), head_format) report%run, report%error%status, report%bytes, report%stays
      report%error%message = trim(record(head + 1:))
   end subroutine read_report
end module study_child
