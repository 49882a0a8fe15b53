!> Equilibria as a problem of continuation: the unknowns are the positions of journal and pads, the equations the
!> balance of forces, and the eigenvalues of the motion linearised there tell stability. Without friction and unbalance.
!> With warm oil the logarithms of the viscosities are unknowns, too, and the heat balance has an equation for each. The
!> motion keeps these viscosities.
!>
!> Temperatures along and across films are a coupled field instead: with those of a point the equations are those of
!> cold oil, and rounds of a fixed point lead to others, until they agree in a plane across the branch.
module equilibrium_branch
   use kinds, only: wp
   use errors, only: error_type, raise, numerics_error
   use linear_algebra, only: largest_first
   use equations_of_motion, only: machine_model
   use newton_method, only: branch_problem_type, place_part_type, branch_point_type, newton_options, return_to, &
      & newton_iterations
   use force_balance, only: forces, force_derivatives
   use static_model, only: clearances, reference_force
   use linear_bearing, only: linear_bearing_of, pivot_name, rotor_eigenvalues
   use film_network, only: warm_films_type, new_warm_films, film_field_type
   use fixed_point, only: field_reference, balance_type, solve_fields
   use heat_balance, only: oil_temperatures_type
   use heat_balance_equations, only: state_balance_type, has_warm_oil, find_residual, find_residual_slopes, &
      & find_force_slopes, find_temperatures, check_heat
   use varied_bearing, only: varied_bearing_type
   use first_lyapunov, only: first_lyapunov_coefficient
   implicit none (type, external)
   private
   public :: equilibrium_problem_type, begin_equilibria

   !> Longest way to a point that tells a tangent, and its part of a step: where steps are short the branch may turn.
   real(wp), parameter :: longest_beside = 1e-3_wp, part = 0.1_wp
   !> Growth per radian of the shaft that counts as this decay: what neither film nor damper holds, as a pad without
   !> load on a flexure pivot, has growths of rounding of either sign.
   real(wp), parameter :: rounding = 1e-9_wp

   type, extends(branch_problem_type) :: equilibrium_problem_type
      !> Present positions, in the order of layout%positions().
      real(wp), allocatable :: positions(:)
      !> Of warm oil on every pad, Pa s; else there are none.
      real(wp), allocatable :: viscosity(:)
      !> How the pivots behave in the vibrations that tell stability, and the cross-coupled stiffness of the rotor, N/m.
      character(len=pivot_name) :: pivot = 'free'
      real(wp) :: cross_stiffness = 0
      type(varied_bearing_type), private :: bearing
      !> Whether films start anew where the equations are linearised next: once for each point, so that it does not
      !> depend on the way to it.
      logical, private :: anew = .true.
      !> Characteristic scales of unknowns, and of what is out of balance.
      real(wp), allocatable, private :: scale(:), force(:)
      !> Derivatives of the forces where they were taken last.
      real(wp), allocatable, private :: stiffness(:, :), damping(:, :)
      !> The heat balance that was found last.
      type(state_balance_type), private :: balance
      !> Temperatures along and across films, where the case has them; the way to a point that tells a tangent then.
      logical, private :: has_fields = .false.
      type(film_field_type), private :: films
      real(wp), private :: beside = longest_beside
   contains
      procedure :: linearize
      procedure :: move
      procedure :: predict
      procedure :: solve
      procedure :: spectrum
      procedure :: kind => kind_of
      procedure :: birth
      procedure :: get_place
      procedure :: go_to
      procedure :: state
      procedure :: temperatures
      procedure, private :: find_imbalance
   end type equilibrium_problem_type

   !> A point of a branch: forces in equilibrium at the value of the parameter, or in a plane through where the problem
   !> stands across `normal`.
   type, extends(balance_type) :: point_balance
      class(equilibrium_problem_type), pointer :: problem => null()
      type(newton_options) :: options
      real(wp), allocatable :: normal(:)
      type(branch_point_type) :: point
      !> Value of the parameter at the last equilibrium; most iterations that one took.
      real(wp) :: parameter = 0
      integer :: most = 0
   contains
      procedure :: settle
   end type point_balance

   !> The difference of the parameter for a derivative over it, over its size; as good as that of orbits.
   real(wp), parameter :: difference = 1e-5_wp

contains

   !> A problem that stands at the equilibrium y of a bearing with a static model, at a value of its parameter.
   subroutine begin_equilibria(problem, bearing, y, parameter, unit, films)
      type(equilibrium_problem_type), intent(out) :: problem
      type(varied_bearing_type), intent(in) :: bearing
      real(wp), intent(in) :: y(:)
      !> Its natural change.
      real(wp), intent(in) :: parameter, unit
      !> Its temperatures along and across films, where the case wants them; without these `go_to` leads to some.
      type(warm_films_type), intent(in), optional :: films(:)
      problem%bearing = bearing
      associate (model => bearing%model)
         problem%positions = y(model%layout%positions())
         problem%viscosity = [real(wp) ::]
         problem%has_fields = model%inputs%thermal%model == 'film'
         if (problem%has_fields) then
            call begin_films(problem, model, films)
         else if (has_warm_oil(model)) then
            problem%viscosity = model%oil%viscosity
         end if
         problem%n = size(problem%positions) + size(problem%viscosity)
         problem%scale = clearances(model)
         allocate (problem%force(size(problem%positions)), source=reference_force(model))
         associate (own => problem%force(model%rotor%positions + 1:))
            own = own*model%own_lengths()
         end associate
      end associate
      associate (n => size(problem%positions), one => spread(1.0_wp, 1, size(problem%viscosity)))
         ! viscosities count, too: where films are thin they run away while the positions hardly move
         problem%weight = [spread(1.0_wp/n, 1, n), one/max(1, size(one))]
         allocate (problem%stiffness(n, n), problem%damping(n, n), source=0.0_wp)
         problem%scale = [problem%scale, one]
         problem%force = [problem%force, one]
      end associate
      problem%parameter = parameter
      problem%unit = unit
   end subroutine begin_equilibria

   !> Readies the temperatures of films, with these or any.
   subroutine begin_films(problem, model, films)
      type(equilibrium_problem_type), intent(inout) :: problem
      type(machine_model), intent(in) :: model
      type(warm_films_type), intent(in), optional :: films(:)
      type(warm_films_type) :: cold(size(model%bearings))
      integer :: b
      if (present(films)) then
         call problem%films%begin(model, films, gaps_change=.true.)
      else
         do b = 1, size(cold)
            associate (own => model%inputs%bearings(b))
               cold(b) = new_warm_films(own, model%inputs%thermal, spread(own%oil%supply_temperature, 1, &
                  & own%pad_count()))
            end associate
         end do
         call problem%films%begin(model, cold, gaps_change=.true.)
      end if
   end subroutine begin_films

   !> The state in equilibrium at the present positions.
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
      type(error_type), allocatable :: ignored, unbalanced
      real(wp), dimension(self%n) :: now, later
      real(wp) :: change
      integer :: k, n
      matrix = 0
      b = 0
      n = size(self%positions)
      change = difference*max(self%unit, abs(self%parameter))
      ! a value that is not allowed serves as well: what is wrong with it shows at the value itself
      call self%bearing%set_value(self%parameter + change, self%anew, ignored)
      call self%find_imbalance(.false., later, unbalanced)
      call self%bearing%set_value(self%parameter, .false., error)
      self%anew = .false.
      if (.not. allocated(error)) call self%find_imbalance(.true., now, error)
      self%refused = allocated(error)
      if (self%refused) return
      if (allocated(unbalanced)) later(n + 1:) = now(n + 1:)
      call force_derivatives(self%bearing%model, self%stiffness, self%damping, at_rest=.true.)
      do k = 1, n
         matrix(:n, k) = self%stiffness(:, k)*self%scale(k)
      end do
      ! elements of the shaft may act in motion alone
      if (self%bearing%model%rotor%elements > 0) call force_derivatives(self%bearing%model, self%stiffness, &
         & self%damping)
      if (size(self%viscosity) > 0) then
         associate (model => self%bearing%model, y => self%state())
            call find_residual_slopes(model, y, self%balance, self%scale(:n), matrix(n + 1:, :self%n))
            call find_force_slopes(model, y, matrix(:n, n + 1:self%n))
         end associate
      end if
      matrix(:n, :self%n) = matrix(:n, :self%n)/spread(self%force(:n), 2, self%n)
      matrix(:, self%n + 1) = (later - now)/self%force*(self%unit/change)
      b = -now/self%force
   end subroutine linearize

   !> What is out of balance at the present unknowns: the forces, and the residual of viscosities. An error where the
   !> model admits no such state.
   subroutine find_imbalance(self, want_derivatives, imbalance, error)
      class(equilibrium_problem_type), intent(inout) :: self
      logical, intent(in) :: want_derivatives
      real(wp), intent(out) :: imbalance(:)
      type(error_type), allocatable, intent(out) :: error
      logical :: ok
      associate (model => self%bearing%model, n => size(self%positions))
         if (size(self%viscosity) > 0) model%oil%viscosity = self%viscosity
         if (self%has_fields) call self%films%apply(model)
         call model%evaluate(0.0_wp, self%state(), want_derivatives, ok)
         imbalance(:n) = forces(model, 0.0_wp, self%state())
         imbalance(n + 1:) = 0
         if (.not. ok) then
            call raise(error, numerics_error, model%refusal)
         else if (size(self%viscosity) > 0) then
            call find_residual(model, self%state(), self%balance)
            call check_heat(model, self%balance, error)
            imbalance(n + 1:) = self%balance%residual
         end if
      end associate
   end subroutine find_imbalance

   subroutine move(self, change, closes)
      class(equilibrium_problem_type), intent(inout) :: self
      real(wp), intent(in) :: change(:)
      logical, intent(in) :: closes
      associate (n => size(self%positions))
         self%positions = self%positions + self%scale(:n)*change(:n)
         self%viscosity = self%viscosity*exp(change(n + 1:self%n))
      end associate
      self%parameter = self%parameter + self%unit*change(self%n + 1)
      self%correction = maxval(abs(change))
   end subroutine move

   subroutine predict(self, change)
      class(equilibrium_problem_type), intent(inout) :: self
      real(wp), intent(in) :: change(:)
      self%anew = .true.
      associate (way => sqrt(self%dot(change, change)))
         self%beside = longest_beside
         if (way > 0) self%beside = min(longest_beside, part*way)
      end associate
      call self%move(change, .false.)
   end subroutine predict

   !> Newton's method, or, where films have temperatures, the fixed point of these around it. The equations freeze them:
   !> the point in a plane beside this one tells the tangent.
   subroutine solve(problem, options, point, way, error, normal)
      class(equilibrium_problem_type), intent(inout), target :: problem
      class(newton_options), intent(in) :: options
      type(branch_point_type), intent(out) :: point
      real(wp), intent(inout) :: way(:)
      type(error_type), allocatable, intent(out) :: error
      real(wp), intent(in), optional :: normal(:)
      type(branch_point_type) :: next
      real(wp) :: there(size(way))
      if (.not. problem%has_fields) then
         call newton_iterations(problem, options, point, way, error, normal)
         return
      end if
      call solve_with_films(problem, options, point, way, error, normal)
      if (allocated(error) .or. .not. present(normal)) return
      point%parameter = problem%parameter
      there = problem%beside*point%tangent
      call problem%move(there, .false.)
      call solve_with_films(problem, options, next, there, error, normal)
      if (allocated(error)) return
      point%tangent = there/sqrt(problem%dot(there, there))
      call return_to(problem, point)
   end subroutine solve

   !> A point at which the temperatures of films agree with those that it leads to; oil that boils ends the branch.
   subroutine solve_with_films(problem, options, point, way, error, normal)
      class(equilibrium_problem_type), intent(inout), target :: problem
      class(newton_options), intent(in) :: options
      type(branch_point_type), intent(out) :: point
      real(wp), intent(inout) :: way(:)
      type(error_type), allocatable, intent(out) :: error
      real(wp), intent(in), optional :: normal(:)
      type(point_balance) :: balance
      type(field_reference) :: fields(1)
      real(wp) :: y(problem%bearing%model%n), from(size(way))
      from = [problem%positions, problem%parameter]
      balance%model => problem%bearing%model
      balance%problem => problem
      balance%options = options
      if (present(normal)) balance%normal = normal
      balance%any_balance = present(normal)
      y = problem%state()
      fields(1)%field => problem%films
      call solve_fields(balance, y, fields, error)
      problem%refused = balance%refused
      point = balance%point
      point%iterations = balance%most
      way = way + ([problem%positions, problem%parameter] - from)/[problem%scale, problem%unit]
   end subroutine solve_with_films

   !> By Newton's method from the last equilibrium.
   subroutine settle(self, last, y, first, final, error)
      class(point_balance), intent(inout) :: self
      real(wp), intent(in) :: last(:)
      real(wp), intent(inout) :: y(:)
      logical, intent(in) :: first, final
      type(error_type), allocatable, intent(out) :: error
      real(wp) :: way(self%problem%n + 1)
      if (first) self%parameter = self%problem%parameter
      self%problem%positions = last(self%model%layout%positions())
      self%problem%parameter = self%parameter
      way = 0
      call newton_iterations(self%problem, self%options, self%point, way, error, self%normal)
      ! a film that closes in a later iteration closes on a way that was too long, and a shorter one may lead on
      self%refused = self%problem%refused .and. self%point%iterations == 1
      self%most = max(self%most, self%point%iterations)
      if (.not. allocated(error)) call self%problem%bearing%set_value(self%problem%parameter, .false., error)
      if (allocated(error)) return
      self%parameter = self%problem%parameter
      call self%problem%films%apply(self%model)
      y = self%problem%state()
   end subroutine settle

   !> The eigenvalues, 1/s, that of largest real part first; growths are per radian of the shaft.
   subroutine spectrum(self, values, growth, ok)
      class(equilibrium_problem_type), intent(inout) :: self
      complex(wp), allocatable, intent(out) :: values(:)
      real(wp), allocatable, intent(out) :: growth(:)
      logical, intent(out) :: ok
      associate (model => self%bearing%model)
         call rotor_eigenvalues(linear_bearing_of(model, self%pivot, self%stiffness, self%damping), &
            & self%cross_stiffness, values, ok)
         values = values(largest_first(values%re))
         growth = values%re/model%point%speed(0.0_wp)
         where (abs(growth) <= rounding) growth = -rounding
      end associate
   end subroutine spectrum

   !> Where the oil keeps its viscosities in a motion, one without frequency may grow where no branch turns.
   pure function kind_of(self, value) result(kind)
      class(equilibrium_problem_type), intent(in) :: self
      complex(wp), intent(in) :: value
      character(len=:), allocatable :: kind
      if (abs(value%im) > 0) then
         kind = 'hopf'
      else
         kind = trim(merge('divergence', 'fold      ', size(self%viscosity) > 0 .or. self%has_fields))
      end if
   end function kind_of

   !> Pivots that stick slide in a vibration of any size, of which no derivative tells.
   real(wp) function birth(self, value)
      class(equilibrium_problem_type), intent(inout) :: self
      complex(wp), intent(in) :: value
      type(error_type), allocatable :: refusal
      real(wp) :: imbalance(self%n)
      birth = 0
      if (self%pivot /= 'free') return
      call self%bearing%set_value(self%parameter, .false., refusal)
      if (.not. allocated(refusal)) call self%find_imbalance(.false., imbalance, refusal)
      if (allocated(refusal)) return
      associate (model => self%bearing%model)
         birth = first_lyapunov_coefficient(model, self%state(), model%scale, value)
      end associate
      ! the model is asked for what it knows of the state
      call self%find_imbalance(.false., imbalance, refusal)
   end function birth

   pure subroutine get_place(self, place)
      class(equilibrium_problem_type), intent(in) :: self
      type(place_part_type), allocatable, intent(out) :: place(:)
      place = [place_part_type('parameter', '', 'parameter where the equations were linearised'), &
         & place_part_type('positions', '1', 'displacements of journal and pads, m, and tilts, rad'), &
         & place_part_type('viscosity', 'Pa s', 'viscosity of the film')]
      place(1)%values = [self%parameter]
      place(2)%values = self%positions
      place(3)%values = self%viscosity
      if (.not. self%has_fields) return
      place(3) = place_part_type('warming', 'K', 'temperatures of films and pads above that of the supply')
      place(3)%values = self%films%values
   end subroutine get_place

   subroutine go_to(self, place)
      class(equilibrium_problem_type), intent(inout) :: self
      type(place_part_type), intent(in) :: place(:)
      self%parameter = place(1)%values(1)
      self%positions = place(2)%values
      if (self%has_fields) then
         self%films%values = place(3)%values
      else
         self%viscosity = place(3)%values
      end if
      self%anew = .true.
   end subroutine go_to

   !> Of warm oil, in each bearing, and its viscosity on every pad, Pa s.
   subroutine temperatures(self, oil, viscosity)
      class(equilibrium_problem_type), intent(inout) :: self
      type(oil_temperatures_type), intent(out) :: oil(:)
      real(wp), allocatable, intent(out) :: viscosity(:)
      type(error_type), allocatable :: ignored
      real(wp), allocatable :: wanted(:)
      associate (model => self%bearing%model)
         if (self%has_fields) then
            call self%films%apply(model)
            wanted = self%films%values
            call self%films%find_wanted(model, self%state(), wanted, ignored)
            oil = self%films%films%oil
         else
            model%oil%viscosity = self%viscosity
            call find_temperatures(model, self%state(), self%balance, oil)
         end if
         viscosity = model%oil%viscosity
      end associate
   end subroutine temperatures
end module equilibrium_branch
