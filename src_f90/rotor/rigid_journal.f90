!> The rotor: a rigid journal whose mass stands in the bearing, eqs (1)-(2). Its states are its displacements and
!> then their rates. A model knows no more of a rotor than the procedures here.
module rigid_journal
   use kinds, only: wp
   use operating_point, only: operating_point_type
   implicit none (type, external)
   private
   public :: rigid_journal_type, journal_motion

   !> States: y, z, their rates.
   integer, parameter :: y_z(2) = [1, 2], rates_of_y_z(2) = [3, 4]

   !> Motion of the journal in a bearing: (y, z), m, and rates, m/s.
   type :: journal_motion
      real(wp) :: position(2) = 0, velocity(2) = 0
   end type journal_motion

   type :: rigid_journal_type
      !> Number of states: displacements, and as many rates.
      integer :: states = 4
      !> Mass, kg.
      real(wp) :: mass = 0
   contains
      procedure :: journal
      procedure :: with_journal
      procedure :: scales
      procedure :: force
      procedure :: turn
      procedure :: rates
      procedure :: rate_derivatives
      procedure :: own_derivatives
   end type rigid_journal_type

contains

   !> The motion of the journal in the bearing, from the rotor's states.
   pure type(journal_motion) function journal(self, states)
      class(rigid_journal_type), intent(in) :: self
      real(wp), intent(in) :: states(:)
      journal = journal_motion(states(y_z), states(rates_of_y_z))
   end function journal

   !> The rotor's states with this motion of the journal.
   pure function with_journal(self, journal) result(states)
      class(rigid_journal_type), intent(in) :: self
      type(journal_motion), intent(in) :: journal
      real(wp) :: states(self%states)
      states(y_z) = journal%position
      states(rates_of_y_z) = journal%velocity
   end function with_journal

   !> Characteristic scale of each state, with the clearance, m, and the highest speed, rad/s.
   pure function scales(self, clearance, speed)
      class(rigid_journal_type), intent(in) :: self
      real(wp), intent(in) :: clearance, speed
      real(wp) :: scales(self%states)
      scales(y_z) = clearance
      scales(rates_of_y_z) = clearance*speed
   end function scales

   !> Load and unbalance along y and z at time t, N; in a run-up with the tangential force of the unbalance.
   pure function force(self, point, t)
      class(rigid_journal_type), intent(in) :: self
      type(operating_point_type), intent(in) :: point
      real(wp), intent(in) :: t
      real(wp) :: force(2), phase, speed, direction(2)
      phase = point%shaft_angle(t)
      speed = point%speed(t)
      direction = [cos(phase), sin(phase)]
      force = point%load + point%unbalance*(speed**2*direction + point%acceleration*[direction(2), -direction(1)])
   end function force

   !> How the force changes with time at constant speed, N/s.
   pure function turn(self, point, t)
      class(rigid_journal_type), intent(in) :: self
      type(operating_point_type), intent(in) :: point
      real(wp), intent(in) :: t
      real(wp) :: turn(2), phase
      phase = point%shaft_angle(t)
      turn = point%unbalance*point%speed(t)**3*[-sin(phase), cos(phase)]
   end function turn

   !> Rates of the states under a force on the journal along y and z, N.
   pure function rates(self, states, force)
      class(rigid_journal_type), intent(in) :: self
      real(wp), intent(in) :: states(:), force(2)
      real(wp) :: rates(self%states)
      rates(y_z) = states(rates_of_y_z)
      rates(rates_of_y_z) = force/self%mass
   end function rates

   !> What derivatives of the force on the journal, (2, any), add to those of the rates, (state, any).
   pure function rate_derivatives(self, force) result(derivatives)
      class(rigid_journal_type), intent(in) :: self
      real(wp), intent(in) :: force(:, :)
      real(wp) :: derivatives(self%states, size(force, 2))
      derivatives(y_z, :) = 0
      derivatives(rates_of_y_z, :) = force/self%mass
   end function rate_derivatives

   !> Derivatives of the rates over the states under a given force on the journal.
   pure function own_derivatives(self) result(derivatives)
      class(rigid_journal_type), intent(in) :: self
      real(wp) :: derivatives(self%states, self%states)
      integer :: i
      derivatives = 0
      do i = 1, size(y_z)
         derivatives(y_z(i), rates_of_y_z(i)) = 1
      end do
   end function own_derivatives
end module rigid_journal
