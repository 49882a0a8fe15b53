!> Rows of numbers that are filled up to whole vectors of the processor, so that loops over them have no rest.
module whole_vectors
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: lanes, padded, apply

   integer, parameter :: lanes = 8

contains

   !> So many numbers, filled up to whole vectors.
   elemental integer function padded(numbers)
      integer, intent(in) :: numbers
      padded = lanes*((numbers + lanes - 1)/lanes)
   end function padded

   !> Matrix times vector; m is filled up.
   pure function apply(m, n, matrix, x)
      integer, intent(in) :: m, n
      real(wp), intent(in) :: matrix(m, n), x(n)
      !> Sums over odd and even columns, so that one need not wait for the other.
      real(wp) :: apply(m), odd(lanes), even(lanes)
      integer :: j, k, first
      do first = 0, m - 1, lanes
         odd = 0
         even = 0
         do j = 1, n - 1, 2
            !$omp simd
            do k = 1, lanes
               odd(k) = odd(k) + matrix(first + k, j)*x(j)
               even(k) = even(k) + matrix(first + k, j + 1)*x(j + 1)
            end do
         end do
         if (mod(n, 2) == 1) odd = odd + matrix(first + 1:first + lanes, n)*x(n)
         apply(first + 1:first + lanes) = odd + even
      end do
   end function apply
end module whole_vectors
