!> Working files: what stands under the file's name at each moment, and beside it; locks: one holder at a time, dead
!> ones taken over, those on other machines watched.
program test_working_file
   use errors, only: error_type, system_error
   use files, only: delete_file, file_identity, rename_file
   use processes, only: host_name, process_id, new_process, stop_process, ended, pause_seconds
   use scratch, only: scratch_path, for_shell, file_there, write_bytes, bytes_of
   use working_file, only: working_file_type
   use text, only: to_text
   use file_lock, only: file_lock_type
   use check, only: runs, expect, expect_no_error, expect_error, report
   implicit none (type, external)
   character(len=:), allocatable :: path
   character(len=*), parameter :: newline = achar(10)
   character(len=:), allocatable :: place, lock_file

   path = scratch_path('work')
   if (runs('first_time')) call first_time()
   if (runs('again')) call again()
   if (runs('continued')) call continued()
   if (runs('parts_of_before')) call parts_of_before()
   if (runs('replaced_meanwhile')) call replaced_meanwhile()
   if (runs('given_up')) call given_up()
   if (runs('lock_gone')) call lock_gone()
   if (runs('cannot_be_renamed')) call cannot_be_renamed()
   if (runs('behind_a_link')) call behind_a_link()
   if (runs('no_place')) call no_place()
   call clear()
   place = 'test_file_lock_'//to_text(process_id())//'.h5'
   lock_file = place//'.lock'
   if (runs('free_place')) call free_place()
   if (runs('dead_holder')) call dead_holder()
   if (runs('holder_elsewhere')) call holder_elsewhere()
   if (runs('living_holder_elsewhere')) call living_holder_elsewhere()
   if (runs('lost_lock')) call lost_lock()
   if (runs('other_files')) call other_files()
   if (runs('files_left')) call files_left()
   if (runs('no_place_for_a_lock')) call no_place_for_a_lock()
   call delete_file(lock_file)
   call report()

contains

   !> Deletes all that a case may leave.
   subroutine clear()
      call delete_file(path)
      call delete_file(path//'.part')
      call delete_file(path//'.part2')
      call delete_file(path//'.lock')
   end subroutine clear

   !> The contents of the file, of its part, and whether anything else is beside it.
   subroutine expect_files(whole, part, what)
      character(len=*), intent(in) :: whole, part, what
      call expect(bytes_of(path) == whole, what//': the file is '//bytes_of(path))
      call expect(bytes_of(path//'.part') == part, what//': its part is '//bytes_of(path//'.part'))
      call expect(.not. file_there(path//'.part2'), what//': nothing else')
   end subroutine expect_files

   subroutine claim(work)
      type(working_file_type), intent(inout) :: work
      type(error_type), allocatable :: error
      call work%claim(path, error)
      call expect_no_error(error, 'the name is claimed')
      call expect(file_there(path//'.lock'), 'and locked')
   end subroutine claim

   !> A part with these bytes, where nothing else is but, perhaps, a file of before.
   subroutine begin(work, part, before)
      type(working_file_type), intent(inout) :: work
      character(len=*), intent(in) :: part
      character(len=*), intent(in), optional :: before
      call clear()
      if (present(before)) call write_bytes(path, before)
      call claim(work)
      call write_part(work, part)
   end subroutine begin

   !> Writes the part, which is made if it is not there.
   subroutine write_part(work, bytes)
      type(working_file_type), intent(inout) :: work
      character(len=*), intent(in) :: bytes
      type(error_type), allocatable :: error
      integer :: unit
      if (.not. file_there(work%part)) call work%make_part(error)
      call expect_no_error(error, 'a part')
      open (newunit=unit, file=work%part, access='stream', form='unformatted', status='old', action='write')
      write (unit) bytes
      close (unit)
   end subroutine write_part

   subroutine publish(work, expected)
      type(working_file_type), intent(inout) :: work
      logical, intent(in) :: expected
      type(error_type), allocatable :: error
      logical :: exchanged
      call work%publish(exchanged, error)
      call expect_no_error(error, 'published')
      call expect(exchanged .eqv. expected, 'whether the part is what was published before')
   end subroutine publish

   !> What cannot be published is told in these words.
   subroutine expect_unpublished(work, words, what)
      type(working_file_type), intent(inout) :: work
      character(len=*), intent(in) :: words, what
      type(error_type), allocatable :: error
      logical :: exchanged
      call work%publish(exchanged, error)
      call expect_error(error, system_error, words, what)
   end subroutine expect_unpublished

   !> A file of before stays until there is a whole new one.
   subroutine first_time()
      type(working_file_type) :: work
      call begin(work, 'new', before='before')
      call expect_files('before', 'new', 'while it is written')
      call publish(work, .false.)
      call expect_files('new', '(none)', 'published')
      call work%release()
      call expect_files('new', '(none)', 'released')
      call expect(.not. file_there(path//'.lock'), 'the lock is gone')
   end subroutine first_time

   !> Publishing again exchanges the two.
   subroutine again()
      type(working_file_type) :: work
      call begin(work, '1')
      call publish(work, .false.)
      call write_part(work, '12')
      call publish(work, .true.)
      call expect_files('12', '1', 'the second time')
      call write_part(work, '123')
      call publish(work, .true.)
      call expect_files('123', '12', 'the third time')
      call work%release()
      call expect_files('123', '(none)', 'released')
   end subroutine again

   !> The copy is a file of its own; one that was there before is not the run's, and not exchanged.
   subroutine continued()
      type(working_file_type) :: work
      type(error_type), allocatable :: error
      call clear()
      call write_bytes(path, 'before')
      call claim(work)
      call work%copy_published(error)
      call expect_no_error(error, 'copied')
      call expect_files('before', 'before', 'copied')
      call write_part(work, 'more..')
      call expect_files('before', 'more..', 'changed')
      call publish(work, .false.)
      call expect_files('more..', '(none)', 'published')
      call work%release()
      call clear()
      call claim(work)
      call work%copy_published(error)
      call expect_error(error, system_error, 'cannot write '//path//'.part', 'nothing to copy')
      call work%release()
   end subroutine continued

   !> The parts of a run that was killed are deleted, by their identity; what else has the name stays, and another name
   !> is taken.
   subroutine parts_of_before()
      type(working_file_type) :: work
      call clear()
      call write_bytes(path//'.part', 'of the dead run')
      call leave_lock(file_identity(path//'.part'))
      call claim(work)
      call expect_files('(none)', '(none)', 'its part is gone')
      call expect(work%part == path//'.part', 'and its name is used again')
      call work%release()

      call write_bytes(path//'.part', 'precious')
      call leave_lock('1:2.3')
      call claim(work)
      call expect(work%part == path//'.part2', 'another name: '//work%part)
      call write_part(work, 'new')
      call publish(work, .false.)
      call work%release()
      call expect_files('new', 'precious', 'what was there stays')

      ! killed while it made the part
      call write_bytes(path//'.part', '')
      call leave_lock('0')
      call claim(work)
      call expect_files('new', '(none)', 'an empty part is deleted')
      call work%release()
      call write_bytes(path//'.part', 'precious')
      call leave_lock('0')
      call claim(work)
      call expect_files('new', 'precious', 'another file is not')

      ! a file that takes the place of the part meanwhile
      call write_part(work, 'newer')
      call delete_file(work%part)
      call write_bytes(work%part, '')
      call work%release()
      call expect(file_there(work%part), 'is not deleted')
   end subroutine parts_of_before

   !> The lock file of a run that was killed, with the files that it had made.
   subroutine leave_lock(files)
      character(len=*), intent(in) :: files
      call write_bytes(path//'.lock', host_name()//' 999999 7 '//files//achar(10))
   end subroutine leave_lock

   !> A file that somebody puts in the place of the result while the run writes is not replaced.
   subroutine replaced_meanwhile()
      type(working_file_type) :: work
      type(error_type), allocatable :: error
      call begin(work, 'new', before='before')
      call delete_file(path)
      call write_bytes(path, 'precious')
      call expect_unpublished(work, 'something else has been put there', 'a file put there meanwhile')
      call work%release()
      call expect_files('precious', 'new', 'both stay')
      call begin(work, 'new')
      call publish(work, .false.)
      call delete_file(path)
      call work%copy_published(error)
      call expect_error(error, system_error, 'cannot write', 'a result that was removed cannot be copied')
      call work%release()
   end subroutine replaced_meanwhile

   subroutine given_up()
      type(working_file_type) :: work
      call begin(work, 'half', before='before')
      call work%release()
      call expect_files('before', '(none)', 'given up')
      call expect(.not. file_there(path//'.lock'), 'the lock is gone')
   end subroutine given_up

   !> A run that has lost its lock writes and deletes nothing any more: it may be another's.
   subroutine lock_gone()
      type(working_file_type) :: work
      call begin(work, 'new', before='before')
      call delete_file(path//'.lock')
      call expect_unpublished(work, 'its lock is gone', 'publishing without the lock')
      call work%release()
      call expect_files('before', 'new', 'nothing changed')
   end subroutine lock_gone

   !> What is whole is kept under the name of the part. A folder in the file's way cannot be replaced.
   subroutine cannot_be_renamed()
      type(working_file_type) :: work
      integer :: status
      call begin(work, 'new')
      call execute_command_line('mkdir '//for_shell(path)//' && touch '//for_shell(path//'/file'), exitstat=status)
      call expect_unpublished(work, 'cannot rename '//path//'.part, which is whole', 'a folder in the way')
      call expect(work%stranded, 'the part is all there is')
      call work%release()
      call expect(bytes_of(path//'.part') == 'new', 'and stays')
      call execute_command_line('rm -r '//for_shell(path), exitstat=status)
   end subroutine cannot_be_renamed

   !> The file that a link leads to is replaced, and the link stays.
   subroutine behind_a_link()
      type(working_file_type) :: work
      character(len=:), allocatable :: link
      type(error_type), allocatable :: error
      integer :: status
      call clear()
      link = scratch_path('link')
      call write_bytes(path, 'before')
      call execute_command_line('ln -s '//for_shell(path)//' '//for_shell(link), exitstat=status)
      call work%claim(link, error)
      call expect_no_error(error, 'a link is claimed')
      call expect(work%path == path .and. work%part == path//'.part', 'for the file that it leads to: '//work%path)
      call write_part(work, 'new')
      call publish(work, .false.)
      call work%release()
      call expect_files('new', '(none)', 'behind the link')
      call execute_command_line('test -L '//for_shell(link), exitstat=status)
      call expect(status == 0, 'the link is still one')
      call delete_file(link)
   end subroutine behind_a_link

   subroutine no_place()
      type(working_file_type) :: work
      type(error_type), allocatable :: error
      call work%claim('src_f90', error)
      call expect_error(error, system_error, 'cannot write src_f90: it is a directory, device or pipe', 'a folder')
      call work%claim('/dev/null', error)
      call expect_error(error, system_error, 'it is a directory, device or pipe', 'a device')
      call work%claim('no/such/folder/file', error)
      call expect_error(error, system_error, 'cannot write no/such/folder/file', 'no folder')
   end subroutine no_place

   !> A lock file that nobody has locked.
   subroutine write_lock(text)
      character(len=*), intent(in) :: text
      call write_bytes(lock_file, text//newline)
   end subroutine write_lock

   !> The lock file says that this process holds it, with these heartbeats and files.
   subroutine expect_ours(heartbeats, what)
      character(len=*), intent(in) :: heartbeats, what
      character(len=:), allocatable :: found
      found = bytes_of(lock_file)
      call expect(trim(found(:len(found) - 1)) == host_name()//' '//to_text(process_id())//' '//heartbeats, what)
   end subroutine expect_ours

   subroutine free_place()
      type(file_lock_type) :: lock
      type(error_type), allocatable :: error
      call lock%acquire(place, error)
      call expect_no_error(error, 'a free place is locked')
      call expect(lock%taken_from == '', 'from nobody')
      call expect_ours('0', 'the lock says who holds it')
      call lock%heartbeat(9)
      call lock%heartbeat(10)
      call lock%heartbeat(19)
      call lock%heartbeat(25)
      call expect_ours('2', 'a heartbeat in ten seconds')
      call expect(lock%is_ours(), 'it is ours')
      call lock%release()
      call expect(.not. file_there(lock_file), 'released it is gone')
      call lock%release()
      call lock%heartbeat(100)
      call expect(.not. file_there(lock_file), 'and no heartbeat comes')
   end subroutine free_place

   !> Its lock file stayed, the system freed its lock: taken at once.
   subroutine dead_holder()
      type(file_lock_type) :: lock
      type(error_type), allocatable :: error
      call write_lock(host_name()//' 999999 7')
      call lock%acquire(place, error)
      call expect_no_error(error, 'the place of a dead process is taken')
      call expect(lock%taken_from == 'process 999999 on '//host_name(), 'and it is told whose')
      call lock%release()
      ! as the fall of a machine may leave it: cut, or empty
      call write_bytes(lock_file, host_name()//' 999999 7   ')
      call lock%acquire(place, error)
      call expect_no_error(error, 'the place of a lock that was cut is taken')
      if (allocated(error)) return
      call expect_ours('0', 'and is ours: '//bytes_of(lock_file))
      call lock%release()
      call write_lock('')
      call lock%acquire(place, error)
      call expect_no_error(error, 'an empty lock file is nobody''s')
      call lock%release()
   end subroutine dead_holder

   !> A lock that is free here may be held there, where locks do not reach across; without a sign of life it is
   !> taken after a while.
   subroutine holder_elsewhere()
      type(file_lock_type) :: lock
      type(error_type), allocatable :: error
      integer :: start, finish, rate
      call write_lock('another-machine 12 7')
      lock%watch_free = 2
      call system_clock(start, rate)
      call lock%acquire(place, error)
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
      call write_lock('another-machine 12 7')
      lock%watch_free = 60
      child = new_process()
      if (child == 0) call send_heartbeats()
      call lock%acquire(place, error)
      call stop_process(child)
      found = ended(child, .true., how)
      call delete_file(place//'.next')
      call expect_error(error, system_error, 'process 12 on another-machine', 'a living holder elsewhere')
      call expect(file_there(lock_file), 'its lock is left alone')
   end subroutine living_holder_elsewhere

   !> A holder elsewhere. It replaces the lock file at once, so that nobody reads a part of it.
   subroutine send_heartbeats()
      integer :: heartbeats
      logical :: ok
      heartbeats = 7
      do
         heartbeats = heartbeats + 1
         call write_bytes(place//'.next', 'another-machine 12 '//to_text(heartbeats)//newline)
         ok = rename_file(place//'.next', lock_file)
         call pause_seconds(1)
      end do
   end subroutine send_heartbeats

   !> Who was taken for dead notices, writes no more heartbeats and leaves the lock to its new holder.
   subroutine lost_lock()
      type(file_lock_type) :: lock
      type(error_type), allocatable :: error
      call delete_file(lock_file)
      call lock%acquire(place, error)
      call write_lock('another-machine 12 7')
      call expect(.not. lock%is_ours(), 'another''s now')
      call lock%heartbeat(100)
      call lock%release()
      call expect(file_there(lock_file), 'and left to it')
      call expect(bytes_of(lock_file) == 'another-machine 12 7'//newline, 'as it was')
      call delete_file(lock_file)
      call lock%acquire(place, error)
      call delete_file(lock_file)
      call expect(.not. lock%is_ours(), 'a deleted lock is nobody''s')
      call lock%release()
   end subroutine lost_lock

   !> What has the name of the lock file and is none is refused, and stays as it is.
   subroutine other_files()
      call expect_refused("printf 'notes\n' > $LOCK", "test ""$(cat $LOCK)"" = notes", 'a text')
      call expect_refused("printf 'node1 12 x\n' > $LOCK", "test -f $LOCK", 'no count of heartbeats')
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
      call execute_command_line('LOCK='//place//'.lock; '//make, exitstat=status)
      call lock%acquire(place, error)
      call expect_error(error, system_error, lock_file//' is no lock file of tiltpad', what//' is refused')
      call execute_command_line('LOCK='//place//'.lock; '//check, exitstat=status)
      call expect(status == 0, what//' stays as it was')
      call delete_file(lock_file)
   end subroutine expect_refused

   !> The files that a holder noted are told to the next one, if it died.
   subroutine files_left()
      type(file_lock_type) :: lock
      type(error_type), allocatable :: error
      call write_lock(host_name()//' 999999 7 12:34.5 6:7.8')
      call lock%acquire(place, error)
      call expect_no_error(error, 'a dead holder with files')
      call expect(lock%files_left == '12:34.5 6:7.8', 'its files: '//lock%files_left)
      call lock%note_files('1:2.3')
      call expect_ours('0 1:2.3', 'ours: '//bytes_of(lock_file))
      call lock%release()
      call lock%acquire(place, error)
      call expect(lock%files_left == '' .and. lock%taken_from == '', 'none where it ended well')
      call lock%release()
   end subroutine files_left

   subroutine no_place_for_a_lock()
      type(file_lock_type) :: lock
      type(error_type), allocatable :: error
      call lock%acquire('no_such_folder/run.h5', error)
      call expect_error(error, system_error, '', 'no lock where there is no folder')
   end subroutine no_place_for_a_lock
end program test_working_file
