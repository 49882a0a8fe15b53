!> The conditions under which a bearing runs: speed and its rate, loads, unbalance, and which effects act. They are
!> parameters of a model: another point needs no other model.
module operating_point
   use kinds, only: wp, rpm
   use case_inputs, only: case_type
   use excitations, only: excitation_type
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
      !> 1: the shaft turns clockwise; -1: anticlockwise.
      real(wp) :: sense = 1
      !> Forces over time; not allocated where there are none.
      type(excitation_type), allocatable :: excitations(:)
      !> False: the pivots are without friction; the films do not cavitate, whatever their condition.
      logical :: friction = .true., cavitation = .true.
      !> False: at rest in equilibrium, without what acts in motion about it alone.
      logical :: moves = .true.
      !> False: bow and skew discs of a shaft do not act.
      logical :: bent = .true.
   contains
      procedure :: speed
      procedure :: shaft_angle
      procedure :: excitation_forces
      procedure :: excitation_rates
      procedure :: next_switch
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
      point%sense = inputs%sense()
      if (size(inputs%excitations) == 0) return
      point%excitations = inputs%excitations
      call point%excitations%prepare(point%sense)
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

   !> The forces of the excitations along y and z at time t, N, (2, excitation).
   pure function excitation_forces(self, t) result(forces)
      class(operating_point_type), intent(in) :: self
      real(wp), intent(in) :: t
      real(wp) :: forces(2, excitation_count(self)), rates(2, excitation_count(self))
      call evaluate(self, t, forces, rates)
   end function excitation_forces

   !> How these forces change with time, N/s.
   pure function excitation_rates(self, t) result(rates)
      class(operating_point_type), intent(in) :: self
      real(wp), intent(in) :: t
      real(wp) :: forces(2, excitation_count(self)), rates(2, excitation_count(self))
      call evaluate(self, t, forces, rates)
   end function excitation_rates

   !> Both.
   pure subroutine evaluate(self, t, forces, rates)
      class(operating_point_type), intent(in) :: self
      real(wp), intent(in) :: t
      real(wp), intent(out) :: forces(:, :), rates(:, :)
      integer :: i
      do i = 1, size(forces, 2)
         call self%excitations(i)%evaluate(t, self%shaft_angle(t) - self%shaft_angle(self%excitations(i)%start), &
            & self%speed(t), forces(:, i), rates(:, i))
      end do
   end subroutine evaluate

   !> Number of its excitations.
   pure integer function excitation_count(self)
      type(operating_point_type), intent(in) :: self
      excitation_count = 0
      if (allocated(self%excitations)) excitation_count = size(self%excitations)
   end function excitation_count

   !> The first time after t, s, at which the force of an excitation jumps, or (`jumps` is false) its rate does; huge
   !> where there is none.
   pure subroutine next_switch(self, t, next, jumps)
      class(operating_point_type), intent(in) :: self
      real(wp), intent(in) :: t
      real(wp), intent(out) :: next
      logical, intent(out) :: jumps
      integer :: i
      next = huge(t)
      jumps = .false.
      do i = 1, excitation_count(self)
         call self%excitations(i)%next_switch(t, next, jumps)
      end do
   end subroutine next_switch

   !> The same load at the initial speed, kept, without unbalance, bow and skew, excitations and friction.
   pure function static(self)
      class(operating_point_type), intent(in) :: self
      type(operating_point_type) :: static
      static = self
      static%acceleration = 0
      static%unbalance = 0
      static%bent = .false.
      if (allocated(static%excitations)) deallocate (static%excitations)
      static%friction = .false.
      static%moves = .false.
   end function static
end module operating_point
