!> Tables of small slopes: against films with slopes that are solved closely, beside those of a march, of one pad and of
!> random ones; films without slopes, in a mirror, derivatives, no leap where the tables end; what they do not know is
!> solved.
program test_small_slopes
   use kinds, only: wp, pi
   use text, only: to_text
   use film_solver, only: film_response, cavitation_none, cavitation_gumbel, cavitation_reynolds
   use pad_gap, only: pad_gap_type
   use direct_film, only: direct_film_type, new_direct_film
   use sloped_film, only: sloped_film_type, sloped_motion, sloped_response, new_sloped_film
   use small_slopes, only: small_slopes_type, new_small_slopes
   use paper_bearing, only: paper_oil, offset_pad, clearance
   use random_films, only: film_state, random_film
   use check, only: runs, expect, between, report
   implicit none (type, external)

   !> 6500 rpm; half the width of the pad, m.
   real(wp), parameter :: speed = 6500*pi/30, half = 0.05_wp
   real(wp), parameter :: none(3) = 0, around(3) = [3e5_wp, 1e5_wp, -1e5_wp], ambient(3) = [1e5_wp, 1e5_wp, -1e5_wp], &
      & ambient_all(3) = 1e5_wp

   !> A pad's films: of a march, with tables and without, and without slopes.
   type :: pad_films
      type(small_slopes_type) :: small
      type(sloped_film_type) :: films
      type(direct_film_type) :: aligned
   end type pad_films

   if (runs('accuracy')) call accuracy('full', none, cavitation_none)
   if (runs('accuracy')) call accuracy('reynolds', none, cavitation_reynolds)
   if (runs('accuracy')) call accuracy('ambient', ambient, cavitation_none)
   if (runs('pads')) call random_pads('full', cavitation_none)
   if (runs('pads')) call random_pads('reynolds', cavitation_reynolds)
   if (runs('aligned')) call aligned(cavitation_none)
   if (runs('aligned')) call aligned(cavitation_reynolds)
   if (runs('derivatives')) call derivatives(cavitation_none, 1e-5_wp)
   ! the film without slopes leaves out small parts
   if (runs('derivatives')) call derivatives(cavitation_reynolds, 1e-3_wp)
   if (runs('mirror')) call mirror(cavitation_none)
   if (runs('mirror')) call mirror(cavitation_reynolds)
   if (runs('leaps')) call leaps(cavitation_none)
   if (runs('leaps')) call leaps(cavitation_reynolds)
   if (runs('shared')) call shared()
   if (runs('unknown')) call unknown()
   if (runs('empty')) call empty()
   call report()

contains

   type(pad_films) function new_films(gap, condition) result(pad)
      type(pad_gap_type), intent(in) :: gap
      integer, intent(in) :: condition
      pad%small = new_small_slopes([gap], condition)
      pad%films = new_sloped_film([gap], condition)
      pad%aligned = new_direct_film([gap], 48, 16, 80, 8, condition, 1e-6_wp, 2e-3_wp)
   end function new_films

   !> The film with its pressures; whether it is from the tables.
   subroutine evaluate(pad, motion, response, known)
      type(pad_films), intent(inout) :: pad
      type(sloped_motion), intent(in) :: motion
      type(sloped_response), intent(out) :: response
      logical, intent(out) :: known
      type(sloped_response) :: responses(1)
      call pad%small%evaluate_pad(1, motion, paper_oil, speed, .true., pad%films, pad%aligned, responses(1))
      known = responses(1)%lacks_pressures
      call pad%small%take_pressures([motion], [paper_oil], speed, pad%films, pad%aligned, responses)
      response = responses(1)
   end subroutine evaluate

   !> A motion with slopes of this share of those that change a film by a third.
   type(sloped_motion) function random_motion(share) result(motion)
      real(wp), intent(in) :: share
      motion%middle%position = clearance*[between(-0.5_wp, 0.4_wp), between(0.0_wp, 0.5_wp)]
      motion%middle%velocity = clearance*speed*[between(-0.1_wp, 0.1_wp), between(-0.1_wp, 0.1_wp)]
      motion%slope = share*clearance*[between(-4.0_wp, 4.0_wp), between(-4.0_wp, 4.0_wp)]
      motion%slope_rate = share*clearance*speed*[between(-2.0_wp, 2.0_wp), between(-2.0_wp, 2.0_wp)]
   end function random_motion

   !> Nine of ten films err by less than 1e-3 in force, 3e-3 in moment and 1e-2 in their highest pressure, over what
   !> such a motion makes, or little more than the film of a march that is solved.
   subroutine accuracy(name, pressures, condition)
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: pressures(3)
      integer, intent(in) :: condition
      integer, parameter :: films = 100
      type(pad_films) :: pad
      real(wp) :: error(films, 5)
      integer :: n
      logical :: known
      pad = new_films(offset_pad(pressures), condition)
      n = 1
      do while (n <= films)
         call find_errors(pad, offset_pad(pressures), condition, random_motion(between(0.0_wp, 1.0_wp)), error(n, :), &
            & known)
         if (known) n = n + 1
      end do
      call expect_small(name, error, 1e-2_wp)
      call expect(maxval(error(:, 1)) < 1e-2_wp, name//': any force '//to_text(maxval(error(:, 1))))
   end subroutine accuracy

   !> The same of pads of 20 to 120 degrees, a quarter to twice as long as wide, with films that are thin or thick, and
   !> up to ten times as thick at one place as at another. The hill of pressure of long pads is flat: 2e-2.
   subroutine random_pads(name, condition)
      character(len=*), intent(in) :: name
      integer, intent(in) :: condition
      integer, parameter :: films = 50
      type(pad_films) :: pad
      type(film_state) :: state
      type(sloped_motion) :: motion
      real(wp) :: error(films, 5)
      integer :: n
      logical :: known
      n = 1
      do while (n <= films)
         state = random_film(1.0_wp, 10.0_wp, condition == cavitation_reynolds, .false.)
         motion%middle = state%motion
         motion%slope = between(0.0_wp, 0.6_wp)*state%thinnest/state%gap%axial_length*[between(-1.0_wp, 1.0_wp), &
            & between(-1.0_wp, 1.0_wp)]
         motion%slope_rate = between(0.0_wp, 0.3_wp)*speed*motion%slope
         pad = new_films(state%gap, condition)
         call find_errors(pad, state%gap, condition, motion, error(n, :), known)
         if (known) n = n + 1
      end do
      call expect_small(name, error, 2e-2_wp)
   end subroutine random_pads

   !> Errors of force, moment and highest pressure of a film from tables against a closely solved one, and of force and
   !> moment of that of a march that is solved; `known`: the tables know it, and something of it is left.
   subroutine find_errors(pad, gap, condition, motion, error, known)
      type(pad_films), intent(inout) :: pad
      type(pad_gap_type), intent(in) :: gap
      integer, intent(in) :: condition
      type(sloped_motion), intent(in) :: motion
      real(wp), intent(out) :: error(5)
      logical, intent(out) :: known
      type(sloped_film_type) :: closely, march
      type(sloped_response) :: found, close, solved
      call evaluate(pad, motion, found, known)
      if (.not. known) return
      closely = new_sloped_film([gap], condition, .true.)
      march = new_sloped_film([gap], condition)
      call closely%evaluate_pad(1, motion, paper_oil, speed, .true., close)
      known = norm2(close%film%force) > 0
      if (.not. known) return
      call march%evaluate_pad(1, motion, paper_oil, speed, .false., solved)
      associate (scale => scales(gap, motion, close))
         error = [norm2(found%film%force - close%film%force)/scale(1), norm2(found%moment - close%moment)/scale(2), &
            & abs(found%film%max_pressure - close%film%max_pressure)/scale(3), &
            & norm2(solved%film%force - close%film%force)/scale(1), norm2(solved%moment - close%moment)/scale(2)]
      end associate
   end subroutine find_errors

   !> Nine of ten errors are small, those of the highest pressure below this.
   subroutine expect_small(name, error, pressure)
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: error(:, :), pressure
      integer :: k
      associate (nine => [(nine_tenths(error(:, k)), k=1, 5)])
         call expect(nine(1) < 1e-3_wp + nine(4), name//': force '//to_text(nine(1))//' '//to_text(nine(4)))
         call expect(nine(2) < 3e-3_wp + nine(5), name//': moment '//to_text(nine(2))//' '//to_text(nine(5)))
         call expect(nine(3) < pressure, name//': highest pressure '//to_text(nine(3)))
      end associate
   end subroutine expect_small

   !> Force, moment and pressure over which films are measured: their own, or, where these vanish, those that a third of
   !> the motion makes by damping and stiffness.
   pure function scales(gap, motion, film) result(scale)
      type(pad_gap_type), intent(in) :: gap
      type(sloped_motion), intent(in) :: motion
      type(sloped_response), intent(in) :: film
      real(wp) :: scale(3)
      associate (e => motion%middle%position, g => motion%slope, d => film%derivatives)
         associate (w => norm2(motion%middle%velocity + 0.5_wp*speed*[e(2), -e(1)]), &
            & v => norm2(motion%slope_rate + 0.5_wp*speed*[g(2), -g(1)]))
            scale(1) = max(norm2(film%film%force), 0.3_wp*norm2(d(:2, 5:6))*w)
            scale(2) = max(norm2(film%moment), 0.3_wp*norm2(d(3:, 3:4))*norm2(g), 0.3_wp*norm2(d(3:, 7:8))*v)
         end associate
      end associate
      ! a hill of pressure is twice its mean
      scale(3) = max(film%film%max_pressure, 2*scale(1)/(gap%axial_length*gap%pad_radius()*gap%arc()))
   end function scales

   !> The value that nine of ten do not exceed.
   pure real(wp) function nine_tenths(values)
      real(wp), intent(in) :: values(:)
      integer :: i
      nine_tenths = 0
      do i = 1, size(values)
         if (10*count(values > values(i)) <= size(values)) cycle
         nine_tenths = max(nine_tenths, values(i))
      end do
   end function nine_tenths

   !> Without slopes it is the film without, to the last bit, and no moment.
   subroutine aligned(condition)
      integer, intent(in) :: condition
      type(pad_films) :: pad
      type(sloped_response) :: r
      type(film_response) :: f
      type(sloped_motion) :: motion
      integer :: trial
      logical :: known
      pad = new_films(offset_pad(), condition)
      do trial = 1, 5
         motion%middle%position = clearance*[between(-0.4_wp, 0.0_wp), between(0.3_wp, 0.5_wp)]
         call evaluate(pad, motion, r, known)
         call expect(known, 'the tables know it')
         call pad%aligned%evaluate_pad(1, motion%middle, paper_oil, speed, .true., f)
         call expect(all(abs(r%film%force - f%force) <= 0) .and. all(abs(r%moment) <= 0) &
            & .and. all(abs(r%derivatives(:2, [1, 2, 5, 6]) - f%derivatives) <= 0), 'without slopes')
         call expect(abs(r%film%max_pressure - f%max_pressure) <= 0 .and. abs(r%place(2)) <= 1e-12_wp*half, &
            & 'its pressure')
      end do
   end subroutine aligned

   !> Derivatives are slopes.
   subroutine derivatives(condition, tolerance)
      integer, intent(in) :: condition
      real(wp), intent(in) :: tolerance
      type(pad_films) :: pad
      type(sloped_response) :: r, low, high
      type(sloped_motion) :: motion
      real(wp) :: step(8), error
      integer :: k
      logical :: known
      pad = new_films(offset_pad(), condition)
      motion%middle%position = [-26e-6_wp, 52e-6_wp]
      motion%middle%velocity = clearance*speed*[0.03_wp, -0.05_wp]
      motion%slope = [20e-6_wp, 60e-6_wp]
      motion%slope_rate = clearance*speed*[0.1_wp, -0.06_wp]
      step = 1e-6_wp*clearance*[1.0_wp, 1.0_wp, 20.0_wp, 20.0_wp, speed, speed, 20*speed, 20*speed]
      call evaluate(pad, motion, r, known)
      call expect(known, 'the tables know it')
      error = 0
      do k = 1, 8
         call evaluate(pad, motion%moved(k, step(k)), high, known)
         call evaluate(pad, motion%moved(k, -step(k)), low, known)
         associate (found => [high%film%force - low%film%force, high%moment - low%moment]/2)
            error = max(error, maxval(abs(found - r%derivatives(:, k)*step(k))/matmul(abs(r%derivatives), step)))
         end associate
      end do
      call expect(error < tolerance, 'derivatives '//to_text(error))
   end subroutine derivatives

   !> Seen along the other direction of the shaft moments and slopes change their signs, to the last bit.
   subroutine mirror(condition)
      integer, intent(in) :: condition
      type(pad_films) :: pad
      type(sloped_response) :: a, b
      type(sloped_motion) :: motion
      integer :: trial
      logical :: known
      pad = new_films(offset_pad(), condition)
      do trial = 1, 5
         motion = random_motion(0.2_wp)
         call evaluate(pad, motion, a, known)
         call evaluate(pad, sloped_motion(motion%middle, -motion%slope, -motion%slope_rate), b, known)
         if (.not. known) cycle
         call expect(all(abs(a%film%force - b%film%force) <= 0) .and. all(abs(a%moment + b%moment) <= 0) &
            & .and. abs(a%place(2) + b%place(2)) <= 0, 'mirror')
      end do
   end subroutine mirror

   !> As a slope grows beyond what the tables know the force does not leap: between 400 states its second differences
   !> are small.
   subroutine leaps(condition)
      integer, intent(in) :: condition
      integer, parameter :: states = 400
      type(pad_films) :: pad
      type(sloped_response) :: r
      type(sloped_motion) :: motion
      real(wp) :: load(4, states), scale
      integer :: i, from_tables
      logical :: known
      pad = new_films(offset_pad(), condition)
      motion%middle%position = [-26e-6_wp, 40e-6_wp]
      from_tables = 0
      do i = 1, states
         motion%slope = [150e-6_wp, 400e-6_wp]*i/states
         call evaluate(pad, motion, r, known)
         load(:, i) = [r%film%force, r%moment/half]
         from_tables = from_tables + merge(1, 0, known)
      end do
      call expect(from_tables > states/4 .and. from_tables < 3*states/4, 'both kinds of films '//to_text(from_tables))
      scale = maxval(abs(load))
      associate (bend => load(:, 3:) - 2*load(:, 2:states - 1) + load(:, :states - 2))
         call expect(maxval(abs(bend)) < 1e-4_wp*scale, 'leaps '//to_text(maxval(abs(bend))/scale))
      end associate
   end subroutine leaps

   !> Equal pads share cells; a cell is the same whatever came before.
   subroutine shared()
      type(pad_films) :: pad, again
      type(sloped_response) :: r, first
      type(sloped_motion) :: motion
      integer :: i
      pad = new_films(offset_pad(), cavitation_reynolds)
      pad%small = new_small_slopes([offset_pad(), offset_pad()], cavitation_reynolds)
      pad%films = new_sloped_film([offset_pad(), offset_pad()], cavitation_reynolds)
      pad%aligned = new_direct_film([offset_pad(), offset_pad()], 48, 16, 80, 8, cavitation_reynolds, 1e-6_wp, 2e-3_wp)
      again = pad
      motion%middle%position = [-26e-6_wp, 52e-6_wp]
      motion%slope = [20e-6_wp, 60e-6_wp]
      do i = 1, 2
         call pad%small%evaluate_pad(i, motion, paper_oil, speed, .false., pad%films, pad%aligned, r)
         if (i == 1) first = r
      end do
      call expect(pad%films%counters%cells == 1 .and. all(abs(r%moment - first%moment) <= 0), 'one cell for both pads')
      motion%middle%position = [-46e-6_wp, 52e-6_wp]
      call again%small%evaluate_pad(2, motion, paper_oil, speed, .false., again%films, again%aligned, r)
      motion%middle%position = [-26e-6_wp, 52e-6_wp]
      call again%small%evaluate_pad(2, motion, paper_oil, speed, .false., again%films, again%aligned, r)
      call expect(all(abs(r%moment - first%moment) <= 0), 'the same cell')
   end subroutine shared

   !> Of a film that diverges everywhere nothing is left.
   subroutine empty()
      type(pad_films) :: pad
      type(sloped_motion) :: motion
      type(sloped_response) :: r
      logical :: known
      pad = new_films(offset_pad(ambient_all), cavitation_reynolds)
      motion%middle%position = [-10e-6_wp, 20e-6_wp]
      motion%middle%velocity = [0.0_wp, -clearance*speed]
      motion%slope = [20e-6_wp, 60e-6_wp]
      call evaluate(pad, motion, r, known)
      call expect(known .and. all(abs(r%moment) <= 0) .and. all(abs(r%derivatives) <= 0), 'no moment')
      call expect(abs(r%film%max_pressure - ambient_all(1)) <= 0, 'the pressure around it')
   end subroutine empty

   !> Films that cavitate by Guembel's condition or are fed, and slopes that are not small, are solved.
   subroutine unknown()
      call is_solved('gumbel', none, cavitation_gumbel, 60e-6_wp)
      call is_solved('supply', around, cavitation_none, 60e-6_wp)
      call is_solved('other pressures', ambient, cavitation_reynolds, 60e-6_wp)
      call is_solved('large', none, cavitation_none, 300e-6_wp)
   end subroutine unknown

   subroutine is_solved(name, pressures, condition, slope)
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: pressures(3), slope
      integer, intent(in) :: condition
      type(pad_films) :: pad
      type(sloped_film_type) :: films
      type(sloped_motion) :: motion
      type(sloped_response) :: r, solved
      logical :: known
      pad = new_films(offset_pad(pressures), condition)
      films = new_sloped_film([offset_pad(pressures)], condition)
      motion%middle%position = [-26e-6_wp, 52e-6_wp]
      motion%slope = [20e-6_wp, slope]
      call evaluate(pad, motion, r, known)
      call films%evaluate_pad(1, motion, paper_oil, speed, .true., solved)
      call expect(.not. known .and. all(abs(r%film%force - solved%film%force) <= 0) &
         & .and. all(abs(r%moment - solved%moment) <= 0), name)
   end subroutine is_solved
end program test_small_slopes
