!> Equations of motion (1)-(4) of a rotor and the pads of its bearing as an ODE, with their linearisation.
module equations_of_motion
   use kinds, only: wp
   use case_inputs, only: case_type
   use operating_point, only: operating_point_type
   use oil_properties, only: reference_viscosity
   use film_solver, only: film_oil
   use kinematics, only: pad_state
   use tilting_pad_bearing, only: tilting_pad_bearing_type, pad_sample, new_tilting_pad_bearing, pad_outputs
   use rigid_journal, only: rigid_journal_type, journal_motion
   use ode_model, only: ode_model_type
   use viscosity_history, only: viscosity_history_type
   use state_layout, only: state_layout_type, new_state_layout, at_tilt, at_tilt_rate, at_deflection, &
      & at_deflection_rate
   use characteristic_scales, only: state_scales
   use newton_system, only: newton_system_type, new_newton_system
   implicit none (type, external)
   private
   public :: bearing_model, model_sample, new_bearing_model

   !> What is sampled at a time, s: shaft angle, rad; speed, rad/s; journal; states and loads of the pads.
   type :: model_sample
      real(wp) :: time = 0, shaft_angle = 0, speed = 0
      !> Whether the pads tilt, have pivot deflections and bristle deflections, and whether their asperities may touch.
      logical :: tilting = .true., radial = .false., bristles = .false., asperities = .false.
      type(journal_motion) :: journal
      type(pad_state), allocatable :: states(:)
      type(pad_sample), allocatable :: loads(:)
   end type model_sample

   type, extends(ode_model_type) :: bearing_model
      type(case_type) :: inputs
      type(operating_point_type) :: point
      type(state_layout_type) :: layout
      type(rigid_journal_type) :: rotor
      type(tilting_pad_bearing_type) :: bearing
      !> The oil of each pad, and its course where it warms or cools in a motion.
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
      procedure :: evaluate
      procedure :: set_point
      procedure :: adopt
      procedure :: state
      procedure :: static_state
      procedure :: positions
      procedure :: take_sample
   end type bearing_model

contains

   !> The model of a valid case, at its operating point, with films for a march or, as factories has it, for something
   !> else.
   function new_bearing_model(inputs, accuracy) result(model)
      type(case_type), intent(in) :: inputs
      integer, intent(in), optional :: accuracy
      type(bearing_model) :: model
      integer :: n
      n = inputs%pad_count()
      model%inputs = inputs
      model%bearing = new_tilting_pad_bearing(inputs, accuracy)
      model%oil = spread(film_oil(reference_viscosity(inputs)), 1, n)
      model%rotor%mass = inputs%rotor%mass
      model%layout = new_state_layout(model%rotor%states, n, inputs%tilting(), inputs%tilting_radial(), &
         & model%bearing%friction%has_bristle)
      model%n = model%layout%n
      model%outputs = pad_outputs*n
      call model%set_point(operating_point_type(inputs))
      model%scale = state_scales(inputs, model%point, model%rotor, model%bearing, model%layout)
      model%newton = new_newton_system(model%layout)
   end function new_bearing_model

   !> Another operating point; tables and films stay.
   subroutine set_point(self, point)
      class(bearing_model), intent(inout) :: self
      type(operating_point_type), intent(in) :: point
      if (point%cavitation .neqv. self%point%cavitation) call self%bearing%film%set_cavitation(point%cavitation)
      self%bearing%rubs = point%friction
      self%point = point
   end subroutine set_point

   !> Makes the model that of another case, which differs in numbers alone and not in that of the pads. Tables, films
   !> and characteristic scales stay where they can; so do the effects that do not act. `anew`, its films start as if
   !> nothing had been solved before.
   subroutine adopt(self, inputs, anew)
      class(bearing_model), intent(inout) :: self
      type(case_type), intent(in) :: inputs
      logical, intent(in) :: anew
      type(operating_point_type) :: point
      associate (a => self%inputs%pivot, b => inputs%pivot)
         call self%bearing%adopt(inputs, any(abs([a%socket_radius - b%socket_radius, &
            & a%radius_difference - b%radius_difference, a%deflection_factor - b%deflection_factor, &
            & a%young_modulus - b%young_modulus, a%poisson_ratio - b%poisson_ratio]) > 0), anew)
      end associate
      self%inputs = inputs
      self%oil = film_oil(reference_viscosity(inputs))
      self%rotor%mass = inputs%rotor%mass
      point = operating_point_type(inputs)
      if (.not. self%point%friction) point = point%static()
      point%cavitation = self%point%cavitation
      call self%set_point(point)
   end subroutine adopt

   !> The state with journal and pads at rest at given positions, m, tilts, rad, and pivot deflections, m (what a pad
   !> lacks does not matter), bristles undeflected.
   pure function static_state(self, journal, tilt, pivot_deflection) result(y)
      class(bearing_model), intent(in) :: self
      real(wp), intent(in) :: journal(2), tilt(:), pivot_deflection(:)
      real(wp) :: y(self%n)
      integer :: i
      y = self%state(journal_motion(journal), [(pad_state(tilt(i), 0.0_wp, pivot_deflection(i)), i=1, size(tilt))])
   end function static_state

   !> The state with this motion of the journal and these states of the pads.
   pure function state(self, journal, pads) result(y)
      class(bearing_model), intent(in) :: self
      type(journal_motion), intent(in) :: journal
      type(pad_state), intent(in) :: pads(:)
      real(wp) :: y(self%n)
      y(:self%rotor%states) = self%rotor%with_journal(journal)
      call self%layout%put_pads(pads, y)
   end function state

   !> Journal y, z and (pads that tilt) the tilts, each over its scale.
   pure function positions(self, y)
      class(bearing_model), intent(in) :: self
      real(wp), intent(in) :: y(:)
      real(wp), allocatable :: positions(:)
      type(journal_motion) :: journal, scale
      integer, allocatable :: tilts(:)
      integer :: i
      journal = self%rotor%journal(y(:self%rotor%states))
      scale = self%rotor%journal(self%scale(:self%rotor%states))
      tilts = self%layout%before([(i, i=1, merge(self%layout%pads, 0, self%layout%tilting))]) + at_tilt
      positions = [journal%position/scale%position, y(tilts)/self%scale(tilts)]
   end function positions

   !> Evaluates the bearing at (t, y): loads and, where they are wanted, their derivatives; those of pads that are not
   !> chosen stay what they are.
   subroutine evaluate(self, t, y, want_derivatives, ok, chosen)
      class(bearing_model), intent(inout) :: self
      real(wp), intent(in) :: t, y(:)
      logical, intent(in) :: want_derivatives
      logical, intent(out) :: ok
      logical, intent(in), optional :: chosen(:)
      if (self%oil_history%runs()) call self%oil_history%at(t, self%oil%viscosity)
      call self%bearing%evaluate(self%rotor%journal(y(:self%rotor%states)), self%layout%pad_states(y), self%oil, &
         & self%point%speed(t), want_derivatives, self%refusal, ok, chosen)
   end subroutine evaluate

   !> Rates of all states at (t, y).
   subroutine rhs(self, t, y, dydt, ok)
      class(bearing_model), intent(inout) :: self
      real(wp), intent(in) :: t, y(:)
      real(wp), intent(out) :: dydt(:)
      logical, intent(out) :: ok
      call self%evaluate(t, y, .false., ok)
      if (ok) call set_rates(self, t, y, dydt)
   end subroutine rhs

   !> Rates of all states at (t, y), where the bearing was evaluated.
   subroutine set_rates(self, t, y, dydt)
      class(bearing_model), intent(in) :: self
      real(wp), intent(in) :: t, y(:)
      real(wp), intent(out) :: dydt(:)
      real(wp) :: force(2), rates(2)
      integer :: i, o
      force = self%rotor%force(self%point, t)
      do i = 1, self%layout%pads
         associate (loads => self%bearing%loads(i), layout => self%layout)
            force = force + loads%journal
            if (.not. layout%tilting) cycle
            o = layout%before(i)
            dydt(o + at_tilt) = y(o + at_tilt_rate)
            rates = self%bearing%per_mass(:, 1, i)*loads%moment + self%bearing%per_mass(:, 2, i)*loads%radial
            dydt(o + at_tilt_rate) = rates(1)
            if (layout%radial) then
               dydt(o + at_deflection) = y(o + at_deflection_rate)
               dydt(o + at_deflection_rate) = rates(2)
            end if
            if (layout%bristles) dydt(o + layout%per_pad) = loads%friction%rate
         end associate
      end do
      dydt(:self%rotor%states) = self%rotor%rates(y(:self%rotor%states), force)
   end subroutine set_rates

   !> Derivatives of film and contact at (t, y), for `solve`.
   subroutine linearize(self, t, y, ok)
      class(bearing_model), intent(inout) :: self
      real(wp), intent(in) :: t, y(:)
      logical, intent(out) :: ok
      call self%evaluate(t, y, .true., ok)
      if (ok) call self%newton%linearize(self%rotor, self%bearing)
   end subroutine linearize

   !> b := (1 - gamma J)^(-1) b, with film and contact as linearised last and friction as evaluated last: Newton's
   !> iteration then crosses the switching points of friction, where old derivatives would mislead it.
   subroutine solve(self, gamma, b, ok)
      class(bearing_model), intent(inout) :: self
      real(wp), intent(in) :: gamma
      real(wp), intent(inout) :: b(:)
      logical, intent(out) :: ok
      call self%newton%solve(self%bearing, gamma, b, ok)
   end subroutine solve

   !> Of every pad film force and maximum pressure as evaluated last, the force with what a correction of that
   !> state adds to first order: where the pivot is without friction the tangential force is a small
   !> difference.
   function output(self, correction)
      class(bearing_model), intent(inout) :: self
      real(wp), intent(in) :: correction(:)
      real(wp) :: output(self%outputs)
      output = self%bearing%output(self%layout%over_columns(correction(:self%rotor%states), correction))
   end function output

   !> Names a film that is nearly closed in the state evaluated last.
   function warning(self)
      class(bearing_model), intent(in) :: self
      character(len=:), allocatable :: warning
      warning = self%bearing%warning()
   end function warning

   !> Rates of all states at (t, y), and the whole Jacobian there.
   subroutine rhs_and_jacobian(self, t, y, dydt, matrix, ok)
      class(bearing_model), intent(inout) :: self
      real(wp), intent(in) :: t, y(:)
      real(wp), intent(out) :: dydt(:), matrix(:, :)
      logical, intent(out) :: ok
      call self%linearize(t, y, ok)
      if (.not. ok) return
      call set_rates(self, t, y, dydt)
      matrix = self%newton%jacobian(self%rotor, self%bearing)
   end subroutine rhs_and_jacobian

   !> Displacements of rotor and pads, and their rates.
   pure subroutine pairs(self, x, v)
      class(bearing_model), intent(in) :: self
      integer, allocatable, intent(out) :: x(:), v(:)
      x = self%layout%positions()
      v = self%layout%rates()
   end subroutine pairs

   !> The pads.
   pure subroutine blocks(self, number, states)
      class(bearing_model), intent(in) :: self
      integer, intent(out) :: number, states
      number = merge(self%layout%pads, 0, self%layout%tilting)
      states = self%layout%per_pad
   end subroutine blocks

   !> The tilt rates at which the pivot passes a switching point of its friction.
   pure subroutine switching_points(self, state, value)
      class(bearing_model), intent(in) :: self
      integer, allocatable, intent(out) :: state(:)
      real(wp), allocatable, intent(out) :: value(:)
      real(wp), allocatable :: velocity(:)
      integer :: pads, i, j
      velocity = self%bearing%friction%switching_points()
      pads = merge(self%layout%pads, 0, self%layout%tilting)
      state = [((self%layout%before(i) + at_tilt_rate, j=1, size(velocity)), i=1, pads)]
      value = [(velocity/self%bearing%pads(i)%ball_radius, i=1, pads)]
   end subroutine switching_points

   !> The unbalance turns; at constant speed.
   pure function df_dt(self, t)
      class(bearing_model), intent(in) :: self
      real(wp), intent(in) :: t
      real(wp) :: df_dt(self%n)
      df_dt = 0
      df_dt(:self%rotor%states) = self%rotor%rates(df_dt(:self%rotor%states), self%rotor%turn(self%point, t))
   end function df_dt

   !> What is sampled at (t, y), where these outputs are known; no film is evaluated. The record may be used again.
   pure subroutine take_sample(self, t, y, output, sample)
      class(bearing_model), intent(in) :: self
      real(wp), intent(in) :: t, y(:), output(:)
      type(model_sample), intent(inout) :: sample
      sample%tilting = self%layout%tilting
      sample%radial = self%layout%radial
      sample%bristles = self%layout%bristles
      sample%asperities = self%bearing%asperities%act()
      sample%time = t
      sample%shaft_angle = self%point%shaft_angle(t)
      sample%speed = self%point%speed(t)
      sample%journal = self%rotor%journal(y(:self%rotor%states))
      if (.not. allocated(sample%states)) allocate (sample%states(self%layout%pads), sample%loads(self%layout%pads))
      sample%states(:) = self%layout%pad_states(y)
      call self%bearing%take_samples(sample%journal, sample%states, sample%speed, output, sample%loads)
   end subroutine take_sample
end module equations_of_motion
