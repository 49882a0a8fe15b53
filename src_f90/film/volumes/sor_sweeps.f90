!> The inner loops of over-relaxation, on fields (pair, row, parity) with a rim; see sor_film.
!>
!> Cell `2*pair - 1` of a row has parity 1, cell `2*pair` parity 2: the circumferential neighbours of
!> one parity are cells of the other, its axial neighbours cells of its own.
module sor_sweeps
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: relax, relative_residual

contains

   !> Red-black sweeps of projected over-relaxation (floor = -huge: plain).
   pure subroutine relax(nk, nz, sweeps, relaxation, floor, before, after, beside, inward, outward, per_diagonal, &
      & source, whole, p)
      !> Pairs and rows; number of sweeps.
      integer, intent(in) :: nk, nz, sweeps
      real(wp), intent(in) :: relaxation, floor
      !> Conductances along and across the arc, their factors by row; reciprocal diagonal.
      real(wp), intent(in) :: before(nk, 2), after(nk, 2), beside(nk, 2), inward(nz), outward(nz)
      real(wp), intent(in) :: per_diagonal(nk, nz, 2)
      real(wp), intent(in) :: source(0:nk + 1, 0:nz + 1, 2), whole(0:nk + 1, 0:nz + 1, 2)
      real(wp), intent(inout) :: p(0:nk + 1, 0:nz + 1, 2)
      real(wp) :: balance
      integer :: sweep, colour, j, k, same, other, o
      do sweep = 1, sweeps
         do colour = 0, 1
            do j = 1, nz
               same = 1 + mod(j + colour, 2)
               other = 3 - same
               o = same - 1
               !$omp simd
               do k = 1, nk
                  balance = (before(k, same)*p(k - 1 + o, j, other) + after(k, same)*p(k + o, j, other) &
                     & + beside(k, same)*(inward(j)*p(k, j - 1, same) + outward(j)*p(k, j + 1, same)) &
                     & - source(k, j, same))*per_diagonal(k, j, same)
                  p(k, j, same) = max(floor, p(k, j, same) &
                     & + relaxation*whole(k, j, same)*(balance - p(k, j, same)))
               end do
            end do
         end do
      end do
   end subroutine relax

   !> Root sum of squares over the cells of what one Jacobi step (projected) would change, over that of
   !> the source over the diagonal. Cavitated cells count only where the film wants to reform.
   pure function relative_residual(nk, nz, floor, before, after, beside, inward, outward, per_diagonal, source, &
      & whole, p) result(residual)
      integer, intent(in) :: nk, nz
      real(wp), intent(in) :: floor
      real(wp), intent(in) :: before(nk, 2), after(nk, 2), beside(nk, 2), inward(nz), outward(nz)
      real(wp), intent(in) :: per_diagonal(nk, nz, 2)
      real(wp), intent(in) :: source(0:nk + 1, 0:nz + 1, 2), whole(0:nk + 1, 0:nz + 1, 2)
      real(wp), intent(in) :: p(0:nk + 1, 0:nz + 1, 2)
      real(wp) :: residual, balance, change, scale
      integer :: j, k, same, other, o
      change = 0
      scale = 0
      do same = 1, 2
         other = 3 - same
         o = same - 1
         do j = 1, nz
            !$omp simd reduction(+:change, scale)
            do k = 1, nk
               balance = (before(k, same)*p(k - 1 + o, j, other) + after(k, same)*p(k + o, j, other) &
                  & + beside(k, same)*(inward(j)*p(k, j - 1, same) + outward(j)*p(k, j + 1, same)) &
                  & - source(k, j, same))*per_diagonal(k, j, same)
               change = change + (whole(k, j, same)*(max(floor, balance) - p(k, j, same)))**2
               scale = scale + (source(k, j, same)*per_diagonal(k, j, same))**2
            end do
         end do
      end do
      residual = sqrt(change/max(scale, tiny(scale)))
   end function relative_residual
end module sor_sweeps
