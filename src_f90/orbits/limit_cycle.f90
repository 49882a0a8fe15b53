!> Limit cycles as orbits whose period is unknown: of a motion that nothing drives. The unknowns are the state at the
!> start, the logarithm of the period, and, on a branch, the parameter. A cycle may begin anywhere on itself: its start
!> moves across the motion at the place where it was sought (the phase condition; Kuznetsov, Elements of Applied
!> Bifurcation Theory, 10.2).
module limit_cycle
   use kinds, only: wp
   use errors, only: error_type
   use linear_algebra, only: find_eigenvalues, largest_first
   use newton_method, only: place_part_type
   use orbit_polynomials, only: orbit_type
   use orbit_problem, only: orbit_problem_type, parametric_ode_type, begin_orbits
   implicit none (type, external)
   private
   public :: limit_cycle_type, begin_cycles

   type, extends(orbit_problem_type) :: limit_cycle_type
      !> Row of the phase condition, over the states; its length is 1, or 0 where the cycle stands at a place of rest.
      real(wp), allocatable, private :: phase(:)
   contains
      procedure :: linearize
      procedure :: move
      procedure :: predict
      procedure :: spectrum
      procedure :: go_to
      procedure :: period
      procedure :: revolutions
      procedure :: trivial_error
      procedure :: across_motion
      procedure, private :: set_phase
      procedure, private :: direction
   end type limit_cycle_type

contains

   !> A problem that stands at a cycle of an ODE at a value of the parameter, whose natural change is given.
   subroutine begin_cycles(problem, ode, orbit, parameter, unit)
      type(limit_cycle_type), intent(inout) :: problem
      class(parametric_ode_type), intent(inout), target :: ode
      type(orbit_type), intent(in) :: orbit
      real(wp), intent(in) :: parameter, unit
      call begin_orbits(problem, ode, orbit, 1, parameter, unit)
      problem%n = problem%states() + 1
      ! the period is no length of a branch
      problem%weight = [problem%weight, 0.0_wp]
      call problem%set_phase()
   end subroutine begin_cycles

   pure real(wp) function period(self)
      class(limit_cycle_type), intent(in) :: self
      period = self%orbit%time(self%orbit%intervals())
   end function period

   !> Revolutions of the shaft.
   pure real(wp) function revolutions(self)
      class(limit_cycle_type), intent(in) :: self
      revolutions = self%period()/self%ode%period
   end function revolutions

   subroutine linearize(self, matrix, b, error)
      class(limit_cycle_type), intent(inout) :: self
      real(wp), intent(out) :: matrix(:, :), b(:)
      type(error_type), allocatable, intent(out) :: error
      matrix = 0
      b = 0
      associate (n => self%states())
         call self%linearize_orbit(matrix(:n, :), b(:n), error)
         matrix(n + 1, :n) = self%phase
      end associate
   end subroutine linearize

   subroutine move(self, change, closes)
      class(limit_cycle_type), intent(inout) :: self
      real(wp), intent(in) :: change(:)
      logical, intent(in) :: closes
      call self%orbit_problem_type%move(change, closes)
      associate (of_period => change(self%states() + 1))
         self%orbit%time = self%orbit%time*exp(of_period)
         self%correction = max(self%correction, abs(of_period))
      end associate
   end subroutine move

   subroutine predict(self, change)
      class(limit_cycle_type), intent(inout) :: self
      real(wp), intent(in) :: change(:)
      call self%predict_orbit(change)
      call self%set_phase()
   end subroutine predict

   subroutine go_to(self, place)
      class(limit_cycle_type), intent(inout) :: self
      type(place_part_type), intent(in) :: place(:)
      call self%orbit_problem_type%go_to(place)
      call self%set_phase()
   end subroutine go_to

   !> Takes the phase condition of the present start.
   subroutine set_phase(self)
      class(limit_cycle_type), intent(inout) :: self
      self%phase = self%weight(:self%states())*self%direction()
      self%phase = self%phase/max(norm2(self%phase), tiny(1.0_wp))
   end subroutine set_phase

   !> Where the motion goes at the start, over the scales; 0 where the model refuses the state.
   function direction(self)
      class(limit_cycle_type), intent(inout) :: self
      real(wp) :: direction(self%states())
      logical :: ok
      call self%ode%model%rhs(0.0_wp, self%orbit%start, direction, ok)
      direction = direction/self%orbit%scale
      if (.not. ok) direction = 0
      self%evaluations = self%evaluations + 1
   end function direction

   !> The part of a disturbance of the start, over the scales, that the phase condition lets be.
   function across_motion(self, disturbance) result(part)
      class(limit_cycle_type), intent(inout) :: self
      real(wp), intent(in) :: disturbance(:)
      real(wp) :: part(size(disturbance))
      part = self%direction()
      part = disturbance - dot_product(self%phase, disturbance)/dot_product(self%phase, part)*part
   end function across_motion

   !> By how much the monodromy matrix misses that it leaves the direction of the motion as it is, over its length: the
   !> error of the multiplier that is 1. None at a place of rest.
   real(wp) function trivial_error(self)
      class(limit_cycle_type), intent(inout) :: self
      real(wp) :: along(self%states())
      trivial_error = 0
      if (.not. norm2(self%phase) > 0) return
      along = self%direction()
      trivial_error = norm2(matmul(self%orbit%monodromy, along) - along)/max(norm2(along), tiny(1.0_wp))
   end function trivial_error

   !> Without the multiplier of a disturbance along the motion, which is 1: those of the monodromy matrix across it. At
   !> a fold another is 1. A place of rest, whose vibration has two, loses one of them.
   subroutine spectrum(self, values, growth, ok)
      class(limit_cycle_type), intent(inout) :: self
      complex(wp), allocatable, intent(out) :: values(:)
      real(wp), allocatable, intent(out) :: growth(:)
      logical, intent(out) :: ok
      real(wp) :: along(self%states())
      if (norm2(self%phase) > 0) then
         along = self%direction()
         along = along/norm2(along)
         allocate (values(size(along) - 1))
         call find_eigenvalues(across(self%orbit%monodromy, along), values, ok)
      else
         allocate (values(size(along)))
         call find_eigenvalues(self%orbit%monodromy, values, ok)
         associate (trivial => minloc(abs(values - 1), dim=1))
            values = [values(:trivial - 1), values(trivial + 1:)]
         end associate
      end if
      if (.not. ok) return
      values = values(largest_first(abs(values)))
      growth = abs(values) - 1
   end subroutine spectrum

   !> A matrix on the directions across one, of length 1, that it leaves as it is, by Householder's mirror that turns
   !> this one into an axis.
   pure function across(matrix, along) result(part)
      real(wp), intent(in) :: matrix(:, :), along(:)
      real(wp) :: part(size(along) - 1, size(along) - 1), mirrored(size(along), size(along)), normal(size(along))
      normal = along
      normal(1) = normal(1) + sign(1.0_wp, along(1))
      normal = normal/norm2(normal)
      mirrored = matrix - 2*dyad(normal, matmul(normal, matrix))
      mirrored = mirrored - 2*dyad(matmul(mirrored, normal), normal)
      part = mirrored(2:, 2:)
   end function across

   pure function dyad(a, b)
      real(wp), intent(in) :: a(:), b(:)
      real(wp) :: dyad(size(a), size(b))
      dyad = spread(a, 2, size(b))*spread(b, 1, size(a))
   end function dyad
end module limit_cycle
