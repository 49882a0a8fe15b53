!> Builds the rotor of a case.
module rotor_factory
   use case_inputs, only: case_type
   use abstract_rotor, only: rotor_type
   use rigid_journal, only: new_rigid_journal
   implicit none (type, external)
   private
   public :: make_rotor

contains

   subroutine make_rotor(inputs, rotor)
      type(case_type), intent(in) :: inputs
      class(rotor_type), allocatable, intent(out) :: rotor
      allocate (rotor, source=new_rigid_journal(inputs%rotor%mass))
   end subroutine make_rotor
end module rotor_factory
