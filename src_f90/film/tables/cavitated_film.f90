!> The cavitated film of a dimensionless pad: force = S M v, as if the film were full and driven by v = w + |w_1| d,
!> with d a function of the film thicknesses at both edges and of T, the part of the arc where the film diverges
!> (docs/theory/film.md). Here d is solved where it is asked for; cavitation_table interpolates it.
module cavitated_film
   use kinds, only: wp
   use film_solver, only: film_counters
   use dimensionless_pad, only: dimensionless_pad_type, thickness_scale
   use effective_velocity, only: effective_velocity_type, drive_type, new_effective_velocity, least_tolerance
   use cell_polynomials, only: simd_width, corner_data
   implicit none (type, external)
   private
   public :: cavitated_film_type, node_type, new_cavitated_film

   !> Film thickness over the clearance above which forces matter less, and are no longer measured by themselves.
   real(wp), parameter :: thick_film = 1.0_wp
   !> Films that are remembered: of a state of all pads.
   integer, parameter :: memory = 24

   !> Functions: the two components of d, the highest pressure of the full film driven by v over that of the cavitated
   !> one, and 0. Their values, and derivatives over both thicknesses and T, (function, value or derivative).
   type :: node_type
      real(wp) :: data(simd_width, corner_data) = 0
      !> Error of the force over that of the film that is just whole, per error of d.
      real(wp) :: weight(2, 2) = 0
      !> Whether the film is open and was solved.
      logical :: ok = .false.
   end type node_type

   type :: cavitated_film_type
      private
      type(dimensionless_pad_type) :: pad
      type(effective_velocity_type) :: drive
      !> The films looked up last, one after the other, and where.
      type(node_type), allocatable :: remembered(:)
      real(wp), allocatable :: remembered_at(:, :)
      integer :: remember_next = 0
   contains
      procedure :: look_up
      procedure :: solve
      procedure, private :: find
   end type cavitated_film_type

contains

   !> The films of a pad, with the condition of Reynolds or Guembel: forces to a tolerance, over that at T = 0.
   function new_cavitated_film(pad, gumbel, tolerance) result(films)
      type(dimensionless_pad_type), intent(in) :: pad
      logical, intent(in) :: gumbel
      real(wp), intent(in) :: tolerance
      type(cavitated_film_type) :: films
      films%pad = pad
      films%drive = new_effective_velocity(pad, gumbel, max(tolerance, least_tolerance))
   end function new_cavitated_film

   !> The functions of node_type and, if they are wanted, their derivatives over both thicknesses and T, (function,
   !> axis), for an open film with these thicknesses at its edges and 0 < T < 1. `last` is the caller's memory of the
   !> place in a table, 0 at first. `good` is false where d is not as close as it should be: next to a film that closes.
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
      type(drive_type) :: drive
      real(wp) :: w(2)
      node%ok = .true.
      ! whole
      if (.not. t > 0) then
         node%data(3, 1) = 1
         return
      end if
      associate (tangent => self%pad%tangent)
         w = [1.0_wp, tangent*(1 - 2*t)]
         ! at T = 1 nothing is left of the film; as it goes to nothing smoothly, only w changes
         if (t < 1) then
            counters%nodes = counters%nodes + 1
            drive = self%drive%at(edges, w(2))
            node%ok = drive%ok
            node%data(3, 1) = drive%pressure_ratio
            node%weight = drive%weight*min(1.0_wp, thickness_scale(edges(1), edges(2)) &
               & /thickness_scale(thick_film, thick_film))
         end if
         node%data(:2, 1) = drive%value - w
         node%data(:2, 2:3) = drive%slopes(:, :2)
         node%data(:2, 4) = -2*tangent*(drive%slopes(:, 3) - [0.0_wp, 1.0_wp])
      end associate
   end subroutine solve
end module cavitated_film
