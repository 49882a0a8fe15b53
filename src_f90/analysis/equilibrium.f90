!> Static equilibrium of journal and pads at constant speed: no unbalance, no friction.
!>
!> Newton's method, damped by the film's own squeeze damping: each iteration is one linearly implicit
!> Euler step of the motion without inertia, f(x, dx/dt) = 0, with a time step that grows as the
!> residual falls, so that it starts as a stable motion and ends as Newton's method.
module equilibrium
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   use text, only: to_text
   use errors, only: error_type, raise, numerics_error, stopped
   use scene, only: scene_type
   use contact_law, only: contact_law_type
   use contact_table, only: contact_table_type
   use kinematics, only: pad_frame, frame_of
   use components, only: new_law
   use equations_of_motion, only: bearing_model, new_bearing_model
   implicit none (type, external)
   private
   public :: equilibrium_type, find_equilibrium

   type :: equilibrium_type
      !> Journal, m; per pad tilt, rad, penetration, m (0 tilting-only), contact force, N.
      real(wp) :: journal(2) = 0
      real(wp), allocatable :: tilt(:), penetration(:), contact_force(:)
      !> Per pad least film thickness, m, and highest pressure, Pa.
      real(wp), allocatable :: min_film(:), max_pressure(:)
      !> Largest unbalanced force over the load.
      real(wp) :: residual = huge(1.0_wp)
      integer :: iterations = 0
   end type equilibrium_type

   real(wp), parameter :: residual_limit = 1e-8_wp
   integer, parameter :: max_iterations = 400
   !> Longest move of journal or pad edge in one iteration, in assembled clearances.
   real(wp), parameter :: longest_move = 0.2_wp
   !> Move below which an iteration without progress is the last.
   real(wp), parameter :: shortest_move = 1e-12_wp

   !> Places of the journal to start from, in assembled clearances down the load.
   real(wp), parameter :: fractions(*) = [-0.6_wp, -0.3_wp, 0.0_wp, 0.3_wp, 0.6_wp, 0.9_wp]

   abstract interface
      !> True once the search is to be given up.
      logical function asked_to_stop()
      end function asked_to_stop
   end interface

   interface
      !> LAPACK: solves a x = b.
      subroutine dgesv(n, nrhs, a, lda, ipiv, b, ldb, info)
         import :: wp
         integer, intent(in) :: n, nrhs, lda, ldb
         real(wp), intent(inout) :: a(lda, *), b(ldb, *)
         integer, intent(out) :: ipiv(*), info
      end subroutine dgesv
   end interface

contains

   !> The equilibrium of a scene at its initial speed; an error where none is found, or, of status `stopped`, where
   !> `give_up`, asked between evaluations of the films, says so. The table of its pivots' contact is made where it
   !> is not given.
   subroutine find_equilibrium(scene, found, error, contact, give_up)
      type(scene_type), intent(in) :: scene
      type(equilibrium_type), intent(out) :: found
      type(error_type), allocatable, intent(out) :: error
      type(contact_table_type), intent(in), optional :: contact
      procedure(asked_to_stop), optional :: give_up
      type(scene_type) :: whole_film
      type(bearing_model) :: model
      type(error_type), allocatable :: second_error
      real(wp), allocatable :: y(:)

      model = new_bearing_model(static_scene(scene), contact)
      y = best_start(model, give_up)
      call settle(model, y, found, error, give_up)
      if (.not. allocated(error) .or. scene%film%cavitation == 'none') return
      if (error%status == stopped) return
      ! on the way a pad may lose its film and with it all stiffness: take the way of a film that
      ! does not rupture, which has neither kinks nor slack
      whole_film = static_scene(scene)
      whole_film%film%cavitation = 'none'
      model = new_bearing_model(whole_film, contact)
      y = best_start(model, give_up)
      call settle(model, y, found, second_error, give_up)
      if (.not. allocated(second_error)) then
         model = new_bearing_model(static_scene(scene), contact)
         call settle(model, y, found, second_error, give_up)
      end if
      if (.not. allocated(second_error)) then
         deallocate (error)
      else if (second_error%status == stopped) then
         call move_alloc(second_error, error)
      end if
   end subroutine find_equilibrium

   !> Follows the motion without inertia from y to rest.
   subroutine settle(model, y, found, error, give_up)
      type(bearing_model), intent(inout) :: model
      real(wp), intent(inout) :: y(:)
      type(equilibrium_type), intent(out) :: found
      type(error_type), allocatable, intent(out) :: error
      procedure(asked_to_stop), optional :: give_up
      real(wp) :: slopes(model%n, model%n), f(model%n), f_trial(model%n), trial(model%n)
      real(wp) :: time_step, residual, move
      real(wp), allocatable :: step(:)
      integer, allocatable :: x(:), v(:)
      character(len=:), allocatable :: none_found
      logical :: ok, stuck

      none_found = 'no equilibrium found at '//to_text(model%scene%operation%speed_rpm)//' rpm: '
      stuck = .false.
      call unknowns(model, x, v)
      time_step = 1/model%scene%highest_speed()
      call model%rhs(0.0_wp, y, f, ok)
      if (.not. ok) then
         call raise(error, numerics_error, none_found//model%refusal//' at the start')
         return
      end if
      found%residual = residual_of(model, f)
      do while (.not. found%residual <= residual_limit)
         if (found%iterations == max_iterations .or. stuck) then
            call raise(error, numerics_error, none_found//'after '//to_text(found%iterations) &
               & //' iterations the unbalanced force is still '//to_text(found%residual)//' of the load')
            if (model%warning() /= '') error%message = error%message//'; '//model%warning()
            return
         end if
         found%iterations = found%iterations + 1
         if (asked(give_up)) then
            call raise(error, stopped, 'stopped while the equilibrium was sought')
            return
         end if
         call model%jacobian(0.0_wp, y, slopes, ok)
         do while (ok)
            call newton_step(model, slopes(v, x), slopes(v, v), f(v), time_step, step, ok)
            if (.not. all(ieee_is_finite(step))) ok = .false.
            if (.not. ok) exit
            move = maxval(abs(step/clearance_scale(model, x)))
            if (move <= longest_move) exit
            ! a shorter step in time, and not of its result, stays on the way of the motion
            time_step = time_step*min(0.5_wp, longest_move/move)
         end do
         if (.not. ok) then
            call raise(error, numerics_error, none_found//'the equations are singular, the unbalanced force is still ' &
               & //to_text(found%residual)//' of the load')
            return
         end if
         do
            trial = y
            trial(x) = y(x) + step
            call model%rhs(0.0_wp, trial, f_trial, ok)
            if (ok) exit
            step = 0.5_wp*step
            time_step = 0.5_wp*time_step
            if (maxval(abs(step/model%scale(x))) < epsilon(step)) then
               call raise(error, numerics_error, none_found//model%refusal)
               return
            end if
         end do
         residual = residual_of(model, f_trial)
         stuck = move < shortest_move .and. residual > 0.5_wp*found%residual
         time_step = time_step*max(0.3_wp, 1.5_wp*found%residual/max(residual, 0.15_wp*found%residual))
         y = trial
         f = f_trial
         found%residual = residual
      end do
      call describe(model, y, found)
   end subroutine settle

   logical function asked(give_up)
      procedure(asked_to_stop), optional :: give_up
      asked = .false.
      if (present(give_up)) asked = give_up()
   end function asked

   !> The start, among places along the load, with the smallest unbalanced force.
   function best_start(model, give_up) result(y)
      type(bearing_model), intent(inout) :: model
      procedure(asked_to_stop), optional :: give_up
      real(wp) :: y(model%n), trial(model%n), f(model%n), least
      integer :: i
      logical :: ok
      least = huge(least)
      y = start(model, 0.0_wp)
      do i = 1, size(fractions)
         if (asked(give_up)) exit
         trial = start(model, fractions(i))
         call model%rhs(0.0_wp, trial, f, ok)
         if (.not. ok) cycle
         if (residual_of(model, f) < least) then
            least = residual_of(model, f)
            y = trial
         end if
      end do
   end function best_start

   !> The same bearing without unbalance, friction and run-up, its film solved closely.
   pure function static_scene(scene) result(static)
      type(scene_type), intent(in) :: scene
      type(scene_type) :: static
      static = scene
      static%rotor%unbalance = 0
      static%rotor%balance_grade = -1
      static%operation%final_speed_rpm = scene%operation%speed_rpm
      static%friction%model = 'none'
      static%film%tolerance = min(scene%film%tolerance, 0.1_wp*residual_limit)
      static%film%max_sweeps = max(scene%film%max_sweeps, 100000)
   end function static_scene

   !> Indices of the positions and of their rates in the state.
   pure subroutine unknowns(model, x, v)
      type(bearing_model), intent(in) :: model
      integer, allocatable, intent(out) :: x(:), v(:)
      integer :: i
      x = [1, 2]
      v = [3, 4]
      do i = 1, size(model%places)
         x = [x, model%offset(i) + 1]
         v = [v, model%offset(i) + 2]
         if (model%radial) then
            x = [x, model%offset(i) + 3]
            v = [v, model%offset(i) + 4]
         end if
      end do
   end subroutine unknowns

   !> Journal a fraction of the clearance down the load, pivots carrying a share of it, and the pads
   !> tilted so that every film converges.
   function start(model, fraction) result(y)
      type(bearing_model), intent(in) :: model
      real(wp), intent(in) :: fraction
      real(wp) :: y(model%n)
      class(contact_law_type), allocatable :: law
      type(pad_frame) :: frame
      real(wp) :: load(2), penetration
      integer :: i
      y = 0
      penetration = 0
      load = model%scene%load()
      if (norm2(load) > 0) then
         y(1:2) = fraction*model%scene%bearing%assembled_clearance*load/norm2(load)
         if (model%radial) then
            law = new_law(model%scene)
            penetration = law%penetration(norm2(load)/size(model%places))
         end if
      end if
      do i = 1, size(model%places)
         frame = frame_of(model%places(i), y(1:2), 0.0_wp, penetration)
         y(model%offset(i) + 1) = (frame%along + model%scene%bearing%machined_clearance/3) &
            & /model%places(i)%centre_distance
         if (model%radial) y(model%offset(i) + 3) = penetration
      end do
   end function start

   !> Assembled clearance in the unit of each position (tilt: at the pad's edge).
   pure function clearance_scale(model, x) result(scale)
      type(bearing_model), intent(in) :: model
      integer, intent(in) :: x(:)
      real(wp) :: scale(size(x))
      integer :: i
      scale = model%scale(x)
      do i = 1, size(model%places)
         where (x == model%offset(i) + 3) scale = model%scene%bearing%assembled_clearance
      end do
   end function clearance_scale

   !> Solves (K + C / time step) step = -f.
   subroutine newton_step(model, stiffness, damping, f, time_step, step, ok)
      type(bearing_model), intent(in) :: model
      real(wp), intent(in) :: stiffness(:, :), damping(:, :), f(:), time_step
      real(wp), allocatable, intent(out) :: step(:)
      logical, intent(out) :: ok
      real(wp) :: matrix(size(f), size(f))
      integer :: pivots(size(f)), info, i
      matrix = stiffness + damping/time_step
      ! a trace of damping for pads whose film has ruptured everywhere
      do i = 1, size(f)
         matrix(i, i) = matrix(i, i) - 1e-3_wp*model%scene%highest_speed()/time_step
      end do
      step = -f
      call dgesv(size(f), 1, matrix, size(f), pivots, step, size(f), info)
      ok = info == 0
   end subroutine newton_step

   !> Largest unbalanced force over the load (or, without load, over the heaviest pad, or 1 N).
   pure real(wp) function residual_of(model, f)
      type(bearing_model), intent(in) :: model
      real(wp), intent(in) :: f(:)
      integer :: i, o
      associate (pads => model%scene%pads, rotor => model%scene%rotor)
         residual_of = rotor%mass*norm2(f(3:4))
         do i = 1, size(model%places)
            o = model%offset(i)
            residual_of = max(residual_of, abs(f(o + 2))*pads%inertia(i)/model%places(i)%centre_distance)
            if (model%radial) residual_of = max(residual_of, abs(f(o + 4))*pads%mass(i))
         end do
         residual_of = residual_of/max(norm2(model%scene%load()), maxval(pads%mass)*rotor%gravity, 1.0_wp)
      end associate
   end function residual_of

   !> Fills the record from the last evaluation, which was at y.
   pure subroutine describe(model, y, found)
      type(bearing_model), intent(in) :: model
      real(wp), intent(in) :: y(:)
      type(equilibrium_type), intent(inout) :: found
      integer :: i
      found%journal = y(1:2)
      found%tilt = [(y(model%offset(i) + 1), i=1, size(model%places))]
      found%penetration = spread(0.0_wp, 1, size(model%places))
      if (model%radial) found%penetration = [(y(model%offset(i) + 3), i=1, size(model%places))]
      found%contact_force = model%loads%contact
      found%min_film = model%response%min_film
      found%max_pressure = model%response%max_pressure
   end subroutine describe
end module equilibrium
