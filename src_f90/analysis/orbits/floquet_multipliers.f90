!> The multipliers of a periodic orbit: the factors by which small disturbances grow in a period.
module floquet_multipliers
   use kinds, only: wp
   use eigenvalues, only: find_eigenvalues, largest_first
   implicit none (type, external)
   private
   public :: set_multipliers, are_stable, loss_of_stability

contains

   !> The eigenvalues of a monodromy matrix, that of largest modulus first.
   subroutine set_multipliers(monodromy, values, ok)
      real(wp), intent(in) :: monodromy(:, :)
      complex(wp), allocatable, intent(out) :: values(:)
      logical, intent(out) :: ok
      allocate (values(size(monodromy, 1)))
      call find_eigenvalues(monodromy, values, ok)
      if (ok) values = values(largest_first(abs(values)))
   end subroutine set_multipliers

   !> True where a small disturbance of the orbit dies out.
   pure logical function are_stable(values)
      complex(wp), intent(in) :: values(:)
      are_stable = all(abs(values) < 1)
   end function are_stable

   !> How an unstable orbit loses its stability, by its leading multiplier.
   pure function loss_of_stability(values) result(loss)
      complex(wp), intent(in) :: values(:)
      character(len=:), allocatable :: loss
      associate (leading => values(1))
         if (abs(leading%im) > 0) then
            loss = 'a second frequency grows'
         else if (leading%re < 0) then
            loss = 'the period doubles'
         else
            loss = 'it is left without oscillation'
         end if
      end associate
   end function loss_of_stability
end module floquet_multipliers
