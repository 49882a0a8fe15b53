!> The analysis of a case as the task coefficients makes it, for tests.
module linear_analysis
   use kinds, only: wp
   use errors, only: error_type
   use case_inputs, only: case_type
   use equations_of_motion, only: machine_model, new_machine_model
   use equilibrium, only: find_equilibrium, settle_equilibrium
   use equilibrium_record, only: equilibrium_type
   use static_model, only: make_fine
   use linear_bearing, only: bearing_coefficients_type, find_coefficients
   use stability_threshold, only: find_thresholds
   use check, only: expect_no_error
   implicit none (type, external)
   private
   public :: analyse

contains

   !> The coefficients of a case, its equilibrium of converged films, and the model at whose equilibrium y they are.
   subroutine analyse(inputs, what, found, static, fine, y)
      type(case_type), intent(in) :: inputs
      character(len=*), intent(in) :: what
      type(bearing_coefficients_type), intent(out) :: found
      type(equilibrium_type), intent(out), optional :: static
      type(machine_model), intent(out), optional :: fine
      real(wp), allocatable, intent(out), optional :: y(:)
      type(machine_model) :: model, converged
      type(equilibrium_type) :: own
      type(error_type), allocatable :: error
      real(wp), allocatable :: state(:)
      model = new_machine_model(inputs)
      call find_equilibrium(model, own, error)
      if (.not. allocated(error)) then
         model%oil = own%oil
         call make_fine(model, converged)
         call settle_equilibrium(converged, own, state, error)
      end if
      if (.not. allocated(error)) call find_coefficients(converged, state, found, error)
      if (.not. allocated(error) .and. inputs%coefficients%threshold_up_to_rpm > 0) then
         call find_thresholds(converged, state, found, error)
      end if
      call expect_no_error(error, what)
      if (present(static)) static = own
      if (present(fine)) fine = converged
      if (present(y)) y = state
   end subroutine analyse
end module linear_analysis
