!> Newton's method on a problem that stands somewhere, knows its equations there and can be moved: at the value that its
!> parameter has, or, for branches, with the parameter as one more unknown.
module newton_method
   use kinds, only: wp
   use text, only: to_text
   use errors, only: error_type, raise, add_context, numerics_error, stopped, asked_to_stop, asked
   use linear_algebra, only: solve
   implicit none (type, external)
   private
   public :: branch_problem_type, place_part_type, branch_point_type, curve_place_type, newton_options, correct
   public :: newton_iterations, return_to, can_be_of

   !> Numbers of a place, as a file names them.
   type :: place_part_type
      character(len=20) :: name = ''
      character(len=4) :: units = '1'
      character(len=64) :: long_name = ''
      real(wp), allocatable :: values(:)
   end type place_part_type

   !> n unknowns and a parameter. All changes are over the characteristic scales of what changes.
   type, abstract :: branch_problem_type
      integer :: n = 0
      !> Present value of the parameter, and characteristic scale of its changes.
      real(wp) :: parameter = 0, unit = 1
      !> How much each unknown counts in the length of a branch, where the parameter counts 1.
      real(wp), allocatable :: weight(:)
      !> The largest change of all that moved last.
      real(wp) :: correction = 0
      !> Whether the last error of `linearize` says that there can be no solution here: no Newton's method would help.
      logical :: refused = .false.
   contains
      procedure(linearize_problem), deferred :: linearize
      procedure(move_problem), deferred :: move
      procedure :: predict
      procedure :: solve => newton_iterations
      procedure, non_overridable :: dot
      procedure(find_spectrum), deferred :: spectrum
      procedure(name_kind), deferred :: kind
      procedure(take_place), deferred :: get_place
      procedure(put_place), deferred :: go_to
      procedure :: fits
      procedure :: birth
   end type branch_problem_type

   abstract interface
      !> The equations where the problem stands: matrix x = b for the change x of the unknowns, (n, n), or of unknowns
      !> and parameter, (n, n + 1).
      subroutine linearize_problem(self, matrix, b, error)
         import :: branch_problem_type, error_type, wp
         class(branch_problem_type), intent(inout) :: self
         real(wp), intent(out) :: matrix(:, :), b(:)
         type(error_type), allocatable, intent(out) :: error
      end subroutine linearize_problem

      !> Moves the problem, which was linearised, by a change of unknowns and, if there is one more, the parameter. One
      !> that `closes` solves these equations; the tangent and its multiples do not.
      subroutine move_problem(self, change, closes)
         import :: branch_problem_type, wp
         class(branch_problem_type), intent(inout) :: self
         real(wp), intent(in) :: change(:)
         logical, intent(in) :: closes
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

      !> All that a problem needs to stand where it stands.
      pure subroutine take_place(self, place)
         import :: branch_problem_type, place_part_type
         class(branch_problem_type), intent(in) :: self
         type(place_part_type), allocatable, intent(out) :: place(:)
      end subroutine take_place

      subroutine put_place(self, place)
         import :: branch_problem_type, place_part_type
         class(branch_problem_type), intent(inout) :: self
         type(place_part_type), intent(in) :: place(:)
      end subroutine put_place
   end interface

   !> What a point of a curve of bifurcation points has more; places are in the plane of both parameters.
   type :: curve_place_type
      !> The line through the point whose branch was followed: where its parameter is 0, and its direction. Direction of
      !> the curve.
      real(wp) :: origin(2) = 0, line(2) = [1, 0], ahead(2) = [0, 1]
      !> Where the curve leads: part along that branch, part ahead; how far it turns in a step, over its square; slope
      !> of what is 0 on the curve.
      real(wp) :: direction(2) = [0, 1], turn = 0, slope = 0
      !> The value that has come to the border of stability; what is 0 at points of codimension two; 1 or -1: larger or
      !> smaller values of the first parameter are stable, or have the solutions that meet in a fold.
      complex(wp) :: value = 0
      real(wp) :: tests(5) = 0, stable_side = 0
      !> Whether all other values are stable.
      logical :: others_stable = .true.
   end type curve_place_type

   type :: branch_point_type
      real(wp) :: parameter = 0
      !> Length of the branch up to here, and of its last step along the tangent there.
      real(wp) :: arc_length = 0, along = 0
      !> Where the equations were linearised last, and the correction from there: so a point is found again to the last
      !> bit. Unit tangent.
      type(place_part_type), allocatable :: place(:)
      real(wp), allocatable :: change(:), tangent(:)
      complex(wp), allocatable :: values(:)
      real(wp), allocatable :: growth(:)
      !> Rounds of Newton's method; the last correction; in a plane, the length of the way from where it was sought.
      integer :: iterations = 0
      real(wp) :: correction = huge(1.0_wp), distance = 0
      type(curve_place_type) :: curve
   end type branch_point_type

   type :: newton_options
      !> What Newton's method may leave, over the characteristic scales; most rounds.
      real(wp) :: tolerance = 1e-8_wp
      integer :: max_iterations = 20
      !> Asked before each round, where it is set.
      procedure(asked_to_stop), pointer, nopass :: give_up => null()
   end type newton_options

   !> Longest correction that is made: of a longer one a part, and in a plane none, as a shorter step is better.
   real(wp), parameter :: longest = 0.5_wp
   !> Iterations in which a correction that is longer must fall by half. Shorter ones may fall slowly, where places at
   !> which the derivatives jump go from interval to interval.
   integer, parameter :: looked_at_iterations = 8
   !> Iterations after which the first corrections of a method that converges have become short: less than 0.01 in
   !> whatever was tried.
   integer, parameter :: first_iterations = 4

contains

   !> Whether a place that comes from elsewhere can be one of a problem: it has as many numbers as where this stands.
   pure logical function fits(self, place)
      class(branch_problem_type), intent(in) :: self
      type(place_part_type), intent(in) :: place(:)
      type(place_part_type), allocatable :: here(:)
      integer :: k
      call self%get_place(here)
      fits = all([(size(place(k)%values) == size(here(k)%values), k=1, size(here))])
   end function fits

   !> Above 0 where small cycles that begin where this value crosses lie where what was stable still is, below 0 where
   !> it is not any longer; 0 where that is not known.
   real(wp) function birth(self, value)
      class(branch_problem_type), intent(inout) :: self
      complex(wp), intent(in) :: value
      birth = 0*self%unit*value%re
   end function birth

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
      call self%move(change, .false.)
   end subroutine predict

   !> The product of two directions.
   pure real(wp) function dot(self, a, b)
      class(branch_problem_type), intent(in) :: self
      real(wp), intent(in) :: a(:), b(:)
      associate (n => self%n)
         dot = sum(self%weight*a(:n)*b(:n)) + a(n + 1)*b(n + 1)
      end associate
   end function dot

   !> Newton's method at the value of the parameter where the problem stands, or in the plane through this place across
   !> `normal`. The plane belongs to a step along a branch: far corrections are refused, as a shorter step is better,
   !> and the last correction must be small itself, as the tangent is that of the place before it.
   subroutine correct(problem, options, point, error, normal)
      class(branch_problem_type), intent(inout), target :: problem
      class(newton_options), intent(in) :: options
      type(branch_point_type), intent(out) :: point
      type(error_type), allocatable, intent(out) :: error
      real(wp), intent(in), optional :: normal(:)
      real(wp) :: way(problem%n + 1)
      logical :: ok
      way = 0
      call problem%solve(options, point, way, error, normal)
      if (allocated(error)) return
      point%distance = sqrt(problem%dot(way, way))
      point%parameter = problem%parameter
      call problem%spectrum(point%values, point%growth, ok)
      if (.not. ok) call raise(error, numerics_error, 'the eigenvalues that tell stability were not found')
   end subroutine correct

   !> The iterations of Newton's method. The point has the tangent of the equations.
   subroutine newton_iterations(problem, options, point, way, error, normal)
      class(branch_problem_type), intent(inout), target :: problem
      class(newton_options), intent(in) :: options
      type(branch_point_type), intent(out) :: point
      !> Gains all changes of unknowns and, in a plane, the parameter.
      real(wp), intent(inout) :: way(:)
      type(error_type), allocatable, intent(out) :: error
      real(wp), intent(in), optional :: normal(:)
      real(wp), allocatable :: matrix(:, :), b(:, :)
      !> The last correction and what is left of this one; the shortest up to now, and when this was looked at last.
      real(wp) :: before, left, best, best_before
      integer :: n, unknowns
      n = problem%n
      unknowns = merge(n + 1, n, present(normal))
      allocate (matrix(unknowns, unknowns), b(unknowns, 1 + unknowns - n))
      before = 0
      best = huge(best)
      best_before = best
      do
         call check_progress()
         if (.not. allocated(error)) call take_step()
         if (allocated(error)) return
         left = point%correction
         ! by as much as this correction is shorter than the last, the next is shorter still
         if (before > 0 .and. .not. present(normal)) left = left*min(1.0_wp, left/before)
         before = point%correction
         best = min(best, point%correction)
         if (point%iterations == 1) best_before = best
         if (left <= options%tolerance) exit
      end do
      if (present(normal)) point%tangent = b(:, 2)/sqrt(problem%dot(b(:, 2), b(:, 2)))

   contains

      !> Whether to go on: not where it is asked to stop, after too many iterations, or where the correction stays long.
      subroutine check_progress()
         if (asked(options%give_up)) then
            call raise(error, stopped, 'asked to stop')
         else if (point%iterations == options%max_iterations) then
            call raise(error, numerics_error, 'Newton''s method stopped after '//to_text(point%iterations) &
               & //' iterations at a correction of '//to_text(point%correction) &
                  & //' of the characteristic scale of the states')
         else if (stays_long()) then
            call raise(error, numerics_error, 'Newton''s method does not converge: its correction is still ' &
               & //to_text(best)//' of the characteristic scale of the states after '//to_text(point%iterations) &
               & //' iterations')
         else if (mod(point%iterations, looked_at_iterations) == 0) then
            best_before = best
         end if
      end subroutine check_progress

      !> Whether the correction has not fallen by half, or, beyond the first iterations, is longer than the parts of it
      !> that all iterations left may make.
      logical function stays_long()
         stays_long = .not. present(normal) .and. point%iterations >= first_iterations &
            & .and. best > longest*(options%max_iterations - point%iterations)
         if (point%iterations > 0 .and. mod(point%iterations, looked_at_iterations) == 0) stays_long = stays_long &
            & .or. best > max(longest, 0.5_wp*best_before)
      end function stays_long

      subroutine take_step()
         logical :: ok
         point%iterations = point%iterations + 1
         call problem%get_place(point%place)
         b = 0
         call problem%linearize(matrix(:n, :), b(:n, 1), error)
         if (present(normal)) then
            matrix(n + 1, :n) = problem%weight*normal(:n)
            matrix(n + 1, n + 1) = normal(n + 1)
            b(n + 1, 2) = 1
         end if
         if (.not. allocated(error)) then
            call solve(unknowns, size(b, 2), matrix, b, ok)
            if (ok) ok = all(abs(b) <= huge(b))
            if (.not. ok) call raise(error, numerics_error, 'the equations have no solution')
         end if
         if (.not. allocated(error) .and. present(normal)) then
            if (maxval(abs(b(:, 1))) > longest) call raise(error, numerics_error, 'the correction is ' &
               & //to_text(maxval(abs(b(:, 1))))//' of the characteristic scale of the states')
         end if
         if (.not. problem%refused) call add_context(error, 'iteration '//to_text(point%iterations) &
            & //' of Newton''s method')
         if (allocated(error)) return
         point%change = b(:, 1)
         call problem%move(point%change, .true.)
         way(:unknowns) = way(:unknowns) + point%change
         point%correction = problem%correction
      end subroutine take_step
   end subroutine newton_iterations

   !> Takes a problem back to a point of its branch, linearised there as it was. An error where the point comes from
   !> elsewhere and is none of the branch.
   subroutine return_to(problem, point, refusal)
      class(branch_problem_type), intent(inout) :: problem
      type(branch_point_type), intent(in) :: point
      type(error_type), allocatable, intent(out), optional :: refusal
      real(wp) :: matrix(problem%n, problem%n + 1), b(problem%n)
      type(error_type), allocatable :: error
      call problem%go_to(point%place)
      call problem%linearize(matrix, b, error)
      if (.not. allocated(error)) call problem%move(point%change, .true.)
      problem%parameter = point%parameter
      if (present(refusal)) call move_alloc(error, refusal)
   end subroutine return_to
end module newton_method
