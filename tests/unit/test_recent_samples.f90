!> The last samples of a run against a list of all of them, also where they go through a checkpoint on the way.
program test_recent_samples
   use kinds, only: wp, i8
   use text, only: to_text
   use record, only: record_type
   use recent_samples, only: recent_samples_type
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

   subroutine declare_all(recent)
      type(recent_samples_type), intent(inout) :: recent
      call recent%declare('time', 1, '', 's', 'time')
      call recent%declare('pad_tilt', pads, 'pad', 'rad', 'tilt')
   end subroutine declare_all

   !> It has the first and the last `room` of n samples.
   subroutine expect_samples(recent, n, room)
      type(recent_samples_type), intent(in) :: recent
      integer, intent(in) :: n, room
      real(wp), allocatable :: times(:, :), tilts(:, :)
      real(wp) :: expected(1 + pads)
      integer :: first, k
      logical :: same
      first = max(0, n - room)
      call expect(recent%count == n .and. recent%first() == first, to_text(n)//' samples, room for '//to_text(room))
      call recent%part('time', recent%first(), n - first, times)
      call recent%part('pad_tilt', recent%first(), n - first, tilts)
      call expect(all(shape(times) == [1, n - first]) .and. all(shape(tilts) == [pads, n - first]), 'sizes')
      same = .true.
      do k = first, n - 1
         expected = values_of(k)
         same = same .and. all(abs([times(:, k - first + 1), tilts(:, k - first + 1)] - expected) <= 0) .and. &
            & all(abs(recent%sample(int(k, i8)) - expected) <= 0)
      end do
      call expect(same, to_text(n)//' samples, room for '//to_text(room)//': the last ones')
      call recent%part('pad_tilt', 0_i8, 1, tilts)
      expected = values_of(0)
      call expect(all(abs(tilts(:, 1) - expected(2:)) <= 0), 'and the first')
   end subroutine expect_samples

   subroutine against_a_list()
      type(recent_samples_type) :: recent
      integer :: room, n
      do room = 1, 12
         call recent%begin(room)
         call expect(size(recent%series) == 0 .and. .not. recent%has('time'), 'nothing at first')
         call declare_all(recent)
         call expect(size(recent%series) > 0 .and. recent%has('time') .and. .not. recent%has('speed'), 'declared')
         do n = 1, last
            call recent%add(values_of(n - 1))
            call expect_samples(recent, n, room)
         end do
      end do
   end subroutine against_a_list

   !> Saved after each sample and taken up by another, which goes on: the same samples at the end.
   subroutine through_checkpoints()
      type(recent_samples_type), allocatable :: recent
      type(record_type) :: record
      integer :: room, n
      logical :: ok
      do room = 1, 12
         allocate (recent)
         call recent%begin(room)
         call declare_all(recent)
         do n = 1, last
            call recent%add(values_of(n - 1))
            call record%delete('checkpoint')
            call recent%save(record)
            deallocate (recent)
            allocate (recent)
            call recent%begin(room)
            call recent%restore(record, ok)
            call expect(ok, 'taken up')
            call expect_samples(recent, n, room)
         end do
         deallocate (recent)
      end do
   end subroutine through_checkpoints

   subroutine before_the_first()
      type(recent_samples_type) :: recent, later
      type(record_type) :: record
      logical :: ok
      call recent%begin(5)
      call declare_all(recent)
      call recent%save(record)
      call expect(.not. record%has('checkpoint'), 'nothing is saved')
      call later%begin(5)
      call later%restore(record, ok)
      call expect(ok .and. size(later%series) == 0 .and. later%count == 0, 'and nothing taken up')
   end subroutine before_the_first

   !> One that does not fit together, as of a damaged file, or of another number of samples that are kept.
   subroutine checkpoints_refused()
      type(recent_samples_type) :: recent
      type(record_type) :: record
      integer :: fault, n
      logical :: ok
      do fault = 1, 5
         call recent%begin(5)
         call declare_all(recent)
         do n = 0, 9
            call recent%add(values_of(n))
         end do
         call record%clear()
         call recent%save(record)
         select case (fault)
         case (1)
            call record%put_count('checkpoint/sample_count', 3_i8, 'samples so far')
         case (2)
            call record%delete('checkpoint/samples/01_time')
         case (3)
            call record%put_list('checkpoint/samples/01_time', [1.0_wp, 2.0_wp], 's', 'time', '')
         case (4)
            call record%delete('checkpoint/first_sample')
         case default
            call record%delete('checkpoint/samples')
         end select
         call recent%begin(5)
         call recent%restore(record, ok)
         call expect(.not. ok, 'fault '//to_text(fault))
      end do
   end subroutine checkpoints_refused
end program test_recent_samples
