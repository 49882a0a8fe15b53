!> Film with the Reynolds condition by elimination: the equations of over-relaxation, solved exactly.
!>
!> Where a column of cells is whole, the axial part of its equations is the same matrix for every column, up
!> to a factor; its eigenvectors ("modes" of the grid) turn the columns into independent chains of single
!> equations. Only between the first and the last column that rupture touches are whole blocks eliminated.
!> Which cells are ruptured is found as an active set: cells below the cavitation pressure leave the film,
!> ruptured cells that would fill come back; for this kind of matrix that ends, after a few rounds from the
!> set of the last motion (Hintermueller, Ito, Kunisch, SIAM J. Optim. 13, 2002, theorem 3.2).
module elimination_film
   use kinds, only: wp
   use film_solver, only: film_motion, film_response, film_counters, film_closed, film_not_converged
   use pad_gap, only: pad_gap_type
   use film_grid, only: film_grid_type, new_film_grid
   use grid_modes, only: grid_modes_type, new_grid_modes
   use film_rim, only: rim_conductance
   use slight_rupture, only: force_of_few
   use column_sweeps, only: factor_chain, solve_chain, finish_chain, weighted, apply, invert
   implicit none (type, external)
   private
   public :: elimination_film_type, new_elimination_film

   !> Rounds at most, and those for each column: a film that forms again may grow by one column a round.
   integer, parameter :: max_rounds = 100, rounds_a_column = 2
   !> Pressure over the maximum below which a cell counts as empty: rounding must not decide.
   real(wp), parameter :: rounding = 1e-12_wp

   !> One pad's film.
   type :: elimination_film_type
      private
      type(film_grid_type), public :: grid
      type(grid_modes_type) :: basis
      !> Cells that belong to the film: 1, the others 0 (row, column).
      real(wp), allocatable :: film(:, :)
      !> Columns that rupture touches: first to last; none: first = columns + 1.
      integer :: first, last
      !> Reciprocal pivots outside them (mode, column); inverse blocks inside (row, row, column).
      real(wp), allocatable :: per_pivot(:, :), block(:, :, :)
      !> Scaled (grid_modes), by rows in blocks and by modes outside.
      real(wp), allocatable :: pressure(:, :), adjoint(:, :)
      !> Whether slopes are those of a film that ends between cells (film_rim); else those of these cells, exact.
      logical, public :: ends_between = .false.
   contains
      procedure :: evaluate
      procedure :: force_of_rupture
      procedure :: field
      procedure :: cells
      procedure :: start_from
      procedure :: empty_columns
   end type elimination_film_type

contains

   !> The film of one pad on a grid of so many cells along the arc and along half the width, the columns equal or
   !> between these angles (film_grid).
   function new_elimination_film(gap, columns, rows, angles) result(self)
      type(pad_gap_type), intent(in) :: gap
      integer, intent(in) :: columns, rows
      real(wp), intent(in), optional :: angles(0:)
      type(elimination_film_type) :: self
      integer :: n
      self%grid = new_film_grid(gap, columns, rows, angles)
      self%basis = new_grid_modes(self%grid)
      n = self%basis%m
      allocate (self%film(n, columns), self%pressure(n, columns), self%adjoint(n, columns), source=0.0_wp)
      call self%start_from()
      allocate (self%per_pivot(n, columns), self%block(n, rows, columns), source=0.0_wp)
   end function new_elimination_film

   !> The film at a motion and a journal speed, rad/s, with the Reynolds condition or without rupture.
   !> Counts a pad and the eliminations.
   subroutine evaluate(self, motion, speed, ruptures, want_derivatives, counters, response)
      class(elimination_film_type), intent(inout) :: self
      type(film_motion), intent(in) :: motion
      real(wp), intent(in) :: speed
      logical, intent(in) :: ruptures, want_derivatives
      type(film_counters), intent(inout) :: counters
      type(film_response), intent(out) :: response
      real(wp) :: weight(self%grid%columns, 2)
      integer :: m, round
      logical :: changed
      associate (grid => self%grid)
         response%min_film_thickness = grid%gap%min_film_thickness(motion, grid%directions)
         if (.not. response%min_film_thickness > 0) then
            response%status = film_closed
            return
         end if
         call grid%set_motion(motion, speed)
         do round = 1, max(max_rounds, rounds_a_column*grid%columns)
            call eliminate(self, ruptures)
            call solve(self, -grid%source, -grid%edge_source, self%pressure)
            counters%passes = counters%passes + 1
            changed = .false.
            if (ruptures) call update_film(self, changed)
            if (.not. changed) exit
         end do
         if (changed) response%status = film_not_converged
         call sum_up(self, response)
         if (want_derivatives) then
            call to_rows(self, self%pressure)
            if (self%ends_between .and. self%first <= grid%columns) call eliminate(self, ruptures, &
               & rim_conductance(grid, self%film, self%pressure))
            weight = grid%weight()
            do m = 1, 2
               call solve(self, weight(:, m), 0*weight(:, m), self%adjoint)
               call to_rows(self, self%adjoint)
               response%derivatives(m, :) = grid%derivatives(speed, self%pressure, self%adjoint)
            end do
         end if
      end associate
   end subroutine evaluate

   !> How many columns from the trailing edge on the last film, with the Reynolds condition, has left.
   pure integer function empty_columns(self) result(n)
      class(elimination_film_type), intent(in) :: self
      do n = 0, self%grid%columns - 1
         if (any(self%film(:self%grid%rows, n + 1) > 0)) return
      end do
   end function empty_columns

   !> Lets the next film start as a whole one, or from the cells in which that on a grid of half as many columns and
   !> rows has ruptured.
   pure subroutine start_from(self, coarse)
      class(elimination_film_type), intent(inout) :: self
      type(elimination_film_type), intent(in), optional :: coarse
      integer :: i, k
      self%film(:self%grid%rows, :) = 1
      if (.not. present(coarse)) return
      do i = 1, self%grid%columns
         self%film(:self%grid%rows, i) = coarse%film([((k + 1)/2, k=1, self%grid%rows)], (i + 1)/2)
      end do
   end subroutine start_from

   !> Pressure, Pa, (axial position, angle), at a motion that leaves the film open and a journal speed, rad/s, with the
   !> Reynolds condition or without rupture.
   subroutine field(self, motion, speed, ruptures, phi, z, pressure)
      class(elimination_film_type), intent(inout) :: self
      type(film_motion), intent(in) :: motion
      real(wp), intent(in) :: speed
      logical, intent(in) :: ruptures
      !> Angles from the pivot, rad, and distances from the middle plane, m, within the pad.
      real(wp), intent(in) :: phi(:), z(:)
      real(wp), intent(out) :: pressure(:, :)
      type(film_counters) :: counters
      type(film_response) :: response
      type(film_grid_type) :: grid
      real(wp), allocatable :: p(:, :), film(:, :)
      call self%evaluate(motion, speed, ruptures, .false., counters, response)
      call self%cells(grid, p, film)
      pressure = grid%pressure_at(p, ruptures, phi, z)
   end subroutine field

   !> Grid of the last film, its pressure above that of cavitation, Pa, (row, column), and its cells, the others 0.
   pure subroutine cells(self, grid, pressure, film)
      class(elimination_film_type), intent(in) :: self
      type(film_grid_type), intent(out) :: grid
      real(wp), allocatable, intent(out) :: pressure(:, :), film(:, :)
      grid = self%grid
      pressure = self%pressure
      call to_rows(self, pressure)
      film = self%film
   end subroutine cells

   !> Force with the Reynolds condition less force without rupture, N, where only a few cells rupture; else
   !> `few` is false, and `evaluate` has to be asked.
   subroutine force_of_rupture(self, motion, speed, counters, force, few)
      class(elimination_film_type), intent(inout) :: self
      type(film_motion), intent(in) :: motion
      real(wp), intent(in) :: speed
      type(film_counters), intent(inout) :: counters
      real(wp), intent(out) :: force(2)
      logical, intent(out) :: few
      call self%grid%set_motion(motion, speed)
      call force_of_few(self%grid, self%basis, self%film, force, few)
      counters%passes = counters%passes + 1
   end subroutine force_of_rupture

   !> Force; minimum and maximum pressure in the middle plane and at the edges.
   pure subroutine sum_up(self, response)
      type(elimination_film_type), intent(in) :: self
      type(film_response), intent(inout) :: response
      real(wp), dimension(self%grid%columns) :: sums, middle
      integer :: i, m
      m = self%basis%m
      associate (grid => self%grid, p => self%pressure)
         do i = 1, grid%columns
            if (i >= self%first .and. i <= self%last) then
               sums(i) = weighted(m, self%basis%root, p(:, i))
               middle(i) = p(1, i)
            else
               sums(i) = weighted(m, self%basis%uniform, p(:, i))
               middle(i) = weighted(m, self%basis%transposed(:, 1), p(:, i))
            end if
         end do
         middle = middle/self%basis%root(1)
         response%force = grid%force(sums)
         response%min_pressure = grid%gap%cavitation_pressure + min(minval(middle), grid%ambient, grid%supply)
         response%max_pressure = grid%gap%cavitation_pressure + max(maxval(middle), grid%ambient, grid%supply)
      end associate
   end subroutine sum_up

   !> Takes cells below the cavitation pressure out of the film, and puts those back that would fill. A film
   !> whose pressure falls below that at its edges does so in a column with a source > 0; so the other whole
   !> columns need no look.
   pure subroutine update_film(self, changed)
      type(elimination_film_type), intent(inout) :: self
      logical, intent(out) :: changed
      !> Pressure by rows, scaled, with a rim; on a fine grid too much for the stack.
      real(wp), allocatable :: p(:, :)
      real(wp) :: floor, inflow, limit, new, changes
      integer :: i, k, m
      m = self%basis%m
      allocate (p(0:m + 1, 0:self%grid%columns + 1))
      associate (grid => self%grid, rows => self%grid%rows, first => self%first, last => self%last, &
         & across => self%basis%off_diagonal, root => self%basis%root)
         floor = 0
         p(:, [0, grid%columns + 1]) = 0
         do i = 1, grid%columns
            if (i >= first .and. i <= last) then
               p(1:m, i) = self%pressure(:, i)
            else if (grid%source(i) > 0 .or. i == first - 1 .or. i == last + 1) then
               p(1:m, i) = apply(m, rows, self%basis%modes, self%pressure(:, i))
            else
               p(1:m, i) = 0
            end if
            p(0, i) = 0
            p(rows + 1, i) = 0
            floor = max(floor, p(1, i))
         end do
         floor = -rounding*floor
         changes = 0
         do i = 1, grid%columns
            limit = -floor*(grid%along(i - 1) + grid%along(i) + 2*grid%beside(i))
            !$omp simd private(inflow, new) reduction(+:changes)
            do k = 1, rows
               inflow = grid%along(i - 1)*p(k, i - 1) + grid%along(i)*p(k, i + 1) &
                  & - grid%beside(i)*(across(k - 1)*p(k - 1, i) + across(k)*p(k + 1, i)) &
                  & - root(k)*(grid%source(i) + merge(grid%edge_source(i), 0.0_wp, k == rows))
               new = merge(1.0_wp, 0.0_wp, merge(p(k, i) >= floor, inflow > limit, self%film(k, i) > 0))
               changes = changes + abs(new - self%film(k, i))
               self%film(k, i) = new
            end do
         end do
         changed = changes > 0
      end associate
   end subroutine update_film

   !> Turns the columns outside first to last from modes to rows, and all to what is not scaled.
   pure subroutine to_rows(self, x)
      type(elimination_film_type), intent(in) :: self
      real(wp), intent(inout), contiguous :: x(:, :)
      integer :: i
      do i = 1, self%grid%columns
         if (i < self%first .or. i > self%last) x(:, i) = apply(size(x, 1), self%grid%rows, self%basis%modes, x(:, i))
         x(:self%grid%rows, i) = x(:self%grid%rows, i)/self%basis%root(:self%grid%rows)
      end do
   end subroutine to_rows

   !> Pivots and blocks: whole columns from both edges of the pad inwards, mode by mode, then the columns
   !> between, from the first to the last; none of these where the film does not rupture.
   pure subroutine eliminate(self, ruptures, more)
      type(elimination_film_type), intent(inout) :: self
      logical, intent(in) :: ruptures
      !> Added to the diagonal beside ruptured cells, (row, column).
      real(wp), intent(in), optional :: more(:, :)
      logical :: touched(self%grid%columns)
      integer :: i, j, m
      m = self%basis%m
      associate (grid => self%grid, c => self%grid%along, n => self%grid%columns, rows => self%grid%rows)
         self%first = n + 1
         self%last = n
         if (ruptures) then
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

   !> The scaled solution, by rows from the first to the last column that rupture touches, by modes outside, for
   !> a load per column in every row of the film, and one more in its edge row.
   pure subroutine solve(self, load, edge_load, x)
      type(elimination_film_type), intent(in) :: self
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
end module elimination_film
