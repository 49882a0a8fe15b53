!> Cavitated films on film-adapted grids: the error that they tell of themselves, against much finer ones;
!> when they are refined and when refused; pads that no table knows.
program test_following_film
   use kinds, only: wp, degree
   use text, only: to_text
   use film_solver, only: film_motion, film_response, film_counters, film_ok, film_not_resolved
   use pad_gap, only: pad_gap_type
   use following_film, only: following_film_type, new_following_film, new_following_grid
   use elimination_film, only: elimination_film_type
   use table_film, only: has_tables
   use paper_bearing, only: paper_oil, speed
   use check, only: runs, expect, expect_close, report
   implicit none (type, external)

   real(wp), parameter :: radius = 50e-3_wp, clearance = 50e-6_wp

   if (runs('promise')) call promise()
   if (runs('refusal')) call refusal()
   if (runs('half_circle')) call half_circle()
   call report()

contains

   !> A pad of an arc, in degrees, with a length over its diameter.
   pure type(pad_gap_type) function pad_of(arc, length_ratio) result(gap)
      real(wp), intent(in) :: arc, length_ratio
      gap = pad_gap_type(radius, clearance, 2*radius*length_ratio, 0.5_wp*arc*degree, 0.5_wp*arc*degree, 0.0_wp, &
         & 0.0_wp, 0.0_wp)
   end function pad_of

   !> The journal without velocity, off the middle by a part of the clearance, towards an angle from the pivot, degrees.
   pure type(film_motion) function at(eccentricity, angle) result(motion)
      real(wp), intent(in) :: eccentricity, angle
      motion = film_motion(eccentricity*clearance*[sin(angle*degree), cos(angle*degree)], [0.0_wp, 0.0_wp])
   end function at

   !> Force and derivatives err by the tolerance at most, whatever the eccentricity, against an extrapolation from grids
   !> of 32 and 64 rows, whose own error is a seventh of that from 12 and 24 at most, as it is of second order at least.
   subroutine promise()
      real(wp), parameter :: tolerance = 2e-3_wp
      call expect_promise(pad_of(100.0_wp, 0.5_wp), at(0.6_wp, -10.0_wp), tolerance)
      call expect_promise(pad_of(160.0_wp, 0.5_wp), at(0.9985_wp, -3.0_wp), tolerance)
      ! three grids up to 24 rows tell an error above the tolerance here
      call expect_promise(pad_of(308.0_wp, 1.2_wp), at(0.9995_wp, -113.0_wp), tolerance)
   end subroutine promise

   subroutine expect_promise(gap, motion, tolerance)
      type(pad_gap_type), intent(in) :: gap
      type(film_motion), intent(in) :: motion
      real(wp), intent(in) :: tolerance
      type(following_film_type) :: film
      type(film_counters) :: counters
      type(film_response) :: found, whole, grids(2)
      type(elimination_film_type) :: grid
      real(wp) :: force(2), slopes(2, 4)
      integer :: k
      character(len=:), allocatable :: what
      film = new_following_film(gap, tolerance)
      call film%evaluate(motion, paper_oil, speed, .true., counters, found, whole)
      what = to_text(gap%arc()/degree)//' degrees, '//to_text(norm2(motion%position)/clearance)
      call expect(found%status == film_ok, 'resolved, '//what)
      do k = 1, 2
         grid = new_following_grid(gap, motion, speed, 32*k)
         grid%ends_between = .true.
         call grid%evaluate(motion, paper_oil, speed, .true., .true., counters, grids(k))
      end do
      force = (4*grids(2)%force - grids(1)%force)/3
      slopes = (4*grids(2)%derivatives - grids(1)%derivatives)/3
      call expect(norm2(found%force - force) < tolerance*max(norm2(force), norm2(whole%force)), 'force, '//what)
      call expect(norm2(found%derivatives(:, :2) - slopes(:, :2)) < tolerance*max(norm2(slopes(:, :2)), &
         & norm2(whole%derivatives(:, :2))), 'slopes over the position, '//what)
      call expect(norm2(found%derivatives(:, 3:) - slopes(:, 3:)) < tolerance*max(norm2(slopes(:, 3:)), &
         & norm2(whole%derivatives(:, 3:))), 'slopes over the velocity, '//what)
   end subroutine expect_promise

   !> What the finest grids do not reach is refused with the error that is left; without derivatives nothing is asked,
   !> and `forget` leads back to the same answer to the last bit.
   subroutine refusal()
      type(following_film_type) :: film
      type(film_counters) :: counters
      type(film_response) :: first, refused, again, whole
      associate (gap => pad_of(100.0_wp, 0.5_wp), motion => at(0.9_wp, -42.0_wp))
         film = new_following_film(gap, 1e-9_wp)
         call film%evaluate(motion, paper_oil, speed, .false., counters, first, whole)
         call expect(first%status == film_ok, 'a force')
         call film%evaluate(motion, paper_oil, speed, .true., counters, refused, whole)
         call expect(refused%status == film_not_resolved .and. refused%residual > 1e-9_wp, 'not resolved')
         call expect(refused%residual < 2e-3_wp, 'by this error: '//to_text(refused%residual))
         call film%forget()
         call film%evaluate(motion, paper_oil, speed, .false., counters, again, whole)
         call expect(.not. any(abs(again%force - first%force) > 0), 'the same again')
      end associate
   end subroutine refusal

   !> The film in half a circle, whose edges have a mean thickness that tells nothing of the journal's position, is the
   !> mean of those in a little less and a little more, but for the second order of the difference.
   subroutine half_circle()
      type(following_film_type) :: film
      type(film_counters) :: counters
      type(film_response) :: found(-1:1), whole
      integer :: k
      do k = -1, 1
         associate (gap => pad_of(180.0_wp + 0.1_wp*k, 0.5_wp))
            call expect(.not. has_tables(gap), 'no table')
            film = new_following_film(gap, 1e-3_wp)
            call film%evaluate(at(0.8_wp, -20.0_wp), paper_oil, speed, .false., counters, found(k), whole)
            call expect(found(k)%status == film_ok, 'a film')
         end associate
      end do
      call expect_close(norm2(found(0)%force - 0.5_wp*(found(-1)%force + found(1)%force)), 0.0_wp, &
         & 1e-5_wp*norm2(found(0)%force), 'between')
   end subroutine half_circle
end program test_following_film
