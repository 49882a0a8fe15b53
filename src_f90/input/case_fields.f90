!> The list of all input variables: each with its component of the case, name, allowed values, unit and meaning. The
!> groups of a bearing are in bearing_fields. Groups that a machine has several times have their number or the name of
!> their bearing behind them: disc(2), pads:drive_end (see assignments).
module case_fields
   use kinds, only: wp
   use variable_table, only: variable_table_type
   use case_groups, only: bearing_type, support_type, start_type, most_ratios, unset, is_set, rotor_type, &
      & elastic_type, shaft_type, reduction_type, most_sections, most_stations
   use case_inputs, only: case_type
   use excitations, only: excitation_type, make_excitations
   use assignments, only: counted
   use bearing_fields, only: list_bearing, list_oil, list_contacts, list_film
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
      call go_along(copy, table, all=.false.)
   end subroutine list_variables

   !> Gives a case the values of the table.
   subroutine put_variables(table, inputs)
      type(variable_table_type), intent(inout) :: table
      type(case_type), intent(inout) :: inputs
      call table%begin(filled=.true.)
      call go_along(inputs, table, all=.false.)
   end subroutine put_variables

   !> The variables of all groups that any case has, each group once, with their defaults: those of a rigid journal in
   !> one bearing, and those of a machine.
   subroutine list_all_variables(inputs, table)
      type(case_type), intent(in) :: inputs
      type(variable_table_type), intent(out) :: table
      type(case_type) :: copy
      copy = inputs
      allocate (copy%rotor%elastic, copy%bearings(1)%support)
      call copy%rotor%elastic%begin(discs=1, unbalances=1, loads=1)
      call make_excitations(1, copy%excitations)
      call table%begin(filled=.false.)
      call go_along(copy, table, all=.true.)
   end subroutine list_all_variables

   !> All variables of a case, in the order of the input reference; with an elastic rotor those of the bearings come
   !> last, with the name of each behind that of the group. With `all`, those of a rigid journal and of a machine.
   subroutine go_along(inputs, v, all)
      type(case_type), intent(inout) :: inputs
      type(variable_table_type), intent(inout) :: v
      logical, intent(in) :: all
      logical :: rigid, machine
      machine = .not. inputs%rotor%is_rigid()
      rigid = all .or. .not. machine
      call list_case(inputs, v)
      call list_rotor(inputs%rotor, rigid, v)
      call list_operation(inputs, v)
      call list_excitations(inputs%excitations, v, numbered=.not. all, stations=machine)
      if (rigid) call list_bearing(inputs%bearings(1), v)
      if (all) call list_place(inputs%bearings(1), v)
      if (rigid) call list_oil(inputs%bearings(1)%oil, v)
      call list_thermal(inputs, v)
      if (rigid) call list_contacts(inputs%bearings(1), v)
      call list_start(inputs%start, rigid, v)
      if (rigid) call list_film(inputs%bearings(1)%film, v)
      call list_integration(inputs, v)
      call list_output(inputs, v)
      call list_coefficients(inputs, v)
      call list_periodic(inputs, v)
      call list_branch(inputs, v)
      if (.not. machine) return
      call list_parts(inputs%rotor%elastic, v, numbered=.not. all)
      if (all) call list_support(inputs%bearings(1)%support, v)
      call list_reduction(inputs%rotor%elastic%reduction, v)
      if (.not. all) call list_bearings(inputs%bearings, v)
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
      if (.not. rotor%is_rigid()) call v%word(rotor%elastic%rotor_file, 'file', '', 'instead of the group shaft: the ' &
         & //'HDF5 file with the matrices of a rotor from another program')
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

   ! The variables of a machine, and of excitations.

   !> Shaft and what it carries; `numbered`: of what there are several, each with its number.
   subroutine list_parts(rotor, v, numbered)
      type(elastic_type), intent(inout) :: rotor
      type(variable_table_type), intent(inout) :: v
      logical, intent(in) :: numbered
      integer :: i
      call list_shaft(rotor%shaft, v)
      do i = 1, size(rotor%discs)
         associate (disc => rotor%discs(i))
            call begin_part('disc', 'a rigid disc on its shaft', disc%station)
            call v%number(disc%mass, 'mass', 0.0_wp, 1e9_wp, 'kg', 'mass')
            call v%number(disc%polar_inertia, 'polar_inertia', 0.0_wp, 1e12_wp, 'kg m^2', &
               & 'moment of inertia about the axis of the shaft')
            call v%number(disc%diametral_inertia, 'diametral_inertia', 0.0_wp, 1e12_wp, 'kg m^2', &
               & 'moment of inertia about a diameter')
         end associate
      end do
      do i = 1, size(rotor%unbalances)
         call begin_part('unbalance', 'an unbalance', rotor%unbalances(i)%station)
         call v%number(rotor%unbalances(i)%moment, 'moment', 0.0_wp, 1e6_wp, 'kg m', 'mass times eccentricity')
         call v%number(rotor%unbalances(i)%angle_deg, 'angle_deg', -360.0_wp, 360.0_wp, 'deg', &
            & 'its angle on the shaft, in the sense of rotation')
      end do
      do i = 1, size(rotor%loads)
         call begin_part('load', 'a steady force on its shaft, beside the weight', rotor%loads(i)%station)
         call v%numbers(rotor%loads(i)%force, 'force', -1e12_wp, 1e12_wp, 'N', 'along y and z')
      end do
      call v%behind_group('')
   contains
      !> The group of the i-th part of a kind, and its station.
      subroutine begin_part(name, meaning, station)
         character(len=*), intent(in) :: name, meaning
         integer, intent(inout) :: station
         if (numbered) call v%behind_group(counted(i))
         call v%group(name, 'A machine: '//meaning//'; one group for each')
         call list_station(station, v)
      end subroutine begin_part
   end subroutine list_parts

   !> Each bearing with its own groups.
   subroutine list_bearings(bearings, v)
      type(bearing_type), intent(inout) :: bearings(:)
      type(variable_table_type), intent(inout) :: v
      integer :: b
      do b = 1, size(bearings)
         associate (own => bearings(b))
            call v%behind_group(own%suffix())
            call list_bearing(own, v)
            call list_place(own, v)
            if (allocated(own%support)) call list_support(own%support, v)
            call list_oil(own%oil, v)
            call list_contacts(own, v)
            call list_film(own%film, v)
         end associate
      end do
      call v%behind_group('')
   end subroutine list_bearings

   subroutine list_shaft(shaft, v)
      type(shaft_type), intent(inout) :: shaft
      type(variable_table_type), intent(inout) :: v
      call v%group('shaft', 'A machine: the sections of its shaft, from station 1 to station 2, from there to ' &
         & //'station 3, ...; *Machines* above')
      call v%list(shaft%length, most_sections, 'length', 1e-6_wp, 1e3_wp, 'm', 'length of each section', &
         & counts='sections')
      call v%each(shaft%diameter, 'sections', 'diameter', 1e-4_wp, 100.0_wp, 'm', 'outer diameter')
      call v%each(shaft%bore, 'sections', 'bore', 0.0_wp, 100.0_wp, 'm', 'inner diameter; 0: solid')
      call v%number(shaft%young_modulus, 'young_modulus', 1e6_wp, 1e14_wp, 'Pa', 'of its material')
      call v%number(shaft%poisson_ratio, 'poisson_ratio', -0.99_wp, 0.5_wp, '1', 'of its material')
      call v%number(shaft%density, 'density', 1.0_wp, 1e5_wp, 'kg/m^3', 'of its material')
   end subroutine list_shaft

   subroutine list_support(support, v)
      type(support_type), intent(inout) :: support
      type(variable_table_type), intent(inout) :: v
      call v%group('support', 'A machine: what a bearing stands on; without this group it stands on the ground')
      call v%number(support%mass, 'mass', 0.0_wp, 1e9_wp, 'kg', &
         & 'mass that moves with the housing of the bearing, that of the pads with it; must be above 0')
      call v%numbers(support%stiffness, 'stiffness', 0.0_wp, 1e15_wp, 'N/m', 'along y and z')
      call v%numbers(support%damping, 'damping', 0.0_wp, 1e12_wp, 'N s/m', 'along y and z')
   end subroutine list_support

   subroutine list_reduction(reduction, v)
      type(reduction_type), intent(inout) :: reduction
      type(variable_table_type), intent(inout) :: v
      call v%group('reduction', 'A machine: which modes of the shaft are kept')
      call v%number(reduction%frequency, 'frequency', 1e-3_wp, 1e7_wp, 'Hz', &
         & 'modes of the shaft on fixed bearings up to this frequency are kept; if left out, as many as the run needs')
      call v%number(reduction%damp_above, 'damp_above', 0.0_wp, 1e7_wp, 'Hz', &
         & 'modes above this frequency are damped')
      call v%number(reduction%damping_ratio, 'damping_ratio', 0.0_wp, 1.0_wp, '1', 'their damping ratio')
   end subroutine list_reduction

   !> Where a bearing stands.
   subroutine list_place(bearing, v)
      type(bearing_type), intent(inout) :: bearing
      type(variable_table_type), intent(inout) :: v
      call list_station(bearing%station, v)
      call v%numbers(bearing%offset, 'offset', -0.1_wp, 0.1_wp, 'm', &
         & 'of a machine: how far the bearing stands from the line of the others, along y and z')
   end subroutine list_place

   !> A station; none is given where it is 0.
   subroutine list_station(station, v)
      integer, intent(inout) :: station
      type(variable_table_type), intent(inout) :: v
      real(wp) :: x
      x = unset
      if (station > 0) x = station
      call v%number(x, 'station', 1.0_wp, real(most_stations, wp), '1', 'of a machine: station of its shaft', .true.)
      station = 0
      if (is_set(x)) station = nint(x)
   end subroutine list_station

   ! The input variables of the groups excitation.

   !> Those of all excitations; `numbered`, each with its number, and with their stations.
   subroutine list_excitations(excitations, v, numbered, stations)
      type(excitation_type), intent(inout) :: excitations(:)
      type(variable_table_type), intent(inout) :: v
      logical, intent(in) :: numbered, stations
      integer :: i
      do i = 1, size(excitations)
         if (numbered) call v%behind_group(counted(i))
         call v%group('excitation', 'A force over time on the rotor, for the tasks march and periodic; one group for ' &
            & //'each; *Excitation* above')
         if (stations) call list_station(excitations(i)%station, v)
         call list_excitation(excitations(i), v)
      end do
      call v%behind_group('')
   end subroutine list_excitations

   subroutine list_excitation(x, v)
      type(excitation_type), intent(inout) :: x
      type(variable_table_type), intent(inout) :: v
      call v%word(x%kind, 'kind', 'harmonic chirp step ramp table', &
         & 'harmonic: a vibration; chirp: one whose frequency changes linearly; step: constant from start to end; ' &
         & //'ramp: from 0 at start to amplitude at end, which it keeps; table: forces from a file')
      call v%number(x%amplitude, 'amplitude', 0.0_wp, 1e12_wp, 'N', 'amplitude of the force; not of a table')
      call v%number(x%direction_deg, 'direction_deg', -360.0_wp, 360.0_wp, 'deg', &
         & 'direction, from +y towards +z; of a rotating force at phase 0')
      call v%word(x%rotating, 'rotating', 'no forward backward', &
         & 'harmonic, chirp: whether the force turns, with the shaft or against it; no: it keeps its direction')
      call v%number(x%frequency_hz, 'frequency_hz', 1e-6_wp, 1e7_wp, 'Hz', &
         & 'harmonic: frequency; chirp: frequency at start')
      call v%number(x%frequency_ratio, 'frequency_ratio', 1e-6_wp, 1e6_wp, '1', &
         & 'harmonic: frequency over the speed of the shaft, instead of frequency_hz')
      call v%number(x%final_frequency_hz, 'final_frequency_hz', 1e-6_wp, 1e7_wp, 'Hz', 'chirp: frequency at end')
      call v%number(x%phase_deg, 'phase_deg', -360.0_wp, 360.0_wp, 'deg', &
         & 'harmonic, chirp: phase at start, where 0 is the whole amplitude')
      call v%number(x%start, 'start', 0.0_wp, 1e6_wp, 's', 'when it begins; of a table the time 0')
      call v%number(x%end, 'end', 0.0_wp, 1e6_wp, 's', 'when it ends; if left out, not before the run (chirp, ramp: ' &
         & //'with operation%duration)')
      call v%word(x%file, 'file', '', 'table: CSV file of the columns time, force_y, force_z, in s and N')
   end subroutine list_excitation
end module case_fields
