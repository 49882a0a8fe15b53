!> The over-relaxed film: slopes, states it refuses, warm starts, relaxation, boundary pressures.
program test_sor_film
   use kinds, only: wp, i8, degree
   use text, only: to_text
   use film_solver, only: film_motion, film_response, film_ok, film_closed, film_not_converged, cavitation_none, &
      & cavitation_gumbel, cavitation_reynolds
   use pad_gap, only: pad_gap_type
   use sor_film, only: sor_film_type, sor_options, new_sor_film
   use film_differences, only: shifted
   use paper_bearing, only: paper_oil, paper_pad, speed, clearance
   use check, only: runs, expect, expect_close, between, report
   implicit none (type, external)

   integer, parameter :: kinds_of_cavitation(*) = [cavitation_none, cavitation_gumbel, cavitation_reynolds]
   character(len=*), parameter :: names(0:2) = [character(len=8) :: 'none', 'gumbel', 'reynolds']
   integer :: i

   do i = 1, size(kinds_of_cavitation)
      if (runs('slopes')) call slopes(kinds_of_cavitation(i))
      if (runs('warm_start')) call warm_start(kinds_of_cavitation(i))
      if (runs('shifted_pressures')) call shifted_pressures(kinds_of_cavitation(i))
   end do
   if (runs('nothing_left')) then
      call nothing_left(cavitation_gumbel)
      call nothing_left(cavitation_reynolds)
   end if
   if (runs('closed_film')) call closed_film()
   if (runs('sweep_cap')) call sweep_cap()
   if (runs('relaxation_is_near_best')) then
      call relaxation_is_near_best(60, 15, 0.1_wp)
      call relaxation_is_near_best(40, 10, 0.1_wp)
      call relaxation_is_near_best(24, 6, 0.1_wp)
      call relaxation_is_near_best(60, 15, 0.05_wp)
      call relaxation_is_near_best(60, 15, 0.3_wp)
   end if
   if (runs('pads_are_apart')) call pads_are_apart()
   call report()

contains

   pure type(sor_options) function options(cavitation, tolerance)
      integer, intent(in) :: cavitation
      real(wp), intent(in) :: tolerance
      options = sor_options(circumferential_cells=24, axial_cells=6, tolerance=tolerance, cavitation=cavitation)
   end function options

   !> A film with a converging wedge (e_y' < 0), some of it diverging, and squeeze of either sign.
   type(film_motion) function random_motion()
      random_motion%position = clearance*[between(-0.5_wp, 0.2_wp), between(0.0_wp, 0.6_wp)]
      random_motion%velocity = clearance*speed*[between(-0.3_wp, 0.3_wp), between(-0.3_wp, 0.3_wp)]
   end function random_motion

   !> A film with a wedge that surely carries.
   type(film_motion) function carrying_motion()
      carrying_motion%position = clearance*[between(-0.4_wp, -0.1_wp), between(0.0_wp, 0.6_wp)]
      carrying_motion%velocity = clearance*speed*[between(-0.02_wp, 0.02_wp), between(-0.02_wp, 0.02_wp)]
   end function carrying_motion

   !> Adjoint slopes against central differences with a step of h = 1e-3 of the clearance (and of the
   !> clearance times the speed) in the five-point form: error h**4/30 of the fifth derivative, which the
   !> clearance over the minimum film thickness, up to 4, raises to the fifth power: 1e-12 * 1024 * some 10 = 1e-8.
   !> Solutions converged to 1e-12 (residual, amplified by 50 on this grid) give 1e-10/h = 1e-7.
   !> With cavitation the force has a switching point where a cell leaves or joins the film; where the cells of the film
   !> are not the same at all places of the stencil, the motion is passed over.
   subroutine slopes(cavitation)
      integer, intent(in) :: cavitation
      real(wp), parameter :: h = 1e-3_wp, offsets(4) = [-2*h, -h, h, 2*h]
      real(wp), parameter :: weights(4) = [1.0_wp, -8.0_wp, 8.0_wp, -1.0_wp]/(12*h)
      type(sor_film_type) :: solver
      type(film_motion) :: motion
      type(film_response) :: r, at(4)
      logical, allocatable :: film(:, :), here(:, :)
      real(wp) :: scale(4), expected(2), worst
      integer :: trial, compared, cavitated, column, k
      logical :: same
      solver = new_sor_film([paper_pad([2e5_wp, 1e5_wp, 0.0_wp])], options(cavitation, 1e-12_wp))
      scale = clearance*[1.0_wp, 1.0_wp, speed, speed]
      compared = 0
      cavitated = 0
      worst = 0
      do trial = 1, 40
         motion = random_motion()
         call solver%evaluate_pad(1, motion, paper_oil, speed, .true., r)
         call expect(r%status == film_ok, 'the film converges, '//trim(names(cavitation)))
         film = solver%pressure_field(1) > 0
         if (.not. any(film)) cycle
         do column = 1, 4
            same = .true.
            do k = 1, 4
               call solver%evaluate_pad(1, shifted(motion, column, offsets(k)*scale(column)), paper_oil, speed, &
                  & .false., at(k))
               here = solver%pressure_field(1) > 0
               same = same .and. (all(film .eqv. here) .or. cavitation == cavitation_none)
            end do
            if (.not. same) cycle
            compared = compared + 1
            if (.not. all(film)) cavitated = cavitated + 1
            expected = [sum(weights*at%force(1)), sum(weights*at%force(2))]
            worst = max(worst, maxval(abs(r%derivatives(:, column)*scale(column) - expected))/norm2(expected))
         end do
      end do
      call expect(compared >= 40, 'slopes compared, '//names(cavitation)//': '//to_text(compared))
      call expect(cavitated >= 20, 'of them with negative or cavitated cells, '//names(cavitation)//': ' &
         & //to_text(cavitated))
      call expect_close(worst, 0.0_wp, 1e-6_wp, 'slopes by adjoints, '//trim(names(cavitation)))
   end subroutine slopes

   !> From whatever field it starts, the solution is the same but for the tolerance, amplified by the
   !> inverse of 1 - (Jacobi's spectral radius), about 50 on this grid.
   subroutine warm_start(cavitation)
      integer, intent(in) :: cavitation
      real(wp), parameter :: tolerance = 1e-8_wp
      type(sor_film_type) :: warm, cold
      type(film_response) :: from_warm, from_cold, other
      type(film_motion) :: motion
      real(wp) :: worst
      integer :: trial
      warm = new_sor_film([paper_pad()], options(cavitation, tolerance))
      worst = 0
      do trial = 1, 10
         call warm%evaluate_pad(1, random_motion(), paper_oil, speed, .true., other)
         motion = carrying_motion()
         call warm%evaluate_pad(1, motion, paper_oil, speed, .true., from_warm)
         cold = new_sor_film([paper_pad()], options(cavitation, tolerance))
         call cold%evaluate_pad(1, motion, paper_oil, speed, .true., from_cold)
         worst = max(worst, norm2(from_warm%force - from_cold%force)/norm2(from_cold%force))
         worst = max(worst, norm2(from_warm%derivatives(:, 1:2) - from_cold%derivatives(:, 1:2)) &
            & /norm2(from_cold%derivatives(:, 1:2)))
         call expect(max(from_warm%residual, from_cold%residual) <= tolerance, 'residuals within the tolerance')
      end do
      call expect_close(worst, 0.0_wp, 200*tolerance, 'warm and cold starts meet, '//trim(names(cavitation)))
   end subroutine warm_start

   !> A constant on all pressures, that of cavitation included, is a constant on the film: rounding alone.
   subroutine shifted_pressures(cavitation)
      integer, intent(in) :: cavitation
      real(wp), parameter :: shift = 5e5_wp, half = 0.5_wp*69.3_wp*degree, d = 2*half/24
      type(sor_film_type) :: solver, raised
      type(film_response) :: r, raised_r
      type(film_motion) :: motion
      real(wp) :: force
      motion = film_motion([1e-5_wp, 5e-5_wp], [1e-3_wp, -2e-3_wp])
      solver = new_sor_film([paper_pad([2e5_wp, 1e5_wp, 0.0_wp])], options(cavitation, 1e-8_wp))
      raised = new_sor_film([paper_pad([2e5_wp, 1e5_wp, 0.0_wp] + shift)], options(cavitation, 1e-8_wp))
      call solver%evaluate_pad(1, motion, paper_oil, speed, .true., r)
      call raised%evaluate_pad(1, motion, paper_oil, speed, .true., raised_r)
      force = -shift*0.1_wp*50e-3_wp*2*sin(half)*(0.5_wp*d)/sin(0.5_wp*d)
      call expect_close(maxval(abs(raised%pressure_field(1) - solver%pressure_field(1) - shift)), 0.0_wp, &
         & 1e-12_wp*maxval(raised%pressure_field(1)), 'pressures raised, '//trim(names(cavitation)))
      call expect_close(raised_r%force(1), r%force(1), 1e-11_wp*norm2(raised_r%force), &
         & 'tangential force of raised pressures')
      call expect_close(raised_r%force(2), r%force(2) + force, 1e-11_wp*norm2(raised_r%force), &
         & 'force of raised pressures')
      call expect_close(raised_r%min_pressure, r%min_pressure + shift, 1e-12_wp*raised_r%max_pressure, &
         & 'lowest of raised pressures')
      call expect_close(raised_r%max_pressure, r%max_pressure + shift, 1e-12_wp*raised_r%max_pressure, &
         & 'highest of raised pressures')
      call expect_close(norm2(raised_r%derivatives - r%derivatives), 0.0_wp, 1e-10_wp*norm2(r%derivatives), &
         & 'slopes of raised pressures')
   end subroutine shifted_pressures

   !> A film that a fast opening cavitates everywhere has neither force nor slope, and costs no more sweeps
   !> than the full film before it.
   subroutine nothing_left(cavitation)
      integer, intent(in) :: cavitation
      type(sor_film_type) :: solver
      type(film_response) :: full, empty
      integer(i8) :: sweeps
      solver = new_sor_film([paper_pad()], options(cavitation, 1e-6_wp))
      call solver%evaluate_pad(1, film_motion([-2e-5_wp, 4e-5_wp]), paper_oil, speed, .true., full)
      sweeps = solver%counters%passes
      call solver%evaluate_pad(1, film_motion([2e-5_wp, 4e-5_wp], [0.0_wp, -0.05_wp]), paper_oil, speed, .true., empty)
      call expect(full%status == film_ok .and. empty%status == film_ok, 'full and empty film are fine, ' &
         & //trim(names(cavitation)))
      call expect_close(norm2(empty%force) + norm2(empty%derivatives), 0.0_wp, 0.0_wp, 'an empty film is nothing, ' &
         & //trim(names(cavitation)))
      call expect(solver%counters%passes <= 2*sweeps, 'sweeps of an empty film, '//trim(names(cavitation))//': ' &
         & //to_text(solver%counters%passes - sweeps)//' after '//to_text(sweeps))
   end subroutine nothing_left

   subroutine closed_film()
      type(sor_film_type) :: solver
      type(film_response) :: r
      solver = new_sor_film([paper_pad()], options(cavitation_reynolds, 1e-8_wp))
      call solver%evaluate_pad(1, film_motion([0.0_wp, 1.1_wp*clearance]), paper_oil, speed, .true., r)
      call expect(r%status == film_closed, 'a journal in the pad closes the film')
      call expect_close(r%min_film_thickness, -0.1_wp*clearance, 1e-18_wp, 'by how much')
      call solver%evaluate_pad(1, film_motion([0.0_wp, clearance]), paper_oil, speed, .true., r)
      call expect(r%status == film_closed, 'touching closes the film')
      call solver%evaluate_pad(1, film_motion([0.0_wp, 0.5_wp*clearance]), paper_oil, speed, .true., r)
      call expect(r%status == film_ok .and. r%force(2) < 0, 'the film opens again')
      call expect_close(r%min_film_thickness, 0.5_wp*clearance, 1e-18_wp, 'minimum thickness')
   end subroutine closed_film

   !> A film given up is told, and is no start for the next.
   subroutine sweep_cap()
      type(sor_film_type) :: solver, fresh
      type(sor_options) :: capped
      type(film_response) :: r
      capped = options(cavitation_reynolds, 1e-8_wp)
      capped%max_sweeps = 8
      solver = new_sor_film([paper_pad()], capped)
      call solver%evaluate_pad(1, film_motion([-2e-5_wp, 5e-5_wp]), paper_oil, speed, .false., r)
      call expect(r%status == film_not_converged, 'the cap on the sweeps is told')
      call expect(r%residual > 1e-8_wp, 'with the residual')
      call expect(solver%counters%passes == 8 .and. solver%counters%volumes == 1, 'and the sweeps are counted')
      call expect(all(abs(solver%pressure_field(1)) <= 0), 'what did not converge is dropped')
      capped%max_sweeps = 5000
      fresh = new_sor_film([paper_pad()], capped)
      call fresh%evaluate_pad(1, film_motion([-2e-5_wp, 5e-5_wp]), paper_oil, speed, .false., r)
      call expect(r%status == film_ok, 'enough sweeps converge')
   end subroutine sweep_cap

   !> The default factor needs at most 1.3 times the sweeps of the best of a scan, for a cold start on a
   !> film with a wedge of two to one.
   subroutine relaxation_is_near_best(nx, nz, length)
      integer, intent(in) :: nx, nz
      real(wp), intent(in) :: length
      integer(i8) :: best, chosen
      integer :: k
      chosen = sweeps_at(nx, nz, length, 0.0_wp)
      best = huge(best)
      do k = 0, 38
         best = min(best, sweeps_at(nx, nz, length, 1.6_wp + 0.01_wp*k))
      end do
      call expect(chosen <= 1.3_wp*best, 'sweeps at the default relaxation: '//to_text(chosen)//', best ' &
         & //to_text(best)//', grid '//to_text(nx)//' x '//to_text(nz)//', length '//to_text(length))
   end subroutine relaxation_is_near_best

   !> Sweeps of a cold start at a relaxation factor.
   integer(i8) function sweeps_at(nx, nz, length, relaxation)
      integer, intent(in) :: nx, nz
      real(wp), intent(in) :: length, relaxation
      type(sor_film_type) :: solver
      type(film_response) :: r
      solver = new_sor_film([paper_pad(length=length)], sor_options(nx, nz, relaxation, &
         & 1e-6_wp, 1000, cavitation_none))
      call solver%evaluate_pad(1, film_motion([-3e-5_wp, 4e-5_wp]), paper_oil, speed, .false., r)
      sweeps_at = solver%counters%passes
      if (r%status /= film_ok) sweeps_at = huge(sweeps_at)
   end function sweeps_at

   !> All pads at once answer what each answers alone.
   subroutine pads_are_apart()
      type(pad_gap_type) :: films(2)
      type(sor_film_type) :: both, single
      type(film_motion) :: motion(2)
      type(film_response) :: together(2), alone
      integer :: k
      films(1) = paper_pad()
      films(2) = paper_pad([1e5_wp, 0.0_wp, 0.0_wp], 0.05_wp)
      motion = [film_motion([-2e-5_wp, 5e-5_wp]), film_motion([1e-5_wp, 2e-5_wp])]
      both = new_sor_film(films, options(cavitation_reynolds, 1e-8_wp))
      call both%evaluate(motion, spread(paper_oil, 1, size(motion)), speed, .true., together)
      call expect(both%counters%volumes == 2, 'two pads are two films')
      do k = 1, 2
         single = new_sor_film(films(k:k), options(cavitation_reynolds, 1e-8_wp))
         call single%evaluate_pad(1, motion(k), paper_oil, speed, .true., alone)
         call expect_close(norm2(together(k)%force - alone%force), 0.0_wp, 0.0_wp, 'force of pad '//to_text(k))
         call expect_close(norm2(together(k)%derivatives - alone%derivatives), 0.0_wp, 0.0_wp, &
            & 'slopes of pad '//to_text(k))
      end do
   end subroutine pads_are_apart
end program test_sor_film
