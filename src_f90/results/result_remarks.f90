!> The remarks on a run: one list, of its case, its equilibrium and its motion, by the figures in its file. The file has
!> it as `summary/remarks`; console, report, plots and Python repeat it.
module result_remarks
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use kinds, only: wp, degree, pi
   use text, only: to_text, filled, line_if, behind, newline
   use case_groups, only: bearing_type
   use case_inputs, only: case_type
   use case_remarks, only: remarks_on_load, remark_on_unbalance
   use turbulence_closure, only: steepest
   use bearing_equilibrium, only: listed
   use pad_behaviour, only: pad_behaviour_type, smallest_share
   use revolution_points, only: disagreement, steady_ring, enough_points
   use rotor_reduction, only: far_above
   use record, only: record_type, lines
   use run_file, only: run_file_type
   use bearing_file, only: bearing_file_type, new_bearing_file
   use summary_group, only: figure, pad_figures, has_figure
   implicit none (type, external)
   private
   public :: remarks_on_run, put_remarks, new_lines, pad_diagnosis, not_closed

   !> What is said of a periodic orbit that is none: {} is its change.
   character(len=*), parameter :: not_closed = 'Newton''s method does not close the orbit: it is that of the march, ' &
      & //'whose displacements change by {} of their characteristic scales in a period'
   character(len=*), parameter :: name = 'summary/remarks'
   !> Reynolds number of a film above which it may be turbulent: published limits lie from here to 1500.
   real(wp), parameter :: laminar_up_to = 500
   !> Power n of the Reynolds number with which the resistance kx of a film may grow in its transition: its load goes
   !> with kx/h^2, that is h^(n - 2).
   real(wp), parameter :: steep_transition = 2
   !> Warming of oil, K, across which one viscosity does not hold, and temperature of white metal, C, near its limit.
   real(wp), parameter :: largest_rise = 50, warm_metal = 120
   !> Films thinner than this number of roughnesses touch.
   real(wp), parameter :: roughnesses = 3
   !> Part of the minimum thickness that a slope may change, of a shaft or a journal in pads that cannot follow.
   real(wp), parameter :: steep_slope = 0.1_wp
   !> Part of the clearance by which few pivots give way.
   real(wp), parameter :: soft_pivot = 0.2_wp
   !> Part of a pad's inflow that may be missing in its balance.
   real(wp), parameter :: visible_flow = 0.02_wp
   !> Error of amplitudes by the damping of high modes of a shaft, and the multiple of the highest speed from which on
   !> it is less.
   real(wp), parameter :: much_damping = 0.01_wp

contains

   !> All remarks on a run so far, a line each: those on its case, and others.
   function remarks_on_run(of_case, inputs, file) result(all)
      character(len=*), intent(in) :: of_case
      type(case_type), intent(in) :: inputs
      class(run_file_type), intent(inout), target :: file
      character(len=:), allocatable :: all, own
      type(bearing_file_type) :: part
      real(wp) :: loads(2, size(inputs%bearings))
      integer :: b
      all = of_case//on_damping(inputs, file)//on_unbalances(inputs, file)
      call file%get_list('equilibrium/bearing_load_y', loads(1, :))
      call file%get_list('equilibrium/bearing_load_z', loads(2, :))
      do b = 1, size(inputs%bearings)
         associate (bearing => inputs%bearings(b))
            part = new_bearing_file(file, bearing)
            own = ''
            if (part%has('equilibrium/journal_y')) then
               ! that of a rigid journal is known before the run
               if (.not. inputs%rotor%is_rigid()) own = remarks_on_load(inputs%alone(b, loads(:, b)))
               own = own//on_equilibrium(bearing, inputs%thermal%model, part)//on_pivots(bearing, part)
            end if
            all = all//behind(bearing%label(': '), own//on_motion(bearing%pad_count(), part))
         end associate
      end do
      if (.not. file%has('periodic/closed')) return
      all = all//line_if(.not. file%get_real('periodic/closed') > 0, not_closed, [file%get_real('periodic/change')])
   end function remarks_on_run

   !> What the damping that the reduction of a shaft gives to its high modes changes.
   function on_damping(inputs, file) result(remark)
      type(case_type), intent(in) :: inputs
      class(run_file_type), intent(inout) :: file
      character(len=:), allocatable :: remark
      remark = ''
      if (.not. file%has('rotor/damped_above')) return
      associate (error => file%get_real('rotor/damping_error'), above => file%get_real('rotor/damped_above'))
         remark = line_if(error > much_damping, 'the damping of modes above {} Hz changes amplitudes at the highest ' &
            & //'speed by {c.1} %; reduction%damp_above = {} changes less, and takes more steps in a march', [above, &
            & error, anint(max(2*above, far_above*inputs%highest_speed()/(2*pi)))])
      end associate
   end function on_damping

   !> The largest unbalance of a machine, over the mass of its rotor, against the smallest clearance.
   function on_unbalances(inputs, file) result(remark)
      type(case_type), intent(in) :: inputs
      class(run_file_type), intent(inout) :: file
      character(len=:), allocatable :: remark
      remark = ''
      if (.not. file%has('rotor/total_mass')) return
      if (size(inputs%rotor%elastic%unbalances) == 0 .or. size(inputs%bearings) == 0) return
      remark = remark_on_unbalance(maxval(inputs%rotor%elastic%unbalances%moment), &
         & file%get_real('rotor/total_mass'), minval(inputs%bearings%clearance()))
   end function on_unbalances

   !> Writes the list; a list that was there is replaced.
   subroutine put_remarks(file, all)
      class(record_type), intent(inout) :: file
      character(len=*), intent(in) :: all
      if (all /= '') then
         call file%put(name, lines(all), 'remarks: what is unusual, or leaves the range of the model')
      else if (file%has(name)) then
         call file%delete(name)
      end if
   end subroutine put_remarks

   !> The lines of a list that are not in another.
   function new_lines(all, known) result(fresh)
      character(len=*), intent(in) :: all, known
      character(len=:), allocatable :: fresh
      integer :: first, length
      fresh = ''
      first = 1
      do while (first <= len(all))
         length = index(all(first:), newline)
         associate (line => all(first:first + length - 1))
            if (index(newline//known, newline//line) == 0) fresh = fresh//line
         end associate
         first = first + length
      end do
   end function new_lines

   !> On the equilibrium of a bearing.
   function on_equilibrium(bearing, thermal_model, file) result(said)
      type(bearing_type), intent(in) :: bearing
      character(len=*), intent(in) :: thermal_model
      type(bearing_file_type), intent(inout) :: file
      character(len=:), allocatable :: said
      real(wp), dimension(bearing%pad_count()) :: film, reynolds, hottest, depth, load, inlet, taken
      real(wp) :: rise
      integer :: i
      rise = file%get_real('equilibrium/temperature_rise_fresh')
      associate (roughness => bearing%asperity%roughness, p => bearing%pads)
         call file%get_list('equilibrium/min_film_thickness', film)
         said = line_if(bearing%asperity%model /= 'none' .and. any(film < roughnesses*roughness), 'at the ' &
            & //'equilibrium the film of '//listed(film < roughnesses*roughness)//' is {u.3} um thin: less than {} ' &
            & //'times asperity%roughness = {u} um, so that surfaces touch', [minval(film), roughnesses, roughness])
         depth = file%get_real('equilibrium/journal_y')*sin(p%pivot_angle_deg*degree) &
            & + file%get_real('equilibrium/journal_z')*cos(p%pivot_angle_deg*degree) &
            & - bearing%assembled_clearance
         said = said//line_if(bearing%tilting() .and. any(depth > 0), 'eccentricity ratio {.3}: at ' &
            & //listed(depth > 0)//' the journal lies {u.3} um deeper than the clearance; are load (N), viscosity ' &
            & //'(Pa s) and clearance (m) as meant?', [file%get_real('equilibrium/eccentricity_ratio'), maxval(depth)])
         if (ieee_is_nan(rise)) rise = 0
         said = said//line_if(thermal_model == 'none' .and. rise > largest_rise, 'the oil warms by {.1} K although ' &
            & //'every pad draws fresh oil: its viscosity is not that of the case in all films; thermal%model = ' &
            & //'''pad'' with an oil (oil%grade) finds temperatures and viscosities', [rise])
         if (file%has('equilibrium/maximum_temperature')) then
            call file%get_list('equilibrium/maximum_temperature', hottest)
            said = said//line_if(any(hottest > warm_metal), listed(hottest > warm_metal)//': up to {.1} C; white ' &
               & //'metal is near its limit from about {} C on', [maxval(hottest), warm_metal])
         end if
         call file%get_list('equilibrium/inlet_flow', inlet)
         call file%get_list('equilibrium/reformation_flow', taken)
         do i = 1, size(taken)
            if (ieee_is_nan(inlet(i))) cycle
            said = said//line_if(abs(taken(i)) > visible_flow*abs(inlet(i)), 'pad {}: {u.3} ml/s enter, and {u.3} ' &
               & //'leave: at the reformation boundary behind the cavitated part the film takes up {u.3} ml/s beyond ' &
               & //'what reaches it, as Reynolds'' condition does not conserve oil there', &
               & [real(wp) :: i, inlet(i), inlet(i) + taken(i), taken(i)])
         end do
         call file%get_list('equilibrium/reynolds_number', reynolds)
         said = said//line_if(bearing%film%turbulence == 'none' .and. any(reynolds > laminar_up_to), 'Reynolds ' &
            & //'number of the film of '//listed(reynolds > laminar_up_to)//': {i}; above {} films may be turbulent, ' &
            & //'which changes film, power loss, stiffness and damping; film%turbulence = ''ng_pan'' takes them so', &
            & [maxval(reynolds), laminar_up_to])
         if (bearing%film%turbulence /= 'none') said = said//on_transition(bearing)
         if (bearing%tilting()) then
            call file%get_list('equilibrium/pivot_load', load)
            associate (idle => load < smallest_share*sum(load))
               said = said//line_if(sum(load) > 0 .and. any(idle), 'at the equilibrium '//listed(idle) &
                  & //trim(merge(' carries', ' carry  ', count(idle) == 1))//' no load; unloaded pads may flutter')
            end associate
         end if
      end associate
      said = said//on_beginning_films(bearing%pad_count(), file)//on_slope(bearing, file)
      associate (misalignment => figure(file, 'misalignment'))
         said = said//line_if(misalignment > steep_slope, 'the slope of the shaft changes the film by {ci} % of ' &
            & //'its minimum thickness from the middle of the bearing to its end, which is left out; ' &
            & //'bearing%shaft_slope = ''film'' counts it', [misalignment])
      end associate
   end function on_equilibrium

   !> On a journal so inclined that its ends come close to pads that cannot follow.
   function on_slope(bearing, file) result(said)
      type(bearing_type), intent(in) :: bearing
      type(bearing_file_type), intent(in) :: file
      character(len=:), allocatable :: said
      real(wp), dimension(bearing%pad_count()) :: first, last
      character(len=:), allocatable :: follow
      said = ''
      follow = ''
      if (bearing%tilting()) follow = '; pads that pitch (pads%motion) follow'
      if (bearing%pitching() .or. .not. file%has('equilibrium/start_film_thickness')) return
      call file%get_list('equilibrium/start_film_thickness', first)
      call file%get_list('equilibrium/end_film_thickness', last)
      associate (part => 0.5_wp*abs(first - last)/min(first, last))
         said = line_if(any(part > steep_slope), 'the slope of the journal changes the film of '//listed(part &
            & > steep_slope)//' by up to {ci} % of its minimum thickness from the middle to an end' &
            & //follow, [maxval(part)])
      end associate
   end function on_slope

   !> On a transition so sudden that films lose stiffness in it.
   function on_transition(bearing) result(said)
      type(bearing_type), intent(in) :: bearing
      character(len=:), allocatable :: said
      real(wp) :: power
      associate (f => bearing%film)
         power = steepest(f%turbulence, f%laminar_below, f%turbulent_above)
         said = line_if(power > steep_transition, 'between film%laminar_below = {} and ' &
            & //'film%turbulent_above = {} the resistance of a film grows with up to the power {.1} of its Reynolds ' &
            & //'number: above {} a film carries more where it is thicker, and has little stiffness', &
            & [f%laminar_below, f%turbulent_above, power, steep_transition])
      end associate
   end function on_transition

   !> On films whose part of stiffness and damping is that of a motion to one side.
   function on_beginning_films(pad_count, file) result(said)
      integer, intent(in) :: pad_count
      type(bearing_file_type), intent(inout) :: file
      character(len=:), allocatable :: said
      real(wp) :: begins(pad_count)
      said = ''
      if (.not. file%has('coefficients/one_sided')) return
      call file%get_list('coefficients/one_sided', begins)
      said = line_if(any(begins > 0), 'the film of '//listed(begins > 0)//' only just begins to carry at the ' &
         & //'equilibrium: what it adds to stiffness and damping hangs on the side to which the journal moves, and ' &
         & //'is given for one of them; preload (bearing%preload) or the pads'' weight decides')
   end function on_beginning_films

   !> On pivots that give way by much of the clearance: those of another bearing may be too small.
   function on_pivots(bearing, file) result(said)
      type(bearing_type), intent(in) :: bearing
      type(bearing_file_type), intent(inout) :: file
      character(len=:), allocatable :: said, ending
      real(wp) :: deflection(bearing%pad_count())
      said = ''
      if (.not. file%has('equilibrium/pivot_deflection')) return
      call file%get_list('equilibrium/pivot_deflection', deflection)
      ending = ''
      if (any(bearing%pivot%law == ['fang  ', 'hertz ', 'rocker'])) ending = filled('; is pivot%socket_radius = {} ' &
         & //'m that of this bearing?', [maxval(bearing%pivot%socket_radius)])
      associate (soft => deflection > soft_pivot*bearing%assembled_clearance)
         said = line_if(any(soft), 'at the equilibrium '//trim(merge('the pivot ', 'the pivots', count(soft) == 1)) &
            & //' of '//listed(soft)//trim(merge(' gives', ' give ', count(soft) == 1))//' way by {u.3} um, more ' &
            & //'than {} of the clearance', [maxval(deflection, mask=soft), soft_pivot], ending)
      end associate
   end function on_pivots

   !> On the motion in a bearing of this number of pads: contact in the whole run, and lift-off, flutter, rubbing and
   !> whirl in the last revolutions.
   function on_motion(pad_count, file) result(said)
      integer, intent(in) :: pad_count
      type(bearing_file_type), intent(inout) :: file
      character(len=:), allocatable :: said, diagnosis, of_load
      type(pad_behaviour_type) :: pads(pad_count)
      integer :: i
      associate (held => pad_figures(file, 'pad_without_equilibrium'))
         said = line_if(any(held > 0), listed(held > 0)//': without equilibrium; the march starts without tilt')
      end associate
      associate (whirls => figure(file, 'whirls'), order => figure(file, 'whirl_order'), &
            & amplitude => figure(file, 'whirl_amplitude'))
         said = said//line_if(whirls > 0, 'the journal whirls at {.3} of the shaft speed, amplitude {u.3} um', &
            & [order, amplitude])
      end associate
      said = said//on_repetition(file)
      pads%load = pad_figures(file, 'pad_load')
      pads%unloaded = pad_figures(file, 'pad_unloaded') > 0
      pads%lifted = pad_figures(file, 'pad_lifted')
      pads%flutters = pad_figures(file, 'pad_flutters') > 0
      pads%order = pad_figures(file, 'pad_order')
      pads%amplitude = pad_figures(file, 'pad_order_amplitude')
      pads%rubbing = pad_figures(file, 'pad_rubbing')
      do i = 1, size(pads)
         diagnosis = pad_diagnosis(pads(i))
         said = said//line_if(diagnosis /= '', 'pad '//to_text(i)//' '//diagnosis)
      end do
      ! which pads touched the journal in the whole run, how hard and how long
      associate (force => pad_figures(file, 'pad_asperity_force'), share => pad_figures(file, 'pad_asperity_share'), &
            & time => pad_figures(file, 'pad_asperity_time'))
         do i = 1, size(force)
            of_load = ''
            if (share(i) > 0) of_load = filled(', {c.2} % of the load', [share(i)])
            said = said//line_if(force(i) > 0, 'pad {} touched the journal for {m.3} ms of the run; its asperities ' &
               & //'bore up to {.1} N', [real(wp) :: i, time(i), force(i)], of_load)
         end do
      end associate
   end function on_motion

   !> On a motion that does not repeat after a revolution.
   function on_repetition(file) result(said)
      type(bearing_file_type), intent(inout) :: file
      character(len=:), allocatable :: said
      said = ''
      if (.not. has_figure(file, 'rotation_number')) return
      associate (rotation => figure(file, 'rotation_number'), difference => figure(file, 'rotation_difference'), &
            & repeats_after => figure(file, 'repeats_after'), growth => figure(file, 'ring_growth'), &
            & points => file%list_size('by_revolution/poincare_y'))
         if (repeats_after > 0) then
            said = filled('the motion is locked to the shaft: it repeats after {} revolutions', [repeats_after])
         else if (figure(file, 'quasi_periodic') > 0) then
            said = filled('the motion is quasi-periodic: rotation number {.7}, second frequency {.2} Hz (amplitude ' &
               & //'{u.3} um), sidebands {.2} and {.2} Hz', [rotation, figure(file, 'second_frequency'), figure(file, &
               & 'second_amplitude'), figure(file, 'lower_sideband_frequency'), figure(file, &
               & 'upper_sideband_frequency')])
         else if (points < enough_points) then
            return
         else if (growth > steady_ring .or. differs(rotation, difference)) then
            said = filled('the motion is not settled, or chaotic: the points once a revolution of the last {} ' &
               & //'revolutions change from one half to the other', [real(points, wp)])
         else if (ieee_is_nan(rotation)) then
            said = 'the motion does not repeat, and has no rotation number: the points once a revolution are no ' &
               & //'curve that goes round its centre once'
         else
            said = filled('the motion does not repeat: rotation number {.7}, in both halves of the last {} ' &
               & //'revolutions to {}; more of them (output%spectrum_revolutions), or a smaller ' &
               & //'integration%relative_tolerance, tell whether it is quasi-periodic', [rotation, &
               & real(points, wp), difference])
         end if
      end associate
      said = said//newline
   contains
      !> Whether there are rotation numbers of both halves, and they disagree.
      pure logical function differs(rotation, difference)
         real(wp), intent(in) :: rotation, difference
         differs = .false.
         if (.not. ieee_is_nan(rotation)) differs = difference > disagreement
      end function differs
   end function on_repetition

   !> "carries next to no load (mean 12 N); it flutters at 0.48 of the shaft speed, ..."; empty for a pad like others.
   function pad_diagnosis(pad) result(words)
      type(pad_behaviour_type), intent(in) :: pad
      character(len=:), allocatable :: words
      words = ''
      call say(pad%unloaded, 'carries next to no load (mean {.1} N)', [pad%load])
      call say(pad%lifted > 0, 'is lifted off its pivot {c.1} % of the time', [pad%lifted])
      call say(pad%flutters, 'flutters at {.3} of the shaft speed, amplitude of the tilt {m.4} mrad', &
         & [pad%order, pad%amplitude])
      call say(pad%rubbing > 0, 'rubs on the journal {c.1} % of the time', [pad%rubbing])
   contains
      subroutine say(holds, template, numbers)
         logical, intent(in) :: holds
         character(len=*), intent(in) :: template
         real(wp), intent(in) :: numbers(:)
         if (.not. holds) return
         if (words /= '') words = words//'; it '
         words = words//filled(template, numbers)
      end subroutine say
   end function pad_diagnosis
end module result_remarks
