!> Figures of the stations of a shaft in a march or a periodic orbit, from its samples: of the last revolution.
module station_figures
   use kinds, only: wp
   use loops, only: harmonic
   use record, only: record_type
   use bearing_file, only: bearing_file_type
   use summary_group, only: put_figure
   implicit none (type, external)
   private
   public :: put_station_figures

   !> Part of a revolution that a whole one may lack by rounding.
   real(wp), parameter :: rounding = 1e-9_wp

contains

   !> Writes how far each station moves, and how much of it with the shaft; `bearing` is any of the bearings.
   subroutine put_station_figures(file, bearing)
      class(record_type), intent(inout) :: file
      type(bearing_file_type), intent(in) :: bearing
      real(wp), allocatable :: angle(:, :), values(:, :)
      integer :: n, i
      n = bearing%last_revolutions(1)
      call bearing%last_samples('shaft_angle', n, angle)
      do i = 1, 2
         associate (name => 'station_'//'yz'(i:i))
            call bearing%last_samples(name, n, values)
            call put(name//'_max', maxval(values, dim=2), 'm', 'highest displacement of the shaft')
            call put(name//'_min', minval(values, dim=2), 'm', 'lowest displacement of the shaft')
            call put(name//'_size', maxval(values, dim=2) - minval(values, dim=2), 'm', &
               & 'orbit of the shaft, peak to peak')
            if (bearing%sampled_revolutions() >= 1 - rounding) call put_vibration(name)
         end associate
      end do
   contains
      !> The vibration with the shaft.
      subroutine put_vibration(name)
         character(len=*), intent(in) :: name
         complex(wp) :: parts(size(values, 1))
         integer :: k
         parts = [(harmonic(angle(1, :), values(k, :), 1.0_wp), k=1, size(parts))]
         call put(name//'_amplitude', abs(parts), 'm', 'vibration of the shaft with its turning, amplitude')
         call put(name//'_phase', -atan2(parts%im, parts%re), 'rad', &
            & 'angle of the shaft by which its maximum comes after zero')
      end subroutine put_vibration

      subroutine put(name, values, units, long_name)
         character(len=*), intent(in) :: name, units, long_name
         real(wp), intent(in) :: values(:)
         call put_figure(file, name, values, units, long_name, 'station')
      end subroutine put
   end subroutine put_station_figures
end module station_figures
