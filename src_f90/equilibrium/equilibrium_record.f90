!> The record of an equilibrium, and what a bearing engineer asks of it beside its state: where the journal lies,
!> losses, flows and temperatures.
module equilibrium_record
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan, ieee_is_nan
   use kinds, only: wp
   use film_solver, only: film_oil
   use film_network, only: warm_films_type
   use bearing_shape, only: bearing_shape_type
   use state_layout, only: pad_state
   use tilting_pad_bearing, only: pad_sample, sloped_sample
   use sloped_bearing, only: sampled_slopes, moment_on_journal
   use equations_of_motion, only: machine_model
   use errors, only: error_type, raise, numerics_error
   use force_balance, only: stability_type, stability_at
   use bearing_numbers, only: eccentricity_ratio, attitude_angle
   use bearing_losses, only: pad_loss
   use heat_balance, only: oil_temperatures_type
   use heat_balance_equations, only: state_balance_type, has_warm_oil, find_losses
   implicit none (type, external)
   private
   public :: equilibrium_type, describe, describe_with_stability, static_figures_type, find_static_figures

   type :: equilibrium_type
      !> Displacements of the rotor, those of its journals, m, first.
      real(wp), allocatable :: rotor(:)
      !> Of all bearings: states of the pads at rest; pivot loads, N.
      type(pad_state), allocatable :: pads(:)
      real(wp), allocatable :: pivot_load(:)
      !> Per pad minimum film thickness, m, and maximum pressure, Pa.
      real(wp), allocatable :: min_film_thickness(:), max_pressure(:)
      !> Where slopes count in a bearing of the model: what is sampled of its pads beside; moments on the journals, (2,
      !> bearing), against their slopes along y and z, N m.
      type(sloped_sample), allocatable :: slopes(:)
      real(wp), allocatable :: moments(:, :)
      !> The oil of every pad's film; its temperatures in each bearing, where films have them along and across.
      type(film_oil), allocatable :: oil(:)
      type(warm_films_type), allocatable :: films(:)
      !> Of all bearings, where it changes the shape of one.
      type(bearing_shape_type), allocatable :: shapes(:)
      !> Largest unbalanced force over the reference force (static_model).
      real(wp) :: residual = huge(1.0_wp)
      type(stability_type) :: stability
      !> Which search found it.
      character(len=:), allocatable :: search
   end type equilibrium_type

   type :: static_figures_type
      !> Distance of the journal from the middle over the bearing clearance; angle from the load to the journal in the
      !> sense of rotation, rad.
      real(wp) :: eccentricity_ratio = 0, attitude_angle = 0
      type(pad_loss), allocatable :: pads(:)
      !> Of each film.
      real(wp), allocatable :: reynolds_number(:)
      !> K: of the oil of each film from the leading to the trailing edge; of all oil where the pads draw fresh oil
      !> alone, and where fresh oil replaces only what leaves at the sides. All heat stays in the oil.
      real(wp), allocatable :: temperature_rise(:)
      real(wp) :: rise_fresh = 0, rise_side = 0
      !> Of warm oil; by these losses and flows.
      type(oil_temperatures_type), allocatable :: oil
   end type static_figures_type

   !> K: no oil becomes as warm; where it would, hardly any flows.
   real(wp), parameter :: largest_rise = 1e4_wp

contains

   !> The record of the equilibrium y, where the model was evaluated last.
   subroutine describe(model, y, found)
      type(machine_model), intent(inout) :: model
      real(wp), intent(in) :: y(:)
      type(equilibrium_type), intent(inout) :: found
      type(pad_state) :: pads(model%layout%pads)
      type(pad_sample) :: samples(model%layout%pads)
      integer :: b
      do b = 1, size(model%bearings)
         associate (of => model%layout%elements(b))
            pads(of%all_pads()) = of%pad_states(y)
            samples(of%all_pads()) = model%bearings(b)%sampled()
         end associate
      end do
      found%rotor = y(:model%rotor%positions)
      found%pads = pads
      found%pivot_load = samples%pivot_load
      found%min_film_thickness = samples%min_film_thickness
      found%max_pressure = samples%max_pressure
      found%oil = model%oil
      call describe_slopes(model, y, found)
   end subroutine describe

   !> What is beside it where slopes count.
   subroutine describe_slopes(model, y, found)
      type(machine_model), intent(in) :: model
      real(wp), intent(in) :: y(:)
      type(equilibrium_type), intent(inout) :: found
      type(sloped_sample) :: slopes(model%layout%pads)
      real(wp) :: moments(2, size(model%bearings))
      integer :: b, i
      if (.not. any([(allocated(model%bearings(b)%sloped), b=1, size(model%bearings))])) return
      moments = 0
      do b = 1, size(model%bearings)
         if (.not. allocated(model%bearings(b)%sloped)) cycle
         associate (of => model%layout%elements(b))
            slopes(of%first_pad:of%last_pad) = [(sampled_slopes(model%bearings(b), i), i=1, of%pads)]
            moments(:, b) = moment_on_journal(model%bearings(b), model%rotor%journal(y(:model%rotor%states), b), &
               & of%pad_states(y), slopes(of%first_pad:of%last_pad))
         end associate
      end do
      found%slopes = slopes
      found%moments = moments
   end subroutine describe_slopes

   !> The same with its stability; an error where this is not found.
   subroutine describe_with_stability(model, y, found, error)
      type(machine_model), intent(inout) :: model
      real(wp), intent(in) :: y(:)
      type(equilibrium_type), intent(inout) :: found
      type(error_type), allocatable, intent(out) :: error
      logical :: ok
      call describe(model, y, found)
      call stability_at(model, y, found%stability, ok)
      if (.not. ok) call raise(error, numerics_error, 'the eigenvalues of the equilibrium are not found')
   end subroutine describe_with_stability

   ! Figures of an equilibrium.

   !> The figures of an equilibrium of a model of one bearing.
   subroutine find_static_figures(model, static, figures)
      type(machine_model), intent(in) :: model
      type(equilibrium_type), intent(in) :: static
      type(static_figures_type), intent(out) :: figures
      type(state_balance_type) :: balance
      logical :: balanced
      figures%eccentricity_ratio = eccentricity_ratio(model%inputs%bearings(1), static%rotor)
      figures%attitude_angle = attitude_angle(model%inputs, static%rotor)
      call find_losses(model, model%static_state(static%rotor, static%pads), balance)
      figures%pads = balance%losses
      figures%reynolds_number = figures%pads%reynolds_number(model%point%speed(0.0_wp) &
         & *model%inputs%bearings(1)%journal_radius, model%inputs%bearings(1)%oil%density, static%oil%viscosity)
      associate (pads => figures%pads, heat => model%inputs%bearings(1)%oil%density &
         & *model%inputs%bearings(1)%oil%specific_heat)
         ! oil that leaves at the sides is warmed half of the way
         figures%temperature_rise = rise(pads%power(), heat*(pads%inlet + pads%outlet)/2)
         figures%rise_fresh = rise(sum(pads%power()), heat*sum(pads%inlet))
         figures%rise_side = rise(sum(pads%power()), heat*sum(pads%side))
      end associate
      if (.not. has_warm_oil(model)) return
      allocate (figures%oil)
      if (allocated(static%films)) figures%oil = static%films(1)%oil
      if (allocated(static%films)) return
      call balance%bearings(1)%heat%temperatures(figures%pads, static%oil%viscosity, model%point%speed(0.0_wp), &
         & figures%oil, balanced)
      if (.not. balanced) deallocate (figures%oil)
   end subroutine find_static_figures

   !> Rise of temperature, K, by a power, W, in a flow of heat capacity, W/K; no number where next to nothing flows.
   elemental real(wp) function rise(power, capacity)
      real(wp), intent(in) :: power, capacity
      rise = ieee_value(power, ieee_quiet_nan)
      if (ieee_is_nan(capacity)) return
      if (capacity*largest_rise > power) rise = power/capacity
   end function rise
end module equilibrium_record
