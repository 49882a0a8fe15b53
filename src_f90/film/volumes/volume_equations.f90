!> The equations of finite volumes of one pad, of which some may have cavitated, by elimination.
!>
!> Where a column of cells is whole, the axial part of its equations is the same matrix for every column, up
!> to a factor; its eigenvectors ("modes" of the grid) turn the columns into independent chains of single
!> equations. Only between the first and the last column that cavitate touches are whole blocks eliminated.
!>
!> A cavitated film ends between cells: what flows from it into a cell that has cavitated fills a part of it, over what
!> the cell would take up if it were whole. The pressure meets this end without a slope, so that its own equations need
!> not know it. A change of the pressure with the motion does not: it falls to 0 at the end, and if it fell to 0 in the
!> middle of the cavitated cells, slopes would err by the first order of a cell's size, and leap when a cell cavitates.
module volume_equations
   use kinds, only: wp
   use film_grid, only: film_grid_type
   use linear_algebra, only: dstev, padded, apply
   use column_elimination, only: factor_chain, solve_chain, finish_chain, multiply_columns, weighted, invert
   implicit none (type, external)
   private
   public :: volume_equations_type, new_volume_equations, grid_modes_type, new_grid_modes, boundary_conductance

   !> Axial eigenvectors of a column that is whole. Its matrix is symmetric for pressures times the root of the rows'
   !> heights ("scaled").
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
      !> What scaled pressures count for that in the middle plane, by row and by mode.
      real(wp), allocatable :: middle_rows(:), middle_modes(:)
   contains
      procedure :: in_rows => matrix_in_rows
   end type grid_modes_type

   type :: volume_equations_type
      type(film_grid_type) :: grid
      type(grid_modes_type) :: basis
      !> Cells that belong to the film: 1, the others 0 (row, column).
      real(wp), allocatable :: film(:, :)
      !> How many cells of each column belong to the film, as eliminated last where it cavitates.
      real(wp), allocatable :: filled(:)
      !> Columns that cavitate touches: first to last; none: first = columns + 1.
      integer :: first = 1, last = 0
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
         allocate (self%film(m, columns), self%filled(columns), source=0.0_wp)
         self%film(:rows, :) = 1
         allocate (self%per_pivot(m, columns), source=0.0_wp)
         ! not set: most columns are whole, and have no use for theirs
         allocate (self%block(m, rows, columns))
      end associate
   end function new_volume_equations

   !> Pivots and blocks: whole columns from both edges of the pad inwards, mode by mode, then the columns
   !> between, from the first to the last; none of these where the film does not cavitate.
   pure subroutine eliminate(self, cavitates, more, same)
      class(volume_equations_type), intent(inout) :: self
      logical, intent(in) :: cavitates
      !> Added to the diagonal beside cavitated cells, (row, column).
      real(wp), intent(in), optional :: more(:, :)
      !> Columns from the first on that are what they were at the last elimination.
      integer, intent(in), optional :: same
      integer :: i, j, m, kept
      m = self%basis%m
      kept = 0
      ! the last block has besides what lies behind it
      if (present(same)) kept = merge(min(same, self%last - 1), 0, same >= self%first)
      associate (grid => self%grid, c => self%grid%along, n => self%grid%columns, rows => self%grid%rows)
         self%first = n + 1
         self%last = n
         if (cavitates) then
            self%filled = sum(self%film, dim=1)
            if (any(self%filled < rows)) then
               self%first = findloc(self%filled < rows, .true., dim=1)
               self%last = findloc(self%filled < rows, .true., dim=1, back=.true.)
               if (present(more)) self%first = max(1, self%first - 1)
               if (present(more)) self%last = min(n, self%last + 1)
            end if
         end if
         call factor_chain(m, n, 1, self%first - 1, c, grid%beside, self%basis%eigenvalue, self%per_pivot)
         call factor_chain(m, n, n, self%last + 1, c, grid%beside, self%basis%eigenvalue, self%per_pivot)
         do i = max(self%first, min(kept, self%last - 1) + 1), self%last
            if (.not. self%filled(i) > 0) cycle
            associate (block => self%block(:, :, i))
               if (i > self%first) then
                  block = 0
                  if (self%filled(i - 1) > 0) block = -c(i - 1)**2*self%block(:, :, i - 1)
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
            x(:, i) = 0
            if (.not. self%filled(i) > 0) cycle
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
            if (self%filled(i) > 0) x(:, i) = x(:, i) + c(i)*apply(m, rows, self%block(:, :, i), x(:, i + 1))
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
      allocate (self%middle_rows(self%m), self%middle_modes(self%m), source=0.0_wp)
      self%middle_rows(:rows) = grid%to_middle/self%root(:rows)
      self%middle_modes(:rows) = matmul(self%middle_rows(:rows), vectors)
   end function new_grid_modes

   !> The matrix with these values by mode, in rows.
   pure function matrix_in_rows(self, values) result(block)
      class(grid_modes_type), intent(in) :: self
      real(wp), intent(in) :: values(:)
      real(wp) :: block(self%m, size(self%modes, 2))
      integer :: j
      do j = 1, size(block, 2)
         block(:, j) = apply(size(block, 1), size(block, 2), self%modes, values*self%transposed(:, j))
      end do
   end function matrix_in_rows

   !> What the end of a film adds to the diagonal of a cell's equation for a change of pressure, (row, column): the
   !> conductance towards a cavitated cell is that up to the end of the film instead of up to the cell's middle.
   pure function boundary_conductance(grid, film, pressure, first, last) result(more)
      type(film_grid_type), intent(in) :: grid
      !> Cells of the film 1, others 0; pressure above that of cavitation, Pa, 0 in the others; (row, column).
      real(wp), intent(in) :: film(:, :), pressure(:, :)
      !> The columns that cavitate touches; beside these alone the pressure has to be known.
      integer, intent(in) :: first, last
      real(wp) :: more(size(film, 1), grid%columns)
      real(wp), dimension(0:grid%rows + 1, 0:grid%columns + 1) :: filled, p
      integer :: i, k
      more = 0
      filled = 1
      p = 0
      associate (n => grid%columns, rows => grid%rows, width => grid%width, height => grid%height)
         p(1:rows, 1:n) = pressure(:rows, :)
         do i = first, last
            do k = 1, rows
               if (film(k, i) > 0) cycle
               filled(k, i) = share(grid%along(i - 1)*p(k, i - 1) + grid%along(i)*p(k, i + 1) + grid%beside(i) &
                  & *(grid%inward(k)*p(k - 1, i) + grid%outward(k)*p(k + 1, i)), &
                  & grid%source(i) + merge(grid%edge_source(i), 0.0_wp, k == rows))
            end do
         end do
         do i = max(1, first - 1), min(n, last + 1)
            do k = 1, rows
               if (.not. film(k, i) > 0) cycle
               if (i > 1) more(k, i) = grid%along(i - 1)*nearer(width(i), width(i - 1), filled(k, i - 1))
               if (i < n) more(k, i) = more(k, i) + grid%along(i)*nearer(width(i), width(i + 1), filled(k, i + 1))
               if (k > 1) more(k, i) = more(k, i) + grid%beside(i)*grid%inward(k) &
                  & *nearer(height(k), height(k - 1), filled(k - 1, i))
               if (k < rows) more(k, i) = more(k, i) + grid%beside(i)*grid%outward(k) &
                  & *nearer(height(k), height(k + 1), filled(k + 1, i))
            end do
         end do
      end associate
   end function boundary_conductance

   !> The part of a cavitated cell that an inflow fills.
   pure real(wp) function share(inflow, source)
      real(wp), intent(in) :: inflow, source
      share = 0
      if (source > 0) share = min(1.0_wp, max(0.0_wp, inflow/source))
   end function share

   !> Distance from the middle of a cell to that of its neighbour, over the distance to the end of the film, less 1; 0
   !> where the neighbour is full.
   pure real(wp) function nearer(own, other, filled)
      !> Sizes of both, and the part of the neighbour up to which there is film.
      real(wp), intent(in) :: own, other, filled
      nearer = 0
      if (filled < 1) nearer = (own + other)/(own + 2*filled*other) - 1
   end function nearer
end module volume_equations
