!> Integrates an ode_model step by step with CVODE (BDF). It, newton_iteration, sundials_context and vector_operations
!> alone know SUNDIALS.
module cvode_integrator
   use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_funloc, c_int, c_loc, c_long, c_null_ptr, c_ptr
   use fcvode_mod, only: fcvodecreate, fcvodeinit, fcvodereinit, fcvodewftolerances, fcvodesetuserdata, &
      & fcvodesetlinearsolver, fcvodesetlinsysfn, fcvodesetlinearsolutionscaling, fcvodesetjacevalfrequency, &
      & fcvodesetlsetupfrequency, fcvodegetcurrentgamma, fcvodesetnonlinconvcoef, fcvodesetmaxord, &
      & fcvodesetmaxerrtestfails, fcvodesetmaxstep, fcvodesetminstep, fcvodesetstoptime, fcvode, fcvodefree, &
      & fcvodegetnumrhsevals, fcvodegetnumjacevals, fcvodegetnumerrtestfails, fcvodegetnumnonlinsolvconvfails, &
      & fcvodegetcurrentstep, fcvodegetlastorder, cv_bdf, cv_one_step, cv_first_rhsfunc_err
   use sundials_context, only: index_kind, new_context, free_context, silence, cvode_failure, n_vector, fn_vdestroy, &
      & sunmatrix, fsunmatdestroy, sunlinearsolver, sunlinearsolver_ops, sunlinearsolver_direct, fsunlinsolnewempty, &
      & fsunlinsolfreeempty
   use fnvector_serial_mod, only: fn_vmake_serial
   use vector_operations, only: use_own_operations, numbers
   use fsunmatrix_dense_mod, only: fsundensematrix
   use kinds, only: wp
   use text, only: to_text
   use errors, only: error_type, raise, numerics_error
   use ode_model, only: ode_model_type, integrator_counts_type
   use newton_iteration, only: newton_iteration_type
   implicit none (type, external)
   private
   public :: integrator_type, integrator_options, step_history_type, new_step_history

   !> Highest order of BDF, and so points kept beside the last.
   integer, parameter :: highest_order = 5

   type :: step_history_type
      real(wp) :: time(0:highest_order) = 0
      !> (value, point); the points follow each other round and round.
      real(wp), allocatable :: values(:, :)
      !> Where the last point stands, and how many there are.
      integer :: last = highest_order, points = 0
      !> Of the polynomial through the last point and this number of points before it, -1 where none is ready: one over
      !> the products of each point's distances from the others, and where the points stand, the last one first.
      integer, private :: degree = -1
      real(wp), private :: per_apart(0:highest_order)
      integer, private :: point(0:highest_order)
   contains
      procedure :: add
      procedure :: at
   end type step_history_type

   type :: next_stop_type
      !> When steps end, and from when on they go on, s: where the rates jump, steps end just before, as at the time
      !> itself the rates are those after the jump.
      real(wp) :: time = huge(1.0_wp), resumed = huge(1.0_wp)
      !> Whether the rates jump: what was before says nothing of what follows.
      logical :: anew = .false.
   contains
      procedure :: find
   end type next_stop_type

   type :: integrator_options
      real(wp) :: relative_tolerance = 1e-6_wp
      !> Absolute tolerance of each state.
      real(wp), allocatable :: absolute_tolerance(:)
      !> Longest step, s; 0: no limit.
      real(wp) :: max_step = 0
      !> Steps after which the derivatives are taken anew (CVODE: 51): they are cheap, and fresh they save steps.
      integer :: derivatives_age = 5
      !> Highest order of BDF.
      integer :: max_order = 5
      !> Whether the outputs of the model are wanted between the ends of steps.
      logical :: keeps_outputs = .true.
   end type integrator_options

   !> What CVODE holds pointers to, and hands back to the callbacks.
   type :: core_type
      class(ode_model_type), pointer :: model => null()
      type(c_ptr) :: context = c_null_ptr, memory = c_null_ptr
      type(n_vector), pointer :: y_vector => null()
      type(sunmatrix), pointer :: matrix => null()
      type(sunlinearsolver), pointer :: linear_solver => null()
      !> Time reached and last time, s; the state at the time reached.
      real(c_double) :: t(1) = 0, t_end = 0
      type(next_stop_type) :: stop
      real(wp), allocatable :: y(:)
      real(wp) :: relative_tolerance = 0
      !> Absolute tolerance of each state.
      real(wp), allocatable :: absolute_tolerance(:)
      type(newton_iteration_type) :: newton
      type(step_history_type) :: history
      logical :: keeps_outputs = .true.
      !> Order of the last step.
      integer(c_int) :: order(1) = 0
      type(integrator_counts_type) :: counts
   end type core_type

   !> One integration. It owns all it allocates, and must not be copied by assignment.
   type :: integrator_type
      type(core_type), pointer :: core => null()
   contains
      procedure :: start
      procedure :: step
      procedure :: time
      procedure :: state
      procedure :: interpolate
      procedure :: counts
      procedure :: finish
      final :: finish_last
   end type integrator_type

   !> Newton's iteration ends where its correction passes the error test (CVODE: 0.1 of it; docs/theory).
   real(c_double), parameter :: newton_coefficient = 1
   !> Failures of the error test in one step (CVODE: 7): enough to pass a small jump of the forces.
   integer(c_int), parameter :: max_failures = 20

contains

   !> Readies the integration of a model from state y at time t, s, to t_end > t at most. The model is kept as a
   !> pointer: it must be a target that lives until `finish`. A numerics error where it refuses the state.
   subroutine start(self, model, options, t, y, t_end, error)
      class(integrator_type), intent(inout) :: self
      class(ode_model_type), intent(inout), target :: model
      class(integrator_options), intent(in) :: options
      real(wp), intent(in) :: t, y(:), t_end
      type(error_type), allocatable, intent(out) :: error
      type(sunlinearsolver_ops), pointer :: operations
      integer(c_int) :: flag
      call self%finish()
      allocate (self%core)
      associate (core => self%core)
         core%model => model
         allocate (core%y, source=y)
         core%context = new_context()
         core%memory = fcvodecreate(cv_bdf, core%context)
         core%y_vector => fn_vmake_serial(size(y, kind=index_kind), core%y, core%context)
         call use_own_operations(core%y_vector)
         flag = fcvodeinit(core%memory, c_funloc(rhs_callback), t, core%y_vector)
         call silence(core%context, core%memory)
         flag = fcvodesetuserdata(core%memory, c_loc(core))
         core%relative_tolerance = options%relative_tolerance
         core%absolute_tolerance = options%absolute_tolerance
         core%keeps_outputs = options%keeps_outputs
         flag = fcvodewftolerances(core%memory, c_funloc(weights_callback))
         core%matrix => fsundensematrix(1_index_kind, 1_index_kind, core%context)
         core%linear_solver => fsunlinsolnewempty(core%context)
         core%linear_solver%content = c_loc(core)
         call c_f_pointer(core%linear_solver%ops, operations)
         operations%gettype = c_funloc(solver_type)
         operations%solve = c_funloc(solve_callback)
         flag = fcvodesetlinearsolver(core%memory, core%linear_solver, core%matrix)
         flag = fcvodesetlinsysfn(core%memory, c_funloc(linear_system_callback))
         ! the model keeps its matrix and solves with the gamma of the step
         flag = fcvodesetlinearsolutionscaling(core%memory, 0_c_int)
         flag = fcvodesetjacevalfrequency(core%memory, int(options%derivatives_age, c_long))
         flag = fcvodesetlsetupfrequency(core%memory, int(options%derivatives_age, c_long))
         call core%newton%attach(model, size(y), core%context, core%memory)
         flag = fcvodesetnonlinconvcoef(core%memory, newton_coefficient)
         flag = fcvodesetmaxord(core%memory, int(options%max_order, c_int))
         flag = fcvodesetmaxerrtestfails(core%memory, max_failures)
         ! CVODE takes its inverse; 0: no limit
         flag = fcvodesetmaxstep(core%memory, merge(max(options%max_step, tiny(t)), 0.0_wp, options%max_step > 0))
         core%t = t
         core%t_end = t_end
      end associate
      call begin(self%core, error)
   end subroutine start

   !> The first evaluation, once CVODE has the state y.
   subroutine begin(core, error)
      type(core_type), intent(inout) :: core
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: dydt(size(core%y))
      integer(c_int) :: flag
      logical :: ok
      ! shorter steps would not move the time
      flag = fcvodesetminstep(core%memory, epsilon(core%t_end)*core%t_end)
      core%order = 0
      call core%stop%find(core%model, core%t(1), core%t_end)
      ! what just precedes a jump is passed at the first step
      if (core%stop%time > core%t(1)) flag = fcvodesetstoptime(core%memory, core%stop%time)
      call core%model%rhs(core%t(1), core%y, dydt, ok)
      if (.not. ok) call raise(error, numerics_error, failure(core, cv_first_rhsfunc_err))
      core%history = new_step_history(size(core%y) + merge(core%model%outputs, 0, core%keeps_outputs))
      call note_end(core)
   end subroutine begin

   !> Goes on from a stop, anew or as before.
   subroutine pass_stop(self, error)
      class(integrator_type), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error
      integer(c_int) :: flag
      associate (core => self%core)
         if (core%stop%anew) then
            core%t = core%stop%resumed
            core%counts = self%counts()
            core%newton%linearizations = 0
            core%newton%correction = 0
            flag = fcvodereinit(core%memory, core%t(1), core%y_vector)
            call begin(core, error)
         else
            call core%stop%find(core%model, core%t(1), core%t_end)
            flag = fcvodesetstoptime(core%memory, core%stop%time)
         end if
      end associate
   end subroutine pass_stop

   !> Notes the end of a step, or the start.
   subroutine note_end(core)
      type(core_type), intent(inout) :: core
      real(wp) :: outputs(merge(core%model%outputs, 0, core%keeps_outputs))
      if (core%keeps_outputs) outputs = core%model%output(core%newton%correction)
      call core%history%add(core%t(1), core%y, outputs)
   end subroutine note_end

   !> Does one step, which ends at t_end at the latest. A numerics error says why there is none.
   subroutine step(self, error)
      class(integrator_type), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error
      integer(c_int) :: flag
      associate (core => self%core)
         if (allocated(core%model%refusal)) deallocate (core%model%refusal)
         if (core%t(1) >= core%stop%time .and. core%t(1) < core%t_end) call pass_stop(self, error)
         if (allocated(error)) return
         flag = fcvode(core%memory, core%t_end, core%y_vector, core%t, cv_one_step)
         if (flag < 0) then
            call raise(error, numerics_error, failure(core, flag))
            return
         end if
         core%counts%steps = core%counts%steps + 1
         flag = fcvodegetlastorder(core%memory, core%order)
         call note_end(core)
      end associate
   end subroutine step

   !> Time reached, s.
   pure real(wp) function time(self)
      class(integrator_type), intent(in) :: self
      time = self%core%t(1)
   end function time

   !> State at the time reached.
   pure function state(self)
      class(integrator_type), intent(in) :: self
      real(wp) :: state(size(self%core%y))
      state = self%core%y
   end function state

   !> States, then outputs of the model, as many as asked for, at a time t, s, in the last step. Nothing is evaluated.
   subroutine interpolate(self, t, values)
      class(integrator_type), intent(in) :: self
      real(wp), intent(in) :: t
      real(wp), intent(out), contiguous :: values(:)
      call self%core%history%at(t, self%core%order(1), values)
   end subroutine interpolate

   !> What the integration cost since its start; CVODE's own counts begin anew with it.
   type(integrator_counts_type) function counts(self)
      class(integrator_type), intent(in) :: self
      integer(c_long), dimension(1) :: rhs, jacobians, failures, divergences
      integer(c_int) :: flag
      flag = fcvodegetnumrhsevals(self%core%memory, rhs)
      flag = fcvodegetnumjacevals(self%core%memory, jacobians)
      flag = fcvodegetnumerrtestfails(self%core%memory, failures)
      flag = fcvodegetnumnonlinsolvconvfails(self%core%memory, divergences)
      counts = self%core%counts + integrator_counts_type(0, rhs(1), jacobians(1) + self%core%newton%linearizations, &
         & failures(1), divergences(1))
   end function counts

   !> Frees what the integration holds; the end of the variable's life does so too.
   subroutine finish(self)
      class(integrator_type), intent(inout) :: self
      if (.not. associated(self%core)) return
      associate (core => self%core)
         call fcvodefree(core%memory)
         call core%newton%free()
         call fsunlinsolfreeempty(core%linear_solver)
         call fsunmatdestroy(core%matrix)
         call fn_vdestroy(core%y_vector)
         call free_context(core%context)
      end associate
      deallocate (self%core)
   end subroutine finish

   subroutine finish_last(self)
      type(integrator_type), intent(inout) :: self
      call self%finish()
   end subroutine finish_last

   !> Says why there is no further step, from what CVODE returned.
   function failure(core, flag) result(reason)
      type(core_type), intent(in) :: core
      integer(c_int), intent(in) :: flag
      character(len=:), allocatable :: reason
      real(c_double) :: h(1)
      integer(c_int) :: ignored
      ignored = fcvodegetcurrentstep(core%memory, h)
      reason = cvode_failure(flag)
      if (allocated(core%model%refusal)) then
         reason = core%model%refusal//'; '//reason
      else if (core%model%warning() /= '') then
         reason = core%model%warning()//'; '//reason
      end if
      reason = reason//' (step size '//to_text(h(1))//' s)'
   end function failure

   !> CVODE's right-hand side function: 0 good, 1 refused, try a shorter step.
   integer(c_int) function rhs_callback(t, y_vector, dydt_vector, user_pointer) bind(c)
      real(c_double), value :: t
      type(n_vector) :: y_vector, dydt_vector
      type(c_ptr), value :: user_pointer
      type(core_type), pointer :: core
      real(c_double), pointer, contiguous :: dydt(:)
      logical :: ok
      call c_f_pointer(user_pointer, core)
      dydt => numbers(dydt_vector)
      call core%model%rhs(t, numbers(y_vector), dydt, ok)
      rhs_callback = merge(0_c_int, 1_c_int, ok)
   end function rhs_callback

   !> CVODE's error weights: what an error of each state is multiplied with, for the norm.
   integer(c_int) function weights_callback(y_vector, weights_vector, user_pointer) bind(c)
      type(n_vector) :: y_vector, weights_vector
      type(c_ptr), value :: user_pointer
      type(core_type), pointer :: core
      real(c_double), pointer, contiguous :: y(:), weights(:)
      integer :: i
      call c_f_pointer(user_pointer, core)
      y => numbers(y_vector)
      weights => numbers(weights_vector)
      associate (relative => core%relative_tolerance, absolute => core%absolute_tolerance)
         !$omp simd
         do i = 1, size(y)
            weights(i) = 1/(relative*abs(y(i)) + absolute(i))
         end do
      end associate
      weights_callback = 0
   end function weights_callback

   !> CVODE's set-up of the linear systems: new derivatives, unless the last are still good.
   integer(c_int) function linear_system_callback(t, y_vector, f_vector, matrix, still_good, are_new, gamma, &
      & user_pointer, work1, work2, work3) bind(c)
      real(c_double), value :: t, gamma
      type(n_vector) :: y_vector, f_vector, work1, work2, work3
      type(sunmatrix) :: matrix
      integer(c_int), value :: still_good
      integer(c_int) :: are_new
      type(c_ptr), value :: user_pointer
      type(core_type), pointer :: core
      logical :: ok
      call c_f_pointer(user_pointer, core)
      ok = .true.
      are_new = merge(0_c_int, 1_c_int, still_good /= 0)
      if (still_good == 0) call core%model%linearize(t, numbers(y_vector), ok)
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
      type(core_type), pointer :: core
      real(c_double), pointer, contiguous :: x(:), b(:)
      real(c_double) :: gamma(1)
      integer(c_int) :: flag
      logical :: ok
      call c_f_pointer(linear_solver%content, core)
      x => numbers(x_vector)
      b => numbers(b_vector)
      flag = fcvodegetcurrentgamma(core%memory, gamma)
      x(:) = b
      call core%model%solve(gamma(1), x, ok)
      solve_callback = merge(0_c_int, 1_c_int, ok)
   end function solve_callback

   ! States and outputs at the ends of the last steps, and between them.
   ! BDF's solution between steps is a polynomial of the step's order. The one through the last values, as many as the
   ! order and one, is as accurate, for the states as for quantities that follow from them.

   !> An empty history of a number of values.
   pure type(step_history_type) function new_step_history(n) result(history)
      integer, intent(in) :: n
      allocate (history%values(n, 0:highest_order), source=0.0_wp)
   end function new_step_history

   !> States and outputs, together as many as there are values, at the end of a step, later than all before.
   pure subroutine add(self, t, states, outputs)
      class(step_history_type), intent(inout) :: self
      real(wp), intent(in) :: t, states(:), outputs(:)
      self%last = modulo(self%last + 1, highest_order + 1)
      self%time(self%last) = t
      self%values(:size(states), self%last) = states
      self%values(size(states) + 1:, self%last) = outputs
      self%points = min(self%points, highest_order) + 1
      self%degree = -1
   end subroutine add

   !> Readies the polynomial of a degree.
   pure subroutine ready(self, degree)
      class(step_history_type), intent(inout) :: self
      integer, intent(in) :: degree
      real(wp) :: apart
      integer :: i, k
      self%degree = degree
      self%per_apart = 1
      do i = 0, degree
         self%point(i) = self%last - i
         if (self%point(i) < 0) self%point(i) = self%point(i) + highest_order + 1
         do k = 0, i - 1
            apart = self%time(self%point(k)) - self%time(self%point(i))
            self%per_apart(k) = self%per_apart(k)*apart
            self%per_apart(i) = -self%per_apart(i)*apart
         end do
      end do
      self%per_apart = 1/self%per_apart
   end subroutine ready

   !> Values at a time in the last step, which was of this order.
   pure subroutine at(self, t, order, values)
      class(step_history_type), intent(inout) :: self
      real(wp), intent(in) :: t
      integer, intent(in) :: order
      real(wp), intent(out), contiguous :: values(:)
      !> t less each point's time, s; products of these over all newer points, and over all older ones.
      real(wp), dimension(0:highest_order) :: back, weight
      real(wp) :: newer(0:highest_order + 1), older
      integer :: i, j, n
      n = min(order, self%points - 1)
      if (n /= self%degree) call ready(self, n)
      newer(0) = 1
      do i = 0, n
         back(i) = t - self%time(self%point(i))
         newer(i + 1) = newer(i)*back(i)
      end do
      weight = 0
      older = 1
      do i = n, 0, -1
         weight(self%point(i)) = newer(i)*older*self%per_apart(i)
         older = older*back(i)
      end do
      associate (w => weight, v => self%values)
         !$omp simd
         do j = 1, size(values)
            values(j) = w(0)*v(j, 0) + w(1)*v(j, 1) + w(2)*v(j, 2) + w(3)*v(j, 3) + w(4)*v(j, 4) + w(5)*v(j, 5)
         end do
      end associate
   end subroutine at

   ! Where the steps of an integration end next because its model switches.

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
end module cvode_integrator
