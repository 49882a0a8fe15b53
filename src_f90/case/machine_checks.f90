!> Checks of a machine: what no single value of its shaft and of what stands on it or under it can tell. A message names
!> the group, its variables, their values and what is allowed.
module machine_checks
   use kinds, only: wp, rpm
   use text, only: to_text
   use errors, only: error_type, require, refuse
   use case_groups, only: mount_type, damper_type, in_range, is_set, elastic_type, most_stations, &
      & station_element_type
   use case_inputs, only: case_type
   implicit none (type, external)
   private
   public :: check_machine, check_element_tables

   !> Rounding of a speed.
   real(wp), parameter :: small = 1e-9_wp

contains

   !> Raises an error for the first requirement that a machine does not meet.
   subroutine check_machine(inputs, error)
      type(case_type), intent(in) :: inputs
      type(error_type), allocatable, intent(inout) :: error
      type(mount_type), allocatable :: mounts(:)
      integer :: b
      mounts = inputs%mounts()
      call check_shaft(inputs%rotor%elastic)
      call check_parts(inputs%rotor%station_count())
      do b = 1, size(inputs%rotor%elastic%elements)
         call check_element(b, inputs%rotor%elastic%elements(b), inputs%rotor%station_count())
      end do
      do b = 1, size(mounts)
         if (allocated(mounts(b)%damper)) call check_damper('damper'//mounts(b)%suffix()//'%', mounts(b)%damper, &
            & allocated(mounts(b)%support))
      end do
      do b = 1, size(inputs%rotor%elastic%linear)
         associate (bearing => inputs%rotor%elastic%linear(b))
            call check_source('bearing'//bearing%suffix(), bearing%of)
         end associate
      end do
   contains
      !> A shaft or a rotor from a file, and every section a tube.
      subroutine check_shaft(elastic)
         type(elastic_type), intent(in) :: elastic
         integer :: i
         associate (shaft => elastic%shaft)
            if (.not. shaft%is_given()) then
               call require(elastic%rotor_file /= '', 'shaft%length: must be given, the lengths of the shaft''s ' &
                  & //'sections; or rotor%file, the matrices of a rotor', error)
               return
            end if
            call require(elastic%rotor_file == '', 'rotor%file = '''//elastic%rotor_file//''': shaft%length is given ' &
               & //'too; give one of them', error)
            call require(all(is_set(shaft%length)), 'shaft%length: every section needs one', error)
            call require(all(is_set(shaft%diameter)), 'shaft%diameter: must be given, of each of the {} sections', &
               & [real(size(shaft%length), wp)], error)
            do i = 1, size(shaft%length)
               call require(shaft%bore(i) < shaft%diameter(i), 'shaft%bore = {}: must be below shaft%diameter = {} ' &
                  & //'(section {})', [real(wp) :: shaft%bore(i), shaft%diameter(i), i], error)
            end do
         end associate
      end subroutine check_shaft

      !> There are enough bearings, each at a station of its own; what is on the shaft is at its stations, and a support
      !> holds its bearing.
      subroutine check_parts(stations)
         integer, intent(in) :: stations
         integer :: i, c
         associate (elastic => inputs%rotor%elastic, bearings => mounts)
            if (size(bearings) < 2) call refuse('a machine needs two or more groups &bearing, each with a name; ' &
               & //'there '//trim(merge('are none', 'is one  ', size(bearings) == 0)), error)
            do i = 1, size(bearings)
               call check_station('bearing'//bearings(i)%suffix(), bearings(i)%station, stations)
               do c = 1, i - 1
                  if (bearings(i)%station == bearings(c)%station) call refuse('bearing'//bearings(i)%suffix() &
                     & //'%station = '//to_text(bearings(i)%station)//': is that of '//bearings(c)%label(' already'), &
                     & error)
               end do
            end do
            do i = 1, size(elastic%discs)
               associate (disc => elastic%discs(i))
                  call check_station('disc('//to_text(i)//')', disc%station, stations)
                  ! the moments of inertia of any body
                  call require(disc%polar_inertia <= 2*disc%diametral_inertia, 'disc({})%polar_inertia = {}: must be ' &
                     & //'at most twice diametral_inertia = {}', [real(wp) :: i, disc%polar_inertia, &
                     & disc%diametral_inertia], error)
               end associate
            end do
            do i = 1, size(elastic%unbalances)
               call check_station('unbalance('//to_text(i)//')', elastic%unbalances(i)%station, stations)
            end do
            do i = 1, size(elastic%bows)
               call check_station('bow('//to_text(i)//')', elastic%bows(i)%station, stations)
               call require(elastic%rotor_file == '', 'bow({})%station = {}: bends a shaft of &shaft, not one of ' &
                  & //'rotor%file', [real(i, wp), real(elastic%bows(i)%station, wp)], error)
            end do
            do i = 1, size(elastic%loads)
               call check_station('load('//to_text(i)//')', elastic%loads(i)%station, stations)
            end do
            do i = 1, size(inputs%excitations)
               call check_station('excitation('//to_text(i)//')', inputs%excitations(i)%station, stations)
            end do
            do i = 1, size(bearings)
               if (.not. allocated(bearings(i)%support)) cycle
               associate (k => bearings(i)%support%stiffness, mass => bearings(i)%support%mass, &
                  & group => 'support'//bearings(i)%suffix())
                  call require(mass > 0, group//'%mass = {}: must be above 0, kg', [mass], error)
                  call require(all(is_set(k)), group//'%stiffness: must be given, along y and z', error)
                  call require(all(k > 0), group//'%stiffness = {}: must be above 0 along y and z', [minval(k)], error)
               end associate
            end do
         end associate
      end subroutine check_parts

      !> An element has two ends, and one that acts in motion alone has an equilibrium to move about.
      subroutine check_element(i, element, stations)
         integer, intent(in) :: i, stations
         type(station_element_type), intent(in) :: element
         character(len=:), allocatable :: name
         logical :: supported(size(mounts))
         integer :: b
         name = 'element('//to_text(i)//')'
         if (element%housing == '' .or. element%to_station /= 0 .or. element%station /= 0) call check_station(name, &
            & element%station, stations)
         if (element%to_station > 0) call check_station(name, element%to_station, stations, 'to_station')
         call require(element%to_station /= element%station .or. element%station == 0 .or. allocated(error), name &
            & //'%to_station = {}: is its station; an element has two ends', [real(element%to_station, wp)], error)
         call require(element%to_station == 0 .or. element%housing == '', name//'%housing = '''//element%housing &
            & //''': to_station is given too; give one of them', error)
         supported = [(allocated(mounts(b)%support), b=1, size(supported))]
         call require(element%housing == '' .or. any([(supported(b) .and. mounts(b)%name == element%housing, &
            & b=1, size(supported))]), name//'%housing = '''//element%housing//''': must be the name of a bearing ' &
            & //'with a group &support', error)
         call check_source(name, element)
         call require(element%static .or. inputs%start%from == 'equilibrium', name//'%static = .false.: needs ' &
            & //'start%from = ''equilibrium'', about which it acts', error)
      end subroutine check_element

      !> Coefficients come from a file or not.
      subroutine check_source(name, element)
         character(len=*), intent(in) :: name
         type(station_element_type), intent(in) :: element
         call require(element%file == '' .or. all(abs([element%stiffness, element%damping, element%mass]) <= 0), name &
            & //'%file = '''//element%file//''': stiffness, damping or mass is given too; give one of them', error)
         call require(element%file /= '' .or. element%frequency == 'own', name//'%frequency = '''//element%frequency &
            & //''': has no effect without a file', error)
      end subroutine check_source

      !> Refuses a station that is left out or that the shaft, of this number of stations, does not have.
      subroutine check_station(group, station, stations, name)
         character(len=*), intent(in) :: group
         integer, intent(in) :: station, stations
         !> Left out: station.
         character(len=*), intent(in), optional :: name
         character(len=:), allocatable :: variable
         real(wp) :: last
         variable = group//'%station'
         if (present(name)) variable = group//'%'//name
         last = merge(stations, most_stations, stations > 0)
         call require(station > 0, variable//': must be given, 1 to {}', [last], error)
         call require(station <= last, variable//' = {}: must be 1 to {}, the stations of the shaft, of which ' &
            & //'there is one more than sections', [real(station, wp), last], error)
      end subroutine check_station

      !> A damper has all its sizes, and a spring beside it, which carries what is steady.
      subroutine check_damper(name, damper, supported)
         character(len=*), intent(in) :: name
         type(damper_type), intent(in) :: damper
         logical, intent(in) :: supported
         character(len=*), parameter :: needed(0:4) = [character(len=9) :: '', 'radius', 'length', 'clearance', &
            & 'viscosity']
         associate (sizes => [damper%radius, damper%length, damper%clearance, damper%viscosity])
            call require(all(is_set(sizes)), name//trim(needed(findloc(is_set(sizes), .false., dim=1)))//': must be ' &
               & //'given', error)
         end associate
         call require(supported, name//'clearance = {}: needs a group &support of this bearing, whose spring carries ' &
            & //'the housing in it', [damper%clearance], error)
         call require(damper%clearance < 0.1_wp*damper%radius .or. allocated(error), name//'clearance = {}: must be ' &
            & //'below a tenth of radius = {} (both in m)', [damper%clearance, damper%radius], error)
         call require(norm2(damper%offset) < damper%clearance .or. allocated(error), name//'offset = {}, {}: must ' &
            & //'lie within clearance = {} (all in m)', [damper%offset, damper%clearance], error)
      end subroutine check_damper
   end subroutine check_machine

   !> The tables of elements, where they were read, cover all speeds of the run, and a motion has coefficients that do
   !> not depend on its frequency.
   subroutine check_element_tables(inputs, error)
      type(case_type), intent(in) :: inputs
      type(error_type), allocatable, intent(inout) :: error
      real(wp), allocatable :: speeds(:)
      type(station_element_type), allocatable :: elements(:)
      integer :: i
      if (inputs%rotor%is_rigid()) return
      associate (o => inputs%operation, task => inputs%about%task, up_to => inputs%coefficients%threshold_up_to_rpm)
         speeds = [o%speed_rpm, o%final_speed_rpm]
         if (task == 'coefficients' .and. up_to > 0) speeds = [speeds, up_to]
         if (task == 'branch') speeds = [speeds, inputs%branch%speeds()]
         if (allocated(inputs%rotor%elastic%lateral)) speeds = [speeds, inputs%rotor%elastic%lateral%first_rpm, &
            & inputs%rotor%elastic%lateral%last_rpm]
         elements = inputs%station_elements()
         do i = 1, size(elements)
            associate (e => elements(i))
               if (.not. allocated(e%table) .or. allocated(error)) cycle
               call check_range('speed_rpm', e%speeds/rpm)
               if (size(e%whirls) == 0) then
                  call require(e%frequency == 'own', e%label//'%frequency = '''//e%frequency//''': has no effect, ' &
                     & //'as '//e%file//' has no column frequency_hz', error)
               else if (e%frequency == 'synchronous') then
                  call check_range('frequency_hz', e%whirls/rpm)
               else
                  call require((task == 'coefficients' .and. up_to <= 0) .or. task == 'equilibrium', e%label &
                     & //'%frequency = ''own'': '//e%file//' has coefficients over the frequency, which only ' &
                     & //'modes take at their own; frequency = ''synchronous'' serves motions, branches and ' &
                     & //'thresholds', error)
               end if
               associate (masses => e%table(9:, :, :))
                  call require(inputs%is_steady() .or. .not. any(abs(masses - spread(spread(masses(:, 1, 1), 2, &
                     & size(masses, 2)), 3, size(masses, 3))) > 0), e%label//'%file = '''//e%file//''': m_yy to ' &
                     & //'m_zz must be constant where the speed changes', error)
               end associate
            end associate
         end do
      end associate
   contains
      subroutine check_range(column, covered)
         character(len=*), intent(in) :: column
         real(wp), intent(in) :: covered(:)
         integer :: k
         do k = 1, size(speeds)
            ! rpm to rad/s and back, rounding
            call require(in_range(speeds(k), [covered(1)*(1 - small), covered(size(covered))*(1 + small)]), &
               & elements(i)%label//'%file = '''//elements(i)%file//''': its '//column//' goes from {} ' &
               & //'to {} rpm, and the run has {} rpm', [covered(1), covered(size(covered)), speeds(k)], error)
         end do
      end subroutine check_range
   end subroutine check_element_tables
end module machine_checks
