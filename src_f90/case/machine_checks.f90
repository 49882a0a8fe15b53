!> Checks of a machine: what no single value of its shaft and of what stands on it or under it can tell. A message names
!> the group, its variables, their values and what is allowed.
module machine_checks
   use text, only: to_text
   use errors, only: error_type, require, refuse
   use case_groups, only: bearing_type, is_set
   use case_inputs, only: case_type
   use excitations, only: excitation_type
   use rotor_groups, only: elastic_type, most_stations
   implicit none (type, external)
   private
   public :: check_machine

contains

   !> Raises an error for the first requirement that a machine does not meet.
   subroutine check_machine(inputs, error)
      type(case_type), intent(in) :: inputs
      type(error_type), allocatable, intent(inout) :: error
      associate (s => inputs%start, q => inputs%coefficients%cross_stiffness)
         call check_shaft(inputs%rotor%elastic, error)
         call check_bearings(inputs%bearings, inputs%rotor%station_count(), error)
         call check_parts(inputs%rotor%elastic, inputs%excitations, inputs%rotor%station_count(), error)
         call check_supports(inputs%bearings, error)
         call require(any(s%from == ['equilibrium', 'file       ']), 'start%from = '''//s%from//''': must be ' &
            & //'''equilibrium'' or ''file'' for a machine', error)
         if (abs(q) > 0) call refuse('coefficients%cross_stiffness = '//to_text(q)//': must be 0 for a machine', error)
      end associate
   end subroutine check_machine

   !> A shaft or a rotor from a file, and every section a tube.
   subroutine check_shaft(elastic, error)
      type(elastic_type), intent(in) :: elastic
      type(error_type), allocatable, intent(inout) :: error
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
         call require(all(is_set(shaft%diameter)), 'shaft%diameter: must be given, of each of the '// &
            & to_text(size(shaft%length))//' sections', error)
         do i = 1, size(shaft%length)
            if (.not. shaft%bore(i) < shaft%diameter(i)) call refuse('shaft%bore = '//to_text(shaft%bore(i)) &
               & //': must be below shaft%diameter = '//to_text(shaft%diameter(i))//' (section '//to_text(i)//')', &
               & error)
         end do
      end associate
   end subroutine check_shaft

   !> Enough bearings, each at a station of its own.
   subroutine check_bearings(bearings, stations, error)
      type(bearing_type), intent(in) :: bearings(:)
      integer, intent(in) :: stations
      type(error_type), allocatable, intent(inout) :: error
      integer :: b, c
      if (size(bearings) < 2) call refuse('a machine needs two or more groups &bearing, each with a name; there ' &
         & //trim(merge('are none', 'is one  ', size(bearings) == 0)), error)
      do b = 1, size(bearings)
         call check_station('bearing'//bearings(b)%suffix(), bearings(b)%station, stations, error)
         do c = 1, b - 1
            if (bearings(b)%station == bearings(c)%station) call refuse('bearing'//bearings(b)%suffix() &
               & //'%station = '//to_text(bearings(b)%station)//': is that of '//bearings(c)%label(' already'), error)
         end do
      end do
   end subroutine check_bearings

   !> What is on the shaft is at its stations.
   subroutine check_parts(elastic, excitations, stations, error)
      type(elastic_type), intent(in) :: elastic
      type(excitation_type), intent(in) :: excitations(:)
      integer, intent(in) :: stations
      type(error_type), allocatable, intent(inout) :: error
      integer :: i
      do i = 1, size(elastic%discs)
         associate (disc => elastic%discs(i))
            call check_station('disc('//to_text(i)//')', disc%station, stations, error)
            ! the moments of inertia of any body
            if (.not. disc%polar_inertia <= 2*disc%diametral_inertia) call refuse('disc('//to_text(i) &
               & //')%polar_inertia = '//to_text(disc%polar_inertia)//': must be at most twice diametral_inertia = ' &
               & //to_text(disc%diametral_inertia), error)
         end associate
      end do
      do i = 1, size(elastic%unbalances)
         call check_station('unbalance('//to_text(i)//')', elastic%unbalances(i)%station, stations, error)
      end do
      do i = 1, size(elastic%loads)
         call check_station('load('//to_text(i)//')', elastic%loads(i)%station, stations, error)
      end do
      do i = 1, size(excitations)
         call check_station('excitation('//to_text(i)//')', excitations(i)%station, stations, error)
      end do
   end subroutine check_parts

   !> A support holds the bearing.
   subroutine check_supports(bearings, error)
      type(bearing_type), intent(in) :: bearings(:)
      type(error_type), allocatable, intent(inout) :: error
      integer :: b
      do b = 1, size(bearings)
         if (.not. allocated(bearings(b)%support)) cycle
         associate (k => bearings(b)%support%stiffness, mass => bearings(b)%support%mass, &
            & group => 'support'//bearings(b)%suffix())
            if (.not. mass > 0) call refuse(group//'%mass = '//to_text(mass)//': must be above 0, kg', error)
            if (.not. all(is_set(k))) then
               call refuse(group//'%stiffness: must be given, along y and z', error)
            else if (.not. all(k > 0)) then
               call refuse(group//'%stiffness = '//to_text(minval(k))//': must be above 0 along y and z', error)
            end if
         end associate
      end do
   end subroutine check_supports

   !> Refuses a station that is left out or that the shaft, of this number of stations, does not have.
   subroutine check_station(group, station, stations, error)
      character(len=*), intent(in) :: group
      integer, intent(in) :: station, stations
      type(error_type), allocatable, intent(inout) :: error
      integer :: last
      last = stations
      if (last == 0) last = most_stations
      if (station == 0) then
         call refuse(group//'%station: must be given, 1 to '//to_text(last), error)
      else if (station > last) then
         call refuse(group//'%station = '//to_text(station)//': must be 1 to '//to_text(last)//', the stations of ' &
            & //'the shaft, of which there is one more than sections', error)
      end if
   end subroutine check_station
end module machine_checks
