!> Tables of uneven oil: its full films and what cavitation leaves of them against solvers that know no table, with
!> derivatives; the order of convergence with the size of the cells, cells that meet, the mirror, even oil in weights,
!> and oil that changes.
program test_uneven_table
   use kinds, only: wp
   use text, only: to_text
   use film_solver, only: film_solver_type, film_motion, film_oil, film_response, film_counters, film_ok, &
      & cavitation_reynolds
   use pad_gap, only: pad_gap_type
   use film_resolution, only: enough_cells, enough_modes
   use direct_film, only: new_direct_film
   use table_film, only: new_table_film
   use dimensionless_pad, only: dimensionless_pad_type, new_dimensionless_pad
   use rotation_drive, only: rotation_drive_type, new_rotation_drive
   use force_ratio, only: force_ratio_solver, force_ratio_type, new_force_ratio_solver
   use cavitated_film, only: cavitated_film_type, cavitation_table_type, node_type, new_cavitated_film, &
      & new_cavitation_table, axes
   use paper_bearing, only: offset_pad, paper_oil, uneven, speed, clearance
   use check, only: runs, expect, expect_close, between, report
   implicit none (type, external)

   real(wp), parameter :: tolerance = 1e-4_wp
   integer, parameter :: most = 20000
   !> Thicknesses at the edges, T and t/w_1: of films that the rotation drives alone, and faster or slower than that.
   real(wp), parameter :: films(axes, 4) = reshape([0.8_wp, 0.4_wp, 0.15_wp, 1.5_wp, 0.5_wp, 0.9_wp, 0.4_wp, 3.0_wp, &
      & 0.3_wp, 0.3_wp, 0.7_wp, 2.0_wp, 0.7_wp, 0.5_wp, 0.3_wp, -2.0_wp], [axes, 4])
   type(dimensionless_pad_type) :: pad
   type(rotation_drive_type) :: drive
   integer :: i

   pad = new_dimensionless_pad(offset_pad())
   drive = new_rotation_drive(pad, uneven)
   do i = 1, size(films, 2)
      if (runs('slopes')) call slopes(films(:, i))
   end do
   if (runs('mirror')) call mirror()
   if (runs('cells')) call cells()
   if (runs('cells_meet')) call cells_meet()
   if (runs('full_films')) call full_films()
   if (runs('cavitated_films')) call cavitated_films()
   if (runs('derivatives')) call derivatives()
   if (runs('even_weights')) call even_weights()
   if (runs('another_oil')) call another_oil()
   call report()

contains

   !> A film's ratio in a place.
   type(force_ratio_type) function at(solver, place)
      type(force_ratio_solver), intent(inout) :: solver
      real(wp), intent(in) :: place(axes)
      at = solver%at(place(:2), pad%tangent*(1 - 2*place(3)), place(4))
   end function at

   !> Slopes of the ratio against central differences, as in test_cavitation_table; that over t, too.
   subroutine slopes(film)
      real(wp), intent(in) :: film(axes)
      real(wp), parameter :: step = 0.02_wp
      type(force_ratio_solver) :: solver
      type(force_ratio_type) :: ratio
      real(wp) :: place(axes), move(axes)
      complex(wp) :: found, slope(axes)
      integer :: k
      place = film
      solver = new_force_ratio_solver(pad, drive, .false., 0.01_wp*tolerance)
      if (place(4) < 0) solver = new_force_ratio_solver(pad, new_rotation_drive(pad, uneven%mirrored()), .false., &
         & 0.01_wp*tolerance)
      ratio = at(solver, place)
      call expect(ratio%ok, 'a film')
      slope = [ratio%slopes(:2), -2*pad%tangent*ratio%slopes(3), ratio%over_t]
      do k = 1, axes
         move = 0
         move(k) = step*merge(minval(place(:2)), 1.0_wp, k < 3)
         found = (4*difference(solver, place, 0.5_wp*move) - difference(solver, place, move))/3
         call expect_close(abs(slope(k) - found)*sum(move)/abs(ratio%value), 0.0_wp, 0.5_wp*tolerance, &
            & 'slope '//to_text(k)//' T = '//to_text(place(3)))
      end do
   end subroutine slopes

   complex(wp) function difference(solver, place, move)
      type(force_ratio_solver), intent(inout) :: solver
      real(wp), intent(in) :: place(axes), move(axes)
      type(force_ratio_type) :: ahead, back
      ahead = at(solver, place + move)
      back = at(solver, place - move)
      difference = (ahead%value - back%value)/(2*sum(move))
   end function difference

   !> In a mirror the edges change places and the rotation turns round: velocities at the edges do the same.
   subroutine mirror()
      type(rotation_drive_type) :: mirrored
      real(wp) :: position(2)
      mirrored = new_rotation_drive(pad, uneven%mirrored())
      position = [0.3_wp, 0.2_wp]
      associate (here => drive%velocity(position), there => mirrored%velocity([-1, 1]*position))
         call expect_close(there(1), here(1), 1e-13_wp, 'along')
         call expect_close(there(2), -here(2), 1e-13_wp, 'outward')
         call expect(minval(abs(here)) > 1e-3_wp, 'there is a velocity')
      end associate
   end subroutine mirror

   !> The error of cells falls with the fourth power of their length: cells of half the length have a sixteenth of the
   !> tolerance. Each table is compared with the films that it is made of, so that what they differ by is the cells
   !> alone: some films have several times the tolerance, as those of even oil do (test_cavitation_table).
   subroutine cells()
      integer, parameter :: n = 12
      type(cavitation_table_type) :: table(2)
      type(cavitated_film_type) :: films_there(2)
      type(film_counters) :: counters
      type(node_type) :: film, exact
      real(wp) :: place(axes), error(2)
      integer :: k, m, last
      do m = 1, 2
         table(m) = new_cavitation_table(pad, drive, .false., 3.2e-5_wp/16.0_wp**(m - 1), most)
         films_there(m) = new_cavitated_film(pad, drive, .false., 3.2e-5_wp/16.0_wp**(m - 1))
      end do
      error = 0
      do k = 1, n
         place = [between(0.3_wp, 0.9_wp), between(0.2_wp, 0.9_wp), between(0.1_wp, 0.8_wp), between(1.0_wp, 4.0_wp)]
         do m = 1, 2
            last = 0
            call table(m)%look_up(place, .false., last, counters, film)
            call expect(film%ok, 'a closer table has all cells')
            call films_there(m)%look_up(place, .false., last, counters, exact)
            error(m) = error(m) + norm2(film%data(:2, 1) - exact%data(:2, 1))/n
         end do
      end do
      call expect(error(1) < 5*3.2e-5_wp, 'error of cells '//to_text(error(1)))
      call expect(error(2) < error(1)/8, 'with half their length '//to_text(error(2)))
   end subroutine cells

   !> Across a face between two intervals of t/w_1, of either sign, functions and their slopes along it are the same to
   !> rounding.
   subroutine cells_meet()
      type(cavitation_table_type) :: table
      type(film_counters) :: counters
      type(node_type) :: film, below
      real(wp) :: place(axes)
      integer :: side, last
      table = new_cavitation_table(pad, drive, .false., 3.2e-5_wp, most)
      do side = -1, 1, 2
         place = [0.61_wp, 0.47_wp, 0.33_wp, 2.0_wp*side]
         last = 0
         call table%look_up(place, .true., last, counters, film)
         place(4) = nearest(place(4), -real(side, wp))
         call table%look_up(place, .true., last, counters, below)
         call expect_close(maxval(abs(film%data(:, 1) - below%data(:, 1))), 0.0_wp, 1e-11_wp, 'cells meet')
         call expect_close(maxval(abs(film%data(:2, 2:4) - below%data(:2, 2:4))), 0.0_wp, 1e-11_wp, 'smoothly')
      end do
   end subroutine cells_meet

   !> Films from tables, and the same solved more finely.
   subroutine make_solvers(table, fine)
      class(film_solver_type), allocatable, intent(out) :: table, fine
      type(pad_gap_type) :: gap
      gap = offset_pad()
      table = new_table_film(new_direct_film([gap], enough_cells([gap]), enough_modes([gap]), 80, 8, &
         & cavitation_reynolds, tolerance), .true., 3.2e-5_wp)
      fine = new_direct_film([gap], 64, 16, 240, 24, cavitation_reynolds)
   end subroutine make_solvers

   !> A motion whose film is full or not.
   type(film_motion) function random_motion(full) result(motion)
      logical, intent(in) :: full
      if (full) then
         motion%position = clearance*[between(-0.4_wp, -0.2_wp), between(0.2_wp, 0.5_wp)]
         motion%velocity = clearance*speed*[between(-0.1_wp, 0.1_wp), between(0.05_wp, 0.15_wp)]
      else
         motion%position = clearance*[between(-0.1_wp, 0.2_wp), between(0.2_wp, 0.5_wp)]
         motion%velocity = clearance*speed*[between(-0.1_wp, 0.1_wp), between(-0.1_wp, 0.1_wp)]
      end if
   end function random_motion

   !> Films of one kind: how many of them come from tables, and their largest error over the force of the film that is
   !> squeezed at a quarter of the speed of the clearance.
   subroutine compare(full, trials, found, worst)
      logical, intent(in) :: full
      integer, intent(in) :: trials
      integer, intent(out) :: found
      real(wp), intent(out) :: worst
      class(film_solver_type), allocatable :: table, fine
      type(film_response) :: film, exact, squeezed
      type(film_motion) :: motion
      integer :: trial, time
      call make_solvers(table, fine)
      worst = 0
      found = 0
      do trial = 1, trials
         motion = random_motion(full)
         do time = 1, 20
            call table%evaluate_pad(1, motion, uneven, speed, .false., film)
         end do
         call fine%evaluate_pad(1, motion, uneven, speed, .false., exact)
         call fine%evaluate_pad(1, film_motion(motion%position, clearance*speed*[0.0_wp, 0.25_wp]), uneven, 0.0_wp, &
            & .false., squeezed)
         call expect(film%status == film_ok .and. exact%status == film_ok, 'solved')
         worst = max(worst, norm2(film%force - exact%force)/norm2(squeezed%force))
      end do
      found = int(table%counters%looked_up)
   end subroutine compare

   !> Full films keep to the tolerance of full films.
   subroutine full_films()
      integer :: found
      real(wp) :: worst
      call compare(.true., 60, found, worst)
      call expect(found > 30*20, to_text(found)//' come from the table')
      call expect(worst < 1e-5_wp, 'error '//to_text(worst))
   end subroutine full_films

   !> Cavitated films: as close as the volumes of the finer solver, which err by up to 2e-4.
   subroutine cavitated_films()
      integer :: found
      real(wp) :: worst
      call compare(.false., 25, found, worst)
      call expect(found > 20*12, to_text(found)//' come from the table')
      call expect(worst < 3e-4_wp, 'error '//to_text(worst))
   end subroutine cavitated_films

   !> Derivatives from tables against differences of their forces, for full and cavitated films.
   subroutine derivatives()
      class(film_solver_type), allocatable :: table, fine
      type(film_motion) :: motion, moved
      type(film_response) :: film, ahead, back
      real(wp) :: step(4), moves(4), found(2, 4)
      integer :: trial, time, k
      call make_solvers(table, fine)
      step = 1e-5_wp*[clearance, clearance, clearance*speed, clearance*speed]
      do trial = 1, 12
         motion = random_motion(mod(trial, 2) == 0)
         do time = 1, 20
            call table%evaluate_pad(1, motion, uneven, speed, .true., film)
         end do
         do k = 1, 4
            moves = 0
            moves(k) = step(k)
            moved = film_motion(motion%position + moves(:2), motion%velocity + moves(3:))
            call table%evaluate_pad(1, moved, uneven, speed, .false., ahead)
            moved = film_motion(motion%position - moves(:2), motion%velocity - moves(3:))
            call table%evaluate_pad(1, moved, uneven, speed, .false., back)
            found(:, k) = (ahead%force - back%force)/(2*step(k))
         end do
         call expect(norm2(film%derivatives(:, :2) - found(:, :2)) < 1e-5_wp*norm2(found(:, :2)), 'over position')
         call expect(norm2(film%derivatives(:, 3:) - found(:, 3:)) < 1e-5_wp*norm2(found(:, 3:)), 'over velocity')
      end do
      call expect(table%counters%looked_up > 200, 'films come from the table')
   end subroutine derivatives

   !> Weights of even oil, thinner by a factor, are that oil. Volumes take wedge and squeeze from other points: that is
   !> a small part of the tolerance of the tables, which is 3.2e-5.
   subroutine even_weights()
      real(wp), parameter :: factor = 1.7_wp
      class(film_solver_type), allocatable :: table, fine
      type(film_oil) :: weighted
      type(film_response) :: with, plain
      type(film_motion) :: motion
      integer :: time
      call make_solvers(table, fine)
      weighted = film_oil(paper_oil%viscosity, .true.)
      weighted%flow(0) = log(factor)
      motion = film_motion(clearance*[0.05_wp, 0.4_wp], clearance*speed*[0.02_wp, -0.02_wp])
      do time = 1, 20
         call table%evaluate_pad(1, motion, weighted, speed, .true., with)
         call table%evaluate_pad(1, motion, film_oil(paper_oil%viscosity/factor), speed, .true., plain)
      end do
      call expect(table%counters%looked_up > 20, 'films come from both tables')
      call expect_close(norm2(with%force - plain%force)/norm2(plain%force), 0.0_wp, 1e-6_wp, 'force')
      call expect_close(norm2(with%derivatives - plain%derivatives)/norm2(plain%derivatives), 0.0_wp, 1e-5_wp, &
         & 'derivatives')
   end subroutine even_weights

   !> Another oil has tables of its own: bit by bit those of a solver that has known no other.
   subroutine another_oil()
      class(film_solver_type), allocatable :: table, fine, other
      type(film_response) :: film, there
      type(film_oil) :: before
      integer :: time
      type(film_motion) :: motion
      call make_solvers(table, fine)
      other = table
      before = uneven
      before%flow(1) = 0.2_wp
      motion = random_motion(.true.)
      do time = 1, 20
         call table%evaluate_pad(1, motion, before, speed, .true., film)
      end do
      do time = 1, 20
         call table%evaluate_pad(1, motion, uneven, speed, .true., film)
         call other%evaluate_pad(1, motion, uneven, speed, .true., there)
      end do
      call expect(.not. any(abs(film%force - there%force) > 0), 'the same films')
      call expect(other%counters%looked_up > 0, 'from a table')
   end subroutine another_oil
end program test_uneven_table
