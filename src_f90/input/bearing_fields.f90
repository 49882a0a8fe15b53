!> The input variables of one bearing, each group a procedure: of the one bearing of a case, or of each bearing of a
!> machine.
module bearing_fields
   use kinds, only: wp
   use variable_table, only: variable_table_type
   use case_groups, only: bearing_type, oil_type, pads_type, pivot_type, friction_type, asperity_type, film_type, &
      & max_pads, mass_range, inertia_range, centre_range, temperature_range, viscosity_range
   implicit none (type, external)
   private
   public :: list_bearing, list_oil, list_contacts, list_film

contains

   !> Geometry of a bearing, its oil where the law is constant, and its boundary pressures.
   subroutine list_bearing(bearing, v)
      type(bearing_type), intent(inout) :: bearing
      type(variable_table_type), intent(inout) :: v
      call v%group('bearing', 'Geometry, oil and boundary pressures')
      call v%number(bearing%journal_radius, 'journal_radius', 1e-4_wp, 10.0_wp, 'm', 'radius R_J of the journal')
      call v%each(bearing%machined_clearance, 'pads', 'machined_clearance', 1e-9_wp, 0.1_wp, 'm', &
         & 'radial clearance c_m between pad bore and journal')
      call v%each(bearing%assembled_clearance, 'pads', 'assembled_clearance', 1e-9_wp, 0.1_wp, 'm', &
         & 'radial clearance c_r at the pivots; where pads differ, the smallest is that of the bearing')
      call v%each(bearing%preload, 'pads', 'preload', -1.0_wp, 0.999_wp, '1', &
         & 'instead of machined_clearance: preload m of the pads, c_m = c_r/(1 - m)')
      call v%each(bearing%axial_length, 'pads', 'axial_length', 1e-5_wp, 100.0_wp, 'm', &
         & 'pad length L along the shaft')
      call v%number(bearing%viscosity, 'viscosity', viscosity_range(1), viscosity_range(2), 'Pa s', &
         & 'dynamic viscosity of the oil where oil%law is constant')
      call v%number(bearing%clearance_temperature, 'clearance_temperature', temperature_range(1), &
         & temperature_range(2), 'C', 'temperature at which the clearances were measured: shaft, pads and housing ' &
         & //'expand from there; if left out, the clearances are those in operation')
      call v%number(bearing%shaft_expansion, 'shaft_expansion', 0.0_wp, 1e-3_wp, '1/K', &
         & 'linear expansion of the shaft, which has oil%shaft_temperature or, if that is left out, the temperature ' &
         & //'of the solution; 11e-6: steel')
      call v%number(bearing%housing_expansion, 'housing_expansion', 0.0_wp, 1e-3_wp, '1/K', &
         & 'linear expansion of the housing')
      call v%number(bearing%housing_temperature, 'housing_temperature', temperature_range(1), &
         & temperature_range(2), 'C', 'temperature of the housing; if left out, oil%supply_temperature')
      call v%number(bearing%supply_pressure, 'supply_pressure', -1e9_wp, 1e9_wp, 'Pa', &
         & 'pressure at the leading edges')
      call v%number(bearing%ambient_pressure, 'ambient_pressure', -1e9_wp, 1e9_wp, 'Pa', &
         & 'pressure at the other edges')
      call v%number(bearing%cavitation_pressure, 'cavitation_pressure', -1e9_wp, 1e9_wp, 'Pa', &
         & 'pressure at which the film cavitates')
   end subroutine list_bearing

   !> The oil of a bearing.
   subroutine list_oil(oil, v)
      type(oil_type), intent(inout) :: oil
      type(variable_table_type), intent(inout) :: v
      real(wp), parameter :: low = temperature_range(1), high = temperature_range(2)
      call v%group('oil', &
         & 'Viscosity over temperature, and what heats the oil by how much; *Oil* above says which viscosity holds')
      call v%word(oil%law, 'law', 'constant exponential walther', &
         & 'constant: bearing%viscosity; exponential, walther: over the temperature; if left out, the law whose ' &
         & //'numbers are given')
      call v%number(oil%grade, 'grade', 0.0_wp, 3200.0_wp, '1', &
         & 'walther: ISO viscosity grade, 10 15 22 32 46 68 100 150 220 320 460 680 1000 1500 2200 3200, with ' &
         & //'viscosity index 100; if left out or 0, kinematic_viscosity is given', whole=.true.)
      call v%numbers(oil%kinematic_viscosity, 'kinematic_viscosity', 5e-7_wp, 1.0_wp, 'm^2/s', &
         & 'walther: kinematic viscosities at at_temperature')
      call v%numbers(oil%at_temperature, 'at_temperature', low, high, 'C', &
         & 'walther: the lower and the higher temperature of kinematic_viscosity')
      call v%number(oil%density_at_15, 'density_at_15', 100.0_wp, 1e5_wp, 'kg/m^3', &
         & 'walther: density at 15 C, which makes the kinematic viscosity a dynamic one; density if left out')
      call v%number(oil%density_slope, 'density_slope', -10.0_wp, 0.0_wp, 'kg/(m^3 K)', &
         & 'walther: change of this density with the temperature')
      call v%number(oil%reference_viscosity, 'reference_viscosity', viscosity_range(1), viscosity_range(2), &
         & 'Pa s', 'exponential: dynamic viscosity at reference_temperature')
      call v%number(oil%reference_temperature, 'reference_temperature', low, high, 'C', &
         & 'exponential: its temperature')
      call v%number(oil%temperature_exponent, 'temperature_exponent', 0.0_wp, 1.0_wp, '1/K', &
         & 'exponential: beta of mu_ref exp(-beta (T - T_ref))')
      call v%number(oil%density, 'density', 100.0_wp, 1e5_wp, 'kg/m^3', 'density of the heat balance, constant')
      call v%number(oil%specific_heat, 'specific_heat', 100.0_wp, 1e6_wp, 'J/(kg K)', 'specific heat')
      call v%number(oil%conductivity, 'conductivity', 0.0_wp, 1e3_wp, 'W/(m K)', 'thermal conductivity')
      call v%number(oil%supply_temperature, 'supply_temperature', low, high, 'C', &
         & 'temperature of the fresh oil; of all oil where there is no heat balance')
      call v%number(oil%carry_over, 'carry_over', 0.0_wp, 1.0_wp, '1', &
         & 'part of the oil leaving a pad that enters the next one')
      call v%number(oil%widest_gap_deg, 'widest_gap_deg', 0.0_wp, 360.0_wp, 'deg', &
         & 'widest gap between two pads that oil is carried across; beyond it a pad draws fresh oil')
      call v%number(oil%shaft_nusselt, 'shaft_nusselt', 0.0_wp, 1e3_wp, '1', &
         & 'Nusselt number of the exchange of heat between film and shaft; 0: none')
      call v%number(oil%shaft_temperature, 'shaft_temperature', low, high, 'C', &
         & 'temperature of the shaft; if left out, that at which it takes no heat on the whole')
      call v%number(oil%groove_volume, 'groove_volume', 0.0_wp, 1.0_wp, 'm^3', &
         & 'oil between two pads, for thermal%march = groove')
      call v%number(oil%back_coefficient, 'back_coefficient', 0.0_wp, 1e6_wp, 'W/(m^2 K)', &
         & 'for thermal%model = film: film coefficient at the back and both ends of the pads')
      call v%number(oil%back_temperature, 'back_temperature', low, high, 'C', &
         & 'likewise: temperature of the oil there; if left out, supply_temperature')
   end subroutine list_oil

   !> Its pads, their pivots and what rubs.
   subroutine list_contacts(bearing, v)
      type(bearing_type), intent(inout) :: bearing
      type(variable_table_type), intent(inout) :: v
      call list_pads(bearing%pads, v)
      call list_pivot(bearing%pivot, v)
      call list_friction(bearing%friction, v)
      call list_asperity(bearing%asperity, v)
   end subroutine list_contacts

   !> The pads of a bearing.
   subroutine list_pads(pads, v)
      type(pads_type), intent(inout) :: pads
      type(variable_table_type), intent(inout) :: v
      call v%group('pads', &
         & 'The bearing has one pad for each pivot angle')
      call v%list(pads%pivot_angle_deg, max_pads, 'pivot_angle_deg', -360.0_wp, 360.0_wp, 'deg', &
         & 'angle theta of each pivot, from +z towards +y', counts='pads')
      call v%each(pads%arc_deg, 'pads', 'arc_deg', 0.1_wp, 360.0_wp, 'deg', &
         & 'arc theta_1 + theta_2; at most 350 for pads that tilt')
      call v%each(pads%pivot_ratio, 'pads', 'pivot_ratio', 0.01_wp, 0.99_wp, '1', &
         & 'offset: position of the pivot from the leading edge, theta_1 over the arc')
      call v%each(pads%pivot_distance, 'pads', 'pivot_distance', 1e-6_wp, 1.0_wp, 'm', &
         & 'radial distance kappa from the pad''s bore to the pivot')
      call v%each(pads%mass, 'pads', 'mass', mass_range(1), mass_range(2), 'kg', &
         & 'pad mass; *Pads* above says what it is if it is not given')
      call v%each(pads%inertia, 'pads', 'inertia', inertia_range(1), inertia_range(2), 'kg m^2', &
         & 'moment of inertia about the pivot; likewise')
      call v%each(pads%centre_tangential, 'pads', 'centre_tangential', centre_range(1), centre_range(2), 'm', &
         & 'position C_xi of the centre of gravity from the pivot, along the pad; likewise')
      call v%each(pads%centre_radial, 'pads', 'centre_radial', centre_range(1), centre_range(2), 'm', &
         & 'position C_eta of the centre of gravity from the pivot, outward; likewise')
      call v%each(pads%density, 'pads', 'density', 1e3_wp, 1e5_wp, 'kg/m^3', &
         & 'instead of mass: density of the pad; steel, 7850, where it is needed and not given')
      call v%each(pads%thickness, 'pads', 'thickness', 1e-6_wp, 1.0_wp, 'm', &
         & 'radial thickness of the pad, for mass, inertia and centre of gravity; pivot_distance where it is needed ' &
         & //'and not given')
      call v%each(pads%conductivity, 'pads', 'conductivity', 1e-3_wp, 1e4_wp, 'W/(m K)', &
         & 'for thermal%model = film: thermal conductivity of the pad, through the thickness pads%thickness, or else ' &
         & //'pivot_distance')
      call v%word(pads%bending, 'bending', 'none elastic thermal both', &
         & 'what bends pads that tilt: none; elastic: the pressure of the films; thermal: the heat that flows ' &
         & //'through them, with thermal%model = film; both; pads are as thick as pads%thickness, or else ' &
         & //'pivot_distance')
      call v%each(pads%young_modulus, 'pads', 'young_modulus', 1e6_wp, 1e13_wp, 'Pa', &
         & 'Young''s modulus of the pad; 210 GPa: steel')
      call v%each(pads%poisson_ratio, 'pads', 'poisson_ratio', 0.0_wp, 0.5_wp, '1', 'its Poisson''s ratio')
      call v%each(pads%expansion, 'pads', 'expansion', 0.0_wp, 1e-3_wp, '1/K', &
         & 'linear expansion of the pad; 11e-6: steel')
      call v%each(pads%temperature, 'pads', 'temperature', temperature_range(1), temperature_range(2), 'C', &
         & 'for bearing%clearance_temperature: mean temperature of the pad; if left out, that of ' &
         & //'thermal%model = film')
      call v%word(pads%motion, 'motion', 'tilting_radial tilting_only fixed', &
         & 'tilting_radial: the pads tilt and move radially on their pivots; tilting_only: they only tilt; fixed: ' &
         & //'neither, lobes of a plain bearing')
   end subroutine list_pads

   !> The pivots of a bearing.
   subroutine list_pivot(pivot, v)
      type(pivot_type), intent(inout) :: pivot
      type(variable_table_type), intent(inout) :: v
      call v%group('pivot', 'Ball-and-socket contact')
      call v%word(pivot%law, 'law', 'fang hertz table', 'fang: conformal contact (11)-(18); hertz: law of Hertz; ' &
         & //'table: as measured, by pivot%file')
      call v%word(pivot%file, 'file', '', 'table: the CSV file whose columns are deflection (m) and force (N)')
      call v%each(pivot%socket_radius, 'pads', 'socket_radius', 1e-5_wp, 10.0_wp, 'm', 'radius R_2 of the socket')
      call v%each(pivot%radius_difference, 'pads', 'radius_difference', 0.0_wp, 1.0_wp, 'm', &
         & 'dR = R_2 - R_1, R_1 being the radius of the ball')
      call v%numbers(pivot%young_modulus, 'young_modulus', 1e6_wp, 1e14_wp, 'Pa', 'values of ball and socket')
      call v%numbers(pivot%poisson_ratio, 'poisson_ratio', -0.99_wp, 0.5_wp, '1', 'values of ball and socket')
      call v%number(pivot%deflection_factor, 'deflection_factor', 0.1_wp, 100.0_wp, '1', &
         & 'factor of eq (13): 4 as printed; 2 pi agrees with Hertz''s law')
      call v%number(pivot%wear_coefficient, 'wear_coefficient', 0.0_wp, 1e-6_wp, 'm^3/(N m)', &
         & 'worn volume over pivot load and distance slid (Archard), for pad_wear_rate; 0: no figures of the wear')
   end subroutine list_pivot

   !> Friction in the pivots of a bearing.
   subroutine list_friction(friction, v)
      type(friction_type), intent(inout) :: friction
      type(variable_table_type), intent(inout) :: v
      call v%group('friction', 'Friction in the pivots')
      call v%word(friction%model, 'model', 'none bengisu_akay lugre', &
         & 'none; bengisu_akay: eq (22); lugre: eqs (23)-(25)')
      call v%each(friction%static_coefficient, 'pads', 'static_coefficient', 1e-6_wp, 10.0_wp, '1', &
         & 'static friction coefficient f_s')
      call v%each(friction%dynamic_coefficient, 'pads', 'dynamic_coefficient', 0.0_wp, 10.0_wp, '1', &
         & 'dynamic friction coefficient f_d <= f_s')
      call v%number(friction%critical_velocity, 'critical_velocity', 1e-12_wp, 10.0_wp, 'm/s', &
         & 'Bengisu-Akay: critical velocity v_c')
      call v%number(friction%decay, 'decay', 0.0_wp, 1e9_wp, 's/m', &
         & 'Bengisu-Akay: decay chi of the Stribeck curve')
      call v%number(friction%stribeck_velocity, 'stribeck_velocity', 1e-9_wp, 1e3_wp, 'm/s', &
         & 'LuGre: Stribeck velocity v_s')
      call v%number(friction%stribeck_exponent, 'stribeck_exponent', 0.1_wp, 10.0_wp, '1', &
         & 'LuGre: Stribeck exponent gamma')
      call v%number(friction%bristle_stiffness, 'bristle_stiffness', 1.0_wp, 1e12_wp, '1/m', &
         & 'LuGre: bristle stiffness sigma_0')
      call v%number(friction%bristle_damping, 'bristle_damping', 0.0_wp, 1e6_wp, 's/m', &
         & 'LuGre: bristle damping sigma_1; if left out, that of eq (28)')
      call v%number(friction%viscous_coefficient, 'viscous_coefficient', 0.0_wp, 1e6_wp, 's/m', &
         & 'LuGre: viscous coefficient sigma_2')
      call v%number(friction%characteristic_load, 'characteristic_load', 1e-6_wp, 1e12_wp, 'N', &
         & 'LuGre: characteristic load N_m of eq (28)')
   end subroutine list_friction

   !> Contact of pads and journal in a bearing.
   subroutine list_asperity(asperity, v)
      type(asperity_type), intent(inout) :: asperity
      type(variable_table_type), intent(inout) :: v
      call v%group('asperity', 'Contact of pad and journal where the film is thinner than 4 times their roughness')
      call v%word(asperity%model, 'model', 'greenwood_tripp none', &
         & 'greenwood_tripp: pressure of the asperities; none: a film that closes ends the run')
      call v%number(asperity%roughness, 'roughness', 1e-9_wp, 1e-3_wp, 'm', &
         & 'combined rms roughness sigma, the root of the sum of the squares of both; 0.5 um: ground or fine turned')
      call v%number(asperity%elastic_modulus, 'elastic_modulus', 1e5_wp, 1e14_wp, 'Pa', &
         & 'composite modulus E'', 1/E'' = (1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2; 47 GPa: steel on white metal (210 ' &
         & //'and 52 GPa)')
      call v%number(asperity%factor, 'factor', 1e-9_wp, 1.0_wp, '1', &
         & 'K'' = 16 sqrt(2) pi/15 (sigma beta eta)^2 (sigma/beta)^0.5; 0.003: upper end of the usual 0.0003 to 0.003')
      call v%number(asperity%friction_coefficient, 'friction_coefficient', 0.0_wp, 10.0_wp, '1', &
         & 'boundary friction of touching asperities; 0.1: usual for oiled metals')
   end subroutine list_asperity

   !> How the films of a bearing are solved.
   subroutine list_film(film, v)
      type(film_type), intent(inout) :: film
      type(variable_table_type), intent(inout) :: v
      call v%group('film', 'Solver of the Reynolds equation')
      call v%word(film%solver, 'solver', 'auto direct fourier sor', &
         & 'auto: tables of converged films, direct where there is none; direct: axial modes, finite volumes where ' &
         & //'a film cavitates; fourier: axial Fourier expansion; sor: over-relaxation')
      call v%whole(film%circumferential_cells, 'circumferential_cells', 0.0_wp, 2000.0_wp, &
         & 'direct, fourier, sor: cells along the arc, an even number; 0: as many as axial modes need, 80 where a ' &
         & //'film cavitates, 60 for sor, twice or three times as many from 180 or 300 degrees on')
      call v%whole(film%axial_cells, 'axial_cells', 0.0_wp, 1000.0_wp, &
         & 'direct, sor: cells along half the width, at least 2; 0: 8, or 15 for sor')
      call v%whole(film%axial_modes, 'axial_modes', 0.0_wp, 200.0_wp, &
         & 'direct, fourier: maximum number of axial modes; the closed form takes those that are too stiff for the ' &
         & //'cells; 0: automatic')
      call v%number(film%relaxation, 'relaxation', 0.0_wp, 1.999_wp, '1', &
         & 'sor: relaxation factor; 0: the optimum for the grid')
      call v%number(film%tolerance, 'tolerance', 1e-13_wp, 1e-2_wp, '1', &
         & 'sor: limit of residual over source; at most a thousandth of relative_tolerance is used')
      call v%whole(film%max_sweeps, 'max_sweeps', 1.0_wp, 1e8_wp, &
         & 'sor: maximum number of sweeps for a film; more is a failure')
      call v%number(film%table_tolerance, 'table_tolerance', 0.0_wp, 1e-2_wp, '1', &
         & 'auto: usual error of forces from tables, over the force itself; 0: ' &
         & //'relative_tolerance, with reynolds 4 times as much; cavitated films keep to 4e-7 at best')
      call v%word(film%cavitation, 'cavitation', 'reynolds gumbel none', &
         & 'reynolds: p >= p_cav in the solution; gumbel: clipped after the solution; none: no cavitation')
   end subroutine list_film
end module bearing_fields
