!> What a bearing is to a rotor that vibrates little: stiffness and damping, modes, and room for its threshold speeds.
module bearing_coefficients
   use kinds, only: wp
   use errors, only: error_type, raise, asked_to_stop, numerics_error
   use equations_of_motion, only: bearing_model
   use force_balance, only: stability_at
   use static_model, only: equilibrium_type, describe
   use thermal_equilibrium, only: solve_thermal_equilibrium
   use linear_bearing, only: linear_bearing_type, linearize, vibration_modes_type, find_modes
   implicit none (type, external)
   private
   public :: bearing_coefficients_type, settle, find_coefficients

   !> One element, or the last dimension, for each way that the pivots may behave.
   type :: bearing_coefficients_type
      type(linear_bearing_type), allocatable :: bearings(:)
      !> Of the journal, N/m and N s/m, (row, column, frequency, pivot).
      real(wp), allocatable :: stiffness(:, :, :, :), damping(:, :, :, :)
      type(vibration_modes_type), allocatable :: modes(:)
      !> Threshold speeds of stability, rpm, where they are asked for, and up to where they were sought.
      real(wp), allocatable :: thresholds(:)
      real(wp) :: sought_up_to = 0
   end type bearing_coefficients_type

contains

   !> Brings an equilibrium that another model has found to that of this one, whose films differ a little; y is its
   !> state.
   subroutine settle(model, found, y, error, give_up)
      type(bearing_model), intent(inout) :: model
      type(equilibrium_type), intent(inout) :: found
      real(wp), allocatable, intent(out) :: y(:)
      type(error_type), allocatable, intent(out) :: error
      procedure(asked_to_stop), optional :: give_up
      logical :: ok
      y = model%static_state(found%journal, found%tilt, found%pivot_deflection)
      model%oil%viscosity = found%viscosity
      call solve_thermal_equilibrium(model, y, found%residual, error, give_up)
      if (allocated(error)) return
      call describe(model, y, found)
      call stability_at(model, y, found%stability, ok)
      if (.not. ok) call raise(error, numerics_error, 'the eigenvalues of the equilibrium are not found')
   end subroutine settle

   !> The coefficients that the case asks for, of a model without friction in equilibrium in y.
   subroutine find_coefficients(model, y, found, error)
      type(bearing_model), intent(inout) :: model
      real(wp), intent(in) :: y(:)
      type(bearing_coefficients_type), intent(out) :: found
      type(error_type), allocatable, intent(out) :: error
      logical :: ok
      integer :: i, k
      associate (given => model%inputs%coefficients, speed => model%point%speed(0.0_wp))
         call linearize(model, y, found%bearings, ok)
         if (.not. ok) then
            call raise(error, numerics_error, 'at the equilibrium '//model%refusal)
            return
         end if
         associate (pivots => size(found%bearings), ratios => size(given%frequency_ratio))
            allocate (found%stiffness(2, 2, ratios, pivots), found%damping(2, 2, ratios, pivots), found%modes(pivots))
            do i = 1, pivots
               do k = 1, ratios
                  call found%bearings(i)%condense(given%frequency_ratio(k), speed, found%stiffness(:, :, k, i), &
                     & found%damping(:, :, k, i), ok)
                  if (.not. ok) exit
               end do
               if (ok) call find_modes(found%bearings(i), model%rotor%mass, given%cross_stiffness, lengths(model), &
                  & found%modes(i), ok)
               if (.not. ok) then
                  call raise(error, numerics_error, 'the linear equations of the pads with '//found%bearings(i)%pivot &
                     & //' pivots are singular')
                  return
               end if
            end do
         end associate
      end associate
   end subroutine find_coefficients

   !> What stands for 1 rad of a tilt: the distance from the pivot to the centre of the pad's arc, m; 1 for others.
   pure function lengths(model)
      type(bearing_model), intent(in) :: model
      real(wp), allocatable :: lengths(:)
      integer :: i
      allocate (lengths(model%layout%n_positions()), source=1.0_wp)
      if (.not. model%layout%tilting) return
      do i = 1, model%layout%pads
         lengths(model%layout%first_position(i)) = model%bearing%pads(i)%position%centre_distance
      end do
   end function lengths
end module bearing_coefficients
