!> Key figures of loops, against polygons whose area is known.
program test_loops
   use kinds, only: wp, pi
   use loops, only: loop_area, peak_to_peak
   use check, only: expect, expect_close, report
   implicit none (type, external)

   !> Sums of some hundred terms of order one.
   real(wp), parameter :: rounding = 1000*epsilon(1.0_wp)

   call square()
   call ellipse()
   call line()
   call swings()
   call report()

contains

   subroutine square()
      call expect_close(loop_area([0.0_wp, 0.0_wp, 2.0_wp, 2.0_wp], [0.0_wp, 3.0_wp, 3.0_wp, 0.0_wp]), 6.0_wp, &
         & rounding, 'a clockwise rectangle has a positive area')
      call expect_close(loop_area([0.0_wp, 2.0_wp, 2.0_wp, 0.0_wp], [0.0_wp, 0.0_wp, 3.0_wp, 3.0_wp]), -6.0_wp, &
         & rounding, 'an anticlockwise rectangle has a negative area')
   end subroutine square

   !> The polygon of n points on an ellipse has the area n/2 a b sin(2 pi/n), wherever its centre.
   subroutine ellipse()
      integer, parameter :: n = 360
      real(wp) :: angle(n), area
      integer :: i
      angle = [(2*pi*i/n, i=1, n)]
      area = loop_area(5 + 3*sin(angle), -7 + 0.5_wp*cos(angle))
      call expect_close(area, 0.5_wp*n*1.5_wp*sin(2*pi/n), 100*rounding, 'the polygon on an ellipse')
      ! the polygon lacks (2 pi/n)**2/6 of the ellipse
      call expect_close(area, 1.5_wp*pi, 1.5_wp*pi*(2*pi/n)**2/6, 'the ellipse, to second order')
   end subroutine ellipse

   !> There and back on any curve encloses nothing.
   subroutine line()
      real(wp), parameter :: x(*) = [0.0_wp, 1.0_wp, 2.0_wp, 3.0_wp, 2.0_wp, 1.0_wp]
      call expect_close(loop_area(x, x**2), 0.0_wp, 100*rounding, 'there and back encloses nothing')
   end subroutine line

   subroutine swings()
      call expect_close(peak_to_peak([-1.0_wp, 4.0_wp, 2.0_wp]), 5.0_wp, 0.0_wp, 'peak to peak')
      call expect_close(peak_to_peak([3.0_wp]), 0.0_wp, 0.0_wp, 'peak to peak of one point')
      call expect(peak_to_peak([-2.0_wp, -5.0_wp]) > 0, 'peak to peak of negative numbers')
   end subroutine swings
end program test_loops
