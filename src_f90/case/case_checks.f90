!> Checks of a case: what no single value can tell. A message names the variables, their values and what is allowed.
module case_checks
   use kinds, only: wp, degree
   use text, only: to_text
   use errors, only: error_type, require, refuse, add_context
   use case_groups, only: bearing_type, pivot_type, clearance_range, is_set
   use other_units, only: in_other_units
   use case_inputs, only: case_type
   use excitation_checks, only: check_excitations
   use excitations, only: excitation_type
   use rotor_groups, only: elastic_type, most_stations
   implicit none (type, external)
   private
   public :: check_case

   !> How far a pad that bends may reach from its pivot, deg.
   real(wp), parameter :: farthest = 90

   !> Most values in the blocks of all columns and pads, times four: 400 MB.
   real(wp), parameter :: most_in_blocks = 2e8_wp
   !> Longest arc of a pad that tilts, deg.
   real(wp), parameter :: longest_arc = 350

contains

   !> Raises an error for the first requirement that a case does not meet.
   subroutine check_case(inputs, error)
      type(case_type), intent(in) :: inputs
      type(error_type), allocatable, intent(out) :: error
      integer :: b
      if (.not. inputs%rotor%is_rigid()) then
         call check_machine(inputs, error)
         if (.not. allocated(error)) call check_start(inputs, inputs%bearings(1), error)
      end if
      do b = 1, size(inputs%bearings)
         if (allocated(error)) return
         call check_groups(inputs, inputs%bearings(b), error)
         call add_context(error, inputs%bearings(b)%label())
      end do
      call check_output(inputs, error)
      call check_tasks(inputs, error)
      call check_shape(inputs, error)
      call check_branch(inputs, error)
      call check_excitations(inputs, error)
   end subroutine check_case

   !> The groups of one bearing.
   subroutine check_groups(inputs, bearing, error)
      type(case_type), intent(in) :: inputs
      type(bearing_type), intent(in) :: bearing
      type(error_type), allocatable, intent(inout) :: error
      call check_film(bearing, error)
      call check_bearing(bearing, error)
      call check_thermal(inputs, bearing, error)
      call check_friction(bearing, error)
      call check_pivot(bearing%pivot, error)
      call check_start(inputs, bearing, error)
      call check_pads(bearing, error)
   end subroutine check_groups

   subroutine check_film(bearing, error)
      type(bearing_type), intent(in) :: bearing
      type(error_type), allocatable, intent(inout) :: error
      integer :: most
      associate (f => bearing%film, cells => bearing%film%circumferential_cells)
         if (mod(cells, 2) /= 0 .or. cells /= 0 .and. cells < 8) call refuse( &
            & 'film%circumferential_cells = '//to_text(cells)//': must be even, and 0 or at least 8', error)
         call require(f%axial_cells /= 1, 'film%axial_cells = 1: must be 2 or more, or 0 for enough', error)
         call require(f%solver /= 'fourier' .or. f%cavitation /= 'reynolds', 'film%solver = ''fourier''' &
            & //': needs film%cavitation = ''gumbel'' or ''none''; film%solver = ''auto'' knows ''reynolds''', error)
         ! where films cavitate, elimination keeps a block of (axial cells/2)**2 values a column and pad;
         ! 0 stands for some 100 columns
         most = int(sqrt(most_in_blocks/(max(cells, 100)*bearing%pad_count())))
         if (.not. (f%solver == 'sor' .or. f%cavitation /= 'reynolds' .or. f%axial_cells <= most)) call refuse( &
            & 'film%axial_cells = '//to_text(f%axial_cells)//': must be at most '//to_text(most) &
            & //' with film%circumferential_cells = '//to_text(cells)//' and '//to_text(bearing%pad_count()) &
            & //' pads, or film%solver = ''sor''', error)
      end associate
   end subroutine check_film

   subroutine check_bearing(b, error)
      type(bearing_type), intent(in) :: b
      type(error_type), allocatable, intent(inout) :: error
      character(len=:), allocatable :: pad
      real(wp) :: ratio
      integer :: i
      do i = 1, b%pad_count()
         pad = ' (both in m; pad '//to_text(i)//')'
         ratio = b%machined_clearance(i)/b%journal_radius
         if (.not. (ratio >= clearance_range(1) .and. ratio <= clearance_range(2))) call refuse( &
            & 'bearing%machined_clearance = '//to_text(b%machined_clearance(i))//': must be ' &
            & //to_text(clearance_range(1))//' to '//to_text(clearance_range(2))//' of bearing%journal_radius = ' &
            & //to_text(b%journal_radius)//pad//in_other_units(b%machined_clearance(i), &
            & 'bearing%machined_clearance', 'm', &
            & clearance_range(1)*b%journal_radius, clearance_range(2)*b%journal_radius), error)
         if (.not. (b%assembled_clearance(i) <= 2*b%machined_clearance(i))) call refuse( &
            & 'bearing%assembled_clearance = '//to_text(b%assembled_clearance(i)) &
            & //': must be at most twice bearing%machined_clearance = '//to_text(b%machined_clearance(i)) &
            & //pad, error)
         ratio = b%axial_length(i)/b%journal_radius
         if (.not. (ratio >= 0.02_wp .and. ratio <= 50)) call refuse('bearing%axial_length = ' &
            & //to_text(b%axial_length(i))//': must be 0.02 to 50 times bearing%journal_radius = ' &
            & //to_text(b%journal_radius)//pad//in_other_units(b%axial_length(i), &
            & 'bearing%axial_length', 'm', &
            & 0.02_wp*b%journal_radius, 50*b%journal_radius), error)
      end do
      if (.not. (b%cavitation_pressure <= min(b%supply_pressure, b%ambient_pressure) &
         & .or. b%film%cavitation == 'none')) call refuse('bearing%cavitation_pressure = ' &
         & //to_text(b%cavitation_pressure)//': must not exceed bearing%supply_pressure = ' &
         & //to_text(b%supply_pressure)//' and bearing%ambient_pressure = '//to_text(b%ambient_pressure), error)
   end subroutine check_bearing

   subroutine check_thermal(inputs, bearing, error)
      type(case_type), intent(in) :: inputs
      type(bearing_type), intent(in) :: bearing
      type(error_type), allocatable, intent(inout) :: error
      associate (t => inputs%thermal, oil => bearing%oil)
         call require(t%model == 'pad' .or. t%march == 'frozen', 'thermal%march = '''//t%march//''': has no effect ' &
            & //'but with thermal%model = ''pad''', error)
         call require(t%model == 'none' .or. oil%law /= 'constant', 'thermal%model = '''//t%model//''': needs an oil ' &
            & //'whose viscosity depends on its temperature: oil%grade, oil%kinematic_viscosity, or ' &
            & //'oil%reference_viscosity and oil%temperature_exponent', error)
         call require(t%march == 'frozen' .or. oil%groove_volume > 0, 'oil%groove_volume = 0: must be > 0 for ' &
            & //'thermal%march = ''groove''', error)
         call require(t%march == 'frozen' .or. inputs%start%from /= 'partial', 'start%from = ''partial'': is not for ' &
            & //'thermal%march = ''groove'', which begins at the equilibrium', error)
      end associate
   end subroutine check_thermal

   subroutine check_friction(bearing, error)
      type(bearing_type), intent(in) :: bearing
      type(error_type), allocatable, intent(inout) :: error
      integer :: i
      associate (f => bearing%friction)
         do i = 1, bearing%pad_count()
            if (.not. (f%dynamic_coefficient(i) <= f%static_coefficient(i))) call refuse( &
               & 'friction%dynamic_coefficient = '//to_text(f%dynamic_coefficient(i)) &
               & //': must not exceed friction%static_coefficient = '//to_text(f%static_coefficient(i)) &
               & //' (pad '//to_text(i)//')', error)
            call require(f%model /= 'lugre' .or. f%dynamic_coefficient(i) > 0, 'friction%dynamic_coefficient = 0: ' &
               & //'must be > 0 for model = ''lugre'' (pad '//to_text(i)//')', error)
         end do
         call require(bearing%tilting() .or. f%model == 'none', 'friction%model = '''//f%model//''': must be ' &
            & //'''none'' for pads%motion = ''fixed'', whose pads have no pivots', error)
      end associate
   end subroutine check_friction

   subroutine check_pivot(v, error)
      type(pivot_type), intent(in) :: v
      type(error_type), allocatable, intent(inout) :: error
      integer :: i
      call require(v%law /= 'table' .or. v%file /= '', 'pivot%file = '''': must name a CSV file for ' &
         & //'law = ''table''', error)
      call require(v%law == 'table' .or. v%file == '', 'pivot%file = '''//v%file &
         & //''': needs pivot%law = ''table''', error)
      do i = 1, size(v%socket_radius)
         if (.not. (v%radius_difference(i) <= 0.5_wp*v%socket_radius(i))) call refuse( &
            & 'pivot%radius_difference = '//to_text(v%radius_difference(i)) &
            & //': must be at most half of pivot%socket_radius = '//to_text(v%socket_radius(i)) &
            & //' (pad '//to_text(i)//')', error)
         call require(v%law /= 'hertz' .or. v%radius_difference(i) > 0, 'pivot%radius_difference = 0: must be > 0 ' &
            & //'for law = ''hertz'' (pad '//to_text(i)//')', error)
      end do
   end subroutine check_pivot

   subroutine check_start(inputs, bearing, error)
      type(case_type), intent(in) :: inputs
      type(bearing_type), intent(in) :: bearing
      type(error_type), allocatable, intent(inout) :: error
      associate (s => inputs%start)
         call require(s%from /= 'file' .or. s%file /= '', 'start%file = '''': must name a result for start%from = ' &
            & //'''file''', error)
         call require(s%from == 'file' .or. s%file == '', 'start%file = '''//s%file//''': needs start%from = ' &
            & //'''file'', not '''//s%from//'''', error)
         if (.not. (bearing%tilting() .or. all(abs([s%pad_tilt, s%pad_tilt_rate]) <= 0))) call refuse( &
            & 'start%pad_tilt = '//to_text(s%pad_tilt(1))//', pad_tilt_rate = '//to_text(s%pad_tilt_rate(1)) &
            & //': must be 0 for pads%motion = ''fixed''', error)
         if (.not. (bearing%tilting_radial() &
            & .or. all(abs([s%pivot_deflection, s%pivot_deflection_rate]) <= 0))) call refuse( &
            & 'start%pivot_deflection = '//to_text(s%pivot_deflection(1))//', pivot_deflection_rate = ' &
            & //to_text(s%pivot_deflection_rate(1))//': must be 0 for pads%motion = '''//bearing%pads%motion &
            & //'''', error)
      end associate
   end subroutine check_start

   !> When a march ends, and what it samples.
   subroutine check_output(inputs, error)
      type(case_type), intent(in) :: inputs
      type(error_type), allocatable, intent(inout) :: error
      associate (periodic => inputs%integration%stop_when_periodic)
         if (.not. (periodic <= 0 .or. inputs%is_steady())) call refuse('integration%stop_when_periodic = ' &
            & //to_text(periodic) &
            & //': must be 0 where operation%final_speed_rpm differs from operation%speed_rpm', error)
      end associate
      associate (output => inputs%output, duration => inputs%operation%duration)
         if (.not. (output%start_time <= duration)) call refuse('output%start_time = '//to_text(output%start_time) &
            & //': must not exceed operation%duration = '//to_text(duration), error)
         if (.not. (duration*inputs%highest_speed()/360/degree*output%samples_per_revolution < 1e9_wp)) call refuse( &
            & 'operation%duration = '//to_text(duration) &
            & //': more than 1e9 samples at output%samples_per_revolution = ' &
            & //to_text(output%samples_per_revolution), error)
         call require(inputs%about%task /= 'branch' .or. output%keep == 'all', 'output%keep = '''//output%keep &
            & //''': must be ''all'' with case%task = ''branch'', whose results are its points', error)
      end associate
   end subroutine check_output

   subroutine check_pads(bearing, error)
      type(bearing_type), intent(in) :: bearing
      type(error_type), allocatable, intent(inout) :: error
      real(wp) :: smallest
      integer :: i
      associate (p => bearing%pads)
         do i = 1, bearing%pad_count()
            call require_room(bearing, i, error)
            if (.not. bearing%tilting()) cycle
            if (.not. (p%arc_deg(i) <= longest_arc)) call refuse('pads%arc_deg = '//to_text(p%arc_deg(i)) &
               & //': must be at most '//to_text(longest_arc)//' for pads that tilt', error)
            smallest = p%mass(i)*(p%centre_tangential(i)**2 + p%centre_radial(i)**2)
            if (.not. (p%inertia(i) > smallest)) call refuse('pads%inertia = '//to_text(p%inertia(i)) &
               & //': must exceed pads%mass = '//to_text(p%mass(i))//' times the squared distance of the centre of ' &
               & //'gravity from the pivot, '//to_text(smallest)//' (pad '//to_text(i)//')' &
               & //in_other_units(p%mass(i), 'pads%mass', 'kg', 0.0_wp, p%mass(i)*p%inertia(i)/smallest), error)
         end do
      end associate
   end subroutine check_pads

   !> A pad reaches from theta - theta_2 to theta + theta_1; the next one must start after that.
   subroutine require_room(bearing, i, error)
      type(bearing_type), intent(in) :: bearing
      integer, intent(in) :: i
      type(error_type), allocatable, intent(inout) :: error
      real(wp) :: distance
      integer :: j
      associate (p => bearing%pads)
         do j = 1, bearing%pad_count()
            if (i == j) cycle
            ! from pivot i on to pivot j, going up
            distance = modulo(p%pivot_angle_deg(j) - p%pivot_angle_deg(i), 360.0_wp)
            if (.not. (distance > p%pivot_ratio(i)*p%arc_deg(i) + (1 - p%pivot_ratio(j))*p%arc_deg(j))) call refuse( &
               & 'pads%pivot_angle_deg = '//to_text(p%pivot_angle_deg(i))//', '//to_text(p%pivot_angle_deg(j)) &
               & //': pads '//to_text(i)//' and '//to_text(j) &
               & //' overlap; the pivots must be further apart or pads%arc_deg smaller', error)
         end do
      end associate
   end subroutine require_room

   !> What some tasks cannot do: but for a march and an equilibrium the speed is constant.
   subroutine check_tasks(inputs, error)
      type(case_type), intent(in) :: inputs
      type(error_type), allocatable, intent(inout) :: error
      character(len=:), allocatable :: also
      associate (c => inputs%coefficients, o => inputs%operation, task => inputs%about%task)
         if (task == 'march' .or. task == 'equilibrium') return
         also = ''
         if (task == 'coefficients') also = '; a study varies the speed'
         if (.not. inputs%is_steady()) call refuse('operation%final_speed_rpm = '//to_text(o%final_speed_rpm) &
            & //': must be operation%speed_rpm = '//to_text(o%speed_rpm)//' with case%task = '''//task//'''' &
            & //also, error)
         if (task /= 'coefficients') return
         if (c%threshold_up_to_rpm > 0 .and. c%threshold_up_to_rpm <= o%speed_rpm) call refuse( &
            & 'coefficients%threshold_up_to_rpm = '//to_text(c%threshold_up_to_rpm) &
            & //': must be 0 or above operation%speed_rpm = '//to_text(o%speed_rpm) &
            & //', where the search starts', error)
      end associate
   end subroutine check_tasks

   !> A branch needs a parameter; `case_parameter` checks what it, its last value and its step mean.
   subroutine check_branch(inputs, error)
      type(case_type), intent(in) :: inputs
      type(error_type), allocatable, intent(inout) :: error
      if (inputs%about%task /= 'branch') return
      associate (b => inputs%branch)
         call require(b%parameter /= '', 'branch%parameter = '''': must name a number of the input, such as ' &
            & //'''operation%speed_rpm''', error)
         if (is_set(b%step) .and. b%max_step > 0 .and. b%max_step < abs(b%step)) call refuse('branch%max_step = ' &
            & //to_text(b%max_step)//': must be 0 or at least the size of branch%step = '//to_text(b%step), error)
         call require(b%switch .or. b%of == 'periodic', 'branch%switch = .false.: has no effect on a branch of ' &
            & //'equilibria', error)
      end associate
   end subroutine check_branch

   ! Checks of a machine: what no single value of its shaft and of what stands on it or under it can tell. A message
   ! names the group, its variables, their values and what is allowed.

   !> Raises an error for the first requirement that a machine does not meet.
   subroutine check_machine(inputs, error)
      type(case_type), intent(in) :: inputs
      type(error_type), allocatable, intent(inout) :: error
      associate (s => inputs%start, q => inputs%coefficients%cross_stiffness)
         call check_shaft(inputs%rotor%elastic, error)
         call check_bearings(inputs%bearings, inputs%rotor%station_count(), error)
         call check_parts(inputs%rotor%elastic, inputs%excitations, inputs%rotor%station_count(), error)
         call check_supports(inputs%bearings, error)
         call require(any(s%from == ['equilibrium', 'file       ']), 'start%from = '''//s%from//''': must be ' &
            & //'''equilibrium'' or ''file'' for a machine', error)
         if (abs(q) > 0) call refuse('coefficients%cross_stiffness = '//to_text(q)//': must be 0 for a machine', error)
      end associate
   end subroutine check_machine

   !> A shaft or a rotor from a file, and every section a tube.
   subroutine check_shaft(elastic, error)
      type(elastic_type), intent(in) :: elastic
      type(error_type), allocatable, intent(inout) :: error
      integer :: i
      associate (shaft => elastic%shaft)
         if (.not. shaft%is_given()) then
            call require(elastic%rotor_file /= '', 'shaft%length: must be given, the lengths of the shaft''s ' &
               & //'sections; or rotor%file, the matrices of a rotor', error)
            return
         end if
         call require(elastic%rotor_file == '', 'rotor%file = '''//elastic%rotor_file//''': shaft%length is given ' &
            & //'too; give one of them', error)
         call require(all(is_set(shaft%length)), 'shaft%length: every section needs one', error)
         call require(all(is_set(shaft%diameter)), 'shaft%diameter: must be given, of each of the '// &
            & to_text(size(shaft%length))//' sections', error)
         do i = 1, size(shaft%length)
            if (.not. shaft%bore(i) < shaft%diameter(i)) call refuse('shaft%bore = '//to_text(shaft%bore(i)) &
               & //': must be below shaft%diameter = '//to_text(shaft%diameter(i))//' (section '//to_text(i)//')', &
               & error)
         end do
      end associate
   end subroutine check_shaft

   !> Enough bearings, each at a station of its own.
   subroutine check_bearings(bearings, stations, error)
      type(bearing_type), intent(in) :: bearings(:)
      integer, intent(in) :: stations
      type(error_type), allocatable, intent(inout) :: error
      integer :: b, c
      if (size(bearings) < 2) call refuse('a machine needs two or more groups &bearing, each with a name; there ' &
         & //trim(merge('are none', 'is one  ', size(bearings) == 0)), error)
      do b = 1, size(bearings)
         call check_station('bearing'//bearings(b)%suffix(), bearings(b)%station, stations, error)
         do c = 1, b - 1
            if (bearings(b)%station == bearings(c)%station) call refuse('bearing'//bearings(b)%suffix() &
               & //'%station = '//to_text(bearings(b)%station)//': is that of '//bearings(c)%label(' already'), error)
         end do
      end do
   end subroutine check_bearings

   !> What is on the shaft is at its stations.
   subroutine check_parts(elastic, excitations, stations, error)
      type(elastic_type), intent(in) :: elastic
      type(excitation_type), intent(in) :: excitations(:)
      integer, intent(in) :: stations
      type(error_type), allocatable, intent(inout) :: error
      integer :: i
      do i = 1, size(elastic%discs)
         associate (disc => elastic%discs(i))
            call check_station('disc('//to_text(i)//')', disc%station, stations, error)
            ! the moments of inertia of any body
            if (.not. disc%polar_inertia <= 2*disc%diametral_inertia) call refuse('disc('//to_text(i) &
               & //')%polar_inertia = '//to_text(disc%polar_inertia)//': must be at most twice diametral_inertia = ' &
               & //to_text(disc%diametral_inertia), error)
         end associate
      end do
      do i = 1, size(elastic%unbalances)
         call check_station('unbalance('//to_text(i)//')', elastic%unbalances(i)%station, stations, error)
      end do
      do i = 1, size(elastic%loads)
         call check_station('load('//to_text(i)//')', elastic%loads(i)%station, stations, error)
      end do
      do i = 1, size(excitations)
         call check_station('excitation('//to_text(i)//')', excitations(i)%station, stations, error)
      end do
   end subroutine check_parts

   !> A support holds the bearing.
   subroutine check_supports(bearings, error)
      type(bearing_type), intent(in) :: bearings(:)
      type(error_type), allocatable, intent(inout) :: error
      integer :: b
      do b = 1, size(bearings)
         if (.not. allocated(bearings(b)%support)) cycle
         associate (k => bearings(b)%support%stiffness, mass => bearings(b)%support%mass, &
            & group => 'support'//bearings(b)%suffix())
            if (.not. mass > 0) call refuse(group//'%mass = '//to_text(mass)//': must be above 0, kg', error)
            if (.not. all(is_set(k))) then
               call refuse(group//'%stiffness: must be given, along y and z', error)
            else if (.not. all(k > 0)) then
               call refuse(group//'%stiffness = '//to_text(minval(k))//': must be above 0 along y and z', error)
            end if
         end associate
      end do
   end subroutine check_supports

   !> Refuses a station that is left out or that the shaft, of this number of stations, does not have.
   subroutine check_station(group, station, stations, error)
      character(len=*), intent(in) :: group
      integer, intent(in) :: station, stations
      type(error_type), allocatable, intent(inout) :: error
      integer :: last
      last = stations
      if (last == 0) last = most_stations
      if (station == 0) then
         call refuse(group//'%station: must be given, 1 to '//to_text(last), error)
      else if (station > last) then
         call refuse(group//'%station = '//to_text(station)//': must be 1 to '//to_text(last)//', the stations of ' &
            & //'the shaft, of which there is one more than sections', error)
      end if
   end subroutine check_station

   ! Checks of bent pads and of clearances that heat changes: which cases have them, and what they need.

   !> Raises an error for the first requirement that a case does not meet.
   subroutine check_shape(inputs, error)
      type(case_type), intent(in) :: inputs
      type(error_type), allocatable, intent(inout) :: error
      integer :: b
      do b = 1, size(inputs%bearings)
         associate (bearing => inputs%bearings(b))
            if (.not. bearing%changes_shape()) cycle
            if (allocated(error)) return
            call check_shape_tasks(inputs, what(bearing), error)
            if (bearing%pads%bending /= 'none') call check_bending(bearing, inputs%thermal%model, error)
            if (is_set(bearing%clearance_temperature)) call check_expansion(bearing, inputs%thermal%model, error)
            call add_context(error, bearing%label())
         end associate
      end do
   end subroutine check_shape

   !> The variable that changes the shape, with its value.
   function what(bearing)
      type(bearing_type), intent(in) :: bearing
      character(len=:), allocatable :: what
      if (bearing%pads%bending /= 'none') then
         what = 'pads%bending = '''//bearing%pads%bending//''''
      else
         what = 'bearing%clearance_temperature = '//to_text(bearing%clearance_temperature)
      end if
   end function what

   !> Shapes are those of one equilibrium; `what` changes them.
   subroutine check_shape_tasks(inputs, what, error)
      type(case_type), intent(in) :: inputs
      character(len=*), intent(in) :: what
      type(error_type), allocatable, intent(inout) :: error
      call require(inputs%about%task /= 'branch', what//': is not for case%task = ''branch''; a study of ' &
         & //'equilibria finds the shape of each', error)
      call require(.not. inputs%coefficients%threshold_up_to_rpm > 0, 'coefficients%threshold_up_to_rpm = ' &
         & //to_text(inputs%coefficients%threshold_up_to_rpm)//': is not for '//what//'; a study of ' &
         & //'coefficients over the speed finds the shape at each', error)
      call require(inputs%start%from /= 'partial', 'start%from = ''partial'': is not for '//what &
         & //', which starts at the equilibrium', error)
      call require(inputs%thermal%march == 'frozen', 'thermal%march = '''//inputs%thermal%march//''': is not for ' &
         & //what//'; ''frozen'' keeps oil and shape of the start', error)
   end subroutine check_shape_tasks

   subroutine check_bending(bearing, thermal_model, error)
      type(bearing_type), intent(in) :: bearing
      character(len=*), intent(in) :: thermal_model
      type(error_type), allocatable, intent(inout) :: error
      integer :: i
      associate (p => bearing%pads)
         call require(bearing%tilting(), what(bearing)//': is for pads that tilt on a pivot; pads%motion = ''fixed'' ' &
            & //'has none', error)
         call require(p%bending == 'elastic' .or. thermal_model == 'film', what(bearing)//': needs the ' &
            & //'temperatures in the pads, thermal%model = ''film''; ''elastic'' does not', error)
         do i = 1, bearing%pad_count()
            if (.not. p%arc_deg(i)*max(p%pivot_ratio(i), 1 - p%pivot_ratio(i)) <= farthest) call refuse( &
               & 'pads%arc_deg = '//to_text(p%arc_deg(i))//': a pad that bends may reach at most ' &
               & //to_text(farthest)//' deg from its pivot (pad '//to_text(i)//')', error)
         end do
      end associate
   end subroutine check_bending

   subroutine check_expansion(bearing, thermal_model, error)
      type(bearing_type), intent(in) :: bearing
      character(len=*), intent(in) :: thermal_model
      type(error_type), allocatable, intent(inout) :: error
      integer :: i
      call require(thermal_model /= 'none' .or. is_set(bearing%oil%shaft_temperature), what(bearing)//': needs ' &
         & //'oil%shaft_temperature, or thermal%model = ''pad'' or ''film'', which give the shaft''s', error)
      do i = 1, bearing%pad_count()
         call require(thermal_model == 'film' .or. is_set(bearing%pads%temperature(i)), what(bearing)//': needs ' &
            & //'pads%temperature, or thermal%model = ''film'', which gives it (pad '//to_text(i)//')', error)
      end do
   end subroutine check_expansion
end module case_checks
