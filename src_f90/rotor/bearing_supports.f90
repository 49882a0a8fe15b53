!> Supports of bearings: housings on springs and dampers, which move with displacements of their own.
module bearing_supports
   use kinds, only: wp
   use case_groups, only: bearing_type
   implicit none (type, external)
   private
   public :: relative_displacements, add_supports

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

   !> Adds masses, springs, dampers and weights of the housings to matrices in the displacements x.
   pure subroutine add_supports(bearings, gravity, mass, damping, stiffness, load)
      type(bearing_type), intent(in) :: bearings(:)
      !> m/s^2
      real(wp), intent(in) :: gravity
      real(wp), intent(inout) :: mass(:, :), damping(:, :), stiffness(:, :), load(:)
      integer :: b, i, p
      i = 2*size(bearings)
      do b = 1, size(bearings)
         if (.not. allocated(bearings(b)%support)) cycle
         associate (s => bearings(b)%support)
            load(i + 1) = load(i + 1) - gravity*s%mass
            do p = 1, 2
               i = i + 1
               mass(i, i) = mass(i, i) + s%mass
               damping(i, i) = damping(i, i) + s%damping(p)
               stiffness(i, i) = stiffness(i, i) + s%stiffness(p)
            end do
         end associate
      end do
   end subroutine add_supports

   pure function has_support(bearings) result(has)
      type(bearing_type), intent(in) :: bearings(:)
      logical :: has(size(bearings))
      integer :: b
      has = [(allocated(bearings(b)%support), b=1, size(bearings))]
   end function has_support
end module bearing_supports
