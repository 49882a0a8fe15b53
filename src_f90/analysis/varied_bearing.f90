!> A bearing with a number of its input as the parameter of a branch; as an ODE with a parameter for its periodic
!> orbits.
module varied_bearing
   use kinds, only: wp, pi
   use errors, only: error_type
   use scene, only: scene_type
   use scene_parameter, only: scene_parameter_type
   use equations_of_motion, only: bearing_model
   use marching, only: march_options
   use cvode_integrator, only: integrator_type
   use orbit_polynomials, only: orbit_type
   use orbit_march, only: march_period, mesh_options
   use kink_mesh, only: kinks_of_friction => follow_kinks
   use parametric_ode, only: parametric_ode_type
   implicit none (type, external)
   private
   public :: varied_bearing_type, bearing_orbits_type

   type :: varied_bearing_type
      type(bearing_model), pointer :: model => null()
      type(scene_parameter_type) :: parameter
      !> The value that the model was given last.
      real(wp), private :: value = -huge(1.0_wp)
   contains
      procedure :: set_value
   end type varied_bearing_type

   type, extends(parametric_ode_type) :: bearing_orbits_type
      type(varied_bearing_type) :: bearing
      !> How the motion is marched, for a mesh.
      type(march_options) :: march
   contains
      procedure :: set
      procedure :: period
      procedure :: follow_kinks
      procedure :: new_mesh
   end type bearing_orbits_type

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

   subroutine set(self, parameter, error)
      class(bearing_orbits_type), intent(inout) :: self
      real(wp), intent(in) :: parameter
      type(error_type), allocatable, intent(out) :: error
      call self%bearing%set_value(parameter, error)
   end subroutine set

   !> A revolution of the shaft.
   pure real(wp) function period(self)
      class(bearing_orbits_type), intent(in) :: self
      period = 2*pi/self%bearing%model%point%speed(0.0_wp)
   end function period

   subroutine follow_kinks(self, orbit)
      class(bearing_orbits_type), intent(in) :: self
      type(orbit_type), intent(inout) :: orbit
      call kinks_of_friction(self%bearing%model, orbit)
   end subroutine follow_kinks

   !> The steps of a march over the second of two periods.
   subroutine new_mesh(self, orbit, mesh)
      class(bearing_orbits_type), intent(inout) :: self
      type(orbit_type), intent(in) :: orbit
      real(wp), allocatable, intent(out) :: mesh(:)
      type(integrator_type) :: integrator
      type(march_options) :: options
      type(orbit_type) :: marched
      type(error_type), allocatable :: error
      real(wp) :: length
      integer :: k
      length = orbit%time(orbit%intervals())
      options = mesh_options(self%march, self%period())
      marched%start = orbit%start
      associate (model => self%bearing%model)
         call integrator%start(model, options, 0.0_wp, orbit%start, 2*length, error)
         do k = 0, 1
            if (.not. allocated(error)) call march_period(integrator, options, model%n + model%outputs, k, length, &
               & marched, error)
         end do
      end associate
      if (.not. allocated(error)) mesh = marched%time/length
   end subroutine new_mesh
end module varied_bearing
