!> Checks of a case: what no single value can tell. A message names the variables, their values and what is allowed.
module case_checks
   use kinds, only: wp, degree
   use text, only: to_text, filled, list_text
   use errors, only: error_type, require, refuse, add_context
   use case_groups, only: bearing_type, clearance_range, in_range, is_set
   use other_units, only: in_other_units
   use case_inputs, only: case_type
   use excitations, only: excitation_type
   use branch_checks, only: check_branch
   use machine_checks, only: check_machine, check_element_tables
   use lateral_checks, only: check_lateral
   implicit none (type, external)
   private
   public :: check_case

   !> How far a pad that bends may reach from its pivot, deg.
   real(wp), parameter :: farthest = 90

   !> Most values in the blocks of all columns and pads, times four: 400 MB.
   real(wp), parameter :: most_in_blocks = 2e8_wp
   !> Longest arc of a pad that tilts, deg.
   real(wp), parameter :: longest_arc = 350
   !> Axial length over the radius of the journal that is allowed.
   real(wp), parameter :: length_range(2) = [0.02_wp, 50.0_wp]
   !> Difference of the radii of a rocker and its bore, over that of the bore, that is allowed.
   real(wp), parameter :: rocker_range(2) = [0.01_wp, 0.9999_wp]
   !> Behind messages on lengths of a pad.
   character(len=*), parameter :: in_metres = ' (both in m; pad {})'

contains

   !> Raises an error for the first requirement that a case does not meet.
   subroutine check_case(inputs, error)
      type(case_type), intent(in) :: inputs
      type(error_type), allocatable, intent(out) :: error
      integer :: b
      ! long: a list of checks, below
      if (.not. inputs%rotor%is_rigid()) then
         associate (s => inputs%start)
            call check_machine(inputs, error)
            call require(any(s%from == ['equilibrium', 'file       ']), 'start%from = '''//s%from//''': must be ' &
               & //'''equilibrium'' or ''file'' for a machine', error)
            if (.not. allocated(error) .and. size(inputs%bearings) == 0) call check_start(bearing_type())
         end associate
      end if
      do b = 1, size(inputs%bearings)
         if (allocated(error)) return
         associate (bearing => inputs%bearings(b))
            call check_bearing(bearing)
            call check_laws(bearing)
            call check_start(bearing)
            call check_pads(bearing)
            call require(any(inputs%inclined() == b) .or. .not. any(abs(bearing%misalignment) > 0), &
               & 'bearing%misalignment = {}, {}: has no effect where films ignore slopes; bearing%shaft_slope = ' &
               & //'''film'' counts them', bearing%misalignment, error)
            call check_slopes(bearing, inputs%thermal%model, inputs%has_slopes(b), any(inputs%inclined() == b), error)
            call add_context(error, bearing%label())
         end associate
      end do
      call check_run()
      do b = 1, size(inputs%bearings)
         if (allocated(error)) return
         if (inputs%bearings(b)%changes_shape()) call check_shape(inputs%bearings(b))
         call add_context(error, inputs%bearings(b)%label())
      end do
      call check_branch(inputs, error)
      call check_held()
      call check_excitations()
      call check_lateral(inputs, error)
      call check_element_tables(inputs, error)
   contains
      !> Solver of the films, and sizes of a bearing.
      subroutine check_bearing(bearing)
         type(bearing_type), intent(in) :: bearing
         integer :: most, i
         associate (f => bearing%film, cells => bearing%film%circumferential_cells)
            call require(mod(cells, 2) == 0 .and. (cells == 0 .or. cells >= 8), 'film%circumferential_cells = {}: ' &
               & //'must be even, and 0 or at least 8', [real(cells, wp)], error)
            call require(f%axial_cells /= 1, 'film%axial_cells = 1: must be 2 or more, or 0 for enough', error)
            call require(f%solver /= 'fourier' .or. f%cavitation /= 'reynolds', 'film%solver = ''fourier''' &
               & //': needs film%cavitation = ''gumbel'' or ''none''; film%solver = ''auto'' knows ''reynolds''', error)
            ! where films cavitate, elimination keeps a block of (axial cells/2)**2 values a column and pad;
            ! 0 stands for some 100 columns
            most = int(sqrt(most_in_blocks/(max(cells, 100)*bearing%pad_count())))
            call require(f%solver == 'sor' .or. f%cavitation /= 'reynolds' .or. f%axial_cells <= most, &
               & 'film%axial_cells = {}: must be at most {} with film%circumferential_cells = {} and {} pads, or ' &
               & //'film%solver = ''sor''', [real(wp) :: f%axial_cells, most, cells, bearing%pad_count()], error)
            call require(f%turbulent_above > f%laminar_below, 'film%turbulent_above = {}: must be above ' &
               & //'film%laminar_below = {}', [f%turbulent_above, f%laminar_below], error)
            call require(f%turbulence /= 'hirs' .or. any(inputs%about%task == [character(len=12) :: 'equilibrium', &
               & 'coefficients']), 'film%turbulence = ''hirs'': bends where its laminar values end, and ' &
               & //'serves no motion; ''ng_pan'' does', error)
         end associate
         associate (machined => bearing%machined_clearance, assembled => bearing%assembled_clearance, &
               & radius => bearing%journal_radius)
            do i = 1, bearing%pad_count()
               if (.not. in_range(machined(i)/radius, clearance_range)) call refuse(filled( &
                  & 'bearing%machined_clearance = {}: must be {} to {} of bearing%journal_radius = {}'//in_metres, &
                  & [real(wp) :: machined(i), clearance_range, radius, i])//in_other_units(machined(i), &
                  & 'bearing%machined_clearance', 'm', clearance_range(1)*radius, clearance_range(2)*radius), error)
               call require(assembled(i) <= 2*machined(i), 'bearing%assembled_clearance = {}: must be at most twice ' &
                  & //'bearing%machined_clearance = {}'//in_metres, [real(wp) :: assembled(i), machined(i), i], error)
               if (.not. in_range(bearing%axial_length(i)/radius, length_range)) call refuse(filled( &
                  & 'bearing%axial_length = {}: must be {} to {} times bearing%journal_radius = {}'//in_metres, &
                  & [real(wp) :: bearing%axial_length(i), length_range, radius, i])//in_other_units( &
                  & bearing%axial_length(i), 'bearing%axial_length', 'm', length_range(1)*radius, &
                  & length_range(2)*radius), error)
            end do
         end associate
         call require(bearing%cavitation_pressure <= min(bearing%supply_pressure, bearing%ambient_pressure) &
            & .or. bearing%film%cavitation == 'none', 'bearing%cavitation_pressure = {}: must not exceed ' &
            & //'bearing%supply_pressure = {} and bearing%ambient_pressure = {}', &
            & [bearing%cavitation_pressure, bearing%supply_pressure, bearing%ambient_pressure], error)
      end subroutine check_bearing

      !> Heat, friction and pivots of a bearing.
      subroutine check_laws(bearing)
         type(bearing_type), intent(in) :: bearing
         integer :: i
         associate (t => inputs%thermal, oil => bearing%oil)
            call require(t%model == 'pad' .or. t%march == 'frozen', 'thermal%march = '''//t%march//''': has no ' &
               & //'effect but with thermal%model = ''pad''', error)
            call require(t%model == 'none' .or. oil%law /= 'constant', 'thermal%model = '''//t%model//''': needs an ' &
               & //'oil whose viscosity depends on its temperature: oil%grade, oil%kinematic_viscosity, or ' &
               & //'oil%reference_viscosity and oil%temperature_exponent', error)
            call require(t%march == 'frozen' .or. oil%groove_volume > 0, 'oil%groove_volume = 0: must be > 0 for ' &
               & //'thermal%march = ''groove''', error)
            call require(t%march == 'frozen' .or. inputs%start%from /= 'partial', 'start%from = ''partial'': is not ' &
               & //'for thermal%march = ''groove'', which begins at the equilibrium', error)
         end associate
         associate (f => bearing%friction, static => bearing%friction%static_coefficient, &
               & dynamic => bearing%friction%dynamic_coefficient)
            do i = 1, bearing%pad_count()
               call require(dynamic(i) <= static(i), 'friction%dynamic_coefficient = {}: must not exceed ' &
                  & //'friction%static_coefficient = {} (pad {})', [real(wp) :: dynamic(i), static(i), i], error)
               call require(f%model /= 'lugre' .or. dynamic(i) > 0, 'friction%dynamic_coefficient = 0: must be > 0 ' &
                  & //'for model = ''lugre'' (pad {})', [real(i, wp)], error)
            end do
            call require(bearing%tilting() .or. f%model == 'none', 'friction%model = '''//f%model//''': must be ' &
               & //'''none'' for pads%motion = ''fixed'', whose pads have no pivots', error)
         end associate
         associate (v => bearing%pivot)
            call require(bearing%tilting() .or. all(v%rotational_stiffness <= 0), 'pivot%rotational_stiffness = {}: ' &
               & //'must be 0 for pads%motion = ''fixed'', whose pads do not tilt', [maxval(v%rotational_stiffness)], &
               & error)
            do i = 1, size(v%socket_radius)
               call require(v%law /= 'table' .or. v%file_of(i) /= '', 'pivot%file = '''': must name a CSV file for ' &
                  & //'law = ''table'' (pad {})', [real(i, wp)], error)
               call require(v%law == 'table' .or. v%file_of(i) == '', 'pivot%file = '''//v%file_of(i) &
                  & //''': needs pivot%law = ''table''', error)
               call require(v%law /= 'linear' .or. is_set(v%stiffness(i)), 'pivot%stiffness: must be given for ' &
                  & //'pivot%law = ''linear'' (pad {})', [real(i, wp)], error)
               call require(v%law == 'linear' .or. .not. is_set(v%stiffness(i)), 'pivot%stiffness = {}: needs ' &
                  & //'pivot%law = ''linear'', not '''//v%law//'''', [v%stiffness(i)], error)
               if (v%law == 'rocker') call check_rocker(bearing, i)
               call require(v%law == 'rocker' .or. .not. is_set(v%contact_length(i)), 'pivot%contact_length = {}: ' &
                  & //'needs pivot%law = ''rocker'', not '''//v%law//'''', [v%contact_length(i)], error)
               call require(v%law == 'rocker' .or. v%radius_difference(i) <= 0.5_wp*v%socket_radius(i), &
                  & 'pivot%radius_difference = {}: must be at most half of pivot%socket_radius = {} (pad {})', &
                  & [real(wp) :: v%radius_difference(i), v%socket_radius(i), i], error)
               call require(v%law /= 'hertz' .or. v%radius_difference(i) > 0, 'pivot%radius_difference = 0: must be ' &
                  & //'> 0 for law = ''hertz'' (pad {})', [real(i, wp)], error)
            end do
         end associate
      end subroutine check_laws

      !> A rocker is a cylinder in a wider one, whose contact is narrow, and rolls.
      subroutine check_rocker(bearing, i)
         type(bearing_type), intent(in) :: bearing
         integer, intent(in) :: i
         associate (v => bearing%pivot, dr => bearing%pivot%radius_difference(i), f => bearing%friction%model)
            call require(in_range(dr/v%socket_radius(i), rocker_range), 'pivot%radius_difference = {}: must be {} to ' &
               & //'{} of pivot%socket_radius = {} for pivot%law = ''rocker'' (pad {})', [real(wp) :: dr, &
               & rocker_range, v%socket_radius(i), i], error)
            call require(v%contact_length(i) <= bearing%axial_length(i), 'pivot%contact_length = {}: must be at most ' &
               & //'bearing%axial_length = {}'//in_metres, [real(wp) :: v%contact_length(i), bearing%axial_length(i), &
               & i], error)
            call require(f == 'none', 'friction%model = '''//f//''': must be ''none'' for pivot%law = ''rocker'', ' &
               & //'which rolls', error)
            call require(v%wear_coefficient <= 0, 'pivot%wear_coefficient = {}: must be 0 for pivot%law = ' &
               & //'''rocker'', which rolls', [v%wear_coefficient], error)
         end associate
      end subroutine check_rocker

      subroutine check_start(bearing)
         type(bearing_type), intent(in) :: bearing
         associate (s => inputs%start)
            call require(s%from /= 'file' .or. s%file /= '', 'start%file = '''': must name a result for start%from = ' &
               & //'''file''', error)
            call require(s%from == 'file' .or. s%file == '', 'start%file = '''//s%file//''': needs start%from = ' &
               & //'''file'', not '''//s%from//'''', error)
            call check_moved(bearing, bearing%tilting(), 'pad_tilt', s%pad_tilt, s%pad_tilt_rate)
            call check_moved(bearing, bearing%tilting_radial(), 'pivot_deflection', s%pivot_deflection, &
               & s%pivot_deflection_rate)
            call check_moved(bearing, bearing%pitching(), 'pad_pitch', s%pad_pitch, s%pad_pitch_rate)
            call check_moved(bearing, bearing%yawing(), 'pad_yaw', s%pad_yaw, s%pad_yaw_rate)
         end associate
      end subroutine check_start

      !> Pads start only where they can move to.
      subroutine check_moved(bearing, moves, name, values, rates)
         type(bearing_type), intent(in) :: bearing
         logical, intent(in) :: moves
         character(len=*), intent(in) :: name
         real(wp), intent(in) :: values(:), rates(:)
         call require(moves .or. all(abs([values, rates]) <= 0), 'start%'//name//' = {}, '//name//'_rate = {}: must ' &
            & //'be 0 for pads%motion = '''//bearing%pads%motion//'''', [values(1), rates(1)], error)
      end subroutine check_moved

      subroutine check_pads(bearing)
         type(bearing_type), intent(in) :: bearing
         real(wp) :: smallest
         integer :: i
         associate (p => bearing%pads)
            do i = 1, bearing%pad_count()
               call require_room(bearing, i)
               if (.not. bearing%tilting()) cycle
               call require(p%arc_deg(i) <= longest_arc, 'pads%arc_deg = {}: must be at most {} for pads that tilt', &
                  & [p%arc_deg(i), longest_arc], error)
               smallest = p%mass(i)*(p%centre_tangential(i)**2 + p%centre_radial(i)**2)
               if (.not. (p%inertia(i) > smallest)) call refuse(filled('pads%inertia = {}: must exceed pads%mass = ' &
                  & //'{} times the squared distance of the centre of gravity from the pivot, {} (pad {})', [real( &
                  & wp) :: p%inertia(i), p%mass(i), smallest, i])//in_other_units(p%mass(i), 'pads%mass', 'kg', &
                  & 0.0_wp, p%mass(i)*p%inertia(i)/smallest), error)
            end do
         end associate
      end subroutine check_pads

      !> A pad reaches from theta - theta_2 to theta + theta_1; the next one must start after that.
      subroutine require_room(bearing, i)
         type(bearing_type), intent(in) :: bearing
         integer, intent(in) :: i
         real(wp) :: distance
         integer :: j
         associate (p => bearing%pads, at => bearing%pads%pivot_angle_deg)
            do j = 1, bearing%pad_count()
               if (i == j) cycle
               ! from pivot i on to pivot j, going up
               distance = modulo(at(j) - at(i), 360.0_wp)
               call require(distance > p%pivot_ratio(i)*p%arc_deg(i) + (1 - p%pivot_ratio(j))*p%arc_deg(j), &
                  & 'pads%pivot_angle_deg = {}, {}: pads {} and {} overlap; the pivots must be further apart or ' &
                  & //'pads%arc_deg smaller', [real(wp) :: at(i), at(j), i, j], error)
            end do
         end associate
      end subroutine require_room

      !> When a march ends and what it samples; but for a march and an equilibrium the speed is constant.
      subroutine check_run()
         character(len=:), allocatable :: also
         associate (periodic => inputs%integration%stop_when_periodic, output => inputs%output, o => inputs%operation, &
               & task => inputs%about%task, limit => inputs%coefficients%threshold_up_to_rpm)
            call require(periodic <= 0 .or. inputs%is_steady(), 'integration%stop_when_periodic = {}: must be 0 ' &
               & //'where operation%final_speed_rpm differs from operation%speed_rpm', [periodic], error)
            call require(output%start_time <= o%duration, 'output%start_time = {}: must not exceed ' &
               & //'operation%duration = {}', [output%start_time, o%duration], error)
            call require(o%duration*inputs%highest_speed()/360/degree*output%samples_per_revolution < 1e9_wp, &
               & 'operation%duration = {}: more than 1e9 samples at output%samples_per_revolution = {i}', &
               & [real(wp) :: o%duration, output%samples_per_revolution], error)
            call require(task /= 'branch' .or. output%keep == 'all', 'output%keep = '''//output%keep//''': must be ' &
               & //'''all'' with case%task = ''branch'', whose results are its points', error)
            also = ''
            if (task == 'coefficients') also = '; a study varies the speed'
            call require(task == 'march' .or. task == 'equilibrium' .or. inputs%is_steady(), &
               & 'operation%final_speed_rpm = {}: must be operation%speed_rpm = {} with case%task = '''//task//'''' &
               & //also, [o%final_speed_rpm, o%speed_rpm], error)
            call require(task /= 'coefficients' .or. limit <= 0 .or. limit > o%speed_rpm, &
               & 'coefficients%threshold_up_to_rpm = {}: must be 0 or above operation%speed_rpm = {}, where the ' &
               & //'search starts', [limit, o%speed_rpm], error)
         end associate
      end subroutine check_run

      !> A journal is held at one place, where nothing moves, in a bearing that keeps its clearances.
      subroutine check_held()
         character(len=:), allocatable :: what
         if (.not. inputs%held%is_wanted()) return
         associate (held => inputs%held, task => inputs%about%task, r => inputs%rotor)
            what = 'held%eccentricity_ratio = '//to_text(held%eccentricity_ratio)
            if (any(is_set(held%position))) what = 'held%position = '//list_text(held%position)
            call require(.not. any(is_set(held%position)) .or. .not. any(is_set([held%eccentricity_ratio, &
               & held%attitude_deg])), what//': held%eccentricity_ratio or attitude_deg is given too; give one of ' &
               & //'them', error)
            call require(.not. any(is_set(held%position)) .or. all(is_set(held%position)), 'held%position: both y ' &
               & //'and z must be given', error)
            call require(any(is_set(held%position)) .or. is_set(held%eccentricity_ratio), 'held%attitude_deg = {}: ' &
               & //'needs held%eccentricity_ratio', [held%attitude_deg], error)
            call require(any(task == [character(len=12) :: 'equilibrium', 'coefficients']), what//': is for ' &
               & //'case%task = ''equilibrium'' and ''coefficients''; '''//task//''' lets the journal move, and ' &
               & //'start%from = ''given'' starts a march there', error)
            call require(.not. any(inputs%bearings%changes_shape()), what//': is not for pads%bending and ' &
               & //'bearing%clearance_temperature, which change the clearance; give the clearances in operation', error)
            call require(.not. any(is_set(held%position)) .or. .not. norm2(r%static_load) > 0, what//': ' &
               & //'rotor%static_load is given too, which follows from the position; take it out of the case', error)
            call require(any(is_set(held%position)) .or. norm2(r%static_load - [r%mass*r%gravity, 0.0_wp]) > 0, what &
               & //': needs a load, from whose direction the attitude counts (rotor%static_load)', error)
         end associate
      end subroutine check_held


      ! Checks of bent pads and of clearances that heat changes.

      !> Shapes are those of one equilibrium; bent pads and warm clearances need temperatures.
      subroutine check_shape(bearing)
         type(bearing_type), intent(in) :: bearing
         !> The variable that changes the shape, with its value.
         character(len=:), allocatable :: what
         integer :: i
         what = 'pads%bending = '''//bearing%pads%bending//''''
         if (bearing%pads%bending == 'none') what = 'bearing%clearance_temperature = ' &
            & //to_text(bearing%clearance_temperature)
         associate (p => bearing%pads, heat => inputs%thermal, limit => inputs%coefficients%threshold_up_to_rpm)
            call require(inputs%about%task /= 'branch', what//': is not for case%task = ''branch''; a study of ' &
               & //'equilibria finds the shape of each', error)
            call require(.not. limit > 0, 'coefficients%threshold_up_to_rpm = {}: is not for '//what//'; a study of ' &
               & //'coefficients over the speed finds the shape at each', [limit], error)
            call require(inputs%start%from /= 'partial', 'start%from = ''partial'': is not for '//what//', which ' &
               & //'starts at the equilibrium', error)
            call require(heat%march == 'frozen', 'thermal%march = '''//heat%march//''': is not for '//what &
               & //'; ''frozen'' keeps oil and shape of the start', error)
            if (p%bending /= 'none') then
               call require(bearing%tilting(), what//': is for pads that tilt on a pivot; pads%motion = ''fixed'' ' &
                  & //'has none', error)
               call require(p%bending == 'elastic' .or. heat%model == 'film', what//': needs the temperatures in the ' &
                  & //'pads, thermal%model = ''film''; ''elastic'' does not', error)
               do i = 1, bearing%pad_count()
                  call require(p%arc_deg(i)*max(p%pivot_ratio(i), 1 - p%pivot_ratio(i)) <= farthest, 'pads%arc_deg = ' &
                     & //'{}: a pad that bends may reach at most {} deg from its pivot (pad {})', &
                     & [real(wp) :: p%arc_deg(i), farthest, i], error)
               end do
            end if
            if (.not. is_set(bearing%clearance_temperature)) return
            call require(heat%model /= 'none' .or. is_set(bearing%oil%shaft_temperature), what//': needs ' &
               & //'oil%shaft_temperature, or thermal%model = ''pad'' or ''film'', which give the shaft''s', error)
            do i = 1, bearing%pad_count()
               call require(heat%model == 'film' .or. is_set(p%temperature(i)), what//': needs pads%temperature, or ' &
                  & //'thermal%model = ''film'', which gives it (pad {})', [real(i, wp)], error)
            end do
         end associate
      end subroutine check_shape

      ! Checks of excitations.

      !> Raises an error for the first requirement that the excitations of a case do not meet.
      subroutine check_excitations()
         integer :: i
         if (size(inputs%excitations) == 0) return
         call require(inputs%about%task /= 'branch', 'excitation: has no effect with case%task = ''branch''; a study ' &
            & //'varies a number of the input', error)
         associate (periodic => inputs%integration%stop_when_periodic)
            call require(inputs%about%task /= 'march' .or. periodic <= 0, 'integration%stop_when_periodic = {}: must ' &
               & //'be 0 with excitations; the task periodic finds the orbit under them', [periodic], error)
         end associate
         do i = 1, size(inputs%excitations)
            call check_values(inputs%excitations(i), 'excitation('//to_text(i)//')%', error)
            call check_times(inputs%excitations(i), 'excitation('//to_text(i)//')%')
            if (allocated(error)) return
         end do
      end subroutine check_excitations

      !> It acts before the run ends, and one of a periodic orbit always.
      subroutine check_times(x, name)
         type(excitation_type), intent(in) :: x
         character(len=*), intent(in) :: name
         call require(x%end > x%start .or. .not. is_set(x%end), name//'end = {}: must be above '//name//'start = {} ' &
            & //'(both in s)', [x%end, x%start], error)
         call require(inputs%about%task /= 'march' .or. x%start < inputs%operation%duration, name//'start = {}: must ' &
            & //'be below operation%duration = {}, when the run ends (both in s)', [x%start, &
            & inputs%operation%duration], error)
         if (.not. inputs%seeks_orbits()) return
         call require(x%kind == 'harmonic', name//'kind = '''//x%kind//''': must be ''harmonic'' for a periodic ' &
            & //'orbit', error)
         call require(x%start <= 0 .and. .not. is_set(x%end), name//'start = {}: must be 0 for a periodic orbit, and ' &
            & //'there is no end', [x%start], error)
      end subroutine check_times
   end subroutine check_case

   !> Pads that pitch and yaw, pivots off the middle plane, and a journal that is inclined.
   subroutine check_slopes(bearing, heat, slopes_count, on_shaft, error)
      type(bearing_type), intent(in) :: bearing
      !> thermal%model
      character(len=*), intent(in) :: heat
      logical, intent(in) :: slopes_count
      !> Whether they are those of an elastic shaft.
      logical, intent(in) :: on_shaft
      type(error_type), allocatable, intent(inout) :: error
      character(len=:), allocatable :: what, with, name
      real(wp) :: angle, closing, open
      integer :: i
      name = merge('misalignment', 'slope       ', on_shaft)
      associate (p => bearing%pads, slope => bearing%slope - bearing%misalignment)
         if (.not. slopes_count .and. .not. any(is_set([p%inertia_pitch, p%inertia_yaw])) &
            & .and. .not. any(abs(p%pivot_axial_offset) > 0)) return
         with = '; pads%motion = '''//p%motion//''' has none'
         do i = 1, bearing%pad_count()
            call require(bearing%pitching() .or. .not. is_set(p%inertia_pitch(i)), 'pads%inertia_pitch = {}: is for ' &
               & //'pads that pitch'//with, [p%inertia_pitch(i)], error)
            call require(bearing%yawing() .or. .not. is_set(p%inertia_yaw(i)), 'pads%inertia_yaw = {}: is for pads ' &
               & //'that yaw'//with, [p%inertia_yaw(i)], error)
            call require(bearing%pitching() .or. .not. abs(p%pivot_axial_offset(i)) > 0, 'pads%pivot_axial_offset = ' &
               & //'{}: is for pads that pitch'//with, [p%pivot_axial_offset(i)], error)
            call require(abs(p%pivot_axial_offset(i)) < 0.5_wp*bearing%axial_length(i), 'pads%pivot_axial_offset = ' &
               & //'{}: must be less than half of bearing%axial_length = {}'//in_metres, [real(wp) :: &
               & p%pivot_axial_offset(i), bearing%axial_length(i), i], error)
            if (bearing%pitching()) call require_inertia('pitch', p%inertia_pitch(i), p%centre_radial(i))
            if (bearing%yawing()) call require_inertia('yaw', p%inertia_yaw(i), p%centre_tangential(i))
            ! what no pad follows, where the journal is in the middle
            angle = p%pivot_angle_deg(i)*degree
            closing = 0.5_wp*bearing%axial_length(i)*abs(slope(1)*sin(angle) + slope(2)*cos(angle))
            open = bearing%assembled_clearance(i)
            if (bearing%pitching()) then
               closing = 0.5_wp*bearing%axial_length(i)*abs(slope(1)*cos(angle) - slope(2)*sin(angle)) &
                  & *sin(min(90.0_wp, p%arc_deg(i)*max(p%pivot_ratio(i), 1 - p%pivot_ratio(i)))*degree)
               open = bearing%machined_clearance(i)
            end if
            call require(bearing%yawing() .or. closing < open, 'bearing%'//trim(name)//' = {}, {}: closes the film ' &
               & //'of pad {} at rest, {} m at its ends where there are {} m; pads%motion = ''tilting_pitch_yaw'' ' &
               & //'lets it follow', [real(wp) :: bearing%slope + bearing%misalignment, i, closing, open], error)
         end do
         if (.not. slopes_count) return
         what = 'bearing%slope = '//list_text(bearing%slope)
         if (.not. any(abs(slope) > 0)) what = 'coefficients%slopes = .true.'
         if (on_shaft) what = 'bearing%shaft_slope = '''//bearing%shaft_slope//''''
         if (bearing%pitching()) what = 'pads%motion = '''//p%motion//''''
         call require(bearing%pivot%law /= 'rocker' .or. .not. bearing%pitching(), what//': is not for pivot%law = ' &
            & //'''rocker'', on whose line a pad does not pitch; the other laws have balls', error)
         call require(any(bearing%film%solver == ['auto  ', 'direct']), what//': is not for film%solver = ''' &
            & //bearing%film%solver//''', which knows no slopes; ''auto'' does', error)
         call require(heat /= 'film', what//': is not for thermal%model = ''film''; ''pad'' has a temperature for ' &
            & //'each pad, even over its width', error)
         call require(p%bending == 'none', what//': is not for pads%bending = '''//p%bending//'''; ''none'' is', error)
      end associate

   contains

      !> That of the pad's mass in its centre of gravity is less.
      subroutine require_inertia(name, inertia, distance)
         character(len=*), intent(in) :: name
         real(wp), intent(in) :: inertia, distance
         real(wp) :: least
         least = bearing%pads%mass(i)*(distance**2 + bearing%pads%pivot_axial_offset(i)**2)
         call require(inertia > least, 'pads%inertia_'//name//' = {}: must exceed {}, that of its mass in the centre ' &
            & //'of gravity (pad {})', [real(wp) :: inertia, least, i], error)
      end subroutine require_inertia
   end subroutine check_slopes

   !> What each kind needs, and what it has no use for.
   subroutine check_values(x, name, error)
      type(excitation_type), intent(in) :: x
      character(len=*), intent(in) :: name
      type(error_type), allocatable, intent(inout) :: error
      character(len=:), allocatable :: with
      logical :: vibrates
      with = ' with kind = '''//x%kind//''''
      vibrates = x%kind == 'harmonic' .or. x%kind == 'chirp'
      call need(x%kind == 'table', x%file /= '', 'file = '''//x%file//'''')
      call need(x%kind /= 'table', is_set(x%amplitude), 'amplitude')
      call need(x%kind == 'chirp', is_set(x%final_frequency_hz), 'final_frequency_hz')
      if (x%kind == 'chirp') call need(.true., is_set(x%frequency_hz), 'frequency_hz')
      if (x%kind /= 'harmonic') call need(.false., is_set(x%frequency_ratio), 'frequency_ratio')
      if (.not. vibrates) call need(.false., is_set(x%frequency_hz), 'frequency_hz')
      if (.not. vibrates) call need(.false., x%rotating /= 'no', 'rotating = '''//x%rotating//'''')
      if (.not. vibrates) call need(.false., abs(x%phase_deg) > 0, 'phase_deg')
      if (x%kind == 'table') call need(.false., abs(x%direction_deg) > 0, 'direction_deg')
      if (x%kind /= 'harmonic') return
      call require(is_set(x%frequency_hz) .or. is_set(x%frequency_ratio), name//'frequency_hz: must be given, or ' &
         & //'frequency_ratio', error)
      call require(.not. (is_set(x%frequency_hz) .and. is_set(x%frequency_ratio)), name//'frequency_ratio = {}: ' &
         & //'frequency_hz is given too; give one of them', [x%frequency_ratio], error)
   contains
      subroutine need(is_needed, is_given, variable)
         logical, intent(in) :: is_needed, is_given
         character(len=*), intent(in) :: variable
         call require(is_given .or. .not. is_needed, name//variable//': must be given'//with, error)
         call require(is_needed .or. .not. is_given, name//variable//': has no effect'//with, error)
      end subroutine need
   end subroutine check_values
end module case_checks
