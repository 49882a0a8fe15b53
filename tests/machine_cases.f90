!> Machines for tests: the symmetric rotor of docs/theory/machines.md, *Check values*, and changes of it.
module machine_cases
   use kinds, only: wp
   use case_inputs, only: case_type
   use case_groups, only: bearing_type, disc_type, unbalance_type
   implicit none (type, external)
   private
   public :: symmetric_rotor, add_bearing, disc_station

   !> The station of disc and unbalance, and its mass, kg, and inertias, kg m^2.
   integer, parameter :: disc_station = 7
   real(wp), parameter :: disc_mass = 2847.3706547456786_wp, polar = 512.526717854222_wp, &
      & diametral = 280.5609218476075_wp

contains

   !> A shaft of 4000 kg with a disc in the middle on two of the paper's bearings, whose films do not cavitate, with
   !> this friction and an unbalance, kg m, at the disc.
   type(case_type) function symmetric_rotor(friction, speed_rpm, unbalance) result(inputs)
      character(len=*), intent(in) :: friction
      real(wp), intent(in) :: speed_rpm, unbalance
      inputs = case_type()
      inputs%operation%speed_rpm = speed_rpm
      inputs%operation%final_speed_rpm = speed_rpm
      allocate (inputs%rotor%elastic)
      associate (elastic => inputs%rotor%elastic, shaft => inputs%rotor%elastic%shaft)
         call elastic%begin(discs=1, unbalances=1, loads=0, elements=0, impellers=0, lateral=.false.)
         shaft%length = [0.05_wp, 0.05_wp, spread(0.2_wp, 1, 8), 0.05_wp, 0.05_wp]
         shaft%diameter = [spread(0.0998_wp, 1, 2), spread(0.34_wp, 1, 8), spread(0.0998_wp, 1, 2)]
         shaft%bore = spread(0.0_wp, 1, 12)
         elastic%discs(1) = disc_type(disc_station, disc_mass, polar, diametral)
         elastic%unbalances(1) = unbalance_type(disc_station, unbalance)
      end associate
      associate (left => inputs%bearings(1))
         left%name = 'left'
         left%station = 2
         left%friction%model = friction
         left%film%cavitation = 'none'
      end associate
      call add_bearing(inputs, 'right', 12)
   end function symmetric_rotor

   !> Another bearing with the groups of the first.
   subroutine add_bearing(inputs, name, station)
      type(case_type), intent(inout) :: inputs
      character(len=*), intent(in) :: name
      integer, intent(in) :: station
      type(bearing_type), allocatable :: longer(:)
      integer :: b, n
      n = size(inputs%bearings) + 1
      allocate (longer(n))
      do b = 1, n
         longer(b) = inputs%bearings(merge(b, 1, b < n))
      end do
      longer(n)%name = name
      longer(n)%station = station
      call move_alloc(longer, inputs%bearings)
   end subroutine add_bearing
end module machine_cases
