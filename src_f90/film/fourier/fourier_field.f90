!> The pressure field of a film from its axial modes (fourier_film), at any point of the pad, and what a pressure at its
!> leading edge drives through its edges.
!>
!> What the modes left out add is known in closed form: the narrow-pad limit and, where the pressure at the leading
!> edge is another than at the sides, its layer there. Summed over all modes this layer is that of a strip of uniform
!> thickness,
!>    W = sum_k b_k cos(lambda_k Z) exp(-Lambda_k x) = 2/pi arctan(cos(pi Z/L)/sinh(pi R x/L)),
!> x the angle from the edge. It is steeper than any grid beside the edge; so it is taken out at the nodes, where
!> the rest is smooth, and put back at the point.
!>
!> In the corners of leading edge and side the pressure leaps, and the flow of the Reynolds equation, 2/pi over the
!> distance, has no finite sum. The equation holds for distances that are long against the film, so the corners are
!> left out up to a film thickness. Of the modes a strip of uniform thickness has sum_k c_k Lambda_k, which is then
!>    R 4/pi ln(cot(pi h/(2 L)));
!> what the film thickness ratio and the length of the arc change is a sum that converges.
module fourier_field
   use kinds, only: wp, pi
   use film_solver, only: film_law_type, film_motion
   use film_law, only: law_at_nodes
   use fourier_pad, only: fourier_pad_type
   use fourier_passes, only: simd_width
   use sommerfeld_nodes, only: span
   implicit none (type, external)
   private
   public :: field_of_modes, edge_flows, add_layer_left_out

   !> pi R x/L beyond which nothing is left of W: exp(-50) = 2e-22.
   real(wp), parameter :: far = 50
   !> The same of the first mode left out where it does not count any more: exp(-10)/order is below 1e-5.
   real(wp), parameter :: thin_layer = 10

contains

   !> Pressure, Pa, (axial position, angle), of the pad's last solution, with tension where there is any: the cubic
   !> through four nodes along the arc, the modes across.
   pure function field_of_modes(pad, motion, oil, phi, z) result(pressure)
      type(fourier_pad_type), intent(in) :: pad
      !> Of that solution.
      type(film_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      !> Angles from the pivot, rad, and distances from the middle plane, m, within the pad.
      real(wp), intent(in) :: phi(:), z(:)
      real(wp) :: pressure(size(z), size(phi))
      real(wp) :: position(size(z)), narrow(size(z)), smooth(size(z), 0:pad%n)
      real(wp) :: profile(simd_width*pad%axial%blocks, size(z)), amplitude(simd_width), rise, angle
      real(wp) :: layer_there(size(phi))
      integer :: i, j, b
      associate (gap => pad%gap, n => pad%n)
         rise = gap%supply_pressure - gap%ambient_pressure
         position = abs(z)/(0.5_wp*gap%axial_length)
         do j = 1, size(z)
            call pad%axial%across(position(j), profile(:, j), narrow(j))
         end do
         smooth = 0
         do i = 0, n - 1
            angle = from_edge(pad, atan2(pad%sine(i), pad%cosine(i)))
            if (i > 0) smooth(:, i) = -narrow*pad%narrow(i)/pad%lift(i)
            do b = 1, pad%axial%blocks
               associate (first => simd_width*b - simd_width + 1, last => simd_width*b)
                  amplitude = pad%q(:, i, b)/pad%lift(i)
                  if (abs(rise) > 0) amplitude = amplitude - rise*layer_left(pad, i) &
                     & *exp(-sqrt(pad%axial%square(first:last))*angle)
                  do j = 1, size(z)
                     smooth(j, i) = smooth(j, i) + dot_product(amplitude, profile(first:last, j))
                  end do
               end associate
            end do
         end do
         if (abs(rise) > 0) layer_there = layer_at(pad, motion, oil, rise, phi)
         do j = 1, size(phi)
            angle = node_position(pad, phi(j))
            i = min(max(int(angle) - 1, 0), n - 3)
            pressure(:, j) = gap%ambient_pressure + matmul(smooth(:, i:i + 3), cubic_weights(angle - i))
            if (abs(rise) > 0) pressure(:, j) = pressure(:, j) + layer_there(j) &
               & *layer(position, from_edge(pad, phi(j))*gap%pad_radius()/gap%axial_length)
         end do
      end associate
   end function field_of_modes

   !> What of the layer's amplitude, with this rise of the pressure, Pa, is left at angles: it falls as
   !> (h^3 E sqrt(K))^(-1/2).
   pure function layer_at(pad, motion, oil, rise, phi) result(left)
      type(fourier_pad_type), intent(in) :: pad
      type(film_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: rise, phi(:)
      real(wp) :: left(size(phi))
      type(law_at_nodes) :: there
      associate (n => pad%n)
         left = rise*(pad%h(n)/(1 - pad%e(1)*sin(phi) - pad%e(2)*cos(phi)))**1.5_wp/pad%inverse_root(n)
         if (pad%varies) then
            call oil%at_nodes(pad%gap, motion, sin(phi), cos(phi), there)
            left = left*there%inverse_root
            if (pad%by_thickness) left = left*(pad%law%across(n + 1)/there%across)**0.25_wp
         end if
      end associate
   end function layer_at

   !> The share of it that is left at a node.
   pure real(wp) function layer_left(pad, i)
      type(fourier_pad_type), intent(in) :: pad
      integer, intent(in) :: i
      layer_left = (pad%h(pad%n)/pad%h(i))**1.5_wp*pad%inverse_root(i)/pad%inverse_root(pad%n)
      if (pad%by_thickness) layer_left = layer_left*(pad%law%across(pad%n + 1)/pad%law%across(i + 1))**0.25_wp
   end function layer_left

   !> Distance of an angle from the leading edge, rad; for the decay of layers, which is Lambda sqrt(K), stretched.
   pure real(wp) function from_edge(pad, phi)
      type(fourier_pad_type), intent(in) :: pad
      real(wp), intent(in) :: phi
      from_edge = pad%gap%leading_angle - phi
      if (pad%by_thickness) from_edge = from_edge*sqrt(pad%law%across(pad%n + 1))
   end function from_edge

   !> Adds what the modes left out have of the layer at the leading edge to the pressure in the middle plane at the
   !> nodes, where its highest value lies in that layer. They are an alternating sum of which each term is the one
   !> before times q, but for a factor (2k-1)/(2k+1), here to first order in 1/k.
   pure subroutine add_layer_left_out(pad, rise, pressure)
      type(fourier_pad_type), intent(in) :: pad
      !> Pressure at the leading edge above ambient; pressures above ambient, Pa.
      real(wp), intent(in) :: rise
      real(wp), intent(inout) :: pressure(0:)
      real(wp) :: x, q
      integer :: i
      associate (n => pad%n, order => 2*pad%axial%modes + 1)
         if (order*in_layers(maxloc(pressure, 1) - 1) > thin_layer) return
         do i = n - 1, 1, -1
            x = in_layers(i)
            if (order*x > thin_layer) exit
            q = exp(-2*x)
            pressure(i) = pressure(i) + rise*layer_left(pad, i)*4/(pi*order)*(-1)**pad%axial%modes*exp(-order*x) &
               & /(1 + q)*(1 + 2*q/(order*(1 + q)))
         end do
      end associate
   contains
      !> Distance of a node from the leading edge, over that in which the first mode falls to 1/e.
      pure real(wp) function in_layers(i)
         integer, intent(in) :: i
         in_layers = pad%axial%first*from_edge(pad, atan2(pad%sine(i), pad%cosine(i)))
      end function in_layers
   end subroutine add_layer_left_out

   !> Where an angle lies between the nodes, in steps from the trailing edge.
   pure real(wp) function node_position(pad, phi)
      type(fourier_pad_type), intent(in) :: pad
      real(wp), intent(in) :: phi
      real(wp) :: from_edge, middle
      from_edge = phi + pad%gap%trailing_angle
      middle = 0.5_wp*(phi - pad%gap%trailing_angle)
      node_position = 0
      if (from_edge > 0) node_position = span(pad%e, [sin(middle), cos(middle)], &
         & [sin(0.5_wp*from_edge), cos(0.5_wp*from_edge)])/pad%d
   end function node_position

   !> W at Z over half the width and at a distance from the leading edge over the width.
   elemental real(wp) function layer(position, distance)
      real(wp), intent(in) :: position, distance
      layer = 2/pi*atan2(cos(pi/2*position), sinh(min(far, pi*max(0.0_wp, distance))))
   end function layer

   !> Weights of the values at 0, 1, 2, 3 in their cubic at t.
   pure function cubic_weights(t) result(weights)
      real(wp), intent(in) :: t
      real(wp) :: weights(4)
      weights = [(1 - t)*(t - 2)*(t - 3)/6, t*(t - 2)*(t - 3)/2, t*(1 - t)*(t - 3)/2, t*(t - 1)*(t - 2)/6]
   end function cubic_weights

   !> Flows in at the leading and out at the trailing edge, m^3/s, of the pad's last solution, with this oil, whose law
   !> does not vary, which a pressure of 1 Pa at the leading edge alone has driven.
   pure function edge_flows(pad, oil) result(flows)
      type(fourier_pad_type), intent(in) :: pad
      class(film_law_type), intent(in) :: oil
      real(wp) :: flows(2)
      !> Of a layer at the edge, and of q over the pressure, with the thickness.
      real(wp) :: falling, steeper, leading(simd_width), trailing(simd_width)
      integer :: b
      associate (n => pad%n, h => pad%h, gap => pad%gap)
         ! how fast a layer falls as the film becomes thicker
         falling = 1.5_wp*(pad%e(2)*pad%sine(n) - pad%e(1)*pad%cosine(n))/h(n)
         steeper = falling/1.5_wp
         ! a film half as thick as long has no layer at its edge
         flows(1) = pad%radius*4/pi &
            & *log(1/tan(min(pi/4, pi*h(n)*gap%machined_clearance/(2*gap%axial_length)))) - gap%axial_length*falling
         flows(2) = 0
         do b = 1, pad%axial%blocks
            leading = slope(pad%q(:, n, b), pad%q(:, n - 1, b), pad%q(:, n - 2, b), pad%a(:, n, b), &
               & pad%a(:, n - 1, b), pad%a(:, n - 2, b))/(h(n)*pad%lift(n)) - steeper
            ! q = 0 at the edge itself
            trailing = -slope(pad%q(:, 0, b), pad%q(:, 1, b), pad%q(:, 2, b), pad%a(:, 1, b), pad%a(:, 1, b), &
               & pad%a(:, 2, b))/(h(0)*pad%lift(0))
            associate (c => pad%axial%c(simd_width*b - simd_width + 1:simd_width*b), &
               & even => sqrt(pad%axial%square(simd_width*b - simd_width + 1:simd_width*b)))
               flows(1) = flows(1) + sum(c*(leading - even + falling))
               flows(2) = flows(2) + sum(c*trailing)
            end associate
         end do
         flows = flows*[h(n), h(0)]**3*gap%machined_clearance**3/(12*oil%viscosity*pad%radius)
      end associate

   contains

      !> Derivative of q outward at an edge, from there inwards the nodes 0, 1, 2, by q'' = V q, a = 1 - d^2 V/12.
      elemental real(wp) function slope(q_0, q_1, q_2, a_0, a_1, a_2)
         real(wp), intent(in) :: q_0, q_1, q_2, a_0, a_1, a_2
         slope = (q_0 - q_1 + (7*(1 - a_0)*q_0 + 6*(1 - a_1)*q_1 - (1 - a_2)*q_2)/2)/pad%d
      end function slope
   end function edge_flows
end module fourier_field
