!> HDF5 files: what is put is what is got; a failure is kept, named, and ends all that follows.
program test_hdf5_file
   use kinds, only: wp, i8
   use text, only: to_text
   use files, only: delete_file
   use processes, only: process_id
   use hdf5_file, only: hdf5_type
   use check, only: runs, expect, expect_close, report
   implicit none (type, external)
   character(len=:), allocatable :: path

   path = 'test_hdf5_file_'//to_text(int(process_id()))//'.h5'
   if (runs('round_trip')) call round_trip()
   if (runs('replacing')) call replacing()
   if (runs('names')) call names()
   if (runs('reading_failures')) call reading_failures()
   if (runs('writing_failures')) call writing_failures()
   call delete_file(path)
   call report()

contains

   subroutine expect_well(file, what)
      type(hdf5_type), intent(in) :: file
      character(len=*), intent(in) :: what
      call expect(.not. allocated(file%failure), what)
      if (allocated(file%failure)) call expect(.false., file%failure)
   end subroutine expect_well

   subroutine round_trip()
      type(hdf5_type) :: file
      character(len=:), allocatable :: text
      real(wp) :: list(3)
      integer :: flag
      call file%create(path)
      call file%put_text('title', 'Größe, two'//new_line('a')//'lines')
      call file%put_text('nothing', '')
      call file%put_flag('complete', -7)
      call file%make_group('group')
      call file%put_count('group/count', 2_i8**60 + 1, 'a large count')
      call file%put_real('group/value', 1/3.0_wp, 'm', 'a third')
      call file%put_list('axis', [1.0_wp, 2.0_wp, 4.0_wp], 's', 'an axis', 'axis')
      call file%put_list('over_axis', [3.0_wp, tiny(1.0_wp), -huge(1.0_wp)], 'N', 'values', 'axis')
      call file%put_table('table', reshape([1.0_wp, 2.0_wp, 3.0_wp], [3, 1]), 'N', 'a table', '')
      call file%close()
      call expect_well(file, 'written')
      call file%open(path, writing=.false.)
      call file%get_text('title', text)
      call expect(text == 'Größe, two'//new_line('a')//'lines', 'a text')
      call file%get_text('nothing', text)
      call expect(len(text) == 0, 'an empty text')
      call file%get_flag('complete', flag)
      call expect(flag == -7, 'a flag')
      call expect(file%get_count('group/count') == 2_i8**60 + 1, 'a count')
      call expect_close(file%get_real('group/value'), 1/3.0_wp, 0.0_wp, 'a number')
      call file%get_list('over_axis', list)
      call expect_close(maxval(abs([list(1) - 3, list(2)/tiny(1.0_wp) - 1, list(3)/huge(1.0_wp) + 1])), 0.0_wp, &
         & 0.0_wp, 'a list')
      call file%get_list('table', list)
      call expect_close(norm2(list - [1.0_wp, 2.0_wp, 3.0_wp]), 0.0_wp, 0.0_wp, 'a table')
      call expect_well(file, 'read')
      call file%close()
   end subroutine round_trip

   !> A value of the name and size is overwritten, in this opening of the file or another.
   subroutine replacing()
      type(hdf5_type) :: file
      character(len=:), allocatable :: text
      real(wp) :: list(2)
      integer :: flag, k
      call file%create(path)
      do k = 1, 3
         call file%put_text('text', repeat('x', k))
         call file%put_flag('flag', k)
         call file%put_count('count', int(k, i8), 'a count')
         call file%put_list('list', [1.0_wp*k, 2.0_wp*k], '1', 'a list', '')
         call file%close()
         call file%open(path, writing=.true.)
      end do
      call file%get_text('text', text)
      call file%get_flag('flag', flag)
      call file%get_list('list', list)
      call expect(text == 'xxx' .and. flag == 3 .and. file%get_count('count') == 3, 'the last text, flag and count')
      call expect_close(norm2(list - [3.0_wp, 6.0_wp]), 0.0_wp, 0.0_wp, 'the last list')
      call expect_well(file, 'replaced')
      call file%close()
   end subroutine replacing

   subroutine names()
      type(hdf5_type) :: file
      call file%create(path)
      call file%make_group('a')
      call file%put_real('a/x', 5.0_wp, '1', 'x')
      call file%put_flag('flag', 1)
      call expect(file%has('a') .and. file%has('a/x') .and. file%has_attribute('flag'), 'what was put is there')
      call expect(.not. (file%has('a/y') .or. file%has('b/x') .or. file%has_attribute('a')), 'and nothing else')
      call file%rename('a/x', 'a/y')
      call file%rename('a/none', 'a/z')
      call expect(file%has('a/y') .and. .not. (file%has('a/x') .or. file%has('a/z')), 'renamed')
      call expect_close(file%get_real('a/y'), 5.0_wp, 0.0_wp, 'with its value')
      call file%delete('a')
      call file%delete('a')
      call expect(.not. file%has('a'), 'deleted')
      call expect_well(file, 'names changed')
      call file%close()
   end subroutine names

   !> Opens a file with a count, a list of two and no texts.
   subroutine open_small(file)
      type(hdf5_type), intent(inout) :: file
      call file%create(path)
      call file%put_count('count', 3_i8, 'a count')
      call file%put_list('list', [1.0_wp, 2.0_wp], '1', 'a list', '')
      call file%close()
      call file%open(path, writing=.false.)
   end subroutine open_small

   !> What a failed reading must leave behind.
   subroutine expect_damaged(file, named)
      type(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: named
      call expect(allocated(file%failure) .and. file%damaged, named//': a failure in reading')
      if (allocated(file%failure)) call expect(index(file%failure, named) > 0, 'names '//named//': '//file%failure)
      call expect(file%get_count('count') == 0 .and. .not. file%has('count'), 'nothing more is read')
      call file%close()
   end subroutine expect_damaged

   subroutine reading_failures()
      type(hdf5_type) :: file
      character(len=:), allocatable :: text
      real(wp) :: list(3), number
      integer :: flag
      call open_small(file)
      number = file%get_real('missing')
      call expect_close(number, 0.0_wp, 0.0_wp, 'nothing is read as 0')
      call expect_damaged(file, 'missing')
      call open_small(file)
      number = file%get_real('count')
      call expect_damaged(file, 'count')
      call open_small(file)
      call file%get_list('list', list)
      call expect_damaged(file, 'list')
      call open_small(file)
      call file%get_text('title', text)
      call expect(text == '', 'no text is read as an empty one')
      call expect_damaged(file, 'title')
      call open_small(file)
      call file%get_flag('flag', flag)
      call expect_damaged(file, 'flag')
      call file%open('no_such_file.h5', writing=.false.)
      call expect(allocated(file%failure) .and. file%id < 0, 'no file, no number of one')
      call open_small(file)
      call expect_well(file, 'another opening starts anew')
      call file%close()
   end subroutine reading_failures

   subroutine writing_failures()
      type(hdf5_type) :: file
      call file%create('no_such_folder/file.h5')
      call expect(allocated(file%failure) .and. .not. file%damaged, 'no file where there is no folder')
      if (allocated(file%failure)) call expect(index(file%failure, 'no such file') > 0, &
         & 'and the system''s reason: '//file%failure)
      call open_small(file)
      call file%put_real('value', 1.0_wp, '1', 'a value')
      call expect(allocated(file%failure), 'nothing is written into a file that was opened for reading')
      call file%close()
      call open_small(file)
      call expect(.not. file%has('value'), 'and nothing is')
      call file%close()
   end subroutine writing_failures
end program test_hdf5_file
