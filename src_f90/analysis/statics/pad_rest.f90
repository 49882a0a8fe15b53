!> The rest of one pad for a given journal, wherever there is one: where moments balance is sought over all its tilts,
!> and, along each balance over the penetrations, where its radial force changes its sign or the balance ends.
module pad_rest
   use kinds, only: wp, pi
   use scene, only: scene_type
   use kinematics, only: journal_motion, pad_state, pad_frame
   use equations_of_motion, only: bearing_model
   use damped_newton, only: newtons
   use pad_elimination, only: settle_pads, film_of
   use static_model, only: make_quick
   implicit none (type, external)
   private
   public :: find_rests

   !> Tilts looked at; gaps in which the pad floats, and contact forces on its pivot, that are looked at.
   integer, parameter :: tilts = 41, floats = 28, contacts = 6
   !> Gap over the machined clearance, contact force over the load, from which on they are looked at.
   real(wp), parameter :: least_gap = 2e-3_wp, least_contact = 1e-5_wp
   !> Way across the tilts, from 0 to 1, that a balance goes from one penetration to the next.
   real(wp), parameter :: longest_way = 0.25_wp
   !> Halvings of the way from one penetration to the next.
   integer, parameter :: halvings = 10

   !> The balances of moments at one penetration: tilts, rad, shares of the way across the tilts, radial forces, N, and
   !> whether the pad comes back to them.
   type :: balances_type
      integer :: count = 0
      real(wp) :: penetration = 0, tilt(tilts) = 0, share(tilts) = 0, radial(tilts) = 0
      logical :: stable(tilts) = .false.
   end type balances_type

contains

   !> Moves the pads that do not rest to where they would, and says which do then. The journal stays.
   subroutine find_rests(model, y, at_rest)
      type(bearing_model), intent(in) :: model
      real(wp), intent(inout) :: y(:)
      logical, intent(inout) :: at_rest(:)
      type(bearing_model) :: alone
      type(pad_state) :: pads(size(at_rest))
      type(journal_motion) :: journal
      integer :: i
      journal = model%rotor%journal(y(:model%rotor%states))
      pads = model%layout%pad_states(y)
      do i = 1, size(at_rest)
         if (at_rest(i)) cycle
         call make_quick(scene_of_pad(model%scene, i), model%bearing%pads(i:i)%gap%viscosity, model%point%rupture, &
            & alone)
         call find_rest(alone, journal, pads(i), at_rest(i))
      end do
      y = model%state(journal, pads)
   end subroutine find_rests

   !> The scene with one pad alone.
   pure type(scene_type) function scene_of_pad(scene, i) result(alone)
      type(scene_type), intent(in) :: scene
      integer, intent(in) :: i
      alone = scene
      associate (p => scene%pads)
         alone%pads%pivot_angle_deg = p%pivot_angle_deg(i:i)
         alone%pads%arc_deg = p%arc_deg(i:i)
         alone%pads%pivot_ratio = p%pivot_ratio(i:i)
         alone%pads%pivot_distance = p%pivot_distance(i:i)
         alone%pads%mass = p%mass(i:i)
         alone%pads%inertia = p%inertia(i:i)
         alone%pads%centre_tangential = p%centre_tangential(i:i)
         alone%pads%centre_radial = p%centre_radial(i:i)
      end associate
   end function scene_of_pad

   !> The rest of the only pad of a model: a stable one if there is one.
   subroutine find_rest(alone, journal, pad, found)
      type(bearing_model), intent(inout) :: alone
      type(journal_motion), intent(in) :: journal
      type(pad_state), intent(inout) :: pad
      logical, intent(out) :: found
      type(balances_type), allocatable :: rows(:)
      real(wp), allocatable :: penetrations(:)
      type(pad_state) :: guess
      integer :: row, k, next, turn
      logical :: may_rest
      found = .false.
      penetrations = penetrations_of(alone, journal)
      allocate (rows(size(penetrations)))
      do row = 1, size(rows)
         call find_balances(alone, journal, penetrations(row), rows(row))
      end do
      do turn = 1, 2
         do row = 1, size(rows)
            do k = 1, rows(row)%count
               if (rows(row)%stable(k) .neqv. turn == 1) cycle
               if (.not. alone%layout%radial) then
                  call try(alone, journal, pad_state(tilt=rows(row)%tilt(k)), pad, found)
               end if
               do next = max(row - 1, 1), min(row + 1, size(rows))
                  if (found .or. next == row) cycle
                  call follow(alone, journal, rows(row), k, rows(next), guess, may_rest)
                  if (may_rest) call try(alone, journal, guess, pad, found)
               end do
               if (found) return
            end do
         end do
      end do
   end subroutine find_rest

   !> Penetrations to look at: of a pad that floats, then of one on its pivot.
   function penetrations_of(alone, journal) result(penetrations)
      type(bearing_model), intent(in) :: alone
      type(journal_motion), intent(in) :: journal
      real(wp), allocatable :: penetrations(:)
      type(pad_frame) :: frame
      real(wp) :: gap, force
      integer :: k
      if (.not. alone%layout%radial) then
         penetrations = [0.0_wp]
         return
      end if
      frame = alone%bearing%pads(1)%frame(journal, pad_state())
      associate (clearance => alone%bearing%pads(1)%gap%machined_clearance, &
         & centre_distance => alone%bearing%pads(1)%position%centre_distance)
         gap = clearance - centre_distance + norm2([frame%along, frame%outward])
         penetrations = [real(wp) ::]
         if (gap > least_gap*clearance) penetrations = &
            & [(least_gap*clearance*(gap/(least_gap*clearance))**(real(k, wp)/floats) - gap, k=0, floats)]
      end associate
      force = max(norm2(alone%point%load), alone%bearing%pads(1)%weight, 1.0_wp)
      penetrations = [penetrations, (alone%bearing%penetration(force*least_contact**(1 - real(k, wp)/contacts)), k=0, &
         & contacts)]
   end function penetrations_of

   !> The balances of moments over the tilts that leave the film open.
   subroutine find_balances(alone, journal, penetration, row)
      type(bearing_model), intent(inout) :: alone
      type(journal_motion), intent(in) :: journal
      real(wp), intent(in) :: penetration
      type(balances_type), intent(out) :: row
      type(pad_frame) :: frame
      real(wp) :: middle, ends(2), tilt, share, moment, radial, last(4)
      integer :: k
      logical :: ok, last_ok
      row%penetration = penetration
      frame = alone%bearing%pads(1)%frame(journal, pad_state(penetration=penetration))
      middle = atan2(frame%along, -frame%outward)
      if (.not. film_of(alone, 1, journal, pad_state(tilt=middle, penetration=penetration)) > 0) return
      ends = [last_open(alone, journal, penetration, middle, -1.0_wp), &
         & last_open(alone, journal, penetration, middle, 1.0_wp)]
      last_ok = .false.
      last = 0
      do k = 1, tilts
         share = 0.5_wp*(1 - cos(pi*(k - 0.5_wp)/tilts))
         tilt = ends(1) + share*(ends(2) - ends(1))
         call alone%evaluate(0.0_wp, alone%state(journal, [pad_state(tilt=tilt, penetration=penetration)]), .false., ok)
         moment = alone%bearing%loads(1)%moment
         radial = alone%bearing%loads(1)%radial
         if (ok .and. last_ok .and. (moment < 0 .neqv. last(1) < 0)) then
            associate (n => row%count, t => last(1)/(last(1) - moment))
               n = n + 1
               row%tilt(n) = last(2) + t*(tilt - last(2))
               row%share(n) = last(3) + t*(share - last(3))
               row%radial(n) = last(4) + t*(radial - last(4))
               row%stable(n) = moment < 0
            end associate
         end if
         last = [moment, tilt, share, radial]
         last_ok = ok
      end do
   end subroutine find_balances

   !> The last tilt in one sense from the middle that leaves the film open.
   real(wp) function last_open(alone, journal, penetration, middle, sense)
      type(bearing_model), intent(in) :: alone
      type(journal_motion), intent(in) :: journal
      real(wp), intent(in) :: penetration, middle, sense
      real(wp) :: closed, tilt
      integer :: k
      last_open = middle
      closed = middle + sense*alone%bearing%pads(1)%largest_tilt
      do k = 1, 50
         tilt = 0.5_wp*(last_open + closed)
         if (film_of(alone, 1, journal, pad_state(tilt=tilt, penetration=penetration)) > 0 &
            & .and. abs(tilt) < alone%bearing%pads(1)%largest_tilt) then
            last_open = tilt
         else
            closed = tilt
         end if
      end do
   end function last_open

   !> Follows balance k of a row towards another row, by halving the way, up to where its radial force changes its sign
   !> or the balance ends; `may_rest` is false where it does neither.
   subroutine follow(alone, journal, row, k, other, guess, may_rest)
      type(bearing_model), intent(inout) :: alone
      type(journal_motion), intent(in) :: journal
      type(balances_type), intent(in) :: row, other
      integer, intent(in) :: k
      type(pad_state), intent(out) :: guess
      logical, intent(out) :: may_rest
      type(balances_type) :: near, middle
      real(wp) :: far
      integer :: at, next, halving
      may_rest = follower(row, k, other) == 0
      if (.not. may_rest) return
      near = row
      at = k
      far = other%penetration
      do halving = 1, halvings
         call find_balances(alone, journal, 0.5_wp*(near%penetration + far), middle)
         next = follower(near, at, middle)
         if (next == 0) then
            far = middle%penetration
         else
            near = middle
            at = next
         end if
      end do
      guess = pad_state(tilt=near%tilt(at), penetration=near%penetration)
   end subroutine follow

   !> The balance in another row that continues balance k with a radial force of the same sign; 0 where there is none.
   pure integer function follower(row, k, other)
      type(balances_type), intent(in) :: row, other
      integer, intent(in) :: k
      follower = 0
      if (other%count == 0) return
      follower = minloc(abs(other%share(:other%count) - row%share(k)), &
         & mask=other%stable(:other%count) .eqv. row%stable(k), dim=1)
      if (follower == 0) return
      if (abs(other%share(follower) - row%share(k)) > longest_way) follower = 0
      if (follower == 0) return
      if (row%radial(k) < 0 .neqv. other%radial(follower) < 0) follower = 0
   end function follower

   !> Newton's method on the pad from a guess; where it comes to rest this is the pad's state.
   subroutine try(alone, journal, guess, pad, found)
      type(bearing_model), intent(inout) :: alone
      type(journal_motion), intent(in) :: journal
      type(pad_state), intent(in) :: guess
      type(pad_state), intent(inout) :: pad
      logical, intent(out) :: found
      type(pad_state) :: trial(1)
      logical :: at_rest(1), ok
      trial = guess
      call settle_pads(alone, journal, trial, at_rest, ok, newtons)
      found = ok .and. at_rest(1)
      if (found) pad = trial(1)
   end subroutine try
end module pad_rest
