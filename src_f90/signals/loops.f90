!> Key figures of periodic signals.
module loops
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: path_integral, integral_over_way, harmonic, slow_share, periodicity, new_periodicity

   !> Compares each revolution of sampled signals with the one before.
   type :: periodicity
      private
      !> Last revolution (signal, sample); samples seen; largest difference in this revolution so far.
      real(wp), allocatable :: last(:, :)
      integer :: seen = 0
      real(wp) :: largest = 0
      !> Largest difference between the last two whole revolutions; huge before there are two.
      real(wp), public :: change = huge(1.0_wp)
   contains
      procedure :: add
   end type periodicity

contains

   !> Integral of y over x along the path through the points, by the trapezoidal rule. Of a closed loop, as that of a
   !> friction moment over the tilt, it is the area, positive when it runs clockwise: the work lost in a cycle.
   pure real(wp) function path_integral(x, y)
      real(wp), intent(in) :: x(:), y(:)
      integer :: n
      n = size(x)
      path_integral = 0.5_wp*sum((x(2:) - x(:n - 1))*(y(2:) + y(:n - 1)))
   end function path_integral

   !> Integral of y over a way of steps of these lengths between its values, by the trapezoidal rule.
   pure real(wp) function integral_over_way(steps, y)
      real(wp), intent(in) :: steps(:), y(:)
      integer :: n
      n = size(y)
      integral_over_way = 0.5_wp*sum(steps*(y(2:) + y(:n - 1)))
   end function integral_over_way

   !> The part of values that turns with the order: amplitude times exp(i phase). The values are the real part of it
   !> times exp(i order angle), their mean and others. The rising angles, rad, are whole turns of the order.
   pure complex(wp) function harmonic(angle, values, order)
      real(wp), intent(in) :: angle(:), values(:), order
      complex(wp) :: turning(size(angle))
      integer :: n
      n = size(angle)
      turning = values*exp(cmplx(0.0_wp, -order*angle, wp))
      harmonic = sum((angle(2:) - angle(:n - 1))*(turning(2:) + turning(:n - 1)))/(angle(n) - angle(1))
   end function harmonic

   !> Share of the time in which a velocity, straight between samples, stays within +-limit.
   pure real(wp) function slow_share(time, velocity, limit)
      real(wp), intent(in) :: time(:), velocity(:), limit
      real(wp) :: slow, ends(2)
      integer :: i
      slow = 0
      do i = 1, size(time) - 1
         associate (start => velocity(i), rise => velocity(i + 1) - velocity(i), step => time(i + 1) - time(i))
            if (abs(rise) > 0) then
               ends = ([-limit, limit] - start)/rise
               slow = slow + step*max(0.0_wp, min(1.0_wp, maxval(ends)) - max(0.0_wp, minval(ends)))
            else if (abs(start) < limit) then
               slow = slow + step
            end if
         end associate
      end do
      slow_share = slow/(time(size(time)) - time(1))
   end function slow_share

   !> For a number of signals, with a number of samples a revolution, after a number of whole revolutions that have
   !> passed unseen.
   pure function new_periodicity(samples, signals, passed) result(orbit)
      integer, intent(in) :: samples, signals, passed
      type(periodicity) :: orbit
      allocate (orbit%last(signals, 0:samples - 1), source=0.0_wp)
      orbit%seen = passed*samples
   end function new_periodicity

   !> The next sample of all signals.
   pure subroutine add(self, values)
      class(periodicity), intent(inout) :: self
      real(wp), intent(in) :: values(:)
      integer :: slot, samples
      samples = size(self%last, 2)
      slot = mod(self%seen, samples)
      if (slot == 0) self%largest = 0
      self%largest = max(self%largest, maxval(abs(values - self%last(:, slot))))
      self%last(:, slot) = values
      self%seen = self%seen + 1
      if (slot == samples - 1 .and. self%seen >= 2*samples) self%change = self%largest
   end subroutine add
end module loops
