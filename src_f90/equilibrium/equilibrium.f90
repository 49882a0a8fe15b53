!> Static equilibrium of a rotor and the pads of its bearings at constant speed: no unbalance, no friction.
module equilibrium
   use kinds, only: wp
   use errors, only: error_type, stopped, asked_to_stop
   use equations_of_motion, only: machine_model
   use equilibrium_record, only: equilibrium_type, describe_with_stability
   use static_model, only: make_static
   use bearing_equilibrium, only: find_bearing_equilibrium, settle
   use branch_hint, only: offer_branch
   use thermal_equilibrium, only: solve_shape
   use load_shares, only: share_loads
   implicit none (type, external)
   private
   public :: find_equilibrium, settle_equilibrium

contains

   !> The equilibrium of a model under its loads at its initial speed, stable or of oscillatory instability, with the
   !> temperatures of warm oil; an error where none is found, or, of status `stopped`, where `give_up`, asked between
   !> evaluations of the films, says so.
   subroutine find_equilibrium(model, found, error, give_up)
      type(machine_model), intent(in) :: model
      type(equilibrium_type), intent(out) :: found
      type(error_type), allocatable, intent(out) :: error
      procedure(asked_to_stop), optional :: give_up
      type(machine_model) :: static
      logical :: by_heat
      if (size(model%bearings) > 1) then
         call make_static(model, model%point%cavitation, static)
         call share_loads(static, found, error, give_up)
      else
         call find_bearing_equilibrium(model, found, error, give_up, by_heat)
         if (by_heat) then
            if (error%status /= stopped) call offer_branch(model, error, give_up)
         end if
      end if
      if (allocated(error)) return
      if (any(model%inputs%bearings%changes_shape())) call settle_shape(model, found, error, give_up)
   end subroutine find_equilibrium

   !> Brings an equilibrium of a model in the shapes of its case to one in the shapes that it leads to, of each bearing,
   !> which the record has then; an error where there is none.
   subroutine settle_shape(model, found, error, give_up)
      type(machine_model), intent(in) :: model
      type(equilibrium_type), intent(inout) :: found
      type(error_type), allocatable, intent(out) :: error
      procedure(asked_to_stop), optional :: give_up
      type(machine_model) :: static
      real(wp), allocatable :: y(:)
      call make_static(model, model%point%cavitation, static)
      y = static%static_state(found%rotor, found%pads)
      static%oil = found%oil
      call solve_shape(static, y, found%films, found%shapes, found%residual, error, give_up)
      if (.not. allocated(error)) call describe_with_stability(static, y, found, error)
   end subroutine settle_shape

   !> Brings an equilibrium that another model has found to that of this static one, whose films differ a little; y is
   !> its state.
   subroutine settle_equilibrium(model, found, y, error, give_up)
      type(machine_model), intent(inout) :: model
      type(equilibrium_type), intent(inout) :: found
      real(wp), allocatable, intent(out) :: y(:)
      type(error_type), allocatable, intent(out) :: error
      procedure(asked_to_stop), optional :: give_up
      if (size(model%bearings) > 1) then
         call share_loads(model, found, error, give_up, known=.true.)
         if (.not. allocated(error)) y = model%static_state(found%rotor, found%pads)
      else
         call settle(model, found, y, error, give_up)
      end if
   end subroutine settle_equilibrium
end module equilibrium
