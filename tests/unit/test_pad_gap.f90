!> The gap of a pad: thickness against exact circles, minimum thickness against a scan.
program test_pad_gap
   use kinds, only: wp, pi, degree
   use text, only: to_text
   use film_solver, only: film_motion
   use pad_gap, only: pad_gap_type
   use paper_bearing, only: paper_pad, clearance
   use check, only: runs, expect, expect_close, between, report
   implicit none (type, external)

   if (runs('sizes')) call sizes()
   if (runs('known_thickness')) call known_thickness()
   if (runs('thickness_against_circles')) call thickness_against_circles()
   if (runs('least_against_scan')) then
      call least_against_scan(34.65_wp, 34.65_wp)
      call least_against_scan(50.0_wp, 20.0_wp)
      call least_against_scan(5.0_wp, 60.0_wp)
      call least_against_scan(170.0_wp, 120.0_wp)
   end if
   call report()

contains

   !> The paper's pad with a leading and a trailing angle in degrees.
   pure type(pad_gap_type) function pad(leading, trailing)
      real(wp), intent(in) :: leading, trailing
      pad = paper_pad()
      pad%leading_angle = leading*degree
      pad%trailing_angle = trailing*degree
   end function pad

   subroutine sizes()
      type(pad_gap_type) :: film
      film = pad(50.0_wp, 20.0_wp)
      call expect_close(film%pad_radius(), 50e-3_wp, 1e-17_wp, 'bore radius')
      call expect_close(film%arc(), 70*degree, 4*epsilon(1.0_wp), 'arc')
   end subroutine sizes

   subroutine known_thickness()
      type(pad_gap_type) :: film
      film = pad(50.0_wp, 20.0_wp)
      call expect_close(film%thickness(film_motion([0.0_wp, 0.0_wp]), 0.6_wp, 0.8_wp), clearance, 0.0_wp, &
         & 'a centred journal leaves the machined clearance')
      call expect_close(film%thickness(film_motion([10e-6_wp, 0.0_wp]), 0.6_wp, 0.8_wp), 94e-6_wp, 1e-18_wp, &
         & 'towards y'' thins the leading half')
      call expect_close(film%thickness(film_motion([0.0_wp, 10e-6_wp]), -0.6_wp, 0.8_wp), 92e-6_wp, 1e-18_wp, &
         & 'towards z'' thins the film')
   end subroutine known_thickness

   !> The true gap along the radius of the pad, between circles of radius R and R_J with centres e apart,
   !> is larger by no more than e**2/(2 R_J) (1 + e/R_J): the next term of its series.
   subroutine thickness_against_circles()
      type(pad_gap_type) :: film
      type(film_motion) :: motion
      real(wp) :: phi, along, across, gap, worst, e
      integer :: i
      film = pad(50.0_wp, 20.0_wp)
      worst = 0
      do i = 1, 1000
         motion = random_motion()
         e = norm2(motion%position)
         phi = between(-film%trailing_angle, film%leading_angle)
         along = motion%position(1)*sin(phi) + motion%position(2)*cos(phi)
         across = motion%position(1)*cos(phi) - motion%position(2)*sin(phi)
         gap = film%pad_radius() - along - sqrt(film%journal_radius**2 - across**2)
         worst = max(worst, abs(gap - film%thickness(motion, sin(phi), cos(phi))) &
            & /(0.5_wp*e**2/film%journal_radius + 100*epsilon(e)*film%journal_radius))
      end do
      call expect(worst < 1.01_wp, 'thickness against circles, in units of e**2/(2 R_J): '//to_text(worst))
   end subroutine thickness_against_circles

   !> A scan with a step d misses a minimum inside the arc by at most e d**2/8, and none at an edge.
   subroutine least_against_scan(leading, trailing)
      real(wp), intent(in) :: leading, trailing
      integer, parameter :: n = 2000
      type(pad_gap_type) :: film
      type(film_motion) :: motion
      real(wp) :: phi(0:n), least, scanned, miss, worst_above, worst_below
      integer :: i, inside
      film = pad(leading, trailing)
      phi = [(-film%trailing_angle + film%arc()*i/n, i=0, n)]
      worst_above = 0
      worst_below = 0
      inside = 0
      do i = 1, 300
         motion = random_motion()
         least = film%min_film_thickness(motion, film%directions())
         scanned = minval(film%thickness(motion, sin(phi), cos(phi)))
         miss = norm2(motion%position)*(film%arc()/n)**2/8
         worst_above = max(worst_above, (least - scanned)/clearance)
         worst_below = max(worst_below, (scanned - least - miss)/clearance)
         if (scanned < min(film%thickness(motion, sin(phi(0)), cos(phi(0))), &
            & film%thickness(motion, sin(phi(n)), cos(phi(n))))) inside = inside + 1
      end do
      call expect(inside > 5 .and. inside < 295, 'minima inside and at edges are both met')
      call expect(worst_above < 100*epsilon(least), 'the minimum thickness is no more than the scan''s, arc ' &
         & //to_text(leading)//' + '//to_text(trailing)//' deg: '//to_text(worst_above))
      call expect(worst_below < 100*epsilon(least), 'the minimum thickness is met by the scan, arc ' &
         & //to_text(leading)//' + '//to_text(trailing)//' deg: '//to_text(worst_below))
   end subroutine least_against_scan

   !> Any direction, up to beyond the clearance.
   type(film_motion) function random_motion()
      real(wp) :: e, angle
      e = between(0.0_wp, 1.2_wp*clearance)
      angle = between(-pi, pi)
      random_motion%position = e*[sin(angle), cos(angle)]
   end function random_motion
end program test_pad_gap
