!> The parts of a bearing that a case makes at once: pads, friction, asperities. Films and contact take time to make.
module bearing_construction
   use kinds, only: wp
   use case_inputs, only: case_type
   use friction, only: friction_law
   use asperity_contact, only: asperity_contact_type
   use tilting_pad, only: tilting_pad_type
   use factories, only: make_friction, new_asperities, new_pads
   implicit none (type, external)
   private
   public :: bearing_parts_type

   type :: bearing_parts_type
      type(tilting_pad_type), allocatable :: pads(:)
      !> Of each pad rates of tilt rate and pivot deflection rate per moment and force, (2, 2, pad).
      real(wp), allocatable :: per_mass(:, :, :)
      class(friction_law), allocatable :: friction
      type(asperity_contact_type) :: asperities
      !> Bearing clearance, m.
      real(wp) :: clearance = 0
   contains
      procedure :: set_parts
   end type bearing_parts_type

contains

   !> Makes them those of a case.
   subroutine set_parts(self, inputs)
      class(bearing_parts_type), intent(inout) :: self
      type(case_type), intent(in) :: inputs
      integer :: i
      self%pads = new_pads(inputs)
      self%per_mass = reshape([(self%pads(i)%inverse_masses(), i=1, size(self%pads))], [2, 2, size(self%pads)])
      self%clearance = inputs%bearing%assembled_clearance
      call make_friction(inputs, self%friction)
      self%asperities = new_asperities(inputs)
   end subroutine set_parts
end module bearing_construction
