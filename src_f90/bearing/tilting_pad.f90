!> The pads of a bearing: what one is; which coordinates it has, with their names, units and lengths, and the film
!> motion that they make; the loads on pad and journal in a state, their derivatives, and the masses that they are not
!> divided by. A fixed pad has no coordinates; only its load on the journal counts.
module tilting_pad
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   use linear_algebra, only: identity, solve_few
   use text, only: filled
   use film_solver, only: film_motion, film_response, film_ok, film_closed, film_not_converged, film_not_resolved
   use pad_gap, only: pad_gap_type, pad_directions
   use asperity_contact, only: asperity_load
   use contact_table, only: contact_table_type
   use friction, only: friction_law, friction_response
   use state_layout, only: pad_state, tilt, pivot_deflection, pitch, yaw, most_coordinates, most_rotations, of_journal
   use kinematics, only: pad_position, pad_frame, motion_slopes, to_global
   implicit none (type, external)
   private
   public :: tilting_pad_type, pad_coordinates_type, new_pad_coordinates, coordinate_type, pad_loads, pad_derivatives

   !> Most displacements of a pad's equations: those of the journal, y and z, and its own.
   integer, parameter :: most = of_journal + most_coordinates
   !> Those of a pad on a flexible pivot.
   integer, parameter :: usual = of_journal + 2

   !> What a pad is; SI units.
   type :: tilting_pad_type
      type(pad_position) :: position
      type(pad_gap_type) :: gap
      type(pad_directions) :: directions
      !> Tilt at which the pad counts as turned over, rad.
      real(wp) :: largest_tilt
      !> Mass; moment of inertia about the pivot; weight; centre of gravity from the pivot.
      real(wp) :: mass = 0, inertia = 0, weight = 0, centre_tangential = 0, centre_radial = 0
      !> Moments of inertia of pitch and yaw about the pivot, and how far this stands from the middle plane along the
      !> shaft, m: as far the other way from the pivot the centre of gravity lies.
      real(wp) :: inertia_pitch = 0, inertia_yaw = 0, axial_offset = 0
      !> R1 of the pivot; its moment against the tilt over the tilt, N m/rad.
      real(wp) :: ball_radius, rotational_stiffness = 0
   contains
      procedure :: admitted
      procedure :: why_not
   end type tilting_pad_type

   !> A displacement of a pad in words.
   type :: coordinate_type
      !> In the names of modes and coefficients; of its series in a result, behind which stands '_rate' for its rate;
      !> its unit, that of its rate having '/s'; what it is.
      character(len=20) :: name = '', series = '', units = '', label = ''
   end type coordinate_type

   !> The coordinates of the pads of a bearing: displacements, which its states have in this order, each with its rate;
   !> the first is the tilt.
   type :: pad_coordinates_type
      integer :: n = 0
      !> Of each its place in pad_state, and its words.
      integer :: kind(most_coordinates) = 0
      type(coordinate_type) :: words(most_coordinates)
      !> Which coordinate is the pivot deflection; 0: the pivots are rigid.
      integer :: deflection = 0
      !> Which coordinates turn the pad in its pivot, the tilt first.
      integer :: rotations = 0, rotation(most_rotations) = 0
   contains
      procedure :: add
      procedure :: length
      procedure :: loads
      procedure :: derivatives
      procedure :: masses
      procedure :: per_mass
      procedure :: bristle_series
   end type pad_coordinates_type

   !> Loads of one pad at one instant.
   type :: pad_loads
      !> Force of film and asperities on the journal along global y and z, N.
      real(wp) :: journal(2) = 0
      !> Pivot load F_bs, N, and its derivative over the pivot deflection, N/m (0 of a rigid pivot).
      real(wp) :: contact = 0, contact_stiffness = 0
      !> Friction of the pivot.
      type(friction_response) :: friction
      !> Of each coordinate the force on the pad along it: of the tilt the moment of eq (3), N m; of the pivot
      !> deflection the force of eq (4), N.
      real(wp) :: own(most_coordinates) = 0
   end type pad_loads

   !> Derivatives of the loads over the displacements of the journal, y and z, and of the pad, and over their rates,
   !> without what friction adds.
   type :: pad_derivatives
      !> Of the forces on the journal, y and z, and of those along the coordinates of the pad.
      real(wp) :: over_positions(most, most) = 0, over_rates(most, most) = 0
      !> Of the film force on the journal in the pad frame.
      real(wp) :: film_over_positions(2, most) = 0, film_over_rates(2, most) = 0
      !> Of the pivot load.
      real(wp) :: contact_over_positions(most) = 0, contact_over_rates(most) = 0
   contains
      procedure :: add_friction
   end type pad_derivatives

contains

   !> The coordinates of pads with this word of pads%motion.
   pure type(pad_coordinates_type) function new_pad_coordinates(motion) result(coordinates)
      character(len=*), intent(in) :: motion
      if (motion == 'fixed') return
      call coordinates%add(tilt, coordinate_type('tilt', 'pad_tilt', 'rad', 'pad tilt'), turns=.true.)
      if (index(motion, 'radial') > 0) call coordinates%add(pivot_deflection, &
         & coordinate_type('pivot_deflection', 'pivot_deflection', 'm', 'pivot deflection'))
      if (index(motion, 'pitch') > 0) call coordinates%add(pitch, coordinate_type('pitch', 'pad_pitch', 'rad', &
         & 'pad pitch'), turns=.true.)
      if (index(motion, 'yaw') > 0) call coordinates%add(yaw, coordinate_type('yaw', 'pad_yaw', 'rad', 'pad yaw'), &
         & turns=.true.)
   end function new_pad_coordinates

   !> Adds a coordinate behind the others.
   pure subroutine add(self, kind, words, turns)
      class(pad_coordinates_type), intent(inout) :: self
      !> Its place in pad_state.
      integer, intent(in) :: kind
      type(coordinate_type), intent(in) :: words
      !> Whether it turns the pad in its pivot; left out: no.
      logical, intent(in), optional :: turns
      self%n = self%n + 1
      self%kind(self%n) = kind
      self%words(self%n) = words
      if (kind == pivot_deflection) self%deflection = self%n
      if (.not. present(turns)) return
      self%rotations = self%rotations + 1
      self%rotation(self%rotations) = self%n
   end subroutine add

   !> The name of the series of the bristles of a rotation.
   pure function bristle_series(self, rotation) result(name)
      class(pad_coordinates_type), intent(in) :: self
      integer, intent(in) :: rotation
      character(len=:), allocatable :: name
      name = 'bristle_deflection'
      if (rotation > 1) name = name//'_'//trim(self%words(self%rotation(rotation))%name)
   end function bristle_series

   !> What stands for a unit of a coordinate of a pad, m: for 1 rad of its tilt the distance from the pivot to the
   !> centre of its arc, of its pitch or yaw half its length.
   pure real(wp) function length(self, pad, coordinate)
      class(pad_coordinates_type), intent(in) :: self
      type(tilting_pad_type), intent(in) :: pad
      integer, intent(in) :: coordinate
      length = 1
      if (self%kind(coordinate) == tilt) then
         length = pad%position%centre_distance
      else if (any(self%rotation == coordinate)) then
         length = 0.5_wp*pad%gap%axial_length
      end if
   end function length

   !> True where a pad stands and its film has a force.
   pure logical function admitted(self, state, film)
      class(tilting_pad_type), intent(in) :: self
      type(pad_state), intent(in) :: state
      type(film_response), intent(in) :: film
      admitted = abs(state%x(tilt)) < self%largest_tilt .and. film%status == film_ok &
         & .and. all(ieee_is_finite(film%force))
   end function admitted

   !> Why a pad's state is not admitted.
   function why_not(self, number, state, film) result(reason)
      class(tilting_pad_type), intent(in) :: self
      integer, intent(in) :: number
      type(pad_state), intent(in) :: state
      type(film_response), intent(in) :: film
      character(len=:), allocatable :: reason
      character(len=*), parameter :: thickness = ': thickness {} m'
      real(wp) :: pad
      pad = number
      if (.not. abs(state%x(tilt)) < self%largest_tilt) then
         reason = filled('pad {} turned over: tilt {} rad', [pad, state%x(tilt)])
      else if (film%status == film_closed) then
         reason = filled('the film of pad {} closed'//thickness, [pad, film%min_film_thickness])
      else if (film%status == film_not_converged .and. .not. film%residual > 0) then
         reason = filled('the film of pad {} did not converge: where it cavitates does not settle; try other volumes ' &
            & //'(film%circumferential_cells, film%axial_cells)', [pad])
      else if (film%status == film_not_resolved) then
         reason = filled('the film of pad {} is not resolved: on the finest volumes its force or slopes err by {}' &
            & //thickness//'; volumes that are given (film%circumferential_cells, film%axial_cells) are taken as ' &
            & //'they are', [pad, film%residual, film%min_film_thickness])
      else if (film%status == film_not_converged) then
         reason = filled('the film of pad {} did not converge: residual {} after film%max_sweeps = {i}', [real(wp) :: &
            & pad, film%residual, film%max_sweeps])
      else
         reason = filled('the film force of pad {} is not finite'//thickness, [pad, film%min_film_thickness])
      end if
   end function why_not

   !> The loads of a pad in a state with a film force in the pad frame, N.
   pure subroutine loads(self, pad, frame, state, film_force, asperities, contact, friction, answer)
      class(pad_coordinates_type), intent(in) :: self
      type(tilting_pad_type), intent(in) :: pad
      type(pad_frame), intent(in) :: frame
      type(pad_state), intent(in) :: state
      real(wp), intent(in) :: film_force(2)
      type(asperity_load), intent(in) :: asperities
      type(contact_table_type), intent(in) :: contact
      class(friction_law), intent(in) :: friction
      type(pad_loads), intent(inout) :: answer
      real(wp) :: inertial, radial, moment, force(2)
      force = film_force
      if (asperities%touches) force = film_force + asperities%force
      answer%journal = to_global(frame, force)
      if (self%n == 0) return
      inertial = pad%mass*pad%centre_radial*state%v(tilt)**2
      radial = -force(2) - pad%weight*frame%s + inertial
      if (self%deflection > 0) then
         call contact%lookup(state%x(pivot_deflection), answer%contact, answer%contact_stiffness)
      else
         answer%contact = max(0.0_wp, radial)
      end if
      call friction%evaluate(pad%ball_radius*state%v(tilt), state%bristle(1), answer%contact, answer%friction)
      moment = -force(1)*pad%position%centre_distance - pad%ball_radius*answer%friction%force &
         & - pad%weight*(pad%centre_tangential*frame%s - pad%centre_radial*frame%c)
      if (asperities%touches) moment = moment + asperities%moment
      answer%own(tilt) = moment - pad%rotational_stiffness*state%x(tilt)
      if (self%deflection > 0) answer%own(self%deflection) = radial - answer%contact
   end subroutine loads

   !> The derivatives of the loads of a pad in the state in which these, film and asperities were evaluated, film
   !> derivatives included.
   pure subroutine derivatives(self, pad, frame, motion, state, film, asperities, loads, answer)
      class(pad_coordinates_type), intent(in) :: self
      type(tilting_pad_type), intent(in) :: pad
      type(pad_frame), intent(in) :: frame
      type(film_motion), intent(in) :: motion
      type(pad_state), intent(in) :: state
      type(film_response), intent(in) :: film
      type(asperity_load), intent(in) :: asperities
      type(pad_loads), intent(in) :: loads
      type(pad_derivatives), intent(inout) :: answer
      real(wp), dimension(4, most) :: of_positions, of_rates
      real(wp), dimension(2, most) :: over_positions, over_rates
      real(wp), dimension(most) :: radial, radial_rates, moment, moment_rates
      real(wp) :: across(2)
      ! long: one list of the derivatives of all loads
      integer, parameter :: of_tilt = of_journal + tilt
      integer :: k
      call motion_slopes(pad%position, frame, motion, state%v(tilt), self%kind, of_positions, of_rates)
      call add_film(of_positions, answer%film_over_positions, over_positions)
      call add_film(of_rates, answer%film_over_rates, over_rates)
      across = [-film%force(2), film%force(1)]
      if (asperities%touches) across = across + [-asperities%force(2), asperities%force(1)]
      do k = 1, most
         answer%over_positions(:2, k) = to_global(frame, over_positions(:, k))
         answer%over_rates(:2, k) = to_global(frame, over_rates(:, k))
      end do
      if (self%n == 0) return
      ! the frame turns with the pad
      answer%over_positions(:2, of_tilt) = answer%over_positions(:2, of_tilt) + to_global(frame, across)
      radial = -over_positions(2, :)
      radial(of_tilt) = radial(of_tilt) + pad%weight*frame%c
      radial_rates = -over_rates(2, :)
      radial_rates(of_tilt) = radial_rates(of_tilt) + 2*pad%mass*pad%centre_radial*state%v(tilt)
      associate (contact => answer%contact_over_positions, contact_rates => answer%contact_over_rates, &
         & of_deflection => of_journal + self%deflection)
         ! that of a rigid pivot has those of the force on it
         contact = merge(radial, 0.0_wp, self%deflection == 0 .and. loads%contact > 0)
         if (self%deflection > 0) contact(of_deflection) = loads%contact_stiffness
         contact_rates = merge(radial_rates, 0.0_wp, self%deflection == 0 .and. loads%contact > 0)
         moment = -over_positions(1, :)*pad%position%centre_distance
         moment(of_tilt) = -over_positions(1, of_tilt)*pad%position%centre_distance &
            & + (pad%weight*(pad%centre_tangential*frame%c + pad%centre_radial*frame%s))
         moment_rates = -over_rates(1, :)*pad%position%centre_distance
         if (asperities%touches) then
            moment = moment + matmul(asperities%moment_slopes, of_positions(1:2, :))
            moment_rates = moment_rates + matmul(asperities%moment_slopes, of_rates(1:2, :))
         end if
         moment(of_tilt) = moment(of_tilt) - pad%rotational_stiffness
         answer%over_positions(of_tilt, :) = moment
         answer%over_rates(of_tilt, :) = moment_rates
         if (self%deflection > 0) then
            answer%over_positions(of_deflection, :) = radial - contact
            answer%over_rates(of_deflection, :) = radial_rates - contact_rates
         end if
      end associate

   contains

      !> What film and asperities add to derivatives of the force in the pad frame, by those of the film motion.
      pure subroutine add_film(of_motion, of_film, force)
         real(wp), intent(in) :: of_motion(4, most)
         real(wp), intent(out) :: of_film(2, most), force(2, most)
         force = matmul(film%derivatives, of_motion)
         of_film = force
         if (asperities%touches) force = force + matmul(asperities%force_slopes, of_motion(1:2, :))
      end subroutine add_film
   end subroutine derivatives

   !> Adds what the friction of the pivot does to derivatives of the forces, in whose rows of the pad its moment counts
   !> as `per_moment` says, and what it does to these rows per deflection of the bristles.
   pure subroutine add_friction(self, pad, friction, m, per_moment, over_positions, over_rates, over_bristle)
      class(pad_derivatives), intent(in) :: self
      type(tilting_pad_type), intent(in) :: pad
      type(friction_response), intent(in) :: friction
      integer, intent(in) :: m
      real(wp), intent(in) :: per_moment(m - of_journal)
      real(wp), intent(inout) :: over_positions(m, m), over_rates(m, m)
      real(wp), intent(out) :: over_bristle(m - of_journal)
      real(wp) :: moment(most), moment_rates(most)
      ! sizes that the compiler knows are faster
      moment = -pad%ball_radius*friction%force_normal*self%contact_over_positions
      moment_rates = -pad%ball_radius*friction%force_normal*self%contact_over_rates
      moment_rates(of_journal + tilt) = -pad%ball_radius*friction%force_normal &
         & *self%contact_over_rates(of_journal + tilt) - pad%ball_radius**2*friction%force_velocity
      if (m == usual) then
         call add(usual, per_moment, moment, moment_rates, over_positions, over_rates)
      else
         call add(m, per_moment, moment, moment_rates, over_positions, over_rates)
      end if
      over_bristle = per_moment*(-pad%ball_radius*friction%force_deflection)

   contains

      pure subroutine add(m, per_moment, moment, moment_rates, over_positions, over_rates)
         integer, value :: m
         real(wp), intent(in) :: per_moment(m - of_journal), moment(m), moment_rates(m)
         real(wp), intent(inout) :: over_positions(m, m), over_rates(m, m)
         integer :: k, i
         do k = 1, m
            do i = 1, m - of_journal
               over_positions(of_journal + i, k) = over_positions(of_journal + i, k) + per_moment(i)*moment(k)
               over_rates(of_journal + i, k) = over_rates(of_journal + i, k) + per_moment(i)*moment_rates(k)
            end do
         end do
      end subroutine add
   end subroutine add_friction

   !> The mass matrix of the coordinates, eqs (3)-(4): moment and force per rate of tilt rate and pivot deflection rate,
   !> of pitch rate and yaw rate. The product of inertia of pitch and yaw is that of the centre of gravity.
   pure function masses(self, pad)
      class(pad_coordinates_type), intent(in) :: self
      type(tilting_pad_type), intent(in) :: pad
      real(wp) :: masses(self%n, self%n)
      real(wp) :: all(most_coordinates, most_coordinates)
      associate (m => pad%mass, c_t => pad%centre_tangential, c_r => pad%centre_radial, s => pad%axial_offset)
         all(:, tilt) = [pad%inertia, m*c_t, -m*s*c_t, m*s*c_r]
         all(:, pivot_deflection) = [m*c_t, m, -m*s, 0.0_wp]
         all(:, pitch) = [-m*s*c_t, -m*s, pad%inertia_pitch, m*c_t*c_r]
         all(:, yaw) = [m*s*c_r, 0.0_wp, m*c_t*c_r, pad%inertia_yaw]
      end associate
      masses = all(self%kind(:self%n), self%kind(:self%n))
   end function masses

   !> Its inverse, 0 of what is no coordinate.
   function per_mass(self, pad)
      class(pad_coordinates_type), intent(in) :: self
      type(tilting_pad_type), intent(in) :: pad
      real(wp) :: per_mass(most_coordinates, most_coordinates)
      real(wp), dimension(self%n, self%n) :: masses, one
      integer :: k
      per_mass = 0
      masses = self%masses(pad)
      one = identity(self%n)
      do k = 1, self%n
         per_mass(:self%n, k) = solve_few(masses, one(:, k))
      end do
   end function per_mass
end module tilting_pad
