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

   !> Its values are the logarithms over those of the viscosities with which it began, Pa s.
   type, extends(coupled_field) :: oil_field_type
      real(wp), allocatable :: first(:)
      !> Where grooves and shaft keep their temperatures: these, of each bearing.
      type(oil_temperatures_type), allocatable :: kept(:)
      !> Of the last state.
      type(state_balance_type) :: balance
   contains
      procedure :: begin
      procedure :: apply
      procedure :: find_wanted
      procedure :: check
   end type oil_field_type

   !> Residual of the logarithms of viscosities; the same where temperatures along and across the films follow, which
   !> are changed by ten times as much; where it jumps; longest step.
   real(wp), parameter :: agreement = 1e-8_wp, rough = 1e-2_wp, jump = 1e-4_wp, longest = 1

contains

   !> Begins with the viscosities of a model, and with temperatures of grooves and shaft that are kept, if some are.
   subroutine begin(self, model, kept)
      class(oil_field_type), intent(inout) :: self
      type(machine_model), intent(in) :: model
      type(oil_temperatures_type), intent(in), optional :: kept(:)
      self%agreement = merge(rough, agreement, model%inputs%thermal%model == 'film')
      self%jump = jump
      self%longest = longest
      self%parts = model%layout%pads
      self%first = model%oil%viscosity
      self%values = 0*self%first
      if (present(kept)) self%kept = kept
   end subroutine begin

   subroutine apply(self, model)
      class(oil_field_type), intent(inout) :: self
      type(machine_model), intent(inout) :: model
      model%oil%viscosity = self%first*exp(self%values)
   end subroutine apply

   subroutine find_wanted(self, model, y, wanted, error)
      class(oil_field_type), intent(inout) :: self
      type(machine_model), intent(inout) :: model
      real(wp), intent(in) :: y(:)
      real(wp), intent(out) :: wanted(:)
      type(error_type), allocatable, intent(out) :: error
      call find_residual(model, y, self%balance, self%kept)
      wanted = self%values + self%balance%residual
   end subroutine find_wanted

   !> Refuses heat that has no balance, oil that boils, and viscosities that do not settle.
   subroutine check(self, model, agrees, error)
      class(oil_field_type), intent(in) :: self
      type(machine_model), intent(in) :: model
      logical, intent(in) :: agrees
      type(error_type), allocatable, intent(out) :: error
      call check_heat(model, self%balance, error, self%kept)
      if (.not. (allocated(error) .or. agrees)) call raise(error, numerics_error, 'the temperatures of the oil do ' &
         & //'not settle: after '//to_text(most_rounds)//' rounds its viscosity still changes by ' &
         & //to_text(100*maxval(abs(self%balance%residual)))//' %')
   end subroutine check
end module oil_field
