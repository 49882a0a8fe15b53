!> Small systems of equations, against solutions that are known.
program test_small_system
   use kinds, only: wp
   use small_system, only: solve_small
   use check, only: runs, expect, report
   implicit none (type, external)

   if (runs('pivots')) call pivots()
   if (runs('many')) call many()
   if (runs('singular')) call singular()
   call report()

contains

   !> The first pivot is 0, and elimination makes the second one tiny.
   subroutine pivots()
      real(wp), parameter :: a(3, 3) = reshape([0.0_wp, 2.0_wp, 4.0_wp, 1e-20_wp, 1.0_wp, -1.0_wp, 3.0_wp, 5.0_wp, &
         & 2.0_wp], [3, 3])
      real(wp), parameter :: x(3, 2) = reshape([1.0_wp, -2.0_wp, 3.0_wp, 0.5_wp, 0.25_wp, -4.0_wp], [3, 2])
      real(wp) :: b(3, 2)
      logical :: ok
      b = matmul(a, x)
      call solve_small(a, b, ok)
      call expect(ok .and. all(abs(b - x) < 1e-14_wp), 'a system whose diagonal has no pivots')
   end subroutine pivots

   !> As many equations as an interval of an orbit has. What is left of the equations is rounding; the distance to the
   !> solution would grow with the condition of a random matrix.
   subroutine many()
      real(wp) :: a(24, 24), b(24, 15), x(24, 15)
      logical :: ok
      call random_number(a)
      call random_number(x)
      b = matmul(a, x)
      x = b
      call solve_small(a, x, ok)
      call expect(ok .and. all(abs(matmul(a, x) - b) < 1e-10_wp), 'the equations of an interval are satisfied')
   end subroutine many

   subroutine singular()
      real(wp) :: a(3, 3), b(3, 1)
      logical :: ok
      call random_number(a)
      a(:, 2) = 0
      b = 1
      call solve_small(a, b, ok)
      call expect(.not. ok, 'a system without solution is refused')
   end subroutine singular
end program test_small_system
