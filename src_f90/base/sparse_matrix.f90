!> Matrices of which most elements are 0.
module sparse_matrix
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: sparse_matrix_type, sparse_of_elements, sparse_of_dense

   !> The elements of row i have the numbers first(i) to first(i + 1) - 1, each in its column; columns of a row are in
   !> any order, each once.
   type :: sparse_matrix_type
      integer :: rows = 0, columns = 0
      integer, allocatable :: first(:), column(:)
      real(wp), allocatable :: value(:)
   contains
      generic :: times => times_vector, times_block
      procedure, private :: times_vector
      procedure, private :: times_block
      procedure :: transposed_times
      procedure :: part
      procedure :: half_band_width
      procedure :: band
   end type sparse_matrix_type

contains

   !> The matrix of these elements, in any order; those in the same place are summed.
   pure function sparse_of_elements(rows, columns, row, column, value) result(matrix)
      integer, intent(in) :: rows, columns, row(:), column(:)
      real(wp), intent(in) :: value(:)
      type(sparse_matrix_type) :: matrix
      integer :: order(size(row)), next(rows), place(columns), i, k, n
      next = 0
      do k = 1, size(row)
         next(row(k)) = next(row(k)) + 1
      end do
      ! where each row begins, and after the elements are put in order, where the next one does
      n = 1
      do i = 1, rows
         k = next(i)
         next(i) = n
         n = n + k
      end do
      do k = 1, size(row)
         order(next(row(k))) = k
         next(row(k)) = next(row(k)) + 1
      end do
      matrix = empty(rows, columns, size(row))
      place = 0
      n = 0
      k = 1
      do i = 1, rows
         matrix%first(i) = n + 1
         do k = k, next(i) - 1
            associate (j => column(order(k)))
               if (place(j) < matrix%first(i)) then
                  n = n + 1
                  place(j) = n
                  matrix%column(n) = j
                  matrix%value(n) = 0
               end if
               matrix%value(place(j)) = matrix%value(place(j)) + value(order(k))
            end associate
         end do
      end do
      call finish(matrix, n)
   end function sparse_of_elements

   !> The elements of a matrix that are not 0.
   pure function sparse_of_dense(dense) result(matrix)
      real(wp), intent(in) :: dense(:, :)
      type(sparse_matrix_type) :: matrix
      integer :: i, j, n
      matrix = empty(size(dense, 1), size(dense, 2), count(abs(dense) > 0))
      n = 0
      do i = 1, matrix%rows
         matrix%first(i) = n + 1
         do j = 1, matrix%columns
            if (.not. abs(dense(i, j)) > 0) cycle
            n = n + 1
            matrix%column(n) = j
            matrix%value(n) = dense(i, j)
         end do
      end do
      call finish(matrix, n)
   end function sparse_of_dense

   !> Room for a number of elements.
   pure function empty(rows, columns, elements) result(matrix)
      integer, intent(in) :: rows, columns, elements
      type(sparse_matrix_type) :: matrix
      matrix%rows = rows
      matrix%columns = columns
      allocate (matrix%first(rows + 1), matrix%column(elements), matrix%value(elements))
   end function empty

   !> Ends a matrix whose rows have n elements, with room for more.
   pure subroutine finish(matrix, n)
      type(sparse_matrix_type), intent(inout) :: matrix
      integer, intent(in) :: n
      matrix%first(matrix%rows + 1) = n + 1
      matrix%column = matrix%column(:n)
      matrix%value = matrix%value(:n)
   end subroutine finish

   !> The product with a vector.
   pure function times_vector(self, x) result(product)
      class(sparse_matrix_type), intent(in) :: self
      real(wp), intent(in) :: x(:)
      real(wp) :: product(self%rows), total
      integer :: i, k
      do i = 1, self%rows
         total = 0
         do k = self%first(i), self%first(i + 1) - 1
            total = total + self%value(k)*x(self%column(k))
         end do
         product(i) = total
      end do
   end function times_vector

   !> The product with the columns of a dense matrix.
   pure function times_block(self, x) result(product)
      class(sparse_matrix_type), intent(in) :: self
      real(wp), intent(in) :: x(:, :)
      real(wp) :: product(self%rows, size(x, 2)), turned(size(x, 2), self%columns), total(size(x, 2))
      integer :: i, k
      ! rows of x, which an element meets as a whole, stand together in memory
      turned = transpose(x)
      do i = 1, self%rows
         total = 0
         do k = self%first(i), self%first(i + 1) - 1
            total = total + self%value(k)*turned(:, self%column(k))
         end do
         product(i, :) = total
      end do
   end function times_block

   !> The product of the transpose with a vector.
   pure function transposed_times(self, x) result(product)
      class(sparse_matrix_type), intent(in) :: self
      real(wp), intent(in) :: x(:)
      real(wp) :: product(self%columns)
      integer :: i, k
      product = 0
      do i = 1, self%rows
         do k = self%first(i), self%first(i + 1) - 1
            associate (j => self%column(k))
               product(j) = product(j) + self%value(k)*x(i)
            end associate
         end do
      end do
   end function transposed_times

   !> The matrix of these rows, and of these columns, each of which is named once; left out: all of them.
   pure function part(self, rows, columns)
      class(sparse_matrix_type), intent(in) :: self
      integer, intent(in) :: rows(:)
      integer, intent(in), optional :: columns(:)
      type(sparse_matrix_type) :: part
      integer :: place(self%columns), i, k, n
      place = [(i, i=1, self%columns)]
      n = self%columns
      if (present(columns)) then
         n = size(columns)
         place = 0
         place(columns) = [(i, i=1, n)]
      end if
      part = empty(size(rows), n, sum(self%first(rows + 1) - self%first(rows)))
      n = 0
      do i = 1, size(rows)
         part%first(i) = n + 1
         do k = self%first(rows(i)), self%first(rows(i) + 1) - 1
            if (place(self%column(k)) == 0) cycle
            n = n + 1
            part%column(n) = place(self%column(k))
            part%value(n) = self%value(k)
         end do
      end do
      call finish(part, n)
   end function part

   !> The farthest of its elements from the diagonal, in columns.
   pure integer function half_band_width(self) result(width)
      class(sparse_matrix_type), intent(in) :: self
      integer :: i, k
      width = 0
      do i = 1, self%rows
         do k = self%first(i), self%first(i + 1) - 1
            width = max(width, abs(self%column(k) - i))
         end do
      end do
   end function half_band_width

   !> The diagonal and these numbers of diagonals below and above it, as LAPACK has them: band(above + 1 + i - j, j) is
   !> the element (i, j). Others are left out.
   pure function band(self, below, above)
      class(sparse_matrix_type), intent(in) :: self
      integer, intent(in) :: below, above
      real(wp) :: band(below + above + 1, self%columns)
      integer :: i, k
      band = 0
      do i = 1, self%rows
         do k = self%first(i), self%first(i + 1) - 1
            associate (j => self%column(k))
               if (i - j <= below .and. j - i <= above) band(above + 1 + i - j, j) = self%value(k)
            end associate
         end do
      end do
   end function band
end module sparse_matrix
