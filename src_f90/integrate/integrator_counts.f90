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
   end type integrator_counts_type
end module integrator_counts
