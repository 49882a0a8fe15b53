!> How far the films of a model are from the same films solved closely, whatever solver it takes: by axial modes and,
!> where they cavitate, by volumes of a film-adapted grid, extrapolated (the converged films of the factories).
!> How good this reference is tells a coarse one: with ten times the error, or, where no table knows the film, on
!> uniform volumes.
module film_comparison
   use kinds, only: wp, degree
   use case_inputs, only: case_type
   use factories, only: converged_films, usual_arc
   use tilting_pad_bearing, only: pad_sample
   use equations_of_motion, only: machine_model, new_machine_model
   implicit none (type, external)
   private
   public :: film_comparison_type, film_difference, new_film_comparison

   !> Error of cavitated films of the reference, and of the coarse reference (film%table_tolerance).
   real(wp), parameter :: reference_error = 1e-6_wp, coarse_error = 1e-5_wp
   !> Uniform volumes, along an arc up to this, rad, and along half the width, for the second solution of films that
   !> have no tables: those of wide arcs, and of supply pressures where they may cavitate. Four times those of a march.
   integer, parameter :: film_adapted(2) = 0, uniform(2) = [320, 32]
   !> What a pad carries counts as this share of its weight at least: below, the weight, whose moment about the pivot
   !> is at least that of the tilt (some 1e-3 rad), moves the pad, not the film. Without weight: of the load.
   real(wp), parameter :: least_share = 1e-3_wp

   !> One film, and the same solved closely.
   type :: film_difference
      !> What the pad carries, N: force of its film, solved closely, and of asperities, or the least that counts.
      real(wp) :: carried = 0
      !> Difference of the film force, N, and an estimate of the error that is left in the closely solved one: its
      !> difference from the second solution.
      real(wp) :: force = 0, left = 0
      !> Highest pressure, solved closely, and the difference from it, Pa.
      real(wp) :: highest_pressure = 0, pressure = 0
      !> Why there is no difference, as a film could not be solved; empty where there is one.
      character(len=:), allocatable :: refusal
   end type film_difference

   type :: film_comparison_type
      private
      type(machine_model) :: reference, coarse_reference
      !> Of each pad the least force that counts as carried, N.
      real(wp), allocatable :: least(:)
   contains
      procedure :: compare
   end type film_comparison_type

contains

   !> For the films of a model.
   function new_film_comparison(model) result(comparison)
      type(machine_model), intent(in) :: model
      type(film_comparison_type) :: comparison
      real(wp), allocatable :: loads(:, :)
      integer :: b
      comparison%reference = new_machine_model(with_films(model%inputs, reference_error, film_adapted), &
         & converged_films, rotor=model%rotor)
      comparison%coarse_reference = new_machine_model(with_films(model%inputs, coarse_error, uniform), &
         & converged_films, rotor=model%rotor)
      associate (reference => comparison%reference)
         loads = reference%rotor%loads(reference%point)
         allocate (comparison%least(0))
         do b = 1, size(reference%bearings)
            associate (weight => reference%bearings(b)%pads%weight)
               comparison%least = [comparison%least, least_share*merge(weight, norm2(loads(:, b)), weight > 0)]
            end associate
         end do
      end associate
   end function new_film_comparison

   !> The case with films of this error and on these volumes.
   pure function with_films(inputs, tolerance, volumes) result(changed)
      type(case_type), intent(in) :: inputs
      real(wp), intent(in) :: tolerance
      integer, intent(in) :: volumes(2)
      type(case_type) :: changed
      integer :: b
      changed = inputs
      do b = 1, size(changed%bearings)
         associate (film => changed%bearings(b)%film, longest => maxval(changed%bearings(b)%pads%arc_deg)*degree)
            film%solver = 'auto'
            film%table_tolerance = tolerance
            film%circumferential_cells = volumes(1)*max(1, nint(longest/usual_arc))
            film%axial_cells = volumes(2)
            film%axial_modes = 0
         end associate
      end do
   end function with_films

   !> Compares the films of a model, of each pad, in the state y at time t, s.
   subroutine compare(self, model, t, y, found)
      class(film_comparison_type), intent(inout) :: self
      type(machine_model), intent(inout) :: model
      real(wp), intent(in) :: t, y(:)
      type(film_difference), intent(out) :: found(:)
      type(pad_sample), dimension(size(found)) :: own, reference, coarse_reference
      integer :: i
      call adapt(self%reference, model)
      call adapt(self%coarse_reference, model)
      found = film_difference(refusal='')
      call take_films(model, t, y, own, found)
      call take_films(self%reference, t, y, reference, found)
      call take_films(self%coarse_reference, t, y, coarse_reference, found)
      do i = 1, size(found)
         if (found(i)%refusal /= '') cycle
         associate (f => reference(i)%film_force)
            found(i)%carried = max(norm2(f) + reference(i)%asperity_force, self%least(i))
            found(i)%force = norm2(own(i)%film_force - f)
            found(i)%left = norm2(coarse_reference(i)%film_force - f)
            found(i)%highest_pressure = reference(i)%max_pressure
            found(i)%pressure = abs(own(i)%max_pressure - reference(i)%max_pressure)
         end associate
         ! where nothing is carried and nothing weighs
         if (.not. found(i)%carried > 0) found(i)%carried = max(found(i)%force, tiny(1.0_wp))
      end do
   end subroutine compare

   !> Gives a model the operating point and the oil of another.
   subroutine adapt(model, other)
      type(machine_model), intent(inout) :: model
      type(machine_model), intent(in) :: other
      call model%set_point(other%point)
      model%oil = other%oil
      model%oil_history = other%oil_history
   end subroutine adapt

   !> The films of all pads, each on its own: one that cannot be solved leaves the others.
   subroutine take_films(model, t, y, films, found)
      type(machine_model), intent(inout) :: model
      real(wp), intent(in) :: t, y(:)
      type(pad_sample), intent(out) :: films(:)
      type(film_difference), intent(inout) :: found(:)
      logical :: chosen(size(found)), ok
      integer :: i, b
      do i = 1, size(found)
         if (found(i)%refusal /= '') cycle
         chosen = .false.
         chosen(i) = .true.
         call model%evaluate(t, y, .false., ok, chosen)
         if (.not. ok) found(i)%refusal = model%refusal
      end do
      films = [(model%bearings(b)%sampled(), b=1, size(model%bearings))]
   end subroutine take_films
end module film_comparison
