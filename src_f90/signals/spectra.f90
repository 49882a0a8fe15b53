!> Amplitude spectra by FFTW. The only file that knows FFTW.
module spectra
   use, intrinsic :: iso_c_binding, only: c_double, c_double_complex, c_int, c_ptr
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

      type(c_ptr) function fftw_plan_dft_r2c_1d(n, in, out, flags) bind(c)
         import :: c_ptr, c_int, c_double, c_double_complex
         integer(c_int), value :: n, flags
         real(c_double), intent(inout) :: in(*)
         complex(c_double_complex), intent(inout) :: out(*)
      end function fftw_plan_dft_r2c_1d

      subroutine fftw_execute_dft_r2c(plan, in, out) bind(c)
         import :: c_ptr, c_double, c_double_complex
         type(c_ptr), value :: plan
         real(c_double), intent(inout) :: in(*)
         complex(c_double_complex), intent(inout) :: out(*)
      end subroutine fftw_execute_dft_r2c

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

   !> Amplitudes of a real signal of n samples at the frequencies k/(n dt), k = 0 .. n/2: a sine of
   !> amplitude a gives a, a constant c gives |c|, at any n.
   function one_sided_amplitude(signal) result(amplitude)
      real(wp), intent(in) :: signal(:)
      real(wp) :: amplitude(0:size(signal)/2)
      integer :: n
      n = size(signal)
      amplitude = 2*abs(half_transformed(signal))/n
      amplitude(0) = 0.5_wp*amplitude(0)
      if (mod(n, 2) == 0) amplitude(n/2) = 0.5_wp*amplitude(n/2)
   end function one_sided_amplitude

   !> The same of the signal less its mean under a Hann window, 1 - cos(2 pi j/n), between the first and the last
   !> frequency: the window takes half of both neighbours off each line.
   function hann_amplitude(signal) result(amplitude)
      real(wp), intent(in) :: signal(:)
      real(wp) :: amplitude(0:size(signal)/2)
      complex(wp) :: spectrum(0:size(signal)/2)
      integer :: k, n
      n = size(signal)
      spectrum = half_transformed(signal)
      spectrum(0) = 0
      amplitude = 0
      do k = 1, n/2 - 1
         associate (line => spectrum(k) - 0.5_wp*(spectrum(k - 1) + spectrum(k + 1)))
            amplitude(k) = 2*sqrt(line%re**2 + line%im**2)/n
         end associate
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

   !> sum_j signal(j) exp(-2 pi i j k / n) of a real signal, k = 0 .. n/2.
   function half_transformed(signal) result(spectrum)
      real(wp), intent(in) :: signal(:)
      complex(wp) :: spectrum(size(signal)/2 + 1)
      real(wp) :: work(size(signal))
      type(c_ptr) :: plan
      plan = fftw_plan_dft_r2c_1d(size(signal), work, spectrum, fftw_estimate)
      work = signal
      call fftw_execute_dft_r2c(plan, work, spectrum)
      call fftw_destroy_plan(plan)
   end function half_transformed
end module spectra
