!> One pad's film from the tables of its shape: the force with its derivatives, and the highest pressure.
module table_pad
   use kinds, only: wp
   use film_solver, only: film_motion, film_oil, film_response, film_counters
   use pad_gap, only: pad_gap_type, pad_directions
   use dimensionless_pad, only: dimensionless_pad_type, mid_arc_frame_type, middle_motion, middle_force, &
      & new_mid_arc_frame, thickness_scale
   use cell_polynomials, only: simd_width
   use full_film, only: full_film_type, loads
   use cavitated_film, only: cavitated_film_type, axes
   use uneven_drive, only: uneven_drive_type
   implicit none (type, external)
   private
   public :: table_pad_type, shape_tables, new_table_pad

   !> The films of pads of one shape, from tables or solved.
   type :: shape_tables
      type(dimensionless_pad_type) :: pad
      !> Of uneven oil, which is that of one pad alone.
      type(uneven_drive_type) :: drive
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
      procedure, private :: set_part
      procedure, private :: set_force
      procedure, private :: set_cavitated_force
      procedure, private :: cavitated_pressure
   end type table_pad_type

   !> What cavitation leaves of the film that is just full: force and highest pressure over those of that film, forces
   !> as F_1 + i F_2, and the derivatives of the first over the edges' thicknesses and over w.
   type :: cavitated_part
      complex(wp) :: force = 1
      complex(wp) :: over_edges(2) = 0, over_w(2) = 0
      real(wp) :: pressure = 1
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
      real(wp) :: part
      seen = self%frame%motion(motion, oil, speed)
      ! with different pressures around a film that may cavitate, all of it is solved: the force must not jump between
      ! two solvers where the film begins to diverge
      self%found = all(seen%edges > 0) .and. (self%even_pressure .or. .not. may_cavitate)
      if (.not. self%found) return
      part = 0
      if (tables%drive%acts) then
         call drive_unevenly(self, tables, may_cavitate, seen, part)
         if (.not. self%found) return
      else if (may_cavitate) then
         part = diverging_part(tables%pad, seen%w)
      end if
      if (part >= 1) then
         response%force = self%ambient_force
         return
      end if
      if (part > 0) then
         call self%set_cavitated_force(tables, seen, part, want_derivatives, counters, force)
      else
         call self%set_force(tables, seen, seen%w, want_derivatives, counters, force)
      end if
      if (.not. self%found) return
      response%force = self%ambient_force + self%frame%force(force)
      if (.not. want_derivatives) return
      if (tables%drive%acts) then
         ! of uneven oil w changes with the thicknesses, too
         force%over_edges = force%over_edges + seen%t*matmul(force%over_w, tables%drive%over_edges)
      end if
      response%derivatives = self%frame%derivatives(seen, force)
   end subroutine look_up

   !> Adds what drives uneven oil to the motion in the middle, and finds T; `found` becomes true where the tables may
   !> have the film.
   subroutine drive_unevenly(self, tables, may_cavitate, seen, part)
      class(table_pad_type), intent(inout) :: self
      type(shape_tables), intent(in) :: tables
      logical, intent(in) :: may_cavitate
      type(middle_motion), intent(inout) :: seen
      real(wp), intent(out) :: part
      part = 0
      associate (position => tables%pad%position(seen%edges), drive => tables%drive)
         seen%t = seen%turn*self%gap%machined_clearance
         seen%w = seen%w + seen%t*drive%velocity(position)
         if (.not. may_cavitate) return
         part = diverging_part(tables%pad, seen%w)
         ! the intervals of the table are those of a rotation forwards
         if (seen%t > 0 .and. drive%falls(position, seen%w, seen%t)) return
         part = 0
         self%found = drive%is_full(position, seen%w, seen%t)
      end associate
   end subroutine drive_unevenly

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

   !> What is left of a film, 0 < T < 1; `found` becomes false where the table does not have it.
   subroutine set_part(self, tables, seen, t, want_derivatives, counters, part)
      class(table_pad_type), intent(inout) :: self
      type(shape_tables), intent(inout) :: tables
      type(middle_motion), intent(in) :: seen
      real(wp), intent(in) :: t
      logical, intent(in) :: want_derivatives
      type(film_counters), intent(inout) :: counters
      type(cavitated_part), intent(out) :: part
      real(wp) :: value(simd_width), slope(simd_width, axes), place(axes), drive
      complex(wp) :: slopes(axes)
      integer :: leading, trailing
      associate (w => seen%w)
         ! where w_1 < 0 the film diverges at the leading edge: seen in a mirror, at the trailing one
         leading = merge(1, 2, w(1) > 0)
         trailing = 3 - leading
         drive = 0
         if (tables%drive%acts) drive = seen%t/w(1)
         place(1) = seen%edges(leading)
         place(2) = seen%edges(trailing)
         place(3) = t
         place(4) = drive
         call tables%cavitation%look_up(place, want_derivatives, self%cavitation_cell, counters, value, slope, &
            & self%found)
         if (.not. self%found) return
         call tables%cavitation%set_ratio(t, value, slope, part%force, slopes, part%pressure)
         if (.not. w(1) > 0) then
            part%force = conjg(part%force)
            slopes = conjg(slopes)
         end if
         part%over_edges([leading, trailing]) = slopes(:2)
         part%over_w = slopes(3)*[(0.5_wp - t)/w(1), -0.5_wp/(abs(w(1))*tables%pad%tangent)]
         if (tables%drive%acts) part%over_w(1) = part%over_w(1) - slopes(4)*drive/w(1)
      end associate
   end subroutine set_part

   !> Force of a cavitated film, 0 < T < 1, and its derivatives, unless `found` becomes false.
   subroutine set_cavitated_force(self, tables, seen, t, want_derivatives, counters, force)
      class(table_pad_type), intent(inout) :: self
      type(shape_tables), intent(inout) :: tables
      type(middle_motion), intent(in) :: seen
      real(wp), intent(in) :: t
      logical, intent(in) :: want_derivatives
      type(film_counters), intent(inout) :: counters
      type(middle_force), intent(out) :: force
      type(cavitated_part) :: part
      type(middle_force) :: full
      complex(wp) :: full_force
      integer :: i
      call self%set_part(tables, seen, t, want_derivatives, counters, part)
      if (.not. self%found) return
      call self%set_force(tables, seen, onset(tables%pad, seen%w), want_derivatives, counters, full)
      if (.not. self%found) return
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

   !> Force of a full film driven by w and by the pressure at its leading edge, and its derivatives, unless `found`
   !> becomes false.
   subroutine set_force(self, tables, seen, w, want_derivatives, counters, force)
      class(table_pad_type), intent(inout) :: self
      type(shape_tables), intent(inout) :: tables
      type(middle_motion), intent(in) :: seen
      real(wp), intent(in) :: w(2)
      logical, intent(in) :: want_derivatives
      type(film_counters), intent(inout) :: counters
      type(middle_force), intent(out) :: force
      real(wp) :: value(simd_width, loads), slope(simd_width, 2, loads), m(simd_width)
      integer :: i
      call tables%whole%look_up(seen%edges, want_derivatives, self%whole_cell, counters, value, slope, self%found)
      if (.not. self%found) return
      m = seen%scale*value(:, 1)
      force%value = m(1:2)*w(1) + m(2:3)*w(2)
      if (want_derivatives) then
         force%over_w(:, 1) = m(1:2)
         force%over_w(:, 2) = m(2:3)
         do i = 1, 2
            ! S falls as the thickness to the power of -3/2
            force%over_edges(:, i) = seen%scale*(slope(1:2, i, 1)*w(1) + slope(2:3, i, 1)*w(2)) &
               & - (1.5_wp/seen%edges(i))*force%value
         end do
      end if
      if (tables%drive%acts) then
         force%value = force%value + (seen%t*seen%scale)*value(1:2, 2)
         if (.not. want_derivatives) return
         do i = 1, 2
            force%over_edges(:, i) = force%over_edges(:, i) + (seen%t*seen%scale)*(slope(1:2, i, 2) &
               & - (1.5_wp/seen%edges(i))*value(1:2, 2))
         end do
      end if
      if (.not. abs(self%rise) > 0) return
      force%value = force%value + (self%rise*self%square)*value(1:2, 2)
      if (want_derivatives) force%over_edges = force%over_edges + (self%rise*self%square)*slope(1:2, :, 2)
   end subroutine set_force

   !> Minimum and maximum pressure of a film that was found, in the middle plane; `found` becomes false where the tables
   !> have forgotten it.
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
      !> Pressure over that of the unit pad, Pa s/m.
      real(wp) :: unit_pressure
      real(wp) :: rise, highest, lowest, t
      seen = self%frame%motion(motion, oil, speed)
      t = 0
      unit_pressure = oil%viscosity*self%square/self%gap%machined_clearance**3
      rise = self%rise/unit_pressure
      if (tables%drive%acts) then
         call drive_unevenly(self, tables, may_cavitate, seen, t)
         rise = seen%t
         ! the film in a mirror has another oil
         if (t > 0 .and. t < 1) self%found = seen%w(1) > 0
         if (.not. self%found) return
      else if (may_cavitate) then
         t = diverging_part(tables%pad, seen%w)
      end if
      highest = 0
      lowest = 0
      if (t > 0 .and. t < 1) then
         highest = self%cavitated_pressure(tables, seen, t, counters)
      else if (.not. t > 0) then
         call tables%whole%highest_pressure(seen%edges, seen%w, rise, self%whole_cell, counters, highest)
      end if
      if (.not. may_cavitate) call tables%whole%highest_pressure(seen%edges, -seen%w, -rise, self%whole_cell, &
         & counters, lowest)
      if (.not. self%found) return
      response%max_pressure = self%gap%ambient_pressure + unit_pressure*highest
      response%min_pressure = min(self%gap%ambient_pressure, self%gap%supply_pressure, &
         & self%gap%ambient_pressure - unit_pressure*lowest)
   end subroutine look_up_pressures

   !> The highest pressure of a cavitated film of the unit pad, 0 < T < 1, unless `found` becomes false.
   real(wp) function cavitated_pressure(self, tables, seen, t, counters)
      class(table_pad_type), intent(inout) :: self
      type(shape_tables), intent(inout) :: tables
      type(middle_motion), intent(in) :: seen
      real(wp), intent(in) :: t
      type(film_counters), intent(inout) :: counters
      type(cavitated_part) :: part
      real(wp) :: value(simd_width, loads), slope(simd_width, 2, loads)
      logical :: good
      cavitated_pressure = 0
      call self%set_part(tables, seen, t, .false., counters, part)
      if (.not. self%found) return
      associate (edges => seen%edges)
         ! where w_1 < 0 as in a mirror
         call tables%whole%look_up(merge(edges, edges([2, 1]), seen%w(1) > 0), .false., self%whole_cell, counters, &
            & value, slope, good)
         cavitated_pressure = abs(seen%w(1))*thickness_scale(edges(1), edges(2))*value(4, 1)*part%pressure
      end associate
   end function cavitated_pressure

   pure function vector_of(number) result(vector)
      complex(wp), intent(in) :: number
      real(wp) :: vector(2)
      vector = [real(number), aimag(number)]
   end function vector_of
end module table_pad
