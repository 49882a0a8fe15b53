!> Collocation of periodic orbits on problems with known orbits and multipliers: linear ones (an oscillator with a stiff
!> state beside it; oscillators that know one another by one), Van der Pol's oscillator, forced at its own period, and
!> one with a spring that is stiffer on one side.
module orbit_problems
   use kinds, only: wp
   use small_ode, only: small_ode_type
   implicit none (type, external)
   private
   public :: linear_problem, van_der_pol, bent_problem

   !> y' = joined y + force cos t.
   type, extends(small_ode_type) :: linear_problem
      real(wp), allocatable :: joined(:, :), force(:)
      !> Which states it says are displacements, and which are their rates.
      integer, allocatable :: x(:), v(:)
      !> How many blocks it says that there are, and their size.
      integer :: in_blocks = 0, of_block = 0
   contains
      procedure :: rates => linear_rates
      procedure :: jacobian => linear_jacobian
      procedure :: pairs => linear_pairs
      procedure :: blocks => linear_blocks
   end type linear_problem

   !> x'' - mu (1 - x^2) x' + x = 0.
   type, extends(small_ode_type) :: van_der_pol
      real(wp) :: mu = 1
   contains
      procedure :: rates => van_der_pol_rates
      procedure :: jacobian => van_der_pol_jacobian
   end type van_der_pol

   !> x'' + 2 d x' + x + a max(x - b, 0) = cos t.
   type, extends(small_ode_type) :: bent_problem
      real(wp) :: damping = 0.1_wp, more = 0.5_wp, bend = 0.3_wp
      !> Whether it says where its spring changes.
      logical :: told = .true.
   contains
      procedure :: rates => bent_rates
      procedure :: jacobian => bent_jacobian
      procedure :: switching_points => bend_of_spring
      procedure :: df_dt => turn_of_force
   end type bent_problem

contains

   pure function linear_rates(self, t, y) result(rates)
      class(linear_problem), intent(in) :: self
      real(wp), intent(in) :: t, y(:)
      real(wp) :: rates(size(y))
      rates = matmul(self%joined, y) + self%force*cos(t)
   end function linear_rates

   pure function linear_jacobian(self, t, y) result(matrix)
      class(linear_problem), intent(in) :: self
      real(wp), intent(in) :: t, y(:)
      real(wp) :: matrix(size(y), size(y))
      matrix = self%joined
   end function linear_jacobian

   pure subroutine linear_pairs(self, x, v)
      class(linear_problem), intent(in) :: self
      integer, allocatable, intent(out) :: x(:), v(:)
      x = self%x
      v = self%v
   end subroutine linear_pairs

   pure subroutine linear_blocks(self, number, states)
      class(linear_problem), intent(in) :: self
      integer, intent(out) :: number, states
      number = self%in_blocks
      states = self%of_block
   end subroutine linear_blocks

   pure function van_der_pol_rates(self, t, y) result(rates)
      class(van_der_pol), intent(in) :: self
      real(wp), intent(in) :: t, y(:)
      real(wp) :: rates(size(y))
      rates = [y(2), self%mu*(1 - y(1)**2)*y(2) - y(1)]
   end function van_der_pol_rates

   pure function van_der_pol_jacobian(self, t, y) result(matrix)
      class(van_der_pol), intent(in) :: self
      real(wp), intent(in) :: t, y(:)
      real(wp) :: matrix(size(y), size(y))
      matrix(1, :) = [0.0_wp, 1.0_wp]
      matrix(2, :) = [-2*self%mu*y(1)*y(2) - 1, self%mu*(1 - y(1)**2)]
   end function van_der_pol_jacobian

   pure function bent_rates(self, t, y) result(rates)
      class(bent_problem), intent(in) :: self
      real(wp), intent(in) :: t, y(:)
      real(wp) :: rates(size(y))
      rates = [y(2), cos(t) - y(1) - self%more*max(y(1) - self%bend, 0.0_wp) - 2*self%damping*y(2)]
   end function bent_rates

   pure function bent_jacobian(self, t, y) result(matrix)
      class(bent_problem), intent(in) :: self
      real(wp), intent(in) :: t, y(:)
      real(wp) :: matrix(size(y), size(y))
      matrix(1, :) = [0.0_wp, 1.0_wp]
      matrix(2, :) = [-1 - merge(self%more, 0.0_wp, y(1) > self%bend), -2*self%damping]
   end function bent_jacobian

   pure subroutine bend_of_spring(self, state, value)
      class(bent_problem), intent(in) :: self
      integer, allocatable, intent(out) :: state(:)
      real(wp), allocatable, intent(out) :: value(:)
      state = pack([1], self%told)
      value = pack([self%bend], self%told)
   end subroutine bend_of_spring

   pure function turn_of_force(self, t) result(df_dt)
      class(bent_problem), intent(in) :: self
      real(wp), intent(in) :: t
      real(wp) :: df_dt(self%n)
      df_dt = [0.0_wp, -sin(t)]
   end function turn_of_force
end module orbit_problems

program test_orbit_collocation
   use kinds, only: wp, pi
   use orbit_polynomials, only: orbit_type, points, place
   use constant_orbit, only: at_rest, newton_round
   use newton_method, only: newton_options
   use orbit_problem, only: parametric_ode_type, orbit_problem_type, begin_orbits
   use orbit_refinement, only: refined_orbit_type, close_on_meshes, allowed_error
   use errors, only: error_type
   use text, only: to_text
   use orbit_problems, only: linear_problem, van_der_pol, bent_problem
   use check, only: runs, expect, expect_close, expect_no_error, report
   implicit none (type, external)

   !> Of the linear oscillator.
   real(wp), parameter :: damping = 0.1_wp, stiffness = 1e4_wp

   if (runs('linear')) then
      call linear(.false.)
      call linear(.true.)
   end if
   if (runs('order')) call order()
   if (runs('state_at')) call state_at()
   if (runs('limit_cycle')) call limit_cycle()
   if (runs('blocks')) call blocks()
   if (runs('switching points')) call switching_points()
   if (runs('refinement')) call refinement()
   call report()

contains

   !> x'' + 2 d x' + x = cos t, and z' = -k (z - x).
   type(linear_problem) function oscillator(paired) result(problem)
      !> Whether x and x' are said to be a displacement and its rate.
      logical, intent(in) :: paired
      problem%n = 3
      problem%joined = transpose(reshape([0.0_wp, 1.0_wp, 0.0_wp, -1.0_wp, -2*damping, 0.0_wp, stiffness, 0.0_wp, &
         & -stiffness], [3, 3]))
      problem%force = [0.0_wp, 1.0_wp, 0.0_wp]
      problem%x = pack([1], paired)
      problem%v = pack([2], paired)
   end function oscillator

   !> x = sin(t)/(2 d) and z = x - x'/k + ..., for d = 0.1. One round solves what is linear. Of the multipliers,
   !> exp(2 pi (-d +- i sqrt(1 - d^2))) and exp(-2 pi k) = 0, the largest have the modulus exp(-0.2 pi). Radau's error
   !> with 40 intervals is of (2 pi/40)^5/7200 = 1e-8. It is the same whether the displacement follows from its rate.
   subroutine linear(paired)
      logical, intent(in) :: paired
      type(linear_problem), target :: problem
      type(orbit_type) :: orbit
      type(error_type), allocatable :: error
      complex(wp), allocatable :: values(:)
      real(wp) :: residual
      complex(wp) :: expected
      problem = oscillator(paired)
      orbit = at_rest(3, 40, 2*pi)
      call newton_round(problem, orbit, error)
      call expect_no_error(error, 'a round')
      call expect_close(orbit%start(1), 0.0_wp, 1e-6_wp, 'x at the start')
      call expect_close(orbit%start(2), 5.0_wp, 1e-6_wp, 'its velocity')
      call expect_close(orbit%start(3), -5/stiffness, 1e-6_wp, 'the stiff state')
      call newton_round(problem, orbit, error, values, residual)
      call expect_close(orbit%correction, 0.0_wp, 1e-9_wp, 'the second round has nothing to correct')
      call expect_close(residual, 0.0_wp, 1e-9_wp, 'and its equations are satisfied')
      expected = exp(2*pi*cmplx(-damping, sqrt(1 - damping**2), wp))
      call expect_close(values(1)%re, expected%re, 1e-6_wp, 'multiplier, real part')
      call expect_close(abs(values(1)%im), abs(expected%im), 1e-6_wp, 'multiplier, imaginary part')
      call expect_close(abs(values(3)), 0.0_wp, 1e-12_wp, 'the stiff state forgets its start')
   end subroutine linear

   !> With twice the intervals the error of the multipliers falls by 2^5: 28 to 36 where higher orders are small.
   subroutine order()
      real(wp) :: errors(2), exact
      integer :: i
      exact = exp(-0.2_wp*pi)
      do i = 1, 2
         errors(i) = abs(modulus(10*2**i) - exact)
      end do
      call expect(errors(1)/errors(2) > 28 .and. errors(1)/errors(2) < 36, 'order 5')
   end subroutine order

   !> Modulus of the leading multiplier of the linear problem on n intervals.
   real(wp) function modulus(n)
      integer, intent(in) :: n
      type(linear_problem), target :: problem
      type(orbit_type) :: orbit
      type(error_type), allocatable :: error
      complex(wp), allocatable :: values(:)
      problem = oscillator(.true.)
      orbit = at_rest(3, n, 2*pi)
      call newton_round(problem, orbit, error, values)
      modulus = abs(values(1))
   end function modulus

   !> Between the points the orbit is a polynomial: the state of one of degree 3 is exact at any time, and so is it on
   !> another mesh.
   subroutine state_at()
      type(orbit_type) :: orbit
      real(wp) :: y(1), mesh(0:7), t
      integer :: k, i
      orbit = at_rest(1, 4, 2.0_wp)
      orbit%start = cubic(0.0_wp)
      do k = 1, 4
         do i = 1, points
            orbit%at(1, i, k) = cubic(orbit%time(k - 1) + place(i)*0.5_wp)
         end do
      end do
      do k = 0, 20
         t = 0.1_wp*k
         call orbit%state_at(t, y)
         call expect_close(y(1), cubic(t), 1e-13_wp, 'a cubic')
      end do
      mesh = [0.0_wp, 0.1_wp, 0.3_wp, 0.7_wp, 0.9_wp, 1.3_wp, 1.9_wp, 2.0_wp]
      call orbit%change_mesh(mesh)
      call expect(orbit%intervals() == 7, 'seven intervals')
      call expect_close(maxval(abs(orbit%time - mesh)), 0.0_wp, 0.0_wp, 'the mesh')
      do k = 0, 20
         t = 0.1_wp*k
         call orbit%state_at(t, y)
         call expect_close(y(1), cubic(t), 1e-12_wp, 'a cubic on another mesh')
      end do
   end subroutine state_at

   pure real(wp) function cubic(t)
      real(wp), intent(in) :: t
      cubic = 1 - 2*t + 0.5_wp*t**2 + t**3
   end function cubic

   !> Van der Pol's rest, x = 0, for mu = 1 over the period T = 6.6632868593 of its limit cycle: the multipliers are
   !> exp(T (1 +- i sqrt(3))/2), far outside the unit circle. Newton's method is not led away by that.
   subroutine limit_cycle()
      type(van_der_pol), target :: problem
      type(orbit_type) :: orbit
      type(error_type), allocatable :: error
      complex(wp), allocatable :: values(:)
      complex(wp) :: expected
      real(wp), parameter :: period = 6.6632868593_wp
      integer :: round
      problem%n = 2
      orbit = at_rest(2, 80, period)
      orbit%start = [0.1_wp, -0.1_wp]
      do round = 1, 6
         call newton_round(problem, orbit, error, values)
         call expect_no_error(error, 'a round')
      end do
      call expect_close(maxval(abs(orbit%start)), 0.0_wp, 1e-12_wp, 'the rest is found')
      expected = exp(period*cmplx(0.5_wp, sqrt(0.75_wp), wp))
      call expect_close(abs(values(1)), abs(expected), 1e-6_wp*abs(expected), 'modulus of its multipliers')
      call expect_close(values(1)%re, expected%re, 1e-6_wp*abs(expected), 'and their angle')
   end subroutine limit_cycle

   !> Eliminated block by block, and all at once: the same orbit and the same monodromy matrix but for rounding.
   subroutine blocks()
      type(linear_problem), target :: problem
      type(orbit_type) :: orbit(2)
      type(error_type), allocatable :: error
      real(wp) :: residual
      integer :: i
      problem%n = 8
      allocate (problem%joined(8, 8), source=0.0_wp)
      problem%force = [0, 1, 0, 1, 1, 0, 1, 1]
      problem%x = [1, 3, 6]
      problem%v = [2, 4, 7]
      problem%of_block = 3
      problem%joined(1, 2) = 1
      problem%joined(2, :) = [-1.0_wp, -0.3_wp, 0.2_wp, 0.1_wp, 0.4_wp, -0.3_wp, 0.2_wp, 0.1_wp]
      problem%joined(3, 4) = 1
      problem%joined(4, :5) = [0.5_wp, 0.1_wp, -2.0_wp, -0.2_wp, 0.6_wp]
      problem%joined(5, :5) = [0.3_wp, 0.0_wp, 1.0_wp, 0.7_wp, -50.0_wp]
      problem%joined(6, 7) = 1
      problem%joined(7, :) = [0.2_wp, -0.1_wp, 0.0_wp, 0.0_wp, 0.0_wp, -3.0_wp, -0.5_wp, 0.3_wp]
      problem%joined(8, :) = [0.0_wp, 0.4_wp, 0.0_wp, 0.0_wp, 0.0_wp, -0.8_wp, 0.2_wp, -4.0_wp]
      do i = 1, 2
         problem%in_blocks = merge(2, 0, i == 1)
         orbit(i) = at_rest(8, 30, 2*pi)
         call newton_round(problem, orbit(i), error)
         call expect_no_error(error, 'a round')
      end do
      call expect(maxval(abs(orbit(2)%start)) > 0.1_wp, 'they move')
      call expect_close(maxval(abs(orbit(1)%at - orbit(2)%at)), 0.0_wp, 1e-12_wp, 'the orbit')
      call expect_close(maxval(abs(orbit(1)%monodromy - orbit(2)%monodromy)), 0.0_wp, 1e-12_wp, 'the monodromy matrix')
      call newton_round(problem, orbit(2), error, residual=residual)
      call expect_close(residual, 0.0_wp, 1e-12_wp, 'its equations are satisfied')
   end subroutine blocks

   !> Ends of intervals at a switching point: the orbit passes it exactly there, Newton's method stays quadratic, and
   !> the multipliers keep their order, which a switching point inside of an interval would take from them. Their
   !> product is exp(-4 pi d), and their sum is that of the two springs, each for the time between two ends.
   subroutine switching_points()
      type(bent_problem), target :: problem
      type(orbit_type) :: orbit
      type(error_type), allocatable :: error
      complex(wp), allocatable :: values(:)
      real(wp) :: errors(2), last, passages(2), between, y(2)
      integer :: i, round
      problem%n = 2
      do i = 1, 2
         orbit = at_rest(2, 15*2**i, 2*pi)
         last = huge(last)
         do round = 1, 8
            call newton_round(problem, orbit, error, values)
            call expect_no_error(error, 'a round')
            if (last < 0.1_wp) call expect(orbit%correction < last**2 + 1e-12_wp, 'quadratic: '//to_text(last)//' to ' &
               & //to_text(orbit%correction))
            last = orbit%correction
         end do
         call expect(count(orbit%switching_point == 1) == 2, 'two passages')
         if (count(orbit%switching_point == 1) /= 2) return
         passages = pack(orbit%time, orbit%switching_point == 1)
         call orbit%state_at(passages(1), y)
         call expect_close(y(1), problem%bend, 1e-14_wp, 'the switching point is there')
         call expect_close(real(product(values)), exp(-4*pi*problem%damping), 1e-6_wp, 'product of the multipliers')
         between = passages(2) - passages(1)
         if (orbit%start(1) > problem%bend) between = 2*pi - between
         errors(i) = abs(real(sum(values)) - sum_of_multipliers(problem, between))
      end do
      call expect(errors(1)/errors(2) > 28 .and. errors(1)/errors(2) < 36, 'order 5: '//to_text(errors(1))//' to ' &
         & //to_text(errors(2)))
   end subroutine switching_points

   !> Where the model does not say at which state its spring changes, the passages lie inside of intervals. Quarters of
   !> these alone bring the leading multiplier as near as is allowed to that on a mesh with ends there. Equal intervals
   !> would have to be some thousand.
   subroutine refinement()
      type(bent_problem), target :: problem
      type(parametric_ode_type), target :: ode
      type(orbit_problem_type) :: stands
      type(refined_orbit_type) :: found
      type(orbit_type) :: orbit
      type(error_type), allocatable :: error
      complex(wp), allocatable :: values(:)
      real(wp) :: error_of_first
      integer :: round
      problem%n = 2
      problem%more = 8
      problem%damping = 0.02_wp
      orbit = at_rest(2, 400, 2*pi)
      do round = 1, 20
         call newton_round(problem, orbit, error, values)
      end do
      call expect(orbit%correction < 1e-10_wp, 'with ends at the passages it converges')
      problem%told = .false.
      ode%model => problem
      ode%period = 2*pi
      call begin_orbits(stands, ode, orbit, 1)
      call stands%orbit%change_mesh([(2*pi*round/24, round=0, 24)])
      call close_on_meshes(stands, newton_options(max_iterations=60), 2*pi, found, error)
      call expect_no_error(error, 'it closes on all meshes')
      if (allocated(error)) return
      error_of_first = minval(abs(found%multipliers(1) - values))
      call expect(found%errors(1) <= allowed_error(found%multipliers(1)), 'it is told to be near enough: ' &
         & //to_text(found%errors(1)))
      call expect(error_of_first <= allowed_error(found%multipliers(1)), 'the multiplier is near enough: ' &
         & //to_text(error_of_first))
      call expect(stands%orbit%intervals() > 24 .and. stands%orbit%intervals() < 400, 'not all are cut: ' &
         & //to_text(stands%orbit%intervals()))
   end subroutine refinement

   !> The trace of the product of both springs' exact solutions, that of the stiffer one for so long in a period.
   real(wp) function sum_of_multipliers(problem, length) result(sum)
      type(bent_problem), intent(in) :: problem
      real(wp), intent(in) :: length
      real(wp) :: m(2, 2)
      associate (d => problem%damping)
         m = matmul(free_motion(d, 1.0_wp, 2*pi - length), free_motion(d, 1 + problem%more, length))
      end associate
      sum = m(1, 1) + m(2, 2)
   end function sum_of_multipliers

   !> What x'' + 2 d x' + k x = 0 makes of a state in a time.
   pure function free_motion(d, k, t) result(m)
      real(wp), intent(in) :: d, k, t
      real(wp) :: m(2, 2), w
      w = sqrt(k - d**2)
      m(:, 1) = [cos(w*t) + d/w*sin(w*t), -k/w*sin(w*t)]
      m(:, 2) = [sin(w*t)/w, cos(w*t) - d/w*sin(w*t)]
      m = exp(-d*t)*m
   end function free_motion
end program test_orbit_collocation
