!> A bearing of tilting pads: the motion of the journal, the states of the pads, their oil and the speed go in, the
!> loads of every pad and their derivatives come out. One evaluation of the film solver serves all pads.
module tilting_pad_bearing
   use kinds, only: wp, i8, degree
   use clock, only: wall_clock
   use case_inputs, only: case_type
   use film_solver, only: film_solver_type, film_oil, film_law_type
   use turbulent_film, only: take_oil
   use asperity_contact, only: asperity_load
   use friction, only: no_friction
   use rigid_rotor, only: journal_motion
   use state_layout, only: pad_state, element_layout_type, new_element_layout, tilt, pivot_deflection, pitch, yaw, &
      & of_journal, most_coordinates
   use kinematics, only: pad_frame, frame_of, motion_of
   use tilting_pad, only: tilting_pad_type, pad_coordinates_type, new_pad_coordinates, pad_loads
   use factories, only: make_film, make_laws, law_changes, new_asperities, new_pads, static_films, of_march, &
      & make_contacts, make_friction
   use bearing_construction, only: constructed_bearing, pad_sample, sloped_sample, pad_outputs, sloped_outputs
   use sloped_bearing, only: make_sloped, sloped_films, take_sloped_pressures, sloped_loads, add_moments, &
      & find_inclined, add_late_sloped, find_turning_bristles, sloped_output, take_sloped_samples
   implicit none (type, external)
   private
   public :: tilting_pad_bearing_type, pad_sample, sloped_sample, new_tilting_pad_bearing

   type, extends(constructed_bearing) :: tilting_pad_bearing_type
   contains
      procedure :: adopt
      procedure :: laws_with
      procedure :: set_coordinates
      procedure :: set_cavitation
      procedure :: least_outputs
      procedure :: layout
      procedure :: evaluate
      procedure :: add_force
      procedure :: add_moment
      procedure :: part_derivatives
      procedure :: add_late
      procedure :: bristle_slopes
      procedure :: find_bristles
      procedure :: own_force
      procedure :: add_rates
      procedure :: scales
      procedure :: reference_force
      procedure :: switching_rates
      procedure :: is_smooth
      procedure :: output
      procedure :: sampled
      procedure :: take_samples
      procedure :: pressure_field
      procedure :: use_in_statics
   end type tilting_pad_bearing_type

   !> One of this number of film evaluations is timed.
   integer(i8), parameter :: timing_stride = 16
   !> Characteristic scale of the tilt rate over that at which Bengisu-Akay friction changes its direction: with a
   !> larger one the moment of friction would be no better than 1e-2.
   real(wp), parameter :: sticking_scale = 10
   !> Least load over the largest force of a film: preloaded films leave 1e-11 of their forces unbalanced, as a film is
   !> the small difference of large radii.
   real(wp), parameter :: least_load = 1e-2_wp

contains

   !> Bearing b of a valid case with films for a march or, as factories has it, for something else.
   function new_tilting_pad_bearing(inputs, b, accuracy) result(bearing)
      type(case_type), intent(in) :: inputs
      integer, intent(in) :: b
      integer, intent(in), optional :: accuracy
      type(tilting_pad_bearing_type) :: bearing
      associate (given => inputs%bearings(b), n => inputs%bearings(b)%pad_count())
         allocate (bearing%pivots(n))
         call set_parts(bearing, inputs, b)
         if (present(accuracy)) bearing%accuracy = accuracy
         call make_film(given, inputs%integration%relative_tolerance, bearing%accuracy, bearing%film, &
            & law_changes(inputs, given))
         call make_sloped(bearing, inputs, b, anew=.true.)
         call make_contacts(given%pivot, inputs%moves(), bearing%pivots)
         allocate (bearing%loads(n), bearing%derivatives(n), bearing%frame(n), bearing%motion(n), &
            & bearing%asperity(n), bearing%film_motion(n), bearing%response(n))
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
         self%clearance = given%clearance()
         self%density = given%oil%density
         call make_laws(given%film, size(self%pads), self%laws)
         if (.not. allocated(self%natural)) allocate (self%natural(size(self%pads)))
         do i = 1, size(self%pivots)
            call make_friction(given%friction, i, self%pivots(i)%friction)
            ! clearance over pad length for tilts, over half its width for pitch and yaw; a thousandth of the clearance
            ! for pivot deflections without load; the deflection at which bristles yield
            self%natural(i)%x = self%clearance
            self%natural(i)%x(tilt) = given%assembled_clearance(i)/((given%journal_radius &
               & + given%machined_clearance(i))*given%pads%arc_deg(i)*degree)
            self%natural(i)%x(pivot_deflection) = 1e-3_wp*given%assembled_clearance(i)
            self%natural(i)%x([pitch, yaw]) = given%assembled_clearance(i)/(0.5_wp*given%axial_length(i))
            self%natural(i)%bristle = self%pivots(i)%friction%static_coefficient/given%friction%bristle_stiffness
         end do
         self%asperities = new_asperities(given%asperity, inputs%highest_speed()*given%journal_radius)
         if (allocated(self%coordinates)) then
            call set_masses(self)
         else
            call self%set_coordinates(new_pad_coordinates(given%pads%motion))
         end if
      end associate
   end subroutine set_parts

   !> Gives its pads these coordinates.
   subroutine set_coordinates(self, coordinates)
      class(tilting_pad_bearing_type), intent(inout) :: self
      class(pad_coordinates_type), intent(in) :: coordinates
      ! an assignment of gfortran 12 would keep the room of another type
      if (allocated(self%coordinates)) deallocate (self%coordinates)
      allocate (self%coordinates, source=coordinates)
      call set_masses(self)
   end subroutine set_coordinates

   subroutine set_masses(self)
      class(tilting_pad_bearing_type), intent(inout) :: self
      integer :: i
      if (allocated(self%per_mass)) deallocate (self%per_mass)
      allocate (self%per_mass(most_coordinates, most_coordinates, size(self%pads)))
      do i = 1, size(self%pads)
         self%per_mass(:, :, i) = self%coordinates%per_mass(self%pads(i))
      end do
   end subroutine set_masses

   !> Lets its films cavitate as its case has them, or keeps them whole.
   subroutine set_cavitation(self, allowed)
      class(tilting_pad_bearing_type), intent(inout) :: self
      logical, intent(in) :: allowed
      call self%film%set_cavitation(allowed)
      if (allocated(self%sloped)) call self%sloped%film%set_cavitation(allowed)
   end subroutine set_cavitation

   !> Outputs of a pad that it has at least.
   pure integer function least_outputs(self)
      class(tilting_pad_bearing_type), intent(in) :: self
      least_outputs = merge(sloped_outputs, pad_outputs, allocated(self%sloped))
   end function least_outputs

   pure type(element_layout_type) function layout(self)
      class(tilting_pad_bearing_type), intent(in) :: self
      layout = new_element_layout(size(self%pads), self%coordinates%kind(:self%coordinates%n), &
         & self%pivots(1)%friction%has_bristle, self%coordinates%rotation(:self%coordinates%rotations))
   end function layout

   !> Makes the bearing that of another case, with the same pads but for numbers. Films and contact, which take time to
   !> make, stay where they are the same; `anew`, what was solved last is forgotten.
   subroutine adopt(self, inputs, b, pivots_differ, anew)
      class(tilting_pad_bearing_type), intent(inout) :: self
      type(case_type), intent(in) :: inputs
      integer, intent(in) :: b
      logical, intent(in) :: pivots_differ, anew
      type(tilting_pad_type) :: before(size(self%pads))
      before = self%pads
      call set_parts(self, inputs, b)
      if (anew) call self%film%forget()
      if (anew .and. allocated(self%sloped)) call self%sloped%film%forget()
      if (any(before%gap%differs(self%pads%gap))) then
         call make_films_anew(self, inputs, b)
      else
         call make_sloped(self, inputs, b, anew=.false.)
      end if
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

   !> The laws of its films with an oil of each pad, at a speed in rad/s.
   subroutine laws_with(self, oil, speed, laws)
      class(tilting_pad_bearing_type), intent(in) :: self
      type(film_oil), intent(in) :: oil(:)
      real(wp), intent(in) :: speed
      class(film_law_type), allocatable, intent(out) :: laws(:)
      allocate (laws, source=self%laws)
      call take_oil(laws, oil, self%pads%gap, self%density, speed*self%pads(1)%gap%journal_radius)
   end subroutine laws_with

   !> Another film solver that goes on in the place of the present one.
   subroutine make_films_anew(self, inputs, b)
      class(tilting_pad_bearing_type), intent(inout) :: self
      type(case_type), intent(in) :: inputs
      integer, intent(in) :: b
      class(film_solver_type), allocatable :: film
      call make_film(inputs%bearings(b), inputs%integration%relative_tolerance, self%accuracy, film, &
         & law_changes(inputs, inputs%bearings(b)))
      film%counters = self%film%counters
      call film%set_cavitation(self%film%cavitates())
      call move_alloc(film, self%film)
      call make_sloped(self, inputs, b, anew=.true.)
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
      real(wp) :: started
      integer :: i
      skipped = .false.
      if (present(chosen)) skipped = .not. chosen
      if (allocated(self%sloped)) then
         self%speed = speed
         call take_oil(self%laws, oil, self%pads%gap, self%density, speed*self%pads(1)%gap%journal_radius)
         started = wall_clock()
         call sloped_films(self, journal, pads, speed, want_derivatives, skipped)
         associate (counters => self%sloped%film%counters)
            counters%seconds = counters%seconds + wall_clock() - started
         end associate
      else
         do i = 1, size(self%pads)
            if (skipped(i)) cycle
            self%frame(i) = frame_of(self%pads(i)%position, journal, pads(i))
            self%motion(i) = motion_of(self%pads(i)%position, self%frame(i), journal, pads(i))
            call self%asperities%evaluate(self%pads(i)%gap, self%pads(i)%directions, self%motion(i), speed, &
               & self%asperity(i))
            self%film_motion(i) = self%motion(i)
            if (self%asperity(i)%touches) self%film_motion(i)%position = self%asperity(i)%film_position
         end do
         call evaluate_films(self, oil, speed, want_derivatives, chosen)
      end if
      ok = .true.
      do i = 1, size(self%pads)
         if (skipped(i)) cycle
         ok = self%pads(i)%admitted(pads(i), self%response(i))
         if (ok) cycle
         refusal = self%pads(i)%why_not(i, pads(i), self%response(i))
         return
      end do
      if (allocated(self%sloped)) then
         do i = 1, size(self%pads)
            if (.not. skipped(i)) call sloped_loads(self, i, journal, pads(i), want_derivatives)
         end do
         return
      end if
      do i = 1, size(self%pads)
         if (skipped(i)) cycle
         call set_loads(self, i, self%frame(i), pads(i), self%response(i)%force, self%asperity(i), self%loads(i))
         if (want_derivatives) call self%coordinates%derivatives(self%pads(i), self%frame(i), self%motion(i), pads(i), &
            & self%response(i), self%asperity(i), self%loads(i), self%derivatives(i))
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
      call take_oil(self%laws, oil, self%pads%gap, self%density, speed*self%pads(1)%gap%journal_radius)
      timed = mod(self%evaluations, timing_stride) == 0
      ! tables are built now and then: their time must not count for evaluations without
      if (timed) started = wall_clock() - self%film%counters%building
      call self%film%evaluate(self%film_motion, self%laws, speed, want_derivatives, self%response, chosen)
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
         call self%coordinates%loads(self%pads(pad), frame, state, film_force, asperity, self%pivots(pad)%contact, &
            & self%pivots(pad)%friction, loads)
      else
         call self%coordinates%loads(self%pads(pad), frame, state, film_force, asperity, self%pivots(pad)%contact, &
            & no_friction, loads)
      end if
   end subroutine set_loads

   !> Adds the loads of all pads.
   pure subroutine add_force(self, force)
      class(tilting_pad_bearing_type), intent(in) :: self
      real(wp), intent(inout) :: force(of_journal)
      integer :: i
      do i = 1, size(self%pads)
         force = force + self%loads(i)%journal
      end do
   end subroutine add_force

   pure subroutine add_moment(self, moment)
      class(tilting_pad_bearing_type), intent(in) :: self
      real(wp), intent(inout) :: moment(of_journal)
      call add_moments(self, moment)
   end subroutine add_moment

   !> Without friction.
   pure subroutine part_derivatives(self, part, m, accelerations, over_positions, over_rates)
      class(tilting_pad_bearing_type), intent(in) :: self
      integer, intent(in) :: part, m
      logical, intent(in) :: accelerations
      real(wp), intent(out) :: over_positions(m, m), over_rates(m, m)
      real(wp), dimension(most_coordinates) :: own, own_rates
      integer :: k
      if (self%of_rotor > of_journal) then
         call find_inclined(self, part, m, accelerations, over_positions, over_rates)
         return
      end if
      associate (of => self%derivatives(part))
         do k = 1, m
            over_positions(:, k) = of%over_positions(:m, k)
            over_rates(:, k) = of%over_rates(:m, k)
            if (.not. accelerations) cycle
            own = accelerations_of(self, part, of%over_positions(of_journal + 1:, k))
            own_rates = accelerations_of(self, part, of%over_rates(of_journal + 1:, k))
            over_positions(of_journal + 1:, k) = own(:m - of_journal)
            over_rates(of_journal + 1:, k) = own_rates(:m - of_journal)
         end do
      end associate
   end subroutine part_derivatives

   !> Accelerations along the coordinates of a pad by forces along them.
   pure function accelerations_of(self, pad, forces) result(accelerations)
      class(tilting_pad_bearing_type), intent(in) :: self
      integer, intent(in) :: pad
      real(wp), intent(in) :: forces(most_coordinates)
      real(wp) :: accelerations(most_coordinates)
      integer :: k
      accelerations = 0
      do k = most_coordinates, 1, -1
         accelerations = accelerations + self%per_mass(:, k, pad)*forces(k)
      end do
   end function accelerations_of

   !> Friction of the pivot.
   pure subroutine add_late(self, part, m, accelerations, over_positions, over_rates, over_bristle)
      class(tilting_pad_bearing_type), intent(in) :: self
      integer, intent(in) :: part, m
      logical, intent(in) :: accelerations
      real(wp), intent(inout) :: over_positions(m, m), over_rates(m, m)
      real(wp), intent(out) :: over_bristle(m - of_journal)
      real(wp) :: per_moment(most_coordinates)
      if (m == self%of_rotor .or. is_smooth(self)) then
         over_bristle = 0
         return
      end if
      if (self%coordinates%rotations > 1 .or. self%of_rotor > of_journal) then
         call add_late_sloped(self, part, m, accelerations, over_positions, over_rates, over_bristle)
         return
      end if
      per_moment = 0
      per_moment(tilt) = 1
      if (accelerations) per_moment = self%per_mass(:, tilt, part)
      call self%derivatives(part)%add_friction(self%pads(part), self%loads(part)%friction, m, &
         & per_moment(:m - of_journal), over_positions, over_rates, over_bristle)
   end subroutine add_late

   pure function bristle_slopes(self, part) result(slopes)
      class(tilting_pad_bearing_type), intent(in) :: self
      integer, intent(in) :: part
      real(wp) :: slopes(3)
      associate (friction => self%loads(part)%friction)
         slopes = [friction%rate_velocity, friction%rate_deflection, self%pads(part)%ball_radius]
      end associate
   end function bristle_slopes

   pure subroutine find_bristles(self, part, m, accelerations, over_bristle, of_rates, of_bristle)
      class(tilting_pad_bearing_type), intent(in) :: self
      integer, intent(in) :: part, m
      logical, intent(in) :: accelerations
      real(wp), intent(out) :: over_bristle(:, :), of_rates(:, :), of_bristle
      call find_turning_bristles(self, part, m, accelerations, over_bristle, of_rates, of_bristle)
   end subroutine find_bristles

   pure real(wp) function own_force(self, part, coordinate)
      class(tilting_pad_bearing_type), intent(in) :: self
      integer, intent(in) :: part, coordinate
      own_force = self%loads(part)%own(coordinate)
   end function own_force

   pure subroutine add_rates(self, layout, y, dydt)
      class(tilting_pad_bearing_type), intent(in) :: self
      type(element_layout_type), intent(in) :: layout
      real(wp), intent(in) :: y(:)
      real(wp), intent(inout) :: dydt(:)
      real(wp) :: accelerations(most_coordinates)
      integer :: i, k, o
      do i = 1, layout%pads
         o = layout%before(i)
         accelerations = accelerations_of(self, i, self%loads(i)%own)
         do k = 1, layout%coordinates
            dydt(o + 2*k - 1) = y(o + 2*k)
            dydt(o + 2*k) = accelerations(k)
         end do
         if (.not. layout%bristles) cycle
         if (layout%rotations > 1) then
            dydt(o + 2*layout%coordinates + 1:o + layout%per_pad) = self%sloped%friction(i)%rate(:layout%rotations)
         else
            dydt(o + layout%per_pad) = self%loads(i)%friction%rate
         end if
      end do
   end subroutine add_rates

   !> Rates: times the speed, but those of rotations not above ten times that at which friction changes its direction.
   pure function scales(self, parts, force, speed)
      class(tilting_pad_bearing_type), intent(in) :: self
      integer, intent(in) :: parts
      real(wp), intent(in) :: force, speed
      type(pad_state) :: scales(parts)
      integer :: i
      scales = self%natural
      do i = 1, parts
         if (force > 0) scales(i)%x(pivot_deflection) = max(scales(i)%x(pivot_deflection), &
            & self%pivots(i)%contact%law%pivot_deflection(force))
         scales(i)%v = scales(i)%x*speed
         associate (turns => self%coordinates%kind(self%coordinates%rotation(:self%coordinates%rotations)))
            scales(i)%v(turns) = min(scales(i)%v(turns), sticking_scale*self%pivots(i)%friction%sticking_velocity &
               & /self%pads(i)%ball_radius)
         end associate
      end do
   end function scales

   !> The heaviest pad, or the drag of a film as thick as the pad clearance; at least a share of the largest force of a
   !> film.
   pure real(wp) function reference_force(self, oil, speed)
      class(tilting_pad_bearing_type), intent(in) :: self
      type(film_oil), intent(in) :: oil(:)
      real(wp), intent(in) :: speed
      associate (gap => self%pads%gap)
         reference_force = max(maxval(self%pads%weight), maxval(oil%viscosity*speed*gap%journal_radius**2*gap%arc() &
            & *gap%axial_length/gap%machined_clearance), &
            & least_load*maxval(hypot(self%loads%journal(1), self%loads%journal(2))))
      end associate
   end function reference_force

   !> The tilt rates at which the pivot passes a switching point of its friction.
   pure function switching_rates(self, part) result(rates)
      class(tilting_pad_bearing_type), intent(in) :: self
      integer, intent(in) :: part
      real(wp), allocatable :: rates(:)
      allocate (rates(0))
      if (self%coordinates%n > 0) rates = self%pivots(part)%friction%switching_points()/self%pads(part)%ball_radius
   end function switching_rates

   !> What a sample takes from the films, pad by pad: force and maximum pressure as evaluated last, the force with
   !> what a correction of all states adds to first order.
   function output(self, layout, correction)
      class(tilting_pad_bearing_type), intent(inout) :: self
      type(element_layout_type), intent(in) :: layout
      real(wp), intent(in) :: correction(:)
      real(wp) :: output(self%outputs*size(self%pads))
      real(wp) :: added(2)
      integer :: i, k, o
      if (self%outputs > pad_outputs) output = 0
      if (allocated(self%sloped)) then
         call take_sloped_pressures(self)
         do i = 1, size(self%pads)
            output(self%outputs*(i - 1) + 1:self%outputs*i) = sloped_output(self, i, layout, correction)
         end do
         return
      end if
      call self%film%take_pressures(self%film_motion, self%laws, self%speed, self%response)
      do i = 1, size(self%pads)
         associate (film => self%response(i), over_positions => self%derivatives(i)%film_over_positions, &
            & over_rates => self%derivatives(i)%film_over_rates)
            added = 0
            do k = 1, of_journal
               added = added + over_positions(:, k)*correction(layout%journal(k)) &
                  & + over_rates(:, k)*correction(layout%journal_rates(k))
            end do
            o = layout%before(i)
            do k = 1, layout%coordinates
               added = added + over_positions(:, of_journal + k)*correction(o + 2*k - 1) &
                  & + over_rates(:, of_journal + k)*correction(o + 2*k)
            end do
            o = self%outputs*(i - 1)
            output(o + 1:o + pad_outputs) = [film%force + added, film%max_pressure]
         end associate
      end do
   end function output

   !> The samples of all pads in a state whose outputs are known: without the film solver.
   pure subroutine take_samples(self, journal, pads, speed, output, samples, slopes)
      class(tilting_pad_bearing_type), intent(in) :: self
      type(journal_motion), intent(in) :: journal
      type(pad_state), intent(in) :: pads(:)
      !> rad/s.
      real(wp), intent(in) :: speed
      real(wp), intent(in) :: output(:)
      type(pad_sample), intent(inout) :: samples(:)
      !> Only where slopes count.
      type(sloped_sample), intent(inout), optional :: slopes(:)
      type(pad_frame) :: frame
      type(asperity_load) :: asperity
      type(pad_loads) :: loads
      integer :: i, o
      if (allocated(self%sloped)) then
         do i = 1, size(pads)
            associate (film => output(self%outputs*(i - 1) + 1:self%outputs*i))
               call take_sloped_samples(self, i, journal, pads(i), speed, film, samples(i), slopes(i))
            end associate
         end do
         return
      end if
      do i = 1, size(pads)
         frame = frame_of(self%pads(i)%position, journal, pads(i))
         o = self%outputs*(i - 1)
         associate (film => output(o + 1:o + pad_outputs), pad => self%pads(i), gap => self%pads(i)%gap)
            call self%asperities%evaluate(gap, pad%directions, motion_of(pad%position, frame, journal, pads(i)), &
               & speed, asperity)
            call set_loads(self, i, frame, pads(i), film(1:2), asperity, loads)
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
      if (allocated(self%sloped)) then
         call take_sloped_pressures(self)
      else
         call self%film%take_pressures(self%film_motion, self%laws, self%speed, self%response)
      end if
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
      integer :: i
      if (allocated(self%sloped)) then
         do i = 1, size(self%pads)
            call self%sloped%film%field_of_pad(i, self%sloped%film_motion(i), self%laws(i), self%speed, phi(:, i), &
               & z(:, i), pressure(:, :, i))
         end do
         return
      end if
      call self%film%field(self%film_motion, self%laws, self%speed, phi, z, pressure)
   end subroutine pressure_field

   !> True where no friction puts switching points into the motion.
   pure logical function is_smooth(self)
      class(tilting_pad_bearing_type), intent(in) :: self
      is_smooth = .not. self%rubs .or. same_type_as(self%pivots(1)%friction, no_friction)
   end function is_smooth
end module tilting_pad_bearing
