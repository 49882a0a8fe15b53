!> The table of full films: continuous between cells; neither the order of visits nor a table that was full matters; a
!> cell is built once films solved in it have cost as much, and so is a profile of the pressure. That its films are
!> right is for test_table_film and test_film_accuracy.
program test_full_film_table
   use kinds, only: wp, degree
   use text, only: to_text
   use film_solver, only: film_counters
   use pad_gap, only: pad_gap_type
   use dimensionless_pad, only: dimensionless_pad_type, new_dimensionless_pad, unit_oil
   use cell_index, only: interval, lower_end
   use rotation_drive, only: rotation_drive_type, new_rotation_drive
   use check, only: runs, expect, expect_close, between, report
   use full_film, only: full_film_forces, full_film_table_type, new_full_film_table
   implicit none (type, external)

   real(wp), parameter :: half_arc = 35*degree, tolerance = 1e-5_wp
   !> Most cells of a table.
   integer, parameter :: most = 4000
   type(dimensionless_pad_type) :: pad
   type(rotation_drive_type) :: even
   type(film_counters) :: counters

   associate (gap => pad_gap_type(0.0_wp, 1.0_wp, 2.0_wp, half_arc, half_arc, 0.0_wp, 0.0_wp, 0.0_wp))
      pad = new_dimensionless_pad(gap)
   end associate
   even = new_rotation_drive(pad, unit_oil)
   if (runs('between_cells')) call between_cells()
   if (runs('full_table')) call full_table()
   if (runs('built_when_due')) call built_when_due()
   call report()

contains

   !> Thicknesses of any size that leave the film open: 0.05 thick at least.
   function random_edges() result(edges)
      real(wp) :: edges(2)
      do
         edges = [0.1_wp*15**between(0.0_wp, 1.0_wp), 0.1_wp*15**between(0.0_wp, 1.0_wp)]
         if (minval(edges) > 0 .and. norm2(pad%position(edges)) < 0.95_wp) exit
      end do
   end function random_edges

   !> On both sides of an end of a cell the values are the same to rounding where cells are of one size, as here; the
   !> slopes to their error: that of a polynomial of degree n is up to n^2 times that of its values over half a cell,
   !> which is an eighth of the thickness or more (Markov).
   subroutine between_cells()
      type(full_film_table_type) :: table
      real(wp) :: edges(2), below(2), worst, worst_slope
      type(full_film_forces) :: film, film_below
      integer :: trial, last, axis
      logical :: good
      table = new_full_film_table(pad, even, .false., tolerance, most)
      last = 0
      worst = 0
      worst_slope = 0
      do trial = 1, 40
         edges = [between(0.4_wp, 1.5_wp), between(0.4_wp, 1.5_wp)]
         axis = 1 + mod(trial, 2)
         edges(axis) = lower_end(interval(edges(axis), 1) + 1, 1)
         if (norm2(pad%position(edges)) > 0.95_wp) cycle
         below = edges
         below(axis) = nearest(edges(axis), -1.0_wp)
         call table%look_up(edges, .true., last, counters, film, good)
         call table%look_up(below, .true., last, counters, film_below, good)
         associate (m => film%of_velocity(:3), slope => film%velocity_slopes(:3, :) - film_below%velocity_slopes(:3, :))
            worst = max(worst, norm2(m - film_below%of_velocity(:3))/norm2(m))
            do axis = 1, 2
               worst_slope = max(worst_slope, edges(axis)*norm2(slope(:, axis))/norm2(m))
            end do
         end associate
      end do
      call expect(worst_slope > 0, 'there are ends of cells')
      call expect(worst < 1e-11_wp, 'values jump by '//to_text(worst))
      call expect(worst_slope < 2*25*8*tolerance, 'slopes jump by '//to_text(worst_slope))
   end subroutine between_cells

   !> Values, slopes and pressures of a table that is visited in another order and has room for 3 cells alone, to the
   !> errors of what is solved where there is no cell.
   subroutine full_table()
      integer, parameter :: n = 40
      type(full_film_table_type) :: table, other
      type(film_counters) :: again
      type(full_film_forces) :: film(n), there
      real(wp) :: edges(2, n), pressure(n), pressure_there, w(2)
      real(wp) :: worst, worst_slope, worst_pressure
      integer :: k, last
      logical :: good(n), good_there
      w = [1.0_wp, 0.5_wp]
      edges = reshape([(random_edges(), k=1, n)], [2, n])
      edges(:, n) = [0.05_wp, 0.9_wp]
      table = new_full_film_table(pad, even, .true., tolerance, most)
      counters = film_counters()
      last = 0
      do k = 1, n
         call table%look_up(edges(:, k), .true., last, counters, film(k), good(k))
         call table%highest_pressure(edges(:, k), w, 0.1_wp, last, counters, pressure(k))
      end do
      other = new_full_film_table(pad, even, .true., tolerance, 3)
      last = 0
      worst = 0
      worst_slope = 0
      worst_pressure = 0
      do k = n, 1, -1
         call other%look_up(edges(:, k), .true., last, again, there, good_there)
         associate (norm => norm2(film(k)%of_velocity(:3)))
            worst = max(worst, norm2(there%of_velocity(:3) - film(k)%of_velocity(:3))/norm)
            worst_slope = max(worst_slope, minval(edges(:, k)) &
               & *norm2(there%velocity_slopes(:3, :) - film(k)%velocity_slopes(:3, :))/norm)
         end associate
         call other%highest_pressure(edges(:, k), w, 0.1_wp, last, again, pressure_there)
         worst_pressure = max(worst_pressure, abs(pressure_there/pressure(k) - 1))
         call expect(good(k) .and. good_there, 'a film')
      end do
      call expect_close(worst, 0.0_wp, tolerance, 'values')
      call expect_close(worst_slope, 0.0_wp, 25*8*tolerance, 'slopes')
      call expect_close(worst_pressure, 0.0_wp, 1e-3_wp, 'pressures')
   end subroutine full_table

   !> In a table that has built many cells, films of a place are solved until they have cost what a cell costs;
   !> pressures of a place until they have cost a profile.
   subroutine built_when_due()
      type(full_film_table_type) :: table
      type(film_counters) :: count
      type(full_film_forces) :: film, solved
      real(wp) :: pressure, pressure_then
      integer :: k, last
      logical :: good
      table = new_full_film_table(pad, even, .false., tolerance, most)
      do k = 0, 31
         last = 0
         call table%look_up(1.01_wp*lower_end([-4 + k/8, -4 + modulo(k, 8)], 1), .false., last, count, film, good)
      end do
      call expect(count%cells >= 32 .and. count%fourier < 32, 'the first cells are built at once')
      count = film_counters()
      last = 0
      do k = 1, 100
         call table%look_up([5.0_wp, 6.0_wp], .true., last, count, film, good)
         if (k == 1) solved = film
         call expect(good, 'a film')
      end do
      call expect(count%cells == 1, 'a cell of many visits is built')
      call expect(count%fourier > 10 .and. count%fourier < 36, to_text(int(count%fourier))//' films are solved before')
      associate (m => solved%of_velocity(:3))
         call expect_close(norm2(film%of_velocity(:3) - m), 0.0_wp, tolerance*norm2(m), 'the same film')
      end associate
      do k = 1, 200
         call table%highest_pressure([5.0_wp, 6.0_wp], [1.0_wp, 2.0_wp], 0.0_wp, last, count, pressure)
         if (k == 1) pressure_then = pressure
         if (k == 20) call expect(count%profiles == 0, 'a few pressures are solved')
      end do
      call expect(count%profiles == 1, 'a profile of many pressures is built')
      call expect_close(pressure, pressure_then, 1e-3_wp*pressure, 'the same pressure')
   end subroutine built_when_due
end program test_full_film_table
