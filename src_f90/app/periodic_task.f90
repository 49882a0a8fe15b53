!> The task 'periodic': the orbit that the motion repeats, its stability, and its samples over one period.
module periodic_task
   use kinds, only: wp, i8, pi
   use text, only: to_text, fixed_text
   use errors, only: error_type, numerics_error, stopped
   use marching, only: march_options, sample_plan
   use periodic_orbit, only: periodic_orbit_type, orbit_options, find_periodic_orbit
   use periodic_results, only: put_periodic
   use stop_signals, only: stop_requested, stop_reason
   use case_run, only: case_run_type
   use march_start, only: make_start
   use march_task, only: record_march, tolerances
   implicit none (type, external)
   private
   public :: run_periodic

contains

   subroutine run_periodic(run, error)
      type(case_run_type), intent(inout), target :: run
      type(error_type), allocatable, intent(out) :: error
      type(periodic_orbit_type) :: found
      type(sample_plan) :: plan
      type(march_options) :: options
      real(wp), allocatable :: y(:)
      ! it takes no longer than reading what there is
      run%resumed = .false.
      call make_start(run, y, error)
      if (allocated(error)) return
      associate (p => run%scene%periodic, output => run%scene%output)
         options = tolerances(run, y)
         call find_periodic_orbit(run%model, options%integrator_options, orbit_options(p%revolutions, p%tolerance, &
            & p%max_iterations), y, found, error, stop_requested)
         if (allocated(error)) then
            if (error%status == stopped) error%message = stop_reason()//' while the periodic orbit was sought'
            return
         end if
         call put_periodic(run%file%file, found, p%revolutions)
         if (.not. run%quiet) call print_orbit(found, p%revolutions)
         plan = sample_plan(0.0_wp, found%period/(p%revolutions*output%samples_per_revolution), &
            & 1 + int(p%revolutions, i8)*output%samples_per_revolution, 0_i8)
         call run%file%begin_series('time')
         y = found%orbit%start
         call record_march(run, y, 0.0_wp, found%period, plan, error)
      end associate
   end subroutine run_periodic

   !> Period, stability and effort.
   subroutine print_orbit(found, revolutions)
      type(periodic_orbit_type), intent(in) :: found
      integer, intent(in) :: revolutions
      character(len=:), allocatable :: what
      what = 'unstable: '//found%loss()
      if (found%is_stable()) what = 'stable'
      associate (leading => found%multipliers(1))
         print '(a)', 'periodic orbit: period '//fixed_text(1e3_wp*found%period, 4)//' ms ('//to_text(revolutions) &
            & //merge(' revolution), ', ' revolutions),', revolutions == 1)//what//'; leading multiplier ' &
            & //fixed_text(leading%re, 6)//merge(' + ', ' - ', leading%im >= 0)//fixed_text(abs(leading%im), 6) &
            & //' i, modulus '//fixed_text(abs(leading), 6)
      end associate
      print '(a)', '  '//to_text(found%iterations)//' iterations on '//to_text(found%orbit%intervals()) &
         & //' intervals, after '//to_text(found%marched)//' periods of a march'
   end subroutine print_orbit
end module periodic_task
