!> Supports of bearings: housings on springs and dampers, which move with displacements of their own.
module bearing_supports
   use kinds, only: wp
   use case_groups, only: bearing_type, support_type
   use linear_element, only: linear_element_type
   implicit none (type, external)
   private
   public :: relative_displacements, add_supports, support_element

contains

   !> What the displacements of the journals in space and the amplitudes of the modes, n of both, are over displacements
   !> x: those of the journals in their bearings, those of the housings, the amplitudes. A journal in space is displaced
   !> as in its bearing, and as its housing.
   pure function relative_displacements(bearings, n) result(into)
      type(bearing_type), intent(in) :: bearings(:)
      integer, intent(in) :: n
      real(wp), allocatable :: into(:, :)
      integer :: journals, b, i, p
      journals = 2*size(bearings)
      allocate (into(n, n + 2*count(has_support(bearings))), source=0.0_wp)
      do i = 1, n
         into(i, merge(i, i + size(into, 2) - n, i <= journals)) = 1
      end do
      i = journals
      do b = 1, size(bearings)
         if (.not. allocated(bearings(b)%support)) cycle
         do p = 1, 2
            i = i + 1
            into(2*(b - 1) + p, i) = 1
         end do
      end do
   end function relative_displacements

   !> A support as an element on the displacements of its housing.
   pure type(linear_element_type) function support_element(support) result(element)
      type(support_type), intent(in) :: support
      integer :: p
      do p = 1, 2
         element%mass(p, p) = support%mass
         element%damping(p, p) = support%damping(p)
         element%stiffness(p, p) = support%stiffness(p)
      end do
   end function support_element

   !> Adds supports and the weights of their housings to matrices in the displacements x.
   pure subroutine add_supports(bearings, gravity, mass, damping, stiffness, load)
      type(bearing_type), intent(in) :: bearings(:)
      !> m/s^2
      real(wp), intent(in) :: gravity
      real(wp), intent(inout) :: mass(:, :), damping(:, :), stiffness(:, :), load(:)
      type(linear_element_type) :: element
      integer :: b, i
      i = 2*size(bearings)
      do b = 1, size(bearings)
         if (.not. allocated(bearings(b)%support)) cycle
         element = support_element(bearings(b)%support)
         call element%add_to([i + 1, i + 2], mass, damping, stiffness)
         load(i + 1) = load(i + 1) - gravity*element%mass(1, 1)
         i = i + 2
      end do
   end subroutine add_supports

   pure function has_support(bearings) result(has)
      type(bearing_type), intent(in) :: bearings(:)
      logical :: has(size(bearings))
      integer :: b
      has = [(allocated(bearings(b)%support), b=1, size(bearings))]
   end function has_support
end module bearing_supports
