!> Sparse matrices against full ones.
program test_sparse_matrix
   use kinds, only: wp
   use linear_algebra, only: identity
   use sparse_matrix, only: sparse_matrix_type, sparse_of_elements, sparse_of_dense
   use check, only: runs, expect, between, report
   implicit none (type, external)
   integer, parameter :: rows = 9, columns = 7

   if (runs('elements')) call try_elements()
   if (runs('products')) call try_products()
   if (runs('parts')) call try_parts()
   if (runs('bands')) call try_bands()
   call report()

contains

   !> A full matrix of which a third is not 0, and row 4 is 0.
   function example() result(full)
      real(wp) :: full(rows, columns)
      integer :: i, j
      do j = 1, columns
         do i = 1, rows
            full(i, j) = between(-2.0_wp, 1.0_wp)
            if (i == 4 .or. full(i, j) < 0) full(i, j) = 0
         end do
      end do
   end function example

   function full_of(matrix) result(full)
      type(sparse_matrix_type), intent(in) :: matrix
      real(wp), allocatable :: full(:, :)
      full = matrix%times(identity(matrix%columns))
   end function full_of

   !> Two matrices of the same size have the same elements, but for rounding.
   subroutine expect_same(found, expected, what)
      real(wp), intent(in) :: found(:, :), expected(:, :)
      character(len=*), intent(in) :: what
      call expect(all(shape(found) == shape(expected)), what//': size')
      if (any(shape(found) /= shape(expected))) return
      call expect(all(abs(found - expected) <= 1e-14_wp), what)
   end subroutine expect_same

   !> In any order, and elements of one place are summed.
   subroutine try_elements()
      type(sparse_matrix_type) :: matrix
      real(wp) :: full(3, 4)
      full = 0
      full(3, 2) = 5
      full(1, 4) = -1
      matrix = sparse_of_elements(3, 4, [3, 1, 3, 1], [2, 4, 2, 4], [2.0_wp, 1.0_wp, 3.0_wp, -2.0_wp])
      call expect_same(full_of(matrix), full, 'the sum of elements')
      call expect(size(matrix%value) == 2, 'each place once')
      matrix = sparse_of_elements(3, 4, matrix%column(:0), matrix%column(:0), full(1, :0))
      call expect_same(full_of(matrix), 0*full, 'a matrix without elements')
      matrix = sparse_of_dense(full)
      call expect_same(full_of(matrix), full, 'of a full matrix')
      call expect(size(matrix%value) == 2, 'what is 0 is left out')
   end subroutine try_elements

   subroutine try_products()
      type(sparse_matrix_type) :: matrix
      real(wp) :: full(rows, columns), x(columns), y(rows)
      integer :: i
      full = example()
      matrix = sparse_of_dense(full)
      x = [(between(-1.0_wp, 1.0_wp), i=1, columns)]
      y = [(between(-1.0_wp, 1.0_wp), i=1, rows)]
      call expect(all(abs(matrix%times(x) - matmul(full, x)) < 1e-14_wp), 'times a vector')
      call expect(all(abs(matrix%transposed_times(y) - matmul(y, full)) < 1e-14_wp), 'its transpose times a vector')
      call expect_same(matrix%times(reshape([x, -x, 2*x], [columns, 3])), matmul(full, reshape([x, -x, 2*x], &
         & [columns, 3])), 'times vectors')
   end subroutine try_products

   subroutine try_parts()
      type(sparse_matrix_type) :: matrix
      real(wp) :: full(rows, columns)
      full = example()
      matrix = sparse_of_dense(full)
      call expect_same(full_of(matrix%part([6, 4, 1, 6])), full([6, 4, 1, 6], :), 'rows')
      call expect_same(full_of(matrix%part([2, 9], [5, 1, 3])), full([2, 9], [5, 1, 3]), 'rows and columns')
   end subroutine try_parts

   subroutine try_bands()
      type(sparse_matrix_type) :: matrix
      real(wp) :: full(columns, columns), expected(4, columns)
      integer :: i, j
      do j = 1, columns
         do i = 1, columns
            full(i, j) = merge(10.0_wp*i + j, 0.0_wp, i <= j + 1 .and. j <= i + 2)
         end do
      end do
      matrix = sparse_of_dense(full)
      call expect(matrix%half_band_width() == 2, 'half band width')
      matrix = sparse_of_dense(transpose(full))
      call expect(matrix%half_band_width() == 2, 'half band width below the diagonal')
      matrix = sparse_of_dense(full)
      expected = 0
      do j = 1, columns
         do i = max(1, j - 2), min(columns, j + 1)
            expected(3 + i - j, j) = full(i, j)
         end do
      end do
      call expect_same(matrix%band(1, 2), expected, 'all diagonals')
      call expect_same(matrix%band(0, 1), expected(2:3, :), 'some of them')
   end subroutine try_bands
end program test_sparse_matrix
