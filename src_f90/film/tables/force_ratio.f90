!> What cavitation leaves of a film's force: the force of the cavitated film over that of the film in the same place
!> that is just full, both as complex numbers, whose quotient tells how much smaller the force is and how it has turned.
!>
!> Both forces come from the same discretisation, so that most of its error is not in the ratio. With the condition of
!> Reynolds these are finite volumes: half of their columns lie where the film diverges, all of them are narrow where
!> it is thin, two grids are extrapolated by Richardson's rule, and slopes are those of a film that ends between cells.
!> Where the film has gone from whole columns at the trailing edge, these are given to what is left of it. With
!> Guembel's condition they are axial modes. Where the rotation acts, D drives films, too (rotation_drive). Every film
!> is solved from the same start: the answer does not depend on what came before.
module force_ratio
   use kinds, only: wp
   use film_solver, only: film_motion, film_response, film_counters, film_ok
   use dimensionless_pad, only: dimensionless_pad_type
   use rotation_drive, only: rotation_drive_type
   use elimination_film, only: elimination_film_type, new_elimination_film
   use fourier_film, only: fourier_film_type, converged_film
   implicit none (type, external)
   private
   public :: force_ratio_solver, force_ratio_type, new_force_ratio_solver, least_tolerance

   !> Columns and rows of the finer grid for a tolerance of 4e-5, and of any; the error of what is extrapolated falls
   !> with their cubes (test_cavitation_table).
   integer, parameter :: base_columns = 70, base_rows = 10, least_rows = 6, most_rows = 48
   real(wp), parameter :: base_tolerance = 4e-5_wp
   !> What the finest grid keeps to.
   real(wp), parameter :: least_tolerance = base_tolerance*(real(base_rows, wp)/most_rows)**3
   !> Share of the columns where the film diverges or has gone, and where it has gone.
   real(wp), parameter :: diverging_share = 0.5_wp, empty_share = 1.0_wp/32
   !> This number of columns beside the film count as part of it. Where more than this share of the columns is empty,
   !> the grid is given anew to what is left of the film, but not more often than this.
   integer, parameter :: margin = 3, most_narrowed = 8
   real(wp), parameter :: empty_allowed = 1.0_wp/16

   !> A solver for one pad.
   type :: force_ratio_solver
      private
      type(dimensionless_pad_type) :: pad
      type(rotation_drive_type) :: drive
      logical :: gumbel
      integer :: columns, rows
      !> The finer and the coarser grid, once they are needed: what the grids of all films have in common.
      type(elimination_film_type), allocatable :: grids(:)
      !> The full film, and Guembel's.
      type(fourier_film_type) :: whole, clipped
   contains
      procedure :: at
   end type force_ratio_solver

   !> The answer for one film.
   type :: force_ratio_type
      !> Force over that of the film that is just full, w_2 = tan(half the arc), both as F_1 + i F_2.
      complex(wp) :: value = 1
      !> Its derivatives over the thicknesses at both edges and w_2, and over t.
      complex(wp) :: slopes(3) = 0, over_t = 0
      !> Highest pressure over that of the film that is just full at t = 0.
      real(wp) :: pressure = 1
      logical :: ok = .false.
   end type force_ratio_type

contains

   !> For films of a pad with its drive, with the condition of Reynolds or (without a D) Guembel, to a tolerance over
   !> the force.
   function new_force_ratio_solver(pad, drive, gumbel, tolerance) result(solver)
      type(dimensionless_pad_type), intent(in) :: pad
      type(rotation_drive_type), intent(in) :: drive
      logical, intent(in) :: gumbel
      real(wp), intent(in) :: tolerance
      type(force_ratio_solver) :: solver
      real(wp) :: refinement
      solver%pad = pad
      solver%drive = drive
      solver%gumbel = gumbel
      refinement = (base_tolerance/tolerance)**(1.0_wp/3)
      solver%rows = max(least_rows, min(most_rows, 2*nint(0.5_wp*base_rows*refinement)))
      solver%columns = solver%rows*(base_columns/base_rows)
      solver%whole = converged_film(drive%gap, .false., tolerance)
      if (gumbel) solver%clipped = converged_film(drive%gap, .true., tolerance)
   end function new_force_ratio_solver

   !> The ratio of a film with these thicknesses at its edges, w = (1, w_2) and, where the rotation acts, t; not ok
   !> where it is closed.
   type(force_ratio_type) function at(self, edges, w_2, t) result(ratio)
      class(force_ratio_solver), intent(inout) :: self
      real(wp), intent(in) :: edges(2), w_2, t
      type(film_motion) :: motion
      if (.not. self%pad%least_film(edges) > 0) return
      motion = film_motion(self%pad%position(edges), [1.0_wp, w_2])
      if (.not. w_2 < self%pad%tangent) then
         ratio = at_onset(self, motion, t)
      else if (self%gumbel) then
         ratio = by_modes(self, motion)
      else
         if (.not. allocated(self%grids)) call make_grids(self)
         ratio = by_volumes(self, motion, t)
      end if
      ratio%slopes(:2) = cmplx(self%pad%over_edges(real(ratio%slopes(:2))), &
         & self%pad%over_edges(aimag(ratio%slopes(:2))), wp)
   end function at

   subroutine make_grids(self)
      class(force_ratio_solver), intent(inout) :: self
      integer :: part
      allocate (self%grids(2))
      do part = 1, 2
         self%grids(part) = new_elimination_film(self%drive%gap, self%columns/part, self%rows/part)
         self%grids(part)%ends_between = .true.
      end do
   end subroutine make_grids

   !> The ratio of the film that is just full: what cavitates beyond it changes the force in a higher order.
   type(force_ratio_type) function at_onset(self, motion, t) result(ratio)
      class(force_ratio_solver), intent(inout) :: self
      type(film_motion), intent(in) :: motion
      real(wp), intent(in) :: t
      type(film_response) :: full, reference
      call self%whole%evaluate_pad(1, driven(self, motion, t), self%drive%oil, t*self%drive%speed_unit, .true., full)
      ratio%ok = full%status == film_ok
      if (.not. ratio%ok) return
      ratio%slopes(3) = complex_of(full%derivatives(:, 4))/complex_of(full%force)
      if (.not. self%drive%acts) return
      call self%whole%evaluate_pad(1, motion, self%drive%oil, 0.0_wp, .false., reference)
      ratio%pressure = full%max_pressure/reference%max_pressure
   end function at_onset

   !> The motion of the journal with this w.
   pure type(film_motion) function driven(self, motion, t)
      class(force_ratio_solver), intent(in) :: self
      type(film_motion), intent(in) :: motion
      real(wp), intent(in) :: t
      driven = motion
      if (self%drive%acts) driven%velocity = motion%velocity + t*self%drive%still(motion%position)
   end function driven

   !> The ratio by finite volumes on two grids, extrapolated; slopes over the position.
   type(force_ratio_type) function by_volumes(self, motion, t) result(ratio)
      class(force_ratio_solver), intent(inout) :: self
      type(film_motion), intent(in) :: motion
      real(wp), intent(in) :: t
      type(force_ratio_type) :: coarse_ratio
      type(film_response) :: coarse_cavitated, cavitated
      type(film_counters) :: unused
      real(wp) :: line(0:self%columns/2), rim, turn, speed
      complex(wp) :: coarse_over_t, fine_over_t, full_over_t
      integer :: gone, narrowed, given
      speed = t*self%drive%speed_unit
      rim = -self%pad%half_arc
      turn = self%drive%turning_angle(motion%position, motion%velocity, t)
      given = 0
      do narrowed = 0, most_narrowed
         line = angles(self%pad, motion, turn, rim, self%columns/2, 1)
         call set_grid(self, line, 2)
         call self%grids(2)%evaluate(driven(self, motion, t), self%drive%oil, speed, .true., .false., unused, &
            & coarse_cavitated)
         gone = self%grids(2)%empty_columns() - margin - given
         if (gone <= empty_allowed*self%columns/2) exit
         rim = line(given + gone)
         if (.not. rim < turn) return
         given = ceiling(empty_share*self%columns/2)
      end do
      call self%grids(2)%differentiate(coarse_cavitated)
      coarse_over_t = over_t(self%grids(2), coarse_cavitated)
      call set_grid(self, angles(self%pad, motion, turn, rim, self%columns/2, 2), 1)
      call self%grids(1)%start_from(self%grids(2))
      call self%grids(1)%evaluate(driven(self, motion, t), self%drive%oil, speed, .true., .true., unused, cavitated)
      fine_over_t = over_t(self%grids(1), cavitated)
      line = angles(self%pad, motion, turn, -self%pad%half_arc, self%columns/2, 1)
      call set_grid(self, line, 2)
      call set_grid(self, angles(self%pad, motion, turn, -self%pad%half_arc, self%columns/2, 2), 1)
      call compare(coarse_cavitated, coarse_over_t, self%grids(2), coarse_ratio)
      call compare(cavitated, fine_over_t, self%grids(1), ratio)
      ratio%ok = ratio%ok .and. coarse_ratio%ok
      if (.not. ratio%ok) return
      ! by Richardson's rule, of the logarithms
      ratio%slopes = 4*ratio%slopes/(3*ratio%value) - coarse_ratio%slopes/(3*coarse_ratio%value)
      ratio%over_t = 4*ratio%over_t/(3*ratio%value) - coarse_ratio%over_t/(3*coarse_ratio%value)
      ratio%value = ratio%value*exp(log(ratio%value/coarse_ratio%value)/3)
      ratio%slopes = ratio%value*ratio%slopes
      ratio%over_t = ratio%value*ratio%over_t
   contains
      subroutine compare(of_cavitated, of_t, volumes, found)
         type(film_response), intent(in) :: of_cavitated
         complex(wp), intent(in) :: of_t
         type(elimination_film_type), intent(inout) :: volumes
         type(force_ratio_type), intent(out) :: found
         type(film_response) :: full, reference
         call volumes%evaluate(driven(self, onset(self, motion), t), self%drive%oil, speed, .false., .true., unused, &
            & full)
         full_over_t = over_t(volumes, full)
         call set_ratio(of_cavitated, full, found)
         if (.not. self%drive%acts .or. .not. found%ok) return
         found%over_t = (of_t - found%value*full_over_t)/complex_of(full%force)
         call volumes%evaluate(onset(self, motion), self%drive%oil, 0.0_wp, .false., .false., unused, reference)
         found%pressure = of_cavitated%max_pressure/reference%max_pressure
      end subroutine compare

      !> The derivative of a force over t as w stays, and its derivatives over the position so, too.
      complex(wp) function over_t(volumes, film)
         type(elimination_film_type), intent(in) :: volumes
         type(film_response), intent(inout) :: film
         over_t = 0
         if (.not. self%drive%acts .or. film%status /= film_ok) return
         over_t = complex_of(volumes%over_speed()*self%drive%speed_unit &
            & + matmul(film%derivatives(:, 3:), self%drive%still(motion%position)))
         film%derivatives(:, :2) = film%derivatives(:, :2) - t*matmul(film%derivatives(:, 3:), self%drive%by_rotation())
      end function over_t
   end function by_volumes

   !> Places the columns of a grid, which has a part of the columns and rows, between these angles.
   subroutine set_grid(self, line, part)
      class(force_ratio_solver), intent(inout) :: self
      real(wp), intent(in) :: line(0:)
      integer, intent(in) :: part
      call self%grids(part)%grid%place_columns(line)
      call self%grids(part)%start_from()
   end subroutine set_grid

   !> The ratio by axial modes, with Guembel's condition; slopes over the position.
   type(force_ratio_type) function by_modes(self, motion) result(ratio)
      class(force_ratio_solver), intent(inout) :: self
      type(film_motion), intent(in) :: motion
      type(film_response) :: cavitated, full
      call self%whole%evaluate_pad(1, onset(self, motion), self%drive%oil, 0.0_wp, .true., full)
      call self%clipped%evaluate_pad(1, motion, self%drive%oil, 0.0_wp, .true., cavitated)
      call set_ratio(cavitated, full, ratio)
   end function by_modes

   !> The motion at which the film in this place is just full.
   pure type(film_motion) function onset(self, motion)
      class(force_ratio_solver), intent(in) :: self
      type(film_motion), intent(in) :: motion
      onset = film_motion(motion%position, [1.0_wp, self%pad%tangent])
   end function onset

   !> Ratio of two forces and of their highest pressures; slopes over the position and w_2.
   pure subroutine set_ratio(cavitated, full, ratio)
      type(film_response), intent(in) :: cavitated, full
      type(force_ratio_type), intent(inout) :: ratio
      ratio%ok = cavitated%status == film_ok .and. full%status == film_ok
      if (.not. ratio%ok) return
      associate (whole => complex_of(full%force))
         ratio%value = complex_of(cavitated%force)/whole
         ratio%slopes(1:2) = [complex_of(cavitated%derivatives(:, 1)), complex_of(cavitated%derivatives(:, 2))]/whole &
            & - ratio%value*[complex_of(full%derivatives(:, 1)), complex_of(full%derivatives(:, 2))]/whole
         ratio%slopes(3) = complex_of(cavitated%derivatives(:, 4))/whole
      end associate
      ratio%pressure = cavitated%max_pressure/full%max_pressure
   end subroutine set_ratio

   pure complex(wp) function complex_of(vector)
      real(wp), intent(in) :: vector(2)
      complex_of = cmplx(vector(1), vector(2), wp)
   end function complex_of

   !> Angles between the columns, rad, from the trailing to the leading edge, where the source of pressure changes its
   !> sign at an angle `turn` and the film has gone up to an angle `rim`; this many columns, each cut into this many
   !> parts.
   pure function angles(pad, motion, turn, rim, columns, parts)
      type(dimensionless_pad_type), intent(in) :: pad
      type(film_motion), intent(in) :: motion
      real(wp), intent(in) :: turn, rim
      integer, intent(in) :: columns, parts
      real(wp) :: angles(0:columns*parts), ends(0:3)
      integer :: last(0:3), i
      ends = [-pad%half_arc, rim, turn, pad%half_arc]
      last = [0, merge(ceiling(empty_share*columns), 0, rim > -pad%half_arc), nint(diverging_share*columns), columns]
      last = parts*last
      do i = 1, 3
         if (last(i) == last(i - 1)) cycle
         angles(last(i - 1):last(i)) = pad%spread_angles(motion%position, ends(i - 1), ends(i), last(i) - last(i - 1))
      end do
   end function angles
end module force_ratio
