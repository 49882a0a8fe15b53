!> Amplitude spectra by FFTW. The only file that knows FFTW.
module spectra
   use, intrinsic :: iso_c_binding, only: c_double_complex, c_int, c_ptr
   use kinds, only: wp, pi
   implicit none (type, external)
   private
   public :: one_sided_amplitude, full_amplitude, windowed

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
      amplitude = 2*size_of(half_transformed(signals))/n
      amplitude(0, :) = 0.5_wp*amplitude(0, :)
      if (mod(n, 2) == 0) amplitude(n/2, :) = 0.5_wp*amplitude(n/2, :)
   end function one_sided_amplitude

   !> Signals, (sample, signal), less their means, under a Hann window, 1 - cos(2 pi j/n). A sine keeps its amplitude in
   !> the line of its frequency and has half of it in both neighbours; between lines it reaches 0.85 of it at least.
   pure function windowed(signals)
      real(wp), intent(in) :: signals(:, :)
      real(wp) :: windowed(size(signals, 1), size(signals, 2)), window(size(signals, 1))
      integer :: i, j, n
      n = size(signals, 1)
      window = 1 - cos(2*pi*[(j, j=0, n - 1)]/n)
      do i = 1, size(signals, 2)
         windowed(:, i) = (signals(:, i) - sum(signals(:, i))/n)*window
      end do
   end function windowed

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
         amplitude(k) = size_of(spectrum(modulo(k, n)))/n
      end do
   end function full_amplitude

   !> As abs, which takes care of numbers near the largest and the smallest and several times as long.
   elemental real(wp) function size_of(z)
      complex(wp), intent(in) :: z
      size_of = sqrt(z%re**2 + z%im**2)
   end function size_of

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
