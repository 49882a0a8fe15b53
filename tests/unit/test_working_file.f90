!> Working files: what stands under the file's name at each moment, and beside it.
program test_working_file
   use errors, only: error_type, system_error
   use files, only: delete_file, link_file
   use scratch, only: scratch_path, file_there, write_bytes, bytes_of
   use working_file, only: working_file_type
   use check, only: runs, expect, expect_no_error, expect_error, report
   implicit none (type, external)
   character(len=:), allocatable :: path

   path = scratch_path('work')
   if (runs('first_time')) call first_time()
   if (runs('again')) call again()
   if (runs('continued')) call continued()
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
      call delete_file(path//'.old')
      call delete_file(path//'.lock')
   end subroutine clear

   !> The contents of the file, of its part, and whether anything else is beside it.
   subroutine expect_files(whole, part, what)
      character(len=*), intent(in) :: whole, part, what
      call expect(bytes_of(path) == whole, what//': the file is '//bytes_of(path))
      call expect(bytes_of(path//'.part') == part, what//': its part is '//bytes_of(path//'.part'))
      call expect(.not. file_there(path//'.old'), what//': nothing else')
   end subroutine expect_files

   subroutine claim(work)
      type(working_file_type), intent(inout) :: work
      type(error_type), allocatable :: error
      call work%claim(path, error)
      call expect_no_error(error, 'the name is claimed')
      call expect(file_there(path//'.lock'), 'and locked')
   end subroutine claim

   subroutine publish(work, expected)
      type(working_file_type), intent(inout) :: work
      logical, intent(in) :: expected
      type(error_type), allocatable :: error
      logical :: exchanged
      call work%publish(exchanged, error)
      call expect_no_error(error, 'published')
      call expect(exchanged .eqv. expected, 'whether the part is what was published before')
   end subroutine publish

   !> A file of before stays until there is a whole new one.
   subroutine first_time()
      type(working_file_type) :: work
      call clear()
      call write_bytes(path, 'before')
      call claim(work)
      call write_bytes(work%part, 'new')
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
      call clear()
      call claim(work)
      call write_bytes(work%part, '1')
      call publish(work, .false.)
      call write_bytes(work%part, '12')
      call publish(work, .true.)
      call expect_files('12', '1', 'the second time')
      call write_bytes(work%part, '123')
      call publish(work, .true.)
      call expect_files('123', '12', 'the third time')
      call work%release()
      call expect_files('123', '(none)', 'released')
   end subroutine again

   !> The copy is a file of its own; one that was there before is not the run's, and not exchanged.
   subroutine continued()
      type(working_file_type) :: work
      type(error_type), allocatable :: error
      character(len=:), allocatable :: other
      logical :: linked
      call clear()
      call write_bytes(path, 'before')
      call write_bytes(path//'.part', 'left by a crash')
      other = scratch_path('other')
      linked = link_file(path//'.part', other)
      call claim(work)
      call work%copy_published(error)
      call expect_no_error(error, 'copied')
      call expect(linked, 'a second name for the part of before')
      call expect(bytes_of(other) == 'left by a crash', 'copied into a new file: a reader keeps the old one')
      call delete_file(other)
      call expect_files('before', 'before', 'copied')
      call write_bytes(work%part, 'more')
      call expect_files('before', 'more', 'changed')
      call publish(work, .false.)
      call expect_files('more', '(none)', 'published')
      call work%release()
      call clear()
      call claim(work)
      call work%copy_published(error)
      call expect_error(error, system_error, 'cannot write '//path//'.part', 'nothing to copy')
      call work%release()
   end subroutine continued

   subroutine given_up()
      type(working_file_type) :: work
      call clear()
      call write_bytes(path, 'before')
      call claim(work)
      call write_bytes(work%part, 'half')
      call work%release()
      call expect_files('before', '(none)', 'given up')
      call expect(.not. file_there(path//'.lock'), 'the lock is gone')
   end subroutine given_up

   !> A run that has lost its lock writes and deletes nothing any more: it may be another's.
   subroutine lock_gone()
      type(working_file_type) :: work
      type(error_type), allocatable :: error
      logical :: exchanged
      call clear()
      call write_bytes(path, 'before')
      call claim(work)
      call write_bytes(work%part, 'new')
      call delete_file(path//'.lock')
      call work%publish(exchanged, error)
      call expect_error(error, system_error, 'its lock is gone', 'publishing without the lock')
      call work%release()
      call expect_files('before', 'new', 'nothing changed')
   end subroutine lock_gone

   !> What is whole is kept under the name of the part. A folder in the file's way cannot be replaced.
   subroutine cannot_be_renamed()
      type(working_file_type) :: work
      type(error_type), allocatable :: error
      logical :: exchanged
      integer :: status
      call clear()
      call claim(work)
      call write_bytes(work%part, 'new')
      call execute_command_line('mkdir '//path//' && touch '//path//'/file', exitstat=status)
      call work%publish(exchanged, error)
      call expect_error(error, system_error, 'cannot rename '//path//'.part, which is whole', 'a folder in the way')
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
      call write_bytes(work%part, 'new')
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
