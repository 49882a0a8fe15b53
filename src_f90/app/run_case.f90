!> A run from scene to result file: equilibrium, march, spectra, key figures.
module run_case
   use kinds, only: wp, i8, pi
   use text, only: to_text, fixed_text
   use errors, only: error_type, add_context
   use ode_model, only: march_observer
   use cvode_march, only: march, march_options, march_statistics, sample_plan
   use spectra, only: one_sided_amplitude, full_amplitude
   use loops, only: loop_area, periodicity, new_periodicity
   use scene, only: scene_type
   use equations_of_motion, only: bearing_model, new_bearing_model
   use equilibrium, only: equilibrium_type, find_equilibrium
   use namelist_writer, only: scene_text
   use run_file, only: run_file_type
   use progress, only: progress_type, new_progress, wall_clock
   implicit none (type, external)
   private
   public :: run_scene

   !> Without friction the motion is smooth and the steps are long; the error of Newton's iteration then shows
   !> in the orbit at CVODE's 0.1 (measured, docs/benchmarks.md).
   real(wp), parameter :: smooth_newton_coefficient = 0.02_wp

   !> Completes each sample on a model of its own, so that sampling never changes the march.
   type, extends(march_observer) :: recorder
      type(bearing_model) :: model
      type(run_file_type) :: file
      type(progress_type) :: progress
      real(wp) :: seconds = 0
      type(periodicity) :: orbit
   contains
      procedure :: sample => record_sample
      procedure :: report => record_progress
   end type recorder

contains

   !> Runs a valid scene and writes its result file. On a numerics error the file holds what was computed
   !> and is marked incomplete.
   subroutine run_scene(scene, path, quiet, error)
      type(scene_type), intent(in) :: scene
      character(len=*), intent(in) :: path
      logical, intent(in) :: quiet
      type(error_type), allocatable, intent(out) :: error
      type(recorder) :: observer
      type(bearing_model) :: model
      type(equilibrium_type) :: static
      type(march_statistics) :: statistics
      type(error_type), allocatable :: file_error
      real(wp) :: started

      started = wall_clock()
      call observer%file%create(path, scene, scene_text(scene), error)
      if (allocated(error)) return
      call find_equilibrium(scene, static, error)
      if (allocated(error)) then
         call observer%file%abandon()
         return
      end if
      call observer%file%put_equilibrium(static, scene%tilting_radial())
      if (.not. quiet) call print_equilibrium(static)
      model = new_bearing_model(scene)
      if (scene%about%task == 'march') call march_scene(scene, static, model, observer, statistics, quiet, error)
      call observer%file%put_statistics(statistics, model, observer%seconds, wall_clock() - started)
      if (.not. quiet .and. observer%file%samples > 0) call print_march(observer, statistics, model, &
         & wall_clock() - started)
      call observer%file%finish(.not. allocated(error), file_error)
      if (allocated(file_error)) then
         call move_alloc(file_error, error)
      else if (allocated(error)) then
         error%message = error%message//'; what was computed is in '//path
      else if (.not. quiet) then
         print '(a)', 'written: '//path
      end if
   end subroutine run_scene

   subroutine march_scene(scene, static, model, observer, statistics, quiet, error)
      type(scene_type), intent(in) :: scene
      type(equilibrium_type), intent(in) :: static
      type(bearing_model), intent(inout) :: model
      type(recorder), intent(inout) :: observer
      type(march_statistics), intent(out) :: statistics
      logical, intent(in) :: quiet
      type(error_type), allocatable, intent(out) :: error
      type(march_options) :: options
      type(sample_plan) :: plan
      real(wp), allocatable :: y(:)

      observer%model = model
      observer%progress = new_progress(scene%operation%duration, quiet)
      if (scene%integration%stop_when_periodic > 0) then
         observer%orbit = new_periodicity(scene%output%samples_per_revolution, 2 + scene%pad_count())
      end if
      options%relative_tolerance = scene%integration%relative_tolerance
      options%absolute_tolerance = scene%integration%relative_tolerance*scene%integration%tolerance_scale*model%scale
      options%max_step = scene%integration%max_step
      options%max_steps = scene%integration%max_steps
      if (scene%friction%model == 'none') options%newton_coefficient = smooth_newton_coefficient
      plan%first = scene%output%start_time
      plan%interval = 2*pi/(scene%highest_speed()*scene%output%samples_per_revolution)
      ! a last sample that misses the end by rounding alone is taken
      plan%count = 1 + floor((scene%operation%duration - plan%first)/plan%interval + 1e-6_wp, i8)
      y = model%at_rest(static%journal, static%tilt, static%penetration)
      call march(model, options, 0.0_wp, scene%operation%duration, plan, y, observer, statistics, error)
      call observer%progress%clear()
      if (.not. allocated(error)) call write_spectra(scene, plan%interval, observer%file)
   end subroutine march_scene

   subroutine record_sample(self, t, y, output, error)
      class(recorder), intent(inout) :: self
      real(wp), intent(in) :: t, y(:), output(:)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: started
      started = wall_clock()
      call self%model%recall(y, output)
      call self%file%add_sample(self%model, t, y, error)
      associate (limit => self%model%scene%integration%stop_when_periodic)
         if (limit > 0) then
            call self%orbit%add(self%model%positions(y))
            self%satisfied = self%orbit%change <= limit
         end if
      end associate
      self%seconds = self%seconds + wall_clock() - started
   end subroutine record_sample

   subroutine record_progress(self, t, steps)
      class(recorder), intent(inout) :: self
      real(wp), intent(in) :: t
      integer(i8), intent(in) :: steps
      call self%progress%report(t, steps)
   end subroutine record_progress

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
         revolutions = int(min(int(scene%output%spectrum_revolutions, i8), (file%samples - 1)/samples))
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

   subroutine print_equilibrium(static)
      type(equilibrium_type), intent(in) :: static
      integer :: i
      print '(a)', 'equilibrium: journal y '//micro(static%journal(1))//', z '//micro(static%journal(2))//' um'
      do i = 1, size(static%tilt)
         print '(a)', '  pad '//to_text(i)//': tilt '//milli(static%tilt(i))//' mrad, penetration ' &
            & //micro(static%penetration(i))//' um, contact '//fixed_text(static%contact_force(i), 1) &
            & //' N, least film '//micro(static%min_film(i))//' um, highest pressure ' &
            & //mega(static%max_pressure(i))//' MPa'
      end do
   end subroutine print_equilibrium

   !> Key figures of the last revolution (or of what there is) and what they cost.
   subroutine print_march(observer, statistics, model, seconds)
      type(recorder), intent(inout) :: observer
      type(march_statistics), intent(in) :: statistics
      type(bearing_model), intent(in) :: model
      real(wp), intent(in) :: seconds
      real(wp), allocatable :: y(:, :), z(:, :), tilt(:, :), moment(:, :), film(:, :), pressure(:, :)
      integer :: n, i
      associate (file => observer%file)
         n = int(min(int(model%scene%output%samples_per_revolution, i8), file%samples))
         call file%last_samples('journal_y', n, y)
         call file%last_samples('journal_z', n, z)
         call file%last_samples('pad_tilt', n, tilt)
         call file%last_samples('friction_moment', n, moment)
         call file%last_samples('min_film_thickness', n, film)
         call file%last_samples('max_pressure', n, pressure)
      end associate
      print '(a)', 'last revolution: journal y '//micro(minval(y))//' to '//micro(maxval(y))//', z ' &
         & //micro(minval(z))//' to '//micro(maxval(z))//' um'
      do i = 1, size(tilt, 1)
         print '(a)', '  pad '//to_text(i)//': tilt '//milli(minval(tilt(i, :)))//' to ' &
            & //milli(maxval(tilt(i, :)))//' mrad, least film '//micro(minval(film(i, :)))//' um, highest pressure ' &
            & //mega(maxval(pressure(i, :)))//' MPa, friction work ' &
            & //fixed_text(1e3_wp*loop_area(tilt(i, :), moment(i, :)), 3)//' mJ'
      end do
      associate (work => model%film%counters)
         print '(a)', 'cost: '//to_text(statistics%steps)//' steps, '//to_text(statistics%rhs_evaluations) &
            & //' right-hand sides, '//to_text(statistics%jacobian_evaluations)//' Jacobians, films ' &
            & //to_text(work%modal)//' modal and '//to_text(work%sor)//' on cells ('//to_text(work%sweeps)//' sweeps)'
      end associate
      print '(a)', '  wall time '//fixed_text(seconds, 2)//' s, of it film '//fixed_text(model%film_seconds, 2) &
         & //' s and samples '//fixed_text(observer%seconds, 2)//' s'
   end subroutine print_march

   !> Metres as micrometres, radians as milliradians, pascals as megapascals.
   function micro(x)
      real(wp), intent(in) :: x
      character(len=:), allocatable :: micro
      micro = fixed_text(1e6_wp*x, 3)
   end function micro

   function milli(x)
      real(wp), intent(in) :: x
      character(len=:), allocatable :: milli
      milli = fixed_text(1e3_wp*x, 4)
   end function milli

   function mega(x)
      real(wp), intent(in) :: x
      character(len=:), allocatable :: mega
      mega = fixed_text(1e-6_wp*x, 3)
   end function mega
end module run_case
