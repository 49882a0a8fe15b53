!> Films as tables, built where the motion goes (docs/theory/film.md, *The table*).
!>
!> The full film comes from one table; where it cavitates, another adds what cavitation changes. Pads of the same shape
!> share their tables. What no table has, films that nearly close and those that may cavitate with different pressures
!> around them, is left to the solver whose films are tabulated.
module table_film
   use kinds, only: wp
   use film_solver, only: film_solver_type, film_motion, film_oil, film_response, film_counters, film_closed
   use pad_gap, only: pad_gap_type
   use direct_film, only: direct_film_type
   use dimensionless_pad, only: dimensionless_pad_type, new_dimensionless_pad
   use full_film, only: new_solved_full_film
   use cavitated_film, only: new_solved_cavitated_film
   use full_film_table, only: new_full_film_table
   use cavitation_table, only: new_cavitation_table
   use table_pad, only: table_pad_type, shape_tables, new_table_pad
   implicit none (type, external)
   private
   public :: table_film_type, new_table_film, new_converged_film, has_tables

   !> Pads with half arcs above this, rad, have no table: their film does not follow from its thickness at the edges.
   real(wp), parameter :: largest_half_arc = 1.3_wp
   !> Error of the full film over that of what cavitation changes.
   real(wp), parameter :: share_of_whole = 0.1_wp

   !> Most cells of full films, and most cells and most nodes of cavitated ones, over all shapes: 0.3 GB.
   integer, parameter :: most_whole = 16000, most_cavitated = 100000

   type, extends(film_solver_type) :: table_film_type
      private
      type(table_pad_type), allocatable :: pads(:)
      type(shape_tables), allocatable :: shapes(:)
      !> Of every pad the solver for what is in no table.
      type(direct_film_type), allocatable :: single(:)
      !> Whether the solver was made for films that cavitate, and whether they may.
      logical :: made_to_cavitation, may_cavitation
   contains
      procedure :: cavitates
      procedure :: set_cavitation
      procedure :: forget
      procedure :: evaluate
      procedure :: take_pressures
      procedure :: field
      procedure, private :: count_work
   end type table_film_type

contains

   !> Tables for the films in these gaps, that cavitate by Guembel's condition, by that of Reynolds or not at all, with
   !> errors of this tolerance over the force.
   function new_table_film(gaps, single, cavitates, gumbel, tolerance) result(solver)
      type(pad_gap_type), intent(in) :: gaps(:)
      !> Of every pad the solver for what is in no table.
      type(direct_film_type), intent(in) :: single(:)
      logical, intent(in) :: cavitates, gumbel
      real(wp), intent(in) :: tolerance
      type(table_film_type) :: solver
      integer :: k
      solver = sorted_by_shape(gaps, single, cavitates)
      do k = 1, size(solver%shapes)
         associate (shape => solver%shapes(k))
            shape%whole = new_full_film_table(shape%pad, shape%supplied, share_of_whole*tolerance, &
               & most_whole/size(gaps))
            shape%cavitation = new_cavitation_table(shape%pad, gumbel, tolerance, most_cavitated/size(gaps))
         end associate
      end do
   end function new_table_film

   !> The same films, solved at the motions themselves: quicker where motions are few, with exact derivatives. Errors of
   !> what cavitation changes and of full films are these.
   function new_converged_film(gaps, single, cavitates, gumbel, tolerance, full_tolerance) result(solver)
      type(pad_gap_type), intent(in) :: gaps(:)
      type(direct_film_type), intent(in) :: single(:)
      logical, intent(in) :: cavitates, gumbel
      real(wp), intent(in) :: tolerance
      real(wp), intent(in), optional :: full_tolerance
      type(table_film_type) :: solver
      real(wp) :: of_full
      integer :: k
      of_full = share_of_whole*tolerance
      if (present(full_tolerance)) of_full = full_tolerance
      solver = sorted_by_shape(gaps, single, cavitates)
      do k = 1, size(solver%shapes)
         associate (shape => solver%shapes(k))
            shape%whole = new_solved_full_film(shape%pad, of_full)
            shape%cavitation = new_solved_cavitated_film(shape%pad, gumbel, tolerance)
         end associate
      end do
   end function new_converged_film

   !> The pads with the shapes that they share.
   function sorted_by_shape(gaps, single, cavitates) result(solver)
      type(pad_gap_type), intent(in) :: gaps(:)
      type(direct_film_type), intent(in) :: single(:)
      logical, intent(in) :: cavitates
      type(table_film_type) :: solver
      type(dimensionless_pad_type) :: pads(size(gaps))
      logical :: supplied(size(gaps))
      integer :: i, k, n
      solver%single = single
      solver%made_to_cavitation = cavitates
      solver%may_cavitation = cavitates
      allocate (solver%pads(size(gaps)))
      n = 0
      do i = 1, size(gaps)
         associate (gap => gaps(i), unit => new_dimensionless_pad(gaps(i)))
            solver%pads(i) = new_table_pad(gap, unit)
            if (.not. has_tables(gap)) cycle
            do k = 1, n
               if (same(pads(k), unit) .and. (supplied(k) .eqv. abs(solver%pads(i)%rise) > 0)) exit
            end do
            if (k > n) then
               n = k
               pads(k) = unit
               supplied(k) = abs(solver%pads(i)%rise) > 0
            end if
            solver%pads(i)%shape = k
         end associate
      end do
      allocate (solver%shapes(n))
      do k = 1, n
         solver%shapes(k)%pad = pads(k)
         solver%shapes(k)%supplied = supplied(k)
      end do
   end function sorted_by_shape

   !> True where the thickness at the edges describes the film in a gap.
   elemental logical function has_tables(gap)
      type(pad_gap_type), intent(in) :: gap
      has_tables = 0.5_wp*gap%arc() <= largest_half_arc
   end function has_tables

   !> True where two pads have the same shape.
   pure logical function same(a, b)
      type(dimensionless_pad_type), intent(in) :: a, b
      same = .not. (abs(a%half_arc - b%half_arc) > 0 .or. abs(a%length - b%length) > 0)
   end function same

   pure logical function cavitates(self)
      class(table_film_type), intent(in) :: self
      cavitates = self%may_cavitation
   end function cavitates

   pure subroutine set_cavitation(self, allowed)
      class(table_film_type), intent(inout) :: self
      logical, intent(in) :: allowed
      integer :: i
      self%may_cavitation = allowed .and. self%made_to_cavitation
      do i = 1, size(self%single)
         call self%single(i)%set_cavitation(allowed)
      end do
   end subroutine set_cavitation

   pure subroutine forget(self)
      class(table_film_type), intent(inout) :: self
      integer :: i
      do i = 1, size(self%single)
         call self%single(i)%forget()
      end do
   end subroutine forget

   subroutine evaluate(self, motion, oil, speed, want_derivatives, response, chosen)
      class(table_film_type), intent(inout) :: self
      type(film_motion), intent(in) :: motion(:)
      type(film_oil), intent(in) :: oil(:)
      real(wp), intent(in) :: speed
      logical, intent(in) :: want_derivatives
      type(film_response), intent(inout) :: response(:)
      logical, intent(in), optional :: chosen(:)
      integer :: i
      do i = 1, size(motion)
         if (present(chosen)) then
            if (.not. chosen(i)) cycle
         end if
         response(i) = film_response()
         associate (pad => self%pads(i))
            response(i)%min_film_thickness = pad%gap%min_film_thickness(motion(i), pad%directions)
            pad%found = .false.
            if (.not. response(i)%min_film_thickness > 0) then
               response(i)%status = film_closed
               cycle
            end if
            if (pad%shape > 0) call pad%look_up(self%shapes(pad%shape), motion(i), oil(i), &
               & speed, self%may_cavitation, want_derivatives, response(i))
            if (pad%found) then
               self%counters%looked_up = self%counters%looked_up + 1
            else
               call self%single(i)%evaluate(motion(i:i), oil(i:i), speed, want_derivatives, response(i:i))
            end if
         end associate
      end do
      call self%count_work()
   end subroutine evaluate

   !> What solvers and tables have done.
   subroutine count_work(self)
      class(table_film_type), intent(inout) :: self
      integer :: i
      associate (counters => self%counters, shapes => self%shapes)
         if (any(.not. self%pads%found)) then
            do i = 1, size(self%pads)
               associate (more => self%single(i)%counters)
                  counters%fourier = counters%fourier + more%fourier
                  counters%volumes = counters%volumes + more%volumes
                  counters%passes = counters%passes + more%passes
                  more = film_counters()
               end associate
            end do
         end if
         counters%cells = 0
         counters%nodes = 0
         counters%building = 0
         do i = 1, size(shapes)
            counters%cells = counters%cells + shapes(i)%whole%built + shapes(i)%cavitation%built_cells
            counters%nodes = counters%nodes + shapes(i)%cavitation%built_nodes
            counters%building = counters%building + shapes(i)%whole%seconds + shapes(i)%cavitation%seconds
         end do
      end associate
   end subroutine count_work

   !> The pressures of films from the tables.
   subroutine take_pressures(self, motion, oil, speed, response)
      class(table_film_type), intent(inout) :: self
      type(film_motion), intent(in) :: motion(:)
      type(film_oil), intent(in) :: oil(:)
      real(wp), intent(in) :: speed
      type(film_response), intent(inout) :: response(:)
      integer :: i
      do i = 1, size(motion)
         if (self%pads(i)%found) call self%pads(i)%look_up_pressures(self%shapes(self%pads(i)%shape), motion(i), &
            & oil(i), speed, self%may_cavitation, response(i))
      end do
   end subroutine take_pressures

   !> Fields are solved.
   subroutine field(self, motion, oil, speed, phi, z, pressure)
      class(table_film_type), intent(inout) :: self
      type(film_motion), intent(in) :: motion(:)
      type(film_oil), intent(in) :: oil(:)
      real(wp), intent(in) :: speed, phi(:, :), z(:)
      real(wp), intent(out) :: pressure(:, :, :)
      integer :: i
      do i = 1, size(motion)
         if (self%pads(i)%shape > 0 .and. self%pads(i)%even_pressure) then
            call self%single(i)%fine_field(motion(i:i), oil(i:i), speed, phi(:, i:i), z, pressure(:, :, i:i))
         else
            call self%single(i)%field(motion(i:i), oil(i:i), speed, phi(:, i:i), z, pressure(:, :, i:i))
         end if
      end do
   end subroutine field
end module table_film
