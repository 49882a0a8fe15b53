!> Closed forms of a pad's body: an annular sector of uniform density, as long as the bearing.
module annular_sector
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: annular_sector_type, new_annular_sector

   type :: annular_sector_type
      !> m^3.
      real(wp) :: volume = 0
      !> Centre of gravity from the pivot, along the pad and outward, m.
      real(wp) :: centre_tangential = 0, centre_radial = 0
      !> Moment of inertia about the pivot over the mass, m^2.
      real(wp) :: squared_radius = 0
   end type annular_sector_type

contains

   !> The sector between the bore and a back that lies `thickness` behind it, from `trailing` before to `leading` behind
   !> the pivot, rad; the pivot lies at `distance` outward of the bore.
   pure type(annular_sector_type) function new_annular_sector(bore, thickness, leading, trailing, length, distance) &
      & result(sector)
      real(wp), intent(in) :: bore, thickness, leading, trailing, length, distance
      real(wp) :: back, arc, radius, pivot, outward
      back = bore + thickness
      arc = leading + trailing
      pivot = bore + distance
      ! a ring's share of its area at each radius, and the mean direction of its points
      radius = 2*(bore**2 + bore*back + back**2)/(3*(bore + back))
      outward = radius*(sin(leading) + sin(trailing))/arc
      sector%volume = 0.5_wp*arc*thickness*(bore + back)*length
      sector%centre_tangential = radius*(cos(trailing) - cos(leading))/arc
      sector%centre_radial = outward - pivot
      sector%squared_radius = 0.5_wp*(bore**2 + back**2) + pivot*(pivot - 2*outward)
   end function new_annular_sector
end module annular_sector
