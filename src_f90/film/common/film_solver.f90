!> What every film solver takes and answers. A solver holds all pads of a bearing, so that one call serves one
!> right-hand side.
module film_solver
   use kinds, only: wp, i8
   use pad_gap, only: pad_gap_type, pad_directions, film_motion
   use film_law, only: film_law_type
   use film_oils, only: film_oil
   implicit none (type, external)
   private
   public :: film_solver_type, film_motion, film_law_type, film_oil, film_response, film_counters
   public :: film_ok, film_closed, film_not_converged, film_not_resolved
   public :: cavitation_none, cavitation_gumbel, cavitation_reynolds, thinnest

   integer, parameter :: film_ok = 0, film_closed = 1, film_not_converged = 2, film_not_resolved = 3
   !> Film cavitation: none; pressures below p_cav dropped after the solution; projected in the solution.
   integer, parameter :: cavitation_none = 0, cavitation_gumbel = 1, cavitation_reynolds = 2
   !> Films thinner than this, over the clearance, count as closed: rounding would decide, far below an atom's size.
   real(wp), parameter :: thinnest = 1e-9_wp

   !> What a solver answers for one pad.
   type :: film_response
      integer :: status = film_ok
      !> Force on the journal in the pad frame (F_y', F_z'), N, eq (6).
      real(wp) :: force(2) = 0
      !> d force / d (position, velocity), N/m and N s/m; set on request.
      real(wp) :: derivatives(2, 4) = 0
      !> Minimum and maximum pressure, Pa (a solver may leave them to `take_pressures`); minimum film thickness, m.
      real(wp) :: min_pressure = 0, max_pressure = 0, min_film_thickness = 0
      !> Relative residual of an iterative solution, and the SOR sweeps after which it is given up; 0 for a direct one.
      !> Of a film that is not resolved its error.
      real(wp) :: residual = 0
      integer :: max_sweeps = 0
      !> Whether the force came from tables; whether its pressures are left to `take_pressures`.
      logical :: from_tables = .false., lacks_pressures = .false.
   end type film_response

   !> Work done since the solver was made.
   type :: film_counters
      !> Pads evaluated by axial modes and on finite volumes; passes over these volumes: sweeps of over-relaxation,
      !> or eliminations.
      integer(i8) :: fourier = 0, volumes = 0, passes = 0
      !> Pads with slopes evaluated by weighted functions.
      integer(i8) :: weighted = 0
      !> Pads looked up in tables; cells, nodes of cavitated films and profiles of the pressure that were built for
      !> them, and the wall time, s.
      integer(i8) :: looked_up = 0, cells = 0, nodes = 0, profiles = 0
      real(wp) :: building = 0
      !> Wall time, s, where the solver's user takes it; without that of building tables.
      real(wp) :: seconds = 0
   end type film_counters

   type, abstract :: film_solver_type
      type(film_counters) :: counters
      type(pad_gap_type), allocatable :: gaps(:)
      type(pad_directions), allocatable :: directions(:)
      !> Condition of cavitation: that of the solver, as it was made; the one in force.
      integer :: own_condition = cavitation_none, condition = cavitation_none
   contains
      procedure :: set_gaps
      procedure :: evaluate
      procedure :: evaluate_pad
      procedure :: field
      procedure :: cavitates
      procedure :: set_cavitation
      procedure :: forget
      procedure :: take_pressures
      procedure(solve_film), deferred :: solve
      procedure(evaluate_field), deferred :: field_of_pad
   end type film_solver_type

   abstract interface
      !> An open film of a pad: what `evaluate` leaves to the solver.
      subroutine solve_film(self, i, motion, oil, speed, want_derivatives, response)
         import :: film_solver_type, film_motion, film_law_type, film_response, wp
         class(film_solver_type), intent(inout) :: self
         integer, intent(in) :: i
         type(film_motion), intent(in) :: motion
         class(film_law_type), intent(in) :: oil
         real(wp), intent(in) :: speed
         logical, intent(in) :: want_derivatives
         !> Its minimum thickness is set.
         type(film_response), intent(inout) :: response
      end subroutine solve_film

      !> Pressure of a pad's film, Pa, (axial position, angle), at a motion that leaves the film open, and a journal
      !> speed, rad/s.
      subroutine evaluate_field(self, i, motion, oil, speed, phi, z, pressure)
         import :: film_solver_type, film_motion, film_law_type, wp
         class(film_solver_type), intent(inout) :: self
         integer, intent(in) :: i
         type(film_motion), intent(in) :: motion
         class(film_law_type), intent(in) :: oil
         !> Angles from the pivot, rad, and distances from the middle plane, m, on the pad.
         real(wp), intent(in) :: speed, phi(:), z(:)
         real(wp), intent(out) :: pressure(:, :)
      end subroutine evaluate_field
   end interface

contains

   !> Gives the solver its pads and their condition of cavitation.
   pure subroutine set_gaps(self, gaps, condition)
      class(film_solver_type), intent(inout) :: self
      type(pad_gap_type), intent(in) :: gaps(:)
      integer, intent(in) :: condition
      self%gaps = gaps
      self%directions = gaps%directions()
      self%own_condition = condition
      self%condition = condition
   end subroutine set_gaps

   !> The film of every pad at a motion and with an oil each, and a journal speed, rad/s; the answers of pads that
   !> are not chosen stay what they are.
   subroutine evaluate(self, motion, oil, speed, want_derivatives, response, chosen)
      class(film_solver_type), intent(inout) :: self
      type(film_motion), intent(in) :: motion(:)
      class(film_law_type), intent(in) :: oil(:)
      real(wp), intent(in) :: speed
      logical, intent(in) :: want_derivatives
      type(film_response), intent(inout) :: response(:)
      !> Left out: all.
      logical, intent(in), optional :: chosen(:)
      integer :: i
      do i = 1, size(motion)
         if (present(chosen)) then
            if (.not. chosen(i)) cycle
         end if
         call self%evaluate_pad(i, motion(i), oil(i), speed, want_derivatives, response(i))
      end do
   end subroutine evaluate

   !> The film of one pad. Solvers that tabulate or add to others call it within.
   recursive subroutine evaluate_pad(self, i, motion, oil, speed, want_derivatives, response)
      class(film_solver_type), intent(inout) :: self
      integer, intent(in) :: i
      type(film_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: speed
      logical, intent(in) :: want_derivatives
      type(film_response), intent(out) :: response
      associate (gap => self%gaps(i))
         response%min_film_thickness = gap%min_film_thickness(motion, self%directions(i))
         if (response%min_film_thickness > thinnest*gap%machined_clearance) then
            call self%solve(i, motion, oil, speed, want_derivatives, response)
         else
            response%status = film_closed
         end if
      end associate
   end subroutine evaluate_pad

   !> Pressure of every pad's film, Pa, (axial position, angle, pad), as `field_of_pad`, at angles (angle, pad) and
   !> axial positions (axial position, pad).
   subroutine field(self, motion, oil, speed, phi, z, pressure)
      class(film_solver_type), intent(inout) :: self
      type(film_motion), intent(in) :: motion(:)
      class(film_law_type), intent(in) :: oil(:)
      real(wp), intent(in) :: speed, phi(:, :), z(:, :)
      real(wp), intent(out) :: pressure(:, :, :)
      integer :: i
      do i = 1, size(motion)
         call self%field_of_pad(i, motion(i), oil(i), speed, phi(:, i), z(:, i), pressure(:, :, i))
      end do
   end subroutine field

   !> True where pressures below the cavitation pressure are not kept.
   pure logical function cavitates(self)
      class(film_solver_type), intent(in) :: self
      cavitates = self%condition /= cavitation_none
   end function cavitates

   !> Lets films cavitate as the solver was made to, or keeps them whole.
   pure subroutine set_cavitation(self, allowed)
      class(film_solver_type), intent(inout) :: self
      logical, intent(in) :: allowed
      self%condition = merge(self%own_condition, cavitation_none, allowed)
   end subroutine set_cavitation

   !> Forgets the films that were solved last, from which the next ones would start: what is solved then is the same to
   !> the last bit, wherever one comes from.
   pure subroutine forget(self)
      class(film_solver_type), intent(inout) :: self
   end subroutine forget

   !> Sets minimum and maximum pressure in the answers of the last evaluation, at the same motions, oil and speed, where
   !> `evaluate` has left them out.
   subroutine take_pressures(self, motion, oil, speed, response)
      class(film_solver_type), intent(inout) :: self
      type(film_motion), intent(in) :: motion(:)
      class(film_law_type), intent(in) :: oil(:)
      real(wp), intent(in) :: speed
      type(film_response), intent(inout) :: response(:)
   end subroutine take_pressures
end module film_solver
