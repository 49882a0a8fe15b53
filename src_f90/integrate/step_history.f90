!> What a model answers at the ends of the last steps, and between them.
!>
!> BDF's solution between steps is the polynomial through the last values of the states, as many as its order
!> and one; quantities that follow from the states are as accurate by the same polynomial through theirs.
module step_history
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: step_history_type, new_step_history

   !> Highest order of BDF, and so points kept beside the last.
   integer, parameter :: highest_order = 5

   type :: step_history_type
      private
      !> The last first.
      real(wp) :: time(0:highest_order) = 0
      real(wp), allocatable :: values(:, :)
      integer :: points = 0
   contains
      procedure :: add
      procedure :: at
   end type step_history_type

contains

   !> An empty history of so many values.
   pure type(step_history_type) function new_step_history(n) result(history)
      integer, intent(in) :: n
      allocate (history%values(n, 0:highest_order), source=0.0_wp)
   end function new_step_history

   !> Values at the end of a step, later than all before.
   pure subroutine add(self, t, values)
      class(step_history_type), intent(inout) :: self
      real(wp), intent(in) :: t, values(:)
      integer :: k
      do k = min(self%points, highest_order), 1, -1
         self%time(k) = self%time(k - 1)
         self%values(:, k) = self%values(:, k - 1)
      end do
      self%time(0) = t
      self%values(:, 0) = values
      self%points = min(self%points, highest_order) + 1
   end subroutine add

   !> Values at a time in the last step, which was of this order.
   pure function at(self, t, order) result(values)
      class(step_history_type), intent(in) :: self
      real(wp), intent(in) :: t
      integer, intent(in) :: order
      real(wp) :: values(size(self%values, 1)), weight
      integer :: i, k, last
      last = min(order, self%points - 1)
      values = 0
      do i = 0, last
         weight = 1
         do k = 0, last
            if (k /= i) weight = weight*(t - self%time(k))/(self%time(i) - self%time(k))
         end do
         values = values + weight*self%values(:, i)
      end do
   end function at
end module step_history
