!> States and outputs at the ends of the last steps, and between them.
!>
!> BDF's solution between steps is a polynomial of the step's order. The one through the last values, as many as the
!> order and one, is as accurate, for the states as for quantities that follow from them.
module step_history
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: step_history_type, new_step_history

   !> Highest order of BDF, and so points kept beside the last.
   integer, parameter :: highest_order = 5

   type :: step_history_type
      private
      real(wp) :: time(0:highest_order) = 0
      !> (value, point); the points follow each other round and round.
      real(wp), allocatable :: values(:, :)
      !> Where the last point stands, and how many there are.
      integer :: last = highest_order, points = 0
   contains
      procedure :: add
      procedure :: at
   end type step_history_type

contains

   !> An empty history of a number of values.
   pure type(step_history_type) function new_step_history(n) result(history)
      integer, intent(in) :: n
      allocate (history%values(n, 0:highest_order), source=0.0_wp)
   end function new_step_history

   !> States and outputs, together as many as there are values, at the end of a step, later than all before.
   pure subroutine add(self, t, states, outputs)
      class(step_history_type), intent(inout) :: self
      real(wp), intent(in) :: t, states(:), outputs(:)
      self%last = modulo(self%last + 1, highest_order + 1)
      self%time(self%last) = t
      self%values(:size(states), self%last) = states
      self%values(size(states) + 1:, self%last) = outputs
      self%points = min(self%points, highest_order) + 1
   end subroutine add

   !> Values at a time in the last step, which was of this order.
   pure subroutine at(self, t, order, values)
      class(step_history_type), intent(in) :: self
      real(wp), intent(in) :: t
      integer, intent(in) :: order
      real(wp), intent(out), contiguous :: values(:)
      real(wp), dimension(0:highest_order) :: back, weight
      real(wp) :: ahead, apart
      integer :: i, j, k, point(0:highest_order), n
      n = min(order, self%points - 1)
      do i = 0, n
         point(i) = modulo(self%last - i, highest_order + 1)
         back(i) = t - self%time(point(i))
      end do
      weight = 0
      do i = 0, n
         ahead = 1
         apart = 1
         do k = 0, n
            if (k == i) cycle
            ahead = ahead*back(k)
            apart = apart*(back(k) - back(i))
         end do
         weight(point(i)) = ahead/apart
      end do
      associate (w => weight, v => self%values)
         !$omp simd
         do j = 1, size(values)
            values(j) = w(0)*v(j, 0) + w(1)*v(j, 1) + w(2)*v(j, 2) + w(3)*v(j, 3) + w(4)*v(j, 4) + w(5)*v(j, 5)
         end do
      end associate
   end subroutine at
end module step_history
