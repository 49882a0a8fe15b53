!> Two linear equations.
module solve_2x2
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: solved

contains

   !> x of the equations a x = b; 0 where they are singular.
   pure function solved(a, b) result(x)
      real(wp), intent(in) :: a(2, 2), b(2)
      real(wp) :: x(2), determinant
      x = 0
      determinant = a(1, 1)*a(2, 2) - a(1, 2)*a(2, 1)
      if (abs(determinant) > 0) x = [a(2, 2)*b(1) - a(1, 2)*b(2), a(1, 1)*b(2) - a(2, 1)*b(1)]/determinant
   end function solved
end module solve_2x2
