!> Forces on journal and pads in a state of the bearing: film, contact, friction.
!>
!> State: y, z, vy, vz of the journal; then for each pad tilt, tilt rate, (tilting-radial) penetration
!> and its rate, (LuGre) bristle deflection. A state that the scene lacks is not there.
module bearing_forces
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp, i8, degree
   use text, only: to_text
   use ode_model, only: ode_model_type
   use scene, only: scene_type
   use film_solver, only: film_solver_type, film_motion, film_response, film_closed, film_not_converged
   use contact_table, only: contact_table_type, new_contact_table
   use friction, only: friction_law, friction_response
   use kinematics, only: pad_place, pad_frame, frame_of, motion_of
   use pad_film, only: pad_film_type, pad_directions
   use components, only: make_film, new_gaps, new_law, new_friction, new_places
   implicit none (type, external)
   private
   public :: bearing_forces_type, pad_loads, init_forces, pad_outputs

   !> Forces on one pad at one instant.
   type :: pad_loads
      !> Contact force F_bs, N, and its slope over the penetration, N/m (0 tilting-only).
      real(wp) :: contact = 0, contact_slope = 0
      !> Friction of the pivot.
      type(friction_response) :: friction
      !> Moment of eq (3), N m, and force of eq (4), N, on the pad.
      real(wp) :: moment = 0, radial = 0
   end type pad_loads

   type, extends(ode_model_type), abstract :: bearing_forces_type
      type(scene_type) :: scene
      !> States of a pad.
      integer :: states_per_pad
      logical :: radial
      type(pad_place), allocatable :: places(:)
      type(pad_film_type), allocatable :: gaps(:)
      type(pad_directions), allocatable :: directions(:)
      class(film_solver_type), allocatable :: film
      type(contact_table_type) :: contact
      class(friction_law), allocatable :: friction
      !> Ball radius R1, m; unbalance, kg m.
      real(wp) :: ball_radius, unbalance
      !> The last evaluation, pad by pad.
      type(pad_frame), allocatable :: frame(:)
      type(film_motion), allocatable :: motion(:)
      type(film_response), allocatable :: response(:)
      type(pad_loads), allocatable :: loads(:)
      !> Wall time in the film solver, s: every `timing_stride`-th evaluation is timed.
      real(wp) :: film_seconds = 0
      integer(i8) :: evaluations = 0
   contains
      procedure :: warning
      !> Sets frame, motion, response and loads at (t, y); film slopes on request.
      procedure :: evaluate
      !> The same, but slopes, in a state y whose outputs are known: without the film solver.
      procedure :: recall
      procedure, private :: place
      procedure, private :: pad_forces
      procedure, private :: refuse_film
      !> Index before the first state of a pad; index of its bristle.
      procedure :: offset
      procedure :: bristle
   end type bearing_forces_type

   integer(i8), parameter :: timing_stride = 16
   !> Film thickness over assembled clearance below which a failed march is put down to it.
   real(wp), parameter :: nearly_closed = 1e-2_wp
   !> Outputs of a pad: force on the journal in its frame, highest pressure.
   integer, parameter :: pad_outputs = 3

contains

   !> Builds the parts of a valid scene; the contact's table, the dearest of them, where it is not given.
   subroutine init_forces(model, scene, contact)
      class(bearing_forces_type), intent(inout) :: model
      type(scene_type), intent(in) :: scene
      type(contact_table_type), intent(in), optional :: contact
      integer :: i, n
      n = scene%pad_count()
      model%scene = scene
      model%radial = scene%tilting_radial()
      model%friction = new_friction(scene)
      model%states_per_pad = merge(4, 2, model%radial) + merge(1, 0, model%friction%has_bristle)
      model%n = 4 + n*model%states_per_pad
      model%places = new_places(scene)
      model%gaps = new_gaps(scene)
      allocate (model%directions(n))
      do i = 1, n
         model%directions(i) = model%gaps(i)%directions()
      end do
      call make_film(scene, model%film)
      if (present(contact)) then
         model%contact = contact
      else if (model%radial) then
         model%contact = new_contact_table(new_law(scene))
      end if
      model%ball_radius = scene%pivot%socket_radius - scene%pivot%radius_difference
      model%unbalance = scene%unbalance()
      model%outputs = pad_outputs*n
      allocate (model%frame(n), model%motion(n), model%response(n), model%loads(n))
   end subroutine init_forces

   pure integer function offset(self, pad)
      class(bearing_forces_type), intent(in) :: self
      integer, intent(in) :: pad
      offset = 4 + (pad - 1)*self%states_per_pad
   end function offset

   pure integer function bristle(self, pad)
      class(bearing_forces_type), intent(in) :: self
      integer, intent(in) :: pad
      bristle = 4 + pad*self%states_per_pad
   end function bristle

   subroutine evaluate(self, t, y, want_slopes, ok)
      class(bearing_forces_type), intent(inout) :: self
      real(wp), intent(in) :: t, y(:)
      logical, intent(in) :: want_slopes
      logical, intent(out) :: ok
      integer(i8) :: start, finish, rate
      integer :: i

      call self%place(y)
      if (mod(self%evaluations, timing_stride) == 0) then
         call system_clock(start, rate)
         call self%film%evaluate(self%motion, self%scene%speed(t), want_slopes, self%response)
         call system_clock(finish)
         self%film_seconds = self%film_seconds + real(timing_stride*(finish - start), wp)/real(rate, wp)
      else
         call self%film%evaluate(self%motion, self%scene%speed(t), want_slopes, self%response)
      end if
      self%evaluations = self%evaluations + 1
      call self%refuse_film(y, ok)
      if (.not. ok) return
      do i = 1, size(self%places)
         call self%pad_forces(i, y)
      end do
   end subroutine evaluate

   !> Sets frame and motion.
   subroutine place(self, y)
      class(bearing_forces_type), intent(inout) :: self
      real(wp), intent(in) :: y(:)
      real(wp) :: penetration, penetration_rate
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
   end subroutine place

   subroutine recall(self, y, output)
      class(bearing_forces_type), intent(inout) :: self
      real(wp), intent(in) :: y(:), output(:)
      integer :: i
      call self%place(y)
      do i = 1, size(self%places)
         associate (film => output(pad_outputs*(i - 1) + 1:pad_outputs*i))
            self%response(i)%force = film(1:2)
            self%response(i)%min_film = self%gaps(i)%least_thickness(self%motion(i), self%directions(i))
            ! between steps at which it leaps a polynomial may undershoot
            self%response(i)%max_pressure = max(film(3), self%gaps(i)%supply_pressure, self%gaps(i)%ambient_pressure)
         end associate
         call self%pad_forces(i, y)
      end do
   end subroutine recall

   !> Refuses a state whose film is closed, did not converge, or whose pad has turned over.
   subroutine refuse_film(self, y, ok)
      class(bearing_forces_type), intent(inout) :: self
      real(wp), intent(in) :: y(:)
      logical, intent(out) :: ok
      integer :: i, offset
      ok = .true.
      do i = 1, size(self%places)
         offset = self%offset(i)
         associate (film => self%response(i), tilt => y(offset + 1))
            if (.not. abs(tilt) < 0.5_wp*self%scene%pads%arc_deg(i)*degree) then
               self%refusal = 'pad '//to_text(i)//' turned over: tilt '//to_text(tilt)//' rad'
            else if (film%status == film_closed) then
               self%refusal = 'the film of pad '//to_text(i)//' closed: thickness '//to_text(film%min_film)//' m'
            else if (film%status == film_not_converged) then
               self%refusal = 'the film of pad '//to_text(i)//' did not converge: residual ' &
                  & //to_text(film%residual)//' after film%max_sweeps = '//to_text(self%scene%film%max_sweeps)
            else if (.not. all(ieee_is_finite(film%force))) then
               self%refusal = 'the film force of pad '//to_text(i)//' is not finite: thickness ' &
                  & //to_text(film%min_film)//' m'
            else
               cycle
            end if
            ok = .false.
            return
         end associate
      end do
   end subroutine refuse_film

   !> Names the pad whose film is nearly closed, if there is one.
   function warning(self)
      class(bearing_forces_type), intent(in) :: self
      character(len=:), allocatable :: warning
      integer :: i
      warning = ''
      i = minloc(self%response%min_film, dim=1)
      associate (film => self%response(i)%min_film)
         if (film < nearly_closed*self%scene%bearing%assembled_clearance) then
            warning = 'the film of pad '//to_text(i)//' is closing: thickness '//to_text(film)//' m'
         end if
      end associate
   end function warning

   !> Contact, friction, and the right-hand sides of (3) and (4) for one pad.
   subroutine pad_forces(self, i, y)
      class(bearing_forces_type), intent(inout) :: self
      integer, intent(in) :: i
      real(wp), intent(in) :: y(:)
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
         call self%friction%evaluate(self%ball_radius*rate, deflection, loads%contact, loads%friction)
         loads%moment = -force(1)*self%places(i)%centre_distance - self%ball_radius*loads%friction%force &
            & - weight*(pads%centre_tangential(i)*frame%s - pads%centre_radial(i)*frame%c)
      end associate
   end subroutine pad_forces

end module bearing_forces
