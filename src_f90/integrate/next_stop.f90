!> Where the steps of an integration end next because its model switches.
module next_stop
   use kinds, only: wp
   use ode_model, only: ode_model_type
   implicit none (type, external)
   private
   public :: next_stop_type

   type :: next_stop_type
      !> When steps end, and from when on they go on, s: where the rates jump, steps end just before, as at the time
      !> itself the rates are those after the jump.
      real(wp) :: time = huge(1.0_wp), resumed = huge(1.0_wp)
      !> Whether the rates jump: what was before says nothing of what follows.
      logical :: anew = .false.
   contains
      procedure :: find
   end type next_stop_type

contains

   !> The first stop of an integration from t to t_end, s, where the last is.
   pure subroutine find(self, model, t, t_end)
      class(next_stop_type), intent(inout) :: self
      class(ode_model_type), intent(in) :: model
      real(wp), intent(in) :: t, t_end
      call model%next_switch(t, self%resumed, self%anew)
      self%anew = self%anew .and. self%resumed < t_end
      self%time = min(t_end, self%resumed)
      if (self%anew) self%time = nearest(self%resumed, -1.0_wp)
   end subroutine find
end module next_stop
