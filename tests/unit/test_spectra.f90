!> What is told of motions: spectra, loops, flutter and lift-off of pads, whirl. Spectra of any signal, full ones too:
!> tests/post/test_library.py.
program test_spectra
   use kinds, only: wp, pi
   use text, only: to_text
   use spectra, only: one_sided_amplitude, windowed
   use loops, only: path_integral, harmonic, slow_share, periodicity, new_periodicity
   use pad_behaviour, only: pad_behaviour_type, behaviour_of, whirl_of, dominant, evenly
   use result_remarks, only: pad_diagnosis
   use check, only: runs, expect, expect_close, between, report
   implicit none (type, external)
   !> Transforms of a few hundred samples of order one: log2(n) roundings each, with room.
   real(wp), parameter :: rounding = 1000*epsilon(1.0_wp)
   integer :: i
   !> Samples of a revolution, and revolutions.
   integer, parameter :: samples = 30, revolutions = 40, n = samples*revolutions
   real(wp), parameter :: turns = revolutions

   if (runs('sines')) then
      call sines(64)
      call sines(99)
   end if
   if (runs('window')) call window()
   if (runs('square')) call square()
   if (runs('ellipse')) call ellipse()
   if (runs('line')) call line()
   if (runs('decay')) call decay()
   if (runs('orders')) call orders()
   if (runs('slow')) call slow()
   do i = 1, 10
      if (runs('one_tone')) call one_tone()
   end do
   if (runs('two_tones')) call two_tones()
   if (runs('nothing')) call nothing()
   if (runs('behaviours')) call behaviours()
   if (runs('few')) call few()
   if (runs('run_up')) call run_up()
   if (runs('whirl_pads')) call whirl_pads()
   if (runs('words')) call words()
   call report()

contains

   !> A sine of amplitude a, of any phase, gives a at its frequency and nothing elsewhere.
   subroutine sines(n)
      integer, intent(in) :: n
      real(wp) :: amplitude(0:n/2), time(n)
      integer :: k, j
      time = [(real(j, wp)/n, j=0, n - 1)]
      do k = 1, (n - 1)/2
         amplitude = spectrum_of(3*sin(2*pi*k*time + 0.1_wp*k))
         call expect_close(amplitude(k), 3.0_wp, rounding, 'sine '//to_text(k)//' of '//to_text(n)//' samples')
         amplitude(k) = 0
         call expect(all(amplitude < rounding), 'sine '//to_text(k)//' of '//to_text(n)//' leaks')
      end do
      if (mod(n, 2) == 0) then
         amplitude = spectrum_of(3*cos(pi*n*time))
         call expect_close(amplitude(n/2), 3.0_wp, rounding, 'the highest frequency of '//to_text(n)//' samples')
      end if
   end subroutine sines

   !> Under the window a sine keeps its amplitude and gives half of it to both neighbours alone; one between lines falls
   !> with the third power of the distance, where without a window it falls with the first.
   subroutine window()
      integer, parameter :: n = 360
      real(wp) :: amplitude(0:n/2, 2), at(n)
      integer :: k
      at = [(2*pi*k/n, k=0, n - 1)]
      amplitude = one_sided_amplitude(windowed(reshape([7 + 3*sin(20*at + 0.3_wp), 3*sin(20.5_wp*at)], [n, 2])))
      call expect_close(amplitude(20, 1), 3.0_wp, rounding, 'on a line')
      call expect_close(maxval(abs(amplitude([19, 21], 1) - 1.5_wp)), 0.0_wp, rounding, 'beside it')
      call expect(all(amplitude(:18, 1) < rounding) .and. all(amplitude(22:, 1) < rounding), 'nothing elsewhere')
      ! sin(pi d)/(pi d (1 - d**2)) of both lines at d = 1/2, and less than twice 1/(pi d**3) at d = 30.5; the other
      ! side of the spectrum adds its own, from 40 lines away
      call expect_close(amplitude(20, 2), 3*8/(3*pi), 3*2/(pi*40**3), 'between two lines')
      call expect(amplitude(51, 2) < 2*3/(pi*30.5_wp**3), 'far from it: '//to_text(amplitude(51, 2)))
   end subroutine window

   !> Of a signal that stands between others, which do not matter.
   function spectrum_of(signal) result(amplitude)
      real(wp), intent(in) :: signal(:)
      real(wp) :: amplitude(0:size(signal)/2), all(0:size(signal)/2, 3)
      all = one_sided_amplitude(beside_others(signal))
      amplitude = all(:, 2)
   end function spectrum_of

   subroutine find_dominant(signal, turns, apart, order, amplitude)
      real(wp), intent(in) :: signal(:), turns, apart
      real(wp), intent(out) :: order, amplitude
      real(wp), dimension(3) :: orders, amplitudes
      call dominant(beside_others(signal), turns, apart, orders, amplitudes)
      order = orders(2)
      amplitude = amplitudes(2)
   end subroutine find_dominant

   pure function beside_others(signal) result(signals)
      real(wp), intent(in) :: signal(:)
      real(wp) :: signals(size(signal), 3)
      integer :: k
      signals(:, 1) = [(sin(0.7_wp*k), k=1, size(signal))]
      signals(:, 2) = signal
      signals(:, 3) = 100
   end function beside_others

   subroutine square()
      call expect_close(path_integral([0.0_wp, 0.0_wp, 2.0_wp, 2.0_wp, 0.0_wp], &
         & [0.0_wp, 3.0_wp, 3.0_wp, 0.0_wp, 0.0_wp]), 6.0_wp, &
         & rounding, 'a clockwise rectangle has a positive area')
      call expect_close(path_integral([0.0_wp, 2.0_wp, 2.0_wp, 0.0_wp, 0.0_wp], &
         & [0.0_wp, 0.0_wp, 3.0_wp, 3.0_wp, 0.0_wp]), -6.0_wp, &
         & rounding, 'an anticlockwise rectangle has a negative area')
   end subroutine square

   !> The polygon of n points on an ellipse has the area n/2 a b sin(2 pi/n), wherever its centre.
   subroutine ellipse()
      integer, parameter :: n = 360
      real(wp) :: angle(n + 1), area
      integer :: i
      angle = [(2*pi*i/n, i=0, n)]
      area = path_integral(5 + 3*sin(angle), -7 + 0.5_wp*cos(angle))
      call expect_close(area, 0.5_wp*n*1.5_wp*sin(2*pi/n), 100*rounding, 'the polygon on an ellipse')
      ! the polygon lacks (2 pi/n)**2/6 of the ellipse
      call expect_close(area, 1.5_wp*pi, 1.5_wp*pi*(2*pi/n)**2/6, 'the ellipse, to second order')
   end subroutine ellipse

   !> There and back on any curve encloses nothing.
   subroutine line()
      real(wp), parameter :: x(*) = [0.0_wp, 1.0_wp, 2.0_wp, 3.0_wp, 2.0_wp, 1.0_wp, 0.0_wp]
      call expect_close(path_integral(x, x**2), 0.0_wp, 100*rounding, 'there and back encloses nothing')
   end subroutine line

   !> A decaying oscillation of n samples a revolution: x = r**revolution sin(angle) changes by
   !> r**(k - 1) (1 - r) from revolution k - 1 to k, counted from 0.
   subroutine decay()
      integer, parameter :: n = 8
      real(wp), parameter :: ratio = 0.5_wp
      type(periodicity) :: orbit
      integer :: i, revolution
      orbit = new_periodicity(n, 2, 0)
      do i = 0, 4*n - 1
         revolution = i/n
         call orbit%add([ratio**revolution*sin(2*pi*i/n), 1.0_wp])
         if (i < 2*n - 1) call expect(orbit%change > 1e300_wp, 'no change before two whole revolutions')
         if (mod(i, n) == n - 1 .and. revolution > 0) call expect_close(orbit%change, &
            & ratio**(revolution - 1)*(1 - ratio), rounding, 'change from one revolution to the next')
      end do
   end subroutine decay

   !> amplitude * cos(2 pi order turns + 1).
   pure function tone(order, amplitude)
      real(wp), intent(in) :: order, amplitude
      real(wp) :: tone(n)
      integer :: k
      tone = [(amplitude*cos(2*pi*order*k/samples + 1), k=0, n - 1)]
   end function tone

   !> Between the lines too: what is left is the other side of the spectrum, which a Hann window lets fall with the
   !> third power of the distance in lines, 2 x 0.2 x 40.
   subroutine one_tone()
      real(wp) :: order, amplitude, expected
      expected = between(0.2_wp, 10.0_wp)
      call find_dominant(3.0_wp + tone(expected, 2e-3_wp), turns, 0.0_wp, order, amplitude)
      call expect_close(order, expected, 1e-3_wp/revolutions, 'order')
      call expect_close(amplitude, 2e-3_wp, 1e-3_wp*2e-3_wp, 'amplitude')
   end subroutine one_tone

   !> The larger one; a drift is none.
   subroutine two_tones()
      real(wp) :: order, amplitude, drift(n)
      integer :: k
      drift = [(1e-2_wp*k/n, k=1, n)]
      call find_dominant(tone(1.0_wp, 1e-3_wp) + tone(0.48_wp, 1.5e-3_wp) + drift, turns, 0.0_wp, order, amplitude)
      call expect_close(order, 0.48_wp, 2e-3_wp, 'order of the larger')
      call expect_close(amplitude, 1.5e-3_wp, 5e-5_wp, 'its amplitude')
      call find_dominant(tone(1.0_wp, 2e-3_wp) + tone(0.48_wp, 1.5e-3_wp), turns, 0.0_wp, order, amplitude)
      call expect_close(order, 1.0_wp, 1e-4_wp, 'the shaft''s')
      call find_dominant(tone(1.0_wp, 2e-3_wp) + tone(0.48_wp, 1.5e-3_wp), turns, 0.1_wp, order, amplitude)
      call expect_close(order, 0.48_wp, 2e-3_wp, 'the other, where the shaft''s is left out')
   end subroutine two_tones

   subroutine nothing()
      real(wp) :: order, amplitude
      call find_dominant(spread(1.0_wp, 1, n), turns, 0.0_wp, order, amplitude)
      call expect(order < 0 .and. abs(amplitude) <= 0, 'a pad at rest has no order')
      call find_dominant([1.0_wp], 1.0_wp, 0.0_wp, order, amplitude)
      call expect(order < 0, 'nor has a single sample')
   end subroutine nothing

   !> A loaded pad, one that flutters and touches its pivot a quarter of the time, one that moves little.
   subroutine behaviours()
      type(pad_behaviour_type) :: found(4)
      real(wp), dimension(4, n) :: contact, tilt
      contact = 0
      contact(1, :) = 1e4_wp + 1e7_wp*tone(1.0_wp, 1e-4_wp)
      contact(2, ::4) = 20
      contact(3, :) = 5e3_wp
      contact(4, :) = 5e3_wp
      tilt(1, :) = tone(1.0_wp, 1e-4_wp)
      tilt(2, :) = tone(0.48_wp, 1e-3_wp)
      tilt(3, :) = tone(0.48_wp, 1e-6_wp)
      tilt(4, :) = tone(2.0_wp, 1e-3_wp)
      call behaviour_of(found, contact, tilt, turns, spread(1e-3_wp, 1, 4))
      call expect_close(found(1)%load, 1e4_wp, 1e-6_wp, 'mean load')
      call expect(all(found%unloaded .eqv. [.false., .true., .false., .false.]), 'the second has no load')
      call expect_close(found(2)%load, 5.0_wp, 1e-12_wp, 'or little')
      call expect_close(found(2)%lifted, 0.75_wp, 1e-12_wp, 'and is lifted')
      call expect(all(found%flutters .eqv. [.false., .true., .false., .false.]), 'and flutters')
      call expect_close(found(2)%order, 0.48_wp, 1e-3_wp, 'at 0.48')
      call expect(all(abs(found([1, 3, 4])%lifted) <= 0), 'no other is lifted')
   end subroutine behaviours

   !> In few revolutions no orders are known.
   subroutine few()
      type(pad_behaviour_type) :: found(1)
      real(wp), dimension(1, n) :: contact, tilt
      contact = 1
      tilt(1, :) = tone(0.48_wp, 1e-3_wp)
      call behaviour_of(found, contact, tilt, 7.9_wp, [1e-3_wp])
      call expect(found(1)%order < 0 .and. .not. found(1)%flutters, 'no order')
      call expect(.not. found(1)%unloaded, 'a single pad carries all')
   end subroutine few

   !> While the speed rises the orders are those at equal steps of the shaft angle.
   subroutine run_up()
      real(wp) :: angle(n), order, amplitude
      integer :: k
      angle = [(2*pi*revolutions*(k + 0.5_wp*real(k, wp)**2/n)/(1.5_wp*n), k=0, n - 1)]
      call find_dominant(evenly(angle, cos(0.48_wp*angle)), (angle(n) - angle(1))/(2*pi), 0.0_wp, order, amplitude)
      call expect_close(order, 0.48_wp, 1e-3_wp, 'order')
      call expect_close(amplitude, 1.0_wp, 1e-3_wp, 'amplitude')
   end subroutine run_up

   !> The larger part of both directions beside the shaft's own, unless it is too small to see.
   subroutine whirl_pads()
      real(wp) :: order, amplitude, y(n), z(n)
      logical :: whirls
      y = tone(0.47_wp, 2e-5_wp) + tone(1.0_wp, 1e-5_wp)
      z = tone(0.47_wp, 3e-5_wp)
      call whirl_of(y, z, turns, 1e-4_wp, order, amplitude, whirls)
      call expect(whirls, 'a whirl')
      call expect_close(order, 0.47_wp, 2e-3_wp, 'its order')
      call expect_close(amplitude, 3e-5_wp, 1e-6_wp, 'its amplitude, the larger')
      call whirl_of(y, z, 4.0_wp, 1e-4_wp, order, amplitude, whirls)
      call expect(.not. whirls, 'not known of four revolutions')
      call whirl_of(y, z, turns, 1e-2_wp, order, amplitude, whirls)
      call expect(.not. whirls, 'not in a clearance as wide as this')
      call whirl_of(tone(1.0_wp, 2e-5_wp), z, turns, 1e-4_wp, order, amplitude, whirls)
      call expect(whirls, 'z alone')
      call whirl_of(y, tone(1.0_wp, 3e-5_wp), turns, 1e-4_wp, order, amplitude, whirls)
      call expect(whirls .and. abs(order - 0.47_wp) < 2e-3_wp, 'beside a larger motion with the shaft')
      call whirl_of(tone(1.0_wp, 2e-5_wp), tone(2.0_wp, 3e-5_wp), turns, 1e-4_wp, order, amplitude, whirls)
      call expect(.not. whirls, 'the shaft''s own and its multiples')
   end subroutine whirl_pads

   subroutine words()
      type(pad_behaviour_type) :: pad
      call expect(pad_diagnosis(pad) == '', 'nothing of a loaded pad')
      pad%unloaded = .true.
      pad%load = 12
      pad%flutters = .true.
      pad%order = 0.48_wp
      pad%amplitude = 0.52e-3_wp
      call expect(pad_diagnosis(pad) == 'carries next to no load (mean 12.0 N); it flutters at 0.480 of the shaft ' &
         & //'speed, amplitude of the tilt 0.5200 mrad', 'unloaded and fluttering: '//pad_diagnosis(pad))
      pad = pad_behaviour_type(rubbing=0.125_wp, lifted=0.25_wp)
      call expect(pad_diagnosis(pad) == 'is lifted off its pivot 25.0 % of the time; it rubs on the journal ' &
         & //'12.5 % of the time', 'lifted and rubbing: '//pad_diagnosis(pad))
   end subroutine words

   !> Amplitude and phase of an order, beside a mean and another order, over whole turns of both.
   subroutine orders()
      integer, parameter :: n = 720
      real(wp) :: angle(n + 1), values(n + 1)
      integer :: i
      angle = [(3 + 4*pi*i/n, i=0, n)]
      values = 7 + 2*cos(angle - 0.4_wp) + 5*cos(0.5_wp*angle + 1)
      call expect_close(abs(harmonic(angle, values, 1.0_wp) - 2*exp(cmplx(0.0_wp, -0.4_wp, wp))), 0.0_wp, rounding, &
         & 'with the shaft')
      call expect_close(abs(harmonic(angle, values, 0.5_wp) - 5*exp(cmplx(0.0_wp, 1.0_wp, wp))), 0.0_wp, rounding, &
         & 'at half its speed')
   end subroutine orders

   !> A velocity that crosses the limits between samples, touches none, and stays constant.
   subroutine slow()
      call expect_close(slow_share([0.0_wp, 1.0_wp, 2.0_wp], [-10.0_wp, 10.0_wp, 10.0_wp], 1.0_wp), 0.05_wp, rounding, &
         & 'a tenth of the first second')
      call expect_close(slow_share([0.0_wp, 1.0_wp], [2.0_wp, 0.0_wp], 1.0_wp), 0.5_wp, rounding, 'the second half')
      call expect_close(slow_share([0.0_wp, 3.0_wp], [0.5_wp, 0.5_wp], 1.0_wp), 1.0_wp, rounding, 'it creeps')
      call expect_close(slow_share([0.0_wp, 3.0_wp], [2.0_wp, 5.0_wp], 1.0_wp), 0.0_wp, rounding, 'it slides')
   end subroutine slow
end program test_spectra
