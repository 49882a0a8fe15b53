!> The integrator step by step: accuracy between the ends of steps, what outputs belong to, starting anew, several at
!> once.
module swinging
   use kinds, only: wp
   use small_ode, only: small_ode_type
   implicit none (type, external)
   private
   public :: oscillator, exact

   !> y'' = -w^2 y as (y, y'), whose outputs are the states themselves.
   type, extends(small_ode_type) :: oscillator
      real(wp) :: w = 1
   contains
      procedure :: rates
      procedure :: jacobian
      procedure :: output
   end type oscillator

contains

   !> From (1, 0) at t = 0.
   pure function exact(w, t) result(y)
      real(wp), intent(in) :: w, t
      real(wp) :: y(2)
      y = [cos(w*t), -w*sin(w*t)]
   end function exact

   pure function rates(self, t, y)
      class(oscillator), intent(in) :: self
      real(wp), intent(in) :: t, y(:)
      real(wp) :: rates(size(y))
      rates = [y(2), -self%w**2*y(1)]
   end function rates

   pure function jacobian(self, t, y) result(matrix)
      class(oscillator), intent(in) :: self
      real(wp), intent(in) :: t, y(:)
      real(wp) :: matrix(size(y), size(y))
      matrix = reshape([0.0_wp, -self%w**2, 1.0_wp, 0.0_wp], [2, 2])
   end function jacobian

   function output(self, correction)
      class(oscillator), intent(inout) :: self
      real(wp), intent(in) :: correction(:)
      real(wp) :: output(self%outputs)
      output = self%seen + correction
   end function output
end module swinging

program test_cvode_integrator
   use kinds, only: wp, i8
   use text, only: to_text
   use errors, only: error_type, numerics_error
   use cvode_integrator, only: integrator_type, integrator_options
   use integrator_counts, only: integrator_counts_type
   use swinging, only: oscillator, exact
   use check, only: runs, expect, expect_close, report
   implicit none (type, external)

   real(wp), parameter :: tolerance = 1e-8_wp
   if (runs('between_steps')) call between_steps()
   if (runs('outputs_of_steps')) call outputs_of_steps()
   if (runs('starting_anew')) call starting_anew()
   if (runs('side_by_side')) call side_by_side()
   if (runs('refusal')) call refusal()
   call report()

contains

   type(integrator_options) function tolerances()
      tolerances%relative_tolerance = tolerance
      tolerances%absolute_tolerance = [tolerance, tolerance]
   end function tolerances

   subroutine expect_well(error)
      type(error_type), allocatable, intent(in) :: error
      if (allocated(error)) call expect(.false., error%message)
   end subroutine expect_well

   !> A step's error is at most the tolerance times (|y| + 1) sqrt(2), |y| <= 1, and adds up over the steps; states
   !> between the ends of a step are as good, and the last step ends at the time given.
   subroutine between_steps()
      type(oscillator), target :: model
      type(integrator_type) :: integrator
      type(integrator_counts_type) :: counts
      type(error_type), allocatable :: error
      real(wp) :: before, t, found(4), allowed
      integer :: k
      model = oscillator(n=2, outputs=2)
      call integrator%start(model, tolerances(), 0.0_wp, exact(1.0_wp, 0.0_wp), 6.0_wp, error)
      call expect_well(error)
      call integrator%interpolate(0.0_wp, found)
      call expect_close(norm2(found - [exact(1.0_wp, 0.0_wp), exact(1.0_wp, 0.0_wp)]), 0.0_wp, 0.0_wp, &
         & 'the start is what was given')
      do while (integrator%time() < 6)
         before = integrator%time()
         call integrator%step(error)
         call expect_well(error)
         if (allocated(error)) return
         counts = integrator%counts()
         allowed = 3*counts%steps*tolerance
         do k = 0, 4
            t = before + 0.25_wp*k*(integrator%time() - before)
            call integrator%interpolate(t, found)
            call expect_close(norm2(found(:2) - exact(1.0_wp, t)), 0.0_wp, allowed, 'state at '//to_text(t))
         end do
         call expect_close(norm2(found(:2) - integrator%state()), 0.0_wp, 4*epsilon(t), 'the step ends in its state')
      end do
      call expect_close(integrator%time(), 6.0_wp, 0.0_wp, 'the end is met')
      call expect(counts%rhs_evaluations > counts%steps .and. counts%jacobian_evaluations > 0, 'work is counted')
   end subroutine between_steps

   !> Newton's last correction leads from the state evaluated last to the one accepted, so the outputs at the end of a
   !> step are those of its state.
   subroutine outputs_of_steps()
      type(oscillator), target :: model
      type(integrator_type) :: integrator
      type(error_type), allocatable :: error
      real(wp) :: found(4), largest
      integer :: k
      model = oscillator(n=2, outputs=2)
      call integrator%start(model, tolerances(), 0.0_wp, exact(1.0_wp, 0.0_wp), 6.0_wp, error)
      largest = 0
      do k = 1, 50
         call integrator%step(error)
         call expect_well(error)
         largest = max(largest, norm2(model%seen - integrator%state()))
         call integrator%interpolate(integrator%time(), found)
         call expect_close(norm2(found(3:) - integrator%state()), 0.0_wp, 8*epsilon(found), &
            & 'outputs of step '//to_text(k))
      end do
      call expect(largest > 100*epsilon(found), 'without the correction they would be of another state')
   end subroutine outputs_of_steps

   !> Times and states of the first steps from where the integrator stands.
   subroutine take_steps(integrator, found)
      type(integrator_type), intent(inout) :: integrator
      real(wp), intent(out) :: found(:, :)
      type(error_type), allocatable :: error
      integer :: k
      do k = 1, size(found, 2)
         call integrator%step(error)
         call expect_well(error)
         found(:, k) = [integrator%time(), integrator%state()]
      end do
   end subroutine take_steps

   !> After another start every bit is as from a fresh integrator.
   subroutine starting_anew()
      type(oscillator), target :: model, fast
      type(integrator_type) :: integrator, fresh
      type(integrator_counts_type) :: counts, fresh_counts
      type(error_type), allocatable :: error
      real(wp), parameter :: from(2) = [0.3_wp, -2.0_wp]
      real(wp) :: first(3, 40), again(3, 40)
      model = oscillator(n=2, outputs=2)
      fast = oscillator(n=2, outputs=2, w=50.0_wp)
      call fresh%start(model, tolerances(), 1.5_wp, from, 8.0_wp, error)
      call take_steps(fresh, first)
      fresh_counts = fresh%counts()
      call integrator%start(model, tolerances(), 0.0_wp, exact(1.0_wp, 0.0_wp), 6.0_wp, error)
      call take_steps(integrator, again)
      call integrator%start(model, tolerances(), 1.5_wp, from, 8.0_wp, error)
      call expect_well(error)
      call take_steps(integrator, again)
      call expect_close(norm2(again - first), 0.0_wp, 0.0_wp, 'a second start is a start')
      counts = integrator%counts()
      call expect(counts%steps == 40_i8 .and. counts%rhs_evaluations == fresh_counts%rhs_evaluations, &
         & 'and counts from there')
      call integrator%start(fast, tolerances(), 0.0_wp, from, 8.0_wp, error)
      call take_steps(integrator, again)
      call integrator%finish()
      call integrator%finish()
      call integrator%start(model, tolerances(), 1.5_wp, from, 8.0_wp, error)
      call take_steps(integrator, again)
      call expect_close(norm2(again - first), 0.0_wp, 0.0_wp, 'another start is a start')
   end subroutine starting_anew

   !> Two integrators that take turns, with models of their own, each do what they do alone.
   subroutine side_by_side()
      type(oscillator), target :: slow, fast
      type(integrator_type) :: first, second
      type(error_type), allocatable :: error
      real(wp) :: alone(3, 40, 2), together(3, 40, 2)
      integer :: k
      slow = oscillator(n=2, outputs=2)
      fast = oscillator(n=2, outputs=2, w=50.0_wp)
      call first%start(slow, tolerances(), 0.0_wp, exact(1.0_wp, 0.0_wp), 6.0_wp, error)
      call take_steps(first, alone(:, :, 1))
      call first%start(fast, tolerances(), 0.0_wp, exact(50.0_wp, 0.0_wp), 6.0_wp, error)
      call take_steps(first, alone(:, :, 2))
      call first%start(slow, tolerances(), 0.0_wp, exact(1.0_wp, 0.0_wp), 6.0_wp, error)
      call second%start(fast, tolerances(), 0.0_wp, exact(50.0_wp, 0.0_wp), 6.0_wp, error)
      do k = 1, 40
         call take_steps(first, together(:, k:k, 1))
         call take_steps(second, together(:, k:k, 2))
      end do
      call expect_close(norm2(together - alone), 0.0_wp, 0.0_wp, 'neither knows of the other')
      call expect(alone(1, 40, 1) > 5*alone(1, 40, 2), 'each goes at its own pace')
   end subroutine side_by_side

   !> Where the model refuses, steps end with its reason; after a start elsewhere they go on.
   subroutine refusal()
      type(oscillator), target :: model
      type(integrator_type) :: integrator
      type(error_type), allocatable :: error
      real(wp) :: reached
      model = oscillator(n=2, outputs=2, refuse_after=0.5_wp)
      call integrator%start(model, tolerances(), 1.0_wp, exact(1.0_wp, 1.0_wp), 2.0_wp, error)
      call expect(allocated(error), 'a start that the model refuses is an error')
      call integrator%start(model, tolerances(), 0.0_wp, exact(1.0_wp, 0.0_wp), 2.0_wp, error)
      call expect_well(error)
      do while (.not. allocated(error) .and. integrator%time() < 1)
         call integrator%step(error)
      end do
      call expect(allocated(error), 'no step beyond')
      if (.not. allocated(error)) return
      call expect(error%status == numerics_error .and. index(error%message, 'the problem ends') == 1, &
         & 'the error gives the reason: '//error%message)
      reached = integrator%time()
      call expect(reached <= 0.5_wp .and. reached > 0.49_wp, 'the time reached stands: '//to_text(reached))
      call expect_close(norm2(integrator%state() - exact(1.0_wp, reached)), 0.0_wp, 300*tolerance, 'and its state')
   end subroutine refusal
end program test_cvode_integrator
