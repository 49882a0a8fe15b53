!> A periodic orbit of a bearing under its unbalance: a march brings it near, Newton's method on its collocation closes
!> it, and its multipliers say whether it is stable.
module periodic_orbit
   use kinds, only: wp, i8, pi
   use text, only: to_text
   use errors, only: error_type, raise, add_context, numerics_error
   use marching, only: march_options
   use ode_model, only: integrator_counts_type
   use cvode_integrator, only: integrator_type
   use equations_of_motion, only: machine_model
   use orbit_polynomials, only: orbit_type, points
   use newton_method, only: newton_options
   use orbit_refinement, only: refined_orbit_type, close_on_meshes, linearize_along
   use orbit_problem, only: parametric_ode_type, orbit_problem_type, begin_orbits
   use march_settings, only: march_period, mesh_options
   use linear_algebra, only: solve_complex, find_eigenvalues
   use operating_point, only: operating_point_type
   implicit none (type, external)
   private
   public :: periodic_orbit_type, find_periodic_orbit, are_stable, loss_of_stability, march_repetition_type

   !> A vibration of which more than this part is left after a period is seen by its multiplier; by how much it turns
   !> in an interval of the first mesh, rad, at most. From there on its multiplier says whether that is enough.
   real(wp), parameter :: lasting = 1e-2_wp, turn = 1.5_wp
   !> A state that its mean rates move by less than this, over the scales, is in equilibrium.
   real(wp), parameter :: still = 1e-3_wp
   !> Largest amplitude of a displacement, over its scale: of a longer response only a part is taken.
   real(wp), parameter :: largest = 0.3_wp

   !> With the multipliers, their errors by the changes from mesh to mesh, and the iterations of Newton's method on the
   !> meshes that closed the orbit.
   type, extends(refined_orbit_type) :: periodic_orbit_type
      type(orbit_type) :: orbit
      !> Period, s.
      real(wp) :: period = 0
      !> How far the equations are from being satisfied, over the scales.
      real(wp) :: residual = huge(1.0_wp)
      !> Whether Newton's method closed the orbit. Else it is a period of a march that repeats, and by how much the
      !> displacements change in a period, over the scales.
      logical :: closed = .true.
      real(wp) :: change = 0
      !> Periods marched, and what this cost.
      integer :: marched = 0
      type(integrator_counts_type) :: march
      !> Evaluations of the equations with their derivatives in all iterations.
      integer(i8) :: evaluations = 0
   contains
      procedure :: counts
      procedure :: is_stable
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

   !> Where journal (first two) and tilts are at the ends of the periods, over their scales, (displacement, period).
   type :: march_repetition_type
      real(wp), allocatable :: at(:, :)
   contains
      procedure :: add
      procedure :: change
      procedure :: decay
      procedure :: repeats
      procedure :: cause
   end type march_repetition_type

   !> A march repeats where its last periods, this many, each changed the displacements by less than this.
   real(wp), parameter :: small = 1e-3_wp
   integer, parameter :: looked_at = 3
   !> Most periods after which it is asked whether the march repeats.
   integer, parameter :: most_periods = 8
   !> A motion creeps where its way over `most_periods` periods is straight: not shorter than this part of the sum of
   !> its changes.
   real(wp), parameter :: straight = 0.9_wp
   !> Farthest that the last period of a march may be from the orbit to which it leads, over the extent of this.
   real(wp), parameter :: allowed_distance = 1e-2_wp

contains

   !> The periodic orbit that the motion from state y leads to; from a state in equilibrium, that to which the motion
   !> near the answer of the linearised equations to the unbalance leads. Where Newton's method does not close it from
   !> there, the motion from y itself as the case is marched. A numerics error where the march ends, or where it does
   !> not repeat and Newton's method finds no orbit; one of status `stopped`, where `give_up` of the model says so.
   subroutine find_periodic_orbit(model, march, y, found, error)
      type(machine_model), intent(inout), target :: model
      !> Tolerances of a march; they choose the mesh.
      type(march_options), intent(in) :: march
      real(wp), intent(in) :: y(:)
      type(periodic_orbit_type), intent(out) :: found
      type(error_type), allocatable, intent(out) :: error
      type(integrator_type) :: integrator
      type(march_options) :: options
      type(orbit_type) :: before
      type(integrator_counts_type) :: earlier
      type(march_repetition_type) :: repetition
      integer :: next_try, revolutions
      logical :: near_by
      revolutions = model%inputs%periodic%revolutions
      found%period = revolutions*2*pi/model%point%speed(0.0_wp)
      found%orbit%start = y
      found%orbit%scale = model%scale
      options = mesh_options(march, found%period/revolutions)
      options%give_up => model%give_up
      near_by = .true.
      if (revolutions == 1) call go_to_response(model, found%orbit%start)
      call integrator%start(model, options, 0.0_wp, found%orbit%start, last_try*found%period, error)
      next_try = first_try
      do while (.not. allocated(error))
         before = found%orbit
         call march_period(integrator, options, found%marched, found%period, found%orbit, error)
         found%march = earlier + integrator%counts()
         if (.not. allocated(error)) then
            found%marched = found%marched + 1
            call repetition%add(model%positions(found%orbit%end()))
            if (found%marched < next_try .and. (found%evaluations > 0 .or. found%marched < fewest_periods &
               & .or. .not. nearly_closed(found%orbit, revolutions))) cycle
            next_try = 2*found%marched
            call close_or_accept()
            if (.not. allocated(error)) return
            if (next_try > last_try) call add_context(error, repetition%cause(revolutions))
            near_by = near_by .and. next_try <= last_try
            if (error%status == numerics_error .and. next_try <= last_try) deallocate (error)
            if (found%marched < first_try) cycle
         end if
         if (.not. near_by) cycle
         if (allocated(error)) then
            if (error%status /= numerics_error) exit
            deallocate (error)
         end if
         near_by = .false.
         earlier = found%march
         repetition = march_repetition_type()
         call start_march()
      end do
      call add_context(error, 'no periodic orbit was found: after '//to_text(found%marched)//' periods')

   contains

      !> Starts at state y as the case is marched.
      subroutine start_march()
         options%relative_tolerance = march%relative_tolerance
         options%absolute_tolerance = march%absolute_tolerance
         options%max_steps = march%max_steps - found%march%steps
         call integrator%start(model, options, found%marched*found%period, y, last_try*found%period, error)
      end subroutine start_march

      !> Closes the last period of a march by Newton's method, or its mean with the period before where these are far
      !> from each other. Where that fails, but the march repeats this period, it is the orbit.
      subroutine close_or_accept()
         type(orbit_type) :: marched
         marched = found%orbit
         if (.not. nearly_closed(marched, revolutions)) then
            ! a motion that alternates between two orbits does so about an unstable one of one period
            call before%change_mesh(found%orbit%time)
            found%orbit%at = 0.5_wp*(found%orbit%at + before%at)
            found%orbit%start = 0.5_wp*(found%orbit%start + before%start)
         end if
         call close_orbit(model, found, error)
         if (.not. allocated(error)) return
         found%orbit = marched
         if (error%status /= numerics_error .or. found%marched < first_try .or. .not. repetition%repeats(1)) return
         call follow_march(model, repetition, found, error)
      end subroutine close_or_accept
   end subroutine find_periodic_orbit

   !> Whether an orbit is so close to itself a period later that Newton's method may begin.
   pure logical function nearly_closed(orbit, revolutions)
      type(orbit_type), intent(in) :: orbit
      integer, intent(in) :: revolutions
      nearly_closed = maxval(abs(orbit%gap())) <= merge(small_change, small_change_of_several, revolutions == 1)
   end function nearly_closed

   !> What the march and Newton's method cost together.
   pure type(integrator_counts_type) function counts(self)
      class(periodic_orbit_type), intent(in) :: self
      counts = self%march
      counts%rhs_evaluations = counts%rhs_evaluations + self%evaluations
      counts%jacobian_evaluations = counts%jacobian_evaluations + self%evaluations
   end function counts

   !> Newton's method on the collocation of an orbit.
   subroutine close_orbit(model, found, error)
      type(machine_model), intent(inout), target :: model
      type(periodic_orbit_type), intent(inout) :: found
      type(error_type), allocatable, intent(out) :: error
      type(parametric_ode_type), target :: ode
      type(orbit_problem_type) :: problem
      type(newton_options) :: newton
      associate (given => model%inputs%periodic)
         newton = newton_options(given%tolerance, given%max_iterations)
         newton%give_up => model%give_up
         if (found%marched < first_try) newton%max_iterations = min(newton%max_iterations, early_rounds)
      end associate
      call begin_problem(model, found, ode, problem)
      problem%longest = longest
      call close_on_meshes(problem, newton, longest_interval(model, found%orbit%start, found%period), &
         & found%refined_orbit_type, error)
      found%evaluations = found%evaluations + problem%tangents
      if (allocated(error)) then
         if (found%exhausted .and. newton%max_iterations == model%inputs%periodic%max_iterations) then
            call add_context(error, 'periodic%max_iterations')
         end if
         return
      end if
      found%orbit = problem%orbit
      found%residual = problem%residual()
   end subroutine close_orbit

   !> The problem of an orbit of a model, of this ODE.
   subroutine begin_problem(model, found, ode, problem)
      type(machine_model), intent(inout), target :: model
      type(periodic_orbit_type), intent(in) :: found
      type(parametric_ode_type), intent(inout), target :: ode
      type(orbit_problem_type), intent(out) :: problem
      ode%model => model
      ode%period = found%period/model%inputs%periodic%revolutions
      call begin_orbits(problem, ode, found%orbit, model%inputs%periodic%revolutions)
   end subroutine begin_problem

   !> Takes the last period of a march that repeats as the orbit, with the multipliers along it; a numerics error where
   !> the changes to come add up to another orbit. They fall by the leading multiplier from period to period, or by what
   !> they fell by, where friction or switching films make the multiplier that of one side alone.
   subroutine follow_march(model, repetition, found, error)
      type(machine_model), intent(inout), target :: model
      type(march_repetition_type), intent(in) :: repetition
      type(periodic_orbit_type), intent(inout) :: found
      type(error_type), allocatable, intent(out) :: error
      type(parametric_ode_type), target :: ode
      type(orbit_problem_type) :: problem
      character(len=:), allocatable :: how
      real(wp) :: extent, away
      call begin_problem(model, found, ode, problem)
      call linearize_along(problem, found%refined_orbit_type, error)
      found%evaluations = found%evaluations + problem%tangents
      if (allocated(error)) return
      extent = extent_of(model, found%orbit)
      away = repetition%change(1)/max(1 - min(abs(found%multipliers(1)), repetition%decay()), epsilon(away))
      if (away > allowed_distance*extent) then
         how = 'is still '//to_text(100*away/extent)//' % of the orbit away from where it leads'
         if (away > extent) how = 'changes in each period by nearly as much as in the one before'
         call raise(error, numerics_error, 'Newton''s method does not close it, and the march '//how &
            & //': begin at the end of a longer march (start%from = ''file'')')
         return
      end if
      found%closed = .false.
      found%change = repetition%change(1)
      found%residual = problem%residual()
   end subroutine follow_march

   !> The largest peak to peak of a displacement along an orbit, over its scale.
   pure real(wp) function extent_of(model, orbit) result(extent)
      type(machine_model), intent(in) :: model
      type(orbit_type), intent(in) :: orbit
      real(wp), allocatable :: least(:), most(:)
      integer :: k
      least = model%positions(orbit%start)
      most = least
      do k = 1, orbit%intervals()
         least = min(least, model%positions(orbit%at(:, points, k)))
         most = max(most, model%positions(orbit%at(:, points, k)))
      end do
      extent = maxval(most - least)
   end function extent_of

   !> True where a small disturbance dies out, or where a march stays on the orbit.
   pure logical function is_stable(self)
      class(periodic_orbit_type), intent(in) :: self
      is_stable = are_stable(self%multipliers) .or. .not. self%closed
   end function is_stable

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

   ! What the equations linearised in a state say of an orbit near it: the steady motion under the unbalance, and how
   ! short intervals have to be to show the vibrations that last.

   !> Puts a state in equilibrium into the steady motion of the linearised equations under the unbalance, without
   !> friction, at t = 0: it is near the periodic orbit, and free of a march. Other states stay.
   subroutine go_to_response(model, y)
      type(machine_model), intent(inout) :: model
      real(wp), intent(inout) :: y(:)
      type(operating_point_type) :: point, free
      complex(wp) :: matrix(model%n, model%n), response(model%n, 2)
      real(wp) :: rates(model%n, 0:2), jacobian(model%n, model%n), speed, amplitude
      integer :: i
      logical :: ok
      point = model%point
      speed = point%speed(0.0_wp)
      free = point
      free%friction = .false.
      if (allocated(free%excitations)) deallocate (free%excitations)
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
      call solve_complex(model%n, 2, matrix, response, ok)
      if (.not. (ok .and. all(abs(response) <= huge(speed)))) return
      if (maxval(abs(response(:, 1))) > still) return
      amplitude = maxval(abs(response(model%layout%positions(), 2)))
      y = y + model%scale*response(:, 2)%re*largest/max(largest, amplitude)
   end subroutine go_to_response

   !> The longest interval, s, that shows the vibrations about state y that last longer than a period, s.
   real(wp) function longest_interval(model, y, period) result(longest)
      type(machine_model), intent(inout) :: model
      real(wp), intent(in) :: y(:), period
      real(wp) :: rates(model%n), jacobian(model%n, model%n)
      complex(wp) :: values(model%n)
      logical :: ok
      integer :: i
      longest = period
      call model%rhs_and_jacobian(0.0_wp, y, rates, jacobian, ok)
      if (.not. ok) return
      do i = 1, model%n
         jacobian(:, i) = jacobian(:, i)*model%scale(i)/model%scale
      end do
      call find_eigenvalues(jacobian, values, ok)
      if (.not. ok) return
      longest = turn/max(turn/period, maxval(abs(values), mask=values%re*period > log(lasting)))
   end function longest_interval

   ! What displacements do from period to period of a march: repeat, repeat after some periods, creep, or none of these.

   !> Adds the displacements at the end of a period.
   subroutine add(self, displacements)
      class(march_repetition_type), intent(inout) :: self
      real(wp), intent(in) :: displacements(:)
      if (allocated(self%at)) then
         self%at = reshape([self%at, displacements], [size(displacements), size(self%at, 2) + 1])
      else
         self%at = reshape(displacements, [size(displacements), 1])
      end if
   end subroutine add

   !> The largest change of a displacement over a number of periods, of the last three such changes.
   pure real(wp) function change(self, periods)
      class(march_repetition_type), intent(in) :: self
      integer, intent(in) :: periods
      associate (n => size(self%at, 2))
         change = huge(change)
         if (n < periods + looked_at) return
         change = maxval(abs(self%at(:, n - looked_at + 1:) - self%at(:, n - looked_at + 1 - periods:n - periods)))
      end associate
   end function change

   !> By which factor the changes fell from period to period, in the mean of the last ones; 1 where that is not known.
   pure real(wp) function decay(self)
      class(march_repetition_type), intent(in) :: self
      real(wp) :: last, before
      decay = 1
      associate (n => size(self%at, 2))
         if (n < most_periods + 2) return
         last = maxval(abs(self%at(:, n) - self%at(:, n - 1)))
         before = maxval(abs(self%at(:, n - most_periods) - self%at(:, n - most_periods - 1)))
      end associate
      if (last < before) decay = (last/before)**(1.0_wp/most_periods)
   end function decay

   !> Whether the march repeats after a number of periods.
   pure logical function repeats(self, periods)
      class(march_repetition_type), intent(in) :: self
      integer, intent(in) :: periods
      repeats = self%change(periods) < small
   end function repeats

   !> Why there is no orbit of one period, which takes this number of revolutions; empty where the march repeats it.
   function cause(self, revolutions)
      class(march_repetition_type), intent(in) :: self
      integer, intent(in) :: revolutions
      character(len=:), allocatable :: cause
      real(wp) :: way
      integer :: k, worst
      cause = ''
      associate (n => size(self%at, 2))
         if (n < most_periods + looked_at .or. self%repeats(1)) return
         do k = 2, most_periods
            if (.not. self%repeats(k)) cycle
            cause = 'the march repeats after '//to_text(k)//' periods: try periodic%revolutions = ' &
               & //to_text(k*revolutions)
            return
         end do
         worst = maxloc(maxval(abs(self%at(:, n - looked_at + 1:) - self%at(:, n - looked_at:n - 1)), dim=2), dim=1)
         associate (last => self%at(worst, n - most_periods:n))
            way = sum(abs(last(2:) - last(:most_periods)))
            cause = 'the march does not repeat: the journal'
            if (worst > 2) cause = 'the march does not repeat: pad '//to_text(worst - 2)
            if (abs(last(most_periods + 1) - last(1)) > straight*way) then
               cause = cause//' creeps by '//to_text(way/most_periods)
            else
               cause = cause//' changes by up to '//to_text(maxval(abs(last(2:) - last(:most_periods))))
            end if
            cause = cause//' of its characteristic scale in a period'
         end associate
      end associate
   end function cause
end module periodic_orbit
