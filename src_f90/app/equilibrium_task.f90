!> The task 'equilibrium'.
module equilibrium_task
   use kinds, only: wp
   use errors, only: error_type
   use case_run, only: case_run_type
   use equilibrium_start, only: start_at_equilibrium
   implicit none (type, external)
   private
   public :: run_equilibrium

contains

   subroutine run_equilibrium(run, error)
      type(case_run_type), intent(inout) :: run
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: y(:)
      call start_at_equilibrium(run, y, error)
   end subroutine run_equilibrium
end module equilibrium_task
