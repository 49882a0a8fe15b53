!> The elastic rotor of a case on its journals: shaft, discs and supports, reduced to few displacements.
module shaft_in_bearings
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   ! heap: matrices of all displacements of a shaft
   use kinds, only: wp
   use text, only: list_text, to_text
   use errors, only: error_type, input_error, raise
   use case_groups, only: bearing_type
   use case_inputs, only: case_type
   use rotor_component, only: rotor_component_type, shaft_component, given_component
   use component_checks, only: check_component
   use fixed_interface, only: fixed_interface_type, find_fixed_interface
   use mode_selection, only: mode_selection_type, select_modes, most_modes
   use rotor_matrices, only: rotor_matrices_type, reduced_rotor
   implicit none (type, external)
   private
   public :: find_rotor

contains

   !> The equations of a case's rotor for runs up to a speed, rad/s.
   subroutine find_rotor(inputs, highest_speed, matrices, error, modes)
      type(case_type), intent(in) :: inputs
      real(wp), intent(in) :: highest_speed
      type(rotor_matrices_type), intent(out) :: matrices
      type(error_type), allocatable, intent(out) :: error
      !> Modes with the journals held that are kept, in a plane of a shaft; left out, they are chosen.
      integer, intent(in), optional :: modes
      type(rotor_component_type) :: component
      type(fixed_interface_type) :: fixed
      type(mode_selection_type) :: selection
      integer, allocatable :: border(:)
      logical :: held
      associate (rotor => inputs%rotor%elastic)
         if (rotor%rotor_file == '') then
            component = shaft_component(rotor)
            call check_numbers(component, error)
         else if (allocated(rotor%given)) then
            component = given_component(rotor%given)
            call check_component(inputs, component, error)
         else
            call raise(error, input_error, 'rotor%file = '''//rotor%rotor_file//''': is not read here')
         end if
      end associate
      if (allocated(error)) return
      call component%turn_in(inputs%sense())
      border = journal_displacements(inputs%bearings, component)
      call find_fixed_interface(component, border, fixed, held)
      if (.not. held) call raise(error, input_error, 'machine: its bearings (at the stations ' &
         & //list_text(real(inputs%bearings%station, wp))//') do not hold the shaft: it needs two at different ' &
         & //'stations, and sections with stiffness between them')
      if (allocated(error)) return
      if (present(modes)) then
         selection%modes = min(modes, size(fixed%frequency))
      else
         call select_modes(inputs, component, fixed, border, highest_speed, selection)
         if (fixed%planes*selection%modes > most_modes) call raise(error, input_error, 'reduction%frequency = ' &
            & //to_text(inputs%rotor%elastic%reduction%frequency)//': '//to_text(fixed%planes*selection%modes) &
            & //' modes are below it, those of both planes; a machine keeps at most '//to_text(most_modes))
         if (allocated(error)) return
      end if
      matrices = reduced_rotor(inputs, component, fixed, selection%modes)
      matrices%truncation_error = selection%truncation_error
      matrices%damping_error = selection%damping_error
   end subroutine find_rotor

   !> Displacements y and z of each journal among those of the rotor.
   pure function journal_displacements(bearings, component) result(border)
      type(bearing_type), intent(in) :: bearings(:)
      type(rotor_component_type), intent(in) :: component
      integer :: border(2*size(bearings)), b, p
      do b = 1, size(bearings)
         do p = 1, 2
            border(2*(b - 1) + p) = maxloc(component%station(2*(bearings(b)%station - 1) + p, :), dim=1)
         end do
      end do
   end function journal_displacements

   subroutine check_numbers(component, error)
      type(rotor_component_type), intent(in) :: component
      type(error_type), allocatable, intent(inout) :: error
      if (.not. (all(ieee_is_finite(component%mass)) .and. all(ieee_is_finite(component%stiffness)) &
         & .and. all(ieee_is_finite(component%gyroscopic)))) call raise(error, input_error, 'shaft: its mass or ' &
         & //'stiffness is too large for a number: lengths and diameters are in m, moduli in Pa')
   end subroutine check_numbers
end module shaft_in_bearings
