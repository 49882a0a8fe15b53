!> What a model knows of a rotor that turns in bearings. Its states are its displacements and then their rates. The
!> first displacements are those of its journals in their bearings: y and z in the first bearing, in the second, ...
module abstract_rotor
   use kinds, only: wp
   use linear_algebra, only: identity
   use operating_point, only: operating_point_type
   implicit none (type, external)
   private
   public :: rotor_type, journal_motion

   !> Motion of a journal in its bearing: (y, z), m, and rates, m/s.
   type :: journal_motion
      real(wp) :: position(2) = 0, velocity(2) = 0
   end type journal_motion

   type, abstract :: rotor_type
      !> Displacements; states, twice as many; journals, each in a bearing; stations whose displacements it tells.
      integer :: positions = 0, states = 0, journals = 0, stations = 0
      !> Whether newton_matrix is the identity matrix, whatever gamma and speed are.
      logical :: is_identity = .false.
   contains
      procedure, non_overridable :: journal
      procedure, non_overridable :: with_journals
      procedure(scales), deferred :: scales
      procedure(loads), deferred :: loads
      procedure :: station_displacements
      procedure :: station_slopes
      procedure(force), deferred :: force
      procedure(turn), deferred :: turn
      procedure(accelerations), deferred :: accelerations
      procedure(masses), deferred :: masses
      procedure :: force_derivatives
      procedure(newton_rows), deferred :: newton_rows
      procedure :: newton_matrix
      procedure :: newton_right
      procedure(row_accelerations), deferred :: row_accelerations
   end type rotor_type

   abstract interface
      !> Characteristic scale of each displacement, m, with the clearance of each bearing, m.
      pure function scales(self, clearances)
         import :: rotor_type, wp
         class(rotor_type), intent(in) :: self
         real(wp), intent(in) :: clearances(:)
         real(wp) :: scales(self%positions)
      end function scales

      !> Steady forces on the journals, (2, bearing), N, where these stand in the middle of their bearings: what the
      !> bearings then bear.
      pure function loads(self, point)
         import :: rotor_type, operating_point_type, wp
         class(rotor_type), intent(in) :: self
         type(operating_point_type), intent(in) :: point
         real(wp) :: loads(2, self%journals)
      end function loads

      !> Forces on the displacements in a state at time t, N: all but those of the bearings. In a run-up with the
      !> tangential force of the unbalance.
      pure function force(self, states, point, t)
         import :: rotor_type, operating_point_type, wp
         class(rotor_type), intent(in) :: self
         real(wp), intent(in) :: states(:)
         type(operating_point_type), intent(in) :: point
         real(wp), intent(in) :: t
         real(wp) :: force(self%positions)
      end function force

      !> How these forces change with time in a state at constant speed, N/s.
      pure function turn(self, point, t)
         import :: rotor_type, operating_point_type, wp
         class(rotor_type), intent(in) :: self
         type(operating_point_type), intent(in) :: point
         real(wp), intent(in) :: t
         real(wp) :: turn(self%positions)
      end function turn

      !> Accelerations of the displacements under forces on them, N, those of the bearings included.
      pure function accelerations(self, force)
         import :: rotor_type, wp
         class(rotor_type), intent(in) :: self
         real(wp), intent(in) :: force(:)
         real(wp) :: accelerations(self%positions)
      end function accelerations

      !> The matrix of masses, kg.
      pure function masses(self)
         import :: rotor_type, wp
         class(rotor_type), intent(in) :: self
         real(wp) :: masses(self%positions, self%positions)
      end function masses

      !> Forces on a journal, (2, any), as they stand in the rotor's equations: P F, with P the rotor's own choice.
      pure function newton_rows(self, forces) result(rows)
         import :: rotor_type, wp
         class(rotor_type), intent(in) :: self
         real(wp), intent(in) :: forces(:, :)
         real(wp) :: rows(2, size(forces, 2))
      end function newton_rows

      !> Accelerations of all displacements from rows of the forces on one journal: M^-1 F.
      pure function row_accelerations(self, rows, journal) result(accelerations)
         import :: rotor_type, wp
         class(rotor_type), intent(in) :: self
         real(wp), intent(in) :: rows(:, :)
         integer, intent(in) :: journal
         real(wp) :: accelerations(self%positions, size(rows, 2))
      end function row_accelerations
   end interface

contains

   !> The motion of a journal in its bearing, from the rotor's states.
   pure type(journal_motion) function journal(self, states, bearing)
      class(rotor_type), intent(in) :: self
      real(wp), intent(in) :: states(:)
      integer, intent(in) :: bearing
      associate (y => 2*bearing - 1, rate => self%positions + 2*bearing - 1)
         journal = journal_motion(states(y:y + 1), states(rate:rate + 1))
      end associate
   end function journal

   !> The rotor's states with these motions of the journals; its other displacements are 0.
   pure function with_journals(self, journals) result(states)
      class(rotor_type), intent(in) :: self
      type(journal_motion), intent(in) :: journals(:)
      real(wp) :: states(self%states)
      integer :: i
      states = 0
      do i = 1, size(journals)
         states(2*i - 1:2*i) = journals(i)%position
         states(self%positions + 2*i - 1:self%positions + 2*i) = journals(i)%velocity
      end do
   end function with_journals

   ! What follows holds for a rotor without stations that answers no motion, P = 1/M, as a rigid journal.

   !> Displacements y and z of the stations, (2, station), m, in a state.
   pure function station_displacements(self, states) result(displacements)
      class(rotor_type), intent(in) :: self
      real(wp), intent(in) :: states(:)
      real(wp) :: displacements(2, self%stations)
      displacements = 0
   end function station_displacements

   !> Slopes dy/dx and dz/dx of the shaft at the stations, (2, station), in a state.
   pure function station_slopes(self, states) result(slopes)
      class(rotor_type), intent(in) :: self
      real(wp), intent(in) :: states(:)
      real(wp) :: slopes(2, self%stations)
      slopes = 0
   end function station_slopes

   !> Derivatives of the forces over displacements and over rates at a speed, rad/s.
   pure subroutine force_derivatives(self, speed, over_positions, over_rates)
      class(rotor_type), intent(in) :: self
      real(wp), intent(in) :: speed
      real(wp), intent(out) :: over_positions(:, :), over_rates(:, :)
      over_positions = 0
      over_rates = 0
   end subroutine force_derivatives

   !> The matrix of the rotor's equations on the rates u of the displacements x = x_0 + gamma u, in a step of Newton's
   !> method: P (M - gamma dF/dv - gamma^2 dF/dx).
   pure function newton_matrix(self, gamma, speed) result(matrix)
      class(rotor_type), intent(in) :: self
      real(wp), intent(in) :: gamma, speed
      real(wp) :: matrix(self%positions, self%positions)
      matrix = identity(self%positions)
   end function newton_matrix

   !> Their right-hand side, P (M u_0 + gamma dF/dx x_0), in place of u_0.
   pure subroutine newton_right(self, gamma, x, u)
      class(rotor_type), intent(in) :: self
      real(wp), intent(in) :: gamma, x(:)
      real(wp), intent(inout) :: u(:)
   end subroutine newton_right
end module abstract_rotor
