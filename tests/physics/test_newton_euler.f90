!> The equations of a pad against Newton's and Euler's laws about its centre of gravity, which lies off the
!> pivot's radius, and of the journal against its forces.
program test_newton_euler
   use kinds, only: wp
   use text, only: to_text
   use case_inputs, only: case_type
   use tilting_pad_bearing, only: pad_sample
   use state_layout, only: pad_state
   use equations_of_motion, only: machine_model, new_machine_model
   use input_cases, only: case_of
   use check, only: runs, expect, expect_close, between, report
   implicit none (type, external)

   !> Forces of 1e4 N in sums whose parts cancel a thousandfold.
   real(wp), parameter :: rounding = 1e4_wp*epsilon(1.0_wp)
   !> Against the tilts, N m/rad: moments as large as those of the films.
   real(wp), parameter :: stiffness(2) = [4e5_wp, 7e5_wp]
   integer :: i

   do i = 1, 20
      if (runs('pad_radial')) call pad_radial()
      if (runs('pad_tilting_only')) call pad_tilting_only()
      if (runs('journal')) call journal()
   end do
   call report()

contains

   type(case_type) function offset_case(motion) result(inputs)
      character(len=*), intent(in) :: motion
      inputs = case_of('&pads mass = 0.8, 8, inertia = 4e-4, 5e-3, centre_tangential = 8e-3, -15e-3, motion = ''' &
         & //motion//''' / &pivot rotational_stiffness = 4e5, 7e5 / &friction model = ''lugre'' / ' &
         & //'&rotor gravity = 500 / &film cavitation = ''none'' /')
   end function offset_case

   !> Random places, velocities and bristles, with films open and pivots loaded.
   function random_state(model) result(y)
      type(machine_model), intent(in) :: model
      real(wp), allocatable :: y(:)
      y = model%static_state([between(-50e-6_wp, 0.0_wp), between(-10e-6_wp, 10e-6_wp)], &
         & [pad_state(between(-3e-4_wp, 7e-4_wp), between(-5.0_wp, 5.0_wp), between(-2e-6_wp, 9e-6_wp), &
         & between(-5e-3_wp, 5e-3_wp), between(-1e-7_wp, 1e-7_wp)), &
         & pad_state(between(-3e-4_wp, 7e-4_wp), between(-5.0_wp, 5.0_wp), between(1e-6_wp, 9e-6_wp), &
         & between(-5e-3_wp, 5e-3_wp), between(-1e-7_wp, 1e-7_wp))])
      y(3:4) = [between(-0.02_wp, 0.02_wp), between(-0.02_wp, 0.02_wp)]
   end function random_state

   !> The film on the pad, -F, acts at the centre of its arc, R + kappa inward of the pivot; the pivot pushes
   !> with F_bs inward, holds with some tangential force T, rubs with M_f against the tilt rate and turns back by a
   !> spring against the tilt; weight acts at C. The pivot accelerates by eta'' along z'. Then m a_C = sum of forces,
   !> whose y' part gives T, and I_C delta'' = moment about C, with I_C = I_P - m |C|**2; turning is positive from y' to
   !> z'.
   subroutine pad_radial()
      type(machine_model) :: model
      real(wp), allocatable :: y(:), f(:)
      type(pad_sample), allocatable :: films(:)
      real(wp) :: a, tilt_acceleration, radial_acceleration, rate, acceleration(2), weight(2), film(2), tangential
      real(wp) :: moment, inertia, friction, sizes(2), total, spring
      integer :: pad
      logical :: ok
      model = new_machine_model(offset_case('tilting_radial'))
      y = random_state(model)
      allocate (f(model%n))
      call model%rhs(0.01_wp, y, f, ok)
      films = model%bearings(1)%sampled()
      call expect(ok, 'a state with films')
      do pad = 1, 2
         associate (p => model%inputs%bearings(1)%pads, loads => model%bearings(1)%loads(pad), &
            & arm => model%bearings(1)%pads(pad)%position%centre_distance)
            a = model%bearings(1)%pads(pad)%position%angle - y(model%layout%elements(1)%before(pad) + 1)
            rate = y(model%layout%elements(1)%before(pad) + 2)
            tilt_acceleration = f(model%layout%elements(1)%before(pad) + 2)
            radial_acceleration = f(model%layout%elements(1)%before(pad) + 4)
            ! C = (C_xi, C_eta) turns with the pad: C' = rate (-C_eta, C_xi) and so on
            associate (c_t => p%centre_tangential(pad), c_r => p%centre_radial(pad), m => p%mass(pad))
               acceleration = [-tilt_acceleration*c_r - rate**2*c_t, &
                  & radial_acceleration + tilt_acceleration*c_t - rate**2*c_r]
               weight = m*500*[-cos(a), -sin(a)]
               film = -films(pad)%film_force
               tangential = m*acceleration(1) - film(1) - weight(1)
               total = film(2) + weight(2) - loads%contact
               sizes(1) = abs(film(2)) + abs(weight(2)) + abs(loads%contact)
               call expect_close(m*acceleration(2), total, rounding*sizes(1), 'Newton, pad '//to_text(pad))
               friction = model%bearings(1)%pads(pad)%ball_radius*loads%friction%force
               ! arms from C: arc centre (-c_t, -arm - c_r); pivot (-c_t, -c_r)
               spring = stiffness(pad)*y(model%layout%elements(1)%before(pad) + 1)
               moment = -c_t*film(2) + (arm + c_r)*film(1) - c_t*(-loads%contact) + c_r*tangential - friction - spring
               inertia = p%inertia(pad) - m*(c_t**2 + c_r**2)
               sizes(2) = sizes(1)*abs(c_t) + (abs(film(1)) + abs(tangential))*arm + abs(friction) + abs(spring)
               call expect_close(inertia*tilt_acceleration, moment, rounding*sizes(2), 'Euler, pad '//to_text(pad))
            end associate
         end associate
      end do
   end subroutine pad_radial

   !> Without radial motion moments about the pivot, which is at rest, do.
   subroutine pad_tilting_only()
      type(machine_model) :: model
      real(wp), allocatable :: y(:), f(:)
      type(pad_sample), allocatable :: films(:)
      real(wp) :: a, moment, friction, sizes, spring
      integer :: pad
      logical :: ok
      model = new_machine_model(offset_case('tilting_only'))
      y = random_state(model)
      allocate (f(model%n))
      call model%rhs(0.01_wp, y, f, ok)
      films = model%bearings(1)%sampled()
      call expect(ok, 'a state with films')
      do pad = 1, 2
         associate (p => model%inputs%bearings(1)%pads, arm => model%bearings(1)%pads(pad)%position%centre_distance)
            a = model%bearings(1)%pads(pad)%position%angle - y(model%layout%elements(1)%before(pad) + 1)
            friction = model%bearings(1)%pads(pad)%ball_radius*model%bearings(1)%loads(pad)%friction%force
            ! C x weight, with weight along (-cos a, -sin a)
            spring = stiffness(pad)*y(model%layout%elements(1)%before(pad) + 1)
            moment = -films(pad)%film_force(1)*arm - friction - spring + p%mass(pad)*500 &
               & *(-p%centre_tangential(pad)*sin(a) + p%centre_radial(pad)*cos(a))
            sizes = abs(films(pad)%film_force(1))*arm + abs(friction) + abs(spring) + p%mass(pad)*500*0.03_wp
            call expect_close(p%inertia(pad)*f(model%layout%elements(1)%before(pad) + 2), moment, &
               & rounding*sizes, 'moments about the pivot')
         end associate
      end do
   end subroutine pad_tilting_only

   !> Mass times acceleration of the journal is load, unbalance and the films' forces, turned one by one.
   subroutine journal()
      type(machine_model) :: model
      type(case_type) :: inputs
      real(wp), allocatable :: y(:), f(:)
      type(pad_sample), allocatable :: films(:)
      real(wp) :: total(2), sizes, a, t
      integer :: pad
      logical :: ok
      inputs = offset_case('tilting_radial')
      inputs%rotor%static_load = [300.0_wp, -700.0_wp]
      model = new_machine_model(inputs)
      y = random_state(model)
      allocate (f(model%n))
      t = between(0.0_wp, 0.01_wp)
      call model%rhs(t, y, f, ok)
      films = model%bearings(1)%sampled()
      associate (w => model%point%speed(0.0_wp))
         total = inputs%rotor%static_load + [-2000*500.0_wp, 0.0_wp] + 0.01_wp*w**2*[cos(w*t), sin(w*t)]
      end associate
      sizes = norm2(total)
      do pad = 1, 2
         a = model%bearings(1)%pads(pad)%position%angle - y(model%layout%elements(1)%before(pad) + 1)
         associate (force => films(pad)%film_force)
            total = total + force(1)*[cos(a), -sin(a)] + force(2)*[sin(a), cos(a)]
            sizes = sizes + norm2(force)
         end associate
      end do
      call expect_close(norm2(2000*f(3:4) - total), 0.0_wp, rounding*sizes, 'Newton, journal')
   end subroutine journal
end program test_newton_euler
