!> The conditions under which a bearing runs: speed and its rate, load, unbalance, and which effects act. They are
!> parameters of a model: another point needs no other model.
module operating_point
   use kinds, only: wp, rpm
   use case_inputs, only: case_type
   implicit none (type, external)
   private
   public :: operating_point_type

   type :: operating_point_type
      !> Shaft speed at t = 0, rpm, and its rate, rad/s^2.
      real(wp) :: speed_rpm = 0, acceleration = 0
      !> Steady force on the journal along y and z, N.
      real(wp) :: load(2) = 0
      !> Unbalance, kg m.
      real(wp) :: unbalance = 0
      !> False: the pivots are without friction; the films do not cavitate, whatever their condition.
      logical :: friction = .true., cavitation = .true.
   contains
      procedure :: speed
      procedure :: shaft_angle
      procedure :: static
   end type operating_point_type

   !> That of a case.
   interface operating_point_type
      module procedure point_of_case
   end interface operating_point_type

contains

   pure function point_of_case(inputs) result(point)
      type(case_type), intent(in) :: inputs
      type(operating_point_type) :: point
      associate (r => inputs%rotor, o => inputs%operation)
         point%speed_rpm = o%speed_rpm
         point%acceleration = (o%final_speed_rpm - o%speed_rpm)*rpm/o%duration
         point%load = r%static_load - [r%mass*r%gravity, 0.0_wp]
      end associate
      point%unbalance = inputs%unbalance()
   end function point_of_case

   !> Shaft speed at time t, rad/s.
   pure real(wp) function speed(self, t)
      class(operating_point_type), intent(in) :: self
      real(wp), intent(in) :: t
      speed = self%speed_rpm*rpm + self%acceleration*t
   end function speed

   !> Shaft angle at time t, rad: the integral of the speed.
   pure real(wp) function shaft_angle(self, t)
      class(operating_point_type), intent(in) :: self
      real(wp), intent(in) :: t
      shaft_angle = (self%speed_rpm*rpm + 0.5_wp*self%acceleration*t)*t
   end function shaft_angle

   !> The same load at the initial speed, kept, without unbalance and friction.
   pure function static(self)
      class(operating_point_type), intent(in) :: self
      type(operating_point_type) :: static
      static = self
      static%acceleration = 0
      static%unbalance = 0
      static%friction = .false.
   end function static
end module operating_point
