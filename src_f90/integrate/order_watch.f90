!> Watches how far the steps of a march go, and says when low orders may go further: in a light vibration BDF of the
!> orders 3 to 5 is unstable, so that the error test keeps the steps short where nothing happens.
module order_watch
   use kinds, only: wp, i8
   implicit none (type, external)
   private
   public :: order_watch_type, low_order

   !> The highest order that is stable in any vibration.
   integer, parameter :: low_order = 2
   !> Steps that are looked at together.
   integer(i8), parameter :: window = 250
   !> Windows in a row with short steps before the first trial, and how many times as many after one in vain.
   integer, parameter :: first_wait = 4, patience = 4
   !> Windows of a trial, of which the last one counts: before, vibrations that high orders have raised die away. How
   !> much further it must go for low orders to stay, and for how many windows they do.
   integer, parameter :: trial = 4, stay = 20
   real(wp), parameter :: gain = 4

   type :: order_watch_type
      !> Mean step, s, below which low orders are tried; 0: they never are.
      real(wp) :: short_step = 0
      !> Time at the end of the last window, s, where the march begins at first.
      real(wp) :: time = 0
      !> Whether low orders are in force.
      logical :: low = .false.
      !> How far the window before the trial went, s; windows with low orders, or in a row with short steps, and how
      !> many of these lead to a trial.
      real(wp), private :: span = 0
      integer, private :: windows = 0, wait = first_wait
   contains
      procedure :: changes
   end type order_watch_type

contains

   !> True where the orders change now, at time t, s, after so many steps: to those of `low`.
   logical function changes(self, t, steps)
      class(order_watch_type), intent(inout) :: self
      real(wp), intent(in) :: t
      integer(i8), intent(in) :: steps
      real(wp) :: span
      changes = .false.
      if (mod(steps, window) /= 0) return
      span = t - self%time
      self%time = t
      self%windows = self%windows + 1
      if (self%low) then
         changes = self%windows == stay
         if (self%windows == trial) then
            changes = .not. span > gain*self%span
            self%wait = merge(patience*self%wait, first_wait, changes)
         end if
      else
         if (.not. span < window*self%short_step) self%windows = 0
         changes = self%windows == self%wait
         self%span = span
      end if
      if (.not. changes) return
      self%low = .not. self%low
      self%windows = 0
   end function changes
end module order_watch
