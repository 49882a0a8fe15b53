!> Cavitation of the film: the Reynolds condition as a complementarity problem, and the order of the models.
program test_cavitation
   use kinds, only: wp
   use text, only: to_text
   use film_solver, only: film_motion, film_response, film_ok, cavitation_none, cavitation_gumbel, &
      & cavitation_reynolds
   use pad_gap, only: pad_gap_type
   use film_grid, only: film_grid_type, new_film_grid
   use sor_film, only: sor_film_type, sor_options, new_sor_film
   use paper_bearing, only: paper_oil, offset_pad, speed, clearance
   use check, only: runs, expect, expect_close, between, report
   implicit none (type, external)

   integer, parameter :: nx = 40, nz = 8
   real(wp), parameter :: tolerance = 1e-9_wp
   integer :: i

   do i = 1, 12
      if (runs('complementarity')) call complementarity()
      if (runs('order_of_models')) call order_of_models()
   end do
   call report()

contains

   pure type(pad_gap_type) function pad(condition)
      real(wp), intent(in) :: condition
      pad = offset_pad([3e5_wp, 1e5_wp, condition])
   end function pad

   subroutine solve(condition, cavitation, motion, solver, r)
      real(wp), intent(in) :: condition
      integer, intent(in) :: cavitation
      type(film_motion), intent(in) :: motion
      type(sor_film_type), intent(out) :: solver
      type(film_response), intent(out) :: r
      solver = new_sor_film([pad(condition)], sor_options(nx, nz, tolerance=tolerance, max_sweeps=100000, &
         & cavitation=cavitation))
      call solver%evaluate_pad(1, motion, paper_oil, speed, .false., r)
      call expect(r%status == film_ok, 'the film converges')
   end subroutine solve

   !> A wedge that opens over part of the pad.
   type(film_motion) function opening_motion()
      opening_motion%position = clearance*[between(-0.1_wp, 0.4_wp), between(0.3_wp, 0.6_wp)]
      opening_motion%velocity = clearance*speed*[between(-0.1_wp, 0.1_wp), between(-0.1_wp, 0.1_wp)]
   end function opening_motion

   !> Volume balance of every cell in natural order, Pa: what the neighbours and the source would make the
   !> pressure, less the pressure. The plain finite volumes of the Reynolds equation on the grid's rows, written
   !> out anew.
   function imbalance(film, motion, p) result(change)
      type(pad_gap_type), intent(in) :: film
      type(film_motion), intent(in) :: motion
      real(wp), intent(in) :: p(nx, nz)
      real(wp) :: change(nx, nz), d, dz, r, phi, left, right, side(2), here, flows, sum_of
      type(film_grid_type) :: grid
      integer :: i, j
      grid = new_film_grid(film, nx, nz)
      r = film%pad_radius()
      d = film%arc()/nx
      dz = film%axial_length/(2*nz)
      do i = 1, nx
         phi = -film%trailing_angle + (i - 0.5_wp)*d
         left = thickness(motion, phi - d/2)**3/d**2
         right = thickness(motion, phi + d/2)**3/d**2
         here = thickness(motion, phi)**3*(r/dz)**2
         if (i == 1) left = 2*left
         if (i == nx) right = 2*right
         do j = 1, nz
            side = [grid%inward(j), grid%outward(j)]*here
            sum_of = left + right + sum(side)
            flows = left*merge(film%ambient_pressure, p(max(1, i - 1), j), i == 1) &
               & + right*merge(film%supply_pressure, p(min(nx, i + 1), j), i == nx) + side(1)*p(i, max(1, j - 1)) &
               & + side(2)*merge(film%ambient_pressure, p(i, min(nz, j + 1)), j == nz)
            flows = flows + 6*paper_oil%viscosity*speed*film%journal_radius*r &
               & *(thickness(motion, phi + d/2) - thickness(motion, phi - d/2))/d &
               & + 12*paper_oil%viscosity*r**2*(motion%velocity(1)*sin(phi) + motion%velocity(2)*cos(phi))
            change(i, j) = flows/sum_of - p(i, j)
         end do
      end do
   end function imbalance

   pure real(wp) function thickness(motion, angle)
      type(film_motion), intent(in) :: motion
      real(wp), intent(in) :: angle
      thickness = clearance - motion%position(1)*sin(angle) - motion%position(2)*cos(angle)
   end function thickness

   !> Everywhere p >= p_cav; where p > p_cav the balance holds; where p = p_cav the cell would rather fall
   !> below. The solver's residual is relative to the source over the diagonal, some 1e-2 of the highest
   !> pressure: the balance holds to 1e-9 of that.
   subroutine complementarity()
      type(sor_film_type) :: solver
      type(film_response) :: r
      type(film_motion) :: motion
      real(wp) :: p(nx, nz), change(nx, nz), scale
      real(wp), parameter :: condition = 0.5e5_wp
      integer :: cavitated
      motion = opening_motion()
      call solve(condition, cavitation_reynolds, motion, solver, r)
      p = solver%pressure_field(1)
      change = imbalance(pad(condition), motion, p)
      scale = tolerance*r%max_pressure
      cavitated = count(p <= condition)
      call expect(minval(p) >= condition, 'no pressure below that of cavitation')
      call expect_close(maxval(abs(change), mask=p > condition), 0.0_wp, 10*scale, 'balance in the full film')
      if (cavitated > 0) call expect(maxval(change, mask=p <= condition) <= 10*scale, &
         & 'cavitated cells would fall further: '//to_text(maxval(change, mask=p <= condition)))
      call expect_close(r%min_pressure, minval(p), 1e-9_wp*r%max_pressure, 'lowest pressure')
   end subroutine complementarity

   !> The operator has a positive inverse, so by comparison p(reynolds) >= max(p(none), p_cav) = p(gumbel) >=
   !> p(none) in every cell, and the same holds for the load.
   subroutine order_of_models()
      type(sor_film_type) :: none, gumbel, reynolds
      type(film_response) :: r_none, r_gumbel, r_reynolds
      type(film_motion) :: motion
      real(wp) :: slack
      real(wp), parameter :: condition = 0.5e5_wp
      motion = opening_motion()
      call solve(condition, cavitation_none, motion, none, r_none)
      call solve(condition, cavitation_gumbel, motion, gumbel, r_gumbel)
      call solve(condition, cavitation_reynolds, motion, reynolds, r_reynolds)
      ! solutions to the tolerance, amplified by 1/(1 - Jacobi's radius), about 200 on this grid
      slack = 1000*tolerance*max(r_none%max_pressure, -r_none%min_pressure)
      call expect(all(reynolds%pressure_field(1) >= gumbel%pressure_field(1) - slack), 'reynolds above gumbel')
      call expect_close(maxval(abs(gumbel%pressure_field(1) - max(none%pressure_field(1), condition))), 0.0_wp, slack, &
         & 'gumbel is the full film, clipped')
      call expect(-r_reynolds%force(2) >= -r_gumbel%force(2) - slack*7e-3_wp .and. &
         & -r_gumbel%force(2) >= -r_none%force(2) - slack*7e-3_wp, 'loads in order')
      if (r_none%min_pressure < condition - slack) call expect(-r_reynolds%force(2) > -r_gumbel%force(2) .and. &
         & -r_gumbel%force(2) > -r_none%force(2), 'and apart where the film cavitates')
   end subroutine order_of_models
end program test_cavitation
