!> This module alone knows where the states lie. Those of the rotor come first, displacements and then their rates.
!> Those of the elements follow, of each those of its first pad, of its second, ..: each of its displacements with its
!> rate (of a pad its tilt and, on a flexible pivot, its pivot deflection, then its pitch and its yaw) and (LuGre) the
!> bristle deflection, one for each way in which the pivot turns. A state that an element lacks is left out: fixed pads
!> have none. The bearings are the first elements; others need have no pads.
module state_layout
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: state_layout_type, element_layout_type, new_element_layout, new_state_layout
   public :: pad_state, tilt, pivot_deflection, pitch, yaw, most_coordinates, most_rotations, of_journal

   !> What a pad may do: its tilt, rad, the deflection of its pivot, m, and the slopes of its axis over that of the
   !> bearing outward (pitch) and along the pad (yaw), rad. The tilt, pitch and yaw turn it in its pivot.
   integer, parameter :: tilt = 1, pivot_deflection = 2, pitch = 3, yaw = 4, most_coordinates = 4, most_rotations = 3
   !> Displacements of a journal, y and z.
   integer, parameter :: of_journal = 2

   !> State of a pad; what a pad lacks stays 0.
   type :: pad_state
      !> Its displacements and their rates.
      real(wp) :: x(most_coordinates) = 0, v(most_coordinates) = 0
      !> Deflection of the bristles, m, one for each of its rotations, the tilt first.
      real(wp) :: bristle(most_rotations) = 0
   end type pad_state

   !> By its tilt, rad, and the deflection of its pivot, m, with their rates, and that of its bristles, m.
   interface pad_state
      module procedure new_pad_state
   end interface pad_state

   !> The pads of one element, numbered from 1.
   type :: element_layout_type
      !> Pads, displacements of a pad, states of a pad (displacements, rates and bristles).
      integer :: pads = 0, coordinates = 0, per_pad = 0
      !> Parts that act on the pair of the rotor: the pads, or one where there are none.
      integer :: parts = 0
      !> Of each displacement its place in pad_state.
      integer :: kind(most_coordinates) = 0
      !> Whether there are bristles, and how many of the displacements turn the pad, each of which has its own; their
      !> places among the displacements.
      logical :: bristles = .false.
      integer :: rotations = 0, rotation(most_rotations) = 0
      !> Numbers of its first and last pad among those of all elements; states and displacements before those of its
      !> first pad.
      integer :: first_pad = 1, last_pad = 0, states_before = 0, positions_before = 0
      !> Places of the displacements y and z on which it acts, those of its journal, among those of the rotor, and of
      !> the rates among its states.
      integer :: journal(of_journal) = [1, 2], journal_rates(of_journal) = [3, 4]
      !> How many displacements of the rotor it knows: those, and where slopes of the journal act in it these, which are
      !> at these places.
      integer :: of_rotor = of_journal, slopes(of_journal) = 0
   contains
      procedure :: has
      procedure :: pair
      procedure :: on_rotor
      procedure :: before
      procedure :: bristle
      procedure :: first_position
      procedure :: own_positions
      procedure :: positions_of
      procedure :: all_positions
      procedure :: all_pads
      procedure :: pad_states
      procedure :: take_pads
      procedure :: put_pads
   end type element_layout_type

   type :: state_layout_type
      !> States of the rotor, pads of all elements, all states.
      integer :: rotor = 0, pads = 0, n = 0
      type(element_layout_type), allocatable :: elements(:)
   contains
      procedure :: positions
      procedure :: rates
      procedure :: n_positions
      procedure :: tilts
      procedure :: turning
      procedure :: put_all_pads
   end type state_layout_type

contains

   elemental type(pad_state) function new_pad_state(angle, rate, deflection, deflection_rate, bristle) result(pad)
      real(wp), intent(in), optional :: angle, rate, deflection, deflection_rate, bristle
      if (present(angle)) pad%x(tilt) = angle
      if (present(rate)) pad%v(tilt) = rate
      if (present(deflection)) pad%x(pivot_deflection) = deflection
      if (present(deflection_rate)) pad%v(pivot_deflection) = deflection_rate
      if (present(bristle)) pad%bristle(1) = bristle
   end function new_pad_state

   !> The layout of an element with this number of pads, whose displacements are of these kinds, before it has its place
   !> among others. Bristles are those of the displacements that turn the pads, at these places; left out: of the first.
   pure type(element_layout_type) function new_element_layout(pads, kind, bristles, rotation) result(layout)
      integer, intent(in) :: pads, kind(:)
      logical, intent(in) :: bristles
      integer, intent(in), optional :: rotation(:)
      layout%pads = pads
      layout%parts = max(1, pads)
      layout%coordinates = size(kind)
      layout%kind(:size(kind)) = kind
      layout%bristles = bristles .and. size(kind) > 0
      layout%rotations = min(1, size(kind))
      layout%rotation(1) = layout%rotations
      if (present(rotation)) then
         layout%rotations = size(rotation)
         layout%rotation(:size(rotation)) = rotation
      end if
      layout%per_pad = 2*size(kind) + merge(layout%rotations, 0, layout%bristles)
   end function new_element_layout

   !> The layout for a number of rotor states and the elements that act on these pairs of its displacements.
   pure type(state_layout_type) function new_state_layout(rotor, elements, pairs, slope_pairs) result(layout)
      integer, intent(in) :: rotor
      type(element_layout_type), intent(in) :: elements(:)
      integer, intent(in) :: pairs(:)
      !> Of each element the pair that are the slopes in it, 0: there is none; left out: there are none.
      integer, intent(in), optional :: slope_pairs(:)
      integer :: positions, e
      layout%rotor = rotor
      layout%elements = elements
      layout%n = rotor
      positions = rotor/2
      do e = 1, size(elements)
         associate (of => layout%elements(e))
            of%first_pad = layout%pads + 1
            of%last_pad = layout%pads + of%pads
            of%states_before = layout%n
            of%positions_before = positions
            of%journal = [2*pairs(e) - 1, 2*pairs(e)]
            of%journal_rates = rotor/2 + of%journal
            if (present(slope_pairs)) then
               if (slope_pairs(e) > 0) then
                  of%of_rotor = 2*of_journal
                  of%slopes = [2*slope_pairs(e) - 1, 2*slope_pairs(e)]
               end if
            end if
            layout%pads = of%last_pad
            layout%n = layout%n + of%pads*of%per_pad
            positions = positions + of%pads*of%coordinates
         end associate
      end do
   end function new_state_layout

   !> Whether its pads have a displacement of this kind.
   pure logical function has(self, kind)
      class(element_layout_type), intent(in) :: self
      integer, intent(in) :: kind
      has = any(self%kind(:self%coordinates) == kind)
   end function has

   !> Which pair of the rotor's displacements it acts on.
   pure integer function pair(self)
      class(element_layout_type), intent(in) :: self
      pair = self%journal(of_journal)/of_journal
   end function pair

   !> States before those of a pad: displacement k is this + 2 k - 1, its rate the next.
   elemental integer function before(self, pad)
      class(element_layout_type), intent(in) :: self
      integer, intent(in) :: pad
      before = self%states_before + (pad - 1)*self%per_pad
   end function before

   !> Index of a pad's first bristle deflection, behind which its others stand; only where there are bristles.
   elemental integer function bristle(self, pad)
      class(element_layout_type), intent(in) :: self
      integer, intent(in) :: pad
      bristle = self%before(pad) + 2*self%coordinates + 1
   end function bristle

   !> Place of the first displacement of a pad, its tilt; its others are the next.
   elemental integer function first_position(self, pad)
      class(element_layout_type), intent(in) :: self
      integer, intent(in) :: pad
      first_position = self%positions_before + (pad - 1)*self%coordinates + 1
   end function first_position

   !> Places of a pad's own displacements.
   pure function own_positions(self, pad) result(places)
      class(element_layout_type), intent(in) :: self
      integer, intent(in) :: pad
      integer :: places(self%coordinates), k
      places = [(self%first_position(pad) + k, k=0, self%coordinates - 1)]
   end function own_positions

   !> Places of the displacements of the rotor that it knows: the journal's, and its slopes where they act.
   pure function on_rotor(self) result(places)
      class(element_layout_type), intent(in) :: self
      integer :: places(self%of_rotor)
      places(:of_journal) = self%journal
      if (self%of_rotor > of_journal) places(of_journal + 1:) = self%slopes
   end function on_rotor

   !> Places of these and of those of a pad.
   pure function positions_of(self, pad) result(places)
      class(element_layout_type), intent(in) :: self
      integer, intent(in) :: pad
      integer :: places(self%of_rotor + self%coordinates)
      places(:self%of_rotor) = self%on_rotor()
      places(self%of_rotor + 1:) = self%own_positions(pad)
   end function positions_of

   !> Places of these and of those of all pads.
   pure function all_positions(self) result(places)
      class(element_layout_type), intent(in) :: self
      integer :: places(self%of_rotor + self%pads*self%coordinates), i
      places(:self%of_rotor) = self%on_rotor()
      places(self%of_rotor + 1:) = [(self%own_positions(i), i=1, self%pads)]
   end function all_positions

   !> The numbers of these pads among those of all bearings.
   pure function all_pads(self) result(numbers)
      class(element_layout_type), intent(in) :: self
      integer :: numbers(self%pads), i
      numbers = [(i, i=self%first_pad, self%last_pad)]
   end function all_pads

   !> Indices of all displacements: of the rotor, and of the pads in the order of the states.
   pure function positions(self)
      class(state_layout_type), intent(in) :: self
      integer, allocatable :: positions(:)
      positions = displacements_or_rates(self, 0)
   end function positions

   !> Indices of their rates, in the same order.
   pure function rates(self)
      class(state_layout_type), intent(in) :: self
      integer, allocatable :: rates(:)
      rates = displacements_or_rates(self, 1)
   end function rates

   pure function displacements_or_rates(self, rate) result(indices)
      class(state_layout_type), intent(in) :: self
      !> 0: displacements; 1: rates.
      integer, intent(in) :: rate
      integer, allocatable :: indices(:)
      integer :: b, i, k
      indices = [(rate*self%rotor/2 + i, i=1, self%rotor/2)]
      do b = 1, size(self%elements)
         associate (of => self%elements(b))
            indices = [indices, ((of%before(i) + k + rate, k=1, 2*of%coordinates, 2), i=1, of%pads)]
         end associate
      end do
   end function displacements_or_rates

   !> Number of displacements.
   pure integer function n_positions(self)
      class(state_layout_type), intent(in) :: self
      n_positions = self%rotor/2 + sum(self%elements%pads*self%elements%coordinates)
   end function n_positions

   !> Which displacements are tilts, of all pads that tilt.
   pure function tilts(self)
      class(state_layout_type), intent(in) :: self
      integer, allocatable :: tilts(:)
      integer :: b, i
      allocate (tilts(0))
      do b = 1, size(self%elements)
         associate (of => self%elements(b))
            if (of%has(tilt)) tilts = [tilts, (of%first_position(i), i=1, of%pads)]
         end associate
      end do
   end function tilts

   !> Which displacements turn pads in their pivots: their tilts, pitches and yaws.
   pure function turning(self)
      class(state_layout_type), intent(in) :: self
      integer, allocatable :: turning(:)
      integer :: b, i, k
      allocate (turning(0))
      do b = 1, size(self%elements)
         associate (of => self%elements(b))
            if (of%has(tilt)) turning = [turning, ((of%first_position(i) + of%rotation(k) - 1, k=1, of%rotations), &
               & i=1, of%pads)]
         end associate
      end do
   end function turning

   !> The states of the pads; what they lack is 0.
   pure function pad_states(self, y) result(pads)
      class(element_layout_type), intent(in) :: self
      real(wp), intent(in) :: y(:)
      type(pad_state) :: pads(self%pads)
      call self%take_pads(y, pads)
   end function pad_states

   !> Sets those states of pads that y has; what the element has not stays.
   pure subroutine take_pads(self, y, pads)
      class(element_layout_type), intent(in) :: self
      real(wp), intent(in) :: y(:)
      type(pad_state), intent(inout) :: pads(:)
      integer :: i, k, o
      do i = 1, self%pads
         o = self%before(i)
         do k = 1, self%coordinates
            pads(i)%x(self%kind(k)) = y(o + 2*k - 1)
            pads(i)%v(self%kind(k)) = y(o + 2*k)
         end do
         if (.not. self%bristles) cycle
         o = o + 2*self%coordinates
         pads(i)%bristle(1) = y(o + 1)
         do k = 2, self%rotations
            pads(i)%bristle(k) = y(o + k)
         end do
      end do
   end subroutine take_pads

   !> Puts those states of the pads into y that the element has.
   pure subroutine put_pads(self, pads, y)
      class(element_layout_type), intent(in) :: self
      type(pad_state), intent(in) :: pads(:)
      real(wp), intent(inout) :: y(:)
      integer :: i, k, o
      do i = 1, self%pads
         o = self%before(i)
         do k = 1, self%coordinates
            y(o + 2*k - 1) = pads(i)%x(self%kind(k))
            y(o + 2*k) = pads(i)%v(self%kind(k))
         end do
         if (self%bristles) y(o + 2*self%coordinates + 1:o + self%per_pad) = pads(i)%bristle(:self%rotations)
      end do
   end subroutine put_pads

   !> The same with the pads of all bearings.
   pure subroutine put_all_pads(self, pads, y)
      class(state_layout_type), intent(in) :: self
      type(pad_state), intent(in) :: pads(:)
      real(wp), intent(inout) :: y(:)
      integer :: b
      do b = 1, size(self%elements)
         call self%elements(b)%put_pads(pads(self%elements(b)%all_pads()), y)
      end do
   end subroutine put_all_pads
end module state_layout
