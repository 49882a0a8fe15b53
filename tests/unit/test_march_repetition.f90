!> What a march does from period to period, by displacements that are given.
program test_march_repetition
   use kinds, only: wp
   use periodic_orbit, only: march_repetition_type
   use check, only: runs, expect, report
   implicit none (type, external)

   if (runs('repeats')) call repeats()
   if (runs('cause')) call cause()
   call report()

contains

   !> Twenty periods in which the third displacement, a pad's tilt, goes on by some way in a period, and alternates.
   type(march_repetition_type) function marched(creep, swing) result(march)
      real(wp), intent(in) :: creep, swing
      integer :: k
      do k = 1, 20
         call march%add([0.3_wp, 0.1_wp, creep*k + swing*(-1)**k])
      end do
   end function marched

   subroutine repeats()
      type(march_repetition_type) :: march
      call march%add([0.3_wp, 0.1_wp])
      call expect(.not. march%repeats(1), 'of a single period nothing is known')
      march = marched(5e-4_wp, 0.0_wp)
      call expect(march%repeats(1) .and. abs(march%change(1) - 5e-4_wp) < 1e-12_wp, 'changes below 1e-3 repeat')
      march = marched(0.0_wp, 0.1_wp)
      call expect(.not. march%repeats(1) .and. march%repeats(2), 'what alternates repeats after two periods')
   end subroutine repeats

   subroutine cause()
      type(march_repetition_type) :: march
      march = marched(0.0_wp, 0.1_wp)
      call says(march%cause(3), 'periodic%revolutions = 6')
      march = marched(2e-3_wp, 0.0_wp)
      call says(march%cause(1), 'pad 1 creeps by 0.002 of')
      march = marched(2e-3_wp, 0.1_wp)
      call says(march%cause(1), 'pad 1 changes by up to 0.202 of')
   end subroutine cause

   subroutine says(text, words)
      character(len=*), intent(in) :: text, words
      call expect(index(text, words) > 0, '"'//text//'" says: '//words)
   end subroutine says
end program test_march_repetition
