!> What the file of a run says of its march or periodic orbit, samples and spectra: names, dimensions and units as
!> docs/results.md lists them.
module march_results
   use operating_point, only: operating_point_type
   use kinds, only: wp, i8, pi
   use errors, only: error_type
   use case_inputs, only: case_type
   use spectra, only: one_sided_amplitude, full_amplitude, windowed
   use periodic_orbit, only: periodic_orbit_type
   use record, only: record_type
   use summary_group, only: put_figure
   use state_layout, only: most_coordinates, most_rotations
   use viscosity_history, only: viscosity_history_type
   use tilting_pad_bearing, only: sloped_sample
   use bearing_samples, only: bearing_sample
   use run_file, only: run_file_type
   use bearing_file, only: bearing_file_type
   implicit none (type, external)
   private
   public :: add_sample, put_spectra, put_viscosity_history, put_periodic

   !> Values of a sample: of the shaft, of a journal, and of a pad at most; where slopes count also moments on the
   !> journal, and of a pad places, films at both ends, friction and bristles of pitch and yaw.
   integer, parameter :: of_shaft = 3, of_journal = 4, of_pad = 8 + 2*most_coordinates
   integer, parameter :: of_moments = 2, of_slopes = 4 + 2*(most_rotations - 1)
   !> Revolutions of a spectrum from which on a window leaves whole orders and halves of them apart.
   integer, parameter :: fewest_under_window = 8

contains

   !> Adds a sample at time t, s, of all bearings, in the files of these, of where the stations of a shaft are,
   !> (2, station), m, of the forces of the excitations, (2, excitation), N, and of forces and displacements of other
   !> elements, (2, element, both), N and m.
   subroutine add_sample(file, point, t, bearings, samples, stations, excitations, elements, values, error)
      type(run_file_type), intent(inout) :: file
      type(operating_point_type), intent(in) :: point
      real(wp), intent(in) :: t
      type(bearing_file_type), intent(in) :: bearings(:)
      type(bearing_sample), intent(in) :: samples(:)
      real(wp), intent(in), contiguous :: stations(:, :), excitations(:, :), elements(:, :, :)
      !> Memory for the values, which is used again.
      real(wp), allocatable, intent(inout) :: values(:)
      type(error_type), allocatable, intent(out) :: error
      integer :: n, b
      if (.not. allocated(values)) allocate (values(most_values(samples) + size(stations) + size(excitations) &
         & + size(elements)))
      if (.not. file%hdf5%declared) call declare_samples(file, bearings, samples, size(stations, 2), &
         & size(excitations, 2), size(elements, 2))
      values(:of_shaft) = [t, point%shaft_angle(t), point%speed(t)]
      n = of_shaft
      do b = 1, size(samples)
         call take_bearing(samples(b), values, n)
      end do
      if (size(stations) > 0) call take_pairs(stations, values, n)
      if (size(excitations) > 0) call take_pairs(excitations, values, n)
      if (size(elements) > 0) then
         call take_pairs(elements(:, :, 1), values, n)
         call take_pairs(elements(:, :, 2), values, n)
      end if
      call file%hdf5%add(values(:n))
      call file%error_of(error)
   end subroutine add_sample

   !> Most values of all bearings, and of the shaft without stations and excitations.
   pure integer function most_values(samples) result(n)
      type(bearing_sample), intent(in) :: samples(:)
      integer :: b
      n = of_shaft
      do b = 1, size(samples)
         n = n + of_journal + of_pad*size(samples(b)%states)
         if (allocated(samples(b)%slopes)) n = n + 2*of_moments + of_slopes*size(samples(b)%states)
      end do
   end function most_values

   !> Adds the values of a bearing behind the first n, in the order of `declare_bearing`: of a series of the pads those
   !> of all pads side by side.
   subroutine take_bearing(sample, values, n)
      type(bearing_sample), intent(in) :: sample
      real(wp), intent(inout), contiguous :: values(:)
      integer, intent(inout) :: n
      integer :: pads, i, j, at, rotations
      rotations = sample%coordinates%rotations
      values(n + 1:n + of_journal) = [sample%journal%position, sample%journal%velocity]
      n = n + of_journal
      if (allocated(sample%slopes)) then
         values(n + 1:n + of_moments) = sample%moment
         n = n + of_moments
      end if
      if (sample%inclined) then
         values(n + 1:n + 2) = sample%journal%slope
         n = n + 2
      end if
      pads = size(sample%states)
      at = n
      do i = 1, pads
         at = n + i
         associate (pad => sample%loads(i), state => sample%states(i))
            if (sample%coordinates%n > 0) then
               call take(pad%pivot_load)
               call take(pad%friction_moment)
            end if
            call take(pad%film_force(1))
            call take(pad%film_force(2))
            call take(pad%min_film_thickness)
            call take(pad%max_pressure)
            do j = 1, sample%coordinates%n
               call take(state%x(sample%coordinates%kind(j)))
               call take(state%v(sample%coordinates%kind(j)))
            end do
            if (sample%bristles) then
               call take(state%bristle(1))
               do j = 2, rotations
                  call take(state%bristle(j))
               end do
            end if
            if (sample%asperities) call take(pad%asperity_force)
         end associate
         if (allocated(sample%slopes)) call take_slopes(sample%slopes(i))
      end do
      ! the last pad stands behind all others
      n = at - pads
   contains
      subroutine take(value)
         real(wp), intent(in) :: value
         values(at) = value
         at = at + pads
      end subroutine take

      subroutine take_slopes(slopes)
         type(sloped_sample), intent(in) :: slopes
         integer :: k
         do k = 2, rotations
            call take(slopes%friction_moment(k - 1))
         end do
         do k = 1, 2
            call take(slopes%edge_films(k))
            call take(slopes%place(k))
         end do
      end subroutine take_slopes
   end subroutine take_bearing

   !> Adds y and z of each of a number of stations, excitations or elements, (2, number), behind the first n values.
   pure subroutine take_pairs(pairs, values, n)
      real(wp), intent(in), contiguous :: pairs(:, :)
      real(wp), intent(inout), contiguous :: values(:)
      integer, intent(inout) :: n
      integer :: i
      do i = 1, size(pairs, 2)
         values(n + i) = pairs(1, i)
         values(n + size(pairs, 2) + i) = pairs(2, i)
      end do
      n = n + size(pairs)
   end subroutine take_pairs

   !> Names all series: of the shaft, of the bearings, and of these numbers of stations, excitations and other elements.
   subroutine declare_samples(file, bearings, samples, stations, excitations, elements)
      type(run_file_type), intent(inout) :: file
      type(bearing_file_type), intent(in) :: bearings(:)
      type(bearing_sample), intent(in) :: samples(:)
      integer, intent(in) :: stations, excitations, elements
      integer :: b
      call file%hdf5%declare('time', 1, 's', 'time', '')
      call file%hdf5%declare('shaft_angle', 1, 'rad', 'shaft angle', '')
      call file%hdf5%declare('speed', 1, 'rad/s', 'shaft speed', '')
      do b = 1, size(samples)
         call declare_bearing(bearings(b), samples(b))
      end do
      call declare_pair(stations, 'station', 'station', 'm', 'shaft displacement')
      call declare_pair(excitations, 'excitation', 'excitation', 'N', 'force of the excitation')
      call declare_pair(elements, 'element', 'element_force', 'N', 'force of the element on the rotor')
      call declare_pair(elements, 'element', 'element', 'm', 'displacement of the element''s station from its other ' &
         & //'end')
   contains
      subroutine declare_pair(number, across, name, units, long_name)
         integer, intent(in) :: number
         character(len=*), intent(in) :: across, name, units, long_name
         if (number == 0) return
         call file%hdf5%declare(name//'_y', number, units, long_name//', vertical', across)
         call file%hdf5%declare(name//'_z', number, units, long_name//', horizontal', across)
      end subroutine declare_pair
   end subroutine declare_samples

   !> Names the series of a bearing, in the order of the values in `take_bearing`.
   subroutine declare_bearing(file, sample)
      type(bearing_file_type), intent(in) :: file
      type(bearing_sample), intent(in) :: sample
      integer :: j
      call file%declare('journal_y', 1, 'm', 'journal displacement, vertical', '')
      call file%declare('journal_z', 1, 'm', 'journal displacement, horizontal', '')
      call file%declare('journal_vy', 1, 'm/s', 'journal velocity, vertical', '')
      call file%declare('journal_vz', 1, 'm/s', 'journal velocity, horizontal', '')
      if (allocated(sample%slopes)) then
         call file%declare('journal_moment_y', 1, 'N m', 'moment on the journal against its vertical slope', '')
         call file%declare('journal_moment_z', 1, 'N m', 'moment on the journal against its horizontal slope', '')
      end if
      if (sample%inclined) then
         call file%declare('journal_slope_y', 1, 'rad', 'slope of the shaft in the bearing, vertical', '')
         call file%declare('journal_slope_z', 1, 'rad', 'slope of the shaft in the bearing, horizontal', '')
      end if
      if (sample%coordinates%n > 0) then
         call of_pads('pivot_load', 'N', 'pivot load')
         call of_pads('friction_moment', 'N m', 'pivot friction moment')
      end if
      call of_pads('film_force_tangential', 'N', 'film force on the journal along the pad (y'')')
      call of_pads('film_force_radial', 'N', 'film force on the journal outward (z'')')
      call of_pads('min_film_thickness', 'm', 'minimum film thickness')
      call of_pads('max_pressure', 'Pa', 'maximum film pressure')
      do j = 1, sample%coordinates%n
         associate (words => sample%coordinates%words(j))
            call of_pads(trim(words%series), trim(words%units), trim(words%label))
            call of_pads(trim(words%series)//'_rate', trim(words%units)//'/s', trim(words%label)//' rate')
         end associate
      end do
      if (sample%bristles) then
         do j = 1, sample%coordinates%rotations
            call of_pads(sample%coordinates%bristle_series(j), 'm', 'bristle deflection')
         end do
      end if
      if (sample%asperities) call of_pads('asperity_force', 'N', &
         & 'normal force between the asperities of pad and journal')
      if (.not. allocated(sample%slopes)) return
      do j = 2, sample%coordinates%rotations
         associate (name => sample%coordinates%words(sample%coordinates%rotation(j))%name)
            call of_pads('friction_moment_'//trim(name), 'N m', 'pivot friction moment against the '//trim(name))
         end associate
      end do
      call of_pads('start_film_thickness', 'm', 'minimum film thickness at the end of lower x')
      call of_pads('max_pressure_angle', 'rad', 'angle of the maximum pressure from the pivot')
      call of_pads('end_film_thickness', 'm', 'minimum film thickness at the end of higher x')
      call of_pads('max_pressure_axial', 'm', 'distance of the maximum pressure from the middle along the shaft')
   contains
      subroutine of_pads(name, units, long_name)
         character(len=*), intent(in) :: name, units, long_name
         call file%declare(name, size(sample%states), units, long_name, 'pad')
      end subroutine of_pads
   end subroutine declare_bearing

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
   !> where it was not sampled over one. Under a Hann window what lies between the lines does not spread over all of
   !> them; of a periodic orbit, whose period they cover, nothing lies there, and of few revolutions lines are too far
   !> apart.
   subroutine put_spectra(file, inputs, b, interval)
      type(bearing_file_type), intent(inout) :: file
      type(case_type), intent(in) :: inputs
      integer, intent(in) :: b
      !> Between samples, s.
      real(wp), intent(in) :: interval
      real(wp), allocatable, dimension(:, :) :: y, z, tilt, signals, amplitudes
      !> Lines of the spectra, Hz, from that of the fastest backward whirl to that of the fastest forward one.
      real(wp), allocatable :: line(:)
      real(wp), allocatable :: means(:), full(:)
      real(wp) :: step
      integer :: revolutions, n, k
      logical :: under_window
      if (.not. inputs%is_steady()) return
      associate (samples => inputs%output%samples_per_revolution)
         revolutions = int(min(int(inputs%output%spectrum_revolutions, i8), (file%run%hdf5%samples - 1)/samples))
         n = revolutions*samples
      end associate
      if (revolutions == 0 .or. n < 2) return
      step = 1/(n*interval)
      allocate (line(-((n - 1)/2):n/2))
      do k = lbound(line, 1), n/2
         line(k) = k*step
      end do
      call put('frequency', line(0:), 'Hz', 'frequency', 'frequency')
      call put('order', line(0:)*2*pi/inputs%highest_speed(), '1', 'frequency over shaft frequency', 'frequency')
      call file%last_samples('journal_y', n, y)
      call file%last_samples('journal_z', n, z)
      if (inputs%bearings(b)%tilting()) then
         call file%last_samples('pad_tilt', n, tilt)
      else
         allocate (tilt(0, n))
      end if
      allocate (signals(n, 2 + size(tilt, 1)))
      signals(:, 1) = y(1, :)
      signals(:, 2) = z(1, :)
      signals(:, 3:) = transpose(tilt)
      under_window = inputs%about%task == 'march' .and. revolutions >= fewest_under_window
      means = sum(signals, 1)/n
      if (under_window) signals = windowed(signals)
      amplitudes = one_sided_amplitude(signals)
      if (under_window) amplitudes(lbound(amplitudes, 1), :) = abs(means)
      call put('journal_y', amplitudes(:, 1), 'm', 'amplitude of journal_y', 'frequency')
      call put('journal_z', amplitudes(:, 2), 'm', 'amplitude of journal_z', 'frequency')
      if (size(signals, 2) > 2) call file%put('spectrum/pad_tilt', amplitudes(:, 3:), 'rad', 'amplitude of pad_tilt', &
         & 'pad spectrum/frequency')
      ! at k/T with k = -((n-1)/2) .. n/2
      call put('full_frequency', line, 'Hz', 'frequency, positive for forward whirl', 'full_frequency')
      full = full_amplitude(cmplx(signals(:, 1), inputs%sense()*signals(:, 2), wp))
      if (under_window) full(lbound(full, 1) + (n - 1)/2) = norm2(means(:2))
      call put('journal_full', full, 'm', 'amplitude of journal_y + i journal_z, or - i journal_z where the shaft ' &
         & //'turns anticlockwise', 'full_frequency')
      call file%put('spectrum/revolutions', int(revolutions, i8), 'revolutions covered')
      call file%put('spectrum/window', merge(1_i8, 0_i8, under_window), '1: Hann window, amplitudes restored; 0: none')
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
