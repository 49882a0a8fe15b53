!> Branches of solutions over a parameter, by pseudo-arclength: from a solution a step along the tangent, and back to
!> the branch in the plane across it by Newton's method, so that a branch is followed where it turns back (a fold).
module continuation
   use kinds, only: wp
   use errors, only: error_type, stopped
   use newton_method, only: branch_problem_type, branch_point_type, newton_options, correct, return_to
   implicit none (type, external)
   private
   public :: branch_options, start_branch, advance

   type, extends(newton_options) :: branch_options
      !> First and longest step along the branch.
      real(wp) :: first_step = 0.01_wp, max_step = 0.1_wp
      !> The parameter stays between these.
      real(wp) :: low = -huge(1.0_wp), high = huge(1.0_wp)
   end type branch_options

   !> Shortest step over the first.
   real(wp), parameter :: shortest = 1e-4_wp
   !> Rounds up to which a step may be followed by a longer one, and from which by a shorter one; cosine of the largest
   !> turn of the tangent in a step.
   integer, parameter :: quick = 5, slow = 9
   real(wp), parameter :: longer = 1.5_wp, shorter = 0.7_wp, largest_turn = 0.8_wp
   !> Longest way in the plane from the place where a point is sought, over the step. A branch that turns evenly by the
   !> largest turn comes to 0.32: what is further away belongs to another part of it, behind two folds.
   real(wp), parameter :: farthest = 0.35_wp

contains

   !> The first point of a branch, next to where a problem stands and at the same value of the parameter; its tangent
   !> leads to larger or smaller values.
   subroutine start_branch(problem, options, upwards, point, error)
      class(branch_problem_type), intent(inout) :: problem
      type(branch_options), intent(in) :: options
      logical, intent(in) :: upwards
      type(branch_point_type), intent(out) :: point
      type(error_type), allocatable, intent(out) :: error
      call correct(problem, options, point, error, across_parameter(problem, upwards))
   end subroutine start_branch

   !> The direction of the parameter alone.
   pure function across_parameter(problem, upwards) result(normal)
      class(branch_problem_type), intent(in) :: problem
      logical, intent(in) :: upwards
      real(wp) :: normal(problem%n + 1)
      normal = 0
      normal(problem%n + 1) = merge(1.0_wp, -1.0_wp, upwards)
   end function across_parameter

   !> From a point, at which the problem stands, to the next, where it stands then; `length` is that of the step, and
   !> becomes that for the next one. `ends` where the parameter has come to one of its bounds, or to within a shortest
   !> step of it. An error where no next point was found: at the shortest step, or, of status `stopped`, as the options
   !> say.
   subroutine advance(problem, options, here, length, next, ends, error)
      class(branch_problem_type), intent(inout) :: problem
      type(branch_options), intent(in) :: options
      type(branch_point_type), intent(in) :: here
      real(wp), intent(inout) :: length
      type(branch_point_type), intent(out) :: next
      logical, intent(out) :: ends
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: predicted
      logical :: again
      do
         length = min(length, options%max_step)
         predicted = here%parameter + problem%unit*length*here%tangent(problem%n + 1)
         ends = beyond(predicted)
         if (ends) then
            call reach(problem, options, here, next, error)
         else
            call problem%predict(length*here%tangent)
            call correct(problem, options, next, error, here%tangent)
            next%along = length
            if (.not. allocated(error)) ends = beyond(next%parameter)
            if (ends) then
               call return_to(problem, here)
               call reach(problem, options, here, next, error)
            end if
         end if
         again = allocated(error)
         if (.not. again) again = (problem%dot(here%tangent, next%tangent) < largest_turn &
            & .or. next%distance > farthest*next%along) .and. length > shortest*options%first_step
         if (.not. again) exit
         if (allocated(error)) then
            if (error%status == stopped .or. length <= shortest*options%first_step) return
         end if
         call return_to(problem, here)
         if (ends) length = min(length, abs(to_bound(problem, options, here)))
         length = 0.5_wp*length
      end do
      next%arc_length = here%arc_length + next%along
      ! at the bound itself equations that leap may have no solution
      if (.not. ends) ends = to_bound(problem, options, next) <= shortest*options%first_step
      if (next%iterations <= quick) length = longer*length
      if (next%iterations >= slow) length = shorter*length

   contains

      pure logical function beyond(parameter)
         real(wp), intent(in) :: parameter
         beyond = parameter >= options%high .or. parameter <= options%low
      end function beyond
   end subroutine advance

   !> Length along the tangent of a point to the bound that it leads to.
   pure real(wp) function to_bound(problem, options, here) result(length)
      class(branch_problem_type), intent(in) :: problem
      type(branch_options), intent(in) :: options
      type(branch_point_type), intent(in) :: here
      associate (slope => problem%unit*here%tangent(problem%n + 1))
         length = (merge(options%high, options%low, slope > 0) - here%parameter)/slope
      end associate
   end function to_bound

   !> From a point to that of its branch at the bound of the parameter to which it leads.
   subroutine reach(problem, options, here, next, error)
      class(branch_problem_type), intent(inout) :: problem
      type(branch_options), intent(in) :: options
      type(branch_point_type), intent(in) :: here
      type(branch_point_type), intent(out) :: next
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: length
      logical :: upwards
      upwards = here%tangent(problem%n + 1) > 0
      length = to_bound(problem, options, here)
      call problem%predict(length*here%tangent)
      problem%parameter = merge(options%high, options%low, upwards)
      call correct(problem, options, next, error, across_parameter(problem, upwards))
      next%along = length
   end subroutine reach
end module continuation
