!> The equations of an elastic rotor on its journals, with few displacements: what the time integration has of a shaft.
module rotor_matrices
   ! heap: matrices of all displacements of a shaft
   use kinds, only: wp, pi
   use case_inputs, only: case_type
   use rotor_component, only: rotor_component_type, static_forces, unbalance_moments
   use fixed_interface, only: fixed_interface_type
   use mode_selection, only: mode_damping
   use linear_element, only: relative_displacements, add_supports
   implicit none (type, external)
   private
   public :: rotor_matrices_type, reduced_rotor

   !> M x'' + (C + Omega G) x' + K x = load + forces of the bearings + unbalance. Displacements x: first those of the
   !> journals relative to their bearings, y and z of each; then those of the housings that have supports, y and z of
   !> each, m, 0 where the spring is not loaded; then the amplitudes of the modes with the journals held, in y and z of
   !> each (kg^1/2 m), whose mass is 1. The weight of a housing acts on its support.
   type :: rotor_matrices_type
      integer :: journals = 0
      real(wp), allocatable, dimension(:, :) :: mass, damping, gyroscopic, stiffness
      !> Damping of the displacements that the reduction adds, as they are modes above reduction%damp_above, 1/s.
      real(wp), allocatable :: high_damping(:)
      !> Weight (along -y), static loads, and what the offsets of the bearings bend.
      real(wp), allocatable :: load(:)
      !> (n, 2): the force of the unbalances at the shaft angle phi is Omega**2*(unbalance(:, 1)*cos(phi)
      !> + unbalance(:, 2)*sin(phi)) + Omega'*(unbalance(:, 1)*sin(phi) - unbalance(:, 2)*cos(phi)).
      real(wp), allocatable :: unbalance(:, :)
      !> Where the shaft is at its stations, m: y and z of station 1, y and z of station 2, ... are
      !> matmul(station, x) + station_offset. The offset has what the bearings' offsets and the modes that are left out
      !> have of the static deflection, which is exact so. The same of the slopes dy/dx and dz/dx.
      real(wp), allocatable :: station(:, :), station_offset(:), slope(:, :), slope_offset(:)
      !> Of the rotor without housings, kg.
      real(wp) :: total_mass = 0
      !> Frequencies of the kept modes, Hz (each in both planes of a shaft); of the first that is left out, 0: none is.
      real(wp), allocatable :: mode_frequency(:)
      real(wp) :: left_out_frequency = 0
      !> Relative errors of amplitudes as `mode_selection` finds them; 0 where the number of modes was given.
      real(wp) :: truncation_error = 0, damping_error = 0
   end type rotor_matrices_type

contains

   !> The rotor of a case with this many modes in its bearings.
   function reduced_rotor(inputs, component, fixed, modes) result(r)
      type(case_type), intent(in) :: inputs
      type(rotor_component_type), intent(in) :: component
      type(fixed_interface_type), intent(in) :: fixed
      integer, intent(in) :: modes
      type(rotor_matrices_type) :: r
      real(wp), allocatable :: basis(:, :), into(:, :), offset(:), force(:), deflection(:)
      integer :: b
      r%journals = size(inputs%bearings)
      basis = fixed%basis(modes)
      into = relative_displacements(inputs%bearings, size(basis, 2))
      offset = [(inputs%bearings(b)%offset, b=1, r%journals)]
      call reduce_matrices(component, basis, into, 2*r%journals, r)
      force = matmul(static_forces(inputs%rotor%elastic%loads, size(component%station, 1)), component%station) &
         & - inputs%rotor%gravity*component%weighed
      deflection = matmul(basis(:, :2*r%journals), offset)
      r%load = matmul(matmul(force - matmul(component%stiffness, deflection), basis), into)
      deflection = deflection + fixed%residual_deflection(force, modes)
      basis = matmul(basis, into)
      r%unbalance = transpose(matmul(unbalance_moments(inputs%rotor%elastic%unbalances, size(component%station, 1), &
         & component%sense), matmul(component%station, basis)))
      r%station = matmul(component%station, basis)
      r%station_offset = matmul(component%station, deflection)
      r%slope = matmul(component%slope, basis)
      r%slope_offset = matmul(component%slope, deflection)
      r%total_mass = component%total_mass
      r%mode_frequency = fixed%frequency(:modes)/(2*pi)
      if (modes < size(fixed%frequency)) r%left_out_frequency = fixed%frequency(modes + 1)/(2*pi)
      call add_modal_damping(mode_damping(inputs%rotor%elastic%reduction, fixed, modes), fixed%planes, r)
      call add_supports(inputs%bearings, inputs%rotor%gravity, r%mass, r%damping, r%stiffness, r%load)
   end function reduced_rotor

   !> The matrices in the displacements x. The mass of the modes is 1 and no stiffness joins them, but for rounding.
   pure subroutine reduce_matrices(component, basis, into, journals, r)
      type(rotor_component_type), intent(in) :: component
      real(wp), intent(in) :: basis(:, :), into(:, :)
      integer, intent(in) :: journals
      type(rotor_matrices_type), intent(inout) :: r
      real(wp), allocatable :: stiffness(:, :), mass(:, :)
      real(wp) :: own
      integer :: i
      mass = projected(component%mass, basis)
      stiffness = projected(component%stiffness, basis)
      do i = journals + 1, size(basis, 2)
         own = stiffness(i, i)
         stiffness(i, :) = 0
         stiffness(:, i) = 0
         stiffness(i, i) = own
         mass(i, journals + 1:) = 0
         mass(i, i) = 1
      end do
      r%mass = projected(mass, into)
      r%stiffness = projected(stiffness, into)
      r%damping = projected(projected(component%damping, basis), into)
      r%gyroscopic = projected(projected(component%gyroscopic, basis), into)
   end subroutine reduce_matrices

   pure function projected(matrix, basis)
      real(wp), intent(in) :: matrix(:, :), basis(:, :)
      real(wp) :: projected(size(basis, 2), size(basis, 2))
      projected = matmul(transpose(basis), matmul(matrix, basis))
   end function projected

   !> Adds the damping of modes to the last displacements, which are theirs, in each plane.
   pure subroutine add_modal_damping(modal_damping, planes, r)
      real(wp), intent(in) :: modal_damping(:)
      integer, intent(in) :: planes
      type(rotor_matrices_type), intent(inout) :: r
      integer :: i, at
      allocate (r%high_damping(size(r%damping, 1)), source=0.0_wp)
      do i = 1, planes*size(modal_damping)
         at = size(r%damping, 1) - planes*size(modal_damping) + i
         r%high_damping(at) = modal_damping((i + planes - 1)/planes)
         r%damping(at, at) = r%damping(at, at) + r%high_damping(at)
      end do
   end subroutine add_modal_damping
end module rotor_matrices
