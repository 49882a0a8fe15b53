!> A bearing in whose films the slopes of the journal count: what `tilting_pad_bearing` does there instead, and what
!> pivots do in which pads pitch and yaw.
module sloped_bearing
   use kinds, only: wp
   use case_inputs, only: case_type
   use rigid_rotor, only: journal_motion
   use state_layout, only: pad_state, element_layout_type, of_journal, pitch, yaw
   use kinematics, only: frame_of, motion_of, pad_frame, to_global
   use friction, only: turning_friction, no_friction
   use film_solver, only: film_counters
   use asperity_contact, only: sloped_asperity_load
   use sloped_gap, only: sloped_motion, edge_films
   use tilting_pad, only: pad_loads
   use sloped_pad, only: sloped_motion_of, in_frame, find_derivatives, add_slope_loads, add_turning_friction, &
      & of_pad, of_slopes, journal_slope
   use bearing_construction, only: constructed_bearing, sloped_sample, pad_sample
   use factories, only: make_sloped_film
   implicit none (type, external)
   private
   public :: make_sloped, sloped_films, take_sloped_pressures, sloped_loads, slopes_of, add_moments, find_inclined, &
      & add_late_sloped, find_turning_bristles, sloped_output, take_sloped_samples, sampled_slopes, &
      & moment_on_journal, least_thickness, align_pad

contains

   !> Gives bearing b of a case what it needs where slopes count in its films; `anew`, with other films.
   subroutine make_sloped(self, inputs, b, anew)
      class(constructed_bearing), intent(inout) :: self
      type(case_type), intent(in) :: inputs
      integer, intent(in) :: b
      logical, intent(in) :: anew
      type(film_counters) :: counters
      logical :: cavitates
      cavitates = self%film%cavitates()
      if (.not. allocated(self%sloped)) then
         if (.not. inputs%has_slopes(b)) return
         allocate (self%sloped)
         associate (n => size(self%pads), of => self%sloped)
            allocate (of%motion(n), of%film_motion(n), of%response(n), of%asperity(n), of%derivatives(n), &
               & of%friction(n))
         end associate
      else if (.not. anew) then
         self%sloped%journal%slope = inputs%bearings(b)%slope
         return
      end if
      counters = self%sloped%film%counters
      call make_sloped_film(inputs%bearings(b), self%accuracy, self%sloped%film, self%sloped%small)
      self%sloped%film%counters = counters
      call self%sloped%film%set_cavitation(cavitates)
      self%sloped%journal%slope = inputs%bearings(b)%slope
   end subroutine make_sloped

   !> The slopes of the journal: those that are given, and those of an elastic shaft.
   pure type(journal_slope) function slopes_of(self, journal) result(slopes)
      class(constructed_bearing), intent(in) :: self
      type(journal_motion), intent(in) :: journal
      slopes = journal_slope(self%sloped%journal%slope + journal%slope, journal%slope_rate)
   end function slopes_of

   !> Sets frames, motions and films of the pads that are not skipped, whose laws have their oil.
   subroutine sloped_films(self, journal, pads, speed, want_derivatives, skipped)
      class(constructed_bearing), intent(inout) :: self
      type(journal_motion), intent(in) :: journal
      type(pad_state), intent(in) :: pads(:)
      real(wp), intent(in) :: speed
      logical, intent(in) :: want_derivatives, skipped(:)
      integer :: i
      associate (of => self%sloped)
         do i = 1, size(pads)
            if (skipped(i)) cycle
            associate (pad => self%pads(i), film => of%response(i), asperity => of%asperity(i))
               self%frame(i) = frame_of(pad%position, journal, pads(i))
               of%motion(i) = sloped_motion_of(pad, self%frame(i), journal, slopes_of(self, journal), pads(i))
               call self%asperities%evaluate_sloped(pad%gap, pad%directions, of%motion(i), speed, asperity)
               of%film_motion(i) = of%motion(i)
               if (asperity%touches) of%film_motion(i) = asperity%film_motion
               if (allocated(of%small)) then
                  call of%small%evaluate_pad(i, of%film_motion(i), self%laws(i), speed, want_derivatives, of%film, &
                     & self%film, film)
               else
                  call of%film%evaluate_pad(i, of%film_motion(i), self%laws(i), speed, want_derivatives, film)
               end if
               self%motion(i) = of%motion(i)%middle
               self%asperity(i) = asperity%asperity_load
               if (asperity%touches) then
                  film%film%min_film_thickness = asperity%thickness
                  if (want_derivatives) film%derivatives(:, :4) = matmul(film%derivatives(:, :4), &
                     & asperity%film_motion_slopes)
               end if
               self%response(i) = film%film
            end associate
         end do
      end associate
   end subroutine sloped_films

   !> Takes the highest pressures that the films evaluated last lack.
   subroutine take_sloped_pressures(self)
      class(constructed_bearing), intent(inout) :: self
      associate (of => self%sloped)
         if (.not. allocated(of%small)) return
         call of%small%take_pressures(of%film_motion, self%laws, self%speed, of%film, self%film, of%response)
         self%response%max_pressure = of%response%film%max_pressure
      end associate
   end subroutine take_sloped_pressures

   !> Sets the loads of a pad whose film was evaluated, and their derivatives where they are wanted.
   subroutine sloped_loads(self, i, journal, state, want_derivatives)
      class(constructed_bearing), intent(inout) :: self
      integer, intent(in) :: i
      type(journal_motion), intent(in) :: journal
      type(pad_state), intent(in) :: state
      logical, intent(in) :: want_derivatives
      real(wp), dimension(4, 8) :: film, all
      real(wp) :: load(4), moment_slopes(4)
      associate (of => self%sloped, frame => self%frame(i), asperity => self%sloped%asperity(i))
         load = load_of(of%response(i)%film%force, of%response(i)%moment, asperity)
         call set_loads(self, i, frame, state, of%response(i)%film%force, load, asperity, self%loads(i), &
            & of%friction(i))
         if (.not. want_derivatives) return
         film = of%response(i)%derivatives
         all = film
         moment_slopes = 0
         if (asperity%touches) then
            all(:, :4) = all(:, :4) + asperity%slopes
            moment_slopes = asperity%turning_slopes
         end if
         call find_derivatives(self%coordinates, self%pads(i), frame, journal, slopes_of(self, journal), state, film, &
            & all, load, moment_slopes, self%loads(i), of%derivatives(i), self%derivatives(i))
      end associate
   end subroutine sloped_loads

   !> Force and moment of film and asperities on the journal in the pad frame, N and N m.
   pure function load_of(force, moment, asperity) result(load)
      real(wp), intent(in) :: force(2), moment(2)
      type(sloped_asperity_load), intent(in) :: asperity
      real(wp) :: load(4)
      load = [force, moment]
      if (asperity%touches) load = load + [asperity%force, asperity%journal_moment]
   end function load_of

   !> The loads of a pad by force and moment of its film, and of film and asperities, and the friction of its pivot.
   pure subroutine set_loads(self, i, frame, state, film_force, load, asperity, loads, friction)
      class(constructed_bearing), intent(in) :: self
      integer, intent(in) :: i
      type(pad_frame), intent(in) :: frame
      type(pad_state), intent(in) :: state
      real(wp), intent(in) :: film_force(2), load(4)
      type(sloped_asperity_load), intent(in) :: asperity
      type(pad_loads), intent(inout) :: loads
      type(turning_friction), intent(out) :: friction
      integer :: k
      associate (coordinates => self%coordinates, pad => self%pads(i), pivot => self%pivots(i), &
         & n => self%coordinates%rotations)
         if (self%rubs .and. n == 1) then
            call coordinates%loads(pad, frame, state, film_force, asperity%asperity_load, pivot%contact, &
               & pivot%friction, loads)
         else
            call coordinates%loads(pad, frame, state, film_force, asperity%asperity_load, pivot%contact, no_friction, &
               & loads)
         end if
         call add_slope_loads(coordinates, pad, frame, state, load, loads)
         if (.not. self%rubs .or. n < 2) return
         associate (turns => coordinates%kind(coordinates%rotation(:n)))
            call pivot%friction%evaluate_turning(pad%ball_radius*state%v(turns), state%bristle(:n), loads%contact, &
               & friction)
         end associate
         do k = 1, n
            associate (own => loads%own(coordinates%rotation(k)))
               own = own - pad%ball_radius*friction%force(k)
            end associate
         end do
         loads%friction%force = friction%force(1)
      end associate
   end subroutine set_loads

   !> Adds the moments of all pads against the slopes of the journal, N m.
   pure subroutine add_moments(self, moment)
      class(constructed_bearing), intent(in) :: self
      real(wp), intent(inout) :: moment(of_journal)
      integer :: i
      do i = 1, size(self%pads)
         associate (load => load_of(self%sloped%response(i)%film%force, self%sloped%response(i)%moment, &
            & self%sloped%asperity(i)))
            moment = moment + to_global(self%frame(i), load(3:4))
         end associate
      end do
   end subroutine add_moments

   !> Derivatives of a part on a shaft whose slopes count, as `part_derivatives` has them.
   pure subroutine find_inclined(self, part, m, accelerations, over_positions, over_rates)
      class(constructed_bearing), intent(in) :: self
      integer, intent(in) :: part, m
      logical, intent(in) :: accelerations
      real(wp), intent(out) :: over_positions(m, m), over_rates(m, m)
      over_positions = self%sloped%derivatives(part)%over_positions(:m, :m)
      over_rates = self%sloped%derivatives(part)%over_rates(:m, :m)
      if (.not. accelerations) return
      associate (own => self%of_rotor + 1, n => m - self%of_rotor)
         over_positions(own:, :) = matmul(self%per_mass(:n, :n, part), over_positions(own:, :))
         over_rates(own:, :) = matmul(self%per_mass(:n, :n, part), over_rates(own:, :))
      end associate
   end subroutine find_inclined

   !> Friction of a pivot as `add_late` has it, of one with several rotations or on a shaft whose slopes count.
   pure subroutine add_late_sloped(self, part, m, accelerations, over_positions, over_rates, over_bristle)
      class(constructed_bearing), intent(in) :: self
      integer, intent(in) :: part, m
      logical, intent(in) :: accelerations
      real(wp), intent(inout) :: over_positions(m, m), over_rates(m, m)
      real(wp), intent(out) :: over_bristle(m - of_journal)
      type(turning_friction) :: friction
      real(wp) :: contact(m), contact_rates(m)
      over_bristle = 0
      associate (rotation => self%coordinates%rotation(:self%coordinates%rotations), on => self%of_rotor, &
         & per_moment => per_moments(self, part, m, accelerations), scalar => self%loads(part)%friction)
         if (on > of_journal) then
            contact = self%sloped%derivatives(part)%contact_over_positions(:m)
            contact_rates = self%sloped%derivatives(part)%contact_over_rates(:m)
         else
            contact = self%derivatives(part)%contact_over_positions(:m)
            contact_rates = self%derivatives(part)%contact_over_rates(:m)
         end if
         if (size(rotation) > 1) then
            friction = self%sloped%friction(part)
         else
            friction%force_normal(1) = scalar%force_normal
            friction%force_velocity(1, 1) = scalar%force_velocity
            over_bristle(on + 1 - of_journal:) = -self%pads(part)%ball_radius*scalar%force_deflection*per_moment(:, 1)
         end if
         call add_turning_friction(contact, contact_rates, self%pads(part), rotation, friction, on, m, per_moment, &
            & over_positions, over_rates)
      end associate
   end subroutine add_late_sloped

   !> What the rows of a pad answer to a moment along each of its rotations, (row, rotation).
   pure function per_moments(self, part, m, accelerations)
      class(constructed_bearing), intent(in) :: self
      integer, intent(in) :: part, m
      logical, intent(in) :: accelerations
      real(wp) :: per_moments(m - self%of_rotor, self%coordinates%rotations)
      integer :: k
      per_moments = 0
      do k = 1, self%coordinates%rotations
         associate (row => self%coordinates%rotation(k))
            per_moments(row, k) = 1
            if (accelerations) per_moments(:, k) = self%per_mass(:m - self%of_rotor, row, part)
         end associate
      end do
   end function per_moments

   !> What `find_bristles` asks of a pivot with several rotations.
   pure subroutine find_turning_bristles(self, part, m, accelerations, over_bristle, of_rates, of_bristle)
      class(constructed_bearing), intent(in) :: self
      integer, intent(in) :: part, m
      logical, intent(in) :: accelerations
      real(wp), intent(out) :: over_bristle(:, :), of_rates(:, :), of_bristle
      associate (friction => self%sloped%friction(part), radius => self%pads(part)%ball_radius, &
         & n => self%coordinates%rotations)
         over_bristle = -radius*friction%force_deflection*per_moments(self, part, m, accelerations)
         of_rates = radius*friction%rate_velocity(:n, :n)
         of_bristle = friction%rate_deflection
      end associate
   end subroutine find_turning_bristles

   !> Output of a pad after a correction of all states to first order.
   pure function sloped_output(self, i, layout, correction) result(output)
      class(constructed_bearing), intent(in) :: self
      integer, intent(in) :: i
      type(element_layout_type), intent(in) :: layout
      real(wp), intent(in) :: correction(:)
      real(wp) :: output(7), added(4)
      integer :: k, o
      associate (of => self%sloped%response(i), x => self%sloped%derivatives(i)%film_over_positions, &
         & v => self%sloped%derivatives(i)%film_over_rates)
         added = matmul(x(:, :of_journal), correction(layout%journal)) &
            & + matmul(v(:, :of_journal), correction(layout%journal_rates))
         if (layout%of_rotor > of_journal) added = added &
            & + matmul(x(:, of_slopes:of_pad - 1), correction(layout%slopes)) &
            & + matmul(v(:, of_slopes:of_pad - 1), correction(layout%slopes - layout%journal + layout%journal_rates))
         o = layout%before(i)
         do k = 1, layout%coordinates
            added = added + x(:, of_pad + k - 1)*correction(o + 2*k - 1) + v(:, of_pad + k - 1)*correction(o + 2*k)
         end do
         output = [of%film%force + added(:2), of%film%max_pressure, of%moment + added(3:), of%place]
      end associate
   end function sloped_output

   !> The samples of a pad in a state whose output is known: without the film solver.
   pure subroutine take_sloped_samples(self, i, journal, state, speed, output, sample, slopes)
      class(constructed_bearing), intent(in) :: self
      integer, intent(in) :: i
      type(journal_motion), intent(in) :: journal
      type(pad_state), intent(in) :: state
      real(wp), intent(in) :: speed, output(7)
      type(pad_sample), intent(inout) :: sample
      type(sloped_sample), intent(out), optional :: slopes
      type(pad_frame) :: frame
      type(sloped_motion) :: motion
      type(sloped_asperity_load) :: asperity
      type(pad_loads) :: loads
      type(turning_friction) :: friction
      associate (pad => self%pads(i), gap => self%pads(i)%gap)
         frame = frame_of(pad%position, journal, state)
         motion = sloped_motion_of(pad, frame, journal, slopes_of(self, journal), state)
         call self%asperities%evaluate_sloped(gap, pad%directions, motion, speed, asperity)
         associate (load => load_of(output(1:2), output(4:5), asperity))
            call set_loads(self, i, frame, state, output(1:2), load, asperity, loads, friction)
            sample = pad_sample(loads%contact, pad%ball_radius*loads%friction%force, output(1:2), asperity%thickness, &
               & max(output(3), gap%supply_pressure, gap%ambient_pressure), asperity%carried())
            if (present(slopes)) slopes = sloped_sample(pad%ball_radius*friction%force(2:3), edge_films(gap, &
               & pad%directions, motion), load(3:4), output(6:7))
         end associate
      end associate
   end subroutine take_sloped_samples

   !> Of a pad in the state evaluated last what is sampled beside.
   pure type(sloped_sample) function sampled_slopes(self, i) result(sample)
      class(constructed_bearing), intent(in) :: self
      integer, intent(in) :: i
      associate (of => self%sloped, pad => self%pads(i))
         associate (load => load_of(of%response(i)%film%force, of%response(i)%moment, of%asperity(i)))
            sample = sloped_sample(pad%ball_radius*of%friction(i)%force(2:3), edge_films(pad%gap, pad%directions, &
               & of%motion(i)), load(3:4), of%response(i)%place)
         end associate
      end associate
   end function sampled_slopes

   !> Least thickness of a pad's film, m, of a bearing with or without slopes.
   pure real(wp) function least_thickness(self, i, journal, state)
      class(constructed_bearing), intent(in) :: self
      integer, intent(in) :: i
      type(journal_motion), intent(in) :: journal
      type(pad_state), intent(in) :: state
      type(pad_frame) :: frame
      associate (pad => self%pads(i))
         frame = frame_of(pad%position, journal, state)
         if (allocated(self%sloped)) then
            least_thickness = minval(edge_films(pad%gap, pad%directions, sloped_motion_of(pad, frame, journal, &
               & slopes_of(self, journal), state)))
         else
            least_thickness = pad%gap%min_film_thickness(motion_of(pad%position, frame, journal, state), pad%directions)
         end if
      end associate
   end function least_thickness

   !> Gives a pad, at its tilt, the slopes of the journal that it can follow.
   pure subroutine align_pad(self, i, journal, state)
      class(constructed_bearing), intent(in) :: self
      integer, intent(in) :: i
      type(journal_motion), intent(in) :: journal
      type(pad_state), intent(inout) :: state
      if (self%coordinates%rotations < 2) return
      associate (slope => in_frame(frame_of(self%pads(i)%position, journal, state), self%sloped%journal%slope &
         & + journal%slope))
         state%x(pitch) = slope(2)
         if (self%coordinates%rotations > 2) state%x(yaw) = slope(1)
      end associate
   end subroutine align_pad

   !> The moments of these samples of all pads on the journal in these states, against its slopes along y and z, N m.
   pure function moment_on_journal(self, journal, pads, samples) result(moment)
      class(constructed_bearing), intent(in) :: self
      type(journal_motion), intent(in) :: journal
      type(pad_state), intent(in) :: pads(:)
      type(sloped_sample), intent(in) :: samples(:)
      real(wp) :: moment(2)
      integer :: i
      moment = 0
      do i = 1, size(pads)
         moment = moment + to_global(frame_of(self%pads(i)%position, journal, pads(i)), samples(i)%moment)
      end do
   end function moment_on_journal
end module sloped_bearing
