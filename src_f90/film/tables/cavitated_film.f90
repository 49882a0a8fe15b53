!> The cavitated film of a dimensionless pad: its force is that of the film in the same place that is just full, times
!> (1 - T)^4 (exp(q) - floor), with complex numbers for forces and q a smooth function of the film thicknesses at both
!> edges and of T, the part of the arc where the film diverges (docs/theory/film.md); where the rotation drives the film
!> besides w (rotation_drive) also of t/w_1. Here q is solved where it is asked for; cavitation_table interpolates it.
module cavitated_film
   use kinds, only: wp
   use film_solver, only: film_counters
   use dimensionless_pad, only: dimensionless_pad_type
   use force_ratio, only: force_ratio_solver, force_ratio_type, new_force_ratio_solver, least_tolerance
   use rotation_drive, only: rotation_drive_type, new_rotation_drive
   use cell_polynomials, only: simd_width
   implicit none (type, external)
   private
   public :: cavitated_film_type, node_type, new_cavitated_film, axes

   !> Powers of 1 - T by which force and highest pressure end with the condition of Reynolds.
   integer, parameter :: force_power = 4, pressure_power = 3
   !> T above which a film is not solved any more, but its functions continue along their slopes over T.
   real(wp), parameter :: last_solved = 0.99_wp
   !> With Guembel's condition, whose force ends before T = 1 does, added to the ratio before its logarithm.
   real(wp), parameter :: gumbel_floor = 1e-2_wp
   !> Films that are remembered: of a state of all pads.
   integer, parameter :: memory = 24

   !> Both thicknesses, T, and t/w_1, which is 0 where the rotation does not act.
   integer, parameter :: axes = 4

   !> Functions: real and imaginary part of q, the logarithm of the pressure ratio over (1 - T)^3, and 0. Their values,
   !> and derivatives over the axes, (function, value or derivative).
   type :: node_type
      real(wp) :: data(simd_width, 1 + axes)
      !> Whether the film is open and was solved.
      logical :: ok = .false.
   end type node_type

   type :: cavitated_film_type
      type(dimensionless_pad_type) :: pad
      type(rotation_drive_type) :: drive
      type(force_ratio_solver), private :: ratios
      !> Where the rotation acts, as seen in a mirror.
      type(force_ratio_solver), allocatable, private :: mirrored
      real(wp), private :: floor = 0
      !> The films looked up last, one after the other, and where.
      type(node_type), allocatable, private :: remembered(:)
      real(wp), allocatable, private :: remembered_at(:, :)
      integer, private :: remember_next = 0
   contains
      procedure :: look_up
      procedure :: solve
      procedure :: set_ratio
   end type cavitated_film_type

contains

   !> The films of a pad with its drive, with the condition of Reynolds or (without a D) Guembel: forces to a
   !> tolerance, over themselves.
   function new_cavitated_film(pad, drive, gumbel, tolerance) result(films)
      type(dimensionless_pad_type), intent(in) :: pad
      type(rotation_drive_type), intent(in) :: drive
      logical, intent(in) :: gumbel
      real(wp), intent(in) :: tolerance
      type(cavitated_film_type) :: films
      films%pad = pad
      if (gumbel) films%floor = gumbel_floor
      films%drive = drive
      films%ratios = new_force_ratio_solver(pad, drive, gumbel, max(tolerance, least_tolerance))
      if (drive%acts) films%mirrored = new_force_ratio_solver(pad, new_rotation_drive(pad, drive%oil%mirrored()), &
         & gumbel, max(tolerance, least_tolerance))
   end function new_cavitated_film

   !> The functions of an open film with 0 < T < 1, with their derivatives if they are wanted; where w_1 < 0, seen in a
   !> mirror. `last` is the caller's memory of the place in a table, 0 at first. Here films are solved, unless they are
   !> among the last that were: a state is often evaluated again, for its derivatives.
   subroutine look_up(self, place, want_slopes, last, counters, node)
      class(cavitated_film_type), intent(inout) :: self
      real(wp), intent(in) :: place(axes)
      logical, intent(in) :: want_slopes
      integer, intent(inout) :: last
      type(film_counters), intent(inout) :: counters
      type(node_type), intent(out) :: node
      integer :: i
      if (.not. allocated(self%remembered)) then
         allocate (self%remembered(memory), self%remembered_at(axes, memory))
         self%remembered_at = huge(1.0_wp)
      end if
      do i = 1, size(self%remembered)
         if (any(abs(self%remembered_at(:, i) - place) > 0)) cycle
         node = self%remembered(i)
         return
      end do
      call self%solve(place, counters, node)
      self%remember_next = modulo(self%remember_next, size(self%remembered)) + 1
      self%remembered(self%remember_next) = node
      self%remembered_at(:, self%remember_next) = place
   end subroutine look_up

   !> The functions of a film.
   subroutine solve(self, place, counters, node)
      class(cavitated_film_type), intent(inout) :: self
      real(wp), intent(in) :: place(axes)
      type(film_counters), intent(inout) :: counters
      type(node_type), intent(out) :: node
      type(force_ratio_type) :: ratio
      complex(wp) :: part, slopes(3), over_t
      real(wp) :: at, room
      at = min(place(3), last_solved)
      room = 1 - at
      counters%nodes = counters%nodes + 1
      associate (edges => place(:2), w_2 => self%pad%tangent*(1 - 2*at), t => place(4))
         if (t < 0) then
            ! a mirror turns the rotation round
            ratio = self%mirrored%at(edges, w_2, t)
         else
            ratio = self%ratios%at(edges, w_2, t)
         end if
      end associate
      node%data = 0
      node%ok = ratio%ok
      if (.not. node%ok) return
      part = ratio%value/room**force_power + self%floor
      slopes = ratio%slopes/room**force_power/part
      slopes(3) = -2*self%pad%tangent*slopes(3) + force_power/room*(part - self%floor)/part
      associate (q => log(part) + (place(3) - at)*slopes(3))
         node%data(:2, 1) = [real(q), aimag(q)]
      end associate
      over_t = ratio%over_t/room**force_power/part
      node%data(1, 2:) = real([slopes, over_t])
      node%data(2, 2:) = aimag([slopes, over_t])
      node%data(3, 1) = log(ratio%pressure/room**pressure_power + self%floor)
   end subroutine solve

   !> The force of a film over that of the film that is just full, its derivatives over the axes, and the same ratio of
   !> the highest pressures (where the rotation acts that film has t = 0), from what `look_up` found at a T.
   pure subroutine set_ratio(self, t, node, force, force_slopes, pressure)
      class(cavitated_film_type), intent(in) :: self
      real(wp), intent(in) :: t
      type(node_type), intent(in) :: node
      complex(wp), intent(out) :: force, force_slopes(axes)
      real(wp), intent(out) :: pressure
      complex(wp) :: part
      associate (room => 1 - t, value => node%data(:, 1), slope => node%data(:, 2:))
         part = room**force_power*exp(cmplx(value(1), value(2), wp))
         force = part - self%floor*room**force_power
         force_slopes(:3) = part*cmplx(slope(1, :3), slope(2, :3), wp)
         force_slopes(4) = 0
         if (self%drive%acts) force_slopes(4) = part*cmplx(slope(1, 4), slope(2, 4), wp)
         force_slopes(3) = force_slopes(3) - force_power/room*force
         pressure = room**pressure_power*max(0.0_wp, exp(value(3)) - self%floor)
      end associate
   end subroutine set_ratio
end module cavitated_film
