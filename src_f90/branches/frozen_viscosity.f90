!> The viscosities of warm oil for orbits over a parameter: those of the bearing in equilibrium at a value of it, which
!> a motion keeps. All searches around a point of a branch begin at the same equilibrium, so that what they find is
!> smooth over the parameter, and the same again where a branch is taken up.
module frozen_viscosity
   use kinds, only: wp
   use errors, only: error_type, add_context
   use heat_balance, only: oil_temperatures_type
   use thermal_equilibrium, only: solve_thermal_equilibrium
   use heat_balance_equations, only: state_balance_type, find_temperatures
   use varied_bearing, only: varied_bearing_type
   implicit none (type, external)
   private
   public :: frozen_viscosity_type, new_frozen_viscosity

   !> A state in equilibrium and the viscosities there, Pa s, at a value of the parameter.
   type :: static_state_type
      real(wp) :: value = -huge(1.0_wp)
      real(wp), allocatable :: y(:), viscosity(:)
   end type static_state_type

   type :: frozen_viscosity_type
      private
      !> With a static model.
      type(varied_bearing_type) :: bearing
      !> Where searches begin; what they have found, the last first.
      type(static_state_type) :: start, found, before
      type(state_balance_type) :: balance
   contains
      procedure :: find
      procedure :: begin_here
      procedure :: get_start
      procedure :: set_start
      procedure :: get_found
   end type frozen_viscosity_type

contains

   !> The oil of a bearing whose model, a static one, is in equilibrium in y with the viscosities of this equilibrium.
   type(frozen_viscosity_type) function new_frozen_viscosity(bearing, y) result(self)
      type(varied_bearing_type), intent(in) :: bearing
      real(wp), intent(in) :: y(:)
      self%bearing = bearing
      self%start%y = y
      self%start%viscosity = bearing%model%oil%viscosity
      self%found = self%start
      self%before = self%start
   end function new_frozen_viscosity

   !> The viscosities at a value of the parameter; an error, with those found last, where the bearing does not come to
   !> rest or its heat has no balance.
   subroutine find(self, value, viscosity, error)
      class(frozen_viscosity_type), intent(inout) :: self
      real(wp), intent(in) :: value
      real(wp), intent(out) :: viscosity(:)
      type(error_type), allocatable, intent(out) :: error
      type(error_type), allocatable :: ignored
      type(static_state_type) :: here
      real(wp) :: residual
      if (abs(self%before%value - value) <= 0) then
         here = self%before
         self%before = self%found
         self%found = here
      else if (abs(self%found%value - value) > 0) then
         ! who asks knows of himself whether the value is allowed
         call self%bearing%set_value(value, .true., ignored)
         here = self%start
         associate (model => self%bearing%model)
            model%oil%viscosity = here%viscosity
            call solve_thermal_equilibrium(model, here%y, residual, error)
            call add_context(error, 'the oil takes the temperatures of the equilibrium')
            here%viscosity = model%oil%viscosity
         end associate
         if (.not. allocated(error)) then
            here%value = value
            self%before = self%found
            self%found = here
         end if
      end if
      viscosity = self%found%viscosity
   end subroutine find

   !> Lets searches begin at what was found last.
   pure subroutine begin_here(self)
      class(frozen_viscosity_type), intent(inout) :: self
      self%start%y = self%found%y
      self%start%viscosity = self%found%viscosity
   end subroutine begin_here

   !> Where searches begin, as numbers.
   pure subroutine get_start(self, numbers)
      class(frozen_viscosity_type), intent(in) :: self
      real(wp), allocatable, intent(out) :: numbers(:)
      numbers = [self%start%y, self%start%viscosity]
   end subroutine get_start

   !> Lets searches begin there, and forgets what others have found.
   pure subroutine set_start(self, numbers)
      class(frozen_viscosity_type), intent(inout) :: self
      real(wp), intent(in) :: numbers(:)
      associate (n => size(self%start%y))
         self%start%y = numbers(:n)
         self%start%viscosity = numbers(n + 1:)
      end associate
      self%found = self%start
      self%before = self%start
   end subroutine set_start

   !> Temperatures and viscosities, Pa s, that were found last.
   subroutine get_found(self, oil, viscosity)
      class(frozen_viscosity_type), intent(inout) :: self
      type(oil_temperatures_type), intent(out) :: oil
      real(wp), allocatable, intent(out) :: viscosity(:)
      type(error_type), allocatable :: ignored
      call self%bearing%set_value(self%found%value, .true., ignored)
      self%bearing%model%oil%viscosity = self%found%viscosity
      call find_temperatures(self%bearing%model, self%found%y, self%balance, oil)
      viscosity = self%found%viscosity
   end subroutine get_found
end module frozen_viscosity
