!> The full film of a pad as a table: force = S M w, with a symmetric M of three functions of the film thicknesses at
!> both edges (docs/theory/film.md, *The table*), and that of a pressure at the leading edge.
!>
!> Both are analytic, so one polynomial stands for them over half an octave of either thickness; where it does not, next
!> to a film that closes, a cell is cut in four. A cell is built when a motion first enters it, from the axial modes
!> alone: what is in it does not depend on what came before.
module full_film_table
   use kinds, only: wp
   use clock, only: wall_clock
   use dimensionless_pad, only: dimensionless_pad_type
   use film_resolution, only: usual_error
   use film_solver, only: film_counters
   use full_film, only: full_film_type, new_full_film, loads
   use cell_polynomials, only: nodes, simd_width, node_points, fitted, evaluate_patch, patch_values
   use pressure_profile, only: pressure_profile_type, new_pressure_profile
   use cell_index, only: cell_index_type, cell_key, interval, lower_end
   implicit none (type, external)
   private
   public :: full_film_table_type, new_full_film_table

   !> Levels of cells that are not cut and of the smallest.
   integer, parameter :: first_level = 1, last_level = 6
   !> Where a new cell is checked: its corners and its middle.
   real(wp), parameter :: checks(2, 5) = reshape([-1, -1, 1, -1, -1, 1, 1, 1, 0, 0], [2, 5])

   !> Thicknesses in a cell are `middle + s/per_half`, -1 <= s <= 1 along either axis.
   type :: cell_type
      real(wp) :: lower(2), upper(2), middle(2), per_half(2)
      !> Whether the functions are as close as they should be; whether the cell is cut in four.
      logical :: good, cut
      !> Of the functions of full_film.
      real(wp) :: coefficients(simd_width, nodes, nodes, loads)
      !> Built when a pressure is first asked for.
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
   contains
      procedure :: look_up
      procedure :: highest_pressure
      procedure, private :: find_cell
      procedure, private :: build
   end type full_film_table_type

contains

   !> An empty table for a pad, with a pressure at its leading edge or without: M to a tolerance, over its norm.
   function new_full_film_table(pad, supplied, tolerance, most) result(table)
      type(dimensionless_pad_type), intent(in) :: pad
      logical, intent(in) :: supplied
      real(wp), intent(in) :: tolerance
      integer, intent(in) :: most
      type(full_film_table_type) :: table
      table%full_film_type = new_full_film(pad, supplied, tolerance)
      table%tolerance = tolerance
      table%most = most
      allocate (table%cells(8))
   end function new_full_film_table

   subroutine look_up(self, edges, want_slopes, last, counters, value, slope, good)
      class(full_film_table_type), intent(inout) :: self
      real(wp), intent(in) :: edges(2)
      logical, intent(in) :: want_slopes
      integer, intent(inout) :: last
      type(film_counters), intent(inout) :: counters
      real(wp), intent(out) :: value(simd_width, loads), slope(simd_width, 2, loads)
      logical, intent(out) :: good
      integer :: load
      if (.not. holds(self, last, edges)) call self%find_cell(edges, counters, last)
      associate (cell => self%cells(last))
         good = cell%good
         do load = 1, merge(loads, 1, self%supplied)
            call evaluate_patch(cell%coefficients(:, :, :, load), (edges - cell%middle)*cell%per_half, want_slopes, &
               & value(:, load), slope(:, :, load))
            slope(:, 1, load) = slope(:, 1, load)*cell%per_half(1)
            slope(:, 2, load) = slope(:, 2, load)*cell%per_half(2)
         end do
      end associate
   end subroutine look_up

   subroutine highest_pressure(self, edges, w, supply, last, counters, pressure, good)
      class(full_film_table_type), intent(inout) :: self
      real(wp), intent(in) :: edges(2), w(2), supply
      integer, intent(inout) :: last
      type(film_counters), intent(inout) :: counters
      real(wp), intent(out) :: pressure
      logical, intent(out) :: good
      if (.not. holds(self, last, edges)) call self%find_cell(edges, counters, last)
      pressure = 0
      associate (cell => self%cells(last))
         good = cell%good
         if (.not. good) return
         if (.not. allocated(cell%profile)) cell%profile = new_pressure_profile(self%pad, self%film, &
            & self%supplied_film, self%supplied, cell%middle, cell%per_half)
         pressure = cell%profile%highest(edges, (edges - cell%middle)*cell%per_half, [w, supply])
      end associate
   end subroutine highest_pressure

   !> True where a cell of this number holds these thicknesses and is not cut.
   pure logical function holds(self, number, edges)
      class(full_film_table_type), intent(in) :: self
      integer, intent(in) :: number
      real(wp), intent(in) :: edges(2)
      holds = .false.
      if (number == 0 .or. number > self%index%count) return
      associate (cell => self%cells(number))
         holds = .not. cell%cut .and. edges(1) >= cell%lower(1) .and. edges(1) < cell%upper(1) &
            & .and. edges(2) >= cell%lower(2) .and. edges(2) < cell%upper(2)
      end associate
   end function holds

   !> The cell that holds these thicknesses and is not cut; what is missing on the way to it is built.
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
         associate (key => cell_key(level, place(1), place(2), 0))
            number = self%index%find(key)
            if (number == 0) then
               started = wall_clock()
               if (self%index%count == self%most) call self%index%clear()
               number = self%index%count + 1
               if (number > size(self%cells)) then
                  allocate (more(2*size(self%cells)))
                  more(:size(self%cells)) = self%cells
                  call move_alloc(more, self%cells)
               end if
               call self%build(level, place, counters, self%cells(number))
               call self%index%add(key, number)
               counters%cells = counters%cells + 1
               counters%building = counters%building + wall_clock() - started
            end if
         end associate
         if (.not. self%cells(number)%cut) exit
      end do
   end subroutine find_cell

   !> The cell at a place of a level, checked.
   subroutine build(self, level, place, counters, cell)
      class(full_film_table_type), intent(inout) :: self
      integer, intent(in) :: level, place(2)
      type(film_counters), intent(inout) :: counters
      type(cell_type), intent(inout) :: cell
      real(wp) :: values(simd_width, nodes, nodes, loads), points(nodes)
      real(wp) :: exact(simd_width, loads), found(simd_width), unused(simd_width, 2, loads)
      !> A cell that is not cut any more serves where it is as close as the solver that would stand in for it.
      real(wp) :: allowed
      integer :: i, k, none
      logical :: open
      points = node_points(nodes)
      cell%lower = lower_end(place, level)
      cell%upper = lower_end(place + 1, level)
      cell%middle = 0.5_wp*(cell%lower + cell%upper)
      cell%per_half = 2/(cell%upper - cell%lower)
      cell%good = .false.
      cell%cut = level < last_level
      allowed = merge(self%tolerance, max(self%tolerance, usual_error), cell%cut)
      cell%coefficients = 0
      if (allocated(cell%profile)) deallocate (cell%profile)
      do k = 1, nodes
         do i = 1, nodes
            call self%full_film_type%look_up(cell%middle + points([i, k])/cell%per_half, .false., none, counters, &
               & values(:, i, k, :), unused, open)
            if (.not. open) return
         end do
      end do
      do k = 1, loads
         cell%coefficients(:, :, :, k) = fitted(values(:, :, :, k))
      end do
      do i = 1, size(checks, 2)
         call self%full_film_type%look_up(cell%middle + checks(:, i)/cell%per_half, .false., none, counters, exact, &
            & unused, open)
         if (.not. open) return
         found = patch_values(simd_width, nodes, cell%coefficients(:, :, :, 1), checks(:, i))
         if (norm2(found - exact(:, 1)) > allowed*norm2(exact(:, 1))) return
      end do
      cell%good = .true.
      cell%cut = .false.
   end subroutine build
end module full_film_table
