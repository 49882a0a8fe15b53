!> A free rotor before it is put into its bearings, in any displacements: M q'' + (C + Omega G) q' + K q = f.
module rotor_component
   ! heap: matrices of all displacements of a shaft
   use kinds, only: wp
   use rotor_groups, only: elastic_type
   use given_rotor, only: given_rotor_type
   use shaft_matrices, only: shaft_matrices_type, new_shaft_matrices
   implicit none (type, external)
   private
   public :: rotor_component_type, shaft_component, given_component, in_planes

   type :: rotor_component_type
      !> 2: the displacements go in pairs, along y and z, and both planes have the same mass and stiffness; else 1.
      integer :: planes = 1
      !> The sense in which the shaft turns: 1 clockwise, from y to z, -1 anticlockwise.
      real(wp) :: sense = 1
      !> (n, n); G stands for a shaft that turns in this sense.
      real(wp), allocatable, dimension(:, :) :: mass, damping, gyroscopic, stiffness
      !> Deflections and slopes of the shaft at its stations: matmul(station, q) is y and z of station 1, y and z of
      !> station 2, ... (2*stations, n). Slopes are 0 where nothing is known of them.
      real(wp), allocatable, dimension(:, :) :: station, slope
      !> What gravity acts on: its force is -gravity*weighed, kg.
      real(wp), allocatable :: weighed(:)
      !> kg
      real(wp) :: total_mass = 0
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

   !> A rotor of matrices that are given, turning clockwise.
   pure function given_component(given) result(component)
      type(given_rotor_type), intent(in) :: given
      type(rotor_component_type) :: component
      component%mass = given%mass
      component%damping = given%damping
      component%gyroscopic = given%gyroscopic
      component%stiffness = given%stiffness
      component%station = given%station
      component%slope = given%slope
      component%weighed = given%weighed
      component%total_mass = given%total_mass
   end function given_component

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
end module rotor_component
