!> The film by elimination against over-relaxation of the same equations, its slopes, and its starts.
program test_elimination_film
   use kinds, only: wp, degree
   use text, only: to_text
   use film_solver, only: film_motion, film_response, film_counters, film_ok, cavitation_none, &
      & cavitation_reynolds
   use pad_gap, only: pad_gap_type
   use film_grid, only: film_grid_type, new_film_grid
   use elimination_film, only: elimination_film_type, new_elimination_film
   use sor_film, only: sor_film_type, sor_options, new_sor_film
   use paper_bearing, only: paper_oil, paper_pad, speed, clearance
   use check, only: runs, expect, expect_close, between, report
   implicit none (type, external)

   integer, parameter :: grids(2, 3) = reshape([24, 6, 30, 9, 12, 2], [2, 3])
   integer :: i

   do i = 1, size(grids, 2)
      if (runs('against_relaxation')) then
         call against_relaxation(grids(1, i), grids(2, i), .true., [0.0_wp, 0.0_wp, 0.0_wp])
         call against_relaxation(grids(1, i), grids(2, i), .true., [3e5_wp, 1e5_wp, -1e5_wp])
         call against_relaxation(grids(1, i), grids(2, i), .false., [3e5_wp, 1e5_wp, 0.0_wp])
      end if
   end do
   if (runs('empty_film')) call empty_film()
   if (runs('many_columns')) call many_columns()
   if (runs('rounds')) call rounds()
   if (runs('highest')) call highest()
   call report()

contains

   !> A film that converges or diverges, with squeeze of either sign.
   type(film_motion) function random_motion()
      random_motion%position = clearance*[between(-0.5_wp, 0.4_wp), between(0.0_wp, 0.6_wp)]
      random_motion%velocity = clearance*speed*[between(-0.3_wp, 0.3_wp), between(-0.3_wp, 0.3_wp)]
   end function random_motion

   !> Over-relaxation stops at a residual of 1e-12 of the source; on these grids the error of its solution is
   !> at most some 100 times that, and its slopes are solutions of the same kind.
   subroutine against_relaxation(columns, rows, cavitates, pressures)
      integer, intent(in) :: columns, rows
      logical, intent(in) :: cavitates
      real(wp), intent(in) :: pressures(3)
      real(wp), parameter :: tolerance = 1e-9_wp
      integer, parameter :: trials = 40
      type(pad_gap_type) :: film
      type(elimination_film_type) :: direct
      type(sor_film_type) :: sor
      type(film_counters) :: counters
      type(film_motion) :: motion
      type(film_response) :: r, expected
      real(wp) :: worst, worst_slope, worst_pressure
      integer :: trial, cavitated, k
      film = paper_pad(pressures)
      direct = new_elimination_film(film, columns, rows)
      sor = new_sor_film([film], sor_options(columns, rows, tolerance=1e-12_wp, max_sweeps=100000, &
         & cavitation=merge(cavitation_reynolds, cavitation_none, cavitates)))
      worst = 0
      worst_slope = 0
      worst_pressure = 0
      cavitated = 0
      do trial = 1, trials
         motion = random_motion()
         call direct%evaluate(motion, paper_oil, speed, cavitates, .true., counters, r)
         call sor%evaluate_pad(1, motion, paper_oil, speed, .true., expected)
         if (r%status /= film_ok) worst = huge(worst)
         if (any(sor%pressure_field(1) <= pressures(3))) cavitated = cavitated + 1
         worst = max(worst, deviation(r%force, expected%force))
         worst_pressure = max(worst_pressure, deviation([r%max_pressure], [expected%max_pressure]))
         do k = 1, 4
            worst_slope = max(worst_slope, deviation(r%derivatives(:, k), expected%derivatives(:, k)))
         end do
      end do
      associate (name => to_text(columns)//' x '//to_text(rows)//merge(' cavitated', ' full     ', cavitates))
         call expect(worst < tolerance, name//': force, error '//to_text(worst))
         call expect(worst_pressure < tolerance, name//': highest pressure, error '//to_text(worst_pressure))
         call expect(worst_slope < tolerance, name//': slopes, error '//to_text(worst_slope))
         if (cavitates) call expect(cavitated > trials/4, name//': films do cavitate, '//to_text(cavitated))
      end associate
   end subroutine against_relaxation

   !> Relative; absolute where nothing is expected.
   pure real(wp) function deviation(found, expected)
      real(wp), intent(in) :: found(:), expected(:)
      deviation = norm2(found - expected)
      if (norm2(expected) > 0) deviation = deviation/norm2(expected)
   end function deviation

   !> A pad that the journal leaves: nothing but cavitation, no force, no slopes; and back.
   subroutine empty_film()
      type(elimination_film_type) :: direct
      type(film_counters) :: counters
      type(film_motion) :: motion
      type(film_response) :: r, before
      direct = new_elimination_film(paper_pad(), 24, 6)
      motion%position = clearance*[-0.2_wp, 0.3_wp]
      call direct%evaluate(motion, paper_oil, speed, .true., .true., counters, before)
      motion%velocity = [0.0_wp, -10*clearance*speed]
      call direct%evaluate(motion, paper_oil, speed, .true., .true., counters, r)
      call expect(r%status == film_ok .and. all(abs(r%force) <= 0) .and. all(abs(r%derivatives) <= 0), 'nothing left')
      motion%velocity = 0
      call direct%evaluate(motion, paper_oil, speed, .true., .true., counters, r)
      call expect_close(r%force(2), before%force(2), 1e-12_wp*abs(before%force(2)), 'the film comes back')
      call expect(all(abs(r%derivatives - before%derivatives) <= 1e-10_wp*maxval(abs(before%derivatives))), &
         & 'so do its slopes')
   end subroutine empty_film

   !> A long pad opposite the journal: its film is thickest in the middle, and from its leading edge on grows by one
   !> column a round, which takes 126 of them on the finer grid. The error falls with the second power of the columns.
   subroutine many_columns()
      type(pad_gap_type) :: gap
      type(elimination_film_type) :: film
      type(film_counters) :: counters
      type(film_response) :: coarse, fine
      gap = paper_pad()
      gap%leading_angle = 80*degree
      gap%trailing_angle = gap%leading_angle
      associate (motion => film_motion([0.0_wp, -0.97_wp*clearance]))
         film = new_elimination_film(gap, 160, 2)
         call film%evaluate(motion, paper_oil, speed, .true., .false., counters, coarse)
         film = new_elimination_film(gap, 640, 2)
         call film%evaluate(motion, paper_oil, speed, .true., .false., counters, fine)
      end associate
      call expect(fine%status == film_ok, 'the cavitation settles')
      call expect(deviation(coarse%force, fine%force) < 2e-3_wp, 'where it does on fewer columns')
   end subroutine many_columns

   !> A film that diverges at its trailing edge ends beyond the cells that are left of the whole one. It grows to where
   !> it ends in a few rounds; by one column a round it would take up to 40.
   subroutine rounds()
      type(elimination_film_type) :: film
      type(film_counters) :: counters
      type(film_response) :: r
      integer :: k, most
      most = 0
      film = new_elimination_film(paper_pad(), 160, 10)
      do k = 1, 9
         counters%passes = 0
         call film%start_from()
         associate (motion => film_motion(clearance*[0.0_wp, 0.08_wp*k]))
            call film%evaluate(motion, paper_oil, speed, .true., .false., counters, r)
         end associate
         most = max(most, int(counters%passes))
      end do
      call expect(most <= 8, 'rounds of a film at most: '//to_text(most))
   end subroutine rounds

   !> A field that is a parabola along the arc, with its top between the middles of columns of any widths, and across
   !> the width an even polynomial of the degree that the rows allow: its top comes from its means to rounding. From
   !> the highest mean alone it would be too low by what the field falls over half a column and half a row.
   subroutine highest()
      type(film_grid_type) :: grid
      real(wp) :: angles(0:12), means(12), face(0:5), across(5), middle, power(3)
      integer :: rows, i, k
      real(wp), parameter :: top = 0.07_wp, height = 3e6_wp
      do rows = 1, 5
         do i = 0, 12
            angles(i) = (i/12.0_wp - 0.5_wp)*70*degree + merge(0.02_wp, 0.0_wp, mod(i, 3) == 1)
         end do
         grid = new_film_grid(paper_pad(), 12, rows, angles)
         power = [1.0_wp, merge(-0.3_wp, 0.0_wp, rows > 1), merge(-0.5_wp, 0.0_wp, rows > 2)]
         face(0) = 0
         do k = 1, rows
            face(k) = face(k - 1) + grid%height(k)/rows
            across(k) = sum(power*[(face(k)**(2*i + 1) - face(k - 1)**(2*i + 1), i=0, 2)]/[1, 3, 5]) &
               & /(face(k) - face(k - 1))
         end do
         middle = dot_product(grid%to_middle, across(:rows))
         call expect_close(middle, 1.0_wp, 1e-13_wp, 'in the middle plane, '//to_text(rows)//' rows')
         means = [(height*(1 - ((angles(i) - top)**3 - (angles(i - 1) - top)**3)/(3*(angles(i) - angles(i - 1)))), &
            & i=1, 12)]
         call expect_close(grid%highest(means), height, 1e-12_wp*height, 'along the arc')
         call expect(maxval(means) < (1 - 1e-4_wp)*height, 'not the highest mean')
         call expect_close(grid%highest(means(12:1:-1) - 2*height), max(grid%supply, grid%ambient), 0.0_wp, &
            & 'nothing higher than the edges')
      end do
   end subroutine highest
end program test_elimination_film
