!> The full film of a dimensionless pad, solved or from a table: force = S M w, with a symmetric M of three functions of
!> the film thicknesses at both edges (docs/theory/film.md, *The table*); the highest pressure, over S, of the film that
!> is just full, a fourth; the force of a pressure 1 at the leading edge; and, over S, that of the rotation's own drive
!> (rotation_drive).
!>
!> `full_film_type` solves all of these where they are asked for, the forces with exact derivatives. The table has them
!> over half an octave of either thickness: they are analytic, so one polynomial stands for each; where it does not,
!> next to a film that closes, a cell is cut in four. Polynomials go through values at the faces of their cells, too, so
!> that the force is continuous from cell to cell of one size. What is in a cell does not depend on what came before.
module full_film
   use kinds, only: wp
   use clock, only: wall_clock
   use film_solver, only: film_motion, film_response, film_counters, film_ok
   use dimensionless_pad, only: dimensionless_pad_type, thickness_scale
   use fourier_film, only: fourier_film_type, converged_film
   use rotation_drive, only: rotation_drive_type
   use cell_polynomials, only: nodes, simd_width, node_points, fitted, evaluate_patch, patch_values
   use cell_index, only: cell_index_type, cell_key, interval, lower_end
   use pressure_profile, only: pressure_profile_type, new_pressure_profile, profile_nodes => nodes
   implicit none (type, external)
   private
   public :: full_film_type, full_film_forces, full_film_table_type, new_full_film, new_full_film_table

   !> Error of what is solved over the tolerance.
   real(wp), parameter :: share_of_nodes = 0.3_wp

   !> Functions of the thicknesses at both edges, and their derivatives over these, (function, edge).
   type :: full_film_forces
      !> M_11, M_12, M_22 and the highest pressure at w = (1, tan(half the arc)), all over S.
      real(wp) :: of_velocity(simd_width), velocity_slopes(simd_width, 2)
      !> Where there is a pressure at the leading edge, the force (along, outward, 0, 0) of a pressure 1 there.
      real(wp) :: of_supply(simd_width), supply_slopes(simd_width, 2)
      !> Where the rotation acts, the force of D at t = 1, over S.
      real(wp) :: of_rotation(simd_width), rotation_slopes(simd_width, 2)
   end type full_film_forces

   type :: full_film_type
      type(dimensionless_pad_type) :: pad
      type(rotation_drive_type) :: drive
      !> Whether there is a pressure at the leading edge.
      logical :: supplied = .false.
      !> Without pressure around the pad, and, where there is one, with a pressure 1 at its leading edge.
      type(fourier_film_type) :: film, supplied_film
   contains
      procedure :: look_up
      procedure :: highest_pressure
   end type full_film_type

   !> Levels of cells that are not cut and of the smallest.
   integer, parameter :: first_level = 1, last_level = 6
   !> Where a new cell is checked, between its nodes: near its corners and in its middle.
   real(wp), parameter :: off = 0.92_wp, checks(2, 5) = reshape([-off, -off, off, -off, -off, off, off, off, 0.0_wp, &
      & 0.0_wp], [2, 5])
   !> Cells that are built at the first visit, in all: some 10 ms. Beyond, a cell is built once the films solved in it
   !> have cost as much as building does, so that both together cost at most twice the cheaper of them, in a cell that
   !> need not be cut ("ski rental": Karlin, Manasse, Rudolph, Sleator, Algorithmica 3, 1988). A visit solves a film at
   !> two velocities, with derivatives that cost as much again.
   integer, parameter :: built_at_once = 32, visits_of_cell = nodes**2/2
   !> The same for profiles of the pressure: films solved for one, of which each costs as much as a pressure solved.
   integer, parameter :: visits_of_profile = 2*profile_nodes**2

   !> Thicknesses in a cell are `middle + s/per_half`, -1 <= s <= 1 along either axis.
   type :: cell_type
      real(wp) :: lower(2) = 0, upper(2) = 0, middle(2) = 0, per_half(2) = 0
      !> Films, and pressures, that have been asked for in it.
      integer :: visits = 0, pressures = 0
      !> Whether it has been tried to build it; its functions are as close as they should be; it is cut in four.
      logical :: tried = .false., good = .false., cut = .false.
      !> Of the functions of full_film_forces; of those that there are.
      real(wp) :: of_velocity(simd_width, nodes, nodes) = 0
      real(wp), allocatable :: of_supply(:, :, :), of_rotation(:, :, :)
      !> Built when pressures are often asked for.
      type(pressure_profile_type), allocatable :: profile
   end type cell_type

   type, extends(full_film_type) :: full_film_table_type
      private
      !> Error of M over its norm.
      real(wp) :: tolerance
      type(cell_index_type) :: index
      type(cell_type), allocatable :: cells(:)
      !> Most cells: when they are used up all are forgotten.
      integer :: most
      !> Cells that have been built; whether all are at their first visit.
      integer :: built = 0
      logical :: filled = .false.
   contains
      procedure :: look_up => look_up_in_table
      procedure :: highest_pressure => highest_in_table
      procedure, private :: find_cell
      procedure, private :: build
   end type full_film_table_type

contains

   !> The full films of a pad with its drive, with a pressure at its leading edge (where the law does not vary) or
   !> without, to a tolerance over the norm of M.
   function new_full_film(pad, drive, supplied, tolerance) result(films)
      type(dimensionless_pad_type), intent(in) :: pad
      type(rotation_drive_type), intent(in) :: drive
      logical, intent(in) :: supplied
      real(wp), intent(in) :: tolerance
      type(full_film_type) :: films
      films%pad = pad
      films%drive = drive
      films%supplied = supplied
      films%film = converged_film(drive%gap, .false., share_of_nodes*tolerance)
      if (supplied) films%supplied_film = converged_film(pad%gap(1.0_wp), .false., share_of_nodes*tolerance)
   end function new_full_film

   !> The forces of an open film with these thicknesses at its edges, with derivatives if they are wanted. `last` is the
   !> caller's memory of the place in a table, 0 at first. `good` is false where the film has no solution.
   subroutine look_up(self, edges, want_slopes, last, counters, forces, good)
      class(full_film_type), intent(inout) :: self
      real(wp), intent(in) :: edges(2)
      logical, intent(in) :: want_slopes
      integer, intent(inout) :: last
      type(film_counters), intent(inout) :: counters
      type(full_film_forces), intent(out) :: forces
      logical, intent(out) :: good
      type(film_response) :: along, onset, still
      integer :: i
      associate (pad => self%pad, position => self%pad%position(edges), drive => self%drive, &
         & scale => self%drive%force_unit*thickness_scale(edges(1), edges(2)))
         call self%film%evaluate_pad(1, film_motion(position, [1.0_wp, 0.0_wp]), drive%oil, 0.0_wp, want_slopes, along)
         call self%film%evaluate_pad(1, film_motion(position, [1.0_wp, pad%tangent]), drive%oil, 0.0_wp, want_slopes, &
            & onset)
         good = along%status == film_ok
         forces%of_velocity = symmetric(along%force, (onset%force - along%force)/pad%tangent)/scale
         forces%of_velocity(4) = onset%max_pressure/(drive%pressure_unit*scale/drive%force_unit)
         if (want_slopes) then
            associate (of_along => over_edges(pad, along), of_onset => over_edges(pad, onset))
               do i = 1, 2
                  forces%velocity_slopes(:, i) = symmetric(of_along(:, i), (of_onset(:, i) - of_along(:, i)) &
                     & /pad%tangent)/scale + 1.5_wp*forces%of_velocity/edges(i)
               end do
            end associate
         end if
         if (self%supplied) then
            call self%supplied_film%evaluate_pad(1, film_motion(position), drive%oil, 0.0_wp, want_slopes, still)
            forces%of_supply = [still%force, 0.0_wp, 0.0_wp]
            forces%supply_slopes = 0
            if (want_slopes) forces%supply_slopes(:2, :) = over_edges(pad, still)
         end if
         if (.not. drive%acts) return
         call self%film%evaluate_pad(1, film_motion(position, drive%still(position)), drive%oil, drive%speed_unit, &
            & want_slopes, still)
         forces%of_rotation = [still%force, 0.0_wp, 0.0_wp]/scale
         if (.not. want_slopes) return
         ! w = 0 in every place
         still%derivatives(:, :2) = still%derivatives(:, :2) - matmul(still%derivatives(:, 3:), drive%by_rotation())
         forces%rotation_slopes = 0
         forces%rotation_slopes(:2, :) = over_edges(pad, still)/scale
         do i = 1, 2
            forces%rotation_slopes(:2, i) = forces%rotation_slopes(:2, i) + 1.5_wp*forces%of_rotation(:2)/edges(i)
         end do
      end associate
   end subroutine look_up

   !> The highest pressure in the middle plane, or 0, where the film is open and has these thicknesses at its edges, for
   !> w and a pressure at the leading edge or, where the rotation acts, t. `last` as in `look_up`.
   subroutine highest_pressure(self, edges, w, load, last, counters, pressure)
      class(full_film_type), intent(inout) :: self
      real(wp), intent(in) :: edges(2), w(2), load
      integer, intent(inout) :: last
      type(film_counters), intent(inout) :: counters
      real(wp), intent(out) :: pressure
      type(film_response) :: film
      associate (position => self%pad%position(edges), drive => self%drive)
         if (drive%acts) then
            call self%film%evaluate_pad(1, film_motion(position, w + load*drive%still(position)), drive%oil, &
               & load*drive%speed_unit, .false., film)
            pressure = film%max_pressure/drive%pressure_unit
         else if (abs(load) > 0) then
            ! that of a pressure 1 at the leading edge, scaled
            call self%supplied_film%evaluate_pad(1, film_motion(position, w/load), drive%oil, 0.0_wp, .false., film)
            pressure = max(load*film%max_pressure, load*film%min_pressure)
         else
            call self%film%evaluate_pad(1, film_motion(position, w), drive%oil, 0.0_wp, .false., film)
            pressure = film%max_pressure
         end if
      end associate
   end subroutine highest_pressure

   !> M_11, M_12, M_22, 0 from the columns of M, which is symmetric by reciprocity; what the discretisation adds is
   !> shared.
   pure function symmetric(along, outward) result(m)
      real(wp), intent(in) :: along(2), outward(2)
      real(wp) :: m(simd_width)
      m = [along(1), 0.5_wp*(along(2) + outward(1)), outward(2), 0.0_wp]
   end function symmetric

   !> Derivatives of a force over the thicknesses at both edges, (component, edge).
   pure function over_edges(pad, film) result(slopes)
      type(dimensionless_pad_type), intent(in) :: pad
      type(film_response), intent(in) :: film
      real(wp) :: slopes(2, 2)
      slopes(1, :) = pad%over_edges(film%derivatives(1, :2))
      slopes(2, :) = pad%over_edges(film%derivatives(2, :2))
   end function over_edges

   !> An empty table for a pad with its drive, with a pressure at its leading edge or without: M to a tolerance,
   !> over its norm; `filled`, every cell is built. A pad whose law varies has its own table, so that else none of its
   !> cells is built at once.
   function new_full_film_table(pad, drive, supplied, tolerance, most, filled) result(table)
      type(dimensionless_pad_type), intent(in) :: pad
      type(rotation_drive_type), intent(in) :: drive
      logical, intent(in) :: supplied
      real(wp), intent(in) :: tolerance
      integer, intent(in) :: most
      logical, intent(in), optional :: filled
      type(full_film_table_type) :: table
      table%full_film_type = new_full_film(pad, drive, supplied, tolerance)
      if (drive%oil%varies) table%built = built_at_once
      table%tolerance = tolerance
      table%most = most
      if (present(filled)) table%filled = filled
      allocate (table%cells(8))
   end function new_full_film_table

   subroutine look_up_in_table(self, edges, want_slopes, last, counters, forces, good)
      class(full_film_table_type), intent(inout) :: self
      real(wp), intent(in) :: edges(2)
      logical, intent(in) :: want_slopes
      integer, intent(inout) :: last
      type(film_counters), intent(inout) :: counters
      type(full_film_forces), intent(out) :: forces
      logical, intent(out) :: good
      if (.not. holds(self, last, edges)) call self%find_cell(edges, counters, last)
      associate (cell => self%cells(last))
         good = cell%good
         if (.not. good) then
            counters%fourier = counters%fourier + 1
            call self%full_film_type%look_up(edges, want_slopes, last, counters, forces, good)
            return
         end if
         associate (place => (edges - cell%middle)*cell%per_half)
            call take(cell, cell%of_velocity, place, want_slopes, forces%of_velocity, forces%velocity_slopes)
            if (self%supplied) call take(cell, cell%of_supply, place, want_slopes, forces%of_supply, &
               & forces%supply_slopes)
            if (self%drive%acts) call take(cell, cell%of_rotation, place, want_slopes, forces%of_rotation, &
               & forces%rotation_slopes)
         end associate
      end associate
   end subroutine look_up_in_table

   !> Functions of a cell at a place in it, and their derivatives over the thicknesses.
   pure subroutine take(cell, coefficients, place, want_slopes, value, slope)
      type(cell_type), intent(in) :: cell
      real(wp), intent(in) :: coefficients(simd_width, nodes, nodes), place(2)
      logical, intent(in) :: want_slopes
      real(wp), intent(out) :: value(simd_width), slope(simd_width, 2)
      call evaluate_patch(coefficients, place, want_slopes, value, slope)
      slope(:, 1) = slope(:, 1)*cell%per_half(1)
      slope(:, 2) = slope(:, 2)*cell%per_half(2)
   end subroutine take

   subroutine highest_in_table(self, edges, w, load, last, counters, pressure)
      class(full_film_table_type), intent(inout) :: self
      real(wp), intent(in) :: edges(2), w(2), load
      integer, intent(inout) :: last
      type(film_counters), intent(inout) :: counters
      real(wp), intent(out) :: pressure
      real(wp) :: started
      if (.not. holds(self, last, edges)) call self%find_cell(edges, counters, last)
      associate (cell => self%cells(last))
         cell%pressures = cell%pressures + 1
         ! below a supply pressure, profiles alone tell
         if (cell%good .and. .not. allocated(cell%profile) &
            & .and. (cell%pressures >= visits_of_profile .or. load < 0 .and. self%supplied)) then
            started = wall_clock()
            cell%profile = new_pressure_profile(self%pad, self%drive, self%film, self%supplied_film, self%supplied, &
               & cell%middle, cell%per_half)
            counters%profiles = counters%profiles + 1
            counters%building = counters%building + wall_clock() - started
         end if
         if (allocated(cell%profile)) then
            pressure = cell%profile%highest(edges, (edges - cell%middle)*cell%per_half, [w, load])
         else
            call self%full_film_type%highest_pressure(edges, w, load, last, counters, pressure)
         end if
      end associate
   end subroutine highest_in_table

   !> True where a cell of this number holds these thicknesses and has been built.
   pure logical function holds(self, number, edges)
      class(full_film_table_type), intent(in) :: self
      integer, intent(in) :: number
      real(wp), intent(in) :: edges(2)
      holds = .false.
      if (number == 0 .or. number > self%index%count) return
      associate (cell => self%cells(number))
         holds = cell%good .and. edges(1) >= cell%lower(1) .and. edges(1) < cell%upper(1) &
            & .and. edges(2) >= cell%lower(2) .and. edges(2) < cell%upper(2)
      end associate
   end function holds

   !> The cell that holds these thicknesses and is not cut. One visit more, after which it is built if that is due;
   !> where this cuts it, the same for the next smaller one.
   subroutine find_cell(self, edges, counters, number)
      class(full_film_table_type), intent(inout) :: self
      real(wp), intent(in) :: edges(2)
      type(film_counters), intent(inout) :: counters
      integer, intent(out) :: number
      type(cell_type), allocatable :: more(:)
      real(wp) :: started
      integer :: level, place(2)
      do level = first_level, last_level
         place = interval(edges, level)
         associate (key => cell_key(level, place(1), place(2), 0, 0))
            number = self%index%find(key)
            if (number == 0) then
               if (self%index%count == self%most) call self%index%clear()
               number = self%index%count + 1
               if (number > size(self%cells)) then
                  allocate (more(2*size(self%cells)))
                  more(:size(self%cells)) = self%cells
                  call move_alloc(more, self%cells)
               end if
               self%cells(number) = cell_type()
               self%cells(number)%cut = level < last_level .and. self%pad%least_film(lower_end(place, level)) <= 0
               self%cells(number)%tried = self%cells(number)%cut
               call self%index%add(key, number)
            end if
         end associate
         associate (cell => self%cells(number))
            if (.not. cell%tried) then
               cell%visits = cell%visits + 1
               if (self%filled .or. self%built < built_at_once .or. cell%visits >= visits_of_cell) then
                  started = wall_clock()
                  call self%build(level, place, counters, cell)
                  self%built = self%built + 1
                  counters%cells = counters%cells + 1
                  counters%building = counters%building + wall_clock() - started
               end if
            end if
            if (.not. cell%cut) exit
         end associate
      end do
   end subroutine find_cell

   !> Builds the cell at a place of a level, and checks it.
   subroutine build(self, level, place, counters, cell)
      class(full_film_table_type), intent(inout) :: self
      integer, intent(in) :: level, place(2)
      type(film_counters), intent(inout) :: counters
      type(cell_type), intent(inout) :: cell
      type(full_film_forces) :: forces
      real(wp), dimension(simd_width, nodes, nodes) :: of_velocity, of_supply, of_rotation
      real(wp) :: at(nodes), found(simd_width)
      integer :: i, k, none
      logical :: open
      at = node_points(nodes)
      cell%tried = .true.
      cell%lower = lower_end(place, level)
      cell%upper = lower_end(place + 1, level)
      cell%middle = 0.5_wp*(cell%lower + cell%upper)
      cell%per_half = 2/(cell%upper - cell%lower)
      cell%cut = level < last_level
      do k = 1, nodes
         do i = 1, nodes
            call self%full_film_type%look_up(cell%middle + at([i, k])/cell%per_half, .false., none, counters, &
               & forces, open)
            if (.not. open) return
            of_velocity(:, i, k) = forces%of_velocity
            if (self%supplied) of_supply(:, i, k) = forces%of_supply
            if (self%drive%acts) of_rotation(:, i, k) = forces%of_rotation
         end do
      end do
      cell%of_velocity = fitted(of_velocity)
      if (self%supplied) cell%of_supply = fitted(of_supply)
      if (self%drive%acts) cell%of_rotation = fitted(of_rotation)
      do i = 1, size(checks, 2)
         call self%full_film_type%look_up(cell%middle + checks(:, i)/cell%per_half, .false., none, counters, forces, &
            & open)
         if (.not. open) return
         found = patch_values(simd_width, nodes, cell%of_velocity, checks(:, i))
         associate (exact => forces%of_velocity(:3))
            if (norm2(found(:3) - exact) > self%tolerance*norm2(exact)) return
         end associate
      end do
      cell%good = .true.
      cell%cut = .false.
   end subroutine build
end module full_film
