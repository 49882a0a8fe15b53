!> What an orbit needs to know of an ODE beside its rates: the period that drives it; and for a branch of orbits the
!> model at a value of a parameter, and what its solver knows of meshes.
module parametric_ode
   use kinds, only: wp
   use errors, only: error_type
   use ode_model, only: ode_model_type
   use orbit_polynomials, only: orbit_type
   implicit none (type, external)
   private
   public :: parametric_ode_type

   !> As it is, that of a model without a parameter.
   type :: parametric_ode_type
      class(ode_model_type), pointer :: model => null()
      !> Of what drives the model as it is set, s.
      real(wp) :: period = 0
   contains
      procedure :: set
      procedure :: new_mesh
      procedure :: begin_here
      procedure :: get_start
      procedure :: set_start
   end type parametric_ode_type

contains

   !> Makes model and period those of a value of the parameter; an error says why there can be none.
   subroutine set(self, parameter, error)
      class(parametric_ode_type), intent(inout) :: self
      real(wp), intent(in) :: parameter
      type(error_type), allocatable, intent(out) :: error
   end subroutine set

   !> A mesh for an orbit near this one, as parts of its period, 0 to 1; not allocated where there is no better one.
   subroutine new_mesh(self, orbit, mesh)
      class(parametric_ode_type), intent(inout) :: self
      type(orbit_type), intent(in) :: orbit
      real(wp), allocatable, intent(out) :: mesh(:)
   end subroutine new_mesh

   !> Where the model at a value of the parameter is sought, not only set: what was found last is where searches begin
   !> from here on.
   pure subroutine begin_here(self)
      class(parametric_ode_type), intent(inout) :: self
   end subroutine begin_here

   !> Where these searches begin, as numbers.
   pure subroutine get_start(self, numbers)
      class(parametric_ode_type), intent(in) :: self
      real(wp), allocatable, intent(out) :: numbers(:)
      numbers = [real(wp) ::]
   end subroutine get_start

   !> Lets them begin there.
   pure subroutine set_start(self, numbers)
      class(parametric_ode_type), intent(inout) :: self
      real(wp), intent(in) :: numbers(:)
   end subroutine set_start
end module parametric_ode
