!> A spring and a damper between a pair of a rotor's displacements and the ground, with cross-coupling, and the mass
!> that moves with the pair, which the matrices of the rotor have in any case. With constant coefficients it may as
!> well be part of the rotor's matrices, where it costs nothing in a motion: a support is.
module linear_element
   use kinds, only: wp
   use film_oils, only: film_oil
   use abstract_rotor, only: journal_motion
   use state_layout, only: element_layout_type, new_element_layout, pad_state, of_journal
   use abstract_element, only: element_type
   implicit none (type, external)
   private
   public :: linear_element_type

   type, extends(element_type) :: linear_element_type
      !> N/m, N s/m and kg, over y and z.
      real(wp), dimension(of_journal, of_journal) :: stiffness = 0, damping = 0, mass = 0
      !> Force in the state evaluated last, N.
      real(wp), private :: force(of_journal) = 0
   contains
      procedure :: layout
      procedure :: evaluate
      procedure :: add_force
      procedure :: part_derivatives
      procedure :: sampled_force
      procedure :: add_to
   end type linear_element_type

contains

   !> It has no displacements of its own.
   pure type(element_layout_type) function layout(self)
      class(linear_element_type), intent(in) :: self
      layout = new_element_layout(0, [integer ::], .false.)
   end function layout

   subroutine evaluate(self, journal, pads, oil, speed, want_derivatives, refusal, ok, chosen)
      class(linear_element_type), intent(inout) :: self
      type(journal_motion), intent(in) :: journal
      type(pad_state), intent(in) :: pads(:)
      type(film_oil), intent(in) :: oil(:)
      real(wp), intent(in) :: speed
      logical, intent(in) :: want_derivatives
      character(len=:), allocatable, intent(inout) :: refusal
      logical, intent(out) :: ok
      logical, intent(in), optional :: chosen(:)
      self%force = self%sampled_force(journal, pads, speed)
      ok = .true.
   end subroutine evaluate

   pure subroutine add_force(self, force)
      class(linear_element_type), intent(in) :: self
      real(wp), intent(inout) :: force(of_journal)
      force = force + self%force
   end subroutine add_force

   pure subroutine part_derivatives(self, part, m, accelerations, over_positions, over_rates)
      class(linear_element_type), intent(in) :: self
      integer, intent(in) :: part, m
      logical, intent(in) :: accelerations
      real(wp), intent(out) :: over_positions(m, m), over_rates(m, m)
      over_positions = -self%stiffness
      over_rates = -self%damping
   end subroutine part_derivatives

   pure function sampled_force(self, journal, pads, speed) result(force)
      class(linear_element_type), intent(in) :: self
      type(journal_motion), intent(in) :: journal
      type(pad_state), intent(in) :: pads(:)
      real(wp), intent(in) :: speed
      real(wp) :: force(of_journal)
      force = -matmul(self%stiffness, journal%position) - matmul(self%damping, journal%velocity)
   end function sampled_force

   !> Adds it to matrices of a rotor, in which its pair stands at these places.
   pure subroutine add_to(self, at, mass, damping, stiffness)
      class(linear_element_type), intent(in) :: self
      integer, intent(in) :: at(of_journal)
      real(wp), intent(inout) :: mass(:, :), damping(:, :), stiffness(:, :)
      mass(at, at) = mass(at, at) + self%mass
      damping(at, at) = damping(at, at) + self%damping
      stiffness(at, at) = stiffness(at, at) + self%stiffness
   end subroutine add_to
end module linear_element
