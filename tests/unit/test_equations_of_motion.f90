!> The equations of motion: Jacobian, unbalance and run-up, what is refused.
program test_equations_of_motion
   use kinds, only: wp
   use text, only: to_text
   use case_groups, only: unset
   use case_inputs, only: case_type
   use rigid_rotor, only: journal_motion
   use operating_point, only: operating_point_type
   use tilting_pad_bearing, only: pad_sample
   use state_layout, only: pad_state, tilt, pivot_deflection
   use equations_of_motion, only: machine_model, new_machine_model
   use input_cases, only: case_of, listed
   use check, only: runs, expect, expect_close, between, report
   implicit none (type, external)

   character(len=*), parameter :: motions(2) = [character(len=14) :: 'tilting_radial', 'tilting_only']
   character(len=*), parameter :: frictions(3) = [character(len=12) :: 'none', 'bengisu_akay', 'lugre']
   integer :: m, f

   do m = 1, size(motions)
      do f = 1, size(frictions)
         if (runs('jacobian_by_differences')) then
            call jacobian_by_differences(motions(m), frictions(f), 0.0_wp)
            call jacobian_by_differences(motions(m), frictions(f), 0.003_wp)
         end if
         if (runs('solutions')) call solutions(motions(m), frictions(f))
      end do
      if (runs('trivial_rows')) call trivial_rows(motions(m))
   end do
   if (runs('fixed_pads')) then
      call fixed_pads()
      call jacobian_by_differences('fixed', 'none', 0.0_wp)
      call solutions('fixed', 'none')
   end if
   if (runs('other_numbers')) then
      call other_numbers('&pivot law = ''linear'', stiffness = ', '1e9, 2e9', '1e9, 3e9')
      call other_numbers('&pivot law = ''rocker'', socket_radius = 0.08, radius_difference = 0.02, contact_length = ', &
         & '0.05', '0.03')
      call other_numbers('&pivot rotational_stiffness = ', '1e3, 2e3', '1e3, 0')
   end if
   if (runs('unbalance_force')) call unbalance_force()
   if (runs('forces_by_definition')) call forces_by_definition()
   if (runs('refusals')) call refusals()
   call report()

contains

   type(case_type) function paper_case(motion, friction) result(inputs)
      character(len=*), intent(in) :: motion, friction
      inputs = case_type()
      inputs%bearings(1)%pads%motion = trim(motion)
      inputs%bearings(1)%friction%model = trim(friction)
   end function paper_case

   !> A case in which every term counts: pads as heavy as the load, their centres off the pivots' radius,
   !> different from each other, and a film without cavitation, hence smooth.
   type(case_type) function heavy_case(motion, friction, offset) result(inputs)
      character(len=*), intent(in) :: motion, friction
      real(wp), intent(in) :: offset
      inputs = case_of('&rotor mass = 20, gravity = 300 / &pads mass = 80, 60, inertia = 0.03, 0.025, ' &
         & //'pivot_ratio = 0.5, 0.6, centre_tangential = '//listed([offset, -2*offset])//', motion = ''' &
         & //trim(motion)//''' / &pivot rotational_stiffness = '//trim(merge('0       ', '3e4, 5e4', &
         & motion == 'fixed'))//' / &friction model = '''//trim(friction)//''' / &film solver = ''sor'', ' &
         & //'cavitation = ''none'', circumferential_cells = 16, axial_cells = 4, tolerance = 1e-12 /')
   end function heavy_case

   !> Steps of h = 1e-3 of each state's scale in the five-point form: error h**4/30 of the fifth derivative
   !> (1e-12 times some 1e3), film converged to 1e-12, amplified by 50 and divided by h: 1e-7. Each row is
   !> measured by its largest entry, all in the scales of the states. The pads' own weight makes
   !> 1e-3 and more of the rows it stands in, centrifugal terms 1e-4, so 2e-6 sees all of them.
   subroutine jacobian_by_differences(motion, friction, offset)
      character(len=*), intent(in) :: motion, friction
      real(wp), intent(in) :: offset
      real(wp), parameter :: h = 1e-3_wp, offsets(4) = [-2*h, -h, h, 2*h]
      real(wp), parameter :: weights(4) = [1.0_wp, -8.0_wp, 8.0_wp, -1.0_wp]/(12*h), t = 1.234e-2_wp
      type(machine_model) :: model
      real(wp), allocatable :: y(:), trial(:), f(:), found(:, :), expected(:, :)
      integer :: column, k, row, repeat
      logical :: ok, all_ok
      real(wp) :: worst
      character(len=:), allocatable :: what
      what = trim(motion)//', '//trim(friction)//', C_xi = '//to_text(offset)
      model = new_machine_model(heavy_case(motion, friction, offset))
      allocate (f(model%n), found(model%n, model%n), expected(model%n, model%n))
      worst = 0
      all_ok = .true.
      do repeat = 1, 3
         y = moving_state(model)
         call model%rhs_and_jacobian(t, y, f, found, ok)
         all_ok = all_ok .and. ok
         do column = 1, model%n
            expected(:, column) = 0
            do k = 1, 4
               trial = y
               trial(column) = y(column) + offsets(k)*step_scale(model, column)
               call model%rhs(t, trial, f, ok)
               all_ok = all_ok .and. ok
               expected(:, column) = expected(:, column) + weights(k)*f
            end do
            found(:, column) = found(:, column)*step_scale(model, column)
         end do
         do row = 1, model%n
            worst = max(worst, maxval(abs(found(row, :) - expected(row, :)))/maxval(abs(expected(row, :))))
         end do
      end do
      call expect(all_ok, 'all states are admitted, '//what)
      call expect_close(worst, 0.0_wp, 2e-6_wp, 'Jacobian by differences, '//what)
   end subroutine jacobian_by_differences

   !> (1 - gamma J) v = b has the solution v, to rounding in the scale of each
   !> state: with gamma of some steps' length the matrix is far from the identity.
   subroutine solutions(motion, friction)
      character(len=*), intent(in) :: motion, friction
      real(wp), parameter :: t = 1.234e-2_wp, gamma = 1e-5_wp
      type(machine_model) :: model
      real(wp), allocatable :: matrix(:, :), v(:), rates(:), b(:)
      integer :: k
      logical :: ok
      character(len=:), allocatable :: what
      what = trim(motion)//', '//trim(friction)
      model = new_machine_model(heavy_case(motion, friction, 0.003_wp))
      allocate (matrix(model%n, model%n), rates(model%n))
      call model%rhs_and_jacobian(t, moving_state(model), rates, matrix, ok)
      call expect(ok, 'the state is admitted, '//what)
      v = [(between(-1.0_wp, 1.0_wp)*model%scale(k), k=1, model%n)]
      b = v - gamma*matmul(matrix, v)
      call expect(maxval(abs(b - v)/model%scale) > 0.1_wp, 'the matrix is not the identity, '//what)
      call model%solve(gamma, b, ok)
      call expect(ok, 'there is a solution, '//what)
      call expect_close(maxval(abs(b - v)/model%scale), 0.0_wp, 1e-9_wp, 'of the linear system, '//what)
   end subroutine solutions

   !> The scale of a state; tilt rates are stepped in the scale of the friction's decay, 1 mm/s at the ball.
   pure real(wp) function step_scale(model, column)
      type(machine_model), intent(in) :: model
      integer, intent(in) :: column
      integer :: pad
      step_scale = model%scale(column)
      do pad = 1, 2
         if (column == model%layout%elements(1)%before(pad) + 2) step_scale = 0.2_wp
      end do
   end function step_scale

   !> Pads carrying, tilted, in motion, sliding at some mm/s: away from the switching points at rest and at v_c.
   function moving_state(model) result(y)
      type(machine_model), intent(in) :: model
      real(wp), allocatable :: y(:)
      integer :: pad
      y = model%static_state([between(-40e-6_wp, -20e-6_wp), between(-5e-6_wp, 5e-6_wp)], &
         & [pad_state(between(-1e-4_wp, 1e-4_wp), deflection=between(4e-6_wp, 8e-6_wp)), &
         & pad_state(between(6e-4_wp, 8e-4_wp), deflection=between(4e-6_wp, 8e-6_wp))])
      y(3:4) = [between(-5e-3_wp, 5e-3_wp), between(-5e-3_wp, 5e-3_wp)]
      if (.not. model%layout%elements(1)%has(tilt)) return
      do pad = 1, 2
         associate (of => model%layout%elements(1))
            y(of%before(pad) + 2) = sign(between(0.3_wp, 0.6_wp), between(-1.0_wp, 1.0_wp))
            if (of%has(pivot_deflection)) y(of%before(pad) + 4) = between(-2e-3_wp, 2e-3_wp)
            if (of%bristles) y(of%bristle(pad)) = between(-1e-7_wp, 1e-7_wp)
         end associate
      end do
   end function moving_state

   !> Positions grow at their rates, and every entry of the right-hand side is set.
   subroutine trivial_rows(motion)
      character(len=*), intent(in) :: motion
      type(machine_model) :: model
      real(wp), allocatable :: y(:), f(:)
      logical :: ok
      integer :: pad
      model = new_machine_model(heavy_case(motion, 'lugre', 0.003_wp))
      y = moving_state(model)
      allocate (f(model%n), source=huge(1.0_wp))
      call model%rhs(0.0_wp, y, f, ok)
      call expect(ok .and. all(f < huge(f)), 'every rate is set, '//motion)
      call expect_close(norm2(f(1:2) - y(3:4)), 0.0_wp, 0.0_wp, 'rates of the journal, '//motion)
      do pad = 1, 2
         associate (of => model%layout%elements(1))
            call expect_close(f(of%before(pad) + 1), y(of%before(pad) + 2), 0.0_wp, &
               & 'rate of the tilt, '//motion)
            if (.not. of%has(pivot_deflection)) cycle
            call expect_close(f(of%before(pad) + 3), y(of%before(pad) + 4), 0.0_wp, &
               & 'rate of the pivot deflection')
         end associate
      end do
   end subroutine trivial_rows

   !> A model that takes another number of its pivots moves as one made with it.
   subroutine other_numbers(group, before, after)
      character(len=*), intent(in) :: group, before, after
      type(machine_model) :: model, anew
      real(wp), allocatable :: y(:), f(:), expected(:)
      logical :: ok(3)
      model = new_machine_model(case_of(group//before//' /'))
      anew = new_machine_model(case_of(group//after//' /'))
      y = moving_state(model)
      allocate (f(model%n), expected(model%n))
      call model%rhs(0.0_wp, y, f, ok(1))
      call anew%rhs(0.0_wp, y, expected, ok(2))
      call expect(maxval(abs(f - expected)) > 1, 'the number counts: '//group)
      call model%adopt(case_of(group//after//' /'), anew=.true.)
      call model%rhs(0.0_wp, y, f, ok(3))
      call expect(all(ok), 'states are admitted: '//group)
      call expect_close(maxval(abs(f - expected)), 0.0_wp, 1e-9_wp*maxval(abs(expected)), 'taken: '//group)
   end subroutine other_numbers

   !> Only the journal moves, by the films of pads as they stand without tilt; masses do not matter.
   subroutine fixed_pads()
      type(case_type) :: inputs
      type(machine_model) :: fixed, tilting
      real(wp), allocatable :: y(:), f(:), f_tilting(:)
      logical :: ok, tilting_ok
      inputs = paper_case('tilting_only', 'none')
      ! tables of fixed pads have shorter cells
      inputs%bearings(1)%film%solver = 'direct'
      tilting = new_machine_model(inputs)
      inputs%bearings(1)%pads%motion = 'fixed'
      inputs%bearings(1)%pads%mass = unset
      inputs%bearings(1)%pads%inertia = unset
      fixed = new_machine_model(inputs)
      call expect(fixed%n == 4 .and. size(fixed%scale) == 4, 'the states of the journal')
      associate (w => fixed%point%speed(0.0_wp))
         call expect_close(maxval(abs(fixed%scale/[1.0_wp, 1.0_wp, w, w] - 80e-6_wp)), 0.0_wp, 1e-18_wp, 'their scales')
      end associate
      y = fixed%state(journal_motion([-3e-5_wp, 4e-6_wp], [2e-3_wp, -1e-3_wp]), spread(pad_state(), 1, 2))
      allocate (f(fixed%n), f_tilting(tilting%n))
      call fixed%rhs(1e-3_wp, y, f, ok)
      call tilting%rhs(1e-3_wp, tilting%state(journal_motion(y(1:2), y(3:4)), spread(pad_state(), 1, 2)), f_tilting, &
         & tilting_ok)
      call expect(ok .and. tilting_ok, 'both have films')
      call expect_close(norm2(f - f_tilting(:4)), 0.0_wp, 0.0_wp, 'the same motion')
      call expect(size(fixed%positions(y)) == 2, 'positions to compare')
   end subroutine fixed_pads

   !> The unbalance pulls like a mass on the shaft: with the shaft's angle phi(t) its force is
   !> -dmE d2/dt2 (cos phi, sin phi), in steady running and in run-up. Five-point differences of a step
   !> d = 1e-2/w: error (w d)**4/90 = 1e-10, rounding of angles up to 100 rad 1e-14/(w d)**2 = 1e-10.
   subroutine unbalance_force()
      type(case_type) :: inputs
      type(machine_model) :: with, without
      real(wp), allocatable :: y(:), f(:), f0(:)
      real(wp) :: t, d, expected(2)
      logical :: ok
      integer :: k
      inputs = paper_case('tilting_radial', 'none')
      inputs%operation%speed_rpm = 1500
      inputs%operation%duration = 0.5_wp
      do k = 0, 5
         inputs%operation%final_speed_rpm = merge(1500, 60000, k < 2)
         inputs%rotor%unbalance = 0.5_wp
         with = new_machine_model(inputs)
         inputs%rotor%unbalance = 0
         without = new_machine_model(inputs)
         y = with%static_state([-4e-5_wp, 0.0_wp], [pad_state(-2e-4_wp, deflection=7e-6_wp), &
            & pad_state(1e-3_wp, deflection=7e-6_wp)])
         allocate (f(with%n), f0(with%n))
         t = 0.013_wp*k
         call with%rhs(t, y, f, ok)
         call without%rhs(t, y, f0, ok)
         d = 1e-2_wp/with%point%speed(t)
         associate (point => with%point)
            expected = -0.5_wp*(16*(mass_position(point, t + d) + mass_position(point, t - d)) &
               & - 30*mass_position(point, t) - mass_position(point, t + 2*d) - mass_position(point, t - 2*d)) &
               & /(12*d**2)/inputs%rotor%mass
         end associate
         call expect_close(norm2(f(3:4) - f0(3:4) - expected), 0.0_wp, 1e-8_wp*norm2(expected) &
            & + 10*epsilon(d)*norm2(f0(3:4)), 'unbalance at t = '//to_text(t))
         call expect_close(norm2(f(5:) - f0(5:)), 0.0_wp, 0.0_wp, 'pads know no unbalance')
         deallocate (f, f0)
      end do
   end subroutine unbalance_force

   !> Where a mass on the shaft stands, over its radius.
   pure function mass_position(point, time)
      type(operating_point_type), intent(in) :: point
      real(wp), intent(in) :: time
      real(wp) :: mass_position(2)
      mass_position = [cos(point%shaft_angle(time)), sin(point%shaft_angle(time))]
   end function mass_position

   !> Contact only pushes: none without pivot deflection; tilting only, it is the radial reaction or nothing.
   subroutine forces_by_definition()
      type(machine_model) :: model
      real(wp), allocatable :: y(:), f(:)
      logical :: ok
      integer :: pad
      model = new_machine_model(paper_case('tilting_radial', 'lugre'))
      y = model%static_state([-2e-5_wp, 0.0_wp], [pad_state(-2e-4_wp, deflection=-1e-6_wp), &
         & pad_state(1e-3_wp, deflection=5e-6_wp)])
      y(model%layout%elements(1)%bristle(1)) = 1e-7_wp
      y(model%layout%elements(1)%bristle(2)) = 1e-7_wp
      allocate (f(model%n))
      call model%rhs(0.0_wp, y, f, ok)
      call expect_close(model%bearings(1)%loads(1)%contact, 0.0_wp, 0.0_wp, 'no contact without pivot deflection')
      call expect_close(model%bearings(1)%loads(1)%friction%force, 0.0_wp, 0.0_wp, 'no friction without contact')
      call expect_close(model%bearings(1)%loads(2)%friction%force, 0.1_wp*model%bearings(1)%loads(2)%contact, &
         & 1e-14_wp*model%bearings(1)%loads(2)%contact, 'bristles carry in contact')
      call expect(model%bearings(1)%loads(2)%contact > 1e3_wp, 'contact under pivot deflection')
      deallocate (f)
      model = new_machine_model(heavy_case('tilting_only', 'none', 0.0_wp))
      y = moving_state(model)
      allocate (f(model%n))
      call model%rhs(0.0_wp, y, f, ok)
      do pad = 1, 2
         associate (reaction => radial_reaction(model, y, pad))
            call expect_close(model%bearings(1)%loads(pad)%contact, max(0.0_wp, reaction), 1e-12_wp*abs(reaction), &
               & 'radial reaction of pad '//to_text(pad))
         end associate
      end do
      call hanging_pads()
   end subroutine forces_by_definition

   !> What film, weight and its own turning press a heavy pad against its pivot with, N, in the state evaluated last.
   real(wp) function radial_reaction(model, y, pad)
      type(machine_model), intent(inout) :: model
      real(wp), intent(in) :: y(:)
      integer, intent(in) :: pad
      type(pad_sample), allocatable :: films(:)
      films = model%bearings(1)%sampled()
      associate (p => model%inputs%bearings(1)%pads, before => model%layout%elements(1)%before(pad))
         radial_reaction = -films(pad)%film_force(2) - p%mass(pad)*300*sin(model%bearings(1)%pads(pad)%position%angle &
            & - y(before + 1)) + p%mass(pad)*p%centre_radial(pad)*y(before + 2)**2
      end associate
   end function radial_reaction

   !> Heavy pads above the journal hang from pivots that cannot pull.
   subroutine hanging_pads()
      type(case_type) :: inputs
      type(machine_model) :: model
      real(wp), allocatable :: y(:), f(:)
      logical :: ok
      integer :: pad
      inputs = heavy_case('tilting_only', 'bengisu_akay', 0.0_wp)
      inputs%bearings(1)%pads%pivot_angle_deg = [45.0_wp, 135.0_wp]
      model = new_machine_model(inputs)
      y = model%static_state([0.0_wp, 0.0_wp], spread(pad_state(3e-4_wp, 0.3_wp), 1, 2))
      allocate (f(model%n))
      call model%rhs(0.0_wp, y, f, ok)
      do pad = 1, 2
         call expect(radial_reaction(model, y, pad) < -1e3_wp, 'weight pulls a pad off its pivot')
         call expect_close(model%bearings(1)%loads(pad)%contact, 0.0_wp, 0.0_wp, 'a pivot does not pull')
         call expect_close(model%bearings(1)%loads(pad)%friction%force, 0.0_wp, 0.0_wp, 'nor rub then')
      end do
   end subroutine hanging_pads

   !> What has no film is refused in words.
   subroutine refusals()
      type(machine_model) :: model
      real(wp), allocatable :: y(:), f(:)
      logical :: ok
      model = new_machine_model(paper_case('tilting_radial', 'none'))
      allocate (f(model%n))
      y = model%static_state([-4e-5_wp, 200e-6_wp], [pad_state(-2e-4_wp, deflection=7e-6_wp), &
            & pad_state(1e-3_wp, deflection=7e-6_wp)])
      call model%rhs(0.0_wp, y, f, ok)
      call expect(.not. ok, 'a closed film is refused')
      if (.not. ok) call expect(index(model%refusal, 'pad 1') > 0 .and. index(model%refusal, 'closed') > 0, &
         & 'and says which: '//model%refusal)
      y = model%static_state([0.0_wp, 0.0_wp], [pad_state(), pad_state(0.7_wp)])
      call model%rhs(0.0_wp, y, f, ok)
      call expect(.not. ok, 'a pad turned over is refused')
      if (.not. ok) call expect(index(model%refusal, 'pad 2 turned over') > 0, 'and says so: '//model%refusal)
   end subroutine refusals
end program test_equations_of_motion
