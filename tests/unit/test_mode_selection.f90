!> Modes that a shaft keeps by itself: the estimated errors beside the true ones, for random rotors.
program test_mode_selection
   use kinds, only: wp, pi
   use text, only: to_text
   use case_inputs, only: case_type
   use rotor_reduction, only: rotor_matrices_type
   use example_machine, only: plain_shaft, put_bearings, put_disc, put_unbalance, rotor_of, response_error, &
      & damping_error
   use check, only: runs, expect, between, report
   implicit none (type, external)

   !> The growth of the vibration for which errors are estimated, relative to its frequency.
   real(wp), parameter :: growth = 0.05_wp

   if (runs('random rotors')) call try_random_rotors(50*times())
   call report()

contains

   !> How many times as many rotors are asked for on the command line.
   integer function times()
      character(len=20) :: text
      integer :: status
      call get_command_argument(1, text)
      read (text, *, iostat=status) times
      if (status /= 0) times = 1
   end function times

   !> The estimate is of the highest speed and of bearings that resist the shaft as much as it does them; the errors are
   !> of ten speeds and of bearings that resist a tenth to ten times as much. So they scatter about it; and steady
   !> vibrations at a resonance have a smaller damping ratio, by which their errors are larger.
   subroutine try_random_rotors(count)
      integer, intent(in) :: count
      type(case_type) :: machine
      type(rotor_matrices_type) :: rotor
      real(wp) :: highest, springs(6), dampers(6)
      real(wp), dimension(count) :: estimate, grows, steady, damping_estimate, damping_grows, damping_steady
      integer :: k, n
      do k = 1, count
         call draw(machine, highest)
         rotor = rotor_of(machine, highest)
         n = 2*size(machine%bearings)
         call draw_bearings(rotor, highest, springs(:n), dampers(:n))
         estimate(k) = rotor%truncation_error
         damping_estimate(k) = rotor%damping_error
         grows(k) = response_error(machine, highest, springs(:n), dampers(:n), growth=growth)
         steady(k) = response_error(machine, highest, springs(:n), dampers(:n))
         damping_grows(k) = damping_error(machine, highest, springs(:n), dampers(:n), growth)
         damping_steady(k) = damping_error(machine, highest, springs(:n), dampers(:n))
      end do
      call expect(all(estimate <= 1e-4_wp), 'modes are kept until the estimated error is 1e-4')
      call expect_shares('modes left out, growing', grows, estimate, 2.0_wp, 5.0_wp, 30.0_wp)
      call expect_shares('modes left out, steady', steady, estimate, 4.0_wp, 10.0_wp, 100.0_wp)
      associate (some => damping_estimate > 0)
         call expect_shares('damping, growing', pack(damping_grows, some), pack(damping_estimate, some), 2.0_wp, &
            & 5.0_wp, 30.0_wp)
         call expect_shares('damping, steady', pack(damping_steady, some), pack(damping_estimate, some), 4.0_wp, &
            & 10.0_wp, 100.0_wp)
      end associate
   end subroutine try_random_rotors

   !> Expects of errors over their estimates that half of them, nine of ten and all are below these limits, and that the
   !> estimates are not idle: half of the errors are above a fifth of them.
   subroutine expect_shares(what, errors, estimates, half, most, largest)
      character(len=*), intent(in) :: what
      real(wp), intent(in) :: errors(:), estimates(:), half, most, largest
      real(wp) :: of_errors(3), ratios(3)
      of_errors = shares(errors)
      ratios = shares(errors/estimates)
      print '(a,i0,a,3es10.2,a,3f8.2)', what//': ', size(errors), ' rotors; median, nine of ten, all below', &
         & of_errors, '; over the estimate', ratios
      call expect(ratios(1) < half .and. ratios(1) > 0.2_wp, what//': half of them are '//to_text(ratios(1)))
      call expect(ratios(2) < most, what//': nine of ten are below '//to_text(ratios(2)))
      call expect(ratios(3) < largest, what//': all are below '//to_text(ratios(3)))
   end subroutine expect_shares

   !> What half, nine of ten and all of the values are not above.
   function shares(values)
      real(wp), intent(in) :: values(:)
      real(wp) :: shares(3), sorted(size(values))
      integer :: i
      do i = 1, size(values)
         sorted(1 + count(values < values(i)) + count(values(:i - 1) >= values(i) .and. values(:i - 1) <= values(i))) &
            & = values(i)
      end do
      shares = sorted([size(values)/2, (9*size(values))/10, size(values)])
   end function shares

   !> A rotor of 8 to 20 uneven sections with up to four discs, which may hang over, in two or three bearings, of which
   !> some stand on supports; and its highest speed, rad/s, which lies between a third and the double of its first
   !> frequency with the journals held.
   subroutine draw(machine, highest)
      type(case_type), intent(out) :: machine
      real(wp), intent(out) :: highest
      type(rotor_matrices_type) :: rotor
      real(wp) :: mass, radius
      integer :: sections, bearings, i
      sections = int(between(8.0_wp, 21.0_wp))
      machine = plain_shaft([(between(0.05_wp, 0.3_wp), i=1, sections)], 0.2_wp)
      associate (shaft => machine%rotor%elastic%shaft)
         shaft%diameter = [(between(0.08_wp, 0.35_wp), i=1, sections)]
         shaft%bore = [(max(0.0_wp, between(-0.5_wp, 0.5_wp))*shaft%diameter(i), i=1, sections)]
      end associate
      bearings = int(between(2.0_wp, 4.0_wp))
      call put_bearings(machine, [(1 + nint((i - between(0.6_wp, 1.0_wp))*sections/(bearings - 0.6_wp)), &
         & i=1, bearings)])
      do i = 1, int(between(1.0_wp, 5.0_wp))
         mass = between(0.05_wp, 0.6_wp)*machine%rotor%elastic%shaft%mass()
         radius = between(0.2_wp, 0.6_wp)
         call put_disc(machine, int(between(1.0_wp, sections + 2.0_wp)), mass, mass*radius**2/2, &
            & mass*(radius**2/4 + between(0.05_wp, 0.2_wp)**2/12))
         call put_unbalance(machine, machine%rotor%elastic%discs(i)%station, 1e-5_wp*mass, between(0.0_wp, 360.0_wp))
      end do
      do i = 1, bearings
         if (between(0.0_wp, 1.0_wp) < 0.5_wp) cycle
         allocate (machine%bearings(i)%support)
         associate (support => machine%bearings(i)%support)
            support%mass = between(0.02_wp, 0.3_wp)*machine%rotor%elastic%mass()
            support%stiffness = 1e8_wp*10**[between(0.0_wp, 2.0_wp), between(0.0_wp, 2.0_wp)]
            support%damping = support%stiffness*between(1e-5_wp, 1e-3_wp)
         end associate
      end do
      rotor = rotor_of(machine, 1.0_wp, 1)
      highest = 2*pi*rotor%mode_frequency(1)*6**between(-0.6_wp, 0.4_wp)
   end subroutine draw

   !> Springs, N/m, and dampers, N s/m, of the bearings: from a tenth of what resists a journal of the rotor at this
   !> speed to ten times as much.
   subroutine draw_bearings(rotor, speed, springs, dampers)
      type(rotor_matrices_type), intent(in) :: rotor
      real(wp), intent(in) :: speed
      real(wp), intent(out) :: springs(:), dampers(:)
      integer :: i
      do i = 1, size(springs)
         springs(i) = (rotor%stiffness(i, i) + speed**2*rotor%mass(i, i))*10**between(-1.0_wp, 1.0_wp)
         dampers(i) = springs(i)/speed*10**between(-1.5_wp, 0.0_wp)
      end do
   end subroutine draw_bearings
end program test_mode_selection
