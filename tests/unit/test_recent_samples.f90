!> The last samples of a run, kept in memory, against a list of all of them, also where they go through a checkpoint on
!> the way.
program test_recent_samples
   use kinds, only: wp, i8
   use text, only: to_text
   use record, only: record_type
   use growing_file, only: growing_file_type
   use check, only: runs, expect, report
   implicit none (type, external)
   integer, parameter :: pads = 3, last = 25

   if (runs('against_a_list')) call against_a_list()
   if (runs('through_checkpoints')) call through_checkpoints()
   if (runs('before_the_first')) call before_the_first()
   if (runs('checkpoints_refused')) call checkpoints_refused()
   call report()

contains

   !> Values of sample k, from 0: of the time, and of each pad.
   pure function values_of(k) result(values)
      integer, intent(in) :: k
      real(wp) :: values(1 + pads)
      integer :: i
      values = [0.1_wp*k, (sin(real(k + 100*i, wp)), i=1, pads)]
   end function values_of

   !> Begins series of which this number of samples is kept.
   subroutine begin(recent, room)
      type(growing_file_type), intent(inout) :: recent
      integer, intent(in) :: room
      call recent%begin_series('time', 1000_i8, room)
      call recent%declare('time', 1, 's', 'time', '')
      call recent%declare('pad_tilt', pads, 'rad', 'tilt', 'pad')
   end subroutine begin

   !> Goes on from a record; true where it fits together.
   logical function taken_up(recent, record, room) result(ok)
      type(growing_file_type), intent(inout) :: recent
      type(record_type), intent(in) :: record
      integer, intent(in) :: room
      call recent%begin_series('time', 1000_i8, room)
      call recent%restore(record)
      ok = .not. allocated(recent%failure)
   end function taken_up

   !> It has the first and the last `room` of n samples.
   subroutine expect_samples(recent, n, room)
      type(growing_file_type), intent(inout) :: recent
      integer, intent(in) :: n, room
      real(wp), allocatable :: times(:, :), tilts(:, :)
      real(wp) :: expected(1 + pads)
      integer :: first, k
      logical :: same
      first = max(0, n - room)
      call expect(recent%samples == n .and. recent%first() == first, to_text(n)//' samples, room for '//to_text(room))
      call recent%last_samples('time', n - first, times)
      call recent%last_samples('pad_tilt', n - first, tilts)
      call expect(all(shape(times) == [1, n - first]) .and. all(shape(tilts) == [pads, n - first]), 'sizes')
      same = .true.
      do k = first, n - 1
         expected = values_of(k)
         same = same .and. all(abs([times(:, k - first + 1), tilts(:, k - first + 1)] - expected) <= 0)
      end do
      call expect(same, to_text(n)//' samples, room for '//to_text(room)//': the last ones')
      call recent%part_of_samples('pad_tilt', 0_i8, 1, tilts)
      expected = values_of(0)
      call expect(all(abs(tilts(:, 1) - expected(2:)) <= 0), 'and the first')
   end subroutine expect_samples

   subroutine against_a_list()
      type(growing_file_type) :: recent
      integer :: room, n
      do room = 1, 12
         call recent%begin_series('time', 1000_i8, room)
         call expect(.not. recent%declared, 'nothing at first')
         call expect(.not. recent%has_series('time'), 'and no series')
         call begin(recent, room)
         call expect(recent%has_series('time'), 'declared')
         call expect(.not. recent%has_series('speed'), 'and no other')
         do n = 1, last
            call recent%add(values_of(n - 1))
            call expect(recent%declared, 'and known so')
            call expect_samples(recent, n, room)
         end do
      end do
   end subroutine against_a_list

   !> Saved after each sample and taken up by another, which goes on: the same samples at the end.
   subroutine through_checkpoints()
      type(growing_file_type), allocatable :: recent
      type(record_type) :: record
      integer :: room, n
      do room = 1, 12
         allocate (recent)
         call begin(recent, room)
         do n = 1, last
            call recent%add(values_of(n - 1))
            call record%delete('checkpoint')
            call recent%save(record)
            deallocate (recent)
            allocate (recent)
            call expect(taken_up(recent, record, room), 'taken up')
            call expect_samples(recent, n, room)
         end do
         deallocate (recent)
      end do
   end subroutine through_checkpoints

   subroutine before_the_first()
      type(growing_file_type) :: recent, later
      type(record_type) :: record
      call begin(recent, 5)
      call recent%save(record)
      call expect(.not. record%has('checkpoint'), 'nothing is saved')
      call expect(taken_up(later, record, 5), 'taken up')
      call expect(.not. later%declared .and. later%samples == 0, 'and it was nothing')
   end subroutine before_the_first

   !> One that does not fit together, as of a damaged file, or of another number of samples that are kept.
   subroutine checkpoints_refused()
      type(growing_file_type) :: recent, later
      type(record_type) :: record
      integer :: fault, n
      do fault = 1, 5
         call begin(recent, 5)
         do n = 0, 9
            call recent%add(values_of(n))
         end do
         call record%clear()
         call recent%save(record)
         select case (fault)
         case (1)
            call record%put('checkpoint/sample_count', 3_i8, 'samples so far')
         case (2)
            call record%delete('checkpoint/samples/01_time')
         case (3)
            call record%put('checkpoint/samples/01_time', [1.0_wp, 2.0_wp], 's', 'time')
         case (4)
            call record%delete('checkpoint/first_sample')
         case default
            call record%delete('checkpoint/samples')
         end select
         call expect(.not. taken_up(later, record, 5), 'fault '//to_text(fault))
         deallocate (later%failure)
      end do
   end subroutine checkpoints_refused
end program test_recent_samples
