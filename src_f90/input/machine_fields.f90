!> The variables of a machine, of what there may be several of on its shaft, and of excitations, for the list of all
!> (case_fields).
module machine_fields
   use kinds, only: wp
   use variable_table, only: variable_table_type
   use case_groups, only: elastic_type, support_type, damper_type, mount_type, linear_bearing_type, reduction_type, &
      & station_element_type, disc_type, impeller_type, lateral_type, most_sections, most_stations, &
      & viscosity_range, unset, is_set
   use excitations, only: excitation_type
   use assignments, only: counted
   implicit none (type, external)
   private
   public :: list_parts, list_linear, list_kind, list_support, list_damper, list_reduction, list_excitations

   character(len=*), parameter :: of_element = 'yy, yz, zy, zz of the force on the station against displacement, ' &
      & //'velocity and acceleration towards it from the other end'

contains

   !> The group of the i-th part of a kind.
   subroutine group_of(v, i, all, name, meaning)
      type(variable_table_type), intent(inout) :: v
      integer, intent(in) :: i
      logical, intent(in) :: all
      character(len=*), intent(in) :: name, meaning
      if (all) call v%group(name, meaning)
      if (.not. all) call v%group(name//counted(i), meaning)
   end subroutine group_of

   !> The shaft and what it carries.
   subroutine list_parts(v, rotor, all)
      type(variable_table_type), intent(inout) :: v
      type(elastic_type), intent(inout) :: rotor
      !> Whether each group is listed once, without a number.
      logical, intent(in) :: all
      integer :: i
      associate (shaft => rotor%shaft)
         call v%group('shaft', 'A machine: the sections of its shaft, from station 1 to station 2, from there to ' &
            & //'station 3, ...; *Machines* above')
         call v%list(shaft%length, most_sections, 'length', 1e-6_wp, 1e3_wp, 'm', &
            & 'length of each section', counts='sections')
         call v%each(shaft%diameter, 'sections', 'diameter', 1e-4_wp, 100.0_wp, 'm', 'outer diameter')
         call v%each(shaft%bore, 'sections', 'bore', 0.0_wp, 100.0_wp, 'm', 'inner diameter; 0: solid')
         call v%number(shaft%young_modulus, 'young_modulus', 1e6_wp, 1e14_wp, 'Pa', 'of its material')
         call v%number(shaft%poisson_ratio, 'poisson_ratio', -0.99_wp, 0.5_wp, '1', 'of its material')
         call v%number(shaft%density, 'density', 1.0_wp, 1e5_wp, 'kg/m^3', 'of its material')
         call v%number(shaft%internal_damping, 'internal_damping', 0.0_wp, 1.0_wp, 's', 'viscous damping of its ' &
            & //'bending in the turning frame, over its stiffness')
         do i = 1, size(rotor%discs)
            call list_disc(v, i, all, rotor%discs(i))
         end do
         do i = 1, size(rotor%unbalances)
            call group_of(v, i, all, 'unbalance', 'A machine: an unbalance; one group for each')
            call list_station(v, rotor%unbalances(i)%station)
            call v%number(rotor%unbalances(i)%moment, 'moment', 0.0_wp, 1e6_wp, 'kg m', 'mass times eccentricity')
            call v%number(rotor%unbalances(i)%angle_deg, 'angle_deg', -360.0_wp, 360.0_wp, 'deg', &
               & 'its angle on the shaft, in the sense of rotation')
         end do
         do i = 1, size(rotor%bows)
            call group_of(v, i, all, 'bow', 'A machine: where its shaft is bent without any load; one group for each ' &
               & //'station; *Bent shafts* above')
            call list_station(v, rotor%bows(i)%station)
            call v%number(rotor%bows(i)%displacement, 'displacement', 0.0_wp, 0.1_wp, 'm', 'from the line through ' &
               & //'the stations of bearings')
            call v%number(rotor%bows(i)%angle_deg, 'angle_deg', -360.0_wp, 360.0_wp, 'deg', 'its direction on the ' &
               & //'shaft, as of unbalances')
         end do
         do i = 1, size(rotor%loads)
            call group_of(v, i, all, 'load', 'A machine: a steady force on its shaft, beside the weight; one group ' &
               & //'for each')
            call list_station(v, rotor%loads(i)%station)
            call v%numbers(rotor%loads(i)%force, 'force', -1e12_wp, 1e12_wp, 'N', 'along y and z')
         end do
         do i = 1, size(rotor%elements)
            call list_element(v, i, all, rotor%elements(i))
         end do
         do i = 1, size(rotor%impellers)
            call list_impeller(v, i, all, rotor%impellers(i))
         end do
         if (allocated(rotor%lateral)) call list_lateral(v, rotor%lateral)
      end associate
   end subroutine list_parts

   subroutine list_disc(v, i, all, disc)
      type(variable_table_type), intent(inout) :: v
      integer, intent(in) :: i
      logical, intent(in) :: all
      type(disc_type), intent(inout) :: disc
      call group_of(v, i, all, 'disc', 'A machine: a rigid disc on its shaft; one group for each')
      call list_station(v, disc%station)
      call v%number(disc%mass, 'mass', 0.0_wp, 1e9_wp, 'kg', 'mass')
      call v%number(disc%polar_inertia, 'polar_inertia', 0.0_wp, 1e12_wp, 'kg m^2', 'moment of inertia about ' &
         & //'the axis of the shaft')
      call v%number(disc%diametral_inertia, 'diametral_inertia', 0.0_wp, 1e12_wp, 'kg m^2', 'moment of inertia about ' &
         & //'a diameter')
      call v%number(disc%skew, 'skew', 0.0_wp, 0.1_wp, 'rad', 'angle between its axis and that of the shaft')
      call v%number(disc%skew_angle_deg, 'skew_angle_deg', -360.0_wp, 360.0_wp, 'deg', 'the direction in which the ' &
         & //'axis leans, as of unbalances')
   end subroutine list_disc

   subroutine list_element(v, i, all, element)
      type(variable_table_type), intent(inout) :: v
      integer, intent(in) :: i
      logical, intent(in) :: all
      type(station_element_type), intent(inout) :: element
      call group_of(v, i, all, 'element', 'A machine: a seal, an impeller, a spring: what acts on a station of its ' &
         & //'shaft by coefficients; one group for each; *Elements* above')
      call list_station(v, element%station)
      call list_station(v, element%to_station, 'to_station', 'the station that is its other end; if this and ' &
         & //'housing are left out, the ground is')
      call v%word(element%housing, 'housing', '', 'the bearing with a group support whose housing is its other end; ' &
         & //'without a station: it stands between this and the ground')
      call v%numbers(element%stiffness, 'stiffness', -1e15_wp, 1e15_wp, 'N/m', of_element)
      call v%numbers(element%damping, 'damping', -1e12_wp, 1e12_wp, 'N s/m', of_element)
      call v%numbers(element%mass, 'mass', -1e9_wp, 1e9_wp, 'kg', of_element//'; it has no weight')
      call v%number(element%cross_stiffness, 'cross_stiffness', -1e15_wp, 1e15_wp, 'N/m', 'Q: cross-coupled ' &
         & //'stiffness beside stiffness; > 0 drives forward whirl, whatever the rotation')
      call v%word(element%file, 'file', '', 'instead of stiffness, damping and mass: the CSV file whose columns ' &
         & //'are speed_rpm, frequency_hz (may be left out), k_yy to k_zz, c_yy to c_zz, m_yy to m_zz (also)')
      call v%word(element%frequency, 'frequency', 'own synchronous', 'of a file with frequency_hz: own: modes take ' &
         & //'the coefficients at their own frequency; synchronous: all take them at that of the speed')
      call v%flag(element%static, 'static', 'whether it acts at the equilibrium, too; .false.: only in ' &
         & //'motion about it')
      call v%whole(element%level, 'level', 1.0_wp, 2.0_wp, 'of the lateral report: the level of stability analysis ' &
         & //'from which on it is there; 1: a coupling, 2: a seal')
   end subroutine list_element

   !> A bearing by coefficients, and what it stands on.
   subroutine list_linear(v, bearing)
      type(variable_table_type), intent(inout) :: v
      type(linear_bearing_type), intent(inout) :: bearing
      call v%group('bearing'//bearing%suffix(), '')
      call list_kind(v, bearing%mount_type, bearing%of)
      if (allocated(bearing%support)) call list_support(v, bearing%support, bearing%suffix())
      if (allocated(bearing%damper)) call list_damper(v, bearing%damper, bearing%suffix())
   end subroutine list_linear

   !> Where a bearing of a machine is, and its coefficients, if it has some.
   subroutine list_kind(v, bearing, of)
      type(variable_table_type), intent(inout) :: v
      type(mount_type), intent(inout) :: bearing
      type(station_element_type), intent(inout), optional :: of
      call v%word(bearing%kind, 'kind', 'film linear', 'of a machine: film, tilting or fixed pads; linear: by ' &
         & //'stiffness and damping, as of balls, rollers or magnets; nothing else of this group and no group of ' &
         & //'pads, oil and so on then has an effect')
      call list_station(v, bearing%station)
      call v%numbers(bearing%offset, 'offset', -0.1_wp, 0.1_wp, 'm', &
         & 'of a machine: how far the bearing stands from the line of the others, along y and z')
      if (.not. present(of)) return
      call v%numbers(of%stiffness, 'stiffness', -1e15_wp, 1e15_wp, 'N/m', 'kind = ''linear'': yy, yz, zy, zz of the ' &
         & //'force on the journal against its displacement')
      call v%numbers(of%damping, 'damping', -1e12_wp, 1e12_wp, 'N s/m', 'kind = ''linear'': the same against its ' &
         & //'velocity')
      call v%word(of%file, 'file', '', 'kind = ''linear'': instead of these, the CSV file of them, as of elements')
      call v%word(of%frequency, 'frequency', 'own synchronous', 'of a file with frequency_hz, as of elements')
   end subroutine list_kind

   subroutine list_impeller(v, i, all, impeller)
      type(variable_table_type), intent(inout) :: v
      integer, intent(in) :: i
      logical, intent(in) :: all
      type(impeller_type), intent(inout) :: impeller
      real(wp), parameter :: lightest = 1e-6_wp, heaviest = 1e5_wp
      call group_of(v, i, all, 'impeller', 'A machine: a stage that drives whirl, for the stability levels of API ' &
         & //'617 in the task coefficients; one group for each; *Lateral analysis* above')
      call list_station(v, impeller%station)
      call v%word(impeller%kind, 'kind', 'centrifugal axial', 'which formula holds')
      call v%number(impeller%power, 'power', 1e-3_wp, 1e10_wp, 'W', 'rated power of the stage')
      call v%number(impeller%diameter, 'diameter', 1e-3_wp, 100.0_wp, 'm', 'of the impeller, or mean one of the blades')
      call v%number(impeller%width, 'width', 1e-6_wp, 10.0_wp, 'm', 'narrowest width of impeller or diffuser at ' &
         & //'the discharge, or height of the blades')
      call v%number(impeller%suction_density, 'suction_density', lightest, heaviest, 'kg/m^3', &
         & 'centrifugal: of the gas')
      call v%number(impeller%discharge_density, 'discharge_density', lightest, heaviest, 'kg/m^3', &
         & 'centrifugal: of the gas')
   end subroutine list_impeller

   subroutine list_lateral(v, l)
      type(variable_table_type), intent(inout) :: v
      type(lateral_type), intent(inout) :: l
      call v%group('lateral', 'A machine: what tiltpad-report --lateral needs; the highest operating speed is ' &
         & //'operation%speed_rpm; *Lateral analysis* above')
      call v%number(l%lowest_rpm, 'lowest_rpm', 1e-3_wp, 1e6_wp, 'rpm', 'lowest operating speed; if left out, ' &
         & //'operation%speed_rpm')
      call v%number(l%first_rpm, 'first_rpm', 1e-3_wp, 1e6_wp, 'rpm', 'lowest speed of diagrams; if left out, a ' &
         & //'fifth of operation%speed_rpm')
      call v%number(l%last_rpm, 'last_rpm', 1e-3_wp, 1e6_wp, 'rpm', 'highest speed of diagrams; if left out, 1.25 ' &
         & //'times operation%speed_rpm')
      call v%numbers(l%clearance_change, 'clearance_change', -0.1_wp, 0.1_wp, 'm', 'what the assembled clearances of ' &
         & //'all bearings have more at their minimum (below 0) and at their maximum; pad clearances stay')
      call list_places(l%probe_station, 'probe_station', 1.0_wp, real(most_stations, wp), '1', &
         & 'stations of the vibration probes; if left out, those of the bearings')
      call v%numbers(l%probe_direction_deg, 'probe_direction_deg', -360.0_wp, 360.0_wp, 'deg', 'directions of the ' &
         & //'two probes at each, from +y towards +z')
      call list_places(l%close_station, 'close_station', 1.0_wp, real(most_stations, wp), '1', &
         & 'stations with close clearances, as of seals')
      call list_places(l%close_clearance, 'close_clearance', 1e-9_wp, 0.1_wp, 'm', 'radial running clearance at each')
      call list_station(v, l%cross_station, 'cross_station', 'where the anticipated cross-coupled stiffness acts; if ' &
         & //'left out, nearest to the middle between the outer bearings, or at impellers that overhang')
   contains
      subroutine list_places(values, name, low, high, unit, meaning)
         real(wp), allocatable, intent(inout) :: values(:)
         character(len=*), intent(in) :: name, unit, meaning
         real(wp), intent(in) :: low, high
         call v%list(values, most_sections, name, low, high, unit, meaning)
         v%variables(v%at)%whole = unit == '1'
      end subroutine list_places
   end subroutine list_lateral

   subroutine list_support(v, support, ending)
      type(variable_table_type), intent(inout) :: v
      type(support_type), intent(inout) :: support
      !> What stands behind the name of the group.
      character(len=*), intent(in) :: ending
      call v%group('support'//ending, 'A machine: what a bearing stands on; without this group it stands on the ground')
      call v%number(support%mass, 'mass', 0.0_wp, 1e9_wp, 'kg', &
         & 'mass that moves with the housing of the bearing, that of the pads with it; must be above 0')
      call v%numbers(support%stiffness, 'stiffness', 0.0_wp, 1e15_wp, 'N/m', 'along y and z')
      call v%numbers(support%damping, 'damping', 0.0_wp, 1e12_wp, 'N s/m', 'along y and z')
   end subroutine list_support

   subroutine list_damper(v, damper, ending)
      type(variable_table_type), intent(inout) :: v
      type(damper_type), intent(inout) :: damper
      character(len=*), intent(in) :: ending
      real(wp) :: lands
      call v%group('damper'//ending, 'A machine: a squeeze film damper between the housing of a bearing and the ' &
         & //'ground, beside the spring of its support; *Dampers* above')
      call v%number(damper%radius, 'radius', 1e-4_wp, 10.0_wp, 'm', 'radius of its ring')
      call v%number(damper%length, 'length', 1e-5_wp, 10.0_wp, 'm', 'axial length of its film; with lands of each')
      call v%number(damper%clearance, 'clearance', 1e-6_wp, 0.1_wp, 'm', 'radial clearance')
      call v%number(damper%viscosity, 'viscosity', viscosity_range(1), viscosity_range(2), 'Pa s', 'of its oil')
      call v%word(damper%film, 'film', 'pi full sealed', 'open ends, short film: pi, it cavitates where it is ' &
         & //'pulled; full, it does not; sealed: no oil leaves at the ends, and it does not cavitate')
      lands = damper%lands
      call v%number(lands, 'lands', 1.0_wp, 10.0_wp, '1', 'number of such films side by side, with grooves between', &
         & whole=.true.)
      damper%lands = nint(lands)
      call v%numbers(damper%offset, 'offset', -0.1_wp, 0.1_wp, 'm', 'where the ring is in the clearance, along y ' &
         & //'and z, while the spring is unloaded: upwards where the weight is to bring it to the middle')
   end subroutine list_damper

   subroutine list_reduction(v, r)
      type(variable_table_type), intent(inout) :: v
      type(reduction_type), intent(inout) :: r
      call v%group('reduction', 'A machine: which modes of the shaft are kept')
      call v%number(r%frequency, 'frequency', 1e-3_wp, 1e7_wp, 'Hz', 'modes of the shaft on fixed bearings up to ' &
         & //'this frequency are kept; if left out, as many as the run needs')
      call v%number(r%damp_above, 'damp_above', 0.0_wp, 1e7_wp, 'Hz', 'modes above this frequency are damped; ' &
         & //'if left out, above four times the highest frequency of shaft and excitations, and above 500 Hz')
      call v%number(r%damping_ratio, 'damping_ratio', 0.0_wp, 1.0_wp, '1', 'their damping ratio')
   end subroutine list_reduction

   !> A station; none is given where it is 0.
   subroutine list_station(v, station, name, meaning)
      type(variable_table_type), intent(inout) :: v
      integer, intent(inout) :: station
      character(len=*), intent(in), optional :: name, meaning
      real(wp) :: x
      x = unset
      if (station > 0) x = station
      if (present(name)) then
         call v%number(x, name, 1.0_wp, real(most_stations, wp), '1', meaning, whole=.true.)
      else
         call v%number(x, 'station', 1.0_wp, real(most_stations, wp), '1', 'of a machine: station of its shaft', &
            & whole=.true.)
      end if
      station = 0
      if (is_set(x)) station = nint(x)
   end subroutine list_station

   subroutine list_excitations(v, x, machine, all)
      type(variable_table_type), intent(inout) :: v
      type(excitation_type), intent(inout) :: x(:)
      logical, intent(in) :: machine, all
      integer :: i
      do i = 1, size(x)
         call group_of(v, i, all, 'excitation', 'A force over time on the rotor, for the tasks march and periodic; ' &
            & //'one group for each; *Excitation* above')
         if (machine) call list_station(v, x(i)%station)
         call v%word(x(i)%kind, 'kind', 'harmonic chirp step ramp table', &
            & 'harmonic: a vibration; chirp: one whose frequency changes linearly; step: constant from start to ' &
            & //'end; ramp: from 0 at start to amplitude at end, which it keeps; table: forces from a file')
         call v%number(x(i)%amplitude, 'amplitude', 0.0_wp, 1e12_wp, 'N', 'amplitude of the force; not of a table')
         call v%number(x(i)%direction_deg, 'direction_deg', -360.0_wp, 360.0_wp, 'deg', &
            & 'direction, from +y towards +z; of a rotating force at phase 0')
         call v%word(x(i)%rotating, 'rotating', 'no forward backward', &
            & 'harmonic, chirp: whether the force turns, with the shaft or against it; no: it keeps its direction')
         call v%number(x(i)%frequency_hz, 'frequency_hz', 1e-6_wp, 1e7_wp, 'Hz', &
            & 'harmonic: frequency; chirp: frequency at start')
         call v%number(x(i)%frequency_ratio, 'frequency_ratio', 1e-6_wp, 1e6_wp, '1', &
            & 'harmonic: frequency over the speed of the shaft, instead of frequency_hz')
         call v%number(x(i)%final_frequency_hz, 'final_frequency_hz', 1e-6_wp, 1e7_wp, 'Hz', &
            & 'chirp: frequency at end')
         call v%number(x(i)%phase_deg, 'phase_deg', -360.0_wp, 360.0_wp, 'deg', &
            & 'harmonic, chirp: phase at start, where 0 is the whole amplitude')
         call v%number(x(i)%start, 'start', 0.0_wp, 1e6_wp, 's', 'when it begins; of a table the time 0')
         call v%number(x(i)%end, 'end', 0.0_wp, 1e6_wp, 's', &
            & 'when it ends; if left out, not before the run (chirp, ramp: with operation%duration)')
         call v%word(x(i)%file, 'file', '', 'table: CSV file of the columns time, force_y, force_z, in s and N')
      end do
   end subroutine list_excitations
end module machine_fields
