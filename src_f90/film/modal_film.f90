!> Film by axial modes: exact in the axial direction wherever nothing cavitates (docs/theory.md).
!>
!> With the pressure above ambient as sum_k b_k u_k(phi) cos(lambda_k Z), lambda_k = (2k+1) pi/L and
!> b_k = 4 (-1)^k/((2k+1) pi), the Reynolds equation (times R^2) separates into
!>    (h^3 u')' - Lambda_k^2 h^3 u = r,   Lambda_k = R lambda_k,   u = p_sup - p_amb at the leading edge, 0
!> at the trailing one. With g = h^(3/2) and q = g u it becomes q'' = (Lambda_k^2 + v) q + s with
!> v = g''/g and s = r/g, which Numerov's scheme solves to fourth order on a tridiagonal matrix. The modes
!> left out are summed in closed form: the narrow-pad limit u = -r/(h^3 Lambda^2) and its edge layers.
module modal_film
   use kinds, only: wp, pi
   use film_solver, only: film_solver_type, film_motion, film_response, film_closed
   use pad_film, only: pad_film_type
   implicit none (type, external)
   private
   public :: modal_film_type, new_modal_film

   !> Largest (Lambda d)^2/12 of a mode on a grid of step d: beyond, its edge layer is thinner than a cell,
   !> and the closed form is better than the grid.
   real(wp), parameter :: stiffest_mode = 0.5_wp
   !> Places across the half width, over it, where the pressure is looked at.
   real(wp), parameter :: stations(2) = [0.0_wp, 0.75_wp]
   !> Sums over the odd numbers m of 1/m^3, 1/m^4, 1/m^5: 7/8 zeta(3), pi^4/96, 31/32 zeta(5).
   real(wp), parameter :: odd_sums(3) = [7*1.2020569031595943_wp/8, pi**4/96, 31*1.0369277551433699_wp/32]

   !> One pad: grid, modes, and the last solution. Nodes 0:n run from the trailing to the leading edge;
   !> `d` is their distance, rad.
   type :: modal_pad
      type(pad_film_type) :: film
      real(wp) :: d
      !> Sine, cosine and weight of the quadrature (Simpson's rule) at the nodes.
      real(wp), allocatable :: sine(:), cosine(:), weight(:)
      !> By mode: c_k = (L/2) b_k^2; (Lambda_k d)^2/12; b_k cos(lambda_k Z) at the stations.
      real(wp), allocatable :: c(:), stiffness(:), at_station(:, :)
      !> Sums over the modes left out of c_k/Lambda_k^j, j = 1, 2, 3, and of b_k cos(lambda_k Z)/Lambda_k^2.
      real(wp) :: tail(3), station_tail(size(stations))
      !> At the nodes: film thickness, its slope over phi, 1/g, v, r, s.
      real(wp), allocatable :: h(:), h_slope(:), per_g(:), v(:), r(:), s(:)
      !> By mode and node: a = 1 - d^2 V/12, factors f of the elimination, q.
      real(wp), allocatable :: a(:, :), f(:, :), q(:, :)
   end type modal_pad

   type, extends(film_solver_type) :: modal_film_type
      private
      type(modal_pad), allocatable :: pads(:)
   contains
      procedure :: evaluate => evaluate_all
   end type modal_film_type

contains

   !> A solver for the films of a bearing's pads with an even number of cells along the arc and at most so
   !> many modes.
   pure function new_modal_film(films, cells, modes) result(solver)
      type(pad_film_type), intent(in) :: films(:)
      integer, intent(in) :: cells, modes
      type(modal_film_type) :: solver
      integer :: i
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
      pad%d = film%arc()/n
      unit = film%axial_length/(pi*film%pad_radius())
      lambda = [((2*k - 1)/unit, k=1, most)]
      modes = count((lambda*pad%d)**2/12 <= stiffest_mode)
      pad%stiffness = (lambda(:modes)*pad%d)**2/12
      pad%c = [(8*film%axial_length/((2*k - 1)*pi)**2, k=1, modes)]
      pad%tail = 8*film%axial_length/pi**2*odd_sums*[unit, unit**2, unit**3]
      pad%station_tail = (film%axial_length/film%pad_radius())**2*(1 - stations**2)/8
      allocate (pad%at_station(modes, size(stations)))
      do k = 1, modes
         pad%tail = pad%tail - pad%c(k)/[lambda(k), lambda(k)**2, lambda(k)**3]
         pad%at_station(k, :) = -4*(-1)**k/((2*k - 1)*pi)*cos((2*k - 1)*pi/2*stations)
         pad%station_tail = pad%station_tail - pad%at_station(k, :)/lambda(k)**2
      end do
      phi = [(i*pad%d - film%trailing_angle, i=0, n)]
      allocate (pad%sine(0:n), pad%cosine(0:n), pad%weight(0:n))
      pad%sine(:) = sin(phi)
      pad%cosine(:) = cos(phi)
      pad%weight(0:n:2) = 2*pad%d/3
      pad%weight(1:n:2) = 4*pad%d/3
      pad%weight(0:n:n) = pad%d/3
      allocate (pad%h(0:n), pad%h_slope(0:n), pad%per_g(0:n), pad%v(0:n), pad%r(0:n), pad%s(0:n))
      allocate (pad%a(modes, 0:n), pad%f(modes, 0:n), pad%q(modes, 0:n))
   end subroutine init_pad

   subroutine evaluate_all(self, motion, speed, want_slopes, response)
      class(modal_film_type), intent(inout) :: self
      type(film_motion), intent(in) :: motion(:)
      real(wp), intent(in) :: speed
      logical, intent(in) :: want_slopes
      type(film_response), intent(out) :: response(:)
      integer :: i
      do i = 1, size(motion)
         associate (pad => self%pads(i))
            response(i)%min_film = pad%film%least_thickness(motion(i))
            if (.not. response(i)%min_film > 0) then
               response(i)%status = film_closed
               cycle
            end if
            self%counters%modal = self%counters%modal + 1
            call set_nodes(pad, motion(i), speed)
            call solve(size(pad%c), ubound(pad%h, 1), pad%d, pad%stiffness, pad%v, pad%s, rise(pad), pad%per_g, &
               & pad%a, pad%f, pad%q)
            call integrate(pad, response(i))
            if (want_slopes) call add_slopes(pad, speed, response(i))
         end associate
      end do
   end subroutine evaluate_all

   !> Pressure of the leading edge above ambient, Pa.
   pure real(wp) function rise(pad)
      type(modal_pad), intent(in) :: pad
      rise = pad%film%supply_pressure - pad%film%ambient_pressure
   end function rise

   !> Factors of dh/dphi (wedge) and dh/dt (squeeze) in r.
   pure function source_factors(pad, speed) result(factors)
      type(modal_pad), intent(in) :: pad
      real(wp), intent(in) :: speed
      real(wp) :: factors(2)
      associate (radius => pad%film%pad_radius())
         factors = pad%film%viscosity*radius*[-6*speed*pad%film%journal_radius, 12*radius]
      end associate
   end function source_factors

   pure subroutine set_nodes(pad, motion, speed)
      type(modal_pad), intent(inout) :: pad
      type(film_motion), intent(in) :: motion
      real(wp), intent(in) :: speed
      real(wp) :: factors(2), per_h
      integer :: i
      factors = source_factors(pad, speed)
      do i = 0, ubound(pad%h, 1)
         associate (e => motion%position, w => motion%velocity, c => pad%film%machined_clearance)
            pad%h(i) = c - e(1)*pad%sine(i) - e(2)*pad%cosine(i)
            pad%h_slope(i) = e(2)*pad%sine(i) - e(1)*pad%cosine(i)
            per_h = 1/pad%h(i)
            pad%per_g(i) = per_h*sqrt(per_h)
            ! h'' = c_m - h
            pad%v(i) = 0.75_wp*(pad%h_slope(i)*per_h)**2 + 1.5_wp*(c*per_h - 1)
            pad%r(i) = factors(1)*pad%h_slope(i) - factors(2)*(w(1)*pad%sine(i) + w(2)*pad%cosine(i))
            pad%s(i) = pad%r(i)*pad%per_g(i)
         end associate
      end do
   end subroutine set_nodes

   !> Numerov's scheme for all modes at once. With a = 1 - d^2 V/12 and w = a q it reads
   !>    w(i-1) + (10 - 12/a(i)) w(i) + w(i+1) = d^2/12 (s(i-1) + 10 s(i) + s(i+1)),
   !> and f(i) = 1/(12 - a(i) (10 + e(i-1))), e = a f, eliminates with one division a node.
   pure subroutine solve(modes, n, d, stiffness, v, s, rise, per_g, a, f, q)
      integer, intent(in) :: modes, n
      real(wp), intent(in) :: d, stiffness(modes), v(0:n), s(0:n), rise, per_g(0:n)
      real(wp), intent(out) :: a(modes, 0:n), f(modes, 0:n), q(modes, 0:n)
      real(wp) :: e(modes), y(modes), w(modes), load
      integer :: i, k
      do i = 0, n
         a(:, i) = 1 - stiffness - d**2/12*v(i)
      end do
      e = 0
      y = 0
      do i = 1, n - 1
         load = d**2/12*(s(i - 1) + 10*s(i) + s(i + 1))
         do k = 1, modes
            f(k, i) = 1/(12 - a(k, i)*(10 + e(k)))
            q(k, i) = y(k) - load
            e(k) = a(k, i)*f(k, i)
            y(k) = e(k)*q(k, i)
         end do
      end do
      q(:, 0) = 0
      q(:, n) = rise/per_g(n)
      w = a(:, n)*q(:, n)
      do i = n - 1, 1, -1
         do k = 1, modes
            q(k, i) = f(k, i)*(w(k) + q(k, i))
            w(k) = a(k, i)*q(k, i)
         end do
      end do
   end subroutine solve

   !> Force, lowest and highest pressure.
   pure subroutine integrate(pad, response)
      type(modal_pad), intent(in) :: pad
      type(film_response), intent(inout) :: response
      real(wp) :: line, force(2), narrow, p, low, high
      integer :: i, n, j
      n = ubound(pad%h, 1)
      force = 0
      low = min(0.0_wp, rise(pad))
      high = max(0.0_wp, rise(pad))
      do i = 0, n
         narrow = -pad%s(i)*pad%per_g(i)
         line = dot_product(pad%c, pad%q(:, i))*pad%per_g(i) + pad%tail(2)*narrow
         force = force - pad%weight(i)*line*[pad%sine(i), pad%cosine(i)]
         if (i == 0 .or. i == n) cycle
         do j = 1, size(stations)
            p = dot_product(pad%at_station(:, j), pad%q(:, i))*pad%per_g(i) + pad%station_tail(j)*narrow
            low = min(low, p)
            high = max(high, p)
         end do
      end do
      ! layers at the edges of the modes left out, and the supply pressure in them
      narrow = -pad%s(0)*pad%per_g(0)
      force = force + pad%tail(3)*narrow*[pad%sine(0), pad%cosine(0)]
      narrow = -pad%s(n)*pad%per_g(n)
      force = force + (pad%tail(3)*narrow - pad%tail(1)*rise(pad))*[pad%sine(n), pad%cosine(n)]
      associate (film => pad%film)
         response%force = film%pad_radius()*(force - film%ambient_pressure*film%axial_length &
            & *[cos(film%trailing_angle) - cos(film%leading_angle), sin(film%leading_angle) + sin(film%trailing_angle)])
         response%min_pressure = film%ambient_pressure + low
         response%max_pressure = film%ambient_pressure + high
      end associate
   end subroutine integrate

   !> Force derivatives by adjoints. For a force weight psi, let B m = c psi weight/g with the matrix B of
   !> the scheme; the force changes by m . (dS - dB q) and by what changes in the quadrature itself; all of
   !> it is linear in dh, dh' and dr at the nodes.
   subroutine add_slopes(pad, speed, response)
      type(modal_pad), intent(in) :: pad
      real(wp), intent(in) :: speed
      type(film_response), intent(inout) :: response
      real(wp), dimension(size(pad%c), 0:ubound(pad%h, 1)) :: adjoint, spread_adjoint
      !> Derivatives of the force over v, s, and over q/g and -r/h^3 by the quadrature.
      real(wp), dimension(0:ubound(pad%h, 1)) :: over_v, over_s, over_line, over_narrow
      real(wp), dimension(0:ubound(pad%h, 1)) :: psi, over_h, over_slope, over_r, total
      real(wp) :: factors(2), boundary
      integer :: i, m, n
      n = ubound(pad%h, 1)
      factors = source_factors(pad, speed)
      total = [(dot_product(pad%c, pad%q(:, i)), i=0, n)]
      do m = 1, 2
         psi = -pad%film%pad_radius()*pad%sine
         if (m == 2) psi = -pad%film%pad_radius()*pad%cosine
         over_line = pad%weight*psi
         call solve_adjoint(size(pad%c), n, pad%a, pad%f, pad%c, over_line*pad%per_g, adjoint)
         spread_adjoint = 10*adjoint
         spread_adjoint(:, 1:) = spread_adjoint(:, 1:) + adjoint(:, :n - 1)
         spread_adjoint(:, :n - 1) = spread_adjoint(:, :n - 1) + adjoint(:, 1:)
         over_s = pad%d**2/12*sum(spread_adjoint, dim=1)
         over_v = pad%d**2/12*sum(spread_adjoint*pad%q, dim=1)
         ! q at the leading edge is rise g(n), a(n) q(n) stands in the last equation, and q/g there is fixed
         boundary = -dot_product(adjoint(:, n - 1), pad%a(:, n))*rise(pad)/pad%per_g(n)
         over_line(n) = 0
         over_narrow = pad%tail(2)*pad%weight*psi
         over_narrow([0, n]) = over_narrow([0, n]) - pad%tail(3)*psi([0, n])
         ! v = 3/4 (h'/h)^2 + 3/2 (c_m/h - 1), s = r h^(-3/2), 1/g = h^(-3/2), narrow = -r/h^3
         over_r = over_s*pad%per_g - over_narrow*pad%per_g**2
         over_slope = over_v*1.5_wp*pad%h_slope/pad%h**2
         over_h = -over_v*1.5_wp*(pad%h_slope**2/pad%h + pad%film%machined_clearance)/pad%h**2 &
            & - 1.5_wp/pad%h*(over_s*pad%s + over_line*total*pad%per_g) + 3*over_narrow*pad%s*pad%per_g/pad%h
         over_h(n) = over_h(n) + 1.5_wp/pad%h(n)*boundary
         ! r = wedge h' + squeeze dh/dt
         over_slope = over_slope + over_r*factors(1)
         response%slope(m, 1) = -dot_product(over_h, pad%sine) - dot_product(over_slope, pad%cosine)
         response%slope(m, 2) = -dot_product(over_h, pad%cosine) + dot_product(over_slope, pad%sine)
         response%slope(m, 3) = -factors(2)*dot_product(over_r, pad%sine)
         response%slope(m, 4) = -factors(2)*dot_product(over_r, pad%cosine)
      end do
   end subroutine add_slopes

   !> The transposed scheme with the load c(k) load(i): the same elimination, as w = a q scales its columns.
   pure subroutine solve_adjoint(modes, n, a, f, c, load, adjoint)
      integer, intent(in) :: modes, n
      real(wp), intent(in) :: a(modes, 0:n), f(modes, 0:n), c(modes), load(0:n)
      real(wp), intent(out) :: adjoint(modes, 0:n)
      real(wp) :: y(modes)
      integer :: i
      adjoint(:, 0) = 0
      adjoint(:, n) = 0
      y = 0
      do i = 1, n - 1
         y = a(:, i)*f(:, i)*(y - c*load(i)/a(:, i))
         adjoint(:, i) = y
      end do
      do i = n - 2, 1, -1
         adjoint(:, i) = adjoint(:, i) + a(:, i)*f(:, i)*adjoint(:, i + 1)
      end do
   end subroutine solve_adjoint
end module modal_film
