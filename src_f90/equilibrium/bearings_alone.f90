!> The bearings of a machine, each alone with a rigid journal that bears what the rotor lays on it: what is known of one
!> bearing then holds for each.
module bearings_alone
   use kinds, only: wp
   use factories, only: march_films, static_films
   use equations_of_motion, only: machine_model, new_machine_model
   use state_layout, only: of_journal
   use bearing_samples, only: element_forces
   use equilibrium_record, only: equilibrium_type
   implicit none (type, external)
   private
   public :: bearing_alone, part_of, bearing_loads, forces_at_rest

contains

   !> A static model of bearing b alone under a load along y and z, N, at the speed of the machine.
   function bearing_alone(model, b, load) result(alone)
      type(machine_model), intent(in) :: model
      integer, intent(in) :: b
      real(wp), intent(in) :: load(2)
      type(machine_model) :: alone
      integer :: accuracy
      accuracy = model%bearings(b)%accuracy
      if (accuracy == march_films) accuracy = static_films
      alone = new_machine_model(model%inputs%alone(b, load), accuracy)
      alone%point%speed_rpm = model%point%speed_rpm
      alone%point%cavitation = model%point%cavitation
      call alone%set_point(alone%point%static())
      alone%oil = model%oil(model%layout%elements(b)%all_pads())
   end function bearing_alone

   !> What an equilibrium is in bearing b.
   function part_of(model, found, b) result(part)
      type(machine_model), intent(in) :: model
      type(equilibrium_type), intent(in) :: found
      integer, intent(in) :: b
      type(equilibrium_type) :: part
      part = found
      part%rotor = found%rotor(2*b - 1:2*b)
      if (allocated(found%films)) part%films = found%films(b:b)
      if (allocated(found%shapes)) part%shapes = found%shapes(b:b)
      associate (pads => model%layout%elements(b)%all_pads())
         part%pads = found%pads(pads)
         part%pivot_load = found%pivot_load(pads)
         part%min_film_thickness = found%min_film_thickness(pads)
         part%max_pressure = found%max_pressure(pads)
         part%oil = found%oil(pads)
      end associate
   end function part_of

   !> What the rotor, at rest in this equilibrium, lays on its bearings, (2, bearing), N, along y and z.
   pure function bearing_loads(model, found) result(loads)
      type(machine_model), intent(in) :: model
      type(equilibrium_type), intent(in) :: found
      real(wp) :: loads(2, size(model%bearings)), force(model%rotor%positions)
      force = forces_at_rest(model, model%static_state(found%rotor, found%pads))
      loads = reshape(force(:size(loads)), shape(loads))
   end function bearing_loads

   !> Forces on the displacements of the rotor, at rest in the state y, N, but for those of its bearings.
   pure function forces_at_rest(model, y) result(force)
      type(machine_model), intent(in) :: model
      real(wp), intent(in) :: y(:)
      real(wp) :: force(model%rotor%positions), of_others(of_journal, size(model%others))
      integer :: e
      force = model%rotor%force(y(:model%rotor%states), model%point%static(), 0.0_wp)
      of_others = element_forces(model, 0.0_wp, y)
      do e = 1, size(model%others)
         associate (at => model%layout%elements(size(model%bearings) + e)%journal)
            force(at) = force(at) + of_others(:, e)
         end associate
      end do
   end function forces_at_rest
end module bearings_alone
