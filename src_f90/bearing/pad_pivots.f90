!> Contact and friction of the pivots of a bearing's pads.
module pad_pivots
   use case_groups, only: pivot_type, friction_type
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

   !> The contact of every pivot, which takes time to make: equal ones are made once; for a motion or not.
   subroutine make_contacts(v, moves, pivots)
      type(pivot_type), intent(in) :: v
      logical, intent(in) :: moves
      type(pad_pivot), intent(inout) :: pivots(:)
      integer :: i, k
      do i = 1, size(pivots)
         do k = 1, i - 1
            if (abs(v%socket_radius(i) - v%socket_radius(k)) <= 0 &
               & .and. abs(v%radius_difference(i) - v%radius_difference(k)) <= 0) exit
         end do
         if (k < i) then
            pivots(i)%contact = pivots(k)%contact
         else
            call make_contact(v, i, moves, pivots(i)%contact)
         end if
      end do
   end subroutine make_contacts

   !> The friction of every pivot.
   subroutine make_frictions(friction, pivots)
      type(friction_type), intent(in) :: friction
      type(pad_pivot), intent(inout) :: pivots(:)
      integer :: i
      do i = 1, size(pivots)
         call make_friction(friction, i, pivots(i)%friction)
      end do
   end subroutine make_frictions
end module pad_pivots
