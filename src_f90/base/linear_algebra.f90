!> Linear algebra: LAPACK, eigenvalues and their order, two equations, SIMD padding of rows.
module linear_algebra
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: dgesv, zgesv, zgetrs, dgbsv, zgbsv, dgbtrf, dgbtrs, dstev, dpbtrf, dpbtrs, dsygv, dsbgv, &
      & find_eigenvalues, largest_first, identity, solve, solve_complex, solve_2x2, solve_few, simd_width, padded, apply

   !> Rows are filled up to a multiple of this, so that loops over them have no remainder.
   integer, parameter :: simd_width = 8

   interface
      !> Solves a x = b by elimination with row exchanges; `info` /= 0: a is singular.
      subroutine dgesv(n, nrhs, a, lda, ipiv, b, ldb, info)
         import :: wp
         integer, intent(in) :: n, nrhs, lda, ldb
         real(wp), intent(inout) :: a(lda, *), b(ldb, *)
         integer, intent(out) :: ipiv(*), info
      end subroutine dgesv

      !> The same of a band matrix with kl diagonals below and ku above its own: a(kl + ku + 1 + i - j, j) is its
      !> element (i, j).
      subroutine dgbsv(n, kl, ku, nrhs, a, lda, ipiv, b, ldb, info)
         import :: wp
         integer, intent(in) :: n, kl, ku, nrhs, lda, ldb
         real(wp), intent(inout) :: a(lda, *), b(ldb, *)
         integer, intent(out) :: ipiv(*), info
      end subroutine dgbsv

      !> The same of complex numbers.
      subroutine zgesv(n, nrhs, a, lda, ipiv, b, ldb, info)
         import :: wp
         integer, intent(in) :: n, nrhs, lda, ldb
         complex(wp), intent(inout) :: a(lda, *), b(ldb, *)
         integer, intent(out) :: ipiv(*), info
      end subroutine zgesv

      !> Solves a x = b (trans = 'N') with what zgesv has left of a.
      subroutine zgetrs(trans, n, nrhs, a, lda, ipiv, b, ldb, info)
         import :: wp
         character(len=1), intent(in) :: trans
         integer, intent(in) :: n, nrhs, lda, ldb, ipiv(*)
         complex(wp), intent(in) :: a(lda, *)
         complex(wp), intent(inout) :: b(ldb, *)
         integer, intent(out) :: info
      end subroutine zgetrs

      !> Eigenvalues wr + i wi of a, and (jobvl, jobvr 'V'; else 'N') left and right eigenvectors; `info` /= 0: it does
      !> not converge.
      subroutine dgeev(jobvl, jobvr, n, a, lda, wr, wi, vl, ldvl, vr, ldvr, work, lwork, info)
         import :: wp
         character(len=1), intent(in) :: jobvl, jobvr
         integer, intent(in) :: n, lda, ldvl, ldvr, lwork
         real(wp), intent(inout) :: a(lda, *)
         real(wp), intent(out) :: wr(*), wi(*), vl(ldvl, *), vr(ldvr, *), work(*)
         integer, intent(out) :: info
      end subroutine dgeev

      !> Eigenvalues d and eigenvectors z of a symmetric tridiagonal matrix with the diagonal d and, beside it, e.
      subroutine dstev(jobz, n, d, e, z, ldz, work, info)
         import :: wp
         character(len=1), intent(in) :: jobz
         integer, intent(in) :: n, ldz
         real(wp), intent(inout) :: d(*), e(*)
         real(wp), intent(out) :: z(ldz, *), work(*)
         integer, intent(out) :: info
      end subroutine dstev

      !> The factors of such a band matrix of m rows and n columns, in its place; `info` > 0: this pivot is 0.
      subroutine dgbtrf(m, n, kl, ku, a, lda, ipiv, info)
         import :: wp
         integer, intent(in) :: m, n, kl, ku, lda
         real(wp), intent(inout) :: a(lda, *)
         integer, intent(out) :: ipiv(*), info
      end subroutine dgbtrf

      !> Solves a x = b (trans 'N') with these factors of a.
      subroutine dgbtrs(trans, n, kl, ku, nrhs, a, lda, ipiv, b, ldb, info)
         import :: wp
         character(len=1), intent(in) :: trans
         integer, intent(in) :: n, kl, ku, nrhs, lda, ipiv(*), ldb
         real(wp), intent(in) :: a(lda, *)
         real(wp), intent(inout) :: b(ldb, *)
         integer, intent(out) :: info
      end subroutine dgbtrs

      !> dgbsv of complex numbers.
      subroutine zgbsv(n, kl, ku, nrhs, a, lda, ipiv, b, ldb, info)
         import :: wp
         integer, intent(in) :: n, kl, ku, nrhs, lda, ldb
         complex(wp), intent(inout) :: a(lda, *), b(ldb, *)
         integer, intent(out) :: ipiv(*), info
      end subroutine zgbsv

      !> Cholesky's factor, upper (uplo 'U'), of a symmetric band matrix with kd diagonals above its own:
      !> a(kd + 1 + i - j, j) is its element (i, j); `info` /= 0: it is not positive definite.
      subroutine dpbtrf(uplo, n, kd, a, lda, info)
         import :: wp
         character(len=1), intent(in) :: uplo
         integer, intent(in) :: n, kd, lda
         real(wp), intent(inout) :: a(lda, *)
         integer, intent(out) :: info
      end subroutine dpbtrf

      !> Solves a x = b with this factor of a.
      subroutine dpbtrs(uplo, n, kd, nrhs, a, lda, b, ldb, info)
         import :: wp
         character(len=1), intent(in) :: uplo
         integer, intent(in) :: n, kd, nrhs, lda, ldb
         real(wp), intent(in) :: a(lda, *)
         real(wp), intent(inout) :: b(ldb, *)
         integer, intent(out) :: info
      end subroutine dpbtrs

      !> Eigenvalues w (jobz 'N'), the smallest first, of a x = w b x, both symmetric band matrices as above (uplo 'U'),
      !> ka >= kb, b positive definite; `info` /= 0: b is not, or it does not converge.
      subroutine dsbgv(jobz, uplo, n, ka, kb, a, lda, b, ldb, w, z, ldz, work, info)
         import :: wp
         character(len=1), intent(in) :: jobz, uplo
         integer, intent(in) :: n, ka, kb, lda, ldb, ldz
         real(wp), intent(inout) :: a(lda, *), b(ldb, *)
         real(wp), intent(out) :: w(*), z(ldz, *), work(*)
         integer, intent(out) :: info
      end subroutine dsbgv

      !> Eigenvalues w, the smallest first, and eigenvectors (in a, x^T b x = 1) of a x = w b x (itype 1), a symmetric,
      !> b positive definite; `info` /= 0: b is not, or it does not converge.
      subroutine dsygv(itype, jobz, uplo, n, a, lda, b, ldb, w, work, lwork, info)
         import :: wp
         integer, intent(in) :: itype, n, lda, ldb, lwork
         character(len=1), intent(in) :: jobz, uplo
         real(wp), intent(inout) :: a(lda, *), b(ldb, *)
         real(wp), intent(out) :: w(*), work(*)
         integer, intent(out) :: info
      end subroutine dsygv
   end interface

contains

   !> `ok` is false where LAPACK's iteration does not converge, or a number is none. Of a pair the value with positive
   !> imaginary part comes first.
   subroutine find_eigenvalues(matrix, values, ok, vectors)
      real(wp), intent(in) :: matrix(:, :)
      complex(wp), intent(out) :: values(:)
      logical, intent(out) :: ok
      !> (row, eigenvalue), of any size and phase.
      complex(wp), intent(out), optional :: vectors(:, :)
      real(wp), dimension(size(values)) :: re, im
      real(wp) :: changed(size(values), size(values)), work(8*size(values)), left(1, 1)
      real(wp), allocatable :: right(:, :)
      integer :: info, rows
      ok = all(ieee_is_finite(matrix))
      if (.not. ok) return
      associate (n => size(values))
         rows = merge(n, 1, present(vectors))
         allocate (right(rows, rows))
         changed = matrix
         call dgeev('N', merge('V', 'N', present(vectors)), n, changed, n, re, im, left, 1, right, rows, work, &
            & size(work), info)
      end associate
      ok = info == 0
      if (ok) ok = all(ieee_is_finite(re)) .and. all(ieee_is_finite(im))
      values = cmplx(re, im, wp)
      if (present(vectors) .and. ok) vectors = to_complex(right, im)
   end subroutine find_eigenvalues

   !> Vectors as LAPACK gives them: of a pair the real and the imaginary part of that whose eigenvalue comes first.
   pure function to_complex(parts, im) result(vectors)
      real(wp), intent(in) :: parts(:, :), im(:)
      complex(wp) :: vectors(size(parts, 1), size(parts, 2))
      integer :: i
      do i = 1, size(im)
         if (im(i) > 0) then
            vectors(:, i) = cmplx(parts(:, i), parts(:, i + 1), wp)
         else if (im(i) < 0) then
            vectors(:, i) = cmplx(parts(:, i - 1), -parts(:, i), wp)
         else
            vectors(:, i) = cmplx(parts(:, i), 0.0_wp, wp)
         end if
      end do
   end function to_complex

   !> The places of numbers in their order, the largest first; of equal ones the first comes first.
   pure function largest_first(numbers) result(places)
      real(wp), intent(in) :: numbers(:)
      integer :: places(size(numbers)), i
      logical :: waiting(size(numbers))
      waiting = .true.
      do i = 1, size(numbers)
         places(i) = maxloc(numbers, dim=1, mask=waiting)
         waiting(places(i)) = .false.
      end do
   end function largest_first

   !> The identity matrix of n rows.
   pure function identity(n)
      integer, intent(in) :: n
      real(wp) :: identity(n, n)
      integer :: i
      identity = 0
      do i = 1, n
         identity(i, i) = 1
      end do
   end function identity

   !> x of n equations a x = b with a number of right sides b, which become the solutions. `ok` is false where a is
   !> singular; then b is lost.
   subroutine solve(n, sides, a, b, ok)
      integer, intent(in) :: n, sides
      real(wp), intent(in) :: a(n, n)
      real(wp), intent(inout) :: b(n, *)
      logical, intent(out) :: ok
      real(wp) :: factors(n, n)
      integer :: pivots(n), info
      factors = a
      info = 0
      if (n > 0) call dgesv(n, sides, factors, n, pivots, b, n, info)
      ok = info == 0
   end subroutine solve

   !> The same of complex numbers.
   subroutine solve_complex(n, sides, a, b, ok)
      integer, intent(in) :: n, sides
      complex(wp), intent(in) :: a(n, n)
      complex(wp), intent(inout) :: b(n, *)
      logical, intent(out) :: ok
      complex(wp), allocatable :: factors(:, :)
      integer :: pivots(n), info
      factors = a
      info = 0
      if (n > 0) call zgesv(n, sides, factors, n, pivots, b, n, info)
      ok = info == 0
   end subroutine solve_complex

   !> x of the equations a x = b; 0 where they are singular.
   pure function solve_2x2(a, b) result(x)
      real(wp), intent(in) :: a(2, 2), b(2)
      real(wp) :: x(2), determinant
      x = 0
      determinant = a(1, 1)*a(2, 2) - a(1, 2)*a(2, 1)
      if (abs(determinant) > 0) x = [a(2, 2)*b(1) - a(1, 2)*b(2), a(1, 1)*b(2) - a(2, 1)*b(1)]/determinant
   end function solve_2x2

   !> x of a x = b with few unknowns; 0 where a is singular.
   function solve_few(a, b) result(x)
      real(wp), intent(in) :: a(:, :), b(:)
      real(wp) :: x(size(b))
      logical :: ok
      select case (size(b))
      case (1)
         x = 0
         if (abs(a(1, 1)) > 0) x = b/a(1, 1)
      case (2)
         x = solve_2x2(a, b)
      case default
         x = b
         call solve(size(b), 1, a, x, ok)
         if (.not. ok) x = 0
      end select
   end function solve_few

   !> This many numbers, filled up to whole SIMD vectors.
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
end module linear_algebra
