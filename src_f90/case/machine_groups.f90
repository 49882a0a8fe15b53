!> One derived type for each namelist group of a machine: a shaft that turns in several bearings. Stations count from 1,
!> between the sections of the shaft and at its ends. SI units.
module machine_groups
   use kinds, only: wp
   use case_groups, only: bearing_type, oil_type, pads_type, pivot_type, friction_type, asperity_type, film_type, unset
   use given_rotor, only: given_rotor_type
   implicit none (type, external)
   private
   public :: machine_type

   !> The sections of the shaft from station to station, m; its steel.
   type :: shaft_type
      real(wp), allocatable :: length(:), diameter(:), bore(:)
      real(wp) :: young_modulus = 2.1e11_wp, poisson_ratio = 0.3_wp, density = 7850
   end type shaft_type

   !> A rigid disc: kg, kg m^2.
   type :: disc_type
      integer :: station = 0
      real(wp) :: mass = 0, polar_inertia = 0, diametral_inertia = 0
   end type disc_type

   !> Mass times eccentricity, kg m, and its angle from that of the shaft, in the sense of rotation.
   type :: unbalance_type
      integer :: station = 0
      real(wp) :: moment = 0, angle_deg = 0
   end type unbalance_type

   !> A static force along y and z, N, beside the weight.
   type :: load_type
      integer :: station = 0
      real(wp) :: force(2) = 0
   end type load_type

   !> What a bearing stands on: the mass that moves with its housing, kg, the pads' included; N/m and N s/m along y
   !> and z.
   type :: support_type
      real(wp) :: mass = 0, stiffness(2) = unset, damping(2) = 0
   end type support_type

   !> Up to which frequency, Hz, the shaft's modes on fixed bearings are kept (unset: by themselves); modes above a
   !> frequency, Hz, are damped with a damping ratio.
   type :: reduction_type
      real(wp) :: frequency = unset, damp_above = 500, damping_ratio = 0.3_wp
   end type reduction_type

   type :: machine_bearing_type
      character(len=:), allocatable :: name
      integer :: station = 0
      !> How far the bearing stands from the line of the others, y and z, m.
      real(wp) :: offset(2) = 0
      !> Not allocated: the bearing stands on the ground.
      type(support_type), allocatable :: support
      type(bearing_type) :: bearing
      type(oil_type) :: oil
      type(pads_type) :: pads
      type(pivot_type) :: pivot
      type(friction_type) :: friction
      type(asperity_type) :: asperity
      type(film_type) :: film
   end type machine_bearing_type

   type :: machine_type
      type(shaft_type) :: shaft
      !> The HDF5 file of matrices that stands for the shaft, and what was read from it; empty: there is a shaft.
      character(len=:), allocatable :: rotor_file
      type(given_rotor_type), allocatable :: given
      type(disc_type), allocatable :: discs(:)
      type(unbalance_type), allocatable :: unbalances(:)
      type(load_type), allocatable :: loads(:)
      type(reduction_type) :: reduction
      type(machine_bearing_type), allocatable :: bearings(:)
   end type machine_type
end module machine_groups
