!> Equations of motion (1)-(4) of journal and pads as an ODE, with their linearisation; states as in
!> bearing_forces.
module equations_of_motion
   use kinds, only: wp, degree
   use scene, only: scene_type
   use contact_law, only: contact_law_type
   use bearing_forces, only: bearing_forces_type, init_forces, pad_outputs
   use arrow_system, only: arrow_matrix, new_arrow_matrix
   use kinematics, only: motion_slopes, to_global
   use contact_table, only: contact_table_type
   use components, only: new_law
   implicit none (type, external)
   private
   public :: bearing_model, new_bearing_model

   !> Columns of a pad's slopes: journal y, z, vy, vz, tilt, tilt rate, penetration, its rate.
   integer, parameter :: columns = 8, tilt = 5, tilt_rate = 6, penetration = 7

   type, extends(bearing_forces_type) :: bearing_model
      !> Natural size of each state.
      real(wp), allocatable :: scale(:)
      !> Inverse of the mass matrix of (3)-(4), (2, 2, pad): rates of tilt rate and penetration rate per
      !> moment and force. Tilting-only pads have no second row.
      real(wp), allocatable :: per_mass(:, :, :)
      !> From the last linearisation, without friction: slopes of the contact force (column, pad), of the
      !> film force and of the rates of tilt rate and penetration rate (2, column, pad), and the Jacobian.
      real(wp), allocatable, private :: contact_slopes(:, :), film_slopes(:, :, :), rate_slopes(:, :, :)
      type(arrow_matrix), private :: matrix
   contains
      procedure :: rhs
      procedure :: linearize
      procedure :: jacobian_times
      procedure :: solve
      procedure :: output
      !> The whole Jacobian at (t, y).
      procedure :: jacobian
      procedure, private :: add_friction
      !> The state with journal and pads at rest at given places, bristles undeflected.
      procedure :: at_rest
      !> Journal y, z and the tilts, each over its scale.
      procedure :: positions
   end type bearing_model

   !> Scale of the tilt rate over that at which Bengisu-Akay friction changes its direction.
   real(wp), parameter :: sticking_scale = 10

contains

   !> The model of a valid scene; with the contact's table of another model of the same pivots, if given.
   function new_bearing_model(scene, contact) result(model)
      type(scene_type), intent(in) :: scene
      type(contact_table_type), intent(in), optional :: contact
      type(bearing_model) :: model
      real(wp) :: coupling, determinant
      integer :: i, n
      call init_forces(model, scene, contact)
      model%scale = state_scales(model)
      n = scene%pad_count()
      model%matrix = new_arrow_matrix(model%states_per_pad, n)
      allocate (model%per_mass(2, 2, n), model%contact_slopes(columns, n), source=0.0_wp)
      allocate (model%film_slopes(2, columns, n), model%rate_slopes(2, columns, n), source=0.0_wp)
      do i = 1, n
         associate (mass => scene%pads%mass(i), inertia => scene%pads%inertia(i))
            if (model%radial) then
               ! coupled where C_xi /= 0
               coupling = mass*scene%pads%centre_tangential(i)
               determinant = inertia*mass - coupling**2
               model%per_mass(:, :, i) = reshape([mass, -coupling, -coupling, inertia], [2, 2])/determinant
            else
               model%per_mass(1, 1, i) = 1/inertia
            end if
         end associate
      end do
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
         associate (rates => matmul(self%per_mass(:, :, i), [self%loads(i)%moment, self%loads(i)%radial]))
            dydt(o + 2) = rates(1)
            if (self%radial) dydt(o + 3:o + 4) = [y(o + 4), rates(2)]
         end associate
         if (self%friction%has_bristle) dydt(self%bristle(i)) = self%loads(i)%friction%rate
      end do
      dydt(1:2) = y(3:4)
      dydt(3:4) = force/self%scene%rotor%mass
   end subroutine rhs

   !> Slopes of film and contact at (t, y), for `solve`.
   subroutine linearize(self, t, y, ok)
      class(bearing_model), intent(inout) :: self
      real(wp), intent(in) :: t, y(:)
      logical, intent(out) :: ok
      real(wp) :: force(2, columns), global(2, columns), moment(columns), radial(columns)
      integer :: i, k, m, offset

      call self%evaluate(t, y, .true., ok)
      if (.not. ok) return
      m = merge(4, 2, self%radial)
      associate (matrix => self%matrix)
         matrix%corner = 0
         matrix%corner(1, 3) = 1
         matrix%corner(2, 4) = 1
         do i = 1, size(self%places)
            offset = self%offset(i)
            associate (frame => self%frame(i), film => self%response(i), loads => self%loads(i), &
               & pads => self%scene%pads, weight => self%scene%pads%mass(i)*self%scene%rotor%gravity, &
               & rate => y(offset + 2))
               force = matmul(film%slope, motion_slopes(self%places(i), frame, self%motion(i), rate))
               self%film_slopes(:, :, i) = force
               radial = -force(2, :)
               radial(tilt) = radial(tilt) + weight*frame%c
               radial(tilt_rate) = radial(tilt_rate) + 2*pads%mass(i)*pads%centre_radial(i)*rate
               associate (contact => self%contact_slopes(:, i))
                  if (self%radial) then
                     contact = 0
                     contact(penetration) = loads%contact_slope
                  else
                     contact = merge(radial, 0.0_wp, loads%contact > 0)
                  end if
                  radial = radial - contact
               end associate
               moment = -force(1, :)*self%places(i)%centre_distance
               moment(tilt) = moment(tilt) + weight*(pads%centre_tangential(i)*frame%c + pads%centre_radial(i)*frame%s)
               do k = 1, columns
                  global(:, k) = to_global(frame, force(:, k))
                  self%rate_slopes(:, k, i) = matmul(self%per_mass(:, :, i), [moment(k), radial(k)])
               end do
               ! the frame turns with the pad
               global(:, tilt) = global(:, tilt) + to_global(frame, [-film%force(2), film%force(1)])
               global = global/self%scene%rotor%mass
               matrix%corner(3:4, :) = matrix%corner(3:4, :) + global(:, :4)
               matrix%across(3:4, :m, i) = global(:, 5:4 + m)
               matrix%block(1, 2, i) = 1
               if (self%radial) matrix%block(3, 4, i) = 1
            end associate
         end do
      end associate
   end subroutine linearize

   !> Puts the rates' slopes, with those of friction in the state evaluated last, into the Jacobian.
   subroutine add_friction(self)
      class(bearing_model), intent(inout) :: self
      real(wp) :: moment(columns), rates(2, columns)
      integer :: i, m
      m = merge(4, 2, self%radial)
      associate (matrix => self%matrix, bristle => self%states_per_pad)
         do i = 1, size(self%places)
            associate (friction => self%loads(i)%friction, per_moment => self%per_mass(:, 1, i))
               moment = -self%ball_radius*friction%force_normal*self%contact_slopes(:, i)
               moment(tilt_rate) = moment(tilt_rate) - self%ball_radius**2*friction%force_velocity
               rates(1, :) = self%rate_slopes(1, :, i) + per_moment(1)*moment
               rates(2, :) = self%rate_slopes(2, :, i) + per_moment(2)*moment
               matrix%down(2, :, i) = rates(1, :4)
               matrix%block(2, :m, i) = rates(1, 5:4 + m)
               if (self%radial) then
                  matrix%down(4, :, i) = rates(2, :4)
                  matrix%block(4, :4, i) = rates(2, 5:)
               end if
               if (self%friction%has_bristle) then
                  matrix%block(2:m:2, bristle, i) = -self%ball_radius*friction%force_deflection*per_moment(:m/2)
                  matrix%block(bristle, 2, i) = friction%rate_velocity*self%ball_radius
                  matrix%block(bristle, bristle, i) = friction%rate_deflection
               end if
            end associate
         end do
      end associate
   end subroutine add_friction

   !> J v, with film and contact as linearised last and friction as evaluated last.
   subroutine jacobian_times(self, v, jv)
      class(bearing_model), intent(inout) :: self
      real(wp), intent(in) :: v(:)
      real(wp), intent(out) :: jv(:)
      call self%add_friction()
      jv = matmul(self%matrix%dense(), v)
   end subroutine jacobian_times

   !> b := (1 - gamma J)^(-1) b, with film and contact as linearised last and friction as evaluated last:
   !> Newton's iteration then crosses the kinks of friction, where old slopes would lead it astray.
   subroutine solve(self, gamma, b, ok)
      class(bearing_model), intent(inout) :: self
      real(wp), intent(in) :: gamma
      real(wp), intent(inout) :: b(:)
      logical, intent(out) :: ok
      call self%add_friction()
      call self%matrix%solve(gamma, b, ok)
   end subroutine solve

   !> Of every pad film force and highest pressure as evaluated last, the force with what a correction of that
   !> state adds to first order: where the pivot is without friction the tangential force is a small
   !> difference.
   pure function output(self, correction)
      class(bearing_model), intent(in) :: self
      real(wp), intent(in) :: correction(:)
      real(wp) :: output(self%outputs), change(columns)
      integer :: i, m
      m = merge(4, 2, self%radial)
      change = 0
      change(:4) = correction(:4)
      do i = 1, size(self%response)
         associate (film => self%response(i), o => self%offset(i))
            change(5:4 + m) = correction(o + 1:o + m)
            output(pad_outputs*(i - 1) + 1:pad_outputs*i) = &
               & [film%force + matmul(self%film_slopes(:, :, i), change), film%max_pressure]
         end associate
      end do
   end function output

   subroutine jacobian(self, t, y, matrix, ok)
      class(bearing_model), intent(inout) :: self
      real(wp), intent(in) :: t, y(:)
      real(wp), intent(out) :: matrix(:, :)
      logical, intent(out) :: ok
      call self%linearize(t, y, ok)
      if (.not. ok) return
      call self%add_friction()
      matrix = self%matrix%dense()
   end subroutine jacobian
end module equations_of_motion
