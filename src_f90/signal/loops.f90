!> Key figures of periodic signals.
module loops
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: loop_area, peak_to_peak

contains

   !> Area of the closed loop through the points (x, y), positive when it runs clockwise, as the loop of
   !> a friction moment over the tilt does: then it is the work lost in a cycle. Trapezoidal rule.
   pure real(wp) function loop_area(x, y)
      real(wp), intent(in) :: x(:), y(:)
      loop_area = 0.5_wp*sum((cshift(x, 1) - x)*(cshift(y, 1) + y))
   end function loop_area

   pure real(wp) function peak_to_peak(x)
      real(wp), intent(in) :: x(:)
      peak_to_peak = maxval(x) - minval(x)
   end function peak_to_peak
end module loops
