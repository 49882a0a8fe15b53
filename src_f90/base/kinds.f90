!> The working precision and the constants that go with it.
module kinds
   use, intrinsic :: iso_fortran_env, only: real64, int64
   implicit none (type, external)
   private
   public :: wp, i8, pi, degree, rpm

   integer, parameter :: wp = real64
   integer, parameter :: i8 = int64
   real(wp), parameter :: pi = acos(-1.0_wp)
   !> One degree in radians.
   real(wp), parameter :: degree = pi/180
   !> One revolution per minute in rad/s.
   real(wp), parameter :: rpm = pi/30
end module kinds
