!> The branches of a bearing over a number of its input: what is followed, how far it has come, and the next point.
module branch_progress
   use kinds, only: wp, i8
   use text, only: to_text
   use errors, only: error_type, add_context, numerics_error, stopped
   use case_groups, only: branch_type
   use case_parameter, only: case_parameter_type, find_parameter
   use equations_of_motion, only: machine_model
   use film_network, only: warm_films_type
   use static_model, only: make_fine, make_static
   use march_settings, only: march_settings_of
   use orbit_polynomials, only: orbit_type, points
   use orbit_problem, only: orbit_problem_type, begin_orbits, period_multiple_at
   use limit_cycle, only: limit_cycle_type, begin_cycles
   use hopf_start, only: find_hopf_point, begin_at_hopf_point
   use newton_method, only: branch_problem_type, branch_point_type, can_be_of, return_to
   use continuation, only: branch_options, start_branch, advance, bifurcation_type, find_bifurcations
   use varied_bearing, only: varied_bearing_type, bearing_orbits_type
   use heat_balance_equations, only: has_warm_oil
   use equilibrium_branch, only: equilibrium_problem_type, begin_equilibria
   use linear_algebra, only: solve
   implicit none (type, external)
   private
   public :: branch_progress_type, double_period

   type :: branch_progress_type
      !> What the case asks for.
      type(branch_type) :: given
      type(case_parameter_type) :: parameter
      type(branch_options) :: options
      !> Value of the case, and the size of the way from there.
      real(wp) :: first = 0, way = 0
      !> Either is followed; it is the problem. Orbits may be limit cycles.
      logical :: of_orbits = .true., of_cycles = .false.
      class(branch_problem_type), pointer :: problem => null()
      class(orbit_problem_type), allocatable :: orbits
      type(equilibrium_problem_type) :: equilibria
      type(bearing_orbits_type) :: ode
      !> In equilibrium: of equilibria, with converged films; of orbits with warm oil, for its viscosities.
      type(machine_model) :: static
      !> Number of the branch that is followed, and of its points; the length of the next step.
      integer :: branch = 1, points = 0
      real(wp) :: length = 0
      type(branch_point_type) :: here
      !> Orbits of fewer revolutions are followed where their period doubles.
      integer, private :: longest_turns = 0
      !> Period doublings from which branches are still to be followed.
      type(branch_point_type), allocatable :: period_doublings(:)
   contains
      procedure :: prepare
      procedure :: begin_oil
      procedure :: begin_with_orbit
      procedure :: begin_with_equilibrium
      procedure :: begin_at_hopf
      procedure :: begin_anywhere
      procedure :: first_point
      procedure :: go_on
      procedure :: take_step
      procedure :: begin_double
   end type branch_progress_type

   !> The largest step over the first, where the case leaves it open.
   real(wp), parameter :: usual_growth = 10
   !> First step of a branch of double period over that of the first: it starts across the parameter.
   real(wp), parameter :: across = 0.3_wp
   !> First step of a branch of limit cycles, over the clearance, at most: it starts across the parameter, too.
   real(wp), parameter :: first_cycle = 0.01_wp
   !> How far behind the last point of a branch, over the first step, is looked for a reason of its end.
   real(wp), parameter :: step_beyond = 1e-2_wp
   !> Periods are doubled up to this many of the first branch's.
   integer, parameter :: longest_period = 8

contains

   !> What follows from the case of a model; marches have taken this many steps already.
   subroutine prepare(self, model, steps, error)
      class(branch_progress_type), intent(inout), target :: self
      type(machine_model), intent(in), target :: model
      integer(i8), intent(in) :: steps
      type(error_type), allocatable, intent(out) :: error
      associate (given => model%inputs%branch)
         call find_parameter(model%inputs, given%parameter, self%parameter, error)
         if (allocated(error)) return
         self%first = self%parameter%value(model%inputs)
         self%way = abs(given%last - self%first)
         self%of_orbits = given%of /= 'equilibrium'
         self%of_cycles = given%of == 'limit_cycle'
         if (self%of_cycles) then
            allocate (limit_cycle_type :: self%orbits)
         else
            allocate (orbit_problem_type :: self%orbits)
         end if
         self%options%low = min(given%last, self%first)
         self%options%high = max(given%last, self%first)
         self%options%first_step = abs(given%step)/self%way
         self%options%max_step = given%max_step/self%way
         if (.not. given%max_step > 0) self%options%max_step = usual_growth*self%options%first_step
      end associate
      self%given = model%inputs%branch
      self%longest_turns = longest_period*model%inputs%periodic%revolutions
      self%length = self%options%first_step
      allocate (self%period_doublings(0))
      if (self%of_orbits) then
         self%problem => self%orbits
         self%options%tolerance = model%inputs%periodic%tolerance
         self%ode%bearing = varied_bearing_type(model, self%parameter)
         self%ode%model => model
         ! for meshes alone, wherever the branch leads
         self%ode%march = march_settings_of(model, steps)
      else
         self%problem => self%equilibria
         call make_fine(model, self%static)
      end if
   end subroutine prepare

   !> Gives orbits the viscosities of warm oil from the equilibrium, whose state this is and whose viscosities the model
   !> has.
   subroutine begin_oil(self, model, equilibrium_state)
      class(branch_progress_type), intent(inout), target :: self
      type(machine_model), intent(in) :: model
      real(wp), intent(in) :: equilibrium_state(:)
      call make_static(model, model%point%cavitation, self%static)
      ! Newton's method on the orbit asks
      nullify (self%static%give_up)
      allocate (self%ode%oil)
      self%ode%oil%bearing = varied_bearing_type(self%static, self%parameter)
      self%ode%start = [equilibrium_state, model%oil%viscosity]
   end subroutine begin_oil

   subroutine begin_with_orbit(self, orbit, period_multiple)
      class(branch_progress_type), intent(inout), target :: self
      type(orbit_type), intent(in) :: orbit
      !> Revolutions of the shaft in it.
      integer, intent(in) :: period_multiple
      select type (orbits => self%orbits)
      type is (limit_cycle_type)
         call begin_cycles(orbits, self%ode, orbit, self%first, self%way)
      class default
         call begin_orbits(orbits, self%ode, orbit, period_multiple, self%first, self%way)
      end select
   end subroutine begin_with_orbit

   !> With the state of an equilibrium of `static`, and the temperatures along and across its films, if it has any.
   subroutine begin_with_equilibrium(self, y, films)
      class(branch_progress_type), intent(inout), target :: self
      real(wp), intent(in) :: y(:)
      type(warm_films_type), allocatable, intent(in), optional :: films(:)
      call begin_equilibria(self%equilibria, varied_bearing_type(self%static, self%parameter), y, self%first, &
         & self%way, films)
   end subroutine begin_with_equilibrium

   !> With the limit cycles that begin at the first Hopf point of the equilibria. `fine`, a static model, is in
   !> equilibrium in y, with these temperatures along and across its films, if it has any.
   subroutine begin_at_hopf(self, model, fine, y, films, hopf, error)
      class(branch_progress_type), intent(inout), target :: self
      type(machine_model), intent(in) :: model
      type(machine_model), intent(in), target :: fine
      real(wp), intent(in) :: y(:)
      type(warm_films_type), allocatable, intent(in) :: films(:)
      type(bifurcation_type), intent(out) :: hopf
      type(error_type), allocatable, intent(out) :: error
      type(equilibrium_problem_type) :: equilibria
      real(wp) :: at_rest(model%n)
      integer :: b
      call begin_equilibria(equilibria, varied_bearing_type(fine, self%parameter), y, self%first, self%way, films)
      if (any([(model%inputs%bearings(b)%friction%model /= 'none', b=1, size(model%bearings))])) then
         equilibria%pivot = 'stuck'
      end if
      call find_hopf_point(equilibria, self%options, self%given%parameter, hopf, error)
      if (allocated(error)) return
      at_rest = 0
      at_rest(model%layout%positions()) = equilibria%positions
      if (has_warm_oil(model)) then
         call self%begin_oil(model, at_rest)
         self%ode%start = [at_rest, fine%oil%viscosity]
         self%ode%found = self%ode%start
      end if
      select type (cycles => self%orbits)
      type is (limit_cycle_type)
         call begin_at_hopf_point(cycles, self%ode, at_rest, model%scale, hopf%value, hopf%point%parameter, self%way, &
            & self%here, error)
      end select
      self%length = min(first_cycle, self%options%first_step)
      self%points = 0
   end subroutine begin_at_hopf

   !> Where `go_on` will lead to the place of a checkpoint.
   subroutine begin_anywhere(self, model)
      class(branch_progress_type), intent(inout), target :: self
      type(machine_model), intent(in) :: model
      real(wp) :: nowhere(model%n)
      type(orbit_type) :: orbit
      nowhere = 0
      if (self%of_orbits) then
         call orbit%set_mesh([0.0_wp, 1.0_wp], spread(spread(nowhere, 2, points), 3, 1))
         orbit%start = nowhere
         orbit%scale = model%scale
         if (has_warm_oil(model)) call self%begin_oil(model, nowhere)
         call self%begin_with_orbit(orbit, 1)
      else
         call self%begin_with_equilibrium(nowhere)
      end if
   end subroutine begin_anywhere

   !> Goes to the first point of the first branch.
   subroutine first_point(self, error)
      class(branch_progress_type), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error
      call start_branch(self%problem, self%options, self%options%high > self%first, self%here, error)
      call add_context(error, 'the first point of the branch')
      self%points = 1
   end subroutine first_point

   !> Takes the problem to where its branch had come; `ok` is false where there is no such point.
   subroutine go_on(self, ok)
      class(branch_progress_type), intent(inout) :: self
      logical, intent(out) :: ok
      type(error_type), allocatable :: refusal
      complex(wp), allocatable :: values(:)
      real(wp), allocatable :: growth(:)
      integer :: k
      ok = can_be_of(self%problem, self%here) .and. all([(can_be_of(self%problem, self%period_doublings(k)), k=1, &
         & size(self%period_doublings))])
      if (.not. ok) return
      call return_to(self%problem, self%here, refusal)
      ok = .not. allocated(refusal)
      if (ok) call self%problem%spectrum(values, growth, ok)
      if (ok) ok = size(growth) == size(self%here%growth)
   end subroutine go_on

   !> Goes from `here` to the next point, with the bifurcation points before it, at none of which the problem need stand
   !> then. Where the branch has ended `at_end` says why, else it is empty; `found` is false where it has ended without
   !> another point. An error of status `stopped` leaves all as it was.
   subroutine take_step(self, special, found, at_end, error)
      class(branch_progress_type), intent(inout) :: self
      type(bifurcation_type), allocatable, intent(out) :: special(:)
      logical, intent(out) :: found
      character(len=:), allocatable, intent(out) :: at_end
      type(error_type), allocatable, intent(out) :: error
      type(branch_point_type) :: next
      real(wp), allocatable :: split(:)
      real(wp) :: length
      logical :: ends
      allocate (special(0))
      found = .false.
      at_end = ''
      split = [real(wp) ::]
      if (self%branch > 1 .or. self%of_cycles) split = half_apart(self%orbits)
      length = self%length
      call advance(self%problem, self%options, self%here, length, next, ends, error)
      if (allocated(error)) then
         call find_oil_error()
         if (error%status == numerics_error .and. .not. self%problem%refused) call add_context(error, 'branch ' &
            & //to_text(self%branch)//' was lost behind '//self%given%parameter//' = ' &
            & //to_text(self%here%parameter)//', its point '//to_text(self%points))
         if (error%status == stopped .or. .not. self%problem%refused) return
         at_end = 'there is nothing beyond: '//error%message
         deallocate (error)
         return
      end if
      if (size(split) > 0 .and. self%points > 0) then
         if (dot_product(split, half_apart(self%orbits)) < 0) then
            at_end = 'it comes back to the branch that it left'
            if (self%of_cycles) at_end = 'it shrinks to an equilibrium, at a Hopf point'
            call forget_doublings()
            return
         end if
      end if
      ! where a branch of double period begins a multiplier is 1
      if (self%points > 0) call find_bifurcations(self%problem, self%options, self%here, next, special, &
         & error)
      if (allocated(error)) return
      call note_doublings()
      found = .true.
      self%here = next
      self%points = self%points + 1
      ! not before: a stop goes on from the point before, with its length
      self%length = length
      if (ends) at_end = trim(merge('the first value', 'the last value ', abs(next%parameter - self%first) <= 0))
      if (self%points >= self%given%max_points .and. .not. ends) at_end = 'after '//to_text(self%given%max_points) &
         & //' points (branch%max_points)'

   contains

      !> Keeps the period doublings among bifurcation points from which a branch is to be followed.
      subroutine note_doublings()
         integer :: k
         if (.not. self%given%switch .or. self%of_cycles .or. self%orbits%period_multiple >= self%longest_turns) return
         do k = 1, size(special)
            if (special(k)%kind == 'period_doubling') self%period_doublings = [self%period_doublings, &
               & special(k)%point]
         end do
      end subroutine note_doublings

      !> A branch of orbits that is lost where the equilibrium turns back from which its oil takes its viscosities has
      !> ended: near such an equilibrium nothing is smooth over the parameter.
      subroutine find_oil_error()
         type(error_type), allocatable :: lost
         if (self%problem%refused .or. error%status == stopped .or. .not. allocated(self%ode%oil)) return
         associate (here => self%here, step => self%options%first_step*self%orbits%unit)
            call self%ode%set(here%parameter + sign(step_beyond*step, here%tangent(size(here%tangent))), lost)
         end associate
         self%problem%refused = allocated(lost)
         if (allocated(lost)) call move_alloc(lost, error)
      end subroutine find_oil_error

      !> A branch of double period that ends at another period doubling between two points need not be followed from
      !> there again.
      subroutine forget_doublings()
         logical :: stays(size(self%period_doublings))
         real(wp) :: step
         integer :: k
         step = abs(next%parameter - self%here%parameter)
         do k = 1, size(stays)
            associate (one => self%period_doublings(k))
               stays(k) = abs(one%parameter - next%parameter) > 2*step &
                  & .or. 2*period_multiple_at(one) /= self%orbits%period_multiple
            end associate
         end do
         self%period_doublings = pack(self%period_doublings, stays)
      end subroutine forget_doublings
   end subroutine take_step

   !> Goes to the start of the next branch of double period, if there are `more`.
   subroutine begin_double(self, more)
      class(branch_progress_type), intent(inout) :: self
      logical, intent(out) :: more
      type(branch_point_type) :: period_doubling
      more = .false.
      do while (size(self%period_doublings) > 0 .and. .not. more)
         period_doubling = self%period_doublings(1)
         self%period_doublings = self%period_doublings(2:)
         call double_period(self%orbits, period_doubling, self%here, more)
      end do
      if (more) self%branch = self%branch + 1
      self%points = 0
      self%length = across*self%options%first_step
   end subroutine begin_double

   ! Branches of orbits of double period, which begin at a period doubling.

   !> From a period doubling of a problem: the point of the branch of double period there, on which the problem stands
   !> then. Its tangent is the disturbance that comes back with the opposite sign after a period.
   subroutine double_period(problem, period_doubling, point, ok)
      class(orbit_problem_type), intent(inout) :: problem
      type(branch_point_type), intent(in) :: period_doubling
      type(branch_point_type), intent(out) :: point
      logical, intent(out) :: ok
      type(orbit_type) :: twice
      real(wp) :: direction(problem%n), matrix(problem%n, problem%n)
      integer :: i, n
      call return_to(problem, period_doubling)
      direction = 1
      do i = 1, 3
         matrix = problem%orbit%monodromy
         do n = 1, problem%n
            matrix(n, n) = matrix(n, n) + 1
         end do
         call solve(problem%n, 1, matrix, direction, ok)
         if (.not. ok) return
         direction = direction/sqrt(sum(problem%weight*direction**2))
      end do
      n = problem%orbit%intervals()
      associate (orbit => problem%orbit, time => problem%orbit%time, switching_point => problem%orbit%switching_point)
         twice = orbit
         call twice%set_mesh([time, time(n) + time(1:)], reshape([orbit%at, orbit%at], [problem%n, points, 2*n]), &
            & [switching_point, switching_point(1:)])
      end associate
      problem%orbit = twice
      problem%period_multiple = 2*problem%period_multiple
      call problem%get_place(point%place)
      allocate (point%change(problem%n + 1), source=0.0_wp)
      point%tangent = [direction, 0.0_wp]
      point%parameter = period_doubling%parameter
      call return_to(problem, point)
      call problem%spectrum(point%values, point%growth, ok)
   end subroutine double_period

   !> By how much an orbit is elsewhere half a period later, in the measure of the branch: by nothing where it is that
   !> of half the period.
   pure function half_apart(problem)
      class(orbit_problem_type), intent(in) :: problem
      real(wp), allocatable :: half_apart(:)
      real(wp) :: y(problem%states())
      associate (orbit => problem%orbit)
         call orbit%state_at(0.5_wp*orbit%time(orbit%intervals()), y)
         half_apart = problem%weight(:size(y))*(y - orbit%start)/orbit%scale
      end associate
   end function half_apart
end module branch_progress
