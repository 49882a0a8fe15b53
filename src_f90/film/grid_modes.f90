!> Axial eigenvectors ("modes") of the finite volumes of film_grid: where a column of cells is whole, the axial
!> part of its equations is the same matrix for every column, up to a factor.
module grid_modes
   use kinds, only: wp
   use column_sweeps, only: padded
   implicit none (type, external)
   private
   public :: grid_modes_type, new_grid_modes

   type :: grid_modes_type
      !> Rows and modes, filled up with zeros to whole vectors.
      integer :: m
      !> (row, mode) and (mode, row), and the eigenvalues.
      real(wp), allocatable :: modes(:, :), transposed(:, :), eigenvalue(:)
      !> A load of 1 in every row and one of 1 in the edge row, by mode.
      real(wp), allocatable :: uniform(:), at_edge(:)
   end type grid_modes_type

   interface
      !> LAPACK: eigenvalues and eigenvectors of a symmetric tridiagonal matrix.
      subroutine dstev(jobz, n, d, e, z, ldz, work, info)
         import :: wp
         character, intent(in) :: jobz
         integer, intent(in) :: n, ldz
         real(wp), intent(inout) :: d(*), e(*)
         real(wp), intent(out) :: z(ldz, *), work(*)
         integer, intent(out) :: info
      end subroutine dstev
   end interface

contains

   !> For so many rows, with the conductance of the edge row to the side over that between rows.
   function new_grid_modes(rows, edge) result(self)
      integer, intent(in) :: rows
      real(wp), intent(in) :: edge
      type(grid_modes_type) :: self
      real(wp) :: diagonal(rows), beside(rows), vectors(rows, rows), work(2*rows)
      integer :: info
      diagonal = 2
      diagonal(1) = 1
      diagonal(rows) = 1 + edge
      beside = -1
      call dstev('V', rows, diagonal, beside, vectors, rows, work, info)
      self%m = padded(rows)
      allocate (self%modes(self%m, rows), self%transposed(self%m, rows), source=0.0_wp)
      allocate (self%eigenvalue(self%m), self%uniform(self%m), self%at_edge(self%m), source=0.0_wp)
      self%modes(:rows, :) = vectors
      self%transposed(:rows, :) = transpose(vectors)
      self%eigenvalue(:rows) = diagonal
      self%uniform(:rows) = sum(vectors, dim=1)
      self%at_edge(:rows) = vectors(rows, :)
   end function new_grid_modes
end module grid_modes
