!> A free rotor before it is put into its bearings, in any displacements: M q'' + (C + Omega G) q' + K q = f;
!> and those of a shaft, from its sections and discs.
module rotor_component
   use kinds, only: wp, pi, degree
   use case_groups, only: elastic_type, given_rotor_type, load_type, unbalance_type
   use sparse_matrix, only: sparse_matrix_type, sparse_of_elements, sparse_of_dense
   implicit none (type, external)
   private
   public :: rotor_component_type, shaft_component, given_component, in_planes, beam_section_type, static_forces, &
      & unbalance_moments

   !> A section of a shaft: lengths and diameters, m; Young's modulus, Pa; density, kg/m^3.
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

   !> What sections and discs have of the matrices of a shaft in one plane, element by element: over deflection and
   !> slope of station 1, of station 2, ... Both planes have the same. Mass and gyroscopic matrix as of a section.
   type :: shaft_elements_type
      integer, allocatable :: row(:), column(:)
      real(wp), allocatable :: mass(:), gyroscopic(:), stiffness(:)
   end type shaft_elements_type

   !> A rotor of n displacements.
   type :: rotor_component_type
      !> (n, n), SI units.
      type(sparse_matrix_type) :: mass, damping, gyroscopic, stiffness
      !> What internal damping adds to the stiffness, over the speed; not allocated where there is none.
      type(sparse_matrix_type), allocatable :: circulatory
      !> station%times(q) is y and z of station 1, y and z of station 2, ..., m; slope%times(q) are the slopes dy/dx and
      !> dz/dx there: (2*stations, n).
      type(sparse_matrix_type) :: station, slope
      !> The mass matrix times a translation of 1 m along y, kg: what gravity acts on.
      real(wp), allocatable :: weighed(:)
      !> kg
      real(wp) :: total_mass = 0
      !> 2: the displacements go in pairs, along y and z, and both planes have the same mass and stiffness; else 1.
      integer :: planes = 1
      !> The sense in which the shaft turns: 1 clockwise, from y to z, -1 anticlockwise.
      real(wp) :: sense = 1
   contains
      procedure :: turn_in
   end type rotor_component_type

contains

   ! A section of a shaft as a Timoshenko beam element in one plane: deflection and slope at either end. By symmetry the
   ! matrices of the other plane are the same. Slope stands for the rotation of the cross-section.

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

   !> Has the shaft turn in a sense: 1 clockwise, -1 anticlockwise.
   pure subroutine turn_in(self, sense)
      class(rotor_component_type), intent(inout) :: self
      real(wp), intent(in) :: sense
      self%gyroscopic%value = sense*self%sense*self%gyroscopic%value
      if (allocated(self%circulatory)) self%circulatory%value = sense*self%sense*self%circulatory%value
      self%sense = sense
   end subroutine turn_in

   !> A shaft with its discs, turning clockwise. Deflection and slope of station 1, of station 2, ... along y and z take
   !> turns.
   pure function shaft_component(rotor) result(component)
      type(elastic_type), intent(in) :: rotor
      type(rotor_component_type) :: component
      type(shaft_elements_type) :: shaft
      integer :: stations, n, i
      stations = size(rotor%shaft%length) + 1
      n = 4*stations
      shaft = new_shaft_elements(rotor)
      component%planes = 2
      associate (row => shaft%row, column => shaft%column)
         associate (rows => [2*row - 1, 2*row], columns => [2*column - 1, 2*column])
            component%mass = sparse_of_elements(n, n, rows, columns, [shaft%mass, shaft%mass])
            component%stiffness = sparse_of_elements(n, n, rows, columns, [shaft%stiffness, shaft%stiffness])
            ! of a spring's force -k x a damping b k has -b k (x' - Omega cross x)
            associate (internal => rotor%shaft%internal_damping, none => merge(0, size(rows), &
               & rotor%shaft%internal_damping <= 0))
               component%damping = sparse_of_elements(n, n, rows(:none), columns(:none), &
                  & internal*[shaft%stiffness, shaft%stiffness])
            end associate
         end associate
         associate (rows => [2*row - 1, 2*row], columns => [2*column, 2*column - 1])
            component%gyroscopic = sparse_of_elements(n, n, rows, columns, [shaft%gyroscopic, -shaft%gyroscopic])
            if (rotor%shaft%internal_damping > 0) component%circulatory = sparse_of_elements(n, n, rows, columns, &
               & rotor%shaft%internal_damping*[shaft%stiffness, -shaft%stiffness])
         end associate
      end associate
      associate (rows => [(i, i=1, 2*stations)], one => [(1.0_wp, i=1, 2*stations)])
         ! y and z of station i are displacements 4*i - 3 and 4*i - 2
         component%station = sparse_of_elements(2*stations, n, rows, rows + 2*((rows - 1)/2), one)
         component%slope = sparse_of_elements(2*stations, n, rows, rows + 2*((rows + 1)/2), one)
      end associate
      component%weighed = component%mass%times([(merge(1.0_wp, 0.0_wp, modulo(i, 4) == 1), i=1, n)])
      component%total_mass = sum(component%weighed(1::4))
   end function shaft_component

   !> The rotor of another program.
   pure function given_component(rotor) result(component)
      type(given_rotor_type), intent(in) :: rotor
      type(rotor_component_type) :: component
      component%mass = sparse_of_dense(rotor%mass)
      component%damping = sparse_of_dense(rotor%damping)
      component%gyroscopic = sparse_of_dense(rotor%gyroscopic)
      component%stiffness = sparse_of_dense(rotor%stiffness)
      component%station = sparse_of_dense(rotor%station)
      component%slope = sparse_of_dense(rotor%slope)
      component%weighed = rotor%weighed
      component%total_mass = rotor%total_mass
   end function given_component

   !> A matrix that acts alike in this many planes, whose rows and columns take turns.
   pure function in_planes(matrix, planes) result(all)
      real(wp), intent(in) :: matrix(:, :)
      integer, intent(in) :: planes
      real(wp) :: all(planes*size(matrix, 1), planes*size(matrix, 2))
      integer :: p
      all = 0
      do p = 1, planes
         all(p::planes, p::planes) = matrix
      end do
   end function in_planes

   !> Those of a shaft and its discs.
   pure function new_shaft_elements(rotor) result(elements)
      type(elastic_type), intent(in) :: rotor
      type(shaft_elements_type) :: elements
      type(beam_section_type) :: section
      integer :: n, i, j, k
      !> Places of a section's elements, by columns.
      integer, parameter :: along(*) = [((i, i=0, 3), j=0, 3)], across(*) = [((j, i=0, 3), j=0, 3)]
      associate (s => rotor%shaft)
         n = size(along)*size(s%length) + 2*size(rotor%discs)
         allocate (elements%row(n), elements%column(n))
         allocate (elements%mass(n), elements%gyroscopic(n), elements%stiffness(n), source=0.0_wp)
         do i = 1, size(s%length)
            section = beam_section_type(s%length(i), s%diameter(i), s%bore(i), s%young_modulus, s%poisson_ratio, &
               & s%density)
            j = size(along)*(i - 1) + 1
            k = size(along)*i
            elements%row(j:k) = 2*i - 1 + along
            elements%column(j:k) = 2*i - 1 + across
            elements%mass(j:k) = reshape(section%mass(), [size(along)])
            elements%gyroscopic(j:k) = reshape(section%gyroscopic(), [size(along)])
            elements%stiffness(j:k) = reshape(section%stiffness(), [size(along)])
         end do
      end associate
      do i = 1, size(rotor%discs)
         associate (disc => rotor%discs(i))
            k = n - 2*(size(rotor%discs) - i)
            elements%row(k - 1:k) = [2*disc%station - 1, 2*disc%station]
            elements%column(k - 1:k) = elements%row(k - 1:k)
            elements%mass(k - 1:k) = [disc%mass, disc%diametral_inertia]
            elements%gyroscopic(k) = disc%polar_inertia
         end associate
      end do
   end function new_shaft_elements

   ! Forces at the stations of a rotor, on y and z of station 1, y and z of station 2, ...

   !> Static forces of loads, N; n is twice the number of stations.
   pure function static_forces(loads, n) result(force)
      type(load_type), intent(in) :: loads(:)
      integer, intent(in) :: n
      real(wp) :: force(n)
      integer :: i
      force = 0
      do i = 1, size(loads)
         associate (at => loads(i)%station)
            force(2*at - 1:2*at) = force(2*at - 1:2*at) + loads(i)%force
         end associate
      end do
   end function static_forces

   !> Moments of unbalances, kg m, on a shaft that turns clockwise (sense = 1) or anticlockwise (-1): their forces
   !> at the shaft angle phi are Omega**2*(moments(1, :)*cos(phi) + moments(2, :)*sin(phi)).
   pure function unbalance_moments(unbalances, n, sense) result(moments)
      type(unbalance_type), intent(in) :: unbalances(:)
      integer, intent(in) :: n
      real(wp), intent(in) :: sense
      real(wp) :: moments(2, n), y, z
      integer :: i, at
      moments = 0
      do i = 1, size(unbalances)
         associate (u => unbalances(i))
            at = 2*u%station
            y = u%moment*cos(u%angle_deg*degree)
            z = u%moment*sin(u%angle_deg*degree)
            moments(:, at - 1) = moments(:, at - 1) + [y, -z]
            moments(:, at) = moments(:, at) + sense*[z, y]
         end associate
      end do
   end function unbalance_moments
end module rotor_component
