!> Curves of bifurcation points over two parameters, on the surface of all equilibria, orbits or cycles. A place near
!> a point has a part along a branch, over a line across the curve in the plane of the parameters, and one ahead, where
!> this line stands. A step goes to where a function is 0 on a circle about the last point: the growth of the value that
!> came to the border of stability, followed from point to point, or, at folds, the tangent's part along the line. So a
!> curve is followed where it turns in the parameters, and through cusps.
module bifurcation_curve
   use kinds, only: wp
   use text, only: to_text
   use errors, only: error_type, raise, numerics_error, stopped
   use newton_method, only: branch_problem_type, branch_point_type, correct, return_to
   use continuation, only: branch_options, bifurcation_type, kind_length
   use varied_bearing, only: parameter_line_type
   use roots, only: root_bracket
   implicit none (type, external)
   private
   public :: curve_type, begin_curve, go_to_point, follow_curve

   type :: curve_type
      !> Of its points: a kind of bifurcation points; whether they are those of multipliers, which are 1 at a fold.
      character(len=kind_length) :: kind = ''
      logical :: of_multipliers = .false.
      !> Longest step, over the ways of both parameters.
      real(wp) :: longest = 0.05_wp
      !> Both parameters, and their plane.
      character(len=:), allocatable :: names(:)
      type(parameter_line_type) :: line
   end type curve_type

   !> Where the next point is sought: on a circle about the last one, or, without a radius, on a line across.
   type :: way_type
      real(wp) :: from(2) = 0, line(2) = 0, ahead(2) = 0, direction(2) = 0, radius = 0
   end type way_type

   !> How closely a point is known: in the parameters, over their ways, and in all; most points for one.
   real(wp), parameter :: closeness = 1e-6_wp, accuracy = 1e-4_wp
   integer, parameter :: most_points = 25
   !> First way across where no slope is known; longest change of it, over the step.
   real(wp), parameter :: probe = 1e-3_wp, farthest = 0.5_wp
   !> Largest turn in a step, and in one in which a curve may have a corner, rad: the first, and those that are as short
   !> as this part of the longest. Shortest part.
   real(wp), parameter :: largest_turn = 0.6_wp, largest_corner = 1.57_wp, at_corner = 0.05_wp, shortest = 1e-3_wp
   !> Points up to which a step may be followed by a longer one.
   integer, parameter :: quick = 5
   real(wp), parameter :: longer = 1.5_wp
   !> Points in which one of codimension two is found: it need be close to the marked one, and no closer.
   integer, parameter :: most_cuts = 4

contains

   !> The first point of a curve, next to a bifurcation point of a branch over its first parameter, at which the problem
   !> stands.
   subroutine begin_curve(curve, problem, options, found, point, error)
      type(curve_type), intent(inout) :: curve
      class(branch_problem_type), intent(inout) :: problem
      type(branch_options), intent(in) :: options
      type(bifurcation_type), intent(in) :: found
      type(branch_point_type), intent(out) :: point
      type(error_type), allocatable, intent(out) :: error
      type(branch_point_type) :: here
      integer :: points
      here = found%point
      here%curve%value = found%value
      if (curve%kind == 'fold') here%curve%value = merge(1, 0, curve%of_multipliers)
      here%arc_length = 0
      problem%parameter = 0
      call find_point(curve, problem, options, here, way_type(from=[here%parameter, 0.0_wp], line=here%curve%line, &
         & ahead=here%curve%ahead), point, points, error)
      point%arc_length = 0
   end subroutine begin_curve

   !> Takes the problem of a curve to one of its points.
   subroutine go_to_point(curve, problem, point, refusal)
      type(curve_type), intent(inout) :: curve
      class(branch_problem_type), intent(inout) :: problem
      type(branch_point_type), intent(in) :: point
      type(error_type), allocatable, intent(out), optional :: refusal
      curve%line%origin = point%curve%origin
      curve%line%direction = point%curve%line
      call return_to(problem, point, refusal)
   end subroutine go_to_point

   !> Goes from a point of a curve to the next, with the points of codimension two before it; `length` is that of the
   !> step, and becomes that of the next one. The curve has ended where `at_end` says why. An error where no next point
   !> was found: at the shortest step, or, of status `stopped`, as the options say.
   subroutine follow_curve(curve, problem, options, here, length, next, special, at_end, error)
      type(curve_type), intent(inout) :: curve
      class(branch_problem_type), intent(inout) :: problem
      type(branch_options), intent(in) :: options
      type(branch_point_type), intent(in) :: here
      real(wp), intent(inout) :: length
      type(branch_point_type), intent(out) :: next
      type(bifurcation_type), allocatable, intent(out) :: special(:)
      character(len=:), allocatable, intent(out) :: at_end
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: allowed
      integer :: points, bound
      allocate (special(0))
      length = min(length, curve%longest)
      do
         at_end = ''
         call find_around(curve, problem, options, here, length, next, points, error)
         if (.not. allocated(error)) then
            bound = bound_between(here, next)
            if (bound > 0) call find_at_bound()
         end if
         allowed = largest_turn
         if (here%arc_length <= 0 .or. length <= at_corner*curve%longest) allowed = largest_corner
         if (.not. allocated(error)) then
            if (abs(next%curve%turn)*length <= allowed) exit
         end if
         if (allocated(error)) then
            if (error%status == stopped .or. length <= shortest*curve%longest) return
         end if
         length = 0.5_wp*length
      end do
      if (allowed > largest_turn) next%curve%turn = 0
      call find_special(curve, problem, options, here, next, special, at_end, error)
      if (points <= quick) length = longer*length
   contains

      !> The point at the bound that lies between.
      subroutine find_at_bound()
         type(way_type) :: way
         real(wp) :: bound_value
         integer :: own
         own = (bound + 1)/2
         bound_value = mod(bound, 2)
         call stand_at(curve, problem, here, way)
         way%ahead = 0
         way%ahead(own) = 1
         way%line = [way%ahead(2), way%ahead(1)]
         if (dot_product(way%line, here%curve%line) < 0) way%line = -way%line
         way%direction = [0.0_wp, bound_value - way%from(own)]
         way%radius = 0
         call find_point(curve, problem, options, here, way, next, points, error)
         if (allocated(error)) return
         at_end = trim(merge('the last value ', 'the first value', bound_value > 0))//' of '//trim(curve%names(own))
      end subroutine find_at_bound
   end subroutine follow_curve

   !> The bound of a parameter that a curve passes first between two points: 2 and 1, the first and the last value of
   !> the first, 4 and 3, those of the second; 0: none.
   pure integer function bound_between(here, next) result(bound)
      type(branch_point_type), intent(in) :: here, next
      real(wp) :: before(2), after(2), part, first
      integer :: i
      before = place_of(here)
      after = place_of(next)
      bound = 0
      first = 1
      do i = 1, 2
         if (after(i) > 0 .and. after(i) < 1) cycle
         if (abs(after(i) - before(i)) <= 0) cycle
         part = (merge(1, 0, after(i) >= 1) - before(i))/(after(i) - before(i))
         if (part > first .or. part < 0) cycle
         first = part
         bound = 2*i - merge(1, 0, after(i) >= 1)
      end do
   end function bound_between

   !> Place of a point in the plane of the parameters, 0 at their first and 1 at their last values.
   pure function place_of(point) result(place)
      type(branch_point_type), intent(in) :: point
      real(wp) :: place(2)
      place = point%curve%origin + point%parameter*point%curve%line
   end function place_of

   !> The point of a curve on a circle about another.
   subroutine find_around(curve, problem, options, here, length, next, points, error)
      type(curve_type), intent(inout) :: curve
      class(branch_problem_type), intent(inout) :: problem
      type(branch_options), intent(in) :: options
      type(branch_point_type), intent(in) :: here
      real(wp), intent(in) :: length
      type(branch_point_type), intent(out) :: next
      integer, intent(out) :: points
      type(error_type), allocatable, intent(out) :: error
      type(way_type) :: way
      call stand_at(curve, problem, here, way)
      way%radius = length
      call find_point(curve, problem, options, here, way, next, points, error)
   end subroutine find_around

   !> Takes the problem to a point, on the line across the curve there, on which its parameter is 0.
   subroutine stand_at(curve, problem, here, way)
      type(curve_type), intent(inout) :: curve
      class(branch_problem_type), intent(inout) :: problem
      type(branch_point_type), intent(in) :: here
      type(way_type), intent(out) :: way
      call go_to_point(curve, problem, here)
      problem%parameter = 0
      way%from = place_of(here)
      way%ahead = here%curve%ahead
      way%line = across(way%ahead)
      way%direction = here%curve%direction
   end subroutine stand_at

   !> The place at `s` of a way, along the branch and ahead; how it changes there.
   pure function place_on(way, s) result(place)
      type(way_type), intent(in) :: way
      real(wp), intent(in) :: s
      real(wp) :: place(2)
      place = way%direction + [s, 0.0_wp]
      if (way%radius > 0) place = way%radius*turned(way%direction, s/way%radius)
   end function place_on

   pure function heading_on(way, s) result(heading)
      type(way_type), intent(in) :: way
      real(wp), intent(in) :: s
      real(wp) :: heading(2)
      heading = [1, 0]
      if (way%radius > 0) heading = across(turned(way%direction, s/way%radius))
   end function heading_on

   !> A direction, turned from ahead to along by an angle.
   pure function turned(direction, angle)
      real(wp), intent(in) :: direction(2), angle
      real(wp) :: turned(2)
      turned = cos(angle)*direction + sin(angle)*across(direction)
   end function turned

   pure function across(direction)
      real(wp), intent(in) :: direction(2)
      real(wp) :: across(2)
      across = [direction(2), -direction(1)]
   end function across

   !> The point of a curve on a way, by the secant method and, between two points, by false position, as multipliers of
   !> cavitated films may leap; the problem stands where the way begins.
   subroutine find_point(curve, problem, options, here, way, next, points, error)
      type(curve_type), intent(inout) :: curve
      class(branch_problem_type), intent(inout) :: problem
      type(branch_options), intent(in) :: options
      type(branch_point_type), intent(in) :: here
      type(way_type), intent(in) :: way
      type(branch_point_type), intent(out) :: next
      !> Equilibria or orbits that it took.
      integer, intent(out) :: points
      type(error_type), allocatable, intent(out) :: error
      type(root_bracket) :: bracket
      real(wp), dimension(problem%n + 1) :: normal, change
      ! long: one iteration, whose parts share all of its state
      real(wp) :: to(2), along, s, step, left, value, s_before, value_before, slope, size_of_way
      logical :: slope_is_old
      normal = here%tangent
      next = here
      along = 0
      slope_is_old = .true.
      slope = merge(here%curve%slope, 0.0_wp, way%radius > 0)
      size_of_way = merge(way%radius, curve%longest, way%radius > 0)
      s = here%curve%turn*way%radius**2
      s_before = s
      value_before = 0
      curve%line%direction = way%line
      do points = 1, most_points
         to = place_on(way, s)
         curve%line%origin = way%from + to(2)*way%ahead
         change = (to(1) - along)/problem%dot(normal, next%tangent)*next%tangent
         if (points == 1) call problem%predict(change)
         if (points > 1) call problem%move(change, .false.)
         along = to(1)
         call correct(problem, options, next, error, normal)
         if (allocated(error)) return
         value = above_border(curve, next, here%curve%value)
         if (points > 1 .and. (slope_is_old .or. abs(s - s_before) > accuracy)) then
            slope = (value - value_before)/(s - s_before)
            slope_is_old = .false.
         end if
         step = probe
         if (abs(slope) > 0) step = -value/slope
         left = abs(step)
         if (bracket%width() > 0) then
            call bracket%narrow(s, value)
            left = min(left, bracket%width())
         else if (points > 1 .and. value*value_before < 0) then
            bracket = root_bracket([s_before, s], [value_before, value])
         end if
         if (bracket%width() > 0) step = bracket%estimate() - s
         if (left <= accuracy .and. left*norm2(move_along(way, s, next)) <= closeness) then
            next%along = norm2(to)
            next%arc_length = here%arc_length + next%along
            call note(curve, problem, here, way, s, slope, next)
            return
         end if
         s_before = s
         value_before = value
         step = sign(min(abs(step), farthest*size_of_way), step)
         s = sign(min(abs(s + step), largest_corner*size_of_way), s + step)
         if (.not. abs(s - s_before) > 0) exit
      end do
      call raise(error, numerics_error, 'there is no such point in '//to_text(min(points, most_points))//' places')
   end subroutine find_point

   !> How the place in the plane of the parameters changes along a way.
   pure function move_along(way, s, point) result(move)
      type(way_type), intent(in) :: way
      real(wp), intent(in) :: s
      type(branch_point_type), intent(in) :: point
      real(wp) :: move(2)
      associate (heading => heading_on(way, s), tangent => point%tangent)
         move = heading(1)*tangent(size(tangent))*way%line + heading(2)*way%ahead
      end associate
   end function move_along

   !> Notes what a point at `s` of a way is on its curve, and where this leads.
   subroutine note(curve, problem, here, way, s, slope, next)
      type(curve_type), intent(in) :: curve
      class(branch_problem_type), intent(inout) :: problem
      type(branch_point_type), intent(in) :: here
      type(way_type), intent(in) :: way
      real(wp), intent(in) :: s, slope
      type(branch_point_type), intent(inout) :: next
      real(wp), dimension(2) :: to, chord, curve_on, side, normal
      real(wp) :: bend
      integer :: k(2)
      logical :: begins, keeps
      begins = .not. norm2(way%direction) > 0
      associate (own => next%curve)
         own = here%curve
         own%origin = curve%line%origin
         own%line = way%line
         own%slope = slope
         own%turn = 0
         if (way%radius > 0) own%turn = s/way%radius**2
         k = critical(curve, next%values, here%curve%value)
         own%value = next%values(k(1))
         to = place_on(way, s)
         chord = place_of(next) - way%from
         curve_on = [0, 1]
         normal = way%line
         if (.not. begins) then
            curve_on = turned(to/norm2(to), 0.5_wp*own%turn*way%radius)
            normal = across(chord)/norm2(chord)
            ! near a cusp the way of the parameters is short, and turns back
            keeps = curve%kind == 'fold' .and. here%arc_length > 0 .and. abs(dot_product(chord, way%ahead)) &
               & < abs(dot_product(chord, way%line))
            if (.not. keeps) then
               own%ahead = sign(1.0_wp, dot_product(chord, way%ahead))*chord/norm2(chord)
               to = [to(1) - here%tangent(size(here%tangent))*next%parameter, dot_product(chord, own%ahead)]
            end if
            own%direction = to/norm2(to)
         end if
         bend = slope*curve_on(2)/dot_product(across(curve_on), heading_on(way, s))
         side = sign(1.0_wp, -bend*next%tangent(size(next%tangent)))*way%line
         if (curve%kind == 'fold') side = sign(1.0_wp, bend)*way%line
         own%stable_side = sign(1.0_wp, dot_product(side, normal)*normal(1))
         own%tests = tests_of(curve, next, k, bend)
         if (curve%kind == 'hopf') own%tests(5) = problem%birth(own%value)
         own%others_stable = .not. own%tests(4) > 0
      end associate
   end subroutine note

   !> Which values have come to the border of stability: that next to the one of another point, and what makes a pair
   !> with it, its conjugate or, where the frequency has gone to 0, another real one; else itself.
   pure function critical(curve, values, last) result(k)
      type(curve_type), intent(in) :: curve
      complex(wp), intent(in) :: values(:), last
      integer :: k(2), i
      k = minloc(abs(values - last), dim=1)
      if (curve%kind /= 'hopf' .and. curve%kind /= 'neimark_sacker') return
      k(2) = minloc(abs(values - conjg(values(k(1)))), dim=1, mask=[(i /= k(1), i=1, size(values))])
      if (.not. abs(values(k(1))%im) > 0) k(2) = minloc(abs(values - last), dim=1, mask=abs(values%im) <= 0 .and. &
         & [(i /= k(1), i=1, size(values))])
      if (k(2) == 0) k(2) = k(1)
   end function critical

   !> What is 0 on a curve, and above it where what was stable is not.
   pure real(wp) function above_border(curve, point, last) result(above)
      type(curve_type), intent(in) :: curve
      type(branch_point_type), intent(in) :: point
      complex(wp), intent(in) :: last
      associate (k => critical(curve, point%values, last), tangent => point%tangent)
         select case (curve%kind)
         case ('fold')
            above = tangent(size(tangent))
         case ('neimark_sacker')
            above = (product(abs(point%values(k))) - 1)/2
         case default
            above = sum(point%growth(k))/2
         end select
      end associate
   end function above_border

   !> What is 0 at points of codimension two: 1 and 2, where a pair of values becomes real, with 1, and with -1; 3, at a
   !> cusp; 4, where another value comes to the border.
   pure function tests_of(curve, point, k, bend) result(tests)
      type(curve_type), intent(in) :: curve
      type(branch_point_type), intent(in) :: point
      integer, intent(in) :: k(2)
      real(wp), intent(in) :: bend
      real(wp) :: tests(5)
      integer :: i
      tests = 0
      associate (pair => point%values(k))
         if (curve%kind == 'hopf') tests(1) = real(pair(1)*pair(2), wp)
         if (curve%kind == 'neimark_sacker') tests(:2) = 1 + [-0.5_wp, 0.5_wp]*real(sum(pair), wp)
      end associate
      if (curve%kind == 'fold') tests(3) = bend
      tests(4) = maxval(point%growth, mask=[(all(i /= k), i=1, size(point%growth))])
   end function tests_of

   !> The kind of a point where a test is 0; empty where it has no name.
   pure function kind_of_test(curve, test, point) result(kind)
      type(curve_type), intent(in) :: curve
      integer, intent(in) :: test
      type(branch_point_type), intent(in) :: point
      character(len=kind_length) :: kind
      logical :: others(size(point%values)), vibrates
      integer :: i
      associate (k => critical(curve, point%values, point%curve%value))
         others = [(all(i /= k), i=1, size(others))]
      end associate
      associate (other => point%values(max(1, maxloc(point%growth, dim=1, mask=others))))
         vibrates = abs(other%im) > 0
         kind = ''
         select case (test)
         case (1)
            kind = merge('resonance_1_1  ', 'bogdanov_takens', curve%of_multipliers)
         case (2)
            kind = 'resonance_1_2'
         case (3)
            kind = 'cusp'
         case (5)
            kind = 'generalised_hopf'
         case default
            if (curve%kind == 'hopf') kind = merge('double_hopf', 'fold_hopf  ', vibrates)
            if (curve%kind == 'fold' .and. .not. curve%of_multipliers) then
               kind = merge('fold_hopf      ', 'bogdanov_takens', vibrates)
            else if (curve%kind == 'fold' .and. .not. vibrates .and. other%re > 0) then
               kind = 'resonance_1_1'
            end if
            if (curve%kind == 'period_doubling' .and. .not. vibrates .and. other%re < 0) kind = 'resonance_1_2'
         end select
      end associate
   end function kind_of_test

   !> The points of codimension two between a point and the next, at which the problem stands after. A curve on which
   !> the frequency goes to 0 ends there.
   subroutine find_special(curve, problem, options, here, next, special, at_end, error)
      type(curve_type), intent(inout) :: curve
      class(branch_problem_type), intent(inout) :: problem
      type(branch_options), intent(in) :: options
      type(branch_point_type), intent(in) :: here
      type(branch_point_type), intent(inout) :: next
      type(bifurcation_type), allocatable, intent(inout) :: special(:)
      character(len=:), allocatable, intent(inout) :: at_end
      type(error_type), allocatable, intent(out) :: error
      type(bifurcation_type) :: one
      type(root_bracket) :: bracket
      integer :: test, cut, points
      do test = size(here%curve%tests), 1, -1
         associate (before => here%curve%tests(test), after => next%curve%tests(test))
            if (before > 0 .eqv. after > 0) cycle
            bracket = root_bracket([0.0_wp, next%along], [before, after])
         end associate
         do cut = 1, most_cuts
            call find_around(curve, problem, options, here, bracket%estimate(), one%point, points, error)
            if (allocated(error)) exit
            call bracket%narrow(one%point%along, one%point%curve%tests(test))
         end do
         if (allocated(error)) then
            if (error%status == stopped) return
            deallocate (error)
            cycle
         end if
         one%kind = kind_of_test(curve, test, one%point)
         if (one%kind == '') cycle
         one%value = one%point%curve%value
         special = [special, one]
         if (test > 2) cycle
         at_end = trim(merge('its frequency goes to 0                         ', &
            & 'its frequency comes to half of that of the orbit', test == 1))
         next = one%point
      end do
      if (size(special) > 0) call go_to_point(curve, problem, next)
   end subroutine find_special
end module bifurcation_curve
