!> Remarks on a case: what is allowed and seldom meant, what the model is not made for, and what has no effect. A line
!> each; --check shows them, and a run puts them on its list.
module case_remarks
   use kinds, only: wp, degree, pi, rpm
   use text, only: to_text, filled, line_if, behind, newline
   use case_groups, only: bearing_type, is_set
   use case_inputs, only: case_type
   use bearing_numbers, only: preload, load, specific_load
   use variable_table, only: variable_table_type, variable_type, lines_of
   use case_fields, only: list_variables
   use assignments, only: assignment_type, kind_of, bearing_of
   use operating_point, only: operating_point_type
   use oil_properties, only: reference_viscosity
   use other_units, only: in_other_units, usual_size, usual_type
   implicit none (type, external)
   private
   public :: remarks_on_case, remarks_on_load, remark_on_unbalance, note_values_of_paper

   !> Density, kg/m^3, that no pad has; its radius of gyration about the pivot over the radius of the journal.
   real(wp), parameter :: densest = 1e5_wp, widest = 5
   !> Bearing clearance over the radius of the journal that no bearing has.
   real(wp), parameter :: widest_clearance = 0.01_wp
   !> Multiple of the speed of the shaft above which frequencies seldom are, and how close to the speed in another unit
   !> a number must be, of itself, to be taken for it.
   real(wp), parameter :: highest_order = 25, closeness = 1e-3_wp
   !> Usual surface speeds of journals at their working speed, m/s.
   real(wp), parameter :: usual_speeds(2) = [2.0_wp, 150.0_wp]

   !> Specific loads, Pa, that few bearings have; the lowest that another unit of a load is proposed for.
   real(wp), parameter :: highest_usual_load = 5e6_wp, lowest_usual_load = 5e3_wp, lowest_proposed = 2e4_wp
   !> Part of the weight of which no force is worth its place in the input; part of the load of a bearing where the
   !> measured law of its pivots may end; multiple of the clearance where its deflections may.
   real(wp), parameter :: negligible = 1e-3_wp, beyond_table = 0.05_wp, deepest = 5
   !> From the edge of a fixed pad on this angle, deg, carries little.
   real(wp), parameter :: beside_edge = 15

   !> Surface speed, m/s, up to which a temperature for each pad is close to those along and across the films.
   real(wp), parameter :: compared_up_to = 35

   !> Variables that make a bearing another one, and those that are then to be given.
   character(len=*), parameter :: own_size = ' bearing%journal_radius bearing%axial_length '
   character(len=*), parameter :: to_be_given = ' rotor%mass rotor%unbalance operation%speed_rpm ' &
      & //'bearing%journal_radius bearing%machined_clearance bearing%assembled_clearance bearing%axial_length ' &
      & //'bearing%viscosity pads%pivot_angle_deg pads%arc_deg pads%pivot_distance '
   !> Variables from which another of their group follows, each before this.
   character(len=*), parameter :: sources = ' preload machined_clearance, balance_grade unbalance,'

contains

   !> All of a case; of a machine those of each of its bearings, whose loads are not known yet.
   function remarks_on_case(inputs) result(lines)
      type(case_type), intent(in) :: inputs
      character(len=:), allocatable :: lines
      type(variable_table_type) :: table
      integer :: b
      lines = ''
      call list_variables(inputs, table)
      do b = 1, size(inputs%bearings)
         lines = lines//behind(inputs%bearings(b)%label(': '), on_bearing(inputs%bearings(b)))
      end do
      if (inputs%about%task == 'branch' .and. inputs%followed() == 'limit_cycle') lines = lines//line_if(any([( &
         & inputs%bearings(b)%film%cavitation == 'none', b=1, size(inputs%bearings))]), 'film%cavitation = ''none'': ' &
         & //'limit cycles may be held by tension of the oil, which real films do not bear')
      associate (b => inputs%branch)
         if (inputs%about%task == 'branch' .and. b%point == 'hopf') lines = lines//line_if(index( &
            & b%parameter//b%second_parameter, 'ic_coefficient') > 0, 'friction: Hopf points of stuck pads depend on ' &
            & //'friction%bristle_stiffness, not on the coefficients of friction, as pivots at rest do not slide')
      end associate
      lines = lines//remarks_on_units()//remarks_on_forces()
      if (allocated(inputs%about%of_paper)) lines = lines//'not given, and so as in the paper''s bearing: ' &
         & //inputs%about%of_paper//newline
      lines = lines//on_idle_groups(inputs, table)
   contains
      !> What does not depend on the load of a bearing.
      function on_bearing(bearing) result(lines)
         type(bearing_type), intent(in) :: bearing
         character(len=:), allocatable :: lines
         associate (radius => bearing%journal_radius, c => bearing%clearance(), turns => inputs%highest_speed()/rpm, &
               & surface => inputs%highest_speed()*bearing%journal_radius)
            lines = line_if(surface < usual_speeds(1), 'surface speed {} m/s at {} rpm: seldom so low', [surface, &
               & turns], in_other_units(turns, 'operation%speed_rpm', 'rpm', usual_speeds(1)/radius/rpm, usual_speeds( &
               & 2)/radius/rpm))
            lines = lines//line_if(c > widest_clearance*radius, 'bearing%assembled_clearance = {}: {} of the radius ' &
               & //'of the journal; usual are 0.001 to 0.003', [c, c/radius], in_other_units(c, &
               & 'bearing%assembled_clearance', 'm', 0.0_wp, widest_clearance*radius))//remarks_on_pads(bearing)
            lines = lines//line_if(any(preload(bearing) < 0), 'negative preload {}: the bore of the pads is tighter ' &
               & //'than the clearance at the pivots; such a pad touches the journal at its edges first', &
               & [minval(preload(bearing))])
            lines = lines//line_if(.not. bearing%tilting() .and. any(abs(preload(bearing)) > 0), 'each lobe has a ' &
               & //'centre of its own: eccentricity ratio and attitude angle are about the centre of the bearing and ' &
               & //'over its clearance, so that they differ from those of a cylindrical bore')
            lines = lines//on_cold_oil(bearing)
            lines = lines//line_if(inputs%thermal%model == 'pad' .and. surface > compared_up_to, 'surface speed {.1} ' &
               & //'m/s: above {} m/s a temperature for each pad shows trends, and stiffness may be off by more than ' &
               & //'10 % (docs/warm_oil.md)', [surface, compared_up_to])
         end associate
      end function on_bearing

      !> A viscosity over the temperature, and no film that heats the oil.
      function on_cold_oil(bearing) result(line)
         type(bearing_type), intent(in) :: bearing
         character(len=:), allocatable :: line
         line = ''
         if (inputs%thermal%model /= 'none' .or. bearing%oil%law == 'constant') return
         line = line_if(.true., 'thermal%model = ''none'': all oil has oil%supply_temperature = {} C and {.4} Pa s, ' &
            & //'as if no film heated it, and losses, stiffness and damping are those of such oil; thermal%model ' &
            & //'= ''pad'' or ''film'' finds the temperatures of the films', [bearing%oil%supply_temperature, &
            & reference_viscosity(bearing)])
      end function on_cold_oil

      !> Steady forces that a case gives, the tables of its pivots beside them, and what depends on the load and the
      !> unbalance of a rigid journal, a line each.
      function remarks_on_forces() result(lines)
         character(len=:), allocatable :: lines
         real(wp) :: weight
         integer :: i
         lines = ''
         associate (r => inputs%rotor, bearings => inputs%bearings)
            if (inputs%held%is_wanted()) then
               ! its load is not known yet, but its direction is where no attitude and no position are given
               if (.not. (is_set(inputs%held%attitude_deg) .or. any(is_set(inputs%held%position)))) then
                  lines = on_direction(inputs)
               end if
            else if (r%is_rigid()) then
               lines = on_force('rotor%static_load', norm2(r%static_load), r%mass*r%gravity)//on_low_load() &
                  & //on_table(bearings(1), load(inputs))
               if (inputs%moves()) lines = lines//remark_on_unbalance(inputs%unbalance(), r%mass, bearings( &
                  & 1)%clearance())
               lines = lines//remarks_on_load(inputs)
            else if (r%station_count() > 0) then
               weight = r%elastic%mass()*r%gravity
               do i = 1, size(r%elastic%loads)
                  lines = lines//on_force('load('//to_text(i)//')%force', norm2(r%elastic%loads(i)%force), weight)
               end do
               do i = 1, size(bearings)
                  lines = lines//on_table(bearings(i), weight/size(bearings))
               end do
            end if
         end associate
      end function remarks_on_forces

      !> A load that is low for the size of the bearing, where its size is usual.
      function on_low_load() result(line)
         character(len=:), allocatable :: line
         type(usual_type) :: usual
         usual = usual_size('bearing%journal_radius', 'm')
         line = ''
         if (inputs%bearings(1)%journal_radius > usual%high .or. .not. load(inputs) > 0) return
         line = line_if(specific_load(inputs) < lowest_usual_load, 'specific load {M} MPa: seldom so low; most ' &
            & //'bearings carry 1 to 3 MPa', [specific_load(inputs)], in_usual_unit(inputs))
      end function on_low_load

      !> All of a case, but for those on pads, a line each; by its table of variables.
      function remarks_on_units() result(lines)
         character(len=:), allocatable :: lines
         real(wp) :: largest
         integer :: i
         lines = ''
         do i = 1, table%count
            lines = lines//remark_on_number(table%variables(i))
         end do
         if (inputs%rotor%station_count() > 0) then
            do i = 1, size(inputs%rotor%elastic%discs)
               associate (disc => inputs%rotor%elastic%discs(i))
                  ! a radius of gyration as long as the shaft
                  largest = disc%mass*sum(inputs%rotor%elastic%shaft%length)**2
                  lines = lines//line_if(disc%diametral_inertia > largest, 'disc({})%diametral_inertia = {}: more ' &
                     & //'than a disc of its mass has that is not larger than the shaft is long', [real(wp) :: i, &
                     & disc%diametral_inertia], in_other_units(disc%diametral_inertia, 'disc%', 'kg m^2', 0.0_wp, &
                     & largest))
               end associate
            end do
         end if
         lines = lines//on_frequencies()
      end function remarks_on_units

      !> Frequencies, Hz or over the speed of the shaft, far above it or in another unit, and the speed of balancing.
      function on_frequencies() result(lines)
         character(len=:), allocatable :: lines, name, ending
         character(len=*), parameter :: too_high = ' = {}: this many times the speed of the shaft; is it in Hz or rpm?'
         integer :: i
         associate (balance => inputs%rotor%balance_speed_rpm, speed => inputs%highest_speed(), &
               & turns => inputs%highest_speed()/(2*pi), x => inputs%excitations)
            lines = line_if(is_set(balance) .and. is_near(balance, speed), 'rotor%balance_speed_rpm = {}: the speed ' &
               & //'of the shaft in rad/s; it is in rpm', [balance])
            ending = filled('; the shaft turns at {} Hz', [turns])
            do i = 1, size(x)
               name = 'excitation('//to_text(i)//')%'
               if (is_set(x(i)%frequency_hz)) then
                  associate (f => x(i)%frequency_hz, near => is_near(x(i)%frequency_hz, speed))
                     lines = lines//line_if(near, name//'frequency_hz = {}: the speed of the shaft in rad/s', [f], &
                        & ending)//line_if(f > highest_order*turns .and. .not. near, name//'frequency_hz = {}: {} ' &
                        & //'times the speed of the shaft; {} rpm are {}', [f, f/turns, f, f/60], ending)
                  end associate
               end if
               lines = lines//line_if(x(i)%frequency_ratio > highest_order, name//'frequency_ratio'//too_high, &
                  & [x(i)%frequency_ratio])
            end do
         end associate
         associate (ratio => maxval([0.0_wp, inputs%coefficients%frequency_ratio]))
            lines = lines//line_if(inputs%about%task == 'coefficients' .and. ratio > highest_order, &
               & 'coefficients%frequency_ratio'//too_high, [ratio])
         end associate
      end function on_frequencies
   end function remarks_on_case

   !> Variables that a case sets and does not use, a line for each group and reason.
   function on_idle_groups(inputs, table) result(lines)
      type(case_type), intent(in) :: inputs
      type(variable_table_type), intent(in) :: table
      character(len=:), allocatable :: lines
      type(variable_table_type) :: defaults
      character(len=:), allocatable :: group, names, reason, that
      integer :: i
      lines = line_if(size(inputs%excitations) > 0 .and. .not. inputs%moves(), 'excitation: has no effect with ' &
         & //'case%task = '''//inputs%about%task//''', where no force changes with time')
      call list_variables(case_type(), defaults)
      group = ''
      names = ''
      reason = ''
      do i = 1, table%count
         associate (v => table%variables(i))
            that = why_idle(inputs, v%group, v%name)
            if (that == '') cycle
            if (v%group /= group .or. that /= reason) call say()
            ! where each pad has a value of its own, the default has as many as the paper's bearing has pads
            if (v%each /= '') then
               if (all(abs(v%values) <= 0)) cycle
            else
               if (v%is_same(defaults%variables(defaults%find(kind_of(v%group), v%name)))) cycle
            end if
            group = v%group
            reason = that
            names = names//', '//v%name
         end associate
      end do
      call say()
   contains
      !> The line of the variables before.
      subroutine say()
         if (names == '') return
         lines = lines//group//' ('//names(3:)//'): has no effect with '//reason//newline
         names = ''
      end subroutine say
   end function on_idle_groups

   !> The input with which a variable has no effect, "case%task = 'march'"; empty where it has one.
   pure function why_idle(inputs, group, name) result(reason)
      type(case_type), intent(in) :: inputs
      character(len=*), intent(in) :: group, name
      character(len=:), allocatable :: reason
      logical :: is_idle
      select case (group)
      case ('coefficients', 'branch')
         is_idle = inputs%about%task /= group
      case ('periodic')
         is_idle = .not. inputs%seeks_orbits()
      case ('start')
         is_idle = .not. inputs%moves()
      case ('integration', 'output')
         is_idle = inputs%about%task /= 'march' .and. any(name == [character(len=18) :: 'stop_when_periodic', &
            & 'start_time'])
      case default
         reason = of_laminar_films(inputs, group, name)
         return
      end select
      reason = ''
      if (is_idle) reason = 'case%task = '''//inputs%about%task//''''
   end function why_idle

   !> The input with which a variable of turbulent films has no effect; empty where it has one, and for others.
   pure function of_laminar_films(inputs, group, name) result(reason)
      type(case_type), intent(in) :: inputs
      character(len=*), intent(in) :: group, name
      character(len=:), allocatable :: reason
      integer :: b
      reason = ''
      if (.not. any(name == [character(len=17) :: 'laminar_below', 'turbulent_above', 'turbulent_prandtl'])) return
      if (name == 'turbulent_prandtl' .and. inputs%thermal%model == 'none') reason = 'thermal%model = ''none'''
      do b = 1, size(inputs%bearings)
         associate (bearing => inputs%bearings(b))
            if (group == kind_of(group)//bearing%suffix() .and. bearing%film%turbulence == 'none') then
               reason = 'film'//bearing%suffix()//'%turbulence = ''none'''
            end if
         end associate
      end do
   end function of_laminar_films

   ! Remarks on forces: loads that few bearings have, forces too small beside the others to be meant in N, and where the
   ! load of fixed pads points to.

   !> A force, N, that is nothing beside the weight.
   function on_force(name, force, weight) result(line)
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: force, weight
      character(len=:), allocatable :: line
      line = line_if(force > 0 .and. force < negligible*weight, name//': {} N are nothing beside the weight of {} N', &
         & [force, weight], in_other_units(force, name, 'N', 10*negligible*weight, huge(1.0_wp)))
   end function on_force

   !> What weight or static load of a case, whichever is larger, is in units in which its specific load is usual.
   function in_usual_unit(inputs) result(hint)
      type(case_type), intent(in) :: inputs
      character(len=:), allocatable :: hint
      associate (r => inputs%rotor, area => load(inputs)/specific_load(inputs))
         if (norm2(r%static_load) > r%mass*r%gravity) then
            hint = in_other_units(norm2(r%static_load), 'rotor%static_load', 'N', lowest_proposed*area, &
               & highest_usual_load*area)
         else
            hint = in_other_units(r%mass, 'rotor%mass', 'kg', lowest_proposed*area/r%gravity, &
               & highest_usual_load*area/r%gravity)
         end if
      end associate
   end function in_usual_unit

   !> The first measured law of the pivots of a bearing that ends far below the load or far beyond the clearance.
   function on_table(bearing, carried) result(lines)
      type(bearing_type), intent(in) :: bearing
      real(wp), intent(in) :: carried
      character(len=:), allocatable :: lines, file
      integer :: i
      lines = ''
      if (.not. allocated(bearing%pivot%measured)) return
      file = 'pivot'//bearing%suffix()//'%file'
      associate (clearance => bearing%clearance())
         do i = 1, merge(bearing%pad_count(), 1, index(bearing%pivot%file, newline) > 0)
            associate (points => bearing%pivot%measured(i)%points)
               associate (last => points(:, size(points, 2)))
                  lines = lines//line_if(last(2) < beyond_table*carried, file//': its largest force is {} N, and the ' &
                     & //'bearing carries {} N', [last(2), carried], in_other_units(last(2), 'force', 'N', &
                     & beyond_table*carried, huge(1.0_wp)))//line_if(last(1) > deepest*clearance, file//': its ' &
                     & //'largest deflection is {} m, and the clearance of the bearing is {} m', [last(1), clearance], &
                     & in_other_units(last(1), 'deflection', 'm', 0.0_wp, deepest*clearance))
               end associate
            end associate
            if (lines /= '') exit
         end do
      end associate
   end function on_table

   !> What depends on the load of the one bearing of a case.
   function remarks_on_load(inputs) result(lines)
      type(case_type), intent(in) :: inputs
      character(len=:), allocatable :: lines
      lines = ''
      if (.not. load(inputs) > 0) return
      lines = line_if(specific_load(inputs) > highest_usual_load, 'specific load {M.2} MPa: above {M} MPa, where ' &
         & //'pads bend under their pressure (pads%bending); most bearings carry 1 to 3 MPa', &
         & [specific_load(inputs), highest_usual_load], in_usual_unit(inputs))
      lines = lines//on_direction(inputs)
   end function remarks_on_load

   !> Whether the load of the one bearing of a case points to where no fixed pad carries.
   function on_direction(inputs) result(line)
      type(case_type), intent(in) :: inputs
      character(len=:), allocatable :: line
      type(operating_point_type) :: point
      line = ''
      if (inputs%bearings(1)%tilting()) return
      point = operating_point_type(inputs)
      ! the angle to which the load points, counted as that of a pivot
      associate (at => atan2(point%load(1), point%load(2))/degree)
         line = line_if(.not. carries_at(inputs%bearings(1), inputs%sense(), at), 'the load points to {.1} ' &
            & //'deg, to the end of a fixed pad or between two, where little oil film carries; turn the pads ' &
            & //'(pads%pivot_angle_deg) for a groove out of the load', [at])
      end associate
   end function on_direction

   !> Whether a fixed pad reaches past this angle, deg, on either side, where the shaft turns in this sense.
   pure logical function carries_at(bearing, sense, at)
      type(bearing_type), intent(in) :: bearing
      real(wp), intent(in) :: sense, at
      real(wp) :: from_trailing(bearing%pad_count())
      associate (p => bearing%pads)
         from_trailing = modulo(sense*(at - p%pivot_angle_deg) + (1 - p%pivot_ratio)*p%arc_deg, 360.0_wp)
         carries_at = any(from_trailing >= beside_edge .and. p%arc_deg - from_trailing >= beside_edge)
      end associate
   end function carries_at

   ! Remarks on numbers that are allowed and seldom meant in the unit of the input, with what they are in others.

   !> On the first value of a variable that is not of usual size; empty where there is none.
   function remark_on_number(v) result(line)
      type(variable_type), intent(in) :: v
      character(len=:), allocatable :: line, name
      type(usual_type) :: usual
      integer :: i
      line = ''
      ! what has no unit has no usual size
      if (v%is_text .or. v%unit == '1') return
      associate (counts => is_set(v%values) .and. abs(v%values) > 0)
         if (.not. any(counts)) return
         name = v%group//'%'//v%name
         usual = usual_size(name, v%unit)
         i = findloc(counts .and. (abs(v%values) < usual%low .or. abs(v%values) > usual%high), .true., dim=1)
      end associate
      if (usual%told .and. i > 0) line = name//' = '//to_text(v%values(i))//': seldom so in '//trim(v%unit) &
         & //in_other_units(v%values(i), name, v%unit, v%low, v%high)//newline
   end function remark_on_number

   !> On the first mass or moment of inertia of a bearing that no pad of its size has.
   function remarks_on_pads(b) result(line)
      type(bearing_type), intent(in) :: b
      character(len=:), allocatable :: line
      real(wp) :: heaviest, largest
      integer :: i
      line = ''
      if (.not. b%tilting()) return
      associate (p => b%pads)
         do i = 1, b%pad_count()
            ! no pad is thicker than the radius of its journal
            heaviest = densest*p%arc_deg(i)*degree*b%journal_radius**2*b%axial_length(i)
            largest = p%mass(i)*(widest*b%journal_radius)**2
            line = line_if(p%mass(i) > heaviest, 'pads%mass = {}: more than a pad of this size weighs', [p%mass(i)], &
               & in_other_units(p%mass(i), 'pads%mass', 'kg', 0.0_wp, heaviest))
            if (line == '') line = line_if(p%inertia(i) > largest, 'pads%inertia = {}: more than a pad of this size ' &
               & //'and mass has', [p%inertia(i)], in_other_units(p%inertia(i), 'pads%inertia', 'kg m^2', 0.0_wp, &
               & largest))
            if (line /= '') return
         end do
      end associate
   end function remarks_on_pads

   !> Whether two numbers are the same but for rounding in a data sheet.
   pure logical function is_near(x, y)
      real(wp), intent(in) :: x, y
      is_near = abs(x - y) <= closeness*abs(y)
   end function is_near

   !> What an unbalance, kg m, of a rotor of this mass, kg, says where its eccentricity is more than the clearance, m;
   !> else empty.
   function remark_on_unbalance(unbalance, mass, clearance) result(line)
      real(wp), intent(in) :: unbalance, mass, clearance
      character(len=:), allocatable :: line
      line = ''
      if (unbalance > mass*clearance) line = line_if(.true., 'mass eccentricity {} um (unbalance over the mass of ' &
         & //'the rotor): more than the bearing clearance of {u} um; the unbalance is in kg m', &
         & [1e6_wp*unbalance/mass, clearance], in_other_units(unbalance, 'rotor%unbalance', 'kg m', 0.0_wp, &
         & mass*clearance))
   end function remark_on_unbalance

   ! What a case of another bearing leaves to the paper's: values that no designer would leave out knowingly.

   !> Notes in a complete case "rotor%mass = 2000 kg, bearing%viscosity = 0.019 Pa s" where its assignments give a
   !> bearing the size of another than the paper's and leave these out.
   subroutine note_values_of_paper(given, inputs)
      type(assignment_type), intent(in) :: given(:)
      type(case_type), intent(inout) :: inputs
      character(len=:), allocatable :: text, line
      logical :: of_size(size(given))
      type(variable_table_type) :: table
      type(variable_type) :: shown
      integer :: i
      text = ''
      of_size = [(index(own_size, ' '//kind_of(given(i)%group)//'%'//given(i)%name//' ') > 0, i=1, size(given))]
      if (.not. any(of_size)) return
      call list_variables(inputs, table)
      do i = 1, table%count
         associate (v => table%variables(i))
            if (index(to_be_given, ' '//kind_of(v%group)//'%'//v%name//' ') == 0) cycle
            if (has_own(v) .or. .not. matters(v)) cycle
            shown = v
            if (all(abs(v%values - v%values(1)) <= 0)) shown%values = v%values(:1)
            line = lines_of(shown, '')
            text = text//', '//v%group//'%'//line(3:len(line) - 1)
            if (v%unit /= '1') text = text//' '//trim(v%unit)
         end associate
      end do
      if (text /= '') inputs%about%of_paper = text(3:)
   contains
      !> Whether the case gives it, or what it follows from.
      logical function has_own(v)
         type(variable_type), intent(in) :: v
         integer :: k
         has_own = any([(given(k)%group == v%group .and. (given(k)%name == v%name .or. index(sources, &
            & ' '//given(k)%name//' '//v%name//',') > 0), k=1, size(given))])
      end function has_own

      !> Whether a variable that is left out has an effect; of a bearing, whether the case gives it a size.
      logical function matters(v)
         type(variable_type), intent(in) :: v
         integer :: k
         matters = all(is_set(v%values))
         if (v%name == 'unbalance') matters = inputs%moves()
         ! beside a thickness that is not that of the paper's pads
         if (v%name == 'pivot_distance') matters = matters .and. any([(given(k)%group == v%group &
            & .and. given(k)%name == 'thickness', k=1, size(given))])
         if (bearing_of(v%group) == '') return
         matters = matters .and. any([(of_size(k) .and. bearing_of(given(k)%group) == bearing_of(v%group), &
            & k=1, size(given))])
      end function matters
   end subroutine note_values_of_paper
end module case_remarks
