!> Machines for tests: the symmetric rotor of docs/theory/machines.md, *Check values*, and changes of it.
module machine_cases
   use kinds, only: wp
   use case_inputs, only: case_type
   use machine_groups, only: machine_type
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
      type(machine_type) :: machine
      inputs = case_type()
      inputs%operation%speed_rpm = speed_rpm
      inputs%operation%final_speed_rpm = speed_rpm
      inputs%friction%model = friction
      inputs%film%cavitation = 'none'
      machine%shaft%length = [0.05_wp, 0.05_wp, spread(0.2_wp, 1, 8), 0.05_wp, 0.05_wp]
      machine%shaft%diameter = [spread(0.0998_wp, 1, 2), spread(0.34_wp, 1, 8), spread(0.0998_wp, 1, 2)]
      machine%shaft%bore = spread(0.0_wp, 1, 12)
      machine%rotor_file = ''
      allocate (machine%discs(1), machine%unbalances(1), machine%loads(0), machine%bearings(0))
      machine%discs(1)%station = disc_station
      machine%discs(1)%mass = disc_mass
      machine%discs(1)%polar_inertia = polar
      machine%discs(1)%diametral_inertia = diametral
      machine%unbalances(1)%station = disc_station
      machine%unbalances(1)%moment = unbalance
      inputs%machine = machine
      call add_bearing(inputs, 'left', 2)
      call add_bearing(inputs, 'right', 12)
   end function symmetric_rotor

   !> Another bearing with the groups of the case.
   subroutine add_bearing(inputs, name, station)
      type(case_type), intent(inout) :: inputs
      character(len=*), intent(in) :: name
      integer, intent(in) :: station
      type(machine_type) :: machine, before
      integer :: b
      before = inputs%machine
      machine = before
      deallocate (machine%bearings)
      allocate (machine%bearings(size(before%bearings) + 1))
      do b = 1, size(before%bearings)
         machine%bearings(b) = before%bearings(b)
      end do
      associate (own => machine%bearings(size(machine%bearings)))
         own%name = name
         own%station = station
         own%bearing = inputs%bearing
         own%oil = inputs%oil
         own%pads = inputs%pads
         own%pivot = inputs%pivot
         own%friction = inputs%friction
         own%asperity = inputs%asperity
         own%film = inputs%film
      end associate
      inputs%machine = machine
   end subroutine add_bearing
end module machine_cases
