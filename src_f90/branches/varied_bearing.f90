!> A bearing with a number of its input as the parameter of a branch, and its periodic orbits as those of an ODE. In
!> orbits warm oil has the viscosities of the bearing in equilibrium at the parameter's value, which a motion keeps, and
!> elements that act in motion alone act about that equilibrium.
module varied_bearing
   use kinds, only: wp, pi
   use errors, only: error_type, add_context
   use case_inputs, only: case_type
   use case_parameter, only: case_parameter_type
   use film_oils, only: film_oil, even_oil
   use film_network, only: warm_films_type
   use heat_balance, only: oil_temperatures_type
   use thermal_equilibrium, only: solve_thermal_equilibrium
   use heat_balance_equations, only: state_balance_type, find_temperatures
   use equations_of_motion, only: machine_model
   use marching, only: march_options
   use cvode_integrator, only: integrator_type
   use orbit_polynomials, only: orbit_type
   use march_settings, only: march_period, mesh_options
   use orbit_problem, only: parametric_ode_type
   implicit none (type, external)
   private
   public :: varied_bearing_type, bearing_orbits_type, parameter_line_type

   !> A line in the plane of two numbers of the input, each 0 at its first value and 1 at its last: the way along it is
   !> the parameter of a branch.
   type :: parameter_line_type
      type(case_parameter_type) :: second
      real(wp) :: first(2) = 0, last(2) = 1, origin(2) = 0, direction(2) = [1, 0]
   contains
      procedure :: values
      procedure :: at
   end type parameter_line_type

   type :: varied_bearing_type
      type(machine_model), pointer :: model => null()
      type(case_parameter_type) :: parameter
      !> Where there are two parameters.
      type(parameter_line_type), pointer :: line => null()
   contains
      procedure :: set_value
      procedure, private :: values_at
   end type varied_bearing_type

   !> A state in equilibrium and the oil there, at a value of the parameter; where its search began: a state and the
   !> viscosities, Pa s, as numbers.
   type :: static_state_type
      real(wp) :: value = 0, values(2) = -huge(1.0_wp)
      real(wp), allocatable :: start(:), state(:)
      type(film_oil), allocatable :: oil(:)
      !> Of each bearing, where films have temperatures along and across.
      type(warm_films_type), allocatable :: films(:)
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

   type, extends(parametric_ode_type) :: bearing_orbits_type
      type(varied_bearing_type) :: bearing
      !> Where the oil is warm, or an element acts in motion alone.
      type(frozen_viscosity_type), allocatable :: oil
      !> How the motion is marched, for a mesh.
      type(march_options) :: march
   contains
      procedure :: set
      procedure :: new_mesh
   end type bearing_orbits_type

contains

   !> The numbers at a point of the line.
   pure function values(self, along)
      class(parameter_line_type), intent(in) :: self
      real(wp), intent(in) :: along
      real(wp) :: values(2)
      values = self%at(self%origin + along*self%direction)
   end function values

   !> The numbers at a place of the plane; at 0 and 1 they are the first and last ones to the last bit.
   pure function at(self, place) result(values)
      class(parameter_line_type), intent(in) :: self
      real(wp), intent(in) :: place(2)
      real(wp) :: values(2)
      values = (1 - place)*self%first + place*self%last
   end function at

   !> The numbers that a value of the parameter stands for; the second is 0 where there is one.
   pure function values_at(self, value) result(values)
      class(varied_bearing_type), intent(in) :: self
      real(wp), intent(in) :: value
      real(wp) :: values(2)
      values = [value, 0.0_wp]
      if (associated(self%line)) values = self%line%values(value)
   end function values_at

   !> Gives the model another value; an error, with which the model is of this value all the same, where no valid case
   !> has it. `anew`, its films start so that what it answers does not depend on what it was asked before.
   subroutine set_value(self, value, anew, error)
      class(varied_bearing_type), intent(in) :: self
      real(wp), intent(in) :: value
      logical, intent(in) :: anew
      type(error_type), allocatable, intent(out) :: error
      type(case_type) :: inputs
      real(wp) :: values(2)
      inputs = self%model%inputs
      values = self%values_at(value)
      ! whether both are allowed shows where the case has both
      if (associated(self%line)) call self%line%second%set(values(2), inputs, error)
      call self%parameter%set(values(1), inputs, error)
      if (associated(self%line) .and. .not. allocated(error)) call self%line%second%set(values(2), inputs, error)
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
      type(warm_films_type), allocatable :: films(:)
      real(wp) :: y(self%bearing%model%n), residual
      if (is_known(self%known(2))) self%known = self%known([2, 1])
      if (.not. is_known(self%known(1))) then
         ! who asks knows of himself whether the value is allowed
         call self%bearing%set_value(value, .true., ignored)
         associate (model => self%bearing%model)
            y = start(:size(y))
            model%oil = even_oil(start(size(y) + 1:))
            call solve_thermal_equilibrium(model, y, residual, error, films=films)
            call add_context(error, 'the oil takes the temperatures of the equilibrium')
            if (allocated(error)) return
            self%known(2) = self%known(1)
            self%known(1)%value = value
            self%known(1)%values = self%bearing%values_at(value)
            self%known(1)%start = start
            self%known(1)%state = y
            self%known(1)%oil = model%oil
            if (allocated(self%known(1)%films)) deallocate (self%known(1)%films)
            if (allocated(films)) call move_alloc(films, self%known(1)%films)
         end associate
      end if
      found = [self%known(1)%state, self%known(1)%oil%viscosity]
   contains
      pure logical function is_known(state)
         type(static_state_type), intent(in) :: state
         is_known = all(abs(state%values - self%bearing%values_at(value)) <= 0)
         if (is_known) is_known = all(abs(state%start - start) <= 0)
      end function is_known
   end subroutine find

   !> Temperatures in each bearing and viscosities, Pa s, that were found last.
   subroutine temperatures(self, oil, viscosity)
      class(frozen_viscosity_type), intent(inout) :: self
      type(oil_temperatures_type), intent(out) :: oil(:)
      real(wp), allocatable, intent(out) :: viscosity(:)
      type(error_type), allocatable :: ignored
      integer :: b
      associate (model => self%bearing%model, known => self%known(1))
         viscosity = known%oil%viscosity
         if (allocated(known%films)) then
            do b = 1, size(oil)
               oil(b) = known%films(b)%oil
            end do
            return
         end if
         call self%bearing%set_value(known%value, .true., ignored)
         model%oil = known%oil
         call find_temperatures(model, known%state, self%balance, oil)
      end associate
   end subroutine temperatures

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
         if (.not. allocated(oil_error)) then
            model%oil = self%oil%known(1)%oil
            ! what acts in motion alone acts about this equilibrium
            call model%rotor%move_about(self%found(:model%rotor%positions))
         end if
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
end module varied_bearing
