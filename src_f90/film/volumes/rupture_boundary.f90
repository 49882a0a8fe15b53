!> Where between the cells of finite volumes a cavitated film ends.
!>
!> What flows from the film into a cell that has cavitated fills a part of it, over what the cell would take up if it
!> were whole: there the film ends. The pressure meets this end without a slope, so that its own equations need not
!> know it. A change of the pressure with the motion does not: it falls to 0 at the end, and if it fell to 0 in the
!> middle of the cavitated cells, slopes would err by the first order of a cell's size, and leap when a cell cavitates.
module rupture_boundary
   use kinds, only: wp
   use film_grid, only: film_grid_type
   implicit none (type, external)
   private
   public :: boundary_conductance

contains

   !> What the end of a film adds to the diagonal of a cell's equation for a change of pressure, (row, column): the
   !> conductance towards a cavitated cell is that up to the end of the film instead of up to the cell's middle.
   pure function boundary_conductance(grid, film, pressure, first, last) result(more)
      type(film_grid_type), intent(in) :: grid
      !> Cells of the film 1, others 0; pressure above that of cavitation, Pa, 0 in the others; (row, column).
      real(wp), intent(in) :: film(:, :), pressure(:, :)
      !> The columns that cavitate touches; beside these alone the pressure has to be known.
      integer, intent(in) :: first, last
      real(wp) :: more(size(film, 1), grid%columns)
      real(wp), dimension(0:grid%rows + 1, 0:grid%columns + 1) :: filled, p
      integer :: i, k
      more = 0
      filled = 1
      p = 0
      associate (n => grid%columns, rows => grid%rows, width => grid%width, height => grid%height)
         p(1:rows, 1:n) = pressure(:rows, :)
         do i = first, last
            do k = 1, rows
               if (film(k, i) > 0) cycle
               filled(k, i) = share(grid%along(i - 1)*p(k, i - 1) + grid%along(i)*p(k, i + 1) + grid%beside(i) &
                  & *(grid%inward(k)*p(k - 1, i) + grid%outward(k)*p(k + 1, i)), &
                  & grid%source(i) + merge(grid%edge_source(i), 0.0_wp, k == rows))
            end do
         end do
         do i = max(1, first - 1), min(n, last + 1)
            do k = 1, rows
               if (.not. film(k, i) > 0) cycle
               if (i > 1) more(k, i) = grid%along(i - 1)*nearer(width(i), width(i - 1), filled(k, i - 1))
               if (i < n) more(k, i) = more(k, i) + grid%along(i)*nearer(width(i), width(i + 1), filled(k, i + 1))
               if (k > 1) more(k, i) = more(k, i) + grid%beside(i)*grid%inward(k) &
                  & *nearer(height(k), height(k - 1), filled(k - 1, i))
               if (k < rows) more(k, i) = more(k, i) + grid%beside(i)*grid%outward(k) &
                  & *nearer(height(k), height(k + 1), filled(k + 1, i))
            end do
         end do
      end associate
   end function boundary_conductance

   !> The part of a cavitated cell that an inflow fills.
   pure real(wp) function share(inflow, source)
      real(wp), intent(in) :: inflow, source
      share = 0
      if (source > 0) share = min(1.0_wp, max(0.0_wp, inflow/source))
   end function share

   !> Distance from the middle of a cell to that of its neighbour, over the distance to the end of the film, less 1; 0
   !> where the neighbour is full.
   pure real(wp) function nearer(own, other, filled)
      !> Sizes of both, and the part of the neighbour up to which there is film.
      real(wp), intent(in) :: own, other, filled
      nearer = 0
      if (filled < 1) nearer = (own + other)/(own + 2*filled*other) - 1
   end function nearer
end module rupture_boundary
