!> Periodic orbits as a problem of Newton's method, for one or for a branch of them: the unknowns are the states at the
!> start of the period, and the collocation follows them.
module orbit_problem
   use kinds, only: wp, i8
   use errors, only: error_type
   use ode_model, only: ode_model_type
   use newton_method, only: branch_problem_type, place_part_type, branch_point_type
   use orbit_polynomials, only: orbit_type, points, place
   use orbit_collocation, only: orbit_equations_type, parameter_shift_type, condense, move_orbit, collocated_state
   use linear_algebra, only: find_eigenvalues, largest_first
   use roots, only: root_bracket
   implicit none (type, external)
   private
   public :: parametric_ode_type, orbit_problem_type, begin_orbits, period_multiple_at

   !> What an orbit needs to know of an ODE beside its rates. As it is, of a model without a parameter.
   type :: parametric_ode_type
      class(ode_model_type), pointer :: model => null()
      !> Period of what drives the model as it is set, s.
      real(wp) :: period = 0
      !> Where the model at a value of the parameter is sought, not only set: where searches begin, and what the last
      !> one found, as numbers. Searches around a point of a branch begin at the same, so that what they find is smooth.
      real(wp), allocatable :: start(:), found(:)
   contains
      procedure :: set
      procedure :: new_mesh
   end type parametric_ode_type

   type, extends(branch_problem_type) :: orbit_problem_type
      type(orbit_type) :: orbit
      !> Periods of what drives the model in that of the orbit.
      integer :: period_multiple = 1
      !> Longest correction that is made, over the scales: of a longer one a part.
      real(wp) :: longest = huge(1.0_wp)
      !> Evaluations of the rates with their derivatives, and without.
      integer(i8) :: tangents = 0, evaluations = 0
      !> As they were linearised last.
      type(orbit_equations_type) :: equations
      class(parametric_ode_type), pointer :: ode => null()
      !> How far the first orbit on its mesh was from satisfying the rates in the middle of the intervals, < 0: not
      !> known yet.
      real(wp), private :: first_defect = -1
   contains
      procedure :: linearize => linearize_orbit
      procedure, non_overridable :: linearize_orbit
      procedure :: move
      procedure :: predict => predict_orbit
      procedure, non_overridable :: predict_orbit
      procedure :: spectrum
      procedure :: kind => kind_of
      procedure :: get_place
      procedure :: go_to
      procedure :: fits
      procedure :: states
      procedure :: period
      procedure :: revolutions
      procedure :: residual
      procedure :: across_motion
   end type orbit_problem_type

   !> The difference of the parameter for a derivative over it, over its size. The rates are known to some 1e-10 of
   !> themselves at worst (films that are solved by iteration), so that the quotient is to 1e-5, as is its own error. It
   !> moves the solution by nothing, and delays Newton's method by as little.
   real(wp), parameter :: difference = 1e-5_wp
   !> A mesh is left for a new one where the defect has grown by this.
   real(wp), parameter :: largest_growth = 4
   !> Where in an interval the defect is looked at: far from its points.
   real(wp), parameter :: between(1) = 0.4_wp

   !> Ends that are closer than this part of the period are one.
   real(wp), parameter :: rounding = 1e-9_wp
   !> A passage is found to this part of the distance of two points; most evaluations for it.
   real(wp), parameter :: closeness = 1e-14_wp
   integer, parameter :: most_cuts = 50

   !> A mesh in the making: ends of intervals, s, and the switching points at them.
   type :: mesh_type
      real(wp), allocatable :: time(:)
      integer, allocatable :: switching_point(:)
      logical :: changed = .false.
   end type mesh_type

contains

   !> Makes model and period those of a value of the parameter; an error says why there can be none.
   subroutine set(self, parameter, error)
      class(parametric_ode_type), intent(inout) :: self
      real(wp), intent(in) :: parameter
      type(error_type), allocatable, intent(out) :: error
   end subroutine set

   !> A mesh for an orbit near this one, as parts of its period, 0 to 1; not allocated where there is no better one.
   subroutine new_mesh(self, orbit, mesh)
      class(parametric_ode_type), intent(inout) :: self
      type(orbit_type), intent(in) :: orbit
      real(wp), allocatable, intent(out) :: mesh(:)
   end subroutine new_mesh

   !> A problem that stands at an orbit over a number of periods of its forcing, of an ODE at a value of the parameter.
   subroutine begin_orbits(problem, ode, orbit, period_multiple, parameter, unit)
      class(orbit_problem_type), intent(out) :: problem
      class(parametric_ode_type), intent(inout), target :: ode
      type(orbit_type), intent(in) :: orbit
      integer, intent(in) :: period_multiple
      !> Its natural change. Both are left out where the parameter stays.
      real(wp), intent(in), optional :: parameter, unit
      integer, allocatable :: x(:), v(:)
      integer :: i
      problem%n = size(orbit%start)
      ! rates and what else a stiff motion has may leap where hardly anything moves
      allocate (problem%weight(problem%n), source=0.0_wp)
      call ode%model%pairs(x, v)
      if (size(x) == 0) x = [(i, i=1, problem%n)]
      problem%weight(x) = 1.0_wp/size(x)
      if (.not. allocated(ode%start)) allocate (ode%start(0))
      ode%found = ode%start
      problem%ode => ode
      problem%orbit = orbit
      problem%period_multiple = period_multiple
      if (present(parameter)) problem%parameter = parameter
      if (present(unit)) problem%unit = unit
   end subroutine begin_orbits

   !> Number of the states, which the unknowns begin with.
   pure integer function states(self)
      class(orbit_problem_type), intent(in) :: self
      states = size(self%orbit%start)
   end function states

   !> Periods of what drives the model in that of the orbit.
   pure real(wp) function revolutions(self)
      class(orbit_problem_type), intent(in) :: self
      revolutions = self%period_multiple
   end function revolutions

   !> Period of the orbit, s.
   pure real(wp) function period(self)
      class(orbit_problem_type), intent(in) :: self
      period = self%period_multiple*self%ode%period
   end function period

   !> The equations of the orbit; an extension may have more.
   subroutine linearize_orbit(self, matrix, b, error)
      class(orbit_problem_type), intent(inout) :: self
      real(wp), intent(out) :: matrix(:, :), b(:)
      type(error_type), allocatable, intent(out) :: error
      type(parameter_shift_type), allocatable :: shift
      matrix = 0
      b = 0
      call self%ode%set(self%parameter, error)
      self%refused = allocated(error)
      if (self%refused) return
      ! the same phases at another period
      associate (orbit => self%orbit, last => self%orbit%time(self%orbit%intervals()))
         if (abs(last - self%period()) > 0) orbit%time = orbit%time*(self%period()/last)
      end associate
      call follow_switching_points(self%ode%model, self%orbit)
      if (size(matrix, 2) > self%n) then
         allocate (shift)
         call set_shift(self, shift, error)
         self%refused = allocated(error)
         if (self%refused) return
      end if
      call condense(self%ode%model, self%orbit, self%equations, matrix, b, self%refused, error, &
         & self%n > self%states(), shift)
      self%tangents = self%tangents + points*self%orbit%intervals()
   end subroutine linearize_orbit

   !> The rates for another value of the parameter, at the same phases; the model is then as before.
   subroutine set_shift(self, shift, error)
      class(orbit_problem_type), intent(inout) :: self
      type(parameter_shift_type), intent(out) :: shift
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: stretch, t, before, change
      integer :: k, i
      logical :: ok
      change = difference*max(self%unit, abs(self%parameter))
      shift%amount = change/self%unit
      before = self%period()
      ! a value that is not allowed serves as well: what is wrong with it shows at the value itself
      call self%ode%set(self%parameter + change, error)
      if (allocated(error)) deallocate (error)
      stretch = self%period()/before
      allocate (shift%rates(self%states(), points, self%orbit%intervals()))
      associate (time => self%orbit%time)
         do k = 1, self%orbit%intervals()
            do i = 1, points
               t = stretch*(time(k - 1) + place(i)*(time(k) - time(k - 1)))
               call self%ode%model%rhs(t, collocated_state(self%orbit, k, i), shift%rates(:, i, k), ok)
               if (.not. ok) shift%rates(:, i, k) = 0
            end do
         end do
      end associate
      shift%rates = stretch*shift%rates
      self%evaluations = self%evaluations + size(shift%rates(1, :, :))
      call self%ode%set(self%parameter, error)
   end subroutine set_shift

   subroutine move(self, change, closes)
      class(orbit_problem_type), intent(inout) :: self
      real(wp), intent(in) :: change(:)
      logical, intent(in) :: closes
      call move_orbit(self%orbit, self%equations, change, closes, self%longest)
      self%correction = self%orbit%correction
      if (size(change) == self%n) return
      self%parameter = self%parameter + self%unit*change(self%n + 1)
      self%correction = max(self%correction, abs(change(self%n + 1)))
   end subroutine move

   !> The mesh goes along, and with it the switching points; where the orbit has changed so much that it fits its mesh
   !> less, from a new one.
   subroutine predict_orbit(self, change)
      class(orbit_problem_type), intent(inout) :: self
      real(wp), intent(in) :: change(:)
      real(wp), allocatable :: mesh(:), before(:)
      real(wp) :: now
      self%ode%start = self%ode%found
      now = defect(self, between)
      if (self%first_defect < 0) self%first_defect = now
      if (now > largest_growth*self%first_defect) then
         call self%ode%new_mesh(self%orbit, mesh)
         self%first_defect = -1
      end if
      before = [self%orbit%time]
      call self%move(change, .false.)
      if (allocated(mesh)) call self%orbit%change_mesh(moved(mesh*before(size(before)), before, [self%orbit%time]))
   end subroutine predict_orbit

   !> Times of a mesh, s, that goes along where the ends of another go.
   pure function moved(mesh, before, after)
      real(wp), intent(in) :: mesh(:), before(:), after(:)
      real(wp) :: moved(size(mesh))
      integer :: i, k
      k = 1
      do i = 1, size(mesh)
         do while (before(k + 1) < mesh(i) .and. k < size(before) - 1)
            k = k + 1
         end do
         moved(i) = after(k) + (mesh(i) - before(k))*(after(k + 1) - after(k))/(before(k + 1) - before(k))
      end do
   end function moved

   !> The part of a disturbance of the start that the start can take: all of it, as a forcing drives the motion.
   function across_motion(self, disturbance) result(part)
      class(orbit_problem_type), intent(inout) :: self
      real(wp), intent(in) :: disturbance(:)
      real(wp) :: part(size(disturbance))
      part = disturbance
   end function across_motion

   !> By how much the orbit is no solution, over the scales: the defect at the points, and the gap of the period.
   real(wp) function residual(self)
      class(orbit_problem_type), intent(inout) :: self
      residual = max(defect(self, place), maxval(abs(self%orbit%gap())))
   end function residual

   !> The largest defect of the rates at these places in an interval, 0 to 1, times its length, over the scales.
   real(wp) function defect(self, places)
      class(orbit_problem_type), intent(inout) :: self
      real(wp), intent(in) :: places(:)
      real(wp), dimension(self%states()) :: y, rates, slope
      real(wp) :: t
      integer :: k, i
      logical :: ok
      defect = 0
      associate (orbit => self%orbit)
         do k = 1, orbit%intervals()
            associate (h => orbit%time(k) - orbit%time(k - 1))
               do i = 1, size(places)
                  t = orbit%time(k - 1) + places(i)*h
                  call orbit%state_at(t, y, slope)
                  call self%ode%model%rhs(t, y, rates, ok)
                  if (ok) defect = max(defect, maxval(abs(h*(slope - rates)/orbit%scale)))
               end do
            end associate
         end do
         self%evaluations = self%evaluations + size(places)*orbit%intervals()
      end associate
   end function defect

   !> The multipliers, that of largest modulus first, and how far their moduli are beyond 1.
   subroutine spectrum(self, values, growth, ok)
      class(orbit_problem_type), intent(inout) :: self
      complex(wp), allocatable, intent(out) :: values(:)
      real(wp), allocatable, intent(out) :: growth(:)
      logical, intent(out) :: ok
      allocate (values(self%states()))
      call find_eigenvalues(self%orbit%monodromy, values, ok)
      if (.not. ok) return
      values = values(largest_first(abs(values)))
      growth = abs(values) - 1
   end subroutine spectrum

   pure function kind_of(self, value) result(kind)
      class(orbit_problem_type), intent(in) :: self
      complex(wp), intent(in) :: value
      character(len=:), allocatable :: kind
      if (abs(value%im) > 0) then
         kind = 'neimark_sacker'
      else if (value%re < 0) then
         kind = 'period_doubling'
      else
         kind = 'fold'
      end if
   end function kind_of

   pure subroutine get_place(self, place)
      class(orbit_problem_type), intent(in) :: self
      type(place_part_type), allocatable, intent(out) :: place(:)
      ! values in a constructor would never be freed (gfortran 12)
      place = [place_part_type('periods', '1', 'periods of the forcing in that of the orbit'), &
         & place_part_type('parameter', '', 'parameter where the equations were linearised'), &
         & place_part_type('first_defect', '1', 'defect of the first orbit on the mesh; below 0: not known yet'), &
         & place_part_type('interval_ends', 's', 'ends of the intervals'), &
         & place_part_type('switching_points', '1', 'switching point at each end; 0: none, -1: none any longer'), &
         & place_part_type('start', '1', 'state at the start of the period'), &
         & place_part_type('states', '1', 'states at the points of the intervals, one after the other'), &
         & place_part_type('equilibrium', '1', 'state and viscosities from which equilibria are sought')]
      place(1)%values = [real(self%period_multiple, wp)]
      place(2)%values = [self%parameter]
      place(3)%values = [self%first_defect]
      place(4)%values = [self%orbit%time]
      place(5)%values = [real(self%orbit%switching_point, wp)]
      place(6)%values = self%orbit%start
      place(7)%values = [self%orbit%at]
      place(8)%values = self%ode%start
   end subroutine get_place

   !> The mesh grows, every turn has an interval, and switching points are among those of the model.
   pure logical function fits(self, place)
      class(orbit_problem_type), intent(in) :: self
      type(place_part_type), intent(in) :: place(:)
      real(wp), allocatable :: value(:)
      integer, allocatable :: state(:)
      integer :: k
      associate (lengths => [(size(place(k)%values), k=1, size(place))], n => size(place(4)%values) - 1)
         fits = n > 0 .and. all(lengths == [1, 1, 1, n + 1, n + 1, self%states(), self%states()*points*n, &
            & size(self%ode%start)])
         if (.not. fits) return
         call self%ode%model%switching_points(state, value)
         associate (periods => place(1)%values(1), time => place(4)%values, switching_point => place(5)%values)
            fits = periods >= 1 .and. periods <= n .and. all(time(2:) > time(:n)) &
               & .and. all(switching_point >= -1 .and. switching_point <= size(state))
         end associate
      end associate
   end function fits

   subroutine go_to(self, place)
      class(orbit_problem_type), intent(inout) :: self
      type(place_part_type), intent(in) :: place(:)
      self%period_multiple = nint(place(1)%values(1))
      self%parameter = place(2)%values(1)
      self%first_defect = place(3)%values(1)
      self%orbit%start = place(6)%values
      associate (time => place(4)%values)
         call self%orbit%set_mesh(time, reshape(place(7)%values, [self%states(), points, size(time) - 1]), &
            & nint(place(5)%values))
      end associate
      self%ode%start = place(8)%values
      self%ode%found = self%ode%start
   end subroutine go_to

   !> Periods of what drives the model in that of the orbit at a point.
   pure integer function period_multiple_at(point)
      type(branch_point_type), intent(in) :: point
      period_multiple_at = nint(point%place(1)%values(1))
   end function period_multiple_at

   ! The switching points that an orbit passes: intervals of its collocation end there, or the polynomials would lose
   ! their order. Such an end goes with the orbit as Newton's method corrects it; here it is found that there is, or is
   ! no longer, one.

   !> Puts an end of an interval wherever an orbit passes a switching point of its model, and drops those where it no
   !> longer does.
   subroutine follow_switching_points(model, orbit)
      class(ode_model_type), intent(in) :: model
      type(orbit_type), intent(inout) :: orbit
      type(mesh_type) :: mesh
      integer, allocatable :: state(:)
      real(wp), allocatable :: value(:)
      integer :: switching_point, k
      call model%switching_points(state, value)
      mesh%time = [orbit%time]
      mesh%switching_point = [orbit%switching_point]
      do k = 1, orbit%intervals()
         if (orbit%switching_point(k) < 0) call drop_end(mesh, orbit%time(k))
      end do
      do switching_point = 1, size(state)
         call follow_switching_point(orbit, switching_point, state(switching_point), value(switching_point), mesh)
      end do
      if (mesh%changed) call orbit%change_mesh(mesh%time, mesh%switching_point)
   end subroutine follow_switching_points

   !> Does so for one switching point. The state is on different sides before and after an end that lies there, and
   !> elsewhere on one side from point to point.
   subroutine follow_switching_point(orbit, switching_point, state, value, mesh)
      type(orbit_type), intent(in) :: orbit
      integer, intent(in) :: switching_point, state
      real(wp), intent(in) :: value
      type(mesh_type), intent(inout) :: mesh
      logical :: at_end
      real(wp) :: before, now, last, above
      integer :: k, i
      last = orbit%start(state) - value
      at_end = .false.
      before = 0
      do k = 1, orbit%intervals()
         do i = 1, points
            now = orbit%time(k - 1) + place(i)*(orbit%time(k) - orbit%time(k - 1))
            if (i == points .and. orbit%switching_point(k) == switching_point) then
               at_end = .true.
            else
               above = orbit%at(state, i, k) - value
               if (at_end) then
                  if (above < 0 .eqv. last < 0) call drop_end(mesh, orbit%time(k - 1))
               else if (above < 0 .neqv. last < 0) then
                  call put_end(mesh, passage(orbit, state, value, root_bracket([before, now], [last, above])), &
                     & switching_point)
               end if
               at_end = .false.
               last = above
            end if
            before = now
         end do
      end do
   end subroutine follow_switching_point

   !> An end at a switching point at time t, s: a new one, or the one that is there, if it lies at no other switching
   !> point.
   pure subroutine put_end(self, t, switching_point)
      class(mesh_type), intent(inout) :: self
      real(wp), intent(in) :: t
      integer, intent(in) :: switching_point
      integer :: closest, before
      closest = minloc(abs(self%time - t), dim=1)
      if (abs(self%time(closest) - t) <= rounding*self%time(size(self%time))) then
         if (self%switching_point(closest) /= 0 .or. closest == 1 .or. closest == size(self%time)) return
         self%switching_point(closest) = switching_point
      else
         before = count(self%time < t)
         self%time = [self%time(:before), t, self%time(before + 1:)]
         self%switching_point = [self%switching_point(:before), switching_point, self%switching_point(before + 1:)]
      end if
      self%changed = .true.
   end subroutine put_end

   !> Without the end at time t, s.
   pure subroutine drop_end(self, t)
      class(mesh_type), intent(inout) :: self
      real(wp), intent(in) :: t
      self%switching_point = pack(self%switching_point, abs(self%time - t) > 0)
      self%time = pack(self%time, abs(self%time - t) > 0)
      self%changed = .true.
   end subroutine drop_end

   !> When a state passes a value, s, between the two times of a bracket.
   pure real(wp) function passage(orbit, state, value, between)
      type(orbit_type), intent(in) :: orbit
      integer, intent(in) :: state
      real(wp), intent(in) :: value
      type(root_bracket), intent(in) :: between
      type(root_bracket) :: bracket
      real(wp) :: y(size(orbit%start))
      integer :: i
      bracket = between
      do i = 1, most_cuts
         passage = bracket%estimate()
         if (abs(passage - bracket%place(2)) <= closeness*between%width()) return
         call orbit%state_at(passage, y)
         call bracket%narrow(passage, y(state) - value)
      end do
   end function passage
end module orbit_problem
