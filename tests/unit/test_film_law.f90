!> A law whose mobilities turn with the film thickness, in every solver: modes against finite volumes, which share
!> nothing with them but the law; derivatives against differences; over-relaxation against elimination; tables against
!> films that are solved; heat against the power that drives the film. A law of mobilities 1 is a uniform film.
program test_film_law
   use kinds, only: wp
   use film_solver, only: film_solver_type, film_motion, film_oil, film_response, film_counters, cavitation_none, &
      & cavitation_reynolds, film_ok
   use pad_gap, only: pad_gap_type
   use fourier_film, only: fourier_film_type, new_fourier_film, converged_film
   use elimination_film, only: elimination_film_type, new_elimination_film
   use direct_film, only: new_direct_film
   use table_film, only: new_table_film
   use sor_film, only: new_sor_film, sor_options
   use film_losses, only: film_losses_type, film_loss, new_film_losses
   use film_differences, only: difference
   use thickness_law, only: thickness_law_type
   use paper_bearing, only: offset_pad, paper_oil, speed, clearance
   use check, only: runs, expect, expect_close, report
   implicit none (type, external)

   !> As thick films of a mean Reynolds number of some 1500 are: at H = 1 E = 1/2.
   type(thickness_law_type), parameter :: law = thickness_law_type(19e-3_wp, .true., 1.0_wp, 0.4_wp)
   !> A loaded film in motion, and one that cavitates.
   type(film_motion), parameter :: loaded = film_motion(clearance*[-0.25_wp, 0.35_wp], [2e-3_wp, -3e-3_wp]), &
      & diverging = film_motion(clearance*[0.05_wp, 0.4_wp], [1e-3_wp, 2e-3_wp])
   real(wp), parameter :: under_pressure(3) = [4e5_wp, 1e5_wp, 0.0_wp], around(3) = 0

   if (runs('mobilities_of_one')) call mobilities_of_one()
   if (runs('modes_against_volumes')) then
      call modes_against_volumes(around)
      call modes_against_volumes(under_pressure)
   end if
   if (runs('order_of_modes')) call order_of_modes()
   if (runs('derivatives')) call derivatives()
   if (runs('solvers_agree')) call solvers_agree()
   if (runs('tables')) call tables()
   if (runs('losses')) call losses()
   if (runs('law_changes')) call law_changes()
   call report()

contains

   !> A solver by its number: modes with Guembel's condition, modes and volumes, over-relaxation.
   subroutine make(kind, pressures, solver)
      integer, intent(in) :: kind
      real(wp), intent(in) :: pressures(3)
      class(film_solver_type), allocatable, intent(out) :: solver
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
   end subroutine make

   !> Whether two answers are the same to a tolerance.
   subroutine same(a, b, tolerance, what)
      type(film_response), intent(in) :: a, b
      real(wp), intent(in) :: tolerance
      character(len=*), intent(in) :: what
      call expect(a%status == film_ok .and. b%status == film_ok, 'solved, '//what)
      call expect_close(norm2(a%force - b%force)/norm2(b%force), 0.0_wp, tolerance, 'force, '//what)
      call expect_close(norm2(a%derivatives(:, :2) - b%derivatives(:, :2))/norm2(b%derivatives(:, :2)), 0.0_wp, &
         & 4*tolerance, 'stiffness, '//what)
      call expect_close(norm2(a%derivatives(:, 3:) - b%derivatives(:, 3:))/norm2(b%derivatives(:, 3:)), 0.0_wp, &
         & 4*tolerance, 'damping, '//what)
   end subroutine same

   subroutine mobilities_of_one()
      class(film_solver_type), allocatable :: solver
      type(film_response) :: plain, with
      integer :: kind
      do kind = 1, 3
         call make(kind, under_pressure, solver)
         call solver%evaluate_pad(1, loaded, thickness_law_type(paper_oil%viscosity, .true.), speed, .true., with)
         call solver%forget()
         call solver%evaluate_pad(1, loaded, paper_oil, speed, .true., plain)
         call same(with, plain, 1e-12_wp, 'mobilities of 1')
         call expect_close(with%max_pressure, plain%max_pressure, 1e-12_wp*plain%max_pressure, 'pressure')
      end do
   end subroutine mobilities_of_one

   !> Two grids, extrapolated, whose error falls by 8 or more from a pair to the next; four times their last change.
   subroutine modes_against_volumes(pressures)
      real(wp), intent(in) :: pressures(3)
      type(fourier_film_type) :: modes
      type(elimination_film_type) :: grid
      type(film_response) :: by_modes, answers(3), film
      type(film_counters) :: counters
      integer :: k
      real(wp) :: change
      modes = converged_film(offset_pad(pressures), .false., 1e-6_wp)
      call modes%evaluate_pad(1, loaded, law, speed, .true., by_modes)
      do k = 1, 3
         grid = new_elimination_film(offset_pad(pressures), 60*2**(k - 1), 8*2**(k - 1))
         call grid%evaluate(loaded, law, speed, .false., .true., counters, answers(k))
      end do
      film = answers(3)
      film%force = (4*answers(3)%force - answers(2)%force)/3
      film%derivatives = (4*answers(3)%derivatives - answers(2)%derivatives)/3
      change = norm2(film%force - (4*answers(2)%force - answers(1)%force)/3)/norm2(film%force) + 1e-6_wp
      call expect(change < 3e-4_wp, 'volumes are close')
      call same(by_modes, film, change, 'modes and volumes')
   end subroutine modes_against_volumes

   !> Numerov's scheme stays of the fourth order.
   subroutine order_of_modes()
      type(fourier_film_type) :: modes
      type(film_response) :: film
      real(wp) :: force(2, 3)
      integer :: k
      do k = 1, 3
         modes = new_fourier_film([offset_pad()], 24*2**k, 16, .false.)
         call modes%evaluate_pad(1, loaded, law, speed, .false., film)
         force(:, k) = film%force
      end do
      associate (order => log(norm2(force(:, 2) - force(:, 1))/norm2(force(:, 3) - force(:, 2)))/log(2.0_wp))
         call expect(order > 3.7_wp, 'order of the modes')
      end associate
   end subroutine order_of_modes

   subroutine derivatives()
      integer :: kind
      do kind = 1, 2
         call by_differences(kind, around, loaded, 1e-7_wp)
         call by_differences(kind, under_pressure, loaded, 1e-7_wp)
      end do
      call by_differences(3, around, loaded, 1e-6_wp)
      ! the weights of clipped integrals, whose error is of the fourth order, are not differentiated
      call by_differences(1, around, diverging, 1e-5_wp)
   end subroutine derivatives

   subroutine by_differences(kind, pressures, motion, tolerance)
      integer, intent(in) :: kind
      real(wp), intent(in) :: pressures(3)
      type(film_motion), intent(in) :: motion
      real(wp), intent(in) :: tolerance
      class(film_solver_type), allocatable :: solver
      type(film_response) :: film
      real(wp) :: slope(2)
      integer :: k
      call make(kind, pressures, solver)
      call solver%evaluate_pad(1, motion, law, speed, .true., film)
      do k = 1, 4
         call difference(solver, motion, law, speed, k, 1e-3_wp*clearance*merge(1.0_wp, speed, k < 3), slope)
         call expect_close(norm2(film%derivatives(:, k) - slope)/norm2(slope), 0.0_wp, tolerance, 'a derivative')
      end do
   end subroutine by_differences

   !> Over-relaxation against elimination on the same volumes, with cavitation.
   subroutine solvers_agree()
      class(film_solver_type), allocatable :: sor
      type(elimination_film_type) :: volumes
      type(film_response) :: a, b
      type(film_counters) :: counters
      call make(3, around, sor)
      volumes = new_elimination_film(offset_pad(), 80, 8)
      call volumes%evaluate(diverging, law, speed, .true., .true., counters, a)
      call sor%evaluate_pad(1, diverging, law, speed, .true., b)
      call expect(volumes%first <= 80, 'the film cavitates')
      call same(a, b, 1e-8_wp, 'elimination and over-relaxation')
   end subroutine solvers_agree

   !> Full and cavitated films from tables of the law.
   subroutine tables()
      class(film_solver_type), allocatable :: table
      type(fourier_film_type) :: modes
      type(film_response) :: found(1), solved
      table = new_table_film(new_direct_film([offset_pad()], 40, 16, 80, 8, cavitation_reynolds, 1e-4_wp), .true., &
         & 1e-5_wp, filled=.true.)
      call table%evaluate([loaded], [law], speed, .true., found)
      call expect(found(1)%from_tables, 'a full film from a table')
      modes = converged_film(offset_pad(), .false., 1e-6_wp)
      call modes%evaluate_pad(1, loaded, law, speed, .true., solved)
      call same(found(1), solved, 3e-5_wp, 'a full film')
      call table%take_pressures([loaded], [law], speed, found)
      call expect_close(found(1)%max_pressure/solved%max_pressure, 1.0_wp, 2e-3_wp, 'its pressure')
      call table%evaluate([diverging], [law], speed, .true., found)
      call expect(found(1)%from_tables, 'a cavitated film from a table')
      call cavitated(solved)
      call same(found(1), solved, 1e-3_wp, 'a cavitated film')
      call table%evaluate([loaded], [thickness_law_type(law%viscosity, .true., 0.5_wp*law%a, law%c)], speed, .true., &
         & found)
      call modes%evaluate_pad(1, loaded, law, speed, .true., solved)
      call expect(norm2(found(1)%force - solved%force) > 0.1_wp*norm2(solved%force), 'another law has other tables')
   end subroutine tables

   !> The film that cavitates, on fine volumes.
   subroutine cavitated(film)
      type(film_response), intent(out) :: film
      type(elimination_film_type) :: grid
      type(film_counters) :: counters
      grid = new_elimination_film(offset_pad(), 336, 48)
      grid%ends_between = .true.
      call grid%evaluate(diverging, law, speed, .true., .true., counters, film)
   end subroutine cavitated

   !> What drives a film becomes heat; sliding resists by the integral of S/h.
   subroutine losses()
      type(film_losses_type) :: finder
      type(film_loss) :: loss
      type(pad_gap_type) :: gap
      integer, parameter :: n = 10000
      real(wp) :: w(2), shear, phi
      integer :: i
      gap = offset_pad()
      finder = new_film_losses(gap, cavitation_none)
      call finder%find(loaded, law, speed, loss)
      call expect(loss%status == film_ok, 'a film')
      w = loaded%velocity + speed*gap%journal_radius/(2*gap%pad_radius())*[loaded%position(2), -loaded%position(1)]
      call expect_close(loss%pressure/dot_product(-w, loss%force), 1.0_wp, 1e-3_wp, 'heat of the pressure')
      shear = 0
      do i = 1, n
         phi = (i - 0.5_wp)*gap%arc()/n - gap%trailing_angle
         shear = shear + law%shear_weight(gap, loaded, phi)/gap%thickness(loaded, sin(phi), cos(phi))
      end do
      shear = shear*law%viscosity*(speed*gap%journal_radius)**2*gap%pad_radius()*gap%axial_length*gap%arc()/n
      call expect_close(loss%couette/shear, 1.0_wp, 1e-6_wp, 'heat of sliding')
   end subroutine losses

   !> A solver that had the law before solves a uniform film, and one of variable viscosity, as one that had not.
   subroutine law_changes()
      class(film_solver_type), allocatable :: solver, fresh
      type(film_oil) :: oils(2)
      type(film_response) :: film, other
      integer :: kind, k
      oils = paper_oil
      oils(2)%varies = .true.
      oils(2)%flow(:1) = [0.3_wp, -0.2_wp]
      do kind = 1, 3
         call make(kind, under_pressure, solver)
         do k = 1, 2
            call solver%evaluate_pad(1, loaded, law, speed, .true., film)
            call solver%forget()
            call solver%evaluate_pad(1, loaded, oils(k), speed, .true., film)
            call make(kind, under_pressure, fresh)
            call fresh%evaluate_pad(1, loaded, oils(k), speed, .true., other)
            call expect(.not. any(abs(film%force - other%force) > 0) &
               & .and. .not. any(abs(film%derivatives - other%derivatives) > 0), 'the same film')
         end do
      end do
   end subroutine law_changes
end program test_film_law
