!> Power that a film turns into heat, what turns the journal against it, and the flows through its edges
!> (docs/theory/heat.md).
!>
!> Shear makes mu U^2/h of heat by the sliding of the journal's surface (Couette) and h^3/(12 mu) |grad p|^2 by what
!> pressure drives. With the velocity w that drives the film (dimensionless_pad) the second integrates to -w . F, F the
!> force of the pressure above that of cavitation, plus the power of the flows through edges under pressure; this holds
!> for cavitated films too. Of a full film the first is Sommerfeld's variable along the arc, and what pressure drives
!> through an edge is, by reciprocity, the force of a unit of pressure there, times w.
!>
!> Where a film cavitates, film-adapted finite volumes give the force and the flows with and without cavitation, and
!> how far the cavitated part is filled.
module film_losses
   use kinds, only: wp, pi
   use film_solver, only: film_motion, film_law_type, film_response, film_counters, film_ok, cavitation_none, &
      & cavitation_reynolds
   use pad_gap, only: pad_gap_type, pad_directions, over_arc
   use film_law, only: law_at_nodes
   use film_grid, only: film_grid_type
   use elimination_film, only: elimination_film_type
   use direct_film, only: is_cavitated, share_of_modes
   use following_film, only: new_following_grid
   use fourier_film, only: fourier_film_type, converged_film
   use sommerfeld_nodes, only: span
   use volume_flows, only: volume_flow_type, flows_of_volumes, finer
   implicit none (type, external)
   private
   public :: film_losses_type, film_loss, new_film_losses

   !> Error of forces by modes over themselves.
   real(wp), parameter :: tolerance = 1e-5_wp

   !> Rows of volumes that are enough; a film on half as many serves to extrapolate.
   integer, parameter :: enough_rows = 12

   !> Step of the integral of the shear of sliding, rad: a twentieth of the width of a film at 0.99 of the clearance.
   real(wp), parameter :: step = 2*pi/1000

   type :: film_loss
      integer :: status = film_ok
      !> On the journal in the pad frame, N.
      real(wp) :: force(2) = 0
      !> Heat made by shear of sliding and of pressure flow; power by which the pressure resists the journal's rotation
      !> (the shear of sliding does so with all its heat), W.
      real(wp) :: couette = 0, pressure = 0, wedge = 0
      !> Flow in at the leading edge, out at the trailing edge and out at both sides, m^3/s.
      real(wp) :: inlet = 0, outlet = 0, side = 0
      !> What a film takes up downstream of a cavitation beyond what arrives there, m^3/s.
      real(wp) :: unfed = 0
   end type film_loss

   !> One pad's.
   type :: film_losses_type
      private
      type(pad_gap_type) :: gap
      type(pad_directions) :: directions
      !> The full film; that of a pressure of 1 Pa at the leading and, in a mirror, at the trailing edge.
      type(fourier_film_type) :: full, leading, trailing
      !> Of cavitation.
      integer :: condition
   contains
      procedure :: find
      procedure, private :: full_film
      procedure, private :: varied_film
      procedure, private :: add_cavitation
      procedure, private :: set_heat
   end type film_losses_type

contains

   !> For the films in a gap that cavitate by this condition.
   pure type(film_losses_type) function new_film_losses(gap, condition) result(self)
      type(pad_gap_type), intent(in) :: gap
      integer, intent(in) :: condition
      type(pad_gap_type) :: edge
      self%gap = gap
      self%directions = gap%directions()
      self%condition = condition
      self%full = converged_film(gap, .false., tolerance)
      edge = gap
      edge%supply_pressure = 1
      edge%ambient_pressure = 0
      edge%cavitation_pressure = 0
      self%leading = converged_film(edge, .false., tolerance)
      edge%leading_angle = gap%trailing_angle
      edge%trailing_angle = gap%leading_angle
      self%trailing = converged_film(edge, .false., tolerance)
   end function new_film_losses

   !> Loss and flows at a motion and a journal speed, rad/s. Where the film is closed only the status is set.
   subroutine find(self, motion, oil, speed, loss)
      class(film_losses_type), intent(inout) :: self
      type(film_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: speed
      type(film_loss), intent(out) :: loss
      type(film_response) :: response
      type(volume_flow_type) :: driven
      call self%full%evaluate_pad(1, motion, oil, speed, .false., response)
      loss%status = response%status
      if (loss%status /= film_ok) return
      if (oil%varies) then
         call self%varied_film(motion, oil, speed, response, loss)
         return
      end if
      driven%force = response%force
      call self%full_film(motion, oil, speed, driven, loss)
      if (self%condition /= cavitation_none .and. is_cavitated(self%gap%cavitation_pressure, response)) then
         call self%add_cavitation(motion, oil, speed, response, driven, loss)
      end if
      loss%force = driven%force
      call self%set_heat(motion, speed, driven, loss)
   end subroutine find

   !> Shear of sliding of the full film, what pressure drives in at its leading edge, and the other flows.
   subroutine full_film(self, motion, oil, speed, driven, loss)
      class(film_losses_type), intent(inout) :: self
      type(film_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: speed
      type(volume_flow_type), intent(inout) :: driven
      type(film_loss), intent(inout) :: loss
      type(film_response) :: response
      real(wp) :: w(2), thickness(2), out, flows(2)
      associate (gap => self%gap, d => self%directions, radius => self%gap%pad_radius(), &
         & surface => speed*self%gap%journal_radius)
         loss%couette = oil%viscosity*surface**2*radius*gap%axial_length/gap%machined_clearance &
            & *span(motion%position/gap%machined_clearance, d%middle, d%half)
         w = motion%velocity + wedge_velocity(self, motion, speed)
         associate (mirror => [-1.0_wp, 1.0_wp])
            call self%trailing%evaluate_pad(1, film_motion(mirror*motion%position), oil, 0.0_wp, .false., response)
            out = -dot_product(w, mirror*response%force)
         end associate
         call self%leading%evaluate_pad(1, film_motion(motion%position), oil, 0.0_wp, .false., response)
         driven%inlet = dot_product(w, response%force)
         associate (rise => gap%supply_pressure - gap%ambient_pressure)
            if (abs(rise) > 0) then
               flows = rise*self%leading%supply_flows(oil)
               driven%inlet = driven%inlet + flows(1)
               out = out + flows(2)
            end if
         end associate
         thickness = gap%thickness(motion, [d%leading(1), d%trailing(1)], [d%leading(2), d%trailing(2)])
         loss%outlet = surface*thickness(2)*gap%axial_length/2 + out
         ! the rest leaves at the sides, less what the growing gap takes up
         loss%side = surface*thickness(1)*gap%axial_length/2 + driven%inlet - loss%outlet + radius*gap%axial_length &
            & *dot_product(motion%velocity, over_arc(d))
      end associate
   end subroutine full_film

   !> Loss and flows of a film whose law varies, all by volumes: what drives it is no longer one velocity.
   subroutine varied_film(self, motion, oil, speed, fourier, loss)
      class(film_losses_type), intent(inout) :: self
      type(film_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: speed
      !> That of the modes.
      type(film_response), intent(in) :: fourier
      type(film_loss), intent(inout) :: loss
      type(volume_flow_type) :: full(2), found(2)
      type(law_at_nodes) :: at_edge
      logical :: cavitates
      cavitates = self%condition /= cavitation_none .and. is_cavitated(self%gap%cavitation_pressure, fourier)
      call on_two_grids(self, motion, oil, speed, cavitates, full, found, loss)
      associate (gap => self%gap, d => self%directions, surface => speed*self%gap%journal_radius, &
         & r => finer(found(1), found(2)))
         call oil%at_nodes(gap, motion, d%leading(1:1), d%leading(2:2), at_edge)
         loss%force = r%force
         if (.not. cavitates) loss%force = fourier%force
         loss%couette = surface**2*sliding_shear(gap, motion, oil) - r%lacking
         loss%pressure = r%heat
         loss%wedge = r%wedge
         loss%inlet = surface*at_edge%sliding(1)/2*gap%thickness(motion, d%leading(1), d%leading(2))*gap%axial_length &
            & + r%inlet
         loss%outlet = r%outlet
         loss%side = r%side
         loss%unfed = r%unfed
      end associate
   end subroutine varied_film

   !> Films of film-adapted volumes, full and, where it cavitates, cavitated, on a grid and on one of twice as many
   !> rows, in which cavitation starts from what it was on the first.
   subroutine on_two_grids(self, motion, oil, speed, cavitates, full, cavitated, loss)
      class(film_losses_type), intent(inout) :: self
      type(film_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: speed
      logical, intent(in) :: cavitates
      type(volume_flow_type), intent(inout) :: full(2), cavitated(2)
      type(film_loss), intent(inout) :: loss
      type(elimination_film_type) :: volumes(2)
      type(film_grid_type) :: grid
      type(film_response) :: response
      type(film_counters) :: counters
      real(wp), allocatable :: pressure(:, :), film(:, :)
      integer :: k
      associate (surface => speed*self%gap%journal_radius)
         do k = 1, 2
            volumes(k) = new_following_grid(self%gap, motion, speed, k*(enough_rows/2))
            call volumes(k)%evaluate(motion, oil, speed, .false., .false., counters, response)
            call volumes(k)%cells(grid, pressure, film)
            full(k) = flows_of_volumes(grid, oil, surface, pressure, film > 0)
            if (.not. cavitates) then
               cavitated(k) = full(k)
            else if (self%condition == cavitation_reynolds) then
               if (k == 2) call volumes(k)%start_from(volumes(1))
               call volumes(k)%evaluate(motion, oil, speed, .true., .false., counters, response)
               call volumes(k)%cells(grid, pressure, film)
               cavitated(k) = flows_of_volumes(grid, oil, surface, pressure, film > 0)
            else
               cavitated(k) = flows_of_volumes(grid, oil, surface, pressure, pressure > 0)
            end if
            loss%status = max(loss%status, response%status)
         end do
      end associate
   end subroutine on_two_grids

   !> Integral of S mu/h over the area of a full film, N s/m, by Simpson's rule.
   pure real(wp) function sliding_shear(gap, motion, oil)
      type(pad_gap_type), intent(in) :: gap
      type(film_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      real(wp), allocatable :: phi(:), weight(:)
      integer :: n, i
      n = 2*ceiling(gap%arc()/(2*step))
      allocate (phi(0:n), weight(0:n))
      phi(:) = [(i*gap%arc()/n - gap%trailing_angle, i=0, n)]
      weight(:) = [(2 + 2*mod(i, 2), i=0, n)]
      weight([0, n]) = 1
      sliding_shear = oil%viscosity*gap%pad_radius()*gap%axial_length*gap%arc()/(3*n) &
         & *sum(weight*oil%shear_weight(gap, motion, phi)/gap%thickness(motion, sin(phi), cos(phi)))
   end function sliding_shear

   !> The part of w that comes from the journal's rotation, m/s.
   pure function wedge_velocity(self, motion, speed)
      type(film_losses_type), intent(in) :: self
      type(film_motion), intent(in) :: motion
      real(wp), intent(in) :: speed
      real(wp) :: wedge_velocity(2)
      wedge_velocity = speed*self%gap%journal_radius/(2*self%gap%pad_radius())*[motion%position(2), -motion%position(1)]
   end function wedge_velocity

   !> Makes the film that of volumes with cavitation and, like direct_film, a share c of (modes - volumes without
   !> cavitation).
   subroutine add_cavitation(self, motion, oil, speed, fourier, driven, loss)
      class(film_losses_type), intent(inout) :: self
      type(film_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: speed
      !> That of the modes.
      type(film_response), intent(in) :: fourier
      type(volume_flow_type), intent(inout) :: driven
      type(film_loss), intent(inout) :: loss
      type(volume_flow_type) :: full(2), cavitated(2)
      real(wp) :: c
      call on_two_grids(self, motion, oil, speed, .true., full, cavitated, loss)
      c = share_of_modes(self%gap%cavitation_pressure, fourier)
      associate (w => finer(full(1), full(2)), r => finer(cavitated(1), cavitated(2)))
         driven%force = r%force + c*(driven%force - w%force)
         driven%inlet = r%inlet + c*(driven%inlet - w%inlet)
         driven%void = r%void
         loss%couette = loss%couette - r%lacking
         loss%outlet = r%outlet + c*(loss%outlet - w%outlet)
         loss%side = r%side + c*(loss%side - w%side)
         loss%unfed = r%unfed
      end associate
   end subroutine add_cavitation

   !> Flow in at the leading edge, heat of the pressure flow, and the pressure's resistance to rotation.
   pure subroutine set_heat(self, motion, speed, driven, loss)
      class(film_losses_type), intent(in) :: self
      type(film_motion), intent(in) :: motion
      real(wp), intent(in) :: speed
      type(volume_flow_type), intent(in) :: driven
      type(film_loss), intent(inout) :: loss
      real(wp) :: force(2), wedge(2), thickness
      associate (gap => self%gap, d => self%directions)
         wedge = wedge_velocity(self, motion, speed)
         thickness = gap%thickness(motion, d%leading(1), d%leading(2))
         loss%inlet = speed*gap%journal_radius*thickness*gap%axial_length/2 + driven%inlet
         force = driven%force + gap%ambient_pressure*gap%pad_radius()*gap%axial_length*over_arc(d)
         associate (rise => gap%supply_pressure - gap%ambient_pressure, surface => speed*gap%journal_radius)
            loss%wedge = -dot_product(wedge, force) - rise*surface*thickness*gap%axial_length/2
            loss%pressure = rise*driven%inlet - dot_product(motion%velocity + wedge, force &
               & - (gap%ambient_pressure - gap%cavitation_pressure)*driven%void)
         end associate
      end associate
   end subroutine set_heat
end module film_losses
