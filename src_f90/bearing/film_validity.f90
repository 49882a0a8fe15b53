!> Which states of a pad have loads, and why others have none.
module film_validity
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use text, only: to_text
   use film_solver, only: film_response, film_ok, film_closed, film_not_converged
   use kinematics, only: pad_state
   use tilting_pad, only: tilting_pad_type
   implicit none (type, external)
   private
   public :: admitted, why_not

contains

   !> True where a pad stands and its film has a force.
   pure logical function admitted(pad, state, film)
      type(tilting_pad_type), intent(in) :: pad
      type(pad_state), intent(in) :: state
      type(film_response), intent(in) :: film
      admitted = abs(state%tilt) < pad%largest_tilt .and. film%status == film_ok .and. all(ieee_is_finite(film%force))
   end function admitted

   !> Why a pad's state is not admitted.
   function why_not(pad, number, state, film) result(reason)
      type(tilting_pad_type), intent(in) :: pad
      integer, intent(in) :: number
      type(pad_state), intent(in) :: state
      type(film_response), intent(in) :: film
      character(len=:), allocatable :: reason, thickness
      thickness = ': thickness '//to_text(film%min_film_thickness)//' m'
      if (.not. abs(state%tilt) < pad%largest_tilt) then
         reason = 'pad '//to_text(number)//' turned over: tilt '//to_text(state%tilt)//' rad'
      else if (film%status == film_closed) then
         reason = 'the film of pad '//to_text(number)//' closed'//thickness
      else if (film%status == film_not_converged .and. .not. film%residual > 0) then
         reason = 'the film of pad '//to_text(number)//' did not converge: where it cavitates does not settle; try ' &
            & //'other volumes (film%circumferential_cells, film%axial_cells)'
      else if (film%status == film_not_converged) then
         reason = 'the film of pad '//to_text(number)//' did not converge: residual '//to_text(film%residual) &
            & //' after film%max_sweeps = '//to_text(film%max_sweeps)
      else
         reason = 'the film force of pad '//to_text(number)//' is not finite'//thickness
      end if
   end function why_not
end module film_validity
