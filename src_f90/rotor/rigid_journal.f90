!> A rigid journal whose mass stands in one bearing, eqs (1)-(2).
module rigid_journal
   use kinds, only: wp
   use operating_point, only: operating_point_type
   use abstract_rotor, only: rotor_type
   implicit none (type, external)
   private
   public :: new_rigid_journal

   type, extends(rotor_type) :: rigid_journal_type
      !> Mass, kg.
      real(wp) :: mass = 0
   contains
      procedure :: scales
      procedure :: loads
      procedure :: force
      procedure :: turn
      procedure :: accelerations
      procedure :: masses
      procedure :: newton_rows
      procedure :: row_accelerations
   end type rigid_journal_type

contains

   !> A journal of this mass, kg.
   pure type(rigid_journal_type) function new_rigid_journal(mass) result(journal)
      real(wp), intent(in) :: mass
      journal%positions = 2
      journal%states = 4
      journal%journals = 1
      journal%is_identity = .true.
      journal%mass = mass
   end function new_rigid_journal

   pure function scales(self, clearances)
      class(rigid_journal_type), intent(in) :: self
      real(wp), intent(in) :: clearances(:)
      real(wp) :: scales(self%positions)
      scales = clearances(1)
   end function scales

   pure function loads(self, point)
      class(rigid_journal_type), intent(in) :: self
      type(operating_point_type), intent(in) :: point
      real(wp) :: loads(2, self%journals)
      loads(:, 1) = point%load
   end function loads

   !> Load, unbalance and excitations.
   pure function force(self, states, point, t)
      class(rigid_journal_type), intent(in) :: self
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

   !> The unbalance turns, and excitations change.
   pure function turn(self, point, t)
      class(rigid_journal_type), intent(in) :: self
      type(operating_point_type), intent(in) :: point
      real(wp), intent(in) :: t
      real(wp) :: turn(self%positions), phase
      phase = point%shaft_angle(t)
      turn = point%unbalance*point%speed(t)**3*[-sin(phase), point%sense*cos(phase)]
      if (allocated(point%excitations)) turn = turn + sum(point%excitation_rates(t), dim=2)
   end function turn

   pure function accelerations(self, force)
      class(rigid_journal_type), intent(in) :: self
      real(wp), intent(in) :: force(:)
      real(wp) :: accelerations(self%positions)
      accelerations = force/self%mass
   end function accelerations

   pure function masses(self)
      class(rigid_journal_type), intent(in) :: self
      real(wp) :: masses(self%positions, self%positions)
      masses = reshape([self%mass, 0.0_wp, 0.0_wp, self%mass], [2, 2])
   end function masses

   !> P = 1/M: accelerations.
   pure function newton_rows(self, forces) result(rows)
      class(rigid_journal_type), intent(in) :: self
      real(wp), intent(in) :: forces(:, :)
      real(wp) :: rows(2, size(forces, 2))
      rows = forces/self%mass
   end function newton_rows

   pure function row_accelerations(self, rows, journal) result(accelerations)
      class(rigid_journal_type), intent(in) :: self
      real(wp), intent(in) :: rows(:, :)
      integer, intent(in) :: journal
      real(wp) :: accelerations(self%positions, size(rows, 2))
      accelerations = rows
   end function row_accelerations
end module rigid_journal
