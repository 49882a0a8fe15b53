!> Where a branch changes its stability or turns: between two points of it the value that crosses is followed until the
!> parameter is known closely.
module bifurcations
   use kinds, only: wp
   use errors, only: error_type, stopped
   use roots, only: root_bracket
   use newton_method, only: branch_problem_type, branch_point_type, correct, return_to
   use continuation, only: branch_options
   implicit none (type, external)
   private
   public :: bifurcation_type, find_bifurcations, kinds_of_points, kind_length

   !> Length of the names of kinds, and all names.
   integer, parameter :: kind_length = 15
   character(len=kind_length), parameter :: kinds_of_points(*) = [character(len=kind_length) :: 'fold', &
      & 'period_doubling', 'neimark_sacker', 'hopf', 'branch_point', 'divergence']

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
         call locate(problem, options, here, next, max(k, k + sign(1, last - first)), one, ok, error)
         if (allocated(error)) return
         if (ok) then
            one%destabilises = last > first
            one%kind = problem%kind(one%value)
            if (one%kind == 'fold' .and. .not. turns_back) one%kind = 'branch_point'
            call put(one, found)
         end if
         k = k + sign(merge(2, 1, abs(one%value%im) > 0 .and. ok), last - first)
         if ((last - first)*(last - k) < 0) exit
      end do
      if (turns_back .and. .not. any(found%kind == 'fold')) then
         call locate(problem, options, here, next, 0, one, ok, error)
         if (allocated(error)) return
         one%kind = 'fold'
         if (ok) call put(one, found)
      end if
      if (first /= last .or. turns_back) call return_to(problem, next)
   end subroutine find_bifurcations

   !> Adds a point where it belongs along the branch.
   pure subroutine put(one, found)
      type(bifurcation_type), intent(in) :: one
      type(bifurcation_type), allocatable, intent(inout) :: found(:)
      integer :: before, k
      before = count([(found(k)%point%along <= one%point%along, k=1, size(found))])
      found = [found(:before), one, found(before + 1:)]
   end subroutine put

   pure integer function unstable(point)
      type(branch_point_type), intent(in) :: point
      unstable = count(point%growth > 0)
   end function unstable

   pure real(wp) function parameter_part(point)
      type(branch_point_type), intent(in) :: point
      parameter_part = point%tangent(size(point%tangent))
   end function parameter_part

   !> Where, along the tangent of the first of two points, the k-th growth (0: the tangent's component along the
   !> parameter) is zero. `ok` is false where Newton's method fails on the way.
   subroutine locate(problem, options, here, next, k, found, ok, error)
      class(branch_problem_type), intent(inout) :: problem
      type(branch_options), intent(in) :: options
      type(branch_point_type), intent(in) :: here, next
      integer, intent(in) :: k
      type(bifurcation_type), intent(out) :: found
      logical, intent(out) :: ok
      type(error_type), allocatable, intent(out) :: error
      type(root_bracket) :: bracket
      type(branch_point_type) :: point
      real(wp) :: along, value
      integer :: cut
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
         if (bracket%width() <= closeness*next%along .and. bracket%width()*problem%unit*abs(parameter_part(point)) &
            & <= accuracy*max(abs(point%parameter), problem%unit)) exit
      end do
      point%arc_length = here%arc_length + point%along
      found%point = point
      found%value = point%values(max(1, k))
   end subroutine locate

   pure real(wp) function watched(point, k)
      type(branch_point_type), intent(in) :: point
      integer, intent(in) :: k
      if (k == 0) then
         watched = parameter_part(point)
      else
         watched = point%growth(k)
      end if
   end function watched
end module bifurcations
