!> One derived type for each namelist group of a rotor: rigid, a shaft, or the matrices of another program. Stations
!> count from 1, between the sections of the shaft and at its ends. SI units.
module rotor_groups
   use kinds, only: wp, pi
   use case_groups, only: unset, is_set
   implicit none (type, external)
   private
   public :: rotor_type, elastic_type, shaft_type, disc_type, unbalance_type, load_type, reduction_type, &
      & most_bearings, most_sections, most_stations, given_rotor_type

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

   !> Up to which frequency, Hz, the shaft's modes on fixed bearings are kept (unset: by themselves); modes above a
   !> frequency, Hz, are damped with a damping ratio.
   type :: reduction_type
      real(wp) :: frequency = unset, damp_above = 500, damping_ratio = 0.3_wp
   end type reduction_type

   !> A rotor that bends, and what is on it.
   type :: elastic_type
      type(shaft_type) :: shaft
      !> The HDF5 file of matrices that stands for the shaft, and what was read from it; empty: there is a shaft.
      character(len=:), allocatable :: rotor_file
      type(given_rotor_type), allocatable :: given
      type(disc_type), allocatable :: discs(:)
      type(unbalance_type), allocatable :: unbalances(:)
      type(load_type), allocatable :: loads(:)
      type(reduction_type) :: reduction
   contains
      procedure :: begin
      procedure :: mass
   end type elastic_type

   type :: rotor_type
      !> Not allocated: the rotor is a rigid journal.
      type(elastic_type), allocatable :: elastic
      !> Mass carried by the bearing, kg; unbalance, kg m.
      real(wp) :: mass = 2000, unbalance = 0.010_wp
      !> ISO 21940-11 grade, mm/s, that replaces the unbalance; its speed (unset: the highest of the run).
      real(wp) :: balance_grade = unset, balance_speed_rpm = unset
      real(wp) :: gravity = 9.81_wp
      !> Extra force on the journal along y and z, N.
      real(wp) :: static_load(2) = 0
   contains
      procedure :: is_rigid
      procedure :: station_count
   end type rotor_type

contains

   !> One with this number of parts, of which nothing is given yet.
   subroutine begin(self, discs, unbalances, loads)
      class(elastic_type), intent(out) :: self
      integer, intent(in) :: discs, unbalances, loads
      allocate (self%discs(discs), self%unbalances(unbalances), self%loads(loads))
      self%rotor_file = ''
      self%shaft%length = [unset]
      self%shaft%diameter = [unset]
      self%shaft%bore = [0.0_wp]
   end subroutine begin

   !> Mass of the shaft and its discs, kg; there must be a shaft.
   pure real(wp) function mass(self)
      class(elastic_type), intent(in) :: self
      mass = self%shaft%mass() + sum(self%discs%mass)
   end function mass

   elemental logical function is_rigid(self)
      class(rotor_type), intent(in) :: self
      is_rigid = .not. allocated(self%elastic)
   end function is_rigid

   !> Stations of the shaft; 0 of a rigid journal, and of a rotor from a file, which has its own.
   pure integer function station_count(self)
      class(rotor_type), intent(in) :: self
      station_count = 0
      if (self%is_rigid()) return
      if (self%elastic%shaft%is_given()) station_count = size(self%elastic%shaft%length) + 1
   end function station_count

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
end module rotor_groups
