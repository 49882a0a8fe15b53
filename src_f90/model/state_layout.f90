!> This module alone knows where the states lie. Those of the rotor come first, displacements and then their rates. Each
!> pad follows with tilt, tilt rate, (pivots that yield) pivot deflection and its rate, (LuGre) bristle deflection. A
!> state that a model lacks is left out: fixed pads have none.
module state_layout
   use kinds, only: wp
   use text, only: to_text
   use kinematics, only: pad_state, columns, journal_columns
   implicit none (type, external)
   private
   public :: state_layout_type, new_state_layout
   public :: at_tilt, at_tilt_rate, at_deflection, at_deflection_rate

   !> Order of a pad's own states; those of its motion stand in the order of the columns of its derivatives.
   integer, parameter :: at_tilt = 1, at_tilt_rate = 2, at_deflection = 3, at_deflection_rate = 4

   !> Names of a pad's displacements; length of such a name with the number of a pad.
   character(len=*), parameter :: of_pad(2) = [character(len=16) :: 'tilt', 'pivot_deflection']
   integer, parameter :: longest_name = 19

   type :: state_layout_type
      !> States of the rotor, pads, states of a pad (its motion and its bristles), all states.
      integer :: rotor = 0, pads = 0, motion = 0, per_pad = 0, n = 0
      !> Whether the pads tilt; whether their pivots yield; whether there are bristles.
      logical :: tilting = .true., radial = .false., bristles = .false.
   contains
      procedure :: before
      procedure :: bristle
      procedure :: positions
      procedure :: rates
      procedure :: n_positions
      procedure :: position_names
      procedure :: first_position
      procedure :: positions_of
      procedure :: pad_states
      procedure :: put_pads
      procedure :: over_columns
   end type state_layout_type

contains

   !> The layout for a number of rotor states and a number of pads.
   pure type(state_layout_type) function new_state_layout(rotor, pads, tilting, radial, bristles) result(layout)
      integer, intent(in) :: rotor, pads
      logical, intent(in) :: tilting, radial, bristles
      layout%rotor = rotor
      layout%pads = pads
      layout%tilting = tilting
      layout%radial = tilting .and. radial
      layout%bristles = tilting .and. bristles
      layout%motion = 0
      if (tilting) layout%motion = merge(at_deflection_rate, at_tilt_rate, radial)
      layout%per_pad = layout%motion + merge(1, 0, layout%bristles)
      layout%n = rotor + pads*layout%per_pad
   end function new_state_layout

   !> States before those of a pad: its tilt is this + at_tilt.
   elemental integer function before(self, pad)
      class(state_layout_type), intent(in) :: self
      integer, intent(in) :: pad
      before = self%rotor + (pad - 1)*self%per_pad
   end function before

   !> Index of a pad's bristle deflection; only where there are bristles.
   elemental integer function bristle(self, pad)
      class(state_layout_type), intent(in) :: self
      integer, intent(in) :: pad
      bristle = self%before(pad) + self%per_pad
   end function bristle

   !> Indices of the displacements of rotor and pads, in the order of the states.
   pure function positions(self)
      class(state_layout_type), intent(in) :: self
      integer, allocatable :: positions(:)
      integer :: i, k
      positions = [(i, i=1, self%rotor/2), ((self%before(i) + k, k=1, self%motion, 2), i=1, self%pads)]
   end function positions

   !> Indices of their rates, in the same order.
   pure function rates(self)
      class(state_layout_type), intent(in) :: self
      integer, allocatable :: rates(:)
      integer :: i, k
      rates = [(i, i=self%rotor/2 + 1, self%rotor), ((self%before(i) + k, k=2, self%motion, 2), i=1, self%pads)]
   end function rates

   !> Number of displacements of rotor and pads.
   pure integer function n_positions(self)
      class(state_layout_type), intent(in) :: self
      n_positions = self%rotor/2 + self%pads*self%motion/2
   end function n_positions

   !> Names of the displacements of a rigid rotor and the pads, in the same order.
   pure function position_names(self) result(names)
      class(state_layout_type), intent(in) :: self
      character(len=longest_name) :: names(self%n_positions())
      integer :: i, k
      names(:self%rotor/2) = ['y', 'z']
      do i = 1, self%pads
         do k = 1, self%motion/2
            names(self%first_position(i) + k - 1) = trim(of_pad(k))//'_'//to_text(i)
         end do
      end do
   end function position_names

   !> Which of these is a pad's tilt; its pivot deflection is the next.
   elemental integer function first_position(self, pad)
      class(state_layout_type), intent(in) :: self
      integer, intent(in) :: pad
      first_position = self%rotor/2 + (pad - 1)*(self%motion/2) + 1
   end function first_position

   !> Places of the rotor's displacements and of those of a pad among `positions`.
   pure function positions_of(self, pad) result(places)
      class(state_layout_type), intent(in) :: self
      integer, intent(in) :: pad
      integer :: places(self%rotor/2 + self%motion/2), k
      places = [(k, k=1, self%rotor/2), (self%first_position(pad) + k, k=0, self%motion/2 - 1)]
   end function positions_of

   !> The states of the pads; what they lack is 0.
   pure function pad_states(self, y) result(pads)
      class(state_layout_type), intent(in) :: self
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

   !> Puts those states of the pads into y that the model has.
   pure subroutine put_pads(self, pads, y)
      class(state_layout_type), intent(in) :: self
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

   !> A change of the state over the columns of each pad's derivatives, (column, pad), with that of the journal.
   pure function over_columns(self, journal, y) result(change)
      class(state_layout_type), intent(in) :: self
      real(wp), intent(in) :: journal(journal_columns), y(:)
      real(wp) :: change(columns, self%pads)
      integer :: i, o
      change = 0
      do i = 1, self%pads
         o = self%before(i)
         change(:journal_columns, i) = journal
         change(journal_columns + 1:journal_columns + self%motion, i) = y(o + 1:o + self%motion)
      end do
   end function over_columns
end module state_layout
