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
   implicit none (type, external)
   private
   public :: list_rotor_file, list_parts, list_bearings, list_place, list_station

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
end module machine_fields
