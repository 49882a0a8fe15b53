!> Periodic orbits of bearings and their multipliers: against an independent program, against the eigenvalues of an
!> equilibrium, against a march over the period, and by their order of convergence.
program test_periodic_orbits
   use kinds, only: wp
   use text, only: to_text
   use errors, only: error_type
   use case_inputs, only: case_type
   use marching, only: march_options
   use cvode_integrator, only: integrator_type
   use equations_of_motion, only: machine_model
   use force_balance, only: force_derivatives, masses, find_vibrations
   use orbit_polynomials, only: orbit_type
   use constant_orbit, only: newton_round
   use machine_orbits, only: close_orbit
   use periodic_orbit, only: periodic_orbit_type, are_stable
   use check, only: runs, expect, expect_close, expect_no_error, report
   implicit none (type, external)

   if (runs('published')) call published()
   if (runs('vanishing')) then
      call vanishing('tilting_radial')
      call vanishing('tilting_only')
      call vanishing('fixed')
   end if
   if (runs('order')) then
      call order('none', 1e-3_wp, 100.0_wp, 1e-9_wp)
      call order('lugre', 1e-3_wp, 16.0_wp, 1e-7_wp)
      call order('bengisu_akay', 1e-3_wp, 16.0_wp, 1e-8_wp)
   end if
   if (runs('returns')) then
      call returns('none')
      call returns('lugre')
      call returns('bengisu_akay')
   end if
   call report()

contains

   !> The paper's bearing with converged films that do not cavitate.
   type(case_type) function paper(motion, friction) result(inputs)
      character(len=*), intent(in) :: motion, friction
      inputs = case_type()
      inputs%about%task = 'periodic'
      inputs%bearings(1)%pads%motion = motion
      inputs%bearings(1)%friction%model = friction
      inputs%bearings(1)%film%cavitation = 'none'
   end function paper

   !> Values of an independent program: to the digits given.
   subroutine published()
      type(machine_model) :: model
      type(periodic_orbit_type) :: found
      real(wp), allocatable :: y(:)
      real(wp) :: low(2), high(2)
      integer :: k
      call close_orbit(paper('tilting_radial', 'none'), 1e-7_wp, model, found)
      call expect_close(found%orbit%start(1), -59.8566e-6_wp, 1e-10_wp, 'y at phase 0')
      call expect_close(found%orbit%start(2), -5.7793e-6_wp, 1e-10_wp, 'z at phase 0')
      low = huge(low)
      high = -huge(high)
      allocate (y(model%n))
      do k = 0, 5000
         call found%orbit%state_at(k*found%period/5000, y)
         low = min(low, y(:2))
         high = max(high, y(:2))
      end do
      call expect_close(low(1), -62.2580e-6_wp, 1e-10_wp, 'lowest y')
      call expect_close(high(1), -46.8219e-6_wp, 1e-10_wp, 'highest y')
      call expect_close(low(2), -7.5039e-6_wp, 1e-10_wp, 'lowest z')
      call expect_close(high(2), 7.9767e-6_wp, 1e-10_wp, 'highest z')
      call expect_close(found%multipliers(1)%re, -0.098853_wp, 2e-6_wp, 'leading multiplier')
      call expect_close(abs(found%multipliers(1)%im), 0.283186_wp, 2e-6_wp, 'its imaginary part')
      call expect(are_stable(found%multipliers), 'it is stable')
   end subroutine published

   !> Without unbalance the orbit is the equilibrium, and its multipliers are exp(lambda T) of the eigenvalues there.
   !> Those above 1e-3: the fast ones die within a step, of which the collocation leaves another small number. Its error
   !> is of (2 pi/24)^5/7200 = 2e-7 for what turns with the shaft.
   subroutine vanishing(motion)
      character(len=*), intent(in) :: motion
      type(case_type) :: inputs
      type(machine_model) :: model
      type(periodic_orbit_type) :: found
      complex(wp), allocatable :: values(:), expected(:)
      real(wp), allocatable, dimension(:, :) :: stiffness, damping
      integer :: k, n
      logical :: ok
      inputs = paper(motion, 'none')
      inputs%rotor%unbalance = 0
      call close_orbit(inputs, 1e-6_wp, model, found)
      n = model%layout%n_positions()
      allocate (stiffness(n, n), damping(n, n), values(2*n))
      call model%evaluate(0.0_wp, found%orbit%start, .true., ok)
      call force_derivatives(model, stiffness, damping)
      call find_vibrations(masses(model), stiffness, damping, values, ok)
      expected = exp(values*found%period)
      call expect(count(abs(expected) > 1e-3_wp) >= 2, 'some do not die at once, '//motion)
      do k = 1, 2*n
         if (abs(expected(k)) > 1e-3_wp) call expect_close(minval(abs(found%multipliers - expected(k))), 0.0_wp, &
            & 2e-6_wp, 'exp(lambda T), '//motion)
      end do
   end subroutine vanishing

   !> Intervals of a quarter of the length leave an error of the multipliers that is 4^5 times smaller, or, where the
   !> motion is stiff, something between 4^3 (the order of the states inside an interval) and this; measured are 400 and
   !> more, and 170 with LuGre. With Bengisu-Akay the first mesh may leave no more than rounding does. With switching
   !> points beside the ends of intervals the first mesh would err by 1e-5 and more. The error is the difference to
   !> intervals of an eighth.
   subroutine order(friction, tolerance, factor, limit)
      character(len=*), intent(in) :: friction
      !> Of the march; factor by which the error falls; what is left of it.
      real(wp), intent(in) :: tolerance, factor, limit
      type(case_type) :: inputs
      type(machine_model) :: model
      type(periodic_orbit_type) :: found
      !> Of multipliers whose orbits are closed to 1e-9.
      real(wp), parameter :: rounding = 1e-8_wp
      complex(wp), allocatable :: coarse(:), fine(:), finest(:)
      real(wp) :: errors(2)
      inputs = paper('tilting_radial', friction)
      call close_orbit(inputs, tolerance, model, found)
      coarse = found%multipliers
      fine = refined(model, found%orbit)
      fine = refined(model, found%orbit)
      finest = refined(model, found%orbit)
      errors = [abs(coarse(1)%re - finest(1)%re), abs(fine(1)%re - finest(1)%re)]
      call expect(errors(1) < 5e-6_wp .and. errors(2) < limit .and. (factor*errors(2) < errors(1) &
         & .or. errors(1) < rounding), 'the error falls from ' &
         & //to_text(errors(1))//' to '//to_text(errors(2))//', '//friction)
   end subroutine order

   !> Halves the intervals of an orbit, closes it anew and gives its multipliers.
   function refined(model, orbit) result(values)
      type(machine_model), intent(inout), target :: model
      type(orbit_type), intent(inout) :: orbit
      complex(wp), allocatable :: values(:)
      type(error_type), allocatable :: error
      real(wp) :: mesh(0:2*orbit%intervals())
      integer :: switching_point(0:2*orbit%intervals()), round
      mesh(0::2) = orbit%time
      mesh(1::2) = 0.5_wp*(orbit%time(:orbit%intervals() - 1) + orbit%time(1:))
      switching_point = 0
      switching_point(0::2) = orbit%switching_point
      call orbit%change_mesh(mesh, switching_point)
      do round = 1, 12
         call newton_round(model, orbit, error, values)
         call expect_no_error(error, 'a round')
         if (orbit%correction < 1e-9_wp) exit
      end do
      call expect(orbit%correction < 1e-9_wp, 'it converges to '//to_text(orbit%correction))
   end function refined

   !> A march over the period returns to the start: what it errs by in some thousand steps of 1e-8.
   subroutine returns(friction)
      character(len=*), intent(in) :: friction
      type(machine_model), target :: model
      type(periodic_orbit_type) :: found
      type(march_options) :: options
      type(integrator_type) :: integrator
      type(error_type), allocatable :: error
      call close_orbit(paper('tilting_radial', friction), 1e-6_wp, model, found)
      options%relative_tolerance = 1e-8_wp
      options%absolute_tolerance = 1e-8_wp*model%scale
      call integrator%start(model, options, 0.0_wp, found%orbit%start, found%period, error)
      do while (.not. allocated(error) .and. integrator%time() < found%period)
         call integrator%step(error)
      end do
      call expect_no_error(error, 'the march ends well')
      call expect_close(maxval(abs(integrator%state() - found%orbit%start)/model%scale), 0.0_wp, 3e-6_wp, &
         & 'it returns, '//friction)
   end subroutine returns
end program test_periodic_orbits
