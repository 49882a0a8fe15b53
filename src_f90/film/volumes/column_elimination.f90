!> The inner loops of elimination_film: chains of single equations by mode of the grid, and small dense blocks one
!> column of cells wide. Modes and rows are filled up to whole SIMD vectors.
module column_elimination
   use kinds, only: wp
   use linear_algebra, only: simd_width
   implicit none (type, external)
   private
   public :: green_chain, factor_chain, solve_chain, finish_chain, multiply_columns, weighted, invert

contains

   !> From the leading edge to the trailing one: reciprocal pivots (mode, column), and per_pivot (load + what comes
   !> from the column behind) for three loads, uniform over the rows, the first with one at the edge besides.
   !> What is found is kept in the first columns.
   pure subroutine green_chain(m, n, kept, along, beside, eigenvalue, uniform, at_edge, load, edge_load, per_pivot, x)
      integer, intent(in) :: m, n, kept
      !> As in the chains below.
      real(wp), intent(in) :: along(0:n), beside(n), eigenvalue(m), uniform(m), at_edge(m), load(3, n), edge_load(n)
      real(wp), intent(out) :: per_pivot(m, kept), x(m, 3, kept)
      real(wp), dimension(simd_width) :: pivot, one, two, three
      integer :: i, k, first
      do first = 0, m - 1, simd_width
         pivot = 0
         one = 0
         two = 0
         three = 0
         do i = n, 1, -1
            !$omp simd
            do k = 1, simd_width
               ! along(n) stands in the diagonal alone
               pivot(k) = 1/(along(i - 1) + along(i) + beside(i)*eigenvalue(first + k) - along(i)**2*pivot(k))
               one(k) = pivot(k)*(load(1, i)*uniform(first + k) + edge_load(i)*at_edge(first + k) + along(i)*one(k))
               two(k) = pivot(k)*(load(2, i)*uniform(first + k) + along(i)*two(k))
               three(k) = pivot(k)*(load(3, i)*uniform(first + k) + along(i)*three(k))
            end do
            if (i > kept) cycle
            !$omp simd
            do k = 1, simd_width
               per_pivot(first + k, i) = pivot(k)
               x(first + k, 1, i) = one(k)
               x(first + k, 2, i) = two(k)
               x(first + k, 3, i) = three(k)
            end do
         end do
      end do
   end subroutine green_chain

   !> The face between column i and the one before it, on the way from the first column to the last.
   pure integer function face_behind(i, step)
      integer, intent(in) :: i, step
      face_behind = merge(i - 1, i, step > 0)
   end function face_behind

   !> Reciprocal pivots (mode, column) of the columns from one to another, in either direction.
   pure subroutine factor_chain(m, n, from, to, along, beside, eigenvalue, per_pivot)
      !> Modes, columns, first and last of the chain.
      integer, intent(in) :: m, n, from, to
      !> Conductances through the faces and beside; axial eigenvalue by mode.
      real(wp), intent(in) :: along(0:n), beside(n), eigenvalue(m)
      real(wp), intent(inout) :: per_pivot(m, n)
      real(wp) :: behind(simd_width), around, coupling
      integer :: i, k, first, step
      step = merge(1, -1, from == 1)
      do first = 0, m - 1, simd_width
         behind = 0
         do i = from, to, step
            around = along(i - 1) + along(i)
            coupling = along(face_behind(i, step))**2
            !$omp simd
            do k = 1, simd_width
               behind(k) = 1/(around + beside(i)*eigenvalue(first + k) - coupling*behind(k))
               per_pivot(first + k, i) = behind(k)
            end do
         end do
      end do
   end subroutine factor_chain

   !> The way in: x = per_pivot (load uniform + edge_load at_edge + what comes from the column behind).
   pure subroutine solve_chain(m, n, from, to, along, per_pivot, load, uniform, edge_load, at_edge, x)
      integer, intent(in) :: m, n, from, to
      real(wp), intent(in) :: along(0:n), per_pivot(m, n), load(n), uniform(m), edge_load(n), at_edge(m)
      real(wp), intent(inout) :: x(m, n)
      real(wp) :: behind(simd_width), coupling
      integer :: i, k, first, step
      step = merge(1, -1, from == 1)
      do first = 0, m - 1, simd_width
         behind = 0
         do i = from, to, step
            coupling = along(face_behind(i, step))
            !$omp simd
            do k = 1, simd_width
               behind(k) = per_pivot(first + k, i)*(load(i)*uniform(first + k) + edge_load(i)*at_edge(first + k) &
                  & + coupling*behind(k))
               x(first + k, i) = behind(k)
            end do
         end do
      end do
   end subroutine solve_chain

   !> The way back, from the solution in the column next inwards.
   pure subroutine finish_chain(m, n, from, to, along, per_pivot, inward, x)
      integer, intent(in) :: m, n, from, to
      real(wp), intent(in) :: along(0:n), per_pivot(m, n), inward(m)
      real(wp), intent(inout) :: x(m, n)
      real(wp) :: ahead(simd_width), coupling
      integer :: i, k, first, step
      step = merge(1, -1, from == 1)
      do first = 0, m - 1, simd_width
         ahead = inward(first + 1:first + simd_width)
         do i = to, from, -step
            coupling = along(face_behind(i, -step))
            !$omp simd
            do k = 1, simd_width
               ahead(k) = x(first + k, i) + coupling*per_pivot(first + k, i)*ahead(k)
               x(first + k, i) = ahead(k)
            end do
         end do
      end do
   end subroutine finish_chain

   !> In the columns from one to another: p times a with these weights, a with two other ones, and, over the faces
   !> between the columns, the products of their differences.
   pure subroutine multiply_columns(m, n, from, to, weight, weight_a, weight_b, p, a, along, across, sum_a, sum_b)
      integer, intent(in) :: m, n, from, to
      real(wp), intent(in) :: weight(m), weight_a(m), weight_b(m), p(m, n), a(m, n)
      real(wp), intent(inout) :: along(0:n), across(n), sum_a(n), sum_b(n)
      real(wp) :: over, within, one, two
      integer :: i, k
      do i = from, to
         within = 0
         one = 0
         two = 0
         !$omp simd reduction(+:within, one, two)
         do k = 1, m
            within = within + weight(k)*p(k, i)*a(k, i)
            one = one + weight_a(k)*a(k, i)
            two = two + weight_b(k)*a(k, i)
         end do
         across(i) = within
         sum_a(i) = one
         sum_b(i) = two
         if (i == to) exit
         over = 0
         !$omp simd reduction(+:over)
         do k = 1, m
            over = over + (p(k, i + 1) - p(k, i))*(a(k, i + 1) - a(k, i))
         end do
         along(i) = over
      end do
   end subroutine multiply_columns

   pure real(wp) function weighted(m, weight, x)
      integer, intent(in) :: m
      real(wp), intent(in) :: weight(m), x(m)
      real(wp) :: part(simd_width)
      integer :: k, first
      part = 0
      do first = 0, m - 1, simd_width
         !$omp simd
         do k = 1, simd_width
            part(k) = part(k) + weight(first + k)*x(first + k)
         end do
      end do
      weighted = ((part(1) + part(5)) + (part(2) + part(6))) + ((part(3) + part(7)) + (part(4) + part(8)))
   end function weighted

   !> Inverse, in place, of the part of a symmetric positive definite block where mask > 0; 0 elsewhere.
   !> Gauss-Jordan by symmetric eliminations, which need no pivoting.
   pure subroutine invert(m, rows, mask, block)
      integer, intent(in) :: m, rows
      real(wp), intent(in) :: mask(m)
      real(wp), intent(inout) :: block(m, rows)
      real(wp) :: pivot_column(m), factor, per_pivot
      integer :: i, j, k
      do i = 1, rows
         block(:, i) = block(:, i)*mask(i)*mask
      end do
      do i = 1, rows
         if (.not. mask(i) > 0) cycle
         per_pivot = 1/block(i, i)
         pivot_column = block(:, i)
         do j = 1, rows
            if (.not. mask(j) > 0) cycle
            factor = pivot_column(j)*per_pivot
            !$omp simd
            do k = 1, m
               block(k, j) = block(k, j) - factor*pivot_column(k)
            end do
            block(i, j) = factor
         end do
         block(:, i) = per_pivot*pivot_column
         block(i, i) = -per_pivot
      end do
      block = -block
   end subroutine invert
end module column_elimination
