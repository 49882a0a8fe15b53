!> What CVODE says when it does no further step.
module cvode_failures
   use, intrinsic :: iso_c_binding, only: c_int
   use fcvode_mod, only: cv_err_failure, cv_conv_failure, cv_too_much_acc, cv_rhsfunc_fail, cv_first_rhsfunc_err, &
      & cv_reptd_rhsfunc_err, cv_unrec_rhsfunc_err, cv_lsetup_fail
   use text, only: to_text
   implicit none (type, external)
   private
   public :: cvode_failure

contains

   !> What a negative flag means.
   pure function cvode_failure(flag) result(reason)
      integer(c_int), intent(in) :: flag
      character(len=:), allocatable :: reason
      select case (flag)
      case (cv_err_failure)
         reason = 'the error test kept failing'
      case (cv_conv_failure)
         reason = 'the Newton iteration kept failing'
      case (cv_too_much_acc)
         reason = 'the tolerances are finer than the machine can resolve'
      case (cv_rhsfunc_fail, cv_first_rhsfunc_err, cv_reptd_rhsfunc_err, cv_unrec_rhsfunc_err, cv_lsetup_fail)
         reason = 'the equations of motion could not be evaluated'
      case default
         reason = 'CVODE gave up with code '//to_text(int(flag))
      end select
   end function cvode_failure
end module cvode_failures
