!> A run from case to result file: opens the file, has the case's task done, closes the file.
module run_case
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use kinds, only: wp, i8
   use text, only: filled
   use errors, only: error_type, raise, input_error, numerics_error, system_error, stopped
   use case_inputs, only: case_type
   use result_size, only: memory_bytes, memory_advice, bytes_text, size_note
   use parameter_study, only: run_tag
   use equations_of_motion, only: machine_model, new_machine_model
   use record, only: record_type, move_record
   use record_file, only: read_record
   use hdf5_file, only: hdf5_type
   use restart, only: restart_type, read_result, open_result, refuse_other_case
   use rotor_file, only: read_rotor
   use read_files, only: read_tables
   use files, only: is_regular
   use processes, only: can_have
   use stop_signals, only: stop_requested
   use working_file, only: clear_leftovers
   use case_run, only: case_run_type, begin_run, print_remarks
   use factories, only: march_films, static_films, filled_films
   use run_start, only: find_converged_equilibrium
   use coefficients_task, only: run_coefficients
   use periodic_task, only: run_periodic
   use branch_task, only: run_branch
   use march_task, only: run_march
   use verification, only: check_verification, verify_films
   use case_remarks, only: remarks_on_case
   use summary_group, only: figure, pad_figures, has_figure
   implicit none (type, external)
   private
   public :: run_task, way_out, computed_in

   !> Where the results of a run are whose numerics failed.
   character(len=*), parameter :: computed_in = '; what was computed is in '
   !> What can be done where the result of another case is in the way.
   character(len=*), parameter :: way_out = '; --overwrite replaces it, and --output names another place'
   !> s.
   real(wp), parameter :: thousand_hours = 3.6e6_wp

contains

   !> Runs a valid case and writes its result file. On a numerics error the file holds what was computed and is
   !> marked incomplete. With `go_on` a result of the same case that is there already is completed, from its
   !> checkpoint; else it is replaced. A checkpoint, and the result of another case, are replaced only with `overwrite`,
   !> and what is no result never. `tag` says which run of a study it is, if any. Of a complete run the films in this
   !> number of states, `verified_states`, are solved closely. Its results are in the record, too, which may be used
   !> again; a run of a study without a path has no file.
   subroutine run_task(inputs, path, tag, verified_states, go_on, overwrite, quiet, results, error)
      type(case_type), intent(in) :: inputs
      character(len=*), intent(in) :: path
      type(run_tag), intent(in) :: tag
      integer, intent(in) :: verified_states
      logical, intent(in) :: go_on, overwrite, quiet
      type(record_type), intent(inout) :: results
      type(error_type), allocatable, intent(out) :: error
      type(case_run_type), target :: run
      logical :: complete

      call results%clear()
      if (verified_states > 0) call check_verification(inputs, verified_states, error)
      if (allocated(error)) return
      if (.not. can_have(int(memory_bytes(inputs), i8))) call raise(error, system_error, &
         & 'out of memory: the run needs '//bytes_text(memory_bytes(inputs))//memory_advice(inputs))
      if (allocated(error)) return
      call begin_run(run, inputs, path, tag, verified_states, quiet)
      call read_rotor(run%inputs%rotor, error)
      if (.not. allocated(error)) call read_tables(run%inputs, error)
      if (allocated(error)) return
      complete = .false.
      if (run%file%filed) call open_file(run, go_on, overwrite, complete, error)
      if (allocated(error)) return
      if (.not. complete .or. run%verified_states > 0) then
         run%of_case = remarks_on_case(run%inputs)
         if (.not. quiet) then
            run%remarks = run%of_case
            call print_remarks(run%remarks)
            if (size_note(inputs, 1) /= '') print '(a)', size_note(inputs, 1)
         end if
         run%model = new_machine_model(run%inputs, merge(filled_films, merge(march_films, static_films, &
            & run%inputs%moves()), complete))
         run%model%give_up => stop_requested
      end if
      if (.not. complete) then
         call move_record(results, run%file%record_type)
         call perform(run, error)
      end if
      if (run%verified_states > 0 .and. .not. allocated(error)) call verify_films(run, complete, error)
      if (.not. complete) then
         call move_record(run%file%record_type, results)
      else if (tag%number > 0 .and. .not. allocated(error)) then
         call recall_results(path, results, error)
      end if
   end subroutine run_task

   !> The results in the file of a complete run.
   subroutine recall_results(path, results, error)
      character(len=*), intent(in) :: path
      type(record_type), intent(inout) :: results
      type(error_type), allocatable, intent(out) :: error
      type(hdf5_type) :: file
      call open_result(path, file, error)
      if (allocated(error)) return
      call read_record(file, results)
      if (allocated(file%failure)) call raise(error, system_error, path//': damaged: '//file%failure)
      call file%close()
   end subroutine recall_results

   !> Has the task of a case done, and closes its file.
   subroutine perform(run, error)
      type(case_run_type), intent(inout), target :: run
      type(error_type), allocatable, intent(out) :: error
      type(machine_model) :: converged
      real(wp), allocatable :: y(:)
      ! every task has a line here, and where it is more than the start of others a module of its own
      if (allocated(run%model%refusal)) then
         call raise(error, input_error, run%model%refusal)
         call close_file(run, error)
         return
      end if
      select case (run%inputs%about%task)
      case ('equilibrium')
         call find_converged_equilibrium(run, converged, y, error)
      case ('coefficients')
         call run_coefficients(run, error)
      case ('periodic')
         call run_periodic(run, error)
      case ('branch')
         call run_branch(run, error)
      case ('march')
         call run_march(run, error)
      case default
         call raise(error, input_error, 'case%task: there is no task '//run%inputs%about%task)
      end select
      call close_file(run, error)
   end subroutine perform

   !> Claims the name of the file, and looks whether there is one to continue, or a complete one.
   subroutine open_file(run, go_on, overwrite, complete, error)
      type(case_run_type), intent(inout) :: run
      logical, intent(in) :: go_on, overwrite
      logical, intent(out) :: complete
      type(error_type), allocatable, intent(out) :: error
      ! before the lock, as a complete file may be in a place that cannot be written
      call look_at_file(run, go_on, overwrite, .false., complete, error)
      if (complete .and. run%verified_states == 0) call clear_leftovers(run%path)
      if (complete .or. allocated(error)) return
      call run%file%hdf5%claim(run%path, error)
      if (allocated(error)) return
      associate (taken_from => run%file%hdf5%working%lock%taken_from)
         if (.not. run%quiet .and. taken_from /= '') print '(a)', run%path//': '//taken_from//', which wrote it, has ' &
            & //'ended'
      end associate
      ! and behind it, as another run may have written meanwhile
      call look_at_file(run, go_on, overwrite, .not. go_on, complete, error)
      if (allocated(error) .or. complete) call run%file%abandon()
   end subroutine open_file

   !> What is there under the name of the file: a result to continue, `run%resumed`, a complete one, one to replace, or
   !> an error: something that must stay.
   subroutine look_at_file(run, go_on, overwrite, texts_alone, complete, error)
      type(case_run_type), intent(inout) :: run
      !> The last: of a file that is to be replaced, and has been looked at (restart).
      logical, intent(in) :: go_on, overwrite, texts_alone
      logical, intent(out) :: complete
      type(error_type), allocatable, intent(out) :: error
      type(restart_type) :: found
      complete = .false.
      run%resumed = .false.
      if (.not. is_regular(run%path)) return
      call read_result(run%path, found, error, texts_alone)
      if (allocated(error)) then
         if (found%older .and. overwrite) then
            deallocate (error)
         else if (found%older) then
            error%message = error%message//way_out
         else if (.not. go_on) then
            error%message = error%message//'; it is not replaced'
         end if
         return
      end if
      call refuse_other_case(run%path, run%inputs, run%tag, go_on, found, error)
      if (allocated(error)) then
         if (overwrite) then
            deallocate (error)
         else if (.not. go_on .or. run%tag%number > 0) then
            error%message = error%message//way_out
         end if
         return
      end if
      if (.not. go_on) then
         if (found%can_go_on() .and. .not. overwrite) call raise(error, system_error, run%path//': has a checkpoint ' &
            & //'of this case; --resume '//run%path//' goes on from it, and --overwrite starts anew')
         return
      end if
      call found%refuse_end(run%path, error)
      complete = found%complete
      run%resumed = .not. complete
      if (.not. complete) return
      ! verified already
      if (found%verified_states == run%verified_states) run%verified_states = 0
      if (run%verified_states == 0 .and. .not. run%quiet) print '(a)', run%path//': complete already, nothing to do'
   end subroutine look_at_file

   !> Prints the figures of the march, or of the orbit, of all bearings.
   subroutine print_bearings(run)
      type(case_run_type), intent(inout) :: run
      character(len=:), allocatable :: title, span
      integer :: b
      span = 'last revolution'
      associate (revolutions => run%inputs%periodic%revolutions)
         if (run%inputs%about%task == 'periodic' .and. revolutions > 1) span = filled('period of {} revolutions', &
            & [real(revolutions, wp)])
      end associate
      if (run%model%rotor%stations > 0) call print_stations(run%file, span)
      do b = 1, size(run%inputs%bearings)
         title = run%inputs%bearings(b)%title()
         call print_march(span//merge(': ', ', ', title == '')//title, run%bearing(b), &
            & run%inputs%bearings(b)%tilting())
      end do
   end subroutine print_bearings

   !> The stations that move most in this span of the motion.
   subroutine print_stations(file, span)
      class(record_type), intent(in) :: file
      character(len=*), intent(in) :: span
      real(wp), allocatable :: y(:), z(:)
      y = file%get_all('summary/station_y_size')
      z = file%get_all('summary/station_z_size')
      print '(a)', span//filled(', shaft: moves most at station {} along y, {u.3} um peak to peak, and at ' &
         & //'station {} along z, {u.3} um', [real(wp) :: maxloc(y), maxval(y), maxloc(z), maxval(z)])
   end subroutine print_stations

   !> Figures of a bearing in the last revolution or the period, behind this title; of pivots where pads tilt.
   subroutine print_march(title, file, tilting)
      character(len=*), intent(in) :: title
      class(record_type), intent(in) :: file
      logical, intent(in) :: tilting
      character(len=:), allocatable :: before, after
      integer :: i
      print '(a)', title//filled('journal y {u.2} to {u.2}, z {u.2} to {u.2} um', [figure(file, 'journal_y_min'), &
         & figure(file, 'journal_y_max'), figure(file, 'journal_z_min'), figure(file, 'journal_z_max')])
      before = ''
      after = ''
      associate (lowest => pad_figures(file, 'pad_tilt_min'), highest => pad_figures(file, 'pad_tilt_max'), &
            & contact => pad_figures(file, 'pad_contact_force'), work => pad_figures(file, 'pad_friction_work'), &
            & worn => pad_figures(file, 'pad_wear_rate'), deep => pad_figures(file, 'pad_wear_depth_rate'), &
            & film => pad_figures(file, 'pad_min_film_thickness'), pressure => pad_figures(file, 'pad_max_pressure'))
         do i = 1, size(film)
            if (tilting) then
               before = filled('tilt {m.3} to {m.3} mrad, ', [lowest(i), highest(i)])
               after = filled(', mean contact {.1} N', [contact(i)])
               if (has_figure(file, 'pad_friction_work')) after = after &
                  & //filled(', friction work {m.3} mJ a revolution', [work(i)])
               if (has_figure(file, 'pad_wear_rate')) then
                  after = after//filled(', wear {.2} mm^3', [1e9_wp*thousand_hours*worn(i)])
                  if (.not. ieee_is_nan(deep(i))) after = after//filled(' and {.2} um', [1e6_wp*thousand_hours*deep(i)])
                  after = after//' in 1000 h'
               end if
            end if
            print '(a)', filled('  pad {}: '//before//'minimum film thickness {u.2} um, maximum pressure {M.3} MPa', &
               & [real(wp) :: i, film(i), pressure(i)])//after
         end do
      end associate
   end subroutine print_march

   !> What a run cost.
   subroutine print_cost(file)
      class(record_type), intent(in) :: file
      character(len=*), parameter :: counts(9) = [character(len=20) :: 'steps', 'rhs_evaluations', &
         & 'jacobian_evaluations', 'film_table', 'film_cells', 'film_nodes', 'film_fourier', 'film_volumes', &
         & 'film_passes']
      character(len=*), parameter :: seconds(3) = [character(len=14) :: 'wall_seconds', 'film_seconds', &
         & 'output_seconds']
      character(len=:), allocatable :: weighted
      integer :: k
      weighted = ''
      if (file%has('statistics/film_weighted')) weighted = filled(', {i} by weighted functions', &
         & [file%get_real('statistics/film_weighted')])
      print '(a)', filled('cost: {i} steps, {i} right-hand sides, {i} Jacobians, films {i} from tables ({i} cells, ' &
         & //'{i} cavitated nodes), {i} by axial Fourier expansion and {i} on finite volumes ({i} passes over their ' &
         & //'cells)', [(file%get_real('statistics/'//trim(counts(k))), k=1, size(counts))])//weighted
      print '(a)', filled('  wall time {.2} s, of which film {.2} s and samples {.2} s', [( &
         & file%get_real('statistics/'//trim(seconds(k))), k=1, size(seconds))])
   end subroutine print_cost

   !> Closes the file of a run that is done, or that failed with this error.
   subroutine close_file(run, error)
      type(case_run_type), intent(inout) :: run
      type(error_type), allocatable, intent(inout) :: error
      type(error_type), allocatable :: file_error
      logical :: ended
      ended = .not. allocated(error)
      if (.not. ended) ended = error%status == numerics_error .and. run%computed
      if (ended) call run%note_figures()
      if (.not. allocated(error) .and. .not. run%quiet .and. run%file%hdf5%samples > 0 &
         & .and. run%inputs%about%task /= 'branch') call print_bearings(run)
      if (ended) call run%note_remarks(shown=.true.)
      if (.not. allocated(error)) then
         call run%note_costs()
         if (.not. run%quiet .and. run%file%hdf5%samples > 0) call print_cost(run%file)
         call run%file%finish(run%reached, 0, '', file_error)
         if (.not. allocated(file_error) .and. .not. run%quiet) print '(a)', 'written: '//run%path
      else if (error%status == numerics_error .and. (run%computed .or. run%tag%number > 0)) then
         ! of a run of a study the file says what happened; nothing else would be a result
         call run%note_costs()
         call run%file%finish(run%reached, error%status, error%message, file_error)
         ! the row of a run of a study has its file beside this
         if (run%computed .and. run%tag%number == 0) error%message = error%message//computed_in//run%path
      else if (error%status == stopped .and. run%computed) then
         if (run%file%filed) error%message = error%message//'; tiltpad --resume '//run%path//' goes on'
      else
         call run%file%abandon()
      end if
      if (allocated(file_error)) call move_alloc(file_error, error)
   end subroutine close_file
end module run_case
