!> Finite volumes adapted to one film: half of their columns lie on each side of where the source of pressure changes
!> its sign, all of them are narrow where the film is thin. For its pressure field, which is asked for seldom and
!> has to agree with the force from tables.
module film_adapted_grid
   use kinds, only: wp
   use film_solver, only: film_motion
   use pad_gap, only: pad_gap_type
   use dimensionless_pad, only: dimensionless_pad_type, unit_oil, new_dimensionless_pad
   use mid_arc_frame, only: middle_motion, mid_arc_frame_type, new_mid_arc_frame
   use elimination_film, only: elimination_film_type, new_elimination_film
   implicit none (type, external)
   private
   public :: new_following_film

   !> Columns for every row.
   integer, parameter :: columns_a_row = 8
   !> Where the source changes its sign beside the arc or close to an edge, the columns change there, over half the arc.
   real(wp), parameter :: farthest = 0.8_wp

contains

   !> Volumes for a film at a motion that leaves it open and a journal speed,  rad/s, on this number of rows.
   type(elimination_film_type) function new_following_film(gap, motion, speed, rows) result(film)
      type(pad_gap_type), intent(in) :: gap
      type(film_motion), intent(in) :: motion
      real(wp), intent(in) :: speed
      integer, intent(in) :: rows
      type(dimensionless_pad_type) :: pad
      type(mid_arc_frame_type) :: frame
      type(middle_motion) :: seen
      real(wp) :: angles(0:columns_a_row*rows), zero
      integer :: half
      half = columns_a_row*rows/2
      pad = new_dimensionless_pad(gap)
      frame = new_mid_arc_frame(gap, pad)
      seen = frame%motion(motion, unit_oil, speed)
      zero = -atan2(sign(1.0_wp, seen%w(1))*seen%w(2), abs(seen%w(1)))
      zero = min(max(zero, -farthest*pad%half_arc), farthest*pad%half_arc)
      associate (position => pad%position(seen%edges))
         angles(:half) = pad%spread_angles(position, -pad%half_arc, zero, half)
         angles(half:) = pad%spread_angles(position, zero, pad%half_arc, half)
      end associate
      film = new_elimination_film(gap, 2*half, rows, 0.5_wp*(gap%leading_angle - gap%trailing_angle) + angles)
   end function new_following_film
end module film_adapted_grid
