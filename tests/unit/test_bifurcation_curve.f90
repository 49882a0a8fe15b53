!> Curves of bifurcation points that are known: folds with a cusp, Hopf points and folds that meet at a Bogdanov-Takens
!> point or cross, two Hopf curves that cross, and Neimark-Sacker curves that end at a 1:2 and at a 1:1 resonance.
module known_curves
   use kinds, only: wp
   use errors, only: error_type
   use linear_algebra, only: largest_first
   use newton_method, only: branch_problem_type, place_part_type
   use varied_bearing, only: parameter_line_type
   implicit none (type, external)
   private
   public :: surface

   !> Over p and q: 'cusp', x' = p + q x - x**3; 'takens', x' = y, y' = p + q y + x**2 + x y; 'double', x = p, with
   !> vibrations that grow by p - 0.5 and p - 0.7 + q/2; 'torus', the same with multipliers of the product
   !> (0.5 + p)**2 whose mean over its root is -0.8 - 0.4 q, and 'strong' 0.8 + 0.4 q; 'zero', x' = p + x**2, with a
   !> vibration that grows by q - 0.5.
   type, extends(branch_problem_type) :: surface
      character(len=6) :: of = ''
      real(wp) :: x = 0
      type(parameter_line_type), pointer :: line => null()
   contains
      procedure :: linearize
      procedure :: move
      procedure :: spectrum
      procedure :: kind => kind_of
      procedure :: get_place
      procedure :: go_to
   end type surface

contains

   subroutine linearize(self, matrix, b, error)
      class(surface), intent(inout) :: self
      real(wp), intent(out) :: matrix(:, :), b(:)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: slopes(3), ways(2)
      associate (x => self%x, values => self%line%values(self%parameter))
         select case (self%of)
         case ('cusp')
            slopes = [values(2) - 3*x**2, 1.0_wp, x]
            b = -(values(1) + values(2)*x - x**3)
         case ('takens', 'zero')
            slopes = [2*x, 1.0_wp, 0.0_wp]
            b = -(values(1) + x**2)
         case default
            slopes = [-1, 1, 0]
            b = x - values(1)
         end select
      end associate
      ways = self%line%direction*(self%line%last - self%line%first)
      matrix(1, :) = [slopes(1), dot_product(slopes(2:), ways)]
   end subroutine linearize

   subroutine move(self, change, closes)
      class(surface), intent(inout) :: self
      real(wp), intent(in) :: change(:)
      logical, intent(in) :: closes
      self%x = self%x + change(1)
      self%parameter = self%parameter + change(2)
      self%correction = maxval(abs(change))
   end subroutine move

   subroutine spectrum(self, values, growth, ok)
      class(surface), intent(inout) :: self
      complex(wp), allocatable, intent(out) :: values(:)
      real(wp), allocatable, intent(out) :: growth(:)
      logical, intent(out) :: ok
      associate (x => self%x, at => self%line%values(self%parameter))
         select case (self%of)
         case ('cusp')
            values = [cmplx(at(2) - 3*x**2, 0.0_wp, wp)]
         case ('takens')
            values = pair((at(2) + x)/2, -2*x)
         case ('zero')
            values = [cmplx(2*x, 0.0_wp, wp), pair(at(2) - 0.5_wp, (at(2) - 0.5_wp)**2 + 4)]
         case ('strong')
            values = pair((0.5_wp + at(1))*(0.8_wp + 0.4_wp*at(2)), (0.5_wp + at(1))**2)
         case ('double')
            values = [pair(at(1) - 0.5_wp, (at(1) - 0.5_wp)**2 + 1), &
               & pair(at(1) - 0.7_wp + at(2)/2, (at(1) - 0.7_wp + at(2)/2)**2 + 4)]
         case default
            values = pair((0.5_wp + at(1))*(-0.8_wp - 0.4_wp*at(2)), (0.5_wp + at(1))**2)
         end select
      end associate
      growth = values%re
      if (any(self%of == ['torus ', 'strong'])) growth = abs(values) - 1
      values = values(largest_first(growth))
      growth = growth(largest_first(growth))
      ok = .true.
   end subroutine spectrum

   !> Two values of this mean and product.
   pure function pair(mean, product)
      real(wp), intent(in) :: mean, product
      complex(wp) :: pair(2), root
      root = sqrt(cmplx(mean**2 - product, 0.0_wp, wp))
      pair = [mean + root, mean - root]
   end function pair

   pure function kind_of(self, value) result(kind)
      class(surface), intent(in) :: self
      complex(wp), intent(in) :: value
      character(len=:), allocatable :: kind
      kind = 'fold'
      if (abs(value%im) > 0) kind = trim(merge('neimark_sacker', 'hopf          ', any(self%of == ['torus ', &
         & 'strong'])))
   end function kind_of

   pure subroutine get_place(self, place)
      class(surface), intent(in) :: self
      type(place_part_type), allocatable, intent(out) :: place(:)
      place = [place_part_type('parameter'), place_part_type('x')]
      place(1)%values = [self%parameter]
      place(2)%values = [self%x]
   end subroutine get_place

   subroutine go_to(self, place)
      class(surface), intent(inout) :: self
      type(place_part_type), intent(in) :: place(:)
      self%parameter = place(1)%values(1)
      self%x = place(2)%values(1)
   end subroutine go_to
end module known_curves

program test_bifurcation_curve
   use kinds, only: wp
   use errors, only: error_type
   use newton_method, only: branch_point_type
   use continuation, only: branch_options, start_branch, bifurcation_type, find_first
   use bifurcation_curve, only: curve_type, begin_curve, follow_curve
   use known_curves, only: surface
   use check, only: runs, expect, expect_close, expect_no_error, report
   implicit none (type, external)

   if (runs('cusp')) call cusp()
   if (runs('takens')) call bogdanov_takens()
   if (runs('double')) call double_hopf()
   if (runs('torus')) call torus()
   if (runs('strong')) call strong_resonance()
   if (runs('zero')) call fold_hopf()
   call report()

contains

   !> Follows the curve of a kind from p and q to their last values: all points, those of codimension two, the end.
   subroutine follow(of, kind, x, first, last, points, special, at_end)
      character(len=*), intent(in) :: of, kind
      real(wp), intent(in) :: x, first(2), last(2)
      !> Of p, q, side and whether others are stable.
      real(wp), allocatable, intent(out) :: points(:, :)
      type(bifurcation_type), allocatable, intent(out) :: special(:)
      character(len=:), allocatable, intent(out) :: at_end
      type(curve_type), target :: curve
      type(surface) :: problem
      type(branch_options) :: options
      type(branch_point_type) :: here, next
      type(bifurcation_type) :: found
      type(bifurcation_type), allocatable :: new(:)
      type(error_type), allocatable :: error
      real(wp) :: length
      integer :: k
      curve%kind = kind
      curve%of_multipliers = any(of == ['torus ', 'strong'])
      curve%names = ['p', 'q']
      curve%line%first = first
      curve%line%last = last
      problem%of = of
      problem%x = x
      problem%n = 1
      problem%weight = [1.0_wp]
      problem%line => curve%line
      options = branch_options(low=0.0_wp, high=1.0_wp, first_step=0.05_wp, tolerance=1e-10_wp)
      call start_branch(problem, options, .true., here, error)
      call expect_no_error(error, 'the first point')
      length = 0.05_wp
      call find_first(problem, options, kind, here, length, found, error)
      call expect(found%kind == kind, 'there is such a point')
      call begin_curve(curve, problem, options, found, here, error)
      call expect_no_error(error, 'the start of the curve')
      allocate (special(0))
      points = reshape(noted(here, first, last), [4, 1])
      at_end = ''
      do k = 1, 200
         call follow_curve(curve, problem, options, here, length, next, new, at_end, error)
         call expect_no_error(error, 'a step')
         if (allocated(error)) return
         special = [special, new]
         points = reshape([points, noted(next, first, last)], [4, size(points, 2) + 1])
         here = next
         if (at_end /= '') exit
      end do
   end subroutine follow

   pure function noted(point, first, last)
      type(branch_point_type), intent(in) :: point
      real(wp), intent(in) :: first(2), last(2)
      real(wp) :: noted(4)
      noted(:2) = place(point, first, last)
      noted(3:) = [point%curve%stable_side, merge(1.0_wp, 0.0_wp, point%curve%others_stable)]
   end function noted

   !> Place of a point: p and q.
   pure function place(point, first, last)
      type(branch_point_type), intent(in) :: point
      real(wp), intent(in) :: first(2), last(2)
      real(wp) :: place(2)
      place = first + (last - first)*(point%curve%origin + point%parameter*point%curve%line)
   end function place

   !> p = 2 (q/3)**1.5 down to the cusp at 0 and p = -2 (q/3)**1.5 back.
   subroutine cusp()
      real(wp), allocatable :: points(:, :)
      type(bifurcation_type), allocatable :: special(:)
      character(len=:), allocatable :: at_end
      real(wp), parameter :: first(2) = [-1, 1], last(2) = [1, -1]
      call follow('cusp', 'fold', -1.324718_wp, first, last, points, special, at_end)
      call expect(all(abs(points(1, :)**2 - 4*(points(2, :)/3)**3) < 1e-5_wp), 'folds are where they are known')
      call expect(at_end == 'the first value of q', 'the curve comes back')
      call expect_close(points(1, size(points, 2)), -2/sqrt(27.0_wp), 1e-6_wp, 'on the other side')
      call expect(all(special%kind == 'cusp') .and. size(special) == 1, 'a cusp')
      call expect(norm2(place(special(1)%point, first, last)) < 2e-3_wp, 'at 0')
      ! two solutions lie between both arms
      call expect(all(points(3, :) < 0 .eqv. points(1, :) > 0), 'with the solutions between')
   end subroutine cusp

   !> Hopf points p = -q**2, and folds p = 0.
   subroutine bogdanov_takens()
      real(wp), allocatable :: points(:, :)
      type(bifurcation_type), allocatable :: special(:)
      character(len=:), allocatable :: at_end
      real(wp), parameter :: first(2) = [-1.0_wp, 0.5_wp], last(2) = [1.0_wp, -0.5_wp]
      call follow('takens', 'hopf', -1.0_wp, first, last, points, special, at_end)
      call expect(all(abs(points(1, :) + points(2, :)**2) < 1e-5_wp), 'Hopf points are where they are known')
      call expect(all(special%kind == 'bogdanov_takens') .and. size(special) == 1, 'a Bogdanov-Takens point')
      call expect(norm2(place(special(1)%point, first, last)) < 1e-3_wp, 'at 0')
      call expect(at_end == 'its frequency goes to 0', 'where the curve ends')
      call expect(all(points(3, :size(points, 2) - 1) < 0), 'what is stable is below')
      call follow('takens', 'fold', -1.0_wp, first, last, points, special, at_end)
      call expect(all(abs(points(1, :)) < 1e-6_wp), 'folds are where they are known')
      call expect(all(special%kind == 'bogdanov_takens') .and. size(special) == 1, 'the same point')
      call expect(norm2(place(special(1)%point, first, last)) < 1e-3_wp, 'on the folds')
      call expect(all(points(4, :) > 0 .eqv. points(2, :) < 0), 'below which one solution is stable')
      call expect(at_end == 'the last value of q', 'to the end')
   end subroutine bogdanov_takens

   !> Another vibration grows from q = 0.4 on.
   subroutine double_hopf()
      real(wp), allocatable :: points(:, :)
      type(bifurcation_type), allocatable :: special(:)
      character(len=:), allocatable :: at_end
      real(wp), parameter :: first(2) = [0, 0], last(2) = [1, 1]
      call follow('double', 'hopf', 0.0_wp, first, last, points, special, at_end)
      call expect(all(abs(points(1, :) - 0.5_wp) < 1e-6_wp), 'Hopf points are where they are known')
      call expect(all(special%kind == 'double_hopf') .and. size(special) == 1, 'a double Hopf point')
      call expect(norm2(place(special(1)%point, first, last) - [0.5_wp, 0.4_wp]) < 1e-5_wp, 'where both cross')
      ! the point itself belongs to neither side
      call expect(all((points(4, :) > 0 .eqv. points(2, :) < 0.4_wp) .or. abs(points(2, :) - 0.4_wp) < 1e-5_wp), &
         & 'beyond which nothing is stable')
   end subroutine double_hopf

   !> The multipliers become -1 at q = 0.5.
   subroutine torus()
      call meets_resonance('torus', 'resonance_1_2', 'at -1', 'its frequency comes to half of that of the orbit')
   end subroutine torus

   !> The multipliers become 1 at q = 0.5.
   subroutine strong_resonance()
      call meets_resonance('strong', 'resonance_1_1', 'at 1', 'its frequency goes to 0')
   end subroutine strong_resonance

   !> A curve of Neimark-Sacker points at p = 0.5 that ends at a resonance at q = 0.5.
   subroutine meets_resonance(surface, resonance, where_to, ending)
      character(len=*), intent(in) :: surface, resonance, where_to, ending
      real(wp), allocatable :: points(:, :)
      type(bifurcation_type), allocatable :: special(:)
      character(len=:), allocatable :: at_end
      real(wp), parameter :: first(2) = [0, 0], last(2) = [1, 1]
      call follow(surface, 'neimark_sacker', 0.0_wp, first, last, points, special, at_end)
      call expect(all(abs(points(1, :) - 0.5_wp) < 1e-6_wp), 'points are where they are known')
      call expect(all(special%kind == resonance) .and. size(special) == 1, 'a '//resonance)
      call expect(norm2(place(special(1)%point, first, last) - 0.5_wp) < 1e-5_wp, where_to)
      call expect(at_end == ending, 'where the curve ends')
   end subroutine meets_resonance

   !> On the folds p = 0 a vibration begins at q = 0.5.
   subroutine fold_hopf()
      real(wp), allocatable :: points(:, :)
      type(bifurcation_type), allocatable :: special(:)
      character(len=:), allocatable :: at_end
      real(wp), parameter :: first(2) = [-1, 0], last(2) = [1, 1]
      call follow('zero', 'fold', -1.0_wp, first, last, points, special, at_end)
      call expect(all(abs(points(1, :)) < 1e-6_wp), 'folds are where they are known')
      call expect(all(special%kind == 'fold_hopf') .and. size(special) == 1, 'a fold and Hopf point')
      call expect(norm2(place(special(1)%point, first, last) - [0.0_wp, 0.5_wp]) < 1e-5_wp, 'where both meet')
      call expect(all((points(4, :) > 0 .eqv. points(2, :) < 0.5_wp) .or. abs(points(2, :) - 0.5_wp) < 1e-5_wp), &
         & 'beyond which neither solution is stable')
      call expect(at_end == 'the last value of q', 'to the end')
   end subroutine fold_hopf
end program test_bifurcation_curve
