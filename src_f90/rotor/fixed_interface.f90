!> The basis of Craig and Bampton (AIAA Journal 6 (1968) 1313-1319) of a rotor: static deflections over displacements of
!> the journals and vibration modes with the journals held.
module fixed_interface
   use kinds, only: wp
   use linear_algebra, only: dpbtrf, dpbtrs, dgbtrf, dgbtrs, dsbgv, dsygv, identity
   use sparse_matrix, only: sparse_matrix_type
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
      !> Frequencies of all modes with the journals held, the lowest first, rad/s; the first modes, at least as many as
      !> find_modes was asked for, (displacement, mode), with modal masses 1.
      real(wp), allocatable :: frequency(:), modes(:, :)
      !> Of the inner displacements, and Cholesky's factor of their stiffness as a band.
      type(sparse_matrix_type), private :: mass, stiffness
      real(wp), allocatable, private :: factor(:, :)
   contains
      procedure :: find_modes
      procedure, private :: half_band_width
      procedure :: basis
      procedure :: add_residual_modes
      procedure :: residual_deflection
   end type fixed_interface_type

   !> The smallest part of a stiffness that elimination may leave: of shafts in one bearing it leaves up to 1e-12 by
   !> rounding, of those in two that are close together 1e-5.
   real(wp), parameter :: least_pivot = 1e-11_wp
   !> The smallest mu = 1/omega^2, relative to the largest one, that is not rounding.
   real(wp), parameter :: rounding = 1e-13_wp
   !> The smallest part of a deflection, by its energy, that modes leave out and that is not rounding.
   real(wp), parameter :: least_residual = 1e-9_wp
   !> How far from its eigenvalue, relative to it, a mode is iterated, and how often: two modes that differ as little
   !> are found as a pair.
   real(wp), parameter :: shift = 1e-8_wp
   integer, parameter :: iterations = 3

contains

   !> The basis of a rotor, as yet without modes, and whether its journals hold it (else the basis is not found).
   !> `border`: the displacements of the journals, y and z of each.
   subroutine find_fixed_interface(component, border, fixed, held)
      type(rotor_component_type), intent(in) :: component
      integer, intent(in) :: border(:)
      type(fixed_interface_type), intent(out) :: fixed
      logical, intent(out) :: held
      integer, allocatable :: plane(:)
      type(sparse_matrix_type) :: coupling
      integer :: n, i
      associate (p => component%planes)
         fixed%planes = p
         fixed%border = (border(::p) + p - 1)/p
         plane = [(i, i=1, component%mass%rows, p)]
      end associate
      n = size(plane)
      fixed%inner = pack([(i, i=1, n)], [(all(fixed%border /= i), i=1, n)])
      associate (inner => plane(fixed%inner), journals => plane(fixed%border))
         fixed%mass = component%mass%part(inner, inner)
         fixed%stiffness = component%stiffness%part(inner, inner)
         coupling = component%stiffness%part(inner, journals)
      end associate
      call factorise(fixed%stiffness, fixed%factor, held)
      if (held) call find_frequencies(fixed, held)
      if (.not. held) return
      allocate (fixed%static(n, size(fixed%border)), fixed%modes(n, 0), source=0.0_wp)
      fixed%static(fixed%inner, :) = -deflections(fixed, coupling%times(identity(size(fixed%border))))
      do i = 1, size(fixed%border)
         fixed%static(fixed%border(i), i) = 1
      end do
   end subroutine find_fixed_interface

   !> Cholesky's factor of a stiffness, and whether there is one.
   subroutine factorise(stiffness, factor, positive)
      type(sparse_matrix_type), intent(in) :: stiffness
      real(wp), allocatable, intent(out) :: factor(:, :)
      logical, intent(out) :: positive
      real(wp), allocatable :: direct(:)
      integer :: k, info
      k = stiffness%half_band_width()
      factor = stiffness%band(0, k)
      direct = factor(k + 1, :)
      call dpbtrf('U', size(factor, 2), k, factor, k + 1, info)
      positive = info == 0
      if (positive) positive = all(factor(k + 1, :)**2 > least_pivot*direct)
   end subroutine factorise

   !> Deflections of the inner displacements under forces on them, N, (displacement, any).
   function deflections(self, forces) result(x)
      class(fixed_interface_type), intent(in) :: self
      real(wp), intent(in) :: forces(:, :)
      real(wp), allocatable :: x(:, :)
      integer :: info
      x = forces
      associate (n => size(self%inner), rows => size(self%factor, 1))
         if (n > 0) call dpbtrs('U', n, rows - 1, size(x, 2), self%factor, rows, x, n, info)
      end associate
   end function deflections

   !> Frequencies of all modes. M x = mu K x is solved, as the largest mu = 1/omega^2 are the most accurate ones.
   subroutine find_frequencies(fixed, found)
      type(fixed_interface_type), intent(inout) :: fixed
      logical, intent(out) :: found
      real(wp), allocatable :: mass(:, :), stiffness(:, :), mu(:), work(:)
      real(wp) :: none(1, 1)
      integer :: n, k, info
      n = size(fixed%inner)
      k = fixed%half_band_width()
      mass = fixed%mass%band(0, k)
      stiffness = fixed%stiffness%band(0, k)
      allocate (mu(n), work(3*n))
      call dsbgv('N', 'U', n, k, k, mass, k + 1, stiffness, k + 1, mu, none, 1, work, info)
      found = info == 0
      if (found) fixed%frequency = 1/sqrt(pack(mu(n:1:-1), mu(n:1:-1) > rounding*maxval(mu)))
   end subroutine find_frequencies

   !> Finds the first modes, where there are not as many yet. Each is iterated by K - omega^2 M, orthogonal to those
   !> before; together they then solve the small problem that is left on them, which parts modes of equal frequencies.
   !> Where the band is so wide that iterations take longer, this is the whole problem, of all modes. The first
   !> component of a mode that is not small is positive.
   subroutine find_modes(self, count)
      class(fixed_interface_type), intent(inout) :: self
      integer, intent(in) :: count
      real(wp), allocatable :: x(:, :), stiffness(:, :), mass(:, :), mu(:), work(:)
      integer :: modes, n, i, info
      if (count <= size(self%modes, 2)) return
      n = size(self%inner)
      if (4*self%half_band_width() > n) then
         modes = size(self%frequency)
         x = identity(n)
      else
         modes = count
         allocate (x(n, modes))
         do i = 1, modes
            if (i <= size(self%modes, 2)) then
               x(:, i) = self%modes(self%inner, i)
            else
               x(:, i) = next_mode(self, x(:, :i - 1))
            end if
         end do
      end if
      mass = matmul(transpose(x), self%mass%times(x))
      stiffness = matmul(transpose(x), self%stiffness%times(x))
      n = size(x, 2)
      allocate (mu(n), work(34*n + 1))
      call dsygv(1, 'V', 'U', n, mass, max(1, n), stiffness, max(1, n), mu, work, size(work), info)
      ! the largest mu comes last; vectors have stiffness 1
      x = matmul(x, mass(:, n:n - modes + 1:-1)/spread(sqrt(mu(n:n - modes + 1:-1)), 1, n))
      deallocate (self%modes)
      allocate (self%modes(size(self%static, 1), modes), source=0.0_wp)
      do i = 1, modes
         self%modes(self%inner, i) = sign(1.0_wp, first_large(x(:, i)))*x(:, i)
      end do
   end subroutine find_modes

   !> Of the larger band of mass and stiffness.
   pure integer function half_band_width(self)
      class(fixed_interface_type), intent(in) :: self
      half_band_width = max(self%mass%half_band_width(), self%stiffness%half_band_width())
   end function half_band_width

   !> The first component that is at least half as large as the largest one.
   pure real(wp) function first_large(x)
      real(wp), intent(in) :: x(:)
      first_large = x(findloc(abs(x) >= maxval(abs(x))/2, .true., dim=1))
   end function first_large

   !> The mode that follows those before, with mass 1, by inverse iteration from a vector without symmetry.
   function next_mode(self, before) result(x)
      type(fixed_interface_type), intent(in) :: self
      real(wp), intent(in) :: before(:, :)
      real(wp) :: x(size(before, 1)), force(size(before, 1), 1), golden
      real(wp), allocatable :: factors(:, :)
      integer :: pivots(size(x)), n, k, i, info
      n = size(x)
      k = self%half_band_width()
      allocate (factors(3*k + 1, n), source=0.0_wp)
      associate (omega => self%frequency(size(before, 2) + 1))
         factors(k + 1:, :) = self%stiffness%band(k, k) - (1 - shift)*omega**2*self%mass%band(k, k)
      end associate
      call dgbtrf(n, n, k, k, factors, 3*k + 1, pivots, info)
      if (info > 0) factors(2*k + 1, info) = epsilon(1.0_wp)*maxval(abs(factors(2*k + 1, :)))
      golden = (sqrt(5.0_wp) - 1)/2
      x = [(modulo(i*golden, 1.0_wp) - golden/3, i=1, n)]
      do i = 0, iterations
         if (i > 0) then
            force(:, 1) = self%mass%times(x)
            call dgbtrs('N', n, k, k, 1, factors, 3*k + 1, pivots, force, n, info)
            x = force(:, 1)
         end if
         ! twice, as a large part of it may be taken away
         x = x - matmul(before, matmul(self%mass%times(x), before))
         x = x/sqrt(dot_product(x, self%mass%times(x)))
         x = x - matmul(before, matmul(self%mass%times(x), before))
         x = x/sqrt(dot_product(x, self%mass%times(x)))
      end do
   end function next_mode

   !> Puts behind the first modes what these leave out of the deflections under forces, (displacement of one plane,
   !> force), N: shapes that are orthogonal to them and to each other over mass and stiffness, with modal masses 1, so
   !> that they count as modes. Deflections that the modes have all of add nothing.
   subroutine add_residual_modes(self, forces, count, added)
      class(fixed_interface_type), intent(inout) :: self
      real(wp), intent(in) :: forces(:, :)
      integer, intent(in) :: count
      integer, intent(out) :: added
      real(wp), allocatable :: x(:, :), shapes(:, :), whole(:, :), mass(:, :), stiffness(:, :), mu(:), work(:)
      real(wp) :: square
      integer :: i, j, info
      associate (inner => self%inner, own => forces(self%inner, :))
         x = deflections(self, own)
         allocate (whole(size(self%static, 1), count + size(forces, 2)), source=0.0_wp)
         whole(:, :count) = self%modes(:, :count)
         shapes = x
         added = 0
         do i = 1, size(x, 2)
            square = dot_product(own(:, i), x(:, i))
            x(:, i) = x(:, i) - matmul(whole(inner, :count), matmul(own(:, i), whole(inner, :count)) &
               & /self%frequency(:count)**2)
            ! twice, as a large part of it may be taken away
            do j = 1, 2
               x(:, i) = x(:, i) - matmul(shapes(:, :added), matmul(self%stiffness%times(x(:, i)), shapes(:, :added)))
            end do
            associate (left => dot_product(x(:, i), self%stiffness%times(x(:, i))))
               if (left <= least_residual*square) cycle
               added = added + 1
               shapes(:, added) = x(:, i)/sqrt(left)
            end associate
         end do
         shapes = shapes(:, :added)
         mass = matmul(transpose(shapes), self%mass%times(shapes))
         stiffness = identity(added)
         allocate (mu(added), work(34*added + 1))
         call dsygv(1, 'V', 'U', added, mass, max(1, added), stiffness, max(1, added), mu, work, size(work), info)
         mu = mu(added:1:-1)
         shapes = matmul(shapes, mass(:, added:1:-1))/spread(sqrt(mu), 1, size(shapes, 1))
         do i = 1, added
            whole(inner, count + i) = sign(1.0_wp, first_large(shapes(:, i)))*shapes(:, i)
         end do
      end associate
      self%modes = whole(:, :count + added)
      self%frequency = [self%frequency(:count), 1/sqrt(mu), self%frequency(count + 1:)]
   end subroutine add_residual_modes

   !> Static deflections and this many modes, which are found, in all planes: (all displacements, journals and modes),
   !> y and z of each one after the other.
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
      real(wp), allocatable :: inner(:, :), whole(:)
      integer :: p
      deflection = 0
      do p = 1, self%planes
         associate (plane => force(p::self%planes))
            inner = deflections(self, reshape(plane(self%inner), [size(self%inner), 1]))
            whole = -matmul(self%modes(:, :modes), matmul(plane, self%modes(:, :modes))/self%frequency(:modes)**2)
         end associate
         whole(self%inner) = whole(self%inner) + inner(:, 1)
         deflection(p::self%planes) = whole
      end do
   end function residual_deflection
end module fixed_interface
