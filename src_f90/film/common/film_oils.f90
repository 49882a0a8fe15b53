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
   public :: film_oil, arc_weights, even_oil, uneven_oil, weights_degree, polynomials

   !> Degree of the polynomials: of temperatures of pads it leaves 0.03 % of the stiffness and 0.3 % of the damping.
   integer, parameter :: weights_degree = 4
   !> Of flow, sliding and shear.
   integer, parameter :: polynomials = 3

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
      procedure :: shear_weight
      procedure :: coefficients
   end type film_oil

   !> At an angle: 12 mu f2, 2 f1.
   type :: arc_weights
      real(wp) :: flow = 1, sliding = 1
      !> Derivatives over the angle, 1/rad and its powers: of ln(12 mu f2), 1st to 3rd, and of 2 f1, 1st and 2nd.
      real(wp) :: flow_slopes(3) = 0, sliding_slopes(2) = 0
   end type arc_weights

contains

   !> Oil all of which has this viscosity, Pa s.
   elemental type(film_oil) function even_oil(viscosity) result(oil)
      real(wp), intent(in) :: viscosity
      oil%viscosity = viscosity
   end function even_oil

   !> The oil of a viscosity, Pa s, with these coefficients of its polynomials, (0:degree, polynomial); all of it has
   !> this viscosity where they are 0.
   pure type(film_oil) function uneven_oil(viscosity, coefficients) result(oil)
      real(wp), intent(in) :: viscosity, coefficients(0:, :)
      oil%viscosity = viscosity
      oil%varies = any(abs(coefficients) > 0)
      if (.not. oil%varies) return
      oil%flow = coefficients(:, 1)
      oil%sliding = coefficients(:, 2)
      oil%shear = coefficients(:, 3)
   end function uneven_oil

   !> The coefficients of flow, sliding and shear, (0:degree, polynomial); 0 where all of the oil has its viscosity.
   pure function coefficients(self)
      class(film_oil), intent(in) :: self
      real(wp) :: coefficients(0:weights_degree, polynomials)
      coefficients = 0
      if (self%varies) coefficients = reshape([self%flow, self%sliding, self%shear], shape(coefficients))
   end function coefficients

   !> The weights at an angle from the pivot, rad.
   elemental type(arc_weights) function weights_at(self, gap, phi) result(weights)
      class(film_oil), intent(in) :: self
      type(pad_gap_type), intent(in) :: gap
      real(wp), intent(in) :: phi
      real(wp) :: flow(0:3), sliding(0:3), unit
      if (.not. self%varies) return
      unit = -2/gap%arc()
      flow = derivatives(self%flow, place(gap, phi))
      sliding = 2*derivatives(self%sliding, place(gap, phi))
      weights%flow = exp(flow(0))
      weights%sliding = sliding(0)
      weights%flow_slopes = flow(1:)*[unit, unit**2, unit**3]
      weights%sliding_slopes = sliding(1:2)*[unit, unit**2]
   end function weights_at

   !> f0/mu at an angle from the pivot, rad.
   elemental real(wp) function shear_weight(self, gap, phi) result(weight)
      class(film_oil), intent(in) :: self
      type(pad_gap_type), intent(in) :: gap
      real(wp), intent(in) :: phi
      real(wp) :: shear(0:3)
      weight = 1
      if (.not. self%varies) return
      shear = derivatives(self%shear, place(gap, phi))
      weight = exp(shear(0))
   end function shear_weight

   !> The place on the arc, from -1 to 1, at an angle from the pivot, rad.
   pure real(wp) function place(gap, phi)
      type(pad_gap_type), intent(in) :: gap
      real(wp), intent(in) :: phi
      place = (gap%leading_angle - gap%trailing_angle - 2*phi)/gap%arc()
   end function place

   !> The polynomial with coefficients c at x and its first three derivatives, by Horner's rule.
   pure function derivatives(c, x) result(d)
      real(wp), intent(in) :: c(0:weights_degree), x
      real(wp) :: d(0:3)
      integer :: i
      d = 0
      do i = weights_degree, 0, -1
         d(3) = d(3)*x + d(2)
         d(2) = d(2)*x + d(1)
         d(1) = d(1)*x + d(0)
         d(0) = d(0)*x + c(i)
      end do
      d(2:) = d(2:)*[2, 6]
   end function derivatives
end module film_oils
