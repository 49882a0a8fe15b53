!> Flows of a film on finite volumes, and how far its cavitated part is filled.
!>
!> Between two cells the oil flows as the equations of the film have it, so that the cells of a full film lose nothing.
!> What flows across the edge of the film into its cavitated part runs on along the arc, in streamers that fill the
!> gap's height and a share of its width.
module volume_flows
   use kinds, only: wp
   use film_solver, only: film_law_type
   use film_grid, only: film_grid_type
   implicit none (type, external)
   private
   public :: volume_flow_type, flows_of_volumes, finer, flows_of_row, unit_flow

   type :: volume_flow_type
      !> m^3/s: what pressure drives in at the leading edge, less than 0 where it drives oil out; out at the trailing
      !> edge and at both sides.
      real(wp) :: inlet = 0, outlet = 0, side = 0
      !> m^3/s that a film takes up downstream of a cavitation beyond what the streamers bring.
      real(wp) :: unfed = 0
      !> Power that shear of sliding lacks in the cavitated part, W.
      real(wp) :: lacking = 0
      !> Heat of the flow that pressure drives; power by which the pressure resists the journal's rotation, W.
      real(wp) :: heat = 0, wedge = 0
      !> Force on the journal in the pad frame, N; integral of (sin phi, cos phi) over the cavitated part, m^2.
      real(wp) :: force(2) = 0, void(2) = 0
   end type volume_flow_type

contains

   !> The flows at the motion that the grid has been set to, with its oil, and a speed of the journal's surface, m/s.
   pure type(volume_flow_type) function flows_of_volumes(grid, oil, surface_speed, pressure, filled) result(flow)
      type(film_grid_type), intent(in) :: grid
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: surface_speed
      !> Above the cavitation pressure, Pa, (row, column); where the film is. Elsewhere the pressure counts only for
      !> the flow across the edge of the film.
      real(wp), intent(in) :: pressure(:, :)
      logical, intent(in) :: filled(:, :)
      real(wp) :: held(grid%rows, grid%columns)
      integer :: k
      held = merge(pressure(:grid%rows, :), 0.0_wp, filled(:grid%rows, :))
      flow%force = grid%force(matmul(grid%height, held))
      do k = 1, grid%rows
         call add_row(grid, oil, surface_speed, k, pressure, filled, flow)
      end do
   end function flows_of_volumes

   !> What two grids, the second twice as fine, tell of one that is infinitely fine.
   pure type(volume_flow_type) function finer(coarse, fine)
      type(volume_flow_type), intent(in) :: coarse, fine
      finer%inlet = (4*fine%inlet - coarse%inlet)/3
      finer%outlet = (4*fine%outlet - coarse%outlet)/3
      finer%side = (4*fine%side - coarse%side)/3
      finer%unfed = (4*fine%unfed - coarse%unfed)/3
      finer%lacking = (4*fine%lacking - coarse%lacking)/3
      finer%heat = (4*fine%heat - coarse%heat)/3
      finer%wedge = (4*fine%wedge - coarse%wedge)/3
      finer%force = (4*fine%force - coarse%force)/3
      finer%void = (4*fine%void - coarse%void)/3
   end function finer

   !> Adds a row of cells.
   pure subroutine add_row(grid, oil, surface_speed, k, pressure, filled, flow)
      type(film_grid_type), intent(in) :: grid
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: surface_speed
      integer, intent(in) :: k
      real(wp), intent(in) :: pressure(:, :)
      logical, intent(in) :: filled(:, :)
      type(volume_flow_type), intent(inout) :: flow
      !> Flow a unit of width per unit of the grid's equations; heights of two mirrored cells, m; of the cell, m^2.
      real(wp) :: unit, both, area
      real(wp) :: through(0:grid%columns), carried(grid%columns)
      integer :: i
      call flows_of_row(grid, oil, surface_speed, k, pressure, filled, through, carried)
      associate (gap => grid%gap, n => grid%columns, p => pressure)
         unit = unit_flow(grid, oil)
         both = 2*grid%d_z*grid%height(k)
         if (filled(k, n)) flow%inlet = flow%inlet + both*unit*grid%along(n)*(grid%supply - p(k, n))
         do i = n, 1, -1
            if (filled(k, i)) then
               if (i < n) then
                  if (.not. filled(k, i + 1)) flow%unfed = flow%unfed + both*(through(i) - carried(i + 1))
               end if
               call add_power(grid, surface_speed, k, i, both*unit, pressure, filled, flow)
               if (k == grid%rows) flow%side = flow%side &
                  & + both*unit*grid%beside(i)*grid%outward(k)*(p(k, i) - grid%ambient)
            else
               area = both*gap%pad_radius()*grid%d_phi*grid%width(i)
               flow%void = flow%void + area*[grid%sin_cell(i), grid%cos_cell(i)]
               flow%lacking = flow%lacking + area*oil%viscosity*grid%shear_cell(i)*surface_speed/grid%h_cell(i) &
                  & *max(0.0_wp, surface_speed - (through(i) + carried(i))/(grid%sliding_cell(i)*grid%h_cell(i)))
            end if
         end do
         flow%outlet = flow%outlet + both*through(0)
      end associate
   end subroutine add_row

   !> Flows of row k of cells a unit of width, m^2/s, downstream: through the faces, 0 (trailing edge) to n; what a
   !> cavitated cell passes on.
   pure subroutine flows_of_row(grid, oil, surface_speed, k, pressure, filled, through, carried)
      type(film_grid_type), intent(in) :: grid
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: surface_speed
      integer, intent(in) :: k
      !> As in flows_of_volumes.
      real(wp), intent(in) :: pressure(:, :)
      logical, intent(in) :: filled(:, :)
      real(wp), intent(out) :: through(0:), carried(:)
      real(wp) :: unit, p(0:grid%columns + 1)
      logical :: whole(0:grid%columns + 1)
      integer :: i
      associate (n => grid%columns)
         unit = unit_flow(grid, oil)
         p = [grid%ambient, pressure(k, :n), grid%supply]
         whole = [.false., filled(k, :n), .false.]
         carried = 0
         do i = n, 0, -1
            if (i < n) then
               if (.not. whole(i + 1)) carried(i + 1) = through(i + 1) &
                  & + unit*grid%beside(i + 1)*from_beside(grid, k, pressure(:, i + 1), filled(:, i + 1))
            end if
            if (i < n .and. .not. (whole(i) .or. whole(i + 1))) then
               through(i) = carried(i + 1)
            else
               through(i) = surface_speed*grid%sliding_face(i)*grid%h_face(i)/2
               if (whole(i) .or. whole(i + 1)) through(i) = through(i) + unit*grid%along(i)*(p(i + 1) - p(i))
            end if
         end do
      end associate
   end subroutine flows_of_row

   !> Flow a unit of width, m^2/s, per unit of the grid's equations.
   pure real(wp) function unit_flow(grid, oil)
      type(film_grid_type), intent(in) :: grid
      class(film_law_type), intent(in) :: oil
      unit_flow = grid%d_phi/(12*oil%viscosity*grid%gap%pad_radius())
   end function unit_flow

   !> Adds heat of the pressure's flow and the pressure's resistance to rotation in a cell of the film: of the faces
   !> between two of them half to each.
   pure subroutine add_power(grid, surface_speed, k, i, unit, p, filled, flow)
      type(film_grid_type), intent(in) :: grid
      real(wp), intent(in) :: surface_speed
      integer, intent(in) :: k, i
      !> Flow per unit of the grid's equations.
      real(wp), intent(in) :: unit, p(:, :)
      logical, intent(in) :: filled(:, :)
      type(volume_flow_type), intent(inout) :: flow
      real(wp) :: next, share, height
      integer :: side, face
      height = 2*grid%d_z*grid%height(k)
      do side = 0, 1
         ! downstream and upstream
         face = i - 1 + side
         share = 1
         next = merge(grid%supply, grid%ambient, face > 0)
         if (face > 0 .and. face < grid%columns) then
            next = 0
            if (filled(k, i - 1 + 2*side)) next = p(k, i - 1 + 2*side)
            if (filled(k, i - 1 + 2*side)) share = 0.5_wp
         end if
         flow%heat = flow%heat + share*unit*grid%along(face)*(next - p(k, i))**2
         flow%wedge = flow%wedge + share*height*surface_speed*grid%sliding_face(face)*grid%h_face(face)/2 &
            & *(next - p(k, i))*(1 - 2*side)
      end do
      next = grid%ambient
      if (k < grid%rows) next = merge(p(min(k + 1, grid%rows), i), 0.0_wp, filled(min(k + 1, grid%rows), i))
      flow%heat = flow%heat + unit*grid%beside(i)*grid%outward(k)*(next - p(k, i))**2
   end subroutine add_power

   !> What flows into a cavitated cell from the film in the rows beside it, over the conductance of uniform rows.
   pure real(wp) function from_beside(grid, k, p, filled) result(inflow)
      type(film_grid_type), intent(in) :: grid
      integer, intent(in) :: k
      !> Of the column.
      real(wp), intent(in) :: p(:)
      logical, intent(in) :: filled(:)
      inflow = 0
      if (k > 1) then
         if (filled(k - 1)) inflow = grid%inward(k)*(p(k - 1) - p(k))
      end if
      if (k < grid%rows) then
         if (filled(k + 1)) inflow = inflow + grid%outward(k)*(p(k + 1) - p(k))
      end if
   end function from_beside
end module volume_flows
