!> Growing files: samples over any axis, published again and again, continued, given up.
program test_growing_file
   use kinds, only: wp, i8
   use text, only: to_text
   use errors, only: error_type
   use files, only: delete_file
   use hdf5_file, only: hdf5_type
   use hdf5_series, only: hdf5_series_type
   use growing_file, only: growing_file_type
   use scratch, only: scratch_path, file_there
   use check, only: runs, expect, expect_close, expect_no_error, report
   implicit none (type, external)
   character(len=:), allocatable :: path

   path = scratch_path('run.h5')
   if (runs('published_again')) call published_again()
   if (runs('continued')) call continued()
   if (runs('last_samples')) call last_samples()
   if (runs('given_up')) call given_up()
   if (runs('without_series')) call without_series()
   if (runs('uneven_series')) call uneven_series()
   call delete_file(path)
   call report()

contains

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
      call file%file%put_list('pad', [1.0_wp, 2.0_wp], '1', 'pad number', 'pad')
      call file%begin_series('frequency', 5000_i8)
   end subroutine begin_new

   !> Adds samples first to last.
   subroutine add_samples(file, first, last)
      type(growing_file_type), intent(inout) :: file
      integer, intent(in) :: first, last
      integer :: k
      if (.not. file%table%is_declared()) then
         call file%table%declare(file%file, 'frequency', 1, '', 'Hz', 'frequency')
         call file%table%declare(file%file, 'amplitude', 2, 'pad', 'm', 'amplitude')
      end if
      do k = first, last
         call file%table%add(file%file, [real(k, wp), amplitude(k)])
      end do
   end subroutine add_samples

   !> The published file has samples 1 to n, and no others.
   subroutine expect_samples(n)
      integer, intent(in) :: n
      type(hdf5_type) :: file
      type(hdf5_series_type) :: series
      real(wp), allocatable :: axis(:, :), values(:, :)
      integer :: k
      call file%open(path, writing=.false.)
      call series%open(file, 'frequency')
      call expect(series%length == n .and. series%width == 1, to_text(n)//' samples of the axis')
      call series%read(file, 0_i8, int(series%length), axis)
      call series%close(file)
      call series%open(file, 'amplitude')
      call expect(series%length == n .and. series%width == 2, to_text(n)//' samples of two pads')
      call series%read(file, 0_i8, int(series%length), values)
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
      integer :: i, before
      call begin_new(file)
      call expect(.not. file_there(path), 'nothing is seen before')
      before = 0
      do i = 1, size(ends)
         call add_samples(file, before + 1, ends(i))
         call expect(file%samples() == ends(i), 'samples are counted')
         if (i > 1) call expect_samples(before)
         call file%publish(continued=i < size(ends), error=error)
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
      call begin_new(file)
      call add_samples(file, 1, 4000)
      call file%publish(continued=.false., error=error)
      call later%claim(path, error)
      call later%reopen(error)
      call expect_no_error(error, 'opened again')
      call later%begin_series('frequency', 5000_i8)
      call expect(later%samples() == 4000_i8, 'the samples in the file count')
      call add_samples(later, 4001, 4500)
      call later%publish(continued=.true., error=error)
      call expect_no_error(error, 'published')
      call expect_samples(4500)
      call add_samples(later, 4501, 9000)
      call later%publish(continued=.false., error=error)
      call expect_samples(9000)
   end subroutine continued

   !> Of samples that are held, in the file, or were there before.
   subroutine last_samples()
      type(growing_file_type) :: file, later
      type(error_type), allocatable :: error
      real(wp), allocatable :: values(:, :)
      call begin_new(file)
      call add_samples(file, 1, 5000)
      call file%last_samples('amplitude', 1500, values)
      call expect(all(shape(values) == [2, 1500]), 'as many as asked for')
      call expect_close(norm2(values(:, 1) - amplitude(3501)) + norm2(values(:, 1500) - amplitude(5000)), 0.0_wp, &
         & 0.0_wp, 'the last ones')
      call file%publish(continued=.false., error=error)
      call later%claim(path, error)
      call later%reopen(error)
      call later%begin_series('frequency', 5000_i8)
      call later%last_samples('frequency', 2, values)
      call expect_close(norm2(values(1, :) - [4999.0_wp, 5000.0_wp]), 0.0_wp, 0.0_wp, 'those from before')
      call later%abandon()
   end subroutine last_samples

   !> The file of before stays.
   subroutine given_up()
      type(growing_file_type) :: file, later
      type(error_type), allocatable :: error
      call begin_new(file)
      call add_samples(file, 1, 10)
      call file%publish(continued=.false., error=error)
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
      type(hdf5_type) :: found
      call file%claim(path, error)
      call file%begin(error)
      call expect_no_error(error, 'begun')
      call file%file%put_real('value', 1.5_wp, '1', 'a value')
      call file%publish(continued=.true., error=error)
      call expect_no_error(error, 'published without series')
      call expect(file%samples() == 0, 'no samples')
      call file%publish(continued=.false., error=error)
      call expect_no_error(error, 'and closed')
      call found%open(path, writing=.false.)
      call expect_close(found%get_real('value'), 1.5_wp, 0.0_wp, 'its value is there')
      call found%close()
   end subroutine without_series

   !> A file whose series are not of one length is damaged.
   subroutine uneven_series()
      type(growing_file_type) :: file
      type(hdf5_type) :: bad
      type(hdf5_series_type) :: series
      type(error_type), allocatable :: error
      call bad%create(path)
      call series%create(bad, 'frequency', 0, 'Hz', 'frequency', 'frequency', 5000_i8)
      call series%append(bad, reshape([1.0_wp, 2.0_wp, 3.0_wp], [1, 3]))
      call series%close(bad)
      call series%create(bad, 'amplitude', 2, 'm', 'amplitude', 'frequency', 5000_i8)
      call series%append(bad, reshape([1.0_wp, 2.0_wp, 3.0_wp, 4.0_wp], [2, 2]))
      call series%close(bad)
      call bad%close()
      call expect(.not. allocated(bad%failure), 'made')
      call file%claim(path, error)
      call file%reopen(error)
      call file%begin_series('frequency', 5000_i8)
      call add_samples(file, 4, 4)
      call file%error_of(error)
      call expect(allocated(error), 'uneven series are refused')
      if (allocated(error)) call expect(index(error%message, 'damaged') > 0 &
         & .and. index(error%message, 'amplitude') > 0, 'with the name: '//error%message)
      call file%abandon()
   end subroutine uneven_series
end program test_growing_file
