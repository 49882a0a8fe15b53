!> What a case may leave out, because it follows from other variables: final speed, unbalance, pad clearance, law of the
!> oil, damping of bristles, which samples are kept, and mass, inertia and centre of gravity of the pads.
module case_completion
   use kinds, only: wp, degree, rpm, pi
   use text, only: to_text, list_text, filled
   use errors, only: error_type, require, refuse, add_context
   use case_groups, only: bearing_type, oil_type, rotor_type, elastic_type, friction_type, unset, is_set, mass_range, &
      & inertia_range, centre_range, clearance_range, temperature_range, viscosity_range, in_range
   use case_inputs, only: case_type
   use excitations, only: excitation_type
   use other_units, only: in_other_units
   use oil_properties, only: reference_viscosity, density, grades
   implicit none (type, external)
   private
   public :: leave_out, leave_out_replaced, fill_replaced, complete_case, annular_sector_type, new_annular_sector

   !> Density of steel, kg/m^3.
   real(wp), parameter :: steel = 7850
   !> Most revolutions in the period of an orbit that an excitation leads to, and how closely a number of its periods
   !> must be that of revolutions.
   integer, parameter :: most_revolutions = 100
   real(wp), parameter :: closeness = 1e-9_wp

   !> The body of a pad: an annular sector of uniform density, as long as the bearing.
   type :: annular_sector_type
      !> m^3.
      real(wp) :: volume = 0
      !> Centre of gravity from the pivot, along the pad and outward, m.
      real(wp) :: centre_tangential = 0, centre_radial = 0
      !> Moment of inertia about the pivot over the mass, m^2.
      real(wp) :: squared_radius = 0
      !> The part of it that lies along the pad, and not outward.
      real(wp) :: along = 0
   end type annular_sector_type

contains

   !> Leaves out what `complete_case` can find.
   subroutine leave_out(inputs)
      type(case_type), intent(inout) :: inputs
      integer :: b
      inputs%operation%final_speed_rpm = unset
      inputs%rotor%unbalance = unset
      inputs%output%keep = ''
      do b = 1, size(inputs%bearings)
         associate (bearing => inputs%bearings(b), pads => inputs%bearings(b)%pads)
            bearing%machined_clearance(:) = unset
            bearing%viscosity = unset
            bearing%oil%law = ''
            bearing%friction%characteristic_load = unset
            pads%mass(:) = unset
            pads%inertia(:) = unset
            pads%centre_tangential(:) = unset
            pads%centre_radial(:) = unset
            pads%inertia_pitch(:) = unset
            pads%inertia_yaw(:) = unset
         end associate
      end do
   end subroutine leave_out

   !> Leaves out what another variable replaces: results once had both.
   subroutine leave_out_replaced(inputs)
      type(case_type), intent(inout) :: inputs
      integer :: b
      associate (r => inputs%rotor)
         if (is_set(r%balance_grade)) r%unbalance = unset
         if (.not. is_set(r%balance_grade)) r%balance_speed_rpm = unset
      end associate
      do b = 1, size(inputs%bearings)
         associate (f => inputs%bearings(b)%friction)
            if (is_set(f%bristle_damping)) f%characteristic_load = unset
         end associate
      end do
   end subroutine leave_out_replaced

   !> Gives it the paper's values, as in texts that once had both.
   subroutine fill_replaced(inputs)
      type(case_type), intent(inout) :: inputs
      type(rotor_type) :: rotor
      type(friction_type) :: friction
      integer :: b
      call fill(inputs%rotor%unbalance, rotor%unbalance)
      do b = 1, size(inputs%bearings)
         call fill(inputs%bearings(b)%friction%characteristic_load, friction%characteristic_load)
      end do
   end subroutine fill_replaced

   !> Finds what is left out; afterwards only the variables from which it follows are unset. Of a machine the message of
   !> an error names the bearing.
   subroutine complete_case(inputs, error)
      type(case_type), intent(inout) :: inputs
      type(error_type), allocatable, intent(out) :: error
      integer :: b, i
      call inputs%set_final_speed()
      ! what has no samples is a row of a study alone, unless a file of each run is asked for
      if (inputs%output%keep == '') inputs%output%keep = trim(merge('summary', 'all    ', &
         & any(inputs%about%task == ['equilibrium ', 'coefficients'])))
      call set_unbalance(inputs%rotor)
      if (allocated(error)) return
      do b = 1, size(inputs%bearings)
         associate (bearing => inputs%bearings(b))
            do i = 1, bearing%pad_count()
               call set_clearance(bearing, i)
            end do
            if (.not. allocated(error)) call complete_oil(bearing, error)
            if (.not. allocated(error)) call set_bristles(bearing%friction)
            if (bearing%pivot%law == 'rocker') call fill(bearing%pivot%contact_length, bearing%axial_length)
            do i = 1, bearing%pad_count()
               if (.not. allocated(error)) call set_pad(bearing, i, inputs%thermal%model == 'film')
            end do
            call add_context(error, bearing%label())
         end associate
         if (allocated(error)) return
      end do
      call complete_excitations()
      if (.not. inputs%rotor%is_rigid()) call complete_lateral(inputs%rotor%elastic, inputs%operation%speed_rpm)
   contains
      !> As given, the paper's, or none where a grade is given.
      subroutine set_unbalance(r)
         type(rotor_type), intent(inout) :: r
         type(rotor_type) :: paper
         call fill_or_replace(r%unbalance, 'rotor%unbalance', r%balance_grade, 'rotor%balance_grade', &
            & paper%unbalance, ' (-1 takes one back)')
         call require(is_set(r%balance_grade) .or. .not. is_set(r%balance_speed_rpm), 'rotor%balance_speed_rpm = {}: ' &
            & //'has no effect without rotor%balance_grade', [r%balance_speed_rpm], error)
      end subroutine set_unbalance

      !> The damping of the bristles as given, or the load from which it follows.
      subroutine set_bristles(f)
         type(friction_type), intent(inout) :: f
         type(friction_type) :: paper
         call fill_or_replace(f%characteristic_load, 'friction%characteristic_load', f%bristle_damping, &
            & 'friction%bristle_damping', paper%characteristic_load, '')
      end subroutine set_bristles

      !> A variable of this name as given, the paper's value, or none where another one replaces it; both are refused.
      subroutine fill_or_replace(x, name, other, other_name, paper, hint)
         real(wp), intent(inout) :: x
         real(wp), intent(in) :: other, paper
         character(len=*), intent(in) :: name, other_name, hint
         call require(.not. (is_set(other) .and. is_set(x)), other_name//' = {}: '//name//' = {} is given too; give ' &
            & //'one of them'//hint, [other, x], error)
         if (.not. is_set(other)) call fill(x, paper)
      end subroutine fill_or_replace

      !> A pad's clearance: as given, by the preload, or the paper's.
      subroutine set_clearance(b, i)
         type(bearing_type), intent(inout) :: b
         integer, intent(in) :: i
         type(bearing_type) :: paper
         paper = bearing_type()
         associate (machined => b%machined_clearance(i), assembled => b%assembled_clearance(i), &
            & radius => b%journal_radius)
            if (assembled > 2*clearance_range(2)*radius) then
               call refuse(filled('bearing%assembled_clearance = {}: must be at most {} of bearing%journal_radius = ' &
                  & //'{} (both in m; pad {})', [real(wp) :: assembled, 2*clearance_range(2), radius, i]) &
                  & //in_other_units(assembled, 'bearing%assembled_clearance', 'm', 0.0_wp, 2*clearance_range( &
                  & 2)*radius), error)
            else if (is_set(b%preload(i)) .and. is_set(machined)) then
               call refuse(filled('bearing%preload = {}: bearing%machined_clearance = {} is given too; give one of ' &
                  & //'them (pad {})', [real(wp) :: b%preload(i), machined, i]), error)
            else if (is_set(b%preload(i))) then
               machined = assembled/(1 - b%preload(i))
               if (.not. in_range(machined/radius, clearance_range)) call refuse(filled('bearing%preload = {}: gives ' &
                  & //'bearing%machined_clearance = {} with bearing%assembled_clearance = {}; it must be {} to {} of ' &
                  & //'bearing%journal_radius = {} (all in m; pad {})', [real(wp) :: b%preload(i), machined, &
                  & assembled, clearance_range, radius, i])//in_other_units(assembled, 'bearing%assembled_clearance', &
                  & 'm', 0.0_wp, clearance_range(2)*radius/5), error)
            else
               call fill(machined, paper%machined_clearance(1))
            end if
            b%preload(i) = unset
         end associate
      end subroutine set_clearance

      !> What is left out of a pad's mass, inertia and centre of gravity: that of the paper's pads if it has their size
      !> and neither density nor thickness is given, else that of an annular sector.
      subroutine set_pad(bearing, i, heated)
         type(bearing_type), intent(inout) :: bearing
         integer, intent(in) :: i
         logical, intent(in) :: heated
         type(annular_sector_type) :: sector
         type(bearing_type) :: paper
         paper = bearing_type()
         associate (p => bearing%pads, q => paper%pads, needs_thickness => heated .or. bearing%pads%bending /= 'none')
            ! a density or thickness that nothing would follow from
            call require(.not. all(is_set([p%density(i), p%mass(i)])), 'pads%density = {}: pads%mass = {} is given ' &
               & //'too; give one of them (pad {})', [real(wp) :: p%density(i), p%mass(i), i], error)
            call require(needs_thickness .or. .not. all(is_set([p%thickness(i), p%mass(i), p%inertia(i), &
               & p%centre_tangential(i), p%centre_radial(i)])), 'pads%thickness = {}: has no effect where mass, ' &
               & //'inertia, centre_tangential and centre_radial are given (pad {})', [real(wp) :: p%thickness(i), i], &
               & error)
            if (allocated(error)) return
            if (.not. bearing%tilting()) then
               ! fixed pads need no masses
            else if (all(abs(size_of(bearing, i) - size_of(paper, 1)) <= 0) &
               & .and. .not. (is_set(p%density(i)) .or. is_set(p%thickness(i)))) then
               call fill(p%mass(i), q%mass(1))
               call fill(p%inertia(i), q%inertia(1))
               call fill(p%centre_tangential(i), q%centre_tangential(1))
               call fill(p%centre_radial(i), q%centre_radial(1))
            else
               call fill(p%thickness(i), p%pivot_distance(i))
               call fill(p%density(i), steel)
               sector = new_annular_sector(bearing%journal_radius + bearing%machined_clearance(i), &
                  & p%thickness(i), p%pivot_ratio(i)*p%arc_deg(i)*degree, (1 - p%pivot_ratio(i))*p%arc_deg(i)*degree, &
                  & bearing%axial_length(i), p%pivot_distance(i))
               call fill(p%mass(i), p%density(i)*sector%volume)
               call fill(p%inertia(i), p%mass(i)*sector%squared_radius)
               call fill(p%centre_tangential(i), sector%centre_tangential)
               call fill(p%centre_radial(i), sector%centre_radial)
               call require_range('mass', p%mass(i), mass_range, error)
               call require_range('inertia', p%inertia(i), inertia_range, error)
               call require_range('centre_tangential', p%centre_tangential(i), centre_range, error)
               call require_range('centre_radial', p%centre_radial(i), centre_range, error)
            end if
            if (bearing%pitching()) call set_slope_inertias(bearing, i, error)
            p%density(i) = unset
            if (needs_thickness) then
               call fill(p%thickness(i), p%pivot_distance(i))
            else
               p%thickness(i) = unset
            end if
         end associate
      end subroutine set_pad

      !> Finds the ends that are left out and needed, and makes the period of an orbit one of all excitations.
      subroutine complete_excitations()
         character(len=15) :: given
         integer :: i
         do i = 1, size(inputs%excitations)
            associate (x => inputs%excitations(i), revolutions => inputs%periodic%revolutions)
               if (any(x%kind == ['chirp', 'ramp ']) .and. .not. is_set(x%end)) x%end = inputs%operation%duration
               if (.not. inputs%seeks_orbits() .or. x%kind /= 'harmonic') cycle
               if (is_set(x%frequency_hz) .eqv. is_set(x%frequency_ratio)) cycle
               revolutions = common_multiple(revolutions, revolutions_of(x, inputs%operation%speed_rpm*rpm))
               given = merge('frequency_hz   ', 'frequency_ratio', is_set(x%frequency_hz))
               call require(revolutions >= 1 .and. revolutions <= most_revolutions, 'excitation({})%'//trim(given) &
                  & //' = {}: must be a fraction of the speed of the shaft whose period is at most {} revolutions ' &
                  & //'for case%task = '''//inputs%about%task//''', with periodic%revolutions and the other ' &
                  & //'excitations; its frequency over the speed is {}', [real(wp) :: i, merge(x%frequency_hz, &
                  & x%frequency_ratio, is_set(x%frequency_hz)), most_revolutions, ratio(x, &
                  & inputs%operation%speed_rpm*rpm)], error)
            end associate
            if (allocated(error)) return
         end do
      end subroutine complete_excitations
   end subroutine complete_case

   !> Moments of inertia of the pitch and the yaw of a pad that are left out: its mass is spread evenly over its length,
   !> and of its moment of inertia about the pivot as much lies along the pad as of that of an annular sector.
   subroutine set_slope_inertias(bearing, i, error)
      type(bearing_type), intent(inout) :: bearing
      integer, intent(in) :: i
      type(error_type), allocatable, intent(inout) :: error
      type(annular_sector_type) :: sector
      real(wp) :: thickness, axial, share
      associate (p => bearing%pads)
         thickness = merge(p%thickness(i), p%pivot_distance(i), is_set(p%thickness(i)))
         sector = new_annular_sector(bearing%journal_radius + bearing%machined_clearance(i), thickness, &
            & p%pivot_ratio(i)*p%arc_deg(i)*degree, (1 - p%pivot_ratio(i))*p%arc_deg(i)*degree, &
            & bearing%axial_length(i), p%pivot_distance(i))
         share = sector%along/sector%squared_radius
         axial = p%mass(i)*(bearing%axial_length(i)**2/12 + p%pivot_axial_offset(i)**2)
         call fill(p%inertia_pitch(i), axial + (1 - share)*p%inertia(i))
         call require_range('inertia_pitch', p%inertia_pitch(i), inertia_range, error)
         if (.not. bearing%yawing()) return
         call fill(p%inertia_yaw(i), axial + share*p%inertia(i))
         call require_range('inertia_yaw', p%inertia_yaw(i), inertia_range, error)
      end associate
   end subroutine set_slope_inertias

   !> Speeds of a lateral analysis.
   pure subroutine complete_lateral(elastic, speed_rpm)
      type(elastic_type), intent(inout) :: elastic
      real(wp), intent(in) :: speed_rpm
      if (.not. allocated(elastic%lateral)) return
      call fill(elastic%lateral%lowest_rpm, speed_rpm)
      call fill(elastic%lateral%first_rpm, 0.2_wp*speed_rpm)
      call fill(elastic%lateral%last_rpm, 1.25_wp*speed_rpm)
   end subroutine complete_lateral

   !> The size of a pad, clearances apart.
   pure function size_of(b, i)
      type(bearing_type), intent(in) :: b
      integer, intent(in) :: i
      real(wp) :: size_of(5)
      associate (p => b%pads)
         size_of = [b%journal_radius, b%axial_length(i), p%arc_deg(i), p%pivot_ratio(i), p%pivot_distance(i)]
      end associate
   end function size_of

   elemental subroutine fill(x, value)
      real(wp), intent(inout) :: x
      real(wp), intent(in) :: value
      if (.not. is_set(x)) x = value
   end subroutine fill

   !> Refuses what the input would not allow if it were given.
   subroutine require_range(name, value, range, error)
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: value, range(2)
      type(error_type), allocatable, intent(inout) :: error
      call require(in_range(value, range), 'pads%'//name//' = {}, from the size of the pad: must be {} to {}', &
         & [value, range], error)
   end subroutine require_range

   !> Closed forms of the sector between the bore and a back that lies `thickness` behind it, from `trailing` before to
   !> `leading` behind the pivot, rad; the pivot lies at `distance` outward of the bore.
   pure type(annular_sector_type) function new_annular_sector(bore, thickness, leading, trailing, length, distance) &
      & result(sector)
      real(wp), intent(in) :: bore, thickness, leading, trailing, length, distance
      real(wp) :: back, arc, radius, pivot, outward
      back = bore + thickness
      arc = leading + trailing
      pivot = bore + distance
      ! a ring's share of its area at each radius, and the mean direction of its points
      radius = 2*(bore**2 + bore*back + back**2)/(3*(bore + back))
      outward = radius*(sin(leading) + sin(trailing))/arc
      sector%volume = 0.5_wp*arc*thickness*(bore + back)*length
      sector%centre_tangential = radius*(cos(trailing) - cos(leading))/arc
      sector%centre_radial = outward - pivot
      sector%squared_radius = 0.5_wp*(bore**2 + back**2) + pivot*(pivot - 2*outward)
      sector%along = 0.25_wp*(bore**2 + back**2)*(1 - (sin(2*leading) + sin(2*trailing))/(2*arc))
   end function new_annular_sector

   !> Finds the law where it is left out, checks its numbers, and gives the constant law the paper's viscosity.
   subroutine complete_oil(b, error)
      type(bearing_type), intent(inout) :: b
      type(error_type), allocatable, intent(out) :: error
      type(bearing_type) :: paper
      associate (oil => b%oil)
         ! resolved cases once said so of every case without a grade
         if (.not. oil%grade > 0) oil%grade = unset
         if (oil%law == '') then
            oil%law = 'constant'
            if (is_set(oil%reference_viscosity) .or. is_set(oil%temperature_exponent)) oil%law = 'exponential'
            if (is_set(oil%grade) .or. any(is_set(oil%kinematic_viscosity))) oil%law = 'walther'
         end if
         ! what tells that another law is meant; numbers that merely have no effect may stand
         call only_of('constant', 'bearing%viscosity', b%viscosity)
         call only_of('walther', 'oil%grade', oil%grade)
         call only_of('walther', 'oil%kinematic_viscosity', maxval(oil%kinematic_viscosity))
         call only_of('exponential', 'oil%reference_viscosity', oil%reference_viscosity)
         call only_of('exponential', 'oil%temperature_exponent', oil%temperature_exponent)
         select case (oil%law)
         case ('constant')
            if (.not. is_set(b%viscosity)) b%viscosity = paper%viscosity
            return
         case ('walther')
            call check_walther(oil, error)
         case default
            call require(is_set(oil%reference_viscosity) .and. is_set(oil%temperature_exponent), 'oil%law = ' &
               & //'''exponential'': needs oil%reference_viscosity and oil%temperature_exponent', error)
         end select
         if (allocated(error)) return
         associate (mu => reference_viscosity(b))
            call require(in_range(mu, viscosity_range), 'oil%supply_temperature = {}: the oil''s viscosity there is ' &
               & //'{} Pa s; must be {} to {}', [oil%supply_temperature, mu, viscosity_range], error)
         end associate
      end associate
   contains
      subroutine only_of(law, name, value)
         character(len=*), intent(in) :: law, name
         real(wp), intent(in) :: value
         call require(.not. is_set(value) .or. b%oil%law == law, name//' = {}: belongs to oil%law = '''//law &
            & //''', but this case has oil%law = '''//b%oil%law//'''; take it out of the case', [value], error)
      end subroutine only_of
   end subroutine complete_oil

   subroutine check_walther(oil, error)
      type(oil_type), intent(in) :: oil
      type(error_type), allocatable, intent(inout) :: error
      type(oil_type) :: default
      associate (nu => oil%kinematic_viscosity, t => oil%at_temperature)
         if (is_set(oil%grade)) then
            if (.not. any(abs(grades - oil%grade) <= 0)) call refuse('oil%grade = '//to_text(oil%grade) &
               & //': must be one of the ISO viscosity grades '//list_text(real(grades, wp)), error)
            call require(.not. any(is_set(nu)), 'oil%grade = {}: oil%kinematic_viscosity = {} is given too; give one ' &
               & //'of them', [oil%grade, maxval(nu)], error)
            if (.not. all(abs(t - default%at_temperature) <= 0)) call refuse('oil%at_temperature = '//list_text(t) &
               & //': a grade has its two points at 40 and 100 C; leave it out', error)
         else
            call require(all(is_set(nu)), 'oil%law = ''walther'': needs oil%grade, or two values of ' &
               & //'oil%kinematic_viscosity', error)
            if (.not. (t(2) > t(1))) call refuse('oil%at_temperature = '//list_text(t) &
               & //': the second must be above the first', error)
            if (.not. (nu(2) <= nu(1))) call refuse('oil%kinematic_viscosity = '//list_text(nu) &
               & //': must not rise with the temperature', error)
         end if
      end associate
      call require(density(oil, temperature_range(2)) > 0, 'oil%density_slope = {}: the density must be above 0 up ' &
         & //'to {} C', [oil%density_slope, temperature_range(2)], error)
   end subroutine check_walther

   !> Frequency over that of the shaft, which has this speed, rad/s.
   pure real(wp) function ratio(x, speed)
      type(excitation_type), intent(in) :: x
      real(wp), intent(in) :: speed
      ratio = x%frequency_ratio
      if (is_set(x%frequency_hz)) ratio = 2*pi*x%frequency_hz/speed
   end function ratio

   !> The fewest revolutions that are a number of periods of an excitation; 0 where there are none.
   pure integer function revolutions_of(x, speed) result(revolutions)
      type(excitation_type), intent(in) :: x
      real(wp), intent(in) :: speed
      real(wp) :: periods
      do revolutions = 1, most_revolutions
         periods = revolutions*ratio(x, speed)
         if (periods > 0.5_wp .and. abs(periods - anint(periods)) <= closeness*periods) return
      end do
      revolutions = 0
   end function revolutions_of

   !> The least one of two numbers; 0 where one of them is.
   pure integer function common_multiple(a, b)
      integer, intent(in) :: a, b
      common_multiple = 0
      if (min(a, b) < 1) return
      do common_multiple = a, a*b, a
         if (mod(common_multiple, b) == 0) return
      end do
   end function common_multiple
end module case_completion
