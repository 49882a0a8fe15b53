!> Thermal equilibria: the values of an independent program, the isothermal limit, thresholds, run-ups, and refusals.
program test_thermal_equilibrium
   use kinds, only: wp
   use errors, only: error_type, numerics_error
   use case_inputs, only: case_type
   use input_cases, only: case_of
   use linear_analysis, only: analyse
   use state_layout, only: tilt, pivot_deflection
   use equations_of_motion, only: machine_model, new_machine_model
   use equilibrium_record, only: equilibrium_type, static_figures_type, find_static_figures
   use equilibrium, only: find_equilibrium
   use linear_bearing, only: bearing_coefficients_type
   use viscosity_history, only: viscosity_history_type
   use thermal_equilibrium, only: find_groove_transient
   use check, only: runs, expect, expect_close, expect_no_error, expect_error, report
   implicit none (type, external)

   !> Oil of grade 46 with the density of its viscosity.
   character(len=*), parameter :: vg46 = '&oil kinematic_viscosity = 46e-6, 6.8e-6, density_at_15 = 870,' &
      & //' density_slope = -0.64, specific_heat = 1951.8/ &thermal model = ''pad''/'
   !> The bearing of Fillon, Bligoud and Frene (1992) with its oil.
   character(len=*), parameter :: fillon = '&rotor mass = 1019.36799/ &bearing journal_radius = 50e-3,' &
      & //' axial_length = 70e-3, machined_clearance = 148e-6, assembled_clearance = 78.44e-6/' &
      & //'&pads motion = ''tilting_only'', pivot_angle_deg = -45, 225, 45, 135, arc_deg = 75,' &
      & //' mass = 1e-6, inertia = 1e-9/ &oil reference_viscosity = 0.0277,' &
      & //' temperature_exponent = 0.0341, specific_heat = 1951.8, conductivity = 0.149, carry_over = 1/' &
      & //'&thermal model = ''pad''/'

   if (runs('published')) call published()
   if (runs('cross_stiffness')) call cross_stiffness()
   if (runs('isothermal')) call isothermal()
   if (runs('capacity')) call capacity()
   if (runs('threshold')) call threshold()
   if (runs('boiling')) call boiling()
   if (runs('run_up')) call run_up()
   call report()

contains

   !> The equilibrium of a case, its figures, and its model, which has the viscosities.
   subroutine solve(inputs, static, figures, model)
      type(case_type), intent(in) :: inputs
      type(equilibrium_type), intent(out) :: static
      type(static_figures_type), intent(out), optional :: figures
      type(machine_model), intent(out), optional :: model
      type(machine_model) :: own
      type(error_type), allocatable :: error
      own = new_machine_model(inputs)
      call find_equilibrium(own, static, error)
      call expect_no_error(error, 'equilibrium')
      if (allocated(error)) return
      own%oil = static%oil
      if (present(figures)) call find_static_figures(own, static, figures)
      if (present(model)) model = own
   end subroutine solve

   !> An independent program's values at 4000 rpm (finite volumes of 240 x 48 and 480 x 96, extrapolated), of pads
   !> without weight: those of the bearing are not published. Its damping moves by single volumes that cavitate.
   subroutine published()
      type(equilibrium_type) :: static
      type(static_figures_type) :: figures
      type(machine_model) :: model
      type(bearing_coefficients_type) :: found
      real(wp), parameter :: outlet(4) = [64.208_wp, 65.475_wp, 51.683_wp, 50.079_wp]
      call solve(case_of('&operation speed_rpm = 4000/'//fillon), static, figures, model)
      call expect(all(abs(figures%oil%outlet - outlet) < 0.004_wp), 'outlets')
      call expect_close(figures%oil%shaft, 57.276_wp, 0.003_wp, 'shaft')
      call expect_close(maxval(figures%oil%maximum), 69.6_wp, 0.06_wp, 'maximum')
      call analyse(model%inputs, 'coefficients', found, static)
      call expect_close(static%rotor(1), -55.7045e-6_wp, 0.003e-6_wp, 'y, of converged films')
      call expect_close(found%stiffness(1, 1, 1, 1, 1), 351.43e6_wp, 0.05e6_wp, 'K_yy')
      call expect_close(found%damping(1, 1, 1, 1, 1), 0.6163e6_wp, 0.0004e6_wp, 'C_yy')
   end subroutine published

   !> The paper's bearing at 6500 rpm: one pad runs in oil that the other has warmed: cross-coupled stiffness appears.
   subroutine cross_stiffness()
      type(equilibrium_type) :: static
      type(static_figures_type) :: figures
      type(machine_model) :: model
      type(bearing_coefficients_type) :: found
      call solve(case_of('&pads motion = ''tilting_only''/ &film cavitation = ''none''/'//vg46), static, figures, &
         & model)
      call expect(all(abs(static%oil%viscosity - [23e-3_wp, 13.4e-3_wp]) < [0.5e-3_wp, 0.05e-3_wp]), 'viscosities')
      call expect_close(static%rotor(2), -7e-6_wp, 0.5e-6_wp, 'z')
      call analyse(model%inputs, 'coefficients', found, static)
      call expect_close(found%stiffness(1, 2, 1, 1, 1), 61e6_wp, 1e6_wp, 'K_yz')
      call expect_close(found%stiffness(2, 1, 1, 1, 1), 61e6_wp, 1e6_wp, 'K_zy')
   end subroutine cross_stiffness

   !> Oil whose viscosity does not fall: bit for bit the equilibrium without temperatures.
   subroutine isothermal()
      type(case_type) :: inputs
      type(equilibrium_type) :: warm, cold
      type(static_figures_type) :: figures, of_cold
      inputs = case_of('&pads pivot_angle_deg = -45, 225, 45, 135/ &oil reference_viscosity = 0.0277,' &
         & //' temperature_exponent = 0/ &thermal model = ''pad''/')
      call solve(inputs, warm, figures)
      inputs%thermal%model = 'none'
      call solve(inputs, cold, of_cold)
      call expect(.not. any(abs([warm%rotor - cold%rotor, warm%pads%x(tilt) - cold%pads%x(tilt), &
         & warm%pads%x(pivot_deflection) - cold%pads%x(pivot_deflection), &
         & warm%oil%viscosity - cold%oil%viscosity]) > 0), 'state')
      call expect(.not. any(abs(figures%pads%power() - of_cold%pads%power()) > 0), 'losses')
      call expect(allocated(figures%oil) .and. .not. allocated(of_cold%oil), 'temperatures of warm oil alone')
   end subroutine isothermal

   !> Density and specific heat count as their product; oil that takes much heat stays cold.
   subroutine capacity()
      type(case_type) :: inputs
      type(equilibrium_type) :: static, other
      type(static_figures_type) :: figures
      inputs = case_of('&film cavitation = ''none''/'//vg46)
      call solve(inputs, static, figures)
      inputs%bearings(1)%oil%density = inputs%bearings(1)%oil%density/4
      inputs%bearings(1)%oil%specific_heat = inputs%bearings(1)%oil%specific_heat*4
      call solve(inputs, other, figures)
      call expect(all(abs(other%rotor - static%rotor) < 1e-12_wp), 'journal')
      inputs%bearings(1)%oil%specific_heat = 1e12_wp
      call solve(inputs, other, figures)
      call expect(all(abs(figures%oil%maximum - inputs%bearings(1)%oil%supply_temperature) < 1e-4_wp), 'cold')
   end subroutine capacity

   !> The speed at which a light rotor loses its stability is one at which its own equilibrium has no growth.
   subroutine threshold()
      type(case_type) :: inputs
      type(equilibrium_type) :: static
      type(bearing_coefficients_type) :: found
      inputs = case_of('&case task = ''coefficients''/ &rotor mass = 200/ &operation speed_rpm = 13000/' &
         & //'&film cavitation = ''none''/ &coefficients threshold_up_to_rpm = 20000/'//vg46)
      call analyse(inputs, 'threshold', found)
      inputs%operation%speed_rpm = found%thresholds(1)
      inputs%operation%final_speed_rpm = found%thresholds(1)
      call solve(inputs, static)
      call expect_close(static%stability%eigenvalue%re, 0.0_wp, 1e-4_wp*abs(static%stability%eigenvalue), 'growth')
   end subroutine threshold

   !> A film that makes more heat than its oil carries off.
   subroutine boiling()
      type(machine_model) :: model
      type(equilibrium_type) :: static
      type(error_type), allocatable :: error
      model = new_machine_model(case_of('&operation speed_rpm = 150/ &rotor mass = 5000/ &pads motion =' &
         & //' ''tilting_only''/ &oil grade = 10/ &thermal model = ''pad''/'))
      call find_equilibrium(model, static, error)
      call expect_error(error, numerics_error, 'above 300 C, where mineral oil boils', 'refused')
   end subroutine boiling

   !> Viscosities at the end of a run-up, on a shaft of 55 C, with so much oil in the grooves, m^3, over a duration, s.
   function after_run_up(volume, duration) result(viscosities)
      real(wp), intent(in) :: volume, duration
      real(wp) :: viscosities(2)
      type(case_type) :: inputs
      type(equilibrium_type) :: static
      type(machine_model) :: model
      type(viscosity_history_type) :: history
      type(error_type), allocatable :: error
      inputs = case_of('&operation speed_rpm = 3000, final_speed_rpm = 4000/ &film cavitation = ''none''/'//vg46)
      inputs%bearings(1)%oil%shaft_temperature = 55
      inputs%bearings(1)%oil%groove_volume = volume
      inputs%operation%duration = duration
      call solve(inputs, static, model=model)
      call find_groove_transient(model, model%static_state(static%rotor, static%pads), &
         & duration, history, error)
      call expect_no_error(error, 'course')
      if (.not. allocated(error)) call history%at(duration, viscosities)
   end function after_run_up

   !> A slow run-up ends at the equilibrium of the last speed, a quick one lags behind it in the groove's time, and oil
   !> that is never renewed keeps its temperature where it enters the films.
   subroutine run_up()
      type(case_type) :: inputs
      type(equilibrium_type) :: static
      real(wp) :: slow(2), lag(2), longer(2), never(2)
      inputs = case_of('&operation speed_rpm = 4000/ &film cavitation = ''none''/'//vg46)
      inputs%bearings(1)%oil%shaft_temperature = 55
      call solve(inputs, static)
      slow = after_run_up(1e-5_wp, 1e4_wp)
      call expect(all(abs(slow/static%oil%viscosity - 1) < 1e-4_wp), 'slow')
      ! behind the other pad; the first draws fresh oil alone
      lag = log(after_run_up(1e-5_wp, 20.0_wp)/static%oil%viscosity)
      longer = log(after_run_up(2e-5_wp, 20.0_wp)/static%oil%viscosity)
      call expect(abs(lag(1)) < 1e-4_wp .and. lag(2) > 1e-4_wp, 'lag')
      call expect_close(longer(2)/lag(2), 2.0_wp, 0.05_wp, 'twice the oil, twice the lag')
      never = after_run_up(1.0_wp, 1e-2_wp)
      call expect(never(2) > static%oil(2)%viscosity*exp(lag(2)), 'never renewed')
   end subroutine run_up
end program test_thermal_equilibrium
