!> Branches of problems that are known: an algebraic fold, orbits that double their period or leave for a torus at a
!> known value, and Duffing's oscillator, whose folds were found by harmonic balance and whose doublings by shooting.
module branch_problems
   use kinds, only: wp, pi
   use errors, only: error_type, raise, input_error
   use small_ode, only: small_ode_type
   use newton_method, only: branch_problem_type, place_part_type
   use orbit_problem, only: parametric_ode_type
   implicit none (type, external)
   private
   public :: far_away, parabola, turning_frame, duffing, oscillator_orbits

   !> x' = p - x**2 at rest: a fold at p = 0; values of p below `least` are refused. Where x = -1 it leaps by 2 `leap`:
   !> there is no equilibrium for p within `leap` of 1 on this side.
   type, extends(branch_problem_type) :: parabola
      real(wp) :: x = 1, least = -1, leap = 0
   contains
      procedure :: linearize => parabola_equations
      procedure :: move => move_parabola
      procedure :: spectrum => parabola_spectrum
      procedure :: kind => parabola_kind
      procedure :: get_place => parabola_place
      procedure :: go_to => put_parabola
   end type parabola

   !> Corrections that begin with a thousand and fall by a fifth each, of which half a unit is made.
   type, extends(parabola) :: far_away
      integer :: asked = 0
   contains
      procedure :: linearize => far_equations
      procedure :: move => move_nearer
   end type far_away

   !> y = R(t/2) w or y = w: half a turn of the frame in the period 2 pi, or none. In the frame w_1' = p w_1 - w_1**3
   !> and w_2' = -w_2 (half a turn), or w_1 + i w_2 = z with z' = (p + i/sqrt(5)) z - |z|**2 z (none).
   type, extends(small_ode_type) :: turning_frame
      real(wp) :: p = 0
      logical :: half_turn = .true.
   contains
      procedure :: rates => frame_rates
      procedure :: jacobian => frame_jacobian
      procedure :: frame => frame_at
   end type turning_frame

   !> x'' + damping x' + spring x + x**3 = force cos(frequency t); the parameter is the frequency or the force.
   type, extends(small_ode_type) :: duffing
      real(wp) :: damping = 0.1_wp, spring = 1, force = 0.2_wp, frequency = 1
      logical :: varies_force = .false.
   contains
      procedure :: rates => duffing_rates
      procedure :: jacobian => duffing_jacobian
      procedure :: pairs => duffing_pairs
   end type duffing

   !> Either of them as the model.
   type, extends(parametric_ode_type) :: oscillator_orbits
   contains
      procedure :: set
   end type oscillator_orbits

   real(wp), parameter :: spin = 1/sqrt(5.0_wp)
   real(wp), parameter :: half_spin(2, 2) = reshape([0.0_wp, 0.5_wp, -0.5_wp, 0.0_wp], [2, 2])

contains

   subroutine parabola_equations(self, matrix, b, error)
      class(parabola), intent(inout) :: self
      real(wp), intent(out) :: matrix(:, :), b(:)
      type(error_type), allocatable, intent(out) :: error
      matrix(1, :) = [-2*self%x, self%unit]
      b = self%x**2 - self%parameter - sign(self%leap, self%x + 1)
      self%refused = self%parameter < self%least
      if (self%refused) call raise(error, input_error, 'too small')
   end subroutine parabola_equations

   subroutine far_equations(self, matrix, b, error)
      class(far_away), intent(inout) :: self
      real(wp), intent(out) :: matrix(:, :), b(:)
      type(error_type), allocatable, intent(out) :: error
      matrix = 1
      b = 1000*0.8_wp**self%asked
      self%asked = self%asked + 1
   end subroutine far_equations

   subroutine move_nearer(self, change, closes)
      class(far_away), intent(inout) :: self
      real(wp), intent(in) :: change(:)
      logical, intent(in) :: closes
      self%x = self%x + min(0.5_wp, change(1))
      self%correction = maxval(abs(change))
   end subroutine move_nearer

   subroutine move_parabola(self, change, closes)
      class(parabola), intent(inout) :: self
      real(wp), intent(in) :: change(:)
      logical, intent(in) :: closes
      self%x = self%x + change(1)
      self%parameter = self%parameter + self%unit*change(2)
      self%correction = maxval(abs(change))
   end subroutine move_parabola

   subroutine parabola_spectrum(self, values, growth, ok)
      class(parabola), intent(inout) :: self
      complex(wp), allocatable, intent(out) :: values(:)
      real(wp), allocatable, intent(out) :: growth(:)
      logical, intent(out) :: ok
      growth = [-2*self%x]
      values = cmplx(growth, 0.0_wp, wp)
      ok = .true.
   end subroutine parabola_spectrum

   pure function parabola_kind(self, value) result(kind)
      class(parabola), intent(in) :: self
      complex(wp), intent(in) :: value
      character(len=:), allocatable :: kind
      kind = 'fold'
   end function parabola_kind

   pure subroutine parabola_place(self, place)
      class(parabola), intent(in) :: self
      type(place_part_type), allocatable, intent(out) :: place(:)
      place = [place_part_type('parameter'), place_part_type('x')]
      place(1)%values = [self%parameter]
      place(2)%values = [self%x]
   end subroutine parabola_place

   subroutine put_parabola(self, place)
      class(parabola), intent(inout) :: self
      type(place_part_type), intent(in) :: place(:)
      self%parameter = place(1)%values(1)
      self%x = place(2)%values(1)
   end subroutine put_parabola

   !> Columns of the frame.
   pure function frame_at(self, t) result(turn)
      class(turning_frame), intent(in) :: self
      real(wp), intent(in) :: t
      real(wp) :: turn(2, 2)
      turn = reshape([1, 0, 0, 1], [2, 2])
      if (self%half_turn) turn = reshape([cos(t/2), sin(t/2), -sin(t/2), cos(t/2)], [2, 2])
   end function frame_at

   !> Rates in the frame, turned back.
   pure function frame_rates(self, t, y) result(rates)
      class(turning_frame), intent(in) :: self
      real(wp), intent(in) :: t, y(:)
      real(wp) :: rates(size(y))
      if (self%half_turn) then
         associate (w => matmul(transpose(self%frame(t)), y))
            rates = matmul(self%frame(t), [self%p*w(1) - w(1)**3, -w(2)]) + matmul(half_spin, y)
         end associate
      else
         associate (square => y(1)**2 + y(2)**2)
            rates = [(self%p - square)*y(1) - spin*y(2), (self%p - square)*y(2) + spin*y(1)]
         end associate
      end if
   end function frame_rates

   pure function frame_jacobian(self, t, y) result(matrix)
      class(turning_frame), intent(in) :: self
      real(wp), intent(in) :: t, y(:)
      real(wp) :: matrix(size(y), size(y))
      if (self%half_turn) then
         associate (turn => self%frame(t), w => matmul(transpose(self%frame(t)), y))
            matrix = reshape([self%p - 3*w(1)**2, 0.0_wp, 0.0_wp, -1.0_wp], [2, 2])
            matrix = matmul(turn, matmul(matrix, transpose(turn))) + half_spin
         end associate
      else
         associate (square => y(1)**2 + y(2)**2)
            matrix = reshape([self%p - square - 2*y(1)**2, spin - 2*y(1)*y(2), -spin - 2*y(1)*y(2), &
               & self%p - square - 2*y(2)**2], [2, 2])
         end associate
      end if
   end function frame_jacobian

   pure function duffing_rates(self, t, y) result(rates)
      class(duffing), intent(in) :: self
      real(wp), intent(in) :: t, y(:)
      real(wp) :: rates(size(y))
      rates = [y(2), self%force*cos(self%frequency*t) - self%damping*y(2) - self%spring*y(1) - y(1)**3]
   end function duffing_rates

   pure function duffing_jacobian(self, t, y) result(matrix)
      class(duffing), intent(in) :: self
      real(wp), intent(in) :: t, y(:)
      real(wp) :: matrix(size(y), size(y))
      matrix(1, :) = [0.0_wp, 1.0_wp]
      matrix(2, :) = [-self%spring - 3*y(1)**2, -self%damping]
   end function duffing_jacobian

   pure subroutine duffing_pairs(self, x, v)
      class(duffing), intent(in) :: self
      integer, allocatable, intent(out) :: x(:), v(:)
      x = [1]
      v = [2]
   end subroutine duffing_pairs

   subroutine set(self, parameter, error)
      class(oscillator_orbits), intent(inout) :: self
      real(wp), intent(in) :: parameter
      type(error_type), allocatable, intent(out) :: error
      self%period = 2*pi
      select type (model => self%model)
      type is (turning_frame)
         model%p = parameter
      type is (duffing)
         if (model%varies_force) then
            model%force = parameter
         else
            model%frequency = parameter
         end if
         self%period = 2*pi/model%frequency
      end select
   end subroutine set
end module branch_problems

program test_continuation
   use kinds, only: wp, pi
   use errors, only: error_type, numerics_error
   use newton_method, only: branch_problem_type, branch_point_type, newton_options, correct, return_to
   use continuation, only: branch_options, start_branch, advance, bifurcation_type, find_bifurcations
   use orbit_polynomials, only: orbit_type
   use constant_orbit, only: at_rest
   use orbit_problem, only: orbit_problem_type, begin_orbits
   use doubled_orbit, only: double_period
   use branch_problems, only: far_away, parabola, turning_frame, duffing, oscillator_orbits
   use check, only: runs, expect, expect_close, expect_error, expect_no_error, report
   implicit none (type, external)

   if (runs('fold')) call fold()
   if (runs('leap')) call leap()
   if (runs('hopeless')) call hopeless()
   if (runs('refused')) call refused()
   if (runs('return')) call return()
   if (runs('period_doubling')) call period_doubling()
   if (runs('torus')) call torus()
   if (runs('duffing')) call duffing_folds()
   if (runs('cascade')) call cascade()
   call report()

contains

   !> Follows a branch to its end; the bifurcation points on the way.
   subroutine follow(problem, options, here, special)
      class(branch_problem_type), intent(inout) :: problem
      type(branch_options), intent(in) :: options
      type(branch_point_type), intent(inout) :: here
      type(bifurcation_type), allocatable, intent(out) :: special(:)
      type(bifurcation_type), allocatable :: found(:)
      type(branch_point_type) :: next
      type(error_type), allocatable :: error
      real(wp) :: length
      integer :: count
      logical :: ends
      length = options%first_step
      allocate (special(0))
      do count = 1, 1000
         call advance(problem, options, here, length, next, ends, error)
         call expect_no_error(error, 'a step')
         if (allocated(error)) return
         call find_bifurcations(problem, options, here, next, found, error)
         special = [special, found]
         here = next
         if (ends) return
      end do
   end subroutine follow

   !> From p = 1 on x = sqrt(p) through the fold at 0 and back on x = -sqrt(p).
   subroutine fold()
      type(parabola) :: problem
      type(branch_point_type) :: here
      type(bifurcation_type), allocatable :: special(:)
      type(branch_options) :: options
      options = branch_options(low=-1.0_wp, high=1.0_wp, tolerance=1e-10_wp)
      call begin_parabola(problem, options, here)
      call follow(problem, options, here, special)
      call expect_close(here%parameter, 1.0_wp, 0.0_wp, 'the end is at the bound')
      call expect_close(problem%x, -1.0_wp, 1e-9_wp, 'on the other side')
      call expect(size(special) == 1, 'one bifurcation point')
      call expect(special(1)%kind == 'fold' .and. special(1)%destabilises, 'a fold, to the unstable side')
      call expect_close(special(1)%point%parameter, 0.0_wp, 1e-12_wp, 'at 0')
      ! int_-1^1 sqrt(1 + 4 x**2) dx, of whose arc the tangents cut little
      call expect_close(here%arc_length, sqrt(5.0_wp) + 0.5_wp*asinh(2.0_wp), 2e-2_wp, 'length of the branch')
      call expect(here%growth(1) > 0, 'and it ends unstable')
   end subroutine fold

   !> What the iterations that are left cannot reach is given up, though it falls; where they may, it is not.
   subroutine hopeless()
      type(far_away) :: problem
      type(branch_point_type) :: point
      type(error_type), allocatable :: error
      problem%n = 1
      problem%weight = [1.0_wp]
      call correct(problem, newton_options(1e-8_wp, 30), point, error)
      call expect_error(error, numerics_error, 'its correction is still 512 of the characteristic scale of the ' &
         & //'states after 4 iterations', 'a correction that is far away')
      problem%asked = 0
      call correct(problem, newton_options(1e-8_wp, 2000), point, error)
      call expect_no_error(error, 'a correction that falls')
   end subroutine hopeless

   !> The same where the equations leap at the bound: the branch is not lost there.
   subroutine leap()
      type(parabola) :: problem
      type(branch_point_type) :: here
      type(bifurcation_type), allocatable :: special(:)
      type(branch_options) :: options
      options = branch_options(low=-1.0_wp, high=1.0_wp, tolerance=1e-10_wp)
      problem%leap = 1e-7_wp
      call begin_parabola(problem, options, here)
      call follow(problem, options, here, special)
      call expect(here%parameter < 1, 'the end is before the leap')
      call expect_close(here%parameter, 1.0_wp, 1e-4_wp*options%first_step, 'and within a shortest step of the bound')
      call expect(problem%x < 0, 'on the other side')
   end subroutine leap

   !> At p = 1 on the stable side.
   subroutine begin_parabola(problem, options, here)
      type(parabola), intent(inout) :: problem
      type(branch_options), intent(in) :: options
      type(branch_point_type), intent(out) :: here
      type(error_type), allocatable :: error
      problem%n = 1
      problem%weight = [1.0_wp]
      problem%parameter = 1
      call start_branch(problem, options, .false., here, error)
      call expect_no_error(error, 'the start')
   end subroutine begin_parabola

   !> Where the problem refuses a value the branch comes close to it, and the error says so.
   subroutine refused()
      type(parabola) :: problem
      type(branch_point_type) :: here, next
      type(error_type), allocatable :: error
      type(branch_options) :: options
      real(wp) :: length
      logical :: ends
      problem%least = 0.5_wp
      options = branch_options(low=-1.0_wp, high=1.0_wp)
      call begin_parabola(problem, options, here)
      length = options%first_step
      do while (.not. allocated(error))
         call advance(problem, options, here, length, next, ends, error)
         if (.not. allocated(error)) here = next
      end do
      call expect(problem%refused, 'refused')
      call expect_close(here%parameter, 0.5_wp, 1e-5_wp, 'as close as the shortest step')
   end subroutine refused

   !> A point is found again to the last bit, and so is what follows it.
   subroutine return()
      type(turning_frame), target :: model
      type(oscillator_orbits), target :: ode
      type(orbit_problem_type) :: problem
      type(branch_point_type) :: here, first, second, ignored
      type(error_type), allocatable :: error
      type(branch_options) :: options
      real(wp) :: length
      integer :: k
      logical :: ends
      call begin_frame(model, ode, .true., problem, options)
      call start_branch(problem, options, .true., here, error)
      length = options%first_step
      call advance(problem, options, here, length, first, ends, error)
      length = options%first_step
      call advance(problem, options, first, length, ignored, ends, error)
      call return_to(problem, here)
      length = options%first_step
      call advance(problem, options, here, length, second, ends, error)
      call expect_no_error(error, 'steps')
      do k = 1, size(first%place)
         call expect(.not. any(abs(first%place(k)%values - second%place(k)%values) > 0), 'the same place')
      end do
      call expect(.not. any(abs(first%tangent - second%tangent) > 0), 'the same tangent')
   end subroutine return

   !> Constant orbits of the model with a frame, from p = -0.5 to 0.5.
   subroutine begin_frame(model, ode, half_turn, problem, options)
      type(turning_frame), intent(inout), target :: model
      type(oscillator_orbits), intent(inout), target :: ode
      logical, intent(in) :: half_turn
      type(orbit_problem_type), intent(out) :: problem
      type(branch_options), intent(out) :: options
      model%n = 2
      model%half_turn = half_turn
      ode%model => model
      call begin_orbits(problem, ode, at_rest(2, 20, 2*pi), 1, -0.5_wp, 1.0_wp)
      options = branch_options(first_step=0.05_wp, max_step=0.1_wp, low=-0.5_wp, high=0.5_wp)
   end subroutine begin_frame

   !> The rest at w = 0 has the multipliers -exp(2 pi p) and -exp(-2 pi): a period doubling at p = 0. The orbits of
   !> double period are w_1 = +-sqrt(p) with the multipliers exp(-8 pi p) and exp(-4 pi). Radau's error on 20 intervals
   !> is of (2 pi/20/2)^5/7200 = 1e-8.
   subroutine period_doubling()
      type(turning_frame), target :: model
      type(oscillator_orbits), target :: ode
      type(orbit_problem_type) :: problem
      type(branch_point_type) :: here
      type(bifurcation_type), allocatable :: special(:), others(:)
      type(error_type), allocatable :: error
      type(branch_options) :: options
      logical :: ok
      call begin_frame(model, ode, .true., problem, options)
      call start_branch(problem, options, .true., here, error)
      call expect_close(here%values(1)%re, -exp(-pi), 1e-7_wp, 'leading multiplier at the start')
      call follow(problem, options, here, special)
      call expect_close(here%values(1)%re, -exp(pi), 1e-4_wp, 'leading multiplier at the end')
      call expect(size(special) == 1, 'one bifurcation point')
      call expect(special(1)%kind == 'period_doubling' .and. special(1)%destabilises, 'a period doubling')
      call expect_close(special(1)%point%parameter, 0.0_wp, 1e-7_wp, 'at 0')
      call double_period(problem, special(1)%point, here, ok)
      call expect(ok, 'the doubled orbit')
      call expect_close(here%values(1)%re, 1.0_wp, 1e-5_wp, 'its multiplier there is 1')
      here%growth(1) = -1
      call follow(problem, options, here, others)
      call expect(size(others) == 0, 'nothing happens on the branch of double period')
      call expect_close(here%parameter, 0.5_wp, 0.0_wp, 'it leads up')
      call expect_close(norm2(problem%orbit%start), sqrt(0.5_wp), 1e-6_wp, 'its size')
      call expect_close(here%values(1)%re, exp(-4*pi), 1e-6_wp, 'its leading multiplier')
      call expect_close(problem%period(), 4*pi, 1e-12_wp, 'its period')
   end subroutine period_doubling

   !> Rest has the multipliers exp(2 pi (p +- i/sqrt(5))): a torus begins at p = 0.
   subroutine torus()
      type(turning_frame), target :: model
      type(oscillator_orbits), target :: ode
      type(orbit_problem_type) :: problem
      type(branch_point_type) :: here
      type(bifurcation_type), allocatable :: special(:)
      type(error_type), allocatable :: error
      type(branch_options) :: options
      call begin_frame(model, ode, .false., problem, options)
      call start_branch(problem, options, .true., here, error)
      call follow(problem, options, here, special)
      call expect(size(special) == 1, 'one bifurcation point')
      call expect(special(1)%kind == 'neimark_sacker', 'a torus bifurcation')
      call expect_close(special(1)%point%parameter, 0.0_wp, 1e-7_wp, 'at 0')
      call expect_close(special(1)%value%re, cos(2*pi/sqrt(5.0_wp)), 1e-7_wp, 'its multiplier')
   end subroutine torus

   !> The frequencies of both folds, by harmonic balance with 15 harmonics in Python, the upper one to 1e-7. The
   !> error of 40 intervals is of (3 omega h)^5/7200 for the third harmonic, h = 2 pi/40/omega: 3e-6, and as much of the
   !> frequency; with 80 intervals a 32nd of that.
   subroutine duffing_folds()
      type(duffing), target :: model
      type(oscillator_orbits), target :: ode
      type(orbit_problem_type) :: problem
      type(branch_point_type) :: here
      type(bifurcation_type), allocatable :: special(:)
      type(error_type), allocatable :: error
      type(branch_options) :: options
      real(wp), parameter :: upper = 1.52244802_wp, lower = 1.252014959_wp
      model%n = 2
      ode%model => model
      call begin_orbits(problem, ode, at_rest(2, 80, 2*pi/0.6_wp), 1, 0.6_wp, 1.9_wp)
      options = branch_options(first_step=0.02_wp, max_step=0.05_wp, low=0.6_wp, high=2.5_wp)
      call start_branch(problem, options, .true., here, error)
      call expect_no_error(error, 'the start')
      call follow(problem, options, here, special)
      call expect_close(here%parameter, 2.5_wp, 0.0_wp, 'the branch goes on behind both folds')
      call expect(size(special) == 2, 'two bifurcation points')
      call expect(all(special%kind == 'fold'), 'folds')
      call expect_close(special(1)%point%parameter, upper, 1e-6_wp, 'the upper one')
      call expect_close(special(2)%point%parameter, lower, 1e-6_wp, 'the lower one')
      call expect(all(here%growth < 0), 'it ends stable')
   end subroutine duffing_folds

   !> Two wells, x'' + 0.3 x' - x + x**3 = p cos(1.2 t): the orbit in one of them doubles its period, and the doubled
   !> one again, at values by shooting in Python (DOP853, 1e-12). The error of 60 intervals is of (3 omega h)^5/7200 for
   !> the third harmonic, 3e-7.
   subroutine cascade()
      type(duffing), target :: model
      type(oscillator_orbits), target :: ode
      type(orbit_problem_type) :: problem
      type(orbit_type) :: well
      type(branch_point_type) :: here, period_doubling
      type(bifurcation_type), allocatable :: special(:)
      type(error_type), allocatable :: error
      type(branch_options) :: options
      real(wp), parameter :: doublings(2) = [0.2655817860556_wp, 0.2866931578237_wp]
      real(wp) :: half(2)
      integer :: k
      logical :: ok
      model = duffing(n=2, damping=0.3_wp, spring=-1.0_wp, frequency=1.2_wp, varies_force=.true.)
      ode%model => model
      well = at_rest(2, 60, 2*pi/1.2_wp)
      well%start(1) = 1
      well%at(1, :, :) = 1
      call begin_orbits(problem, ode, well, 1, 0.01_wp, 0.3_wp)
      options = branch_options(first_step=0.02_wp, max_step=0.05_wp, low=0.01_wp, high=0.288_wp)
      call start_branch(problem, options, .true., here, error)
      call expect_no_error(error, 'the start')
      do k = 1, 2
         call follow(problem, options, here, special)
         special = pack(special, special%kind == 'period_doubling')
         call expect(size(special) == 1, 'one doubling')
         if (size(special) /= 1) return
         period_doubling = special(1)%point
         call expect_close(period_doubling%parameter, doublings(k), 2e-6_wp, 'where it doubles')
         call double_period(problem, period_doubling, here, ok)
         call expect(ok, 'the doubled orbit')
         here%growth(1) = -1
      end do
      call follow(problem, options, here, special)
      call expect(size(special) == 0, 'it stays doubled twice')
      call expect_close(problem%period(), 8*pi/1.2_wp, 1e-12_wp, 'its period')
      call problem%orbit%state_at(0.5_wp*problem%period(), half)
      call expect(norm2(half - problem%orbit%start) > 1e-3_wp, 'it is none of half the period')
      call expect(all(here%growth < 0), 'it is stable')
   end subroutine cascade
end program test_continuation
