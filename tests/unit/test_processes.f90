!> Child processes: how they end, what they send, signals that are noted.
program test_processes
   use text, only: to_text
   use processes, only: process_id, process_alive, host_name, processors, new_process, end_child, limit_child, &
      & end_with_parent, ended, stop_process, record_length, open_pipe, close_pipe, send_record, receive_record, &
      & wait_for_record, pause_seconds
   use stop_signals, only: catch_signals, stop_requested, stop_reason
   use check, only: runs, expect, report
   implicit none (type, external)

   if (runs('statuses')) call statuses()
   if (runs('signals')) call signals()
   if (runs('time_limit')) call time_limit()
   if (runs('records')) call records()
   if (runs('orphans')) call orphans()
   if (runs('this_process')) call this_process()
   call report()

contains

   subroutine expect_end(child, how_expected)
      integer, intent(in) :: child
      character(len=*), intent(in) :: how_expected
      character(len=:), allocatable :: how
      logical :: found
      found = ended(child, .true., how)
      call expect(found, 'ended')
      call expect(index(how, how_expected) == 1, how_expected//': '//how)
   end subroutine expect_end

   subroutine statuses()
      integer :: status, child
      do status = 0, 255, 51
         child = new_process()
         if (child == 0) call end_child(status)
         call expect_end(child, 'ended with status '//to_text(status)//' ')
      end do
      call expect(.not. process_alive(child), 'it is no more')
      child = process_id()
      call expect(.not. was_mine(child), 'who is no child has not ended')
   end subroutine statuses

   logical function was_mine(process)
      integer, intent(in) :: process
      character(len=:), allocatable :: how
      was_mine = ended(process, .true., how)
   end function was_mine

   !> A child ends by SIGTERM, unless it notes signals; then it sees which came.
   subroutine signals()
      integer :: child, ends(2)
      character(len=record_length) :: record
      character(len=:), allocatable :: how
      logical :: ok
      child = new_process()
      if (child == 0) call wait_for_ever()
      call expect(process_alive(child), 'a child that waits')
      ok = ended(child, .false., how)
      call expect(.not. ok, 'has not ended')
      call stop_process(child)
      call expect_end(child, 'ended by signal 15')
      call open_pipe(ends, ok)
      child = new_process()
      if (child == 0) then
         call catch_signals()
         record = merge('early', 'ready', stop_requested())
         call send_record(ends(2), record)
         do while (.not. stop_requested())
            call pause_seconds(1)
         end do
         record = stop_reason()
         call send_record(ends(2), record)
         call end_child(7)
      end if
      call receive_record(ends(1), record, ok)
      call expect(record == 'ready', 'no signal yet')
      call stop_process(child)
      call receive_record(ends(1), record, ok)
      call expect(record == 'stopped by signal 15', 'noted: '//trim(record))
      call expect_end(child, 'ended with status 7 ')
      call close_pipe(ends)
   end subroutine signals

   subroutine wait_for_ever()
      do
         call pause_seconds(60)
      end do
   end subroutine wait_for_ever

   !> A child with a limit of time ends by its alarm, and prints nothing.
   subroutine time_limit()
      integer :: child
      child = new_process()
      if (child == 0) then
         call limit_child(1, 60, 1000)
         print '(a)', '1 passed, 1000 failed'
         call wait_for_ever()
      end if
      call expect_end(child, 'ended by signal 14')
   end subroutine time_limit

   !> Records arrive whole and in order; waiting for one ends where there is none.
   subroutine records()
      integer :: ends(2), child, k
      character(len=record_length) :: record
      logical :: ok, waits
      call open_pipe(ends, ok)
      call expect(ok, 'a pipe')
      waits = wait_for_record(ends(1), 10)
      call expect(.not. waits, 'an empty one')
      child = new_process()
      if (child == 0) then
         do k = 1, 100
            record = to_text(k)
            record(record_length:) = 'x'
            call send_record(ends(2), record)
         end do
         call end_child(0)
      end if
      do k = 1, 100
         waits = wait_for_record(ends(1), 60000)
         call receive_record(ends(1), record, ok)
         call expect(waits .and. ok .and. record(:len(to_text(k)) + 1) == to_text(k) .and. &
            & record(record_length:) == 'x', 'record '//to_text(k))
      end do
      waits = wait_for_record(ends(1), 0)
      call expect(.not. waits, 'and no more')
      call expect_end(child, 'ended with status 0 ')
      call close_pipe(ends)
      call receive_record(ends(1), record, ok)
      call expect(.not. ok, 'none from a closed pipe')
   end subroutine records

   !> A child whose parent has ended, or is not who it takes for it, ends.
   subroutine orphans()
      integer :: child
      child = new_process()
      if (child == 0) then
         call end_with_parent(1)
         call end_child(0)
      end if
      call expect_end(child, 'ended with status 1 ')
      child = new_process()
      if (child == 0) then
         call end_with_parent(int(process_id()))
         call end_child(0)
      end if
      call expect_end(child, 'ended with status 1 ')
   end subroutine orphans

   subroutine this_process()
      character(len=:), allocatable :: name
      call expect(process_alive(int(process_id())), 'it runs')
      call expect(processors() >= 1, 'on a processor')
      name = host_name()
      call expect(len(name) > 0 .and. index(name, ' ') == 0, 'of a machine with a name: '//name)
   end subroutine this_process
end program test_processes
