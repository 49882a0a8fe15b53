!> What every film solver takes and answers. A solver holds all pads of a bearing, so that one
!> call serves one right-hand side and a solver may work on several pads side by side.
module film_solver
   use kinds, only: wp, i8
   implicit none (type, external)
   private
   public :: film_solver_type, film_motion, film_oil, film_response, film_counters
   public :: film_ok, film_closed, film_not_converged

   !> Motion of the journal seen from a pad; with the speed and the oil, all that the film force depends on.
   type :: film_motion
      !> (e_y', e_z'), m, and its rate, m/s, in the pad frame.
      real(wp) :: position(2) = 0, velocity(2) = 0
   end type film_motion

   !> The oil in a pad's film.
   type :: film_oil
      !> Dynamic viscosity, Pa s.
      real(wp) :: viscosity = 0
   end type film_oil

   integer, parameter :: film_ok = 0, film_closed = 1, film_not_converged = 2

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
      real(wp) :: residual = 0
      integer :: max_sweeps = 0
   end type film_response

   !> Work done since the solver was made.
   type :: film_counters
      !> Pads evaluated by axial modes and on finite volumes; passes over these volumes: sweeps of over-relaxation,
      !> or eliminations.
      integer(i8) :: fourier = 0, volumes = 0, passes = 0
      !> Pads looked up in tables; cells and nodes of cavitated films that were built for them, and the wall time, s.
      integer(i8) :: looked_up = 0, cells = 0, nodes = 0
      real(wp) :: building = 0
      !> Wall time, s, where the solver's user takes it; without that of building tables.
      real(wp) :: seconds = 0
   end type film_counters

   type, abstract :: film_solver_type
      type(film_counters) :: counters
   contains
      procedure(evaluate_film), deferred :: evaluate
      procedure(evaluate_field), deferred :: field
      procedure(can_cavitation), deferred :: cavitates
      procedure(choose_cavitation), deferred :: set_cavitation
      procedure :: forget
      procedure :: take_pressures
   end type film_solver_type

   abstract interface
      !> The film of every pad at a motion and with an oil each, and a journal speed, rad/s; the answers of pads that
      !> are not chosen stay what they are.
      subroutine evaluate_film(self, motion, oil, speed, want_derivatives, response, chosen)
         import :: film_solver_type, film_motion, film_oil, film_response, wp
         class(film_solver_type), intent(inout) :: self
         type(film_motion), intent(in) :: motion(:)
         type(film_oil), intent(in) :: oil(:)
         real(wp), intent(in) :: speed
         logical, intent(in) :: want_derivatives
         type(film_response), intent(inout) :: response(:)
         !> Left out: all.
         logical, intent(in), optional :: chosen(:)
      end subroutine evaluate_film

      !> True where pressures below the cavitation pressure are not kept.
      pure logical function can_cavitation(self)
         import :: film_solver_type
         class(film_solver_type), intent(in) :: self
      end function can_cavitation

      !> Lets films cavitate as the solver was made to, or keeps them whole.
      pure subroutine choose_cavitation(self, allowed)
         import :: film_solver_type
         class(film_solver_type), intent(inout) :: self
         logical, intent(in) :: allowed
      end subroutine choose_cavitation

      !> Pressure of every pad's film, Pa, (axial position, angle, pad), at a motion each that leaves the film open,
      !> and a journal speed, rad/s.
      subroutine evaluate_field(self, motion, oil, speed, phi, z, pressure)
         import :: film_solver_type, film_motion, film_oil, wp
         class(film_solver_type), intent(inout) :: self
         type(film_motion), intent(in) :: motion(:)
         type(film_oil), intent(in) :: oil(:)
         !> Angles from the pivot of a pad, rad, (angle, pad), and distances from the middle plane, m, on the pads.
         real(wp), intent(in) :: speed, phi(:, :), z(:)
         real(wp), intent(out) :: pressure(:, :, :)
      end subroutine evaluate_field
   end interface

contains

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
      type(film_oil), intent(in) :: oil(:)
      real(wp), intent(in) :: speed
      type(film_response), intent(inout) :: response(:)
   end subroutine take_pressures
end module film_solver
