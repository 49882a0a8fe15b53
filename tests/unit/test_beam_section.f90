!> Timoshenko beam elements against closed forms.
program test_beam_section
   use kinds, only: wp, pi
   use linear_algebra, only: dgesv
   use rotor_component, only: beam_section_type
   use check, only: runs, expect, expect_close, report
   implicit none (type, external)
   real(wp), parameter :: rounding = 1e-12_wp
   type(beam_section_type) :: section

   section = beam_section_type(0.7_wp, 0.2_wp, 0.08_wp, 2.1e11_wp, 0.3_wp, 7850.0_wp)
   if (runs('cross-section')) call try_cross_section()
   if (runs('rigid motions')) call try_rigid_motions()
   if (runs('cantilever')) call try_cantilever()
   if (runs('symmetry')) call try_symmetry()
   call report()

contains

   !> Cowper's shear coefficient: 6(1 + nu)/(7 + 6 nu) of a solid circle, 2(1 + nu)/(4 + 3 nu) of a thin tube.
   subroutine try_cross_section()
      type(beam_section_type) :: solid, tube
      real(wp), parameter :: nu = 0.3_wp
      solid = beam_section_type(1.0_wp, 0.2_wp, 0.0_wp, 2.1e11_wp, nu, 7850.0_wp)
      tube = solid
      tube%bore = 0.2_wp*(1 - 1e-9_wp)
      call expect_close(solid%shear_coefficient(), 6*(1 + nu)/(7 + 6*nu), rounding, 'a solid shaft')
      call expect_close(tube%shear_coefficient(), 2*(1 + nu)/(4 + 3*nu), 1e-8_wp, 'a thin tube')
      call expect_close(section%area(), pi/4*(0.2_wp**2 - 0.08_wp**2), rounding, 'area')
      call expect_close(section%second_moment(), pi/64*(0.2_wp**4 - 0.08_wp**4), rounding*1e-4_wp, 'its second moment')
   end subroutine try_cross_section

   !> A rigid motion bends nothing; it has the mass and the moments of inertia of a cylinder.
   subroutine try_rigid_motions()
      real(wp) :: shift(4), turn(4), mass, diametral, polar
      shift = [1.0_wp, 0.0_wp, 1.0_wp, 0.0_wp]
      turn = [-section%length/2, 1.0_wp, section%length/2, 1.0_wp]
      mass = section%density*section%area()*section%length
      polar = mass*(section%diameter**2 + section%bore**2)/8
      diametral = polar/2 + mass*section%length**2/12
      associate (k => section%stiffness(), m => section%mass(), g => section%gyroscopic())
         call expect(maxval(abs(matmul(k, shift))) < rounding*maxval(abs(k)), 'no force against a translation')
         call expect(maxval(abs(matmul(k, turn))) < rounding*maxval(abs(k)), 'no force against a rotation')
         call expect_close(dot_product(shift, matmul(m, shift)), mass, rounding*mass, 'mass')
         call expect_close(dot_product(shift, matmul(m, turn)), 0.0_wp, rounding*mass, 'centre of mass in the middle')
         call expect_close(dot_product(turn, matmul(m, turn)), diametral, rounding*mass, 'diametral moment of inertia')
         call expect_close(dot_product(turn, matmul(g, turn)), polar, rounding*mass, 'polar moment of inertia')
         call expect(maxval(abs(matmul(g, shift))) < rounding*polar, 'a translation has no gyroscopic moment')
      end associate
   end subroutine try_rigid_motions

   !> Deflection F L^3/(3 E I) + F L/(kappa G A) and slope F L^2/(2 E I) of the free end under a force.
   subroutine try_cantilever()
      real(wp) :: matrix(4, 4), free(2, 2), x(2, 1), bending, shear
      integer :: pivots(2), info
      matrix = section%stiffness()
      free = matrix(3:, 3:)
      x(:, 1) = [1.0_wp, 0.0_wp]
      call dgesv(2, 1, free, 2, pivots, x, 2, info)
      associate (l => section%length, rigidity => section%young_modulus*section%second_moment())
         bending = l**3/(3*rigidity)
         shear = l*2*(1 + section%poisson_ratio)/(section%shear_coefficient()*section%young_modulus*section%area())
         call expect_close(x(1, 1), bending + shear, rounding*bending, 'deflection of the end')
         call expect_close(x(2, 1), l**2/(2*rigidity), rounding*bending, 'slope of the end')
      end associate
   end subroutine try_cantilever

   !> From the other end the ends are exchanged, and slopes have the other sign.
   subroutine try_symmetry()
      real(wp) :: k(4, 4), m(4, 4), g(4, 4)
      real(wp), parameter :: turned(4, 4) = reshape([0, 0, 1, 0, 0, 0, 0, -1, 1, 0, 0, 0, 0, -1, 0, 0], [4, 4])
      k = section%stiffness()
      m = section%mass()
      g = section%gyroscopic()
      call expect(maxval(abs(k - transpose(k))) <= 0, 'the stiffness is symmetric')
      call expect(maxval(abs(m - transpose(m))) <= 0, 'the mass is symmetric')
      call expect(maxval(abs(g - transpose(g))) <= 0, 'the gyroscopic matrix of one plane is symmetric')
      call expect(maxval(abs(matmul(transpose(turned), matmul(k, turned)) - k)) < rounding*maxval(abs(k)), &
         & 'the stiffness from the other end')
      call expect(maxval(abs(matmul(transpose(turned), matmul(m, turned)) - m)) < rounding*maxval(abs(m)), &
         & 'the mass from the other end')
   end subroutine try_symmetry
end program test_beam_section
