!> Watches how far the steps of a march go, and says when low orders may go further: in a light vibration BDF of the
!> orders 3 to 5 is unstable, so that the error test keeps the steps short where nothing happens.
module order_watch
   use kinds, only: wp, i8
   implicit none (type, external)
   private
   public :: order_watch_type, low_order

   !> The highest order that is stable in any vibration.
   integer, parameter :: low_order = 2
   !> Steps that are looked at together; such windows of a trial, of which the last one counts: before, vibrations that
   !> high orders have raised die away.
   integer(i8), parameter :: window = 250
   integer, parameter :: trial = 2
   !> How much further low orders must go to stay; how much longer to wait after each trial in vain.
   real(wp), parameter :: gain = 4
   integer, parameter :: patience = 4

   type :: order_watch_type
      !> Mean step, s, below which low orders are tried; 0: they never are.
      real(wp) :: short_step = 0
      !> Time at the end of the last window, s, where the march begins at first.
      real(wp) :: time = 0
      !> Whether low orders are in force.
      logical :: low = .false.
      logical, private :: stays_low = .false.
      !> How far the window before the trial went, s; windows since orders changed, and to wait for the next trial.
      real(wp), private :: span = 0
      integer, private :: since = 0, wait = 2
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
      if (self%stays_low .or. mod(steps, window) /= 0) return
      span = t - self%time
      self%time = t
      self%since = self%since + 1
      if (.not. self%low) then
         changes = span < window*self%short_step .and. self%since > self%wait
         self%span = span
      else if (self%since == trial) then
         self%stays_low = span > gain*self%span
         changes = .not. self%stays_low
         self%wait = patience*self%wait
      end if
      if (.not. changes) return
      self%low = .not. self%low
      self%since = 0
   end function changes
end module order_watch
