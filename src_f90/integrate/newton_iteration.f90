!> Newton's iteration in a step of CVODE, with a test of what it leaves over.
!>
!> With derivatives of a step or two before, one correction solves nearly every step, and the mismatch of the state
!> that it leads to is not evaluated. Where derivatives change within an error tolerance, as those of a film whose
!> velocity is next to zero, such an iteration may come to a cycle of states that are no solutions. Now and then a
!> state is therefore tested before its step is accepted. Where the test fails, a damped iteration with the derivatives
!> of each iterate goes on from it, and the next steps are tested, too.
module newton_iteration
   use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_f_procpointer, c_funloc, c_funptr, c_int, c_loc, &
      & c_long, c_ptr
   use fcvode_mod, only: fcvodesetnonlinearsolver, fcvodegetcurrenttime
   use sundials_context, only: index_kind, n_vector, fn_vdestroy, sunnonlinearsolver, sunnonlinearsolver_ops, &
      & sunnonlinearsolver_rootfind, fsunnonlinsolnewempty, fsunnonlinsolfreeempty, sun_nls_conv_recvr
   use fnvector_serial_mod, only: fn_vmake_serial
   use vector_operations, only: use_own_operations, numbers, error_norm
   use kinds, only: wp, i8
   use ode_model, only: ode_model_type
   implicit none (type, external)
   private
   public :: newton_iteration_type

   !> Corrections before an iteration gives up, and the ratio to the one before at which it diverges; the part of its
   !> last rate of convergence that a new one is at least: those of CVODE.
   integer, parameter :: most_corrections = 3
   real(wp), parameter :: divergence = 2, kept_rate = 0.3_wp
   !> A mismatch, over the norm that the error test lets pass, from which on a state is refused: what CVODE's iteration
   !> leaves over by default.
   real(wp), parameter :: refused = 0.1_wp
   !> The mismatch at which a damped iteration ends, and at which states are no longer tested after it. Errors of this
   !> size do not keep CVODE from longer steps: at order 5 these need an error below 1.5**(-6)/6 = 0.015 in the test.
   real(wp), parameter :: solved = 0.01_wp
   !> Most steps from one test to the next. Their number is odd, as a cycle is mostly of an even number of steps.
   integer, parameter :: longest_trust = 255
   !> Steps that a failure of an iteration counts for between tests.
   integer, parameter :: failure_weight = 32
   !> Corrections of a damped iteration before it gives up.
   integer, parameter :: most_damped = 12

   !> What CVODE holds a pointer to: it must stay where it is, and must not be copied.
   type :: newton_iteration_type
      !> The last correction: it leads from the state evaluated last to the one accepted.
      real(wp), allocatable :: correction(:)
      !> Derivatives taken in damped iterations, which CVODE does not count.
      integer(i8) :: linearizations = 0
      class(ode_model_type), pointer, private :: model => null()
      type(sunnonlinearsolver), pointer, private :: solver => null()
      !> Of CVODE: the residual; derivatives where they are too old; the linear systems.
      procedure(residual_function), pointer, nopass, private :: evaluate => null()
      procedure(set_up_function), pointer, nopass, private :: set_up => null()
      procedure(solve_function), pointer, nopass, private :: solve_linear => null()
      !> The residual evaluated last; CVODE's vectors of it and of the correction.
      real(wp), allocatable, private :: residual(:)
      type(n_vector), pointer, private :: residual_vector => null(), correction_vector => null()
      !> The rate of convergence, and the norm of the correction before, as CVODE has them.
      real(wp), private :: rate = 1, before = 0
      !> Iterations that failed in the last step.
      integer, private :: failures = 0
      !> Steps since the last test, and from which of them on one is tested.
      integer, private :: steps = 0, trust = longest_trust
   contains
      procedure :: attach
      procedure :: free
   end type newton_iteration_type

   !> The equation of a step.
   type :: step_equation
      type(c_ptr) :: memory
      !> The correction of the predicted state so far.
      type(n_vector), pointer :: total_vector => null()
      real(wp), pointer, contiguous :: predicted(:) => null(), total(:) => null(), weights(:) => null()
      !> Norm of a correction that the error test lets pass.
      real(wp) :: passes
   end type step_equation

   abstract interface
      integer(c_int) function residual_function(total, residual, memory) bind(c)
         import :: c_int, c_ptr, n_vector
         type(n_vector) :: total, residual
         type(c_ptr), value :: memory
      end function residual_function

      integer(c_int) function set_up_function(is_bad, is_current, memory) bind(c)
         import :: c_int, c_ptr
         integer(c_int), value :: is_bad
         integer(c_int) :: is_current
         type(c_ptr), value :: memory
      end function set_up_function

      integer(c_int) function solve_function(vector, memory) bind(c)
         import :: c_int, c_ptr, n_vector
         type(n_vector) :: vector
         type(c_ptr), value :: memory
      end function solve_function
   end interface

contains

   !> Makes this the iteration of CVODE's steps of a model.
   subroutine attach(self, model, states, context, memory)
      class(newton_iteration_type), intent(inout), target :: self
      class(ode_model_type), intent(in), target :: model
      integer, intent(in) :: states
      type(c_ptr), intent(in) :: context, memory
      type(newton_iteration_type), pointer :: content
      type(sunnonlinearsolver_ops), pointer :: operations
      integer(c_int) :: flag
      self%model => model
      allocate (self%correction(states), self%residual(states), source=0.0_wp)
      self%correction_vector => fn_vmake_serial(int(states, index_kind), self%correction, context)
      self%residual_vector => fn_vmake_serial(int(states, index_kind), self%residual, context)
      call use_own_operations(self%residual_vector)
      call use_own_operations(self%correction_vector)
      self%solver => fsunnonlinsolnewempty(context)
      content => self
      self%solver%content = c_loc(content)
      call c_f_pointer(self%solver%ops, operations)
      operations%gettype = c_funloc(kind_of_solver)
      operations%setsysfn = c_funloc(take_residual)
      operations%setlsetupfn = c_funloc(take_set_up)
      operations%setlsolvefn = c_funloc(take_solve)
      operations%solve = c_funloc(solve_step)
      operations%getnumconvfails = c_funloc(failures_of_step)
      flag = fcvodesetnonlinearsolver(memory, self%solver)
   end subroutine attach

   subroutine free(self)
      class(newton_iteration_type), intent(inout) :: self
      call fsunnonlinsolfreeempty(self%solver)
      call fn_vdestroy(self%residual_vector)
      call fn_vdestroy(self%correction_vector)
   end subroutine free

   !> Solves the equation of a step; 0: done, > 0: try a shorter one.
   integer(c_int) function solve_step(solver, predicted, total, weights, passes, set_up_first, memory) bind(c) &
      & result(flag)
      type(sunnonlinearsolver) :: solver
      type(n_vector), target :: predicted, total, weights
      real(c_double), value :: passes
      integer(c_int), value :: set_up_first
      type(c_ptr), value :: memory
      type(newton_iteration_type), pointer :: self
      type(step_equation) :: equation
      call c_f_pointer(solver%content, self)
      equation = step_equation(memory, total, numbers(predicted), numbers(total), numbers(weights), passes)
      self%failures = 0
      call iterate(self, equation, set_up_first /= 0, flag)
      self%steps = self%steps + 1
      if (self%steps >= self%trust) then
         call test(self, equation, flag)
      else if (flag /= 0) then
         self%steps = self%steps + failure_weight
      end if
   end function solve_step

   !> CVODE's iteration: from the predicted state with the derivatives at hand, and again with new ones where it fails.
   subroutine iterate(self, equation, set_up_first, flag)
      type(newton_iteration_type), intent(inout) :: self
      type(step_equation), intent(in) :: equation
      logical, intent(in) :: set_up_first
      integer(c_int), intent(out) :: flag
      integer(c_int) :: is_current, is_bad
      is_current = 0
      is_bad = 0
      do
         flag = self%evaluate(equation%total_vector, self%residual_vector, equation%memory)
         if (flag == 0 .and. (set_up_first .or. is_bad /= 0)) then
            flag = self%set_up(is_bad, is_current, equation%memory)
            self%rate = 1
         end if
         if (flag /= 0) exit
         call correct_repeatedly(self, equation, flag)
         if (flag == 0) return
         if (flag < 0 .or. is_current /= 0) exit
         self%failures = self%failures + 1
         is_bad = 1
         equation%total = 0
      end do
      self%failures = self%failures + 1
   end subroutine iterate

   !> Corrects the state, whose residual is known, until what is left over passes CVODE's test.
   subroutine correct_repeatedly(self, equation, flag)
      type(newton_iteration_type), intent(inout) :: self
      type(step_equation), intent(in) :: equation
      integer(c_int), intent(out) :: flag
      real(wp) :: norm
      integer :: k
      do k = 1, most_corrections
         call find_correction(self, equation, norm, flag)
         if (flag /= 0) return
         equation%total = equation%total + self%correction
         if (k > 1) self%rate = max(kept_rate*self%rate, norm/self%before)
         if (norm*min(1.0_wp, self%rate)/equation%passes <= 1) return
         if (k > 1 .and. norm > divergence*self%before) exit
         self%before = norm
         if (k == most_corrections) exit
         flag = self%evaluate(equation%total_vector, self%residual_vector, equation%memory)
         if (flag /= 0) return
      end do
      flag = sun_nls_conv_recvr
   end subroutine correct_repeatedly

   !> The correction of the state whose residual was evaluated last, and its norm.
   subroutine find_correction(self, equation, norm, flag)
      type(newton_iteration_type), intent(inout) :: self
      type(step_equation), intent(in) :: equation
      real(wp), intent(out) :: norm
      integer(c_int), intent(out) :: flag
      self%correction(:) = -self%residual
      flag = self%solve_linear(self%correction_vector, equation%memory)
      norm = error_norm(self%correction, equation%weights)
   end subroutine find_correction

   !> Tests the state that an iteration has led to, and goes on from it where its mismatch is too large.
   subroutine test(self, equation, flag)
      type(newton_iteration_type), intent(inout) :: self
      type(step_equation), intent(in) :: equation
      integer(c_int), intent(inout) :: flag
      real(wp) :: mismatch
      logical :: passed
      if (flag == 0) then
         flag = self%evaluate(equation%total_vector, self%residual_vector, equation%memory)
         if (flag == 0) call find_correction(self, equation, mismatch, flag)
         if (flag /= 0) return
         passed = mismatch <= merge(refused, solved, self%trust == longest_trust)*equation%passes
      else
         if (flag /= sun_nls_conv_recvr) return
         equation%total = 0
         flag = self%evaluate(equation%total_vector, self%residual_vector, equation%memory)
         if (flag /= 0) return
         passed = .false.
      end if
      self%steps = 0
      if (passed) then
         self%trust = min(2*self%trust + 1, longest_trust)
      else
         self%trust = 1
         call iterate_damped(self, equation, flag)
      end if
   end subroutine test

   !> Newton's iteration with the derivatives of each iterate, from a state whose residual was evaluated last. It takes
   !> such parts of its corrections that residuals fall, and ends in a state whose mismatch is small.
   subroutine iterate_damped(self, equation, flag)
      type(newton_iteration_type), intent(inout) :: self
      type(step_equation), intent(in) :: equation
      integer(c_int), intent(out) :: flag
      real(wp), dimension(size(self%residual)) :: from, whole, residual
      real(wp) :: mismatch, left, part
      logical :: falls
      integer :: k
      do k = 1, most_damped
         call linearize(self, equation, flag)
         if (flag == 0) call find_correction(self, equation, mismatch, flag)
         if (flag < 0 .or. flag == 0 .and. mismatch <= solved*equation%passes) return
         if (flag /= 0) exit
         from = equation%total
         whole = self%correction
         residual = self%residual
         part = 2
         falls = .false.
         do while (.not. falls .and. part*mismatch > solved*equation%passes)
            part = part/2
            equation%total = from + part*whole
            flag = self%evaluate(equation%total_vector, self%residual_vector, equation%memory)
            if (flag == 0) call find_correction(self, equation, left, flag)
            if (flag < 0) return
            if (flag == 0) falls = left <= (1 - part/4)*mismatch .or. error_norm(self%residual, equation%weights) &
               & <= (1 - part/4)*error_norm(residual, equation%weights)
         end do
         if (falls) cycle
         if (flag == 0) call try_leap(self, equation, residual, flag)
         if (flag <= 0) return
         exit
      end do
      flag = sun_nls_conv_recvr
      self%failures = self%failures + 1
   end subroutine iterate_damped

   !> Where the residual does not fall in however small a part of a correction, forces may leap between its two ends. A
   !> mean of theirs then solves the equation (Filippov), and the state is known as closely as these ends lie together.
   subroutine try_leap(self, equation, other, flag)
      type(newton_iteration_type), intent(inout) :: self
      type(step_equation), intent(in) :: equation
      !> The residual at the other end.
      real(wp), intent(in) :: other(:)
      integer(c_int), intent(out) :: flag
      real(wp) :: leap(size(other)), share, mismatch
      leap = (other - self%residual)*equation%weights
      share = -dot_product(leap, self%residual*equation%weights)/dot_product(leap, leap)
      self%residual = self%residual + min(max(share, 0.0_wp), 1.0_wp)*(other - self%residual)
      call find_correction(self, equation, mismatch, flag)
      if (flag == 0 .and. mismatch > solved*equation%passes) flag = sun_nls_conv_recvr
   end subroutine try_leap

   !> Takes the derivatives at the state reached.
   subroutine linearize(self, equation, flag)
      type(newton_iteration_type), intent(inout) :: self
      type(step_equation), intent(in) :: equation
      integer(c_int), intent(out) :: flag
      real(c_double) :: t(1)
      logical :: ok
      flag = fcvodegetcurrenttime(equation%memory, t)
      call self%model%linearize(t(1), equation%predicted + equation%total, ok)
      flag = merge(0_c_int, sun_nls_conv_recvr, ok)
      self%linearizations = self%linearizations + 1
   end subroutine linearize

   integer(c_int) function kind_of_solver(solver) bind(c)
      type(sunnonlinearsolver) :: solver
      kind_of_solver = sunnonlinearsolver_rootfind
   end function kind_of_solver

   integer(c_int) function take_residual(solver, function) bind(c)
      type(sunnonlinearsolver) :: solver
      type(c_funptr), value :: function
      type(newton_iteration_type), pointer :: self
      call c_f_pointer(solver%content, self)
      call c_f_procpointer(function, self%evaluate)
      take_residual = 0
   end function take_residual

   integer(c_int) function take_set_up(solver, function) bind(c)
      type(sunnonlinearsolver) :: solver
      type(c_funptr), value :: function
      type(newton_iteration_type), pointer :: self
      call c_f_pointer(solver%content, self)
      call c_f_procpointer(function, self%set_up)
      take_set_up = 0
   end function take_set_up

   integer(c_int) function take_solve(solver, function) bind(c)
      type(sunnonlinearsolver) :: solver
      type(c_funptr), value :: function
      type(newton_iteration_type), pointer :: self
      call c_f_pointer(solver%content, self)
      call c_f_procpointer(function, self%solve_linear)
      take_solve = 0
   end function take_solve

   integer(c_int) function failures_of_step(solver, number) bind(c)
      type(sunnonlinearsolver) :: solver
      integer(c_long) :: number
      type(newton_iteration_type), pointer :: self
      call c_f_pointer(solver%content, self)
      number = self%failures
      failures_of_step = 0
   end function failures_of_step
end module newton_iteration
