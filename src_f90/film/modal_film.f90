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
   use pad_film, only: pad_film_type
   use modal_sweeps, only: lanes, solve_modes, solve_adjoint, sum_modes
   implicit none (type, external)
   private
   public :: modal_film_type, new_modal_film

   !> Largest (Lambda d)^2/12 of a mode on a grid of step d: beyond, its edge layer is thinner than a cell,
   !> and the closed form is better than the grid.
   real(wp), parameter :: stiffest_mode = 0.5_wp
   !> Gauss-Legendre places and weights across the half width, over it. Behind them the two places where
   !> rupture is looked for, without weight.
   integer, parameter :: gauss = 8, middle = 9, side = 10
   real(wp), parameter :: half_places(4) = [0.183434642495650_wp, 0.525532409916329_wp, &
      & 0.796666477413627_wp, 0.960289856497536_wp]
   real(wp), parameter :: half_weights(4) = [0.362683783378362_wp, 0.313706645877887_wp, &
      & 0.222381034453374_wp, 0.101228536290376_wp]
   real(wp), parameter :: places(side) = [0.5_wp*(1 + [-half_places, half_places]), 0.0_wp, 0.75_wp]
   real(wp), parameter :: place_weights(gauss) = 0.5_wp*[half_weights, half_weights]
   !> Sums over the odd numbers m of 1/m^3, 1/m^4, 1/m^5: 7/8 zeta(3), pi^4/96, 31/32 zeta(5).
   real(wp), parameter :: odd_sums(3) = [7*1.2020569031595943_wp/8, pi**4/96, 31*1.0369277551433699_wp/32]

   !> One pad: grid, modes, and the last solution. Nodes 0:n run from the trailing to the leading edge;
   !> `d` is their distance, rad. Modes fill up blocks of `lanes`; idle lanes have c = 0.
   type :: modal_pad
      type(pad_film_type) :: film
      integer :: n, blocks
      real(wp) :: d, radius
      !> Sine, cosine and weight of the quadrature (Simpson's rule) at the nodes.
      real(wp), allocatable :: sine(:), cosine(:), weight(:)
      !> By lane: c_k = (L/2) b_k^2; (Lambda_k d)^2/12; and b_k cos(lambda_k Z) at (lane, place).
      real(wp), allocatable :: c(:), stiffness(:), at_place(:, :)
      !> Sums over the modes left out of c_k/Lambda_k^j, j = 1, 2, 3, and of b_k cos(lambda_k Z)/Lambda_k^2.
      real(wp) :: tail(3), place_tail(side)
      !> At the nodes: film thickness, its slope over phi, 1/g, v, r, s.
      real(wp), allocatable :: h(:), h_slope(:), per_g(:), v(:), r(:), s(:)
      !> By lane, node and block: a = 1 - d^2 V/12, factors f of the elimination, q.
      real(wp), allocatable :: a(:, :, :), f(:, :, :), q(:, :, :)
      !> What q/g by (lane, block, node) and -r/h^3 by node count along the width: c and tail(2), less the
      !> part of the width where the film has ruptured.
      real(wp), allocatable :: share(:, :, :), narrow_share(:)
   end type modal_pad

   type, extends(film_solver_type) :: modal_film_type
      private
      logical :: gumbel = .false.
      type(modal_pad), allocatable :: pads(:)
   contains
      procedure :: evaluate => evaluate_all
   end type modal_film_type

contains

   !> A solver for the films of a bearing's pads with an even number of cells along the arc and at most so
   !> many modes; with Guembel's condition or none.
   pure function new_modal_film(films, cells, modes, gumbel) result(solver)
      type(pad_film_type), intent(in) :: films(:)
      integer, intent(in) :: cells, modes
      logical, intent(in) :: gumbel
      type(modal_film_type) :: solver
      integer :: i
      solver%gumbel = gumbel
      allocate (solver%pads(size(films)))
      do i = 1, size(films)
         call init_pad(solver%pads(i), films(i), cells, modes)
      end do
   end function new_modal_film

   pure subroutine init_pad(pad, film, n, most)
      type(modal_pad), intent(out) :: pad
      type(pad_film_type), intent(in) :: film
      integer, intent(in) :: n, most
      real(wp) :: phi(0:n), lambda(most), unit
      integer :: i, k, modes
      pad%film = film
      pad%n = n
      pad%radius = film%pad_radius()
      pad%d = film%arc()/n
      unit = film%axial_length/(pi*pad%radius)
      lambda = [((2*k - 1)/unit, k=1, most)]
      modes = count((lambda*pad%d)**2/12 <= stiffest_mode)
      pad%blocks = (modes + lanes - 1)/lanes
      allocate (pad%c(lanes*pad%blocks), pad%stiffness(lanes*pad%blocks), source=0.0_wp)
      allocate (pad%at_place(lanes*pad%blocks, side), source=0.0_wp)
      pad%tail = 8*film%axial_length/pi**2*odd_sums*[unit, unit**2, unit**3]
      pad%place_tail = (film%axial_length/pad%radius)**2*(1 - places**2)/8
      do k = 1, modes
         pad%c(k) = 8*film%axial_length/((2*k - 1)*pi)**2
         pad%stiffness(k) = (lambda(k)*pad%d)**2/12
         pad%at_place(k, :) = -4*(-1)**k/((2*k - 1)*pi)*cos((2*k - 1)*pi/2*places)
         pad%tail = pad%tail - pad%c(k)/[lambda(k), lambda(k)**2, lambda(k)**3]
         pad%place_tail = pad%place_tail - pad%at_place(k, :)/lambda(k)**2
      end do
      phi = [(i*pad%d - film%trailing_angle, i=0, n)]
      allocate (pad%sine(0:n), pad%cosine(0:n), pad%weight(0:n))
      pad%sine(:) = sin(phi)
      pad%cosine(:) = cos(phi)
      pad%weight(0:n:2) = 2*pad%d/3
      pad%weight(1:n:2) = 4*pad%d/3
      pad%weight(0:n:n) = pad%d/3
      allocate (pad%h(0:n), pad%h_slope(0:n), pad%per_g(0:n), pad%v(0:n), pad%r(0:n), pad%s(0:n))
      allocate (pad%a(lanes, 0:n, pad%blocks), pad%f(lanes, 0:n, pad%blocks), pad%q(lanes, 0:n, pad%blocks))
      allocate (pad%share(lanes, pad%blocks, 0:n), pad%narrow_share(0:n))
   end subroutine init_pad

   subroutine evaluate_all(self, motion, speed, want_slopes, response)
      class(modal_film_type), intent(inout) :: self
      type(film_motion), intent(in) :: motion(:)
      real(wp), intent(in) :: speed
      logical, intent(in) :: want_slopes
      type(film_response), intent(out) :: response(:)
      real(wp) :: rise
      logical :: clip
      integer :: i, b
      do i = 1, size(motion)
         associate (pad => self%pads(i))
            response(i)%min_film = pad%film%least_thickness(motion(i))
            if (.not. response(i)%min_film > 0) then
               response(i)%status = film_closed
               cycle
            end if
            self%counters%modal = self%counters%modal + 1
            rise = pad%film%supply_pressure - pad%film%ambient_pressure
            call set_nodes(pad, motion(i), source_factors(pad, speed))
            do b = 1, pad%blocks
               call solve_modes(pad%n, pad%d, pad%stiffness(lanes*b - lanes + 1:lanes*b), pad%v, pad%s, &
                  & rise/pad%per_g(pad%n), pad%a(:, :, b), pad%f(:, :, b), pad%q(:, :, b))
            end do
            call sum_up(pad, rise, response(i))
            clip = self%gumbel .and. response(i)%min_pressure < pad%film%cavitation_pressure
            if (clip) call rupture(pad, response(i))
            if (want_slopes) call add_slopes(pad, rise, clip, source_factors(pad, speed), response(i))
         end associate
      end do
   end subroutine evaluate_all

   !> Factors of dh/dphi (wedge) and dh/dt (squeeze) in r.
   pure function source_factors(pad, speed) result(factors)
      type(modal_pad), intent(in) :: pad
      real(wp), intent(in) :: speed
      real(wp) :: factors(2)
      factors = pad%film%viscosity*pad%radius*[-6*speed*pad%film%journal_radius, 12*pad%radius]
   end function source_factors

   pure subroutine set_nodes(pad, motion, factors)
      type(modal_pad), intent(inout) :: pad
      type(film_motion), intent(in) :: motion
      real(wp), intent(in) :: factors(2)
      real(wp) :: per_h
      integer :: i
      associate (e => motion%position, w => motion%velocity, c => pad%film%machined_clearance)
         do i = 0, pad%n
            pad%h(i) = c - e(1)*pad%sine(i) - e(2)*pad%cosine(i)
            pad%h_slope(i) = e(2)*pad%sine(i) - e(1)*pad%cosine(i)
            per_h = 1/pad%h(i)
            pad%per_g(i) = per_h*sqrt(per_h)
            ! h'' = c_m - h
            pad%v(i) = 0.75_wp*(pad%h_slope(i)*per_h)**2 + 1.5_wp*(c*per_h - 1)
            pad%r(i) = factors(1)*pad%h_slope(i) - factors(2)*(w(1)*pad%sine(i) + w(2)*pad%cosine(i))
            pad%s(i) = pad%r(i)*pad%per_g(i)
         end do
      end associate
   end subroutine set_nodes

   !> Force of the whole film, lowest and highest pressure.
   pure subroutine sum_up(pad, rise, response)
      type(modal_pad), intent(in) :: pad
      real(wp), intent(in) :: rise
      type(film_response), intent(inout) :: response
      real(wp), dimension(0:pad%n) :: weight, p_middle, p_side
      real(wp) :: force(2), edge(0:1)
      integer :: b
      associate (film => pad%film, n => pad%n)
         weight = pad%weight*pad%per_g
         p_middle = -pad%place_tail(middle)*pad%s
         p_side = -pad%place_tail(side)*pad%s
         force = -pad%tail(2)*[dot_product(weight*pad%s, pad%sine), dot_product(weight*pad%s, pad%cosine)]
         do b = 1, pad%blocks
            associate (first => lanes*b - lanes + 1, last => lanes*b)
               call sum_modes(n, weight, pad%sine, pad%cosine, pad%c(first:last), pad%at_place(first:last, middle), &
                  & pad%at_place(first:last, side), pad%q(:, :, b), force, p_middle, p_side)
            end associate
         end do
         ! layers at the edges of the modes left out, and the supply pressure in them
         edge = pad%tail(3)*pad%s(::n)*pad%per_g(::n)
         edge(1) = edge(1) + pad%tail(1)*rise
         force = force + edge(0)*[pad%sine(0), pad%cosine(0)] + edge(1)*[pad%sine(n), pad%cosine(n)]
         response%force = -pad%radius*(force + film%ambient_pressure*film%axial_length &
            & *[pad%cosine(0) - pad%cosine(n), pad%sine(n) - pad%sine(0)])
         p_middle = p_middle*pad%per_g
         p_side = p_side*pad%per_g
         response%min_pressure = film%ambient_pressure &
            & + min(0.0_wp, rise, minval(p_middle(1:n - 1)), minval(p_side(1:n - 1)))
         response%max_pressure = film%ambient_pressure + max(0.0_wp, rise, maxval(p_middle(1:n - 1)))
      end associate
   end subroutine sum_up

   !> Takes what lies below the cavitation pressure out of the force, and its share of the width out of the
   !> shares.
   pure subroutine rupture(pad, response)
      type(modal_pad), intent(inout) :: pad
      type(film_response), intent(inout) :: response
      real(wp) :: p(gauss), lost(gauss), floor, missing
      integer :: i, b, k
      floor = pad%film%cavitation_pressure - pad%film%ambient_pressure
      call whole_shares(pad)
      ! the edges have their pressure
      do i = 1, pad%n - 1
         p = -pad%place_tail(:gauss)*pad%s(i)
         do b = 1, pad%blocks
            do k = 1, lanes
               p = p + pad%at_place(lanes*(b - 1) + k, :gauss)*pad%q(k, i, b)
            end do
         end do
         p = p*pad%per_g(i)
         if (minval(p) >= floor) cycle
         lost = merge(place_weights*pad%film%axial_length, 0.0_wp, p < floor)
         pad%narrow_share(i) = pad%narrow_share(i) - dot_product(lost, pad%place_tail(:gauss))
         do b = 1, pad%blocks
            do k = 1, lanes
               pad%share(k, b, i) = pad%share(k, b, i) - dot_product(lost, pad%at_place(lanes*(b - 1) + k, :gauss))
            end do
         end do
         missing = pad%radius*pad%weight(i)*dot_product(lost, floor - p)
         response%force = response%force - missing*[pad%sine(i), pad%cosine(i)]
      end do
      response%max_pressure = max(response%max_pressure, pad%film%cavitation_pressure)
   end subroutine rupture

   !> The shares of a film without rupture.
   pure subroutine whole_shares(pad)
      type(modal_pad), intent(inout) :: pad
      pad%share = spread(reshape(pad%c, [lanes, pad%blocks]), 3, pad%n + 1)
      pad%narrow_share = pad%tail(2)
   end subroutine whole_shares

   !> Force derivatives by adjoints. For a force weight psi, let B m = share psi weight/g with the matrix B
   !> of the scheme; the force changes by m . (dS - dB q) and by what changes in the quadrature itself; all
   !> of it is linear in dh, dh' and dr at the nodes.
   subroutine add_slopes(pad, rise, clip, factors, response)
      type(modal_pad), intent(inout) :: pad
      real(wp), intent(in) :: rise, factors(2)
      logical, intent(in) :: clip
      type(film_response), intent(inout) :: response
      real(wp), dimension(lanes, 0:pad%n) :: adjoint, spread_adjoint
      real(wp), dimension(0:pad%n) :: psi, total, over_v, over_s, over_line, over_narrow, over_h, over_slope, over_r
      real(wp) :: boundary
      integer :: i, m, n, b
      n = pad%n
      if (.not. clip) call whole_shares(pad)
      total = [(sum(pad%share(:, :, i)*pad%q(:, i, :)), i=0, n)]
      do m = 1, 2
         psi = -pad%radius*pad%sine
         if (m == 2) psi = -pad%radius*pad%cosine
         ! slopes of the force over q/g, -r/h^3, v and s at the nodes
         over_line = pad%weight*psi
         over_narrow = pad%narrow_share*pad%weight*psi
         over_narrow([0, n]) = over_narrow([0, n]) - pad%tail(3)*psi([0, n])
         over_s = 0
         over_v = 0
         boundary = 0
         do b = 1, pad%blocks
            call solve_adjoint(n, pad%a(:, :, b), pad%f(:, :, b), pad%share(:, b, :), over_line*pad%per_g, adjoint)
            spread_adjoint = 10*adjoint
            spread_adjoint(:, 1:) = spread_adjoint(:, 1:) + adjoint(:, :n - 1)
            spread_adjoint(:, :n - 1) = spread_adjoint(:, :n - 1) + adjoint(:, 1:)
            over_s = over_s + pad%d**2/12*sum(spread_adjoint, dim=1)
            over_v = over_v + pad%d**2/12*sum(spread_adjoint*pad%q(:, :, b), dim=1)
            ! q = rise g at the leading edge stands in the last equation as a q
            boundary = boundary - dot_product(adjoint(:, n - 1), pad%a(:, n, b))*rise/pad%per_g(n)
         end do
         ! q/g at the leading edge is given
         over_line(n) = 0
         ! v = 3/4 (h'/h)^2 + 3/2 (c_m/h - 1), s = r h^(-3/2), 1/g = h^(-3/2), r = wedge h' + squeeze dh/dt
         over_r = over_s*pad%per_g - over_narrow*pad%per_g**2
         over_slope = over_v*1.5_wp*pad%h_slope/pad%h**2 + over_r*factors(1)
         over_h = -over_v*1.5_wp*(pad%h_slope**2/pad%h + pad%film%machined_clearance)/pad%h**2 &
            & - 1.5_wp/pad%h*(over_s*pad%s + over_line*total*pad%per_g) + 3*over_narrow*pad%s*pad%per_g/pad%h
         over_h(n) = over_h(n) + 1.5_wp/pad%h(n)*boundary
         response%slope(m, :) = [-dot_product(over_h, pad%sine) - dot_product(over_slope, pad%cosine), &
            & -dot_product(over_h, pad%cosine) + dot_product(over_slope, pad%sine), &
            & -factors(2)*dot_product(over_r, pad%sine), -factors(2)*dot_product(over_r, pad%cosine)]
      end do
   end subroutine add_slopes
end module modal_film
