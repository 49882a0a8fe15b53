!> What moves in a mode, in words: 'journal, forward', 'shaft, backward', 'pad 3, tilt', 'pads, pivot deflection'.
module mode_names
   use kinds, only: wp
   use text, only: to_text, replaced
   use state_layout, only: of_journal
   use abstract_element, only: element_pointer
   use equations_of_motion, only: machine_model
   implicit none (type, external)
   private
   public :: mode_name_length, mode_name, is_of_rotor, at_stations, position_lengths, position_names

   !> Lengths of the names of modes, and of positions.
   integer, parameter :: mode_name_length = 100, longest_position = 19
   !> Pads that tilt follow the journal, so that their tilts are as large as its displacement in its own modes, and many
   !> times as large in those of pads: a mode is the rotor's if its displacement is this part of the largest, or more.
   real(wp), parameter :: share_of_rotor = 0.25_wp
   !> A mode is of several pads if a second one moves this part of the largest, or more.
   real(wp), parameter :: share_of_pad = 0.5_wp

contains

   !> The name of a mode of this shape: by its largest part, as its positions are displaced times the lengths that stand
   !> for 1 rad of a tilt. A vibration of the rotor goes forward, in the sense of rotation, or backward.
   function mode_name(model, shape, lengths, vibrates) result(name)
      type(machine_model), intent(in), target :: model
      complex(wp), intent(in) :: shape(:)
      real(wp), intent(in) :: lengths(:)
      logical, intent(in) :: vibrates
      character(len=mode_name_length) :: name
      real(wp) :: sizes(size(shape)), of_pad, largest, second
      type(element_pointer), allocatable :: elements(:)
      integer :: b, i, bearing, pad
      sizes = abs(shape)*lengths
      if (maxval(sizes(:model%rotor%positions)) >= share_of_rotor*maxval(sizes)) then
         name = merge('shaft  ', 'journal', model%rotor%stations > 0)
         if (vibrates) name = trim(name)//merge(', forward ', ', backward', goes_forward(model, shape))
         return
      end if
      largest = 0
      second = 0
      do b = 1, size(model%layout%elements)
         do i = 1, model%layout%elements(b)%pads
            if (model%layout%elements(b)%coordinates == 0) cycle
            of_pad = maxval(sizes(model%layout%elements(b)%own_positions(i)))
            second = max(second, min(of_pad, largest))
            if (of_pad <= largest) cycle
            largest = of_pad
            bearing = b
            pad = i
         end do
      end do
      name = 'pads'
      if (second < share_of_pad*largest) then
         name = 'pad '//to_text(pad)
         if (bearing <= size(model%bearings)) then
            name = model%inputs%bearings(bearing)%label(', ')//name
         else
            name = 'element '//to_text(bearing - size(model%bearings))//', '//name
         end if
      end if
      elements = model%elements()
      associate (of => model%layout%elements(bearing))
         name = trim(name)//', '//replaced(elements(bearing)%to%position_name(maxloc(sizes(of%own_positions(pad)), &
            & dim=1)), '_', ' ')
      end associate
   end function mode_name

   !> What stands for a unit of each position, m: of a rotor's coordinate that is no displacement how far it moves a
   !> station; of a pad's tilt the distance from the pivot to the centre of its arc; 1 for others.
   function position_lengths(model) result(lengths)
      type(machine_model), intent(in) :: model
      real(wp), allocatable :: lengths(:)
      allocate (lengths(model%layout%n_positions()), source=1.0_wp)
      associate (n => 2*model%rotor%journals, m => model%rotor%positions)
         lengths(n + 1:m) = minval(model%bearings%clearance)/model%scale(n + 1:m)
      end associate
      lengths(model%rotor%positions + 1:) = model%own_lengths()
   end function position_lengths

   !> Names of the displacements of a bearing's journal and pads, in the order of all_positions of its layout.
   function position_names(model, b) result(names)
      type(machine_model), intent(in) :: model
      integer, intent(in) :: b
      character(len=longest_position) :: names(of_journal + model%layout%elements(b)%pads &
         & *model%layout%elements(b)%coordinates)
      integer :: i, k
      names(:of_journal) = ['y', 'z']
      associate (n => model%layout%elements(b)%coordinates)
         do i = 1, model%layout%elements(b)%pads
            do k = 1, n
               names(of_journal + (i - 1)*n + k) = model%bearings(b)%position_name(k)//'_'//to_text(i)
            end do
         end do
      end associate
   end function position_names

   !> Whether a mode of this name is one of the rotor, and not of pads.
   elemental logical function is_of_rotor(name)
      character(len=*), intent(in) :: name
      is_of_rotor = index(name, 'journal') == 1 .or. index(name, 'shaft') == 1
   end function is_of_rotor

   !> By the stations of a shaft, or by the journal.
   pure logical function goes_forward(model, shape)
      type(machine_model), intent(in) :: model
      complex(wp), intent(in) :: shape(:)
      complex(wp) :: stations(2, model%rotor%stations)
      if (model%rotor%stations > 0) then
         stations = at_stations(model, shape)
         goes_forward = model%point%sense*aimag(sum(conjg(stations(1, :))*stations(2, :))) < 0
      else
         goes_forward = model%point%sense*aimag(conjg(shape(1))*shape(2)) < 0
      end if
   end function goes_forward

   !> Stations of the rotor's displacements, which turn, m.
   pure function at_stations(model, positions) result(stations)
      type(machine_model), intent(in) :: model
      complex(wp), intent(in) :: positions(:)
      complex(wp) :: stations(2, model%rotor%stations)
      real(wp) :: states(model%rotor%states), still(2, model%rotor%stations)
      real(wp), dimension(2, model%rotor%stations) :: re, im
      associate (n => model%rotor%positions)
         states = 0
         still = model%rotor%station_displacements(states)
         states(:n) = positions(:n)%re
         re = model%rotor%station_displacements(states) - still
         states(:n) = positions(:n)%im
         im = model%rotor%station_displacements(states) - still
      end associate
      stations = cmplx(re, im, wp)
   end function at_stations
end module mode_names
