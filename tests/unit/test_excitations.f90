!> Forces over time: their values, their rates, when they switch, and what a march makes of a jump.
module switched_problem
   use kinds, only: wp
   use small_ode, only: small_ode_type
   implicit none (type, external)
   private
   public :: switched

   !> y' = -k (y - s(t)), where s jumps from 0 to 1 at a time, and after it grows with a slope from another time on.
   type, extends(small_ode_type) :: switched
      real(wp) :: k = 300, jump = 0.1_wp, corner = 0.2_wp
      logical :: tells = .true.
   contains
      procedure :: rates
      procedure :: jacobian
      procedure :: next_switch
      procedure :: exact
   end type switched

contains

   pure function rates(self, t, y)
      class(switched), intent(in) :: self
      real(wp), intent(in) :: t, y(:)
      real(wp) :: rates(size(y))
      rates = -self%k*(y - merge(1.0_wp, 0.0_wp, t >= self%jump) - max(0.0_wp, t - self%corner))
   end function rates

   pure function jacobian(self, t, y) result(matrix)
      class(switched), intent(in) :: self
      real(wp), intent(in) :: t, y(:)
      real(wp) :: matrix(size(y), size(y))
      matrix = -self%k
   end function jacobian

   pure subroutine next_switch(self, t, next, jumps)
      class(switched), intent(in) :: self
      real(wp), intent(in) :: t
      real(wp), intent(out) :: next
      logical, intent(out) :: jumps
      next = huge(t)
      jumps = .false.
      if (.not. self%tells) return
      jumps = t < self%jump
      if (t < self%corner) next = merge(self%jump, self%corner, jumps)
   end subroutine next_switch

   pure real(wp) function exact(self, t)
      class(switched), intent(in) :: self
      real(wp), intent(in) :: t
      exact = 0
      if (t > self%jump) exact = 1 - exp(-self%k*(t - self%jump))
      if (t > self%corner) exact = exact + (t - self%corner) - (1 - exp(-self%k*(t - self%corner)))/self%k
   end function exact
end module switched_problem

program test_excitations
   use kinds, only: wp, pi
   use text, only: to_text
   use errors, only: error_type
   use operating_point, only: operating_point_type
   use case_inputs, only: case_type
   use cvode_integrator, only: integrator_type, integrator_options
   use ode_model, only: integrator_counts_type
   use state_layout, only: pad_state
   use equations_of_motion, only: machine_model, new_machine_model
   use switched_problem, only: switched
   use input_cases, only: case_of, expect_refused
   use check, only: runs, expect, expect_close, expect_no_error, report
   implicit none (type, external)

   if (runs('values')) call values()
   if (runs('rates')) call rates()
   if (runs('switches')) call switches()
   if (runs('march')) call march()
   if (runs('journal')) call journal()
   if (runs('stations')) call stations()
   if (runs('static')) call static()
   if (runs('periods')) call periods()
   if (runs('refused')) call refused()
   call report()

contains

   !> The excitation of a text, of the paper's bearing in a run-up from 3000 to 6000 rpm over 2 s.
   type(operating_point_type) function point_of(text) result(point)
      character(len=*), intent(in) :: text
      point = operating_point_type(case_of('&operation speed_rpm = 3000, final_speed_rpm = 6000 / &excitation ' &
         & //text//' /'))
   end function point_of

   subroutine expect_force(text, t, force, what)
      character(len=*), intent(in) :: text, what
      real(wp), intent(in) :: t, force(2)
      type(operating_point_type) :: point
      real(wp) :: found(2, 1)
      point = point_of(text)
      found = point%excitation_forces(t)
      call expect_close(norm2(found(:, 1) - force), 0.0_wp, 1e-12_wp*max(1.0_wp, norm2(force)), what)
   end subroutine expect_force

   !> By hand.
   subroutine values()
      real(wp) :: half, turned
      half = sqrt(0.5_wp)
      call expect_force('amplitude = 8, frequency_hz = 50', 0.02_wp, [8.0_wp, 0.0_wp], 'a whole period')
      call expect_force('amplitude = 8, frequency_hz = 50, direction_deg = 90', 0.01_wp, [0.0_wp, -8.0_wp], &
         & 'half a period along z')
      call expect_force('amplitude = 8, frequency_hz = 50, phase_deg = -90, start = 0.1', 0.105_wp, &
         & [8.0_wp, 0.0_wp], 'the phase counts from the start')
      call expect_force('amplitude = 8, frequency_hz = 50, start = 0.1', 0.0999_wp, [0.0_wp, 0.0_wp], 'before it')
      call expect_force('amplitude = 8, frequency_hz = 50, end = 0.1', 0.1_wp, [0.0_wp, 0.0_wp], 'at its end')
      call expect_force('amplitude = 8, frequency_hz = 50, rotating = ''forward''', 0.0025_wp, 8*[half, half], &
         & 'forward is from y towards z')
      call expect_force('amplitude = 8, frequency_hz = 50, rotating = ''backward''', 0.0025_wp, 8*[half, -half], &
         & 'backward is from y away from z')
      ! 3000 rpm + 1500 rpm/s: at t the shaft has turned by 2 pi (50 t + 12.5 t**2)
      turned = 2*pi*(50*0.3_wp + 12.5_wp*0.3_wp**2)
      call expect_force('amplitude = 8, frequency_ratio = 0.5', 0.3_wp, 8*[cos(turned/2), 0.0_wp], 'follows the shaft')
      ! from 10 to 30 Hz over 2 s: 2 pi (10 t + 5 t**2)
      turned = 2*pi*(10*0.3_wp + 5*0.3_wp**2)
      call expect_force('kind = ''chirp'', amplitude = 8, frequency_hz = 10, final_frequency_hz = 30', 0.3_wp, &
         & 8*[cos(turned), 0.0_wp], 'chirp')
      call expect_force('kind = ''ramp'', amplitude = 8, start = 0.2, end = 1', 0.4_wp, [2.0_wp, 0.0_wp], 'ramp')
      call expect_force('kind = ''ramp'', amplitude = 8, start = 0.2, end = 1', 1.5_wp, [8.0_wp, 0.0_wp], 'kept')
      call expect_force('kind = ''step'', amplitude = 8, start = 0.2, end = 1', 0.2_wp, [8.0_wp, 0.0_wp], 'step')
   end subroutine values

   !> A table of four rows.
   type(operating_point_type) function table_point() result(point)
      point = point_of('kind = ''step'', amplitude = 1, start = 0.1')
      associate (x => point%excitations(1))
         x%kind = 'table'
         x%time = [0.0_wp, 0.1_wp, 0.3_wp, 0.5_wp]
         x%table = reshape([1.0_wp, 2.0_wp, 3.0_wp, 0.0_wp, -1.0_wp, 4.0_wp, -1.0_wp, 5.0_wp], [2, 4])
         call x%prepare(1.0_wp)
      end associate
   end function table_point

   !> Central differences of h = 1e-5 s: error h**2/6 of the third derivative, (2 pi 60 Hz)**2 h**2/6 = 2e-6 of
   !> the rate; and rounding of forces of 8 N, 1e-15/h = 2e-9 N/s of some 1e3.
   subroutine rates()
      character(len=90) :: texts(6)
      type(operating_point_type) :: point
      real(wp), parameter :: h = 1e-5_wp, times(3) = [0.25_wp, 0.31_wp, 0.47_wp]
      real(wp), allocatable :: found(:, :), expected(:, :)
      integer :: i, k
      texts(1) = 'amplitude = 8, frequency_hz = 50, direction_deg = 30, phase_deg = 20'
      texts(2) = 'amplitude = 8, frequency_ratio = 0.7, rotating = ''forward'', direction_deg = 30'
      texts(3) = 'amplitude = 8, frequency_hz = 47, rotating = ''backward'', start = 0.1'
      texts(4) = 'kind = ''chirp'', amplitude = 8, frequency_hz = 10, final_frequency_hz = 30, start = 0.1'
      texts(5) = 'kind = ''ramp'', amplitude = 8, start = 0.1, end = 1'
      texts(6) = 'kind = ''step'', amplitude = 8, start = 0.1'
      do i = 1, size(texts) + 1
         if (i > size(texts)) then
            point = table_point()
         else
            point = point_of(trim(texts(min(i, size(texts)))))
         end if
         do k = 1, size(times)
            found = point%excitation_rates(times(k))
            expected = (point%excitation_forces(times(k) + h) - point%excitation_forces(times(k) - h))/(2*h)
            call expect_close(maxval(abs(found - expected)), 0.0_wp, 4e-6_wp*max(maxval(abs(expected)), 1e-2_wp), &
               & 'rate by differences, '//to_text(i)//' at '//to_text(times(k)))
         end do
      end do
   end subroutine rates

   subroutine expect_switches(point, times, jumps, what)
      type(operating_point_type), intent(in) :: point
      real(wp), intent(in) :: times(:)
      logical, intent(in) :: jumps(:)
      character(len=*), intent(in) :: what
      real(wp) :: t, next
      logical :: jump
      integer :: k
      t = 0
      do k = 1, size(times)
         call point%next_switch(t, next, jump)
         call expect_close(next, times(k), 1e-15_wp, 'switch '//to_text(k)//' of '//what)
         call expect(jump .eqv. jumps(k), 'jump or not at switch '//to_text(k)//' of '//what)
         t = next
      end do
      call point%next_switch(t, next, jump)
      call expect(next >= huge(t), 'no switch after the last, '//what)
   end subroutine expect_switches

   subroutine switches()
      call expect_switches(point_of('amplitude = 8, frequency_hz = 50'), [real(wp) ::], [logical ::], 'one without end')
      call expect_switches(point_of('kind = ''step'', amplitude = 8, start = 0.2, end = 1'), [0.2_wp, 1.0_wp], &
         & [.true., .true.], 'a step')
      call expect_switches(point_of('kind = ''ramp'', amplitude = 8, start = 0.2, end = 1'), [0.2_wp, 1.0_wp], &
         & [.false., .false.], 'a ramp')
      call expect_switches(table_point(), [0.1_wp, 0.2_wp, 0.4_wp, 0.6_wp], [.true., .false., .false., .true.], &
         & 'a table')
      call expect_switches(point_of('kind = ''step'', amplitude = 8, start = 0.2 / &excitation kind = ''ramp'', ' &
         & //'amplitude = 8, start = 0.2, end = 0.1e1'), [0.2_wp, 1.0_wp], [.true., .false.], 'two at one time')
   end subroutine switches

   !> A march ends a step at the jump and starts anew there: its error is that of its tolerance, and no error test fails
   !> for the jump. Not told of it, the march fails a number of tests there. The tolerance is 1e-8 a step; 300 steps
   !> of a problem that forgets errors within some of them make at most some 1e-7.
   subroutine march()
      type(switched), target :: problem
      type(integrator_type) :: integrator
      type(integrator_options) :: options
      type(error_type), allocatable :: error
      type(integrator_counts_type) :: counts(2)
      real(wp) :: worst, before, values(1)
      logical :: crossed
      integer :: k
      options%relative_tolerance = 1e-8_wp
      options%absolute_tolerance = [1e-8_wp]
      do k = 1, 2
         problem%n = 1
         problem%tells = k == 1
         call integrator%start(problem, options, 0.0_wp, [0.0_wp], 0.3_wp, error)
         worst = 0
         crossed = .false.
         do while (integrator%time() < 0.3_wp)
            before = integrator%time()
            call integrator%step(error)
            call expect_no_error(error, 'a step')
            crossed = crossed .or. before < nearest(problem%jump, -1.0_wp) .and. integrator%time() >= problem%jump
            values = integrator%state()
            worst = max(worst, abs(values(1) - problem%exact(integrator%time())))
         end do
         counts(k) = integrator%counts()
         if (k == 1) call expect(.not. crossed, 'no step crosses the jump')
         if (k == 1) call expect_close(worst, 0.0_wp, 1e-6_wp, 'error of a march over a jump')
         if (k == 1) call expect(counts(1)%steps > 20, 'steps are counted beyond the jump')
      end do
      call expect(counts(1)%error_test_failures + 5 < counts(2)%error_test_failures, 'no failures at the jump: ' &
         & //to_text(counts(1)%error_test_failures)//' and '//to_text(counts(2)%error_test_failures))
   end subroutine march

   !> The acceleration of the journal is that of the force, to rounding, and df/dt that of its rate.
   subroutine journal()
      type(machine_model) :: with, without
      type(case_type) :: inputs
      real(wp), allocatable :: y(:), f(:), f0(:), rate(:)
      real(wp) :: force(2, 1), expected(2)
      real(wp), parameter :: t = 0.0123_wp
      logical :: ok
      inputs = case_of('&rotor mass = 20 / &excitation amplitude = 300, frequency_hz = 70, direction_deg = 30 /')
      with = new_machine_model(inputs)
      without = new_machine_model(case_of('&rotor mass = 20 /'))
      y = with%static_state([-2e-5_wp, 0.0_wp], [pad_state(-2e-4_wp, deflection=7e-6_wp), &
         & pad_state(1e-3_wp, deflection=7e-6_wp)])
      allocate (f(with%n), f0(with%n))
      call with%rhs(t, y, f, ok)
      call without%rhs(t, y, f0, ok)
      force = with%point%excitation_forces(t)
      call expect(norm2(force) > 10, 'there is a force')
      call expect_close(norm2(f(3:4) - f0(3:4) - force(:, 1)/20), 0.0_wp, 1e-12_wp*norm2(f0(3:4)), 'acceleration')
      call expect_close(norm2(f(5:) - f0(5:)), 0.0_wp, 0.0_wp, 'pads know no excitation')
      force = with%point%excitation_rates(t)
      rate = with%df_dt(t) - without%df_dt(t)
      expected = force(:, 1)/20
      call expect_close(norm2(rate(3:4) - expected), 0.0_wp, 1e-12_wp*norm2(with%df_dt(t)), 'df/dt')
   end subroutine journal

   !> A step at a station of a shaft accelerates it as a static load there does.
   subroutine stations()
      character(len=*), parameter :: shaft = '&shaft length = 0.05, 0.05, 8*0.2, 0.05, 0.05, diameter = 0.0998, ' &
         & //'0.0998, 8*0.34, 0.0998, 0.0998 / &disc station = 7, mass = 2800, polar_inertia = 500, ' &
         & //'diametral_inertia = 280 / &bearing name = ''left'', station = 2 / &bearing name = ''right'', ' &
         & //'station = 12 /'
      type(machine_model) :: excited, loaded, bare
      real(wp), allocatable :: y(:), f(:), g(:), h(:)
      logical :: ok
      excited = new_machine_model(case_of(shaft//' &excitation kind = ''step'', amplitude = 700, direction_deg = 90, ' &
         & //'station = 5 /'))
      loaded = new_machine_model(case_of(shaft//' &load station = 5, force = 0, 700 /'))
      bare = new_machine_model(case_of(shaft))
      allocate (y(excited%n), f(excited%n), g(excited%n), h(excited%n))
      y = bare%static_state(spread(0.0_wp, 1, bare%rotor%positions), spread(pad_state(deflection=5e-6_wp), 1, 4))
      call excited%rhs(0.01_wp, y, f, ok)
      call loaded%rhs(0.01_wp, y, g, ok)
      call bare%rhs(0.01_wp, y, h, ok)
      call expect(norm2(g - h) > 1e-3_wp*norm2(h), 'the load counts')
      call expect_close(norm2(f - g), 0.0_wp, 1e-11_wp*norm2(g), 'a step is a load')
   end subroutine stations

   !> Statics know no excitation.
   subroutine static()
      type(operating_point_type) :: point
      real(wp) :: next
      logical :: jumps
      point = point_of('kind = ''step'', amplitude = 8, start = 0.2')
      point = point%static()
      call expect(size(point%excitation_forces(0.3_wp)) == 0, 'no forces')
      call point%next_switch(0.0_wp, next, jumps)
      call expect(next >= huge(next), 'no switches')
   end subroutine static

   !> The period of an orbit has whole periods of all excitations and of the shaft.
   subroutine periods()
      character(len=*), parameter :: periodic = '&case task = ''periodic'' / &operation speed_rpm = 6000 / '
      call expect_period(periodic//'&excitation amplitude = 1, frequency_hz = 300 /', 1)
      call expect_period(periodic//'&excitation amplitude = 1, frequency_hz = 50 /', 2)
      call expect_period(periodic//'&excitation amplitude = 1, frequency_ratio = 0.4 /', 5)
      call expect_period(periodic//'&excitation amplitude = 1, frequency_ratio = 1.5 / &excitation amplitude = 1, ' &
         & //'frequency_hz = 33.333333333333 /', 6)
      call expect_period(periodic//'&periodic revolutions = 2 / &excitation amplitude = 1, frequency_ratio = 0.2 /', 10)
      call expect_period('&operation speed_rpm = 6000 / &excitation amplitude = 1, frequency_hz = 50 /', 1)
   end subroutine periods

   subroutine expect_period(text, revolutions)
      character(len=*), intent(in) :: text
      integer, intent(in) :: revolutions
      type(case_type) :: inputs
      inputs = case_of(text)
      call expect(inputs%periodic%revolutions == revolutions, 'revolutions of '//text//': ' &
         & //to_text(inputs%periodic%revolutions))
   end subroutine expect_period

   subroutine refused()
      character(len=*), parameter :: periodic = '&case task = ''periodic'' / '
      call expect_refused('&excitation frequency_hz = 5 /', &
         & 'excitation(1)%amplitude: must be given with kind = ''harmonic''')
      call expect_refused('&excitation amplitude = 1 /', &
         & 'excitation(1)%frequency_hz: must be given, or frequency_ratio')
      call expect_refused('&excitation amplitude = 1, frequency_hz = 0 /', 'frequency_hz = 0: must be 1e-6 to')
      call expect_refused('&excitation amplitude = 1, frequency_hz = 5, frequency_ratio = 1 /', 'give one of them')
      call expect_refused('&excitation amplitude = 1, frequency_hz = 5, start = 2 /', &
         & 'excitation(1)%start = 2: must be below operation%duration = 2')
      call expect_refused('&excitation amplitude = 1, frequency_hz = 5, start = 1, end = 1 /', &
         & 'end = 1: must be above excitation(1)%start = 1')
      call expect_refused('&excitation kind = ''table'' /', 'file = '''': must be given with kind = ''table''')
      call expect_refused('&excitation kind = ''step'', amplitude = 1, rotating = ''forward'' /', &
         & 'rotating = ''forward'': has no effect with kind = ''step''')
      call expect_refused('&excitation kind = ''chirp'', amplitude = 1, frequency_hz = 5 /', &
         & 'final_frequency_hz: must be given with kind = ''chirp''')
      call expect_refused('&excitation amplitude = 1, frequency_hz = 5 / &excitation amplitude = 1, ' &
         & //'frequency_hz = 5, station = 3 /', 'excitation(2)%station')
      call expect_refused('&excitation amplitude = 1, frequency_hz = 5 / &integration stop_when_periodic = 1e-3 /', &
         & 'stop_when_periodic = 0.001: must be 0 with excitations')
      call expect_refused('&case task = ''branch'' / &branch parameter = ''rotor%mass'', last = 3000, step = 10 / ' &
         & //'&excitation amplitude = 1, frequency_hz = 5 /', 'excitation: has no effect with case%task = ''branch''')
      call expect_refused(periodic//'&excitation amplitude = 1, frequency_ratio = 0.7071067811865 /', &
         & 'must be a fraction of the speed of the shaft whose period is at most 100 revolutions')
      call expect_refused(periodic//'&excitation amplitude = 1, kind = ''step'' /', &
         & 'must be ''harmonic'' for a periodic')
      call expect_refused(periodic//'&excitation amplitude = 1, frequency_ratio = 1, start = 0.1 /', &
         & 'start = 0.1: must be 0 for a periodic orbit')
   end subroutine refused
end program test_excitations
