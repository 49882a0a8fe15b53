!> What an integration cost.
module integrator_counts
   use kinds, only: i8
   implicit none (type, external)
   private
   public :: integrator_counts_type

   type :: integrator_counts_type
      integer(i8) :: steps = 0, rhs_evaluations = 0, jacobian_evaluations = 0
      !> Steps that the error test refused; Newton iterations that failed.
      integer(i8) :: error_test_failures = 0, convergence_failures = 0
   contains
      procedure, private :: plus
      generic :: operator(+) => plus
   end type integrator_counts_type

contains

   !> What two integrations cost, one after the other.
   elemental type(integrator_counts_type) function plus(self, other)
      class(integrator_counts_type), intent(in) :: self, other
      plus%steps = self%steps + other%steps
      plus%rhs_evaluations = self%rhs_evaluations + other%rhs_evaluations
      plus%jacobian_evaluations = self%jacobian_evaluations + other%jacobian_evaluations
      plus%error_test_failures = self%error_test_failures + other%error_test_failures
      plus%convergence_failures = self%convergence_failures + other%convergence_failures
   end function plus
end module integrator_counts
