!> The branches of a bearing over a number of its input: what is followed, how far it has come, and the next point.
module branch_progress
   use kinds, only: wp, i8, pi
   use text, only: to_text, filled
   use errors, only: error_type, raise, add_context, numerics_error, stopped
   use case_groups, only: branch_type, station_element_type
   use case_parameter, only: case_parameter_type, find_parameter
   use equations_of_motion, only: machine_model
   use film_network, only: warm_films_type
   use static_model, only: make_fine, make_static
   use march_settings, only: march_settings_of
   use orbit_polynomials, only: orbit_type, points
   use orbit_problem, only: orbit_problem_type, begin_orbits, period_multiple_at
   use limit_cycle, only: limit_cycle_type, begin_cycles
   use hopf_start, only: begin_at_hopf_point
   use doubled_orbit, only: double_period, half_apart
   use newton_method, only: branch_problem_type, branch_point_type, place_part_type, can_be_of, return_to
   use continuation, only: branch_options, start_branch, advance, bifurcation_type, find_bifurcations, find_first
   use bifurcation_curve, only: curve_type, begin_curve, go_to_point, follow_curve
   use varied_bearing, only: varied_bearing_type, bearing_orbits_type
   use linear_bearing, only: pivot_name
   use heat_balance_equations, only: has_warm_oil
   use equilibrium_branch, only: equilibrium_problem_type, begin_equilibria
   implicit none (type, external)
   private
   public :: branch_progress_type, needs_equilibrium, precise

   type :: branch_progress_type
      !> What the case asks for.
      type(branch_type) :: given
      type(case_parameter_type) :: parameter
      type(branch_options) :: options
      !> Value of the case, and the size of the way from there; on a curve 0 and 1.
      real(wp) :: first = 0, way = 0
      !> Either is followed; it is the problem. Orbits may be limit cycles.
      logical :: of_orbits = .true., of_cycles = .false.
      !> Whether limit cycles are followed from the Hopf point where they begin; else from where a march leads.
      logical :: at_hopf = .false.
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
      !> Where bifurcation points over two parameters are followed.
      type(curve_type), allocatable :: curve
   contains
      procedure :: prepare
      procedure :: begin_oil
      procedure :: begin_with_orbit
      procedure :: begin_with_equilibrium
      procedure :: begin_at_hopf
      procedure :: begin_anywhere
      procedure :: first_point
      procedure :: first_of_curve
      procedure :: values_at
      procedure :: place
      procedure :: stand_at
      procedure :: speed
      procedure, private :: bearing
      procedure, private :: seek
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
   !> Cycles are at rest whose displacements differ by less than this after half their period, in their mean square over
   !> the scales.
   real(wp), parameter :: shrunk = 1e-4_wp
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
         self%of_orbits = model%inputs%followed() /= 'equilibrium'
         self%of_cycles = model%inputs%followed() == 'limit_cycle'
         self%at_hopf = self%of_cycles .and. model%inputs%start%from == 'equilibrium' &
            & .and. .not. model%inputs%is_disturbed()
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
         if (given%of == 'curve') call prepare_curve()
      end associate
      self%given = model%inputs%branch
      self%longest_turns = longest_period*model%inputs%periodic%revolutions
      self%length = self%options%first_step
      allocate (self%period_doublings(0))
      if (self%of_orbits) then
         self%problem => self%orbits
         self%options%tolerance = model%inputs%periodic%tolerance
         self%ode%bearing = self%bearing(model)
         self%ode%model => model
         ! for meshes alone, wherever the branch leads
         self%ode%march = march_settings_of(model, steps)
      else
         self%problem => self%equilibria
         call make_fine(model, self%static)
      end if
   contains
      !> The branch on which a curve begins goes along one side of its plane.
      subroutine prepare_curve()
         allocate (self%curve)
         associate (curve => self%curve, given => model%inputs%branch)
            curve%kind = given%point
            if (self%of_cycles) curve%kind = 'fold'
            curve%of_multipliers = self%of_orbits
            curve%longest = merge(self%options%max_step, self%options%first_step, given%max_step > 0)
            curve%names = [character(len=max(len(given%parameter), len(given%second_parameter))) :: given%parameter, &
               & given%second_parameter]
            call find_parameter(model%inputs, given%second_parameter, curve%line%second, error)
            curve%line%first = [self%first, curve%line%second%value(model%inputs)]
            curve%line%last = [given%last, given%second_last]
         end associate
         self%first = 0
         self%way = 1
         self%options%low = 0
         self%options%high = 1
      end subroutine prepare_curve
   end subroutine prepare

   !> A model with what varies.
   function bearing(self, model)
      class(branch_progress_type), intent(in), target :: self
      type(machine_model), intent(in), target :: model
      type(varied_bearing_type) :: bearing
      bearing%model => model
      bearing%parameter = self%parameter
      if (allocated(self%curve)) bearing%line => self%curve%line
   end function bearing

   !> The values of the parameters at a point; the second is 0 where there is one.
   pure function values_at(self, point) result(values)
      class(branch_progress_type), intent(in) :: self
      type(branch_point_type), intent(in) :: point
      real(wp) :: values(2)
      values = [point%parameter, 0.0_wp]
      if (.not. allocated(self%curve)) return
      associate (line => self%curve%line)
         values = line%at(point%curve%origin + point%parameter*point%curve%line)
      end associate
   end function values_at

   !> Speed of the shaft where the problem stands, rad/s.
   pure real(wp) function speed(self)
      class(branch_progress_type), intent(in) :: self
      if (self%of_orbits) then
         speed = 2*pi/self%ode%period
      else
         speed = self%static%point%speed(0.0_wp)
      end if
   end function speed

   !> In words, with ten significant digits or those that suffice.
   function place(self, point, closely) result(text)
      class(branch_progress_type), intent(in) :: self
      type(branch_point_type), intent(in) :: point
      logical, intent(in), optional :: closely
      character(len=:), allocatable :: text
      real(wp) :: values(2)
      values = self%values_at(point)
      text = self%given%parameter//' = '//number(values(1))
      if (allocated(self%curve)) text = text//', '//self%given%second_parameter//' = '//number(values(2))
   contains
      function number(x)
         real(wp), intent(in) :: x
         character(len=:), allocatable :: number
         number = to_text(x)
         if (present(closely)) number = precise(x)
      end function number
   end function place

   !> Ten significant digits.
   function precise(x) result(digits)
      real(wp), intent(in) :: x
      character(len=:), allocatable :: digits
      character(len=24) :: buffer
      write (buffer, '(ss,g0.10)') x
      if (abs(x) > 0 .and. abs(x) < 0.1_wp) write (buffer, '(ss,es15.9)') x
      digits = trim(adjustl(buffer))
   end function precise

   !> Takes the problem to a point.
   subroutine stand_at(self, point, refusal)
      class(branch_progress_type), intent(inout) :: self
      type(branch_point_type), intent(in) :: point
      type(error_type), allocatable, intent(out), optional :: refusal
      if (allocated(self%curve)) then
         call go_to_point(self%curve, self%problem, point, refusal)
      else
         call return_to(self%problem, point, refusal)
      end if
   end subroutine stand_at

   !> Whether orbits need the equilibrium at a value of the parameter: for the viscosities of warm oil, and for elements
   !> that act in motion alone.
   pure logical function needs_equilibrium(model)
      type(machine_model), intent(in) :: model
      type(station_element_type), allocatable :: elements(:)
      elements = model%inputs%station_elements()
      needs_equilibrium = has_warm_oil(model) .or. .not. all(elements%static)
   end function needs_equilibrium

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
      self%ode%oil%bearing = self%bearing(self%static)
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
      call begin_equilibria(self%equilibria, self%bearing(self%static), y, self%first, self%way, films)
      if (self%given%point == 'hopf') self%equilibria%pivot = at_rest(self%static)
   end subroutine begin_with_equilibrium

   !> How pivots behave in small vibrations about a place of rest.
   pure function at_rest(model) result(pivot)
      type(machine_model), intent(in) :: model
      character(len=pivot_name) :: pivot
      integer :: b
      pivot = merge('stuck', 'free ', any([(model%inputs%bearings(b)%friction%model /= 'none', b=1, &
         & size(model%bearings))]))
   end function at_rest

   !> With the limit cycles that begin at the first Hopf point of the equilibria. `fine`, a static model, is in
   !> equilibrium in y, with these temperatures along and across its films, if it has any.
   subroutine begin_at_hopf(self, model, fine, y, films, hopf, error, before)
      class(branch_progress_type), intent(inout), target :: self
      type(machine_model), intent(in) :: model
      type(machine_model), intent(in), target :: fine
      real(wp), intent(in) :: y(:)
      type(warm_films_type), allocatable, intent(in) :: films(:)
      type(bifurcation_type), intent(out) :: hopf
      type(error_type), allocatable, intent(out) :: error
      !> An equilibrium before that point, where it is known already; else they are followed from y.
      type(place_part_type), intent(in), optional :: before(:)
      type(equilibrium_problem_type) :: equilibria
      type(branch_point_type) :: here
      real(wp) :: rest(model%n)
      call begin_equilibria(equilibria, self%bearing(fine), y, self%first, self%way, films)
      if (present(before)) call equilibria%go_to(before)
      equilibria%pivot = at_rest(model)
      call start_branch(equilibria, self%options, self%options%high > self%first, here, error)
      call add_context(error, 'the first equilibrium')
      if (.not. allocated(error)) call self%seek(equilibria, 'hopf', here, hopf, error)
      if (allocated(error)) return
      rest = 0
      rest(model%layout%positions()) = equilibria%positions
      if (needs_equilibrium(model)) then
         call self%begin_oil(model, rest)
         self%ode%start = [rest, fine%oil%viscosity]
         self%ode%found = self%ode%start
      end if
      select type (cycles => self%orbits)
      type is (limit_cycle_type)
         call begin_at_hopf_point(cycles, self%ode, rest, model%scale, hopf%value, hopf%point%parameter, self%way, &
            & self%here, error)
      end select
      self%length = min(first_cycle, self%options%first_step)
      self%points = 0
   end subroutine begin_at_hopf

   !> Follows a problem's branch from a point to the first bifurcation point of a kind. An error where there is none up
   !> to the bound of the parameter says what comes closest to the border of stability there.
   subroutine seek(self, problem, kind, here, found, error)
      class(branch_progress_type), intent(in) :: self
      class(branch_problem_type), intent(inout) :: problem
      character(len=*), intent(in) :: kind
      type(branch_point_type), intent(inout) :: here
      type(bifurcation_type), intent(out) :: found
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: none, start, leading
      real(wp) :: length
      start = self%place(here)
      length = self%length
      call find_first(problem, self%options, kind, here, length, found, error)
      select case (kind)
      case ('hopf')
         none = 'Hopf point'
      case ('neimark_sacker')
         none = 'Neimark-Sacker point'
      case ('period_doubling')
         none = 'period doubling'
      case default
         none = kind
      end select
      if (allocated(error)) then
         if (error%status /= stopped) call add_context(error, 'no '//none//' up to '//self%place(here))
      else if (found%kind == '') then
         select type (problem)
         type is (equilibrium_problem_type)
            none = 'the equilibria have no '//none
            leading = 'eigenvalue is '//filled('{} 1/s at {} Hz', [here%values(1)%re, abs(here%values(1)%im)/(2*pi)])
         class default
            none = trim(merge('the limit cycles have no', 'the orbits have no      ', self%of_cycles))//' '//none
            leading = 'multiplier is '//filled('{} + {} i', [here%values(1)%re, abs(here%values(1)%im)])
         end select
         call raise(error, numerics_error, none//' from '//start//' to '//self%place(here)//': there the leading ' &
            & //leading//'; try another branch%last, or another first value')
      end if
   end subroutine seek

   !> Goes on from the first point of a branch to that of a curve.
   subroutine first_of_curve(self, error)
      class(branch_progress_type), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error
      type(branch_point_type) :: here
      type(bifurcation_type) :: found
      here = self%here
      call self%seek(self%problem, trim(self%curve%kind), here, found, error)
      if (allocated(error)) return
      call begin_curve(self%curve, self%problem, self%options, found, self%here, error)
      call add_context(error, 'the first point of the curve')
      self%points = 1
      self%length = self%curve%longest
   end subroutine first_of_curve

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
         if (needs_equilibrium(model)) call self%begin_oil(model, nowhere)
         call self%begin_with_orbit(orbit, 1)
      else
         call self%begin_with_equilibrium(nowhere)
      end if
   end subroutine begin_anywhere

   !> Goes to the first point of the first branch.
   subroutine first_point(self, error)
      class(branch_progress_type), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: marched(:)
      if (self%of_cycles) marched = half_apart(self%orbits)
      call start_branch(self%problem, self%options, self%options%high > self%first, self%here, error)
      if (self%of_cycles .and. .not. allocated(error)) then
         if (dot_product(marched, half_apart(self%orbits)) < 0.5_wp*sum(marched**2)) call raise(error, &
            & numerics_error, 'the march has not come to a limit cycle yet; begin at the end of a longer one ' &
            & //'(start%from = ''file'')')
      end if
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
      call self%stand_at(self%here, refusal)
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
      found = .false.
      at_end = ''
      length = self%length
      if (allocated(self%curve)) then
         call follow_curve(self%curve, self%problem, self%options, self%here, length, next, special, at_end, error)
         call add_context(error, 'the curve was lost behind '//self%place(self%here)//', point '//to_text(self%points))
         if (.not. allocated(error)) call accept()
         return
      end if
      allocate (special(0))
      split = [real(wp) ::]
      if (self%branch > 1 .or. self%of_cycles) split = half_apart(self%orbits)
      call advance(self%problem, self%options, self%here, length, next, ends, error)
      if (allocated(error)) then
         call find_oil_error()
         if (error%status == numerics_error .and. .not. self%problem%refused) call add_context(error, 'branch ' &
            & //to_text(self%branch)//' was lost behind '//self%place(self%here)//', its point ' &
            & //to_text(self%points))
         if (error%status == stopped .or. .not. self%problem%refused) return
         at_end = 'the branch ends here: '//error%message
         deallocate (error)
         return
      end if
      if (size(split) > 0 .and. self%points > 0) then
         if (dot_product(split, half_apart(self%orbits)) < 0 .or. self%branch == 1 &
            & .and. norm2(half_apart(self%orbits)) < shrunk*sqrt(maxval(self%orbits%weight))) then
            at_end = 'it comes back to the branch that it left'
            if (self%branch == 1) at_end = 'it shrinks to an equilibrium, at a Hopf point'
            call forget_doublings()
            return
         end if
      end if
      ! where a branch of double period begins a multiplier is 1
      if (self%points > 0) call find_bifurcations(self%problem, self%options, self%here, next, special, error)
      if (allocated(error)) return
      call note_doublings()
      if (ends) at_end = trim(merge('the first value', 'the last value ', abs(next%parameter - self%first) <= 0))
      call accept()

   contains

      subroutine accept()
         found = .true.
         self%here = next
         self%points = self%points + 1
         ! not before: a stop goes on from the point before, with its length
         self%length = length
         if (self%points >= self%given%max_points .and. at_end == '') at_end = 'after ' &
            & //to_text(self%given%max_points)//' points (branch%max_points)'
      end subroutine accept

      !> Keeps the period doublings among bifurcation points from which a branch is to be followed.
      subroutine note_doublings()
         integer :: k
         if (.not. self%given%switch .or. self%orbits%period_multiple >= self%longest_turns) return
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
      if (self%of_cycles) self%length = min(first_cycle, self%length)
   end subroutine begin_double
end module branch_progress
