!> Checks of bent pads and of clearances that heat changes: which cases have them, and what they need.
module shape_checks
   use text, only: to_text
   use errors, only: error_type, require, refuse, add_context
   use kinds, only: wp
   use case_groups, only: is_set
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
      type(case_type) :: own
      integer :: b
      do b = 1, inputs%bearing_count()
         own = inputs%of_bearing(b)
         if (.not. own%changes_shape()) cycle
         if (allocated(error)) return
         call check_tasks(own, error)
         if (own%pads%bending /= 'none') call check_bending(own, error)
         if (is_set(own%bearing%clearance_temperature)) call check_expansion(own, error)
         if (inputs%is_machine()) call add_context(error, 'bearing '''//inputs%machine%bearings(b)%name//'''')
      end do
   end subroutine check_shape

   !> The variable that changes the shape, with its value.
   function what(inputs)
      type(case_type), intent(in) :: inputs
      character(len=:), allocatable :: what
      if (inputs%pads%bending /= 'none') then
         what = 'pads%bending = '''//inputs%pads%bending//''''
      else
         what = 'bearing%clearance_temperature = '//to_text(inputs%bearing%clearance_temperature)
      end if
   end function what

   !> Shapes are those of one equilibrium.
   subroutine check_tasks(inputs, error)
      type(case_type), intent(in) :: inputs
      type(error_type), allocatable, intent(inout) :: error
      call require(inputs%about%task /= 'branch', what(inputs)//': is not for case%task = ''branch''; a study of ' &
         & //'equilibria finds the shape of each', error)
      call require(.not. inputs%coefficients%threshold_up_to_rpm > 0, 'coefficients%threshold_up_to_rpm = ' &
         & //to_text(inputs%coefficients%threshold_up_to_rpm)//': is not for '//what(inputs)//'; a study of ' &
         & //'coefficients over the speed finds the shape at each', error)
      call require(inputs%start%from /= 'partial', 'start%from = ''partial'': is not for '//what(inputs) &
         & //', which starts at the equilibrium', error)
      call require(inputs%thermal%march == 'frozen', 'thermal%march = '''//inputs%thermal%march//''': is not for ' &
         & //what(inputs)//'; ''frozen'' keeps oil and shape of the start', error)
   end subroutine check_tasks

   subroutine check_bending(inputs, error)
      type(case_type), intent(in) :: inputs
      type(error_type), allocatable, intent(inout) :: error
      integer :: i
      associate (p => inputs%pads)
         call require(inputs%tilting(), what(inputs)//': is for pads that tilt on a pivot; pads%motion = ''fixed'' ' &
            & //'has none', error)
         call require(p%bending == 'elastic' .or. inputs%thermal%model == 'film', what(inputs)//': needs the ' &
            & //'temperatures in the pads, thermal%model = ''film''; ''elastic'' does not', error)
         do i = 1, inputs%pad_count()
            if (.not. p%arc_deg(i)*max(p%pivot_ratio(i), 1 - p%pivot_ratio(i)) <= farthest) call refuse( &
               & 'pads%arc_deg = '//to_text(p%arc_deg(i))//': a pad that bends may reach at most ' &
               & //to_text(farthest)//' deg from its pivot (pad '//to_text(i)//')', error)
         end do
      end associate
   end subroutine check_bending

   subroutine check_expansion(inputs, error)
      type(case_type), intent(in) :: inputs
      type(error_type), allocatable, intent(inout) :: error
      integer :: i
      call require(inputs%thermal%model /= 'none' .or. is_set(inputs%oil%shaft_temperature), what(inputs)//': needs ' &
         & //'oil%shaft_temperature, or thermal%model = ''pad'' or ''film'', which give the shaft''s', error)
      do i = 1, inputs%pad_count()
         call require(inputs%thermal%model == 'film' .or. is_set(inputs%pads%temperature(i)), what(inputs)//': needs ' &
            & //'pads%temperature, or thermal%model = ''film'', which gives it (pad '//to_text(i)//')', error)
      end do
   end subroutine check_expansion
end module shape_checks
