!> From the state of journal and pad to the motion of the journal seen from the pad (docs/theory/film.md). A bearing
!> whose shaft turns anticlockwise is seen in a mirror, z for -z, in which it turns clockwise.
module kinematics
   use kinds, only: wp
   use film_solver, only: film_motion
   use rigid_rotor, only: journal_motion
   use state_layout, only: pad_state, tilt, pivot_deflection, most_coordinates, of_journal
   implicit none (type, external)
   private
   public :: pad_position, pad_frame, frame_of, motion_of, journal_slopes, motion_slopes, to_global, in_mirror

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

   !> Angle, rad, up to which the first terms of Taylor's series that are left out, x^8/9! and x^8/8! of the sine and
   !> the cosine, are below the last bit.
   real(wp), parameter :: small_angle = 0.02_wp

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
         & - (position%pivot_radius + pad%x(pivot_deflection))*[position%sin_angle, position%cos_angle]
      call turn(position, pad%x(tilt), frame%s, frame%c)
      frame%along = r(1)*frame%c - r(2)*frame%s
      frame%outward = r(1)*frame%s + r(2)*frame%c
      frame%mirrored = position%mirrored
   end function frame_of

   !> Sine and cosine of theta - delta: pads tilt so little that Taylor's series give sine and cosine of delta to
   !> the last bit.
   elemental subroutine turn(position, angle, s, c)
      type(pad_position), intent(in) :: position
      !> delta, rad.
      real(wp), intent(in) :: angle
      real(wp), intent(out) :: s, c
      real(wp) :: square, sine, cosine
      if (abs(angle) > small_angle) then
         s = sin(position%angle - angle)
         c = cos(position%angle - angle)
         return
      end if
      square = angle**2
      sine = angle*(1 - square/6*(1 - square/20*(1 - square/42)))
      cosine = 1 - square/2*(1 - square/12*(1 - square/30))
      s = position%sin_angle*cosine - position%cos_angle*sine
      c = position%cos_angle*cosine + position%sin_angle*sine
   end subroutine turn

   !> The motion of the journal seen from the pad.
   pure type(film_motion) function motion_of(position, frame, journal, pad) result(motion)
      type(pad_position), intent(in) :: position
      type(pad_frame), intent(in) :: frame
      type(journal_motion), intent(in) :: journal
      type(pad_state), intent(in) :: pad
      real(wp) :: w(2)
      w = in_mirror(position%mirrored, journal%velocity) &
         & - pad%v(pivot_deflection)*[position%sin_angle, position%cos_angle]
      motion%position = [frame%along, frame%outward + position%centre_distance]
      motion%velocity = [w(1)*frame%c - w(2)*frame%s + pad%v(tilt)*frame%outward, &
         & w(1)*frame%s + w(2)*frame%c - pad%v(tilt)*frame%along]
   end function motion_of

   !> Derivatives of (e_y', e_z', their rates) over the displacements of the journal, y and z, and over their rates.
   pure subroutine journal_slopes(frame, tilt_rate, over_positions, over_rates)
      type(pad_frame), intent(in) :: frame
      real(wp), intent(in) :: tilt_rate
      real(wp), intent(out) :: over_positions(4, of_journal), over_rates(4, of_journal)
      over_positions(1:2, 1) = [frame%c, frame%s]
      over_positions(1:2, 2) = [-frame%s, frame%c]
      over_positions(3:4, 1) = tilt_rate*[frame%s, -frame%c]
      over_positions(3:4, 2) = tilt_rate*[frame%c, frame%s]
      over_rates(1:2, :) = 0
      over_rates(3:4, :) = over_positions(1:2, :)
      if (.not. frame%mirrored) return
      over_positions(:, 2) = -over_positions(:, 2)
      over_rates(:, 2) = -over_rates(:, 2)
   end subroutine journal_slopes

   !> Derivatives of (e_y', e_z', their rates) over the displacements of the journal and then those of the pad, of these
   !> kinds, and over their rates; 0 where there is none.
   pure subroutine motion_slopes(position, frame, motion, tilt_rate, kinds, over_positions, over_rates)
      type(pad_position), intent(in) :: position
      type(pad_frame), intent(in) :: frame
      type(film_motion), intent(in) :: motion
      real(wp), intent(in) :: tilt_rate
      integer, intent(in) :: kinds(most_coordinates)
      real(wp), intent(out), dimension(4, of_journal + most_coordinates) :: over_positions, over_rates
      !> The pivot's outward direction in the pad frame; velocity along y' and z' without the part from the tilt rate.
      real(wp) :: out_y, out_z, w_y, w_z
      integer :: k
      call journal_slopes(frame, tilt_rate, over_positions(:, :of_journal), over_rates(:, :of_journal))
      do k = 1, most_coordinates
         associate (x => over_positions(:, of_journal + k), v => over_rates(:, of_journal + k))
            select case (kinds(k))
            case (tilt)
               ! d y' = z' d delta, d z' = -y' d delta
               w_y = motion%velocity(1) - tilt_rate*frame%outward
               w_z = motion%velocity(2) + tilt_rate*frame%along
               x = [frame%outward, -frame%along, w_z - tilt_rate*frame%along, -w_y - tilt_rate*frame%outward]
               v = [0.0_wp, 0.0_wp, frame%outward, -frame%along]
            case (pivot_deflection)
               out_y = position%sin_angle*frame%c - position%cos_angle*frame%s
               out_z = position%sin_angle*frame%s + position%cos_angle*frame%c
               x = [-out_y, -out_z, -tilt_rate*out_z, tilt_rate*out_y]
               v = [0.0_wp, 0.0_wp, -out_y, -out_z]
            case default
               ! moves no film
               x = 0
               v = 0
            end select
         end associate
      end do
   end subroutine motion_slopes

   !> A pad-frame vector in global (y, z), eq (5).
   pure function to_global(frame, vector) result(global)
      type(pad_frame), intent(in) :: frame
      real(wp), intent(in) :: vector(2)
      real(wp) :: global(2)
      global = in_mirror(frame%mirrored, [vector(1)*frame%c + vector(2)*frame%s, &
         & vector(2)*frame%c - vector(1)*frame%s])
   end function to_global
end module kinematics
