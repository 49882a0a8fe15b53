!> This module alone knows where the states lie. Those of the rotor come first, displacements and then their rates. The
!> pads of the first bearing follow, of the second, ..., each with tilt, tilt rate, (pivots that yield) pivot deflection
!> and its rate, (LuGre) bristle deflection. A state that a bearing lacks is left out: fixed pads have none.
module state_layout
   use kinds, only: wp
   use text, only: to_text
   use kinematics, only: pad_state, columns, journal_columns
   implicit none (type, external)
   private
   public :: state_layout_type, pads_layout_type, pads_layout, new_state_layout
   public :: at_tilt, at_tilt_rate, at_deflection, at_deflection_rate

   !> Order of a pad's own states; those of its motion stand in the order of the columns of its derivatives.
   integer, parameter :: at_tilt = 1, at_tilt_rate = 2, at_deflection = 3, at_deflection_rate = 4

   !> Names of a pad's displacements; length of such a name with the number of a pad.
   character(len=*), parameter :: of_pad(2) = [character(len=16) :: 'tilt', 'pivot_deflection']
   integer, parameter :: longest_name = 19

   !> The pads of one bearing, numbered from 1.
   type :: pads_layout_type
      !> Pads, states of a pad (its motion and its bristles).
      integer :: pads = 0, motion = 0, per_pad = 0
      !> Whether the pads tilt; whether their pivots yield; whether there are bristles.
      logical :: tilting = .true., radial = .false., bristles = .false.
      !> Pads of the bearings before; states and displacements before those of the first pad.
      integer :: other_pads = 0, states_before = 0, positions_before = 0
      !> Places of the journal's displacements y and z among those of the rotor, and of the rates among its states.
      integer :: journal(2) = [1, 2], journal_rates(2) = [3, 4]
   contains
      procedure :: before
      procedure :: bristle
      procedure :: first_position
      procedure :: own_positions
      procedure :: positions_of
      procedure :: all_positions
      procedure :: all_pads
      procedure :: pad_states
      procedure :: put_pads
      procedure :: over_columns
      procedure :: position_names
   end type pads_layout_type

   type :: state_layout_type
      !> States of the rotor, pads of all bearings, all states.
      integer :: rotor = 0, pads = 0, n = 0
      type(pads_layout_type), allocatable :: bearings(:)
   contains
      procedure :: positions
      procedure :: rates
      procedure :: n_positions
      procedure :: tilts
      procedure :: put_all_pads
   end type state_layout_type

contains

   !> The layout of a bearing's pads, before it has its place among others.
   pure type(pads_layout_type) function pads_layout(pads, tilting, radial, bristles) result(layout)
      integer, intent(in) :: pads
      logical, intent(in) :: tilting, radial, bristles
      layout%pads = pads
      layout%tilting = tilting
      layout%radial = tilting .and. radial
      layout%bristles = tilting .and. bristles
      layout%motion = 0
      if (tilting) layout%motion = merge(at_deflection_rate, at_tilt_rate, radial)
      layout%per_pad = layout%motion + merge(1, 0, layout%bristles)
   end function pads_layout

   !> The layout for a number of rotor states and the pads of its bearings.
   pure type(state_layout_type) function new_state_layout(rotor, bearings) result(layout)
      integer, intent(in) :: rotor
      type(pads_layout_type), intent(in) :: bearings(:)
      integer :: positions, b
      layout%rotor = rotor
      layout%bearings = bearings
      layout%n = rotor
      positions = rotor/2
      do b = 1, size(bearings)
         associate (of => layout%bearings(b))
            of%other_pads = layout%pads
            of%states_before = layout%n
            of%positions_before = positions
            of%journal = [2*b - 1, 2*b]
            of%journal_rates = rotor/2 + of%journal
            layout%pads = layout%pads + of%pads
            layout%n = layout%n + of%pads*of%per_pad
            positions = positions + of%pads*(of%motion/2)
         end associate
      end do
   end function new_state_layout

   !> States before those of a pad: its tilt is this + at_tilt.
   elemental integer function before(self, pad)
      class(pads_layout_type), intent(in) :: self
      integer, intent(in) :: pad
      before = self%states_before + (pad - 1)*self%per_pad
   end function before

   !> Index of a pad's bristle deflection; only where there are bristles.
   elemental integer function bristle(self, pad)
      class(pads_layout_type), intent(in) :: self
      integer, intent(in) :: pad
      bristle = self%before(pad) + self%per_pad
   end function bristle

   !> Which displacement is a pad's tilt; its pivot deflection is the next.
   elemental integer function first_position(self, pad)
      class(pads_layout_type), intent(in) :: self
      integer, intent(in) :: pad
      first_position = self%positions_before + (pad - 1)*(self%motion/2) + 1
   end function first_position

   !> Places of a pad's own displacements.
   pure function own_positions(self, pad) result(places)
      class(pads_layout_type), intent(in) :: self
      integer, intent(in) :: pad
      integer :: places(self%motion/2), k
      places = [(self%first_position(pad) + k, k=0, self%motion/2 - 1)]
   end function own_positions

   !> Places of the journal's displacements and of those of a pad.
   pure function positions_of(self, pad) result(places)
      class(pads_layout_type), intent(in) :: self
      integer, intent(in) :: pad
      integer :: places(2 + self%motion/2)
      places(:2) = self%journal
      places(3:) = self%own_positions(pad)
   end function positions_of

   !> Places of the journal's displacements and of those of all pads.
   pure function all_positions(self) result(places)
      class(pads_layout_type), intent(in) :: self
      integer :: places(2 + self%pads*(self%motion/2)), i
      places(:2) = self%journal
      places(3:) = [(self%own_positions(i), i=1, self%pads)]
   end function all_positions

   !> The numbers of these pads among those of all bearings.
   pure function all_pads(self) result(numbers)
      class(pads_layout_type), intent(in) :: self
      integer :: numbers(self%pads), i
      numbers = [(self%other_pads + i, i=1, self%pads)]
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
      do b = 1, size(self%bearings)
         associate (of => self%bearings(b))
            indices = [indices, ((of%before(i) + k + rate, k=1, of%motion, 2), i=1, of%pads)]
         end associate
      end do
   end function displacements_or_rates

   !> Number of displacements.
   pure integer function n_positions(self)
      class(state_layout_type), intent(in) :: self
      n_positions = self%rotor/2 + sum(self%bearings%pads*(self%bearings%motion/2))
   end function n_positions

   !> Which displacements are tilts, of all pads that tilt.
   pure function tilts(self)
      class(state_layout_type), intent(in) :: self
      integer, allocatable :: tilts(:)
      integer :: b, i
      allocate (tilts(0))
      do b = 1, size(self%bearings)
         associate (of => self%bearings(b))
            if (of%tilting) tilts = [tilts, (of%first_position(i), i=1, of%pads)]
         end associate
      end do
   end function tilts

   !> Names of the displacements of a bearing's journal and pads.
   pure function position_names(self) result(names)
      class(pads_layout_type), intent(in) :: self
      character(len=longest_name) :: names(2 + self%pads*(self%motion/2))
      integer :: i, k
      names(:2) = ['y', 'z']
      do i = 1, self%pads
         do k = 1, self%motion/2
            names(2 + (i - 1)*(self%motion/2) + k) = trim(of_pad(k))//'_'//to_text(i)
         end do
      end do
   end function position_names

   !> The states of the pads; what they lack is 0.
   pure function pad_states(self, y) result(pads)
      class(pads_layout_type), intent(in) :: self
      real(wp), intent(in) :: y(:)
      type(pad_state) :: pads(self%pads)
      integer :: i, o
      if (.not. self%tilting) return
      do i = 1, self%pads
         o = self%before(i)
         pads(i)%tilt = y(o + at_tilt)
         pads(i)%tilt_rate = y(o + at_tilt_rate)
         if (self%radial) then
            pads(i)%pivot_deflection = y(o + at_deflection)
            pads(i)%pivot_deflection_rate = y(o + at_deflection_rate)
         end if
         if (self%bristles) pads(i)%deflection = y(o + self%per_pad)
      end do
   end function pad_states

   !> Puts those states of the pads into y that the bearing has.
   pure subroutine put_pads(self, pads, y)
      class(pads_layout_type), intent(in) :: self
      type(pad_state), intent(in) :: pads(:)
      real(wp), intent(inout) :: y(:)
      integer :: i, o
      if (.not. self%tilting) return
      do i = 1, self%pads
         o = self%before(i)
         y(o + at_tilt) = pads(i)%tilt
         y(o + at_tilt_rate) = pads(i)%tilt_rate
         if (self%radial) then
            y(o + at_deflection) = pads(i)%pivot_deflection
            y(o + at_deflection_rate) = pads(i)%pivot_deflection_rate
         end if
         if (self%bristles) y(o + self%per_pad) = pads(i)%deflection
      end do
   end subroutine put_pads

   !> The same with the pads of all bearings.
   pure subroutine put_all_pads(self, pads, y)
      class(state_layout_type), intent(in) :: self
      type(pad_state), intent(in) :: pads(:)
      real(wp), intent(inout) :: y(:)
      integer :: b
      do b = 1, size(self%bearings)
         call self%bearings(b)%put_pads(pads(self%bearings(b)%all_pads()), y)
      end do
   end subroutine put_all_pads

   !> A change of the state over the columns of each pad's derivatives, (column, pad).
   pure function over_columns(self, y) result(change)
      class(pads_layout_type), intent(in) :: self
      real(wp), intent(in) :: y(:)
      real(wp) :: change(columns, self%pads)
      integer :: i, o
      change = 0
      do i = 1, self%pads
         o = self%before(i)
         change(:2, i) = y(self%journal)
         change(3:journal_columns, i) = y(self%journal_rates)
         change(journal_columns + 1:journal_columns + self%motion, i) = y(o + 1:o + self%motion)
      end do
   end function over_columns
end module state_layout
