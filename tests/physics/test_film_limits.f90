!> Films against limits in closed form, narrow and long, which volumes approach with the second order of their cells.
program test_film_limits
   use kinds, only: wp
   use text, only: to_text
   use film_solver, only: film_motion, film_response, film_ok, cavitation_none
   use pad_gap, only: pad_gap_type
   use sor_film, only: sor_film_type, sor_options, new_sor_film
   use paper_bearing, only: paper_oil, offset_pad, speed, clearance
   use check, only: runs, expect, expect_close, report
   implicit none (type, external)
   !> Wedge alone; squeeze alone; both, with the journal towards either edge.
   type(film_motion), parameter :: motions(4) = [film_motion([-3e-5_wp, 4e-5_wp], [0.0_wp, 0.0_wp]), &
      & film_motion([0.0_wp, 5e-5_wp], [2e-3_wp, 8e-3_wp]), film_motion([-2e-5_wp, 5e-5_wp], [-4e-3_wp, 6e-3_wp]), &
      & film_motion([1e-5_wp, 3e-5_wp], [3e-3_wp, -5e-3_wp])]
   integer :: i

   do i = 1, size(motions)
      if (runs('long_pad')) call long_pad(motions(i))
      if (runs('narrow_pad')) call narrow_pad(motions(i))
   end do
   call report()

contains

   !> The paper's pad but for its length and pivot, with pressures at the leading edge and elsewhere.
   pure type(pad_gap_type) function pad(length, supply, ambient)
      real(wp), intent(in) :: length, supply, ambient
      pad = offset_pad([supply, ambient, 0.0_wp], length)
   end function pad

   !> Force on a grid of nx by 4 cells, converged far below the error of the grid.
   function grid_force(film, motion, nx) result(force)
      type(pad_gap_type), intent(in) :: film
      type(film_motion), intent(in) :: motion
      integer, intent(in) :: nx
      real(wp) :: force(2)
      type(sor_film_type) :: solver
      type(film_response) :: r
      solver = new_sor_film([film], sor_options(nx, 4, tolerance=1e-10_wp, max_sweeps=100000, &
         & cavitation=cavitation_none))
      call solver%evaluate_pad(1, motion, paper_oil, speed, .false., r)
      call expect(r%status == film_ok, 'the film converges')
      force = r%force
   end function grid_force

   !> Errors on 20, 40, 80, 160 cells fall fourfold. The next term of the error series is h**2 smaller:
   !> 1/20**2 times some 50, so the first ratio may miss 4 by a quarter, the last by a hundredth.
   subroutine expect_second_order(film, motion, exact, what)
      type(pad_gap_type), intent(in) :: film
      type(film_motion), intent(in) :: motion
      real(wp), intent(in) :: exact(2)
      character(len=*), intent(in) :: what
      real(wp) :: found(0:3), ratio
      integer :: k
      do k = 0, 3
         found(k) = norm2(grid_force(film, motion, 20*2**k) - exact)/norm2(exact)
      end do
      do k = 1, 3
         ratio = found(k - 1)/found(k)
         call expect_close(ratio, 4.0_wp, 1.0_wp/4**(k - 1) + 0.02_wp, 'order two on '//to_text(20*2**k)//' cells, ' &
            & //what)
      end do
      call expect(found(3) < 1e-3_wp, 'error on 160 cells '//to_text(found(3))//', '//what)
   end subroutine expect_second_order

   !> So long that the sides count for 1e-9 of it: (h^3 p')' = -6 mu w R_J R h' + 12 mu R^2 dh/dt along the
   !> arc, with both edge pressures. Integrated once: h^3 p' = -6 mu w R_J R h + 12 mu R^2 G + C with
   !> G' = dh/dt; the forces follow by partial integration.
   subroutine long_pad(motion)
      type(film_motion), intent(in) :: motion
      integer, parameter :: n = 4000
      real(wp), parameter :: length = 1e4_wp, supply = 4e5_wp, ambient = 1e5_wp
      type(pad_gap_type) :: film
      real(wp) :: phi(0:n), weight(0:n), h(0:n), flow(0:n), slope(0:n), constant, exact(2), r
      integer :: k
      film = pad(length, supply, ambient)
      r = film%pad_radius()
      phi = [(-film%trailing_angle + film%arc()*k/n, k=0, n)]
      ! Simpson's rule: an error of 1e-13
      weight = film%arc()/n/3*[1.0_wp, (merge(4.0_wp, 2.0_wp, mod(k, 2) == 1), k=1, n - 1), 1.0_wp]
      h = clearance - motion%position(1)*sin(phi) - motion%position(2)*cos(phi)
      flow = -6*paper_oil%viscosity*speed*film%journal_radius*r*h &
         & + 12*paper_oil%viscosity*r**2*(motion%velocity(1)*cos(phi) - motion%velocity(2)*sin(phi))
      constant = (supply - ambient - sum(weight*flow/h**3))/sum(weight/h**3)
      slope = (flow + constant)/h**3
      exact(1) = -(-(supply*cos(phi(n)) - ambient*cos(phi(0))) + sum(weight*slope*cos(phi)))
      exact(2) = -((supply*sin(phi(n)) - ambient*sin(phi(0))) - sum(weight*slope*sin(phi)))
      call expect_second_order(film, motion, exact*r*length, 'long pad')
   end subroutine long_pad

   !> So narrow that the edges count for nothing: h^3 d2p/dZ2 = -6 mu w (R_J/R) dh/dphi + 12 mu dh/dt, a
   !> parabola at each angle, whose integral is -L^3/(12 h^3) times the right-hand side. Axially the grid is
   !> exact for it, with two rows as with many.
   subroutine narrow_pad(motion)
      type(film_motion), intent(in) :: motion
      integer, parameter :: n = 4000
      real(wp), parameter :: length = 1e-7_wp
      type(pad_gap_type) :: film
      type(sor_film_type) :: solver
      type(film_response) :: r
      real(wp) :: phi(0:n), weight(0:n), h(0:n), right(0:n), exact(2), force(2)
      integer :: k
      film = pad(length, 0.0_wp, 0.0_wp)
      phi = [(-film%trailing_angle + film%arc()*k/n, k=0, n)]
      weight = film%arc()/n/3*[1.0_wp, (merge(4.0_wp, 2.0_wp, mod(k, 2) == 1), k=1, n - 1), 1.0_wp]
      h = clearance - motion%position(1)*sin(phi) - motion%position(2)*cos(phi)
      right = -6*paper_oil%viscosity*speed*film%journal_radius/film%pad_radius() &
         & *(motion%position(2)*sin(phi) - motion%position(1)*cos(phi)) &
         & - 12*paper_oil%viscosity*(motion%velocity(1)*sin(phi) + motion%velocity(2)*cos(phi))
      exact = film%pad_radius()*length**3/12*[sum(weight*right/h**3*sin(phi)), sum(weight*right/h**3*cos(phi))]
      call expect_second_order(film, motion, exact, 'narrow pad')
      force = grid_force(film, motion, 40)
      do k = 2, 12, 5
         solver = new_sor_film([film], sor_options(40, k, tolerance=1e-12_wp, max_sweeps=100000, &
            & cavitation=cavitation_none))
         call solver%evaluate_pad(1, motion, paper_oil, speed, .false., r)
         ! solutions to 1e-10, amplified by 1/(1 - Jacobi's radius), 100 at most
         call expect_close(norm2(r%force - force), 0.0_wp, 1e-8_wp*norm2(force), 'parabola on rows '//to_text(k))
      end do
   end subroutine narrow_pad
end program test_film_limits
