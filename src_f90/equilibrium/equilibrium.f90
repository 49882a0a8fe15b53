!> Static equilibrium of a rotor and the pads of its bearings at constant speed: no unbalance, no friction.
!>
!> What each of several bearings bears follows from the rotor's stiffness, from offsets and from how far each bearing
!> yields: each is brought to equilibrium alone under its share of the load, with warm oil as one bearing is, and
!> Newton's method on the displacements of the journals finds the shares. The rotor's other displacements follow from
!> these.
module equilibrium
   use kinds, only: wp
   use text, only: to_text
   use errors, only: error_type, raise, add_context, numerics_error, input_error, stopped, asked
   use linear_algebra, only: solve
   use state_layout, only: pad_state, of_journal
   use equations_of_motion, only: machine_model, new_machine_model
   use force_balance, only: bearing_derivatives, part_derivatives
   use equilibrium_record, only: equilibrium_type, describe, describe_with_stability
   use static_model, only: solve_equilibrium, make_static
   use film_network, only: warm_films_type
   use thermal_equilibrium, only: solve_warm_films, solve_thermal_equilibrium, solve_shape
   use bearing_equilibrium, only: find_bearing_equilibrium, settle
   use factories, only: march_films, static_films
   use bearing_samples, only: element_forces
   use case_inputs, only: case_type
   use case_checks, only: check_case
   use case_parameter, only: case_parameter_type, find_parameter
   implicit none (type, external)
   private
   public :: bearing_alone, part_of, bearing_loads, find_equilibrium, settle_equilibrium


   !> Step of the loads, over themselves, at the end: Newton's method on the whole machine follows.
   real(wp), parameter :: agreement = 1e-6_wp
   !> Most rounds, each with a bearing analysis of every bearing; shortest part of a step that is tried.
   integer, parameter :: most_rounds = 40
   real(wp), parameter :: shortest = 1e-3_wp
   !> How far the bearings yield in the first guess, over the clearance: journals run at about half of it.
   real(wp), parameter :: first_yield = 0.5_wp

   !> A rotor at rest, onto its journals: what these bear is `borne` - `stiffness` times their displacements.
   type :: rotor_at_rest
      real(wp), allocatable :: stiffness(:, :), borne(:)
      !> Its other displacements: `bent` - `follow` times those of the journals.
      real(wp), allocatable :: bent(:), follow(:, :)
   end type rotor_at_rest

   !> A bearing alone under its share.
   type :: share_type
      type(machine_model) :: alone
      type(equilibrium_type) :: found
      !> How the load grows with the displacement of the journal, N/m, pads following.
      real(wp) :: stiffness(2, 2) = 0
   end type share_type


   !> Parts of load or speed at which a branch may begin.
   real(wp), parameter :: parts(*) = [0.5_wp, 0.25_wp, 0.0625_wp]
   character(len=*), parameter :: speed = 'operation%speed_rpm', of_load(*) = [character(len=20) :: 'rotor%mass', &
      & 'rotor%static_load(1)', 'rotor%static_load(2)']

contains

   !> The equilibrium of a static model of a machine, which then has the viscosities of its oil. `known`: found is an
   !> equilibrium of films that differ a little, from which it starts; `settles`: another model settles it, so that its
   !> stability is not asked.
   subroutine share_loads(model, found, error, known, settles)
      type(machine_model), intent(inout) :: model
      type(equilibrium_type), intent(inout) :: found
      type(error_type), allocatable, intent(out) :: error
      logical, intent(in), optional :: known, settles
      type(rotor_at_rest) :: rotor
      type(share_type), allocatable :: shares(:)
      real(wp) :: loads(2*size(model%bearings))
      logical :: ok
      integer :: b
      allocate (shares(size(model%bearings)))
      call condense()
      if (.not. ok) then
         call raise(error, numerics_error, 'the stiffness of the rotor is singular')
         return
      end if
      if (present(known)) then
         loads = [bearing_loads(model, found)]
      else
         call guess_loads()
      end if
      do b = 1, size(shares)
         if (present(known)) then
            shares(b)%alone = bearing_alone(model, b, loads(2*b - 1:2*b), found%rotor)
            shares(b)%found = part_of(model, found, b)
         else
            ! films are open on a straight shaft, or where pads follow the shaft that they leave as it is
            shares(b)%alone = bearing_alone(model, b, loads(2*b - 1:2*b), merge([0*loads, rotor%bent], 0.0_wp, &
               & model%inputs%bearings(b)%pitching()))
         end if
      end do
      call bear(shares, loads)
      if (.not. allocated(error)) call find_loads()
      if (.not. allocated(error)) call join()

   contains

      !> Newton's method on the displacements of the journals, from bearings that are in equilibrium under these loads.
      !> A step is shortened until the next one is shorter (natural monotonicity test, Deuflhard 2004, section 2.1):
      !> forces alone would tell of a stiff shaft what rounding leaves.
      subroutine find_loads()
         type(share_type), allocatable :: trial(:)
         real(wp) :: step(size(loads)), next(size(loads)), part
         integer :: round
         call find_step(shares, loads, step)
         part = 1
         do round = 1, most_rounds
            if (norm2(step) <= agreement*norm2(loads)) return
            trial = shares
            call bear(trial, loads + part*step)
            if (.not. allocated(error)) then
               call find_step(trial, loads + part*step, next)
               if (norm2(next) < norm2(step)) then
                  call move_alloc(trial, shares)
                  loads = loads + part*step
                  step = next
                  part = min(1.0_wp, 2*part)
                  cycle
               end if
            else if (error%status == stopped) then
               return
            end if
            part = 0.5_wp*part
            if (part < shortest) exit
         end do
         if (.not. allocated(error)) call raise(error, numerics_error, 'the bearings'' shares of the load do not ' &
            & //'settle: '//to_text(norm2(step))//' N are left unbalanced')
      end subroutine find_loads

      !> The rotor's static forces and stiffness onto its journals, with those of what acts on it beside its bearings,
      !> which here are linear about the state without displacements.
      subroutine condense()
         real(wp), dimension(model%rotor%positions, model%rotor%positions) :: over_positions, over_rates
         real(wp) :: force(model%rotor%positions), y(model%n)
         real(wp), allocatable :: right(:, :)
         character(len=:), allocatable :: refusal
         y = 0
         force = forces_at_rest(model, y)
         call model%rotor%force_derivatives(model%point%speed(0.0_wp), over_positions, over_rates, at_rest=.true.)
         call add_others(model, y, over_positions, refusal)
         associate (n => 2*size(model%bearings), m => model%rotor%positions, k => over_positions)
            allocate (right(m - n, n + 1))
            right(:, :n) = -k(n + 1:, :n)
            right(:, n + 1) = force(n + 1:)
            call solve(m - n, n + 1, -k(n + 1:, n + 1:), right, ok)
            if (.not. ok) return
            rotor%follow = right(:, :n)
            rotor%bent = right(:, n + 1)
            rotor%stiffness = -k(:n, :n) + matmul(k(:n, n + 1:), rotor%follow)
            rotor%borne = force(:n) + matmul(k(:n, n + 1:), rotor%bent)
         end associate
      end subroutine condense

      !> Loads on bearings that yield as springs, by part of their clearance under a mean share.
      subroutine guess_loads()
         real(wp) :: matrix(size(loads), size(loads)), springs(size(loads)), share
         integer :: i
         share = norm2([sum(rotor%borne(1::2)), sum(rotor%borne(2::2))])/max(1, size(model%bearings))
         matrix = rotor%stiffness
         do i = 1, size(loads)
            springs(i) = share/(first_yield*model%bearings((i + 1)/2)%clearance)
            matrix(i, i) = matrix(i, i) + springs(i)
         end do
         loads = rotor%borne
         call solve(size(loads), 1, matrix, loads, ok)
         loads = merge(springs*loads, rotor%borne, ok)
      end subroutine guess_loads

      !> Each bearing to equilibrium under its load, from where it is under another if it is in equilibrium.
      subroutine bear(shares, loads)
         type(share_type), intent(inout) :: shares(:)
         real(wp), intent(in) :: loads(:)
         integer :: b
         do b = 1, size(shares)
            shares(b)%alone%point%load = loads(2*b - 1:2*b)
            call bear_one(shares(b), error)
            if (.not. allocated(error)) cycle
            if (error%status /= stopped) call add_context(error, model%inputs%bearings(b)%label(' under ' &
               & //to_text(loads(2*b - 1))//' N along y and '//to_text(loads(2*b))//' N along z'))
            return
         end do
      end subroutine bear

      !> Newton's step of the loads; none where the equations are singular.
      subroutine find_step(shares, loads, step)
         type(share_type), intent(in) :: shares(:)
         real(wp), intent(in) :: loads(:)
         real(wp), intent(out) :: step(:)
         real(wp) :: matrix(size(loads), size(loads))
         integer :: b
         matrix = rotor%stiffness
         do b = 1, size(shares)
            associate (at => [2*b - 1, 2*b])
               matrix(at, at) = matrix(at, at) + shares(b)%stiffness
            end associate
         end do
         step = rotor%borne - matmul(rotor%stiffness, journals_of(shares)) - loads
         call solve(size(step), 1, matrix, step, ok)
         do b = 1, size(shares)
            step(2*b - 1:2*b) = matmul(shares(b)%stiffness, step(2*b - 1:2*b))
         end do
         if (.not. ok) step = 0
      end subroutine find_step

      !> The equilibrium of the machine from those of its bearings. The temperatures in their films, which they
      !> found under their first loads, become those of this equilibrium, but those of a known one stay.
      subroutine join()
         type(warm_films_type), allocatable :: films(:)
         type(pad_state), allocatable :: pads(:)
         real(wp), allocatable :: y(:)
         real(wp) :: journals(2*size(shares)), ignored(model%rotor%positions, model%rotor%positions)
         character(len=:), allocatable :: refusal
         logical :: warm
         integer :: b
         allocate (pads(0))
         found%search = ''
         do b = 1, size(shares)
            associate (of => shares(b)%found)
               pads = [pads, of%pads]
               model%oil(model%layout%elements(b)%all_pads()) = of%oil
               if (found%search == '' .or. of%search /= 'first') found%search = of%search
            end associate
         end do
         journals = journals_of(shares)
         y = model%static_state([journals, rotor%bent - matmul(rotor%follow, journals)], pads)
         do b = 1, size(shares)
            associate (of => model%layout%elements(b))
               if (of%of_rotor > of_journal) y(of%slopes) = shares(b)%alone%inputs%bearings(1)%slope
            end associate
         end do
         call add_others(model, y, ignored, refusal)
         if (allocated(refusal)) then
            call raise(error, input_error, 'at the equilibrium '//refusal)
            return
         end if
         warm = .false.
         if (.not. present(known) .and. size(shares) > 0) warm = allocated(shares(1)%found%films)
         if (warm) then
            allocate (films(size(shares)))
            do b = 1, size(shares)
               films(b) = shares(b)%found%films(1)
            end do
            call solve_warm_films(model, y, films, found%residual, error)
            call move_alloc(films, found%films)
         else
            call solve_equilibrium(model, y, found%residual, error)
            ! heat of films on a straight shaft is not theirs
            if (.not. allocated(error) .and. .not. present(known) .and. any(model%layout%elements%of_rotor &
               & > of_journal)) call solve_thermal_equilibrium(model, y, found%residual, error)
         end if
         if (allocated(error)) return
         if (present(settles)) then
            call describe(model, y, found)
         else
            call describe_with_stability(model, y, found, error)
         end if
      end subroutine join
   end subroutine share_loads

   !> Adds how the forces of what acts on the rotor beside its bearings change with its displacements in the state y,
   !> their own displacements held. One that refuses the state counts as none, and `refusal` says why.
   subroutine add_others(model, y, over_positions, refusal)
      type(machine_model), intent(inout) :: model
      real(wp), intent(in) :: y(:)
      real(wp), intent(inout) :: over_positions(:, :)
      character(len=:), allocatable, intent(out) :: refusal
      real(wp), allocatable, dimension(:, :) :: positions, rates
      logical :: ok
      integer :: e, i
      do e = 1, size(model%others)
         associate (of => model%layout%elements(size(model%bearings) + e), other => model%others(e)%of)
            call other%evaluate(model%rotor%journal(y(:model%rotor%states), of%pair()), of%pad_states(y), &
               & model%oil(of%all_pads()), model%point%speed(0.0_wp), .true., refusal, ok)
            if (.not. ok) cycle
            do i = 1, of%parts
               call part_derivatives(other, i, of%coordinates, positions, rates)
               over_positions(of%journal, of%journal) = over_positions(of%journal, of%journal) &
                  & + positions(:of_journal, :of_journal)
            end do
         end associate
      end do
   end subroutine add_others

   !> One of them.
   subroutine bear_one(share, error)
      type(share_type), intent(inout) :: share
      type(error_type), allocatable, intent(out) :: error
      type(equilibrium_type) :: found
      real(wp), allocatable :: y(:)
      if (allocated(share%found%pads)) then
         found = share%found
         call settle(share%alone, found, y, error)
         if (allocated(error)) then
            if (error%status == stopped) return
            deallocate (y)
         end if
      end if
      if (.not. allocated(y)) call find_bearing_equilibrium(share%alone, found, error)
      if (allocated(error)) return
      share%found = found
      share%alone%oil = found%oil
      call take_stiffness(share, error)
   end subroutine bear_one

   !> The stiffness of a bearing in equilibrium, pads following.
   subroutine take_stiffness(share, error)
      type(share_type), intent(inout) :: share
      type(error_type), allocatable, intent(out) :: error
      real(wp), dimension(share%alone%layout%n_positions(), share%alone%layout%n_positions()) :: k, c
      real(wp), allocatable :: right(:, :)
      logical :: ok
      associate (of => share%found)
         call share%alone%evaluate(0.0_wp, share%alone%static_state(of%rotor, of%pads), .true., ok)
      end associate
      if (ok) then
         call bearing_derivatives(share%alone, k, c)
         right = k(3:, :2)
         call solve(size(right, 1), 2, k(3:, 3:), right, ok)
      end if
      if (ok) then
         share%stiffness = -k(:2, :2) + matmul(k(:2, 3:), right)
      else
         call raise(error, numerics_error, 'the stiffness of the bearing is not found')
      end if
   end subroutine take_stiffness

   !> Displacements of the journals where the bearings alone have them.
   pure function journals_of(shares) result(displacements)
      type(share_type), intent(in) :: shares(:)
      real(wp) :: displacements(2*size(shares))
      integer :: b
      do b = 1, size(shares)
         displacements(2*b - 1:2*b) = shares(b)%found%rotor
      end do
   end function journals_of

   ! The bearings of a machine, each alone with a rigid journal that bears what the rotor lays on it: what is known of
   ! one bearing then holds for each.

   !> A static model of bearing b alone under a load along y and z, N, at the speed of the machine, with the slope that
   !> these displacements of its rotor have in the bearing, where it counts.
   function bearing_alone(model, b, load, rotor) result(alone)
      type(machine_model), intent(in) :: model
      integer, intent(in) :: b
      real(wp), intent(in) :: load(2), rotor(:)
      type(machine_model) :: alone
      real(wp) :: slope(2)
      integer :: accuracy
      slope = 0
      if (model%layout%elements(b)%of_rotor > of_journal) slope = rotor(model%layout%elements(b)%slopes)
      accuracy = model%bearings(b)%accuracy
      if (accuracy == march_films) accuracy = static_films
      alone = new_machine_model(model%inputs%alone(b, load, slope), accuracy)
      alone%give_up => model%give_up
      alone%point%speed_rpm = model%point%speed_rpm
      alone%point%cavitation = model%point%cavitation
      call alone%set_point(alone%point%static())
      alone%oil = model%oil(model%layout%elements(b)%all_pads())
   end function bearing_alone

   !> What an equilibrium is in bearing b.
   function part_of(model, found, b) result(part)
      type(machine_model), intent(in) :: model
      type(equilibrium_type), intent(in) :: found
      integer, intent(in) :: b
      type(equilibrium_type) :: part
      part = found
      part%rotor = found%rotor(2*b - 1:2*b)
      if (allocated(found%films)) part%films = found%films(b:b)
      if (allocated(found%shapes)) part%shapes = found%shapes(b:b)
      associate (pads => model%layout%elements(b)%all_pads())
         part%pads = found%pads(pads)
         part%pivot_load = found%pivot_load(pads)
         part%min_film_thickness = found%min_film_thickness(pads)
         part%max_pressure = found%max_pressure(pads)
         part%oil = found%oil(pads)
         if (allocated(model%bearings(b)%sloped)) then
            part%slopes = found%slopes(pads)
            part%moments = found%moments(:, b:b)
         else if (allocated(part%slopes)) then
            deallocate (part%slopes, part%moments)
         end if
      end associate
   end function part_of

   !> What the rotor, at rest in this equilibrium, lays on its bearings, (2, bearing), N, along y and z.
   pure function bearing_loads(model, found) result(loads)
      type(machine_model), intent(in) :: model
      type(equilibrium_type), intent(in) :: found
      real(wp) :: loads(2, size(model%bearings)), force(model%rotor%positions)
      force = forces_at_rest(model, model%static_state(found%rotor, found%pads))
      loads = reshape(force(:size(loads)), shape(loads))
   end function bearing_loads

   !> Forces on the displacements of the rotor, at rest in the state y, N, but for those of its bearings.
   pure function forces_at_rest(model, y) result(force)
      type(machine_model), intent(in) :: model
      real(wp), intent(in) :: y(:)
      real(wp) :: force(model%rotor%positions), of_elements(of_journal, model%rotor%elements + size(model%others))
      integer :: e
      force = model%rotor%force(y(:model%rotor%states), model%point%static(), 0.0_wp)
      of_elements = element_forces(model, 0.0_wp, y)
      do e = 1, size(model%others)
         associate (at => model%layout%elements(size(model%bearings) + e)%journal)
            force(at) = force(at) + of_elements(:, model%rotor%elements + e)
         end associate
      end do
   end function forces_at_rest

   !> The equilibrium of a model under its loads at its initial speed, stable or of oscillatory instability, with the
   !> temperatures of warm oil; an error where none is found, or, of status `stopped`, where its `give_up`, asked
   !> between evaluations of the films, says so. `settles`: settle_equilibrium follows, with converged films.
   subroutine find_equilibrium(model, found, error, settles)
      type(machine_model), intent(in) :: model
      type(equilibrium_type), intent(out) :: found
      type(error_type), allocatable, intent(out) :: error
      logical, intent(in), optional :: settles
      type(machine_model) :: static
      real(wp), allocatable :: y(:)
      logical :: by_heat
      if (.not. model%inputs%rotor%is_rigid()) then
         call make_static(model, model%point%cavitation, static)
         call share_loads(static, found, error, settles=settles)
      else
         call find_bearing_equilibrium(model, found, error, by_heat, settles)
         if (by_heat) then
            if (error%status /= stopped) call offer_branch(model, error)
         end if
      end if
      if (allocated(error)) return
      if (.not. any(model%inputs%bearings%changes_shape())) return
      ! to an equilibrium in the shapes to which that in the shapes of the case leads
      call make_static(model, model%point%cavitation, static)
      y = static%static_state(found%rotor, found%pads)
      static%oil = found%oil
      call solve_shape(static, y, found%films, found%shapes, found%residual, error)
      if (.not. allocated(error)) call describe_with_stability(static, y, found, error)
   end subroutine find_equilibrium

   !> Brings an equilibrium that another model has found to that of this static one, whose films differ a little; y is
   !> its state.
   subroutine settle_equilibrium(model, found, y, error)
      type(machine_model), intent(inout) :: model
      type(equilibrium_type), intent(inout) :: found
      real(wp), allocatable, intent(out) :: y(:)
      type(error_type), allocatable, intent(out) :: error
      if (.not. model%inputs%rotor%is_rigid()) then
         call share_loads(model, found, error, known=.true.)
         if (.not. allocated(error)) y = model%static_state(found%rotor, found%pads)
      else
         call settle(model, found, y, error)
      end if
   end subroutine settle_equilibrium

   ! What to give the program next where the heat of a bearing has no equilibrium: the branch that begins at less load,
   ! or at less speed, where there is one, and tells how far there are more: to a fold, or to oil that boils.

   !> Adds to the refusal of a model of one bearing the settings of such a branch, if one begins at any of the parts.
   subroutine offer_branch(model, error)
      type(machine_model), intent(in) :: model
      type(error_type), intent(inout) :: error
      character(len=:), allocatable :: names(:)
      type(case_type) :: inputs
      type(error_type), allocatable :: refused
      integer :: i
      ! the number that makes most of the load
      associate (r => model%inputs%rotor)
         names = [character(len=20) :: of_load(maxloc([r%mass*r%gravity, abs(r%static_load)], dim=1)), speed]
      end associate
      do i = 1, size(names)
         inputs = model%inputs
         inputs%about%task = 'branch'
         ! the default of a branch
         inputs%output%keep = 'all'
         inputs%branch%of = 'equilibrium'
         inputs%branch%parameter = trim(names(i))
         call check_case(inputs, refused)
         if (allocated(refused)) return
         call try_parts(model, inputs, error, refused)
         if (.not. allocated(refused)) return
      end do
   end subroutine offer_branch

   !> The same over the parameter of the branch of these inputs, which belong to the model; `refused` where none begins.
   subroutine try_parts(model, inputs, error, refused)
      type(machine_model), intent(in) :: model
      type(case_type), intent(in) :: inputs
      type(error_type), intent(inout) :: error
      type(error_type), allocatable, intent(out) :: refused
      type(case_parameter_type) :: parameter
      type(machine_model) :: trial
      type(case_type) :: less
      type(equilibrium_type) :: found
      character(len=:), allocatable :: offered
      real(wp) :: value, first
      integer :: k
      associate (name => inputs%branch%parameter)
         call find_parameter(inputs, name, parameter, refused)
         if (allocated(refused)) return
         value = parameter%value(inputs)
         do k = 1, size(parts)
            ! what is offered, to its last digit: beside it may be none
            offered = to_text(parts(k)*value)
            read (offered, *) first
            less = inputs
            call parameter%set(first, less, refused)
            if (.not. allocated(refused)) then
               trial = model
               call trial%adopt(less, .true.)
               call find_bearing_equilibrium(trial, found, refused)
            end if
            if (asked(model%give_up)) return
            if (allocated(refused)) cycle
            error%message = error%message//'; a branch of equilibria shows how far there are some: ' &
               & //'--set case%task=branch --set branch%of=equilibrium --set '//quoted('branch%parameter='//name) &
               & //' --set '//quoted(name//'='//offered)//' --set branch%last='//to_text(value)
            return
         end do
      end associate
   end subroutine try_parts

   !> As a shell takes it for one word.
   pure function quoted(setting)
      character(len=*), intent(in) :: setting
      character(len=:), allocatable :: quoted
      quoted = setting
      if (index(setting, '(') > 0) quoted = ''''//setting//''''
   end function quoted
end module equilibrium
