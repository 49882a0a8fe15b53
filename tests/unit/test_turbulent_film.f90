!> Turbulent films: closures against values of an independent program, their tables against the closures themselves,
!> smoothness; single films against that program (finite volumes whose mobilities follow the film), derivatives against
!> differences, over-relaxation against elimination and modes, tables of films against films that are solved; the
!> laminar limit.
program test_turbulent_film
   use kinds, only: wp, degree
   use film_solver, only: film_solver_type, film_motion, film_response, film_counters, cavitation_none, &
      & cavitation_reynolds, film_ok
   use pad_gap, only: pad_gap_type
   use film_law, only: film_law_type
   use film_oils, only: film_oil, uneven_oil, weights_degree
   use turbulence_closure, only: closure_type, closure_factors, new_closure, along, across, shear, eddy_factors, &
      & eddy_conduction, closures, wall_law_type, new_wall_law
   use turbulent_film, only: turbulent_film_type
   use fourier_film, only: fourier_film_type, new_fourier_film, converged_film
   use direct_film, only: new_direct_film
   use table_film, only: new_table_film
   use elimination_film, only: elimination_film_type, new_elimination_film
   use sor_film, only: sor_film_type, new_sor_film, sor_options
   use film_losses, only: film_losses_type, film_loss, new_film_losses
   use film_differences, only: difference
   use check, only: runs, expect, expect_close, report
   implicit none (type, external)

   real(wp), parameter :: density = 860, speed = 900, clearance = 2e-4_wp, radius = 0.0998_wp

   if (runs('closure_values')) call closure_values()
   if (runs('closure_tables')) call closure_tables()
   if (runs('conduction')) call conduction()
   if (runs('single_films')) call single_films()
   if (runs('derivatives')) call derivatives()
   if (runs('over_relaxation')) call over_relaxation()
   if (runs('tables')) call tables()
   if (runs('laminar_limit')) call laminar_limit()
   call report()

contains

   !> kx, kz and kf of the table.
   function factors_of(closure, reynolds) result(k)
      type(closure_type), intent(in) :: closure
      real(wp), intent(in) :: reynolds
      real(wp) :: k(3)
      type(closure_factors) :: found
      found = closure%at(log(reynolds))
      associate (v => found%value(0, :))
         k = [12/exp(v(along)), 12/exp(v(along) + v(across)), exp(v(shear))]
      end associate
   end function factors_of

   !> Six decimals were given.
   subroutine expect_factors(name, from, to, reynolds, k)
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: from, to, reynolds(:), k(:, :)
      type(closure_type) :: closure
      integer :: i
      closure = new_closure(name, from, to)
      do i = 1, size(reynolds)
         call expect_close(maxval(abs(factors_of(closure, reynolds(i)) - k(:, i))), 0.0_wp, 6e-7_wp, name)
      end do
   end subroutine expect_factors

   subroutine closure_values()
      real(wp), parameter :: re(5) = [500.0_wp, 800.0_wp, 1400.0_wp, 5000.0_wp, 50000.0_wp]
      call expect_factors('ng_pan', 500.0_wp, 1500.0_wp, re, reshape([12.0_wp, 12.0_wp, 1.0_wp, &
         & 12.60092_wp, 12.270154_wp, 1.088666_wp, 20.25365_wp, 16.109549_wp, 2.11443_wp, &
         & 42.730915_wp, 28.621922_wp, 4.822516_wp, 232.564683_wp, 135.2195_wp, 27.321427_wp], [3, 5]))
      call expect_factors('ng_pan', 1.0_wp, 2.0_wp, re, reshape([14.198435_wp, 12.98522_wp, 1.327444_wp, &
         & 16.142754_wp, 13.948901_wp, 1.589819_wp, 20.258318_wp, 16.111913_wp, 2.11505_wp, &
         & 42.730915_wp, 28.621922_wp, 4.822516_wp, 232.564683_wp, 135.2195_wp, 27.321427_wp], [3, 5]))
      call expect_factors('ng_pan_fit', 500.0_wp, 1500.0_wp, re, reshape([12.0_wp, 12.0_wp, 1.0_wp, &
         & 12.550953_wp, 12.260154_wp, 1.063516_wp, 21.218644_wp, 16.501573_wp, 2.086812_wp, &
         & 41.014288_wp, 27.292541_wp, 4.599259_wp, 242.468679_wp, 151.469634_wp, 32.348232_wp], [3, 5]))
      call expect_factors('constantinescu', 1.0_wp, 2.0_wp, re, reshape([16.422543_wp, 13.979712_wp, 1.467033_wp, &
         & 18.521946_wp, 14.804496_wp, 1.698023_wp, 22.357338_wp, 16.245668_wp, 2.126334_wp, &
         & 41.660062_wp, 22.904405_wp, 4.344623_wp, 210.917071_wp, 72.062301_wp, 24.952298_wp], [3, 5]))
      call expect_factors('hirs', 1.0_wp, 2.0_wp, re, reshape([12.0_wp, 12.0_wp, 1.037383_wp, &
         & 12.0_wp, 12.0_wp, 1.475805_wp, 15.723628_wp, 12.0_wp, 2.245471_wp, &
         & 40.849264_wp, 23.308459_wp, 5.833631_wp, 229.712295_wp, 131.0731_wp, 32.804918_wp], [3, 5]))
   end subroutine closure_values

   !> The tables against the closure itself between their points; value and three derivatives are continuous, and the
   !> last ones are those of the ones before.
   subroutine closure_tables()
      type(closure_type) :: closure
      type(closure_factors) :: here, there
      type(wall_law_type) :: wall
      real(wp) :: r, width, k(3), w
      integer :: i, c
      wall = new_wall_law()
      do c = 1, 3
         closure = new_closure(trim(closures(c)), 500.0_wp, 1000.0_wp)
         do i = 0, 400
            r = log(400.0_wp) + i*0.025_wp
            here = closure%at(r)
            if (c == 1) then
               w = closure%turbulent_share(exp(r))
               k = eddy_factors(wall, exp(r), w)
               call expect_close(maxval(abs(factors_of(closure, exp(r))/k - 1)), 0.0_wp, 1e-10_wp, 'the table')
            end if
            width = 1e-4_wp
            there = closure%at(r + width)
            ! Taylor's series; of what stands next the fifth power of s has a fourth derivative of some 1e4
            associate (a => here%value, b => there%value)
               call expect_close(maxval(abs(b(0, :) - a(0, :) - width*a(1, :) - width**2/2*a(2, :) &
                  & - width**3/6*a(3, :))), 0.0_wp, 1e-11_wp, 'the value goes on')
               call expect_close(maxval(abs(b(2, :) - a(2, :) - width*a(3, :))), 0.0_wp, 1e-4_wp, 'its bend goes on')
            end associate
         end do
      end do
   end subroutine closure_tables

   !> Heat from wall to wall, given to four decimals.
   subroutine conduction()
      type(closure_type) :: closure
      type(wall_law_type) :: wall
      real(wp), parameter :: re(3) = [700.0_wp, 1000.0_wp, 5000.0_wp], given(3) = [1.8427_wp, 6.8_wp, 31.3306_wp]
      integer :: i
      wall = new_wall_law()
      closure = new_closure('ng_pan', 500.0_wp, 1500.0_wp)
      do i = 1, size(re)
         associate (share => closure%turbulent_share(re(i)))
            call expect_close(eddy_conduction(wall, re(i), share, 100/0.9_wp), given(i), 6e-5_wp, 'conduction')
         end associate
      end do
      call expect_close(eddy_conduction(wall, 500.0_wp, 0.0_wp, 100.0_wp), 1.0_wp, 1e-12_wp, 'without eddies')
   end subroutine conduction

   !> A pad of the single films, whose pivot leaves this angle towards the leading edge, degrees.
   type(pad_gap_type) function pad(leading)
      real(wp), intent(in) :: leading
      pad = pad_gap_type(radius, clearance, 0.1_wp, leading*degree, (60 - leading)*degree, 0.0_wp, 0.0_wp, 0.0_wp)
   end function pad

   !> Oil of a viscosity in its film, with Ng and Pan's closure.
   type(turbulent_film_type) function film_of(gap, viscosity, oil) result(law)
      type(pad_gap_type), intent(in) :: gap
      real(wp), intent(in) :: viscosity
      type(film_oil), intent(in), optional :: oil
      law%closure = new_closure('ng_pan', 500.0_wp, 1500.0_wp)
      if (present(oil)) then
         call law%set(oil, gap, density, speed*gap%journal_radius)
      else
         call law%set(film_oil(viscosity), gap, density, speed*gap%journal_radius)
      end if
   end function film_of

   !> Full films by modes 1e-4, derivatives 3e-4. Of the cavitated one the independent program's damping is symmetric to
   !> 3e-3 alone: its derivatives are known to 1e-2; `tables` has closer ones.
   subroutine single_films()
      call one_film(30.0_wp, 1.03e-2_wp, clearance*[-0.15_wp, 0.45_wp], [0.0_wp, 0.0_wp], cavitation_none, &
         & [-311.74060837_wp, -4096.98154335_wp], [-6388855.324958_wp, -9076680.297276_wp, 141202563.245595_wp, &
         & -76496584.086549_wp], [-10378.150493_wp, 7996.278216_wp, 7996.278216_wp, -328077.125553_wp], &
         & 1e-4_wp, 3e-4_wp)
      call one_film(36.0_wp, 3e-3_wp, clearance*[-0.25_wp, 0.5_wp], clearance*speed*[0.1_wp, 0.15_wp], &
         & cavitation_none, [-933.45010440_wp, -11097.74748722_wp], [-7202930.882647_wp, -17073522.682585_wp, &
         & 79180429.727087_wp, -246777303.578486_wp], [-7463.079537_wp, -9381.210611_wp, &
         & -9381.210611_wp, -212467.405271_wp], 1e-4_wp, 3e-4_wp)
      call one_film(30.0_wp, 5e-3_wp, clearance*[-0.1_wp, 0.55_wp], [0.0_wp, 0.0_wp], cavitation_reynolds, &
         & [-476.27946151_wp, -3308.87150343_wp], [1867214.038735_wp, -14315532.655348_wp, 120117826.521600_wp, &
         & -87118112.03_wp], [-7394.978332_wp, -12386.947858_wp, -12353.611720_wp, -300260.351951_wp], 2e-3_wp, 1e-2_wp)
   end subroutine single_films

   subroutine one_film(leading, viscosity, position, velocity, condition, force, over_position, over_velocity, &
      & tolerance, of_derivatives)
      real(wp), intent(in) :: leading, viscosity, position(2), velocity(2), force(2), over_position(4), &
         & over_velocity(4), tolerance, of_derivatives
      integer, intent(in) :: condition
      type(pad_gap_type) :: gap
      class(film_solver_type), allocatable :: solver
      type(turbulent_film_type) :: law
      type(film_response) :: film(1)
      gap = pad(leading)
      law = film_of(gap, viscosity)
      solver = new_table_film(new_direct_film([gap], 60, 24, 120, 12, condition, 1e-6_wp, 2e-3_wp), .false., &
         & 1.3e-5_wp, 4e-7_wp)
      call solver%evaluate([film_motion(position, velocity)], [law], speed, .true., film)
      call expect(film(1)%status == film_ok, 'a film')
      call expect_close(norm2(film(1)%force - force)/norm2(force), 0.0_wp, tolerance, 'force')
      associate (d => film(1)%derivatives, k => transpose(reshape(over_position, [2, 2])), &
         & c => transpose(reshape(over_velocity, [2, 2])))
         call expect_close(norm2(d(:, :2) - k)/norm2(k), 0.0_wp, of_derivatives, 'stiffness')
         call expect_close(norm2(d(:, 3:) - c)/norm2(c), 0.0_wp, of_derivatives, 'damping')
      end associate
   end subroutine one_film

   !> Adjoints against differences, of even and of uneven oil, by modes and by volumes that cavitate.
   subroutine derivatives()
      call by_differences(film_of(pad(30.0_wp), 8e-3_wp), 1e-6_wp)
      call by_differences(film_of(pad(30.0_wp), 8e-3_wp, uneven()), 1e-6_wp)
      call in_mirror(film_of(pad(30.0_wp), 8e-3_wp, uneven()))
   end subroutine derivatives

   !> Oil whose viscosity changes along the arc and across the film.
   type(film_oil) function uneven()
      real(wp) :: weights(0:weights_degree, 3)
      weights = 0
      weights(:2, 1) = [0.2_wp, 0.3_wp, -0.1_wp]
      weights(:1, 2) = [0.48_wp, 0.02_wp]
      weights(:2, 3) = [-0.15_wp, -0.35_wp, 0.12_wp]
      uneven = uneven_oil(8e-3_wp, weights)
   end function uneven

   subroutine by_differences(law, tolerance)
      type(turbulent_film_type), intent(in) :: law
      real(wp), intent(in) :: tolerance
      type(film_motion), parameter :: motion = film_motion(clearance*[-0.35_wp, 0.4_wp], [2e-3_wp, -3e-3_wp])
      class(film_solver_type), allocatable :: solver
      type(film_response) :: film
      real(wp) :: slope(2)
      integer :: k, kind
      do kind = 1, 2
         if (allocated(solver)) deallocate (solver)
         if (kind == 1) solver = new_fourier_film([pad(30.0_wp)], 60, 16, .false.)
         if (kind == 2) solver = new_direct_film([pad(30.0_wp)], 60, 16, 80, 8, cavitation_reynolds, 1e-4_wp)
         call solver%evaluate_pad(1, motion, law, speed, .true., film)
         do k = 1, 4
            call difference(solver, motion, law, speed, k, 1e-3_wp*clearance*merge(1.0_wp, speed, k < 3), slope)
            call expect_close(norm2(film%derivatives(:, k) - slope)/norm2(slope), 0.0_wp, tolerance, 'a derivative')
         end do
      end do
   end subroutine by_differences

   !> A pad whose pivot is in its middle, seen in a mirror.
   subroutine in_mirror(law)
      type(turbulent_film_type), intent(in) :: law
      class(film_law_type), allocatable :: other
      type(fourier_film_type) :: modes
      type(film_response) :: film, seen
      type(film_motion), parameter :: motion = film_motion(clearance*[-0.2_wp, 0.4_wp], [2e-3_wp, -3e-3_wp]), &
         & mirror = film_motion(clearance*[0.2_wp, 0.4_wp], [-2e-3_wp, -3e-3_wp])
      modes = converged_film(pad(30.0_wp), .false., 1e-6_wp)
      call modes%evaluate_pad(1, motion, law, speed, .false., film)
      other = law%mirrored()
      call modes%evaluate_pad(1, mirror, other, -speed, .false., seen)
      call expect_close(norm2(seen%force*[-1, 1] - film%force)/norm2(film%force), 0.0_wp, 1e-12_wp, 'in a mirror')
   end subroutine in_mirror

   !> Over-relaxation: films of even and of uneven oil as elimination has them on the same volumes, full and cavitated;
   !> a full film, from two grids extrapolated, as the modes have it.
   subroutine over_relaxation()
      type(film_motion), parameter :: loaded = film_motion(clearance*[-0.2_wp, 0.4_wp], [2e-3_wp, -3e-3_wp]), &
         & diverging = film_motion(clearance*[0.1_wp, 0.4_wp], [1e-3_wp, 2e-3_wp])
      type(turbulent_film_type) :: laws(2)
      type(film_response) :: films(2), film
      type(fourier_film_type) :: modes
      integer :: k
      laws = [film_of(pad(30.0_wp), 8e-3_wp), film_of(pad(30.0_wp), 8e-3_wp, uneven())]
      modes = converged_film(pad(30.0_wp), .false., 1e-6_wp)
      do k = 1, 2
         call relaxed_and_eliminated(laws(k), diverging, cavitation_reynolds, 1, film)
         call relaxed_and_eliminated(laws(k), loaded, cavitation_none, 1, films(1))
         call relaxed_and_eliminated(laws(k), loaded, cavitation_none, 2, films(2))
         call modes%evaluate_pad(1, loaded, laws(k), speed, .true., film)
         films(2)%force = (4*films(2)%force - films(1)%force)/3
         films(2)%derivatives = (4*films(2)%derivatives - films(1)%derivatives)/3
         call same(films(2), film, 1e-4_wp, 'over-relaxation and modes')
      end do
   end subroutine over_relaxation

   !> A film by over-relaxation, which elimination has, too, with a condition of cavitation, on a grid this much finer.
   subroutine relaxed_and_eliminated(law, motion, condition, finer, film)
      type(turbulent_film_type), intent(in) :: law
      type(film_motion), intent(in) :: motion
      integer, intent(in) :: condition, finer
      type(film_response), intent(out) :: film
      type(sor_film_type) :: sor
      type(elimination_film_type) :: grid
      type(film_response) :: other
      type(film_counters) :: counters
      sor = new_sor_film([pad(30.0_wp)], sor_options(80*finer, 8*finer, 0.0_wp, 1e-11_wp, 10000, condition))
      call sor%evaluate_pad(1, motion, law, speed, .true., film)
      grid = new_elimination_film(pad(30.0_wp), 80*finer, 8*finer)
      call grid%evaluate(motion, law, speed, condition == cavitation_reynolds, .true., counters, other)
      call expect(film%status == film_ok .and. other%status == film_ok, 'a film by over-relaxation')
      call expect((grid%first <= 80*finer) .eqv. condition == cavitation_reynolds, 'the film that is to cavitate does')
      call same(film, other, 1e-9_wp, 'over-relaxation and elimination')
   end subroutine relaxed_and_eliminated

   !> Full and cavitated films from tables.
   subroutine tables()
      class(film_solver_type), allocatable :: table
      type(fourier_film_type) :: modes
      type(film_response) :: found(1), solved
      type(elimination_film_type) :: grid
      type(film_counters) :: counters
      type(turbulent_film_type) :: law
      type(film_motion) :: motion
      law = film_of(pad(30.0_wp), 8e-3_wp)
      table = new_table_film(new_direct_film([pad(30.0_wp)], 40, 16, 80, 8, cavitation_reynolds, 1e-4_wp), .true., &
         & 1e-5_wp, filled=.true.)
      motion = film_motion(clearance*[-0.2_wp, 0.4_wp], [2e-3_wp, -3e-3_wp])
      call table%evaluate([motion], [law], speed, .true., found)
      call expect(found(1)%from_tables, 'a full film from a table')
      modes = converged_film(pad(30.0_wp), .false., 1e-6_wp)
      call modes%evaluate_pad(1, motion, law, speed, .true., solved)
      call same(found(1), solved, 3e-5_wp, 'a full film')
      motion = film_motion(clearance*[0.1_wp, 0.4_wp], [1e-3_wp, 2e-3_wp])
      call table%evaluate([motion], [law], speed, .true., found)
      call expect(found(1)%from_tables, 'a cavitated film from a table')
      grid = new_elimination_film(pad(30.0_wp), 336, 48)
      grid%ends_between = .true.
      call grid%evaluate(motion, law, speed, .true., .true., counters, solved)
      call same(found(1), solved, 1e-3_wp, 'a cavitated film')
   end subroutine tables

   subroutine same(a, b, tolerance, what)
      type(film_response), intent(in) :: a, b
      real(wp), intent(in) :: tolerance
      character(len=*), intent(in) :: what
      call expect_close(norm2(a%force - b%force)/norm2(b%force), 0.0_wp, tolerance, 'force, '//what)
      call expect_close(norm2(a%derivatives - b%derivatives)/norm2(b%derivatives), 0.0_wp, 4*tolerance, &
         & 'derivatives, '//what)
   end subroutine same

   !> A film that lies below the transition is the laminar one, to the bit where no film of the pad reaches it.
   subroutine laminar_limit()
      type(turbulent_film_type) :: law
      type(fourier_film_type) :: modes
      type(film_losses_type) :: finder
      type(film_response) :: film, laminar
      type(film_loss) :: loss, laminar_loss
      type(film_motion), parameter :: motion = film_motion(clearance*[-0.2_wp, 0.4_wp], [2e-3_wp, -3e-3_wp])
      type(film_oil) :: oil
      modes = converged_film(pad(30.0_wp), .false., 1e-6_wp)
      finder = new_film_losses(pad(30.0_wp), cavitation_none)
      oil = film_oil(0.4_wp)
      law = film_of(pad(30.0_wp), oil%viscosity)
      call expect(.not. law%varies, 'no eddies anywhere')
      call modes%evaluate_pad(1, motion, oil, speed, .true., laminar)
      call modes%evaluate_pad(1, motion, law, speed, .true., film)
      call expect(.not. any(abs(film%force - laminar%force) > 0), 'the laminar film')
      oil = film_oil(0.05_wp)
      law = film_of(pad(30.0_wp), oil%viscosity)
      call expect(law%varies, 'eddies in a thicker film')
      call modes%evaluate_pad(1, motion, oil, speed, .true., laminar)
      call modes%evaluate_pad(1, motion, law, speed, .true., film)
      call same(film, laminar, 1e-12_wp, 'below the transition')
      call finder%find(motion, oil, speed, laminar_loss)
      call finder%find(motion, law, speed, loss)
      call expect_close(loss%couette/laminar_loss%couette, 1.0_wp, 1e-8_wp, 'heat of sliding')
      call expect_close(loss%pressure/laminar_loss%pressure, 1.0_wp, 1e-3_wp, 'heat of the pressure')
   end subroutine laminar_limit
end program test_turbulent_film
