!> What the file of a run says of its march, samples and spectra: names, dimensions and units as docs/results.md lists
!> them.
module march_results
   use kinds, only: wp, i8, pi
   use errors, only: error_type
   use hdf5_file, only: hdf5_type
   use equations_of_motion, only: model_sample
   use run_file, only: run_file_type
   implicit none (type, external)
   private
   public :: add_sample, put_spectrum

contains

   !> Adds a sample.
   subroutine add_sample(file, sample, error)
      type(run_file_type), intent(inout) :: file
      type(model_sample), intent(in) :: sample
      type(error_type), allocatable, intent(out) :: error
      call file%table%new_sample(file%file)
      call one('time', sample%time, 's', 'time')
      call one('shaft_angle', sample%shaft_angle, 'rad', 'shaft angle')
      call one('speed', sample%speed, 'rad/s', 'shaft speed')
      associate (journal => sample%journal)
         call one('journal_y', journal%position(1), 'm', 'journal displacement, vertical')
         call one('journal_z', journal%position(2), 'm', 'journal displacement, horizontal')
         call one('journal_vy', journal%velocity(1), 'm/s', 'journal velocity, vertical')
         call one('journal_vz', journal%velocity(2), 'm/s', 'journal velocity, horizontal')
      end associate
      associate (pads => sample%states)
         call each('pad_tilt', pads%tilt, 'rad', 'pad tilt')
         call each('pad_tilt_rate', pads%tilt_rate, 'rad/s', 'pad tilt rate')
         if (sample%radial) then
            call each('pad_penetration', pads%penetration, 'm', 'pivot penetration')
            call each('pad_penetration_rate', pads%penetration_rate, 'm/s', 'pivot penetration rate')
         end if
         if (sample%bristles) call each('bristle_deflection', pads%deflection, 'm', 'bristle deflection')
      end associate
      associate (pads => sample%loads)
         call each('contact_force', pads%contact_force, 'N', 'pivot contact force')
         call each('friction_moment', pads%friction_moment, 'N m', 'pivot friction moment')
         call each('film_force_tangential', pads%film_force(1), 'N', 'film force on the journal along the pad (y'')')
         call each('film_force_radial', pads%film_force(2), 'N', 'film force on the journal outward (z'')')
         call each('min_film_thickness', pads%min_film_thickness, 'm', 'minimum film thickness')
         call each('max_pressure', pads%max_pressure, 'Pa', 'maximum film pressure')
      end associate
      call file%error_of(error)
   contains
      subroutine one(name, value, units, long_name)
         character(len=*), intent(in) :: name, units, long_name
         real(wp), intent(in) :: value
         call file%table%add(file%file, name, [value], '', units, long_name)
      end subroutine one

      subroutine each(name, values, units, long_name)
         character(len=*), intent(in) :: name, units, long_name
         real(wp), intent(in) :: values(:)
         call file%table%add(file%file, name, values, 'pad', units, long_name)
      end subroutine each
   end subroutine add_sample

   !> Amplitude spectra over the last revolutions of a run at constant speed, rad/s.
   subroutine put_spectrum(file, interval, revolutions, speed, journal_y, journal_z, journal_full, tilt)
      type(hdf5_type), intent(inout) :: file
      !> Between samples, s.
      real(wp), intent(in) :: interval
      integer, intent(in) :: revolutions
      real(wp), intent(in) :: speed
      !> One-sided, at k/T; full, at k/T with k = -((n-1)/2) .. n/2; one-sided (k, pad).
      real(wp), intent(in) :: journal_y(:), journal_z(:), journal_full(:), tilt(:, :)
      real(wp) :: step
      integer :: k, n
      n = size(journal_full)
      step = 1/(n*interval)
      call file%make_group('spectrum')
      call file%put_list('spectrum/frequency', [(k*step, k=0, n/2)], 'Hz', 'frequency', 'spectrum/frequency')
      call file%put_list('spectrum/order', [(k*step, k=0, n/2)]*2*pi/speed, '1', &
         & 'frequency over shaft frequency', 'spectrum/frequency')
      call file%put_list('spectrum/journal_y', journal_y, 'm', 'amplitude of journal_y', 'spectrum/frequency')
      call file%put_list('spectrum/journal_z', journal_z, 'm', 'amplitude of journal_z', 'spectrum/frequency')
      call file%put_table('spectrum/pad_tilt', tilt, 'rad', 'amplitude of pad_tilt', &
         & 'pad spectrum/frequency')
      call file%put_list('spectrum/full_frequency', [(k*step, k=-((n - 1)/2), n/2)], 'Hz', &
         & 'frequency, positive for forward whirl', 'spectrum/full_frequency')
      call file%put_list('spectrum/journal_full', journal_full, 'm', &
         & 'amplitude of journal_y + i journal_z', 'spectrum/full_frequency')
      call file%put_count('spectrum/revolutions', int(revolutions, i8), 'revolutions covered')
   end subroutine put_spectrum
end module march_results
