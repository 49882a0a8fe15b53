!> Locks: one holder at a time, dead ones taken over, those on other machines watched.
program test_file_lock
   use errors, only: error_type, system_error
   use text, only: to_text
   use files, only: delete_file, rename_file
   use processes, only: host_name, process_id, new_process, stop_process, ended, pause_seconds
   use file_lock, only: file_lock_type
   use scratch, only: file_there, write_bytes, bytes_of
   use check, only: runs, expect, expect_no_error, expect_error, report
   implicit none (type, external)
   character(len=*), parameter :: newline = achar(10)
   character(len=:), allocatable :: path, lock_file

   path = 'test_file_lock_'//to_text(int(process_id()))//'.h5'
   lock_file = path//'.lock'
   if (runs('free_place')) call free_place()
   if (runs('dead_holder')) call dead_holder()
   if (runs('holder_elsewhere')) call holder_elsewhere()
   if (runs('living_holder_elsewhere')) call living_holder_elsewhere()
   if (runs('lost_lock')) call lost_lock()
   if (runs('other_files')) call other_files()
   if (runs('files_left')) call files_left()
   if (runs('no_place')) call no_place()
   call delete_file(lock_file)
   call report()

contains

   !> A lock file that nobody has locked.
   subroutine leave_lock(text)
      character(len=*), intent(in) :: text
      call write_bytes(lock_file, text//newline)
   end subroutine leave_lock

   !> The lock file says that this process holds it, with these beats and files.
   subroutine expect_ours(beats, what)
      character(len=*), intent(in) :: beats, what
      character(len=:), allocatable :: found
      found = bytes_of(lock_file)
      call expect(trim(found(:len(found) - 1)) == host_name()//' '//to_text(int(process_id()))//' '//beats, what)
   end subroutine expect_ours

   subroutine free_place()
      type(file_lock_type) :: lock
      type(error_type), allocatable :: error
      call lock%acquire(path, error)
      call expect_no_error(error, 'a free place is locked')
      call expect(lock%taken_from == '', 'from nobody')
      call expect_ours('0', 'the lock says who holds it')
      call lock%beat(9)
      call lock%beat(10)
      call lock%beat(19)
      call lock%beat(25)
      call expect_ours('2', 'a beat in ten seconds')
      call expect(lock%is_ours(), 'it is ours')
      call lock%release()
      call expect(.not. file_there(lock_file), 'released it is gone')
      call lock%release()
      call lock%beat(100)
      call expect(.not. file_there(lock_file), 'and no longer beats')
   end subroutine free_place

   !> Its lock file stayed, the system freed its lock: taken at once.
   subroutine dead_holder()
      type(file_lock_type) :: lock
      type(error_type), allocatable :: error
      call leave_lock(host_name()//' 999999 7')
      call lock%acquire(path, error)
      call expect_no_error(error, 'the place of a dead process is taken')
      call expect(lock%taken_from == 'process 999999 on '//host_name(), 'and it is told whose')
      call lock%release()
      ! as the fall of a machine may leave it
      call leave_lock('')
      call lock%acquire(path, error)
      call expect_no_error(error, 'an empty lock file is nobody''s')
      call lock%release()
   end subroutine dead_holder

   !> A lock that is free here may be held there, where locks do not reach across; without a sign of life it is
   !> taken after a while.
   subroutine holder_elsewhere()
      type(file_lock_type) :: lock
      type(error_type), allocatable :: error
      integer :: start, finish, rate
      call leave_lock('another-machine 12 7')
      lock%watch_free = 2
      call system_clock(start, rate)
      call lock%acquire(path, error)
      call system_clock(finish)
      call expect_no_error(error, 'the place of a silent holder elsewhere is taken')
      call expect(lock%taken_from == 'process 12 on another-machine', 'and it is told whose')
      call expect(finish - start >= 2*rate, 'not before it was watched')
      call lock%release()
   end subroutine holder_elsewhere

   !> With one it is refused.
   subroutine living_holder_elsewhere()
      type(file_lock_type) :: lock
      type(error_type), allocatable :: error
      character(len=:), allocatable :: how
      integer :: child
      logical :: found
      call leave_lock('another-machine 12 7')
      lock%watch_free = 60
      child = new_process()
      if (child == 0) call beat_for_ever()
      call lock%acquire(path, error)
      call stop_process(child)
      found = ended(child, .true., how)
      call delete_file(path//'.next')
      call expect_error(error, system_error, 'process 12 on another-machine', 'a living holder elsewhere')
      call expect(file_there(lock_file), 'its lock is left alone')
   end subroutine living_holder_elsewhere

   !> A holder elsewhere. It replaces the lock file at once, so that nobody reads a part of it.
   subroutine beat_for_ever()
      integer :: beats
      logical :: ok
      beats = 7
      do
         beats = beats + 1
         call write_bytes(path//'.next', 'another-machine 12 '//to_text(beats)//newline)
         ok = rename_file(path//'.next', lock_file)
         call pause_seconds(1)
      end do
   end subroutine beat_for_ever

   !> Who was taken for dead notices, writes no more beats and leaves the lock to its new holder.
   subroutine lost_lock()
      type(file_lock_type) :: lock
      type(error_type), allocatable :: error
      call delete_file(lock_file)
      call lock%acquire(path, error)
      call leave_lock('another-machine 12 7')
      call expect(.not. lock%is_ours(), 'another''s now')
      call lock%beat(100)
      call lock%release()
      call expect(file_there(lock_file), 'and left to it')
      call expect(bytes_of(lock_file) == 'another-machine 12 7'//newline, 'as it was')
      call delete_file(lock_file)
      call lock%acquire(path, error)
      call delete_file(lock_file)
      call expect(.not. lock%is_ours(), 'a deleted lock is nobody''s')
      call lock%release()
   end subroutine lost_lock

   !> What has the name of the lock file and is none is refused, and stays as it is.
   subroutine other_files()
      call expect_refused("printf 'notes\n' > $LOCK", "test ""$(cat $LOCK)"" = notes", 'a text')
      call expect_refused("printf 'node1 12 x\n' > $LOCK", "test -f $LOCK", 'no count of beats')
      call expect_refused("printf 'node1 12 7 and more\n' > $LOCK", "test -f $LOCK", 'more than a lock says')
      call expect_refused("printf 'node1 12 7\nmore\n' > $LOCK", "test -f $LOCK", 'a second line')
      call expect_refused("printf 'node1 12 7' > $LOCK", "test -f $LOCK", 'a line without its end')
      call expect_refused("printf '%400d 7 7\n' 1 > $LOCK", "test -f $LOCK", 'a long line')
      call expect_refused("echo kept > $LOCK.1; ln -s $LOCK.1 $LOCK", "test ""$(cat $LOCK.1)"" = kept; rm $LOCK.1", &
         & 'a symbolic link')
      call expect_refused("ln -s $LOCK.none $LOCK", "test ! -e $LOCK.none", 'a link to nothing')
      call expect_refused("echo node1 12 7 > $LOCK.1; ln $LOCK.1 $LOCK", &
         & "test ""$(cat $LOCK.1)"" = 'node1 12 7'; rm $LOCK.1", 'a second name of a file')
      call expect_refused("mkfifo $LOCK", "test -p $LOCK", 'a pipe')
      call expect_refused("mkdir $LOCK", "rmdir $LOCK", 'a folder')
   end subroutine other_files

   subroutine expect_refused(make, check, what)
      !> Shell commands, in which $LOCK is the lock file; `check` succeeds where it is as it was.
      character(len=*), intent(in) :: make, check, what
      type(file_lock_type) :: lock
      type(error_type), allocatable :: error
      integer :: status
      call delete_file(lock_file)
      call execute_command_line('LOCK='//path//'.lock; '//make, exitstat=status)
      call lock%acquire(path, error)
      call expect_error(error, system_error, lock_file//' is no lock file of tiltpad', what//' is refused')
      call execute_command_line('LOCK='//path//'.lock; '//check, exitstat=status)
      call expect(status == 0, what//' stays as it was')
      call delete_file(lock_file)
   end subroutine expect_refused

   !> The files that a holder noted are told to the next one, if it died.
   subroutine files_left()
      type(file_lock_type) :: lock
      type(error_type), allocatable :: error
      call leave_lock(host_name()//' 999999 7 12:34.5 6:7.8')
      call lock%acquire(path, error)
      call expect_no_error(error, 'a dead holder with files')
      call expect(lock%files_left == '12:34.5 6:7.8', 'its files: '//lock%files_left)
      call lock%note_files('1:2.3')
      call expect_ours('0 1:2.3', 'ours: '//bytes_of(lock_file))
      call lock%release()
      call lock%acquire(path, error)
      call expect(lock%files_left == '' .and. lock%taken_from == '', 'none where it ended well')
      call lock%release()
   end subroutine files_left

   subroutine no_place()
      type(file_lock_type) :: lock
      type(error_type), allocatable :: error
      call lock%acquire('no_such_folder/run.h5', error)
      call expect_error(error, system_error, '', 'no lock where there is no folder')
   end subroutine no_place
end program test_file_lock
