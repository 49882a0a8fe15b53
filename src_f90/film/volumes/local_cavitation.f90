!> What the cavitation of a few cells at the trailing edge does to the force, by Green's functions of the full film.
!>
!> With cavitation the pressure is p + G lambda: p that of the full film, G the inverse of its operator, lambda >= 0
!> what holds the cavitated cells at the cavitation pressure. As G >= 0, only cells with p < 0 can cavitate. These
!> are found in the columns next to the trailing edge; their part of G comes from the chains of the grid's modes;
!> lambda is an active set over these few cells; and as G is symmetric, the force of G lambda is lambda times
!> G w, with w the weights of the pressure in the force.
module local_cavitation
   use kinds, only: wp
   use film_grid, only: film_grid_type
   use volume_equations, only: grid_modes_type
   use linear_algebra, only: apply
   use column_elimination, only: green_chain, weighted
   implicit none (type, external)
   private
   public :: force_of_few

   !> Most cells that count as few: under tension, cavitated; and columns they may lie in.
   integer, parameter :: most_cells = 128, most_cavitated = 48, most_columns = 16
   integer, parameter :: max_rounds = 30
   !> What the chains carry: the pressure, and the weights of both forces.
   integer, parameter :: loads = 3

   !> A cell that may cavitate.
   type :: candidate
      integer :: row, column
      !> Pressure of the full film, Pa, scaled (volume_equations); G w for both forces.
      real(wp) :: pressure, influence(2)
   end type candidate

contains

   !> Force with cavitation less force of the full film, N, at the motion the grid has been set to. `is_local` is false
   !> where cavitation is not slight enough: then nothing is said. `film` tells which cells are whole (1) or
   !> cavitated (0): those of the last motion on entry, of this one on return.
   pure subroutine force_of_few(grid, basis, film, force, is_local)
      type(film_grid_type), intent(in) :: grid
      type(grid_modes_type), intent(in) :: basis
      real(wp), intent(inout) :: film(:, :)
      real(wp), intent(out) :: force(2)
      logical, intent(out) :: is_local
      real(wp) :: load(loads, grid%columns)
      !> Of the columns up to the last with a source > 0: the others have no pressure below that of the edges.
      real(wp), dimension(basis%m, last_source(grid)) :: per_pivot
      real(wp), dimension(basis%m, loads, last_source(grid)) :: x
      type(candidate) :: cells(most_cells)
      real(wp) :: lambda(most_cavitated), after(most_cells)
      integer :: held(most_cavitated)
      logical :: cavitated(most_cells), new(most_cells)
      integer :: n, k, i, round
      force = 0
      load(1, :) = -grid%source
      load(2:, :) = -transpose(grid%weight())
      call green_chain(basis%m, grid%columns, size(x, 3), grid%along, grid%beside, basis%eigenvalue, basis%uniform, &
         & basis%at_edge, load, -grid%edge_source, per_pivot, x)
      call find_cells(grid, basis, per_pivot, x, cells, n, is_local)
      if (.not. is_local .or. n == 0) return
      do i = 1, n
         cavitated(i) = film(cells(i)%row, cells(i)%column) <= 0
      end do
      ! the active set: lambda > 0 on the cavitated cells, p + G lambda >= 0 on the others
      do round = 1, max_rounds
         k = count(cavitated(:n))
         is_local = k <= most_cavitated
         if (.not. is_local) return
         held(:k) = pack([(i, i=1, n)], cavitated(:n))
         call hold(grid, basis, per_pivot, cells(held(:k)), lambda)
         call pressure_after(grid, basis, per_pivot, cells(held(:k)), lambda, cells(:n), cavitated(:n), after)
         new(:n) = after(:n) < 0
         new(held(:k)) = lambda(:k) > 0
         is_local = all(new(:n) .eqv. cavitated(:n))
         if (is_local) exit
         cavitated(:n) = new(:n)
      end do
      if (.not. is_local) return
      film(:grid%rows, :) = 1
      do i = 1, k
         film(cells(held(i))%row, cells(held(i))%column) = 0
         force = force + lambda(i)*cells(held(i))%influence
      end do
   end subroutine force_of_few

   !> The last column with a source > 0.
   pure integer function last_source(grid)
      type(film_grid_type), intent(in) :: grid
      last_source = findloc(grid%source > 0, .true., dim=1, back=.true.)
   end function last_source

   !> The cells with p < 0, column by column from the trailing edge; p is what `green_chain` leaves, solved on
   !> the way out. Where the film is under tension elsewhere too, or in too many cells, they are not few.
   pure subroutine find_cells(grid, basis, per_pivot, x, cells, n, is_local)
      type(film_grid_type), intent(in) :: grid
      type(grid_modes_type), intent(in) :: basis
      real(wp), intent(in) :: per_pivot(:, :)
      real(wp), intent(inout) :: x(:, :, :)
      type(candidate), intent(out) :: cells(most_cells)
      integer, intent(out) :: n
      logical, intent(out) :: is_local
      real(wp) :: p(basis%m)
      integer :: i, j, l, below, window
      n = 0
      window = 0
      is_local = .true.
      do i = 1, size(x, 3)
         if (i > 1) x(:, 1, i) = x(:, 1, i) + per_pivot(:, i)*grid%along(i - 1)*x(:, 1, i - 1)
         if (.not. grid%source(i) > 0) cycle
         p = apply(basis%m, grid%rows, basis%modes, x(:, 1, i))
         below = count(p(:grid%rows) < 0)
         if (below == 0) cycle
         is_local = window == i - 1 .and. i <= most_columns .and. n + below <= most_cells
         if (.not. is_local) return
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

   !> lambda that holds cells, sorted by column, at p + G lambda = 0. By mode G(i, i) = 1/R(i) + (along/R)^2
   !> G(i-1, i-1) and G(i, j) = (along/R)(j) G(i, j-1), R the pivots from the leading edge.
   pure subroutine hold(grid, basis, per_pivot, cells, lambda)
      type(film_grid_type), intent(in) :: grid
      type(grid_modes_type), intent(in) :: basis
      real(wp), intent(in) :: per_pivot(:, :)
      type(candidate), intent(in) :: cells(:)
      real(wp), intent(inout) :: lambda(:)
      real(wp) :: green(size(cells), size(cells)), own(basis%m), along(basis%m)
      integer :: a, b, i
      own = 0
      i = 0
      do a = 1, size(cells)
         do while (i < cells(a)%column)
            i = i + 1
            own = per_pivot(:, i) + (grid%along(i - 1)*per_pivot(:, i))**2*own
         end do
         along = own*basis%transposed(:, cells(a)%row)
         green(a, a) = weighted(basis%m, along, basis%transposed(:, cells(a)%row))
         do b = a + 1, size(cells)
            do i = cells(b - 1)%column + 1, cells(b)%column
               along = along*grid%along(i - 1)*per_pivot(:, i)
            end do
            green(b, a) = weighted(basis%m, along, basis%transposed(:, cells(b)%row))
         end do
         i = cells(a)%column
      end do
      lambda(:size(cells)) = -cells%pressure
      call solve_positive(size(cells), green, lambda)
   end subroutine hold

   !> p + G lambda at the candidates that are not held, with lambda at the held ones: in along their columns
   !> and out again.
   pure subroutine pressure_after(grid, basis, per_pivot, held, lambda, cells, cavitated, after)
      type(film_grid_type), intent(in) :: grid
      type(grid_modes_type), intent(in) :: basis
      real(wp), intent(in) :: per_pivot(:, :), lambda(:)
      type(candidate), intent(in) :: held(:), cells(:)
      logical, intent(in) :: cavitated(:)
      real(wp), intent(inout) :: after(:)
      real(wp) :: y(basis%m, most_columns)
      integer :: i, k, last
      last = cells(size(cells))%column
      y(:, :last) = 0
      do k = 1, size(held)
         y(:, held(k)%column) = y(:, held(k)%column) + lambda(k)*basis%transposed(:, held(k)%row)
      end do
      do i = last, 1, -1
         if (i < last) y(:, i) = y(:, i) + grid%along(i)*y(:, i + 1)
         y(:, i) = per_pivot(:, i)*y(:, i)
      end do
      do i = 2, last
         y(:, i) = y(:, i) + grid%along(i - 1)*per_pivot(:, i)*y(:, i - 1)
      end do
      do k = 1, size(cells)
         after(k) = 0
         if (.not. cavitated(k)) after(k) = cells(k)%pressure &
            & + weighted(basis%m, basis%transposed(:, cells(k)%row), y(:, cells(k)%column))
      end do
   end subroutine pressure_after

   !> b := a^(-1) b for a symmetric positive definite k x k matrix, given below its diagonal: a = L D L'.
   pure subroutine solve_positive(k, a, b)
      integer, intent(in) :: k
      real(wp), intent(inout) :: a(k, k), b(k)
      real(wp) :: factor
      integer :: i, j, l
      do j = 1, k
         a(j, j) = 1/a(j, j)
         do i = j + 1, k
            factor = a(i, j)*a(j, j)
            !$omp simd
            do l = i, k
               a(l, i) = a(l, i) - factor*a(l, j)
            end do
            b(i) = b(i) - factor*b(j)
         end do
      end do
      do j = k, 1, -1
         do l = j + 1, k
            b(j) = b(j) - a(l, j)*b(l)
         end do
         b(j) = b(j)*a(j, j)
      end do
   end subroutine solve_positive
end module local_cavitation
