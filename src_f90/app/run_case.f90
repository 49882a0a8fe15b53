!> A run from scene to result file: equilibrium, march, spectra, key figures.
module run_case
   use kinds, only: wp, i8, pi
   use text, only: to_text
   use errors, only: error_type, raise, numerics_error, system_error, stopped
   use integrator_counts, only: integrator_counts_type
   use marching, only: march, march_options, sample_plan
   use spectra, only: one_sided_amplitude, full_amplitude
   use scene, only: scene_type
   use sweep, only: member_tag
   use equations_of_motion, only: bearing_model, new_bearing_model
   use equilibrium, only: equilibrium_type, find_equilibrium
   use namelist_writer, only: scene_text
   use run_file, only: run_file_type
   use restart, only: restart_type, read_restart, refuse_other_scene
   use recorder, only: recorder_type, init_recorder
   use run_summary, only: print_equilibrium, print_march
   use progress, only: new_progress
   use signals, only: stop_requested, stop_reason
   implicit none (type, external)
   private
   public :: run_scene

   !> Without friction the motion is smooth and the steps are long; the error of Newton's iteration then shows
   !> in the orbit at CVODE's 0.1 (measured, docs/benchmarks.md).
   real(wp), parameter :: smooth_newton_coefficient = 0.02_wp

contains

   !> Runs a valid scene and writes its result file. On a numerics error the file holds what was computed and is
   !> marked incomplete. With `go_on` a result of the same scene that is there already is completed, from its
   !> checkpoint. `tag` says which member of a sweep it is, if any.
   subroutine run_scene(scene, path, tag, go_on, quiet, error)
      type(scene_type), intent(in) :: scene
      character(len=*), intent(in) :: path
      type(member_tag), intent(in) :: tag
      logical, intent(in) :: go_on, quiet
      type(error_type), allocatable, intent(out) :: error
      type(recorder_type), target :: observer
      type(bearing_model), target :: model
      type(restart_type) :: found
      type(integrator_counts_type) :: statistics
      real(wp), allocatable :: y(:)
      real(wp) :: t
      logical :: there

      call init_recorder(observer)
      call observer%file%claim(path, error)
      if (allocated(error)) return
      if (.not. quiet .and. observer%file%taken_from() /= '') print '(a)', path//': ' &
         & //observer%file%taken_from()//', which wrote it, is no more'
      there = .false.
      if (go_on) inquire (file=path, exist=there)
      if (there) then
         call read_restart(path, found, error)
         if (.not. allocated(error)) call refuse_other_scene(path, scene, tag, found, error)
         if (allocated(error) .or. found%complete) then
            call observer%file%abandon()
            if (found%complete .and. .not. allocated(error) .and. .not. quiet) print '(a)', path &
               & //': complete already, nothing to do'
            return
         end if
      end if
      model = new_bearing_model(scene)
      if (there) then
         allocate (y(model%n))
         call observer%file%resume(t, y, observer%earlier, error)
         if (.not. allocated(error) .and. .not. quiet) print '(a)', 'going on from t = '//to_text(t)//' s'
      else
         call start(scene, tag, model, observer, quiet, t, y, error)
      end if
      if (allocated(error)) return
      if (scene%about%task == 'march') call march_scene(model, path, observer, t, y, statistics, quiet, error)
      call end_run(scene, path, observer, statistics, quiet, error)
   end subroutine run_scene

   !> Creates the file, finds the equilibrium, and starts from there.
   subroutine start(scene, tag, model, observer, quiet, t, y, error)
      type(scene_type), intent(in) :: scene
      type(member_tag), intent(in) :: tag
      type(bearing_model), intent(in) :: model
      type(recorder_type), intent(inout) :: observer
      logical, intent(in) :: quiet
      real(wp), intent(out) :: t
      real(wp), allocatable, intent(out) :: y(:)
      type(error_type), allocatable, intent(out) :: error
      type(equilibrium_type) :: static
      type(error_type), allocatable :: file_error
      t = 0
      call observer%file%create(scene, scene_text(scene), error)
      if (allocated(error)) return
      if (tag%number > 0) call observer%file%put_member(tag%number, tag%members, tag%sweep)
      call find_equilibrium(scene, static, error, model%contact, stop_requested)
      if (allocated(error)) then
         if (error%status == stopped) then
            error%message = stop_reason()//' before the march; nothing was computed yet'
         else if (tag%number > 0) then
            ! of a member of a sweep the file says what happened; nothing else would be a result
            call observer%file%finish(t, observer%cost(integrator_counts_type()), error%status, &
               & error%message, file_error)
         end if
         call observer%file%abandon()
         return
      end if
      call observer%file%put_equilibrium(static, scene%tilting_radial())
      if (.not. quiet) call print_equilibrium(static)
      y = model%at_rest(static%journal, static%tilt, static%penetration)
   end subroutine start

   !> Marches from the state y at time t, s; `path`, the result file, is for messages.
   subroutine march_scene(model, path, observer, t, y, statistics, quiet, error)
      type(bearing_model), intent(inout), target :: model
      character(len=*), intent(in) :: path
      type(recorder_type), intent(inout) :: observer
      real(wp), intent(in) :: t
      real(wp), intent(inout), contiguous :: y(:)
      type(integrator_counts_type), intent(out) :: statistics
      logical, intent(in) :: quiet
      type(error_type), allocatable, intent(out) :: error
      type(march_options) :: options
      type(sample_plan) :: plan

      associate (scene => model%scene)
         observer%model = model
         observer%marched => model
         observer%progress = new_progress(t, scene%operation%duration, quiet)
         if (scene%integration%stop_when_periodic > 0) call observer%follow_orbit()
         options%relative_tolerance = scene%integration%relative_tolerance
         options%absolute_tolerance = scene%integration%relative_tolerance*scene%integration%tolerance_scale*model%scale
         options%max_step = scene%integration%max_step
         options%max_steps = scene%integration%max_steps - observer%earlier%steps
         if (scene%friction%model == 'none') options%newton_coefficient = smooth_newton_coefficient
         plan%first = scene%output%start_time
         plan%interval = 2*pi/(scene%highest_speed()*scene%output%samples_per_revolution)
         ! a last sample that misses the end by rounding alone is taken
         plan%count = 1 + floor((scene%operation%duration - plan%first)/plan%interval + 1e-6_wp, i8)
         plan%next = observer%file%samples()
         if (plan%next > 0) then
            if (plan%time(plan%next - 1) > t .or. plan%time(plan%next) <= t) then
               call raise(error, system_error, path//': damaged: its samples and its checkpoint do not fit')
               call observer%file%abandon()
               return
            end if
         end if
         call march(model, options, t, scene%operation%duration, plan, y, observer, statistics, error)
         call observer%progress%clear()
         if (.not. allocated(error)) call write_spectra(scene, plan%interval, observer%file)
      end associate
   end subroutine march_scene

   !> Closes the file of a run that is done, or that failed with this error.
   subroutine end_run(scene, path, observer, statistics, quiet, error)
      type(scene_type), intent(in) :: scene
      character(len=*), intent(in) :: path
      type(recorder_type), intent(inout) :: observer
      type(integrator_counts_type), intent(in) :: statistics
      logical, intent(in) :: quiet
      type(error_type), allocatable, intent(inout) :: error
      type(error_type), allocatable :: file_error
      if (allocated(error)) then
         select case (error%status)
         case (numerics_error)
            call observer%file%finish(observer%reached, observer%cost(statistics), error%status, error%message, &
               & file_error)
            error%message = error%message//'; what was computed is in '//path
         case (stopped)
            error%message = error%message//'; tiltpad --resume '//path//' goes on'
         case default
            call observer%file%abandon()
         end select
      else
         if (.not. quiet .and. observer%file%samples() > 0) call print_march(observer%file, scene, &
            & observer%cost(statistics))
         call observer%file%finish(observer%reached, observer%cost(statistics), 0, '', file_error)
         if (.not. allocated(file_error) .and. .not. quiet) print '(a)', 'written: '//path
      end if
      if (allocated(file_error)) call move_alloc(file_error, error)
   end subroutine end_run

   !> Spectra over the last whole revolutions of a run at constant speed; none where it was not sampled
   !> over one.
   subroutine write_spectra(scene, interval, file)
      type(scene_type), intent(in) :: scene
      !> Between samples, s.
      real(wp), intent(in) :: interval
      type(run_file_type), intent(inout) :: file
      real(wp), allocatable :: y(:, :), z(:, :), tilt(:, :), amplitudes(:, :)
      integer :: revolutions, n, i
      if (scene%acceleration() /= 0) return
      associate (samples => scene%output%samples_per_revolution)
         revolutions = int(min(int(scene%output%spectrum_revolutions, i8), (file%samples() - 1)/samples))
         n = revolutions*samples
      end associate
      if (revolutions == 0 .or. n < 2) return
      call file%last_samples('journal_y', n, y)
      call file%last_samples('journal_z', n, z)
      call file%last_samples('pad_tilt', n, tilt)
      allocate (amplitudes(n/2 + 1, scene%pad_count()))
      do i = 1, scene%pad_count()
         amplitudes(:, i) = one_sided_amplitude(tilt(i, :))
      end do
      call file%put_spectrum(interval, revolutions, scene%highest_speed(), one_sided_amplitude(y(1, :)), &
         & one_sided_amplitude(z(1, :)), full_amplitude(cmplx(y(1, :), z(1, :), wp)), amplitudes)
   end subroutine write_spectra
end module run_case
