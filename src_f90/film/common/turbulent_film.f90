!> The turbulent film (film_law): eddies thicken the oil of a laminar one (film_oils) by the factors of a closure
!> (turbulence_closure) at the local Reynolds number rho U h/mu, which follows the film (docs/theory/turbulence.md).
!>
!> Where the viscosity changes along the arc and across the film, mu is the one of the laminar shear, S times the pad's,
!> and the factors multiply the mobility and the shear of the laminar law; what sliding carries stays.
module turbulent_film
   use kinds, only: wp
   use film_law, only: film_law_type, law_at_nodes, most_numbers
   use film_oils, only: film_oil
   use pad_gap, only: pad_gap_type, film_motion
   use turbulence_closure, only: closure_type, closure_factors, along, across, shear
   implicit none (type, external)
   private
   public :: turbulent_film_type, take_oil

   !> Film thickness over the pad clearance that no film of weight exceeds: a pad whose film would be laminar there is
   !> laminar.
   real(wp), parameter :: thickest = 4

   type, extends(film_law_type) :: turbulent_film_type
      !> The oil without eddies, and what eddies do.
      type(film_oil) :: oil
      type(closure_type) :: closure
      !> Reynolds number of a film as thick as the pad clearance, of oil of the law's viscosity, and its logarithm,
      !> where a film has eddies anywhere.
      real(wp) :: reynolds = 0, log_reynolds = 0
      logical :: has_eddies = .false.
   contains
      procedure :: set
      procedure :: reynolds_number
      procedure :: at_nodes
      procedure :: shear_weight
      procedure :: numbers
      procedure :: mirrored
      procedure :: turns_with_thickness
      procedure :: slides_unevenly
   end type turbulent_film_type

contains

   !> Gives the films of pads their oils, of a density, kg/m^3, at a speed of the journal's surface, m/s.
   subroutine take_oil(laws, oil, gaps, density, surface_speed)
      class(film_law_type), intent(inout) :: laws(:)
      type(film_oil), intent(in) :: oil(:)
      type(pad_gap_type), intent(in) :: gaps(:)
      real(wp), intent(in) :: density, surface_speed
      integer :: i
      select type (laws)
      type is (film_oil)
         laws(:) = oil
      type is (turbulent_film_type)
         do i = 1, size(laws)
            call laws(i)%set(oil(i), gaps(i), density, surface_speed)
         end do
      end select
   end subroutine take_oil

   !> Takes the oil of a pad, of a density, kg/m^3, at a speed of the journal's surface, m/s.
   pure subroutine set(self, oil, gap, density, surface_speed)
      class(turbulent_film_type), intent(inout) :: self
      type(film_oil), intent(in) :: oil
      type(pad_gap_type), intent(in) :: gap
      real(wp), intent(in) :: density, surface_speed
      self%oil = oil
      self%viscosity = oil%viscosity
      self%reynolds = density*abs(surface_speed)*gap%machined_clearance/oil%viscosity
      self%has_eddies = thickest*self%reynolds > self%closure%laminar_below
      if (self%has_eddies) self%log_reynolds = log(self%reynolds)
      self%varies = oil%varies .or. self%has_eddies
   end subroutine set

   !> The local Reynolds number at an angle from the pivot, rad.
   elemental real(wp) function reynolds_number(self, gap, motion, phi)
      class(turbulent_film_type), intent(in) :: self
      type(pad_gap_type), intent(in) :: gap
      type(film_motion), intent(in) :: motion
      real(wp), intent(in) :: phi
      reynolds_number = self%reynolds*gap%thickness(motion, sin(phi), cos(phi)) &
         & /(gap%machined_clearance*self%oil%shear_weight(gap, motion, phi))
   end function reynolds_number

   pure subroutine at_nodes(self, gap, motion, sine, cosine, nodes)
      class(turbulent_film_type), intent(in) :: self
      type(pad_gap_type), intent(in) :: gap
      type(film_motion), intent(in) :: motion
      real(wp), intent(in) :: sine(:), cosine(:)
      type(law_at_nodes), intent(inout) :: nodes
      !> ln Re and its slopes along the film, (node, order from 0).
      real(wp) :: r(size(sine), 0:3)
      !> ln(12/kx) and ln(kx/kz), with their derivatives over ln Re.
      real(wp) :: e(0:3), k(0:3)
      type(closure_factors) :: of
      integer :: i, n
      n = size(sine)
      ! exactly 1 where it does not vary
      call self%oil%at_nodes(gap, motion, sine, cosine, nodes)
      if (.not. self%has_eddies) return
      if (.not. allocated(nodes%across)) allocate (nodes%across(n), nodes%across_slope(n), nodes%flow_power(n, 0:2), &
         & nodes%across_power(n, 0:1))
      r = reynolds_slopes(self, gap, motion, sine, cosine)
      do i = 1, n
         of = self%closure%at(r(i, 0))
         e = of%value(:, along)
         k = of%value(:, across)
         associate (first => r(i, 1), second => r(i, 2))
            nodes%inverse_root(i) = nodes%inverse_root(i)*exp(-e(0)/2)
            nodes%flow_slopes(i, :) = nodes%flow_slopes(i, :) + [e(1)*first, e(2)*first**2 + e(1)*second, &
               & e(3)*first**3 + 3*e(2)*first*second + e(1)*r(i, 3)]
            nodes%flow_power(i, :) = [e(1), e(2)*first, e(3)*first**2 + e(2)*second]
            nodes%across(i) = exp(k(0))
            nodes%across_slope(i) = k(1)*first
            nodes%across_power(i, :) = [k(1), k(2)*first]
         end associate
      end do
   end subroutine at_nodes

   !> ln Re at nodes and its first three slopes along the film, (node, order from 0).
   pure function reynolds_slopes(self, gap, motion, sine, cosine) result(r)
      class(turbulent_film_type), intent(in) :: self
      type(pad_gap_type), intent(in) :: gap
      type(film_motion), intent(in) :: motion
      real(wp), intent(in) :: sine(:), cosine(:)
      real(wp) :: r(size(sine), 0:3)
      r = gap%thickness_slopes(motion, sine, cosine)
      r(:, 0) = self%log_reynolds + r(:, 0)
      if (self%oil%varies) r = r - self%oil%shear_slopes(gap, sine, cosine)
   end function reynolds_slopes

   elemental real(wp) function shear_weight(self, gap, motion, phi) result(weight)
      class(turbulent_film_type), intent(in) :: self
      type(pad_gap_type), intent(in) :: gap
      type(film_motion), intent(in) :: motion
      real(wp), intent(in) :: phi
      weight = self%oil%shear_weight(gap, motion, phi)
      if (self%has_eddies) weight = weight*exp(self%closure%value_of(shear, &
         & log(self%reynolds_number(gap, motion, phi))))
   end function shear_weight

   pure function numbers(self)
      class(turbulent_film_type), intent(in) :: self
      real(wp) :: numbers(most_numbers)
      numbers = self%oil%numbers()
      associate (closure => self%closure)
         if (self%has_eddies) numbers(most_numbers - 3:) = [real(closure%kind, wp), closure%laminar_below, &
            & closure%turbulent_above, self%log_reynolds]
      end associate
   end function numbers

   function mirrored(self)
      class(turbulent_film_type), intent(in) :: self
      class(film_law_type), allocatable :: mirrored, oil
      type(turbulent_film_type) :: other
      other = self
      oil = self%oil%mirrored()
      select type (oil)
      type is (film_oil)
         other%oil = oil
      end select
      allocate (mirrored, source=other)
   end function mirrored

   pure logical function turns_with_thickness(self)
      class(turbulent_film_type), intent(in) :: self
      turns_with_thickness = self%has_eddies
   end function turns_with_thickness

   pure logical function slides_unevenly(self)
      class(turbulent_film_type), intent(in) :: self
      slides_unevenly = self%oil%varies
   end function slides_unevenly
end module turbulent_film
