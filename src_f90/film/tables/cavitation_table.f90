!> The cavitated film of a pad as a table (docs/theory/film.md, *The table*): cubics in equal cells over the logarithms
!> of the film thicknesses at both edges and over T, the part of the arc where the film diverges.
!>
!> Cells have a node at every corner, which neighbours share: across their faces the force is continuous. The film of a
!> node is solved on its own; so a cell is the same, whatever came before.
!>
!> The table answers where it pays. A node costs as much as several films of the solver that does without a table. Cells
!> are built while films without the table and nodes have cost less than 1.2 times what all films would have cost
!> without it; where it has no cell, and beside films that close, it leaves a film to that solver. A table that is
!> to be closer than that solver answers everywhere.
module cavitation_table
   use kinds, only: wp
   use clock, only: wall_clock
   use dimensionless_pad, only: dimensionless_pad_type
   use film_solver, only: film_counters
   use cavitated_film, only: cavitated_film_type, node_type, new_cavitated_film
   use cell_index, only: cell_index_type, cell_key, interval, lower_end
   use cell_polynomials, only: simd_width, terms, corner_data, corners, cubic_transform, evaluate_cubic
   implicit none (type, external)
   private
   public :: cavitation_table_type, new_cavitation_table

   !> Cells for a tolerance of 4e-5 have an eighth of an octave along the thicknesses (2^level to an octave), and 1/16
   !> along T, half of it up to T = 1/4, where loaded pads are; the error falls with the fourth power of their length
   !> (test_cavitation_table). For smaller tolerances they are halved up to four times, for larger ones doubled twice.
   integer, parameter :: base_level = 3, base_parts = 16, most_halved = 4, most_doubled = 2
   real(wp), parameter :: base_tolerance = 4e-5_wp, loaded = 0.25_wp
   !> Beside a film that closes, where the least film thickness at a corner of a cell is below twice the length of the
   !> cell, cells are halved along the thicknesses, up to three times.
   real(wp), parameter :: least_in_cells = 2
   integer, parameter :: most_beside_closed = 3
   !> Time of a film without the table and of a node, where little of the film diverges and where more does than this T:
   !> over that of a full film by modes (2 us); a film without it starts from the one before. The time of a table over
   !> that of the same films without it, beyond what its first nodes may cost: some 10 ms.
   real(wp), parameter :: film_cost(2) = [1, 5], node_cost(2) = [20, 60], little = 0.2_wp
   real(wp), parameter :: most_cost = 1.2_wp, first_cost = 100*node_cost(2)
   !> Tolerances with the condition of Reynolds and of Guembel, just below those of the default settings, from which on
   !> the error of the solver without a table would show.
   real(wp), parameter :: as_close(2) = [3.6e-5_wp, 0.9e-5_wp]

   type :: cell_type
      real(wp) :: lower(3), upper(3), per_size(3)
      real(wp) :: coefficients(simd_width, terms)
   end type cell_type

   type, extends(cavitated_film_type) :: cavitation_table_type
      private
      !> Cells in an octave of a thickness are 2^level; along T they have 1/parts, and half of it where pads are loaded.
      integer :: level = base_level, parts = base_parts
      !> Terms of a cubic from the data at its corners, once it is needed.
      real(wp), allocatable :: transform(:, :)
      type(cell_index_type) :: cell_index, node_index
      type(cell_type), allocatable :: cells(:)
      type(node_type), allocatable :: nodes(:)
      !> Most cells, and most nodes: when either are used up all are forgotten.
      integer :: most
      !> Whether it is to be closer than the solver that does without a table.
      logical :: is_closer
      !> Cost so far, and that of all films without the table.
      real(wp) :: cost = 0, cost_without = 0
   contains
      procedure :: look_up
      procedure, private :: find_cell
      procedure, private :: pays
      procedure, private :: build
      procedure, private :: find_node
   end type cavitation_table_type

contains

   !> An empty table for a pad, with the condition of Reynolds or Guembel, to a tolerance over the force. At least the
   !> corners of a cell must find room in it.
   function new_cavitation_table(pad, gumbel, tolerance, most) result(table)
      type(dimensionless_pad_type), intent(in) :: pad
      logical, intent(in) :: gumbel
      real(wp), intent(in) :: tolerance
      integer, intent(in) :: most
      type(cavitation_table_type) :: table
      integer :: finer
      table%cavitated_film_type = new_cavitated_film(pad, gumbel, tolerance)
      finer = max(-most_doubled, min(most_halved, nint(0.25_wp*log(base_tolerance/tolerance)/log(2.0_wp))))
      table%level = base_level + finer
      table%parts = nint(base_parts*2.0_wp**finer)
      table%most = max(most, corners)
      table%is_closer = tolerance < merge(as_close(2), as_close(1), gumbel)
      allocate (table%cells(32), table%nodes(128))
   end function new_cavitation_table

   subroutine look_up(self, edges, t, want_slopes, last, counters, value, slope, good)
      class(cavitation_table_type), intent(inout) :: self
      real(wp), intent(in) :: edges(2), t
      logical, intent(in) :: want_slopes
      integer, intent(inout) :: last
      type(film_counters), intent(inout) :: counters
      real(wp), intent(out) :: value(simd_width), slope(simd_width, 3)
      logical, intent(out) :: good
      real(wp) :: place(3)
      integer :: axis
      place = [edges, t]
      self%cost_without = self%cost_without + film_cost(class_of(t))
      if (.not. holds(self, last, place)) call self%find_cell(place, counters, last)
      good = last > 0
      if (.not. good) then
         self%cost = self%cost + film_cost(class_of(t))
         if (self%is_closer) call self%cavitated_film_type%look_up(edges, t, want_slopes, last, counters, value, &
            & slope, good)
         return
      end if
      associate (cell => self%cells(last))
         call evaluate_cubic(cell%coefficients, (place - cell%lower)*cell%per_size, want_slopes, value, slope)
         do axis = 1, 3
            slope(:, axis) = slope(:, axis)*cell%per_size(axis)
         end do
      end associate
   end subroutine look_up

   !> True where a cell of this number holds this place.
   pure logical function holds(self, number, place)
      class(cavitation_table_type), intent(in) :: self
      integer, intent(in) :: number
      real(wp), intent(in) :: place(3)
      holds = .false.
      if (number == 0 .or. number > self%cell_index%count) return
      associate (cell => self%cells(number))
         holds = all(place >= cell%lower .and. place < cell%upper)
      end associate
   end function holds

   !> The cell that holds this place, built if that pays; 0: none.
   subroutine find_cell(self, place, counters, number)
      class(cavitation_table_type), intent(inout) :: self
      real(wp), intent(in) :: place(3)
      type(film_counters), intent(inout) :: counters
      integer, intent(out) :: number
      type(cell_type), allocatable :: more(:)
      real(wp) :: started, lower(3), upper(3)
      integer :: level, at(3)
      logical :: good
      number = 0
      do level = self%level, self%level + most_beside_closed
         at = [interval(place(:2), level), interval_of_t(self, place(3))]
         lower = corner_place(self, level, at)
         upper = corner_place(self, level, at + 1)
         ! a film that nearly closes between the edges changes too much in a cell
         if (self%pad%least_film(lower(:2)) >= least_in_cells*maxval(upper(:2) - lower(:2))) exit
      end do
      if (level > self%level + most_beside_closed) return
      associate (key => cell_key(level, at(1), at(2), at(3)), index => self%cell_index)
         number = index%find(key)
         if (number > 0 .or. .not. self%pays()) return
         started = wall_clock()
         if (index%count == self%most .or. self%node_index%count > self%most - corners) then
            call index%clear()
            call self%node_index%clear()
         end if
         number = index%count + 1
         if (number > size(self%cells)) then
            allocate (more(2*size(self%cells)))
            more(:size(self%cells)) = self%cells
            call move_alloc(more, self%cells)
         end if
         self%cells(number)%lower = lower
         self%cells(number)%upper = upper
         call self%build(level, at, counters, self%cells(number), good)
         if (good) then
            call index%add(key, number)
            counters%cells = counters%cells + 1
         else
            number = 0
         end if
         counters%building = counters%building + wall_clock() - started
      end associate
   end subroutine find_cell

   !> True where a cell is built.
   pure logical function pays(self)
      class(cavitation_table_type), intent(in) :: self
      pays = self%is_closer .or. self%cost < first_cost + most_cost*self%cost_without
   end function pays

   !> Which cost is that of a film of a T.
   pure integer function class_of(t)
      real(wp), intent(in) :: t
      class_of = merge(2, 1, t > little)
   end function class_of

   !> The interval of a T.
   pure integer function interval_of_t(self, t)
      class(cavitation_table_type), intent(in) :: self
      real(wp), intent(in) :: t
      interval_of_t = int(self%parts*(t + min(t, loaded)))
   end function interval_of_t

   !> The lower end of an interval of T.
   pure real(wp) function lower_t(self, number)
      class(cavitation_table_type), intent(in) :: self
      integer, intent(in) :: number
      associate (t => number/real(self%parts, wp))
         lower_t = max(0.5_wp*t, t - loaded)
      end associate
   end function lower_t

   !> Thicknesses and T at a corner `at` of cells of a level.
   pure function corner_place(self, level, at) result(place)
      class(cavitation_table_type), intent(in) :: self
      integer, intent(in) :: level, at(3)
      real(wp) :: place(3)
      place = [lower_end(at(:2), level), lower_t(self, at(3))]
   end function corner_place

   !> Fills the cell at a place of a level; `good` if there is a film at every corner.
   subroutine build(self, level, at, counters, cell, good)
      class(cavitation_table_type), intent(inout) :: self
      integer, intent(in) :: level, at(3)
      type(film_counters), intent(inout) :: counters
      type(cell_type), intent(inout) :: cell
      logical, intent(out) :: good
      type(node_type) :: node
      real(wp) :: data(simd_width, corner_data, 0:corners - 1), size_of(3)
      integer :: corner, i
      good = .false.
      size_of = cell%upper - cell%lower
      cell%per_size = 1/size_of
      if (.not. allocated(self%transform)) self%transform = cubic_transform()
      do corner = 0, corners - 1
         call self%find_node(level, at + ibits(corner, [0, 1, 2], 1), counters, node)
         if (.not. node%ok) return
         data(:, :, corner) = node%data*spread([1.0_wp, size_of], 1, simd_width)
      end do
      ! the ratio of pressures is linear between corners
      do corner = 0, corners - 1
         do i = 1, 3
            associate (other => ieor(corner, 2**(i - 1)))
               data(3, 1 + i, corner) = (data(3, 1, other) - data(3, 1, corner))*sign(1, other - corner)
            end associate
         end do
      end do
      cell%coefficients = matmul(reshape(data, [simd_width, terms]), transpose(self%transform))
      good = .true.
   end subroutine build

   !> The node at a corner `at` of cells of a level.
   subroutine find_node(self, level, at, counters, node)
      class(cavitation_table_type), intent(inout) :: self
      integer, intent(in) :: level, at(3)
      type(film_counters), intent(inout) :: counters
      type(node_type), intent(out) :: node
      type(node_type), allocatable :: more(:)
      integer :: number
      associate (key => cell_key(level, at(1), at(2), at(3)), index => self%node_index)
         number = index%find(key)
         if (number > 0) then
            node = self%nodes(number)
            return
         end if
         number = index%count + 1
         if (number > size(self%nodes)) then
            allocate (more(2*size(self%nodes)))
            more(:size(self%nodes)) = self%nodes
            call move_alloc(more, self%nodes)
         end if
         associate (place => corner_place(self, level, at))
            call self%solve(place(:2), place(3), counters, node)
            self%cost = self%cost + node_cost(class_of(place(3)))
         end associate
         self%nodes(number) = node
         call index%add(key, number)
      end associate
   end subroutine find_node
end module cavitation_table
