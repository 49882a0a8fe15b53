!> Between a pad's frame and the frame of its mid-arc, in which films are tabulated: the motion there, the forces and
!> their derivatives back.
module mid_arc_frame
   use kinds, only: wp
   use film_solver, only: film_motion, film_oil
   use pad_gap, only: pad_gap_type, pad_directions
   use dimensionless_pad, only: dimensionless_pad_type, thickness_scale
   implicit none (type, external)
   private
   public :: mid_arc_frame_type, middle_motion, middle_force, new_mid_arc_frame

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
   !> that is mu R^4/c^3 times the thickness scale.
   type :: middle_motion
      real(wp) :: edges(2), w(2), turn, scale
   end type middle_motion

   !> A force in the mid-arc frame, N, and its derivatives over the edges' thicknesses, (component, edge), and
   !> over w, (component, component of w).
   type :: middle_force
      real(wp) :: value(2), over_edges(2, 2), over_w(2, 2)
   end type middle_force

contains

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
      type(film_oil), intent(in) :: oil
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
end module mid_arc_frame
