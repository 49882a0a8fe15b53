!> Branches of solutions over a parameter, by pseudo-arclength: from a solution a step along the tangent, and back to
!> the branch in the plane across it by Newton's method, so that a branch is followed where it turns back (a fold); and
!> the points where it changes its stability or turns.
module continuation
   use kinds, only: wp
   use errors, only: error_type, stopped
   use newton_method, only: branch_problem_type, branch_point_type, newton_options, correct, return_to
   use roots, only: root_bracket
   implicit none (type, external)
   private
   public :: branch_options, start_branch, advance, bifurcation_type, find_bifurcations, find_first, &
      & kinds_of_points, kind_length

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

   !> Length of the names of kinds, and all names.
   integer, parameter :: kind_length = 16
   character(len=kind_length), parameter :: kinds_of_points(*) = [character(len=kind_length) :: 'fold', &
      & 'period_doubling', 'neimark_sacker', 'hopf', 'branch_point', 'divergence', 'double_hopf', 'fold_hopf', &
      & 'bogdanov_takens', 'cusp', 'resonance_1_1', 'resonance_1_2', 'generalised_hopf']

   type :: bifurcation_type
      character(len=kind_length) :: kind = ''
      type(branch_point_type) :: point
      !> The value that crosses, whether it does so towards the unstable side.
      complex(wp) :: value = 0
      logical :: destabilises = .false.
   end type bifurcation_type

   !> The bracket of the parameter, over its size or its natural change, at the end; that of the way along the branch,
   !> over the step; most cuts.
   real(wp), parameter :: accuracy = 1e-7_wp, closeness = 1e-6_wp
   integer, parameter :: most_cuts = 40
   !> Most bifurcation points between two points.
   integer, parameter :: most_points = 4

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

   !> Whether a branch begins at a point, across the parameter, whose change is known behind it alone: with friction it
   !> may grow with the branch at once.
   pure logical function begins_across(problem, point)
      class(branch_problem_type), intent(in) :: problem
      type(branch_point_type), intent(in) :: point
      begins_across = .not. abs(point%tangent(problem%n + 1)) > 0
   end function begins_across

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
            call reach()
         else
            call problem%predict(length*here%tangent)
            call correct(problem, options, next, error, here%tangent)
            next%along = length
            if (.not. allocated(error)) ends = beyond(next%parameter)
            if (ends) then
               call return_to(problem, here)
               call reach()
            end if
         end if
         again = allocated(error)
         if (.not. (again .or. begins_across(problem, here))) again = (problem%dot(here%tangent, next%tangent) &
            & < largest_turn .or. next%distance > farthest*next%along) .and. length > shortest*options%first_step
         if (.not. again) exit
         if (allocated(error)) then
            if (error%status == stopped .or. length <= shortest*options%first_step) return
         end if
         call return_to(problem, here)
         if (ends) length = min(length, abs(to_bound(here)))
         length = 0.5_wp*length
      end do
      next%arc_length = here%arc_length + next%along
      ! at the bound itself equations that leap may have no solution
      if (.not. ends) ends = to_bound(next) <= shortest*options%first_step
      if (next%iterations <= quick) length = longer*length
      if (next%iterations >= slow) length = shorter*length

   contains

      pure logical function beyond(parameter)
         real(wp), intent(in) :: parameter
         beyond = parameter >= options%high .or. parameter <= options%low
      end function beyond

      !> Length along the tangent of a point to the bound that it leads to.
      pure real(wp) function to_bound(point)
         type(branch_point_type), intent(in) :: point
         associate (slope => problem%unit*point%tangent(problem%n + 1))
            to_bound = (merge(options%high, options%low, slope > 0) - point%parameter)/slope
         end associate
      end function to_bound

      !> From `here` to the point of its branch at the bound of the parameter to which it leads.
      subroutine reach()
         real(wp) :: way
         logical :: upwards
         upwards = here%tangent(problem%n + 1) > 0
         way = to_bound(here)
         call problem%predict(way*here%tangent)
         problem%parameter = merge(options%high, options%low, upwards)
         call correct(problem, options, next, error, across_parameter(problem, upwards))
         next%along = way
      end subroutine reach
   end subroutine advance

   ! Where a branch changes its stability or turns: between two points of it the value that crosses is followed until
   ! the parameter is known closely.

   !> The bifurcation points between a point and the next, at which the problem stands before and after, in their order.
   !> What cannot be located is left out; an error only of status `stopped`.
   subroutine find_bifurcations(problem, options, here, next, found, error)
      class(branch_problem_type), intent(inout) :: problem
      type(branch_options), intent(in) :: options
      type(branch_point_type), intent(in) :: here, next
      type(bifurcation_type), allocatable, intent(out) :: found(:)
      type(error_type), allocatable, intent(out) :: error
      type(bifurcation_type) :: one
      integer :: first, last, k
      logical :: ok, turns_back
      allocate (found(0))
      turns_back = parameter_part(here)*parameter_part(next) < 0
      first = unstable(here)
      last = unstable(next)
      ! each value that crosses is one of the order of growths
      k = first
      do while (k /= last .and. size(found) < most_points)
         call locate(max(k, k + sign(1, last - first)))
         if (allocated(error)) return
         if (ok) then
            one%destabilises = last > first
            one%kind = problem%kind(one%value)
            if (one%kind == 'fold' .and. .not. turns_back) one%kind = 'branch_point'
            call put()
         end if
         k = k + sign(merge(2, 1, abs(one%value%im) > 0 .and. ok), last - first)
         if ((last - first)*(last - k) < 0) exit
      end do
      if (turns_back .and. .not. any(found%kind == 'fold')) then
         call locate(0)
         if (allocated(error)) return
         one%kind = 'fold'
         if (ok) call put()
      end if
      if (first /= last .or. turns_back) call return_to(problem, next)
   contains

      !> Adds a point where it belongs along the branch.
      subroutine put()
         integer :: before, l
         before = count([(found(l)%point%along <= one%point%along, l=1, size(found))])
         found = [found(:before), one, found(before + 1:)]
      end subroutine put

      !> Where, along the tangent of `here`, the k-th growth (0: the tangent's component along the parameter) is zero.
      !> Not ok where Newton's method fails on the way.
      subroutine locate(k)
         integer, intent(in) :: k
         type(root_bracket) :: bracket
         type(branch_point_type) :: point
         real(wp) :: along, value
         integer :: cut
         one = bifurcation_type()
         bracket = root_bracket([0.0_wp, next%along], [watched(here, k), watched(next, k)])
         call return_to(problem, next)
         point = next
         do cut = 1, most_cuts
            along = bracket%estimate()
            associate (tangent => point%tangent/problem%dot(here%tangent, point%tangent))
               call problem%move((along - point%along)*tangent, .false.)
            end associate
            call correct(problem, options, point, error, here%tangent)
            ok = .not. allocated(error)
            if (.not. ok) then
               if (error%status /= stopped) deallocate (error)
               return
            end if
            point%along = along
            value = watched(point, k)
            call bracket%narrow(along, value)
            if (abs(value) <= 0) exit
            if (bracket%width() <= closeness*next%along .and. bracket%width()*problem%unit &
               & *abs(parameter_part(point)) <= accuracy*max(abs(point%parameter), problem%unit)) exit
         end do
         point%arc_length = here%arc_length + point%along
         one%point = point
         one%value = point%values(max(1, k))
      end subroutine locate
   end subroutine find_bifurcations

   !> Follows a branch from a point, at which a problem stands, to the first bifurcation point of a kind, at which it
   !> stands then; without a kind where there is none up to the bound of the parameter. `here` is then the last point.
   subroutine find_first(problem, options, kind, here, length, found, error)
      class(branch_problem_type), intent(inout) :: problem
      type(branch_options), intent(in) :: options
      character(len=*), intent(in) :: kind
      type(branch_point_type), intent(inout) :: here
      real(wp), intent(inout) :: length
      type(bifurcation_type), intent(out) :: found
      type(error_type), allocatable, intent(out) :: error
      type(bifurcation_type), allocatable :: special(:)
      type(branch_point_type) :: next
      integer :: k
      logical :: ends
      ends = .false.
      do while (.not. ends)
         call advance(problem, options, here, length, next, ends, error)
         if (allocated(error)) return
         allocate (special(0))
         ! where cycles begin one more multiplier is 1
         if (.not. begins_across(problem, here)) call find_bifurcations(problem, options, here, next, special, error)
         if (allocated(error)) return
         here = next
         k = findloc(special%kind, kind, dim=1)
         if (k > 0) then
            found = special(k)
            call return_to(problem, found%point)
            return
         end if
         deallocate (special)
      end do
   end subroutine find_first

   pure integer function unstable(point)
      type(branch_point_type), intent(in) :: point
      unstable = count(point%growth > 0)
   end function unstable

   pure real(wp) function parameter_part(point)
      type(branch_point_type), intent(in) :: point
      parameter_part = point%tangent(size(point%tangent))
   end function parameter_part

   pure real(wp) function watched(point, k)
      type(branch_point_type), intent(in) :: point
      integer, intent(in) :: k
      if (k == 0) then
         watched = parameter_part(point)
      else
         watched = point%growth(k)
      end if
   end function watched
end module continuation
