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
      !> The value that the model was given last.
      real(wp), private :: value = -huge(1.0_wp)
   contains
      procedure :: set_value
   end type varied_bearing_type

contains

   !> Gives the model another value; an error, with which the model is of this value all the same, where no valid scene
   !> has it.
   subroutine set_value(self, value, error)
      class(varied_bearing_type), intent(inout) :: self
      real(wp), intent(in) :: value
      type(error_type), allocatable, intent(out) :: error
      type(scene_type) :: scene
      if (.not. abs(self%value - value) > 0) return
      scene = self%model%scene
      call self%parameter%set(value, scene, error)
      call self%model%adopt(scene)
      self%value = value
      if (allocated(error)) self%value = -huge(value)
   end subroutine set_value
end module varied_bearing
