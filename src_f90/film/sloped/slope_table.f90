!> Tables of the coefficients by which small slopes change the films of pads of one shape (slope_expansion): over the
!> film thicknesses at both edges and the direction of w. In cells they are cubics along each of these, through values
!> at nodes, which neighbours share. What is in a cell does not depend on what came before.
module slope_table
   use kinds, only: wp, i8, pi
   use clock, only: wall_clock
   use film_solver, only: film_oil, film_ok, cavitation_none
   use pad_gap, only: pad_gap_type, pad_directions
   use following_film, only: following_angles
   use dimensionless_pad, only: dimensionless_pad_type, new_dimensionless_pad
   use cell_index, only: cell_index_type, cell_key, interval, lower_end
   use sloped_gap, only: sloped_motion, sloped_response
   use sloped_film, only: sloped_film_type
   use slope_expansion, only: of_pressure, coefficients, expand
   use sloped_volumes, only: sloped_volumes_type, new_sloped_volumes
   implicit none (type, external)
   private
   public :: slope_table_type, new_slope_table, diverging_part

   !> Nodes of a cell along each axis, and where they are; first and last level of cells along the thicknesses
   !> (cell_index): they are halved until the film in them is as thick as they are long, as films change fast beside
   !> those that close. Directions of w in which a part of the film diverges, beside one edge and beside the other, and
   !> those between, in which none or all of it does, have these numbers of cells, without cavitation and with the
   !> condition of Reynolds.
   integer, parameter :: nodes = 4, first_level = 1, last_level = 5, diverging(2) = [3, 8], between = 5
   real(wp), parameter :: at(nodes) = [-1.0_wp, -0.5_wp, 0.5_wp, 1.0_wp]
   !> T of the last films that are solved.
   real(wp), parameter :: last_solved = 0.97_wp
   !> Columns and rows of the volumes at nodes, for all but changes of first order.
   integer, parameter :: cells_of_node(2) = [16, 8]

   type :: cell_type
      real(wp) :: middle(3) = 0, per_half(3) = 0
      !> Whether there is a film at all nodes.
      logical :: good = .false.
      !> At the nodes, the last axis first.
      real(wp), allocatable :: loads(:, :, :, :), pressures(:, :, :, :)
   end type cell_type

   type :: node_type
      real(wp) :: loads(coefficients), pressures(of_pressure)
      logical :: good
   end type node_type

   type :: slope_table_type
      !> Without pressures around it.
      type(pad_gap_type) :: gap
      type(pad_directions) :: directions
      type(dimensionless_pad_type), private :: pad
      integer :: condition
      !> Cells of directions in which a part of the film diverges; most cells: when they are used up all are forgotten.
      integer, private :: diverging, most
      type(cell_index_type), private :: cell_index, node_index
      type(cell_type), allocatable, private :: cells(:)
      type(node_type), allocatable, private :: nodes(:)
   contains
      procedure :: find_cell
      procedure :: loads_at
      procedure :: pressures_at
   end type slope_table_type

contains

   !> An empty table of pads with this gap, with the condition of Reynolds, then between equal pressures, or none.
   type(slope_table_type) function new_slope_table(gap, condition, most) result(table)
      type(pad_gap_type), intent(in) :: gap
      integer, intent(in) :: condition, most
      table%gap = gap
      table%gap%supply_pressure = 0
      table%gap%ambient_pressure = 0
      table%gap%cavitation_pressure = 0
      table%directions = gap%directions()
      table%pad = new_dimensionless_pad(gap)
      table%condition = condition
      table%most = most
      table%diverging = merge(diverging(1), diverging(2), condition == cavitation_none)
      allocate (table%cells(8), table%nodes(512))
   end function new_slope_table

   !> The cell at a place: film thicknesses at the leading and the trailing edge over the clearance, and direction of w
   !> from that of the film in the middle, rad, from minus half the arc on. It is built where it was not, with films
   !> that solve those of this pad. `number`: that of the cell of the place before; 0: there is none.
   subroutine find_cell(self, pad, place, films, number)
      class(slope_table_type), intent(inout) :: self
      integer, intent(in) :: pad
      real(wp), intent(in) :: place(3)
      class(sloped_film_type), intent(inout) :: films
      integer, intent(inout) :: number
      type(cell_type), allocatable :: more(:)
      integer :: level, at_cell(3)
      if (number > 0 .and. number <= self%cell_index%count) then
         associate (cell => self%cells(number))
            if (cell%good .and. all(abs(place - cell%middle)*cell%per_half <= 1)) return
         end associate
      end if
      level = level_at(self, place(:2))
      number = 0
      if (level > last_level) return
      at_cell = [interval(place(:2), level), sector_cell(self, place(3))]
      associate (key => cell_key(level, at_cell(1), at_cell(2), at_cell(3), 0))
         number = self%cell_index%find(key)
         if (number == 0) then
            if (self%cell_index%count == self%most) then
               call self%cell_index%clear()
               call self%node_index%clear()
            end if
            number = self%cell_index%count + 1
            if (number > size(self%cells)) then
               allocate (more(2*size(self%cells)))
               more(:size(self%cells)) = self%cells
               call move_alloc(more, self%cells)
            end if
            call build(self, pad, level, at_cell, films, self%cells(number))
            call self%cell_index%add(key, number)
         end if
      end associate
      if (.not. self%cells(number)%good) number = 0
   end subroutine find_cell

   !> The coefficients of force and moment in a cell at a place, and, if they are wanted, their derivatives over the
   !> axes, (coefficient, 0 or axis).
   pure subroutine loads_at(self, number, place, want_slopes, loads)
      class(slope_table_type), intent(in) :: self
      integer, intent(in) :: number
      real(wp), intent(in) :: place(3)
      logical, intent(in) :: want_slopes
      real(wp), intent(out) :: loads(coefficients, 0:3)
      real(wp) :: w(nodes, 3), r(nodes, 3)
      associate (cell => self%cells(number))
         call find_weights(cell, place, w, r)
         loads(:, 0) = contracted(coefficients, cell%loads, w(:, 1), w(:, 2), w(:, 3))
         if (.not. want_slopes) return
         loads(:, 1) = contracted(coefficients, cell%loads, r(:, 1), w(:, 2), w(:, 3))
         loads(:, 2) = contracted(coefficients, cell%loads, w(:, 1), r(:, 2), w(:, 3))
         loads(:, 3) = contracted(coefficients, cell%loads, w(:, 1), w(:, 2), r(:, 3))
      end associate
   end subroutine loads_at

   !> What tells the highest pressure in a cell at a place.
   pure function pressures_at(self, number, place) result(pressures)
      class(slope_table_type), intent(in) :: self
      integer, intent(in) :: number
      real(wp), intent(in) :: place(3)
      real(wp) :: pressures(of_pressure), w(nodes, 3), r(nodes, 3)
      associate (cell => self%cells(number))
         call find_weights(cell, place, w, r)
         pressures = contracted(of_pressure, cell%pressures, w(:, 1), w(:, 2), w(:, 3))
      end associate
   end function pressures_at

   !> Polynomials that are 1 at one node and 0 at the others, along each axis, and their derivatives over it.
   pure subroutine find_weights(cell, place, weight, rising)
      type(cell_type), intent(in) :: cell
      real(wp), intent(in) :: place(3)
      real(wp), dimension(nodes, 3), intent(out) :: weight, rising
      real(wp), parameter :: a = 2.0_wp/3, b = 4.0_wp/3
      real(wp) :: s, square
      integer :: k
      do k = 1, 3
         s = (place(k) - cell%middle(k))*cell%per_half(k)
         square = s**2
         weight(:, k) = [-a*(square - 0.25_wp)*(s - 1), b*(square - 1)*(s - 0.5_wp), -b*(square - 1)*(s + 0.5_wp), &
            & a*(square - 0.25_wp)*(s + 1)]
         rising(:, k) = cell%per_half(k)*[-a*(3*square - 2*s - 0.25_wp), b*(3*square - s - 1), &
            & -b*(3*square + s - 1), a*(3*square + 2*s - 0.25_wp)]
      end do
   end subroutine find_weights

   !> Sums over the nodes of a cell with weights along each axis.
   pure function contracted(n, values, one, two, three) result(sums)
      integer, intent(in) :: n
      real(wp), intent(in) :: values(n, nodes, nodes, nodes), one(nodes), two(nodes), three(nodes)
      real(wp) :: sums(n)
      integer :: i, k
      sums = 0
      do i = 1, nodes
         do k = 1, nodes
            associate (w => one(i)*two(k), v => values(:, :, k, i))
               sums = sums + (w*three(1))*v(:, 1) + (w*three(2))*v(:, 2) + (w*three(3))*v(:, 3) + (w*three(4))*v(:, 4)
            end associate
         end do
      end do
   end function contracted

   !> The level of the cell with these thicknesses at the edges; beyond the last, there is none.
   pure integer function level_at(self, edges) result(level)
      type(slope_table_type), intent(in) :: self
      real(wp), intent(in) :: edges(2)
      real(wp) :: lower(2), upper(2)
      do level = first_level, last_level
         lower = lower_end(interval(edges, level), level)
         upper = lower_end(interval(edges, level) + 1, level)
         associate (least => min(self%pad%least_film(lower), self%pad%least_film([lower(1), upper(2)]), &
            & self%pad%least_film([upper(1), lower(2)])))
            if (least >= maxval(upper - lower)) return
         end associate
      end do
   end function level_at

   !> The number, from 0, of the cell along a direction of w.
   pure integer function sector_cell(self, angle) result(number)
      type(slope_table_type), intent(in) :: self
      real(wp), intent(in) :: angle
      do number = 0, 2*(self%diverging + between) - 2
         if (angle < lower_angle(self, number + 1)) return
      end do
   end function sector_cell

   !> Where the cell of this number begins, rad.
   pure real(wp) function lower_angle(self, number) result(angle)
      type(slope_table_type), intent(in) :: self
      integer, intent(in) :: number
      integer :: within
      within = modulo(number, self%diverging + between)
      associate (arc => self%gap%arc(), turns => number/(self%diverging + between))
         if (within <= self%diverging) then
            angle = arc*(real(within, wp)/self%diverging - 0.5_wp)
         else
            angle = 0.5_wp*arc + (pi - arc)*real(within - self%diverging, wp)/between
         end if
         angle = angle + pi*turns
      end associate
   end function lower_angle

   !> Builds the cell at a place, with films of this pad.
   subroutine build(self, pad, level, place, films, cell)
      class(slope_table_type), intent(inout) :: self
      integer, intent(in) :: pad, level, place(3)
      class(sloped_film_type), intent(inout) :: films
      type(cell_type), intent(out) :: cell
      real(wp) :: lower(3), upper(3), started
      type(node_type) :: node
      integer :: i, j, k
      started = wall_clock()
      lower = [lower_end(place(:2), level), lower_angle(self, place(3))]
      upper = [lower_end(place(:2) + 1, level), lower_angle(self, place(3) + 1)]
      cell%middle = 0.5_wp*(lower + upper)
      cell%per_half = 2/(upper - lower)
      films%counters%cells = films%counters%cells + 1
      allocate (cell%loads(coefficients, nodes, nodes, nodes), cell%pressures(of_pressure, nodes, nodes, nodes))
      nodes_of_cell: do i = 1, nodes
         do j = 1, nodes
            do k = 1, nodes
               associate (number => (nodes - 1)*place + [i, j, k] - 1)
                  call find_node(self, pad, cell_key(level, number(1), number(2), modulo(number(3), &
                     & (nodes - 1)*2*(self%diverging + between)), 0), cell%middle + at([i, j, k])/cell%per_half, &
                     & films, node)
               end associate
               if (.not. node%good) exit nodes_of_cell
               cell%loads(:, k, j, i) = node%loads
               cell%pressures(:, k, j, i) = node%pressures
            end do
         end do
      end do nodes_of_cell
      cell%good = node%good
      films%counters%building = films%counters%building + wall_clock() - started
   end subroutine build

   !> The node with this key, at this place.
   subroutine find_node(self, pad, key, place, films, node)
      type(slope_table_type), intent(inout) :: self
      integer, intent(in) :: pad
      integer(i8), intent(in) :: key
      real(wp), intent(in) :: place(3)
      class(sloped_film_type), intent(inout) :: films
      type(node_type), intent(out) :: node
      type(node_type), allocatable :: more(:)
      integer :: found
      found = self%node_index%find(key)
      if (found == 0) then
         found = self%node_index%count + 1
         if (found > size(self%nodes)) then
            allocate (more(2*size(self%nodes)))
            more(:size(self%nodes)) = self%nodes
            call move_alloc(more, self%nodes)
         end if
         call solve_node(self, pad, place, films, self%nodes(found))
         call self%node_index%add(key, found)
      end if
      node = self%nodes(found)
   end subroutine find_node

   !> The coefficients at a place.
   subroutine solve_node(self, pad, place, films, node)
      type(slope_table_type), intent(in) :: self
      integer, intent(in) :: pad
      real(wp), intent(in) :: place(3)
      class(sloped_film_type), intent(inout) :: films
      type(node_type), intent(out) :: node
      type(film_oil), parameter :: oil = film_oil(1.0_wp)
      type(sloped_volumes_type) :: volumes
      type(sloped_motion) :: motion
      type(sloped_response) :: response, coarse
      real(wp) :: along, outward, room
      node%good = .false.
      associate (m => self%directions%middle, h => self%directions%half, &
         & e => self%gap%machined_clearance*self%pad%position(place(:2)))
         motion%middle%position = [e(1)*m(2) + e(2)*m(1), e(2)*m(2) - e(1)*m(1)]
         along = cos(place(3))
         outward = sin(place(3))
         ! of a film that is nearly empty the coefficients are those of one with a little more of it
         if (self%condition /= cavitation_none) outward = max(outward, (1 - 2*last_solved)*abs(along)*h(1)/h(2))
         motion%middle%velocity = [along*m(2) + outward*m(1), outward*m(2) - along*m(1)]/hypot(along, outward)
         room = 1
         if (self%condition /= cavitation_none) room = 1 - max(0.0_wp, diverging_part(self%directions, &
            & motion%middle%velocity))
      end associate
      call films%evaluate_pad(pad, motion, oil, 0.0_wp, .true., response)
      if (response%film%status /= film_ok) return
      volumes = new_sloped_volumes(self%gap, cells_of_node(1), cells_of_node(2))
      associate (angles => following_angles(self%gap, motion%middle, 0.0_wp, cells_of_node(1)/2))
         call volumes%set_motion(angles, motion, oil, 0.0_wp)
      end associate
      call volumes%evaluate(self%condition, .false., films%counters, coarse)
      if (coarse%film%status /= film_ok) return
      call expand(volumes, self%condition, sqrt(place(1)*place(2)), room, response, node%loads, node%pressures)
      node%good = .true.
   end subroutine solve_node

   !> T of a film that is driven by w (film.md, *The table*), as table_pad has it, between -1 and 2.
   pure real(wp) function diverging_part(directions, w)
      type(pad_directions), intent(in) :: directions
      real(wp), intent(in) :: w(2)
      associate (m => directions%middle, h => directions%half)
         associate (along => abs(w(1)*m(2) - w(2)*m(1))*h(1), outward => (w(1)*m(1) + w(2)*m(2))*h(2))
            diverging_part = merge(-1, 2, outward > 0)
            if (abs(outward) < 3*along) diverging_part = 0.5_wp*(1 - outward/along)
         end associate
      end associate
   end function diverging_part
end module slope_table
