!> The pressure field of a film from its axial modes (modal_film), at any point of the pad.
!>
!> What the modes left out add is known in closed form: the narrow-pad limit and, where the pressure at the leading
!> edge is another than at the sides, its layer there. Summed over all modes this layer is that of a strip of even
!> thickness,
!>    W = sum_k b_k cos(lambda_k Z) exp(-Lambda_k x) = 2/pi arctan(cos(pi Z/L)/sinh(pi R x/L)),
!> x the angle from the edge. It is steeper than any grid beside the edge; so it is taken out at the nodes, where
!> the rest is smooth, and put back at the point.
module modal_field
   use kinds, only: wp, pi
   use film_solver, only: film_motion
   use pad_gap, only: pad_gap_type
   implicit none (type, external)
   private
   public :: axial_profile, left_out, field_of_modes

   !> pi R x/L beyond which nothing is left of W: exp(-50) = 2e-22.
   real(wp), parameter :: far = 50

contains

   !> b_k cos(lambda_k Z) of mode k = 1, 2, ..., at Z over half the width.
   elemental real(wp) function axial_profile(k, position)
      integer, intent(in) :: k
      real(wp), intent(in) :: position
      axial_profile = -4*(-1)**k/((2*k - 1)*pi)*cos((2*k - 1)*pi/2*position)
   end function axial_profile

   !> Sum of b_k cos(lambda_k Z)/Lambda_k^2 over the modes beyond the first so many, at Z over half the width.
   elemental real(wp) function left_out(gap, modes, position)
      type(pad_gap_type), intent(in) :: gap
      integer, intent(in) :: modes
      real(wp), intent(in) :: position
      real(wp) :: unit
      integer :: k
      unit = gap%axial_length/(pi*gap%pad_radius())
      left_out = (gap%axial_length/gap%pad_radius())**2*(1 - position**2)/8
      do k = 1, modes
         left_out = left_out - axial_profile(k, position)/((2*k - 1)/unit)**2
      end do
   end function left_out

   !> Pressure, Pa, (axial position, angle), with tension where there is any: the cubic through four nodes along
   !> the arc, the modes across.
   pure function field_of_modes(gap, motion, modes, per_g, s, q, phi, z) result(pressure)
      type(pad_gap_type), intent(in) :: gap
      type(film_motion), intent(in) :: motion
      !> How many modes there are; further lanes of q idle.
      integer, intent(in) :: modes
      !> 1/g and s by node, q by lane, node and block (modal_film); nodes from the trailing to the leading edge.
      real(wp), intent(in) :: per_g(0:), s(0:), q(:, 0:, :)
      !> Angles from the pivot, rad, and distances from the middle plane, m, within the pad.
      real(wp), intent(in) :: phi(:), z(:)
      real(wp) :: pressure(size(z), size(phi))
      real(wp) :: position(size(z)), profile(size(z), modes), narrow(size(z)), smooth(size(z), 0:ubound(s, 1))
      real(wp) :: d, rise, g_edge, g, x
      integer :: i, j, k, lanes, n
      n = ubound(s, 1)
      lanes = size(q, 1)
      d = gap%arc()/n
      rise = gap%supply_pressure - gap%ambient_pressure
      g_edge = 1/per_g(n)
      position = abs(z)/(0.5_wp*gap%axial_length)
      narrow = left_out(gap, modes, position)
      do k = 1, modes
         profile(:, k) = axial_profile(k, position)
      end do
      smooth(:, 0) = 0
      do i = 1, n - 1
         smooth(:, i) = -narrow*s(i)*per_g(i)
      end do
      smooth(:, n) = 0
      do i = 0, n - 1
         x = (n - i)*d
         do k = 1, modes
            associate (decay => exp(-(2*k - 1)*pi*gap%pad_radius()/gap%axial_length*x), &
               & solved => q(mod(k - 1, lanes) + 1, i, (k - 1)/lanes + 1))
               smooth(:, i) = smooth(:, i) + profile(:, k)*per_g(i)*(solved - rise*g_edge*decay)
            end associate
         end do
      end do
      do j = 1, size(phi)
         x = (phi(j) + gap%trailing_angle)/d
         i = min(max(int(x) - 1, 0), n - 3)
         g = gap%thickness(motion, sin(phi(j)), cos(phi(j)))**1.5_wp
         pressure(:, j) = gap%ambient_pressure + matmul(smooth(:, i:i + 3), cubic_weights(x - i)) &
            & + rise*g_edge/g*layer(position, (gap%leading_angle - phi(j))*gap%pad_radius()/gap%axial_length)
      end do
   end function field_of_modes

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
end module modal_field
