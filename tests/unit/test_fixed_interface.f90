!> Modes of shafts with held journals against Timoshenko's theory, static deflections against beam theory.
program test_fixed_interface
   use kinds, only: wp, pi
   use case_inputs, only: case_type
   use rotor_component, only: rotor_component_type, shaft_component, beam_section_type
   use fixed_interface, only: fixed_interface_type, find_fixed_interface
   use example_machine, only: plain_shaft
   use check, only: runs, expect, expect_close, report
   implicit none (type, external)
   real(wp), parameter :: span = 1.2_wp, diameter = 0.15_wp

   if (runs('frequencies')) call try_frequencies()
   if (runs('modes')) call try_modes()
   if (runs('equal frequencies')) call try_equal_frequencies(10)
   if (runs('equal frequencies of a wide band')) call try_equal_frequencies(5)
   if (runs('static deflection')) call try_static_deflection()
   if (runs('journals that hold nothing')) call try_not_held()
   call report()

contains

   !> A shaft of equal sections that is held at its stations.
   subroutine hold(sections, stations, component, fixed, held, thickness)
      integer, intent(in) :: sections, stations(:)
      type(rotor_component_type), intent(out) :: component
      type(fixed_interface_type), intent(out) :: fixed
      logical, intent(out) :: held
      real(wp), intent(in), optional :: thickness
      type(case_type) :: shaft
      real(wp) :: thick
      integer :: i
      thick = diameter
      if (present(thickness)) thick = thickness
      shaft = plain_shaft([(span/sections, i=1, sections)], thick)
      component = shaft_component(shaft%rotor%elastic)
      call find_fixed_interface(component, [(4*stations(i) - 3, 4*stations(i) - 2, i=1, size(stations))], fixed, held)
   end subroutine hold

   !> A beam of any cross-section on two pins: with k = n pi/L the lowest root omega of
   !> E I k^4 - omega^2 (rho A + rho I k^2 (1 + E/(kappa G))) + omega^4 rho^2 I/(kappa G) = 0.
   real(wp) function timoshenko_frequency(mode, thickness) result(omega)
      integer, intent(in) :: mode
      real(wp), intent(in) :: thickness
      type(beam_section_type) :: s
      real(wp) :: k2, shear, a, b, c
      s = beam_section_type(span, thickness, 0.0_wp, 2.1e11_wp, 0.3_wp, 7850.0_wp)
      k2 = (mode*pi/span)**2
      shear = 2*(1 + s%poisson_ratio)/s%shear_coefficient()
      a = s%density**2*s%second_moment()*shear/s%young_modulus
      b = s%density*s%area() + s%density*s%second_moment()*k2*(1 + shear)
      c = s%young_modulus*s%second_moment()*k2**2
      omega = sqrt(2*c/(b + sqrt(b**2 - 4*a*c)))
   end function timoshenko_frequency

   !> The error falls with the fourth power of the length of the sections where the shaft is slender, and with the
   !> second where shear and rotary inertia matter, whose slopes are of a lower order.
   subroutine try_frequencies()
      call expect_order(span/2000, 4, 3.8_wp, 4.2_wp, 3e-4_wp)
      call expect_order(diameter, 8, 1.9_wp, 2.3_wp, 3e-4_wp)
   end subroutine try_frequencies

   subroutine expect_order(thickness, sections, lowest, highest, first_error)
      real(wp), intent(in) :: thickness, lowest, highest, first_error
      integer, intent(in) :: sections
      type(rotor_component_type) :: component
      type(fixed_interface_type) :: fixed
      real(wp) :: error(2, 2), order
      logical :: held
      integer :: i, mode
      do i = 1, 2
         call hold(i*sections, [1, i*sections + 1], component, fixed, held, thickness)
         error(i, :) = [(fixed%frequency(mode)/timoshenko_frequency(mode, thickness) - 1, mode=1, 2)]
      end do
      do mode = 1, 2
         order = log(error(1, mode)/error(2, mode))/log(2.0_wp)
         call expect(order > lowest .and. order < highest, 'order of convergence')
      end do
      call expect(error(1, 1) > 0 .and. error(1, 1) < first_error, 'the first frequency')
   end subroutine expect_order

   !> Modes and static deflections: modal masses 1, no coupling by the stiffness, in planes that take turns.
   subroutine try_modes()
      type(rotor_component_type) :: component
      type(fixed_interface_type) :: fixed
      real(wp), allocatable :: basis(:, :)
      logical :: held
      integer :: i
      call hold(10, [2, 9], component, fixed, held)
      call expect(held, 'two bearings hold a shaft')
      call fixed%find_modes(2)
      call fixed%find_modes(6)
      basis = fixed%basis(6)
      call expect(all(shape(basis) == [44, 2*(2 + 6)]), 'as many displacements as journals and modes have')
      call expect_modes(component, basis, [(fixed%frequency(i)**2, fixed%frequency(i)**2, i=1, 6)])
      call expect(maxval(abs(basis([5, 6, 33, 34], :4) - reshape([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1], &
         & [4, 4]))) <= 0, 'unit displacements of the journals, y and z of each')
      ! two pins: a shaft follows them without bending
      call expect_close(basis(21, 1), 3/7.0_wp, 1e-10_wp, 'what lies between the journals follows')
   end subroutine try_modes

   !> The basis of four displacements of journals and of modes with these squares of their frequencies, rad^2/s^2.
   subroutine expect_modes(component, basis, squares)
      type(rotor_component_type), intent(in) :: component
      real(wp), intent(in) :: basis(:, :), squares(:)
      real(wp), allocatable :: mass(:, :), stiffness(:, :)
      integer :: i
      mass = matmul(transpose(basis), component%mass%times(basis))
      stiffness = matmul(transpose(basis), component%stiffness%times(basis))
      do i = 5, size(basis, 2)
         call expect_close(mass(i, i), 1.0_wp, 1e-12_wp, 'modal mass')
         call expect_close(stiffness(i, i)/squares(i - 4), 1.0_wp, 1e-9_wp, 'modal stiffness')
         mass(i, i) = 0
         stiffness(i, i) = 0
      end do
      call expect(maxval(abs(mass(5:, 5:))) < 1e-11_wp, 'no mass joins the modes')
      call expect(maxval(abs(stiffness(5:, :))) < 1e-9_wp*maxval(squares), 'no stiffness joins the modes')
   end subroutine expect_modes

   !> Both planes at once, alike or nearly: each frequency is double, and the last one has half of its modes.
   subroutine try_equal_frequencies(sections)
      integer, intent(in) :: sections
      type(rotor_component_type) :: component
      type(fixed_interface_type) :: one, both
      logical :: held
      integer :: i, k
      real(wp), parameter :: stiffer(*) = [0.0_wp, 1e-12_wp, 1e-9_wp, 1e-8_wp, 1e-7_wp, 1e-5_wp, 1e-2_wp]
      do k = 1, size(stiffer)
         call hold(sections, [2, sections], component, one, held)
         component%planes = 1
         associate (stiffness => component%stiffness)
            do i = 2, stiffness%rows, 2
               associate (row => stiffness%value(stiffness%first(i):stiffness%first(i + 1) - 1))
                  row = row*(1 + stiffer(k))
               end associate
            end do
         end associate
         call find_fixed_interface(component, [5, 6, 4*sections - 3, 4*sections - 2], both, held)
         call expect(held, 'two bearings hold a shaft')
         call expect(size(both%frequency) == 2*size(one%frequency), 'modes of both planes')
         do i = 1, 4
            call expect_close(both%frequency(2*i - 1)/one%frequency(i), 1.0_wp, 1e-10_wp, 'frequency along y')
            call expect_close(both%frequency(2*i)/one%frequency(i), sqrt(1 + stiffer(k)), 1e-10_wp, &
               & 'frequency along z')
         end do
         call both%find_modes(7)
         call expect_modes(component, both%basis(7), both%frequency(:7)**2)
      end do
   end subroutine try_equal_frequencies

   !> 5 q L^4/(384 E I) + q L^2/(8 kappa G A) in the middle of a heavy shaft on two pins: modes have part of it, and the
   !> residual deflection has the rest.
   subroutine try_static_deflection()
      type(rotor_component_type) :: component
      type(fixed_interface_type) :: fixed
      type(beam_section_type) :: s
      real(wp) :: exact, q
      real(wp), allocatable :: deflection(:), force(:)
      logical :: held
      integer :: modes
      call hold(6, [1, 7], component, fixed, held)
      s = beam_section_type(span, diameter, 0.0_wp, 2.1e11_wp, 0.3_wp, 7850.0_wp)
      q = 9.81_wp*s%density*s%area()
      exact = 5*q*span**4/(384*s%young_modulus*s%second_moment()) &
         & + q*span**2*2*(1 + s%poisson_ratio)/(8*s%shear_coefficient()*s%young_modulus*s%area())
      force = 9.81_wp*component%weighed
      call fixed%find_modes(4)
      do modes = 0, 4, 2
         associate (basis => fixed%basis(modes))
            deflection = fixed%residual_deflection(force, modes)
            call expect(modes == 0 .or. abs(deflection(13)) < 1e-2_wp*exact, 'modes have most of the deflection')
            deflection = deflection + by_modes(basis(:, 5:), force, fixed%frequency(:modes))
         end associate
         call expect_close(deflection(13)/exact, 1.0_wp, 1e-10_wp, 'deflection in the middle')
         call expect_close(deflection(14), 0.0_wp, 0.0_wp, 'no deflection along z')
      end do
      call expect_close(component%total_mass, s%density*s%area()*span, 1e-10_wp, 'mass of the shaft')
   end subroutine try_static_deflection

   !> Static deflection of modes, each in both planes.
   function by_modes(modes, force, frequency) result(deflection)
      real(wp), intent(in) :: modes(:, :), force(:), frequency(:)
      real(wp) :: deflection(size(force))
      integer :: i
      deflection = 0
      do i = 1, size(modes, 2)
         deflection = deflection + modes(:, i)*dot_product(modes(:, i), force)/frequency((i + 1)/2)**2
      end do
   end function by_modes

   subroutine try_not_held()
      type(rotor_component_type) :: component
      type(fixed_interface_type) :: fixed
      type(case_type) :: machine
      logical :: held
      integer, parameter :: many(*) = [60, 200, 499]
      integer :: i
      call hold(6, [4], component, fixed, held)
      call expect(.not. held, 'a shaft turns about one bearing')
      do i = 1, size(many)
         call hold(many(i), [1], component, fixed, held)
         call expect(.not. held, 'also one of many sections')
      end do
      call hold(100, [50, 51], component, fixed, held)
      call expect(held, 'two close bearings hold a shaft of many sections')
      machine = plain_shaft([0.2_wp, 0.2_wp, 0.2_wp], diameter)
      machine%rotor%elastic%shaft%bore = machine%rotor%elastic%shaft%diameter
      component = shaft_component(machine%rotor%elastic)
      call find_fixed_interface(component, [1, 2, 13, 14], fixed, held)
      call expect(.not. held, 'a shaft without stiffness is not held')
   end subroutine try_not_held
end program test_fixed_interface
