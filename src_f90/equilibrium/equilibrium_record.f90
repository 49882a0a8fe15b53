!> The record of an equilibrium.
module equilibrium_record
   use kinds, only: wp
   use film_solver, only: film_oil
   use film_network, only: warm_films_type
   use bearing_shape, only: bearing_shape_type
   use state_layout, only: pad_state
   use tilting_pad_bearing, only: pad_sample
   use equations_of_motion, only: machine_model
   use errors, only: error_type, raise, numerics_error
   use force_balance, only: stability_type, stability_at
   implicit none (type, external)
   private
   public :: equilibrium_type, describe, describe_with_stability

   type :: equilibrium_type
      !> Displacements of the rotor, those of its journals, m, first.
      real(wp), allocatable :: rotor(:)
      !> Of all bearings: states of the pads at rest; pivot loads, N.
      type(pad_state), allocatable :: pads(:)
      real(wp), allocatable :: pivot_load(:)
      !> Per pad minimum film thickness, m, and maximum pressure, Pa.
      real(wp), allocatable :: min_film_thickness(:), max_pressure(:)
      !> The oil of every pad's film; its temperatures in each bearing, where films have them along and across.
      type(film_oil), allocatable :: oil(:)
      type(warm_films_type), allocatable :: films(:)
      !> Of all bearings, where it changes the shape of one.
      type(bearing_shape_type), allocatable :: shapes(:)
      !> Largest unbalanced force over the reference force (pseudo_transient).
      real(wp) :: residual = huge(1.0_wp)
      type(stability_type) :: stability
      !> Which search found it.
      character(len=:), allocatable :: search
   end type equilibrium_type

contains

   !> The record of the equilibrium y, where the model was evaluated last.
   subroutine describe(model, y, found)
      type(machine_model), intent(inout) :: model
      real(wp), intent(in) :: y(:)
      type(equilibrium_type), intent(inout) :: found
      type(pad_state) :: pads(model%layout%pads)
      type(pad_sample) :: samples(model%layout%pads)
      integer :: b
      do b = 1, size(model%bearings)
         associate (of => model%layout%elements(b))
            pads(of%all_pads()) = of%pad_states(y)
            samples(of%all_pads()) = model%bearings(b)%sampled()
         end associate
      end do
      found%rotor = y(:model%rotor%positions)
      found%pads = pads
      found%pivot_load = samples%pivot_load
      found%min_film_thickness = samples%min_film_thickness
      found%max_pressure = samples%max_pressure
      found%oil = model%oil
   end subroutine describe

   !> The same with its stability; an error where this is not found.
   subroutine describe_with_stability(model, y, found, error)
      type(machine_model), intent(inout) :: model
      real(wp), intent(in) :: y(:)
      type(equilibrium_type), intent(inout) :: found
      type(error_type), allocatable, intent(out) :: error
      logical :: ok
      call describe(model, y, found)
      call stability_at(model, y, found%stability, ok)
      if (.not. ok) call raise(error, numerics_error, 'the eigenvalues of the equilibrium are not found')
   end subroutine describe_with_stability
end module equilibrium_record
