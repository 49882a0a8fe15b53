!> One derived type for each namelist group of a machine: a shaft that turns in several bearings. Stations count from 1,
!> between the sections of the shaft and at its ends. SI units.
module machine_groups
   use kinds, only: wp, pi
   use case_groups, only: bearing_type, oil_type, pads_type, pivot_type, friction_type, asperity_type, film_type, &
      & unset, is_set
   use given_rotor, only: given_rotor_type
   implicit none (type, external)
   private
   public :: machine_type, shaft_type, disc_type, unbalance_type, load_type, support_type, reduction_type, &
      & machine_bearing_type
   public :: most_bearings, most_sections, most_stations

   !> Most bearings, and sections of a shaft; the highest number of a station, also of a rotor from a file.
   integer, parameter :: most_bearings = 20, most_sections = 500, most_stations = 10000

   !> The sections of the shaft from station to station, m; its steel.
   type :: shaft_type
      real(wp), allocatable :: length(:), diameter(:), bore(:)
      real(wp) :: young_modulus = 2.1e11_wp, poisson_ratio = 0.3_wp, density = 7850
   contains
      procedure :: is_given
      procedure :: mass => shaft_mass
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
   contains
      procedure :: begin
      procedure :: find_bearing
      procedure :: station_count
      procedure :: mass => machine_mass
   end type machine_type

contains

   !> A machine of this number of parts, of which nothing is given yet.
   subroutine begin(self, bearings, discs, unbalances, loads)
      class(machine_type), intent(out) :: self
      integer, intent(in) :: bearings, discs, unbalances, loads
      integer :: b
      allocate (self%bearings(bearings), self%discs(discs), self%unbalances(unbalances), self%loads(loads))
      do b = 1, bearings
         self%bearings(b)%name = ''
      end do
      self%rotor_file = ''
      self%shaft%length = [unset]
      self%shaft%diameter = [unset]
      self%shaft%bore = [0.0_wp]
   end subroutine begin

   !> Number of the bearing of this name; 0 if there is none.
   pure integer function find_bearing(self, name) result(b)
      class(machine_type), intent(in) :: self
      character(len=*), intent(in) :: name
      do b = size(self%bearings), 1, -1
         if (self%bearings(b)%name == name) return
      end do
   end function find_bearing

   !> Stations of the shaft; 0 for a rotor from a file, which has its own.
   pure integer function station_count(self)
      class(machine_type), intent(in) :: self
      station_count = 0
      if (self%shaft%is_given()) station_count = size(self%shaft%length) + 1
   end function station_count

   !> Mass of the shaft and its discs, kg; there must be a shaft.
   pure real(wp) function machine_mass(self) result(mass)
      class(machine_type), intent(in) :: self
      mass = self%shaft%mass() + sum(self%discs%mass)
   end function machine_mass

   !> Whether there is a shaft.
   pure logical function is_given(self)
      class(shaft_type), intent(in) :: self
      is_given = any(is_set(self%length))
   end function is_given

   !> Mass of all sections, kg.
   pure real(wp) function shaft_mass(self) result(mass)
      class(shaft_type), intent(in) :: self
      mass = sum(self%density*pi/4*(self%diameter**2 - self%bore**2)*self%length)
   end function shaft_mass
end module machine_groups
