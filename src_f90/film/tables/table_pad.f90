!> One pad's film from the tables of its shape: the force with its derivatives, and the highest pressure.
module table_pad
   use kinds, only: wp
   use film_solver, only: film_motion, film_oil, film_response, film_counters
   use pad_gap, only: pad_gap_type, pad_directions
   use dimensionless_pad, only: dimensionless_pad_type, mid_arc_frame_type, middle_motion, middle_force, &
      & new_mid_arc_frame
   use cell_polynomials, only: simd_width
   use full_film, only: full_film_type, loads
   use cavitated_film, only: cavitated_film_type
   implicit none (type, external)
   private
   public :: table_pad_type, shape_tables, new_table_pad

   !> The films of pads of one shape, from tables or solved.
   type :: shape_tables
      type(dimensionless_pad_type) :: pad
      !> Whether they have a pressure of their own at the leading edge.
      logical :: supplied = .false.
      class(full_film_type), allocatable :: whole
      class(cavitated_film_type), allocatable :: cavitation
   end type shape_tables

   !> A pad: its gap, how it differs from its shape, and the cells it was in last.
   type :: table_pad_type
      type(pad_gap_type) :: gap
      type(mid_arc_frame_type), private :: frame
      !> Which tables are the pad's; 0: none.
      integer :: shape = 0
      !> Whether the last film came from the tables.
      logical :: found = .false.
      !> Whether all pressures around the pad are equal: then the tables know cavitated films, too.
      logical :: even_pressure
      !> Pressure at the leading edge above the ambient pressure, Pa; R^2, m^2.
      real(wp) :: rise
      real(wp), private :: square
      !> Force of the ambient pressure, N, in the pad frame.
      real(wp), private :: ambient_force(2)
      integer, private :: whole_cell = 0, cavitation_cell = 0
   contains
      procedure :: look_up
      procedure :: look_up_pressures
      procedure, private :: set_drive
      procedure, private :: set_force
   end type table_pad_type

   !> The velocity that drives a film as if it were whole, m/s, and its derivatives over the edges' thicknesses,
   !> (component, edge), and over w, (component, component of w).
   type :: pad_drive
      real(wp) :: value(2), over_edges(2, 2), over_w(2, 2)
      !> Highest pressure of the full film over that of the cavitated one.
      real(wp) :: pressure_ratio = 1
      !> Whether nothing of the film is left.
      logical :: empty = .false.
   end type pad_drive

   !> Ratio of pressures below which nothing of a film is left that counts.
   real(wp), parameter :: least_ratio = 0.01_wp
   real(wp), parameter :: identity(2, 2) = reshape([1, 0, 0, 1], [2, 2])

contains

   !> A pad with this gap and this shape.
   pure type(table_pad_type) function new_table_pad(gap, shape) result(pad)
      type(pad_gap_type), intent(in) :: gap
      type(dimensionless_pad_type), intent(in) :: shape
      type(pad_directions) :: edges
      pad%gap = gap
      pad%frame = new_mid_arc_frame(gap, shape)
      pad%rise = gap%supply_pressure - gap%ambient_pressure
      pad%even_pressure = .not. (abs(pad%rise) > 0 .or. abs(gap%ambient_pressure - gap%cavitation_pressure) > 0)
      pad%square = gap%pad_radius()**2
      edges = gap%directions()
      pad%ambient_force = -gap%pad_radius()*gap%ambient_pressure*gap%axial_length &
         & *[edges%trailing(2) - edges%leading(2), edges%leading(1) - edges%trailing(1)]
   end function new_table_pad

   !> Force and its derivatives of an open film; `found` is false where the tables do not have it.
   subroutine look_up(self, tables, motion, oil, speed, may_cavitate, want_derivatives, counters, response)
      class(table_pad_type), intent(inout) :: self
      type(shape_tables), intent(inout) :: tables
      type(film_motion), intent(in) :: motion
      type(film_oil), intent(in) :: oil
      real(wp), intent(in) :: speed
      logical, intent(in) :: may_cavitate, want_derivatives
      type(film_counters), intent(inout) :: counters
      type(film_response), intent(inout) :: response
      type(middle_motion) :: seen
      type(middle_force) :: force
      type(pad_drive) :: drive
      seen = self%frame%motion(motion, oil, speed)
      ! with different pressures around a film that may cavitate, all of it is solved: the force must not jump between
      ! two solvers where the film begins to diverge
      self%found = all(seen%edges > 0) .and. (self%even_pressure .or. .not. may_cavitate)
      if (.not. self%found) return
      call self%set_drive(tables, seen, may_cavitate, want_derivatives, counters, drive)
      if (drive%empty) then
         response%force = self%ambient_force
         return
      end if
      if (self%found) call self%set_force(tables, seen, drive, want_derivatives, counters, force)
      if (.not. self%found) return
      response%force = self%ambient_force + self%frame%force(force)
      if (want_derivatives) response%derivatives = self%frame%derivatives(seen, force)
   end subroutine look_up

   !> The drive of a film; `found` becomes false where it cavitates and the table does not have it.
   subroutine set_drive(self, tables, seen, may_cavitate, want_derivatives, counters, drive)
      class(table_pad_type), intent(inout) :: self
      type(shape_tables), intent(inout) :: tables
      type(middle_motion), intent(in) :: seen
      logical, intent(in) :: may_cavitate, want_derivatives
      type(film_counters), intent(inout) :: counters
      type(pad_drive), intent(out) :: drive
      real(wp) :: d(simd_width), slope(simd_width, 3), side(2), along, room
      integer :: leading, trailing
      drive%value = seen%w
      drive%over_edges = 0
      drive%over_w = identity
      associate (w => seen%w)
         along = abs(w(1))
         room = along*tables%pad%tangent
         ! T = (1 - w_2/room)/2 > 0 where the film diverges, >= 1 where it does everywhere
         if (.not. (may_cavitate .and. w(2) < room)) return
         drive%empty = w(2) <= -room
         if (drive%empty) return
         ! where w_1 < 0 the film diverges at the leading edge: seen in a mirror, at the trailing one
         leading = merge(1, 2, w(1) > 0)
         trailing = 3 - leading
         side = [sign(1.0_wp, w(1)), 1.0_wp]
         call tables%cavitation%look_up(seen%edges([leading, trailing]), 0.5_wp*(1 - w(2)/room), want_derivatives, &
            & self%cavitation_cell, counters, d, slope, self%found)
         drive%value = w + (along*side)*d(1:2)
         drive%pressure_ratio = d(3)
         if (.not. want_derivatives) return
         drive%over_edges(:, leading) = (along*side)*slope(1:2, 1)
         drive%over_edges(:, trailing) = (along*side)*slope(1:2, 2)
         drive%over_w(:, 1) = identity(:, 1) + (side(1)*side)*(d(1:2) + (w(2)/(2*room))*slope(1:2, 3))
         drive%over_w(:, 2) = identity(:, 2) - (side/(2*tables%pad%tangent))*slope(1:2, 3)
      end associate
   end subroutine set_drive

   !> Force of a film with this drive and of the pressure at its leading edge, and its derivatives, unless `found`
   !> becomes false.
   subroutine set_force(self, tables, seen, drive, want_derivatives, counters, force)
      class(table_pad_type), intent(inout) :: self
      type(shape_tables), intent(inout) :: tables
      type(middle_motion), intent(in) :: seen
      type(pad_drive), intent(in) :: drive
      logical, intent(in) :: want_derivatives
      type(film_counters), intent(inout) :: counters
      type(middle_force), intent(out) :: force
      real(wp) :: value(simd_width, loads), slope(simd_width, 2, loads), m(simd_width)
      integer :: i
      call tables%whole%look_up(seen%edges, want_derivatives, self%whole_cell, counters, value, slope, self%found)
      if (.not. self%found) return
      m = seen%scale*value(:, 1)
      associate (v => drive%value)
         force%value = m(1:2)*v(1) + m(2:3)*v(2)
         if (want_derivatives) then
            do i = 1, 2
               force%over_w(:, i) = m(1:2)*drive%over_w(1, i) + m(2:3)*drive%over_w(2, i)
               ! S falls as the thickness to the power of -3/2
               force%over_edges(:, i) = seen%scale*(slope(1:2, i, 1)*v(1) + slope(2:3, i, 1)*v(2)) &
                  & + m(1:2)*drive%over_edges(1, i) + m(2:3)*drive%over_edges(2, i) - (1.5_wp/seen%edges(i))*force%value
            end do
         end if
      end associate
      if (.not. abs(self%rise) > 0) return
      force%value = force%value + (self%rise*self%square)*value(1:2, 2)
      if (want_derivatives) force%over_edges = force%over_edges + (self%rise*self%square)*slope(1:2, :, 2)
   end subroutine set_force

   !> Minimum and maximum pressure of a film that was found, in the middle plane.
   subroutine look_up_pressures(self, tables, motion, oil, speed, may_cavitate, counters, response)
      class(table_pad_type), intent(inout) :: self
      type(shape_tables), intent(inout) :: tables
      type(film_motion), intent(in) :: motion
      type(film_oil), intent(in) :: oil
      real(wp), intent(in) :: speed
      logical, intent(in) :: may_cavitate
      type(film_counters), intent(inout) :: counters
      type(film_response), intent(inout) :: response
      type(middle_motion) :: seen
      type(pad_drive) :: drive
      !> Pressure over that of the unit pad, Pa s/m.
      real(wp) :: unit_pressure
      real(wp) :: rise, highest, lowest
      logical :: good
      seen = self%frame%motion(motion, oil, speed)
      unit_pressure = oil%viscosity*self%square/self%gap%machined_clearance**3
      rise = self%rise/unit_pressure
      highest = 0
      lowest = 0
      call self%set_drive(tables, seen, may_cavitate, .false., counters, drive)
      if (.not. drive%empty) call tables%whole%highest_pressure(seen%edges, drive%value, rise, self%whole_cell, &
         & counters, highest, good)
      if (.not. may_cavitate) call tables%whole%highest_pressure(seen%edges, -seen%w, -rise, self%whole_cell, &
         & counters, lowest, good)
      highest = highest/max(drive%pressure_ratio, least_ratio)
      response%max_pressure = self%gap%ambient_pressure + unit_pressure*highest
      response%min_pressure = min(self%gap%ambient_pressure, self%gap%supply_pressure, &
         & self%gap%ambient_pressure - unit_pressure*lowest)
   end subroutine look_up_pressures
end module table_pad
