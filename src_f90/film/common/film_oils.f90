!> The laminar film (film_law): oil of uniform viscosity, or what the Reynolds equation keeps of a viscosity that
!> changes along the arc and across the film (docs/theory/film.md, *Variable viscosity*).
!>
!> With mu(x, zeta), zeta = y/h from the pad to the journal, and J_n the integral of zeta^n/mu over the film,
!>    f1 = 1 - J_1/J_0,   f2 = J_2 - J_1^2/J_0,   f0 = 1/J_0,
!>    (h^3 f2 p_x)_x + h^3 f2 p_zz = U (h f1)_x + h_t,
!> x with the journal; sliding resists by f0 U/h + f1 h p_x. Of one viscosity f1 = 1/2, f2 = 1/(12 mu), f0 = mu. So
!> E = 12 mu f2, G = 2 f1 and S = f0/mu, mu the pad's viscosity, are functions of the place on the arc: polynomials of
!> it, from -1 at the leading to 1 at the trailing edge, two of them of the logarithm.
module film_oils
   use kinds, only: wp, pi
   use film_law, only: film_law_type, law_at_nodes, most_numbers
   use pad_gap, only: pad_gap_type, film_motion
   implicit none (type, external)
   private
   public :: film_oil, even_oil, uneven_oil, weights_degree, polynomials

   !> Degree of the polynomials: of temperatures of pads it leaves 0.03 % of the stiffness and 0.3 % of the damping.
   integer, parameter :: weights_degree = 4
   !> Of flow, sliding and shear.
   integer, parameter :: polynomials = 3

   !> Where it does not vary all of the oil has the law's viscosity: the polynomials do not count.
   type, extends(film_law_type) :: film_oil
      !> Coefficients of ln(12 mu f2), f1 and ln(f0/mu) over the place.
      real(wp) :: flow(0:weights_degree) = 0
      real(wp) :: sliding(0:weights_degree) = [0.5_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp]
      real(wp) :: shear(0:weights_degree) = 0
   contains
      procedure :: at_nodes
      procedure :: shear_weight
      procedure :: shear_slopes
      procedure :: numbers
      procedure :: mirrored
      procedure :: coefficients
   end type film_oil

   !> Series of atan; halvings of the exponent, whose own series is short then.
   integer, parameter :: atan_terms = 14, halvings = 5
   real(wp), parameter :: of_atan(0:atan_terms - 1) = [1.0_wp, -1/3.0_wp, 1/5.0_wp, -1/7.0_wp, 1/9.0_wp, -1/11.0_wp, &
      & 1/13.0_wp, -1/15.0_wp, 1/17.0_wp, -1/19.0_wp, 1/21.0_wp, -1/23.0_wp, 1/25.0_wp, -1/27.0_wp]

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

   pure function numbers(self)
      class(film_oil), intent(in) :: self
      real(wp) :: numbers(most_numbers)
      numbers = 0
      if (self%varies) numbers(:polynomials*(1 + weights_degree)) = [self%flow, self%sliding, self%shear]
   end function numbers

   function mirrored(self)
      class(film_oil), intent(in) :: self
      class(film_law_type), allocatable :: mirrored
      real(wp) :: c(0:weights_degree, polynomials)
      c = self%coefficients()
      c(1::2, :) = -c(1::2, :)
      allocate (mirrored, source=uneven_oil(self%viscosity, c))
   end function mirrored

   pure subroutine at_nodes(self, gap, motion, sine, cosine, nodes)
      class(film_oil), intent(in) :: self
      type(pad_gap_type), intent(in) :: gap
      type(film_motion), intent(in) :: motion
      real(wp), intent(in) :: sine(:), cosine(:)
      type(law_at_nodes), intent(inout) :: nodes
      real(wp) :: x(size(sine))
      associate (n => size(sine), of => nodes)
         if (.not. allocated(of%sliding)) allocate (of%inverse_root(n), of%sliding(n), of%flow_slopes(n, 3), &
            & of%sliding_slopes(n, 2))
         call find_places(n, gap, sine, cosine, x)
         call evaluate(n, -2/gap%arc(), self%flow, self%sliding, x, of%inverse_root, of%sliding, of%flow_slopes, &
            & of%sliding_slopes)
      end associate
   end subroutine at_nodes

   !> Places on the arc, from -1 to 1. A quarter of the angle from the middle has a tangent below 0.42 on arcs up to
   !> half a circle, where the series serves to 1e-12.
   pure subroutine find_places(n, gap, sine, cosine, x)
      integer, intent(in) :: n
      type(pad_gap_type), intent(in) :: gap
      real(wp), intent(in) :: sine(n), cosine(n)
      real(wp), intent(out) :: x(n)
      real(wp) :: middle(2), factor, t, angle
      integer :: i, k
      if (gap%arc() > pi) then
         x = place(gap, atan2(sine, cosine))
         return
      end if
      angle = 0.5_wp*(gap%leading_angle - gap%trailing_angle)
      middle = [sin(angle), cos(angle)]
      factor = -8/gap%arc()
      !$omp simd private(t, angle, k)
      do i = 1, n
         t = (sine(i)*middle(2) - cosine(i)*middle(1))/(1 + cosine(i)*middle(2) + sine(i)*middle(1))
         t = t/(1 + sqrt(1 + t**2))
         angle = of_atan(atan_terms - 1)
         do k = atan_terms - 2, 0, -1
            angle = angle*t**2 + of_atan(k)
         end do
         x(i) = factor*angle*t
      end do
   end subroutine find_places

   !> The law at places x of an arc on which the angle is -2 x/unit.
   pure subroutine evaluate(n, unit, flow, sliding, x, root, g, flow_slopes, sliding_slopes)
      integer, intent(in) :: n
      real(wp), intent(in) :: unit, flow(0:4), sliding(0:4), x(n)
      real(wp), intent(out) :: root(n), g(n), flow_slopes(n, 3), sliding_slopes(n, 2)
      real(wp) :: y
      integer :: i, k
      !$omp simd private(y, k)
      do i = 1, n
         y = -(flow(0) + x(i)*(flow(1) + x(i)*(flow(2) + x(i)*(flow(3) + x(i)*flow(4)))))/2**(halvings + 1)
         y = 1 + y*(1 + y/2*(1 + y/3*(1 + y/4*(1 + y/5*(1 + y/6*(1 + y/7*(1 + y/8*(1 + y/9))))))))
         do k = 1, halvings
            y = y*y
         end do
         root(i) = y
         flow_slopes(i, 1) = unit*(flow(1) + x(i)*(2*flow(2) + x(i)*(3*flow(3) + x(i)*4*flow(4))))
         flow_slopes(i, 2) = unit**2*(2*flow(2) + x(i)*(6*flow(3) + x(i)*12*flow(4)))
         flow_slopes(i, 3) = unit**3*(6*flow(3) + x(i)*24*flow(4))
         g(i) = 2*(sliding(0) + x(i)*(sliding(1) + x(i)*(sliding(2) + x(i)*(sliding(3) + x(i)*sliding(4)))))
         sliding_slopes(i, 1) = 2*unit*(sliding(1) + x(i)*(2*sliding(2) + x(i)*(3*sliding(3) + x(i)*4*sliding(4))))
         sliding_slopes(i, 2) = 2*unit**2*(2*sliding(2) + x(i)*(6*sliding(3) + x(i)*12*sliding(4)))
      end do
   end subroutine evaluate

   elemental real(wp) function shear_weight(self, gap, motion, phi) result(weight)
      class(film_oil), intent(in) :: self
      type(pad_gap_type), intent(in) :: gap
      type(film_motion), intent(in) :: motion
      real(wp), intent(in) :: phi
      real(wp) :: x
      weight = 1
      if (.not. self%varies) return
      x = place(gap, phi)
      associate (c => self%shear)
         weight = exp(c(0) + x*(c(1) + x*(c(2) + x*(c(3) + x*c(4)))))
      end associate
   end function shear_weight

   !> ln S at nodes, and its first three slopes along the film: (node, order from 0).
   pure function shear_slopes(self, gap, sine, cosine) result(slopes)
      class(film_oil), intent(in) :: self
      type(pad_gap_type), intent(in) :: gap
      real(wp), intent(in) :: sine(:), cosine(:)
      real(wp) :: slopes(size(sine), 0:3), x(size(sine))
      call find_places(size(sine), gap, sine, cosine, x)
      associate (c => self%shear, unit => -2/gap%arc())
         slopes(:, 0) = c(0) + x*(c(1) + x*(c(2) + x*(c(3) + x*c(4))))
         slopes(:, 1) = unit*(c(1) + x*(2*c(2) + x*(3*c(3) + x*4*c(4))))
         slopes(:, 2) = unit**2*(2*c(2) + x*(6*c(3) + x*12*c(4)))
         slopes(:, 3) = unit**3*(6*c(3) + x*24*c(4))
      end associate
   end function shear_slopes

   !> The place on the arc, from -1 to 1, at an angle from the pivot, rad.
   elemental real(wp) function place(gap, phi)
      type(pad_gap_type), intent(in) :: gap
      real(wp), intent(in) :: phi
      place = (gap%leading_angle - gap%trailing_angle - 2*phi)/gap%arc()
   end function place
end module film_oils
