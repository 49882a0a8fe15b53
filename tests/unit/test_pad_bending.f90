!> How far pads bend: closed forms of even pressure and heat, pads of two unequal arms, the order of the quadrature, and
!> the shape that temperatures and bending make of a bearing.
program test_pad_bending
   use kinds, only: wp, degree
   use pad_gap, only: pad_gap_type
   use bearing_shape, only: check_shape, points_along, points_across, bending_points, bent_by_pressure, bent_by_heat, &
      & bearing_shape_type, bending_type, part_temperatures_type, new_shape
   use case_inputs, only: case_type
   use errors, only: error_type
   use check, only: runs, expect, expect_close, report
   implicit none (type, external)

   !> m, Pa, 1/K.
   real(wp), parameter :: radius = 0.05_wp, thick = 0.02_wp, modulus = 2.1e11_wp, poisson = 0.3_wp
   real(wp), parameter :: expansion = 11e-6_wp, middle = radius + thick/2

   if (runs('even_pressure')) call even_pressure()
   if (runs('flat_pad')) call flat_pad()
   if (runs('across')) call across()
   if (runs('even_heat')) call even_heat()
   if (runs('heat_at_an_edge')) call heat_at_an_edge()
   if (runs('everything_grows')) call everything_grows()
   if (runs('refusals')) call refusals()
   call report()

contains

   !> A pad that reaches to these angles, rad.
   pure type(pad_gap_type) function pad(leading, trailing) result(gap)
      real(wp), intent(in) :: leading, trailing
      gap = pad_gap_type(radius - 1e-4_wp, 1e-4_wp, 0.07_wp, leading, trailing, 0.0_wp, 0.0_wp, 0.0_wp)
   end function pad

   !> By 1 MPa: the moment is p R R_m (1 - cos(edge - phi)), the edge moves by the integral of it times sin(edge - phi),
   !> which is (1 - cos(edge))^2/2.
   subroutine even_pressure()
      real(wp), parameter :: pressure(points_across, points_along) = 1e6_wp
      real(wp) :: stiffness, edge
      edge = 37.5_wp*degree
      stiffness = modulus/(1 - poisson**2)*thick**3/12
      call expect_close(bent_by_pressure(pad(edge, edge), thick, modulus, poisson, pressure), &
         & 1e6_wp*radius*middle**3/stiffness*(1 - cos(edge))/2, 1e-9_wp*1e-4_wp, 'equal arms')
      ! each arm alone would be bent to (1 - cos(edge))/2; between them stands the circle through both edges
      associate (one => one_minus_cos(50*degree), other => one_minus_cos(20*degree))
         call expect_close(bent_by_pressure(pad(50*degree, 20*degree), thick, modulus, poisson, pressure), &
            & 1e6_wp*radius*middle**3/stiffness/2*(one**2*sin(20*degree) + other**2*sin(50*degree)) &
            & /(one*sin(20*degree) + other*sin(50*degree)), 1e-9_wp*1e-4_wp, 'a long and a short arm')
      end associate
   end subroutine even_pressure

   pure real(wp) function one_minus_cos(angle)
      real(wp), intent(in) :: angle
      one_minus_cos = 1 - cos(angle)
   end function one_minus_cos

   !> A short arc is a flat beam: R_m^2 M/(2 E' I) with the moment M at the pivot.
   subroutine flat_pad()
      real(wp), parameter :: pressure(points_across, points_along) = 1e6_wp
      real(wp) :: stiffness, edge, moment
      edge = 1*degree
      stiffness = modulus/(1 - poisson**2)*thick**3/12
      moment = 1e6_wp*radius*middle*edge**2/2
      call expect_close(bent_by_pressure(pad(edge, edge), thick, modulus, poisson, pressure) &
         & /(middle**2*moment/(2*stiffness)), 1.0_wp, edge**2, 'half of the moment at the pivot')
   end subroutine flat_pad

   !> A pressure that is a parabola across counts by its mean, and cos phi along by its moment: Simpson's rule is of the
   !> fourth order.
   subroutine across()
      real(wp) :: phi(points_along), z(points_across), pressure(points_across, points_along), edge, stiffness, found
      integer :: i
      edge = 30*degree
      associate (gap => pad(edge, edge))
         call bending_points(gap, phi, z)
         call expect_close(maxval(phi), edge, 1e-15_wp, 'the leading edge')
         call expect_close(minval(phi), -edge, 1e-15_wp, 'the trailing edge')
         call expect_close(maxval(z), 0.035_wp, 1e-15_wp, 'the side')
         do i = 1, points_along
            pressure(:, i) = 1e6_wp*1.5_wp*(1 - (z/0.035_wp)**2)*cos(phi(i))
         end do
         found = bent_by_pressure(gap, thick, modulus, poisson, pressure)
      end associate
      stiffness = modulus/(1 - poisson**2)*thick**3/12
      ! the integral of cos(phi) (phi cos(edge - phi) - cos(edge) sin(phi))/2 from 0 to the edge
      call expect_close(found/(1e6_wp*radius*middle**3/stiffness/one_minus_cos(edge)), &
         & (edge**2*cos(edge)/2 + edge*sin(edge)/2 - cos(edge)*sin(edge)**2)/4, 1e-9_wp, 'cos phi')
   end subroutine across

   !> An even gradient changes the radius by R_m^2 alpha dT/dr, whatever the number of stations.
   subroutine even_heat()
      integer :: n
      do n = 5, 40, 7
         call expect_close(bent_by_heat(pad(40*degree, 25*degree), thick, expansion, spread(500.0_wp, 1, n)), &
            & middle**2*expansion*500, 1e-18_wp, 'an even gradient')
      end do
   end subroutine even_heat

   !> A gradient near the leading edge, the first station, moves this edge little, and the other one not at all.
   subroutine heat_at_an_edge()
      real(wp) :: gradient(8), edge, width
      edge = 40*degree
      width = 10*degree
      gradient = 0
      gradient(1) = 500
      call expect_close(bent_by_heat(pad(edge, edge), thick, expansion, gradient), &
         & middle**2*expansion*500*(1 - cos(width))/(1 - cos(edge))/2, 1e-18_wp, 'one of two edges')
   end subroutine heat_at_an_edge

   !> Parts of one material that all become warmer by the same grow by the same.
   subroutine everything_grows()
      type(case_type) :: inputs
      type(bearing_shape_type) :: shape
      type(bending_type) :: bending
      type(part_temperatures_type) :: parts
      real(wp) :: part
      bending%elastic = [0.0_wp, 0.0_wp]
      bending%thermal = [0.0_wp, 0.0_wp]
      parts = part_temperatures_type(70.0_wp, 70.0_wp, [70.0_wp, 70.0_wp])
      inputs = prepared()
      shape = new_shape(inputs%bearings(1), bending, parts)
      part = 1 + 50*11e-6_wp
      associate (b => inputs%bearings(1))
         call expect_close(shape%journal_radius, part*b%journal_radius, 1e-16_wp, 'journal')
         call expect(maxval(abs(shape%machined_clearance - part*b%machined_clearance)) < 1e-16_wp, 'bores')
         call expect(maxval(abs(shape%assembled_clearance - part*b%assembled_clearance)) < 1e-16_wp, 'clearances')
      end associate
      ! the shaft alone takes its growth from both clearances
      parts = part_temperatures_type(56.0_wp, 20.0_wp, [20.0_wp, 20.0_wp])
      shape = new_shape(inputs%bearings(1), bending, parts)
      associate (grown => 36*11e-6_wp*inputs%bearings(1)%journal_radius)
         call expect(maxval(abs(inputs%bearings(1)%machined_clearance - shape%machined_clearance - grown)) < 1e-16_wp, &
            & 'bore less shaft')
         call expect(maxval(abs(inputs%bearings(1)%assembled_clearance - shape%assembled_clearance &
            & - grown)) < 1e-16_wp, &
            & 'clearance less shaft')
      end associate
   end subroutine everything_grows

   !> The paper's case with clearances of 20 C.
   type(case_type) function prepared() result(inputs)
      inputs = case_type()
      inputs%bearings(1)%clearance_temperature = 20
      inputs%bearings(1)%pads%thickness = [14e-3_wp, 14e-3_wp]
   end function prepared

   subroutine refusals()
      type(case_type) :: inputs
      type(bending_type) :: bending
      type(bearing_shape_type) :: shape
      type(error_type), allocatable :: error
      inputs = prepared()
      bending%elastic = [0.0_wp, 90e-6_wp]
      bending%thermal = [0.0_wp, 11e-6_wp]
      shape = new_shape(inputs%bearings(1), bending, part_temperatures_type(20.0_wp, 20.0_wp, [20.0_wp, 20.0_wp]))
      call check_shape(shape, inputs%bearings(1), error)
      call expect(allocated(error), 'a pad that bends by more than its clearance')
      if (allocated(error)) call expect(index(error%message, 'pad 2 bends by 101.0 um, more than its clearance of ' &
         & //'100.0 um') > 0, error%message)
      bending%elastic = [0.0_wp, 0.0_wp]
      shape = new_shape(inputs%bearings(1), bending, part_temperatures_type(220.0_wp, 20.0_wp, [120.0_wp, 120.0_wp]))
      call check_shape(shape, inputs%bearings(1), error)
      call expect(allocated(error), 'a shaft that fills its clearance')
      if (allocated(error)) call expect(index(error%message, 'the clearance of pad 1 is gone') > 0, error%message)
   end subroutine refusals
end program test_pad_bending
