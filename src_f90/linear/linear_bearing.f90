!> A bearing linearised where it is in equilibrium: masses, stiffness and damping of all positions, for each way that
!> its pivots may behave; and what a journal meets of it that whirls at one frequency.
module linear_bearing
   use kinds, only: wp
   use lapack, only: zgesv
   use equations_of_motion, only: bearing_model
   use force_balance, only: force_derivatives, add_sticking, masses
   implicit none (type, external)
   private
   public :: linear_bearing_type, linearize, linear_bearing_of, pivot_name

   !> Length of the names of pivots.
   integer, parameter :: pivot_name = 6

   !> In the order of layout%positions(), the first two of which are the journal's.
   type :: linear_bearing_type
      !> 'free': the pivots slide without friction; 'stuck': as their law of friction has it in equilibrium; 'locked':
      !> no pad tilts.
      character(len=pivot_name) :: pivot = ''
      !> Of the pads alone: kg, kg m, kg m^2; -dF/dx and -dF/dv of the forces and moments F.
      real(wp), allocatable :: mass(:, :), stiffness(:, :), damping(:, :)
      !> Positions that move.
      logical, allocatable :: moves(:)
   contains
      procedure :: condense
   end type linear_bearing_type

   !> Positions of the journal.
   integer, parameter :: journal = 2
   !> Least whirl frequency over the speed of the shaft: slower whirl is taken there, as the coefficients have a limit.
   real(wp), parameter :: slowest = 1e-6_wp

contains

   !> The bearing of a model without friction in equilibrium in the state y, for each way that the pivots of its case
   !> may behave. `ok` is false where the films have no derivatives.
   subroutine linearize(model, y, bearings, ok)
      type(bearing_model), intent(inout) :: model
      real(wp), intent(in) :: y(:)
      type(linear_bearing_type), allocatable, intent(out) :: bearings(:)
      logical, intent(out) :: ok
      real(wp), dimension(model%layout%n_positions(), model%layout%n_positions()) :: over_positions, over_rates
      integer :: i
      call model%evaluate(0.0_wp, y, .true., ok)
      if (.not. ok) return
      call force_derivatives(model, over_positions, over_rates)
      associate (pivots => pivots_of(model))
         bearings = [(linear_bearing_of(model, pivots(i), over_positions, over_rates), i=1, size(pivots))]
      end associate
   end subroutine linearize

   !> The bearing of a model with pivots that behave in one of these ways, from the derivatives of the forces in the
   !> state where it was evaluated last.
   pure type(linear_bearing_type) function linear_bearing_of(model, pivot, over_positions, over_rates) result(bearing)
      type(bearing_model), intent(in) :: model
      character(len=*), intent(in) :: pivot
      real(wp), intent(in) :: over_positions(:, :), over_rates(:, :)
      integer :: k
      bearing%pivot = pivot
      allocate (bearing%moves(size(over_rates, 1)), source=.true.)
      if (pivot == 'locked' .and. model%layout%tilting) then
         bearing%moves(model%layout%first_position([(k, k=1, model%layout%pads)])) = .false.
      end if
      bearing%mass = masses(model)
      bearing%mass(:journal, :journal) = 0
      bearing%stiffness = over_positions
      bearing%damping = over_rates
      if (pivot == 'stuck') call add_sticking(model, bearing%stiffness, bearing%damping)
      bearing%stiffness = -bearing%stiffness
      bearing%damping = -bearing%damping
   end function linear_bearing_of

   !> The ways that the pivots of a model's case may behave; fixed pads have one.
   pure function pivots_of(model) result(pivots)
      type(bearing_model), intent(in) :: model
      character(len=pivot_name), allocatable :: pivots(:)
      if (.not. model%inputs%tilting()) then
         pivots = [character(len=pivot_name) :: 'locked']
      else if (model%inputs%friction%model == 'none') then
         pivots = [character(len=pivot_name) :: 'free', 'locked']
      else
         pivots = [character(len=pivot_name) :: 'free', 'stuck', 'locked']
      end if
   end function pivots_of

   !> Stiffness, N/m, and damping, N s/m, that a journal meets which whirls at a frequency over the speed of the shaft,
   !> rad/s: Z_jj - Z_jp Z_pp^-1 Z_pj with Z = K + i nu C - nu^2 M of journal and pads. `ok` is false where a vibration
   !> of the pads without damping has this frequency.
   subroutine condense(self, ratio, speed, stiffness, damping, ok)
      class(linear_bearing_type), intent(in) :: self
      real(wp), intent(in) :: ratio, speed
      real(wp), intent(out) :: stiffness(journal, journal), damping(journal, journal)
      logical, intent(out) :: ok
      complex(wp), allocatable :: z(:, :), of_pads(:, :), response(:, :)
      complex(wp) :: left(journal, journal)
      real(wp) :: frequency
      integer, allocatable :: kept(:), pivots(:)
      integer :: info, i, n
      kept = pack([(i, i=1, size(self%moves))], self%moves)
      frequency = max(slowest, ratio)*speed
      z = cmplx(self%stiffness(kept, kept) - frequency**2*self%mass(kept, kept), &
         & frequency*self%damping(kept, kept), wp)
      n = size(kept) - journal
      left = z(:journal, :journal)
      info = 0
      if (n > 0) then
         allocate (pivots(n))
         of_pads = z(journal + 1:, journal + 1:)
         response = z(journal + 1:, :journal)
         call zgesv(n, journal, of_pads, n, pivots, response, n, info)
         left = left - matmul(z(:journal, journal + 1:), response)
      end if
      ok = info == 0
      stiffness = left%re
      damping = left%im/frequency
   end subroutine condense
end module linear_bearing
