!> Film with the Reynolds condition by elimination: the equations of over-relaxation, solved exactly
!> (volume_equations).
!>
!> Which cells are cavitated is found as an active set: cells below the cavitation pressure leave the film,
!> cavitated cells that would fill come back; for this kind of matrix that ends, after a few rounds from the
!> set of the last motion (Hintermueller, Ito, Kunisch, SIAM J. Optim. 13, 2002, theorem 3.2).
module elimination_film
   use kinds, only: wp
   use film_solver, only: film_motion, film_law_type, film_response, film_counters, film_not_converged
   use pad_gap, only: pad_gap_type
   use film_grid, only: film_grid_type, new_film_grid
   use volume_equations, only: volume_equations_type, new_volume_equations, boundary_conductance
   use local_cavitation, only: force_of_few
   use linear_algebra, only: apply
   use column_elimination, only: weighted
   implicit none (type, external)
   private
   public :: elimination_film_type, new_elimination_film

   !> Rounds at most, and those for each column: a film that reforms may grow by one column a round. One that begins
   !> whole grows by more in the first of them (update_film); it may then grow too far, which the others mend.
   integer, parameter :: max_rounds = 100, rounds_a_column = 2, rounds_of_growth = 4
   !> Pressure over the maximum below which a cell counts as empty: rounding must not decide.
   real(wp), parameter :: rounding = 1e-12_wp

   !> One pad's film.
   type, extends(volume_equations_type) :: elimination_film_type
      private
      !> Pressure, and the adjoints of both forces, (.., column, force): scaled, by rows in blocks and by
      !> modes outside.
      real(wp), allocatable :: pressure(:, :), adjoint(:, :, :)
      !> Whether slopes are those of a film that ends between cells (volume_equations); else those of these cells,
      !> exact.
      logical, public :: ends_between = .false.
   contains
      procedure :: evaluate
      procedure :: differentiate
      procedure :: over_speed
      procedure :: force_of_cavitation
      procedure :: field
      procedure :: cells
      procedure :: start_from
      procedure :: empty_columns
   end type elimination_film_type

contains

   !> The film of one pad on a grid with this number of cells along the arc and along half the width, the columns equal
   !> or between these angles (film_grid).
   function new_elimination_film(gap, columns, rows, angles) result(self)
      type(pad_gap_type), intent(in) :: gap
      integer, intent(in) :: columns, rows
      real(wp), intent(in), optional :: angles(0:)
      type(elimination_film_type) :: self
      self%volume_equations_type = new_volume_equations(new_film_grid(gap, columns, rows, angles))
      allocate (self%pressure(self%basis%m, columns), self%adjoint(self%basis%m, columns, 2), source=0.0_wp)
   end function new_elimination_film

   !> The film at a motion that leaves it open and a journal speed, rad/s, with the Reynolds condition or without
   !> cavitation. Counts the eliminations.
   subroutine evaluate(self, motion, oil, speed, cavitates, want_derivatives, counters, response)
      class(elimination_film_type), intent(inout) :: self
      type(film_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: speed
      logical, intent(in) :: cavitates, want_derivatives
      type(film_counters), intent(inout) :: counters
      type(film_response), intent(out) :: response
      integer :: round, same
      logical :: changed, whole
      same = 0
      associate (grid => self%grid)
         call grid%set_motion(motion, oil, speed)
         whole = all(self%film(:grid%rows, :) > 0)
         do round = 1, max(max_rounds, rounds_a_column*grid%columns)
            call self%eliminate(cavitates, same=same)
            call self%solve(-grid%source, -grid%edge_source, self%pressure)
            counters%passes = counters%passes + 1
            same = grid%columns
            if (cavitates) call update_film(self, whole .and. round <= rounds_of_growth, same)
            changed = same < grid%columns
            if (.not. changed) exit
         end do
         if (changed) response%status = film_not_converged
      end associate
      call sum_up(self, response)
      if (want_derivatives) call self%differentiate(response)
   end subroutine evaluate

   !> The derivatives of the last film's forces over position and velocity, by an adjoint for each.
   subroutine differentiate(self, response)
      class(elimination_film_type), intent(inout) :: self
      type(film_response), intent(inout) :: response
      real(wp) :: along(0:self%grid%columns), weight(self%grid%columns, 2)
      real(wp), dimension(self%grid%columns) :: across, total, none
      integer :: m
      if (self%ends_between .and. self%first <= self%grid%columns) call end_between(self)
      weight = self%grid%weight()
      none = 0
      do m = 1, 2
         call self%solve(weight(:, m), none, self%adjoint(:, :, m))
         call self%multiply(self%pressure, self%adjoint(:, :, m), along, across, total)
         response%derivatives(m, :) = self%grid%derivatives_of_products(along, across, total)
      end do
   end subroutine differentiate

   !> Pivots and blocks for changes of the pressure in a film that ends between its cells.
   pure subroutine end_between(self)
      type(elimination_film_type), intent(inout) :: self
      real(wp) :: p(self%grid%rows, self%grid%columns)
      integer :: i, first, last
      first = self%first
      last = self%last
      p = 0
      do i = max(1, first - 1), min(self%grid%columns, last + 1)
         ! the columns beside those that cavitate touches become blocks, too
         if (i < first .or. i > last) self%pressure(:, i) = self%in_rows(self%pressure, i)
         p(:, i) = self%pressure(:self%grid%rows, i)/self%basis%root(:self%grid%rows)
      end do
      call self%eliminate(.true., boundary_conductance(self%grid, self%film, p, first, last))
   end subroutine end_between

   !> Derivatives of both forces over the journal speed, N s, once they have been found over the motion.
   pure function over_speed(self) result(slopes)
      class(elimination_film_type), intent(in) :: self
      real(wp) :: slopes(2), total(self%grid%columns)
      integer :: i, m
      associate (grid => self%grid, n => self%grid%columns, gap => self%grid%gap)
         do m = 1, 2
            do i = 1, n
               associate (weight => merge(self%basis%root, self%basis%uniform, i >= self%first .and. i <= self%last))
                  total(i) = weighted(self%basis%m, weight, self%adjoint(:, i, m))
               end associate
            end do
            slopes(m) = -0.5_wp*grid%squeeze*gap%journal_radius/gap%pad_radius()*dot_product(total/grid%d_phi, &
               & grid%sliding_face(1:n)*grid%h_face(1:n) - grid%sliding_face(0:n - 1)*grid%h_face(0:n - 1))
         end do
      end associate
   end function over_speed

   !> How many columns from the trailing edge on the last film, with the Reynolds condition, has left.
   pure integer function empty_columns(self) result(n)
      class(elimination_film_type), intent(in) :: self
      do n = 0, self%grid%columns - 1
         if (any(self%film(:self%grid%rows, n + 1) > 0)) return
      end do
   end function empty_columns

   !> Lets the next film start as a whole one, or from the cells in which that on a grid of half as many columns and
   !> rows has cavitated.
   pure subroutine start_from(self, coarse)
      class(elimination_film_type), intent(inout) :: self
      type(elimination_film_type), intent(in), optional :: coarse
      integer :: i, k
      self%film(:self%grid%rows, :) = 1
      if (.not. present(coarse)) return
      do i = 1, self%grid%columns
         do k = 1, self%grid%rows
            self%film(k, i) = coarse%film((k + 1)/2, (i + 1)/2)
         end do
      end do
   end subroutine start_from

   !> Pressure, Pa, (axial position, angle), at a motion that leaves the film open and a journal speed, rad/s, with the
   !> Reynolds condition or without cavitation.
   subroutine field(self, motion, oil, speed, cavitates, phi, z, pressure)
      class(elimination_film_type), intent(inout) :: self
      type(film_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: speed
      logical, intent(in) :: cavitates
      !> Angles from the pivot, rad, and distances from the middle plane, m, within the pad.
      real(wp), intent(in) :: phi(:), z(:)
      real(wp), intent(out) :: pressure(:, :)
      type(film_counters) :: counters
      type(film_response) :: response
      type(film_grid_type) :: grid
      real(wp), allocatable :: p(:, :), film(:, :)
      call self%evaluate(motion, oil, speed, cavitates, .false., counters, response)
      call self%cells(grid, p, film)
      pressure = grid%pressure_at(p, cavitates, phi, z)
   end subroutine field

   !> Grid of the last film, its pressure above that of cavitation, Pa, (row, column), and its cells, the others 0.
   pure subroutine cells(self, grid, pressure, film)
      class(elimination_film_type), intent(in) :: self
      type(film_grid_type), intent(out) :: grid
      real(wp), allocatable, intent(out) :: pressure(:, :), film(:, :)
      integer :: i
      grid = self%grid
      allocate (pressure, mold=self%pressure)
      pressure = 0
      do i = 1, grid%columns
         pressure(:, i) = self%in_rows(self%pressure, i)
         pressure(:grid%rows, i) = pressure(:grid%rows, i)/self%basis%root(:grid%rows)
      end do
      film = self%film
   end subroutine cells

   !> Force with the Reynolds condition less force without cavitation, N, where only a few cells cavitate; else
   !> `is_local` is false, and `evaluate` has to be asked.
   subroutine force_of_cavitation(self, motion, oil, speed, counters, force, is_local)
      class(elimination_film_type), intent(inout) :: self
      type(film_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: speed
      type(film_counters), intent(inout) :: counters
      real(wp), intent(out) :: force(2)
      logical, intent(out) :: is_local
      call self%grid%set_motion(motion, oil, speed)
      call force_of_few(self%grid, self%basis, self%film, force, is_local)
      counters%passes = counters%passes + 1
   end subroutine force_of_cavitation

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
               middle(i) = max(0.0_wp, weighted(m, self%basis%middle_rows, p(:, i)))
            else
               sums(i) = weighted(m, self%basis%uniform, p(:, i))
               middle(i) = weighted(m, self%basis%middle_modes, p(:, i))
            end if
         end do
         response%force = grid%force(sums)
         response%min_pressure = grid%gap%cavitation_pressure + min(minval(middle), grid%ambient, grid%supply)
         response%max_pressure = grid%gap%cavitation_pressure + grid%highest(middle)
      end associate
   end subroutine sum_up

   !> Takes cells below the cavitation pressure out of the film, and puts those back that would fill. A film
   !> whose pressure falls below that at its edges does so in a column with a source > 0; so the other whole
   !> columns need no look. `grows_far`: what flows into a cell beyond what fills it is handed on to the next column,
   !> away from the film, as a flow changes little along the short way to where the film ends. `same`: number of columns
   !> from the first on that keep their cells.
   pure subroutine update_film(self, grows_far, same)
      type(elimination_film_type), intent(inout) :: self
      logical, intent(in) :: grows_far
      integer, intent(out) :: same
      !> Pressure by rows, scaled, with a rim; on a fine grid too much for the stack.
      real(wp), allocatable :: p(:, :)
      real(wp) :: floor, inflow, limit, new, changes, surplus(self%basis%m)
      integer :: i, k, m, ends(2)
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
         same = grid%columns
         surplus = 0
         ! a film that diverges at the trailing edge ends there
         ends = merge([grid%columns, 1], [1, grid%columns], grid%source(1) > 0)
         do i = ends(1), ends(2), sign(1, ends(2) - ends(1))
            if (.not. grid%source(i) > 0 .and. (i < first - 1 .or. i > last + 1)) cycle
            limit = -floor*(grid%along(i - 1) + grid%along(i) + 2*grid%beside(i))
            changes = 0
            !$omp simd private(inflow, new) reduction(+:changes)
            do k = 1, rows
               inflow = grid%along(i - 1)*p(k, i - 1) + grid%along(i)*p(k, i + 1) &
                  & - grid%beside(i)*(across(k - 1)*p(k - 1, i) + across(k)*p(k + 1, i)) &
                  & - root(k)*(grid%source(i) + merge(grid%edge_source(i), 0.0_wp, k == rows)) + surplus(k)
               new = merge(1.0_wp, 0.0_wp, merge(p(k, i) >= floor, inflow > limit, self%film(k, i) > 0))
               surplus(k) = merge(inflow, 0.0_wp, grows_far .and. new > self%film(k, i))
               changes = changes + abs(new - self%film(k, i))
               self%film(k, i) = new
            end do
            if (changes > 0) same = min(same, i - 1)
         end do
      end associate
   end subroutine update_film

end module elimination_film
