!> Branches of orbits of double period, which begin at a period doubling.
module doubled_orbit
   use kinds, only: wp
   use linear_algebra, only: solve
   use newton_method, only: branch_point_type, return_to
   use orbit_polynomials, only: orbit_type, points
   use orbit_problem, only: orbit_problem_type
   implicit none (type, external)
   private
   public :: double_period, half_apart

contains

   !> From a period doubling of a problem: the point of the branch of double period there, on which the problem stands
   !> then. Its tangent is the disturbance that comes back with the opposite sign after a period; of a limit cycle what
   !> of it is across the motion, as its start moves.
   subroutine double_period(problem, period_doubling, point, ok)
      class(orbit_problem_type), intent(inout) :: problem
      type(branch_point_type), intent(in) :: period_doubling
      type(branch_point_type), intent(out) :: point
      logical, intent(out) :: ok
      type(orbit_type) :: twice
      real(wp) :: direction(problem%states()), matrix(problem%states(), problem%states())
      integer :: i, n
      call return_to(problem, period_doubling)
      direction = 1
      do i = 1, 3
         matrix = problem%orbit%monodromy
         do n = 1, size(direction)
            matrix(n, n) = matrix(n, n) + 1
         end do
         call solve(size(direction), 1, matrix, direction, ok)
         if (.not. ok) return
         direction = problem%across_motion(direction)
         direction = direction/sqrt(sum(problem%weight(:size(direction))*direction**2))
      end do
      n = problem%orbit%intervals()
      associate (orbit => problem%orbit, time => problem%orbit%time, switching_point => problem%orbit%switching_point)
         twice = orbit
         call twice%set_mesh([time, time(n) + time(1:)], reshape([orbit%at, orbit%at], &
            & [size(direction), points, 2*n]), [switching_point, switching_point(1:)])
      end associate
      problem%orbit = twice
      problem%period_multiple = 2*problem%period_multiple
      call problem%get_place(point%place)
      allocate (point%change(problem%n + 1), source=0.0_wp)
      allocate (point%tangent(problem%n + 1), source=0.0_wp)
      point%tangent(:size(direction)) = direction
      point%parameter = period_doubling%parameter
      call return_to(problem, point)
      call problem%spectrum(point%values, point%growth, ok)
   end subroutine double_period

   !> By how much an orbit is elsewhere half a period later, in the measure of the branch: by nothing where it is that
   !> of half the period.
   pure function half_apart(problem)
      class(orbit_problem_type), intent(in) :: problem
      real(wp), allocatable :: half_apart(:)
      real(wp) :: y(problem%states())
      associate (orbit => problem%orbit)
         call orbit%state_at(0.5_wp*orbit%time(orbit%intervals()), y)
         half_apart = problem%weight(:size(y))*(y - orbit%start)/orbit%scale
      end associate
   end function half_apart
end module doubled_orbit
