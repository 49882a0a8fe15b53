!> How far pads bend: the change of the radius of a pad's bore by the pressure of its film, and by the heat that flows
!> through it (docs/theory/heat.md, *Bent pads*).
!>
!> A pad is a curved beam on its pivot, of the radius R_m in the middle of its thickness t. Where its curvature changes
!> by k, its bore moves outward by w, w'' + w = R_m^2 k over the angle from the pivot. A pressure p per area bends it by
!> k = M/(E' I), E' = E/(1 - nu^2), I = t^3/12, with the moment M(phi) of what acts from phi to the edge, a gradient of
!> temperature by k = alpha dT/dr. The bore that counts goes through the pivot and both edges.
module pad_bending
   use kinds, only: wp
   use pad_gap, only: pad_gap_type
   implicit none (type, external)
   private
   public :: points_along, points_across, bending_points, bent_by_pressure, bent_by_heat

   !> Intervals from the pivot to an edge and along half the width, of Simpson's rule.
   integer, parameter :: intervals = 64, intervals_across = 16
   integer, parameter :: points_along = 2*intervals + 1, points_across = intervals_across + 1

contains

   !> Where the pressure is asked for: angles from the pivot, from the trailing to the leading edge, rad, and distances
   !> from the middle plane, m.
   pure subroutine bending_points(gap, phi, z)
      type(pad_gap_type), intent(in) :: gap
      real(wp), intent(out) :: phi(:), z(:)
      integer :: i
      do i = 0, intervals
         phi(intervals + 1 + i) = gap%leading_angle*i/intervals
         phi(intervals + 1 - i) = -gap%trailing_angle*i/intervals
      end do
      z = [(0.5_wp*gap%axial_length*i/intervals_across, i=0, intervals_across)]
   end subroutine bending_points

   !> Change of the bore's radius, m, by pressures above ambient at these points, Pa, (axial position, angle), of a pad
   !> of this thickness, m, Young's modulus, Pa, and Poisson's ratio.
   pure real(wp) function bent_by_pressure(gap, thickness, modulus, poisson, pressure) result(change)
      type(pad_gap_type), intent(in) :: gap
      real(wp), intent(in) :: thickness, modulus, poisson, pressure(:, :)
      real(wp) :: along(-intervals:intervals), unit, middle
      along = matmul(simpson(intervals_across), pressure)
      middle = gap%pad_radius() + thickness/2
      unit = gap%pad_radius()*middle**3/(modulus/(1 - poisson**2)*thickness**3/12)
      change = radius_change(gap, unit*edge(along(0:), gap%leading_angle), &
         & unit*edge(along(0:-intervals:-1), gap%trailing_angle))
   contains
      !> The integral of the pressure, from the pivot to an edge at this angle, times what a force of 1 moves that edge:
      !> the integral over s from 0 to phi of sin(edge - s) sin(phi - s).
      pure real(wp) function edge(pressure, angle)
         real(wp), intent(in) :: pressure(0:), angle
         real(wp) :: phi(0:intervals)
         integer :: i
         phi = [(angle*i/intervals, i=0, intervals)]
         edge = angle*sum(simpson(intervals)*pressure*0.5_wp*(phi*cos(angle - phi) - cos(angle)*sin(phi)))
      end function edge
   end function bent_by_pressure

   !> The same by gradients of the temperature from back to bore, K/m, at even stations from the leading edge on, of a
   !> pad of this thickness, m, and linear expansion, 1/K.
   pure real(wp) function bent_by_heat(gap, thickness, expansion, gradient) result(change)
      type(pad_gap_type), intent(in) :: gap
      real(wp), intent(in) :: thickness, expansion, gradient(:)
      real(wp) :: unit
      integer :: n
      n = size(gradient)
      unit = expansion*(gap%pad_radius() + thickness/2)**2
      change = radius_change(gap, unit*edge(gradient, gap%leading_angle), &
         & unit*edge(gradient(n:1:-1), gap%trailing_angle))
   contains
      !> The integral of the gradient times sin(edge - phi), from the pivot to the edge before the first station.
      pure real(wp) function edge(gradient, angle)
         real(wp), intent(in) :: gradient(:), angle
         real(wp) :: from_edge(0:size(gradient))
         integer :: i
         from_edge = [(min(gap%arc()*i/size(gradient), angle), i=0, size(gradient))]
         edge = sum(gradient*(cos(from_edge(:size(gradient) - 1)) - cos(from_edge(1:))))
      end function edge
   end function bent_by_heat

   !> Of the circle through the pivot and both edges where the edges move outward: w = change (1 - cos phi)
   !> + turn sin phi.
   pure real(wp) function radius_change(gap, leading, trailing) result(change)
      type(pad_gap_type), intent(in) :: gap
      real(wp), intent(in) :: leading, trailing
      associate (a => gap%leading_angle, b => gap%trailing_angle)
         change = (leading*sin(b) + trailing*sin(a))/((1 - cos(a))*sin(b) + (1 - cos(b))*sin(a))
      end associate
   end function radius_change

   !> Weights of Simpson's rule for the mean over an even number of intervals.
   pure function simpson(intervals) result(weights)
      integer, intent(in) :: intervals
      real(wp) :: weights(intervals + 1)
      integer :: i
      weights = [(real(2 + 2*mod(i, 2), wp), i=0, intervals)]
      weights([1, intervals + 1]) = 1
      weights = weights/(3*intervals)
   end function simpson
end module pad_bending
