!> What to give the program next where the heat of a bearing has no equilibrium: the branch that begins at less load,
!> or at less speed, where there is one, and tells how far there are more: to a fold, or to oil that boils.
module branch_hint
   use kinds, only: wp
   use text, only: to_text
   use errors, only: error_type, asked_to_stop, asked
   use case_inputs, only: case_type
   use case_checks, only: check_case
   use case_parameter, only: case_parameter_type, find_parameter
   use equations_of_motion, only: machine_model
   use equilibrium_record, only: equilibrium_type
   use bearing_equilibrium, only: find_bearing_equilibrium
   implicit none (type, external)
   private
   public :: offer_branch

   !> Parts of load or speed at which a branch may begin.
   real(wp), parameter :: parts(*) = [0.5_wp, 0.25_wp, 0.0625_wp]
   character(len=*), parameter :: speed = 'operation%speed_rpm'

contains

   !> Adds to the refusal of a model of one bearing the settings of such a branch, if one begins at any of the parts.
   subroutine offer_branch(model, error, give_up)
      type(machine_model), intent(in) :: model
      type(error_type), intent(inout) :: error
      procedure(asked_to_stop), optional :: give_up
      character(len=:), allocatable :: names(:)
      type(case_type) :: inputs
      type(error_type), allocatable :: refused
      integer :: i
      names = [character(len=20) :: load_name(model%inputs), speed]
      do i = 1, size(names)
         inputs = model%inputs
         inputs%about%task = 'branch'
         ! the default of a branch
         inputs%output%keep = 'all'
         inputs%branch%of = 'equilibrium'
         inputs%branch%parameter = trim(names(i))
         call check_case(inputs, refused)
         if (allocated(refused)) return
         call try_parts(model, inputs, error, refused, give_up)
         if (.not. allocated(refused)) return
      end do
   end subroutine offer_branch

   !> The same over the parameter of the branch of these inputs, which belong to the model; `refused` where none begins.
   subroutine try_parts(model, inputs, error, refused, give_up)
      type(machine_model), intent(in) :: model
      type(case_type), intent(in) :: inputs
      type(error_type), intent(inout) :: error
      type(error_type), allocatable, intent(out) :: refused
      procedure(asked_to_stop), optional :: give_up
      type(case_parameter_type) :: parameter
      type(machine_model) :: trial
      type(case_type) :: less
      type(equilibrium_type) :: found
      real(wp) :: value
      integer :: k
      associate (name => inputs%branch%parameter)
         call find_parameter(inputs, name, parameter, refused)
         if (allocated(refused)) return
         value = parameter%value(inputs)
         do k = 1, size(parts)
            less = inputs
            call parameter%set(parts(k)*value, less, refused)
            if (.not. allocated(refused)) then
               trial = model
               call trial%adopt(less, .true.)
               call find_bearing_equilibrium(trial, found, refused, give_up)
            end if
            if (asked(give_up)) return
            if (allocated(refused)) cycle
            error%message = error%message//'; a branch of equilibria shows how far there are some: ' &
               & //'--set case%task=branch --set branch%of=equilibrium --set '//quoted('branch%parameter='//name) &
               & //' --set '//quoted(name//'='//to_text(parts(k)*value))//' --set branch%last='//to_text(value)
            return
         end do
      end associate
   end subroutine try_parts

   !> The number that makes most of the load.
   pure function load_name(inputs) result(name)
      type(case_type), intent(in) :: inputs
      character(len=20) :: name
      character(len=*), parameter :: names(*) = [character(len=20) :: 'rotor%mass', 'rotor%static_load(1)', &
         & 'rotor%static_load(2)']
      associate (r => inputs%rotor)
         name = names(maxloc([r%mass*r%gravity, abs(r%static_load)], dim=1))
      end associate
   end function load_name

   !> As a shell takes it for one word.
   pure function quoted(setting)
      character(len=*), intent(in) :: setting
      character(len=:), allocatable :: quoted
      quoted = setting
      if (index(setting, '(') > 0) quoted = ''''//setting//''''
   end function quoted
end module branch_hint
