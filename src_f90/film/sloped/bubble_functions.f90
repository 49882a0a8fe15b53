!> Polynomials on (-1, 1) that are 0 at both ends, integrals of Legendre's: (P_(k+1) - P_(k-1))/(2k+1), whose slopes P_k
!> are orthogonal; and Gauss's points for their products.
module bubble_functions
   use kinds, only: wp, pi
   implicit none (type, external)
   private
   public :: bubble_type, new_bubbles, bubbles_at, pair_of

   type :: bubble_type
      !> Functions, and Gauss's points.
      integer :: n = 0, points = 0
      real(wp), allocatable :: place(:), weight(:)
      !> Values, (function, point) and (point, function), and products of two of them and of two slopes, (pair, point).
      real(wp), allocatable :: value(:, :), by_point(:, :), products(:, :), slope_products(:, :)
   end type bubble_type

contains

   pure type(bubble_type) function new_bubbles(n, points) result(self)
      integer, intent(in) :: n, points
      real(wp) :: slope(n), second(n)
      integer :: q, i, j, pairs
      ! filled up with zeros to whole SIMD vectors
      pairs = 4*((n*(n + 1)/2 + 3)/4)
      self%n = n
      self%points = points
      allocate (self%value(n, points))
      allocate (self%products(pairs, points), self%slope_products(pairs, points), source=0.0_wp)
      call find_points(points, self%place, self%weight)
      do q = 1, points
         call bubbles_at(n, self%place(q), self%value(:, q), slope, second)
         do i = 1, n
            do j = 1, i
               self%products(pair_of(i, j), q) = self%value(i, q)*self%value(j, q)
               self%slope_products(pair_of(i, j), q) = slope(i)*slope(j)
            end do
         end do
      end do
      self%by_point = transpose(self%value)
   end function new_bubbles

   !> The number of a pair of functions.
   elemental integer function pair_of(i, j)
      integer, intent(in) :: i, j
      pair_of = max(i, j)*(max(i, j) - 1)/2 + min(i, j)
   end function pair_of

   !> Values, slopes and second derivatives of the first n functions at a place.
   pure subroutine bubbles_at(n, x, value, slope, second)
      integer, intent(in) :: n
      real(wp), intent(in) :: x
      real(wp), intent(out) :: value(n), slope(n), second(n)
      real(wp) :: before, legendre, next, derivative
      integer :: k
      before = 1
      legendre = x
      derivative = 1
      do k = 1, n
         next = ((2*k + 1)*x*legendre - k*before)/(k + 1)
         value(k) = (next - before)/(2*k + 1)
         slope(k) = legendre
         second(k) = derivative
         ! P_(k+1)' = x P_k' + (k + 1) P_k
         derivative = x*derivative + (k + 1)*legendre
         before = legendre
         legendre = next
      end do
   end subroutine bubbles_at

   !> Gauss's points and weights, by Newton's method.
   pure subroutine find_points(n, place, weight)
      integer, intent(in) :: n
      real(wp), allocatable, intent(out) :: place(:), weight(:)
      real(wp), dimension(n) :: value, slope, second
      integer :: q, round
      allocate (place(n), weight(n))
      do q = 1, n
         place(q) = -cos(pi*(q - 0.25_wp)/(n + 0.5_wp))
         do round = 1, 6
            call bubbles_at(n, place(q), value, slope, second)
            place(q) = place(q) - slope(n)/second(n)
         end do
         call bubbles_at(n, place(q), value, slope, second)
         weight(q) = 2/((1 - place(q)**2)*second(n)**2)
      end do
   end subroutine find_points
end module bubble_functions
