!> Polynomials over a square: exact for polynomials, their slopes, and how an analytic function converges.
program test_square_patch
   use kinds, only: wp
   use text, only: to_text
   use square_patch, only: nodes, simd_width, node_points, fitted, evaluate_patch, patch_values
   use check, only: runs, expect_close, between, report
   implicit none (type, external)

   if (runs('polynomials')) call polynomials()
   if (runs('through_nodes')) call through_nodes()
   if (runs('order')) call order()
   call report()

contains

   !> Polynomials of the highest degree along both axes, with their derivatives, to rounding.
   subroutine polynomials()
      real(wp) :: factors(simd_width, 0:nodes - 1, 0:nodes - 1), values(simd_width, nodes, nodes), points(nodes)
      real(wp) :: coefficients(simd_width, nodes, nodes), found(simd_width), slope(simd_width, 2), s(2), few(simd_width)
      real(wp), parameter :: rounding = 1e-12_wp
      integer :: i, k, trial
      call random_number(factors)
      points = node_points(nodes)
      do k = 1, nodes
         do i = 1, nodes
            values(:, i, k) = polynomial(factors, [points(i), points(k)], [0, 0])
         end do
      end do
      coefficients = fitted(values)
      do trial = 1, 20
         s = [between(-1.0_wp, 1.0_wp), between(-1.0_wp, 1.0_wp)]
         call evaluate_patch(coefficients, s, .true., found, slope)
         call expect_close(norm2(found - polynomial(factors, s, [0, 0])), 0.0_wp, rounding, 'values')
         call expect_close(norm2(slope(:, 1) - polynomial(factors, s, [1, 0])), 0.0_wp, 10*rounding, 'first slope')
         call expect_close(norm2(slope(:, 2) - polynomial(factors, s, [0, 1])), 0.0_wp, 10*rounding, 'second slope')
         few = patch_values(simd_width, nodes, coefficients, s)
         call expect_close(norm2(few - found), 0.0_wp, rounding, 'values alone')
      end do
   end subroutine polynomials

   !> A derivative (orders along both axes, 0 or 1) of polynomials with these factors of s1^i s2^k.
   pure function polynomial(factors, s, orders) result(value)
      real(wp), intent(in) :: factors(simd_width, 0:nodes - 1, 0:nodes - 1), s(2)
      integer, intent(in) :: orders(2)
      real(wp) :: value(simd_width), first(0:nodes - 1), second(0:nodes - 1)
      integer :: i, k
      first = merge([(s(1)**i, i=0, nodes - 1)], [0.0_wp, (i*s(1)**(i - 1), i=1, nodes - 1)], orders(1) == 0)
      second = merge([(s(2)**i, i=0, nodes - 1)], [0.0_wp, (i*s(2)**(i - 1), i=1, nodes - 1)], orders(2) == 0)
      value = 0
      do k = 0, nodes - 1
         do i = 0, nodes - 1
            value = value + factors(:, i, k)*first(i)*second(k)
         end do
      end do
   end function polynomial

   !> Any number of nodes and functions: the values at the nodes come back.
   subroutine through_nodes()
      integer :: m, n, i, k
      real(wp), allocatable :: values(:, :, :), coefficients(:, :, :), points(:)
      real(wp) :: worst
      do m = 1, 7
         n = 2*m + 1
         allocate (values(n, m, m))
         call random_number(values)
         points = node_points(m)
         coefficients = fitted(values)
         worst = 0
         do k = 1, m
            do i = 1, m
               worst = max(worst, norm2(patch_values(n, m, coefficients, [points(i), points(k)]) - values(:, i, k)))
            end do
         end do
         call expect_close(worst, 0.0_wp, 1e-12_wp, to_text(m)//' nodes')
         deallocate (values)
      end do
   end subroutine through_nodes

   !> The error of exp(a s1 + b s2) over half the square is 2^-nodes of that over the whole; its slopes lose one order.
   subroutine order()
      real(wp) :: errors(2, 0:1), points(nodes), values(simd_width, nodes, nodes), found(simd_width), &
         & slope(simd_width, 2), s(2), size
      real(wp) :: coefficients(simd_width, nodes, nodes), ratio
      integer :: halving, i, k
      points = node_points(nodes)
      errors = 0
      do halving = 0, 1
         size = 0.5_wp**halving
         do k = 1, nodes
            do i = 1, nodes
               values(:, i, k) = exp(dot_product([1.0_wp, 0.5_wp], size*[points(i), points(k)]))
            end do
         end do
         coefficients = fitted(values)
         do k = -10, 10
            do i = -10, 10
               s = [i, k]/10.0_wp
               call evaluate_patch(coefficients, s, .true., found, slope)
               errors(1, halving) = max(errors(1, halving), abs(found(1) - exp(dot_product([1.0_wp, 0.5_wp], size*s))))
               errors(2, halving) = max(errors(2, halving), abs(slope(1, 1)/size &
                  & - exp(dot_product([1.0_wp, 0.5_wp], size*s))))
            end do
         end do
      end do
      ratio = log(errors(1, 0)/errors(1, 1))/log(2.0_wp)
      call expect_close(ratio, real(nodes, wp), 1.0_wp, 'order of the values: '//to_text(ratio))
      ratio = log(errors(2, 0)/errors(2, 1))/log(2.0_wp)
      call expect_close(ratio, nodes - 1.0_wp, 1.0_wp, 'order of the slopes: '//to_text(ratio))
   end subroutine order
end program test_square_patch
