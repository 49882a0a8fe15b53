!> Friction in the pivot: a force over the sliding velocity, the normal force and, for LuGre, the
!> bristle deflection. Dyk et al. 2023, eqs (22)-(25), (28).
module friction
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: friction_law, friction_response, turning_friction, bengisu_akay_friction, lugre_friction
   public :: default_bristle_damping, never_sticks, no_friction

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

   !> What a law answers to a velocity of several components, (component) and (component, component it is derived by);
   !> those of the rate over the deflection are rate_deflection on the diagonal.
   type :: turning_friction
      real(wp), dimension(3) :: force = 0, rate = 0, force_normal = 0
      real(wp), dimension(3, 3) :: force_velocity = 0, rate_velocity = 0
      real(wp) :: force_deflection = 0, rate_deflection = 0
   end type turning_friction

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
      procedure :: evaluate_turning
      procedure :: switching_points
   end type friction_law

   type(friction_law), parameter :: no_friction = friction_law()

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

   !> The response to a velocity, m/s, and bristles, m, of up to three components: the isotropic law, whose coefficients
   !> depend on the size of the velocity alone (Velenis, Tsiotras, Canudas-de-Wit and Sorine 2005, Vehicle System
   !> Dynamics 43, for LuGre). A law is linear in the deflection, so that force and rate are those without deflection,
   !> along the velocity, and those that the deflection adds: with a single component those of `evaluate`.
   pure subroutine evaluate_turning(self, velocity, deflection, normal, response)
      class(friction_law), intent(in) :: self
      real(wp), intent(in) :: velocity(:), deflection(:), normal
      type(turning_friction), intent(out) :: response
      type(friction_response) :: along, bent
      real(wp) :: speed, direction(size(velocity)), force, rate
      integer :: k, n
      n = size(velocity)
      speed = norm2(velocity)
      ! under a unit of the normal force: the pivot load may vanish
      call self%evaluate(speed, 0.0_wp, 1.0_wp, along)
      ! per velocity
      direction = 0
      force = along%force_velocity
      rate = along%rate_velocity
      if (speed > tiny(speed)/epsilon(speed)) then
         direction = velocity/speed
         force = along%force/speed
         rate = along%rate/speed
      end if
      response%force_normal(:n) = force*velocity + along%force_deflection*deflection
      response%force = normal*response%force_normal
      response%rate(:n) = rate*velocity + along%rate_deflection*deflection
      response%force_deflection = normal*along%force_deflection
      response%rate_deflection = along%rate_deflection
      do k = 1, n
         call self%evaluate(speed, deflection(k), 1.0_wp, bent)
         response%force_velocity(k, :n) = normal*((along%force_velocity - force)*direction(k) &
            & + bent%force_velocity - along%force_velocity)*direction
         response%rate_velocity(k, :n) = ((along%rate_velocity - rate)*direction(k) &
            & + bent%rate_velocity - along%rate_velocity)*direction
         response%force_velocity(k, k) = response%force_velocity(k, k) + normal*force
         response%rate_velocity(k, k) = response%rate_velocity(k, k) + rate
      end do
   end subroutine evaluate_turning

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
