!> Cubics over a box 0 <= s <= 1 of three variables from values and derivatives at its eight corners: along an axis
!> cubic, between its edges linear ("serendipity"). Complete to the third degree, and continuous from box to box. Four
!> functions at once, as many as a vector holds.
module cubic_patch
   use kinds, only: wp
   use linear_algebra, only: dgesv
   implicit none (type, external)
   private
   public :: simd_width, terms, corner_data, corners, cubic_transform, evaluate_cubic

   !> Functions; terms of a cubic; at each corner a value and three derivatives.
   integer, parameter :: simd_width = 4, terms = 32, corner_data = 4, corners = 8

contains

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
end module cubic_patch
