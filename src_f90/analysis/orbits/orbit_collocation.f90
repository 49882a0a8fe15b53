!> A periodic orbit of an ODE by collocation: over the time of one period a mesh; on each of its intervals a polynomial
!> that satisfies the equations at the three points of Radau (RADAU IIA, order 5; Hairer and Wanner 1996, IV.8), which
!> damps what is stiff. All equations are solved together by Newton's method with exact derivatives, so that an
!> unstable orbit is found like a stable one. Elimination from interval to interval leaves the monodromy matrix.
module orbit_collocation
   use kinds, only: wp
   use text, only: to_text
   use errors, only: error_type, raise, numerics_error
   use lapack, only: dgesv
   use ode_model, only: ode_model_type
   use orbit_polynomials, only: orbit_type, points, place
   implicit none (type, external)
   private
   public :: newton_round
   public :: orbit_equations_type, parameter_shift_type, condense, closing_equations, move_orbit, collocated_state

   real(wp), parameter :: s6 = sqrt(6.0_wp)
   !> The integrals of the points' polynomials up to each point.
   real(wp), parameter :: weight(points, points) = reshape([(88 - 7*s6)/360, (296 + 169*s6)/1800, (16 - s6)/36, &
      & (296 - 169*s6)/1800, (88 + 7*s6)/360, (16 + s6)/36, (-2 + 3*s6)/225, (-2 - 3*s6)/225, 1/9.0_wp], &
      & [points, points])

   !> The derivatives at the end of an interval are taken this part of the way to the point before: at a kink, on the
   !> interval's side of it. To the same order the rates are still those at the end.
   real(wp), parameter :: inward = 1e-5_wp

   !> The equations linearised on an orbit and eliminated inside of its intervals, all over the scales.
   type :: orbit_equations_type
      private
      !> How the points of each interval follow, (state of a point, column, interval), and the end of the period:
      !> columns 1 to n a change of the state at the start of interval or period, n + 1 what the equations lack, n + 2
      !> (where it is asked for) a change of the parameter by 1.
      real(wp), allocatable :: at_points(:, :, :), at_end(:, :)
   end type orbit_equations_type

   !> What the equations are for another value of the parameter.
   type :: parameter_shift_type
      !> By how much it is larger; then the rates at the points' `collocated_state`, (state, point, interval), times the
      !> period over that at the present value.
      real(wp) :: amount = 0
      real(wp), allocatable :: rates(:, :, :)
   end type parameter_shift_type

   !> Where corrections below this size, over the scales, no longer fall by this factor a round, the mesh has settled.
   real(wp), parameter :: slow = 0.1_wp, near = 1e-4_wp

   !> Where displacements x and their rates v, x' = v, stand among the states, all states u but the displacements, and
   !> where the rates stand among these.
   type :: parts_type
      integer, allocatable :: x(:), v(:), u(:), v_in_u(:)
   end type parts_type

contains

   type(parts_type) function new_parts(model) result(parts)
      class(ode_model_type), intent(in) :: model
      integer :: i
      call model%pairs(parts%x, parts%v)
      parts%u = pack([(i, i=1, model%n)], [(all(parts%x /= i), i=1, model%n)])
      parts%v_in_u = [(findloc(parts%u, parts%v(i), dim=1), i=1, size(parts%v))]
   end function new_parts

   !> One round of Newton's method; of a correction longer than `longest`, over the scales, only a part is made. A
   !> numerics error where the model refuses a state or the equations have no solution: then the orbit is as it was.
   subroutine newton_round(model, orbit, longest, error)
      class(ode_model_type), intent(inout) :: model
      type(orbit_type), intent(inout) :: orbit
      real(wp), intent(in) :: longest
      type(error_type), allocatable, intent(out) :: error
      type(orbit_equations_type) :: equations
      real(wp) :: matrix(model%n, model%n), change(model%n)
      integer :: pivots(model%n), info
      call condense(model, orbit, equations, error)
      if (allocated(error)) return
      call closing_equations(orbit, equations, matrix, change)
      call dgesv(model%n, 1, matrix, model%n, pivots, change, model%n, info)
      if (info /= 0 .or. .not. all(abs(change) <= huge(change))) then
         call raise(error, numerics_error, 'Newton''s equations have no solution')
         return
      end if
      call move_orbit(orbit, equations, change, .true., longest)
   end subroutine newton_round

   !> Linearises the equations on an orbit and eliminates the points inside of the intervals: sets the orbit's monodromy
   !> matrix and residual. A numerics error where the model refuses a state or an interval's equations have no solution.
   subroutine condense(model, orbit, equations, error, shift)
      class(ode_model_type), intent(inout) :: model
      type(orbit_type), intent(inout) :: orbit
      type(orbit_equations_type), intent(out) :: equations
      type(error_type), allocatable, intent(out) :: error
      !> Where the derivatives over the parameter are wanted.
      type(parameter_shift_type), intent(in), optional :: shift
      type(parts_type) :: parts
      integer :: k, i, n, columns
      n = model%n
      columns = n + merge(2, 1, present(shift))
      parts = new_parts(model)
      allocate (equations%at_points(points*n, columns, orbit%intervals()))
      allocate (equations%at_end(n, columns), source=0.0_wp)
      do i = 1, n
         equations%at_end(i, i) = 1
      end do
      orbit%residual = 0
      orbit%refused = .false.
      do k = 1, orbit%intervals()
         call eliminate(model, orbit, parts, k, equations%at_points(:, :, k), error, shift)
         if (allocated(error)) return
         associate (last => equations%at_points((points - 1)*n + 1:, :, k), at_end => equations%at_end)
            at_end = matmul(last(:, :n), at_end)
            at_end(:, n + 1:) = at_end(:, n + 1:) + last(:, n + 1:)
         end associate
      end do
      if (.not. all(abs(equations%at_end) <= huge(1.0_wp))) then
         call raise(error, numerics_error, 'Newton''s equations have no solution')
         return
      end if
      orbit%monodromy = equations%at_end(:, :n)
      orbit%residual = max(orbit%residual, maxval(abs(gap_of(orbit))))
   end subroutine condense

   !> By how much the end misses the start, over the scales.
   pure function gap_of(orbit) result(gap)
      type(orbit_type), intent(in) :: orbit
      real(wp) :: gap(size(orbit%start))
      gap = (orbit%at(:, points, orbit%intervals()) - orbit%start)/orbit%scale
   end function gap_of

   !> matrix x = b for the change x of the start, and (a matrix of n + 1 columns) of the parameter, that closes the
   !> orbit: (1 - M) x = gap.
   subroutine closing_equations(orbit, equations, matrix, b)
      type(orbit_type), intent(in) :: orbit
      type(orbit_equations_type), intent(in) :: equations
      real(wp), intent(out) :: matrix(:, :), b(:)
      integer :: i, n
      n = size(b)
      matrix(:, :n) = -equations%at_end(:, :n)
      do i = 1, n
         matrix(i, i) = matrix(i, i) + 1
      end do
      if (size(matrix, 2) > n) matrix(:, n + 1) = -equations%at_end(:, n + 2)
      b = equations%at_end(:, n + 1) + gap_of(orbit)
   end subroutine closing_equations

   !> Moves an orbit by a change of its start and (an element more) of the parameter, over the scales; where it
   !> `closes`, also by what the equations lack. Of a correction longer than `longest` only a part is made.
   subroutine move_orbit(orbit, equations, change, closes, longest)
      type(orbit_type), intent(inout) :: orbit
      type(orbit_equations_type), intent(in) :: equations
      real(wp), intent(in) :: change(:)
      logical, intent(in) :: closes
      real(wp), intent(in) :: longest
      real(wp), allocatable :: corrections(:, :)
      real(wp) :: at_start(size(orbit%start)), share
      integer :: k, i, n
      n = size(orbit%start)
      allocate (corrections(points*n, orbit%intervals()))
      at_start = change(:n)
      do k = 1, orbit%intervals()
         associate (at_points => equations%at_points(:, :, k))
            corrections(:, k) = matmul(at_points(:, :n), at_start)
            if (closes) corrections(:, k) = corrections(:, k) + at_points(:, n + 1)
            if (size(change) > n) corrections(:, k) = corrections(:, k) + change(n + 1)*at_points(:, n + 2)
            at_start = corrections((points - 1)*n + 1:, k)
         end associate
      end do
      orbit%correction = max(maxval(abs(change(:n))), maxval(abs(corrections)))
      call settle(orbit, closes)
      share = longest/max(longest, orbit%correction)
      orbit%start = orbit%start + share*orbit%scale*change(:n)
      do k = 1, orbit%intervals()
         do i = 1, points
            orbit%at(:, i, k) = orbit%at(:, i, k) + share*orbit%scale*corrections((i - 1)*n + 1:i*n, k)
         end do
      end do
   end subroutine move_orbit

   !> Notes whether ends of intervals that go where the orbit passes a kink still help: where it does so slowly, they go
   !> far for a small correction, and the passage after them, so that Newton's method would come closer by little in
   !> each round. Nor does it matter then how far an end is from the passage: the rates there are close to the kink's.
   pure subroutine settle(orbit, closes)
      type(orbit_type), intent(inout) :: orbit
      logical, intent(in) :: closes
      if (closes) then
         orbit%settled = orbit%settled .or. orbit%correction < near .and. orbit%correction > slow*orbit%last_correction
         orbit%last_correction = orbit%correction
      else
         orbit%settled = .false.
         orbit%last_correction = huge(1.0_wp)
      end if
   end subroutine settle

   !> Solves the linear equations of interval k for the corrections of its points, over the scales, by column. The
   !> equations of the displacements, x' = v, are satisfied by x_i = x_0 + h sum_j a_ij v_j, which leaves a system on
   !> the other states alone.
   subroutine eliminate(model, orbit, parts, k, at_points, error, shift)
      class(ode_model_type), intent(inout) :: model
      type(orbit_type), intent(inout) :: orbit
      type(parts_type), intent(in) :: parts
      integer, intent(in) :: k
      real(wp), intent(out) :: at_points(:, :)
      type(error_type), allocatable, intent(out) :: error
      type(parameter_shift_type), intent(in), optional :: shift
      real(wp) :: jacobian(model%n, model%n, points), gap(model%n, size(at_points, 2) - model%n, points)
      real(wp) :: matrix(points*size(parts%u), points*size(parts%u)), b(points*size(parts%u), size(at_points, 2))
      real(wp) :: per_rate(size(parts%x))
      integer :: pivots(points*size(parts%u)), info, i, j, m, columns
      m = size(parts%u)
      columns = size(at_points, 2)
      associate (x => parts%x, h => orbit%time(k) - orbit%time(k - 1))
         call linearize(model, orbit, k, jacobian, gap, error, shift)
         if (allocated(error)) return
         per_rate = h*orbit%scale(parts%v)/orbit%scale(x)
         call assemble(parts, per_rate, jacobian, gap, matrix, b)
         call dgesv(points*m, columns, matrix, points*m, pivots, b, points*m, info)
         if (info /= 0) then
            call raise(error, numerics_error, 'Newton''s equations have no solution at t = ' &
               & //to_text(orbit%time(k))//' s')
            return
         end if
         do i = 1, points
            associate (o => (i - 1)*model%n)
               at_points(o + parts%u, :) = b((i - 1)*m + 1:i*m, :)
               at_points(o + x, :) = 0
               at_points(o + x, model%n + 1:) = gap(x, :, i)
               do j = 1, size(x)
                  at_points(o + x(j), x(j)) = 1
               end do
               do j = 1, points
                  at_points(o + x, :) = at_points(o + x, :) + weight(i, j) &
                     & *spread(per_rate, 2, columns)*b((j - 1)*m + parts%v_in_u, :)
               end do
            end associate
         end do
      end associate
   end subroutine eliminate

   !> At the points of interval k: the derivatives of the rates, over the scales and times the interval, and how far the
   !> equations are from being satisfied, (state, 1, point); (state, 2, point) is what the parameter adds to that.
   subroutine linearize(model, orbit, k, jacobian, gap, error, shift)
      class(ode_model_type), intent(inout) :: model
      type(orbit_type), intent(inout) :: orbit
      integer, intent(in) :: k
      real(wp), intent(out) :: jacobian(:, :, :), gap(:, :, :)
      type(error_type), allocatable, intent(out) :: error
      type(parameter_shift_type), intent(in), optional :: shift
      real(wp), dimension(model%n, points) :: rate, over_parameter
      real(wp) :: before(model%n), inside(model%n), h
      integer :: i, l
      logical :: ok
      h = orbit%time(k) - orbit%time(k - 1)
      before = orbit%start
      if (k > 1) before = orbit%at(:, points, k - 1)
      do i = 1, points
         inside = collocated_state(orbit, k, i)
         call model%tangent(orbit%time(k - 1) + place(i)*h, inside, rate(:, i), jacobian(:, :, i), ok)
         if (.not. ok) then
            orbit%refused = .true.
            call raise(error, numerics_error, 'at t = '//to_text(orbit%time(k - 1) + place(i)*h)//' s of the period: ' &
               & //model%refusal)
            return
         end if
         if (present(shift)) over_parameter(:, i) = (shift%rates(:, i, k) - rate(:, i))/shift%amount
         rate(:, i) = rate(:, i) + matmul(jacobian(:, :, i), orbit%at(:, i, k) - inside)
         do l = 1, model%n
            jacobian(:, l, i) = h*orbit%scale(l)*jacobian(:, l, i)/orbit%scale
         end do
      end do
      do i = 1, points
         gap(:, 1, i) = (before - orbit%at(:, i, k) + h*matmul(rate, weight(i, :)))/orbit%scale
         if (present(shift)) gap(:, 2, i) = h*matmul(over_parameter, weight(i, :))/orbit%scale
      end do
      orbit%residual = max(orbit%residual, maxval(abs(gap(:, 1, :))))
   end subroutine linearize

   !> The state at which the equations of a point of interval k are taken.
   pure function collocated_state(orbit, k, point) result(y)
      type(orbit_type), intent(in) :: orbit
      integer, intent(in) :: k, point
      real(wp) :: y(size(orbit%start))
      y = orbit%at(:, point, k)
      if (point == points) y = y + inward*(orbit%at(:, points - 1, k) - y)
   end function collocated_state

   !> The linear system of an interval on what is no displacement.
   pure subroutine assemble(parts, per_rate, jacobian, gap, matrix, b)
      type(parts_type), intent(in) :: parts
      real(wp), intent(in) :: per_rate(:), jacobian(:, :, :), gap(:, :, :)
      real(wp), intent(out) :: matrix(:, :), b(:, :)
      real(wp) :: over_x(size(parts%u), size(parts%x)), over_v(size(parts%u), size(parts%x))
      integer :: i, j, l, m, n
      m = size(parts%u)
      n = size(jacobian, 1)
      matrix = 0
      b = 0
      do j = 1, points
         over_x = jacobian(parts%u, parts%x, j)
         over_v = over_x*spread(per_rate, 1, m)
         do i = 1, points
            associate (rows => b((i - 1)*m + 1:i*m, :), block => matrix((i - 1)*m + 1:i*m, :))
               block(:, (j - 1)*m + 1:j*m) = block(:, (j - 1)*m + 1:j*m) &
                  & - weight(i, j)*jacobian(parts%u, parts%u, j)
               do l = 1, points
                  block(:, (l - 1)*m + parts%v_in_u) = block(:, (l - 1)*m + parts%v_in_u) &
                     & - weight(i, j)*weight(j, l)*over_v
               end do
               rows(:, parts%x) = rows(:, parts%x) + weight(i, j)*over_x
               rows(:, n + 1:) = rows(:, n + 1:) + weight(i, j)*matmul(over_x, gap(parts%x, :, j))
            end associate
         end do
      end do
      do i = 1, points
         b((i - 1)*m + 1:i*m, n + 1:) = b((i - 1)*m + 1:i*m, n + 1:) + gap(parts%u, :, i)
         do l = 1, m
            b((i - 1)*m + l, parts%u(l)) = b((i - 1)*m + l, parts%u(l)) + 1
            matrix((i - 1)*m + l, (i - 1)*m + l) = matrix((i - 1)*m + l, (i - 1)*m + l) + 1
         end do
      end do
   end subroutine assemble
end module orbit_collocation
