!> The periodic orbits of a bearing as those of an ODE with a parameter. Warm oil keeps the viscosities of the bearing
!> in equilibrium, as in a march.
module bearing_orbits
   use kinds, only: wp, pi
   use errors, only: error_type
   use marching, only: march_options
   use cvode_integrator, only: integrator_type
   use orbit_polynomials, only: orbit_type
   use orbit_march, only: march_period, mesh_options
   use orbit_problem, only: parametric_ode_type
   use varied_bearing, only: varied_bearing_type, frozen_viscosity_type
   implicit none (type, external)
   private
   public :: bearing_orbits_type

   type, extends(parametric_ode_type) :: bearing_orbits_type
      type(varied_bearing_type) :: bearing
      !> Where the oil is warm.
      type(frozen_viscosity_type), allocatable :: oil
      !> How the motion is marched, for a mesh.
      type(march_options) :: march
   contains
      procedure :: set
      procedure :: new_mesh
   end type bearing_orbits_type

contains

   subroutine set(self, parameter, error)
      class(bearing_orbits_type), intent(inout) :: self
      real(wp), intent(in) :: parameter
      type(error_type), allocatable, intent(out) :: error
      type(error_type), allocatable :: oil_error
      associate (model => self%bearing%model)
         call self%bearing%set_value(parameter, .true., error)
         ! a revolution of the shaft
         self%period = 2*pi/model%point%speed(0.0_wp)
         if (.not. allocated(self%oil)) return
         call self%oil%find(parameter, self%start, self%found, oil_error)
         model%oil%viscosity = self%found(model%n + 1:)
      end associate
      if (.not. allocated(error)) call move_alloc(oil_error, error)
   end subroutine set

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
      options = mesh_options(self%march, self%period)
      marched%start = orbit%start
      call integrator%start(self%model, options, 0.0_wp, orbit%start, 2*length, error)
      do k = 0, 1
         if (.not. allocated(error)) call march_period(integrator, options, k, length, marched, error)
      end do
      if (.not. allocated(error)) mesh = marched%time/length
   end subroutine new_mesh
end module bearing_orbits
