!> The equilibrium of a bearing whose pads bend, or whose shaft, pads and housing expand: the bearing comes to
!> equilibrium in a shape, pressures and temperatures there lead to another, until they agree (docs/theory/heat.md,
!> *Bent pads* and *Warm clearances*).
module shape_equilibrium
   use kinds, only: wp
   use text, only: to_text
   use errors, only: error_type, raise, add_context, numerics_error, stopped, asked_to_stop
   use anderson, only: anderson_type
   use case_groups, only: is_set
   use case_inputs, only: case_type
   use bearing_shape, only: bearing_shape_type, bending_type, part_temperatures_type, new_shape
   use pad_bending, only: points_along, points_across, bending_points, bent_by_pressure, bent_by_heat
   use film_energy, only: solid_layers
   use film_oils, only: film_oil
   use film_network, only: warm_films_type
   use heat_balance, only: oil_temperatures_type
   use heat_balance_equations, only: state_balance_type, find_temperatures
   use equations_of_motion, only: machine_model
   use force_balance, only: stability_at
   use static_model, only: equilibrium_type, describe, make_static
   use thermal_equilibrium, only: solve_thermal_equilibrium
   use film_equilibrium, only: solve_warm_films
   implicit none (type, external)
   private
   public :: settle_shape

   !> Largest change of a length at the end, over the clearance; most rounds; largest change that a round makes.
   real(wp), parameter :: agreement = 1e-7_wp, longest_step = 0.25_wp
   integer, parameter :: most_rounds = 40

contains

   !> Brings an equilibrium of a model in the shape of its case to one in the shape that it leads to, which the record
   !> has then; an error where there is none.
   subroutine settle_shape(model, found, error, give_up)
      type(machine_model), intent(in) :: model
      type(equilibrium_type), intent(inout) :: found
      type(error_type), allocatable, intent(out) :: error
      procedure(asked_to_stop), optional :: give_up
      type(machine_model) :: static
      type(bearing_shape_type) :: shape, wanted
      type(anderson_type) :: acceleration
      real(wp), allocatable :: y(:), x(:)
      real(wp) :: change
      integer :: round
      logical :: ok
      call make_static(model, model%point%cavitation, static)
      y = static%static_state(found%rotor, found%tilt, found%pivot_deflection)
      static%oil = found%oil
      call static%evaluate(0.0_wp, y, .false., ok)
      associate (cold => model%inputs)
         shape = new_shape(cold, no_bending(cold), part_temperatures_type())
         do round = 1, most_rounds
            call find_shape(cold, static, y, found%films, wanted)
            change = maxval(abs(wanted%lengths() - shape%lengths()))/minval([shape%machined_clearance, &
               & shape%assembled_clearance])
            if (change <= agreement) exit
            x = shape%lengths()
            if (change > longest_step) then
               call acceleration%forget()
               x = x + longest_step/change*(wanted%lengths() - x)
            else
               call acceleration%advance(x, wanted%lengths())
            end if
            call shape%set_lengths(x)
            call find_equilibrium_in(static, shape, cold, y, found, error, give_up)
            if (allocated(error)) exit
         end do
         if (allocated(error)) then
            if (error%status /= stopped) call explain(wanted, cold, error)
            return
         end if
         call wanted%check(cold, error)
         if (.not. (allocated(error) .or. change <= agreement)) call raise(error, numerics_error, 'the shape of the ' &
            & //'bearing does not settle: after '//to_text(most_rounds)//' rounds its clearances still change by ' &
            & //to_text(100*change)//' %')
         if (allocated(error)) return
      end associate
      found%shape = wanted
      call describe(static, y, found)
      call stability_at(static, y, found%stability, ok)
      if (.not. ok) call raise(error, numerics_error, 'the eigenvalues of the equilibrium are not found')
   end subroutine settle_shape

   !> Equilibrium of the model in a shape, from the last state, oil and temperatures.
   subroutine find_equilibrium_in(static, shape, cold, y, found, error, give_up)
      type(machine_model), intent(inout) :: static
      type(bearing_shape_type), intent(in) :: shape
      type(case_type), intent(in) :: cold
      real(wp), intent(inout) :: y(:)
      type(equilibrium_type), intent(inout) :: found
      type(error_type), allocatable, intent(out) :: error
      procedure(asked_to_stop), optional :: give_up
      type(case_type) :: inputs
      type(film_oil) :: oil(size(static%oil))
      inputs = cold
      call shape%apply(inputs)
      oil = static%oil
      call static%adopt(inputs, .true.)
      static%oil = oil
      if (allocated(found%films)) then
         call solve_warm_films(static, y, found%films, found%residual, error, give_up)
      else
         call solve_thermal_equilibrium(static, y, found%residual, error, give_up)
      end if
   end subroutine find_equilibrium_in

   !> The reason of a shape, where a search in one on the way to it has failed.
   subroutine explain(wanted, cold, error)
      type(bearing_shape_type), intent(in) :: wanted
      type(case_type), intent(in) :: cold
      type(error_type), allocatable, intent(inout) :: error
      type(error_type), allocatable :: reason
      call wanted%check(cold, reason)
      if (allocated(reason)) then
         call move_alloc(reason, error)
      else
         call add_context(error, 'while pads bend and parts expand')
      end if
   end subroutine explain

   !> The shape of a case to which the state y of a model leads, where it was evaluated last.
   subroutine find_shape(cold, static, y, films, shape)
      type(case_type), intent(in) :: cold
      type(machine_model), intent(inout) :: static
      real(wp), intent(in) :: y(:)
      !> Where films have temperatures.
      type(warm_films_type), allocatable, intent(in) :: films(:)
      type(bearing_shape_type), intent(out) :: shape
      type(bending_type) :: bending
      bending = no_bending(cold)
      associate (p => cold%pads)
         if (any(p%bending == ['elastic', 'both   '])) call bend_elastically(cold, static, bending%elastic)
         if (any(p%bending == ['thermal', 'both   '])) bending%thermal = bent_films(cold, static, films(1))
      end associate
      shape = new_shape(cold, bending, temperatures_of(cold, static, y, films))
   end subroutine find_shape

   !> Changes of clearances by the pressure of the films, m.
   subroutine bend_elastically(cold, static, elastic)
      type(case_type), intent(in) :: cold
      type(machine_model), intent(inout) :: static
      real(wp), intent(out) :: elastic(:)
      real(wp) :: phi(points_along, size(elastic)), z(points_across, size(elastic))
      real(wp) :: pressure(points_across, points_along, size(elastic))
      integer :: i
      associate (bearing => static%bearings(1), p => cold%pads)
         do i = 1, size(elastic)
            call bending_points(bearing%pads(i)%gap, phi(:, i), z(:, i))
         end do
         call bearing%pressure_field(phi, z, pressure)
         do i = 1, size(elastic)
            elastic(i) = bent_by_pressure(bearing%pads(i)%gap, p%thickness(i), p%young_modulus(i), &
               & p%poisson_ratio(i), pressure(:, :, i) - bearing%pads(i)%gap%ambient_pressure)
         end do
      end associate
   end subroutine bend_elastically

   !> Changes of clearances by the temperatures across the pads, m.
   function bent_films(cold, static, films) result(thermal)
      type(case_type), intent(in) :: cold
      type(machine_model), intent(in) :: static
      type(warm_films_type), intent(in) :: films
      real(wp) :: thermal(cold%pad_count())
      integer :: i
      associate (p => cold%pads)
         do i = 1, size(thermal)
            thermal(i) = bent_by_heat(static%bearings(1)%pads(i)%gap, p%thickness(i), p%expansion(i), &
               & (films%fields(solid_layers, :, i) - films%fields(1, :, i))/(p%thickness(i)*(1 - 1.0_wp/solid_layers)))
         end do
      end associate
   end function bent_films

   !> Temperatures of shaft, pads and housing, given or of the state y; not allocated where nothing expands.
   function temperatures_of(cold, static, y, films) result(parts)
      type(case_type), intent(in) :: cold
      type(machine_model), intent(in) :: static
      real(wp), intent(in) :: y(:)
      type(warm_films_type), allocatable, intent(in) :: films(:)
      type(part_temperatures_type) :: parts
      type(state_balance_type) :: balance
      type(oil_temperatures_type) :: oil(1)
      if (.not. is_set(cold%bearing%clearance_temperature)) return
      associate (b => cold%bearing, p => cold%pads)
         parts%housing = merge(b%housing_temperature, cold%oil%supply_temperature, is_set(b%housing_temperature))
         parts%pads = p%temperature
         if (allocated(films)) then
            associate (solid => films(1)%fields(:solid_layers, :, :))
               where (.not. is_set(p%temperature)) parts%pads = sum(sum(solid, 1), 1)/(size(solid, 1)*size(solid, 2))
            end associate
            parts%shaft = films(1)%oil%shaft
         else if (is_set(cold%oil%shaft_temperature)) then
            parts%shaft = cold%oil%shaft_temperature
         else
            call find_temperatures(static, y, balance, oil)
            parts%shaft = oil(1)%shaft
         end if
      end associate
   end function temperatures_of

   !> Pads that do not bend.
   pure type(bending_type) function no_bending(inputs)
      type(case_type), intent(in) :: inputs
      real(wp) :: none(inputs%pad_count())
      none = 0
      no_bending%elastic = none
      no_bending%thermal = none
   end function no_bending
end module shape_equilibrium
