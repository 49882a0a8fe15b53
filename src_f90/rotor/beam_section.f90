!> A section of a shaft as a Timoshenko beam element in one plane: deflection and slope at either end. By symmetry the
!> matrices of the other plane are the same. Slope stands for the rotation of the cross-section.
module beam_section
   use kinds, only: wp, pi
   implicit none (type, external)
   private
   public :: beam_section_type

   !> Lengths and diameters, m; Young's modulus, Pa; density, kg/m^3.
   type :: beam_section_type
      real(wp) :: length = 0, diameter = 0, bore = 0, young_modulus = 0, poisson_ratio = 0, density = 0
   contains
      procedure :: area
      procedure :: second_moment
      procedure :: shear_coefficient
      procedure :: stiffness
      procedure :: mass
      procedure :: gyroscopic
   end type beam_section_type

contains

   !> Of the cross-section, m^2.
   elemental real(wp) function area(self)
      class(beam_section_type), intent(in) :: self
      area = pi/4*(self%diameter - self%bore)*(self%diameter + self%bore)
   end function area

   !> Second moment of area of the cross-section about a diameter, m^4.
   elemental real(wp) function second_moment(self)
      class(beam_section_type), intent(in) :: self
      second_moment = self%area()*(self%diameter**2 + self%bore**2)/16
   end function second_moment

   !> Shear coefficient of a hollow circular section: Cowper, J. Applied Mechanics 33 (1966) 335-340.
   elemental real(wp) function shear_coefficient(self) result(kappa)
      class(beam_section_type), intent(in) :: self
      real(wp) :: m
      associate (nu => self%poisson_ratio)
         m = (self%bore/self%diameter)**2
         kappa = 6*(1 + nu)*(1 + m)**2/((7 + 6*nu)*(1 + m)**2 + (20 + 12*nu)*m)
      end associate
   end function shear_coefficient

   !> 12 E I/(kappa G A L^2): how much of the deflection is shear; 0 is Euler and Bernoulli's beam.
   elemental real(wp) function shear_parameter(self) result(phi)
      class(beam_section_type), intent(in) :: self
      ! E/G = 2 (1 + nu), I/A = (diameter**2 + bore**2)/16
      phi = 1.5_wp*(1 + self%poisson_ratio)*(self%diameter**2 + self%bore**2)/(self%shear_coefficient()*self%length**2)
   end function shear_parameter

   !> Stiffness over (deflection, slope) at the start and at the end: N/m, N, N m. Friswell, Penny, Garvey and Lees,
   !> Dynamics of Rotating Machines (2010), eq (5.38); it deflects exactly under forces at the ends.
   pure function stiffness(self) result(k)
      class(beam_section_type), intent(in) :: self
      real(wp) :: k(4, 4), phi
      phi = shear_parameter(self)
      associate (l => self%length)
         k(:, 1) = [12.0_wp, 6*l, -12.0_wp, 6*l]
         k(:, 2) = [6*l, (4 + phi)*l**2, -6*l, (2 - phi)*l**2]
         k(:, 3) = -k(:, 1)
         k(:, 4) = [6*l, (2 - phi)*l**2, -6*l, (4 + phi)*l**2]
         k = k*self%young_modulus*self%second_moment()/((1 + phi)*l**3)
      end associate
   end function stiffness

   !> Consistent mass over the same: kg, kg m, kg m^2; of translation and rotary inertia (the same book, eq (5.40)).
   pure function mass(self) result(m)
      class(beam_section_type), intent(in) :: self
      real(wp) :: m(4, 4), phi, direct, far, coupled, crossed, own, other
      phi = shear_parameter(self)
      associate (l => self%length)
         direct = 312 + 588*phi + 280*phi**2
         far = 108 + 252*phi + 140*phi**2
         coupled = (44 + 77*phi + 35*phi**2)*l
         crossed = (26 + 63*phi + 35*phi**2)*l
         own = (8 + 14*phi + 7*phi**2)*l**2
         other = -(6 + 14*phi + 7*phi**2)*l**2
         m(:, 1) = [direct, coupled, far, -crossed]
         m(:, 2) = [coupled, own, crossed, other]
         m(:, 3) = [far, crossed, direct, -coupled]
         m(:, 4) = [-crossed, other, -coupled, own]
         m = m*self%density*self%area()*l/(840*(1 + phi)**2) + rotary_mass(self)
      end associate
   end function mass

   !> G of M y'' + Omega G z' + K y = 0 and M z'' - Omega G y' + K z = 0 for a shaft that turns from y to z, with the
   !> units of the mass: the polar moment of inertia of a cross-section is twice its diametral one.
   pure function gyroscopic(self) result(g)
      class(beam_section_type), intent(in) :: self
      real(wp) :: g(4, 4)
      g = 2*rotary_mass(self)
   end function gyroscopic

   !> The part of the mass that comes from the rotation of the cross-sections about their diameters.
   pure function rotary_mass(self) result(m)
      class(beam_section_type), intent(in) :: self
      real(wp) :: m(4, 4), phi, coupled, own, other
      phi = shear_parameter(self)
      associate (l => self%length)
         coupled = (3 - 15*phi)*l
         own = (4 + 5*phi + 10*phi**2)*l**2
         other = (-1 - 5*phi + 5*phi**2)*l**2
         m(:, 1) = [36.0_wp, coupled, -36.0_wp, coupled]
         m(:, 2) = [coupled, own, -coupled, other]
         m(:, 3) = -m(:, 1)
         m(:, 4) = [coupled, other, -coupled, own]
         m = m*self%density*self%second_moment()/(30*(1 + phi)**2*l)
      end associate
   end function rotary_mass
end module beam_section
