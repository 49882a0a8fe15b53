!> Branches of solutions over a parameter, by pseudo-arclength: from a solution a step along the tangent, and back to
!> the branch in the plane across it by Newton's method, so that a branch is followed where it turns back (a fold). What
!> is solved is a problem that stands somewhere, knows its equations there and can be moved.
module continuation
   use kinds, only: wp
   use text, only: to_text
   use errors, only: error_type, raise, add_context, numerics_error, stopped
   use lapack, only: dgesv
   use damped_newton, only: asked_to_stop, asked
   implicit none (type, external)
   private
   public :: branch_problem_type, branch_point_type, branch_options, start_branch, advance, correct, return_to
   public :: can_be_of

   !> n unknowns and a parameter. All changes are over the natural sizes of what changes.
   type, abstract :: branch_problem_type
      integer :: n = 0
      !> Present value of the parameter, and natural size of its changes.
      real(wp) :: parameter = 0, unit = 1
      !> How much each unknown counts in the length of a branch, where the parameter counts 1.
      real(wp), allocatable :: weight(:)
      !> Whether the last error of `linearize` says that there can be no solution here: no Newton's method would help.
      logical :: refused = .false.
   contains
      procedure(linearize_problem), deferred :: linearize
      procedure(move_problem), deferred :: move
      procedure :: predict
      procedure, non_overridable :: dot
      procedure(find_spectrum), deferred :: spectrum
      procedure(name_kind), deferred :: kind
      procedure(take_place), deferred :: get_place
      procedure(put_place), deferred :: go_to
      procedure :: fits
   end type branch_problem_type

   abstract interface
      !> The equations where the problem stands: matrix x = b for the change x of unknowns and parameter, (n, n + 1).
      subroutine linearize_problem(self, matrix, b, error)
         import :: branch_problem_type, error_type, wp
         class(branch_problem_type), intent(inout) :: self
         real(wp), intent(out) :: matrix(:, :), b(:)
         type(error_type), allocatable, intent(out) :: error
      end subroutine linearize_problem

      !> Moves the problem, which was linearised, by a change of unknowns and parameter. One that `closes` solves these
      !> equations; the tangent and its multiples do not.
      subroutine move_problem(self, change, closes, correction)
         import :: branch_problem_type, wp
         class(branch_problem_type), intent(inout) :: self
         real(wp), intent(in) :: change(:)
         logical, intent(in) :: closes
         !> The largest change of all that moved.
         real(wp), intent(out) :: correction
      end subroutine move_problem

      !> What tells stability at a solution, as it was linearised last, and how far each value is on the unstable side;
      !> in the order of this, the largest first.
      subroutine find_spectrum(self, values, growth, ok)
         import :: branch_problem_type, wp
         class(branch_problem_type), intent(inout) :: self
         complex(wp), allocatable, intent(out) :: values(:)
         real(wp), allocatable, intent(out) :: growth(:)
         logical, intent(out) :: ok
      end subroutine find_spectrum

      !> What happens where this value crosses to the other side; 'fold' where the branch turns or another crosses it.
      pure function name_kind(self, value) result(kind)
         import :: branch_problem_type, wp
         class(branch_problem_type), intent(in) :: self
         complex(wp), intent(in) :: value
         character(len=:), allocatable :: kind
      end function name_kind

      !> All that a problem needs to stand where it stands, as numbers.
      pure subroutine take_place(self, place)
         import :: branch_problem_type, wp
         class(branch_problem_type), intent(in) :: self
         real(wp), allocatable, intent(out) :: place(:)
      end subroutine take_place

      subroutine put_place(self, place)
         import :: branch_problem_type, wp
         class(branch_problem_type), intent(inout) :: self
         real(wp), intent(in) :: place(:)
      end subroutine put_place
   end interface

   type :: branch_point_type
      real(wp) :: parameter = 0
      !> Length of the branch up to here, and of its last step along the tangent there.
      real(wp) :: arc_length = 0, along = 0
      !> Where the equations were linearised last, and the correction from there: so a point is found again to the last
      !> bit. Unit tangent.
      real(wp), allocatable :: place(:), change(:), tangent(:)
      complex(wp), allocatable :: values(:)
      real(wp), allocatable :: growth(:)
      !> Rounds of Newton's method; the last correction.
      integer :: iterations = 0
      real(wp) :: correction = huge(1.0_wp)
   end type branch_point_type

   type :: branch_options
      !> Newton's last correction; most rounds of a step.
      real(wp) :: tolerance = 1e-8_wp
      integer :: max_iterations = 20
      !> First and longest step along the branch.
      real(wp) :: first_step = 0.01_wp, max_step = 0.1_wp
      !> The parameter stays between these.
      real(wp) :: low = -huge(1.0_wp), high = huge(1.0_wp)
   end type branch_options

   !> Longest correction that is made: what is further away is sought by a shorter step.
   real(wp), parameter :: longest = 0.5_wp
   !> Shortest step over the first.
   real(wp), parameter :: shortest = 1e-4_wp
   !> Rounds up to which a step may be followed by a longer one, and from which by a shorter one; cosine of the largest
   !> turn of the tangent in a step.
   integer, parameter :: quick = 5, slow = 9
   real(wp), parameter :: longer = 1.5_wp, shorter = 0.7_wp, largest_turn = 0.8_wp

contains

   !> Whether numbers that come from elsewhere can be a place: as many as those where the problem stands.
   pure logical function fits(self, place)
      class(branch_problem_type), intent(in) :: self
      real(wp), intent(in) :: place(:)
      real(wp), allocatable :: here(:)
      call self%get_place(here)
      fits = size(place) == size(here)
   end function fits

   !> Whether a point that comes from elsewhere can be one of a problem's branches.
   pure logical function can_be_of(problem, point) result(can)
      class(branch_problem_type), intent(in) :: problem
      type(branch_point_type), intent(in) :: point
      can = size(point%change) == problem%n + 1 .and. size(point%tangent) == problem%n + 1
      if (can) can = problem%fits(point%place)
   end function can_be_of

   !> Moves by a step along the tangent to where the next point is sought. A problem may do more, once for each point.
   subroutine predict(self, change)
      class(branch_problem_type), intent(inout) :: self
      real(wp), intent(in) :: change(:)
      real(wp) :: ignored
      call self%move(change, .false., ignored)
   end subroutine predict

   !> The product of two directions.
   pure real(wp) function dot(self, a, b)
      class(branch_problem_type), intent(in) :: self
      real(wp), intent(in) :: a(:), b(:)
      associate (n => self%n)
         dot = sum(self%weight*a(:n)*b(:n)) + a(n + 1)*b(n + 1)
      end associate
   end function dot

   !> The first point of a branch, next to where a problem stands and at the same value of the parameter; its tangent
   !> leads to larger or smaller values.
   subroutine start_branch(problem, options, upwards, point, error, give_up)
      class(branch_problem_type), intent(inout) :: problem
      type(branch_options), intent(in) :: options
      logical, intent(in) :: upwards
      type(branch_point_type), intent(out) :: point
      type(error_type), allocatable, intent(out) :: error
      procedure(asked_to_stop), optional :: give_up
      call correct(problem, across_parameter(problem, upwards), options, point, error, give_up)
   end subroutine start_branch

   !> The direction of the parameter alone.
   pure function across_parameter(problem, upwards) result(normal)
      class(branch_problem_type), intent(in) :: problem
      logical, intent(in) :: upwards
      real(wp) :: normal(problem%n + 1)
      normal = 0
      normal(problem%n + 1) = merge(1.0_wp, -1.0_wp, upwards)
   end function across_parameter

   !> Newton's method in the plane through where the problem stands, across `normal`.
   subroutine correct(problem, normal, options, point, error, give_up)
      class(branch_problem_type), intent(inout) :: problem
      real(wp), intent(in) :: normal(:)
      type(branch_options), intent(in) :: options
      type(branch_point_type), intent(out) :: point
      type(error_type), allocatable, intent(out) :: error
      procedure(asked_to_stop), optional :: give_up
      real(wp) :: matrix(problem%n + 1, problem%n + 1), b(problem%n + 1, 2)
      integer :: pivots(problem%n + 1), info, n
      logical :: stops, ok
      n = problem%n
      point%iterations = 0
      do while (point%correction > options%tolerance)
         stops = asked(give_up)
         if (stops) then
            call raise(error, stopped, 'asked to stop')
         else if (point%iterations == options%max_iterations) then
            call raise(error, numerics_error, 'Newton''s method stopped after '//to_text(point%iterations) &
               & //' iterations at a correction of '//to_text(point%correction)//' of the natural size of the states')
         end if
         if (allocated(error)) return
         point%iterations = point%iterations + 1
         call problem%get_place(point%place)
         b = 0
         call problem%linearize(matrix(:n, :), b(:n, 1), error)
         matrix(n + 1, :n) = problem%weight*normal(:n)
         matrix(n + 1, n + 1) = normal(n + 1)
         b(n + 1, 2) = 1
         if (.not. allocated(error)) then
            call dgesv(n + 1, 2, matrix, n + 1, pivots, b, n + 1, info)
            ok = info == 0
            if (ok) ok = all(abs(b) <= huge(b))
            if (.not. ok) call raise(error, numerics_error, 'the equations have no solution')
         end if
         if (.not. allocated(error)) then
            if (maxval(abs(b(:, 1))) > longest) call raise(error, numerics_error, 'the correction is ' &
               & //to_text(maxval(abs(b(:, 1))))//' of the natural size of the states')
         end if
         if (.not. problem%refused) call add_context(error, 'iteration '//to_text(point%iterations) &
            & //' of Newton''s method')
         if (allocated(error)) return
         point%change = b(:, 1)
         call problem%move(point%change, .true., point%correction)
      end do
      point%parameter = problem%parameter
      point%tangent = b(:, 2)/sqrt(problem%dot(b(:, 2), b(:, 2)))
      call problem%spectrum(point%values, point%growth, ok)
      if (.not. ok) call raise(error, numerics_error, 'the eigenvalues that tell stability were not found')
   end subroutine correct

   !> Takes a problem back to a point of its branch, linearised there as it was. An error where the point comes from
   !> elsewhere and is none of the branch.
   subroutine return_to(problem, point, refusal)
      class(branch_problem_type), intent(inout) :: problem
      type(branch_point_type), intent(in) :: point
      type(error_type), allocatable, intent(out), optional :: refusal
      real(wp) :: matrix(problem%n, problem%n + 1), b(problem%n), ignored
      type(error_type), allocatable :: error
      call problem%go_to(point%place)
      call problem%linearize(matrix, b, error)
      if (.not. allocated(error)) call problem%move(point%change, .true., ignored)
      problem%parameter = point%parameter
      if (present(refusal)) call move_alloc(error, refusal)
   end subroutine return_to

   !> From a point, at which the problem stands, to the next, where it stands then; `length` is that of the step, and
   !> becomes that for the next one. `ends` where the parameter has come to one of its bounds. An error where no next
   !> point was found: at the shortest step, or, of status `stopped`, because `give_up` said so.
   subroutine advance(problem, options, here, length, next, ends, error, give_up)
      class(branch_problem_type), intent(inout) :: problem
      type(branch_options), intent(in) :: options
      type(branch_point_type), intent(in) :: here
      real(wp), intent(inout) :: length
      type(branch_point_type), intent(out) :: next
      logical, intent(out) :: ends
      type(error_type), allocatable, intent(out) :: error
      procedure(asked_to_stop), optional :: give_up
      real(wp) :: predicted
      logical :: again
      do
         length = min(length, options%max_step)
         predicted = here%parameter + problem%unit*length*here%tangent(problem%n + 1)
         ends = beyond(predicted)
         if (ends) then
            call reach(problem, options, here, next, error, give_up)
         else
            call problem%predict(length*here%tangent)
            call correct(problem, here%tangent, options, next, error, give_up)
            next%along = length
            if (.not. allocated(error)) ends = beyond(next%parameter)
            if (ends) then
               call return_to(problem, here)
               call reach(problem, options, here, next, error, give_up)
            end if
         end if
         again = allocated(error)
         if (.not. again) again = problem%dot(here%tangent, next%tangent) < largest_turn &
            & .and. length > shortest*options%first_step
         if (.not. again) exit
         if (allocated(error)) then
            if (error%status == stopped .or. length <= shortest*options%first_step) return
         end if
         call return_to(problem, here)
         length = 0.5_wp*min(length, abs(next_length()))
      end do
      next%arc_length = here%arc_length + next%along
      if (next%iterations <= quick) length = longer*length
      if (next%iterations >= slow) length = shorter*length

   contains

      pure logical function beyond(parameter)
         real(wp), intent(in) :: parameter
         beyond = parameter >= options%high .or. parameter <= options%low
      end function beyond

      !> The length of the step that was tried.
      pure real(wp) function next_length()
         next_length = length
         if (ends) next_length = to_bound(problem, options, here)
      end function next_length
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
   subroutine reach(problem, options, here, next, error, give_up)
      class(branch_problem_type), intent(inout) :: problem
      type(branch_options), intent(in) :: options
      type(branch_point_type), intent(in) :: here
      type(branch_point_type), intent(out) :: next
      type(error_type), allocatable, intent(out) :: error
      procedure(asked_to_stop), optional :: give_up
      real(wp) :: length
      logical :: upwards
      upwards = here%tangent(problem%n + 1) > 0
      length = to_bound(problem, options, here)
      call problem%predict(length*here%tangent)
      problem%parameter = merge(options%high, options%low, upwards)
      call correct(problem, across_parameter(problem, upwards), options, next, error, give_up)
      next%along = length
   end subroutine reach
end module continuation
