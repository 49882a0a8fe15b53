!> Places and velocities of journal and pads.
program test_kinematics
   use kinds, only: wp, degree, pi
   use text, only: to_text
   use film_solver, only: film_motion
   use pad_gap, only: pad_gap_type
   use kinematics, only: pad_position, pad_frame, frame_of, motion_of, motion_derivatives, to_global
   use paper_bearing, only: offset_pad
   use case_inputs, only: case_type
   use operating_point, only: operating_point_type
   use rigid_journal, only: rigid_journal_type, journal_motion
   use check, only: runs, expect, expect_close, between, report
   implicit none (type, external)
   !> The paper's bearing: R_J, c_m, c_r, kappa, m.
   real(wp), parameter :: journal_radius = 49.9e-3_wp, c_m = 100e-6_wp, c_r = 80e-6_wp, kappa = 14e-3_wp
   real(wp), parameter :: angles(*) = [-45.0_wp, 225.0_wp, 10.0_wp, 90.0_wp, 137.0_wp]
   integer :: i

   do i = 1, size(angles)
      if (runs('unloaded')) call unloaded(place_at(angles(i)))
      if (runs('directions')) call directions(place_at(angles(i)))
      if (runs('against_geometry')) call against_geometry(place_at(angles(i)))
      if (runs('rates')) call rates(place_at(angles(i)))
      if (runs('slopes')) call slopes(place_at(angles(i)))
      if (runs('global_frame')) call global_frame(place_at(angles(i)))
   end do
   if (runs('points')) call points()
   if (runs('motion')) call motion()
   if (runs('derivatives')) call derivatives()
   if (runs('unbalance')) call unbalance()
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
      thickness = gap%thickness(motion_of(place, frame_of(place, journal, tilt, pivot_deflection), [0.0_wp, 0.0_wp], &
         & 0.0_wp, 0.0_wp), sin(phi), cos(phi))
   end function thickness

   !> Rounding of differences of lengths of 0.1 m.
   pure real(wp) function rounding()
      rounding = 20*epsilon(1.0_wp)*0.1_wp
   end function rounding

   subroutine unloaded(place)
      type(pad_position), intent(in) :: place
      real(wp), parameter :: centre(2) = 0
      call expect_close(thickness(place, centre, 0.0_wp, 0.0_wp, 0.0_wp), c_r, rounding(), &
         & 'the bearing clearance at the pivot')
      ! c_m - (c_m - c_r) cos(phi)
      call expect_close(thickness(place, centre, 0.0_wp, 0.0_wp, 0.5_wp), c_m - (c_m - c_r)*cos(0.5_wp), rounding(), &
         & 'preload away from the pivot')
   end subroutine unloaded

   subroutine directions(place)
      type(pad_position), intent(in) :: place
      real(wp), parameter :: centre(2) = 0, step = 10e-6_wp
      real(wp) :: towards(2), h
      towards = [place%sin_angle, place%cos_angle]
      call expect_close(thickness(place, step*towards, 0.0_wp, 0.0_wp, 0.0_wp), c_r - step, rounding(), &
         & 'the journal towards the pivot thins the film')
      call expect_close(thickness(place, centre, 0.0_wp, step, 0.0_wp), c_r + step, rounding(), &
         & 'pivot deflection opens the film')
      ! tilting by delta carries the journal, seen from the pad, by the pivot's radius times delta along -y':
      ! h grows by that times sin(phi), to second order in delta
      h = thickness(place, centre, 1e-4_wp, 0.0_wp, 0.6_wp)
      call expect_close(h - thickness(place, centre, 0.0_wp, 0.0_wp, 0.6_wp), 1e-4_wp*place%pivot_radius*sin(0.6_wp), &
         & 0.6e-8_wp*place%pivot_radius, 'positive tilt opens the leading edge')
      h = thickness(place, centre, 1e-4_wp, 0.0_wp, -0.5_wp)
      call expect_close(h - thickness(place, centre, 0.0_wp, 0.0_wp, -0.5_wp), &
         & -1e-4_wp*place%pivot_radius*sin(0.5_wp), 0.6e-8_wp*place%pivot_radius, &
         & 'positive tilt closes the trailing edge')
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
      real(wp) :: journal(2), velocity(2), tilt, tilt_rate, pivot_deflection, pivot_deflection_rate
      journal = 1e-3_wp*[sin(t), cos(1.3_wp*t)]
      velocity = 1e-3_wp*[cos(t), -1.3_wp*sin(1.3_wp*t)]
      tilt = 0.3_wp + 1e-2_wp*sin(0.7_wp*t)
      tilt_rate = 0.7e-2_wp*cos(0.7_wp*t)
      pivot_deflection = 1e-3_wp*cos(0.9_wp*t)
      pivot_deflection_rate = -0.9e-3_wp*sin(0.9_wp*t)
      on_path = motion_of(place, frame_of(place, journal, tilt, pivot_deflection), velocity, tilt_rate, &
         & pivot_deflection_rate)
   end function on_path

   !> Slopes against central differences, each in the unit of its state: the relations are at most
   !> quadratic but for sines of the tilt, so a step of 1e-4 leaves 1e-9 and rounding 1e-12.
   subroutine slopes(place)
      type(pad_position), intent(in) :: place
      real(wp), parameter :: h = 1e-4_wp
      real(wp) :: local(8), up(8), down(8), found(4, 8), expected(4)
      integer :: k, trial
      character(len=*), parameter :: names(8) = [character(len=21) :: 'y', 'z', 'y rate', 'z rate', 'tilt', &
         & 'tilt rate', 'pivot_deflection', 'pivot deflection rate']
      do trial = 1, 5
         do k = 1, 8
            local(k) = random(1.0_wp)
         end do
         local(5) = 0.2_wp*local(5)
         found = motion_derivatives(place, frame_of(place, local(1:2), local(5), local(7)), motion_at(place, local), &
            & local(6))
         do k = 1, 8
            up = local
            down = local
            up(k) = up(k) + h
            down(k) = down(k) - h
            expected = (as_vector(motion_at(place, up)) - as_vector(motion_at(place, down)))/(2*h)
            call expect_close(maxval(abs(found(:, k) - expected)), 0.0_wp, 1e-8_wp, 'slopes over '//trim(names(k)))
         end do
      end do
   end subroutine slopes

   pure type(film_motion) function motion_at(place, local)
      type(pad_position), intent(in) :: place
      real(wp), intent(in) :: local(8)
      motion_at = motion_of(place, frame_of(place, local(1:2), local(5), local(7)), local(3:4), local(6), local(8))
   end function motion_at

   pure function as_vector(motion) result(vector)
      type(film_motion), intent(in) :: motion
      real(wp) :: vector(4)
      vector = [motion%position, motion%velocity]
   end function as_vector

   !> Eq (5): the pad's y' and z' in global directions, a proper rotation.
   subroutine global_frame(place)
      type(pad_position), intent(in) :: place
      type(pad_frame) :: frame
      real(wp) :: along(2), outward(2), a
      real(wp), parameter :: small = 10*epsilon(1.0_wp)
      frame = frame_of(place, [1e-5_wp, 2e-5_wp], 0.1_wp, 0.0_wp)
      a = place%angle - 0.1_wp
      along = to_global(frame, [1.0_wp, 0.0_wp])
      outward = to_global(frame, [0.0_wp, 1.0_wp])
      call expect_close(norm2(along - [cos(a), -sin(a)]), 0.0_wp, small, 'y'' in global directions')
      call expect_close(norm2(outward - [sin(a), cos(a)]), 0.0_wp, small, 'z'' in global directions')
      call expect_close(dot_product(along, outward), 0.0_wp, small, 'directions are orthogonal')
      call expect_close(along(1)*outward(2) - along(2)*outward(1), 1.0_wp, small, 'directions turn, and do not mirror')
      ! what frame_of measured is the journal seen from the pivot
      call expect_close(norm2(to_global(frame, [frame%along, frame%outward]) - ([1e-5_wp, 2e-5_wp] &
         & - place%pivot_radius*[place%sin_angle, place%cos_angle])), 0.0_wp, small, 'the journal seen from the pivot')
   end subroutine global_frame

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

   !> The states hold the motion of the journal; m a = F.
   subroutine motion()
      type(rigid_journal_type) :: rotor
      type(journal_motion) :: journal
      real(wp), parameter :: force(2) = [3.0_wp, -5.0_wp]
      real(wp) :: states(4), rates(4)
      rotor%mass = 4
      journal = journal_motion([1.0_wp, 2.0_wp], [30.0_wp, 40.0_wp])
      states = rotor%with_journal(journal)
      journal = rotor%journal(states)
      call expect_close(norm2(journal%position - [1.0_wp, 2.0_wp]) + norm2(journal%velocity - [30.0_wp, 40.0_wp]), &
         & 0.0_wp, 0.0_wp, 'the motion comes back')
      rates = rotor%rates(states, force)
      journal = rotor%journal(rates)
      call expect_close(norm2(journal%position - [30.0_wp, 40.0_wp]), 0.0_wp, 0.0_wp, 'positions grow at their rates')
      call expect_close(norm2(4*journal%velocity - force), 0.0_wp, 1e-15_wp, 'mass times acceleration is the force')
      journal = rotor%journal(rotor%scales(2.0_wp, 3.0_wp))
      call expect_close(norm2(journal%position - 2) + norm2(journal%velocity - 6), 0.0_wp, 0.0_wp, &
         & 'scales: clearance, and clearance times speed')
   end subroutine motion

   !> The rates are linear, so differences are exact but for rounding.
   subroutine derivatives()
      type(rigid_journal_type) :: rotor
      real(wp) :: states(4), moved(4), force(2), slope(2, 3), change(3), own(4, 4)
      integer :: i
      rotor%mass = 7
      states = [(between(-1.0_wp, 1.0_wp), i=1, 4)]
      force = [between(-1.0_wp, 1.0_wp), between(-1.0_wp, 1.0_wp)]
      own = rotor%own_derivatives()
      do i = 1, 4
         moved = states
         moved(i) = moved(i) + 1
         call expect_close(norm2(rotor%rates(moved, force) - rotor%rates(states, force) - own(:, i)), 0.0_wp, &
            & 1e-15_wp, 'derivatives over a state')
      end do
      call random_number(slope)
      call random_number(change)
      call expect_close(norm2(rotor%rates(states, force + matmul(slope, change)) - rotor%rates(states, force) &
         & - matmul(rotor%rate_derivatives(slope), change)), 0.0_wp, 1e-15_wp, 'derivatives of a force')
   end subroutine derivatives

   !> A mass u/r on the shaft at (cos, sin) of its angle pulls with -u times the second derivative of that direction.
   !> Differences of a step d = 1e-2/w: error (w d)**4/90 = 1e-10 of the force, rounding 1e-10.
   subroutine unbalance()
      type(rigid_journal_type) :: rotor
      type(operating_point_type) :: point
      real(wp) :: t, d, pulled(2)
      integer :: k
      point = operating_point_type(speed_rpm=1500.0_wp, acceleration=2000.0_wp, load=[10.0_wp, -20.0_wp], &
         & unbalance=0.5_wp)
      do k = 0, 3
         t = 0.05_wp*k
         d = 1e-2_wp/point%speed(t)
         pulled = -0.5_wp*(16*(direction(point, t + d) + direction(point, t - d)) - 30*direction(point, t) &
            & - direction(point, t + 2*d) - direction(point, t - 2*d))/(12*d**2)
         call expect_close(norm2(rotor%force(point, t) - point%load - pulled), 0.0_wp, 1e-8_wp*norm2(pulled), &
            & 'pull of the unbalance in a run-up')
      end do
   end subroutine unbalance

   pure function direction(point, t)
      type(operating_point_type), intent(in) :: point
      real(wp), intent(in) :: t
      real(wp) :: direction(2)
      direction = [cos(point%shaft_angle(t)), sin(point%shaft_angle(t))]
   end function direction
end program test_kinematics
