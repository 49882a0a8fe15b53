!> The film of a dimensionless pad of any arc whose pressure is a parabola across the width: one equation along the arc,
!>    (h^3 P')' - k h^3 P = -15 (w_1 sin(phi) + w_2 cos(phi)),   k = 10 (R/L)^2,   P >= 0,
!> with pressures P (1 - (2 Z/L)^2). It is close to the film of every width, quickly solved, and ends where that one
!> does: what tables of wide arcs divide by (docs/theory/film.md, *Wide arcs*).
!>
!> Sommerfeld's angle x, d(phi) = h/s dx, s^2 = 1 - e^2, makes (h P) smooth: nodes at equal steps of it, and Numerov's
!> scheme, of fourth order. A film ends at an edge of the arc or where the oil diverges so far that the slope of the
!> pressure is 0; these ends are found by Newton's iteration. As P meets a free end with its slope, force and
!> derivatives need not know how the end moves. With Guembel's condition the film lies on the whole arc, may pull, and
!> counts where it does not: P >= 0 is no part of the equation.
module strip_film
   use kinds, only: wp, pi
   use clipped_quadrature, only: clipped_weights
   implicit none (type, external)
   private
   public :: strip_film_type, strip_type, find_strip, solve_strip, solve_clipped_strip, usual_steps, angle_of

   !> Steps from end to end, and at most; their ends are found with half as many.
   integer, parameter :: usual_steps = 32, most_steps = 768
   !> Change of an end, rad of x, at which it is found: the force has an error of its third power. Iterations at most.
   real(wp), parameter :: end_tolerance = 1e-3_wp
   integer, parameter :: most_iterations = 20

   !> A film: Sommerfeld's angle at its ends, where the source of pressure changes its sign, and at the arc's edges.
   type :: strip_type
      real(wp) :: ends(2), reversals(2), edges(2)
      !> Whether an end lies on the arc.
      logical :: free(2)
   end type strip_type

   !> Force and its derivatives over position and w, (component, component of e or w), and the highest pressure.
   type :: strip_film_type
      real(wp) :: force(2) = 0, over_position(2, 2) = 0, over_w(2, 2) = 0, highest = 0
   end type strip_film_type

   !> Nodes of a film: thickness, directions, step^2/12 times the coefficient of h P in its second derivative, and the
   !> source over s^2.
   type :: line_type
      integer :: n
      real(wp) :: step
      real(wp), dimension(0:most_steps) :: h, sine, cosine, t, source
   end type line_type

contains

   !> The film on an arc -half_arc to half_arc of relative length L/R where oil converges on the half circle whose
   !> middle is psi; a part of it lies on the arc. In the frame of least film thickness, e < 1, at this angle of it.
   pure type(strip_type) function find_strip(half_arc, length, e, angle, psi, steps) result(strip)
      real(wp), intent(in) :: half_arc, length, e, angle, psi
      integer, intent(in) :: steps
      real(wp) :: arc(2), window(2)
      arc = [-half_arc, half_arc] - angle
      window = psi - angle + [-0.5_wp, 0.5_wp]*pi
      strip%reversals = sommerfeld_angle(e, window)
      strip%edges = sommerfeld_angle(e, arc)
      strip%free = [window(1) > arc(1), window(2) < arc(2)]
      call find_ends(length, e, [sin(psi - angle), cos(psi - angle)], steps/2, strip)
   end function find_strip

   !> Sommerfeld's angle at an angle from the least film thickness.
   elemental real(wp) function sommerfeld_angle(e, angle) result(x)
      real(wp), intent(in) :: e, angle
      associate (r => e/(1 + sqrt(1 - e**2)))
         x = angle + 2*atan2(r*sin(angle), 1 - r*cos(angle))
      end associate
   end function sommerfeld_angle

   !> The angle from the least film thickness at an angle of Sommerfeld's.
   elemental real(wp) function angle_of(e, x) result(angle)
      real(wp), intent(in) :: e, x
      angle = sommerfeld_angle(-e, x)
   end function angle_of

   !> Finds the ends of a film, of which those that are not free lie at the arc's edges.
   pure subroutine find_ends(length, e, w, steps, strip)
      real(wp), intent(in) :: length, e, w(2)
      integer, intent(in) :: steps
      type(strip_type), intent(inout) :: strip
      type(line_type) :: line
      real(wp) :: slopes(2), root, change(2), source
      integer :: iteration, side, node
      strip%ends = merge(strip%reversals, strip%edges, strip%free)
      if (.not. any(strip%free)) return
      do iteration = 0, most_iterations
         call place(length, e, w, steps, strip%ends, line)
         if (iteration > 0) slopes = end_slopes(line)
         change = 0
         do side = 1, 2
            if (.not. strip%free(side)) cycle
            node = merge(0, line%n, side == 1)
            root = sqrt(max(12*line%t(node), 1e-2_wp*line%step**2))/line%step
            source = max(-line%source(node), tiny(1.0_wp))
            if (iteration == 0) then
               ! of a film far from the other end and of a source that rises evenly
               change(side) = 1/root
            else
               ! as the pressure in the room that is gained is the parabola of the source there
               change(side) = 2*slopes(side)/(source + root*slopes(side) + hypot(source, root*slopes(side)))
               change(side) = max(change(side), -0.5_wp*abs(strip%ends(side) - strip%reversals(side)))
            end if
         end do
         call move_ends(strip, change)
         if (iteration > 0 .and. all(abs(change) < end_tolerance)) exit
      end do
   end subroutine find_ends

   !> Moves ends outwards, but not beyond the edges of the arc.
   pure subroutine move_ends(strip, change)
      type(strip_type), intent(inout) :: strip
      real(wp), intent(inout) :: change(2)
      real(wp) :: moved(2)
      moved = [max(strip%ends(1) - change(1), strip%edges(1)), min(strip%ends(2) + change(2), strip%edges(2))]
      change = moved - strip%ends
      strip%ends = moved
   end subroutine move_ends

   !> Nodes between two of Sommerfeld's angles.
   pure subroutine place(length, e, w, steps, ends, line)
      real(wp), intent(in) :: length, e, w(2), ends(2)
      integer, intent(in) :: steps
      type(line_type), intent(out) :: line
      real(wp) :: c(0:steps), s(0:steps), turn(2), square, k
      integer :: i, m
      line%n = steps
      line%step = (ends(2) - ends(1))/steps
      square = 1 - e**2
      c(0) = cos(ends(1))
      s(0) = sin(ends(1))
      turn = [cos(line%step), sin(line%step)]
      m = 1
      do while (m <= steps)
         !$omp simd
         do i = 0, min(m - 1, steps - m)
            c(m + i) = c(i)*turn(1) - s(i)*turn(2)
            s(m + i) = s(i)*turn(1) + c(i)*turn(2)
         end do
         turn = [(turn(1) - turn(2))*(turn(1) + turn(2)), 2*turn(1)*turn(2)]
         m = 2*m
      end do
      k = 10/length**2 - 2
      associate (root => sqrt(square), part => line%step**2/(12*square))
         !$omp simd
         do i = 0, steps
            line%h(i) = square/(1 + e*c(i))
            line%sine(i) = s(i)*line%h(i)/root
            line%cosine(i) = (e + c(i))*line%h(i)/square
            line%t(i) = part*(line%h(i)*(k*line%h(i) + 3) - square)
            line%source(i) = (w(1)*line%sine(i) + w(2)*line%cosine(i))/square
         end do
      end associate
   end subroutine place

   !> Slopes of h P at both ends, inwards: by eliminations from either side.
   pure function end_slopes(line) result(slopes)
      type(line_type), intent(in) :: line
      real(wp) :: slopes(2)
      real(wp), dimension(line%n) :: right
      real(wp) :: pivot(2), last(2), value(2), before(2), part(2), first, second
      integer :: i, k, side, at(2)
      associate (n => line%n, t => line%t, f => line%source, square => line%step**2)
         !$omp simd
         do i = 1, n - 1
            right(i) = square/12*(f(i - 1) + 10*f(i) + f(i + 1))
         end do
         pivot = 2 + 10*t([1, n - 1])
         value = right([1, n - 1])
         do i = 2, n - 1
            k = n - i
            last = pivot
            before = value
            part = [1 - t(i - 1), 1 - t(k + 1)]/last
            pivot = 2 + 10*[t(i), t(k)] - part*[1 - t(i), 1 - t(k)]
            value = [right(i), right(k)] + part*before
         end do
         ! that from the left knows the right end
         at = [n, 0]
         do side = 1, 2
            k = merge(1, -1, side == 2)
            i = at(side)
            first = value(side)/pivot(side)
            second = (before(side) + (1 - t(i + k))*first)/last(side)
            slopes(3 - side) = (first - (-7*square*f(i) + 6*(12*t(i + k)*first - square*f(i + k)) &
               & - (12*t(i + 2*k)*second - square*f(i + 2*k)))/24)/line%step
         end do
      end associate
   end function end_slopes

   !> A film by this number of steps, with derivatives over the position and the highest pressure where they are
   !> wanted. All in the frame of least film thickness.
   pure type(strip_film_type) function solve_strip(length, e, w, steps, strip, with_slopes, with_pressure) result(film)
      real(wp), intent(in) :: length, e, w(2)
      integer, intent(in) :: steps
      type(strip_type), intent(in) :: strip
      logical, intent(in) :: with_slopes, with_pressure
      type(line_type) :: line
      real(wp) :: u(0:steps, 2), weight(0:steps)
      call place(length, e, w, steps, strip%ends, line)
      call solve(line, 1/(1 - e**2), line%sine, line%cosine, u)
      weight = gregory(steps)
      call set_force(length, e, line, u, weight, w, film)
      if (with_slopes) call set_slopes(length, e, line, u, u, weight, w, film)
      if (with_pressure) film%highest = highest(line, 15*matmul(u, w)/line%h(:steps))
   end function solve_strip

   !> The same with Guembel's condition, on an arc of these angles from the least film thickness. The adjoints of a film
   !> that counts in part have their sources there.
   pure type(strip_film_type) function solve_clipped_strip(length, e, arc, w, steps, with_slopes, with_pressure) &
      & result(film)
      real(wp), intent(in) :: length, e, arc(2), w(2)
      integer, intent(in) :: steps
      logical, intent(in) :: with_slopes, with_pressure
      type(line_type) :: line
      real(wp) :: u(0:steps, 2), adjoint(0:steps, 2), weight(0:steps), pressure(0:steps)
      call place(length, e, w, steps, sommerfeld_angle(e, arc), line)
      call solve(line, 1/(1 - e**2), line%sine, line%cosine, u)
      pressure = 15*matmul(u, w)/line%h(:steps)
      call clipped_weights(steps, pressure, weight)
      call set_force(length, e, line, u, weight, w, film)
      if (with_slopes) then
         call solve(line, 1/(1 - e**2), weight*line%sine(:steps), weight*line%cosine(:steps), adjoint)
         call set_slopes(length, e, line, u, adjoint, weight, w, film)
      end if
      if (with_pressure) film%highest = highest(line, pressure)
   end function solve_clipped_strip

   !> Weights of nodes by the rule of Gregory.
   pure function gregory(steps) result(weight)
      integer, intent(in) :: steps
      real(wp) :: weight(0:steps)
      weight = 1
      weight([1, steps - 1]) = 7/6.0_wp
      weight([2, steps - 2]) = 23/24.0_wp
   end function gregory

   !> h P for the sources `sine` and `cosine` at the nodes, over s^2.
   pure subroutine solve(line, unit, sine, cosine, u)
      type(line_type), intent(in) :: line
      real(wp), intent(in) :: unit, sine(0:), cosine(0:)
      real(wp), intent(out) :: u(0:line%n, 2)
      real(wp) :: inverse(line%n), right(2, line%n), part
      integer :: i
      associate (n => line%n, t => line%t, scale => unit*line%step**2/12)
         !$omp simd
         do i = 1, n - 1
            right(1, i) = scale*(sine(i - 1) + 10*sine(i) + sine(i + 1))
            right(2, i) = scale*(cosine(i - 1) + 10*cosine(i) + cosine(i + 1))
         end do
         inverse(1) = 1/(2 + 10*t(1))
         do i = 2, n - 1
            part = (1 - t(i - 1))*inverse(i - 1)
            inverse(i) = 1/(2 + 10*t(i) - part*(1 - t(i)))
            right(:, i) = right(:, i) + part*right(:, i - 1)
         end do
         u(n, :) = 0
         do i = n - 1, 1, -1
            u(i, :) = (right(:, i) + (1 - t(i + 1))*u(i + 1, :))*inverse(i)
         end do
         u(0, :) = 0
      end associate
   end subroutine solve

   !> The force of a film that w drives and its slopes over w, from what sines and cosines drive and weights of nodes.
   pure subroutine set_force(length, e, line, u, weight, w, film)
      real(wp), intent(in) :: length, e, u(0:, :), weight(0:), w(2)
      type(line_type), intent(in) :: line
      type(strip_film_type), intent(inout) :: film
      real(wp) :: m(2, 2)
      integer :: i
      m = 0
      !$omp simd reduction(+:m)
      do i = 1, line%n - 1
         m(1, 1) = m(1, 1) + weight(i)*u(i, 1)*line%sine(i)
         m(2, 1) = m(2, 1) + weight(i)*u(i, 1)*line%cosine(i)
         m(1, 2) = m(1, 2) + weight(i)*u(i, 2)*line%sine(i)
         m(2, 2) = m(2, 2) + weight(i)*u(i, 2)*line%cosine(i)
      end do
      film%over_w = -10*length*line%step/sqrt(1 - e**2)*m
      film%force = matmul(film%over_w, w)
   end subroutine set_force

   !> The slopes over the position: `adjoint` is what sines and cosines drive where the film counts, as `weight` says.
   pure subroutine set_slopes(length, e, line, u, adjoint, weight, w, film)
      real(wp), intent(in) :: length, e, u(0:, :), adjoint(0:, :), weight(0:), w(2)
      type(line_type), intent(in) :: line
      type(strip_film_type), intent(inout) :: film
      real(wp) :: k(2, 2), slope, curve, y, s, over_h, along, outward, whole(0:line%n)
      integer :: i
      k = 0
      whole = gregory(line%n)
      !$omp simd private(slope, over_h, curve, y, s, along, outward) reduction(+:k)
      do i = 1, line%n - 1
         over_h = 1/line%h(i)
         slope = e*line%sine(i)
         curve = slope**2*over_h + 1
         y = w(1)*u(i, 1) + w(2)*u(i, 2)
         s = (w(1)*line%sine(i) + w(2)*line%cosine(i))*over_h
         along = whole(i)*((slope*line%cosine(i) - curve*line%sine(i))*y + line%sine(i)*s)
         outward = -whole(i)*((slope*line%sine(i) + curve*line%cosine(i))*y - line%cosine(i)*s)
         y = weight(i)*y*over_h
         k(1, 1) = k(1, 1) + along*adjoint(i, 1) + line%sine(i)*line%sine(i)*y
         k(2, 1) = k(2, 1) + along*adjoint(i, 2) + line%sine(i)*line%cosine(i)*y
         k(1, 2) = k(1, 2) + outward*adjoint(i, 1) + line%cosine(i)*line%sine(i)*y
         k(2, 2) = k(2, 2) + outward*adjoint(i, 2) + line%cosine(i)*line%cosine(i)*y
      end do
      film%over_position = -15*length*line%step/sqrt(1 - e**2)*k
   end subroutine set_slopes

   !> Highest value at the nodes of a film, or of the parabola through the three around it.
   pure real(wp) function highest(line, pressure)
      type(line_type), intent(in) :: line
      real(wp), intent(in) :: pressure(0:)
      integer :: i
      i = min(max(maxloc(pressure, 1) - 1, 1), line%n - 1)
      associate (rise => pressure(i + 1) - pressure(i - 1), bend => 2*pressure(i) - pressure(i - 1) - pressure(i + 1))
         highest = pressure(i)
         if (bend > 0) highest = highest + rise**2/(8*bend)
      end associate
   end function highest
end module strip_film
