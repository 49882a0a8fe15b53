!> One pad and the bearing of many: the derivatives of the loads, which are not divided by masses, against differences
!> of the loads; what an operating point changes; samples without the film solver.
program test_tilting_pad_bearing
   use kinds, only: wp
   use text, only: to_text
   use case_inputs, only: case_type
   use film_solver, only: film_oil
   use rigid_rotor, only: journal_motion
   use state_layout, only: pad_state, element_layout_type, state_layout_type, new_state_layout, tilt, of_journal
   use tilting_pad_bearing, only: tilting_pad_bearing_type, pad_sample, new_tilting_pad_bearing
   use input_cases, only: case_of
   use check, only: runs, expect, expect_close, between, report
   implicit none (type, external)

   real(wp), parameter :: speed = 680
   type(film_oil), parameter :: oil(2) = film_oil(19e-3_wp)
   character(len=*), parameter :: motions(2) = [character(len=14) :: 'tilting_radial', 'tilting_only']
   character(len=*), parameter :: frictions(3) = [character(len=12) :: 'none', 'bengisu_akay', 'lugre']
   character(len=*), parameter :: solvers(4) = [character(len=7) :: 'fourier', 'direct', 'sor', 'auto']
   integer :: i, k

   do i = 1, size(motions)
      do k = 1, size(frictions)
         if (runs('derivatives')) call derivatives(motions(i), frictions(k), .false.)
         if (runs('derivatives_in_contact')) call derivatives(motions(i), frictions(k), .true.)
      end do
      if (runs('samples')) call samples(motions(i), .false.)
      if (runs('samples_in_contact')) call samples(motions(i), .true.)
   end do
   if (runs('fixed')) then
      call derivatives('fixed', 'none', .false.)
      call derivatives('fixed', 'none', .true.)
      call samples('fixed', .true.)
   end if
   do i = 1, size(solvers)
      if (runs('chosen_pads')) call chosen_pads(solvers(i))
   end do
   if (runs('operating_point')) call operating_point()
   call report()

contains

   !> Loads of a pad that is chosen are those of its new state, loads of another stay those of the state before.
   subroutine chosen_pads(solver)
      character(len=*), intent(in) :: solver
      type(case_type) :: inputs
      type(tilting_pad_bearing_type) :: bearing, all_pads
      type(journal_motion) :: journal
      type(pad_state) :: pads(2), moved(2)
      character(len=:), allocatable :: refusal
      logical :: ok
      ! what it is given stays there, unless it is set
      logical, volatile :: given
      inputs = heavy_case('tilting_radial', 'none')
      inputs%bearings(1)%film%solver = solver
      bearing = new_tilting_pad_bearing(inputs, 1)
      call draw(journal, pads)
      call bearing%evaluate(journal, pads, oil, speed, .true., refusal, ok)
      all_pads = bearing
      moved = pads
      moved%x(tilt) = pads%x(tilt) + 1e-5_wp
      call bearing%evaluate(journal, moved, oil, speed, .true., refusal, ok, [.false., .true.])
      call expect_close(difference(bearing, all_pads, 1), 0.0_wp, 0.0_wp, solver//': a pad that is not chosen')
      call all_pads%evaluate(journal, moved, oil, speed, .true., refusal, ok)
      call expect_close(difference(bearing, all_pads, 2), 0.0_wp, 1e-9_wp, solver//': a chosen pad')
      given = .false.
      call bearing%evaluate(journal, moved, oil, speed, .true., refusal, given, [.false., .false.])
      call expect(given, solver//': where no pad is chosen, none is refused')
      call expect(difference(bearing, all_pads, 1) > 1e-3_wp, solver//': the move is felt')
   end subroutine chosen_pads

   !> Of a pad's moments and their derivatives in two bearings, over themselves.
   real(wp) function difference(a, b, pad)
      type(tilting_pad_bearing_type), intent(in) :: a, b
      integer, intent(in) :: pad
      associate (of_a => moments(a, pad), of_b => moments(b, pad))
         difference = maxval(abs(of_a - of_b)/max(abs(of_b), tiny(difference)))
      end associate
   end function difference

   pure function moments(bearing, pad)
      type(tilting_pad_bearing_type), intent(in) :: bearing
      integer, intent(in) :: pad
      real(wp), allocatable :: moments(:)
      associate (row => of_journal + tilt)
         moments = [bearing%loads(pad)%own(tilt), bearing%derivatives(pad)%over_positions(row, :), &
            & bearing%derivatives(pad)%over_rates(row, :)]
      end associate
   end function moments

   !> Heavy pads off their balance on films without cavitation, hence smooth, solved closely.
   type(tilting_pad_bearing_type) function heavy_bearing(motion, friction) result(bearing)
      character(len=*), intent(in) :: motion, friction
      bearing = new_tilting_pad_bearing(heavy_case(motion, friction), 1)
   end function heavy_bearing

   type(case_type) function heavy_case(motion, friction) result(inputs)
      character(len=*), intent(in) :: motion, friction
      inputs = case_of('&pads mass = 80, 60, inertia = 0.03, 0.025, centre_tangential = 3e-3, -6e-3, ' &
         & //'pivot_ratio = 0.5, 0.6, motion = '''//trim(motion)//''' / &friction model = '''//trim(friction) &
         & //''' / &rotor gravity = 300 / &film solver = ''fourier'', cavitation = ''none'' /')
   end function heavy_case

   !> The same bearing with asperities as high as the films are thick, so that differences over steps of its films are
   !> close: 4 sigma = 100 um, K' E' by which they bear about as much as the films.
   type(tilting_pad_bearing_type) function rough_bearing(motion, friction) result(bearing)
      character(len=*), intent(in) :: motion, friction
      type(case_type) :: inputs
      inputs = heavy_case(motion, friction)
      inputs%bearings(1)%asperity%roughness = 25e-6_wp
      inputs%bearings(1)%asperity%elastic_modulus = 1e9_wp
      bearing = new_tilting_pad_bearing(inputs, 1)
   end function rough_bearing

   !> Pads that carry, tilted, in motion, sliding at some mm/s: away from the switching points of friction.
   subroutine draw(journal, pads)
      type(journal_motion), intent(out) :: journal
      type(pad_state), intent(out) :: pads(2)
      integer :: i
      journal = journal_motion([between(-40e-6_wp, -20e-6_wp), between(-5e-6_wp, 5e-6_wp)], &
         & [between(-5e-3_wp, 5e-3_wp), between(-5e-3_wp, 5e-3_wp)])
      do i = 1, 2
         pads(i) = pad_state(merge(between(-1e-4_wp, 1e-4_wp), between(6e-4_wp, 8e-4_wp), i == 1), &
            & sign(between(0.3_wp, 0.6_wp), between(-1.0_wp, 1.0_wp)), between(4e-6_wp, 8e-6_wp), &
            & between(-2e-3_wp, 2e-3_wp), between(-1e-7_wp, 1e-7_wp))
      end do
   end subroutine draw

   !> Moves a displacement, or its rate, of the journal for all pads (1 and 2) or of one pad (from 3 on).
   subroutine move(k, rate, pad, step, journal, pads)
      integer, intent(in) :: k, pad
      logical, intent(in) :: rate
      real(wp), intent(in) :: step
      type(journal_motion), intent(inout) :: journal
      type(pad_state), intent(inout) :: pads(2)
      if (k <= of_journal) then
         if (rate) then
            journal%velocity(k) = journal%velocity(k) + step
         else
            journal%position(k) = journal%position(k) + step
         end if
      else if (rate) then
         pads(pad)%v(k - of_journal) = pads(pad)%v(k - of_journal) + step
      else
         pads(pad)%x(k - of_journal) = pads(pad)%x(k - of_journal) + step
      end if
   end subroutine move

   !> Five-point differences with steps of 1e-3 of what changes the film: error 1e-12 times the fifth derivative, some
   !> 1e3, rounding 1e-16 of loads of 1e5 N over steps of 1e-3; each row by its largest entry times its step. The pads'
   !> own weight makes 1e-3 of the rows that it stands in, so 1e-7 shows every term.
   subroutine derivatives(motion, friction, rough)
      character(len=*), intent(in) :: motion, friction
      !> Whether asperities touch.
      logical, intent(in) :: rough
      type(tilting_pad_bearing_type) :: bearing
      type(journal_motion) :: journal
      type(pad_state) :: pads(2)
      type(element_layout_type) :: layout
      real(wp), allocatable :: found(:, :), expected(:, :)
      character(len=:), allocatable :: refusal, what
      logical :: ok, moved_ok
      integer :: pad, row
      what = trim(motion)//', '//trim(friction)
      bearing = heavy_bearing(motion, friction)
      if (rough) bearing = rough_bearing(motion, friction)
      layout = bearing%layout()
      call expect(layout%coordinates == count([motion /= 'fixed', motion == 'tilting_radial']), 'coordinates, '//what)
      call draw(journal, pads)
      if (motion == 'fixed') pads = pad_state()
      call bearing%evaluate(journal, pads, oil, speed, .true., refusal, ok)
      call expect(all(bearing%asperity%touches .eqv. rough), 'asperities touch, or not, '//what)
      do pad = 1, 2
         call taken(bearing, pad, layout%coordinates, found)
         call differences(bearing, journal, pads, pad, layout%coordinates, expected, moved_ok)
         do row = 1, size(found, 1)
            call expect_close(maxval(abs(found(row, :) - expected(row, :))), 0.0_wp, &
               & 1e-7_wp*maxval(abs(expected(row, :))), 'load '//to_text(row)//' of pad ' &
               & //to_text(pad)//', '//what)
         end do
         call expect(ok .and. moved_ok, 'all states are admitted, '//what)
         call bearing%evaluate(journal, pads, oil, speed, .false., refusal, ok)
      end do
   end subroutine derivatives

   !> Steps of displacements and of their rates.
   pure function steps(n)
      integer, intent(in) :: n
      real(wp) :: steps(of_journal + n, 2)
      real(wp), parameter :: all(4, 2) = reshape([80e-6_wp, 80e-6_wp, 1e-3_wp, 7e-6_wp, 0.05_wp, 0.05_wp, 0.2_wp, &
         & 5e-3_wp], [4, 2])
      steps = all(:of_journal + n, :)
   end function steps

   !> The derivatives of a pad with n displacements, of the force on the journal, its own forces and the pivot load,
   !> over displacements and then over rates, times their steps.
   subroutine taken(bearing, pad, n, found)
      type(tilting_pad_bearing_type), intent(in) :: bearing
      integer, intent(in) :: pad, n
      real(wp), allocatable, intent(out) :: found(:, :)
      real(wp), dimension(of_journal + n, of_journal + n) :: over_positions, over_rates
      real(wp) :: over_bristle(n), by(of_journal + n, 2)
      integer :: k
      call bearing%part_derivatives(pad, of_journal + n, .false., over_positions, over_rates)
      call bearing%add_late(pad, of_journal + n, .false., over_positions, over_rates, over_bristle)
      allocate (found(of_journal + n + 1, 2*(of_journal + n)))
      by = steps(n)
      associate (m => of_journal + n, pad_derivatives => bearing%derivatives(pad))
         do k = 1, m
            found(:, k) = [over_positions(:, k), pad_derivatives%contact_over_positions(k)]*by(k, 1)
            found(:, m + k) = [over_rates(:, k), pad_derivatives%contact_over_rates(k)]*by(k, 2)
         end do
      end associate
   end subroutine taken

   !> The same by differences.
   subroutine differences(bearing, journal, pads, pad, n, expected, all_ok)
      type(tilting_pad_bearing_type), intent(inout) :: bearing
      type(journal_motion), intent(in) :: journal
      type(pad_state), intent(in) :: pads(2)
      integer, intent(in) :: pad, n
      real(wp), allocatable, intent(out) :: expected(:, :)
      logical, intent(out) :: all_ok
      real(wp), parameter :: h = 1e-3_wp, offsets(4) = [-2*h, -h, h, 2*h]
      real(wp), parameter :: weights(4) = [1.0_wp, -8.0_wp, 8.0_wp, -1.0_wp]/(12*h)
      type(journal_motion) :: moved_journal
      type(pad_state) :: moved(2)
      real(wp) :: by(of_journal + n, 2)
      character(len=:), allocatable :: refusal
      integer :: i, k, rate
      logical :: ok
      by = steps(n)
      allocate (expected(of_journal + n + 1, 2*(of_journal + n)), source=0.0_wp)
      all_ok = .true.
      do rate = 0, 1
         do k = 1, of_journal + n
            associate (column => expected(:, rate*(of_journal + n) + k), loads => bearing%loads(pad))
               do i = 1, size(offsets)
                  moved_journal = journal
                  moved = pads
                  call move(k, rate == 1, pad, offsets(i)*by(k, rate + 1), moved_journal, moved)
                  call bearing%evaluate(moved_journal, moved, oil, speed, .false., refusal, ok)
                  all_ok = all_ok .and. ok
                  column = column + weights(i)*[loads%journal, loads%own(:n), loads%contact]
               end do
            end associate
         end do
      end do
   end subroutine differences

   !> In the state of an evaluation its outputs give its samples; pressures are those at the edges at least.
   subroutine samples(motion, rough)
      character(len=*), intent(in) :: motion
      logical, intent(in) :: rough
      type(tilting_pad_bearing_type) :: bearing
      type(journal_motion) :: journal
      type(pad_state) :: pads(2)
      type(pad_sample) :: evaluated(2), completed(2)
      real(wp) :: output(6)
      real(wp), allocatable :: nothing(:)
      type(state_layout_type) :: layout
      character(len=:), allocatable :: refusal
      logical :: ok
      character(len=:), allocatable :: friction
      integer :: i
      friction = 'lugre'
      if (motion == 'fixed') friction = 'none'
      bearing = heavy_bearing(motion, friction)
      if (rough) bearing = rough_bearing(motion, friction)
      call draw(journal, pads)
      if (motion == 'fixed') pads = pad_state()
      call bearing%evaluate(journal, pads, oil, speed, .true., refusal, ok)
      call expect(ok, 'a state with films')
      evaluated = bearing%sampled()
      layout = new_state_layout(4, [bearing%layout()], [1])
      allocate (nothing(layout%n), source=0.0_wp)
      output = bearing%output(layout%elements(1), nothing)
      call bearing%take_samples(journal, pads, speed, output, completed)
      do i = 1, 2
         associate (a => completed(i), b => evaluated(i))
            call expect_close(norm2(a%film_force - b%film_force) + abs(a%pivot_load - b%pivot_load), 0.0_wp, &
               & 1e-12_wp*norm2(b%film_force), 'film and pivot load of pad '//to_text(i))
            call expect_close(a%friction_moment, b%friction_moment, 1e-12_wp*abs(b%friction_moment), 'friction moment')
            call expect_close(a%min_film_thickness, b%min_film_thickness, 1e-18_wp, 'minimum film thickness')
            call expect_close(a%max_pressure, b%max_pressure, 0.0_wp, 'maximum pressure')
            call expect_close(a%asperity_force, b%asperity_force, 1e-12_wp*b%asperity_force, 'asperity force')
            call expect((a%asperity_force > 0) .eqv. rough, 'is there in contact alone')
         end associate
      end do
      associate (first => bearing%derivatives(1), second => bearing%derivatives(2))
         call try_change(bearing, layout, 1, first%film_over_positions(:, 1), second%film_over_positions(:, 1))
         call try_change(bearing, layout, 3, first%film_over_rates(:, 1), second%film_over_rates(:, 1))
         if (motion /= 'fixed') then
            i = layout%elements(1)%before(2)
            call try_change(bearing, layout, i + 1, [0.0_wp, 0.0_wp], second%film_over_positions(:, 3))
            call try_change(bearing, layout, i + 2, [0.0_wp, 0.0_wp], second%film_over_rates(:, 3))
         end if
      end associate
      output = -1e9_wp
      call bearing%take_samples(journal, pads, speed, output, completed)
      call expect_close(maxval(abs(completed%max_pressure)), 0.0_wp, 0.0_wp, 'no pressure below that of the edges')
   end subroutine samples

   !> A change of a state by 1e-6 changes the forces of both pads by as much as these slopes say, and no pressure.
   subroutine try_change(bearing, layout, state, first, second)
      type(tilting_pad_bearing_type), intent(in) :: bearing
      type(state_layout_type), intent(in) :: layout
      integer, intent(in) :: state
      real(wp), intent(in) :: first(2), second(2)
      type(tilting_pad_bearing_type) :: same
      real(wp) :: change(layout%n), before(6), after(6)
      same = bearing
      change = 0
      before = same%output(layout%elements(1), change)
      change(state) = 1e-6_wp
      after = same%output(layout%elements(1), change)
      call expect_close(norm2(after(1:2) - before(1:2) - 1e-6_wp*first), 0.0_wp, 1e-15_wp*norm2(first), &
         & 'what a change adds to the force of the first pad')
      call expect_close(norm2(after(4:5) - before(4:5) - 1e-6_wp*second), 0.0_wp, 1e-15_wp*norm2(second), &
         & 'what a change adds to the force of the second pad')
      call expect_close(norm2(after([3, 6]) - before([3, 6])), 0.0_wp, 0.0_wp, 'pressures')
   end subroutine try_change

   !> Friction off and films kept whole, and both back.
   subroutine operating_point()
      type(case_type) :: inputs
      type(tilting_pad_bearing_type) :: bearing
      type(journal_motion) :: journal
      type(pad_state) :: pads(2)
      real(wp) :: cavitated(2), whole(2)
      character(len=:), allocatable :: refusal
      character(len=7), parameter :: solvers(3) = [character(len=7) :: 'auto', 'sor', 'fourier']
      logical :: ok
      integer :: k
      do k = 1, size(solvers)
         inputs = case_type()
         inputs%bearings(1)%friction%model = 'bengisu_akay'
         inputs%bearings(1)%film%solver = trim(solvers(k))
         if (solvers(k) == 'fourier') inputs%bearings(1)%film%cavitation = 'gumbel'
         bearing = new_tilting_pad_bearing(inputs, 1)
         call expect(.not. bearing%is_smooth() .and. bearing%film%cavitates(), 'friction and cavitation, '//solvers(k))
         ! the wedge of the second pad opens: its film cavitates
         journal%position = [-3e-5_wp, 0.0_wp]
         pads = [pad_state(2e-4_wp, 0.3_wp, 5e-6_wp), pad_state(-6e-4_wp, 0.3_wp, 5e-6_wp)]
         call bearing%evaluate(journal, pads, oil, speed, .false., refusal, ok)
         call expect(ok .and. abs(bearing%loads(1)%friction%force) > 0, 'friction acts, '//solvers(k))
         cavitated = bearing%loads(2)%journal
         bearing%rubs = .false.
         call bearing%film%set_cavitation(.false.)
         call expect(bearing%is_smooth() .and. .not. bearing%film%cavitates(), 'neither, '//solvers(k))
         call bearing%evaluate(journal, pads, oil, speed, .false., refusal, ok)
         call expect_close(bearing%loads(1)%friction%force, 0.0_wp, 0.0_wp, 'no friction, '//solvers(k))
         whole = bearing%loads(2)%journal
         call expect(norm2(whole - cavitated) > 1e-2_wp*norm2(cavitated), &
            & 'the full film has another force, '//solvers(k))
         inputs%bearings(1)%film%cavitation = 'none'
         bearing%rubs = .true.
         call bearing%film%set_cavitation(.true.)
         call bearing%evaluate(journal, pads, oil, speed, .false., refusal, ok)
         call expect_close(norm2(bearing%loads(2)%journal - cavitated), 0.0_wp, 1e-5_wp*norm2(cavitated), &
            & 'and back, within the tolerance of sor, '//solvers(k))
         bearing = new_tilting_pad_bearing(inputs, 1)
         call expect(.not. bearing%film%cavitates(), 'no cavitation by the input, '//solvers(k))
         call bearing%evaluate(journal, pads, oil, speed, .false., refusal, ok)
         call expect_close(norm2(bearing%loads(2)%journal - whole), 0.0_wp, 1e-5_wp*norm2(whole), &
            & 'the full film is that of the input without cavitation, '//solvers(k))
      end do
   end subroutine operating_point
end program test_tilting_pad_bearing
