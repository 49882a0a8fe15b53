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
   use full_film, only: full_film_type, solved_full_film_type, new_solved_full_film
   use square_patch, only: nodes, simd_width, node_points, fitted, evaluate_patch
   use pressure_profile, only: pressure_profile_type, new_pressure_profile
   use logarithmic_grid, only: interval, lower_end
   use cell_index, only: cell_index_type, cell_key
   implicit none (type, external)
   private
   public :: full_film_table_type, new_full_film_table

   !> Levels of cells that are not cut and of the smallest.
   integer, parameter :: first_level = 1, last_level = 6
   !> Most cells, unless told otherwise.
   integer, parameter :: usual_most = 4000
   !> Where a new cell is checked: its corners and its middle.
   real(wp), parameter :: checks(2, 5) = reshape([-1, -1, 1, -1, -1, 1, 1, 1, 0, 0], [2, 5])

   !> Thicknesses in a cell are `middle + s/per_half`, -1 <= s <= 1 along either axis.
   type :: cell_type
      real(wp) :: lower(2), upper(2), middle(2), per_half(2)
      !> Whether the functions are as close as they should be; whether the cell is cut in four.
      logical :: good, cut
      !> M_11, M_12, M_22; the force, along and outward, of a pressure 1 at the leading edge.
      real(wp) :: driven(simd_width, nodes, nodes), supplied(simd_width, nodes, nodes)
      !> Built when a pressure is first asked for.
      type(pressure_profile_type), allocatable :: profile
   end type cell_type

   type, extends(full_film_type) :: full_film_table_type
      private
      type(dimensionless_pad_type) :: pad
      !> What the table is built from.
      type(solved_full_film_type) :: films
      !> Error of M over its norm; whether there is a pressure at the leading edge.
      real(wp) :: tolerance
      logical :: supplied
      type(cell_index_type) :: index
      type(cell_type), allocatable :: cells(:)
      !> Most cells: when they are used up all are forgotten. Cells in use.
      integer :: most = usual_most, used = 0
   contains
      procedure :: look_up
      procedure :: look_up_supply
      procedure :: highest_pressure
      procedure, private :: find_cell
      procedure, private :: new_cell
      procedure, private :: build
   end type full_film_table_type

contains

   !> An empty table for a pad, with a pressure at its leading edge or without: M to a tolerance, over its norm.
   function new_full_film_table(pad, supplied, tolerance, most) result(table)
      type(dimensionless_pad_type), intent(in) :: pad
      logical, intent(in) :: supplied
      real(wp), intent(in) :: tolerance
      integer, intent(in), optional :: most
      type(full_film_table_type) :: table
      table%pad = pad
      table%supplied = supplied
      table%tolerance = tolerance
      if (present(most)) table%most = most
      table%films = new_solved_full_film(pad, tolerance)
   end function new_full_film_table

   !> M_11, M_12, M_22, 0 and, if they are wanted, their derivatives over both thicknesses, (function, edge), of an open
   !> film with these thicknesses at its edges. `last` is the caller's memory of the cell, 0 at first. `good` is false
   !> where the functions are not as close as they should be: next to a film that closes.
   subroutine look_up(self, edges, want_slopes, last, value, slope, good)
      class(full_film_table_type), intent(inout) :: self
      real(wp), intent(in) :: edges(2)
      logical, intent(in) :: want_slopes
      integer, intent(inout) :: last
      real(wp), intent(out) :: value(simd_width), slope(simd_width, 2)
      logical, intent(out) :: good
      if (.not. holds(self, last, edges)) call self%find_cell(edges, last)
      good = self%cells(last)%good
      call evaluate_in(self%cells(last), self%cells(last)%driven, edges, want_slopes, value, slope)
   end subroutine look_up

   !> The same for the force, (along, outward, 0, 0), of a pressure 1 at the leading edge.
   subroutine look_up_supply(self, edges, want_slopes, last, value, slope)
      class(full_film_table_type), intent(inout) :: self
      real(wp), intent(in) :: edges(2)
      logical, intent(in) :: want_slopes
      integer, intent(inout) :: last
      real(wp), intent(out) :: value(simd_width), slope(simd_width, 2)
      if (.not. holds(self, last, edges)) call self%find_cell(edges, last)
      call evaluate_in(self%cells(last), self%cells(last)%supplied, edges, want_slopes, value, slope)
   end subroutine look_up_supply

   !> Four of a cell's functions, with these coefficients, and their derivatives over both thicknesses.
   pure subroutine evaluate_in(cell, coefficients, edges, want_slopes, value, slope)
      type(cell_type), intent(in) :: cell
      real(wp), intent(in) :: coefficients(simd_width, nodes, nodes), edges(2)
      logical, intent(in) :: want_slopes
      real(wp), intent(out) :: value(simd_width), slope(simd_width, 2)
      call evaluate_patch(coefficients, (edges - cell%middle)*cell%per_half, want_slopes, value, slope)
      slope(:, 1) = slope(:, 1)*cell%per_half(1)
      slope(:, 2) = slope(:, 2)*cell%per_half(2)
   end subroutine evaluate_in

   !> The highest pressure in the middle plane of the unit pad, or 0, where its film is open and has these thicknesses
   !> at its edges, for w and a pressure at the leading edge. `last` and `good` as in `look_up`.
   subroutine highest_pressure(self, edges, w, supply, last, pressure, good)
      class(full_film_table_type), intent(inout) :: self
      real(wp), intent(in) :: edges(2), w(2), supply
      integer, intent(inout) :: last
      real(wp), intent(out) :: pressure
      logical, intent(out) :: good
      if (.not. holds(self, last, edges)) call self%find_cell(edges, last)
      pressure = 0
      associate (cell => self%cells(last))
         good = cell%good
         if (.not. good) return
         if (.not. allocated(cell%profile)) cell%profile = new_pressure_profile(self%pad, &
            & self%films%film, self%films%supplied_film, self%supplied, cell%middle, cell%per_half)
         pressure = cell%profile%highest(edges, (edges - cell%middle)*cell%per_half, [w, supply])
      end associate
   end subroutine highest_pressure

   !> True where a cell of this number holds these thicknesses and is not cut.
   pure logical function holds(self, number, edges)
      class(full_film_table_type), intent(in) :: self
      integer, intent(in) :: number
      real(wp), intent(in) :: edges(2)
      holds = .false.
      if (number == 0 .or. number > self%used) return
      associate (cell => self%cells(number))
         holds = .not. cell%cut .and. edges(1) >= cell%lower(1) .and. edges(1) < cell%upper(1) &
            & .and. edges(2) >= cell%lower(2) .and. edges(2) < cell%upper(2)
      end associate
   end function holds

   !> The cell that holds these thicknesses and is not cut; what is missing on the way to it is built.
   subroutine find_cell(self, edges, number)
      class(full_film_table_type), intent(inout) :: self
      real(wp), intent(in) :: edges(2)
      integer, intent(out) :: number
      real(wp) :: started
      integer :: level, place(2)
      do level = first_level, last_level
         place = interval(edges, level)
         associate (key => cell_key(level, place(1), place(2), 0))
            number = self%index%find(key)
            if (number == 0) then
               started = wall_clock()
               call self%new_cell(number)
               call self%build(level, place, self%cells(number))
               call self%index%add(key, number)
               self%seconds = self%seconds + wall_clock() - started
            end if
         end associate
         if (.not. self%cells(number)%cut) exit
      end do
   end subroutine find_cell

   !> Room for one more cell.
   subroutine new_cell(self, number)
      class(full_film_table_type), intent(inout) :: self
      integer, intent(out) :: number
      type(cell_type), allocatable :: more(:)
      if (.not. allocated(self%cells)) then
         allocate (self%cells(8))
      else if (self%used == self%most) then
         call self%index%clear()
         self%used = 0
      else if (self%used == size(self%cells)) then
         allocate (more(2*self%used))
         more(:self%used) = self%cells
         call move_alloc(more, self%cells)
      end if
      self%used = self%used + 1
      self%built = self%built + 1
      number = self%used
   end subroutine new_cell

   !> The cell at a place of a level, checked.
   subroutine build(self, level, place, cell)
      class(full_film_table_type), intent(inout) :: self
      integer, intent(in) :: level, place(2)
      type(cell_type), intent(inout) :: cell
      real(wp), dimension(simd_width, nodes, nodes) :: driven, supplied
      real(wp) :: exact(simd_width), found(simd_width), slope(simd_width, 2)
      !> A cell that is not cut any more serves where it is as close as the solver that would stand in for it.
      real(wp) :: allowed
      real(wp) :: points(nodes)
      integer :: i, k, unused
      logical :: open
      points = node_points(nodes)
      cell%lower = lower_end(place, level)
      cell%upper = lower_end(place + 1, level)
      cell%middle = 0.5_wp*(cell%lower + cell%upper)
      cell%per_half = 2/(cell%upper - cell%lower)
      cell%good = .false.
      cell%cut = level < last_level
      allowed = merge(self%tolerance, max(self%tolerance, usual_error), cell%cut)
      cell%driven = 0
      cell%supplied = 0
      if (allocated(cell%profile)) deallocate (cell%profile)
      do k = 1, nodes
         do i = 1, nodes
            associate (edges => cell%middle + points([i, k])/cell%per_half)
               call self%films%look_up(edges, .false., unused, driven(:, i, k), slope, open)
               if (self%supplied) call self%films%look_up_supply(edges, .false., unused, supplied(:, i, k), slope)
            end associate
            if (.not. open) return
         end do
      end do
      cell%driven = fitted(driven)
      if (self%supplied) cell%supplied = fitted(supplied)
      do i = 1, size(checks, 2)
         call self%films%look_up(cell%middle + checks(:, i)/cell%per_half, .false., unused, exact, slope, open)
         if (.not. open) return
         call evaluate_patch(cell%driven, checks(:, i), .false., found, slope)
         if (norm2(found - exact) > allowed*norm2(exact)) return
      end do
      cell%good = .true.
      cell%cut = .false.
   end subroutine build

end module full_film_table
