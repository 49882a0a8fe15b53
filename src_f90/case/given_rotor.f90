!> A rotor whose matrices another program made: M q'' + (C + Omega G) q' + K q = f in any displacements q, for a shaft
!> that turns from y to z.
module given_rotor
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: given_rotor_type

   type :: given_rotor_type
      !> (n, n), SI units.
      real(wp), allocatable, dimension(:, :) :: mass, damping, gyroscopic, stiffness
      !> matmul(station, q) is y and z of station 1, y and z of station 2, ..., m; matmul(slope, q) are the slopes dy/dx
      !> and dz/dx there: (2*stations, n).
      real(wp), allocatable, dimension(:, :) :: station, slope
      !> The mass matrix times a translation of 1 m along y, kg: what gravity acts on.
      real(wp), allocatable :: weighed(:)
      !> kg
      real(wp) :: total_mass = 0
   end type given_rotor_type
end module given_rotor
