!> Roessler's equations, whose limit cycle doubles its period at known values of c.
module roessler_cycles
   use kinds, only: wp
   use errors, only: error_type
   use small_ode, only: small_ode_type
   use orbit_polynomials, only: orbit_type, points, place
   use orbit_problem, only: parametric_ode_type
   implicit none (type, external)
   private
   public :: roessler, roessler_cycle, marched

   !> x' = -y - z, y' = x + 0.2 y, z' = 0.2 + z (x - c).
   type, extends(small_ode_type) :: roessler
      real(wp) :: c = 2.5_wp
   contains
      procedure :: rates
      procedure :: jacobian
   end type roessler

   !> Over c.
   type, extends(parametric_ode_type) :: roessler_cycle
   contains
      procedure :: set
   end type roessler_cycle

contains

   pure function rates(self, t, y)
      class(roessler), intent(in) :: self
      real(wp), intent(in) :: t, y(:)
      real(wp) :: rates(size(y))
      rates = [-y(2) - y(3), y(1) + 0.2_wp*y(2), 0.2_wp + y(3)*(y(1) - self%c) + 0*t]
   end function rates

   pure function jacobian(self, t, y) result(matrix)
      class(roessler), intent(in) :: self
      real(wp), intent(in) :: t, y(:)
      real(wp) :: matrix(size(y), size(y))
      matrix(1, :) = [0*t, -1.0_wp, -1.0_wp]
      matrix(2, :) = [1.0_wp, 0.2_wp, 0.0_wp]
      matrix(3, :) = [y(3), 0.0_wp, y(1) - self%c]
   end function jacobian

   subroutine set(self, parameter, error)
      class(roessler_cycle), intent(inout) :: self
      real(wp), intent(in) :: parameter
      type(error_type), allocatable, intent(out) :: error
      ! what would drive it has no meaning
      self%period = 1
      select type (model => self%model)
      type is (roessler)
         model%c = parameter
      end select
   end subroutine set

   !> The cycle at c = 2.5, by the classical method of Runge and Kutta from a start on it.
   function marched(model) result(orbit)
      class(roessler), intent(in) :: model
      type(orbit_type) :: orbit
      integer, parameter :: intervals = 60, steps = 20
      real(wp), parameter :: period = 5.748991183278_wp
      real(wp) :: y(3), at(3, points, intervals), h, before
      integer :: k, i
      orbit%start = [-2.19096522_wp, 2.71520332_wp, 0.27259518_wp]
      allocate (orbit%scale(3), source=1.0_wp)
      y = orbit%start
      h = period/intervals
      do k = 1, intervals
         before = 0
         do i = 1, points
            call run((place(i) - before)*h/steps)
            at(:, i, k) = y
            before = place(i)
         end do
      end do
      call orbit%set_mesh([(h*k, k=0, intervals)], at)
   contains
      subroutine run(step)
         real(wp), intent(in) :: step
         real(wp) :: k1(3), k2(3), k3(3), k4(3)
         integer :: n
         do n = 1, steps
            k1 = model%rates(0.0_wp, y)
            k2 = model%rates(0.0_wp, y + step/2*k1)
            k3 = model%rates(0.0_wp, y + step/2*k2)
            k4 = model%rates(0.0_wp, y + step*k3)
            y = y + step/6*(k1 + 2*k2 + 2*k3 + k4)
         end do
      end subroutine run
   end function marched
end module roessler_cycles

program test_limit_cycle
   use kinds, only: wp
   use errors, only: error_type
   use newton_method, only: branch_point_type
   use continuation, only: branch_options, start_branch, bifurcation_type, find_first
   use limit_cycle, only: limit_cycle_type, begin_cycles
   use doubled_orbit, only: double_period
   use roessler_cycles, only: roessler, roessler_cycle, marched
   use check, only: runs, expect, expect_close, expect_no_error, report
   implicit none (type, external)

   if (runs('doubling')) call doubling()
   call report()

contains

   !> The values at which the cycle and the doubled one double, and the periods there, by shooting in Python (DOP853,
   !> 1e-13). The error of 60 intervals for a period is some 1e-6.
   subroutine doubling()
      type(roessler), target :: model
      type(roessler_cycle), target :: ode
      type(limit_cycle_type) :: problem
      type(branch_point_type) :: here
      type(bifurcation_type) :: found
      type(error_type), allocatable :: error
      type(branch_options) :: options
      real(wp), parameter :: c(2) = [2.8324450279_wp, 3.8373581684_wp], period(2) = [5.769820017_wp, 11.57270_wp]
      real(wp) :: length, half(3)
      integer :: k
      logical :: ok
      model%n = 3
      ode%model => model
      call begin_cycles(problem, ode, marched(model), 2.5_wp, 1.0_wp)
      options = branch_options(first_step=0.05_wp, max_step=0.3_wp, low=2.4_wp, high=4.0_wp)
      call start_branch(problem, options, .true., here, error)
      call expect_no_error(error, 'the start')
      call expect_close(problem%period(), 5.748991183278_wp, 1e-6_wp, 'period at the start')
      call expect_close(here%values(1)%re, -0.769693642_wp, 1e-5_wp, 'leading multiplier at the start')
      do k = 1, 2
         length = 0.05_wp
         call find_first(problem, options, 'period_doubling', here, length, found, error)
         call expect_no_error(error, 'the branch')
         call expect(found%kind == 'period_doubling' .and. found%destabilises, 'a doubling')
         call expect_close(found%point%parameter, c(k), 1e-5_wp, 'where it is')
         call expect_close(problem%period(), period(k), 1e-4_wp, 'period there')
         if (k == 2) exit
         call double_period(problem, found%point, here, ok)
         call expect(ok, 'the doubled cycle')
         call expect_close(here%values(1)%re, 1.0_wp, 1e-4_wp, 'its multiplier there is 1')
         here%growth(1) = -1
      end do
      call problem%orbit%state_at(0.5_wp*problem%period(), half)
      call expect(norm2(half - problem%orbit%start) > 0.1_wp, 'it is none of half the period')
      call expect(problem%trivial_error() < 1e-5_wp, 'the multiplier of a shift along it is 1')
   end subroutine doubling
end program test_limit_cycle
