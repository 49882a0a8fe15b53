!> The gap under a pad, and motions seen from the middle of its arc.
program test_pad_gap
   use kinds, only: wp, pi, degree
   use text, only: to_text
   use film_solver, only: film_motion
   use pad_gap, only: pad_gap_type
   use paper_bearing, only: paper_pad, clearance, paper_oil, offset_pad, speed
   use dimensionless_pad, only: new_dimensionless_pad, thickness_scale, mid_arc_frame_type, middle_motion, &
      & middle_force, new_mid_arc_frame
   use check, only: runs, expect, expect_close, between, report
   implicit none (type, external)
   type(pad_gap_type) :: gap
   type(mid_arc_frame_type) :: frame
   integer :: trial

   if (runs('sizes')) call sizes()
   if (runs('known_thickness')) call known_thickness()
   if (runs('thickness_against_circles')) call thickness_against_circles()
   if (runs('least_against_scan')) then
      call least_against_scan(34.65_wp, 34.65_wp)
      call least_against_scan(50.0_wp, 20.0_wp)
      call least_against_scan(5.0_wp, 60.0_wp)
      call least_against_scan(170.0_wp, 120.0_wp)
   end if
   gap = offset_pad()
   frame = new_mid_arc_frame(gap, new_dimensionless_pad(gap))
   do trial = 1, 5
      if (runs('edges')) call edges()
      if (runs('drive')) call drive()
      if (runs('force_is_turned')) call force_is_turned()
      if (runs('slopes')) call slopes()
   end do
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
         & 'a centred journal leaves the pad clearance')
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

   type(film_motion) function random_motion_frame()
      random_motion_frame%position = clearance*[between(-0.5_wp, 0.5_wp), between(-0.5_wp, 0.5_wp)]
      random_motion_frame%velocity = clearance*speed*[between(-0.5_wp, 0.5_wp), between(-0.5_wp, 0.5_wp)]
   end function random_motion_frame

   !> The film thicknesses at the edges are those of the gap.
   subroutine edges()
      type(film_motion) :: motion
      type(middle_motion) :: seen
      real(wp) :: angles(2), h(2)
      motion = random_motion_frame()
      seen = frame%motion(motion, paper_oil, speed)
      angles = [gap%leading_angle, -gap%trailing_angle]
      h = gap%thickness(motion, sin(angles), cos(angles))/clearance
      call expect_close(seen%edges(1), h(1), 1e-13_wp, 'leading edge')
      call expect_close(seen%edges(2), h(2), 1e-13_wp, 'trailing edge')
      call expect_close(seen%scale, paper_oil%viscosity*gap%pad_radius()**4/clearance**3*thickness_scale(h(1), h(2)), &
         & 1e-12_wp*seen%scale, 'scale')
   end subroutine edges

   !> At every angle of the pad w does what wedge and squeeze do: the right-hand side of Reynolds' equation,
   !> 6 mu omega R_J R dh/dphi + 12 mu R^2 dh/dt, is -12 mu R^2 (w_1 sin + w_2 cos) of the angle from the middle; phi
   !> rises against the motion of the journal.
   subroutine drive()
      type(film_motion) :: motion
      type(middle_motion) :: seen
      real(wp) :: phi, from_middle, wedge, squeeze
      integer :: i
      motion = random_motion_frame()
      seen = frame%motion(motion, paper_oil, speed)
      do i = 0, 4
         phi = -gap%trailing_angle + i*gap%arc()/4
         from_middle = phi - 0.5_wp*(gap%leading_angle - gap%trailing_angle)
         squeeze = dot_product(motion%velocity, [sin(phi), cos(phi)])
         wedge = speed*gap%journal_radius/(2*gap%pad_radius())*dot_product(motion%position, [-cos(phi), sin(phi)])
         call expect_close(dot_product(seen%w, [sin(from_middle), cos(from_middle)]), squeeze + wedge, &
            & 1e-12_wp*norm2(seen%w), 'at part '//to_text(i)//' of the arc')
      end do
   end subroutine drive

   !> A force along the middle's outward direction points there in the pad's frame.
   subroutine force_is_turned()
      type(middle_force) :: seen
      real(wp) :: middle, force(2)
      middle = 0.5_wp*(gap%leading_angle - gap%trailing_angle)
      seen = middle_force([between(-1.0_wp, 1.0_wp), between(-1.0_wp, 1.0_wp)], 0, 0)
      force = frame%force(seen)
      call expect_close(dot_product(force, [sin(middle), cos(middle)]), seen%value(2), 1e-14_wp, 'outward')
      call expect_close(dot_product(force, [cos(middle), -sin(middle)]), seen%value(1), 1e-14_wp, 'along the arc')
   end subroutine force_is_turned

   !> A force that is any smooth function of edges and w: slopes in the pad's frame against differences, whose error is
   !> of the second order in a step of 1e-5.
   subroutine slopes()
      type(film_motion) :: motion, ahead, back
      real(wp) :: derivatives(2, 4), shift(4), difference(2), step
      integer :: k
      motion = random_motion_frame()
      associate (seen => frame%motion(motion, paper_oil, speed))
         derivatives = frame%derivatives(seen, any_force(seen))
      end associate
      do k = 1, 4
         step = 1e-5_wp*clearance*merge(1.0_wp, speed, k <= 2)
         shift = 0
         shift(k) = step
         ahead = film_motion(motion%position + shift(:2), motion%velocity + shift(3:))
         back = film_motion(motion%position - shift(:2), motion%velocity - shift(3:))
         difference = (frame%force(any_force(frame%motion(ahead, paper_oil, speed))) &
            & - frame%force(any_force(frame%motion(back, paper_oil, speed))))/(2*step)
         call expect_close(norm2(derivatives(:, k) - difference), 0.0_wp, 1e-8_wp*norm2(derivatives), &
            & 'slope '//to_text(k))
      end do
   end subroutine slopes

   pure type(middle_force) function any_force(seen) result(force)
      type(middle_motion), intent(in) :: seen
      real(wp), parameter :: unit = clearance*speed
      associate (h => seen%edges, w => seen%w/unit)
         force%value = [h(1)**2*w(1) + h(2)*w(2), h(1)*h(2)*w(2) - h(2)**2*w(1)]
         force%over_edges = reshape([2*h(1)*w(1), h(2)*w(2), w(2), h(1)*w(2) - 2*h(2)*w(1)], [2, 2])
         force%over_w = reshape([h(1)**2, -h(2)**2, h(2), h(1)*h(2)], [2, 2])/unit
      end associate
   end function any_force
end program test_pad_gap
