!> Datasets that grow along an axis: what is appended comes back in any parts; what is no series is refused.
program test_hdf5_series
   use kinds, only: wp, i8
   use text, only: to_text
   use hdf5_file, only: hdf5_type
   use hdf5_series, only: hdf5_series_type, chunk_samples
   use files, only: delete_file
   use scratch, only: scratch_path
   use check, only: runs, expect, expect_close, report
   implicit none (type, external)
   !> Samples of a long series.
   integer(i8), parameter :: long = 2*chunk_samples
   character(len=:), allocatable :: path

   path = scratch_path('series.h5')
   if (runs('growing')) then
      call growing(0, long)
      call growing(1, long)
      call growing(5, long)
      call growing(5, 100_i8)
      call growing(0, 0_i8)
   end if
   if (runs('parts')) call parts()
   if (runs('shape_in_the_file')) call shape_in_the_file()
   if (runs('no_series')) call no_series()
   if (runs('beyond_the_end')) call beyond_the_end()
   if (runs('nothing_after_a_failure')) call nothing_after_a_failure()
   call delete_file(path)
   call report()

contains

   !> Value j of sample i, 1-based.
   elemental real(wp) function sample(j, i)
      integer, intent(in) :: j, i
      sample = j + 0.001_wp*i
   end function sample

   !> Samples first to last.
   pure function samples(width, first, last)
      integer, intent(in) :: width, first, last
      real(wp) :: samples(width, last - first + 1)
      integer :: i, j
      do i = first, last
         do j = 1, width
            samples(j, i - first + 1) = sample(j, i)
         end do
      end do
   end function samples

   subroutine expect_samples(series, file, first, last)
      type(hdf5_series_type), intent(inout) :: series
      type(hdf5_type), intent(inout) :: file
      integer, intent(in) :: first, last
      real(wp), allocatable :: found(:, :)
      character(len=:), allocatable :: what
      what = 'samples '//to_text(first)//' to '//to_text(last)
      call series%read(file, int(first - 1, i8), last - first + 1, found)
      call expect(all(shape(found) == [series%width, last - first + 1]), 'shape, '//what)
      if (all(shape(found) == [series%width, last - first + 1])) call expect(all(.not. abs(found &
         & - samples(series%width, first, last)) > 0), what)
   end subroutine expect_samples

   !> With any number of samples at a time, over the ends of chunks, also where there are more than expected.
   subroutine growing(width, expected)
      integer, intent(in) :: width
      integer(i8), intent(in) :: expected
      integer, parameter :: pieces(*) = [1, 1, 2, chunk_samples - 5, 3, chunk_samples, 2*chunk_samples + 1, 10]
      type(hdf5_type) :: file
      type(hdf5_series_type) :: series
      integer :: i, length
      call file%create(path)
      call series%create(file, 'x', width, 'm', 'numbers', '', expected)
      call expect(series%width == max(1, width) .and. series%length == 0, 'a new one')
      length = 0
      do i = 1, size(pieces)
         call series%append(file, samples(series%width, length + 1, length + pieces(i)))
         length = length + pieces(i)
         call expect(series%length == length, 'length after '//to_text(i)//' pieces')
         call expect_samples(series, file, 1, length)
      end do
      call series%append(file, samples(series%width, 1, 0))
      call expect(series%length == length, 'nothing more')
      call series%close(file)
      call file%close()
      call expect(.not. allocated(file%failure), 'width '//to_text(width))
   end subroutine growing

   subroutine parts()
      type(hdf5_type) :: file
      type(hdf5_series_type) :: series
      call file%create(path)
      call series%create(file, 'x', 2, 'm', 'numbers', '', long)
      call series%append(file, samples(2, 1, chunk_samples + 100))
      call expect_samples(series, file, 1, 1)
      call expect_samples(series, file, chunk_samples - 1, chunk_samples + 2)
      call expect_samples(series, file, chunk_samples + 100, chunk_samples + 100)
      call expect_samples(series, file, 5, 4)
      call series%close(file)
      call file%close()
      call expect(.not. allocated(file%failure), 'parts')
   end subroutine parts

   !> A width of 0 gives one number a sample, of one dimension; 1 gives lists of one.
   subroutine shape_in_the_file()
      type(hdf5_type) :: file
      type(hdf5_series_type) :: flat, lists
      call file%create(path)
      call flat%create(file, 'flat', 0, 'm', 'numbers', 'flat', long)
      call lists%create(file, 'lists', 1, 'm', 'numbers', 'flat', long)
      call flat%append(file, samples(1, 1, 3))
      call lists%append(file, samples(1, 1, 3))
      call expect_samples(flat, file, 1, 3)
      call expect_samples(lists, file, 1, 3)
      call flat%close(file)
      call lists%close(file)
      call file%close()
      call expect(.not. allocated(file%failure), 'one is the scale of the other')
   end subroutine shape_in_the_file

   !> The file fails in reading, with these words; it is closed.
   subroutine expect_damaged(file, words)
      type(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: words
      call expect(allocated(file%failure) .and. file%damaged, 'a failure in reading: '//words)
      if (allocated(file%failure)) call expect(index(file%failure, words) > 0, words//' in '//file%failure)
      call file%close()
   end subroutine expect_damaged

   subroutine no_series()
      type(hdf5_type) :: file
      type(hdf5_series_type) :: series
      call file%create(path)
      call file%put_count('count', 1_i8, 'a count')
      call file%put_real('number', 1.0_wp, 'm', 'a number')
      call file%put_table('wide', spread(spread(0.0_wp, 1, 1001), 2, 2), 'm', 'a table', '')
      call series%open(file, 'missing')
      call expect_damaged(file, 'open missing')
      call file%open(path, writing=.false.)
      call series%open(file, 'count')
      call series%close(file)
      call expect_damaged(file, 'find numbers of the right kind in count')
      call file%open(path, writing=.false.)
      call series%open(file, 'number')
      call series%close(file)
      call expect_damaged(file, 'read the size of number')
      call file%open(path, writing=.false.)
      call series%open(file, 'wide')
      call series%close(file)
      call expect_damaged(file, 'read the size of wide')
   end subroutine no_series

   subroutine beyond_the_end()
      type(hdf5_type) :: file
      type(hdf5_series_type) :: series
      real(wp), allocatable :: found(:, :)
      call file%create(path)
      call series%create(file, 'x', 0, 'm', 'numbers', '', long)
      call series%append(file, samples(1, 1, 3))
      call series%read(file, 2_i8, 2, found)
      call expect(all(shape(found) == [1, 2]), 'as many as were asked for')
      call expect_close(maxval(abs(found)), 0.0_wp, 0.0_wp, 'and all of them 0')
      call series%close(file)
      call expect_damaged(file, 'read samples')
   end subroutine beyond_the_end

   subroutine nothing_after_a_failure()
      type(hdf5_type) :: file
      type(hdf5_series_type) :: series, other
      real(wp), allocatable :: found(:, :)
      call file%create(path)
      call series%create(file, 'x', 0, 'm', 'numbers', '', long)
      call series%append(file, samples(1, 1, 3))
      call file%check_read(-1, 'do something else')
      call series%append(file, samples(1, 4, 5))
      call expect(series%length == 3, 'nothing is appended')
      call series%read(file, 0_i8, 3, found)
      call expect_close(maxval(abs(found)), 0.0_wp, 0.0_wp, 'nothing is read')
      call other%create(file, 'y', 0, 'm', 'numbers', '', long)
      call series%close(file)
      call expect_damaged(file, 'do something else')
      call file%open(path, writing=.false.)
      call expect(.not. file%has('y'), 'nothing is made')
      call series%open(file, 'x')
      call expect(series%length == 3, 'the file is as it was')
      call series%close(file)
      call file%close()
   end subroutine nothing_after_a_failure
end program test_hdf5_series
