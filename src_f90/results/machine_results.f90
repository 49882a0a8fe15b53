!> What the file of a run says of a machine as a whole: its shaft, its bearings, where its stations are. Names,
!> dimensions and units as docs/results.md lists them.
module machine_results
   use kinds, only: wp, i8, degree
   use record, only: record_type
   use case_inputs, only: case_type, longest_label
   use case_groups, only: bearing_type, mount_type, shaft_type, station_element_type
   use rigid_rotor, only: rotor_type
   use elastic_rotor, only: elastic_rotor_type
   implicit none (type, external)
   private
   public :: bearing_group, put_bearings, put_machine, put_machine_equilibrium, put_elements, &
      & put_turned_rotor, turned_time, &
      & turned_state, mode_signs, other_signs, put_origin, read_origin

   character(len=*), parameter :: group = 'rotor/'
   !> Where the state is from which another march may start, and its time.
   character(len=*), parameter :: turned_time = group//'turned_time', turned_state = group//'turned_state'
   !> Where it is at the equilibrium.
   character(len=*), parameter :: origin = group//'equilibrium'
   !> Which of its two signs each mode has; what is said of a file that does not tell, whose states do not fit.
   character(len=*), parameter :: mode_signs = group//'mode_signs', other_signs = 'written by an earlier version of ' &
      & //'tiltpad, in which modes of the shaft had other signs; its states fit no longer, run it anew'

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
      integer :: b
      do b = 1, size(inputs%bearings)
         of = bearing_group(inputs%bearings(b))
         associate (angles => inputs%bearings(b)%pads%pivot_angle_deg)
            call file%put_scale(of//'pad', size(angles), 'pad number')
            call file%put(of//'pivot_angle', angles*degree, 'rad', 'pivot angle', of//'pad')
         end associate
      end do
   end subroutine put_bearings

   !> Keeps the state of the rotor of a machine at time t, s, where the shaft has turned whole revolutions: another
   !> march may start there, for which samples of stations do not suffice.
   subroutine put_turned_rotor(file, t, states)
      class(record_type), intent(inout) :: file
      real(wp), intent(in) :: t, states(:)
      call file%put(turned_time, t, 's', 'time of the last sample at which the shaft had turned whole revolutions')
      call file%put(turned_state, states, '1', 'state of the rotor at that time: displacements, then rates', &
         & turned_state)
   end subroutine put_turned_rotor

   !> Keeps the displacements of the rotor at the equilibrium, about which elements act that only motion has.
   subroutine put_origin(file, inputs, positions)
      class(record_type), intent(inout) :: file
      type(case_type), intent(in) :: inputs
      real(wp), intent(in) :: positions(:)
      if (acts_in_motion_alone(inputs)) call file%put(origin, positions, '1', &
         & 'displacements of the rotor at the equilibrium', origin)
   end subroutine put_origin

   !> Moves the rotor about them again.
   subroutine read_origin(file, inputs, rotor)
      class(record_type), intent(in) :: file
      type(case_type), intent(in) :: inputs
      class(rotor_type), intent(inout) :: rotor
      real(wp) :: positions(rotor%positions)
      if (.not. acts_in_motion_alone(inputs)) return
      call file%get_list(origin, positions)
      call rotor%move_about(positions)
   end subroutine read_origin

   pure logical function acts_in_motion_alone(inputs)
      type(case_type), intent(in) :: inputs
      acts_in_motion_alone = .false.
      if (.not. inputs%rotor%is_rigid()) acts_in_motion_alone = .not. all(inputs%rotor%elastic%elements%static)
   end function acts_in_motion_alone

   !> Writes the rotor of a machine with its bearings; nothing of a rigid journal.
   subroutine put_machine(file, inputs, rotor)
      class(record_type), intent(inout) :: file
      type(case_type), intent(in) :: inputs
      class(rotor_type), intent(in) :: rotor
      select type (rotor)
      type is (elastic_rotor_type)
         call file%put_scale('station', rotor%stations, 'station of the shaft')
         call put_reduction(file, rotor)
         if (inputs%rotor%station_count() > 0) call put_shaft(file, inputs%rotor%elastic%shaft)
         call put_attached(file, inputs)
      end select
   end subroutine put_machine

   !> Writes the mass of a rotor, its kept modes, and what those that are left out change.
   subroutine put_reduction(file, rotor)
      class(record_type), intent(inout) :: file
      type(elastic_rotor_type), intent(in) :: rotor
      associate (m => rotor%matrices)
         call file%put(group//'total_mass', m%total_mass, 'kg', 'mass of the rotor')
         call file%put_scale(group//'mode', size(m%mode_frequency), 'mode number')
         call file%put(group//'mode_frequency', m%mode_frequency, 'Hz', &
            & 'frequency of the kept mode of the shaft, its journals fixed', group//'mode')
         call file%put(mode_signs, 1_i8, '1: the first component of each of these modes that is at least half as ' &
            & //'large as the largest is positive')
         call file%put(group//'left_out_frequency', m%left_out_frequency, 'Hz', &
            & 'frequency of the first mode that is left out; 0: none is')
         call file%put(group//'truncation_error', m%truncation_error, '1', &
            & 'relative error of amplitudes of journals and discs by the modes that are left out')
         call file%put(group//'station_error', m%station_error, '1', &
            & 'relative error of amplitudes of all stations by the modes that are left out')
         call file%put(group//'damped_above', m%damped_above, 'Hz', &
            & 'frequency above which a march damps modes of the shaft')
         call file%put(group//'damping_error', m%damping_error, '1', &
            & 'relative error of amplitudes by the damping of high modes; 0: not estimated')
      end associate
   end subroutine put_reduction

   !> Writes the sections of a shaft and where its stations are.
   subroutine put_shaft(file, shaft)
      class(record_type), intent(inout) :: file
      type(shaft_type), intent(in) :: shaft
      integer :: i
      call file%put(group//'station_position', [(sum(shaft%length(:i)), i=0, size(shaft%length))], 'm', &
         & 'distance of the station from the first one', 'station')
      call file%put_scale(group//'section', size(shaft%length), 'section of the shaft')
      call file%put(group//'section_length', shaft%length, 'm', 'length of the section', group//'section')
      call file%put(group//'section_diameter', shaft%diameter, 'm', 'outer diameter of the section', group//'section')
      call file%put(group//'section_bore', shaft%bore, 'm', 'inner diameter of the section', group//'section')
   end subroutine put_shaft

   !> Writes the bearings of a shaft and its discs, with their stations.
   subroutine put_attached(file, inputs)
      class(record_type), intent(inout) :: file
      type(case_type), intent(in) :: inputs
      character(len=:), allocatable :: names(:)
      type(mount_type), allocatable :: mounts(:)
      type(station_element_type), allocatable :: elements(:)
      character(len=longest_label), allocatable :: labels(:)
      integer, allocatable :: dampers(:)
      integer :: b, longest
      associate (bearings => inputs%bearings)
         longest = maxval([0, (len(bearings(b)%name), b=1, size(bearings))])
         allocate (character(len=longest) :: names(size(bearings)))
         do b = 1, size(names)
            names(b) = bearings(b)%name
         end do
         if (size(names) > 0) then
            call file%put('bearing', names, 'name of the bearing')
            call file%put(group//'bearing_station', real(bearings%station, wp), '1', 'station of the bearing', &
               & 'bearing')
            call file%put(group//'bearing_offset_y', bearings%offset(1), 'm', 'offset of the bearing, vertical', &
               & 'bearing')
            call file%put(group//'bearing_offset_z', bearings%offset(2), 'm', 'offset of the bearing, horizontal', &
               & 'bearing')
         end if
      end associate
      mounts = inputs%mounts()
      elements = inputs%station_elements()
      dampers = inputs%dampers()
      labels = inputs%element_labels()
      if (size(labels) > 0) then
         call file%put_scale('element', size(labels), 'element number')
         call file%put(group//'element_name', labels, 'name of the element')
         call file%put(group//'element_station', real([elements%station, mounts(dampers)%station], wp), &
            & '1', 'station of the element; of a damper that of its bearing', 'element')
      end if
      if (size(dampers) > 0) call file%put_scale('damper', size(dampers), &
         & 'damper number; dampers are the last elements')
      associate (discs => inputs%rotor%elastic%discs, over => group//'disc')
         if (size(discs) == 0) return
         call file%put_scale(over, size(discs), 'disc number')
         call file%put(over//'_station', real(discs%station, wp), '1', 'station of the disc', over)
         call file%put(over//'_mass', discs%mass, 'kg', 'mass of the disc', over)
         call file%put(over//'_polar_inertia', discs%polar_inertia, 'kg m^2', 'polar inertia of the disc', over)
         call file%put(over//'_diametral_inertia', discs%diametral_inertia, 'kg m^2', &
            & 'diametral inertia of the disc', over)
      end associate
   end subroutine put_attached

   !> Writes forces of the elements at the equilibrium, N, and the displacements of their stations from their other
   !> ends, m, (2, element); the eccentricities of the dampers.
   subroutine put_elements(file, forces, positions, ratios)
      class(record_type), intent(inout) :: file
      real(wp), intent(in) :: forces(:, :), positions(:, :), ratios(:)
      call put_pair('element_force', forces, 'N', 'force of the element on the rotor')
      call put_pair('element', positions, 'm', 'displacement of the element''s station from its other end')
      if (size(ratios) > 0) call file%put('equilibrium/damper_eccentricity', ratios, '1', &
         & 'displacement of the damper''s ring over its clearance', 'damper')
   contains
      subroutine put_pair(name, values, units, long_name)
         character(len=*), intent(in) :: name, units, long_name
         real(wp), intent(in) :: values(:, :)
         call file%put('equilibrium/'//name//'_y', values(1, :), units, long_name//', vertical', 'element')
         call file%put('equilibrium/'//name//'_z', values(2, :), units, long_name//', horizontal', 'element')
      end subroutine put_pair
   end subroutine put_elements

   !> Writes where the shaft is at the equilibrium with these displacements of the rotor, and what its bearings bear,
   !> (2, bearing), N.
   subroutine put_machine_equilibrium(file, rotor, displacements, loads)
      class(record_type), intent(inout) :: file
      class(rotor_type), intent(in) :: rotor
      real(wp), intent(in) :: displacements(:), loads(:, :)
      real(wp), dimension(2, rotor%stations) :: stations, slopes
      stations = rotor%station_displacements(displacements)
      slopes = rotor%station_slopes(displacements)
      call file%put('equilibrium/station_y', stations(1, :), 'm', 'shaft displacement, vertical', 'station')
      call file%put('equilibrium/station_z', stations(2, :), 'm', 'shaft displacement, horizontal', 'station')
      call file%put('equilibrium/station_slope_y', slopes(1, :), 'rad', 'shaft slope, vertical', 'station')
      call file%put('equilibrium/station_slope_z', slopes(2, :), 'rad', 'shaft slope, horizontal', 'station')
      if (size(loads) == 0) return
      call file%put('equilibrium/bearing_load_y', loads(1, :), 'N', 'load of the rotor on the bearing, vertical', &
         & 'bearing')
      call file%put('equilibrium/bearing_load_z', loads(2, :), 'N', &
         & 'load of the rotor on the bearing, horizontal', 'bearing')
   end subroutine put_machine_equilibrium
end module machine_results
