!> Equations of motion (1)-(4) of a rotor and the pads of its bearings as an ODE, with their linearisation.
module equations_of_motion
   use kinds, only: wp
   use case_inputs, only: case_type
   use operating_point, only: operating_point_type
   use oil_properties, only: reference_viscosity
   use film_solver, only: film_oil
   use kinematics, only: pad_state
   use tilting_pad_bearing, only: tilting_pad_bearing_type, new_tilting_pad_bearing, pad_outputs
   use abstract_rotor, only: rotor_type, journal_motion
   use rotor_factory, only: make_rotor
   use ode_model, only: ode_model_type
   use viscosity_history, only: viscosity_history_type
   use state_layout, only: state_layout_type, pads_layout_type, pads_layout, new_state_layout, at_tilt, at_tilt_rate, &
      & at_deflection, at_deflection_rate
   use characteristic_scales, only: state_scales
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
      !> The oil of the pads of all bearings, and its course where it warms or cools in a motion.
      type(film_oil), allocatable :: oil(:)
      type(viscosity_history_type) :: oil_history
      !> Characteristic scale of each state.
      real(wp), allocatable :: scale(:)
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
      procedure :: set_point
      procedure :: adopt
      procedure :: state
      procedure :: static_state
      procedure :: positions
      procedure :: tilt_lengths
   end type machine_model

contains

   !> The model of a valid case, at its operating point, with films for a march or, as factories has it, for something
   !> else. Where its shaft has no equations, `refusal` says why.
   function new_machine_model(inputs, accuracy) result(model)
      type(case_type), intent(in) :: inputs
      integer, intent(in), optional :: accuracy
      type(machine_model) :: model
      type(pads_layout_type) :: pads(size(inputs%bearings))
      integer :: b
      model%inputs = inputs
      call make_rotor(inputs, model%rotor, model%refusal)
      if (allocated(model%refusal)) return
      allocate (model%bearings(size(pads)), model%oil(0))
      do b = 1, size(pads)
         model%bearings(b) = new_tilting_pad_bearing(inputs, b, accuracy)
         associate (bearing => inputs%bearings(b))
            pads(b) = pads_layout(bearing%pad_count(), bearing%tilting(), bearing%tilting_radial(), &
               & model%bearings(b)%pivots(1)%friction%has_bristle)
            model%oil = [model%oil, spread(film_oil(reference_viscosity(bearing)), 1, bearing%pad_count())]
         end associate
      end do
      model%layout = new_state_layout(model%rotor%states, pads)
      model%n = model%layout%n
      model%outputs = pad_outputs*model%layout%pads
      call model%set_point(operating_point_type(inputs))
      model%scale = state_scales(inputs, model%point, model%rotor, model%bearings, model%layout)
      model%newton = new_newton_system(model%layout)
   end function new_machine_model

   !> Another operating point; tables and films stay.
   subroutine set_point(self, point)
      class(machine_model), intent(inout) :: self
      type(operating_point_type), intent(in) :: point
      integer :: b
      do b = 1, size(self%bearings)
         if (point%cavitation .neqv. self%point%cavitation) call self%bearings(b)%film%set_cavitation(point%cavitation)
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
      integer :: b
      do b = 1, size(self%bearings)
         associate (p => self%inputs%bearings(b)%pivot, q => inputs%bearings(b)%pivot, of => self%layout%bearings(b))
            call self%bearings(b)%adopt(inputs, b, any(abs([p%socket_radius - q%socket_radius, &
               & p%radius_difference - q%radius_difference, p%deflection_factor - q%deflection_factor, &
               & p%young_modulus - q%young_modulus, p%poisson_ratio - q%poisson_ratio]) > 0), anew)
            self%oil(of%all_pads()) = film_oil(reference_viscosity(inputs%bearings(b)))
         end associate
      end do
      self%inputs = inputs
      call make_rotor(inputs, rotor, refusal, self%rotor)
      if (allocated(rotor)) call move_alloc(rotor, self%rotor)
      point = operating_point_type(inputs)
      if (.not. self%point%friction) point = point%static()
      point%cavitation = self%point%cavitation
      call self%set_point(point)
   end subroutine adopt

   !> The state with rotor and pads at rest: displacements of the rotor, m, tilts, rad, and pivot deflections, m, of the
   !> pads of all bearings (what a pad lacks does not matter), bristles undeflected.
   pure function static_state(self, rotor, tilt, pivot_deflection) result(y)
      class(machine_model), intent(in) :: self
      real(wp), intent(in) :: rotor(:), tilt(:), pivot_deflection(:)
      real(wp) :: y(self%n)
      integer :: i
      y(:size(rotor)) = rotor
      y(size(rotor) + 1:self%rotor%states) = 0
      call self%layout%put_all_pads([(pad_state(tilt(i), 0.0_wp, pivot_deflection(i)), i=1, size(tilt))], y)
   end function static_state

   !> The state of a rigid rotor and its bearing with this motion of the journal and these states of the pads.
   pure function state(self, journal, pads) result(y)
      class(machine_model), intent(in) :: self
      type(journal_motion), intent(in) :: journal
      type(pad_state), intent(in) :: pads(:)
      real(wp) :: y(self%n)
      y(:self%rotor%states) = self%rotor%with_journals([journal])
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

   !> What stands for 1 rad of each tilt of layout%tilts(): the distance from the pivot to the centre of the pad's arc,
   !> m.
   pure function tilt_lengths(self) result(lengths)
      class(machine_model), intent(in) :: self
      real(wp), allocatable :: lengths(:)
      integer :: b
      allocate (lengths(0))
      do b = 1, size(self%bearings)
         if (self%layout%bearings(b)%tilting) lengths = [lengths, self%bearings(b)%pads%position%centre_distance]
      end do
   end function tilt_lengths

   !> Evaluates the bearings at (t, y): loads and, where they are wanted, their derivatives; those of pads, numbered
   !> over all bearings, that are not chosen stay what they are.
   subroutine evaluate(self, t, y, want_derivatives, ok, chosen)
      class(machine_model), intent(inout) :: self
      real(wp), intent(in) :: t, y(:)
      logical, intent(in) :: want_derivatives
      logical, intent(out) :: ok
      logical, intent(in), optional :: chosen(:)
      integer :: b
      if (self%oil_history%runs()) call self%oil_history%at(t, self%oil%viscosity)
      do b = 1, size(self%bearings)
         associate (of => self%layout%bearings(b), &
            & first => self%layout%bearings(b)%other_pads + 1, &
            & last => self%layout%bearings(b)%other_pads + self%layout%bearings(b)%pads)
            if (present(chosen)) then
               call self%bearings(b)%evaluate(self%rotor%journal(y(:self%rotor%states), b), of%pad_states(y), &
                  & self%oil(first:last), self%point%speed(t), want_derivatives, self%refusal, ok, chosen(first:last))
            else
               call self%bearings(b)%evaluate(self%rotor%journal(y(:self%rotor%states), b), of%pad_states(y), &
                  & self%oil(first:last), self%point%speed(t), want_derivatives, self%refusal, ok)
            end if
         end associate
         if (.not. ok) return
      end do
   end subroutine evaluate

   !> Rates of all states at (t, y).
   subroutine rhs(self, t, y, dydt, ok)
      class(machine_model), intent(inout) :: self
      real(wp), intent(in) :: t, y(:)
      real(wp), intent(out) :: dydt(:)
      logical, intent(out) :: ok
      call self%evaluate(t, y, .false., ok)
      if (ok) call set_rates(self, t, y, dydt)
   end subroutine rhs

   !> Rates of all states at (t, y), where the bearings were evaluated.
   subroutine set_rates(self, t, y, dydt)
      class(machine_model), intent(in) :: self
      real(wp), intent(in) :: t, y(:)
      real(wp), intent(out) :: dydt(:)
      real(wp) :: force(self%rotor%positions), rates(2)
      integer :: b, i, o
      force = self%rotor%force(y(:self%rotor%states), self%point, t)
      do b = 1, size(self%bearings)
         associate (bearing => self%bearings(b), layout => self%layout%bearings(b))
            do i = 1, layout%pads
               associate (loads => bearing%loads(i))
                  force(2*b - 1:2*b) = force(2*b - 1:2*b) + loads%journal
                  if (.not. layout%tilting) cycle
                  o = layout%before(i)
                  dydt(o + at_tilt) = y(o + at_tilt_rate)
                  rates = bearing%per_mass(:, 1, i)*loads%moment + bearing%per_mass(:, 2, i)*loads%radial
                  dydt(o + at_tilt_rate) = rates(1)
                  if (layout%radial) then
                     dydt(o + at_deflection) = y(o + at_deflection_rate)
                     dydt(o + at_deflection_rate) = rates(2)
                  end if
                  if (layout%bristles) dydt(o + layout%per_pad) = loads%friction%rate
               end associate
            end do
         end associate
      end do
      dydt(:self%rotor%positions) = y(self%rotor%positions + 1:self%rotor%states)
      dydt(self%rotor%positions + 1:self%rotor%states) = self%rotor%accelerations(force)
   end subroutine set_rates

   !> Derivatives of film and contact at (t, y), for `solve`.
   subroutine linearize(self, t, y, ok)
      class(machine_model), intent(inout) :: self
      real(wp), intent(in) :: t, y(:)
      logical, intent(out) :: ok
      call self%evaluate(t, y, .true., ok)
      if (ok) call self%newton%linearize(self%rotor, self%bearings, self%point%speed(t))
   end subroutine linearize

   !> b := (1 - gamma J)^(-1) b, with film and contact as linearised last and friction as evaluated last: Newton's
   !> iteration then crosses the switching points of friction, where old derivatives would mislead it.
   subroutine solve(self, gamma, b, ok)
      class(machine_model), intent(inout) :: self
      real(wp), intent(in) :: gamma
      real(wp), intent(inout) :: b(:)
      logical, intent(out) :: ok
      call self%newton%solve(self%rotor, self%bearings, gamma, b, ok)
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
         associate (of => self%layout%bearings(b))
            output(pad_outputs*of%other_pads + 1:pad_outputs*(of%other_pads + of%pads)) &
               & = self%bearings(b)%output(of%over_columns(correction))
         end associate
      end do
   end function output

   !> Names a film that is nearly closed in the state evaluated last.
   function warning(self)
      class(machine_model), intent(in) :: self
      character(len=:), allocatable :: warning
      integer :: b
      warning = ''
      do b = 1, size(self%bearings)
         if (warning == '') warning = self%bearings(b)%warning()
      end do
   end function warning

   !> Rates of all states at (t, y), and the whole Jacobian there.
   subroutine rhs_and_jacobian(self, t, y, dydt, matrix, ok)
      class(machine_model), intent(inout) :: self
      real(wp), intent(in) :: t, y(:)
      real(wp), intent(out) :: dydt(:), matrix(:, :)
      logical, intent(out) :: ok
      call self%linearize(t, y, ok)
      if (.not. ok) return
      call set_rates(self, t, y, dydt)
      matrix = self%newton%jacobian(self%rotor, self%bearings)
   end subroutine rhs_and_jacobian

   !> Displacements of rotor and pads, and their rates.
   pure subroutine pairs(self, x, v)
      class(machine_model), intent(in) :: self
      integer, allocatable, intent(out) :: x(:), v(:)
      x = self%layout%positions()
      v = self%layout%rates()
   end subroutine pairs

   !> The pads, where those of all bearings have as many states.
   pure subroutine blocks(self, number, states)
      class(machine_model), intent(in) :: self
      integer, intent(out) :: number, states
      states = self%layout%bearings(1)%per_pad
      number = merge(self%layout%pads, 0, states > 0 .and. all(self%layout%bearings%per_pad == states))
   end subroutine blocks

   !> The tilt rates at which the pivot passes a switching point of its friction.
   pure subroutine switching_points(self, state, value)
      class(machine_model), intent(in) :: self
      integer, allocatable, intent(out) :: state(:)
      real(wp), allocatable, intent(out) :: value(:)
      real(wp), allocatable :: velocity(:)
      integer :: b, i, j
      allocate (state(0), value(0))
      do b = 1, size(self%bearings)
         associate (of => self%layout%bearings(b), bearing => self%bearings(b))
            if (.not. of%tilting) cycle
            velocity = bearing%pivots(1)%friction%switching_points()
            state = [state, ((of%before(i) + at_tilt_rate, j=1, size(velocity)), i=1, of%pads)]
            value = [value, (velocity/bearing%pads(i)%ball_radius, i=1, of%pads)]
         end associate
      end do
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
end module equations_of_motion
