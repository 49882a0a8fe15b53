!> The list of all input variables: each with its component of the case, name, allowed values, unit and meaning.
module case_fields
   use kinds, only: wp
   use variable_table, only: variable_table_type
   use case_groups, only: max_pads, most_ratios, mass_range, inertia_range, centre_range, temperature_range, &
      & viscosity_range
   use case_inputs, only: case_type
   implicit none (type, external)
   private
   public :: list_variables, put_variables, title_variable, checkpoint_variable, pads_variable

   !> Variables without effect on what is calculated: a study cannot vary the title, and a resumed run may have
   !> another time between checkpoints.
   character(len=*), parameter :: title_variable = 'case%title'
   character(len=*), parameter :: checkpoint_variable = 'output%checkpoint_seconds'
   !> The variable whose length is the number of pads.
   character(len=*), parameter :: pads_variable = 'pads%pivot_angle_deg'

contains

   !> The table of a case.
   subroutine list_variables(inputs, table)
      type(case_type), intent(in) :: inputs
      type(variable_table_type), intent(out) :: table
      type(case_type) :: copy
      copy = inputs
      call table%begin(filled=.false.)
      call go_along(copy, table)
   end subroutine list_variables

   !> Gives a case the values of the table.
   subroutine put_variables(table, inputs)
      type(variable_table_type), intent(inout) :: table
      type(case_type), intent(inout) :: inputs
      call table%begin(filled=.true.)
      call go_along(inputs, table)
   end subroutine put_variables

   !> All variables, in the order of the input reference.
   subroutine go_along(inputs, v)
      type(case_type), intent(inout) :: inputs
      type(variable_table_type), intent(inout) :: v
      real(wp), parameter :: low = temperature_range(1), high = temperature_range(2)
      ! long: the list of all variables
      call v%group('case', 'Title and task of the run')
      call v%word(inputs%about%title, 'title', '', 'free text, which the result file contains')
      call v%word(inputs%about%task, 'task', 'march equilibrium coefficients periodic branch', &
         & 'march: motion over time; equilibrium: only the static equilibrium; coefficients: the same, with ' &
         & //'stiffness, damping and stability there; periodic: the orbit that the motion repeats, and its ' &
         & //'stability; branch: equilibria or such orbits over a number of the input, and where their stability ' &
         & //'changes')

      call v%group('rotor', 'The part of the rotor that this bearing carries, and its loads')
      call v%number(inputs%rotor%mass, 'mass', 1e-6_wp, 1e9_wp, 'kg', 'mass m_J carried by the bearing')
      call v%number(inputs%rotor%unbalance, 'unbalance', 0.0_wp, 1e6_wp, 'kg m', 'unbalance dmE')
      call v%number(inputs%rotor%balance_grade, 'balance_grade', 1e-6_wp, 1e5_wp, 'mm/s', &
         & 'instead of unbalance: ISO 21940-11 grade G of eq (26)')
      call v%number(inputs%rotor%balance_speed_rpm, 'balance_speed_rpm', 1.0_wp, 1e6_wp, 'rpm', &
         & 'speed of eq (26); if left out, the maximum speed of the run')
      call v%number(inputs%rotor%gravity, 'gravity', 0.0_wp, 1e3_wp, 'm/s^2', 'acceleration towards -y')
      call v%numbers(inputs%rotor%static_load, 'static_load', -1e12_wp, 1e12_wp, 'N', &
         & 'extra force on the journal along y and z')

      call v%group('operation', 'Speed and duration')
      call v%number(inputs%operation%speed_rpm, 'speed_rpm', 1e-3_wp, 1e6_wp, 'rpm', 'shaft speed at the start')
      call v%number(inputs%operation%final_speed_rpm, 'final_speed_rpm', 0.0_wp, 1e6_wp, 'rpm', &
         & 'shaft speed at the end; it changes linearly; if left out, speed_rpm')
      call v%number(inputs%operation%duration, 'duration', 1e-9_wp, 1e6_wp, 's', 'simulated time')

      call v%group('bearing', 'Geometry, oil and boundary pressures')
      call v%number(inputs%bearing%journal_radius, 'journal_radius', 1e-4_wp, 10.0_wp, 'm', 'radius R_J of the journal')
      call v%number(inputs%bearing%machined_clearance, 'machined_clearance', 1e-9_wp, 0.1_wp, 'm', &
         & 'radial clearance c_m between pad bore and journal')
      call v%number(inputs%bearing%assembled_clearance, 'assembled_clearance', 1e-9_wp, 0.1_wp, 'm', &
         & 'radial clearance c_r at the pivots')
      call v%number(inputs%bearing%preload, 'preload', -1.0_wp, 0.999_wp, '1', &
         & 'instead of machined_clearance: preload m of the pads, c_m = c_r/(1 - m)')
      call v%number(inputs%bearing%axial_length, 'axial_length', 1e-5_wp, 100.0_wp, 'm', 'pad length L along the shaft')
      call v%number(inputs%bearing%viscosity, 'viscosity', viscosity_range(1), viscosity_range(2), 'Pa s', &
         & 'dynamic viscosity of the oil where oil%law is constant')
      call v%number(inputs%bearing%supply_pressure, 'supply_pressure', -1e9_wp, 1e9_wp, 'Pa', &
         & 'pressure at the leading edges')
      call v%number(inputs%bearing%ambient_pressure, 'ambient_pressure', -1e9_wp, 1e9_wp, 'Pa', &
         & 'pressure at the other edges')
      call v%number(inputs%bearing%cavitation_pressure, 'cavitation_pressure', -1e9_wp, 1e9_wp, 'Pa', &
         & 'pressure at which the film cavitates')

      call v%group('oil', &
         & 'Viscosity over temperature, and what heats the oil by how much; *Oil* above says which viscosity holds')
      call v%word(inputs%oil%law, 'law', 'constant exponential walther', &
         & 'constant: bearing%viscosity; exponential, walther: over the temperature; if left out, the law whose ' &
         & //'numbers are given')
      call v%number(inputs%oil%grade, 'grade', 0.0_wp, 3200.0_wp, '1', &
         & 'walther: ISO viscosity grade, 10 15 22 32 46 68 100 150 220 320 460 680 1000 1500 2200 3200, with ' &
         & //'viscosity index 100; if left out or 0, kinematic_viscosity is given', whole=.true.)
      call v%numbers(inputs%oil%kinematic_viscosity, 'kinematic_viscosity', 5e-7_wp, 1.0_wp, 'm^2/s', &
         & 'walther: kinematic viscosities at at_temperature')
      call v%numbers(inputs%oil%at_temperature, 'at_temperature', low, high, 'C', &
         & 'walther: the lower and the higher temperature of kinematic_viscosity')
      call v%number(inputs%oil%density_at_15, 'density_at_15', 1.0_wp, 1e5_wp, 'kg/m^3', &
         & 'walther: density at 15 C, which makes the kinematic viscosity a dynamic one; density if left out')
      call v%number(inputs%oil%density_slope, 'density_slope', -10.0_wp, 0.0_wp, 'kg/(m^3 K)', &
         & 'walther: change of this density with the temperature')
      call v%number(inputs%oil%reference_viscosity, 'reference_viscosity', viscosity_range(1), viscosity_range(2), &
         & 'Pa s', 'exponential: dynamic viscosity at reference_temperature')
      call v%number(inputs%oil%reference_temperature, 'reference_temperature', low, high, 'C', &
         & 'exponential: its temperature')
      call v%number(inputs%oil%temperature_exponent, 'temperature_exponent', 0.0_wp, 1.0_wp, '1/K', &
         & 'exponential: beta of mu_ref exp(-beta (T - T_ref))')
      call v%number(inputs%oil%density, 'density', 1.0_wp, 1e5_wp, 'kg/m^3', 'density of the heat balance, constant')
      call v%number(inputs%oil%specific_heat, 'specific_heat', 1.0_wp, 1e6_wp, 'J/(kg K)', 'specific heat')
      call v%number(inputs%oil%conductivity, 'conductivity', 0.0_wp, 1e3_wp, 'W/(m K)', 'thermal conductivity')
      call v%number(inputs%oil%supply_temperature, 'supply_temperature', low, high, 'C', &
         & 'temperature of the fresh oil; of all oil where there is no heat balance')
      call v%number(inputs%oil%carry_over, 'carry_over', 0.0_wp, 1.0_wp, '1', &
         & 'part of the oil leaving a pad that enters the next one')
      call v%number(inputs%oil%widest_gap_deg, 'widest_gap_deg', 0.0_wp, 360.0_wp, 'deg', &
         & 'widest gap between two pads that oil is carried across; beyond it a pad draws fresh oil')
      call v%number(inputs%oil%shaft_nusselt, 'shaft_nusselt', 0.0_wp, 1e3_wp, '1', &
         & 'Nusselt number of the exchange of heat between film and shaft; 0: none')
      call v%number(inputs%oil%shaft_temperature, 'shaft_temperature', low, high, 'C', &
         & 'temperature of the shaft; if left out, that at which it takes no heat on the whole')
      call v%number(inputs%oil%groove_volume, 'groove_volume', 0.0_wp, 1.0_wp, 'm^3', &
         & 'oil between two pads, for thermal%march = groove')

      call v%group('thermal', 'Heat balance of the oil')
      call v%word(inputs%thermal%model, 'model', 'none pad', &
         & 'none: all oil has supply_temperature; pad: a temperature and a viscosity for each pad')
      call v%word(inputs%thermal%march, 'march', 'frozen groove', &
         & 'in a march; frozen: temperatures of the equilibrium; groove: the oil between the pads warms and cools')

      call v%group('pads', &
         & 'The bearing has one pad for each pivot angle; other variables take one value for all pads or one for each')
      call v%list(inputs%pads%pivot_angle_deg, max_pads, 'pivot_angle_deg', -360.0_wp, 360.0_wp, 'deg', &
         & 'angle theta of each pivot, from +z towards +y')
      call v%per_pad(inputs%pads%arc_deg, 'arc_deg', 0.1_wp, 360.0_wp, 'deg', &
         & 'arc theta_1 + theta_2; at most 350 for pads that tilt')
      call v%per_pad(inputs%pads%pivot_ratio, 'pivot_ratio', 0.01_wp, 0.99_wp, '1', &
         & 'offset: position of the pivot from the leading edge, theta_1 over the arc')
      call v%per_pad(inputs%pads%pivot_distance, 'pivot_distance', 1e-6_wp, 1.0_wp, 'm', &
         & 'radial distance kappa from the pad''s bore to the pivot')
      call v%per_pad(inputs%pads%mass, 'mass', mass_range(1), mass_range(2), 'kg', &
         & 'pad mass; *Pads* above says what it is if it is not given')
      call v%per_pad(inputs%pads%inertia, 'inertia', inertia_range(1), inertia_range(2), 'kg m^2', &
         & 'moment of inertia about the pivot; likewise')
      call v%per_pad(inputs%pads%centre_tangential, 'centre_tangential', centre_range(1), centre_range(2), 'm', &
         & 'position C_xi of the centre of gravity from the pivot, along the pad; likewise')
      call v%per_pad(inputs%pads%centre_radial, 'centre_radial', centre_range(1), centre_range(2), 'm', &
         & 'position C_eta of the centre of gravity from the pivot, outward; likewise')
      call v%per_pad(inputs%pads%density, 'density', 1.0_wp, 1e5_wp, 'kg/m^3', &
         & 'instead of mass: density of the pad; steel, 7850, where it is needed and not given')
      call v%per_pad(inputs%pads%thickness, 'thickness', 1e-6_wp, 1.0_wp, 'm', &
         & 'radial thickness of the pad, for mass, inertia and centre of gravity; pivot_distance where it is needed ' &
         & //'and not given')
      call v%word(inputs%pads%motion, 'motion', 'tilting_radial tilting_only fixed', &
         & 'tilting_radial: the pads tilt and move radially on their pivots; tilting_only: they only tilt; fixed: ' &
         & //'neither, lobes of a plain bearing')

      call v%group('pivot', 'Ball-and-socket contact')
      call v%word(inputs%pivot%law, 'law', 'fang hertz', 'fang: conformal contact (11)-(18); hertz: law of Hertz')
      call v%number(inputs%pivot%socket_radius, 'socket_radius', 1e-5_wp, 10.0_wp, 'm', 'radius R_2 of the socket')
      call v%number(inputs%pivot%radius_difference, 'radius_difference', 0.0_wp, 1.0_wp, 'm', &
         & 'dR = R_2 - R_1, R_1 being the radius of the ball')
      call v%numbers(inputs%pivot%young_modulus, 'young_modulus', 1e6_wp, 1e14_wp, 'Pa', 'values of ball and socket')
      call v%numbers(inputs%pivot%poisson_ratio, 'poisson_ratio', -0.99_wp, 0.5_wp, '1', 'values of ball and socket')
      call v%number(inputs%pivot%deflection_factor, 'deflection_factor', 0.1_wp, 100.0_wp, '1', &
         & 'factor of eq (13): 4 as printed; 2 pi agrees with Hertz''s law')

      call v%group('friction', 'Friction in the pivots')
      call v%word(inputs%friction%model, 'model', 'none bengisu_akay lugre', &
         & 'none; bengisu_akay: eq (22); lugre: eqs (23)-(25)')
      call v%number(inputs%friction%static_coefficient, 'static_coefficient', 1e-6_wp, 10.0_wp, '1', &
         & 'static friction coefficient f_s')
      call v%number(inputs%friction%dynamic_coefficient, 'dynamic_coefficient', 0.0_wp, 10.0_wp, '1', &
         & 'dynamic friction coefficient f_d <= f_s')
      call v%number(inputs%friction%critical_velocity, 'critical_velocity', 1e-12_wp, 10.0_wp, 'm/s', &
         & 'Bengisu-Akay: critical velocity v_c')
      call v%number(inputs%friction%decay, 'decay', 0.0_wp, 1e9_wp, 's/m', &
         & 'Bengisu-Akay: decay chi of the Stribeck curve')
      call v%number(inputs%friction%stribeck_velocity, 'stribeck_velocity', 1e-9_wp, 1e3_wp, 'm/s', &
         & 'LuGre: Stribeck velocity v_s')
      call v%number(inputs%friction%stribeck_exponent, 'stribeck_exponent', 0.1_wp, 10.0_wp, '1', &
         & 'LuGre: Stribeck exponent gamma')
      call v%number(inputs%friction%bristle_stiffness, 'bristle_stiffness', 1.0_wp, 1e12_wp, '1/m', &
         & 'LuGre: bristle stiffness sigma_0')
      call v%number(inputs%friction%bristle_damping, 'bristle_damping', 0.0_wp, 1e6_wp, 's/m', &
         & 'LuGre: bristle damping sigma_1; if left out, that of eq (28)')
      call v%number(inputs%friction%viscous_coefficient, 'viscous_coefficient', 0.0_wp, 1e6_wp, 's/m', &
         & 'LuGre: viscous coefficient sigma_2')
      call v%number(inputs%friction%characteristic_load, 'characteristic_load', 1e-6_wp, 1e12_wp, 'N', &
         & 'LuGre: characteristic load N_m of eq (28)')

      call v%group('asperity', 'Contact of pad and journal where the film is thinner than 4 times their roughness')
      call v%word(inputs%asperity%model, 'model', 'greenwood_tripp none', &
         & 'greenwood_tripp: pressure of the asperities; none: a film that closes ends the run')
      call v%number(inputs%asperity%roughness, 'roughness', 1e-9_wp, 1e-3_wp, 'm', &
         & 'combined rms roughness sigma, the root of the sum of the squares of both; 0.5 um: ground or fine turned')
      call v%number(inputs%asperity%elastic_modulus, 'elastic_modulus', 1e5_wp, 1e14_wp, 'Pa', &
         & 'composite modulus E'', 1/E'' = (1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2; 47 GPa: steel on white metal (210 ' &
         & //'and 52 GPa)')
      call v%number(inputs%asperity%factor, 'factor', 1e-9_wp, 1.0_wp, '1', &
         & 'K'' = 16 sqrt(2) pi/15 (sigma beta eta)^2 (sigma/beta)^0.5; 0.003: upper end of the usual 0.0003 to 0.003')
      call v%number(inputs%asperity%friction_coefficient, 'friction_coefficient', 0.0_wp, 10.0_wp, '1', &
         & 'boundary friction of touching asperities; 0.1: usual for oiled metals')

      call v%group('start', &
         & 'Where a march starts; the values of journal and pads are added, as a disturbance; a resumed run does ' &
         & //'not start again')
      call v%word(inputs%start%from, 'from', 'equilibrium partial centred given file', &
         & 'equilibrium: of the initial speed, at rest; partial: the same, but pads without equilibrium stand on ' &
         & //'their pivots without tilt; centred: journal in the middle, pads at rest on their pivots without tilt; ' &
         & //'given: only the values of journal and pads below; file: the end of another result')
      call v%word(inputs%start%file, 'file', '', &
         & 'file: the result file, with the same pads; its last whole turn of the shaft is taken')
      call v%numbers(inputs%start%journal, 'journal', -0.1_wp, 0.1_wp, 'm', 'displacement of the journal along y and z')
      call v%numbers(inputs%start%journal_velocity, 'journal_velocity', -1e3_wp, 1e3_wp, 'm/s', &
         & 'velocity of the journal along y and z')
      call v%per_pad(inputs%start%pad_tilt, 'pad_tilt', -3.0_wp, 3.0_wp, 'rad', 'tilts of the pads')
      call v%per_pad(inputs%start%pad_tilt_rate, 'pad_tilt_rate', -1e5_wp, 1e5_wp, 'rad/s', 'their rates')
      call v%per_pad(inputs%start%pivot_deflection, 'pivot_deflection', -0.1_wp, 0.1_wp, 'm', &
         & 'tilting_radial: deflections of the pivots')
      call v%per_pad(inputs%start%pivot_deflection_rate, 'pivot_deflection_rate', -1e3_wp, 1e3_wp, 'm/s', &
         & 'tilting_radial: their rates')

      call v%group('film', 'Solver of the Reynolds equation')
      call v%word(inputs%film%solver, 'solver', 'auto direct fourier sor', &
         & 'auto: tables of converged films, direct where there is none; direct: axial modes, finite volumes where ' &
         & //'a film cavitates; fourier: axial Fourier expansion; sor: over-relaxation')
      call v%whole(inputs%film%circumferential_cells, 'circumferential_cells', 0.0_wp, 2000.0_wp, &
         & 'direct, fourier, sor: cells along the arc, an even number; 0: as many as axial modes need, 80 where a ' &
         & //'film cavitates, 60 for sor, twice or three times as many from 180 or 300 degrees on')
      call v%whole(inputs%film%axial_cells, 'axial_cells', 0.0_wp, 1000.0_wp, &
         & 'direct, sor: cells along half the width, at least 2; 0: 8, or 15 for sor')
      call v%whole(inputs%film%axial_modes, 'axial_modes', 0.0_wp, 200.0_wp, &
         & 'direct, fourier: maximum number of axial modes; the closed form takes those that are too stiff for the ' &
         & //'cells; 0: automatic')
      call v%number(inputs%film%relaxation, 'relaxation', 0.0_wp, 1.999_wp, '1', &
         & 'sor: relaxation factor; 0: the optimum for the grid')
      call v%number(inputs%film%tolerance, 'tolerance', 1e-13_wp, 1e-2_wp, '1', &
         & 'sor: limit of residual over source; at most a thousandth of relative_tolerance is used')
      call v%whole(inputs%film%max_sweeps, 'max_sweeps', 1.0_wp, 1e8_wp, &
         & 'sor: maximum number of sweeps for a film; more is a failure')
      call v%number(inputs%film%table_tolerance, 'table_tolerance', 0.0_wp, 1e-2_wp, '1', &
         & 'auto: usual error of forces from tables, over the force itself; 0: ' &
         & //'relative_tolerance, with reynolds 4 times as much; cavitated films keep to 4e-7 at best')
      call v%word(inputs%film%cavitation, 'cavitation', 'reynolds gumbel none', &
         & 'reynolds: p >= p_cav in the solution; gumbel: clipped after the solution; none: no cavitation')

      call v%group('integration', 'Integration in time by CVODE')
      call v%number(inputs%integration%relative_tolerance, 'relative_tolerance', 1e-13_wp, 1e-2_wp, '1', &
         & 'relative tolerance of every state')
      call v%number(inputs%integration%tolerance_scale, 'tolerance_scale', 1e-6_wp, 1e6_wp, '1', &
         & 'factor of the absolute tolerances: each is relative_tolerance times this times the scale of its state')
      call v%number(inputs%integration%max_step, 'max_step', 0.0_wp, 1e6_wp, 's', 'maximum step; 0: no limit')
      call v%whole(inputs%integration%max_steps, 'max_steps', 1.0_wp, 2e9_wp, &
         & 'maximum number of steps of the march; more is a failure')
      call v%number(inputs%integration%stop_when_periodic, 'stop_when_periodic', 0.0_wp, 1.0_wp, '1', &
         & '> 0: the run ends when the samples repeat from one revolution to the next within this part of the ' &
         & //'bearing clearance (journal) and of the clearance over the pad''s length (tilts)')

      call v%group('output', 'Contents of the result file')
      call v%whole(inputs%output%samples_per_revolution, 'samples_per_revolution', 1.0_wp, 1e6_wp, &
         & 'samples per revolution at the maximum speed of the run')
      call v%number(inputs%output%start_time, 'start_time', 0.0_wp, 1e6_wp, 's', 'time of the first sample')
      call v%whole(inputs%output%spectrum_revolutions, 'spectrum_revolutions', 1.0_wp, 1e6_wp, &
         & 'number of revolutions at the end of the run that the spectra cover, where there are samples')
      call v%number(inputs%output%checkpoint_seconds, 'checkpoint_seconds', 0.0_wp, 1e9_wp, 's', &
         & 'wall time between checkpoints, from which --resume continues; 0: only when a signal stops the run')
      call v%word(inputs%output%keep, 'keep', 'all last_revolutions summary', &
         & 'samples in the results: all, those of the last spectrum_revolutions, or none; with summary a run of a ' &
         & //'study has no file but a row of the study; if left out, summary for the tasks equilibrium and ' &
         & //'coefficients, else all')

      call v%group('coefficients', 'Stiffness, damping and stability, for the task coefficients')
      call v%list(inputs%coefficients%frequency_ratio, most_ratios, 'frequency_ratio', 0.0_wp, 1e6_wp, '1', &
         & 'whirl frequencies over the speed of the shaft, of the coefficients of the journal')
      call v%number(inputs%coefficients%threshold_up_to_rpm, 'threshold_up_to_rpm', 0.0_wp, 1e6_wp, 'rpm', &
         & '> 0: the speed at which stability is lost is sought from speed_rpm up to this one')
      call v%number(inputs%coefficients%cross_stiffness, 'cross_stiffness', -1e15_wp, 1e15_wp, 'N/m', &
         & 'Q: cross-coupled stiffness at the journal beside the bearing''s, for the modes; > 0 drives forward whirl')

      call v%group('periodic', 'A periodic orbit and its stability, for the tasks periodic and branch')
      call v%whole(inputs%periodic%revolutions, 'revolutions', 1.0_wp, 1000.0_wp, &
         & 'revolutions of the shaft in a period')
      call v%number(inputs%periodic%tolerance, 'tolerance', 1e-12_wp, 1e-2_wp, '1', &
         & 'how far from the orbit Newton''s method may end, over the characteristic scale of each state')
      call v%whole(inputs%periodic%max_iterations, 'max_iterations', 1.0_wp, 1e6_wp, &
         & 'maximum number of iterations of Newton''s method; more is a failure')

      call v%group('branch', 'Equilibria or periodic orbits over a number of the input, for the task branch')
      call v%word(inputs%branch%of, 'of', 'periodic equilibrium', &
         & 'periodic: orbits, as the task periodic finds them; equilibrium: equilibria without friction in the pivots')
      call v%word(inputs%branch%parameter, 'parameter', '', &
         & 'the number that changes, from the value that the case gives it: ''operation%speed_rpm''; with an ' &
         & //'element where there are several, ''rotor%static_load(1)''; of values of the pads all without one. ' &
         & //'Numbers of rotor, operation, bearing, oil, pads, pivot, friction and asperity')
      call v%number(inputs%branch%last, 'last', -1e15_wp, 1e15_wp, '', &
         & 'its value where the branch ends; it also ends where it comes back to the first value')
      call v%number(inputs%branch%step, 'step', -1e15_wp, 1e15_wp, '', &
         & 'its first change; later steps are as long as the iteration allows')
      call v%number(inputs%branch%max_step, 'max_step', 0.0_wp, 1e15_wp, '', &
         & 'its largest change from point to point; 0: ten times the first')
      call v%whole(inputs%branch%max_points, 'max_points', 2.0_wp, 1e5_wp, 'maximum number of points of a branch')
      call v%flag(inputs%branch%switch, 'switch', &
         & 'periodic: whether the orbits of double period are followed, too, where the period doubles')
   end subroutine go_along
end module case_fields
