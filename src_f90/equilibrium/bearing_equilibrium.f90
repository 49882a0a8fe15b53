!> Static equilibrium of a rigid journal and the pads of one bearing at constant speed: no unbalance, no friction.
!>
!> The first search is pseudo-transient continuation (static_model) from the best of some positions along the load;
!> where it fails, from the equilibrium with full films. Where these fail, or find an equilibrium that no motion dwells
!> in, a wider one follows from all these positions: by small problems of the pads, and by pseudo-transient
!> continuation. docs/stability.md counts what each finds.
module bearing_equilibrium
   use kinds, only: wp, degree, pi
   use text, only: to_text
   use errors, only: error_type, raise, numerics_error, stopped, asked
   use state_layout, only: tilt
   use equations_of_motion, only: machine_model
   use pad_elimination, only: eliminate_pads, search_pads
   use equilibrium_record, only: equilibrium_type, describe, describe_with_stability
   use static_model, only: make_static, make_quick, solve_equilibrium, start, starts, follow_motion, unbalanced, &
      & newtons, residual_limit
   use heat_balance_equations, only: has_warm_oil
   use thermal_equilibrium, only: guess_oil, guesses, solve_thermal_equilibrium, solve_warm_films
   use film_network, only: warm_films_type
   use kinematics, only: in_mirror
   use force_balance, only: masses, force_derivatives, find_vibrations
   implicit none (type, external)
   private
   public :: find_bearing_equilibrium, find_partial_equilibrium, settle, search_traces, refusal, listed

   !> The methods of the wider search, in their order.
   character(len=*), parameter :: methods(*) = [character(len=6) :: 'pads', 'newton']
   !> Iterations from an equilibrium of quick films to that of the model's own: the 535 of docs/stability.md that
   !> succeed take 35 at most. Iterations of the first search from a start along the load, after which full films lead
   !> to the equilibrium of most unloaded pads: of 813 searches that succeed 90 % end within 42.
   integer, parameter :: last_iterations = 40, first_iterations = 60
   !> Residual of quick films from which on this is tried.
   real(wp), parameter :: quick_residual = 0.1_wp

   !> What the searches left behind.
   type :: search_traces
      !> What the first search said at its end.
      character(len=:), allocatable :: last_words
      !> Pads that found no equilibrium where the journal and the others did.
      logical, allocatable :: without_equilibrium(:)
      !> Growth, 1/s, of the last statically unstable equilibrium, 0: none was found; pads that leave it.
      real(wp) :: divergence = 0
      logical, allocatable :: leaving(:)
      !> Pads that are held in the partial equilibrium; not allocated where there is none.
      logical, allocatable :: held(:)
      !> Whether the first search ended at a film that did not converge: no other search would help.
      logical :: films_fail = .false.
   end type search_traces

   !> A pad leaves an equilibrium if its edge moves at least by this part of what moves most.
   real(wp), parameter :: moves = 0.5_wp
   !> Cosine of the angle between load and pivot below which one pad carries a load that points past it.
   real(wp), parameter :: through_pivot = 0.999_wp
   !> What changes the load of a bearing.
   character(len=*), parameter :: of_load = 'rotor%static_load; in a machine bearing%offset and load%force'

contains

   !> The equilibrium of a model under its load at its initial speed, stable or of oscillatory instability, with the
   !> temperatures of warm oil; an error where none is found, or, of status `stopped`, where its `give_up`, asked
   !> between evaluations of the films, says so.
   recursive subroutine find_bearing_equilibrium(model, found, error, by_heat, settles)
      type(machine_model), intent(in) :: model
      type(equilibrium_type), intent(out) :: found
      type(error_type), allocatable, intent(out) :: error
      !> Whether the error is that of the temperatures: with oil that keeps its viscosities there is an equilibrium.
      logical, intent(out), optional :: by_heat
      !> Whether `settle` follows, by a model with converged films.
      logical, intent(in), optional :: settles
      type(machine_model) :: warm, static
      type(search_traces) :: traces
      real(wp), allocatable :: y(:)
      type(warm_films_type), allocatable :: films(:)
      integer :: guess
      !> Whether there is an equilibrium with these viscosities; with some, and a temperature for each pad.
      logical :: at_rest, with_pads
      if (present(by_heat)) by_heat = .false.
      if (pushed_away(model)) then
         call raise(error, numerics_error, refusal(model, traces))
         return
      end if
      if (.not. has_warm_oil(model)) then
         call find_isothermal(model, found, error)
         return
      end if
      warm = model
      with_pads = .false.
      do guess = 1, guesses
         call guess_oil(warm, guess)
         if (allocated(films)) deallocate (films)
         call find_warm()
         if (.not. allocated(error)) then
            if (is_usable(static, y, found, traces)) return
            ! what is statically unstable with its temperatures often has a stable neighbour that has nearly the same
            warm%oil = static%oil
            if (allocated(found%films)) call move_alloc(found%films, films)
            call find_warm()
            if (.not. allocated(error)) then
               if (is_usable(static, y, found, traces)) return
            else if (error%status /= stopped) then
               ! the equilibrium before is there all the same, and says why it is none to start from
               deallocate (error)
            end if
         end if
         if (.not. allocated(error)) cycle
         if (error%status == stopped) return
         if (guess < guesses) deallocate (error)
      end do
      if (present(by_heat)) by_heat = at_rest .and. allocated(error)
      if (.not. allocated(error)) then
         call note_partial(model, traces)
         call raise(error, numerics_error, refusal(model, traces))
      end if
      if (with_pads) call offer_pads(model, error)

   contains

      !> The equilibrium with the viscosities that there are, and from there the one with its own temperatures.
      subroutine find_warm()
         call find_isothermal(warm, found, error)
         at_rest = .not. allocated(error)
         if (.not. at_rest) return
         call make_static(warm, warm%point%cavitation, static)
         y = static%static_state(found%rotor, found%pads)
         if (allocated(films)) then
            call solve_warm_films(static, y, films, found%residual, error)
            if (.not. allocated(error)) call move_alloc(films, found%films)
         else
            call solve_thermal_equilibrium(static, y, found%residual, error, films=found%films, settles=settles)
            if (allocated(error) .and. .not. allocated(found%films)) call name_start()
         end if
         with_pads = with_pads .or. allocated(found%films)
      end subroutine find_warm

      !> Says of an error that it is that of the temperatures with which the search for those of films begins.
      subroutine name_start()
         if (model%inputs%thermal%model /= 'film' .or. error%status == stopped) return
         error%message = error%message//' (so it is with one temperature a pad, with which the search begins)'
      end subroutine name_start
   end subroutine find_bearing_equilibrium

   !> Says in a refusal of a model whose films have temperatures along and across whether it has an equilibrium with a
   !> temperature for each pad.
   recursive subroutine offer_pads(model, error)
      type(machine_model), intent(in) :: model
      type(error_type), allocatable, intent(inout) :: error
      type(machine_model) :: other
      type(equilibrium_type) :: found
      type(error_type), allocatable :: other_error
      other = model
      other%inputs%thermal%model = 'pad'
      call find_bearing_equilibrium(other, found, other_error)
      if (.not. allocated(other_error)) error%message = error%message//'; thermal%model = ''pad'' has an equilibrium'
   end subroutine offer_pads

   !> The equilibrium with the viscosities that the model has.
   subroutine find_isothermal(model, found, error)
      type(machine_model), intent(in) :: model
      type(equilibrium_type), intent(out) :: found
      type(error_type), allocatable, intent(out) :: error
      type(machine_model) :: static
      type(search_traces) :: traces
      real(wp), allocatable :: y(:)
      logical :: by_full_films
      call make_static(model, model%point%cavitation, static)
      call search_first()
      if (.not. allocated(error)) then
         found%search = trim(merge('full films', 'first     ', by_full_films))
         if (is_usable(static, y, found, traces)) return
      else if (error%status == stopped) then
         return
      else
         traces%last_words = error%message
         if (traces%films_fail) then
            call raise(error, numerics_error, refusal(model, traces))
            return
         end if
      end if
      call search_wider()
      if (allocated(error)) deallocate (error)
      if (asked(model%give_up)) then
         call raise(error, stopped, 'stopped while the equilibrium was sought')
      else if (.not. allocated(found%pads)) then
         call note_partial(model, traces)
         call raise(error, numerics_error, refusal(model, traces))
      end if

   contains

      !> From the best start along the load; with films that cavitate also from the equilibrium with full films: on the
      !> way a pad may lose its film and with it all stiffness.
      subroutine search_first()
         type(machine_model) :: whole
         type(error_type), allocatable :: second_error
         real(wp), allocatable :: y_whole(:)
         y = best_start(static)
         call follow_motion(static, y, found%residual, error, &
            & most=merge(first_iterations, huge(first_iterations), static%bearings(1)%film%cavitates()))
         traces%films_fail = .not. static%bearings(1)%films_converge()
         by_full_films = .false.
         if (.not. allocated(error) .or. .not. static%bearings(1)%film%cavitates()) return
         if (error%status == stopped) return
         call make_static(model, .false., whole)
         y_whole = best_start(whole)
         call follow_motion(whole, y_whole, found%residual, second_error)
         if (.not. allocated(second_error)) then
            call make_static(model, model%point%cavitation, static)
            call follow_motion(static, y_whole, found%residual, second_error)
         end if
         if (.not. allocated(second_error)) then
            y = y_whole
            deallocate (error)
            traces%films_fail = .false.
            by_full_films = .true.
         else if (second_error%status == stopped) then
            call move_alloc(second_error, error)
         end if
      end subroutine search_first

      !> From every start by every method, up to the first stable equilibrium; where there is none, `found` is the one
      !> that grows least, or has no pads. All is sought with quick films; their equilibrium leads to the model's own.
      subroutine search_wider()
         type(machine_model) :: quick
         type(equilibrium_type) :: candidate
         type(error_type), allocatable :: ignored
         integer :: method, k
         logical :: ok
         if (allocated(found%pads)) deallocate (found%pads)
         call make_quick(static, quick)
         do method = 1, size(methods)
            do k = 1, starts
               if (asked(static%give_up)) return
               y = start(quick, k)
               call approach(quick, methods(method), y, traces, ok)
               if (.not. ok) cycle
               ! quick films leap by their error: where they do, nothing comes to equilibrium
               call follow_motion(quick, y, candidate%residual, ignored, first_step=newtons)
               if (candidate%residual > quick_residual) cycle
               call solve_equilibrium(static, y, candidate%residual, ignored, most=last_iterations)
               if (allocated(ignored)) cycle
               if (.not. is_usable(static, y, candidate, traces)) cycle
               if (.not. is_better(candidate, found)) cycle
               found = candidate
               found%search = trim(methods(method))
               if (found%stability%name == 'stable' .and. found%residual <= residual_limit) return
            end do
         end do
      end subroutine search_wider
   end subroutine find_isothermal

   !> Notes whether a march can start from a partial equilibrium, and which pads are held there.
   subroutine note_partial(model, traces)
      type(machine_model), intent(in) :: model
      type(search_traces), intent(inout) :: traces
      type(equilibrium_type) :: partial
      type(error_type), allocatable :: error
      logical, allocatable :: held(:)
      if (.not. model%layout%elements(1)%has(tilt)) return
      call find_partial_equilibrium(model, partial, held, error)
      if (.not. allocated(error)) traces%held = held
   end subroutine note_partial

   !> The start, among positions along the load, with the smallest unbalanced force.
   function best_start(model) result(y)
      type(machine_model), intent(inout) :: model
      real(wp) :: y(model%n), trial(model%n), smallest, force
      integer :: k
      logical :: ok
      smallest = huge(smallest)
      y = start(model, 3)
      do k = 1, starts
         if (asked(model%give_up)) exit
         trial = start(model, k)
         call model%evaluate(0.0_wp, trial, .false., ok)
         if (.not. ok) cycle
         force = unbalanced(model, trial)
         if (force < smallest) then
            smallest = force
            y = trial
         end if
      end do
   end function best_start

   !> Whether an equilibrium is to be kept instead of another one, which may have no pads: first the one that no leap of
   !> the films disturbs, then the one that grows less.
   pure logical function is_better(candidate, found)
      type(equilibrium_type), intent(in) :: candidate, found
      is_better = .not. allocated(found%pads)
      if (is_better) return
      if (candidate%residual <= residual_limit .neqv. found%residual <= residual_limit) then
         is_better = candidate%residual <= residual_limit
      else
         is_better = candidate%stability%eigenvalue%re < found%stability%eigenvalue%re
      end if
   end function is_better

   !> Brings y near an equilibrium by one of the methods. Pads that find no equilibrium of their own are sought from
   !> many tilts, once.
   subroutine approach(model, method, y, traces, ok)
      type(machine_model), intent(inout) :: model
      character(len=*), intent(in) :: method
      real(wp), intent(inout) :: y(:)
      type(search_traces), intent(inout) :: traces
      logical, intent(out) :: ok
      type(error_type), allocatable :: error
      logical :: in_equilibrium(model%layout%pads)
      real(wp) :: residual, y_of_pads(size(y))
      logical :: by_films
      if (method == 'newton') then
         call follow_motion(model, y, residual, error)
         ok = residual <= quick_residual
         return
      end if
      y_of_pads = y
      by_films = .true.
      call eliminate_pads(model, y, in_equilibrium, ok, by_films)
      if (.not. ok) then
         y = y_of_pads
         by_films = .false.
         call eliminate_pads(model, y, in_equilibrium, ok, by_films)
      end if
      if (.not. ok .or. all(in_equilibrium)) return
      call search_pads(model, y, in_equilibrium, by_films)
      if (.not. all(in_equilibrium)) traces%without_equilibrium = .not. in_equilibrium
      ! where a pad finds no equilibrium Newton's method on the whole may still find one, with the journal elsewhere
      y_of_pads = y
      call eliminate_pads(model, y_of_pads, in_equilibrium, ok, by_films)
      if (ok .and. all(in_equilibrium)) y = y_of_pads
      ok = .true.
   end subroutine approach

   !> Describes the equilibrium y, where the model was evaluated last, and says whether a motion can start there.
   logical function is_usable(model, y, found, traces)
      type(machine_model), intent(inout) :: model
      real(wp), intent(in) :: y(:)
      type(equilibrium_type), intent(inout) :: found
      type(search_traces), intent(inout) :: traces
      type(error_type), allocatable :: error
      call describe_with_stability(model, y, found, error)
      is_usable = .not. allocated(error)
      if (.not. is_usable) return
      is_usable = found%stability%name /= 'static instability'
      if (.not. is_usable) call note_divergence(model, traces)
   end function is_usable

   !> The partial equilibrium of a model under its load at its initial speed, and which pads are held; none where all
   !> find their equilibrium. An error where the journal finds none, or, of status `stopped`, where its `give_up`, asked
   !> between evaluations of the films, says so. The record has no stability.
   subroutine find_partial_equilibrium(model, found, held, error)
      type(machine_model), intent(in) :: model
      type(equilibrium_type), intent(out) :: found
      logical, allocatable, intent(out) :: held(:)
      type(error_type), allocatable, intent(out) :: error
      type(machine_model) :: static, quick
      real(wp) :: y(model%n)
      logical :: in_equilibrium(model%layout%pads), ok
      integer :: k
      call make_static(model, model%point%cavitation, static)
      if (has_warm_oil(model)) call guess_oil(static, 1)
      call make_quick(static, quick)
      do k = 1, starts
         y = start(quick, k)
         call eliminate_pads(quick, y, in_equilibrium, ok, by_films=.true.)
         if (asked(model%give_up)) then
            call raise(error, stopped, 'stopped while the equilibrium was sought')
            return
         end if
         if (.not. ok) cycle
         held = .not. in_equilibrium
         call solve_thermal_equilibrium(static, y, found%residual, error, held, films=found%films)
         if (.not. allocated(error)) then
            call describe(static, y, found)
            return
         end if
         if (error%status == stopped) return
      end do
      call raise(error, numerics_error, 'no partial equilibrium found at '//to_text(model%point%speed_rpm) &
         & //' rpm: the journal finds no equilibrium on pads that do')
   end subroutine find_partial_equilibrium

   !> Brings an equilibrium that another model has found to that of this one, whose films differ a little; y is its
   !> state.
   subroutine settle(model, found, y, error)
      type(machine_model), intent(inout) :: model
      type(equilibrium_type), intent(inout) :: found
      real(wp), allocatable, intent(out) :: y(:)
      type(error_type), allocatable, intent(out) :: error
      y = model%static_state(found%rotor, found%pads)
      model%oil = found%oil
      if (any(model%oil%varies)) then
         ! the temperatures of films stay what they are
         call solve_equilibrium(model, y, found%residual, error)
      else
         call solve_thermal_equilibrium(model, y, found%residual, error)
      end if
      if (.not. allocated(error)) call describe_with_stability(model, y, found, error)
   end subroutine settle

   ! Why a bearing has no equilibrium to start from, and what may help: in one line.

   !> The message of a refusal: the cause, what the searches found, and what may help.
   function refusal(model, traces) result(message)
      type(machine_model), intent(in) :: model
      type(search_traces), intent(in) :: traces
      character(len=:), allocatable :: message
      message = 'no equilibrium found at '//to_text(model%point%speed_rpm)//' rpm: '
      if (traces%films_fail) then
         message = message//traces%last_words
         return
      end if
      message = message//cause()
      if (traces%divergence > 0) then
         message = message//' (an equilibrium that was found is statically unstable (divergence): a small motion '
         if (any(traces%leaving)) message = message//'of '//listed(traces%leaving)//' '
         message = message//'grows by '//to_text(traces%divergence)//' 1/s)'
      else if (allocated(traces%last_words)) then
         message = message//' ('//traces%last_words//')'
      end if

   contains

      !> The most likely cause with what helps.
      function cause()
         character(len=:), allocatable :: cause
         integer :: pads
         logical :: arcs
         pads = model%layout%pads
         ! pads that do not tilt freely carry with all their arcs
         arcs = .not. model%layout%elements(1)%has(tilt) .or. any(model%bearings(1)%pads%rotational_stiffness > 0)
         if (.not. norm2(model%point%load) > 0 .and. pads <= 2) then
            cause = 'without load '//to_text(pads)//trim(merge(' pad pushes', ' pads push ', pads == 1)) &
               & //' the journal away; give it a load or pads on all sides'
         else if (arcs .and. load_on_pads(model, arcs)) then
            cause = 'the films do not hold the journal; try another load ('//of_load//') or clearance'
         else if (pads == 1 .and. .not. load_on_pads(model, arcs)) then
            cause = 'the load points past the only pad; turn the load ('//of_load//') or the pad ' &
               & //'(pads%pivot_angle_deg)'
         else if (pads == 1) then
            cause = 'one pad: the journal rolls off it; add a second pad (pads%pivot_angle_deg) or fix ' &
               & //'it (pads%motion = ''fixed'')'
         else if (.not. load_on_pads(model, arcs)) then
            ! the angle counted as that of a pivot
            associate (load => model%point%load)
               cause = 'the load points to '//to_text(anint(10*atan2(load(1), load(2))/degree)/10) &
                  & //' deg, where no pad is; turn the load ('//of_load//') or add a pad there ' &
                  & //'(pads%pivot_angle_deg)'
            end associate
         else if (allocated(traces%without_equilibrium)) then
            cause = listed(traces%without_equilibrium) &
               & //trim(merge(' has ', ' have', count(traces%without_equilibrium) == 1)) &
               & //' no equilibrium (unloaded)'//help()
         else if (pads == 2) then
            cause = 'two pads that push the journal away; try another angle between them (pads%pivot_angle_deg) ' &
               & //'or another pads%pivot_ratio'
         else if (traces%divergence > 0) then
            cause = 'the motion leaves every equilibrium that was found'//help()
         else if (any_held()) then
            cause = listed(traces%held)//' (unloaded) did not come to equilibrium'//help()
         else
            cause = 'the search did not end; try another load or clearance'
            if (model%layout%elements(1)%has(tilt)) cause = cause//', or'//other_start()
         end if
      end function cause

      !> What helps pads that no film holds.
      function help()
         character(len=:), allocatable :: help
         help = '; try more preload, or'//other_start()
      end function help

      !> Where a march can start without an equilibrium.
      function other_start()
         character(len=:), allocatable :: other_start
         other_start = ' (but not in a machine) a march from another start ('
         if (model%inputs%about%task /= 'march') other_start = other_start//'case%task = ''march'', '
         other_start = other_start//'start%from = '''//merge('partial', 'centred', allocated(traces%held))//''')'
      end function other_start

      !> Whether pads are held in a partial equilibrium.
      pure logical function any_held()
         any_held = .false.
         if (allocated(traces%held)) any_held = any(traces%held)
      end function any_held
   end function refusal

   !> Notes how a statically unstable equilibrium is left, in which the derivatives of the model were taken last.
   subroutine note_divergence(model, traces)
      type(machine_model), intent(in) :: model
      type(search_traces), intent(inout) :: traces
      real(wp), dimension(model%layout%n_positions(), model%layout%n_positions()) :: stiffness, damping
      complex(wp) :: values(2*size(stiffness, 1)), shapes(size(stiffness, 1), 2*size(stiffness, 1))
      real(wp) :: edge(model%layout%pads)
      integer :: i, k
      logical :: ok
      call force_derivatives(model, stiffness, damping)
      call find_vibrations(masses(model), stiffness, damping, values, ok, shapes)
      if (.not. ok) return
      k = maxloc(values%re, dim=1, mask=abs(values%im) <= 0)
      traces%divergence = values(k)%re
      edge = 0
      do i = 1, merge(size(edge), 0, model%layout%elements(1)%has(tilt))
         associate (gap => model%bearings(1)%pads(i)%gap)
            edge(i) = abs(shapes(model%layout%elements(1)%first_position(i), k))*0.5_wp*gap%arc()*gap%pad_radius()
         end associate
      end do
      traces%leaving = edge >= moves*max(maxval(edge), norm2(abs(shapes(:2, k))))
   end subroutine note_divergence

   !> True where the films, which only push, push the journal the way of its load, so that there is no equilibrium.
   pure logical function pushed_away(model)
      type(machine_model), intent(in) :: model
      pushed_away = .false.
      associate (bearing => model%bearings(1))
         if (.not. bearing%film%cavitates()) return
         if (any(bearing%pads%gap%ambient_pressure > bearing%pads%gap%cavitation_pressure)) return
         pushed_away = .not. load_on_pads(model, arcs=.true.)
      end associate
   end function pushed_away

   !> True where pads can carry the load: a pad that tilts carries through its pivot, so that the load must lie between
   !> pivots less than half a turn apart (or, of one pad, point through it); a fixed pad carries with all its arc, and
   !> so does any beside its own weight.
   pure logical function load_on_pads(model, arcs)
      type(machine_model), intent(in) :: model
      !> With all their arcs, or through their pivots.
      logical, intent(in) :: arcs
      real(wp), allocatable :: angles(:)
      real(wp) :: load(2), first(2), second(2), turn, part(2)
      integer :: i, k
      load_on_pads = .true.
      if (.not. norm2(model%point%load) > 0) return
      associate (pads => model%bearings(1)%pads)
         load = in_mirror(pads(1)%position%mirrored, model%point%load/norm2(model%point%load))
         angles = pads%position%angle
         if (arcs) then
            angles = [angles - pads%gap%trailing_angle, angles + pads%gap%leading_angle]
            if (any(pads%gap%arc() >= pi)) return
         end if
      end associate
      do i = 1, size(angles)
         first = [sin(angles(i)), cos(angles(i))]
         if (dot_product(first, load) >= through_pivot) return
         do k = i + 1, size(angles)
            second = [sin(angles(k)), cos(angles(k))]
            turn = first(1)*second(2) - first(2)*second(1)
            if (.not. abs(turn) > 0) cycle
            part = [load(1)*second(2) - load(2)*second(1), first(1)*load(2) - first(2)*load(1)]/turn
            if (all(part >= 0)) return
         end do
      end do
      load_on_pads = .false.
   end function load_on_pads

   !> "pad 4" or "pads 4, 5".
   function listed(chosen)
      logical, intent(in) :: chosen(:)
      character(len=:), allocatable :: listed
      integer :: i
      listed = ''
      do i = 1, size(chosen)
         if (chosen(i)) listed = listed//', '//to_text(i)
      end do
      listed = trim(merge('pad ', 'pads', count(chosen) == 1))//' '//listed(3:)
   end function listed
end module bearing_equilibrium
