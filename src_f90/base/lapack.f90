!> The routines of LAPACK that are used.
module lapack
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: dgesv

   interface
      !> Solves a x = b by elimination with row exchanges; `info` /= 0: a is singular.
      subroutine dgesv(n, nrhs, a, lda, ipiv, b, ldb, info)
         import :: wp
         integer, intent(in) :: n, nrhs, lda, ldb
         real(wp), intent(inout) :: a(lda, *), b(ldb, *)
         integer, intent(out) :: ipiv(*), info
      end subroutine dgesv
   end interface
end module lapack
