!> Amplitude spectra by FFTW. The only file that knows FFTW.
module spectra
   use, intrinsic :: iso_c_binding, only: c_double_complex, c_int, c_ptr
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: one_sided_amplitude, hann_amplitude, full_amplitude

   interface
      type(c_ptr) function fftw_plan_dft_1d(n, in, out, sign, flags) bind(c)
         import :: c_ptr, c_int, c_double_complex
         integer(c_int), value :: n, sign, flags
         complex(c_double_complex), intent(inout) :: in(*), out(*)
      end function fftw_plan_dft_1d

      subroutine fftw_execute_dft(plan, in, out) bind(c)
         import :: c_ptr, c_double_complex
         type(c_ptr), value :: plan
         complex(c_double_complex), intent(inout) :: in(*), out(*)
      end subroutine fftw_execute_dft

      subroutine fftw_destroy_plan(plan) bind(c)
         import :: c_ptr
         type(c_ptr), value :: plan
      end subroutine fftw_destroy_plan
   end interface

   !> From fftw3.h.
   integer(c_int), parameter :: fftw_forward = -1, fftw_estimate = 64

contains

   !> Amplitudes of real signals of n samples, (sample, signal), at the frequencies k/(n dt), k = 0 .. n/2,
   !> (k, signal): a sine of amplitude a gives a, a constant c gives |c|, at any n.
   function one_sided_amplitude(signals) result(amplitude)
      real(wp), intent(in) :: signals(:, :)
      real(wp) :: amplitude(0:size(signals, 1)/2, size(signals, 2))
      integer :: n
      n = size(signals, 1)
      amplitude = 2*abs(half_transformed(signals))/n
      amplitude(0, :) = 0.5_wp*amplitude(0, :)
      if (mod(n, 2) == 0) amplitude(n/2, :) = 0.5_wp*amplitude(n/2, :)
   end function one_sided_amplitude

   !> The same of signals less their means under a Hann window, 1 - cos(2 pi j/n), between the first and the last
   !> frequency: the window takes half of both neighbours off each line.
   function hann_amplitude(signals) result(amplitude)
      real(wp), intent(in) :: signals(:, :)
      real(wp) :: amplitude(0:size(signals, 1)/2, size(signals, 2))
      complex(wp) :: spectrum(0:size(signals, 1)/2, size(signals, 2))
      integer :: i, k, n
      n = size(signals, 1)
      spectrum = half_transformed(signals)
      spectrum(0, :) = 0
      amplitude = 0
      do i = 1, size(signals, 2)
         do k = 1, n/2 - 1
            associate (line => spectrum(k, i) - 0.5_wp*(spectrum(k - 1, i) + spectrum(k + 1, i)))
               amplitude(k, i) = 2*sqrt(line%re**2 + line%im**2)/n
            end associate
         end do
      end do
   end function hann_amplitude

   !> Amplitudes of a complex signal y + i z of n samples at the frequencies k/(n dt), k = -((n-1)/2) ..
   !> n/2, in that order: positive frequencies turn from y towards z, negative ones back.
   function full_amplitude(signal) result(amplitude)
      complex(wp), intent(in) :: signal(:)
      real(wp) :: amplitude(-((size(signal) - 1)/2):size(signal)/2)
      complex(wp) :: spectrum(0:size(signal) - 1), work(size(signal))
      type(c_ptr) :: plan
      integer :: k, n
      n = size(signal)
      plan = fftw_plan_dft_1d(n, work, spectrum, fftw_forward, fftw_estimate)
      work = signal
      call fftw_execute_dft(plan, work, spectrum)
      call fftw_destroy_plan(plan)
      do k = lbound(amplitude, 1), ubound(amplitude, 1)
         amplitude(k) = abs(spectrum(modulo(k, n)))/n
      end do
   end function full_amplitude

   !> sum_j signal(j) exp(-2 pi i j k / n) of real signals, (sample, signal), k = 0 .. n/2: (k, signal). One plan serves
   !> them all, as it takes longer to make than their transforms; that of real signals would take three times as long.
   function half_transformed(signals) result(spectrum)
      real(wp), intent(in) :: signals(:, :)
      complex(wp) :: spectrum(size(signals, 1)/2 + 1, size(signals, 2))
      complex(wp) :: signal(size(signals, 1)), lines(size(signals, 1))
      type(c_ptr) :: plan
      integer :: i
      plan = fftw_plan_dft_1d(size(signal), signal, lines, fftw_forward, fftw_estimate)
      do i = 1, size(signals, 2)
         signal = signals(:, i)
         call fftw_execute_dft(plan, signal, lines)
         spectrum(:, i) = lines(:size(spectrum, 1))
      end do
      call fftw_destroy_plan(plan)
   end function half_transformed
end module spectra
