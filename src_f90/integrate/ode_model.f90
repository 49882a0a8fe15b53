!> What the march needs to know of a problem: y' = f(t, y), and its linear systems.
module ode_model
   use kinds, only: wp, i8
   use errors, only: error_type
   implicit none (type, external)
   private
   public :: ode_model_type, march_observer, march_statistics

   type :: march_statistics
      integer(i8) :: steps = 0, rhs_evaluations = 0, jacobian_evaluations = 0
      integer(i8) :: error_test_failures = 0, convergence_failures = 0
   end type march_statistics

   type, abstract :: ode_model_type
      !> Why the last evaluation was refused; not allocated after a good one.
      character(len=:), allocatable :: trouble
      !> How many quantities are sampled beside the states.
      integer :: outputs = 0
   contains
      procedure(right_hand_side), deferred :: rhs
      procedure(take_slopes), deferred :: linearize
      procedure(solve_system), deferred :: solve
      !> These quantities, from the last evaluation of the right-hand side or the slopes.
      procedure :: output
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

      !> Takes what `solve` needs of df/dy at (t, y).
      subroutine take_slopes(self, t, y, ok)
         import :: ode_model_type, wp
         class(ode_model_type), intent(inout) :: self
         real(wp), intent(in) :: t, y(:)
         logical, intent(out) :: ok
      end subroutine take_slopes

      !> b := (1 - gamma df/dy)^(-1) b with the slopes taken last; a model that knows parts of them better,
      !> from the right-hand side evaluated last, may use these. `ok = .false.`: no solution.
      subroutine solve_system(self, gamma, b, ok)
         import :: ode_model_type, wp
         class(ode_model_type), intent(inout) :: self
         real(wp), intent(in) :: gamma
         real(wp), intent(inout) :: b(:)
         logical, intent(out) :: ok
      end subroutine solve_system
   end interface

   !> Receives the samples of a march.
   type, abstract :: march_observer
      !> Set by the observer: the march has reached what it was for, and ends.
      logical :: satisfied = .false.
   contains
      procedure(take_sample), deferred :: sample
      procedure(take_progress), deferred :: report
      !> True where the observer wants the state in which the next step starts; asked before every step.
      procedure :: wants_state
      !> The state at time t, all samples up to it were given; setting `error` ends the march.
      procedure :: take_state
   end type march_observer

   abstract interface
      !> The state at a sample time, and the model's outputs; setting `error` ends the march.
      subroutine take_sample(self, t, y, output, error)
         import :: error_type, march_observer, wp
         class(march_observer), intent(inout) :: self
         real(wp), intent(in) :: t, y(:), output(:)
         type(error_type), allocatable, intent(out) :: error
      end subroutine take_sample

      !> Called now and then with the time reached and the steps done.
      subroutine take_progress(self, t, steps)
         import :: i8, march_observer, wp
         class(march_observer), intent(inout) :: self
         real(wp), intent(in) :: t
         integer(i8), intent(in) :: steps
      end subroutine take_progress
   end interface

contains

   pure function output(self)
      class(ode_model_type), intent(in) :: self
      real(wp) :: output(self%outputs)
      output = 0
   end function output

   logical function wants_state(self)
      class(march_observer), intent(in) :: self
      wants_state = .false.
   end function wants_state

   subroutine take_state(self, t, y, statistics, error)
      class(march_observer), intent(inout) :: self
      real(wp), intent(in) :: t, y(:)
      type(march_statistics), intent(in) :: statistics
      type(error_type), allocatable, intent(out) :: error
   end subroutine take_state

   function condition(self)
      class(ode_model_type), intent(in) :: self
      character(len=:), allocatable :: condition
      condition = ''
   end function condition
end module ode_model
