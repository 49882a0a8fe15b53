!> Branches of orbits of double period, which begin at a period doubling.
module period_doubling
   use kinds, only: wp
   use linear_algebra, only: dgesv
   use newton_method, only: branch_point_type, return_to
   use orbit_polynomials, only: orbit_type, points
   use orbit_problem, only: orbit_problem_type, period_multiple_at
   implicit none (type, external)
   private
   public :: double_period, half_apart, forget_doublings

contains

   !> From a period doubling of a problem: the point of the branch of double period there, on which the problem stands
   !> then. Its tangent is the disturbance that comes back with the opposite sign after a period.
   subroutine double_period(problem, period_doubling, point, ok)
      type(orbit_problem_type), intent(inout) :: problem
      type(branch_point_type), intent(in) :: period_doubling
      type(branch_point_type), intent(out) :: point
      logical, intent(out) :: ok
      type(orbit_type) :: twice
      real(wp) :: direction(problem%n), matrix(problem%n, problem%n)
      integer :: pivots(problem%n), info, i, n
      call return_to(problem, period_doubling)
      direction = 1
      do i = 1, 3
         matrix = problem%orbit%monodromy
         do n = 1, problem%n
            matrix(n, n) = matrix(n, n) + 1
         end do
         call dgesv(problem%n, 1, matrix, problem%n, pivots, direction, problem%n, info)
         ok = info == 0
         if (.not. ok) return
         direction = direction/sqrt(sum(problem%weight*direction**2))
      end do
      n = problem%orbit%intervals()
      associate (orbit => problem%orbit, time => problem%orbit%time, switching_point => problem%orbit%switching_point)
         twice = orbit
         call twice%set_mesh([time, time(n) + time(1:)], reshape([orbit%at, orbit%at], [problem%n, points, 2*n]), &
            & [switching_point, switching_point(1:)])
      end associate
      problem%orbit = twice
      problem%period_multiple = 2*problem%period_multiple
      call problem%get_place(point%place)
      allocate (point%change(problem%n + 1), source=0.0_wp)
      point%tangent = [direction, 0.0_wp]
      point%parameter = period_doubling%parameter
      call return_to(problem, point)
      call problem%spectrum(point%values, point%growth, ok)
   end subroutine double_period

   !> By how much an orbit is elsewhere half a period later, in the measure of the branch: by nothing where it is that
   !> of half the period. Empty where the problem stands at no orbit.
   pure function half_apart(problem)
      type(orbit_problem_type), intent(in) :: problem
      real(wp), allocatable :: half_apart(:)
      real(wp) :: y(problem%n)
      half_apart = [real(wp) ::]
      if (problem%n == 0) return
      associate (orbit => problem%orbit)
         call orbit%state_at(0.5_wp*orbit%time(orbit%intervals()), y)
         half_apart = problem%weight*(y - orbit%start)/orbit%scale
      end associate
   end function half_apart

   !> A branch of double period, of orbits of this many revolutions, that ends at another period doubling between two
   !> points need not be followed from there again.
   pure subroutine forget_doublings(period_doublings, here, next, period_multiple)
      type(branch_point_type), allocatable, intent(inout) :: period_doublings(:)
      type(branch_point_type), intent(in) :: here, next
      integer, intent(in) :: period_multiple
      real(wp) :: step
      integer :: k
      step = abs(next%parameter - here%parameter)
      period_doublings = pack(period_doublings, [(abs(period_doublings(k)%parameter - next%parameter) > 2*step &
         & .or. 2*period_multiple_at(period_doublings(k)) /= period_multiple, &
         & k=1, size(period_doublings))])
   end subroutine forget_doublings
end module period_doubling
