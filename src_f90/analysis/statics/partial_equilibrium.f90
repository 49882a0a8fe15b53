!> A start for bearings whose unloaded pads have no rest position: the journal and the other pads in equilibrium, these
!> pads held at zero tilt on their pivots.
module partial_equilibrium
   use kinds, only: wp
   use text, only: to_text
   use errors, only: error_type, raise, numerics_error, stopped, asked_to_stop, asked
   use equations_of_motion, only: bearing_model
   use pad_elimination, only: eliminate_pads
   use static_model, only: equilibrium_type, describe, make_static, make_quick, start, starts
   use heat_balance_equations, only: has_warm_oil
   use thermal_equilibrium, only: guess_oil, come_to_warm_rest
   implicit none (type, external)
   private
   public :: find_partial_equilibrium

contains

   !> The partial equilibrium of a model under its load at its initial speed, and which pads are held; none where all
   !> find their rest. An error where the journal finds none, or, of status `stopped`, where `give_up`, asked between
   !> evaluations of the films, says so. The record has no stability.
   subroutine find_partial_equilibrium(model, found, held, error, give_up)
      type(bearing_model), intent(in) :: model
      type(equilibrium_type), intent(out) :: found
      logical, allocatable, intent(out) :: held(:)
      type(error_type), allocatable, intent(out) :: error
      procedure(asked_to_stop), optional :: give_up
      type(bearing_model) :: static, quick
      real(wp) :: y(model%n)
      logical :: at_rest(model%layout%pads), ok
      integer :: k
      call make_static(model, model%point%rupture, static)
      if (has_warm_oil(model)) call guess_oil(static, 1)
      call make_quick(model%scene, static%oil%viscosity, model%point%rupture, quick)
      do k = 1, starts
         y = start(quick, k)
         call eliminate_pads(quick, y, at_rest, ok, give_up)
         if (asked(give_up)) then
            call raise(error, stopped, 'stopped while the equilibrium was sought')
            return
         end if
         if (.not. ok) cycle
         held = .not. at_rest
         call come_to_warm_rest(static, y, found%residual, error, give_up, held)
         if (.not. allocated(error)) then
            call describe(static, y, found)
            return
         end if
         if (error%status == stopped) return
      end do
      call raise(error, numerics_error, 'no partial equilibrium found at '//to_text(model%point%speed_rpm) &
         & //' rpm: the journal finds no rest on pads that do')
   end subroutine find_partial_equilibrium
end module partial_equilibrium
