!> How the oil runs along a pad's film: what an energy equation of the film asks of the pressure field, by finite
!> volumes on an even grid, summed over the width, at stations from the leading to the trailing edge.
!>
!> Where the film cavitates, streamers that fill the gap's height and a share of the width carry on what crosses the
!> rupture boundary (volume_flows); what the film takes up at the reformation boundary beyond it comes from the sides.
module film_streams
   use kinds, only: wp
   use film_solver, only: film_motion, film_law_type, film_response, film_counters, cavitation_reynolds, &
      & cavitation_gumbel
   use pad_gap, only: pad_gap_type
   use film_grid, only: film_grid_type
   use elimination_film, only: elimination_film_type, new_elimination_film
   use volume_flows, only: flows_of_row, unit_flow
   implicit none (type, external)
   private
   public :: film_stream, new_stream_volumes, find_stream

   !> Columns of volumes for each station, and rows on half the width: the error of the flows is some 1e-3.
   integer, parameter :: columns_a_station = 3, rows = 12

   !> One pad's. Faces between stations are 0 (leading edge) to n (trailing edge).
   type :: film_stream
      !> Length of a station along the arc and axial length, m.
      real(wp) :: step = 0, width = 0
      !> Flow through the faces, m^3/s, downstream; share of the width that is filled there; film thickness, m.
      real(wp), allocatable :: flow(:), filled_face(:), h_face(:)
      !> Of the stations: film thickness, m; share of the area that is filled; heat of the pressure's flow, W.
      real(wp), allocatable :: h(:), filled(:), pressure_heat(:)
      !> Heat by friction of asperities, W, where they touch.
      real(wp), allocatable :: boundary_heat(:)
   end type film_stream

contains

   !> The volumes on which streams of the film in a gap are found, at this many stations.
   function new_stream_volumes(gap, stations) result(volumes)
      type(pad_gap_type), intent(in) :: gap
      integer, intent(in) :: stations
      type(elimination_film_type) :: volumes
      volumes = new_elimination_film(gap, columns_a_station*stations, rows)
   end function new_stream_volumes

   !> Of the film on volumes at rest in this motion's position, that cavitates by this condition, with an oil, at a
   !> journal speed, rad/s. `ok` is false where no film is found.
   subroutine find_stream(volumes, condition, motion, oil, speed, stations, stream, ok)
      type(elimination_film_type), intent(inout) :: volumes
      integer, intent(in) :: condition, stations
      type(film_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: speed
      type(film_stream), intent(out) :: stream
      logical, intent(out) :: ok
      type(film_grid_type) :: grid
      type(film_response) :: response
      type(film_counters) :: counters
      real(wp), allocatable :: pressure(:, :), film(:, :)
      integer :: i
      call volumes%evaluate(film_motion(motion%position), oil, speed, condition == cavitation_reynolds, .false., &
         & counters, response)
      ok = response%status == 0
      if (.not. ok) return
      call volumes%cells(grid, pressure, film)
      if (condition == cavitation_gumbel) film = merge(1.0_wp, 0.0_wp, pressure > 0)
      stream%step = grid%gap%pad_radius()*grid%gap%arc()/stations
      stream%width = grid%gap%axial_length
      allocate (stream%flow(0:stations), stream%filled_face(0:stations), stream%h_face(0:stations), source=0.0_wp)
      allocate (stream%h(stations), stream%filled(stations), stream%pressure_heat(stations), source=0.0_wp)
      associate (last => columns_a_station*stations)
         stream%h_face(:) = grid%h_face(last:0:-columns_a_station)
         do i = 1, stations
            stream%h(i) = sum(grid%h_cell(last - columns_a_station*i + 1:last - columns_a_station*(i - 1))) &
               & /columns_a_station
         end do
      end associate
      do i = 1, rows
         call add_row(grid, oil, speed*grid%gap%journal_radius, i, pressure, film > 0, stream)
      end do
   end subroutine find_stream

   !> Adds row k of cells and its mirror, from the leading edge downstream; pressures in all cells above that of
   !> cavitation, (row, column), which count only beside what is filled.
   pure subroutine add_row(grid, oil, surface_speed, k, pressure, filled, stream)
      type(film_grid_type), intent(in) :: grid
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: surface_speed
      integer, intent(in) :: k
      real(wp), intent(in) :: pressure(:, :)
      logical, intent(in) :: filled(:, :)
      type(film_stream), intent(inout) :: stream
      !> Flow a unit of width per unit of the grid's equations; heights of both cells, m; that over the width.
      real(wp) :: unit, both, part
      real(wp), dimension(0:grid%columns) :: flow, sliding, share_face
      real(wp) :: p(0:grid%columns + 1), carried(grid%columns), share(grid%columns)
      logical :: whole(0:grid%columns + 1)
      integer :: i, station
      call flows_of_row(grid, oil, surface_speed, k, pressure, filled, flow, carried)
      associate (n => grid%columns)
         unit = unit_flow(grid, oil)
         both = 2*grid%d_z*grid%height(k)
         part = both/grid%gap%axial_length
         p = [grid%ambient, pressure(k, :n), grid%supply]
         whole = [.false., filled(k, :n), .false.]
         sliding = surface_speed*grid%sliding_face*grid%h_face/2
         share_face = merge(1.0_wp, min(1.0_wp, flow/sliding), whole(:n) .or. whole(1:))
         share = merge(1.0_wp, min(1.0_wp, (flow(1:) + carried)/(sliding(1:) + sliding(:n - 1))), whole(1:n))
         do station = 0, n/columns_a_station
            i = n - station*columns_a_station
            stream%flow(station) = stream%flow(station) + both*flow(i)
            stream%filled_face(station) = stream%filled_face(station) + part*share_face(i)
         end do
         do i = 1, n
            station = (n - i)/columns_a_station + 1
            stream%filled(station) = stream%filled(station) + part*share(i)/columns_a_station
            if (.not. whole(i)) cycle
            stream%pressure_heat(station) = stream%pressure_heat(station) + both*unit*( &
               & merge(0.5_wp, 1.0_wp, whole(i + 1))*grid%along(i)*(p(i + 1) - p(i))**2 &
               & + merge(0.5_wp, 1.0_wp, whole(i - 1))*grid%along(i - 1)*(p(i) - p(i - 1))**2 &
               & + grid%beside(i)*grid%outward(k)*(p(i) - beyond(grid, k, pressure(:, i)))**2)
         end do
      end associate
   end subroutine add_row

   !> Pressure beside a cell on the side of the rim.
   pure real(wp) function beyond(grid, k, p)
      type(film_grid_type), intent(in) :: grid
      integer, intent(in) :: k
      real(wp), intent(in) :: p(:)
      beyond = grid%ambient
      if (k < grid%rows) beyond = p(k + 1)
   end function beyond
end module film_streams
