!> Energy over a march: kinetic energy of journal and pads, their height, and what the pivots store change
!> by the work of films, unbalance and friction. That work is marched along as one more state.
module energy_ledger
   use kinds, only: wp, i8
   use errors, only: error_type
   use ode_model, only: ode_model_type
   use march_observer, only: march_observer_type
   use kinematics, only: pad_state
   use tilting_pad_bearing, only: pad_sample
   use equations_of_motion, only: bearing_model
   implicit none (type, external)
   private
   public :: ledger, energy_of, silent

   !> The bearing with the work done, the friction's share of it, and the sum of its amounts.
   type, extends(ode_model_type) :: ledger
      type(bearing_model) :: bearing
   contains
      procedure :: rhs => ledger_rhs
      procedure :: linearize => ledger_linearize
      procedure :: jacobian_times => ledger_times
      procedure :: solve => ledger_solve
   end type ledger

   type, extends(march_observer_type) :: silent
   contains
      procedure :: sample => no_sample
      procedure :: report => no_report
   end type silent

contains

   subroutine ledger_rhs(self, t, y, dydt, ok)
      class(ledger), intent(inout) :: self
      real(wp), intent(in) :: t, y(:)
      real(wp), intent(out) :: dydt(:)
      logical, intent(out) :: ok
      type(pad_sample), allocatable :: films(:)
      type(pad_state), allocatable :: pads(:)
      real(wp) :: power(4), film(2), frame(2, 2), a, speed, phase, weight
      integer :: pad
      associate (b => self%bearing, p => self%bearing%scene%pads, n => self%bearing%n)
         call b%rhs(t, y(:n), dydt(:n), ok)
         if (.not. ok) then
            self%refusal = b%refusal
            return
         end if
         films = b%sampled()
         pads = b%layout%pad_states(y)
         speed = b%point%speed(t)
         phase = b%point%shaft_angle(t)
         ! unbalance; films on journal and pads; friction; what eqs (3)-(4) hold beside a potential
         power = 0
         power(1) = b%point%unbalance*speed**2*(cos(phase)*y(3) + sin(phase)*y(4))
         do pad = 1, b%layout%pads
            associate (force => films(pad)%film_force)
               a = b%bearing%pads(pad)%position%angle - pads(pad)%tilt
               frame = reshape([cos(a), -sin(a), sin(a), cos(a)], [2, 2])
               film = matmul(frame, force)
               power(2) = power(2) + dot_product(film, y(3:4)) &
                  & - force(1)*b%bearing%pads(pad)%position%centre_distance*pads(pad)%tilt_rate
               power(3) = power(3) - films(pad)%friction_moment*pads(pad)%tilt_rate
               if (b%layout%radial) then
                  weight = p%mass(pad)*b%scene%rotor%gravity
                  power(2) = power(2) - force(2)*pads(pad)%penetration_rate
                  power(4) = power(4) + (p%mass(pad)*p%centre_radial(pad)*pads(pad)%tilt_rate**2 - weight*sin(a)) &
                     & *pads(pad)%penetration_rate
               end if
            end associate
         end do
         dydt(n + 1) = sum(power)
         dydt(n + 2) = power(3)
         dydt(n + 3) = sum(abs(power))
      end associate
   end subroutine ledger_rhs

   subroutine ledger_linearize(self, t, y, ok)
      class(ledger), intent(inout) :: self
      real(wp), intent(in) :: t, y(:)
      logical, intent(out) :: ok
      call self%bearing%linearize(t, y(:self%bearing%n), ok)
   end subroutine ledger_linearize

   !> The work acts back on nothing; its own rows are left out, which costs an iteration, not accuracy.
   subroutine ledger_times(self, v, jv)
      class(ledger), intent(inout) :: self
      real(wp), intent(in) :: v(:)
      real(wp), intent(out) :: jv(:)
      jv = 0
      call self%bearing%jacobian_times(v(:self%bearing%n), jv(:self%bearing%n))
   end subroutine ledger_times

   !> Without these rows too.
   subroutine ledger_solve(self, gamma, b, ok)
      class(ledger), intent(inout) :: self
      real(wp), intent(in) :: gamma
      real(wp), intent(inout) :: b(:)
      logical, intent(out) :: ok
      call self%bearing%solve(gamma, b(:self%bearing%n), ok)
   end subroutine ledger_solve

   !> Energy of a state: (kinetic of the journal, of the pads, height, stored in the pivots), J.
   function energy_of(bearing, y) result(energy)
      type(bearing_model), intent(in) :: bearing
      real(wp), intent(in) :: y(:)
      real(wp) :: energy(4), a
      type(pad_state), allocatable :: pads(:)
      integer :: pad
      energy = 0
      pads = bearing%layout%pad_states(y)
      associate (b => bearing, p => bearing%scene%pads, r => bearing%scene%rotor)
         energy(1) = 0.5_wp*r%mass*dot_product(y(3:4), y(3:4))
         energy(3) = r%mass*r%gravity*y(1) - dot_product(r%static_load, y(1:2))
         do pad = 1, b%layout%pads
            associate (state => pads(pad))
               a = b%bearing%pads(pad)%position%angle - state%tilt
               energy(2) = energy(2) + 0.5_wp*p%inertia(pad)*state%tilt_rate**2
               energy(3) = energy(3) + p%mass(pad)*r%gravity &
                  & *(p%centre_tangential(pad)*cos(a) + p%centre_radial(pad)*sin(a))
               if (b%layout%radial) then
                  energy(2) = energy(2) + p%mass(pad)*(0.5_wp*state%penetration_rate**2 &
                     & + p%centre_tangential(pad)*state%tilt_rate*state%penetration_rate)
                  energy(4) = energy(4) + stored(b, state%penetration)
               end if
            end associate
         end do
      end associate
   end function energy_of

   !> Work of pressing a pivot in, J: Simpson's rule in s with eta = s**2 depth, on the table's force. The
   !> integrand is smooth but for the seams of the table, where its second derivative jumps by 1e-3 of
   !> itself: an error below 1e-10 with 2000 intervals.
   real(wp) function stored(bearing, depth)
      type(bearing_model), intent(in) :: bearing
      real(wp), intent(in) :: depth
      integer, parameter :: n = 2000
      real(wp) :: s, force
      integer :: k
      stored = 0
      if (depth <= 0) return
      do k = 1, n
         s = real(k, wp)/n
         force = bearing%bearing%contact_force(s**2*depth)
         stored = stored + force*2*s*depth/n*merge(1.0_wp, merge(4.0_wp, 2.0_wp, mod(k, 2) == 1), k == n)/3
      end do
   end function stored

   subroutine no_sample(self, t, y, output, error)
      class(silent), intent(inout) :: self
      real(wp), intent(in) :: t, y(:), output(:)
      type(error_type), allocatable, intent(out) :: error
   end subroutine no_sample

   subroutine no_report(self, t, steps)
      class(silent), intent(inout) :: self
      real(wp), intent(in) :: t
      integer(i8), intent(in) :: steps
   end subroutine no_report
end module energy_ledger

program test_energy_balance
   use kinds, only: wp
   use text, only: to_text
   use errors, only: error_type
   use scene, only: scene_type
   use equations_of_motion, only: new_bearing_model
   use equilibrium, only: equilibrium_type, find_equilibrium
   use marching, only: march, march_options, sample_plan
   use integrator_counts, only: integrator_counts_type
   use energy_ledger, only: ledger, energy_of, silent
   use check, only: runs, expect, expect_no_error, report
   implicit none (type, external)

   if (runs('balance')) then
      call balance('tilting_radial', 'none', 0.0_wp)
      call balance('tilting_radial', 'none', 0.05_wp)
      call balance('tilting_radial', 'lugre', 0.05_wp)
      call balance('tilting_only', 'none', 0.05_wp)
   end if
   call report()

contains

   !> The paper's bearing with pads off their balance, let go from a displaced place.
   type(scene_type) function shaken_scene(motion, friction, unbalance) result(scene)
      character(len=*), intent(in) :: motion, friction
      real(wp), intent(in) :: unbalance
      scene = scene_type()
      scene%pads%motion = motion
      scene%pads%centre_tangential = [2e-3_wp, -3e-3_wp]
      scene%friction%model = friction
      scene%rotor%unbalance = unbalance
      scene%film%cavitation = 'none'
   end function shaken_scene

   !> Over 6 ms (two thirds of a revolution) the energy changes by the work done. A step's error is the
   !> tolerance, of every state in its own scale and of the work in that of the power that flows: with n steps
   !> the balance closes to n tolerances of the work's amounts, and closer with closer tolerance.
   subroutine balance(motion, friction, unbalance)
      character(len=*), intent(in) :: motion, friction
      real(wp), intent(in) :: unbalance
      real(wp) :: gap, coarse, flow, rubbed, steps
      character(len=:), allocatable :: what
      integer :: e
      what = motion//', '//friction//', unbalance '//to_text(unbalance)
      coarse = 0
      do e = -4, -8, -2
         call marched(shaken_scene(motion, friction, unbalance), 10.0_wp**e, gap, flow, rubbed, steps)
         call expect(gap < steps*10.0_wp**e*flow, 'energy balance at 1e'//to_text(e)//': '//to_text(gap)//' of ' &
            & //to_text(flow)//' J in '//to_text(steps)//' steps, '//what)
         if (e > -8) coarse = max(coarse, gap)
      end do
      ! errors of a single tolerance may cancel
      call expect(gap < 0.1_wp*coarse, 'a closer balance: '//to_text(gap)//' after '//to_text(coarse)//', '//what)
      if (friction == 'none') then
         call expect(abs(rubbed) <= 0, 'nothing rubs, '//what)
      else
         call expect(rubbed < 0, 'friction takes work: '//to_text(rubbed)//' J')
      end if
   end subroutine balance

   !> |change of energy - work|, the sum of the work's amounts, the friction's work, J, and the steps.
   subroutine marched(scene, tolerance, gap, flow, rubbed, steps)
      type(scene_type), intent(in) :: scene
      real(wp), intent(in) :: tolerance
      real(wp), intent(out) :: gap, flow, rubbed, steps
      type(ledger) :: model
      type(silent) :: observer
      type(equilibrium_type) :: static
      type(march_options) :: options
      type(integrator_counts_type) :: statistics
      type(error_type), allocatable :: error
      real(wp), allocatable :: y(:), start(:)
      call find_equilibrium(new_bearing_model(scene), static, error)
      call expect_no_error(error, 'the equilibrium is found')
      model%bearing = new_bearing_model(scene)
      model%n = model%bearing%n + 3
      associate (n => model%bearing%n)
         y = [model%bearing%at_rest(static%journal + [10e-6_wp, 5e-6_wp], static%tilt + [1e-4_wp, -5e-5_wp], &
            & static%penetration*[1.02_wp, 0.97_wp]), 0.0_wp, 0.0_wp, 0.0_wp]
         start = y
         options%relative_tolerance = tolerance
         ! work: of the order of the load times the clearance
         options%absolute_tolerance = tolerance*[model%bearing%scale, 1.0_wp, 1.0_wp, 1.0_wp]
         call march(model, options, 0.0_wp, 6e-3_wp, sample_plan(), y, observer, statistics, error)
         call expect_no_error(error, 'the march ends well')
         if (allocated(error)) call expect(.false., error%message)
         gap = abs(sum(energy_of(model%bearing, y(:n)) - energy_of(model%bearing, start(:n))) - y(n + 1))
         rubbed = y(n + 2)
         flow = y(n + 3)
      end associate
      steps = real(statistics%steps, wp)
   end subroutine marched
end program test_energy_balance
