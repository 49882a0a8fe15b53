!> The list of all input variables: each with its component of the case, name, allowed values, unit and meaning. Groups
!> that a machine has several times have their number or the name of their bearing behind them: disc(2),
!> pads:drive_end (see assignments).
module case_fields
   use kinds, only: wp
   use variable_table, only: variable_table_type
   use machine_fields, only: list_parts, list_linear, list_kind, list_support, list_damper, &
      & list_reduction, list_excitations
   use case_groups, only: bearing_type, damper_type, oil_type, pads_type, pivot_type, friction_type, film_type, &
      & station_element_type, most_ratios, max_pads, mass_range, inertia_range, centre_range, temperature_range, &
      & viscosity_range
   use case_inputs, only: case_type
   use excitations, only: make_excitations
   implicit none (type, external)
   private
   public :: list_variables, put_variables, list_all_variables, change_number
   public :: title_variable, checkpoint_variable, counting_variables

   !> Variables without effect on what is calculated: a study cannot vary the title, and a resumed run may have
   !> another time between checkpoints.
   character(len=*), parameter :: title_variable = 'case%title'
   character(len=*), parameter :: checkpoint_variable = 'output%checkpoint_seconds'
   !> The variables whose lengths are the numbers of pads and of sections.
   character(len=*), parameter :: counting_variables(2) = [character(len=20) :: 'pads%pivot_angle_deg', 'shaft%length']
   !> Allowed temperatures, C, and viscosities, Pa s.
   real(wp), parameter :: low = temperature_range(1), high = temperature_range(2)
   real(wp), parameter :: thinnest = viscosity_range(1), thickest = viscosity_range(2)

contains

   !> The table of a case; with the meanings of its variables where it is to be documented.
   subroutine list_variables(inputs, table, documented)
      type(case_type), intent(in) :: inputs
      type(variable_table_type), intent(out) :: table
      logical, intent(in), optional :: documented
      type(case_type) :: copy
      if (present(documented)) table%documented = documented
      copy = inputs
      call go_along(copy, table, all=.false.)
   end subroutine list_variables

   !> Gives a case the values of the table.
   subroutine put_variables(table, inputs)
      type(variable_table_type), intent(inout) :: table
      type(case_type), intent(inout) :: inputs
      table%filled = .true.
      table%at = 0
      call go_along(inputs, table, all=.false.)
   end subroutine put_variables

   !> Gives the number that a table seeks its new value, if there is one; the table then has what it was.
   subroutine change_number(table, inputs)
      type(variable_table_type), intent(inout) :: table
      type(case_type), intent(inout) :: inputs
      call go_along(inputs, table, all=.false.)
   end subroutine change_number

   !> The variables of all groups that any case has, each group once, with their defaults: those of a rigid journal in
   !> one bearing, and those of a machine; documented.
   subroutine list_all_variables(inputs, table)
      type(case_type), intent(in) :: inputs
      type(variable_table_type), intent(out) :: table
      type(case_type) :: copy
      table%documented = .true.
      copy = inputs
      allocate (copy%rotor%elastic, copy%bearings(1)%support)
      copy%bearings(1)%damper = damper_type(film='pi')
      call copy%rotor%elastic%begin(discs=1, unbalances=1, loads=1, elements=1, impellers=1, &
         & bows=1, lateral=.true.)
      call make_excitations(1, copy%excitations)
      call go_along(copy, table, all=.true.)
   end subroutine list_all_variables

   !> All variables of a case, in the order of the input reference; with an elastic rotor those of the bearings come
   !> last, with the name of each behind that of the group. With `all`, those of a rigid journal and of a machine.
   subroutine go_along(inputs, v, all)
      type(case_type), intent(inout) :: inputs
      type(variable_table_type), intent(inout) :: v
      logical, intent(in) :: all
      !> What stands behind the names of groups.
      character(len=:), allocatable :: ending
      logical :: rigid, machine
      integer :: b
      ! long: the list of all variables, below
      machine = .not. inputs%rotor%is_rigid()
      rigid = all .or. .not. machine
      ending = ''
      call list_rotor()
      call list_excitations(v, inputs%excitations, machine, all)
      if (rigid) call list_bearing(inputs%bearings(1))
      call list_thermal()
      if (rigid) call list_contacts(inputs%bearings(1))
      call list_start()
      if (rigid) call list_held()
      if (rigid) call list_film(inputs%bearings(1)%film)
      call list_march()
      call list_analyses()
      if (.not. machine) return
      call list_parts(v, inputs%rotor%elastic, all)
      if (all) call list_support(v, inputs%bearings(1)%support, ending)
      if (all) call list_damper(v, inputs%bearings(1)%damper, ending)
      call list_reduction(v, inputs%rotor%elastic%reduction)
      do b = 1, merge(0, size(inputs%bearings), all)
         associate (own => inputs%bearings(b))
            ending = own%suffix()
            call list_bearing(own)
            call list_contacts(own)
            call list_film(own%film)
         end associate
      end do
      do b = 1, merge(0, size(inputs%rotor%elastic%linear), all)
         call list_linear(v, inputs%rotor%elastic%linear(b))
      end do
   contains
      subroutine group(name, meaning)
         character(len=*), intent(in) :: name, meaning
         call v%group(name//ending, meaning)
      end subroutine group

      subroutine list_rotor()
         call group('case', 'Title and task of the run')
         call v%word(inputs%about%title, 'title', '', 'free text, which the result file contains')
         call v%word(inputs%about%task, 'task', 'march equilibrium coefficients periodic branch', &
            & 'march: motion over time; equilibrium: only the static equilibrium; coefficients: the same, with ' &
            & //'stiffness, damping and stability there; periodic: the orbit that the motion repeats, and its ' &
            & //'stability; branch: equilibria or such orbits over a number of the input, and where their stability ' &
            & //'changes')
         call group('rotor', 'The part of the rotor that this bearing carries, and its loads')
         if (rigid) then
            call v%number(inputs%rotor%mass, 'mass', 1e-6_wp, 1e9_wp, 'kg', 'mass m_J carried by the bearing')
            call v%number(inputs%rotor%unbalance, 'unbalance', 0.0_wp, 1e6_wp, 'kg m', 'unbalance dmE')
            call v%number(inputs%rotor%balance_grade, 'balance_grade', 1e-6_wp, 1e5_wp, 'mm/s', &
               & 'instead of unbalance: ISO 21940-11 grade G of eq (26)')
            call v%number(inputs%rotor%balance_speed_rpm, 'balance_speed_rpm', 1.0_wp, 1e6_wp, 'rpm', &
               & 'speed of eq (26); if left out, the maximum speed of the run')
         end if
         call v%number(inputs%rotor%gravity, 'gravity', 0.0_wp, 1e3_wp, 'm/s^2', 'acceleration towards -y')
         if (rigid) call v%numbers(inputs%rotor%static_load, 'static_load', -1e12_wp, 1e12_wp, 'N', &
            & 'extra force on the journal along y and z')
         if (.not. inputs%rotor%is_rigid()) call v%word(inputs%rotor%elastic%rotor_file, 'file', '', &
            & 'instead of the group shaft: the HDF5 file with the matrices of a rotor from another program')
         call group('operation', 'Speed and duration')
         call v%number(inputs%operation%speed_rpm, 'speed_rpm', 1e-3_wp, 1e6_wp, 'rpm', 'shaft speed at the start')
         call v%number(inputs%operation%final_speed_rpm, 'final_speed_rpm', 0.0_wp, 1e6_wp, 'rpm', &
            & 'shaft speed at the end; it changes linearly; if left out, speed_rpm')
         call v%word(inputs%operation%rotation, 'rotation', 'clockwise anticlockwise', &
            & 'seen with y up and z to the right: clockwise, from +y to +z; anticlockwise, from +y to -z: oil then ' &
            & //'enters a pad at its smaller angle, and pads%pivot_ratio counts from there')
         call v%number(inputs%operation%duration, 'duration', 1e-9_wp, 1e6_wp, 's', 'simulated time')
      end subroutine list_rotor

      subroutine list_thermal()
         call group('thermal', 'Heat balance of the oil')
         call v%word(inputs%thermal%model, 'model', 'none pad film', &
            & 'none: all oil has supply_temperature; pad: a temperature and a viscosity for each pad; film: ' &
            & //'temperatures along and across each film, and in the pad')
         call v%whole(inputs%thermal%stations, 'stations', 8.0_wp, 400.0_wp, 'film: stations along the arc')
         call v%whole(inputs%thermal%layers, 'layers', 4.0_wp, 100.0_wp, 'film: layers across the film')
         call v%word(inputs%thermal%march, 'march', 'frozen groove', &
            & 'in a march; frozen: temperatures of the equilibrium; groove: the oil between the pads warms and cools')
      end subroutine list_thermal

      subroutine list_start()
         call group('start', 'Where a march starts; the values of journal and pads are added, as a disturbance; a ' &
            & //'resumed run does not start again')
         call v%word(inputs%start%from, 'from', 'equilibrium partial centred given file', &
            & 'equilibrium: of the initial speed, at rest; partial: the same, but pads without equilibrium stand on ' &
            & //'their pivots without tilt; centred: journal in the middle, pads at rest on their pivots without ' &
            & //'tilt; given: only the values of journal and pads below; file: the end of another result')
         call v%word(inputs%start%file, 'file', '', &
            & 'file: the result file, with the same pads; its last whole turn of the shaft is taken')
         if (.not. rigid) return
         call v%numbers(inputs%start%journal, 'journal', -0.1_wp, 0.1_wp, 'm', &
            & 'displacement of the journal along y and z')
         call v%numbers(inputs%start%journal_velocity, 'journal_velocity', -1e3_wp, 1e3_wp, 'm/s', &
            & 'velocity of the journal along y and z')
         call v%each(inputs%start%pad_tilt, 'pads', 'pad_tilt', -3.0_wp, 3.0_wp, 'rad', 'tilts of the pads')
         call v%each(inputs%start%pad_tilt_rate, 'pads', 'pad_tilt_rate', -1e5_wp, 1e5_wp, 'rad/s', 'their rates')
         call v%each(inputs%start%pivot_deflection, 'pads', 'pivot_deflection', -0.1_wp, 0.1_wp, 'm', &
            & 'tilting_radial: deflections of the pivots')
         call v%each(inputs%start%pivot_deflection_rate, 'pads', 'pivot_deflection_rate', -1e3_wp, 1e3_wp, 'm/s', &
            & 'tilting_radial: their rates')
         call v%each(inputs%start%pad_pitch, 'pads', 'pad_pitch', -0.1_wp, 0.1_wp, 'rad', 'pads that pitch: pitches')
         call v%each(inputs%start%pad_pitch_rate, 'pads', 'pad_pitch_rate', -1e5_wp, 1e5_wp, 'rad/s', &
            & 'pads that pitch: their rates')
         call v%each(inputs%start%pad_yaw, 'pads', 'pad_yaw', -0.1_wp, 0.1_wp, 'rad', 'pads that yaw: yaws')
         call v%each(inputs%start%pad_yaw_rate, 'pads', 'pad_yaw_rate', -1e5_wp, 1e5_wp, 'rad/s', &
            & 'pads that yaw: their rates')
      end subroutine list_start

      subroutine list_held()
         call group('held', 'Where the journal is held, for comparison with tables, with the tasks equilibrium and ' &
            & //'coefficients: the static load is then what holds it there')
         call v%number(inputs%held%eccentricity_ratio, 'eccentricity_ratio', 0.0_wp, 100.0_wp, '1', &
            & 'distance of the journal from the middle over the bearing clearance c_r')
         call v%number(inputs%held%attitude_deg, 'attitude_deg', -360.0_wp, 360.0_wp, 'deg', &
            & 'angle from the load of the case to the journal, in the sense of rotation; if left out, that at which ' &
            & //'the load that holds the journal has the direction of the load of the case')
         call v%numbers(inputs%held%position, 'position', -0.1_wp, 0.1_wp, 'm', &
            & 'instead of eccentricity_ratio: displacement of the journal along y and z')
      end subroutine list_held

      !> Integration and output.
      subroutine list_march()
         call group('integration', 'Integration in time by CVODE')
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
         call group('output', 'Contents of the result file')
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
      end subroutine list_march

      !> What other tasks than a march have.
      subroutine list_analyses()
         call group('coefficients', 'Stiffness, damping and stability, for the task coefficients')
         call v%list(inputs%coefficients%frequency_ratio, most_ratios, 'frequency_ratio', 0.0_wp, 1e6_wp, '1', &
            & 'whirl frequencies over the speed of the shaft, of the coefficients of the journal')
         call v%number(inputs%coefficients%threshold_up_to_rpm, 'threshold_up_to_rpm', 0.0_wp, 1e6_wp, 'rpm', &
            & '> 0: the speed at which stability is lost is sought from speed_rpm up to this one')
         call v%flag(inputs%coefficients%threshold_born, 'threshold_born', 'the limit cycles that begin at the ' &
            & //'threshold speed are followed, without unbalance: towards which speeds they are born, and the lowest ' &
            & //'with one')
         call v%flag(inputs%coefficients%slopes, 'slopes', 'whether stiffness and damping against slopes ' &
            & //'of the journal and moments on it are found, too, 4 x 4')
         call v%number(inputs%coefficients%cross_stiffness, 'cross_stiffness', -1e15_wp, 1e15_wp, 'N/m', 'Q: ' &
            & //'cross-coupled stiffness at the journal beside the bearing''s, for the modes; > 0 drives forward ' &
            & //'whirl; of a machine at each journal, and &element has it at other stations')
         call group('periodic', 'A periodic orbit and its stability, for the tasks periodic and branch')
         call v%whole(inputs%periodic%revolutions, 'revolutions', 1.0_wp, 1000.0_wp, &
            & 'revolutions of the shaft in a period')
         call v%number(inputs%periodic%tolerance, 'tolerance', 1e-12_wp, 1e-2_wp, '1', &
            & 'how far from the orbit Newton''s method may end, over the characteristic scale of each state')
         call v%whole(inputs%periodic%max_iterations, 'max_iterations', 1.0_wp, 1e6_wp, &
            & 'maximum number of iterations of Newton''s method; more is a failure')
         call group('branch', 'Equilibria, periodic orbits or limit cycles over a number of the input, or their ' &
            & //'bifurcation points over two, for the task branch')
         call v%word(inputs%branch%of, 'of', 'periodic equilibrium limit_cycle curve', 'periodic: orbits, as the ' &
            & //'task periodic finds them; equilibrium: equilibria without friction in the pivots; limit_cycle: the ' &
            & //'self-excited vibrations, without unbalance, that begin at the first Hopf point of the equilibria, ' &
            & //'or, with values of the group start, those to which a march leads; ' &
            & //'curve: the bifurcation points of a kind over two numbers of the input, from the first one that ' &
            & //'such a branch has')
         call v%word(inputs%branch%point, 'point', 'hopf fold period_doubling neimark_sacker cycle_fold', 'curve: ' &
            & //'hopf: Hopf points of equilibria, without unbalance; fold: folds of orbits, without unbalance of ' &
            & //'equilibria; period_doubling, neimark_sacker: of orbits; cycle_fold: folds of limit cycles')
         call v%word(inputs%branch%parameter, 'parameter', '', &
            & 'the number that changes, from the value that the case gives it: ''operation%speed_rpm''; with an ' &
            & //'element where there are several, ''rotor%static_load(1)''; of values of the pads all without one. ' &
            & //'Numbers of rotor, operation, bearing, oil, pads, pivot, friction and asperity')
         call v%number(inputs%branch%last, 'last', -1e15_wp, 1e15_wp, '', 'its value where the branch ends, twice ' &
            & //'the first one if left out; it also ends where it comes back to the first value')
         call v%number(inputs%branch%step, 'step', -1e15_wp, 1e15_wp, '', &
            & 'its first change, a twentieth of the way if left out; later steps are as long as the iteration allows')
         call v%number(inputs%branch%max_step, 'max_step', 0.0_wp, 1e15_wp, '', 'its largest change from point to ' &
            & //'point, of a curve the same part of both ways; 0: ten times the first, of a curve the first')
         call v%word(inputs%branch%second_parameter, 'second_parameter', '', 'curve: the other number, from the ' &
            & //'value that the case gives it: ''rotor%mass''')
         call v%number(inputs%branch%second_last, 'second_last', -1e15_wp, 1e15_wp, '', 'curve: its value where the ' &
            & //'curve ends, twice the first one if left out; it also ends at the first or last value of either')
         call v%whole(inputs%branch%max_points, 'max_points', 2.0_wp, 1e5_wp, 'maximum number of points of a branch')
         call v%flag(inputs%branch%switch, 'switch', &
            & 'periodic, limit_cycle: whether those of double period are followed, too, where the period doubles')
      end subroutine list_analyses

      ! The variables of a bearing.

      !> Geometry of a bearing, its oil where the law is constant, its boundary pressures, where and on what it stands,
      !> and its oil.
      subroutine list_bearing(own)
         type(bearing_type), intent(inout) :: own
         type(station_element_type) :: of
         call of%begin()
         call group('bearing', 'Geometry, oil and boundary pressures')
         call v%number(own%journal_radius, 'journal_radius', 1e-4_wp, 10.0_wp, 'm', 'radius R_J of the journal')
         call v%each(own%machined_clearance, 'pads', 'machined_clearance', 1e-9_wp, 0.1_wp, 'm', &
            & 'radial clearance c_m between pad bore and journal')
         call v%each(own%assembled_clearance, 'pads', 'assembled_clearance', 1e-9_wp, 0.1_wp, 'm', &
            & 'radial clearance c_r at the pivots; where pads differ, the smallest is that of the bearing')
         call v%each(own%preload, 'pads', 'preload', -1.0_wp, 0.999_wp, '1', &
            & 'instead of machined_clearance: preload m of the pads, c_m = c_r/(1 - m)')
         call v%each(own%axial_length, 'pads', 'axial_length', 1e-5_wp, 100.0_wp, 'm', 'pad length L along the shaft')
         call v%number(own%viscosity, 'viscosity', thinnest, thickest, 'Pa s', &
            & 'dynamic viscosity of the oil where oil%law is constant')
         call v%number(own%clearance_temperature, 'clearance_temperature', low, high, 'C', &
            & 'temperature at which the clearances were measured: shaft, pads and housing expand from there; if left ' &
            & //'out, the clearances are those in operation')
         call v%number(own%shaft_expansion, 'shaft_expansion', 0.0_wp, 1e-3_wp, '1/K', &
            & 'linear expansion of the shaft, which has oil%shaft_temperature or, if that is left out, the ' &
            & //'temperature of the solution; 11e-6: steel')
         call v%number(own%housing_expansion, 'housing_expansion', 0.0_wp, 1e-3_wp, '1/K', &
            & 'linear expansion of the housing')
         call v%number(own%housing_temperature, 'housing_temperature', low, high, 'C', &
            & 'temperature of the housing; if left out, oil%supply_temperature')
         call v%number(own%supply_pressure, 'supply_pressure', -1e9_wp, 1e9_wp, 'Pa', 'pressure at the leading edges')
         call v%number(own%ambient_pressure, 'ambient_pressure', -1e9_wp, 1e9_wp, 'Pa', 'pressure at the other edges')
         call v%number(own%cavitation_pressure, 'cavitation_pressure', -1e9_wp, 1e9_wp, 'Pa', &
            & 'pressure at which the film cavitates')
         if (rigid) call v%numbers(own%slope, 'slope', -0.1_wp, 0.1_wp, 'rad', 'slopes of the rigid journal in the ' &
            & //'bearing, dy/dx and dz/dx over the distance x along the shaft')
         if (machine) then
            call v%word(own%shaft_slope, 'shaft_slope', 'auto film ignored', 'of a machine: film, the slope of the ' &
               & //'shaft counts in the films, whose moments act on the shaft; auto: where pads pitch')
            call v%numbers(own%misalignment, 'misalignment', -0.1_wp, 0.1_wp, 'rad', 'of a machine: slopes of the ' &
               & //'housing against the line of the bearings, along y and z; only where films count slopes')
            if (all) call list_kind(v, own%mount_type, of)
            if (.not. all) call list_kind(v, own%mount_type)
         end if
         if (allocated(own%support) .and. .not. all) call list_support(v, own%support, ending)
         if (allocated(own%damper) .and. .not. all) call list_damper(v, own%damper, ending)
         call list_oil(own%oil)
      end subroutine list_bearing

      subroutine list_oil(oil)
         type(oil_type), intent(inout) :: oil
         call group('oil', &
            & 'Viscosity over temperature, and what heats the oil by how much; *Oil* above says which viscosity holds')
         call v%word(oil%law, 'law', 'constant exponential walther', 'constant: bearing%viscosity; exponential, ' &
            & //'walther: over the temperature; if left out, the law whose numbers are given')
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
         call v%number(oil%reference_viscosity, 'reference_viscosity', thinnest, thickest, 'Pa s', &
            & 'exponential: dynamic viscosity at reference_temperature')
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
         call v%number(oil%turbulent_prandtl, 'turbulent_prandtl', 0.5_wp, 2.0_wp, '1', &
            & 'film%turbulence: eddy viscosity over eddy conductivity, as a Prandtl number; 0.9: usual beside walls')
         call v%number(oil%groove_volume, 'groove_volume', 0.0_wp, 1.0_wp, 'm^3', &
            & 'oil between two pads, for thermal%march = groove')
         call v%number(oil%back_coefficient, 'back_coefficient', 0.0_wp, 1e6_wp, 'W/(m^2 K)', &
            & 'for thermal%model = film: film coefficient at the back and both ends of the pads')
         call v%number(oil%back_temperature, 'back_temperature', low, high, 'C', &
            & 'likewise: temperature of the oil there; if left out, supply_temperature')
      end subroutine list_oil

      !> Its pads, their pivots and what rubs.
      subroutine list_contacts(bearing)
         type(bearing_type), intent(inout) :: bearing
         call list_pads(bearing%pads)
         call list_pivot(bearing%pivot)
         call list_friction(bearing%friction)
         call group('asperity', 'Contact of pad and journal where the film is thinner than 4 times their roughness')
         call v%word(bearing%asperity%model, 'model', 'greenwood_tripp none', &
            & 'greenwood_tripp: pressure of the asperities; none: a film that closes ends the run')
         call v%number(bearing%asperity%roughness, 'roughness', 1e-9_wp, 1e-3_wp, 'm', &
            & 'combined rms roughness sigma, the root of the sum of the squares of both; 0.5 um: ground or fine turned')
         call v%number(bearing%asperity%elastic_modulus, 'elastic_modulus', 1e5_wp, 1e14_wp, 'Pa', &
            & 'composite modulus E'', 1/E'' = (1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2; 47 GPa: steel on white metal (210 ' &
            & //'and 52 GPa)')
         call v%number(bearing%asperity%factor, 'factor', 1e-9_wp, 1.0_wp, '1', 'K'' = 16 sqrt(2) pi/15 (sigma beta ' &
            & //'eta)^2 (sigma/beta)^0.5; 0.003: upper end of the usual 0.0003 to 0.003')
         call v%number(bearing%asperity%friction_coefficient, 'friction_coefficient', 0.0_wp, 10.0_wp, '1', &
            & 'boundary friction of touching asperities; 0.1: usual for oiled metals')
      end subroutine list_contacts

      subroutine list_pads(pads)
         type(pads_type), intent(inout) :: pads
         call group('pads', 'The bearing has one pad for each pivot angle')
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
         call v%each(pads%thickness, 'pads', 'thickness', 1e-6_wp, 1.0_wp, 'm', 'radial thickness of the pad, for ' &
            & //'mass, inertia and centre of gravity; pivot_distance where it is needed and not given')
         call v%each(pads%conductivity, 'pads', 'conductivity', 1e-3_wp, 1e4_wp, 'W/(m K)', 'for thermal%model = ' &
            & //'film: thermal conductivity of the pad, through the thickness pads%thickness, or else pivot_distance')
         call v%word(pads%bending, 'bending', 'none elastic thermal both', 'what bends pads that tilt: none; ' &
            & //'elastic: the pressure of the films; thermal: the heat that flows through them, with thermal%model = ' &
            & //'film; both; pads are as thick as pads%thickness, or else pivot_distance')
         call v%each(pads%young_modulus, 'pads', 'young_modulus', 1e6_wp, 1e13_wp, 'Pa', &
            & 'Young''s modulus of the pad; 210 GPa: steel')
         call v%each(pads%poisson_ratio, 'pads', 'poisson_ratio', 0.0_wp, 0.5_wp, '1', 'its Poisson''s ratio')
         call v%each(pads%expansion, 'pads', 'expansion', 0.0_wp, 1e-3_wp, '1/K', &
            & 'linear expansion of the pad; 11e-6: steel')
         call v%each(pads%temperature, 'pads', 'temperature', low, high, 'C', 'for bearing%clearance_temperature: ' &
            & //'mean temperature of the pad; if left out, that of thermal%model = film')
         call v%word(pads%motion, 'motion', 'tilting_radial tilting_only fixed tilting_radial_pitch ' &
            & //'tilting_radial_pitch_yaw tilting_pitch tilting_pitch_yaw', 'tilting_radial: the pads tilt and ' &
            & //'move radially on their pivots; tilting_only: they only tilt; fixed: neither, lobes of a plain ' &
            & //'bearing; with pitch they also follow a slope of the shaft outward, with yaw one along the pad')
         call v%each(pads%inertia_pitch, 'pads', 'inertia_pitch', inertia_range(1), inertia_range(2), 'kg m^2', &
            & 'pads that pitch: moment of inertia of the pitch about the pivot; from the shape if left out')
         call v%each(pads%inertia_yaw, 'pads', 'inertia_yaw', inertia_range(1), inertia_range(2), 'kg m^2', &
            & 'pads that yaw: moment of inertia of the yaw about the pivot; from the shape if left out')
         call v%each(pads%pivot_axial_offset, 'pads', 'pivot_axial_offset', -10.0_wp, 10.0_wp, 'm', &
            & 'pads that pitch: how far the pivot stands from the middle of the pad along the shaft')
      end subroutine list_pads

      subroutine list_pivot(pivot)
         type(pivot_type), intent(inout) :: pivot
         call group('pivot', 'Pivots of the pads: ball and socket, or another law')
         call v%word(pivot%law, 'law', 'fang hertz rocker linear table', 'fang: conformal contact (11)-(18); ' &
            & //'hertz: law of Hertz; rocker: line contact of a cylinder in a cylinder, which rolls; linear: a ' &
            & //'spring of pivot%stiffness; table: as measured, by pivot%file')
         call v%words(pivot%file, 'pads', size(pivot%socket_radius), 'file', 'table: the CSV file whose columns are ' &
            & //'deflection (m) and force (N); one for all pads or one each')
         call v%each(pivot%socket_radius, 'pads', 'socket_radius', 1e-5_wp, 10.0_wp, 'm', &
            & 'radius R_2 of the socket, or of the bore that a rocker rolls in')
         call v%each(pivot%radius_difference, 'pads', 'radius_difference', 0.0_wp, 1.0_wp, 'm', &
            & 'dR = R_2 - R_1, R_1 being the radius of the ball or rocker')
         call v%each(pivot%contact_length, 'pads', 'contact_length', 1e-5_wp, 100.0_wp, 'm', &
            & 'rocker: length of the line of contact along the shaft; if left out, bearing%axial_length')
         call v%each(pivot%stiffness, 'pads', 'stiffness', 1.0_wp, 1e15_wp, 'N/m', &
            & 'linear: pivot load over pivot deflection')
         call v%each(pivot%rotational_stiffness, 'pads', 'rotational_stiffness', 0.0_wp, 1e15_wp, 'N m/rad', &
            & 'of a flexure pivot: moment against the tilt over the tilt; 0: the pivot turns freely')
         call v%numbers(pivot%young_modulus, 'young_modulus', 1e6_wp, 1e14_wp, 'Pa', &
            & 'values of ball (or rocker) and socket')
         call v%numbers(pivot%poisson_ratio, 'poisson_ratio', -0.99_wp, 0.5_wp, '1', &
            & 'values of ball (or rocker) and socket')
         call v%number(pivot%deflection_factor, 'deflection_factor', 0.1_wp, 100.0_wp, '1', &
            & 'factor of eq (13): 4 as printed; 2 pi agrees with Hertz''s law')
         call v%number(pivot%wear_coefficient, 'wear_coefficient', 0.0_wp, 1e-6_wp, 'm^3/(N m)', &
            & 'worn volume over pivot load and distance slid (Archard), for pad_wear_rate; 0: no figures of the wear')
      end subroutine list_pivot

      subroutine list_friction(f)
         type(friction_type), intent(inout) :: f
         call group('friction', 'Friction in the pivots')
         call v%word(f%model, 'model', 'none bengisu_akay lugre', 'none; bengisu_akay: eq (22); lugre: eqs (23)-(25)')
         call v%each(f%static_coefficient, 'pads', 'static_coefficient', 1e-6_wp, 10.0_wp, '1', &
            & 'static friction coefficient f_s')
         call v%each(f%dynamic_coefficient, 'pads', 'dynamic_coefficient', 0.0_wp, 10.0_wp, '1', &
            & 'dynamic friction coefficient f_d <= f_s')
         call v%number(f%critical_velocity, 'critical_velocity', 1e-12_wp, 10.0_wp, 'm/s', &
            & 'Bengisu-Akay: critical velocity v_c')
         call v%number(f%decay, 'decay', 0.0_wp, 1e9_wp, 's/m', 'Bengisu-Akay: decay chi of the Stribeck curve')
         call v%number(f%stribeck_velocity, 'stribeck_velocity', 1e-9_wp, 1e3_wp, 'm/s', 'LuGre: Stribeck velocity v_s')
         call v%number(f%stribeck_exponent, 'stribeck_exponent', 0.1_wp, 10.0_wp, '1', 'LuGre: Stribeck exponent gamma')
         call v%number(f%bristle_stiffness, 'bristle_stiffness', 1.0_wp, 1e12_wp, '1/m', &
            & 'LuGre: bristle stiffness sigma_0')
         call v%number(f%bristle_damping, 'bristle_damping', 0.0_wp, 1e6_wp, 's/m', &
            & 'LuGre: bristle damping sigma_1; if left out, that of eq (28)')
         call v%number(f%viscous_coefficient, 'viscous_coefficient', 0.0_wp, 1e6_wp, 's/m', &
            & 'LuGre: viscous coefficient sigma_2')
         call v%number(f%characteristic_load, 'characteristic_load', 1e-6_wp, 1e12_wp, 'N', &
            & 'LuGre: characteristic load N_m of eq (28), where bristle_damping is left out')
      end subroutine list_friction

      subroutine list_film(film)
         type(film_type), intent(inout) :: film
         call group('film', 'Solver of the Reynolds equation')
         call v%word(film%solver, 'solver', 'auto direct fourier sor', &
            & 'auto: tables of converged films, direct where there is none; direct: axial modes, finite volumes ' &
            & //'where a film cavitates; fourier: axial Fourier expansion; sor: over-relaxation')
         call v%whole(film%circumferential_cells, 'circumferential_cells', 0.0_wp, 2000.0_wp, &
            & 'direct, fourier, sor: cells along the arc, an even number; 0: as many as axial modes need, 80 where a ' &
            & //'film cavitates, 60 for sor, twice or three times as many from 180 or 300 degrees on')
         call v%whole(film%axial_cells, 'axial_cells', 0.0_wp, 1000.0_wp, &
            & 'direct, sor: cells along half the width, at least 2; 0: 8, or 15 for sor')
         call v%whole(film%axial_modes, 'axial_modes', 0.0_wp, 200.0_wp, 'direct, fourier: maximum number of axial ' &
            & //'modes; the closed form takes those that are too stiff for the cells; 0: automatic')
         call v%number(film%relaxation, 'relaxation', 0.0_wp, 1.999_wp, '1', &
            & 'sor: relaxation factor; 0: the optimum for the grid')
         call v%number(film%tolerance, 'tolerance', 1e-13_wp, 1e-2_wp, '1', &
            & 'sor: limit of residual over source; at most a thousandth of relative_tolerance is used')
         call v%whole(film%max_sweeps, 'max_sweeps', 1.0_wp, 1e8_wp, &
            & 'sor: maximum number of sweeps for a film; more is a failure')
         call v%number(film%table_tolerance, 'table_tolerance', 0.0_wp, 1e-2_wp, '1', &
            & 'auto: usual error of forces from tables, over the force itself; 0: relative_tolerance, with reynolds ' &
            & //'4 times as much; cavitated films keep to 4e-7 at best')
         call v%word(film%cavitation, 'cavitation', 'reynolds gumbel none', &
            & 'reynolds: p >= p_cav in the solution; gumbel: clipped after the solution; none: no cavitation')
         call v%word(film%turbulence, 'turbulence', 'none ng_pan ng_pan_fit constantinescu hirs', &
            & 'none: laminar films; else the closure that turbulent films have: ng_pan: eddies integrated across the ' &
            & //'film; its fit, Constantinescu''s and Hirs'' (the last bends suddenly and serves no motion)')
         call v%number(film%laminar_below, 'laminar_below', 1.0_wp, 1e6_wp, '1', &
            & 'turbulence: Reynolds number rho U h/mu below which a film is laminar')
         call v%number(film%turbulent_above, 'turbulent_above', 1.0_wp, 1e6_wp, '1', &
            & 'turbulence: Reynolds number above which it is turbulent')
      end subroutine list_film
   end subroutine go_along
end module case_fields
