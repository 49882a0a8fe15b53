!> Intervals of the piecewise linear logarithm: every number in one, ends exact, finer levels within coarser ones.
program test_octaves
   use kinds, only: wp
   use text, only: to_text
   use octaves, only: interval, lower_end
   use check, only: runs, expect, between, report
   implicit none (type, external)

   integer, parameter :: finest = 8

   if (runs('every_number')) call every_number()
   if (runs('ends_belong_above')) call ends_belong_above()
   if (runs('ends_are_shared')) call ends_are_shared()
   if (runs('equal_lengths')) call equal_lengths()
   call report()

contains

   !> A number of any size lies between the ends of its interval, at every level.
   subroutine every_number()
      integer :: trial, level, k, outside(0:finest)
      real(wp) :: x
      outside = 0
      do trial = 1, 2000
         x = 2**between(-50.0_wp, 30.0_wp)
         do level = 0, finest
            k = interval(x, level)
            if (.not. (lower_end(k, level) <= x .and. x < lower_end(k + 1, level))) outside(level) = outside(level) + 1
         end do
      end do
      do level = 0, finest
         call expect(outside(level) == 0, to_text(outside(level))//' numbers outside, level '//to_text(level))
      end do
   end subroutine every_number

   !> An end is in the interval above it, and the number just below it in the one below.
   subroutine ends_belong_above()
      integer :: level, k, wrong
      do level = 0, finest
         wrong = 0
         do k = -3*2**level, 3*2**level
            associate (x => lower_end(k, level))
               if (interval(x, level) /= k .or. interval(nearest(x, -1.0_wp), level) /= k - 1) wrong = wrong + 1
            end associate
         end do
         call expect(wrong == 0, to_text(wrong)//' ends in a wrong interval, level '//to_text(level))
      end do
   end subroutine ends_belong_above

   !> To the last bit, so that cells that are cut meet their neighbours at the same corners.
   subroutine ends_are_shared()
      integer :: level, k, apart
      apart = 0
      do level = 0, finest - 1
         do k = -5*2**level, 5*2**level
            if (abs(lower_end(k, level) - lower_end(2*k, level + 1)) > 0) apart = apart + 1
         end do
      end do
      call expect(apart == 0, to_text(apart)//' ends differ between levels')
   end subroutine ends_are_shared

   !> An octave begins at a power of 2 and is cut evenly.
   subroutine equal_lengths()
      integer :: octave, k
      do octave = -4, 4
         do k = 0, 7
            call expect(abs(lower_end(interval(2.0_wp**octave, 3) + k, 3) - 2.0_wp**octave*(1 + k/8.0_wp)) <= 0, &
               & 'end '//to_text(k)//' of octave '//to_text(octave))
         end do
      end do
   end subroutine equal_lengths
end program test_octaves
