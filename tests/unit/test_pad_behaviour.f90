!> What pads do, told from samples of which it is known, and the words of the summary.
program test_pad_behaviour
   use kinds, only: wp, pi
   use pad_behaviour, only: pad_behaviour_type, behaviour_of, whirl_of, dominant
   use pad_remarks, only: pad_words
   use check, only: runs, expect, expect_close, between, report
   implicit none (type, external)

   !> Samples of a revolution, and revolutions.
   integer, parameter :: samples = 30, revolutions = 40, n = samples*revolutions
   integer :: i

   do i = 1, 10
      if (runs('one_tone')) call one_tone()
   end do
   if (runs('two_tones')) call two_tones()
   if (runs('nothing')) call nothing()
   if (runs('behaviours')) call behaviours()
   if (runs('run_up')) call run_up()
   if (runs('whirl')) call whirl()
   if (runs('words')) call words()
   call report()

contains

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
      call dominant(3.0_wp + tone(expected, 2e-3_wp), revolutions, order, amplitude)
      call expect_close(order, expected, 1e-3_wp/revolutions, 'order')
      call expect_close(amplitude, 2e-3_wp, 1e-3_wp*2e-3_wp, 'amplitude')
   end subroutine one_tone

   !> The larger one; a drift is none.
   subroutine two_tones()
      real(wp) :: order, amplitude, drift(n)
      integer :: k
      drift = [(1e-2_wp*k/n, k=1, n)]
      call dominant(tone(1.0_wp, 1e-3_wp) + tone(0.48_wp, 1.5e-3_wp) + drift, revolutions, order, amplitude)
      call expect_close(order, 0.48_wp, 2e-3_wp, 'order of the larger')
      call expect_close(amplitude, 1.5e-3_wp, 5e-5_wp, 'its amplitude')
      call dominant(tone(1.0_wp, 2e-3_wp) + tone(0.48_wp, 1.5e-3_wp), revolutions, order, amplitude)
      call expect_close(order, 1.0_wp, 1e-4_wp, 'the shaft''s')
   end subroutine two_tones

   subroutine nothing()
      real(wp) :: order, amplitude
      call dominant(spread(1.0_wp, 1, n), revolutions, order, amplitude)
      call expect(order < 0 .and. abs(amplitude) <= 0, 'a pad at rest has no order')
      call dominant([1.0_wp], 1, order, amplitude)
      call expect(order < 0, 'nor has a single sample')
   end subroutine nothing

   !> A loaded pad, one that flutters and touches its pivot a quarter of the time, one that moves little, one that rubs.
   subroutine behaviours()
      type(pad_behaviour_type) :: found(4)
      real(wp), dimension(4, n) :: contact, tilt, asperity
      contact = 0
      contact(1, :) = 1e4_wp + 1e7_wp*tone(1.0_wp, 1e-4_wp)
      contact(2, ::4) = 20
      contact(3, :) = 5e3_wp
      contact(4, :) = 5e3_wp
      tilt(1, :) = tone(1.0_wp, 1e-4_wp)
      tilt(2, :) = tone(0.48_wp, 1e-3_wp)
      tilt(3, :) = tone(0.48_wp, 1e-6_wp)
      tilt(4, :) = tone(2.0_wp, 1e-3_wp)
      asperity = 0
      asperity(4, :n/5) = 3
      found = behaviour_of(contact, tilt, asperity, revolutions, spread(1e-3_wp, 1, 4))
      call expect_close(found(1)%load, 1e4_wp, 1e-6_wp, 'mean load')
      call expect(all(found%unloaded .eqv. [.false., .true., .false., .false.]), 'the second has no load')
      call expect_close(found(2)%load, 5.0_wp, 1e-12_wp, 'or little')
      call expect_close(found(2)%lifted, 0.75_wp, 1e-12_wp, 'and is lifted')
      call expect(all(found%flutters .eqv. [.false., .true., .false., .false.]), 'and flutters')
      call expect_close(found(2)%order, 0.48_wp, 1e-3_wp, 'at 0.48')
      call expect_close(found(4)%rubbing, 0.2_wp, 1e-12_wp, 'the fourth rubs')
      call expect(all(abs(found([1, 3, 4])%lifted) <= 0), 'no other is lifted')
   end subroutine behaviours

   !> Without whole revolutions no orders are known.
   subroutine run_up()
      type(pad_behaviour_type) :: found(1)
      real(wp), dimension(1, n) :: contact, tilt, asperity
      contact = 1
      tilt(1, :) = tone(0.48_wp, 1e-3_wp)
      asperity = 0
      found = behaviour_of(contact, tilt, asperity, 0, [1e-3_wp])
      call expect(found(1)%order < 0 .and. .not. found(1)%flutters, 'no order')
      call expect(.not. found(1)%unloaded, 'a single pad carries all')
   end subroutine run_up

   !> The larger part of both directions, unless it is the shaft's own or too small to see.
   subroutine whirl()
      real(wp) :: order, amplitude, y(n), z(n)
      logical :: whirls
      y = tone(0.47_wp, 2e-5_wp) + tone(1.0_wp, 1e-5_wp)
      z = tone(0.47_wp, 3e-5_wp)
      call whirl_of(y, z, revolutions, 1e-4_wp, order, amplitude, whirls)
      call expect(whirls, 'a whirl')
      call expect_close(order, 0.47_wp, 2e-3_wp, 'its order')
      call expect_close(amplitude, 3e-5_wp, 1e-6_wp, 'its amplitude, the larger')
      call whirl_of(y, z, 4, 1e-4_wp, order, amplitude, whirls)
      call expect(.not. whirls, 'not known of four revolutions')
      call whirl_of(y, z, revolutions, 1e-2_wp, order, amplitude, whirls)
      call expect(.not. whirls, 'not in a clearance as wide as this')
      call whirl_of(tone(1.0_wp, 2e-5_wp), z, revolutions, 1e-4_wp, order, amplitude, whirls)
      call expect(whirls, 'z alone')
      call whirl_of(y, tone(1.0_wp, 3e-5_wp), revolutions, 1e-4_wp, order, amplitude, whirls)
      call expect(.not. whirls, 'the shaft''s own')
   end subroutine whirl

   subroutine words()
      type(pad_behaviour_type) :: pad
      call expect(pad_words(pad) == '', 'nothing of a loaded pad')
      pad%unloaded = .true.
      pad%load = 12
      pad%flutters = .true.
      pad%order = 0.48_wp
      pad%amplitude = 0.52e-3_wp
      call expect(pad_words(pad) == 'carries no load (mean 12.0 N); it flutters at 0.480 of the shaft speed, ' &
         & //'amplitude of the tilt 0.5200 mrad', 'unloaded and fluttering: '//pad_words(pad))
      pad = pad_behaviour_type(rubbing=0.125_wp, lifted=0.25_wp)
      call expect(pad_words(pad) == 'is lifted off its pivot 25.0 % of the time; it rubs on the journal 12.5 % of ' &
         & //'the time', 'lifted and rubbing: '//pad_words(pad))
   end subroutine words
end program test_pad_behaviour
