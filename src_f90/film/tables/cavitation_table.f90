!> The cavitated film of a pad as a table: force = S M v, as if the film were full and driven by v = w + |w_1| d, with
!> d a function of the film thicknesses at both edges and of T, the part of the arc where the film diverges
!> (docs/theory/film.md, *The table*).
!>
!> Cells are boxes with a node at every corner, which neighbours share. A cell is cut in eight where the film at its
!> middle differs too much from what its corners say. The film of a node is solved on its own; so a cell is the same,
!> whatever came before.
module cavitation_table
   use kinds, only: wp
   use clock, only: wall_clock
   use dimensionless_pad, only: dimensionless_pad_type
   use effective_velocity, only: least_tolerance
   use film_solver, only: film_counters
   use cavitated_film, only: cavitated_film_type, node_type, new_cavitated_film
   use cell_index, only: cell_index_type, cell_key, interval, lower_end
   use cell_polynomials, only: simd_width, terms, corner_data, corners, cubic_transform, evaluate_cubic
   implicit none (type, external)
   private
   public :: cavitation_table_type, new_cavitation_table

   !> Cells that are not cut are half an octave long in the thicknesses, and 1/8 in T; they may be cut so often.
   integer, parameter :: octave_level = 1, parts = 8, deepest = 3
   !> What a cell that is not cut any more may err by: as much as the solver that would stand in for it.
   real(wp), parameter :: error_of_solver = 1e-3_wp
   !> How much an error of the slopes at a cell's middle, times its size, counts.
   real(wp), parameter :: share_of_slopes = 0.15_wp

   type :: cell_type
      real(wp) :: lower(3), upper(3), per_size(3)
      !> Whether d is as close as it should be; whether the cell is cut in eight.
      logical :: good, cut
      real(wp) :: coefficients(simd_width, terms)
   end type cell_type

   type, extends(cavitated_film_type) :: cavitation_table_type
      private
      !> Error of the force over that of the film that is just whole, T = 0.
      real(wp) :: tolerance
      !> Terms of a cubic from the data at its corners, once it is needed.
      real(wp), allocatable :: transform(:, :)
      type(cell_index_type) :: cell_index, node_index
      type(cell_type), allocatable :: cells(:)
      type(node_type), allocatable :: nodes(:)
      !> Most cells, and most nodes: when either are used up all are forgotten.
      integer :: most
   contains
      procedure :: look_up
      procedure, private :: find_cell
      procedure, private :: build
      procedure, private :: find_node
   end type cavitation_table_type

contains

   !> An empty table for a pad, with the condition of Reynolds or Guembel: forces to a tolerance, over that at T = 0.
   !> At least the corners and the middle of a cell must find room in it.
   function new_cavitation_table(pad, gumbel, tolerance, most) result(table)
      type(dimensionless_pad_type), intent(in) :: pad
      logical, intent(in) :: gumbel
      real(wp), intent(in) :: tolerance
      integer, intent(in) :: most
      type(cavitation_table_type) :: table
      ! beyond what the nodes keep to, cells would be cut for nothing
      table%tolerance = max(tolerance, least_tolerance)
      table%cavitated_film_type = new_cavitated_film(pad, gumbel, table%tolerance)
      table%most = max(most, corners + 1)
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
      if (.not. holds(self, last, place)) call self%find_cell(place, counters, last)
      associate (cell => self%cells(last))
         good = cell%good
         call evaluate_cubic(cell%coefficients, (place - cell%lower)*cell%per_size, want_slopes, value, slope)
         do axis = 1, 3
            slope(:, axis) = slope(:, axis)*cell%per_size(axis)
         end do
      end associate
   end subroutine look_up

   !> True where a cell of this number holds this place and is not cut.
   pure logical function holds(self, number, place)
      class(cavitation_table_type), intent(in) :: self
      integer, intent(in) :: number
      real(wp), intent(in) :: place(3)
      holds = .false.
      if (number == 0 .or. number > self%cell_index%count) return
      associate (cell => self%cells(number))
         holds = .not. cell%cut .and. place(1) >= cell%lower(1) .and. place(1) < cell%upper(1) &
            & .and. place(2) >= cell%lower(2) .and. place(2) < cell%upper(2) &
            & .and. place(3) >= cell%lower(3) .and. place(3) < cell%upper(3)
      end associate
   end function holds

   !> The cell that holds this place and is not cut; what is missing on the way to it is built.
   subroutine find_cell(self, place, counters, number)
      class(cavitation_table_type), intent(inout) :: self
      real(wp), intent(in) :: place(3)
      type(film_counters), intent(inout) :: counters
      integer, intent(out) :: number
      type(cell_type), allocatable :: more(:)
      real(wp) :: started
      integer :: level, at(3)
      do level = 0, deepest
         at = [interval(place(:2), octave_level + level), int(place(3)*parts*2**level)]
         associate (key => cell_key(level, at(1), at(2), at(3)), index => self%cell_index)
            number = index%find(key)
            if (number == 0) then
               started = wall_clock()
               if (index%count == self%most .or. self%node_index%count > self%most - corners - 1) then
                  call index%clear()
                  call self%node_index%clear()
               end if
               number = index%count + 1
               if (number > size(self%cells)) then
                  allocate (more(2*size(self%cells)))
                  more(:size(self%cells)) = self%cells
                  call move_alloc(more, self%cells)
               end if
               call self%build(level, at, counters, self%cells(number))
               call index%add(key, number)
               counters%cells = counters%cells + 1
               counters%building = counters%building + wall_clock() - started
            end if
         end associate
         if (.not. self%cells(number)%cut) exit
      end do
   end subroutine find_cell

   !> The cell at a place of a level, checked.
   subroutine build(self, level, at, counters, cell)
      class(cavitation_table_type), intent(inout) :: self
      integer, intent(in) :: level, at(3)
      type(film_counters), intent(inout) :: counters
      type(cell_type), intent(inout) :: cell
      type(node_type) :: node
      real(wp) :: data(simd_width, corner_data, 0:corners - 1), value(simd_width), slope(simd_width, 3), size_of(3), &
         & error
      integer :: corner, i, finer
      cell%lower = [lower_end(at(:2), octave_level + level), at(3)/real(parts*2**level, wp)]
      cell%upper = [lower_end(at(:2) + 1, octave_level + level), (at(3) + 1)/real(parts*2**level, wp)]
      size_of = cell%upper - cell%lower
      cell%per_size = 1/size_of
      cell%good = .false.
      cell%cut = level < deepest
      cell%coefficients = 0
      if (.not. allocated(self%transform)) self%transform = cubic_transform()
      ! nodes have their places among the corners of cells one level below the smallest: there the middles lie, too
      finer = 2**(deepest + 1 - level)
      do corner = 0, corners - 1
         call self%find_node(finer*(at + ibits(corner, [0, 1, 2], 1)), counters, node)
         if (.not. node%ok) return
         data(:, :, corner) = node%data*spread([1.0_wp, size_of], 1, simd_width)
      end do
      ! the ratio of pressures, which falls smoothly from 1 to 0, is linear between corners
      do corner = 0, corners - 1
         do i = 1, 3
            associate (other => ieor(corner, 2**(i - 1)))
               data(3, 1 + i, corner) = (data(3, 1, other) - data(3, 1, corner))*sign(1, other - corner)
            end associate
         end do
      end do
      cell%coefficients = matmul(reshape(data, [simd_width, terms]), transpose(self%transform))
      call self%find_node(finer*at + finer/2, counters, node)
      if (.not. node%ok) return
      call evaluate_cubic(cell%coefficients, [0.5_wp, 0.5_wp, 0.5_wp], .true., value, slope)
      error = norm2(matmul(node%weight, value(:2) - node%data(:2, 1)))
      do i = 1, 3
         error = max(error, share_of_slopes*size_of(i)*norm2(matmul(node%weight, &
            & slope(:2, i)/size_of(i) - node%data(:2, 1 + i))))
      end do
      cell%cut = cell%cut .and. error > self%tolerance
      cell%good = error <= max(self%tolerance, error_of_solver)
   end subroutine build

   !> The node at a corner `at`, counted in cells one level below the smallest.
   subroutine find_node(self, at, counters, node)
      class(cavitation_table_type), intent(inout) :: self
      integer, intent(in) :: at(3)
      type(film_counters), intent(inout) :: counters
      type(node_type), intent(out) :: node
      type(node_type), allocatable :: more(:)
      integer :: number
      associate (key => cell_key(0, at(1), at(2), at(3)), index => self%node_index)
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
         call self%solve(lower_end(at(:2), octave_level + deepest + 1), at(3)/real(parts*2**(deepest + 1), wp), &
            & counters, node)
         self%nodes(number) = node
         call index%add(key, number)
      end associate
   end subroutine find_node
end module cavitation_table
