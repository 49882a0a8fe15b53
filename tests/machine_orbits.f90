!> Equilibria and closed orbits of bearings and machines, and where shafts are, for tests.
module machine_orbits
   use kinds, only: wp
   use errors, only: error_type
   use case_inputs, only: case_type
   use factories, only: converged_films
   use equations_of_motion, only: machine_model, new_machine_model
   use equilibrium_record, only: equilibrium_type
   use equilibrium, only: find_equilibrium
   use marching, only: march_options
   use periodic_orbit, only: periodic_orbit_type, find_periodic_orbit
   use check, only: expect, expect_no_error
   implicit none (type, external)
   private
   public :: stand, stations, close_orbit, over_orbit, orbit_state

contains

   !> Equilibrium of a case, with its model.
   subroutine stand(inputs, model, found)
      type(case_type), intent(in) :: inputs
      type(machine_model), intent(out) :: model
      type(equilibrium_type), intent(out) :: found
      type(error_type), allocatable :: error
      model = new_machine_model(inputs, converged_films)
      call expect(.not. allocated(model%refusal), 'the rotor has equations')
      call find_equilibrium(model, found, error)
      call expect_no_error(error, 'the machine comes to equilibrium')
   end subroutine stand

   !> Displacements of the stations, um, (2, station).
   function stations(model, rotor) result(displacements)
      type(machine_model), intent(in) :: model
      real(wp), intent(in) :: rotor(:)
      real(wp) :: displacements(2, model%rotor%stations)
      displacements = 1e6_wp*model%rotor%station_displacements([rotor, spread(0.0_wp, 1, size(rotor))])
   end function stations

   !> The closed orbit that the motion from the equilibrium leads to, at tolerance.
   subroutine close_orbit(inputs, tolerance, model, found)
      type(case_type), intent(in) :: inputs
      real(wp), intent(in) :: tolerance
      type(machine_model), intent(out), target :: model
      type(periodic_orbit_type), intent(out) :: found
      type(equilibrium_type) :: static
      type(march_options) :: options
      type(error_type), allocatable :: error
      call stand(inputs, model, static)
      options%relative_tolerance = tolerance
      options%absolute_tolerance = tolerance*model%scale
      call find_periodic_orbit(model, options, model%static_state(static%rotor, static%pads), found, error)
      call expect_no_error(error, 'the orbit is found')
   end subroutine close_orbit

   !> y and z of a station over an orbit, um, at n even phases from 0.
   function over_orbit(model, found, station, n) result(path)
      type(machine_model), intent(in) :: model
      type(periodic_orbit_type), intent(in) :: found
      integer, intent(in) :: station, n
      real(wp) :: path(2, 0:n - 1), all(2, model%rotor%stations), y(model%n)
      integer :: k
      do k = 0, n - 1
         y = orbit_state(model, found, k, n)
         all = stations(model, y(:model%rotor%positions))
         path(:, k) = all(:, station)
      end do
   end function over_orbit

   !> The state of an orbit at the k-th of n even phases from 0.
   function orbit_state(model, found, k, n) result(y)
      type(machine_model), intent(in) :: model
      type(periodic_orbit_type), intent(in) :: found
      integer, intent(in) :: k, n
      real(wp) :: y(model%n)
      call found%orbit%state_at(found%period*k/n, y)
   end function orbit_state
end module machine_orbits
