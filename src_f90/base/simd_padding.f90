!> Rows of numbers that are filled up to whole SIMD vectors of the processor, so that loops over them have no
!> equilibrium.
module simd_padding
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: simd_width, padded, apply

   integer, parameter :: simd_width = 8

contains

   !> So many numbers, filled up to whole SIMD vectors.
   elemental integer function padded(numbers)
      integer, intent(in) :: numbers
      padded = simd_width*((numbers + simd_width - 1)/simd_width)
   end function padded

   !> Matrix times vector; m is filled up.
   pure function apply(m, n, matrix, x)
      integer, intent(in) :: m, n
      real(wp), intent(in) :: matrix(m, n), x(n)
      !> Sums over odd and even columns, so that one need not wait for the other.
      real(wp) :: apply(m), odd(simd_width), even(simd_width)
      integer :: j, k, first
      do first = 0, m - 1, simd_width
         odd = 0
         even = 0
         do j = 1, n - 1, 2
            !$omp simd
            do k = 1, simd_width
               odd(k) = odd(k) + matrix(first + k, j)*x(j)
               even(k) = even(k) + matrix(first + k, j + 1)*x(j + 1)
            end do
         end do
         if (mod(n, 2) == 1) odd = odd + matrix(first + 1:first + simd_width, n)*x(n)
         apply(first + 1:first + simd_width) = odd + even
      end do
   end function apply
end module simd_padding
