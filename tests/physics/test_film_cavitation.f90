!> Films that cavitate: slopes where Guembel's condition takes part of the film, and the onset of cavitation under the
!> solver that chooses.
program test_film_cavitation
   use kinds, only: wp, i8, pi
   use text, only: to_text
   use film_solver, only: film_solver_type, film_motion, film_response, film_counters, film_ok, cavitation_none, &
      & cavitation_reynolds
   use pad_gap, only: pad_gap_type
   use fourier_film, only: fourier_film_type, new_fourier_film
   use sor_film, only: sor_film_type, sor_options, new_sor_film
   use elimination_film, only: elimination_film_type, new_elimination_film
   use direct_film, only: direct_film_type, new_direct_film
   use film_differences, only: difference
   use paper_bearing, only: paper_oil, offset_pad, speed, clearance
   use check, only: runs, expect, expect_close, report
   implicit none (type, external)

   integer, parameter :: cells = 24, modes = 8
   !> Error of the modes' force where the film is full.
   real(wp), parameter :: fourier_error = 1e-4_wp
   !> Ambient pressure, and with it that at the leading edge, where a film is not at the pressure of cavitation.
   real(wp), parameter :: ambient = 1e5_wp, supply = 3e5_wp

   !> A journal that presses into the pad and leaves it again, as a function of an angle.
   type :: journal_path
      real(wp) :: position(2), position_sine(2), position_cosine(2), velocity_cosine(2)
      logical :: flooded = .false.
   end type journal_path

   real(wp), parameter :: um = 1e-6_wp, still(2) = 0
   !> Opening by squeeze, moderate and in a flooded pad strong; opening by its wedge, without squeeze.
   type(journal_path), parameter :: paths(3) = [ &
      & journal_path([-20*um, 30*um], [0.0_wp, 30*um], still, [0.0_wp, -6e-3_wp]), &
      & journal_path([-20*um, 30*um], [0.0_wp, 30*um], still, [0.0_wp, -15e-3_wp], .true.), &
      & journal_path([-5*um, 30*um], [0.0_wp, 30*um], [20*um, 0.0_wp], still)]
   integer :: i

   if (runs('fourier_slopes')) call fourier_slopes()
   do i = 1, size(paths)
      if (runs('onset')) then
         call onset(paths(i), 60, 15)
         call onset(paths(i), 120, 30)
      end if
      if (runs('no_chatter')) call no_chatter(paths(i))
   end do
   call report()

contains

   !> The paper's pad with its pivot off the middle; dry: every pressure is that of cavitation.
   pure type(pad_gap_type) function pad(flooded)
      logical, intent(in) :: flooded
      pad = offset_pad()
      if (.not. flooded) return
      pad%supply_pressure = supply
      pad%ambient_pressure = ambient
   end function pad

   !> One pad's answer.
   type(film_response) function answer(solver, motion)
      class(film_solver_type), intent(inout) :: solver
      type(film_motion), intent(in) :: motion
      type(film_response) :: r(1)
      call solver%evaluate([motion], [paper_oil], speed, .true., r)
      call expect(r(1)%status == film_ok, 'the film has a solution')
      answer = r(1)
   end function answer

   !> A film that opens over part of the pad, with squeeze of either sign.
   type(film_motion) function opening_motion()
      real(wp) :: u(4)
      call random_number(u)
      opening_motion%position = clearance*[-0.2_wp + 0.5_wp*u(1), 0.1_wp + 0.5_wp*u(2)]
      opening_motion%velocity = clearance*speed*[-0.1_wp + 0.2_wp*u(3), -0.15_wp + 0.2_wp*u(4)]
   end function opening_motion

   !> Guembel's condition by modes: the slopes of what is left of the film. They take the weights of the clipped
   !> quadrature for the slopes of its integral, which they are but for the fourth order of a cell over the
   !> length of the film: a third of a thousandth in the mean, and a few thousandths where a few cells are left.
   !> Where next to nothing is left of a film, the error is over a hundredth of the full film's slope.
   subroutine fourier_slopes()
      type(fourier_film_type) :: solver, whole
      type(film_motion) :: motion
      type(film_response) :: r, r_whole
      real(wp) :: expected(2), unit, doubt, error, worst, mean
      integer :: trial, column, compared
      worst = 0
      mean = 0
      compared = 0
      do trial = 1, 120
         solver = new_fourier_film([pad(mod(trial, 2) == 0)], cells, modes, gumbel=.true.)
         whole = new_fourier_film([pad(mod(trial, 2) == 0)], cells, modes, gumbel=.false.)
         motion = opening_motion()
         r = answer(solver, motion)
         r_whole = answer(whole, motion)
         if (r_whole%min_pressure >= 0) cycle
         do column = 1, 4
            unit = merge(clearance, clearance*speed, column <= 2)
            call difference(solver, motion, paper_oil, speed, column, 1e-5_wp*unit, expected, doubt)
            ! where both differences agree nothing left or joined the film between
            if (doubt > 2e-7_wp) cycle
            compared = compared + 1
            error = norm2(r%derivatives(:, column) - expected) &
               & /max(norm2(expected), 1e-2_wp*norm2(r_whole%derivatives(:, column)))
            worst = max(worst, error)
            mean = mean + error
         end do
      end do
      call expect(compared >= 100, 'slopes of cavitated films compared, Guembel: '//to_text(compared))
      call expect_close(worst, 0.0_wp, 5e-3_wp, 'slopes of cavitated films, Guembel by modes')
      call expect_close(mean/compared, 0.0_wp, 4e-4_wp, 'slopes of cavitated films, Guembel by modes, in the mean')
   end subroutine fourier_slopes

   pure type(film_motion) function place(path, angle)
      type(journal_path), intent(in) :: path
      real(wp), intent(in) :: angle
      place%position = path%position + path%position_sine*sin(angle) + path%position_cosine*cos(angle)
      place%velocity = path%velocity_cosine*cos(angle)
   end function place

   !> Where the film of auto starts or ceases to cavitate along a path its force must not jump. On one side stand
   !> the modes, on the other the modes and what cavitation changes in the cells, which begins with nothing; so
   !> nothing but the error of the cells may lie between them. That is measured: the largest difference of
   !> cells and modes, both without cavitation, along the path. The same for the slope along the path, twice, as
   !> a few points miss its largest error, where cavitation begins at an edge, as it does in a dry pad; but the slope
   !> begins with that of the slight tension left out, which cells half the size tell. (A flooded
   !> film may break inside the pad first. A single point held there bends the film for a logarithm's distance
   !> around it: the slope changes by a tenth and more with the first cell, however small.)
   subroutine onset(path, columns, rows)
      type(journal_path), intent(in) :: path
      integer, intent(in) :: columns, rows
      integer, parameter :: n = 100
      real(wp), parameter :: d = 2*pi/n
      type(direct_film_type) :: solver
      type(film_response) :: before, after
      real(wp) :: left, right, middle, allowed(2)
      character(len=:), allocatable :: what
      integer :: i, k, switches
      logical :: was, is
      allowed = error_of_cells(path, columns, rows)
      solver = new_direct_film([pad(path%flooded)], cells, modes, columns, rows, cavitation_reynolds)
      switches = 0
      call look(solver, path, 0.0_wp, before, was)
      do i = 1, n
         call look(solver, path, i*d, after, is)
         if (is .eqv. was) cycle
         switches = switches + 1
         left = (i - 1)*d
         right = i*d
         do k = 1, 30
            middle = 0.5_wp*(left + right)
            call look(solver, path, middle, after, is)
            if (is .eqv. was) left = middle
            if (is .neqv. was) right = middle
         end do
         call look(solver, path, left, before, is)
         call look(solver, path, right, after, is)
         what = ' at the onset, '//to_text(columns)//' columns, angle '//to_text(left)//', force ' &
            & //to_text(norm2(after%force))
         call expect_close(norm2(after%force - before%force), 0.0_wp, allowed(1), 'jump of the force'//what)
         if (.not. path%flooded) call expect_close(norm2(matmul(after%derivatives - before%derivatives, &
            & direction(path, left)) - merge(-1, 1, was)*left_out(path, merge(left, right, was), 2*columns, 2*rows)), &
            & 0.0_wp, 2*allowed(2), 'jump of the slope'//what)
         was = .not. was
      end do
      call expect(switches == 2, 'one onset, one end of cavitation: '//to_text(switches))
   end subroutine onset

   !> What cavitation adds to the slope of the force at an angle of the path, on cells.
   function left_out(path, angle, columns, rows)
      type(journal_path), intent(in) :: path
      real(wp), intent(in) :: angle
      integer, intent(in) :: columns, rows
      real(wp) :: left_out(2)
      type(elimination_film_type) :: by_cells
      type(film_counters) :: counters
      type(film_response) :: cavitated, whole
      by_cells = new_elimination_film(pad(path%flooded), columns, rows)
      call by_cells%evaluate(place(path, angle), paper_oil, speed, .true., .true., counters, cavitated)
      call by_cells%evaluate(place(path, angle), paper_oil, speed, .false., .true., counters, whole)
      left_out = matmul(cavitated%derivatives - whole%derivatives, direction(path, angle))
   end function left_out

   !> Largest difference of cells and modes, both without cavitation, along a path: of the force, of its slope.
   function error_of_cells(path, columns, rows) result(largest)
      type(journal_path), intent(in) :: path
      integer, intent(in) :: columns, rows
      real(wp) :: largest(2)
      integer, parameter :: n = 48
      type(fourier_film_type) :: by_modes
      type(sor_film_type) :: by_cells
      type(film_response) :: r_modes, r_cells
      real(wp) :: angle
      integer :: i
      by_modes = new_fourier_film([pad(path%flooded)], cells, modes, gumbel=.false.)
      by_cells = new_sor_film([pad(path%flooded)], sor_options(columns, rows, tolerance=1e-7_wp, &
         & cavitation=cavitation_none))
      largest = 0
      do i = 1, n
         angle = 2*pi*i/n
         r_modes = answer(by_modes, place(path, angle))
         r_cells = answer(by_cells, place(path, angle))
         largest = max(largest, [norm2(r_cells%force - r_modes%force), &
            & norm2(matmul(r_cells%derivatives - r_modes%derivatives, direction(path, angle)))])
      end do
   end function error_of_cells

   !> The film at an angle of the path, and whether it counts as cavitated.
   subroutine look(solver, path, angle, r, cavitated)
      type(direct_film_type), intent(inout) :: solver
      type(journal_path), intent(in) :: path
      real(wp), intent(in) :: angle
      type(film_response), intent(out) :: r
      logical, intent(out) :: cavitated
      integer(i8) :: fourier
      fourier = solver%counters%fourier
      r = answer(solver, place(path, angle))
      cavitated = solver%counters%fourier == fourier
   end subroutine look

   !> Change of motion along a path.
   pure function direction(path, angle)
      type(journal_path), intent(in) :: path
      real(wp), intent(in) :: angle
      real(wp) :: direction(4)
      direction(1:2) = path%position_sine*cos(angle) - path%position_cosine*sin(angle)
      direction(3:4) = -path%velocity_cosine*sin(angle)
   end function direction

   !> The second difference of the force of auto along a path: where the force is smooth or has a switching point, with
   !> steps ten times shorter ten times less at least, down to the modes' error; a jump would stay. The forces
   !> are the same on the way back, to rounding, whatever was solved before.
   subroutine no_chatter(path)
      type(journal_path), intent(in) :: path
      integer, parameter :: coarse_steps = 100, many = 1000
      type(direct_film_type) :: solver
      real(wp) :: coarse(2, 0:coarse_steps), fine(2, 0:many), back(2, 0:coarse_steps), rough_coarse, rough_fine, largest
      solver = new_direct_film([pad(path%flooded)], cells, modes, 60, 15, cavitation_reynolds)
      call walk(solver, path, 2*pi/coarse_steps, coarse, rough_coarse)
      call walk(solver, path, -2*pi/coarse_steps, back, rough_coarse)
      call walk(solver, path, 2*pi/many, fine, rough_fine)
      largest = maxval(norm2(fine, dim=1))
      call expect(rough_fine <= 0.1_wp*rough_coarse + fourier_error*largest, 'steps of the force ' &
         & //to_text(rough_coarse/largest)//', ten times finer '//to_text(rough_fine/largest))
      call expect_close(maxval(norm2(coarse - back(:, coarse_steps:0:-1), dim=1)), 0.0_wp, 1e-9_wp*largest, &
         & 'there and back again')
   end subroutine no_chatter

   !> Forces along a path, step by step, and their largest second difference.
   subroutine walk(solver, path, step, forces, roughest)
      type(direct_film_type), intent(inout) :: solver
      type(journal_path), intent(in) :: path
      real(wp), intent(in) :: step
      real(wp), intent(out) :: forces(:, 0:), roughest
      type(film_response) :: r
      integer :: k
      do k = 0, ubound(forces, 2)
         r = answer(solver, place(path, k*step))
         forces(:, k) = r%force
      end do
      associate (n => ubound(forces, 2))
         roughest = maxval(norm2(forces(:, 2:n) - 2*forces(:, 1:n - 1) + forces(:, 0:n - 2), dim=1))
      end associate
   end subroutine walk
end program test_film_cavitation
