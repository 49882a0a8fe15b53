!> The time on the wall.
module clock
   use kinds, only: wp, i8
   implicit none (type, external)
   private
   public :: wall_clock

contains

   !> Seconds since some moment.
   real(wp) function wall_clock()
      integer(i8) :: count, rate
      call system_clock(count, rate)
      wall_clock = real(count, wp)/real(rate, wp)
   end function wall_clock
end module clock
