!> Axial modes of a pad, b_k cos(lambda_k Z), lambda_k = (2k-1) pi/L, b_k = -4 (-1)^k/((2k-1) pi), k = 1, 2, ..., and
!> what the sums over those beyond the first `modes` are.
!>
!> Of many modes only some are solved, the ``simd_width``: the solution is a smooth function of lambda, so that the
!> first few and Chebyshev's points of log(lambda) beyond give the others by interpolation.
module axial_modes
   use kinds, only: wp, pi
   use pad_gap, only: pad_gap_type
   use fourier_passes, only: simd_width
   implicit none (type, external)
   private
   public :: axial_modes_type, new_axial_modes

   !> Up to this number of modes every one is solved; of more, only the first ones.
   integer, parameter :: most_solved = 16, first_solved = 8
   !> Sums over the odd numbers m of 1/m^3, 1/m^4, 1/m^5: 7/8 zeta(3), pi^4/96, 31/32 zeta(5).
   real(wp), parameter :: odd_sums(3) = [7*1.2020569031595943_wp/8, pi**4/96, 31*1.0369277551433699_wp/32]

   type :: axial_modes_type
      !> Lambda_1 = R lambda_1, and L/R.
      real(wp) :: first, width
      integer :: modes, blocks
      !> (R lambda)^2 of the `simd_width`, idle ones 0.
      real(wp), allocatable :: square(:)
      !> Whether every mode is a slot.
      logical :: all_solved = .false.
      !> How much of each mode's solution is that of a slot, (slot, mode).
      real(wp), allocatable :: of_slot(:, :)
      !> By slot c_k = (L/2) b_k^2, m; sums over the modes left out of c_k/Lambda_k^j, j = 1, 2, 3, m.
      real(wp), allocatable :: c(:)
      real(wp) :: tail(3)
   contains
      procedure :: across
   end type axial_modes_type

contains

   !> A number of modes of a pad; all of them solved, or as many as the solution's smoothness asks for.
   pure function new_axial_modes(gap, modes, all_solved) result(self)
      type(pad_gap_type), intent(in) :: gap
      integer, intent(in) :: modes
      logical, intent(in) :: all_solved
      type(axial_modes_type) :: self
      real(wp) :: order(modes), c(modes), x(modes), places(modes), nodes(modes)
      integer :: solved, j, k
      order = [(2*k - 1, k=1, modes)]
      self%modes = modes
      self%width = gap%axial_length/gap%pad_radius()
      self%first = pi/self%width
      solved = modes
      if (.not. all_solved .and. modes > most_solved) then
         ! eight points for every factor of four between the wave numbers
         solved = first_solved + 8*ceiling(log(order(modes)/(2*first_solved + 1))/log(4.0_wp))
         solved = min(solved, modes)
      end if
      self%all_solved = solved == modes
      self%blocks = (solved + simd_width - 1)/simd_width
      allocate (self%square(simd_width*self%blocks), self%c(simd_width*self%blocks), source=0.0_wp)
      allocate (self%of_slot(simd_width*self%blocks, modes), source=0.0_wp)
      x = order
      if (.not. self%all_solved) x(first_solved + 1:solved) = chebyshev(solved - first_solved, &
         & order(first_solved + 1), order(modes))
      self%square(:solved) = (x(:solved)*self%first)**2
      nodes = log(x)
      places = log(order)
      do k = 1, merge(modes, first_solved, self%all_solved)
         self%of_slot(k, k) = 1
      end do
      if (.not. self%all_solved) then
         do j = first_solved + 1, solved
            self%of_slot(j, first_solved + 1:) = lagrange(nodes(first_solved + 1:solved), j - first_solved, &
               & places(first_solved + 1:))
         end do
      end if
      c = 8*gap%axial_length/(order*pi)**2
      self%c = matmul(self%of_slot, c)
      do j = 1, 3
         self%tail(j) = (8*gap%axial_length/pi**2*odd_sums(j) - sum(c/order**j))/self%first**j
      end do
   end function new_axial_modes

   !> Chebyshev's points between a and b, evenly in the logarithm.
   pure function chebyshev(n, a, b) result(points)
      integer, intent(in) :: n
      real(wp), intent(in) :: a, b
      real(wp) :: points(n)
      integer :: i
      points = [(sqrt(a*b)*(a/b)**(0.5_wp*cos((i - 0.5_wp)*pi/n)), i=1, n)]
   end function chebyshev

   !> The polynomial that is 1 at x(j) and 0 at the other x, at some places.
   pure function lagrange(x, j, places)
      real(wp), intent(in) :: x(:), places(:)
      integer, intent(in) :: j
      real(wp) :: lagrange(size(places))
      integer :: i
      lagrange = 1
      do i = 1, size(x)
         if (i /= j) lagrange = lagrange*(places - x(i))/(x(j) - x(i))
      end do
   end function lagrange

   !> At Z over half the width: b_k cos(lambda_k Z) by slot, and the sum of b_k cos(lambda_k Z)/Lambda_k^2 over the
   !> modes left out.
   pure subroutine across(self, position, profile, left_out)
      class(axial_modes_type), intent(in) :: self
      real(wp), intent(in) :: position
      real(wp), intent(out) :: profile(:), left_out
      real(wp) :: modes(self%modes)
      integer :: k
      modes = [(of_mode(k, position), k=1, self%modes)]
      if (self%all_solved) then
         profile = 0
         profile(:self%modes) = modes
      else
         profile = matmul(self%of_slot, modes)
      end if
      left_out = self%width**2*(1 - position**2)/8 - sum(modes/[((2*k - 1)*self%first, k=1, self%modes)]**2)
   end subroutine across

   elemental real(wp) function of_mode(k, position)
      integer, intent(in) :: k
      real(wp), intent(in) :: position
      of_mode = -4*(-1)**k/((2*k - 1)*pi)*cos((2*k - 1)*pi/2*position)
   end function of_mode
end module axial_modes
