!> Checks of what a lateral analysis needs: the groups impeller and lateral of a machine.
module lateral_checks
   use kinds, only: wp
   use text, only: to_text
   use errors, only: error_type, require, refuse
   use case_groups, only: impeller_type, lateral_type, is_set, most_stations
   use case_inputs, only: case_type
   implicit none (type, external)
   private
   public :: check_lateral

contains

   !> Raises an error for the first requirement that these groups do not meet.
   subroutine check_lateral(inputs, error)
      type(case_type), intent(in) :: inputs
      type(error_type), allocatable, intent(inout) :: error
      !> Stations of the shaft; of a rotor from a file there may be as many as any.
      real(wp) :: last
      integer :: i
      if (inputs%rotor%is_rigid()) return
      associate (elastic => inputs%rotor%elastic, stations => inputs%rotor%station_count())
         last = merge(stations, most_stations, stations > 0)
         do i = 1, size(elastic%impellers)
            call check_impeller(elastic%impellers(i), 'impeller('//to_text(i)//')%', last, error)
         end do
         if (allocated(elastic%lateral)) call check_analysis(elastic%lateral)
         if (size(elastic%impellers) == 0 .or. stations > 0 .or. allocated(error)) return
         i = 0
         if (allocated(elastic%lateral)) i = elastic%lateral%cross_station
         call require(i > 0, 'lateral%cross_station: must be given with impellers and rotor%file, which has no ' &
            & //'places of stations', error)
      end associate
   contains
      subroutine check_analysis(l)
         type(lateral_type), intent(in) :: l
         call require(size(inputs%rotor%elastic%impellers) > 0, 'lateral: needs groups &impeller, from which the ' &
            & //'stability levels of API 617 follow', error)
         call require(inputs%is_steady(), 'operation%final_speed_rpm = {}: must be speed_rpm = {} with &lateral, the ' &
            & //'highest operating speed', [inputs%operation%final_speed_rpm, inputs%operation%speed_rpm], error)
         associate (highest => inputs%operation%speed_rpm)
            call require(l%lowest_rpm <= highest, 'lateral%lowest_rpm = {}: must be at most operation%speed_rpm = {}', &
               & [l%lowest_rpm, highest], error)
            call require(l%first_rpm < l%lowest_rpm, 'lateral%first_rpm = {}: must be below lowest_rpm = {}', &
               & [l%first_rpm, l%lowest_rpm], error)
            call require(l%last_rpm > highest, 'lateral%last_rpm = {}: must be above operation%speed_rpm = {}', &
               & [l%last_rpm, highest], error)
         end associate
         call check_clearances(l%clearance_change)
         call check_places(l%probe_station, 'probe_station')
         call check_places(l%close_station, 'close_station')
         call check_places([real(l%cross_station, wp)], 'cross_station')
         call require(size(l%close_station) == size(l%close_clearance) .and. (is_set(l%close_station(1)) .eqv. &
            & is_set(l%close_clearance(1))), 'lateral%close_clearance: must have a value for each close_station', error)
      end subroutine check_analysis

      subroutine check_clearances(change)
         real(wp), intent(in) :: change(2)
         integer :: b
         call require(change(1) <= change(2), 'lateral%clearance_change = {}, {}: must rise, from the minimum to the ' &
            & //'maximum clearance (both in m)', change, error)
         do b = 1, size(inputs%bearings)
            associate (least => inputs%bearings(b)%clearance())
               call require(least + change(1) > 0, 'lateral%clearance_change = {}: must leave a clearance of ' &
                  & //inputs%bearings(b)%label(', which has {} (both in m)'), [change(1), least], error)
            end associate
         end do
      end subroutine check_clearances

      subroutine check_places(stations, name)
         real(wp), intent(in) :: stations(:)
         character(len=*), intent(in) :: name
         call require(maxval(stations) <= last, 'lateral%'//name//' = {}: must be 1 to {}, the stations of the shaft', &
            & [maxval(stations), last], error)
      end subroutine check_places
   end subroutine check_lateral

   subroutine check_impeller(impeller, name, last, error)
      type(impeller_type), intent(in) :: impeller
      character(len=*), intent(in) :: name
      !> Highest station.
      real(wp), intent(in) :: last
      type(error_type), allocatable, intent(inout) :: error
      call require(impeller%station > 0, name//'station: must be given, 1 to {}', [last], error)
      call require(impeller%station <= last, name//'station = {}: must be 1 to {}, the stations of the shaft', &
         & [real(impeller%station, wp), last], error)
      call need(impeller%power, 'power', 'W')
      call need(impeller%diameter, 'diameter', 'm')
      call need(impeller%width, 'width', 'm')
      if (impeller%kind == 'centrifugal') then
         call need(impeller%suction_density, 'suction_density', 'kg/m^3')
         call need(impeller%discharge_density, 'discharge_density', 'kg/m^3')
      else
         call require(.not. is_set(max(impeller%suction_density, impeller%discharge_density)), name//'kind = ' &
            & //'''axial'': has no suction_density or discharge_density', error)
      end if
   contains
      subroutine need(value, variable, unit)
         real(wp), intent(in) :: value
         character(len=*), intent(in) :: variable, unit
         if (.not. is_set(value)) call refuse(name//variable//': must be given, '//unit, error)
      end subroutine need
   end subroutine check_impeller
end module lateral_checks
