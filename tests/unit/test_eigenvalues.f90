!> Eigenvalues, their vectors and their order.
program test_eigenvalues
   use kinds, only: wp
   use linear_algebra, only: find_eigenvalues, largest_first
   use check, only: runs, expect, expect_close, report
   implicit none (type, external)

   if (runs('vectors')) call vectors()
   if (runs('pair')) call pair()
   if (runs('order')) call order()
   call report()

contains

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
end program test_eigenvalues
