!> The cells of a table of cavitated films: cubics from values and slopes at their corners, the nodes, which neighbours
!> share, so that the functions are continuous across faces. A node is solved on its own; so a cell is the same,
!> whatever came before.
module cell_store
   use kinds, only: wp
   use clock, only: wall_clock
   use film_solver, only: film_counters
   use cell_index, only: cell_index_type, cell_key
   use cell_polynomials, only: simd_width, terms, corner_data, corners, cubic_transform, blend_of
   implicit none (type, external)
   private
   public :: cell_store_type, cell_place_type, node_type, node_solver_type, new_cell_store, axes

   !> Axes of a table, of which the last one may have no length.
   integer, parameter :: axes = 4

   !> Functions: real and imaginary part of q, the logarithm of the ratio of highest pressures, and 0. Their values, and
   !> derivatives over the axes, (function, value or derivative).
   type :: node_type
      real(wp) :: data(simd_width, 1 + axes)
      !> Whether the film is open and was solved.
      logical :: ok = .false.
   end type node_type

   !> What solves the film of a node.
   type, abstract :: node_solver_type
   contains
      procedure(solve_node), deferred :: solve
   end type node_solver_type

   abstract interface
      !> The functions of a film.
      subroutine solve_node(self, place, counters, node)
         import :: node_solver_type, film_counters, node_type, wp, axes
         class(node_solver_type), intent(inout) :: self
         real(wp), intent(in) :: place(axes)
         type(film_counters), intent(inout) :: counters
         type(node_type), intent(out) :: node
      end subroutine solve_node
   end interface

   type :: cell_type
      real(wp) :: lower(axes), upper(axes), per_size(axes)
      real(wp) :: coefficients(simd_width, terms)
      !> Where the last axis has a length, in four dimensions.
      real(wp), allocatable :: blend(:, :)
   end type cell_type

   !> Where a cell is: its level, numbers of its nodes along the axes and where these are, (axis, lower or upper).
   type :: cell_place_type
      integer :: level = 0, at(axes, 0:1) = 0
      real(wp) :: nodes(axes, 0:1) = 0
   end type cell_place_type

   type :: cell_store_type
      type(cell_type), allocatable :: cells(:)
      !> Corners of a cell.
      integer :: corner_count = corners
      !> Most cells, and most nodes: when either are used up all are forgotten.
      integer, private :: most
      type(cell_index_type), private :: cell_index, node_index
      type(node_type), allocatable, private :: nodes(:)
      !> Terms of a cubic from the data at its corners, once it is needed.
      real(wp), allocatable, private :: transform(:, :)
   contains
      procedure :: holds
      procedure :: find
      procedure :: build
      procedure, private :: fill
      procedure, private :: find_node
   end type cell_store_type

contains

   !> An empty store of cells in three or four dimensions. At least the corners of a cell must find room in it.
   function new_cell_store(dimensions, most) result(store)
      integer, intent(in) :: dimensions, most
      type(cell_store_type) :: store
      store%corner_count = 2**dimensions
      store%most = max(most, store%corner_count)
      allocate (store%cells(32), store%nodes(128))
   end function new_cell_store

   !> True where a cell of this number holds this place.
   pure logical function holds(self, number, place)
      class(cell_store_type), intent(in) :: self
      integer, intent(in) :: number
      real(wp), intent(in) :: place(axes)
      holds = .false.
      if (number == 0 .or. number > self%cell_index%count) return
      associate (cell => self%cells(number))
         holds = all(place >= cell%lower .and. place < cell%upper)
      end associate
   end function holds

   !> The number of the cell at a place; 0: there is none.
   pure integer function find(self, place) result(number)
      class(cell_store_type), intent(in) :: self
      type(cell_place_type), intent(in) :: place
      associate (at => place%at(:, 0))
         number = self%cell_index%find(cell_key(place%level, at(1), at(2), at(3), at(4)))
      end associate
   end function find

   !> Builds the cell at a place, between these ends; its number is 0 where a corner has no film.
   subroutine build(self, solver, place, lower, upper, counters, number)
      class(cell_store_type), intent(inout) :: self
      class(node_solver_type), intent(inout) :: solver
      type(cell_place_type), intent(in) :: place
      real(wp), intent(in) :: lower(axes), upper(axes)
      type(film_counters), intent(inout) :: counters
      integer, intent(out) :: number
      type(cell_type), allocatable :: more(:)
      real(wp) :: started
      logical :: good
      started = wall_clock()
      associate (index => self%cell_index, at => place%at(:, 0))
         if (index%count == self%most .or. self%node_index%count > self%most - self%corner_count) then
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
         call self%fill(solver, place, counters, self%cells(number), good)
         if (good) then
            call index%add(cell_key(place%level, at(1), at(2), at(3), at(4)), number)
            counters%cells = counters%cells + 1
         else
            number = 0
         end if
      end associate
      counters%building = counters%building + wall_clock() - started
   end subroutine build

   !> Fills a cell; `good` if there is a film at every corner.
   subroutine fill(self, solver, place, counters, cell, good)
      class(cell_store_type), intent(inout) :: self
      class(node_solver_type), intent(inout) :: solver
      type(cell_place_type), intent(in) :: place
      type(film_counters), intent(inout) :: counters
      type(cell_type), intent(inout) :: cell
      logical, intent(out) :: good
      type(node_type) :: node
      real(wp) :: data(simd_width, 1 + axes, 0:corners - 1, 0:1), size_of(axes)
      integer :: corner, side, i
      good = .false.
      size_of = cell%upper - cell%lower
      cell%per_size = 1/size_of
      if (.not. allocated(self%transform)) self%transform = cubic_transform()
      do side = 0, self%corner_count/corners - 1
         do corner = 0, corners - 1
            call self%find_node(solver, place, [ibits(corner, [0, 1, 2], 1), side], counters, node)
            if (.not. node%ok) return
            data(:, :, corner, side) = node%data*spread([1.0_wp, size_of], 1, simd_width)
         end do
         ! the ratio of pressures is linear between corners
         do corner = 0, corners - 1
            do i = 1, 3
               associate (other => ieor(corner, 2**(i - 1)))
                  data(3, 1 + i, corner, side) = (data(3, 1, other, side) - data(3, 1, corner, side)) &
                     & *sign(1, other - corner)
               end associate
            end do
         end do
      end do
      good = .true.
      if (self%corner_count == corners) then
         cell%coefficients = matmul(reshape(data(:, :corner_data, :, 0), [simd_width, terms]), &
            & transpose(self%transform))
         return
      end if
      data(3, 5, :, 0) = data(3, 1, :, 1) - data(3, 1, :, 0)
      data(3, 5, :, 1) = data(3, 5, :, 0)
      cell%blend = blend_of(self%transform, data)
   end subroutine fill

   !> The node at a corner of a cell: the lower (0) or upper (1) one along each axis.
   subroutine find_node(self, solver, cell, side, counters, node)
      class(cell_store_type), intent(inout) :: self
      class(node_solver_type), intent(inout) :: solver
      type(cell_place_type), intent(in) :: cell
      integer, intent(in) :: side(axes)
      type(film_counters), intent(inout) :: counters
      type(node_type), intent(out) :: node
      type(node_type), allocatable :: more(:)
      real(wp) :: place(axes)
      integer :: number, i, at(axes)
      at = [(cell%at(i, side(i)), i=1, axes)]
      place = [(cell%nodes(i, side(i)), i=1, axes)]
      associate (key => cell_key(cell%level, at(1), at(2), at(3), at(4)), index => self%node_index)
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
         call solver%solve(place, counters, node)
         self%nodes(number) = node
         call index%add(key, number)
      end associate
   end subroutine find_node
end module cell_store
