!> What a bearing engineer asks of an equilibrium beside its state: where the journal lies, losses, flows and
!> temperatures.
module static_figures
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan, ieee_is_nan
   use kinds, only: wp
   use bearing_numbers, only: eccentricity_ratio, attitude_angle
   use bearing_losses, only: pad_loss
   use heat_balance, only: oil_temperatures_type
   use heat_balance_equations, only: state_balance_type, has_warm_oil, find_losses
   use equations_of_motion, only: machine_model
   use equilibrium_record, only: equilibrium_type
   implicit none (type, external)
   private
   public :: static_figures_type, find_static_figures

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
end module static_figures
