!> What drives the film of a dimensionless pad besides one velocity (docs/theory/film.md, *Tables of variable
!> viscosity*).
!>
!> Where sliding carries G/2 of the thickness (film_law), with k = ((G - 1) h)', the rotation t = omega R_J/(2 R) drives
!> the film by t (e_2, -e_1) and by t k. Most of k is a velocity, a sin(phi) + b cos(phi) with the values of k at both
!> edges; it joins the velocity w. What remains of k is a drive D that vanishes at both edges. A film is therefore that
!> of its edges, of w and of t.
module rotation_drive
   use kinds, only: wp
   use film_law, only: film_law_type, law_at_nodes
   use pad_gap, only: pad_gap_type, film_motion
   use dimensionless_pad, only: dimensionless_pad_type
   implicit none (type, external)
   private
   public :: rotation_drive_type, new_rotation_drive

   !> Places between the edges at which the drive is looked at; the part of its slope that D leaves at least.
   integer, parameter :: places = 16
   real(wp), parameter :: least_slope = 0.1_wp

   type :: rotation_drive_type
      !> Whether the rotation drives the film besides w; else what follows the gap says nothing.
      logical :: acts = .false.
      !> The film's law, of viscosity 1.
      class(film_law_type), allocatable :: oil
      !> The unit pad, with the clearance 1. Where the rotation acts it has a journal of the radius 1, so that its own
      !> is 2: forces and pressures over those of a pad of the radius 1; omega over t.
      type(pad_gap_type) :: gap
      real(wp) :: force_unit = 1, pressure_unit = 1, speed_unit = 0
      !> (a, b) at t = 1: at e = 0, and derivatives over e and over the edges' thicknesses, (component, axis).
      real(wp) :: at_centre(2) = 0, over_position(2, 2) = 0, over_edges(2, 2) = 0
      type(dimensionless_pad_type), private :: pad
      !> At the places, tan(phi), and D/cos(phi) and cos(phi)^2 times its derivative at e = 0 and over e.
      real(wp), private :: tangent(places) = 0, rest(places, 0:2) = 0, slope(places, 0:2) = 0
   contains
      procedure :: velocity
      procedure :: by_rotation
      procedure :: still
      procedure :: turning_angle
      procedure :: falls
      procedure :: is_full
   end type rotation_drive_type

contains

   !> The drive in a pad with the law of an oil.
   type(rotation_drive_type) function new_rotation_drive(pad, oil) result(drive)
      type(dimensionless_pad_type), intent(in) :: pad
      class(film_law_type), intent(in) :: oil
      drive%acts = oil%slides_unevenly()
      drive%pad = pad
      drive%oil = oil
      drive%oil%viscosity = 1
      drive%gap = pad%gap(0.0_wp)
      if (.not. drive%acts) return
      drive%gap%journal_radius = 1
      drive%gap%axial_length = 2*pad%length
      drive%force_unit = 16
      drive%pressure_unit = 4
      drive%speed_unit = 4
      call set_places(drive)
   end function new_rotation_drive

   pure subroutine set_places(drive)
      type(rotation_drive_type), intent(inout) :: drive
      type(law_at_nodes) :: law
      !> From the trailing edge to the leading one: k, and its derivative, at e = 0 and over e.
      real(wp), dimension(places + 2, 0:2) :: k, change
      real(wp) :: phi(places + 2), s(places + 2), c(places + 2), g(places + 2), velocity(2, 0:2)
      integer :: i
      phi = drive%pad%half_arc*[(2*i/(places + 1.0_wp) - 1, i=0, places + 1)]
      s = sin(phi)
      c = cos(phi)
      ! G is that of any thickness
      call drive%oil%at_nodes(drive%gap, film_motion(), s, c, law)
      g = law%sliding - 1
      associate (g_1 => law%sliding_slopes(:, 1), g_2 => law%sliding_slopes(:, 2))
         ! h = 1 - e_1 sin(phi) - e_2 cos(phi)
         k(:, 0) = g_1
         k(:, 1) = -g_1*s - g*c
         k(:, 2) = -g_1*c + g*s
         change(:, 0) = g_2
         change(:, 1) = -g_2*s - 2*g_1*c + g*s
         change(:, 2) = -g_2*c + 2*g_1*s + g*c
      end associate
      associate (last => places + 2, pad => drive%pad)
         do i = 0, 2
            ! the velocity with these values at both edges
            velocity(:, i) = [(k(last, i) - k(1, i))/(2*pad%sine), (k(last, i) + k(1, i))/(2*pad%cosine)]
            k(:, i) = k(:, i) - velocity(1, i)*s - velocity(2, i)*c
            change(:, i) = change(:, i) - velocity(1, i)*c + velocity(2, i)*s
         end do
         drive%at_centre = velocity(:, 0)
         drive%over_position = velocity(:, 1:)
         do i = 1, 2
            drive%over_edges(i, :) = pad%over_edges(drive%over_position(i, :))
         end do
      end associate
      drive%tangent = s(2:places + 1)/c(2:places + 1)
      do i = 0, 2
         drive%rest(:, i) = k(2:places + 1, i)/c(2:places + 1)
         drive%slope(:, i) = change(2:places + 1, i)*c(2:places + 1) + k(2:places + 1, i)*s(2:places + 1)
      end do
   end subroutine set_places

   !> (a, b) at t = 1, for a position of the journal.
   pure function velocity(self, position)
      class(rotation_drive_type), intent(in) :: self
      real(wp), intent(in) :: position(2)
      real(wp) :: velocity(2)
      velocity = self%at_centre + self%over_position(:, 1)*position(1) + self%over_position(:, 2)*position(2)
   end function velocity

   !> Derivatives over the position of what the rotation adds to the velocity of the journal at t = 1, (component,
   !> axis).
   pure function by_rotation(self) result(matrix)
      class(rotation_drive_type), intent(in) :: self
      real(wp) :: matrix(2, 2)
      matrix = self%over_position + reshape([0, -1, 1, 0], [2, 2])
   end function by_rotation

   !> The velocity of the journal of the unit pad at which w = 0, at t = 1: then D alone drives the film.
   pure function still(self, position) result(v)
      class(rotation_drive_type), intent(in) :: self
      real(wp), intent(in) :: position(2)
      real(wp) :: v(2)
      v = -self%velocity(position) - [position(2), -position(1)]
   end function still

   !> The angle at which the source of pressure changes its sign, rad, for w_1 > 0; where it does not, the trailing or
   !> the leading edge. Where the rotation acts it is found between the places by linear interpolation.
   pure real(wp) function turning_angle(self, position, w, t) result(angle)
      class(rotation_drive_type), intent(in) :: self
      real(wp), intent(in) :: position(2), w(2), t
      real(wp), dimension(0:places + 1) :: tangent, source
      integer :: i
      angle = -atan2(w(2), w(1))
      if (.not. self%acts) return
      tangent = [-self%pad%tangent, self%tangent, self%pad%tangent]
      source = w(1)*tangent + w(2)
      source(1:places) = source(1:places) &
         & + t*(self%rest(:, 0) + self%rest(:, 1)*position(1) + self%rest(:, 2)*position(2))
      angle = self%pad%half_arc
      do i = 1, places + 1
         if (.not. source(i) > 0) cycle
         associate (part => max(0.0_wp, -source(i - 1)/(source(i) - source(i - 1))))
            angle = atan(tangent(i - 1) + part*(tangent(i) - tangent(i - 1)))
         end associate
         return
      end do
   end function turning_angle

   !> True where the drive over cos(phi) rises or falls along the whole arc, as that of w alone does: then the film
   !> is full, or has gone, where the drive at both edges says so.
   pure logical function falls(self, position, w, t)
      class(rotation_drive_type), intent(in) :: self
      real(wp), intent(in) :: position(2), w(2), t
      associate (slope => self%slope(:, 0) + self%slope(:, 1)*position(1) + self%slope(:, 2)*position(2))
         falls = all(sign(1.0_wp, w(1))*t*slope > (least_slope - 1)*abs(w(1)))
      end associate
   end function falls

   !> True where no part of the film diverges.
   pure logical function is_full(self, position, w, t)
      class(rotation_drive_type), intent(in) :: self
      real(wp), intent(in) :: position(2), w(2), t
      is_full = w(2) >= abs(w(1))*self%pad%tangent
      if (is_full) is_full = all(w(1)*self%tangent + w(2) + t*(self%rest(:, 0) + self%rest(:, 1)*position(1) &
         & + self%rest(:, 2)*position(2)) >= 0)
   end function is_full
end module rotation_drive
