!> Key figures of loops, against polygons whose area is known.
program test_loops
   use kinds, only: wp, pi
   use loops, only: loop_area, periodicity, new_periodicity
   use check, only: runs, expect, expect_close, report
   implicit none (type, external)

   !> Sums of some hundred terms of order one.
   real(wp), parameter :: rounding = 1000*epsilon(1.0_wp)

   if (runs('square')) call square()
   if (runs('ellipse')) call ellipse()
   if (runs('line')) call line()
   if (runs('decay')) call decay()
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

   !> A decaying oscillation of n samples a revolution: x = r**revolution sin(angle) changes by
   !> r**(k - 1) (1 - r) from revolution k - 1 to k, counted from 0.
   subroutine decay()
      integer, parameter :: n = 8
      real(wp), parameter :: ratio = 0.5_wp
      type(periodicity) :: orbit
      integer :: i, revolution
      orbit = new_periodicity(n, 2, 0)
      do i = 0, 4*n - 1
         revolution = i/n
         call orbit%add([ratio**revolution*sin(2*pi*i/n), 1.0_wp])
         if (i < 2*n - 1) call expect(orbit%change > 1e300_wp, 'no change before two whole revolutions')
         if (mod(i, n) == n - 1 .and. revolution > 0) call expect_close(orbit%change, &
            & ratio**(revolution - 1)*(1 - ratio), rounding, 'change from one revolution to the next')
      end do
   end subroutine decay
end program test_loops
