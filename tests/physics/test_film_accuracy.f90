!> The force of the axial modes at the default resolution, over the films that a bearing can ask for: pads of
!> 20 to 120 degrees, pivots at 0.3 to 0.7 of them, length to diameter 0.25 to 2, clearances of 5 to 200 um, the
!> film up to five times as thick at one place as at another, with and without squeeze and supply pressure.
!>
!> The reference is the modes themselves on 192 cells with 64 modes; first it is held against over-relaxation,
!> which shares neither scheme nor expansion with them, extrapolated from three grids.
program test_film_accuracy
   use kinds, only: wp, degree
   use text, only: to_text
   use film_solver, only: film_motion, film_response, film_ok
   use pad_gap, only: pad_gap_type
   use modal_film, only: modal_film_type, new_modal_film
   use film_resolution, only: enough_cells, enough_modes
   use sor_film, only: sor_film_type, sor_options, new_sor_film, cavitation_none
   use check, only: runs, expect, expect_close, report
   implicit none (type, external)

   !> The error of a user who asks for no cells and modes.
   real(wp), parameter :: tolerance = 1e-4_wp
   integer, parameter :: fine_cells = 192, fine_modes = 64
   real(wp), parameter :: journal_radius = 49.9e-3_wp, speed = 680, viscosity = 19e-3_wp
   !> Maximum film thickness over the minimum, and the minimum over the clearance.
   real(wp), parameter :: most_uneven = 5, least_film = 0.05_wp

   !> A pad and its film, by numbers without dimension but for arc (degrees) and clearance (m).
   type :: film_state
      real(wp) :: arc, pivot, length_to_diameter, clearance
      !> Film thickness at the leading and trailing edge, over the clearance.
      real(wp) :: leading, trailing
      !> Velocity over clearance times speed.
      real(wp) :: velocity(2) = 0
      !> Pressure at the leading edge over the highest of the film without it.
      real(wp) :: supply = 0
   end type film_state

   !> The worst of some states: its error, that of the number of modes alone, that of the number of cells alone.
   type :: worst_case
      type(film_state) :: state
      real(wp) :: error = -1, by_modes = 0, by_cells = 0
      integer :: states = 0, above = 0
   end type worst_case

   !> Groups: the pad's length over its arc's length; still or squeezed, without and with supply pressure.
   real(wp), parameter :: shapes(0:3) = [0.0_wp, 0.5_wp, 2.5_wp, huge(1.0_wp)]
   character(len=*), parameter :: shape_names(3) = [character(len=8) :: 'narrow', 'ordinary', 'wide']
   character(len=*), parameter :: kinds_of_load(4) = [character(len=18) :: 'wedge', 'wedge and squeeze', &
      & 'wedge and supply', 'all three']
   type(worst_case) :: worst(3, 4), all_states

   if (runs('reference_is_right')) call reference_is_right()
   if (runs('ranges')) call ranges()
   call report()

contains

   !> Every group of states, at the ends of the ranges and between them.
   subroutine ranges()
      integer :: shape_class, load
      call extremes()
      call between_extremes()
      do shape_class = 1, 3
         do load = 1, 4
            associate (group => worst(shape_class, load))
               call expect(group%states >= 25, 'enough states, '//trim(shape_names(shape_class))//': ' &
                  & //to_text(group%states))
               call expect(group%error <= tolerance, to_text(group%above)//' of '//to_text(group%states)//' ' &
                  & //trim(shape_names(shape_class))//' pads, '//trim(kinds_of_load(load))//', worst ' &
                  & //described(group))
               if (group%error > all_states%error) then
                  all_states%state = group%state
                  all_states%error = group%error
                  all_states%by_modes = group%by_modes
                  all_states%by_cells = group%by_cells
               end if
               all_states%states = all_states%states + group%states
               all_states%above = all_states%above + group%above
            end associate
         end do
      end do
      print '(a)', to_text(all_states%states)//' states, '//to_text(all_states%above)//' above ' &
         & //to_text(tolerance)//'; worst '//described(all_states)
   end subroutine ranges

   !> The pad of a state; the supply pressure comes later.
   pure type(pad_gap_type) function pad(state)
      type(film_state), intent(in) :: state
      pad = pad_gap_type(journal_radius, state%clearance, state%length_to_diameter*2*journal_radius, &
         & state%pivot*state%arc*degree, (1 - state%pivot)*state%arc*degree, viscosity, 0.0_wp, 0.0_wp, 0.0_wp)
   end function pad

   !> The journal at which the film has the thicknesses of a state at its edges.
   pure type(film_motion) function motion(state)
      type(film_state), intent(in) :: state
      type(pad_gap_type) :: film
      real(wp) :: leading, trailing
      film = pad(state)
      leading = state%clearance*(1 - state%leading)
      trailing = state%clearance*(1 - state%trailing)
      motion%position = [leading*cos(film%trailing_angle) - trailing*cos(film%leading_angle), &
         & leading*sin(film%trailing_angle) + trailing*sin(film%leading_angle)]/sin(film%arc())
      motion%velocity = state%clearance*speed*state%velocity
   end function motion

   !> Neither thinner nor more uneven than is asked for; the film is thickest at an edge or where it has an
   !> extremum.
   pure logical function asked_for(state)
      type(film_state), intent(in) :: state
      integer, parameter :: n = 200
      type(pad_gap_type) :: film
      real(wp) :: phi(0:n), h(0:n)
      integer :: i
      film = pad(state)
      phi = [(-film%trailing_angle + film%arc()*i/n, i=0, n)]
      h = film%thickness(motion(state), sin(phi), cos(phi))/state%clearance
      asked_for = minval(h) > 0.999_wp*least_film .and. maxval(h) < 1.001_wp*most_uneven*minval(h)
   end function asked_for

   type(film_response) function answer(film, at, columns, most_modes, wanted)
      type(pad_gap_type), intent(in) :: film
      type(film_motion), intent(in) :: at
      integer, intent(in) :: columns, most_modes
      real(wp), intent(in), optional :: wanted
      type(modal_film_type) :: solver
      type(film_response) :: r(1)
      solver = new_modal_film([film], columns, most_modes, .false., wanted)
      call solver%evaluate([at], speed, .false., r)
      call expect(r(1)%status == film_ok, 'the film is open')
      answer = r(1)
   end function answer

   !> The pad with its supply pressure.
   type(pad_gap_type) function supplied(state)
      type(film_state), intent(in) :: state
      type(film_response) :: r
      supplied = pad(state)
      if (.not. state%supply > 0) return
      r = answer(supplied, motion(state), enough_cells([supplied]), enough_modes([supplied]))
      supplied%supply_pressure = state%supply*max(r%max_pressure, -r%min_pressure)
   end function supplied

   !> The cells that over-relaxation starts from, along the arc and along half the width: cells no longer than
   !> a twelfth of the layers in which the pressure falls to the sides, a third of the shorter of arc and length.
   subroutine reference_is_right()
      call against_relaxation(film_state(69.3_wp, 0.5_wp, 1.0_wp, 100e-6_wp, 0.8_wp, 0.4_wp), 60, 15)
      call against_relaxation(film_state(20.0_wp, 0.3_wp, 2.0_wp, 40e-6_wp, 0.9_wp, 0.2_wp), 24, 48)
      call against_relaxation(film_state(120.0_wp, 0.5_wp, 0.25_wp, 20e-6_wp, 0.5_wp, 2.3_wp), 60, 15)
      call against_relaxation(film_state(120.0_wp, 0.7_wp, 2.0_wp, 200e-6_wp, 0.9_wp, 0.2_wp, &
         & [0.02_wp, -0.05_wp]), 60, 48)
      call against_relaxation(film_state(60.0_wp, 0.6_wp, 1.0_wp, 5e-6_wp, 0.3_wp, 0.06_wp, &
         & [-0.01_wp, 0.01_wp]), 60, 15)
      call against_relaxation(film_state(90.0_wp, 0.4_wp, 0.5_wp, 50e-6_wp, 1.5_wp, 0.5_wp, &
         & [0.1_wp, -0.1_wp], 0.5_wp), 60, 15)
      call against_relaxation(film_state(20.0_wp, 0.3_wp, 0.25_wp, 20e-6_wp, 1.3_wp, 0.7_wp, supply=0.5_wp), 60, 15)
   end subroutine reference_is_right

   !> Finite volumes are of second order, so halving the cells leaves a quarter of the error (3.7 to 4.3 asks
   !> for grids fine enough for that), and (4 fine - coarse)/3 is of the fourth: of its change from the first
   !> two grids to the last two a fifteenth is left; a quarter is allowed. Where the supply pressure jumps to
   !> the sides' at the corners, h**2 log(h) remains: of it the same change leaves a third; a half is allowed.
   !> To it comes what is left of the modes' error, a quarter at most of what it changes with half as many.
   !> What is allowed must itself be far below the error that this reference is to measure.
   subroutine against_relaxation(state, columns, rows)
      type(film_state), intent(in) :: state
      integer, intent(in) :: columns, rows
      type(pad_gap_type) :: film
      type(sor_film_type) :: solver
      type(film_response) :: r
      real(wp) :: grids(2, 0:2), extrapolated(2, 2), reference(2), ratio, allowed
      character(len=:), allocatable :: what
      integer :: k
      film = supplied(state)
      r = answer(film, motion(state), fine_cells, fine_modes)
      reference = r%force
      do k = 0, 2
         solver = new_sor_film([film], sor_options(columns*2**k, rows*2**k, tolerance=1e-11_wp, max_sweeps=100000, &
            & cavitation=cavitation_none))
         call solver%evaluate_pad(1, motion(state), speed, .false., r)
         call expect(r%status == film_ok, 'over-relaxation converges')
         grids(:, k) = r%force
      end do
      extrapolated = (4*grids(:, 1:2) - grids(:, 0:1))/3
      ratio = norm2(grids(:, 1) - grids(:, 0))/norm2(grids(:, 2) - grids(:, 1))
      r = answer(film, motion(state), fine_cells/2, fine_modes/2)
      allowed = (norm2(extrapolated(:, 2) - extrapolated(:, 1))*merge(0.5_wp, 0.25_wp, state%supply > 0) &
         & + 0.25_wp*norm2(r%force - reference))/norm2(reference)
      what = ', '//shown(state)
      call expect_close(ratio, 4.0_wp, 0.3_wp, 'second order'//what)
      call expect(allowed < 0.3_wp*tolerance, 'extrapolation has converged'//what)
      call expect_close(norm2(reference - extrapolated(:, 2))/norm2(reference), 0.0_wp, allowed, &
         & 'the reference against over-relaxation'//what)
   end subroutine against_relaxation

   !> Compares one state. The error is over the force, but where tension and pressure cancel and leave little
   !> of it: over a tenth of the highest pressure (or tension) on the whole pad, of which a force that does
   !> not cancel is a sixth to a half.
   subroutine compare(state)
      type(film_state), intent(in) :: state
      type(pad_gap_type) :: film
      type(film_motion) :: at
      type(film_response) :: r, reference
      real(wp) :: scale, error, slenderness
      integer :: i, cells, modes
      if (.not. asked_for(state)) return
      film = supplied(state)
      cells = enough_cells([film])
      modes = enough_modes([film])
      at = motion(state)
      r = answer(film, at, cells, modes, tolerance)
      reference = answer(film, at, fine_cells, fine_modes)
      scale = 0.1_wp*max(reference%max_pressure, -reference%min_pressure)*film%arc()*film%pad_radius() &
         & *film%axial_length
      scale = max(scale, norm2(reference%force))
      error = norm2(r%force - reference%force)/scale
      slenderness = film%axial_length/(film%arc()*film%pad_radius())
      i = merge(1, 0, any(abs(state%velocity) > 0)) + merge(2, 0, state%supply > 0) + 1
      associate (group => worst(count(slenderness > shapes(:2)), i))
         group%states = group%states + 1
         if (error > tolerance) group%above = group%above + 1
         if (error <= group%error) return
         group%error = error
         group%state = state
         r = answer(film, at, fine_cells, modes)
         group%by_modes = norm2(r%force - reference%force)/scale
         r = answer(film, at, cells, fine_modes)
         group%by_cells = norm2(r%force - reference%force)/scale
      end associate
   end subroutine compare

   !> The corners of the range, as far as they are asked for.
   subroutine extremes()
      real(wp), parameter :: arcs(3) = [20.0_wp, 60.0_wp, 120.0_wp], lengths(3) = [0.25_wp, 0.7_wp, 2.0_wp]
      real(wp), parameter :: pivots(2) = [0.3_wp, 0.7_wp], clearances(2) = [5e-6_wp, 200e-6_wp]
      !> Film thickness at the leading and trailing edge.
      real(wp), parameter :: edges(2, 7) = reshape([0.25_wp, 0.05_wp, 0.9_wp, 0.2_wp, 0.2_wp, 0.9_wp, &
         & 0.6_wp, 0.6_wp, 0.8_wp, 0.4_wp, 2.0_wp, 0.45_wp, 2.0_wp, 2.0_wp], [2, 7])
      type(film_state) :: state
      integer :: i, j, k, m
      do i = 1, size(arcs)
         do j = 1, size(lengths)
            do k = 1, size(edges, 2)
               do m = 1, 4
                  state = film_state(arcs(i), pivots(1 + mod(j + k, 2)), lengths(j), clearances(1 + mod(j + m, 2)), &
                     & edges(1, k), edges(2, k))
                  if (mod(m, 2) == 0) state%velocity = 0.2_wp*minval(edges(:, k))*[0.5_wp, 1.0_wp]*(m - 3)
                  if (m > 2) state%supply = 0.5_wp
                  call compare(state)
               end do
            end do
         end do
      end do
   end subroutine extremes

   !> Anywhere in the range; the same numbers in every run.
   subroutine between_extremes()
      type(film_state) :: state
      real(wp) :: u(10)
      integer :: i
      do i = 1, 2400
         call random_number(u)
         state = film_state(20 + 100*u(1), 0.3_wp + 0.4_wp*u(2), 0.25_wp*8**u(3), 5e-6_wp*40**u(4), &
            & 0.05_wp*40**u(5), 0.05_wp*40**u(6))
         if (mod(i, 2) == 0) state%velocity = 0.3_wp*min(state%leading, state%trailing)*(2*u(7:8) - 1)
         if (mod(i/2, 2) == 0) state%supply = u(9)
         call compare(state)
      end do
   end subroutine between_extremes

   function shown(state) result(text)
      type(film_state), intent(in) :: state
      character(len=:), allocatable :: text
      text = to_text(state%arc)//' degrees, pivot '//to_text(state%pivot)//', L/D ' &
         & //to_text(state%length_to_diameter)//', clearance '//to_text(state%clearance)//', film/clearance ' &
         & //to_text(state%leading)//' to '//to_text(state%trailing)//', velocity '//to_text(state%velocity(1)) &
         & //' '//to_text(state%velocity(2))//', supply '//to_text(state%supply)
   end function shown

   function described(group) result(text)
      type(worst_case), intent(in) :: group
      character(len=:), allocatable :: text
      text = to_text(group%error)//' (modes '//to_text(group%by_modes)//', cells '//to_text(group%by_cells)//'): ' &
         & //shown(group%state)
   end function described
end program test_film_accuracy
