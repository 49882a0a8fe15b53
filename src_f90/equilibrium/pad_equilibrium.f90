!> The equilibrium of one pad for a given journal, wherever there is one: at every tilt the pivot deflection is sought
!> at which the radial forces balance, and, along the tilts with these, where the moment changes its sign.
module pad_equilibrium
   use kinds, only: wp, pi
   use roots, only: root_bracket
   use case_inputs, only: case_type
   use rigid_journal, only: journal_motion
   use kinematics, only: pad_state, pad_frame
   use equations_of_motion, only: bearing_model
   use solve_2x2, only: solved
   use pseudo_transient, only: reference_force, longest_move
   use pad_elimination, only: pad_balance, hold_second, unbalanced_forces, film_of, pad_limit
   use static_model, only: make_quick
   implicit none (type, external)
   private
   public :: find_pad_equilibria

   !> Tilts looked at, closest where the pad faces the journal, by a hyperbolic sine up to this number, and at the ends.
   integer, parameter :: tilts = 61
   real(wp), parameter :: wide = 5
   !> Gaps in which the pad floats, and pivot loads on its pivot, that are looked at.
   integer, parameter :: floats = 24, contacts = 7
   !> Gap over the pad clearance, pivot load over the load, from which on they are looked at.
   real(wp), parameter :: least_gap = 2e-3_wp, least_contact = 1e-5_wp
   !> Radial force over that of film or weight, moment over that at the tilts beside it, that count as balanced; steps
   !> to them.
   real(wp), parameter :: balanced = 1e-3_wp
   integer, parameter :: steps = 30
   !> Halvings of a step of Newton's method, after which it is taken for better or worse.
   integer, parameter :: patience = 8
   !> Parts of the way between two places from whose ends it starts.
   integer, parameter :: guesses = 4

   !> A pad with its moment, N m, and radial force, N, and whether its film is open, or what was sought balances there.
   type :: place_type
      type(pad_state) :: pad
      real(wp) :: moment = 0, radial = 0
      logical :: ok = .false.
   end type place_type

contains

   !> Moves the pads that are not in equilibrium to where they would, and says which are in equilibrium then. The
   !> journal stays.
   subroutine find_pad_equilibria(model, y, in_equilibrium)
      type(bearing_model), intent(in) :: model
      real(wp), intent(inout) :: y(:)
      logical, intent(inout) :: in_equilibrium(:)
      type(bearing_model) :: alone
      type(pad_state) :: pads(size(in_equilibrium))
      type(journal_motion) :: journal
      integer :: i
      journal = model%rotor%journal(y(:model%rotor%states))
      pads = model%layout%pad_states(y)
      do i = 1, size(in_equilibrium)
         if (in_equilibrium(i)) cycle
         call make_quick(case_of_pad(model%inputs, i), model%oil(i:i)%viscosity, model%point%cavitation, alone)
         call find_pad_equilibrium(alone, journal, pads(i), in_equilibrium(i))
      end do
      y = model%state(journal, pads)
   end subroutine find_pad_equilibria

   !> The case with one pad alone.
   pure type(case_type) function case_of_pad(inputs, i) result(alone)
      type(case_type), intent(in) :: inputs
      integer, intent(in) :: i
      alone = inputs
      associate (p => inputs%pads)
         alone%pads%pivot_angle_deg = p%pivot_angle_deg(i:i)
         alone%pads%arc_deg = p%arc_deg(i:i)
         alone%pads%pivot_ratio = p%pivot_ratio(i:i)
         alone%pads%pivot_distance = p%pivot_distance(i:i)
         alone%pads%mass = p%mass(i:i)
         alone%pads%inertia = p%inertia(i:i)
         alone%pads%centre_tangential = p%centre_tangential(i:i)
         alone%pads%centre_radial = p%centre_radial(i:i)
      end associate
   end function case_of_pad

   !> The equilibrium of the only pad of a model: of those to which the pad comes back, or else of the others, that with
   !> the thinnest film, on which it is held best.
   subroutine find_pad_equilibrium(alone, journal, pad, found)
      type(bearing_model), intent(inout) :: alone
      type(journal_motion), intent(in) :: journal
      type(pad_state), intent(inout) :: pad
      logical, intent(out) :: found
      type(place_type) :: places(tilts)
      real(wp), allocatable :: pivot_deflections(:)
      real(wp) :: thinnest
      type(place_type) :: sides(2)
      type(pad_state) :: candidate
      integer :: k, turn
      logical :: balanced
      found = .false.
      pivot_deflections = deflections_of(alone, journal)
      places = tilted(alone, journal, pivot_deflections)
      do turn = 1, 2
         do k = 2, tilts
            if (.not. (places(k - 1)%ok .and. places(k)%ok)) cycle
            if (places(k - 1)%moment < 0 .eqv. places(k)%moment < 0) cycle
            if (places(k)%moment < 0 .neqv. turn == 1) cycle
            sides = places(k - 1:k)
            call close_in(alone, journal, pivot_deflections, sides)
            call settle_between(alone, journal, sides%pad, candidate, balanced)
            if (.not. balanced) cycle
            if (found .and. film_of(alone, 1, journal, candidate) > thinnest) cycle
            thinnest = film_of(alone, 1, journal, candidate)
            pad = candidate
            found = .true.
         end do
         if (found) return
      end do
   end subroutine find_pad_equilibrium

   !> Pivot deflections to look at: of a pad that floats, then of one on its pivot.
   function deflections_of(alone, journal) result(pivot_deflections)
      type(bearing_model), intent(in) :: alone
      type(journal_motion), intent(in) :: journal
      real(wp), allocatable :: pivot_deflections(:)
      type(pad_frame) :: frame
      real(wp) :: gap, force
      integer :: k
      if (.not. alone%layout%radial) then
         pivot_deflections = [0.0_wp]
         return
      end if
      frame = alone%bearing%pads(1)%frame(journal, pad_state())
      associate (clearance => alone%bearing%pads(1)%gap%machined_clearance, &
         & centre_distance => alone%bearing%pads(1)%position%centre_distance)
         gap = clearance - centre_distance + norm2([frame%along, frame%outward])
         pivot_deflections = [real(wp) ::]
         if (gap > least_gap*clearance) pivot_deflections = &
            & [(least_gap*clearance*(gap/(least_gap*clearance))**(real(k, wp)/floats) - gap, k=0, floats)]
      end associate
      force = max(norm2(alone%point%load), alone%bearing%pads(1)%weight, 1.0_wp)
      pivot_deflections = [pivot_deflections, (alone%bearing%pivot_deflection(force*least_contact**(1 - real(k, &
         & wp)/contacts)), k=0, contacts)]
   end function deflections_of

   !> The pad at tilts that leave the film open at the largest pivot deflection, where its radial forces balance.
   function tilted(alone, journal, pivot_deflections) result(places)
      type(bearing_model), intent(inout) :: alone
      type(journal_motion), intent(in) :: journal
      real(wp), intent(in) :: pivot_deflections(:)
      type(place_type) :: places(tilts)
      type(pad_frame) :: frame
      real(wp) :: middle, last, ways(2), part
      integer :: k
      frame = alone%bearing%pads(1)%frame(journal, pad_state())
      middle = atan2(frame%along, -frame%outward)
      last = pivot_deflections(size(pivot_deflections))
      if (.not. film_of(alone, 1, journal, pad_state(tilt=middle, pivot_deflection=last)) > 0) return
      ways = [middle - last_open(alone, journal, last, middle, -1.0_wp), &
         & last_open(alone, journal, last, middle, 1.0_wp) - middle]
      do k = 1, tilts
         part = sin(pi*((k - 0.5_wp)/tilts - 0.5_wp))
         places(k) = radial_balance(alone, journal, pivot_deflections, middle + sinh(wide*part)/sinh(wide) &
            & *ways(merge(1, 2, part < 0)))
      end do
   end function tilted

   !> The pad at a tilt where its radial forces balance: between two of the pivot deflections.
   type(place_type) function radial_balance(alone, journal, pivot_deflections, tilt) result(balance)
      type(bearing_model), intent(inout) :: alone
      type(journal_motion), intent(in) :: journal
      real(wp), intent(in) :: pivot_deflections(:), tilt
      type(root_bracket) :: bracket
      integer :: first, last, middle, k
      last = size(pivot_deflections)
      balance = place_at(alone, journal, pad_state(tilt=tilt, pivot_deflection=pivot_deflections(last)))
      if (.not. alone%layout%radial) return
      balance%ok = balance%ok .and. balance%radial < 0
      if (.not. balance%ok) return
      bracket = root_bracket(pivot_deflections(last), balance%radial)
      first = 0
      do while (last - first > 1)
         middle = (first + last)/2
         balance = place_at(alone, journal, pad_state(tilt=tilt, pivot_deflection=pivot_deflections(middle)))
         k = merge(2, 1, balance%radial < 0)
         bracket%place(k) = pivot_deflections(middle)
         bracket%value(k) = balance%radial
         if (balance%radial < 0) then
            last = middle
         else
            first = middle
         end if
      end do
      do k = 1, steps
         if (first == 0) exit
         ! films push far more than pivots pull
         bracket%value = min(bracket%value, -minval(bracket%value))
         balance = place_at(alone, journal, pad_state(tilt=tilt, pivot_deflection=bracket%estimate()))
         if (balance%ok .and. abs(balance%radial) <= balanced*max(norm2(alone%bearing%loads(1)%journal), &
            & alone%bearing%pads(1)%weight)) return
         call bracket%narrow(balance%pad%pivot_deflection, balance%radial)
      end do
      balance%ok = .false.
   end function radial_balance

   !> Brings two tilts between which the moment changes its sign close together, likewise.
   subroutine close_in(alone, journal, pivot_deflections, sides)
      type(bearing_model), intent(inout) :: alone
      type(journal_motion), intent(in) :: journal
      real(wp), intent(in) :: pivot_deflections(:)
      type(place_type), intent(inout) :: sides(2)
      type(root_bracket) :: bracket
      type(place_type) :: next
      real(wp) :: enough
      integer :: k
      enough = balanced*minval(abs(sides%moment))
      if (sides(1)%moment > 0) sides = sides([2, 1])
      bracket = root_bracket(sides%pad%tilt, sides%moment)
      do k = 1, steps
         next = radial_balance(alone, journal, pivot_deflections, bracket%estimate())
         if (.not. next%ok) return
         call bracket%narrow(next%pad%tilt, next%moment)
         sides(merge(1, 2, next%moment < 0)) = next
         if (abs(next%moment) > enough) cycle
         sides = next
         return
      end do
   end subroutine close_in

   !> A pad with its loads; a film that is closed pushes it off.
   type(place_type) function place_at(alone, journal, pad) result(place)
      type(bearing_model), intent(inout) :: alone
      type(journal_motion), intent(in) :: journal
      type(pad_state), intent(in) :: pad
      place%pad = pad
      call alone%evaluate(0.0_wp, alone%state(journal, [pad]), .false., place%ok)
      place%moment = alone%bearing%loads(1)%moment
      place%radial = merge(alone%bearing%loads(1)%radial, huge(1.0_wp), place%ok)
   end function place_at

   !> The last tilt in one sense from the middle that leaves the film open.
   real(wp) function last_open(alone, journal, pivot_deflection, middle, sense)
      type(bearing_model), intent(in) :: alone
      type(journal_motion), intent(in) :: journal
      real(wp), intent(in) :: pivot_deflection, middle, sense
      real(wp) :: closed, tilt
      integer :: k
      last_open = middle
      closed = middle + sense*alone%bearing%pads(1)%largest_tilt
      do k = 1, 50
         tilt = 0.5_wp*(last_open + closed)
         if (film_of(alone, 1, journal, pad_state(tilt=tilt, pivot_deflection=pivot_deflection)) > 0 &
            & .and. abs(tilt) < alone%bearing%pads(1)%largest_tilt) then
            last_open = tilt
         else
            closed = tilt
         end if
      end do
   end function last_open

   !> Newton's method from places between two, which lie apart where pivot deflections leap; whether one leads to
   !> equilibrium.
   subroutine settle_between(alone, journal, sides, candidate, balanced)
      type(bearing_model), intent(inout) :: alone
      type(journal_motion), intent(in) :: journal
      type(pad_state), intent(in) :: sides(2)
      type(pad_state), intent(out) :: candidate
      logical, intent(out) :: balanced
      real(wp) :: share
      integer :: k
      do k = 0, guesses
         share = real(k, wp)/guesses
         candidate%tilt = (1 - share)*sides(1)%tilt + share*sides(2)%tilt
         candidate%pivot_deflection = (1 - share)*sides(1)%pivot_deflection + share*sides(2)%pivot_deflection
         call settle(alone, journal, candidate, balanced)
         if (balanced) return
      end do
   end subroutine settle_between

   !> Newton's method on the pad, its steps shortened where they go too far or make nothing better; whether it comes to
   !> rest.
   subroutine settle(alone, journal, pad, balanced)
      type(bearing_model), intent(inout) :: alone
      type(journal_motion), intent(in) :: journal
      type(pad_state), intent(inout) :: pad
      logical, intent(out) :: balanced
      type(pad_state) :: trial
      real(wp) :: force(2), stiffness(2, 2), damping(2, 2), step(2), last(1), arc, longest
      integer :: iteration, halving
      logical :: ok
      arc = alone%bearing%pads(1)%gap%arc()*alone%bearing%pads(1)%gap%pad_radius()
      longest = longest_move*alone%inputs%bearing%assembled_clearance
      balanced = .false.
      do iteration = 0, steps
         call alone%evaluate(0.0_wp, alone%state(journal, [pad]), .true., ok)
         if (.not. ok) return
         last = unbalanced_forces(alone)
         balanced = last(1) <= pad_limit*reference_force(alone)
         if (balanced) return
         call pad_balance(alone, 1, force, stiffness, damping)
         if (.not. alone%layout%radial) call hold_second(force, stiffness, damping)
         step = solved(stiffness, -force)
         step = step*longest/max(longest, abs(step(1))*arc, abs(step(2)))
         do halving = 0, patience
            trial = pad_state(tilt=pad%tilt + step(1)/2**halving, pivot_deflection=pad%pivot_deflection &
               & + step(2)/2**halving)
            call alone%evaluate(0.0_wp, alone%state(journal, [trial]), .false., ok)
            if (.not. ok) cycle
            if (all(unbalanced_forces(alone) < last)) exit
         end do
         if (.not. ok) return
         pad = trial
      end do
   end subroutine settle
end module pad_equilibrium
