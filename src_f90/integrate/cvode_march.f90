!> Marches an ode_model with CVODE (BDF, Newton). With sundials_context the only file that knows SUNDIALS.
module cvode_march
   use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_funloc, c_int, c_loc, c_long, c_ptr
   use fcvode_mod, only: fcvodecreate, fcvodeinit, fcvodesvtolerances, fcvodesetuserdata, &
      & fcvodesetlinearsolver, fcvodesetlinsysfn, fcvodesetlinearsolutionscaling, &
      & fcvodesetjacevalfrequency, fcvodesetlsetupfrequency, fcvodegetcurrentgamma, &
      & fcvodesetnonlinconvcoef, fcvodesetmaxstep, fcvodesetminstep, fcvodesetstoptime, &
      & fcvode, fcvodegetdky, fcvodefree, fcvodegetnumrhsevals, &
      & fcvodegetnumjacevals, fcvodegetnumerrtestfails, fcvodegetnumnonlinsolvconvfails, &
      & fcvodegetcurrentstep, fcvodegetlastorder, cv_bdf, cv_one_step, cv_err_failure, cv_conv_failure, &
      & cv_too_much_acc, cv_rhsfunc_fail, cv_first_rhsfunc_err, cv_reptd_rhsfunc_err, &
      & cv_unrec_rhsfunc_err, cv_lsetup_fail
   use sundials_context, only: index_kind, new_context, free_context, silence, n_vector, fn_vgetarraypointer, &
      & fn_vdestroy, sunmatrix, fsunmatdestroy, sunlinearsolver, sunlinearsolver_ops, sunlinearsolver_direct, &
      & fsunlinsolnewempty, fsunlinsolfreeempty
   use fnvector_serial_mod, only: fn_vmake_serial
   use fsunmatrix_dense_mod, only: fsundensematrix
   use kinds, only: wp, i8
   use text, only: to_text
   use errors, only: error_type, raise, numerics_error
   use ode_model, only: ode_model_type
   use march_observer, only: march_observer_type
   use integrator_counts, only: integrator_counts_type
   use step_history, only: step_history_type, new_step_history
   implicit none (type, external)
   private
   public :: march, march_options, sample_plan

   type :: march_options
      real(wp) :: relative_tolerance = 1e-6_wp
      !> Absolute tolerance of each state.
      real(wp), allocatable :: absolute_tolerance(:)
      !> Longest step, s; 0: no limit. Most steps before the march gives up.
      real(wp) :: max_step = 0
      integer(i8) :: max_steps = huge(1_i8)
      !> Tolerance of Newton's iteration over that of the error test.
      real(wp) :: newton_coefficient = 0.1_wp
   end type march_options

   !> When the observer sees the state: at first + k interval, k = 0 .. count - 1; those before `next` it has seen.
   type :: sample_plan
      real(wp) :: first = 0, interval = 0
      integer(i8) :: count = 0, next = 0
   contains
      procedure :: time => sample_time
   end type sample_plan

   !> What CVODE hands back to the callbacks.
   type :: user_data
      class(ode_model_type), pointer :: model => null()
      integer(index_kind) :: n
      type(c_ptr) :: memory
      !> Newton's last correction of the state.
      real(wp), allocatable :: correction(:)
   end type user_data

   !> Steps after which the slopes are taken anew (CVODE: 51): they are cheap, and fresh they save steps.
   integer(c_long), parameter :: slopes_age = 5
   !> Steps between two calls of the observer's report.
   integer(i8), parameter :: steps_per_report = 64

contains

   !> Time of sample k = 0, 1, ..., s.
   pure function sample_time(self, k) result(t)
      class(sample_plan), intent(in) :: self
      integer(i8), intent(in) :: k
      real(wp) :: t
      t = self%first + real(k, wp)*self%interval
   end function sample_time

   !> Marches y from t_start to t_end, or until the observer is satisfied. Samples are CVODE's interpolation,
   !> and the outputs' along with it: they never shorten a step, and nothing is evaluated for them. Numerics
   !> errors say why, where and when; samples taken before them stand.
   subroutine march(model, options, t_start, t_end, plan, y, observer, statistics, error)
      class(ode_model_type), intent(inout), target :: model
      type(march_options), intent(in) :: options
      real(wp), intent(in) :: t_start, t_end
      type(sample_plan), intent(in) :: plan
      !> State at t_start on entry, at the time reached on return.
      real(wp), intent(inout), contiguous, target :: y(:)
      class(march_observer_type), intent(inout) :: observer
      type(integrator_counts_type), intent(out) :: statistics
      type(error_type), allocatable, intent(out) :: error
      type(user_data), target :: user
      type(c_ptr) :: context, memory
      type(n_vector), pointer :: y_vector, sample_vector, tolerance_vector
      type(sunmatrix), pointer :: matrix
      type(sunlinearsolver), pointer :: linear_solver
      type(sunlinearsolver_ops), pointer :: operations
      real(wp), target :: sample(size(y)), tolerance(size(y))
      type(step_history_type) :: outputs
      real(c_double) :: t(1), sample_time
      integer(c_int) :: flag, order(1)
      integer(i8) :: k
      logical :: ok

      user%model => model
      user%n = size(y, kind=index_kind)
      allocate (user%correction(size(y)), source=0.0_wp)
      tolerance = options%absolute_tolerance
      context = new_context()
      memory = fcvodecreate(cv_bdf, context)
      y_vector => fn_vmake_serial(user%n, y, context)
      sample_vector => fn_vmake_serial(user%n, sample, context)
      tolerance_vector => fn_vmake_serial(user%n, tolerance, context)
      user%memory = memory
      ! the model keeps its matrix and solves; CVODE wants to see one all the same
      matrix => fsundensematrix(1_index_kind, 1_index_kind, context)
      linear_solver => fsunlinsolnewempty(context)
      linear_solver%content = c_loc(user)
      call c_f_pointer(linear_solver%ops, operations)
      operations%gettype = c_funloc(solver_type)
      operations%solve = c_funloc(solve_callback)
      flag = fcvodeinit(memory, c_funloc(rhs_callback), t_start, y_vector)
      call silence(context, memory)
      flag = fcvodesetuserdata(memory, c_loc(user))
      flag = fcvodesvtolerances(memory, options%relative_tolerance, tolerance_vector)
      flag = fcvodesetlinearsolver(memory, linear_solver, matrix)
      flag = fcvodesetlinsysfn(memory, c_funloc(linear_system_callback))
      ! the model solves with the gamma of the step
      flag = fcvodesetlinearsolutionscaling(memory, 0_c_int)
      flag = fcvodesetjacevalfrequency(memory, slopes_age)
      flag = fcvodesetlsetupfrequency(memory, slopes_age)
      flag = fcvodesetnonlinconvcoef(memory, options%newton_coefficient)
      flag = fcvodesetmaxstep(memory, options%max_step)
      ! shorter steps would not move the time
      flag = fcvodesetminstep(memory, epsilon(t_end)*t_end)
      flag = fcvodesetstoptime(memory, t_end)

      t = t_start
      k = plan%next
      order = 0
      call model%rhs(t_start, y, sample, ok)
      if (.not. ok) call raise(error, numerics_error, failure(cv_first_rhsfunc_err, model, memory, t_start, 0_i8))
      outputs = new_step_history(model%outputs)
      call outputs%add(t_start, model%output(user%correction))
      sample = y
      do
         do while (ok .and. k < plan%count)
            if (plan%time(k) > t(1) .and. t(1) < t_end) exit
            ! the last sample may lie a rounding error past the end
            sample_time = min(plan%time(k), t(1))
            if (statistics%steps > 0) flag = fcvodegetdky(memory, sample_time, 0_c_int, sample_vector)
            call observer%sample(sample_time, sample, outputs%at(sample_time, order(1)), error)
            if (allocated(error) .or. observer%satisfied) exit
            k = k + 1
         end do
         if (allocated(error) .or. observer%satisfied .or. t(1) >= t_end) exit
         if (observer%wants_state()) then
            call read_statistics(memory, statistics)
            call observer%take_state(t(1), y, statistics, error)
            if (allocated(error)) exit
         end if
         if (statistics%steps >= options%max_steps) then
            call raise(error, numerics_error, 'the march gave up at t = '//to_text(t(1))//' s, after ' &
               & //to_text(statistics%steps)//' steps (integration%max_steps)')
            exit
         end if
         if (allocated(model%refusal)) deallocate (model%refusal)
         flag = fcvode(memory, t_end, y_vector, t, cv_one_step)
         if (flag < 0) then
            call raise(error, numerics_error, failure(flag, model, memory, t(1), statistics%steps))
            exit
         end if
         statistics%steps = statistics%steps + 1
         flag = fcvodegetlastorder(memory, order)
         call outputs%add(t(1), model%output(user%correction))
         if (mod(statistics%steps, steps_per_report) == 0) call observer%report(t(1), statistics%steps)
      end do

      call read_statistics(memory, statistics)
      call fcvodefree(memory)
      call fsunlinsolfreeempty(linear_solver)
      call fsunmatdestroy(matrix)
      call fn_vdestroy(tolerance_vector)
      call fn_vdestroy(sample_vector)
      call fn_vdestroy(y_vector)
      call free_context(context)
   end subroutine march

   !> Says why, where and when a march ended early.
   function failure(flag, model, memory, t, steps) result(message)
      integer(c_int), intent(in) :: flag
      class(ode_model_type), intent(in) :: model
      type(c_ptr), intent(in) :: memory
      real(wp), intent(in) :: t
      integer(i8), intent(in) :: steps
      character(len=:), allocatable :: message, reason
      real(c_double) :: h(1)
      integer(c_int) :: ignored
      ignored = fcvodegetcurrentstep(memory, h)
      select case (flag)
      case (cv_err_failure)
         reason = 'the error test kept failing'
      case (cv_conv_failure)
         reason = 'the Newton iteration kept failing'
      case (cv_too_much_acc)
         reason = 'the tolerances are finer than the machine can resolve'
      case (cv_rhsfunc_fail, cv_first_rhsfunc_err, cv_reptd_rhsfunc_err, cv_unrec_rhsfunc_err, &
         & cv_lsetup_fail)
         reason = 'the equations of motion could not be evaluated'
      case default
         reason = 'CVODE gave up with code '//to_text(int(flag))
      end select
      if (allocated(model%refusal)) then
         reason = model%refusal//'; '//reason
      else if (model%warning() /= '') then
         reason = model%warning()//'; '//reason
      end if
      message = 'the march stopped at t = '//to_text(t)//' s, after '//to_text(steps)//' steps: '//reason &
         & //' (step size '//to_text(h(1))//' s)'
   end function failure

   subroutine read_statistics(memory, statistics)
      type(c_ptr), intent(in) :: memory
      type(integrator_counts_type), intent(inout) :: statistics
      integer(c_long) :: count(1)
      integer(c_int) :: flag
      flag = fcvodegetnumrhsevals(memory, count)
      statistics%rhs_evaluations = count(1)
      flag = fcvodegetnumjacevals(memory, count)
      statistics%jacobian_evaluations = count(1)
      flag = fcvodegetnumerrtestfails(memory, count)
      statistics%error_test_failures = count(1)
      flag = fcvodegetnumnonlinsolvconvfails(memory, count)
      statistics%convergence_failures = count(1)
   end subroutine read_statistics

   !> CVODE's right-hand side function: 0 good, 1 refused, try a shorter step.
   integer(c_int) function rhs_callback(t, y_vector, dydt_vector, user_pointer) bind(c)
      real(c_double), value :: t
      type(n_vector) :: y_vector, dydt_vector
      type(c_ptr), value :: user_pointer
      type(user_data), pointer :: user
      real(c_double), pointer :: y(:), dydt(:)
      logical :: ok
      call c_f_pointer(user_pointer, user)
      y(1:user%n) => fn_vgetarraypointer(y_vector)
      dydt(1:user%n) => fn_vgetarraypointer(dydt_vector)
      call user%model%rhs(t, y, dydt, ok)
      rhs_callback = merge(0_c_int, 1_c_int, ok)
   end function rhs_callback

   !> CVODE's set-up of the linear systems: new slopes, unless the last will do.
   integer(c_int) function linear_system_callback(t, y_vector, f_vector, matrix, slopes_will_do, slopes_are_new, &
      & gamma, user_pointer, work1, work2, work3) bind(c)
      real(c_double), value :: t, gamma
      type(n_vector) :: y_vector, f_vector, work1, work2, work3
      type(sunmatrix) :: matrix
      integer(c_int), value :: slopes_will_do
      integer(c_int) :: slopes_are_new
      type(c_ptr), value :: user_pointer
      type(user_data), pointer :: user
      real(c_double), pointer :: y(:)
      logical :: ok
      ok = .true.
      slopes_are_new = merge(0_c_int, 1_c_int, slopes_will_do /= 0)
      if (slopes_will_do == 0) then
         call c_f_pointer(user_pointer, user)
         y(1:user%n) => fn_vgetarraypointer(y_vector)
         call user%model%linearize(t, y, ok)
      end if
      linear_system_callback = merge(0_c_int, 1_c_int, ok)
   end function linear_system_callback

   integer(c_int) function solver_type(linear_solver) bind(c)
      type(sunlinearsolver) :: linear_solver
      solver_type = sunlinearsolver_direct
   end function solver_type

   !> CVODE's linear solver: x = (1 - gamma J)^(-1) b.
   integer(c_int) function solve_callback(linear_solver, matrix, x_vector, b_vector, tolerance) bind(c)
      type(sunlinearsolver) :: linear_solver
      type(sunmatrix) :: matrix
      type(n_vector) :: x_vector, b_vector
      real(c_double), value :: tolerance
      type(user_data), pointer :: user
      real(c_double), pointer :: x(:), b(:)
      real(c_double) :: gamma(1)
      integer(c_int) :: flag
      logical :: ok
      call c_f_pointer(linear_solver%content, user)
      x(1:user%n) => fn_vgetarraypointer(x_vector)
      b(1:user%n) => fn_vgetarraypointer(b_vector)
      flag = fcvodegetcurrentgamma(user%memory, gamma)
      x = b
      call user%model%solve(gamma(1), x, ok)
      user%correction = x
      solve_callback = merge(0_c_int, 1_c_int, ok)
   end function solve_callback
end module cvode_march
