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
   use interval_maps, only: interval_maps_type, new_interval_maps, weight, padded
   implicit none (type, external)
   private
   public :: newton_round
   public :: orbit_equations_type, parameter_shift_type, condense, closing_equations, move_orbit, collocated_state

   !> The derivatives at the end of an interval are taken this part of the way to the point before: at a kink, on the
   !> interval's side of it. To the same order the rates are still those at the end.
   real(wp), parameter :: inward = 1e-5_wp

   !> The equations linearised on an orbit and eliminated inside of its intervals, all over the scales.
   type :: orbit_equations_type
      private
      type(interval_maps_type) :: maps
      !> How the end of the period follows, (column, state): columns 1 to n from a change of the state at its start,
      !> n + 1 from what the equations lack, n + 2 (where it is asked for) from a change of the parameter by 1.
      real(wp), allocatable :: at_end(:, :)
   end type orbit_equations_type

   !> What the equations are for another value of the parameter.
   type :: parameter_shift_type
      !> By how much it is larger; then the rates at the points' `collocated_state`, (state, point, interval), times the
      !> period over that at the present value.
      real(wp) :: amount = 0
      real(wp), allocatable :: rates(:, :, :)
   end type parameter_shift_type

   !> Where corrections below this size, over the scales, no longer fall by this factor a round, the mesh has settled.
   real(wp), parameter :: slow = 0.1_wp, near = 1e-3_wp

contains

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
      real(wp) :: jacobian(model%n, model%n, points)
      real(wp), allocatable :: gap(:, :, :), start(:, :), at(:, :, :)
      integer :: k, i, n, constants
      logical :: ok
      n = model%n
      constants = merge(2, 1, present(shift))
      associate (columns => padded(n + constants))
         allocate (gap(n, constants, points), start(columns, n + constants), at(columns, n, points))
      end associate
      equations%maps = new_interval_maps(model, orbit%scale, orbit%intervals(), constants)
      start = 0
      do i = 1, n + constants
         start(i, i) = 1
      end do
      orbit%residual = 0
      orbit%refused = .false.
      do k = 1, orbit%intervals()
         call linearize(model, orbit, k, jacobian, gap, error, shift)
         if (allocated(error)) return
         call equations%maps%eliminate(k, orbit%time(k) - orbit%time(k - 1), jacobian, gap, ok)
         if (.not. ok) then
            call raise(error, numerics_error, 'Newton''s equations have no solution at t = ' &
               & //to_text(orbit%time(k))//' s')
            return
         end if
         call equations%maps%follow(k, points, start, at)
         start(:, :n) = at(:, :, points)
      end do
      equations%at_end = start(:n + constants, :n)
      if (.not. all(abs(equations%at_end) <= huge(1.0_wp))) then
         call raise(error, numerics_error, 'Newton''s equations have no solution')
         return
      end if
      orbit%monodromy = transpose(equations%at_end(:n, :))
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
      matrix(:, :n) = -transpose(equations%at_end(:n, :))
      do i = 1, n
         matrix(i, i) = matrix(i, i) + 1
      end do
      if (size(matrix, 2) > n) matrix(:, n + 1) = -equations%at_end(n + 2, :)
      b = equations%at_end(n + 1, :) + gap_of(orbit)
   end subroutine closing_equations

   !> Moves an orbit by a change of its start and (an element more) of the parameter, over the scales; where it
   !> `closes`, also by what the equations lack. Of a correction longer than `longest` only a part is made.
   subroutine move_orbit(orbit, equations, change, closes, longest)
      type(orbit_type), intent(inout) :: orbit
      type(orbit_equations_type), intent(in) :: equations
      real(wp), intent(in) :: change(:)
      logical, intent(in) :: closes
      real(wp), intent(in) :: longest
      real(wp), allocatable :: corrections(:, :, :, :)
      real(wp) :: start(1, size(equations%at_end, 1)), share
      integer :: k, i, n
      n = size(orbit%start)
      allocate (corrections(1, n, points, orbit%intervals()))
      start = 0
      start(1, :n) = change(:n)
      if (closes) start(1, n + 1) = 1
      start(1, n + 2:size(change) + 1) = change(n + 1:)
      do k = 1, orbit%intervals()
         call equations%maps%follow(k, 1, start, corrections(:, :, :, k))
         start(1, :n) = corrections(1, :, points, k)
      end do
      orbit%correction = max(maxval(abs(change(:n))), maxval(abs(corrections)))
      call settle(orbit, closes)
      share = longest/max(longest, orbit%correction)
      orbit%start = orbit%start + share*orbit%scale*change(:n)
      do k = 1, orbit%intervals()
         do i = 1, points
            orbit%at(:, i, k) = orbit%at(:, i, k) + share*orbit%scale*corrections(1, :, i, k)
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
         if (i == points) rate(:, i) = rate(:, i) + matmul(jacobian(:, :, i), orbit%at(:, i, k) - inside)
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
end module orbit_collocation
