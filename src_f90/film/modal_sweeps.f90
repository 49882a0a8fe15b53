!> The inner loops of the modal film: serial along phi, side by side over the modes of a block.
module modal_sweeps
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: lanes, solve_modes, solve_adjoint, sum_modes

   !> Modes solved side by side: the length of a vector register.
   integer, parameter :: lanes = 8

contains

   !> Numerov's scheme for q'' = V q + s, q(0) = 0, q(n) given, V = Lambda^2 + v. With a = 1 - d^2 V/12 and
   !> w = a q it reads
   !>    w(i-1) + (10 - 12/a(i)) w(i) + w(i+1) = d^2/12 (s(i-1) + 10 s(i) + s(i+1)),
   !> and f(i) = 1/(12 - a(i) (10 + e(i-1))), e = a f, eliminates with one division a node.
   pure subroutine solve_modes(n, d, stiffness, v, s, last, a, f, q)
      integer, intent(in) :: n
      !> Step; (Lambda d)^2/12 by lane; v and s by node; q(n).
      real(wp), intent(in) :: d, stiffness(lanes), v(0:n), s(0:n), last
      !> a, and the factors of the elimination, for the adjoint; the solution.
      real(wp), intent(out) :: a(lanes, 0:n), f(lanes, 0:n), q(lanes, 0:n)
      real(wp), dimension(lanes) :: e, y, w
      real(wp) :: load, unit
      integer :: i, k
      unit = d**2/12
      do i = 0, n
         do k = 1, lanes
            a(k, i) = 1 - unit*v(i) - stiffness(k)
         end do
      end do
      e = 0
      y = 0
      do i = 1, n - 1
         load = unit*(s(i - 1) + 10*s(i) + s(i + 1))
         do k = 1, lanes
            f(k, i) = 1/(12 - a(k, i)*(10 + e(k)))
            q(k, i) = y(k) - load
            e(k) = a(k, i)*f(k, i)
            y(k) = e(k)*q(k, i)
         end do
      end do
      q(:, 0) = 0
      q(:, n) = last
      w = a(:, n)*last
      do i = n - 1, 1, -1
         do k = 1, lanes
            q(k, i) = f(k, i)*(w(k) + q(k, i))
            w(k) = a(k, i)*q(k, i)
         end do
      end do
   end subroutine solve_modes

   !> The transposed scheme with the load share(k, i) load(i): the same elimination, as w = a q scales the
   !> columns of a symmetric matrix.
   pure subroutine solve_adjoint(n, a, f, share, load, adjoint)
      integer, intent(in) :: n
      real(wp), intent(in) :: a(lanes, 0:n), f(lanes, 0:n), share(lanes, 0:n), load(0:n)
      real(wp), intent(out) :: adjoint(lanes, 0:n)
      real(wp) :: y(lanes)
      integer :: i
      adjoint(:, 0) = 0
      adjoint(:, n) = 0
      y = 0
      do i = 1, n - 1
         y = f(:, i)*(a(:, i)*y - share(:, i)*load(i))
         adjoint(:, i) = y
      end do
      do i = n - 2, 1, -1
         adjoint(:, i) = adjoint(:, i) + a(:, i)*f(:, i)*adjoint(:, i + 1)
      end do
   end subroutine solve_adjoint

   !> Adds a block's sums over nodes and lanes of weight c q (sine, cosine), and its part of the pressure at
   !> two places across the width (times g).
   pure subroutine sum_modes(n, weight, sine, cosine, c, middle, side, q, sums, p_middle, p_side)
      integer, intent(in) :: n
      !> By node, and by lane (b_k cos(lambda_k Z) in the middle and towards the side).
      real(wp), intent(in) :: weight(0:n), sine(0:n), cosine(0:n), c(lanes), middle(lanes), side(lanes), q(lanes, 0:n)
      real(wp), intent(inout) :: sums(2), p_middle(0:n), p_side(0:n)
      real(wp) :: along(lanes), outward(lanes), at_middle, at_side
      integer :: i, k
      along = 0
      outward = 0
      do i = 0, n
         at_middle = 0
         at_side = 0
         !$omp simd reduction(+:at_middle, at_side)
         do k = 1, lanes
            along(k) = along(k) + weight(i)*sine(i)*q(k, i)
            outward(k) = outward(k) + weight(i)*cosine(i)*q(k, i)
            at_middle = at_middle + middle(k)*q(k, i)
            at_side = at_side + side(k)*q(k, i)
         end do
         p_middle(i) = p_middle(i) + at_middle
         p_side(i) = p_side(i) + at_side
      end do
      sums = sums + [sum(c*along), sum(c*outward)]
   end subroutine sum_modes
end module modal_sweeps
