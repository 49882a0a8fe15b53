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
   use kinds, only: wp
   use film_solver, only: film_solver_type, film_motion, film_response, film_closed
   use pad_gap, only: pad_gap_type
   use clipped_quadrature, only: clipped_weights
   use modal_field, only: field_of_modes
   use modal_pad, only: modal_pad_type, init_pad, set_weights, gauss, middle, point_weights
   use modal_sweeps, only: lanes, weigh_nodes, solve_modes, solve_adjoints, sum_modes, &
      & sum_adjoint, lowest_pressure
   implicit none (type, external)
   private
   public :: modal_film_type, new_modal_film

   type, extends(film_solver_type) :: modal_film_type
      private
      !> Guembel's condition: as the solver was made; in force.
      logical :: made_gumbel = .false., gumbel = .false.
      type(modal_pad_type), allocatable :: pads(:)
   contains
      procedure :: ruptures
      procedure :: set_rupture
      procedure :: evaluate => evaluate_all
      procedure :: field => field_all
   end type modal_film_type

contains

   !> A solver for the films of a bearing's pads with an even number of cells along the arc and at most so
   !> many modes; with Guembel's condition or none.
   pure function new_modal_film(gaps, cells, modes, gumbel) result(solver)
      type(pad_gap_type), intent(in) :: gaps(:)
      integer, intent(in) :: cells, modes
      logical, intent(in) :: gumbel
      type(modal_film_type) :: solver
      integer :: i
      solver%made_gumbel = gumbel
      solver%gumbel = gumbel
      allocate (solver%pads(size(gaps)))
      do i = 1, size(gaps)
         call init_pad(solver%pads(i), gaps(i), cells, modes)
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
            response(i)%min_film_thickness = pad%gap%min_film_thickness(motion(i), pad%directions)
            if (.not. response(i)%min_film_thickness > 0) then
               response(i)%status = film_closed
               cycle
            end if
            self%counters%modal = self%counters%modal + 1
            rise = pad%gap%supply_pressure - pad%gap%ambient_pressure
            call set_nodes(pad%n, pad%gap%machined_clearance, motion(i), source_factors(pad, speed), pad%sine, &
               & pad%cosine, pad%h, pad%h_slope, pad%per_g, pad%v, pad%r, pad%s)
            do b = 1, pad%blocks
               call solve_modes(pad%n, pad%d, pad%stiffness(lanes*b - lanes + 1:lanes*b), pad%v, pad%s, &
                  & rise/pad%per_g(pad%n), pad%a(:, :, b), pad%f(:, :, b), pad%q(:, :, b))
            end do
            call sum_up(pad, rise, response(i))
            clip = self%gumbel .and. response(i)%min_pressure < pad%gap%cavitation_pressure
            if (pad%shares_are_stale .and. want_derivatives) call whole_shares(pad)
            if (clip) call rupture(pad, rise, want_derivatives, response(i))
            if (want_derivatives) call add_derivatives(pad, rise, source_factors(pad, speed), response(i))
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
            pressure(:, :, i) = field_of_modes(pad%gap, motion(i), pad%modes, pad%per_g, pad%s, pad%q, phi(:, i), z)
            if (self%gumbel) pressure(:, :, i) = max(pressure(:, :, i), pad%gap%cavitation_pressure)
         end associate
      end do
   end subroutine field_all

   !> Factors of dh/dphi (wedge) and dh/dt (squeeze) in r.
   pure function source_factors(pad, speed) result(factors)
      type(modal_pad_type), intent(in) :: pad
      real(wp), intent(in) :: speed
      real(wp) :: factors(2)
      factors = pad%gap%viscosity*pad%radius*[-6*speed*pad%gap%journal_radius, 12*pad%radius]
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

   !> Force of the whole film, minimum and maximum pressure.
   pure subroutine sum_up(pad, rise, response)
      type(modal_pad_type), intent(in) :: pad
      real(wp), intent(in) :: rise
      type(film_response), intent(inout) :: response
      real(wp), dimension(0:pad%n) :: along, outward, p_middle
      real(wp) :: force(2), edge(0:1), lowest, highest
      integer :: i, b
      associate (gap => pad%gap, n => pad%n, s => pad%s, per_g => pad%per_g, sine => pad%sine, cosine => pad%cosine)
         call weigh_nodes(n, pad%along, pad%outward, per_g, s, pad%tail(2), pad%point_tail(middle), &
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
            & + gap%ambient_pressure*gap%axial_length*(cosine(0) - cosine(n))
         force(2) = force(2) + edge(0)*cosine(0) + edge(1)*cosine(n) &
            & + gap%ambient_pressure*gap%axial_length*(sine(n) - sine(0))
         response%force = -pad%radius*force
         lowest = min(0.0_wp, rise, lowest_pressure(n, pad%blocks, s, per_g, pad%point_tail(gauss + 1:), pad%look, &
            & pad%q))
         highest = max(0.0_wp, rise)
         do i = 1, n - 1
            highest = max(highest, per_g(i)*p_middle(i))
         end do
         response%min_pressure = gap%ambient_pressure + lowest
         response%max_pressure = gap%ambient_pressure + highest
      end associate
   end subroutine sum_up

   !> Takes what lies below the cavitation pressure out of the force and, if wanted, its share of the width out
   !> of the shares.
   pure subroutine rupture(pad, rise, want_shares, response)
      type(modal_pad_type), intent(inout) :: pad
      real(wp), intent(in) :: rise
      logical, intent(in) :: want_shares
      type(film_response), intent(inout) :: response
      !> Cavitation pressure less pressure, and weights of what is missing, by point and node.
      real(wp), dimension(gauss, 0:pad%n) :: deficit, lost
      real(wp) :: floor, missing, p(gauss), weights(0:pad%n)
      integer :: i, b, k, l, point
      associate (n => pad%n)
         floor = pad%gap%cavitation_pressure - pad%gap%ambient_pressure
         deficit(:, 0) = floor
         deficit(:, n) = floor - rise
         do i = 1, n - 1
            p = -pad%point_tail(:gauss)*pad%s(i)
            do b = 1, pad%blocks
               do k = 1, lanes
                  p = p + pad%across(:, lanes*(b - 1) + k)*pad%q(k, i, b)
               end do
            end do
            deficit(:, i) = floor - p*pad%per_g(i)
         end do
         do point = 1, gauss
            call clipped_weights(n, deficit(point, :), weights)
            lost(point, :) = (pad%d*point_weights(point)*pad%gap%axial_length)*weights
         end do
         do i = 0, n
            missing = pad%radius*dot_product(lost(:, i), deficit(:, i))
            response%force = response%force - missing*[pad%sine(i), pad%cosine(i)]
         end do
         response%max_pressure = max(response%max_pressure, pad%gap%cavitation_pressure)
         if (.not. want_shares) return
         pad%shares_are_stale = .true.
         do i = 0, n
            lost(:, i) = lost(:, i)/pad%weight(i)
            pad%narrow_share(i) = pad%narrow_share(i) - dot_product(lost(:, i), pad%point_tail(:gauss))
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
      type(modal_pad_type), intent(inout) :: pad
      integer :: b
      do b = 1, pad%blocks
         pad%share(:, :, b) = spread(pad%c(lanes*b - lanes + 1:lanes*b), 2, pad%n + 1)
      end do
      pad%narrow_share = pad%tail(2)
      pad%shares_are_stale = .false.
   end subroutine whole_shares

   !> Force derivatives by adjoints. For a force weight psi, let B m = -share psi weight/g with the matrix B
   !> of the scheme; the force changes by m . (dS - dB q) and by what changes in the quadrature itself; all
   !> of it is linear in dh, dh' and dr at the nodes.
   pure subroutine add_derivatives(pad, rise, factors, response)
      type(modal_pad_type), intent(inout) :: pad
      real(wp), intent(in) :: rise, factors(2)
      type(film_response), intent(inout) :: response
      real(wp) :: adjoint(lanes, 0:pad%n, 2)
      real(wp), dimension(0:pad%n, 2) :: over_line, load, over_s, over_v
      real(wp) :: boundary(2), total, over_narrow, over_h, over_slope, over_r, per_h
      integer :: i, m, b
      associate (n => pad%n, sine => pad%sine, cosine => pad%cosine, per_g => pad%per_g)
         ! derivatives of the force over q/g, v and s at the nodes
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
         response%derivatives = 0
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
               ! derivative over -r/h^3
               over_narrow = pad%narrow_share(i)*over_line(i, m)
               if (i == 0 .or. i == n) over_narrow = over_narrow &
                  & + pad%tail(3)*pad%radius*merge(sine(i), cosine(i), m == 1)
               ! v = 3/4 (h'/h)^2 + 3/2 (c_m/h - 1), s = r h^(-3/2), 1/g = h^(-3/2), r = wedge h' + squeeze dh/dt
               over_r = over_s(i, m)*per_g(i) - over_narrow*per_g(i)**2
               over_slope = over_v(i, m)*1.5_wp*pad%h_slope(i)*per_h**2 + over_r*factors(1)
               over_h = -over_v(i, m)*1.5_wp*(pad%h_slope(i)**2*per_h + pad%gap%machined_clearance)*per_h**2 &
                  & - 1.5_wp*per_h*(over_s(i, m)*pad%s(i) + over_line(i, m)*total*per_g(i)) &
                  & + 3*over_narrow*pad%s(i)*per_g(i)*per_h
               if (i == n) over_h = over_h + 1.5_wp*per_h*boundary(m)
               response%derivatives(m, 1) = response%derivatives(m, 1) - over_h*sine(i) - over_slope*cosine(i)
               response%derivatives(m, 2) = response%derivatives(m, 2) - over_h*cosine(i) + over_slope*sine(i)
               response%derivatives(m, 3) = response%derivatives(m, 3) - factors(2)*over_r*sine(i)
               response%derivatives(m, 4) = response%derivatives(m, 4) - factors(2)*over_r*cosine(i)
            end do
         end do
      end associate
   end subroutine add_derivatives
end module modal_film
