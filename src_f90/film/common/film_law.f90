!> The law of a pad's film: how easily a pressure drives the oil along and across, what sliding carries with it, and
!> what it costs (docs/theory/film.md, *The law of a film*).
!>
!> With mu the law's viscosity, x with the journal's surface and U its speed,
!>    (h^3 E p_x)_x + h^3 K E p_zz = 6 mu U (G h)_x + 12 mu h_t,
!> and sliding resists by S mu U/h. The mobility E along the film, the mobility K across over that along, and S are
!> functions of the place on the arc and of the film thickness, G of the place. All are 1 in oil of one viscosity, of
!> which solvers ask nothing; others they ask once an evaluation, for all of their nodes.
module film_law
   use kinds, only: wp
   use pad_gap, only: pad_gap_type, film_motion
   implicit none (type, external)
   private
   public :: film_law_type, law_at_nodes, most_numbers

   !> Numbers of a law.
   integer, parameter :: most_numbers = 24

   type, abstract :: film_law_type
      !> Dynamic viscosity, Pa s, to which forces and shear are proportional.
      real(wp) :: viscosity = 0
      !> False where E, G, K and S are 1 everywhere.
      logical :: varies = .false.
   contains
      procedure(answer_nodes), deferred :: at_nodes
      procedure(answer_shear), deferred :: shear_weight
      procedure(answer_numbers), deferred :: numbers
      procedure(answer_mirrored), deferred :: mirrored
      procedure :: turns_with_thickness
      procedure :: slides_unevenly
      procedure :: has_numbers
   end type film_law_type

   !> A law at nodes along the arc. Slopes are derivatives over the angle as one goes along the film, 1/rad and its
   !> powers, (node, order).
   type :: law_at_nodes
      !> 1/sqrt(E); G.
      real(wp), allocatable :: inverse_root(:), sliding(:)
      !> Slopes of ln E and of G.
      real(wp), allocatable :: flow_slopes(:, :), sliding_slopes(:, :)
      !> Where E and K turn with the thickness, else not allocated: K, and the slope of ln K; d ln E/d ln h and d ln K/d
      !> ln h, and slopes of these, (node, order from 0).
      real(wp), allocatable :: across(:), across_slope(:), flow_power(:, :), across_power(:, :)
   end type law_at_nodes

   abstract interface
      !> The law at nodes whose angles from the pivot have these sines and cosines, as many as there were before.
      pure subroutine answer_nodes(self, gap, motion, sine, cosine, nodes)
         import :: film_law_type, pad_gap_type, film_motion, law_at_nodes, wp
         class(film_law_type), intent(in) :: self
         type(pad_gap_type), intent(in) :: gap
         type(film_motion), intent(in) :: motion
         real(wp), intent(in) :: sine(:), cosine(:)
         type(law_at_nodes), intent(inout) :: nodes
      end subroutine answer_nodes

      !> S at an angle from the pivot, rad.
      elemental real(wp) function answer_shear(self, gap, motion, phi)
         import :: film_law_type, pad_gap_type, film_motion, wp
         class(film_law_type), intent(in) :: self
         type(pad_gap_type), intent(in) :: gap
         type(film_motion), intent(in) :: motion
         real(wp), intent(in) :: phi
      end function answer_shear

      !> All numbers but the viscosity by which E, G, K and S, over the place and over h in pad clearances, are those of
      !> one law and not of another, the rest 0; all are 0 where it does not vary, and only there. A table holds for one
      !> set of them.
      pure function answer_numbers(self) result(numbers)
         import :: film_law_type, wp, most_numbers
         class(film_law_type), intent(in) :: self
         real(wp) :: numbers(most_numbers)
      end function answer_numbers

      !> The law seen in a mirror, in which both edges change places.
      function answer_mirrored(self) result(mirrored)
         import :: film_law_type
         class(film_law_type), intent(in) :: self
         class(film_law_type), allocatable :: mirrored
      end function answer_mirrored
   end interface

contains

   !> Whether E, K and S depend on the film thickness.
   pure logical function turns_with_thickness(self)
      class(film_law_type), intent(in) :: self
      turns_with_thickness = .false.
   end function turns_with_thickness

   !> Whether G is another than 1, so that wedge and squeeze are no longer one velocity.
   pure logical function slides_unevenly(self)
      class(film_law_type), intent(in) :: self
      slides_unevenly = self%varies
   end function slides_unevenly

   !> Whether its numbers are these.
   pure logical function has_numbers(self, numbers)
      class(film_law_type), intent(in) :: self
      real(wp), intent(in) :: numbers(most_numbers)
      has_numbers = .not. any(abs(self%numbers() - numbers) > 0)
   end function has_numbers
end module film_law
