!> Pads that pitch and yaw: friction of several components, the Jacobian against differences, Newton and Euler, a free
!> pad's eigenvalues, the shaft with its ends exchanged, and an elastic shaft whose slopes count.
program test_pitch_and_yaw
   use kinds, only: wp
   use case_inputs, only: case_type
   use friction, only: friction_law, friction_response, turning_friction, bengisu_akay_friction, lugre_friction, &
      & never_sticks
   use rigid_rotor, only: journal_motion
   use state_layout, only: pad_state, tilt, pitch, yaw
   use kinematics, only: pad_frame, frame_of
   use equations_of_motion, only: machine_model, new_machine_model
   use force_balance, only: find_vibrations, forces
   use factories, only: converged_films
   use sloped_pad, only: of_pad
   use input_cases, only: case_of
   use machine_cases, only: symmetric_rotor
   use check, only: runs, expect, expect_close, between, report
   implicit none (type, external)

   character(len=*), parameter :: motions(4) = [character(len=24) :: 'tilting_pitch', 'tilting_pitch_yaw', &
      & 'tilting_radial_pitch', 'tilting_radial_pitch_yaw']
   !> Of pads on an elastic shaft: fixed, with one friction, with several.
   character(len=*), parameter :: on_shaft(4) = [character(len=24) :: 'fixed', 'tilting_radial', 'tilting_pitch', &
      & 'tilting_radial_pitch_yaw']
   character(len=*), parameter :: frictions(3) = [character(len=12) :: 'none', 'bengisu_akay', 'lugre']
   real(wp), parameter :: rounding = 10*epsilon(1.0_wp)
   integer :: m, f

   if (runs('one_component')) call one_component()
   if (runs('isotropy')) call isotropy()
   if (runs('friction_slopes')) call friction_slopes()
   do m = 1, size(motions)
      do f = 1, size(frictions)
         if (runs('jacobian')) call jacobian(motions(m), frictions(f), .false.)
         if (runs('solutions')) call solutions(motions(m), frictions(f), .false.)
      end do
      if (runs('moments')) call moments(motions(m))
      if (runs('ends_exchanged')) call ends_exchanged(motions(m))
   end do
   do m = 1, size(on_shaft)
      do f = 1, size(frictions)
         if (runs('jacobian')) call jacobian(on_shaft(m), frictions(f), .true.)
         if (runs('solutions')) call solutions(on_shaft(m), frictions(f), .true.)
      end do
   end do
   if (runs('power')) call power()
   if (runs('free_pad')) call free_pad()
   call report()

contains

   !> The laws of the paper, with numbers in which every term counts.
   subroutine make_law(name, law)
      character(len=*), intent(in) :: name
      class(friction_law), allocatable, intent(out) :: law
      select case (name)
      case ('bengisu_akay')
         law = bengisu_akay_friction(.false., 0.2_wp, 0.1_wp, 1e-3_wp, 100.0_wp)
      case ('lugre')
         law = lugre_friction(.true., 0.2_wp, 0.1_wp, never_sticks, 1e-3_wp, 1.5_wp, 1e5_wp, 10.0_wp, 0.7_wp)
      case default
         law = friction_law()
      end select
   end subroutine make_law

   !> With one component, or along an axis, the law is today's.
   subroutine one_component()
      class(friction_law), allocatable :: law
      type(friction_response) :: r
      type(turning_friction) :: v
      real(wp) :: velocity, bristle
      integer :: i, k, n
      do i = 1, size(frictions)
         call make_law(frictions(i), law)
         do k = 1, 20
            velocity = between(-3e-3_wp, 3e-3_wp)
            bristle = between(-2e-6_wp, 2e-6_wp)
            call law%evaluate(velocity, bristle, 1e4_wp, r)
            do n = 1, 3
               call law%evaluate_turning([velocity, 0.0_wp, 0.0_wp], [bristle, 0.0_wp, 0.0_wp], 1e4_wp, v)
               call expect_close(v%force(1), r%force, 1e4*rounding, 'force, '//frictions(i))
               call expect_close(v%rate(1), r%rate, rounding, 'rate, '//frictions(i))
               call expect_close(v%force_normal(1), r%force_normal, 10*rounding, 'over the load, '//frictions(i))
               call expect_close(v%force_velocity(1, 1), r%force_velocity, 1e4*rounding*1e4_wp, 'over the velocity')
               call expect_close(v%rate_velocity(1, 1), r%rate_velocity, 1e3*rounding, 'rate over the velocity')
               call expect_close(v%force_deflection, r%force_deflection, 1e9_wp*rounding, 'over the bristle')
               call expect_close(v%rate_deflection, r%rate_deflection, 1e4*rounding, 'rate over the bristle')
               call expect_close(maxval(abs(v%force(2:))), 0.0_wp, 0.0_wp, 'nothing across')
            end do
         end do
      end do
   end subroutine one_component

   !> Turned velocities and bristles turn the force; no force is larger than the law's.
   subroutine isotropy()
      class(friction_law), allocatable :: law
      type(turning_friction) :: r, turned
      real(wp), dimension(3) :: velocity, bristle
      real(wp) :: a, turn(3, 3)
      integer :: i, k
      do i = 2, size(frictions)
         call make_law(frictions(i), law)
         do k = 1, 20
            a = between(0.0_wp, 6.0_wp)
            turn = reshape([cos(a), sin(a), 0.0_wp, -sin(a), cos(a), 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp], [3, 3])
            if (mod(k, 2) == 0) turn = cshift(cshift(turn, 1, 1), 1, 2)
            velocity = [between(-3e-3_wp, 3e-3_wp), between(-3e-3_wp, 3e-3_wp), between(-3e-3_wp, 3e-3_wp)]
            bristle = [between(-1e-6_wp, 1e-6_wp), between(-1e-6_wp, 1e-6_wp), between(-1e-6_wp, 1e-6_wp)]
            call law%evaluate_turning(velocity, bristle, 1e4_wp, r)
            call law%evaluate_turning(matmul(turn, velocity), matmul(turn, bristle), 1e4_wp, turned)
            call expect_close(norm2(turned%force - matmul(turn, r%force)), 0.0_wp, 1e5_wp*rounding, 'force turns')
            call expect_close(norm2(turned%rate - matmul(turn, r%rate)), 0.0_wp, rounding, 'rate turns')
            if (law%has_bristle) cycle
            call expect(norm2(r%force) <= 0.2_wp*1e4_wp*(1 + rounding), 'not beyond the limit')
            call expect_close(dot_product(r%force, velocity), norm2(r%force)*norm2(velocity), 1e4*rounding, 'along it')
         end do
      end do
   end subroutine isotropy

   !> Central differences.
   subroutine friction_slopes()
      class(friction_law), allocatable :: law
      type(turning_friction) :: r, above, below
      real(wp), dimension(3) :: velocity, bristle, step
      real(wp), parameter :: h = 1e-7_wp
      integer :: i, k, n
      do i = 2, size(frictions)
         call make_law(frictions(i), law)
         do n = 1, 10
            velocity = [between(1e-3_wp, 3e-3_wp), between(-3e-3_wp, 3e-3_wp), between(-3e-3_wp, 3e-3_wp)]
            bristle = [between(-1e-6_wp, 1e-6_wp), between(-1e-6_wp, 1e-6_wp), between(-1e-6_wp, 1e-6_wp)]
            call law%evaluate_turning(velocity, bristle, 1e4_wp, r)
            do k = 1, 3
               step = 0
               step(k) = h
               call law%evaluate_turning(velocity + step, bristle, 1e4_wp, above)
               call law%evaluate_turning(velocity - step, bristle, 1e4_wp, below)
               call expect_close(norm2((above%force - below%force)/(2*h) - r%force_velocity(:, k)), 0.0_wp, &
                  & 1e-5_wp*norm2(r%force_velocity), 'force over velocity, '//frictions(i))
               call expect_close(norm2((above%rate - below%rate)/(2*h) - r%rate_velocity(:, k)), 0.0_wp, &
                  & 1e-5_wp*max(1.0_wp, norm2(r%rate_velocity)), 'rate over velocity, '//frictions(i))
            end do
         end do
      end do
   end subroutine friction_slopes

   !> Every term counts: pads as heavy as the load, centres of gravity and pivots off the middle, a journal that is
   !> inclined.
   type(case_type) function heavy_case(motion, friction) result(inputs)
      character(len=*), intent(in) :: motion, friction
      inputs = case_of('&rotor mass = 20, gravity = 300 / &pads mass = 80, 60, inertia = 0.03, 0.025, ' &
         & //'inertia_pitch = 0.1, 0.09, pivot_ratio = 0.5, 0.6, pivot_axial_offset = 2e-3, -3e-3, ' &
         & //'centre_tangential = 3e-3, -6e-3, motion = '''//trim(motion)//''''//trim(merge(', inertia_yaw = 0.08', &
         & '                    ', index(motion, 'yaw') > 0))//' / &pivot rotational_stiffness = 3e4, 5e4 / ' &
         & //'&friction model = '''//trim(friction)//''' / &film cavitation = ''none'' / ' &
         & //'&asperity model = ''none'' / &bearing slope = 2e-4, -1e-4 /')
   end function heavy_case

   !> A shaft in two bearings whose films count its slopes.
   type(case_type) function shaft_case(motion, friction) result(inputs)
      character(len=*), intent(in) :: motion, friction
      integer :: b
      inputs = symmetric_rotor(trim(friction), 6500.0_wp, 1e-3_wp)
      inputs%rotor%gravity = 0
      do b = 1, 2
         associate (of => inputs%bearings(b))
            of%shaft_slope = 'film'
            of%misalignment = [1e-5_wp, -2e-5_wp]
            of%pads%motion = trim(motion)
            of%pads%inertia_pitch = [2e-3_wp, 3e-3_wp]
            of%pads%inertia_yaw = [4e-3_wp, 3e-3_wp]
            of%pads%pivot_axial_offset = [2e-3_wp, -3e-3_wp]
            of%asperity%model = 'none'
         end associate
      end do
   end function shaft_case

   !> Its model, or that of the journal.
   function model_of(motion, friction, elastic) result(model)
      character(len=*), intent(in) :: motion, friction
      logical, intent(in) :: elastic
      type(machine_model) :: model
      if (elastic) then
         model = new_machine_model(shaft_case(motion, friction), converged_films)
      else
         model = new_machine_model(heavy_case(motion, friction), converged_films)
      end if
   end function model_of

   !> A state with films, which moves.
   function moving_state(model) result(y)
      type(machine_model), intent(in) :: model
      real(wp), allocatable :: y(:)
      type(pad_state) :: pads(model%layout%pads)
      type(journal_motion) :: journal
      integer :: i
      journal = journal_motion([between(-20e-6_wp, 0.0_wp), between(-5e-6_wp, 5e-6_wp)], &
         & [between(-0.02_wp, 0.02_wp), between(-0.02_wp, 0.02_wp)])
      do i = 1, size(pads)
         pads(i) = pad_state(between(-1e-4_wp, 5e-4_wp), between(1.0_wp, 4.0_wp), between(2e-6_wp, 9e-6_wp), &
            & between(-5e-3_wp, 5e-3_wp))
         pads(i)%x([pitch, yaw]) = [between(-2e-4_wp, 2e-4_wp), between(-2e-4_wp, 2e-4_wp)]
         pads(i)%v([pitch, yaw]) = [between(-1.0_wp, 1.0_wp), between(-1.0_wp, 1.0_wp)]
         pads(i)%bristle = [between(-1e-7_wp, 1e-7_wp), between(-1e-7_wp, 1e-7_wp), between(-1e-7_wp, 1e-7_wp)]
      end do
      if (model%rotor%stations == 0) then
         y = model%state(journal, pads)
         return
      end if
      y = model%static_state([(between(-0.2_wp, 0.2_wp)*model%scale(i), i=1, model%rotor%positions)], pads)
      do i = model%rotor%positions + 1, model%rotor%states
         y(i) = between(-0.2_wp, 0.2_wp)*model%scale(i)
      end do
   end function moving_state

   !> Five-point differences with steps of 1e-3 of each state's scale, rates in that of the friction's decay.
   subroutine jacobian(motion, friction, elastic)
      character(len=*), intent(in) :: motion, friction
      logical, intent(in) :: elastic
      real(wp), parameter :: h = 1e-3_wp, offsets(4) = [-2*h, -h, h, 2*h], t = 1.234e-2_wp
      real(wp), parameter :: weights(4) = [1.0_wp, -8.0_wp, 8.0_wp, -1.0_wp]/(12*h)
      type(machine_model) :: model
      real(wp), allocatable :: y(:), trial(:), f(:), found(:, :), expected(:, :), scale(:)
      integer :: column, k, row, b, i
      logical :: ok, all_ok
      real(wp) :: worst
      model = model_of(motion, friction, elastic)
      allocate (f(model%n), found(model%n, model%n), expected(model%n, model%n))
      scale = model%scale
      do b = 1, size(model%bearings)
         associate (of => model%layout%elements(b))
            do k = 1, of%rotations
               scale([(of%before(i), i=1, 2)] + 2*of%rotation(k)) = 0.2_wp
            end do
         end associate
      end do
      y = moving_state(model)
      call model%rhs_and_jacobian(t, y, f, found, all_ok)
      expected = 0
      do column = 1, model%n
         do k = 1, 4
            trial = y
            trial(column) = y(column) + offsets(k)*scale(column)
            call model%rhs(t, trial, f, ok)
            all_ok = all_ok .and. ok
            expected(:, column) = expected(:, column) + weights(k)*f
         end do
         found(:, column) = found(:, column)*scale(column)
      end do
      worst = 0
      do row = 1, model%n
         worst = max(worst, maxval(abs(found(row, :) - expected(row, :)))/maxval(abs(expected(row, :))))
      end do
      call expect(all_ok, 'all states are admitted, '//motion//friction)
      call expect_close(worst, 0.0_wp, 5e-6_wp, 'Jacobian by differences, '//trim(motion)//', '//friction)
   end subroutine jacobian

   !> (1 - gamma J) v = b has the solution v.
   subroutine solutions(motion, friction, elastic)
      character(len=*), intent(in) :: motion, friction
      logical, intent(in) :: elastic
      real(wp), parameter :: gamma = 1e-5_wp
      type(machine_model) :: model
      real(wp), allocatable :: matrix(:, :), v(:), rates(:), b(:)
      integer :: k
      logical :: ok
      model = model_of(motion, friction, elastic)
      allocate (matrix(model%n, model%n), rates(model%n))
      call model%rhs_and_jacobian(0.01_wp, moving_state(model), rates, matrix, ok)
      v = [(between(-1.0_wp, 1.0_wp)*model%scale(k), k=1, model%n)]
      b = v - gamma*matmul(matrix, v)
      if (ok) call model%solve(gamma, b, ok)
      call expect(ok, 'there is a solution, '//motion)
      call expect_close(maxval(abs(b - v)/model%scale), 0.0_wp, 1e-9_wp, 'of the system, '//trim(motion)//', ' &
         & //friction)
   end subroutine solutions

   !> Pitch and yaw by hand: the moments of pressure, of weight beside the pivot and of friction are those of masses.
   subroutine moments(motion)
      character(len=*), intent(in) :: motion
      type(machine_model) :: model
      type(pad_frame) :: frame
      type(pad_state) :: pads(2)
      real(wp), allocatable :: y(:), f(:), masses(:, :), accelerations(:)
      real(wp) :: expected, s, sizes
      integer :: i, k
      logical :: ok
      model = new_machine_model(heavy_case(motion, 'lugre'))
      y = moving_state(model)
      allocate (f(model%n))
      call model%rhs(0.01_wp, y, f, ok)
      call expect(ok, 'a state with films, '//motion)
      associate (bearing => model%bearings(1), of => model%layout%elements(1))
         pads = of%pad_states(y)
         do i = 1, 2
            s = bearing%pads(i)%axial_offset
            frame = frame_of(bearing%pads(i)%position, model%rotor%journal(y(:4), 1), pads(i))
            masses = bearing%coordinates%masses(bearing%pads(i))
            accelerations = [(f(of%before(i) + 2*k), k=1, of%coordinates)]
            associate (film => bearing%sloped%response(i), rub => bearing%sloped%friction(i), pad => bearing%pads(i))
               do k = 1, of%coordinates
                  ! the centre of gravity (C_t, C_r, -s) turns with the pad: its way down is to second order
                  ! s (c yaw + s pitch) + [c (C_t yaw^2 + C_r yaw pitch) + s (C_t yaw pitch + C_r pitch^2)]/2
                  associate (c_t => pad%centre_tangential, c_r => pad%centre_radial, x => pads(i)%x)
                     if (of%kind(k) == pitch) expected = s*film%film%force(2) - film%moment(2) &
                        & - pad%ball_radius*rub%force(2) + pad%weight*(s*frame%s + 0.5_wp*frame%c*c_r*x(yaw) &
                        & + 0.5_wp*frame%s*c_t*x(yaw) + frame%s*c_r*x(pitch))
                     if (of%kind(k) == yaw) expected = s*film%film%force(1) - film%moment(1) &
                        & - pad%ball_radius*rub%force(3) + pad%weight*(s*frame%c + frame%c*c_t*x(yaw) &
                        & + 0.5_wp*(frame%c*c_r + frame%s*c_t)*x(pitch))
                  end associate
                  if (of%kind(k) < pitch) cycle
                  sizes = norm2(film%moment) + pad%ball_radius*norm2(rub%force) + norm2(masses(k, :)*accelerations)
                  call expect_close(dot_product(masses(k, :), accelerations), expected, 1e4*rounding*sizes, &
                     & 'moments about the pivot, '//motion)
               end do
            end associate
         end do
      end associate
   end subroutine moments

   !> With the ends of the shaft exchanged slopes, pitches and yaws have another sign, and the motion is the same.
   subroutine ends_exchanged(motion)
      character(len=*), intent(in) :: motion
      type(case_type) :: inputs
      type(machine_model) :: model, other
      real(wp), allocatable :: y(:), f(:), g(:)
      logical :: ok
      inputs = heavy_case(motion, 'lugre')
      model = new_machine_model(inputs)
      inputs%bearings(1)%slope = -inputs%bearings(1)%slope
      inputs%bearings(1)%pads%pivot_axial_offset = -inputs%bearings(1)%pads%pivot_axial_offset
      other = new_machine_model(inputs)
      y = moving_state(model)
      allocate (f(model%n), g(model%n))
      call model%rhs(0.01_wp, y, f, ok)
      call expect(ok, 'a state, '//motion)
      call other%rhs(0.01_wp, exchanged(model, y), g, ok)
      call expect(ok, 'the other, '//motion)
      call expect_close(maxval(abs(exchanged(model, g) - f)/(abs(f) + 1e-3_wp*model%scale*680**2)), 0.0_wp, 1e-9_wp, &
         & 'ends exchanged, '//motion)
   end subroutine ends_exchanged

   !> A state, or its rates, of pads whose slopes have another sign.
   function exchanged(model, y) result(other_y)
      type(machine_model), intent(in) :: model
      real(wp), intent(in) :: y(:)
      real(wp) :: other_y(size(y))
      type(pad_state) :: pads(2)
      integer :: i
      other_y = y
      pads = model%layout%elements(1)%pad_states(y)
      do i = 1, 2
         pads(i)%x([pitch, yaw]) = -pads(i)%x([pitch, yaw])
         pads(i)%v([pitch, yaw]) = -pads(i)%v([pitch, yaw])
         pads(i)%bristle(2:) = -pads(i)%bristle(2:)
      end do
      call model%layout%put_all_pads(pads, other_y)
   end function exchanged

   !> On a shaft the films' power is that of force and moment in the motion of the journal seen from its pads, but for
   !> what turns with a pad.
   subroutine power()
      type(machine_model) :: model
      real(wp), allocatable :: y(:), all_forces(:), velocity(:)
      real(wp) :: given, expected, size_of_power
      integer, allocatable :: x(:), v(:)
      integer :: b, i
      logical :: ok
      model = model_of('tilting_pitch_yaw', 'none', .true.)
      y = moving_state(model)
      call model%evaluate(0.01_wp, y, .false., ok)
      call expect(ok, 'a state with films')
      call model%pairs(x, v)
      velocity = y(v)
      all_forces = forces(model, 0.01_wp, y)
      associate (n => model%rotor%positions)
         all_forces(:n) = all_forces(:n) - model%rotor%force(y(:2*n), model%point, 0.01_wp)
      end associate
      given = dot_product(all_forces, velocity)
      size_of_power = norm2(all_forces*velocity)
      expected = 0
      do b = 1, 2
         associate (pads => model%layout%elements(b)%pad_states(y), of => model%bearings(b)%sloped)
            do i = 1, 2
               associate (f => of%response(i)%film%force, p => of%response(i)%moment, m => of%motion(i), &
                  & x => pads(i)%x([yaw, pitch]), turns => pads(i)%v(tilt), s => model%bearings(b)%pads(i)%axial_offset)
                  ! the middle plane of a pad on a pivot off it does not turn with the pad, nor do its slopes
                  associate (e => m%middle%position - s*x, g => m%slope + x)
                     expected = expected + dot_product(f, m%middle%velocity) + dot_product(p, m%slope_rate) &
                        & - turns*(f(1)*e(2) - f(2)*e(1) + p(1)*g(2) - p(2)*g(1))
                  end associate
               end associate
            end do
         end associate
      end do
      call expect_close(given, expected, 1e-9_wp*size_of_power, 'power of films')
   end subroutine power

   !> Pitch and yaw of a pad in the film of an aligned journal, by the study behind docs/theory/pitch_and_yaw.md.
   subroutine free_pad()
      type(machine_model) :: model
      type(pad_state) :: pads(2)
      real(wp), dimension(2, 2) :: mass, stiffness, damping
      complex(wp) :: values(4)
      real(wp), allocatable :: y(:)
      real(wp), parameter :: e(2) = [-26e-6_wp, 52e-6_wp]
      real(wp) :: r(2)
      logical :: ok
      integer, parameter :: own(2) = of_pad + [1, 2]
      ! a pad whose pivot angle is 90 degrees has the frame (-z, y), here its first one
      model = new_machine_model(case_of('&pads motion = ''tilting_pitch_yaw'', pivot_angle_deg = 90, 270, ' &
         & //'inertia_pitch = 7.790538016666668e-4, inertia_yaw = 9.777795316666667e-4 / ' &
         & //'&film cavitation = ''none'' / &asperity model = ''none'' /'), converged_films)
      ! the arc's centre lies off the middle by what the pad clearance is more
      r = [e(2) - 20e-6_wp, -e(1)]
      pads = pad_state()
      y = model%static_state(r, pads)
      call model%evaluate(0.0_wp, y, .true., ok, [.true., .false.])
      call expect(ok, 'a film')
      associate (bearing => model%bearings(1))
         call expect_close(maxval(abs(bearing%motion(1)%position - e)), 0.0_wp, 1e-15_wp, 'the place of the study')
         mass = 0
         mass(1, 1) = bearing%pads(1)%inertia_pitch
         mass(2, 2) = bearing%pads(1)%inertia_yaw
         stiffness = bearing%sloped%derivatives(1)%over_positions(own, own)
         damping = bearing%sloped%derivatives(1)%over_rates(own, own)
         call find_vibrations(mass, stiffness, damping, values, ok)
         call expect_close(minval(values%re), -948878.46_wp, 2e-3_wp*948878, 'the fastest')
         call expect_close(maxval(values%re), -574.0005_wp, 2e-3_wp*807, 'growth of the vibration')
         call expect_close(maxval(values%im), 567.1975_wp, 2e-3_wp*807, 'its frequency')
         call find_vibrations(mass(:1, :1), stiffness(:1, :1), damping(:1, :1), values(:2), ok)
         call expect_close(maxval(values(:2)%re), -450.8293_wp, 2e-3_wp*451, 'pitch alone')
      end associate
   end subroutine free_pad
end program test_pitch_and_yaw
