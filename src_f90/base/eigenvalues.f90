!> Eigenvalues and eigenvectors of a real matrix, and their order.
module eigenvalues
   use kinds, only: wp
   use lapack, only: dgeev
   implicit none (type, external)
   private
   public :: find_eigenvalues, largest_first

contains

   !> `ok` is false where LAPACK's iteration does not converge. Of a pair the value with positive imaginary part comes
   !> first.
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
      associate (n => size(values))
         rows = merge(n, 1, present(vectors))
         allocate (right(rows, rows))
         changed = matrix
         call dgeev('N', merge('V', 'N', present(vectors)), n, changed, n, re, im, left, 1, right, rows, work, &
            & size(work), info)
      end associate
      ok = info == 0
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
end module eigenvalues
