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
   use lapack, only: dgesv
   use operating_point, only: operating_point_type
   use kinematics, only: journal_motion, pad_frame, pad_state
   use tilting_pad_bearing, only: pad_sample
   use equations_of_motion, only: bearing_model
   use force_balance, only: forces, force_derivatives, masses
   implicit none (type, external)
   private
   public :: equilibrium_type, find_equilibrium

   type :: equilibrium_type
      !> Journal, m; per pad tilt, rad, penetration, m (0 tilting-only), contact force, N.
      real(wp) :: journal(2) = 0
      real(wp), allocatable :: tilt(:), penetration(:), contact_force(:)
      !> Per pad minimum film thickness, m, and maximum pressure, Pa.
      real(wp), allocatable :: min_film_thickness(:), max_pressure(:)
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
   !> Accuracy of films that are solved by iteration: below the residual limit.
   real(wp), parameter :: film_tolerance = 0.1_wp*residual_limit
   integer, parameter :: film_sweeps = 100000

   !> Positions of the journal to start from, in assembled clearances down the load.
   real(wp), parameter :: fractions(*) = [-0.6_wp, -0.3_wp, 0.0_wp, 0.3_wp, 0.6_wp, 0.9_wp]

   abstract interface
      !> True once the search is to be given up.
      logical function asked_to_stop()
      end function asked_to_stop
   end interface

contains

   !> The equilibrium of a model under its load at its initial speed; an error where none is found, or, of status
   !> `stopped`, where `give_up`, asked between evaluations of the films, says so.
   subroutine find_equilibrium(model, found, error, give_up)
      type(bearing_model), intent(in) :: model
      type(equilibrium_type), intent(out) :: found
      type(error_type), allocatable, intent(out) :: error
      procedure(asked_to_stop), optional :: give_up
      type(bearing_model) :: static
      type(error_type), allocatable :: second_error
      real(wp), allocatable :: y(:)

      static = static_model(model, model%point%rupture)
      y = best_start(static, give_up)
      call follow_motion(static, y, found, error, give_up)
      if (.not. allocated(error) .or. .not. static%bearing%films_rupture()) return
      if (error%status == stopped) return
      ! on the way a pad may lose its film and with it all stiffness; films that are kept whole lead to an equilibrium
      ! of their own, which is the start of a second search
      static = static_model(model, .false.)
      y = best_start(static, give_up)
      call follow_motion(static, y, found, second_error, give_up)
      if (.not. allocated(second_error)) then
         static = static_model(model, model%point%rupture)
         call follow_motion(static, y, found, second_error, give_up)
      end if
      if (.not. allocated(second_error)) then
         deallocate (error)
      else if (second_error%status == stopped) then
         call move_alloc(second_error, error)
      end if
   end subroutine find_equilibrium

   !> A copy of the model at the static operating point, its films solved closely.
   function static_model(model, rupture) result(static)
      type(bearing_model), intent(in) :: model
      logical, intent(in) :: rupture
      type(bearing_model) :: static
      type(operating_point_type) :: point
      point = model%point%static()
      point%rupture = rupture
      static = model
      call static%set_point(point)
      call static%bearing%set_accuracy(film_tolerance, film_sweeps)
   end function static_model

   !> Follows the motion without inertia from y to rest.
   subroutine follow_motion(model, y, found, error, give_up)
      type(bearing_model), intent(inout) :: model
      real(wp), intent(inout) :: y(:)
      type(equilibrium_type), intent(out) :: found
      type(error_type), allocatable, intent(out) :: error
      procedure(asked_to_stop), optional :: give_up
      real(wp) :: time_step, residual, move
      real(wp), allocatable :: step(:)
      character(len=:), allocatable :: none_found
      logical :: ok, stuck

      none_found = 'no equilibrium found at '//to_text(model%point%speed_rpm)//' rpm: '
      stuck = .false.
      time_step = 1/model%point%speed(0.0_wp)
      call model%evaluate(0.0_wp, y, .false., ok)
      if (.not. ok) then
         call raise(error, numerics_error, none_found//model%refusal//' at the start')
         return
      end if
      found%residual = residual_of(model)
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
         call find_step(model, y, time_step, step, move, ok)
         if (.not. ok) then
            call raise(error, numerics_error, none_found//'the equations are singular, the unbalanced force is still ' &
               & //to_text(found%residual)//' of the load')
            return
         end if
         call take_step(model, y, time_step, step, ok)
         if (.not. ok) then
            call raise(error, numerics_error, none_found//model%refusal)
            return
         end if
         residual = residual_of(model)
         stuck = move < shortest_move .and. residual > 0.5_wp*found%residual
         time_step = time_step*max(0.3_wp, 1.5_wp*found%residual/max(residual, 0.15_wp*found%residual))
         found%residual = residual
      end do
      call describe(model, y, found)
   end subroutine follow_motion

   !> The step of the positions from y, in a time step that is shortened until nothing moves too far. `ok` is false
   !> where the equations are singular.
   subroutine find_step(model, y, time_step, step, move, ok)
      type(bearing_model), intent(inout) :: model
      real(wp), intent(in) :: y(:)
      real(wp), intent(inout) :: time_step
      real(wp), allocatable, intent(out) :: step(:)
      !> Longest move, in assembled clearances.
      real(wp), intent(out) :: move
      logical, intent(out) :: ok
      real(wp), dimension(model%layout%n_positions(), model%layout%n_positions()) :: stiffness, damping
      move = 0
      call model%evaluate(0.0_wp, y, .true., ok)
      if (ok) call force_derivatives(model, stiffness, damping)
      do while (ok)
         call newton_step(model, stiffness, damping, forces(model, 0.0_wp), time_step, step, ok)
         if (.not. all(ieee_is_finite(step))) ok = .false.
         if (.not. ok) exit
         move = maxval(abs(step/clearances(model)))
         if (move <= longest_move) exit
         ! a shorter time step follows the path of the motion; a part of the step would leave it
         time_step = time_step*min(0.5_wp, longest_move/move)
      end do
   end subroutine find_step

   !> Moves y by the step, or by a part of it that the model admits, and evaluates the model there. `ok` is false
   !> where it admits none.
   subroutine take_step(model, y, time_step, step, ok)
      type(bearing_model), intent(inout) :: model
      real(wp), intent(inout) :: y(:), time_step, step(:)
      logical, intent(out) :: ok
      real(wp) :: trial(model%n)
      integer, allocatable :: x(:)
      x = model%layout%positions()
      do
         trial = y
         trial(x) = y(x) + step
         call model%evaluate(0.0_wp, trial, .false., ok)
         if (ok) exit
         step = 0.5_wp*step
         time_step = 0.5_wp*time_step
         if (maxval(abs(step/clearances(model))) < epsilon(step)) return
      end do
      y = trial
   end subroutine take_step

   logical function asked(give_up)
      procedure(asked_to_stop), optional :: give_up
      asked = .false.
      if (present(give_up)) asked = give_up()
   end function asked

   !> The start, among positions along the load, with the smallest unbalanced force.
   function best_start(model, give_up) result(y)
      type(bearing_model), intent(inout) :: model
      procedure(asked_to_stop), optional :: give_up
      real(wp) :: y(model%n), trial(model%n), smallest, residual
      integer :: i
      logical :: ok
      smallest = huge(smallest)
      y = start(model, 0.0_wp)
      do i = 1, size(fractions)
         if (asked(give_up)) exit
         trial = start(model, fractions(i))
         call model%evaluate(0.0_wp, trial, .false., ok)
         if (.not. ok) cycle
         residual = residual_of(model)
         if (residual < smallest) then
            smallest = residual
            y = trial
         end if
      end do
   end function best_start

   !> Journal a fraction of the clearance down the load, pivots carrying a share of it, and the pads
   !> tilted so that every film converges.
   function start(model, fraction) result(y)
      type(bearing_model), intent(in) :: model
      real(wp), intent(in) :: fraction
      real(wp) :: y(model%n)
      type(journal_motion) :: journal
      type(pad_state) :: pads(model%layout%pads)
      type(pad_frame) :: frame
      integer :: i
      associate (load => model%point%load, bearing => model%scene%bearing)
         if (norm2(load) > 0) then
            journal%position = fraction*bearing%assembled_clearance*load/norm2(load)
            if (model%layout%radial) pads%penetration = model%bearing%penetration(norm2(load)/size(pads))
         end if
         do i = 1, size(pads)
            frame = model%bearing%pads(i)%frame(journal, pads(i))
            pads(i)%tilt = (frame%along + bearing%machined_clearance/3)/model%bearing%pads(i)%position%centre_distance
         end do
      end associate
      y = model%state(journal, pads)
   end function start

   !> Assembled clearance in the unit of each position (tilt: at the pad's edge).
   pure function clearances(model)
      type(bearing_model), intent(in) :: model
      real(wp), allocatable :: clearances(:)
      real(wp) :: scale(model%n)
      integer :: i
      scale = model%scale
      if (model%layout%radial) scale(model%layout%penetration([(i, i=1, model%layout%pads)])) &
         & = model%scene%bearing%assembled_clearance
      clearances = scale(model%layout%positions())
   end function clearances

   !> Solves (K + C / time step) step = -f with the forces f and their derivatives, K over positions and C over rates.
   subroutine newton_step(model, stiffness, damping, f, time_step, step, ok)
      type(bearing_model), intent(in) :: model
      real(wp), intent(in) :: stiffness(:, :), damping(:, :), f(:), time_step
      real(wp), allocatable, intent(out) :: step(:)
      logical, intent(out) :: ok
      real(wp) :: matrix(size(f), size(f))
      integer :: pivots(size(f)), info
      ! with a trace of damping for pads whose film has ruptured everywhere
      matrix = stiffness + (damping - 1e-3_wp*model%point%speed(0.0_wp)*masses(model))/time_step
      step = -f
      call dgesv(size(f), 1, matrix, size(f), pivots, step, size(f), info)
      ok = info == 0
   end subroutine newton_step

   !> Largest unbalanced force in the state evaluated last over the load (or, without load, over the heaviest pad, or
   !> 1 N).
   pure real(wp) function residual_of(model)
      type(bearing_model), intent(in) :: model
      real(wp) :: force(model%layout%n_positions())
      force = forces(model, 0.0_wp)
      associate (pads => model%bearing%pads, loads => model%bearing%loads)
         residual_of = max(norm2(force(:model%layout%rotor/2)), &
            & maxval(abs(loads%moment)/pads%position%centre_distance))
         if (model%layout%radial) residual_of = max(residual_of, maxval(abs(loads%radial)))
         residual_of = residual_of/max(norm2(model%point%load), maxval(pads%weight), 1.0_wp)
      end associate
   end function residual_of

   !> Fills the record from the last evaluation, which was at y.
   subroutine describe(model, y, found)
      type(bearing_model), intent(inout) :: model
      real(wp), intent(in) :: y(:)
      type(equilibrium_type), intent(inout) :: found
      type(journal_motion) :: journal
      type(pad_state) :: pads(model%layout%pads)
      type(pad_sample) :: samples(model%layout%pads)
      journal = model%rotor%journal(y(:model%rotor%states))
      pads = model%layout%pad_states(y)
      samples = model%sampled()
      found%journal = journal%position
      found%tilt = pads%tilt
      found%penetration = pads%penetration
      found%contact_force = samples%contact_force
      found%min_film_thickness = samples%min_film_thickness
      found%max_pressure = samples%max_pressure
   end subroutine describe
end module equilibrium
