!> The task 'branch': equilibria or periodic orbits over a number of the input, with the points where their stability
!> changes, and the branches of double period that begin there.
module branch_task
   use kinds, only: wp
   use text, only: to_text, filled, newline
   use errors, only: error_type, raise, add_context, system_error, stopped
   use clock, only: wall_clock
   use equilibrium_record, only: equilibrium_type
   use equilibrium, only: settle_equilibrium
   use periodic_orbit, only: periodic_orbit_type, find_periodic_orbit
   use marching, only: march_options
   use march_settings, only: march_settings_of
   use marched_cycle, only: find_marched_cycle
   use newton_method, only: branch_point_type
   use continuation, only: bifurcation_type
   use branch_progress, only: branch_progress_type, needs_equilibrium, precise
   use equations_of_motion, only: machine_model
   use static_model, only: make_fine
   use orbit_figures, only: orbit_figures_type, find_orbit_figures
   use heat_balance, only: oil_temperatures_type
   use heat_balance_equations, only: has_warm_oil
   use branch_results, only: noted_point_type, begin_branches, add_point, put_bifurcations, noted, put_branches, &
      & get_branches
   use stop_signals, only: stop_requested, stop_reason
   use case_run, only: case_run_type
   use run_start, only: seek_equilibrium, make_start, take_oil
   use equilibrium_notes, only: note_equilibrium
   use case_groups, only: branch_type
   use case_inputs, only: case_type
   use run_file, only: run_file_type
   use bearing_file, only: bearing_file_type, new_bearing_file
   implicit none (type, external)
   private
   public :: run_branch

   !> What the file has of branches beside its series.
   type :: notes_type
      type(noted_point_type), allocatable :: special(:)
      !> Where and why branches have ended, a line for each.
      character(len=:), allocatable :: ends
   end type notes_type

contains

   subroutine run_branch(run, error)
      type(case_run_type), intent(inout), target :: run
      type(error_type), allocatable, intent(out) :: error
      type(branch_progress_type), target :: b
      type(notes_type) :: notes
      type(bifurcation_type) :: hopf
      logical :: more
      allocate (notes%special(0))
      notes%ends = ''
      call b%prepare(run%model, run%earlier_steps(), error)
      b%options%give_up => stop_requested
      if (.not. allocated(error)) then
         if (run%resumed) then
            call go_on(run, b, notes, error)
         else
            call begin(run, b, hopf, error)
            if (b%at_hopf .and. b%given%of == 'limit_cycle' .and. .not. allocated(error)) call note(run, b, hopf, notes)
         end if
      end if
      if (allocated(error)) return
      more = .true.
      do while (more)
         call follow(run, b, notes, error)
         if (allocated(error)) exit
         call b%begin_double(more)
         if (more .and. .not. run%quiet) print '(a)', 'branch '//to_text(b%branch)//': double period, from ' &
            & //b%place(b%here)
      end do
      call bring_up_to_date(run, b, notes)
      if (.not. allocated(error)) then
         if (allocated(b%curve) .and. .not. run%quiet) call print_curve(run%file, b%given)
         if (.not. run%quiet) call print_branch(run%file, run%inputs, b%given%parameter, &
            & has_warm_oil(run%model))
      else if (error%status == stopped) then
         error%message = stop_reason()//' behind '//b%place(b%here)//', point '//to_text(b%points)//' of branch ' &
            & //to_text(b%branch)
         call begin_checkpoint(run, b, notes)
         call run%stop_here(0.0_wp, error)
      end if
   end subroutine run_branch

   !> Creates the file and finds the first point of the first branch.
   subroutine begin(run, b, hopf, error)
      type(case_run_type), intent(inout), target :: run
      type(branch_progress_type), intent(inout), target :: b
      !> Where limit cycles begin.
      type(bifurcation_type), intent(out) :: hopf
      type(error_type), allocatable, intent(out) :: error
      if (b%at_hopf) then
         call first_cycle(run, b, hopf, error)
      else if (b%of_orbits) then
         call first_orbit(run, b, error)
      else
         call first_equilibrium(run, b, error)
      end if
      if (.not. (allocated(error) .or. b%at_hopf)) call b%first_point(error)
      if (allocated(b%curve) .and. .not. allocated(error)) call b%first_of_curve(error)
      if (allocated(error)) then
         if (error%status /= stopped) return
         ! nothing to go on from
         run%computed = .false.
         error%message = stop_reason()//' before the first point of the branch; nothing was written'
         return
      end if
      call run%file%put_text('branch_of', b%given%of)
      call run%file%put_text('branch_parameter', b%given%parameter)
      if (allocated(b%curve)) then
         call run%file%put_text('branch_point', b%given%point)
         call run%file%put_text('branch_second_parameter', b%given%second_parameter)
      end if
      call open_series(run, b)
      call record(run, b, b%here, error)
   end subroutine begin

   !> The orbit, or the limit cycle, that the motion from the start of the case leads to.
   subroutine first_orbit(run, b, error)
      type(case_run_type), intent(inout), target :: run
      type(branch_progress_type), intent(inout), target :: b
      type(error_type), allocatable, intent(out) :: error
      type(periodic_orbit_type) :: found
      type(march_options) :: march
      real(wp), allocatable :: y(:), equilibrium_state(:)
      call make_start(run, y, error, equilibrium_state)
      if (allocated(error)) return
      if (needs_equilibrium(run%model)) then
         ! where the start is from it, the model has its viscosities already
         if (.not. allocated(equilibrium_state)) call take_oil(run, .false., error, equilibrium_state)
         if (allocated(error)) return
         call b%begin_oil(run%model, equilibrium_state)
      end if
      ! gfortran 12 frees what an associate name of this function never had
      march = march_settings_of(run%model, run%earlier_steps())
      if (b%of_cycles) then
         call find_marched_cycle(run%model, march, y, found%orbit, run%counts, error)
      else
         call find_periodic_orbit(run%model, march, y, found, error)
         run%counts = found%counts()
      end if
      if (.not. allocated(error)) call b%begin_with_orbit(found%orbit, run%inputs%periodic%revolutions)
   end subroutine first_orbit

   !> The limit cycles that begin at the first Hopf point of the equilibria.
   subroutine first_cycle(run, b, hopf, error)
      type(case_run_type), intent(inout), target :: run
      type(branch_progress_type), intent(inout), target :: b
      type(bifurcation_type), intent(out) :: hopf
      type(error_type), allocatable, intent(out) :: error
      type(machine_model), target :: fine
      type(equilibrium_type) :: static
      real(wp), allocatable :: y(:)
      call make_fine(run%model, fine)
      call settle_case(run, fine, static, y, error)
      if (.not. allocated(error)) call b%begin_at_hopf(run%model, fine, y, static%films, hopf, error)
   end subroutine first_cycle

   !> The equilibrium of the case, with converged films.
   subroutine first_equilibrium(run, b, error)
      type(case_run_type), intent(inout) :: run
      type(branch_progress_type), intent(inout), target :: b
      type(error_type), allocatable, intent(out) :: error
      type(equilibrium_type) :: static
      real(wp), allocatable :: y(:)
      call settle_case(run, b%static, static, y, error)
      if (.not. allocated(error)) call b%begin_with_equilibrium(y, static%films)
   end subroutine first_equilibrium

   !> The equilibrium y of the case, with the converged films of a static model.
   subroutine settle_case(run, fine, static, y, error)
      type(case_run_type), intent(inout) :: run
      type(machine_model), intent(inout) :: fine
      type(equilibrium_type), intent(out) :: static
      real(wp), allocatable, intent(out) :: y(:)
      type(error_type), allocatable, intent(out) :: error
      call seek_equilibrium(run, static, error)
      if (allocated(error)) return
      call settle_equilibrium(fine, static, y, error)
      call add_context(error, 'with converged films')
      if (.not. allocated(error)) call note_equilibrium(run, static)
   end subroutine settle_case

   !> Takes the branches up where a checkpoint has left them.
   subroutine go_on(run, b, notes, error)
      type(case_run_type), intent(inout) :: run
      type(branch_progress_type), intent(inout), target :: b
      type(notes_type), intent(inout) :: notes
      type(error_type), allocatable, intent(out) :: error
      type(error_type), allocatable :: damage
      real(wp) :: ignored
      logical :: ok
      call run%resume(ignored, error)
      if (allocated(error)) return
      run%computed = .true.
      call b%begin_anywhere(run%model)
      call get_branches(run%file, run%path, b, notes%special, ok, error)
      call run%file%get_text('branch_ends', notes%ends)
      if (.not. run%file%hdf5%has_attribute('branch_ends')) ok = .false.
      call run%file%error_of(damage)
      if (allocated(damage)) call move_alloc(damage, error)
      if (allocated(error)) return
      if (ok) call b%go_on(ok)
      if (.not. ok) then
         call raise(error, system_error, run%path//': damaged: its checkpoint is none of this branch')
         return
      end if
      if (.not. run%quiet) print '(a)', 'going on behind '//b%place(b%here)//', point '//to_text(b%points) &
         & //' of branch '//to_text(b%branch)
      call open_series(run, b)
   end subroutine go_on

   !> Readies the file for points.
   subroutine open_series(run, b)
      type(case_run_type), intent(inout) :: run
      type(branch_progress_type), intent(in) :: b
      integer :: modes
      modes = 2*run%model%layout%n_positions()
      ! of limit cycles without the multiplier that is 1
      if (b%of_orbits) modes = run%model%n - merge(1, 0, b%of_cycles)
      call begin_branches(run%file, b%of_orbits, modes)
      run%computed = .true.
   end subroutine open_series

   !> Brings the file up to what it has not as series: bifurcation points, ends of branches, counts.
   subroutine bring_up_to_date(run, b, notes)
      type(case_run_type), intent(inout) :: run
      type(branch_progress_type), intent(inout) :: b
      type(notes_type), intent(in) :: notes
      call put_bifurcations(run%file, notes%special, b)
      call run%file%put_text('branch_ends', notes%ends)
      associate (counts => run%counts, orbits => b%orbits)
         counts%rhs_evaluations = counts%rhs_evaluations + orbits%evaluations + orbits%tangents
         counts%jacobian_evaluations = counts%jacobian_evaluations + orbits%tangents
         orbits%evaluations = 0
         orbits%tangents = 0
      end associate
   end subroutine bring_up_to_date

   !> Follows a branch from where it is to its end.
   subroutine follow(run, b, notes, error)
      type(case_run_type), intent(inout) :: run
      type(branch_progress_type), intent(inout), target :: b
      type(notes_type), intent(inout) :: notes
      type(error_type), allocatable, intent(out) :: error
      type(bifurcation_type), allocatable :: special(:)
      character(len=:), allocatable :: at_end
      logical :: found
      do
         call b%take_step(special, found, at_end, error)
         if (.not. allocated(error) .and. found) call record_step(run, b, special, notes, error)
         if (.not. allocated(error) .and. at_end == '') then
            if (run%wants_checkpoint(wall_clock())) then
               call bring_up_to_date(run, b, notes)
               call begin_checkpoint(run, b, notes)
               call run%checkpoint(0.0_wp, error)
            end if
         end if
         if (allocated(error)) return
         if (at_end /= '') exit
      end do
      if (notes%ends /= '') notes%ends = notes%ends//newline
      notes%ends = notes%ends//'branch '//to_text(b%branch)//' ends at '//b%place(b%here, .true.)//': '//at_end
   end subroutine follow

   !> Adds the point that was found to the file, and the bifurcation points before it.
   subroutine record_step(run, b, special, notes, error)
      type(case_run_type), intent(inout) :: run
      type(branch_progress_type), intent(inout), target :: b
      type(bifurcation_type), intent(in) :: special(:)
      type(notes_type), intent(inout) :: notes
      type(error_type), allocatable, intent(out) :: error
      integer :: k
      do k = 1, size(special)
         call b%stand_at(special(k)%point)
         call record(run, b, special(k)%point, error)
         if (allocated(error)) return
         call note(run, b, special(k), notes)
         ! a curve may end in such a point
         if (special(k)%point%arc_length >= b%here%arc_length) return
      end do
      if (size(special) > 0) call b%stand_at(b%here)
      call record(run, b, b%here, error)
   end subroutine record_step

   !> Notes and prints a bifurcation point that is the last point of the file.
   subroutine note(run, b, special, notes)
      type(case_run_type), intent(in) :: run
      type(branch_progress_type), intent(in) :: b
      type(bifurcation_type), intent(in) :: special
      type(notes_type), intent(inout) :: notes
      notes%special = [notes%special, noted(run%file, b, special)]
      if (.not. run%quiet) call print_bifurcation(special, b%place(special%point, .true.), has_warm_oil(run%model))
   end subroutine note

   !> Adds a point to the file, at which the problem stands.
   subroutine record(run, b, point, error)
      type(case_run_type), intent(inout) :: run
      type(branch_progress_type), intent(inout) :: b
      type(branch_point_type), intent(in) :: point
      type(error_type), allocatable, intent(out) :: error
      type(orbit_figures_type) :: figures
      type(oil_temperatures_type), allocatable :: oil(:)
      real(wp), allocatable :: viscosity(:)
      if (has_warm_oil(run%model)) allocate (oil(size(run%model%bearings)))
      if (b%of_orbits) then
         call find_orbit_figures(run%model, b%orbits, run%inputs%output%samples_per_revolution, figures)
         if (allocated(oil)) call b%ode%oil%temperatures(oil, viscosity)
      else
         call figures%add_state(b%static, 0.0_wp, b%equilibria%state(), 0.0_wp)
         viscosity = [real(wp) ::]
         if (allocated(oil)) call b%equilibria%temperatures(oil, viscosity)
      end if
      call add_point(run%file, run%model, b, point, figures, error, oil, viscosity)
      call run%file%heartbeat(int(wall_clock() - run%started))
   end subroutine record

   !> Begins a checkpoint; a branch has no time.
   subroutine begin_checkpoint(run, b, notes)
      type(case_run_type), intent(inout) :: run
      type(branch_progress_type), intent(in) :: b
      type(notes_type), intent(in) :: notes
      call run%file%begin_checkpoint(0.0_wp)
      call put_branches(run%file, b, notes%special)
   end subroutine begin_checkpoint

   ! What is printed of branches: bifurcation points as they are found, and at the end all of it.

   !> A bifurcation point, found between two points.
   subroutine print_bifurcation(special, place, warm)
      type(bifurcation_type), intent(in) :: special
      character(len=*), intent(in) :: place
      !> Whether the oil has temperatures.
      logical, intent(in) :: warm
      associate (value => special%value)
         print '(a)', '  '//trim(special%kind)//' at '//place//filled(', {.4}'//merge(' + ', ' - ', value%im >= 0) &
            & //'{.4} i', [value%re, abs(value%im)])//frozen(warm)
      end associate
   end subroutine print_bifurcation

   !> All branches: points, those that are stable, what warm oil does, and their ends.
   subroutine print_branch(file, inputs, parameter, warm)
      type(run_file_type), intent(inout), target :: file
      type(case_type), intent(in) :: inputs
      character(len=*), intent(in) :: parameter
      logical, intent(in) :: warm
      real(wp), allocatable, dimension(:, :) :: branch, stable, value
      character(len=:), allocatable :: ends
      integer :: k, b
      call file%hdf5%last_samples('branch', int(file%hdf5%samples), branch)
      call file%hdf5%last_samples('stable', int(file%hdf5%samples), stable)
      call file%hdf5%last_samples('parameter', int(file%hdf5%samples), value)
      do k = 1, nint(maxval(branch))
         associate (own => nint(branch(1, :)) == k)
            print '(a)', 'branch '//to_text(k)//': '//to_text(count(own))//' points, '//parameter//' from ' &
               & //precise(minval(value(1, :), mask=own))//' to '//precise(maxval(value(1, :), mask=own))//', ' &
               & //to_text(count(own .and. stable(1, :) > 0))//' of them stable'//frozen(warm)
            if (inputs%branch%of == 'limit_cycle' .and. k == 1) call print_birth(file, inputs, value(1, :), own, &
               & stable(1, :) > 0, parameter)
            do b = 1, merge(size(inputs%bearings), 0, warm)
               call print_oil(new_bearing_file(file, inputs%bearings(b)), inputs%bearings(b)%label(', ')//'pad ', own)
            end do
         end associate
      end do
      call file%get_text('branch_ends', ends)
      print '(a)', ends
   end subroutine print_branch

   !> The points of a curve: where they are, the frequency of what begins there, and which side is stable.
   subroutine print_curve(file, given)
      type(run_file_type), intent(inout) :: file
      type(branch_type), intent(in) :: given
      real(wp), allocatable, dimension(:, :) :: first, second, side, stable, frequency, ratio, born
      character(len=32) :: vibration
      character(len=:), allocatable :: sides
      integer :: n, k
      logical :: vibrates, begins
      n = int(file%hdf5%samples)
      call file%hdf5%last_samples('parameter', n, first)
      call file%hdf5%last_samples('second_parameter', n, second)
      call file%hdf5%last_samples('stable_side', n, side)
      call file%hdf5%last_samples('stable', n, stable)
      vibration = ''
      vibrates = file%hdf5%has_series('frequency')
      if (vibrates) then
         call file%hdf5%last_samples('frequency', n, frequency)
         call file%hdf5%last_samples('frequency_ratio', n, ratio)
         vibration = 'Hz, over that of the shaft'
      end if
      begins = file%hdf5%has_series('born_side')
      if (begins) call file%hdf5%last_samples('born_side', n, born)
      sides = trim(merge('solutions  ', 'stable side', index(given%point, 'fold') > 0))
      if (begins) sides = sides//', cycles born'
      print '(2(1x,a),1x,a)', given%second_parameter, given%parameter, trim(vibration)//' '//sides
      do k = 1, n
         sides = at(side(1, k))
         if (.not. stable(1, k) > 0 .and. index(given%point, 'fold') == 0) sides = 'none'
         if (begins) sides = sides//', '//at(born(1, k))
         if (vibrates) write (vibration, '(f12.3,f9.5)') frequency(1, k), ratio(1, k)
         print '(2(1x,a15),a,2x,a)', precise(second(1, k)), precise(first(1, k)), trim(vibration), sides
      end do
   contains
      pure function at(side) result(word)
         real(wp), intent(in) :: side
         character(len=:), allocatable :: word
         word = trim(merge('above', 'below', side > 0))
         if (.not. abs(side) > 0) word = 'not known'
      end function at
   end subroutine print_curve

   !> To which side limit cycles are born, and how far unstable ones reach: a kick beyond them leads away from an
   !> equilibrium that is stable.
   subroutine print_birth(file, inputs, value, own, stable, parameter)
      type(run_file_type), intent(inout), target :: file
      type(case_type), intent(in) :: inputs
      real(wp), intent(in) :: value(:)
      !> Points of the branch that begins there.
      logical, intent(in) :: own(:), stable(:)
      character(len=*), intent(in) :: parameter
      type(bearing_file_type) :: part
      real(wp), allocatable, dimension(:, :) :: highest, lowest
      real(wp) :: amplitude(2)
      logical :: unstable(size(value))
      integer :: b, k, axis
      if (count(own) < 2) return
      if (file%get_real('bifurcations/point') == 1) print '(a)', '  born towards '//trim(merge('higher', 'lower ', &
         & value(2) > value(1)))//' '//parameter
      unstable = own .and. .not. stable
      unstable(1) = .false.
      ! with the ends of their stretches, at folds
      unstable(2:) = own(2:) .and. (unstable(2:) .or. unstable(:size(value) - 1))
      if (.not. any(unstable)) return
      k = maxloc(abs(value - value(1)), dim=1, mask=unstable)
      print '(a)', '  unstable cycles reach to '//parameter//' = '//precise(value(k))//', where their amplitudes are'
      do b = 1, size(inputs%bearings)
         part = new_bearing_file(file, inputs%bearings(b))
         do axis = 1, 2
            call part%last_samples('journal_'//'yz'(axis:axis)//'_max', size(value), highest)
            call part%last_samples('journal_'//'yz'(axis:axis)//'_min', size(value), lowest)
            amplitude(axis) = (highest(1, k) - lowest(1, k))/2
         end do
         print '(a)', filled('    '//inputs%bearings(b)%label(', ')//'journal: y {u.2}, z {u.2} um', amplitude)
      end do
   end subroutine print_birth

   !> What stability stands for where the oil has temperatures.
   pure function frozen(warm) result(text)
      logical, intent(in) :: warm
      character(len=:), allocatable :: text
      text = ''
      if (warm) text = ' at frozen viscosity'
   end function frozen

   !> The range of the temperatures and viscosity of each pad of a bearing over the points of a branch.
   subroutine print_oil(file, title, own)
      type(bearing_file_type), intent(in) :: file
      character(len=*), intent(in) :: title
      logical, intent(in) :: own(:)
      real(wp), allocatable, dimension(:, :) :: mean, highest, viscosity
      integer :: i
      call file%last_samples('mean_temperature', size(own), mean)
      call file%last_samples('maximum_temperature', size(own), highest)
      call file%last_samples('viscosity', size(own), viscosity)
      do i = 1, size(mean, 1)
         print '(a)', filled('  '//title//'{}: mean {.1} to {.1} C, {m.2} to {m.2} mPa s, pad at most {.1} C', &
            & [real(wp) :: i, minval(mean(i, :), mask=own), maxval(mean(i, :), mask=own), &
            & minval(viscosity(i, :), mask=own), maxval(viscosity(i, :), mask=own), maxval(highest(i, :), mask=own)])
      end do
   end subroutine print_oil
end module branch_task
