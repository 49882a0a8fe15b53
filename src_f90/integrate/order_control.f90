!> Watches how far the steps of a march go, and says when low orders may go further: in a light vibration BDF of the
!> orders 3 to 5 is unstable, so that the error test keeps the steps short where nothing happens.
module order_control
   use kinds, only: wp, i8
   use linear_algebra, only: find_eigenvalues
   implicit none (type, external)
   private
   public :: order_control_type, stable_order

   !> Steps that are looked at together.
   integer(i8), parameter :: window = 250
   !> Windows in a row with short steps before low orders are first tried; windows with low orders before high ones are
   !> tried again; and how many times as many after a trial in vain.
   integer, parameter :: first_wait = 4, stay = 40, longer = 4
   !> Windows of a half of a trial. In the first, what the orders before have left dies away; the trial ends with it
   !> where it does not go the same part of the way. How much further than before the second must go for low orders to
   !> stay; high ones stay where they go no less far.
   integer, parameter :: half = 2
   real(wp), parameter :: part = 0.5_wp, gain = 1.5_wp
   !> Damping ratios from which on vibrations of any frequency are stable with the orders 2 to 5.
   real(wp), parameter :: stable_damping(2:5) = [0.0_wp, 0.0692_wp, 0.2865_wp, 0.6180_wp]
   !> Radians of a vibration in a step below which the steps resolve it, whatever the order.
   real(wp), parameter :: resolved = 0.2_wp

   type :: order_control_type
      !> Mean step, s, below which low orders are tried; 0: they never are.
      real(wp) :: short_step = 0
      !> Time at the end of the last window, s, where the march begins at first.
      real(wp) :: time = 0
      !> Whether low orders are in force; whether the orders in force are on trial.
      logical :: low = .false.
      logical, private :: tried = .false.
      !> Mean step before the trial, s.
      real(wp) :: mean_step = 0
      !> Where the steps that count began, s; windows since then, and how many of these lead to a trial.
      real(wp), private :: since = 0
      integer, private :: windows = 0, wait = first_wait
   contains
      procedure :: changes
   end type order_control_type

contains

   !> True where the orders change now, at time t, s, after this many steps: to those of `low`.
   logical function changes(self, t, steps)
      class(order_control_type), intent(inout) :: self
      real(wp), intent(in) :: t
      integer(i8), intent(in) :: steps
      changes = .false.
      if (mod(steps, window) /= 0) return
      self%windows = self%windows + 1
      if (self%windows == 1) self%since = self%time
      if (self%tried) then
         call judge_trial(self, t, changes)
      else
         if (.not. self%low .and. t - self%time > window*self%short_step) self%windows = 0
         changes = self%windows == self%wait
         if (changes) self%mean_step = (t - self%since)/(self%wait*window)
      end if
      self%time = t
      if (.not. changes) return
      self%low = .not. self%low
      self%tried = .not. self%tried
      self%windows = 0
   end function changes

   !> After each half of a trial, at time t, s: whether it was in vain. Where it was not, its orders stay.
   subroutine judge_trial(self, t, in_vain)
      class(order_control_type), intent(inout) :: self
      real(wp), intent(in) :: t
      logical, intent(out) :: in_vain
      real(wp) :: least
      in_vain = .false.
      if (mod(self%windows, half) /= 0) return
      least = part
      if (self%windows > half) least = merge(gain, 1.0_wp, self%low)
      in_vain = t - self%since < least*half*window*self%mean_step
      self%since = t
      if (in_vain) then
         self%wait = longer*self%wait
      else if (self%windows > half) then
         self%wait = merge(stay, first_wait, self%low)
         self%tried = .false.
         self%windows = 0
      end if
   end subroutine judge_trial

   !> The highest order that is stable in all vibrations that steps of this length, s, do not resolve, of a motion with
   !> this Jacobian.
   integer function stable_order(jacobian, step) result(order)
      real(wp), intent(in) :: jacobian(:, :), step
      complex(wp) :: values(size(jacobian, 1))
      logical :: ok
      call find_eigenvalues(jacobian, values, ok)
      do order = ubound(stable_damping, 1), lbound(stable_damping, 1) + 1, -1
         if (ok .and. all(-values%re >= stable_damping(order)*abs(values) .or. abs(values%im)*step < resolved)) return
      end do
   end function stable_order
end module order_control
