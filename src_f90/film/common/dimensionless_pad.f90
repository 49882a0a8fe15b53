!> A pad in numbers without dimension: what its film depends on, and nothing else (docs/theory/film.md, *The table*).
!>
!> The frame is that of the pad's middle, lengths along the film are over the pad's radius R, film thicknesses over the
!> pad clearance c. Wedge and squeeze drive a film together, by the velocity
!>    w = velocity + omega R_J/(2 R) (e_2, -e_1),
!> and its force is mu R^4/c^3 times one that follows from the film thicknesses at the two edges and from w alone.
!> Between this frame and the pad's own the mid-arc frame takes the motion there, forces and their derivatives back.
module dimensionless_pad
   use kinds, only: wp
   use film_law, only: film_law_type
   use film_oils, only: film_oil
   use pad_gap, only: pad_gap_type, pad_directions, film_motion
   use sommerfeld_nodes, only: span, place_nodes
   implicit none (type, external)
   private
   public :: dimensionless_pad_type, unit_oil, new_dimensionless_pad, thickness_scale
   public :: mid_arc_frame_type, middle_motion, middle_force, new_mid_arc_frame

   !> The oil in the films of such pads.
   type(film_oil), parameter :: unit_oil = film_oil(1.0_wp)

   type :: dimensionless_pad_type
      !> Half the arc, rad; axial length over pad radius.
      real(wp) :: half_arc = 0, length = 0
      !> Sine, cosine and tangent of half the arc.
      real(wp) :: sine = 0, cosine = 0, tangent = 0
   contains
      procedure :: position
      procedure :: least_film
      procedure :: over_edges
      procedure :: spread_angles
      procedure :: gap
   end type dimensionless_pad_type

   !> What turns and scales.
   type :: mid_arc_frame_type
      private
      !> Sine and cosine of the angle from pivot to middle; of half the arc, over the clearance.
      real(wp) :: sine, cosine, edge_sine, edge_cosine
      !> R^4, m^4; c^3, m^3; R_J/(2 R).
      real(wp) :: radius_4, clearance_3, half_speed
   contains
      procedure :: motion
      procedure :: force
      procedure :: derivatives
   end type mid_arc_frame_type

   !> A motion in the mid-arc frame: film thicknesses at the leading and trailing edge over the clearance; the
   !> velocity w that drives the film, m/s; its turn with the journal, 1/s; S, N s/m,
   !> that is mu R^4/c^3 times the thickness scale; t, the turn times the clearance, m/s, where oil is uneven.
   type :: middle_motion
      real(wp) :: edges(2), w(2), turn, scale, t = 0
   end type middle_motion

   !> A force in the mid-arc frame, N, and its derivatives over the edges' thicknesses, (component, edge), and
   !> over w, (component, component of w).
   type :: middle_force
      real(wp) :: value(2), over_edges(2, 2), over_w(2, 2)
   end type middle_force

contains

   pure type(dimensionless_pad_type) function new_dimensionless_pad(gap) result(pad)
      type(pad_gap_type), intent(in) :: gap
      pad%half_arc = 0.5_wp*gap%arc()
      pad%length = gap%axial_length/gap%pad_radius()
      pad%sine = sin(pad%half_arc)
      pad%cosine = cos(pad%half_arc)
      pad%tangent = pad%sine/pad%cosine
   end function new_dimensionless_pad

   !> The position of the journal that leaves these film thicknesses at the leading and the trailing edge.
   pure function position(self, edges)
      class(dimensionless_pad_type), intent(in) :: self
      real(wp), intent(in) :: edges(2)
      real(wp) :: position(2)
      position = [(edges(2) - edges(1))/(2*self%sine), (1 - 0.5_wp*(edges(1) + edges(2)))/self%cosine]
   end function position

   !> The least film thickness between these at the edges, over the clearance; below 0 where the film is closed.
   pure real(wp) function least_film(self, edges)
      class(dimensionless_pad_type), intent(in) :: self
      real(wp), intent(in) :: edges(2)
      real(wp) :: e(2)
      e = self%position(edges)
      least_film = minval(edges)
      ! where it lies inside the arc
      if (e(2) > norm2(e)*self%cosine) least_film = 1 - norm2(e)
   end function least_film

   !> Derivatives over the film thicknesses at the edges from those over the position of the journal.
   pure function over_edges(self, over_position)
      class(dimensionless_pad_type), intent(in) :: self
      real(wp), intent(in) :: over_position(2)
      real(wp) :: over_edges(2)
      associate (tilted => over_position(1)/(2*self%sine), lifted => over_position(2)/(2*self%cosine))
         over_edges = [-tilted - lifted, tilted - lifted]
      end associate
   end function over_edges

   !> Angles from the middle, rad, (0:n), that cut an arc into n parts with the same integral of 1/h each, for the
   !> journal at this position, which leaves the film open: they crowd where it is thin.
   pure function spread_angles(self, position, from, to, n) result(angles)
      class(dimensionless_pad_type), intent(in) :: self
      real(wp), intent(in) :: position(2), from, to
      integer, intent(in) :: n
      real(wp) :: angles(0:n)
      real(wp), dimension(0:n) :: h, sine, cosine
      type(pad_gap_type) :: part
      part = self%gap(0.0_wp)
      part%leading_angle = to
      part%trailing_angle = -from
      associate (d => part%directions())
         call place_nodes(n, span(position, d%middle, d%half)/n, position, d, h, sine, cosine)
      end associate
      angles = atan2(sine, cosine)
      angles(0) = from
      angles(n) = to
   end function spread_angles

   !> The pad for the solvers of films: radius and clearance 1, pressure at the leading edge alone.
   pure type(pad_gap_type) function gap(self, supply_pressure)
      class(dimensionless_pad_type), intent(in) :: self
      real(wp), intent(in) :: supply_pressure
      gap = pad_gap_type(0.0_wp, 1.0_wp, self%length, self%half_arc, self%half_arc, supply_pressure, 0.0_wp, &
         & 0.0_wp)
   end function gap

   !> What forces are tabulated over: their growth as the film becomes thin.
   elemental real(wp) function thickness_scale(leading, trailing)
      real(wp), intent(in) :: leading, trailing
      associate (product => leading*trailing)
         thickness_scale = 1/(product*sqrt(product))
      end associate
   end function thickness_scale

   pure type(mid_arc_frame_type) function new_mid_arc_frame(gap, pad) result(frame)
      type(pad_gap_type), intent(in) :: gap
      type(dimensionless_pad_type), intent(in) :: pad
      type(pad_directions) :: directions
      directions = gap%directions()
      frame%sine = directions%middle(1)
      frame%cosine = directions%middle(2)
      frame%edge_sine = pad%sine/gap%machined_clearance
      frame%edge_cosine = pad%cosine/gap%machined_clearance
      frame%half_speed = gap%journal_radius/(2*gap%pad_radius())
      frame%radius_4 = gap%pad_radius()**4
      frame%clearance_3 = gap%machined_clearance**3
   end function new_mid_arc_frame

   !> The motion of the journal, seen from the middle, with an oil, at a journal speed, rad/s.
   pure type(middle_motion) function motion(self, seen, oil, speed)
      class(mid_arc_frame_type), intent(in) :: self
      type(film_motion), intent(in) :: seen
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: speed
      real(wp) :: at(2)
      associate (s => self%sine, c => self%cosine, e => seen%position, v => seen%velocity)
         at = [e(1)*c - e(2)*s, e(1)*s + e(2)*c]
         motion%turn = self%half_speed*speed
         motion%w = [v(1)*c - v(2)*s + motion%turn*at(2), v(1)*s + v(2)*c - motion%turn*at(1)]
         motion%edges = 1 - at(2)*self%edge_cosine + [-at(1), at(1)]*self%edge_sine
         motion%scale = oil%viscosity*self%radius_4/self%clearance_3*thickness_scale(motion%edges(1), motion%edges(2))
      end associate
   end function motion

   !> A force in the pad's frame, N.
   pure function force(self, seen)
      class(mid_arc_frame_type), intent(in) :: self
      type(middle_force), intent(in) :: seen
      real(wp) :: force(2)
      associate (s => self%sine, c => self%cosine, f => seen%value)
         force = [f(1)*c + f(2)*s, f(2)*c - f(1)*s]
      end associate
   end function force

   !> Derivatives of the force in the pad's frame over position and velocity there.
   pure function derivatives(self, motion, force)
      class(mid_arc_frame_type), intent(in) :: self
      type(middle_motion), intent(in) :: motion
      type(middle_force), intent(in) :: force
      real(wp) :: derivatives(2, 4), over(2, 4)
      integer :: i
      associate (s => self%sine, c => self%cosine)
         ! over position and velocity in the mid-arc frame
         associate (leading => force%over_edges(:, 1), trailing => force%over_edges(:, 2))
            over(:, 1) = self%edge_sine*(trailing - leading) - motion%turn*force%over_w(:, 2)
            over(:, 2) = -self%edge_cosine*(leading + trailing) + motion%turn*force%over_w(:, 1)
         end associate
         over(:, 3:) = force%over_w
         do i = 1, 3, 2
            derivatives(:, i) = over(:, i)*c + over(:, i + 1)*s
            derivatives(:, i + 1) = over(:, i + 1)*c - over(:, i)*s
         end do
         do i = 1, 4
            derivatives(:, i) = [derivatives(1, i)*c + derivatives(2, i)*s, derivatives(2, i)*c - derivatives(1, i)*s]
         end do
      end associate
   end function derivatives
end module dimensionless_pad
