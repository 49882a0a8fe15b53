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
   pure function force_slopes(pad, rise) result(derivatives)
      type(fourier_pad_type), intent(in) :: pad
      !> Pressure at the leading edge above ambient, Pa.
      real(wp), intent(in) :: rise
      real(wp) :: derivatives(2, 4)
      real(wp), dimension(0:pad%n, 2) :: along, over_s, over_v, over_h2, shift
      real(wp) :: adjoint(simd_width, 0:pad%n, 2), solved(0:pad%n), floor_share(0:pad%n), boundary(2), stretch(2)
      integer :: i, m, b
      associate (n => pad%n, blocks => pad%axial%blocks)
         ! derivatives of the force over share q, over d^2 v/12, d^2 H^2/12 and d^2 s/12 at the nodes
         along(:, 1) = -pad%radius*pad%d*pad%weight*pad%ease*pad%sine
         along(:, 2) = -pad%radius*pad%d*pad%weight*pad%ease*pad%cosine
         over_s = 0
         over_v = 0
         over_h2 = 0
         boundary = 0
         solved = 0
         do b = 1, blocks
            call solve_adjoints(n, pad%a(:, :, b), pad%f(:, :, b), pad%share(:, :, b), along, adjoint)
            do m = 1, 2
               call sum_adjoint(n, adjoint(:, :, m), pad%q(:, :, b), pad%axial%square(simd_width*b - simd_width &
                  & + 1:simd_width*b), over_s(:, m), over_v(:, m), over_h2(:, m))
               ! q = rise H at the leading edge stands in the last equation as a q
               boundary(m) = boundary(m) - dot_product(adjoint(:, n - 1, m), pad%a(:, n, b))*rise
            end do
            do i = 0, n
               solved(i) = solved(i) + dot_product(pad%share(:, i, b), pad%q(:, i, b))
            end do
         end do
         call node_shifts(n, pad%d, pad%e, pad%directions, pad%h, shift, stretch)
         floor_share = pad%floor_share
         if (pad%oil%varies) then
            ! as q is over the pressure
            floor_share = floor_share*pad%lift/pad%h
            boundary = boundary*pad%lift(n)/pad%h(n)
         end if
         do m = 1, 2
            derivatives(m, :) = from_nodes(pad, pad%n, m, rise, pad%h, pad%s, pad%narrow, pad%narrow_share, &
               & floor_share, solved, along(:, m), along(:, 3 - m), over_s(:, m), over_v(:, m), over_h2(:, m), &
               & boundary(m), shift, stretch)
         end do
      end associate
   end function force_slopes

   !> Derivatives of component m of the force from those over what stands at the nodes.
   pure function from_nodes(pad, n, m, rise, h, s, narrow, narrow_share, floor_share, solved, along, across, over_s, &
      & over_v, over_h2, boundary, shift, stretch) result(derivatives)
      ! long: every term of the force once
      type(fourier_pad_type), intent(in) :: pad
      integer, intent(in) :: n, m
      real(wp), intent(in) :: rise
      !> Of the pad; the modes' sums at the nodes; derivatives as in force_slopes, `across` of the other component.
      real(wp), dimension(0:n), intent(in) :: h, s, narrow, narrow_share, floor_share, solved, along, across, over_s, &
         & over_v, over_h2
      real(wp), intent(in) :: boundary, shift(0:n, 2), stretch(2)
      real(wp) :: derivatives(4)
      real(wp), dimension(0:n) :: by_h, by_s, by_phi
      real(wp) :: k, unit, sign, total, slope, s_slope, by_k, by_log_d, psi, at_edge, by_slope
      integer :: i
      k = dot_product(pad%e, pad%e) - 1
      unit = pad%d**2/12
      ! dpsi/dphi is the other component's psi, or less it
      sign = 3 - 2*m
      by_k = 0
      by_log_d = 0
      !$omp simd private(total) reduction(+:by_k, by_log_d)
      do i = 0, n
         total = solved(i) - narrow_share(i)*narrow(i) + floor_share(i)*h(i)
         by_k = by_k + unit*over_v(i)
         by_log_d = by_log_d + along(i)*total &
            & + 2*unit*(over_v(i)*(k + h(i)*(3 - 2*h(i))) + over_h2(i)*h(i)**2 + over_s(i)*s(i))
         by_h(i) = unit*(over_v(i)*(3 - 4*h(i)) + over_h2(i)*2*h(i)) &
            & + along(i)*(2*narrow_share(i)*narrow(i)/h(i) + floor_share(i))
         by_s(i) = unit*over_s(i) - along(i)*narrow_share(i)/h(i)**2
         by_phi(i) = sign*across(i)*total
      end do
      ! layers of the modes left out at both edges
      do i = 0, n, n
         psi = -pad%radius*merge(pad%sine(i), pad%cosine(i), m == 1)
         at_edge = pad%axial%tail(3)*psi/h(i)**3
         by_s(i) = by_s(i) + at_edge
         by_h(i) = by_h(i) - 3*at_edge*s(i)/h(i)
      end do
      ! the pressure at the leading edge
      by_slope = pad%axial%tail(2)*rise*1.5_wp*psi/h(n)
      by_h(n) = by_h(n) + boundary + along(n)*solved(n)/h(n) &
         & - by_slope*(pad%e(2)*pad%sine(n) - pad%e(1)*pad%cosine(n))/h(n)
      derivatives = 0
      if (pad%oil%varies) then
         derivatives = uneven_sum(pad, m, solved, along, over_v, by_s, by_h, by_phi, shift, stretch)
         by_h = 0
         by_s = 0
         by_phi = 0
      end if
      associate (sine => pad%sine, cosine => pad%cosine, e => pad%e, w => pad%w)
         do i = 0, n
            slope = e(2)*sine(i) - e(1)*cosine(i)
            s_slope = pad%wedge*(1 - h(i)) + pad%squeeze*(w(1)*cosine(i) - w(2)*sine(i))
            by_phi(i) = by_phi(i) + by_h(i)*slope + by_s(i)*s_slope
            derivatives(1) = derivatives(1) + by_phi(i)*shift(i, 1) - by_h(i)*sine(i) - by_s(i)*pad%wedge*cosine(i)
            derivatives(2) = derivatives(2) + by_phi(i)*shift(i, 2) - by_h(i)*cosine(i) + by_s(i)*pad%wedge*sine(i)
            derivatives(3) = derivatives(3) + by_s(i)*sine(i)
            derivatives(4) = derivatives(4) + by_s(i)*cosine(i)
         end do
         derivatives(:2) = derivatives(:2) + 2*e*by_k + stretch*by_log_d + by_slope*[-cosine(n), sine(n)]
      end associate
      derivatives(:2) = derivatives(:2)/pad%gap%machined_clearance
      derivatives(3:) = derivatives(3:)*pad%squeeze
   end function from_nodes

   !> The sum over the nodes where the viscosity is uneven: what v and s depend on besides, H' and the place itself.
   pure function uneven_sum(pad, m, solved, along, over_v, by_s, by_h, by_phi, shift, stretch) result(derivatives)
      type(fourier_pad_type), intent(in) :: pad
      integer, intent(in) :: m
      !> At the nodes, as in from_nodes; shifts and stretch.
      real(wp), dimension(0:pad%n), intent(in) :: solved, along, over_v, by_s, by_h, by_phi
      real(wp), intent(in) :: shift(0:pad%n, 2), stretch(2)
      real(wp) :: derivatives(4), over_s(0:pad%n), over_h(0:pad%n), layer
      integer :: i
      over_s = by_s
      over_h = by_h
      ! the layers of the modes left out, which are there without the ease
      do i = 0, pad%n, pad%n
         layer = -pad%axial%tail(3)*pad%radius*merge(pad%sine(i), pad%cosine(i), m == 1)/pad%h(i)**3*(pad%ease(i) - 1)
         over_s(i) = over_s(i) + layer
         over_h(i) = over_h(i) - 3*layer*pad%s(i)/pad%h(i)
      end do
      associate (of => pad%weights)
         call add_uneven(pad%n, pad%d, pad%e, pad%w, pad%wedge, pad%squeeze, pad%h, pad%sine, pad%cosine, pad%s, &
            & pad%ease, of%sliding, of%flow_slopes, of%sliding_slopes, &
            & along*(solved - pad%narrow_share*pad%narrow), over_v, over_s, over_h, by_phi, shift, stretch, derivatives)
      end associate
   end function uneven_sum

   !> That sum.
   pure subroutine add_uneven(n, d, e, w, wedge, squeeze, h, sine, cosine, s, ease, sliding, p, g, held, over_v, &
      & over_s, over_h, by_phi, shift, stretch, derivatives)
      integer, intent(in) :: n
      real(wp), intent(in) :: d, e(2), w(2), wedge, squeeze
      real(wp), dimension(0:n), intent(in) :: h, sine, cosine, s, ease, sliding, held, over_v, over_s, over_h, by_phi
      real(wp), intent(in) :: p(0:n, 3), g(0:n, 2), shift(0:n, 2), stretch(2)
      real(wp), intent(out) :: derivatives(4)
      real(wp) :: slope, bend, of_v, of_s, of_h, of_slope, of_phi, by_log_d, over_y, over_z, over_vy, over_vz
      integer :: i
      by_log_d = 0
      over_y = 0
      over_z = 0
      over_vy = 0
      over_vz = 0
      !$omp simd private(slope, bend, of_v, of_s, of_h, of_slope, of_phi) &
      !$omp& reduction(+:over_y, over_z, over_vy, over_vz, by_log_d)
      do i = 0, n
         slope = e(2)*sine(i) - e(1)*cosine(i)
         bend = p(i, 2)/2 + p(i, 1)**2/4
         of_v = d**2/12*over_v(i)
         of_s = ease(i)*over_s(i)
         by_log_d = by_log_d + 2*of_v*h(i)*(1.5_wp*slope*p(i, 1) + h(i)*bend)
         of_h = over_h(i) + of_v*(1.5_wp*slope*p(i, 1) + 2*h(i)*bend) + of_s*wedge*g(i, 1)
         of_slope = of_v*1.5_wp*h(i)*p(i, 1) + of_s*wedge*sliding(i)
         of_phi = by_phi(i) - p(i, 1)/2*(held(i) + over_s(i)*s(i)) &
            & + of_v*h(i)*(1.5_wp*slope*p(i, 2) + h(i)*(p(i, 3) + p(i, 1)*p(i, 2))/2) &
            & + of_s*(wedge*(slope*g(i, 1) + h(i)*g(i, 2)) + squeeze*(w(1)*cosine(i) - w(2)*sine(i))) &
            & + of_h*slope + of_slope*(1 - h(i))
         over_y = over_y + of_phi*shift(i, 1) - of_h*sine(i) - of_slope*cosine(i)
         over_z = over_z + of_phi*shift(i, 2) - of_h*cosine(i) + of_slope*sine(i)
         over_vy = over_vy + of_s*sine(i)
         over_vz = over_vz + of_s*cosine(i)
      end do
      derivatives = [over_y, over_z, over_vy, over_vz]
      derivatives(:2) = derivatives(:2) + stretch*by_log_d
   end subroutine add_uneven
end module fourier_slopes
