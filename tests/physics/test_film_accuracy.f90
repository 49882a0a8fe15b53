!> Force, slopes and highest pressure of every solver at its default resolution, on random films (random_films) in three
!> ranges of the film thickness ratio. Prints the largest errors, which are those of docs/verification.md. With a number
!> as an argument the program takes that many times as many films.
!>
!> Errors of the force are over that of the film in the same position that is just whole; of slopes over the position
!> likewise, times the thinnest film. Errors of the highest pressure are over that of the film that is just whole; where
!> half of the film or more converges, over itself, or over a tenth of the other where this is higher.
program test_film_accuracy
   use kinds, only: wp
   use text, only: to_text
   use film_solver, only: film_solver_type, film_motion, film_response, film_ok, cavitation_reynolds, &
      & cavitation_none, cavitation_gumbel
   use film_resolution, only: enough_cells, enough_modes, usual_error
   use fourier_film, only: fourier_film_type, new_fourier_film, converged_film
   use sor_film, only: sor_film_type, sor_options, new_sor_film
   use direct_film, only: direct_film_type, new_direct_film
   use table_film, only: new_table_film
   use random_films, only: film_state, random_film, volumes_type, new_volumes, extrapolated, field_points, &
      & shown, shaft_speed
   use paper_bearing, only: paper_oil
   use check, only: runs, expect, report
   implicit none (type, external)

   !> Ranges of the film thickness ratio.
   real(wp), parameter :: ranges(4) = [1.0_wp, 5.0_wp, 20.0_wp, 50.0_wp]
   character(len=*), parameter :: range_names(3) = [character(len=8) :: '1 to 5', '5 to 20', '20 to 50']
   !> Cells and modes of the reference, far beyond what any film asks for.
   integer, parameter :: fine_cells = 640, fine_modes = 256
   !> Tolerances of tables with the default settings: with the condition of Reynolds the second.
   real(wp), parameter :: table_tolerances(2) = [1e-5_wp, 4e-5_wp]

   !> Largest errors of some films, and which film's force has the largest.
   type :: error_type
      real(wp) :: force = 0, slopes = 0, pressure = 0
      integer :: films = 0
      type(film_state) :: worst
   end type error_type

   integer :: times

   times = argument()
   if (runs('reference_is_right')) call reference_is_right()
   if (runs('whole')) then
      call by_modes(.false., .false.)
      call by_modes(.false., .true.)
   end if
   if (runs('gumbel')) then
      call by_modes(.true., .false.)
      call by_modes(.true., .true.)
   end if
   if (runs('reynolds')) then
      call reynolds(.false.)
      call reynolds(.true.)
   end if
   if (runs('fields')) call fields()
   call report()

contains

   integer function argument()
      character(len=20) :: text
      call get_command_argument(1, text)
      argument = 1
      if (text /= '') read (text, *) argument
   end function argument

   !> Adds the errors of an answer.
   subroutine compare(state, found, expected, errors)
      type(film_state), intent(in) :: state
      type(film_response), intent(in) :: found
      type(volumes_type), intent(in) :: expected
      type(error_type), intent(inout) :: errors
      real(wp) :: error
      call expect(found%status == film_ok, 'the film is open')
      error = norm2(found%force - expected%force)/state%force
      if (error >= errors%force) errors%worst = state
      errors%films = errors%films + 1
      errors%force = max(errors%force, error)
      errors%slopes = max(errors%slopes, state%thinnest/state%force &
         & *norm2(found%derivatives(:, :2) - expected%derivatives(:, :2)))
      errors%pressure = max(errors%pressure, abs(found%max_pressure - expected%max_pressure) &
         & /merge(max(expected%max_pressure, 0.1_wp*state%pressure), state%pressure, state%t <= 0.5_wp))
   end subroutine compare

   !> Prints the errors of a range, and holds them against limits of force, slopes and highest pressure.
   subroutine expect_within(name, range, errors, limits)
      character(len=*), intent(in) :: name
      integer, intent(in) :: range
      type(error_type), intent(in) :: errors
      real(wp), intent(in) :: limits(3)
      character(len=:), allocatable :: what
      print '(4a, i4, a, 3es9.1)', name, ', film thickness ratio ', range_names(range), ':', errors%films, &
         & ' films; force, slopes, highest pressure', errors%force, errors%slopes, errors%pressure
      what = name//', film thickness ratio '//trim(range_names(range))//', '
      call expect(errors%force < limits(1), what//'force '//to_text(errors%force)//': '//shown(errors%worst))
      call expect(errors%slopes < limits(2), what//'slopes '//to_text(errors%slopes))
      call expect(errors%pressure < limits(3), what//'highest pressure '//to_text(errors%pressure))
   end subroutine expect_within

   !> The film by many modes, or by a part of them and of the cells; whole or clipped.
   function fine_film(state, part, clips) result(film)
      type(film_state), intent(in) :: state
      integer, intent(in) :: part
      logical, intent(in) :: clips
      type(fourier_film_type) :: film
      film = new_fourier_film([state%gap], fine_cells/part, fine_modes/part, clips)
   end function fine_film

   type(volumes_type) function fine_answer(state)
      type(film_state), intent(in) :: state
      type(fourier_film_type) :: film
      type(film_response) :: r(1)
      film = fine_film(state, 1, .false.)
      call film%evaluate([state%motion], [paper_oil], shaft_speed, .true., r)
      fine_answer = volumes_type(r(1)%force, r(1)%derivatives, r(1)%max_pressure)
   end function fine_answer

   !> Fine modes against finite volumes, which share neither scheme nor expansion with them, extrapolated from three
   !> grids. Finite volumes are of second order, so the extrapolation is of the fourth: of its change from the first
   !> two grids to the last two a fifteenth is left; an eighth is allowed. Where the supply pressure jumps to the sides'
   !> at the corners, h**2 log(h) remains, and of the change a third is left; a half is allowed. To that comes what is
   !> left of the modes. Both together are a tenth at most of the error that the modes are to measure.
   subroutine reference_is_right()
      type(film_state) :: state
      type(volumes_type) :: grids(0:2), first, last, modes
      real(wp) :: change, error, left
      integer :: range, i, k
      logical :: supplied
      do range = 1, 3
         do i = 1, 8*times
            supplied = mod(i, 2) == 0
            state = random_film(ranges(range), ranges(range + 1), .false., supplied)
            do k = 0, 2
               grids(k) = new_volumes(state, 20*2**k, .false.)
            end do
            first = extrapolated(grids(0), grids(1))
            last = extrapolated(grids(1), grids(2))
            modes = fine_answer(state)
            change = norm2(last%force - first%force)/state%force
            left = change*merge(0.5_wp, 0.125_wp, supplied) + merge(5e-6_wp, 3e-7_wp, supplied)
            error = norm2(last%force - modes%force)/state%force
            call expect(error < min(left, 0.1_wp*usual_error), 'force '//to_text(error)//', left '//to_text(left) &
               & //': '//shown(state))
            change = norm2(last%derivatives(:, :2) - first%derivatives(:, :2))*state%thinnest/state%force
            error = norm2(last%derivatives(:, :2) - modes%derivatives(:, :2))*state%thinnest/state%force
            call expect(error < max(usual_error, change), 'slopes '//to_text(error)//': '//shown(state))
         end do
      end do
   end subroutine reference_is_right

   !> Adds the errors of a solver.
   subroutine try(film, state, expected, errors)
      class(film_solver_type), intent(inout) :: film
      type(film_state), intent(in) :: state
      type(volumes_type), intent(in) :: expected
      type(error_type), intent(inout) :: errors
      type(film_response) :: found(1)
      call film%evaluate([state%motion], [paper_oil], shaft_speed, .true., found)
      call film%take_pressures([state%motion], [paper_oil], shaft_speed, found)
      call compare(state, found(1), expected, errors)
   end subroutine try

   !> `fourier`, which is `direct` where films are full, and tables, against fine modes, whole or clipped (Guembel).
   subroutine by_modes(clips, supplied)
      logical, intent(in) :: clips, supplied
      type(film_state) :: state
      type(fourier_film_type) :: film
      class(film_solver_type), allocatable :: tables
      type(volumes_type) :: expected
      type(error_type) :: modes, looked_up
      character(len=:), allocatable :: name
      real(wp) :: limits(3, 2)
      integer :: range, i
      !> Eight points across are few where a film under supply pressure cavitates beside the side.
      real(wp), parameter :: supply_limits(3) = [1e-4_wp, 3e-4_wp, 1e-3_wp]
      name = trim(merge(', gumbel', ', none  ', clips))
      if (supplied) name = name//', supply pressure'
      do range = 1, 3
         modes = error_type()
         looked_up = error_type()
         do i = 1, merge(12, 50, clips)*times
            state = random_film(ranges(range), ranges(range + 1), clips .and. .not. supplied, supplied)
            if (clips) expected = clipped(state)
            if (.not. clips) expected = fine_answer(state)
            film = converged_film(state%gap, clips, usual_error)
            call try(film, state, expected, modes)
            if (i > merge(12, 10, clips)*times) cycle
            tables = new_tables(state, merge(cavitation_gumbel, cavitation_none, clips), table_tolerances(1))
            call try(tables, state, expected, looked_up)
         end do
         ! tables keep a profile of few points
         limits = reshape([usual_error, 1e-3_wp, merge(1e-3_wp, 3e-3_wp, supplied), usual_error, 1e-3_wp, 2e-2_wp], &
            & [3, 2])
         if (clips) limits(:2, :) = spread([merge(supply_limits(range), usual_error, supplied), 2e-2_wp], 2, 2)
         call expect_within('fourier'//name, range, modes, limits(:, 1))
         call expect_within('auto'//name, range, looked_up, limits(:, 2))
      end do
   end subroutine by_modes

   !> Tables for a film, whose other films are solved at the default resolution.
   function new_tables(state, condition, tolerance) result(tables)
      type(film_state), intent(in) :: state
      integer, intent(in) :: condition
      real(wp), intent(in) :: tolerance
      class(film_solver_type), allocatable :: tables
      tables = new_table_film(new_direct(state, 1, condition), .true., tolerance)
   end function new_tables

   !> `direct` with this many times its default volumes.
   function new_direct(state, finer, condition) result(film)
      type(film_state), intent(in) :: state
      integer, intent(in) :: finer, condition
      type(direct_film_type) :: film
      associate (gaps => [state%gap])
         film = new_direct_film(gaps, enough_cells(gaps), enough_modes(gaps), 80*finer, 8*finer, condition, usual_error)
      end associate
   end function new_direct

   !> The film of fine modes, clipped: the integral of its pressure over points that crowd at all edges, extrapolated
   !> from two numbers of points, as the middle rule is of second order.
   type(volumes_type) function clipped(state)
      type(film_state), intent(in) :: state
      type(fourier_film_type) :: film
      type(volumes_type) :: whole
      whole = fine_answer(state)
      film = fine_film(state, 2, .true.)
      clipped = extrapolated(integral(film, state, 120), integral(film, state, 240))
      clipped%max_pressure = max(0.0_wp, whole%max_pressure)
   end function clipped

   !> From this many points along the arc, a fifth as many across; slopes over the position from what the field changes.
   type(volumes_type) function integral(film, state, n)
      type(fourier_film_type), intent(inout) :: film
      type(film_state), intent(in) :: state
      integer, intent(in) :: n
      type(film_motion) :: beside
      real(wp) :: force(2), step
      integer :: k, side
      step = 1e-4_wp*state%thinnest
      integral%force = field_force(film, state, state%motion, n)
      do k = 1, 2
         do side = -1, 1, 2
            beside = state%motion
            beside%position(k) = beside%position(k) + side*step
            force = field_force(film, state, beside, n)
            integral%derivatives(:, k) = integral%derivatives(:, k) + side*force/(2*step)
         end do
      end do
   end function integral

   !> The rebuilt pressure fields: their integral is the force that the solver has answered.
   subroutine fields()
      character(len=*), parameter :: names(6) = [character(len=24) :: 'fourier, none', 'fourier, gumbel', &
         & 'direct 80 x 8, reynolds', 'sor 60 x 15, reynolds', 'auto, gumbel', 'auto, reynolds']
      type(film_state) :: state
      type(fourier_film_type) :: modes
      type(direct_film_type) :: direct
      type(sor_film_type) :: sor
      class(film_solver_type), allocatable :: tables
      real(wp) :: missing(size(names))
      integer :: range, i, k
      !> What sine and cosine leave over a cell, and the points; of `auto` with the condition of Reynolds, what the
      !> volumes of its fields err by.
      real(wp), parameter :: limits(size(names)) = [1e-4_wp, 2e-4_wp, 3e-3_wp, 1e-4_wp, 1e-4_wp, 3e-3_wp]
      missing = 0
      do range = 1, 3
         do i = 1, 20*times
            state = random_film(ranges(range), ranges(range + 1), .true., .false.)
            modes = converged_film(state%gap, .false., usual_error)
            call add_missing(modes, state, missing(1))
            modes = converged_film(state%gap, .true., usual_error)
            call add_missing(modes, state, missing(2))
            direct = new_direct(state, 1, cavitation_reynolds)
            call add_missing(direct, state, missing(3))
            sor = new_sor_film([state%gap], sor_options(60, 15, tolerance=1e-7_wp, max_sweeps=100000, &
               & cavitation=cavitation_reynolds))
            call add_missing(sor, state, missing(4))
            tables = new_tables(state, cavitation_gumbel, table_tolerances(1))
            call add_missing(tables, state, missing(5))
            tables = new_tables(state, cavitation_reynolds, table_tolerances(2))
            call add_missing(tables, state, missing(6))
         end do
      end do
      do k = 1, size(names)
         print '(3a, es9.1)', 'field of ', names(k), ': integral less force ', missing(k)
         call expect(missing(k) < limits(k), trim(names(k))//', integral less force '//to_text(missing(k)))
      end do
   end subroutine fields

   !> Keeps the largest difference of the integral of a film's field and its force.
   subroutine add_missing(film, state, missing)
      class(film_solver_type), intent(inout) :: film
      type(film_state), intent(in) :: state
      real(wp), intent(inout) :: missing
      type(film_response) :: r(1)
      real(wp) :: force(2)
      call film%evaluate([state%motion], [paper_oil], shaft_speed, .false., r)
      ! the middle rule is of second order
      force = (4*field_force(film, state, state%motion, 360) - field_force(film, state, state%motion, 180))/3
      missing = max(missing, norm2(force - r(1)%force)/state%force)
   end subroutine add_missing

   !> The force of the field; its points stay where the film of the state is thin.
   function field_force(film, state, motion, n) result(force)
      class(film_solver_type), intent(inout) :: film
      type(film_state), intent(in) :: state
      type(film_motion), intent(in) :: motion
      integer, intent(in) :: n
      real(wp) :: force(2)
      real(wp) :: phi(n, 1), arc(n), z(n/5), width(n/5), p(n/5, n, 1), rows(n)
      call field_points(state, phi(:, 1), arc, z, width)
      call film%field([motion], [paper_oil], shaft_speed, phi, spread(z, 2, 1), p)
      rows = matmul(width, p(:, :, 1))*arc
      force = -state%gap%pad_radius()*[dot_product(rows, sin(phi(:, 1))), dot_product(rows, cos(phi(:, 1)))]
   end function field_force

   !> `direct`, with its default volumes and twice as many each way, `sor` likewise, and tables, with the condition of
   !> Reynolds, against volumes that are narrow where the film is thin, extrapolated. By how much these have not
   !> converged, follows from a coarser pair of grids.
   subroutine reynolds(supplied)
      logical, intent(in) :: supplied
      type(film_state) :: state
      type(direct_film_type) :: direct
      type(sor_film_type) :: sor
      class(film_solver_type), allocatable :: tables
      type(volumes_type) :: grids(0:2), expected
      type(error_type) :: of_direct(2), of_sor(2), looked_up
      real(wp) :: change
      character(len=:), allocatable :: name
      integer :: range, i, k
      !> Limits of force and highest pressure of `direct` and `sor` at their default volumes, which do not follow the
      !> film: the former without and with supply pressure.
      real(wp), parameter :: direct_limits(3, 0:1) = reshape([1e-3_wp, 3e-3_wp, 5e-3_wp, 4e-3_wp, 8e-3_wp, 4e-2_wp], &
         & [3, 2]), sor_limits(3) = [1e-2_wp, 5e-2_wp, 0.2_wp]
      name = ', reynolds'
      if (supplied) name = ', reynolds, supply pressure'
      do range = 1, 3
         of_direct = error_type()
         of_sor = error_type()
         looked_up = error_type()
         do i = 1, 10*times
            state = random_film(ranges(range), ranges(range + 1), .true., supplied)
            do k = 0, 2
               grids(k) = new_volumes(state, 10*2**k, .true.)
            end do
            expected = extrapolated(grids(1), grids(2))
            change = norm2(expected%force - (4*grids(1)%force - grids(0)%force)/3)/state%force
            call expect(change < merge(3e-4_wp, 1e-4_wp, supplied), 'the extrapolation has converged: ' &
               & //to_text(change)//', '//shown(state))
            ! cells that cavitate one by one make the slopes rough
            expected%derivatives = grids(2)%derivatives
            do k = 1, 2
               direct = new_direct(state, k, cavitation_reynolds)
               call try(direct, state, expected, of_direct(k))
               sor = new_sor_film([state%gap], sor_options(60*k, 15*k, tolerance=1e-7_wp, max_sweeps=100000, &
                  & cavitation=cavitation_reynolds))
               call try(sor, state, expected, of_sor(k))
            end do
            if (supplied) cycle
            tables = new_tables(state, cavitation_reynolds, table_tolerances(2))
            call try(tables, state, expected, looked_up)
         end do
         ! cells become smaller with the fourth root of the tolerance, and the highest pressure is linear in them
         if (.not. supplied) call expect_within('auto'//name, range, looked_up, &
            & [5*table_tolerances(2), 1e-2_wp, 3*sqrt(table_tolerances(2))])
         do k = 1, 2
            ! of second order; what is found between the volumes errs hardly more than the force
            associate (in_force => direct_limits(range, merge(1, 0, supplied)))
               call expect_within('direct '//to_text(80*k)//' x '//to_text(8*k)//name, range, of_direct(k), &
                  & [in_force, 0.1_wp, 1.2_wp*in_force]*0.4_wp**(k - 1))
            end associate
            call expect_within('sor '//to_text(60*k)//' x '//to_text(15*k)//name, range, of_sor(k), &
               & [1.0_wp, 4.0_wp, 1.0_wp]*sor_limits(range)*0.4_wp**(k - 1))
         end do
      end do
   end subroutine reynolds
end program test_film_accuracy
