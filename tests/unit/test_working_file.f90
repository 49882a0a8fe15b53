!> Working files: what stands under the file's name at each moment, and beside it.
program test_working_file
   use errors, only: error_type, system_error
   use files, only: delete_file, file_identity
   use processes, only: host_name
   use scratch, only: scratch_path, file_there, write_bytes, bytes_of
   use working_file, only: working_file_type
   use check, only: runs, expect, expect_no_error, expect_error, report
   implicit none (type, external)
   character(len=:), allocatable :: path

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
      call execute_command_line('mkdir '//path//' && touch '//path//'/file', exitstat=status)
      call expect_unpublished(work, 'cannot rename '//path//'.part, which is whole', 'a folder in the way')
      call expect(work%stranded, 'the part is all there is')
      call work%release()
      call expect(bytes_of(path//'.part') == 'new', 'and stays')
      call execute_command_line('rm -r '//path, exitstat=status)
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
      call execute_command_line('ln -s '//path//' '//link, exitstat=status)
      call work%claim(link, error)
      call expect_no_error(error, 'a link is claimed')
      call expect(work%path == path .and. work%part == path//'.part', 'for the file that it leads to: '//work%path)
      call write_part(work, 'new')
      call publish(work, .false.)
      call work%release()
      call expect_files('new', '(none)', 'behind the link')
      call execute_command_line('test -L '//link, exitstat=status)
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
end program test_working_file
