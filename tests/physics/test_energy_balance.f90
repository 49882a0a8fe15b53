!> Energy over a march: kinetic energy of journal and pads, their height, and what pivots and asperities store change
!> by the work of films, unbalance and friction. That work is marched along as one more state.
module energy_ledger
   use kinds, only: wp
   use ode_model, only: ode_model_type
   use film_solver, only: film_motion
   use rigid_rotor, only: journal_motion
   use state_layout, only: pad_state, tilt, pivot_deflection, pitch, yaw
   use kinematics, only: frame_of, motion_of
   use tilting_pad_bearing, only: pad_sample, sloped_sample
   use sloped_bearing, only: sampled_slopes
   use equations_of_motion, only: machine_model
   implicit none (type, external)
   private
   public :: ledger, energy_of

   !> The bearing with the work done, the friction's share of it, and the sum of its amounts.
   type, extends(ode_model_type) :: ledger
      type(machine_model) :: bearing
      !> Whether a pad has touched the journal.
      logical :: touched = .false.
   contains
      procedure :: rhs => ledger_rhs
      procedure :: linearize => ledger_linearize
      procedure :: rhs_and_jacobian => ledger_rhs_and_jacobian
      procedure :: solve => ledger_solve
   end type ledger

contains

   subroutine ledger_rhs(self, t, y, dydt, ok)
      class(ledger), intent(inout), target :: self
      real(wp), intent(in) :: t, y(:)
      real(wp), intent(out) :: dydt(:)
      logical, intent(out) :: ok
      type(pad_sample), allocatable :: films(:)
      type(pad_state), allocatable :: pads(:)
      real(wp) :: power(6), film(2), frame(2, 2), a, speed, phase, weight
      integer :: pad
      associate (b => self%bearing, p => self%bearing%inputs%bearings(1)%pads, n => self%bearing%n)
         call b%rhs(t, y(:n), dydt(:n), ok)
         if (.not. ok) then
            self%refusal = b%refusal
            return
         end if
         films = b%bearings(1)%sampled()
         pads = b%layout%elements(1)%pad_states(y)
         speed = b%point%speed(t)
         phase = b%point%shaft_angle(t)
         ! unbalance; films on journal and pads; friction; what eqs (3)-(4) hold beside a potential
         power = 0
         power(1) = b%point%unbalance*speed**2*(cos(phase)*y(3) + sin(phase)*y(4))
         do pad = 1, b%layout%pads
            associate (force => films(pad)%film_force)
               a = b%bearings(1)%pads(pad)%position%angle - pads(pad)%x(tilt)
               frame = reshape([cos(a), -sin(a), sin(a), cos(a)], [2, 2])
               film = matmul(frame, force)
               power(2) = power(2) + dot_product(film, y(3:4)) &
                  & - force(1)*b%bearings(1)%pads(pad)%position%centre_distance*pads(pad)%v(tilt)
               power(3) = power(3) - films(pad)%friction_moment*pads(pad)%v(tilt)
               if (b%layout%elements(1)%has(pitch)) call add_slopes(b, pad, pads(pad), power(2:3))
               if (b%layout%elements(1)%has(pivot_deflection)) then
                  weight = p%mass(pad)*b%inputs%rotor%gravity
                  power(2) = power(2) - force(2)*pads(pad)%v(pivot_deflection)
                  power(4) = power(4) + (p%mass(pad)*p%centre_radial(pad)*pads(pad)%v(tilt)**2 - weight*sin(a)) &
                     & *pads(pad)%v(pivot_deflection)
               end if
            end associate
         end do
         if (any(b%bearings(1)%asperity%touches)) then
            self%touched = .true.
            call add_asperities(b, y(:n), pads, power(5:6))
         end if
         dydt(n + 1) = sum(power)
         dydt(n + 2) = power(3) + power(5)
         dydt(n + 3) = sum(abs(power))
      end associate
   end subroutine ledger_rhs

   !> Power of film and friction along pitch and yaw of a pad whose pivot stands in the middle plane.
   subroutine add_slopes(bearing, pad, state, power)
      type(machine_model), intent(in) :: bearing
      integer, intent(in) :: pad
      type(pad_state), intent(in) :: state
      real(wp), intent(inout) :: power(2)
      type(sloped_sample) :: sample
      sample = sampled_slopes(bearing%bearings(1), pad)
      power(1) = power(1) - sample%moment(2)*state%v(pitch) - sample%moment(1)*state%v(yaw)
      power(2) = power(2) - sample%friction_moment(1)*state%v(pitch) - sample%friction_moment(2)*state%v(yaw)
   end subroutine add_slopes

   !> Power of the asperities beside what they store: of their friction, and what eqs (3)-(4) hold beside a potential,
   !> as their arms are those of the arc's centre.
   subroutine add_asperities(bearing, y, pads, power)
      type(machine_model), intent(in) :: bearing
      real(wp), intent(in) :: y(:)
      type(pad_state), intent(in) :: pads(:)
      real(wp), intent(inout) :: power(2)
      type(journal_motion) :: journal
      type(film_motion) :: motion
      real(wp) :: pushed(2), friction, coefficient
      integer :: i
      journal = bearing%rotor%journal(y(:4), 1)
      coefficient = bearing%inputs%bearings(1)%asperity%friction_coefficient
      do i = 1, size(pads)
         associate (load => bearing%bearings(1)%asperity(i), pad => bearing%bearings(1)%pads(i))
            if (.not. load%touches) cycle
            motion = motion_of(pad%position, frame_of(pad%position, journal, pads(i)), journal, pads(i))
            ! the force is -pushed + coefficient (pushed(2), -pushed(1))
            pushed = -[load%force(1) + coefficient*load%force(2), load%force(2) - coefficient*load%force(1)] &
               & /(1 + coefficient**2)
            friction = taken(i, coefficient*[pushed(2), -pushed(1)]) + load%moment*pads(i)%v(tilt)
            power(1) = power(1) + friction
            power(2) = power(2) + taken(i, -pushed) + dot_product(pushed, motion%velocity)
         end associate
      end do

   contains

      !> Power of a force on the journal in the frame of a pad, and of its opposite on the pad, W.
      real(wp) function taken(i, force)
         integer, intent(in) :: i
         real(wp), intent(in) :: force(2)
         real(wp) :: a
         a = bearing%bearings(1)%pads(i)%position%angle - pads(i)%x(tilt)
         taken = dot_product(force, [cos(a)*y(3) - sin(a)*y(4), sin(a)*y(3) + cos(a)*y(4)]) &
            & - force(1)*bearing%bearings(1)%pads(i)%position%centre_distance*pads(i)%v(tilt)
         if (bearing%layout%elements(1)%has(pivot_deflection)) taken = taken - force(2)*pads(i)%v(pivot_deflection)
      end function taken
   end subroutine add_asperities

   !> What the asperities of a pad store, J: the pressure's potential by the midpoint rule over the arc.
   real(wp) function pressed(bearing, y, pad)
      type(machine_model), intent(in) :: bearing
      real(wp), intent(in) :: y(:)
      integer, intent(in) :: pad
      integer, parameter :: n = 1000000
      type(film_motion) :: motion
      type(journal_motion) :: journal
      type(pad_state), allocatable :: pads(:)
      real(wp) :: phi, depth
      integer :: i
      journal = bearing%rotor%journal(y(:4), 1)
      pads = bearing%layout%elements(1)%pad_states(y)
      pressed = 0
      associate (p => bearing%bearings(1)%pads(pad), gap => bearing%bearings(1)%pads(pad)%gap, &
         & a => bearing%inputs%bearings(1)%asperity)
         motion = motion_of(p%position, frame_of(p%position, journal, pads(pad)), journal, pads(pad))
         do i = 1, n
            phi = -gap%trailing_angle + (i - 0.5_wp)*gap%arc()/n
            depth = 4 - gap%thickness(motion, sin(phi), cos(phi))/a%roughness
            if (depth > 0) pressed = pressed + depth**7.804_wp
         end do
         pressed = pressed*a%factor*a%elastic_modulus*4.4086e-5_wp*a%roughness/7.804_wp &
            & *gap%pad_radius()*gap%axial_length*gap%arc()/n
      end associate
   end function pressed

   subroutine ledger_linearize(self, t, y, ok)
      class(ledger), intent(inout), target :: self
      real(wp), intent(in) :: t, y(:)
      logical, intent(out) :: ok
      call self%bearing%linearize(t, y(:self%bearing%n), ok)
   end subroutine ledger_linearize

   !> The work acts back on nothing; its own rows are left out, which costs an iteration, not accuracy.
   subroutine ledger_rhs_and_jacobian(self, t, y, dydt, matrix, ok)
      class(ledger), intent(inout), target :: self
      real(wp), intent(in) :: t, y(:)
      real(wp), intent(out) :: dydt(:), matrix(:, :)
      logical, intent(out) :: ok
      matrix = 0
      call self%rhs(t, y, dydt, ok)
      associate (n => self%bearing%n)
         if (ok) call self%bearing%rhs_and_jacobian(t, y(:n), dydt(:n), matrix(:n, :n), ok)
      end associate
   end subroutine ledger_rhs_and_jacobian

   !> Without these rows.
   subroutine ledger_solve(self, gamma, b, ok)
      class(ledger), intent(inout), target :: self
      real(wp), intent(in) :: gamma
      real(wp), intent(inout) :: b(:)
      logical, intent(out) :: ok
      call self%bearing%solve(gamma, b(:self%bearing%n), ok)
   end subroutine ledger_solve

   !> Energy of a state: (kinetic of the journal, of the pads, height, stored in pivots and asperities), J.
   function energy_of(bearing, y) result(energy)
      type(machine_model), intent(in) :: bearing
      real(wp), intent(in) :: y(:)
      real(wp) :: energy(4), a
      type(pad_state), allocatable :: pads(:)
      integer :: pad
      energy = 0
      pads = bearing%layout%elements(1)%pad_states(y)
      associate (b => bearing, p => bearing%inputs%bearings(1)%pads, r => bearing%inputs%rotor)
         energy(1) = 0.5_wp*r%mass*dot_product(y(3:4), y(3:4))
         energy(3) = r%mass*r%gravity*y(1) - dot_product(r%static_load, y(1:2))
         do pad = 1, b%layout%pads
            associate (state => pads(pad))
               a = b%bearings(1)%pads(pad)%position%angle - state%x(tilt)
               energy(2) = energy(2) + 0.5_wp*p%inertia(pad)*state%v(tilt)**2
               energy(3) = energy(3) + p%mass(pad)*r%gravity &
                  & *(p%centre_tangential(pad)*cos(a) + p%centre_radial(pad)*sin(a))
               if (b%layout%elements(1)%has(pivot_deflection)) then
                  energy(2) = energy(2) + p%mass(pad)*(0.5_wp*state%v(pivot_deflection)**2 &
                     & + p%centre_tangential(pad)*state%v(tilt)*state%v(pivot_deflection))
                  energy(4) = energy(4) + stored(b, state%x(pivot_deflection))
               end if
               if (b%layout%elements(1)%has(pitch)) then
                  ! what tilt and deflection have is counted above
                  associate (m => p%mass(pad), c_t => p%centre_tangential(pad), c_r => p%centre_radial(pad))
                     energy(2) = energy(2) + 0.5_wp*(p%inertia_pitch(pad)*state%v(pitch)**2 &
                        & + p%inertia_yaw(pad)*state%v(yaw)**2) + m*c_t*c_r*state%v(pitch)*state%v(yaw)
                     energy(3) = energy(3) - 0.5_wp*m*r%gravity*(cos(a)*(c_t*state%x(yaw) + c_r*state%x(pitch)) &
                        & *state%x(yaw) + sin(a)*(c_t*state%x(yaw) + c_r*state%x(pitch))*state%x(pitch))
                  end associate
               else
                  energy(4) = energy(4) + pressed(b, y, pad)
               end if
               energy(4) = energy(4) + 0.5_wp*b%inputs%bearings(1)%pivot%rotational_stiffness(pad)*state%x(tilt)**2
            end associate
         end do
      end associate
   end function energy_of

   !> Work of pressing a pivot in, J: Simpson's rule in s with eta = s**2 depth, on the table's force. The
   !> integrand is smooth but for the seams of the table, where its second derivative jumps by 1e-3 of
   !> itself: an error below 1e-10 with 2000 intervals.
   real(wp) function stored(bearing, depth)
      type(machine_model), intent(in) :: bearing
      real(wp), intent(in) :: depth
      integer, parameter :: n = 2000
      real(wp) :: s, force, stiffness
      integer :: k
      stored = 0
      if (depth <= 0) return
      do k = 1, n
         s = real(k, wp)/n
         call bearing%bearings(1)%pivots(1)%contact%lookup(s**2*depth, force, stiffness)
         stored = stored + force*2*s*depth/n*merge(1.0_wp, merge(4.0_wp, 2.0_wp, mod(k, 2) == 1), k == n)/3
      end do
   end function stored
end module energy_ledger

program test_energy_balance
   use kinds, only: wp, i8
   use text, only: to_text, exact_text
   use errors, only: error_type
   use case_inputs, only: case_type
   use state_layout, only: pad_state, tilt, pivot_deflection, pitch, yaw
   use equations_of_motion, only: machine_model, new_machine_model
   use equilibrium_record, only: equilibrium_type
   use equilibrium, only: find_equilibrium
   use sampled_march, only: march_samples
   use energy_ledger, only: ledger, energy_of
   use input_cases, only: case_of
   use check, only: runs, expect, expect_no_error, report
   implicit none (type, external)

   if (runs('balance')) then
      call balance('tilting_radial', 'none', 0.0_wp)
      call balance('tilting_radial', 'none', 0.05_wp)
      call balance('tilting_radial', 'lugre', 0.05_wp)
      call balance('tilting_only', 'none', 0.05_wp)
      call balance('tilting_only', 'none', 0.05_wp, 2e4_wp)
      call balance('fixed', 'none', 0.05_wp)
      call balance('tilting_radial_pitch_yaw', 'none', 0.05_wp)
      call balance('tilting_radial_pitch_yaw', 'lugre', 0.05_wp)
   end if
   if (runs('bouncing')) then
      call bouncing('tilting_radial', 0.0_wp)
      call bouncing('tilting_radial', 0.2_wp)
      call bouncing('tilting_only', 0.2_wp)
   end if
   if (runs('striking')) then
      call striking(0.0_wp)
      call striking(0.2_wp)
   end if
   call report()

contains

   !> The paper's bearing with pads off their balance, without cavitation.
   type(case_type) function shaken_case(motion, friction, unbalance) result(inputs)
      character(len=*), intent(in) :: motion, friction
      real(wp), intent(in) :: unbalance
      inputs = case_of('&pads centre_tangential = 2e-3, -3e-3, mass = 0.8108, inertia = 4.055e-4, ' &
         & //'centre_radial = -10.1e-3, motion = '''//motion//''' / &friction model = '''//friction//''' / ' &
         & //'&film cavitation = ''none'' / &rotor unbalance = '//exact_text(unbalance)//' /')
   end function shaken_case

   !> Over 6 ms (two thirds of a revolution) the energy changes by the work done.
   subroutine balance(motion, friction, unbalance, stiffness)
      character(len=*), intent(in) :: motion, friction
      real(wp), intent(in) :: unbalance
      !> Of the pivots against the tilts, N m/rad.
      real(wp), intent(in), optional :: stiffness
      type(case_type) :: inputs
      type(machine_model) :: bearing
      type(equilibrium_type) :: static
      type(error_type), allocatable :: error
      type(pad_state) :: pads(2)
      real(wp) :: rubbed
      logical :: touched
      character(len=:), allocatable :: what
      what = motion//', '//friction//', unbalance '//to_text(unbalance)
      inputs = shaken_case(motion, friction, unbalance)
      if (present(stiffness)) inputs%bearings(1)%pivot%rotational_stiffness = stiffness
      bearing = new_machine_model(inputs)
      call find_equilibrium(bearing, static, error)
      call expect_no_error(error, 'the equilibrium is found')
      pads = static%pads
      pads%x(tilt) = pads%x(tilt) + [1e-4_wp, -5e-5_wp]
      pads%x(pivot_deflection) = pads%x(pivot_deflection)*[1.02_wp, 0.97_wp]
      if (bearing%layout%elements(1)%has(pitch)) then
         pads%x(pitch) = pads%x(pitch) + [1e-4_wp, -5e-5_wp]
         pads%x(yaw) = pads%x(yaw) + [-3e-5_wp, 6e-5_wp]
      end if
      call closes(inputs, bearing%static_state(static%rotor + [10e-6_wp, 5e-6_wp], pads), what, rubbed, touched)
      call expect(.not. touched, 'nothing touches, '//what)
      if (friction == 'none') then
         call expect(abs(rubbed) <= 0, 'nothing rubs, '//what)
      else
         call expect(rubbed < 0, 'friction takes work: '//to_text(rubbed)//' J')
      end if
   end subroutine balance

   !> A pad above the journal strikes it with its leading edge and bounces: what the asperities store comes back, and
   !> what their friction takes is work.
   subroutine bouncing(motion, coefficient)
      character(len=*), intent(in) :: motion
      real(wp), intent(in) :: coefficient
      type(case_type) :: inputs
      type(machine_model) :: bearing
      real(wp), allocatable :: start(:)
      real(wp) :: rubbed
      logical :: touched
      character(len=:), allocatable :: what
      what = 'bouncing, '//motion//', friction '//to_text(coefficient)
      inputs = case_of('&pads pivot_angle_deg = -45, 225, 90, centre_tangential = 2e-3, -3e-3, 1e-3, motion = ''' &
         & //motion//''' / &film cavitation = ''gumbel'' / &rotor unbalance = 0 / &asperity friction_coefficient = ' &
         & //exact_text(coefficient)//' /')
      bearing = new_machine_model(inputs)
      start = bearing%static_state([-55e-6_wp, 0.0_wp], [pad_state(-0.2e-3_wp, deflection=7e-6_wp), &
         & pad_state(1.03e-3_wp, deflection=7e-6_wp), pad_state(-3.4e-3_wp, -1.0_wp, 1e-6_wp)])
      call closes(inputs, start, what, rubbed, touched)
      call expect(touched, 'the edge strikes, '//what)
      call expect(merge(rubbed < 0, abs(rubbed) <= 0, coefficient > 0), 'friction takes work alone: ' &
         & //to_text(rubbed)//' J, '//what)
   end subroutine bouncing

   !> A journal is thrown onto fixed pads and comes back.
   subroutine striking(coefficient)
      real(wp), intent(in) :: coefficient
      type(case_type) :: inputs
      type(machine_model) :: bearing
      real(wp), allocatable :: start(:)
      real(wp) :: rubbed
      logical :: touched
      character(len=:), allocatable :: what
      what = 'striking, friction '//to_text(coefficient)
      inputs = shaken_case('fixed', 'none', 0.0_wp)
      ! rough surfaces, which the film does not keep apart
      inputs%bearings(1)%asperity%roughness = 3e-6_wp
      inputs%bearings(1)%asperity%friction_coefficient = coefficient
      bearing = new_machine_model(inputs)
      start = bearing%static_state([-60e-6_wp, 0.0_wp], [pad_state(), pad_state()])
      start(3:4) = [-0.5_wp, 0.2_wp]
      call closes(inputs, start, what, rubbed, touched)
      call expect(touched, 'it strikes, '//what)
      call expect(merge(rubbed < 0, abs(rubbed) <= 0, coefficient > 0), 'friction takes work alone: ' &
         & //to_text(rubbed)//' J, '//what)
   end subroutine striking

   !> Expects that energy and work balance over 6 ms. A step's error is the tolerance, of every state in its own scale
   !> and of the work in that of the power that flows: with n steps the balance closes to n tolerances of the work's
   !> amounts, and closer with closer tolerance.
   subroutine closes(inputs, start, what, rubbed, touched)
      type(case_type), intent(in) :: inputs
      real(wp), intent(in) :: start(:)
      character(len=*), intent(in) :: what
      real(wp), intent(out) :: rubbed
      logical, intent(out) :: touched
      real(wp) :: gap, coarse, flow, steps
      integer :: e
      coarse = 0
      do e = -4, -8, -2
         call marched(inputs, start, 10.0_wp**e, gap, flow, rubbed, steps, touched)
         call expect(gap < steps*10.0_wp**e*flow, 'energy balance at 1e'//to_text(e)//': '//to_text(gap)//' of ' &
            & //to_text(flow)//' J in '//to_text(steps)//' steps, '//what)
         if (e > -8) coarse = max(coarse, gap)
      end do
      ! errors of a single tolerance may cancel
      call expect(gap < 0.1_wp*coarse, 'a closer balance: '//to_text(gap)//' after '//to_text(coarse)//', '//what)
   end subroutine closes

   !> |change of energy - work|, the sum of the work's amounts, the friction's work, J, the steps, and whether a pad
   !> touched the journal.
   subroutine marched(inputs, start, tolerance, gap, flow, rubbed, steps, touched)
      type(case_type), intent(in) :: inputs
      real(wp), intent(in) :: start(:), tolerance
      real(wp), intent(out) :: gap, flow, rubbed, steps
      logical, intent(out) :: touched
      type(ledger), target :: model
      real(wp), allocatable :: y(:, :)
      integer(i8) :: count
      model%bearing = new_machine_model(inputs)
      model%n = model%bearing%n + 3
      allocate (y(model%n, 1))
      associate (n => model%bearing%n)
         ! work: of the order of the load times the clearance
         call march_samples(model, [model%bearing%scale, 1.0_wp, 1.0_wp, 1.0_wp], [tolerance, tolerance], &
            & [start, 0.0_wp, 0.0_wp, 0.0_wp], 6e-3_wp, 0.0_wp, y, count)
         gap = abs(sum(energy_of(model%bearing, y(:n, 1)) - energy_of(model%bearing, start)) - y(n + 1, 1))
         rubbed = y(n + 2, 1)
         flow = y(n + 3, 1)
      end associate
      touched = model%touched
      steps = real(count, wp)
   end subroutine marched
end program test_energy_balance
