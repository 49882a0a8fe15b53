!> The speed at which rotor and pads lose their stability: equilibria are followed over the speed of the shaft until,
!> for each way that the pivots may behave, an eigenvalue has crossed the imaginary axis.
module stability_threshold
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_is_nan, ieee_quiet_nan
   use kinds, only: wp
   use errors, only: error_type, stopped
   use equations_of_motion, only: machine_model
   use film_network, only: warm_films_type
   use case_parameter, only: case_parameter_type, find_parameter
   use linear_bearing, only: pivot_name, bearing_coefficients_type, cross_stiffness_of
   use newton_method, only: branch_point_type, place_part_type, return_to
   use continuation, only: branch_options, start_branch, advance, bifurcation_type, find_bifurcations
   use varied_bearing, only: varied_bearing_type
   use equilibrium_branch, only: equilibrium_problem_type, begin_equilibria
   implicit none (type, external)
   private
   public :: find_thresholds

   !> Longest and shortest step, over the speed at the start. Between them a step is halved while a growth next to zero
   !> changes by more than this part of itself, as it may have been there and back, or have leaped over it.
   real(wp), parameter :: longest = 0.05_wp, shortest = 1e-3_wp, largest_change = 0.5_wp
   !> Damping ratio of a vibration that has come to zero: it did not leap, and the step need not be halved.
   real(wp), parameter :: no_damping = 1e-4_wp

contains

   !> For each linearised bearing the lowest speed, rpm, from that of the model up to that of its case at which an
   !> eigenvalue crosses the imaginary axis; no number where none does. The model, a static one, is in equilibrium in y.
   !> An error only of status `stopped`, where `give_up` of the model says so.
   subroutine find_thresholds(model, y, found, error, films, before)
      type(machine_model), intent(in) :: model
      real(wp), intent(in) :: y(:)
      type(bearing_coefficients_type), intent(inout) :: found
      type(error_type), allocatable, intent(out) :: error
      !> Of each bearing, where films have temperatures along and across.
      type(warm_films_type), allocatable, intent(in), optional :: films(:)
      !> The last equilibrium before the instability of stuck pivots, or where none has friction of free or locked ones;
      !> not allocated where it was not found.
      type(place_part_type), allocatable, intent(out), optional :: before(:)
      type(machine_model), target :: moving
      type(case_parameter_type) :: speed
      type(equilibrium_problem_type) :: problem
      type(branch_options) :: options
      moving = model
      ! at other speeds this would not be allowed
      moving%inputs%coefficients%threshold_up_to_rpm = 0
      ! its rotor is made anew, without the damping of high modes, which marches alone need
      if (.not. moving%inputs%rotor%is_rigid()) moving%inputs%rotor%elastic%reduction%damping_ratio = 0
      call find_parameter(moving%inputs, 'operation%speed_rpm', speed, error)
      associate (first => model%point%speed_rpm, given => model%inputs%coefficients)
         call begin_equilibria(problem, varied_bearing_type(moving, speed), y, first, first, films)
         problem%cross_stiffness = cross_stiffness_of(model)
         allocate (found%thresholds(size(found%bearings)), source=ieee_value(first, ieee_quiet_nan))
         options = branch_options(first_step=longest, max_step=longest, high=given%threshold_up_to_rpm)
         options%give_up => model%give_up
         call follow(problem, options, found%bearings%pivot, found%thresholds, found%sought_up_to, error, before)
      end associate
      if (.not. allocated(error)) return
      if (error%status /= stopped) deallocate (error)
   end subroutine find_thresholds

   !> Follows equilibria to the first crossing of each of these ways of the pivots, if it has one, up to the bound
   !> of the speed or to where they turn back or end, which may be an error. All ways have the same equilibria.
   subroutine follow(problem, options, pivots, thresholds, reached, error, before)
      type(equilibrium_problem_type), intent(inout) :: problem
      type(branch_options), intent(in) :: options
      character(len=pivot_name), intent(in) :: pivots(:)
      !> Stay what they are where there are none.
      real(wp), intent(inout) :: thresholds(:)
      !> Speed up to which they were followed, rpm.
      real(wp), intent(out) :: reached
      type(error_type), allocatable, intent(out) :: error
      type(place_part_type), allocatable, intent(out), optional :: before(:)
      type(branch_point_type) :: here(size(pivots)), next(size(pivots))
      type(bifurcation_type), allocatable :: special(:)
      real(wp) :: length
      integer :: i, at_rest
      logical :: ends, again, is_short
      reached = problem%parameter
      at_rest = max(1, findloc(pivots, 'stuck', dim=1))
      problem%pivot = pivots(1)
      call start_branch(problem, options, .true., here(1), error)
      if (allocated(error)) return
      call take_spectra(problem, pivots, here)
      length = options%first_step
      ends = .false.
      do while (any(ieee_is_nan(thresholds)) .and. .not. ends)
         call advance(problem, options, here(1), length, next(1), ends, error)
         if (allocated(error)) return
         if (next(1)%parameter < here(1)%parameter) return
         call take_spectra(problem, pivots, next)
         is_short = next(1)%along <= shortest
         again = .false.
         do i = size(pivots), 1, -1
            problem%pivot = pivots(i)
            if (.not. ieee_is_nan(thresholds(i))) cycle
            call find_bifurcations(problem, options, here(i), next(i), special, error)
            if (allocated(error)) return
            if (is_short .and. size(special) > 0 .or. is_smooth(special)) then
               thresholds(i) = special(1)%point%parameter
            else
               again = again .or. is_steep(here(i), next(i))
            end if
         end do
         if (again .and. .not. is_short) then
            call return_to(problem, here(1))
            length = 0.5_wp*next(1)%along
            ends = .false.
            cycle
         end if
         reached = next(1)%parameter
         if (present(before)) call note_place()
         here = next
      end do
   contains
      !> Notes where the step begins that has passed the first instability.
      subroutine note_place()
         if (allocated(before) .or. ieee_is_nan(thresholds(at_rest))) return
         call return_to(problem, here(1))
         call problem%get_place(before)
         call return_to(problem, next(1))
      end subroutine note_place
   end subroutine follow

   !> Gives the point where the problem stands, found with the first of these ways of the pivots, the values of each.
   subroutine take_spectra(problem, pivots, points)
      type(equilibrium_problem_type), intent(inout) :: problem
      character(len=pivot_name), intent(in) :: pivots(:)
      type(branch_point_type), intent(inout) :: points(:)
      integer :: i
      logical :: ok
      points(2:) = points(1)
      do i = size(pivots), 1, -1
         problem%pivot = pivots(i)
         if (i > 1) call problem%spectrum(points(i)%values, points(i)%growth, ok)
      end do
   end subroutine take_spectra

   !> True where a vibration has no damping at the first of some points, if there are any.
   pure logical function is_smooth(special)
      type(bifurcation_type), intent(in) :: special(:)
      is_smooth = size(special) > 0
      if (is_smooth) is_smooth = abs(special(1)%value%re) <= no_damping*abs(special(1)%value)
   end function is_smooth

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
