!> Friction in the pivot: a force over the sliding velocity, the normal force and, for LuGre, the
!> bristle deflection. Dyk et al. 2023, eqs (22)-(25), (28).
module friction
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: friction_law, friction_response, bengisu_akay_friction, lugre_friction
   public :: default_bristle_damping, never_sticks

   !> What a law answers.
   type :: friction_response
      !> Friction force, N; positive with a positive velocity.
      real(wp) :: force = 0
      !> Rate of the bristle deflection, m/s.
      real(wp) :: rate = 0
      !> Derivatives of the force over velocity, deflection and normal force.
      real(wp) :: force_velocity = 0, force_deflection = 0, force_normal = 0
      !> Derivatives of the rate over velocity and deflection.
      real(wp) :: rate_velocity = 0, rate_deflection = 0
   end type friction_response

   !> A sticking velocity, m/s, far above all others.
   real(wp), parameter :: never_sticks = 1e30_wp

   !> A pivot without friction, and what the laws have in common.
   type :: friction_law
      !> True where the law has a bristle state.
      logical :: has_bristle = .false.
      !> Static and dynamic coefficient, f_s and f_d.
      real(wp) :: static_coefficient = 0, dynamic_coefficient = 0
      !> Velocity over which the force changes from one direction to the other, m/s.
      real(wp) :: sticking_velocity = never_sticks
   contains
      procedure :: evaluate
      procedure :: switching_points
   end type friction_law

   !> Bengisu-Akay's static law, eq (22); v_c is the sticking velocity.
   type, extends(friction_law) :: bengisu_akay_friction
      !> chi, s/m.
      real(wp) :: decay
   contains
      procedure :: evaluate => evaluate_bengisu_akay
   end type bengisu_akay_friction

   !> LuGre amended for a varying normal force, eqs (23)-(25).
   type, extends(friction_law) :: lugre_friction
      !> v_s, m/s; gamma.
      real(wp) :: stribeck_velocity, stribeck_exponent
      !> sigma_0, 1/m; sigma_1 and sigma_2, s/m.
      real(wp) :: bristle_stiffness, bristle_damping, viscous_coefficient
   contains
      procedure :: evaluate => evaluate_lugre
   end type lugre_friction

contains

   !> Eq (28): sigma_1, s/m, from sigma_0, 1/m, and the characteristic load N_m, N.
   pure function default_bristle_damping(bristle_stiffness, characteristic_load) result(damping)
      real(wp), intent(in) :: bristle_stiffness, characteristic_load
      real(wp) :: damping
      damping = sqrt(bristle_stiffness/characteristic_load)
   end function default_bristle_damping

   !> Velocities at which the force has a switching point, m/s.
   pure function switching_points(self)
      class(friction_law), intent(in) :: self
      real(wp), allocatable :: switching_points(:)
      associate (v => self%sticking_velocity, sticks => self%sticking_velocity < never_sticks)
         switching_points = pack([-v, 0.0_wp, v], [sticks, sticks .or. self%has_bristle, sticks])
      end associate
   end function switching_points

   !> The response to a sliding velocity, m/s, bristle deflection, m, and normal force >= 0, N.
   pure subroutine evaluate(self, velocity, deflection, normal, response)
      class(friction_law), intent(in) :: self
      real(wp), intent(in) :: velocity, deflection, normal
      type(friction_response), intent(out) :: response
   end subroutine evaluate

   pure subroutine evaluate_bengisu_akay(self, velocity, deflection, normal, response)
      class(bengisu_akay_friction), intent(in) :: self
      real(wp), intent(in) :: velocity, deflection, normal
      type(friction_response), intent(out) :: response
      real(wp) :: v, coefficient, derivative
      v = abs(velocity)
      associate (fs => self%static_coefficient, fd => self%dynamic_coefficient, vc => self%sticking_velocity)
         if (v < vc) then
            coefficient = fs*(1 - (v/vc - 1)**2)
            derivative = -2*fs*(v/vc - 1)/vc
         else
            coefficient = (fs - fd)*exp(-self%decay*(v - vc))
            derivative = -self%decay*coefficient
            coefficient = coefficient + fd
         end if
      end associate
      if (velocity < 0) coefficient = -coefficient
      response%force = coefficient*normal
      response%force_velocity = derivative*normal
      response%force_normal = coefficient
   end subroutine evaluate_bengisu_akay

   pure subroutine evaluate_lugre(self, velocity, deflection, normal, response)
      class(lugre_friction), intent(in) :: self
      real(wp), intent(in) :: velocity, deflection, normal
      type(friction_response), intent(out) :: response
      real(wp) :: ratio, drop, g, v, relaxation, g_change, coefficient
      v = abs(velocity)
      ratio = v/self%stribeck_velocity
      if (self%stribeck_exponent /= 1) ratio = ratio**self%stribeck_exponent
      drop = (self%static_coefficient - self%dynamic_coefficient)*exp(-ratio)
      g = self%dynamic_coefficient + drop
      relaxation = self%bristle_stiffness*v/g
      response%rate = velocity - deflection*relaxation
      coefficient = self%bristle_stiffness*deflection + self%bristle_damping*response%rate &
         & + self%viscous_coefficient*velocity
      response%force = coefficient*normal
      ! d relaxation / d|v| = sigma_0 (g - |v| dG/d|v|) / g**2, and |v| dG/d|v| = -gamma ratio drop
      g_change = -self%stribeck_exponent*ratio*drop
      response%rate_velocity = 1 - sign(1.0_wp, velocity)*deflection*self%bristle_stiffness*(g - g_change)/g**2
      response%rate_deflection = -relaxation
      response%force_velocity = (self%bristle_damping*response%rate_velocity + self%viscous_coefficient)*normal
      response%force_deflection = (self%bristle_stiffness + self%bristle_damping*response%rate_deflection)*normal
      response%force_normal = coefficient
   end subroutine evaluate_lugre
end module friction
