!> Equations of motion (1)-(4) of a rotor and of its elements, of which the bearings are the first, as an ODE, with
!> their linearisation.
module equations_of_motion
   use kinds, only: wp
   use errors, only: asked_to_stop
   use case_groups, only: mount_type
   use case_inputs, only: case_type
   use operating_point, only: operating_point_type
   use oil_properties, only: reference_viscosity
   use film_solver, only: film_oil
   use tilting_pad_bearing, only: tilting_pad_bearing_type, new_tilting_pad_bearing
   use rigid_rotor, only: rotor_type, journal_motion
   use rotor_factory, only: make_rotor
   use ode_model, only: ode_model_type
   use viscosity_history, only: viscosity_history_type
   use state_layout, only: state_layout_type, element_layout_type, new_state_layout, pad_state, of_journal
   use abstract_element, only: element_type, element_slot, element_pointer
   use squeeze_film_damper, only: dampers_of
   use newton_system, only: newton_system_type, new_newton_system
   implicit none (type, external)
   private
   public :: machine_model, new_machine_model

   type, extends(ode_model_type) :: machine_model
      type(case_type) :: inputs
      type(operating_point_type) :: point
      type(state_layout_type) :: layout
      class(rotor_type), allocatable :: rotor
      type(tilting_pad_bearing_type), allocatable :: bearings(:)
      !> What acts on the rotor beside its bearings.
      type(element_slot), allocatable :: others(:)
      !> The oil of the pads of all elements, and its course where it warms or cools in a motion.
      type(film_oil), allocatable :: oil(:)
      type(viscosity_history_type) :: oil_history
      !> Characteristic scale of each state.
      real(wp), allocatable :: scale(:)
      !> Outputs of a pad.
      integer :: pad_outputs = 0
      !> Asked by searches between evaluations of the films whether they are to be given up, where it is set.
      procedure(asked_to_stop), pointer, nopass :: give_up => null()
      type(newton_system_type), private :: newton
   contains
      procedure :: rhs
      procedure :: linearize
      procedure :: solve
      procedure :: rhs_and_jacobian
      procedure :: output
      procedure :: warning
      procedure :: pairs
      procedure :: blocks
      procedure :: switching_points
      procedure :: df_dt
      procedure :: next_switch
      procedure :: evaluate
      procedure :: lay_out
      procedure :: set_point
      procedure :: adopt
      procedure :: state
      procedure :: static_state
      procedure :: positions
      procedure :: own_lengths
      procedure :: least_clearance
      procedure :: elements
   end type machine_model

   !> m
   real(wp), parameter :: usual_vibration = 1e-4_wp

contains

   !> The model of a valid case, at its operating point, with films for a march or, as factories has it, for something
   !> else, and with these elements beside its bearings, or its dampers. `rotor` is that of the case, where there is one
   !> already. Where its shaft has no equations, `refusal` says why.
   function new_machine_model(inputs, accuracy, others, rotor) result(model)
      type(case_type), intent(in) :: inputs
      integer, intent(in), optional :: accuracy
      type(element_slot), intent(in), optional :: others(:)
      class(rotor_type), intent(in), optional :: rotor
      type(machine_model) :: model
      integer :: b
      model%inputs = inputs
      if (present(rotor)) then
         allocate (model%rotor, source=rotor)
      else
         call make_rotor(inputs, model%rotor, model%refusal)
         if (allocated(model%refusal)) return
      end if
      allocate (model%bearings(size(inputs%bearings)), model%oil(0))
      if (present(others)) then
         model%others = others
      else
         model%others = dampers_of(inputs)
      end if
      do b = 1, size(model%bearings)
         model%bearings(b) = new_tilting_pad_bearing(inputs, b, accuracy)
         associate (bearing => inputs%bearings(b))
            model%oil = [model%oil, spread(film_oil(reference_viscosity(bearing)), 1, bearing%pad_count())]
         end associate
      end do
      call model%set_point(operating_point_type(inputs))
      call model%lay_out()
   end function new_machine_model

   !> Lays out the states of the rotor and of its elements as they are now, with their scales and Newton's systems.
   subroutine lay_out(self)
      class(machine_model), intent(inout), target :: self
      type(element_pointer), allocatable :: elements(:)
      type(element_layout_type), allocatable :: layouts(:)
      integer, allocatable :: pairs(:)
      integer :: e
      elements = self%elements()
      allocate (layouts(size(elements)))
      do e = 1, size(elements)
         layouts(e) = elements(e)%to%layout()
      end do
      pairs = [(e, e=1, size(self%bearings)), self%others%pair]
      associate (slopes => [(self%rotor%slope_pair(pairs(e)), e=1, size(elements))])
         self%layout = new_state_layout(self%rotor%states, layouts, pairs, slopes)
         self%newton = new_newton_system(self%layout, maxval([self%rotor%journals, pairs, slopes]))
      end associate
      do e = 1, size(elements)
         elements(e)%to%of_rotor = self%layout%elements(e)%of_rotor
      end do
      self%n = self%layout%n
      self%pad_outputs = maxval([0, (self%bearings(e)%least_outputs(), e=1, size(self%bearings))])
      self%bearings%outputs = self%pad_outputs
      self%outputs = self%pad_outputs*sum(layouts(:size(self%bearings))%pads)
      self%scale = state_scales(self%inputs%highest_speed(), self%point, self%rotor, elements, &
         & [self%bearings%clearance, self%least_clearance()], self%layout)
   end subroutine lay_out

   !> All elements: bearings, then others.
   function elements(self)
      class(machine_model), intent(in), target :: self
      type(element_pointer) :: elements(size(self%bearings) + size(self%others))
      integer :: e
      do e = 1, size(self%bearings)
         elements(e)%to => self%bearings(e)
      end do
      do e = 1, size(self%others)
         elements(size(self%bearings) + e)%to => self%others(e)%of
      end do
   end function elements

   !> Another operating point; tables and films stay.
   subroutine set_point(self, point)
      class(machine_model), intent(inout) :: self
      type(operating_point_type), intent(in) :: point
      integer :: b
      do b = 1, size(self%bearings)
         if (point%cavitation .neqv. self%point%cavitation) call self%bearings(b)%set_cavitation(point%cavitation)
         self%bearings(b)%rubs = point%friction
      end do
      self%point = point
   end subroutine set_point

   !> Makes the model that of another case, which differs in numbers alone and not in that of the pads. Tables, films
   !> and characteristic scales stay where they can; so do the effects that do not act. `anew`, its films start as if
   !> nothing had been solved before.
   subroutine adopt(self, inputs, anew)
      class(machine_model), intent(inout) :: self
      type(case_type), intent(in) :: inputs
      logical, intent(in) :: anew
      type(operating_point_type) :: point
      class(rotor_type), allocatable :: rotor
      character(len=:), allocatable :: refusal
      integer :: b, i
      do b = 1, size(self%bearings)
         associate (p => self%inputs%bearings(b)%pivot, q => inputs%bearings(b)%pivot, of => self%layout%elements(b))
            call self%bearings(b)%adopt(inputs, b, .not. all([(p%is_like(i, q, i), i=1, size(p%socket_radius))]), anew)
            self%oil(of%all_pads()) = film_oil(reference_viscosity(inputs%bearings(b)))
         end associate
      end do
      self%inputs = inputs
      if (size(inputs%dampers()) > 0) self%others = dampers_of(inputs)
      call make_rotor(inputs, rotor, refusal, self%rotor)
      if (allocated(rotor)) call move_alloc(rotor, self%rotor)
      point = operating_point_type(inputs)
      if (.not. self%point%friction) point = point%static()
      point%cavitation = self%point%cavitation
      call self%set_point(point)
   end subroutine adopt

   !> The state with the rotor at rest: its displacements, m, and the states of the pads of all elements.
   pure function static_state(self, rotor, pads) result(y)
      class(machine_model), intent(in) :: self
      real(wp), intent(in) :: rotor(:)
      type(pad_state), intent(in) :: pads(:)
      real(wp) :: y(self%n)
      y(:size(rotor)) = rotor
      y(size(rotor) + 1:self%rotor%states) = 0
      call self%layout%put_all_pads(pads, y)
   end function static_state

   !> The state of a rigid rotor and its bearing with this motion of the journal and these states of the pads.
   pure function state(self, journal, pads) result(y)
      class(machine_model), intent(in) :: self
      type(journal_motion), intent(in) :: journal
      type(pad_state), intent(in) :: pads(:)
      real(wp) :: y(self%n)
      y(:self%rotor%states) = 0
      y(:of_journal) = journal%position
      y(self%rotor%positions + 1:self%rotor%positions + of_journal) = journal%velocity
      call self%layout%put_all_pads(pads, y)
   end function state

   !> Displacements of the rotor and (pads that tilt) the tilts, each over its scale.
   pure function positions(self, y)
      class(machine_model), intent(in) :: self
      real(wp), intent(in) :: y(:)
      real(wp), allocatable :: positions(:)
      integer, allocatable :: all_positions(:), chosen(:)
      integer :: i
      all_positions = self%layout%positions()
      chosen = [(i, i=1, self%rotor%positions), all_positions(self%layout%tilts())]
      positions = y(chosen)/self%scale(chosen)
   end function positions

   !> The least clearance, m, of the films; without any that of dampers, or what machines without films vibrate by.
   pure real(wp) function least_clearance(self)
      class(machine_model), intent(in) :: self
      type(mount_type), allocatable :: mounts(:)
      integer :: i
      if (size(self%bearings) > 0) then
         least_clearance = minval(self%bearings%clearance)
      else
         mounts = self%inputs%mounts()
         associate (dampers => self%inputs%dampers())
            least_clearance = minval([usual_vibration, (mounts(dampers(i))%damper%clearance, i=1, size(dampers))])
         end associate
      end if
   end function least_clearance

   !> What stands for a unit of each displacement of the elements, in the order of layout%positions(), m.
   function own_lengths(self) result(lengths)
      class(machine_model), intent(in), target :: self
      real(wp) :: lengths(self%layout%n_positions() - self%rotor%positions)
      type(element_pointer), allocatable :: elements(:)
      integer :: e, i, k, n
      elements = self%elements()
      n = 0
      do e = 1, size(elements)
         do i = 1, self%layout%elements(e)%pads
            do k = 1, self%layout%elements(e)%coordinates
               n = n + 1
               lengths(n) = elements(e)%to%length(i, k)
            end do
         end do
      end do
   end function own_lengths

   !> Evaluates the elements at (t, y): forces and, where they are wanted, their derivatives; those of pads, numbered
   !> over all elements, that are not chosen stay what they are.
   subroutine evaluate(self, t, y, want_derivatives, ok, chosen)
      class(machine_model), intent(inout), target :: self
      real(wp), intent(in) :: t, y(:)
      logical, intent(in) :: want_derivatives
      logical, intent(out) :: ok
      logical, intent(in), optional :: chosen(:)
      type(element_pointer) :: elements(size(self%layout%elements))
      !> Not allocated: all.
      logical, allocatable :: chosen_here(:)
      integer :: e
      ok = .true.
      elements = self%elements()
      if (self%oil_history%runs()) call self%oil_history%at(t, self%oil%viscosity)
      do e = 1, size(elements)
         associate (of => self%layout%elements(e))
            if (present(chosen)) chosen_here = chosen(of%first_pad:of%last_pad)
            call elements(e)%to%evaluate(self%rotor%journal(y(:self%rotor%states), of%pair()), of%pad_states(y), &
               & self%oil(of%first_pad:of%last_pad), self%point%speed(t), want_derivatives, self%refusal, ok, &
               & chosen_here)
         end associate
         if (.not. ok) return
      end do
   end subroutine evaluate

   !> Rates of all states at (t, y).
   subroutine rhs(self, t, y, dydt, ok)
      class(machine_model), intent(inout), target :: self
      real(wp), intent(in) :: t, y(:)
      real(wp), intent(out) :: dydt(:)
      logical, intent(out) :: ok
      call self%evaluate(t, y, .false., ok)
      if (ok) call set_rates(self, self%elements(), t, y, dydt)
   end subroutine rhs

   !> Rates of all states at (t, y), where the elements were evaluated.
   subroutine set_rates(self, elements, t, y, dydt)
      class(machine_model), intent(in) :: self
      type(element_pointer), intent(in) :: elements(:)
      real(wp), intent(in) :: t, y(:)
      real(wp), intent(out) :: dydt(:)
      real(wp) :: force(self%rotor%positions), on_pair(of_journal)
      integer :: e
      force = self%rotor%force(y(:self%rotor%states), self%point, t)
      do e = 1, size(elements)
         associate (of => self%layout%elements(e))
            on_pair = force(of%journal)
            call elements(e)%to%add_force(on_pair)
            force(of%journal) = on_pair
            if (of%of_rotor > of_journal) then
               on_pair = force(of%slopes)
               call elements(e)%to%add_moment(on_pair)
               force(of%slopes) = on_pair
            end if
            call elements(e)%to%add_rates(of, y, dydt)
         end associate
      end do
      dydt(:self%rotor%positions) = y(self%rotor%positions + 1:self%rotor%states)
      dydt(self%rotor%positions + 1:self%rotor%states) = self%rotor%accelerations(force)
   end subroutine set_rates

   !> Derivatives of film and contact at (t, y), for `solve`.
   subroutine linearize(self, t, y, ok)
      class(machine_model), intent(inout), target :: self
      real(wp), intent(in) :: t, y(:)
      logical, intent(out) :: ok
      call self%evaluate(t, y, .true., ok)
      if (ok) call self%newton%linearize(self%rotor, self%elements(), self%point%speed(t))
   end subroutine linearize

   !> b := (1 - gamma J)^(-1) b, with film and contact as linearised last and friction as evaluated last: Newton's
   !> iteration then crosses the switching points of friction, where old derivatives would mislead it.
   subroutine solve(self, gamma, b, ok)
      class(machine_model), intent(inout), target :: self
      real(wp), intent(in) :: gamma
      real(wp), intent(inout) :: b(:)
      logical, intent(out) :: ok
      call self%newton%solve(self%rotor, self%elements(), gamma, b, ok)
   end subroutine solve

   !> Of every pad film force and maximum pressure as evaluated last, the force with what a correction of that
   !> state adds to first order: where the pivot is without friction the tangential force is a small
   !> difference.
   function output(self, correction)
      class(machine_model), intent(inout) :: self
      real(wp), intent(in) :: correction(:)
      real(wp) :: output(self%outputs)
      integer :: b
      do b = 1, size(self%bearings)
         associate (of => self%layout%elements(b))
            output(self%pad_outputs*(of%first_pad - 1) + 1:self%pad_outputs*of%last_pad) &
               & = self%bearings(b)%output(of, correction)
         end associate
      end do
   end function output

   !> What may soon stop a motion from the state evaluated last, as a film that is nearly closed.
   function warning(self)
      class(machine_model), intent(in), target :: self
      character(len=:), allocatable :: warning
      type(element_pointer), allocatable :: elements(:)
      integer :: e
      warning = ''
      elements = self%elements()
      do e = 1, size(elements)
         if (warning == '') warning = elements(e)%to%warning()
      end do
   end function warning

   !> Rates of all states at (t, y), and the whole Jacobian there.
   subroutine rhs_and_jacobian(self, t, y, dydt, matrix, ok)
      class(machine_model), intent(inout), target :: self
      real(wp), intent(in) :: t, y(:)
      real(wp), intent(out) :: dydt(:), matrix(:, :)
      logical, intent(out) :: ok
      call self%linearize(t, y, ok)
      if (.not. ok) return
      associate (elements => self%elements())
         call set_rates(self, elements, t, y, dydt)
         matrix = self%newton%jacobian(self%rotor, elements)
      end associate
   end subroutine rhs_and_jacobian

   !> Displacements of rotor and pads, and their rates.
   pure subroutine pairs(self, x, v)
      class(machine_model), intent(in) :: self
      integer, allocatable, intent(out) :: x(:), v(:)
      x = self%layout%positions()
      v = self%layout%rates()
   end subroutine pairs

   !> The pads, where those of all elements have as many states.
   pure subroutine blocks(self, number, states)
      class(machine_model), intent(in) :: self
      integer, intent(out) :: number, states
      associate (bearings => self%layout%elements(:size(self%bearings)))
         states = maxval([0, bearings%per_pad])
         number = merge(sum(bearings%pads), 0, states > 0 .and. all(bearings%per_pad == states) &
            & .and. self%n == self%rotor%states + states*sum(bearings%pads))
      end associate
   end subroutine blocks

   !> The rates of a pad's tilt, or of another element's displacement, at which derivatives of the forces jump.
   pure subroutine switching_points(self, state, value)
      class(machine_model), intent(in) :: self
      integer, allocatable, intent(out) :: state(:)
      real(wp), allocatable, intent(out) :: value(:)
      integer :: e
      allocate (state(0), value(0))
      do e = 1, size(self%bearings)
         call add(self%bearings(e), self%layout%elements(e), state, value)
      end do
      do e = 1, size(self%others)
         call add(self%others(e)%of, self%layout%elements(size(self%bearings) + e), state, value)
      end do
   contains
      pure subroutine add(element, layout, state, value)
         class(element_type), intent(in) :: element
         type(element_layout_type), intent(in) :: layout
         integer, allocatable, intent(inout) :: state(:)
         real(wp), allocatable, intent(inout) :: value(:)
         integer :: i, j
         do i = 1, layout%pads
            associate (rates => element%switching_rates(i))
               state = [state, (layout%before(i) + 2, j=1, size(rates))]
               value = [value, rates]
            end associate
         end do
      end subroutine add
   end subroutine switching_points

   !> Where the excitations switch.
   pure subroutine next_switch(self, t, next, jumps)
      class(machine_model), intent(in) :: self
      real(wp), intent(in) :: t
      real(wp), intent(out) :: next
      logical, intent(out) :: jumps
      call self%point%next_switch(t, next, jumps)
   end subroutine next_switch

   !> The unbalance turns, and excitations change; at constant speed.
   pure function df_dt(self, t)
      class(machine_model), intent(in) :: self
      real(wp), intent(in) :: t
      real(wp) :: df_dt(self%n)
      df_dt = 0
      df_dt(self%rotor%positions + 1:self%rotor%states) = self%rotor%accelerations(self%rotor%turn(self%point, t))
   end function df_dt

   ! The characteristic scale of each state, over which tolerances and corrections are measured.

   !> Characteristic scale of each state of a rotor and its elements, of which the first are bearings with these
   !> clearances, m: what its elements say of theirs under the load on them; rates: times the highest speed, rad/s.
   pure function state_scales(highest_speed, point, rotor, elements, clearances, layout) result(scale)
      real(wp), intent(in) :: highest_speed, clearances(:)
      type(operating_point_type), intent(in) :: point
      class(rotor_type), intent(in) :: rotor
      type(element_pointer), intent(in) :: elements(:)
      type(state_layout_type), intent(in) :: layout
      real(wp) :: scale(layout%n), loads(2, rotor%positions/2)
      integer :: e
      ! what is no journal has none of them
      loads = 0
      loads(:, :rotor%journals) = rotor%loads(point)
      associate (n => rotor%positions)
         scale(:n) = rotor%scales(clearances)
         scale(n + 1:2*n) = scale(:n)*highest_speed
      end associate
      do e = 1, size(elements)
         associate (of => layout%elements(e), force => norm2(loads(:, layout%elements(e)%pair())) &
            & + point%unbalance*highest_speed**2)
            call of%put_pads(elements(e)%to%scales(of%pads, force, highest_speed), scale)
         end associate
      end do
   end function state_scales
end module equations_of_motion
