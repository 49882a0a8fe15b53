!> HDF5 files, groups and root attributes; what fails, and that nothing is done after a failure.
program test_hdf5_base
   use hdf5_base, only: hdf5_base_type
   use files, only: delete_file
   use scratch, only: scratch_path, file_there, write_bytes
   use check, only: runs, expect, report
   implicit none (type, external)
   character(len=:), allocatable :: path

   path = scratch_path('base.h5')
   if (runs('attributes')) call attributes()
   if (runs('replaced')) call replaced()
   if (runs('groups')) call groups()
   if (runs('missing')) call missing()
   if (runs('other_kinds')) call other_kinds()
   if (runs('no_hdf5')) call no_hdf5()
   if (runs('no_folder')) call no_folder()
   if (runs('read_only')) call read_only()
   if (runs('nothing_after_a_failure')) call nothing_after_a_failure()
   call delete_file(path)
   call report()

contains

   !> All is well with the file.
   subroutine expect_well(file, what)
      type(hdf5_base_type), intent(in) :: file
      character(len=*), intent(in) :: what
      call expect(.not. allocated(file%failure), what)
      if (allocated(file%failure)) call expect(.false., '   but: '//file%failure)
   end subroutine expect_well

   !> The file has failed, in reading or in writing, with these words.
   subroutine expect_failure(file, damaged, words, what)
      type(hdf5_base_type), intent(in) :: file
      logical, intent(in) :: damaged
      character(len=*), intent(in) :: words, what
      call expect(allocated(file%failure), what//' is a failure')
      if (.not. allocated(file%failure)) return
      call expect(index(file%failure, words) > 0, what//': "'//words//'" in "'//file%failure//'"')
      call expect(file%damaged .eqv. damaged, what//': damaged or not')
   end subroutine expect_failure

   subroutine expect_text(file, name, expected)
      type(hdf5_base_type), intent(inout) :: file
      character(len=*), intent(in) :: name, expected
      character(len=:), allocatable :: text
      call file%get_text(name, text)
      call expect(text == expected .and. len(text) == len(expected), name//' comes back')
   end subroutine expect_text

   subroutine expect_flag(file, name, expected)
      type(hdf5_base_type), intent(inout) :: file
      character(len=*), intent(in) :: name
      integer, intent(in) :: expected
      integer :: value
      call file%get_flag(name, value)
      call expect(value == expected, name//' comes back')
   end subroutine expect_flag

   !> Texts of any length and characters, and whole numbers, after the file was closed and opened.
   subroutine attributes()
      type(hdf5_base_type) :: file
      character(len=*), parameter :: utf8 = char(195)//char(188)//' '//char(226)//char(130)//char(172)
      call file%create(path)
      call file%put_text('plain', 'a text  ')
      call file%put_text('empty', '')
      call file%put_text('lines', 'a'//achar(10)//'b')
      call file%put_text('beyond ascii', utf8)
      call file%put_text('long', repeat('0123456789', 10000))
      call file%put_flag('one', 1)
      call file%put_flag('low', -huge(1) - 1)
      call file%close()
      call expect_well(file, 'a file is written')
      call expect(file%id < 0, 'and closed')
      call file%open(path, writing=.false.)
      call expect(file%has_attribute('plain'), 'what is there')
      call expect(.not. file%has_attribute('other'), 'what is there')
      call expect_text(file, 'plain', 'a text  ')
      call expect_text(file, 'empty', '')
      call expect_text(file, 'lines', 'a'//achar(10)//'b')
      call expect_text(file, 'beyond ascii', utf8)
      call expect_text(file, 'long', repeat('0123456789', 10000))
      call expect_flag(file, 'one', 1)
      call expect_flag(file, 'low', -huge(1) - 1)
      call file%close()
      call expect_well(file, 'a file is read')
   end subroutine attributes

   subroutine replaced()
      type(hdf5_base_type) :: file
      call file%create(path)
      call file%put_text('text', 'first')
      call file%put_flag('flag', 1)
      call file%close()
      call file%open(path, writing=.true.)
      call file%put_text('text', 'the second one')
      call file%put_flag('flag', 2)
      call expect_text(file, 'text', 'the second one')
      call expect_flag(file, 'flag', 2)
      call file%close()
      call file%create(path)
      call expect(.not. file%has_attribute('text'), 'a new file of the name is empty')
      call file%close()
      call expect_well(file, 'attributes and files are replaced')
   end subroutine replaced

   subroutine groups()
      type(hdf5_base_type) :: file
      call file%create(path)
      call file%make_group('inner')
      call expect(file%has('inner'), 'a group')
      call expect(.not. file%has('other'), 'a group')
      call expect(.not. file%has('inner/value'), 'and nothing in it, or in none')
      call expect(.not. file%has('other/value'), 'and nothing in it, or in none')
      call file%delete('inner')
      call file%delete('other')
      call expect(.not. file%has('inner'), 'a group is deleted')
      call file%close()
      call expect_well(file, 'and to delete what is not there does nothing')
   end subroutine groups

   subroutine missing()
      type(hdf5_base_type) :: file
      call file%create(path)
      call expect_text(file, 'text', '')
      call expect_failure(file, .true., 'HDF5 could not find attribute text', 'a missing text')
      call file%close()
      call file%open(path, writing=.false.)
      call expect_well(file, 'a new file forgets the failure')
      call expect_flag(file, 'flag', 0)
      call expect_failure(file, .true., 'find attribute flag', 'a missing flag')
      call file%close()
   end subroutine missing

   subroutine other_kinds()
      type(hdf5_base_type) :: file
      call file%create(path)
      call file%put_flag('flag', 1)
      call expect_text(file, 'flag', '')
      call expect_failure(file, .true., 'read attribute flag', 'a flag read as text')
      call file%close()
      call file%create(path)
      call file%put_text('text', '1')
      call expect_flag(file, 'text', 0)
      call expect_failure(file, .true., 'read attribute text', 'a text read as flag')
      call file%close()
   end subroutine other_kinds

   subroutine no_hdf5()
      type(hdf5_base_type) :: file
      call write_bytes(path, 'this is text')
      call file%open(path, writing=.false.)
      call expect(file%id < 0, 'a text is not open')
      call expect_failure(file, .false., 'open the file', 'a text')
      call file%close()
      call write_bytes(path, '')
      call file%open(path, writing=.false.)
      call expect(file%id < 0, 'nor is an empty file')
      call delete_file(path)
      call file%open(path, writing=.false.)
      call expect(file%id < 0, 'nor is none')
      call expect(.not. file_there(path), 'nor is none')
   end subroutine no_hdf5

   subroutine no_folder()
      type(hdf5_base_type) :: file
      call file%create('no/such/folder.h5')
      call expect_failure(file, .false., 'create the file: no such file', 'a file in no folder')
      call file%close()
   end subroutine no_folder

   subroutine read_only()
      type(hdf5_base_type) :: file
      call file%create(path)
      call file%close()
      call file%open(path, writing=.false.)
      call file%put_flag('flag', 1)
      call expect_failure(file, .false., 'attribute flag', 'writing what is open for reading')
      call file%close()
   end subroutine read_only

   !> The first failure is kept, and nothing is written or found any more.
   subroutine nothing_after_a_failure()
      type(hdf5_base_type) :: file
      call file%create(path)
      call file%put_flag('before', 1)
      call expect_flag(file, 'missing', 0)
      call file%put_flag('behind', 1)
      call file%put_text('text', 'behind')
      call file%make_group('group')
      call expect_flag(file, 'before', 0)
      call expect(.not. file%has_attribute('before'), 'nothing is found')
      call expect(.not. file%has('group'), 'nothing is found')
      call file%check(-1, 'do another thing')
      call expect_failure(file, .true., 'find attribute missing', 'the first')
      call file%close()
      call file%open(path, writing=.false.)
      call expect(file%has_attribute('before'), 'what was written before')
      call expect(.not. file%has_attribute('behind'), 'is all that was written')
      call expect(.not. file%has_attribute('text'), 'is all that was written')
      call expect(.not. file%has('group'), 'is all that was written')
      call file%close()
   end subroutine nothing_after_a_failure
end program test_hdf5_base
