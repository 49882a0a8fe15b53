!> One pad's film whose temperature changes along the arc and across it: its profiles of velocity and shear; its energy
!> equation, with conduction to the shaft and in the pad, by finite volumes; and what the film makes of the temperatures
!> of its inlet and of the shaft, in which its own are affine (docs/theory/heat.md, *Temperature in the film*).
!>
!> With zeta = y/h from the pad to the journal and J_n the integral of zeta^n/mu, sliding and pressure drive
!>    u = U M_0(zeta)/J_0 + h^2 p_x (M_1(zeta) - b M_0(zeta)),   b = J_1/J_0,
!> M_n(zeta) the integral up to zeta.
module film_energy
   use kinds, only: wp, pi
   use linear_algebra, only: dgbsv, solve
   use film_oils, only: film_oil, uneven_oil, weights_degree
   use film_streams, only: film_stream
   implicit none (type, external)
   private
   public :: film_profile, layer_faces, new_profile, fitted_oil, film_heat_type, solid_layers, by_nothing, by_inlet, &
      & by_shaft, pad_heat, solve_energy


   type :: band_system_type
      private
      !> Diagonals below and above the matrix's own.
      integer :: below = 0, above = 0
      real(wp), allocatable :: matrix(:, :)
      !> (unknown, side); the solutions in the end.
      real(wp), allocatable, public :: right(:, :)
   contains
      procedure :: add
      procedure :: join
      procedure :: leave
      procedure :: solve => solve_band
   end type band_system_type


   !> At one place on the arc.
   type :: film_profile
      !> f0, Pa s; f1; f2, 1/(Pa s); b.
      real(wp) :: f0 = 0, f1 = 0, f2 = 0, b = 0
      !> Below each face between layers, 0 (pad) to n (journal): what sliding drives over U h, pressure over -h^3 p_x.
      real(wp), allocatable :: sliding(:), driven(:)
      !> Of each layer the integrals of (u_sliding')^2 mu over U^2, Pa s, of (u_pressure')^2 mu over (h^2 p_x)^2,
      !> 1/(Pa s), and of twice their product over U h^2 p_x: they add up to f0, f2 and 0.
      real(wp), allocatable :: shear(:), pressure(:), mixed(:)
      !> Where there are eddies: how well heat crosses from the pad to the middle of the first layer, between the
      !> middles of layers and on to the journal, over a unit of zeta, W/(m K).
      real(wp), allocatable :: conduction(:)
   end type film_profile


   !> Layers of the pad, from its back to the film.
   integer, parameter :: solid_layers = 2
   !> Least share of a station that conducts: a film without oil keeps the temperatures of its walls.
   real(wp), parameter :: least_filled = 1e-6_wp
   !> What temperatures consist of: those of oil at 0 C and a shaft at 0 C, and what 1 K of either adds.
   integer, parameter :: by_nothing = 1, by_inlet = 2, by_shaft = 3

   !> What heat meets.
   type :: film_heat_type
      !> Density times specific heat of the oil, J/(m^3 K); conductivities of oil and pad, W/(m K).
      real(wp) :: capacity = 0, conductivity = 0, pad_conductivity = 0
      !> Radius of the bore and thickness of the pad, m; film coefficient at back and ends of the pad, W/(m^2 K);
      !> temperature there, C.
      real(wp) :: radius = 0, thickness = 0, back_coefficient = 0, back_temperature = 0
      !> Of the layers, 0 (pad) to 1 (journal).
      real(wp), allocatable :: zeta(:)
   end type film_heat_type


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

   !> Of n unknowns, with all zero.
   pure type(band_system_type) function new_band_system(n, below, above, sides) result(system)
      integer, intent(in) :: n, below, above, sides
      system%below = below
      system%above = above
      ! rows of the matrix lie 8 numbers apart, all the same in lines of the cache
      allocate (system%matrix(8*((2*below + above + 7)/8) + 1, n), system%right(n, sides), source=0.0_wp)
   end function new_band_system

   !> Adds to an element of the matrix.
   pure subroutine add(self, row, column, value)
      class(band_system_type), intent(inout) :: self
      integer, intent(in) :: row, column
      real(wp), intent(in) :: value
      associate (i => self%below + self%above + 1 + row - column)
         self%matrix(i, column) = self%matrix(i, column) + value
      end associate
   end subroutine add

   !> Adds a conductance between two unknowns.
   pure subroutine join(self, a, b, conductance)
      class(band_system_type), intent(inout) :: self
      integer, intent(in) :: a, b
      real(wp), intent(in) :: conductance
      call self%add(a, a, conductance)
      call self%add(a, b, -conductance)
      call self%add(b, b, conductance)
      call self%add(b, a, -conductance)
   end subroutine join

   !> Adds a conductance from an unknown to a given value, which counts in one of the right sides.
   pure subroutine leave(self, row, conductance, value, side)
      class(band_system_type), intent(inout) :: self
      integer, intent(in) :: row, side
      real(wp), intent(in) :: conductance, value
      call self%add(row, row, conductance)
      self%right(row, side) = self%right(row, side) + conductance*value
   end subroutine leave

   !> Makes the right sides the solutions; the matrix is lost. `ok` is false where it is singular.
   subroutine solve_band(self, ok)
      class(band_system_type), intent(inout) :: self
      logical, intent(out) :: ok
      integer :: pivots(size(self%right, 1)), info
      associate (n => size(self%right, 1), sides => size(self%right, 2))
         call dgbsv(n, self%below, self%above, sides, self%matrix, size(self%matrix, 1), pivots, self%right, n, info)
      end associate
      ok = info == 0
   end subroutine solve_band

   !> Faces of n layers, 0 to n, close at both walls.
   pure function layer_faces(n) result(zeta)
      integer, intent(in) :: n
      real(wp) :: zeta(0:n)
      integer :: j
      zeta = [((1 - cos(pi*j/n))/2, j=0, n)]
   end function layer_faces

   !> Of layers between these faces with these fluidities, 1/(Pa s).
   pure type(film_profile) function new_profile(zeta, fluidity) result(profile)
      real(wp), intent(in) :: zeta(0:), fluidity(:)
      real(wp), dimension(size(fluidity)) :: m0, m1, m2, inner
      real(wp), dimension(0:size(fluidity)) :: sum0, sum1
      integer :: j
      associate (n => size(fluidity), low => zeta(:size(fluidity) - 1), high => zeta(1:))
         m0 = fluidity*(high - low)
         m1 = fluidity*(high**2 - low**2)/2
         m2 = fluidity*(high**3 - low**3)/3
         sum0 = 0
         sum1 = 0
         do j = 1, n
            sum0(j) = sum0(j - 1) + m0(j)
            sum1(j) = sum1(j - 1) + m1(j)
         end do
         profile%b = sum1(n)/sum0(n)
         profile%f0 = 1/sum0(n)
         allocate (profile%sliding(0:n), profile%driven(0:n), source=0.0_wp)
         ! M_1 in a layer is a parabola, M_0 a line
         inner = sum1(:n - 1)*(high - low) + fluidity/2*((high**3 - low**3)/3 - low**2*(high - low))
         do j = 1, n
            associate (mean => (sum0(j - 1) + sum0(j))/2*(zeta(j) - zeta(j - 1)))
               profile%sliding(j) = profile%sliding(j - 1) + mean/sum0(n)
               profile%driven(j) = profile%driven(j - 1) + profile%b*mean - inner(j)
            end associate
         end do
         profile%f1 = profile%sliding(n)
         profile%f2 = profile%driven(n)
         profile%shear = m0*profile%f0**2
         profile%pressure = m2 - 2*profile%b*m1 + profile%b**2*m0
         profile%mixed = 2*profile%f0*(m1 - profile%b*m0)
      end associate
   end function new_profile

   !> An oil with this viscosity, Pa s, and the weights of these profiles at the middles of equal steps from the leading
   !> to the trailing edge, by least squares.
   type(film_oil) function fitted_oil(viscosity, profiles) result(oil)
      real(wp), intent(in) :: viscosity
      type(film_profile), intent(in) :: profiles(:)
      real(wp) :: powers(size(profiles), 0:weights_degree), matrix(0:weights_degree, 0:weights_degree)
      real(wp) :: right(0:weights_degree, 3)
      integer :: i, k
      logical :: ignored
      associate (n => size(profiles))
         do k = 0, weights_degree
            powers(:, k) = [((real(2*i - 1, wp)/n - 1)**k, i=1, n)]
         end do
         matrix = matmul(transpose(powers), powers)
         right(:, 1) = matmul(log(12*viscosity*profiles%f2), powers)
         right(:, 2) = matmul(profiles%f1, powers)
         right(:, 3) = matmul(log(profiles%f0/viscosity), powers)
      end associate
      call solve(size(matrix, 1), 3, matrix, right, ignored)
      oil = uneven_oil(viscosity, right)
   end function fitted_oil

   !> Of a film with these streams and profiles of the stations, at a speed of the journal's surface, m/s.
   subroutine solve_energy(heat, stream, profiles, surface_speed, found)
      type(film_heat_type), intent(in) :: heat
      type(film_stream), intent(in) :: stream
      type(film_profile), intent(in) :: profiles(:)
      real(wp), intent(in) :: surface_speed
      type(pad_heat), intent(out) :: found
      type(band_system_type) :: system
      !> Flow downstream through the layers of each face, m^3/s, and heat made in the layers of each station, W.
      real(wp) :: flow(size(heat%zeta) - 1, 0:size(profiles)), own(size(heat%zeta) - 1, size(profiles))
      !> Conductances of a station, W/K: across the film, between the middles of layers, and from the middle of the
      !> layer at a wall to the wall (layers and eddies are symmetric); from the middle of the last layer of the pad to
      !> its surface; out of the back; of each layer of the pad to the next one, to the next station, and out of an end.
      real(wp) :: across(size(heat%zeta) - 2, size(profiles)), to_wall(size(profiles)), to_surface, out_of_back
      real(wp), dimension(solid_layers) :: to_next, along, out_of_end
      integer :: layers, stations, rows, i
      layers = size(heat%zeta) - 1
      stations = size(profiles)
      rows = solid_layers + layers
      system = new_band_system(rows*stations, 2*rows, rows, 3)
      call find_flows()
      call find_conductances()
      call make_heat()
      found%made = sum(own)
      call add_transport()
      call add_conduction()
      do i = 1, stations
         associate (first => unknown(i, solid_layers + 1), last => unknown(i, rows))
            system%right(first:last, by_nothing) = system%right(first:last, by_nothing) + own(:, i)
         end associate
      end do
      call system%solve(found%solved)
      if (.not. found%solved) return
      found%field = reshape(system%right, [rows, stations, 3])
      call find_ends()

   contains

      !> The unknown of a layer at a station, of the pad's first.
      pure integer function unknown(i, layer)
         integer, intent(in) :: i, layer
         unknown = (i - 1)*rows + layer
      end function unknown

      !> The pad is a part of a ring: its back is longer than its bore.
      subroutine find_conductances()
         real(wp) :: middle(layers), still(size(profiles)), outer(solid_layers), within(solid_layers), arc
         integer :: i
         middle = (heat%zeta(1:layers) + heat%zeta(2:))/2
         still = heat%conductivity*max(stream%filled, least_filled)*stream%step*stream%width/stream%h
         to_wall = still/(0.5_wp*(heat%zeta(2) - heat%zeta(1)))
         do i = 1, stations
            across(:, i) = still(i)/(middle(2:) - middle(:layers - 1))
            if (.not. allocated(profiles(i)%conduction)) cycle
            associate (all => max(stream%filled(i), least_filled)*stream%step*stream%width/stream%h(i) &
               & *profiles(i)%conduction)
               to_wall(i) = all(1)
               across(:, i) = all(2:layers)
            end associate
         end do
         arc = stream%step/heat%radius
         associate (layer => heat%thickness/solid_layers, k_pad => heat%pad_conductivity)
            outer = heat%radius + [((solid_layers + 1 - i)*layer, i=1, solid_layers)]
            within = outer - layer/2
            to_surface = k_pad*arc*stream%width/log(within(solid_layers)/heat%radius)
            to_next = k_pad*arc*stream%width/log(within/(within - layer))
            along = k_pad*stream%width/arc*log(outer/(outer - layer))
            out_of_back = 0
            out_of_end = 0
            if (.not. heat%back_coefficient > 0) return
            out_of_back = arc*stream%width/(log(outer(1)/within(1))/k_pad + 1/(heat%back_coefficient*outer(1)))
            out_of_end = stream%width*layer/(within*arc/2/k_pad + 1/heat%back_coefficient)
         end associate
      end subroutine find_conductances

      !> Conduction across the film, to the shaft, and in the pad, to the film and out of its back and both ends.
      subroutine add_conduction()
         integer :: i, j, k
         do i = 1, stations
            do j = 1, layers - 1
               call system%join(unknown(i, solid_layers + j), unknown(i, solid_layers + j + 1), across(j, i))
            end do
            call system%leave(unknown(i, rows), to_wall(i), 1.0_wp, by_shaft)
         end do
         do i = 1, stations
            do k = 1, solid_layers
               if (k < solid_layers) call system%join(unknown(i, k), unknown(i, k + 1), to_next(k))
               if (i < stations) call system%join(unknown(i, k), unknown(i + 1, k), along(k))
               if (i == 1 .or. i == stations) call system%leave(unknown(i, k), out_of_end(k), heat%back_temperature, &
                  & by_nothing)
            end do
            call system%leave(unknown(i, 1), out_of_back, heat%back_temperature, by_nothing)
            call system%join(unknown(i, solid_layers), unknown(i, solid_layers + 1), 1/(1/to_wall(i) + 1/to_surface))
         end do
      end subroutine add_conduction

      !> By shear, and evenly across the film by friction of asperities.
      subroutine make_heat()
         real(wp) :: gradient
         integer :: i
         do i = 1, stations
            associate (p => profiles(i), h => stream%h(i), area => stream%step*stream%width)
               gradient = -(sum(stream%flow(i - 1:i) - surface_speed*stream%h_face(i - 1:i) &
                  & *stream%filled_face(i - 1:i)*stream%width*p%f1)/2)/(stream%width*h**3*p%f2)
               own(:, i) = stream%pressure_heat(i)*p%pressure/p%f2 + area*surface_speed*(h*gradient*p%mixed &
                  & + stream%filled(i)*surface_speed/h*p%shear)
            end associate
            if (allocated(stream%boundary_heat)) own(:, i) = own(:, i) + stream%boundary_heat(i) &
               & *(heat%zeta(2:) - heat%zeta(:layers))
         end do
      end subroutine make_heat

      !> What leaves the film at its ends and walls, of each part of the temperatures.
      subroutine find_ends()
         real(wp) :: weight(2), of_inlet, out_flow
         integer :: i, j, k, at(2)
         out_flow = sum(flow(:, stations), mask=flow(:, stations) > 0)
         found%back_flow = -sum(flow(:, 0), mask=flow(:, 0) < 0)
         do j = 1, layers
            associate (film => found%field(solid_layers + j, :, :), out => flow(j, stations))
               if (out > 0) then
                  call face_temperature(out, flow(j, 0), stations, stations, at, weight, of_inlet)
                  found%outlet = found%outlet + out/out_flow*matmul(weight, film(at, :))
                  found%outlet(by_inlet) = found%outlet(by_inlet) + out/out_flow*of_inlet
               end if
               if (flow(j, 0) < 0) found%back = found%back - flow(j, 0)/found%back_flow*film(1, :)
            end associate
         end do
         allocate (found%surface(stations, 3))
         do i = 1, stations
            associate (wall => to_wall(i))
               found%to_shaft = found%to_shaft + wall*found%field(rows, i, :)
               found%to_shaft(by_shaft) = found%to_shaft(by_shaft) - wall
               found%surface(i, :) = (wall*found%field(solid_layers + 1, i, :) &
                  & + to_surface*found%field(solid_layers, i, :))/(wall + to_surface)
               found%to_back = found%to_back + out_of_back*found%field(1, i, :)
               found%to_back(by_nothing) = found%to_back(by_nothing) - out_of_back*heat%back_temperature
            end associate
         end do
         do k = 1, solid_layers
            do i = 1, stations, max(1, stations - 1)
               found%to_back = found%to_back + out_of_end(k)*found%field(k, i, :)
               found%to_back(by_nothing) = found%to_back(by_nothing) - out_of_end(k)*heat%back_temperature
            end do
         end do
      end subroutine find_ends

      ! What the oil of one pad's film carries along the arc and across the film, by upwind differences of second order
      ! (of first order where it flows back) along and central ones across. Oil that leaves at the sides is spread over
      ! the height as the velocity there is, and has the temperature of its place.

      subroutine find_flows()
         real(wp), dimension(0:layers) :: sliding, driven, below
         integer :: i
         do i = 0, stations
            associate (up => profiles(max(i, 1)), down => profiles(min(i + 1, stations)))
               sliding = (up%sliding + down%sliding)/2*surface_speed*stream%h_face(i)*stream%width*stream%filled_face(i)
               driven = (up%driven/up%f2 + down%driven/down%f2)/2
               below = sliding + (stream%flow(i) - sliding(layers))*driven
               flow(:, i) = below(1:) - below(:layers - 1)
            end associate
         end do
      end subroutine find_flows

      !> What flows carry.
      subroutine add_transport()
         real(wp) :: up, side, share, weight(2), of_inlet
         integer :: i, j, k, at(2)
         associate (zeta => heat%zeta, c => heat%capacity)
            do i = 0, stations
               do j = 1, layers
                  call face_temperature(flow(j, i), flow(j, 0), i, stations, at, weight, of_inlet)
                  do k = max(i, 1), min(i + 1, stations)
                     ! out of the station before the face, into the one behind it
                     associate (carried => c*flow(j, i)*merge(1, -1, k == i), row => unknown(k, solid_layers + j))
                        call system%add(row, unknown(at(1), solid_layers + j), carried*weight(1))
                        if (abs(weight(2)) > 0) call system%add(row, unknown(at(2), solid_layers + j), &
                           & carried*weight(2))
                        system%right(row, by_inlet) = system%right(row, by_inlet) - carried*of_inlet
                     end associate
                  end do
               end do
            end do
            do i = 1, stations
               up = 0
               do j = 1, layers
                  associate (below => unknown(i, solid_layers + j), above => unknown(i, solid_layers + j + 1))
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
   end subroutine solve_energy

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
end module film_energy
