!> One pad's film from the tables of its shape: the force with its derivatives, and the highest pressure.
module table_pad
   use kinds, only: wp
   use film_solver, only: film_motion, film_law_type, film_response, film_counters
   use pad_gap, only: pad_gap_type, pad_directions
   use dimensionless_pad, only: dimensionless_pad_type, mid_arc_frame_type, middle_motion, middle_force, &
      & new_mid_arc_frame, thickness_scale
   use cell_polynomials, only: simd_width
   use full_film, only: full_film_type, full_film_forces
   use cavitated_film, only: cavitated_film_type, node_type, axes
   use rotation_drive, only: rotation_drive_type
   use film_law, only: most_numbers
   implicit none (type, external)
   private
   public :: table_pad_type, shape_tables, new_table_pad

   !> The films of pads of one shape, from tables or solved.
   type :: shape_tables
      type(dimensionless_pad_type) :: pad
      !> The films' law: its numbers, and what drives them besides w.
      real(wp) :: numbers(most_numbers) = 0
      type(rotation_drive_type) :: drive
      !> Whether they have a pressure of their own at the leading edge.
      logical :: supplied = .false.
      class(full_film_type), allocatable :: full
      class(cavitated_film_type), allocatable :: cavitation
   end type shape_tables

   !> A pad: its gap, how it differs from its shape, and the cells it was in last.
   type :: table_pad_type
      type(pad_gap_type) :: gap
      type(mid_arc_frame_type), private :: frame
      !> Which tables are the pad's; 0: none.
      integer :: shape = 0
      !> Whether all pressures around the pad are equal: then the tables know cavitated films, too.
      logical :: even_pressure
      !> Pressure at the leading edge above the ambient pressure, Pa; R^2, m^2.
      real(wp) :: rise
      real(wp), private :: square
      !> Force of the ambient pressure, N, in the pad frame.
      real(wp), private :: ambient_force(2)
      integer, private :: full_cell = 0, cavitation_cell = 0
   contains
      procedure :: look_up
      procedure :: look_up_pressures
      procedure, private :: set_part
      procedure, private :: set_force
      procedure, private :: set_cavitated_force
      procedure, private :: set_cavitated_pressure
      procedure, private :: set_pressures
      procedure, private :: add_rotation
   end type table_pad_type

   !> What cavitation leaves of the film that is just full: force and highest pressure over those of that film, forces
   !> as F_1 + i F_2, and the derivatives of the first over the edges' thicknesses and over w.
   type :: cavitated_part
      complex(wp) :: force = 1
      complex(wp) :: over_edges(2) = 0, over_w(2) = 0
      real(wp) :: pressure = 1
      !> Whether the table has it.
      logical :: found = .false.
   end type cavitated_part

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

   !> Force and its derivatives of an open film, where the tables have it: then the response is from tables.
   subroutine look_up(self, tables, motion, oil, speed, may_cavitate, want_derivatives, counters, response)
      class(table_pad_type), intent(inout) :: self
      type(shape_tables), intent(inout) :: tables
      type(film_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: speed
      logical, intent(in) :: may_cavitate, want_derivatives
      type(film_counters), intent(inout) :: counters
      type(film_response), intent(inout) :: response
      type(middle_motion) :: seen
      type(middle_force) :: force
      real(wp) :: part, highest
      logical :: found
      seen = self%frame%motion(motion, oil, speed)
      ! with different pressures around a film that may cavitate, all of it is solved: the force must not jump between
      ! two solvers where the film begins to diverge
      if (.not. (all(seen%edges > 0) .and. (self%even_pressure .or. .not. may_cavitate))) return
      call self%add_rotation(tables, may_cavitate, seen, part, found)
      if (.not. found) return
      response%lacks_pressures = .true.
      if (part >= 1) then
         response%force = self%ambient_force
         response%from_tables = .true.
         return
      end if
      if (part > 0) then
         call self%set_cavitated_force(tables, seen, part, want_derivatives, counters, force, found, highest)
         ! seen in a mirror the film that is just full is another one
         if (found .and. seen%w(1) > 0) call self%set_pressures(seen%w(1)*seen%scale*highest/self%square, 0.0_wp, &
            & response)
      else
         call self%set_force(tables, seen, seen%w, want_derivatives, counters, force, found, highest)
      end if
      if (.not. found) return
      response%from_tables = .true.
      response%force = self%ambient_force + self%frame%force(force)
      if (.not. want_derivatives) return
      ! where the rotation acts w changes with the thicknesses, too
      if (tables%drive%acts) force%over_edges = force%over_edges + seen%t*matmul(force%over_w, tables%drive%over_edges)
      response%derivatives = self%frame%derivatives(seen, force)
   end subroutine look_up

   !> Adds what the rotation drives besides to the motion in the middle, and finds T; `found` is true where the tables
   !> may have the film.
   pure subroutine add_rotation(self, tables, may_cavitate, seen, part, found)
      class(table_pad_type), intent(in) :: self
      type(shape_tables), intent(in) :: tables
      logical, intent(in) :: may_cavitate
      type(middle_motion), intent(inout) :: seen
      real(wp), intent(out) :: part
      logical, intent(out) :: found
      part = 0
      found = .true.
      if (.not. tables%drive%acts) then
         if (may_cavitate) part = diverging_part(tables%pad, seen%w)
         return
      end if
      associate (position => tables%pad%position(seen%edges), drive => tables%drive)
         seen%t = seen%turn*self%gap%machined_clearance
         seen%w = seen%w + seen%t*drive%velocity(position)
         if (.not. may_cavitate) return
         part = diverging_part(tables%pad, seen%w)
         ! the intervals of the table are those of a rotation forwards
         if (seen%t > 0 .and. drive%falls(position, seen%w, seen%t)) return
         part = 0
         found = drive%is_full(position, seen%w, seen%t)
      end associate
   end subroutine add_rotation

   !> T, the part of a film that diverges, driven by w: 0 or less where it is full, 1 or more where nothing of it is
   !> left.
   pure real(wp) function diverging_part(pad, w)
      type(dimensionless_pad_type), intent(in) :: pad
      real(wp), intent(in) :: w(2)
      associate (room => abs(w(1))*pad%tangent)
         diverging_part = 0
         if (w(2) >= room) return
         diverging_part = 1
         if (w(2) > -room) diverging_part = 0.5_wp*(1 - w(2)/room)
      end associate
   end function diverging_part

   !> The velocity at which the film that is driven by w would be just full.
   pure function onset(pad, w)
      type(dimensionless_pad_type), intent(in) :: pad
      real(wp), intent(in) :: w(2)
      real(wp) :: onset(2)
      onset = [w(1), abs(w(1))*pad%tangent]
   end function onset

   !> What is left of a film, 0 < T < 1, where the table has it.
   subroutine set_part(self, tables, seen, t, want_derivatives, counters, part)
      class(table_pad_type), intent(inout) :: self
      type(shape_tables), intent(inout) :: tables
      type(middle_motion), intent(in) :: seen
      real(wp), intent(in) :: t
      logical, intent(in) :: want_derivatives
      type(film_counters), intent(inout) :: counters
      type(cavitated_part), intent(out) :: part
      type(node_type) :: node
      real(wp) :: place(axes), drive
      complex(wp) :: slopes(axes)
      integer :: leading, trailing
      associate (w => seen%w)
         ! where w_1 < 0 the film diverges at the leading edge: seen in a mirror, at the trailing one
         leading = merge(1, 2, w(1) > 0)
         trailing = 3 - leading
         drive = 0
         if (tables%drive%acts) drive = seen%t/w(1)
         place = [seen%edges([leading, trailing]), t, drive]
         call tables%cavitation%look_up(place, want_derivatives, self%cavitation_cell, counters, node)
         part%found = node%ok
         if (.not. part%found) return
         call tables%cavitation%set_ratio(t, node, part%force, slopes, part%pressure)
         if (.not. w(1) > 0) then
            part%force = conjg(part%force)
            slopes = conjg(slopes)
         end if
         part%over_edges([leading, trailing]) = slopes(:2)
         part%over_w = slopes(3)*[(0.5_wp - t)/w(1), -0.5_wp/(abs(w(1))*tables%pad%tangent)]
         if (tables%drive%acts) part%over_w(1) = part%over_w(1) - slopes(4)*drive/w(1)
      end associate
   end subroutine set_part

   !> Force of a cavitated film, 0 < T < 1, and its derivatives, where they are found; `highest`: where w_1 > 0 its
   !> highest pressure over w_1 and the thickness scale, as of the unit pad.
   subroutine set_cavitated_force(self, tables, seen, t, want_derivatives, counters, force, found, highest)
      class(table_pad_type), intent(inout) :: self
      type(shape_tables), intent(inout) :: tables
      type(middle_motion), intent(in) :: seen
      real(wp), intent(in) :: t
      logical, intent(in) :: want_derivatives
      type(film_counters), intent(inout) :: counters
      type(middle_force), intent(out) :: force
      logical, intent(out) :: found
      real(wp), intent(out) :: highest
      type(cavitated_part) :: part
      type(middle_force) :: full
      complex(wp) :: full_force
      integer :: i
      call self%set_part(tables, seen, t, want_derivatives, counters, part)
      found = part%found
      if (.not. found) return
      call self%set_force(tables, seen, onset(tables%pad, seen%w), want_derivatives, counters, full, found, highest)
      if (.not. found) return
      highest = highest*part%pressure
      full_force = cmplx(full%value(1), full%value(2), wp)
      force%value = vector_of(part%force*full_force)
      if (.not. want_derivatives) return
      do i = 1, 2
         associate (over_edge => cmplx(full%over_edges(1, i), full%over_edges(2, i), wp))
            force%over_edges(:, i) = vector_of(part%force*over_edge + part%over_edges(i)*full_force)
         end associate
      end do
      ! the full film's force is proportional to w_1, but for that of D
      if (tables%drive%acts) then
         associate (full_over_w => cmplx(full%over_w(1, 1), full%over_w(2, 1), wp) + sign(1.0_wp, seen%w(1)) &
            & *tables%pad%tangent*cmplx(full%over_w(1, 2), full%over_w(2, 2), wp))
            force%over_w(:, 1) = vector_of(part%force*full_over_w + part%over_w(1)*full_force)
         end associate
      else
         force%over_w(:, 1) = vector_of((part%force/seen%w(1) + part%over_w(1))*full_force)
      end if
      force%over_w(:, 2) = vector_of(part%over_w(2)*full_force)
   end subroutine set_cavitated_force

   !> Force of a full film driven by w, by the rotation and by the pressure at its leading edge, and its derivatives,
   !> where they are found; `highest`: the highest pressure of the film that is just full, over w_1 and the thickness
   !> scale, as of the unit pad.
   subroutine set_force(self, tables, seen, w, want_derivatives, counters, force, found, highest)
      class(table_pad_type), intent(inout) :: self
      type(shape_tables), intent(inout) :: tables
      type(middle_motion), intent(in) :: seen
      real(wp), intent(in) :: w(2)
      logical, intent(in) :: want_derivatives
      type(film_counters), intent(inout) :: counters
      type(middle_force), intent(out) :: force
      logical, intent(out) :: found
      real(wp), intent(out) :: highest
      type(full_film_forces) :: film
      real(wp) :: m(simd_width)
      integer :: i
      call tables%full%look_up(seen%edges, want_derivatives, self%full_cell, counters, film, found)
      if (.not. found) return
      highest = film%of_velocity(4)
      m = seen%scale*film%of_velocity
      force%value = m(1:2)*w(1) + m(2:3)*w(2)
      if (want_derivatives) then
         force%over_w(:, 1) = m(1:2)
         force%over_w(:, 2) = m(2:3)
         do i = 1, 2
            ! S falls as the thickness to the power of -3/2
            force%over_edges(:, i) = seen%scale*(film%velocity_slopes(1:2, i)*w(1) &
               & + film%velocity_slopes(2:3, i)*w(2)) - (1.5_wp/seen%edges(i))*force%value
         end do
      end if
      if (tables%drive%acts) then
         force%value = force%value + (seen%t*seen%scale)*film%of_rotation(1:2)
         if (.not. want_derivatives) return
         do i = 1, 2
            force%over_edges(:, i) = force%over_edges(:, i) + (seen%t*seen%scale)*(film%rotation_slopes(1:2, i) &
               & - (1.5_wp/seen%edges(i))*film%of_rotation(1:2))
         end do
      end if
      if (.not. abs(self%rise) > 0) return
      force%value = force%value + (self%rise*self%square)*film%of_supply(1:2)
      if (want_derivatives) force%over_edges = force%over_edges + (self%rise*self%square)*film%supply_slopes(1:2, :)
   end subroutine set_force

   !> Minimum and maximum pressure of a film from the tables, in the middle plane; it is not from them any more where
   !> they have forgotten it.
   subroutine look_up_pressures(self, tables, motion, oil, speed, may_cavitate, counters, response)
      class(table_pad_type), intent(inout) :: self
      type(shape_tables), intent(inout) :: tables
      type(film_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: speed
      logical, intent(in) :: may_cavitate
      type(film_counters), intent(inout) :: counters
      type(film_response), intent(inout) :: response
      type(middle_motion) :: seen
      !> Pressure over that of the unit pad, Pa s/m.
      real(wp) :: unit_pressure
      real(wp) :: rise, highest, lowest, t
      logical :: found
      seen = self%frame%motion(motion, oil, speed)
      unit_pressure = oil%viscosity*self%square/self%gap%machined_clearance**3
      call self%add_rotation(tables, may_cavitate, seen, t, found)
      rise = merge(seen%t, self%rise/unit_pressure, tables%drive%acts)
      ! the film in a mirror has another law
      if (tables%drive%acts .and. t > 0 .and. t < 1) found = seen%w(1) > 0
      highest = 0
      lowest = 0
      if (found .and. t > 0 .and. t < 1) then
         call self%set_cavitated_pressure(tables, seen, t, counters, highest, found)
      else if (found .and. .not. t > 0) then
         call tables%full%highest_pressure(seen%edges, seen%w, rise, self%full_cell, counters, highest)
      end if
      response%from_tables = found
      if (.not. found) return
      if (.not. may_cavitate) call tables%full%highest_pressure(seen%edges, -seen%w, -rise, self%full_cell, &
         & counters, lowest)
      call self%set_pressures(unit_pressure*highest, unit_pressure*lowest, response)
   end subroutine look_up_pressures

   !> Sets the pressures of a film by how far they are above and below those around the pad, Pa.
   pure subroutine set_pressures(self, highest, lowest, response)
      class(table_pad_type), intent(in) :: self
      real(wp), intent(in) :: highest, lowest
      type(film_response), intent(inout) :: response
      response%max_pressure = self%gap%ambient_pressure + highest
      response%min_pressure = min(self%gap%ambient_pressure, self%gap%supply_pressure, &
         & self%gap%ambient_pressure - lowest)
      response%lacks_pressures = .false.
   end subroutine set_pressures

   !> The highest pressure of a cavitated film of the unit pad, 0 < T < 1, where it is found.
   subroutine set_cavitated_pressure(self, tables, seen, t, counters, highest, found)
      class(table_pad_type), intent(inout) :: self
      type(shape_tables), intent(inout) :: tables
      type(middle_motion), intent(in) :: seen
      real(wp), intent(in) :: t
      type(film_counters), intent(inout) :: counters
      real(wp), intent(out) :: highest
      logical, intent(out) :: found
      type(cavitated_part) :: part
      type(full_film_forces) :: film
      real(wp) :: edges(2)
      logical :: good
      highest = 0
      call self%set_part(tables, seen, t, .false., counters, part)
      found = part%found
      if (.not. found) return
      ! where w_1 < 0 as in a mirror
      edges = seen%edges
      if (.not. seen%w(1) > 0) edges = [edges(2), edges(1)]
      call tables%full%look_up(edges, .false., self%full_cell, counters, film, good)
      highest = abs(seen%w(1))*thickness_scale(edges(1), edges(2))*film%of_velocity(4)*part%pressure
   end subroutine set_cavitated_pressure

   pure function vector_of(number) result(vector)
      complex(wp), intent(in) :: number
      real(wp) :: vector(2)
      vector = [real(number), aimag(number)]
   end function vector_of
end module table_pad
