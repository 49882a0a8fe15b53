!> Profiles across a film whose viscosity changes there: velocities, shear and what of them is in each layer, from the
!> oil's fluidity, which is even in a layer (docs/theory/heat.md, *Temperature in the film*).
!>
!> With zeta = y/h from the pad to the journal and J_n the integral of zeta^n/mu, sliding and pressure drive
!>    u = U M_0(zeta)/J_0 + h^2 p_x (M_1(zeta) - b M_0(zeta)),   b = J_1/J_0,
!> M_n(zeta) the integral up to zeta.
module film_profiles
   use kinds, only: wp, pi
   use linear_algebra, only: dgesv
   use film_oils, only: film_oil, uneven_oil, weights_degree
   implicit none (type, external)
   private
   public :: film_profile, layer_faces, new_profile, fitted_oil

   !> At one place on the arc.
   type :: film_profile
      !> f0, Pa s; f1; f2, 1/(Pa s); b.
      real(wp) :: f0 = 0, f1 = 0, f2 = 0, b = 0
      !> Below each face between layers, 0 (pad) to n (journal): what sliding drives over U h, pressure over -h^3 p_x.
      real(wp), allocatable :: sliding(:), driven(:)
      !> Of each layer the integrals of (u_sliding')^2 mu over U^2, Pa s, of (u_pressure')^2 mu over (h^2 p_x)^2,
      !> 1/(Pa s), and of twice their product over U h^2 p_x: they add up to f0, f2 and 0.
      real(wp), allocatable :: shear(:), pressure(:), mixed(:)
   end type film_profile

contains

   !> Faces of n layers, 0 to n, close at both walls.
   pure function layer_faces(n) result(zeta)
      integer, intent(in) :: n
      real(wp) :: zeta(0:n)
      integer :: j
      zeta = [((1 - cos(pi*j/n))/2, j=0, n)]
   end function layer_faces

   !> Of layers between these faces with these fluidities, 1/(Pa s).
   pure type(film_profile) function new_profile(zeta, fluidity) result(profile)
      real(wp), intent(in) :: zeta(0:), fluidity(:)
      real(wp), dimension(size(fluidity)) :: m0, m1, m2, inner
      real(wp), dimension(0:size(fluidity)) :: sum0, sum1
      integer :: j
      associate (n => size(fluidity), low => zeta(:size(fluidity) - 1), high => zeta(1:))
         m0 = fluidity*(high - low)
         m1 = fluidity*(high**2 - low**2)/2
         m2 = fluidity*(high**3 - low**3)/3
         sum0 = 0
         sum1 = 0
         do j = 1, n
            sum0(j) = sum0(j - 1) + m0(j)
            sum1(j) = sum1(j - 1) + m1(j)
         end do
         profile%b = sum1(n)/sum0(n)
         profile%f0 = 1/sum0(n)
         allocate (profile%sliding(0:n), profile%driven(0:n), source=0.0_wp)
         ! M_1 in a layer is a parabola, M_0 a line
         inner = sum1(:n - 1)*(high - low) + fluidity/2*((high**3 - low**3)/3 - low**2*(high - low))
         do j = 1, n
            associate (mean => (sum0(j - 1) + sum0(j))/2*(zeta(j) - zeta(j - 1)))
               profile%sliding(j) = profile%sliding(j - 1) + mean/sum0(n)
               profile%driven(j) = profile%driven(j - 1) + profile%b*mean - inner(j)
            end associate
         end do
         profile%f1 = profile%sliding(n)
         profile%f2 = profile%driven(n)
         profile%shear = m0*profile%f0**2
         profile%pressure = m2 - 2*profile%b*m1 + profile%b**2*m0
         profile%mixed = 2*profile%f0*(m1 - profile%b*m0)
      end associate
   end function new_profile

   !> An oil with this viscosity, Pa s, and the weights of these profiles at the middles of equal steps from the leading
   !> to the trailing edge, by least squares.
   type(film_oil) function fitted_oil(viscosity, profiles) result(oil)
      real(wp), intent(in) :: viscosity
      type(film_profile), intent(in) :: profiles(:)
      real(wp) :: powers(size(profiles), 0:weights_degree), matrix(0:weights_degree, 0:weights_degree)
      real(wp) :: right(0:weights_degree, 3)
      integer :: i, k, info, pivots(weights_degree + 1)
      associate (n => size(profiles))
         do k = 0, weights_degree
            powers(:, k) = [((real(2*i - 1, wp)/n - 1)**k, i=1, n)]
         end do
         matrix = matmul(transpose(powers), powers)
         right(:, 1) = matmul(log(12*viscosity*profiles%f2), powers)
         right(:, 2) = matmul(profiles%f1, powers)
         right(:, 3) = matmul(log(profiles%f0/viscosity), powers)
      end associate
      call dgesv(size(matrix, 1), 3, matrix, size(matrix, 1), pivots, right, size(right, 1), info)
      oil = uneven_oil(viscosity, right)
   end function fitted_oil
end module film_profiles
