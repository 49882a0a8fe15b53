!> Forces at the stations of a rotor, on y and z of station 1, y and z of station 2, ...
module station_forces
   use kinds, only: wp, degree
   use machine_groups, only: machine_type
   implicit none (type, external)
   private
   public :: static_forces, unbalances

contains

   !> Static forces of a machine's loads, N; n is twice the number of stations.
   pure function static_forces(machine, n) result(force)
      type(machine_type), intent(in) :: machine
      integer, intent(in) :: n
      real(wp) :: force(n)
      integer :: i
      force = 0
      do i = 1, size(machine%loads)
         associate (at => machine%loads(i)%station)
            force(2*at - 1:2*at) = force(2*at - 1:2*at) + machine%loads(i)%force
         end associate
      end do
   end function static_forces

   !> Moments of its unbalances, kg m, on a shaft that turns clockwise (sense = 1) or anticlockwise (-1): their forces
   !> at the shaft angle phi are Omega**2*(moments(1, :)*cos(phi) + moments(2, :)*sin(phi)).
   pure function unbalances(machine, n, sense) result(moments)
      type(machine_type), intent(in) :: machine
      integer, intent(in) :: n
      real(wp), intent(in) :: sense
      real(wp) :: moments(2, n), y, z
      integer :: i, at
      moments = 0
      do i = 1, size(machine%unbalances)
         associate (u => machine%unbalances(i))
            at = 2*u%station
            y = u%moment*cos(u%angle_deg*degree)
            z = u%moment*sin(u%angle_deg*degree)
            moments(:, at - 1) = moments(:, at - 1) + [y, -z]
            moments(:, at) = moments(:, at) + sense*[z, y]
         end associate
      end do
   end function unbalances
end module station_forces
