!> What cavitation leaves of a film: its order of convergence, its slopes. The table of it: continuous between cells,
!> both ends of T, the error relative to the force that is there, and that neither the order of visits nor a table that
!> was full changes a bit. That films are right is for test_film_accuracy.
program test_cavitation_table
   use kinds, only: wp, i8, degree
   use text, only: to_text
   use pad_gap, only: pad_gap_type
   use dimensionless_pad, only: dimensionless_pad_type, new_dimensionless_pad, unit_oil
   use force_ratio, only: force_ratio_solver, force_ratio_type, new_force_ratio_solver
   use cavitated_film, only: cavitated_film_type, cavitation_table_type, node_type, new_cavitated_film, &
      & new_cavitation_table, axes
   use rotation_drive, only: rotation_drive_type, new_rotation_drive
   use cell_index, only: interval, lower_end
   use check, only: runs, expect, expect_close, between, report
   use film_solver, only: film_counters
   implicit none (type, external)

   real(wp), parameter :: half_arc = 35*degree, tolerance = 1e-4_wp
   !> Thicknesses at the edges, and T.
   real(wp), parameter :: films(3, 4) = reshape([0.8_wp, 0.4_wp, 0.15_wp, 0.5_wp, 0.9_wp, 0.4_wp, &
      & 0.3_wp, 0.3_wp, 0.7_wp, 1.5_wp, 0.2_wp, 0.3_wp], [3, 4])
   !> Most cells and nodes of a table.
   integer, parameter :: most = 20000
   type(dimensionless_pad_type) :: pad
   type(rotation_drive_type) :: even
   type(film_counters) :: counters
   integer :: i

   associate (gap => pad_gap_type(0.0_wp, 1.0_wp, 2.0_wp, half_arc, half_arc, 0.0_wp, 0.0_wp, 0.0_wp))
      pad = new_dimensionless_pad(gap)
   end associate
   even = new_rotation_drive(pad, unit_oil)
   do i = 1, size(films, 2)
      if (runs('slopes')) call slopes(.false., films(:2, i), films(3, i))
      if (runs('slopes')) call slopes(.true., films(:2, i), films(3, i))
      if (runs('convergence')) call convergence(films(:2, i), films(3, i))
   end do
   if (runs('closed')) call closed(.false.)
   if (runs('closed')) call closed(.true.)
   if (runs('between_cells')) call between_cells(.false.)
   if (runs('between_cells')) call between_cells(.true.)
   if (runs('both_ends')) call both_ends(.false.)
   if (runs('both_ends')) call both_ends(.true.)
   if (runs('relative_error')) call relative_error()
   if (runs('beside_closed')) call beside_closed()
   if (runs('costs')) call costs(spread=.true.)
   if (runs('costs')) call costs(spread=.false.)
   if (runs('full_table')) call full_table(.false.)
   if (runs('full_table')) call full_table(.true.)
   call report()

contains

   !> Slopes against central differences over 0.02: of cells that cavitate one by one the differences keep the noise,
   !> some of the tolerance over the step; relative to the force, with Guembel's condition, by which it ends without a
   !> power of 1 - T, and a tenth of that at onset.
   subroutine slopes(gumbel, edges, t)
      logical, intent(in) :: gumbel
      real(wp), intent(in) :: edges(2), t
      real(wp), parameter :: step = 0.02_wp
      type(force_ratio_solver) :: solver
      type(force_ratio_type) :: ratio
      complex(wp) :: long, short
      real(wp) :: shift(3), floor
      integer :: k
      floor = merge(0.1_wp, 0.0_wp, gumbel)
      solver = new_force_ratio_solver(pad, even, gumbel, 0.01_wp*tolerance)
      ratio = solver%at(edges, pad%tangent*(1 - 2*t), 0.0_wp)
      do k = 1, 3
         shift = 0
         shift(k) = step*merge(minval(edges), pad%tangent, k < 3)
         long = difference(solver, edges, pad%tangent*(1 - 2*t), shift)
         short = difference(solver, edges, pad%tangent*(1 - 2*t), 0.5_wp*shift)
         ! the error of the longer difference is 4/3 of how far the two are apart, and the noise comes to it
         call expect_close(abs(ratio%slopes(k) - (4*short - long)/3)*shift(k)/(abs(ratio%value) + floor), 0.0_wp, &
            & 0.5_wp*tolerance, 'slope '//to_text(k)//merge(' gumbel  ', ' reynolds', gumbel)//' T = '//to_text(t))
      end do
   end subroutine slopes

   !> Difference quotient of a film's ratio over this change of the thicknesses at its edges and of w_2.
   complex(wp) function difference(solver, edges, w_2, change)
      type(force_ratio_solver), intent(inout) :: solver
      real(wp), intent(in) :: edges(2), w_2, change(3)
      type(force_ratio_type) :: ahead, back
      ahead = solver%at(edges + change(:2), w_2 + change(3), 0.0_wp)
      back = solver%at(edges - change(:2), w_2 - change(3), 0.0_wp)
      difference = (ahead%value - back%value)/(2*sum(change))
   end function difference

   !> Of 10, 20 and 40 rows (the resolution follows the cube root of the tolerance): the ratio converges at least with
   !> the cubes of the cells, and its slopes with their squares. Without the end of the film between the cells slopes
   !> are up to 5e-3 apart.
   subroutine convergence(edges, t)
      real(wp), intent(in) :: edges(2), t
      type(force_ratio_solver) :: solver
      type(force_ratio_type) :: ratio(3)
      integer :: i, k
      do i = 1, 3
         solver = new_force_ratio_solver(pad, even, .false., 4e-5_wp/8.0_wp**(i - 1))
         ratio(i) = solver%at(edges, pad%tangent*(1 - 2*t), 0.0_wp)
      end do
      associate (finest => ratio(3))
         call expect_close(abs(ratio(1)%value/finest%value - 1), 0.0_wp, 2e-4_wp, 'ratio, 10 rows, T = '//to_text(t))
         call expect_close(abs(ratio(2)%value/finest%value - 1), 0.0_wp, 2e-4_wp/8, 'ratio, 20 rows, T = '//to_text(t))
         do k = 1, 3
            associate (size_of => merge(edges(min(k, 2)), pad%tangent, k < 3)/abs(finest%value))
               call expect_close(abs(ratio(1)%slopes(k) - finest%slopes(k))*size_of, 0.0_wp, 4e-3_wp, &
                  & 'slope '//to_text(k)//', 10 rows, T = '//to_text(t))
               call expect_close(abs(ratio(2)%slopes(k) - finest%slopes(k))*size_of, 0.0_wp, 4e-3_wp/4, &
                  & 'slope '//to_text(k)//', 20 rows, T = '//to_text(t))
            end associate
         end do
      end associate
   end subroutine convergence

   !> A film that closes between its edges has none.
   subroutine closed(gumbel)
      logical, intent(in) :: gumbel
      type(force_ratio_solver) :: solver
      type(force_ratio_type) :: ratio
      solver = new_force_ratio_solver(pad, even, gumbel, tolerance)
      ratio = solver%at([0.1_wp, 0.1_wp], 0.0_wp, 0.0_wp)
      call expect(.not. ratio%ok, 'a closed film')
   end subroutine closed

   !> What a table finds in a place that is asked for until the table pays there; it is not ok if it never does.
   subroutine ask(table, place, film)
      type(cavitation_table_type), intent(inout) :: table
      real(wp), intent(in) :: place(3)
      type(node_type), intent(out) :: film
      integer :: time, last
      last = 0
      do time = 1, 5000
         call table%look_up([place, 0.0_wp], .true., last, counters, film)
         if (film%ok) exit
      end do
   end subroutine ask

   !> Thicknesses and T of an orbit's size: few cells.
   function random_place() result(place)
      real(wp) :: place(3)
      place = [between(0.3_wp, 0.9_wp), between(0.2_wp, 0.9_wp), between(0.0_wp, 1.0_wp)]
   end function random_place

   !> Across a face of two cells the force is the same to rounding.
   subroutine between_cells(gumbel)
      logical, intent(in) :: gumbel
      type(cavitation_table_type) :: table
      type(node_type) :: film, film_below
      real(wp) :: place(3), below(3), worst
      integer :: trial, axis
      table = new_cavitation_table(pad, even, gumbel, tolerance, most)
      worst = 0
      do trial = 1, 60
         place = random_place()
         axis = 1 + mod(trial, 3)
         if (axis < 3) place(axis) = lower_end(interval(place(axis), 3) + 1, 3)
         if (axis == 3) place(axis) = ceiling(16*place(3))/16.0_wp - 1/16.0_wp
         if (.not. place(3) > 0) cycle
         below = place
         below(axis) = nearest(place(axis), -1.0_wp)
         call ask(table, place, film)
         call ask(table, below, film_below)
         worst = max(worst, maxval(abs(film%data(:3, 1) - film_below%data(:3, 1))))
      end do
      call expect_close(worst, 0.0_wp, 1e-11_wp, 'cells meet')
   end subroutine between_cells

   !> At T next to 0 all of the force is left, next to 1 nothing.
   subroutine both_ends(gumbel)
      logical, intent(in) :: gumbel
      type(cavitation_table_type) :: table
      type(node_type) :: film
      real(wp) :: pressure
      complex(wp) :: force, slopes(axes)
      real(wp), parameter :: next_to_0(2) = [epsilon(1.0_wp), tiny(1.0_wp)], next_to_1 = nearest(1.0_wp, -1.0_wp)
      integer :: k
      table = new_cavitation_table(pad, even, gumbel, tolerance, most)
      do k = 1, 2
         call ask(table, [0.8_wp, 0.4_wp, next_to_0(k)], film)
         call expect(film%ok, 'there is a cell')
         call table%set_ratio(next_to_0(k), film, force, slopes, pressure)
         call expect_close(abs(force - 1), 0.0_wp, 1e-12_wp, 'the force at T = 0')
         call expect_close(maxval(abs(slopes(:2))), 0.0_wp, tolerance, 'and its slopes over the thicknesses')
         call expect_close(pressure, 1.0_wp, 1e-12_wp, 'the pressure is that of the full film')
      end do
      call ask(table, [0.8_wp, 0.4_wp, next_to_1], film)
      call expect(film%ok, 'there is a cell')
      call table%set_ratio(next_to_1, film, force, slopes, pressure)
      call expect_close(abs(force), 0.0_wp, 1e-12_wp, 'nothing at T = 1')
      call expect_close(maxval(abs(slopes)), 0.0_wp, 1e-12_wp, 'and its slopes vanish')
      call expect_close(pressure, 0.0_wp, 1e-12_wp, 'and no pressure')
   end subroutine both_ends

   !> The error is relative to the force that is there, of whatever size that is: over random films on pads of 30 to 100
   !> degrees, down to a millionth of the force at onset.
   subroutine relative_error()
      integer, parameter :: n = 200
      type(cavitation_table_type) :: table
      type(cavitated_film_type) :: reference
      type(dimensionless_pad_type) :: other
      type(pad_gap_type) :: gap
      type(node_type) :: film, exact
      real(wp) :: place(3), error(n), found
      integer :: k, last
      k = 0
      do while (k < n)
         associate (half => between(15.0_wp, 50.0_wp)*degree)
            gap = pad_gap_type(0.0_wp, 1.0_wp, between(0.4_wp, 1.6_wp), half, half, 0.0_wp, 0.0_wp, 0.0_wp)
         end associate
         other = new_dimensionless_pad(gap)
         table = new_cavitation_table(other, new_rotation_drive(other, unit_oil), .false., 4e-5_wp, most)
         reference = new_cavitated_film(other, new_rotation_drive(other, unit_oil), .false., 1e-6_wp)
         place = [0.05_wp*60**between(0.0_wp, 1.0_wp), 0.05_wp*60**between(0.0_wp, 1.0_wp), between(0.0_wp, 0.98_wp)]
         last = 0
         call ask(table, place, film)
         call reference%look_up([place, 0.0_wp], .false., last, counters, exact)
         if (.not. (film%ok .and. exact%ok)) cycle
         k = k + 1
         error(k) = norm2(film%data(:2, 1) - exact%data(:2, 1))
      end do
      found = count(error < 4e-5_wp)/real(n, wp)
      call expect(found > 0.5_wp, 'half of the films keep to the tolerance: '//to_text(found))
      found = count(error < 1e-3_wp)/real(n, wp)
      call expect(found > 0.95_wp, '95 % to 25 times as much: '//to_text(found))
   end subroutine relative_error

   !> Where a film nearly closes between its edges, the usual table answers only in cells that are small beside its
   !> least thickness, and errs by a hundredth of the force at most; a closer table answers everywhere.
   subroutine beside_closed()
      type(cavitation_table_type) :: table, closer
      type(cavitated_film_type) :: reference
      type(node_type) :: film, exact
      real(wp) :: place(3), least, worst
      integer :: trial, last, answered
      table = new_cavitation_table(pad, even, .false., 4e-5_wp, most)
      reference = new_cavitated_film(pad, even, .false., 1e-6_wp)
      closer = new_cavitation_table(pad, even, .false., 1e-5_wp, most)
      worst = 0
      answered = 0
      do trial = 1, 60
         ! the film is thinnest between its edges where both are about as thick
         least = 1e-3_wp*50**between(0.0_wp, 1.0_wp)
         place = [[1, 1]*(1 - (1 - least)*pad%cosine) + between(-0.02_wp, 0.02_wp)*[1, -1], between(0.0_wp, 0.9_wp)]
         if (pad%least_film(place(:2)) < 1e-3_wp) cycle
         last = 0
         last = 0
         call closer%look_up([place, 0.0_wp], .false., last, counters, film)
         call expect(film%ok, 'a closer table answers')
         call ask(table, place, film)
         if (.not. film%ok) cycle
         answered = answered + 1
         call reference%look_up([place, 0.0_wp], .false., last, counters, exact)
         call expect(exact%ok, 'a film')
         worst = max(worst, norm2(film%data(:2, 1) - exact%data(:2, 1)))
      end do
      call expect_close(worst, 0.0_wp, 1e-2_wp, 'beside a film that closes')
      call expect(answered > 20 .and. answered < 60, to_text(answered)//' of 60 are answered')
   end subroutine beside_closed

   !> Films that are solved without the table, and nodes, whose cost is sixty where that of such a film is five, cost at
   !> most 1.2 times all films without it, but for the first 100 nodes and the last cell; and where the same films come
   !> back, nearly nothing.
   subroutine costs(spread)
      logical, intent(in) :: spread
      integer, parameter :: asked = 20000
      type(cavitation_table_type) :: table
      type(film_counters) :: used
      type(node_type) :: film
      real(wp) :: place(3), cost
      integer :: time, last
      table = new_cavitation_table(pad, even, .true., tolerance, most)
      cost = 0
      last = 0
      do time = 1, asked
         place = random_place()
         place(3) = 0.25_wp + 0.75_wp*place(3)
         if (.not. spread) place(:2) = 0.6_wp + 0.1_wp*place(:2)
         call table%look_up([place, 0.0_wp], .false., last, used, film)
         if (.not. film%ok) cost = cost + 5
      end do
      cost = cost + 60*real(used%nodes - 100 - 8, wp)
      call expect(cost <= 1.2_wp*5*asked, 'full films that cost as much: '//to_text(cost))
      if (.not. spread) call expect(cost <= 0.2_wp*5*asked, 'the same films: '//to_text(cost))
   end subroutine costs

   !> Values and slopes of a table that is visited in another order and has room for 20 nodes alone.
   subroutine full_table(gumbel)
      logical, intent(in) :: gumbel
      integer, parameter :: n = 12
      type(cavitation_table_type) :: table, other
      type(node_type) :: film(n), there
      real(wp) :: places(3, n)
      integer :: k, different, pass
      integer(i8) :: at_first
      places = reshape([(random_place(), k=1, n)], [3, n])
      table = new_cavitation_table(pad, even, gumbel, tolerance, most)
      counters = film_counters()
      do k = 1, n
         call ask(table, places(:, k), film(k))
      end do
      at_first = counters%nodes
      other = new_cavitation_table(pad, even, gumbel, tolerance, 20)
      different = 0
      do pass = 1, 2
         do k = n, 1, -1
            call ask(other, places(:, k), there)
            if (any(abs(there%data(:, 1) - film(k)%data(:, 1)) > 0)) different = different + 1
            if (any(abs(there%data(:, 2:) - film(k)%data(:, 2:)) > 0)) different = different + 1
         end do
      end do
      call expect(different == 0, to_text(different)//' of '//to_text(n)//' are others')
      call expect(counters%nodes > 2*at_first, 'nodes are built again')
   end subroutine full_table
end program test_cavitation_table
