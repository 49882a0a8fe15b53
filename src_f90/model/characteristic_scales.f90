!> The characteristic scale of each state, over which tolerances and corrections are measured.
module characteristic_scales
   use kinds, only: wp, degree
   use case_groups, only: bearing_type
   use case_inputs, only: case_type
   use operating_point, only: operating_point_type
   use kinematics, only: pad_state
   use tilting_pad_bearing, only: tilting_pad_bearing_type
   use abstract_rotor, only: rotor_type
   use state_layout, only: state_layout_type, pads_layout_type
   implicit none (type, external)
   private
   public :: state_scales

   !> Scale of the tilt rate over that at which Bengisu-Akay friction changes its direction.
   real(wp), parameter :: sticking_scale = 10

contains

   !> Characteristic scale of each state: clearance; clearance over pad length; the pivot deflection under the load;
   !> the deflection at which bristles yield; rates: times the highest speed, but the tilt rate not above
   !> ten times that at which friction changes its direction, or its moment would be no better than 1e-2.
   pure function state_scales(inputs, point, rotor, bearings, layout) result(scale)
      type(case_type), intent(in) :: inputs
      type(operating_point_type), intent(in) :: point
      class(rotor_type), intent(in) :: rotor
      type(tilting_pad_bearing_type), intent(in) :: bearings(:)
      type(state_layout_type), intent(in) :: layout
      real(wp) :: scale(layout%n)
      real(wp) :: speed
      real(wp) :: loads(2, size(bearings))
      integer :: b
      speed = inputs%highest_speed()
      loads = rotor%loads(point)
      associate (n => rotor%positions)
         scale(:n) = rotor%scales(bearings%clearance)
         scale(n + 1:2*n) = scale(:n)*speed
      end associate
      do b = 1, size(bearings)
         call layout%bearings(b)%put_pads(pad_scales(inputs%bearings(b), norm2(loads(:, b)) &
            & + point%unbalance*speed**2, bearings(b), layout%bearings(b), speed), scale)
      end do
   end function state_scales

   !> Those of the pads of a bearing with these inputs under a force, N, at the highest speed, rad/s.
   pure function pad_scales(b, force, bearing, layout, speed) result(pads)
      type(bearing_type), intent(in) :: b
      real(wp), intent(in) :: force
      type(tilting_pad_bearing_type), intent(in) :: bearing
      type(pads_layout_type), intent(in) :: layout
      real(wp), intent(in) :: speed
      type(pad_state) :: pads(layout%pads)
      integer :: i
      do i = 1, size(pads)
         pads(i)%tilt = b%assembled_clearance(i)/((b%journal_radius + b%machined_clearance(i)) &
            & *b%pads%arc_deg(i)*degree)
         pads(i)%tilt_rate = min(pads(i)%tilt*speed, sticking_scale*bearing%pivots(i)%friction%sticking_velocity &
            & /bearing%pads(i)%ball_radius)
         if (layout%radial) then
            pads(i)%pivot_deflection = 1e-3_wp*b%assembled_clearance(i)
            if (force > 0) pads(i)%pivot_deflection = max(pads(i)%pivot_deflection, &
               & bearing%pivots(i)%contact%law%pivot_deflection(force))
            pads(i)%pivot_deflection_rate = pads(i)%pivot_deflection*speed
         end if
         if (layout%bristles) pads(i)%deflection = bearing%pivots(i)%friction%static_coefficient &
            & /b%friction%bristle_stiffness
      end do
   end function pad_scales
end module characteristic_scales
