!> The equations of finite volumes of one pad, of which some may have cavitated, by elimination.
!>
!> Where a column of cells is whole, the axial part of its equations is the same matrix for every column, up
!> to a factor; its eigenvectors ("modes" of the grid) turn the columns into independent chains of single
!> equations. Only between the first and the last column that cavitate touches are whole blocks eliminated.
module volume_equations
   use kinds, only: wp
   use film_grid, only: film_grid_type
   use grid_modes, only: grid_modes_type, new_grid_modes
   use linear_algebra, only: apply
   use column_elimination, only: factor_chain, solve_chain, finish_chain, multiply_columns, weighted, invert
   implicit none (type, external)
   private
   public :: volume_equations_type, new_volume_equations

   type :: volume_equations_type
      type(film_grid_type) :: grid
      type(grid_modes_type) :: basis
      !> Cells that belong to the film: 1, the others 0 (row, column).
      real(wp), allocatable :: film(:, :)
      !> Columns that cavitate touches: first to last; none: first = columns + 1.
      integer :: first, last
      !> Reciprocal pivots outside them (mode, column); inverse blocks inside (row, row, column).
      real(wp), allocatable, private :: per_pivot(:, :), block(:, :, :)
   contains
      procedure :: eliminate
      procedure :: solve
      procedure :: in_rows
      procedure :: multiply
   end type volume_equations_type

contains

   !> For the cells of a grid, all of them whole.
   function new_volume_equations(grid) result(self)
      type(film_grid_type), intent(in) :: grid
      type(volume_equations_type) :: self
      self%grid = grid
      self%basis = new_grid_modes(grid)
      associate (m => self%basis%m, rows => grid%rows, columns => grid%columns)
         allocate (self%film(m, columns), source=0.0_wp)
         self%film(:rows, :) = 1
         allocate (self%per_pivot(m, columns), self%block(m, rows, columns), source=0.0_wp)
      end associate
   end function new_volume_equations

   !> Pivots and blocks: whole columns from both edges of the pad inwards, mode by mode, then the columns
   !> between, from the first to the last; none of these where the film does not cavitate.
   pure subroutine eliminate(self, cavitates, more)
      class(volume_equations_type), intent(inout) :: self
      logical, intent(in) :: cavitates
      !> Added to the diagonal beside cavitated cells, (row, column).
      real(wp), intent(in), optional :: more(:, :)
      logical :: touched(self%grid%columns)
      integer :: i, j, m
      m = self%basis%m
      associate (grid => self%grid, c => self%grid%along, n => self%grid%columns, rows => self%grid%rows)
         self%first = n + 1
         self%last = n
         if (cavitates) then
            do i = 1, n
               touched(i) = any(self%film(:rows, i) <= 0)
            end do
            if (any(touched)) then
               self%first = findloc(touched, .true., dim=1)
               self%last = findloc(touched, .true., dim=1, back=.true.)
               if (present(more)) self%first = max(1, self%first - 1)
               if (present(more)) self%last = min(n, self%last + 1)
            end if
         end if
         call factor_chain(m, n, 1, self%first - 1, c, grid%beside, self%basis%eigenvalue, self%per_pivot)
         call factor_chain(m, n, n, self%last + 1, c, grid%beside, self%basis%eigenvalue, self%per_pivot)
         do i = self%first, self%last
            associate (block => self%block(:, :, i))
               if (.not. any(self%film(:rows, i) > 0)) then
                  block = 0
                  cycle
               end if
               if (i > self%first) then
                  block = -c(i - 1)**2*self%block(:, :, i - 1)
               else if (i > 1) then
                  block = self%basis%in_rows(-c(i - 1)**2*self%per_pivot(:, i - 1))
               else
                  block = 0
               end if
               if (i == self%last .and. i < n) block = block + self%basis%in_rows(-c(i)**2*self%per_pivot(:, i + 1))
               do j = 1, rows
                  block(j, j) = block(j, j) + c(i - 1) + c(i) + grid%beside(i)*self%basis%diagonal(j)
                  if (present(more)) block(j, j) = block(j, j) + more(j, i)
               end do
               do j = 1, rows - 1
                  block(j, j + 1) = block(j, j + 1) + grid%beside(i)*self%basis%off_diagonal(j)
                  block(j + 1, j) = block(j + 1, j) + grid%beside(i)*self%basis%off_diagonal(j)
               end do
               call invert(m, rows, self%film(:, i), block)
            end associate
         end do
      end associate
   end subroutine eliminate

   !> The scaled solution, by rows from the first to the last column that cavitate touches, by modes outside, for
   !> a load per column in every row of the film, and one more in its edge row.
   pure subroutine solve(self, load, edge_load, x)
      class(volume_equations_type), intent(in) :: self
      real(wp), intent(in) :: load(:), edge_load(:)
      real(wp), intent(inout), contiguous :: x(:, :)
      real(wp) :: next(size(x, 1))
      integer :: i, m
      m = size(x, 1)
      associate (c => self%grid%along, n => self%grid%columns, rows => self%grid%rows, first => self%first, &
         & last => self%last)
         call solve_chain(m, n, 1, first - 1, c, self%per_pivot, load, self%basis%uniform, edge_load, &
            & self%basis%at_edge, x)
         call solve_chain(m, n, n, last + 1, c, self%per_pivot, load, self%basis%uniform, edge_load, &
            & self%basis%at_edge, x)
         do i = first, last
            next = load(i)*self%basis%root
            next(rows) = next(rows) + edge_load(i)*self%basis%root(rows)
            if (i > first) then
               next = next + c(i - 1)*x(:, i - 1)
            else if (i > 1) then
               next = next + c(i - 1)*apply(m, rows, self%basis%modes, x(:, i - 1))
            end if
            if (i == last .and. i < n) next = next + c(i)*apply(m, rows, self%basis%modes, x(:, i + 1))
            x(:, i) = apply(m, rows, self%block(:, :, i), next)
         end do
         do i = last - 1, first, -1
            x(:, i) = x(:, i) + c(i)*apply(m, rows, self%block(:, :, i), x(:, i + 1))
         end do
         next = 0
         if (first <= n) next = apply(m, rows, self%basis%transposed, x(:, first))
         call finish_chain(m, n, 1, first - 1, c, self%per_pivot, next, x)
         if (last < n) then
            next = apply(m, rows, self%basis%transposed, x(:, last))
            call finish_chain(m, n, n, last + 1, c, self%per_pivot, next, x)
         end if
      end associate
   end subroutine solve

   !> Column i of a solution by rows, scaled.
   pure function in_rows(self, x, i) result(column)
      class(volume_equations_type), intent(in) :: self
      real(wp), intent(in), contiguous :: x(:, :)
      integer, intent(in) :: i
      real(wp) :: column(size(x, 1))
      if (i < self%first .or. i > self%last) then
         column = apply(size(x, 1), self%grid%rows, self%basis%modes, x(:, i))
      else
         column = x(:, i)
      end if
   end function in_rows

   !> Products of pressures and another solution, summed over the rows and weighted by their heights, as the grid's
   !> derivatives want them. They are the same by rows and by modes.
   pure subroutine multiply(self, p, a, along, across, total)
      class(volume_equations_type), intent(in) :: self
      real(wp), intent(in), contiguous :: p(:, :), a(:, :)
      real(wp), intent(out) :: along(0:), across(:), total(:)
      real(wp) :: at_edge(size(across)), edge_row(size(p, 1))
      integer :: i
      associate (grid => self%grid, basis => self%basis, m => self%basis%m, n => self%grid%columns, &
         & rows => self%grid%rows, first => self%first, last => self%last)
         call multiply_columns(m, n, 1, first - 1, basis%eigenvalue, basis%uniform, basis%at_edge, p, a, along, &
            & across, total, at_edge)
         call multiply_columns(m, n, last + 1, n, basis%eigenvalue, basis%uniform, basis%at_edge, p, a, along, across, &
            & total, at_edge)
         edge_row = 0
         edge_row(rows) = basis%root(rows)
         call multiply_columns(m, n, first, last, basis%diagonal, basis%root, edge_row, p, a, along, across, total, &
            & at_edge)
         do i = first, last
            across(i) = across(i) + dot_product(basis%off_diagonal(1:rows - 1), &
               & p(:rows - 1, i)*a(2:rows, i) + p(2:rows, i)*a(:rows - 1, i))
         end do
         if (first > 1 .and. first <= n) along(first - 1) = over_seam(first - 1)
         if (last < n) along(last) = over_seam(last)
         along(0) = weighted(m, p(:, 1), a(:, 1)) - grid%ambient*total(1)
         along(n) = weighted(m, p(:, n), a(:, n)) - grid%supply*total(n)
         across = across - grid%ambient*grid%outward(rows)*at_edge
      end associate
   contains
      !> Over the face between column i and the next, one by rows, the other by modes.
      pure real(wp) function over_seam(i)
         integer, intent(in) :: i
         over_seam = weighted(self%basis%m, self%in_rows(p, i + 1) - self%in_rows(p, i), &
            & self%in_rows(a, i + 1) - self%in_rows(a, i))
      end function over_seam
   end subroutine multiply
end module volume_equations
