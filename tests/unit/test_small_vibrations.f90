!> Eigenvalues of small motions: against closed forms, and against marches of the model itself.
program test_small_vibrations
   use kinds, only: wp, pi
   use errors, only: error_type
   use input_cases, only: case_of
   use sampled_march, only: march_samples
   use equations_of_motion, only: machine_model, new_machine_model
   use equilibrium, only: find_equilibrium
   use equilibrium_record, only: equilibrium_type
   use static_model, only: make_static
   use force_balance, only: stability_type, stability_of, find_vibrations
   use check, only: runs, expect, expect_close, expect_no_error, report
   implicit none (type, external)

   if (runs('oscillators')) call oscillators()
   if (runs('names')) call names()
   ! films that are smooth; and an ordinary bearing whose pad on top carries nothing
   if (runs('stable_march')) call against_march('&film solver = ''fourier'', cavitation = ''none'' /', 'stable', 4)
   if (runs('unstable_march')) call against_march('&film solver = ''fourier'', cavitation = ''gumbel'' / ' &
      & //'&rotor mass = 1500 / &operation speed_rpm = 9000 / &pads pivot_angle_deg = -54, 18, 90, 162, 234, ' &
      & //'arc_deg = 60, mass = 0.8108, inertia = 4.055e-4, centre_tangential = 0, centre_radial = -10.1e-3 / ' &
      & //'&bearing journal_radius = 63.5e-3, axial_length = 63.5e-3, assembled_clearance = 0.2e-3, ' &
      & //'machined_clearance = 0.2857e-3, viscosity = 0.022 /', 'oscillatory instability', 8)
   call report()

contains

   !> Two oscillators that do not know of each other: m x'' = -c x' - k x.
   subroutine oscillators()
      complex(wp) :: values(4)
      real(wp) :: mass(2, 2), stiffness(2, 2), damping(2, 2)
      logical :: ok
      mass = reshape([2.0_wp, 0.0_wp, 0.0_wp, 0.5_wp], [2, 2])
      ! -0.1 +- 4.9990 i, and 3 and -4
      stiffness = reshape([-50.0_wp, 0.0_wp, 0.0_wp, 6.0_wp], [2, 2])
      damping = reshape([-0.4_wp, 0.0_wp, 0.0_wp, -0.5_wp], [2, 2])
      call find_vibrations(mass, stiffness, damping, values, ok)
      call expect(ok, 'they are found')
      call expect_close(minval(abs(values - cmplx(-0.1_wp, sqrt(24.99_wp), wp))), 0.0_wp, 1e-13_wp, &
         & 'a damped vibration')
      call expect_close(minval(abs(values - 3)), 0.0_wp, 1e-13_wp, 'a growth without vibration')
      call expect_close(minval(abs(values + 4)), 0.0_wp, 1e-13_wp, 'a decay without vibration')
   end subroutine oscillators

   subroutine names()
      complex(wp), parameter :: damped(2) = [(-1.0_wp, 5.0_wp), (-1.0_wp, -5.0_wp)]
      complex(wp), parameter :: growing(2) = [(1.0_wp, 5.0_wp), (1.0_wp, -5.0_wp)]
      type(stability_type) :: stability
      stability = stability_of(damped, 1e-3_wp)
      call expect(stability%name == 'stable', 'damped: '//stability%name)
      stability = stability_of([damped, growing], 1e-3_wp)
      call expect(stability%name == 'oscillatory instability', 'growing: '//stability%name)
      call expect_close(abs(stability%eigenvalue - growing(1)), 0.0_wp, 0.0_wp, 'the growing pair, its upper half')
      stability = stability_of([damped, growing, (0.5_wp, 0.0_wp)], 1e-3_wp)
      call expect(stability%name == 'static instability', 'slower than the flutter, without vibration: ' &
         & //stability%name)
      stability = stability_of([damped, (1e-4_wp, 0.0_wp)], 1e-3_wp)
      call expect(stability%name == 'stable', 'a growth of rounding: '//stability%name)
   end subroutine names

   !> A small disturbance grows or decays as the eigenvalue of largest real part says, once the others have died: its
   !> largest size in one period of the vibration over that in the period before is exp(period re). 1 % for what the
   !> others leave and for the instants at which a period is looked at.
   subroutine against_march(case, expected, periods)
      character(len=*), intent(in) :: case, expected
      !> How many are marched.
      integer, intent(in) :: periods
      type(machine_model) :: model
      type(machine_model), target :: static
      type(equilibrium_type) :: found
      type(error_type), allocatable :: error
      real(wp), allocatable :: rest(:), y(:), states(:, :)
      integer, parameter :: samples = 400
      real(wp) :: period, size_of(periods)
      integer, allocatable :: tilts(:)
      integer :: k, sample
      model = new_machine_model(case_of(case))
      call find_equilibrium(model, found, error)
      call expect_no_error(error, 'equilibrium, '//expected)
      if (allocated(error)) return
      call expect(found%stability%name == expected, expected//', not '//found%stability%name)
      call make_static(model, .true., static)
      rest = static%static_state(found%rotor, found%pads)
      y = rest
      y(1:2) = y(1:2) + 1e-5_wp*static%scale(1:2)
      tilts = static%layout%elements(1)%before([(k, k=1, static%layout%pads)]) + 1
      y(tilts) = y(tilts) + 1e-8_wp
      period = 2*pi/found%stability%eigenvalue%im
      allocate (states(static%n, periods*samples))
      call march_samples(static, static%scale, [1e-9_wp, 1e-13_wp], y, 0.0_wp, period/samples, states)
      size_of = 0
      do sample = 1, size(states, 2)
         k = 1 + (sample - 1)/samples
         size_of(k) = max(size_of(k), maxval(abs(states(:, sample) - rest)/static%scale))
      end do
      call expect_close(log(size_of(periods)/size_of(periods - 1)), period*found%stability%eigenvalue%re, &
         & 1e-2_wp, 'growth, '//expected)
   end subroutine against_march
end program test_small_vibrations
