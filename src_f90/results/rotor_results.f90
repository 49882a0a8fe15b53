!> What the file of a machine says of its whole rotor beside modes: whirl under the unbalance and shapes at the
!> stations, and the modes on synchronously reduced coefficients.
module rotor_results
   use kinds, only: wp
   use record, only: record_type
   use linear_bearing, only: bearing_coefficients_type
   use rotor_response, only: rotor_response_type
   use coefficient_results, only: put_mode_values
   implicit none (type, external)
   private
   public :: put_rotor_response

contains

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
      call file%put('modes/part_of_reduction', all_parts, '1', 'part of the damping of the mode that the ' &
         & //'reduction gives to high modes of the shaft (reduction%damp_above)', 'pivot mode')
   end subroutine put_parts

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
end module rotor_results
