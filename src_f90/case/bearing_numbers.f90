!> What a bearing engineer calculates from a case before any run.
module bearing_numbers
   use kinds, only: wp
   use text, only: to_text, fixed_text
   use case_groups, only: bearing_type
   use case_inputs, only: case_type
   use oil_properties, only: reference_viscosity
   use operating_point, only: operating_point_type
   implicit none (type, external)
   private
   public :: preload, clearance_ratio, length_over_diameter, load, load_on_journal, specific_load
   public :: sommerfeld_number, of_supply, eccentricity_ratio, attitude_angle

contains

   !> Preload of each pad, 1 - c_r/c_m.
   pure function preload(bearing)
      type(bearing_type), intent(in) :: bearing
      real(wp) :: preload(bearing%pad_count())
      preload = 1 - bearing%assembled_clearance/bearing%machined_clearance
   end function preload

   !> c_r over R_J.
   pure real(wp) function clearance_ratio(bearing)
      type(bearing_type), intent(in) :: bearing
      clearance_ratio = bearing%clearance()/bearing%journal_radius
   end function clearance_ratio

   !> L over D, of the longest pad.
   pure real(wp) function length_over_diameter(bearing)
      type(bearing_type), intent(in) :: bearing
      length_over_diameter = maxval(bearing%axial_length)/(2*bearing%journal_radius)
   end function length_over_diameter

   !> Steady force on a rigid journal, weight and static load, along y and z, N.
   pure function load_on_journal(inputs) result(force)
      type(case_type), intent(in) :: inputs
      real(wp) :: force(2)
      type(operating_point_type) :: point
      point = operating_point_type(inputs)
      force = point%load
   end function load_on_journal

   !> Its size W, N.
   pure real(wp) function load(inputs)
      type(case_type), intent(in) :: inputs
      load = norm2(load_on_journal(inputs))
   end function load

   !> W/(L D), Pa, with the length of the longest pad.
   pure real(wp) function specific_load(inputs)
      type(case_type), intent(in) :: inputs
      associate (b => inputs%bearings(1))
         specific_load = load(inputs)/(2*b%journal_radius*maxval(b%axial_length))
      end associate
   end function specific_load

   !> S = mu N L D/W (R_J/c_r)^2 with the speed N at the start in revolutions a second; there must be a load. Warm oil
   !> has the viscosity of the supply here.
   pure real(wp) function sommerfeld_number(inputs)
      type(case_type), intent(in) :: inputs
      associate (b => inputs%bearings(1))
         sommerfeld_number = reference_viscosity(b)*inputs%operation%speed_rpm/60/specific_load(inputs) &
            & /clearance_ratio(b)**2
      end associate
   end function sommerfeld_number

   !> Which viscosity the Sommerfeld number has, and of pads with a preload which clearance: "28.1 mPa s of the supply
   !> at 45 C, c_r 120 um as assembled".
   pure function of_supply(bearing) result(words)
      type(bearing_type), intent(in) :: bearing
      character(len=:), allocatable :: words
      words = fixed_text(1e3_wp*reference_viscosity(bearing), 2)//' mPa s'
      if (bearing%oil%law /= 'constant') words = words//' of the supply at ' &
         & //to_text(bearing%oil%supply_temperature)//' C'
      if (maxval(abs(preload(bearing))) > sqrt(epsilon(1.0_wp))) words = words//', c_r ' &
         & //to_text(1e6_wp*bearing%clearance())//' um as assembled'
   end function of_supply

   !> Distance of the journal, at (y, z), m, from the middle over c_r.
   pure real(wp) function eccentricity_ratio(bearing, journal)
      type(bearing_type), intent(in) :: bearing
      real(wp), intent(in) :: journal(2)
      eccentricity_ratio = norm2(journal)/bearing%clearance()
   end function eccentricity_ratio

   !> Angle from the load to the journal, at (y, z), m, in the sense of rotation, from -pi to pi; 0 where one of them
   !> has no direction.
   pure real(wp) function attitude_angle(inputs, journal)
      type(case_type), intent(in) :: inputs
      real(wp), intent(in) :: journal(2)
      real(wp) :: along, across
      associate (force => load_on_journal(inputs))
         along = dot_product(force, journal)
         across = inputs%sense()*(force(1)*journal(2) - force(2)*journal(1))
      end associate
      attitude_angle = 0
      if (abs(along) + abs(across) > 0) attitude_angle = atan2(across, along)
   end function attitude_angle
end module bearing_numbers
