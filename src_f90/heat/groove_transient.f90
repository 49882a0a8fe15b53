!> The oil of a run-up: while the speed changes, the oil in the groove before each pad is renewed in its own time by
!> what enters it, and the films take the temperatures to which it leads, in the bearing in equilibrium. The shaft keeps
!> its own.
module groove_transient
   use kinds, only: wp, rpm
   use text, only: to_text
   use errors, only: error_type, add_context, asked_to_stop
   use heat_balance, only: oil_temperatures_type
   use viscosity_history, only: viscosity_history_type, new_viscosity_history
   use equations_of_motion, only: machine_model
   use static_model, only: make_static
   use heat_balance_equations, only: state_balance_type, find_temperatures
   use thermal_equilibrium, only: solve_thermal_equilibrium
   implicit none (type, external)
   private
   public :: find_groove_transient

   !> Change of the speed between two nodes, over itself, at most; least nodes.
   real(wp), parameter :: change_of_speed = 0.03_wp
   integer, parameter :: least_nodes = 24
   !> Least speed over the first that is followed.
   real(wp), parameter :: least_ratio = 0.01_wp

contains

   !> The history of the viscosities in a march of a model from its equilibrium y, whose viscosities it has, over a
   !> duration, s. An error where a speed has no equilibrium.
   subroutine find_groove_transient(model, y, duration, history, error, give_up)
      type(machine_model), intent(in) :: model
      real(wp), intent(in) :: y(:), duration
      type(viscosity_history_type), intent(out) :: history
      type(error_type), allocatable, intent(out) :: error
      procedure(asked_to_stop), optional :: give_up
      type(machine_model) :: static
      type(state_balance_type) :: balance
      type(oil_temperatures_type), dimension(size(model%bearings)) :: oil, next
      real(wp), dimension(model%layout%pads) :: entering, before, rate, time_constant
      real(wp), allocatable :: time(:), viscosity(:, :)
      real(wp) :: state(size(y)), residual
      integer :: b, k
      call set_nodes(model, duration, time)
      allocate (viscosity(size(entering), 0:ubound(time, 1)))
      call make_static(model, model%point%cavitation, static)
      state = y
      entering = 0
      do k = 0, ubound(time, 1)
         static%point%speed_rpm = model%point%speed(time(k))/rpm
         if (k > 0) then
            do b = 1, size(oil)
               associate (pads => model%layout%elements(b)%all_pads())
                  call renew(oil(b)%inlet, entering(pads), rate(pads), time_constant(pads), time(k) - time(k - 1))
               end associate
            end do
            call solve_thermal_equilibrium(static, state, residual, error, give_up, kept=oil)
            call add_context(error, 'oil of the run-up at '//to_text(static%point%speed_rpm)//' rpm')
            if (allocated(error)) return
         end if
         viscosity(:, k) = static%oil%viscosity
         if (k == 0) then
            call find_temperatures(static, state, balance, oil)
            next = oil
         else
            call find_temperatures(static, state, balance, next, kept=oil)
         end if
         before = entering
         do b = 1, size(next)
            associate (first => model%layout%elements(b)%other_pads + 1, &
               & last => model%layout%elements(b)%other_pads + model%layout%elements(b)%pads)
               call balance%bearings(b)%heat%renewal(balance%losses(first:last), next(b), &
                  & static%point%speed(0.0_wp), entering(first:last), time_constant(first:last))
            end associate
         end do
         rate = 0
         if (k > 0) rate = (entering - before)/(time(k) - time(k - 1))
      end do
      history = new_viscosity_history(time, viscosity)
   end subroutine find_groove_transient

   !> Times, s, between which the speed changes by equal factors; near standstill nothing is followed.
   subroutine set_nodes(model, duration, time)
      type(machine_model), intent(in) :: model
      real(wp), intent(in) :: duration
      real(wp), allocatable, intent(out) :: time(:)
      real(wp) :: ratio, first
      integer :: k, n
      first = model%point%speed(0.0_wp)
      ratio = max(model%point%speed(duration)/first, least_ratio)
      n = max(least_nodes, ceiling(abs(log(ratio))/change_of_speed))
      allocate (time(0:n))
      time(:) = [(first*(ratio**(real(k, wp)/n) - 1)/model%point%acceleration, k=0, n)]
   end subroutine set_nodes

   !> Temperatures of grooves after a time step, s, in which what enters changes at this rate, K/s.
   elemental subroutine renew(inlet, entering, rate, time_constant, step)
      real(wp), intent(inout) :: inlet
      real(wp), intent(in) :: entering, rate, time_constant, step
      inlet = entering + rate*(step - time_constant) + (inlet - entering + rate*time_constant)*exp(-step/time_constant)
   end subroutine renew
end module groove_transient
