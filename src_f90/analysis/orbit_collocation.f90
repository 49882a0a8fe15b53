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
   implicit none (type, external)
   private
   public :: orbit_type, newton_round, points, place

   !> Points of an interval.
   integer, parameter :: points = 3
   real(wp), parameter :: s6 = sqrt(6.0_wp)
   !> Where the points stand in an interval, and the integrals of their polynomials up to each.
   real(wp), parameter :: place(points) = [(4 - s6)/10, (4 + s6)/10, 1.0_wp]
   real(wp), parameter :: weight(points, points) = reshape([(88 - 7*s6)/360, (296 + 169*s6)/1800, (16 - s6)/36, &
      & (296 - 169*s6)/1800, (88 + 7*s6)/360, (16 + s6)/36, (-2 + 3*s6)/225, (-2 - 3*s6)/225, 1/9.0_wp], &
      & [points, points])

   !> The derivatives at the end of an interval are taken this part of the way to the point before: at a kink, on the
   !> interval's side of it. To the same order the rates are still those at the end.
   real(wp), parameter :: inward = 1e-5_wp

   type :: orbit_type
      !> Ends of the intervals, s, (0:intervals).
      real(wp), allocatable :: time(:)
      !> State at the start of the period; states at the points, (state, point, interval): the last point of an interval
      !> is its end.
      real(wp), allocatable :: start(:), at(:, :, :)
      !> Natural size of each state.
      real(wp), allocatable :: scale(:)
      !> What the state at the start's change does to the state a period later, over the scales: it has the multipliers
      !> as eigenvalues.
      real(wp), allocatable :: monodromy(:, :)
      !> Newton's last correction, over the scales, and how far the equations were from being satisfied before it.
      real(wp) :: correction = huge(1.0_wp), residual = huge(1.0_wp)
   contains
      procedure :: intervals
      procedure :: state_at
      procedure :: values_at_ends
      procedure :: change_mesh
   end type orbit_type

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

   pure integer function intervals(self)
      class(orbit_type), intent(in) :: self
      intervals = size(self%at, 3)
   end function intervals

   !> The state y at a time of the period, s.
   pure subroutine state_at(self, t, y)
      class(orbit_type), intent(in) :: self
      real(wp), intent(in) :: t
      real(wp), intent(out) :: y(:)
      real(wp) :: nodes(0:points), x, factor
      integer :: k, i, j
      k = interval_of(self%time, t)
      x = (t - self%time(k - 1))/(self%time(k) - self%time(k - 1))
      nodes = [0.0_wp, place]
      y = 0
      do i = 0, points
         factor = 1
         do j = 0, points
            if (j /= i) factor = factor*(x - nodes(j))/(nodes(i) - nodes(j))
         end do
         if (i > 0) then
            y = y + factor*self%at(:, i, k)
         else if (k > 1) then
            y = y + factor*self%at(:, points, k - 1)
         else
            y = y + factor*self%start
         end if
      end do
   end subroutine state_at

   !> Number of the interval with the time t.
   pure integer function interval_of(time, t) result(k)
      real(wp), intent(in) :: time(0:), t
      integer :: above, middle
      k = 1
      above = ubound(time, 1) + 1
      do while (above - k > 1)
         middle = (k + above)/2
         if (time(middle - 1) < t) then
            k = middle
         else
            above = middle
         end if
      end do
   end function interval_of

   !> A state at the start and at the ends of the intervals.
   pure function values_at_ends(self, state) result(values)
      class(orbit_type), intent(in) :: self
      integer, intent(in) :: state
      real(wp) :: values(0:self%intervals())
      values(0) = self%start(state)
      values(1:) = self%at(state, points, :)
   end function values_at_ends

   !> Puts the same motion on intervals that end at other times, s; the first and the last stay.
   pure subroutine change_mesh(self, time)
      class(orbit_type), intent(inout) :: self
      real(wp), intent(in) :: time(0:)
      real(wp), allocatable :: at(:, :, :)
      integer :: k, i
      allocate (at(size(self%start), points, ubound(time, 1)))
      do k = 1, ubound(time, 1)
         do i = 1, points
            call self%state_at(time(k - 1) + place(i)*(time(k) - time(k - 1)), at(:, i, k))
         end do
      end do
      deallocate (self%time)
      allocate (self%time(0:ubound(time, 1)), source=time)
      call move_alloc(at, self%at)
      self%correction = huge(self%correction)
   end subroutine change_mesh

   !> One round of Newton's method; of a correction longer than `longest`, over the scales, only a part is made. A
   !> numerics error where the model refuses a state or the equations have no solution: then the orbit is as it was.
   subroutine newton_round(model, orbit, longest, error)
      class(ode_model_type), intent(inout) :: model
      type(orbit_type), intent(inout) :: orbit
      real(wp), intent(in) :: longest
      type(error_type), allocatable, intent(out) :: error
      !> Corrections of the points of each interval: by a change of the state at its start, and without one.
      real(wp), allocatable :: by_start(:, :, :), corrections(:, :)
      type(parts_type) :: parts
      real(wp) :: product(model%n, model%n + 1), closing(model%n, 1), change(model%n), share
      integer :: k, i, n
      logical :: ok
      n = model%n
      parts = new_parts(model)
      allocate (by_start(points*n, n + 1, orbit%intervals()), corrections(points*n, orbit%intervals()))
      product = 0
      do i = 1, n
         product(i, i) = 1
      end do
      orbit%residual = 0
      do k = 1, orbit%intervals()
         call eliminate(model, orbit, parts, k, by_start(:, :, k), error)
         if (allocated(error)) return
         associate (last => by_start((points - 1)*n + 1:, :, k))
            product = matmul(last(:, :n), product)
            product(:, n + 1) = product(:, n + 1) + last(:, n + 1)
         end associate
      end do
      orbit%monodromy = product(:, :n)
      associate (gap => (orbit%at(:, points, orbit%intervals()) - orbit%start)/orbit%scale)
         orbit%residual = max(orbit%residual, maxval(abs(gap)))
         call close_period(orbit%monodromy, product(:, n + 1) + gap, closing, ok)
      end associate
      if (.not. (ok .and. all(abs(product) <= huge(1.0_wp)) .and. all(abs(closing) <= huge(1.0_wp)))) then
         call raise(error, numerics_error, 'Newton''s equations have no solution')
         return
      end if
      change = closing(:, 1)
      orbit%correction = maxval(abs(change))
      do k = 1, orbit%intervals()
         call follow(by_start(:, :, k), change, corrections(:, k))
      end do
      orbit%correction = max(orbit%correction, maxval(abs(corrections)))
      share = longest/max(longest, orbit%correction)
      orbit%start = orbit%start + share*orbit%scale*closing(:, 1)
      do k = 1, orbit%intervals()
         do i = 1, points
            orbit%at(:, i, k) = orbit%at(:, i, k) + share*orbit%scale*corrections((i - 1)*n + 1:i*n, k)
         end do
      end do
   end subroutine newton_round

   !> Solves the linear equations of interval k for the corrections of its points, over the scales: columns 1 to n by a
   !> change of the state at its start, the last without one. The equations of the displacements, x' = v, are satisfied
   !> by x_i = x_0 + h sum_j a_ij v_j, which leaves a system on the other states alone.
   subroutine eliminate(model, orbit, parts, k, by_start, error)
      class(ode_model_type), intent(inout) :: model
      type(orbit_type), intent(inout) :: orbit
      type(parts_type), intent(in) :: parts
      integer, intent(in) :: k
      real(wp), intent(out) :: by_start(:, :)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: jacobian(model%n, model%n, points), gap(model%n, points), per_rate(size(parts%x))
      real(wp) :: matrix(points*size(parts%u), points*size(parts%u)), b(points*size(parts%u), model%n + 1)
      integer :: pivots(points*size(parts%u)), info, i, j, m
      m = size(parts%u)
      associate (x => parts%x, h => orbit%time(k) - orbit%time(k - 1))
         call linearize(model, orbit, k, jacobian, gap, error)
         if (allocated(error)) return
         per_rate = h*orbit%scale(parts%v)/orbit%scale(x)
         call assemble(parts, per_rate, jacobian, gap, matrix, b)
         call dgesv(points*m, model%n + 1, matrix, points*m, pivots, b, points*m, info)
         if (info /= 0) then
            call raise(error, numerics_error, 'Newton''s equations have no solution at t = ' &
               & //to_text(orbit%time(k))//' s')
            return
         end if
         do i = 1, points
            associate (o => (i - 1)*model%n)
               by_start(o + parts%u, :) = b((i - 1)*m + 1:i*m, :)
               by_start(o + x, :) = 0
               by_start(o + x, model%n + 1) = gap(x, i)
               do j = 1, size(x)
                  by_start(o + x(j), x(j)) = 1
               end do
               do j = 1, points
                  by_start(o + x, :) = by_start(o + x, :) + weight(i, j) &
                     & *spread(per_rate, 2, model%n + 1)*b((j - 1)*m + parts%v_in_u, :)
               end do
            end associate
         end do
      end associate
   end subroutine eliminate

   !> At the points of interval k: the derivatives of the rates, over the scales and times the interval, and how far the
   !> equations are from being satisfied.
   subroutine linearize(model, orbit, k, jacobian, gap, error)
      class(ode_model_type), intent(inout) :: model
      type(orbit_type), intent(inout) :: orbit
      integer, intent(in) :: k
      real(wp), intent(out) :: jacobian(:, :, :), gap(:, :)
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: rate(model%n, points), before(model%n), inside(model%n), h
      integer :: i, l
      logical :: ok
      h = orbit%time(k) - orbit%time(k - 1)
      before = orbit%start
      if (k > 1) before = orbit%at(:, points, k - 1)
      do i = 1, points
         inside = orbit%at(:, i, k)
         if (i == points) inside = inside + inward*(orbit%at(:, points - 1, k) - inside)
         call model%tangent(orbit%time(k - 1) + place(i)*h, inside, rate(:, i), jacobian(:, :, i), ok)
         if (.not. ok) then
            call raise(error, numerics_error, 'at t = '//to_text(orbit%time(k - 1) + place(i)*h)//' s of the period: ' &
               & //model%refusal)
            return
         end if
         rate(:, i) = rate(:, i) + matmul(jacobian(:, :, i), orbit%at(:, i, k) - inside)
         do l = 1, model%n
            jacobian(:, l, i) = h*orbit%scale(l)*jacobian(:, l, i)/orbit%scale
         end do
      end do
      do i = 1, points
         gap(:, i) = (before - orbit%at(:, i, k) + h*matmul(rate, weight(i, :)))/orbit%scale
      end do
      orbit%residual = max(orbit%residual, maxval(abs(gap)))
   end subroutine linearize

   !> The linear system of an interval on what is no displacement.
   pure subroutine assemble(parts, per_rate, jacobian, gap, matrix, b)
      type(parts_type), intent(in) :: parts
      real(wp), intent(in) :: per_rate(:), jacobian(:, :, :), gap(:, :)
      real(wp), intent(out) :: matrix(:, :), b(:, :)
      real(wp) :: over_x(size(parts%u), size(parts%x)), over_v(size(parts%u), size(parts%x))
      integer :: i, j, l, m
      m = size(parts%u)
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
               rows(:, size(rows, 2)) = rows(:, size(rows, 2)) + weight(i, j)*matmul(over_x, gap(parts%x, j))
            end associate
         end do
      end do
      do i = 1, points
         associate (last => size(b, 2))
            b((i - 1)*m + 1:i*m, last) = b((i - 1)*m + 1:i*m, last) + gap(parts%u, i)
         end associate
         do l = 1, m
            b((i - 1)*m + l, parts%u(l)) = b((i - 1)*m + l, parts%u(l)) + 1
            matrix((i - 1)*m + l, (i - 1)*m + l) = matrix((i - 1)*m + l, (i - 1)*m + l) + 1
         end do
      end do
   end subroutine assemble

   !> (1 - M) x = b: the change of the start that closes the orbit.
   subroutine close_period(monodromy, b, x, ok)
      real(wp), intent(in) :: monodromy(:, :), b(:)
      real(wp), intent(out) :: x(:, :)
      logical, intent(out) :: ok
      real(wp) :: matrix(size(b), size(b))
      integer :: pivots(size(b)), info, i
      matrix = -monodromy
      do i = 1, size(b)
         matrix(i, i) = matrix(i, i) + 1
      end do
      x(:, 1) = b
      call dgesv(size(b), 1, matrix, size(b), pivots, x, size(b), info)
      ok = info == 0
   end subroutine close_period

   !> The corrections of an interval's points for the change of the state at its start, over the scales; `change`
   !> becomes that at its end.
   pure subroutine follow(by_start, change, corrections)
      real(wp), intent(in) :: by_start(:, :)
      real(wp), intent(inout) :: change(:)
      real(wp), intent(out) :: corrections(:)
      associate (n => size(change))
         corrections = matmul(by_start(:, :n), change) + by_start(:, n + 1)
         change = corrections((points - 1)*n + 1:)
      end associate
   end subroutine follow
end module orbit_collocation
