!> The task 'march': from its start, or from a checkpoint, over the duration; samples and their spectra.
module march_task
   use kinds, only: wp, i8, pi
   use text, only: to_text
   use errors, only: error_type, raise, system_error, numerics_error
   use marching, only: march, march_options, sample_plan
   use integrator_counts, only: integrator_counts_type
   use spectra, only: one_sided_amplitude, full_amplitude
   use scene, only: scene_type
   use result_size, only: sample_interval, sample_count
   use run_file, only: run_file_type
   use march_results, only: put_spectrum, put_asperities
   use equations_of_motion, only: bearing_model
   use static_model, only: make_static
   use small_vibrations, only: has_light_modes
   use case_run, only: case_run_type
   use march_start, only: make_start, take_oil
   use recorder, only: recorder_type, begin_recording
   implicit none (type, external)
   private
   public :: run_march, continue_from_checkpoint, tolerances, write_spectra

   !> Steps after which the derivatives are taken anew without friction: the motion is smooth, the steps are long.
   integer, parameter :: smooth_derivatives_age = 2
   !> Absolute tolerances of rigid pivots over those of pivots that yield: without their damping the errors of the steps
   !> live longer.
   real(wp), parameter :: rigid_tolerance = 0.3_wp
   !> And with friction over those without: what its moment errs by is above what the states do.
   real(wp), parameter :: friction_tolerance = 0.5_wp

   !> Steps in a revolution from which on low orders are tried.
   real(wp), parameter :: many_steps = 1000

contains

   subroutine run_march(run, error)
      type(case_run_type), intent(inout), target :: run
      type(error_type), allocatable, intent(out) :: error
      type(recorder_type) :: observer
      type(sample_plan) :: plan
      type(integrator_counts_type) :: counts
      real(wp), allocatable :: y(:)
      real(wp) :: t
      if (run%resumed) then
         call continue_from_checkpoint(run, t, y, error)
      else
         t = 0
         call make_start(run, y, error)
      end if
      if (allocated(error)) return
      call run%file%begin_series('time', sample_count(run%scene))
      plan = planned(run)
      if (run%resumed) call check_samples(run, plan, t, error)
      if (allocated(error)) return
      call begin_recording(observer, run, t)
      call march(run%model, tolerances(run, y), t, run%scene%operation%duration, plan, y, observer, counts, error)
      run%counts = counts
      call observer%progress%clear()
      if (.not. allocated(error)) call write_spectra(run%scene, plan%interval, run%file)
      if (allocated(error)) then
         if (error%status /= numerics_error) return
      end if
      call put_asperities(run%file, plan%interval, norm2(run%model%point%load))
   end subroutine run_march

   !> State and time, s, of the checkpoint in the file.
   subroutine continue_from_checkpoint(run, t, y, error)
      type(case_run_type), intent(inout) :: run
      real(wp), intent(out) :: t
      real(wp), allocatable, intent(out) :: y(:)
      type(error_type), allocatable, intent(out) :: error
      allocate (y(run%model%n))
      run%earlier = run%statistics()
      call run%file%resume(t, y, run%earlier, error)
      if (.not. allocated(error)) call take_oil(run, error)
      if (allocated(error)) return
      run%computed = .true.
      if (.not. run%quiet) print '(a)', 'going on from t = '//to_text(t)//' s'
   end subroutine continue_from_checkpoint

   !> How to march from the state y.
   type(march_options) function tolerances(run, y) result(options)
      type(case_run_type), intent(in) :: run
      real(wp), intent(in) :: y(:)
      type(bearing_model) :: static
      associate (integration => run%scene%integration)
         options%relative_tolerance = integration%relative_tolerance
         options%absolute_tolerance = integration%relative_tolerance*integration%tolerance_scale*run%model%scale
         options%max_step = integration%max_step
         options%max_steps = integration%max_steps - run%earlier%count('steps')
         options%short_step = 2*pi/(run%scene%highest_speed()*many_steps)
      end associate
      associate (model => run%model, tolerance => options%absolute_tolerance)
         if (model%smooth()) options%derivatives_age = smooth_derivatives_age
         if (.not. model%layout%radial) then
            tolerance = rigid_tolerance*tolerance
         else if (.not. model%smooth()) then
            tolerance = friction_tolerance*tolerance
         end if
         call make_static(model, model%point%rupture, static)
         options%lowers_orders = has_light_modes(static, y, run%scene%highest_speed())
      end associate
   end function tolerances

   type(sample_plan) function planned(run) result(plan)
      type(case_run_type), intent(in) :: run
      associate (scene => run%scene)
         plan%first = scene%output%start_time
         plan%interval = sample_interval(scene)
         plan%count = sample_count(scene)
      end associate
      plan%next = run%file%samples()
   end function planned

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

   !> Spectra over the last whole revolutions of a run at constant speed; none where it was not sampled
   !> over one.
   subroutine write_spectra(scene, interval, file)
      type(scene_type), intent(in) :: scene
      !> Between samples, s.
      real(wp), intent(in) :: interval
      type(run_file_type), intent(inout) :: file
      real(wp), allocatable :: y(:, :), z(:, :), tilt(:, :), amplitudes(:, :)
      integer :: revolutions, n, i
      if (abs(scene%operation%final_speed_rpm - scene%operation%speed_rpm) > 0) return
      associate (samples => scene%output%samples_per_revolution)
         revolutions = int(min(int(scene%output%spectrum_revolutions, i8), (file%samples() - 1)/samples))
         n = revolutions*samples
      end associate
      if (revolutions == 0 .or. n < 2) return
      call file%last_samples('journal_y', n, y)
      call file%last_samples('journal_z', n, z)
      if (scene%tilting()) then
         call file%last_samples('pad_tilt', n, tilt)
         allocate (amplitudes(n/2 + 1, scene%pad_count()))
         do i = 1, scene%pad_count()
            amplitudes(:, i) = one_sided_amplitude(tilt(i, :))
         end do
      end if
      call put_spectrum(file%file, interval, revolutions, scene%highest_speed(), one_sided_amplitude(y(1, :)), &
         & one_sided_amplitude(z(1, :)), full_amplitude(cmplx(y(1, :), z(1, :), wp)), amplitudes)
   end subroutine write_spectra
end module march_task
