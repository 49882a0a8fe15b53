!> Matrices of a whole shaft with its discs in one plane: deflection and slope of station 1, of station 2, ... The other
!> plane has the same ones.
module shaft_matrices
   ! heap: matrices of all displacements of a shaft
   use kinds, only: wp
   use rotor_groups, only: elastic_type
   use beam_section, only: beam_section_type
   implicit none (type, external)
   private
   public :: shaft_matrices_type, new_shaft_matrices

   !> Mass and gyroscopic matrix as in `beam_section`, and stiffness; (2*stations, 2*stations).
   type :: shaft_matrices_type
      real(wp), allocatable :: mass(:, :), gyroscopic(:, :), stiffness(:, :)
   end type shaft_matrices_type

contains

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
end module shaft_matrices
