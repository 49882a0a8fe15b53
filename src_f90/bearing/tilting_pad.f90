!> One pad: loads on it and on the journal in a state, and their derivatives, which are not divided by masses. A fixed
!> pad stays without tilt; only its load on the journal counts.
module tilting_pad
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   use text, only: to_text
   use film_solver, only: film_motion, film_response, film_ok, film_closed, film_not_converged, film_not_resolved
   use pad_gap, only: pad_gap_type, pad_directions
   use asperity_contact, only: asperity_load
   use contact_table, only: contact_table_type
   use friction, only: friction_law, friction_response
   use kinematics, only: pad_state, pad_position, pad_frame, motion_derivatives, to_global, columns, &
      & tilt_column, tilt_rate_column, deflection_column, position_columns, rate_columns
   implicit none (type, external)
   private
   public :: tilting_pad_type, pad_loads, pad_derivatives

   !> What a pad is; SI units.
   type :: tilting_pad_type
      type(pad_position) :: position
      type(pad_gap_type) :: gap
      type(pad_directions) :: directions
      !> Tilt at which the pad counts as turned over, rad.
      real(wp) :: largest_tilt
      !> Mass; moment of inertia about the pivot; weight; centre of gravity from the pivot.
      real(wp) :: mass = 0, inertia = 0, weight = 0, centre_tangential = 0, centre_radial = 0
      !> R1 of the pivot.
      real(wp) :: ball_radius
      !> Whether the pad tilts; whether its pivot yields: then its pivot deflection is a state, else its force is the
      !> reaction.
      logical :: tilts, radial
   contains
      procedure :: admitted
      procedure :: why_not
      procedure :: loads
      procedure :: derivatives
      procedure :: add_friction
      procedure :: masses
      procedure :: inverse_masses
   end type tilting_pad_type

   !> Loads of one pad at one instant.
   type :: pad_loads
      !> Force of film and asperities on the journal along global y and z, N.
      real(wp) :: journal(2) = 0
      !> Pivot load F_bs, N, and its derivative over the pivot deflection, N/m (0 tilting-only).
      real(wp) :: contact = 0, contact_stiffness = 0
      !> Friction of the pivot.
      type(friction_response) :: friction
      !> Moment of eq (3), N m, and force of eq (4), N, on the pad.
      real(wp) :: moment = 0, radial = 0
   end type pad_loads

   !> Derivatives of the loads over the columns of kinematics, without what friction adds.
   type :: pad_derivatives
      !> Of the film force on the journal in the pad frame; of `journal`, `contact`, `moment` and `radial` of the loads.
      real(wp) :: film(2, columns) = 0, journal(2, columns) = 0
      real(wp) :: contact(columns) = 0, moment(columns) = 0, radial(columns) = 0
   contains
      procedure :: as_matrices
   end type pad_derivatives

contains

   !> True where a pad stands and its film has a force.
   pure logical function admitted(self, state, film)
      class(tilting_pad_type), intent(in) :: self
      type(pad_state), intent(in) :: state
      type(film_response), intent(in) :: film
      admitted = abs(state%tilt) < self%largest_tilt .and. film%status == film_ok .and. all(ieee_is_finite(film%force))
   end function admitted

   !> Why a pad's state is not admitted.
   function why_not(self, number, state, film) result(reason)
      class(tilting_pad_type), intent(in) :: self
      integer, intent(in) :: number
      type(pad_state), intent(in) :: state
      type(film_response), intent(in) :: film
      character(len=:), allocatable :: reason, thickness
      thickness = ': thickness '//to_text(film%min_film_thickness)//' m'
      if (.not. abs(state%tilt) < self%largest_tilt) then
         reason = 'pad '//to_text(number)//' turned over: tilt '//to_text(state%tilt)//' rad'
      else if (film%status == film_closed) then
         reason = 'the film of pad '//to_text(number)//' closed'//thickness
      else if (film%status == film_not_converged .and. .not. film%residual > 0) then
         reason = 'the film of pad '//to_text(number)//' did not converge: where it cavitates does not settle; try ' &
            & //'other volumes (film%circumferential_cells, film%axial_cells)'
      else if (film%status == film_not_resolved) then
         reason = 'the film of pad '//to_text(number)//' is not resolved: on the finest volumes its force or slopes ' &
            & //'err by '//to_text(film%residual)//thickness//'; volumes that are given (film%circumferential_cells, ' &
            & //'film%axial_cells) are taken as they are'
      else if (film%status == film_not_converged) then
         reason = 'the film of pad '//to_text(number)//' did not converge: residual '//to_text(film%residual) &
            & //' after film%max_sweeps = '//to_text(film%max_sweeps)
      else
         reason = 'the film force of pad '//to_text(number)//' is not finite'//thickness
      end if
   end function why_not

   !> The loads in a state with a film force in the pad frame, N.
   pure subroutine loads(self, frame, state, film_force, asperities, contact, friction, answer)
      class(tilting_pad_type), intent(in) :: self
      type(pad_frame), intent(in) :: frame
      type(pad_state), intent(in) :: state
      real(wp), intent(in) :: film_force(2)
      type(asperity_load), intent(in) :: asperities
      type(contact_table_type), intent(in) :: contact
      class(friction_law), intent(in) :: friction
      type(pad_loads), intent(inout) :: answer
      real(wp) :: inertial, force(2)
      force = film_force
      if (asperities%touches) force = film_force + asperities%force
      answer%journal = to_global(frame, force)
      if (.not. self%tilts) return
      inertial = self%mass*self%centre_radial*state%tilt_rate**2
      answer%radial = -force(2) - self%weight*frame%s + inertial
      if (self%radial) then
         call contact%lookup(state%pivot_deflection, answer%contact, answer%contact_stiffness)
      else
         answer%contact = max(0.0_wp, answer%radial)
      end if
      answer%radial = answer%radial - answer%contact
      call friction%evaluate(self%ball_radius*state%tilt_rate, state%deflection, answer%contact, answer%friction)
      answer%moment = -force(1)*self%position%centre_distance - self%ball_radius*answer%friction%force &
         & - self%weight*(self%centre_tangential*frame%s - self%centre_radial*frame%c)
      if (asperities%touches) answer%moment = answer%moment + asperities%moment
   end subroutine loads

   !> The derivatives of the loads in the state in which these, film and asperities were evaluated, film derivatives
   !> included.
   pure subroutine derivatives(self, frame, motion, state, film, asperities, loads, answer)
      class(tilting_pad_type), intent(in) :: self
      type(pad_frame), intent(in) :: frame
      type(film_motion), intent(in) :: motion
      type(pad_state), intent(in) :: state
      type(film_response), intent(in) :: film
      type(asperity_load), intent(in) :: asperities
      type(pad_loads), intent(in) :: loads
      type(pad_derivatives), intent(inout) :: answer
      real(wp) :: force(2, columns), across(2), of_motion(4, columns)
      integer :: k
      of_motion = motion_derivatives(self%position, frame, motion, state%tilt_rate)
      force = matmul(film%derivatives, of_motion)
      answer%film = force
      across = [-film%force(2), film%force(1)]
      if (asperities%touches) then
         force = force + matmul(asperities%force_slopes, of_motion(1:2, :))
         across = across + [-asperities%force(2), asperities%force(1)]
      end if
      do k = 1, columns
         answer%journal(:, k) = to_global(frame, force(:, k))
      end do
      if (.not. self%tilts) return
      ! the frame turns with the pad
      answer%journal(:, tilt_column) = answer%journal(:, tilt_column) + to_global(frame, across)
      associate (contact => answer%contact, moment => answer%moment, radial => answer%radial)
         radial = -force(2, :)
         radial(tilt_column) = radial(tilt_column) + self%weight*frame%c
         radial(tilt_rate_column) = radial(tilt_rate_column) + 2*self%mass*self%centre_radial*state%tilt_rate
         if (self%radial) then
            contact = 0
            contact(deflection_column) = loads%contact_stiffness
         else
            contact = merge(radial, 0.0_wp, loads%contact > 0)
         end if
         radial = radial - contact
         moment = -force(1, :)*self%position%centre_distance
         moment(tilt_column) = -force(1, tilt_column)*self%position%centre_distance &
            & + (self%weight*(self%centre_tangential*frame%c + self%centre_radial*frame%s))
         if (asperities%touches) moment = moment + matmul(asperities%moment_slopes, of_motion(1:2, :))
      end associate
   end subroutine derivatives

   !> The derivatives of the force on the journal, moment and radial force over displacements and over their rates: rows
   !> and columns in the order journal y, z, tilt, pivot deflection.
   pure subroutine as_matrices(self, over_positions, over_rates)
      class(pad_derivatives), intent(in) :: self
      real(wp), intent(out) :: over_positions(4, 4), over_rates(4, 4)
      over_positions(1:2, :) = self%journal(:, position_columns)
      over_positions(3, :) = self%moment(position_columns)
      over_positions(4, :) = self%radial(position_columns)
      over_rates(1:2, :) = self%journal(:, rate_columns)
      over_rates(3, :) = self%moment(rate_columns)
      over_rates(4, :) = self%radial(rate_columns)
   end subroutine as_matrices

   !> Adds what the moment of friction does to such matrices, in whose last two rows it counts as `per_moment` says, and
   !> what it does to these rows per deflection of the bristles.
   pure subroutine add_friction(self, friction, contact, per_moment, over_positions, over_rates, over_deflection)
      class(tilting_pad_type), intent(in) :: self
      type(friction_response), intent(in) :: friction
      !> Derivatives of the pivot load.
      real(wp), intent(in) :: contact(columns), per_moment(2)
      real(wp), intent(inout) :: over_positions(4, 4), over_rates(4, 4)
      real(wp), intent(out) :: over_deflection(2)
      real(wp) :: moment(columns)
      integer :: k
      moment = -self%ball_radius*friction%force_normal*contact
      moment(tilt_rate_column) = -self%ball_radius*friction%force_normal*contact(tilt_rate_column) &
         & - self%ball_radius**2*friction%force_velocity
      do k = 1, 4
         over_positions(3:4, k) = over_positions(3:4, k) + per_moment*moment(position_columns(k))
         over_rates(3:4, k) = over_rates(3:4, k) + per_moment*moment(rate_columns(k))
      end do
      over_deflection = per_moment*(-self%ball_radius*friction%force_deflection)
   end subroutine add_friction

   !> Mass matrix of eqs (3)-(4): moment and force per rate of tilt rate and pivot deflection rate.
   pure function masses(self)
      class(tilting_pad_type), intent(in) :: self
      real(wp) :: masses(2, 2)
      associate (coupling => self%mass*self%centre_tangential)
         masses = reshape([self%inertia, coupling, coupling, self%mass], [2, 2])
      end associate
   end function masses

   !> Its inverse. A pad that only tilts has no second row and column, a fixed one none.
   pure function inverse_masses(self) result(inverse)
      class(tilting_pad_type), intent(in) :: self
      real(wp) :: inverse(2, 2), coupling, determinant
      inverse = 0
      if (self%radial) then
         ! coupled where C_xi /= 0
         coupling = self%mass*self%centre_tangential
         determinant = self%inertia*self%mass - coupling**2
         inverse = reshape([self%mass, -coupling, -coupling, self%inertia], [2, 2])/determinant
      else if (self%tilts) then
         inverse(1, 1) = 1/self%inertia
      end if
   end function inverse_masses
end module tilting_pad
