!> Films with slopes: against an independent program, films without slopes, in a mirror, their derivatives, losses and
!> starts; contact of asperities with slopes.
program test_sloped_film
   use kinds, only: wp, pi
   use text, only: to_text
   use film_solver, only: film_motion, film_response, film_law_type, film_ok, film_closed, cavitation_none, &
      & cavitation_gumbel, cavitation_reynolds
   use film_losses, only: film_losses_type, film_loss, new_film_losses
   use pad_gap, only: pad_gap_type
   use direct_film, only: direct_film_type, new_direct_film
   use fourier_film, only: fourier_film_type, converged_film
   use asperity_contact, only: asperity_contact_type, asperity_load, sloped_asperity_load, new_asperity_contact
   use sloped_film, only: sloped_film_type, sloped_motion, sloped_response, new_sloped_film
   use sloped_gap, only: edge_films
   use weighted_film, only: weighted_film_type, new_weighted_film
   use paper_bearing, only: paper_oil, paper_pad, offset_pad, uneven, clearance
   use check, only: runs, expect, expect_close, between, report
   implicit none (type, external)

   !> 6500 rpm.
   real(wp), parameter :: speed = 6500*pi/30
   real(wp), parameter :: none(3) = 0, around(3) = [3e5_wp, 1e5_wp, -1e5_wp]

   if (runs('independent')) call independent()
   if (runs('derivatives')) then
      call derivatives('full', none, paper_oil, cavitation_none, 1e-8_wp)
      ! volumes move with the film, which their derivatives leave out
      call derivatives('supply', around, paper_oil, cavitation_none, 2e-3_wp)
      call derivatives('uneven', around, uneven, cavitation_none, 2e-3_wp)
      call derivatives('gumbel', around, paper_oil, cavitation_gumbel, 5e-3_wp)
   end if
   if (runs('yaw')) call yaw()
   if (runs('aligned')) then
      call aligned('full', none, paper_oil, cavitation_none, 1e-5_wp)
      call aligned('supply', around, paper_oil, cavitation_none, 3e-4_wp)
      call aligned('uneven', around, uneven, cavitation_none, 3e-4_wp)
      call aligned('gumbel', none, paper_oil, cavitation_gumbel, 3e-3_wp)
      ! beside edges under pressure a clipped film is a narrow strip
      call aligned('gumbel around', around, paper_oil, cavitation_gumbel, 3e-2_wp)
      call aligned('reynolds', none, paper_oil, cavitation_reynolds, 3e-3_wp)
   end if
   if (runs('order')) call order()
   if (runs('mirror')) call mirror(cavitation_none)
   if (runs('mirror')) call mirror(cavitation_reynolds)
   if (runs('forgets')) call forgets()
   if (runs('closed')) call closed()
   if (runs('losses')) then
      call losses('full', none, paper_oil, cavitation_none)
      call losses('reynolds', [2e5_wp, 1e5_wp, 0.0_wp], paper_oil, cavitation_reynolds)
      call losses('uneven', none, uneven, cavitation_reynolds)
      call losses('gumbel', none, paper_oil, cavitation_gumbel)
   end if
   if (runs('energy')) call energy(cavitation_none)
   if (runs('energy')) call energy(cavitation_reynolds)
   if (runs('asperities')) call asperities()
   call report()

contains

   !> Single films of an independent program: Galerkin's method with 20 x 14 functions, and where they cavitate
   !> 384 x 128 volumes, extrapolated.
   subroutine independent()
      call one('aligned', 0.1_wp, [-26.0_wp, 52.0_wp, 0.0_wp, 0.0_wp], [23.8436_wp, 13547.03_wp, 0.0_wp, 0.0_wp], &
         & 5.10244e6_wp, cavitation_none)
      call one('pitch 200', 0.1_wp, [-26.0_wp, 52.0_wp, 0.0_wp, 200.0_wp], &
         & [41.6085_wp, 13985.85_wp, 1.89671_wp, 68.8747_wp], 5.64823e6_wp, cavitation_none)
      call one('pitch 500', 0.1_wp, [-26.0_wp, 52.0_wp, 0.0_wp, 500.0_wp], &
         & [176.410_wp, 16808.80_wp, 7.49423_wp, 215.276_wp], 9.25872e6_wp, cavitation_none)
      call one('yaw 300', 0.1_wp, [-26.0_wp, 52.0_wp, 300.0_wp, 0.0_wp], &
         & [-66.5113_wp, 13739.42_wp, 12.28122_wp, -73.01773_wp], 5.56730e6_wp, cavitation_none)
      call one('L/D 0.5', 0.05_wp, [-29.0_wp, 60.0_wp, 0.0_wp, 600.0_wp], &
         & [40.26555_wp, 7521.378_wp, 0.530276_wp, 28.66551_wp], 7.00755e6_wp, cavitation_none)
      call one('cavitated', 0.1_wp, [0.0_wp, 50.0_wp, 0.0_wp, 0.0_wp], &
         & [490.4097_wp, 1907.721_wp, 0.0_wp, 0.0_wp], 1.0488399e6_wp, cavitation_reynolds)
      call one('cavitated, pitch 300', 0.1_wp, [0.0_wp, 50.0_wp, 0.0_wp, 300.0_wp], &
         & [563.7244_wp, 2186.777_wp, 6.505341_wp, 23.994934_wp], 1.6529643e6_wp, cavitation_reynolds)
   end subroutine independent

   !> Force, moment on the pad and highest pressure of one film; e in um, slope in urad.
   subroutine one(name, length, e, expected, highest, condition)
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: length, e(4), expected(4), highest
      integer, intent(in) :: condition
      type(sloped_film_type) :: film
      type(sloped_response) :: r
      integer :: k
      !> Of films that have to be close, and of those of a march.
      real(wp) :: error(2, 2), pressure(2)
      do k = 1, 2
         film = new_sloped_film([paper_pad(length=length)], condition, closely=k == 1)
         call film%evaluate_pad(1, motion_of(1e-6_wp*e), paper_oil, speed, .false., r)
         error(:, k) = [norm2(r%film%force + expected(:2))/norm2(expected(:2)), norm2(r%moment + expected(3:)) &
            & /max(norm2(expected(3:)), 1e-3_wp*length*norm2(expected))]
         pressure(k) = r%film%max_pressure/highest - 1
      end do
      associate (force => error(1, :), moment => error(2, :), cavitates => condition == cavitation_reynolds)
         call expect(all(force < 1e-3_wp), name//': force '//errors(force))
         call expect(all(moment < 3e-3_wp), name//': moment '//errors(moment))
         call expect(all(abs(pressure) < [1e-2_wp, merge(2e-2_wp, 1e-2_wp, cavitates)]), name//': highest pressure ' &
            & //errors(pressure))
      end associate
   end subroutine one

   function errors(values)
      real(wp), intent(in) :: values(:)
      character(len=:), allocatable :: errors
      integer :: k
      errors = ''
      do k = 1, size(values)
         errors = errors//' '//to_text(values(k))
      end do
   end function errors

   pure type(sloped_motion) function motion_of(e)
      real(wp), intent(in) :: e(4)
      motion_of = sloped_motion(film_motion(e(:2)), e(3:))
   end function motion_of

   !> A film with slopes of up to half its thickness at the edges, and squeeze.
   type(sloped_motion) function random_motion() result(motion)
      motion = motion_of(clearance*[between(-0.5_wp, 0.4_wp), between(0.0_wp, 0.5_wp), between(-3.0_wp, 3.0_wp), &
         & between(-4.0_wp, 4.0_wp)])
      motion%middle%velocity = clearance*speed*[between(-0.1_wp, 0.1_wp), between(-0.1_wp, 0.1_wp)]
      motion%slope_rate = clearance*speed*[between(-1.0_wp, 1.0_wp), between(-1.0_wp, 1.0_wp)]
   end function random_motion

   !> Derivatives are slopes, to a tolerance in units in which all parts of a motion have the same effect.
   subroutine derivatives(name, pressures, oil, condition, tolerance)
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: pressures(3), tolerance
      class(film_law_type), intent(in) :: oil
      integer, intent(in) :: condition
      type(sloped_film_type) :: film
      type(sloped_response) :: r, low, high
      type(sloped_motion) :: motion
      real(wp) :: step(8), found(4), error
      integer :: k
      film = new_sloped_film([offset_pad(pressures)], condition)
      step = 1e-6_wp*clearance*[1.0_wp, 1.0_wp, 20.0_wp, 20.0_wp, speed, speed, 20*speed, 20*speed]
      motion = motion_of([-26e-6_wp, 52e-6_wp, 100e-6_wp, 200e-6_wp])
      motion%middle%velocity = clearance*speed*[0.03_wp, -0.05_wp]
      motion%slope_rate = clearance*speed*[0.5_wp, -0.3_wp]
      call film%evaluate_pad(1, motion, oil, speed, .true., r)
      error = 0
      do k = 1, 8
         call film%evaluate_pad(1, motion%moved(k, step(k)), oil, speed, .false., high)
         call film%evaluate_pad(1, motion%moved(k, -step(k)), oil, speed, .false., low)
         found = [high%film%force - low%film%force, high%moment - low%moment]/2
         error = max(error, maxval(abs(found - r%derivatives(:, k)*step(k))/matmul(abs(r%derivatives), step)))
      end do
      call expect(error < tolerance, name//': derivatives '//to_text(error))
   end subroutine derivatives

   !> Derivatives of moments over the slope where half of the film cavitates, against differences so wide that some
   !> cells come and go.
   subroutine yaw()
      type(sloped_film_type) :: film
      type(sloped_response) :: r, low, high
      type(sloped_motion) :: motion
      real(wp) :: found(2, 2)
      integer :: k
      film = new_sloped_film([paper_pad()], cavitation_reynolds, .true.)
      motion = motion_of([5e-6_wp, 50e-6_wp, 0.0_wp, 0.0_wp])
      call film%evaluate_pad(1, motion, paper_oil, speed, .true., r)
      do k = 1, 2
         call film%evaluate_pad(1, motion%moved(2 + k, 20e-6_wp), paper_oil, speed, .false., high)
         call film%evaluate_pad(1, motion%moved(2 + k, -20e-6_wp), paper_oil, speed, .false., low)
         found(:, k) = (high%moment - low%moment)/40e-6_wp
         call expect(norm2(found(:, k) - r%derivatives(3:, 2 + k)) < 5e-3_wp*norm2(found(:, k)), 'over slope ' &
            & //to_text(k)//errors([found(:, k), r%derivatives(3:, 2 + k)]))
      end do
   end subroutine yaw

   !> Without slopes films are those of today's solvers, whose error is 1e-6 (full) and 1e-3 (cavitated).
   subroutine aligned(name, pressures, oil, condition, tolerance)
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: pressures(3), tolerance
      class(film_law_type), intent(in) :: oil
      integer, intent(in) :: condition
      type(sloped_film_type) :: film
      real(wp), parameter :: share = 0.2_wp
      type(fourier_film_type) :: modes, full
      type(direct_film_type) :: direct
      type(sloped_response) :: r
      type(film_response) :: f, whole
      type(sloped_motion) :: motion
      real(wp) :: error(3), scale
      integer :: trial
      film = new_sloped_film([offset_pad(pressures)], condition, .true.)
      modes = converged_film(offset_pad(pressures), condition == cavitation_gumbel, 1e-6_wp)
      full = converged_film(offset_pad(pressures), .false., 1e-6_wp)
      if (condition == cavitation_reynolds) direct = new_direct_film([offset_pad(pressures)], 48, 16, 80, 8, &
         & condition, 1e-6_wp, 2e-3_wp)
      error = 0
      do trial = 1, 6
         motion%middle%position = clearance*[between(-0.4_wp, 0.2_wp), between(0.2_wp, 0.6_wp)]
         motion%middle%velocity = clearance*speed*[between(-0.05_wp, 0.05_wp), between(-0.05_wp, 0.05_wp)]
         call film%evaluate_pad(1, motion, oil, speed, .true., r)
         if (condition == cavitation_reynolds) then
            call direct%evaluate_pad(1, motion%middle, oil, speed, .true., f)
         else
            call modes%evaluate_pad(1, motion%middle, oil, speed, .true., f)
         end if
         ! a film that is nearly empty is measured by a full one
         call full%evaluate_pad(1, motion%middle, oil, speed, .true., whole)
         scale = max(norm2(f%force), share*norm2(whole%force))
         error(1) = max(error(1), norm2(r%film%force - f%force)/scale)
         error(2) = max(error(2), norm2(r%derivatives(:2, 5:6) - f%derivatives(:, 3:)) &
            & /max(norm2(f%derivatives(:, 3:)), share*norm2(whole%derivatives(:, 3:))))
         error(3) = max(error(3), norm2(r%moment)/(0.1_wp*scale))
      end do
      call expect(error(1) < tolerance, name//': force '//to_text(error(1)))
      call expect(error(2) < 5*tolerance, name//': damping '//to_text(error(2)))
      call expect(error(3) < 1e-10_wp, name//': no moment '//to_text(error(3)))
   end subroutine aligned

   !> With twice as many functions each way a film with slopes errs by less than a tenth: the pressure has corners, at
   !> which its third derivatives are singular.
   subroutine order()
      integer, parameter :: numbers(4) = [4, 8, 12, 20]
      type(weighted_film_type) :: film
      type(sloped_response) :: r(4)
      real(wp) :: share, error(3)
      integer :: k
      do k = 1, 4
         film = new_weighted_film(offset_pad(), numbers(k), numbers(k) + 1)
         call film%evaluate(motion_of([-30e-6_wp, 60e-6_wp, 100e-6_wp, 300e-6_wp]), paper_oil%viscosity, speed, &
            & .false., r(k), share)
      end do
      do k = 1, 3
         error(k) = norm2([r(k)%film%force - r(4)%film%force, (r(k)%moment - r(4)%moment)/0.05_wp]) &
            & /norm2(r(4)%film%force)
      end do
      call expect(error(2) < 0.1_wp*error(1) .and. error(3) < 0.3_wp*error(2), 'order:'//errors(error))
   end subroutine order

   !> Seen along the other direction of the shaft moments and slopes change their signs.
   subroutine mirror(condition)
      integer, intent(in) :: condition
      type(sloped_film_type) :: film
      type(sloped_response) :: a, b
      type(sloped_motion) :: motion
      real(wp) :: error, signs(8)
      integer :: trial
      signs = [1, 1, -1, -1, 1, 1, -1, -1]
      film = new_sloped_film([offset_pad()], condition)
      error = 0
      do trial = 1, 5
         motion = random_motion()
         call film%evaluate_pad(1, motion, paper_oil, speed, .true., a)
         motion = sloped_motion(motion%middle, -motion%slope, -motion%slope_rate)
         call film%forget()
         call film%evaluate_pad(1, motion, paper_oil, speed, .true., b)
         if (.not. norm2(a%film%force) > 0) cycle
         error = max(error, norm2(a%film%force - b%film%force)/norm2(a%film%force), norm2(a%moment + b%moment) &
            & /norm2(a%moment), norm2(a%derivatives - b%derivatives*spread(signs(:4), 2, 8)*spread(signs, 1, 4)) &
            & /norm2(a%derivatives))
      end do
      call expect(error < 1e-9_wp, 'mirror '//to_text(error))
   end subroutine mirror

   !> A film is the same to the last bit after any other.
   subroutine forgets()
      type(sloped_film_type) :: film
      type(sloped_response) :: a, b
      type(sloped_motion) :: motion
      film = new_sloped_film([offset_pad()], cavitation_reynolds)
      motion = motion_of([5e-6_wp, 50e-6_wp, 50e-6_wp, 100e-6_wp])
      call film%evaluate_pad(1, motion, paper_oil, speed, .true., a)
      call film%evaluate_pad(1, motion%moved(1, -30e-6_wp), paper_oil, speed, .true., b)
      call film%forget()
      call film%evaluate_pad(1, motion, paper_oil, speed, .true., b)
      call expect(all(abs(a%film%force - b%film%force) <= 0) .and. all(abs(a%derivatives - b%derivatives) <= 0), &
         & 'same bits')
   end subroutine forgets

   !> A slope closes the film at one end.
   subroutine closed()
      type(sloped_film_type) :: film
      type(sloped_response) :: r
      film = new_sloped_film([paper_pad()], cavitation_none)
      call film%evaluate_pad(1, motion_of([0.0_wp, 60e-6_wp, 0.0_wp, 790e-6_wp]), paper_oil, speed, .false., r)
      call expect(r%film%status == film_ok, 'open')
      call expect_close(r%edge_films(2), 0.5e-6_wp, 1e-9_wp, 'edge film')
      call film%evaluate_pad(1, motion_of([0.0_wp, 60e-6_wp, 0.0_wp, -810e-6_wp]), paper_oil, speed, .false., r)
      call expect(r%film%status == film_closed .and. r%edge_films(1) < 0, 'closed')
   end subroutine closed

   !> Without slopes losses and flows are those of film_losses.
   subroutine losses(name, pressures, oil, condition)
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: pressures(3)
      class(film_law_type), intent(in) :: oil
      integer, intent(in) :: condition
      type(sloped_film_type) :: film
      type(film_losses_type) :: without
      type(film_loss) :: a, b
      type(sloped_motion) :: motion
      real(wp) :: heat, flow
      integer :: trial
      film = new_sloped_film([offset_pad(pressures)], condition)
      without = new_film_losses(offset_pad(pressures), condition)
      heat = 0
      flow = 0
      do trial = 1, 4
         motion%middle%position = clearance*[between(-0.5_wp, 0.4_wp), between(0.0_wp, 0.6_wp)]
         motion%middle%velocity = clearance*speed*[between(-0.1_wp, 0.1_wp), between(-0.1_wp, 0.1_wp)]
         call film%find_loss(1, motion, oil, speed, a)
         call without%find(motion%middle, oil, speed, b)
         heat = max(heat, maxval(abs([a%couette - b%couette, a%pressure - b%pressure, a%wedge - b%wedge]))/b%couette)
         flow = max(flow, maxval(abs([a%inlet - b%inlet, a%outlet - b%outlet, a%side - b%side, a%unfed - b%unfed])) &
            & /b%inlet)
      end do
      call expect(heat < 1e-3_wp, name//': heat '//to_text(heat))
      call expect(flow < 4e-3_wp, name//': flow '//to_text(flow))
   end subroutine losses

   !> What journal and pad do to each other becomes heat.
   subroutine energy(condition)
      integer, intent(in) :: condition
      type(sloped_film_type) :: film
      type(film_loss) :: loss
      type(sloped_motion) :: motion
      type(sloped_response) :: r
      real(wp) :: work, error
      integer :: trial
      film = new_sloped_film([offset_pad()], condition, .true.)
      error = 0
      do trial = 1, 4
         motion = random_motion()
         call film%evaluate_pad(1, motion, paper_oil, speed, .false., r)
         call film%find_loss(1, motion, paper_oil, speed, loss)
         work = -dot_product(r%film%force, motion%middle%velocity) - dot_product(r%moment, motion%slope_rate)
         error = max(error, abs(loss%wedge + work - loss%pressure)/(1e-3_wp + abs(loss%wedge) + abs(work)))
      end do
      call expect(error < 5e-3_wp, 'energy '//to_text(error))
   end subroutine energy

   !> Contact of asperities: without slopes that of asperity_contact; its derivatives are slopes.
   subroutine asperities()
      type(asperity_contact_type) :: contact
      type(asperity_load) :: without
      type(sloped_asperity_load) :: load, low, high
      type(sloped_motion) :: motion
      type(pad_gap_type) :: pad
      real(wp) :: step, error(3)
      integer :: trial, k
      contact = new_asperity_contact(1e-6_wp, 1.15e11_wp, 1e-3_wp, 0.1_wp, 34.0_wp)
      pad = offset_pad()
      motion = motion_of(clearance*[0.3_wp, 0.926_wp, 0.0_wp, 0.0_wp])
      call contact%evaluate(pad, pad%directions(), motion%middle, speed, without)
      call contact%evaluate_sloped(pad, pad%directions(), motion, speed, load)
      call expect(load%touches .and. norm2(load%force - without%force) < 1e-13_wp*norm2(without%force), 'force')
      call expect(norm2(load%slopes(:2, :2) - without%force_slopes) < 1e-13_wp*norm2(without%force_slopes), 'stiffness')
      call expect_close(load%moment, without%moment, 1e-13_wp*without%moment, 'moment of friction')
      call expect(norm2(load%film_motion%middle%position - without%film_position) < 1e-15_wp, 'place of the film')
      error = 0
      do trial = 1, 8
         motion%slope = clearance*[between(-0.5_wp, 0.5_wp), between(-0.5_wp, 0.5_wp)]
         call contact%evaluate_sloped(pad, pad%directions(), motion, speed, load)
         do k = 1, 4
            step = clearance*merge(1e-6_wp, 2e-5_wp, k <= 2)
            call contact%evaluate_sloped(pad, pad%directions(), motion%moved(k, step), speed, high)
            call contact%evaluate_sloped(pad, pad%directions(), motion%moved(k, -step), speed, low)
            error(1) = max(error(1), norm2([high%force - low%force, high%journal_moment - low%journal_moment] &
               & - 2*step*load%slopes(:, k))/norm2(2*step*load%slopes(:, k)))
            error(2) = max(error(2), abs(high%moment - low%moment - 2*step*load%turning_slopes(k)) &
               & /norm2(2*step*load%turning_slopes))
            error(3) = max(error(3), norm2([high%film_motion%middle%position - low%film_motion%middle%position, &
               & 0.05_wp*(high%film_motion%slope - low%film_motion%slope)] &
               & - 2*step*[1.0_wp, 1.0_wp, 0.05_wp, 0.05_wp]*load%film_motion_slopes(:, k))/step)
         end do
      end do
      call expect(all(error < 1e-6_wp), 'derivatives'//errors(error))
      motion = motion_of([20e-6_wp, 60e-6_wp, 0.0_wp, 900e-6_wp])
      call contact%evaluate_sloped(pad, pad%directions(), motion, speed, load)
      call expect(load%touches .and. load%thickness < -5e-6_wp .and. load%journal_moment(2) < 0, 'a deep corner')
      call expect(all(edge_films(pad, pad%directions(), load%film_motion) > 0), 'its film is open')
   end subroutine asperities
end program test_sloped_film
