!> The basis of Craig and Bampton (AIAA Journal 6 (1968) 1313-1319): static deflections of a rotor over displacements of
!> its journals, and its vibration modes with the journals held.
module fixed_interface
   ! heap: matrices of all displacements of a shaft
   use kinds, only: wp
   use linear_algebra, only: dpotrf, dpotrs, dsygv
   use rotor_component, only: rotor_component_type, in_planes
   implicit none (type, external)
   private
   public :: fixed_interface_type, find_fixed_interface

   !> Of one plane where both are alike. `border`: displacements of the journals among all; `inner`: the others.
   type :: fixed_interface_type
      integer :: planes = 1
      integer, allocatable :: border(:), inner(:)
      !> Deflections over unit displacements of the journals, (displacement, journal's).
      real(wp), allocatable :: static(:, :)
      !> Modes with the journals held, (displacement, mode), with modal masses 1, the lowest first; rad/s.
      real(wp), allocatable :: modes(:, :), frequency(:)
      !> Cholesky factor of the inner stiffness.
      real(wp), allocatable, private :: factor(:, :)
   contains
      procedure :: basis
      procedure :: residual_deflection
   end type fixed_interface_type

   !> The smallest part of a stiffness that elimination may leave: less is rounding.
   real(wp), parameter :: rounding = 1e-13_wp

contains

   !> The basis of a rotor, and whether its journals hold it (else the basis is not found). `border`: the displacements
   !> of the journals, y and z of each.
   subroutine find_fixed_interface(component, border, fixed, held)
      type(rotor_component_type), intent(in) :: component
      integer, intent(in) :: border(:)
      type(fixed_interface_type), intent(out) :: fixed
      logical, intent(out) :: held
      real(wp), allocatable :: mass(:, :), stiffness(:, :), right(:, :)
      integer :: n, i, info
      associate (p => component%planes)
         fixed%planes = p
         fixed%border = (border(::p) + p - 1)/p
         mass = component%mass(::p, ::p)
         stiffness = component%stiffness(::p, ::p)
      end associate
      n = size(mass, 1)
      fixed%inner = pack([(i, i=1, n)], [(all(fixed%border /= i), i=1, n)])
      call factorize(stiffness(fixed%inner, fixed%inner), fixed%factor, held)
      if (.not. held) return
      right = -stiffness(fixed%inner, fixed%border)
      call dpotrs('U', size(right, 1), size(right, 2), fixed%factor, size(right, 1), right, size(right, 1), info)
      allocate (fixed%static(n, size(fixed%border)), source=0.0_wp)
      fixed%static(fixed%inner, :) = right
      do i = 1, size(fixed%border)
         fixed%static(fixed%border(i), i) = 1
      end do
      call find_modes(mass(fixed%inner, fixed%inner), stiffness(fixed%inner, fixed%inner), n, fixed, held)
   end subroutine find_fixed_interface

   !> Cholesky's factor of a matrix; `positive` false where there is none but for rounding.
   subroutine factorize(matrix, factor, positive)
      real(wp), intent(in) :: matrix(:, :)
      real(wp), allocatable, intent(out) :: factor(:, :)
      logical, intent(out) :: positive
      integer :: n, i, info
      n = size(matrix, 1)
      factor = matrix
      call dpotrf('U', n, factor, n, info)
      positive = info == 0
      if (positive) positive = all([(factor(i, i)**2 > rounding*matrix(i, i), i=1, n)])
   end subroutine factorize

   !> Modes of the inner displacements. M x = mu K x is solved, as the largest mu = 1/omega^2 are
   !> the most accurate ones.
   subroutine find_modes(mass, stiffness, n, fixed, found)
      real(wp), intent(in) :: mass(:, :), stiffness(:, :)
      integer, intent(in) :: n
      type(fixed_interface_type), intent(inout) :: fixed
      logical, intent(out) :: found
      real(wp), allocatable :: vectors(:, :), factor(:, :), mu(:), work(:)
      integer :: inner, count, i, info
      inner = size(mass, 1)
      vectors = mass
      factor = stiffness
      allocate (mu(inner), work(34*inner))
      call dsygv(1, 'V', 'U', inner, vectors, inner, factor, inner, mu, work, size(work), info)
      found = info == 0
      if (.not. found) return
      count = merge(0, 1, inner == 0)
      if (count > 0) count = int(sum(merge(1, 0, mu > rounding*mu(inner))))
      allocate (fixed%modes(n, count), source=0.0_wp)
      allocate (fixed%frequency(count))
      do i = 1, count
         associate (value => mu(inner + 1 - i), vector => vectors(:, inner + 1 - i))
            fixed%frequency(i) = 1/sqrt(value)
            ! modes are found with stiffness 1
            fixed%modes(fixed%inner, i) = vector/sqrt(value)
         end associate
      end do
   end subroutine find_modes

   !> Static deflections and this many modes, in all planes: (all displacements, journals and modes), y and z of
   !> each one after the other.
   pure function basis(self, modes)
      class(fixed_interface_type), intent(in) :: self
      integer, intent(in) :: modes
      real(wp), allocatable :: basis(:, :), one(:, :)
      allocate (one(size(self%static, 1), size(self%static, 2) + modes))
      one(:, :size(self%static, 2)) = self%static
      one(:, size(self%static, 2) + 1:) = self%modes(:, :modes)
      basis = in_planes(one, self%planes)
   end function basis

   !> Static deflection under a force on all displacements, N, with the journals held, less what this many modes have
   !> of it.
   function residual_deflection(self, force, modes) result(deflection)
      class(fixed_interface_type), intent(in) :: self
      real(wp), intent(in) :: force(:)
      integer, intent(in) :: modes
      real(wp) :: deflection(size(force))
      real(wp), allocatable :: inner(:, :), amplitude(:)
      integer :: p, i, info
      deflection = 0
      do p = 1, self%planes
         associate (plane => force(p::self%planes))
            inner = reshape(plane(self%inner), [size(self%inner), 1])
            call dpotrs('U', size(inner), 1, self%factor, size(inner), inner, size(inner), info)
            amplitude = matmul(plane, self%modes(:, :modes))/self%frequency(:modes)**2
         end associate
         do i = 1, size(self%inner)
            associate (row => self%inner(i))
               deflection(self%planes*(row - 1) + p) = inner(i, 1) - dot_product(self%modes(row, :modes), amplitude)
            end associate
         end do
      end do
   end function residual_deflection
end module fixed_interface
