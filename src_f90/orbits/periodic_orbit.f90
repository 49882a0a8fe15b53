!> A periodic orbit of a bearing under its unbalance: a march brings it near, Newton's method on its collocation closes
!> it, and its multipliers say whether it is stable.
module periodic_orbit
   use kinds, only: wp, i8, pi
   use text, only: to_text
   use errors, only: error_type, add_context, numerics_error, asked_to_stop
   use marching, only: march_options
   use integrator_counts, only: integrator_counts_type
   use cvode_integrator, only: integrator_type
   use equations_of_motion, only: bearing_model
   use orbit_polynomials, only: orbit_type, points, place
   use newton_method, only: newton_options, branch_point_type, correct
   use parametric_ode, only: parametric_ode_type
   use orbit_problem, only: orbit_problem_type, begin_orbits
   use orbit_march, only: march_period, mesh_options
   use unbalance_response, only: go_to_response
   implicit none (type, external)
   private
   public :: periodic_orbit_type, find_periodic_orbit, are_stable, loss_of_stability

   type :: periodic_orbit_type
      type(orbit_type) :: orbit
      !> Period, s.
      real(wp) :: period = 0
      !> Eigenvalues of the monodromy matrix, that of largest modulus first.
      complex(wp), allocatable :: multipliers(:)
      !> Periods marched, and what this cost.
      integer :: marched = 0
      type(integrator_counts_type) :: march
      !> Rounds of Newton's method that closed the orbit; evaluations of the equations with their derivatives in all
      !> rounds.
      integer :: iterations = 0
      integer(i8) :: evaluations = 0
   contains
      procedure :: counts
   end type periodic_orbit_type

   !> Newton's method is tried once the state changes by less than this over a period, over the scales, or after so many
   !> periods. Where it fails, it is tried again when the march has doubled. Over several turns the change must be less,
   !> or the method would lead back to an orbit of one turn that the motion is only leaving.
   real(wp), parameter :: near = 3e-2_wp, near_of_several = 1e-3_wp
   integer, parameter :: first_try = 12, last_try = 96
   !> The first period has the short steps of a start: it is no mesh. Most rounds before `first_try`.
   integer, parameter :: fewest_periods = 2, early_rounds = 12
   !> Largest correction that is made, over the scales.
   real(wp), parameter :: longest = 0.5_wp

contains

   !> The periodic orbit that the motion from state y leads to; from a state in equilibrium, that to which the motion
   !> near the answer of the linearised equations to the unbalance leads. A numerics error where the march ends or
   !> Newton's method finds none, or one of status `stopped`, where `give_up` says so.
   subroutine find_periodic_orbit(model, march, y, found, error, give_up)
      type(bearing_model), intent(inout), target :: model
      !> Tolerances of a march; they choose the mesh.
      type(march_options), intent(in) :: march
      real(wp), intent(in) :: y(:)
      type(periodic_orbit_type), intent(out) :: found
      type(error_type), allocatable, intent(out) :: error
      procedure(asked_to_stop), optional :: give_up
      type(integrator_type) :: integrator
      type(march_options) :: mesh
      type(orbit_type) :: before
      real(wp) :: close_by
      integer :: next_try, revolutions
      revolutions = model%inputs%periodic%revolutions
      found%period = revolutions*2*pi/model%point%speed(0.0_wp)
      found%orbit%start = y
      found%orbit%scale = model%scale
      mesh = mesh_options(march, found%period/revolutions)
      close_by = merge(near, near_of_several, revolutions == 1)
      if (revolutions == 1) call go_to_response(model, found%orbit%start)
      call integrator%start(model, mesh, 0.0_wp, found%orbit%start, last_try*found%period, error)
      next_try = first_try
      do while (.not. allocated(error))
         before = found%orbit
         call march_period(integrator, mesh, found%marched, found%period, found%orbit, error, give_up)
         found%march = integrator%counts()
         if (allocated(error)) exit
         found%marched = found%marched + 1
         if (found%marched < next_try .and. (found%evaluations > 0 .or. found%marched < fewest_periods &
            & .or. change_in_period(found%orbit) > close_by)) cycle
         next_try = 2*found%marched
         if (change_in_period(found%orbit) > close_by) call average(found%orbit, before)
         call close_orbit(model, found, error, give_up)
         if (.not. allocated(error)) return
         if (error%status == numerics_error .and. next_try <= last_try) deallocate (error)
      end do
      call add_context(error, 'no periodic orbit was found: after '//to_text(found%marched)//' periods')
   end subroutine find_periodic_orbit

   !> What the march and Newton's method cost together.
   pure type(integrator_counts_type) function counts(self)
      class(periodic_orbit_type), intent(in) :: self
      counts = self%march
      counts%rhs_evaluations = counts%rhs_evaluations + self%evaluations
      counts%jacobian_evaluations = counts%jacobian_evaluations + self%evaluations
   end function counts

   !> By how much the state changes over the period, over the scales.
   pure real(wp) function change_in_period(orbit) result(change)
      type(orbit_type), intent(in) :: orbit
      change = maxval(abs(orbit%at(:, points, orbit%intervals()) - orbit%start)/orbit%scale)
   end function change_in_period

   !> Puts an orbit half way to that of the period before: a motion that alternates between two does so about an
   !> unstable orbit of one period.
   pure subroutine average(orbit, before)
      type(orbit_type), intent(inout) :: orbit
      type(orbit_type), intent(in) :: before
      real(wp) :: y(size(orbit%start))
      integer :: k, i
      do k = 1, orbit%intervals()
         do i = 1, points
            call before%state_at(orbit%time(k - 1) + place(i)*(orbit%time(k) - orbit%time(k - 1)), y)
            orbit%at(:, i, k) = 0.5_wp*(orbit%at(:, i, k) + y)
         end do
      end do
      orbit%start = 0.5_wp*(orbit%start + before%start)
   end subroutine average

   !> Newton's method on the collocation of an orbit.
   subroutine close_orbit(model, found, error, give_up)
      type(bearing_model), intent(inout), target :: model
      type(periodic_orbit_type), intent(inout) :: found
      type(error_type), allocatable, intent(out) :: error
      procedure(asked_to_stop), optional :: give_up
      type(parametric_ode_type), target :: ode
      type(orbit_problem_type) :: problem
      type(newton_options) :: newton
      type(branch_point_type) :: closed
      associate (given => model%inputs%periodic)
         newton = newton_options(given%tolerance, given%max_iterations)
         if (found%marched < first_try) newton%max_iterations = min(newton%max_iterations, early_rounds)
         ode%model => model
         ode%period = found%period/given%revolutions
         call begin_orbits(problem, ode, found%orbit, given%revolutions)
      end associate
      problem%longest = longest
      call correct(problem, newton, closed, error, give_up)
      found%orbit = problem%orbit
      found%iterations = closed%iterations
      found%evaluations = found%evaluations + problem%tangents
      if (allocated(error)) then
         if (closed%iterations == model%inputs%periodic%max_iterations) then
            call add_context(error, 'periodic%max_iterations')
         end if
      else
         call move_alloc(closed%values, found%multipliers)
      end if
   end subroutine close_orbit

   !> True where a small disturbance of the orbit dies out.
   pure logical function are_stable(values)
      complex(wp), intent(in) :: values(:)
      are_stable = all(abs(values) < 1)
   end function are_stable

   !> How an unstable orbit loses its stability, by its leading multiplier.
   pure function loss_of_stability(values) result(loss)
      complex(wp), intent(in) :: values(:)
      character(len=:), allocatable :: loss
      associate (leading => values(1))
         if (abs(leading%im) > 0) then
            loss = 'a vibration of a second frequency grows (torus bifurcation)'
         else if (leading%re < 0) then
            loss = 'the period doubles'
         else
            loss = 'it is left without oscillation'
         end if
      end associate
   end function loss_of_stability
end module periodic_orbit
