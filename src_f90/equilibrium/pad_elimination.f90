!> Brings a model to equilibrium by small problems: for a position of the journal every pad finds its own equilibrium,
!> alone and with a time step of its own; then the journal moves under what the pads answer. A light pad that hunts
!> holds up no other.
module pad_elimination
   use kinds, only: wp
   use errors, only: asked
   use linear_algebra, only: solve_few
   use rigid_rotor, only: journal_motion
   use state_layout, only: pad_state, tilt, pivot_deflection, pitch, yaw, of_journal
   use kinematics, only: pad_frame, frame_of
   use sloped_bearing, only: least_thickness, align_pad
   use equations_of_motion, only: machine_model
   use force_balance, only: forces, part_derivatives
   use static_model, only: reference_force, next_time_step, longest_move, shortest_move, trace, set_free, &
      & static_derivatives, newton_step
   implicit none (type, external)
   private
   public :: eliminate_pads, search_pads, settle_all_pads

   !> Unbalanced forces over the reference force at which a pad and the journal are in equilibrium: near enough for
   !> Newton's method on the whole.
   real(wp), parameter :: pad_limit = 1e-9_wp, journal_limit = 1e-6_wp
   !> Of what comes to equilibrium in the 1400 bearings of docs/stability.md, *Searches of an equilibrium*, 99.5 % of
   !> 72000 pads do so within 31 iterations and 99.5 % of 1475 journals within 53.
   integer, parameter :: pad_iterations = 40, journal_iterations = 60
   !> Least part of a film that a move leaves. Of 250 bearings 0.1 loses none, 0.6 two.
   real(wp), parameter :: least_film = 0.3_wp
   !> Film, over the bearing clearance, up to which a pad closes in: one that no film stops waits there.
   real(wp), parameter :: thinnest_film = 1e-6_wp
   !> Time step, in radians of the shaft, below which a pad stays where it is.
   real(wp), parameter :: shortest_step = 1e-12_wp
   !> Gaps over the pad clearance, from just above the least one on, and parts of the tilt that closes a gap, from which
   !> a pad is sought: of the 36 bearings of docs/stability.md that need this they serve 29, as do 12 gaps up to 4.
   integer, parameter :: gaps = 10
   real(wp), parameter :: least_gap = 5e-3_wp
   real(wp), parameter :: leanings(*) = [-0.999_wp, -0.97_wp, -0.8_wp, -0.4_wp, 0.0_wp, 0.4_wp, 0.8_wp, 0.97_wp, &
      & 0.999_wp]

contains

   !> Moves journal and pads from y to equilibrium, nearly. Pads that find no equilibrium stand at zero tilt on their
   !> pivots.
   subroutine eliminate_pads(model, y, in_equilibrium, ok, by_films)
      type(machine_model), intent(inout) :: model
      real(wp), intent(inout) :: y(:)
      !> Which pads are in equilibrium; whether the journal is.
      logical, intent(out) :: in_equilibrium(:), ok
      !> Counts a pad that stands on its asperities as without equilibrium: elsewhere a film may carry it.
      logical, intent(in) :: by_films
      type(journal_motion) :: journal
      type(pad_state) :: pads(model%layout%pads)
      real(wp) :: time_step, unbalanced, last
      real(wp), allocatable :: force(:), step(:)
      integer :: iteration
      journal = model%rotor%journal(y(:model%rotor%states), 1)
      pads = model%layout%elements(1)%pad_states(y)
      time_step = 1/model%point%speed(0.0_wp)
      last = 0
      do iteration = 1, journal_iterations
         ok = .not. asked(model%give_up)
         in_equilibrium = .false.
         if (ok) call settle_pads(model, journal, pads, in_equilibrium, ok, by_films)
         if (ok .and. .not. all(in_equilibrium)) call place_at_zero_tilt()
         if (.not. ok) exit
         force = forces(model, 0.0_wp, model%state(journal, pads))
         force(of_journal + 1:) = 0
         unbalanced = norm2(force)
         if (unbalanced <= journal_limit*reference_force(model)) exit
         if (iteration > 1) time_step = next_time_step(time_step, last, unbalanced)
         last = unbalanced
         call find_step()
         if (.not. ok) exit
         call move_journal()
      end do
      ok = ok .and. iteration <= journal_iterations
      y = model%state(journal, pads)

   contains

      !> Puts the pads that are not in equilibrium at zero tilt on their pivots, where their films are open there, and
      !> evaluates.
      subroutine place_at_zero_tilt()
         type(pad_state) :: still
         integer :: i
         do i = 1, size(pads)
            if (in_equilibrium(i)) cycle
            still = pad_state()
            call align_pad(model%bearings(1), i, journal, still)
            if (film_of(model, i, journal, still) > 0) pads(i) = still
         end do
         call model%evaluate(0.0_wp, model%state(journal, pads), .true., ok, .not. in_equilibrium)
      end subroutine place_at_zero_tilt

      !> The step of the journal, in a time step that is shortened until it does not move too far, and of the pads that
      !> follow to their own equilibrium at once.
      subroutine find_step()
         real(wp), dimension(size(force), size(force)) :: stiffness, damping
         logical :: free(size(force))
         call static_derivatives(model, stiffness, damping)
         damping(of_journal + 1:, :) = 0
         damping(:, of_journal + 1:) = 0
         call set_free(model, .not. in_equilibrium, free)
         associate (longest => longest_move*model%bearings(1)%clearance)
            do
               call newton_step(stiffness, damping, force, free, time_step, step, ok)
               ! what is no number ends here too, and the films refuse it
               if (.not. (ok .and. norm2(step(:of_journal)) > longest)) exit
               time_step = time_step*min(0.5_wp, longest/norm2(step(:of_journal)))
            end do
         end associate
      end subroutine find_step

      !> Moves journal and pads by the step, or by a part that leaves the films open.
      subroutine move_journal()
         type(journal_motion) :: moved
         type(pad_state) :: trial(size(pads))
         real(wp) :: there(model%n)
         integer :: i
         logical :: open
         do
            there = model%state(journal, pads)
            there(model%layout%positions()) = there(model%layout%positions()) + step
            moved = model%rotor%journal(there(:model%rotor%states), 1)
            trial = model%layout%elements(1)%pad_states(there)
            open = all([(film_of(model, i, moved, trial(i)) >= least_film*film_of(model, i, journal, pads(i)), &
               & i=1, size(pads))])
            ! a film that is closed already, or nearly, stops no journal for ever
            if (open .or. .not. norm2(step(:of_journal)) > shortest_move*model%bearings(1)%clearance) exit
            step = 0.5_wp*step
            time_step = 0.5_wp*time_step
         end do
         journal = moved
         pads = trial
      end subroutine move_journal
   end subroutine eliminate_pads

   !> Moves the pads from y to equilibrium with the journal where it is, from other tilts and on their asperities where
   !> nothing else is found; the model is evaluated there.
   subroutine settle_all_pads(model, y, in_equilibrium, ok)
      type(machine_model), intent(inout) :: model
      real(wp), intent(inout) :: y(:)
      logical, intent(out) :: in_equilibrium(:), ok
      type(pad_state) :: pads(size(in_equilibrium))
      logical :: by_films
      integer :: attempt
      do attempt = 1, 2
         by_films = attempt == 1
         in_equilibrium = .false.
         pads = model%layout%elements(1)%pad_states(y)
         call settle_pads(model, model%rotor%journal(y(:model%rotor%states), 1), pads, in_equilibrium, ok, by_films)
         if (.not. ok) return
         call model%layout%put_all_pads(pads, y)
         if (.not. all(in_equilibrium)) call search_pads(model, y, in_equilibrium, by_films)
         if (all(in_equilibrium)) exit
      end do
      call model%evaluate(0.0_wp, y, .true., ok)
   end subroutine settle_all_pads

   !> Every pad to its own equilibrium with the journal where it is; which of them found it.
   subroutine settle_pads(model, journal, pads, in_equilibrium, ok, by_films)
      type(machine_model), intent(inout) :: model
      type(journal_motion), intent(in) :: journal
      type(pad_state), intent(inout) :: pads(:)
      logical, intent(inout) :: in_equilibrium(:)
      logical, intent(out) :: ok
      !> Counts a pad that stands on its asperities as without equilibrium.
      logical, intent(in) :: by_films
      real(wp), dimension(size(pads)) :: time_step, unbalanced, last
      logical :: refused(size(pads))
      real(wp) :: limit
      integer :: iteration, i, k
      time_step = 1/model%point%speed(0.0_wp)
      do iteration = 0, pad_iterations
         call model%evaluate(0.0_wp, model%state(journal, pads), .true., ok, .not. in_equilibrium)
         if (.not. ok) return
         associate (bearing => model%bearings(1), n => model%layout%elements(1)%coordinates)
            unbalanced = [(maxval([(abs(bearing%own_force(i, k))/bearing%length(i, k), k=1, n)]), i=1, size(pads))]
            refused = [(by_films .and. bearing%asperity(i)%carried() > 0.5_wp*norm2(bearing%loads(i)%journal), &
               & i=1, size(pads))]
         end associate
         limit = pad_limit*reference_force(model)
         in_equilibrium = in_equilibrium .or. unbalanced <= limit .and. .not. refused
         if (all(in_equilibrium) .or. iteration == pad_iterations) exit
         if (iteration > 0) time_step = next_time_step(time_step, last, unbalanced)
         last = unbalanced
         do i = 1, size(pads)
            if (.not. in_equilibrium(i)) call move_pad(model, i, journal, pads(i), time_step(i))
         end do
      end do
   end subroutine settle_pads

   !> Moves the pads that are not in equilibrium to one that they find from other tilts and gaps, and says which are in
   !> equilibrium then. The smallest gap comes first, and of one gap the thinnest film is kept: it holds the pad best.
   subroutine search_pads(model, y, in_equilibrium, by_films)
      type(machine_model), intent(inout) :: model
      real(wp), intent(inout) :: y(:)
      logical, intent(inout) :: in_equilibrium(:)
      !> Counts a pad that stands on its asperities as without equilibrium.
      logical, intent(in) :: by_films
      type(journal_motion) :: journal
      type(pad_state), dimension(size(in_equilibrium)) :: pads, trial
      real(wp) :: thinnest(size(pads)), film
      logical :: tried(size(pads)), found(size(pads)), ok
      integer :: i, k, n
      journal = model%rotor%journal(y(:model%rotor%states), 1)
      pads = model%layout%elements(1)%pad_states(y)
      do n = 1, gaps
         thinnest = huge(thinnest)
         do k = 1, size(leanings)
            tried = .not. in_equilibrium
            trial = pads
            do i = 1, size(pads)
               if (.not. tried(i)) cycle
               trial(i) = leaning(model, i, journal, least_gap**(1 - real(n, wp)/gaps), leanings(k))
               tried(i) = film_of(model, i, journal, trial(i)) > 0 &
                  & .and. abs(trial(i)%x(tilt)) < model%bearings(1)%pads(i)%largest_tilt
            end do
            found = .not. tried
            call settle_pads(model, journal, trial, found, ok, by_films)
            do i = 1, size(pads)
               if (.not. (tried(i) .and. found(i))) cycle
               film = film_of(model, i, journal, trial(i))
               if (film >= thinnest(i)) cycle
               thinnest(i) = film
               pads(i) = trial(i)
            end do
         end do
         in_equilibrium = in_equilibrium .or. thinnest < huge(thinnest)
         ! the gap of a rigid pivot is given
         if (all(in_equilibrium) .or. .not. model%layout%elements(1)%has(pivot_deflection)) exit
      end do
      y = model%state(journal, pads)
   end subroutine search_pads

   !> A pad that floats in a gap, over its clearance, or stands on its pivot where that is less, and leans by a part of
   !> what closes the gap.
   pure type(pad_state) function leaning(model, i, journal, gap, part) result(pad)
      type(machine_model), intent(in) :: model
      integer, intent(in) :: i
      type(journal_motion), intent(in) :: journal
      real(wp), intent(in) :: gap, part
      type(pad_frame) :: frame
      real(wp) :: on_pivot
      associate (of => model%bearings(1)%pads(i))
         frame = frame_of(of%position, journal, pad)
         on_pivot = of%gap%machined_clearance - of%position%centre_distance + norm2([frame%along, frame%outward])
         if (model%layout%elements(1)%has(pivot_deflection)) then
            pad%x(pivot_deflection) = min(gap*of%gap%machined_clearance - on_pivot, 0.0_wp)
         end if
         pad%x(tilt) = atan2(frame%along, -frame%outward) + part*max(on_pivot + pad%x(pivot_deflection), 0.0_wp) &
            & /(0.5_wp*of%gap%arc()*of%gap%pad_radius())
      end associate
      call align_pad(model%bearings(1), i, journal, pad)
   end function leaning

   !> One step of a pad alone, shortened until nothing moves too far and its film stays open.
   subroutine move_pad(model, i, journal, pad, time_step)
      type(machine_model), intent(in) :: model
      integer, intent(in) :: i
      type(journal_motion), intent(in) :: journal
      type(pad_state), intent(inout) :: pad
      real(wp), intent(inout) :: time_step
      type(pad_state) :: trial
      real(wp), allocatable, dimension(:, :) :: over_positions, over_rates, stiffness, damping
      real(wp), allocatable :: force(:), step(:), extents(:)
      real(wp) :: clearance, thinnest
      integer :: k
      clearance = model%bearings(1)%clearance
      associate (bearing => model%bearings(1), n => model%layout%elements(1)%coordinates, own => of_journal + 1)
         force = [(bearing%own_force(i, k), k=1, n)]
         call part_derivatives(bearing, i, n, over_positions, over_rates)
         stiffness = over_positions(own:, own:)
         damping = over_rates(own:, own:) - trace*model%point%speed(0.0_wp)*bearing%coordinates%masses(bearing%pads(i))
      end associate
      thinnest = max(least_film*film_of(model, i, journal, pad), thinnest_film*clearance)
      do
         step = solve_few(stiffness + damping/time_step, -force)
         associate (of => model%bearings(1)%pads(i), kind => model%bearings(1)%coordinates%kind(:size(step)))
            trial = pad_state()
            trial%x(kind) = pad%x(kind) + step
            extents = merge(of%gap%arc()*of%gap%pad_radius(), 1.0_wp, kind == tilt)
            where (kind == pitch .or. kind == yaw) extents = 0.5_wp*of%gap%axial_length
            if (maxval(abs(step)*extents) <= longest_move*clearance &
               & .and. film_of(model, i, journal, trial) >= thinnest .and. abs(trial%x(tilt)) < of%largest_tilt) exit
         end associate
         time_step = 0.5_wp*time_step
         if (time_step*model%point%speed(0.0_wp) < shortest_step) return
      end do
      pad = trial
   end subroutine move_pad

   !> Least thickness of a pad's film, m.
   pure real(wp) function film_of(model, i, journal, pad)
      type(machine_model), intent(in) :: model
      integer, intent(in) :: i
      type(journal_motion), intent(in) :: journal
      type(pad_state), intent(in) :: pad
      film_of = least_thickness(model%bearings(1), i, journal, pad)
   end function film_of
end module pad_elimination
