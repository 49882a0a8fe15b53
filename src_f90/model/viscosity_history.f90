!> Viscosities of the oil on every pad over time: cubics between nodes, smooth across them.
module viscosity_history
   use kinds, only: wp
   use rising_numbers, only: number_up_to
   implicit none (type, external)
   private
   public :: viscosity_history_type, new_viscosity_history

   type :: viscosity_history_type
      !> Nodes, s, (0:n).
      real(wp), allocatable :: time(:)
      !> Logarithms of the viscosities, Pa s, there, (pad, 0:n), and their slopes, 1/s.
      real(wp), allocatable, private :: value(:, :), slope(:, :)
   contains
      procedure :: runs
      procedure :: pads
      procedure :: at
   end type viscosity_history_type

contains

   !> The history through viscosities, Pa s, (pad, 0:n), at n + 1 >= 3 times, s.
   pure type(viscosity_history_type) function new_viscosity_history(time, viscosity) result(history)
      real(wp), intent(in) :: time(0:), viscosity(:, 0:)
      real(wp) :: steep(size(viscosity, 1), size(time) - 1), step(size(time) - 1)
      integer :: k, n
      n = size(time) - 1
      allocate (history%time(0:n), history%value(size(viscosity, 1), 0:n), history%slope(size(viscosity, 1), 0:n))
      history%time(:) = time
      history%value(:, :) = log(viscosity)
      step = time(1:) - time(:n - 1)
      do k = 1, n
         steep(:, k) = (history%value(:, k) - history%value(:, k - 1))/step(k)
      end do
      ! those of parabolas through three nodes
      do k = 1, n - 1
         history%slope(:, k) = (step(k + 1)*steep(:, k) + step(k)*steep(:, k + 1))/(step(k) + step(k + 1))
      end do
      history%slope(:, 0) = 2*steep(:, 1) - history%slope(:, 1)
      history%slope(:, n) = 2*steep(:, n) - history%slope(:, n - 1)
   end function new_viscosity_history

   !> False where there is no course: then viscosities stay.
   pure logical function runs(self)
      class(viscosity_history_type), intent(in) :: self
      runs = allocated(self%time)
   end function runs

   pure integer function pads(self)
      class(viscosity_history_type), intent(in) :: self
      pads = size(self%value, 1)
   end function pads

   !> The viscosities at a time, s; before and behind the history those at its ends.
   pure subroutine at(self, time, viscosity)
      class(viscosity_history_type), intent(in) :: self
      real(wp), intent(in) :: time
      real(wp), intent(out) :: viscosity(:)
      real(wp) :: s, step
      integer :: k, n
      n = ubound(self%time, 1)
      k = min(max(number_up_to(self%time, time), 1), n)
      step = self%time(k) - self%time(k - 1)
      s = min(max((time - self%time(k - 1))/step, 0.0_wp), 1.0_wp)
      associate (a => self%value(:, k - 1), b => self%value(:, k))
         viscosity = exp(a + s**2*(3 - 2*s)*(b - a) &
            & + step*s*(1 - s)*((1 - s)*self%slope(:, k - 1) - s*self%slope(:, k)))
      end associate
   end subroutine at
end module viscosity_history
