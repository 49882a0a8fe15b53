!> One run of a case: what its task works on, and what it has cost so far.
module case_run
   use kinds, only: wp, i8
   use case_inputs, only: case_type
   use parameter_study, only: run_tag
   use errors, only: error_type, raise, system_error, stopped
   use ode_model, only: integrator_counts_type
   use film_solver, only: film_counters
   use equations_of_motion, only: machine_model
   use bearing_shape, only: bearing_shape_type
   use equilibrium_results, only: put_shape
   use machine_results, only: mode_signs, other_signs
   use record, only: record_type
   use run_file, only: run_file_type
   use bearing_file, only: bearing_file_type, new_bearing_file
   use provenance, only: running
   use summary_group, only: run_extremes_type
   use march_figures, only: put_progress, put_march_figures, put_machine_figures
   use result_remarks, only: remarks_on_run, put_remarks, new_lines
   use clock, only: wall_clock
   use text, only: behind
   implicit none (type, external)
   private
   public :: case_run_type, begin_run, print_remarks

   type :: case_run_type
      type(case_type) :: inputs
      !> Name of the result file, as given; empty for a run of a study that has none.
      character(len=:), allocatable :: path
      !> Which run of a study it is, if any.
      type(run_tag) :: tag
      logical :: quiet = .true.
      !> States whose films are solved closely once it is complete; 0: none.
      integer :: verified_states = 0
      !> True where the file is continued from its checkpoint.
      logical :: resumed = .false.
      !> True once there are results that are worth a file.
      logical :: computed = .false.
      type(run_file_type) :: file
      type(machine_model) :: model
      !> What its equilibrium has made of all bearings, where that changes the shape of one.
      type(bearing_shape_type), allocatable :: shapes(:)
      !> Remarks on the case, and those that were printed last, a line each.
      character(len=:), allocatable :: of_case, remarks
      !> Of all samples of each bearing.
      type(run_extremes_type), allocatable :: extremes(:)
      !> Simulated time reached, s.
      real(wp) :: reached = 0
      !> What the integration cost; wall time of sampling without its writing, and of the checkpoints, s.
      type(integrator_counts_type) :: counts
      real(wp) :: sampling = 0, checkpoints = 0
      !> Clock at the start and at the last checkpoint, s, and what the run cost before it was resumed.
      real(wp) :: started = 0, last_checkpoint = 0
      type(record_type) :: earlier
   contains
      procedure :: bearing
      procedure :: resume
      procedure :: earlier_steps
      procedure :: note_costs
      procedure :: note_shapes
      procedure :: note_figures
      procedure :: note_remarks
      procedure :: wants_checkpoint
      procedure :: checkpoint
      procedure :: stop_here
   end type case_run_type

   !> Group of what a run costs.
   character(len=*), parameter :: costs = 'statistics'

contains

   !> Starts the clock of a run.
   subroutine begin_run(run, inputs, path, tag, verified_states, quiet)
      type(case_run_type), intent(out) :: run
      type(case_type), intent(in) :: inputs
      character(len=*), intent(in) :: path
      type(run_tag), intent(in) :: tag
      integer, intent(in) :: verified_states
      logical, intent(in) :: quiet
      run%inputs = inputs
      run%path = path
      run%tag = tag
      run%verified_states = verified_states
      run%quiet = quiet
      run%file%filed = path /= ''
      run%remarks = ''
      allocate (run%extremes(size(inputs%bearings)))
      run%started = wall_clock()
      run%last_checkpoint = run%started
   end subroutine begin_run

   !> The results of bearing b.
   type(bearing_file_type) function bearing(self, b)
      class(case_run_type), intent(in), target :: self
      integer, intent(in) :: b
      bearing = new_bearing_file(self%file, self%inputs%bearings(b))
   end function bearing

   !> Writes the shapes of the bearings that have changed theirs.
   subroutine note_shapes(self)
      class(case_run_type), intent(in) :: self
      type(bearing_file_type) :: file
      integer :: b
      if (.not. allocated(self%shapes)) return
      do b = 1, size(self%shapes)
         file = self%bearing(b)
         if (self%inputs%bearings(b)%changes_shape()) call put_shape(file, self%shapes(b))
      end do
   end subroutine note_shapes

   !> Writes the figures of the samples so far.
   subroutine note_figures(self)
      class(case_run_type), intent(inout) :: self
      type(bearing_file_type) :: file
      integer :: b
      if (self%inputs%about%task == 'branch' .or. self%file%hdf5%samples == 0) return
      call put_progress(self%file)
      if (self%model%rotor%stations > 0) call put_machine_figures(self%file, self%inputs)
      associate (loads => self%model%rotor%loads(self%model%point))
         do b = 1, size(self%inputs%bearings)
            file = self%bearing(b)
            call put_march_figures(file, self%inputs, b, self%extremes(b), norm2(loads(:, b)))
         end do
      end associate
   end subroutine note_figures

   !> Writes the remarks on the run so far, and prints those that were not if they are to be `shown`.
   subroutine note_remarks(self, shown)
      class(case_run_type), intent(inout) :: self
      logical, intent(in) :: shown
      character(len=:), allocatable :: all
      all = remarks_on_run(self%of_case, self%inputs, self%file)
      call put_remarks(self%file, all)
      if (self%quiet .or. .not. shown) return
      call print_remarks(new_lines(all, self%remarks))
      self%remarks = all
   end subroutine note_remarks

   !> Remarks, a line each.
   subroutine print_remarks(lines)
      character(len=*), intent(in) :: lines
      write (*, '(a)', advance='no') behind('remark: ', lines)
   end subroutine print_remarks

   !> True where it is time for a checkpoint; `now` is the clock, s.
   pure logical function wants_checkpoint(self, now)
      class(case_run_type), intent(in) :: self
      real(wp), intent(in) :: now
      associate (pause => self%inputs%output%checkpoint_seconds)
         wants_checkpoint = pause > 0 .and. now - self%last_checkpoint >= pause
      end associate
   end function wants_checkpoint

   !> Writes a checkpoint at simulated time t, s: of a march its state y; else it was begun in the file.
   subroutine checkpoint(self, t, error, y)
      class(case_run_type), intent(inout) :: self
      real(wp), intent(in) :: t
      type(error_type), allocatable, intent(out) :: error
      real(wp), intent(in), optional :: y(:)
      real(wp) :: started
      started = wall_clock()
      call note_all(self)
      call self%file%checkpoint(t, running, '', error, y)
      self%last_checkpoint = wall_clock()
      self%checkpoints = self%checkpoints + self%last_checkpoint - started
   end subroutine checkpoint

   !> Writes the last checkpoint, where a signal asks for the end, as the error says.
   subroutine stop_here(self, t, error, y)
      class(case_run_type), intent(inout) :: self
      real(wp), intent(in) :: t
      type(error_type), allocatable, intent(inout) :: error
      real(wp), intent(in), optional :: y(:)
      type(error_type), allocatable :: file_error
      call note_all(self)
      call self%file%checkpoint(t, stopped, error%message, file_error, y)
      if (allocated(file_error)) call move_alloc(file_error, error)
   end subroutine stop_here

   !> What the file has of a run at a checkpoint.
   subroutine note_all(self)
      class(case_run_type), intent(inout) :: self
      call self%note_figures()
      call self%note_remarks(shown=.false.)
      call self%note_costs()
   end subroutine note_all

   !> Goes on from the checkpoint in the file: simulated time t, s, and of a march its state.
   subroutine resume(self, t, error, state)
      class(case_run_type), intent(inout) :: self
      real(wp), intent(out) :: t
      type(error_type), allocatable, intent(out) :: error
      real(wp), intent(inout), optional :: state(:)
      integer :: k
      call self%file%resume(self%inputs, t, error, state)
      if (allocated(error)) return
      if (.not. self%inputs%rotor%is_rigid()) then
         if (.not. self%file%has(mode_signs)) call raise(error, system_error, self%path//': '//other_signs)
      end if
      if (allocated(error)) return
      do k = 1, self%file%count
         associate (own => self%file%datasets(k))
            if (own%group() == costs) call self%earlier%put(own%path, own%values, own%units, own%long_name)
         end associate
      end do
   end subroutine resume

   !> Time steps before the run was resumed.
   integer(i8) function earlier_steps(self)
      class(case_run_type), intent(in) :: self
      earlier_steps = nint(self%earlier%get_real(costs//'/steps'), i8)
   end function earlier_steps

   !> Writes what the run has cost so far, over all its stretches: the list of all figures.
   subroutine note_costs(self)
      class(case_run_type), intent(inout) :: self
      type(film_counters), allocatable :: films(:)
      integer :: b
      associate (counts => self%counts)
         call count('steps', counts%steps, 'time steps')
         call count('rhs_evaluations', counts%rhs_evaluations, 'right-hand sides')
         call count('jacobian_evaluations', counts%jacobian_evaluations, 'Jacobians')
         call count('error_test_failures', counts%error_test_failures, 'steps refused by the error test')
         call count('convergence_failures', counts%convergence_failures, 'Newton iterations that failed')
      end associate
      films = [(self%model%bearings(b)%film%counters, b=1, size(self%model%bearings))]
      do b = 1, size(self%model%bearings)
         if (allocated(self%model%bearings(b)%sloped)) films = [films, self%model%bearings(b)%sloped%film%counters]
      end do
      call count('film_fourier', sum(films%fourier), 'pads solved by axial modes in the march')
      call count('film_volumes', sum(films%volumes), 'pads solved on finite volumes in the march')
      call count('film_passes', sum(films%passes), &
         & 'passes over the cells of these, sweeps of over-relaxation or eliminations, in the march')
      if (size(films) > size(self%model%bearings)) call count('film_weighted', sum(films%weighted), &
         & 'pads with slopes solved by weighted functions in the march')
      call count('film_table', sum(films%looked_up), 'pads looked up in tables in the march')
      call count('film_cells', sum(films%cells), 'cells of these tables that were built')
      call count('film_nodes', sum(films%nodes), 'cavitated films that were solved for them')
      call count('film_profiles', sum(films%profiles), &
         & 'profiles of the pressure that were built for highest pressures')
      call seconds('film_building_seconds', sum(films%building), 'wall time of building these tables')
      call seconds('film_seconds', sum(films%seconds + films%building), 'wall time of the film in the march')
      call count('resumes', merge(1_i8, 0_i8, self%resumed), 'times that the run was resumed')
      call seconds('output_seconds', self%sampling + self%file%hdf5%writing_seconds, 'wall time of sampling')
      call seconds('checkpoint_seconds', self%checkpoints, 'wall time of the checkpoints before the last')
      call seconds('wall_seconds', wall_clock() - self%started, 'wall time of the run')
   contains
      subroutine count(name, value, long_name)
         character(len=*), intent(in) :: name, long_name
         integer(i8), intent(in) :: value
         associate (path => costs//'/'//name)
            call self%file%put(path, value + nint(self%earlier%get_real(path), i8), long_name)
         end associate
      end subroutine count

      subroutine seconds(name, value, long_name)
         character(len=*), intent(in) :: name, long_name
         real(wp), intent(in) :: value
         associate (path => costs//'/'//name)
            call self%file%put(path, value + self%earlier%get_real(path), 's', long_name)
         end associate
      end subroutine seconds
   end subroutine note_costs
end module case_run
