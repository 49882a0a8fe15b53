!> A pad in numbers without dimension: what its film depends on, and nothing else (docs/theory/film.md, *The table*).
!>
!> The frame is that of the pad's middle, lengths along the film are over the pad's radius R, film thicknesses over the
!> pad clearance c. Wedge and squeeze drive a film together, by the velocity
!>    w = velocity + omega R_J/(2 R) (e_2, -e_1),
!> and its force is mu R^4/c^3 times one that follows from the film thicknesses at the two edges and from w alone.
module dimensionless_pad
   use kinds, only: wp
   use film_solver, only: film_oil
   use pad_gap, only: pad_gap_type
   use sommerfeld_nodes, only: span, place_nodes
   implicit none (type, external)
   private
   public :: dimensionless_pad_type, unit_oil, new_dimensionless_pad, thickness_scale

   !> The oil in the films of such pads.
   type(film_oil), parameter :: unit_oil = film_oil(1.0_wp)

   type :: dimensionless_pad_type
      !> Half the arc, rad; axial length over pad radius.
      real(wp) :: half_arc = 0, length = 0
      !> Sine, cosine and tangent of half the arc.
      real(wp) :: sine = 0, cosine = 0, tangent = 0
   contains
      procedure :: position
      procedure :: over_edges
      procedure :: spread_angles
      procedure :: gap
   end type dimensionless_pad_type

contains

   pure type(dimensionless_pad_type) function new_dimensionless_pad(gap) result(pad)
      type(pad_gap_type), intent(in) :: gap
      pad%half_arc = 0.5_wp*gap%arc()
      pad%length = gap%axial_length/gap%pad_radius()
      pad%sine = sin(pad%half_arc)
      pad%cosine = cos(pad%half_arc)
      pad%tangent = pad%sine/pad%cosine
   end function new_dimensionless_pad

   !> The position of the journal that leaves these film thicknesses at the leading and the trailing edge.
   pure function position(self, edges)
      class(dimensionless_pad_type), intent(in) :: self
      real(wp), intent(in) :: edges(2)
      real(wp) :: position(2)
      position = [(edges(2) - edges(1))/(2*self%sine), (1 - 0.5_wp*(edges(1) + edges(2)))/self%cosine]
   end function position

   !> Derivatives over the film thicknesses at the edges from those over the position of the journal.
   pure function over_edges(self, over_position)
      class(dimensionless_pad_type), intent(in) :: self
      real(wp), intent(in) :: over_position(2)
      real(wp) :: over_edges(2)
      associate (tilted => over_position(1)/(2*self%sine), lifted => over_position(2)/(2*self%cosine))
         over_edges = [-tilted - lifted, tilted - lifted]
      end associate
   end function over_edges

   !> Angles from the middle, rad, (0:n), that cut an arc into n parts with the same integral of 1/h each, for the
   !> journal at this position, which leaves the film open: they crowd where it is thin.
   pure function spread_angles(self, position, from, to, n) result(angles)
      class(dimensionless_pad_type), intent(in) :: self
      real(wp), intent(in) :: position(2), from, to
      integer, intent(in) :: n
      real(wp) :: angles(0:n)
      real(wp), dimension(0:n) :: h, sine, cosine
      type(pad_gap_type) :: part
      part = self%gap(0.0_wp)
      part%leading_angle = to
      part%trailing_angle = -from
      associate (d => part%directions())
         call place_nodes(n, span(position, d%middle, d%half)/n, position, d, h, sine, cosine)
      end associate
      angles = atan2(sine, cosine)
      angles(0) = from
      angles(n) = to
   end function spread_angles

   !> The pad for the solvers of films: radius and clearance 1, pressure at the leading edge alone.
   pure type(pad_gap_type) function gap(self, supply_pressure)
      class(dimensionless_pad_type), intent(in) :: self
      real(wp), intent(in) :: supply_pressure
      gap = pad_gap_type(0.0_wp, 1.0_wp, self%length, self%half_arc, self%half_arc, supply_pressure, 0.0_wp, &
         & 0.0_wp)
   end function gap

   !> What forces are tabulated over: their growth as the film becomes thin.
   elemental real(wp) function thickness_scale(leading, trailing)
      real(wp), intent(in) :: leading, trailing
      associate (product => leading*trailing)
         thickness_scale = 1/(product*sqrt(product))
      end associate
   end function thickness_scale
end module dimensionless_pad
