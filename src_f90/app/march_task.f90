!> The task 'march': from its start, or from a checkpoint, over the duration; samples and their spectra.
module march_task
   use kinds, only: wp
   use errors, only: error_type, raise, system_error
   use marching, only: march, sample_plan
   use ode_model, only: integrator_counts_type
   use result_size, only: sample_interval, sample_count
   use case_run, only: case_run_type
   use march_settings, only: march_settings_of, has_light_vibrations
   use run_start, only: make_start, continue_from_checkpoint
   use recorder, only: recorder_type, begin_recording
   implicit none (type, external)
   private
   public :: run_march

contains

   subroutine run_march(run, error)
      type(case_run_type), intent(inout), target :: run
      type(error_type), allocatable, intent(out) :: error
      type(recorder_type) :: observer
      type(sample_plan) :: plan
      type(integrator_counts_type) :: counts
      real(wp), allocatable :: y(:)
      real(wp) :: t
      integer :: b
      logical :: light
      if (run%resumed) then
         call continue_from_checkpoint(run, t, y, error)
      else
         t = 0
         call make_start(run, y, error)
      end if
      if (allocated(error)) return
      call run%file%begin_series('time', sample_count(run%inputs))
      plan = sample_plan(run%inputs%output%start_time, sample_interval(run%inputs), sample_count(run%inputs), &
         & run%file%hdf5%samples)
      if (run%resumed) then
         do b = 1, size(run%extremes)
            call run%extremes(b)%read(run%bearing(b), plan%interval)
         end do
         call check_samples(run, plan, t, error)
      end if
      if (allocated(error)) return
      call begin_recording(observer, run, t)
      light = .false.
      if (run%model%rotor%is_identity) light = has_light_vibrations(run%model, t, y)
      call march(run%model, march_settings_of(run%model, run%earlier_steps(), light), t, &
         & run%inputs%operation%duration, plan, y, observer, counts, error)
      run%counts = counts
      call observer%progress%clear()
      if (.not. allocated(error)) call observer%put_spectra(plan%interval)
   end subroutine run_march

   !> Refuses a file whose samples end elsewhere than its checkpoint at time t, s, says.
   subroutine check_samples(run, plan, t, error)
      type(case_run_type), intent(in) :: run
      type(sample_plan), intent(in) :: plan
      real(wp), intent(in) :: t
      type(error_type), allocatable, intent(out) :: error
      call run%file%error_of(error)
      if (allocated(error) .or. plan%next == 0) return
      if (plan%time(plan%next - 1) > t .or. plan%time(plan%next) <= t) call raise(error, system_error, &
         & run%path//': damaged: its samples and its checkpoint do not fit')
   end subroutine check_samples
end module march_task
