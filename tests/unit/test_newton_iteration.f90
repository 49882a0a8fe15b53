!> Forces that linear systems of an earlier state do not tell: of a film whose velocity is next to zero, and of leaps.
module steep_forces
   use kinds, only: wp
   use small_ode, only: small_ode_type
   implicit none (type, external)
   private
   public :: fed_film, dry_friction

   !> A light mass on a film that a slow motion feeds: u' = drive(t) - F(u, v), v' = slow. As with Reynolds' condition
   !> F is positively homogeneous of degree 1, F = stiffness u cos(angle to u)**18: its derivatives depend on the
   !> direction of (u, v) alone, and within a tolerance it goes from next to nothing to a multiple of the drive.
   type, extends(small_ode_type) :: fed_film
      real(wp) :: stiffness = 1e10_wp, drive = 1e5_wp
   contains
      procedure :: rates => film_rates
      procedure :: jacobian => film_jacobian
   end type fed_film

   !> A mass on a spring of stiffness 1 that dry friction holds, x' = v, v' = cos t - x - 2 sign v: its force leaps, and
   !> between -1 and 3 its mean holds the mass where it is.
   type, extends(small_ode_type) :: dry_friction
   contains
      procedure :: rates => friction_rates
      procedure :: jacobian => friction_jacobian
   end type dry_friction

contains

   pure function film_rates(self, t, y) result(rates)
      class(fed_film), intent(in) :: self
      real(wp), intent(in) :: t, y(:)
      real(wp) :: rates(size(y))
      rates = [self%drive*(1 + 0.5_wp*cos(3*t)), 1 + 0.5_wp*cos(t) - y(2)]
      if (y(1) > 0) rates(1) = rates(1) - self%stiffness*y(1)*(y(1)**2/sum(y**2))**9
   end function film_rates

   pure function film_jacobian(self, t, y) result(matrix)
      class(fed_film), intent(in) :: self
      real(wp), intent(in) :: t, y(:)
      real(wp) :: matrix(size(y), size(y)), force
      matrix = 0
      matrix(2, 2) = -1
      if (y(1) <= 0) return
      force = self%stiffness*(y(1)**2/sum(y**2))**9
      matrix(1, 1) = -force*(1 + 18*y(2)**2/sum(y**2))
      matrix(1, 2) = force*18*y(1)*y(2)/sum(y**2)
   end function film_jacobian

   pure function friction_rates(self, t, y) result(rates)
      class(dry_friction), intent(in) :: self
      real(wp), intent(in) :: t, y(:)
      real(wp) :: rates(size(y))
      rates = [y(2), cos(t) - y(1) - 2*sign(1.0_wp, y(2))]
   end function friction_rates

   pure function friction_jacobian(self, t, y) result(matrix)
      class(dry_friction), intent(in) :: self
      real(wp), intent(in) :: t, y(:)
      real(wp) :: matrix(size(y), size(y))
      matrix = reshape([0.0_wp, -1.0_wp, 1.0_wp, 0.0_wp], [2, 2])
   end function friction_jacobian
end module steep_forces

!> Newton's iteration where it may come to a cycle: marches must go on, through states that are solutions.
program test_newton_iteration
   use kinds, only: wp
   use text, only: to_text
   use errors, only: error_type
   use cvode_integrator, only: integrator_type, integrator_options
   use small_ode, only: small_ode_type
   use steep_forces, only: fed_film, dry_friction
   use check, only: runs, expect, report
   implicit none (type, external)
   real(wp), parameter :: drives(3) = [1e5_wp, 1e5_wp, 1e7_wp], tolerances(3) = [3e-2_wp, 1e-2_wp, 1e-1_wp]
   !> Steps that a march may go on without a test, and those of one that crawls.
   integer, parameter :: untested = 255, too_many = 2000

   if (runs('film')) call film()
   if (runs('leap')) call leap()
   call report()

contains

   !> Marches a model with steps of at most this error to an end; its state there, steps, and the most in a row of which
   !> `unsolved` says that their states are no solutions.
   subroutine march(model, tolerance, from, t_end, y, steps, most)
      class(small_ode_type), intent(inout), target :: model
      real(wp), intent(in) :: tolerance, from(2), t_end
      real(wp), intent(out) :: y(2)
      integer, intent(out) :: steps, most
      type(integrator_type) :: integrator
      type(integrator_options) :: options
      type(error_type), allocatable :: error
      real(wp) :: rates(2), matrix(2, 2)
      integer :: row
      options%relative_tolerance = 0
      options%absolute_tolerance = [tolerance, tolerance]
      options%derivatives_age = 2
      call integrator%start(model, options, 0.0_wp, from, t_end, error)
      most = 0
      row = 0
      do steps = 1, too_many
         call integrator%step(error)
         if (allocated(error)) call expect(.false., error%message)
         y = integrator%state()
         rates = model%rates(integrator%time(), y)
         matrix = model%jacobian(integrator%time(), y)
         row = merge(row + 1, 0, abs(rates(1)) > 0.1_wp*tolerance*abs(matrix(1, 1)))
         most = max(most, row)
         if (allocated(error) .or. integrator%time() >= t_end) exit
      end do
   end subroutine march

   !> The film follows its drive without inertia but for a moment at the start: where its forces are out of balance by
   !> what a tenth of the tolerance changes them, a state is no solution. Untested iterations take more than 50,000
   !> steps with some of these tolerances, in a cycle of two states, or end where Newton's iteration fails.
   subroutine film()
      type(fed_film) :: model
      real(wp) :: y(2), close(2)
      integer :: steps, most, k
      do k = 1, size(drives)
         model = fed_film(n=2, drive=drives(k))
         call march(model, tolerances(k), [0.0_wp, 1.0_wp], 20.0_wp, y, steps, most)
         call expect(steps < too_many, 'the film is passed after '//to_text(steps)//' steps')
         call expect(most <= untested, to_text(most)//' steps in a row do not solve it')
         model = fed_film(n=2, drive=drives(k))
         call march(model, tolerances(k)/10, [0.0_wp, 1.0_wp], 20.0_wp, close, steps, most)
         ! a slow motion with a relaxation time of 1: errors of the last few steps are left
         call expect(maxval(abs(y - close)) < 3*tolerances(k), 'error '//to_text(maxval(abs(y - close))))
      end do
   end subroutine film

   !> Held by friction from the start on, |cos t - x| < 2, the mass may move by no more than tolerances.
   subroutine leap()
      type(dry_friction) :: model
      real(wp), parameter :: tolerance = 1e-5_wp
      real(wp) :: y(2)
      integer :: steps, most
      model = dry_friction(n=2)
      call march(model, tolerance, [0.5_wp, 0.0_wp], 20.0_wp, y, steps, most)
      call expect(steps < too_many, 'the mass is held for '//to_text(steps)//' steps')
      call expect(abs(y(2)) < tolerance, 'its velocity is '//to_text(y(2)))
      call expect(abs(y(1) - 0.5_wp) < steps*tolerance, 'it has moved by '//to_text(y(1) - 0.5_wp))
   end subroutine leap
end program test_newton_iteration
