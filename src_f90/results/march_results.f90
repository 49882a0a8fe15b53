!> What the file of a run says of its march, samples and spectra: names, dimensions and units as docs/results.md lists
!> them.
module march_results
   use kinds, only: wp, i8, pi
   use errors, only: error_type
   use hdf5_file, only: hdf5_type
   use viscosity_history, only: viscosity_history_type
   use equations_of_motion, only: model_sample
   use run_file, only: run_file_type
   implicit none (type, external)
   private
   public :: add_sample, put_spectrum, put_viscosity, put_viscosity_history

   !> Values of a sample: of the journal, and of a pad at most.
   integer, parameter :: of_journal = 7, of_pad = 12

contains

   !> Adds a sample: the one list of what is sampled.
   subroutine add_sample(file, sample, error)
      type(run_file_type), intent(inout) :: file
      type(model_sample), intent(in) :: sample
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: values(of_journal + of_pad*size(sample%states))
      logical :: first
      integer :: i, k, n
      first = .not. file%is_declared()
      n = 0
      call one('time', sample%time, 's', 'time')
      call one('shaft_angle', sample%shaft_angle, 'rad', 'shaft angle')
      call one('speed', sample%speed, 'rad/s', 'shaft speed')
      associate (position => sample%journal%position, velocity => sample%journal%velocity)
         call one('journal_y', position(1), 'm', 'journal displacement, vertical')
         call one('journal_z', position(2), 'm', 'journal displacement, horizontal')
         call one('journal_vy', velocity(1), 'm/s', 'journal velocity, vertical')
         call one('journal_vz', velocity(2), 'm/s', 'journal velocity, horizontal')
      end associate
      do i = 1, size(sample%states)
         k = 0
         associate (state => sample%states(i), pad => sample%loads(i))
            if (sample%tilting) then
               call each('pivot_load', pad%pivot_load, 'N', 'pivot load')
               call each('friction_moment', pad%friction_moment, 'N m', 'pivot friction moment')
            end if
            call each('film_force_tangential', pad%film_force(1), 'N', 'film force on the journal along the pad (y'')')
            call each('film_force_radial', pad%film_force(2), 'N', 'film force on the journal outward (z'')')
            call each('min_film_thickness', pad%min_film_thickness, 'm', 'minimum film thickness')
            call each('max_pressure', pad%max_pressure, 'Pa', 'maximum film pressure')
            if (sample%tilting) then
               call each('pad_tilt', state%tilt, 'rad', 'pad tilt')
               call each('pad_tilt_rate', state%tilt_rate, 'rad/s', 'pad tilt rate')
            end if
            if (sample%radial) then
               call each('pivot_deflection', state%pivot_deflection, 'm', 'pivot deflection')
               call each('pivot_deflection_rate', state%pivot_deflection_rate, 'm/s', 'pivot deflection rate')
            end if
            if (sample%bristles) call each('bristle_deflection', state%deflection, 'm', 'bristle deflection')
            if (sample%asperities) call each('asperity_force', pad%asperity_force, 'N', &
               & 'normal force between the asperities of pad and journal')
         end associate
      end do
      call file%add(values(:n + k*size(sample%states)))
      call file%error_of(error)
   contains
      subroutine one(name, value, units, long_name)
         character(len=*), intent(in) :: name, units, long_name
         real(wp), intent(in) :: value
         if (first) call file%declare(name, 1, '', units, long_name)
         n = n + 1
         values(n) = value
      end subroutine one

      !> Of pad i; the k-th series of the pads.
      subroutine each(name, value, units, long_name)
         character(len=*), intent(in) :: name, units, long_name
         real(wp), intent(in) :: value
         if (first .and. i == 1) call file%declare(name, size(sample%states), 'pad', units, long_name)
         values(n + k*size(sample%states) + i) = value
         k = k + 1
      end subroutine each
   end subroutine add_sample

   !> Writes the viscosity of the oil on each pad, Pa s, which warm oil keeps in a march.
   subroutine put_viscosity(file, viscosity)
      type(run_file_type), intent(inout) :: file
      real(wp), intent(in) :: viscosity(:)
      call file%put_list('viscosity', viscosity, 'Pa s', 'viscosity of the oil on each pad in the march', 'pad')
   end subroutine put_viscosity

   !> Writes the history of these viscosities in a run-up.
   subroutine put_viscosity_history(file, history)
      type(run_file_type), intent(inout) :: file
      type(viscosity_history_type), intent(in) :: history
      real(wp), allocatable :: time(:), viscosity(:, :)
      integer :: k
      ! counted from 1, in brackets
      time = [history%time]
      allocate (viscosity(history%pads(), size(time)))
      do k = 1, size(time)
         call history%at(time(k), viscosity(:, k))
      end do
      call file%make_group('oil')
      call file%put_list('oil/time', time, 's', 'time', 'oil/time')
      call file%put_table('oil/viscosity', viscosity, 'Pa s', 'viscosity of the oil on each pad', 'oil/time pad')
   end subroutine put_viscosity_history

   !> Amplitude spectra over the last revolutions of a run at constant speed, rad/s.
   subroutine put_spectrum(file, interval, revolutions, speed, journal_y, journal_z, journal_full, tilt)
      class(hdf5_type), intent(inout) :: file
      !> Between samples, s.
      real(wp), intent(in) :: interval
      integer, intent(in) :: revolutions
      real(wp), intent(in) :: speed
      !> One-sided, at k/T; full, at k/T with k = -((n-1)/2) .. n/2; one-sided (k, pad) of pads that tilt.
      real(wp), intent(in) :: journal_y(:), journal_z(:), journal_full(:)
      real(wp), intent(in), optional :: tilt(:, :)
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
      if (present(tilt)) call file%put_table('spectrum/pad_tilt', tilt, 'rad', 'amplitude of pad_tilt', &
         & 'pad spectrum/frequency')
      call file%put_list('spectrum/full_frequency', [(k*step, k=-((n - 1)/2), n/2)], 'Hz', &
         & 'frequency, positive for forward whirl', 'spectrum/full_frequency')
      call file%put_list('spectrum/journal_full', journal_full, 'm', &
         & 'amplitude of journal_y + i journal_z', 'spectrum/full_frequency')
      call file%put_count('spectrum/revolutions', int(revolutions, i8), 'revolutions covered')
   end subroutine put_spectrum
end module march_results
