!> Static equilibrium of a rotor and the pads of its bearings at constant speed: no unbalance, no friction.
module equilibrium
   use kinds, only: wp
   use errors, only: error_type, stopped, asked_to_stop, asked
   use text, only: to_text
   use equations_of_motion, only: machine_model
   use equilibrium_record, only: equilibrium_type, describe_with_stability
   use static_model, only: make_static
   use bearing_equilibrium, only: find_bearing_equilibrium, settle
   use thermal_equilibrium, only: solve_shape
   use load_shares, only: share_loads
   use case_inputs, only: case_type
   use case_checks, only: check_case
   use case_parameter, only: case_parameter_type, find_parameter
   implicit none (type, external)
   private
   public :: find_equilibrium, settle_equilibrium

   !> Parts of load or speed at which a branch may begin.
   real(wp), parameter :: parts(*) = [0.5_wp, 0.25_wp, 0.0625_wp]
   character(len=*), parameter :: speed = 'operation%speed_rpm'

contains

   !> The equilibrium of a model under its loads at its initial speed, stable or of oscillatory instability, with the
   !> temperatures of warm oil; an error where none is found, or, of status `stopped`, where `give_up`, asked between
   !> evaluations of the films, says so.
   subroutine find_equilibrium(model, found, error, give_up)
      type(machine_model), intent(in) :: model
      type(equilibrium_type), intent(out) :: found
      type(error_type), allocatable, intent(out) :: error
      procedure(asked_to_stop), optional :: give_up
      type(machine_model) :: static
      logical :: by_heat
      if (size(model%bearings) > 1) then
         call make_static(model, model%point%cavitation, static)
         call share_loads(static, found, error, give_up)
      else
         call find_bearing_equilibrium(model, found, error, give_up, by_heat)
         if (by_heat) then
            if (error%status /= stopped) call offer_branch(model, error, give_up)
         end if
      end if
      if (allocated(error)) return
      if (any(model%inputs%bearings%changes_shape())) call settle_shape(model, found, error, give_up)
   end subroutine find_equilibrium

   !> Brings an equilibrium of a model in the shapes of its case to one in the shapes that it leads to, of each bearing,
   !> which the record has then; an error where there is none.
   subroutine settle_shape(model, found, error, give_up)
      type(machine_model), intent(in) :: model
      type(equilibrium_type), intent(inout) :: found
      type(error_type), allocatable, intent(out) :: error
      procedure(asked_to_stop), optional :: give_up
      type(machine_model) :: static
      real(wp), allocatable :: y(:)
      call make_static(model, model%point%cavitation, static)
      y = static%static_state(found%rotor, found%pads)
      static%oil = found%oil
      call solve_shape(static, y, found%films, found%shapes, found%residual, error, give_up)
      if (.not. allocated(error)) call describe_with_stability(static, y, found, error)
   end subroutine settle_shape

   !> Brings an equilibrium that another model has found to that of this static one, whose films differ a little; y is
   !> its state.
   subroutine settle_equilibrium(model, found, y, error, give_up)
      type(machine_model), intent(inout) :: model
      type(equilibrium_type), intent(inout) :: found
      real(wp), allocatable, intent(out) :: y(:)
      type(error_type), allocatable, intent(out) :: error
      procedure(asked_to_stop), optional :: give_up
      if (size(model%bearings) > 1) then
         call share_loads(model, found, error, give_up, known=.true.)
         if (.not. allocated(error)) y = model%static_state(found%rotor, found%pads)
      else
         call settle(model, found, y, error, give_up)
      end if
   end subroutine settle_equilibrium

   ! What to give the program next where the heat of a bearing has no equilibrium: the branch that begins at less load,
   ! or at less speed, where there is one, and tells how far there are more: to a fold, or to oil that boils.

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
end module equilibrium
