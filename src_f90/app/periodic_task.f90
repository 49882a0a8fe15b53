!> The task 'periodic': the orbit that the motion repeats, its stability, and its samples over one period.
module periodic_task
   use kinds, only: wp, i8
   use text, only: to_text, filled
   use errors, only: error_type, raise, stopped, numerics_error
   use marching, only: sample_plan
   use periodic_orbit, only: periodic_orbit_type, find_periodic_orbit, are_stable, loss_of_stability
   use orbit_refinement, only: allowed_error
   use march_results, only: put_periodic
   use result_remarks, only: not_closed
   use stop_signals, only: stop_reason
   use case_run, only: case_run_type
   use march_settings, only: march_settings_of
   use run_start, only: make_start, continue_from_checkpoint
   use recorder, only: recorder_type, begin_recording
   implicit none (type, external)
   private
   public :: run_periodic

contains

   subroutine run_periodic(run, error)
      type(case_run_type), intent(inout), target :: run
      type(error_type), allocatable, intent(out) :: error
      type(periodic_orbit_type) :: found
      real(wp), allocatable :: y(:)
      real(wp) :: t
      if (run%resumed) then
         call continue_from_checkpoint(run, t, y, error)
      else
         call make_start(run, y, error)
      end if
      if (allocated(error)) return
      call find_periodic_orbit(run%model, march_settings_of(run%model, run%earlier_steps()), y, found, error)
      run%counts = found%counts()
      if (allocated(error)) then
         if (error%status /= stopped) return
         ! the state to which the march or Newton's method had come
         error%message = stop_reason()//' while the periodic orbit was sought'
         call run%stop_here(0.0_wp, error, found%orbit%start)
         return
      end if
      call put_periodic(run%file, found, run%inputs%periodic%revolutions)
      if (.not. run%quiet) call print_orbit(found, run%inputs%periodic%revolutions)
      call record_orbit(run, found, error)
   end subroutine run_periodic

   !> Samples of the orbit over its period, and their spectra.
   subroutine record_orbit(run, found, error)
      type(case_run_type), intent(inout), target :: run
      type(periodic_orbit_type), intent(in) :: found
      type(error_type), allocatable, intent(out) :: error
      type(recorder_type) :: observer
      type(sample_plan) :: plan
      real(wp) :: y(run%model%n), none(run%model%n), t
      integer(i8) :: k
      logical :: ok
      none = 0
      plan%count = 1 + int(run%inputs%periodic%revolutions, i8)*run%inputs%output%samples_per_revolution
      plan%interval = found%period/(plan%count - 1)
      call run%file%begin_series('time', plan%count)
      call begin_recording(observer, run, 0.0_wp)
      do k = 0, plan%count - 1
         t = min(plan%time(k), found%period)
         call found%orbit%state_at(t, y)
         call run%model%evaluate(t, y, .false., ok)
         if (.not. ok) then
            call raise(error, numerics_error, 'at t = '//to_text(t)//' s of the periodic orbit: '//run%model%refusal)
            return
         end if
         call observer%sample(t, y, run%model%output(none), error)
         if (allocated(error)) return
      end do
      call observer%put_spectra(plan%interval)
   end subroutine record_orbit

   !> Period, stability and effort.
   subroutine print_orbit(found, revolutions)
      type(periodic_orbit_type), intent(in) :: found
      integer, intent(in) :: revolutions
      character(len=:), allocatable :: what
      what = 'unstable: '//loss_of_stability(found%multipliers)
      if (are_stable(found%multipliers)) what = 'stable'
      if (.not. found%closed) what = 'a march repeats it'
      associate (leading => found%multipliers(1), error => found%errors(1))
         print '(a)', filled('periodic orbit: period {m.4} ms ({} '//trim(merge('revolution), ', 'revolutions),', &
            & revolutions == 1))//' '//what//'; leading multiplier {.4}'//merge(' + ', ' - ', leading%im >= 0) &
            & //'{.4} i, modulus {.5}', [real(wp) :: found%period, revolutions, leading%re, abs(leading%im), &
            & abs(leading)])
         print '(a)', filled('  {i} iterations on {i} intervals, after {i} periods of a march; the multiplier errs ' &
            & //'by at most {}', [real(wp) :: found%iterations, found%orbit%intervals(), found%marched, error])
         if (error > allowed_error(leading)) print '(a)', '  the leading multiplier is not known better: shorter ' &
            & //'intervals still change it'
      end associate
      if (.not. found%closed) print '(a)', '  '//filled(not_closed, [found%change])
   end subroutine print_orbit
end module periodic_task
