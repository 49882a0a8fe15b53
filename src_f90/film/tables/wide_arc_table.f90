!> Tables of the cavitated films of pads of wide arcs: their force is that of the strip's film, which is solved at every
!> call, times exp(q), with complex numbers for forces and q a small, smooth function of the place, -ln(1 - e),
!> gamma and psi (wide_arc_film). Cells are large; those of high eccentricities are half as long. Of places that are
!> mirrors of each other there is one.
!>
!> A cell is built when a film is first asked for in it: all cells together take less time than users notice, and what
!> is found does not depend on what came before. Films at eccentricities from 1 on, nearly, and where the journal
!> hardly moves against the oil are left to the solver that does without a table.
module wide_arc_table
   use kinds, only: wp, pi
   use film_solver, only: film_motion, film_law_type, film_response, film_counters
   use pad_gap, only: pad_gap_type
   use dimensionless_pad, only: dimensionless_pad_type
   use wide_arc_film, only: wide_arc_film_type, strip_force_type, new_wide_arc_film, turned, vector_of
   use cell_store, only: cell_store_type, cell_place_type, node_type, new_cell_store, axes
   use cell_polynomials, only: evaluate_cubic
   implicit none (type, external)
   private
   public :: wide_arc_table_type, wide_arc_pad_type, new_wide_arc_table, new_wide_arc_pad

   !> Length of cells along -ln(1 - e), rad along gamma and psi at most, for this tolerance (with the condition of
   !> Reynolds, of Guembel) and larger ones. For smaller ones they are halved where that is nearer, as the error falls
   !> with the fourth power of their length.
   real(wp), parameter :: length(3) = [0.7_wp, pi/8, pi/12], base_tolerance(2) = [4e-5_wp, 1e-5_wp]
   integer, parameter :: most_halved = 1
   !> Of pads up to half a circle the first cells along psi, this number, are half as long: there the end of a film
   !> passes an edge, and there loaded pads are.
   integer, parameter :: short_cells = 3
   !> Cells beyond this number along the first axis are half as long, and there are no more than these, both at first.
   integer, parameter :: long_cells = 4, most_cells = 14
   !> Rows of volumes for this tolerance; the error of what is extrapolated falls with their cubes.
   integer, parameter :: base_rows = 12, most_rows = 24
   !> Where the oil converges on less than this, rad, there is no force.
   real(wp), parameter :: shortest = 1e-6_wp
   !> w over the speed of what turns with the journal below which the film is left to the other solver.
   real(wp), parameter :: least_w = 1e-9_wp

   type :: wide_arc_table_type
      type(dimensionless_pad_type) :: pad
      type(wide_arc_film_type), private :: films
      type(cell_store_type), private :: store
      !> Cells along gamma and psi, of the latter those that count twice as they are half as long, and how often cells
      !> are halved.
      integer, private :: around = 0, across = 0, twice = 0, halved = 0
   contains
      procedure :: film
      procedure, private :: functions
      procedure, private :: cell_place
      procedure, private :: lower_x
      procedure, private :: lower_psi
   end type wide_arc_table_type

   !> A pad: how it differs from its shape, and the cells it was in last.
   type :: wide_arc_pad_type
      !> Which table is the pad's; 0: none.
      integer :: shape = 0
      !> Turns the frame of the pad into its mid-arc frame.
      complex(wp), private :: turn = 1
      !> Clearance, m; R^4/c^3, m; R_J/(2 R); R^2/c^3, 1/m; force, N, of the ambient pressure, Pa.
      real(wp), private :: clearance = 1, size = 1, half_speed = 0, pressure_size = 1
      real(wp), private :: ambient_pressure = 0, ambient_force(2) = 0
      integer, private :: cells(2) = 0
   contains
      procedure :: look_up
      procedure :: look_up_pressures
      procedure, private :: motion
   end type wide_arc_pad_type

contains

   !> An empty table for a pad, with the condition of Reynolds or of Guembel, to a tolerance over the force.
   function new_wide_arc_table(pad, gumbel, tolerance, most) result(table)
      type(dimensionless_pad_type), intent(in) :: pad
      logical, intent(in) :: gumbel
      real(wp), intent(in) :: tolerance
      integer, intent(in) :: most
      type(wide_arc_table_type) :: table
      real(wp) :: finer
      finer = merge(base_tolerance(2), base_tolerance(1), gumbel)/tolerance
      table%pad = pad
      table%films = new_wide_arc_film(pad, gumbel, min(most_rows, max(base_rows, &
         & 2*nint(0.5_wp*base_rows*finer**(1.0_wp/3)))))
      table%store = new_cell_store(3, most)
      table%halved = max(0, min(most_halved, nint(0.25_wp*log(finer)/log(2.0_wp))))
      table%around = nint(2*pi/length(2))*2**table%halved
      table%across = ceiling(table%films%last_psi/length(3) - 1e-9_wp)*2**table%halved
      if (pad%half_arc <= 0.5_wp*pi) table%twice = short_cells*2**table%halved
   end function new_wide_arc_table

   !> The films at a position over the clearance, |e| < 1, and a w: their force with derivatives, or their highest
   !> pressure. `last` is the caller's memory of the cells.
   subroutine film(self, position, w, with_slopes, with_pressure, last, counters, found, good)
      class(wide_arc_table_type), intent(inout) :: self
      real(wp), intent(in) :: position(2), w(2)
      logical, intent(in) :: with_slopes, with_pressure
      integer, intent(inout) :: last(2)
      type(film_counters), intent(inout) :: counters
      type(strip_force_type), intent(out) :: found
      logical, intent(out) :: good
      type(strip_force_type) :: strip
      complex(wp) :: q, slopes(3), over_position(2), over_w(2)
      real(wp) :: e, psi(2), ratio
      integer :: k
      e = norm2(position)
      psi(1) = atan2(w(1), w(2))
      ! the film about psi, and the one beside the edges
      psi(2) = psi(1) - sign(2*pi, psi(1))
      good = .true.
      do k = 1, 2
         if (k == 2 .and. self%films%gumbel) exit
         if (.not. self%films%gumbel .and. abs(psi(k)) >= self%films%last_psi - shortest) cycle
         call self%functions([-log(1 - e), atan2(position(1), position(2)), psi(k), 0.0_wp], with_slopes, last(k), &
            & counters, q, slopes, ratio, good)
         if (.not. good) exit
         strip = self%films%strip(position, norm2(w), psi(k), with_slopes, with_pressure)
         associate (outward => position/max(e, tiny(e)), factor => exp(q))
            found%force = found%force + factor*strip%force
            found%highest = max(found%highest, ratio*strip%highest)
            if (.not. with_slopes) cycle
            over_position = slopes(1)/(1 - e)*outward + slopes(2)/max(e, tiny(e))*[outward(2), -outward(1)]
            over_w = slopes(3)/dot_product(w, w)*[w(2), -w(1)]
            found%over_position = found%over_position + factor*(strip%over_position + strip%force*over_position)
            found%over_w = found%over_w + factor*(strip%over_w + strip%force*over_w)
         end associate
      end do
   end subroutine film

   !> q and its slopes at a place, and the ratio of highest pressures, where there are cells.
   subroutine functions(self, place, with_slopes, last, counters, q, slopes, ratio, good)
      class(wide_arc_table_type), intent(inout) :: self
      real(wp), intent(in) :: place(axes)
      logical, intent(in) :: with_slopes
      integer, intent(inout) :: last
      type(film_counters), intent(inout) :: counters
      complex(wp), intent(out) :: q, slopes(3)
      real(wp), intent(out) :: ratio
      logical, intent(out) :: good
      type(cell_place_type) :: cell
      real(wp), dimension(axes) :: at, lower, upper
      type(node_type) :: node
      integer :: axis
      at = place
      if (place(3) < 0) at(2:3) = -place(2:3)
      if (.not. self%store%holds(last, at)) then
         last = 0
         call self%cell_place(at, cell, lower, upper, good)
         if (good) then
            last = self%store%find(cell)
            if (last == 0) call self%store%build(self%films, cell, lower, upper, counters, last)
         end if
      end if
      good = last > 0
      if (.not. good) return
      associate (c => self%store%cells(last), value => node%data(:, 1), slope => node%data(:, 2:4))
         call evaluate_cubic(c%coefficients, (at(:3) - c%lower(:3))*c%per_size(:3), with_slopes, value, slope)
         do axis = 1, 3
            slope(:, axis) = slope(:, axis)*c%per_size(axis)
         end do
         q = cmplx(value(1), value(2), wp)
         slopes = cmplx(slope(1, :), slope(2, :), wp)
         ratio = exp(value(3))
      end associate
      if (place(3) < 0) then
         q = conjg(q)
         slopes = conjg(slopes)
         slopes(2:3) = -slopes(2:3)
      end if
   end subroutine functions

   !> Where the cell of a place is, psi >= 0, and its ends; not good beyond the last one.
   pure subroutine cell_place(self, place, cell, lower, upper, good)
      class(wide_arc_table_type), intent(in) :: self
      real(wp), intent(in) :: place(axes)
      type(cell_place_type), intent(out) :: cell
      real(wp), intent(out) :: lower(axes), upper(axes)
      logical, intent(out) :: good
      integer :: i, side
      real(wp) :: x, y
      cell%level = self%halved
      y = place(3)*self%across/self%films%last_psi
      x = place(1)/length(1)*2**self%halved
      i = int(x)
      associate (long => long_cells*2**self%halved)
         if (i >= long) i = long + int(2*(x - long))
         good = i < most_cells*2**self%halved
      end associate
      cell%at(:3, 0) = [i, min(int((place(2) + pi)*self%around/(2*pi)), self%around - 1), &
         & min(int(y + min(y, real(self%twice, wp))), self%across + self%twice - 1)]
      cell%at(:3, 1) = cell%at(:3, 0) + 1
      lower = ends(cell%at(:, 0))
      upper = ends(cell%at(:, 1))
      upper(4) = 1
      ! once around
      cell%at(2, 1) = modulo(cell%at(2, 1), self%around)
      do side = 0, 1
         cell%nodes(:, side) = ends(cell%at(:, side))
      end do
   contains
      pure function ends(at)
         integer, intent(in) :: at(axes)
         real(wp) :: ends(axes)
         ends = [self%lower_x(at(1)), 2*pi*at(2)/self%around - pi, self%lower_psi(at(3)), 0.0_wp]
      end function ends
   end subroutine cell_place

   !> The lower end of a cell along the first axis.
   pure real(wp) function lower_x(self, number)
      class(wide_arc_table_type), intent(in) :: self
      integer, intent(in) :: number
      associate (long => long_cells*2**self%halved)
         lower_x = length(1)/2**self%halved*(min(number, long) + 0.5_wp*max(0, number - long))
      end associate
   end function lower_x

   !> The lower end of a cell along psi.
   pure real(wp) function lower_psi(self, number)
      class(wide_arc_table_type), intent(in) :: self
      integer, intent(in) :: number
      lower_psi = self%films%last_psi/self%across*max(0.5_wp*number, real(number - self%twice, wp))
   end function lower_psi

   pure type(wide_arc_pad_type) function new_wide_arc_pad(gap) result(pad)
      type(pad_gap_type), intent(in) :: gap
      associate (d => gap%directions())
         pad%turn = cmplx(d%middle(2), d%middle(1), wp)
         pad%ambient_force = -gap%pad_radius()*gap%ambient_pressure*gap%axial_length &
            & *[d%trailing(2) - d%leading(2), d%leading(1) - d%trailing(1)]
      end associate
      pad%clearance = gap%machined_clearance
      pad%size = gap%pad_radius()**4/gap%machined_clearance**3
      pad%half_speed = gap%journal_radius/(2*gap%pad_radius())
      pad%pressure_size = gap%pad_radius()**2/gap%machined_clearance**3
      pad%ambient_pressure = gap%ambient_pressure
   end function new_wide_arc_pad

   !> Position over the clearance and w, m/s, in the mid-arc frame; `good` where the table may have the film.
   pure subroutine motion(self, seen, speed, position, w, good)
      class(wide_arc_pad_type), intent(in) :: self
      type(film_motion), intent(in) :: seen
      real(wp), intent(in) :: speed
      real(wp), intent(out) :: position(2), w(2)
      logical, intent(out) :: good
      associate (e => seen%position, v => seen%velocity, turning => self%half_speed*speed)
         w = vector_of(cmplx(v(1) + turning*e(2), v(2) - turning*e(1), wp)*self%turn)
         position = vector_of(cmplx(e(1), e(2), wp)*self%turn)/self%clearance
         good = norm2(position) < 1 .and. norm2(w) > least_w*self%clearance*max(abs(turning), 1.0_wp)
      end associate
   end subroutine motion

   !> Force and its derivatives of an open film, where the table has it: then the response is from tables.
   subroutine look_up(self, table, seen, oil, speed, want_derivatives, counters, response)
      class(wide_arc_pad_type), intent(inout) :: self
      type(wide_arc_table_type), intent(inout) :: table
      type(film_motion), intent(in) :: seen
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: speed
      logical, intent(in) :: want_derivatives
      type(film_counters), intent(inout) :: counters
      type(film_response), intent(inout) :: response
      type(strip_force_type) :: film
      real(wp) :: position(2), w(2)
      complex(wp) :: slopes(4)
      integer :: i
      call self%motion(seen, speed, position, w, response%from_tables)
      if (.not. response%from_tables) return
      call table%film(position, w, want_derivatives, .false., self%cells, counters, film, response%from_tables)
      if (.not. response%from_tables) return
      response%lacks_pressures = .true.
      associate (back => conjg(self%turn), unit => oil%viscosity*self%size)
         response%force = self%ambient_force + unit*vector_of(film%force*back)
         if (.not. want_derivatives) return
         slopes = [turned(film%over_position, back)/self%clearance, turned(film%over_w, back)]
         slopes(:2) = slopes(:2) + self%half_speed*speed*[-slopes(4), slopes(3)]
         do i = 1, 4
            response%derivatives(:, i) = unit*vector_of(slopes(i))
         end do
      end associate
   end subroutine look_up

   !> Minimum and maximum pressure of a film that has been looked up before: its cell is there.
   subroutine look_up_pressures(self, table, seen, oil, speed, counters, response)
      class(wide_arc_pad_type), intent(inout) :: self
      type(wide_arc_table_type), intent(inout) :: table
      type(film_motion), intent(in) :: seen
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: speed
      type(film_counters), intent(inout) :: counters
      type(film_response), intent(inout) :: response
      type(strip_force_type) :: film
      real(wp) :: position(2), w(2)
      call self%motion(seen, speed, position, w, response%from_tables)
      if (.not. response%from_tables) return
      call table%film(position, w, .false., .true., self%cells, counters, film, response%from_tables)
      response%lacks_pressures = .not. response%from_tables
      response%min_pressure = self%ambient_pressure
      response%max_pressure = self%ambient_pressure + oil%viscosity*self%pressure_size*film%highest
   end subroutine look_up_pressures
end module wide_arc_table
