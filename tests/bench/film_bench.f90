!> Time and error of one film evaluation by every solver, as CSV on standard output: film, state, what is
!> asked for, microseconds a pad, largest error over the largest force against a refined solution, work counted;
!> last the time that it takes to tabulate the contact.
!>
!> The pad moves along a small circle about each state, so that warm starts and cells of tables are those of a march,
!> and the error is that of the way. `table, wandering` goes to and fro over a large circle: another cell for
!> nearly every film; its error is against a table of a tenth of the tolerance. Cells are there before the clock starts.
program film_bench
   use, intrinsic :: iso_fortran_env, only: output_unit
   use kinds, only: wp, i8, pi, degree
   use text, only: to_text
   use film_solver, only: film_solver_type, film_motion, film_response, cavitation_none, cavitation_gumbel, &
      & cavitation_reynolds
   use pad_gap, only: pad_gap_type
   use fourier_film, only: fourier_film_type, new_fourier_film
   use direct_film, only: direct_film_type, new_direct_film
   use table_film, only: table_film_type, new_table_film
   use sor_film, only: sor_film_type, sor_options, new_sor_film
   use contact_law, only: contact_law_type, make_contact_law
   use contact_table, only: contact_table_type, new_contact_table
   use paper_bearing, only: paper_oil
   implicit none (type, external)

   !> Journal speed, rad/s; the paper's pad clearance, m.
   real(wp), parameter :: speed = 6500*pi/30, clearance = 100e-6_wp
   !> Positions of one round, on the small circle about as far apart as a march's; its radius in clearances.
   integer, parameter :: round = 180
   real(wp), parameter :: small = 0.02_wp, large = 0.3_wp
   !> That of tables with the default settings.
   real(wp), parameter :: default_tolerance = 4e-5_wp
   integer, parameter :: pads = 2
   type(pad_gap_type) :: films(pads)

   films = pad_gap_type(49.9e-3_wp, clearance, 100e-3_wp, 0.5_wp*69.3_wp*degree, 0.5_wp*69.3_wp*degree, 0.0_wp, &
      & 0.0_wp, 0.0_wp)
   write (output_unit, '(a)') 'film,condition,state,derivatives,microseconds,error,sweeps'
   call compare('whole', [-0.35_wp, 0.5_wp], cavitation_none, 'none')
   call compare('corner cavitated', [-0.19_wp, 0.5_wp], cavitation_reynolds, 'reynolds')
   call compare('cavitated', [-0.05_wp, 0.5_wp], cavitation_gumbel, 'gumbel')
   call compare('cavitated', [-0.05_wp, 0.5_wp], cavitation_reynolds, 'reynolds')
   call compare('unloaded', [-0.05_wp, -0.3_wp], cavitation_gumbel, 'gumbel')
   call compare('unloaded', [-0.05_wp, -0.3_wp], cavitation_reynolds, 'reynolds')
   call tabulate()

contains

   subroutine compare(state, centre, cavitation, condition)
      character(len=*), intent(in) :: state, condition
      !> Position in clearances.
      real(wp), intent(in) :: centre(2)
      integer, intent(in) :: cavitation
      type(fourier_film_type) :: fourier
      type(direct_film_type) :: direct
      type(table_film_type) :: fine
      type(sor_film_type) :: sor
      type(film_motion), dimension(0:round - 1) :: nearby, distant
      real(wp), dimension(2, 0:round - 1) :: exact, exact_far
      integer :: n
      nearby = path(centre, small, 1)
      ! a step of two fifths of the circle
      distant = path(centre, large, 73)
      if (cavitation == cavitation_reynolds) then
         direct = new_direct_film(films, 128, 32, 320, 64, cavitation_reynolds)
         call forces(direct, nearby, exact)
      else
         fourier = new_fourier_film(films, 128, 32, cavitation == cavitation_gumbel)
         call forces(fourier, nearby, exact)
      end if
      fine = new_table(cavitation, 0.1_wp*default_tolerance)
      call forces(fine, distant, exact_far)
      call measure('table, same cell', new_table(cavitation, default_tolerance), nearby, exact, condition, state)
      call measure('table, wandering', new_table(cavitation, default_tolerance), distant, exact_far, condition, state)
      call measure('table 4e-6', fine, nearby, exact, condition, state)
      n = 12
      do while (n <= 48)
         if (cavitation == cavitation_reynolds) then
            direct = new_direct_film(films, n, 8, 80*n/24, n/3, cavitation_reynolds)
            call measure('direct '//to_text(n), direct, nearby, exact, condition, state)
         else
            fourier = new_fourier_film(films, n, 8, cavitation == cavitation_gumbel)
            call measure('fourier '//to_text(n), fourier, nearby, exact, condition, state)
         end if
         n = 2*n
      end do
      n = 30
      do while (n <= 120)
         sor = new_sor_film(films, sor_options(n, n/4, tolerance=1e-6_wp, max_sweeps=100000, cavitation=cavitation))
         call measure('sor '//to_text(n), sor, nearby, exact, condition, state)
         n = 2*n
      end do
   end subroutine compare

   !> Tables of the default settings, but for the tolerance.
   type(table_film_type) function new_table(cavitation, tolerance)
      integer, intent(in) :: cavitation
      real(wp), intent(in) :: tolerance
      type(direct_film_type) :: direct
      direct = new_direct_film(films, 24, 8, 80, 8, cavitation)
      new_table = new_table_film(direct, .true., tolerance)
   end function new_table

   subroutine measure(name, solver, motions, exact, condition, state)
      character(len=*), intent(in) :: name, condition, state
      class(film_solver_type), intent(in) :: solver
      type(film_motion), intent(in) :: motions(0:)
      real(wp), intent(in) :: exact(2, 0:round - 1)
      class(film_solver_type), allocatable :: film
      real(wp) :: found(2, 0:round - 1), error, seconds
      integer(i8) :: sweeps
      integer :: s
      film = solver
      call forces(film, motions, found)
      error = maxval(norm2(found - exact, dim=1))/maxval(norm2(exact, dim=1))
      do s = 0, 1
         call timed(film, motions, s == 1, seconds, sweeps)
         write (output_unit, '(4(a, ","), f0.4, ",", es7.1, ",", i0)') '"'//name//'"', condition, state, &
            & trim(merge('yes', 'no ', s == 1)), 1e6_wp*seconds, error, sweeps
      end do
   end subroutine measure

   !> Places of a round about a centre, m, taken in steps, with the velocities that belong to them at the journal's
   !> speed.
   pure function path(centre, radius, step)
      !> In clearances.
      real(wp), intent(in) :: centre(2), radius
      integer, intent(in) :: step
      type(film_motion) :: path(0:round - 1)
      real(wp) :: phase
      integer :: k
      do k = 0, round - 1
         phase = 2*pi*modulo(k*step, round)/round
         path(k)%position = clearance*(centre + radius*[cos(phase), sin(phase)])
         path(k)%velocity = radius*clearance*speed*[-sin(phase), cos(phase)]
      end do
   end function path

   !> Forces on the first pad along a path.
   subroutine forces(film, motions, found)
      class(film_solver_type), intent(inout) :: film
      type(film_motion), intent(in) :: motions(0:)
      real(wp), intent(out) :: found(2, 0:round - 1)
      type(film_response) :: response(pads)
      integer :: k
      do k = 0, round - 1
         call film%evaluate(spread(motions(k), 1, pads), spread(paper_oil, 1, pads), speed, .false., response)
         found(:, k) = response(1)%force
      end do
   end subroutine forces

   !> Wall time of an evaluation, s a pad: the shortest of three batches of at least 20 ms. Sweeps a pad.
   subroutine timed(film, motions, want_derivatives, seconds, sweeps)
      class(film_solver_type), intent(inout) :: film
      type(film_motion), intent(in) :: motions(0:)
      logical, intent(in) :: want_derivatives
      real(wp), intent(out) :: seconds
      integer(i8), intent(out) :: sweeps
      type(film_motion) :: places(pads, 0:round - 1)
      type(film_response) :: response(pads)
      integer(i8) :: start, finish, rate, before
      integer :: batch, k, rounds
      places = spread(motions, 1, pads)
      seconds = huge(seconds)
      do batch = 1, 3
         rounds = 0
         before = film%counters%passes
         call system_clock(start, rate)
         do
            do k = 0, round - 1
               call film%evaluate(places(:, k), spread(paper_oil, 1, pads), speed, want_derivatives, response)
            end do
            rounds = rounds + 1
            call system_clock(finish)
            if (real(finish - start, wp) > 0.02_wp*rate) exit
         end do
         seconds = min(seconds, real(finish - start, wp)/real(rate, wp)/(pads*round*rounds))
         sweeps = (film%counters%passes - before)/(pads*round*rounds)
      end do
   end subroutine timed

   !> Time of the contact table of the paper's pivot: the shortest of ten.
   subroutine tabulate()
      class(contact_law_type), allocatable :: law
      type(contact_table_type) :: table
      integer(i8) :: start, finish, rate
      real(wp) :: seconds, force, slope
      integer :: k
      seconds = huge(seconds)
      do k = 1, 10
         call system_clock(start, rate)
         call make_contact_law('fang', 13e-3_wp, 15e-6_wp, [2.1e11_wp, 2.1e11_wp], [0.3_wp, 0.3_wp], 4.0_wp, law)
         table = new_contact_table(law)
         call system_clock(finish)
         seconds = min(seconds, real(finish - start, wp)/real(rate, wp))
      end do
      call table%lookup(1e-6_wp, force, slope)
      if (.not. force > 0) error stop 'the table is empty'
      write (output_unit, '(a, f0.1, a)') 'table,fang,contact,no,', 1e6_wp*seconds, ',0,0'
   end subroutine tabulate
end program film_bench
