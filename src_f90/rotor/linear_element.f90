!> A spring and a damper between a pair of a rotor's displacements and the ground, with cross-coupling, and the mass
!> that moves with the pair, which the matrices of the rotor have in any case. With constant coefficients it may as
!> well be part of the rotor's matrices, where it costs nothing in a motion: a support is.
module linear_element
   use kinds, only: wp
   use rigid_rotor, only: journal_motion
   use state_layout, only: pad_state, of_journal
   use abstract_element, only: element_type
   use case_groups, only: mount_type, support_type
   implicit none (type, external)
   private
   public :: linear_element_type, relative_displacements, housing_pair, add_supports, &
      & support_element

   type, extends(element_type) :: linear_element_type
      !> N/m, N s/m and kg, over y and z.
      real(wp), dimension(of_journal, of_journal) :: stiffness = 0, damping = 0, mass = 0
   contains
      procedure :: part_derivatives
      procedure :: sampled_force
      procedure :: add_to
   end type linear_element_type

contains

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

   ! Supports of bearings: housings on springs and dampers, which move with displacements of their own.

   !> What the displacements of the journals in space and the amplitudes of the modes, n of both, are over displacements
   !> x: those of the journals in their bearings, those of the housings, the amplitudes. A journal in space is displaced
   !> as in its bearing, and as its housing.
   pure function relative_displacements(bearings, n) result(into)
      type(mount_type), intent(in) :: bearings(:)
      integer, intent(in) :: n
      real(wp), allocatable :: into(:, :)
      integer :: journals, b, i, p
      journals = 2*size(bearings)
      allocate (into(n, n + 2*count([(allocated(bearings(b)%support), b=1, size(bearings))])), source=0.0_wp)
      do i = 1, n
         into(i, merge(i, i + size(into, 2) - n, i <= journals)) = 1
      end do
      i = journals
      do b = 1, size(bearings)
         if (.not. allocated(bearings(b)%support)) cycle
         do p = 1, 2
            i = i + 1
            into(2*(b - 1) + p, i) = 1
         end do
      end do
   end function relative_displacements

   !> Which pair of the displacements x those of the housing of bearing b are, which has a support.
   pure integer function housing_pair(bearings, b) result(pair)
      type(mount_type), intent(in) :: bearings(:)
      integer, intent(in) :: b
      integer :: i
      pair = size(bearings) + count([(allocated(bearings(i)%support), i=1, b)])
   end function housing_pair

   !> A support as an element on the displacements of its housing.
   pure type(linear_element_type) function support_element(support) result(element)
      type(support_type), intent(in) :: support
      integer :: p
      do p = 1, 2
         element%mass(p, p) = support%mass
         element%damping(p, p) = support%damping(p)
         element%stiffness(p, p) = support%stiffness(p)
      end do
   end function support_element

   !> Adds supports and the weights of their housings to matrices in the displacements x.
   pure subroutine add_supports(bearings, gravity, mass, damping, stiffness, load)
      type(mount_type), intent(in) :: bearings(:)
      !> m/s^2
      real(wp), intent(in) :: gravity
      real(wp), intent(inout) :: mass(:, :), damping(:, :), stiffness(:, :), load(:)
      type(linear_element_type) :: element
      integer :: b, i
      i = 2*size(bearings)
      do b = 1, size(bearings)
         if (.not. allocated(bearings(b)%support)) cycle
         element = support_element(bearings(b)%support)
         call element%add_to([i + 1, i + 2], mass, damping, stiffness)
         load(i + 1) = load(i + 1) - gravity*element%mass(1, 1)
         i = i + 2
      end do
   end subroutine add_supports
end module linear_element
