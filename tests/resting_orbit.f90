!> Orbits from which tests of orbits start.
module resting_orbit
   use kinds, only: wp
   use orbit_polynomials, only: orbit_type, points
   implicit none (type, external)
   private
   public :: at_rest

contains

   !> An orbit at rest on n equal intervals of a period.
   type(orbit_type) function at_rest(states, n, period) result(orbit)
      integer, intent(in) :: states, n
      real(wp), intent(in) :: period
      integer :: k
      allocate (orbit%start(states), source=0.0_wp)
      allocate (orbit%scale(states), source=1.0_wp)
      call orbit%set_mesh([(period*k/n, k=0, n)], reshape([real(wp) ::], [states, points, n], pad=[0.0_wp]))
   end function at_rest
end module resting_orbit
