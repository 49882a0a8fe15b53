!> The cavitated film of a dimensionless pad of any arc, over its film of a strip (strip_film), both as complex forces:
!> the logarithm of their quotient and its slopes, at a place (-ln(1 - e), gamma, psi), e the eccentricity over the
!> pad clearance, gamma the angle of least film thickness, psi that of w.
!>
!> Oil converges within a quarter of a circle from psi, and there the pad has one film. Beside the edges of a long arc
!> it may have a second one, about psi less a turn; so psi may lie beyond half a turn, up to where the half circle
!> leaves the arc. Films are solved on finite volumes, each from its own start and on grids of its own, of which two
!> are extrapolated. With Guembel's condition there is one film, of axial modes.
module wide_arc_film
   use kinds, only: wp, pi
   use film_solver, only: film_motion, film_response, film_counters, film_ok
   use pad_gap, only: pad_gap_type
   use dimensionless_pad, only: dimensionless_pad_type, unit_oil
   use film_grid, only: new_film_grid
   use elimination_film, only: elimination_film_type, new_elimination_film
   use fourier_film, only: fourier_film_type, converged_film
   use strip_film, only: strip_type, strip_film_type, usual_steps, find_strip, solve_strip, solve_clipped_strip, &
      & angle_of
   use cell_store, only: node_type, node_solver_type, axes
   implicit none (type, external)
   private
   public :: wide_arc_film_type, strip_force_type, new_wide_arc_film, turned, vector_of

   !> Room beyond a free end of the strip's film: over the way from where oil begins to diverge, and rad of Sommerfeld's
   !> angle. Where the film takes all of it, it becomes twice as large, up to this number of times.
   real(wp), parameter :: beyond = 0.3_wp, more = 0.05_wp
   integer, parameter :: most_widened = 6
   !> Where the oil of a pad converges on less than this, rad, its film is not solved any more, but its functions
   !> continue along their slopes over psi.
   real(wp), parameter :: least_converging = 0.1_wp
   !> The least eccentricity that has a direction.
   real(wp), parameter :: least_e = 1e-12_wp
   !> Columns of volumes for every row.
   integer, parameter :: columns_a_row = 8
   !> Steps of the strip's film on the whole arc, and error of films by modes.
   integer, parameter :: clipped_steps = 2*usual_steps
   real(wp), parameter :: modes_error = 1e-6_wp

   type, extends(node_solver_type) :: wide_arc_film_type
      type(dimensionless_pad_type) :: pad
      !> psi from which on no oil converges on the arc; with Guembel's condition half a turn.
      real(wp) :: last_psi = 0
      logical :: gumbel = .false.
      integer, private :: rows = 0
      !> Once they are needed: the finer and the coarser grid, what the grids of all films have in common; or modes.
      type(elimination_film_type), allocatable, private :: grids(:)
      type(fourier_film_type), allocatable, private :: modes
   contains
      procedure :: solve
      procedure :: strip
      procedure :: solve_film
   end type wide_arc_film_type

   !> A force in the mid-arc frame, its derivatives over position and w, and the highest pressure.
   type :: strip_force_type
      complex(wp) :: force = 0, over_position(2) = 0, over_w(2) = 0
      real(wp) :: highest = 0
   end type strip_force_type

contains

   !> The films of a pad with the condition of Reynolds or of Guembel; with this number of rows of volumes.
   type(wide_arc_film_type) function new_wide_arc_film(pad, gumbel, rows) result(self)
      type(dimensionless_pad_type), intent(in) :: pad
      logical, intent(in) :: gumbel
      integer, intent(in) :: rows
      self%pad = pad
      self%gumbel = gumbel
      self%rows = rows
      self%last_psi = merge(pi, pad%half_arc + 0.5_wp*pi, gumbel)
   end function new_wide_arc_film

   !> The functions of a film.
   subroutine solve(self, place, counters, node)
      class(wide_arc_film_type), intent(inout) :: self
      real(wp), intent(in) :: place(axes)
      type(film_counters), intent(inout) :: counters
      type(node_type), intent(out) :: node
      type(strip_force_type) :: film, strip
      complex(wp) :: slopes(3), q
      real(wp) :: e, psi, outward(2), across(2)
      counters%nodes = counters%nodes + 1
      e = 1 - exp(-place(1))
      outward = [sin(place(2)), cos(place(2))]
      across = [outward(2), -outward(1)]
      psi = place(3)
      if (.not. self%gumbel) psi = min(psi, self%last_psi - least_converging)
      ! at e = 0 the direction of the slopes is that of gamma
      call self%solve_film(max(e, least_e)*outward, psi, film, node%ok)
      if (.not. node%ok) return
      strip = self%strip(max(e, least_e)*outward, 1.0_wp, psi, .true., .true.)
      slopes = [(1 - e)*over(outward, film%over_position, strip%over_position), &
         & e*over(across, film%over_position, strip%over_position), &
         & over([cos(psi), -sin(psi)], film%over_w, strip%over_w)]
      q = log(film%force/strip%force) + (place(3) - psi)*slopes(3)
      node%data = 0
      node%data(1, :4) = real([q, slopes])
      node%data(2, :4) = aimag([q, slopes])
      node%data(3, 1) = log(film%highest/strip%highest)
   contains
      !> The slope of q along a direction.
      pure complex(wp) function over(direction, of_film, of_strip)
         real(wp), intent(in) :: direction(2)
         complex(wp), intent(in) :: of_film(2), of_strip(2)
         over = sum(direction*(of_film/film%force - of_strip/strip%force))
      end function over
   end subroutine solve

   !> What turns the frame of least film thickness into the mid-arc frame, for a position over the clearance.
   pure complex(wp) function frame_of(position)
      real(wp), intent(in) :: position(2)
      frame_of = 1
      associate (e => norm2(position))
         if (e > 0) frame_of = cmplx(position(2), -position(1), wp)/e
      end associate
   end function frame_of

   !> Where the film about psi ends as that of a strip.
   pure type(strip_type) function strip_ends(self, position, psi) result(ends)
      class(wide_arc_film_type), intent(in) :: self
      real(wp), intent(in) :: position(2), psi
      ends = find_strip(self%pad%half_arc, self%pad%length, norm2(position), atan2(position(1), position(2)), psi, &
         & usual_steps)
   end function strip_ends

   !> The strip's film about psi at a position over the clearance, |e| < 1, and a |w|.
   pure type(strip_force_type) function strip(self, position, size, psi, with_slopes, with_pressure) result(found)
      class(wide_arc_film_type), intent(in) :: self
      real(wp), intent(in) :: position(2), size, psi
      logical, intent(in) :: with_slopes, with_pressure
      type(strip_film_type) :: film
      associate (turn => frame_of(position), e => norm2(position), &
         & w => size*vector_of(cmplx(sin(psi), cos(psi), wp)*conjg(frame_of(position))))
         if (self%gumbel) then
            film = solve_clipped_strip(self%pad%length, e, [-1, 1]*self%pad%half_arc &
               & - atan2(position(1), position(2)), w, clipped_steps, with_slopes, with_pressure)
         else
            film = solve_strip(self%pad%length, e, w, usual_steps, strip_ends(self, position, psi), with_slopes, &
               & with_pressure)
         end if
         found%force = turn*cmplx(film%force(1), film%force(2), wp)
         found%over_position = turned(cmplx(film%over_position(1, :), film%over_position(2, :), wp), turn)
         found%over_w = turned(cmplx(film%over_w(1, :), film%over_w(2, :), wp), turn)
      end associate
      found%highest = film%highest
   end function strip

   !> Derivatives of a force, as complex numbers, over the components of a vector, in a frame from which a vector here
   !> turns back by conjg(turn).
   pure function turned(slopes, turn)
      complex(wp), intent(in) :: slopes(2), turn
      complex(wp) :: turned(2)
      turned = turn*[slopes(1)*real(turn) - slopes(2)*aimag(turn), slopes(1)*aimag(turn) + slopes(2)*real(turn)]
   end function turned

   pure function vector_of(number) result(vector)
      complex(wp), intent(in) :: number
      real(wp) :: vector(2)
      vector = [real(number), aimag(number)]
   end function vector_of

   !> The film about psi of all widths at a position over the clearance, |e| < 1, and |w| = 1; `ok` where it has been
   !> solved.
   subroutine solve_film(self, position, psi, film, ok)
      class(wide_arc_film_type), intent(inout) :: self
      real(wp), intent(in) :: position(2), psi
      type(strip_force_type), intent(out) :: film
      logical, intent(out) :: ok
      type(film_response) :: response
      if (self%gumbel) then
         if (.not. allocated(self%modes)) self%modes = converged_film(self%pad%gap(0.0_wp), .true., modes_error)
         call self%modes%evaluate_pad(1, film_motion(position, [sin(psi), cos(psi)]), unit_oil, 0.0_wp, .true., &
            & response)
      else
         call solve_volumes(self, position, psi, response)
      end if
      ok = response%status == film_ok
      film%force = cmplx(response%force(1), response%force(2), wp)
      associate (d => response%derivatives)
         film%over_position = cmplx(d(1, :2), d(2, :2), wp)
         film%over_w = cmplx(d(1, 3:), d(2, 3:), wp)
      end associate
      film%highest = response%max_pressure
   end subroutine solve_film

   !> The same on finite volumes.
   subroutine solve_volumes(self, position, psi, response)
      class(wide_arc_film_type), intent(inout) :: self
      real(wp), intent(in) :: position(2), psi
      type(film_response), intent(out) :: response
      real(wp) :: room(2), ends(2)
      integer :: k, widened
      logical :: fits
      if (.not. allocated(self%grids)) then
         allocate (self%grids(2))
         do k = 1, 2
            self%grids(k) = new_elimination_film(self%pad%gap(0.0_wp), columns_a_row*self%rows/k, self%rows/k)
            self%grids(k)%ends_between = .true.
         end do
      end if
      associate (s => strip_ends(self, position, psi))
         do widened = 0, most_widened
            room = merge(2**widened*(beyond*abs(s%ends - s%reversals) + more), 0.0_wp, s%free)
            ends = [max(s%edges(1), s%ends(1) - room(1)), min(s%edges(2), s%ends(2) + room(2))]
            call solve_between(self, position, [sin(psi), cos(psi)], ends, &
               & [ends(1) <= s%edges(1), ends(2) >= s%edges(2)], response, fits)
            if (fits .or. response%status /= film_ok) exit
         end do
      end associate
   end subroutine solve_volumes

   !> The film between two of Sommerfeld's angles, extrapolated. It `fits` where it does not take the last column before
   !> an end that is no edge of the arc.
   subroutine solve_between(self, position, w, ends, at_edge, response, fits)
      class(wide_arc_film_type), intent(inout) :: self
      real(wp), intent(in) :: position(2), w(2), ends(2)
      logical, intent(in) :: at_edge(2)
      type(film_response), intent(out) :: response
      logical, intent(out) :: fits
      type(film_response) :: coarse
      type(film_counters) :: unused
      type(pad_gap_type) :: gap
      real(wp) :: line(0:columns_a_row*self%rows), angle
      integer :: columns, i
      columns = columns_a_row*self%rows
      angle = atan2(position(1), position(2))
      line = angle + angle_of(norm2(position), ends(1) + [(i, i=0, columns)]*((ends(2) - ends(1))/columns))
      gap = self%pad%gap(0.0_wp)
      gap%trailing_angle = -line(0)
      gap%leading_angle = line(columns)
      self%grids(1)%grid = new_film_grid(gap, columns, self%rows, line)
      self%grids(2)%grid = new_film_grid(gap, columns/2, self%rows/2, line(0:columns:2))
      call self%grids(2)%start_from()
      call self%grids(2)%evaluate(film_motion(position, w), unit_oil, 0.0_wp, .true., .true., unused, coarse)
      call self%grids(1)%start_from(self%grids(2))
      call self%grids(1)%evaluate(film_motion(position, w), unit_oil, 0.0_wp, .true., .true., unused, response)
      response%status = max(response%status, coarse%status)
      fits = (at_edge(1) .or. .not. any(self%grids(1)%film(:self%rows, 1) > 0)) .and. &
         & (at_edge(2) .or. .not. any(self%grids(1)%film(:self%rows, columns) > 0))
      response%force = (4*response%force - coarse%force)/3
      response%derivatives = (4*response%derivatives - coarse%derivatives)/3
      response%max_pressure = (4*response%max_pressure - coarse%max_pressure)/3
   end subroutine solve_between
end module wide_arc_film
