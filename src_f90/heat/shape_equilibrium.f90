!> The equilibrium of bearings whose pads bend, or whose shaft, pads and housing expand: the rotor comes to equilibrium
!> in bearings of some shapes, pressures and temperatures there lead to others, until they agree (docs/theory/heat.md,
!> *Bent pads* and *Warm clearances*).
module shape_equilibrium
   use kinds, only: wp
   use text, only: to_text
   use errors, only: error_type, raise, add_context, numerics_error, stopped, asked_to_stop
   use anderson, only: anderson_type
   use case_groups, only: is_set
   use case_inputs, only: case_type
   use bearing_shape, only: bearing_shape_type, bending_type, part_temperatures_type, new_shape, cold_shapes, &
      & apply_shapes, check_shapes, largest_change, all_lengths, set_all_lengths
   use tilting_pad_bearing, only: tilting_pad_bearing_type
   use pad_bending, only: points_along, points_across, bending_points, bent_by_pressure, bent_by_heat
   use film_conduction, only: solid_layers
   use film_oils, only: film_oil
   use film_network, only: warm_films_type
   use heat_balance, only: oil_temperatures_type
   use heat_balance_equations, only: state_balance_type, find_temperatures
   use equations_of_motion, only: machine_model
   use thermal_equilibrium, only: solve_thermal_equilibrium
   use film_equilibrium, only: solve_warm_films
   implicit none (type, external)
   private
   public :: solve_shape

   !> Largest change of a length at the end, over the clearance; most rounds; largest change that a round makes.
   real(wp), parameter :: agreement = 1e-7_wp, longest_step = 0.25_wp
   integer, parameter :: most_rounds = 40

contains

   !> Brings the state y of a static model that is in equilibrium in the shapes of its case to equilibrium in the shapes
   !> that this leads to, of each bearing; an error where there is none.
   subroutine solve_shape(static, y, films, shapes, residual, error, give_up)
      type(machine_model), intent(inout) :: static
      real(wp), intent(inout) :: y(:)
      !> Of each bearing, where films have temperatures.
      type(warm_films_type), allocatable, intent(inout) :: films(:)
      type(bearing_shape_type), allocatable, intent(out) :: shapes(:)
      real(wp), intent(inout) :: residual
      type(error_type), allocatable, intent(out) :: error
      procedure(asked_to_stop), optional :: give_up
      type(case_type) :: cold
      type(bearing_shape_type), allocatable :: wanted(:)
      type(anderson_type) :: acceleration
      real(wp), allocatable :: x(:)
      real(wp) :: change
      integer :: round
      logical :: ok
      cold = static%inputs
      call static%evaluate(0.0_wp, y, .false., ok)
      shapes = cold_shapes(cold)
      do round = 1, most_rounds
         call find_shapes(cold, static, y, films, wanted)
         change = largest_change(wanted, shapes)
         if (change <= agreement) exit
         x = all_lengths(shapes)
         if (change > longest_step) then
            call acceleration%forget()
            x = x + longest_step/change*(all_lengths(wanted) - x)
         else
            call acceleration%advance(x, all_lengths(wanted))
         end if
         call set_all_lengths(shapes, x)
         call find_equilibrium_in(static, shapes, cold, y, films, residual, error, give_up)
         if (allocated(error)) exit
      end do
      if (allocated(error)) then
         if (error%status /= stopped) call explain(wanted, cold, error)
         return
      end if
      call check_shapes(wanted, cold, error)
      if (.not. (allocated(error) .or. change <= agreement)) call raise(error, numerics_error, 'the shape of the ' &
         & //'bearing does not settle: after '//to_text(most_rounds)//' rounds its clearances still change by ' &
         & //to_text(100*change)//' %')
      if (allocated(error)) return
      call move_alloc(wanted, shapes)
   end subroutine solve_shape

   !> Equilibrium of the model in these shapes, from the last state, oil and temperatures.
   subroutine find_equilibrium_in(static, shapes, cold, y, films, residual, error, give_up)
      type(machine_model), intent(inout) :: static
      type(bearing_shape_type), intent(in) :: shapes(:)
      type(case_type), intent(in) :: cold
      real(wp), intent(inout) :: y(:)
      type(warm_films_type), allocatable, intent(inout) :: films(:)
      real(wp), intent(out) :: residual
      type(error_type), allocatable, intent(out) :: error
      procedure(asked_to_stop), optional :: give_up
      type(case_type) :: inputs
      type(film_oil) :: oil(size(static%oil))
      inputs = cold
      call apply_shapes(shapes, inputs)
      oil = static%oil
      call static%adopt(inputs, .true.)
      static%oil = oil
      if (allocated(films)) then
         call solve_warm_films(static, y, films, residual, error, give_up)
      else
         call solve_thermal_equilibrium(static, y, residual, error, give_up)
      end if
   end subroutine find_equilibrium_in

   !> The reason of a shape, where a search in one on the way to it has failed.
   subroutine explain(wanted, cold, error)
      type(bearing_shape_type), intent(in) :: wanted(:)
      type(case_type), intent(in) :: cold
      type(error_type), allocatable, intent(inout) :: error
      type(error_type), allocatable :: reason
      call check_shapes(wanted, cold, reason)
      if (allocated(reason)) then
         call move_alloc(reason, error)
      else
         call add_context(error, 'while pads bend and parts expand')
      end if
   end subroutine explain

   !> The shapes of a case to which the state y of a model leads, where it was evaluated last.
   subroutine find_shapes(cold, static, y, films, shapes)
      type(case_type), intent(in) :: cold
      type(machine_model), intent(inout) :: static
      real(wp), intent(in) :: y(:)
      !> Of each bearing, where films have temperatures.
      type(warm_films_type), allocatable, intent(in) :: films(:)
      type(bearing_shape_type), allocatable, intent(out) :: shapes(:)
      type(part_temperatures_type) :: parts(size(static%bearings))
      type(bending_type) :: bending
      type(case_type) :: own
      integer :: b
      shapes = cold_shapes(cold)
      call find_part_temperatures(cold, static, y, films, parts)
      do b = 1, size(shapes)
         own = cold%of_bearing(b)
         if (.not. own%changes_shape()) cycle
         bending = shapes(b)%bending
         if (any(own%pads%bending == ['elastic', 'both   '])) call bend_elastically(own, static%bearings(b), &
            & bending%elastic)
         if (any(own%pads%bending == ['thermal', 'both   '])) bending%thermal = bent_films(own, static%bearings(b), &
            & films(b))
         shapes(b) = new_shape(own, bending, parts(b))
      end do
   end subroutine find_shapes

   !> Changes of the clearances of a bearing by the pressure of its films, m.
   subroutine bend_elastically(cold, bearing, elastic)
      type(case_type), intent(in) :: cold
      type(tilting_pad_bearing_type), intent(inout) :: bearing
      real(wp), intent(out) :: elastic(:)
      real(wp) :: phi(points_along, size(elastic)), z(points_across, size(elastic))
      real(wp) :: pressure(points_across, points_along, size(elastic))
      integer :: i
      do i = 1, size(elastic)
         call bending_points(bearing%pads(i)%gap, phi(:, i), z(:, i))
      end do
      call bearing%pressure_field(phi, z, pressure)
      do i = 1, size(elastic)
         associate (gap => bearing%pads(i)%gap, p => cold%pads)
            elastic(i) = bent_by_pressure(gap, p%thickness(i), p%young_modulus(i), p%poisson_ratio(i), &
               & pressure(:, :, i) - gap%ambient_pressure)
         end associate
      end do
   end subroutine bend_elastically

   !> Changes of the clearances of a bearing by the temperatures across its pads, m.
   function bent_films(cold, bearing, films) result(thermal)
      type(case_type), intent(in) :: cold
      type(tilting_pad_bearing_type), intent(in) :: bearing
      type(warm_films_type), intent(in) :: films
      real(wp) :: thermal(cold%pad_count())
      integer :: i
      associate (p => cold%pads)
         do i = 1, size(thermal)
            thermal(i) = bent_by_heat(bearing%pads(i)%gap, p%thickness(i), p%expansion(i), &
               & (films%fields(solid_layers, :, i) - films%fields(1, :, i))/(p%thickness(i)*(1 - 1.0_wp/solid_layers)))
         end do
      end associate
   end function bent_films

   !> Temperatures of shaft, pads and housing of each bearing, given or of the state y; those of pads are not allocated
   !> where nothing expands.
   subroutine find_part_temperatures(cold, static, y, films, parts)
      type(case_type), intent(in) :: cold
      type(machine_model), intent(in) :: static
      real(wp), intent(in) :: y(:)
      type(warm_films_type), allocatable, intent(in) :: films(:)
      type(part_temperatures_type), intent(out) :: parts(:)
      type(state_balance_type) :: balance
      type(oil_temperatures_type) :: oil(size(parts))
      type(case_type) :: own
      integer :: b
      do b = 1, size(parts)
         own = cold%of_bearing(b)
         if (.not. is_set(own%bearing%clearance_temperature)) cycle
         associate (housing => own%bearing%housing_temperature, given => own%pads%temperature, part => parts(b))
            part%housing = merge(housing, own%oil%supply_temperature, is_set(housing))
            part%pads = given
            if (allocated(films)) then
               associate (solid => films(b)%fields(:solid_layers, :, :))
                  where (.not. is_set(given)) part%pads = sum(sum(solid, 1), 1)/(size(solid, 1)*size(solid, 2))
               end associate
               part%shaft = films(b)%oil%shaft
            else if (is_set(own%oil%shaft_temperature)) then
               part%shaft = own%oil%shaft_temperature
            else
               if (.not. allocated(oil(b)%mean)) call find_temperatures(static, y, balance, oil)
               part%shaft = oil(b)%shaft
            end if
         end associate
      end do
   end subroutine find_part_temperatures
end module shape_equilibrium
