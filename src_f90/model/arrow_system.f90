!> Matrices whose pads know the journal and themselves but not each other: a corner for the journal, a block
!> per pad, and what couples them. Solved pad by pad, so that the cost grows with the number of pads and not
!> with its cube.
module arrow_system
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: arrow_matrix, new_arrow_matrix, journal_states

   integer, parameter :: journal_states = 4
   !> Most states of a pad; room for a row of a pad's system: its block, four columns, the right-hand side.
   integer, parameter :: most = 5, width = 12

   !> Matrix on the states (journal, pad 1, pad 2, ...), each pad with m of them.
   type :: arrow_matrix
      integer :: m = 0
      !> Journal over journal; journal over pad (4, m, pad), pad over journal (m, 4, pad), pad over itself.
      real(wp) :: corner(journal_states, journal_states) = 0
      real(wp), allocatable :: across(:, :, :), down(:, :, :), block(:, :, :)
      !> Rows of the pads' systems, (column, row, pad).
      real(wp), allocatable, private :: rows(:, :, :)
   contains
      procedure :: solve
      procedure :: dense
   end type arrow_matrix

contains

   !> A matrix of zeros for so many pads of m states each, m at most 5.
   pure function new_arrow_matrix(m, pads) result(matrix)
      integer, intent(in) :: m, pads
      type(arrow_matrix) :: matrix
      matrix%m = m
      allocate (matrix%across(journal_states, m, pads), matrix%down(m, journal_states, pads), source=0.0_wp)
      allocate (matrix%block(m, m, pads), matrix%rows(width, most, pads), source=0.0_wp)
   end function new_arrow_matrix

   !> b := (1 - gamma A)^(-1) b. `ok` is false where this matrix is singular. Each pad's states are written
   !> through the journal's, and these are solved for. The matrix is the identity where gamma is small, and
   !> rates come after what they are rates of; so the pivots stay on the diagonal.
   pure subroutine solve(self, gamma, b, ok)
      class(arrow_matrix), intent(inout) :: self
      real(wp), intent(in) :: gamma
      real(wp), intent(inout) :: b(:)
      logical, intent(out) :: ok
      real(wp) :: journal(width, journal_states), factor
      logical :: singular
      integer :: i, j, k, o
      singular = .false.
      associate (m => self%m)
         journal = 0
         do j = 1, journal_states
            journal(:journal_states, j) = -gamma*self%corner(j, :)
            journal(j, j) = journal(j, j) + 1
            journal(journal_states + 1, j) = b(j)
         end do
         do i = 1, size(self%block, 3)
            o = journal_states + (i - 1)*m
            associate (rows => self%rows(:, :, i))
               do j = 1, m
                  rows(:m, j) = -gamma*self%block(j, :, i)
                  rows(j, j) = rows(j, j) + 1
                  rows(m + 1:m + journal_states, j) = -gamma*self%down(j, :, i)
                  rows(m + journal_states + 1, j) = b(o + j)
               end do
               call eliminate(m, rows, singular)
               do k = 1, m
                  do j = 1, journal_states
                     factor = gamma*self%across(j, k, i)
                     journal(:journal_states + 1, j) = journal(:journal_states + 1, j) &
                        & + factor*rows(m + 1:m + journal_states + 1, k)
                  end do
               end do
            end associate
         end do
         call eliminate(journal_states, journal, singular)
         b(:journal_states) = journal(journal_states + 1, :)
         do i = 1, size(self%block, 3)
            o = journal_states + (i - 1)*m
            do j = 1, m
               b(o + j) = self%rows(m + journal_states + 1, j, i) &
                  & - dot_product(self%rows(m + 1:m + journal_states, j, i), b(:journal_states))
            end do
         end do
         ok = .not. singular .and. all(ieee_is_finite(b))
      end associate
   end subroutine solve

   !> Gauss-Jordan elimination of the first n columns of rows held side by side.
   pure subroutine eliminate(n, rows, singular)
      integer, intent(in) :: n
      real(wp), intent(inout) :: rows(width, n)
      logical, intent(inout) :: singular
      real(wp) :: factor
      integer :: i, j, k
      do i = 1, n
         if (.not. abs(rows(i, i)) > 0) then
            singular = .true.
            return
         end if
         factor = 1/rows(i, i)
         !$omp simd
         do k = 1, width
            rows(k, i) = rows(k, i)*factor
         end do
         do j = 1, n
            if (j == i) cycle
            factor = rows(i, j)
            !$omp simd
            do k = 1, width
               rows(k, j) = rows(k, j) - factor*rows(k, i)
            end do
         end do
      end do
   end subroutine eliminate

   pure function dense(self) result(matrix)
      class(arrow_matrix), intent(in) :: self
      real(wp), allocatable :: matrix(:, :)
      integer :: i, n, o
      n = journal_states + self%m*size(self%block, 3)
      allocate (matrix(n, n), source=0.0_wp)
      matrix(:journal_states, :journal_states) = self%corner
      do i = 1, size(self%block, 3)
         o = journal_states + (i - 1)*self%m
         matrix(:journal_states, o + 1:o + self%m) = self%across(:, :, i)
         matrix(o + 1:o + self%m, :journal_states) = self%down(:, :, i)
         matrix(o + 1:o + self%m, o + 1:o + self%m) = self%block(:, :, i)
      end do
   end function dense
end module arrow_system
