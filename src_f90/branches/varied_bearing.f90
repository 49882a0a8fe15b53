!> A bearing with a number of its input as the parameter of a branch.
module varied_bearing
   use kinds, only: wp
   use errors, only: error_type
   use case_inputs, only: case_type
   use case_parameter, only: case_parameter_type
   use equations_of_motion, only: bearing_model
   implicit none (type, external)
   private
   public :: varied_bearing_type

   type :: varied_bearing_type
      type(bearing_model), pointer :: model => null()
      type(case_parameter_type) :: parameter
   contains
      procedure :: set_value
   end type varied_bearing_type

contains

   !> Gives the model another value; an error, with which the model is of this value all the same, where no valid case
   !> has it. `anew`, its films start so that what it answers does not depend on what it was asked before.
   subroutine set_value(self, value, anew, error)
      class(varied_bearing_type), intent(in) :: self
      real(wp), intent(in) :: value
      logical, intent(in) :: anew
      type(error_type), allocatable, intent(out) :: error
      type(case_type) :: inputs
      inputs = self%model%inputs
      call self%parameter%set(value, inputs, error)
      call self%model%adopt(inputs, anew)
   end subroutine set_value
end module varied_bearing
