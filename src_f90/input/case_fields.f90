!> The list of all input variables: each with its component of the case, name, allowed values, unit and meaning. The
!> groups of a bearing are in bearing_fields, those of a machine in machine_fields.
module case_fields
   use kinds, only: wp
   use variable_table, only: variable_table_type
   use case_groups, only: start_type, most_ratios
   use case_inputs, only: case_type
   use rotor_groups, only: rotor_type, elastic_type
   use excitations, only: excitation_type, make_excitations
   use machine_fields, only: list_excitations, list_rotor_file, list_parts, list_bearings, list_place
   use bearing_fields, only: list_bearing, list_oil, list_pads, list_pivot, list_friction, list_asperity, list_film
   implicit none (type, external)
   private
   public :: list_variables, put_variables, list_all_variables
   public :: title_variable, checkpoint_variable, counting_variables

   !> Variables without effect on what is calculated: a study cannot vary the title, and a resumed run may have
   !> another time between checkpoints.
   character(len=*), parameter :: title_variable = 'case%title'
   character(len=*), parameter :: checkpoint_variable = 'output%checkpoint_seconds'
   !> The variables whose lengths are the numbers of pads and of sections.
   character(len=*), parameter :: counting_variables(2) = [character(len=20) :: 'pads%pivot_angle_deg', 'shaft%length']

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

   !> The variables of all groups that any case has, each group once, with their defaults: those of a rigid journal in
   !> one bearing, and those of a machine.
   subroutine list_all_variables(inputs, table)
      type(case_type), intent(in) :: inputs
      type(variable_table_type), intent(out) :: table
      type(case_type) :: copy
      type(elastic_type) :: elastic
      copy = inputs
      call elastic%begin(discs=1, unbalances=1, loads=1)
      allocate (copy%bearings(1)%support)
      call table%begin(filled=.false.)
      call go_along(copy, table, elastic)
   end subroutine list_all_variables

   !> All variables of a case, in the order of the input reference; with an elastic rotor those of the bearings come
   !> last, with the name of each behind that of the group. With `also`, those of this rotor and of a bearing's place
   !> and support beside those of a rigid journal.
   subroutine go_along(inputs, v, also)
      type(case_type), intent(inout) :: inputs
      type(variable_table_type), intent(inout) :: v
      type(elastic_type), intent(inout), optional :: also
      type(excitation_type), allocatable :: one(:)
      logical :: rigid
      rigid = inputs%rotor%is_rigid()
      call list_case(inputs, v)
      call list_rotor(inputs%rotor, rigid, v)
      if (present(also)) call list_rotor_file(also, v)
      if (.not. rigid) call list_rotor_file(inputs%rotor%elastic, v)
      call list_operation(inputs, v)
      if (present(also)) then
         call make_excitations(1, one)
         call list_excitations(one, v, numbered=.false., stations=.true.)
      else
         call list_excitations(inputs%excitations, v, numbered=.true., stations=.not. rigid)
      end if
      if (rigid) call list_bearing(inputs%bearings(1), v)
      if (present(also)) call list_place(inputs%bearings(1), v)
      if (rigid) call list_oil(inputs%bearings(1)%oil, v)
      call list_thermal(inputs, v)
      if (rigid) call list_pads(inputs%bearings(1)%pads, v)
      if (rigid) call list_pivot(inputs%bearings(1)%pivot, v)
      if (rigid) call list_friction(inputs%bearings(1)%friction, v)
      if (rigid) call list_asperity(inputs%bearings(1)%asperity, v)
      call list_start(inputs%start, rigid, v)
      if (rigid) call list_film(inputs%bearings(1)%film, v)
      call list_integration(inputs, v)
      call list_output(inputs, v)
      call list_coefficients(inputs, v)
      call list_periodic(inputs, v)
      call list_branch(inputs, v)
      if (present(also)) call list_parts(also, v, inputs%bearings(1)%support)
      if (rigid) return
      call list_parts(inputs%rotor%elastic, v)
      call list_bearings(inputs%bearings, v)
   end subroutine go_along

   subroutine list_case(inputs, v)
      type(case_type), intent(inout) :: inputs
      type(variable_table_type), intent(inout) :: v
      call v%group('case', 'Title and task of the run')
      call v%word(inputs%about%title, 'title', '', 'free text, which the result file contains')
      call v%word(inputs%about%task, 'task', 'march equilibrium coefficients periodic branch', &
         & 'march: motion over time; equilibrium: only the static equilibrium; coefficients: the same, with ' &
         & //'stiffness, damping and stability there; periodic: the orbit that the motion repeats, and its ' &
         & //'stability; branch: equilibria or such orbits over a number of the input, and where their stability ' &
         & //'changes')
   end subroutine list_case

   subroutine list_rotor(rotor, rigid, v)
      type(rotor_type), intent(inout) :: rotor
      logical, intent(in) :: rigid
      type(variable_table_type), intent(inout) :: v
      call v%group('rotor', 'The part of the rotor that this bearing carries, and its loads')
      if (rigid) then
         call v%number(rotor%mass, 'mass', 1e-6_wp, 1e9_wp, 'kg', 'mass m_J carried by the bearing')
         call v%number(rotor%unbalance, 'unbalance', 0.0_wp, 1e6_wp, 'kg m', 'unbalance dmE')
         call v%number(rotor%balance_grade, 'balance_grade', 1e-6_wp, 1e5_wp, 'mm/s', &
            & 'instead of unbalance: ISO 21940-11 grade G of eq (26)')
         call v%number(rotor%balance_speed_rpm, 'balance_speed_rpm', 1.0_wp, 1e6_wp, 'rpm', &
            & 'speed of eq (26); if left out, the maximum speed of the run')
      end if
      call v%number(rotor%gravity, 'gravity', 0.0_wp, 1e3_wp, 'm/s^2', 'acceleration towards -y')
      if (rigid) call v%numbers(rotor%static_load, 'static_load', -1e12_wp, 1e12_wp, 'N', &
         & 'extra force on the journal along y and z')
   end subroutine list_rotor

   subroutine list_operation(inputs, v)
      type(case_type), intent(inout) :: inputs
      type(variable_table_type), intent(inout) :: v
      call v%group('operation', 'Speed and duration')
      call v%number(inputs%operation%speed_rpm, 'speed_rpm', 1e-3_wp, 1e6_wp, 'rpm', 'shaft speed at the start')
      call v%number(inputs%operation%final_speed_rpm, 'final_speed_rpm', 0.0_wp, 1e6_wp, 'rpm', &
         & 'shaft speed at the end; it changes linearly; if left out, speed_rpm')
      call v%word(inputs%operation%rotation, 'rotation', 'clockwise anticlockwise', &
         & 'seen with y up and z to the right: clockwise, from +y to +z; anticlockwise, from +y to -z: oil then ' &
         & //'enters a pad at its smaller angle, and pads%pivot_ratio counts from there')
      call v%number(inputs%operation%duration, 'duration', 1e-9_wp, 1e6_wp, 's', 'simulated time')
   end subroutine list_operation

   subroutine list_thermal(inputs, v)
      type(case_type), intent(inout) :: inputs
      type(variable_table_type), intent(inout) :: v
      call v%group('thermal', 'Heat balance of the oil')
      call v%word(inputs%thermal%model, 'model', 'none pad film', &
         & 'none: all oil has supply_temperature; pad: a temperature and a viscosity for each pad; film: ' &
         & //'temperatures along and across each film, and in the pad')
      call v%whole(inputs%thermal%stations, 'stations', 8.0_wp, 400.0_wp, 'film: stations along the arc')
      call v%whole(inputs%thermal%layers, 'layers', 4.0_wp, 100.0_wp, 'film: layers across the film')
      call v%word(inputs%thermal%march, 'march', 'frozen groove', &
         & 'in a march; frozen: temperatures of the equilibrium; groove: the oil between the pads warms and cools')
   end subroutine list_thermal

   subroutine list_start(start, rigid, v)
      type(start_type), intent(inout) :: start
      logical, intent(in) :: rigid
      type(variable_table_type), intent(inout) :: v
      call v%group('start', &
         & 'Where a march starts; the values of journal and pads are added, as a disturbance; a resumed run does ' &
         & //'not start again')
      call v%word(start%from, 'from', 'equilibrium partial centred given file', &
         & 'equilibrium: of the initial speed, at rest; partial: the same, but pads without equilibrium stand on ' &
         & //'their pivots without tilt; centred: journal in the middle, pads at rest on their pivots without tilt; ' &
         & //'given: only the values of journal and pads below; file: the end of another result')
      call v%word(start%file, 'file', '', &
         & 'file: the result file, with the same pads; its last whole turn of the shaft is taken')
      if (.not. rigid) return
      call v%numbers(start%journal, 'journal', -0.1_wp, 0.1_wp, 'm', 'displacement of the journal along y and z')
      call v%numbers(start%journal_velocity, 'journal_velocity', -1e3_wp, 1e3_wp, 'm/s', &
         & 'velocity of the journal along y and z')
      call v%each(start%pad_tilt, 'pads', 'pad_tilt', -3.0_wp, 3.0_wp, 'rad', 'tilts of the pads')
      call v%each(start%pad_tilt_rate, 'pads', 'pad_tilt_rate', -1e5_wp, 1e5_wp, 'rad/s', 'their rates')
      call v%each(start%pivot_deflection, 'pads', 'pivot_deflection', -0.1_wp, 0.1_wp, 'm', &
         & 'tilting_radial: deflections of the pivots')
      call v%each(start%pivot_deflection_rate, 'pads', 'pivot_deflection_rate', -1e3_wp, 1e3_wp, 'm/s', &
         & 'tilting_radial: their rates')
   end subroutine list_start

   subroutine list_integration(inputs, v)
      type(case_type), intent(inout) :: inputs
      type(variable_table_type), intent(inout) :: v
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
   end subroutine list_integration

   subroutine list_output(inputs, v)
      type(case_type), intent(inout) :: inputs
      type(variable_table_type), intent(inout) :: v
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
   end subroutine list_output

   subroutine list_coefficients(inputs, v)
      type(case_type), intent(inout) :: inputs
      type(variable_table_type), intent(inout) :: v
      call v%group('coefficients', 'Stiffness, damping and stability, for the task coefficients')
      call v%list(inputs%coefficients%frequency_ratio, most_ratios, 'frequency_ratio', 0.0_wp, 1e6_wp, '1', &
         & 'whirl frequencies over the speed of the shaft, of the coefficients of the journal')
      call v%number(inputs%coefficients%threshold_up_to_rpm, 'threshold_up_to_rpm', 0.0_wp, 1e6_wp, 'rpm', &
         & '> 0: the speed at which stability is lost is sought from speed_rpm up to this one')
      call v%number(inputs%coefficients%cross_stiffness, 'cross_stiffness', -1e15_wp, 1e15_wp, 'N/m', &
         & 'Q: cross-coupled stiffness at the journal beside the bearing''s, for the modes; > 0 drives forward whirl')
   end subroutine list_coefficients

   subroutine list_periodic(inputs, v)
      type(case_type), intent(inout) :: inputs
      type(variable_table_type), intent(inout) :: v
      call v%group('periodic', 'A periodic orbit and its stability, for the tasks periodic and branch')
      call v%whole(inputs%periodic%revolutions, 'revolutions', 1.0_wp, 1000.0_wp, &
         & 'revolutions of the shaft in a period')
      call v%number(inputs%periodic%tolerance, 'tolerance', 1e-12_wp, 1e-2_wp, '1', &
         & 'how far from the orbit Newton''s method may end, over the characteristic scale of each state')
      call v%whole(inputs%periodic%max_iterations, 'max_iterations', 1.0_wp, 1e6_wp, &
         & 'maximum number of iterations of Newton''s method; more is a failure')
   end subroutine list_periodic

   subroutine list_branch(inputs, v)
      type(case_type), intent(inout) :: inputs
      type(variable_table_type), intent(inout) :: v
      call v%group('branch', 'Equilibria or periodic orbits over a number of the input, for the task branch')
      call v%word(inputs%branch%of, 'of', 'periodic equilibrium', &
         & 'periodic: orbits, as the task periodic finds them; equilibrium: equilibria without friction in the pivots')
      call v%word(inputs%branch%parameter, 'parameter', '', &
         & 'the number that changes, from the value that the case gives it: ''operation%speed_rpm''; with an ' &
         & //'element where there are several, ''rotor%static_load(1)''; of values of the pads all without one. ' &
         & //'Numbers of rotor, operation, bearing, oil, pads, pivot, friction and asperity')
      call v%number(inputs%branch%last, 'last', -1e15_wp, 1e15_wp, '', &
         & 'its value where the branch ends, twice the first one if left out; it also ends where it comes back to ' &
         & //'the first value')
      call v%number(inputs%branch%step, 'step', -1e15_wp, 1e15_wp, '', &
         & 'its first change, a twentieth of the way if left out; later steps are as long as the iteration allows')
      call v%number(inputs%branch%max_step, 'max_step', 0.0_wp, 1e15_wp, '', &
         & 'its largest change from point to point; 0: ten times the first')
      call v%whole(inputs%branch%max_points, 'max_points', 2.0_wp, 1e5_wp, 'maximum number of points of a branch')
      call v%flag(inputs%branch%switch, 'switch', &
         & 'periodic: whether the orbits of double period are followed, too, where the period doubles')
   end subroutine list_branch
end module case_fields
