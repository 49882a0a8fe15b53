!> Thermal equilibrium: forces, heat and, where pads bend or parts expand, the shape of the bearing are in balance
!> together. The bearing comes to equilibrium with the oil and in the shape that fields have, which says what they are
!> to be, until they agree (fixed_point). And the oil of a run-up, which follows from such equilibria.
module thermal_equilibrium
   use kinds, only: wp, rpm
   use errors, only: error_type, stopped, raise, numerics_error, add_context
   use text, only: to_text
   use film_oils, only: even_oil
   use heat_balance, only: oil_temperatures_type
   use oil_properties, only: viscosity
   use equations_of_motion, only: machine_model
   use heat_balance_equations, only: state_balance_type, has_warm_oil, find_losses, find_temperatures, find_residual, &
      & check_heat
   use static_model, only: solve_equilibrium, start, follow_motion, make_static
   use film_network, only: warm_films_type, new_warm_films, film_field_type
   use bearing_shape, only: bearing_shape_type, shape_field_type
   use fixed_point, only: field_reference, balance_type, solve_fields, coupled_field, most_rounds
   use viscosity_history, only: viscosity_history_type, new_viscosity_history
   implicit none (type, external)
   private
   public :: guess_oil, guesses, solve_thermal_equilibrium, solve_warm_films, solve_shape, find_groove_transient


   !> Its values are the logarithms over those of the viscosities with which it began, Pa s.
   type, extends(coupled_field) :: oil_field_type
      real(wp), allocatable :: first(:)
      !> Where grooves and shaft keep their temperatures: these, of each bearing.
      type(oil_temperatures_type), allocatable :: kept(:)
      !> Of the last state.
      type(state_balance_type) :: balance
   contains
      procedure :: begin
      procedure :: apply
      procedure :: find_wanted
      procedure :: check
   end type oil_field_type

   !> Residual of the logarithms of viscosities; the same where temperatures along and across the films follow, which
   !> are changed by ten times as much, and where an equilibrium of converged films follows, from which the films of a
   !> march differ as much (docs/benchmarks.md, *Film solvers*); where it jumps; longest step.
   real(wp), parameter :: agreement = 1e-8_wp, rough = 1e-2_wp, nearly = 1e-4_wp, jump = 1e-4_wp, longest = 1

   !> A static model whose pads are in equilibrium or held where they are.
   type, extends(balance_type) :: static_balance
      real(wp) :: residual = 0
      logical, allocatable :: held(:)
   contains
      procedure :: settle
   end type static_balance

   !> Iterations of a search for another equilibrium: by Newton's method, which takes about five where it leads there;
   !> from where it has led; by the motion.
   integer, parameter :: most_iterations = 6, more_iterations = 50, most_motion = 60
   !> Warming that is guessed where nothing better is known, K.
   real(wp), parameter :: some_warming = 20
   !> Guesses of viscosities; the start of a search at which the first is made.
   integer, parameter :: guesses = 3, middle_start = 3


   !> Change of the speed between two nodes, over itself, at most; least nodes.
   real(wp), parameter :: change_of_speed = 0.03_wp
   integer, parameter :: least_nodes = 24
   !> Least speed over the first that is followed.
   real(wp), parameter :: least_ratio = 0.01_wp

contains

   ! The oil of pads as a coupled field: the logarithms of the viscosities of their films, for which the heat balance of
   ! losses and flows wants others.

   !> Begins with the viscosities of a model, and with temperatures of grooves and shaft that are kept, if some are;
   !> `settles` as in solve_thermal_equilibrium.
   subroutine begin(self, model, kept, settles)
      class(oil_field_type), intent(inout) :: self
      type(machine_model), intent(in) :: model
      type(oil_temperatures_type), intent(in), optional :: kept(:)
      logical, intent(in), optional :: settles
      self%agreement = agreement
      if (present(settles)) self%agreement = merge(nearly, agreement, settles)
      if (model%inputs%thermal%model == 'film') self%agreement = rough
      self%jump = jump
      self%longest = longest
      self%parts = model%layout%pads
      self%first = model%oil%viscosity
      self%values = 0*self%first
      if (present(kept)) self%kept = kept
   end subroutine begin

   subroutine apply(self, model)
      class(oil_field_type), intent(inout) :: self
      type(machine_model), intent(inout) :: model
      model%oil%viscosity = self%first*exp(self%values)
   end subroutine apply

   subroutine find_wanted(self, model, y, wanted, error)
      class(oil_field_type), intent(inout) :: self
      type(machine_model), intent(inout) :: model
      real(wp), intent(in) :: y(:)
      real(wp), intent(out) :: wanted(:)
      type(error_type), allocatable, intent(out) :: error
      call find_residual(model, y, self%balance, self%kept)
      wanted = self%values + self%balance%residual
   end subroutine find_wanted

   !> Refuses heat that has no balance, oil that boils, and viscosities that do not settle.
   subroutine check(self, model, agrees, error)
      class(oil_field_type), intent(in) :: self
      type(machine_model), intent(in) :: model
      logical, intent(in) :: agrees
      type(error_type), allocatable, intent(out) :: error
      call check_heat(model, self%balance, error, self%kept)
      if (.not. (allocated(error) .or. agrees)) call raise(error, numerics_error, 'the temperatures of the oil do ' &
         & //'not settle: after '//to_text(most_rounds)//' rounds its viscosity still changes by ' &
         & //to_text(100*maxval(abs(self%balance%residual)))//' %')
   end subroutine check

   !> Gives the oil viscosities to search with: those that it would have at one of the starts of a search; those of some
   !> warming; those of cold oil.
   subroutine guess_oil(model, guess)
      type(machine_model), intent(inout) :: model
      integer, intent(in) :: guess
      type(state_balance_type) :: balance
      real(wp), dimension(model%layout%pads) :: wanted, balanced
      logical :: ok
      associate (oil => model%inputs%bearings(1)%oil)
         wanted = viscosity(oil, oil%supply_temperature + (guesses - guess)*some_warming)
      end associate
      if (guess == 1) then
         call find_losses(model, start(model, middle_start), balance)
         call balance%bearings(1)%heat%viscosities(balance%losses, model%oil%viscosity, model%point%speed(0.0_wp), &
            & balanced, ok)
         if (ok) wanted = balanced
      end if
      model%oil = even_oil(wanted)
   end subroutine guess_oil

   !> Brings the state y of a static model, some of whose pads may be held where they are, and fields to equilibrium.
   subroutine settle_fields(model, y, fields, residual, error, held)
      type(machine_model), intent(inout), target :: model
      real(wp), intent(inout) :: y(:)
      type(field_reference), intent(in) :: fields(:)
      real(wp), intent(out) :: residual
      type(error_type), allocatable, intent(out) :: error
      logical, intent(in), optional :: held(:)
      type(static_balance) :: balance
      balance%model => model
      if (present(held)) balance%held = held
      call solve_fields(balance, y, fields, error)
      residual = balance%residual
   end subroutine settle_fields

   !> By Newton's method, which goes astray where an unloaded pad has lost its stiffness at the last place: then anew
   !> from there, and in the end by the motion from the last place.
   subroutine settle(self, last, y, first, final, error)
      class(static_balance), intent(inout) :: self
      real(wp), intent(in) :: last(:)
      real(wp), intent(inout) :: y(:)
      logical, intent(in) :: first, final
      type(error_type), allocatable, intent(out) :: error
      call solve_equilibrium(self%model, y, self%residual, error, self%held, &
         & merge(huge(1), most_iterations, first))
      if (first .or. .not. allocated(error)) return
      if (error%status == stopped) return
      call solve_equilibrium(self%model, y, self%residual, error, self%held, more_iterations)
      if (.not. (final .and. allocated(error))) return
      if (error%status == stopped) return
      y = last
      call follow_motion(self%model, y, self%residual, error, self%held, most=most_motion)
   end subroutine settle

   !> Brings a state that is near equilibrium to equilibrium, as solve_equilibrium does, and the oil, where it is warm,
   !> to the temperatures of this equilibrium: the model then has its viscosities.
   subroutine solve_thermal_equilibrium(model, y, residual, error, held, kept, films, settles)
      type(machine_model), intent(inout), target :: model
      real(wp), intent(inout) :: y(:)
      real(wp), intent(out) :: residual
      type(error_type), allocatable, intent(out) :: error
      !> Pads that are held where they are.
      logical, intent(in), optional :: held(:)
      !> Where grooves and shaft keep their temperatures: these, of each bearing.
      type(oil_temperatures_type), intent(in), optional :: kept(:)
      !> The temperatures of the films of each bearing, where the case wants them along and across.
      type(warm_films_type), allocatable, intent(out), optional :: films(:)
      !> Whether a model with converged films settles it.
      logical, intent(in), optional :: settles
      type(warm_films_type), allocatable :: found(:)
      type(oil_field_type), target :: pads
      type(field_reference) :: fields(1)
      type(oil_temperatures_type) :: oil(size(model%bearings))
      integer :: b
      if (.not. has_warm_oil(model)) then
         call solve_equilibrium(model, y, residual, error, held)
         return
      end if
      ! one temperature for each pad leads to those along and across
      model%oil = even_oil(model%oil%viscosity)
      call pads%begin(model, kept, settles)
      fields(1)%field => pads
      call settle_fields(model, y, fields, residual, error, held)
      if (allocated(error) .or. model%inputs%thermal%model /= 'film') return
      call find_temperatures(model, y, pads%balance, oil)
      allocate (found(size(oil)))
      do b = 1, size(oil)
         found(b) = new_warm_films(model%inputs%bearings(b), model%inputs%thermal, oil(b)%mean)
      end do
      call solve_warm_films(model, y, found, residual, error, held)
      if (present(films)) call move_alloc(found, films)
   end subroutine solve_thermal_equilibrium

   !> The same of a model whose films have temperatures already, and whose oil is theirs.
   subroutine solve_warm_films(model, y, films, residual, error, held)
      type(machine_model), intent(inout), target :: model
      real(wp), intent(inout) :: y(:)
      type(warm_films_type), allocatable, intent(inout) :: films(:)
      real(wp), intent(out) :: residual
      type(error_type), allocatable, intent(out) :: error
      logical, intent(in), optional :: held(:)
      type(film_field_type), target :: field
      type(field_reference) :: fields(1)
      call field%begin(model, films)
      fields(1)%field => field
      call settle_fields(model, y, fields, residual, error, held)
      call move_alloc(field%films, films)
   end subroutine solve_warm_films

   !> Brings the state y of a static model that is in equilibrium in the shapes of its case to equilibrium in the shapes
   !> that this leads to, of each bearing, with their temperatures; an error where there is none.
   subroutine solve_shape(model, y, films, shapes, residual, error)
      type(machine_model), intent(inout), target :: model
      real(wp), intent(inout) :: y(:)
      !> Of each bearing, where films have temperatures.
      type(warm_films_type), allocatable, intent(inout) :: films(:)
      type(bearing_shape_type), allocatable, intent(out) :: shapes(:)
      real(wp), intent(out) :: residual
      type(error_type), allocatable, intent(out) :: error
      type(shape_field_type), target :: shape
      type(film_field_type), target :: field
      type(oil_field_type), target :: pads
      type(field_reference) :: fields(2)
      call shape%begin(model%inputs, field)
      ! a shape needs the temperatures that its own values change
      fields(2)%field => shape
      if (allocated(films)) then
         call field%begin(model, films, gaps_change=.true.)
         fields(1)%field => field
      else if (has_warm_oil(model)) then
         call pads%begin(model)
         fields(1)%field => pads
      end if
      call settle_fields(model, y, fields(merge(1, 2, has_warm_oil(model)):), residual, error)
      if (allocated(field%films)) call move_alloc(field%films, films)
      if (.not. allocated(error)) call move_alloc(shape%wanted, shapes)
   end subroutine solve_shape

   !> The history of the viscosities in a march of a model from its equilibrium y, whose viscosities it has, over a
   !> duration, s. An error where a speed has no equilibrium.
   subroutine find_groove_transient(model, y, duration, history, error)
      type(machine_model), intent(in) :: model
      real(wp), intent(in) :: y(:), duration
      type(viscosity_history_type), intent(out) :: history
      type(error_type), allocatable, intent(out) :: error
      type(machine_model) :: static
      type(state_balance_type) :: balance
      type(oil_temperatures_type), dimension(size(model%bearings)) :: oil, next
      real(wp), dimension(model%layout%pads) :: entering, before, rate, time_constant
      real(wp), allocatable :: time(:), viscosity(:, :)
      real(wp) :: state(size(y)), residual
      integer :: b, k
      call set_nodes()
      allocate (viscosity(size(entering), 0:ubound(time, 1)))
      call make_static(model, model%point%cavitation, static)
      state = y
      entering = 0
      do k = 0, ubound(time, 1)
         static%point%speed_rpm = model%point%speed(time(k))/rpm
         if (k > 0) then
            do b = 1, size(oil)
               associate (pads => model%layout%elements(b)%all_pads())
                  call renew(oil(b)%inlet, entering(pads), rate(pads), time_constant(pads), time(k) - time(k - 1))
               end associate
            end do
            call solve_thermal_equilibrium(static, state, residual, error, kept=oil)
            call add_context(error, 'oil of the run-up at '//to_text(static%point%speed_rpm)//' rpm')
            if (allocated(error)) return
         end if
         viscosity(:, k) = static%oil%viscosity
         if (k == 0) then
            call find_temperatures(static, state, balance, oil)
            next = oil
         else
            call find_temperatures(static, state, balance, next, kept=oil)
         end if
         before = entering
         do b = 1, size(next)
            associate (first => model%layout%elements(b)%first_pad, last => model%layout%elements(b)%last_pad)
               call balance%bearings(b)%heat%renewal(balance%losses(first:last), next(b), &
                  & static%point%speed(0.0_wp), entering(first:last), time_constant(first:last))
            end associate
         end do
         rate = 0
         if (k > 0) rate = (entering - before)/(time(k) - time(k - 1))
      end do
      history = new_viscosity_history(time, viscosity)

   contains

      !> Times, s, between which the speed changes by equal factors; near standstill nothing is followed.
      subroutine set_nodes()
         real(wp) :: ratio, first
         integer :: n
         first = model%point%speed(0.0_wp)
         ratio = max(model%point%speed(duration)/first, least_ratio)
         n = max(least_nodes, ceiling(abs(log(ratio))/change_of_speed))
         allocate (time(0:n))
         time(:) = [(first*(ratio**(real(k, wp)/n) - 1)/model%point%acceleration, k=0, n)]
      end subroutine set_nodes
   end subroutine find_groove_transient

   !> Temperatures of grooves after a time step, s, in which what enters changes at this rate, K/s.
   elemental subroutine renew(inlet, entering, rate, time_constant, step)
      real(wp), intent(inout) :: inlet
      real(wp), intent(in) :: entering, rate, time_constant, step
      inlet = entering + rate*(step - time_constant) + (inlet - entering + rate*time_constant)*exp(-step/time_constant)
   end subroutine renew
end module thermal_equilibrium
