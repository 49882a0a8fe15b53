!> The full film of a dimensionless pad: force = S M w, with a symmetric M of three functions of the film thicknesses at
!> both edges (docs/theory/film.md); the highest pressure, over S, of the film that is just full, a fourth; the force of
!> a pressure 1 at the leading edge; and, over S, that of the rotation's own drive (rotation_drive). Here all are solved
!> where they are asked for, the forces with exact derivatives; full_film_table interpolates them.
module full_film
   use kinds, only: wp
   use film_solver, only: film_motion, film_response, film_counters, film_ok
   use dimensionless_pad, only: dimensionless_pad_type, thickness_scale
   use fourier_film, only: fourier_film_type, converged_film
   use rotation_drive, only: rotation_drive_type
   use cell_polynomials, only: simd_width
   implicit none (type, external)
   private
   public :: full_film_type, full_film_forces, new_full_film

   !> Error of what is solved over the tolerance.
   real(wp), parameter :: share_of_nodes = 0.3_wp

   !> Functions of the thicknesses at both edges, and their derivatives over these, (function, edge).
   type :: full_film_forces
      !> M_11, M_12, M_22 and the highest pressure at w = (1, tan(half the arc)), all over S.
      real(wp) :: of_velocity(simd_width), velocity_slopes(simd_width, 2)
      !> Where there is a pressure at the leading edge, the force (along, outward, 0, 0) of a pressure 1 there.
      real(wp) :: of_supply(simd_width), supply_slopes(simd_width, 2)
      !> Where the rotation acts, the force of D at t = 1, over S.
      real(wp) :: of_rotation(simd_width), rotation_slopes(simd_width, 2)
   end type full_film_forces

   type :: full_film_type
      type(dimensionless_pad_type) :: pad
      type(rotation_drive_type) :: drive
      !> Whether there is a pressure at the leading edge.
      logical :: supplied = .false.
      !> Without pressure around the pad, and, where there is one, with a pressure 1 at its leading edge.
      type(fourier_film_type) :: film, supplied_film
   contains
      procedure :: look_up
      procedure :: highest_pressure
   end type full_film_type

contains

   !> The full films of a pad with its drive, with a pressure at its leading edge (not where the rotation acts) or
   !> without, to a tolerance over the norm of M.
   function new_full_film(pad, drive, supplied, tolerance) result(films)
      type(dimensionless_pad_type), intent(in) :: pad
      type(rotation_drive_type), intent(in) :: drive
      logical, intent(in) :: supplied
      real(wp), intent(in) :: tolerance
      type(full_film_type) :: films
      films%pad = pad
      films%drive = drive
      films%supplied = supplied
      films%film = converged_film(drive%gap, .false., share_of_nodes*tolerance)
      if (supplied) films%supplied_film = converged_film(pad%gap(1.0_wp), .false., share_of_nodes*tolerance)
   end function new_full_film

   !> The forces of an open film with these thicknesses at its edges, with derivatives if they are wanted. `last` is the
   !> caller's memory of the place in a table, 0 at first. `good` is false where the film has no solution.
   subroutine look_up(self, edges, want_slopes, last, counters, forces, good)
      class(full_film_type), intent(inout) :: self
      real(wp), intent(in) :: edges(2)
      logical, intent(in) :: want_slopes
      integer, intent(inout) :: last
      type(film_counters), intent(inout) :: counters
      type(full_film_forces), intent(out) :: forces
      logical, intent(out) :: good
      type(film_response) :: along, onset, still
      integer :: i
      associate (pad => self%pad, position => self%pad%position(edges), drive => self%drive, &
         & scale => self%drive%force_unit*thickness_scale(edges(1), edges(2)))
         call self%film%evaluate_pad(1, film_motion(position, [1.0_wp, 0.0_wp]), drive%oil, 0.0_wp, want_slopes, along)
         call self%film%evaluate_pad(1, film_motion(position, [1.0_wp, pad%tangent]), drive%oil, 0.0_wp, want_slopes, &
            & onset)
         good = along%status == film_ok
         forces%of_velocity = symmetric(along%force, (onset%force - along%force)/pad%tangent)/scale
         forces%of_velocity(4) = onset%max_pressure/(drive%pressure_unit*scale/drive%force_unit)
         if (want_slopes) then
            associate (of_along => over_edges(pad, along), of_onset => over_edges(pad, onset))
               do i = 1, 2
                  forces%velocity_slopes(:, i) = symmetric(of_along(:, i), (of_onset(:, i) - of_along(:, i)) &
                     & /pad%tangent)/scale + 1.5_wp*forces%of_velocity/edges(i)
               end do
            end associate
         end if
         if (self%supplied) then
            call self%supplied_film%evaluate_pad(1, film_motion(position), drive%oil, 0.0_wp, want_slopes, still)
            forces%of_supply = [still%force, 0.0_wp, 0.0_wp]
            forces%supply_slopes = 0
            if (want_slopes) forces%supply_slopes(:2, :) = over_edges(pad, still)
         end if
         if (.not. drive%acts) return
         call self%film%evaluate_pad(1, film_motion(position, drive%still(position)), drive%oil, drive%speed_unit, &
            & want_slopes, still)
         forces%of_rotation = [still%force, 0.0_wp, 0.0_wp]/scale
         if (.not. want_slopes) return
         ! w = 0 in every place
         still%derivatives(:, :2) = still%derivatives(:, :2) - matmul(still%derivatives(:, 3:), drive%by_rotation())
         forces%rotation_slopes = 0
         forces%rotation_slopes(:2, :) = over_edges(pad, still)/scale
         do i = 1, 2
            forces%rotation_slopes(:2, i) = forces%rotation_slopes(:2, i) + 1.5_wp*forces%of_rotation(:2)/edges(i)
         end do
      end associate
   end subroutine look_up

   !> The highest pressure in the middle plane, or 0, where the film is open and has these thicknesses at its edges, for
   !> w and a pressure at the leading edge or, where the rotation acts, t. `last` as in `look_up`.
   subroutine highest_pressure(self, edges, w, load, last, counters, pressure)
      class(full_film_type), intent(inout) :: self
      real(wp), intent(in) :: edges(2), w(2), load
      integer, intent(inout) :: last
      type(film_counters), intent(inout) :: counters
      real(wp), intent(out) :: pressure
      type(film_response) :: film
      associate (position => self%pad%position(edges), drive => self%drive)
         if (drive%acts) then
            call self%film%evaluate_pad(1, film_motion(position, w + load*drive%still(position)), drive%oil, &
               & load*drive%speed_unit, .false., film)
            pressure = film%max_pressure/drive%pressure_unit
         else if (abs(load) > 0) then
            ! that of a pressure 1 at the leading edge, scaled
            call self%supplied_film%evaluate_pad(1, film_motion(position, w/load), drive%oil, 0.0_wp, .false., film)
            pressure = max(load*film%max_pressure, load*film%min_pressure)
         else
            call self%film%evaluate_pad(1, film_motion(position, w), drive%oil, 0.0_wp, .false., film)
            pressure = film%max_pressure
         end if
      end associate
   end subroutine highest_pressure

   !> M_11, M_12, M_22, 0 from the columns of M, which is symmetric by reciprocity; what the discretisation adds is
   !> shared.
   pure function symmetric(along, outward) result(m)
      real(wp), intent(in) :: along(2), outward(2)
      real(wp) :: m(simd_width)
      m = [along(1), 0.5_wp*(along(2) + outward(1)), outward(2), 0.0_wp]
   end function symmetric

   !> Derivatives of a force over the thicknesses at both edges, (component, edge).
   pure function over_edges(pad, film) result(slopes)
      type(dimensionless_pad_type), intent(in) :: pad
      type(film_response), intent(in) :: film
      real(wp) :: slopes(2, 2)
      slopes(1, :) = pad%over_edges(film%derivatives(1, :2))
      slopes(2, :) = pad%over_edges(film%derivatives(2, :2))
   end function over_edges
end module full_film
