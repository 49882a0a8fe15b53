!> What the system does with files and processes: names, copies, links, kinds; how children end, what they send.
program test_files
   use files, only: rename_file, exchange_files, delete_file, create_file, copy_file, sync_file, begin_sync, &
      & real_path, is_regular, file_identity, make_folder, remove_folder
   use processes, only: process_id, process_alive, host_name, processors, new_process, end_child, limit_child, &
      & end_with_parent, ended, stop_process, record_length, open_pipe, close_pipe, send_record, receive_record, &
      & wait_for_record, pause_seconds
   use system_texts, only: system_reason
   use scratch, only: scratch_path, for_shell, file_there, write_bytes, bytes_of
   use text, only: to_text
   use stop_signals, only: catch_signals, stop_requested, stop_reason
   use check, only: runs, expect, report
   implicit none (type, external)
   character(len=:), allocatable :: path, other

   path = scratch_path('a')
   other = scratch_path('b')
   if (runs('names')) call names()
   if (runs('identities')) call identities()
   if (runs('copies')) call copies()
   if (runs('kinds')) call kinds_of_files()
   if (runs('links')) call links()
   if (runs('to_disk')) call to_disk()
   call delete_file(path)
   call delete_file(other)
   if (runs('statuses')) call statuses()
   if (runs('signals')) call signals()
   if (runs('time_limit')) call time_limit()
   if (runs('records')) call records()
   if (runs('orphans')) call orphans()
   if (runs('this_process')) call this_process()
   call report()

contains

   subroutine names()
      call write_bytes(path, 'first')
      call write_bytes(other, 'second')
      call expect(logical(rename_file(path, other)), 'a name that another file has')
      call expect(.not. file_there(path), 'the old name is gone')
      call expect(bytes_of(other) == 'first', 'the new one has the content')
      call expect(logical(.not. rename_file(path, other)), 'what is not there cannot be renamed')
      call expect(system_reason() == 'no such file or directory', 'and the system says why: '//system_reason())
      call write_bytes(path, 'second')
      call expect(logical(exchange_files(path, other)), 'two names exchanged')
      call expect(bytes_of(path) == 'first', 'the first has the other''s content')
      call expect(bytes_of(other) == 'second', 'the other has the first''s')
      call delete_file(other)
      call delete_file(other)
      call expect(logical(.not. exchange_files(path, other)), 'there is nothing to exchange with')
      call expect(bytes_of(path) == 'first', 'and nothing changes')
   end subroutine names

   !> A file keeps its identity under another name; another file under its name, also a copy, has another.
   subroutine identities()
      character(len=:), allocatable :: first
      logical :: ok
      call delete_file(other)
      call write_bytes(path, 'x')
      first = file_identity(path)
      call expect(len(first) > 1, 'an identity: '//first)
      call expect(file_identity(other) == '', 'none where there is nothing')
      call expect(file_identity(path(:index(path, '/', back=.true.))) == '-', 'nor of a folder')
      ok = rename_file(path, other)
      call expect(file_identity(other) == first, 'a new name')
      call expect(logical(create_file(path)), 'another file')
      ok = copy_file(other, path)
      call expect(file_identity(path) /= first, 'a copy')
      call delete_file(other)
      call delete_file(path)
      call write_bytes(path, 'x')
      call expect(file_identity(path) /= first, 'a later file, though it may have the same inode')
      call execute_command_line('ln -s '//for_shell(path)//' '//for_shell(other))
      call expect(file_identity(other) == '-', 'a link is not followed')
      call delete_file(other)
   end subroutine identities

   subroutine copies()
      call write_bytes(path, repeat('0123456789', 100000))
      call write_bytes(other, repeat('x', 2000000))
      call expect(logical(.not. create_file(other)), 'what is there is not made')
      call expect(logical(copy_file(path, other)), 'a copy over a longer file')
      call expect(bytes_of(other) == repeat('0123456789', 100000), 'has all bytes and no others')
      call write_bytes(path, '')
      call expect(logical(copy_file(path, other)), 'of nothing')
      call expect(bytes_of(other) == '', 'is nothing')
      call expect(logical(.not. copy_file(scratch_path('none'), other)), 'what is not there cannot be copied')
      call delete_file(other)
      call expect(logical(.not. copy_file(path, other)), 'nor into one that is not there')
      call execute_command_line('ln -s '//for_shell(scratch_path('none'))//' '//for_shell(other))
      call expect(logical(.not. create_file(other)), 'a link to nothing is not followed')
      call expect(.not. file_there(scratch_path('none')), 'and nothing is made')
   end subroutine copies

   subroutine kinds_of_files()
      character(len=:), allocatable :: folder, refusal
      folder = scratch_path('folder')
      call write_bytes(path, 'x')
      call make_folder(folder, refusal)
      call expect(refusal == '', 'a folder is made')
      call make_folder(folder, refusal)
      call expect(refusal == '', 'one that is there is none to be made')
      call make_folder(folder//'/none/deep', refusal)
      call expect(refusal == 'no such file or directory', 'why none can be made: '//refusal)
      call expect(logical(is_regular(path)), 'a file')
      call expect(logical(.not. is_regular(folder)), 'a folder')
      call expect(logical(.not. is_regular('/dev/null')), 'a device')
      call expect(logical(.not. is_regular(scratch_path('none'))), 'nothing')
      call remove_folder(folder)
      call make_folder(path//'/x', refusal)
      call expect(refusal == 'not a directory', 'a file holds no folder: '//refusal)
   end subroutine kinds_of_files

   !> Links to links, also relative ones and to nothing; a circle of them ends.
   subroutine links()
      character(len=:), allocatable :: first, second, folder
      first = scratch_path('first')
      second = scratch_path('second')
      folder = path(:index(path, '/', back=.true.))
      call write_bytes(path, 'x')
      call execute_command_line('ln -sf '//for_shell(path)//' '//for_shell(first))
      call execute_command_line('ln -sf '//for_shell(first(len(folder) + 1:))//' '//for_shell(second))
      call expect(real_path(second) == real_path(path), 'a link to a link: '//real_path(second))
      call delete_file(path)
      call expect(real_path(second) == path, 'to nothing: '//real_path(second))
      call expect(real_path(folder//'./'//'.'//'/') == real_path(folder), 'a folder')
      call execute_command_line('ln -sf '//for_shell(second)//' '//for_shell(first))
      call expect(len(real_path(second)) > 0, 'a circle')
      call delete_file(first)
      call delete_file(second)
   end subroutine links

   subroutine to_disk()
      call write_bytes(path, 'x')
      call begin_sync(path)
      call begin_sync(scratch_path('none'))
      call expect(logical(sync_file(path)), 'a file')
      call expect(logical(sync_file(path(:index(path, '/', back=.true.))//'.')), 'a folder')
      call expect(logical(.not. sync_file(scratch_path('none'))), 'nothing')
      call expect(bytes_of(path) == 'x', 'and leaves it as it is')
   end subroutine to_disk

   subroutine expect_end(child, how_expected)
      integer, intent(in) :: child
      character(len=*), intent(in) :: how_expected
      character(len=:), allocatable :: how
      logical :: found
      found = ended(child, .true., how)
      call expect(found, 'ended')
      call expect(index(how, how_expected) == 1, how_expected//': '//how)
      call expect((how == '') .eqv. (how_expected == ''), 'says how')
   end subroutine expect_end

   subroutine statuses()
      integer :: status, child
      do status = 0, 255, 51
         child = new_process()
         if (child == 0) call end_child(status)
         if (status == 0) call expect_end(child, '')
         if (status > 0) call expect_end(child, 'ended with status '//to_text(status)//' ')
      end do
      call expect(logical(.not. process_alive(child)), 'it is no more')
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
      call expect(logical(process_alive(child)), 'a child that waits')
      ok = ended(child, .false., how)
      call expect(.not. ok, 'has not ended')
      call stop_process(child)
      call expect_end(child, 'ended by signal 15')
      ok = open_pipe(ends)
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
      ok = receive_record(ends(1), record)
      call expect(record == 'ready', 'no signal yet')
      call stop_process(child)
      ok = receive_record(ends(1), record)
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
      call expect(logical(open_pipe(ends)), 'a pipe')
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
         ok = receive_record(ends(1), record)
         call expect(waits .and. ok .and. record(:len(to_text(k)) + 1) == to_text(k) .and. &
            & record(record_length:) == 'x', 'record '//to_text(k))
      end do
      waits = wait_for_record(ends(1), 0)
      call expect(.not. waits, 'and no more')
      call expect_end(child, '')
      call close_pipe(ends)
      ok = receive_record(ends(1), record)
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
         call end_with_parent(process_id())
         call end_child(0)
      end if
      call expect_end(child, 'ended with status 1 ')
   end subroutine orphans

   subroutine this_process()
      character(len=:), allocatable :: name
      call expect(logical(process_alive(process_id())), 'it runs')
      call expect(processors() >= 1, 'on a processor')
      name = host_name()
      call expect(len(name) > 0 .and. index(name, ' ') == 0, 'of a machine with a name: '//name)
   end subroutine this_process
end program test_files
