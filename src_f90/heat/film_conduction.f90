!> Conduction across one pad's film, to the shaft, and in the pad, out of its back and ends, by finite volumes; the
!> temperatures of both are the unknowns of a band system.
module film_conduction
   use kinds, only: wp
   use band_system, only: band_system_type
   use film_streams, only: film_stream
   implicit none (type, external)
   private
   public :: film_heat_type, solid_layers, by_nothing, by_inlet, by_shaft, unknown, add_conduction, to_wall, &
      & to_surface, out_of_back, out_of_end

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
      !> Pad thickness, m; film coefficient at back and ends of the pad, W/(m^2 K); temperature there, C.
      real(wp) :: thickness = 0, back_coefficient = 0, back_temperature = 0
      !> Of the layers, 0 (pad) to 1 (journal).
      real(wp), allocatable :: zeta(:)
   end type film_heat_type

contains

   !> The unknown of a layer at a station, of the pad's first.
   pure integer function unknown(heat, i, layer)
      type(film_heat_type), intent(in) :: heat
      integer, intent(in) :: i, layer
      unknown = (i - 1)*(solid_layers + size(heat%zeta) - 1) + layer
   end function unknown

   !> Adds conduction across the film, to the shaft, and in the pad.
   pure subroutine add_conduction(heat, stream, system)
      type(film_heat_type), intent(in) :: heat
      type(film_stream), intent(in) :: stream
      type(band_system_type), intent(inout) :: system
      integer :: i, j
      associate (layers => size(heat%zeta) - 1, middle => (heat%zeta(1:size(heat%zeta) - 1) + heat%zeta(2:))/2)
         do i = 1, size(stream%h)
            do j = 1, layers - 1
               call system%join(unknown(heat, i, solid_layers + j), unknown(heat, i, solid_layers + j + 1), &
                  & across(heat, stream, i)/(middle(j + 1) - middle(j)))
            end do
            call system%leave(unknown(heat, i, solid_layers + layers), to_wall(heat, stream, i), 1.0_wp, by_shaft)
         end do
      end associate
      call add_pad(heat, stream, system)
   end subroutine add_conduction

   !> Conductance across the film of a station, and from the middle of the layer at a wall to the wall, W/K: the
   !> layers are symmetric.
   pure real(wp) function across(heat, stream, i)
      type(film_heat_type), intent(in) :: heat
      type(film_stream), intent(in) :: stream
      integer, intent(in) :: i
      across = heat%conductivity*max(stream%filled(i), least_filled)*stream%step*stream%width/stream%h(i)
   end function across

   pure real(wp) function to_wall(heat, stream, i)
      type(film_heat_type), intent(in) :: heat
      type(film_stream), intent(in) :: stream
      integer, intent(in) :: i
      to_wall = across(heat, stream, i)/(0.5_wp*(heat%zeta(2) - heat%zeta(1)))
   end function to_wall

   !> Conduction in the pad, to the film and out of its back and both ends.
   pure subroutine add_pad(heat, stream, system)
      type(film_heat_type), intent(in) :: heat
      type(film_stream), intent(in) :: stream
      type(band_system_type), intent(inout) :: system
      integer :: i, k, n
      n = size(stream%h)
      associate (layer => heat%thickness/solid_layers, step => stream%step, width => stream%width, &
         & k_pad => heat%pad_conductivity)
         do i = 1, n
            do k = 1, solid_layers
               if (k < solid_layers) call system%join(unknown(heat, i, k), unknown(heat, i, k + 1), &
                  & k_pad*step*width/layer)
               if (i < n) call system%join(unknown(heat, i, k), unknown(heat, i + 1, k), k_pad*layer*width/step)
               if (i == 1 .or. i == n) call system%leave(unknown(heat, i, k), out_of_end(heat, stream), &
                  & heat%back_temperature, by_nothing)
            end do
            call system%leave(unknown(heat, i, 1), out_of_back(heat, stream), heat%back_temperature, &
               & by_nothing)
            call system%join(unknown(heat, i, solid_layers), unknown(heat, i, solid_layers + 1), &
               & 1/(1/to_wall(heat, stream, i) + 1/to_surface(heat, stream)))
         end do
      end associate
   end subroutine add_pad

   !> Conductances of a station, W/K: from the middle of a layer of the pad to its surface; out of the back; out of an
   !> end, of one layer.
   pure real(wp) function to_surface(heat, stream)
      type(film_heat_type), intent(in) :: heat
      type(film_stream), intent(in) :: stream
      to_surface = heat%pad_conductivity*stream%step*stream%width/(heat%thickness/solid_layers/2)
   end function to_surface

   pure real(wp) function out_of_back(heat, stream)
      type(film_heat_type), intent(in) :: heat
      type(film_stream), intent(in) :: stream
      out_of_back = 0
      if (heat%back_coefficient > 0) out_of_back = 1/(1/to_surface(heat, stream) &
         & + 1/(heat%back_coefficient*stream%step*stream%width))
   end function out_of_back

   pure real(wp) function out_of_end(heat, stream)
      type(film_heat_type), intent(in) :: heat
      type(film_stream), intent(in) :: stream
      out_of_end = 0
      if (heat%back_coefficient > 0) out_of_end = stream%width*heat%thickness/solid_layers &
         & /(stream%step/2/heat%pad_conductivity + 1/heat%back_coefficient)
   end function out_of_end
end module film_conduction
