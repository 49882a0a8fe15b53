!> Amplitude spectra against known signals and a direct transform.
program test_spectra
   use kinds, only: wp, pi
   use text, only: to_text
   use spectra, only: one_sided_amplitude, full_amplitude
   use check, only: runs, expect, expect_close, report
   implicit none (type, external)

   !> Transforms of a few hundred samples of order one: log2(n) roundings each, with room.
   real(wp), parameter :: rounding = 1000*epsilon(1.0_wp)
   integer, parameter :: lengths(*) = [1, 2, 7, 8, 45, 128, 251]
   integer :: i

   do i = 1, size(lengths)
      if (runs('constant')) call constant(lengths(i))
      if (runs('against_direct_transform')) call against_direct_transform(lengths(i))
      if (runs('against_direct_full_transform')) call against_direct_full_transform(lengths(i))
      if (runs('parseval')) call parseval(lengths(i))
   end do
   if (runs('sines')) then
      call sines(64)
      call sines(99)
   end if
   if (runs('whirl')) then
      call whirl(64)
      call whirl(99)
   end if
   call report()

contains

   subroutine constant(n)
      integer, intent(in) :: n
      real(wp) :: amplitude(0:n/2)
      amplitude = one_sided_amplitude(spread(-2.5_wp, 1, n))
      call expect_close(amplitude(0), 2.5_wp, rounding, 'a constant, n = '//to_text(n))
      call expect(all(amplitude(1:) < rounding), 'a constant has nothing but its mean, n = '//to_text(n))
   end subroutine constant

   !> A sine of amplitude a, of any phase, gives a at its frequency and nothing elsewhere.
   subroutine sines(n)
      integer, intent(in) :: n
      real(wp) :: amplitude(0:n/2), time(n)
      integer :: k, j
      time = [(real(j, wp)/n, j=0, n - 1)]
      do k = 1, (n - 1)/2
         amplitude = one_sided_amplitude(3*sin(2*pi*k*time + 0.1_wp*k))
         call expect_close(amplitude(k), 3.0_wp, rounding, 'sine '//to_text(k)//' of '//to_text(n)//' samples')
         amplitude(k) = 0
         call expect(all(amplitude < rounding), 'sine '//to_text(k)//' of '//to_text(n)//' leaks')
      end do
      if (mod(n, 2) == 0) then
         amplitude = one_sided_amplitude(3*cos(pi*n*time))
         call expect_close(amplitude(n/2), 3.0_wp, rounding, 'the highest frequency of '//to_text(n)//' samples')
      end if
   end subroutine sines

   !> From y towards z is forward: exp(+i phi) at +k, exp(-i phi) at -k.
   subroutine whirl(n)
      integer, intent(in) :: n
      real(wp), allocatable :: amplitude(:)
      real(wp) :: angle(n)
      integer :: j, zero
      angle = [(2*pi*j/n, j=0, n - 1)]
      amplitude = full_amplitude(cmplx(0.5_wp + 2*cos(3*angle) + 0.7_wp*cos(5*angle), &
         & 2*sin(3*angle) - 0.7_wp*sin(5*angle), wp))
      call expect(size(amplitude) == n, 'as many lines as samples')
      zero = 1 + (n - 1)/2
      call expect_close(amplitude(zero), 0.5_wp, rounding, 'centre of the whirl, n = '//to_text(n))
      call expect_close(amplitude(zero + 3), 2.0_wp, rounding, 'forward whirl, n = '//to_text(n))
      call expect_close(amplitude(zero - 5), 0.7_wp, rounding, 'backward whirl, n = '//to_text(n))
      amplitude([zero, zero + 3, zero - 5]) = 0
      call expect(all(amplitude < rounding), 'whirls leak, n = '//to_text(n))
   end subroutine whirl

   subroutine against_direct_transform(n)
      integer, intent(in) :: n
      real(wp) :: signal(n), amplitude(0:n/2), expected
      complex(wp) :: line
      integer :: k
      call random_number(signal)
      amplitude = one_sided_amplitude(signal)
      do k = 0, n/2
         line = direct_line(cmplx(signal, 0.0_wp, wp), k)
         expected = abs(line)
         ! all lines but the first and, with even n, the last stand for two
         if (k > 0 .and. 2*k /= n) expected = 2*expected
         call expect_close(amplitude(k), expected, rounding, 'line '//to_text(k)//' of '//to_text(n)//' random numbers')
      end do
   end subroutine against_direct_transform

   subroutine against_direct_full_transform(n)
      integer, intent(in) :: n
      real(wp) :: re(n), im(n), worst
      real(wp) :: amplitude(-((n - 1)/2):n/2)
      integer :: k
      call random_number(re)
      call random_number(im)
      amplitude = full_amplitude(cmplx(re, im, wp))
      worst = 0
      do k = lbound(amplitude, 1), ubound(amplitude, 1)
         worst = max(worst, abs(amplitude(k) - abs(direct_line(cmplx(re, im, wp), k))))
      end do
      call expect_close(worst, 0.0_wp, rounding, 'full spectrum of '//to_text(n)//' random numbers')
   end subroutine against_direct_full_transform

   !> Parseval: the mean square of the signal is the sum of squares of the full spectrum.
   subroutine parseval(n)
      integer, intent(in) :: n
      real(wp) :: re(n), im(n)
      call random_number(re)
      call random_number(im)
      call expect_close(sum(full_amplitude(cmplx(re, im, wp))**2), sum(re**2 + im**2)/n, rounding, &
         & 'Parseval, n = '//to_text(n))
   end subroutine parseval

   !> One line by its definition, over n.
   pure complex(wp) function direct_line(signal, k)
      complex(wp), intent(in) :: signal(0:)
      integer, intent(in) :: k
      integer :: j, n
      n = size(signal)
      direct_line = 0
      do j = 0, n - 1
         direct_line = direct_line + signal(j)*exp(cmplx(0.0_wp, -2*pi*mod(j*k, n)/n, wp))
      end do
      direct_line = direct_line/n
   end function direct_line
end program test_spectra
