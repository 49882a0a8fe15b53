!> A periodic orbit of a bearing under its unbalance: a march brings it near, Newton's method on its collocation closes
!> it, and its multipliers say whether it is stable.
module periodic_orbit
   use kinds, only: wp, i8, pi
   use text, only: to_text
   use errors, only: error_type, add_context, numerics_error, asked_to_stop
   use linear_algebra, only: zgesv
   use operating_point, only: operating_point_type
   use marching, only: march_options
   use ode_model, only: integrator_counts_type
   use cvode_integrator, only: integrator_type
   use equations_of_motion, only: bearing_model
   use orbit_polynomials, only: orbit_type
   use newton_method, only: newton_options, branch_point_type, correct
   use orbit_problem, only: parametric_ode_type, orbit_problem_type, begin_orbits
   use orbit_march, only: march_period, mesh_options
   implicit none (type, external)
   private
   public :: periodic_orbit_type, find_periodic_orbit, are_stable, loss_of_stability

   type :: periodic_orbit_type
      type(orbit_type) :: orbit
      !> Period, s.
      real(wp) :: period = 0
      !> How far the equations are from being satisfied, over the scales.
      real(wp) :: residual = huge(1.0_wp)
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

   !> Newton's method is tried once the state changes by less than this over a period, over the scales, or after a
   !> number of periods. Where it fails, it is tried again when the march has doubled. Over several turns the change
   !> must be less, or the method would lead back to an orbit of one turn that the motion is only leaving.
   real(wp), parameter :: small_change = 3e-2_wp, small_change_of_several = 1e-3_wp
   integer, parameter :: first_try = 12, last_try = 96
   !> The first period has the short steps of a start: it is no mesh. Most rounds before `first_try`.
   integer, parameter :: fewest_periods = 2, early_rounds = 12
   !> Largest correction that is made, over the scales.
   real(wp), parameter :: longest = 0.5_wp
   !> A state that its mean rates move by less than this, over the scales, is in equilibrium.
   real(wp), parameter :: still = 1e-3_wp
   !> Largest amplitude of a displacement, over its scale: of a longer response only a part is taken.
   real(wp), parameter :: largest = 0.3_wp

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
      close_by = merge(small_change, small_change_of_several, revolutions == 1)
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
            & .or. maxval(abs(found%orbit%gap())) > close_by)) cycle
         next_try = 2*found%marched
         if (maxval(abs(found%orbit%gap())) > close_by) call average(found%orbit, before)
         call close_orbit(model, found, error, give_up)
         if (.not. allocated(error)) return
         if (error%status == numerics_error .and. next_try <= last_try) deallocate (error)
      end do
      call add_context(error, 'no periodic orbit was found: after '//to_text(found%marched)//' periods')
   end subroutine find_periodic_orbit

   !> Puts a state in equilibrium into the steady motion of the linearised equations under the unbalance, without
   !> friction, at t = 0: it is near the periodic orbit, and free of a march. Other states stay.
   subroutine go_to_response(model, y)
      type(bearing_model), intent(inout) :: model
      real(wp), intent(inout) :: y(:)
      type(operating_point_type) :: point, free
      complex(wp) :: matrix(model%n, model%n), response(model%n, 2)
      real(wp) :: rates(model%n, 0:2), jacobian(model%n, model%n), speed, amplitude
      integer :: pivots(model%n), info, i
      logical :: ok
      point = model%point
      speed = point%speed(0.0_wp)
      free = point
      free%friction = .false.
      call model%set_point(free)
      do i = 2, 0, -1
         call model%rhs_and_jacobian(i*pi/(2*speed), y, rates(:, i), jacobian, ok)
         if (.not. ok) exit
         rates(:, i) = rates(:, i)/(speed*model%scale)
      end do
      call model%set_point(point)
      if (.not. ok) return
      ! the rates are mean + Re(swing exp(i angle))
      response(:, 1) = 0.5_wp*(rates(:, 0) + rates(:, 2))
      response(:, 2) = cmplx(rates(:, 0), -rates(:, 1), wp) - (1.0_wp, -1.0_wp)*response(:, 1)
      do i = 1, model%n
         matrix(:, i) = -jacobian(:, i)*model%scale(i)/(speed*model%scale)
         matrix(i, i) = matrix(i, i) + (0.0_wp, 1.0_wp)
      end do
      call zgesv(model%n, 2, matrix, model%n, pivots, response, model%n, info)
      if (info /= 0 .or. .not. all(abs(response) <= huge(speed))) return
      if (maxval(abs(response(:, 1))) > still) return
      amplitude = maxval(abs(response(model%layout%positions(), 2)))
      y = y + model%scale*response(:, 2)%re*largest/max(largest, amplitude)
   end subroutine go_to_response

   !> What the march and Newton's method cost together.
   pure type(integrator_counts_type) function counts(self)
      class(periodic_orbit_type), intent(in) :: self
      counts = self%march
      counts%rhs_evaluations = counts%rhs_evaluations + self%evaluations
      counts%jacobian_evaluations = counts%jacobian_evaluations + self%evaluations
   end function counts

   !> Puts an orbit half way to that of the period before: a motion that alternates between two does so about an
   !> unstable orbit of one period.
   pure subroutine average(orbit, before)
      type(orbit_type), intent(inout) :: orbit
      type(orbit_type), intent(inout) :: before
      call before%change_mesh(orbit%time)
      orbit%at = 0.5_wp*(orbit%at + before%at)
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
         if (present(give_up)) newton%give_up => give_up
         if (found%marched < first_try) newton%max_iterations = min(newton%max_iterations, early_rounds)
         ode%model => model
         ode%period = found%period/given%revolutions
         call begin_orbits(problem, ode, found%orbit, given%revolutions)
      end associate
      problem%longest = longest
      call correct(problem, newton, closed, error)
      found%orbit = problem%orbit
      found%iterations = closed%iterations
      found%evaluations = found%evaluations + problem%tangents
      if (allocated(error)) then
         if (closed%iterations == model%inputs%periodic%max_iterations) then
            call add_context(error, 'periodic%max_iterations')
         end if
      else
         call move_alloc(closed%values, found%multipliers)
         found%residual = problem%residual()
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
