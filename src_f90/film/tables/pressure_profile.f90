!> The pressure along the middle plane of a pad's full film, over a cell of its table: for the highest pressure, which
!> is sampled, not integrated.
!>
!> At points that crowd where the film is thin, pressure times film thickness squared is a polynomial of the film
!> thicknesses at the edges, for either component of w and for a pressure at the leading edge or what the
!> rotation drives besides.
module pressure_profile
   use kinds, only: wp
   use film_solver, only: film_motion
   use dimensionless_pad, only: dimensionless_pad_type, unit_oil
   use rotation_drive, only: rotation_drive_type
   use fourier_film, only: fourier_film_type
   use cell_polynomials, only: node_points, fitted, patch_values
   implicit none (type, external)
   private
   public :: pressure_profile_type, new_pressure_profile, nodes

   !> Points along the arc, without the edges; nodes along either axis of the cell.
   integer, parameter :: points = 12, nodes = 4

   type :: pressure_profile_type
      private
      type(dimensionless_pad_type) :: pad
      real(wp) :: sines(points), cosines(points)
      !> (point and load, power of the second thickness, power of the first); loads are the components of w and, where
      !> there is one, a pressure 1 at the leading edge, or D at t = 1 (rotation_drive).
      real(wp), allocatable :: coefficients(:, :, :)
      !> Pressure at the leading edge over the third load.
      real(wp) :: at_edge = 1
   contains
      procedure :: highest
   end type pressure_profile_type

contains

   !> The profile of a pad over thicknesses `middle + s/per_half`, -1 <= s <= 1, from its axial modes without pressure
   !> around it, and with a pressure 1 at the leading edge or its drive.
   function new_pressure_profile(pad, drive, film, supplied_film, supplied, middle, per_half) result(profile)
      type(dimensionless_pad_type), intent(in) :: pad
      type(rotation_drive_type), intent(in) :: drive
      type(fourier_film_type), intent(inout) :: film, supplied_film
      logical, intent(in) :: supplied
      real(wp), intent(in) :: middle(2), per_half(2)
      type(pressure_profile_type) :: profile
      real(wp), parameter :: along(2) = [1.0_wp, 0.0_wp], outward(2) = [0.0_wp, 1.0_wp]
      real(wp) :: values(points, 3, nodes, nodes), phi(points), pressure(1, points), square(points)
      real(wp) :: edges(0:points + 1), s(nodes)
      integer :: i, k
      profile%pad = pad
      s = node_points(nodes)
      edges = pad%spread_angles(pad%position(middle), -pad%half_arc, pad%half_arc, points + 1)
      phi = edges(1:points)
      profile%sines = sin(phi)
      profile%cosines = cos(phi)
      do k = 1, nodes
         do i = 1, nodes
            associate (position => pad%position(middle + s([i, k])/per_half))
               square = (1 - position(1)*profile%sines - position(2)*profile%cosines)**2
               call film%field_of_pad(1, film_motion(position, along), drive%oil, 0.0_wp, phi, [0.0_wp], pressure)
               values(:, 1, i, k) = pressure(1, :)*square
               call film%field_of_pad(1, film_motion(position, outward), drive%oil, 0.0_wp, phi, [0.0_wp], pressure)
               values(:, 2, i, k) = pressure(1, :)*square
               if (drive%acts) then
                  call film%field_of_pad(1, film_motion(position, drive%still(position)), drive%oil, drive%speed_unit, &
                     & phi, [0.0_wp], pressure)
                  values(:, 3, i, k) = pressure(1, :)*square
               end if
               if (.not. supplied) cycle
               call supplied_film%field_of_pad(1, film_motion(position), unit_oil, 0.0_wp, phi, [0.0_wp], pressure)
               values(:, 3, i, k) = pressure(1, :)*square
            end associate
         end do
      end do
      if (drive%acts) profile%at_edge = 0
      associate (loads => merge(3, 2, supplied .or. drive%acts))
         profile%coefficients = fitted(reshape(values(:, :loads, :, :), [loads*points, nodes, nodes]))
      end associate
      if (drive%acts) profile%coefficients = profile%coefficients/drive%pressure_unit
   end function new_pressure_profile

   !> The highest pressure in the middle plane of the unit pad, or 0, where the film has these thicknesses at its edges,
   !> which lie at s in the cell, under these loads.
   pure real(wp) function highest(self, edges, s, load)
      class(pressure_profile_type), intent(in) :: self
      real(wp), intent(in) :: edges(2), s(2), load(3)
      real(wp) :: values(size(self%coefficients, 1)), pressure(0:points + 1), position(2), bend
      integer :: top, first, i
      values = patch_values(size(values), nodes, self%coefficients, s)
      position = self%pad%position(edges)
      pressure(0) = 0
      pressure(points + 1) = self%at_edge*load(3)
      pressure(1:points) = load(1)*values(:points) + load(2)*values(points + 1:2*points)
      if (size(values) > 2*points) pressure(1:points) = pressure(1:points) + load(3)*values(2*points + 1:)
      pressure(1:points) = pressure(1:points)/(1 - position(1)*self%sines - position(2)*self%cosines)**2
      top = 1
      do i = 2, points
         if (pressure(i) > pressure(top)) top = i
      end do
      highest = max(0.0_wp, pressure(points + 1), pressure(top))
      if (.not. pressure(top) >= highest) return
      ! the parabola through the highest point and its neighbours tells where, a polynomial through five how high
      bend = 2*pressure(top) - pressure(top - 1) - pressure(top + 1)
      if (.not. bend > 0) return
      first = min(max(top - 2, 0), points - 3)
      highest = max(highest, quartic(pressure(first:first + 4), &
         & top - first - 2 + (pressure(top + 1) - pressure(top - 1))/(2*bend)))
   end function highest

   !> At t the polynomial with these values at -2, ..., 2.
   pure real(wp) function quartic(values, t)
      real(wp), intent(in) :: values(-2:2), t
      associate (even => 0.5_wp*(values(1) + values(-1)) - values(0), odd => 0.5_wp*(values(1) - values(-1)), &
         & far_even => 0.5_wp*(values(2) + values(-2)) - values(0), far_odd => 0.5_wp*(values(2) - values(-2)))
         quartic = values(0) + t*((8*odd - far_odd)/6 + t*((16*even - far_even)/12 + t*((far_odd - 2*odd)/6 &
            & + t*(far_even - 4*even)/12)))
      end associate
   end function quartic
end module pressure_profile
