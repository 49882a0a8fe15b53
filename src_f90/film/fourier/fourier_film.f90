!> Film by axial modes: exact in the axial direction wherever nothing cavitates (docs/theory/film.md).
!>
!> With the pressure above ambient as sum_k b_k u_k(phi) cos(lambda_k Z), lambda_k = (2k-1) pi/L and
!> b_k = -4 (-1)^k/((2k-1) pi), the Reynolds equation (times R^2) separates into
!>    (h^3 u')' - Lambda_k^2 h^3 u = r,   Lambda_k = R lambda_k,   u = p_sup - p_amb at the leading edge, 0
!> at the trailing one. Over Sommerfeld's variable xi, dphi = H dxi with H = h/c_m, and with q = H u it becomes
!>    q'' = (Lambda_k^2 H^2 + v) q + s,   v = |e|^2 - 1 + 3 H - 2 H^2,   s = r/c_m^3,   e the eccentricity over c_m,
!> smooth for a film of any film thickness ratio, and Numerov's scheme solves it to fourth order (fourier_passes). The
!> modes left out are summed in closed form: the narrow-pad limit u = -r/(h^3 Lambda^2) and its edge layers.
!>
!> Where the film's law varies (film_law), with a prime for d/dphi along the film, q = H sqrt(E) u, s gains 1/sqrt(E)
!> and what G does to the wedge, v gains 3/2 H H' (ln E)' + H^2 ((ln E)''/2 + (ln E)'^2/4), and Lambda^2 the factor K.
!>
!> Guembel's condition needs the field: it is rebuilt at Gauss points across the half width, and what lies
!> below the cavitation pressure is taken out of the force.
module fourier_film
   use kinds, only: wp
   use film_solver, only: film_solver_type, film_motion, film_law_type, film_response, cavitation_none, &
      & cavitation_gumbel
   use pad_gap, only: pad_gap_type, first_like
   use clipped_quadrature, only: clipped_weights
   use film_resolution, only: resolution_type, new_resolution, most_levels, enough_cells, enough_modes
   use fourier_field, only: field_of_modes, edge_flows, add_layer_left_out
   use fourier_pad, only: fourier_pad_type, set_weights, set_motion, gauss, middle, point_weights
   use fourier_slopes, only: force_slopes
   use fourier_passes, only: simd_width, weigh_nodes, solve_modes, sum_modes, lowest_pressure
   use sommerfeld_nodes, only: span
   implicit none (type, external)
   private
   public :: fourier_film_type, new_fourier_film, converged_film

   type, extends(film_solver_type) :: fourier_film_type
      private
      type(resolution_type), allocatable :: resolutions(:)
      !> Every pad at every resolution that a film has asked for, (level, pad); the level of the last film; the first
      !> pad with the same gap, whose nodes and modes serve both.
      type(fourier_pad_type), allocatable :: pads(:, :)
      integer, allocatable :: level(:), like(:)
   contains
      procedure :: solve
      procedure :: field_of_pad
      procedure :: supply_flows
   end type fourier_film_type

contains

   !> A solver for the films of a bearing's pads with an even number of cells along the arc and at most this number of
   !> modes, with Guembel's condition or none. With a tolerance of the force (over itself, or over a tenth of the
   !> highest pressure on the whole pad) these serve ordinary films, and others get as many as they need.
   pure function new_fourier_film(gaps, cells, modes, gumbel, tolerance) result(solver)
      type(pad_gap_type), intent(in) :: gaps(:)
      integer, intent(in) :: cells, modes
      logical, intent(in) :: gumbel
      real(wp), intent(in), optional :: tolerance
      type(fourier_film_type) :: solver
      integer :: i
      call solver%set_gaps(gaps, merge(cavitation_gumbel, cavitation_none, gumbel))
      allocate (solver%resolutions(size(gaps)), solver%pads(most_levels, size(gaps)), solver%level(size(gaps)), &
         & solver%like(size(gaps)))
      do i = 1, size(gaps)
         solver%like(i) = first_like(gaps, i)
         solver%resolutions(i) = new_resolution(gaps(i), cells, modes, tolerance)
      end do
   end function new_fourier_film

   !> A solver for one pad's films, with Guembel's condition or none, to a tolerance as above.
   pure type(fourier_film_type) function converged_film(gap, gumbel, tolerance) result(film)
      type(pad_gap_type), intent(in) :: gap
      logical, intent(in) :: gumbel
      real(wp), intent(in) :: tolerance
      film = new_fourier_film([gap], enough_cells([gap]), enough_modes([gap]), gumbel, tolerance)
   end function converged_film

   subroutine solve(self, i, motion, oil, speed, want_derivatives, response)
      class(fourier_film_type), intent(inout) :: self
      integer, intent(in) :: i
      type(film_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: speed
      logical, intent(in) :: want_derivatives
      type(film_response), intent(inout) :: response
      real(wp) :: along
      logical :: clips
      self%counters%fourier = self%counters%fourier + 1
      clips = self%condition == cavitation_gumbel
      associate (gap => self%gaps(i), level => self%level(i), directions => self%directions(i), &
         & e => motion%position/self%gaps(i)%machined_clearance)
         along = span(e, directions%middle, directions%half)
         level = self%resolutions(i)%level(gap, directions, e, along)
         associate (pad => self%pads(level, self%like(i)))
            if (pad%n == 0) call self%resolutions(i)%make_pad(gap, level, pad)
            if (pad%clipped .neqv. clips) call set_weights(pad, clips)
            call set_motion(pad, motion, oil, speed, along)
            call solve_pad(pad, clips, want_derivatives, response)
         end associate
      end associate
   end subroutine solve

   !> The film of a pad that has been set to a motion.
   pure subroutine solve_pad(pad, clips, want_derivatives, response)
      type(fourier_pad_type), intent(inout) :: pad
      logical, intent(in) :: clips, want_derivatives
      type(film_response), intent(inout) :: response
      real(wp) :: rise
      integer :: b
      rise = pad%gap%supply_pressure - pad%gap%ambient_pressure
      do b = 1, pad%axial%blocks
         call solve_modes(pad%n, pad%axial%square(simd_width*b - simd_width + 1:simd_width*b), pad%base, pad%rate, &
            & pad%load, rise*pad%lift(pad%n), pad%a(:, :, b), pad%f(:, :, b), pad%q(:, :, b))
      end do
      call sum_up(pad, rise, response)
      if (pad%shares_are_stale .and. want_derivatives) call whole_shares(pad)
      if (clips .and. response%min_pressure < pad%gap%cavitation_pressure) then
         call cavitation(pad, rise, want_derivatives, response)
      end if
      if (want_derivatives) call force_slopes(pad, rise, response%derivatives)
   end subroutine solve_pad

   subroutine field_of_pad(self, i, motion, oil, speed, phi, z, pressure)
      class(fourier_film_type), intent(inout) :: self
      integer, intent(in) :: i
      type(film_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: speed, phi(:), z(:)
      real(wp), intent(out) :: pressure(:, :)
      type(film_response) :: response
      call self%evaluate_pad(i, motion, oil, speed, .false., response)
      pressure = field_of_modes(self%pads(self%level(i), self%like(i)), motion, oil, phi, z)
      if (self%condition == cavitation_gumbel) pressure = max(pressure, self%gaps(i)%cavitation_pressure)
   end subroutine field_of_pad

   !> Flows in at the leading and out at the trailing edge of the first pad, m^3/s, in its last film, with this oil,
   !> which a pressure of 1 Pa at the leading edge alone has driven.
   pure function supply_flows(self, oil)
      class(fourier_film_type), intent(in) :: self
      class(film_law_type), intent(in) :: oil
      real(wp) :: supply_flows(2)
      supply_flows = edge_flows(self%pads(self%level(1), 1), oil)
   end function supply_flows

   !> Force of the full film, minimum and maximum pressure.
   pure subroutine sum_up(pad, rise, response)
      type(fourier_pad_type), intent(in) :: pad
      real(wp), intent(in) :: rise
      type(film_response), intent(inout) :: response
      real(wp), dimension(0:pad%n) :: along, outward, p_middle
      real(wp) :: force(2), edge(0:1), lowest, slope
      integer :: b
      associate (gap => pad%gap, n => pad%n, h => pad%h, tail => pad%axial%tail, sine => pad%sine, cosine => pad%cosine)
         call weigh_nodes(n, pad%weight, pad%inverse_root, sine, cosine, pad%narrow, tail(2), pad%point_tail(middle), &
            & along, outward, force, p_middle)
         do b = 1, pad%axial%blocks
            associate (first => simd_width*b - simd_width + 1, last => simd_width*b)
               call sum_modes(n, along, outward, pad%axial%c(first:last), pad%at_middle(first:last), pad%q(:, :, b), &
                  & force, p_middle)
            end associate
         end do
         ! layers at the edges of the modes left out, and the supply pressure in them
         slope = pad%e(2)*sine(n) - pad%e(1)*cosine(n)
         edge = tail(3)*[pad%narrow(0)/h(0), pad%narrow(n)/h(n)]*[pad%inverse_root(0), pad%inverse_root(n)]
         edge(1) = edge(1) + rise*(tail(1) + tail(2)*1.5_wp*slope/h(n))
         if (pad%varies) edge(1) = edge(1) + rise*tail(2)*pad%law%flow_slopes(n + 1, 1)/2
         force = pad%d*force + edge(0)*[sine(0), cosine(0)] + edge(1)*[sine(n), cosine(n)] &
            & - tail(2)*rise*[cosine(n), -sine(n)] &
            & + gap%ambient_pressure*gap%axial_length*[cosine(0) - cosine(n), sine(n) - sine(0)]
         if (pad%by_thickness) force = force + turned_layers(pad, rise)
         response%force = -pad%radius*force
         lowest = lowest_pressure(n, pad%axial%blocks, pad%narrow, pad%lift, pad%point_tail(gauss + 1:), pad%look, &
            & pad%q)
         response%min_pressure = gap%ambient_pressure + min(0.0_wp, rise, lowest)
         p_middle = p_middle/pad%lift
         p_middle(0) = 0
         p_middle(n) = rise
         if (abs(rise) > 0) call add_layer_left_out(pad, rise, p_middle)
         response%max_pressure = gap%ambient_pressure + peak(n, p_middle)
      end associate
   end subroutine sum_up

   !> What K changes in the layers at the edges of the modes left out, which decay with Lambda sqrt(K).
   pure function turned_layers(pad, rise) result(change)
      type(fourier_pad_type), intent(in) :: pad
      real(wp), intent(in) :: rise
      real(wp) :: change(2), edge(0:1), by_root, falling
      associate (n => pad%n, h => pad%h, tail => pad%axial%tail, law => pad%law, across => pad%law%across(pad%n + 1), &
         & x => [pad%sine(pad%n), pad%cosine(pad%n)])
         by_root = 1/sqrt(across)
         edge = tail(3)*[pad%narrow(0)*pad%inverse_root(0)/h(0)*(1/sqrt(law%across(1)) - 1), &
            & pad%narrow(n)*pad%inverse_root(n)/h(n)*(by_root - 1)]
         falling = 1.5_wp*(pad%e(2)*x(1) - pad%e(1)*x(2))/h(n) + law%flow_slopes(n + 1, 1)/2
         edge(1) = edge(1) + rise*(tail(1)*(by_root - 1) + tail(2)*((1/across - 1)*falling &
            & + 0.75_wp*law%across_slope(n + 1)/across))
         change = edge(0)*[pad%sine(0), pad%cosine(0)] + edge(1)*x - tail(2)*rise*(1/across - 1)*[x(2), -x(1)]
      end associate
   end function turned_layers

   !> Highest value of a function given at nodes 0:n, n >= 4: that of the quartic through the five nodes around the
   !> highest, found by Newton's method from the top of the parabola through three. Beside an edge that is higher than
   !> the nodes there may be a higher place.
   pure real(wp) function peak(n, p)
      integer, intent(in) :: n
      real(wp), intent(in) :: p(0:n)
      real(wp) :: c(4), t, bend
      integer :: i, j, k
      i = 0
      do j = 1, n
         if (p(j) > p(i)) i = j
      end do
      peak = p(i)
      j = min(max(i, 2), n - 2)
      associate (odd => (p(j + 1:j + 2) - p(j - 1:j - 2:-1))/2, even => (p(j + 1:j + 2) + p(j - 1:j - 2:-1))/2)
         ! p(j) + c1 t + c2 t^2 + c3 t^3 + c4 t^4
         c(3) = (odd(2) - 2*odd(1))/6
         c(1) = odd(1) - c(3)
         c(4) = (even(2) - 4*even(1) + 3*p(j))/12
         c(2) = even(1) - p(j) - c(4)
      end associate
      i = min(max(i, 1), n - 1)
      bend = p(i + 1) - 2*p(i) + p(i - 1)
      if (.not. bend < 0) return
      t = i - j - 0.5_wp*(p(i + 1) - p(i - 1))/bend
      do k = 1, 2
         bend = 2*c(2) + t*(6*c(3) + t*12*c(4))
         if (bend < 0) t = t - (c(1) + t*(2*c(2) + t*(3*c(3) + t*4*c(4))))/bend
         t = min(max(t, i - j - 1.0_wp), i - j + 1.0_wp)
      end do
      peak = max(peak, p(j) + t*(c(1) + t*(c(2) + t*(c(3) + t*c(4)))))
   end function peak

   !> Takes what lies below the cavitation pressure out of the force and, if wanted, its share of the width out
   !> of the shares.
   pure subroutine cavitation(pad, rise, want_shares, response)
      type(fourier_pad_type), intent(inout) :: pad
      real(wp), intent(in) :: rise
      logical, intent(in) :: want_shares
      type(film_response), intent(inout) :: response
      !> Cavitation pressure less pressure, as q, and weights of what is missing, by point and node.
      real(wp), dimension(gauss, 0:pad%n) :: deficit, lost
      real(wp) :: floor, missing, weights(0:pad%n)
      integer :: i, b, k, l, point
      associate (n => pad%n)
         floor = pad%gap%cavitation_pressure - pad%gap%ambient_pressure
         call find_deficits(pad, rise, floor, deficit)
         do point = 1, gauss
            call clipped_weights(n, deficit(point, :), weights)
            lost(point, :) = (pad%d*point_weights(point)*pad%gap%axial_length)*weights
         end do
         do i = 0, n
            missing = pad%radius*dot_product(lost(:, i), deficit(:, i))*pad%inverse_root(i)
            response%force = response%force - missing*[pad%sine(i), pad%cosine(i)]
         end do
         response%max_pressure = max(response%max_pressure, pad%gap%cavitation_pressure)
         if (.not. want_shares) return
         pad%shares_are_stale = .true.
         do i = 0, n
            if (.not. any(abs(lost(:, i)) > 0)) cycle
            lost(:, i) = lost(:, i)/(pad%d*pad%weight(i))
            pad%floor_share(i) = sum(lost(:, i))*floor
            pad%narrow_share(i) = pad%narrow_share(i) - dot_product(lost(:, i), pad%point_tail(:gauss))
            do b = 1, pad%axial%blocks
               do k = 1, simd_width
                  l = simd_width*(b - 1) + k
                  pad%share(k, i, b) = pad%share(k, i, b) - dot_product(lost(:, i), pad%across(:, l))
               end do
            end do
         end do
      end associate
   end subroutine cavitation

   !> Cavitation pressure, `floor` above ambient, less pressure, as q, at Gauss's points by node. What lies below the
   !> cavitation pressure is lowest where s > 0, and reaches from there to other nodes; those that are farther than the
   !> two that weights follow from (clipped_weights) get some number below 0.
   pure subroutine find_deficits(pad, rise, floor, deficit)
      type(fourier_pad_type), intent(in) :: pad
      real(wp), intent(in) :: rise, floor
      real(wp), intent(out) :: deficit(gauss, 0:pad%n)
      integer :: i, last
      deficit = -1
      deficit(:, 0) = floor*pad%lift(0)
      deficit(:, pad%n) = (floor - rise)*pad%lift(pad%n)
      last = -pad%n
      do i = 1, pad%n - 1
         if (pad%narrow(i) > 0 .or. i <= last + 2) deficit(:, i) = deficit_at(i)
         if (any(deficit(:, i) > 0)) last = i
      end do
      last = 2*pad%n
      do i = pad%n - 1, 1, -1
         if (.not. pad%narrow(i) > 0 .and. i >= last - 2) deficit(:, i) = deficit_at(i)
         if (any(deficit(:, i) > 0)) last = i
      end do
   contains
      pure function deficit_at(i)
         integer, intent(in) :: i
         real(wp) :: deficit_at(gauss), p(gauss)
         integer :: b, k
         p = -pad%point_tail(:gauss)*pad%narrow(i)
         do b = 1, pad%axial%blocks
            do k = 1, simd_width
               p = p + pad%across(:, simd_width*(b - 1) + k)*pad%q(k, i, b)
            end do
         end do
         deficit_at = floor*pad%lift(i) - p
      end function deficit_at
   end subroutine find_deficits

   !> The shares of a film without cavitation.
   pure subroutine whole_shares(pad)
      type(fourier_pad_type), intent(inout) :: pad
      integer :: b
      do b = 1, pad%axial%blocks
         pad%share(:, :, b) = spread(pad%axial%c(simd_width*b - simd_width + 1:simd_width*b), 2, pad%n + 1)
      end do
      pad%narrow_share = pad%axial%tail(2)
      pad%floor_share = 0
      pad%shares_are_stale = .false.
   end subroutine whole_shares
end module fourier_film
