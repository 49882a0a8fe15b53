!> Polynomials in the cells of film tables, four functions at once, as many as a vector holds.
!>
!> Over a square -1 <= s <= 1: those through values at the extrema of Chebyshev's polynomials. Over a box 0 <= s <= 1 of
!> three variables: cubics from values and derivatives at its eight corners, along an axis cubic, between its edges
!> linear ("serendipity"); complete to the third degree, and continuous from box to box.
module cell_polynomials
   use kinds, only: wp, pi
   use linear_algebra, only: dgesv
   implicit none (type, external)
   private
   public :: simd_width, nodes, node_points, fitted, evaluate_patch, patch_values
   public :: terms, corner_data, corners, cubic_transform, evaluate_cubic
   public :: blend_of, evaluate_blend

   !> Functions; of `evaluate_patch`, nodes along either axis.
   integer, parameter :: simd_width = 4, nodes = 6
   !> Terms of a cubic; at each corner a value and three derivatives.
   integer, parameter :: terms = 32, corner_data = 4, corners = 8
   !> Terms of a cubic of four variables: those of three at both ends of the fourth, and how it bends at both ends.
   integer, parameter :: blend_terms = 2*(terms + corners)

contains

   !> Places of n nodes, with both ends.
   pure function node_points(n) result(points)
      integer, intent(in) :: n
      real(wp) :: points(n)
      integer :: i
      points = [(cos((i - 1)*pi/(n - 1)), i=1, n)]
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

   !> Values of n functions at s in a square, from m nodes along either axis.
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

   !> Values of four functions at s in a square and, if they are wanted, derivatives over s, (function, axis).
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

   !> Terms from the data at the corners: (term, datum), with the data as (value and derivatives over s, corner) and
   !> the corners in Fortran's order of 0 and 1 along the three axes.
   function cubic_transform() result(transform)
      real(wp) :: transform(terms, terms), matrix(terms, terms), unit(simd_width, terms), value(simd_width), &
         & slope(simd_width, 3)
      integer :: corner, term, pivots(terms), info
      transform = 0
      do term = 1, terms
         unit = 0
         unit(1, term) = 1
         do corner = 0, corners - 1
            call evaluate_cubic(unit, real(ibits(corner, [0, 1, 2], 1), wp), .true., value, slope)
            matrix(corner_data*corner + 1:corner_data*(corner + 1), term) = [value(1), slope(1, :)]
         end do
         transform(term, term) = 1
      end do
      call dgesv(terms, terms, matrix, terms, pivots, transform, terms, info)
   end function cubic_transform

   !> Values at s and, if they are wanted, derivatives over s, (function, axis), of functions with these terms: 1, s1,
   !> s1^2, s1^3, each times 1, s2, s3, s2 s3; s2^2, s2^3, each times 1, s1, s3, s1 s3; s3^2, s3^3, each times 1, s1,
   !> s2, s1 s2.
   pure subroutine evaluate_cubic(c, s, want_slopes, value, slope)
      real(wp), intent(in) :: c(simd_width, terms), s(3)
      logical, intent(in) :: want_slopes
      real(wp), intent(out) :: value(simd_width), slope(simd_width, 3)
      integer, parameter :: f = 4
      real(wp) :: line(simd_width, f), rising(simd_width, f), part(simd_width, 0:3)
      associate (x => s(1), y => s(2), z => s(3))
         if (.not. want_slopes) then
            slope = 0
            value = along_two(c(:, 1:4) + x*(c(:, 5:8) + x*(c(:, 9:12) + x*c(:, 13:16))), y, z) &
               & + y**2*along_two(c(:, 17:20) + y*c(:, 21:24), x, z) + z**2*along_two(c(:, 25:28) + z*c(:, 29:32), x, y)
            return
         end if
         line = c(:, 1:4) + x*(c(:, 5:8) + x*(c(:, 9:12) + x*c(:, 13:16)))
         rising = c(:, 5:8) + x*(2*c(:, 9:12) + (3*x)*c(:, 13:16))
         part = bilinear(line, rising, y, z)
         value = part(:, 0)
         slope = part(:, 1:3)
         line = y**2*(c(:, 17:20) + y*c(:, 21:24))
         rising = y*(2*c(:, 17:20) + (3*y)*c(:, 21:24))
         part = bilinear(line, rising, x, z)
         value = value + part(:, 0)
         slope(:, 1) = slope(:, 1) + part(:, 2)
         slope(:, 2) = slope(:, 2) + part(:, 1)
         slope(:, 3) = slope(:, 3) + part(:, 3)
         line = z**2*(c(:, 25:28) + z*c(:, 29:32))
         rising = z*(2*c(:, 25:28) + (3*z)*c(:, 29:32))
         part = bilinear(line, rising, x, y)
         value = value + part(:, 0)
         slope(:, 1) = slope(:, 1) + part(:, 2)
         slope(:, 2) = slope(:, 2) + part(:, 3)
         slope(:, 3) = slope(:, 3) + part(:, 1)
      end associate
   end subroutine evaluate_cubic

   !> Terms of a cubic of four variables from data at its corners: values and derivatives over s, (function, datum,
   !> corner, end of the fourth axis).
   pure function blend_of(transform, data) result(c)
      real(wp), intent(in) :: transform(terms, terms), data(simd_width, 1 + corner_data, 0:corners - 1, 0:1)
      real(wp) :: c(simd_width, blend_terms), bend(simd_width, 0:corners - 1)
      integer :: k, axis, corner
      do k = 0, 1
         c(:, k*terms + 1:(k + 1)*terms) = matmul(reshape(data(:, :corner_data, :, k), [simd_width, terms]), &
            & transpose(transform))
         bend = data(:, 1 + corner_data, :, k) - (data(:, 1, :, 1) - data(:, 1, :, 0))
         ! by powers of three variables, each to the first degree
         do axis = 0, 2
            do corner = 0, corners - 1
               if (btest(corner, axis)) bend(:, corner) = bend(:, corner) - bend(:, ibclr(corner, axis))
            end do
         end do
         c(:, 2*terms + k*corners + 1:2*terms + (k + 1)*corners) = bend
      end do
   end function blend_of

   !> Values at s and, if they are wanted, derivatives over s, (function, axis), of functions of four variables: along
   !> the fourth axis cubic, too, so that the whole is what evaluate_cubic is of three.
   pure subroutine evaluate_blend(c, s, want_slopes, value, slope)
      real(wp), intent(in) :: c(simd_width, blend_terms), s(4)
      logical, intent(in) :: want_slopes
      real(wp), intent(out) :: value(simd_width), slope(simd_width, 4)
      real(wp) :: ends(simd_width, 0:1), rising(simd_width, 3, 0:1), bends(simd_width, 2), weight(2)
      real(wp) :: part(simd_width, 0:3)
      integer :: k
      associate (u => s(4), v => 1 - s(4))
         do k = 0, 1
            call evaluate_cubic(c(:, k*terms + 1:(k + 1)*terms), s(:3), want_slopes, ends(:, k), rising(:, :, k))
         end do
         weight = u*v*[v, -u]
         value = v*ends(:, 0) + u*ends(:, 1)
         slope(:, :3) = v*rising(:, :, 0) + u*rising(:, :, 1)
         do k = 0, 1
            associate (d => c(:, 2*terms + k*corners + 1:2*terms + (k + 1)*corners))
               part = bilinear(d(:, 1:4), d(:, 5:8), s(1), s(2))
               bends(:, k + 1) = part(:, 0) + s(3)*part(:, 1)
               value = value + weight(k + 1)*bends(:, k + 1)
               if (.not. want_slopes) cycle
               slope(:, 1) = slope(:, 1) + weight(k + 1)*(d(:, 2) + s(2)*d(:, 4) + s(3)*(d(:, 6) + s(2)*d(:, 8)))
               slope(:, 2) = slope(:, 2) + weight(k + 1)*(d(:, 3) + s(1)*d(:, 4) + s(3)*(d(:, 7) + s(1)*d(:, 8)))
               slope(:, 3) = slope(:, 3) + weight(k + 1)*part(:, 1)
            end associate
         end do
         slope(:, 4) = ends(:, 1) - ends(:, 0) + v*(v - 2*u)*bends(:, 1) - u*(2*v - u)*bends(:, 2)
      end associate
   end subroutine evaluate_blend

   !> Value of line times (1, a, b, a b).
   pure function along_two(line, a, b) result(value)
      real(wp), intent(in) :: line(simd_width, 4), a, b
      real(wp) :: value(simd_width)
      value = line(:, 1) + a*line(:, 2) + b*(line(:, 3) + a*line(:, 4))
   end function along_two

   !> Value of line times (1, a, b, a b), and derivatives along the line, over a and over b.
   pure function bilinear(line, rising, a, b) result(part)
      real(wp), intent(in) :: line(simd_width, 4), rising(simd_width, 4), a, b
      real(wp) :: part(simd_width, 0:3)
      part(:, 2) = line(:, 2) + b*line(:, 4)
      part(:, 3) = line(:, 3) + a*line(:, 4)
      part(:, 0) = line(:, 1) + a*line(:, 2) + b*part(:, 3)
      part(:, 1) = rising(:, 1) + a*rising(:, 2) + b*(rising(:, 3) + a*rising(:, 4))
   end function bilinear
end module cell_polynomials
