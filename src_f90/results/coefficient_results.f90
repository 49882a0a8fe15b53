!> What the file of a run says of coefficients and modes: names, dimensions and units as docs/results.md lists them.
module coefficient_results
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use kinds, only: wp, pi, rpm
   use record, only: record_type
   use summary_group, only: put_figure
   use force_balance, only: mode_name_length, is_of_rotor
   use state_layout, only: element_layout_type
   use threshold_cycle, only: threshold_cycle_type
   use linear_bearing, only: bearing_coefficients_type, vibration_modes_type
   use rotor_response, only: rotor_response_type
   use stability_levels, only: stability_levels_type, matrices
   implicit none (type, external)
   private
   public :: put_coefficients, put_one_sided, put_modes, put_shapes, put_thresholds, put_births, put_rotor_response, &
      & put_stability_levels

   character(len=*), parameter :: of_journal = 'pivot frequency_ratio row column'
   character(len=*), parameter :: of_slopes = 'pivot frequency_ratio slope_row slope_column', &
      & slopes(4) = [character(len=7) :: 'y', 'z', 'slope_y', 'slope_z']
   character(len=*), parameter :: of_positions = 'position_row position_column', of_modes = 'pivot mode'

contains

   !> Writes the coefficients of bearing b at these whirl frequencies over the speed of the shaft, and the matrices of
   !> its journal and pads.
   subroutine put_coefficients(file, found, layout, positions, b, ratios)
      class(record_type), intent(inout) :: file
      type(bearing_coefficients_type), intent(in) :: found
      type(element_layout_type), intent(in) :: layout
      !> Names of the displacements of its journal and pads.
      character(len=*), intent(in) :: positions(:)
      integer, intent(in) :: b
      real(wp), intent(in) :: ratios(:)
      call file%put('pivot', found%bearings%pivot, 'how the pivots behave')
      call file%put('frequency_ratio', ratios, '1', 'whirl frequency over the speed of the shaft', 'frequency_ratio')
      call file%put('row', ['y', 'z'], 'direction of the force on the journal')
      call file%put('column', ['y', 'z'], 'direction of the displacement of the journal')
      call file%put('position_row', positions, 'position whose force or moment it is')
      call file%put('position_column', positions, 'position that is displaced')
      call file%put_scale('mode', 2*size(found%bearings(1)%moves), 'mode number')
      call file%put('coefficients/stiffness', across(found%stiffness(:, :, :, :, b)), 'N/m', &
         & 'stiffness of the bearing at the journal, the pads condensed', of_journal)
      call file%put('coefficients/damping', across(found%damping(:, :, :, :, b)), 'N s/m', &
         & 'damping of the bearing at the journal, the pads condensed', of_journal)
      call put_full(file, found, layout%all_positions())
      if (.not. allocated(found%slope_stiffness)) return
      call file%put('slope_row', slopes, 'force or moment on the journal')
      call file%put('slope_column', slopes, 'displacement or slope of the journal')
      call file%put('coefficients/slope_stiffness', across(found%slope_stiffness(:, :, :, :, b)), 'SI', 'stiffness ' &
         & //'over displacements (m) and slopes (rad) of the journal: forces (N) and moments (N m)', of_slopes)
      call file%put('coefficients/slope_damping', across(found%slope_damping(:, :, :, :, b)), 'SI', 'damping over ' &
         & //'the rates of displacements (m/s) and slopes (rad/s) of the journal', of_slopes)
   end subroutine put_coefficients

   !> Pads whose film only just begins to carry.
   subroutine put_one_sided(file, begins)
      class(record_type), intent(inout) :: file
      logical, intent(in) :: begins(:)
      call file%put('coefficients/one_sided', merge(1.0_wp, 0.0_wp, begins), '1', &
         & '1 where the film only just begins to carry: its stiffness and damping hang on the side', 'pad')
   end subroutine put_one_sided

   !> Rows after columns, as files have them.
   pure function across(matrices)
      real(wp), intent(in) :: matrices(:, :, :, :)
      real(wp) :: across(size(matrices, 2), size(matrices, 1), size(matrices, 3), size(matrices, 4))
      integer :: i, k
      do i = 1, size(matrices, 4)
         do k = 1, size(matrices, 3)
            across(:, :, k, i) = transpose(matrices(:, :, k, i))
         end do
      end do
   end function across

   !> The matrices of the positions at these places; those that do not move have no numbers.
   subroutine put_full(file, found, places)
      class(record_type), intent(inout) :: file
      type(bearing_coefficients_type), intent(in) :: found
      integer, intent(in) :: places(:)
      real(wp), allocatable, dimension(:, :, :) :: stiffness, damping
      integer :: i, k, n, pivots
      n = size(places)
      pivots = size(found%bearings)
      allocate (stiffness(n, n, pivots), damping(n, n, pivots), source=no_number())
      do i = 1, pivots
         associate (bearing => found%bearings(i), kept => pack([(k, k=1, n)], found%bearings(i)%moves(places)))
            stiffness(kept, kept, i) = transpose(bearing%stiffness(places(kept), places(kept)))
            damping(kept, kept, i) = transpose(bearing%damping(places(kept), places(kept)))
         end associate
      end do
      ! their units are those of force or moment over those of displacement or tilt
      call file%put('coefficients/full_stiffness', stiffness, 'SI', &
         & 'derivatives of the negative forces (N) and moments (N m) over positions (m, rad)', 'pivot '//of_positions)
      call file%put('coefficients/full_damping', damping, 'SI', &
         & 'derivatives of the negative forces (N) and moments (N m) over rates (m/s, rad/s)', 'pivot '//of_positions)
      call file%put('coefficients/full_mass', transpose(found%bearings(1)%mass(places, places)), 'SI', &
         & 'masses of the pads: forces (N) and moments (N m) over accelerations (m/s^2, rad/s^2)', of_positions)
   end subroutine put_full

   !> The names and eigenvalues of the modes of rotor and pads, and the least damping ratios: of all, of the rotor
   !> and of the pads, without high modes that a march damps.
   subroutine put_modes(file, found, of_reduction)
      class(record_type), intent(inout) :: file
      type(bearing_coefficients_type), intent(in) :: found
      !> Whether the damping of a mode in a march is that of the reduction, (mode, pivot).
      logical, intent(in) :: of_reduction(:, :)
      real(wp) :: least(3, size(found%modes))
      character(len=mode_name_length), allocatable :: names(:, :)
      integer :: i
      call put_mode_values(file, 'modes', of_modes, found%modes, 2*size(found%bearings(1)%moves))
      allocate (names(2*size(found%bearings(1)%moves), size(found%modes)))
      names = ''
      do i = 1, size(found%modes)
         names(:size(found%modes(i)%name), i) = found%modes(i)%name
      end do
      call file%put('modes/name', [names], 'what moves in the mode', shape(names), of_modes)
      do i = 1, size(found%modes)
         associate (ratio => found%modes(i)%damping_ratio, of_rotor => is_of_rotor(found%modes(i)%name))
            least(1, i) = least_of(ratio, of_rotor .and. .not. of_reduction(:size(ratio), i))
            least(2, i) = least_of(ratio, .not. of_rotor)
            least(3, i) = least_of(ratio, .not. of_reduction(:size(ratio), i))
         end associate
      end do
      call put_figure(file, 'least_damping_ratio', least(3, :), '1', 'least damping ratio of all modes', 'pivot')
      call put_figure(file, 'rotor_damping_ratio', least(1, :), '1', 'least damping ratio of journal or shaft', 'pivot')
      call put_figure(file, 'pads_damping_ratio', least(2, :), '1', 'least damping ratio of the pads', 'pivot')
   end subroutine put_modes

   !> The least of some values; no number where there are none.
   real(wp) function least_of(values, mask)
      real(wp), intent(in) :: values(:)
      logical, intent(in) :: mask(:)
      least_of = no_number()
      if (any(mask)) least_of = minval(values, mask=mask)
   end function least_of

   !> Eigenvalues of modes in a group over these scales, filled up to n modes with what is no number.
   subroutine put_mode_values(file, group, scales, all_modes, n)
      class(record_type), intent(inout) :: file
      character(len=*), intent(in) :: group, scales
      type(vibration_modes_type), intent(in) :: all_modes(:)
      integer, intent(in) :: n
      real(wp) :: values(n, size(all_modes), 5)
      integer :: i
      values = no_number()
      do i = 1, size(all_modes)
         associate (modes => all_modes(i), last => size(all_modes(i)%eigenvalue))
            values(:last, i, 1) = modes%eigenvalue%re
            values(:last, i, 2) = modes%eigenvalue%im
            values(:last, i, 3) = modes%eigenvalue%im/(2*pi)
            values(:last, i, 4) = modes%damping_ratio
            values(:last, i, 5) = modes%log_decrement
         end associate
      end do
      call file%put(group//'/eigenvalue_real', values(:, :, 1), '1/s', 'growth of the mode', scales)
      call file%put(group//'/eigenvalue_imag', values(:, :, 2), '1/s', 'angular frequency of the mode', scales)
      call file%put(group//'/frequency', values(:, :, 3), 'Hz', 'frequency of the mode', scales)
      call file%put(group//'/damping_ratio', values(:, :, 4), '1', 'damping ratio of the mode', scales)
      call file%put(group//'/log_decrement', values(:, :, 5), '1', 'logarithmic decrement of the mode', scales)
   end subroutine put_mode_values

   !> The shapes of the modes at the places of a bearing's journal and pads.
   subroutine put_shapes(file, found, layout)
      class(record_type), intent(inout) :: file
      type(bearing_coefficients_type), intent(in) :: found
      type(element_layout_type), intent(in) :: layout
      real(wp), allocatable, dimension(:, :, :) :: re, im
      integer, allocatable :: places(:)
      integer :: i, n
      places = layout%all_positions()
      n = 2*size(found%bearings(1)%moves)
      allocate (re(size(places), n, size(found%modes)), source=no_number())
      im = re
      do i = 1, size(found%modes)
         associate (shapes => found%modes(i)%shape, last => size(found%modes(i)%shape, 2))
            re(:, :last, i) = shapes(places, :)%re
            im(:, :last, i) = shapes(places, :)%im
         end associate
      end do
      call file%put('modes/shape_real', re, 'SI', 'shape of the mode (m, rad), real part', of_modes//' position_row')
      call file%put('modes/shape_imag', im, 'SI', 'shape of the mode (m, rad), imaginary part', &
         & of_modes//' position_row')
   end subroutine put_shapes

   !> Threshold speeds of stability, where they were sought.
   subroutine put_thresholds(file, found)
      class(record_type), intent(inout) :: file
      type(bearing_coefficients_type), intent(in) :: found
      if (.not. allocated(found%thresholds)) return
      call file%put('modes/threshold_rpm', found%thresholds, 'rpm', 'speed at which stability changes', 'pivot')
      call file%put('modes/threshold_sought_rpm', found%sought_up_to, 'rpm', 'speed up to which it was sought')
   end subroutine put_thresholds

   !> What the limit cycles do that begin at a threshold speed.
   subroutine put_births(file, found)
      class(record_type), intent(inout) :: file
      type(threshold_cycle_type), intent(in) :: found
      call file%put('modes/threshold_hopf_rpm', found%threshold, 'rpm', 'speed at which limit cycles begin')
      call file%put('modes/threshold_born', sign(1.0_wp, found%next - found%threshold), '1', '1 where they are born ' &
         & //'towards higher speeds, -1 towards lower ones')
      call file%put('modes/threshold_lowest_rpm', found%lowest, 'rpm', 'lowest speed with a limit cycle')
      call file%put('modes/threshold_cycle_y', found%amplitude(1), 'm', 'its amplitude, vertical')
      call file%put('modes/threshold_cycle_z', found%amplitude(2), 'm', 'its amplitude, horizontal')
   end subroutine put_births

   real(wp) function no_number()
      no_number = ieee_value(1.0_wp, ieee_quiet_nan)
   end function no_number

   ! Of a machine the whole rotor beside modes: whirl under the unbalance and shapes at the stations, and the modes on
   ! synchronously reduced coefficients.

   !> Writes the response of a rotor whose coefficients and modes were written; it turns in the sense 1, clockwise,
   !> or -1.
   subroutine put_rotor_response(file, coefficients, found, sense)
      class(record_type), intent(inout) :: file
      type(bearing_coefficients_type), intent(in) :: coefficients
      type(rotor_response_type), intent(in) :: found
      real(wp), intent(in) :: sense
      integer :: i, n
      call file%put('pivot', coefficients%bearings%pivot, 'how the pivots behave')
      call file%put_scale('mode', 2*size(coefficients%bearings(1)%moves), 'mode number')
      call file%put_scale('station', size(found%unbalance, 2), 'station of the shaft')
      call put_complex('response/y', found%unbalance(1, :, :), 'whirl of the station under the unbalance, y = ' &
         & //'Re(this times exp(i shaft angle))')
      call put_complex('response/z', found%unbalance(2, :, :), 'the same of z')
      call file%put('response/amplitude', amplitude(found%unbalance), 'm', 'major semi-axis of the whirl of ' &
         & //'the station under the unbalance', 'pivot station')
      call put_parts(file, found%of_reduction, 2*size(coefficients%bearings(1)%moves))
      call put_of_elements(file, found%of_elements, 2*size(coefficients%bearings(1)%moves))
      call put_station_shapes(file, found%shapes, 2*size(coefficients%bearings(1)%moves), sense)
      n = maxval([(size(found%synchronous(i)%eigenvalue), i=1, size(found%synchronous))])
      call file%put_scale('synchronous_mode', n, 'mode number')
      call put_mode_values(file, 'synchronous', 'pivot synchronous_mode', found%synchronous, n)

   contains

      subroutine put_complex(name, values, meaning)
         character(len=*), intent(in) :: name, meaning
         complex(wp), intent(in) :: values(:, :)
         call file%put(name//'_real', real(values, wp), 'm', meaning//', real part', 'pivot station')
         call file%put(name//'_imag', aimag(values), 'm', meaning//', imaginary part', 'pivot station')
      end subroutine put_complex
   end subroutine put_rotor_response

   !> Parts of the damping of the modes that are the reduction's; n modes.
   subroutine put_parts(file, parts, n)
      class(record_type), intent(inout) :: file
      real(wp), intent(in) :: parts(:, :)
      integer, intent(in) :: n
      real(wp) :: all_parts(n, size(parts, 2))
      all_parts = 0
      all_parts(:size(parts, 1), :) = parts
      call file%put('modes/part_of_reduction', all_parts, '1', 'part of the damping of the mode in a ' &
         & //'march that the reduction gives to high modes of the shaft (reduction%damp_above)', 'pivot mode')
   end subroutine put_parts

   !> What elements add to the decrements of n modes, (element, mode, pivot).
   subroutine put_of_elements(file, parts, n)
      class(record_type), intent(inout) :: file
      real(wp), intent(in) :: parts(:, :, :)
      integer, intent(in) :: n
      real(wp) :: all_parts(size(parts, 1), n, size(parts, 3))
      if (size(parts, 1) == 0) return
      all_parts = no_number()
      all_parts(:, :size(parts, 2), :) = parts
      call file%put('modes/element_decrement', all_parts, '1', 'what the element adds to the logarithmic decrement ' &
         & //'of the mode', 'pivot mode element')
   end subroutine put_of_elements

   !> Major semi-axes of ellipses (y, z): the sum of the circles that turn forward and backward.
   pure function amplitude(whirl)
      complex(wp), intent(in) :: whirl(:, :, :)
      real(wp) :: amplitude(size(whirl, 2), size(whirl, 3))
      amplitude = (abs(whirl(1, :, :) + (0, 1)*whirl(2, :, :)) + abs(whirl(1, :, :) - (0, 1)*whirl(2, :, :)))/2
   end function amplitude

   !> Stations in the modes, and whether these whirl forward; n modes.
   subroutine put_station_shapes(file, shapes, n, sense)
      class(record_type), intent(inout) :: file
      complex(wp), intent(in) :: shapes(:, :, :, :)
      integer, intent(in) :: n
      real(wp), intent(in) :: sense
      complex(wp) :: all_shapes(2, size(shapes, 2), n, size(shapes, 4))
      real(wp), dimension(n, size(shapes, 4)) :: forward, backward
      character(len=*), parameter :: direction(2) = ['y', 'z']
      integer :: i
      all_shapes = 0
      all_shapes(:, :, :size(shapes, 3), :) = shapes
      do i = 1, 2
         associate (name => 'modes/station_'//direction(i), along => 'displacement of the station in the mode along ' &
            & //direction(i))
            call file%put(name//'_real', real(all_shapes(i, :, :, :), wp), 'm', along//', real part', &
               & 'pivot mode station')
            call file%put(name//'_imag', aimag(all_shapes(i, :, :, :)), 'm', along//', imaginary part', &
               & 'pivot mode station')
         end associate
      end do
      forward = sum(abs(all_shapes(1, :, :, :) + (0, 1)*all_shapes(2, :, :, :))**2, 1)
      backward = sum(abs(all_shapes(1, :, :, :) - (0, 1)*all_shapes(2, :, :, :))**2, 1)
      call file%put('modes/whirl', sense*(forward - backward)/max(forward + backward, tiny(1.0_wp)), '1', &
         & 'sense of the whirl of the stations: 1 forward, -1 backward', 'pivot mode')
   end subroutine put_station_shapes

   !> Writes the stability under cross-coupled stiffness of a rotor whose response was written.
   subroutine put_stability_levels(file, found)
      class(record_type), intent(inout) :: file
      type(stability_levels_type), intent(in) :: found
      character(len=*), parameter :: group = 'stability/', over = 'pivot '//group//'matrices '//group//'cross_stiffness'
      character(len=*), parameter :: of_mode = 'of the first forward mode'
      call file%put(group//'matrices', matrices, 'how bearings act in the mode')
      call file%put(group//'cross_stiffness', found%cross_stiffness, 'N/m', 'cross-coupled stiffness Q', &
         & group//'cross_stiffness')
      call file%put(group//'eigenvalue_real', real(found%eigenvalue, wp), '1/s', 'growth '//of_mode, over)
      call file%put(group//'eigenvalue_imag', aimag(found%eigenvalue), '1/s', 'angular frequency '//of_mode, &
         & over)
      call file%put(group//'log_decrement', -2*pi*real(found%eigenvalue, wp)/aimag(found%eigenvalue), '1', &
         & 'logarithmic decrement '//of_mode, over)
      call file%put(group//'zero_cross_stiffness', found%zero, 'N/m', 'Q_0, where the logarithmic decrement '//of_mode &
         & //' is 0', 'pivot '//group//'matrices')
      call file%put_scale(group//'impeller', size(found%impellers), 'impeller number')
      call file%put(group//'impeller_cross_stiffness', found%impellers, 'N/m', 'anticipated of the impeller', &
         & group//'impeller')
      call file%put(group//'anticipated_cross_stiffness', found%anticipated, 'N/m', 'Q_A, their sum')
      call file%put(group//'cross_station', real(found%station, wp), '1', 'station where Q acts; 0: at the impellers')
      call file%put(group//'mean_density', found%density, 'kg/m^3', 'mean density of the gas')
      if (size(found%rigid) == 0) return
      call file%put_scale(group//'critical_speed', size(found%rigid), 'number of the critical speed')
      call file%put(group//'bearing_stiffness', found%bearing_stiffness, 'N/m', 'stiffness of each bearing', &
         & group//'bearing_stiffness')
      call file%put(group//'undamped_rpm', found%critical/rpm, 'rpm', 'undamped forward critical speed', &
         & group//'bearing_stiffness '//group//'critical_speed')
      call file%put(group//'rigid_rpm', found%rigid/rpm, 'rpm', 'undamped forward critical speed on rigid bearings', &
         & group//'critical_speed')
   end subroutine put_stability_levels
end module coefficient_results
