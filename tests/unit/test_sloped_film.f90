!> Films with slopes: against an independent program, films without slopes, mirrors, differences.
program test_sloped_film
   use kinds, only: wp, pi, degree
   use text, only: to_text
   use film_solver, only: film_motion, film_response, film_law_type, cavitation_none, cavitation_gumbel, &
      & cavitation_reynolds
   use pad_gap, only: pad_gap_type
   use fourier_film, only: fourier_film_type, converged_film
   use sloped_film, only: sloped_film_type, sloped_motion, sloped_response, new_sloped_film
   use film_losses, only: film_losses_type, film_loss, new_film_losses
   use asperity_contact, only: asperity_contact_type, asperity_load, sloped_asperity_load, new_asperity_contact
   use paper_bearing, only: paper_oil, paper_pad, offset_pad, uneven
   use check, only: runs, expect, expect_close, between, report
   implicit none (type, external)

   !> 6500 rpm.
   real(wp), parameter :: speed = 6500*pi/30, clearance = 100e-6_wp

   if (runs('independent')) call independent()
   if (runs('differences')) call differences([0.0_wp, 0.0_wp, 0.0_wp], paper_oil, cavitation_none)
   if (runs('differences')) call differences([3e5_wp, 1e5_wp, -1e5_wp], paper_oil, cavitation_none)
   if (runs('differences')) call differences([3e5_wp, 1e5_wp, -1e5_wp], uneven, cavitation_none)
   if (runs('differences')) call differences([3e5_wp, 1e5_wp, -1e5_wp], paper_oil, cavitation_gumbel)
   if (runs('differences')) call differences([0.0_wp, 0.0_wp, 0.0_wp], paper_oil, cavitation_reynolds)
   if (runs('aligned')) then
      call aligned([0.0_wp, 0.0_wp, 0.0_wp], paper_oil, cavitation_none)
      call aligned([3e5_wp, 1e5_wp, -1e5_wp], paper_oil, cavitation_none)
      call aligned([3e5_wp, 1e5_wp, -1e5_wp], uneven, cavitation_none)
      call aligned([3e5_wp, 1e5_wp, -1e5_wp], paper_oil, cavitation_gumbel)
      call aligned([0.0_wp, 0.0_wp, 0.0_wp], uneven, cavitation_gumbel)
   end if
   if (runs('losses')) then
      call losses([0.0_wp, 0.0_wp, 0.0_wp], paper_oil, cavitation_none)
      call losses([3e5_wp, 1e5_wp, 0.0_wp], paper_oil, cavitation_reynolds)
      call losses([0.0_wp, 0.0_wp, 0.0_wp], uneven, cavitation_reynolds)
      call losses([0.0_wp, 0.0_wp, 0.0_wp], paper_oil, cavitation_gumbel)
   end if
   if (runs('asperities')) call asperities()
   if (runs('energy')) call energy(cavitation_none)
   if (runs('energy')) call energy(cavitation_reynolds)
   call report()

contains

   !> Single full films of the study behind docs/verification.md, *Slopes*: Galerkin's method with 20 x 14 functions.
   subroutine independent()
      call one('pitch 0', 0.1_wp, [-26.0_wp, 52.0_wp, 0.0_wp, 0.0_wp], [23.8436_wp, 13547.03_wp, 0.0_wp, 0.0_wp], 5.10244e6_wp)
      call one('pitch 200', 0.1_wp, [-26.0_wp, 52.0_wp, 0.0_wp, 200.0_wp], &
         & [41.6085_wp, 13985.85_wp, 1.89671_wp, 68.8747_wp], 5.64823e6_wp)
      call one('pitch 500', 0.1_wp, [-26.0_wp, 52.0_wp, 0.0_wp, 500.0_wp], &
         & [176.410_wp, 16808.80_wp, 7.49423_wp, 215.276_wp], 9.25872e6_wp)
      call one('yaw 300', 0.1_wp, [-26.0_wp, 52.0_wp, 300.0_wp, 0.0_wp], &
         & [-66.5113_wp, 13739.42_wp, 12.28122_wp, -73.01773_wp], 5.56730e6_wp)
      call one('ruptured', 0.1_wp, [0.0_wp, 50.0_wp, 0.0_wp, 300.0_wp], &
         & [563.7244_wp, 2186.777_wp, 6.505341_wp, 23.994934_wp], 1.6529643e6_wp, cavitation_reynolds)
      call one('ruptured', 0.1_wp, [0.0_wp, 50.0_wp, 0.0_wp, 0.0_wp], &
         & [490.4097_wp, 1907.721_wp, 0.0_wp, 0.0_wp], 1.0488399e6_wp, cavitation_reynolds)
      call one('LD 0.5', 0.05_wp, [-29.0_wp, 60.0_wp, 0.0_wp, 600.0_wp], &
         & [40.26555_wp, 7521.378_wp, 0.530276_wp, 28.66551_wp], 7.00755e6_wp)
   end subroutine independent

   !> Force, moment and highest pressure of one film; e in um, slope in urad; of the pad.
   subroutine one(name, length, e, expected, highest, condition)
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: length, e(4), expected(4), highest
      integer, intent(in), optional :: condition
      type(sloped_film_type) :: film
      type(sloped_response) :: r
      integer :: used
      used = cavitation_none
      if (present(condition)) used = condition
      film = new_sloped_film([paper_pad(length=length)], used)
      call film%evaluate_pad(1, motion_of(1e-6_wp*e), paper_oil, speed, .false., r)
      call expect(norm2(r%film%force + expected(:2)) < 1e-3_wp*norm2(expected(:2)), name//': force')
      call expect(norm2(r%moment + expected(3:)) < 3e-3_wp*norm2(expected(3:)) + 1e-6_wp*length*norm2(expected), &
         & name//': moment')
      call expect_close(r%film%max_pressure, highest, 1e-2_wp*highest, name//': highest pressure')
      print *, name, norm2(r%film%force + expected(:2))/norm2(expected), &
         & norm2(r%moment + expected(3:))/(1e-3_wp + norm2(expected(3:))), r%film%max_pressure/highest - 1, &
         & r%place(1)/degree, r%place(2)
   end subroutine one

   pure type(sloped_motion) function motion_of(e)
      real(wp), intent(in) :: e(4)
      motion_of = sloped_motion(film_motion(e(:2)), e(3:))
   end function motion_of

   !> Without slopes the films are those of axial modes.
   subroutine aligned(pressures, oil, condition)
      real(wp), intent(in) :: pressures(3)
      class(film_law_type), intent(in) :: oil
      integer, intent(in) :: condition
      type(sloped_film_type) :: film
      type(fourier_film_type) :: modes
      type(sloped_response) :: r
      type(film_response) :: f
      type(sloped_motion) :: motion
      integer :: trial
      film = new_sloped_film([offset_pad(pressures)], condition)
      modes = converged_film(offset_pad(pressures), condition == cavitation_gumbel, 1e-6_wp)
      do trial = 1, 6
         motion%middle%position = clearance*[between(-0.5_wp, 0.4_wp), between(0.0_wp, 0.6_wp)]
         motion%middle%velocity = clearance*speed*[between(-0.1_wp, 0.1_wp), between(-0.1_wp, 0.1_wp)]
         call film%evaluate_pad(1, motion, oil, speed, .true., r)
         call modes%evaluate_pad(1, motion%middle, oil, speed, .true., f)
         print '(a,8es10.2)', 'aligned', norm2(r%film%force - f%force)/norm2(f%force), norm2(r%moment), &
            & norm2(r%derivatives(:2, :2) - f%derivatives(:, :2))/norm2(f%derivatives(:, :2)), &
            & norm2(r%derivatives(:2, 5:6) - f%derivatives(:, 3:))/norm2(f%derivatives(:, 3:)), &
            & (r%film%max_pressure - f%max_pressure)/(f%max_pressure - f%min_pressure), &
            & (r%film%min_pressure - f%min_pressure)/(f%max_pressure - f%min_pressure), f%min_pressure, f%max_pressure
      end do
   end subroutine aligned

   subroutine losses(pressures, oil, condition)
      real(wp), intent(in) :: pressures(3)
      class(film_law_type), intent(in) :: oil
      integer, intent(in) :: condition
      type(sloped_film_type) :: film
      type(film_losses_type) :: without
      type(film_loss) :: a, b
      type(sloped_motion) :: motion
      integer :: trial
      film = new_sloped_film([offset_pad(pressures)], condition)
      without = new_film_losses(offset_pad(pressures), condition)
      do trial = 1, 4
         motion%middle%position = clearance*[between(-0.5_wp, 0.4_wp), between(0.0_wp, 0.6_wp)]
         motion%middle%velocity = clearance*speed*[between(-0.1_wp, 0.1_wp), between(-0.1_wp, 0.1_wp)]
         call film%find_loss(1, motion, oil, speed, a)
         call without%find(motion%middle, oil, speed, b)
         print '(a,10es10.2)', 'losses', norm2(a%force - b%force)/norm2(b%force), a%couette/b%couette - 1, &
            & (a%pressure - b%pressure)/b%couette, (a%wedge - b%wedge)/b%couette, a%inlet/b%inlet - 1, &
            & (a%outlet - b%outlet)/b%inlet, (a%side - b%side)/b%inlet, (a%unfed - b%unfed)/b%inlet, b%unfed/b%inlet, &
            & b%pressure/b%couette
      end do
   end subroutine losses

   !> Contact of asperities: without slopes that of asperity_contact; its derivatives are slopes.
   subroutine asperities()
      type(asperity_contact_type) :: contact
      type(asperity_load) :: without
      type(sloped_asperity_load) :: load, low, high
      type(sloped_motion) :: motion
      real(wp) :: step, errors(3)
      integer :: trial, k
      contact = new_asperity_contact(1e-6_wp, 1.15e11_wp, 1e-3_wp, 0.1_wp, 34.0_wp)
      associate (pad => offset_pad())
      do trial = 1, 8
         motion = motion_of(clearance*[0.3_wp, 0.926_wp, 0.0_wp, 0.0_wp])
         call contact%evaluate(pad, pad%directions(), motion%middle, speed, without)
         call contact%evaluate_sloped(pad, pad%directions(), motion, speed, load)
         print '(a,l2,8es10.2)', 'asp', load%touches, norm2(load%force - without%force)/norm2(without%force), &
            & norm2(load%slopes(:2, :2) - without%force_slopes)/norm2(without%force_slopes), load%moment - without%moment, &
            & norm2(load%film_motion%middle%position - without%film_position), norm2(load%film_motion%slope)
         motion%slope = clearance*[between(-0.5_wp, 0.5_wp), between(-0.5_wp, 0.5_wp)]
         call contact%evaluate_sloped(pad, pad%directions(), motion, speed, load)
         errors = 0
         do k = 1, 4
            step = clearance*merge(1e-6_wp, 2e-5_wp, k <= 2)
            call contact%evaluate_sloped(pad, pad%directions(), motion%moved(k, step), speed, high)
            call contact%evaluate_sloped(pad, pad%directions(), motion%moved(k, -step), speed, low)
            errors(1) = max(errors(1), norm2([(high%force - low%force), (high%journal_moment - low%journal_moment)] &
               & - 2*step*load%slopes(:, k))/norm2(2*step*load%slopes(:, k)))
            errors(2) = max(errors(2), abs(high%moment - low%moment - 2*step*load%turning_slopes(k)) &
               & /norm2(2*step*load%turning_slopes))
            errors(3) = max(errors(3), norm2([(high%film_motion%middle%position - low%film_motion%middle%position), &
               & 0.05_wp*(high%film_motion%slope - low%film_motion%slope)] - 2*step*[1.0_wp, 1.0_wp, 0.05_wp, 0.05_wp]* &
               & load%film_slopes_4(:, k))/step)
         end do
         print '(a,l2,8es10.2)', 'asp', load%touches, errors, load%thickness
      end do
      end associate
   end subroutine asperities

   !> What the journal does to the film becomes heat; what flows in flows out.
   subroutine energy(condition)
      integer, intent(in) :: condition
      type(sloped_film_type) :: film
      type(film_loss) :: loss
      type(sloped_motion) :: motion
      type(sloped_response) :: r
      integer :: trial
      film = new_sloped_film([offset_pad()], condition)
      do trial = 1, 4
         motion = motion_of(clearance*[between(-0.5_wp, 0.4_wp), between(0.0_wp, 0.5_wp), between(-3.0_wp, 3.0_wp), &
            & between(-4.0_wp, 4.0_wp)])
         motion%middle%velocity = clearance*speed*[between(-0.1_wp, 0.1_wp), between(-0.1_wp, 0.1_wp)]
         motion%slope_rate = clearance*speed*[between(-1.0_wp, 1.0_wp), between(-1.0_wp, 1.0_wp)]
         call film%evaluate_pad(1, motion, paper_oil, speed, .false., r)
         call film%find_loss(1, motion, paper_oil, speed, loss)
         print '(a,10es10.2)', 'energy', (loss%wedge - dot_product(r%film%force, motion%middle%velocity) &
            & - dot_product(r%moment, motion%slope_rate) - loss%pressure)/loss%pressure, loss%pressure, loss%wedge, &
            & norm2(loss%force-r%film%force)/norm2(loss%force)
      end do
   end subroutine energy

   subroutine differences(pressures, oil, condition)
      real(wp), intent(in) :: pressures(3)
      class(film_law_type), intent(in) :: oil
      integer, intent(in) :: condition
      type(sloped_film_type) :: film
      type(sloped_response) :: r, low, high
      type(sloped_motion) :: motion
      real(wp) :: step(8), found(4, 8), scale
      integer :: k
      film = new_sloped_film([offset_pad(pressures)], condition)
      step = 1e-6_wp*clearance*[1.0_wp, 1.0_wp, 20.0_wp, 20.0_wp, speed, speed, 20*speed, 20*speed]
      motion = motion_of([-26e-6_wp, 52e-6_wp, 100e-6_wp, 200e-6_wp])
      motion%middle%velocity = clearance*speed*[0.03_wp, -0.05_wp]
      motion%slope_rate = clearance*speed*[0.5_wp, -0.3_wp]
      call film%evaluate_pad(1, motion, oil, speed, .true., r)
      do k = 1, 8
         call film%evaluate_pad(1, motion%moved(k, step(k)), oil, speed, .false., high)
         call film%evaluate_pad(1, motion%moved(k, -step(k)), oil, speed, .false., low)
         found(:, k) = [high%film%force - low%film%force, high%moment - low%moment]/(2*step(k))
      end do
      do k = 1, 4
         scale = maxval(abs(r%derivatives(k, :)*step))
         print '(8es12.3)', (found(k, :) - r%derivatives(k, :))*step/scale
      end do
   end subroutine differences
end program test_sloped_film
