!> What the file of a run says of its march or periodic orbit, samples and spectra: names, dimensions and units as
!> docs/results.md lists them.
module march_results
   use kinds, only: wp, i8, pi
   use errors, only: error_type
   use case_inputs, only: case_type
   use spectra, only: one_sided_amplitude, full_amplitude
   use periodic_orbit, only: periodic_orbit_type
   use record, only: record_type
   use summary_group, only: put_figure
   use state_layout, only: most_coordinates
   use viscosity_history, only: viscosity_history_type
   use bearing_samples, only: bearing_sample
   use run_file, only: run_file_type
   use bearing_file, only: bearing_file_type
   implicit none (type, external)
   private
   public :: add_sample, put_spectra, put_viscosity_history, put_periodic

   !> Values of a sample: of the shaft, of a journal, and of a pad at most.
   integer, parameter :: of_shaft = 3, of_journal = 4, of_pad = 8 + 2*most_coordinates

contains

   !> Adds a sample of all bearings, in the files of these, of where the stations of a shaft are, (2, station), m, and
   !> of the forces of the excitations, (2, excitation), and of other elements, (2, element), N: the one list of what is
   !> sampled.
   subroutine add_sample(file, bearings, samples, stations, excitations, elements, error)
      type(run_file_type), intent(inout) :: file
      type(bearing_file_type), intent(in) :: bearings(:)
      type(bearing_sample), intent(in) :: samples(:)
      real(wp), intent(in) :: stations(:, :), excitations(:, :), elements(:, :)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: values(most_values(samples) + size(stations) + size(excitations) + size(elements))
      logical :: first
      integer :: n, b
      ! its series are declared as the first sample is added
      first = .not. file%hdf5%declared
      n = 0
      call along('', 'time', [samples(1)%time], 's', 'time')
      call along('', 'shaft_angle', [samples(1)%shaft_angle], 'rad', 'shaft angle')
      call along('', 'speed', [samples(1)%speed], 'rad/s', 'shaft speed')
      do b = 1, size(samples)
         call take_bearing(bearings(b), samples(b), first, values, n)
      end do
      if (size(stations) > 0) then
         call along('station', 'station_y', stations(1, :), 'm', 'shaft displacement, vertical')
         call along('station', 'station_z', stations(2, :), 'm', 'shaft displacement, horizontal')
      end if
      if (size(excitations) > 0) then
         call along('excitation', 'excitation_y', excitations(1, :), 'N', 'force of the excitation, vertical')
         call along('excitation', 'excitation_z', excitations(2, :), 'N', 'force of the excitation, horizontal')
      end if
      if (size(elements) > 0) then
         call along('element', 'element_force_y', elements(1, :), 'N', 'force of the element on the rotor, vertical')
         call along('element', 'element_force_z', elements(2, :), 'N', 'force of the element on the rotor, horizontal')
      end if
      call file%hdf5%add(values(:n))
      call file%error_of(error)
   contains
      !> Of the shaft (''), at all its stations, or of all excitations or elements.
      subroutine along(across, name, at, units, long_name)
         character(len=*), intent(in) :: across, name, units, long_name
         real(wp), intent(in) :: at(:)
         if (first) call file%hdf5%declare(name, size(at), units, long_name, across)
         values(n + 1:n + size(at)) = at
         n = n + size(at)
      end subroutine along
   end subroutine add_sample

   !> Most values of all bearings, and of the shaft without stations and excitations.
   pure integer function most_values(samples) result(n)
      type(bearing_sample), intent(in) :: samples(:)
      integer :: b
      n = of_shaft
      do b = 1, size(samples)
         n = n + of_journal + of_pad*size(samples(b)%states)
      end do
   end function most_values

   !> What is sampled of a bearing, behind the first n values; its series are named in the `first` sample.
   subroutine take_bearing(file, sample, first, values, n)
      type(bearing_file_type), intent(in) :: file
      type(bearing_sample), intent(in) :: sample
      logical, intent(in) :: first
      real(wp), intent(inout), contiguous :: values(:)
      integer, intent(inout) :: n
      integer :: i, j, k
      associate (position => sample%journal%position, velocity => sample%journal%velocity)
         call one('journal_y', position(1), 'm', 'journal displacement, vertical')
         call one('journal_z', position(2), 'm', 'journal displacement, horizontal')
         call one('journal_vy', velocity(1), 'm/s', 'journal velocity, vertical')
         call one('journal_vz', velocity(2), 'm/s', 'journal velocity, horizontal')
      end associate
      do i = 1, size(sample%states)
         k = 0
         associate (state => sample%states(i), pad => sample%loads(i))
            if (sample%coordinates%n > 0) then
               call each('pivot_load', pad%pivot_load, 'N', 'pivot load')
               call each('friction_moment', pad%friction_moment, 'N m', 'pivot friction moment')
            end if
            call each('film_force_tangential', pad%film_force(1), 'N', 'film force on the journal along the pad (y'')')
            call each('film_force_radial', pad%film_force(2), 'N', 'film force on the journal outward (z'')')
            call each('min_film_thickness', pad%min_film_thickness, 'm', 'minimum film thickness')
            call each('max_pressure', pad%max_pressure, 'Pa', 'maximum film pressure')
            do j = 1, sample%coordinates%n
               associate (words => sample%coordinates%words(j), kind => sample%coordinates%kind(j))
                  if (first .and. i == 1) then
                     call declare(trim(words%series), trim(words%units), trim(words%label))
                     call declare(trim(words%series)//'_rate', trim(words%units)//'/s', trim(words%label)//' rate')
                  end if
                  values(n + k*size(sample%states) + i) = state%x(kind)
                  values(n + (k + 1)*size(sample%states) + i) = state%v(kind)
                  k = k + 2
               end associate
            end do
            if (sample%bristles) call each('bristle_deflection', state%bristle, 'm', 'bristle deflection')
            if (sample%asperities) call each('asperity_force', pad%asperity_force, 'N', &
               & 'normal force between the asperities of pad and journal')
         end associate
      end do
      n = n + k*size(sample%states)
   contains
      subroutine one(name, value, units, long_name)
         character(len=*), intent(in) :: name, units, long_name
         real(wp), intent(in) :: value
         if (first) call file%declare(name, 1, units, long_name, '')
         n = n + 1
         values(n) = value
      end subroutine one

      !> Of pad i; the series behind the first k of the pads.
      subroutine each(name, value, units, long_name)
         character(len=*), intent(in) :: name, units, long_name
         real(wp), intent(in) :: value
         if (first .and. i == 1) call declare(name, units, long_name)
         values(n + k*size(sample%states) + i) = value
         k = k + 1
      end subroutine each

      subroutine declare(name, units, long_name)
         character(len=*), intent(in) :: name, units, long_name
         call file%declare(name, size(sample%states), units, long_name, 'pad')
      end subroutine declare
   end subroutine take_bearing

   !> Writes the history of the viscosities of these pads in a run-up.
   subroutine put_viscosity_history(file, history, pads)
      type(bearing_file_type), intent(inout) :: file
      type(viscosity_history_type), intent(in) :: history
      integer, intent(in) :: pads(:)
      real(wp), allocatable :: time(:), viscosity(:, :)
      integer :: k
      ! counted from 1, in brackets
      time = [history%time]
      allocate (viscosity(history%pads(), size(time)))
      do k = 1, size(time)
         call history%at(time(k), viscosity(:, k))
      end do
      call file%put('oil/time', time, 's', 'time', 'oil/time')
      call file%put('oil/viscosity', viscosity(pads, :), 'Pa s', 'viscosity of the oil on each pad', 'oil/time pad')
   end subroutine put_viscosity_history

   !> Writes amplitude spectra of bearing b of a case over the last whole revolutions of a run at constant speed; none
   !> where it was not sampled over one.
   subroutine put_spectra(file, inputs, b, interval)
      type(bearing_file_type), intent(inout) :: file
      type(case_type), intent(in) :: inputs
      integer, intent(in) :: b
      !> Between samples, s.
      real(wp), intent(in) :: interval
      real(wp), allocatable :: y(:, :), z(:, :), tilt(:, :), amplitudes(:, :)
      real(wp) :: step
      integer :: revolutions, n, i, k
      if (.not. inputs%is_steady()) return
      associate (samples => inputs%output%samples_per_revolution)
         revolutions = int(min(int(inputs%output%spectrum_revolutions, i8), (file%run%hdf5%samples - 1)/samples))
         n = revolutions*samples
      end associate
      if (revolutions == 0 .or. n < 2) return
      step = 1/(n*interval)
      call put('frequency', [(k*step, k=0, n/2)], 'Hz', 'frequency', 'frequency')
      call put('order', [(k*step, k=0, n/2)]*2*pi/inputs%highest_speed(), '1', 'frequency over shaft frequency', &
         & 'frequency')
      call file%last_samples('journal_y', n, y)
      call file%last_samples('journal_z', n, z)
      call put('journal_y', one_sided_amplitude(y(1, :)), 'm', 'amplitude of journal_y', 'frequency')
      call put('journal_z', one_sided_amplitude(z(1, :)), 'm', 'amplitude of journal_z', 'frequency')
      if (inputs%bearings(b)%tilting()) then
         call file%last_samples('pad_tilt', n, tilt)
         allocate (amplitudes(n/2 + 1, size(tilt, 1)))
         do i = 1, size(tilt, 1)
            amplitudes(:, i) = one_sided_amplitude(tilt(i, :))
         end do
         call file%put('spectrum/pad_tilt', amplitudes, 'rad', 'amplitude of pad_tilt', 'pad spectrum/frequency')
      end if
      ! at k/T with k = -((n-1)/2) .. n/2
      call put('full_frequency', [(k*step, k=-((n - 1)/2), n/2)], 'Hz', 'frequency, positive for forward whirl', &
         & 'full_frequency')
      call put('journal_full', full_amplitude(cmplx(y(1, :), inputs%sense()*z(1, :), wp)), 'm', &
         & 'amplitude of journal_y + i journal_z, or - i journal_z where the shaft turns anticlockwise', &
         & 'full_frequency')
      call file%put('spectrum/revolutions', int(revolutions, i8), 'revolutions covered')
   contains
      subroutine put(name, values, units, long_name, over)
         character(len=*), intent(in) :: name, units, long_name, over
         real(wp), intent(in) :: values(:)
         call file%put('spectrum/'//name, values, units, long_name, 'spectrum/'//over)
      end subroutine put
   end subroutine put_spectra

   !> Writes a periodic orbit and its stability; its period has this many revolutions of the shaft.
   subroutine put_periodic(file, found, revolutions)
      class(record_type), intent(inout) :: file
      type(periodic_orbit_type), intent(in) :: found
      integer, intent(in) :: revolutions
      associate (values => found%multipliers)
         call file%put_scale('multiplier', size(values), 'multiplier number')
         call file%put('periodic/period', found%period, 's', 'period of the orbit')
         call file%put('periodic/revolutions', int(revolutions, i8), 'revolutions of the shaft in a period')
         call file%put('periodic/residual', found%residual, '1', &
            & 'largest residual of the equations, over the size of the states')
         call file%put('periodic/iterations', int(found%iterations, i8), 'iterations of Newton''s method')
         call file%put('periodic/intervals', int(found%orbit%intervals(), i8), 'intervals of the collocation')
         call file%put('periodic/evaluations', found%evaluations, &
            & 'evaluations of the equations with their derivatives in all iterations')
         call file%put('periodic/marched_periods', int(found%marched, i8), 'periods of the march before them')
         call put_figure(file, 'leading_multiplier_real', values(1)%re, '1', 'leading multiplier, real part')
         call put_figure(file, 'leading_multiplier_imag', values(1)%im, '1', 'leading multiplier, imaginary part')
         call put_figure(file, 'leading_multiplier_modulus', abs(values(1)), '1', 'leading multiplier, modulus')
         call file%put('periodic/multiplier_real', real(values, wp), '1', 'multiplier, real part', 'multiplier')
         call file%put('periodic/multiplier_imag', aimag(values), '1', 'multiplier, imaginary part', 'multiplier')
         call file%put('periodic/multiplier_error', found%errors, '1', &
            & 'by how much a mesh of shorter intervals changed the multiplier', 'multiplier')
         call file%put('periodic/stable', merge(1_i8, 0_i8, found%is_stable()), &
            & '1 where all multipliers are inside the unit circle, or a march repeats the orbit')
         call file%put('periodic/closed', merge(1_i8, 0_i8, found%closed), &
            & '1 where Newton''s method closed the orbit; 0: it is a period of a march that repeats')
         call file%put('periodic/change', found%change, '1', 'change of the displacements in a period of this ' &
            & //'march, over their characteristic scales')
      end associate
   end subroutine put_periodic
end module march_results
