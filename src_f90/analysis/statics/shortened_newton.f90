!> Newton's method alone, its steps shortened where they go too far or make nothing better: for rests that the motion
!> without inertia leaves, such as that of pads which pull, or which balance with the journal but not alone.
module shortened_newton
   use kinds, only: wp
   use errors, only: asked_to_stop, asked
   use lapack, only: dgesv
   use equations_of_motion, only: bearing_model
   use force_balance, only: forces, force_derivatives
   use damped_newton, only: unbalanced, reference_force, clearances, longest_move, residual_limit
   implicit none (type, external)
   private
   public :: shorten_newton

   integer, parameter :: max_iterations = 60
   !> Halvings of a step after which it is taken for better or worse, and after which there is none.
   integer, parameter :: patience = 8, max_halvings = 20

contains

   !> Moves y to rest; `ok` is false where it does not come there, or `give_up` says so.
   subroutine shorten_newton(model, y, ok, give_up)
      type(bearing_model), intent(inout) :: model
      real(wp), intent(inout) :: y(:)
      logical, intent(out) :: ok
      procedure(asked_to_stop), optional :: give_up
      real(wp), dimension(model%layout%n_positions(), model%layout%n_positions()) :: stiffness, damping
      real(wp) :: step(model%layout%n_positions()), force
      integer :: iteration, pivots(size(step)), info
      do iteration = 0, max_iterations
         call model%evaluate(0.0_wp, y, .true., ok)
         if (.not. ok) return
         force = unbalanced(model)
         ok = force <= residual_limit*reference_force(model)
         if (ok .or. iteration == max_iterations) return
         if (asked(give_up)) return
         call force_derivatives(model, stiffness, damping)
         step = -forces(model, 0.0_wp)
         call dgesv(size(step), 1, stiffness, size(step), pivots, step, size(step), info)
         if (info /= 0) return
         step = step*min(1.0_wp, longest_move/max(maxval(abs(step/clearances(model))), longest_move))
         call take_part(model, force, step, y, ok)
         if (.not. ok) return
      end do
   end subroutine shorten_newton

   !> Moves y by the step, halved until the films are open there and the unbalanced force falls; `ok` is false where
   !> they are not.
   subroutine take_part(model, force, step, y, ok)
      type(bearing_model), intent(inout) :: model
      real(wp), intent(in) :: force, step(:)
      real(wp), intent(inout) :: y(:)
      logical, intent(out) :: ok
      real(wp) :: trial(size(y))
      integer, allocatable :: x(:)
      integer :: halvings
      x = model%layout%positions()
      do halvings = 0, max_halvings
         trial = y
         trial(x) = y(x) + step/2**halvings
         call model%evaluate(0.0_wp, trial, .false., ok)
         if (.not. ok) cycle
         if (unbalanced(model) < force .or. halvings >= patience) exit
      end do
      if (ok) y = trial
   end subroutine take_part
end module shortened_newton
