!> A free rotor before it is put into its bearings, in any displacements: M q'' + (C + Omega G) q' + K q = f.
module rotor_component
   ! heap: matrices of all displacements of a shaft
   use kinds, only: wp
   use rotor_groups, only: elastic_type, given_rotor_type
   use beam_section, only: beam_section_type
   implicit none (type, external)
   private
   public :: rotor_component_type, shaft_component, in_planes

   !> Mass and gyroscopic matrix as in `beam_section`, and stiffness; (2*stations, 2*stations).
   type :: shaft_matrices_type
      real(wp), allocatable :: mass(:, :), gyroscopic(:, :), stiffness(:, :)
   end type shaft_matrices_type

   type, extends(given_rotor_type) :: rotor_component_type
      !> 2: the displacements go in pairs, along y and z, and both planes have the same mass and stiffness; else 1.
      integer :: planes = 1
      !> The sense in which the shaft turns: 1 clockwise, from y to z, -1 anticlockwise.
      real(wp) :: sense = 1
   contains
      procedure :: turn_in
   end type rotor_component_type

contains

   !> Has the shaft turn in a sense: 1 clockwise, -1 anticlockwise.
   pure subroutine turn_in(self, sense)
      class(rotor_component_type), intent(inout) :: self
      real(wp), intent(in) :: sense
      self%gyroscopic = sense*self%sense*self%gyroscopic
      self%sense = sense
   end subroutine turn_in

   !> A shaft with its discs, turning clockwise.
   pure function shaft_component(rotor) result(component)
      type(elastic_type), intent(in) :: rotor
      type(rotor_component_type) :: component
      type(shaft_matrices_type) :: shaft
      real(wp), allocatable :: pick(:, :)
      integer :: stations, n, i
      shaft = new_shaft_matrices(rotor)
      stations = size(shaft%mass, 1)/2
      n = 4*stations
      component%planes = 2
      component%mass = in_planes(shaft%mass, 2)
      component%stiffness = in_planes(shaft%stiffness, 2)
      allocate (component%damping(n, n), component%gyroscopic(n, n), source=0.0_wp)
      component%gyroscopic(1::2, 2::2) = shaft%gyroscopic
      component%gyroscopic(2::2, 1::2) = -shaft%gyroscopic
      allocate (pick(stations, 2*stations), source=0.0_wp)
      do i = 1, stations
         pick(i, 2*i - 1) = 1
      end do
      component%station = in_planes(pick, 2)
      component%slope = in_planes(cshift(pick, -1, dim=2), 2)
      ! the mass times a translation along y
      component%weighed = sum(component%mass(:, 1::4), dim=2)
      component%total_mass = sum(component%weighed(1::4))
   end function shaft_component

   !> A matrix that acts alike in this many planes, whose rows and columns take turns.
   pure function in_planes(matrix, planes) result(all)
      real(wp), intent(in) :: matrix(:, :)
      integer, intent(in) :: planes
      real(wp) :: all(planes*size(matrix, 1), planes*size(matrix, 2))
      integer :: p
      all = 0
      do p = 1, planes
         all(p::planes, p::planes) = matrix
      end do
   end function in_planes

   ! Matrices of a whole shaft with its discs in one plane: deflection and slope of station 1, of station 2, ... The
   ! other plane has the same ones.

   !> Those of a shaft and its discs.
   pure function new_shaft_matrices(rotor) result(matrices)
      type(elastic_type), intent(in) :: rotor
      type(shaft_matrices_type) :: matrices
      type(beam_section_type) :: section
      integer :: n, i, at
      associate (s => rotor%shaft)
         n = 2*(size(s%length) + 1)
         allocate (matrices%mass(n, n), matrices%gyroscopic(n, n), matrices%stiffness(n, n), source=0.0_wp)
         do i = 1, size(s%length)
            section = beam_section_type(s%length(i), s%diameter(i), s%bore(i), s%young_modulus, s%poisson_ratio, &
               & s%density)
            at = 2*i - 1
            associate (m => matrices%mass(at:at + 3, at:at + 3), k => matrices%stiffness(at:at + 3, at:at + 3), &
               & g => matrices%gyroscopic(at:at + 3, at:at + 3))
               m = m + section%mass()
               k = k + section%stiffness()
               g = g + section%gyroscopic()
            end associate
         end do
      end associate
      do i = 1, size(rotor%discs)
         associate (disc => rotor%discs(i))
            at = 2*disc%station
            matrices%mass(at - 1, at - 1) = matrices%mass(at - 1, at - 1) + disc%mass
            matrices%mass(at, at) = matrices%mass(at, at) + disc%diametral_inertia
            matrices%gyroscopic(at, at) = matrices%gyroscopic(at, at) + disc%polar_inertia
         end associate
      end do
   end function new_shaft_matrices
end module rotor_component
