!> Pads with a coordinate of no physics: a mass on a spring and a damper that nothing else knows of.
module oscillating_pads
   use kinds, only: wp
   use film_solver, only: film_motion, film_response
   use asperity_contact, only: asperity_load
   use contact_table, only: contact_table_type
   use friction, only: friction_law
   use state_layout, only: pad_state, of_journal
   use kinematics, only: pad_frame
   use tilting_pad, only: tilting_pad_type, pad_coordinates_type, new_pad_coordinates, coordinate_type, pad_loads, &
      & pad_derivatives
   implicit none (type, external)
   private
   public :: oscillating_pads_type, new_oscillating_pads, third

   !> Its place in pad_state.
   integer, parameter :: third = 3

   type, extends(pad_coordinates_type) :: oscillating_pads_type
      !> What the pads do beside.
      type(pad_coordinates_type) :: own
      !> The oscillator's mass over that of the pad; N/m and N s/m.
      real(wp) :: share = 0.1_wp, stiffness = 1e6_wp, damping = 40
   contains
      procedure :: loads
      procedure :: derivatives
      procedure :: masses
      procedure :: oscillation
   end type oscillating_pads_type

contains

   !> Pads that tilt on rigid or flexible pivots, and have the oscillator.
   type(oscillating_pads_type) function new_oscillating_pads(flexible) result(coordinates)
      logical, intent(in) :: flexible
      coordinates%own = new_pad_coordinates(trim(merge('tilting_radial', 'tilting_only  ', flexible)))
      coordinates%pad_coordinates_type = coordinates%own
      call coordinates%add(third, coordinate_type('third', 'third_coordinate', 'm', 'third coordinate'))
   end function new_oscillating_pads

   pure subroutine loads(self, pad, frame, state, film_force, asperities, contact, friction, answer)
      class(oscillating_pads_type), intent(in) :: self
      type(tilting_pad_type), intent(in) :: pad
      type(pad_frame), intent(in) :: frame
      type(pad_state), intent(in) :: state
      real(wp), intent(in) :: film_force(2)
      type(asperity_load), intent(in) :: asperities
      type(contact_table_type), intent(in) :: contact
      class(friction_law), intent(in) :: friction
      type(pad_loads), intent(inout) :: answer
      call self%pad_coordinates_type%loads(pad, frame, state, film_force, asperities, contact, friction, answer)
      answer%own(self%n) = -self%stiffness*state%x(third) - self%damping*state%v(third)
   end subroutine loads

   pure subroutine derivatives(self, pad, frame, motion, state, film, asperities, loads, answer)
      class(oscillating_pads_type), intent(in) :: self
      type(tilting_pad_type), intent(in) :: pad
      type(pad_frame), intent(in) :: frame
      type(film_motion), intent(in) :: motion
      type(pad_state), intent(in) :: state
      type(film_response), intent(in) :: film
      type(asperity_load), intent(in) :: asperities
      type(pad_loads), intent(in) :: loads
      type(pad_derivatives), intent(inout) :: answer
      call self%pad_coordinates_type%derivatives(pad, frame, motion, state, film, asperities, loads, answer)
      associate (at => of_journal + self%n)
         answer%over_positions(at, :) = 0
         answer%over_rates(at, :) = 0
         answer%over_positions(at, at) = -self%stiffness
         answer%over_rates(at, at) = -self%damping
      end associate
   end subroutine derivatives

   pure function masses(self, pad)
      class(oscillating_pads_type), intent(in) :: self
      type(tilting_pad_type), intent(in) :: pad
      real(wp) :: masses(self%n, self%n)
      masses = 0
      masses(:self%own%n, :self%own%n) = self%own%masses(pad)
      masses(self%n, self%n) = self%share*pad%mass
   end function masses

   !> Eigenvalue of the oscillator of a pad, 1/s: it vibrates.
   pure complex(wp) function oscillation(self, pad)
      class(oscillating_pads_type), intent(in) :: self
      type(tilting_pad_type), intent(in) :: pad
      associate (mass => self%share*pad%mass)
         oscillation = cmplx(-0.5_wp*self%damping/mass, sqrt(self%stiffness/mass - (0.5_wp*self%damping/mass)**2), wp)
      end associate
   end function oscillation
end module oscillating_pads

!> A third coordinate of pads is marched, linearised, written and named, and what pads did without it they do with it.
program test_pad_coordinates
   use kinds, only: wp, i8
   use text, only: to_text
   use errors, only: error_type
   use files, only: delete_file
   use case_inputs, only: case_type
   use factories, only: converged_films
   use rigid_rotor, only: journal_motion
   use state_layout, only: pad_state, tilt, pivot_deflection
   use equations_of_motion, only: machine_model, new_machine_model
   use force_balance, only: forces, force_derivatives, masses, mode_name, position_names, position_lengths
   use equilibrium_record, only: equilibrium_type
   use static_model, only: make_static
   use linear_bearing, only: bearing_coefficients_type, find_coefficients
   use bearing_samples, only: bearing_sample, take_sample
   use march_results, only: add_sample
   use equilibrium_results, only: put_equilibrium
   use record, only: record_type
   use provenance, only: running
   use run_file, only: run_file_type
   use bearing_file, only: new_bearing_file
   use oscillating_pads, only: oscillating_pads_type, new_oscillating_pads, third
   use sampled_march, only: march_samples
   use input_cases, only: case_of
   use machine_orbits, only: stand
   use scratch, only: scratch_path
   use check, only: runs, expect, expect_close, expect_no_error, between, report
   implicit none (type, external)

   character(len=*), parameter :: motions(2) = [character(len=14) :: 'tilting_radial', 'tilting_only']
   character(len=*), parameter :: frictions(2) = [character(len=5) :: 'none', 'lugre']
   integer :: m, f

   do m = 1, size(motions)
      do f = 1, size(frictions)
         if (runs('jacobian')) call jacobian(motions(m), frictions(f))
         if (runs('solutions')) call solutions(motions(m), frictions(f))
         if (runs('balance')) call balance(motions(m), frictions(f))
      end do
      if (runs('marched')) call marched(motions(m))
      if (runs('modes')) call modes(motions(m))
      if (runs('written')) call written(motions(m))
   end do
   if (runs('equilibrium_written')) call equilibrium_written()
   if (runs('named')) call named()
   call report()

contains

   !> Two pads that differ, on films that are smooth.
   type(case_type) function two_pads(motion, friction) result(inputs)
      character(len=*), intent(in) :: motion, friction
      inputs = case_of('&pads mass = 0.8, 0.5, inertia = 4e-4, 3e-4, centre_tangential = 2e-3, -3e-3, motion = ''' &
         & //trim(motion)//''' / &friction model = '''//trim(friction)//''' / &film solver = ''fourier'', ' &
         & //'cavitation = ''none'' / &output keep = ''last_revolutions'' /')
   end function two_pads

   !> A model whose pads have the oscillator, which takes the third place, or the second on rigid pivots.
   subroutine make(inputs, model, coordinates)
      type(case_type), intent(in) :: inputs
      type(machine_model), intent(out) :: model
      type(oscillating_pads_type), intent(out) :: coordinates
      coordinates = new_oscillating_pads(inputs%bearings(1)%tilting_radial())
      model = new_machine_model(inputs, converged_films)
      call model%bearings(1)%set_coordinates(coordinates)
      call model%lay_out()
   end subroutine make

   !> Journal and pads that carry, in motion, away from the switching points of friction, and oscillators in theirs.
   function moving_state(model) result(y)
      type(machine_model), intent(in) :: model
      real(wp) :: y(model%n)
      type(pad_state) :: pads(2)
      integer :: i
      do i = 1, 2
         pads(i) = pad_state(merge(-1e-4_wp, 7e-4_wp, i == 1), between(0.3_wp, 0.6_wp), between(4e-6_wp, 8e-6_wp), &
            & between(-2e-3_wp, 2e-3_wp), 1e-7_wp)
         pads(i)%x(third) = between(-1e-5_wp, 1e-5_wp)
         pads(i)%v(third) = between(-1e-2_wp, 1e-2_wp)
      end do
      y = model%state(journal_motion([-30e-6_wp, 2e-6_wp], [1e-3_wp, -2e-3_wp]), pads)
   end function moving_state

   !> Where the oscillators of both pads stand among the states.
   pure function displaced(model) result(places)
      type(machine_model), intent(in) :: model
      integer :: places(2)
      associate (of => model%layout%elements(1))
         places = of%before([1, 2]) + 2*of%coordinates - 1
      end associate
   end function displaced

   !> The other states.
   pure function others(model) result(places)
      type(machine_model), intent(in) :: model
      integer, allocatable :: places(:)
      integer :: i
      places = [(i, i=1, model%n)]
      associate (x => displaced(model))
         places = pack(places, [(all(i /= x .and. i /= x + 1), i=1, model%n)])
      end associate
   end function others

   !> Rates and Jacobian are those of the pads without it and, by hand, those of the oscillators.
   subroutine jacobian(motion, friction)
      character(len=*), intent(in) :: motion, friction
      type(machine_model) :: model, plain
      type(oscillating_pads_type) :: coordinates
      real(wp), allocatable, dimension(:) :: y, f, f0
      real(wp), allocatable, dimension(:, :) :: found, of_plain, expected
      character(len=:), allocatable :: what
      integer, allocatable :: rest(:)
      integer :: i, row
      logical :: ok, plain_ok
      what = trim(motion)//', '//trim(friction)
      call make(two_pads(motion, friction), model, coordinates)
      plain = new_machine_model(two_pads(motion, friction), converged_films)
      call expect(model%n == plain%n + 4, 'displacement and rate of two pads more, '//what)
      y = moving_state(model)
      rest = others(model)
      allocate (f, mold=y)
      allocate (f0(plain%n), found(model%n, model%n), of_plain(plain%n, plain%n))
      call model%rhs_and_jacobian(0.01_wp, y, f, found, ok)
      call plain%rhs_and_jacobian(0.01_wp, y(rest), f0, of_plain, plain_ok)
      call expect(ok .and. plain_ok, 'a state with films, '//what)
      allocate (expected(model%n, model%n), source=0.0_wp)
      expected(rest, rest) = of_plain
      do i = 1, 2
         associate (x => displaced(model), mass => coordinates%share*model%bearings(1)%pads(i)%mass)
            associate (acceleration => -(coordinates%stiffness*y(x(i)) + coordinates%damping*y(x(i) + 1))/mass)
               call expect_close(f(x(i)), y(x(i) + 1), 0.0_wp, 'rate, '//what)
               call expect_close(f(x(i) + 1), acceleration, 1e-14_wp*abs(acceleration), 'acceleration, '//what)
            end associate
            expected(x(i), x(i) + 1) = 1
            expected(x(i) + 1, x(i)) = -coordinates%stiffness/mass
            expected(x(i) + 1, x(i) + 1) = -coordinates%damping/mass
         end associate
      end do
      do row = 1, size(rest)
         call expect_close(f(rest(row)), f0(row), 1e-13_wp*maxval(abs(f0)), 'other states, '//what)
      end do
      do row = 1, model%n
         call expect_close(maxval(abs(found(row, :) - expected(row, :))), 0.0_wp, &
            & 1e-13_wp*maxval(abs(expected(row, :))), 'row '//to_text(row)//' of the Jacobian, '//what)
      end do
      call by_differences(model, y, found, what)
   end subroutine jacobian

   !> Five-point differences with steps of 1e-3 of the scales: error 1e-12 of the fifth derivative, some 1e3, rounding
   !> 1e-13; each row by its largest entry, all in the scales of the states.
   subroutine by_differences(model, y, matrix, what)
      type(machine_model), intent(inout) :: model
      real(wp), intent(in) :: y(:), matrix(:, :)
      character(len=*), intent(in) :: what
      real(wp), parameter :: h = 1e-3_wp, offsets(4) = [-2*h, -h, h, 2*h]
      real(wp), parameter :: weights(4) = [1.0_wp, -8.0_wp, 8.0_wp, -1.0_wp]/(12*h)
      real(wp) :: trial(size(y)), f(size(y)), expected(size(y), size(y)), step(size(y))
      integer :: column, k, row
      logical :: ok
      step = model%scale
      ! in the scale of the friction's decay, 1 mm/s at the ball
      step(model%layout%elements(1)%before([1, 2]) + 2) = 0.2_wp
      expected = 0
      ok = .true.
      do column = 1, size(y)
         do k = 1, size(offsets)
            trial = y
            trial(column) = y(column) + offsets(k)*step(column)
            if (ok) call model%rhs(0.01_wp, trial, f, ok)
            expected(:, column) = expected(:, column) + weights(k)*f
         end do
      end do
      call expect(ok, 'all states are admitted, '//what)
      do row = 1, size(y)
         call expect_close(maxval(abs(matrix(row, :)*step - expected(row, :))), 0.0_wp, &
            & 2e-6_wp*maxval(abs(expected(row, :))), 'row '//to_text(row)//' by differences, '//what)
      end do
   end subroutine by_differences

   !> (1 - gamma J) v = b has the solution v.
   subroutine solutions(motion, friction)
      character(len=*), intent(in) :: motion, friction
      real(wp), parameter :: gamma = 1e-5_wp
      type(machine_model) :: model
      type(oscillating_pads_type) :: coordinates
      real(wp), allocatable :: matrix(:, :), v(:), rates(:), b(:)
      integer :: k
      logical :: ok
      call make(two_pads(motion, friction), model, coordinates)
      allocate (matrix(model%n, model%n), rates(model%n))
      call model%rhs_and_jacobian(0.01_wp, moving_state(model), rates, matrix, ok)
      v = [(between(-1.0_wp, 1.0_wp)*model%scale(k), k=1, model%n)]
      b = v - gamma*matmul(matrix, v)
      associate (x => displaced(model))
         call expect(maxval(abs(b(x) - v(x))/model%scale(x)) > 1e-3_wp, 'oscillators count, '//motion)
      end associate
      if (ok) call model%solve(gamma, b, ok)
      call expect(ok, 'there is a solution, '//motion)
      call expect_close(maxval(abs(b - v)/model%scale), 0.0_wp, 1e-9_wp, 'of the linear system, '//motion)
   end subroutine solutions

   !> Forces are masses times accelerations, and their derivatives those of the Jacobian.
   subroutine balance(motion, friction)
      character(len=*), intent(in) :: motion, friction
      type(machine_model) :: model
      type(oscillating_pads_type) :: coordinates
      real(wp), allocatable, dimension(:, :) :: matrix, over_positions, over_rates
      real(wp), allocatable :: y(:), rates(:)
      integer :: n
      logical :: ok
      call make(two_pads(motion, friction), model, coordinates)
      y = moving_state(model)
      n = model%layout%n_positions()
      allocate (matrix(model%n, model%n), rates(model%n), over_positions(n, n), over_rates(n, n))
      call model%rhs_and_jacobian(0.01_wp, y, rates, matrix, ok)
      call expect(ok, 'a state with films, '//motion)
      call force_derivatives(model, over_positions, over_rates)
      associate (x => model%layout%positions(), v => model%layout%rates(), mass => masses(model))
         call compare(spread(matmul(mass, rates(v)), 2, 1), spread(forces(model, 0.01_wp, y), 2, 1), 'forces')
         call compare(matmul(mass, matrix(v, x)), over_positions, 'over positions')
         call compare(matmul(mass, matrix(v, v)), over_rates, 'over rates')
      end associate
   end subroutine balance

   subroutine compare(found, expected, what)
      real(wp), intent(in) :: found(:, :), expected(:, :)
      character(len=*), intent(in) :: what
      integer :: row
      do row = 1, size(found, 1)
         call expect_close(maxval(abs(found(row, :) - expected(row, :))), 0.0_wp, &
            & 1e-12_wp*maxval(abs(expected(row, :))), 'row '//to_text(row)//', '//what)
      end do
   end subroutine compare

   !> Oscillators decay as the closed form says, and the other states go as they do without: a step's error is the
   !> tolerance in the scale of each state.
   subroutine marched(motion)
      character(len=*), intent(in) :: motion
      real(wp), parameter :: interval = 5e-5_wp, tolerance = 1e-9_wp
      integer, parameter :: n = 40
      type(machine_model), target :: model, plain
      type(oscillating_pads_type) :: coordinates
      real(wp), allocatable :: y(:), states(:, :), of_plain(:, :)
      integer, allocatable :: rest(:)
      complex(wp) :: root, amplitude
      real(wp) :: expected(n), worst
      integer :: i, k
      call make(two_pads(motion, 'none'), model, coordinates)
      plain = new_machine_model(two_pads(motion, 'none'), converged_films)
      y = moving_state(model)
      rest = others(model)
      allocate (states(model%n, n), of_plain(plain%n, n))
      call march_samples(model, model%scale, [tolerance, tolerance], y, 0.0_wp, interval, states)
      call march_samples(plain, plain%scale, [tolerance, tolerance], y(rest), 0.0_wp, interval, of_plain)
      do i = 1, 2
         associate (x => displaced(model))
            root = coordinates%oscillation(model%bearings(1)%pads(i))
            ! x = Re(a exp(root t)), with what x and x' are at 0
            amplitude = cmplx(y(x(i)), (root%re*y(x(i)) - y(x(i) + 1))/root%im, wp)
            expected = [(real(amplitude*exp(root*interval*(k - 1))), k=1, n)]
            call expect(minval(expected) < -1e-7_wp .and. maxval(expected) > 1e-7_wp, 'it vibrates, '//motion)
            call expect_close(maxval(abs(states(x(i), :) - expected)), 0.0_wp, 1e-6_wp*model%scale(x(i)), &
               & 'the oscillator of pad '//to_text(i)//' decays, '//motion)
            expected = [(real(root*amplitude*exp(root*interval*(k - 1))), k=1, n)]
            call expect_close(maxval(abs(states(x(i) + 1, :) - expected)), 0.0_wp, 1e-5_wp*maxval(abs(expected)), &
               & 'and so does its rate, '//motion)
         end associate
      end do
      worst = maxval(abs(states(rest, :) - of_plain)/spread(plain%scale, 2, n))
      call expect_close(worst, 0.0_wp, 1e-5_wp, 'the other states, '//motion)
      call expect(maxval(abs(of_plain(:, n) - of_plain(:, 1))/plain%scale) > 0.1_wp, 'which move, '//motion)
   end subroutine marched

   !> The modes of oscillators are among those of journal and pads, with their names; the others are those without.
   subroutine modes(motion)
      character(len=*), intent(in) :: motion
      type(machine_model) :: model, static, plain
      type(oscillating_pads_type) :: coordinates
      type(equilibrium_type) :: at_rest
      type(bearing_coefficients_type) :: found, without
      type(error_type), allocatable :: error
      integer :: i, k
      call stand(two_pads(motion, 'none'), plain, at_rest)
      call make(two_pads(motion, 'none'), model, coordinates)
      call make_static(model, .false., static)
      call find_coefficients(static, static%static_state(at_rest%rotor, at_rest%pads), found, error)
      call expect_no_error(error, 'with oscillators, '//motion)
      call make_static(plain, .false., static)
      call find_coefficients(static, static%static_state(at_rest%rotor, at_rest%pads), without, error)
      call expect_no_error(error, 'without, '//motion)
      if (.not. allocated(found%modes) .or. .not. allocated(without%modes)) return
      associate (of => found%modes(1), plain_modes => without%modes(1)%eigenvalue)
         call expect(size(of%eigenvalue) == size(plain_modes) + 2, 'a mode of each, '//motion)
         do i = 1, 2
            associate (root => coordinates%oscillation(model%bearings(1)%pads(i)))
               k = minloc(abs(of%eigenvalue - root), dim=1)
               call expect_close(abs(of%eigenvalue(k) - root), 0.0_wp, 1e-8_wp*abs(root), 'its eigenvalue, '//motion)
               call expect(of%name(k) == 'pad '//to_text(i)//', third', 'its name: '//trim(of%name(k)))
            end associate
         end do
         do i = 1, size(plain_modes)
            call expect_close(minval(abs(of%eigenvalue - plain_modes(i))), 0.0_wp, 1e-8_wp*maxval(abs(plain_modes)), &
               & 'mode '//to_text(i)//' of those without, '//motion)
         end do
      end associate
      call expect_close(maxval(abs(found%stiffness - without%stiffness)), 0.0_wp, &
         & 1e-9_wp*maxval(abs(without%stiffness)), 'the journal meets no more stiffness, '//motion)
   end subroutine modes

   !> A sample has its displacement and rate in series of their own.
   subroutine written(motion)
      character(len=*), intent(in) :: motion
      type(machine_model) :: model
      type(oscillating_pads_type) :: coordinates
      type(run_file_type), target :: file
      type(bearing_sample) :: sample(1)
      type(error_type), allocatable :: error
      type(case_type) :: inputs
      real(wp), allocatable :: y(:), values(:, :)
      real(wp) :: none(2, 0), no_elements(2, 0, 2)
      real(wp), allocatable :: room(:)
      character(len=:), allocatable :: path
      integer :: k
      logical :: ok
      inputs = two_pads(motion, 'lugre')
      call make(inputs, model, coordinates)
      y = moving_state(model)
      call model%evaluate(0.0_wp, y, .true., ok)
      call expect(ok, 'a state with films, '//motion)
      path = scratch_path('third.h5')
      call file%hdf5%claim(path, error)
      if (.not. allocated(error)) call file%start(inputs, error)
      call expect_no_error(error, 'a file, '//motion)
      if (allocated(error)) return
      call file%begin_series('time', 2_i8)
      do k = 1, 2
         call take_sample(model, 1e-3_wp*k, k*y, model%output(0*y), 1, sample(1))
         call add_sample(file, model%point, 1e-3_wp*k, [new_bearing_file(file, inputs%bearings(1))], sample, none, &
            & none, no_elements, room, error)
         call expect_no_error(error, 'a sample, '//motion)
      end do
      associate (x => displaced(model))
         call file%hdf5%last_samples('third_coordinate', 2, values)
         call expect(all(abs(values - reshape([y(x), 2*y(x)], [2, 2])) <= 0), 'displacements, '//motion)
         call file%hdf5%last_samples('third_coordinate_rate', 2, values)
         call expect(all(abs(values - reshape([y(x + 1), 2*y(x + 1)], [2, 2])) <= 0), 'rates, '//motion)
      end associate
      call file%hdf5%last_samples('pad_tilt', 2, values)
      call expect(all(abs(values(:, 1) - y(model%layout%elements(1)%before([1, 2]) + 1)) <= 0), 'tilts, '//motion)
      call file%hdf5%last_samples('bristle_deflection', 2, values)
      call expect(all(abs(values(:, 1) - y(model%layout%elements(1)%bristle([1, 2]))) <= 0), 'bristles, '//motion)
      call expect(file%hdf5%has_series('pivot_deflection') .eqv. inputs%bearings(1)%tilting_radial(), &
         & 'pivot deflections, '//motion)
      ! a checkpoint has the series in the record, with their units
      call file%checkpoint(2e-3_wp, running, '', error, y)
      call expect_no_error(error, 'a checkpoint, '//motion)
      call expect_described(file%record_type, 'third_coordinate', 'm', 'third coordinate')
      call expect_described(file%record_type, 'third_coordinate_rate', 'm/s', 'third coordinate rate')
      call file%abandon()
      call delete_file(path)
   end subroutine written

   !> A dataset that is named so, or behind a number or a group, has these units and this meaning.
   subroutine expect_described(results, name, units, long_name)
      class(record_type), intent(in) :: results
      character(len=*), intent(in) :: name, units, long_name
      integer :: k
      do k = 1, results%count
         associate (of => results%datasets(k))
            if (of%path(max(1, len(of%path) - len(name)):) /= '_'//name .and. &
               & of%path(max(1, len(of%path) - len(name)):) /= '/'//name) cycle
            call expect(of%units == units .and. of%long_name == long_name, name//' in '//of%units//': '//of%long_name)
            return
         end associate
      end do
      call expect(.false., name//' is there')
   end subroutine expect_described

   !> The equilibrium in a file has it beside tilt and pivot deflection.
   subroutine equilibrium_written()
      type(oscillating_pads_type) :: coordinates
      type(equilibrium_type) :: found
      type(record_type) :: results
      real(wp) :: values(2)
      coordinates = new_oscillating_pads(.true.)
      found%rotor = [1e-5_wp, 2e-5_wp]
      found%pads = [pad_state(1e-4_wp, deflection=3e-6_wp), pad_state(2e-4_wp, deflection=4e-6_wp)]
      found%pads%x(third) = [5e-6_wp, 6e-6_wp]
      found%pivot_load = [1e4_wp, 2e4_wp]
      found%min_film_thickness = [3e-5_wp, 4e-5_wp]
      found%max_pressure = [1e6_wp, 2e6_wp]
      call put_equilibrium(results, found, coordinates)
      call results%get_list('equilibrium/third_coordinate', values)
      call expect(all(abs(values - found%pads%x(third)) <= 0), 'third coordinate')
      call results%get_list('equilibrium/pad_tilt', values)
      call expect(all(abs(values - found%pads%x(tilt)) <= 0), 'tilt')
      call results%get_list('equilibrium/pivot_deflection', values)
      call expect(all(abs(values - found%pads%x(pivot_deflection)) <= 0), 'pivot deflection')
      call expect_described(results, 'third_coordinate', 'm', 'third coordinate')
   end subroutine equilibrium_written

   !> Positions of a bearing, and the modes in which they move.
   subroutine named()
      type(machine_model) :: model
      type(oscillating_pads_type) :: coordinates
      complex(wp) :: shape(8)
      call make(two_pads('tilting_radial', 'none'), model, coordinates)
      call expect(all(position_names(model, 1) == [character(len=19) :: 'y', 'z', 'tilt_1', 'pivot_deflection_1', &
         & 'third_1', 'tilt_2', 'pivot_deflection_2', 'third_2']), 'positions')
      shape = 0
      shape(8) = 1
      call expect(mode_name(model, shape, position_lengths(model), .true.) == 'pad 2, third', 'a mode of one pad')
      shape(5) = 2
      call expect(mode_name(model, shape, position_lengths(model), .true.) == 'pads, third', 'a mode of both')
      associate (arm => model%bearings(1)%pads%position%centre_distance)
         call expect(all(abs(position_lengths(model) - [1.0_wp, 1.0_wp, arm(1), 1.0_wp, 1.0_wp, arm(2), 1.0_wp, &
            & 1.0_wp]) <= 0), 'a unit of it is 1 m')
      end associate
   end subroutine named
end program test_pad_coordinates
