!> Brings a model in equilibrium to equilibrium again after a change of its oil.
module oil_change
   use kinds, only: wp
   use errors, only: error_type, stopped, asked_to_stop
   use film_solver, only: film_oil
   use equations_of_motion, only: machine_model
   use force_balance, only: forces
   use pseudo_transient, only: set_free, unbalanced, reference_force, newton_step, clearances, static_derivatives, &
      & longest_move, newtons
   use static_model, only: solve_equilibrium
   implicit none (type, external)
   private
   public :: follow_oil, pad_that_moves

   !> Iterations of Newton's method from the last equilibrium, of which it needs about five where it comes to an end;
   !> and after steps with the derivatives there.
   integer, parameter :: direct = 6, after_known = 10
   !> Such steps at most, and what each has to leave of the unbalanced force at most.
   integer, parameter :: known_steps = 6
   real(wp), parameter :: largest_share = 0.3_wp

contains

   !> Brings a state to equilibrium with the oil of the model, from an equilibrium with `last_oil`, down to a residual
   !> that is enough. Newton's method from there goes astray where an unloaded pad has lost its stiffness at the old
   !> place: the derivatives of the old equilibrium then lead close to the new one. An error where nothing does.
   subroutine follow_oil(model, y, last_oil, enough, most, residual, error, give_up, held)
      type(machine_model), intent(inout) :: model
      real(wp), intent(inout) :: y(:)
      type(film_oil), intent(in) :: last_oil(:)
      real(wp), intent(in) :: enough
      !> Iterations at most where it has to search.
      integer, intent(in) :: most
      real(wp), intent(out) :: residual
      type(error_type), allocatable, intent(out) :: error
      procedure(asked_to_stop), optional :: give_up
      !> Pads that are held where they are.
      logical, intent(in), optional :: held(:)
      real(wp), dimension(size(y)) :: before, astray
      logical :: ok
      before = y
      call solve_equilibrium(model, y, residual, error, give_up, held, direct, enough)
      if (.not. allocated(error)) return
      if (error%status == stopped) return
      astray = y
      y = before
      call take_known_steps(model, y, last_oil, held, ok)
      if (ok) call solve_equilibrium(model, y, residual, error, give_up, held, after_known, enough)
      if (.not. allocated(error)) return
      if (error%status == stopped) return
      y = astray
      call solve_equilibrium(model, y, residual, error, give_up, held, most, enough)
   end subroutine follow_oil

   !> Takes Newton's steps with the derivatives of the equilibrium y with `last_oil` as long as they lead on. `ok` is
   !> false where there are none.
   subroutine take_known_steps(model, y, last_oil, held, ok)
      type(machine_model), intent(inout) :: model
      real(wp), intent(inout) :: y(:)
      type(film_oil), intent(in) :: last_oil(:)
      logical, intent(in), optional :: held(:)
      logical, intent(out) :: ok
      type(film_oil) :: oil(size(last_oil))
      real(wp), dimension(model%layout%n_positions(), model%layout%n_positions()) :: stiffness, damping
      real(wp), allocatable :: step(:)
      real(wp) :: trial(size(y)), last, residual
      logical :: free(model%layout%n_positions())
      integer, allocatable :: x(:)
      integer :: i
      oil = model%oil
      model%oil = last_oil
      call model%evaluate(0.0_wp, y, .true., ok)
      if (ok) call static_derivatives(model, stiffness, damping)
      model%oil = oil
      if (.not. ok) return
      call set_free(model, held, free)
      x = model%layout%positions()
      trial = y
      last = huge(last)
      do i = 0, known_steps
         call model%evaluate(0.0_wp, trial, .false., ok)
         if (.not. ok) exit
         residual = unbalanced(model, trial, free)/reference_force(model)
         if (.not. residual < largest_share*last) exit
         y = trial
         last = residual
         call newton_step(stiffness, damping, forces(model, 0.0_wp, trial), free, newtons, step, ok)
         if (ok) ok = maxval(abs(step/clearances(model))) <= longest_move
         if (.not. ok) exit
         trial(x) = trial(x) + step
      end do
      ok = i > 1
   end subroutine take_known_steps

   !> The pad whose edge Newton's method would move most from the state y; 0 where there is none.
   integer function pad_that_moves(model, y) result(pad)
      type(machine_model), intent(inout) :: model
      real(wp), intent(in) :: y(:)
      real(wp), dimension(model%layout%n_positions(), model%layout%n_positions()) :: stiffness, damping
      real(wp), allocatable :: step(:)
      logical :: ok, free(model%layout%n_positions())
      integer, allocatable :: tilts(:)
      pad = 0
      tilts = model%layout%tilts()
      call model%evaluate(0.0_wp, y, .true., ok)
      if (.not. ok .or. size(tilts) == 0) return
      call static_derivatives(model, stiffness, damping)
      call set_free(model, free=free)
      call newton_step(stiffness, damping, forces(model, 0.0_wp, y), free, newtons, step, ok)
      if (.not. ok) return
      step = abs(step/clearances(model))
      pad = maxloc(step(tilts), 1)
   end function pad_that_moves
end module oil_change
