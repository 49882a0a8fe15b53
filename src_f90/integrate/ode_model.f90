!> What an integrator needs to know of a problem, y' = f(t, y), with its derivatives and Newton's linear systems; and
!> what an integration cost.
module ode_model
   use kinds, only: wp, i8
   implicit none (type, external)
   private
   public :: ode_model_type, integrator_counts_type

   !> In procedures that may point to parts of the model it has the attribute target.
   type, abstract :: ode_model_type
      !> Number of states.
      integer :: n = 0
      !> Number of quantities that are sampled beside the states.
      integer :: outputs = 0
      !> Why the last evaluation was refused; not allocated after a good one.
      character(len=:), allocatable :: refusal
   contains
      procedure(right_hand_side), deferred :: rhs
      procedure(take_derivatives), deferred :: linearize
      procedure(solve_system), deferred :: solve
      procedure(right_hand_side_and_jacobian), deferred :: rhs_and_jacobian
      !> Which states are displacements, and which their rates.
      procedure :: pairs
      procedure :: blocks
      procedure :: switching_points
      procedure :: df_dt
      procedure :: next_switch
      !> The quantities sampled beside the states.
      procedure :: output
      !> What may soon stop the integration in the state evaluated last, for its message; else empty.
      procedure :: warning
   end type ode_model_type

   !> What an integration cost.
   type :: integrator_counts_type
      integer(i8) :: steps = 0, rhs_evaluations = 0, jacobian_evaluations = 0
      !> Steps that the error test refused; Newton iterations that failed.
      integer(i8) :: error_test_failures = 0, convergence_failures = 0
   contains
      procedure, private :: plus
      generic :: operator(+) => plus
   end type integrator_counts_type

   abstract interface
      !> f(t, y). `ok = .false.` refuses the state (the step is then shortened) and sets `refusal`.
      subroutine right_hand_side(self, t, y, dydt, ok)
         import :: ode_model_type, wp
         class(ode_model_type), intent(inout), target :: self
         real(wp), intent(in) :: t, y(:)
         real(wp), intent(out) :: dydt(:)
         logical, intent(out) :: ok
      end subroutine right_hand_side

      !> Takes what `solve` needs of J = df/dy at (t, y); refuses a state as `rhs` does.
      subroutine take_derivatives(self, t, y, ok)
         import :: ode_model_type, wp
         class(ode_model_type), intent(inout), target :: self
         real(wp), intent(in) :: t, y(:)
         logical, intent(out) :: ok
      end subroutine take_derivatives

      !> b := (1 - gamma J)^(-1) b with the derivatives taken last; a model that knows parts of them better,
      !> from the right-hand side evaluated last, may use these. `ok = .false.`: no solution.
      subroutine solve_system(self, gamma, b, ok)
         import :: ode_model_type, wp
         class(ode_model_type), intent(inout), target :: self
         real(wp), intent(in) :: gamma
         real(wp), intent(inout) :: b(:)
         logical, intent(out) :: ok
      end subroutine solve_system

      !> f(t, y) and the whole matrix J = df/dy there; refuses a state as `rhs` does.
      subroutine right_hand_side_and_jacobian(self, t, y, dydt, matrix, ok)
         import :: ode_model_type, wp
         class(ode_model_type), intent(inout), target :: self
         real(wp), intent(in) :: t, y(:)
         real(wp), intent(out) :: dydt(:), matrix(:, :)
         logical, intent(out) :: ok
      end subroutine right_hand_side_and_jacobian
   end interface

contains

   !> States x(i) and v(i) with x' = v.
   pure subroutine pairs(self, x, v)
      class(ode_model_type), intent(in) :: self
      integer, allocatable, intent(out) :: x(:), v(:)
      allocate (x(0), v(0))
   end subroutine pairs

   !> The last states form a number of blocks of one size: the rates of a block's states do not depend on other blocks.
   pure subroutine blocks(self, number, states)
      class(ode_model_type), intent(in) :: self
      integer, intent(out) :: number, states
      number = 0
      states = 0
   end subroutine blocks

   !> States and values of them at which the derivatives of the rates jump.
   pure subroutine switching_points(self, state, value)
      class(ode_model_type), intent(in) :: self
      integer, allocatable, intent(out) :: state(:)
      real(wp), allocatable, intent(out) :: value(:)
      allocate (state(0), value(0))
   end subroutine switching_points

   !> The derivatives of the rates over time, in a state that stays.
   pure function df_dt(self, t)
      class(ode_model_type), intent(in) :: self
      real(wp), intent(in) :: t
      real(wp) :: df_dt(self%n)
      df_dt = 0
   end function df_dt

   !> The first time after t, s, at which the rates jump, or (`jumps` is false) only their derivatives over time do;
   !> huge where there is none. At that time itself the rates are those after it.
   pure subroutine next_switch(self, t, next, jumps)
      class(ode_model_type), intent(in) :: self
      real(wp), intent(in) :: t
      real(wp), intent(out) :: next
      logical, intent(out) :: jumps
      next = huge(t)
      jumps = .false.
   end subroutine next_switch

   !> From the last evaluation, and to first order at the state that `correction` leads to from the state of that
   !> evaluation; 0: in that state itself.
   function output(self, correction)
      class(ode_model_type), intent(inout) :: self
      real(wp), intent(in) :: correction(:)
      real(wp) :: output(self%outputs)
      output = 0
   end function output

   function warning(self)
      class(ode_model_type), intent(in), target :: self
      character(len=:), allocatable :: warning
      warning = ''
   end function warning

   !> What two integrations cost, one after the other.
   elemental type(integrator_counts_type) function plus(self, other)
      class(integrator_counts_type), intent(in) :: self, other
      plus%steps = self%steps + other%steps
      plus%rhs_evaluations = self%rhs_evaluations + other%rhs_evaluations
      plus%jacobian_evaluations = self%jacobian_evaluations + other%jacobian_evaluations
      plus%error_test_failures = self%error_test_failures + other%error_test_failures
      plus%convergence_failures = self%convergence_failures + other%convergence_failures
   end function plus
end module ode_model
