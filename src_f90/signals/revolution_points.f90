!> What the points of a journal once a revolution say of its motion: whether it repeats, or winds round a torus, and
!> with which rotation number.
module revolution_points
   use kinds, only: wp, pi
   use rising_numbers, only: rising_order
   implicit none (type, external)
   private
   public :: revolution_points_type, describe_points, amplitude_at, agreement, disagreement, &
      & steady_ring, fewest_points, enough_points

   type :: revolution_points_type
      !> Revolutions after which the motion repeats; 0 where it does not.
      integer :: repeats_after = 0
      !> Part of a turn about their centre by which the points go on in a revolution, and by how much both halves of
      !> them differ in it; -1 where they do not go round it once.
      real(wp) :: rotation = -1, difference = -1
      !> By which part the mean square of their distance from the centre changes from one half to the other.
      real(wp) :: growth = 0
      !> Whether they lie on the ring of a torus.
      logical :: on_torus = .false.
   end type revolution_points_type

   !> Both halves agree in the rotation number of a torus; points of which they disagree are not settled, or chaotic.
   real(wp), parameter :: agreement = 1e-6_wp, disagreement = 1e-4_wp
   !> Growth up to which a ring is steady; points from which on what is not steady need not become so.
   real(wp), parameter :: steady_ring = 0.01_wp
   integer, parameter :: enough_points = 100
   !> Fewer points say nothing; most revolutions after which a motion is said to repeat.
   integer, parameter :: fewest_points = 32, longest = 16
   !> Changes in a revolution that are none, in clearances, and after several over the size of the ring.
   real(wp), parameter :: still = 1e-4_wp, closed = 1e-3_wp
   !> A closed curve has its extremes of the distance from the centre, each a way of the whole range there and back.
   !> Where neighbours in angle change to and fro, this part of the points and more, it is not one curve; a range below
   !> this part of the distance is none.
   real(wp), parameter :: to_and_fro = 0.1_wp, round = 0.05_wp

contains

   !> At least the fewest points (y, z), m, in a bearing of this clearance, m; angles count from y to z, times `sense`.
   pure function describe_points(y, z, clearance, sense) result(found)
      real(wp), intent(in) :: y(:), z(:), clearance, sense
      type(revolution_points_type) :: found
      complex(wp) :: points(size(y))
      real(wp) :: from_centre(size(y)), halves(2), size_of_ring
      integer :: n, k, half
      n = size(y)
      half = n/2
      points = cmplx(y, sense*z, wp)
      if (most_change(1) <= still*clearance) then
         found%repeats_after = 1
         return
      end if
      size_of_ring = max(maxval(y) - minval(y), maxval(z) - minval(z))
      do k = 2, longest
         if (found%repeats_after == 0 .and. most_change(k) <= closed*size_of_ring) found%repeats_after = k
      end do
      points = points - cmplx(average(points%re), average(points%im), wp)
      from_centre = abs(points)
      found%growth = abs(average(from_centre(half + 1:)**2)/average(from_centre(:half)**2) - 1)
      if (.not. goes_round_once(points)) return
      associate (turns => turns_of(points))
         found%rotation = modulo(average(turns), 1.0_wp)
         halves = [average(turns(:half)), average(turns(half + 1:))]
      end associate
      found%difference = abs(halves(2) - halves(1))
      if (found%repeats_after > 0 .or. found%growth > steady_ring .or. found%difference > agreement) return
      do k = longest, 2, -1
         if (abs(k*found%rotation - anint(k*found%rotation)) <= k*agreement) found%repeats_after = k
      end do
      found%on_torus = found%repeats_after == 0
   contains
      !> Of the last half of the points in this number of revolutions.
      pure real(wp) function most_change(revolutions)
         integer, intent(in) :: revolutions
         most_change = maxval(abs(points(half + 1:) - points(half + 1 - revolutions:n - revolutions)))
      end function most_change
   end function describe_points

   !> The mean of values along a quasi-periodic motion under a weight that falls to nothing at both ends, so that their
   !> number adds to the accuracy as no power of it does (Das, Sander, Saiki and Yorke).
   pure real(wp) function average(values)
      real(wp), intent(in) :: values(:)
      real(wp) :: at(size(values)), weight(size(values))
      integer :: k
      at = [(real(k, wp), k=1, size(values))]/(size(values) + 1)
      weight = exp(-1/(at*(1 - at)))
      average = sum(weight*values)/sum(weight)
   end function average

   !> Amplitude of the part of some values that has an order of the shaft's angle, rad.
   pure real(wp) function amplitude_at(order, angle, values) result(amplitude)
      real(wp), intent(in) :: order, angle(:), values(:)
      amplitude = 2*hypot(average(values*cos(order*angle)), average(values*sin(order*angle)))
   end function amplitude_at

   !> By which part of a turn about the origin each point is ahead of the one before. On a closed curve these parts
   !> differ by less than a turn: they are counted from the largest gap between them on.
   pure function turns_of(points) result(turns)
      complex(wp), intent(in) :: points(:)
      real(wp) :: turns(size(points) - 1), gaps(size(points) - 1)
      integer :: order(size(points) - 1), n
      n = size(turns)
      turns = modulo(angle_of(points(2:)*conjg(points(:n)))/(2*pi), 1.0_wp)
      order = rising_order(turns)
      gaps(:n - 1) = turns(order(2:)) - turns(order(:n - 1))
      gaps(n) = 1 + turns(order(1)) - turns(order(n))
      associate (last => turns(order(maxloc(gaps, dim=1))))
         if (last < turns(order(n))) turns = merge(turns, turns - 1, turns <= last)
      end associate
   end function turns_of

   !> Whether points lie on a curve that goes round the origin once, so that it has one distance in each direction.
   pure logical function goes_round_once(points)
      complex(wp), intent(in) :: points(:)
      real(wp) :: distance(size(points)), range
      distance = abs(points(rising_order(angle_of(points))))
      range = max(maxval(distance) - minval(distance), round*maxval(distance))
      goes_round_once = sum(abs(distance(2:) - distance(:size(points) - 1))) < to_and_fro*size(points)*range
   end function goes_round_once

   elemental real(wp) function angle_of(z)
      complex(wp), intent(in) :: z
      angle_of = atan2(z%im, z%re)
   end function angle_of
end module revolution_points
