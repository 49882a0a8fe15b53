!> A tiny test frame: counts checks, prints those that fail, and ends with "N passed, N failed".
module check
   use, intrinsic :: iso_fortran_env, only: error_unit
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: expect, expect_close, report

   integer :: passed = 0, failed = 0

contains

   !> A condition that must hold.
   subroutine expect(condition, what)
      logical, intent(in) :: condition
      character(len=*), intent(in) :: what
      if (condition) then
         passed = passed + 1
      else
         failed = failed + 1
         write (error_unit, '(a)') 'FAILED: '//what
      end if
   end subroutine expect

   !> |value - expected| <= tolerance.
   subroutine expect_close(value, expected, tolerance, what)
      real(wp), intent(in) :: value, expected, tolerance
      character(len=*), intent(in) :: what
      call expect(abs(value - expected) <= tolerance, what)
      if (.not. abs(value - expected) <= tolerance) write (error_unit, '(3(a,es23.15))') &
         & '   value ', value, ' expected ', expected, ' tolerance ', tolerance
   end subroutine expect_close

   !> The last line of every test program.
   subroutine report()
      print '(i0,a,i0,a)', passed, ' passed, ', failed, ' failed'
      if (failed > 0) error stop 1, quiet=.true.
   end subroutine report
end module check
