!> Datasets that grow along an axis: what is appended comes back in any parts; what is no series is refused. Growing
!> files: samples over any axis, published again and again, continued, given up.
program test_growing_file
   use kinds, only: wp, i8
   use text, only: to_text
   use errors, only: error_type
   use files, only: delete_file
   use record, only: record_type
   use record_file, only: write_record
   use hdf5_file, only: hdf5_type
   use hdf5_rows, only: hdf5_rows_type, chunk_samples
   use growing_file, only: growing_file_type
   use scratch, only: scratch_path, file_there
   use hdf5_expectations, only: put_real, put_list, expect_damaged
   use check, only: runs, expect, expect_close, expect_no_error, report
   implicit none (type, external)
   !> Samples of a long series.
   integer(i8), parameter :: long = 2*chunk_samples
   character(len=:), allocatable :: path

   path = scratch_path('run.h5')
   if (runs('published_again')) call published_again()
   if (runs('continued')) call continued()
   if (runs('last_samples')) call last_samples()
   if (runs('given_up')) call given_up()
   if (runs('without_series')) call without_series()
   if (runs('uneven_series')) call uneven_series()
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

   !> A new series of this many values a sample, or, for 0, of one.
   subroutine create(series, file, name, width, expected)
      type(hdf5_rows_type), intent(inout) :: series
      type(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: name
      integer, intent(in) :: width
      integer(i8), intent(in) :: expected
      call series%create(file, name, pack([width], width > 0), 0, expected=expected)
   end subroutine create

   subroutine expect_part(series, file, first, last)
      type(hdf5_rows_type), intent(inout) :: series
      type(hdf5_type), intent(inout) :: file
      integer, intent(in) :: first, last
      real(wp), allocatable :: found(:, :)
      character(len=:), allocatable :: what
      what = 'samples '//to_text(first)//' to '//to_text(last)
      call series%read_behind(file, int(first - 1, i8), last - first + 1, found)
      call expect(all(shape(found) == [series%width(), last - first + 1]), 'shape, '//what)
      if (all(shape(found) == [series%width(), last - first + 1])) call expect(all(.not. abs(found &
         & - samples(series%width(), first, last)) > 0), what)
   end subroutine expect_part

   !> With any number of samples at a time, over the ends of chunks, also where there are more than expected.
   subroutine growing(width, expected)
      integer, intent(in) :: width
      integer(i8), intent(in) :: expected
      integer, parameter :: pieces(*) = [1, 1, 2, chunk_samples - 5, 3, chunk_samples, 2*chunk_samples + 1, 10]
      type(hdf5_type) :: file
      type(hdf5_rows_type) :: series
      integer :: i, length
      call file%create(path)
      call create(series, file, 'x', width, expected)
      call expect(series%width() == max(1, width) .and. series%length == 0, 'a new one')
      length = 0
      do i = 1, size(pieces)
         call series%append(file, samples(series%width(), length + 1, length + pieces(i)))
         length = length + pieces(i)
         call expect(series%length == length, 'length after '//to_text(i)//' pieces')
         call expect_part(series, file, 1, length)
      end do
      call series%append(file, samples(series%width(), 1, 0))
      call expect(series%length == length, 'nothing more')
      call series%close(file)
      call file%close()
      call expect(.not. allocated(file%failure), 'width '//to_text(width))
   end subroutine growing

   subroutine parts()
      type(hdf5_type) :: file
      type(hdf5_rows_type) :: series
      call file%create(path)
      call create(series, file, 'x', 2, long)
      call series%append(file, samples(2, 1, chunk_samples + 100))
      call expect_part(series, file, 1, 1)
      call expect_part(series, file, chunk_samples - 1, chunk_samples + 2)
      call expect_part(series, file, chunk_samples + 100, chunk_samples + 100)
      call expect_part(series, file, 5, 4)
      call series%close(file)
      call file%close()
      call expect(.not. allocated(file%failure), 'parts')
   end subroutine parts

   !> A width of 0 gives one number a sample, of one dimension; 1 gives lists of one.
   subroutine shape_in_the_file()
      type(hdf5_type) :: file
      type(hdf5_rows_type) :: flat, lists
      call file%create(path)
      call create(flat, file, 'flat', 0, long)
      call create(lists, file, 'lists', 1, long)
      call file%describe(flat%id, 'm', 'numbers', 'flat', 'flat')
      call file%describe(lists%id, 'm', 'numbers', 'flat', 'lists')
      call flat%append(file, samples(1, 1, 3))
      call lists%append(file, samples(1, 1, 3))
      call expect_part(flat, file, 1, 3)
      call expect_part(lists, file, 1, 3)
      call flat%close(file)
      call lists%close(file)
      call file%close()
      call expect(.not. allocated(file%failure), 'one is the scale of the other')
   end subroutine shape_in_the_file

   subroutine no_series()
      type(record_type) :: record
      type(hdf5_type) :: file
      type(hdf5_rows_type) :: series
      call file%create(path)
      call record%put('texts', ['a', 'b'], 'texts')
      call write_record(record, file, .true.)
      call put_real(file, 'number', 1.0_wp, 'm', 'a number')
      call series%open(file, 'missing')
      call expect_damaged(file, 'open missing')
      call file%open(path, writing=.false.)
      call series%open(file, 'texts')
      call series%close(file)
      call expect_damaged(file, 'find numbers of the right kind in texts')
      call file%open(path, writing=.false.)
      call series%open(file, 'number')
      call series%close(file)
      call expect_damaged(file, 'read the size of number')
   end subroutine no_series

   subroutine beyond_the_end()
      type(hdf5_type) :: file
      type(hdf5_rows_type) :: series
      real(wp), allocatable :: found(:, :)
      call file%create(path)
      call create(series, file, 'x', 0, long)
      call series%append(file, samples(1, 1, 3))
      call series%read_behind(file, 2_i8, 2, found)
      call expect(all(shape(found) == [1, 2]), 'as many as were asked for')
      call expect_close(maxval(abs(found)), 0.0_wp, 0.0_wp, 'and all of them 0')
      call series%close(file)
      call expect_damaged(file, 'read rows')
   end subroutine beyond_the_end

   subroutine nothing_after_a_failure()
      type(hdf5_type) :: file
      type(hdf5_rows_type) :: series, other
      real(wp), allocatable :: found(:, :)
      call file%create(path)
      call create(series, file, 'x', 0, long)
      call series%append(file, samples(1, 1, 3))
      call file%check_read(-1, 'do something else')
      call series%append(file, samples(1, 4, 5))
      call expect(series%length == 3, 'nothing is appended')
      call series%read_behind(file, 0_i8, 3, found)
      call expect_close(maxval(abs(found)), 0.0_wp, 0.0_wp, 'nothing is read')
      call create(other, file, 'y', 0, long)
      call series%close(file)
      call expect_damaged(file, 'do something else')
      call file%open(path, writing=.false.)
      call expect(.not. file%has('y'), 'nothing is made')
      call series%open(file, 'x')
      call expect(series%length == 3, 'the file is as it was')
      call series%close(file)
      call file%close()
   end subroutine nothing_after_a_failure

   !> Nothing is left beside the file.
   subroutine expect_alone()
      call expect(.not. file_there(path//'.part'), 'no part is left')
      call expect(.not. file_there(path//'.lock'), 'no lock is left')
   end subroutine expect_alone

   !> Sample k of the series: frequency (of the sample), and amplitude (of each pad).
   pure function amplitude(k)
      integer, intent(in) :: k
      real(wp) :: amplitude(2)
      amplitude = [k + 0.5_wp, -3.0_wp*k]
   end function amplitude

   subroutine begin_new(file)
      type(growing_file_type), intent(inout) :: file
      type(error_type), allocatable :: error
      call file%claim(path, error)
      call expect_no_error(error, 'claimed')
      call file%begin(error)
      call expect_no_error(error, 'begun')
      call put_list(file, 'pad', [1.0_wp, 2.0_wp], '1', 'pad number', 'pad')
      call begin_series(file)
   end subroutine begin_new

   !> Begins the series of a file, new or opened again.
   subroutine begin_series(file)
      type(growing_file_type), intent(inout) :: file
      call file%begin_series('frequency', 5000_i8)
      call file%declare('frequency', 1, 'Hz', 'frequency', '')
      call file%declare('amplitude', 2, 'm', 'amplitude', 'pad')
   end subroutine begin_series

   !> Adds samples first to last.
   subroutine add_samples(file, first, last)
      type(growing_file_type), intent(inout) :: file
      integer, intent(in) :: first, last
      integer :: k
      do k = first, last
         call file%add([real(k, wp), amplitude(k)])
      end do
   end subroutine add_samples

   !> The published file has samples 1 to n, and no others.
   subroutine expect_samples(n)
      integer, intent(in) :: n
      type(hdf5_type) :: file
      type(hdf5_rows_type) :: series
      real(wp), allocatable :: axis(:, :), values(:, :)
      integer :: k
      call file%open(path, writing=.false.)
      call series%open(file, 'frequency')
      call expect(series%length == n .and. series%width() == 1, to_text(n)//' samples of the axis')
      call series%read(file, 1, series%rows, axis)
      call series%close(file)
      call series%open(file, 'amplitude')
      call expect(series%length == n .and. series%width() == 2, to_text(n)//' samples of two pads')
      call series%read(file, 1, series%rows, values)
      call series%close(file)
      call expect(.not. allocated(file%failure), 'the file is whole')
      call file%close()
      if (size(axis, 2) /= n .or. size(values, 2) /= n) return
      call expect_close(maxval(abs(axis(1, :) - [(real(k, wp), k=1, n)])), 0.0_wp, 0.0_wp, 'the axis to '//to_text(n))
      call expect_close(maxval([(norm2(values(:, k) - amplitude(k)), k=1, n)]), 0.0_wp, 0.0_wp, &
         & 'values to '//to_text(n))
   end subroutine expect_samples

   !> Each publishing has all samples so far, also where they end in the middle of a chunk, at its end, and after
   !> several; what is written between two is not seen.
   subroutine published_again()
      integer, parameter :: ends(7) = [1, 5, 4096, 4097, 4097, 12000, 13000]
      type(growing_file_type) :: file
      type(error_type), allocatable :: error
      logical :: behind
      integer :: i, before
      call begin_new(file)
      call expect(.not. file_there(path), 'nothing is seen before')
      before = 0
      do i = 1, size(ends)
         call add_samples(file, before + 1, ends(i))
         call expect(file%samples == ends(i), 'samples are counted')
         if (i > 1) call expect_samples(before)
         call file%publish(continued=i < size(ends), error=error, behind=behind)
         call expect_no_error(error, 'published '//to_text(ends(i)))
         call expect_samples(ends(i))
         before = ends(i)
      end do
      call expect_alone()
   end subroutine published_again

   !> Samples are added to those in the file, in the chunk that they left unfilled too.
   subroutine continued()
      type(growing_file_type) :: file, later
      type(error_type), allocatable :: error
      logical :: behind
      call begin_new(file)
      call add_samples(file, 1, 4000)
      call file%publish(continued=.false., error=error, behind=behind)
      call later%claim(path, error)
      call later%reopen(error)
      call expect_no_error(error, 'opened again')
      call begin_series(later)
      call expect(later%samples == 4000_i8, 'the samples in the file count')
      call add_samples(later, 4001, 4500)
      call later%publish(continued=.true., error=error, behind=behind)
      call expect_no_error(error, 'published')
      call expect_samples(4500)
      call add_samples(later, 4501, 9000)
      call later%publish(continued=.false., error=error, behind=behind)
      call expect_samples(9000)
   end subroutine continued

   !> Of samples that are held, in the file, or were there before.
   subroutine last_samples()
      type(growing_file_type) :: file, later
      type(error_type), allocatable :: error
      logical :: behind
      real(wp), allocatable :: values(:, :)
      call begin_new(file)
      call add_samples(file, 1, 5000)
      call file%part_of_samples('amplitude', 3500_i8, 1500, values)
      call expect(all(shape(values) == [2, 1500]), 'as many as asked for')
      call expect_close(norm2(values(:, 1) - amplitude(3501)) + norm2(values(:, 1500) - amplitude(5000)), 0.0_wp, &
         & 0.0_wp, 'the last ones')
      call file%publish(continued=.false., error=error, behind=behind)
      call later%claim(path, error)
      call later%reopen(error)
      call later%begin_series('frequency', 5000_i8)
      call later%part_of_samples('frequency', 4998_i8, 2, values)
      call expect_close(norm2(values(1, :) - [4999.0_wp, 5000.0_wp]), 0.0_wp, 0.0_wp, 'those from before')
      call later%abandon()
   end subroutine last_samples

   !> The file of before stays.
   subroutine given_up()
      type(growing_file_type) :: file, later
      type(error_type), allocatable :: error
      logical :: behind
      call begin_new(file)
      call add_samples(file, 1, 10)
      call file%publish(continued=.false., error=error, behind=behind)
      call begin_new(later)
      call add_samples(later, 1, 20)
      call expect(file_there(path//'.part'), 'a part while it is written')
      call expect(file_there(path//'.lock'), 'and its lock')
      call later%abandon()
      call expect_alone()
      call expect_samples(10)
   end subroutine given_up

   subroutine without_series()
      type(growing_file_type) :: file
      type(error_type), allocatable :: error
      logical :: behind
      type(hdf5_type) :: found
      call file%claim(path, error)
      call file%begin(error)
      call expect_no_error(error, 'begun')
      call put_real(file, 'value', 1.5_wp, '1', 'a value')
      call file%publish(continued=.true., error=error, behind=behind)
      call expect_no_error(error, 'published without series')
      call expect(file%samples == 0, 'no samples')
      call file%publish(continued=.false., error=error, behind=behind)
      call expect_no_error(error, 'and closed')
      call found%open(path, writing=.false.)
      call expect_close(found%get_real('value'), 1.5_wp, 0.0_wp, 'its value is there')
      call found%close()
   end subroutine without_series

   !> A file whose series are not of one length is damaged.
   subroutine uneven_series()
      type(growing_file_type) :: file
      type(hdf5_type) :: bad
      type(hdf5_rows_type) :: series
      type(error_type), allocatable :: error
      call bad%create(path)
      call create(series, bad, 'frequency', 0, 5000_i8)
      call series%append(bad, reshape([1.0_wp, 2.0_wp, 3.0_wp], [1, 3]))
      call series%close(bad)
      call create(series, bad, 'amplitude', 2, 5000_i8)
      call series%append(bad, reshape([1.0_wp, 2.0_wp, 3.0_wp, 4.0_wp], [2, 2]))
      call series%close(bad)
      call bad%close()
      call expect(.not. allocated(bad%failure), 'made')
      call file%claim(path, error)
      call file%reopen(error)
      call begin_series(file)
      call add_samples(file, 4, 4)
      call file%error_of(path, error)
      call expect(allocated(error), 'uneven series are refused')
      if (allocated(error)) call expect(index(error%message, 'damaged') > 0 &
         & .and. index(error%message, 'amplitude') > 0, 'with the name: '//error%message)
      call file%abandon()
   end subroutine uneven_series
end program test_growing_file
