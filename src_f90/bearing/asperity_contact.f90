!> Contact between pad and journal where the film is thinner than four times their roughness: the asperities' pressure
!> by Greenwood and Tripp, with boundary friction (docs/theory/dynamics_and_friction.md, *Asperity contact*).
!>
!> The thickness does not depend on the axial coordinate, so a load is an integral along the part of the arc where the
!> film is so thin. Where it is thicker all over, there is no load, exactly.
module asperity_contact
   use kinds, only: wp, pi
   use film_solver, only: film_motion
   use pad_gap, only: pad_gap_type, pad_directions
   use linear_algebra, only: identity
   use sloped_gap, only: sloped_motion, edge_films
   implicit none (type, external)
   private
   public :: asperity_contact_type, asperity_load, sloped_asperity_load, new_asperity_contact, no_asperities

   !> Mean pressure over K' E': 4.4086e-5 (4 - h/sigma)^6.804 below h = 4 sigma, the usual fit of F_5/2.
   real(wp), parameter :: highest_ratio = 4, coefficient = 4.4086e-5_wp, exponent = 6.804_wp
   !> Speed of the journal's surface, over its highest, at which boundary friction has 0.7 of its size: it has none at
   !> rest.
   real(wp), parameter :: slow_share = 3e-5_wp
   !> Mean gap that the oil has, over the roughness, from which on it is less than the film thickness falls by.
   real(wp), parameter :: oil_ratio = 2

   !> Gauss's points on (-1, 1) and their weights: an error of 1e-9 over a stretch at whose ends the pressure is 0.
   integer, parameter :: points = 12
   real(wp), parameter :: half_place(points/2) = [0.12523340851146894_wp, 0.36783149899818018_wp, &
      & 0.58731795428661748_wp, 0.76990267419430469_wp, 0.9041172563704748_wp, 0.98156063424671924_wp]
   real(wp), parameter :: half_weight(points/2) = [0.24914704581340288_wp, 0.23349253653835478_wp, &
      & 0.20316742672306584_wp, 0.16007832854334633_wp, 0.10693932599531818_wp, 0.047175336386511835_wp]
   real(wp), parameter :: place(points) = [-half_place, half_place], weight(points) = [half_weight, half_weight]

   type :: asperity_contact_type
      private
      !> Film thickness below which asperities meet, m.
      real(wp) :: reach = -huge(1.0_wp)
      !> Combined rms roughness sigma, m; K' E' times the coefficient, Pa; coefficient of friction.
      real(wp) :: roughness = 0, pressure = 0, friction = 0
      !> Speed of the journal's surface at which friction goes, m/s.
      real(wp) :: slow = 0
   contains
      procedure :: act
      procedure :: evaluate
      procedure :: evaluate_sloped
      procedure :: heat
   end type asperity_contact_type

   !> Nothing touches.
   type(asperity_contact_type), parameter :: no_asperities = asperity_contact_type()

   !> One pad's contact with the journal. Without contact only `touches` and `thickness` are set.
   type :: asperity_load
      logical :: touches = .false.
      !> Minimum film thickness, m.
      real(wp) :: thickness = 0
      !> Integral of the pressure, N.
      real(wp) :: normal = 0
      !> Force on the journal in the pad frame, N; moment of friction on the pad about the centre of its arc, N m.
      real(wp) :: force(2) = 0, moment = 0
      !> Their derivatives over (e_y', e_z').
      real(wp) :: force_slopes(2, 2) = 0, moment_slopes(2) = 0
      !> (e_y', e_z') at which the oil's film is to be taken, m, and its derivatives over the true one.
      real(wp) :: film_position(2) = 0, film_slopes(2, 2) = 0
   contains
      procedure :: carried
   end type asperity_load

   !> The same of a journal whose axis is inclined to the pad's. The inherited slopes and film position are not set.
   type, extends(asperity_load) :: sloped_asperity_load
      !> On the journal: integral of z times the force, N m, z from the pad's middle.
      real(wp) :: journal_moment(2) = 0
      !> Derivatives of (force, journal_moment), and of `moment`, over (position, slope).
      real(wp) :: slopes(4, 4) = 0, turning_slopes(4) = 0
      !> The motion at which the oil's film is to be taken, and derivatives of its (position, slope) over the true ones.
      type(sloped_motion) :: film_motion
      real(wp) :: film_motion_slopes(4, 4) = 0
   end type sloped_asperity_load

   !> Integrals over a pad of the pressure p and of p n, n the outward direction; of -dp/dh n and -dp/dh n n.
   type :: contact_sums
      real(wp) :: normal = 0, pushed(2) = 0, slope(2) = 0, slopes(2, 2) = 0
   end type contact_sums

contains

   !> Contact of surfaces of a combined rms roughness, m, and composite modulus, Pa, with the factor K' and a
   !> coefficient of friction; the journal's surface moves at up to `fastest`, m/s.
   pure function new_asperity_contact(roughness, modulus, factor, friction, fastest) result(contact)
      real(wp), intent(in) :: roughness, modulus, factor, friction, fastest
      type(asperity_contact_type) :: contact
      contact = asperity_contact_type(highest_ratio*roughness, roughness, coefficient*factor*modulus, friction, &
         & slow_share*fastest)
   end function new_asperity_contact

   !> True where asperities may touch.
   pure logical function act(self)
      class(asperity_contact_type), intent(in) :: self
      act = self%reach > 0
   end function act

   !> The contact of a pad with a journal in this motion and at this shaft speed, rad/s. Where the film is negative by
   !> more than the contact's reach there is none: the solvers of films refuse such a state.
   pure subroutine evaluate(self, gap, directions, motion, speed, load)
      class(asperity_contact_type), intent(in) :: self
      type(pad_gap_type), intent(in) :: gap
      type(pad_directions), intent(in) :: directions
      type(film_motion), intent(in) :: motion
      real(wp), intent(in) :: speed
      type(asperity_load), intent(inout) :: load
      load%thickness = gap%min_film_thickness(motion, directions)
      load%touches = abs(load%thickness) < self%reach
      if (.not. load%touches) return
      call set_loads(self, gap, motion%position, speed*gap%journal_radius, load)
      call set_film(self, gap, directions, motion%position, load)
   end subroutine evaluate

   !> The same with slopes; `film_motion` and its derivatives are set even where nothing touches.
   pure subroutine evaluate_sloped(self, gap, directions, motion, speed, load)
      class(asperity_contact_type), intent(in) :: self
      type(pad_gap_type), intent(in) :: gap
      type(pad_directions), intent(in) :: directions
      type(sloped_motion), intent(in) :: motion
      real(wp), intent(in) :: speed
      type(sloped_asperity_load), intent(inout) :: load
      real(wp) :: ends(2)
      ends = edge_films(gap, directions, motion)
      load%thickness = minval(ends)
      ! a corner is softer than a whole edge: it may go deeper than the contact reaches
      load%touches = load%thickness < self%reach .and. load%thickness > -gap%machined_clearance
      load%film_motion = motion
      load%film_motion_slopes = identity(4)
      if (.not. load%touches) return
      call set_sloped_loads(self, gap, motion, speed*gap%journal_radius, load)
      call set_sloped_film(self, gap, directions, motion, ends, load)
   end subroutine evaluate_sloped

   !> Sets forces and moments, and their derivatives; the journal's surface moves at a speed, m/s. With m = (n, z n), n
   !> the outward direction, they are integrals of the pressure p and of -dp/dh times m and m m^T.
   pure subroutine set_sloped_loads(self, gap, motion, speed, load)
      class(asperity_contact_type), intent(in) :: self
      type(pad_gap_type), intent(in) :: gap
      type(sloped_motion), intent(in) :: motion
      real(wp), intent(in) :: speed
      type(sloped_asperity_load), intent(inout) :: load
      real(wp) :: pushed(4), slope(4), slopes(4, 4), bounds(4), drawn(4)
      integer :: k, turn
      load%normal = 0
      pushed = 0
      slope = 0
      slopes = 0
      do turn = -1, 1
         call find_bounds(self, gap, motion, turn, bounds)
         do k = 1, 3
            if (.not. bounds(k + 1) > bounds(k)) cycle
            call add_area(self, gap, motion, bounds(k:k + 1), load%normal, pushed, slope, slopes)
         end do
      end do
      associate (friction => friction_at(self, speed))
         drawn = -pushed + friction*turned(pushed)
         load%force = drawn(:2)
         load%journal_moment = drawn(3:)
         do k = 1, 4
            load%slopes(:, k) = -slopes(:, k) + friction*turned(slopes(:, k))
         end do
         load%moment = friction*gap%pad_radius()*load%normal
         load%turning_slopes = friction*gap%pad_radius()*slope
      end associate
   contains
      !> Friction pulls the journal along phi.
      pure function turned(x)
         real(wp), intent(in) :: x(4)
         real(wp) :: turned(4)
         turned = [x(2), -x(1), x(4), -x(3)]
      end function turned
   end subroutine set_sloped_loads

   !> Where the stretches of the arc on which the film is thin at either end of the pad begin and end, in order, rad.
   pure subroutine find_bounds(self, gap, motion, turn, bounds)
      class(asperity_contact_type), intent(in) :: self
      type(pad_gap_type), intent(in) :: gap
      type(sloped_motion), intent(in) :: motion
      integer, intent(in) :: turn
      real(wp), intent(out) :: bounds(4)
      real(wp) :: towards, half
      integer :: side
      do side = 0, 1
         associate (e => motion%middle%position + (side - 0.5_wp)*gap%axial_length*motion%slope)
            towards = atan2(e(1), e(2)) + 2*pi*turn
            half = acos(min(1.0_wp, max(-1.0_wp, (gap%machined_clearance - self%reach)/max(norm2(e), tiny(half)))))
            bounds(2*side + 1:2*side + 2) = min(max(towards + [-half, half], -gap%trailing_angle), gap%leading_angle)
         end associate
      end do
      associate (a => bounds([1, 3]), b => bounds([2, 4]))
         ! stretches that do not meet leave a gap between them, in which nothing touches
         bounds = [minval(a), min(maxval(a), minval(b)), max(maxval(a), minval(b)), maxval(b)]
      end associate
   end subroutine find_bounds

   !> Adds the integrals over the arc between two angles, rad. Across the width the depth is linear: from where it is 0
   !> Gauss's points err as little as along the arc.
   pure subroutine add_area(self, gap, motion, bounds, normal, pushed, slope, slopes)
      class(asperity_contact_type), intent(in) :: self
      type(pad_gap_type), intent(in) :: gap
      type(sloped_motion), intent(in) :: motion
      real(wp), intent(in) :: bounds(2)
      real(wp), intent(inout) :: normal, pushed(4), slope(4), slopes(4, 4)
      real(wp) :: phi, outward(2), from, to, z, depth, rise, force, falling, m(4)
      integer :: i, k, l
      do i = 1, points
         phi = 0.5_wp*(sum(bounds) + place(i)*(bounds(2) - bounds(1)))
         outward = [sin(phi), cos(phi)]
         depth = (self%reach - gap%machined_clearance + dot_product(motion%middle%position, outward))/self%roughness
         rise = dot_product(motion%slope, outward)/self%roughness
         from = -0.5_wp*gap%axial_length
         to = -from
         if (depth + rise*from < 0 .and. depth + rise*to > 0) from = -depth/rise
         if (depth + rise*to < 0 .and. depth + rise*from > 0) to = -depth/rise
         do k = 1, points
            z = 0.5_wp*(from + to + place(k)*(to - from))
            if (.not. depth + rise*z > 0) cycle
            force = 0.25_wp*(bounds(2) - bounds(1))*(to - from)*weight(i)*weight(k)*gap%pad_radius()*self%pressure &
               & *(depth + rise*z)**exponent
            falling = exponent*force/((depth + rise*z)*self%roughness)
            m = [outward, z*outward]
            normal = normal + force
            pushed = pushed + force*m
            slope = slope + falling*m
            do l = 1, 4
               slopes(:, l) = slopes(:, l) + (falling*m(l))*m
            end do
         end do
      end do
   end subroutine add_area

   !> Sets where the film is to be taken: as without slopes at either end of the pad, where it is thinnest.
   pure subroutine set_sloped_film(self, gap, directions, motion, ends, load)
      class(asperity_contact_type), intent(in) :: self
      type(pad_gap_type), intent(in) :: gap
      type(pad_directions), intent(in) :: directions
      type(sloped_motion), intent(in) :: motion
      !> Least film thickness there, m.
      real(wp), intent(in) :: ends(2)
      type(sloped_asperity_load), intent(inout) :: load
      type(asperity_load) :: at(2)
      type(film_motion) :: there
      integer :: side
      associate (length => gap%axial_length)
         do side = 1, 2
            there = motion%at((side - 1.5_wp)*length)
            at(side)%thickness = ends(side)
            call set_film(self, gap, directions, there%position, at(side))
         end do
         load%film_motion%middle%position = 0.5_wp*(at(1)%film_position + at(2)%film_position)
         load%film_motion%slope = (at(2)%film_position - at(1)%film_position)/length
         associate (mean => 0.5_wp*(at(1)%film_slopes + at(2)%film_slopes), &
            & rise => at(2)%film_slopes - at(1)%film_slopes)
            load%film_motion_slopes(:2, :2) = mean
            load%film_motion_slopes(:2, 3:) = 0.25_wp*length*rise
            load%film_motion_slopes(3:, :2) = rise/length
            load%film_motion_slopes(3:, 3:) = mean
         end associate
      end associate
   end subroutine set_sloped_film

   !> Normal force, N.
   pure real(wp) function carried(self)
      class(asperity_load), intent(in) :: self
      carried = 0
      if (self%touches) carried = self%normal
   end function carried

   !> Sets forces and moment, and their derivatives; the journal's surface moves at a speed, m/s.
   pure subroutine set_loads(self, gap, position, speed, load)
      class(asperity_contact_type), intent(in) :: self
      type(pad_gap_type), intent(in) :: gap
      real(wp), intent(in) :: position(2), speed
      type(asperity_load), intent(inout) :: load
      type(contact_sums) :: sums
      call add_arc(self, gap, position, -gap%trailing_angle, gap%leading_angle, sums)
      ! friction pulls the journal along phi, and turns the pad with the journal
      associate (friction => friction_at(self, speed), s => sums%slopes)
         load%normal = sums%normal
         load%force = -sums%pushed + friction*[sums%pushed(2), -sums%pushed(1)]
         load%force_slopes(1, :) = -s(1, :) + friction*s(2, :)
         load%force_slopes(2, :) = -s(2, :) - friction*s(1, :)
         load%moment = friction*gap%pad_radius()*sums%normal
         load%moment_slopes = friction*gap%pad_radius()*sums%slope
      end associate
   end subroutine set_loads

   !> The coefficient of friction where the journal's surface moves at a speed, m/s.
   pure real(wp) function friction_at(self, speed) result(friction)
      class(asperity_contact_type), intent(in) :: self
      real(wp), intent(in) :: speed
      friction = self%friction*speed/sqrt(speed**2 + self%slow**2)
   end function friction_at

   !> Heat by friction, W, on each of n equal parts of the arc, from the leading edge on. The journal lies at a position
   !> of its frame on the pad, m, and its surface moves at a speed, m/s. All parts together: the moment of `evaluate`,
   !> over the pad's radius, times this speed.
   pure function heat(self, gap, position, speed, n) result(parts)
      class(asperity_contact_type), intent(in) :: self
      type(pad_gap_type), intent(in) :: gap
      real(wp), intent(in) :: position(2), speed
      integer, intent(in) :: n
      real(wp) :: parts(n)
      type(contact_sums) :: sums
      integer :: i
      do i = 1, n
         sums = contact_sums()
         associate (leading => gap%leading_angle, part => gap%arc()/n)
            call add_arc(self, gap, position, leading - i*part, leading - (i - 1)*part, sums)
         end associate
         parts(i) = friction_at(self, speed)*sums%normal*speed
      end do
   end function heat

   !> Adds the integrals over the part of the arc from one angle to another, rad, where surfaces touch.
   pure subroutine add_arc(self, gap, position, first, last, sums)
      class(asperity_contact_type), intent(in) :: self
      type(pad_gap_type), intent(in) :: gap
      real(wp), intent(in) :: position(2), first, last
      type(contact_sums), intent(inout) :: sums
      real(wp) :: half, towards, low, high
      integer :: turn
      ! the film is thin within `half` of the direction towards which the journal lies
      towards = atan2(position(1), position(2))
      half = acos(min(1.0_wp, max(-1.0_wp, (gap%machined_clearance - self%reach)/max(norm2(position), tiny(half)))))
      do turn = -1, 1
         low = max(towards + 2*pi*turn - half, first)
         high = min(towards + 2*pi*turn + half, last)
         if (high > low) call add_stretch(self, gap, position, low, high, sums)
      end do
   end subroutine add_arc

   !> Adds the integrals over the arc from one angle to another, rad.
   pure subroutine add_stretch(self, gap, position, low, high, sums)
      class(asperity_contact_type), intent(in) :: self
      type(pad_gap_type), intent(in) :: gap
      real(wp), intent(in) :: position(2), low, high
      type(contact_sums), intent(inout) :: sums
      real(wp) :: phi, outward(2), depth, force, falling
      integer :: k
      do k = 1, points
         phi = 0.5_wp*(low + high + place(k)*(high - low))
         outward = [sin(phi), cos(phi)]
         depth = (self%reach - gap%machined_clearance + dot_product(position, outward))/self%roughness
         ! rounding, at the ends
         if (.not. depth > 0) cycle
         force = 0.5_wp*(high - low)*weight(k)*gap%pad_radius()*gap%axial_length*self%pressure*depth**exponent
         falling = exponent*force/(depth*self%roughness)
         sums%normal = sums%normal + force
         sums%pushed = sums%pushed + force*outward
         sums%slope = sums%slope + falling*outward
         sums%slopes(:, 1) = sums%slopes(:, 1) + (falling*outward(1))*outward
         sums%slopes(:, 2) = sums%slopes(:, 2) + (falling*outward(2))*outward
      end do
   end subroutine add_stretch

   !> Sets where the film is to be taken. Oil fills the valleys, so its gap never closes: the film is that of a journal
   !> that lies less close, by as much as the mean gap h_T at the thinnest place is more than h. With u = 1 - h/h_1,
   !> h_T = h_1/(1 + u + u^2 + u^3) below h_1 = 2 sigma, which joins h_T = h = h_1 (1 - u) with three derivatives.
   pure subroutine set_film(self, gap, directions, position, load)
      class(asperity_contact_type), intent(in) :: self
      type(pad_gap_type), intent(in) :: gap
      type(pad_directions), intent(in) :: directions
      real(wp), intent(in) :: position(2)
      type(asperity_load), intent(inout) :: load
      real(wp) :: u, growth, rise, rate, towards(2), turning
      integer :: k
      u = 1 - load%thickness/(oil_ratio*self%roughness)
      load%film_position = position
      load%film_slopes = reshape([1, 0, 0, 1], [2, 2])
      if (u <= 0) return
      growth = 1 + u*(1 + u*(1 + u))
      rise = oil_ratio*self%roughness/growth - load%thickness
      ! of h_T over h
      rate = (1 + u*(2 + 3*u))/growth**2
      call gap%thinnest_place(position, directions, towards, turning)
      load%film_position = position - rise*towards
      do k = 1, 2
         load%film_slopes(:, k) = (1 - rise*turning)*load%film_slopes(:, k) &
            & + (rate - 1 + rise*turning)*towards(k)*towards
      end do
   end subroutine set_film
end module asperity_contact
