!> From the state of journal and pad to the motion of the journal seen from the pad (docs/theory/film.md). A bearing
!> whose shaft turns anticlockwise is seen in a mirror, z for -z, in which it turns clockwise.
module kinematics
   use kinds, only: wp
   use film_solver, only: film_motion
   use abstract_rotor, only: journal_motion
   implicit none (type, external)
   private
   public :: pad_state, pad_position, pad_frame, frame_of, motion_of, motion_derivatives, to_global, in_mirror
   public :: columns, journal_columns, tilt_column, tilt_rate_column, deflection_column
   public :: position_columns, rate_columns

   !> A pad's derivatives stand in these columns: over y, z of the journal and their rates, and over its own tilt,
   !> tilt rate, pivot deflection and pivot deflection rate.
   integer, parameter :: columns = 8, journal_columns = 4
   integer, parameter :: tilt_column = 5, tilt_rate_column = 6, deflection_column = 7, deflection_rate_column = 8
   !> Those of displacements, and of their rates in the same order.
   integer, parameter :: position_columns(4) = [1, 2, tilt_column, deflection_column]
   integer, parameter :: rate_columns(4) = [3, 4, tilt_rate_column, deflection_rate_column]

   !> State of a pad; what a pad lacks stays 0.
   type :: pad_state
      !> rad and rad/s; of the pivot's pivot deflection, m and m/s.
      real(wp) :: tilt = 0, tilt_rate = 0, pivot_deflection = 0, pivot_deflection_rate = 0
      !> Deflection of the bristles, m.
      real(wp) :: deflection = 0
   end type pad_state

   !> Where a pad sits in the bearing.
   type :: pad_position
      !> Pivot angle theta, rad, with its sine and cosine.
      real(wp) :: angle, sin_angle, cos_angle
      !> R_J + c_r + kappa: radius of the undeformed pivot; R + kappa: from the pivot to the arc centre, m.
      real(wp) :: pivot_radius, centre_distance
      !> Whether all this is seen in the mirror.
      logical :: mirrored = .false.
   end type pad_position

   !> The pad frame at one instant: directions, and the journal from the pivot.
   type :: pad_frame
      !> sin and cos of a = theta - delta; y' = (cos a, -sin a), z' = (sin a, cos a).
      real(wp) :: s, c
      !> r = O_J - P along y' and z', m.
      real(wp) :: along, outward
      !> Whether all this is seen in the mirror.
      logical :: mirrored
   end type pad_frame

contains

   !> A vector along global y and z as it is seen in the mirror, or back; where there is none it stays.
   pure function in_mirror(mirrored, vector) result(seen)
      logical, intent(in) :: mirrored
      real(wp), intent(in) :: vector(2)
      real(wp) :: seen(2)
      seen = vector
      if (mirrored) seen(2) = -seen(2)
   end function in_mirror

   !> The frame of a pad in a state.
   pure type(pad_frame) function frame_of(position, journal, pad) result(frame)
      type(pad_position), intent(in) :: position
      type(journal_motion), intent(in) :: journal
      type(pad_state), intent(in) :: pad
      real(wp) :: r(2)
      r = in_mirror(position%mirrored, journal%position) &
         & - (position%pivot_radius + pad%pivot_deflection)*[position%sin_angle, position%cos_angle]
      frame%s = sin(position%angle - pad%tilt)
      frame%c = cos(position%angle - pad%tilt)
      frame%along = r(1)*frame%c - r(2)*frame%s
      frame%outward = r(1)*frame%s + r(2)*frame%c
      frame%mirrored = position%mirrored
   end function frame_of

   !> The motion of the journal seen from the pad.
   pure type(film_motion) function motion_of(position, frame, journal, pad) result(motion)
      type(pad_position), intent(in) :: position
      type(pad_frame), intent(in) :: frame
      type(journal_motion), intent(in) :: journal
      type(pad_state), intent(in) :: pad
      real(wp) :: w(2)
      w = in_mirror(position%mirrored, journal%velocity) &
         & - pad%pivot_deflection_rate*[position%sin_angle, position%cos_angle]
      motion%position = [frame%along, frame%outward + position%centre_distance]
      motion%velocity = [w(1)*frame%c - w(2)*frame%s + pad%tilt_rate*frame%outward, &
         & w(1)*frame%s + w(2)*frame%c - pad%tilt_rate*frame%along]
   end function motion_of

   !> Derivatives of (e_y', e_z', their rates) over the columns.
   pure function motion_derivatives(position, frame, motion, tilt_rate) result(derivatives)
      type(pad_position), intent(in) :: position
      type(pad_frame), intent(in) :: frame
      type(film_motion), intent(in) :: motion
      real(wp), intent(in) :: tilt_rate
      real(wp) :: derivatives(4, columns)
      !> The pivot's outward direction in the pad frame.
      real(wp) :: out_y, out_z
      !> Velocity along y' and z' without the part from the tilt rate.
      real(wp) :: w_y, w_z
      out_y = position%sin_angle*frame%c - position%cos_angle*frame%s
      out_z = position%sin_angle*frame%s + position%cos_angle*frame%c
      w_y = motion%velocity(1) - tilt_rate*frame%outward
      w_z = motion%velocity(2) + tilt_rate*frame%along
      derivatives = 0
      ! journal position
      derivatives(1:2, 1) = [frame%c, frame%s]
      derivatives(1:2, 2) = [-frame%s, frame%c]
      derivatives(3:4, 1) = tilt_rate*[frame%s, -frame%c]
      derivatives(3:4, 2) = tilt_rate*[frame%c, frame%s]
      ! journal velocity
      derivatives(3:4, 3:4) = derivatives(1:2, 1:2)
      if (frame%mirrored) derivatives(:, 2:journal_columns:2) = -derivatives(:, 2:journal_columns:2)
      ! tilt: d y' = z' d delta, d z' = -y' d delta
      derivatives(:, tilt_column) = [frame%outward, -frame%along, w_z - tilt_rate*frame%along, &
         & -w_y - tilt_rate*frame%outward]
      derivatives(3:4, tilt_rate_column) = [frame%outward, -frame%along]
      ! pivot deflection
      derivatives(:, deflection_column) = [-out_y, -out_z, -tilt_rate*out_z, tilt_rate*out_y]
      derivatives(3:4, deflection_rate_column) = [-out_y, -out_z]
   end function motion_derivatives

   !> A pad-frame vector in global (y, z), eq (5).
   pure function to_global(frame, vector) result(global)
      type(pad_frame), intent(in) :: frame
      real(wp), intent(in) :: vector(2)
      real(wp) :: global(2)
      global = in_mirror(frame%mirrored, [vector(1)*frame%c + vector(2)*frame%s, &
         & vector(2)*frame%c - vector(1)*frame%s])
   end function to_global
end module kinematics
