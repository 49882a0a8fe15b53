!> An HDF5 file: its attributes and groups, datasets to the last bit, dimension scales; what fails, and that nothing is
!> done after a failure.
program test_hdf5_file
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan, ieee_positive_inf
   use hdf5, only: hid_t, hsize_t, h5dopen_f, h5dclose_f, h5dcreate_f, h5pcreate_f, h5pset_chunk_f, h5pclose_f, &
      & h5p_dataset_create_f, h5screate_simple_f, h5sclose_f, h5t_native_double
   use h5ds, only: h5dsis_scale_f, h5dsis_attached_f
   use kinds, only: wp, i8
   use hdf5_file, only: hdf5_type, opened_type
   use record, only: record_type
   use record_file, only: read_record
   use files, only: delete_file
   use scratch, only: scratch_path, file_there, write_bytes
   use hdf5_expectations, only: put_real, put_list, put_table, put_count, expect_damaged
   use check, only: runs, expect, expect_close, report
   implicit none (type, external)
   character(len=:), allocatable :: path

   path = scratch_path('file.h5')
   if (runs('attributes')) call attributes()
   if (runs('replaced')) call replaced()
   if (runs('groups')) call groups()
   if (runs('other_kinds')) call other_kinds()
   if (runs('no_hdf5')) call no_hdf5()
   if (runs('no_folder')) call no_folder()
   if (runs('read_only')) call read_only()
   if (runs('numbers')) call numbers()
   if (runs('tables')) call tables()
   if (runs('overwritten')) call overwritten()
   if (runs('in_groups')) call in_groups()
   if (runs('scales')) call scales()
   if (runs('missing')) call missing()
   if (runs('wrong_size')) call wrong_size()
   if (runs('wrong_kind')) call wrong_kind()
   if (runs('large_chunks')) call large_chunks()
   if (runs('nothing_after_a_failure')) call nothing_after_a_failure()
   call delete_file(path)
   call report()

contains

   subroutine expect_well(file, what)
      type(hdf5_type), intent(in) :: file
      character(len=*), intent(in) :: what
      call expect(.not. allocated(file%failure), what)
      if (allocated(file%failure)) call expect(.false., '   but: '//file%failure)
   end subroutine expect_well

   !> The file has failed, in reading or in writing, with these words.
   subroutine expect_failure(file, damaged, words, what)
      type(hdf5_type), intent(in) :: file
      logical, intent(in) :: damaged
      character(len=*), intent(in) :: words, what
      call expect(allocated(file%failure), what//' is a failure')
      if (.not. allocated(file%failure)) return
      call expect(index(file%failure, words) > 0, what//': "'//words//'" in "'//file%failure//'"')
      call expect(file%damaged .eqv. damaged, what//': damaged or not')
   end subroutine expect_failure

   subroutine expect_text(file, name, expected)
      type(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: name, expected
      character(len=:), allocatable :: text
      call file%get_text(name, text)
      call expect(text == expected .and. len(text) == len(expected), name//' comes back')
   end subroutine expect_text

   subroutine expect_flag(file, name, expected)
      type(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: name
      integer, intent(in) :: expected
      integer :: value
      call file%get_flag(name, value)
      call expect(value == expected, name//' comes back')
   end subroutine expect_flag

   !> A count as those who go on from a file read it.
   subroutine expect_count(file, name, expected)
      type(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: name
      integer(i8), intent(in) :: expected
      type(record_type) :: record
      call read_record(file, record)
      call expect(nint(record%get_real(name), i8) == expected, name//' comes back')
   end subroutine expect_count

   !> Texts of any length and characters, and whole numbers, after the file was closed and opened.
   subroutine attributes()
      type(hdf5_type) :: file
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
      type(hdf5_type) :: file
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
      type(hdf5_type) :: file
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

   subroutine other_kinds()
      type(hdf5_type) :: file
      call file%create(path)
      call file%put_flag('flag', 1)
      call expect_text(file, 'flag', '')
      call expect_damaged(file, 'read attribute flag')
      call file%create(path)
      call file%put_text('text', '1')
      call expect_flag(file, 'text', 0)
      call expect_damaged(file, 'read attribute text')
   end subroutine other_kinds

   subroutine no_hdf5()
      type(hdf5_type) :: file
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
      type(hdf5_type) :: file
      call file%create('no/such/folder.h5')
      call expect_failure(file, .false., 'create the file: no such file', 'a file in no folder')
      call file%close()
   end subroutine no_folder

   subroutine read_only()
      type(hdf5_type) :: file
      call file%create(path)
      call file%close()
      call file%open(path, writing=.false.)
      call file%put_flag('flag', 1)
      call expect_failure(file, .false., 'attribute flag', 'writing what is open for reading')
      call file%close()
   end subroutine read_only

   !> Every bit of a number, also of those that are none.
   subroutine numbers()
      type(hdf5_type) :: file
      real(wp) :: list(6)
      real(wp), allocatable :: found(:)
      list = [1.0_wp/3, -0.0_wp, tiny(1.0_wp), huge(1.0_wp), ieee_value(1.0_wp, ieee_positive_inf), &
         & ieee_value(1.0_wp, ieee_quiet_nan)]
      call file%create(path)
      call put_real(file, 'real', list(1), 'm', 'a number')
      call put_count(file, 'count', 2_i8**52 + 1, 'a large number')
      call put_list(file, 'list', list, 'm', 'several', '')
      call file%close()
      call file%open(path, writing=.false.)
      call expect_close(file%get_real('real'), list(1), 0.0_wp, 'a number')
      call expect_count(file, 'count', 2_i8**52 + 1)
      call file%get_list('list', found)
      call expect(all(transfer(found, [1_i8]) == transfer(list, [1_i8])), 'a list')
      call file%close()
      call expect_well(file, 'numbers')
   end subroutine numbers

   subroutine tables()
      type(hdf5_type) :: file
      real(wp) :: table(3, 2)
      real(wp), allocatable :: found(:)
      table = reshape([1, 2, 3, 4, 5, 6], [3, 2])
      call file%create(path)
      call put_table(file, 'table', table, '1', 'a table', '')
      call file%get_list('table', found)
      call expect_close(maxval(abs(found - [table])), 0.0_wp, 0.0_wp, 'in the order of the memory')
      call file%close()
      call expect_well(file, 'a table')
   end subroutine tables

   !> What is put again takes the old dataset's numbers, and leaves its units.
   subroutine overwritten()
      type(hdf5_type) :: file
      real(wp), allocatable :: found(:)
      call file%create(path)
      call put_real(file, 'real', 1.0_wp, 'm', 'a number')
      call put_count(file, 'count', 1_i8, 'a count')
      call put_list(file, 'list', [1.0_wp, 2.0_wp], 'm', 'a list', '')
      call file%close()
      call file%open(path, writing=.true.)
      call put_real(file, 'real', 3.0_wp, 'm', 'a number')
      call put_count(file, 'count', 4_i8, 'a count')
      call put_list(file, 'list', [5.0_wp, 6.0_wp], 'm', 'a list', '')
      call file%close()
      call file%open(path, writing=.false.)
      call file%get_list('list', found)
      call expect_close(file%get_real('real'), 3.0_wp, 0.0_wp, 'a number')
      call expect_count(file, 'count', 4_i8)
      call expect_close(maxval(abs(found - [5.0_wp, 6.0_wp])), 0.0_wp, 0.0_wp, 'a list')
      call file%close()
      call expect_well(file, 'overwritten')
   end subroutine overwritten

   subroutine in_groups()
      type(hdf5_type) :: file
      call file%create(path)
      call file%make_group('inner')
      call put_real(file, 'inner/real', 1.0_wp, 'm', 'a number')
      call put_real(file, 'real', 2.0_wp, 'm', 'another')
      call expect(file%has('inner/real'), 'what is in a group')
      call expect(.not. file%has('inner/other'), 'what is in a group')
      call expect_close(file%get_real('inner/real'), 1.0_wp, 0.0_wp, 'the number in it')
      call file%delete('inner/real')
      call expect(.not. file%has('inner/real'), 'is deleted alone')
      call expect(file%has('real'), 'is deleted alone')
      call file%close()
      call expect_well(file, 'groups')
   end subroutine in_groups

   !> A dataset whose scale is itself is one; others name theirs, slowest first.
   subroutine scales()
      type(hdf5_type) :: file
      call file%create(path)
      call put_list(file, 'x', [1.0_wp, 2.0_wp, 3.0_wp], 'm', 'places', 'x')
      call put_list(file, 'y', [1.0_wp, 2.0_wp], 'm', 'others', 'y')
      call put_table(file, 'table', reshape([1.0_wp, 2.0_wp, 3.0_wp, 4.0_wp, 5.0_wp, 6.0_wp], [3, 2]), '1', 'a table', &
         & 'y x')
      call expect(is_scale(file, 'x'), 'what is a scale')
      call expect(is_scale(file, 'y'), 'what is a scale')
      call expect(.not. is_scale(file, 'table'), 'what is a scale')
      call expect(is_attached(file, 'table', 'y', 1), 'of which dimension')
      call expect(is_attached(file, 'table', 'x', 2), 'of which dimension')
      call expect(.not. is_attached(file, 'table', 'x', 1), 'and of which not')
      call put_list(file, 'z', [1.0_wp, 2.0_wp], 'm', 'no such scale', 'nowhere')
      call expect(allocated(file%failure), 'a scale that is not there')
      if (allocated(file%failure)) call expect(index(file%failure, 'attach nowhere to z') > 0, file%failure)
      call file%close()
   end subroutine scales

   logical function is_scale(file, name)
      type(hdf5_type), intent(in) :: file
      character(len=*), intent(in) :: name
      integer(hid_t) :: dataset
      integer :: status
      call h5dopen_f(file%id, name, dataset, status)
      call h5dsis_scale_f(dataset, is_scale, status)
      call h5dclose_f(dataset, status)
   end function is_scale

   !> Dimensions are counted as Fortran has them.
   logical function is_attached(file, name, scale, dimension)
      type(hdf5_type), intent(in) :: file
      character(len=*), intent(in) :: name, scale
      integer, intent(in) :: dimension
      integer(hid_t) :: dataset, of_scale
      integer :: status
      call h5dopen_f(file%id, name, dataset, status)
      call h5dopen_f(file%id, scale, of_scale, status)
      call h5dsis_attached_f(dataset, of_scale, dimension, is_attached, status)
      call h5dclose_f(dataset, status)
      call h5dclose_f(of_scale, status)
   end function is_attached

   !> Numbers are 0 then.
   subroutine missing()
      type(hdf5_type) :: file
      real(wp), allocatable :: list(:)
      call file%create(path)
      call expect_close(file%get_real('real'), 0.0_wp, 0.0_wp, 'a missing number')
      call expect_damaged(file, 'find real')
      call file%open(path, writing=.false.)
      call expect_close(file%get_real('inner/real'), 0.0_wp, 0.0_wp, 'one in a missing group')
      call expect_damaged(file, 'find inner/real')
      call file%open(path, writing=.false.)
      call file%get_list('list', list)
      call expect(size(list) == 0, 'a missing list')
      call expect_damaged(file, 'find list')
      call file%open(path, writing=.false.)
      call expect_well(file, 'a file that is opened anew forgets the failure')
      call expect_text(file, 'text', '')
      call expect_damaged(file, 'HDF5 could not find attribute text')
      call file%open(path, writing=.false.)
      call expect_flag(file, 'flag', 0)
      call expect_damaged(file, 'find attribute flag')
   end subroutine missing

   subroutine wrong_size()
      type(hdf5_type) :: file
      call file%create(path)
      call put_list(file, 'list', [1.0_wp, 2.0_wp, 3.0_wp], 'm', 'a list', '')
      call put_list(file, 'list', [1.0_wp, 2.0_wp], 'm', 'a list of another size', '')
      call expect_damaged(file, 'find the right size of list')
      call file%open(path, writing=.false.)
      call expect_close(file%get_real('list'), 0.0_wp, 0.0_wp, 'a list as a number')
      call expect_damaged(file, 'find the right size of list')
   end subroutine wrong_size

   subroutine wrong_kind()
      type(hdf5_type) :: file
      call file%create(path)
      call put_count(file, 'count', 1_i8, 'a count')
      call put_real(file, 'real', 1.0_wp, 'm', 'a number')
      call expect_close(file%get_real('count'), 0.0_wp, 0.0_wp, 'a count as a number')
      call expect_damaged(file, 'find numbers of the right kind in count')
      call file%open(path, writing=.true.)
      call put_count(file, 'real', 2_i8, 'a count')
      call expect_damaged(file, 'find numbers of the right kind in real')
   end subroutine wrong_kind

   !> A chunk of two gigabytes takes no room in a file, but memory.
   subroutine large_chunks()
      type(hdf5_type) :: file
      type(opened_type) :: found
      integer(hid_t) :: space, properties, dataset
      integer(hsize_t), parameter :: doubles(*) = [2_hsize_t**22, 2_hsize_t**23, 2_hsize_t**24, 2_hsize_t**28]
      integer :: i, status
      do i = 1, size(doubles)
         call file%create(path)
         call h5screate_simple_f(1, [2_hsize_t**28], space, status)
         call h5pcreate_f(h5p_dataset_create_f, properties, status)
         call h5pset_chunk_f(properties, 1, doubles(i:i), status)
         call h5dcreate_f(file%id, 'list', h5t_native_double, space, dataset, status, properties)
         call h5dclose_f(dataset, status)
         call h5pclose_f(properties, status)
         call h5sclose_f(space, status)
         call file%open_dataset('list', found)
         if (doubles(i) <= 2_hsize_t**23) then
            call expect_well(file, 'a chunk of this size')
            call h5dclose_f(found%id, status)
            call file%close()
         else
            call expect(found%id < 0, 'no dataset')
            call expect_damaged(file, 'take memory for the chunks of list')
         end if
      end do
   end subroutine large_chunks

   !> The first failure is kept, and nothing is written, found or read any more.
   subroutine nothing_after_a_failure()
      type(hdf5_type) :: file
      real(wp), allocatable :: list(:)
      integer :: i
      character(len=*), parameter :: attributes(*) = [character(len=4) :: 'flag', 'text'], &
         & objects(*) = [character(len=5) :: 'group', 'real', 'count', 'list', 'table']
      call file%create(path)
      call file%put_flag('before', 1)
      call put_real(file, 'before', 1.0_wp, 'm', 'a number')
      call expect_close(file%get_real('missing'), 0.0_wp, 0.0_wp, 'a failure')
      call file%put_flag('flag', 1)
      call file%put_text('text', 'behind')
      call file%make_group('group')
      call put_real(file, 'real', 1.0_wp, 'm', 'a number')
      call put_count(file, 'count', 1_i8, 'a count')
      call put_list(file, 'list', [1.0_wp], 'm', 'a list', '')
      call put_table(file, 'table', reshape([1.0_wp], [1, 1]), 'm', 'a table', '')
      call expect_flag(file, 'before', 0)
      call expect(.not. file%has_attribute('before'), 'no attribute is found')
      call expect(.not. file%has('before'), 'nor a dataset')
      call file%get_list('before', list)
      call expect(size(list) == 0, 'nothing is read')
      call file%check(-1, 'do another thing')
      call expect_damaged(file, 'find missing')
      call file%open(path, writing=.false.)
      call expect(file%has_attribute('before'), 'an attribute that was written before')
      call expect(file%has('before'), 'and a dataset')
      do i = 1, size(attributes)
         call expect(.not. file%has_attribute(trim(attributes(i))), 'is all: no '//attributes(i))
      end do
      do i = 1, size(objects)
         call expect(.not. file%has(trim(objects(i))), 'is all: no '//objects(i))
      end do
      call file%close()
      call expect_well(file, 'the file is whole')
   end subroutine nothing_after_a_failure
end program test_hdf5_file
