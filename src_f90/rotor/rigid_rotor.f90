!> What a model knows of a rotor that turns in bearings, and the simplest one: a rigid journal whose mass stands in one
!> bearing, eqs (1)-(2). The states of a rotor are its displacements and then their rates. The first displacements are
!> those of its journals in their bearings: y and z in the first bearing, in the second, ...
module rigid_rotor
   use kinds, only: wp
   use linear_algebra, only: identity
   use operating_point, only: operating_point_type
   implicit none (type, external)
   private
   public :: rotor_type, journal_motion, new_rigid_rotor

   !> Motion of a journal in its bearing: (y, z), m, and rates, m/s; slopes dy/dx and dz/dx where they are displacements
   !> of the rotor, and their rates, 1/s.
   type :: journal_motion
      real(wp) :: position(2) = 0, velocity(2) = 0
      real(wp) :: slope(2) = 0, slope_rate(2) = 0
   end type journal_motion

   type :: rotor_type
      !> Displacements; states, twice as many; journals, each in a bearing; stations whose displacements it tells.
      integer :: positions = 0, states = 0, journals = 0, stations = 0
      !> Linear elements that act on it.
      integer :: elements = 0
      !> Of each bearing which pair of its displacements are the slopes in it, 0: none is; not allocated where none are.
      integer, allocatable :: slope_pairs(:)
      !> Whether newton_matrix is the identity matrix, whatever gamma and speed are.
      logical :: is_identity = .false.
      !> Of a rigid one, kg.
      real(wp), private :: mass = 0
   contains
      procedure, non_overridable :: journal
      procedure, non_overridable :: slope_pair
      procedure :: scales
      procedure :: loads
      procedure :: station_displacements
      procedure :: station_slopes
      procedure :: force
      procedure :: turn
      procedure :: accelerations
      procedure :: masses
      procedure :: move_about
      procedure :: element_forces
      procedure :: element_positions
      procedure :: force_derivatives
      procedure :: newton_rows
      procedure :: newton_matrix
      procedure :: newton_right
      procedure :: row_accelerations
   end type rotor_type

contains

   !> A rigid rotor of this mass, kg, in one bearing.
   pure type(rotor_type) function new_rigid_rotor(mass) result(rotor)
      real(wp), intent(in) :: mass
      rotor%positions = 2
      rotor%states = 4
      rotor%journals = 1
      rotor%is_identity = .true.
      rotor%mass = mass
   end function new_rigid_rotor

   !> The motion of a journal in its bearing, from the rotor's states.
   pure type(journal_motion) function journal(self, states, bearing)
      class(rotor_type), intent(in) :: self
      real(wp), intent(in) :: states(:)
      integer, intent(in) :: bearing
      associate (y => 2*bearing - 1, rate => self%positions + 2*bearing - 1)
         journal = journal_motion(states(y:y + 1), states(rate:rate + 1))
      end associate
      if (self%slope_pair(bearing) == 0) return
      associate (y => 2*self%slope_pairs(bearing) - 1)
         journal%slope = states(y:y + 1)
         journal%slope_rate = states(self%positions + y:self%positions + y + 1)
      end associate
   end function journal

   !> Which pair of its displacements are the slopes in an element on this pair, 0: none is.
   pure integer function slope_pair(self, pair)
      class(rotor_type), intent(in) :: self
      integer, intent(in) :: pair
      slope_pair = 0
      if (.not. allocated(self%slope_pairs)) return
      if (pair <= size(self%slope_pairs)) slope_pair = self%slope_pairs(pair)
   end function slope_pair

   !> Characteristic scale of each displacement, m, with the clearance of each bearing, m.
   pure function scales(self, clearances)
      class(rotor_type), intent(in) :: self
      real(wp), intent(in) :: clearances(:)
      real(wp) :: scales(self%positions)
      scales = clearances(1)
   end function scales

   !> Steady forces on the journals, (2, bearing), N, where these stand in the middle of their bearings: what the
   !> bearings then bear.
   pure function loads(self, point)
      class(rotor_type), intent(in) :: self
      type(operating_point_type), intent(in) :: point
      real(wp) :: loads(2, self%journals)
      loads(:, 1) = point%load
   end function loads

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

   !> Forces on the displacements in a state at time t, N: all but those of the bearings. In a run-up with the
   !> tangential force of the unbalance.
   pure function force(self, states, point, t)
      class(rotor_type), intent(in) :: self
      real(wp), intent(in) :: states(:)
      type(operating_point_type), intent(in) :: point
      real(wp), intent(in) :: t
      real(wp) :: force(self%positions), phase, speed, direction(2), turning(2)
      phase = point%shaft_angle(t)
      speed = point%speed(t)
      direction = [cos(phase), sin(phase)]
      turning = speed**2*direction + point%acceleration*[direction(2), -direction(1)]
      turning(2) = point%sense*turning(2)
      force = point%load + point%unbalance*turning
      if (allocated(point%excitations)) force = force + sum(point%excitation_forces(t), dim=2)
   end function force

   !> How these forces change with time in a state at constant speed, N/s: the unbalance turns, and excitations change.
   pure function turn(self, point, t)
      class(rotor_type), intent(in) :: self
      type(operating_point_type), intent(in) :: point
      real(wp), intent(in) :: t
      real(wp) :: turn(self%positions), phase
      phase = point%shaft_angle(t)
      turn = point%unbalance*point%speed(t)**3*[-sin(phase), point%sense*cos(phase)]
      if (allocated(point%excitations)) turn = turn + sum(point%excitation_rates(t), dim=2)
   end function turn

   !> Accelerations of the displacements under forces on them, N, those of the bearings included.
   pure function accelerations(self, force)
      class(rotor_type), intent(in) :: self
      real(wp), intent(in) :: force(:)
      real(wp) :: accelerations(self%positions)
      accelerations = force/self%mass
   end function accelerations

   !> The matrix of masses, kg.
   pure function masses(self)
      class(rotor_type), intent(in) :: self
      real(wp) :: masses(self%positions, self%positions)
      masses = reshape([self%mass, 0.0_wp, 0.0_wp, self%mass], [2, 2])
   end function masses

   !> Forces of its elements on it, (2, element), N, in a state at time t.
   pure function element_forces(self, states, point, t) result(forces)
      class(rotor_type), intent(in) :: self
      real(wp), intent(in) :: states(:)
      type(operating_point_type), intent(in) :: point
      real(wp), intent(in) :: t
      real(wp) :: forces(2, self%elements)
      forces = 0
   end function element_forces

   !> How far their stations are displaced from their other ends, (2, element), m.
   pure function element_positions(self, states) result(positions)
      class(rotor_type), intent(in) :: self
      real(wp), intent(in) :: states(:)
      real(wp) :: positions(2, self%elements)
      positions = 0
   end function element_positions

   !> Notes its displacements at the equilibrium, about which it moves.
   pure subroutine move_about(self, positions)
      class(rotor_type), intent(inout) :: self
      real(wp), intent(in) :: positions(:)
   end subroutine move_about

   !> Derivatives of the forces over displacements and over rates at a speed, rad/s.
   pure subroutine force_derivatives(self, speed, over_positions, over_rates, at_rest)
      class(rotor_type), intent(in) :: self
      real(wp), intent(in) :: speed
      real(wp), intent(out) :: over_positions(:, :), over_rates(:, :)
      !> Those of the forces that act at the equilibrium; left out: in motion about it.
      logical, intent(in), optional :: at_rest
      over_positions = 0
      over_rates = 0
   end subroutine force_derivatives

   !> Forces on a journal, (2, any), or with the moments on it (4, any), as they stand in the rotor's equations: P F,
   !> with P the rotor's own choice. Here P = 1/M: accelerations.
   pure function newton_rows(self, forces) result(rows)
      class(rotor_type), intent(in) :: self
      real(wp), intent(in) :: forces(:, :)
      real(wp) :: rows(size(forces, 1), size(forces, 2))
      rows = forces/self%mass
   end function newton_rows

   !> The matrix of the rotor's equations on the rates u of the displacements x = x_0 + gamma u, in a step of Newton's
   !> method: P (M - gamma dF/dv - gamma^2 dF/dx).
   pure function newton_matrix(self, gamma, speed) result(matrix)
      class(rotor_type), intent(in) :: self
      real(wp), intent(in) :: gamma, speed
      real(wp) :: matrix(self%positions, self%positions)
      matrix = identity(self%positions)
   end function newton_matrix

   !> Their right-hand side, P (M u_0 + gamma dF/dx x_0), in place of u_0.
   pure subroutine newton_right(self, gamma, speed, x, u)
      class(rotor_type), intent(in) :: self
      real(wp), intent(in) :: gamma, speed, x(:)
      real(wp), intent(inout) :: u(:)
   end subroutine newton_right

   !> Accelerations of all displacements from rows of the forces on one journal: M^-1 F.
   pure function row_accelerations(self, rows, journal) result(accelerations)
      class(rotor_type), intent(in) :: self
      real(wp), intent(in) :: rows(:, :)
      integer, intent(in) :: journal
      real(wp) :: accelerations(self%positions, size(rows, 2))
      accelerations = rows
   end function row_accelerations
end module rigid_rotor
