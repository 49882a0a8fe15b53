!> Equilibria with temperatures along and across the films: an independent program's values, order, and oil that does
!> not thin.
program test_film_equilibrium
   use kinds, only: wp, rpm
   use errors, only: error_type
   use case_inputs, only: case_type
   use input_cases, only: case_of
   use equations_of_motion, only: machine_model, new_machine_model
   use equilibrium_record, only: equilibrium_type, static_figures_type, find_static_figures
   use equilibrium, only: find_equilibrium
   use linear_bearing, only: bearing_coefficients_type
   use linear_analysis, only: analyse
   use check, only: runs, expect, expect_close, expect_no_error, report
   implicit none (type, external)

   character(len=*), parameter :: by_default = '&thermal model = ''film''/'
   character(len=*), parameter :: fillon = '&rotor mass = 1019.36799/ &bearing journal_radius = 50e-3,' &
      & //' axial_length = 70e-3, machined_clearance = 148e-6, assembled_clearance = 78.44e-6/' &
      & //'&pads motion = ''tilting_only'', pivot_angle_deg = 45, 135, 225, 315, arc_deg = 75,' &
      & //' pivot_distance = 20e-3, mass = 1e-3, inertia = 1e-6, centre_radial = -10e-3/' &
      & //'&oil reference_viscosity = 0.0277, temperature_exponent = 0.0341, specific_heat = 1951.8,' &
      & //' conductivity = 0.149, carry_over = 1/'
   character(len=*), parameter :: five = '&rotor mass = 1019.36799/ &bearing journal_radius = 50.8e-3,' &
      & //' axial_length = 50.8e-3, machined_clearance = 108.5714e-6, assembled_clearance = 76e-6/' &
      & //'&pads motion = ''tilting_only'', pivot_angle_deg = -54, 18, 90, 162, 234, arc_deg = 60,' &
      & //' pivot_distance = 14e-3, mass = 0.33856, inertia = 0.00013605, centre_radial = -9.3406e-3/' &
      & //'&oil kinematic_viscosity = 32e-6, 5.362e-6, density_at_15 = 870, density_slope = -0.64/'
   character(len=*), parameter :: oil_46 = '&asperity model = ''none''/ &oil kinematic_viscosity = 46e-6, 6.8e-6,' &
      & //' density_at_15 = 870, density_slope = -0.64/'
   character(len=*), parameter :: paper = '&pads motion = ''tilting_only''/'//oil_46
   character(len=*), parameter :: turbine = '&rotor mass = 13761.4679/ &bearing journal_radius = 150e-3,' &
      & //' axial_length = 225e-3, machined_clearance = 300e-6, assembled_clearance = 225e-6/' &
      & //'&pads motion = ''tilting_only'', pivot_angle_deg = -54, 18, 90, 162, 234, arc_deg = 58,' &
      & //' pivot_distance = 50e-3, mass = 1e-3, inertia = 1e-6, centre_radial = -10e-3/' &
      & //'&oil kinematic_viscosity = 32e-6, 5.362e-6, density_at_15 = 870, density_slope = -0.64,' &
      & //' supply_temperature = 45/'

   if (runs('fillon')) call compare('&operation speed_rpm = 4000/'//fillon//by_default, [101.3527_wp, 100.5888_wp, &
      & 31.20765_wp, 31.21365_wp], [53.8387_wp, 51.52844_wp, 68.40364_wp, 68.18969_wp], 54.26248_wp, 2164.421_wp, &
      & [353.4343_wp, 354.1494_wp], [0.6087114_wp, 0.6097404_wp])
   if (runs('five_pads')) call compare('&operation speed_rpm = 9000/'//five//by_default, [27.10105_wp, 81.93545_wp, &
      & 120.7212_wp, 81.24915_wp, 27.44908_wp], [95.05194_wp, 68.13571_wp, 60.69649_wp, 65.57036_wp, 94.76443_wp], &
      & 58.98248_wp, 6078.02_wp, [510.8134_wp, 288.5922_wp], [0.3927633_wp, 0.2695076_wp])
   if (runs('paper')) call compare('&operation speed_rpm = 6500/'//paper//by_default, [42.04612_wp, 35.95983_wp], &
      & [74.78506_wp, 85.03676_wp], 56.42648_wp, 5260.808_wp, [563.0279_wp, 564.112_wp], [0.9732254_wp, 0.9749136_wp])
   if (runs('fillon_slow')) call compare('&operation speed_rpm = 2000/'//fillon//by_default, &
      & [24.665_wp], [47.59027_wp, 45.09628_wp, 56.02802_wp, 56.11084_wp], 49.78081_wp, 767.1565_wp, &
      & [395.0035_wp, 396.0086_wp], [1.168024_wp, 1.170735_wp])
   if (runs('paper_fast')) call compare('&operation speed_rpm = 9000/'//paper//by_default, &
      & [39.21781_wp], [85.16684_wp, 94.40161_wp], 56.93096_wp, 8658.48_wp, &
      & [541.6325_wp, 542.5506_wp], [0.7384655_wp, 0.7394649_wp])
   if (runs('paper_radial')) call compare('&operation speed_rpm = 6500/ &pads motion = ''tilting_radial''/'//oil_46 &
      & //by_default, &
      & [35.95736_wp], [74.78645_wp, 85.03874_wp], 56.42793_wp, 5260.884_wp, &
      & [550.8762_wp, 552.1652_wp], [0.6245691_wp, 0.6258954_wp])
   if (runs('turbine')) call compare('&operation speed_rpm = 3600/'//turbine//by_default, &
      & [57.63662_wp], [92.48449_wp, 60.44657_wp, 55.90911_wp, 60.31878_wp, 96.4541_wp], 56.58478_wp, 47209.89_wp, &
      & [2867.495_wp, 1537.477_wp], [4.887067_wp, 2.961607_wp])
   if (runs('even_oil')) call even_oil()
   if (runs('order')) call order()
   call report()

contains

   !> The equilibrium of a case, its figures and its coefficients.
   subroutine solve(text, static, figures, linear)
      character(len=*), intent(in) :: text
      type(equilibrium_type), intent(out) :: static
      type(static_figures_type), intent(out) :: figures
      type(bearing_coefficients_type), intent(out) :: linear
      type(case_type) :: inputs
      type(machine_model) :: model
      type(error_type), allocatable :: error
      inputs = case_of('&case task = ''coefficients''/'//text)
      model = new_machine_model(inputs)
      call find_equilibrium(model, static, error)
      call expect_no_error(error, 'equilibrium')
      if (allocated(error)) return
      model%oil = static%oil
      call find_static_figures(model, static, figures)
      call analyse(inputs, 'coefficients', linear)
   end subroutine solve

   !> Against an independent program (finite volumes of 120 x 24 and 240 x 48 in the films, extrapolated) with 40 x 12
   !> here, whose own error falls by four where stations and layers are halved: film thicknesses, um, of which the
   !> thinnest counts; maximum temperatures of the pads and that of the shaft, C; loss, W; K_yy and K_zz, MN/m; C_yy and
   !> C_zz, MN s/m.
   subroutine compare(text, thickness, maximum, shaft, loss, stiffness, damping)
      character(len=*), intent(in) :: text
      real(wp), intent(in) :: thickness(:), maximum(:), shaft, loss, stiffness(2), damping(2)
      type(equilibrium_type) :: static
      type(static_figures_type) :: figures
      type(bearing_coefficients_type) :: linear
      type(case_type) :: inputs
      integer :: i
      call solve(text, static, figures, linear)
      if (.not. allocated(figures%oil)) return
      call expect_close(1e6_wp*minval(static%min_film_thickness), minval(thickness), 4e-3_wp*minval(thickness), &
         & 'thinnest film')
      call expect(all(abs(figures%oil%maximum - maximum) < 0.3_wp), 'maximum temperatures')
      call expect_close(figures%oil%shaft, shaft, 0.3_wp, 'shaft')
      call expect_close(sum(figures%pads%power()), loss, 4e-3_wp*loss, 'loss')
      ! what the shaft brings is what the films make
      inputs = case_of('&case task = ''coefficients''/'//text)
      call expect_close(sum(figures%pads%journal_drag)*inputs%operation%speed_rpm*rpm, sum(figures%pads%power()), &
         & 1e-4_wp*loss, 'drive')
      do i = 1, 2
         call expect_close(1e-6_wp*linear%stiffness(i, i, 1, 1, 1), stiffness(i), 5e-3_wp*stiffness(i), 'stiffness')
         call expect_close(1e-6_wp*linear%damping(i, i, 1, 1, 1), damping(i), 6e-3_wp*damping(i), 'damping')
      end do
   end subroutine compare

   !> Oil whose viscosity does not depend on its temperature has the equilibrium of cold oil, but warms.
   subroutine even_oil()
      type(equilibrium_type) :: static(2)
      type(static_figures_type) :: figures
      type(bearing_coefficients_type) :: linear(2)
      character(len=*), parameter :: even = '&pads motion = ''tilting_only''/ &oil reference_viscosity = 0.02,' &
         & //' temperature_exponent = 0/ &film solver = ''direct''/'
      call solve(even, static(1), figures, linear(1))
      call solve(even//by_default, static(2), figures, linear(2))
      call expect(norm2(static(2)%rotor - static(1)%rotor) < 1e-8_wp*norm2(static(1)%rotor), 'journal')
      call expect(norm2(linear(2)%stiffness - linear(1)%stiffness) < 1e-6_wp*norm2(linear(1)%stiffness), 'stiffness')
      call expect(norm2(linear(2)%damping - linear(1)%damping) < 1e-6_wp*norm2(linear(1)%damping), 'damping')
      call expect(all(figures%oil%maximum > 45), 'it warms')
   end subroutine even_oil

   !> Stations and layers are of the second order.
   subroutine order()
      type(equilibrium_type) :: static
      type(static_figures_type) :: figures
      type(bearing_coefficients_type) :: linear
      real(wp) :: y(3), mean(3)
      character(len=*), parameter :: numbers(3) = [character(len=30) :: 'stations = 20, layers = 12', &
         & 'stations = 40, layers = 24', 'stations = 80, layers = 48']
      integer :: k
      do k = 1, 3
         call solve(paper//'&thermal model = ''film'', '//trim(numbers(k))//'/', static, figures, linear)
         y(k) = static%rotor(1)
         mean(k) = maxval(figures%oil%mean)
      end do
      call expect(abs(log((y(2) - y(1))/(y(3) - y(2)))/log(2.0_wp) - 2) < 0.3_wp, 'journal')
      call expect(abs(log((mean(2) - mean(1))/(mean(3) - mean(2)))/log(2.0_wp) - 2) < 0.5_wp, 'temperature')
   end subroutine order
end program test_film_equilibrium
