!> Temperatures in all films of a bearing: the pads' (film_energy), joined by grooves and shaft, in which they are
!> affine (docs/theory/heat.md, *Temperature in the film*).
module film_network
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use kinds, only: wp
   use linear_algebra, only: dgesv
   use case_groups, only: bearing_type, oil_type, thermal_type, is_set
   use oil_properties, only: viscosity, viscosities
   use heat_balance, only: oil_temperatures_type, groove_type
   use film_oils, only: film_oil
   use film_streams, only: film_stream
   use film_profiles, only: film_profile, layer_faces, new_profile, fitted_oil
   use film_conduction, only: film_heat_type, solid_layers, by_nothing, by_inlet, by_shaft
   use film_energy, only: pad_heat, solve_energy
   implicit none (type, external)
   private
   public :: warm_films_type, new_warm_films, set_heat, oil_of_field, solve_network

   !> The films of one bearing.
   type :: warm_films_type
      type(film_heat_type), allocatable :: heat(:)
      !> C, (layer, station, pad), the pad's layers first; of the pads' surfaces, (station, pad).
      real(wp), allocatable :: fields(:, :, :), surfaces(:, :)
      type(oil_temperatures_type) :: oil
      !> Heat that each film gives to the shaft and to its pad, W.
      real(wp), allocatable :: to_shaft(:), to_pad(:)
      !> Part of each pad's arc over which the flow, over width and height, is against the rotation.
      real(wp), allocatable :: reversed(:)
   end type warm_films_type

contains

   !> Films of a bearing with one temperature a pad, C.
   pure type(warm_films_type) function new_warm_films(bearing, thermal, temperature) result(films)
      type(bearing_type), intent(in) :: bearing
      type(thermal_type), intent(in) :: thermal
      real(wp), intent(in) :: temperature(:)
      integer :: i
      call set_heat(bearing, thermal%layers, films)
      allocate (films%fields(solid_layers + thermal%layers, thermal%stations, size(temperature)))
      allocate (films%surfaces(thermal%stations, size(temperature)))
      allocate (films%reversed(size(temperature)), source=0.0_wp)
      do i = 1, size(temperature)
         films%fields(:, :, i) = temperature(i)
         films%surfaces(:, i) = temperature(i)
      end do
   end function new_warm_films

   !> Gives the films of a bearing what heat meets in them, of this number of layers.
   pure subroutine set_heat(bearing, layers, films)
      type(bearing_type), intent(in) :: bearing
      integer, intent(in) :: layers
      type(warm_films_type), intent(inout) :: films
      integer :: i
      associate (oil => bearing%oil, pads => bearing%pads)
         if (.not. allocated(films%heat)) allocate (films%heat(bearing%pad_count()))
         do i = 1, size(films%heat)
            films%heat(i) = film_heat_type(oil%density*oil%specific_heat, oil%conductivity, pads%conductivity(i), &
               & pads%thickness(i), oil%back_coefficient, oil%supply_temperature, layer_faces(layers))
         end do
         if (is_set(oil%back_temperature)) films%heat%back_temperature = oil%back_temperature
      end associate
   end subroutine set_heat

   !> Profiles of the stations of a film with these temperatures, C, (layer, station), of the pad first, and the oil
   !> that the film solvers take for it, with the viscosity of the mean temperature of the film.
   subroutine oil_of_field(oil, zeta, field, profiles, film)
      type(oil_type), intent(in) :: oil
      !> Faces of the layers.
      real(wp), intent(in) :: zeta(:), field(:, :)
      type(film_profile), intent(out) :: profiles(:)
      type(film_oil), intent(out) :: film
      real(wp) :: fluidity(size(zeta) - 1, size(profiles))
      integer :: i
      fluidity = 1/viscosities(oil, field(solid_layers + 1:, :))
      do i = 1, size(profiles)
         profiles(i) = new_profile(zeta, fluidity(:, i))
      end do
      film = fitted_oil(viscosity(oil, mean_temperature(zeta, field)), profiles)
   end subroutine oil_of_field

   !> Mean over arc and height, C.
   pure real(wp) function mean_temperature(zeta, field)
      real(wp), intent(in) :: zeta(:), field(:, :)
      mean_temperature = sum(matmul(zeta(2:) - zeta(:size(zeta) - 1), field(solid_layers + 1:, :)))/size(field, 2)
   end function mean_temperature

   !> The fields of all pads that the films lead to, C, (layer, station, pad), from their streams and profiles at a
   !> speed of the journal's surface, m/s; `films` has the temperatures of their oil and surfaces then. `ok` is false
   !> where no heat balance is found.
   subroutine solve_network(oil, grooves, films, streams, profiles, surface_speed, fields, ok)
      type(oil_type), intent(in) :: oil
      type(groove_type), intent(in) :: grooves(:)
      type(warm_films_type), intent(inout) :: films
      type(film_stream), intent(in) :: streams(:)
      !> (station, pad).
      type(film_profile), intent(in) :: profiles(:, :)
      real(wp), intent(in) :: surface_speed
      real(wp), intent(out) :: fields(:, :, :)
      logical, intent(out) :: ok
      type(pad_heat) :: pads(size(streams))
      type(oil_temperatures_type) :: found
      real(wp), dimension(size(streams)) :: inflow, outflow, hot
      real(wp) :: ends(size(streams) + 1), parts(3)
      real(wp), allocatable :: to_shaft(:), to_pad(:)
      integer :: i, last
      last = size(ends)
      do i = 1, size(streams)
         call solve_energy(films%heat(i), streams(i), profiles(:, i), surface_speed, pads(i))
         inflow(i) = streams(i)%flow(0)
         outflow(i) = streams(i)%flow(size(profiles, 1))
         films%reversed(i) = real(count(streams(i)%flow < 0), wp)/size(streams(i)%flow)
      end do
      ok = all(pads%solved)
      if (.not. ok) return
      call find_ends(oil, grooves, pads, inflow, outflow, hot, ends, ok)
      if (.not. ok) return
      found%inlet = ends(:size(streams))
      found%shaft = ends(last)
      allocate (found%mean, found%outlet, found%maximum, found%hottest, mold=found%inlet)
      found%drain = 0
      allocate (to_shaft(size(streams)), to_pad(size(streams)))
      do i = 1, size(streams)
         parts = [1.0_wp, ends(i), ends(last)]
         fields(:, :, i) = pads(i)%field(:, :, by_nothing) + ends(i)*pads(i)%field(:, :, by_inlet) &
            & + ends(last)*pads(i)%field(:, :, by_shaft)
         found%mean(i) = mean_temperature(films%heat(i)%zeta, fields(:, :, i))
         found%outlet(i) = dot_product(pads(i)%outlet, parts)
         films%surfaces(:, i) = matmul(pads(i)%surface, parts)
         found%maximum(i) = highest(films%surfaces(:, i))
         found%hottest(i) = max(found%maximum(i), maxval(fields(solid_layers + 1:, :, i)))
         to_shaft(i) = dot_product(pads(i)%to_shaft, parts)
         to_pad(i) = dot_product(pads(i)%to_back, parts)
         found%drain = found%drain + pads(i)%made - to_shaft(i) - to_pad(i)
      end do
      associate (fresh => sum(inflow - hot)*films%heat(1)%capacity)
         found%drain = oil%supply_temperature + merge(found%drain/max(fresh, tiny(fresh)), 0.0_wp, fresh > 0)
      end associate
      films%oil = found
      call move_alloc(to_shaft, films%to_shaft)
      call move_alloc(to_pad, films%to_pad)
   end subroutine solve_network

   !> Temperatures where the films begin and, last, of the shaft, C, and which flow comes hot from upstream, m^3/s.
   subroutine find_ends(oil, grooves, pads, inflow, outflow, hot, ends, ok)
      type(oil_type), intent(in) :: oil
      type(groove_type), intent(in) :: grooves(:)
      type(pad_heat), intent(in) :: pads(:)
      !> Of each pad, without what runs back, m^3/s.
      real(wp), intent(in) :: inflow(:), outflow(:)
      real(wp), intent(out) :: hot(:), ends(:)
      logical, intent(out) :: ok
      real(wp) :: matrix(size(ends), size(ends))
      integer :: i, last, info, pivots(size(ends))
      last = size(ends)
      matrix = 0
      ends = 0
      do i = 1, size(pads)
         matrix(last, i) = pads(i)%to_shaft(by_inlet)
         matrix(last, last) = matrix(last, last) + pads(i)%to_shaft(by_shaft)
         ends(last) = ends(last) - pads(i)%to_shaft(by_nothing)
         associate (up => grooves(i)%upstream, back => pads(i)%back_flow)
            hot(i) = max(0.0_wp, min(grooves(i)%carry_over*outflow(up), inflow(i)))
            ! where all in all oil runs out here, what comes in is this oil
            matrix(i, i) = matrix(i, i) + max(inflow(i), 0.0_wp) + back - back*pads(i)%back(by_inlet)
            matrix(i, up) = matrix(i, up) - hot(i)*pads(up)%outlet(by_inlet)
            matrix(i, last) = -hot(i)*pads(up)%outlet(by_shaft) - back*pads(i)%back(by_shaft)
            ends(i) = hot(i)*pads(up)%outlet(by_nothing) + back*pads(i)%back(by_nothing) &
               & + max(inflow(i) - hot(i), 0.0_wp)*oil%supply_temperature
            if (inflow(i) + back > 0) cycle
            ! nothing comes in: no temperature counts
            matrix(i, :) = 0
            matrix(i, i) = 1
            ends(i) = oil%supply_temperature
         end associate
      end do
      if (is_set(oil%shaft_temperature)) then
         matrix(last, :) = 0
         matrix(last, last) = 1
         ends(last) = oil%shaft_temperature
      end if
      call dgesv(last, 1, matrix, last, pivots, ends, last, info)
      ok = info == 0 .and. all(ieee_is_finite(ends))
   end subroutine find_ends

   !> The highest of values at equal steps, of the parabola through three.
   pure real(wp) function highest(values)
      real(wp), intent(in) :: values(:)
      real(wp) :: bend
      integer :: i
      i = maxloc(values, 1)
      highest = values(i)
      if (i == 1 .or. i == size(values)) return
      bend = values(i + 1) - 2*values(i) + values(i - 1)
      if (bend < 0) highest = values(i) - (values(i + 1) - values(i - 1))**2/(8*bend)
   end function highest
end module film_network
