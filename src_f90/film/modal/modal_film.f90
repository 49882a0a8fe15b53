!> Film by axial modes: exact in the axial direction wherever nothing cavitates (docs/theory.md).
!>
!> With the pressure above ambient as sum_k b_k u_k(phi) cos(lambda_k Z), lambda_k = (2k+1) pi/L and
!> b_k = 4 (-1)^k/((2k+1) pi), the Reynolds equation (times R^2) separates into
!>    (h^3 u')' - Lambda_k^2 h^3 u = r,   Lambda_k = R lambda_k,   u = p_sup - p_amb at the leading edge, 0
!> at the trailing one. With g = h^(3/2) and q = g u it becomes q'' = (Lambda_k^2 + v) q + s with
!> v = g''/g and s = r/g, which Numerov's scheme solves to fourth order (modal_sweeps). The modes left out
!> are summed in closed form: the narrow-pad limit u = -r/(h^3 Lambda^2) and its edge layers.
!>
!> Guembel's condition needs the field: it is rebuilt at Gauss points across the half width, and what lies
!> below the cavitation pressure is taken out of the force.
module modal_film
   use kinds, only: wp, pi
   use film_solver, only: film_solver_type, film_motion, film_response, film_closed
   use pad_gap, only: pad_gap_type, pad_directions
   use clipped_quadrature, only: gregory_weights, clipped_weights
   use modal_field, only: axial_profile, left_out, field_of_modes
   use modal_sweeps, only: lanes, weigh_nodes, solve_modes, solve_adjoints, sum_modes, &
      & sum_adjoint, looks, lowest_pressure
   implicit none (type, external)
   private
   public :: modal_film_type, new_modal_film, enough_cells, enough_modes

   !> Largest (Lambda d)^2/12 of a mode on a grid of step d: beyond, its edge layer is thinner than a cell,
   !> and the closed form is better than the grid.
   real(wp), parameter :: stiffest_mode = 0.5_wp
   !> Gauss-Legendre places and weights across the half width, over it. Behind them those where rupture is
   !> looked for, without weight: the middle, and towards the side, where a film that diverges at its trailing
   !> edge first falls below the pressure of its edges.
   integer, parameter :: gauss = 8, middle = 9, all_places = gauss + looks
   real(wp), parameter :: half_places(4) = [0.183434642495650_wp, 0.525532409916329_wp, &
      & 0.796666477413627_wp, 0.960289856497536_wp]
   real(wp), parameter :: half_weights(4) = [0.362683783378362_wp, 0.313706645877887_wp, &
      & 0.222381034453374_wp, 0.101228536290376_wp]
   real(wp), parameter :: places(all_places) = [0.5_wp*(1 + [-half_places, half_places]), &
      & 0.0_wp, 0.75_wp, 0.9_wp, 0.95_wp]
   real(wp), parameter :: place_weights(gauss) = 0.5_wp*[half_weights, half_weights]
   !> Sums over the odd numbers m of 1/m^3, 1/m^4, 1/m^5: 7/8 zeta(3), pi^4/96, 31/32 zeta(5).
   real(wp), parameter :: odd_sums(3) = [7*1.2020569031595943_wp/8, pi**4/96, 31*1.0369277551433699_wp/32]

   !> One pad: grid, modes, and the last solution. Nodes 0:n run from the trailing to the leading edge;
   !> `d` is their distance, rad. Modes fill up blocks of `lanes`; idle lanes have c = 0.
   type :: modal_pad
      type(pad_gap_type) :: film
      type(pad_directions) :: directions
      integer :: n, modes, blocks
      real(wp) :: d, radius
      !> Sine, cosine and weight of the quadrature at the nodes; the weight times either.
      real(wp), allocatable :: sine(:), cosine(:), weight(:), along(:), outward(:)
      !> By lane: c_k = (L/2) b_k^2; (Lambda_k d)^2/12; b_k; and b_k cos(lambda_k Z) at (place, lane), at
      !> Gauss's places and where rupture is looked for.
      real(wp), allocatable :: c(:), stiffness(:), at_middle(:), across(:, :), look(:, :)
      !> Sums over the modes left out of c_k/Lambda_k^j, j = 1, 2, 3, and of b_k cos(lambda_k Z)/Lambda_k^2.
      real(wp) :: tail(3), place_tail(all_places)
      !> At the nodes: film thickness, its slope over phi, 1/g, v, r, s.
      real(wp), allocatable :: h(:), h_slope(:), per_g(:), v(:), r(:), s(:)
      !> By lane, node and block: a = 1 - d^2 V/12, factors f of the elimination, q.
      real(wp), allocatable :: a(:, :, :), f(:, :, :), q(:, :, :)
      !> What q/g by (lane, node, block) and -r/h^3 by node count along the width: c and tail(2), less the
      !> part of the width where the film has ruptured, if it has.
      real(wp), allocatable :: share(:, :, :), narrow_share(:)
      logical :: ruptured = .true.
   end type modal_pad

   type, extends(film_solver_type) :: modal_film_type
      private
      !> Guembel's condition: as the solver was made; in force.
      logical :: made_gumbel = .false., gumbel = .false.
      type(modal_pad), allocatable :: pads(:)
   contains
      procedure :: ruptures
      procedure :: set_rupture
      procedure :: evaluate => evaluate_all
      procedure :: field => field_all
   end type modal_film_type

contains

   !> Cells along the arc, even, and modes with which the error of the force is 1e-4 or less, over pads of 20 to
   !> 120 degrees with lengths of 0.25 to 2 diameters (tests/physics/test_film_accuracy.f90). The measure is a
   !> pad's length over its arc: a narrow film has thin layers along its edges, a wide one takes more modes,
   !> most of all where the supply pressure bends the profile at the leading edge.
   pure integer function enough_cells(films)
      type(pad_gap_type), intent(in) :: films(:)
      enough_cells = max(24, 2*ceiling(8/minval(aspect(films))))
   end function enough_cells

   pure integer function enough_modes(films)
      type(pad_gap_type), intent(in) :: films(:)
      enough_modes = lanes*maxval(ceiling(aspect(films) &
         & /merge(1.2_wp, 2.5_wp, films%supply_pressure > films%ambient_pressure)))
   end function enough_modes

   !> Axial length over the length of the arc.
   elemental real(wp) function aspect(film)
      type(pad_gap_type), intent(in) :: film
      aspect = film%axial_length/(film%pad_radius()*film%arc())
   end function aspect

   !> A solver for the films of a bearing's pads with an even number of cells along the arc and at most so
   !> many modes; with Guembel's condition or none.
   pure function new_modal_film(films, cells, modes, gumbel) result(solver)
      type(pad_gap_type), intent(in) :: films(:)
      integer, intent(in) :: cells, modes
      logical, intent(in) :: gumbel
      type(modal_film_type) :: solver
      integer :: i
      solver%made_gumbel = gumbel
      solver%gumbel = gumbel
      allocate (solver%pads(size(films)))
      do i = 1, size(films)
         call init_pad(solver%pads(i), films(i), cells, modes)
         call set_weights(solver%pads(i), gumbel)
      end do
   end function new_modal_film

   pure logical function ruptures(self)
      class(modal_film_type), intent(in) :: self
      ruptures = self%gumbel
   end function ruptures

   pure subroutine set_rupture(self, allowed)
      class(modal_film_type), intent(inout) :: self
      logical, intent(in) :: allowed
      integer :: i
      self%gumbel = self%made_gumbel .and. allowed
      do i = 1, size(self%pads)
         call set_weights(self%pads(i), self%gumbel)
      end do
   end subroutine set_rupture

   pure subroutine init_pad(pad, film, n, most)
      type(modal_pad), intent(out) :: pad
      type(pad_gap_type), intent(in) :: film
      integer, intent(in) :: n, most
      real(wp) :: phi(0:n), lambda(most), unit, profile(all_places)
      integer :: i, k
      pad%film = film
      pad%directions = film%directions()
      pad%n = n
      pad%radius = film%pad_radius()
      pad%d = film%arc()/n
      unit = film%axial_length/(pi*pad%radius)
      lambda = [((2*k - 1)/unit, k=1, most)]
      pad%modes = count((lambda*pad%d)**2/12 <= stiffest_mode)
      pad%blocks = (pad%modes + lanes - 1)/lanes
      allocate (pad%c(lanes*pad%blocks), pad%stiffness(lanes*pad%blocks), source=0.0_wp)
      allocate (pad%across(gauss, lanes*pad%blocks), source=0.0_wp)
      allocate (pad%at_middle(lanes*pad%blocks), pad%look(looks, lanes*pad%blocks), source=0.0_wp)
      pad%tail = 8*film%axial_length/pi**2*odd_sums*[unit, unit**2, unit**3]
      pad%place_tail = left_out(film, pad%modes, places)
      do k = 1, pad%modes
         pad%c(k) = 8*film%axial_length/((2*k - 1)*pi)**2
         pad%stiffness(k) = (lambda(k)*pad%d)**2/12
         profile = axial_profile(k, places)
         pad%across(:, k) = profile(:gauss)
         pad%at_middle(k) = profile(middle)
         pad%look(:, k) = profile(gauss + 1:)
         pad%tail = pad%tail - pad%c(k)/[lambda(k), lambda(k)**2, lambda(k)**3]
      end do
      phi = [(i*pad%d - film%trailing_angle, i=0, n)]
      allocate (pad%sine(0:n), pad%cosine(0:n), pad%weight(0:n), pad%along(0:n), pad%outward(0:n))
      pad%sine(:) = sin(phi)
      pad%cosine(:) = cos(phi)
      allocate (pad%h(0:n), pad%h_slope(0:n), pad%per_g(0:n), pad%v(0:n), pad%r(0:n), pad%s(0:n))
      allocate (pad%a(lanes, 0:n, pad%blocks), pad%f(lanes, 0:n, pad%blocks), pad%q(lanes, 0:n, pad%blocks))
      allocate (pad%share(lanes, 0:n, pad%blocks), pad%narrow_share(0:n))
   end subroutine init_pad

   !> The quadrature's weights at the nodes, for a film that is clipped or not.
   pure subroutine set_weights(pad, clipped)
      type(modal_pad), intent(inout) :: pad
      logical, intent(in) :: clipped
      if (clipped .or. pad%n < 6) then
         ! the weights of what may be clipped
         call clipped_weights(pad%n, spread(1.0_wp, 1, pad%n + 1), pad%weight)
      else
         ! the layers at the edges are thin: the order of the ends decides
         pad%weight(:) = gregory_weights(pad%n)
      end if
      pad%weight = pad%d*pad%weight
      pad%along(:) = pad%weight*pad%sine
      pad%outward(:) = pad%weight*pad%cosine
   end subroutine set_weights

   subroutine evaluate_all(self, motion, speed, want_derivatives, response)
      class(modal_film_type), intent(inout) :: self
      type(film_motion), intent(in) :: motion(:)
      real(wp), intent(in) :: speed
      logical, intent(in) :: want_derivatives
      type(film_response), intent(out) :: response(:)
      real(wp) :: rise
      logical :: clip
      integer :: i, b
      do i = 1, size(motion)
         associate (pad => self%pads(i))
            response(i)%min_film_thickness = pad%film%min_film_thickness(motion(i), pad%directions)
            if (.not. response(i)%min_film_thickness > 0) then
               response(i)%status = film_closed
               cycle
            end if
            self%counters%modal = self%counters%modal + 1
            rise = pad%film%supply_pressure - pad%film%ambient_pressure
            call set_nodes(pad%n, pad%film%machined_clearance, motion(i), source_factors(pad, speed), pad%sine, &
               & pad%cosine, pad%h, pad%h_slope, pad%per_g, pad%v, pad%r, pad%s)
            do b = 1, pad%blocks
               call solve_modes(pad%n, pad%d, pad%stiffness(lanes*b - lanes + 1:lanes*b), pad%v, pad%s, &
                  & rise/pad%per_g(pad%n), pad%a(:, :, b), pad%f(:, :, b), pad%q(:, :, b))
            end do
            call sum_up(pad, rise, response(i))
            clip = self%gumbel .and. response(i)%min_pressure < pad%film%cavitation_pressure
            if (pad%ruptured .and. want_derivatives) call whole_shares(pad)
            if (clip) call rupture(pad, rise, want_derivatives, response(i))
            if (want_derivatives) call add_slopes(pad, rise, source_factors(pad, speed), response(i))
         end associate
      end do
   end subroutine evaluate_all

   subroutine field_all(self, motion, speed, phi, z, pressure)
      class(modal_film_type), intent(inout) :: self
      type(film_motion), intent(in) :: motion(:)
      real(wp), intent(in) :: speed, phi(:, :), z(:)
      real(wp), intent(out) :: pressure(:, :, :)
      type(film_response) :: response(size(motion))
      integer :: i
      call self%evaluate(motion, speed, .false., response)
      do i = 1, size(motion)
         associate (pad => self%pads(i))
            pressure(:, :, i) = field_of_modes(pad%film, motion(i), pad%modes, pad%per_g, pad%s, pad%q, phi(:, i), z)
            if (self%gumbel) pressure(:, :, i) = max(pressure(:, :, i), pad%film%cavitation_pressure)
         end associate
      end do
   end subroutine field_all

   !> Factors of dh/dphi (wedge) and dh/dt (squeeze) in r.
   pure function source_factors(pad, speed) result(factors)
      type(modal_pad), intent(in) :: pad
      real(wp), intent(in) :: speed
      real(wp) :: factors(2)
      factors = pad%film%viscosity*pad%radius*[-6*speed*pad%film%journal_radius, 12*pad%radius]
   end function source_factors

   !> Film thickness and what the equation takes from it, at the nodes.
   pure subroutine set_nodes(n, clearance, motion, factors, sine, cosine, h, h_slope, per_g, v, r, s)
      integer, intent(in) :: n
      real(wp), intent(in) :: clearance
      type(film_motion), intent(in) :: motion
      real(wp), intent(in) :: factors(2), sine(0:n), cosine(0:n)
      real(wp), dimension(0:n), intent(out) :: h, h_slope, per_g, v, r, s
      real(wp) :: per_h
      integer :: i
      associate (e => motion%position, w => motion%velocity)
         !$omp simd private(per_h)
         do i = 0, n
            h(i) = clearance - e(1)*sine(i) - e(2)*cosine(i)
            h_slope(i) = e(2)*sine(i) - e(1)*cosine(i)
            per_h = 1/h(i)
            per_g(i) = per_h*sqrt(per_h)
            ! h'' = c_m - h
            v(i) = 0.75_wp*(h_slope(i)*per_h)**2 + 1.5_wp*(clearance*per_h - 1)
            r(i) = factors(1)*h_slope(i) - factors(2)*(w(1)*sine(i) + w(2)*cosine(i))
            s(i) = r(i)*per_g(i)
         end do
      end associate
   end subroutine set_nodes

   !> Force of the whole film, lowest and highest pressure.
   pure subroutine sum_up(pad, rise, response)
      type(modal_pad), intent(in) :: pad
      real(wp), intent(in) :: rise
      type(film_response), intent(inout) :: response
      real(wp), dimension(0:pad%n) :: along, outward, p_middle
      real(wp) :: force(2), edge(0:1), lowest, highest
      integer :: i, b
      associate (film => pad%film, n => pad%n, s => pad%s, per_g => pad%per_g, sine => pad%sine, cosine => pad%cosine)
         call weigh_nodes(n, pad%along, pad%outward, per_g, s, pad%tail(2), pad%place_tail(middle), &
            & along, outward, force, p_middle)
         do b = 1, pad%blocks
            associate (first => lanes*b - lanes + 1, last => lanes*b)
               call sum_modes(n, along, outward, pad%c(first:last), pad%at_middle(first:last), &
                  & pad%q(:, :, b), force, p_middle)
            end associate
         end do
         ! layers at the edges of the modes left out, and the supply pressure in them
         edge = pad%tail(3)*[s(0)*per_g(0), s(n)*per_g(n)]
         edge(1) = edge(1) + pad%tail(1)*rise
         force(1) = force(1) + edge(0)*sine(0) + edge(1)*sine(n) &
            & + film%ambient_pressure*film%axial_length*(cosine(0) - cosine(n))
         force(2) = force(2) + edge(0)*cosine(0) + edge(1)*cosine(n) &
            & + film%ambient_pressure*film%axial_length*(sine(n) - sine(0))
         response%force = -pad%radius*force
         lowest = min(0.0_wp, rise, lowest_pressure(n, pad%blocks, s, per_g, pad%place_tail(gauss + 1:), pad%look, &
            & pad%q))
         highest = max(0.0_wp, rise)
         do i = 1, n - 1
            highest = max(highest, per_g(i)*p_middle(i))
         end do
         response%min_pressure = film%ambient_pressure + lowest
         response%max_pressure = film%ambient_pressure + highest
      end associate
   end subroutine sum_up

   !> Takes what lies below the cavitation pressure out of the force and, if wanted, its share of the width out
   !> of the shares.
   pure subroutine rupture(pad, rise, want_shares, response)
      type(modal_pad), intent(inout) :: pad
      real(wp), intent(in) :: rise
      logical, intent(in) :: want_shares
      type(film_response), intent(inout) :: response
      !> Cavitation pressure less pressure, and weights of what is missing, by place and node.
      real(wp), dimension(gauss, 0:pad%n) :: deficit, lost
      real(wp) :: floor, missing, p(gauss), weights(0:pad%n)
      integer :: i, b, k, l, place
      associate (n => pad%n)
         floor = pad%film%cavitation_pressure - pad%film%ambient_pressure
         deficit(:, 0) = floor
         deficit(:, n) = floor - rise
         do i = 1, n - 1
            p = -pad%place_tail(:gauss)*pad%s(i)
            do b = 1, pad%blocks
               do k = 1, lanes
                  p = p + pad%across(:, lanes*(b - 1) + k)*pad%q(k, i, b)
               end do
            end do
            deficit(:, i) = floor - p*pad%per_g(i)
         end do
         do place = 1, gauss
            call clipped_weights(n, deficit(place, :), weights)
            lost(place, :) = (pad%d*place_weights(place)*pad%film%axial_length)*weights
         end do
         do i = 0, n
            missing = pad%radius*dot_product(lost(:, i), deficit(:, i))
            response%force = response%force - missing*[pad%sine(i), pad%cosine(i)]
         end do
         response%max_pressure = max(response%max_pressure, pad%film%cavitation_pressure)
         if (.not. want_shares) return
         pad%ruptured = .true.
         do i = 0, n
            lost(:, i) = lost(:, i)/pad%weight(i)
            pad%narrow_share(i) = pad%narrow_share(i) - dot_product(lost(:, i), pad%place_tail(:gauss))
            do b = 1, pad%blocks
               do k = 1, lanes
                  l = lanes*(b - 1) + k
                  pad%share(k, i, b) = pad%share(k, i, b) - dot_product(lost(:, i), pad%across(:, l))
               end do
            end do
         end do
      end associate
   end subroutine rupture

   !> The shares of a film without rupture.
   pure subroutine whole_shares(pad)
      type(modal_pad), intent(inout) :: pad
      integer :: b
      do b = 1, pad%blocks
         pad%share(:, :, b) = spread(pad%c(lanes*b - lanes + 1:lanes*b), 2, pad%n + 1)
      end do
      pad%narrow_share = pad%tail(2)
      pad%ruptured = .false.
   end subroutine whole_shares

   !> Force derivatives by adjoints. For a force weight psi, let B m = -share psi weight/g with the matrix B
   !> of the scheme; the force changes by m . (dS - dB q) and by what changes in the quadrature itself; all
   !> of it is linear in dh, dh' and dr at the nodes.
   pure subroutine add_slopes(pad, rise, factors, response)
      type(modal_pad), intent(inout) :: pad
      real(wp), intent(in) :: rise, factors(2)
      type(film_response), intent(inout) :: response
      real(wp) :: adjoint(lanes, 0:pad%n, 2)
      real(wp), dimension(0:pad%n, 2) :: over_line, load, over_s, over_v
      real(wp) :: boundary(2), total, over_narrow, over_h, over_slope, over_r, per_h
      integer :: i, m, b
      associate (n => pad%n, sine => pad%sine, cosine => pad%cosine, per_g => pad%per_g)
         ! slopes of the force over q/g, v and s at the nodes
         over_line(:, 1) = -pad%radius*pad%along
         over_line(:, 2) = -pad%radius*pad%outward
         load(:, 1) = over_line(:, 1)*per_g
         load(:, 2) = over_line(:, 2)*per_g
         over_s = 0
         over_v = 0
         boundary = 0
         do b = 1, pad%blocks
            call solve_adjoints(n, pad%a(:, :, b), pad%f(:, :, b), pad%share(:, :, b), load, adjoint)
            do m = 1, 2
               call sum_adjoint(n, adjoint(:, :, m), pad%q(:, :, b), over_s(:, m), over_v(:, m))
               ! q = rise g at the leading edge stands in the last equation as a q
               boundary(m) = boundary(m) - dot_product(adjoint(:, n - 1, m), pad%a(:, n, b))*rise/per_g(n)
            end do
         end do
         over_s = pad%d**2/12*over_s
         over_v = pad%d**2/12*over_v
         response%slope = 0
         do i = 0, n
            per_h = 1/pad%h(i)
            ! q/g at the leading edge is given
            total = 0
            if (i < n) then
               do b = 1, pad%blocks
                  total = total + dot_product(pad%share(:, i, b), pad%q(:, i, b))
               end do
            end if
            do m = 1, 2
               ! slope over -r/h^3
               over_narrow = pad%narrow_share(i)*over_line(i, m)
               if (i == 0 .or. i == n) over_narrow = over_narrow &
                  & + pad%tail(3)*pad%radius*merge(sine(i), cosine(i), m == 1)
               ! v = 3/4 (h'/h)^2 + 3/2 (c_m/h - 1), s = r h^(-3/2), 1/g = h^(-3/2), r = wedge h' + squeeze dh/dt
               over_r = over_s(i, m)*per_g(i) - over_narrow*per_g(i)**2
               over_slope = over_v(i, m)*1.5_wp*pad%h_slope(i)*per_h**2 + over_r*factors(1)
               over_h = -over_v(i, m)*1.5_wp*(pad%h_slope(i)**2*per_h + pad%film%machined_clearance)*per_h**2 &
                  & - 1.5_wp*per_h*(over_s(i, m)*pad%s(i) + over_line(i, m)*total*per_g(i)) &
                  & + 3*over_narrow*pad%s(i)*per_g(i)*per_h
               if (i == n) over_h = over_h + 1.5_wp*per_h*boundary(m)
               response%slope(m, 1) = response%slope(m, 1) - over_h*sine(i) - over_slope*cosine(i)
               response%slope(m, 2) = response%slope(m, 2) - over_h*cosine(i) + over_slope*sine(i)
               response%slope(m, 3) = response%slope(m, 3) - factors(2)*over_r*sine(i)
               response%slope(m, 4) = response%slope(m, 4) - factors(2)*over_r*cosine(i)
            end do
         end do
      end associate
   end subroutine add_slopes
end module modal_film
