!> The speed at which rotor and pads lose their stability: the equilibrium is followed over the speed of the shaft until
!> an eigenvalue crosses the imaginary axis, and the crossing is closed in on.
module stability_threshold
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use kinds, only: wp
   use errors, only: error_type, asked_to_stop, asked
   use roots, only: root_bracket
   use operating_point, only: operating_point_type
   use equations_of_motion, only: bearing_model
   use thermal_equilibrium, only: come_to_warm_rest
   use linear_bearing, only: linear_bearing_type, linearize
   use vibration_modes, only: find_growths
   implicit none (type, external)
   private
   public :: find_thresholds

   !> Longest and shortest step of the speed, over itself. Between them a step is halved while a growth next to zero
   !> changes by more than this part of itself: so what comes near zero is looked at closely.
   real(wp), parameter :: longest = 0.02_wp, shortest = 1e-3_wp, largest_change = 0.5_wp
   !> Where the equilibrium does not follow a step, and the step is shorter than this, it has ended.
   real(wp), parameter :: least_step = 1e-6_wp
   !> Width of a speed's bracket, over itself, at the end; most cuts of it.
   real(wp), parameter :: accuracy = 1e-10_wp
   integer, parameter :: most_cuts = 100

   !> The equilibrium at a speed.
   type :: place_type
      real(wp) :: rpm = 0
      real(wp), allocatable :: y(:)
      !> Growths of each bearing, (growth, bearing), 1/s, the largest first; of those that are not there, the least.
      real(wp), allocatable :: growths(:, :)
   end type place_type

contains

   !> For each way that the pivots may behave the lowest speed, rpm, from that of the model up to another at which an
   !> eigenvalue crosses the imaginary axis; no number where none does. The model is at rest in y.
   subroutine find_thresholds(model, y, up_to, cross_stiffness, thresholds, reached, give_up)
      type(bearing_model), intent(in) :: model
      real(wp), intent(in) :: y(:), up_to, cross_stiffness
      real(wp), allocatable, intent(out) :: thresholds(:)
      !> Speed up to which the equilibrium was followed, rpm.
      real(wp), intent(out) :: reached
      procedure(asked_to_stop), optional :: give_up
      type(bearing_model) :: moving
      type(place_type) :: here, next
      real(wp) :: step
      logical, allocatable :: found(:)
      logical :: ok
      integer :: i
      moving = model
      reached = model%point%speed_rpm
      call go_to(moving, reached, y, cross_stiffness, here, ok)
      allocate (thresholds(size(here%growths, 2)), source=ieee_value(step, ieee_quiet_nan))
      allocate (found(size(thresholds)), source=.false.)
      step = longest
      do while (ok .and. reached < up_to .and. .not. all(found))
         if (asked(give_up)) return
         call go_to(moving, min(up_to, (1 + step)*here%rpm), here%y, cross_stiffness, next, ok)
         if (.not. ok .or. step > shortest .and. is_steep(here, next, found)) then
            step = 0.5_wp*step
            ok = step > least_step
            cycle
         end if
         do i = 1, size(found)
            if (found(i) .or. unstable(here, i) == unstable(next, i)) cycle
            found(i) = .true.
            thresholds(i) = crossing(moving, here, next, i, cross_stiffness)
         end do
         here = next
         reached = here%rpm
         step = min(longest, 2*step)
      end do
   end subroutine find_thresholds

   !> The equilibrium at a speed, rpm, from a state y near it. `ok` is false where there is none.
   subroutine go_to(model, rpm, y, cross_stiffness, place, ok)
      type(bearing_model), intent(inout) :: model
      real(wp), intent(in) :: rpm, y(:), cross_stiffness
      type(place_type), intent(out) :: place
      logical, intent(out) :: ok
      type(operating_point_type) :: point
      type(linear_bearing_type), allocatable :: bearings(:)
      type(error_type), allocatable :: error
      real(wp), allocatable :: growths(:)
      real(wp) :: residual
      integer :: i
      point = model%point
      point%speed_rpm = rpm
      call model%set_point(point)
      place%rpm = rpm
      place%y = y
      call come_to_warm_rest(model, place%y, residual, error)
      ok = .not. allocated(error)
      if (ok) call linearize(model, place%y, bearings, ok)
      if (.not. ok) return
      allocate (place%growths(2*model%layout%n_positions(), size(bearings)), source=-huge(residual))
      do i = 1, size(bearings)
         call find_growths(bearings(i), model%rotor%mass, cross_stiffness, growths, ok)
         if (.not. ok) return
         place%growths(:size(growths), i) = growths
      end do
   end subroutine go_to

   !> How many eigenvalues grow.
   pure integer function unstable(place, bearing)
      type(place_type), intent(in) :: place
      integer, intent(in) :: bearing
      unstable = count(place%growths(:, bearing) > 0)
   end function unstable

   !> True where a growth next to zero, of a bearing that is still looked at, changes much.
   pure logical function is_steep(here, next, found)
      type(place_type), intent(in) :: here, next
      logical, intent(in) :: found(:)
      integer :: i, n
      is_steep = .false.
      do i = 1, size(found)
         if (found(i)) cycle
         n = unstable(here, i)
         associate (now => here%growths(max(1, n):min(n + 1, size(here%growths, 1)), i), &
            & then => next%growths(max(1, n):min(n + 1, size(here%growths, 1)), i))
            if (any(abs(then - now) > largest_change*abs(now))) is_steep = .true.
         end associate
      end do
   end function is_steep

   !> The speed between two places, rpm, at which the growth of a bearing that crosses zero first is zero.
   real(wp) function crossing(model, first, last, bearing, cross_stiffness)
      type(bearing_model), intent(inout) :: model
      type(place_type), intent(in) :: first, last
      integer, intent(in) :: bearing
      real(wp), intent(in) :: cross_stiffness
      type(root_bracket) :: bracket
      type(place_type) :: place
      real(wp) :: last_speed
      integer :: k, cut
      logical :: ok
      ! of those that do not grow the largest crosses first, of those that grow the least
      k = unstable(first, bearing)
      if (unstable(last, bearing) > k) k = k + 1
      bracket = root_bracket([first%rpm, last%rpm], [first%growths(k, bearing), last%growths(k, bearing)])
      do cut = 1, most_cuts
         crossing = bracket%estimate()
         last_speed = bracket%place(2)
         if (bracket%width() <= accuracy*last_speed) return
         call go_to(model, crossing, first%y, cross_stiffness, place, ok)
         if (.not. ok) return
         call bracket%narrow(crossing, place%growths(k, bearing))
         if (abs(place%growths(k, bearing)) <= 0 .or. abs(crossing - last_speed) <= accuracy*last_speed) return
      end do
   end function crossing
end module stability_threshold
