!> What the file of a run says of a machine as a whole: its shaft, its bearings, where its stations are. Names,
!> dimensions and units as docs/results.md lists them.
module machine_results
   use kinds, only: wp, degree
   use record, only: record_type
   use case_inputs, only: case_type
   use case_groups, only: bearing_type
   use rotor_groups, only: shaft_type
   use abstract_rotor, only: rotor_type
   use elastic_rotor, only: elastic_rotor_type
   implicit none (type, external)
   private
   public :: bearing_group, put_bearings, put_machine, put_machine_equilibrium, put_turned_rotor, turned_time, &
      & turned_state

   character(len=*), parameter :: group = 'rotor/'
   !> Where the state is from which another march may start, and its time.
   character(len=*), parameter :: turned_time = group//'turned_time', turned_state = group//'turned_state'

contains

   !> The group of a bearing, with a slash at its end; empty, the root of the file, for one without name.
   pure function bearing_group(bearing) result(group)
      type(bearing_type), intent(in) :: bearing
      character(len=:), allocatable :: group
      group = ''
      if (bearing%name /= '') group = 'bearings/'//bearing%name//'/'
   end function bearing_group

   !> Writes numbers and pivots of the pads of each bearing.
   subroutine put_bearings(file, inputs)
      class(record_type), intent(inout) :: file
      type(case_type), intent(in) :: inputs
      character(len=:), allocatable :: of
      integer :: b, i
      do b = 1, size(inputs%bearings)
         of = bearing_group(inputs%bearings(b))
         associate (angles => inputs%bearings(b)%pads%pivot_angle_deg)
            call file%put_list(of//'pad', [(real(i, wp), i=1, size(angles))], '1', 'pad number', of//'pad')
            call file%put_list(of//'pivot_angle', angles*degree, 'rad', 'pivot angle', of//'pad')
         end associate
      end do
   end subroutine put_bearings

   !> Keeps the state of the rotor of a machine at time t, s, where the shaft has turned whole revolutions: another
   !> march may start there, for which samples of stations do not suffice.
   subroutine put_turned_rotor(file, t, states)
      class(record_type), intent(inout) :: file
      real(wp), intent(in) :: t, states(:)
      call file%put_real(turned_time, t, 's', 'time of the last sample at which the shaft had turned ' &
         & //'whole revolutions')
      call file%put_list(turned_state, states, '1', 'state of the rotor at that time: displacements, then rates', &
         & '')
   end subroutine put_turned_rotor

   !> Writes the rotor of a machine with its bearings; nothing of a rigid journal.
   subroutine put_machine(file, inputs, rotor)
      class(record_type), intent(inout) :: file
      type(case_type), intent(in) :: inputs
      class(rotor_type), intent(in) :: rotor
      integer :: i
      select type (rotor)
      type is (elastic_rotor_type)
         call file%put_list('station', [(real(i, wp), i=1, rotor%stations)], '1', 'station of the shaft', 'station')
         call put_reduction(file, rotor)
         if (inputs%rotor%station_count() > 0) call put_shaft(file, inputs%rotor%elastic%shaft)
         call put_attached(file, inputs)
      end select
   end subroutine put_machine

   !> Writes the mass of a rotor, its kept modes, and what those that are left out change.
   subroutine put_reduction(file, rotor)
      class(record_type), intent(inout) :: file
      type(elastic_rotor_type), intent(in) :: rotor
      integer :: i
      associate (m => rotor%matrices)
         call file%put_real(group//'total_mass', m%total_mass, 'kg', 'mass of the rotor')
         call file%put_list(group//'mode', [(real(i, wp), i=1, size(m%mode_frequency))], '1', 'mode number', &
            & group//'mode')
         call file%put_list(group//'mode_frequency', m%mode_frequency, 'Hz', &
            & 'frequency of the kept mode of the shaft, its journals fixed', group//'mode')
         call file%put_real(group//'left_out_frequency', m%left_out_frequency, 'Hz', &
            & 'frequency of the first mode that is left out; 0: none is')
         call file%put_real(group//'truncation_error', m%truncation_error, '1', &
            & 'relative error of amplitudes by the modes that are left out; 0: not estimated')
         call file%put_real(group//'damping_error', m%damping_error, '1', &
            & 'relative error of amplitudes by the damping of high modes; 0: not estimated')
      end associate
   end subroutine put_reduction

   !> Writes the sections of a shaft and where its stations are.
   subroutine put_shaft(file, shaft)
      class(record_type), intent(inout) :: file
      type(shaft_type), intent(in) :: shaft
      integer :: i
      call file%put_list(group//'station_position', [(sum(shaft%length(:i)), i=0, size(shaft%length))], 'm', &
         & 'distance of the station from the first one', 'station')
      call file%put_list(group//'section', [(real(i, wp), i=1, size(shaft%length))], '1', 'section of the shaft', &
         & group//'section')
      call section('length', shaft%length, 'length')
      call section('diameter', shaft%diameter, 'outer diameter')
      call section('bore', shaft%bore, 'inner diameter')
   contains
      subroutine section(name, values, long_name)
         character(len=*), intent(in) :: name, long_name
         real(wp), intent(in) :: values(:)
         call file%put_list(group//'section_'//name, values, 'm', long_name//' of the section', group//'section')
      end subroutine section
   end subroutine put_shaft

   !> Writes the bearings of a shaft and its discs, with their stations.
   subroutine put_attached(file, inputs)
      class(record_type), intent(inout) :: file
      type(case_type), intent(in) :: inputs
      character(len=:), allocatable :: names(:)
      integer :: b, i, longest
      associate (bearings => inputs%bearings)
         longest = maxval([(len(bearings(b)%name), b=1, size(bearings))])
         allocate (character(len=longest) :: names(size(bearings)))
         do b = 1, size(names)
            names(b) = bearings(b)%name
         end do
         call file%put_labels('bearing', names, 'name of the bearing')
         call bearing('station', real(bearings%station, wp), '1', 'station of the bearing')
         call bearing('offset_y', bearings%offset(1), 'm', 'offset of the bearing, vertical')
         call bearing('offset_z', bearings%offset(2), 'm', 'offset of the bearing, horizontal')
      end associate
      associate (discs => inputs%rotor%elastic%discs)
         if (size(discs) == 0) return
         call file%put_list(group//'disc', [(real(i, wp), i=1, size(discs))], '1', 'disc number', group//'disc')
         call disc('station', real(discs%station, wp), '1', 'station of the disc')
         call disc('mass', discs%mass, 'kg', 'mass of the disc')
         call disc('polar_inertia', discs%polar_inertia, 'kg m^2', 'polar inertia of the disc')
         call disc('diametral_inertia', discs%diametral_inertia, 'kg m^2', 'diametral inertia of the disc')
      end associate
   contains
      subroutine bearing(name, values, units, long_name)
         character(len=*), intent(in) :: name, units, long_name
         real(wp), intent(in) :: values(:)
         call file%put_list(group//'bearing_'//name, values, units, long_name, 'bearing')
      end subroutine bearing

      subroutine disc(name, values, units, long_name)
         character(len=*), intent(in) :: name, units, long_name
         real(wp), intent(in) :: values(:)
         call file%put_list(group//'disc_'//name, values, units, long_name, group//'disc')
      end subroutine disc
   end subroutine put_attached

   !> Writes where the shaft is at the equilibrium with these displacements of the rotor, and what its bearings bear,
   !> (2, bearing), N.
   subroutine put_machine_equilibrium(file, rotor, displacements, loads)
      class(record_type), intent(inout) :: file
      class(rotor_type), intent(in) :: rotor
      real(wp), intent(in) :: displacements(:), loads(:, :)
      real(wp), dimension(2, rotor%stations) :: stations, slopes
      stations = rotor%station_displacements(displacements)
      slopes = rotor%station_slopes(displacements)
      call file%put_list('equilibrium/station_y', stations(1, :), 'm', 'shaft displacement, vertical', 'station')
      call file%put_list('equilibrium/station_z', stations(2, :), 'm', 'shaft displacement, horizontal', 'station')
      call file%put_list('equilibrium/station_slope_y', slopes(1, :), 'rad', 'shaft slope, vertical', 'station')
      call file%put_list('equilibrium/station_slope_z', slopes(2, :), 'rad', 'shaft slope, horizontal', 'station')
      call file%put_list('equilibrium/bearing_load_y', loads(1, :), 'N', 'load of the rotor on the bearing, vertical', &
         & 'bearing')
      call file%put_list('equilibrium/bearing_load_z', loads(2, :), 'N', &
         & 'load of the rotor on the bearing, horizontal', 'bearing')
   end subroutine put_machine_equilibrium
end module machine_results
