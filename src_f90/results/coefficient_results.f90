!> What the file of a run says of the coefficients of its bearing: names, dimensions and units as docs/results.md lists
!> them.
module coefficient_results
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use kinds, only: wp, pi
   use record, only: record_type
   use summary_group, only: put_figure
   use linear_bearing, only: bearing_coefficients_type
   implicit none (type, external)
   private
   public :: put_coefficients

   character(len=*), parameter :: of_journal = 'pivot frequency_ratio row column'
   character(len=*), parameter :: of_positions = 'position_row position_column', of_modes = 'pivot mode'

contains

   !> Writes coefficients at these whirl frequencies over the speed of the shaft, in a file with these positions.
   subroutine put_coefficients(file, found, ratios, positions)
      class(record_type), intent(inout) :: file
      type(bearing_coefficients_type), intent(in) :: found
      real(wp), intent(in) :: ratios(:)
      character(len=*), intent(in) :: positions(:)
      integer :: i
      call file%put_labels('pivot', found%bearings%pivot, 'how the pivots behave')
      call file%put_list('frequency_ratio', ratios, '1', 'whirl frequency over the speed of the shaft', &
         & 'frequency_ratio')
      call file%put_labels('row', ['y', 'z'], 'direction of the force on the journal')
      call file%put_labels('column', ['y', 'z'], 'direction of the displacement of the journal')
      call file%put_labels('position_row', positions, 'position whose force or moment it is')
      call file%put_labels('position_column', positions, 'position that is displaced')
      call file%put_list('mode', [(real(i, wp), i=1, 2*size(positions))], '1', 'mode number', 'mode')
      associate (counts => shape(found%stiffness(:, :, :, :, 1)))
         call file%put_array('coefficients/stiffness', [across(found%stiffness(:, :, :, :, 1))], counts, 'N/m', &
            & 'stiffness of the bearing at the journal, the pads condensed', of_journal)
         call file%put_array('coefficients/damping', [across(found%damping(:, :, :, :, 1))], counts, 'N s/m', &
            & 'damping of the bearing at the journal, the pads condensed', of_journal)
      end associate
      call put_full(file, found)
      call put_modes(file, found, 2*size(positions))
   end subroutine put_coefficients

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

   !> The matrices of all positions; those that do not move have no numbers.
   subroutine put_full(file, found)
      class(record_type), intent(inout) :: file
      type(bearing_coefficients_type), intent(in) :: found
      real(wp), allocatable, dimension(:, :, :) :: stiffness, damping
      integer :: i, k, n, pivots
      n = size(found%bearings(1)%moves)
      pivots = size(found%bearings)
      allocate (stiffness(n, n, pivots), damping(n, n, pivots), source=no_number())
      do i = 1, pivots
         associate (bearing => found%bearings(i), kept => pack([(k, k=1, n)], found%bearings(i)%moves))
            stiffness(kept, kept, i) = transpose(bearing%stiffness(kept, kept))
            damping(kept, kept, i) = transpose(bearing%damping(kept, kept))
         end associate
      end do
      ! their units are those of force or moment over those of displacement or tilt
      call file%put_array('coefficients/full_stiffness', [stiffness], [n, n, pivots], 'SI', &
         & 'derivatives of the negative forces (N) and moments (N m) over positions (m, rad)', 'pivot '//of_positions)
      call file%put_array('coefficients/full_damping', [damping], [n, n, pivots], 'SI', &
         & 'derivatives of the negative forces (N) and moments (N m) over rates (m/s, rad/s)', 'pivot '//of_positions)
      call file%put_array('coefficients/full_mass', [transpose(found%bearings(1)%mass)], [n, n], 'SI', &
         & 'masses of the pads: forces (N) and moments (N m) over accelerations (m/s^2, rad/s^2)', of_positions)
   end subroutine put_full

   !> The modes, filled up to n with what is no number.
   subroutine put_modes(file, found, n)
      class(record_type), intent(inout) :: file
      type(bearing_coefficients_type), intent(in) :: found
      integer, intent(in) :: n
      real(wp), dimension(n, size(found%modes)) :: re, im, frequency, ratio, decrement
      real(wp), dimension(n/2, n, size(found%modes)) :: shape_re, shape_im
      integer :: i
      re = no_number()
      im = no_number()
      frequency = no_number()
      ratio = no_number()
      decrement = no_number()
      shape_re = no_number()
      shape_im = no_number()
      do i = 1, size(found%modes)
         associate (modes => found%modes(i), last => size(found%modes(i)%eigenvalue))
            re(:last, i) = modes%eigenvalue%re
            im(:last, i) = modes%eigenvalue%im
            frequency(:last, i) = modes%eigenvalue%im/(2*pi)
            ratio(:last, i) = modes%damping_ratio
            decrement(:last, i) = modes%log_decrement
            shape_re(:, :last, i) = modes%shape%re
            shape_im(:, :last, i) = modes%shape%im
         end associate
      end do
      call file%put_table('modes/eigenvalue_real', re, '1/s', 'growth of the mode', of_modes)
      call file%put_table('modes/eigenvalue_imag', im, '1/s', 'angular frequency of the mode', of_modes)
      call file%put_table('modes/frequency', frequency, 'Hz', 'frequency of the mode', of_modes)
      ! those in vibration stand in the order of their damping
      call put_figure(file, 'least_damping_ratio', ratio(1, :), '1', 'least damping ratio of all modes', 'pivot')
      call file%put_table('modes/damping_ratio', ratio, '1', 'damping ratio of the mode', of_modes)
      call file%put_table('modes/log_decrement', decrement, '1', 'logarithmic decrement of the mode', of_modes)
      call file%put_array('modes/shape_real', [shape_re], shape(shape_re), 'SI', &
         & 'shape of the mode (m, rad), real part', of_modes//' position_row')
      call file%put_array('modes/shape_imag', [shape_im], shape(shape_im), 'SI', &
         & 'shape of the mode (m, rad), imaginary part', of_modes//' position_row')
      if (.not. allocated(found%thresholds)) return
      call file%put_list('modes/threshold_rpm', found%thresholds, 'rpm', 'speed at which stability changes', 'pivot')
      call file%put_real('modes/threshold_sought_rpm', found%sought_up_to, 'rpm', 'speed up to which it was sought')
   end subroutine put_modes

   real(wp) function no_number()
      no_number = ieee_value(1.0_wp, ieee_quiet_nan)
   end function no_number
end module coefficient_results
