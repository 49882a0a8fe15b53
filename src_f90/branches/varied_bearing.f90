!> A bearing with a number of its input as the parameter of a branch.
module varied_bearing
   use kinds, only: wp
   use errors, only: error_type
   use scene, only: scene_type
   use scene_parameter, only: scene_parameter_type
   use equations_of_motion, only: bearing_model
   implicit none (type, external)
   private
   public :: varied_bearing_type

   type :: varied_bearing_type
      type(bearing_model), pointer :: model => null()
      type(scene_parameter_type) :: parameter
   contains
      procedure :: set_value
   end type varied_bearing_type

contains

   !> Gives the model another value; an error, with which the model is of this value all the same, where no valid scene
   !> has it. Its films start anew, so that what it answers does not depend on what it was asked before.
   subroutine set_value(self, value, error)
      class(varied_bearing_type), intent(in) :: self
      real(wp), intent(in) :: value
      type(error_type), allocatable, intent(out) :: error
      type(scene_type) :: scene
      scene = self%model%scene
      call self%parameter%set(value, scene, error)
      call self%model%adopt(scene)
   end subroutine set_value
end module varied_bearing
