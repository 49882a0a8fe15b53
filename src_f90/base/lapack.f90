!> The routines of LAPACK that are used.
module lapack
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: dgesv, zgesv, dgeev, dstev

   interface
      !> Solves a x = b by elimination with row exchanges; `info` /= 0: a is singular.
      subroutine dgesv(n, nrhs, a, lda, ipiv, b, ldb, info)
         import :: wp
         integer, intent(in) :: n, nrhs, lda, ldb
         real(wp), intent(inout) :: a(lda, *), b(ldb, *)
         integer, intent(out) :: ipiv(*), info
      end subroutine dgesv

      !> The same of complex numbers.
      subroutine zgesv(n, nrhs, a, lda, ipiv, b, ldb, info)
         import :: wp
         integer, intent(in) :: n, nrhs, lda, ldb
         complex(wp), intent(inout) :: a(lda, *), b(ldb, *)
         integer, intent(out) :: ipiv(*), info
      end subroutine zgesv

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
   end interface
end module lapack
