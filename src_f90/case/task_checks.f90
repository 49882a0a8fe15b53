!> Checks of the groups that belong to single tasks, and of what these tasks cannot do.
module task_checks
   use text, only: to_text
   use errors, only: error_type, require
   use case_inputs, only: case_type, periodic_type, branch_type, is_set
   implicit none (type, external)
   private
   public :: check_tasks

contains

   subroutine check_tasks(inputs, error)
      type(case_type), intent(in) :: inputs
      type(error_type), allocatable, intent(inout) :: error
      call check_coefficients(inputs, error)
      call check_periodic(inputs, error)
      call check_branch(inputs, error)
   end subroutine check_tasks

   !> The group coefficients belongs to its task, and to no other; the groups of a march do not.
   subroutine check_coefficients(inputs, error)
      type(case_type), intent(in) :: inputs
      type(error_type), allocatable, intent(inout) :: error
      character(len=*), parameter :: only = ': has no effect but with case%task = ''coefficients'''
      character(len=*), parameter :: without = ': has no effect with case%task = ''coefficients'''
      associate (c => inputs%coefficients, o => inputs%operation)
         if (inputs%about%task /= 'coefficients') then
            call require(size(c%frequency_ratio) == 1 .and. .not. any(abs(c%frequency_ratio - 1) > 0), &
               & 'coefficients%frequency_ratio = '//to_text(c%frequency_ratio(1))//only, error)
            call require(.not. abs(c%threshold_up_to_rpm) > 0, 'coefficients%threshold_up_to_rpm = ' &
               & //to_text(c%threshold_up_to_rpm)//only, error)
            call require(.not. abs(c%cross_stiffness) > 0, 'coefficients%cross_stiffness = ' &
               & //to_text(c%cross_stiffness)//only, error)
            return
         end if
         call require(.not. abs(o%final_speed_rpm - o%speed_rpm) > 0, 'operation%final_speed_rpm = ' &
            & //to_text(o%final_speed_rpm)//': must be operation%speed_rpm = '//to_text(o%speed_rpm) &
            & //' with case%task = ''coefficients''; a study varies the speed', error)
         call require(.not. c%threshold_up_to_rpm > 0 .or. c%threshold_up_to_rpm > o%speed_rpm, &
            & 'coefficients%threshold_up_to_rpm = '//to_text(c%threshold_up_to_rpm) &
            & //': must be 0 or above operation%speed_rpm = '//to_text(o%speed_rpm)//', where the search starts', error)
         call require(inputs%start%from == 'equilibrium', 'start%from = '''//inputs%start%from//''''//without, error)
         associate (s => inputs%start)
            call require(.not. any(abs([s%journal, s%journal_velocity, s%pad_tilt, s%pad_tilt_rate, &
               & s%pivot_deflection, s%pivot_deflection_rate]) > 0), 'start%journal = '//to_text(s%journal(1)) &
               & //', ...: a disturbance'//without, error)
         end associate
      end associate
   end subroutine check_coefficients

   !> The group periodic belongs to its task, which needs a constant speed and takes its samples over the period.
   subroutine check_periodic(inputs, error)
      type(case_type), intent(in) :: inputs
      type(error_type), allocatable, intent(inout) :: error
      type(periodic_type), parameter :: default = periodic_type()
      character(len=*), parameter :: only = ': has no effect but with case%task = ''periodic'', or ''branch'' of orbits'
      character(len=:), allocatable :: with
      with = ' with case%task = '''//inputs%about%task//''''
      associate (p => inputs%periodic, o => inputs%operation)
         if (.not. inputs%seeks_orbits()) then
            call require(p%revolutions == default%revolutions, 'periodic%revolutions = '//to_text(p%revolutions) &
               & //only, error)
            call require(.not. abs(p%tolerance - default%tolerance) > 0, 'periodic%tolerance = ' &
               & //to_text(p%tolerance)//only, error)
            call require(p%max_iterations == default%max_iterations, 'periodic%max_iterations = ' &
               & //to_text(p%max_iterations)//only, error)
            return
         end if
         call require(.not. abs(o%final_speed_rpm - o%speed_rpm) > 0, 'operation%final_speed_rpm = ' &
            & //to_text(o%final_speed_rpm)//': must be operation%speed_rpm = '//to_text(o%speed_rpm) &
            & //with, error)
         call require(.not. inputs%output%start_time > 0, 'output%start_time = '//to_text(inputs%output%start_time) &
            & //': has no effect'//with, error)
         call require(.not. inputs%integration%stop_when_periodic > 0, 'integration%stop_when_periodic = ' &
            & //to_text(inputs%integration%stop_when_periodic)//': has no effect'//with, error)
      end associate
   end subroutine check_periodic

   !> The group branch belongs to its task, which needs a parameter, its last value and a step; `branch_parameter`
   !> checks what they mean. At an equilibrium there is no motion, and so no start of one.
   subroutine check_branch(inputs, error)
      type(case_type), intent(in) :: inputs
      type(error_type), allocatable, intent(inout) :: error
      type(branch_type) :: default
      character(len=*), parameter :: only = ': has no effect but with case%task = ''branch'''
      character(len=*), parameter :: without = ': has no effect on a branch of equilibria'
      associate (b => inputs%branch, s => inputs%start, o => inputs%operation)
         if (inputs%about%task /= 'branch') then
            call require(b%of == 'periodic', 'branch%of = '''//b%of//''''//only, error)
            call require(b%parameter == '', 'branch%parameter = '''//b%parameter//''''//only, error)
            call require(.not. is_set(b%last), 'branch%last = '//to_text(b%last)//only, error)
            call require(.not. is_set(b%step), 'branch%step = '//to_text(b%step)//only, error)
            call require(.not. b%max_step > 0, 'branch%max_step = '//to_text(b%max_step)//only, error)
            call require(b%max_points == default%max_points, 'branch%max_points = '//to_text(b%max_points)//only, error)
            call require(b%switch, 'branch%switch = .false.'//only, error)
            return
         end if
         call require(b%parameter /= '', 'branch%parameter = '''': must name a number of the input, such as ' &
            & //'''operation%speed_rpm''', error)
         call require(is_set(b%last), 'branch%last: must be given, the last value of '//b%parameter, error)
         call require(is_set(b%step), 'branch%step: must be given, the first change of '//b%parameter, error)
         call require(.not. b%max_step > 0 .or. b%max_step >= abs(b%step), 'branch%max_step = ' &
            & //to_text(b%max_step)//': must be 0 or at least the size of branch%step = '//to_text(b%step), error)
         if (b%of == 'periodic') return
         call require(.not. abs(o%final_speed_rpm - o%speed_rpm) > 0, 'operation%final_speed_rpm = ' &
            & //to_text(o%final_speed_rpm)//': must be operation%speed_rpm = '//to_text(o%speed_rpm) &
            & //' with case%task = ''branch''', error)
         call require(s%from == 'equilibrium', 'start%from = '''//s%from//''''//without, error)
         call require(.not. any(abs([s%journal, s%journal_velocity, s%pad_tilt, s%pad_tilt_rate, &
            & s%pivot_deflection, s%pivot_deflection_rate]) > 0), 'start%journal = '//to_text(s%journal(1)) &
            & //', ...: a disturbance'//without, error)
         call require(b%switch, 'branch%switch = .false.'//without, error)
      end associate
   end subroutine check_branch
end module task_checks
