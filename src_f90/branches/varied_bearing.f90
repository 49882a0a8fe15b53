!> A bearing with a number of its input as the parameter of a branch, and the viscosities of its warm oil for orbits:
!> those of the bearing in equilibrium at a value of the parameter, which a motion keeps.
module varied_bearing
   use kinds, only: wp
   use errors, only: error_type, add_context
   use case_inputs, only: case_type
   use case_parameter, only: case_parameter_type
   use heat_balance, only: oil_temperatures_type
   use thermal_equilibrium, only: solve_thermal_equilibrium
   use heat_balance_equations, only: state_balance_type, find_temperatures
   use equations_of_motion, only: bearing_model
   implicit none (type, external)
   private
   public :: varied_bearing_type, frozen_viscosity_type

   type :: varied_bearing_type
      type(bearing_model), pointer :: model => null()
      type(case_parameter_type) :: parameter
   contains
      procedure :: set_value
   end type varied_bearing_type

   !> A state in equilibrium and the viscosities there, Pa s, as numbers, at a value of the parameter; where its search
   !> began.
   type :: static_state_type
      real(wp) :: value = -huge(1.0_wp)
      real(wp), allocatable :: start(:), found(:)
   end type static_state_type

   type :: frozen_viscosity_type
      !> With a static model.
      type(varied_bearing_type) :: bearing
      !> What was found last, and before that.
      type(static_state_type), private :: known(2)
      type(state_balance_type), private :: balance
   contains
      procedure :: find
      procedure :: temperatures
   end type frozen_viscosity_type

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

   !> The equilibrium at a value of the parameter, sought from another; an error, without it, where the bearing does not
   !> come to rest or its heat has no balance.
   subroutine find(self, value, start, found, error)
      class(frozen_viscosity_type), intent(inout) :: self
      real(wp), intent(in) :: value, start(:)
      real(wp), intent(inout) :: found(:)
      type(error_type), allocatable, intent(out) :: error
      type(error_type), allocatable :: ignored
      real(wp) :: y(self%bearing%model%n), residual
      if (is_known(self%known(2))) self%known = self%known([2, 1])
      if (.not. is_known(self%known(1))) then
         ! who asks knows of himself whether the value is allowed
         call self%bearing%set_value(value, .true., ignored)
         associate (model => self%bearing%model)
            y = start(:size(y))
            model%oil%viscosity = start(size(y) + 1:)
            call solve_thermal_equilibrium(model, y, residual, error)
            call add_context(error, 'the oil takes the temperatures of the equilibrium')
            if (allocated(error)) return
            self%known(2) = self%known(1)
            self%known(1)%value = value
            self%known(1)%start = start
            self%known(1)%found = [y, model%oil%viscosity]
         end associate
      end if
      found = self%known(1)%found
   contains
      pure logical function is_known(state)
         type(static_state_type), intent(in) :: state
         is_known = abs(state%value - value) <= 0
         if (is_known) is_known = all(abs(state%start - start) <= 0)
      end function is_known
   end subroutine find

   !> Temperatures and viscosities, Pa s, that were found last.
   subroutine temperatures(self, oil, viscosity)
      class(frozen_viscosity_type), intent(inout) :: self
      type(oil_temperatures_type), intent(out) :: oil
      real(wp), allocatable, intent(out) :: viscosity(:)
      type(error_type), allocatable :: ignored
      call self%bearing%set_value(self%known(1)%value, .true., ignored)
      associate (model => self%bearing%model, found => self%known(1)%found)
         viscosity = found(model%n + 1:)
         model%oil%viscosity = viscosity
         call find_temperatures(model, found(:model%n), self%balance, oil)
      end associate
   end subroutine temperatures
end module varied_bearing
