!> Bordered block-diagonal matrices: a border that knows all blocks, and groups of blocks that know one or two pairs of
!> the border and themselves but not each other. Here the border are the journals, with their slopes where these count;
!> a group is an element that acts on one, as a bearing, and a block a pad. Solved block by block, so that the cost
!> grows with the number of blocks and not with its cube.
module bordered_system
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: bordered_matrix, new_bordered_matrix

   !> Unknowns of the border that a group knows: the displacements of a journal; with its slopes twice as many.
   integer, parameter :: pair = 2, both = 2*pair
   !> Rows are filled up to a multiple of this, for vector instructions.
   integer, parameter :: simd_width = 4
   !> Length of the rows of a block of up to five unknowns; of up to seven that knows two pairs.
   integer, parameter :: usual_width = 8, long_width = 12

   !> Blocks of m unknowns each, and the pair of the border that they know, and a second one; 0: they know one.
   type :: block_group
      integer :: m = 0, pair = 1, second = 0
      !> What they know of the border over a block (pair, m, block), a block over that (m, pair, block), over itself.
      real(wp), allocatable :: across(:, :, :), down(:, :, :), block(:, :, :)
      !> What the group adds to both pairs over themselves.
      real(wp), allocatable :: corner(:, :)
      !> Rows of the blocks' systems, (column, row, block): the block itself, its border columns, the right-hand side.
      real(wp), allocatable, private :: rows(:, :, :)
   end type block_group

   !> Matrix on the unknowns (pairs of the border, blocks of group 1, blocks of group 2, ...).
   type :: bordered_matrix
      type(block_group), allocatable :: groups(:)
      !> What stands on the border where gamma is 0: the identity, if nothing else is put there.
      real(wp), allocatable :: border(:, :)
      !> Of each pair what the groups that know one add over itself, (pair, pair, number of the pair).
      real(wp), allocatable :: corner(:, :, :)
   contains
      procedure :: solve
   end type bordered_matrix

contains

   !> A matrix of zeros with a border of a number of pairs, and groups that know one of them, of these numbers of
   !> blocks of m unknowns each, and a second one where it is not 0.
   pure function new_bordered_matrix(pairs, known, m, blocks, second) result(matrix)
      integer, intent(in) :: pairs, known(:), m(:), blocks(:), second(:)
      type(bordered_matrix) :: matrix
      integer :: g, on
      allocate (matrix%groups(size(m)))
      allocate (matrix%corner(pair, pair, pairs), matrix%border(pair*pairs, pair*pairs), source=0.0_wp)
      do g = 1, pair*pairs
         matrix%border(g, g) = 1
      end do
      do g = 1, size(m)
         associate (group => matrix%groups(g))
            group%m = m(g)
            group%pair = known(g)
            group%second = second(g)
            on = merge(both, pair, second(g) > 0)
            if (on == both) allocate (group%corner(both, both), source=0.0_wp)
            allocate (group%across(on, m(g), blocks(g)), group%down(m(g), on, blocks(g)), source=0.0_wp)
            allocate (group%block(m(g), m(g), blocks(g)), &
               & group%rows(merge(long_width, usual_width, on == both), m(g), blocks(g)), source=0.0_wp)
         end associate
      end do
   end function new_bordered_matrix

   !> Length of a row of n unknowns and the right-hand side.
   pure integer function row_width(n)
      integer, intent(in) :: n
      row_width = simd_width*((n + simd_width)/simd_width)
   end function row_width

   !> b := (B - gamma A)^(-1) b, with B the identity but on the border. `ok` is false where this matrix is singular.
   !> Each block's unknowns are written through the border's, and these are solved for. The matrix is the identity
   !> where gamma is small, and rates come after what they are rates of; so the pivots stay on the diagonal.
   pure subroutine solve(self, gamma, b, ok)
      class(bordered_matrix), intent(inout) :: self
      real(wp), intent(in) :: gamma
      real(wp), intent(inout), contiguous :: b(:)
      logical, intent(out) :: ok
      !> Of each pair what stands over itself, and its right-hand side: (pair and this, row, pair); what groups that
      !> know two add to both.
      real(wp) :: own(pair + 1, pair, size(self%corner, 3)), of_both(both + 1, both, size(self%groups))
      logical :: singular
      integer :: g, j, k, n, o
      singular = .false.
      n = size(self%border, 1)
      do k = 1, size(own, 3)
         do j = 1, pair
            associate (before => pair*(k - 1))
               own(:pair, j, k) = self%border(before + j, before + 1:before + pair) - gamma*self%corner(j, :, k)
               own(pair + 1, j, k) = b(before + j)
            end associate
         end do
      end do
      o = n
      do g = 1, size(self%groups)
         associate (group => self%groups(g), blocks => size(self%groups(g)%block, 3))
            ! sizes that the compiler knows make it three times as fast
            if (group%second > 0) then
               of_both(:, :, g) = of_corner(group, gamma)
               call reduce(long_width, group%m, both, blocks, gamma, group%across, group%down, group%block, &
                  & group%rows, b(o + 1:), of_both(:, :, g), singular)
            else if (group%m == 2) then
               call reduce(usual_width, 2, pair, blocks, gamma, group%across, group%down, group%block, group%rows, &
                  & b(o + 1:), own(:, :, group%pair), singular)
            else
               call reduce(usual_width, group%m, pair, blocks, gamma, group%across, group%down, group%block, &
                  & group%rows, b(o + 1:), own(:, :, group%pair), singular)
            end if
            o = o + group%m*blocks
         end associate
      end do
      if (n == pair) then
         call eliminate(pair + 1, pair, own, singular)
         b(:pair) = own(pair + 1, :, 1)
      else
         call solve_border(self%border, own, self%groups, of_both, b, singular)
      end if
      o = n
      do g = 1, size(self%groups)
         associate (group => self%groups(g), blocks => size(self%groups(g)%block, 3), &
            & of_pair => b(pair*(self%groups(g)%pair - 1) + 1:pair*self%groups(g)%pair))
            if (group%second > 0) then
               call restore(long_width, group%m, both, blocks, group%rows, b(places(group)), b(o + 1:))
            else if (group%m == 2) then
               call restore(usual_width, 2, pair, blocks, group%rows, of_pair, b(o + 1:))
            else
               call restore(usual_width, group%m, pair, blocks, group%rows, of_pair, b(o + 1:))
            end if
            o = o + group%m*blocks
         end associate
      end do
      ok = .not. singular .and. all(ieee_is_finite(b))
   end subroutine solve

   !> What a group of two pairs adds to both by itself, with right-hand sides of 0.
   pure function of_corner(group, gamma)
      type(block_group), intent(in) :: group
      real(wp), intent(in) :: gamma
      real(wp) :: of_corner(both + 1, both)
      of_corner(:both, :) = -gamma*transpose(group%corner)
      of_corner(both + 1, :) = 0
   end function of_corner

   !> Where on the border both pairs of a group are.
   pure function places(group)
      type(block_group), intent(in) :: group
      integer :: places(both), j
      places = [(pair*(group%pair - 1) + j, j=1, pair), (pair*(group%second - 1) + j, j=1, pair)]
   end function places

   !> The unknowns of a border of several pairs, from what stands over each of them and its right-hand side.
   pure subroutine solve_border(border, own, groups, of_both, b, singular)
      real(wp), intent(in) :: border(:, :), own(:, :, :), of_both(:, :, :)
      type(block_group), intent(in) :: groups(:)
      real(wp), intent(inout) :: b(:)
      logical, intent(inout) :: singular
      real(wp) :: rows(row_width(size(border, 1)), size(border, 1))
      integer :: j, k, n, at(both + 1)
      n = size(border, 1)
      rows = 0
      do k = 1, size(own, 3)
         do j = 1, pair
            associate (row => rows(:, pair*(k - 1) + j), before => pair*(k - 1))
               row(:n) = border(before + j, :)
               row(before + 1:before + pair) = own(:pair, j, k)
               row(n + 1) = own(pair + 1, j, k)
            end associate
         end do
      end do
      do k = 1, size(groups)
         if (groups(k)%second == 0) cycle
         at = [places(groups(k)), n + 1]
         rows(at, at(:both)) = rows(at, at(:both)) + of_both(:, :, k)
      end do
      call eliminate(size(rows, 1), n, rows, singular)
      b(:n) = rows(n + 1, :)
   end subroutine solve_border

   !> Writes the unknowns of a group's blocks through what it knows of the border, whose rows (that and right-hand side,
   !> row) gain what follows.
   pure subroutine reduce(width, m, on, blocks, gamma, across, down, block, rows, b, border, singular)
      !> Length of a row; unknowns of a block, and of the border that it knows; blocks.
      integer, value :: width, m, on, blocks
      real(wp), intent(in) :: gamma, across(on, m, blocks), down(m, on, blocks), block(m, m, blocks), b(m*blocks)
      real(wp), intent(inout) :: rows(width, m, blocks), border(on + 1, on)
      logical, intent(inout) :: singular
      real(wp) :: factor
      integer :: i, j, k
      do i = 1, blocks
         do j = 1, m
            rows(:m, j, i) = -gamma*block(j, :, i)
            rows(j, j, i) = rows(j, j, i) + 1
            rows(m + 1:m + on, j, i) = -gamma*down(j, :, i)
            rows(m + on + 1, j, i) = b((i - 1)*m + j)
         end do
         call eliminate(width, m, rows(:, :, i), singular)
         do k = 1, m
            do j = 1, on
               factor = gamma*across(j, k, i)
               border(:, j) = border(:, j) + factor*rows(m + 1:m + on + 1, k, i)
            end do
         end do
      end do
   end subroutine reduce

   !> The unknowns of a group's blocks from those of the border that it knows.
   pure subroutine restore(width, m, on, blocks, rows, of_border, b)
      integer, value :: width, m, on, blocks
      real(wp), intent(in) :: rows(width, m, blocks), of_border(on)
      real(wp), intent(inout) :: b(m*blocks)
      integer :: i, j
      do i = 1, blocks
         do j = 1, m
            b((i - 1)*m + j) = rows(m + on + 1, j, i) - dot_product(rows(m + 1:m + on, j, i), of_border)
         end do
      end do
   end subroutine restore

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
