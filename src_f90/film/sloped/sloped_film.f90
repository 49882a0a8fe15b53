!> The films of all pads of a bearing with slopes (docs/theory/pitch_and_yaw.md).
!>
!> Full films of oil of one viscosity between equal pressures are those of weighted functions, as many as a film needs.
!> All others are those of finite volumes, extrapolated from two grids; where such a film cavitates, with a share of the
!> difference of both full films, so that the force does not leap (direct_film).
module sloped_film
   use kinds, only: wp
   use film_solver, only: film_law_type, film_counters, film_closed, cavitation_none, thinnest
   use direct_film, only: share_of_modes
   use following_film, only: following_angles
   use film_losses, only: film_loss
   use pad_gap, only: pad_gap_type, pad_directions
   use sloped_gap, only: sloped_motion, sloped_response, edge_films
   use sloped_volumes, only: sloped_volumes_type, new_sloped_volumes
   use weighted_film, only: weighted_film_type, new_weighted_film
   implicit none (type, external)
   private
   public :: sloped_film_type, sloped_motion, sloped_response, new_sloped_film

   !> Functions along the arc and across the width, from the coarsest to the finest level, and the least film thickness,
   !> over the clearance, from which on a level may do. With twice as many of both forces of films as thick as that
   !> change by less than 1e-3, and by 1e-4 from twice this thickness on.
   integer, parameter :: levels = 5, along(levels) = [4, 6, 8, 12, 20], across(levels) = [5, 5, 7, 9, 11]
   real(wp), parameter :: thickness(levels) = [0.3_wp, 0.15_wp, 0.08_wp, 0.04_wp, 0.0_wp]
   !> Share of the last functions in the power up to which a level does.
   real(wp), parameter :: enough = 2e-3_wp
   !> Of films that have to be close: the first level; columns and rows of volumes, those of a march, and those where
   !> cavitation changes little in one: all of the change is theirs where three quarters of the full film are kept, and
   !> nothing of it where one is.
   integer, parameter :: close_level = 3, close_volumes(2) = [48, 16], march_volumes(2) = [24, 12], &
      & slight_volumes(2) = [16, 8]
   !> How far below the cavitation pressure a full film may fall, over its highest pressure, before it counts as
   !> cavitated (direct_film): as much as weighted functions err beside edges.
   real(wp), parameter :: slight_tension = 2e-3_wp

   type :: sloped_film_type
      type(pad_gap_type), allocatable :: gaps(:)
      type(pad_directions), allocatable :: directions(:)
      !> Condition of cavitation (film_solver): its own, and the one in force.
      integer :: own_condition = cavitation_none, condition = cavitation_none
      type(film_counters) :: counters
      !> Full films, made when they are asked for, (level, pad); the level of the last one, and the first to be tried.
      type(weighted_film_type), allocatable, private :: full(:, :)
      integer, private :: level = 1, first_level = 1
      !> Volumes, made likewise, on two grids for slight cavitation and two others, the second of each twice as fine,
      !> (grid, pad); columns and rows of the last one.
      type(sloped_volumes_type), allocatable, private :: volumes(:, :)
      integer, private :: cells(2) = march_volumes
   contains
      procedure :: evaluate_pad
      procedure :: field_of_pad
      procedure :: find_loss
      procedure :: cavitates
      procedure :: set_cavitation
      procedure :: forget
   end type sloped_film_type

contains

   !> For these gaps, with a condition of cavitation; `closely` (default: not): for what is not a march.
   type(sloped_film_type) function new_sloped_film(gaps, condition, closely) result(self)
      type(pad_gap_type), intent(in) :: gaps(:)
      integer, intent(in) :: condition
      logical, intent(in), optional :: closely
      self%gaps = gaps
      self%directions = gaps%directions()
      self%own_condition = condition
      self%condition = condition
      allocate (self%full(levels, size(gaps)), self%volumes(4, size(gaps)))
      if (.not. present(closely)) return
      if (closely) self%first_level = close_level
      if (closely) self%cells = close_volumes
   end function new_sloped_film

   !> The film of pad i at a motion, with an oil and a journal speed, rad/s.
   subroutine evaluate_pad(self, i, motion, oil, speed, want_derivatives, response)
      class(sloped_film_type), intent(inout) :: self
      integer, intent(in) :: i
      type(sloped_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: speed
      logical, intent(in) :: want_derivatives
      type(sloped_response), intent(out) :: response
      type(sloped_response) :: full
      response%edge_films = edge_films(self%gaps(i), self%directions(i), motion)
      response%film%min_film_thickness = minval(response%edge_films)
      if (.not. response%film%min_film_thickness > thinnest*self%gaps(i)%machined_clearance) then
         response%film%status = film_closed
      else if (.not. has_weights(self, i, oil)) then
         call add_volumes(self, i, motion, oil, speed, 0.0_wp, 1.0_wp, want_derivatives, response)
      else
         call find_full(self, i, motion, oil, speed, want_derivatives, response)
         self%counters%weighted = self%counters%weighted + 1
         if (.not. is_cavitated(self, i, response)) return
         full = response
         associate (c => share_of_modes(self%gaps(i)%cavitation_pressure, full%film), &
            & factor => min(1.0_wp, tension_of(self, i, full)/slight_tension - 1))
            call add(response, full, c - 1)
            response%film%max_pressure = c*full%film%max_pressure
            ! what volumes know grows from nothing, so that a march meets no leap
            call add_volumes(self, i, motion, oil, speed, c, factor, want_derivatives, response)
         end associate
      end if
   end subroutine evaluate_pad

   !> Whether weighted functions know the full film of a pad.
   pure logical function has_weights(self, i, oil)
      class(sloped_film_type), intent(in) :: self
      integer, intent(in) :: i
      class(film_law_type), intent(in) :: oil
      has_weights = .not. (oil%varies .or. abs(self%gaps(i)%supply_pressure - self%gaps(i)%ambient_pressure) > 0)
   end function has_weights

   !> Whether a full film cavitates.
   pure logical function is_cavitated(self, i, full)
      class(sloped_film_type), intent(in) :: self
      integer, intent(in) :: i
      type(sloped_response), intent(in) :: full
      is_cavitated = .false.
      if (self%cavitates()) is_cavitated = tension_of(self, i, full) > slight_tension
   end function is_cavitated

   !> How far a full film falls below the cavitation pressure, over how far it rises above it; at most 2.
   pure real(wp) function tension_of(self, i, full)
      class(sloped_film_type), intent(in) :: self
      integer, intent(in) :: i
      type(sloped_response), intent(in) :: full
      associate (below => self%gaps(i)%cavitation_pressure - full%film%min_pressure, &
         & above => full%film%max_pressure - self%gaps(i)%cavitation_pressure)
         tension_of = 2
         if (below < 2*above) tension_of = below/above
      end associate
   end function tension_of

   !> The full film, on the first level that does.
   subroutine find_full(self, i, motion, oil, speed, want_derivatives, response)
      class(sloped_film_type), intent(inout) :: self
      integer, intent(in) :: i
      type(sloped_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: speed
      logical, intent(in) :: want_derivatives
      !> Its least film thickness is set.
      type(sloped_response), intent(inout) :: response
      real(wp) :: last_share
      integer :: level
      level = findloc(response%film%min_film_thickness > thickness*self%gaps(i)%machined_clearance, .true., dim=1)
      do level = max(self%first_level, level), levels
         self%level = level
         associate (film => self%full(level, i))
            if (film%unknowns == 0) film = new_weighted_film(self%gaps(i), along(level), across(level))
            call film%evaluate(motion, oil%viscosity, speed, want_derivatives, response, last_share)
         end associate
         ! of a film that is nearly empty little counts
         if (is_cavitated(self, i, response)) last_share = last_share*share_of_modes(self%gaps(i)%cavitation_pressure, &
            & response%film)
         if (last_share <= enough) exit
      end do
   end subroutine find_full

   !> Adds the film by volumes, extrapolated from two grids, less a share of that without cavitation, times a factor.
   subroutine add_volumes(self, i, motion, oil, speed, share, factor, want_derivatives, response)
      class(sloped_film_type), intent(inout) :: self
      integer, intent(in) :: i
      type(sloped_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: speed, share, factor
      logical, intent(in) :: want_derivatives
      type(sloped_response), intent(inout) :: response
      type(sloped_response) :: full, found
      real(wp) :: weight, slight
      integer :: k
      self%counters%volumes = self%counters%volumes + 1
      slight = merge(min(1.0_wp, max(0.0_wp, 2*share - 0.5_wp)), 0.0_wp, all(self%cells == march_volumes))
      do k = 1, 4
         weight = factor*merge(slight, 1 - slight, k <= 2)*merge(-1, 4, modulo(k, 2) == 1)/3
         if (.not. abs(weight) > 0) cycle
         associate (film => self%volumes(k, i), cells => merge(slight_volumes, self%cells, k <= 2)/(1 + modulo(k, 2)))
            if (film%rows == 0) film = new_sloped_volumes(self%gaps(i), cells(1), cells(2))
            call film%set_motion(following_angles(self%gaps(i), motion%middle, speed, cells(1)/2), motion, oil, speed)
            if (share > 0) call film%evaluate(cavitation_none, want_derivatives, self%counters, full)
            if (share > 0) call add(response, full, -share*weight)
            call film%evaluate(self%condition, want_derivatives, self%counters, found)
            call add(response, found, weight)
         end associate
         response%film%status = max(response%film%status, found%film%status)
      end do
      response%film%min_pressure = found%film%min_pressure
      response%film%max_pressure = response%film%max_pressure + factor*found%film%max_pressure
      if (share > 0) response%film%max_pressure = response%film%max_pressure &
         & - factor*share*full%film%max_pressure
      if (share < 1) response%place = found%place
   end subroutine add_volumes

   !> Adds a share of another film to forces and derivatives.
   pure subroutine add(film, other, share)
      type(sloped_response), intent(inout) :: film
      type(sloped_response), intent(in) :: other
      real(wp), intent(in) :: share
      film%film%force = film%film%force + share*other%film%force
      film%moment = film%moment + share*other%moment
      film%derivatives = film%derivatives + share*other%derivatives
   end subroutine add

   !> Its pressure, Pa, (axial position, angle), at a motion that leaves it open.
   subroutine field_of_pad(self, i, motion, oil, speed, phi, z, pressure)
      class(sloped_film_type), intent(inout) :: self
      integer, intent(in) :: i
      type(sloped_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      !> Angles from the pivot, rad, and distances from the middle plane, m, on the pad.
      real(wp), intent(in) :: speed, phi(:), z(:)
      real(wp), intent(out) :: pressure(:, :)
      type(sloped_response) :: response
      type(sloped_volumes_type) :: fine
      integer :: j, k
      logical :: by_volumes
      by_volumes = .not. has_weights(self, i, oil)
      if (.not. by_volumes) then
         response%film%min_film_thickness = minval(edge_films(self%gaps(i), self%directions(i), motion))
         call find_full(self, i, motion, oil, speed, .false., response)
         by_volumes = is_cavitated(self, i, response)
      end if
      if (by_volumes) call make_fine(self, i, 2, motion, oil, speed, fine)
      do j = 1, size(phi)
         do k = 1, size(z)
            if (by_volumes) then
               pressure(k, j) = fine%pressure_at(phi(j), z(k))
            else
               pressure(k, j) = self%full(self%level, i)%pressure_at(motion, phi(j), z(k))
            end if
         end do
      end do
      if (self%cavitates()) pressure = max(pressure, self%gaps(i)%cavitation_pressure)
   end subroutine field_of_pad

   !> The film of pad i on a multiple of the volumes that are close.
   subroutine make_fine(self, i, times, motion, oil, speed, film, status)
      class(sloped_film_type), intent(in) :: self
      integer, intent(in) :: i, times
      type(sloped_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: speed
      type(sloped_volumes_type), intent(out) :: film
      integer, intent(out), optional :: status
      type(film_counters) :: counters
      type(sloped_response) :: response
      associate (cells => times*close_volumes)
         film = new_sloped_volumes(self%gaps(i), cells(1), cells(2))
         call film%set_motion(following_angles(self%gaps(i), motion%middle, speed, cells(1)/2), motion, oil, speed)
      end associate
      call film%evaluate(self%condition, .false., counters, response)
      if (present(status)) status = response%film%status
   end subroutine make_fine

   !> Loss and flows of pad i (film_losses), by volumes on two grids; of a closed film only the status.
   subroutine find_loss(self, i, motion, oil, speed, loss)
      class(sloped_film_type), intent(inout) :: self
      integer, intent(in) :: i
      type(sloped_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: speed
      type(film_loss), intent(out) :: loss
      type(sloped_volumes_type) :: grid
      type(film_loss) :: of(2)
      integer :: k, status
      loss%status = film_closed
      associate (least => minval(edge_films(self%gaps(i), self%directions(i), motion)))
         if (least <= thinnest*self%gaps(i)%machined_clearance) return
      end associate
      do k = 1, 2
         call make_fine(self, i, k, motion, oil, speed, grid, status)
         call grid%losses(oil, of(k))
      end do
      loss = film_loss(status, [finer(of%force(1)), finer(of%force(2))], finer(of%couette), finer(of%pressure), &
         & finer(of%wedge), finer(of%inlet), finer(of%outlet), finer(of%side), finer(of%unfed))
   contains
      !> What two grids, the second twice as fine, tell of one that is infinitely fine.
      pure real(wp) function finer(values)
         real(wp), intent(in) :: values(2)
         finer = (4*values(2) - values(1))/3
      end function finer
   end subroutine find_loss

   !> True where pressures below the cavitation pressure are not kept.
   pure logical function cavitates(self)
      class(sloped_film_type), intent(in) :: self
      cavitates = self%condition /= cavitation_none
   end function cavitates

   !> Lets films cavitate as the solver was made to, or keeps them full.
   pure subroutine set_cavitation(self, allowed)
      class(sloped_film_type), intent(inout) :: self
      logical, intent(in) :: allowed
      self%condition = merge(self%own_condition, cavitation_none, allowed)
   end subroutine set_cavitation

   !> Forgets the films that were solved last: what is solved then is the same to the last bit, wherever one comes from.
   pure subroutine forget(self)
      class(sloped_film_type), intent(inout) :: self
      ! volumes are made anew
      self%volumes%rows = 0
   end subroutine forget
end module sloped_film
