!> The multipliers of a periodic orbit: the factors by which small disturbances grow in a period.
module floquet_multipliers
   use kinds, only: wp
   use lapack, only: dgeev
   implicit none (type, external)
   private
   public :: set_multipliers, are_stable, loss_of_stability

contains

   !> The eigenvalues of a monodromy matrix, that of largest modulus first.
   subroutine set_multipliers(monodromy, values, ok)
      real(wp), intent(in) :: monodromy(:, :)
      complex(wp), allocatable, intent(out) :: values(:)
      logical, intent(out) :: ok
      real(wp) :: matrix(size(monodromy, 1), size(monodromy, 1)), re(size(monodromy, 1)), im(size(monodromy, 1))
      real(wp) :: work(8*size(monodromy, 1)), left(1, 1), right(1, 1)
      integer :: info, k, largest
      matrix = monodromy
      call dgeev('N', 'N', size(re), matrix, size(re), re, im, left, 1, right, 1, work, size(work), info)
      ok = info == 0
      if (.not. ok) return
      values = cmplx(re, im, wp)
      do k = 1, size(values) - 1
         largest = k - 1 + maxloc(abs(values(k:)), dim=1)
         values([k, largest]) = values([largest, k])
      end do
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
