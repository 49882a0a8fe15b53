!> Places and velocities of journal and pads, and the operating point. Slopes are for test_tilting_pad_bearing.
program test_kinematics
   use kinds, only: wp, degree, pi
   use text, only: to_text
   use film_solver, only: film_motion
   use pad_gap, only: pad_gap_type
   use rigid_rotor, only: journal_motion
   use state_layout, only: pad_state
   use kinematics, only: pad_position, frame_of, motion_of
   use paper_bearing, only: offset_pad
   use case_inputs, only: case_type
   use operating_point, only: operating_point_type
   use check, only: runs, expect, expect_close, report
   implicit none (type, external)
   !> The paper's bearing: R_J, c_m, c_r, kappa, m.
   real(wp), parameter :: journal_radius = 49.9e-3_wp, c_m = 100e-6_wp, c_r = 80e-6_wp, kappa = 14e-3_wp
   real(wp), parameter :: angles(*) = [-45.0_wp, 225.0_wp, 10.0_wp, 90.0_wp, 137.0_wp]
   integer :: i

   do i = 1, size(angles)
      if (runs('against_geometry')) call against_geometry(place_at(angles(i)))
      if (runs('rates')) call rates(place_at(angles(i)))
      if (runs('directions')) call directions(place_at(angles(i)))
   end do
   if (runs('points')) call points()
   call report()

contains

   pure type(pad_position) function place_at(angle_deg)
      real(wp), intent(in) :: angle_deg
      place_at%angle = angle_deg*degree
      place_at%sin_angle = sin(place_at%angle)
      place_at%cos_angle = cos(place_at%angle)
      place_at%pivot_radius = journal_radius + c_r + kappa
      place_at%centre_distance = journal_radius + c_m + kappa
   end function place_at

   pure type(pad_gap_type) function film()
      film = offset_pad()
   end function film

   !> Film thickness at angle phi from the pivot, with everything at rest.
   pure real(wp) function thickness(place, journal, tilt, pivot_deflection, phi)
      type(pad_position), intent(in) :: place
      real(wp), intent(in) :: journal(2), tilt, pivot_deflection, phi
      type(pad_gap_type) :: gap
      gap = film()
      associate (still => journal_motion(journal), pad => pad_state(tilt, deflection=pivot_deflection))
         thickness = gap%thickness(motion_of(place, frame_of(place, still, pad), still, pad), sin(phi), cos(phi))
      end associate
   end function thickness

   !> Rounding of differences of lengths of 0.1 m.
   pure real(wp) function rounding()
      rounding = 20*epsilon(1.0_wp)*0.1_wp
   end function rounding

   !> Of the frame of a pad, at tilts below and above the one up to which series serve.
   subroutine directions(place)
      type(pad_position), intent(in) :: place
      real(wp), parameter :: tilts(*) = [0.0_wp, 1e-9_wp, -3e-4_wp, 0.01_wp, -0.0199_wp, 0.0201_wp, -0.3_wp]
      integer :: k
      do k = 1, size(tilts)
         associate (frame => frame_of(place, journal_motion(), pad_state(tilts(k))), a => place%angle - tilts(k))
            call expect_close(frame%s, sin(a), 4*epsilon(a), 'sine at a tilt of '//to_text(tilts(k)))
            call expect_close(frame%c, cos(a), 4*epsilon(a), 'cosine at a tilt of '//to_text(tilts(k)))
         end associate
      end do
   end subroutine directions

   !> The gap measured in the plane, between a point of the bore and the journal's circle, with the pad
   !> turned about its pivot. It differs from the thickness by e**2/(2 R_J) and less.
   subroutine against_geometry(place)
      type(pad_position), intent(in) :: place
      real(wp) :: journal(2), tilt, pivot_deflection, phi, pivot(2), along(2), outward(2), point(2), gap, allowed, worst
      integer :: k
      worst = 0
      do k = 1, 200
         journal = [random(60e-6_wp), random(60e-6_wp)]
         tilt = random(2e-3_wp)
         pivot_deflection = random(20e-6_wp)
         phi = random(0.6_wp)
         pivot = (place%pivot_radius + pivot_deflection)*[place%sin_angle, place%cos_angle]
         ! the pad's own directions, turned from the pivot's in the sense of the journal's rotation
         outward = turned([place%sin_angle, place%cos_angle], tilt)
         along = turned([place%cos_angle, -place%sin_angle], tilt)
         point = pivot - place%centre_distance*outward + (journal_radius + c_m)*(sin(phi)*along + cos(phi)*outward)
         gap = norm2(point - journal) - journal_radius
         allowed = (norm2(journal) + abs(tilt)*place%centre_distance + abs(pivot_deflection) &
            & + c_m)**2/(2*journal_radius)
         worst = max(worst, abs(gap - thickness(place, journal, tilt, pivot_deflection, phi))/(allowed + rounding()))
      end do
      call expect(worst < 1.01_wp, 'thickness against plane geometry, in units of e**2/(2 R_J): '//to_text(worst))
   end subroutine against_geometry

   !> Turned by an angle in the sense of the journal's rotation, from +y towards +z.
   pure function turned(vector, angle)
      real(wp), intent(in) :: vector(2), angle
      real(wp) :: turned(2)
      turned = [vector(1)*cos(angle) - vector(2)*sin(angle), vector(1)*sin(angle) + vector(2)*cos(angle)]
   end function turned

   !> Velocities are the time derivatives of positions along a path: central differences of a step h have
   !> an error of h**2/6 of the third derivative (here 1e-10) and rounding 1e-17/h = 1e-12 m/s.
   subroutine rates(place)
      type(pad_position), intent(in) :: place
      real(wp), parameter :: h = 1e-5_wp
      type(film_motion) :: motion, before, after
      real(wp) :: worst
      integer :: k
      worst = 0
      do k = 1, 50
         motion = on_path(place, 0.37_wp*k)
         before = on_path(place, 0.37_wp*k - h)
         after = on_path(place, 0.37_wp*k + h)
         worst = max(worst, maxval(abs((after%position - before%position)/(2*h) - motion%velocity)))
      end do
      call expect_close(worst, 0.0_wp, 1e-11_wp, 'velocities are rates of positions')
   end subroutine rates

   !> The motion at a time on some smooth path with velocities of order 1e-3 and a tilt far from small.
   pure type(film_motion) function on_path(place, t)
      type(pad_position), intent(in) :: place
      real(wp), intent(in) :: t
      type(journal_motion) :: journal
      type(pad_state) :: pad
      journal = journal_motion(1e-3_wp*[sin(t), cos(1.3_wp*t)], 1e-3_wp*[cos(t), -1.3_wp*sin(1.3_wp*t)])
      pad = pad_state(0.3_wp + 1e-2_wp*sin(0.7_wp*t), 0.7e-2_wp*cos(0.7_wp*t), 1e-3_wp*cos(0.9_wp*t), &
         & -0.9e-3_wp*sin(0.9_wp*t))
      on_path = motion_of(place, frame_of(place, journal, pad), journal, pad)
   end function on_path

   !> Between -size and size.
   real(wp) function random(size)
      real(wp), intent(in) :: size
      call random_number(random)
      random = size*(2*random - 1)
   end function random

   subroutine points()
      type(case_type) :: inputs
      type(operating_point_type) :: point, static
      inputs = case_type()
      inputs%operation%final_speed_rpm = 3250
      inputs%rotor%static_load = [1e3_wp, -2e3_wp]
      point = operating_point_type(inputs)
      call expect_close(point%speed(0.0_wp), 6500*pi/30, 1e-12_wp*6500, 'speed at the start')
      call expect_close(point%speed(2.0_wp), 3250*pi/30, 1e-12_wp*6500, 'speed at the end')
      ! the mean speed times the duration
      call expect_close(point%shaft_angle(2.0_wp), 4875*pi/30*2, 1e-12_wp*6500, 'angle at the end')
      call expect_close(norm2(point%load - [1e3_wp - 2000*9.81_wp, -2e3_wp]), 0.0_wp, 1e-10_wp, &
         & 'weight and static load')
      call expect_close(point%unbalance, 0.010_wp, 0.0_wp, 'unbalance')
      call expect(point%friction .and. point%cavitation, 'all effects act')
      static = point%static()
      call expect_close(static%speed(1.0_wp), point%speed(0.0_wp), 0.0_wp, 'the static point keeps the first speed')
      call expect_close(norm2(static%load - point%load) + static%unbalance, 0.0_wp, 0.0_wp, 'and the load alone')
      call expect(.not. static%friction .and. static%cavitation, 'without friction, with cavitation')
   end subroutine points
end program test_kinematics
