!> The list of all input variables: each with its component of the case, name, allowed values, unit and meaning.
!> The reader, the writer and the input reference each visit this list.
module case_fields
   use kinds, only: wp
   use field_visitor, only: visitor_type, field, choice
   use case_inputs, only: case_type, about_type, rotor_type, operation_type, bearing_type, oil_type, thermal_type, &
      & pads_type, pivot_type, friction_type, asperity_type, start_type, film_type, integration_type, output_type, &
      & mass_range, inertia_range, centre_range, temperature_range, viscosity_range
   use task_fields, only: visit_coefficients, visit_periodic, visit_branch
   implicit none (type, external)
   private
   public :: visit_case, title_variable, checkpoint_variable, pads_variable

   !> Variables without effect on what is calculated: a study cannot vary the title, and a resumed run may have
   !> another time between checkpoints.
   character(len=*), parameter :: title_variable = 'case%title'
   character(len=*), parameter :: checkpoint_variable = 'output%checkpoint_seconds'
   !> The variable whose length is the number of pads.
   character(len=*), parameter :: pads_variable = 'pads%pivot_angle_deg'

contains

   !> Shows every input variable of the case to the visitor, in the order of the input reference.
   subroutine visit_case(inputs, v)
      type(case_type), intent(inout) :: inputs
      class(visitor_type), intent(inout) :: v
      call visit_about(inputs%about, v)
      call visit_rotor(inputs%rotor, v)
      call visit_operation(inputs%operation, v)
      call visit_bearing(inputs%bearing, v)
      call visit_oil(inputs%oil, v)
      call visit_thermal(inputs%thermal, v)
      call visit_pads(inputs%pads, v)
      call visit_pivot(inputs%pivot, v)
      call visit_friction(inputs%friction, v)
      call visit_asperity(inputs%asperity, v)
      call visit_start(inputs%start, v)
      call visit_film(inputs%film, v)
      call visit_integration(inputs%integration, v)
      call visit_output(inputs%output, v)
      call visit_coefficients(inputs%coefficients, v)
      call visit_periodic(inputs%periodic, v)
      call visit_branch(inputs%branch, v)
   end subroutine visit_case

   subroutine visit_about(case, v)
      type(about_type), intent(inout) :: case
      class(visitor_type), intent(inout) :: v
      call v%group('case', 'Title and task of the run')
      call v%word(case%title, choice('title', '', 'free text, which the result file contains'))
      call v%word(case%task, choice('task', 'march equilibrium coefficients periodic branch', &
         & 'march: motion over time; equilibrium: only the static equilibrium; coefficients: the same, with ' &
         & //'stiffness, damping and stability there; periodic: the orbit that the motion repeats, and its ' &
         & //'stability; branch: equilibria or such orbits over a number of the input, and where their stability ' &
         & //'changes'))
   end subroutine visit_about

   subroutine visit_rotor(rotor, v)
      type(rotor_type), intent(inout) :: rotor
      class(visitor_type), intent(inout) :: v
      call v%group('rotor', 'The part of the rotor that this bearing carries, and its loads')
      call v%number(rotor%mass, field('mass', 1e-6_wp, 1e9_wp, 'kg', 'mass m_J carried by the bearing'))
      call v%number(rotor%unbalance, field('unbalance', 0.0_wp, 1e6_wp, 'kg m', 'unbalance dmE'))
      call v%number(rotor%balance_grade, field('balance_grade', -1.0_wp, 1e5_wp, 'mm/s', &
         & 'ISO 21940-11 grade G; > 0: eq (26) gives the unbalance instead'))
      call v%number(rotor%balance_speed_rpm, field('balance_speed_rpm', -1.0_wp, 1e6_wp, 'rpm', &
         & 'speed of eq (26); < 0: maximum speed of the run'))
      call v%number(rotor%gravity, field('gravity', 0.0_wp, 1e3_wp, 'm/s^2', 'acceleration towards -y'))
      call v%numbers(rotor%static_load, field('static_load', -1e12_wp, 1e12_wp, 'N', &
         & 'extra force on the journal along y and z'))
   end subroutine visit_rotor

   subroutine visit_operation(operation, v)
      type(operation_type), intent(inout) :: operation
      class(visitor_type), intent(inout) :: v
      call v%group('operation', 'Speed and duration')
      call v%number(operation%speed_rpm, field('speed_rpm', 1e-3_wp, 1e6_wp, 'rpm', 'shaft speed at the start'))
      call v%number(operation%final_speed_rpm, field('final_speed_rpm', -1.0_wp, 1e6_wp, 'rpm', &
         & 'shaft speed at the end; it changes linearly; < 0: the same as speed_rpm'))
      call v%number(operation%duration, field('duration', 1e-9_wp, 1e6_wp, 's', 'simulated time'))
   end subroutine visit_operation

   subroutine visit_bearing(bearing, v)
      type(bearing_type), intent(inout) :: bearing
      class(visitor_type), intent(inout) :: v
      call v%group('bearing', 'Geometry, oil and boundary pressures')
      call v%number(bearing%journal_radius, field('journal_radius', 1e-4_wp, 10.0_wp, 'm', 'radius R_J of the journal'))
      call v%number(bearing%machined_clearance, field('machined_clearance', 1e-9_wp, 0.1_wp, 'm', &
         & 'radial clearance c_m between pad bore and journal'))
      call v%number(bearing%assembled_clearance, field('assembled_clearance', 1e-9_wp, 0.1_wp, 'm', &
         & 'radial clearance c_r at the pivots'))
      call v%number(bearing%preload, field('preload', -1.0_wp, 0.999_wp, '1', &
         & 'instead of machined_clearance: preload m of the pads, c_m = c_r/(1 - m)'))
      call v%number(bearing%axial_length, field('axial_length', 1e-5_wp, 100.0_wp, 'm', 'pad length L along the shaft'))
      call v%number(bearing%viscosity, field('viscosity', viscosity_range(1), viscosity_range(2), 'Pa s', &
         & 'dynamic viscosity of the oil where oil%law is constant'))
      call v%number(bearing%supply_pressure, field('supply_pressure', -1e9_wp, 1e9_wp, 'Pa', &
         & 'pressure at the leading edges'))
      call v%number(bearing%ambient_pressure, field('ambient_pressure', -1e9_wp, 1e9_wp, 'Pa', &
         & 'pressure at the other edges'))
      call v%number(bearing%cavitation_pressure, field('cavitation_pressure', -1e9_wp, 1e9_wp, 'Pa', &
         & 'pressure at which the film cavitates'))
   end subroutine visit_bearing

   subroutine visit_oil(oil, v)
      type(oil_type), intent(inout) :: oil
      class(visitor_type), intent(inout) :: v
      real(wp), parameter :: low = temperature_range(1), high = temperature_range(2)
      call v%group('oil', 'Viscosity over temperature, and what heats the oil by how much; *Oil* above says which ' &
         & //'viscosity holds')
      call v%word(oil%law, choice('law', 'constant exponential walther', &
         & 'constant: bearing%viscosity; exponential, walther: over the temperature; if left out, the law whose ' &
         & //'numbers are given'))
      call v%whole(oil%grade, field('grade', 0.0_wp, 3200.0_wp, '1', &
         & 'walther: ISO viscosity grade, 10 15 22 32 46 68 100 150 220 320 460 680 1000 1500 2200 3200, with ' &
         & //'viscosity index 100; 0: kinematic_viscosity is given instead'))
      call v%numbers(oil%kinematic_viscosity, field('kinematic_viscosity', 5e-7_wp, 1.0_wp, 'm^2/s', &
         & 'walther: kinematic viscosities at at_temperature'))
      call v%numbers(oil%at_temperature, field('at_temperature', low, high, 'C', &
         & 'walther: the lower and the higher temperature of kinematic_viscosity'))
      call v%number(oil%density_at_15, field('density_at_15', 1.0_wp, 1e5_wp, 'kg/m^3', &
         & 'walther: density at 15 C, which makes the kinematic viscosity a dynamic one; density if left out'))
      call v%number(oil%density_slope, field('density_slope', -10.0_wp, 0.0_wp, 'kg/(m^3 K)', &
         & 'walther: change of this density with the temperature'))
      call v%number(oil%reference_viscosity, field('reference_viscosity', viscosity_range(1), viscosity_range(2), &
         & 'Pa s', 'exponential: dynamic viscosity at reference_temperature'))
      call v%number(oil%reference_temperature, field('reference_temperature', low, high, 'C', &
         & 'exponential: its temperature'))
      call v%number(oil%temperature_exponent, field('temperature_exponent', 0.0_wp, 1.0_wp, '1/K', &
         & 'exponential: beta of mu_ref exp(-beta (T - T_ref))'))
      call v%number(oil%density, field('density', 1.0_wp, 1e5_wp, 'kg/m^3', 'density of the heat balance, constant'))
      call v%number(oil%specific_heat, field('specific_heat', 1.0_wp, 1e6_wp, 'J/(kg K)', 'specific heat'))
      call v%number(oil%conductivity, field('conductivity', 0.0_wp, 1e3_wp, 'W/(m K)', 'thermal conductivity'))
      call v%number(oil%supply_temperature, field('supply_temperature', low, high, 'C', &
         & 'temperature of the fresh oil; of all oil where there is no heat balance'))
      call v%number(oil%carry_over, field('carry_over', 0.0_wp, 1.0_wp, '1', &
         & 'part of the oil leaving a pad that enters the next one'))
      call v%number(oil%widest_gap_deg, field('widest_gap_deg', 0.0_wp, 360.0_wp, 'deg', &
         & 'widest gap between two pads that oil is carried across; beyond it a pad draws fresh oil'))
      call v%number(oil%shaft_nusselt, field('shaft_nusselt', 0.0_wp, 1e3_wp, '1', &
         & 'Nusselt number of the exchange of heat between film and shaft; 0: none'))
      call v%number(oil%shaft_temperature, field('shaft_temperature', low, high, 'C', &
         & 'temperature of the shaft; if left out, that at which it takes no heat on the whole'))
      call v%number(oil%groove_volume, field('groove_volume', 0.0_wp, 1.0_wp, 'm^3', &
         & 'oil between two pads, for thermal%march = groove'))
   end subroutine visit_oil

   subroutine visit_thermal(thermal, v)
      type(thermal_type), intent(inout) :: thermal
      class(visitor_type), intent(inout) :: v
      call v%group('thermal', 'Heat balance of the oil')
      call v%word(thermal%model, choice('model', 'none pad', &
         & 'none: all oil has supply_temperature; pad: a temperature and a viscosity for each pad'))
      call v%word(thermal%march, choice('march', 'frozen groove', &
         & 'in a march; frozen: temperatures of the equilibrium; groove: the oil between the pads warms and cools'))
   end subroutine visit_thermal

   subroutine visit_pads(pads, v)
      type(pads_type), intent(inout) :: pads
      class(visitor_type), intent(inout) :: v
      call v%group('pads', &
         & 'The bearing has one pad for each pivot angle; other variables take one value for all pads or one for each')
      call v%per_pad(pads%pivot_angle_deg, field('pivot_angle_deg', -360.0_wp, 360.0_wp, 'deg', &
         & 'angle theta of each pivot, from +z towards +y', fixes_pads=.true.))
      call v%per_pad(pads%arc_deg, field('arc_deg', 0.1_wp, 360.0_wp, 'deg', &
         & 'arc theta_1 + theta_2; at most 350 for pads that tilt'))
      call v%per_pad(pads%pivot_ratio, field('pivot_ratio', 0.01_wp, 0.99_wp, '1', &
         & 'offset: position of the pivot from the leading edge, theta_1 over the arc'))
      call v%per_pad(pads%pivot_distance, field('pivot_distance', 1e-6_wp, 1.0_wp, 'm', &
         & 'radial distance kappa from the pad''s bore to the pivot'))
      call v%per_pad(pads%mass, field('mass', mass_range(1), mass_range(2), 'kg', 'pad mass; *Pads* above says what ' &
         & //'it is if it is not given'))
      call v%per_pad(pads%inertia, field('inertia', inertia_range(1), inertia_range(2), 'kg m^2', &
         & 'moment of inertia about the pivot; likewise'))
      call v%per_pad(pads%centre_tangential, field('centre_tangential', centre_range(1), centre_range(2), 'm', &
         & 'position C_xi of the centre of gravity from the pivot, along the pad; likewise'))
      call v%per_pad(pads%centre_radial, field('centre_radial', centre_range(1), centre_range(2), 'm', &
         & 'position C_eta of the centre of gravity from the pivot, outward; likewise'))
      call v%per_pad(pads%density, field('density', 1.0_wp, 1e5_wp, 'kg/m^3', &
         & 'instead of mass: density of the pad; steel, 7850, where it is needed and not given'))
      call v%per_pad(pads%thickness, field('thickness', 1e-6_wp, 1.0_wp, 'm', &
         & 'radial thickness of the pad, for mass, inertia and centre of gravity; pivot_distance where it is needed ' &
         & //'and not given'))
      call v%word(pads%motion, choice('motion', 'tilting_radial tilting_only fixed', &
         & 'tilting_radial: the pads tilt and move radially on their pivots; tilting_only: they only tilt; fixed: ' &
         & //'neither, lobes of a plain bearing'))
   end subroutine visit_pads

   subroutine visit_pivot(pivot, v)
      type(pivot_type), intent(inout) :: pivot
      class(visitor_type), intent(inout) :: v
      call v%group('pivot', 'Ball-and-socket contact')
      call v%word(pivot%law, choice('law', 'fang hertz', 'fang: conformal contact (11)-(18); hertz: law of Hertz'))
      call v%number(pivot%socket_radius, field('socket_radius', 1e-5_wp, 10.0_wp, 'm', 'radius R_2 of the socket'))
      call v%number(pivot%radius_difference, field('radius_difference', 0.0_wp, 1.0_wp, 'm', &
         & 'dR = R_2 - R_1, R_1 being the radius of the ball'))
      call v%numbers(pivot%young_modulus, field('young_modulus', 1e6_wp, 1e14_wp, 'Pa', 'values of ball and socket'))
      call v%numbers(pivot%poisson_ratio, field('poisson_ratio', -0.99_wp, 0.5_wp, '1', 'values of ball and socket'))
      call v%number(pivot%deflection_factor, field('deflection_factor', 0.1_wp, 100.0_wp, '1', &
         & 'factor of eq (13): 4 as printed; 2 pi agrees with Hertz''s law'))
   end subroutine visit_pivot

   subroutine visit_friction(friction, v)
      type(friction_type), intent(inout) :: friction
      class(visitor_type), intent(inout) :: v
      call v%group('friction', 'Friction in the pivots')
      call v%word(friction%model, choice('model', 'none bengisu_akay lugre', &
         & 'none; bengisu_akay: eq (22); lugre: eqs (23)-(25)'))
      call v%number(friction%static_coefficient, field('static_coefficient', 1e-6_wp, 10.0_wp, '1', &
         & 'static friction coefficient f_s'))
      call v%number(friction%dynamic_coefficient, field('dynamic_coefficient', 0.0_wp, 10.0_wp, '1', &
         & 'dynamic friction coefficient f_d <= f_s'))
      call v%number(friction%critical_velocity, field('critical_velocity', 1e-12_wp, 10.0_wp, 'm/s', &
         & 'Bengisu-Akay: critical velocity v_c'))
      call v%number(friction%decay, field('decay', 0.0_wp, 1e9_wp, 's/m', &
         & 'Bengisu-Akay: decay chi of the Stribeck curve'))
      call v%number(friction%stribeck_velocity, field('stribeck_velocity', 1e-9_wp, 1e3_wp, 'm/s', &
         & 'LuGre: Stribeck velocity v_s'))
      call v%number(friction%stribeck_exponent, field('stribeck_exponent', 0.1_wp, 10.0_wp, '1', &
         & 'LuGre: Stribeck exponent gamma'))
      call v%number(friction%bristle_stiffness, field('bristle_stiffness', 1.0_wp, 1e12_wp, '1/m', &
         & 'LuGre: bristle stiffness sigma_0'))
      call v%number(friction%bristle_damping, field('bristle_damping', -1.0_wp, 1e6_wp, 's/m', &
         & 'LuGre: bristle damping sigma_1; < 0: from eq (28)'))
      call v%number(friction%viscous_coefficient, field('viscous_coefficient', 0.0_wp, 1e6_wp, 's/m', &
         & 'LuGre: viscous coefficient sigma_2'))
      call v%number(friction%characteristic_load, field('characteristic_load', 1e-6_wp, 1e12_wp, 'N', &
         & 'LuGre: characteristic load N_m of eq (28)'))
   end subroutine visit_friction

   subroutine visit_asperity(asperity, v)
      type(asperity_type), intent(inout) :: asperity
      class(visitor_type), intent(inout) :: v
      call v%group('asperity', 'Contact of pad and journal where the film is thinner than 4 times their roughness')
      call v%word(asperity%model, choice('model', 'greenwood_tripp none', &
         & 'greenwood_tripp: pressure of the asperities; none: a film that closes ends the run'))
      call v%number(asperity%roughness, field('roughness', 1e-9_wp, 1e-3_wp, 'm', &
         & 'combined rms roughness sigma, the root of the sum of the squares of both; 0.5 um: ground or fine turned'))
      call v%number(asperity%elastic_modulus, field('elastic_modulus', 1e5_wp, 1e14_wp, 'Pa', &
         & 'composite modulus E'', 1/E'' = (1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2; 47 GPa: steel on white metal ' &
         & //'(210 and 52 GPa)'))
      call v%number(asperity%factor, field('factor', 1e-9_wp, 1.0_wp, '1', &
         & 'K'' = 16 sqrt(2) pi/15 (sigma beta eta)^2 (sigma/beta)^0.5; 0.003: upper end of the usual 0.0003 to 0.003'))
      call v%number(asperity%friction_coefficient, field('friction_coefficient', 0.0_wp, 10.0_wp, '1', &
         & 'boundary friction of touching asperities; 0.1: usual for oiled metals'))
   end subroutine visit_asperity

   subroutine visit_start(start, v)
      type(start_type), intent(inout) :: start
      class(visitor_type), intent(inout) :: v
      call v%group('start', 'Where a march starts; the values of journal and pads are added, as a disturbance; a ' &
         & //'resumed run does not start again')
      call v%word(start%from, choice('from', 'equilibrium partial centred given file', &
         & 'equilibrium: of the initial speed, at rest; partial: the same, but pads without equilibrium stand on ' &
         & //'their pivots without tilt; centred: journal in the middle, pads at rest on their pivots without tilt; ' &
         & //'given: only the values of journal and pads below; file: the end of another result'))
      call v%word(start%file, choice('file', '', 'file: the result file, with the same pads; its last whole turn of ' &
         & //'the shaft is taken'))
      call v%numbers(start%journal, field('journal', -0.1_wp, 0.1_wp, 'm', 'displacement of the journal along y and z'))
      call v%numbers(start%journal_velocity, field('journal_velocity', -1e3_wp, 1e3_wp, 'm/s', &
         & 'velocity of the journal along y and z'))
      call v%per_pad(start%pad_tilt, field('pad_tilt', -3.0_wp, 3.0_wp, 'rad', 'tilts of the pads'))
      call v%per_pad(start%pad_tilt_rate, field('pad_tilt_rate', -1e5_wp, 1e5_wp, 'rad/s', 'their rates'))
      call v%per_pad(start%pivot_deflection, field('pivot_deflection', -0.1_wp, 0.1_wp, 'm', &
         & 'tilting_radial: pivot deflections of the pivots'))
      call v%per_pad(start%pivot_deflection_rate, field('pivot_deflection_rate', -1e3_wp, 1e3_wp, 'm/s', &
         & 'tilting_radial: their rates'))
   end subroutine visit_start

   subroutine visit_film(film, v)
      type(film_type), intent(inout) :: film
      class(visitor_type), intent(inout) :: v
      call v%group('film', 'Solver of the Reynolds equation')
      call v%word(film%solver, choice('solver', 'auto direct fourier sor', &
         & 'auto: tables of converged films, direct where there is none; direct: axial modes, finite volumes where ' &
         & //'a film cavitates; fourier: axial Fourier expansion; sor: over-relaxation'))
      call v%whole(film%circumferential_cells, field('circumferential_cells', 0.0_wp, 2000.0_wp, '1', &
         & 'direct, fourier, sor: cells along the arc, an even number; 0: as many as axial modes need, 80 where a ' &
         & //'film cavitates, 60 for sor, twice or three times as many from 180 or 300 degrees on'))
      call v%whole(film%axial_cells, field('axial_cells', 0.0_wp, 1000.0_wp, '1', &
         & 'direct, sor: cells along half the width, at least 2; 0: 8, or 15 for sor'))
      call v%whole(film%axial_modes, field('axial_modes', 0.0_wp, 200.0_wp, '1', &
         & 'direct, fourier: maximum number of axial modes; the closed form takes those that are too stiff for the ' &
         & //'cells; 0: automatic'))
      call v%number(film%relaxation, field('relaxation', 0.0_wp, 1.999_wp, '1', &
         & 'sor: relaxation factor; 0: the optimum for the grid'))
      call v%number(film%tolerance, field('tolerance', 1e-13_wp, 1e-2_wp, '1', &
         & 'sor: limit of residual over source; at most a thousandth of relative_tolerance is used'))
      call v%whole(film%max_sweeps, field('max_sweeps', 1.0_wp, 1e8_wp, '1', &
         & 'sor: maximum number of sweeps for a film; more is a failure'))
      call v%number(film%table_tolerance, field('table_tolerance', 0.0_wp, 1e-2_wp, '1', &
         & 'auto: error of forces from tables over that of the film at the onset of cavitation; ' &
         & //'0: relative_tolerance, with reynolds 4 times as much; cavitated films keep to 1.2e-6 at best'))
      call v%word(film%cavitation, choice('cavitation', 'reynolds gumbel none', &
         & 'reynolds: p >= p_cav in the solution; gumbel: clipped after the solution; none: no cavitation'))
   end subroutine visit_film

   subroutine visit_integration(integration, v)
      type(integration_type), intent(inout) :: integration
      class(visitor_type), intent(inout) :: v
      call v%group('integration', 'Integration in time by CVODE')
      call v%number(integration%relative_tolerance, field('relative_tolerance', 1e-13_wp, 1e-2_wp, '1', &
         & 'relative tolerance of every state'))
      call v%number(integration%tolerance_scale, field('tolerance_scale', 1e-6_wp, 1e6_wp, '1', &
         & 'factor of the absolute tolerances: each is relative_tolerance times this times the scale of its state'))
      call v%number(integration%max_step, field('max_step', 0.0_wp, 1e6_wp, 's', 'maximum step; 0: no limit'))
      call v%whole(integration%max_steps, field('max_steps', 1.0_wp, 2e9_wp, '1', &
         & 'maximum number of steps of the march; more is a failure'))
      call v%number(integration%stop_when_periodic, field('stop_when_periodic', 0.0_wp, 1.0_wp, '1', &
         & '> 0: the run ends when the samples repeat from one revolution to the next within this part of the ' &
         & //'bearing clearance (journal) and of the clearance over the pad''s length (tilts)'))
   end subroutine visit_integration

   subroutine visit_output(output, v)
      type(output_type), intent(inout) :: output
      class(visitor_type), intent(inout) :: v
      call v%group('output', 'Contents of the result file')
      call v%whole(output%samples_per_revolution, field('samples_per_revolution', 1.0_wp, 1e6_wp, '1', &
         & 'samples per revolution at the maximum speed of the run'))
      call v%number(output%start_time, field('start_time', 0.0_wp, 1e6_wp, 's', 'time of the first sample'))
      call v%whole(output%spectrum_revolutions, field('spectrum_revolutions', 1.0_wp, 1e6_wp, '1', &
         & 'number of revolutions at the end of the run that the spectra cover, where there are samples'))
      call v%number(output%checkpoint_seconds, field('checkpoint_seconds', 0.0_wp, 1e9_wp, 's', &
         & 'wall time between checkpoints, from which --resume continues; 0: only when a signal stops the run'))
   end subroutine visit_output
end module case_fields
