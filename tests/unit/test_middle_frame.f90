!> The frame of a pad's middle: what a motion is there, and forces and slopes back.
program test_middle_frame
   use kinds, only: wp
   use text, only: to_text
   use film_solver, only: film_motion
   use pad_gap, only: pad_gap_type
   use unit_pad, only: new_unit_pad, thickness_scale
   use middle_frame, only: middle_frame_type, middle_motion, middle_force, new_middle_frame
   use paper_bearing, only: paper_oil, offset_pad, speed, clearance
   use check, only: runs, expect_close, between, report
   implicit none (type, external)

   type(pad_gap_type) :: gap
   type(middle_frame_type) :: frame
   integer :: trial

   gap = offset_pad()
   frame = new_middle_frame(gap, new_unit_pad(gap))
   do trial = 1, 5
      if (runs('edges')) call edges()
      if (runs('drive')) call drive()
      if (runs('force_is_turned')) call force_is_turned()
      if (runs('slopes')) call slopes()
   end do
   call report()

contains

   type(film_motion) function random_motion()
      random_motion%position = clearance*[between(-0.5_wp, 0.5_wp), between(-0.5_wp, 0.5_wp)]
      random_motion%velocity = clearance*speed*[between(-0.5_wp, 0.5_wp), between(-0.5_wp, 0.5_wp)]
   end function random_motion

   !> The film thicknesses at the edges are those of the gap.
   subroutine edges()
      type(film_motion) :: motion
      type(middle_motion) :: seen
      real(wp) :: angles(2), h(2)
      motion = random_motion()
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
      motion = random_motion()
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
      motion = random_motion()
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
end program test_middle_frame
