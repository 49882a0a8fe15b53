!> Who receives the samples of a march.
module march_observer
   use kinds, only: wp, i8
   use errors, only: error_type
   use integrator_counts, only: integrator_counts_type
   implicit none (type, external)
   private
   public :: march_observer_type

   type, abstract :: march_observer_type
      !> Set by the observer: the march has reached what it was for, and ends.
      logical :: satisfied = .false.
   contains
      procedure(take_sample), deferred :: sample
      procedure(take_progress), deferred :: report
      !> True where the observer wants the state in which the next step starts; asked before every step.
      procedure :: wants_state
      !> The state at time t, s; all samples up to it were given. Setting `error` ends the march.
      procedure :: take_state
   end type march_observer_type

   abstract interface
      !> The state y at a sample time t, s, and the model's outputs; setting `error` ends the march.
      subroutine take_sample(self, t, y, output, error)
         import :: error_type, march_observer_type, wp
         class(march_observer_type), intent(inout) :: self
         real(wp), intent(in) :: t, y(:), output(:)
         type(error_type), allocatable, intent(out) :: error
      end subroutine take_sample

      !> Called now and then with the time reached, s, and the steps done.
      subroutine take_progress(self, t, steps)
         import :: i8, march_observer_type, wp
         class(march_observer_type), intent(inout) :: self
         real(wp), intent(in) :: t
         integer(i8), intent(in) :: steps
      end subroutine take_progress
   end interface

contains

   logical function wants_state(self)
      class(march_observer_type), intent(in) :: self
      wants_state = .false.
   end function wants_state

   subroutine take_state(self, t, y, counts, error)
      class(march_observer_type), intent(inout) :: self
      real(wp), intent(in) :: t, y(:)
      type(integrator_counts_type), intent(in) :: counts
      type(error_type), allocatable, intent(out) :: error
   end subroutine take_state
end module march_observer
