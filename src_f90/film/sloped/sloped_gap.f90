!> The gap of a pad to whose axis that of the journal is inclined: its motion, its edges, and what a film solver answers
!> for it (docs/theory/pitch_and_yaw.md).
!>
!> In the pad's frame (pad_gap) the axis lies at e + gamma z, z the distance from the pad's middle plane along the
!> shaft, so that h = c_m - (e_1 + gamma_1 z) sin(phi) - (e_2 + gamma_2 z) cos(phi). The slope gamma is the journal's
!> less the pad's: gamma_1 by yaw, gamma_2 by pitch.
module sloped_gap
   use kinds, only: wp
   use film_solver, only: film_response
   use pad_gap, only: pad_gap_type, pad_directions, film_motion
   implicit none (type, external)
   private
   public :: sloped_motion, sloped_response, edge_films, driving_velocity, add_rotation, find_highest

   !> Motion of the journal seen from a pad; with the speed and the oil, all that its film depends on.
   type :: sloped_motion
      !> In the middle plane.
      type(film_motion) :: middle
      !> gamma, rad, and its rate, rad/s, in the same frame.
      real(wp) :: slope(2) = 0, slope_rate(2) = 0
   contains
      procedure :: at
      procedure :: moved
   end type sloped_motion

   !> What a film with slopes answers.
   type :: sloped_response
      !> As without; its derivatives are not set.
      type(film_response) :: film
      !> On the journal: integral of z times the force, N m; its product with the slope's rate is a power.
      real(wp) :: moment(2) = 0
      !> d (force, moment) / d (position, slope, velocity, slope rate); set on request.
      real(wp) :: derivatives(4, 8) = 0
      !> Least film thickness at z = -L/2 and L/2, m.
      real(wp) :: edge_films(2) = 0
      !> Of the highest pressure: angle from the pivot, rad, and z, m.
      real(wp) :: place(2) = 0
      !> Whether pressures are still those without slopes, and `place` is not set (small_slopes).
      logical :: lacks_pressures = .false.
   end type sloped_response

contains

   !> The motion in the plane at z, m.
   pure type(film_motion) function at(self, z) result(motion)
      class(sloped_motion), intent(in) :: self
      real(wp), intent(in) :: z
      motion = film_motion(self%middle%position + z*self%slope, self%middle%velocity + z*self%slope_rate)
   end function at

   !> The motion after a step along the k-th of position, slope, velocity and slope rate, in their units.
   pure type(sloped_motion) function moved(self, k, step)
      class(sloped_motion), intent(in) :: self
      integer, intent(in) :: k
      real(wp), intent(in) :: step
      real(wp) :: x(8)
      x = [self%middle%position, self%slope, self%middle%velocity, self%slope_rate]
      x(k) = x(k) + step
      moved = sloped_motion(film_motion(x(1:2), x(5:6)), x(3:4), x(7:8))
   end function moved

   !> Least film thickness at z = -L/2 and L/2, m; the smaller one is that of the pad.
   pure function edge_films(gap, directions, motion)
      type(pad_gap_type), intent(in) :: gap
      !> The pad's own, computed once.
      type(pad_directions), intent(in) :: directions
      type(sloped_motion), intent(in) :: motion
      real(wp) :: edge_films(2)
      associate (half => 0.5_wp*gap%axial_length)
         edge_films = [gap%min_film_thickness(motion%at(-half), directions), &
            & gap%min_film_thickness(motion%at(half), directions)]
      end associate
   end function edge_films

   !> (w, v), m/s and rad/s: what drives a film at z by (w + v z).n, n = (sin phi, cos phi); a journal speed, rad/s.
   pure function driving_velocity(gap, motion, speed)
      type(pad_gap_type), intent(in) :: gap
      type(sloped_motion), intent(in) :: motion
      real(wp), intent(in) :: speed
      real(wp) :: driving_velocity(4)
      associate (k => speed*gap%journal_radius/(2*gap%pad_radius()), e => motion%middle%position, g => motion%slope)
         driving_velocity = [motion%middle%velocity + k*[e(2), -e(1)], motion%slope_rate + k*[g(2), -g(1)]]
      end associate
   end function driving_velocity

   !> Adds to derivatives over position and slope at constant (w, v) what they make of these.
   pure subroutine add_rotation(gap, speed, derivatives)
      type(pad_gap_type), intent(in) :: gap
      real(wp), intent(in) :: speed
      real(wp), intent(inout) :: derivatives(4, 8)
      integer :: i
      associate (k => speed*gap%journal_radius/(2*gap%pad_radius()), d => derivatives)
         do i = 1, 3, 2
            d(:, i) = d(:, i) - k*d(:, i + 5)
            d(:, i + 1) = d(:, i + 1) + k*d(:, i + 4)
         end do
      end associate
   end subroutine add_rotation

   !> The highest of pressures at the points of a grid, with those of the edges around, and where it is: that of the
   !> paraboloid with the slopes of parabolas through the highest point and its neighbours.
   pure subroutine find_highest(x, z, p, highest, place)
      real(wp), intent(in) :: x(0:), z(0:), p(0:, 0:)
      real(wp), intent(out) :: highest, place(2)
      real(wp) :: slope(2), bend(2), cross, step(2)
      integer :: at(2)
      associate (m => ubound(x, 1) - 1, n => ubound(z, 1) - 1)
         at = maxloc(p(1:m, 1:n))
      end associate
      associate (i => at(1), k => at(2), low => at - 1, high => at + 1)
         call parabola(x(low(1):high(1)), p(low(1):high(1), k), slope(1), bend(1))
         call parabola(z(low(2):high(2)), p(i, low(2):high(2)), slope(2), bend(2))
         cross = (p(high(1), high(2)) - p(high(1), low(2)) - p(low(1), high(2)) + p(low(1), low(2))) &
            & /((x(high(1)) - x(low(1)))*(z(high(2)) - z(low(2))))
         step = 0
         associate (determinant => bend(1)*bend(2) - cross**2)
            if (bend(1) < 0 .and. determinant > 0) step = -[bend(2)*slope(1) - cross*slope(2), &
               & bend(1)*slope(2) - cross*slope(1)]/determinant
         end associate
         step = min(max(step, [x(low(1)) - x(i), z(low(2)) - z(k)]), [x(high(1)) - x(i), z(high(2)) - z(k)])
         place = [x(i), z(k)] + step
         highest = max(p(i, k) + 0.5_wp*dot_product(slope, step), p(0, 1), p(ubound(p, 1), 1), p(1, 0))
      end associate
   end subroutine find_highest

   !> Slope and second derivative of the parabola through three points, at the second.
   pure subroutine parabola(x, y, slope, bend)
      real(wp), intent(in) :: x(-1:1), y(-1:1)
      real(wp), intent(out) :: slope, bend
      real(wp) :: before
      before = (y(0) - y(-1))/(x(0) - x(-1))
      bend = 2*((y(1) - y(0))/(x(1) - x(0)) - before)/(x(1) - x(-1))
      slope = before + 0.5_wp*bend*(x(0) - x(-1))
   end subroutine parabola
end module sloped_gap
