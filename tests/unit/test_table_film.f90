!> The solver whose films are tables: every kind of pad and film against solvers that know no table, what is left to
!> them, and that pads, visits and their order change nothing.
program test_table_film
   use kinds, only: wp, degree
   use text, only: to_text
   use film_solver, only: film_solver_type, film_motion, film_response, film_ok, film_closed, none => cavitation_none, &
      & gumbel => cavitation_gumbel, reynolds => cavitation_reynolds
   use pad_gap, only: pad_gap_type
   use film_resolution, only: enough_cells, enough_modes
   use fourier_film, only: fourier_film_type, new_fourier_film
   use direct_film, only: direct_film_type, new_direct_film
   use table_film, only: new_table_film
   use film_differences, only: difference
   use paper_bearing, only: paper_oil, paper_pad, offset_pad, speed, clearance
   use check, only: runs, expect, expect_close, between, report
   implicit none (type, external)

   !> Error that the tables may have.
   real(wp), parameter :: tolerance = 1e-4_wp
   integer :: i

   if (runs('full_films')) call full_films()
   if (runs('arcs')) call arcs()
   if (runs('no_force_left')) call no_force_left()
   if (runs('straight_squeeze')) call straight_squeeze()
   do i = none, reynolds
      if (runs('slopes')) call slopes(i)
      if (runs('repeats')) call repeats(i)
   end do
   if (runs('unequal_pressures')) call unequal_pressures()
   if (runs('solved_once')) call solved_once()
   if (runs('ambient')) call ambient()
   if (runs('alike')) call alike()
   if (runs('closed')) call closed()
   if (runs('set_cavitation')) call set_cavitation()
   if (runs('pressures')) call pressures()
   if (runs('pushes')) call pushes(reynolds)
   if (runs('pushes')) call pushes(gumbel)
   call report()

contains

   !> A solver with tables, and those that stand in.
   subroutine make_tables(gaps, condition, film)
      type(pad_gap_type), intent(in) :: gaps(:)
      integer, intent(in) :: condition
      class(film_solver_type), allocatable, intent(out) :: film
      film = new_table_film(solver(gaps, condition), .true., tolerance)
   end subroutine make_tables

   !> Films without tables.
   subroutine make_solver(gaps, condition, film)
      type(pad_gap_type), intent(in) :: gaps(:)
      integer, intent(in) :: condition
      class(film_solver_type), allocatable, intent(out) :: film
      film = solver(gaps, condition)
   end subroutine make_solver

   function solver(gaps, condition) result(film)
      type(pad_gap_type), intent(in) :: gaps(:)
      integer, intent(in) :: condition
      type(direct_film_type) :: film
      film = new_direct_film(gaps, enough_cells(gaps), enough_modes(gaps), 80, 8, condition, tolerance)
   end function solver

   !> A loaded film: it converges, and is squeezed a little either way.
   type(film_motion) function loaded_motion()
      loaded_motion%position = clearance*[between(-0.4_wp, -0.2_wp), between(0.2_wp, 0.5_wp)]
      loaded_motion%velocity = clearance*speed*[between(-0.1_wp, 0.1_wp), between(-0.1_wp, 0.1_wp)]
   end function loaded_motion

   !> Force of the film that is driven by `across` along the middle's outward direction: what errors are measured over
   !> where a film has little force.
   real(wp) function squeezed(gap, motion)
      type(pad_gap_type), intent(in) :: gap
      type(film_motion), intent(in) :: motion
      type(fourier_film_type) :: film
      type(film_response) :: r(1)
      real(wp) :: middle
      middle = 0.5_wp*(gap%leading_angle - gap%trailing_angle)
      film = new_fourier_film([gap], enough_cells([gap]), enough_modes([gap]), .false., tolerance)
      call film%evaluate([film_motion(motion%position, 0.25_wp*clearance*speed*[sin(middle), cos(middle)])], &
         & [paper_oil], 0.0_wp, .false., r)
      squeezed = norm2(r(1)%force)
   end function squeezed

   subroutine expect_same_bits(found, expected, what)
      type(film_response), intent(in) :: found, expected
      character(len=*), intent(in) :: what
      call expect(found%status == expected%status, 'status, '//what)
      call expect(.not. any(abs(found%force - expected%force) > 0), 'force, '//what)
      call expect(.not. any(abs(found%derivatives - expected%derivatives) > 0), 'slopes, '//what)
      call expect(.not. abs(found%min_film_thickness - expected%min_film_thickness) > 0, 'thickness, '//what)
   end subroutine expect_same_bits

   !> Full films of pads of any length and any pressures around them, without cavitation: the tables meet the modes
   !> within both tolerances.
   subroutine full_films()
      type(pad_gap_type) :: gaps(4)
      class(film_solver_type), allocatable :: film
      type(fourier_film_type) :: fine
      type(film_motion) :: motion
      type(film_response) :: found(4), expected(4)
      real(wp) :: worst, worst_slope
      integer :: trial, k
      gaps = [offset_pad(), offset_pad(length=0.07_wp), offset_pad([3e6_wp, 1e5_wp, 0.0_wp]), &
         & offset_pad([1e5_wp, 2e5_wp, -1e5_wp])]
      call make_tables(gaps, none, film)
      fine = new_fourier_film(gaps, 96, 32, .false., 1e-6_wp)
      worst = 0
      worst_slope = 0
      do trial = 1, 20
         motion = loaded_motion()
         call film%evaluate([(motion, k=1, 4)], spread(paper_oil, 1, 4), speed, .true., found)
         call fine%evaluate([(motion, k=1, 4)], spread(paper_oil, 1, 4), speed, .true., expected)
         do k = 1, 4
            worst = max(worst, norm2(found(k)%force - expected(k)%force)/squeezed(gaps(k), motion))
            worst_slope = max(worst_slope, norm2((found(k)%derivatives(:, :2) - expected(k)%derivatives(:, :2))) &
               & /norm2(expected(k)%derivatives(:, :2)), norm2(found(k)%derivatives(:, 3:) &
               & - expected(k)%derivatives(:, 3:))/norm2(expected(k)%derivatives(:, 3:)))
         end do
      end do
      call expect(film%counters%looked_up == 80 .and. film%counters%fourier == 0, 'all are looked up')
      call expect(worst < tolerance, 'force, error '//to_text(worst))
      call expect(worst_slope < 10*tolerance, 'slopes, error '//to_text(worst_slope))
   end subroutine full_films

   !> Arcs of 5 to 175 degrees, of which those beyond 149 have no table, cavitated and not.
   subroutine arcs()
      real(wp), parameter :: angles(7) = [5.0_wp, 20.0_wp, 60.0_wp, 120.0_wp, 148.0_wp, 150.0_wp, 175.0_wp]
      class(film_solver_type), allocatable :: film
      class(film_solver_type), allocatable :: exact
      type(pad_gap_type) :: gap
      type(film_motion) :: motion
      type(film_response) :: found(1), expected(1)
      real(wp) :: error
      integer :: k
      do k = 1, size(angles)
         gap = paper_pad()
         gap%leading_angle = 0.5_wp*angles(k)*degree
         gap%trailing_angle = gap%leading_angle
         call make_tables([gap], gumbel, film)
         exact = new_direct_film([gap], 384, 64, 80, 8, gumbel)
         motion%position = clearance*[-0.3_wp, 0.3_wp]
         motion%velocity = clearance*speed*[0.02_wp, -0.1_wp]
         call film%evaluate([motion], [paper_oil], speed, .true., found)
         call exact%evaluate([motion], [paper_oil], speed, .true., expected)
         call expect(found(1)%status == film_ok, 'an open film')
         call expect((film%counters%looked_up == 1) .eqv. angles(k) < 149, 'what has a table, '//to_text(angles(k)))
         error = norm2(found(1)%force - expected(1)%force)/max(norm2(expected(1)%force), squeezed(gap, motion))
         call expect(error < 3*tolerance, to_text(angles(k))//' degrees, error '//to_text(error))
      end do
   end subroutine arcs

   !> T >= 1, exactly and beyond: a film that opens everywhere has no force and no slopes.
   subroutine no_force_left()
      class(film_solver_type), allocatable :: film
      type(film_response) :: found(1)
      type(film_motion) :: motion
      integer :: k, condition
      do condition = gumbel, reynolds
         call make_tables([offset_pad()], condition, film)
         do k = 1, 5
            motion = film_motion(clearance*[between(-0.4_wp, 0.4_wp), between(-0.4_wp, 0.4_wp)], &
               & -clearance*speed*[0.0_wp, 2.0_wp])
            call film%evaluate([motion], [paper_oil], speed, .true., found)
            call expect(norm2(found(1)%force) <= 0 .and. norm2(found(1)%derivatives) <= 0, 'no force')
            call film%take_pressures([motion], [paper_oil], speed, found)
            call expect(abs(found(1)%max_pressure) <= 0 .and. abs(found(1)%min_pressure) <= 0, 'no pressure')
         end do
         call expect(film%counters%cells == 0, 'and no cell')
      end do
   end subroutine no_force_left

   !> w_1 = 0 exactly, and next to 0 on both sides: the film closes or opens as a whole.
   subroutine straight_squeeze()
      class(film_solver_type), allocatable :: film
      class(film_solver_type), allocatable :: exact
      type(film_response) :: found(1), expected(1)
      type(film_motion) :: motion
      real(wp), parameter :: along(5) = [-1e-12_wp, -tiny(1.0_wp), 0.0_wp, tiny(1.0_wp), 1e-12_wp]
      integer :: k, condition
      do condition = none, reynolds
         call make_tables([paper_pad()], condition, film)
         call make_solver([paper_pad()], condition, exact)
         do k = 1, size(along)
            motion = film_motion(clearance*[0.2_wp, 0.3_wp], [along(k), 0.01_wp])
            call film%evaluate([motion], [paper_oil], 0.0_wp, .true., found)
            call exact%evaluate([motion], [paper_oil], 0.0_wp, .true., expected)
            call expect_close(norm2(found(1)%force - expected(1)%force), 0.0_wp, tolerance*norm2(expected(1)%force), &
               & 'it closes')
            motion%velocity(2) = -0.01_wp
            call film%evaluate([motion], [paper_oil], 0.0_wp, .true., found)
            call expect_close(norm2(found(1)%force)/norm2(expected(1)%force), merge(1.0_wp, 0.0_wp, &
               & condition == none), 2*tolerance, 'it opens')
            motion%velocity(2) = 0
            call film%evaluate([motion], [paper_oil], 0.0_wp, .true., found)
            call expect(norm2(found(1)%force) < 1e-6_wp*norm2(expected(1)%force), 'without motion')
         end do
      end do
   end subroutine straight_squeeze

   !> Slopes are those of the force, whole and cavitated, both ways of motion: against differences over 1e-6.
   subroutine slopes(condition)
      integer, intent(in) :: condition
      class(film_solver_type), allocatable :: film
      type(film_response) :: found(1)
      type(film_motion) :: motion
      real(wp) :: unit, expected(2)
      integer :: trial, k
      call make_tables([offset_pad()], condition, film)
      do trial = 1, 5
         motion = film_motion(clearance*[between(-0.4_wp, 0.4_wp), between(-0.2_wp, 0.4_wp)], &
            & clearance*speed*[between(-0.5_wp, 0.5_wp), between(-0.2_wp, 0.2_wp)])
         call film%evaluate([motion], [paper_oil], speed, .true., found)
         do k = 1, 4
            unit = clearance*merge(1.0_wp, speed, k <= 2)
            call difference(film, motion, paper_oil, speed, k, 1e-6_wp*unit, expected)
            ! T bends its slopes within the step
            call expect_close(norm2(expected - found(1)%derivatives(:, k)), 0.0_wp, 1e-5_wp*squeezed(offset_pad(), &
               & motion)/unit, 'slope '//to_text(k))
         end do
      end do
   end subroutine slopes

   !> The same films forth, back, and from a copy of the solver: the same bits.
   subroutine repeats(condition)
      integer, intent(in) :: condition
      integer, parameter :: n = 8
      class(film_solver_type), allocatable :: film, copy
      type(film_motion) :: motions(n)
      type(film_response) :: forth(n), back(1)
      integer :: k
      call make_tables([offset_pad()], condition, film)
      do k = 1, n
         motions(k) = film_motion(clearance*[between(-0.4_wp, 0.4_wp), between(-0.2_wp, 0.4_wp)], &
            & clearance*speed*[between(-0.5_wp, 0.5_wp), between(-0.2_wp, 0.2_wp)])
         call film%evaluate(motions(k:k), [paper_oil], speed, .true., forth(k:k))
         call film%take_pressures(motions(k:k), [paper_oil], speed, forth(k:k))
         if (k == n/2) copy = film
      end do
      do k = n, 1, -1
         call film%evaluate(motions(k:k), [paper_oil], speed, .true., back)
         call film%take_pressures(motions(k:k), [paper_oil], speed, back)
         call expect_same_bits(back(1), forth(k), 'back')
         call expect(.not. abs(back(1)%max_pressure - forth(k)%max_pressure) > 0, 'highest pressure, back')
         call copy%evaluate(motions(k:k), [paper_oil], speed, .true., back)
         call expect_same_bits(back(1), forth(k), 'of a copy')
      end do
   end subroutine repeats

   !> Pressures around a pad that differ: its films are solved, also whole ones, so that the force does not jump.
   subroutine unequal_pressures()
      real(wp), parameter :: around(3, 3) = reshape([3e5_wp, 1e5_wp, 1e5_wp, 1e5_wp, 1e5_wp, 0.0_wp, 1e5_wp, 2e5_wp, &
         & 0.0_wp], [3, 3])
      class(film_solver_type), allocatable :: film
      class(film_solver_type), allocatable :: exact
      type(film_response) :: found(1), expected(1)
      type(film_motion) :: motion
      integer :: k, condition
      do condition = gumbel, reynolds
         do k = 1, size(around, 2)
            call make_tables([paper_pad(around(:, k))], condition, film)
            call make_solver([paper_pad(around(:, k))], condition, exact)
            motion = film_motion(clearance*[0.2_wp, 0.3_wp], clearance*speed*[0.0_wp, 0.01_wp])
            call film%evaluate([motion], [paper_oil], speed, .true., found)
            call exact%evaluate([motion], [paper_oil], speed, .true., expected)
            call expect_same_bits(found(1), expected(1), 'it cavitates, pressures '//to_text(k))
            call expect(film%counters%looked_up == 0 .and. film%counters%cells == 0, 'no table')
            call film%take_pressures([motion], [paper_oil], speed, found)
            call expect(.not. abs(found(1)%max_pressure - expected(1)%max_pressure) > 0, 'pressures stay')
            motion%velocity(2) = 0.5_wp*clearance*speed
            call film%evaluate([motion], [paper_oil], speed, .true., found)
            call exact%evaluate([motion], [paper_oil], speed, .true., expected)
            call expect_same_bits(found(1), expected(1), 'it is whole, pressures '//to_text(k))
            call film%set_cavitation(.false.)
            call film%evaluate([motion], [paper_oil], speed, .true., found)
            call expect(film%counters%looked_up == 1, 'where it may not cavitate it is looked up')
            call expect_close(norm2(found(1)%force - expected(1)%force), 0.0_wp, 2*tolerance*norm2(expected(1)%force), &
               & 'it is whole')
         end do
      end do
   end subroutine unequal_pressures

   !> A film that nearly closes between its edges has no cell: it is solved, and its pressures with it.
   subroutine solved_once()
      class(film_solver_type), allocatable :: film
      type(film_response) :: found(1), again(1)
      call make_tables([paper_pad()], reynolds, film)
      associate (motion => film_motion(clearance*[0.0_wp, 0.999_wp]))
         call film%evaluate([motion], [paper_oil], speed, .true., found)
         again = found
         call film%take_pressures([motion], [paper_oil], speed, again)
      end associate
      call expect(film%counters%volumes == 1 .and. film%counters%nodes == 0, 'it is solved once')
      call expect(again(1)%max_pressure > 0 .and. .not. abs(again(1)%max_pressure - found(1)%max_pressure) > 0, &
         & 'with its pressures')
   end subroutine solved_once

   !> The same pressure all around and inside, of any size, only presses from outside.
   subroutine ambient()
      class(film_solver_type), allocatable :: film, dry
      class(film_solver_type), allocatable :: exact, exact_dry
      type(film_response) :: found(1), without(1), expected(1), expected_without(1)
      type(film_motion) :: motion
      integer :: k
      call make_tables([offset_pad([4e5_wp, 4e5_wp, 4e5_wp])], reynolds, film)
      call make_tables([offset_pad()], reynolds, dry)
      call make_solver([offset_pad([4e5_wp, 4e5_wp, 4e5_wp])], reynolds, exact)
      call make_solver([offset_pad()], reynolds, exact_dry)
      do k = 1, 3
         ! cavitated, whole, empty
         motion = film_motion(clearance*[0.2_wp, 0.3_wp], clearance*speed*[0.0_wp, 0.01_wp])
         if (k > 1) motion%velocity(2) = merge(1, -1, k == 2)*clearance*speed
         call film%evaluate([motion], [paper_oil], speed, .true., found)
         call dry%evaluate([motion], [paper_oil], speed, .true., without)
         call exact%evaluate([motion], [paper_oil], speed, .true., expected)
         call exact_dry%evaluate([motion], [paper_oil], speed, .true., expected_without)
         ! the solver sums that pressure over 80 columns by the middle rule
         call expect_close(norm2(found(1)%force - without(1)%force - (expected(1)%force - expected_without(1)%force)), &
            & 0.0_wp, 1.1_wp*(70*degree/80)**2/24*norm2(expected(1)%force - expected_without(1)%force), &
            & 'force of the pressure around the pad')
         call expect_close(norm2(found(1)%derivatives - without(1)%derivatives), 0.0_wp, &
            & 1e-12_wp*norm2(found(1)%derivatives), 'it has no slopes')
         call film%take_pressures([motion], [paper_oil], speed, found)
         call dry%take_pressures([motion], [paper_oil], speed, without)
         call expect_close(found(1)%max_pressure, without(1)%max_pressure + 4e5_wp, 1e-3_wp, 'highest pressure')
         call expect_close(found(1)%min_pressure, 4e5_wp, 1e-3_wp, 'lowest pressure')
      end do
   end subroutine ambient

   !> Pads of the same shape share what is built, and answer the same.
   subroutine alike()
      class(film_solver_type), allocatable :: film, alone
      type(film_response) :: found(6), expected(1)
      type(film_motion) :: motions(6)
      integer :: k
      call make_tables([(offset_pad(), k=1, 6)], reynolds, film)
      call make_tables([offset_pad()], reynolds, alone)
      do k = 1, 6
         motions(k) = film_motion(clearance*[-0.02_wp*k, 0.3_wp], clearance*speed*[0.0_wp, 0.01_wp])
      end do
      call film%evaluate(motions, spread(paper_oil, 1, size(motions)), speed, .true., found)
      do k = 6, 1, -1
         call alone%evaluate(motions(k:k), [paper_oil], speed, .true., expected)
         call expect_same_bits(found(k), expected(1), 'pad '//to_text(k))
      end do
      call expect(film%counters%cells == alone%counters%cells, 'cells are built once')
      call expect(film%counters%nodes == alone%counters%nodes, 'and nodes')
      call expect(film%counters%looked_up == 6, 'six look-ups')
   end subroutine alike

   !> A journal that touches, beyond and just not: at an edge and between them.
   subroutine closed()
      class(film_solver_type), allocatable :: film
      class(film_solver_type), allocatable :: exact
      type(film_response) :: found(1), expected(1)
      type(film_motion) :: motion
      real(wp) :: error
      integer :: k
      call make_tables([paper_pad()], reynolds, film)
      call make_solver([paper_pad()], reynolds, exact)
      do k = -2, 0
         motion = film_motion([0.0_wp, (1 - 0.1_wp*k)*clearance], [0.0_wp, 0.0_wp])
         call film%evaluate([motion], [paper_oil], speed, .true., found)
         call expect(found(1)%status == film_closed, 'a closed film')
         call expect_close(found(1)%min_film_thickness, 0.1_wp*k*clearance, 1e-18_wp, 'and by how much')
      end do
      call expect(film%counters%looked_up == 0, 'none is looked up')
      do k = 1, 7
         motion = film_motion([0.0_wp, (1 - 0.1_wp**k)*clearance], [0.0_wp, 0.0_wp])
         call film%evaluate([motion], [paper_oil], speed, .true., found)
         call exact%evaluate([motion], [paper_oil], speed, .true., expected)
         call expect(found(1)%status == expected(1)%status, 'as the solver without tables')
         error = norm2(found(1)%force - expected(1)%force)/squeezed(paper_pad(), motion)
         call expect(error < 5e-3_wp, 'nearly closed '//to_text(k)//', error '//to_text(error))
      end do
   end subroutine closed

   !> Cavitation forbidden and allowed again; a solver made without it keeps without it.
   subroutine set_cavitation()
      class(film_solver_type), allocatable :: film, whole
      type(film_response) :: first(1), found(1), expected(1)
      type(film_motion) :: motion
      motion = film_motion(clearance*[0.2_wp, 0.3_wp], clearance*speed*[0.0_wp, 0.01_wp])
      call make_tables([paper_pad()], reynolds, film)
      call make_tables([paper_pad()], none, whole)
      call expect(film%cavitates() .and. .not. whole%cavitates(), 'as they were made')
      call film%evaluate([motion], [paper_oil], speed, .true., first)
      call whole%evaluate([motion], [paper_oil], speed, .true., expected)
      call film%set_cavitation(.false.)
      call film%evaluate([motion], [paper_oil], speed, .true., found)
      call expect(.not. film%cavitates(), 'none cavitates')
      call expect_same_bits(found(1), expected(1), 'cavitation forbidden')
      call film%take_pressures([motion], [paper_oil], speed, found)
      call expect(found(1)%min_pressure < 0, 'and there is tension')
      call film%set_cavitation(.true.)
      call film%evaluate([motion], [paper_oil], speed, .true., found)
      call expect_same_bits(found(1), first(1), 'cavitation allowed again')
      call whole%set_cavitation(.true.)
      call expect(.not. whole%cavitates(), 'made without cavitation')
      call whole%evaluate([motion], [paper_oil], speed, .true., found)
      call expect_same_bits(found(1), expected(1), 'made without cavitation')
   end subroutine set_cavitation

   !> Highest and lowest pressures in the middle plane against fine modes at 400 angles, over the highest of the film
   !> that is squeezed: within what a curve through 12 points along the arc tells, and where the film cavitates also
   !> what lies between linear interpolation over 1/16 of T and a parabola, 1e-3.
   subroutine pressures()
      integer, parameter :: n = 400
      real(wp), parameter :: middle(1, 1) = 0
      class(film_solver_type), allocatable :: film
      type(fourier_film_type) :: fine
      type(pad_gap_type) :: gap
      type(film_response) :: found(1)
      type(film_motion) :: motion
      real(wp) :: worst(2), phi(n, 1), along(1, n, 1), squeezed_film(1, n, 1)
      integer :: trial, k, supply
      do supply = -1, 1
         ! -1: Guembel's condition
         gap = offset_pad([max(0, supply)*1e6_wp, 0.0_wp, 0.0_wp])
         phi(:, 1) = [(-gap%trailing_angle + (k - 0.5_wp)/n*gap%arc(), k=1, n)]
         call make_tables([gap], merge(gumbel, none, supply < 0), film)
         fine = new_fourier_film([gap], 192, 32, .false.)
         worst = 0
         do trial = 1, 20
            motion = film_motion(clearance*[between(-0.4_wp, 0.4_wp), between(-0.2_wp, 0.4_wp)], &
               & clearance*speed*[between(-0.5_wp, 0.5_wp), between(-0.2_wp, 0.2_wp)])
            call film%evaluate([motion], [paper_oil], speed, .false., found)
            call film%take_pressures([motion], [paper_oil], speed, found)
            call fine%field([motion], [paper_oil], speed, phi, middle, along)
            call fine%field([film_motion(motion%position, clearance*speed*[0.0_wp, 0.25_wp])], [paper_oil], 0.0_wp, &
               & phi, middle, squeezed_film)
            if (supply < 0) along = max(0.0_wp, along)
            associate (highest => max(gap%supply_pressure, maxval(along)), lowest => min(0.0_wp, minval(along)), &
               & scale => maxval(squeezed_film))
               worst = max(worst, abs([found(1)%max_pressure - highest, found(1)%min_pressure - lowest])/scale)
            end associate
         end do
         call expect(worst(1) < merge(4e-3_wp, 3e-3_wp, supply < 0), 'highest, error '//to_text(worst(1)))
         call expect(worst(2) < 3e-3_wp, 'lowest, error '//to_text(worst(2)))
      end do
   end subroutine pressures

   !> Pressures above that around the pad push the journal away from the pad, however little of the film is left. With
   !> Guembel's condition, whose force ends with a bend within a cell: up to 2 % of the floor of its table, 1e-2.
   subroutine pushes(condition)
      integer, intent(in) :: condition
      class(film_solver_type), allocatable :: film
      type(pad_gap_type) :: gap
      type(film_motion) :: motion
      type(film_response) :: found
      real(wp) :: allowed
      integer :: trial, pushing
      gap = offset_pad()
      call make_tables([gap], condition, film)
      pushing = 0
      do trial = 1, 400
         motion%position = clearance*[between(-1.2_wp, 1.2_wp), between(-1.0_wp, 0.95_wp)]
         if (gap%min_film_thickness(motion, gap%directions()) < 1e-2_wp*clearance) cycle
         motion%velocity = clearance*speed*[between(-1.0_wp, 1.0_wp), between(-1.0_wp, 1.0_wp)]
         call film%evaluate_pad(1, motion, paper_oil, speed, .false., found)
         call expect(found%status == film_ok, 'a film')
         allowed = merge(0.0_wp, 2e-4_wp, condition == reynolds)
         if (allowed > 0) allowed = allowed*squeezed(gap, motion)
         call expect(found%force(2) <= allowed, 'radial force '//to_text(found%force(2))//' N')
         if (found%force(2) < 0) pushing = pushing + 1
      end do
      call expect(pushing > 100, to_text(pushing)//' films have a force')
   end subroutine pushes
end program test_table_film
