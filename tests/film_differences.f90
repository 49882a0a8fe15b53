!> Derivatives of a film's force over its motion, by differences.
module film_differences
   use kinds, only: wp
   use film_law, only: film_law_type
   use film_solver, only: film_solver_type, film_motion, film_response
   implicit none (type, external)
   private
   public :: shifted, difference

contains

   !> A motion with a step in one of its four numbers, m or m/s.
   pure type(film_motion) function shifted(motion, column, step)
      type(film_motion), intent(in) :: motion
      integer, intent(in) :: column
      real(wp), intent(in) :: step
      real(wp) :: numbers(4)
      numbers = [motion%position, motion%velocity]
      numbers(column) = numbers(column) + step
      shifted = film_motion(numbers(:2), numbers(3:))
   end function shifted

   !> Derivative of a pad's force, of the fourth order in the step. `doubt` is by how much central differences of the
   !> step and of twice the step are apart, over the derivative: large where the force bends between.
   subroutine difference(solver, motion, oil, speed, column, step, derivative, doubt)
      class(film_solver_type), intent(inout) :: solver
      type(film_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: speed, step
      integer, intent(in) :: column
      real(wp), intent(out) :: derivative(2)
      real(wp), intent(out), optional :: doubt
      type(film_response) :: film
      real(wp) :: forces(2, -2:2), central(2, 2)
      integer :: k
      do k = -2, 2
         call solver%evaluate_pad(1, shifted(motion, column, k*step), oil, speed, .false., film)
         forces(:, k) = film%force
      end do
      do k = 1, 2
         central(:, k) = (forces(:, k) - forces(:, -k))/(2*k*step)
      end do
      derivative = (4*central(:, 1) - central(:, 2))/3
      if (present(doubt)) doubt = norm2(central(:, 2) - central(:, 1))/norm2(derivative)
   end subroutine difference
end module film_differences
