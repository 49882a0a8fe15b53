!> What is common to searches of an equilibrium: the model without unbalance and friction, its way to equilibrium from
!> nearby, by pseudo-transient continuation, and where the searches start.
module static_model
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   use operating_point, only: operating_point_type
   use factories, only: converged_films, quick_films
   use rigid_rotor, only: journal_motion
   use state_layout, only: pad_state, tilt, pivot_deflection
   use kinematics, only: pad_frame, frame_of, in_mirror
   use sloped_bearing, only: align_pad
   use equations_of_motion, only: machine_model, new_machine_model
   use errors, only: error_type, stopped, raise, numerics_error, asked
   use text, only: to_text
   use linear_algebra, only: solve
   use abstract_element, only: element_pointer
   use force_balance, only: forces, force_derivatives, masses
   implicit none (type, external)
   private
   public :: make_static, make_quick, make_fine, solve_equilibrium, start, starts, placed, follow_motion, &
      & unbalanced, reference_force, clearances, next_time_step, residual_limit, newtons, longest_move, &
      & shortest_move, trace, set_free, static_derivatives, newton_step

   !> Unbalanced force over the reference force that leaps of cavitated films may leave.
   real(wp), parameter :: largest_leap = 1e-5_wp

   !> Positions of the journal to start from, in bearing clearances down the load.
   real(wp), parameter :: fractions(*) = [-0.6_wp, -0.3_wp, 0.0_wp, 0.3_wp, 0.6_wp, 0.9_wp]
   integer, parameter :: starts = size(fractions)

   !> Unbalanced force over the reference force in equilibrium.
   real(wp), parameter :: residual_limit = 1e-8_wp
   !> First time step, in radians of the shaft, that makes this Newton's own method.
   real(wp), parameter :: newtons = 1e6_wp
   !> Of 709 searches with this limit that succeed in the bearings of docs/stability.md, *Searches of an equilibrium*,
   !> 90 % end within 131 and 99.5 % within 360.
   integer, parameter :: max_iterations = 400
   !> Longest move of journal or pad edge in one iteration, in bearing clearances. Of 250 bearings half of it loses
   !> three; the double finds one more in 1.2 times the time.
   real(wp), parameter :: longest_move = 0.2_wp
   !> Move below which an iteration without progress is the last; up to 1e-9 the 250 bearings come out the same.
   real(wp), parameter :: shortest_move = 1e-12_wp
   !> Trace of damping for pads whose film has cavitated everywhere, over mass and speed. A tenth of it loses one of
   !> the 250, ten times as much none.
   real(wp), parameter :: trace = 1e-3_wp

contains

   !> A copy of the model at the static operating point, its films solved closely.
   subroutine make_static(model, cavitation, static)
      type(machine_model), intent(in) :: model
      logical, intent(in) :: cavitation
      type(machine_model), intent(out) :: static
      integer :: b
      static = model
      call stand_still(static, cavitation)
      do b = 1, size(static%bearings)
         call static%bearings(b)%use_in_statics(static%inputs, b)
      end do
   end subroutine make_static

   subroutine stand_still(model, cavitation)
      type(machine_model), intent(inout) :: model
      logical, intent(in) :: cavitation
      type(operating_point_type) :: point
      point = model%point%static()
      point%cavitation = cavitation
      call model%set_point(point)
   end subroutine stand_still

   !> The same as a static model with quick films, which are nearly the case's.
   subroutine make_quick(static, quick)
      type(machine_model), intent(in) :: static
      type(machine_model), intent(out) :: quick
      quick = new_machine_model(static%inputs, quick_films, static%others, static%rotor)
      quick%give_up => static%give_up
      call stand_still(quick, static%point%cavitation)
      quick%oil%viscosity = static%oil%viscosity
   end subroutine make_quick

   !> The same with films that are converged, where the case leaves their solver to the program.
   subroutine make_fine(model, fine)
      type(machine_model), intent(in) :: model
      type(machine_model), intent(out) :: fine
      fine = new_machine_model(model%inputs, converged_films, model%others, model%rotor)
      fine%give_up => model%give_up
      call stand_still(fine, model%point%cavitation)
   end subroutine make_fine

   !> Brings a state that is near equilibrium to equilibrium by Newton's method. Volumes of cavitated films make their
   !> force leap by less than its error; where the equilibrium lies in a leap, y ends beside it.
   subroutine solve_equilibrium(model, y, residual, error, held, most)
      type(machine_model), intent(inout) :: model
      real(wp), intent(inout) :: y(:)
      real(wp), intent(out) :: residual
      type(error_type), allocatable, intent(out) :: error
      !> Pads that are held where they are.
      logical, intent(in), optional :: held(:)
      !> Iterations at most, if they are fewer than usual.
      integer, intent(in), optional :: most
      logical :: ok
      call follow_motion(model, y, residual, error, held, newtons, most)
      if (.not. allocated(error) .or. residual > largest_leap) return
      if (error%status == stopped) return
      call model%evaluate(0.0_wp, y, .false., ok)
      if (ok) deallocate (error)
   end subroutine solve_equilibrium

   !> Start k: the journal at its fraction of the clearance down the load (among fixed pads from the middle of their
   !> bores), pivots carrying a share of it, and pads that tilt tilted so that every film converges.
   function start(model, k) result(y)
      type(machine_model), intent(in) :: model
      integer, intent(in) :: k
      real(wp) :: y(model%n), place(2)
      place = 0
      associate (load => model%point%load)
         if (norm2(load) > 0) place = fractions(k)*model%bearings(1)%clearance*load/norm2(load)
      end associate
      if (.not. model%layout%elements(1)%has(tilt)) place = place + middle_of_bores(model)
      y = placed(model, place)
   end function start

   !> The journal at this place, m, pivots carrying a share of the load, and pads that tilt tilted so that every film
   !> converges.
   function placed(model, place) result(y)
      type(machine_model), intent(in) :: model
      real(wp), intent(in) :: place(2)
      real(wp) :: y(model%n)
      type(journal_motion) :: journal
      type(pad_state) :: pads(model%layout%pads)
      type(pad_frame) :: frame
      real(wp) :: deflection
      integer :: i
      journal%position = place
      do i = 1, size(pads)
         if (model%layout%elements(1)%has(pivot_deflection) .and. norm2(model%point%load) > 0) then
            if (.not. repeats(i)) deflection = model%bearings(1)%pivots(i)%contact%law%pivot_deflection( &
               & norm2(model%point%load)/size(pads))
            pads(i)%x(pivot_deflection) = deflection
         end if
         associate (position => model%bearings(1)%pads(i)%position)
            frame = frame_of(position, journal, pads(i))
            pads(i)%x(tilt) = (frame%along + model%inputs%bearings(1)%machined_clearance(i)/3)/position%centre_distance
         end associate
         call align_pad(model%bearings(1), i, journal, pads(i))
      end do
      y = model%state(journal, pads)
   contains
      !> Whether a pad's pivot is that of the pad before.
      pure logical function repeats(pad)
         integer, intent(in) :: pad
         repeats = pad > 1
         associate (pivot => model%inputs%bearings(1)%pivot)
            if (repeats) repeats = pivot%is_like(pad, pivot, pad - 1)
         end associate
      end function repeats
   end function placed

   !> The mean of the places, m, at which the journal lies in the middle of a pad's bore, among pads without tilt.
   pure function middle_of_bores(model) result(middle)
      type(machine_model), intent(in) :: model
      real(wp) :: middle(2)
      associate (pads => model%bearings(1)%pads, &
         & out => model%inputs%bearings(1)%machined_clearance - model%inputs%bearings(1)%assembled_clearance)
         ! equal pads add nothing to the first term
         middle = -out(1)/size(pads)*[sum(pads%position%sin_angle), sum(pads%position%cos_angle)] &
            & - [dot_product(out - out(1), pads%position%sin_angle), &
            & dot_product(out - out(1), pads%position%cos_angle)]/size(pads)
         middle = in_mirror(pads(1)%position%mirrored, middle)
      end associate
   end function middle_of_bores

   ! Pseudo-transient continuation: brings a model to equilibrium by Newton's method, damped by the film's own squeeze
   ! damping: each iteration is one linearly implicit Euler step of the motion without inertia, f(x, dx/dt) = 0, with a
   ! time step that grows as the residual falls, so that it starts as a stable motion and ends as Newton's method.

   !> Follows the motion without inertia from y to equilibrium, where y is then. An error says why it did not come to
   !> equilibrium, or, of status `stopped`, that `give_up` of the model, asked between evaluations of films, said so.
   subroutine follow_motion(model, y, residual, error, held, first_step, most)
      type(machine_model), intent(inout) :: model
      real(wp), intent(inout) :: y(:)
      !> Largest unbalanced force over the reference force.
      real(wp), intent(out) :: residual
      type(error_type), allocatable, intent(out) :: error
      !> Pads that are held where they are.
      logical, intent(in), optional :: held(:)
      !> Time step to begin with, in radians of the shaft; 1 if it is left out.
      real(wp), intent(in), optional :: first_step
      !> Iterations at most, if they are fewer than usual.
      integer, intent(in), optional :: most
      !> Largest unbalanced force, N, and the next; longest move of a step, in bearing clearances.
      real(wp) :: time_step, force, next, move
      real(wp), allocatable :: step(:)
      logical :: ok, stuck, differentiated, free(model%layout%n_positions())
      integer :: iterations, limit
      limit = max_iterations
      if (present(most)) limit = min(limit, most)
      call set_free(model, held, free)
      stuck = .false.
      time_step = 1/model%point%speed(0.0_wp)
      if (present(first_step)) time_step = first_step*time_step
      residual = huge(residual)
      differentiated = .true.
      call model%evaluate(0.0_wp, y, differentiated, ok)
      if (.not. ok) call raise(error, numerics_error, model%refusal//' at the start')
      if (.not. ok) return
      force = unbalanced(model, y, free)
      residual = force/max(tiny(force), reference_force(model))
      iterations = 0
      do while (.not. residual <= residual_limit)
         if (iterations == limit .or. stuck) then
            call raise(error, numerics_error, last_words())
         else if (asked(model%give_up)) then
            call raise(error, stopped, 'stopped while the equilibrium was sought')
         else
            iterations = iterations + 1
            call find_step()
         end if
         if (.not. allocated(error)) call take_step()
         if (allocated(error)) return
         next = unbalanced(model, y, free)
         stuck = move < shortest_move .and. next > 0.5_wp*force
         time_step = next_time_step(time_step, force, next)
         force = next
         residual = force/max(tiny(force), reference_force(model))
      end do

   contains

      !> What is said of a search that does not end.
      function last_words()
         character(len=:), allocatable :: last_words
         last_words = 'after '//to_text(iterations)//' iterations the unbalanced force is still '//shown(model, force)
         if (model%warning() /= '') last_words = last_words//'; '//model%warning()
      end function last_words

      !> The step of the positions from y, in a time step that is shortened until nothing moves too far. An error
      !> where the equations are singular.
      subroutine find_step()
         real(wp), dimension(size(free), size(free)) :: stiffness, damping
         move = 0
         ok = .true.
         if (.not. differentiated) call model%evaluate(0.0_wp, y, .true., ok)
         if (ok) call static_derivatives(model, stiffness, damping)
         do while (ok)
            call newton_step(stiffness, damping, forces(model, 0.0_wp, y), free, time_step, step, ok)
            if (.not. all(ieee_is_finite(step))) ok = .false.
            if (.not. ok) exit
            move = maxval(abs(step/clearances(model)))
            if (move <= longest_move) exit
            ! a shorter time step follows the path of the motion; a part of the step would leave it
            time_step = time_step*min(0.5_wp, longest_move/move)
         end do
         if (.not. ok) call raise(error, numerics_error, 'the equations are singular, the unbalanced force is still ' &
            & //shown(model, force))
      end subroutine find_step

      !> Moves y by the step, or by a part of it that the model admits, and evaluates the model there, with the
      !> derivatives that the next step needs: there is hardly one after a step whose square, as the error after a step
      !> of Newton's method, is below the limit of the residual. An error where the model admits none.
      subroutine take_step()
         real(wp) :: trial(model%n)
         integer, allocatable :: x(:)
         x = model%layout%positions()
         differentiated = move**2 > residual_limit
         do
            trial = y
            trial(x) = y(x) + step
            call model%evaluate(0.0_wp, trial, differentiated, ok)
            if (ok) exit
            step = 0.5_wp*step
            time_step = 0.5_wp*time_step
            if (.not. maxval(abs(step/clearances(model))) < epsilon(step)) cycle
            call raise(error, numerics_error, model%refusal)
            return
         end do
         y = trial
      end subroutine take_step
   end subroutine follow_motion

   !> "12.5 N, 0.02 of the load".
   function shown(model, force)
      type(machine_model), intent(in) :: model
      !> N
      real(wp), intent(in) :: force
      character(len=:), allocatable :: shown
      shown = to_text(force)//' N'
      associate (load => largest_load(model))
         if (load > 0) shown = shown//', '//to_text(force/load)//' of the load'
      end associate
   end function shown

   !> Largest load of a bearing, N; without films all forces on the rotor.
   pure real(wp) function largest_load(model)
      type(machine_model), intent(in) :: model
      real(wp) :: still(model%rotor%states)
      if (size(model%bearings) > 0) then
         largest_load = maxval(norm2(model%rotor%loads(model%point), dim=1))
      else
         still = 0
         associate (n => model%rotor%positions)
            largest_load = norm2(model%rotor%force(still, model%point%static(), 0.0_wp)*model%scale(:n)) &
               & /model%least_clearance()
         end associate
      end if
   end function largest_load

   !> The time step after one that took the unbalanced force from `last` to `now`: longer as it falls.
   elemental real(wp) function next_time_step(time_step, last, now)
      real(wp), intent(in) :: time_step, last, now
      next_time_step = time_step*max(0.3_wp, 1.5_wp*last/max(now, 0.15_wp*last, tiny(now)))
   end function next_time_step

   !> The positions that move: all but those of pads that are held.
   pure subroutine set_free(model, held, free)
      type(machine_model), intent(in) :: model
      logical, intent(in), optional :: held(:)
      logical, intent(out) :: free(:)
      integer :: b, i
      free = .true.
      if (.not. present(held)) return
      do b = 1, size(model%layout%elements)
         associate (of => model%layout%elements(b))
            do i = 1, of%pads
               free(of%own_positions(i)) = .not. held(of%first_pad + i - 1)
            end do
         end associate
      end do
   end subroutine set_free

   !> Bearing clearance in the unit of each position (tilt: at the pad's edge).
   function clearances(model)
      type(machine_model), intent(in), target :: model
      real(wp), allocatable :: clearances(:)
      type(element_pointer), allocatable :: elements(:)
      integer :: e, i, k, at
      clearances = model%scale(model%layout%positions())
      elements = model%elements()
      do e = 1, size(elements)
         associate (of => model%layout%elements(e))
            do i = 1, of%pads
               do k = 1, of%coordinates
                  at = of%first_position(i) + k - 1
                  clearances(at) = elements(e)%to%clearance_of(k, clearances(at))
               end do
            end do
         end associate
      end do
   end function clearances

   !> Derivatives of the forces over positions and, with the trace of damping, rates, in the state evaluated last.
   subroutine static_derivatives(model, stiffness, damping)
      type(machine_model), intent(in) :: model
      real(wp), intent(out) :: stiffness(:, :), damping(:, :)
      call force_derivatives(model, stiffness, damping, at_rest=.true.)
      damping = damping - trace*model%point%speed(0.0_wp)*masses(model)
   end subroutine static_derivatives

   !> Solves (K + C / time step) step = -f with the forces f and their derivatives, K over positions and C over rates.
   subroutine newton_step(stiffness, damping, f, free, time_step, step, ok)
      real(wp), intent(in) :: stiffness(:, :), damping(:, :), f(:), time_step
      logical, intent(in) :: free(:)
      real(wp), allocatable, intent(out) :: step(:)
      logical, intent(out) :: ok
      real(wp) :: matrix(size(f), size(f))
      integer :: i
      matrix = stiffness + damping/time_step
      step = -f
      do i = 1, size(f)
         if (free(i)) cycle
         matrix(i, :) = 0
         matrix(i, i) = 1
         step(i) = 0
      end do
      call solve(size(f), 1, matrix, step, ok)
   end subroutine newton_step

   !> Largest unbalanced force in the state y, which was evaluated last, N, at positions that are free; those of a rotor
   !> that are no displacements by what these do at a displacement of a clearance.
   real(wp) function unbalanced(model, y, free)
      type(machine_model), intent(in) :: model
      real(wp), intent(in) :: y(:)
      logical, intent(in), optional :: free(:)
      real(wp) :: force(model%layout%n_positions())
      force = forces(model, 0.0_wp, y)
      force(model%rotor%positions + 1:) = force(model%rotor%positions + 1:)/model%own_lengths()
      if (present(free)) force = merge(force, 0.0_wp, free)
      associate (rotor => model%rotor%positions)
         force(:rotor) = force(:rotor)*(model%scale(:rotor)/model%least_clearance())
         unbalanced = max(norm2(force(:rotor)), maxval(abs(force(rotor + 1:))))
      end associate
   end function unbalanced

   !> What unbalanced forces are measured by: the load, or, without load, what its elements say in the state evaluated
   !> last.
   real(wp) function reference_force(model)
      type(machine_model), intent(in), target :: model
      type(element_pointer), allocatable :: elements(:)
      integer :: e
      reference_force = largest_load(model)
      elements = model%elements()
      do e = 1, size(elements)
         associate (of => model%layout%elements(e))
            reference_force = max(reference_force, elements(e)%to%reference_force(model%oil(of%all_pads()), &
               & model%point%speed(0.0_wp)))
         end associate
      end do
   end function reference_force
end module static_model
