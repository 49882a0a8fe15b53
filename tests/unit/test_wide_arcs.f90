!> Films of wide arcs: the film of a strip, what tables add to it, and films from these tables.
program test_wide_arcs
   use kinds, only: wp, pi, degree
   use text, only: to_text
   use pad_gap, only: pad_gap_type
   use film_solver, only: film_solver_type, film_motion, film_response, film_counters, film_ok, &
      & reynolds => cavitation_reynolds
   use dimensionless_pad, only: dimensionless_pad_type, new_dimensionless_pad
   use strip_film, only: strip_film_type, find_strip, solve_strip, solve_clipped_strip, usual_steps
   use wide_arc_film, only: wide_arc_film_type, strip_force_type, new_wide_arc_film
   use wide_arc_table, only: wide_arc_table_type, new_wide_arc_table
   use direct_film, only: direct_film_type, new_direct_film
   use table_film, only: new_table_film
   use paper_bearing, only: paper_oil, speed, clearance
   use check, only: runs, expect, between, report
   implicit none (type, external)

   real(wp), parameter :: arcs(4) = [150, 170, 220, 360]*degree

   if (runs('strip_order')) call strip_order()
   if (runs('strip_slopes')) call strip_slopes()
   if (runs('narrow')) call narrow()
   if (runs('cells')) call cells()
   if (runs('mirror')) call mirror(.false.)
   if (runs('mirror_gumbel')) call mirror(.true.)
   if (runs('faces')) call faces(.false.)
   if (runs('faces_gumbel')) call faces(.true.)
   if (runs('clipped')) call clipped()
   if (runs('ends')) call ends()
   if (runs('order_of_visits')) call order_of_visits()
   if (runs('films')) call films()
   call report()

contains

   pure type(dimensionless_pad_type) function pad(arc, length)
      real(wp), intent(in) :: arc, length
      pad = new_dimensionless_pad(pad_gap_type(0.0_wp, 1.0_wp, length, arc/2, arc/2, 0.0_wp, 0.0_wp, 0.0_wp))
   end function pad

   pure function direction(angle)
      real(wp), intent(in) :: angle
      real(wp) :: direction(2)
      direction = [sin(angle), cos(angle)]
   end function direction

   !> The strip's film in the frame of least film thickness, with this number of steps; on the whole arc twice as many.
   pure type(strip_film_type) function strip(arc, length, e, angle, psi, steps, gumbel)
      real(wp), intent(in) :: arc, length, e, angle, psi
      integer, intent(in) :: steps
      logical, intent(in) :: gumbel
      if (gumbel) then
         strip = solve_clipped_strip(length, e, [-arc, arc]/2 - angle, direction(psi - angle), 2*steps, .true., .true.)
      else
         strip = solve_strip(length, e, direction(psi - angle), steps, &
            & find_strip(arc/2, length, e, angle, psi, steps), .true., .true.)
      end if
   end function strip

   !> Numerov's scheme is of fourth order, 16 times closer with half the steps, but for a quarter by how the ends of
   !> films lie between them; and with the usual steps force and highest pressure are close.
   subroutine strip_order()
      integer, parameter :: n = 200
      type(strip_film_type) :: exact, film
      real(wp) :: arc, length, e, angle, psi, error(n, 3), ratio
      integer :: i, k
      do i = 1, n
         arc = arcs(1 + mod(i, size(arcs)))
         length = between(0.6_wp, 2.4_wp)
         e = between(0.0_wp, 0.9_wp)
         angle = between(-pi, pi)
         psi = between(-1.0_wp, 1.0_wp)*(0.5_wp*(pi + arc) - 0.3_wp)
         exact = strip(arc, length, e, angle, psi, 768, .false.)
         do k = 1, 3
            film = strip(arc, length, e, angle, psi, 24*2**(k - 1), .false.)
            error(i, k) = norm2(film%force - exact%force)/norm2(exact%force)
         end do
         film = strip(arc, length, e, angle, psi, usual_steps, .false.)
         call expect(norm2(film%force - exact%force) < 1e-3_wp*norm2(exact%force), 'force of the usual steps')
         call expect(abs(film%highest/exact%highest - 1) < 5e-3_wp, 'highest pressure of the usual steps')
      end do
      do k = 1, 2
         ratio = exp(sum(log(error(:, k)/error(:, k + 1)))/n)
         call expect(ratio > 12, 'fourth order: '//to_text(ratio))
      end do
   end subroutine strip_order

   !> Slopes by adjoints are those of the film itself: those of differences, which see what the steps leave, approach
   !> them as the steps become shorter.
   subroutine strip_slopes()
      integer, parameter :: n = 40
      real(wp), parameter :: step = 1e-4_wp
      type(strip_film_type) :: film
      real(wp) :: arc, length, e, angle, psi, error(n, 2, 2)
      integer :: i, k, m
      logical :: gumbel
      do m = 0, 1
         gumbel = m == 1
         do i = 1, n
            arc = merge(arcs(4), arcs(1 + mod(i, size(arcs))), gumbel)
            length = between(0.6_wp, 2.4_wp)
            e = between(0.05_wp, 0.9_wp)
            angle = between(-pi, pi)
            psi = between(-1.0_wp, 1.0_wp)*(0.5_wp*(pi + arc) - 0.3_wp)
            do k = 1, 2
               film = strip(arc, length, e, angle, psi, usual_steps*k, gumbel)
               associate (over_e => slope(arc, length, e, angle, psi, usual_steps*k, gumbel, step*(1 - e), 0.0_wp), &
                  & over_psi => slope(arc, length, e, angle, psi, usual_steps*k, gumbel, 0.0_wp, step))
                  error(i, k, 1) = norm2(over_psi - matmul(film%over_w, [cos(psi - angle), -sin(psi - angle)])) &
                     & /norm2(film%over_w)
                  error(i, k, 2) = norm2(over_e - film%over_position(:, 2))/norm2(film%over_position)
               end associate
            end do
         end do
         do k = 1, 2
            associate (close => count(error(:, 1, k) < 2e-3_wp))
               call expect(close > 0.8_wp*n, 'slopes: '//to_text(close))
            end associate
            call expect(sum(log(error(:, 1, k)/error(:, 2, k)))/n > log(5.0_wp), 'shorter steps are closer: ' &
               & //to_text(exp(sum(log(error(:, 1, k)/error(:, 2, k)))/n)))
         end do
      end do
   end subroutine strip_slopes

   !> The slope of the strip's force over e or psi by differences of this half.
   pure function slope(arc, length, e, angle, psi, steps, gumbel, of_e, of_psi)
      real(wp), intent(in) :: arc, length, e, angle, psi, of_e, of_psi
      integer, intent(in) :: steps
      logical, intent(in) :: gumbel
      real(wp) :: slope(2)
      type(strip_film_type) :: ahead, behind
      ahead = strip(arc, length, e + of_e, angle, psi + of_psi, steps, gumbel)
      behind = strip(arc, length, e - of_e, angle, psi - of_psi, steps, gumbel)
      slope = (ahead%force - behind%force)/(2*(of_e + of_psi))
   end function slope

   !> As a pad becomes narrow its film becomes that of the strip.
   subroutine narrow()
      type(wide_arc_film_type) :: films
      type(strip_force_type) :: film, one
      real(wp) :: error(2)
      integer :: k
      logical :: ok
      do k = 1, 2
         films = new_wide_arc_film(pad(arcs(4), 2.4_wp/12**(k - 1)), .false., 24)
         call films%solve_film([0.3_wp, 0.2_wp], 2.0_wp, film, ok)
         one = films%strip([0.3_wp, 0.2_wp], 1.0_wp, 2.0_wp, .false., .false.)
         error(k) = abs(film%force/one%force - 1)
      end do
      call expect(error(2) < 1e-3_wp .and. error(2) < 0.2_wp*error(1), 'narrow pads: '//to_text(error(1))//' '// &
         & to_text(error(2)))
   end subroutine narrow

   !> The film of all widths on a fine grid: that about psi and that beside the edges.
   subroutine solve(films, position, psi, film)
      type(wide_arc_film_type), intent(inout) :: films
      real(wp), intent(in) :: position(2), psi
      type(strip_force_type), intent(out) :: film
      type(strip_force_type) :: one
      integer :: k
      logical :: ok
      do k = 0, 1
         associate (about => psi - k*sign(2*pi, psi))
            if (abs(about) >= films%last_psi) cycle
            call films%solve_film(position, about, one, ok)
            call expect(ok, 'solved')
            film%force = film%force + one%force
         end associate
      end do
   end subroutine solve

   !> Films from cells meet those of finer grids, half of them within 5e-5; cells half as long are several times closer.
   subroutine cells()
      integer, parameter :: n = 60
      type(wide_arc_table_type) :: tables(2)
      type(wide_arc_film_type) :: films
      type(film_counters) :: counters
      type(strip_force_type) :: film, exact
      real(wp) :: position(2), psi, error(n, 2), arc
      integer :: i, k, which, last(2)
      logical :: good
      which = 0
      do i = 1, n
         if (mod(i, n/4) == 1) then
            which = which + 1
            arc = arcs(which)
            tables(1) = new_wide_arc_table(pad(arc, 1.0_wp), .false., 4e-5_wp, 100000)
            tables(2) = new_wide_arc_table(pad(arc, 1.0_wp), .false., 2.5e-6_wp, 100000)
            films = new_wide_arc_film(pad(arc, 1.0_wp), .false., 40)
         end if
         position = between(0.0_wp, 0.9_wp)*direction(between(-pi, pi))
         psi = between(-1.0_wp, 1.0_wp)*min(pi, 0.5_wp*(arc + pi) - 0.3_wp)
         call solve(films, position, psi, exact)
         do k = 1, 2
            last = 0
            call tables(k)%film(position, direction(psi), .false., .false., last, counters, film, good)
            call expect(good, 'found')
            error(i, k) = abs(film%force - exact%force)/abs(exact%force)
         end do
      end do
      call expect(count(error(:, 1) < 5e-5_wp) > n/2, 'median of long cells')
      call expect(maxval(error(:, 1)) < 4e-3_wp, 'largest of long cells: '//to_text(maxval(error(:, 1))))
      call expect(sum(log(error(:, 1)/error(:, 2)))/n > log(3.0_wp), 'short cells are closer')
   end subroutine cells

   !> With Guembel's condition on the whole circle forces from cells meet those of modes, over what the same velocity
   !> would give towards the least film thickness: that is what a journal is held by. Half of them within 1e-5.
   subroutine clipped()
      integer, parameter :: n = 60
      type(wide_arc_table_type) :: table
      type(wide_arc_film_type) :: films
      type(film_counters) :: counters
      type(strip_force_type) :: film, exact, most
      real(wp) :: position(2), psi, angle, error(n)
      integer :: i, last(2)
      logical :: good
      table = new_wide_arc_table(pad(arcs(4), 1.0_wp), .true., 1e-5_wp, 100000)
      films = new_wide_arc_film(pad(arcs(4), 1.0_wp), .true., 12)
      do i = 1, n
         angle = between(-pi, pi)
         psi = between(-pi, pi)
         position = between(0.0_wp, 0.95_wp)*direction(angle)
         last = 0
         call table%film(position, direction(psi), .false., .false., last, counters, film, good)
         call expect(good, 'found')
         call films%solve_film(position, psi, exact, good)
         call films%solve_film(position, angle, most, good)
         error(i) = abs(film%force - exact%force)/abs(most%force)
      end do
      call expect(count(error < 1e-5_wp) > n/2, 'median')
      call expect(maxval(error) < 2e-3_wp, 'largest: '//to_text(maxval(error)))
   end subroutine clipped

   !> A film and its mirror.
   subroutine mirror(gumbel)
      logical, intent(in) :: gumbel
      type(wide_arc_table_type) :: table
      type(film_counters) :: counters
      type(strip_force_type) :: film, seen
      real(wp) :: angle, psi, e
      integer :: i, last(2)
      logical :: good
      table = new_wide_arc_table(pad(arcs(4), 1.0_wp), gumbel, 4e-5_wp, 100000)
      last = 0
      do i = 1, 10
         e = between(0.0_wp, 0.9_wp)
         angle = between(-pi, pi)
         psi = between(-pi, pi)
         call table%film(e*direction(angle), direction(psi), .true., .false., last, counters, film, good)
         call table%film(e*direction(-angle), direction(-psi), .true., .false., last, counters, seen, good)
         call expect(abs(film%force + conjg(seen%force)) < 1e-9_wp*abs(film%force), 'mirrored force')
         call expect(abs(film%over_position(1) - conjg(seen%over_position(1))) < 1e-7_wp*abs(film%over_position(1)), &
            & 'mirrored slope')
      end do
   end subroutine mirror

   !> Across the faces of cells and around the circle the force does not leap.
   subroutine faces(gumbel)
      logical, intent(in) :: gumbel
      real(wp), parameter :: step = 1e-9_wp
      type(wide_arc_table_type) :: table
      type(film_counters) :: counters
      type(strip_force_type) :: film(2)
      real(wp) :: place(3), moved(3)
      integer :: i, k, side, last(2)
      logical :: good
      table = new_wide_arc_table(pad(arcs(4), 1.0_wp), gumbel, 4e-5_wp, 100000)
      last = 0
      do i = 1, 9
         place = [between(0.2_wp, 2.5_wp), between(-3.0_wp, 3.0_wp), between(-3.0_wp, 3.0_wp)]
         k = 1 + mod(i, 3)
         if (k == 1) place(1) = 0.7_wp*(1 + mod(i/3, 4))
         if (k == 2) place(2) = pi*(1 - 0.125_wp*(i/3))
         if (k == 3) place(3) = pi/12*(i/3)
         do side = 1, 2
            moved = place
            moved(k) = place(k) + step*(2*side - 3)
            call table%film((1 - exp(-moved(1)))*direction(moved(2)), direction(moved(3)), .false., .false., last, &
               & counters, film(side), good)
         end do
         call expect(abs(film(1)%force - film(2)%force) < 1e-6_wp*abs(film(1)%force), 'face along axis '//to_text(k))
      end do
   end subroutine faces

   !> The force vanishes steadily where no oil converges on the arc any more, and does not leap where it begins to
   !> diverge at an edge.
   subroutine ends()
      type(wide_arc_table_type) :: table
      type(film_counters) :: counters
      type(strip_force_type) :: film(3)
      real(wp) :: psi(3)
      integer :: k, last(2)
      logical :: good
      table = new_wide_arc_table(pad(arcs(2), 1.0_wp), .false., 4e-5_wp, 100000)
      last = 0
      psi = 0.5_wp*(pi + arcs(2)) - [2e-2_wp, 1e-2_wp, -1e-2_wp]
      do k = 1, 3
         call table%film([0.3_wp, 0.4_wp], direction(psi(k)), .false., .false., last, counters, film(k), good)
         call expect(good, 'found')
      end do
      ! with the fourth power
      call expect(abs(abs(film(1)%force)/abs(film(2)%force) - 16) < 2, 'vanishes')
      call expect(.not. abs(film(3)%force) > 0, 'nothing is left')
      psi(:2) = 0.5_wp*(pi - arcs(2)) + [-1e-8_wp, 1e-8_wp]
      do k = 1, 2
         call table%film([0.3_wp, 0.4_wp], direction(psi(k)), .false., .false., last, counters, film(k), good)
      end do
      call expect(abs(film(1)%force - film(2)%force) < 1e-6_wp*abs(film(1)%force), 'begins to diverge')
   end subroutine ends

   !> A film is the same to the last bit, whatever came before.
   subroutine order_of_visits()
      type(wide_arc_table_type) :: table
      type(film_counters) :: counters
      type(strip_force_type) :: film(2)
      integer :: k, last(2), i
      logical :: good
      do k = 1, 2
         table = new_wide_arc_table(pad(arcs(4), 1.0_wp), .false., 4e-5_wp, 100000)
         last = 0
         do i = 1, 4*(k - 1)
            call table%film(0.55_wp*direction(pi - 0.3_wp*i), direction(2 + 0.3_wp*i), .true., .false., last, &
               & counters, film(1), good)
         end do
         call table%film(0.55_wp*direction(pi - 0.01_wp), direction(2.9_wp), .true., .false., last, counters, film(k), &
            & good)
         if (k == 1) film(2) = film(1)
         if (k == 1) cycle
         call table%film(0.55_wp*direction(pi - 0.01_wp), direction(2.9_wp), .true., .false., last, counters, film(1), &
            & good)
         call expect(.not. abs(film(1)%force - film(2)%force) > 0, 'same table')
      end do
   end subroutine order_of_visits

   !> Films of fixed pads from tables, with the ambient pressure around them: close to film-adapted grids, with
   !> slopes that are those of differences, and with their highest pressure.
   subroutine films()
      class(film_solver_type), allocatable :: tables
      type(direct_film_type) :: fine
      type(film_motion) :: motion(1), moved(1)
      type(film_response) :: found(1), exact(1), ahead(1), behind(1)
      type(pad_gap_type) :: gap
      real(wp) :: step
      integer :: i, k
      do i = 1, 4
         gap = pad_gap_type(0.025_wp, clearance, 0.025_wp, 0.4_wp*arcs(i), 0.6_wp*arcs(i), 1e5_wp, 1e5_wp, 1e5_wp)
         tables = new_table_film(new_direct_film([gap], 40, 16, 80, 8, reynolds), .true., 4e-5_wp)
         fine = new_direct_film([gap], 60, 24, 80, 8, reynolds, 1e-5_wp, 2e-3_wp)
         motion(1)%position = 0.6_wp*clearance*direction(between(-0.7_wp, 0.7_wp))
         motion(1)%velocity = 0.1_wp*clearance*speed*direction(between(-pi, pi))
         call tables%evaluate(motion, [paper_oil], speed, .true., found)
         call tables%take_pressures(motion, [paper_oil], speed, found)
         call fine%evaluate(motion, [paper_oil], speed, .true., exact)
         call expect(found(1)%from_tables .and. exact(1)%status == film_ok, 'from tables')
         call expect(norm2(found(1)%force - exact(1)%force) < 2e-3_wp*norm2(exact(1)%force), 'force')
         call expect(norm2(found(1)%derivatives(:, :2) - exact(1)%derivatives(:, :2)) &
            & < 1e-2_wp*norm2(exact(1)%derivatives(:, :2)), 'stiffness')
         call expect(norm2(found(1)%derivatives(:, 3:) - exact(1)%derivatives(:, 3:)) &
            & < 1e-2_wp*norm2(exact(1)%derivatives(:, 3:)), 'damping')
         call expect(abs(found(1)%max_pressure/exact(1)%max_pressure - 1) < 1e-2_wp, 'highest pressure')
         call expect(.not. abs(found(1)%min_pressure - 1e5_wp) > 0, 'lowest pressure')
         do k = 1, 2
            step = 1e-5_wp*clearance
            moved = motion
            moved(1)%position(k) = motion(1)%position(k) + step
            call tables%evaluate(moved, [paper_oil], speed, .false., ahead)
            moved(1)%position(k) = motion(1)%position(k) - step
            call tables%evaluate(moved, [paper_oil], speed, .false., behind)
            call expect(norm2((ahead(1)%force - behind(1)%force)/(2*step) - found(1)%derivatives(:, k)) &
               & < 2e-3_wp*norm2(found(1)%derivatives(:, :2)), 'slope by differences')
         end do
      end do
   end subroutine films
end program test_wide_arcs
