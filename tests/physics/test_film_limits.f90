!> Films against limits in closed form, narrow and long; how solvers approach them with finer grids.
program test_film_limits
   use kinds, only: wp, pi
   use text, only: to_text
   use film_solver, only: film_motion, film_response, film_ok, film_solver_type
   use pad_gap, only: pad_gap_type
   use sor_film, only: sor_film_type, sor_options, new_sor_film, cavitation_none
   use paper_bearing, only: paper_oil, offset_pad, speed, clearance, paper_pad
   use fourier_film, only: new_fourier_film
   use check, only: runs, expect, expect_close, report
   implicit none (type, external)
   !> Wedge alone; squeeze alone; both, with the journal towards either edge.
   type(film_motion), parameter :: motions(4) = [film_motion([-3e-5_wp, 4e-5_wp], [0.0_wp, 0.0_wp]), &
      & film_motion([0.0_wp, 5e-5_wp], [2e-3_wp, 8e-3_wp]), film_motion([-2e-5_wp, 5e-5_wp], [-4e-3_wp, 6e-3_wp]), &
      & film_motion([1e-5_wp, 3e-5_wp], [3e-3_wp, -5e-3_wp])]
   integer :: i
   type(film_motion), parameter :: ordinary(3) = [film_motion([-2e-5_wp, 4e-5_wp], [0.0_wp, 0.0_wp]), &
      & film_motion([-4e-5_wp, 4e-5_wp], [0.0_wp, 0.0_wp]), film_motion([-2e-5_wp, 5e-5_wp], [-4e-3_wp, 6e-3_wp])]
   real(wp), parameter :: lengths(3) = [0.1_wp, 0.05_wp, 0.2_wp]

   do i = 1, size(motions)
      if (runs('long_pad')) call long_pad(motions(i))
      if (runs('narrow_pad')) call narrow_pad(motions(i))
   end do
   if (runs('linear_pressure')) call linear_pressure()
   if (runs('reference_is_fine')) call reference_is_fine()
   do i = 1, 3
      if (runs('second_order')) call second_order(lengths(i), ordinary(i))
      if (runs('fourier_order')) call fourier_order(lengths(i), ordinary(i))
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

   !> A long pad at rest with an even film: the pressure falls in a straight line from the leading edge,
   !> which the grid has exactly.
   subroutine linear_pressure()
      real(wp), parameter :: supply = 5e5_wp, ambient = 1e5_wp
      integer, parameter :: n = 40
      type(pad_gap_type) :: film
      type(sor_film_type) :: solver
      type(film_response) :: r
      real(wp), allocatable :: p(:, :)
      real(wp) :: expected(n)
      integer :: k
      film = pad(1e4_wp, supply, ambient)
      solver = new_sor_film([film], sor_options(n, 4, tolerance=1e-12_wp, max_sweeps=100000, &
         & cavitation=cavitation_none))
      call solver%evaluate_pad(1, film_motion([0.0_wp, 0.0_wp]), paper_oil, 0.0_wp, .false., r)
      p = solver%pressure_field(1)
      expected = [(ambient + (supply - ambient)*(k - 0.5_wp)/n, k=1, n)]
      call expect_close(maxval(abs(p(:, 1) - expected)), 0.0_wp, 1e-7_wp*supply, 'pressure falls from the leading edge')
   end subroutine linear_pressure

   !> p = sum over odd m of q_m(phi) cos(m pi Z/L); each q_m solves (h^3 q')' - (m pi R/L)^2 h^3 q = b_m r with
   !> b_m = 4/(m pi) (-1)^((m-1)/2), central differences on n cells and elimination; then its integral over
   !> the width is 2 L/(m pi) (-1)^((m-1)/2) q_m. Terms fall as m^-4: the sum up to m has an error of about
   !> 1/(3 m^3) of its first left out, 1e-8 for 300.
   function harmonics_force(film, motion, n) result(force)
      type(pad_gap_type), intent(in) :: film
      type(film_motion), intent(in) :: motion
      integer, intent(in) :: n
      real(wp) :: force(2)
      real(wp) :: phi(0:n), h(0:n), below(n), above(n), q(0:n), right(0:n), step, beta, factor(n), r, d
      integer :: m, k
      r = film%pad_radius()
      step = film%arc()/n
      phi = [(-film%trailing_angle + k*step, k=0, n)]
      h = clearance - motion%position(1)*sin(phi) - motion%position(2)*cos(phi)
      right = r**2*(-6*paper_oil%viscosity*speed*film%journal_radius/r &
         & *(motion%position(2)*sin(phi) - motion%position(1)*cos(phi)) &
         & - 12*paper_oil%viscosity*(motion%velocity(1)*sin(phi) + motion%velocity(2)*cos(phi)))
      ! h^3 at the middles of the cells, exactly
      above = (clearance - motion%position(1)*sin(phi(1:) - step/2) - motion%position(2)*cos(phi(1:) &
         & - step/2))**3/step**2
      below = above
      force = 0
      do m = 1, 301, 2
         beta = (m*pi*r/film%axial_length)**2
         q(0) = 0
         q(n) = 0
         factor(1) = 0
         ! elimination upwards, then substitution downwards
         do k = 1, n - 1
            d = -(below(k) + above(k + 1)) - beta*h(k)**3 + below(k)*factor(k)
            factor(k + 1) = above(k + 1)/(-d)
            q(k) = (right(k) - below(k)*q(k - 1))/d
         end do
         do k = n - 1, 1, -1
            q(k) = q(k) + factor(k + 1)*q(k + 1)
         end do
         ! the trapezoidal rule, with q = 0 at both ends
         force = force - r*step*8*film%axial_length/(m*pi)**2*[sum(q*sin(phi)), sum(q*cos(phi))]
      end do
   end function harmonics_force

   !> Extrapolated from 400 and 800 cells: an error of (1/400)**4 times some hundred, 1e-8.
   function reference_force(film, motion) result(force)
      type(pad_gap_type), intent(in) :: film
      type(film_motion), intent(in) :: motion
      real(wp) :: force(2)
      force = (4*harmonics_force(film, motion, 800) - harmonics_force(film, motion, 400))/3
   end function reference_force

   !> Two extrapolations from different grids agree to what is said of them.
   subroutine reference_is_fine()
      type(pad_gap_type) :: film
      real(wp) :: coarse(2), fine(2)
      film = paper_pad(length=0.1_wp)
      coarse = (4*harmonics_force(film, ordinary(3), 400) - harmonics_force(film, ordinary(3), 200))/3
      fine = reference_force(film, ordinary(3))
      call expect_close(norm2(coarse - fine), 0.0_wp, 1e-7_wp*norm2(fine), 'the reference has converged')
   end subroutine reference_is_fine

   function solver_force(solver, motion) result(force)
      class(film_solver_type), intent(inout) :: solver
      type(film_motion), intent(in) :: motion
      real(wp) :: force(2)
      type(film_response) :: r(1)
      call solver%evaluate([motion], [paper_oil], speed, .false., r)
      call expect(r(1)%status == film_ok, 'the film converges')
      force = r(1)%force
   end function solver_force

   !> 20 x 5 to 160 x 40: errors fall fourfold against the reference, and so do the changes from grid to
   !> grid, which know no reference. The next term, h**2 smaller, may take a quarter off the first ratio,
   !> and a sixteenth and less off the others.
   subroutine second_order(length, motion)
      real(wp), intent(in) :: length
      type(film_motion), intent(in) :: motion
      class(film_solver_type), allocatable :: solver
      real(wp) :: force(2, 0:3), reference(2), found(0:3), extrapolated(3), ratio
      character(len=:), allocatable :: what
      integer :: k
      what = ', L = '//to_text(length)
      reference = reference_force(paper_pad(length=length), motion)
      do k = 0, 3
         solver = new_sor_film([paper_pad(length=length)], sor_options(20*2**k, 5*2**k, tolerance=1e-8_wp, &
            & max_sweeps=100000, cavitation=cavitation_none))
         force(:, k) = solver_force(solver, motion)
         found(k) = norm2(force(:, k) - reference)/norm2(reference)
      end do
      do k = 1, 3
         ratio = found(k - 1)/found(k)
         call expect_close(ratio, 4.0_wp, 1.0_wp/4**(k - 1) + 0.05_wp, 'error, grid '//to_text(20*2**k)//what)
      end do
      ratio = norm2(force(:, 1) - force(:, 0))/norm2(force(:, 2) - force(:, 1))
      call expect_close(ratio, 4.0_wp, 1.0_wp, 'change, grids 20 to 80'//what)
      ratio = norm2(force(:, 2) - force(:, 1))/norm2(force(:, 3) - force(:, 2))
      call expect_close(ratio, 4.0_wp, 0.3_wp, 'change, grids 40 to 160'//what)
      ! extrapolation removes the second order: what is left is of the fourth, sixteenfold within a factor two
      do k = 1, 3
         extrapolated(k) = norm2((4*force(:, k) - force(:, k - 1))/3 - reference)/norm2(reference)
      end do
      call expect(extrapolated(2)/extrapolated(3) > 8 .and. extrapolated(2)/extrapolated(3) < 32, &
         & 'order of the extrapolated force'//what//': '//to_text(extrapolated(2))//' '//to_text(extrapolated(3)))
      call expect(extrapolated(3) < 1e-5_wp, 'extrapolated force'//what//': '//to_text(extrapolated(3)))
   end subroutine second_order

   !> Numerov's scheme along the arc, with all modes that the grid resolves: of the fourth order and more, so
   !> 24 to 48 cells leave a quarter at the very most, down to the reference's own 1e-7. At the default, 24
   !> cells and 8 modes, 1e-4 is far below what over-relaxation has.
   subroutine fourier_order(length, motion)
      real(wp), intent(in) :: length
      type(film_motion), intent(in) :: motion
      class(film_solver_type), allocatable :: solver
      real(wp) :: reference(2), coarse, fine, usual
      reference = reference_force(paper_pad(length=length), motion)
      solver = new_fourier_film([paper_pad(length=length)], 24, 200, gumbel=.false.)
      coarse = norm2(solver_force(solver, motion) - reference)/norm2(reference)
      solver = new_fourier_film([paper_pad(length=length)], 48, 200, gumbel=.false.)
      fine = norm2(solver_force(solver, motion) - reference)/norm2(reference)
      solver = new_fourier_film([paper_pad(length=length)], 24, 8, gumbel=.false.)
      usual = norm2(solver_force(solver, motion) - reference)/norm2(reference)
      call expect(fine < 0.25_wp*coarse + 1e-7_wp, 'modes converge, L = '//to_text(length)//': '//to_text(coarse) &
         & //' '//to_text(fine))
      call expect(fine < 1e-6_wp, 'modes on 48 cells, L = '//to_text(length)//': '//to_text(fine))
      call expect(usual < 1e-4_wp, 'modes by default, L = '//to_text(length)//': '//to_text(usual))
   end subroutine fourier_order
end program test_film_limits
