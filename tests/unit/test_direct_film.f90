!> Which solver `auto` takes for a pad, and how it joins them: modes where the film is full, what few cavitated cells
!> add, finite volumes with a share of the modes, finite volumes alone.
program test_direct_film
   use kinds, only: wp, degree
   use text, only: to_text
   use film_solver, only: film_oil, film_motion, film_response, film_counters, film_ok, film_closed, &
      & cavitation_reynolds
   use pad_gap, only: pad_gap_type
   use fourier_film, only: fourier_film_type, new_fourier_film
   use elimination_film, only: elimination_film_type, new_elimination_film
   use direct_film, only: direct_film_type, new_direct_film
   use film_differences, only: difference
   use paper_bearing, only: paper_oil, paper_pad, offset_pad, speed, clearance
   use check, only: runs, expect, expect_close, between, report
   implicit none (type, external)

   integer, parameter :: cells = 24, modes = 8, columns = 40, rows = 8
   integer :: i

   do i = 1, 10
      if (runs('whole')) call whole()
      if (runs('slight')) call slight()
      if (runs('between_both')) call between_both()
   end do
   if (runs('coarse')) call coarse()
   if (runs('empty')) call empty()
   if (runs('closed')) call closed()
   if (runs('each_pad_its_own')) call each_pad_its_own()
   call report()

contains

   !> The solver, and those it is made of, for one dry pad.
   subroutine solvers(auto, by_modes, by_cells)
      type(direct_film_type), intent(out) :: auto
      type(fourier_film_type), intent(out) :: by_modes
      type(elimination_film_type), intent(out) :: by_cells
      auto = new_direct_film([paper_pad()], cells, modes, columns, rows, cavitation_reynolds)
      by_modes = new_fourier_film([paper_pad()], cells, modes, .false.)
      by_cells = new_elimination_film(paper_pad(), columns, rows)
   end subroutine solvers

   subroutine expect_same(found, expected, what)
      type(film_response), intent(in) :: found, expected
      character(len=*), intent(in) :: what
      call expect(found%status == expected%status, 'status, '//what)
      call expect_close(norm2(found%force - expected%force), 0.0_wp, 1e-12_wp*norm2(expected%force), 'force, '//what)
      call expect_close(norm2(found%derivatives - expected%derivatives), 0.0_wp, 1e-12_wp*norm2(expected%derivatives), &
         & 'slopes, '//what)
      call expect_close(found%max_pressure, expected%max_pressure, 1e-12_wp*expected%max_pressure, 'maximum, '//what)
   end subroutine expect_same

   !> A film that is squeezed enough not to cavitate is that of the modes, to the last bit.
   subroutine whole()
      type(direct_film_type) :: auto
      type(fourier_film_type) :: by_modes
      type(elimination_film_type) :: by_cells
      type(film_motion) :: motion
      type(film_response) :: found(1), expected(1)
      motion%position = clearance*[between(-0.5_wp, -0.3_wp), between(0.0_wp, 0.5_wp)]
      motion%velocity = clearance*speed*[0.0_wp, between(0.05_wp, 0.2_wp)]
      call solvers(auto, by_modes, by_cells)
      call auto%evaluate([motion], [paper_oil], speed, .true., found)
      call by_modes%evaluate([motion], [paper_oil], speed, .true., expected)
      call expect_same(found(1), expected(1), 'a full film')
      call expect_close(norm2(found(1)%force - expected(1)%force), 0.0_wp, 0.0_wp, 'to the last bit')
      call expect(auto%counters%fourier == 1 .and. auto%counters%volumes == 0, 'is counted as one')
   end subroutine whole

   !> A little cavitation adds to the modes what it adds to the finite volumes; the slopes are those of that sum.
   subroutine slight()
      type(direct_film_type) :: auto
      type(fourier_film_type) :: by_modes
      type(elimination_film_type) :: by_cells
      type(film_counters) :: counters
      type(film_motion) :: motion
      type(film_response) :: found(1), of_modes(1), cavitated, full_film
      real(wp) :: change(2)
      integer :: k
      motion%position = clearance*[between(-0.12_wp, -0.10_wp), between(0.4_wp, 0.5_wp)]
      motion%velocity = 0
      call solvers(auto, by_modes, by_cells)
      call auto%evaluate([motion], [paper_oil], speed, .true., found)
      call by_modes%evaluate([motion], [paper_oil], speed, .true., of_modes)
      call by_cells%evaluate(motion, paper_oil, speed, .true., .false., counters, cavitated)
      call by_cells%evaluate(motion, paper_oil, speed, .false., .false., counters, full_film)
      change = cavitated%force - full_film%force
      call expect(-of_modes(1)%min_pressure < 0.1_wp*of_modes(1)%max_pressure, 'a loaded film')
      call expect(norm2(change) > 1e-6_wp*norm2(of_modes(1)%force), 'that cavitates')
      call expect_close(norm2(found(1)%force - of_modes(1)%force - change), 0.0_wp, 1e-9_wp*norm2(of_modes(1)%force), &
         & 'force of slight cavitation')
      call expect_close(found(1)%min_pressure, 0.0_wp, 0.0_wp, 'the minimum is the cavitation pressure')
      call expect(auto%counters%fourier == 0 .and. auto%counters%volumes == 1, 'it is counted as cavitated')
      do k = 1, 4
         call difference(auto, motion, paper_oil, speed, k, 1e-5_wp*clearance*merge(1.0_wp, speed, k <= 2), change)
         ! the force bends where a cell begins to cavitate, seldom within such a step
         call expect_close(norm2(found(1)%derivatives(:, k) - change), 0.0_wp, 1e-3_wp*norm2(change), &
            & 'slope '//to_text(k))
      end do
   end subroutine slight

   !> Finite volumes with cavitation, and a share of what the modes know better: 1 at a tension of a tenth of the
   !> highest pressure, 0 where the two are the same.
   subroutine between_both()
      type(direct_film_type) :: auto
      type(fourier_film_type) :: by_modes
      type(elimination_film_type) :: by_cells
      type(film_counters) :: counters
      type(film_motion) :: motion
      type(film_response) :: found(1), of_modes(1), expected, full_film
      real(wp) :: share
      motion%position = clearance*[between(-0.05_wp, 0.0_wp), between(0.4_wp, 0.5_wp)]
      motion%velocity = 0
      call solvers(auto, by_modes, by_cells)
      call auto%evaluate([motion], [paper_oil], speed, .true., found)
      call by_modes%evaluate([motion], [paper_oil], speed, .true., of_modes)
      call by_cells%evaluate(motion, paper_oil, speed, .true., .true., counters, expected)
      call by_cells%evaluate(motion, paper_oil, speed, .false., .true., counters, full_film)
      share = (1 + of_modes(1)%min_pressure/of_modes(1)%max_pressure)/0.9_wp
      call expect(share > 0 .and. share < 1, 'a share between: '//to_text(share))
      expected%force = expected%force + share*(of_modes(1)%force - full_film%force)
      expected%derivatives = expected%derivatives + share*(of_modes(1)%derivatives - full_film%derivatives)
      expected%max_pressure = expected%max_pressure + share*(of_modes(1)%max_pressure - full_film%max_pressure)
      call expect_same(found(1), expected, 'between both')
   end subroutine between_both

   !> On a grid far too coarse for a thin film the two differ, and the slopes contain those of the share.
   subroutine coarse()
      type(direct_film_type) :: auto
      type(film_motion) :: motion
      type(film_response) :: found(1)
      type(film_oil), parameter :: oil = film_oil(0.00216_wp)
      real(wp), parameter :: turning = 310.5_wp, arc = 78*degree, thin = 9e-5_wp
      real(wp) :: change(2)
      integer :: k
      auto = new_direct_film([pad_gap_type(0.0315_wp, thin, 0.00786_wp, 0.55_wp*arc, 0.45_wp*arc, 5.4e5_wp, &
         & 0.0_wp, 0.0_wp)], 16, 4, 16, 8, cavitation_reynolds)
      motion = film_motion([-1.1628e-5_wp, 8.8232e-5_wp], [1.13e-5_wp, 1.78e-6_wp])
      call auto%evaluate([motion], [oil], turning, .true., found)
      call expect(auto%counters%volumes == 1, 'the film cavitates')
      do k = 1, 4
         call difference(auto, motion, oil, turning, k, 1e-6_wp*thin*merge(1.0_wp, turning, k <= 2), change)
         call expect_close(norm2(found(1)%derivatives(:, k) - change), 0.0_wp, 1e-3_wp*norm2(change), &
            & 'slope '//to_text(k)//' on a coarse grid')
      end do
   end subroutine coarse

   !> A pad that draws more than it presses is left to the finite volumes.
   subroutine empty()
      type(direct_film_type) :: auto
      type(fourier_film_type) :: by_modes
      type(elimination_film_type) :: by_cells
      type(film_counters) :: counters
      type(film_motion) :: motion
      type(film_response) :: found(1), of_modes(1), expected
      motion%position = clearance*[0.2_wp, 0.3_wp]
      motion%velocity = 0
      call solvers(auto, by_modes, by_cells)
      call auto%evaluate([motion], [paper_oil], speed, .true., found)
      call by_modes%evaluate([motion], [paper_oil], speed, .true., of_modes)
      call by_cells%evaluate(motion, paper_oil, speed, .true., .true., counters, expected)
      call expect(-of_modes(1)%min_pressure > of_modes(1)%max_pressure, 'the full film draws')
      call expect(norm2(expected%force) > 0, 'and a part of it presses')
      call expect_same(found(1), expected, 'an empty pad')
   end subroutine empty

   subroutine closed()
      type(direct_film_type) :: auto
      type(film_response) :: found(1)
      auto = new_direct_film([paper_pad()], cells, modes, columns, rows, cavitation_reynolds)
      call auto%evaluate([film_motion([0.0_wp, 1.1_wp*clearance], [0.0_wp, 0.0_wp])], [paper_oil], speed, .true., found)
      call expect(found(1)%status == film_closed, 'a closed film')
      call expect_close(found(1)%min_film_thickness, -0.1_wp*clearance, 1e-18_wp, 'and by how much')
      call expect(auto%counters%fourier == 0 .and. auto%counters%volumes == 0, 'none was solved')
   end subroutine closed

   !> Pads do not disturb each other, whatever film each has.
   subroutine each_pad_its_own()
      type(film_motion), parameter :: motions(3) = [film_motion([20e-6_wp, 30e-6_wp], [0.0_wp, 0.0_wp]), &
         & film_motion([-40e-6_wp, 30e-6_wp], [0.0_wp, 7e-3_wp]), film_motion([-5e-6_wp, 45e-6_wp], [0.0_wp, 0.0_wp])]
      type(direct_film_type) :: together, alone
      type(film_response) :: found(3), expected(1)
      integer :: k
      together = new_direct_film([paper_pad(), offset_pad(), paper_pad([2e5_wp, 1e5_wp, 0.0_wp])], cells, modes, &
         & columns, rows, cavitation_reynolds)
      call together%evaluate(motions, spread(paper_oil, 1, size(motions)), speed, .true., found)
      call expect(all(found%status == film_ok), 'three pads')
      do k = 1, 3
         if (k == 1) alone = new_direct_film([paper_pad()], cells, modes, columns, rows, cavitation_reynolds)
         if (k == 2) alone = new_direct_film([offset_pad()], cells, modes, columns, rows, cavitation_reynolds)
         if (k == 3) alone = new_direct_film([paper_pad([2e5_wp, 1e5_wp, 0.0_wp])], cells, modes, columns, rows, &
            & cavitation_reynolds)
         call alone%evaluate(motions(k:k), [paper_oil], speed, .true., expected)
         call expect_same(found(k), expected(1), 'pad '//to_text(k))
      end do
   end subroutine each_pad_its_own
end program test_direct_film
