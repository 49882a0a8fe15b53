!> From the state of journal and pad to the motion of the journal seen from the pad (docs/theory.md).
module kinematics
   use kinds, only: wp
   use film_solver, only: film_motion
   implicit none (type, external)
   private
   public :: pad_place, pad_frame, frame_of, motion_of, motion_slopes, to_global

   !> Where a pad sits.
   type :: pad_place
      !> Pivot angle theta, rad, with its sine and cosine.
      real(wp) :: angle, sin_angle, cos_angle
      !> R_J + c_r + kappa: radius of the undeformed pivot; R + kappa: from the pivot to the arc centre, m.
      real(wp) :: pivot_radius, centre_distance
   end type pad_place

   !> The pad frame at one instant: directions, and the journal from the pivot.
   type :: pad_frame
      !> sin and cos of a = theta - delta; y' = (cos a, -sin a), z' = (sin a, cos a).
      real(wp) :: s, c
      !> r = O_J - P along y' and z', m.
      real(wp) :: along, outward
   end type pad_frame

contains

   !> The frame of a pad with tilt, rad, and penetration, m; journal at (y, z), m.
   pure function frame_of(place, journal, tilt, penetration) result(frame)
      type(pad_place), intent(in) :: place
      real(wp), intent(in) :: journal(2), tilt, penetration
      type(pad_frame) :: frame
      real(wp) :: r(2)
      r = journal - (place%pivot_radius + penetration)*[place%sin_angle, place%cos_angle]
      frame%s = sin(place%angle - tilt)
      frame%c = cos(place%angle - tilt)
      frame%along = r(1)*frame%c - r(2)*frame%s
      frame%outward = r(1)*frame%s + r(2)*frame%c
   end function frame_of

   !> Relative position and velocity, with journal velocity, m/s, tilt rate, rad/s, penetration rate, m/s.
   pure function motion_of(place, frame, velocity, tilt_rate, penetration_rate) result(motion)
      type(pad_place), intent(in) :: place
      type(pad_frame), intent(in) :: frame
      real(wp), intent(in) :: velocity(2), tilt_rate, penetration_rate
      type(film_motion) :: motion
      real(wp) :: w(2)
      w = velocity - penetration_rate*[place%sin_angle, place%cos_angle]
      motion%position = [frame%along, frame%outward + place%centre_distance]
      motion%velocity = [w(1)*frame%c - w(2)*frame%s + tilt_rate*frame%outward, &
         & w(1)*frame%s + w(2)*frame%c - tilt_rate*frame%along]
   end function motion_of

   !> Derivatives of (e_y', e_z', their rates) over (y, z, vy, vz, tilt, tilt rate, penetration, its rate).
   pure function motion_slopes(place, frame, motion, tilt_rate) result(slopes)
      type(pad_place), intent(in) :: place
      type(pad_frame), intent(in) :: frame
      type(film_motion), intent(in) :: motion
      real(wp), intent(in) :: tilt_rate
      real(wp) :: slopes(4, 8)
      !> The pivot's outward direction in the pad frame.
      real(wp) :: out_y, out_z
      !> Velocity along y' and z' without the part from the tilt rate.
      real(wp) :: w_y, w_z
      out_y = place%sin_angle*frame%c - place%cos_angle*frame%s
      out_z = place%sin_angle*frame%s + place%cos_angle*frame%c
      w_y = motion%velocity(1) - tilt_rate*frame%outward
      w_z = motion%velocity(2) + tilt_rate*frame%along
      slopes = 0
      ! journal position
      slopes(1:2, 1) = [frame%c, frame%s]
      slopes(1:2, 2) = [-frame%s, frame%c]
      slopes(3:4, 1) = tilt_rate*[frame%s, -frame%c]
      slopes(3:4, 2) = tilt_rate*[frame%c, frame%s]
      ! journal velocity
      slopes(3:4, 3:4) = slopes(1:2, 1:2)
      ! tilt: d y' = z' d delta, d z' = -y' d delta
      slopes(:, 5) = [frame%outward, -frame%along, w_z - tilt_rate*frame%along, &
         & -w_y - tilt_rate*frame%outward]
      slopes(3:4, 6) = [frame%outward, -frame%along]
      ! penetration
      slopes(:, 7) = [-out_y, -out_z, -tilt_rate*out_z, tilt_rate*out_y]
      slopes(3:4, 8) = [-out_y, -out_z]
   end function motion_slopes

   !> A pad-frame vector in global (y, z), eq (5).
   pure function to_global(frame, vector) result(global)
      type(pad_frame), intent(in) :: frame
      real(wp), intent(in) :: vector(2)
      real(wp) :: global(2)
      global = [vector(1)*frame%c + vector(2)*frame%s, vector(2)*frame%c - vector(1)*frame%s]
   end function to_global
end module kinematics
