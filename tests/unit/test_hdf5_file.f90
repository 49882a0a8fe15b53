!> Datasets of an HDF5 file: numbers to the last bit, dimension scales, and what is refused.
program test_hdf5_file
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan, ieee_positive_inf
   use hdf5, only: hid_t, hsize_t, h5dopen_f, h5dclose_f, h5dcreate_f, h5pcreate_f, h5pset_chunk_f, h5pclose_f, &
      & h5p_dataset_create_f, h5screate_simple_f, h5sclose_f, h5t_native_double
   use h5ds, only: h5dsis_scale_f, h5dsis_attached_f
   use kinds, only: wp, i8
   use hdf5_file, only: hdf5_type
   use files, only: delete_file
   use scratch, only: scratch_path
   use check, only: runs, expect, expect_close, report
   implicit none (type, external)
   character(len=:), allocatable :: path

   path = scratch_path('file.h5')
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

   !> Damaged, with these words; the file is closed.
   subroutine expect_damaged(file, words)
      type(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: words
      call expect(allocated(file%failure) .and. file%damaged, 'a failure in reading: '//words)
      if (allocated(file%failure)) call expect(index(file%failure, words) > 0, words//' in '//file%failure)
      call file%close()
   end subroutine expect_damaged

   !> Every bit of a number, also of those that are none.
   subroutine numbers()
      type(hdf5_type) :: file
      real(wp) :: list(6), found(6)
      list = [1.0_wp/3, -0.0_wp, tiny(1.0_wp), huge(1.0_wp), ieee_value(1.0_wp, ieee_positive_inf), &
         & ieee_value(1.0_wp, ieee_quiet_nan)]
      call file%create(path)
      call file%put_real('real', list(1), 'm', 'a number')
      call file%put_count('count', 2_i8**62 + 1, 'a large number')
      call file%put_list('list', list, 'm', 'several', '')
      call file%close()
      call file%open(path, writing=.false.)
      call expect_close(file%get_real('real'), list(1), 0.0_wp, 'a number')
      call expect(file%get_count('count') == 2_i8**62 + 1, 'a count')
      call file%get_list('list', found)
      call expect(all(transfer(found, [1_i8]) == transfer(list, [1_i8])), 'a list')
      call file%close()
      call expect_well(file, 'numbers')
   end subroutine numbers

   subroutine tables()
      type(hdf5_type) :: file
      real(wp) :: table(3, 2), found(6)
      table = reshape([1, 2, 3, 4, 5, 6], [3, 2])
      call file%create(path)
      call file%put_table('table', table, '1', 'a table', '')
      call file%get_list('table', found)
      call expect_close(maxval(abs(found - [table])), 0.0_wp, 0.0_wp, 'in the order of the memory')
      call file%close()
      call expect_well(file, 'a table')
   end subroutine tables

   !> What is put again takes the old dataset's numbers, and leaves its units.
   subroutine overwritten()
      type(hdf5_type) :: file
      real(wp) :: found(2)
      call file%create(path)
      call file%put_real('real', 1.0_wp, 'm', 'a number')
      call file%put_count('count', 1_i8, 'a count')
      call file%put_list('list', [1.0_wp, 2.0_wp], 'm', 'a list', '')
      call file%close()
      call file%open(path, writing=.true.)
      call file%put_real('real', 3.0_wp, 'm', 'a number')
      call file%put_count('count', 4_i8, 'a count')
      call file%put_list('list', [5.0_wp, 6.0_wp], 'm', 'a list', '')
      call file%close()
      call file%open(path, writing=.false.)
      call file%get_list('list', found)
      call expect_close(file%get_real('real'), 3.0_wp, 0.0_wp, 'a number')
      call expect(file%get_count('count') == 4_i8, 'a count')
      call expect_close(maxval(abs(found - [5.0_wp, 6.0_wp])), 0.0_wp, 0.0_wp, 'a list')
      call file%close()
      call expect_well(file, 'overwritten')
   end subroutine overwritten

   subroutine in_groups()
      type(hdf5_type) :: file
      call file%create(path)
      call file%make_group('inner')
      call file%put_real('inner/real', 1.0_wp, 'm', 'a number')
      call file%put_real('real', 2.0_wp, 'm', 'another')
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
      call file%put_list('x', [1.0_wp, 2.0_wp, 3.0_wp], 'm', 'places', 'x')
      call file%put_list('y', [1.0_wp, 2.0_wp], 'm', 'others', 'y')
      call file%put_table('table', reshape([1.0_wp, 2.0_wp, 3.0_wp, 4.0_wp, 5.0_wp, 6.0_wp], [3, 2]), '1', 'a table', &
         & 'y x')
      call expect(is_scale(file, 'x'), 'what is a scale')
      call expect(is_scale(file, 'y'), 'what is a scale')
      call expect(.not. is_scale(file, 'table'), 'what is a scale')
      call expect(is_attached(file, 'table', 'y', 1), 'of which dimension')
      call expect(is_attached(file, 'table', 'x', 2), 'of which dimension')
      call expect(.not. is_attached(file, 'table', 'x', 1), 'and of which not')
      call file%put_list('z', [1.0_wp, 2.0_wp], 'm', 'no such scale', 'nowhere')
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
      real(wp) :: list(2)
      call file%create(path)
      call expect_close(file%get_real('real'), 0.0_wp, 0.0_wp, 'a missing number')
      call expect_damaged(file, 'find real')
      call file%open(path, writing=.false.)
      call expect(file%get_count('inner/count') == 0, 'a missing count')
      call expect_damaged(file, 'find inner/count')
      call file%open(path, writing=.false.)
      list = 7
      call file%get_list('list', list)
      call expect_close(maxval(abs(list)), 0.0_wp, 0.0_wp, 'a missing list')
      call expect_damaged(file, 'find list')
   end subroutine missing

   subroutine wrong_size()
      type(hdf5_type) :: file
      real(wp) :: list(2)
      call file%create(path)
      call file%put_list('list', [1.0_wp, 2.0_wp, 3.0_wp], 'm', 'a list', '')
      call file%get_list('list', list)
      call expect_close(maxval(abs(list)), 0.0_wp, 0.0_wp, 'a list of another size')
      call expect_damaged(file, 'read list')
      call file%open(path, writing=.false.)
      call expect_close(file%get_real('list'), 0.0_wp, 0.0_wp, 'a list as a number')
      call expect_damaged(file, 'read list')
   end subroutine wrong_size

   subroutine wrong_kind()
      type(hdf5_type) :: file
      call file%create(path)
      call file%put_count('count', 1_i8, 'a count')
      call file%put_real('real', 1.0_wp, 'm', 'a number')
      call expect_close(file%get_real('count'), 0.0_wp, 0.0_wp, 'a count as a number')
      call expect_damaged(file, 'find numbers of the right kind in count')
      call file%open(path, writing=.false.)
      call expect(file%get_count('real') == 0, 'a number as a count')
      call expect_damaged(file, 'find numbers of the right kind in real')
   end subroutine wrong_kind

   !> A chunk of two gigabytes takes no room in a file, but memory.
   subroutine large_chunks()
      type(hdf5_type) :: file
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
         call file%open_dataset('list', dataset, status)
         if (doubles(i) <= 2_hsize_t**23) then
            call expect_well(file, 'a chunk of this size')
            call h5dclose_f(dataset, status)
            call file%close()
         else
            call expect(status < 0, 'no dataset')
            call expect_damaged(file, 'take memory for the chunks of list')
         end if
      end do
   end subroutine large_chunks

   subroutine nothing_after_a_failure()
      type(hdf5_type) :: file
      real(wp) :: list(1)
      call file%create(path)
      call file%put_real('before', 1.0_wp, 'm', 'a number')
      call expect_close(file%get_real('missing'), 0.0_wp, 0.0_wp, 'a failure')
      call file%put_real('behind', 1.0_wp, 'm', 'a number')
      call file%put_count('behind', 1_i8, 'a count')
      call file%put_list('behind', [1.0_wp], 'm', 'a list', '')
      call file%put_table('behind', reshape([1.0_wp], [1, 1]), 'm', 'a table', '')
      call file%get_list('before', list)
      call expect_close(list(1), 0.0_wp, 0.0_wp, 'nothing is read')
      call expect_damaged(file, 'find missing')
      call file%open(path, writing=.false.)
      call expect(file%has('before'), 'nothing is written')
      call expect(.not. file%has('behind'), 'nothing is written')
      call file%close()
      call expect_well(file, 'the file is whole')
   end subroutine nothing_after_a_failure
end program test_hdf5_file
