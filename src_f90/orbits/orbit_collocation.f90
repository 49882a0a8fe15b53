!> A periodic orbit of an ODE by collocation: over the time of one period a mesh; on each of its intervals a polynomial
!> that satisfies the equations at the three points of Radau (RADAU IIA, order 5; Hairer and Wanner 1996, IV.8), which
!> damps what is stiff. All equations are solved together by Newton's method with exact derivatives, so that an
!> unstable orbit is found like a stable one. Elimination from interval to interval leaves the monodromy matrix.
module orbit_collocation
   use kinds, only: wp
   use linear_algebra, only: padded, identity
   use text, only: to_text
   use errors, only: error_type, raise, numerics_error
   use ode_model, only: ode_model_type
   use orbit_polynomials, only: orbit_type, points, place
   use interval_maps, only: interval_maps_type, new_interval_maps, weight
   implicit none (type, external)
   private
   public :: orbit_equations_type, parameter_shift_type, condense, move_orbit, collocated_state

   !> The derivatives at the end of an interval are taken this part of the way to the point before: at a switching
   !> point, on the interval's side of it. To the same order the rates are still those at the end.
   real(wp), parameter :: inward = 1e-5_wp

   !> The equations linearised on an orbit and eliminated inside of its intervals, all over the scales.
   type :: orbit_equations_type
      private
      type(interval_maps_type) :: maps
      !> States, and how many constants the equations of an interval have there.
      integer :: n = 0, constants = 0
      !> How the ends of intervals go where they lie at a switching point, s, (column, 0:intervals): columns 1 to n from
      !> a change of the state at the start of the period, n + 1 from what the equations lack, then, where they are
      !> asked for, from a change of the period's logarithm and from one of the parameter by 1; the last from how far
      !> the next such end goes.
      real(wp), allocatable :: shift(:, :)
   contains
      procedure :: transitions
   end type orbit_equations_type

   !> What the equations are for another value of the parameter.
   type :: parameter_shift_type
      !> By how much it is larger; then the rates at the points' `collocated_state`, (state, point, interval), times the
      !> period over that at the present value.
      real(wp) :: amount = 0
      real(wp), allocatable :: rates(:, :, :)
   end type parameter_shift_type

   !> The shortest that intervals between switching points become at once, over what they were.
   real(wp), parameter :: shortest = 0.1_wp

contains

   !> Linearises the equations on an orbit and eliminates the points inside of the intervals: sets the orbit's monodromy
   !> matrix M, and matrix x = b for the change x of the start, and (a matrix of more columns) of what else is unknown,
   !> that closes the orbit: (1 - M) x = gap. A numerics error where the model refuses a state or equations have no
   !> solution. Ends of intervals at a switching point go where the orbit passes it; between them the mesh is stretched.
   subroutine condense(model, orbit, equations, matrix, b, refused, error, period_is_free, shift)
      class(ode_model_type), intent(inout) :: model
      type(orbit_type), intent(inout) :: orbit
      type(orbit_equations_type), intent(out) :: equations
      real(wp), intent(inout) :: matrix(:, :), b(:)
      !> Whether the model refused a state.
      logical, intent(out) :: refused
      type(error_type), allocatable, intent(out) :: error
      !> Whether the logarithm of the period is unknown: its column comes before that of the parameter.
      logical, intent(in) :: period_is_free
      !> Where the derivatives over the parameter are wanted.
      type(parameter_shift_type), intent(in), optional :: shift
      real(wp) :: jacobian(model%n, model%n, points)
      real(wp), allocatable :: gap(:, :, :), start(:, :), at(:, :, :)
      integer, allocatable :: ends(:)
      integer :: k, i, n, columns, constants
      logical :: ok
      n = model%n
      columns = n + 1 + merge(1, 0, period_is_free) + merge(1, 0, present(shift))
      constants = columns - n + merge(2, 0, any(orbit%switching_point > 0))
      equations%n = n
      equations%constants = constants
      ! the last column is how far the next end at a switching point goes
      associate (rows => padded(columns + 1))
         allocate (gap(n, constants, points), start(rows, n + constants), at(rows, n, points))
      end associate
      allocate (equations%shift(columns + 1, 0:orbit%intervals()), source=0.0_wp)
      ends = switching_ends(orbit)
      equations%shift(columns + 1, ends(2:size(ends) - 1)) = 1
      equations%maps = new_interval_maps(model, orbit%scale, orbit%intervals(), constants)
      start = 0
      start(:columns, :columns) = identity(columns)
      do k = 1, orbit%intervals()
         call linearize(model, orbit, k, jacobian, gap, error, period_is_free, shift)
         refused = allocated(error)
         if (refused) return
         call equations%maps%eliminate(k, orbit%time(k) - orbit%time(k - 1), jacobian, gap, ok)
         if (.not. ok) then
            call raise(error, numerics_error, 'Newton''s equations have no solution at t = ' &
               & //to_text(orbit%time(k))//' s')
            return
         end if
         if (constants > columns - n) start(:columns + 1, columns + 1:) = stretched(orbit, ends, equations%shift, k)
         call equations%maps%follow(k, points, start, at)
         start(:, :n) = at(:, :, points)
         if (equations%shift(columns + 1, k) > 0) call put_at_switching_point(model, orbit, k, &
            & start(:columns + 1, :n), equations%shift(:, k))
      end do
      if (.not. (all(abs(start(:columns, :n)) <= huge(1.0_wp)) .and. all(abs(equations%shift) <= huge(1.0_wp)))) then
         call raise(error, numerics_error, 'Newton''s equations have no solution')
         return
      end if
      orbit%monodromy = transpose(start(:n, :n))
      matrix(:, :n) = -orbit%monodromy
      do i = 1, n
         matrix(i, i) = matrix(i, i) + 1
      end do
      matrix(:, n + 1:columns - 1) = -transpose(start(n + 2:columns, :n))
      b = start(n + 1, :n) + orbit%gap()
   end subroutine condense

   !> How the state at the end of each interval follows from that at its start, over the scales: (to, from, interval).
   function transitions(self)
      class(orbit_equations_type), intent(in) :: self
      real(wp), allocatable :: transitions(:, :, :), start(:, :), at(:, :, :)
      integer :: k
      associate (n => self%n)
         allocate (transitions(n, n, ubound(self%shift, 2)))
         allocate (start(padded(n), n + self%constants), source=0.0_wp)
         allocate (at(padded(n), n, points))
         start(:n, :n) = identity(n)
         do k = 1, size(transitions, 3)
            call self%maps%follow(k, points, start, at)
            transitions(:, :, k) = transpose(at(:n, :, points))
         end do
      end associate
   end function transitions

   !> The ends of intervals at switching points, and those of the period.
   pure function switching_ends(orbit) result(ends)
      type(orbit_type), intent(in) :: orbit
      integer, allocatable :: ends(:)
      integer :: k
      associate (n => orbit%intervals())
         ends = [0, pack([(k, k=1, n - 1)], orbit%switching_point(1:n - 1) > 0), n]
      end associate
   end function switching_ends

   !> By how much both ends of interval k go, s, (column, end), where the mesh is stretched between two ends.
   pure function stretched(orbit, ends, shift, k)
      type(orbit_type), intent(in) :: orbit
      integer, intent(in) :: ends(:), k
      real(wp), intent(in) :: shift(:, 0:)
      real(wp) :: stretched(size(shift, 1), 2), part
      integer :: i, before
      before = count(ends < k)
      associate (from => ends(before), to => ends(before + 1))
         do i = 1, 2
            part = (orbit%time(k + i - 2) - orbit%time(from))/(orbit%time(to) - orbit%time(from))
            stretched(:, i) = (1 - part)*shift(:, from) + part*shift(:, to)
         end do
      end associate
   end function stretched

   !> Lets end k go so far that the state is at the switching point there, which puts this into how all states follow.
   pure subroutine put_at_switching_point(model, orbit, k, states, shift)
      class(ode_model_type), intent(in) :: model
      type(orbit_type), intent(in) :: orbit
      integer, intent(in) :: k
      real(wp), intent(inout) :: states(:, :)
      real(wp), intent(inout) :: shift(:)
      integer, allocatable :: state(:)
      real(wp), allocatable :: value(:)
      integer :: i, columns
      columns = size(shift) - 1
      call model%switching_points(state, value)
      shift = 0
      associate (s => state(orbit%switching_point(k)), v => value(orbit%switching_point(k)), n => size(states, 2))
         if (abs(states(columns + 1, s)) > 0) then
            shift(:columns) = -states(:columns, s)
            shift(n + 1) = shift(n + 1) + (v - orbit%at(s, points, k))/orbit%scale(s)
            shift = shift/states(columns + 1, s)
         end if
      end associate
      do i = 1, size(states, 2)
         states(:columns, i) = states(:columns, i) + shift(:columns)*states(columns + 1, i)
      end do
      states(columns + 1, :) = 0
   end subroutine put_at_switching_point

   !> Moves an orbit by a change of its start and (further elements) of what else is unknown, over the scales, in the
   !> time that it has; where it `closes`, also by what the equations lack. Of a correction longer than `longest` only a
   !> part is made.
   subroutine move_orbit(orbit, equations, change, closes, longest)
      type(orbit_type), intent(inout) :: orbit
      type(orbit_equations_type), intent(in) :: equations
      real(wp), intent(in) :: change(:)
      logical, intent(in) :: closes
      real(wp), intent(in) :: longest
      real(wp), allocatable :: corrections(:, :, :, :)
      real(wp) :: columns(size(equations%shift, 1) - 1), start(1, size(equations%shift, 1) + 1), share
      real(wp) :: shift(1, 0:orbit%intervals())
      integer, allocatable :: ends(:)
      integer :: k, i, n
      logical :: kept
      n = size(orbit%start)
      allocate (corrections(1, n, points, orbit%intervals()))
      columns = 0
      columns(:n) = change(:n)
      if (closes) columns(n + 1) = 1
      columns(n + 2:size(change) + 1) = change(n + 1:)
      shift(1, :) = matmul(columns, equations%shift(:size(columns), :))
      start(1, :size(columns)) = columns
      do
         ends = switching_ends(orbit)
         do k = 1, orbit%intervals()
            start(:, size(columns) + 1:) = stretched(orbit, ends, shift, k)
            shift(:, k) = start(:, size(columns) + 2)
            call equations%maps%follow(k, 1, start(:, :n + equations%constants), corrections(:, :, :, k))
            start(1, :n) = corrections(1, :, points, k)
         end do
         start(1, :n) = change(:n)
         orbit%correction = max(maxval(abs(change(:n))), maxval(abs(corrections)))
         share = longest/max(longest, orbit%correction)
         call keep_order(orbit, ends, share*shift(1, :), kept)
         if (kept) exit
      end do
      orbit%start = orbit%start + share*orbit%scale*change(:n)
      do k = 1, orbit%intervals()
         do i = 1, points
            orbit%at(:, i, k) = orbit%at(:, i, k) + share*orbit%scale*corrections(1, :, i, k)
         end do
      end do
      orbit%time = orbit%time + share*shift(1, :)
   end subroutine move_orbit

   !> Where two ends at switching points would come together, or change their order, the one that goes further lies
   !> there no more.
   pure subroutine keep_order(orbit, ends, shift, kept)
      type(orbit_type), intent(inout) :: orbit
      integer, intent(in) :: ends(:)
      real(wp), intent(in) :: shift(0:)
      !> Whether there are no such ends.
      logical, intent(out) :: kept
      integer :: i
      do i = 2, size(ends)
         associate (from => ends(i - 1), to => ends(i), point => orbit%switching_point)
            associate (length => orbit%time(to) - orbit%time(from))
               kept = length + shift(to) - shift(from) >= shortest*length .or. max(point(from), point(to)) <= 0
            end associate
            if (.not. kept) point(merge(from, to, abs(shift(from)) > abs(shift(to)) .or. point(to) <= 0)) = -1
            if (.not. kept) return
         end associate
      end do
   end subroutine keep_order

   !> At the points of interval k: the derivatives of the rates, over the scales and times the interval, and how far the
   !> equations are from being satisfied, (state, 1, point); then, where they are asked for, what the logarithm of the
   !> period and the parameter add to that, and, if there are two more, a shift of the interval's start and end by 1 s.
   subroutine linearize(model, orbit, k, jacobian, gap, error, period_is_free, shift)
      class(ode_model_type), intent(inout) :: model
      type(orbit_type), intent(in) :: orbit
      integer, intent(in) :: k
      real(wp), intent(out) :: jacobian(:, :, :), gap(:, :, :)
      type(error_type), allocatable, intent(out) :: error
      logical, intent(in) :: period_is_free
      type(parameter_shift_type), intent(in), optional :: shift
      real(wp), dimension(model%n, points) :: rate, over_parameter, df_dt
      real(wp) :: before(model%n), inside(model%n), h
      integer :: i, l, constants
      logical :: ok
      h = orbit%time(k) - orbit%time(k - 1)
      before = orbit%start
      if (k > 1) before = orbit%at(:, points, k - 1)
      constants = 1 + merge(1, 0, period_is_free) + merge(1, 0, present(shift))
      do i = 1, points
         inside = collocated_state(orbit, k, i)
         call model%rhs_and_jacobian(orbit%time(k - 1) + place(i)*h, inside, rate(:, i), jacobian(:, :, i), ok)
         if (.not. ok) then
            call raise(error, numerics_error, 'at t = '//to_text(orbit%time(k - 1) + place(i)*h)//' s of the period: ' &
               & //model%refusal)
            return
         end if
         if (present(shift)) over_parameter(:, i) = (shift%rates(:, i, k) - rate(:, i))/shift%amount
         if (size(gap, 2) > constants) df_dt(:, i) = model%df_dt(orbit%time(k - 1) + place(i)*h)
         if (i == points) rate(:, i) = rate(:, i) + matmul(jacobian(:, :, i), orbit%at(:, i, k) - inside)
         do l = 1, model%n
            jacobian(:, l, i) = h*orbit%scale(l)*jacobian(:, l, i)/orbit%scale
         end do
      end do
      do i = 1, points
         gap(:, 1, i) = (before - orbit%at(:, i, k) + h*matmul(rate, weight(i, :)))/orbit%scale
         if (period_is_free) gap(:, 2, i) = h*matmul(rate, weight(i, :))/orbit%scale
         if (present(shift)) gap(:, constants, i) = h*matmul(over_parameter, weight(i, :))/orbit%scale
         if (size(gap, 2) == constants) cycle
         gap(:, constants + 1, i) = matmul(h*df_dt*spread(1 - place, 1, model%n) - rate, weight(i, :))/orbit%scale
         gap(:, constants + 2, i) = matmul(h*df_dt*spread(place, 1, model%n) + rate, weight(i, :))/orbit%scale
      end do
   end subroutine linearize

   !> The state at which the equations of a point of interval k are taken.
   pure function collocated_state(orbit, k, point) result(y)
      type(orbit_type), intent(in) :: orbit
      integer, intent(in) :: k, point
      real(wp) :: y(size(orbit%start))
      y = orbit%at(:, point, k)
      if (point == points) y = y + inward*(orbit%at(:, points - 1, k) - y)
   end function collocated_state
end module orbit_collocation
