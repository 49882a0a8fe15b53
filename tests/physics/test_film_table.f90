!> Films from tables against every other solver, over what a bearing can ask for: pads of 20 to 120 degrees, length to
!> diameter 0.25 to 2, films from 0.04 to 2 clearances thick at either edge, every direction of motion; with the
!> conditions of Reynolds and Guembel and without cavitation; at three tolerances.
!>
!> Errors are measured over the force of the same film at the onset of cavitation, T = 0, as fast along the arc.
program test_film_table
   use kinds, only: wp, degree
   use text, only: to_text
   use film_solver, only: film_motion, film_response, film_counters, film_ok
   use pad_gap, only: pad_gap_type
   use film_resolution, only: enough_cells, enough_modes
   use fourier_film, only: fourier_film_type, new_fourier_film
   use elimination_film, only: elimination_film_type, new_elimination_film
   use sor_film, only: sor_film_type, sor_options, new_sor_film, cavitation_none, cavitation_reynolds
   use direct_film, only: new_direct_film
   use table_film, only: table_film_type, new_table_film
   use paper_bearing, only: paper_oil
   use check, only: runs, expect, between, report
   implicit none (type, external)

   integer, parameter :: none = 0, gumbel = 1, reynolds = 2
   character(len=*), parameter :: names(0:2) = [character(len=8) :: 'none', 'gumbel', 'reynolds']
   real(wp), parameter :: tolerances(3) = [1e-3_wp, 1e-4_wp, 1e-5_wp]
   real(wp), parameter :: clearance = 100e-6_wp, least = 0.04_wp, most = 2

   !> A film: its pad, its motion at rest of the shaft, and the force and force times thickness over length that its
   !> errors are measured over.
   type :: film_state
      type(pad_gap_type) :: gap
      type(film_motion) :: motion
      real(wp) :: t, force, thinnest
   end type film_state

   if (runs('against_modes')) then
      call against_modes(none, 30)
      call against_modes(gumbel, 30)
   end if
   if (runs('against_volumes')) call against_volumes(16)
   if (runs('against_relaxation')) then
      call against_relaxation(none, 2)
      call against_relaxation(reynolds, 2)
   end if
   call report()

contains

   !> A film that is open and no more uneven than 50; T from below 0 to 1.
   type(film_state) function random_state() result(state)
      real(wp) :: h(2), half, arc
      type(fourier_film_type) :: film
      type(film_response) :: r(1)
      do
         arc = between(20.0_wp, 120.0_wp)*degree
         half = 0.5_wp*arc
         state%gap = pad_gap_type(49.9e-3_wp, clearance, 0.1_wp*0.25_wp*8**between(0.0_wp, 1.0_wp), half, half, &
            & 0.0_wp, 0.0_wp, 0.0_wp)
         h = least*(most/least)**[between(0.0_wp, 1.0_wp), between(0.0_wp, 1.0_wp)]
         state%motion%position = clearance*[(h(2) - h(1))/(2*sin(half)), (1 - 0.5_wp*sum(h))/cos(half)]
         state%thinnest = state%gap%min_film_thickness(state%motion, state%gap%directions())
         if (state%thinnest > least*clearance) exit
      end do
      state%t = between(-0.3_wp, 1.0_wp)
      film = new_fourier_film([state%gap], enough_cells([state%gap]), enough_modes([state%gap]), .false., 1e-5_wp)
      call film%evaluate([film_motion(state%motion%position, 0.01_wp*[1.0_wp, tan(half)])], [paper_oil], 0.0_wp, &
         & .false., r)
      state%force = norm2(r(1)%force)
      state%motion%velocity = 0.01_wp*[sign(1.0_wp, between(-1.0_wp, 1.0_wp)), tan(half)*(1 - 2*state%t)]
   end function random_state

   !> The film by tables of a tolerance.
   type(film_response) function looked_up(state, condition, tolerance) result(found)
      type(film_state), intent(in) :: state
      integer, intent(in) :: condition
      real(wp), intent(in) :: tolerance
      type(table_film_type) :: film
      type(film_response) :: r(1)
      associate (gaps => [state%gap])
         film = new_table_film(gaps, [new_direct_film(gaps, enough_cells(gaps), enough_modes(gaps), 80, 8, &
            & condition == reynolds, condition == gumbel, 1e-4_wp)], condition /= none, condition == gumbel, tolerance)
      end associate
      call film%evaluate([state%motion], [paper_oil], 0.0_wp, .true., r)
      call expect(r(1)%status == film_ok, 'the film is open')
      found = r(1)
   end function looked_up

   !> Force and slopes against the axial modes at a tolerance of 1e-7. Slopes, times the thinnest film, lose what the
   !> cubics lose: their check allows 1/0.15 of the tolerance over half a thickness, more where cells are cut.
   subroutine against_modes(condition, states)
      integer, intent(in) :: condition, states
      type(film_state) :: state
      type(fourier_film_type) :: film
      type(film_response) :: expected(1), found
      real(wp) :: errors(states, size(tolerances)), slopes(states, size(tolerances))
      integer :: i, k
      do i = 1, states
         state = random_state()
         associate (gaps => [state%gap])
            film = new_fourier_film(gaps, enough_cells(gaps), enough_modes(gaps), condition == gumbel, 1e-7_wp)
         end associate
         call film%evaluate([state%motion], [paper_oil], 0.0_wp, .true., expected)
         do k = 1, size(tolerances)
            found = looked_up(state, condition, tolerances(k))
            errors(i, k) = norm2(found%force - expected(1)%force)/state%force
            slopes(i, k) = norm2(found%derivatives(:, :2) - expected(1)%derivatives(:, :2))*state%thinnest/state%force
         end do
      end do
      call judge(errors, 1.0_wp, 'force, '//names(condition))
      call judge(slopes, 30.0_wp, 'slopes, '//names(condition))
   end subroutine against_modes

   !> Nine of ten within so many tolerances, and every one within ten times that; a hundredth of the tolerance leaves a
   !> tenth of the errors at most, as cells are halved and nodes never coarser than some grid.
   subroutine judge(errors, factor, what)
      real(wp), intent(in) :: errors(:, :), factor
      character(len=*), intent(in) :: what
      integer :: k, above
      real(wp) :: average(size(tolerances))
      do k = 1, size(tolerances)
         above = count(errors(:, k) > factor*tolerances(k))
         average(k) = sum(errors(:, k))/size(errors, 1)
         call expect(10*above <= size(errors, 1), what//', '//to_text(above)//' above '//to_text(factor*tolerances(k)))
         call expect(maxval(errors(:, k)) < 10*factor*tolerances(k), what//', worst '//to_text(maxval(errors(:, k))) &
            & //' at '//to_text(tolerances(k)))
      end do
      call expect(average(3) < 0.1_wp*average(1), what//': averages '//to_text(average(1))//' and ' &
         & //to_text(average(3)))
      print '(a,3(2x,es8.1))', what//': average errors', average
   end subroutine judge

   !> Force against finite volumes with the condition of Reynolds on even grids, each finer by the root of 2, of which
   !> the last two are extrapolated. By how much that has not converged is told by the first two.
   subroutine against_volumes(states)
      integer, intent(in) :: states
      integer, parameter :: columns(3) = [120, 170, 240], rows(3) = [12, 17, 24]
      type(film_state) :: state
      type(elimination_film_type) :: grid
      type(film_counters) :: unused
      type(film_response) :: r, found
      real(wp) :: forces(2, 3), doubt, errors(states, size(tolerances))
      integer :: i, k
      do i = 1, states
         state = random_state()
         do k = 1, 3
            grid = new_elimination_film(state%gap, columns(k), rows(k))
            call grid%evaluate(state%motion, paper_oil, 0.0_wp, .true., .false., unused, r)
            forces(:, k) = r%force
         end do
         doubt = norm2(2*forces(:, 3) - 3*forces(:, 2) + forces(:, 1))/state%force
         do k = 1, size(tolerances)
            found = looked_up(state, reynolds, tolerances(k))
            errors(i, k) = max(0.0_wp, norm2(found%force - 2*forces(:, 3) + forces(:, 2))/state%force - doubt)
         end do
      end do
      ! the nodes' coarsest grid errs by up to 2.4e-4 by itself, which no cell notices
      call judge(errors, 3.0_wp, 'force, reynolds')
   end subroutine against_volumes

   !> Force against over-relaxation, extrapolated likewise, at the middle tolerance.
   subroutine against_relaxation(condition, states)
      integer, intent(in) :: condition, states
      integer, parameter :: columns(3) = [60, 84, 120], rows(3) = [15, 21, 30]
      type(film_state) :: state
      type(sor_film_type) :: solver
      type(film_response) :: r, found
      real(wp) :: forces(2, 3), doubt, error
      integer :: i, k
      do i = 1, states
         do
            state = random_state()
            if (state%thinnest > 0.2_wp*clearance) exit
         end do
         do k = 1, 3
            solver = new_sor_film([state%gap], sor_options(columns(k), rows(k), tolerance=1e-9_wp, max_sweeps=100000, &
               & cavitation=merge(cavitation_reynolds, cavitation_none, condition == reynolds)))
            call solver%evaluate_pad(1, state%motion, paper_oil, 0.0_wp, .false., r)
            call expect(r%status == film_ok, 'over-relaxation converges')
            forces(:, k) = r%force
         end do
         doubt = norm2(2*forces(:, 3) - 3*forces(:, 2) + forces(:, 1))/state%force
         found = looked_up(state, condition, tolerances(2))
         error = norm2(found%force - 2*forces(:, 3) + forces(:, 2))/state%force
         call expect(doubt < 1e-3_wp, 'extrapolation has converged: '//to_text(doubt))
         call expect(error < tolerances(2) + 2*doubt, names(condition)//' against relaxation, error '//to_text(error))
      end do
   end subroutine against_relaxation
end program test_film_table
