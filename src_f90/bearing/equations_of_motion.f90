!> Equations of motion (1)-(4) of journal and pads, with film, contact and friction, as an ODE.
!>
!> State: y, z, vy, vz of the journal; then for each pad tilt, tilt rate, (tilting-radial) penetration
!> and its rate, (LuGre) bristle deflection. A state that the scene lacks is not there.
module equations_of_motion
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp, i8, degree
   use text, only: to_text
   use ode_model, only: ode_model_type
   use scene, only: scene_type
   use film_solver, only: film_solver_type, film_motion, film_response, film_closed, film_not_converged
   use contact_law, only: contact_law_type
   use contact_table, only: contact_table_type, new_contact_table
   use friction, only: friction_law, friction_response
   use kinematics, only: pad_place, pad_frame, frame_of, motion_of, motion_slopes, to_global
   use components, only: new_film, new_law, new_friction, new_places
   implicit none (type, external)
   private
   public :: bearing_model, new_bearing_model, pad_loads

   !> Forces on one pad at one instant.
   type :: pad_loads
      !> Contact force F_bs, N, and its slope over the penetration, N/m (0 tilting-only).
      real(wp) :: contact = 0, contact_slope = 0
      !> Friction of the pivot.
      type(friction_response) :: friction
      !> Moment of eq (3), N m, and force of eq (4), N, on the pad.
      real(wp) :: moment = 0, radial = 0
   end type pad_loads

   type, extends(ode_model_type) :: bearing_model
      type(scene_type) :: scene
      !> States of a pad, and of all.
      integer :: states_per_pad, n
      logical :: radial
      type(pad_place), allocatable :: places(:)
      class(film_solver_type), allocatable :: film
      type(contact_table_type) :: contact
      class(friction_law), allocatable :: friction
      !> Ball radius R1, m; unbalance, kg m.
      real(wp) :: ball_radius, unbalance
      !> Natural size of each state.
      real(wp), allocatable :: scale(:)
      !> The last evaluation, pad by pad.
      type(pad_frame), allocatable :: frame(:)
      type(film_motion), allocatable :: motion(:)
      type(film_response), allocatable :: response(:)
      type(pad_loads), allocatable :: loads(:)
      !> Wall time in the film solver, s: every `timing_stride`-th evaluation is timed.
      real(wp) :: film_seconds = 0
      integer(i8) :: evaluations = 0
   contains
      procedure :: rhs
      procedure :: jacobian
      procedure :: condition
      !> Sets frame, motion, response and loads at (t, y).
      procedure :: evaluate
      procedure, private :: pad_forces
      procedure, private :: film_trouble
      !> Index before the first state of a pad; index of its bristle.
      procedure :: offset
      procedure :: bristle
      !> The state with journal and pads at rest at given places, bristles undeflected.
      procedure :: at_rest
      !> Journal y, z and the tilts, each over its scale.
      procedure :: positions
   end type bearing_model

   integer(i8), parameter :: timing_stride = 16
   !> Scale of the tilt rate over that at which Bengisu-Akay friction changes its direction.
   real(wp), parameter :: sticking_scale = 10
   !> Film thickness over assembled clearance below which a failed march is put down to it.
   real(wp), parameter :: nearly_closed = 1e-2_wp

contains

   !> The model of a valid scene.
   function new_bearing_model(scene) result(model)
      type(scene_type), intent(in) :: scene
      type(bearing_model) :: model
      integer :: n
      n = scene%pad_count()
      model%scene = scene
      model%radial = scene%tilting_radial()
      model%friction = new_friction(scene)
      model%states_per_pad = merge(4, 2, model%radial) + merge(1, 0, model%friction%has_bristle)
      model%n = 4 + n*model%states_per_pad
      model%places = new_places(scene)
      model%film = new_film(scene)
      if (model%radial) model%contact = new_contact_table(new_law(scene))
      model%ball_radius = scene%pivot%socket_radius - scene%pivot%radius_difference
      model%unbalance = scene%unbalance()
      allocate (model%frame(n), model%motion(n), model%response(n), model%loads(n))
      model%scale = state_scales(model)
   end function new_bearing_model

   !> Natural size of each state: clearance; clearance over pad length; the penetration under the load;
   !> the deflection at which bristles yield; rates: times the highest speed, but the tilt rate not above
   !> ten times that at which friction changes its direction, or its moment would be no better than 1e-2.
   function state_scales(model) result(scale)
      type(bearing_model), intent(in) :: model
      real(wp) :: scale(model%n)
      class(contact_law_type), allocatable :: law
      real(wp) :: speed, force
      integer :: i, o
      associate (scene => model%scene, b => model%scene%bearing)
         speed = scene%highest_speed()
         scale(1:2) = b%assembled_clearance
         scale(3:4) = b%assembled_clearance*speed
         do i = 1, scene%pad_count()
            o = model%offset(i)
            scale(o + 1) = b%assembled_clearance/((b%journal_radius + b%machined_clearance) &
               & *scene%pads%arc_deg(i)*degree)
            scale(o + 2) = min(scale(o + 1)*speed, sticking_scale*model%friction%sticking_velocity()/model%ball_radius)
            if (model%radial) then
               law = new_law(scene)
               force = norm2(scene%load()) + model%unbalance*speed**2
               scale(o + 3) = 1e-3_wp*b%assembled_clearance
               if (force > 0) scale(o + 3) = max(scale(o + 3), law%penetration(force))
               scale(o + 4) = scale(o + 3)*speed
            end if
            if (model%friction%has_bristle) scale(model%bristle(i)) = &
               & model%friction%static_coefficient/scene%friction%bristle_stiffness
         end do
      end associate
   end function state_scales

   pure integer function offset(self, pad)
      class(bearing_model), intent(in) :: self
      integer, intent(in) :: pad
      offset = 4 + (pad - 1)*self%states_per_pad
   end function offset

   pure integer function bristle(self, pad)
      class(bearing_model), intent(in) :: self
      integer, intent(in) :: pad
      bristle = 4 + pad*self%states_per_pad
   end function bristle

   pure function at_rest(self, journal, tilt, penetration) result(y)
      class(bearing_model), intent(in) :: self
      real(wp), intent(in) :: journal(2), tilt(:), penetration(:)
      real(wp) :: y(self%n)
      integer :: i
      y = 0
      y(1:2) = journal
      do i = 1, size(tilt)
         y(self%offset(i) + 1) = tilt(i)
         if (self%radial) y(self%offset(i) + 3) = penetration(i)
      end do
   end function at_rest

   pure function positions(self, y)
      class(bearing_model), intent(in) :: self
      real(wp), intent(in) :: y(:)
      real(wp) :: positions(2 + size(self%places))
      integer :: i, at(2 + size(self%places))
      at = [1, 2, (self%offset(i) + 1, i=1, size(self%places))]
      positions = y(at)/self%scale(at)
   end function positions

   subroutine evaluate(self, t, y, want_slopes, ok)
      class(bearing_model), intent(inout) :: self
      real(wp), intent(in) :: t, y(:)
      logical, intent(in) :: want_slopes
      logical, intent(out) :: ok
      real(wp) :: penetration, penetration_rate
      integer(i8) :: start, finish, rate
      integer :: i, o

      penetration = 0
      penetration_rate = 0
      do i = 1, size(self%places)
         o = self%offset(i)
         if (self%radial) then
            penetration = y(o + 3)
            penetration_rate = y(o + 4)
         end if
         self%frame(i) = frame_of(self%places(i), y(1:2), y(o + 1), penetration)
         self%motion(i) = motion_of(self%places(i), self%frame(i), y(3:4), y(o + 2), penetration_rate)
      end do
      if (mod(self%evaluations, timing_stride) == 0) then
         call system_clock(start, rate)
         call self%film%evaluate(self%motion, self%scene%speed(t), want_slopes, self%response)
         call system_clock(finish)
         self%film_seconds = self%film_seconds + real(timing_stride*(finish - start), wp)/real(rate, wp)
      else
         call self%film%evaluate(self%motion, self%scene%speed(t), want_slopes, self%response)
      end if
      self%evaluations = self%evaluations + 1
      call self%film_trouble(y, ok)
      if (.not. ok) return
      do i = 1, size(self%places)
         call self%pad_forces(i, y, want_slopes)
      end do
   end subroutine evaluate

   !> Refuses a state whose film is closed, did not converge, or whose pad has turned over.
   subroutine film_trouble(self, y, ok)
      class(bearing_model), intent(inout) :: self
      real(wp), intent(in) :: y(:)
      logical, intent(out) :: ok
      integer :: i
      ok = .true.
      do i = 1, size(self%places)
         associate (film => self%response(i), tilt => y(self%offset(i) + 1))
            if (.not. abs(tilt) < 0.5_wp*self%scene%pads%arc_deg(i)*degree) then
               self%trouble = 'pad '//to_text(i)//' turned over: tilt '//to_text(tilt)//' rad'
            else if (film%status == film_closed) then
               self%trouble = 'the film of pad '//to_text(i)//' closed: thickness '//to_text(film%min_film)//' m'
            else if (film%status == film_not_converged) then
               self%trouble = 'the film of pad '//to_text(i)//' did not converge: residual ' &
                  & //to_text(film%residual)//' after film%max_sweeps = '//to_text(self%scene%film%max_sweeps)
            else if (.not. all(ieee_is_finite(film%force))) then
               self%trouble = 'the film force of pad '//to_text(i)//' is not finite: thickness ' &
                  & //to_text(film%min_film)//' m'
            else
               cycle
            end if
            ok = .false.
            return
         end associate
      end do
   end subroutine film_trouble

   !> Names the pad whose film is nearly closed, if there is one.
   function condition(self)
      class(bearing_model), intent(in) :: self
      character(len=:), allocatable :: condition
      integer :: i
      condition = ''
      i = minloc(self%response%min_film, dim=1)
      associate (film => self%response(i)%min_film)
         if (film < nearly_closed*self%scene%bearing%assembled_clearance) then
            condition = 'the film of pad '//to_text(i)//' is closing: thickness '//to_text(film)//' m'
         end if
      end associate
   end function condition

   !> Contact, friction, and the right-hand sides of (3) and (4) for one pad.
   subroutine pad_forces(self, i, y, want_slopes)
      class(bearing_model), intent(inout) :: self
      integer, intent(in) :: i
      real(wp), intent(in) :: y(:)
      logical, intent(in) :: want_slopes
      real(wp) :: deflection, inertial
      integer :: o
      o = self%offset(i)
      associate (loads => self%loads(i), frame => self%frame(i), force => self%response(i)%force, &
         & pads => self%scene%pads, weight => self%scene%pads%mass(i)*self%scene%rotor%gravity, rate => y(o + 2))
         inertial = pads%mass(i)*pads%centre_radial(i)*rate**2
         loads%radial = -force(2) - weight*frame%s + inertial
         if (self%radial) then
            call self%contact%lookup(y(o + 3), loads%contact, loads%contact_slope)
         else
            loads%contact = max(0.0_wp, loads%radial)
         end if
         loads%radial = loads%radial - loads%contact
         deflection = 0
         if (self%friction%has_bristle) deflection = y(self%bristle(i))
         call self%friction%evaluate(self%ball_radius*rate, deflection, loads%contact, want_slopes, loads%friction)
         loads%moment = -force(1)*self%places(i)%centre_distance - self%ball_radius*loads%friction%force &
            & - weight*(pads%centre_tangential(i)*frame%s - pads%centre_radial(i)*frame%c)
      end associate
   end subroutine pad_forces

   subroutine rhs(self, t, y, dydt, ok)
      class(bearing_model), intent(inout) :: self
      real(wp), intent(in) :: t, y(:)
      real(wp), intent(out) :: dydt(:)
      logical, intent(out) :: ok
      real(wp) :: force(2), phase, speed, direction(2)
      integer :: i, o
      call self%evaluate(t, y, .false., ok)
      if (.not. ok) return
      phase = self%scene%shaft_angle(t)
      speed = self%scene%speed(t)
      direction = [cos(phase), sin(phase)]
      force = self%scene%load() + self%unbalance*(speed**2*direction &
         & + self%scene%acceleration()*[direction(2), -direction(1)])
      do i = 1, size(self%places)
         o = self%offset(i)
         force = force + to_global(self%frame(i), self%response(i)%force)
         dydt(o + 1) = y(o + 2)
         call accelerate(self, i, self%loads(i)%moment, self%loads(i)%radial, dydt)
         if (self%radial) dydt(o + 3) = y(o + 4)
         if (self%friction%has_bristle) dydt(self%bristle(i)) = self%loads(i)%friction%rate
      end do
      dydt(1:2) = y(3:4)
      dydt(3:4) = force/self%scene%rotor%mass
   end subroutine rhs

   !> Solves the 2 x 2 mass matrix of (3)-(4), coupled where C_xi /= 0, for the rates of tilt rate and
   !> penetration rate, and puts them in their places of `column`.
   pure subroutine accelerate(self, i, moment, radial, column)
      type(bearing_model), intent(in) :: self
      integer, intent(in) :: i
      real(wp), intent(in) :: moment, radial
      real(wp), intent(inout) :: column(:)
      real(wp) :: coupling, determinant
      associate (mass => self%scene%pads%mass(i), inertia => self%scene%pads%inertia(i), o => self%offset(i))
         if (self%radial) then
            coupling = mass*self%scene%pads%centre_tangential(i)
            determinant = inertia*mass - coupling**2
            column(o + 2) = (mass*moment - coupling*radial)/determinant
            column(o + 4) = (inertia*radial - coupling*moment)/determinant
         else
            column(o + 2) = moment/inertia
         end if
      end associate
   end subroutine accelerate

   subroutine jacobian(self, t, y, matrix, ok)
      class(bearing_model), intent(inout) :: self
      real(wp), intent(in) :: t, y(:)
      real(wp), intent(out) :: matrix(:, :)
      logical, intent(out) :: ok
      integer :: i, k, o, locals, column
      !> Slopes over (journal y, z, vy, vz, tilt, tilt rate, penetration, its rate).
      real(wp) :: force(2, 8), contact(8), friction(8), moment(8), radial(8), global(2)

      call self%evaluate(t, y, .true., ok)
      if (.not. ok) return
      matrix = 0
      matrix(1, 3) = 1
      matrix(2, 4) = 1
      locals = merge(8, 6, self%radial)
      do i = 1, size(self%places)
         o = self%offset(i)
         associate (frame => self%frame(i), film => self%response(i), loads => self%loads(i), &
            & pads => self%scene%pads, weight => self%scene%pads%mass(i)*self%scene%rotor%gravity, rate => y(o + 2))
            force = matmul(film%slope, motion_slopes(self%places(i), frame, self%motion(i), rate))
            radial = -force(2, :)
            radial(5) = radial(5) + weight*frame%c
            radial(6) = radial(6) + 2*pads%mass(i)*pads%centre_radial(i)*rate
            if (self%radial) then
               contact = 0
               contact(7) = loads%contact_slope
            else
               contact = merge(radial, 0.0_wp, loads%contact > 0)
            end if
            radial = radial - contact
            friction = loads%friction%force_normal*contact
            friction(6) = friction(6) + loads%friction%force_velocity*self%ball_radius
            moment = -force(1, :)*self%places(i)%centre_distance - self%ball_radius*friction
            moment(5) = moment(5) + weight*(pads%centre_tangential(i)*frame%c + pads%centre_radial(i)*frame%s)

            do k = 1, locals
               column = merge(k, o + k - 4, k <= 4)
               global = to_global(frame, force(:, k))
               ! the frame turns with the pad
               if (k == 5) global = global + to_global(frame, [-film%force(2), film%force(1)])
               matrix(3:4, column) = matrix(3:4, column) + global/self%scene%rotor%mass
               call accelerate(self, i, moment(k), radial(k), matrix(:, column))
            end do
            matrix(o + 1, o + 2) = 1
            if (self%radial) matrix(o + 3, o + 4) = 1
            if (self%friction%has_bristle) then
               column = self%bristle(i)
               call accelerate(self, i, -self%ball_radius*loads%friction%force_deflection, 0.0_wp, matrix(:, column))
               matrix(column, o + 2) = loads%friction%rate_velocity*self%ball_radius
               matrix(column, column) = loads%friction%rate_deflection
            end if
         end associate
      end do
   end subroutine jacobian
end module equations_of_motion
