!> Axial eigenvectors ("modes") of the finite volumes of film_grid: where a column of cells is whole, the axial
!> part of its equations is the same matrix for every column, up to a factor. It is symmetric for pressures times
!> the root of the rows' heights ("scaled").
module grid_modes
   use kinds, only: wp
   use linear_algebra, only: dstev, padded, apply
   use film_grid, only: film_grid_type
   implicit none (type, external)
   private
   public :: grid_modes_type, new_grid_modes

   type :: grid_modes_type
      !> Rows and modes, filled up with zeros to whole SIMD vectors.
      integer :: m
      !> (row, mode) and (mode, row), and the eigenvalues.
      real(wp), allocatable :: modes(:, :), transposed(:, :), eigenvalue(:)
      !> The matrix in rows: its diagonal, and what stands beside it, with zeros at both ends (0:m).
      real(wp), allocatable :: diagonal(:), off_diagonal(:)
      !> Root of the rows' heights over their mean.
      real(wp), allocatable :: root(:)
      !> A load of 1 in every row and one of 1 in the edge row, scaled, by mode.
      real(wp), allocatable :: uniform(:), at_edge(:)
   contains
      procedure :: in_rows
   end type grid_modes_type

contains

   !> For the rows of a grid.
   function new_grid_modes(grid) result(self)
      type(film_grid_type), intent(in) :: grid
      type(grid_modes_type) :: self
      real(wp), dimension(grid%rows) :: diagonal, beside
      real(wp), allocatable :: vectors(:, :)
      real(wp) :: work(2*grid%rows)
      integer :: info, rows
      rows = grid%rows
      allocate (vectors(rows, rows))
      diagonal = grid%inward + grid%outward
      beside(:rows - 1) = -sqrt(grid%outward(:rows - 1)*grid%inward(2:))
      beside(rows) = 0
      self%m = padded(rows)
      allocate (self%diagonal(self%m), self%off_diagonal(0:self%m), self%root(self%m), source=0.0_wp)
      self%diagonal(:rows) = diagonal
      self%off_diagonal(1:rows) = beside
      self%root(:rows) = sqrt(grid%height)
      call dstev('V', rows, diagonal, beside, vectors, rows, work, info)
      allocate (self%modes(self%m, rows), self%transposed(self%m, rows), source=0.0_wp)
      allocate (self%eigenvalue(self%m), self%uniform(self%m), self%at_edge(self%m), source=0.0_wp)
      self%modes(:rows, :) = vectors
      self%transposed(:rows, :) = transpose(vectors)
      self%eigenvalue(:rows) = diagonal
      self%uniform(:rows) = matmul(self%root(:rows), vectors)
      self%at_edge(:rows) = self%root(rows)*vectors(rows, :)
   end function new_grid_modes

   !> The matrix with these values by mode, in rows.
   pure function in_rows(self, values) result(block)
      class(grid_modes_type), intent(in) :: self
      real(wp), intent(in) :: values(:)
      real(wp) :: block(self%m, size(self%modes, 2))
      integer :: j
      do j = 1, size(block, 2)
         block(:, j) = apply(size(block, 1), size(block, 2), self%modes, values*self%transposed(:, j))
      end do
   end function in_rows
end module grid_modes
