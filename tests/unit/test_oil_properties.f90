!> Viscosity of oils over the temperature, and over a march.
program test_oil_properties
   use kinds, only: wp
   use case_groups, only: oil_type, temperature_range, is_set
   use case_inputs, only: case_type
   use input_cases, only: case_of, expect_refused
   use namelist_writer, only: namelist_of, derived_text
   use oil_properties, only: viscosity, viscosity_slope, density, reference_viscosity, kinematic_points, grades
   use bearing_numbers, only: sommerfeld_number
   use equations_of_motion, only: machine_model, new_machine_model
   use viscosity_history, only: viscosity_history_type, new_viscosity_history
   use check, only: runs, expect, expect_close, report
   implicit none (type, external)
   character(len=*), parameter :: measured = '&oil kinematic_viscosity = 46e-6, 6.8e-6, density_at_15 = 870,' &
      & //' density_slope = -0.64 /', fillon = '&oil reference_viscosity = 0.0277, temperature_exponent = 0.0341 /'
   !> s, at uneven distances.
   real(wp), parameter :: time(0:4) = [0.0_wp, 0.5_wp, 0.7_wp, 1.5_wp, 2.0_wp]

   if (runs('walther')) call walther()
   if (runs('exponential')) call exponential()
   if (runs('slopes')) call slopes()
   if (runs('far_away')) call far_away()
   if (runs('index_of_grades')) call index_of_grades()
   if (runs('which_viscosity')) call which_viscosity()
   if (runs('text_and_back')) call text_and_back()
   if (runs('refused')) call refused()
   if (runs('parabola')) call parabola()
   if (runs('smooth')) call smooth()
   if (runs('ends')) call ends()
   call report()

contains

   !> An oil of 46 and 6.8 mm^2/s at 40 and 100 C: its two points, and the values of an independent program.
   subroutine walther()
      type(case_type) :: s
      s = case_of(measured)
      call expect_close(viscosity(s%bearings(1)%oil, 40.0_wp), 46e-6_wp*854, 1e-12_wp, 'the first point')
      call expect_close(viscosity(s%bearings(1)%oil, 100.0_wp), 6.8e-6_wp*815.6_wp, 1e-12_wp, 'the second point')
      call expect_close(viscosity(s%bearings(1)%oil, 60.0_wp), 17.348e-3_wp, 0.5e-6_wp, 'at 60 C')
      call expect_close(viscosity(s%bearings(1)%oil, 80.0_wp), 9.197e-3_wp, 0.5e-6_wp, 'at 80 C')
      call expect_close(density(s%bearings(1)%oil, 15.0_wp), 870.0_wp, 0.0_wp, 'its own density')
      s = case_of('&oil kinematic_viscosity = 46e-6, 6.8e-6, density = 900 /')
      call expect_close(density(s%bearings(1)%oil, 80.0_wp), 900.0_wp, 0.0_wp, 'or that of the heat balance')
   end subroutine walther

   subroutine exponential()
      type(case_type) :: s
      s = case_of(fillon)
      call expect_close(viscosity(s%bearings(1)%oil, 40.0_wp), 0.0277_wp, 0.0_wp, 'at the reference')
      call expect_close(viscosity(s%bearings(1)%oil, 60.0_wp), 0.0277_wp*exp(-0.682_wp), 1e-16_wp, '20 K above')
   end subroutine exponential

   !> Against central differences, whose error is of the third derivative: 1/6 (beta step)**2 of the slope.
   subroutine slopes()
      type(case_type) :: s
      real(wp), parameter :: step = 1e-2_wp
      integer :: i, k
      do k = 1, 2
         if (k == 1) s = case_of(measured)
         if (k == 2) s = case_of(fillon)
         do i = 0, 12
            associate (t => 10.0_wp*i, slope => viscosity_slope(s%bearings(1)%oil, 10.0_wp*i))
               call expect_close((viscosity(s%bearings(1)%oil, t + step) - viscosity(s%bearings(1)%oil, t &
                  & - step))/(2*step)/slope, 1.0_wp, &
                  & 1e-6_wp, 'slope')
            end associate
         end do
      end do
   end subroutine slopes

   !> A search may try any temperature: the viscosity stays a positive number, and stands still there.
   subroutine far_away()
      type(case_type) :: s
      integer :: k
      do k = 1, 3
         if (k == 1) s = case_of(measured)
         if (k == 2) s = case_of(fillon)
         if (k == 3) s = case_of('&oil kinematic_viscosity = 1e-2, 5e-7, at_temperature = 40, 41,' &
            & //' supply_temperature = 41 /')
         call expect(all(viscosity(s%bearings(1)%oil, [-1e9_wp, -273.15_wp, -100.0_wp, 500.0_wp, 1e9_wp]) > 0), &
            & 'positive')
         call expect(viscosity(s%bearings(1)%oil, -1e9_wp) < huge(1.0_wp), 'finite')
         call expect_close(viscosity(s%bearings(1)%oil, 1e9_wp), viscosity(s%bearings(1)%oil, &
            & temperature_range(2)), 0.0_wp, 'held above')
         call expect_close(viscosity_slope(s%bearings(1)%oil, -300.0_wp), 0.0_wp, 0.0_wp, 'without slope')
         call expect(viscosity_slope(s%bearings(1)%oil, -99.0_wp) <= 0, 'and thickens no oil that is warmed')
      end do
   end subroutine far_away

   !> Viscosity index 100: the viscosity at 40 C is H = d Y^2 + e Y + f of that at 100 C, Y (ASTM D2270, table X2.1).
   !> The table has five digits of Y, and H rises by at most twice the relative change of Y.
   subroutine index_of_grades()
      real(wp), parameter :: table(4, 16) = reshape([2.0_wp, 0.84155_wp, 1.5521_wp, -0.077_wp, &
         & 3.8_wp, 0.78571_wp, 1.7929_wp, -0.183_wp, 4.4_wp, 0.82143_wp, 1.5679_wp, 0.119_wp, &
         & 5.0_wp, 0.04985_wp, 9.1613_wp, -18.557_wp, 6.4_wp, 0.22619_wp, 7.7369_wp, -16.656_wp, &
         & 7.0_wp, 0.79762_wp, -0.7321_wp, 14.610_wp, 7.7_wp, 0.05794_wp, 10.5156_wp, -28.240_wp, &
         & 9.0_wp, 0.26665_wp, 6.7015_wp, -10.810_wp, 12.0_wp, 0.20073_wp, 8.4658_wp, -22.490_wp, &
         & 15.0_wp, 0.28889_wp, 5.9741_wp, -4.930_wp, 18.0_wp, 0.24504_wp, 7.4160_wp, -16.730_wp, &
         & 22.0_wp, 0.20323_wp, 9.1267_wp, -34.230_wp, 28.0_wp, 0.18411_wp, 10.1015_wp, -46.750_wp, &
         & 40.0_wp, 0.17029_wp, 11.4866_wp, -80.620_wp, &
         & 55.0_wp, 0.17130_wp, 11.3680_wp, -76.940_wp, 70.0_wp, 0.16841_wp, 11.8493_wp, -96.947_wp], [4, 16])
      type(oil_type) :: oil
      real(wp) :: points(2), row(4)
      integer :: i
      do i = 1, size(grades)
         oil%grade = grades(i)
         points = 1e6_wp*kinematic_points(oil)
         call expect_close(points(1), real(grades(i), wp), 1e-12_wp*grades(i), 'the middle of the grade')
         row = table(:, count(table(1, :) <= points(2)))
         call expect_close((row(2)*points(2) + row(3))*points(2) + row(4), points(1), 1e-4_wp*points(1), &
            & 'viscosity index 100')
      end do
   end subroutine index_of_grades

   !> The law that the numbers of a case belong to, and the viscosity that its films and its Sommerfeld number have.
   subroutine which_viscosity()
      type(case_type) :: s
      s = case_of('&case /')
      call expect(s%bearings(1)%oil%law == 'constant' .and. s%thermal%model == 'none', 'no law')
      call expect_films(s, 19e-3_wp)
      s = case_of('&bearing viscosity = 0.03 / &oil supply_temperature = 70 /')
      call expect_films(s, 0.03_wp)
      s = case_of('&oil grade = 46, supply_temperature = 50 /')
      call expect(s%bearings(1)%oil%law == 'walther' .and. .not. is_set(s%bearings(1)%viscosity), 'a grade')
      call expect_films(s, viscosity(s%bearings(1)%oil, 50.0_wp))
      call expect(index(derived_text(s), 'Pa s at oil%supply_temperature = 50 C') > 0, 'that --check prints')
      s = case_of('&oil reference_viscosity = 0.03, temperature_exponent = 0.03, supply_temperature = 60 /')
      call expect(s%bearings(1)%oil%law == 'exponential', 'a reference')
      call expect_films(s, 0.03_wp*exp(-0.6_wp))
   end subroutine which_viscosity

   subroutine expect_films(s, mu)
      type(case_type), intent(in) :: s
      real(wp), intent(in) :: mu
      type(machine_model) :: model
      model = new_machine_model(s)
      call expect_close(reference_viscosity(s%bearings(1)), mu, 1e-15_wp, 'viscosity')
      call expect_close(model%oil(2)%viscosity, mu, 1e-15_wp, 'of the films')
      call expect_close(sommerfeld_number(s)/sommerfeld_number(case_type()), mu/19e-3_wp, 1e-13_wp, &
         & 'Sommerfeld number')
   end subroutine expect_films

   !> The resolved case is the same case.
   subroutine text_and_back()
      type(case_type) :: s
      character(len=:), allocatable :: text
      s = case_of('&oil grade = 32, shaft_temperature = 55 / &thermal model = pad /')
      text = namelist_of(s)
      s = case_of(text)
      call expect(namelist_of(s) == text, 'a grade')
      call expect(index(text, 'grade = 32') > 0 .and. index(text, '  viscosity') == 0, 'no bearing%viscosity')
   end subroutine text_and_back

   subroutine refused()
      call refuse('grade = 47', 'oil%grade = 47: must be one of the ISO viscosity grades 10, 15, 22')
      call refuse('grade = 46, kinematic_viscosity(2) = 6e-6', 'oil%kinematic_viscosity = 6e-6 is given too')
      call refuse('grade = 46, at_temperature = 40, 90', 'oil%at_temperature = 40, 90: a grade')
      call refuse('grade = 46, temperature_exponent = 0.03', 'oil%temperature_exponent = 0.03: belongs to')
      call refuse('grade = 46, law = constant', 'oil%grade = 46: belongs to oil%law = ''walther''')
      call refuse('grade = 46 / &bearing viscosity = 0.02', 'bearing%viscosity = 0.02: belongs to')
      call refuse('law = walther', 'needs oil%grade, or two values of oil%kinematic_viscosity')
      call refuse('kinematic_viscosity(1) = 46e-6', 'needs oil%grade, or two values')
      call refuse('kinematic_viscosity = 6e-6, 46e-6', 'must not rise with the temperature')
      call refuse('kinematic_viscosity = 46e-6, 6e-6, at_temperature = 100, 40', 'above the first')
      call refuse('grade = 46, density_slope = -2', 'the density must be above 0 up to 500 C')
      call refuse('reference_viscosity = 0.03', 'needs oil%reference_viscosity and oil%temperature_exponent')
      call refuse('reference_viscosity = 0.03, temperature_exponent = -0.01', 'must be 0 to 1')
      call refuse('supply_temperature = -274', 'oil%supply_temperature = -274: must be -100 to 500')
      call refuse('grade = 220, supply_temperature = -20', 'Pa s; must be 1e-6 to 10')
      call refuse('/ &thermal model = pad', 'thermal%model = ''pad'': needs an oil whose viscosity depends')
      call refuse('/ &thermal march = groove', 'has no effect but with thermal%model = ''pad''')
      call refuse('grade = 46 / &thermal model = pad, march = groove', 'oil%groove_volume = 0: must be > 0')
   end subroutine refused

   subroutine refuse(oil, words)
      character(len=*), intent(in) :: oil, words
      call expect_refused('&oil '//oil//' /', words)
   end subroutine refuse

   !> ln of a viscosity that is a parabola.
   elemental real(wp) function logarithm(t)
      real(wp), intent(in) :: t
      logarithm = -4 + 0.7_wp*t - 0.3_wp*t**2
   end function logarithm

   subroutine parabola()
      type(viscosity_history_type) :: history
      real(wp) :: found(2)
      integer :: k
      history = new_viscosity_history(time, exp(reshape([(logarithm(time(k)), 2*logarithm(time(k)), k=0, 4)], [2, 5])))
      do k = 0, 40
         call history%at(k*0.05_wp, found)
         call expect_close(log(found(1)), logarithm(k*0.05_wp), 1e-13_wp, 'first pad')
         call expect_close(log(found(2)), 2*logarithm(k*0.05_wp), 1e-13_wp, 'second pad')
      end do
   end subroutine parabola

   !> No leap of value or slope at a node.
   subroutine smooth()
      type(viscosity_history_type) :: history
      real(wp), dimension(1) :: far_before, before, after, far_after
      real(wp), parameter :: step = 1e-5_wp
      integer :: k
      history = new_viscosity_history(time, reshape([3.0_wp, 2.0_wp, 5.0_wp, 4.0_wp, 1.0_wp], [1, 5]))
      do k = 1, 3
         call history%at(time(k) - 2*step, far_before)
         call history%at(time(k) - step, before)
         call history%at(time(k) + step, after)
         call history%at(time(k) + 2*step, far_after)
         call expect_close((far_after(1) - after(1))/step, (before(1) - far_before(1))/step, 5e-3_wp, 'slope')
         call expect_close(after(1), before(1), 1e-3_wp, 'value')
      end do
   end subroutine smooth

   subroutine ends()
      type(viscosity_history_type) :: history
      real(wp) :: found(1)
      call expect(.not. history%runs(), 'none before it is made')
      history = new_viscosity_history(time, reshape([3.0_wp, 2.0_wp, 5.0_wp, 4.0_wp, 1.0_wp], [1, 5]))
      call expect(history%runs(), 'made')
      call history%at(-1.0_wp, found)
      call expect_close(found(1), 3.0_wp, 1e-14_wp, 'before')
      call history%at(9.0_wp, found)
      call expect_close(found(1), 1.0_wp, 1e-14_wp, 'behind')
   end subroutine ends
end program test_oil_properties
