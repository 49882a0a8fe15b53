!> The pressure field of a film from its axial modes (fourier_film), at any point of the pad.
!>
!> What the modes left out add is known in closed form: the narrow-pad limit and, where the pressure at the leading
!> edge is another than at the sides, its layer there. Summed over all modes this layer is that of a strip of even
!> thickness,
!>    W = sum_k b_k cos(lambda_k Z) exp(-Lambda_k x) = 2/pi arctan(cos(pi Z/L)/sinh(pi R x/L)),
!> x the angle from the edge. It is steeper than any grid beside the edge; so it is taken out at the nodes, where
!> the rest is smooth, and put back at the point.
module fourier_field
   use kinds, only: wp, pi
   use fourier_pad, only: fourier_pad_type
   use fourier_passes, only: simd_width
   use sommerfeld_nodes, only: span
   implicit none (type, external)
   private
   public :: field_of_modes

   !> pi R x/L beyond which nothing is left of W: exp(-50) = 2e-22.
   real(wp), parameter :: far = 50

contains

   !> Pressure, Pa, (axial position, angle), of the pad's last solution, with tension where there is any: the cubic
   !> through four nodes along the arc, the modes across.
   pure function field_of_modes(pad, phi, z) result(pressure)
      type(fourier_pad_type), intent(in) :: pad
      !> Angles from the pivot, rad, and distances from the middle plane, m, within the pad.
      real(wp), intent(in) :: phi(:), z(:)
      real(wp) :: pressure(size(z), size(phi))
      real(wp) :: position(size(z)), narrow(size(z)), smooth(size(z), 0:pad%n)
      real(wp) :: profile(simd_width*pad%axial%blocks, size(z)), amplitude(simd_width), rise, h, angle
      integer :: i, j, b
      associate (gap => pad%gap, n => pad%n)
         rise = gap%supply_pressure - gap%ambient_pressure
         position = abs(z)/(0.5_wp*gap%axial_length)
         do j = 1, size(z)
            profile(:, j) = pad%axial%profile(position(j))
            narrow(j) = pad%axial%left_out(position(j))
         end do
         smooth = 0
         do i = 0, n - 1
            angle = gap%leading_angle - atan2(pad%sine(i), pad%cosine(i))
            if (i > 0) smooth(:, i) = -narrow*pad%narrow(i)/pad%h(i)
            do b = 1, pad%axial%blocks
               associate (first => simd_width*b - simd_width + 1, last => simd_width*b)
                  amplitude = pad%q(:, i, b)/pad%h(i)
                  if (abs(rise) > 0) amplitude = amplitude - rise*even_layer(pad, i) &
                     & *exp(-sqrt(pad%axial%square(first:last))*angle)
                  do j = 1, size(z)
                     smooth(j, i) = smooth(j, i) + dot_product(amplitude, profile(first:last, j))
                  end do
               end associate
            end do
         end do
         do j = 1, size(phi)
            h = 1 - pad%e(1)*sin(phi(j)) - pad%e(2)*cos(phi(j))
            angle = node_position(pad, phi(j))
            i = min(max(int(angle) - 1, 0), n - 3)
            pressure(:, j) = gap%ambient_pressure + matmul(smooth(:, i:i + 3), cubic_weights(angle - i))
            if (abs(rise) > 0) pressure(:, j) = pressure(:, j) + rise*(pad%h(n)/h)**1.5_wp &
               & *layer(position, (gap%leading_angle - phi(j))*gap%pad_radius()/gap%axial_length)
         end do
      end associate
   end function field_of_modes

   !> What of the layer's amplitude is left at a node: it falls as h^(-3/2).
   pure real(wp) function even_layer(pad, i)
      type(fourier_pad_type), intent(in) :: pad
      integer, intent(in) :: i
      even_layer = (pad%h(pad%n)/pad%h(i))**1.5_wp
   end function even_layer

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
end module fourier_field
