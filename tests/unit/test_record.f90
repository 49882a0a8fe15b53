!> The record of a run: what it has after it was cleared and filled again, and the file written from it again
!> and again.
program test_record
   use kinds, only: wp, i8
   use text, only: to_text
   use files, only: delete_file
   use record, only: record_type, move_record
   use record_file, only: write_record, read_record
   use hdf5_file, only: hdf5_type
   use scratch, only: scratch_path
   use check, only: runs, expect, expect_close, report
   implicit none (type, external)

   if (runs('put_and_get')) call put_and_get()
   if (runs('ranks')) call ranks()
   if (runs('deleted')) call deleted()
   if (runs('filled_again')) call filled_again()
   if (runs('versions')) call versions()
   if (runs('moved')) call moved()
   if (runs('written_again')) call written_again()
   call report()

contains

   !> A run of k pads, 1 or more; every third has a figure that the others lack.
   subroutine fill(record, k)
      type(record_type), intent(inout) :: record
      integer, intent(in) :: k
      character(len=8) :: names(2*k)
      integer :: i
      call record%clear()
      call record%put_flag('complete', mod(k, 2))
      call record%put_text('title', 'run '//to_text(k))
      call record%put('pad', [(real(i, wp), i=1, k)], '1', 'pad number', 'pad')
      call record%put_labels('pivot', [character(len=8) :: 'locked', 'pivot '//to_text(k)], 'pivots')
      call record%put_count('statistics/steps', 2_i8**40 + k, 'time steps')
      call record%put('summary/orbit_y', 0.1_wp*k, 'm', 'orbit')
      if (mod(k, 3) == 0) call record%put('summary/only', 0.3_wp*k, 'W', 'of every third')
      call record%put('modes/frequency', reshape([(1.5_wp**i, i=1, 2*k)], [k, 2]), 'Hz', 'frequencies', &
         & 'pivot pad')
      do i = 1, 2*k
         names(i) = 'mode '//to_text(i)
      end do
      call record%put_labels('modes/name', names, 'names', [k, 2], 'pivot pad')
   end subroutine fill

   !> It has all of run k, and nothing else.
   subroutine expect_run(record, k, what)
      type(record_type), intent(inout) :: record
      integer, intent(in) :: k
      character(len=*), intent(in) :: what
      real(wp) :: values(2*k)
      integer :: i
      call expect(record%list_size('pad') == k .and. record%list_size('modes/frequency') == 2*k, what//': sizes')
      call record%get_list('modes/frequency', values)
      call expect(all(abs(values - [(1.5_wp**i, i=1, 2*k)]) <= 0), what//': values')
      call expect_close(record%get_real('summary/orbit_y'), 0.1_wp*k, 0.0_wp, what//': a number')
      call expect(nint(record%get_real('statistics/steps'), i8) == 2_i8**40 + k, what//': a count')
      call expect(record%has('summary/only') .eqv. mod(k, 3) == 0, what//': a figure that not all have')
   end subroutine expect_run

   subroutine put_and_get()
      type(record_type) :: record
      character(len=:), allocatable :: text
      real(wp) :: three(3)
      integer :: flag
      call expect(.not. record%has('pad'), 'nothing at first')
      call fill(record, 3)
      call expect_run(record, 3, 'filled')
      call expect(record%has('summary'), 'a group is there')
      call expect(.not. record%has('summ'), 'its first letters are not')
      call record%get_text('title', text)
      call record%get_flag('complete', flag)
      call expect(text == 'run 3' .and. flag == 1, 'attributes')
      call record%get_text('none', text)
      call record%get_flag('none', flag)
      call expect(text == '' .and. flag == 0, 'and those that are not there')
      call record%get_list('none', three)
      call expect(all(abs(three) <= 0) .and. abs(record%get_real('none')) <= 0, 'numbers that are not there are 0')
      call record%get_list('modes/frequency', three)
      call expect(all(abs(three) <= 0), 'nor is a list of another size')
   end subroutine put_and_get

   !> Arrays of any rank, also without numbers, as expressions and as variables.
   subroutine ranks()
      type(record_type) :: record
      real(wp), allocatable :: none(:), table(:, :)
      integer :: i, n
      n = 0
      allocate (none(0), table(2, 0))
      call record%put('mode', [(real(i, wp), i=1, n)], '1', 'modes', 'mode')
      call record%put('frequency', none, 'Hz', 'frequencies', 'mode')
      call record%put('shape', table, 'm', 'shapes', 'mode pad')
      call record%put('twice', 2*table, 'm', 'shapes', 'mode pad')
      call record%put('four', reshape([(real(i, wp), i=1, 24)], [1, 2, 3, 4]), 'm', 'of four dimensions', '')
      call expect(record%count == 5, 'all are there')
      call expect(all([(size(record%datasets(i)%values), i=1, 5)] == [0, 0, 0, 0, 24]), 'numbers')
      call expect(all(record%datasets(1)%extents == [0]) .and. all(record%datasets(2)%extents == [0]), 'lists')
      call expect(all(record%datasets(3)%extents == [2, 0]) .and. all(record%datasets(4)%extents == [2, 0]), 'tables')
      call expect(all(record%datasets(5)%extents == [1, 2, 3, 4]), 'four dimensions')
   end subroutine ranks

   !> What was deleted is gone until it is put again, in whatever order it comes.
   subroutine deleted()
      type(record_type) :: record
      call fill(record, 3)
      call record%delete('summary')
      call expect(.not. record%has('summary'), 'a group')
      call expect(.not. record%has('summary/only'), 'with all in it')
      call expect(record%has('statistics/steps'), 'and no other')
      call record%put('summary/only', 2.0_wp, 'W', 'of every third')
      call expect(record%has('summary'), 'put again')
      call expect(.not. record%has('summary/orbit_y'), 'alone')
      call record%delete('pad')
      call expect(.not. record%has('pad'), 'a dataset')
      call expect(record%has('pivot'), 'alone')
   end subroutine deleted

   !> Runs of more and fewer datasets, of other sizes, one after another in one record.
   subroutine filled_again()
      type(record_type) :: record
      integer, parameter :: order(*) = [3, 1, 2, 6, 6, 5, 1, 3]
      character(len=:), allocatable :: text
      integer :: i
      do i = 1, size(order)
         call fill(record, order(i))
         call expect_run(record, order(i), 'run '//to_text(i))
         call record%get_text('title', text)
         call expect(text == 'run '//to_text(order(i)), 'its title')
      end do
      call record%clear()
      call expect(record%list_size('pad') == 0, 'nothing after it was cleared')
      call expect(.not. record%has('summary'), 'no group')
      call record%get_text('title', text)
      call expect(text == '', 'no attribute either')
   end subroutine filled_again

   !> The version says whether what the datasets are has changed; numbers do not count.
   subroutine versions()
      type(record_type) :: record
      integer :: before
      call fill(record, 3)
      before = record%version
      call fill(record, 3)
      call expect(record%version == before, 'another run of the same datasets')
      call record%clear()
      call record%put('summary/orbit_y', 1.0_wp, 'm', 'orbit')
      call expect(record%version == before, 'fewer of them')
      call fill(record, 2)
      call expect(record%version > before, 'other sizes')
      before = record%version
      call record%put_labels('pivot', [character(len=8) :: 'locked', 'free'], 'pivots')
      call expect(record%version > before, 'other texts')
   end subroutine versions

   subroutine moved()
      type(record_type) :: from, to
      call fill(from, 3)
      call fill(to, 6)
      call move_record(from, to)
      call expect_run(to, 3, 'moved')
      call expect(.not. from%has('pad'), 'the other has nothing')
      call fill(from, 2)
      call expect_run(from, 2, 'and can be filled again')
   end subroutine moved

   !> Its file, written as it changes: sizes that change after they were deleted, what is no longer there, and a file
   !> that lacks more than the record knows.
   subroutine written_again()
      type(record_type) :: record, found
      type(hdf5_type) :: file
      character(len=:), allocatable :: path
      real(wp), allocatable :: values(:)
      integer :: i, k
      path = scratch_path('record.h5')
      call file%create(path)
      call fill(record, 3)
      call write_record(record, file, .false.)
      call record%put('checkpoint/state', [1.0_wp, 2.0_wp], '1', 'state', '')
      call write_record(record, file, .false.)
      do k = 3, 5
         ! deleted or not
         if (k /= 4) call record%delete('checkpoint')
         call record%put('checkpoint/state', [(0.5_wp*i, i=1, k)], '1', 'state', '')
         call record%put('summary/orbit_y', 7.0_wp, 'm', 'orbit')
         ! a scale that grows with what is over it
         call record%put('revolution', [(real(i - k, wp), i=1, k)], '1', 'revolutions', 'revolution')
         call record%put('by_revolution/lowest_y', [(2.0_wp*i, i=1, k)], 'm', 'lowest', 'revolution')
         call write_record(record, file, .false.)
         call expect(.not. allocated(file%failure), 'written with another size')
      end do
      call file%get_list('checkpoint/state', values)
      call expect(size(values) == 5, 'the last size of a state')
      call file%get_list('revolution', values)
      call expect(size(values) == 5, 'of a scale')
      call file%get_list('by_revolution/lowest_y', values)
      call expect(size(values) == 5, 'and of what is over it')
      call record%delete('checkpoint')
      call write_record(record, file, .false.)
      call expect(.not. file%has('checkpoint'), 'what was deleted is not in the file')
      call file%close()
      ! one that was never written before, as the file of the last checkpoint but one
      call file%create(path)
      call write_record(record, file, .true.)
      call record%put('summary/orbit_y', 0.1_wp*3, 'm', 'orbit')
      call write_record(record, file, .false.)
      call file%close()
      call file%open(path, writing=.false.)
      call read_record(file, found)
      call expect_run(found, 3, 'read back')
      call expect(len(names_of(found)) > 40 .and. names_of(found) == names_of(record), 'names read back')
      call expect(.not. allocated(file%failure), 'the file is whole')
      call file%close()
      call delete_file(path)
   end subroutine written_again

   !> The texts of a table, and its scales.
   pure function names_of(record) result(names)
      type(record_type), intent(in) :: record
      character(len=:), allocatable :: names
      integer :: i
      names = ''
      do i = 1, record%count
         associate (own => record%datasets(i))
            if (own%path == 'modes/name') names = own%texts//own%scales
         end associate
      end do
   end function names_of
end program test_record
