!> Bordered block-diagonal matrices: a border that knows all blocks, and blocks, of the same size each, that know the
!> border and themselves but not each other. Here the border is the rotor and a block a pad. Solved block by block, so
!> that the cost grows with the number of blocks and not with its cube.
module bordered_system
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: bordered_matrix, new_bordered_matrix

   !> Rows are filled up to a multiple of this, for vector instructions.
   integer, parameter :: simd_width = 4
   !> Border of a rigid journal's rates, and the length of the rows of its pads.
   integer, parameter :: usual_border = 2, usual_width = 8

   !> Matrix on the unknowns (border, block 1, block 2, ...), each block with m of them.
   type :: bordered_matrix
      integer :: border = 0, m = 0
      !> Border over border; border over block (border, m, block), block over border (m, border, block), block over
      !> itself.
      real(wp), allocatable :: corner(:, :), across(:, :, :), down(:, :, :), block(:, :, :)
      !> Rows of the blocks' systems, (column, row, block): the block itself, its border columns, the right-hand side.
      real(wp), allocatable, private :: rows(:, :, :)
   contains
      procedure :: solve
   end type bordered_matrix

contains

   !> A matrix of zeros with a border of this size and a number of blocks of m unknowns each.
   pure function new_bordered_matrix(border, m, blocks) result(matrix)
      integer, intent(in) :: border, m, blocks
      type(bordered_matrix) :: matrix
      integer :: width
      width = max(usual_width, simd_width*((m + border + simd_width)/simd_width))
      matrix%border = border
      matrix%m = m
      allocate (matrix%corner(border, border), source=0.0_wp)
      allocate (matrix%across(border, m, blocks), matrix%down(m, border, blocks), source=0.0_wp)
      allocate (matrix%block(m, m, blocks), matrix%rows(width, m, blocks), source=0.0_wp)
   end function new_bordered_matrix

   !> b := (1 - gamma A)^(-1) b. `ok` is false where this matrix is singular.
   pure subroutine solve(self, gamma, b, ok)
      class(bordered_matrix), intent(inout) :: self
      real(wp), intent(in) :: gamma
      real(wp), intent(inout), contiguous :: b(:)
      logical, intent(out) :: ok
      logical :: singular
      associate (width => size(self%rows, 1), blocks => size(self%block, 3))
         ! sizes that the compiler knows make it three times as fast
         if (self%border == usual_border .and. self%m == 2) then
            call solve_system(usual_width, usual_border, 2, blocks, gamma, self%corner, self%across, self%down, &
               & self%block, self%rows, b, singular)
         else
            call solve_system(width, self%border, self%m, blocks, gamma, self%corner, self%across, self%down, &
               & self%block, self%rows, b, singular)
         end if
      end associate
      ok = .not. singular .and. all(ieee_is_finite(b))
   end subroutine solve

   !> Each block's unknowns are written through the border's, and these are solved for. The matrix is the identity
   !> where gamma is small, and rates come after what they are rates of; so the pivots stay on the diagonal.
   pure subroutine solve_system(width, n, m, blocks, gamma, corner, across, down, block, rows, b, singular)
      !> Length of a row; unknowns of the border, of a block; blocks.
      integer, value :: width, n, m, blocks
      real(wp), intent(in) :: gamma, corner(n, n), across(n, m, blocks), down(m, n, blocks), block(m, m, blocks)
      real(wp), intent(inout) :: rows(width, m, blocks), b(n + m*blocks)
      logical, intent(out) :: singular
      real(wp) :: border(width, n), factor
      integer :: i, j, k, o
      singular = .false.
      border = 0
      do j = 1, n
         border(:n, j) = -gamma*corner(j, :)
         border(j, j) = border(j, j) + 1
         border(n + 1, j) = b(j)
      end do
      do i = 1, blocks
         o = n + (i - 1)*m
         do j = 1, m
            rows(:m, j, i) = -gamma*block(j, :, i)
            rows(j, j, i) = rows(j, j, i) + 1
            rows(m + 1:m + n, j, i) = -gamma*down(j, :, i)
            rows(m + n + 1, j, i) = b(o + j)
         end do
         call eliminate(width, m, rows(:, :, i), singular)
         do k = 1, m
            do j = 1, n
               factor = gamma*across(j, k, i)
               border(:n + 1, j) = border(:n + 1, j) + factor*rows(m + 1:m + n + 1, k, i)
            end do
         end do
      end do
      call eliminate(width, n, border, singular)
      b(:n) = border(n + 1, :)
      do i = 1, blocks
         o = n + (i - 1)*m
         do j = 1, m
            b(o + j) = rows(m + n + 1, j, i) - dot_product(rows(m + 1:m + n, j, i), b(:n))
         end do
      end do
   end subroutine solve_system

   !> Gauss-Jordan elimination of the first n columns of rows held side by side.
   pure subroutine eliminate(width, n, rows, singular)
      integer, value :: width, n
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
end module bordered_system
