!> Films of uneven viscosity: weights of even oil are even oil, bit by bit as good; modes against finite volumes, which
!> share nothing with them but the weights; order of both; derivatives against differences; reciprocity.
program test_uneven_film
   use kinds, only: wp
   use film_solver, only: film_solver_type, film_motion, film_oil, film_response, film_counters, &
      & cavitation_reynolds, film_ok
   use pad_gap, only: pad_gap_type
   use fourier_film, only: fourier_film_type, new_fourier_film, converged_film
   use elimination_film, only: elimination_film_type, new_elimination_film
   use direct_film, only: new_direct_film
   use sor_film, only: new_sor_film, sor_options
   use paper_bearing, only: offset_pad, paper_oil, uneven, speed, clearance
   use check, only: runs, expect, expect_close, report
   implicit none (type, external)

   !> A loaded film in motion, and one that cavitates.
   type(film_motion), parameter :: loaded = film_motion(clearance*[-0.25_wp, 0.35_wp], [2e-3_wp, -3e-3_wp]), &
      & diverging = film_motion(clearance*[0.05_wp, 0.4_wp], [1e-3_wp, 2e-3_wp])
   real(wp), parameter :: under_pressure(3) = [4e5_wp, 1e5_wp, 0.0_wp], around(3) = 0

   if (runs('even_weights')) call even_weights()
   if (runs('modes_against_volumes')) then
      call modes_against_volumes(around)
      call modes_against_volumes([2e5_wp, 2e5_wp, 0.0_wp])
   end if
   if (runs('order_of_modes')) call order_of_modes()
   if (runs('derivatives')) call derivatives()
   if (runs('reciprocity')) call reciprocity()
   if (runs('solvers_agree')) call solvers_agree()
   call report()

contains

   !> Weights that are even oil, thinner by a factor, in every solver.
   subroutine even_weights()
      integer :: kind
      do kind = 1, 3
         call same_film(made(kind, under_pressure), loaded)
         call same_film(made(kind, around), diverging)
      end do
   end subroutine even_weights

   !> A film of either oil.
   subroutine same_film(solver, motion)
      class(film_solver_type), allocatable, intent(in) :: solver
      type(film_motion), intent(in) :: motion
      class(film_solver_type), allocatable :: used
      type(film_oil) :: thin, weighted
      type(film_response) :: plain, with
      real(wp), parameter :: factor = 1.7_wp
      thin = film_oil(paper_oil%viscosity/factor)
      weighted = paper_oil
      weighted%varies = .true.
      weighted%flow(0) = log(factor)
      used = solver
      call used%evaluate_pad(1, motion, weighted, speed, .true., with)
      call used%forget()
      call used%evaluate_pad(1, motion, thin, speed, .true., plain)
      call expect(with%status == film_ok .and. plain%status == film_ok, 'solved')
      call expect(norm2(with%force - plain%force) <= 1e-12_wp*norm2(plain%force), 'force')
      call expect(norm2(with%derivatives(:, :2) - plain%derivatives(:, :2)) &
         & <= 1e-12_wp*norm2(plain%derivatives(:, :2)), 'stiffness')
      call expect(norm2(with%derivatives(:, 3:) - plain%derivatives(:, 3:)) &
         & <= 1e-12_wp*norm2(plain%derivatives(:, 3:)), 'damping')
      call expect_close(with%max_pressure, plain%max_pressure, 1e-12_wp*plain%max_pressure, 'pressure')
   end subroutine same_film

   !> A solver by its number: modes with Guembel's condition, modes and volumes, over-relaxation.
   function made(kind, pressures) result(solver)
      integer, intent(in) :: kind
      real(wp), intent(in) :: pressures(3)
      class(film_solver_type), allocatable :: solver
      type(pad_gap_type) :: gap
      gap = offset_pad(pressures)
      select case (kind)
      case (1)
         solver = new_fourier_film([gap], 40, 16, .true., 1e-4_wp)
      case (2)
         solver = new_direct_film([gap], 40, 16, 80, 8, cavitation_reynolds, 1e-4_wp)
      case default
         solver = new_sor_film([gap], sor_options(80, 8, 0.0_wp, 1e-12_wp, 10000, cavitation_reynolds))
      end select
   end function made

   !> The full film on even volumes, extrapolated from two grids; by how much it changes from the coarser pair.
   subroutine by_volumes(gap, motion, film, change)
      type(pad_gap_type), intent(in) :: gap
      type(film_motion), intent(in) :: motion
      type(film_response), intent(out) :: film
      real(wp), intent(out) :: change
      type(elimination_film_type) :: grid
      type(film_response) :: answers(3)
      type(film_counters) :: counters
      integer :: k
      do k = 1, 3
         grid = new_elimination_film(gap, 60*2**(k - 1), 8*2**(k - 1))
         call grid%evaluate(motion, uneven, speed, .false., .true., counters, answers(k))
      end do
      film = answers(3)
      film%force = (4*answers(3)%force - answers(2)%force)/3
      film%derivatives = (4*answers(3)%derivatives - answers(2)%derivatives)/3
      change = norm2(film%force - (4*answers(2)%force - answers(1)%force)/3)/norm2(film%force)
      call expect(abs(log(norm2(answers(2)%force - answers(1)%force)/norm2(answers(3)%force - answers(2)%force)) &
         & /log(2.0_wp) - 2) < 0.1_wp, 'volumes are of second order')
   end subroutine by_volumes

   !> An error of the modes, and four times the last change of the extrapolated volumes, whose error falls by 8 or more.
   subroutine modes_against_volumes(pressures)
      real(wp), intent(in) :: pressures(3)
      type(fourier_film_type) :: modes
      type(film_response) :: by_modes, volumes
      real(wp) :: change
      modes = converged_film(offset_pad(pressures), .false., 1e-6_wp)
      call modes%evaluate_pad(1, loaded, uneven, speed, .true., by_modes)
      call by_volumes(offset_pad(pressures), loaded, volumes, change)
      change = change + 1e-6_wp
      call expect(change < 1e-4_wp, 'volumes are close')
      call expect(norm2(by_modes%force - volumes%force) < change*norm2(volumes%force), 'force')
      call expect(norm2(by_modes%derivatives(:, :2) - volumes%derivatives(:, :2)) &
         & < 4*change*norm2(volumes%derivatives(:, :2)), 'stiffness')
      call expect(norm2(by_modes%derivatives(:, 3:) - volumes%derivatives(:, 3:)) &
         & < 4*change*norm2(volumes%derivatives(:, 3:)), 'damping')
   end subroutine modes_against_volumes

   !> Numerov's scheme stays of the fourth order.
   subroutine order_of_modes()
      type(fourier_film_type) :: modes
      type(film_response) :: film
      real(wp) :: force(2, 3)
      integer :: k
      do k = 1, 3
         modes = new_fourier_film([offset_pad()], 24*2**k, 16, .false.)
         call modes%evaluate_pad(1, loaded, uneven, speed, .false., film)
         force(:, k) = film%force
      end do
      associate (order => log(norm2(force(:, 2) - force(:, 1))/norm2(force(:, 3) - force(:, 2)))/log(2.0_wp))
         call expect(order > 3.7_wp, 'order of the modes')
      end associate
   end subroutine order_of_modes

   !> Derivatives of films, whole and clipped, under pressure and not, and by volumes, against central differences.
   subroutine derivatives()
      integer :: kind
      do kind = 1, 2
         call by_differences(made(kind, around), loaded, 1e-6_wp)
         call by_differences(made(kind, under_pressure), loaded, 1e-6_wp)
      end do
      ! the weights of clipped integrals, whose error is of the fourth order, are not differentiated
      call by_differences(made(1, around), diverging, 1e-5_wp)
   end subroutine derivatives

   subroutine by_differences(made_solver, motion, tolerance)
      class(film_solver_type), allocatable, intent(in) :: made_solver
      type(film_motion), intent(in) :: motion
      real(wp), intent(in) :: tolerance
      class(film_solver_type), allocatable :: solver
      type(film_response) :: film, moved(2)
      type(film_motion) :: there
      real(wp) :: differences(2, 4), step(4), moves(4)
      integer :: k, side
      solver = made_solver
      call solver%evaluate_pad(1, motion, uneven, speed, .true., film)
      step = [spread(1e-4_wp*clearance, 1, 2), spread(1e-4_wp*clearance*speed, 1, 2)]
      do k = 1, 4
         do side = 1, 2
            moves = [motion%position, motion%velocity]
            moves(k) = moves(k) + (2*side - 3)*step(k)
            there = film_motion(moves(:2), moves(3:))
            call solver%evaluate_pad(1, there, uneven, speed, .false., moved(side))
         end do
         differences(:, k) = (moved(2)%force - moved(1)%force)/(2*step(k))
      end do
      ! steps of 1e-4 leave some 1e-8, times the third derivative
      call expect(norm2(film%derivatives(:, :2) - differences(:, :2)) < tolerance*norm2(differences(:, :2)), &
         & 'over position')
      call expect(norm2(film%derivatives(:, 3:) - differences(:, 3:)) < tolerance*norm2(differences(:, 3:)), &
         & 'over velocity')
   end subroutine by_differences

   !> The operator stays symmetric, and so does the damping of a full film.
   subroutine reciprocity()
      type(fourier_film_type) :: modes
      type(film_response) :: film
      modes = converged_film(offset_pad(), .false., 1e-7_wp)
      call modes%evaluate_pad(1, loaded, uneven, speed, .true., film)
      associate (c => film%derivatives(:, 3:))
         call expect_close(c(1, 2), c(2, 1), 1e-7_wp*norm2(c), 'damping is symmetric')
      end associate
      call expect(norm2(film%derivatives(:, 3:)) > 0, 'there is damping')
   end subroutine reciprocity

   !> Over-relaxation against elimination on the same volumes, with cavitation.
   subroutine solvers_agree()
      class(film_solver_type), allocatable :: sor
      type(elimination_film_type) :: volumes
      type(film_response) :: a, b
      type(film_counters) :: counters
      sor = made(3, around)
      volumes = new_elimination_film(offset_pad(), 80, 8)
      call volumes%evaluate(diverging, uneven, speed, .true., .true., counters, a)
      call sor%evaluate_pad(1, diverging, uneven, speed, .true., b)
      call expect(a%min_pressure >= 0 .and. volumes%first <= 80, 'the film cavitates')
      call expect(norm2(a%force - b%force) < 1e-9_wp*norm2(a%force), 'forces')
      call expect(norm2(a%derivatives - b%derivatives) < 1e-8_wp*norm2(a%derivatives), 'derivatives')
   end subroutine solvers_agree
end program test_uneven_film
