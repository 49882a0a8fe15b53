!> Key figures of periodic signals.
module loops
   ! heap: arrays as long as a run
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: loop_area, periodicity, new_periodicity

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

   !> Area of the closed loop through the points (x, y), positive when it runs clockwise, as the loop of
   !> a friction moment over the tilt does: then it is the work lost in a cycle. Trapezoidal rule.
   pure real(wp) function loop_area(x, y)
      real(wp), intent(in) :: x(:), y(:)
      loop_area = 0.5_wp*sum((cshift(x, 1) - x)*(cshift(y, 1) + y))
   end function loop_area

   !> For so many signals, sampled so often in a revolution, of which so many whole revolutions have passed unseen.
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
