!> The films of all pads of a bearing with slopes (sloped_gap).
module sloped_film
   use kinds, only: wp
   use film_solver, only: film_law_type, film_ok, film_closed, cavitation_none, cavitation_gumbel, &
      & cavitation_reynolds, film_counters
   use direct_film, only: share_of_modes
   use following_film, only: following_angles
   use sloped_volumes, only: sloped_volumes_type, new_sloped_volumes
   use weighted_film, only: weighted_film_type, new_weighted_film
   use film_losses, only: film_loss
   use pad_gap, only: pad_gap_type, pad_directions
   use sloped_gap, only: sloped_motion, sloped_response, edge_films
   implicit none (type, external)
   private
   public :: sloped_film_type, sloped_motion, sloped_response, edge_films, new_sloped_film

   !> Functions along the arc and across the width, from the coarsest to the finest.
   integer, parameter :: levels = 5, along(levels) = [4, 6, 8, 12, 20], across(levels) = [5, 5, 7, 9, 11]
   !> Least film thickness over the clearance from which on a level may do; share of the last functions in the power up
   !> to which it does.
   real(wp), parameter :: thickness(levels) = [0.3_wp, 0.15_wp, 0.08_wp, 0.04_wp, 0.0_wp], enough = 2e-3_wp
   !> Columns and rows of the volumes of films that cavitate; on half as many each way the film is solved as well.
   integer, parameter :: columns = 48, rows = 16
   !> How far below the cavitation pressure a full film may fall, over its highest pressure, before it counts as
   !> cavitated (direct_film): as much as weighted functions err beside edges.
   real(wp), parameter :: slight_tension = 2e-3_wp
   !> Films thinner than this, over the clearance, count as closed (film_solver).
   real(wp), parameter :: thinnest = 1e-9_wp

   type :: sloped_film_type
      type(pad_gap_type), allocatable :: gaps(:)
      type(pad_directions), allocatable :: directions(:)
      !> Condition of cavitation (film_solver): its own, and the one in force.
      integer :: own_condition = cavitation_none, condition = cavitation_none
      !> Full films, made when they are asked for, (level, pad), and the level of the last one.
      type(weighted_film_type), allocatable, private :: full(:, :)
      integer, allocatable, private :: level(:)
      !> Volumes of films that cavitate, on two grids, (grid, pad).
      type(sloped_volumes_type), allocatable, private :: volumes(:, :)
      type(film_counters) :: counters
   contains
      procedure :: evaluate_pad
      procedure :: field_of_pad
      procedure :: find_loss
      procedure :: cavitates
      procedure :: set_cavitation
      procedure :: forget
   end type sloped_film_type

contains

   !> For these gaps, with a condition of cavitation.
   type(sloped_film_type) function new_sloped_film(gaps, condition) result(self)
      type(pad_gap_type), intent(in) :: gaps(:)
      integer, intent(in) :: condition
      integer :: i
      self%gaps = gaps
      self%directions = gaps%directions()
      self%own_condition = condition
      self%condition = condition
      allocate (self%full(levels, size(gaps)))
      allocate (self%level(size(gaps)), source=1)
      if (condition /= cavitation_reynolds) return
      allocate (self%volumes(2, size(gaps)))
      do i = 1, size(gaps)
         self%volumes(1, i) = new_sloped_volumes(gaps(i), columns/2, rows/2)
         self%volumes(2, i) = new_sloped_volumes(gaps(i), columns, rows)
      end do
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
      response%edge_films = edge_films(self%gaps(i), self%directions(i), motion)
      response%film%min_film_thickness = minval(response%edge_films)
      if (.not. response%film%min_film_thickness > thinnest*self%gaps(i)%machined_clearance) then
         response%film%status = film_closed
         return
      end if
      call find_full(self, i, motion, oil, speed, want_derivatives, response)
      if (is_cavitated(self, i, response)) call take_volumes(self, i, motion, oil, speed, want_derivatives, response)
   end subroutine evaluate_pad

   !> Whether a full film cavitates by the condition of Reynolds.
   pure logical function is_cavitated(self, i, full)
      class(sloped_film_type), intent(in) :: self
      integer, intent(in) :: i
      type(sloped_response), intent(in) :: full
      associate (lowest => self%gaps(i)%cavitation_pressure)
         is_cavitated = self%condition == cavitation_reynolds .and. lowest - full%film%min_pressure &
            & > slight_tension*(full%film%max_pressure - lowest)
      end associate
   end function is_cavitated

   !> Makes the response of a full film that of its cavitated film, as direct_film does.
   subroutine take_volumes(self, i, motion, oil, speed, want_derivatives, response)
      class(sloped_film_type), intent(inout) :: self
      integer, intent(in) :: i
      type(sloped_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: speed
      logical, intent(in) :: want_derivatives
      type(sloped_response), intent(inout) :: response
      type(sloped_response) :: full, found(2), whole(2)
      real(wp) :: c
      integer :: k
      full = response
      c = share_of_modes(self%gaps(i)%cavitation_pressure, full%film)
      do k = 1, 2
         associate (volumes => self%volumes(k, i))
            call volumes%set_motion(following_angles(self%gaps(i), motion%middle, speed, k*columns/4), motion, oil, speed)
            if (c > 0) call volumes%evaluate(.false., want_derivatives, self%counters, whole(k))
            call volumes%evaluate(.true., want_derivatives, self%counters, found(k))
         end associate
      end do
      response%film%status = maxval(found%film%status)
      response%film%min_pressure = self%gaps(i)%cavitation_pressure
      response%place = found(2)%place
      call add(response, full, c - 1)
      call add(response, found(2), 4/3.0_wp)
      call add(response, found(1), -1/3.0_wp)
      if (.not. c > 0) return
      call add(response, whole(2), -4*c/3)
      call add(response, whole(1), c/3)
   end subroutine take_volumes

   !> Adds a share of another film.
   pure subroutine add(film, other, share)
      type(sloped_response), intent(inout) :: film
      type(sloped_response), intent(in) :: other
      real(wp), intent(in) :: share
      film%film%force = film%film%force + share*other%film%force
      film%film%max_pressure = film%film%max_pressure + share*other%film%max_pressure
      film%moment = film%moment + share*other%moment
      film%derivatives = film%derivatives + share*other%derivatives
   end subroutine add

   !> What two grids, the second twice as fine, tell of one that is infinitely fine.
   elemental real(wp) function extrapolated(coarse, fine)
      real(wp), intent(in) :: coarse, fine
      extrapolated = (4*fine - coarse)/3
   end function extrapolated

   !> The full film, on the first level that does.
   subroutine find_full(self, i, motion, oil, speed, want_derivatives, response)
      class(sloped_film_type), intent(inout) :: self
      integer, intent(in) :: i
      type(sloped_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: speed
      logical, intent(in) :: want_derivatives
      type(sloped_response), intent(inout) :: response
      real(wp) :: share
      associate (level => self%level(i))
         response%edge_films = edge_films(self%gaps(i), self%directions(i), motion)
         response%film%min_film_thickness = minval(response%edge_films)
         level = findloc(response%film%min_film_thickness > thickness*self%gaps(i)%machined_clearance, .true., dim=1)
         do
            if (.not. self%full(level, i)%is_made()) then
               self%full(level, i) = new_weighted_film(self%gaps(i), along(level), across(level))
            end if
            call self%full(level, i)%evaluate(motion, oil, speed, self%condition == cavitation_gumbel, &
               & want_derivatives, response, share)
            if (share <= enough .or. level == levels) exit
            level = level + 1
         end do
      end associate
   end subroutine find_full

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
      type(film_counters) :: counters
      integer :: j, k
      call find_full(self, i, motion, oil, speed, .false., response)
      if (is_cavitated(self, i, response)) then
         fine = new_sloped_volumes(self%gaps(i), 2*columns, 2*rows)
         call fine%set_motion(following_angles(self%gaps(i), motion%middle, speed, columns), motion, oil, speed)
         call fine%evaluate(.true., .false., counters, response)
      end if
      do j = 1, size(phi)
         do k = 1, size(z)
            if (is_cavitated(self, i, response)) then
               pressure(k, j) = fine%pressure_at(phi(j), z(k))
            else
               pressure(k, j) = self%full(self%level(i), i)%pressure_at(phi(j), z(k))
            end if
         end do
      end do
      if (self%condition /= cavitation_none) pressure = max(pressure, self%gaps(i)%cavitation_pressure)
   end subroutine field_of_pad

   !> Loss and flows of pad i (film_losses), by volumes on two grids; of a closed film only the status.
   subroutine find_loss(self, i, motion, oil, speed, loss)
      class(sloped_film_type), intent(inout) :: self
      integer, intent(in) :: i
      type(sloped_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: speed
      type(film_loss), intent(out) :: loss
      type(sloped_volumes_type) :: grids(2)
      type(sloped_response) :: response
      type(film_counters) :: counters
      type(film_loss) :: found(2)
      integer :: k
      loss%status = film_closed
      if (minval(edge_films(self%gaps(i), self%directions(i), motion)) <= thinnest*self%gaps(i)%machined_clearance) return
      do k = 1, 2
         grids(k) = new_sloped_volumes(self%gaps(i), k*columns, k*rows)
         call grids(k)%set_motion(following_angles(self%gaps(i), motion%middle, speed, k*columns/2), motion, oil, speed)
         if (k == 2) call grids(2)%start_from(grids(1))
         call grids(k)%evaluate(self%condition == cavitation_reynolds, .false., counters, response)
         if (self%condition == cavitation_gumbel) call grids(k)%drop_tension()
         call grids(k)%losses(oil, speed*self%gaps(i)%journal_radius, found(k))
      end do
      loss = film_loss(response%film%status, extrapolated(found(1)%force, found(2)%force), &
         & extrapolated(found(1)%couette, found(2)%couette), extrapolated(found(1)%pressure, found(2)%pressure), &
         & extrapolated(found(1)%wedge, found(2)%wedge), extrapolated(found(1)%inlet, found(2)%inlet), &
         & extrapolated(found(1)%outlet, found(2)%outlet), extrapolated(found(1)%side, found(2)%side), &
         & extrapolated(found(1)%unfed, found(2)%unfed))
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
      integer :: i, k
      if (.not. allocated(self%volumes)) return
      do i = 1, size(self%volumes, 2)
         do k = 1, size(self%volumes, 1)
            call self%volumes(k, i)%start_from()
         end do
      end do
   end subroutine forget
end module sloped_film
