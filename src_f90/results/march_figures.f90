!> Figures of a march or a periodic orbit, from its samples: of the last revolution or the period of the orbit, of the
!> last revolutions (as many as the spectra may have), and of the whole run. Console, report and studies take them from
!> the file.
module march_figures
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use kinds, only: wp, pi, degree
   use rising_numbers, only: number_up_to
   use case_groups, only: bearing_type, mount_type
   use case_inputs, only: case_type
   use loops, only: path_integral, harmonic, slow_share, integral_over_way
   use pad_behaviour, only: pad_behaviour_type, behaviour_of, whirl_of, evenly
   use revolution_points, only: revolution_points_type, describe_points, amplitude_at, fewest_points
   use run_file, only: run_file_type
   use bearing_file, only: bearing_file_type
   use summary_group, only: put_figure, figure, forget_figures, run_extremes_type
   use contact_law, only: contact_law_type, contact_point
   use factories, only: make_law
   implicit none (type, external)
   private
   public :: put_progress, put_march_figures, put_revolutions, put_machine_figures

   character(len=*), parameter :: group = 'by_revolution/', over = 'revolution'
   !> Figures that a motion has which does not repeat after a revolution, or winds round a torus.
   character(len=*), parameter :: of_points(*) = [character(len=24) :: 'rotation_number', 'rotation_difference', &
      & 'ring_growth', 'ring_y', 'ring_z', 'second_frequency', 'second_amplitude', 'lower_sideband_frequency', &
      & 'lower_sideband_amplitude', 'upper_sideband_frequency', 'upper_sideband_amplitude']
   !> Part of a revolution that a whole one may lack by rounding.
   real(wp), parameter :: rounding = 1e-9_wp

   !> A pivot sticks below this share of the velocity over which friction falls from static to dynamic; the values of
   !> the paper give 5e-5 m/s for both laws.
   real(wp), parameter :: sticking = 0.05_wp

contains

   !> Writes how far the samples so far go.
   subroutine put_progress(file)
      class(run_file_type), intent(inout) :: file
      real(wp), allocatable :: time(:, :), speed(:, :)
      call file%hdf5%last_samples('time', 1, time)
      call file%hdf5%last_samples('speed', 1, speed)
      call put_figure(file, 'time_reached', time(1, 1), 's', 'time reached')
      call put_figure(file, 'speed', speed(1, 1), 'rad/s', 'shaft speed at the end')
      call put_figure(file, 'revolutions', file%sampled_revolutions(), '1', 'shaft revolutions sampled')
   end subroutine put_progress

   !> Writes all figures of the samples of bearing b of a case so far, with this load on its journal, N.
   subroutine put_march_figures(file, inputs, b, extremes, load)
      type(bearing_file_type), intent(inout) :: file
      type(case_type), intent(in) :: inputs
      integer, intent(in) :: b
      type(run_extremes_type), intent(in) :: extremes
      real(wp), intent(in) :: load
      real(wp), allocatable :: time(:, :), angle(:, :)
      real(wp) :: revolutions
      integer :: n, whole
      revolutions = file%run%sampled_revolutions()
      whole = whole_turns(file%run, inputs)
      n = file%run%last_revolutions(whole)
      call file%last_samples('shaft_angle', n, angle)
      call file%last_samples('time', n, time)
      call extremes%write(file, load, (time(1, n) - time(1, 1))/max(1, n - 1))
      call put_journal(file, n)
      call put_film(file, n)
      if (file%has_series('journal_moment_y')) call put_slopes(file, inputs%bearings(b), n)
      associate (bearing => inputs%bearings(b), tilting => inputs%bearings(b)%tilting())
         if (tilting) call put_tilt(file, n)
         call put_last_revolutions(file, inputs, bearing, int(revolutions + rounding))
         if (revolutions < 1 - rounding) return
         call put_harmonics(file, tilting, whole, int(revolutions + rounding))
         if (tilting .and. bearing%friction%model /= 'none') call put_friction(file, bearing, time(1, :), &
            & (angle(1, n) - angle(1, 1))/(2*pi))
         if (tilting .and. bearing%pivot%wear_coefficient > 0) call put_wear(file, bearing, time(1, :))
         n = file%run%last_revolutions(inputs%output%spectrum_revolutions)
         call put_revolutions(file, tilting, n, inputs%output%spectrum_revolutions)
         if (inputs%about%task /= 'march' .or. .not. inputs%is_steady()) return
         call put_points(file, inputs, bearing%clearance(), n)
      end associate
   end subroutine put_march_figures

   !> The revolutions at the end that figures are of: one, of a periodic orbit all of its period.
   integer function whole_turns(file, inputs)
      class(run_file_type), intent(inout) :: file
      type(case_type), intent(in) :: inputs
      whole_turns = 1
      if (inputs%about%task == 'periodic') whole_turns = max(1, int(file%sampled_revolutions() + rounding))
   end function whole_turns

   !> The orbit of the journal in the last n samples.
   subroutine put_journal(file, n)
      type(bearing_file_type), intent(inout) :: file
      integer, intent(in) :: n
      real(wp), allocatable :: y(:, :), z(:, :)
      call file%last_samples('journal_y', n, y)
      call file%last_samples('journal_z', n, z)
      call put_figure(file, 'journal_y_max', maxval(y), 'm', 'highest journal displacement, vertical')
      call put_figure(file, 'journal_y_min', minval(y), 'm', 'lowest journal displacement, vertical')
      call put_figure(file, 'journal_z_max', maxval(z), 'm', 'highest journal displacement, horizontal')
      call put_figure(file, 'journal_z_min', minval(z), 'm', 'lowest journal displacement, horizontal')
      associate (size_y => maxval(y) - minval(y), size_z => maxval(z) - minval(z))
         call put_figure(file, 'orbit_y', size_y, 'm', 'orbit, peak to peak of y')
         call put_figure(file, 'orbit_z', size_z, 'm', 'orbit, peak to peak of z')
         call put_figure(file, 'orbit_size', max(size_y, size_z), 'm', 'orbit, the larger of both peak to peak')
      end associate
      call put_figure(file, 'mean_y', mean(y(1, :)), 'm', 'orbit, mean y')
      call put_figure(file, 'mean_z', mean(z(1, :)), 'm', 'orbit, mean z')
   end subroutine put_journal

   !> The mean of samples over a revolution, of whose two ends one counts.
   pure real(wp) function mean(values)
      real(wp), intent(in) :: values(:)
      integer :: first
      first = min(2, size(values))
      mean = sum(values(first:))/(size(values) - first + 1)
   end function mean

   !> Film and pressure in the last n samples.
   subroutine put_film(file, n)
      type(bearing_file_type), intent(inout) :: file
      integer, intent(in) :: n
      real(wp), allocatable :: film(:, :), pressure(:, :)
      call file%last_samples('min_film_thickness', n, film)
      call file%last_samples('max_pressure', n, pressure)
      call put_figure(file, 'min_film_thickness', minval(film), 'm', 'minimum film thickness, last revolution or ' &
         & //'period')
      call put_figure(file, 'max_pressure', maxval(pressure), 'Pa', 'maximum pressure, last revolution or period')
      call put_figure(file, 'pad_min_film_thickness', minval(film, dim=2), 'm', 'minimum film thickness')
      call put_figure(file, 'pad_max_pressure', maxval(pressure, dim=2), 'Pa', 'maximum pressure')
   end subroutine put_film

   !> Moments on the journal, films at both ends and what pads that pitch do in the last n samples, where slopes count.
   subroutine put_slopes(file, bearing, n)
      type(bearing_file_type), intent(inout) :: file
      type(bearing_type), intent(in) :: bearing
      integer, intent(in) :: n
      real(wp), allocatable :: values(:, :)
      call put_moment('y', 'vertical')
      call put_moment('z', 'horizontal')
      call put_least('start_film_thickness', 'lower')
      call put_least('end_film_thickness', 'higher')
      if (bearing%pitching()) call put_range('pad_pitch', 'pitch')
      if (bearing%yawing()) call put_range('pad_yaw', 'yaw')
   contains
      subroutine put_moment(axis, direction)
         character(len=*), intent(in) :: axis, direction
         call file%last_samples('journal_moment_'//axis, n, values)
         call put_figure(file, 'mean_moment_'//axis, mean(values(1, :)), 'N m', 'mean moment on the journal against ' &
            & //'its '//direction//' slope')
      end subroutine put_moment

      subroutine put_least(name, place)
         character(len=*), intent(in) :: name, place
         call file%last_samples(name, n, values)
         call put_figure(file, 'pad_'//name, minval(values, dim=2), 'm', 'minimum film thickness at the end of ' &
            & //place//' x')
      end subroutine put_least

      subroutine put_range(name, meaning)
         character(len=*), intent(in) :: name, meaning
         call file%last_samples(name, n, values)
         call put_figure(file, name//'_max', maxval(values, dim=2), 'rad', 'highest '//meaning)
         call put_figure(file, name//'_min', minval(values, dim=2), 'rad', 'lowest '//meaning)
      end subroutine put_range
   end subroutine put_slopes

   !> Tilts and contact in the last n samples.
   subroutine put_tilt(file, n)
      type(bearing_file_type), intent(inout) :: file
      integer, intent(in) :: n
      real(wp), allocatable :: tilt(:, :), contact(:, :)
      integer :: i
      call file%last_samples('pad_tilt', n, tilt)
      call file%last_samples('pivot_load', n, contact)
      associate (highest => maxval(tilt, dim=2), lowest => minval(tilt, dim=2))
         call put_figure(file, 'pad_tilt_max', highest, 'rad', 'highest tilt')
         call put_figure(file, 'pad_tilt_min', lowest, 'rad', 'lowest tilt')
         call put_figure(file, 'pad_tilt_size', highest - lowest, 'rad', 'tilt, peak to peak')
      end associate
      call put_figure(file, 'pad_contact_force', [(mean(contact(i, :)), i=1, size(contact, 1))], 'N', 'mean pivot load')
   end subroutine put_tilt

   !> Vibrations with the shaft over the last `whole` revolutions, and at half its speed over an even number of them.
   subroutine put_harmonics(file, tilting, whole, revolutions)
      type(bearing_file_type), intent(inout) :: file
      logical, intent(in) :: tilting
      integer, intent(in) :: whole, revolutions
      integer :: n
      n = file%run%last_revolutions(whole)
      call put_order(1.0_wp, '_', 'with the shaft')
      if (revolutions < 2) return
      n = file%run%last_revolutions(max(2, whole - mod(whole, 2)))
      call put_order(0.5_wp, '_half_', 'at half the shaft speed')
   contains
      !> Of an order, which names and meanings call so.
      subroutine put_order(order, name, words)
         real(wp), intent(in) :: order
         character(len=*), intent(in) :: name, words
         character(len=*), parameter :: directions(2) = [character(len=10) :: 'vertical', 'horizontal']
         complex(wp), allocatable :: part(:)
         integer :: k
         do k = 1, 2
            associate (journal => 'journal_'//'yz'(k:k))
               part = parts(journal, order)
               call put_figure(file, journal//name//'amplitude', abs(part(1)), 'm', &
                  & trim(directions(k))//' journal vibration '//words//', amplitude')
               if (order < 1) cycle
               call put_figure(file, journal//name//'phase', -atan2(part(1)%im, part(1)%re), 'rad', &
                  & trim(directions(k))//' journal vibration '//words//', phase behind the unbalance')
            end associate
         end do
         if (tilting) call put_figure(file, 'pad_tilt'//name//'amplitude', abs(parts('pad_tilt', order)), 'rad', &
            & 'tilt '//words//', amplitude')
      end subroutine put_order

      !> The part of this order of each row of a series.
      function parts(name, order)
         character(len=*), intent(in) :: name
         real(wp), intent(in) :: order
         complex(wp), allocatable :: parts(:)
         real(wp), allocatable :: angle(:, :), values(:, :)
         integer :: i
         call file%last_samples('shaft_angle', n, angle)
         call file%last_samples(name, n, values)
         parts = [(harmonic(angle(1, :), values(i, :), order), i=1, size(values, 1))]
      end function parts
   end subroutine put_harmonics

   !> What friction in the pivots does in the last samples, at these times, s, in this many revolutions.
   subroutine put_friction(file, bearing, time, revolutions)
      type(bearing_file_type), intent(inout) :: file
      type(bearing_type), intent(in) :: bearing
      real(wp), intent(in) :: time(:), revolutions
      real(wp), allocatable :: rate(:, :), moment(:, :)
      real(wp), dimension(bearing%pad_count()) :: work, stuck
      real(wp) :: slow
      integer :: i, n
      n = size(time)
      work = works('tilt', 'friction_moment', rate, moment)
      if (bearing%pitching()) work = work + works('pitch', 'friction_moment_pitch', rate, moment)
      if (bearing%yawing()) work = work + works('yaw', 'friction_moment_yaw', rate, moment)
      associate (law => bearing%friction, pivot => bearing%pivot)
         slow = law%critical_velocity
         if (law%model == 'lugre') then
            slow = sticking*law%stribeck_velocity
         else if (law%decay > 0) then
            slow = sticking/law%decay
         end if
         do i = 1, size(work)
            stuck(i) = slow_share(time, (pivot%socket_radius(i) - pivot%radius_difference(i))*rate(i, :), slow)
         end do
      end associate
      call put_figure(file, 'friction_work', sum(work)/revolutions, 'J', 'friction work a revolution, all pads')
      call put_figure(file, 'pad_friction_work', work/revolutions, 'J', 'friction work a revolution')
      call put_figure(file, 'pad_friction_power', work/(time(n) - time(1)), 'W', 'mean friction power')
      call put_figure(file, 'pad_friction_moment', maxval(abs(moment), dim=2), 'N m', 'maximum friction moment')
      call put_figure(file, 'stick_velocity', slow, 'm/s', 'sliding velocity below which a pivot sticks')
      call put_figure(file, 'stick_fraction', sum(stuck)/size(stuck), '1', &
         & 'share of time that pivots stick, mean of the pads')
      call put_figure(file, 'pad_stick_fraction', stuck, '1', 'share of time that the pivot sticks')
   contains
      !> The work of friction against a rotation, J, of each pad; rate and moment become those of all rotations so far,
      !> the first as it is, with others their size.
      function works(rotation, series, all_rates, all_moments)
         character(len=*), intent(in) :: rotation, series
         real(wp), allocatable, intent(inout) :: all_rates(:, :), all_moments(:, :)
         real(wp) :: works(bearing%pad_count())
         real(wp), allocatable :: angle(:, :), own_rate(:, :), own_moment(:, :)
         integer :: i
         call file%last_samples('pad_'//rotation, n, angle)
         call file%last_samples('pad_'//rotation//'_rate', n, own_rate)
         call file%last_samples(series, n, own_moment)
         works = [(path_integral(angle(i, :), own_moment(i, :)), i=1, size(angle, 1))]
         if (allocated(all_rates)) then
            all_rates = hypot(all_rates, own_rate)
            all_moments = hypot(all_moments, own_moment)
         else
            call move_alloc(own_rate, all_rates)
            call move_alloc(own_moment, all_moments)
         end if
      end function works
   end subroutine put_friction

   !> Lift-off, flutter and rubbing of the pads and whirl of the journal in the last revolutions. Fixed pads can only
   !> rub.
   subroutine put_last_revolutions(file, inputs, bearing, whole)
      type(bearing_file_type), intent(inout) :: file
      type(case_type), intent(in) :: inputs
      type(bearing_type), intent(in) :: bearing
      !> Whole revolutions sampled.
      integer, intent(in) :: whole
      type(pad_behaviour_type) :: found(bearing%pad_count())
      real(wp), allocatable, dimension(:, :) :: angle, contact, tilt, asperity, y, z
      real(wp) :: revolutions, order, amplitude
      logical :: whirls, steady
      integer :: n
      n = file%run%last_revolutions(max(1, min(inputs%output%spectrum_revolutions, whole)))
      steady = inputs%is_steady()
      call file%last_samples('shaft_angle', n, angle)
      revolutions = (angle(1, n) - angle(1, 1))/(2*pi)
      if (file%has_series('asperity_force')) then
         call file%last_samples('asperity_force', n, asperity)
         found%rubbing = count(asperity > 0, dim=2)/real(n, wp)
         call put_figure(file, 'pad_rubbing', found%rubbing, '1', 'share of the time in which the surfaces touch')
         deallocate (asperity)
      end if
      if (bearing%tilting()) then
         call file%last_samples('pivot_load', n, contact)
         call take('pad_tilt', tilt)
         call behaviour_of(found, contact, tilt, revolutions, bearing%assembled_clearance &
            & /(0.5_wp*bearing%pads%arc_deg*degree*bearing%journal_radius))
         call put_figure(file, 'pad_load', found%load, 'N', 'mean pivot load, last revolutions')
         call put_figure(file, 'pad_unloaded', merge(1.0_wp, 0.0_wp, found%unloaded), '1', '1 where it carries no load')
         call put_figure(file, 'pad_lifted', found%lifted, '1', 'share of the time lifted off its pivot')
         call put_figure(file, 'pad_order', known(found%order), '1', 'dominant order of the tilt')
         call put_figure(file, 'pad_order_amplitude', found%amplitude, 'rad', 'tilt at its dominant order, amplitude')
         call put_figure(file, 'pad_flutters', merge(1.0_wp, 0.0_wp, found%flutters), '1', '1 where it flutters')
      end if
      call take('journal_y', y)
      call take('journal_z', z)
      call whirl_of(y(1, :), z(1, :), revolutions, bearing%clearance(), order, amplitude, whirls)
      call put_figure(file, 'last_revolutions', revolutions, '1', &
         & 'revolutions over which lift-off, orders and shares are')
      call put_figure(file, 'whirl_order', known(order), '1', &
         & 'order of the largest journal motion that is no multiple of 1x')
      call put_figure(file, 'whirl_amplitude', amplitude, 'm', 'amplitude of this order')
      call put_figure(file, 'whirls', merge(1.0_wp, 0.0_wp, whirls), '1', '1 where the journal whirls at this order')
   contains
      !> A series but its last sample, which begins the next revolution, at equal steps of the shaft angle.
      subroutine take(name, values)
         character(len=*), intent(in) :: name
         real(wp), allocatable, intent(out) :: values(:, :)
         integer :: i
         call file%last_samples(name, n, values)
         if (.not. steady) then
            do i = 1, size(values, 1)
               values(i, :) = evenly(angle(1, :), values(i, :))
            end do
         end if
         if (n > 2) values = values(:, :n - 1)
      end subroutine take
   end subroutine put_last_revolutions

   !> An order, or no number where it is not known.
   elemental real(wp) function known(order)
      real(wp), intent(in) :: order
      known = order
      if (order < 0) known = ieee_value(order, ieee_quiet_nan)
   end function known

   ! Figures of each of the last revolutions of a run, as many as the spectra may have, group `by_revolution`: the
   ! states of journal and pads once a revolution (Poincare points), and their extremes in it. A motion that repeats
   ! after k revolutions is k points.

   !> Writes those of the last n samples, which are of whole revolutions, this many at most; of tilts where pads tilt.
   subroutine put_revolutions(file, tilting, n, most)
      type(bearing_file_type), intent(inout) :: file
      logical, intent(in) :: tilting
      integer, intent(in) :: n, most
      real(wp), allocatable :: angle(:, :)
      integer :: first, last, k
      call file%last_samples('shaft_angle', n, angle)
      ! a point at an end counts in spite of rounding; where both ends have one, the last points are taken
      last = floor(angle(1, n)/(2*pi) + rounding)
      first = max(ceiling(angle(1, 1)/(2*pi) - rounding), last + 1 - most)
      if (last < first) return
      call file%put(over, [(real(k, wp), k=first - last, 0)], '1', 'revolutions before the last Poincare point', over)
      call put('journal_y', 'y', 'm', 'journal y')
      call put('journal_z', 'z', 'm', 'journal z')
      if (tilting) call put('pad_tilt', 'tilt', 'rad', 'tilt')
   contains
      subroutine put(name, short, units, meaning)
         character(len=*), intent(in) :: name, short, units, meaning
         real(wp), allocatable :: values(:, :)
         real(wp), allocatable, dimension(:, :) :: points, lowest, highest
         integer :: i
         call file%last_samples(name, n, values)
         allocate (points(size(values, 1), last - first + 1))
         allocate (lowest, highest, mold=points)
         do i = 1, last - first + 1
            points(:, i) = at_angle(angle(1, :), values, 2*pi*(first + i - 1))
         end do
         call find_extremes(angle(1, :), values, lowest, highest)
         call put_values('poincare_'//short, points, units, meaning//' once a revolution')
         call put_values('lowest_'//short, lowest, units, meaning//' at its lowest in a revolution')
         call put_values('highest_'//short, highest, units, meaning//' at its highest in a revolution')
      end subroutine put

      !> Of the journal, or of each pad.
      subroutine put_values(name, values, units, long_name)
         character(len=*), intent(in) :: name, units, long_name
         real(wp), intent(in) :: values(:, :)
         if (index(name, 'tilt') > 0) then
            call file%put(group//name, values, units, long_name, over//' pad')
         else
            call file%put(group//name, values(1, :), units, long_name, over)
         end if
      end subroutine put_values
   end subroutine put_revolutions

   !> Values (:, time) where the rising angle has the value wanted, by the cubic through the four nearest samples.
   pure function at_angle(angle, values, wanted) result(found)
      real(wp), intent(in) :: angle(:), values(:, :), wanted
      real(wp) :: found(size(values, 1)), weight
      integer :: number, first, i, j
      number = min(4, size(angle))
      first = number_up_to(angle, wanted) - number/2 + 1
      first = max(1, min(first, size(angle) - number + 1))
      found = 0
      do i = first, first + number - 1
         weight = 1
         do j = first, first + number - 1
            if (j /= i) weight = weight*(wanted - angle(j))/(angle(i) - angle(j))
         end do
         found = found + weight*values(:, i)
      end do
   end function at_angle

   !> Extremes of values (:, time) in the whole revolutions before the last sample, the last of which is the last
   !> column; not a number where there are fewer revolutions than columns.
   pure subroutine find_extremes(angle, values, lowest, highest)
      real(wp), intent(in) :: angle(:), values(:, :)
      real(wp), intent(out) :: lowest(:, :), highest(:, :)
      integer :: n, revolutions, column, start, next, k
      n = size(angle)
      lowest = ieee_value(1.0_wp, ieee_quiet_nan)
      highest = lowest
      revolutions = int((angle(n) - angle(1))/(2*pi) + rounding)
      next = n + 1
      do k = 1, min(revolutions, size(lowest, 2))
         column = size(lowest, 2) + 1 - k
         start = 1 + number_up_to(angle, angle(n) - 2*pi*k - rounding)
         lowest(:, column) = minval(values(:, start:next - 1), dim=2)
         highest(:, column) = maxval(values(:, start:next - 1), dim=2)
         next = start
      end do
   end subroutine find_extremes

   !> Writes what the points once a revolution say of the motion, over the last n samples.
   subroutine put_points(file, inputs, clearance, n)
      type(bearing_file_type), intent(inout) :: file
      type(case_type), intent(in) :: inputs
      !> Of the bearing, m.
      real(wp), intent(in) :: clearance
      integer, intent(in) :: n
      type(revolution_points_type) :: found
      real(wp), allocatable :: angle(:, :), y(:), z(:)
      real(wp) :: orders(4)
      y = file%get_all(group//'poincare_y')
      z = file%get_all(group//'poincare_z')
      if (size(y) < fewest_points) return
      found = describe_points(y, z, clearance, inputs%sense())
      call forget_figures(file, of_points)
      call put_figure(file, 'repeats_after', real(found%repeats_after, wp), '1', 'revolutions after which the motion ' &
         & //'repeats; 0: it does not')
      call put_figure(file, 'quasi_periodic', merge(1.0_wp, 0.0_wp, found%on_torus), '1', '1 where it winds round a ' &
         & //'torus')
      if (found%repeats_after == 1) return
      call put_figure(file, 'rotation_number', known(found%rotation), '1', 'part of a turn about their centre by ' &
         & //'which the Poincare points go on in a revolution')
      call put_figure(file, 'rotation_difference', known(found%difference), '1', 'difference of the rotation numbers ' &
         & //'of both halves of the points')
      call put_figure(file, 'ring_growth', found%growth, '1', 'change of the mean square distance from the centre ' &
         & //'from one half of the points to the other')
      call put_figure(file, 'ring_y', maxval(y) - minval(y), 'm', 'Poincare points, peak to peak of y')
      call put_figure(file, 'ring_z', maxval(z) - minval(z), 'm', 'Poincare points, peak to peak of z')
      if (.not. found%on_torus) return
      call file%last_samples('shaft_angle', n, angle)
      ! neither whole turns nor their sense show in the points
      orders = [found%rotation, 1 - found%rotation, 1 + found%rotation, 2 - found%rotation]
      associate (order => orders(minloc(abs(orders - figure(file, 'whirl_order')), dim=1)))
         call put_vibration('second', order, 'second frequency')
         call put_vibration('lower_sideband', abs(1 - order), 'difference of shaft and second frequency')
         call put_vibration('upper_sideband', 1 + order, 'sum of shaft and second frequency')
      end associate
   contains
      subroutine put_vibration(name, order, words)
         character(len=*), intent(in) :: name, words
         real(wp), intent(in) :: order
         real(wp), allocatable :: values(:, :)
         real(wp) :: amplitude(2)
         integer :: k
         do k = 1, 2
            call file%last_samples('journal_'//'yz'(k:k), n, values)
            amplitude(k) = amplitude_at(order, angle(1, :), values(1, :))
         end do
         call put_figure(file, name//'_frequency', order*inputs%highest_speed()/(2*pi), 'Hz', words)
         call put_figure(file, name//'_amplitude', maxval(amplitude), 'm', words//', amplitude of the journal along ' &
            & //'y or z, the larger one')
      end subroutine put_vibration
   end subroutine put_points

   ! Figures of the stations of a shaft, and of what acts on it, in a march or a periodic orbit, from its samples: of
   ! the last revolution or the period.

   !> Writes how far stations and elements move, and dampers in their clearances.
   subroutine put_machine_figures(file, inputs)
      class(run_file_type), intent(inout) :: file
      type(case_type), intent(in) :: inputs
      real(wp), allocatable, dimension(:, :) :: y, z
      type(mount_type), allocatable :: mounts(:)
      integer :: n, k, i
      mounts = inputs%mounts()
      n = file%last_revolutions(whole_turns(file, inputs))
      call put_whirls(file, n, 'station', 'shaft')
      if (size(inputs%element_labels()) == 0) return
      call put_whirls(file, n, 'element', 'element')
      associate (dampers => inputs%dampers())
         if (size(dampers) == 0) return
         call file%hdf5%last_samples('element_y', n, y)
         call file%hdf5%last_samples('element_z', n, z)
         k = size(y, 1) - size(dampers)
         call put_figure(file, 'damper_eccentricity', [(maxval(hypot(y(k + i, :), z(k + i, :))) &
            & /mounts(dampers(i))%damper%clearance, i=1, size(dampers))], '1', &
            & 'largest displacement of the damper''s ring over its clearance', 'damper')
      end associate
   end subroutine put_machine_figures

   !> Writes how far each station or element moves in the last n samples, and how much of it with the shaft.
   subroutine put_whirls(file, n, across, what)
      class(run_file_type), intent(inout) :: file
      integer, intent(in) :: n
      character(len=*), intent(in) :: across, what
      real(wp), allocatable :: angle(:, :), values(:, :)
      complex(wp), allocatable :: parts(:)
      integer :: i, k
      call file%hdf5%last_samples('shaft_angle', n, angle)
      do i = 1, 2
         associate (name => across//'_'//'yz'(i:i))
            call file%hdf5%last_samples(name, n, values)
            call put(name//'_max', maxval(values, dim=2), 'm', 'highest displacement of the '//what)
            call put(name//'_min', minval(values, dim=2), 'm', 'lowest displacement of the '//what)
            call put(name//'_size', maxval(values, dim=2) - minval(values, dim=2), 'm', &
               & 'orbit of the '//what//', peak to peak')
            if (file%sampled_revolutions() < 1 - rounding) cycle
            parts = [(harmonic(angle(1, :), values(k, :), 1.0_wp), k=1, size(values, 1))]
            call put(name//'_amplitude', abs(parts), 'm', 'vibration of the '//what//' with its turning, amplitude')
            call put(name//'_phase', -atan2(parts%im, parts%re), 'rad', &
               & 'angle of the shaft by which its maximum comes after zero')
         end associate
      end do
   contains
      subroutine put(name, values, units, long_name)
         character(len=*), intent(in) :: name, units, long_name
         real(wp), intent(in) :: values(:)
         call put_figure(file, name, values, units, long_name, across)
      end subroutine put
   end subroutine put_whirls

   ! Wear of the pivots in the last revolution of a march or the period of an orbit, by Archard's law: the worn volume
   ! is the wear coefficient times the integral of the pivot load over the distance slid.

   !> The rates at which the pivots wear in the last samples, at these times, s: volume, and depth over the area of the
   !> contact under the mean pivot load. What LuGre's bristles give back is not slid.
   subroutine put_wear(file, bearing, time)
      type(bearing_file_type), intent(inout) :: file
      type(bearing_type), intent(in) :: bearing
      real(wp), intent(in) :: time(:)
      real(wp) :: steps(bearing%pad_count(), size(time) - 1)
      real(wp), allocatable :: load(:, :)
      real(wp), dimension(bearing%pad_count()) :: volume, depth
      class(contact_law_type), allocatable :: law
      type(contact_point) :: contact
      integer :: i
      call file%last_samples('pivot_load', size(time), load)
      steps = 0
      call add_steps('tilt', 'bristle_deflection')
      if (bearing%pitching()) call add_steps('pitch', 'bristle_deflection_pitch')
      if (bearing%yawing()) call add_steps('yaw', 'bristle_deflection_yaw')
      associate (pivot => bearing%pivot, lasted => time(size(time)) - time(1))
         do i = 1, size(volume)
            volume(i) = pivot%wear_coefficient*integral_over_way(steps(i, :), load(i, :))/lasted
            depth(i) = 0
            if (.not. volume(i) > 0) cycle
            call make_law(pivot, i, law)
            contact = law%at(law%pivot_deflection(sum(load(i, :))/size(time)))
            ! a spring or a measured law does not tell the radius
            depth(i) = ieee_value(0.0_wp, ieee_quiet_nan)
            if (contact%radius > 0) depth(i) = volume(i)/(pi*contact%radius**2)
         end do
      end associate
      call put_figure(file, 'pad_wear_rate', volume, 'm^3/s', 'worn volume of the pivot in a second')
      call put_figure(file, 'pad_wear_depth_rate', depth, 'm/s', 'depth worn off the pivot in a second')
   contains
      !> Adds, as one more direction, what a rotation slides between samples, m.
      subroutine add_steps(rotation, bristles)
         character(len=*), intent(in) :: rotation, bristles
         real(wp), allocatable :: way(:, :), deflection(:, :)
         call file%last_samples('pad_'//rotation, size(time), way)
         associate (pivot => bearing%pivot)
            way = spread(pivot%socket_radius - pivot%radius_difference, 2, size(time))*way
         end associate
         if (file%has_series(bristles)) then
            call file%last_samples(bristles, size(time), deflection)
            way = way - deflection
         end if
         steps = hypot(steps, way(:, 2:) - way(:, :size(time) - 1))
      end subroutine add_steps
   end subroutine put_wear
end module march_figures
