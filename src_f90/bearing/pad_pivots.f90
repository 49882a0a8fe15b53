!> Contact and friction of the pivots of a bearing's pads.
module pad_pivots
   use case_inputs, only: case_type
   use contact_table, only: contact_table_type
   use friction, only: friction_law
   use factories, only: make_contact, make_friction
   implicit none (type, external)
   private
   public :: pad_pivot, make_contacts, make_frictions

   type :: pad_pivot
      type(contact_table_type) :: contact
      class(friction_law), allocatable :: friction
   end type pad_pivot

contains

   !> The contact of every pivot, which takes time to make: equal ones are made once.
   subroutine make_contacts(inputs, pivots)
      type(case_type), intent(in) :: inputs
      type(pad_pivot), intent(inout) :: pivots(:)
      integer :: i, k
      associate (v => inputs%pivot)
         do i = 1, size(pivots)
            do k = 1, i - 1
               if (abs(v%socket_radius(i) - v%socket_radius(k)) <= 0 &
                  & .and. abs(v%radius_difference(i) - v%radius_difference(k)) <= 0) exit
            end do
            if (k < i) then
               pivots(i)%contact = pivots(k)%contact
            else
               call make_contact(inputs, i, pivots(i)%contact)
            end if
         end do
      end associate
   end subroutine make_contacts

   !> The friction of every pivot.
   subroutine make_frictions(inputs, pivots)
      type(case_type), intent(in) :: inputs
      type(pad_pivot), intent(inout) :: pivots(:)
      integer :: i
      do i = 1, size(pivots)
         call make_friction(inputs, i, pivots(i)%friction)
      end do
   end subroutine make_frictions
end module pad_pivots
