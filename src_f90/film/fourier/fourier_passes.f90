!> The inner loops of the Fourier film: along the arc from both edges to the middle and back, so that two
!> chains of divisions run at a time; side by side over the modes of a block.
module fourier_passes
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: simd_width, weigh_nodes, solve_modes, solve_adjoints, sum_modes, looks, &
      & lowest_pressure, sum_adjoint

   !> Modes solved side by side: the length of a vector register.
   integer, parameter :: simd_width = 8

   !> Points across the width where cavitation is looked for.
   integer, parameter :: looks = 4

contains

   !> Numerov's scheme for q'' = V q + s, q(0) = 0, q(n) given, n even, V = Lambda^2 H^2 + v. With
   !> a = 1 - d^2 V/12 and w = a q it reads
   !>    (12 - 10 a(i)) q(i) = w(i-1) + w(i+1) - load(i),   load(i) = d^2/12 (s(i-1) + 10 s(i) + s(i+1)).
   !> Elimination from an edge leaves w(i) = e(i) w(next inwards) + y(i), with e = a f and
   !> f(i) = 1/(12 - a(i) (10 + e(next outwards))).
   pure subroutine solve_modes(n, square, base, rate, load, last, a, f, q)
      ! long: a kernel
      integer, intent(in) :: n
      !> Lambda^2 by slot; by node 1 - d^2 v/12, d^2 H^2/12 and the load; q(n).
      real(wp), intent(in) :: square(simd_width), base(0:n), rate(0:n), load(0:n), last
      !> a, and the factors of the elimination, for the adjoint; the solution.
      real(wp), intent(out) :: a(simd_width, 0:n), f(simd_width, 0:n), q(simd_width, 0:n)
      real(wp), dimension(simd_width) :: e, e2, y, y2, w, w2
      integer :: i, j, k
      e = 0
      e2 = 0
      y = 0
      a(:, n) = base(n) - square*rate(n)
      y2 = a(:, n)*last
      do i = 1, n/2 - 1
         j = n - i
         !$omp simd
         do k = 1, simd_width
            a(k, i) = base(i) - square(k)*rate(i)
            f(k, i) = 1/(12 - a(k, i)*(10 + e(k)))
            q(k, i) = y(k) - load(i)
            e(k) = a(k, i)*f(k, i)
            y(k) = e(k)*q(k, i)
         end do
         !$omp simd
         do k = 1, simd_width
            a(k, j) = base(j) - square(k)*rate(j)
            f(k, j) = 1/(12 - a(k, j)*(10 + e2(k)))
            q(k, j) = y2(k) - load(j)
            e2(k) = a(k, j)*f(k, j)
            y2(k) = e2(k)*q(k, j)
         end do
      end do
      i = n/2
      !$omp simd
      do k = 1, simd_width
         a(k, i) = base(i) - square(k)*rate(i)
         f(k, i) = 1/(12 - a(k, i)*(10 + e(k) + e2(k)))
         q(k, i) = f(k, i)*(y(k) + y2(k) - load(i))
         w(k) = a(k, i)*q(k, i)
         w2(k) = w(k)
      end do
      do i = n/2 - 1, 1, -1
         j = n - i
         !$omp simd
         do k = 1, simd_width
            q(k, i) = f(k, i)*(w(k) + q(k, i))
            w(k) = a(k, i)*q(k, i)
         end do
         !$omp simd
         do k = 1, simd_width
            q(k, j) = f(k, j)*(w2(k) + q(k, j))
            w2(k) = a(k, j)*q(k, j)
         end do
      end do
      q(:, 0) = 0
      q(:, n) = last
   end subroutine solve_modes

   !> The transposed scheme with two loads, -share(k, i) load(i, m): the same elimination, as w = a q scales
   !> the columns of a symmetric matrix.
   pure subroutine solve_adjoints(n, a, f, share, load, adjoint)
      integer, intent(in) :: n
      real(wp), intent(in) :: a(simd_width, 0:n), f(simd_width, 0:n), share(simd_width, 0:n), load(0:n, 2)
      real(wp), intent(out) :: adjoint(simd_width, 0:n, 2)
      real(wp), dimension(simd_width) :: y, y2
      integer :: i, j, k, m
      do m = 1, 2
         y = 0
         y2 = 0
         do i = 1, n/2 - 1
            j = n - i
            !$omp simd
            do k = 1, simd_width
               y(k) = f(k, i)*(a(k, i)*y(k) - share(k, i)*load(i, m))
               adjoint(k, i, m) = y(k)
            end do
            !$omp simd
            do k = 1, simd_width
               y2(k) = f(k, j)*(a(k, j)*y2(k) - share(k, j)*load(j, m))
               adjoint(k, j, m) = y2(k)
            end do
         end do
         i = n/2
         !$omp simd
         do k = 1, simd_width
            y(k) = f(k, i)*(a(k, i)*(y(k) + y2(k)) - share(k, i)*load(i, m))
            adjoint(k, i, m) = y(k)
            y2(k) = y(k)
         end do
         do i = n/2 - 1, 1, -1
            j = n - i
            !$omp simd
            do k = 1, simd_width
               y(k) = adjoint(k, i, m) + a(k, i)*f(k, i)*y(k)
               adjoint(k, i, m) = y(k)
            end do
            !$omp simd
            do k = 1, simd_width
               y2(k) = adjoint(k, j, m) + a(k, j)*f(k, j)*y2(k)
               adjoint(k, j, m) = y2(k)
            end do
         end do
         adjoint(:, 0, m) = 0
         adjoint(:, n, m) = 0
      end do
   end subroutine solve_adjoints

   !> Weights of q in the sums over the nodes, and the narrow-pad part (the modes left out) of these sums and of
   !> the pressure in the middle (times H).
   pure subroutine weigh_nodes(n, weight, root, sine, cosine, narrow, tail, tail_middle, along, outward, sums, p_middle)
      integer, intent(in) :: n
      !> Of the quadrature; inverse root of the mobility; sine, cosine and s/H^2 by node; sums over the modes left out.
      real(wp), intent(in) :: weight(0:n), root(0:n), sine(0:n), cosine(0:n), narrow(0:n), tail, tail_middle
      real(wp), intent(out) :: along(0:n), outward(0:n), sums(2), p_middle(0:n)
      real(wp) :: sum_along, sum_outward
      integer :: i
      sum_along = 0
      sum_outward = 0
      !$omp simd reduction(+:sum_along, sum_outward)
      do i = 0, n
         along(i) = weight(i)*root(i)*sine(i)
         outward(i) = weight(i)*root(i)*cosine(i)
         sum_along = sum_along - tail*along(i)*narrow(i)
         sum_outward = sum_outward - tail*outward(i)*narrow(i)
         p_middle(i) = -tail_middle*narrow(i)
      end do
      sums = [sum_along, sum_outward]
   end subroutine weigh_nodes

   !> Adds a block's sums over nodes and `simd_width` of c q (along, outward), and its part of the pressure in
   !> the middle (times H).
   pure subroutine sum_modes(n, along, outward, c, middle, q, sums, p_middle)
      integer, intent(in) :: n
      !> By node; by slot: c, and b_k.
      real(wp), intent(in) :: along(0:n), outward(0:n), c(simd_width), middle(simd_width), q(simd_width, 0:n)
      real(wp), intent(inout) :: sums(2), p_middle(0:n)
      real(wp) :: sum_along(simd_width), sum_outward(simd_width), at_middle
      integer :: i, k
      sum_along = 0
      sum_outward = 0
      do i = 0, n
         !$omp simd
         do k = 1, simd_width
            sum_along(k) = sum_along(k) + along(i)*q(k, i)
            sum_outward(k) = sum_outward(k) + outward(i)*q(k, i)
         end do
         at_middle = 0
         !$omp simd reduction(+:at_middle)
         do k = 1, simd_width
            at_middle = at_middle + middle(k)*q(k, i)
         end do
         p_middle(i) = p_middle(i) + at_middle
      end do
      sums = sums + [sum(c*sum_along), sum(c*sum_outward)]
   end subroutine sum_modes

   !> Lowest pressure above ambient where cavitation is looked for. It lies where s > 0, or at an edge.
   pure real(wp) function lowest_pressure(n, blocks, narrow, lift, tail, look, q)
      integer, intent(in) :: n, blocks
      !> s/H^2 and q over pressure by node; the modes left out; b_k cos(lambda_k Z) by point and slot.
      real(wp), intent(in) :: narrow(0:n), lift(0:n), tail(looks), look(looks, simd_width, blocks), q(simd_width, 0:n, &
         & blocks)
      real(wp) :: even(looks), odd(looks)
      integer :: i, b, k, l
      lowest_pressure = 0
      do i = 1, n - 1
         if (.not. narrow(i) > 0) cycle
         even = 0
         odd = -tail*narrow(i)
         do b = 1, blocks
            do k = 1, simd_width, 2
               !$omp simd
               do l = 1, looks
                  odd(l) = odd(l) + look(l, k, b)*q(k, i, b)
                  even(l) = even(l) + look(l, k + 1, b)*q(k + 1, i, b)
               end do
            end do
         end do
         lowest_pressure = min(lowest_pressure, minval(odd + even)/lift(i))
      end do
   end function lowest_pressure

   !> Adds a block's sums over its `simd_width` of m(i-1) + 10 m(i) + m(i+1), alone, times q and times Lambda^2 q.
   pure subroutine sum_adjoint(n, adjoint, q, square, over_s, over_v, over_h2)
      integer, intent(in) :: n
      !> Lambda^2 by slot.
      real(wp), intent(in) :: adjoint(simd_width, 0:n), q(simd_width, 0:n), square(simd_width)
      real(wp), intent(inout) :: over_s(0:n), over_v(0:n), over_h2(0:n)
      real(wp) :: stencil, alone, times_q, times_square
      integer :: i, k
      do i = 0, n
         alone = 0
         times_q = 0
         times_square = 0
         !$omp simd reduction(+:alone, times_q, times_square)
         do k = 1, simd_width
            stencil = adjoint(k, max(i - 1, 0)) + 10*adjoint(k, i) + adjoint(k, min(i + 1, n))
            alone = alone + stencil
            times_q = times_q + stencil*q(k, i)
            times_square = times_square + stencil*q(k, i)*square(k)
         end do
         over_s(i) = over_s(i) + alone
         over_v(i) = over_v(i) + times_q
         over_h2(i) = over_h2(i) + times_square
      end do
   end subroutine sum_adjoint
end module fourier_passes
