!> The gap of a pad to whose axis that of the journal is inclined: its motion, its edges, and what a film solver answers
!> for it (docs/theory/film.md, *Slopes*).
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
   public :: sloped_motion, sloped_response, edge_films

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
end module sloped_gap
