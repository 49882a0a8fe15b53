!> The bordered solver against LAPACK on full matrices, with borders and blocks of several sizes; eigenvalues, their
!> vectors and their order.
program test_linear_algebra
   use kinds, only: wp
   use text, only: to_text
   use linear_algebra, only: dgesv, find_eigenvalues, largest_first
   use bordered_system, only: bordered_matrix, new_bordered_matrix
   use check, only: runs, expect, expect_close, report
   implicit none (type, external)

   !> A rigid journal's border is of 2 unknowns; the others have rows that fill their vectors, just not, and by far.
   integer, parameter :: blocks(*) = [1, 2, 4, 24]
   integer :: i, k, m

   do i = 1, size(blocks)
      do m = 0, 4
         if (runs('against_lapack')) call against_lapack([1], [m], [blocks(i)])
         if (runs('against_lapack')) call against_lapack([1, 2], [m, 2], [blocks(i), 4])
         if (runs('against_lapack')) call against_lapack([1, 2, 3, 4], [1, m, 0, 2], [5, blocks(i), 2, 3])
         ! groups that know the same pair, and a pair that none knows
         if (runs('shared_pairs')) call against_lapack([1, 1], [m, 1], [blocks(i), 2])
         if (runs('shared_pairs')) call against_lapack([3, 1, 3, 1], [2, m, 0, m], [5, blocks(i), 1, 3])
      end do
   end do
   do k = 1, 4
      if (runs('singular')) call singular(k)
   end do
   if (runs('vectors')) call vectors()
   if (runs('pair')) call pair()
   if (runs('order')) call order()
   call report()

contains

   !> Entries of order 1 and gamma = 0.2/sqrt(n): no pivoting is needed, and rounding is amplified little.
   subroutine against_lapack(known, m, blocks)
      !> Of each group: the pair that it knows, unknowns of a block, blocks.
      integer, intent(in) :: known(:), m(:), blocks(:)
      type(bordered_matrix) :: matrix
      real(wp), allocatable :: full(:, :), b(:, :), x(:)
      integer, allocatable :: pivots(:)
      character(len=:), allocatable :: what
      real(wp) :: gamma
      integer :: n, border, k, g, info
      logical :: ok
      what = to_text(size(m))//' groups, the first of '//to_text(blocks(1))//' blocks of '//to_text(m(1))
      border = 2*maxval(known)
      n = border + sum(m*blocks)
      matrix = new_bordered_matrix(maxval(known), known, m, blocks, 0*known)
      call random_number(matrix%corner)
      do g = 1, size(m)
         call random_number(matrix%groups(g)%across)
         call random_number(matrix%groups(g)%down)
         call random_number(matrix%groups(g)%block)
      end do
      if (border > 2) then
         call random_number(matrix%border)
         do k = 1, border
            matrix%border(k, k) = matrix%border(k, k) + border
         end do
      end if
      allocate (b(n, 1), pivots(n))
      call random_number(b)
      gamma = 0.2_wp/sqrt(real(n, wp))
      x = b(:, 1)
      call matrix%solve(gamma, x, ok)
      full = -gamma*dense(matrix)
      full(:border, :border) = full(:border, :border) + matrix%border
      do k = border + 1, n
         full(k, k) = full(k, k) + 1
      end do
      call dgesv(n, 1, full, n, pivots, b, n, info)
      call expect(ok .and. info == 0, 'both solve '//what)
      call expect_close(norm2(x - b(:, 1)), 0.0_wp, 1e-12_wp*norm2(x), what)
   end subroutine against_lapack

   !> A block and then the border of which nothing is left.
   subroutine singular(groups)
      integer, intent(in) :: groups
      type(bordered_matrix) :: matrix
      real(wp) :: b(4*groups)
      integer :: g
      logical :: ok
      matrix = new_bordered_matrix(groups, [(g, g=1, groups)], spread(2, 1, groups), spread(1, 1, groups), &
         & spread(0, 1, groups))
      matrix%groups(groups)%block(1, 1, 1) = 2
      b = 1
      call matrix%solve(0.5_wp, b, ok)
      call expect(.not. ok, 'a singular block is refused')
      matrix%groups(groups)%block = 0
      matrix%corner(2, 2, groups) = 2
      b = 1
      call matrix%solve(0.5_wp, b, ok)
      call expect(.not. ok, 'a singular border is refused')
   end subroutine singular

   !> The whole matrix A.
   pure function dense(self) result(matrix)
      type(bordered_matrix), intent(in) :: self
      real(wp), allocatable :: matrix(:, :)
      integer :: i, g, m, o, at(2)
      o = size(self%border, 1)
      associate (n => o + sum([(self%groups(g)%m*size(self%groups(g)%block, 3), g=1, size(self%groups))]))
         allocate (matrix(n, n), source=0.0_wp)
      end associate
      do g = 1, size(self%corner, 3)
         at = [2*g - 1, 2*g]
         matrix(at, at) = self%corner(:, :, g)
      end do
      do g = 1, size(self%groups)
         at = [2*self%groups(g)%pair - 1, 2*self%groups(g)%pair]
         associate (group => self%groups(g))
            m = group%m
            do i = 1, size(group%block, 3)
               matrix(at, o + 1:o + m) = group%across(:, :, i)
               matrix(o + 1:o + m, at) = group%down(:, :, i)
               matrix(o + 1:o + m, o + 1:o + m) = group%block(:, :, i)
               o = o + m
            end do
         end associate
      end do
   end function dense

   !> A v = lambda v, of a matrix with real and complex eigenvalues; the matrix stays as it is.
   subroutine vectors()
      integer, parameter :: n = 7
      real(wp) :: matrix(n, n), before(n, n)
      complex(wp) :: values(n), alone(n), shapes(n, n)
      integer :: i
      logical :: ok
      call random_number(matrix)
      matrix = matrix - 0.5_wp
      before = matrix
      call find_eigenvalues(matrix, values, ok, shapes)
      call expect(ok .and. all(abs(matrix - before) <= 0), 'they are found')
      call expect(any(abs(values%im) > 0), 'some are complex')
      do i = 1, n
         call expect_close(maxval(abs(matmul(matrix, shapes(:, i)) - values(i)*shapes(:, i))), 0.0_wp, 1e-13_wp, &
            & 'an eigenvector')
         call expect(maxval(abs(shapes(:, i))) > 0.1_wp, 'which is not zero')
      end do
      call find_eigenvalues(matrix, alone, ok)
      call expect(ok .and. all(abs(alone - values) < 1e-13_wp), 'the same without vectors')
   end subroutine vectors

   !> Of a pair that with the positive imaginary part comes first.
   subroutine pair()
      complex(wp) :: values(2)
      logical :: ok
      call find_eigenvalues(reshape([0.0_wp, 1.0_wp, -4.0_wp, 0.0_wp], [2, 2]), values, ok)
      call expect(ok .and. all(abs(values - [(0.0_wp, 2.0_wp), (0.0_wp, -2.0_wp)]) < 1e-14_wp), 'plus and minus 2i')
   end subroutine pair

   !> Equal numbers keep their order.
   subroutine order()
      call expect(all(largest_first([1.0_wp, 3.0_wp, -2.0_wp, 3.0_wp, 0.0_wp]) == [2, 4, 1, 5, 3]), 'largest first')
      call expect(size(largest_first([real(wp) ::])) == 0, 'nothing has no order')
   end subroutine order
end program test_linear_algebra
