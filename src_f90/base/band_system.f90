!> Linear equations with a band matrix and several right sides, made of what flows between their unknowns.
module band_system
   use kinds, only: wp
   use linear_algebra, only: dgbsv
   implicit none (type, external)
   private
   public :: band_system_type, new_band_system

   type :: band_system_type
      private
      !> Diagonals below and above the matrix's own.
      integer :: below = 0, above = 0
      real(wp), allocatable :: matrix(:, :)
      !> (unknown, side); the solutions in the end.
      real(wp), allocatable, public :: right(:, :)
   contains
      procedure :: add
      procedure :: join
      procedure :: leave
      procedure :: solve
   end type band_system_type

contains

   !> Of n unknowns, with all zero.
   pure type(band_system_type) function new_band_system(n, below, above, sides) result(system)
      integer, intent(in) :: n, below, above, sides
      system%below = below
      system%above = above
      ! rows of the matrix lie 8 numbers apart, all the same in lines of the cache
      allocate (system%matrix(8*((2*below + above + 7)/8) + 1, n), system%right(n, sides), source=0.0_wp)
   end function new_band_system

   !> Adds to an element of the matrix.
   pure subroutine add(self, row, column, value)
      class(band_system_type), intent(inout) :: self
      integer, intent(in) :: row, column
      real(wp), intent(in) :: value
      associate (i => self%below + self%above + 1 + row - column)
         self%matrix(i, column) = self%matrix(i, column) + value
      end associate
   end subroutine add

   !> Adds a conductance between two unknowns.
   pure subroutine join(self, a, b, conductance)
      class(band_system_type), intent(inout) :: self
      integer, intent(in) :: a, b
      real(wp), intent(in) :: conductance
      call self%add(a, a, conductance)
      call self%add(a, b, -conductance)
      call self%add(b, b, conductance)
      call self%add(b, a, -conductance)
   end subroutine join

   !> Adds a conductance from an unknown to a given value, which counts in one of the right sides.
   pure subroutine leave(self, row, conductance, value, side)
      class(band_system_type), intent(inout) :: self
      integer, intent(in) :: row, side
      real(wp), intent(in) :: conductance, value
      call self%add(row, row, conductance)
      self%right(row, side) = self%right(row, side) + conductance*value
   end subroutine leave

   !> Makes the right sides the solutions; the matrix is lost. `ok` is false where it is singular.
   subroutine solve(self, ok)
      class(band_system_type), intent(inout) :: self
      logical, intent(out) :: ok
      integer :: pivots(size(self%right, 1)), info
      associate (n => size(self%right, 1), sides => size(self%right, 2))
         call dgbsv(n, self%below, self%above, sides, self%matrix, size(self%matrix, 1), pivots, self%right, n, info)
      end associate
      ok = info == 0
   end subroutine solve
end module band_system
