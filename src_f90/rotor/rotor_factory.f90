!> Builds the rotor of a case.
module rotor_factory
   use kinds, only: wp, rpm
   use text, only: to_text
   use errors, only: error_type
   use case_inputs, only: case_type
   use rotor_matrices, only: rotor_matrices_type
   use shaft_in_bearings, only: find_rotor
   use abstract_rotor, only: rotor_type
   use rigid_journal, only: new_rigid_journal
   use elastic_rotor, only: elastic_rotor_type, new_elastic_rotor
   implicit none (type, external)
   private
   public :: make_rotor

contains

   !> The rotor of a case. A shaft that has no equations is refused.
   subroutine make_rotor(inputs, rotor, refusal, before)
      type(case_type), intent(in) :: inputs
      class(rotor_type), allocatable, intent(out) :: rotor
      !> Not allocated where there is a rotor.
      character(len=:), allocatable, intent(out) :: refusal
      !> A rotor of as many displacements; where it is left out the shaft has as many as the highest speed needs.
      class(rotor_type), intent(in), optional :: before
      type(rotor_matrices_type) :: matrices
      type(elastic_rotor_type) :: elastic
      type(error_type), allocatable :: error
      integer, allocatable :: modes
      logical :: ok
      if (inputs%rotor%is_rigid()) then
         allocate (rotor, source=new_rigid_journal(inputs%rotor%mass))
         return
      end if
      if (present(before)) then
         select type (before)
         type is (elastic_rotor_type)
            modes = size(before%matrices%mode_frequency)
         end select
      end if
      call find_rotor(inputs, highest_speed(inputs), matrices, error, modes)
      if (allocated(error)) then
         refusal = error%message
         return
      end if
      call new_elastic_rotor(matrices, inputs%unbalance(), elastic, ok)
      if (.not. ok) then
         refusal = 'the equations of the shaft are singular'
      else if (any(inputs%excitations%station > elastic%stations)) then
         refusal = 'excitation: station = '//to_text(maxval(inputs%excitations%station))//': the rotor has '// &
            & to_text(elastic%stations)//' stations'
      else
         allocate (rotor, source=elastic)
      end if
   end subroutine make_rotor

   !> Highest speed of a task, rad/s, with those of a branch over the speed and of a search of threshold speeds.
   pure real(wp) function highest_speed(inputs)
      type(case_type), intent(in) :: inputs
      highest_speed = inputs%highest_speed()
      associate (branch => inputs%branch, task => inputs%about%task)
         if (task == 'coefficients') highest_speed = max(highest_speed, inputs%coefficients%threshold_up_to_rpm*rpm)
         if (task /= 'branch') return
         if (branch%parameter == 'operation%speed_rpm') highest_speed = max(highest_speed, branch%last*rpm)
      end associate
   end function highest_speed
end module rotor_factory
