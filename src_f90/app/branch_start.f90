!> Where the branches of a run start: what the case asks for, the first orbit or equilibrium, or those of a checkpoint.
module branch_start
   use kinds, only: wp
   use errors, only: error_type, raise, add_context, system_error, stopped
   use text, only: to_text
   use scene_parameter, only: scene_parameter_type, find_parameter
   use equations_of_motion, only: bearing_model
   use static_model, only: make_fine, make_static
   use equilibrium, only: equilibrium_type, find_equilibrium
   use bearing_coefficients, only: settle
   use periodic_orbit, only: periodic_orbit_type, find_periodic_orbit
   use orbit_polynomials, only: orbit_type, points
   use newton_method, only: branch_problem_type, can_be_of
   use continuation, only: branch_options, return_to
   use varied_bearing, only: varied_bearing_type
   use bearing_orbits, only: bearing_orbits_type
   use warm_oil, only: has_warm_oil
   use resting_oil, only: new_resting_oil
   use orbit_problem, only: orbit_problem_type, begin_orbits
   use equilibrium_branch, only: equilibrium_problem_type, begin_equilibria
   use stop_signals, only: stop_requested, stop_reason
   use case_run, only: case_run_type
   use equilibrium_start, only: seek_equilibrium, note_equilibrium
   use march_start, only: make_start
   use march_settings, only: march_settings_of
   use branch_course, only: branch_course_type
   implicit none (type, external)
   private
   public :: branches_type, prepare, find_first, go_on

   !> The branches of a run: what is followed, and how far it has come.
   type :: branches_type
      type(scene_parameter_type) :: parameter
      type(branch_options) :: options
      !> Value of the case, and the size of the way from there.
      real(wp) :: first = 0, way = 0
      logical :: of_orbits = .true.
      type(orbit_problem_type) :: orbits
      type(equilibrium_problem_type) :: equilibria
      type(bearing_orbits_type) :: ode
      !> At rest: of equilibria, with converged films; of orbits with warm oil, for its viscosities.
      type(bearing_model) :: static
      type(branch_course_type) :: course
      !> Clock of the last checkpoint, s.
      real(wp) :: last_checkpoint = 0
   end type branches_type

   !> The largest step over the first, where the case leaves it open.
   real(wp), parameter :: usual_growth = 10

contains

   !> What follows from the case.
   subroutine prepare(run, b, error)
      type(case_run_type), intent(inout), target :: run
      type(branches_type), intent(inout) :: b
      type(error_type), allocatable, intent(out) :: error
      associate (given => run%scene%branch)
         call find_parameter(run%scene, given%parameter, b%parameter, error)
         if (allocated(error)) return
         b%first = b%parameter%value(run%scene)
         b%way = abs(given%last - b%first)
         b%of_orbits = given%of == 'periodic'
         b%options%low = min(given%last, b%first)
         b%options%high = max(given%last, b%first)
         b%options%first_step = abs(given%step)/b%way
         b%options%max_step = given%max_step/b%way
         if (.not. given%max_step > 0) b%options%max_step = usual_growth*b%options%first_step
         b%last_checkpoint = run%started
         if (.not. b%of_orbits) return
         b%options%tolerance = run%scene%periodic%tolerance
         b%ode%bearing%model => run%model
         b%ode%bearing%parameter = b%parameter
         b%ode%model => run%model
         ! for meshes alone, wherever the branch leads
         b%ode%march = march_settings_of(run%model, run%earlier%count('steps'))
      end associate
   end subroutine prepare

   !> Creates the file and finds the first orbit or equilibrium.
   subroutine find_first(run, b, error)
      type(case_run_type), intent(inout), target :: run
      type(branches_type), intent(inout), target :: b
      type(error_type), allocatable, intent(out) :: error
      if (b%of_orbits) then
         call first_orbit(run, b, error)
      else
         call first_equilibrium(run, b, error)
      end if
      allocate (b%course%special(0), b%course%flips(0))
      b%course%length = b%options%first_step
      b%course%ends = ''
      if (.not. allocated(error)) return
      if (error%status /= stopped) return
      ! nothing to go on from
      run%computed = .false.
      error%message = stop_reason()//' before the first point of the branch; nothing was written'
   end subroutine find_first

   !> The orbit that the motion from the start of the case leads to.
   subroutine first_orbit(run, b, error)
      type(case_run_type), intent(inout), target :: run
      type(branches_type), intent(inout), target :: b
      type(error_type), allocatable, intent(out) :: error
      type(periodic_orbit_type) :: found
      real(wp), allocatable :: y(:), at_rest(:)
      call make_start(run, y, error, at_rest)
      if (allocated(error)) return
      if (has_warm_oil(run%model)) call rest_oil(run, b, at_rest, error)
      if (allocated(error)) return
      call find_periodic_orbit(run%model, march_settings_of(run%model, run%earlier%count('steps'), y), y, found, error, &
         & stop_requested)
      run%counts = found%counts()
      if (.not. allocated(error)) call begin_orbits(b%orbits, b%ode, found%orbit, run%scene%periodic%revolutions, &
         & b%first, b%way)
   end subroutine first_orbit

   !> Gives the oil of the first orbit the viscosities of the equilibrium, from which those of the others follow.
   subroutine rest_oil(run, b, at_rest, error)
      type(case_run_type), intent(inout) :: run
      type(branches_type), intent(inout), target :: b
      !> Where the start is from it, the model has its viscosities already.
      real(wp), allocatable, intent(inout) :: at_rest(:)
      type(error_type), allocatable, intent(out) :: error
      type(equilibrium_type) :: static
      if (.not. allocated(at_rest)) then
         call find_equilibrium(run%model, static, error, stop_requested)
         call add_context(error, 'the oil takes the temperatures of the equilibrium')
         if (allocated(error)) return
         run%model%oil%viscosity = static%viscosity
         at_rest = run%model%at_rest(static%journal, static%tilt, static%penetration)
      end if
      call begin_oil(run%model, b, at_rest)
   end subroutine rest_oil

   subroutine begin_oil(model, b, at_rest)
      type(bearing_model), intent(in) :: model
      type(branches_type), intent(inout), target :: b
      real(wp), intent(in) :: at_rest(:)
      call make_static(model, model%point%rupture, b%static)
      b%ode%oil = new_resting_oil(varied_bearing_type(b%static, b%parameter), at_rest)
   end subroutine begin_oil

   !> The equilibrium of the case, with converged films.
   subroutine first_equilibrium(run, b, error)
      type(case_run_type), intent(inout) :: run
      type(branches_type), intent(inout), target :: b
      type(error_type), allocatable, intent(out) :: error
      type(equilibrium_type) :: static
      real(wp), allocatable :: y(:)
      call seek_equilibrium(run, static, error)
      if (allocated(error)) return
      call make_fine(run%model, b%static)
      call settle(b%static, static, y, error, stop_requested)
      call add_context(error, 'with converged films')
      if (allocated(error)) return
      call note_equilibrium(run, static)
      call begin_static(b, y)
   end subroutine first_equilibrium

   subroutine begin_static(b, y)
      type(branches_type), intent(inout), target :: b
      real(wp), intent(in) :: y(:)
      call begin_equilibria(b%equilibria, varied_bearing_type(b%static, b%parameter), y, b%first, b%way)
   end subroutine begin_static

   !> Takes the branches up where a checkpoint has left them.
   subroutine go_on(run, b, error)
      type(case_run_type), intent(inout) :: run
      type(branches_type), intent(inout), target :: b
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: numbers(:), at_rest(:)
      type(orbit_type) :: orbit
      real(wp) :: ignored
      logical :: ok
      run%earlier = run%statistics()
      call run%file%resume(ignored, numbers, run%earlier, error)
      if (allocated(error)) return
      run%computed = .true.
      allocate (at_rest(run%model%n), source=0.0_wp)
      if (b%of_orbits) then
         call orbit%set_mesh([0.0_wp, 1.0_wp], spread(spread(at_rest, 2, points), 3, 1))
         orbit%start = at_rest
         orbit%scale = run%model%scale
         if (has_warm_oil(run%model)) call begin_oil(run%model, b, at_rest)
         call begin_orbits(b%orbits, b%ode, orbit, 1, b%first, b%way)
      else
         call make_fine(run%model, b%static)
         call begin_static(b, at_rest)
      end if
      call b%course%unpack_from(numbers, ok)
      if (ok .and. b%of_orbits) call take_up(b%orbits, b%course, ok)
      if (ok .and. .not. b%of_orbits) call take_up(b%equilibria, b%course, ok)
      if (.not. ok) then
         call raise(error, system_error, run%path//': damaged: its checkpoint is none of this branch')
         return
      end if
      call run%file%file%get_text('branch_ends', b%course%ends)
      call run%file%error_of(error)
      if (allocated(error)) return
      if (.not. run%quiet) print '(a)', 'going on behind '//run%scene%branch%parameter//' = ' &
         & //to_text(b%course%here%parameter)//', point '//to_text(b%course%points)//' of branch ' &
         & //to_text(b%course%branch)
   end subroutine go_on

   !> Takes a problem to where its branch had come; `ok` is false where there is no such point.
   subroutine take_up(problem, course, ok)
      class(branch_problem_type), intent(inout) :: problem
      type(branch_course_type), intent(in) :: course
      logical, intent(out) :: ok
      type(error_type), allocatable :: refusal
      complex(wp), allocatable :: values(:)
      real(wp), allocatable :: growth(:)
      integer :: k
      ok = can_be_of(problem, course%here) .and. all([(can_be_of(problem, course%flips(k)), k=1, size(course%flips))])
      if (.not. ok) return
      call return_to(problem, course%here, refusal)
      ok = .not. allocated(refusal)
      if (ok) call problem%spectrum(values, growth, ok)
      if (ok) ok = size(growth) == size(course%here%growth)
   end subroutine take_up
end module branch_start
