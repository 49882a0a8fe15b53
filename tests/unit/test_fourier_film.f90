!> The film by axial modes: slopes, boundary pressures, tails.
program test_fourier_film
   use kinds, only: wp, pi, degree
   use text, only: to_text
   use film_solver, only: film_motion, film_response, film_ok, film_closed
   use fourier_film, only: fourier_film_type, new_fourier_film
   use film_differences, only: difference
   use paper_bearing, only: paper_oil, offset_pad, speed, clearance
   use check, only: runs, expect, expect_close, between, report
   implicit none (type, external)

   real(wp), parameter :: theta_1 = 40*degree, theta_2 = 30*degree
   integer :: i

   if (runs('slopes')) call slopes()
   do i = 0, 3
      if (runs('heated_edge')) call heated_edge(2**i)
   end do
   if (runs('few_modes')) call few_modes()
   if (runs('shifted_pressures')) call shifted_pressures()
   if (runs('closed_film')) call closed_film()
   call report()

contains

   type(film_motion) function random_motion()
      random_motion%position = clearance*[between(-0.5_wp, 0.2_wp), between(0.0_wp, 0.6_wp)]
      random_motion%velocity = clearance*speed*[between(-0.1_wp, 0.1_wp), between(-0.1_wp, 0.1_wp)]
   end function random_motion

   !> One pad's answer.
   type(film_response) function answer(solver, motion, at_speed)
      type(fourier_film_type), intent(inout) :: solver
      type(film_motion), intent(in) :: motion
      real(wp), intent(in) :: at_speed
      type(film_response) :: all(1)
      call solver%evaluate([motion], [paper_oil], at_speed, .true., all)
      answer = all(1)
   end function answer

   !> Differences with a step of 1e-3 of the clearance (and of it times the speed): an error of 1e-12 times the fifth
   !> derivative, 4**5 times some 10; rounding of a direct solution 1e-14/1e-3.
   subroutine slopes()
      type(fourier_film_type) :: solver
      type(film_motion) :: motion
      type(film_response) :: r
      real(wp) :: expected(2), worst
      integer :: trial, column
      solver = new_fourier_film([offset_pad([2e5_wp, 1e5_wp, 0.0_wp])], 24, 8, gumbel=.false.)
      worst = 0
      do trial = 1, 20
         motion = random_motion()
         r = answer(solver, motion, speed)
         do column = 1, 4
            call difference(solver, motion, paper_oil, speed, column, 1e-3_wp*clearance*merge(1.0_wp, speed, &
               & column <= 2), expected)
            worst = max(worst, maxval(abs(r%derivatives(:, column) - expected))/norm2(expected))
         end do
      end do
      call expect_close(worst, 0.0_wp, 1e-7_wp, 'slopes of the modes')
   end subroutine slopes

   !> A higher pressure at the leading edge, nothing else, on an even film: like heat in a plate. Mode by
   !> mode u = sinh(Lambda (phi + theta_2))/sinh(Lambda arc), whose integrals are closed; 2000 of them leave
   !> 1e-7. The tail of the solver has the edge layers to first order, c_m/Lambda_m, and lacks the second,
   !> c_m/Lambda_m**2: beyond M modes 0.6 sum m**-4 over odd m > 2 M, 0.013/M**3 of the force.
   subroutine heated_edge(modes)
      integer, intent(in) :: modes
      real(wp), parameter :: rise = 3e5_wp, length = 0.1_wp, radius = 50e-3_wp
      type(fourier_film_type) :: solver
      type(film_response) :: r
      real(wp) :: exact(2), lambda, decay
      integer :: k
      exact = 0
      do k = 1, 4001, 2
         lambda = radius*k*pi/length
         decay = exp(-lambda*(theta_1 + theta_2))
         exact = exact - radius*8*length/(k*pi)**2*rise/(1 - decay**2) &
            & *(integral(lambda, theta_1) - decay*integral(lambda, -theta_2) &
            & - decay**2*integral(-lambda, theta_1) + decay*integral(-lambda, -theta_2))
      end do
      solver = new_fourier_film([offset_pad([rise, 0.0_wp, 0.0_wp])], 96, modes, gumbel=.false.)
      r = answer(solver, film_motion([0.0_wp, 0.0_wp]), 0.0_wp)
      call expect_close(norm2(r%force - exact), 0.0_wp, 0.02_wp/modes**3*norm2(exact), 'pressure at the edge, modes ' &
         & //to_text(modes))
   end subroutine heated_edge

   !> Integral of exp(lambda (phi - x)) (sin, cos)(phi) up to x.
   pure function integral(lambda, x)
      real(wp), intent(in) :: lambda, x
      real(wp) :: integral(2)
      integral = [lambda*sin(x) - cos(x), lambda*cos(x) + sin(x)]/(lambda**2 + 1)
   end function integral

   !> The closed form of the tail stands for the modes left out: wedge and squeeze with one to four modes
   !> against twelve, on 96 cells. The narrow-pad limit of mode m has an error of (1/Lambda_m)**2 of its own
   !> c_m/Lambda_m**2, that is m**-6: 1e-2 for all but the first, 1e-3 and 1e-4 for all but two and four, and room for
   !> another once.
   subroutine few_modes()
      type(fourier_film_type) :: solver
      type(film_response) :: most, fewer
      type(film_motion) :: motion
      integer :: k
      motion = film_motion([-2e-5_wp, 4e-5_wp], [1e-3_wp, -2e-3_wp])
      solver = new_fourier_film([offset_pad()], 96, 12, gumbel=.false.)
      most = answer(solver, motion, speed)
      do k = 0, 2
         solver = new_fourier_film([offset_pad()], 96, 2**k, gumbel=.false.)
         fewer = answer(solver, motion, speed)
         call expect_close(norm2(fewer%force - most%force), 0.0_wp, 2*0.1_wp**(k + 2)*norm2(most%force), &
            & 'tail of modes beyond '//to_text(2**k))
      end do
   end subroutine few_modes

   !> A constant on all pressures is a constant on the film.
   subroutine shifted_pressures()
      real(wp), parameter :: shift = 5e5_wp
      type(fourier_film_type) :: solver
      type(film_response) :: low, high
      real(wp) :: force(2)
      type(film_motion), parameter :: motion = film_motion([-1e-5_wp, 5e-5_wp], [1e-3_wp, -2e-3_wp])
      solver = new_fourier_film([offset_pad([2e5_wp, 1e5_wp, 0.0_wp])], 24, 8, gumbel=.false.)
      low = answer(solver, motion, speed)
      solver = new_fourier_film([offset_pad([2e5_wp + shift, 1e5_wp + shift, shift])], 24, 8, gumbel=.false.)
      high = answer(solver, motion, speed)
      force = -shift*0.1_wp*50e-3_wp*[cos(theta_2) - cos(theta_1), sin(theta_1) + sin(theta_2)]
      call expect_close(norm2(high%force - low%force - force), 0.0_wp, 1e-7_wp*norm2(force), &
         & 'force of raised pressures')
      call expect_close(high%max_pressure - low%max_pressure, shift, 1e-10_wp*shift, 'highest of raised pressures')
      call expect_close(high%min_pressure - low%min_pressure, shift, 1e-10_wp*shift, 'lowest of raised pressures')
      call expect_close(norm2(high%derivatives - low%derivatives), 0.0_wp, 1e-9_wp*norm2(low%derivatives), &
         & 'slopes of raised pressures')
   end subroutine shifted_pressures

   subroutine closed_film()
      type(fourier_film_type) :: solver
      type(film_response) :: r
      solver = new_fourier_film([offset_pad()], 24, 8, gumbel=.false.)
      r = answer(solver, film_motion([0.0_wp, 1.1_wp*clearance]), speed)
      call expect(r%status == film_closed, 'a journal in the pad closes the film')
      call expect_close(r%min_film_thickness, -0.1_wp*clearance, 1e-18_wp, 'by how much')
      r = answer(solver, film_motion([0.0_wp, 0.5_wp*clearance]), speed)
      call expect(r%status == film_ok, 'the film opens again')
   end subroutine closed_film
end program test_fourier_film
