!> What a pressure at the leading edge drives through the edges of a film, from its axial modes (fourier_film).
!>
!> In the corners of leading edge and side the pressure leaps, and the flow of the Reynolds equation, 2/pi over the
!> distance, has no finite sum. The equation holds for distances that are long against the film, so the corners are
!> left out up to a film thickness. Of the modes a strip of even thickness has sum_k c_k Lambda_k, which is then
!>    R 4/pi ln(cot(pi h/(2 L)));
!> what the film thickness ratio and the length of the arc change is a sum that converges.
module fourier_edges
   use kinds, only: wp, pi
   use film_solver, only: film_oil
   use fourier_pad, only: fourier_pad_type
   use fourier_passes, only: simd_width
   implicit none (type, external)
   private
   public :: edge_flows

contains

   !> Flows in at the leading and out at the trailing edge, m^3/s, of the pad's last solution, with this oil, which a
   !> pressure of 1 Pa at the leading edge alone has driven.
   pure function edge_flows(pad, oil) result(flows)
      type(fourier_pad_type), intent(in) :: pad
      type(film_oil), intent(in) :: oil
      real(wp) :: flows(2)
      real(wp) :: falling, leading(simd_width), trailing(simd_width)
      integer :: b
      associate (n => pad%n, h => pad%h, gap => pad%gap)
         ! how fast a layer falls as the film becomes thicker
         falling = 1.5_wp*(pad%e(2)*pad%sine(n) - pad%e(1)*pad%cosine(n))/h(n)
         flows(1) = pad%radius*4/pi &
            & *log(1/tan(pi*h(n)*gap%machined_clearance/(2*gap%axial_length))) - gap%axial_length*falling
         flows(2) = 0
         do b = 1, pad%axial%blocks
            leading = slope(pad%q(:, n, b), pad%q(:, n - 1, b), pad%q(:, n - 2, b), pad%a(:, n, b), &
               & pad%a(:, n - 1, b), pad%a(:, n - 2, b))/h(n)**2 - falling/1.5_wp
            ! q = 0 at the edge itself
            trailing = -slope(pad%q(:, 0, b), pad%q(:, 1, b), pad%q(:, 2, b), pad%a(:, 1, b), pad%a(:, 1, b), &
               & pad%a(:, 2, b))/h(0)**2
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
end module fourier_edges
