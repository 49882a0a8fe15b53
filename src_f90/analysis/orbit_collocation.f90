!> A periodic orbit of an ODE by collocation: over the time of one period a mesh; on each of its intervals a polynomial
!> that satisfies the equations at the three points of Radau (RADAU IIA, order 5; Hairer and Wanner 1996, IV.8), which
!> damps what is stiff. All equations are solved together by Newton's method with exact derivatives, so that an
!> unstable orbit is found like a stable one. Elimination from interval to interval leaves the monodromy matrix.
module orbit_collocation
   use kinds, only: wp
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
      procedure :: change_mesh
   end type orbit_type

contains

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
      k = max(1, min(self%intervals(), count(self%time < t)))
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

   !> Puts the same motion on intervals that end at other times, s; the first and the last stay.
   pure subroutine change_mesh(self, time)
      class(orbit_type), intent(inout) :: self
      real(wp), intent(in) :: time(0:)
      real(wp) :: at(size(self%start), points, ubound(time, 1))
      integer :: k, i
      do k = 1, ubound(time, 1)
         do i = 1, points
            call self%state_at(time(k - 1) + place(i)*(time(k) - time(k - 1)), at(:, i, k))
         end do
      end do
      deallocate (self%time)
      allocate (self%time(0:ubound(time, 1)), source=time)
      self%at = at
      self%correction = huge(self%correction)
   end subroutine change_mesh

   !> One round of Newton's method; of a correction longer than `longest`, over the scales, only a part is made. `ok` is
   !> false where the model refuses a state, and says why, or where the equations are singular: then the orbit is as it
   !> was.
   subroutine newton_round(model, orbit, longest, ok)
      class(ode_model_type), intent(inout) :: model
      type(orbit_type), intent(inout) :: orbit
      real(wp), intent(in) :: longest
      logical, intent(out) :: ok
      !> Corrections of the points of each interval: by a change of the state at its start, and without one.
      real(wp), allocatable :: by_start(:, :, :)
      real(wp) :: product(model%n, model%n + 1), closing(model%n, 1), change(model%n), share
      real(wp) :: corrections(points*model%n, orbit%intervals())
      integer :: k, i, n
      n = model%n
      allocate (by_start(points*n, n + 1, orbit%intervals()))
      product = 0
      do i = 1, n
         product(i, i) = 1
      end do
      orbit%residual = 0
      do k = 1, orbit%intervals()
         call eliminate(model, orbit, k, by_start(:, :, k), ok)
         if (.not. ok) return
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
      if (.not. ok) return
      change = closing(:, 1)
      orbit%correction = maxval(abs(change))
      do k = 1, orbit%intervals()
         call follow(by_start(:, :, k), change, corrections(:, k))
      end do
      orbit%correction = max(orbit%correction, maxval(abs(corrections)))
      share = min(1.0_wp, longest/orbit%correction)
      orbit%start = orbit%start + share*orbit%scale*closing(:, 1)
      do k = 1, orbit%intervals()
         do i = 1, points
            orbit%at(:, i, k) = orbit%at(:, i, k) + share*orbit%scale*corrections((i - 1)*n + 1:i*n, k)
         end do
      end do
   end subroutine newton_round

   !> Solves the linear equations of interval k for the corrections of its points, over the scales: columns 1 to n by a
   !> change of the state at its start, the last without one.
   subroutine eliminate(model, orbit, k, by_start, ok)
      class(ode_model_type), intent(inout) :: model
      type(orbit_type), intent(inout) :: orbit
      integer, intent(in) :: k
      real(wp), intent(out) :: by_start(:, :)
      logical, intent(out) :: ok
      real(wp) :: matrix(points*model%n, points*model%n), rate(model%n, points), jacobian(model%n, model%n)
      real(wp) :: before(model%n), h
      integer :: pivots(points*model%n), info, i, j, l, n
      n = model%n
      h = orbit%time(k) - orbit%time(k - 1)
      before = orbit%start
      if (k > 1) before = orbit%at(:, points, k - 1)
      do j = 1, points
         call model%tangent(orbit%time(k - 1) + place(j)*h, orbit%at(:, j, k), rate(:, j), jacobian, ok)
         if (.not. ok) return
         do l = 1, n
            jacobian(:, l) = h*jacobian(:, l)*orbit%scale(l)/orbit%scale
         end do
         do i = 1, points
            matrix((i - 1)*n + 1:i*n, (j - 1)*n + 1:j*n) = -weight(i, j)*jacobian
         end do
      end do
      by_start = 0
      do i = 1, points
         by_start((i - 1)*n + 1:i*n, n + 1) = (before - orbit%at(:, i, k) + h*matmul(rate, weight(i, :)))/orbit%scale
         do l = 1, n
            by_start((i - 1)*n + l, l) = 1
         end do
      end do
      orbit%residual = max(orbit%residual, maxval(abs(by_start(:, n + 1))))
      do i = 1, points*n
         matrix(i, i) = matrix(i, i) + 1
      end do
      call dgesv(points*n, n + 1, matrix, points*n, pivots, by_start, points*n, info)
      ok = info == 0
   end subroutine eliminate

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
