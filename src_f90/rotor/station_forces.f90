!> Forces at the stations of a rotor, on y and z of station 1, y and z of station 2, ...
module station_forces
   use kinds, only: wp, degree
   use rotor_groups, only: load_type, unbalance_type
   implicit none (type, external)
   private
   public :: static_forces, unbalance_moments

contains

   !> Static forces of loads, N; n is twice the number of stations.
   pure function static_forces(loads, n) result(force)
      type(load_type), intent(in) :: loads(:)
      integer, intent(in) :: n
      real(wp) :: force(n)
      integer :: i
      force = 0
      do i = 1, size(loads)
         associate (at => loads(i)%station)
            force(2*at - 1:2*at) = force(2*at - 1:2*at) + loads(i)%force
         end associate
      end do
   end function static_forces

   !> Moments of unbalances, kg m, on a shaft that turns clockwise (sense = 1) or anticlockwise (-1): their forces
   !> at the shaft angle phi are Omega**2*(moments(1, :)*cos(phi) + moments(2, :)*sin(phi)).
   pure function unbalance_moments(unbalances, n, sense) result(moments)
      type(unbalance_type), intent(in) :: unbalances(:)
      integer, intent(in) :: n
      real(wp), intent(in) :: sense
      real(wp) :: moments(2, n), y, z
      integer :: i, at
      moments = 0
      do i = 1, size(unbalances)
         associate (u => unbalances(i))
            at = 2*u%station
            y = u%moment*cos(u%angle_deg*degree)
            z = u%moment*sin(u%angle_deg*degree)
            moments(:, at - 1) = moments(:, at - 1) + [y, -z]
            moments(:, at) = moments(:, at) + sense*[z, y]
         end associate
      end do
   end function unbalance_moments
end module station_forces
