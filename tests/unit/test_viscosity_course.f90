!> Viscosities over time: exact for logarithms that are parabolas, smooth, and constant beyond the ends.
program test_viscosity_course
   use kinds, only: wp
   use viscosity_course, only: viscosity_course_type, new_viscosity_course
   use check, only: runs, expect, expect_close, report
   implicit none (type, external)

   !> s, at uneven distances.
   real(wp), parameter :: time(0:4) = [0.0_wp, 0.5_wp, 0.7_wp, 1.5_wp, 2.0_wp]

   if (runs('parabola')) call parabola()
   if (runs('smooth')) call smooth()
   if (runs('ends')) call ends()
   call report()

contains

   !> ln of a viscosity that is a parabola.
   elemental real(wp) function logarithm(t)
      real(wp), intent(in) :: t
      logarithm = -4 + 0.7_wp*t - 0.3_wp*t**2
   end function logarithm

   subroutine parabola()
      type(viscosity_course_type) :: course
      real(wp) :: found(2)
      integer :: k
      course = new_viscosity_course(time, exp(reshape([(logarithm(time(k)), 2*logarithm(time(k)), k=0, 4)], [2, 5])))
      do k = 0, 40
         call course%at(k*0.05_wp, found)
         call expect_close(log(found(1)), logarithm(k*0.05_wp), 1e-13_wp, 'first pad')
         call expect_close(log(found(2)), 2*logarithm(k*0.05_wp), 1e-13_wp, 'second pad')
      end do
   end subroutine parabola

   !> No leap of value or slope at a node.
   subroutine smooth()
      type(viscosity_course_type) :: course
      real(wp), dimension(1) :: far_before, before, after, far_after
      real(wp), parameter :: step = 1e-5_wp
      integer :: k
      course = new_viscosity_course(time, reshape([3.0_wp, 2.0_wp, 5.0_wp, 4.0_wp, 1.0_wp], [1, 5]))
      do k = 1, 3
         call course%at(time(k) - 2*step, far_before)
         call course%at(time(k) - step, before)
         call course%at(time(k) + step, after)
         call course%at(time(k) + 2*step, far_after)
         call expect_close((far_after(1) - after(1))/step, (before(1) - far_before(1))/step, 5e-3_wp, 'slope')
         call expect_close(after(1), before(1), 1e-3_wp, 'value')
      end do
   end subroutine smooth

   subroutine ends()
      type(viscosity_course_type) :: course
      real(wp) :: found(1)
      call expect(.not. course%runs(), 'none before it is made')
      course = new_viscosity_course(time, reshape([3.0_wp, 2.0_wp, 5.0_wp, 4.0_wp, 1.0_wp], [1, 5]))
      call expect(course%runs(), 'made')
      call course%at(-1.0_wp, found)
      call expect_close(found(1), 3.0_wp, 1e-14_wp, 'before')
      call course%at(9.0_wp, found)
      call expect_close(found(1), 1.0_wp, 1e-14_wp, 'behind')
   end subroutine ends
end program test_viscosity_course
