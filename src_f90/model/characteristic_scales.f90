!> The characteristic scale of each state, over which tolerances and corrections are measured.
module characteristic_scales
   use kinds, only: wp
   use operating_point, only: operating_point_type
   use abstract_rotor, only: rotor_type
   use abstract_element, only: element_pointer
   use state_layout, only: state_layout_type
   implicit none (type, external)
   private
   public :: state_scales

contains

   !> Characteristic scale of each state of a rotor and its elements, of which the first are bearings with these
   !> clearances, m: what its elements say of theirs under the load on them; rates: times the highest speed, rad/s.
   pure function state_scales(highest_speed, point, rotor, elements, clearances, layout) result(scale)
      real(wp), intent(in) :: highest_speed, clearances(:)
      type(operating_point_type), intent(in) :: point
      class(rotor_type), intent(in) :: rotor
      type(element_pointer), intent(in) :: elements(:)
      type(state_layout_type), intent(in) :: layout
      real(wp) :: scale(layout%n), loads(2, rotor%positions/2)
      integer :: e
      ! what is no journal has none of them
      loads = 0
      loads(:, :rotor%journals) = rotor%loads(point)
      associate (n => rotor%positions)
         scale(:n) = rotor%scales(clearances)
         scale(n + 1:2*n) = scale(:n)*highest_speed
      end associate
      do e = 1, size(elements)
         associate (of => layout%elements(e), force => norm2(loads(:, layout%elements(e)%pair())) &
            & + point%unbalance*highest_speed**2)
            call of%put_pads(elements(e)%to%scales(of%pads, force, highest_speed), scale)
         end associate
      end do
   end function state_scales
end module characteristic_scales
