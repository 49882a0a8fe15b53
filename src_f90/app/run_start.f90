!> Where a run starts: at its equilibrium, in the state that the group &start describes, or at a checkpoint.
module run_start
   use kinds, only: wp
   use text, only: to_text, filled, list_text
   use case_inputs, only: case_type
   use bearing_shape, only: bearing_shape_type, cold_shapes, apply_shapes
   use errors, only: error_type, raise, add_context, input_error, numerics_error, stopped
   use files, only: real_path
   use read_files, only: file_marks, marks_name
   use film_oils, only: film_oil
   use state_layout, only: pad_state, tilt, pivot_deflection, pitch, yaw
   use equilibrium_record, only: equilibrium_type
   use bearing_equilibrium, only: find_partial_equilibrium
   use equilibrium, only: find_equilibrium, settle_equilibrium
   use held_journal, only: find_held_equilibrium, take_load
   use equations_of_motion, only: machine_model
   use static_model, only: make_fine
   use film_network, only: warm_films_type
   use heat_balance_equations, only: has_warm_oil
   use equilibrium_notes, only: note_equilibrium
   use last_state, only: read_last_state
   use summary_group, only: put_figure
   use run_file, only: run_file_type
   use bearing_file, only: bearing_file_type, new_bearing_file
   use machine_results, only: put_machine, put_origin, read_origin
   use march_results, only: put_viscosity_history
   use equilibrium_results, only: read_shape, put_oil, read_oil
   use stop_signals, only: stop_reason
   use case_run, only: case_run_type
   use viscosity_history, only: viscosity_history_type
   use thermal_equilibrium, only: find_groove_transient
   implicit none (type, external)
   private
   public :: seek_equilibrium, find_converged_equilibrium, make_start, take_oil
   public :: restore_shape, restore_oil, continue_from_checkpoint

contains

   !> Creates the file of a run.
   subroutine create_file(run, error)
      type(case_run_type), intent(inout) :: run
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: files
      call run%file%start(run%inputs, error)
      if (allocated(error)) return
      files = file_marks(run%inputs)
      if (files /= '') call run%file%put_text(marks_name, files)
      call put_machine(run%file, run%inputs, run%model%rotor)
      associate (excitations => size(run%inputs%excitations))
         if (excitations > 0) call run%file%put_scale('excitation', excitations, 'excitation number')
      end associate
      if (run%tag%number > 0) call run%file%put_tag(run%tag)
   end subroutine create_file

   !> Creates the file, finds the equilibrium from which a motion starts and writes it; y is its state.
   subroutine start_at_equilibrium(run, error, y)
      type(case_run_type), intent(inout) :: run
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable, intent(out) :: y(:)
      type(equilibrium_type) :: static
      call seek_equilibrium(run, static, error)
      if (allocated(error)) return
      call note_equilibrium(run, static)
      call run%model%rotor%move_about(static%rotor)
      call put_origin(run%file, run%inputs, static%rotor)
      y = run%model%static_state(static%rotor, static%pads)
   end subroutine start_at_equilibrium

   !> Creates the file, finds the equilibrium of converged films, y in their model, and writes it.
   subroutine find_converged_equilibrium(run, fine, y, error, films)
      type(case_run_type), intent(inout) :: run
      type(machine_model), intent(out) :: fine
      real(wp), allocatable, intent(out) :: y(:)
      type(error_type), allocatable, intent(out) :: error
      !> Temperatures in the films, where these have some.
      type(warm_films_type), allocatable, intent(out), optional :: films(:)
      type(equilibrium_type) :: static
      call seek_equilibrium(run, static, error, settles=.true.)
      if (allocated(error)) return
      call make_fine(run%model, fine)
      if (run%inputs%held%is_wanted()) then
         call find_held_equilibrium(fine, run%inputs, static, error, known=.true.)
         call take_load(run%model, fine%point%load)
         if (.not. allocated(error)) y = fine%static_state(static%rotor, static%pads)
      else
         call settle_equilibrium(fine, static, y, error)
      end if
      if (allocated(error)) then
         call add_context(error, 'with converged films')
         call say_nothing_computed(error)
         return
      end if
      call note_equilibrium(run, static)
      if (present(films) .and. allocated(static%films)) films = static%films
   end subroutine find_converged_equilibrium

   !> Creates the file and finds the equilibrium (`settles` of find_equilibrium).
   subroutine seek_equilibrium(run, static, error, settles)
      type(case_run_type), intent(inout) :: run
      type(equilibrium_type), intent(out) :: static
      type(error_type), allocatable, intent(out) :: error
      logical, intent(in), optional :: settles
      call create_file(run, error)
      if (allocated(error)) return
      if (run%inputs%held%is_wanted()) then
         call find_held_equilibrium(run%model, run%inputs, static, error)
      else
         call find_equilibrium(run%model, static, error, settles)
      end if
      call say_nothing_computed(error)
      if (.not. allocated(error)) call take_shapes(run, static%shapes)
   end subroutine seek_equilibrium

   !> Gives the model of a run the shapes of its equilibrium, where that changes one; all that follows keeps them.
   subroutine take_shapes(run, shapes)
      type(case_run_type), intent(inout) :: run
      type(bearing_shape_type), allocatable, intent(in) :: shapes(:)
      type(case_type) :: inputs
      if (.not. allocated(shapes)) return
      inputs = run%model%inputs
      call apply_shapes(shapes, inputs)
      call run%model%adopt(inputs, .true.)
      run%shapes = shapes
   end subroutine take_shapes

   !> Gives the model the shapes that a result of the run has, if it has any; before its oil.
   subroutine restore_shape(run, file, error)
      type(case_run_type), intent(inout) :: run
      class(run_file_type), intent(in), target :: file
      type(error_type), allocatable, intent(inout) :: error
      type(bearing_shape_type), allocatable :: shapes(:)
      integer :: b
      if (.not. any(run%inputs%bearings%changes_shape())) return
      shapes = cold_shapes(run%inputs)
      do b = 1, size(shapes)
         associate (bearing => run%inputs%bearings(b))
            if (bearing%changes_shape() .and. .not. allocated(error)) call read_shape(new_bearing_file(file, bearing), &
               & shapes(b), error)
         end associate
      end do
      call add_context(error, run%path)
      if (.not. allocated(error)) call take_shapes(run, shapes)
   end subroutine restore_shape

   !> What an error says of a signal that stops a run before its march.
   subroutine say_nothing_computed(error)
      type(error_type), allocatable, intent(inout) :: error
      if (.not. allocated(error)) return
      if (error%status == stopped) error%message = stop_reason()//' before the march; nothing was computed yet'
   end subroutine say_nothing_computed

   !> Creates the file and finds the state y to start from.
   subroutine make_start(run, y, error, equilibrium_state)
      type(case_run_type), intent(inout) :: run
      real(wp), allocatable, intent(out) :: y(:)
      type(error_type), allocatable, intent(out) :: error
      !> The equilibrium, if it was sought.
      real(wp), allocatable, intent(out), optional :: equilibrium_state(:)
      real(wp), allocatable :: rotor(:)
      type(pad_state), allocatable :: pads(:)
      logical :: ok
      associate (model => run%model, from => run%inputs%start%from)
         if (from == 'equilibrium') then
            call start_at_equilibrium(run, error, y)
            if (.not. allocated(error)) call let_grooves_warm(run, y, error)
            if (.not. allocated(error)) call note_oil(run)
            if (present(equilibrium_state) .and. .not. allocated(error)) equilibrium_state = y
            if (allocated(error) .or. .not. run%inputs%is_disturbed()) return
            rotor = y(:model%rotor%states)
            pads = model%layout%elements(1)%pad_states(y)
         else
            allocate (pads(model%layout%pads), rotor(model%rotor%states))
            rotor = 0
            if (from == 'file') call start_from_file(run, rotor, pads, error)
            if (from /= 'partial' .and. .not. allocated(error)) call take_oil(run, .false., error, equilibrium_state)
            if (.not. allocated(error)) call create_file(run, error)
            call run%note_shapes()
            if (from == 'partial' .and. .not. allocated(error)) call start_partially(run, rotor, pads, error)
            if (allocated(error)) return
            call note_oil(run)
         end if
         call disturb(run, rotor, pads)
         if (.not. allocated(y)) allocate (y(model%n))
         y(:size(rotor)) = rotor
         call model%layout%put_all_pads(pads, y)
         call model%evaluate(0.0_wp, y, .false., ok)
         if (.not. ok) then
            call raise(error, numerics_error, model%refusal)
            call add_context(error, 'no march can start from '''//from//''' with the values of the group start')
            return
         end if
      end associate
      run%computed = .true.
      if (.not. run%quiet) call print_start(run%inputs, rotor, pads)
   end subroutine make_start

   !> Where a march starts that does not start at the equilibrium itself: displacements of the journals, which stand
   !> first, m, and states of the pads of all bearings.
   subroutine print_start(inputs, journals, pads)
      type(case_type), intent(in) :: inputs
      real(wp), intent(in) :: journals(:)
      type(pad_state), intent(in) :: pads(:)
      character(len=:), allocatable :: tilts
      integer :: b, before
      before = 0
      do b = 1, size(inputs%bearings)
         associate (own => inputs%bearings(b))
            tilts = ''
            associate (its => pads(before + 1:before + own%pad_count()))
               if (own%tilting()) tilts = ', tilts '//list_text(1e3_wp*its%x(tilt), 4)//' mrad'
               if (own%pitching()) tilts = tilts//', pitch '//list_text(1e3_wp*its%x(pitch), 4)//' mrad'
            end associate
            before = before + own%pad_count()
            print '(a)', 'start from '''//inputs%start%from//''': '//own%title()//filled('journal y {u.3}, z {u.3} ' &
               & //'um', journals(2*b - 1:2*b))//tilts
         end associate
      end do
   end subroutine print_start

   !> Writes the viscosities of warm oil at the start of the march, and their course where they change. A branch has
   !> them for each of its points.
   subroutine note_oil(run)
      type(case_run_type), intent(inout) :: run
      type(bearing_file_type) :: file
      integer :: b
      if (run%inputs%about%task == 'branch') return
      do b = 1, size(run%model%bearings)
         file = run%bearing(b)
         associate (pads => run%model%layout%elements(b)%all_pads())
            if (has_warm_oil(run%model)) call put_oil(file, '', run%model%oil(pads))
            if (run%model%oil_history%runs()) call put_viscosity_history(file, run%model%oil_history, pads)
         end associate
      end do
   end subroutine note_oil

   !> Gives warm oil the viscosities, and the bearing the shape, of the equilibrium, which it keeps in a march that
   !> starts elsewhere.
   subroutine take_oil(run, partly, error, equilibrium_state)
      type(case_run_type), intent(inout) :: run
      !> Whether it is the equilibrium of the pads that have one.
      logical, intent(in) :: partly
      type(error_type), allocatable, intent(inout) :: error
      !> The equilibrium, if it was sought.
      real(wp), allocatable, intent(out), optional :: equilibrium_state(:)
      type(equilibrium_type) :: static
      real(wp), allocatable :: y(:)
      logical, allocatable :: held(:)
      if (.not. (has_warm_oil(run%model) .or. any(run%inputs%bearings%changes_shape()))) return
      if (partly) then
         call find_partial_equilibrium(run%model, static, held, error)
      else
         call find_equilibrium(run%model, static, error)
      end if
      if (.not. allocated(error)) then
         call take_shapes(run, static%shapes)
         run%model%oil = static%oil
         y = run%model%static_state(static%rotor, static%pads)
         call let_grooves_warm(run, y, error)
         if (present(equilibrium_state)) equilibrium_state = y
      else if (error%status == stopped) then
         error%message = stop_reason()//' while the equilibrium was sought'
      else
         call add_context(error, 'oil and shape are those of the equilibrium')
      end if
   end subroutine take_oil

   !> Gives warm oil what a result of the run says of it; where it takes its course in a run-up, what led to this.
   subroutine restore_oil(run, file, error)
      type(case_run_type), intent(inout) :: run
      class(run_file_type), intent(in), target :: file
      type(error_type), allocatable, intent(inout) :: error
      type(film_oil), allocatable :: oil(:)
      integer :: b
      if (.not. has_warm_oil(run%model)) return
      if (oil_takes_course(run)) then
         call take_oil(run, run%inputs%start%from == 'partial', error)
         return
      end if
      do b = 1, size(run%model%bearings)
         associate (pads => run%model%layout%elements(b)%all_pads())
            oil = run%model%oil(pads)
            if (.not. allocated(error)) call read_oil(new_bearing_file(file, run%inputs%bearings(b)), '', oil, error)
            run%model%oil(pads) = oil
         end associate
      end do
      call add_context(error, run%path)
   end subroutine restore_oil

   !> Whether grooves warm or cool in the march.
   pure logical function oil_takes_course(run)
      type(case_run_type), intent(in) :: run
      oil_takes_course = run%inputs%thermal%march == 'groove' .and. abs(run%model%point%acceleration) > 0
   end function oil_takes_course

   !> Where the speed changes and the input wants it, the oil takes its course from the equilibrium y on.
   subroutine let_grooves_warm(run, y, error)
      type(case_run_type), intent(inout) :: run
      real(wp), intent(in) :: y(:)
      type(error_type), allocatable, intent(inout) :: error
      type(viscosity_history_type) :: history
      if (.not. oil_takes_course(run)) return
      call find_groove_transient(run%model, y, run%inputs%operation%duration, history, error)
      if (allocated(error)) return
      run%model%oil_history = history
   end subroutine let_grooves_warm

   !> State and time, s, of the checkpoint in the file.
   subroutine continue_from_checkpoint(run, t, y, error)
      type(case_run_type), intent(inout) :: run
      real(wp), intent(out) :: t
      real(wp), allocatable, intent(out) :: y(:)
      type(error_type), allocatable, intent(out) :: error
      allocate (y(run%model%n))
      call run%resume(t, error, y)
      if (.not. allocated(error)) call restore_shape(run, run%file, error)
      if (.not. allocated(error)) call restore_oil(run, run%file, error)
      if (allocated(error)) return
      call read_origin(run%file, run%inputs, run%model%rotor)
      run%computed = .true.
      if (.not. run%quiet) print '(a)', 'going on from t = '//to_text(t)//' s'
   end subroutine continue_from_checkpoint

   !> The last state of another result.
   subroutine start_from_file(run, rotor, pads, error)
      type(case_run_type), intent(in) :: run
      real(wp), intent(out) :: rotor(:)
      type(pad_state), intent(inout) :: pads(:)
      type(error_type), allocatable, intent(out) :: error
      associate (file => run%inputs%start%file)
         if (real_path(file) == real_path(run%path)) then
            call raise(error, input_error, 'start%file = '''//file//''': is the result of this run itself; name ' &
               & //'another with --output')
         else
            call read_last_state(file, run%inputs, run%model, rotor, pads, error)
            call add_context(error, 'start%file')
         end if
      end associate
   end subroutine start_from_file

   !> Journal and loaded pads in equilibrium, and pads without equilibrium held at zero tilt on their pivots.
   subroutine start_partially(run, rotor, pads, error)
      type(case_run_type), intent(inout) :: run
      real(wp), intent(inout) :: rotor(:)
      type(pad_state), intent(inout) :: pads(:)
      type(error_type), allocatable, intent(out) :: error
      type(equilibrium_type) :: static
      logical, allocatable :: held(:)
      call find_partial_equilibrium(run%model, static, held, error)
      call say_nothing_computed(error)
      if (allocated(error)) return
      rotor(:size(static%rotor)) = static%rotor
      pads = static%pads
      run%model%oil = static%oil
      call put_figure(run%file, 'pad_without_equilibrium', merge(1.0_wp, 0.0_wp, held), '1', &
         & '1 where it has no equilibrium: the march starts without tilt')
   end subroutine start_partially

   !> Adds the values of the group, if it has any.
   pure subroutine disturb(run, rotor, pads)
      type(case_run_type), intent(in) :: run
      real(wp), intent(inout) :: rotor(:)
      type(pad_state), intent(inout) :: pads(:)
      if (.not. run%inputs%is_disturbed()) return
      associate (s => run%inputs%start)
         rotor = rotor + [s%journal, s%journal_velocity]
         pads%x(tilt) = pads%x(tilt) + s%pad_tilt
         pads%v(tilt) = pads%v(tilt) + s%pad_tilt_rate
         pads%x(pivot_deflection) = pads%x(pivot_deflection) + s%pivot_deflection
         pads%v(pivot_deflection) = pads%v(pivot_deflection) + s%pivot_deflection_rate
         pads%x(pitch) = pads%x(pitch) + s%pad_pitch
         pads%v(pitch) = pads%v(pitch) + s%pad_pitch_rate
         pads%x(yaw) = pads%x(yaw) + s%pad_yaw
         pads%v(yaw) = pads%v(yaw) + s%pad_yaw_rate
      end associate
   end subroutine disturb
end module run_start
