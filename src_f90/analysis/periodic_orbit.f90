!> A periodic orbit of a bearing under its unbalance: a march brings it near, Newton's method on its collocation closes
!> it, and its multipliers say whether it is stable.
module periodic_orbit
   use kinds, only: wp, i8, pi
   use text, only: to_text
   use errors, only: error_type, raise, add_context, numerics_error, stopped
   use lapack, only: dgeev
   use cvode_integrator, only: integrator_type, integrator_options
   use equations_of_motion, only: bearing_model
   use damped_newton, only: asked_to_stop, asked
   use orbit_collocation, only: orbit_type, newton_round, points, place
   implicit none (type, external)
   private
   public :: periodic_orbit_type, orbit_options, find_periodic_orbit, set_multipliers

   type :: orbit_options
      !> Turns of the shaft in a period.
      integer :: revolutions = 1
      !> Newton's last correction over the scales; most rounds.
      real(wp) :: tolerance = 1e-8_wp
      integer :: max_iterations = 30
   end type orbit_options

   type :: periodic_orbit_type
      type(orbit_type) :: orbit
      !> Period, s.
      real(wp) :: period = 0
      !> Eigenvalues of the monodromy matrix, that of largest modulus first.
      complex(wp), allocatable :: multipliers(:)
      !> Rounds of Newton's method, periods marched before them, and evaluations of both.
      integer :: iterations = 0, marched = 0
      integer(i8) :: evaluations = 0
   contains
      procedure :: is_stable
      !> How stability is lost.
      procedure :: loss
   end type periodic_orbit_type

   !> A step of the march: its end, s, and the states at the points of Radau in it.
   type :: step_type
      real(wp) :: end = 0
      real(wp), allocatable :: at(:, :)
   end type step_type

   !> Newton's method is tried once the state changes by less than this over a period, over the scales, or after so many
   !> periods, and again when the march has doubled.
   real(wp), parameter :: near = 1e-3_wp
   integer, parameter :: first_try = 12, last_try = 96
   !> Correction at which the kinks of friction are known well enough, and the part of an interval that an end may be
   !> moved to one.
   real(wp), parameter :: kinks_known = 1e-5_wp
   real(wp), parameter :: beside = 0.3_wp
   !> Tolerance of the march over what is asked for: on its steps the collocation is that much more accurate.
   real(wp), parameter :: looser = 10
   !> Largest correction that is made, over the scales.
   real(wp), parameter :: longest = 0.5_wp

contains

   !> The periodic orbit that the motion from state y leads to. An error where Newton's method finds none, or, of status
   !> `stopped`, where `give_up` says so.
   subroutine find_periodic_orbit(model, march, options, y, found, error, give_up)
      type(bearing_model), intent(inout), target :: model
      !> Tolerances of a march; they choose the mesh.
      type(integrator_options), intent(in) :: march
      type(orbit_options), intent(in) :: options
      real(wp), intent(in) :: y(:)
      type(periodic_orbit_type), intent(out) :: found
      type(error_type), allocatable, intent(out) :: error
      procedure(asked_to_stop), optional :: give_up
      type(integrator_type) :: integrator
      type(integrator_options) :: mesh
      real(wp) :: change
      integer :: next_try
      found%period = options%revolutions*2*pi/model%point%speed(0.0_wp)
      mesh = march
      mesh%relative_tolerance = looser*march%relative_tolerance
      mesh%absolute_tolerance = looser*march%absolute_tolerance
      call integrator%start(model, mesh, 0.0_wp, y, last_try*found%period, error)
      next_try = first_try
      found%orbit%start = y
      found%orbit%scale = model%scale
      do while (.not. allocated(error))
         call march_period(integrator, model%n + model%outputs, found%marched, found%period, found%orbit, error)
         if (asked(give_up)) call raise(error, stopped, 'stopped while the periodic orbit was sought')
         if (allocated(error)) exit
         found%marched = found%marched + 1
         associate (orbit => found%orbit)
            change = maxval(abs(orbit%at(:, points, orbit%intervals()) - orbit%start)/model%scale)
         end associate
         if (change > near .and. found%marched < next_try) cycle
         next_try = 2*found%marched
         call close_orbit(model, options, found, error)
         if (.not. allocated(error)) return
         if (error%status == numerics_error .and. next_try <= last_try) deallocate (error)
      end do
      call add_context(error, 'no periodic orbit was found: after '//to_text(found%marched)//' periods')
   end subroutine find_periodic_orbit

   integer(i8) function integrator_evaluations(integrator)
      type(integrator_type), intent(in) :: integrator
      associate (counts => integrator%counts())
         integrator_evaluations = counts%rhs_evaluations + counts%jacobian_evaluations
      end associate
   end function integrator_evaluations

   !> Marches over period number `period` = 0, 1, .. from the state at the end of the orbit before; its steps become the
   !> intervals of the orbit.
   subroutine march_period(integrator, values, period, length, orbit, error)
      type(integrator_type), intent(inout) :: integrator
      !> States and outputs of the model.
      integer, intent(in) :: values, period
      real(wp), intent(in) :: length
      type(orbit_type), intent(inout) :: orbit
      type(error_type), allocatable, intent(out) :: error
      type(step_type), allocatable :: steps(:), longer(:)
      real(wp) :: all_values(values), t, before
      integer :: n, k, i
      if (allocated(orbit%at)) orbit%start = orbit%at(:, points, orbit%intervals())
      allocate (steps(64))
      n = 0
      before = 0
      do
         t = min(length, integrator%time() - period*length)
         if (t > before) then
            if (n == size(steps)) then
               allocate (longer(2*n))
               longer(:n) = steps
               call move_alloc(longer, steps)
            end if
            n = n + 1
            steps(n)%end = t
            allocate (steps(n)%at(size(orbit%start), points))
            do i = 1, points
               call integrator%interpolate(period*length + before + place(i)*(t - before), all_values)
               steps(n)%at(:, i) = all_values(:size(orbit%start))
            end do
            before = t
         end if
         if (t >= length) exit
         call integrator%step(error)
         if (allocated(error)) return
      end do
      if (allocated(orbit%time)) deallocate (orbit%time, orbit%at)
      allocate (orbit%time(0:n), orbit%at(size(orbit%start), points, n))
      orbit%time(0) = 0
      orbit%time(1:) = steps(:n)%end
      do k = 1, n
         orbit%at(:, :, k) = steps(k)%at
      end do
      orbit%correction = huge(orbit%correction)
   end subroutine march_period

   !> Newton's method on the collocation of an orbit, in the end with ends of intervals at the kinks of friction, where
   !> the polynomials would lose their order.
   subroutine close_orbit(model, options, found, error)
      type(bearing_model), intent(inout) :: model
      type(orbit_options), intent(in) :: options
      type(periodic_orbit_type), intent(inout) :: found
      type(error_type), allocatable, intent(out) :: error
      real(wp), allocatable :: mesh(:)
      logical :: ok
      found%iterations = 0
      if (.not. model%smooth()) then
         call converge(model, max(kinks_known, options%tolerance), options%max_iterations, found, error)
         if (allocated(error)) return
         call mesh_with_kinks(model, found%orbit, mesh)
         call found%orbit%change_mesh(mesh)
      end if
      call converge(model, options%tolerance, options%max_iterations, found, error)
      if (allocated(error)) return
      call set_multipliers(found%orbit%monodromy, found%multipliers, ok)
      if (.not. ok) call raise(error, numerics_error, 'the eigenvalues of the monodromy matrix were not found')
   end subroutine close_orbit

   !> Newton's method on a mesh.
   subroutine converge(model, tolerance, max_iterations, found, error)
      type(bearing_model), intent(inout) :: model
      real(wp), intent(in) :: tolerance
      integer, intent(in) :: max_iterations
      type(periodic_orbit_type), intent(inout) :: found
      type(error_type), allocatable, intent(out) :: error
      logical :: ok
      associate (orbit => found%orbit)
         do while (.not. orbit%correction <= tolerance)
            if (found%iterations == max_iterations) then
               call raise(error, numerics_error, 'after '//to_text(found%iterations)//' iterations Newton''s ' &
                  & //'correction is still '//to_text(orbit%correction))
               return
            end if
            call newton_round(model, orbit, longest, ok)
            found%iterations = found%iterations + 1
            found%evaluations = found%evaluations + points*orbit%intervals()
            if (.not. ok) then
               call raise(error, numerics_error, model%refusal)
               return
            end if
         end do
      end associate
   end subroutine converge

   !> The mesh of an orbit with an end of an interval where the pivot of a pad passes a kink of its friction: the end
   !> next to it is moved there, or a new one made.
   subroutine mesh_with_kinks(model, orbit, mesh)
      type(bearing_model), intent(in) :: model
      type(orbit_type), intent(in) :: orbit
      real(wp), allocatable, intent(out) :: mesh(:)
      real(wp), allocatable :: kinks(:)
      real(wp) :: t, moved(0:orbit%intervals())
      integer :: pad, i, k, state
      kinks = model%bearing%friction%kinks()
      if (.not. model%layout%tilting) kinks = [real(wp) ::]
      moved = orbit%time
      mesh = [real(wp) ::]
      do pad = 1, model%layout%pads
         if (size(kinks) == 0) exit
         state = model%layout%tilt_rate(pad)
         do i = 1, size(kinks)
            do k = 1, orbit%intervals()
               associate (rate => kinks(i)/model%bearing%pads(pad)%ball_radius, from => orbit%time(k - 1), &
                  & to => orbit%time(k))
                  if (.not. passes(orbit, state, rate, from, to)) cycle
                  t = passage(orbit, state, rate, from, to)
                  if (t - from < beside*(to - from) .and. k > 1) then
                     moved(k - 1) = t
                  else if (to - t < beside*(to - from) .and. k < orbit%intervals()) then
                     moved(k) = t
                  else
                     mesh = [mesh, t]
                  end if
               end associate
            end do
         end do
      end do
      mesh = sorted([moved, mesh])
   end subroutine mesh_with_kinks

   !> True where a state passes a value between two times, s.
   pure logical function passes(orbit, state, value, from, to)
      type(orbit_type), intent(in) :: orbit
      integer, intent(in) :: state
      real(wp), intent(in) :: value, from, to
      real(wp) :: before(size(orbit%start)), after(size(orbit%start))
      call orbit%state_at(from, before)
      call orbit%state_at(to, after)
      passes = (before(state) < value) .neqv. (after(state) < value)
   end function passes

   !> When it does so, s, by bisection.
   pure real(wp) function passage(orbit, state, value, from, to)
      type(orbit_type), intent(in) :: orbit
      integer, intent(in) :: state
      real(wp), intent(in) :: value, from, to
      real(wp) :: low, high
      integer :: i
      low = from
      high = to
      do i = 1, 50
         passage = 0.5_wp*(low + high)
         if (passes(orbit, state, value, low, passage)) then
            high = passage
         else
            low = passage
         end if
      end do
   end function passage

   !> Times in their order, without those that are next to another by rounding.
   pure function sorted(times)
      real(wp), intent(in) :: times(:)
      real(wp), allocatable :: sorted(:)
      real(wp) :: rest(size(times)), next
      integer :: k
      rest = times
      allocate (sorted(0))
      do k = 1, size(times)
         next = minval(rest)
         rest(minloc(rest)) = huge(next)
         if (k > 1) then
            if (next - sorted(size(sorted)) <= 1e-9_wp*maxval(times)) cycle
         end if
         sorted = [sorted, next]
      end do
   end function sorted

   !> The eigenvalues of a matrix, that of largest modulus first.
   subroutine set_multipliers(monodromy, values, ok)
      real(wp), intent(in) :: monodromy(:, :)
      complex(wp), allocatable, intent(out) :: values(:)
      logical, intent(out) :: ok
      real(wp) :: matrix(size(monodromy, 1), size(monodromy, 1)), re(size(monodromy, 1)), im(size(monodromy, 1))
      real(wp) :: work(8*size(monodromy, 1)), left(1, 1), right(1, 1)
      integer :: info, k, largest
      matrix = monodromy
      call dgeev('N', 'N', size(re), matrix, size(re), re, im, left, 1, right, 1, work, size(work), info)
      ok = info == 0
      if (.not. ok) return
      values = cmplx(re, im, wp)
      do k = 1, size(values) - 1
         largest = k - 1 + maxloc(abs(values(k:)), dim=1)
         values([k, largest]) = values([largest, k])
      end do
   end subroutine set_multipliers

   !> True where a small disturbance of the orbit dies out.
   pure logical function is_stable(self)
      class(periodic_orbit_type), intent(in) :: self
      is_stable = abs(self%multipliers(1)) < 1
   end function is_stable

   !> How an unstable orbit loses its stability, by its leading multiplier.
   pure function loss(self)
      class(periodic_orbit_type), intent(in) :: self
      character(len=:), allocatable :: loss
      associate (leading => self%multipliers(1))
         if (abs(leading%im) > 0) then
            loss = 'a second frequency grows'
         else if (leading%re < 0) then
            loss = 'the period doubles'
         else
            loss = 'it is left without oscillation'
         end if
      end associate
   end function loss
end module periodic_orbit
