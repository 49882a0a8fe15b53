!> Orbits from which tests of orbits start, and single rounds of Newton's method on them.
module constant_orbit
   use kinds, only: wp
   use errors, only: error_type
   use ode_model, only: ode_model_type
   use orbit_polynomials, only: orbit_type, points
   use newton_method, only: newton_options, branch_point_type, correct
   use orbit_problem, only: parametric_ode_type, orbit_problem_type, begin_orbits
   implicit none (type, external)
   private
   public :: at_rest, newton_round

contains

   !> A constant orbit on n equal intervals of a period.
   type(orbit_type) function at_rest(states, n, period) result(orbit)
      integer, intent(in) :: states, n
      real(wp), intent(in) :: period
      integer :: k
      allocate (orbit%start(states), source=0.0_wp)
      allocate (orbit%scale(states), source=1.0_wp)
      call orbit%set_mesh([(period*k/n, k=0, n)], reshape([real(wp) ::], [states, points, n], pad=[0.0_wp]))
   end function at_rest

   !> One round on the orbit of a model; the multipliers before it, and the residual after it.
   subroutine newton_round(model, orbit, error, multipliers, residual)
      class(ode_model_type), intent(inout), target :: model
      type(orbit_type), intent(inout) :: orbit
      type(error_type), allocatable, intent(out) :: error
      complex(wp), allocatable, intent(out), optional :: multipliers(:)
      real(wp), intent(out), optional :: residual
      type(parametric_ode_type), target :: ode
      type(orbit_problem_type) :: problem
      type(branch_point_type) :: point
      ode%model => model
      ode%period = orbit%time(orbit%intervals())
      call begin_orbits(problem, ode, orbit, 1)
      call correct(problem, newton_options(tolerance=huge(1.0_wp)), point, error)
      orbit = problem%orbit
      if (present(residual)) residual = problem%residual()
      if (present(multipliers)) multipliers = point%values
   end subroutine newton_round
end module constant_orbit
