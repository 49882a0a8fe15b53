!> One derived type for each namelist group of a case. The defaults are Tables 1 and 2 of Dyk et al. 2023, so a default
!> case is the paper's bearing. SI units unless a name says otherwise. What each variable means, and which words a text
!> may be, stands in the list of variables, case_fields.
module case_groups
   use kinds, only: wp, pi
   use text, only: to_text, newline
   use task_groups, only: unset, is_set, about_type, operation_type, thermal_type, start_type, held_type, &
      & integration_type, output_type, coefficients_type, periodic_type, branch_type
   implicit none (type, external)
   private
   public :: max_pads, most_ratios, unset, is_set, in_range, mass_range, inertia_range, centre_range, &
      & temperature_range, viscosity_range, clearance_range, about_type, operation_type, thermal_type, start_type, &
      & held_type, integration_type, output_type, coefficients_type, periodic_type, branch_type, bearing_type, &
      & oil_type, pads_type, pivot_type, friction_type, asperity_type, film_type, support_type, damper_type, &
      & mount_type, linear_bearing_type, rotor_type, elastic_type, shaft_type, disc_type, unbalance_type, load_type, &
      & reduction_type, most_bearings, most_sections, most_stations, given_rotor_type, station_element_type, &
      & impeller_type, lateral_type

   !> Most pads of a bearing.
   integer, parameter :: max_pads = 24
   !> Most whirl frequencies of an analysis.
   integer, parameter :: most_ratios = 1000
   !> What the input allows of the pads, kg, kg m^2 and m: their masses may follow from other variables.
   real(wp), parameter :: mass_range(2) = [1e-9_wp, 1e9_wp], inertia_range(2) = [1e-15_wp, 1e12_wp]
   real(wp), parameter :: centre_range(2) = [-100.0_wp, 100.0_wp]
   !> What it allows of the pad clearance, over the journal's radius.
   real(wp), parameter :: clearance_range(2) = [1e-5_wp, 0.05_wp]
   !> What it allows of temperatures, C, and of the oil's viscosity, Pa s.
   real(wp), parameter :: temperature_range(2) = [-100.0_wp, 500.0_wp], viscosity_range(2) = [1e-6_wp, 10.0_wp]

   !> The oil; temperatures in C.
   type :: oil_type
      character(len=:), allocatable :: law
      !> Walther: an ISO viscosity grade, or the kinematic viscosities at two temperatures, m^2/s; density at
      !> 15 C, kg/m^3 (unset: `density`), and its slope, kg/(m^3 K), which make them dynamic ones.
      real(wp) :: grade = unset
      real(wp) :: kinematic_viscosity(2) = unset, at_temperature(2) = [40.0_wp, 100.0_wp]
      real(wp) :: density_at_15 = unset, density_slope = 0
      !> Exponential: Pa s at a temperature; 1/K.
      real(wp) :: reference_viscosity = unset, reference_temperature = 40, temperature_exponent = unset
      !> Of the heat balance: kg/m^3, J/(kg K), W/(m K).
      real(wp) :: density = 860, specific_heat = 1950, conductivity = 0.13_wp
      real(wp) :: supply_temperature = 40
      !> Part of a pad's outflow that enters the next pad, where the gap between them is not wider than this.
      real(wp) :: carry_over = 0.8_wp, widest_gap_deg = 60
      !> Nusselt number of the exchange with the shaft; its temperature (unset: it takes no net heat).
      real(wp) :: shaft_nusselt = 3, shaft_temperature = unset
      !> Prandtl number of the eddies of turbulent films.
      real(wp) :: turbulent_prandtl = 0.9_wp
      !> Oil between two pads, m^3.
      real(wp) :: groove_volume = 0
      !> Film coefficient at back and ends of the pads, W/(m^2 K); temperature there (unset: that of the supply).
      real(wp) :: back_coefficient = 100, back_temperature = unset
   end type oil_type

   !> One value a pad.
   type :: pads_type
      real(wp), allocatable :: pivot_angle_deg(:), arc_deg(:), pivot_ratio(:), pivot_distance(:)
      real(wp), allocatable :: mass(:), inertia(:), centre_tangential(:), centre_radial(:)
      !> Moments of inertia of pads that pitch and yaw; how far the pivot stands from the middle along the shaft, m.
      real(wp), allocatable :: inertia_pitch(:), inertia_yaw(:), pivot_axial_offset(:)
      !> What mass, inertia and centre of gravity follow from where they are left out; unset in a complete case. Fixed
      !> pads may leave out all six: then they stay unset.
      real(wp), allocatable :: density(:), thickness(:)
      !> W/(m K); it counts, with the thickness, where films have temperatures.
      real(wp), allocatable :: conductivity(:)
      !> How the pads move and what bends them; their modulus, Pa, ratio of Poisson and linear expansion, 1/K.
      character(len=:), allocatable :: motion, bending
      real(wp), allocatable :: young_modulus(:), poisson_ratio(:), expansion(:)
      !> C; unset: from the temperatures of the films.
      real(wp), allocatable :: temperature(:)
   end type pads_type

   !> A measured law: pivot deflections, m, and forces, N, (2, point).
   type :: measured_type
      real(wp), allocatable :: points(:, :)
   end type measured_type

   type :: pivot_type
      character(len=:), allocatable :: law
      !> One value a pad; the length of the contact of a rocker, m (unset: that of the pad); the stiffness of the linear
      !> law, N/m, and that against the tilt, N m/rad.
      real(wp), allocatable :: socket_radius(:), radius_difference(:), contact_length(:), stiffness(:), &
         & rotational_stiffness(:)
      !> Of ball and socket.
      real(wp) :: young_modulus(2) = 2.1e11_wp, poisson_ratio(2) = 0.3_wp
      real(wp) :: deflection_factor = 4
      !> CSV file of a measured law, or one for each pad, a line each, and what was read from it for each pad.
      character(len=:), allocatable :: file
      type(measured_type), allocatable :: measured(:)
      !> Archard's, m^3/(N m); 0: the wear is not asked for.
      real(wp) :: wear_coefficient = 0
   contains
      procedure :: is_like
      procedure :: file_of
   end type pivot_type

   type :: friction_type
      character(len=:), allocatable :: model
      !> One value a pad.
      real(wp), allocatable :: static_coefficient(:), dynamic_coefficient(:)
      real(wp) :: critical_velocity = 1e-5_wp, decay = 1000
      real(wp) :: stribeck_velocity = 1e-3_wp, stribeck_exponent = 1
      !> Bristle damping unset: eq (28).
      real(wp) :: bristle_stiffness = 1e6_wp, bristle_damping = unset, viscous_coefficient = 0
      real(wp) :: characteristic_load = 1e4_wp
   end type friction_type

   type :: asperity_type
      character(len=:), allocatable :: model
      !> Combined rms roughness sigma of pad and journal, m; composite modulus E' of steel on white metal, Pa; K'.
      real(wp) :: roughness = 0.5e-6_wp, elastic_modulus = 4.7e10_wp, factor = 3e-3_wp
      real(wp) :: friction_coefficient = 0.1_wp
   end type asperity_type

   type :: film_type
      character(len=:), allocatable :: solver, cavitation
      !> Cells along the arc and, on finite volumes, along half the width; modes. 0: the solver's own number.
      integer :: circumferential_cells = 0, axial_cells = 0, axial_modes = 0
      !> Of an iterative solution: relaxation factor, 0: the grid's optimum; residual at which it ends; most SOR sweeps.
      real(wp) :: relaxation = 0, tolerance = 1e-6_wp
      integer :: max_sweeps = 5000
      !> Of forces from tables over that of a film that is just whole; 0: by the march's tolerance.
      real(wp) :: table_tolerance = 0
      !> Closure of turbulent films; Reynolds numbers below which they are laminar, and above which turbulent.
      character(len=:), allocatable :: turbulence
      real(wp) :: laminar_below = 500, turbulent_above = 1000
   end type film_type

   !> What a bearing stands on: the mass that moves with its housing, kg, the pads' included; N/m and N s/m along y
   !> and z.
   type :: support_type
      real(wp) :: mass = 0, stiffness(2) = unset, damping(2) = 0
   end type support_type

   !> A squeeze film damper under a housing: radius, length of a land, radial clearance, m; the oil's viscosity, Pa s.
   type :: damper_type
      real(wp) :: radius = unset, length = unset, clearance = unset, viscosity = unset
      !> 'pi': the film cavitates where it is pulled; 'full': nowhere; 'sealed': nowhere, and no oil leaves at the ends.
      character(len=:), allocatable :: film
      integer :: lands = 1
      !> Where its ring is in the clearance while the spring of the support is unloaded, y and z, m.
      real(wp) :: offset(2) = 0
   end type damper_type

   !> What holds a rotor at a station, whatever it is made of.
   type :: mount_type
      !> Empty where it is the only one, with a rigid journal; 'film': of pads, 'linear': of coefficients.
      character(len=:), allocatable :: name, kind
      !> The station of an elastic rotor that is in it, and how far it stands from the line of the others, y and z, m.
      integer :: station = 0
      real(wp) :: offset(2) = 0
      !> Not allocated: it stands on the ground.
      type(support_type), allocatable :: support
      !> Not allocated: none damps its housing.
      type(damper_type), allocatable :: damper
   contains
      procedure :: label
      procedure :: title
      procedure :: suffix
   end type mount_type

   !> A linear element between a station and the ground, another station or the housing of a bearing, or between a
   !> housing and the ground: a seal, an impeller, a spring. Coefficients yy, yz, zy, zz, N/m, N s/m and kg: its force
   !> is -K u - C u' - M u''.
   type :: station_element_type
      integer :: station = 0, to_station = 0
      !> The bearing whose housing is its other end; empty: none is.
      character(len=:), allocatable :: housing
      !> Whether it stands between that and the ground; its station is then that of the bearing. No variable.
      logical :: under_housing = .false.
      !> What results call it; where its force vanishes, y and z, m. No variables of the input.
      character(len=:), allocatable :: label
      real(wp) :: origin(2) = 0
      real(wp), dimension(4) :: stiffness = 0, damping = 0, mass = 0
      !> Beside the stiffness, N/m: what whirls forward is driven by this times its displacement, across it.
      real(wp) :: cross_stiffness = 0
      !> Whether it acts at the equilibrium, too, or in motion about it alone.
      logical :: static = .true.
      !> Instead of the coefficients: CSV file of them, taken at which frequency, 'own' of a mode or 'synchronous'.
      character(len=:), allocatable :: file, frequency
      !> The level of a stability analysis from which on it is there: 1, as a coupling, or 2, as a seal.
      integer :: level = 2
      !> What was read: rising speeds and whirl frequencies, rad/s (none: they do not depend on it), and the 12
      !> coefficients of stiffness, damping and mass, (coefficient, frequency, speed).
      real(wp), allocatable :: speeds(:), whirls(:), table(:, :, :)
   contains
      procedure :: begin => begin_element
   end type station_element_type

   !> A bearing by coefficients over its journal's displacement in it: of balls, rollers or magnets.
   type, extends(mount_type) :: linear_bearing_type
      type(station_element_type) :: of
   end type linear_bearing_type

   !> A bearing of pads: its group &bearing, and its other groups.
   type, extends(mount_type) :: bearing_type
      real(wp) :: journal_radius = 49.9e-3_wp
      !> One value a pad. The preload, 1 - assembled over pad clearance, is given instead of the latter; unset in a
      !> complete case.
      real(wp), allocatable :: machined_clearance(:), assembled_clearance(:), preload(:), axial_length(:)
      !> Of the oil, where its law is 'constant'; else unset in a complete case.
      real(wp) :: viscosity = 19e-3_wp
      !> C, at which the clearances were measured (unset: they are those in operation); linear expansion of shaft and
      !> housing, 1/K, that of steel; temperature of the housing (unset: that of the supply).
      real(wp) :: clearance_temperature = unset, shaft_expansion = 11e-6_wp, housing_expansion = 11e-6_wp
      real(wp) :: housing_temperature = unset
      real(wp) :: supply_pressure = 0, ambient_pressure = 0, cavitation_pressure = 0
      !> Along y and z over the distance along the shaft, rad, of a rigid journal, and of the housing on a shaft.
      real(wp) :: slope(2) = 0, misalignment(2) = 0
      !> 'film': the films count the slope of a shaft; 'ignored'; 'auto': where pads pitch.
      character(len=:), allocatable :: shaft_slope
      type(oil_type) :: oil
      type(pads_type) :: pads
      type(pivot_type) :: pivot
      type(friction_type) :: friction
      type(asperity_type) :: asperity
      type(film_type) :: film
   contains
      procedure :: pad_count
      procedure :: clearance
      procedure :: changes_shape
      procedure :: tilting
      procedure :: tilting_radial
      procedure :: pitching
      procedure :: yawing
   end type bearing_type

   !> The paper's.
   interface bearing_type
      module procedure new_bearing
   end interface bearing_type

   ! Groups of a rotor: rigid, a shaft, or the matrices of another program. Stations count from 1, between the sections
   ! of the shaft and at its ends.

   !> The matrices of another program.
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
      !> Viscous damping of its bending in the turning frame over its stiffness, s.
      real(wp) :: internal_damping = 0
   contains
      procedure :: is_given
      procedure :: mass => shaft_mass
   end type shaft_type

   !> A rigid disc: kg, kg m^2; how far its axis is off that of the shaft, rad, and where, as of an unbalance.
   type :: disc_type
      integer :: station = 0
      real(wp) :: mass = 0, polar_inertia = 0, diametral_inertia = 0
      real(wp) :: skew = 0, skew_angle_deg = 0
   end type disc_type

   !> Mass times eccentricity, kg m, and its angle from that of the shaft, in the sense of rotation.
   type :: unbalance_type
      integer :: station = 0
      real(wp) :: moment = 0, angle_deg = 0
   end type unbalance_type

   !> How far the shaft is bent without any load, m, from the line of its bearings, and where, as of an unbalance.
   type :: bow_type
      integer :: station = 0
      real(wp) :: displacement = 0, angle_deg = 0
   end type bow_type

   !> A static force along y and z, N, beside the weight.
   type :: load_type
      integer :: station = 0
      real(wp) :: force(2) = 0
   end type load_type

   !> A stage of a compressor or turbine, whose cross-coupled stiffness API 617 anticipates: W, m, kg/m^3.
   type :: impeller_type
      integer :: station = 0
      !> 'centrifugal' or 'axial'.
      character(len=:), allocatable :: kind
      !> Width of the discharge, or height of the blades.
      real(wp) :: power = unset, diameter = unset, width = unset
      real(wp) :: suction_density = unset, discharge_density = unset
   end type impeller_type

   !> What a lateral analysis needs beside the machine: speeds, rpm (the highest operating speed is that of the case);
   !> what the assembled clearances have more at their minimum and maximum, m; places whose vibration counts.
   type :: lateral_type
      real(wp) :: lowest_rpm = unset, first_rpm = unset, last_rpm = unset, clearance_change(2) = 0
      !> Directions of the probes from +y towards +z; radial clearances, m.
      real(wp) :: probe_direction_deg(2) = [-45.0_wp, 45.0_wp]
      real(wp), allocatable :: probe_station(:), close_station(:), close_clearance(:)
      !> Where the cross-coupled stiffness acts; 0: in the middle of the bearings, or at overhung impellers.
      integer :: cross_station = 0
   end type lateral_type

   !> Up to which frequency, Hz, the shaft's modes on fixed bearings are kept; modes above a frequency, Hz, are damped
   !> with a damping ratio. Unset, both frequencies follow from what moves the shaft.
   type :: reduction_type
      real(wp) :: frequency = unset, damp_above = unset, damping_ratio = 0.3_wp
   end type reduction_type

   !> A rotor that bends, and what is on it.
   type :: elastic_type
      type(shaft_type) :: shaft
      !> The HDF5 file of matrices that stands for the shaft, and what was read from it; empty: there is a shaft.
      character(len=:), allocatable :: rotor_file
      type(given_rotor_type), allocatable :: given
      type(disc_type), allocatable :: discs(:)
      type(unbalance_type), allocatable :: unbalances(:)
      type(bow_type), allocatable :: bows(:)
      type(load_type), allocatable :: loads(:)
      type(station_element_type), allocatable :: elements(:)
      !> Bearings by coefficients, beside those of pads.
      type(linear_bearing_type), allocatable :: linear(:)
      type(impeller_type), allocatable :: impellers(:)
      !> Not allocated: none is asked for.
      type(lateral_type), allocatable :: lateral
      type(reduction_type) :: reduction
   contains
      procedure :: begin
      procedure :: mass
      procedure :: is_balanced
      procedure :: balance
   end type elastic_type

   type :: rotor_type
      !> Not allocated: the rotor is a rigid journal.
      type(elastic_type), allocatable :: elastic
      !> Mass carried by the bearing, kg; unbalance, kg m.
      real(wp) :: mass = 2000, unbalance = 0.010_wp
      !> ISO 21940-11 grade, mm/s, instead of the unbalance; its speed (unset: the highest of the run).
      real(wp) :: balance_grade = unset, balance_speed_rpm = unset
      real(wp) :: gravity = 9.81_wp
      !> Extra force on the journal along y and z, N.
      real(wp) :: static_load(2) = 0
   contains
      procedure :: is_rigid
      procedure :: station_count
   end type rotor_type

contains

   !> Whether a number lies from the first of two others to the second.
   pure logical function in_range(x, range)
      real(wp), intent(in) :: x, range(2)
      in_range = x >= range(1) .and. x <= range(2)
   end function in_range

   pure type(bearing_type) function new_bearing() result(bearing)
      bearing%name = ''
      bearing%kind = 'film'
      bearing%shaft_slope = 'auto'
      bearing%machined_clearance = [100e-6_wp, 100e-6_wp]
      bearing%assembled_clearance = [80e-6_wp, 80e-6_wp]
      bearing%preload = [unset, unset]
      bearing%axial_length = [100e-3_wp, 100e-3_wp]
      bearing%oil%law = 'constant'
      associate (pads => bearing%pads)
         pads%pivot_angle_deg = [-45.0_wp, 225.0_wp]
         pads%arc_deg = [69.3_wp, 69.3_wp]
         pads%pivot_ratio = [0.5_wp, 0.5_wp]
         pads%pivot_distance = [14e-3_wp, 14e-3_wp]
         pads%mass = [0.8108_wp, 0.8108_wp]
         pads%inertia = [4.055e-4_wp, 4.055e-4_wp]
         pads%centre_tangential = [0.0_wp, 0.0_wp]
         pads%centre_radial = [-10.1e-3_wp, -10.1e-3_wp]
         pads%inertia_pitch = [unset, unset]
         pads%inertia_yaw = [unset, unset]
         pads%pivot_axial_offset = [0.0_wp, 0.0_wp]
         pads%density = [unset, unset]
         pads%thickness = [unset, unset]
         pads%conductivity = [50.0_wp, 50.0_wp]
         pads%motion = 'tilting_radial'
         pads%bending = 'none'
         pads%young_modulus = [2.1e11_wp, 2.1e11_wp]
         pads%poisson_ratio = [0.3_wp, 0.3_wp]
         pads%expansion = [11e-6_wp, 11e-6_wp]
         pads%temperature = [unset, unset]
      end associate
      bearing%pivot%law = 'fang'
      bearing%pivot%file = ''
      bearing%pivot%socket_radius = [13e-3_wp, 13e-3_wp]
      bearing%pivot%radius_difference = [15e-6_wp, 15e-6_wp]
      bearing%pivot%contact_length = [unset, unset]
      bearing%pivot%stiffness = [unset, unset]
      bearing%pivot%rotational_stiffness = [0.0_wp, 0.0_wp]
      bearing%friction%model = 'none'
      bearing%friction%static_coefficient = [0.1_wp, 0.1_wp]
      bearing%friction%dynamic_coefficient = [0.05_wp, 0.05_wp]
      bearing%asperity%model = 'greenwood_tripp'
      bearing%film%solver = 'auto'
      bearing%film%cavitation = 'reynolds'
      bearing%film%turbulence = 'none'
   end function new_bearing

   pure integer function pad_count(self)
      class(bearing_type), intent(in) :: self
      pad_count = size(self%pads%pivot_angle_deg)
   end function pad_count

   !> Whether the contact of a pad's pivot has the numbers of another one's, of pivots of the same law.
   pure logical function is_like(self, pad, other, other_pad)
      class(pivot_type), intent(in) :: self
      integer, intent(in) :: pad
      type(pivot_type), intent(in) :: other
      integer, intent(in) :: other_pad
      is_like = all(abs(numbers_of(self, pad) - numbers_of(other, other_pad)) <= 0)
      if (.not. (is_like .and. allocated(self%measured) .and. allocated(other%measured))) return
      associate (one => self%measured(pad)%points, two => other%measured(other_pad)%points)
         is_like = size(one) == size(two)
         if (is_like) is_like = all(abs(one - two) <= 0)
      end associate
   contains
      pure function numbers_of(p, i)
         type(pivot_type), intent(in) :: p
         integer, intent(in) :: i
         real(wp) :: numbers_of(9)
         numbers_of = [p%socket_radius(i), p%radius_difference(i), p%contact_length(i), p%stiffness(i), &
            & p%young_modulus, p%poisson_ratio, p%deflection_factor]
      end function numbers_of
   end function is_like

   !> The file of a pad's measured law: that of all pads, or its line.
   pure function file_of(self, pad) result(file)
      class(pivot_type), intent(in) :: self
      integer, intent(in) :: pad
      character(len=:), allocatable :: file
      integer :: i
      file = self%file
      if (index(file, newline) == 0) return
      do i = 2, pad
         file = file(index(file, newline) + 1:)
      end do
      file = file(:index(file//newline, newline) - 1)
   end function file_of

   !> The bearing clearance c_r, m: of pads that differ the smallest.
   elemental real(wp) function clearance(self)
      class(bearing_type), intent(in) :: self
      clearance = minval(self%assembled_clearance)
   end function clearance

   !> Whether the equilibrium changes its clearances: pads bend, or shaft, pads and housing expand.
   elemental logical function changes_shape(self)
      class(bearing_type), intent(in) :: self
      changes_shape = self%pads%bending /= 'none' .or. is_set(self%clearance_temperature)
   end function changes_shape

   !> False for pads that are fixed: lobes of a plain bearing.
   elemental logical function tilting(self)
      class(bearing_type), intent(in) :: self
      tilting = self%pads%motion /= 'fixed'
   end function tilting

   elemental logical function tilting_radial(self)
      class(bearing_type), intent(in) :: self
      tilting_radial = index(self%pads%motion, 'radial') > 0
   end function tilting_radial

   !> Whether its pads follow a slope of the journal outward, and one along the pad.
   elemental logical function pitching(self)
      class(bearing_type), intent(in) :: self
      pitching = index(self%pads%motion, 'pitch') > 0
   end function pitching

   elemental logical function yawing(self)
      class(bearing_type), intent(in) :: self
      yawing = index(self%pads%motion, 'yaw') > 0
   end function yawing

   !> "bearing 'drive_end'", and what follows it; empty for one without name.
   pure function label(self, ending) result(text)
      class(mount_type), intent(in) :: self
      character(len=*), intent(in), optional :: ending
      character(len=:), allocatable :: text
      text = ''
      if (self%name == '') return
      text = 'bearing '''//self%name//''''
      if (present(ending)) text = text//ending
   end function label

   !> "bearing 'drive_end' at station 2: "; empty for one without name.
   pure function title(self) result(text)
      class(mount_type), intent(in) :: self
      character(len=:), allocatable :: text
      text = self%label(' at station '//to_text(self%station)//': ')
   end function title

   !> What stands behind the names of its groups: ":drive_end"; nothing for one without name.
   pure function suffix(self) result(text)
      class(mount_type), intent(in) :: self
      character(len=:), allocatable :: text
      text = ''
      if (self%name /= '') text = ':'//self%name
   end function suffix

   !> One with this number of parts, of which nothing is given yet.
   subroutine begin(self, discs, unbalances, loads, elements, impellers, bows, lateral)
      class(elastic_type), intent(out) :: self
      integer, intent(in) :: discs, unbalances, loads
      integer, intent(in), optional :: elements, impellers, bows
      logical, intent(in), optional :: lateral
      integer :: i, n
      n = 0
      if (present(elements)) n = elements
      allocate (self%discs(discs), self%unbalances(unbalances), self%loads(loads), self%elements(n))
      do i = 1, n
         call self%elements(i)%begin()
      end do
      n = 0
      if (present(impellers)) n = impellers
      allocate (self%impellers(n))
      do i = 1, n
         self%impellers(i)%kind = 'centrifugal'
      end do
      n = 0
      if (present(bows)) n = bows
      allocate (self%bows(n))
      if (present(lateral)) then
         if (lateral) self%lateral = lateral_type(probe_station=[unset], close_station=[unset], &
            & close_clearance=[unset])
      end if
      allocate (self%linear(0))
      self%rotor_file = ''
      self%shaft%length = [unset]
      self%shaft%diameter = [unset]
      self%shaft%bore = [0.0_wp]
   end subroutine begin

   pure subroutine begin_element(self)
      class(station_element_type), intent(inout) :: self
      self%housing = ''
      self%file = ''
      self%frequency = 'own'
   end subroutine begin_element

   !> Mass of the shaft and its discs, kg; there must be a shaft.
   pure real(wp) function mass(self)
      class(elastic_type), intent(in) :: self
      mass = self%shaft%mass() + sum(self%discs%mass)
   end function mass

   !> Whether nothing that turns with the shaft bends it.
   pure logical function is_balanced(self)
      class(elastic_type), intent(in) :: self
      is_balanced = .not. (any(abs(self%unbalances%moment) > 0) .or. any(abs(self%bows%displacement) > 0) .or. &
         & any(abs(self%discs%skew) > 0))
   end function is_balanced

   !> Takes that away.
   pure subroutine balance(self)
      class(elastic_type), intent(inout) :: self
      self%unbalances%moment = 0
      self%bows%displacement = 0
      self%discs%skew = 0
   end subroutine balance

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
end module case_groups
