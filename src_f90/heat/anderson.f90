!> Anderson's acceleration of a fixed point x = g(x): the next x is that combination of the last ones whose changes
!> g(x) - x would cancel best (J. ACM 12 (1965) 547-560).
module anderson
   use kinds, only: wp
   use linear_algebra, only: dgesv
   implicit none (type, external)
   private
   public :: anderson_type

   !> Changes that are combined at most.
   integer, parameter :: depth = 6
   !> Of the largest diagonal element of the normal equations, added to all: changes may be nearly parallel.
   real(wp), parameter :: regularity = 1e-12_wp

   type :: anderson_type
      private
      integer :: known = 0
      real(wp), allocatable :: x(:), change(:)
      !> Differences of x and of its changes between rounds, the newest first.
      real(wp), allocatable :: steps(:, :), differences(:, :)
   contains
      procedure :: advance
      procedure :: forget
   end type anderson_type

contains

   !> Forgets what it knows.
   pure subroutine forget(self)
      class(anderson_type), intent(inout) :: self
      self%known = 0
      if (allocated(self%x)) deallocate (self%x, self%change)
   end subroutine forget

   !> The next x after a round that would lead from x to g.
   subroutine advance(self, x, g)
      class(anderson_type), intent(inout) :: self
      real(wp), intent(inout) :: x(:)
      real(wp), intent(in) :: g(:)
      real(wp) :: change(size(x)), matrix(depth, depth), right(depth)
      integer :: i, pivots(depth), info
      change = g - x
      if (.not. allocated(self%steps)) allocate (self%steps(size(x), depth), self%differences(size(x), depth))
      if (allocated(self%x)) then
         self%steps = eoshift(self%steps, -1, dim=2)
         self%differences = eoshift(self%differences, -1, dim=2)
         self%steps(:, 1) = x - self%x
         self%differences(:, 1) = change - self%change
         self%known = min(self%known + 1, depth)
      end if
      self%x = x
      self%change = change
      x = x + change
      associate (n => self%known)
         if (n == 0) return
         associate (d => self%differences(:, :n))
            matrix(:n, :n) = matmul(transpose(d), d)
            right(:n) = matmul(change, d)
         end associate
         do i = 1, n
            matrix(i, i) = matrix(i, i)*(1 + regularity) + regularity*matrix(1, 1)
         end do
         call dgesv(n, 1, matrix, depth, pivots, right, depth, info)
         if (info == 0) x = x - matmul(self%steps(:, :n) + self%differences(:, :n), right(:n))
      end associate
   end subroutine advance
end module anderson
