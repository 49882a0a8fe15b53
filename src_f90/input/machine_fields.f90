!> The input variables of a machine. Groups that it has several times have their number or the name of their bearing
!> behind them: disc(2), pads:drive_end (see machine_names).
module machine_fields
   use kinds, only: wp
   use case_groups, only: bearing_type, support_type, unset, is_set
   use rotor_groups, only: elastic_type, shaft_type, disc_type, unbalance_type, load_type, reduction_type, &
      & most_sections, most_stations
   use variable_table, only: variable_table_type
   use machine_names, only: counted
   use bearing_fields, only: list_bearing, list_oil, list_pads, list_pivot, list_friction, list_asperity, list_film
   use excitations, only: excitation_type
   implicit none (type, external)
   private
   public :: list_rotor_file, list_parts, list_bearings, list_place, list_excitations

contains

   !> The last variable of the group rotor.
   subroutine list_rotor_file(rotor, v)
      type(elastic_type), intent(inout) :: rotor
      type(variable_table_type), intent(inout) :: v
      call v%word(rotor%rotor_file, 'file', '', 'instead of the group shaft: the HDF5 file with the matrices of a ' &
         & //'rotor from another program')
   end subroutine list_rotor_file

   !> Shaft, what it carries, and its reduction; of what there are several, with their numbers, but not where a support
   !> is to be listed, too.
   subroutine list_parts(rotor, v, support)
      type(elastic_type), intent(inout) :: rotor
      type(variable_table_type), intent(inout) :: v
      type(support_type), intent(inout), optional :: support
      logical :: numbered
      integer :: i
      numbered = .not. present(support)
      call list_shaft(rotor%shaft, v)
      do i = 1, size(rotor%discs)
         if (numbered) call v%behind_group(counted(i))
         call list_disc(rotor%discs(i), v)
      end do
      do i = 1, size(rotor%unbalances)
         if (numbered) call v%behind_group(counted(i))
         call list_unbalance(rotor%unbalances(i), v)
      end do
      do i = 1, size(rotor%loads)
         if (numbered) call v%behind_group(counted(i))
         call list_load(rotor%loads(i), v)
      end do
      call v%behind_group('')
      if (present(support)) call list_support(support, v)
      call list_reduction(rotor%reduction, v)
   end subroutine list_parts

   !> Each bearing with its own groups.
   subroutine list_bearings(bearings, v)
      type(bearing_type), intent(inout) :: bearings(:)
      type(variable_table_type), intent(inout) :: v
      integer :: b
      do b = 1, size(bearings)
         associate (own => bearings(b))
            call v%behind_group(own%suffix())
            call list_bearing(own, v)
            call list_place(own, v)
            if (allocated(own%support)) call list_support(own%support, v)
            call list_oil(own%oil, v)
            call list_pads(own%pads, v)
            call list_pivot(own%pivot, v)
            call list_friction(own%friction, v)
            call list_asperity(own%asperity, v)
            call list_film(own%film, v)
         end associate
      end do
      call v%behind_group('')
   end subroutine list_bearings

   subroutine list_shaft(shaft, v)
      type(shaft_type), intent(inout) :: shaft
      type(variable_table_type), intent(inout) :: v
      call v%group('shaft', 'A machine: the sections of its shaft, from station 1 to station 2, from there to ' &
         & //'station 3, ...; *Machines* above')
      call v%list(shaft%length, most_sections, 'length', 1e-6_wp, 1e3_wp, 'm', 'length of each section', &
         & counts='sections')
      call v%each(shaft%diameter, 'sections', 'diameter', 1e-4_wp, 100.0_wp, 'm', 'outer diameter')
      call v%each(shaft%bore, 'sections', 'bore', 0.0_wp, 100.0_wp, 'm', 'inner diameter; 0: solid')
      call v%number(shaft%young_modulus, 'young_modulus', 1e6_wp, 1e14_wp, 'Pa', 'of its material')
      call v%number(shaft%poisson_ratio, 'poisson_ratio', -0.99_wp, 0.5_wp, '1', 'of its material')
      call v%number(shaft%density, 'density', 1.0_wp, 1e5_wp, 'kg/m^3', 'of its material')
   end subroutine list_shaft

   subroutine list_disc(disc, v)
      type(disc_type), intent(inout) :: disc
      type(variable_table_type), intent(inout) :: v
      call v%group('disc', 'A machine: a rigid disc on its shaft; one group for each')
      call list_station(disc%station, v)
      call v%number(disc%mass, 'mass', 0.0_wp, 1e9_wp, 'kg', 'mass')
      call v%number(disc%polar_inertia, 'polar_inertia', 0.0_wp, 1e12_wp, 'kg m^2', &
         & 'moment of inertia about the axis of the shaft')
      call v%number(disc%diametral_inertia, 'diametral_inertia', 0.0_wp, 1e12_wp, 'kg m^2', &
         & 'moment of inertia about a diameter')
   end subroutine list_disc

   subroutine list_unbalance(unbalance, v)
      type(unbalance_type), intent(inout) :: unbalance
      type(variable_table_type), intent(inout) :: v
      call v%group('unbalance', 'A machine: an unbalance; one group for each')
      call list_station(unbalance%station, v)
      call v%number(unbalance%moment, 'moment', 0.0_wp, 1e6_wp, 'kg m', 'mass times eccentricity')
      call v%number(unbalance%angle_deg, 'angle_deg', -360.0_wp, 360.0_wp, 'deg', &
         & 'its angle on the shaft, in the sense of rotation')
   end subroutine list_unbalance

   subroutine list_load(load, v)
      type(load_type), intent(inout) :: load
      type(variable_table_type), intent(inout) :: v
      call v%group('load', 'A machine: a steady force on its shaft, beside the weight; one group for each')
      call list_station(load%station, v)
      call v%numbers(load%force, 'force', -1e12_wp, 1e12_wp, 'N', 'along y and z')
   end subroutine list_load

   subroutine list_support(support, v)
      type(support_type), intent(inout) :: support
      type(variable_table_type), intent(inout) :: v
      call v%group('support', 'A machine: what a bearing stands on; without this group it stands on the ground')
      call v%number(support%mass, 'mass', 0.0_wp, 1e9_wp, 'kg', &
         & 'mass that moves with the housing of the bearing, that of the pads with it; must be above 0')
      call v%numbers(support%stiffness, 'stiffness', 0.0_wp, 1e15_wp, 'N/m', 'along y and z')
      call v%numbers(support%damping, 'damping', 0.0_wp, 1e12_wp, 'N s/m', 'along y and z')
   end subroutine list_support

   subroutine list_reduction(reduction, v)
      type(reduction_type), intent(inout) :: reduction
      type(variable_table_type), intent(inout) :: v
      call v%group('reduction', 'A machine: which modes of the shaft are kept')
      call v%number(reduction%frequency, 'frequency', 1e-3_wp, 1e7_wp, 'Hz', &
         & 'modes of the shaft on fixed bearings up to this frequency are kept; if left out, as many as the run needs')
      call v%number(reduction%damp_above, 'damp_above', 0.0_wp, 1e7_wp, 'Hz', &
         & 'modes above this frequency are damped')
      call v%number(reduction%damping_ratio, 'damping_ratio', 0.0_wp, 1.0_wp, '1', 'their damping ratio')
   end subroutine list_reduction

   !> Where a bearing stands.
   subroutine list_place(bearing, v)
      type(bearing_type), intent(inout) :: bearing
      type(variable_table_type), intent(inout) :: v
      call list_station(bearing%station, v)
      call v%numbers(bearing%offset, 'offset', -0.1_wp, 0.1_wp, 'm', &
         & 'of a machine: how far the bearing stands from the line of the others, along y and z')
   end subroutine list_place

   !> A station; none is given where it is 0.
   subroutine list_station(station, v)
      integer, intent(inout) :: station
      type(variable_table_type), intent(inout) :: v
      real(wp) :: x
      x = unset
      if (station > 0) x = station
      call v%number(x, 'station', 1.0_wp, real(most_stations, wp), '1', 'of a machine: station of its shaft', .true.)
      station = 0
      if (is_set(x)) station = nint(x)
   end subroutine list_station

   ! The input variables of the groups excitation.

   !> Those of all excitations; `numbered`, each with its number, and with their stations.
   subroutine list_excitations(excitations, v, numbered, stations)
      type(excitation_type), intent(inout) :: excitations(:)
      type(variable_table_type), intent(inout) :: v
      logical, intent(in) :: numbered, stations
      integer :: i
      do i = 1, size(excitations)
         if (numbered) call v%behind_group(counted(i))
         call v%group('excitation', 'A force over time on the rotor, for the tasks march and periodic; one group for ' &
            & //'each; *Excitation* above')
         if (stations) call list_station(excitations(i)%station, v)
         call list_excitation(excitations(i), v)
      end do
      call v%behind_group('')
   end subroutine list_excitations

   subroutine list_excitation(x, v)
      type(excitation_type), intent(inout) :: x
      type(variable_table_type), intent(inout) :: v
      call v%word(x%kind, 'kind', 'harmonic chirp step ramp table', &
         & 'harmonic: a vibration; chirp: one whose frequency changes linearly; step: constant from start to end; ' &
         & //'ramp: from 0 at start to amplitude at end, which it keeps; table: forces from a file')
      call v%number(x%amplitude, 'amplitude', 0.0_wp, 1e12_wp, 'N', 'amplitude of the force; not of a table')
      call v%number(x%direction_deg, 'direction_deg', -360.0_wp, 360.0_wp, 'deg', &
         & 'direction, from +y towards +z; of a rotating force at phase 0')
      call v%word(x%rotating, 'rotating', 'no forward backward', &
         & 'harmonic, chirp: whether the force turns, with the shaft or against it; no: it keeps its direction')
      call v%number(x%frequency_hz, 'frequency_hz', 1e-6_wp, 1e7_wp, 'Hz', &
         & 'harmonic: frequency; chirp: frequency at start')
      call v%number(x%frequency_ratio, 'frequency_ratio', 1e-6_wp, 1e6_wp, '1', &
         & 'harmonic: frequency over the speed of the shaft, instead of frequency_hz')
      call v%number(x%final_frequency_hz, 'final_frequency_hz', 1e-6_wp, 1e7_wp, 'Hz', 'chirp: frequency at end')
      call v%number(x%phase_deg, 'phase_deg', -360.0_wp, 360.0_wp, 'deg', &
         & 'harmonic, chirp: phase at start, where 0 is the whole amplitude')
      call v%number(x%start, 'start', 0.0_wp, 1e6_wp, 's', 'when it begins; of a table the time 0')
      call v%number(x%end, 'end', 0.0_wp, 1e6_wp, 's', 'when it ends; if left out, not before the run (chirp, ramp: ' &
         & //'with operation%duration)')
      call v%word(x%file, 'file', '', 'table: CSV file of the columns time, force_y, force_z, in s and N')
   end subroutine list_excitation
end module machine_fields
