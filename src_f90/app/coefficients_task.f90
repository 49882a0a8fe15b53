!> The task 'coefficients': the equilibrium, and stiffness, damping and stability there.
module coefficients_task
   use kinds, only: wp
   use errors, only: error_type, add_context, stopped
   use equilibrium, only: equilibrium_type
   use equations_of_motion, only: bearing_model
   use static_model, only: make_fine
   use bearing_coefficients, only: bearing_coefficients_type, settle, find_coefficients
   use stability_threshold, only: find_thresholds
   use coefficient_results, only: put_coefficients
   use stop_signals, only: stop_requested, stop_reason
   use case_run, only: case_run_type
   use equilibrium_start, only: seek_equilibrium, note_equilibrium
   use coefficients_summary, only: print_coefficients
   implicit none (type, external)
   private
   public :: run_coefficients

contains

   subroutine run_coefficients(run, error)
      type(case_run_type), intent(inout) :: run
      type(error_type), allocatable, intent(out) :: error
      type(bearing_model) :: fine
      type(equilibrium_type) :: static
      type(bearing_coefficients_type) :: found
      real(wp), allocatable :: y(:)
      call seek_equilibrium(run, static, error)
      if (allocated(error)) return
      call make_fine(run%model, fine)
      call settle(fine, static, y, error, stop_requested)
      if (.not. allocated(error)) then
         call note_equilibrium(run, static)
         call find_coefficients(fine, y, found, error)
      end if
      if (.not. allocated(error) .and. run%inputs%coefficients%threshold_up_to_rpm > 0) then
         call find_thresholds(fine, y, found, error, stop_requested)
      end if
      if (allocated(error)) then
         call add_context(error, 'with converged films')
         if (error%status == stopped) then
            ! nothing to go on from
            run%computed = .false.
            error%message = stop_reason()//' while the coefficients were calculated; nothing was written'
         end if
         return
      end if
      call put_coefficients(run%file%file, found, run%inputs%coefficients%frequency_ratio, &
         & run%model%layout%position_names())
      if (.not. run%quiet) call print_coefficients(found, run%inputs)
   end subroutine run_coefficients
end module coefficients_task
