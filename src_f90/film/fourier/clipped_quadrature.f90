!> Integrals of a smooth function over a line, and over the part of it where it is positive, from its values at
!> equally spaced nodes: there by the cubic through four nodes, cell by cell, up to where it crosses zero. The
!> weights move with the crossing without a jump, and the integral does so without a switching point.
module clipped_quadrature
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: gregory_weights, clipped_weights

   !> Weights of a whole cell away from the ends: primitives(1) - primitives(0).
   real(wp), parameter :: whole_cell(4) = [-1.0_wp, 13.0_wp, 13.0_wp, -1.0_wp]/24

contains

   !> Weights of the whole line by node, in steps, nodes 0:n, n >= 6: the trapezoidal rule with Gregory's end
   !> corrections to the sixth difference, exact for polynomials of degree 6.
   pure function gregory_weights(n) result(weights)
      integer, intent(in) :: n
      real(wp) :: weights(0:n)
      real(wp), parameter :: ends(0:6) = [36799, 176648, 54851, 177984, 89437, 130936, 119585]/120960.0_wp
      weights = 1
      weights(:6) = weights(:6) + ends - 1
      weights(n - 6:) = weights(n - 6:) + ends(6:0:-1) - 1
   end function gregory_weights

   !> Weights by node, in steps, for a function f given at nodes 0:n, n >= 3: the integral over f > 0 of f times
   !> a smooth factor is the sum of weights, f and the factor at the nodes. Fourth order in whole cells, and
   !> in those that f crosses.
   pure subroutine clipped_weights(n, f, weights)
      integer, intent(in) :: n
      real(wp), intent(in) :: f(0:n)
      real(wp), intent(out) :: weights(0:n)
      real(wp) :: from, to, start
      integer :: i, first
      weights = 0
      do i = 0, n - 1
         if (.not. (f(i) > 0 .or. f(i + 1) > 0)) cycle
         first = min(max(i - 1, 0), n - 3)
         if (f(i) > 0 .and. f(i + 1) > 0 .and. first == i - 1) then
            weights(first:first + 3) = weights(first:first + 3) + whole_cell
            cycle
         end if
         start = i - first - 1
         from = start
         to = start + 1
         if (.not. f(i) > 0) from = crossing(f(first:first + 3), start, start + f(i)/(f(i) - f(i + 1)))
         if (.not. f(i + 1) > 0) to = crossing(f(first:first + 3), start, start + f(i)/(f(i) - f(i + 1)))
         weights(first:first + 3) = weights(first:first + 3) + primitives(to) - primitives(from)
      end do
   end subroutine clipped_weights

   !> Zero of the cubic through f at -1, 0, 1, 2 in the cell from start to start + 1, from a first guess there;
   !> two of Newton's iterations.
   pure real(wp) function crossing(f, start, guess)
      real(wp), intent(in) :: f(4), start, guess
      real(wp) :: c(0:3), value, slope
      integer :: k
      c = [f(2), f(3) - f(1)/3 - f(2)/2 - f(4)/6, (f(1) + f(3))/2 - f(2), (f(4) - f(1))/6 + (f(2) - f(3))/2]
      crossing = guess
      do k = 1, 2
         value = c(0) + crossing*(c(1) + crossing*(c(2) + crossing*c(3)))
         slope = c(1) + crossing*(2*c(2) + crossing*3*c(3))
         if (abs(slope) > abs(value)) crossing = min(max(crossing - value/slope, start), start + 1)
      end do
   end function crossing

   !> Integrals from 0 to s of the four cubics that are 1 at -1, 0, 1 or 2 and 0 at the others.
   pure function primitives(s)
      real(wp), intent(in) :: s
      real(wp) :: primitives(4)
      primitives(1) = -s**2*(s**2/4 - s + 1)/6
      primitives(2) = s*(s**3/4 - 2*s**2/3 - s/2 + 2)/2
      primitives(3) = -s**2*(s**2/4 - s/3 - 1)/2
      primitives(4) = s**2*(s**2/4 - 0.5_wp)/6
   end function primitives
end module clipped_quadrature
