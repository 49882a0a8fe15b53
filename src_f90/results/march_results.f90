!> What the file of a run says of its march, samples and spectra: names, dimensions and units as docs/results.md lists
!> them.
module march_results
   use kinds, only: wp, i8, pi
   use errors, only: error_type
   use hdf5_file, only: hdf5_type
   use equations_of_motion, only: bearing_model
   use run_file, only: run_file_type
   implicit none (type, external)
   private
   public :: add_sample, put_spectrum

contains

   !> Adds the state y at time t; the model has been evaluated there.
   subroutine add_sample(file, model, t, y, error)
      type(run_file_type), intent(inout) :: file
      type(bearing_model), intent(in) :: model
      real(wp), intent(in) :: t, y(:)
      type(error_type), allocatable, intent(out) :: error
      integer :: n
      n = size(model%places)
      call file%new_sample()
      call one('time', t, 's', 'time')
      call one('shaft_angle', model%scene%shaft_angle(t), 'rad', 'shaft angle')
      call one('speed', model%scene%speed(t), 'rad/s', 'shaft speed')
      call one('journal_y', y(1), 'm', 'journal displacement, vertical')
      call one('journal_z', y(2), 'm', 'journal displacement, horizontal')
      call one('journal_vy', y(3), 'm/s', 'journal velocity, vertical')
      call one('journal_vz', y(4), 'm/s', 'journal velocity, horizontal')
      call each('pad_tilt', state(1), 'rad', 'pad tilt')
      call each('pad_tilt_rate', state(2), 'rad/s', 'pad tilt rate')
      if (model%radial) then
         call each('pad_penetration', state(3), 'm', 'pivot penetration')
         call each('pad_penetration_rate', state(4), 'm/s', 'pivot penetration rate')
      end if
      if (model%friction%has_bristle) call each('bristle_deflection', state(model%states_per_pad), 'm', &
         & 'bristle deflection')
      call each('contact_force', model%loads%contact, 'N', 'pivot contact force')
      call each('friction_moment', model%ball_radius*model%loads%friction%force, 'N m', 'pivot friction moment')
      call each('film_force_tangential', model%response%force(1), 'N', &
         & 'film force on the journal along the pad (y'')')
      call each('film_force_radial', model%response%force(2), 'N', 'film force on the journal outward (z'')')
      call each('min_film_thickness', model%response%min_film, 'm', 'minimum film thickness')
      call each('max_pressure', model%response%max_pressure, 'Pa', 'maximum film pressure')
      call file%error_of(error)
   contains
      !> The i-th state of every pad.
      function state(i)
         integer, intent(in) :: i
         real(wp) :: state(n)
         state = y(4 + i:4 + (n - 1)*model%states_per_pad + i:model%states_per_pad)
      end function state

      subroutine one(name, value, units, long_name)
         character(len=*), intent(in) :: name, units, long_name
         real(wp), intent(in) :: value
         call file%add(name, [value], '', units, long_name)
      end subroutine one

      subroutine each(name, values, units, long_name)
         character(len=*), intent(in) :: name, units, long_name
         real(wp), intent(in) :: values(:)
         call file%add(name, values, 'pad', units, long_name)
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
