!> Checks of bent pads and of clearances that heat changes: which cases have them, and what they need.
module shape_checks
   use text, only: to_text
   use errors, only: error_type, require, refuse, add_context
   use kinds, only: wp
   use case_groups, only: bearing_type, is_set
   use case_inputs, only: case_type
   implicit none (type, external)
   private
   public :: check_shape

   !> How far a pad that bends may reach from its pivot, deg.
   real(wp), parameter :: farthest = 90

contains

   !> Raises an error for the first requirement that a case does not meet.
   subroutine check_shape(inputs, error)
      type(case_type), intent(in) :: inputs
      type(error_type), allocatable, intent(inout) :: error
      integer :: b
      do b = 1, size(inputs%bearings)
         associate (bearing => inputs%bearings(b))
            if (.not. bearing%changes_shape()) cycle
            if (allocated(error)) return
            call check_tasks(inputs, what(bearing), error)
            if (bearing%pads%bending /= 'none') call check_bending(bearing, inputs%thermal%model, error)
            if (is_set(bearing%clearance_temperature)) call check_expansion(bearing, inputs%thermal%model, error)
            call add_context(error, bearing%label())
         end associate
      end do
   end subroutine check_shape

   !> The variable that changes the shape, with its value.
   function what(bearing)
      type(bearing_type), intent(in) :: bearing
      character(len=:), allocatable :: what
      if (bearing%pads%bending /= 'none') then
         what = 'pads%bending = '''//bearing%pads%bending//''''
      else
         what = 'bearing%clearance_temperature = '//to_text(bearing%clearance_temperature)
      end if
   end function what

   !> Shapes are those of one equilibrium; `what` changes them.
   subroutine check_tasks(inputs, what, error)
      type(case_type), intent(in) :: inputs
      character(len=*), intent(in) :: what
      type(error_type), allocatable, intent(inout) :: error
      call require(inputs%about%task /= 'branch', what//': is not for case%task = ''branch''; a study of ' &
         & //'equilibria finds the shape of each', error)
      call require(.not. inputs%coefficients%threshold_up_to_rpm > 0, 'coefficients%threshold_up_to_rpm = ' &
         & //to_text(inputs%coefficients%threshold_up_to_rpm)//': is not for '//what//'; a study of ' &
         & //'coefficients over the speed finds the shape at each', error)
      call require(inputs%start%from /= 'partial', 'start%from = ''partial'': is not for '//what &
         & //', which starts at the equilibrium', error)
      call require(inputs%thermal%march == 'frozen', 'thermal%march = '''//inputs%thermal%march//''': is not for ' &
         & //what//'; ''frozen'' keeps oil and shape of the start', error)
   end subroutine check_tasks

   subroutine check_bending(bearing, thermal_model, error)
      type(bearing_type), intent(in) :: bearing
      character(len=*), intent(in) :: thermal_model
      type(error_type), allocatable, intent(inout) :: error
      integer :: i
      associate (p => bearing%pads)
         call require(bearing%tilting(), what(bearing)//': is for pads that tilt on a pivot; pads%motion = ''fixed'' ' &
            & //'has none', error)
         call require(p%bending == 'elastic' .or. thermal_model == 'film', what(bearing)//': needs the ' &
            & //'temperatures in the pads, thermal%model = ''film''; ''elastic'' does not', error)
         do i = 1, bearing%pad_count()
            if (.not. p%arc_deg(i)*max(p%pivot_ratio(i), 1 - p%pivot_ratio(i)) <= farthest) call refuse( &
               & 'pads%arc_deg = '//to_text(p%arc_deg(i))//': a pad that bends may reach at most ' &
               & //to_text(farthest)//' deg from its pivot (pad '//to_text(i)//')', error)
         end do
      end associate
   end subroutine check_bending

   subroutine check_expansion(bearing, thermal_model, error)
      type(bearing_type), intent(in) :: bearing
      character(len=*), intent(in) :: thermal_model
      type(error_type), allocatable, intent(inout) :: error
      integer :: i
      call require(thermal_model /= 'none' .or. is_set(bearing%oil%shaft_temperature), what(bearing)//': needs ' &
         & //'oil%shaft_temperature, or thermal%model = ''pad'' or ''film'', which give the shaft''s', error)
      do i = 1, bearing%pad_count()
         call require(thermal_model == 'film' .or. is_set(bearing%pads%temperature(i)), what(bearing)//': needs ' &
            & //'pads%temperature, or thermal%model = ''film'', which gives it (pad '//to_text(i)//')', error)
      end do
   end subroutine check_expansion
end module shape_checks
