!> What the march needs to know of a problem: y' = f(t, y), its Jacobian, and the scale of each state.
module ode_model
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: ode_model_type, march_observer

   type, abstract :: ode_model_type
      !> Why the last evaluation was refused; not allocated after a good one.
      character(len=:), allocatable :: trouble
   contains
      procedure(right_hand_side), deferred :: rhs
      procedure(jacobian_matrix), deferred :: jacobian
      !> What is remarkable in the state evaluated last, for the message of a march that cannot go on.
      procedure :: condition
   end type ode_model_type

   abstract interface
      !> f(t, y). `ok = .false.` refuses the state (the step is then shortened) and sets `trouble`.
      subroutine right_hand_side(self, t, y, dydt, ok)
         import :: ode_model_type, wp
         class(ode_model_type), intent(inout) :: self
         real(wp), intent(in) :: t, y(:)
         real(wp), intent(out) :: dydt(:)
         logical, intent(out) :: ok
      end subroutine right_hand_side

      !> df/dy at (t, y).
      subroutine jacobian_matrix(self, t, y, matrix, ok)
         import :: ode_model_type, wp
         class(ode_model_type), intent(inout) :: self
         real(wp), intent(in) :: t, y(:)
         real(wp), intent(out) :: matrix(:, :)
         logical, intent(out) :: ok
      end subroutine jacobian_matrix
   end interface

   !> Receives the samples of a march.
   type, abstract :: march_observer
      !> Set by the observer: the march has reached what it was for, and ends.
      logical :: satisfied = .false.
   contains
      procedure(take_sample), deferred :: sample
      procedure(take_progress), deferred :: report
   end type march_observer

   abstract interface
      !> The state at a sample time; setting `error` ends the march.
      subroutine take_sample(self, t, y, error)
         use errors, only: error_type
         import :: march_observer, wp
         class(march_observer), intent(inout) :: self
         real(wp), intent(in) :: t, y(:)
         type(error_type), allocatable, intent(out) :: error
      end subroutine take_sample

      !> Called now and then with the time reached and the steps done.
      subroutine take_progress(self, t, steps)
         use kinds, only: i8
         import :: march_observer, wp
         class(march_observer), intent(inout) :: self
         real(wp), intent(in) :: t
         integer(i8), intent(in) :: steps
      end subroutine take_progress
   end interface

contains

   function condition(self)
      class(ode_model_type), intent(in) :: self
      character(len=:), allocatable :: condition
      condition = ''
   end function condition
end module ode_model
