!> A piecewise linear logarithm: intervals that follow the magnitude of a positive number.
!>
!> An octave, from one power of 2 to the next, is cut into 2^level equal intervals, and these are numbered through over
!> all octaves. The bits of a number give its interval; within one, everything is linear in the number itself, so that
!> neither logarithm nor power is ever needed.
module logarithmic_grid
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: interval, lower_end

contains

   !> The interval of a number > 0 at a level.
   elemental integer function interval(x, level)
      real(wp), intent(in) :: x
      integer, intent(in) :: level
      interval = ishft(exponent(x), level) + int(scale(2*fraction(x) - 1, level))
   end function interval

   !> The lower end of an interval of a level; it belongs to the interval, the upper end to the next.
   elemental real(wp) function lower_end(interval, level)
      integer, intent(in) :: interval, level
      integer :: pieces
      pieces = 2**level
      lower_end = scale(1 + modulo(interval, pieces)/real(pieces, wp), floor(interval/real(pieces, wp)) - 1)
   end function lower_end
end module logarithmic_grid
