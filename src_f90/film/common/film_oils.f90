!> The oil in a pad's film: its viscosity, and what the Reynolds equation keeps of a viscosity that changes along the
!> arc and across the film (docs/theory/film.md, *Uneven viscosity*).
!>
!> With mu(x, zeta), zeta = y/h from the pad to the journal, and J_n the integral of zeta^n/mu over the film,
!>    f1 = 1 - J_1/J_0,   f2 = J_2 - J_1^2/J_0,   f0 = 1/J_0,
!>    (h^3 f2 p_x)_x + h^3 f2 p_zz = U (h f1)_x + h_t,
!> x with the journal; sliding resists by f0 U/h + f1 h p_x. Of one viscosity f1 = 1/2, f2 = 1/(12 mu), f0 = mu. Here
!> 12 mu f2, f1 and f0/mu, mu the pad's viscosity, are functions of the place on the arc: polynomials of it, from -1 at
!> the leading to 1 at the trailing edge, two of them of the logarithm.
module film_oils
   use kinds, only: wp
   use pad_gap, only: pad_gap_type
   implicit none (type, external)
   private
   public :: film_oil, arc_weights, weights_degree

   !> Degree of the polynomials: of temperatures of pads it leaves 0.03 % of the stiffness and 0.3 % of the damping.
   integer, parameter :: weights_degree = 4

   type :: film_oil
      !> Dynamic viscosity, Pa s.
      real(wp) :: viscosity = 0
      !> False where all of the oil has this viscosity, so that the polynomials do not count.
      logical :: varies = .false.
      !> Coefficients of ln(12 mu f2), f1 and ln(f0/mu) over the place.
      real(wp) :: flow(0:weights_degree) = 0
      real(wp) :: sliding(0:weights_degree) = [0.5_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp]
      real(wp) :: shear(0:weights_degree) = 0
   contains
      procedure :: weights => weights_at
   end type film_oil

   !> At an angle: 12 mu f2, 2 f1, f0/mu.
   type :: arc_weights
      real(wp) :: flow = 1, sliding = 1, shear = 1
      !> Derivatives over the angle, 1/rad and its powers: of ln(12 mu f2), 1st to 3rd, and of 2 f1, 1st and 2nd.
      real(wp) :: flow_slopes(3) = 0, sliding_slopes(2) = 0
   end type arc_weights

contains

   !> The weights at an angle from the pivot, rad.
   elemental type(arc_weights) function weights_at(self, gap, phi) result(weights)
      class(film_oil), intent(in) :: self
      type(pad_gap_type), intent(in) :: gap
      real(wp), intent(in) :: phi
      real(wp) :: half, x
      integer :: k
      if (.not. self%varies) return
      half = 0.5_wp*gap%arc()
      x = (0.5_wp*(gap%leading_angle - gap%trailing_angle) - phi)/half
      weights%flow = exp(polynomial(self%flow, x, 0))
      weights%shear = exp(polynomial(self%shear, x, 0))
      weights%sliding = 2*polynomial(self%sliding, x, 0)
      weights%flow_slopes = [(polynomial(self%flow, x, k)/(-half)**k, k=1, 3)]
      weights%sliding_slopes = [(2*polynomial(self%sliding, x, k)/(-half)**k, k=1, 2)]
   end function weights_at

   !> The derivative of this order of the polynomial with coefficients c at x.
   pure real(wp) function polynomial(c, x, order)
      real(wp), intent(in) :: c(0:), x
      integer, intent(in) :: order
      integer :: i, k
      polynomial = 0
      do i = ubound(c, 1), order, -1
         polynomial = polynomial*x + c(i)*product([(real(k, wp), k=i - order + 1, i)])
      end do
   end function polynomial
end module film_oils
