!> The speed at which rotor and pads lose their stability: equilibria are followed over the speed of the shaft, for each
!> way that the pivots may behave, until an eigenvalue crosses the imaginary axis.
module stability_threshold
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use kinds, only: wp
   use errors, only: error_type, asked_to_stop, stopped
   use equations_of_motion, only: bearing_model
   use case_parameter, only: case_parameter_type, find_parameter
   use bearing_coefficients, only: bearing_coefficients_type
   use newton_method, only: branch_point_type
   use continuation, only: branch_options, start_branch, advance, return_to
   use bifurcations, only: bifurcation_type, find_bifurcations
   use varied_bearing, only: varied_bearing_type
   use equilibrium_branch, only: equilibrium_problem_type, begin_equilibria
   implicit none (type, external)
   private
   public :: find_thresholds

   !> Longest and shortest step, over the speed at the start. Between them a step is halved while a growth next to zero
   !> changes by more than this part of itself: so what comes near zero is looked at closely.
   real(wp), parameter :: longest = 0.05_wp, shortest = 1e-3_wp, largest_change = 0.5_wp

contains

   !> For each linearised bearing the lowest speed, rpm, from that of the model up to that of its case at which an
   !> eigenvalue crosses the imaginary axis; no number where none does. The model, a static one, is in equilibrium in y.
   !> An error only of status `stopped`, where `give_up` says so.
   subroutine find_thresholds(model, y, found, error, give_up)
      type(bearing_model), intent(in) :: model
      real(wp), intent(in) :: y(:)
      type(bearing_coefficients_type), intent(inout) :: found
      type(error_type), allocatable, intent(out) :: error
      procedure(asked_to_stop), optional :: give_up
      type(bearing_model), target :: moving
      type(case_parameter_type) :: speed
      type(equilibrium_problem_type) :: problem
      type(branch_options) :: options
      real(wp) :: reached
      integer :: i
      call find_parameter(model%inputs, 'operation%speed_rpm', speed, error)
      associate (first => model%point%speed_rpm, given => model%inputs%coefficients)
         options = branch_options(first_step=longest, max_step=longest, high=given%threshold_up_to_rpm)
         allocate (found%thresholds(size(found%bearings)), source=ieee_value(first, ieee_quiet_nan))
         found%sought_up_to = first
         do i = 1, size(found%bearings)
            moving = model
            ! at other speeds this would not be allowed
            moving%inputs%coefficients%threshold_up_to_rpm = 0
            call begin_equilibria(problem, varied_bearing_type(moving, speed), y, first, first)
            problem%pivot = found%bearings(i)%pivot
            problem%cross_stiffness = given%cross_stiffness
            call follow(problem, options, found%thresholds(i), reached, error, give_up)
            if (allocated(error)) return
            found%sought_up_to = max(found%sought_up_to, reached)
         end do
      end associate
   end subroutine find_thresholds

   !> Follows equilibria to their first crossing, if they have one, up to the bound of the speed or to where they turn
   !> back or end.
   subroutine follow(problem, options, threshold, reached, error, give_up)
      type(equilibrium_problem_type), intent(inout) :: problem
      type(branch_options), intent(in) :: options
      !> Stays what it is where there is none.
      real(wp), intent(inout) :: threshold
      !> Speed up to which they were followed, rpm.
      real(wp), intent(out) :: reached
      type(error_type), allocatable, intent(out) :: error
      procedure(asked_to_stop), optional :: give_up
      type(branch_point_type) :: here, next
      type(bifurcation_type), allocatable :: special(:)
      real(wp) :: length
      logical :: ends
      reached = problem%parameter
      call start_branch(problem, options, .true., here, error, give_up)
      length = options%first_step
      ends = .false.
      do while (.not. (allocated(error) .or. ends))
         call advance(problem, options, here, length, next, ends, error, give_up)
         if (allocated(error)) exit
         if (next%parameter < here%parameter) exit
         if (next%along > shortest .and. is_steep(here, next)) then
            call return_to(problem, here)
            length = 0.5_wp*next%along
            ends = .false.
            cycle
         end if
         call find_bifurcations(problem, options, here, next, special, error, give_up)
         if (allocated(error)) exit
         reached = next%parameter
         if (size(special) > 0) then
            threshold = special(1)%point%parameter
            exit
         end if
         here = next
      end do
      if (.not. allocated(error)) return
      if (error%status /= stopped) deallocate (error)
   end subroutine follow

   !> True where a growth next to zero changes much.
   pure logical function is_steep(here, next)
      type(branch_point_type), intent(in) :: here, next
      integer :: n
      n = count(here%growth > 0)
      associate (now => here%growth(max(1, n):min(n + 1, size(here%growth))), &
         & then => next%growth(max(1, n):min(n + 1, size(here%growth))))
         is_steep = any(abs(then - now) > largest_change*abs(now))
      end associate
   end function is_steep
end module stability_threshold
