!> What a cavitated film is worth: the velocity v that would drive the same film, if it were whole, to the same force.
!> For w = (1, w_2), with F the force of the cavitated film and M w that of the whole one, v = M^(-1) F.
!>
!> Both forces come from the same discretisation, so that most of its error is not in v. With the condition of Reynolds
!> these are finite volumes: half of their columns lie where the film diverges, all of them are narrow where it is
!> thin, two grids are extrapolated by Richardson's rule, and slopes are those of a film that ends between cells. Where
!> the film has gone from whole columns at the trailing edge, these are given to what is left of it. With Guembel's
!> condition they are axial modes. Every film is solved from the same start: the answer does not depend on what came
!> before.
module effective_velocity
   use kinds, only: wp
   use linear_algebra, only: solve_2x2
   use film_solver, only: film_motion, film_response, film_counters, film_ok
   use dimensionless_pad, only: dimensionless_pad_type, unit_oil
   use film_grid, only: new_film_grid
   use elimination_film, only: elimination_film_type, new_elimination_film
   use fourier_film, only: fourier_film_type, converged_film
   implicit none (type, external)
   private
   public :: effective_velocity_type, drive_type, new_effective_velocity, least_tolerance

   !> Columns and rows of the finer grid for a tolerance of 4e-5, and of any; the error falls with their squares.
   integer, parameter :: base_columns = 56, base_rows = 8, most_rows = 48
   real(wp), parameter :: base_tolerance = 4e-5_wp
   !> What the finest grid keeps to.
   real(wp), parameter :: least_tolerance = base_tolerance*(real(base_rows, wp)/most_rows)**2
   !> Share of the columns where the film diverges or has gone, and where it has gone.
   real(wp), parameter :: diverging_share = 0.5_wp, empty_share = 1.0_wp/32
   !> This number of columns beside the film count as part of it.
   integer, parameter :: margin = 3

   !> A solver for one pad.
   type :: effective_velocity_type
      private
      type(dimensionless_pad_type) :: pad
      logical :: gumbel
      integer :: columns, rows
      !> The finer and the coarser grid, once they are needed: what the grids of all films have in common.
      type(elimination_film_type), allocatable :: grids(:)
      !> Guembel's: clipped and whole.
      type(fourier_film_type) :: clipped, whole
   contains
      procedure :: at
   end type effective_velocity_type

   !> The answer for one film.
   type :: drive_type
      !> v, and its derivatives over the thicknesses at both edges and w_2, (component, variable).
      real(wp) :: value(2) = 0, slopes(2, 3) = 0
      !> M over the force of the film that is just whole, w_2 = tan(half the arc).
      real(wp) :: weight(2, 2) = 0
      !> Highest pressure of the full film that is driven by v over that of the cavitated one.
      real(wp) :: pressure_ratio = 1
      logical :: ok = .false.
   end type drive_type

contains

   !> For films of a pad, to a tolerance over the force of the film that is just whole.
   function new_effective_velocity(pad, gumbel, tolerance) result(solver)
      type(dimensionless_pad_type), intent(in) :: pad
      logical, intent(in) :: gumbel
      real(wp), intent(in) :: tolerance
      type(effective_velocity_type) :: solver
      real(wp) :: refinement
      solver%pad = pad
      solver%gumbel = gumbel
      refinement = sqrt(max(1.0_wp, base_tolerance/tolerance))
      solver%rows = min(most_rows, 2*nint(0.5_wp*base_rows*refinement))
      solver%columns = solver%rows*(base_columns/base_rows)
      if (gumbel) then
         solver%clipped = converged_film(pad%gap(0.0_wp), .true., tolerance)
         solver%whole = converged_film(pad%gap(0.0_wp), .false., tolerance)
      end if
   end function new_effective_velocity

   !> The drive of a film with these thicknesses at its edges and w = (1, w_2); not ok where it is closed.
   type(drive_type) function at(self, edges, w_2) result(drive)
      class(effective_velocity_type), intent(inout) :: self
      real(wp), intent(in) :: edges(2), w_2
      type(film_motion) :: motion
      motion = film_motion(self%pad%position(edges), [1.0_wp, w_2])
      associate (gap => self%pad%gap(0.0_wp))
         if (.not. gap%min_film_thickness(motion, gap%directions()) > 0) return
      end associate
      if (self%gumbel) then
         drive = by_modes(self, motion)
      else
         if (.not. allocated(self%grids)) call make_grids(self)
         drive = by_volumes(self, motion)
      end if
      drive%slopes(1, :2) = self%pad%over_edges(drive%slopes(1, :2))
      drive%slopes(2, :2) = self%pad%over_edges(drive%slopes(2, :2))
   end function at

   subroutine make_grids(self)
      class(effective_velocity_type), intent(inout) :: self
      integer :: part
      allocate (self%grids(2))
      do part = 1, 2
         self%grids(part) = new_elimination_film(self%pad%gap(0.0_wp), self%columns/part, self%rows/part)
         self%grids(part)%ends_between = .true.
      end do
   end subroutine make_grids

   !> The drive by finite volumes on two grids, extrapolated; slopes over the position.
   function by_volumes(self, motion) result(drive)
      type(effective_velocity_type), intent(in) :: self
      type(film_motion), intent(in) :: motion
      type(drive_type) :: drive, coarse_drive
      type(elimination_film_type) :: coarse, fine, coarse_whole, fine_whole
      type(film_response) :: coarse_cavitated, cavitated
      type(film_counters) :: unused
      real(wp) :: line(0:self%columns/2), rim
      integer :: empty
      line = angles(self%pad, motion, -self%pad%half_arc, self%columns/2, 1)
      call make_grid(self, line, 2, coarse_whole)
      call make_grid(self, angles(self%pad, motion, -self%pad%half_arc, self%columns/2, 2), 1, fine_whole)
      call coarse_whole%evaluate(motion, unit_oil, 0.0_wp, .true., .true., unused, coarse_cavitated)
      empty = coarse_whole%empty_columns() - margin
      if (empty > 0) then
         rim = line(empty)
         call make_grid(self, angles(self%pad, motion, rim, self%columns/2, 1), 2, coarse)
         call make_grid(self, angles(self%pad, motion, rim, self%columns/2, 2), 1, fine)
         call coarse%evaluate(motion, unit_oil, 0.0_wp, .true., .true., unused, coarse_cavitated)
         call fine%start_from(coarse)
         call fine%evaluate(motion, unit_oil, 0.0_wp, .true., .true., unused, cavitated)
      else
         call fine_whole%start_from(coarse_whole)
         call fine_whole%evaluate(motion, unit_oil, 0.0_wp, .true., .true., unused, cavitated)
      end if
      call compare(self%pad, motion, coarse_cavitated, coarse_whole, coarse_drive)
      call compare(self%pad, motion, cavitated, fine_whole, drive)
      drive%ok = drive%ok .and. coarse_drive%ok
      drive%value = drive%value + (drive%value - coarse_drive%value)/3
      drive%slopes = drive%slopes + (drive%slopes - coarse_drive%slopes)/3
   end function by_volumes

   !> The grid with these angles between its columns, and a part of the columns and rows.
   subroutine make_grid(self, line, part, grid)
      type(effective_velocity_type), intent(in) :: self
      real(wp), intent(in) :: line(0:)
      integer, intent(in) :: part
      type(elimination_film_type), intent(out) :: grid
      grid = self%grids(part)
      grid%grid = new_film_grid(self%pad%gap(0.0_wp), self%columns/part, self%rows/part, line)
   end subroutine make_grid

   !> The drive of a cavitated film, by volumes on which the film is full.
   subroutine compare(pad, motion, cavitated, volumes, drive)
      type(dimensionless_pad_type), intent(in) :: pad
      type(film_motion), intent(in) :: motion
      type(film_response), intent(in) :: cavitated
      type(elimination_film_type), intent(inout) :: volumes
      type(drive_type), intent(inout) :: drive
      type(film_response) :: whole
      type(film_counters) :: unused
      call volumes%evaluate(motion, unit_oil, 0.0_wp, .false., .true., unused, whole)
      call set_drive(pad, cavitated, whole, drive)
      if (.not. drive%ok) return
      call volumes%drive_anew(film_motion(motion%position, drive%value), unit_oil, 0.0_wp, whole)
      call set_slopes(cavitated, whole, drive)
   end subroutine compare

   !> The drive by axial modes, with Guembel's condition; slopes over the position.
   function by_modes(self, motion) result(drive)
      class(effective_velocity_type), intent(inout) :: self
      type(film_motion), intent(in) :: motion
      type(drive_type) :: drive
      type(film_response) :: cavitated, whole
      call self%whole%evaluate_pad(1, motion, unit_oil, 0.0_wp, .true., whole)
      call self%clipped%evaluate_pad(1, motion, unit_oil, 0.0_wp, .true., cavitated)
      call set_drive(self%pad, cavitated, whole, drive)
      if (.not. drive%ok) return
      call self%whole%evaluate_pad(1, film_motion(motion%position, drive%value), unit_oil, 0.0_wp, .true., whole)
      call set_slopes(cavitated, whole, drive)
   end function by_modes

   !> v and the weight. The derivatives of the full film's force over the velocity are M.
   pure subroutine set_drive(pad, cavitated, whole, drive)
      type(dimensionless_pad_type), intent(in) :: pad
      type(film_response), intent(in) :: cavitated, whole
      type(drive_type), intent(inout) :: drive
      drive%ok = cavitated%status == film_ok .and. whole%status == film_ok
      if (.not. drive%ok) return
      associate (m => whole%derivatives(:, 3:4))
         drive%value = solve_2x2(m, cavitated%force)
         drive%weight = m/norm2(m(:, 1) + pad%tangent*m(:, 2))
      end associate
   end subroutine set_drive

   !> Derivatives of v = M^(-1) F: M^(-1) (dF - dM v); `whole` is the film driven by v.
   pure subroutine set_slopes(cavitated, whole, drive)
      type(film_response), intent(in) :: cavitated, whole
      type(drive_type), intent(inout) :: drive
      integer :: i
      associate (m => whole%derivatives(:, 3:4))
         do i = 1, 2
            drive%slopes(:, i) = solve_2x2(m, cavitated%derivatives(:, i) - whole%derivatives(:, i))
         end do
         drive%slopes(:, 3) = solve_2x2(m, cavitated%derivatives(:, 4))
      end associate
      if (cavitated%max_pressure > 0) drive%pressure_ratio = whole%max_pressure/cavitated%max_pressure
   end subroutine set_slopes

   !> Angles between the columns, rad, from the trailing to the leading edge, where the film has gone up to an angle
   !> `rim`; this many columns, each cut into this many parts.
   pure function angles(pad, motion, rim, columns, parts)
      type(dimensionless_pad_type), intent(in) :: pad
      type(film_motion), intent(in) :: motion
      real(wp), intent(in) :: rim
      integer, intent(in) :: columns, parts
      real(wp) :: angles(0:columns*parts), ends(0:3)
      integer :: last(0:3), i
      ! the film's end, and where the source of pressure changes its sign
      ends = [-pad%half_arc, rim, -atan2(motion%velocity(2), motion%velocity(1)), pad%half_arc]
      last = [0, merge(ceiling(empty_share*columns), 0, rim > -pad%half_arc), nint(diverging_share*columns), columns]
      last = parts*last
      do i = 1, 3
         if (last(i) == last(i - 1)) cycle
         angles(last(i - 1):last(i)) = pad%spread_angles(motion%position, ends(i - 1), ends(i), last(i) - last(i - 1))
      end do
   end function angles
end module effective_velocity
