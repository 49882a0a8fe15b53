!> Figures of each of the last revolutions of a run, as many as the spectra may have, group `by_revolution`: the
!> states of journal and pads once a revolution (Poincare points), and their extremes in it. A motion that repeats
!> after k revolutions is k points.
module revolution_figures
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use kinds, only: wp, pi
   use bearing_file, only: bearing_file_type
   implicit none (type, external)
   private
   public :: put_revolutions

   character(len=*), parameter :: group = 'by_revolution/', over = 'revolution'
   !> Part of a revolution that a whole one may lack by rounding.
   real(wp), parameter :: rounding = 1e-9_wp

contains

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
      call file%put_list(over, [(real(k, wp), k=first - last, 0)], '1', &
         & 'revolutions before the last Poincare point', over)
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
            call file%put_table(group//name, values, units, long_name, over//' pad')
         else
            call file%put_list(group//name, values(1, :), units, long_name, over)
         end if
      end subroutine put_values
   end subroutine put_revolutions

   !> Values (:, time) where the rising angle has the value wanted, by the cubic through the four nearest samples.
   pure function at_angle(angle, values, wanted) result(found)
      real(wp), intent(in) :: angle(:), values(:, :), wanted
      real(wp) :: found(size(values, 1)), weight
      integer :: number, first, i, j
      number = min(4, size(angle))
      first = count(angle < wanted) - number/2 + 1
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
         start = 1 + count(angle < angle(n) - 2*pi*k - rounding)
         lowest(:, column) = minval(values(:, start:next - 1), dim=2)
         highest(:, column) = maxval(values(:, start:next - 1), dim=2)
         next = start
      end do
   end subroutine find_extremes
end module revolution_figures
