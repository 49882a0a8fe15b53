!> The linearised bearing against the motion itself, marched: the response to a small harmonic force on the journal,
!> growth and decay on both sides of the threshold of stability, and decay with temperatures along and across the films.
module forced_motion
   use kinds, only: wp
   use equations_of_motion, only: machine_model
   implicit none (type, external)
   private
   public :: forced_model

   !> A model with a force on the journal that is the sum of cosines of these angular frequencies, rad/s.
   type, extends(machine_model) :: forced_model
      !> Amplitude of each along y and z, N.
      real(wp) :: force(2) = 0
      real(wp), allocatable :: frequencies(:)
   contains
      procedure :: rhs => forced_rhs
   end type forced_model

contains

   subroutine forced_rhs(self, t, y, dydt, ok)
      class(forced_model), intent(inout), target :: self
      real(wp), intent(in) :: t, y(:)
      real(wp), intent(out) :: dydt(:)
      logical, intent(out) :: ok
      call self%machine_model%rhs(t, y, dydt, ok)
      if (ok) dydt(3:4) = dydt(3:4) + self%force*sum(cos(self%frequencies*t))/self%inputs%rotor%mass
   end subroutine forced_rhs
end module forced_motion

program test_linear_motion
   use kinds, only: wp, pi
   use text, only: to_text
   use case_inputs, only: case_type
   use input_cases, only: case_of
   use operating_point, only: operating_point_type
   use sampled_march, only: march_samples
   use linear_analysis, only: analyse
   use equations_of_motion, only: machine_model
   use linear_bearing, only: bearing_coefficients_type, vibration_modes_type
   use forced_motion, only: forced_model
   use check, only: runs, expect, expect_close, report
   implicit none (type, external)

   if (runs('response')) call response()
   if (runs('free')) call both_sides('free', 14945.85_wp)
   if (runs('stuck')) call both_sides('stuck', 8700.0_wp)
   if (runs('film_temperatures')) call film_temperatures()
   call report()

contains

   !> Films that are smooth, so that a small motion is.
   type(case_type) function smooth_case(speed_rpm) result(inputs)
      real(wp), intent(in) :: speed_rpm
      inputs = case_type()
      inputs%about%task = 'coefficients'
      inputs%bearings(1)%film%solver = 'fourier'
      inputs%bearings(1)%film%cavitation = 'none'
      inputs%operation%speed_rpm = speed_rpm
      inputs%operation%final_speed_rpm = speed_rpm
   end function smooth_case

   !> F = (K(nu) + i nu C(nu) - nu^2 m) x of the steady vibration x that a force F leaves. 10 N of each frequency move
   !> the journal by some 20 nm, a part of 5e-4 of the film: what is not linear changes a harmonic by the square of
   !> that. The start has died away to exp(-15).
   subroutine response()
      type(case_type) :: inputs
      type(bearing_coefficients_type) :: found
      type(machine_model) :: model
      real(wp), allocatable :: y(:), ratios(:)
      complex(wp) :: x(2, 3, 2), expected(2, 2), force(2, 2)
      real(wp), parameter :: amplitude = 10
      integer :: k, i
      inputs = smooth_case(6500.0_wp)
      ratios = [0.4_wp, 1.0_wp, 1.7_wp]
      inputs%coefficients%frequency_ratio = ratios
      call analyse(inputs, 'analysis', found, fine=model, y=y)
      do i = 1, 2
         x(:, :, i) = vibration(model, y, ratios, merge(amplitude, 0.0_wp, [i == 1, i == 2]))
      end do
      do k = 1, 3
         associate (frequency => ratios(k)*model%point%speed(0.0_wp))
            expected = cmplx(found%stiffness(:, :, k, 1, 1), frequency*found%damping(:, :, k, 1, 1), wp)
            do i = 1, 2
               expected(i, i) = expected(i, i) - frequency**2*model%inputs%rotor%mass
            end do
         end associate
         force = matmul(expected, x(:, k, :))
         do i = 1, 2
            force(i, i) = force(i, i) - amplitude
         end do
         call expect_close(maxval(abs(force)), 0.0_wp, 1e-5_wp*amplitude, 'at '//to_text(ratios(k))//' of the speed')
      end do
   end subroutine response

   !> Of exp(i nu t) in the journal's motion, m, for each nu of forces of this amplitude, from a common period of them
   !> that begins when the start has died away.
   function vibration(model, rest, ratios, force) result(x)
      type(machine_model), intent(in) :: model
      !> Tenths of the speed.
      real(wp), intent(in) :: rest(:), ratios(:), force(2)
      complex(wp) :: x(2, size(ratios))
      type(forced_model), target :: forced
      integer, parameter :: samples = 640
      real(wp), parameter :: until = 0.12_wp
      real(wp) :: states(model%n, samples), interval
      integer :: k, s
      forced%machine_model = model
      forced%force = force
      forced%frequencies = ratios*model%point%speed(0.0_wp)
      interval = 10*2*pi/model%point%speed(0.0_wp)/samples
      call march_samples(forced, forced%scale, [1e-8_wp, 1e-12_wp], rest, until, interval, states)
      x = 0
      do k = 1, size(ratios)
         do s = 1, samples
            associate (angle => forced%frequencies(k)*(until + (s - 1)*interval))
               x(:, k) = x(:, k) + (states(1:2, s) - rest(1:2))*exp(cmplx(0.0_wp, -angle, wp))*2/samples
            end associate
         end do
      end do
   end function vibration

   !> The threshold speed of a light rotor is near this one, and 2 % below and above it a small motion dies away and
   !> grows as the first mode says. Pads that stick are marched with LuGre friction.
   subroutine both_sides(pivot, expected)
      character(len=*), intent(in) :: pivot
      real(wp), intent(in) :: expected
      type(case_type) :: inputs
      type(bearing_coefficients_type) :: found
      type(machine_model) :: model
      real(wp), allocatable :: y(:)
      real(wp) :: threshold
      integer :: side, i
      inputs = smooth_case(6500.0_wp)
      inputs%rotor%mass = 200
      if (pivot == 'stuck') inputs%bearings(1)%friction%model = 'lugre'
      inputs%coefficients%threshold_up_to_rpm = 20000
      call analyse(inputs, 'analysis', found, fine=model, y=y)
      i = merge(1, 2, pivot == 'free')
      threshold = found%thresholds(i)
      call expect_close(threshold, expected, 0.05_wp*expected, 'threshold')
      inputs%coefficients%threshold_up_to_rpm = 0
      do side = -1, 1, 2
         inputs%operation%speed_rpm = (1 + 0.02_wp*side)*threshold
         inputs%operation%final_speed_rpm = inputs%operation%speed_rpm
         call analyse(inputs, 'analysis', found, fine=model, y=y)
         associate (value => found%modes(i)%eigenvalue(1))
            call expect(side*value%re > 0, 'stable below, unstable above')
            call expect_close(growth(model, y, found%modes(i)), value%re, 1e-3_wp*abs(value%re), 'growth of '//pivot &
               & //' pads '//trim(merge('below', 'above', side < 0)))
         end associate
      end do
   end subroutine both_sides

   !> A small motion keeps the temperatures of the films at the equilibrium, and vibrates and decays as the first mode
   !> says.
   subroutine film_temperatures()
      type(case_type) :: inputs
      type(bearing_coefficients_type) :: found
      type(machine_model) :: model
      real(wp), allocatable :: y(:)
      real(wp) :: differs
      inputs = case_of('&case task = ''coefficients''/ &film solver = ''fourier'', cavitation = ''none''/' &
         & //'&oil grade = 46/ &thermal model = ''film''/')
      call analyse(inputs, 'analysis', found, fine=model, y=y)
      call expect(all(model%oil%varies), 'uneven oil')
      associate (value => found%modes(1)%eigenvalue(1))
         call expect_close(growth(model, y, found%modes(1), differs), value%re, 1e-3_wp*abs(value%re), 'decay')
         call expect(differs < 2*pi*4*1e-4_wp, 'frequency to 1e-4')
      end associate
   end subroutine film_temperatures

   !> Growth, 1/s, of a mode in a march that starts with its shape, in the journal's speed: the largest of a vibration
   !> over that four vibrations before. Bristles move with the pads. `differs`: how far the speed is, over its largest
   !> value, from what the mode makes of it in these four vibrations, whose frequency it has otherwise missed.
   real(wp) function growth(model, rest, modes, differs)
      type(machine_model), intent(in) :: model
      real(wp), intent(in) :: rest(:)
      type(vibration_modes_type), intent(in) :: modes
      real(wp), intent(out), optional :: differs
      integer, parameter :: samples = 100, periods = 6, last = 4
      type(machine_model), target :: moving
      type(operating_point_type) :: point
      real(wp) :: y(size(rest)), states(model%n, periods*samples), period, fastest(periods)
      integer :: k
      moving = model
      point = moving%point
      point%friction = .true.
      call moving%set_point(point)
      y = rest
      associate (layout => moving%layout, shape => 1e-9_wp*modes%shape(:, 1))
         y(layout%positions()) = y(layout%positions()) + shape%re
         y(layout%rates()) = y(layout%rates()) + real(modes%eigenvalue(1)*shape)
         if (layout%elements(1)%bristles) then
            do k = 1, layout%pads
               associate (of => layout%elements(1))
                  y(of%bristle(k)) = moving%bearings(1)%pads(k)%ball_radius*real(shape(of%first_position(k)))
               end associate
            end do
         end if
      end associate
      period = 2*pi/modes%eigenvalue(1)%im
      call march_samples(moving, moving%scale, [1e-9_wp, 1e-13_wp], y, 0.0_wp, period/samples, states)
      fastest = [(maxval(norm2(states(3:4, (k - 1)*samples + 1:k*samples), 1)), k=1, periods)]
      growth = log(fastest(periods)/fastest(periods - last))/(last*period)
      associate (before => states(3:4, (periods - last - 1)*samples + 1:(periods - last)*samples), &
         & after => states(3:4, (periods - 1)*samples + 1:))
         if (present(differs)) differs = maxval(norm2(after - exp(modes%eigenvalue(1)%re*last*period)*before, 1)) &
            & /fastest(periods)
      end associate
   end function growth
end program test_linear_motion
