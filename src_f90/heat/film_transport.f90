!> What the oil of one pad's film carries along the arc and across the film, by upwind differences of second order (of
!> first order where it flows back) along and central ones across. Oil that leaves at the sides is spread over the
!> height as the velocity there is, and has the temperature of its place.
module film_transport
   use kinds, only: wp
   use band_system, only: band_system_type
   use film_streams, only: film_stream
   use film_profiles, only: film_profile
   use film_conduction, only: film_heat_type, solid_layers, by_inlet, unknown
   implicit none (type, external)
   private
   public :: find_flows, add_transport, face_temperature

contains

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
end module film_transport
