!> A periodic orbit as polynomials: over the time of one period a mesh, and on each of its intervals a polynomial
!> through its start and the three points of Radau.
module orbit_polynomials
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: orbit_type, points, place

   !> Points of an interval.
   integer, parameter :: points = 3
   real(wp), parameter :: s6 = sqrt(6.0_wp)
   !> Where the points stand in an interval.
   real(wp), parameter :: place(points) = [(4 - s6)/10, (4 + s6)/10, 1.0_wp]

   type :: orbit_type
      !> Ends of the intervals, s, (0:intervals).
      real(wp), allocatable :: time(:)
      !> Which of the model's switching points the orbit passes at each end, (0:intervals); 0: none; -1: one that lost
      !> its place.
      integer, allocatable :: switching_point(:)
      !> State at the start of the period; states at the points, (state, point, interval): the last point of an interval
      !> is its end.
      real(wp), allocatable :: start(:), at(:, :, :)
      !> Characteristic scale of each state.
      real(wp), allocatable :: scale(:)
      !> What the state at the start's change does to the state a period later, over the scales: it has the multipliers
      !> as eigenvalues.
      real(wp), allocatable :: monodromy(:, :)
      !> Newton's last correction, over the scales.
      real(wp) :: correction = huge(1.0_wp)
   contains
      procedure :: intervals
      procedure :: gap
      procedure :: end => end_state
      procedure :: state_at
      procedure :: change_mesh
      procedure :: set_mesh
   end type orbit_type

contains

   pure integer function intervals(self)
      class(orbit_type), intent(in) :: self
      intervals = size(self%at, 3)
   end function intervals

   !> By how much the end misses the start, over the scales.
   pure function gap(self)
      class(orbit_type), intent(in) :: self
      real(wp) :: gap(size(self%start))
      gap = (self%end() - self%start)/self%scale
   end function gap

   !> The state at the end of the period.
   pure function end_state(self)
      class(orbit_type), intent(in) :: self
      real(wp) :: end_state(size(self%start))
      end_state = self%at(:, points, self%intervals())
   end function end_state

   !> The state y at a time of the period, s, and its rate along the polynomial there.
   pure subroutine state_at(self, t, y, rate)
      class(orbit_type), intent(in) :: self
      real(wp), intent(in) :: t
      real(wp), intent(out) :: y(:)
      real(wp), intent(out), optional :: rate(:)
      real(wp) :: x, factor(0:points), slope(0:points)
      integer :: k
      k = max(1, count(self%time(:self%intervals() - 1) < t))
      associate (h => self%time(k) - self%time(k - 1))
         x = (t - self%time(k - 1))/h
         call factors(x, factor, slope)
         if (present(rate)) call combine(slope/h, rate)
      end associate
      call combine(factor, y)

   contains

      !> The sum of the states of the interval, each times its factor.
      pure subroutine combine(factor, sum)
         real(wp), intent(in) :: factor(0:)
         real(wp), intent(out) :: sum(:)
         integer :: i
         if (k > 1) then
            sum = factor(0)*self%at(:, points, k - 1)
         else
            sum = factor(0)*self%start
         end if
         do i = 1, points
            sum = sum + factor(i)*self%at(:, i, k)
         end do
      end subroutine combine
   end subroutine state_at

   !> The polynomials of an interval's start and points at x, 0 to 1, and their slopes.
   pure subroutine factors(x, factor, slope)
      real(wp), intent(in) :: x
      real(wp), intent(out) :: factor(0:), slope(0:)
      real(wp), parameter :: nodes(0:points) = [0.0_wp, place]
      integer :: i, j
      factor = 1
      slope = 0
      do i = 0, points
         do j = 0, points
            if (j == i) cycle
            slope(i) = (slope(i)*(x - nodes(j)) + factor(i))/(nodes(i) - nodes(j))
            factor(i) = factor(i)*(x - nodes(j))/(nodes(i) - nodes(j))
         end do
      end do
   end subroutine factors

   !> Puts the same motion on intervals that end at other times, s; the first and the last stay. Switching points at
   !> them, as in the component; none if they are not given.
   pure subroutine change_mesh(self, time, switching_point)
      class(orbit_type), intent(inout) :: self
      real(wp), intent(in) :: time(0:)
      integer, intent(in), optional :: switching_point(0:)
      real(wp), allocatable :: at(:, :, :)
      integer :: k, i
      allocate (at(size(self%start), points, ubound(time, 1)))
      do k = 1, ubound(time, 1)
         do i = 1, points
            call self%state_at(time(k - 1) + place(i)*(time(k) - time(k - 1)), at(:, i, k))
         end do
      end do
      call self%set_mesh(time, at, switching_point)
   end subroutine change_mesh

   !> Takes ends of intervals, s, and the states at their points; switching points as for `change_mesh`.
   pure subroutine set_mesh(self, time, at, switching_point)
      class(orbit_type), intent(inout) :: self
      real(wp), intent(in) :: time(0:), at(:, :, :)
      integer, intent(in), optional :: switching_point(0:)
      if (allocated(self%time)) deallocate (self%time, self%switching_point)
      allocate (self%time(0:ubound(time, 1)), source=time)
      allocate (self%switching_point(0:ubound(time, 1)), source=0)
      if (present(switching_point)) self%switching_point(:) = switching_point
      self%at = at
      self%correction = huge(self%correction)
   end subroutine set_mesh
end module orbit_polynomials
