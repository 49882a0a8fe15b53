!> The oil of pads as a coupled field: the logarithms of the viscosities of their films, for which the heat balance of
!> losses and flows wants others.
module oil_field
   use kinds, only: wp
   use text, only: to_text
   use errors, only: error_type, raise, numerics_error
   use heat_balance, only: oil_temperatures_type
   use equations_of_motion, only: machine_model
   use heat_balance_equations, only: state_balance_type, find_residual, check_heat
   use fixed_point, only: coupled_field, most_rounds
   implicit none (type, external)
   private
   public :: oil_field_type

   type, extends(coupled_field) :: oil_field_type
      real(wp), allocatable :: logarithm(:)
      !> Where grooves and shaft keep their temperatures: these, of each bearing.
      type(oil_temperatures_type), allocatable :: kept(:)
      !> Of the last state.
      type(state_balance_type) :: balance
   contains
      procedure :: get
      procedure :: set
      procedure :: find_wanted
      procedure :: check
      procedure :: refuse
   end type oil_field_type

contains

   pure function get(self) result(values)
      class(oil_field_type), intent(in) :: self
      real(wp), allocatable :: values(:)
      values = self%logarithm
   end function get

   subroutine set(self, values, model)
      class(oil_field_type), intent(inout) :: self
      real(wp), intent(in) :: values(:)
      type(machine_model), intent(inout) :: model
      self%logarithm = values
      model%oil%viscosity = exp(values)
   end subroutine set

   subroutine find_wanted(self, model, y, wanted, error)
      class(oil_field_type), intent(inout) :: self
      type(machine_model), intent(inout) :: model
      real(wp), intent(in) :: y(:)
      real(wp), intent(out) :: wanted(:)
      type(error_type), allocatable, intent(out) :: error
      call find_residual(model, y, self%balance, self%kept)
      wanted = self%logarithm + self%balance%residual
   end subroutine find_wanted

   !> Refuses heat that has no balance, and oil that boils.
   subroutine check(self, model, error)
      class(oil_field_type), intent(in) :: self
      type(machine_model), intent(in) :: model
      type(error_type), allocatable, intent(out) :: error
      call check_heat(model, self%balance, error, self%kept)
   end subroutine check

   subroutine refuse(self, model, error)
      class(oil_field_type), intent(in) :: self
      type(machine_model), intent(in) :: model
      type(error_type), allocatable, intent(out) :: error
      call check_heat(model, self%balance, error, self%kept)
      if (.not. allocated(error)) call raise(error, numerics_error, 'the temperatures of the oil do not settle: after ' &
         & //to_text(most_rounds)//' rounds its viscosity still changes by ' &
         & //to_text(100*maxval(abs(self%balance%residual)))//' %')
   end subroutine refuse
end module oil_field
