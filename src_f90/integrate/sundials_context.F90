#include "sundials/sundials_config.h"
!> What differs between SUNDIALS 6 and 7: the context of its objects, its messages, the kind of its indices; and what a
!> failure of CVODE means.
module sundials_context
   use, intrinsic :: iso_c_binding, only: c_int, c_int32_t, c_int64_t, c_null_ptr, c_ptr
#if SUNDIALS_VERSION_MAJOR >= 7
   use fsundials_core_mod, only: fsuncontext_create, fsuncontext_free, fsuncontext_clearerrhandlers, &
      & sun_comm_null, n_vector, n_vector_ops, fn_vdestroy, sunmatrix, fsunmatdestroy, sunlinearsolver, &
      & sunlinearsolver_ops, sunlinearsolver_direct, fsunlinsolnewempty, fsunlinsolfreeempty, sunnonlinearsolver, &
      & sunnonlinearsolver_ops, sunnonlinearsolver_rootfind, fsunnonlinsolnewempty, fsunnonlinsolfreeempty, &
      & sun_nls_conv_recvr
#else
   use fsundials_context_mod, only: fsuncontext_create, fsuncontext_free
   use fsundials_nvector_mod, only: n_vector, n_vector_ops, fn_vdestroy
   use fsundials_matrix_mod, only: sunmatrix, fsunmatdestroy
   use fsundials_linearsolver_mod, only: sunlinearsolver, sunlinearsolver_ops, sunlinearsolver_direct, &
      & fsunlinsolnewempty, fsunlinsolfreeempty
   use fsundials_nonlinearsolver_mod, only: sunnonlinearsolver, sunnonlinearsolver_ops, sunnonlinearsolver_rootfind, &
      & fsunnonlinsolnewempty, fsunnonlinsolfreeempty, sun_nls_conv_recvr
   use fcvode_mod, only: fcvodeseterrfile
#endif
   use fcvode_mod, only: cv_err_failure, cv_conv_failure, cv_too_much_acc, cv_rhsfunc_fail, cv_first_rhsfunc_err, &
      & cv_reptd_rhsfunc_err, cv_unrec_rhsfunc_err, cv_lsetup_fail
   use text, only: to_text
   implicit none (type, external)
   private
   public :: index_kind, new_context, free_context, silence, cvode_failure
   public :: n_vector, n_vector_ops, fn_vdestroy, sunmatrix, fsunmatdestroy, sunlinearsolver, sunlinearsolver_ops, &
      & sunlinearsolver_direct, fsunlinsolnewempty, fsunlinsolfreeempty
   public :: sunnonlinearsolver, sunnonlinearsolver_ops, sunnonlinearsolver_rootfind, fsunnonlinsolnewempty, &
      & fsunnonlinsolfreeempty, sun_nls_conv_recvr

#ifdef SUNDIALS_INT32_T
   integer, parameter :: index_kind = c_int32_t
#else
   integer, parameter :: index_kind = c_int64_t
#endif

contains

   !> What all objects of one march belong to; no MPI.
   function new_context() result(context)
      type(c_ptr) :: context
      integer(c_int) :: flag
#if SUNDIALS_VERSION_MAJOR >= 7
      flag = fsuncontext_create(sun_comm_null, context)
#else
      flag = fsuncontext_create(c_null_ptr, context)
#endif
   end function new_context

   subroutine free_context(context)
      type(c_ptr), intent(inout) :: context
      integer(c_int) :: flag
      flag = fsuncontext_free(context)
   end subroutine free_context

   !> Keeps CVODE from printing: what it would say is told in our own error.
   subroutine silence(context, memory)
      type(c_ptr), intent(in) :: context, memory
      integer(c_int) :: flag
#if SUNDIALS_VERSION_MAJOR >= 7
      flag = fsuncontext_clearerrhandlers(context)
#else
      flag = fcvodeseterrfile(memory, c_null_ptr)
#endif
   end subroutine silence

   !> What a negative flag of CVODE means.
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
end module sundials_context
