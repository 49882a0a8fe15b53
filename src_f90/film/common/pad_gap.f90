!> One pad's gap: geometry, clearance and the pressures around it; film thicknesses at a position of the journal.
!>
!> Pad coordinates: the angle phi from the pivot, positive towards the leading edge; the axial
!> coordinate from the middle of the pad.
module pad_gap
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: pad_gap_type, first_like, pad_directions, film_motion, over_arc

   !> Geometry and boundary pressures of one pad's film.
   type :: pad_gap_type
      !> Journal radius R_J, pad clearance c_m, axial length L, m.
      real(wp) :: journal_radius, machined_clearance, axial_length
      !> Angles from the pivot to the leading and trailing edge, theta_1 and theta_2, rad, > 0.
      real(wp) :: leading_angle, trailing_angle
      !> Pressure at the leading edge, at the other edges, and where the film cavitates, Pa.
      real(wp) :: supply_pressure, ambient_pressure, cavitation_pressure
   contains
      procedure :: differs
      procedure :: pad_radius
      procedure :: arc
      procedure :: thickness
      procedure :: thickness_slopes
      procedure :: directions
      procedure :: min_film_thickness
      procedure :: mean_film_thickness
      procedure :: thinnest_place
   end type pad_gap_type

   !> Motion of the journal seen from a pad; with the speed and the oil, all that the film force depends on.
   type :: film_motion
      !> (e_y', e_z'), m, and its rate, m/s, in the pad frame.
      real(wp) :: position(2) = 0, velocity(2) = 0
   end type film_motion

   !> (sin phi, cos phi) at the edges and the middle of the arc, and of half the arc.
   type :: pad_directions
      real(wp) :: leading(2), trailing(2), middle(2), half(2)
   end type pad_directions

contains

   !> True where two gaps are not the same.
   elemental logical function differs(self, other)
      class(pad_gap_type), intent(in) :: self, other
      differs = any(abs(numbers(self) - numbers(other)) > 0)
   contains
      pure function numbers(gap)
         class(pad_gap_type), intent(in) :: gap
         real(wp) :: numbers(8)
         numbers = [gap%journal_radius, gap%machined_clearance, gap%axial_length, gap%leading_angle, &
            & gap%trailing_angle, gap%supply_pressure, gap%ambient_pressure, gap%cavitation_pressure]
      end function numbers
   end function differs

   !> The number of the first of these gaps that is the same as the i-th.
   pure integer function first_like(gaps, i) result(first)
      type(pad_gap_type), intent(in) :: gaps(:)
      integer, intent(in) :: i
      do first = 1, i - 1
         if (.not. gaps(i)%differs(gaps(first))) return
      end do
   end function first_like

   !> R = R_J + c_m, m.
   pure function pad_radius(self)
      class(pad_gap_type), intent(in) :: self
      real(wp) :: pad_radius
      pad_radius = self%journal_radius + self%machined_clearance
   end function pad_radius

   !> Arc of the pad, rad.
   elemental function arc(self)
      class(pad_gap_type), intent(in) :: self
      real(wp) :: arc
      arc = self%leading_angle + self%trailing_angle
   end function arc

   !> h = c_m - e_y' sin(phi) - e_z' cos(phi), m.
   elemental function thickness(self, motion, sin_phi, cos_phi) result(h)
      class(pad_gap_type), intent(in) :: self
      type(film_motion), intent(in) :: motion
      real(wp), intent(in) :: sin_phi, cos_phi
      real(wp) :: h
      h = self%machined_clearance - motion%position(1)*sin_phi - motion%position(2)*cos_phi
   end function thickness

   !> ln(h/c_m) at nodes, and its first three slopes along the film: (node, order from 0).
   pure function thickness_slopes(self, motion, sine, cosine) result(slopes)
      class(pad_gap_type), intent(in) :: self
      type(film_motion), intent(in) :: motion
      real(wp), intent(in) :: sine(:), cosine(:)
      real(wp) :: slopes(size(sine), 0:3), h(size(sine))
      associate (e => motion%position/self%machined_clearance)
         h = 1 - e(1)*sine - e(2)*cosine
         slopes(:, 1) = (e(2)*sine - e(1)*cosine)/h
      end associate
      slopes(:, 0) = log(h)
      ! h'' = c_m - h
      slopes(:, 2) = (1 - h)/h - slopes(:, 1)**2
      slopes(:, 3) = -slopes(:, 1) - slopes(:, 1)*(1 - h)/h - 2*slopes(:, 1)*slopes(:, 2)
   end function thickness_slopes

   elemental function directions(self)
      class(pad_gap_type), intent(in) :: self
      type(pad_directions) :: directions
      directions%leading = [sin(self%leading_angle), cos(self%leading_angle)]
      directions%trailing = [-sin(self%trailing_angle), cos(self%trailing_angle)]
      associate (phi => 0.5_wp*(self%leading_angle - self%trailing_angle))
         directions%middle = [sin(phi), cos(phi)]
      end associate
      associate (half => 0.5_wp*self%arc())
         directions%half = [sin(half), cos(half)]
      end associate
   end function directions

   !> Minimum film thickness on the pad, m: inside the arc where h has a minimum there, else at an edge.
   pure function min_film_thickness(self, motion, directions) result(h)
      class(pad_gap_type), intent(in) :: self
      type(film_motion), intent(in) :: motion
      !> The pad's own, computed once.
      type(pad_directions), intent(in) :: directions
      real(wp) :: h, e
      e = sqrt(dot_product(motion%position, motion%position))
      if (dot_product(motion%position, directions%middle) > e*directions%half(2)) then
         h = self%machined_clearance - e
      else
         h = self%machined_clearance - max(dot_product(motion%position, directions%leading), &
            & dot_product(motion%position, directions%trailing))
      end if
   end function min_film_thickness

   !> Mean film thickness over the arc, m.
   pure real(wp) function mean_film_thickness(self, motion, directions) result(h)
      class(pad_gap_type), intent(in) :: self
      type(film_motion), intent(in) :: motion
      !> The pad's own, computed once.
      type(pad_directions), intent(in) :: directions
      h = self%machined_clearance - dot_product(motion%position, over_arc(directions))/self%arc()
   end function mean_film_thickness

   !> Integrals of sine and cosine over the arc.
   pure function over_arc(directions)
      type(pad_directions), intent(in) :: directions
      real(wp) :: over_arc(2)
      over_arc = [directions%trailing(2) - directions%leading(2), directions%leading(1) - directions%trailing(1)]
   end function over_arc

   !> The direction (sin phi, cos phi) of the pad's thinnest place, and how fast it turns as the journal moves across
   !> it, 1/m: not at all at an edge.
   pure subroutine thinnest_place(self, position, directions, towards, turning)
      class(pad_gap_type), intent(in) :: self
      !> (e_y', e_z'), m.
      real(wp), intent(in) :: position(2)
      type(pad_directions), intent(in) :: directions
      real(wp), intent(out) :: towards(2), turning
      real(wp) :: e
      e = sqrt(dot_product(position, position))
      turning = 0
      if (dot_product(position, directions%middle) > e*directions%half(2)) then
         towards = position/e
         turning = 1/e
      else if (dot_product(position, directions%leading) > dot_product(position, directions%trailing)) then
         towards = directions%leading
      else
         towards = directions%trailing
      end if
   end subroutine thinnest_place
end module pad_gap
