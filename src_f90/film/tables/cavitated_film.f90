!> The cavitated film of a dimensionless pad: its force is that of the film in the same place that is just full, times
!> (1 - T)^4 (exp(q) - floor), with complex numbers for forces and q a smooth function of the film thicknesses at both
!> edges and of T, the part of the arc where the film diverges (docs/theory/film.md). Here q is solved where it is asked
!> for; cavitation_table interpolates it.
module cavitated_film
   use kinds, only: wp
   use film_solver, only: film_counters
   use dimensionless_pad, only: dimensionless_pad_type
   use force_ratio, only: force_ratio_solver, force_ratio_type, new_force_ratio_solver, least_tolerance
   use cell_polynomials, only: simd_width, corner_data
   implicit none (type, external)
   private
   public :: cavitated_film_type, node_type, new_cavitated_film

   !> Powers of 1 - T by which force and highest pressure end with the condition of Reynolds.
   integer, parameter :: force_power = 4, pressure_power = 3
   !> T above which a film is not solved any more, but its functions continue along their slopes over T.
   real(wp), parameter :: last_solved = 0.99_wp
   !> With Guembel's condition, whose force ends before T = 1 does, added to the ratio before its logarithm.
   real(wp), parameter :: gumbel_floor = 1e-2_wp
   !> Films that are remembered: of a state of all pads.
   integer, parameter :: memory = 24

   !> Functions: real and imaginary part of q, the logarithm of the pressure ratio over (1 - T)^3, and 0. Their values,
   !> and derivatives over both thicknesses and T, (function, value or derivative).
   type :: node_type
      real(wp) :: data(simd_width, corner_data) = 0
      !> Whether the film is open and was solved.
      logical :: ok = .false.
   end type node_type

   type :: cavitated_film_type
      type(dimensionless_pad_type) :: pad
      type(force_ratio_solver), private :: ratios
      real(wp), private :: floor = 0
      !> The films looked up last, one after the other, and where.
      type(node_type), allocatable, private :: remembered(:)
      real(wp), allocatable, private :: remembered_at(:, :)
      integer, private :: remember_next = 0
   contains
      procedure :: look_up
      procedure :: solve
      procedure :: set_ratio
      procedure, private :: find
   end type cavitated_film_type

contains

   !> The films of a pad, with the condition of Reynolds or Guembel: forces to a tolerance, over themselves.
   function new_cavitated_film(pad, gumbel, tolerance) result(films)
      type(dimensionless_pad_type), intent(in) :: pad
      logical, intent(in) :: gumbel
      real(wp), intent(in) :: tolerance
      type(cavitated_film_type) :: films
      films%pad = pad
      if (gumbel) films%floor = gumbel_floor
      films%ratios = new_force_ratio_solver(pad, gumbel, max(tolerance, least_tolerance))
   end function new_cavitated_film

   !> The functions of node_type and, if they are wanted, their derivatives over both thicknesses and T, (function,
   !> axis), for an open film with these thicknesses at its edges and 0 < T < 1. `last` is the caller's memory of the
   !> place in a table, 0 at first. `good` is false where the film has no solution.
   subroutine look_up(self, edges, t, want_slopes, last, counters, value, slope, good)
      class(cavitated_film_type), intent(inout) :: self
      real(wp), intent(in) :: edges(2), t
      logical, intent(in) :: want_slopes
      integer, intent(inout) :: last
      type(film_counters), intent(inout) :: counters
      real(wp), intent(out) :: value(simd_width), slope(simd_width, 3)
      logical, intent(out) :: good
      type(node_type) :: node
      call self%find([edges, t], counters, node)
      value = node%data(:, 1)
      slope = node%data(:, 2:)
      good = node%ok
   end subroutine look_up

   !> The film at a place, from memory if it is among the last that were solved: a state is often evaluated again, for
   !> its derivatives.
   subroutine find(self, place, counters, node)
      class(cavitated_film_type), intent(inout) :: self
      real(wp), intent(in) :: place(3)
      type(film_counters), intent(inout) :: counters
      type(node_type), intent(out) :: node
      integer :: i
      if (.not. allocated(self%remembered)) then
         allocate (self%remembered(memory), self%remembered_at(3, memory))
         self%remembered_at = huge(1.0_wp)
      end if
      do i = 1, size(self%remembered)
         if (any(abs(self%remembered_at(:, i) - place) > 0)) cycle
         node = self%remembered(i)
         return
      end do
      call self%solve(place(:2), place(3), counters, node)
      self%remember_next = modulo(self%remember_next, size(self%remembered)) + 1
      self%remembered(self%remember_next) = node
      self%remembered_at(:, self%remember_next) = place
   end subroutine find

   !> The functions of a film.
   subroutine solve(self, edges, t, counters, node)
      class(cavitated_film_type), intent(inout) :: self
      real(wp), intent(in) :: edges(2), t
      type(film_counters), intent(inout) :: counters
      type(node_type), intent(out) :: node
      type(force_ratio_type) :: ratio
      complex(wp) :: part, slopes(3)
      real(wp) :: at, room
      at = min(t, last_solved)
      room = 1 - at
      counters%nodes = counters%nodes + 1
      ratio = self%ratios%at(edges, self%pad%tangent*(1 - 2*at))
      node%ok = ratio%ok
      if (.not. node%ok) return
      part = ratio%value/room**force_power + self%floor
      slopes = ratio%slopes/room**force_power/part
      slopes(3) = -2*self%pad%tangent*slopes(3) + force_power/room*(part - self%floor)/part
      associate (q => log(part) + (t - at)*slopes(3))
         node%data(:2, 1) = [real(q), aimag(q)]
      end associate
      node%data(1, 2:) = real(slopes)
      node%data(2, 2:) = aimag(slopes)
      node%data(3, 1) = log(ratio%pressure/room**pressure_power + self%floor)
   end subroutine solve

   !> The force of a film over that of the film that is just full, its derivatives over both thicknesses and T, and the
   !> same ratio of the highest pressures, from what `look_up` found at a T.
   pure subroutine set_ratio(self, t, value, slope, force, force_slopes, pressure)
      class(cavitated_film_type), intent(in) :: self
      real(wp), intent(in) :: t, value(simd_width), slope(simd_width, 3)
      complex(wp), intent(out) :: force, force_slopes(3)
      real(wp), intent(out) :: pressure
      complex(wp) :: part
      associate (room => 1 - t)
         part = room**force_power*exp(cmplx(value(1), value(2), wp))
         force = part - self%floor*room**force_power
         force_slopes = part*cmplx(slope(1, :), slope(2, :), wp)
         force_slopes(3) = force_slopes(3) - force_power/room*force
         pressure = room**pressure_power*max(0.0_wp, exp(value(3)) - self%floor)
      end associate
   end subroutine set_ratio
end module cavitated_film
