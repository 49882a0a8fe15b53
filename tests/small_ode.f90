!> Small problems y' = f(t, y) for tests: one consists of its rates and their derivatives.
module small_ode
   use kinds, only: wp
   use linear_algebra, only: dgesv
   use ode_model, only: ode_model_type
   implicit none (type, external)
   private
   public :: small_ode_type

   type, abstract, extends(ode_model_type) :: small_ode_type
      !> Refuses every time after this one, and the first this many evaluations.
      real(wp) :: refuse_after = huge(1.0_wp)
      integer :: refuse_first = 0
      !> Evaluations; state of the last one; derivatives taken last.
      integer :: calls = 0
      real(wp), allocatable :: seen(:), matrix(:, :)
   contains
      procedure(rates_at), deferred :: rates
      procedure(jacobian_at), deferred :: jacobian
      procedure :: rhs
      procedure :: linearize
      procedure :: rhs_and_jacobian
      procedure :: solve
   end type small_ode_type

   abstract interface
      pure function rates_at(self, t, y) result(rates)
         import :: small_ode_type, wp
         class(small_ode_type), intent(in) :: self
         real(wp), intent(in) :: t, y(:)
         real(wp) :: rates(size(y))
      end function rates_at

      pure function jacobian_at(self, t, y) result(matrix)
         import :: small_ode_type, wp
         class(small_ode_type), intent(in) :: self
         real(wp), intent(in) :: t, y(:)
         real(wp) :: matrix(size(y), size(y))
      end function jacobian_at
   end interface

contains

   subroutine rhs(self, t, y, dydt, ok)
      class(small_ode_type), intent(inout), target :: self
      real(wp), intent(in) :: t, y(:)
      real(wp), intent(out) :: dydt(:)
      logical, intent(out) :: ok
      self%calls = self%calls + 1
      self%seen = y
      dydt = self%rates(t, y)
      ok = t <= self%refuse_after .and. self%calls > self%refuse_first
      if (.not. ok) self%refusal = 'the problem ends'
   end subroutine rhs

   subroutine linearize(self, t, y, ok)
      class(small_ode_type), intent(inout), target :: self
      real(wp), intent(in) :: t, y(:)
      logical, intent(out) :: ok
      self%seen = y
      self%matrix = self%jacobian(t, y)
      ok = t <= self%refuse_after
   end subroutine linearize

   subroutine rhs_and_jacobian(self, t, y, dydt, matrix, ok)
      class(small_ode_type), intent(inout), target :: self
      real(wp), intent(in) :: t, y(:)
      real(wp), intent(out) :: dydt(:), matrix(:, :)
      logical, intent(out) :: ok
      call self%rhs(t, y, dydt, ok)
      matrix = self%jacobian(t, y)
   end subroutine rhs_and_jacobian

   subroutine solve(self, gamma, b, ok)
      class(small_ode_type), intent(inout), target :: self
      real(wp), intent(in) :: gamma
      real(wp), intent(inout) :: b(:)
      logical, intent(out) :: ok
      real(wp) :: system(size(b), size(b)), column(size(b), 1)
      integer :: pivots(size(b)), info, i
      system = -gamma*self%matrix
      do i = 1, size(b)
         system(i, i) = system(i, i) + 1
      end do
      column(:, 1) = b
      call dgesv(size(b), 1, system, size(b), pivots, column, size(b), info)
      b = column(:, 1)
      ok = info == 0
   end subroutine solve
end module small_ode
