!> The rotor's face and the operating point: Newton's law of a mass, its derivatives by differences, load and
!> unbalance by the definition of the shaft's angle.
program test_rigid_journal
   use kinds, only: wp, pi
   use scene, only: scene_type
   use operating_point, only: operating_point_type
   use kinematics, only: journal_motion
   use rigid_journal, only: rigid_journal_type
   use check, only: runs, expect, expect_close, between, report
   implicit none (type, external)

   if (runs('points')) call points()
   if (runs('motion')) call motion()
   if (runs('derivatives')) call derivatives()
   if (runs('unbalance')) call unbalance()
   call report()

contains

   subroutine points()
      type(scene_type) :: scene
      type(operating_point_type) :: point, static
      scene = scene_type()
      scene%operation%final_speed_rpm = 3250
      scene%rotor%static_load = [1e3_wp, -2e3_wp]
      point = operating_point_type(scene)
      call expect_close(point%speed(0.0_wp), 6500*pi/30, 1e-12_wp*6500, 'speed at the start')
      call expect_close(point%speed(2.0_wp), 3250*pi/30, 1e-12_wp*6500, 'speed at the end')
      ! the mean speed times the duration
      call expect_close(point%shaft_angle(2.0_wp), 4875*pi/30*2, 1e-12_wp*6500, 'angle at the end')
      call expect_close(norm2(point%load - [1e3_wp - 2000*9.81_wp, -2e3_wp]), 0.0_wp, 1e-10_wp, &
         & 'weight and static load')
      call expect_close(point%unbalance, 0.010_wp, 0.0_wp, 'unbalance')
      call expect(point%friction .and. point%rupture, 'all effects act')
      static = point%static()
      call expect_close(static%speed(1.0_wp), point%speed(0.0_wp), 0.0_wp, 'the static point keeps the first speed')
      call expect_close(norm2(static%load - point%load) + static%unbalance, 0.0_wp, 0.0_wp, 'and the load alone')
      call expect(.not. static%friction .and. static%rupture, 'without friction, with rupture')
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
end program test_rigid_journal
