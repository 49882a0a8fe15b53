!> The arrow solver against LAPACK on full matrices.
program test_arrow_system
   use kinds, only: wp
   use text, only: to_text
   use arrow_system, only: arrow_matrix, new_arrow_matrix, journal_states
   use check, only: runs, expect, expect_close, report
   implicit none (type, external)

   interface
      !> LAPACK: solves a x = b.
      subroutine dgesv(n, nrhs, a, lda, ipiv, b, ldb, info)
         import :: wp
         integer, intent(in) :: n, nrhs, lda, ldb
         real(wp), intent(inout) :: a(lda, *), b(ldb, *)
         integer, intent(out) :: ipiv(*), info
      end subroutine dgesv
   end interface

   integer, parameter :: pads(*) = [1, 2, 4, 24]
   integer :: i, m

   do m = 2, 5
      do i = 1, size(pads)
         if (runs('against_lapack')) call against_lapack(m, pads(i))
      end do
   end do
   if (runs('singular')) call singular()
   call report()

contains

   !> Entries of order 1 and gamma = 0.2/sqrt(n): no pivoting is needed, and rounding is amplified little.
   subroutine against_lapack(m, pads)
      integer, intent(in) :: m, pads
      type(arrow_matrix) :: matrix
      real(wp), allocatable :: full(:, :), b(:, :), x(:)
      integer, allocatable :: pivots(:)
      real(wp) :: gamma
      integer :: n, k, info
      logical :: ok
      n = journal_states + m*pads
      matrix = new_arrow_matrix(m, pads)
      call random_number(matrix%corner)
      call random_number(matrix%across)
      call random_number(matrix%down)
      call random_number(matrix%block)
      allocate (b(n, 1), pivots(n))
      call random_number(b)
      gamma = 0.2_wp/sqrt(real(n, wp))
      x = b(:, 1)
      call matrix%solve(gamma, x, ok)
      full = -gamma*matrix%dense()
      do k = 1, n
         full(k, k) = full(k, k) + 1
      end do
      call dgesv(n, 1, full, n, pivots, b, n, info)
      call expect(ok .and. info == 0, 'both solve '//to_text(m)//' x '//to_text(pads))
      call expect_close(norm2(x - b(:, 1)), 0.0_wp, 1e-12_wp*norm2(x), to_text(pads)//' pads of '//to_text(m))
   end subroutine against_lapack

   subroutine singular()
      type(arrow_matrix) :: matrix
      real(wp) :: b(journal_states + 2)
      logical :: ok
      matrix = new_arrow_matrix(2, 1)
      matrix%block(1, 1, 1) = 2
      b = 1
      call matrix%solve(0.5_wp, b, ok)
      call expect(.not. ok, 'a singular system is refused')
   end subroutine singular
end program test_arrow_system
