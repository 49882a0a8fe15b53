!> Nodes along the arc at equal steps of Sommerfeld's variable xi = integral of dphi/H, H = h/c_m: close where the
!> film is thin, so that few serve a film of any film thickness ratio.
!>
!> H = 1 - e_1 sin(phi) - e_2 cos(phi), e in clearances. Along xi the vector n = (1, cos(phi), sin(phi))/H obeys
!> dn/dxi = A n with a constant matrix A, A^3 = k A, k = e_1^2 + e_2^2 - 1. Hence n(xi) = n(0) + S A n(0) + C A^2 n(0),
!> with S = sinh(sqrt(k) xi)/sqrt(k), C = (cosh(sqrt(k) xi) - 1)/k; for k < 0 these are sine and cosine.
module sommerfeld_nodes
   use kinds, only: wp
   use pad_gap, only: pad_directions
   implicit none (type, external)
   private
   public :: span, place_nodes, node_shifts

   !> Nothing depends on k where |k| is smaller than its square.
   real(wp), parameter :: least_root = 1e-8_wp

contains

   !> xi over an arc, along which the film is open: from the directions (sine, cosine) of its middle and of half of it.
   pure real(wp) function span(e, middle, half)
      real(wp), intent(in) :: e(2), middle(2), half(2)
      real(wp) :: k, root, sine, cosine
      k = dot_product(e, e) - 1
      root = max(least_root, sqrt(abs(k)))
      ! both over the root of the product of H at the ends
      sine = root*half(1)
      cosine = half(2) - dot_product(e, middle)
      if (k < 0) then
         span = 2*atan2(sine, cosine)/root
      else
         span = 2*atanh(sine/cosine)/root
      end if
   end function span

   !> S and C at n steps of length d from 0: series for one step, from there sums of angles.
   pure subroutine generators(n, d, k, s, c)
      integer, intent(in) :: n
      real(wp), intent(in) :: d, k
      real(wp), dimension(0:n), intent(out) :: s, c
      real(wp) :: z
      integer :: i, m
      z = k*d**2
      s(0) = 0
      c(0) = 0
      s(1) = d + k*first_integral(d, k)
      c(1) = d**2/2*(1 + z/12*(1 + z/30*(1 + z/56*(1 + z/90*(1 + z/132*(1 + z/182*(1 + z/240*(1 + z/306))))))))
      m = 1
      do while (m < n)
         !$omp simd
         do i = 1, min(m, n - m)
            s(m + i) = s(m) + s(i) + k*(s(m)*c(i) + c(m)*s(i))
            c(m + i) = c(m) + c(i) + k*c(m)*c(i) + s(m)*s(i)
         end do
         m = 2*m
      end do
   end subroutine generators

   !> The integral of C over the first step, (S - d)/k.
   pure real(wp) function first_integral(d, k)
      real(wp), intent(in) :: d, k
      real(wp) :: z
      z = k*d**2
      first_integral = d**3/6*(1 + z/20*(1 + z/42*(1 + z/72*(1 + z/110*(1 + z/156*(1 + z/210*(1 + z/272)))))))
   end function first_integral

   !> The integral of C, (S - xi)/k, at the same places, by sums likewise.
   pure subroutine integrate_c(n, d, k, s, c, c_integral)
      integer, intent(in) :: n
      real(wp), intent(in) :: d, k, s(0:n), c(0:n)
      real(wp), intent(out) :: c_integral(0:n)
      integer :: i, m
      c_integral(0) = 0
      c_integral(1) = first_integral(d, k)
      m = 1
      do while (m < n)
         !$omp simd
         do i = 1, min(m, n - m)
            c_integral(m + i) = c_integral(m) + c_integral(i) + s(m)*c(i) + c(m)*s(i)
         end do
         m = 2*m
      end do
   end subroutine integrate_c

   !> The edge where the film is thicker, from where sums do not cancel: n, A n and A^2 n there, (1, cosine, sine;
   !> power), with -A for A at the leading edge, seen from which xi runs backwards. `first` is its node, 0 or n.
   pure subroutine start(n, e, directions, vectors, first)
      integer, intent(in) :: n
      real(wp), intent(in) :: e(2)
      type(pad_directions), intent(in) :: directions
      real(wp), intent(out) :: vectors(3, 3)
      integer, intent(out) :: first
      real(wp) :: edge(2)
      integer :: i
      first = merge(0, n, dot_product(e, directions%trailing) < dot_product(e, directions%leading))
      edge = merge(directions%trailing, directions%leading, first == 0)
      vectors(:, 1) = [1.0_wp, edge(2), edge(1)]/(1 - dot_product(e, edge))
      do i = 1, 2
         associate (v => vectors(:, i))
            vectors(:, i + 1) = [e(1)*v(2) - e(2)*v(3), e(1)*v(1) - v(3), v(2) - e(2)*v(1)]
         end associate
      end do
      if (first == n) vectors(:, 2) = -vectors(:, 2)
   end subroutine start

   !> H, sine and cosine of phi at nodes 0:n, steps d of xi, from the trailing to the leading edge.
   pure subroutine place_nodes(n, d, e, directions, h, sine, cosine)
      integer, intent(in) :: n
      real(wp), intent(in) :: d, e(2)
      type(pad_directions), intent(in) :: directions
      real(wp), dimension(0:n), intent(out) :: h, sine, cosine
      real(wp), dimension(0:n) :: s, c
      real(wp) :: v(3, 3)
      integer :: i, first
      call generators(n, d, dot_product(e, e) - 1, s, c)
      call start(n, e, directions, v, first)
      !$omp simd
      do i = 0, n
         h(i) = 1/(v(1, 1) + s(i)*v(1, 2) + c(i)*v(1, 3))
         cosine(i) = h(i)*(v(2, 1) + s(i)*v(2, 2) + c(i)*v(2, 3))
         sine(i) = h(i)*(v(3, 1) + s(i)*v(3, 2) + c(i)*v(3, 3))
      end do
      if (first == 0) return
      h = h(n:0:-1)
      cosine = cosine(n:0:-1)
      sine = sine(n:0:-1)
   end subroutine place_nodes

   !> How the nodes move with e: d phi/d e, (node, component), and the relative change of the step, 1/d d d/d e.
   pure subroutine node_shifts(n, d, e, directions, h, shift, stretch)
      integer, intent(in) :: n
      real(wp), intent(in) :: d, e(2), h(0:n)
      type(pad_directions), intent(in) :: directions
      real(wp), intent(out) :: shift(0:n, 2), stretch(2)
      real(wp), dimension(0:n) :: s, c, c_integral
      real(wp) :: v(3, 3), moved(0:n)
      integer :: i, j, first
      call generators(n, d, dot_product(e, e) - 1, s, c)
      call integrate_c(n, d, dot_product(e, e) - 1, s, c, c_integral)
      call start(n, e, directions, v, first)
      do j = 1, 2
         ! by the integrals of sin(phi)/H and cos(phi)/H over xi
         associate (n_0 => v(4 - j, 1), n_1 => v(4 - j, 2), n_2 => v(4 - j, 3))
            stretch(j) = n_0 + (c(n)*n_1 + c_integral(n)*n_2)/(n*d)
            !$omp simd
            do i = 0, n
               moved(i) = i*d*(stretch(j) - n_0) - c(i)*n_1 - c_integral(i)*n_2
            end do
         end associate
         if (first == 0) shift(:, j) = h*moved
         if (first == n) shift(:, j) = -h*moved(n:0:-1)
      end do
   end subroutine node_shifts
end module sommerfeld_nodes
