!> The equilibrium of a bearing whose journal is held at a place: the pads find theirs around it, and the load is what
!> films and asperities push back with. Warm oil then takes the temperatures of the equilibrium under this load, in
!> which the journal moves a little: it is brought back, until both agree.
module held_journal
   use kinds, only: wp, pi, degree
   use text, only: filled
   use errors, only: error_type, raise, add_context, numerics_error, stopped, asked
   use case_groups, only: is_set
   use case_inputs, only: case_type
   use bearing_numbers, only: load_on_journal
   use state_layout, only: tilt
   use equations_of_motion, only: machine_model
   use force_balance, only: forces
   use equilibrium_record, only: equilibrium_type, describe_with_stability
   use static_model, only: make_static, placed, unbalanced, reference_force
   use pad_elimination, only: settle_all_pads
   use heat_balance_equations, only: has_warm_oil
   use thermal_equilibrium, only: guess_oil, guesses, solve_thermal_equilibrium, solve_warm_films
   use bearing_equilibrium, only: listed
   implicit none (type, external)
   private
   public :: find_held_equilibrium, take_load

   !> How far from its place the journal may end where oil is warm, over the clearance; most rounds. The oil of ten
   !> percent another load changes by about two, so that a round leaves a fifth of the distance.
   real(wp), parameter :: agreement = 1e-7_wp
   integer, parameter :: most_rounds = 30
   !> Angle between the load that holds the journal and the one that is wanted, rad; where films leap at least this.
   real(wp), parameter :: closest = 1e-8_wp, close = 1e-5_wp
   integer, parameter :: most_turns = 60
   !> Where the search for the attitude begins, rad: the journal in fixed pads; tilting pads have next to none.
   real(wp), parameter :: usual_attitude = 0.25_wp*pi

contains

   !> The equilibrium of a model of one bearing at the place that a case wants its journal at; the model then has the
   !> load that holds it. `known`: the model is a static one, whose films differ a little from those of `found`.
   subroutine find_held_equilibrium(model, inputs, found, error, known)
      type(machine_model), intent(inout) :: model
      type(case_type), intent(in) :: inputs
      type(equilibrium_type), intent(inout) :: found
      type(error_type), allocatable, intent(out) :: error
      logical, intent(in), optional :: known
      type(machine_model) :: static
      real(wp), allocatable :: y(:)
      integer :: guess
      if (present(known)) then
         model%oil = found%oil
         y = model%static_state(found%rotor, found%pads)
         call hold(model, inputs, y, found, has_warm_oil(model) .and. .not. any(found%oil%varies), error)
         if (.not. allocated(error)) call take_load(model, model%point%load)
         return
      end if
      call make_static(model, model%point%cavitation, static)
      do guess = 1, merge(guesses, 1, has_warm_oil(model))
         if (has_warm_oil(model)) call guess_oil(static, guess)
         if (allocated(y)) deallocate (y)
         call hold(static, inputs, y, found, has_warm_oil(model), error)
         if (.not. allocated(error)) exit
         if (error%status == stopped) exit
      end do
      if (.not. allocated(error)) call take_load(model, static%point%load)
   end subroutine find_held_equilibrium

   !> Gives a model a load along y and z, N: its static load beside the weight.
   subroutine take_load(model, load)
      type(machine_model), intent(inout) :: model
      real(wp), intent(in) :: load(2)
      model%point%load = load
      associate (r => model%inputs%rotor)
         r%static_load = load + [r%mass*r%gravity, 0.0_wp]
      end associate
   end subroutine take_load

   !> Brings journal, pads and, where it warms, oil of a static model to equilibrium at the wanted place; from the state
   !> y, if there is one.
   subroutine hold(model, inputs, y, found, warms, error)
      type(machine_model), intent(inout) :: model
      type(case_type), intent(in) :: inputs
      real(wp), allocatable, intent(inout) :: y(:)
      type(equilibrium_type), intent(inout) :: found
      logical, intent(in) :: warms
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: place(2)
      integer :: round
      if (warms .and. allocated(found%films)) deallocate (found%films)
      do round = 1, most_rounds
         call find_place(model, inputs, y, error)
         if (allocated(error)) return
         place = y(:2)
         if (.not. warms) exit
         if (allocated(found%films)) then
            call solve_warm_films(model, y, found%films, found%residual, error)
         else
            call solve_thermal_equilibrium(model, y, found%residual, error, films=found%films)
         end if
         if (allocated(error)) return
         if (norm2(y(:2) - place) <= agreement*model%bearings(1)%clearance) exit
         if (round == most_rounds) call raise(error, numerics_error, filled('the oil does not settle with the ' &
            & //'journal held: after {} rounds it is still {u} um from its place', [real(wp) :: round, &
            & norm2(y(:2) - place)]))
      end do
      if (.not. allocated(error)) call describe_with_stability(model, y, found, error)
      found%residual = unbalanced(model, y)/reference_force(model)
      found%search = 'held'
   end subroutine hold

   !> Puts the journal at its place, with pads in equilibrium, and gives the model the load that holds it. Where no
   !> attitude is given the journal turns about the middle until the load has the direction of that of the case.
   subroutine find_place(model, inputs, y, error)
      type(machine_model), intent(inout) :: model
      type(case_type), intent(in) :: inputs
      real(wp), allocatable, intent(inout) :: y(:)
      type(error_type), allocatable, intent(out) :: error
      !> The attitude, the angle of the load there, which is to vanish, and both before; where it is below and above 0.
      real(wp) :: attitude, angle, last(2), low, high, step
      integer :: turn
      ! at a position, at an attitude, or in the middle
      if (is_set(inputs%held%attitude_deg) .or. .not. inputs%held%eccentricity_ratio > 0) then
         call settle_at(place_of(inputs, inputs%held%attitude_deg*degree))
         return
      end if
      attitude = merge(0.0_wp, usual_attitude, model%layout%elements(1)%has(tilt))
      if (allocated(y)) attitude = angle_between(load_on_journal(inputs), y(:2), inputs%sense())
      low = -huge(low)
      high = huge(high)
      do turn = 1, most_turns
         call settle_at(place_of(inputs, attitude))
         if (allocated(error)) return
         angle = angle_between(load_on_journal(inputs), model%point%load, inputs%sense())
         if (abs(angle) <= closest) return
         if (angle > 0) high = attitude
         if (angle < 0) low = attitude
         step = -angle
         if (turn > 1) then
            ! the load of a circular bore turns by the angle of the journal
            associate (slope => (angle - last(2))/(attitude - last(1)))
               if (slope > 0.1_wp) step = -angle/slope
            end associate
         end if
         last = [attitude, angle]
         attitude = attitude + step
         if (low > -huge(low) .and. high < huge(high)) then
            if (.not. (attitude > low .and. attitude < high)) attitude = 0.5_wp*(low + high)
         end if
         if (abs(attitude - last(1)) <= epsilon(attitude)*pi) exit
      end do
      if (abs(angle) > close) call raise(error, numerics_error, filled('no attitude found at which the load that ' &
         & //'holds the journal has the direction of the load of the case: at {.3} deg it is {.3} deg away', &
         & [last(1), angle]/degree))
   contains
      !> The pads to equilibrium with the journal at this place, from where they are or anew, and the load.
      subroutine settle_at(place)
         real(wp), intent(in) :: place(2)
         logical :: in_equilibrium(model%layout%pads), ok, anew
         real(wp) :: force(model%layout%n_positions())
         if (asked(model%give_up)) then
            call raise(error, stopped, 'stopped while the equilibrium was sought')
            return
         end if
         do
            anew = .not. allocated(y)
            if (anew) then
               model%point%load = 0
               y = placed(model, place)
            end if
            y(:2) = place
            call settle_all_pads(model, y, in_equilibrium, ok)
            if (anew .or. ok .and. all(in_equilibrium)) exit
            deallocate (y)
         end do
         if (.not. ok) then
            call raise(error, numerics_error, model%refusal)
         else if (.not. all(in_equilibrium)) then
            call raise(error, numerics_error, listed(.not. in_equilibrium)//' (unloaded) did not come to ' &
               & //'equilibrium; try more preload, or another place')
         end if
         call add_context(error, filled('the journal held at y {u.3}, z {u.3} um', place))
         if (allocated(error)) return
         force = forces(model, 0.0_wp, y)
         model%point%load = model%point%load - force(:2)
      end subroutine settle_at
   end subroutine find_place

   !> The place that a case wants, m; at this attitude from its load, rad, where it has an eccentricity.
   pure function place_of(inputs, attitude) result(place)
      type(case_type), intent(in) :: inputs
      real(wp), intent(in) :: attitude
      real(wp) :: place(2)
      place = inputs%held%position
      if (is_set(place(1))) return
      associate (load => load_on_journal(inputs))
         place = inputs%held%eccentricity_ratio*inputs%bearings(1)%clearance()/norm2(load)*(cos(attitude)*load &
            & + inputs%sense()*sin(attitude)*[-load(2), load(1)])
      end associate
   end function place_of

   !> The angle from one force to another in the sense of rotation, rad.
   pure real(wp) function angle_between(one, other, sense)
      real(wp), intent(in) :: one(2), other(2), sense
      angle_between = atan2(sense*(one(1)*other(2) - one(2)*other(1)), dot_product(one, other))
   end function angle_between
end module held_journal
