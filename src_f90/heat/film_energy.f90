!> Temperatures in one pad's film, along the arc and across it, and in the pad, by finite volumes: what the film makes
!> of the temperatures of its inlet and of the shaft, in which they are affine (docs/theory/heat.md, *Temperature in the
!> film*).
module film_energy
   use kinds, only: wp
   use band_system, only: band_system_type, new_band_system
   use film_streams, only: film_stream
   use film_profiles, only: film_profile
   use film_conduction, only: film_heat_type, solid_layers, by_nothing, by_inlet, by_shaft, unknown, add_conduction, &
      & to_wall, to_surface, out_of_back, out_of_end
   implicit none (type, external)
   private
   public :: pad_heat, solve_energy

   !> One pad's heat; third index of the fields and index of the others: by_nothing, by_inlet, by_shaft.
   type :: pad_heat
      !> Temperatures, C, (layer, station): of the pad from the back on, then of the film to the journal; (station) of
      !> the pad's surface.
      real(wp), allocatable :: field(:, :, :), surface(:, :)
      !> Mean temperatures, over the flow, of what leaves at the trailing edge and runs back at the leading edge, C;
      !> heat to the shaft and out of the back of the pad, W.
      real(wp), dimension(3) :: outlet = 0, back = 0, to_shaft = 0, to_back = 0
      !> Flow that runs back at the leading edge, m^3/s; heat made, W.
      real(wp) :: back_flow = 0, made = 0
      logical :: solved = .false.
   end type pad_heat

contains

   !> Of a film with these streams and profiles of the stations, at a speed of the journal's surface, m/s.
   subroutine solve_energy(heat, stream, profiles, surface_speed, found)
      type(film_heat_type), intent(in) :: heat
      type(film_stream), intent(in) :: stream
      type(film_profile), intent(in) :: profiles(:)
      real(wp), intent(in) :: surface_speed
      type(pad_heat), intent(out) :: found
      type(band_system_type) :: system
      real(wp) :: flow(size(heat%zeta) - 1, 0:size(profiles)), own(size(heat%zeta) - 1, size(profiles))
      integer :: rows, i
      rows = solid_layers + size(flow, 1)
      system = new_band_system(rows*size(profiles), 2*rows, rows, 3)
      call find_flows(stream, profiles, surface_speed, flow)
      own = made_heat(heat, stream, profiles, surface_speed)
      found%made = sum(own)
      call add_transport(heat, stream, profiles, flow, system)
      call add_conduction(heat, stream, system)
      do i = 1, size(profiles)
         associate (first => unknown(heat, i, solid_layers + 1), last => unknown(heat, i, rows))
            system%right(first:last, by_nothing) = system%right(first:last, by_nothing) + own(:, i)
         end associate
      end do
      call system%solve(found%solved)
      if (.not. found%solved) return
      found%field = reshape(system%right, [rows, size(profiles), 3])
      call find_ends(heat, stream, flow, found)
   end subroutine solve_energy

   !> Heat made in each layer of each station, W: by shear, and evenly across the film by friction of asperities.
   pure function made_heat(heat, stream, profiles, surface_speed) result(made)
      type(film_heat_type), intent(in) :: heat
      type(film_stream), intent(in) :: stream
      type(film_profile), intent(in) :: profiles(:)
      real(wp), intent(in) :: surface_speed
      real(wp) :: made(size(profiles(1)%shear), size(profiles))
      real(wp) :: gradient
      integer :: i
      do i = 1, size(profiles)
         associate (p => profiles(i), h => stream%h(i), area => stream%step*stream%width)
            gradient = -(sum(stream%flow(i - 1:i) - surface_speed*stream%h_face(i - 1:i)*stream%filled_face(i - 1:i) &
               & *stream%width*p%f1)/2)/(stream%width*h**3*p%f2)
            made(:, i) = stream%pressure_heat(i)*p%pressure/p%f2 + area*surface_speed*(h*gradient*p%mixed &
               & + stream%filled(i)*surface_speed/h*p%shear)
         end associate
         if (allocated(stream%boundary_heat)) made(:, i) = made(:, i) + stream%boundary_heat(i) &
            & *(heat%zeta(2:) - heat%zeta(:size(heat%zeta) - 1))
      end do
   end function made_heat

   !> What leaves the film at its ends and walls, of each part of the temperatures.
   pure subroutine find_ends(heat, stream, flow, found)
      type(film_heat_type), intent(in) :: heat
      type(film_stream), intent(in) :: stream
      real(wp), intent(in) :: flow(:, 0:)
      type(pad_heat), intent(inout) :: found
      real(wp) :: weight(2), of_inlet, out_flow
      integer :: i, j, k, n, at(2)
      n = size(stream%h)
      out_flow = sum(flow(:, n), mask=flow(:, n) > 0)
      found%back_flow = -sum(flow(:, 0), mask=flow(:, 0) < 0)
      do j = 1, size(flow, 1)
         associate (film => found%field(solid_layers + j, :, :))
            if (flow(j, n) > 0) then
               call face_temperature(flow(j, n), flow(j, 0), n, n, at, weight, of_inlet)
               found%outlet = found%outlet + flow(j, n)/out_flow*matmul(weight, film(at, :))
               found%outlet(by_inlet) = found%outlet(by_inlet) + flow(j, n)/out_flow*of_inlet
            end if
            if (flow(j, 0) < 0) found%back = found%back - flow(j, 0)/found%back_flow*film(1, :)
         end associate
      end do
      allocate (found%surface(n, 3))
      associate (last => size(found%field, 1), pad => to_surface(heat, stream))
         do i = 1, n
            associate (wall => to_wall(heat, stream, i))
               found%to_shaft = found%to_shaft + wall*found%field(last, i, :)
               found%to_shaft(by_shaft) = found%to_shaft(by_shaft) - wall
               found%surface(i, :) = (wall*found%field(solid_layers + 1, i, :) &
                  & + pad*found%field(solid_layers, i, :))/(wall + pad)
               found%to_back = found%to_back + out_of_back(heat, stream)*found%field(1, i, :)
               found%to_back(by_nothing) = found%to_back(by_nothing) - out_of_back(heat, stream)*heat%back_temperature
            end associate
         end do
      end associate
      do k = 1, solid_layers
         do i = 1, n, max(1, n - 1)
            found%to_back = found%to_back + out_of_end(heat, stream)*found%field(k, i, :)
            found%to_back(by_nothing) = found%to_back(by_nothing) - out_of_end(heat, stream)*heat%back_temperature
         end do
      end do
   end subroutine find_ends

   ! What the oil of one pad's film carries along the arc and across the film, by upwind differences of second order (of
   ! first order where it flows back) along and central ones across. Oil that leaves at the sides is spread over the
   ! height as the velocity there is, and has the temperature of its place.

   !> Flow downstream through the layers of each face, m^3/s.
   pure subroutine find_flows(stream, profiles, surface_speed, flow)
      type(film_stream), intent(in) :: stream
      type(film_profile), intent(in) :: profiles(:)
      real(wp), intent(in) :: surface_speed
      real(wp), intent(out) :: flow(:, 0:)
      real(wp), dimension(0:size(flow, 1)) :: sliding, driven, below
      integer :: i
      associate (n => size(profiles), layers => size(flow, 1))
         do i = 0, n
            associate (up => profiles(max(i, 1)), down => profiles(min(i + 1, n)))
               sliding = (up%sliding + down%sliding)/2*surface_speed*stream%h_face(i)*stream%width*stream%filled_face(i)
               driven = (up%driven/up%f2 + down%driven/down%f2)/2
               below = sliding + (stream%flow(i) - sliding(layers))*driven
               flow(:, i) = below(1:) - below(:layers - 1)
            end associate
         end do
      end associate
   end subroutine find_flows

   !> The temperature that a flow through face i of these stations carries: weights of two of them, and of the inlet.
   pure subroutine face_temperature(flow, entering, i, stations, at, weight, of_inlet)
      !> Here, and through the first face, in this layer.
      real(wp), intent(in) :: flow, entering
      integer, intent(in) :: i, stations
      integer, intent(out) :: at(2)
      real(wp), intent(out) :: weight(2), of_inlet
      at = [max(i, 1), max(i - 1, 1)]
      weight = [1, 0]
      of_inlet = 0
      if (i == 0) then
         if (flow > 0) then
            of_inlet = 1
            weight = 0
         end if
      else if (flow < 0) then
         at = min(i + 1, stations)
      else if (i > 1) then
         weight = [1.5_wp, -0.5_wp]
      else if (entering > 0) then
         weight = [2, 0]
         of_inlet = -1
      end if
   end subroutine face_temperature

   !> What flows carry.
   pure subroutine add_transport(heat, stream, profiles, flow, system)
      type(film_heat_type), intent(in) :: heat
      type(film_stream), intent(in) :: stream
      type(film_profile), intent(in) :: profiles(:)
      real(wp), intent(in) :: flow(:, 0:)
      type(band_system_type), intent(inout) :: system
      real(wp) :: up, side, share, weight(2), of_inlet
      integer :: i, j, k, at(2)
      associate (layers => size(flow, 1), stations => size(profiles), zeta => heat%zeta, c => heat%capacity)
         do i = 0, stations
            do j = 1, layers
               call face_temperature(flow(j, i), flow(j, 0), i, stations, at, weight, of_inlet)
               do k = max(i, 1), min(i + 1, stations)
                  ! out of the station before the face, into the one behind it
                  associate (carried => c*flow(j, i)*merge(1, -1, k == i), row => unknown(heat, k, solid_layers + j))
                     call system%add(row, unknown(heat, at(1), solid_layers + j), carried*weight(1))
                     if (abs(weight(2)) > 0) call system%add(row, unknown(heat, at(2), solid_layers + j), &
                        & carried*weight(2))
                     system%right(row, by_inlet) = system%right(row, by_inlet) - carried*of_inlet
                  end associate
               end do
            end do
         end do
         do i = 1, stations
            up = 0
            do j = 1, layers
               associate (below => unknown(heat, i, solid_layers + j), above => unknown(heat, i, solid_layers + j + 1))
                  side = (stream%flow(i - 1) - stream%flow(i))*(profiles(i)%driven(j) - profiles(i)%driven(j - 1)) &
                     & /profiles(i)%f2
                  call system%add(below, below, c*side)
                  up = up + flow(j, i - 1) - flow(j, i) - side
                  if (j == layers) exit
                  ! the temperature between the middles of two layers
                  share = (zeta(j + 1) - zeta(j))/(zeta(j + 2) - zeta(j))
                  call system%add(below, below, c*up*(1 - share))
                  call system%add(below, above, c*up*share)
                  call system%add(above, below, -c*up*(1 - share))
                  call system%add(above, above, -c*up*share)
               end associate
            end do
         end do
      end associate
   end subroutine add_transport
end module film_energy
