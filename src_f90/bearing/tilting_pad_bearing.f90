!> A bearing of tilting pads: the motion of the journal, the states of the pads, their oil and the speed go in, the
!> loads of every pad and their derivatives come out. One evaluation of the film solver serves all pads.
module tilting_pad_bearing
   use kinds, only: wp, i8
   use clock, only: wall_clock
   use text, only: to_text
   use case_inputs, only: case_type
   use film_solver, only: film_solver_type, film_motion, film_oil, film_response, film_not_converged
   use asperity_contact, only: asperity_contact_type, asperity_load
   use friction, only: friction_law
   use abstract_rotor, only: journal_motion
   use kinematics, only: pad_state, pad_frame, frame_of, motion_of, columns
   use tilting_pad, only: tilting_pad_type, pad_loads, pad_derivatives
   use factories, only: make_film, new_asperities, new_pads, march_films, static_films, of_march
   use pad_pivots, only: pad_pivot, make_contacts, make_frictions
   implicit none (type, external)
   private
   public :: tilting_pad_bearing_type, pad_sample, new_tilting_pad_bearing, pad_outputs

   !> Outputs of a pad: film force on the journal in its frame, N, maximum pressure, Pa.
   integer, parameter :: pad_outputs = 3

   !> What is sampled of a pad beside its state.
   type :: pad_sample
      !> N; N m; film force on the journal in the pad frame, N.
      real(wp) :: pivot_load = 0, friction_moment = 0, film_force(2) = 0
      !> m; Pa.
      real(wp) :: min_film_thickness = 0, max_pressure = 0
      !> Normal force between the asperities of pad and journal, N.
      real(wp) :: asperity_force = 0
   end type pad_sample

   type :: tilting_pad_bearing_type
      type(tilting_pad_type), allocatable :: pads(:)
      type(pad_pivot), allocatable :: pivots(:)
      !> Of each pad rates of tilt rate and pivot deflection rate per moment and force, (2, 2, pad).
      real(wp), allocatable :: per_mass(:, :, :)
      type(asperity_contact_type) :: asperities
      class(film_solver_type), allocatable :: film
      !> The loads of each pad in the state evaluated last; their derivatives where they were taken last.
      type(pad_loads), allocatable :: loads(:)
      type(pad_derivatives), allocatable :: derivatives(:)
      !> Contact of each pad with the journal in the state evaluated last.
      type(asperity_load), allocatable :: asperity(:)
      !> False: the pivots slide freely, whatever the law.
      logical :: rubs = .true.
      !> Bearing clearance, m.
      real(wp) :: clearance = 0
      !> What its films are for (factories).
      integer :: accuracy = march_films
      !> Of the state evaluated last: speed, rad/s, and oil of the pads; frames and motions.
      real(wp), private :: speed = 0
      type(film_oil), allocatable, private :: oil(:)
      type(pad_frame), allocatable, private :: frame(:)
      type(film_motion), allocatable, private :: motion(:)
      !> Motions at which the films are taken: those of the journal, but where it touches a pad.
      type(film_motion), allocatable, private :: film_motion(:)
      type(film_response), allocatable, private :: response(:)
      integer(i8), private :: evaluations = 0
   contains
      procedure :: adopt
      procedure :: evaluate
      procedure :: output
      procedure :: sampled
      procedure :: take_samples
      procedure :: pressure_field
      procedure :: warning
      procedure :: smooth
      procedure :: films_converge
      procedure :: use_in_statics
      procedure, private :: set_parts
      procedure, private :: evaluate_films
      procedure, private :: set_loads
   end type tilting_pad_bearing_type

   !> One of this number of film evaluations is timed.
   integer(i8), parameter :: timing_stride = 16
   !> Film thickness over bearing clearance below which a failed march is put down to it.
   real(wp), parameter :: nearly_closed = 1e-2_wp
   type(friction_law), parameter :: no_friction = friction_law()

contains

   !> Bearing b of a valid case with films for a march or, as factories has it, for something else.
   function new_tilting_pad_bearing(inputs, b, accuracy) result(bearing)
      type(case_type), intent(in) :: inputs
      integer, intent(in) :: b
      integer, intent(in), optional :: accuracy
      type(tilting_pad_bearing_type) :: bearing
      associate (given => inputs%bearings(b), n => inputs%bearings(b)%pad_count())
         allocate (bearing%pivots(n))
         call bearing%set_parts(inputs, b)
         if (present(accuracy)) bearing%accuracy = accuracy
         call make_film(given, inputs%integration%relative_tolerance, bearing%accuracy, bearing%film)
         call make_contacts(given%pivot, inputs%moves(), bearing%pivots)
         allocate (bearing%loads(n), bearing%derivatives(n), bearing%frame(n), bearing%motion(n), &
            & bearing%asperity(n), bearing%film_motion(n), bearing%oil(n), bearing%response(n))
      end associate
   end function new_tilting_pad_bearing

   !> Makes the parts that take no time to make those of bearing b of a case.
   subroutine set_parts(self, inputs, b)
      class(tilting_pad_bearing_type), intent(inout) :: self
      type(case_type), intent(in) :: inputs
      integer, intent(in) :: b
      integer :: i
      associate (given => inputs%bearings(b))
         self%pads = new_pads(given, inputs%sense(), inputs%rotor%gravity)
         self%per_mass = reshape([(self%pads(i)%inverse_masses(), i=1, size(self%pads))], [2, 2, size(self%pads)])
         self%clearance = given%clearance()
         call make_frictions(given%friction, self%pivots)
         self%asperities = new_asperities(given%asperity, inputs%highest_speed()*given%journal_radius)
      end associate
   end subroutine set_parts

   !> Makes the bearing that of another case, with the same pads but for numbers. Films and contact, which take time to
   !> make, stay where they are the same; `anew`, what was solved last is forgotten.
   subroutine adopt(self, inputs, b, pivots_differ, anew)
      class(tilting_pad_bearing_type), intent(inout) :: self
      type(case_type), intent(in) :: inputs
      integer, intent(in) :: b
      logical, intent(in) :: pivots_differ, anew
      type(tilting_pad_type) :: before(size(self%pads))
      before = self%pads
      call self%set_parts(inputs, b)
      if (anew) call self%film%forget()
      if (any(before%gap%differs(self%pads%gap))) call make_films_anew(self, inputs, b)
      if (pivots_differ) call make_contacts(inputs%bearings(b)%pivot, inputs%moves(), self%pivots)
   end subroutine adopt

   !> Has films of a march solved where they are asked for, closely, from here on.
   subroutine use_in_statics(self, inputs, b)
      class(tilting_pad_bearing_type), intent(inout) :: self
      type(case_type), intent(in) :: inputs
      integer, intent(in) :: b
      if (.not. of_march(self%accuracy)) return
      self%accuracy = static_films
      call make_films_anew(self, inputs, b)
   end subroutine use_in_statics

   !> Another film solver that goes on in the place of the present one.
   subroutine make_films_anew(self, inputs, b)
      class(tilting_pad_bearing_type), intent(inout) :: self
      type(case_type), intent(in) :: inputs
      integer, intent(in) :: b
      class(film_solver_type), allocatable :: film
      call make_film(inputs%bearings(b), inputs%integration%relative_tolerance, self%accuracy, film)
      film%counters = self%film%counters
      call film%set_cavitation(self%film%cavitates())
      call move_alloc(film, self%film)
   end subroutine make_films_anew

   !> Sets the loads in a state, with the oil of each pad, the speed in rad/s, and their derivatives where they are
   !> wanted. Refuses a state whose film is closed or did not converge, or whose pad has turned over: then `refusal`
   !> says why. Loads of pads that are not chosen stay what they are.
   subroutine evaluate(self, journal, pads, oil, speed, want_derivatives, refusal, ok, chosen)
      class(tilting_pad_bearing_type), intent(inout) :: self
      type(journal_motion), intent(in) :: journal
      type(pad_state), intent(in) :: pads(:)
      type(film_oil), intent(in) :: oil(:)
      real(wp), intent(in) :: speed
      logical, intent(in) :: want_derivatives
      character(len=:), allocatable, intent(inout) :: refusal
      logical, intent(out) :: ok
      !> Left out: all.
      logical, intent(in), optional :: chosen(:)
      logical :: skipped(size(pads))
      integer :: i
      skipped = .false.
      if (present(chosen)) skipped = .not. chosen
      do i = 1, size(self%pads)
         if (skipped(i)) cycle
         self%frame(i) = frame_of(self%pads(i)%position, journal, pads(i))
         self%motion(i) = motion_of(self%pads(i)%position, self%frame(i), journal, pads(i))
         call self%asperities%evaluate(self%pads(i)%gap, self%pads(i)%directions, self%motion(i), speed, &
            & self%asperity(i))
         self%film_motion(i) = self%motion(i)
         if (self%asperity(i)%touches) self%film_motion(i)%position = self%asperity(i)%film_position
      end do
      call self%evaluate_films(oil, speed, want_derivatives, chosen)
      do i = 1, size(self%pads)
         if (skipped(i)) cycle
         ok = self%pads(i)%admitted(pads(i), self%response(i))
         if (ok) cycle
         refusal = self%pads(i)%why_not(i, pads(i), self%response(i))
         return
      end do
      do i = 1, size(self%pads)
         if (skipped(i)) cycle
         call self%set_loads(i, self%frame(i), pads(i), self%response(i)%force, self%asperity(i), self%loads(i))
         if (want_derivatives) call self%pads(i)%derivatives(self%frame(i), self%motion(i), pads(i), self%response(i), &
            & self%asperity(i), self%loads(i), self%derivatives(i))
      end do
   end subroutine evaluate

   !> The films at the motions set; some evaluations are timed, for all.
   subroutine evaluate_films(self, oil, speed, want_derivatives, chosen)
      class(tilting_pad_bearing_type), intent(inout) :: self
      type(film_oil), intent(in) :: oil(:)
      real(wp), intent(in) :: speed
      logical, intent(in) :: want_derivatives
      logical, intent(in), optional :: chosen(:)
      real(wp) :: started
      logical :: timed
      integer :: i
      self%speed = speed
      self%oil(:) = oil
      timed = mod(self%evaluations, timing_stride) == 0
      ! tables are built now and then: their time must not count for evaluations without
      if (timed) started = wall_clock() - self%film%counters%building
      call self%film%evaluate(self%film_motion, oil, speed, want_derivatives, self%response, chosen)
      if (timed) self%film%counters%seconds = self%film%counters%seconds &
         & + timing_stride*(wall_clock() - self%film%counters%building - started)
      self%evaluations = self%evaluations + 1
      do i = 1, size(self%pads)
         associate (film => self%response(i), asperity => self%asperity(i))
            if (.not. asperity%touches) cycle
            if (present(chosen)) then
               if (.not. chosen(i)) cycle
            end if
            film%min_film_thickness = asperity%thickness
            if (want_derivatives) film%derivatives(:, 1:2) = matmul(film%derivatives(:, 1:2), asperity%film_slopes)
         end associate
      end do
   end subroutine evaluate_films

   !> The loads of a pad with a film force in its frame, N, and what the asperities bear.
   pure subroutine set_loads(self, pad, frame, state, film_force, asperity, loads)
      class(tilting_pad_bearing_type), intent(in) :: self
      integer, intent(in) :: pad
      type(pad_frame), intent(in) :: frame
      type(pad_state), intent(in) :: state
      real(wp), intent(in) :: film_force(2)
      type(asperity_load), intent(in) :: asperity
      type(pad_loads), intent(inout) :: loads
      if (self%rubs) then
         call self%pads(pad)%loads(frame, state, film_force, asperity, self%pivots(pad)%contact, &
            & self%pivots(pad)%friction, loads)
      else
         call self%pads(pad)%loads(frame, state, film_force, asperity, self%pivots(pad)%contact, no_friction, loads)
      end if
   end subroutine set_loads

   !> What a sample takes from the films, pad by pad: force and maximum pressure as evaluated last, the force with what
   !> a change of the state, (column, pad), adds to first order.
   function output(self, change)
      class(tilting_pad_bearing_type), intent(inout) :: self
      real(wp), intent(in) :: change(:, :)
      real(wp) :: output(pad_outputs*size(self%pads))
      real(wp) :: added(2)
      integer :: i, k
      call self%film%take_pressures(self%film_motion, self%oil, self%speed, self%response)
      do i = 1, size(self%pads)
         associate (film => self%response(i), derivatives => self%derivatives(i)%film)
            added = 0
            do k = 1, columns
               added = added + derivatives(:, k)*change(k, i)
            end do
            output(pad_outputs*(i - 1) + 1:pad_outputs*i) = [film%force + added, film%max_pressure]
         end associate
      end do
   end function output

   !> The samples of all pads in a state whose outputs are known: without the film solver.
   pure subroutine take_samples(self, journal, pads, speed, output, samples)
      class(tilting_pad_bearing_type), intent(in) :: self
      type(journal_motion), intent(in) :: journal
      type(pad_state), intent(in) :: pads(:)
      !> rad/s.
      real(wp), intent(in) :: speed
      real(wp), intent(in) :: output(:)
      type(pad_sample), intent(inout) :: samples(:)
      type(pad_frame) :: frame
      type(asperity_load) :: asperity
      type(pad_loads) :: loads
      integer :: i
      do i = 1, size(pads)
         frame = frame_of(self%pads(i)%position, journal, pads(i))
         associate (film => output(pad_outputs*(i - 1) + 1:pad_outputs*i), pad => self%pads(i), gap => self%pads(i)%gap)
            call self%asperities%evaluate(gap, pad%directions, motion_of(pad%position, frame, journal, pads(i)), &
               & speed, asperity)
            call self%set_loads(i, frame, pads(i), film(1:2), asperity, loads)
            ! between steps at which it leaps a polynomial may undershoot
            samples(i) = pad_sample(loads%contact, pad%ball_radius*loads%friction%force, film(1:2), &
               & asperity%thickness, max(film(3), gap%supply_pressure, gap%ambient_pressure), asperity%carried())
         end associate
      end do
   end subroutine take_samples

   !> The samples of all pads in the state evaluated last.
   function sampled(self)
      class(tilting_pad_bearing_type), intent(inout) :: self
      type(pad_sample) :: sampled(size(self%pads))
      integer :: i
      call self%film%take_pressures(self%film_motion, self%oil, self%speed, self%response)
      do i = 1, size(self%pads)
         associate (film => self%response(i), loads => self%loads(i))
            sampled(i) = pad_sample(loads%contact, self%pads(i)%ball_radius*loads%friction%force, film%force, &
               & film%min_film_thickness, film%max_pressure, self%asperity(i)%carried())
         end associate
      end do
   end function sampled

   !> Pressure of every film in the state evaluated last, Pa, (axial position, angle, pad), at angles from the pivot,
   !> rad, (angle, pad), and distances from the middle plane, m, (axial position, pad).
   subroutine pressure_field(self, phi, z, pressure)
      class(tilting_pad_bearing_type), intent(inout) :: self
      real(wp), intent(in) :: phi(:, :), z(:, :)
      real(wp), intent(out) :: pressure(:, :, :)
      call self%film%field(self%film_motion, self%oil, self%speed, phi, z, pressure)
   end subroutine pressure_field

   !> Names the pad whose film was nearly closed in the state evaluated last, if there is one; else empty.
   function warning(self)
      class(tilting_pad_bearing_type), intent(in) :: self
      character(len=:), allocatable :: warning
      integer :: i
      warning = ''
      i = minloc(self%response%min_film_thickness, dim=1)
      associate (thickness => self%response(i)%min_film_thickness)
         if (thickness < nearly_closed*self%clearance) warning = 'the film of pad '//to_text(i) &
            & //' is closing: thickness '//to_text(thickness)//' m'
      end associate
   end function warning

   !> True where no friction puts switching points into the motion.
   pure logical function smooth(self)
      class(tilting_pad_bearing_type), intent(in) :: self
      smooth = .not. self%rubs .or. same_type_as(self%pivots(1)%friction, no_friction)
   end function smooth

   !> False where a film of the state evaluated last, solved by iteration, did not converge.
   pure logical function films_converge(self)
      class(tilting_pad_bearing_type), intent(in) :: self
      films_converge = all(self%response%status /= film_not_converged)
   end function films_converge
end module tilting_pad_bearing
