!> The task 'branch': equilibria or periodic orbits over a number of the input, with the points where their stability
!> changes, and the branches of double period that begin there.
module branch_task
   use kinds, only: wp
   use text, only: to_text
   use errors, only: error_type, add_context, numerics_error, stopped
   use clock, only: wall_clock
   use newton_method, only: branch_problem_type, branch_point_type
   use continuation, only: start_branch, advance, return_to
   use special_points, only: special_point_type, find_special_points
   use orbit_problem, only: orbit_problem_type, turns_at
   use period_doubling, only: double_period
   use orbit_figures, only: orbit_figures_type, find_orbit_figures, figures_at_rest
   use heat_balance, only: oil_temperatures_type
   use warm_oil, only: has_warm_oil
   use branch_results, only: branch_orbit_type, begin_branches, add_point, put_special_points, noted
   use provenance, only: running
   use stop_signals, only: stop_requested, stop_reason
   use case_run, only: case_run_type
   use branch_start, only: branches_type, prepare, find_first, go_on
   use branch_summary, only: print_special_point, print_branch, branch_end
   implicit none (type, external)
   private
   public :: run_branch

   !> First step of a branch of double period over that of the first: it starts across the parameter.
   real(wp), parameter :: across = 0.3_wp
   !> How far behind the last point of a branch, over the first step, is looked for a reason of its end.
   real(wp), parameter :: near = 1e-2_wp
   !> Periods are doubled up to this many of the first branch's.
   integer, parameter :: longest_period = 8

contains

   subroutine run_branch(run, error)
      type(case_run_type), intent(inout), target :: run
      type(error_type), allocatable, intent(out) :: error
      type(branches_type), target :: b
      class(branch_problem_type), pointer :: problem
      logical :: more
      call prepare(run, b, error)
      problem => b%equilibria
      if (b%of_orbits) problem => b%orbits
      if (.not. allocated(error)) then
         if (run%resumed) then
            call go_on(run, b, error)
            if (.not. allocated(error)) call open_series(run, b)
         else
            call begin(run, b, problem, error)
         end if
      end if
      if (allocated(error)) return
      more = .true.
      do while (more)
         call follow(run, b, problem, error)
         if (allocated(error)) exit
         call begin_double(run, b, more)
      end do
      call bring_up_to_date(run, b)
      if (.not. allocated(error)) then
         if (.not. run%quiet) call print_branch(run%file, run%scene%branch%parameter, &
            & has_warm_oil(run%model))
      else if (error%status == stopped) then
         call stop_here(run, b, error)
      end if
   end subroutine run_branch

   !> The first point of the first branch.
   subroutine begin(run, b, problem, error)
      type(case_run_type), intent(inout), target :: run
      type(branches_type), intent(inout), target :: b
      class(branch_problem_type), intent(inout) :: problem
      type(error_type), allocatable, intent(out) :: error
      call find_first(run, b, error)
      if (allocated(error)) return
      call start_branch(problem, b%options, run%scene%branch%last > b%first, b%course%here, error)
      call add_context(error, 'the first point of the branch')
      if (allocated(error)) return
      call run%file%file%put_text('branch_of', run%scene%branch%of)
      call run%file%file%put_text('branch_parameter', run%scene%branch%parameter)
      call open_series(run, b)
      call record(run, b, b%course%here, error)
      b%course%points = 1
   end subroutine begin

   !> Readies the file for points.
   subroutine open_series(run, b)
      type(case_run_type), intent(inout) :: run
      type(branches_type), intent(in) :: b
      call begin_branches(run%file, b%of_orbits, merge(run%model%n, 2*run%model%layout%n_positions(), b%of_orbits))
      run%computed = .true.
   end subroutine open_series

   !> Brings the file up to what it has not as series: special points, ends of branches, counts.
   subroutine bring_up_to_date(run, b)
      type(case_run_type), intent(inout) :: run
      type(branches_type), intent(inout) :: b
      call put_special_points(run%file%file, b%course%special, b%parameter)
      call run%file%file%put_text('branch_ends', b%course%ends)
      associate (counts => run%counts, orbits => b%orbits)
         counts%rhs_evaluations = counts%rhs_evaluations + orbits%evaluations + orbits%tangents
         counts%jacobian_evaluations = counts%jacobian_evaluations + orbits%tangents
         orbits%evaluations = 0
         orbits%tangents = 0
      end associate
   end subroutine bring_up_to_date

   !> Follows a branch from where it is to its end.
   subroutine follow(run, b, problem, error)
      type(case_run_type), intent(inout) :: run
      type(branches_type), intent(inout) :: b
      class(branch_problem_type), intent(inout) :: problem
      type(error_type), allocatable, intent(out) :: error
      type(branch_point_type) :: next
      character(len=:), allocatable :: at_end
      real(wp), allocatable :: split(:)
      real(wp) :: length
      logical :: ends
      split = half_apart(b%orbits)
      associate (course => b%course, most => run%scene%branch%max_points)
         at_end = ''
         do while (at_end == '')
            length = course%length
            call advance(problem, b%options, course%here, length, next, ends, error, stop_requested)
            if (allocated(error)) then
               if (.not. problem%refused) call blame_oil(b, problem%refused, error)
               if (error%status == stopped .or. .not. problem%refused) exit
               at_end = 'there is nothing beyond: '//error%message
               deallocate (error)
               exit
            end if
            if (course%branch > 1 .and. course%points > 0) then
               if (dot_product(split, half_apart(b%orbits)) < 0) then
                  at_end = 'it comes back to the branch that it left'
                  call forget_flips(b, next)
                  exit
               end if
            end if
            call record_step(run, b, problem, next, error)
            if (allocated(error)) exit
            ! not before: a stop goes on from the point before, with its length
            course%length = length
            split = half_apart(b%orbits)
            if (ends) at_end = trim(merge('the first value', 'the last value ', abs(next%parameter - b%first) <= 0))
            if (course%points >= most .and. .not. ends) at_end = 'after '//to_text(most)//' points (branch%max_points)'
            if (at_end == '') call mind_checkpoint(run, b, error)
            if (allocated(error)) exit
         end do
         if (allocated(error)) then
            if (error%status == numerics_error) call add_context(error, 'branch '//to_text(course%branch) &
               & //' was lost behind '//run%scene%branch%parameter//' = '//to_text(course%here%parameter) &
               & //', its point '//to_text(course%points))
         else
            if (course%ends /= '') course%ends = course%ends//achar(10)
            course%ends = course%ends//branch_end(course%branch, run%scene%branch%parameter, course%here%parameter, &
               & at_end)
         end if
      end associate
   end subroutine follow

   !> A branch of orbits that is lost where the rest turns back from which its oil takes its viscosities has ended: near
   !> such a rest nothing is smooth over the parameter.
   subroutine blame_oil(b, ended, error)
      type(branches_type), intent(inout) :: b
      logical, intent(inout) :: ended
      type(error_type), allocatable, intent(inout) :: error
      type(error_type), allocatable :: without_rest
      if (error%status == stopped .or. .not. allocated(b%ode%oil)) return
      associate (here => b%course%here, step => b%options%first_step*b%orbits%unit)
         call b%ode%set(here%parameter + sign(near*step, here%tangent(size(here%tangent))), without_rest)
      end associate
      ended = allocated(without_rest)
      if (ended) call move_alloc(without_rest, error)
   end subroutine blame_oil

   !> Adds the next point to the file, and the special points before it.
   subroutine record_step(run, b, problem, next, error)
      type(case_run_type), intent(inout) :: run
      type(branches_type), intent(inout) :: b
      class(branch_problem_type), intent(inout) :: problem
      type(branch_point_type), intent(in) :: next
      type(error_type), allocatable, intent(out) :: error
      type(special_point_type), allocatable :: special(:)
      integer :: k
      associate (course => b%course)
         allocate (special(0))
         ! where a branch of double period begins a multiplier is 1
         if (course%points > 0) call find_special_points(problem, b%options, course%here, next, special, error, &
            & stop_requested)
         if (allocated(error)) return
         do k = 1, size(special)
            call return_to(problem, special(k)%point)
            call record(run, b, special(k)%point, error)
            if (allocated(error)) return
            course%special = [course%special, noted(run%file, course%branch, special(k))]
            if (.not. run%quiet) call print_special_point(special(k), run%scene%branch%parameter, &
               & has_warm_oil(run%model))
            if (special(k)%kind == 'flip' .and. run%scene%branch%switch == '.true.' .and. &
               & b%orbits%turns < longest_period*run%scene%periodic%revolutions) then
               course%flips = [course%flips, special(k)%point]
            end if
         end do
         if (size(special) > 0) call return_to(problem, next)
         course%here = next
         course%points = course%points + 1
         call record(run, b, next, error)
      end associate
   end subroutine record_step

   !> Adds a point to the file, at which the problem stands.
   subroutine record(run, b, point, error)
      type(case_run_type), intent(inout) :: run
      type(branches_type), intent(inout) :: b
      type(branch_point_type), intent(in) :: point
      type(error_type), allocatable, intent(out) :: error
      type(orbit_figures_type) :: figures
      type(oil_temperatures_type), allocatable :: oil
      real(wp), allocatable :: viscosity(:)
      if (has_warm_oil(run%model)) allocate (oil)
      associate (tilting => run%scene%tilting(), orbit => b%orbits%orbit)
         if (b%of_orbits) then
            call find_orbit_figures(run%model, orbit, b%orbits%turns, run%scene%output%samples_per_revolution, figures)
            if (allocated(oil)) call b%ode%oil%get_found(oil, viscosity)
            call add_point(run%file, b%course%branch, b%parameter, point, figures, tilting, error, oil, viscosity, &
               & branch_orbit_type(b%orbits%turns, orbit%intervals(), b%orbits%period()))
         else
            call figures_at_rest(b%static, b%equilibria%state(), figures)
            viscosity = b%equilibria%viscosity
            if (allocated(oil)) call b%equilibria%temperatures(oil)
            call add_point(run%file, b%course%branch, b%parameter, point, figures, tilting, error, oil, viscosity)
         end if
      end associate
      call run%file%beat(int(wall_clock() - run%started))
   end subroutine record

   !> By how much an orbit is elsewhere half a period later, in the measure of the branch: by nothing where it is that
   !> of half the period.
   pure function half_apart(problem)
      type(orbit_problem_type), intent(in) :: problem
      real(wp), allocatable :: half_apart(:)
      real(wp) :: y(problem%n)
      half_apart = [real(wp) ::]
      if (problem%n == 0) return
      associate (orbit => problem%orbit)
         call orbit%state_at(0.5_wp*orbit%time(orbit%intervals()), y)
         half_apart = problem%weight*(y - orbit%start)/orbit%scale
      end associate
   end function half_apart

   !> A branch of double period that ends at another flip need not be followed from there again.
   subroutine forget_flips(b, next)
      type(branches_type), intent(inout) :: b
      type(branch_point_type), intent(in) :: next
      real(wp) :: step
      integer :: k
      associate (course => b%course)
         step = abs(next%parameter - course%here%parameter)
         course%flips = pack(course%flips, [(abs(course%flips(k)%parameter - next%parameter) > 2*step &
            & .or. 2*turns_at(course%flips(k)) /= b%orbits%turns, k=1, size(course%flips))])
      end associate
   end subroutine forget_flips

   !> Goes to the start of the next branch of double period, if there are `more`.
   subroutine begin_double(run, b, more)
      type(case_run_type), intent(in) :: run
      type(branches_type), intent(inout) :: b
      logical, intent(out) :: more
      type(branch_point_type) :: flip
      more = .false.
      associate (course => b%course)
         do while (size(course%flips) > 0 .and. .not. more)
            flip = course%flips(1)
            course%flips = course%flips(2:)
            call double_period(b%orbits, flip, course%here, more)
         end do
         course%branch = course%branch + merge(1, 0, more)
         course%points = 0
         course%length = across*b%options%first_step
      end associate
      if (more .and. .not. run%quiet) print '(a)', 'branch '//to_text(b%course%branch)//': double period, from ' &
         & //run%scene%branch%parameter//' = '//to_text(b%course%here%parameter)
   end subroutine begin_double

   !> A checkpoint where it is time for one.
   subroutine mind_checkpoint(run, b, error)
      type(case_run_type), intent(inout) :: run
      type(branches_type), intent(inout) :: b
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: started
      started = wall_clock()
      associate (pause => run%scene%output%checkpoint_seconds)
         if (.not. pause > 0 .or. started - b%last_checkpoint < pause) return
      end associate
      call bring_up_to_date(run, b)
      call run%file%checkpoint(0.0_wp, b%course%packed(), run%statistics(), running, '', error)
      b%last_checkpoint = wall_clock()
      run%checkpoints = run%checkpoints + b%last_checkpoint - started
   end subroutine mind_checkpoint

   !> The last checkpoint, where a signal asks for the end.
   subroutine stop_here(run, b, error)
      type(case_run_type), intent(inout) :: run
      type(branches_type), intent(in) :: b
      type(error_type), allocatable, intent(inout) :: error
      type(error_type), allocatable :: file_error
      error%message = stop_reason()//' behind '//run%scene%branch%parameter//' = ' &
         & //to_text(b%course%here%parameter)//', point '//to_text(b%course%points)//' of branch ' &
         & //to_text(b%course%branch)
      call run%file%checkpoint(0.0_wp, b%course%packed(), run%statistics(), stopped, error%message, file_error)
      if (allocated(file_error)) call move_alloc(file_error, error)
   end subroutine stop_here
end module branch_task
