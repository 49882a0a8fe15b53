!> Friction laws: printed values, symmetry, limits of the bristle model, slopes.
program test_friction
   use kinds, only: wp
   use text, only: to_text
   use friction, only: friction_law, friction_response, bengisu_akay_friction, lugre_friction, &
      & default_bristle_damping, never_sticks
   use check, only: runs, expect, expect_close, report
   implicit none (type, external)

   real(wp), parameter :: fs = 0.1_wp, fd = 0.05_wp, vc = 1e-5_wp, chi = 1000, vs = 1e-3_wp
   real(wp), parameter :: stiffness = 1e6_wp, damping = 10, load = 2e4_wp
   !> A handful of operations and one exponential.
   real(wp), parameter :: rounding = 50*epsilon(1.0_wp)
   real(wp), parameter :: exponents(*) = [0.5_wp, 1.0_wp, 2.0_wp]
   integer :: i

   if (runs('without_friction')) call without_friction()
   if (runs('bengisu_akay_values')) call bengisu_akay_values()
   if (runs('bengisu_akay_slopes')) call bengisu_akay_slopes()
   if (runs('bristle_damping_rule')) call bristle_damping_rule()
   do i = 1, size(exponents)
      if (runs('steady_sliding')) call steady_sliding(exponents(i))
      if (runs('lugre_slopes')) call lugre_slopes(exponents(i))
   end do
   if (runs('presliding')) call presliding()
   call report()

contains

   pure type(bengisu_akay_friction) function bengisu_akay()
      bengisu_akay = bengisu_akay_friction(.false., fs, fd, vc, chi)
   end function bengisu_akay

   pure type(lugre_friction) function lugre(exponent)
      real(wp), intent(in) :: exponent
      lugre = lugre_friction(.true., fs, fd, never_sticks, vs, exponent, stiffness, damping, 3.0_wp)
   end function lugre

   subroutine without_friction()
      type(friction_law) :: law
      type(friction_response) :: r
      call law%evaluate(0.1_wp, 1e-6_wp, load, r)
      call expect(.not. law%has_bristle, 'no friction has no bristle')
      ! beyond any velocity, and still a number to reckon with
      call expect(law%sticking_velocity > 1e6_wp .and. law%sticking_velocity < 1e200_wp, 'nothing sticks without')
      call expect_close(max(abs(r%force), abs(r%rate), abs(r%force_velocity), abs(r%force_normal)), 0.0_wp, 0.0_wp, &
         & 'no friction')
   end subroutine without_friction

   subroutine bengisu_akay_values()
      type(bengisu_akay_friction) :: law
      real(wp) :: v
      integer :: k
      law = bengisu_akay()
      call expect_close(law%sticking_velocity, vc, 0.0_wp, 'it sticks below v_c')
      call expect_close(force_of(law, 0.0_wp), 0.0_wp, 0.0_wp, 'sign(0) = 0')
      call expect_close(force_of(law, 0.5_wp*vc), 0.75_wp*fs*load, rounding*fs*load, 'parabola half way to v_c')
      call expect_close(force_of(law, vc), fs*load, rounding*fs*load, 'f_s at v_c, from above')
      ! the parabola is flat at its top: one spacing below v_c changes nothing
      call expect_close(force_of(law, nearest(vc, -1.0_wp)), fs*load, rounding*fs*load, 'f_s at v_c, from below')
      call expect_close(force_of(law, vc + 1/chi), (fd + (fs - fd)*exp(-1.0_wp))*load, rounding*fs*load, &
         & 'one decay length beyond v_c')
      call expect_close(force_of(law, 1.0_wp), fd*load, rounding*fd*load, 'f_d far beyond v_c')
      do k = -7, 0
         v = 3*10.0_wp**k
         call expect_close(force_of(law, -v), -force_of(law, v), 0.0_wp, 'odd in the velocity '//to_text(v))
      end do
   end subroutine bengisu_akay_values

   !> Both one-sided slopes at v_c: 0 and -chi (f_s - f_d); elsewhere against differences.
   subroutine bengisu_akay_slopes()
      type(bengisu_akay_friction) :: law
      type(friction_response) :: r
      real(wp), parameter :: velocities(*) = [2e-6_wp, 8e-6_wp, 3e-5_wp, 1e-3_wp, -3e-6_wp, -2e-5_wp, -2e-3_wp]
      real(wp) :: h
      integer :: k
      law = bengisu_akay()
      call law%evaluate(nearest(vc, -1.0_wp), 0.0_wp, load, r)
      call expect_close(r%force_velocity, 0.0_wp, rounding*fs*load/vc, 'slope below v_c')
      call law%evaluate(vc, 0.0_wp, load, r)
      call expect_close(r%force_velocity, -chi*(fs - fd)*load, rounding*chi*fs*load, 'slope above v_c')
      call law%evaluate(0.0_wp, 0.0_wp, load, r)
      call expect_close(r%force_velocity, 2*fs/vc*load, rounding*fs*load/vc, 'slope at rest')
      do k = 1, size(velocities)
         call law%evaluate(velocities(k), 0.0_wp, load, r)
         ! step 1e-4 of v: error (1e-4 v chi)**2/6 < 1e-8 of the slope, rounding 1e-16 f/(1e-4 v) < 1e-10 f/v
         h = 1e-4_wp*abs(velocities(k))
         call expect_close(r%force_velocity, (force_of(law, velocities(k) + h) - force_of(law, velocities(k) &
            & - h))/(2*h), 1e-8_wp*abs(r%force_velocity) + 1e-10_wp*abs(r%force/velocities(k)), &
            & 'Bengisu-Akay slope at '//to_text(velocities(k)))
         call expect_close(r%force_normal, r%force/load, rounding*fs, 'Bengisu-Akay slope over the normal force')
      end do
   end subroutine bengisu_akay_slopes

   real(wp) function force_of(law, velocity)
      class(friction_law), intent(in) :: law
      real(wp), intent(in) :: velocity
      type(friction_response) :: r
      call law%evaluate(velocity, 0.0_wp, load, r)
      force_of = r%force
   end function force_of

   subroutine bristle_damping_rule()
      call expect_close(default_bristle_damping(1e6_wp, 1e4_wp), 10.0_wp, rounding*10, &
         & 'rule (28), the paper''s example')
      call expect_close(default_bristle_damping(4e8_wp, 1e4_wp), 200.0_wp, rounding*200, 'rule (28)')
   end subroutine bristle_damping_rule

   !> With z = G(v)/sigma_0 sign(v) the bristles stand still and the force is G(v) + sigma_2 v of the load.
   subroutine steady_sliding(exponent)
      real(wp), intent(in) :: exponent
      type(lugre_friction) :: law
      type(friction_response) :: r
      real(wp) :: v, g
      integer :: k
      law = lugre(exponent)
      do k = -12, 12
         if (k == 0) cycle
         v = sign(10.0_wp**(-7 + 0.5_wp*abs(k)), real(k, wp))
         g = fd + (fs - fd)*exp(-abs(v/vs)**exponent)
         call law%evaluate(v, sign(g/stiffness, v), load, r)
         call expect_close(r%rate, 0.0_wp, rounding*abs(v), 'bristles at rest while sliding at '//to_text(v))
         call expect_close(r%force, (sign(g, v) + 3*v)*load, rounding*(fs + damping*abs(v))*load, &
            & 'Stribeck curve at '//to_text(v))
      end do
   end subroutine steady_sliding

   !> Slopes of force and rate by differences, away from the switching point at rest. Steps of 1e-4 of velocity and
   !> deflection: errors below 1e-7 of f/v (the Stribeck term has third derivatives of order 10 f/v**3 and
   !> less), rounding 1e-12.
   subroutine lugre_slopes(exponent)
      real(wp), intent(in) :: exponent
      type(lugre_friction) :: law
      type(friction_response) :: r, up, down
      real(wp), parameter :: velocities(*) = [1e-5_wp, 4e-4_wp, 3e-3_wp, -1e-5_wp, -6e-4_wp, -2e-3_wp]
      real(wp) :: v, z, h
      integer :: k
      law = lugre(exponent)
      do k = 1, size(velocities)
         v = velocities(k)
         z = 3e-8_wp*k
         call law%evaluate(v, z, load, r)
         h = 1e-4_wp*abs(v)
         call law%evaluate(v + h, z, load, up)
         call law%evaluate(v - h, z, load, down)
         call expect_close(r%rate_velocity, (up%rate - down%rate)/(2*h), 1e-7_wp, 'rate over velocity '//to_text(v))
         call expect_close(r%force_velocity, (up%force - down%force)/(2*h), 1e-7_wp*(damping + fs/abs(v))*load, &
            & 'force over velocity '//to_text(v))
         ! linear in the deflection: rounding only
         h = 1e-2_wp*z
         call law%evaluate(v, z + h, load, up)
         call law%evaluate(v, z - h, load, down)
         call expect_close(r%rate_deflection, (up%rate - down%rate)/(2*h), 1e-10_wp*(stiffness*abs(v)/fd + abs(v)/z), &
            & 'rate over deflection')
         call expect_close(r%force_deflection, (up%force - down%force)/(2*h), &
            & 1e-10_wp*(stiffness + damping*stiffness*abs(v)/fd + damping*abs(v)/z)*load, 'force over deflection')
         call expect_close(r%force_normal, r%force/load, rounding*(stiffness*z + damping*abs(v)*10), &
            & 'force over normal force')
      end do
   end subroutine lugre_slopes

   !> Before sliding, bristles follow the motion: z = x (1 - O(x sigma_0/f)), a spring of sigma_0 N.
   subroutine presliding()
      type(lugre_friction) :: law
      type(friction_response) :: r
      real(wp) :: x, z, share
      integer :: k
      law = lugre(1.0_wp)
      call law%evaluate(0.0_wp, 2e-8_wp, load, r)
      call expect_close(r%force, stiffness*2e-8_wp*load, rounding*r%force, 'a deflected bristle at rest is a spring')
      call expect_close(r%force_deflection, stiffness*load, rounding*stiffness*load, 'its stiffness is sigma_0 N')
      do k = 0, 2
         ! share of the yield deflection f_s/sigma_0, reached slowly
         share = 0.04_wp/2**k
         x = share*fs/stiffness
         z = deflection_after_moving(law, x)
         ! dz/dx = 1 - z sigma_0/G: z = x (1 - share/2 + ...)
         call expect_close(z/x, 1 - 0.5_wp*share, share**2, 'presliding over '//to_text(x)//' m')
      end do
   end subroutine presliding

   !> Bristle deflection after a slow move from rest over x, by the classical Runge-Kutta scheme.
   real(wp) function deflection_after_moving(law, x) result(z)
      class(friction_law), intent(in) :: law
      real(wp), intent(in) :: x
      real(wp) :: dt
      integer :: k
      integer, parameter :: steps = 200
      real(wp), parameter :: v = 1e-7_wp
      dt = x/v/steps
      z = 0
      do k = 1, steps
         z = bristle_step(law, z, v, v, v, dt)
      end do
   end function deflection_after_moving

   !> One Runge-Kutta step with the velocity at its start, middle and end.
   real(wp) function bristle_step(law, z, v0, v1, v2, dt)
      class(friction_law), intent(in) :: law
      real(wp), intent(in) :: z, v0, v1, v2, dt
      type(friction_response) :: a, b, c, d
      call law%evaluate(v0, z, load, a)
      call law%evaluate(v1, z + 0.5_wp*dt*a%rate, load, b)
      call law%evaluate(v1, z + 0.5_wp*dt*b%rate, load, c)
      call law%evaluate(v2, z + dt*c%rate, load, d)
      bristle_step = z + dt*(a%rate + 2*b%rate + 2*c%rate + d%rate)/6
   end function bristle_step
end program test_friction
