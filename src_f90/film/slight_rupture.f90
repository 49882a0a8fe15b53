!> What the rupture of a few cells at the trailing edge does to the force, by Green's functions of the whole film.
!>
!> With rupture the pressure is p + G lambda: p that of the whole film, G the inverse of its operator, lambda >= 0
!> what holds the ruptured cells at the cavitation pressure. As G >= 0, only cells with p < 0 can rupture. These
!> are found in the columns next to the trailing edge; their part of G comes from the chains of the grid's modes;
!> lambda is an active set over these few cells; and as G is symmetric, the force of G lambda is lambda times
!> G w, with w the weights of the pressure in the force.
module slight_rupture
   use kinds, only: wp
   use film_grid, only: film_grid_type
   use grid_modes, only: grid_modes_type
   use column_sweeps, only: green_chain, weighted, apply
   implicit none (type, external)
   private
   public :: force_of_few

   !> Most cells that count as few, and columns they may lie in.
   integer, parameter :: most_cells = 48, most_columns = 12
   integer, parameter :: max_rounds = 30
   !> What the chains carry: the pressure, and the weights of both forces.
   integer, parameter :: loads = 3

   !> A cell that may rupture.
   type :: candidate
      integer :: row, column
      !> Pressure of the whole film, Pa; G w for both forces.
      real(wp) :: pressure, influence(2)
   end type candidate

contains

   !> Force with rupture less force of the whole film, N, at the motion the grid has been set to. `few` is false
   !> where rupture is not slight enough: then nothing is said. `film` tells which cells are whole (1) or
   !> ruptured (0): those of the last motion on entry, of this one on return.
   pure subroutine force_of_few(grid, basis, film, force, few)
      type(film_grid_type), intent(in) :: grid
      type(grid_modes_type), intent(in) :: basis
      real(wp), intent(inout) :: film(:, :)
      real(wp), intent(out) :: force(2)
      logical, intent(out) :: few
      real(wp) :: load(loads, grid%columns), green(most_cells, most_cells), lambda(most_cells)
      !> Of the columns up to the last with a source > 0: the others have no pressure below that of the edges.
      real(wp), dimension(basis%m, last_source(grid)) :: per_pivot
      real(wp), dimension(basis%m, loads, last_source(grid)) :: x
      type(candidate) :: cells(most_cells)
      logical :: ruptured(most_cells)
      integer :: n, i
      force = 0
      load(1, :) = -grid%source
      load(2, :) = -grid%cell_weight()*grid%sin_cell
      load(3, :) = -grid%cell_weight()*grid%cos_cell
      call green_chain(basis%m, grid%columns, size(x, 3), grid%along, grid%beside, basis%eigenvalue, basis%uniform, &
         & basis%at_edge, load, -grid%edge_source, per_pivot, x)
      call find_cells(grid, basis, per_pivot, x, cells, n, few)
      if (.not. few) return
      call fill_green(grid, basis, per_pivot, cells(:n), green)
      do i = 1, n
         ruptured(i) = film(cells(i)%row, cells(i)%column) <= 0
      end do
      call hold(n, green, cells%pressure, ruptured, lambda, few)
      if (.not. few) return
      film(:grid%rows, :) = 1
      do i = 1, n
         if (.not. ruptured(i)) cycle
         film(cells(i)%row, cells(i)%column) = 0
         force = force + lambda(i)*cells(i)%influence
      end do
   end subroutine force_of_few

   !> The last column with a source > 0.
   pure integer function last_source(grid)
      type(film_grid_type), intent(in) :: grid
      last_source = findloc(grid%source > 0, .true., dim=1, back=.true.)
   end function last_source

   !> The cells with p < 0, column by column from the trailing edge; p is what `green_chain` leaves, solved on
   !> the way out. Where the film is under tension elsewhere too, or in too many cells, they are not few.
   pure subroutine find_cells(grid, basis, per_pivot, x, cells, n, few)
      type(film_grid_type), intent(in) :: grid
      type(grid_modes_type), intent(in) :: basis
      real(wp), intent(in) :: per_pivot(:, :)
      real(wp), intent(inout) :: x(:, :, :)
      type(candidate), intent(out) :: cells(most_cells)
      integer, intent(out) :: n
      logical, intent(out) :: few
      real(wp) :: p(basis%m)
      integer :: i, j, l, below, window
      n = 0
      window = 0
      few = .true.
      do i = 1, size(x, 3)
         if (i > 1) x(:, 1, i) = x(:, 1, i) + per_pivot(:, i)*grid%along(i - 1)*x(:, 1, i - 1)
         if (.not. grid%source(i) > 0) cycle
         p = apply(basis%m, grid%rows, basis%modes, x(:, 1, i))
         below = count(p(:grid%rows) < 0)
         if (below == 0) cycle
         few = window == i - 1 .and. i <= most_columns .and. n + below <= most_cells
         if (.not. few) return
         window = i
         do l = 2, loads
            if (i > 1) x(:, l, i) = x(:, l, i) + per_pivot(:, i)*grid%along(i - 1)*x(:, l, i - 1)
         end do
         do j = 1, grid%rows
            if (.not. p(j) < 0) cycle
            n = n + 1
            cells(n) = candidate(j, i, p(j), [weighted(basis%m, basis%transposed(:, j), x(:, 2, i)), &
               & weighted(basis%m, basis%transposed(:, j), x(:, 3, i))])
         end do
      end do
   end subroutine find_cells

   !> G between the cells, which are sorted by column: by mode G(i, i) = 1/R(i) + (along/R)^2 G(i-1, i-1) and
   !> G(i, j) = (along/R)(j) G(i, j-1), R the pivots from the leading edge.
   pure subroutine fill_green(grid, basis, per_pivot, cells, green)
      type(film_grid_type), intent(in) :: grid
      type(grid_modes_type), intent(in) :: basis
      real(wp), intent(in) :: per_pivot(:, :)
      type(candidate), intent(in) :: cells(:)
      real(wp), intent(inout) :: green(:, :)
      real(wp) :: own(basis%m), along(basis%m)
      integer :: a, b, i
      own = 0
      i = 0
      do a = 1, size(cells)
         do while (i < cells(a)%column)
            i = i + 1
            own = per_pivot(:, i) + merge((grid%along(i - 1)*per_pivot(:, i))**2*own, 0*own, i > 1)
         end do
         along = own*basis%transposed(:, cells(a)%row)
         green(a, a) = weighted(basis%m, along, basis%transposed(:, cells(a)%row))
         do b = a + 1, size(cells)
            if (cells(b)%column > cells(b - 1)%column) then
               along = along*grid%along(cells(b)%column - 1)*per_pivot(:, cells(b)%column)
            end if
            green(b, a) = weighted(basis%m, along, basis%transposed(:, cells(b)%row))
            green(a, b) = green(b, a)
         end do
      end do
   end subroutine fill_green

   !> The active set: lambda >= 0 on the ruptured cells, which have p + G lambda = 0; p + G lambda >= 0 on the
   !> others. `ok` is false where it is not found.
   pure subroutine hold(n, green, p, ruptured, lambda, ok)
      integer, intent(in) :: n
      real(wp), intent(in) :: green(:, :), p(:)
      logical, intent(inout) :: ruptured(:)
      real(wp), intent(out) :: lambda(:)
      logical, intent(out) :: ok
      real(wp) :: factor(n, n), y(n)
      integer :: active(n), k, round, i
      logical :: new(n)
      if (.not. any(ruptured(:n))) ruptured(:n) = .true.
      do round = 1, max_rounds
         k = count(ruptured(:n))
         active(:k) = pack([(i, i=1, n)], ruptured(:n))
         factor(:k, :k) = green(active(:k), active(:k))
         y(:k) = -p(active(:k))
         call solve_positive(k, factor, y)
         lambda(:n) = 0
         lambda(active(:k)) = y(:k)
         do i = 1, n
            new(i) = p(i) + dot_product(green(active(:k), i), y(:k)) < 0
         end do
         new(active(:k)) = y(:k) > 0
         ok = all(new .eqv. ruptured(:n))
         if (ok) return
         ruptured(:n) = new
      end do
   end subroutine hold

   !> b := a^(-1) b for the leading k x k part of a symmetric positive definite matrix, by Cholesky's factors.
   pure subroutine solve_positive(k, a, b)
      integer, intent(in) :: k
      real(wp), intent(inout) :: a(:, :), b(:)
      integer :: i, j
      do j = 1, k
         a(j, j) = sqrt(a(j, j) - dot_product(a(j, :j - 1), a(j, :j - 1)))
         do i = j + 1, k
            a(i, j) = (a(i, j) - dot_product(a(i, :j - 1), a(j, :j - 1)))/a(j, j)
         end do
         b(j) = (b(j) - dot_product(a(j, :j - 1), b(:j - 1)))/a(j, j)
      end do
      do j = k, 1, -1
         b(j) = (b(j) - dot_product(a(j + 1:k, j), b(j + 1:k)))/a(j, j)
      end do
   end subroutine solve_positive
end module slight_rupture
