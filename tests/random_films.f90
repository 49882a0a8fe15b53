!> Random films over what a bearing can ask for: pads of 20 to 120 degrees, pivots at 0.3 to 0.7 of them, length to
!> diameter 0.25 to 2, clearances of 5 to 200 um, films from 0.04 to 2 clearances thick at either edge and up to fifty
!> times as thick at one place as at another, every direction of motion, with and without a supply pressure. And films
!> by finite volumes on narrow columns, from which forces are extrapolated.
module random_films
   use kinds, only: wp, pi, degree
   use film_solver, only: film_motion, film_response, film_counters
   use pad_gap, only: pad_gap_type
   use fourier_film, only: fourier_film_type, converged_film
   use elimination_film, only: elimination_film_type, new_elimination_film
   use dimensionless_pad, only: dimensionless_pad_type, new_dimensionless_pad
   use check, only: between
   use paper_bearing, only: paper_oil
   implicit none (type, external)
   private
   public :: film_state, random_film, volumes_type, new_volumes, extrapolated, field_points, shown, shaft_speed

   !> Journal speed, rad/s.
   real(wp), parameter :: shaft_speed = 680
   !> Range of the film thickness at the edges, and least film thickness, over the clearance.
   real(wp), parameter :: thin = 0.04_wp, thick = 2

   !> A film, and what its errors are measured over.
   type :: film_state
      type(pad_gap_type) :: gap
      type(film_motion) :: motion
      !> Thickest over thinnest; share of the film that diverges (docs/theory/film.md); pressure at the leading
      !> edge over the highest of the film without it, tension or pressure.
      real(wp) :: thickness_ratio = 1, t = 0, supply = 0
      !> Thinnest film, m; force, N, and highest pressure, Pa, of the film in the same position that is just whole,
      !> T = 0, as fast along the arc, or of this film, kept whole, where they are larger.
      real(wp) :: thinnest = 0, force = 0, pressure = 0
   end type film_state

   !> Forces, N, and slopes, as `film_response` has them, and highest pressure of a film by volumes.
   type :: volumes_type
      real(wp) :: force(2) = 0, derivatives(2, 4) = 0, max_pressure = 0
   end type volumes_type

contains

   !> A film with a film thickness ratio of this range; one that may cavitate has T from -0.3 to 1, others drive it from
   !> anywhere. A supply pressure is up to the highest pressure without it.
   type(film_state) function random_film(least, most, cavitates, supplied) result(state)
      real(wp), intent(in) :: least, most
      logical, intent(in) :: cavitates, supplied
      real(wp) :: arc, pivot, h(2), u(2), tangent, chance
      do
         arc = between(20.0_wp, 120.0_wp)*degree
         pivot = between(0.3_wp, 0.7_wp)
         associate (gap => state%gap, motion => state%motion)
            gap = pad_gap_type(49.9e-3_wp, 5e-6_wp*40**between(0.0_wp, 1.0_wp), 0.1_wp*0.25_wp*8**between(0.0_wp, &
               & 1.0_wp), pivot*arc, (1 - pivot)*arc, 0.0_wp, 0.0_wp, 0.0_wp)
            h = 1 - thin*(thick/thin)**[between(0.0_wp, 1.0_wp), between(0.0_wp, 1.0_wp)]
            motion%position = gap%machined_clearance/sin(arc)*[h(1)*cos(gap%trailing_angle) - h(2) &
               & *cos(gap%leading_angle), h(1)*sin(gap%trailing_angle) + h(2)*sin(gap%leading_angle)]
            state%thinnest = gap%min_film_thickness(motion, gap%directions())
            if (state%thinnest < 0.999_wp*thin*gap%machined_clearance) cycle
            state%thickness_ratio = thickest(gap, motion)/state%thinnest
            if (state%thickness_ratio >= least .and. state%thickness_ratio <= most) exit
         end associate
      end do
      tangent = tan(0.5_wp*arc)
      u = [1.0_wp, between(-0.3_wp, 1.0_wp)]
      chance = between(0.0_wp, 1.0_wp)
      if (chance < 0.5_wp .and. .not. cavitates) then
         u(2) = between(-0.99_wp, 0.99_wp)*pi/2
         u = [cos(u(2)), (1 - tan(u(2))/tangent)/2]
      end if
      state%t = u(2)
      chance = between(0.0_wp, 1.0_wp)
      if (chance < 0.5_wp) u(1) = -u(1)
      call set_velocity(state, [u(1), abs(u(1))*tangent])
      call measure(state)
      call set_velocity(state, [u(1), abs(u(1))*tangent*(1 - 2*state%t)])
      call measure(state)
      if (.not. supplied) return
      state%supply = between(0.0_wp, 1.0_wp)
      state%gap%supply_pressure = state%supply*state%pressure
   end function random_film

   !> Sets the velocity that drives the film, over a half of clearance times journal speed, in the mid-arc frame.
   pure subroutine set_velocity(state, drive)
      type(film_state), intent(inout) :: state
      real(wp), intent(in) :: drive(2)
      associate (gap => state%gap, motion => state%motion)
         motion%velocity = 0.5_wp*shaft_speed*(gap%machined_clearance*turned(drive, middle(gap)) &
            & - gap%journal_radius/gap%pad_radius()*[motion%position(2), -motion%position(1)])
      end associate
   end subroutine set_velocity

   !> Widens what the errors are measured over by the film as it is.
   subroutine measure(state)
      type(film_state), intent(inout) :: state
      type(fourier_film_type) :: film
      type(film_response) :: r(1)
      film = converged_film(state%gap, .false., 1e-4_wp)
      call film%evaluate([state%motion], [paper_oil], shaft_speed, .false., r)
      state%force = max(state%force, norm2(r(1)%force))
      state%pressure = max(state%pressure, r(1)%max_pressure, -r(1)%min_pressure)
   end subroutine measure

   !> The thickest place, m: at an edge, or opposite to the journal.
   pure real(wp) function thickest(gap, motion)
      type(pad_gap_type), intent(in) :: gap
      type(film_motion), intent(in) :: motion
      integer, parameter :: n = 200
      real(wp) :: phi(0:n)
      integer :: i
      phi = [(gap%arc()*i/n - gap%trailing_angle, i=0, n)]
      thickest = maxval(gap%thickness(motion, sin(phi), cos(phi)))
   end function thickest

   !> Angle from the pivot to the middle of the arc, rad.
   pure real(wp) function middle(gap)
      type(pad_gap_type), intent(in) :: gap
      middle = 0.5_wp*(gap%leading_angle - gap%trailing_angle)
   end function middle

   !> A vector of the frame that an angle leads to, in the frame before.
   pure function turned(v, angle)
      real(wp), intent(in) :: v(2), angle
      real(wp) :: turned(2)
      turned = [v(1)*cos(angle) + v(2)*sin(angle), v(2)*cos(angle) - v(1)*sin(angle)]
   end function turned

   !> The film by finite volumes, that cavitates by the condition of Reynolds or not at all, on this many rows and eight
   !> times as many columns: half of them on each side of where the source of pressure changes its sign, narrow where
   !> the film is thin; with a supply pressure, half of them narrow towards the leading edge.
   type(volumes_type) function new_volumes(state, rows, cavitates) result(volumes)
      type(film_state), intent(in) :: state
      integer, intent(in) :: rows
      logical, intent(in) :: cavitates
      type(dimensionless_pad_type) :: pad
      type(elimination_film_type) :: grid
      type(film_counters) :: unused
      type(film_response) :: r
      real(wp) :: at(2), between_halves, angles(0:8*rows)
      integer :: i, half
      half = 4*rows
      associate (gap => state%gap, columns => 8*rows)
         pad = new_dimensionless_pad(gap)
         at = turned(state%motion%position/gap%machined_clearance, -middle(gap))
         associate (w => turned(state%motion%velocity + 0.5_wp*shaft_speed*gap%journal_radius/gap%pad_radius() &
            & *[state%motion%position(2), -state%motion%position(1)], -middle(gap)))
            between_halves = -atan2(sign(w(2), w(1)*w(2)), abs(w(1)))
         end associate
         between_halves = min(max(between_halves, -0.8_wp*pad%half_arc), 0.8_wp*pad%half_arc)
         if (state%supply > 0) between_halves = pad%half_arc - 0.4_wp*min(2*pad%half_arc, pad%length)
         angles(:half) = pad%spread_angles(at, -pad%half_arc, between_halves, half)
         angles(half:) = pad%spread_angles(at, between_halves, pad%half_arc, half)
         if (state%supply > 0) angles(half:) = pad%half_arc - (pad%half_arc - between_halves) &
            & *[((real(half - i, wp)/half)**2, i=0, half)]
         grid = new_elimination_film(gap, columns, rows, middle(gap) + angles)
      end associate
      call grid%evaluate(state%motion, paper_oil, shaft_speed, cavitates, .true., unused, r)
      volumes = volumes_type(r%force, r%derivatives, r%max_pressure)
   end function new_volumes

   !> What two grids, the second twice as fine, tell of one that is infinitely fine.
   pure type(volumes_type) function extrapolated(coarse, fine)
      type(volumes_type), intent(in) :: coarse, fine
      extrapolated%force = (4*fine%force - coarse%force)/3
      extrapolated%derivatives = (4*fine%derivatives - coarse%derivatives)/3
      extrapolated%max_pressure = (4*fine%max_pressure - coarse%max_pressure)/3
   end function extrapolated

   !> Points of a film's field, and what of the arc, rad, and of the width, m, both halves, each of them stands for: the
   !> middles of parts that are narrow beside the edges, and where the film is thin.
   pure subroutine field_points(state, phi, arc, z, width)
      type(film_state), intent(in) :: state
      real(wp), intent(out) :: phi(:), arc(:), z(:), width(:)
      type(dimensionless_pad_type) :: pad
      real(wp) :: ends(0:size(phi)), sides(0:size(z))
      integer :: i
      pad = new_dimensionless_pad(state%gap)
      associate (n => size(phi), m => size(z), a => middle(state%gap))
         ends = a + 0.5_wp*pad%spread_angles(turned(state%motion%position/state%gap%machined_clearance, -a), &
            & -pad%half_arc, pad%half_arc, n) - 0.5_wp*pad%half_arc*[(cos(i*pi/n), i=0, n)]
         phi = 0.5_wp*(ends(1:) + ends(:n - 1))
         arc = ends(1:) - ends(:n - 1)
         sides = 0.5_wp*state%gap%axial_length*[(1 - (1 - real(i, wp)/m)**2, i=0, m)]
         z = 0.5_wp*(sides(1:) + sides(:m - 1))
         width = 2*(sides(1:) - sides(:m - 1))
      end associate
   end subroutine field_points

   function shown(state) result(text)
      type(film_state), intent(in) :: state
      character(len=:), allocatable :: text
      character(len=200) :: line
      associate (gap => state%gap)
         write (line, '(3(f0.2, a), es9.2, 3(a, f0.2))') gap%arc()/degree, ' degrees, pivot ', gap%trailing_angle &
            & /gap%arc(), ', L/D ', 0.5_wp*gap%axial_length/gap%journal_radius, ', clearance ', &
            & gap%machined_clearance, ', film thickness ratio ', state%thickness_ratio, ', T ', state%t, ', supply ', &
               & state%supply
      end associate
      text = trim(line)
   end function shown
end module random_films
