!> Derivatives of a film's force by axial modes over position and velocity (fourier_film): exactly those of the sums
!> over the nodes, which move with the position.
module fourier_slopes
   use kinds, only: wp
   use fourier_pad, only: fourier_pad_type
   use fourier_passes, only: simd_width, solve_adjoints, sum_adjoint
   use sommerfeld_nodes, only: node_shifts
   implicit none (type, external)
   private
   public :: force_slopes

contains

   !> Derivatives of the force, (component, position and velocity), of the last solution: by an adjoint for each
   !> component. For a weight psi let B m = -share psi weight with the matrix B of the scheme; the force changes by
   !> m . (dS - dB q) and by what changes in the sums themselves.
   pure subroutine force_slopes(pad, rise, derivatives)
      type(fourier_pad_type), intent(inout) :: pad
      !> Pressure at the leading edge above ambient, Pa.
      real(wp), intent(in) :: rise
      real(wp), intent(out) :: derivatives(2, 4)
      real(wp) :: adjoint(simd_width, 0:pad%n, 2)
      integer :: i, m, b
      associate (of => pad%adjoints, n => pad%n)
         of%along(:, 1) = -pad%radius*pad%d*pad%weight*pad%inverse_root*pad%sine
         of%along(:, 2) = -pad%radius*pad%d*pad%weight*pad%inverse_root*pad%cosine
         of%over_s = 0
         of%over_v = 0
         of%over_h2 = 0
         of%boundary = 0
         of%solved = 0
         do b = 1, pad%axial%blocks
            call solve_adjoints(n, pad%a(:, :, b), pad%f(:, :, b), pad%share(:, :, b), of%along, adjoint)
            do m = 1, 2
               call sum_adjoint(n, adjoint(:, :, m), pad%q(:, :, b), pad%axial%square(simd_width*b - simd_width &
                  & + 1:simd_width*b), of%over_s(:, m), of%over_v(:, m), of%over_h2(:, m))
               ! q = rise H at the leading edge stands in the last equation as a q
               of%boundary(m) = of%boundary(m) - dot_product(adjoint(:, n - 1, m), pad%a(:, n, b))*rise
            end do
            do i = 0, n
               of%solved(i) = of%solved(i) + dot_product(pad%share(:, i, b), pad%q(:, i, b))
            end do
         end do
         call node_shifts(n, pad%d, pad%e, pad%directions, pad%h, of%shift, of%stretch)
         of%floor_share = pad%floor_share
         if (pad%varies) then
            ! as q is over the pressure
            of%floor_share = of%floor_share*pad%lift/pad%h
            of%boundary = of%boundary*pad%lift(n)/pad%h(n)
         end if
         if (pad%by_thickness) of%over_h2 = of%over_h2*spread(pad%law%across, 2, 2)
         do m = 1, 2
            derivatives(m, :) = from_nodes(pad, m, rise)
         end do
      end associate
   end subroutine force_slopes

   !> Derivatives of component m of the force from those over what stands at the nodes.
   pure function from_nodes(pad, m, rise) result(derivatives)
      ! long: every term of the force once
      type(fourier_pad_type), intent(in) :: pad
      integer, intent(in) :: m
      real(wp), intent(in) :: rise
      real(wp) :: derivatives(4)
      real(wp), dimension(0:pad%n) :: by_h, by_s, by_phi
      real(wp) :: k, unit, sign, total, slope, s_slope, by_k, by_log_d, psi, at_edge, by_slope
      integer :: i
      associate (of => pad%adjoints, n => pad%n, h => pad%h, s => pad%s, e => pad%e, w => pad%w, sine => pad%sine, &
         & cosine => pad%cosine, narrow => pad%narrow, narrow_share => pad%narrow_share)
         k = dot_product(e, e) - 1
         unit = pad%d**2/12
         ! dpsi/dphi is the other component's psi, or less it
         sign = 3 - 2*m
         by_k = 0
         by_log_d = 0
         !$omp simd private(total) reduction(+:by_k, by_log_d)
         do i = 0, n
            total = of%solved(i) - narrow_share(i)*narrow(i) + of%floor_share(i)*h(i)
            by_k = by_k + unit*of%over_v(i, m)
            by_log_d = by_log_d + of%along(i, m)*total + 2*unit*(of%over_v(i, m)*(k + h(i)*(3 - 2*h(i))) &
               & + of%over_h2(i, m)*h(i)**2 + of%over_s(i, m)*s(i))
            by_h(i) = unit*(of%over_v(i, m)*(3 - 4*h(i)) + of%over_h2(i, m)*2*h(i)) &
               & + of%along(i, m)*(2*narrow_share(i)*narrow(i)/h(i) + of%floor_share(i))
            by_s(i) = unit*of%over_s(i, m) - of%along(i, m)*narrow_share(i)/h(i)**2
            by_phi(i) = sign*of%along(i, 3 - m)*total
         end do
         ! layers of the modes left out at both edges
         do i = 0, n, n
            psi = -pad%radius*merge(sine(i), cosine(i), m == 1)
            at_edge = pad%axial%tail(3)*psi/h(i)**3
            by_s(i) = by_s(i) + at_edge
            by_h(i) = by_h(i) - 3*at_edge*s(i)/h(i)
         end do
         ! the pressure at the leading edge
         by_slope = pad%axial%tail(2)*rise*1.5_wp*psi/h(n)
         if (pad%by_thickness) by_slope = by_slope/pad%law%across(n + 1)
         by_h(n) = by_h(n) + of%boundary(m) + of%along(n, m)*of%solved(n)/h(n) &
            & - by_slope*(e(2)*sine(n) - e(1)*cosine(n))/h(n)
         derivatives = 0
         if (pad%varies) then
            derivatives = varied_sum(pad, m, rise, by_s, by_h, by_phi)
            by_h = 0
            by_s = 0
            by_phi = 0
         end if
         do i = 0, n
            slope = e(2)*sine(i) - e(1)*cosine(i)
            s_slope = pad%wedge*(1 - h(i)) + pad%squeeze*(w(1)*cosine(i) - w(2)*sine(i))
            by_phi(i) = by_phi(i) + by_h(i)*slope + by_s(i)*s_slope
            derivatives(1) = derivatives(1) + by_phi(i)*of%shift(i, 1) - by_h(i)*sine(i) - by_s(i)*pad%wedge*cosine(i)
            derivatives(2) = derivatives(2) + by_phi(i)*of%shift(i, 2) - by_h(i)*cosine(i) + by_s(i)*pad%wedge*sine(i)
            derivatives(3) = derivatives(3) + by_s(i)*sine(i)
            derivatives(4) = derivatives(4) + by_s(i)*cosine(i)
         end do
         derivatives(:2) = derivatives(:2) + 2*e*by_k + of%stretch*by_log_d + by_slope*[-cosine(n), sine(n)]
      end associate
      derivatives(:2) = derivatives(:2)/pad%gap%machined_clearance
      derivatives(3:) = derivatives(3:)*pad%squeeze
   end function from_nodes

   !> The sum over the nodes where the law varies: what v and s depend on besides, H' and the place itself.
   pure function varied_sum(pad, m, rise, by_s, by_h, by_phi) result(derivatives)
      type(fourier_pad_type), intent(in) :: pad
      integer, intent(in) :: m
      real(wp), intent(in) :: rise
      !> At the nodes, as in from_nodes.
      real(wp), dimension(0:pad%n), intent(in) :: by_s, by_h, by_phi
      real(wp) :: derivatives(4), layer, factor
      !> Derivatives over s and H, and over the logarithm of the inverse root of E, in which that of s is left out.
      real(wp), dimension(0:pad%n) :: over_s, over_h, held
      integer :: i
      over_s = by_s
      over_h = by_h
      associate (of => pad%adjoints)
         held = of%along(:, m)*(of%solved - pad%narrow_share*pad%narrow)
         if (pad%by_thickness) over_s = over_s + of%along(:, m)*pad%narrow_share/pad%h**2*(1 - 1/pad%law%across)
      end associate
      ! the layers of the modes left out, which are there without the law
      do i = 0, pad%n, pad%n
         factor = pad%inverse_root(i)
         if (pad%by_thickness) factor = factor/pad%law%across(i + 1)**1.5_wp
         layer = -pad%axial%tail(3)*pad%radius*merge(pad%sine(i), pad%cosine(i), m == 1)/pad%h(i)**3*(factor - 1)
         over_s(i) = over_s(i) + layer
         over_h(i) = over_h(i) - 3*layer*pad%s(i)/pad%h(i)
      end do
      call add_place(pad, m, held, over_s, over_h, by_phi, derivatives)
      if (pad%by_thickness) derivatives(:2) = derivatives(:2) + over_thickness(pad, m, rise, held + over_s*pad%s)
   end function varied_sum

   !> That sum for a law that follows the nodes along the film.
   pure subroutine add_place(pad, m, held, over_s, over_h, by_phi, derivatives)
      type(fourier_pad_type), intent(in) :: pad
      integer, intent(in) :: m
      !> As in varied_sum.
      real(wp), dimension(0:pad%n), intent(in) :: held, over_s, over_h, by_phi
      real(wp), intent(out) :: derivatives(4)
      real(wp) :: slope, bend, of_v, of_s, of_h, of_slope, of_phi, by_log_d, over_y, over_z, over_vy, over_vz
      integer :: i
      by_log_d = 0
      over_y = 0
      over_z = 0
      over_vy = 0
      over_vz = 0
      associate (of => pad%adjoints, h => pad%h, sine => pad%sine, cosine => pad%cosine, e => pad%e, w => pad%w, &
         & p => pad%law%flow_slopes, g => pad%law%sliding_slopes)
         !$omp simd private(slope, bend, of_v, of_s, of_h, of_slope, of_phi) &
         !$omp& reduction(+:over_y, over_z, over_vy, over_vz, by_log_d)
         do i = 0, pad%n
            slope = e(2)*sine(i) - e(1)*cosine(i)
            bend = p(i + 1, 2)/2 + p(i + 1, 1)**2/4
            of_v = pad%d**2/12*of%over_v(i, m)
            of_s = pad%inverse_root(i)*over_s(i)
            by_log_d = by_log_d + 2*of_v*h(i)*(1.5_wp*slope*p(i + 1, 1) + h(i)*bend)
            of_h = over_h(i) + of_v*(1.5_wp*slope*p(i + 1, 1) + 2*h(i)*bend) + of_s*pad%wedge*g(i + 1, 1)
            of_slope = of_v*1.5_wp*h(i)*p(i + 1, 1) + of_s*pad%wedge*pad%law%sliding(i + 1)
            of_phi = by_phi(i) - p(i + 1, 1)/2*(held(i) + over_s(i)*pad%s(i)) &
               & + of_v*h(i)*(1.5_wp*slope*p(i + 1, 2) + h(i)*(p(i + 1, 3) + p(i + 1, 1)*p(i + 1, 2))/2) &
               & + of_s*(pad%wedge*(slope*g(i + 1, 1) + h(i)*g(i + 1, 2)) &
               & + pad%squeeze*(w(1)*cosine(i) - w(2)*sine(i))) + of_h*slope + of_slope*(1 - h(i))
            over_y = over_y + of_phi*of%shift(i, 1) - of_h*sine(i) - of_slope*cosine(i)
            over_z = over_z + of_phi*of%shift(i, 2) - of_h*cosine(i) + of_slope*sine(i)
            over_vy = over_vy + of_s*sine(i)
            over_vz = over_vz + of_s*cosine(i)
         end do
         derivatives = [over_y, over_z, over_vy, over_vz]
         derivatives(:2) = derivatives(:2) + of%stretch*by_log_d
      end associate
   end subroutine add_place

   !> Derivatives over e by what the law makes of another thickness in the same place. With a = (d ln h)/d e, ln E
   !> changes by its power times a, and its slopes by those of that product; ln K likewise, which moves with the nodes,
   !> too.
   pure function over_thickness(pad, m, rise, of_root) result(derivatives)
      type(fourier_pad_type), intent(in) :: pad
      integer, intent(in) :: m
      !> Derivative over the logarithm of the inverse root, by node.
      real(wp), intent(in) :: rise, of_root(0:pad%n)
      real(wp) :: derivatives(2), h, slope, of_v, bent, of_across, of_a(0:2), a(2, 0:2), x(2), x_slope(2), at_edge
      real(wp) :: power(0:2), across_power
      integer :: i
      derivatives = 0
      associate (of => pad%adjoints, law => pad%law, e => pad%e, n => pad%n)
         do i = 0, n
            h = pad%h(i)
            x = [pad%sine(i), pad%cosine(i)]
            x_slope = [x(2), -x(1)]
            slope = e(2)*x(1) - e(1)*x(2)
            a(:, 0) = -x/h
            a(:, 1) = (slope*x/h - x_slope)/h
            a(:, 2) = (x + 2*slope*x_slope - 2*slope**2*x/h)/h**2
            of_v = pad%d**2/12*of%over_v(i, m)
            bent = 1.5_wp*h*slope + h**2*law%flow_slopes(i + 1, 1)/2
            of_across = pad%d**2/12*of%over_h2(i, m)*h**2 + of%along(i, m)*pad%narrow_share(i)*pad%narrow(i)
            power = law%flow_power(i + 1, :)
            across_power = law%across_power(i + 1, 0)
            of_a(0) = of_v*(bent*power(1) + h**2*power(2)/2) - power(0)/2*of_root(i) + of_across*across_power
            of_a(1) = of_v*(bent*power(0) + h**2*power(1))
            of_a(2) = of_v*h**2/2*power(0)
            if (i == 0 .or. i == n) then
               at_edge = -pad%axial%tail(3)*pad%radius*x(m)*pad%narrow(i)/h*pad%inverse_root(i)/sqrt(law%across(i + 1))
               of_a(0) = of_a(0) - at_edge*(power(0)/2 + 1.5_wp*across_power)
            end if
            if (i == n) of_a(0) = of_a(0) + power(0)/2*(of%boundary(m)*h + of%along(n, m)*of%solved(n))
            if (i == n) of_a(:1) = of_a(:1) + by_supply(pad, m, rise)
            derivatives = derivatives + matmul(a, of_a) + of_across*law%across_slope(i + 1)*of%shift(i, :)
         end do
      end associate
   end function over_thickness

   !> Derivatives of the layers that the pressure at the leading edge has in the modes left out (fourier_film), over a
   !> and its slope there.
   pure function by_supply(pad, m, rise) result(of_a)
      type(fourier_pad_type), intent(in) :: pad
      integer, intent(in) :: m
      real(wp), intent(in) :: rise
      real(wp) :: of_a(0:1), power(0:2), across_power(0:1), psi, psi_slope, second, falling
      associate (n => pad%n, law => pad%law, across => pad%law%across(pad%n + 1))
         power = law%flow_power(n + 1, :)
         across_power = law%across_power(n + 1, :)
         psi = -pad%radius*merge(pad%sine(n), pad%cosine(n), m == 1)
         psi_slope = -pad%radius*merge(pad%cosine(n), -pad%sine(n), m == 1)
         second = rise*pad%axial%tail(2)/across
         falling = 1.5_wp*(pad%e(2)*pad%sine(n) - pad%e(1)*pad%cosine(n))/pad%h(n) + law%flow_slopes(n + 1, 1)/2 &
            & + 0.75_wp*law%across_slope(n + 1)
         of_a(0) = across_power(0)*(second*(psi_slope - psi*falling) - rise*psi*pad%axial%tail(1)/(2*sqrt(across))) &
            & + psi*second*(power(1)/2 + 0.75_wp*across_power(1))
         of_a(1) = psi*second*(power(0)/2 + 0.75_wp*across_power(0))
      end associate
   end function by_supply
end module fourier_slopes
