!> Equilibria as a problem of continuation: the unknowns are the positions of journal and pads, the equations the
!> balance of forces, and the eigenvalues of the motion linearised there tell stability. Without friction and unbalance.
module equilibrium_branch
   use kinds, only: wp
   use errors, only: error_type, raise, numerics_error
   use continuation, only: branch_problem_type
   use equations_of_motion, only: bearing_model
   use force_balance, only: forces, force_derivatives, masses
   use damped_newton, only: clearances, reference_force
   use small_vibrations, only: eigenvalues
   use varied_bearing, only: varied_bearing_type
   implicit none (type, external)
   private
   public :: equilibrium_problem_type, begin_equilibria

   type, extends(branch_problem_type) :: equilibrium_problem_type
      !> Present positions, in the order of layout%positions().
      real(wp), allocatable :: positions(:)
      type(varied_bearing_type), private :: bearing
      !> Natural sizes of positions and forces.
      real(wp), allocatable, private :: scale(:), force(:)
      !> Derivatives of the forces where they were taken last.
      real(wp), allocatable, private :: stiffness(:, :), damping(:, :)
   contains
      procedure :: linearize
      procedure :: move
      procedure :: spectrum
      procedure :: kind => kind_of
      procedure :: get_place
      procedure :: go_to
      procedure :: state
   end type equilibrium_problem_type

   !> The difference of the parameter for a derivative over it, over its size; as good as that of orbits.
   real(wp), parameter :: difference = 1e-5_wp

contains

   !> A problem that stands at the equilibrium y of a bearing with a static model, at a value of its parameter.
   subroutine begin_equilibria(problem, bearing, y, parameter, unit)
      type(equilibrium_problem_type), intent(out) :: problem
      type(varied_bearing_type), intent(in) :: bearing
      real(wp), intent(in) :: y(:)
      !> Its natural change.
      real(wp), intent(in) :: parameter, unit
      integer :: i
      problem%bearing = bearing
      associate (model => bearing%model)
         problem%n = model%layout%n_positions()
         allocate (problem%weight(problem%n), source=1.0_wp/problem%n)
         problem%positions = y(model%layout%positions())
         problem%scale = clearances(model)
         allocate (problem%force(problem%n), source=reference_force(model))
         if (model%layout%tilting) then
            associate (own => [(model%layout%first_position(i), i=1, model%layout%pads)])
               problem%force(own) = problem%force(own)*model%bearing%pads%position%centre_distance
            end associate
         end if
      end associate
      allocate (problem%stiffness(problem%n, problem%n), problem%damping(problem%n, problem%n), source=0.0_wp)
      problem%parameter = parameter
      problem%unit = unit
   end subroutine begin_equilibria

   !> The state at rest at the present positions.
   pure function state(self) result(y)
      class(equilibrium_problem_type), intent(in) :: self
      real(wp) :: y(self%bearing%model%n)
      y = 0
      y(self%bearing%model%layout%positions()) = self%positions
   end function state

   subroutine linearize(self, matrix, b, error)
      class(equilibrium_problem_type), intent(inout) :: self
      real(wp), intent(out) :: matrix(:, :), b(:)
      type(error_type), allocatable, intent(out) :: error
      type(error_type), allocatable :: ignored
      real(wp), dimension(self%n) :: now, then
      real(wp) :: change
      integer :: k
      logical :: ok
      matrix = 0
      b = 0
      change = difference*max(self%unit, abs(self%parameter))
      associate (model => self%bearing%model)
         ! a value that is not allowed serves as well: what is wrong with it shows at the value itself
         call self%bearing%set_value(self%parameter + change, ignored)
         call model%evaluate(0.0_wp, self%state(), .false., ok)
         then = forces(model, 0.0_wp)
         call self%bearing%set_value(self%parameter, error)
         self%refused = allocated(error)
         if (self%refused) return
         call model%evaluate(0.0_wp, self%state(), .true., ok)
         self%refused = .not. ok
         if (.not. ok) then
            call raise(error, numerics_error, model%refusal)
            return
         end if
         now = forces(model, 0.0_wp)
         call force_derivatives(model, self%stiffness, self%damping)
      end associate
      do k = 1, self%n
         matrix(:, k) = self%stiffness(:, k)*self%scale(k)/self%force
      end do
      matrix(:, self%n + 1) = (then - now)/self%force*(self%unit/change)
      b = -now/self%force
   end subroutine linearize

   subroutine move(self, change, closes, correction)
      class(equilibrium_problem_type), intent(inout) :: self
      real(wp), intent(in) :: change(:)
      logical, intent(in) :: closes
      real(wp), intent(out) :: correction
      self%positions = self%positions + self%scale*change(:self%n)
      self%parameter = self%parameter + self%unit*change(self%n + 1)
      correction = maxval(abs(change))
   end subroutine move

   !> The eigenvalues, 1/s, that of largest real part first; growths are per radian of the shaft.
   subroutine spectrum(self, values, growth, ok)
      class(equilibrium_problem_type), intent(inout) :: self
      complex(wp), allocatable, intent(out) :: values(:)
      real(wp), allocatable, intent(out) :: growth(:)
      logical, intent(out) :: ok
      integer :: k, largest
      allocate (values(2*self%n))
      call eigenvalues(masses(self%bearing%model), self%stiffness, self%damping, values, ok)
      do k = 1, size(values) - 1
         largest = k - 1 + maxloc(values(k:)%re, dim=1)
         values([k, largest]) = values([largest, k])
      end do
      growth = values%re/self%bearing%model%point%speed(0.0_wp)
   end subroutine spectrum

   pure function kind_of(self, value) result(kind)
      class(equilibrium_problem_type), intent(in) :: self
      complex(wp), intent(in) :: value
      character(len=:), allocatable :: kind
      kind = trim(merge('hopf', 'fold', abs(value%im) > 0))
   end function kind_of

   pure subroutine get_place(self, place)
      class(equilibrium_problem_type), intent(in) :: self
      real(wp), allocatable, intent(out) :: place(:)
      place = [self%parameter, self%positions]
   end subroutine get_place

   subroutine go_to(self, place)
      class(equilibrium_problem_type), intent(inout) :: self
      real(wp), intent(in) :: place(:)
      self%parameter = place(1)
      self%positions = place(2:)
   end subroutine go_to
end module equilibrium_branch
