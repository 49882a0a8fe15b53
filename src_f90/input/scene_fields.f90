!> The one list of all input variables: name, place in the scene, what is allowed, unit and meaning.
!> Reading, writing and the input reference all walk along it with a visitor of their own.
module scene_fields
   use kinds, only: wp
   use text, only: to_text
   use scene, only: scene_type
   implicit none (type, external)
   private
   public :: field_visitor, range_type, visit_scene

   !> Allowed values of a number.
   type :: range_type
      real(wp) :: low = -huge(1.0_wp), high = huge(1.0_wp)
   contains
      procedure :: allows
      procedure :: text => range_text
   end type range_type

   type, abstract :: field_visitor
   contains
      !> The next group.
      procedure(visit_group), deferred :: group
      !> A word out of `choices` (separated by blanks), or any text where there are none.
      procedure(visit_word), deferred :: word
      procedure(visit_whole), deferred :: whole
      !> A fixed number of reals.
      procedure(visit_numbers), deferred :: numbers
      !> One real a pad; `fixes_pads` for the list whose length is the number of pads.
      procedure(visit_per_pad), deferred :: per_pad
      !> One real.
      procedure, non_overridable :: number
   end type field_visitor

   abstract interface
      subroutine visit_group(self, name, meaning)
         import :: field_visitor
         class(field_visitor), intent(inout) :: self
         character(len=*), intent(in) :: name, meaning
      end subroutine visit_group

      subroutine visit_word(self, name, value, choices, meaning)
         import :: field_visitor
         class(field_visitor), intent(inout) :: self
         character(len=*), intent(in) :: name, choices, meaning
         character(len=:), allocatable, intent(inout) :: value
      end subroutine visit_word

      subroutine visit_whole(self, name, value, allowed, meaning)
         import :: field_visitor, range_type
         class(field_visitor), intent(inout) :: self
         character(len=*), intent(in) :: name, meaning
         integer, intent(inout) :: value
         type(range_type), intent(in) :: allowed
      end subroutine visit_whole

      subroutine visit_numbers(self, name, values, allowed, unit, meaning)
         import :: field_visitor, range_type, wp
         class(field_visitor), intent(inout) :: self
         character(len=*), intent(in) :: name, unit, meaning
         real(wp), intent(inout) :: values(:)
         type(range_type), intent(in) :: allowed
      end subroutine visit_numbers

      subroutine visit_per_pad(self, name, values, fixes_pads, allowed, unit, meaning)
         import :: field_visitor, range_type, wp
         class(field_visitor), intent(inout) :: self
         character(len=*), intent(in) :: name, unit, meaning
         real(wp), allocatable, intent(inout) :: values(:)
         logical, intent(in) :: fixes_pads
         type(range_type), intent(in) :: allowed
      end subroutine visit_per_pad
   end interface

contains

   !> Shows every input variable of the scene to the visitor, in the order of the input reference.
   subroutine visit_scene(scene, v)
      type(scene_type), intent(inout) :: scene
      class(field_visitor), intent(inout) :: v
      associate (c => scene%about, r => scene%rotor, o => scene%operation, b => scene%bearing, p => scene%pads)
         call v%group('case', 'What the run is')
         call v%word('title', c%title, '', 'free text, kept in the result file')
         call v%word('task', c%task, 'march equilibrium', 'march in time, or stop at the static equilibrium')

         call v%group('rotor', 'The rotor''s share on this bearing, and what loads it')
         call v%number('mass', r%mass, between(1e-6_wp, 1e9_wp), 'kg', 'mass m_J carried by the bearing')
         call v%number('unbalance', r%unbalance, between(0.0_wp, 1e6_wp), 'kg m', 'unbalance dmE')
         call v%number('balance_grade', r%balance_grade, between(-1.0_wp, 1e5_wp), 'mm/s', &
            & 'ISO 21940-11 grade G; > 0 replaces unbalance by eq (26)')
         call v%number('balance_speed_rpm', r%balance_speed_rpm, between(-1.0_wp, 1e6_wp), 'rpm', &
            & 'speed of eq (26); < 0: the highest of the run')
         call v%number('gravity', r%gravity, between(0.0_wp, 1e3_wp), 'm/s^2', 'acceleration towards -y')
         call v%numbers('static_load', r%static_load, between(-1e12_wp, 1e12_wp), 'N', &
            & 'extra force on the journal along y and z')

         call v%group('operation', 'Speed and time')
         call v%number('speed_rpm', o%speed_rpm, between(1e-3_wp, 1e6_wp), 'rpm', 'shaft speed at the start')
         call v%number('final_speed_rpm', o%final_speed_rpm, between(-1.0_wp, 1e6_wp), 'rpm', &
            & 'shaft speed at the end, linear in between; < 0: as speed_rpm')
         call v%number('duration', o%duration, between(1e-9_wp, 1e6_wp), 's', 'simulated time')

         call v%group('bearing', 'Geometry, oil and boundary pressures')
         call v%number('journal_radius', b%journal_radius, between(1e-4_wp, 10.0_wp), 'm', 'R_J')
         call v%number('machined_clearance', b%machined_clearance, between(1e-9_wp, 0.1_wp), 'm', &
            & 'radial clearance c_m between pad bore and journal')
         call v%number('assembled_clearance', b%assembled_clearance, between(1e-9_wp, 0.1_wp), 'm', &
            & 'radial clearance c_r at the pivots')
         call v%number('axial_length', b%axial_length, between(1e-5_wp, 100.0_wp), 'm', 'pad length L along the shaft')
         call v%number('viscosity', b%viscosity, between(1e-6_wp, 10.0_wp), 'Pa s', 'dynamic viscosity of the oil')
         call v%number('supply_pressure', b%supply_pressure, between(-1e9_wp, 1e9_wp), 'Pa', &
            & 'pressure at the leading edges')
         call v%number('ambient_pressure', b%ambient_pressure, between(-1e9_wp, 1e9_wp), 'Pa', &
            & 'pressure at the other edges')
         call v%number('cavitation_pressure', b%cavitation_pressure, between(-1e9_wp, 1e9_wp), 'Pa', &
            & 'pressure at which the film ruptures')

         call v%group('pads', 'As many pads as pivot angles; other variables: one value for all pads or one each')
         call v%per_pad('pivot_angle_deg', p%pivot_angle_deg, .true., between(-360.0_wp, 360.0_wp), 'deg', &
            & 'angle theta of each pivot, from +z towards +y')
         call v%per_pad('arc_deg', p%arc_deg, .false., between(0.1_wp, 350.0_wp), 'deg', 'arc theta_1 + theta_2')
         call v%per_pad('pivot_ratio', p%pivot_ratio, .false., between(0.01_wp, 0.99_wp), '1', &
            & 'theta_1 over the arc: where the pivot stands, from the leading edge')
         call v%per_pad('pivot_distance', p%pivot_distance, .false., between(1e-6_wp, 1.0_wp), 'm', &
            & 'kappa, from the pad''s bore out to the pivot')
         call v%per_pad('mass', p%mass, .false., between(1e-9_wp, 1e6_wp), 'kg', 'pad mass')
         call v%per_pad('inertia', p%inertia, .false., between(1e-15_wp, 1e6_wp), 'kg m^2', &
            & 'moment of inertia about the pivot')
         call v%per_pad('centre_tangential', p%centre_tangential, .false., between(-1.0_wp, 1.0_wp), 'm', &
            & 'centre of gravity C_xi from the pivot, along the pad')
         call v%per_pad('centre_radial', p%centre_radial, .false., between(-1.0_wp, 1.0_wp), 'm', &
            & 'centre of gravity C_eta from the pivot, outward')
         call v%word('motion', p%motion, 'tilting_radial tilting_only', &
            & 'pads tilt and move radially on their pivots, or tilt only')
      end associate
      associate (p => scene%pivot, f => scene%friction, m => scene%film, i => scene%integration, o => scene%output)
         call v%group('pivot', 'Ball-and-socket contact')
         call v%word('law', p%law, 'fang hertz', 'conformal contact (11)-(18), or Hertz')
         call v%number('socket_radius', p%socket_radius, between(1e-5_wp, 10.0_wp), 'm', 'R_2')
         call v%number('radius_difference', p%radius_difference, between(0.0_wp, 1.0_wp), 'm', 'dR = R_2 - R_1')
         call v%numbers('young_modulus', p%young_modulus, between(1e6_wp, 1e14_wp), 'Pa', 'of ball and socket')
         call v%numbers('poisson_ratio', p%poisson_ratio, between(-0.99_wp, 0.5_wp), '1', 'of ball and socket')
         call v%number('penetration_factor', p%penetration_factor, between(0.1_wp, 100.0_wp), '1', &
            & 'factor of eq (13): 4 as printed; 2 pi meets Hertz''s approach')

         call v%group('friction', 'Friction in the pivots')
         call v%word('model', f%model, 'none bengisu_akay lugre', 'none, eq (22), or eqs (23)-(25)')
         call v%number('static_coefficient', f%static_coefficient, between(1e-6_wp, 10.0_wp), '1', 'f_s')
         call v%number('dynamic_coefficient', f%dynamic_coefficient, between(0.0_wp, 10.0_wp), '1', 'f_d <= f_s')
         call v%number('critical_velocity', f%critical_velocity, between(1e-12_wp, 10.0_wp), 'm/s', 'Bengisu-Akay: v_c')
         call v%number('decay', f%decay, between(0.0_wp, 1e9_wp), 's/m', 'Bengisu-Akay: chi')
         call v%number('stribeck_velocity', f%stribeck_velocity, between(1e-9_wp, 1e3_wp), 'm/s', 'LuGre: v_s')
         call v%number('stribeck_exponent', f%stribeck_exponent, between(0.1_wp, 10.0_wp), '1', 'LuGre: gamma')
         call v%number('bristle_stiffness', f%bristle_stiffness, between(1.0_wp, 1e12_wp), '1/m', 'LuGre: sigma_0')
         call v%number('bristle_damping', f%bristle_damping, between(-1.0_wp, 1e6_wp), 's/m', &
            & 'LuGre: sigma_1; < 0: eq (28)')
         call v%number('viscous_coefficient', f%viscous_coefficient, between(0.0_wp, 1e6_wp), 's/m', 'LuGre: sigma_2')
         call v%number('characteristic_load', f%characteristic_load, between(1e-6_wp, 1e12_wp), 'N', 'N_m of eq (28)')

         call v%group('film', 'How the Reynolds equation is solved')
         call v%word('solver', m%solver, 'auto modal sor', &
            & 'axial modes, and finite volumes where a film ruptures; axial modes; over-relaxation')
         call v%whole('circumferential_cells', m%circumferential_cells, between(0.0_wp, 2000.0_wp), &
            & 'cells along the arc, even; 0: enough for axial modes, 80 where a film ruptures, 60 for sor')
         call v%whole('axial_cells', m%axial_cells, between(0.0_wp, 1000.0_wp), &
            & 'finite volumes: cells along half the width, 2 or more; 0: 8, 15 for sor')
         call v%whole('axial_modes', m%axial_modes, between(0.0_wp, 200.0_wp), &
            & 'most modes across the width; those too stiff for the cells go into the closed form; 0: enough')
         call v%number('relaxation', m%relaxation, between(0.0_wp, 1.999_wp), '1', &
            & 'sor: relaxation factor; 0: the optimum of the grid')
         call v%number('tolerance', m%tolerance, between(1e-13_wp, 1e-2_wp), '1', &
            & 'sor: residual over source; at most a tenth of relative_tolerance is taken')
         call v%whole('max_sweeps', m%max_sweeps, between(1.0_wp, 1e8_wp), 'sor: sweeps after which a film is given up')
         call v%word('cavitation', m%cavitation, 'reynolds gumbel none', &
            & 'p >= p_cav in the solution, clipped after it, or not at all')

         call v%group('integration', 'CVODE')
         call v%number('relative_tolerance', i%relative_tolerance, between(1e-13_wp, 1e-2_wp), '1', &
            & 'relative tolerance of every state')
         call v%number('tolerance_scale', i%tolerance_scale, between(1e-6_wp, 1e6_wp), '1', &
            & 'absolute tolerances: relative_tolerance times this times each state''s own scale')
         call v%number('max_step', i%max_step, between(0.0_wp, 1e6_wp), 's', 'longest step; 0: no limit')
         call v%whole('max_steps', i%max_steps, between(1.0_wp, 2e9_wp), 'steps after which the march is given up')
         call v%number('stop_when_periodic', i%stop_when_periodic, between(0.0_wp, 1.0_wp), '1', &
            & '> 0: end once journal and tilts, sampled, repeat from one revolution to the next within this part of ' &
            & //'the assembled clearance (tilts: at the pad''s length)')

         call v%group('output', 'What is kept')
         call v%whole('samples_per_revolution', o%samples_per_revolution, between(1.0_wp, 1e6_wp), &
            & 'samples in a revolution at the highest speed of the run')
         call v%number('start_time', o%start_time, between(0.0_wp, 1e6_wp), 's', 'first sample')
         call v%whole('spectrum_revolutions', o%spectrum_revolutions, between(1.0_wp, 1e6_wp), &
            & 'revolutions at the end that the spectra cover, as far as they were sampled')
         call v%number('checkpoint_seconds', o%checkpoint_seconds, between(0.0_wp, 1e9_wp), 's', &
            & 'wall time between checkpoints, from which --resume goes on; 0: only when a signal stops the run')
      end associate

   contains
      type(range_type) function between(low, high)
         real(wp), intent(in) :: low, high
         between = range_type(low, high)
      end function between
   end subroutine visit_scene

   subroutine number(self, name, value, allowed, unit, meaning)
      class(field_visitor), intent(inout) :: self
      character(len=*), intent(in) :: name, unit, meaning
      real(wp), intent(inout) :: value
      type(range_type), intent(in) :: allowed
      real(wp) :: values(1)
      values = value
      call self%numbers(name, values, allowed, unit, meaning)
      value = values(1)
   end subroutine number

   pure logical function allows(self, x)
      class(range_type), intent(in) :: self
      real(wp), intent(in) :: x
      allows = x >= self%low .and. x <= self%high
   end function allows

   !> "0 to 1".
   pure function range_text(self) result(string)
      class(range_type), intent(in) :: self
      character(len=:), allocatable :: string
      string = to_text(self%low)//' to '//to_text(self%high)
   end function range_text
end module scene_fields
