!> The cavitated film of a dimensionless pad, solved or from a table: its force is that of the film in the same place
!> that is just full, times (1 - T)^4 (exp(q) - floor), with complex numbers for forces and q a smooth function of the
!> film thicknesses at both edges and of T, the part of the arc where the film diverges (docs/theory/film.md); where the
!> rotation drives the film besides w (rotation_drive) also of t/w_1.
!>
!> `cavitated_film_type` solves q where it is asked for. The table has cubics in equal cells over the logarithms of the
!> thicknesses and over T; where the rotation acts also over t/w_1 (cell_store).
!>
!> The table answers where it pays. A node costs as much as several films of the solver that does without a table. Cells
!> are built while films without the table and nodes have cost less than 1.2 times what all films would have cost
!> without it; where it has no cell, and beside films that close, it leaves a film to that solver. A table that is
!> to be closer than that solver answers everywhere, and that of fixed pads has all cells (docs/theory/film.md).
module cavitated_film
   use kinds, only: wp
   use film_solver, only: film_counters
   use dimensionless_pad, only: dimensionless_pad_type
   use force_ratio, only: force_ratio_solver, force_ratio_type, new_force_ratio_solver, least_tolerance
   use rotation_drive, only: rotation_drive_type, new_rotation_drive
   use cell_index, only: interval, lower_end
   use cell_polynomials, only: evaluate_cubic, evaluate_blend
   use cell_store, only: cell_store_type, cell_place_type, node_type, node_solver_type, new_cell_store, axes
   implicit none (type, external)
   private
   public :: cavitated_film_type, cavitation_table_type, node_type, new_cavitated_film, new_cavitation_table, axes

   !> Powers of 1 - T by which force and highest pressure end with the condition of Reynolds.
   integer, parameter :: force_power = 4, pressure_power = 3
   !> T above which a film is not solved any more, but its functions continue along their slopes over T.
   real(wp), parameter :: last_solved = 0.99_wp
   !> With Guembel's condition, whose force ends before T = 1 does, added to the ratio before its logarithm.
   real(wp), parameter :: gumbel_floor = 1e-2_wp
   !> Films that are remembered: of a state of all pads.
   integer, parameter :: memory = 24

   !> The axes are both thicknesses, T, and t/w_1, which is 0 where the rotation does not act.
   type, extends(node_solver_type) :: cavitated_film_type
      type(dimensionless_pad_type) :: pad
      type(rotation_drive_type) :: drive
      type(force_ratio_solver), private :: ratios
      !> Where the rotation acts, as seen in a mirror.
      type(force_ratio_solver), allocatable, private :: mirrored
      real(wp), private :: floor = 0
      !> The films looked up last, one after the other, and where.
      type(node_type), allocatable, private :: remembered(:)
      real(wp), allocatable, private :: remembered_at(:, :)
      integer, private :: remember_next = 0
      !> What has been solved has cost this, over a full film by modes.
      real(wp) :: cost = 0
   contains
      procedure :: look_up
      procedure :: solve
      procedure :: set_ratio
   end type cavitated_film_type

   !> Cells for a tolerance of 4e-5 have an eighth of an octave along the thicknesses (2^level to an octave), and 1/16
   !> along T, half of it up to T = 1/4, where loaded pads are; the error falls with the fourth power of their length
   !> (test_cavitation_table). For smaller tolerances they are halved up to four times, for larger ones doubled twice.
   integer, parameter :: base_level = 3, base_parts = 16, most_halved = 4, most_doubled = 2
   real(wp), parameter :: base_tolerance = 4e-5_wp, loaded = 0.25_wp
   !> Fixed pads are loaded at all T and have nothing that gives way: this number of cells along T in place of one
   !> (make realistic).
   integer, parameter :: parts_of_fixed = 2
   !> Beside a film that closes, where the least film thickness at a corner of a cell is below twice the length of the
   !> cell, cells are halved along the thicknesses, up to three times.
   real(wp), parameter :: least_in_cells = 2
   integer, parameter :: most_beside_closed = 3
   !> Time of a film without the table and of a node, where little of the film diverges and where more does than this T:
   !> over that of a full film by modes (2 us); a film without it starts from the one before. The time of a table over
   !> that of the same films without it, beyond what its first nodes may cost: some 10 ms.
   real(wp), parameter :: film_cost(2) = [1, 5], node_cost(2) = [20, 60], little = 0.2_wp
   real(wp), parameter :: most_cost = 1.2_wp, first_cost = 100*node_cost(2)
   !> The same where the rotation acts, so that no other pad has the table: it may cost as much as all films would have
   !> cost without it, so that both together cost at most twice the cheaper of them (full_film_table).
   !> Its nodes have the full film without rotation, too.
   real(wp), parameter :: most_cost_alone = 2, rotation_cost = 1.5_wp
   !> Range of |t/w_1| that has cells; added to its intervals, so that they have numbers > 0.
   real(wp), parameter :: drives(2) = 2.0_wp**[-15, 15]
   integer, parameter :: drive_offset = 512
   !> Tolerances with the condition of Reynolds and of Guembel, just below those of the default settings, from which on
   !> the error of the solver without a table would show.
   real(wp), parameter :: as_close(2) = [3.6e-5_wp, 0.9e-5_wp]

   type, extends(cavitated_film_type) :: cavitation_table_type
      private
      !> Cells in an octave of a thickness are 2^level; along T they have 1/parts, and half of it where pads are loaded.
      integer :: level = base_level, parts = base_parts
      !> Along t/w_1: half an octave at most.
      integer :: level_of_drive = 0
      type(cell_store_type) :: store
      !> What all films would have cost without the table.
      real(wp) :: cost_without = 0
      !> Whether it is to be closer than the solver that does without a table; whether all cells are built, as then;
      !> whether it is of fixed pads.
      logical :: is_closer, filled = .false., fixed = .false.
   contains
      procedure :: look_up => look_up_in_table
      procedure, private :: find_cell
      procedure, private :: pays
   end type cavitation_table_type

contains

   !> The films of a pad with its drive, with the condition of Reynolds or (without a D) Guembel: forces to a
   !> tolerance, over themselves.
   function new_cavitated_film(pad, drive, gumbel, tolerance) result(films)
      type(dimensionless_pad_type), intent(in) :: pad
      type(rotation_drive_type), intent(in) :: drive
      logical, intent(in) :: gumbel
      real(wp), intent(in) :: tolerance
      type(cavitated_film_type) :: films
      films%pad = pad
      if (gumbel) films%floor = gumbel_floor
      films%drive = drive
      films%ratios = new_force_ratio_solver(pad, drive, gumbel, max(tolerance, least_tolerance))
      if (drive%acts) films%mirrored = new_force_ratio_solver(pad, new_rotation_drive(pad, drive%oil%mirrored()), &
         & gumbel, max(tolerance, least_tolerance))
   end function new_cavitated_film

   !> The functions of an open film with 0 < T < 1, with their derivatives if they are wanted; where w_1 < 0, seen in a
   !> mirror. `last` is the caller's memory of the place in a table, 0 at first. Here films are solved, unless they are
   !> among the last that were: a state is often evaluated again, for its derivatives.
   subroutine look_up(self, place, want_slopes, last, counters, node)
      class(cavitated_film_type), intent(inout) :: self
      real(wp), intent(in) :: place(axes)
      logical, intent(in) :: want_slopes
      integer, intent(inout) :: last
      type(film_counters), intent(inout) :: counters
      type(node_type), intent(out) :: node
      integer :: i
      if (.not. allocated(self%remembered)) then
         allocate (self%remembered(memory), self%remembered_at(axes, memory))
         self%remembered_at = huge(1.0_wp)
      end if
      do i = 1, size(self%remembered)
         if (any(abs(self%remembered_at(:, i) - place) > 0)) cycle
         node = self%remembered(i)
         return
      end do
      call self%solve(place, counters, node)
      self%remember_next = modulo(self%remember_next, size(self%remembered)) + 1
      self%remembered(self%remember_next) = node
      self%remembered_at(:, self%remember_next) = place
   end subroutine look_up

   !> The functions of a film.
   subroutine solve(self, place, counters, node)
      class(cavitated_film_type), intent(inout) :: self
      real(wp), intent(in) :: place(axes)
      type(film_counters), intent(inout) :: counters
      type(node_type), intent(out) :: node
      type(force_ratio_type) :: ratio
      complex(wp) :: part, slopes(3), over_t
      real(wp) :: at, room
      at = min(place(3), last_solved)
      room = 1 - at
      counters%nodes = counters%nodes + 1
      self%cost = self%cost + node_cost(class_of(place(3)))*merge(rotation_cost, 1.0_wp, self%drive%acts)
      associate (edges => place(:2), w_2 => self%pad%tangent*(1 - 2*at), t => place(4))
         if (t < 0) then
            ! a mirror turns the rotation round
            ratio = self%mirrored%at(edges, w_2, t)
         else
            ratio = self%ratios%at(edges, w_2, t)
         end if
      end associate
      node%data = 0
      node%ok = ratio%ok
      if (.not. node%ok) return
      part = ratio%value/room**force_power + self%floor
      slopes = ratio%slopes/room**force_power/part
      slopes(3) = -2*self%pad%tangent*slopes(3) + force_power/room*(part - self%floor)/part
      associate (q => log(part) + (place(3) - at)*slopes(3))
         node%data(:2, 1) = [real(q), aimag(q)]
      end associate
      over_t = ratio%over_t/room**force_power/part
      node%data(1, 2:) = real([slopes, over_t])
      node%data(2, 2:) = aimag([slopes, over_t])
      node%data(3, 1) = log(ratio%pressure/room**pressure_power + self%floor)
   end subroutine solve

   !> The force of a film over that of the film that is just full, its derivatives over the axes, and the same ratio of
   !> the highest pressures (where the rotation acts that film has t = 0), from what `look_up` found at a T.
   pure subroutine set_ratio(self, t, node, force, force_slopes, pressure)
      class(cavitated_film_type), intent(in) :: self
      real(wp), intent(in) :: t
      type(node_type), intent(in) :: node
      complex(wp), intent(out) :: force, force_slopes(axes)
      real(wp), intent(out) :: pressure
      complex(wp) :: part
      associate (room => 1 - t, value => node%data(:, 1), slope => node%data(:, 2:))
         part = room**force_power*exp(value(1))*cmplx(cos(value(2)), sin(value(2)), wp)
         force = part - self%floor*room**force_power
         force_slopes(:3) = part*cmplx(slope(1, :3), slope(2, :3), wp)
         force_slopes(4) = 0
         if (self%drive%acts) force_slopes(4) = part*cmplx(slope(1, 4), slope(2, 4), wp)
         force_slopes(3) = force_slopes(3) - force_power/room*force
         pressure = room**pressure_power*max(0.0_wp, exp(value(3)) - self%floor)
      end associate
   end subroutine set_ratio

   !> An empty table for a pad with its drive, with the condition of Reynolds or (without a D) Guembel, to a
   !> tolerance over the force; `filled`, every cell is built; `fixed`, the pad is fixed.
   function new_cavitation_table(pad, drive, gumbel, tolerance, most, filled, fixed) result(table)
      type(dimensionless_pad_type), intent(in) :: pad
      type(rotation_drive_type), intent(in) :: drive
      logical, intent(in) :: gumbel
      real(wp), intent(in) :: tolerance
      integer, intent(in) :: most
      logical, intent(in), optional :: filled, fixed
      type(cavitation_table_type) :: table
      integer :: finer
      table%cavitated_film_type = new_cavitated_film(pad, drive, gumbel, tolerance)
      finer = max(-most_doubled, min(most_halved, nint(0.25_wp*log(base_tolerance/tolerance)/log(2.0_wp))))
      table%level = base_level + finer
      table%parts = nint(base_parts*2.0_wp**finer)
      if (present(fixed)) table%fixed = fixed
      if (table%fixed) table%parts = parts_of_fixed*table%parts
      table%level_of_drive = 1 + max(0, finer)
      table%store = new_cell_store(merge(4, 3, drive%acts), most)
      if (present(filled)) table%filled = filled
      table%is_closer = tolerance < merge(as_close(2), as_close(1), gumbel)
   end function new_cavitation_table

   subroutine look_up_in_table(self, place, want_slopes, last, counters, node)
      class(cavitation_table_type), intent(inout) :: self
      real(wp), intent(in) :: place(axes)
      logical, intent(in) :: want_slopes
      integer, intent(inout) :: last
      type(film_counters), intent(inout) :: counters
      type(node_type), intent(out) :: node
      integer :: axis
      self%cost_without = self%cost_without + film_cost(class_of(place(3)))
      if (.not. self%store%holds(last, place)) call self%find_cell(place, counters, last)
      node%ok = last > 0
      if (.not. node%ok) then
         self%cost = self%cost + film_cost(class_of(place(3)))
         if (self%is_closer .or. (self%fixed .and. .not. self%drive%acts)) call self%cavitated_film_type%look_up( &
            & place, want_slopes, last, counters, node)
         return
      end if
      associate (cell => self%store%cells(last), value => node%data(:, 1), slope => node%data(:, 2:))
         if (self%drive%acts) then
            call evaluate_blend(cell%blend, (place - cell%lower)*cell%per_size, want_slopes, value, slope)
            slope(:, 4) = slope(:, 4)*cell%per_size(4)
         else
            call evaluate_cubic(cell%coefficients, (place(:3) - cell%lower(:3))*cell%per_size(:3), want_slopes, value, &
               & slope(:, :3))
            slope(:, 4) = 0
         end if
         do axis = 1, 3
            slope(:, axis) = slope(:, axis)*cell%per_size(axis)
         end do
      end associate
   end subroutine look_up_in_table

   !> The cell that holds this place, built if that pays; 0: none.
   subroutine find_cell(self, place, counters, number)
      class(cavitation_table_type), intent(inout) :: self
      real(wp), intent(in) :: place(axes)
      type(film_counters), intent(inout) :: counters
      integer, intent(out) :: number
      type(cell_place_type) :: cell
      integer :: level
      number = 0
      if (self%drive%acts .and. .not. (abs(place(4)) >= drives(1) .and. abs(place(4)) < drives(2))) return
      do level = self%level, self%level + most_beside_closed
         cell%level = level
         cell%at(:, 0) = [interval(place(:2), level), interval_of_t(self, place(3)), interval_of_drive(self, place(4))]
         cell%at(:, 1) = cell%at(:, 0) + 1
         cell%nodes(:, 0) = corner_place(self, level, cell%at(:, 0))
         cell%nodes(:, 1) = corner_place(self, level, cell%at(:, 1))
         associate (lower => cell%nodes(:2, 0), upper => cell%nodes(:2, 1))
            ! a film that nearly closes between the edges changes too much in a cell
            if (self%pad%least_film(lower) >= least_in_cells*maxval(upper - lower)) exit
         end associate
      end do
      if (level > self%level + most_beside_closed) return
      number = self%store%find(cell)
      if (number > 0 .or. .not. self%pays()) return
      call self%store%build(self%cavitated_film_type, cell, cell%nodes(:, 0), cell%nodes(:, 1), counters, number)
   end subroutine find_cell

   !> True where a cell is built.
   pure logical function pays(self)
      class(cavitation_table_type), intent(in) :: self
      if (self%is_closer .or. self%filled) then
         pays = .true.
      else if (self%drive%acts) then
         pays = self%cost < most_cost_alone*self%cost_without
      else
         pays = self%fixed .or. self%cost < first_cost + most_cost*self%cost_without
      end if
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

   !> The interval of t/w_1: upwards from 0 and, in even numbers less 1, downwards. Where the rotation
   !> does not act 0.
   pure integer function interval_of_drive(self, drive)
      class(cavitation_table_type), intent(in) :: self
      real(wp), intent(in) :: drive
      interval_of_drive = 0
      if (.not. self%drive%acts) return
      interval_of_drive = interval(abs(drive), self%level_of_drive) + drive_offset
      if (drive < 0) interval_of_drive = -1 - interval_of_drive
   end function interval_of_drive

   !> The lower end of an interval of t/w_1; 0 and 1 where the rotation does not act.
   pure real(wp) function lower_drive(self, number)
      class(cavitation_table_type), intent(in) :: self
      integer, intent(in) :: number
      if (.not. self%drive%acts) then
         lower_drive = number
      else if (number < 0) then
         lower_drive = -lower_end(-number - drive_offset, self%level_of_drive)
      else
         lower_drive = lower_end(number - drive_offset, self%level_of_drive)
      end if
   end function lower_drive

   !> Where a corner `at` of cells of a level is.
   pure function corner_place(self, level, at) result(place)
      class(cavitation_table_type), intent(in) :: self
      integer, intent(in) :: level, at(axes)
      real(wp) :: place(axes)
      place = [lower_end(at(:2), level), lower_t(self, at(3)), lower_drive(self, at(4))]
   end function corner_place
end module cavitated_film
