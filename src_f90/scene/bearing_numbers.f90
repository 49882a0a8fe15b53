!> What a bearing engineer calculates from a scene before any run.
module bearing_numbers
   use kinds, only: wp
   use scene, only: scene_type
   use oil_properties, only: reference_viscosity
   use operating_point, only: operating_point_type
   implicit none (type, external)
   private
   public :: preload, clearance_ratio, length_over_diameter, load, specific_load, sommerfeld_number
   public :: eccentricity_ratio, attitude_angle

contains

   !> Preload of the pads, 1 - c_r/c_m.
   pure real(wp) function preload(scene)
      type(scene_type), intent(in) :: scene
      preload = 1 - scene%bearing%assembled_clearance/scene%bearing%machined_clearance
   end function preload

   !> c_r over R_J.
   pure real(wp) function clearance_ratio(scene)
      type(scene_type), intent(in) :: scene
      clearance_ratio = scene%bearing%assembled_clearance/scene%bearing%journal_radius
   end function clearance_ratio

   !> L over D.
   pure real(wp) function length_over_diameter(scene)
      type(scene_type), intent(in) :: scene
      length_over_diameter = scene%bearing%axial_length/(2*scene%bearing%journal_radius)
   end function length_over_diameter

   !> Steady force W on the journal, weight and static load, N.
   pure real(wp) function load(scene)
      type(scene_type), intent(in) :: scene
      associate (point => operating_point_type(scene))
         load = norm2(point%load)
      end associate
   end function load

   !> W/(L D), Pa.
   pure real(wp) function specific_load(scene)
      type(scene_type), intent(in) :: scene
      associate (b => scene%bearing)
         specific_load = load(scene)/(2*b%journal_radius*b%axial_length)
      end associate
   end function specific_load

   !> S = mu N L D/W (R_J/c_r)^2 with the speed N at the start in revolutions a second; there must be a load. Warm oil
   !> has the viscosity of the supply here.
   pure real(wp) function sommerfeld_number(scene)
      type(scene_type), intent(in) :: scene
      sommerfeld_number = reference_viscosity(scene)*scene%operation%speed_rpm/60/specific_load(scene) &
         & /clearance_ratio(scene)**2
   end function sommerfeld_number

   !> Distance of the journal, at (y, z), m, from the middle over c_r.
   pure real(wp) function eccentricity_ratio(scene, journal)
      type(scene_type), intent(in) :: scene
      real(wp), intent(in) :: journal(2)
      eccentricity_ratio = norm2(journal)/scene%bearing%assembled_clearance
   end function eccentricity_ratio

   !> Angle from the load to the journal, at (y, z), m, in the sense of rotation, from -pi to pi; 0 where one of them
   !> has no direction.
   pure real(wp) function attitude_angle(scene, journal)
      type(scene_type), intent(in) :: scene
      real(wp), intent(in) :: journal(2)
      real(wp) :: along, across
      associate (point => operating_point_type(scene))
         along = dot_product(point%load, journal)
         across = point%load(1)*journal(2) - point%load(2)*journal(1)
      end associate
      attitude_angle = 0
      if (abs(along) + abs(across) > 0) attitude_angle = atan2(across, along)
   end function attitude_angle
end module bearing_numbers
