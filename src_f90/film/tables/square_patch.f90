!> Polynomials in two variables, over a square -1 <= s <= 1, through values at Chebyshev's nodes.
module square_patch
   use kinds, only: wp, pi
   implicit none (type, external)
   private
   public :: nodes, simd_width, node_points, fitted, evaluate_patch, patch_values

   !> Of `evaluate_patch`: nodes along either axis; functions at once, as many as a vector holds.
   integer, parameter :: nodes = 6, simd_width = 4

contains

   !> Places of n nodes.
   pure function node_points(n) result(points)
      integer, intent(in) :: n
      real(wp) :: points(n)
      integer :: i
      points = [(cos((i - 0.5_wp)*pi/n), i=1, n)]
   end function node_points

   !> Coefficients (function, power of the second variable, power of the first) of the polynomials with these values,
   !> (function, node along the first axis, node along the second).
   pure function fitted(values) result(coefficients)
      real(wp), intent(in) :: values(:, :, :)
      real(wp), dimension(size(values, 2), size(values, 2)) :: powers
      real(wp) :: coefficients(size(values, 1), size(values, 2), size(values, 2))
      integer :: i
      powers = powers_of_values(size(values, 2))
      do i = 1, size(values, 1)
         coefficients(i, :, :) = matmul(powers, transpose(matmul(powers, values(i, :, :))))
      end do
   end function fitted

   !> Values of n functions at s, from m nodes along either axis.
   pure function patch_values(n, m, coefficients, s) result(value)
      integer, intent(in) :: n, m
      real(wp), intent(in) :: coefficients(n, m, m), s(2)
      real(wp) :: value(n), line(n)
      integer :: i, k
      value = 0
      do i = m, 1, -1
         line = coefficients(:, i, m)
         do k = m - 1, 1, -1
            line = line*s(1) + coefficients(:, i, k)
         end do
         value = value*s(2) + line
      end do
   end function patch_values

   !> Values of four functions at s and, if they are wanted, derivatives over s, (function, axis).
   pure subroutine evaluate_patch(coefficients, s, want_slopes, value, slope)
      real(wp), intent(in) :: coefficients(simd_width, nodes, nodes), s(2)
      logical, intent(in) :: want_slopes
      real(wp), intent(out) :: value(simd_width), slope(simd_width, 2)
      real(wp), dimension(simd_width, nodes) :: line, rising
      integer :: i
      if (.not. want_slopes) then
         slope = 0
         line = coefficients(:, :, nodes)
         do i = nodes - 1, 1, -1
            line = line*s(1) + coefficients(:, :, i)
         end do
         value = line(:, nodes)
         do i = nodes - 1, 1, -1
            value = value*s(2) + line(:, i)
         end do
         return
      end if
      rising = coefficients(:, :, nodes)
      line = rising*s(1) + coefficients(:, :, nodes - 1)
      do i = nodes - 2, 1, -1
         rising = rising*s(1) + line
         line = line*s(1) + coefficients(:, :, i)
      end do
      slope(:, 2) = line(:, nodes)
      value = line(:, nodes)*s(2) + line(:, nodes - 1)
      slope(:, 1) = rising(:, nodes)*s(2) + rising(:, nodes - 1)
      do i = nodes - 2, 1, -1
         slope(:, 2) = slope(:, 2)*s(2) + value
         value = value*s(2) + line(:, i)
         slope(:, 1) = slope(:, 1)*s(2) + rising(:, i)
      end do
   end subroutine evaluate_patch

   !> Coefficients (power, node) of the polynomials that are 1 at one of the nodes and 0 at the others.
   pure function powers_of_values(n) result(powers)
      integer, intent(in) :: n
      real(wp) :: powers(n, n), points(n)
      integer :: i, k
      points = node_points(n)
      powers = 0
      powers(1, :) = 1
      do i = 1, n
         do k = 1, n
            if (k == i) cycle
            ! times (s - s_k)/(s_i - s_k)
            powers(:, i) = (eoshift(powers(:, i), -1) - points(k)*powers(:, i))/(points(i) - points(k))
         end do
      end do
   end function powers_of_values
end module square_patch
