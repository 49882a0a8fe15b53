!> Some ten linear equations with some ten right-hand sides: calls and checks of LAPACK's routines cost several times
!> the arithmetic.
module small_system
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: solve_small

contains

   !> Replaces b by x of the equations a x = b, column by column. Gaussian elimination with the largest element of a
   !> column as pivot; not `ok` where there is none.
   pure subroutine solve_small(a, b, ok)
      real(wp), intent(in), contiguous :: a(:, :)
      real(wp), intent(inout), contiguous :: b(:, :)
      logical, intent(out) :: ok
      !> An equation with all its right-hand sides is a column here: these are long, and next to each other.
      real(wp) :: equation(size(a, 2) + size(b, 2), size(a, 1)), first(size(a, 2) + size(b, 2))
      integer :: i, k, n, pivot
      n = size(a, 1)
      do i = 1, n
         equation(:n, i) = a(i, :)
         equation(n + 1:, i) = b(i, :)
      end do
      do k = 1, n
         pivot = k - 1 + maxloc(abs(equation(k, k:)), dim=1)
         ok = abs(equation(k, pivot)) > 0
         if (.not. ok) return
         first(k:) = equation(k:, pivot)
         if (pivot /= k) equation(k:, pivot) = equation(k:, k)
         equation(k + 1:, k) = first(k + 1:)/first(k)
         do i = k + 1, n
            equation(k + 1:, i) = equation(k + 1:, i) - equation(k, i)*equation(k + 1:, k)
         end do
      end do
      do k = n, 2, -1
         do i = 1, k - 1
            equation(n + 1:, i) = equation(n + 1:, i) - equation(k, i)*equation(n + 1:, k)
         end do
      end do
      do i = 1, n
         b(i, :) = equation(n + 1:, i)
      end do
   end subroutine solve_small
end module small_system
