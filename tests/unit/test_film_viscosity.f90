!> Films whose oil changes: every solver, with and without pressures around the pads, answers as one that has never seen
!> another oil, bit for bit; so do losses and flows.
program test_film_viscosity
   use kinds, only: wp
   use case_groups, only: bearing_type
   use film_solver, only: film_solver_type, film_motion, film_oil, film_response
   use film_losses, only: film_losses_type, film_loss
   use factories, only: make_film, march_films, converged_films, new_losses
   use paper_bearing, only: speed, clearance
   use check, only: runs, expect, report
   implicit none (type, external)

   !> Of the first and of the second pad, from the start, and from then on.
   type(film_oil), parameter :: before(2) = film_oil(19e-3_wp), after(2) = [film_oil(31e-3_wp), film_oil(7e-3_wp)]
   character(len=*), parameter :: solvers(*) = [character(len=7) :: 'auto', 'direct', 'fourier', 'sor', 'fine']
   character(len=*), parameter :: conditions(*) = [character(len=8) :: 'none', 'gumbel', 'reynolds']
   real(wp), parameter :: tolerance = 1e-5_wp
   integer :: i, k

   do i = 1, size(solvers)
      do k = 1, size(conditions)
         if (solvers(i) == 'fourier' .and. conditions(k) == 'reynolds') cycle
         if (.not. runs(trim(solvers(i))//'_'//trim(conditions(k)))) cycle
         call same_films(solvers(i), conditions(k), .false.)
         call same_films(solvers(i), conditions(k), .true.)
      end do
   end do
   do k = 1, size(conditions)
      if (runs('losses_'//trim(conditions(k)))) call same_losses(conditions(k))
   end do
   call report()

contains

   !> The paper's bearing with these films.
   type(bearing_type) function bearing_with(solver, condition, supplied) result(bearing)
      character(len=*), intent(in) :: solver, condition
      logical, intent(in) :: supplied
      bearing = bearing_type()
      if (solver /= 'fine') bearing%film%solver = trim(solver)
      bearing%film%cavitation = trim(condition)
      if (supplied) then
         bearing%supply_pressure = 3e5_wp
         bearing%ambient_pressure = 1e5_wp
      end if
   end function bearing_with

   !> A loaded film, and one that cavitates.
   function motions()
      type(film_motion) :: motions(2)
      motions = [film_motion(clearance*[-0.25_wp, 0.35_wp]), film_motion(clearance*[0.05_wp, 0.2_wp])]
   end function motions

   subroutine same_films(solver, condition, supplied)
      character(len=*), intent(in) :: solver, condition
      logical, intent(in) :: supplied
      class(film_solver_type), allocatable :: film, fresh
      type(film_response) :: changed(2), made(2)
      integer :: pad, accuracy
      accuracy = merge(converged_films, march_films, solver == 'fine')
      call make_film(bearing_with(solver, condition, supplied), tolerance, accuracy, film)
      call film%evaluate(motions(), before, speed, .true., changed)
      ! over-relaxation starts from its last field
      call film%forget()
      call film%evaluate(motions(), after, speed, .true., changed)
      call film%take_pressures(motions(), after, speed, changed)
      do pad = 1, 2
         call make_film(bearing_with(solver, condition, supplied), tolerance, accuracy, fresh)
         call fresh%evaluate(motions(), spread(after(pad), 1, 2), speed, .true., made)
         call fresh%take_pressures(motions(), spread(after(pad), 1, 2), speed, made)
         call expect(.not. any(abs(changed(pad)%force - made(pad)%force) > 0), 'force')
         call expect(.not. any(abs(changed(pad)%derivatives - made(pad)%derivatives) > 0), 'derivatives')
         call expect(.not. any(abs([changed(pad)%max_pressure - made(pad)%max_pressure, &
            & changed(pad)%min_pressure - made(pad)%min_pressure]) > 0), 'pressures')
      end do
   end subroutine same_films

   subroutine same_losses(condition)
      character(len=*), intent(in) :: condition
      type(film_losses_type) :: losses(2), fresh(2)
      type(film_motion) :: motion(2)
      type(film_loss) :: changed, made
      integer :: pad
      losses = new_losses(bearing_with('auto', condition, condition == 'none'))
      motion = motions()
      do pad = 1, 2
         call losses(pad)%find(motion(pad), before(pad), speed, changed)
         call losses(pad)%find(motion(pad), after(pad), speed, changed)
         fresh = new_losses(bearing_with('auto', condition, condition == 'none'))
         call fresh(pad)%find(motion(pad), after(pad), speed, made)
         call expect(.not. any(abs([changed%force - made%force, changed%couette - made%couette, &
            & changed%pressure - made%pressure, changed%wedge - made%wedge, changed%inlet - made%inlet, &
            & changed%outlet - made%outlet, changed%side - made%side]) > 0), 'losses and flows')
      end do
   end subroutine same_losses
end program test_film_viscosity
