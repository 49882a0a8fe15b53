!> Films as tables, built where the motion goes (docs/theory/film.md, *The table*).
!>
!> The full film comes from one table; where it cavitates, another adds what cavitation changes. Pads of the same shape
!> share their tables. Pads of wide arcs have tables of another kind. What no table has, films that nearly close and
!> those that may cavitate with different pressures around them, is left to the solver whose films are tabulated.
module table_film
   use kinds, only: wp, i8
   use film_solver, only: film_motion, film_law_type, film_response, film_ok, cavitation_gumbel, &
      & cavitation_reynolds
   use dimensionless_pad, only: dimensionless_pad_type, new_dimensionless_pad, unit_oil
   use rotation_drive, only: new_rotation_drive
   use pad_gap, only: pad_gap_type
   use direct_film, only: direct_film_type
   use full_film, only: new_full_film, new_full_film_table
   use cavitated_film, only: new_cavitated_film, new_cavitation_table
   use table_pad, only: table_pad_type, shape_tables, new_table_pad
   use wide_arc_table, only: wide_arc_table_type, wide_arc_pad_type, new_wide_arc_pad, new_wide_arc_table
   implicit none (type, external)
   private
   public :: table_film_type, new_table_film, has_tables

   !> The films of pads with half arcs above this, rad, do not follow from their thickness at the edges.
   real(wp), parameter :: largest_half_arc = 1.3_wp
   !> Those of wide arcs have tables with Guembel's condition from this half arc on, rad: there they never vanish.
   real(wp), parameter :: least_gumbel_half_arc = 3.05_wp
   !> Error of the full film over that of what cavitation changes.
   real(wp), parameter :: share_of_full = 0.3_wp

   !> Most cells of full films, and most cells and most nodes of cavitated ones, over all shapes: 0.3 GB. Cells of
   !> films that the rotation drives besides are three times as large.
   integer, parameter :: most_full = 16000, most_cavitated = 100000

   !> The table of one shape of wide arcs.
   type :: wide_shape
      class(wide_arc_table_type), allocatable :: table
   end type wide_shape

   type, extends(direct_film_type) :: table_film_type
      private
      type(table_pad_type), allocatable :: tabulated(:)
      !> Of pads of one shape whose law does not vary, and one for every pad with a law that does, which are the last.
      type(shape_tables), allocatable :: shapes(:)
      !> The same for pads of wide arcs.
      type(wide_arc_pad_type), allocatable :: wide_arcs(:)
      type(wide_shape), allocatable :: wide_shapes(:)
      !> Whether films come from tables, all of their cells are built, and pads are fixed; error of what cavitation
      !> changes and of full films, over the force.
      logical :: in_tables, filled = .false., fixed = .false.
      real(wp) :: tolerance, full_tolerance
   contains
      procedure :: solve
      procedure :: take_pressures
      procedure :: field_of_pad
   end type table_film_type

contains

   !> The films of a solver from tables; or the same solved at the motions themselves, which is quicker where motions
   !> are few, with exact derivatives. Errors over the force: of what cavitation changes, and of full films (left out: a
   !> share of the other). `filled`: every cell of the tables is built, whether that pays or not; `fixed`: the pads are.
   function new_table_film(direct, tabulated, tolerance, full_tolerance, filled, fixed) result(solver)
      type(direct_film_type), intent(in) :: direct
      logical, intent(in) :: tabulated
      real(wp), intent(in) :: tolerance
      real(wp), intent(in), optional :: full_tolerance
      logical, intent(in), optional :: filled, fixed
      type(table_film_type) :: solver
      integer :: i, k
      solver%direct_film_type = direct
      solver%in_tables = tabulated
      if (present(filled)) solver%filled = filled
      if (present(fixed)) solver%fixed = fixed
      solver%tolerance = tolerance
      solver%full_tolerance = share_of_full*tolerance
      if (present(full_tolerance)) solver%full_tolerance = full_tolerance
      allocate (solver%tabulated(size(direct%gaps)), solver%shapes(0))
      do i = 1, size(direct%gaps)
         associate (gap => direct%gaps(i), unit => new_dimensionless_pad(direct%gaps(i)), pad => solver%tabulated(i))
            pad = new_table_pad(gap, unit)
            if (.not. has_tables(gap)) cycle
            do k = 1, size(solver%shapes)
               if (same(solver%shapes(k)%pad, unit) .and. (solver%shapes(k)%supplied .eqv. abs(pad%rise) > 0)) exit
            end do
            if (k > size(solver%shapes)) solver%shapes = [solver%shapes, shape_tables(unit, supplied=abs(pad%rise) > 0)]
            pad%shape = k
         end associate
      end do
      do k = 1, size(solver%shapes)
         call set_tables(solver, unit_oil, solver%shapes(k))
      end do
      solver%shapes = [solver%shapes, [(shape_tables(), i=1, size(direct%gaps))]]
      call add_wide_arcs(solver)
   end function new_table_film

   !> The tables of pads of wide arcs: with the same pressure all around, and with the condition of Reynolds or, of the
   !> widest arcs, of Guembel.
   subroutine add_wide_arcs(self)
      type(table_film_type), intent(inout) :: self
      logical :: gumbel
      integer :: i, k, shapes
      gumbel = self%own_condition == cavitation_gumbel
      self%wide_arcs = [(new_wide_arc_pad(self%gaps(i)), i=1, size(self%gaps))]
      allocate (self%wide_shapes(size(self%gaps)))
      shapes = 0
      if (.not. (self%in_tables .and. (gumbel .or. self%own_condition == cavitation_reynolds))) return
      do i = 1, size(self%gaps)
         associate (pad => new_dimensionless_pad(self%gaps(i)))
            if (self%tabulated(i)%shape > 0 .or. .not. self%tabulated(i)%even_pressure) cycle
            if (gumbel .and. pad%half_arc < least_gumbel_half_arc) cycle
            do k = 1, shapes
               if (same(self%wide_shapes(k)%table%pad, pad)) exit
            end do
            if (k > shapes) allocate (self%wide_shapes(k)%table, source=new_wide_arc_table(pad, gumbel, &
               & self%tolerance, most_cavitated/size(self%gaps)))
            shapes = max(shapes, k)
            self%wide_arcs(i)%shape = k
         end associate
      end do
   end subroutine add_wide_arcs

   !> Empty tables of a shape for an oil, or the films that stand in.
   subroutine set_tables(self, oil, shape)
      type(table_film_type), intent(in) :: self
      class(film_law_type), intent(in) :: oil
      type(shape_tables), intent(inout) :: shape
      shape%numbers = oil%numbers()
      shape%drive = new_rotation_drive(shape%pad, oil)
      associate (pads => size(self%tabulated), gumbel => self%condition == cavitation_gumbel)
         if (self%in_tables) then
            shape%full = new_full_film_table(shape%pad, shape%drive, shape%supplied, self%full_tolerance, &
               & most_full/pads, self%filled)
            shape%cavitation = new_cavitation_table(shape%pad, shape%drive, gumbel, self%tolerance, &
               & most_cavitated/(pads*merge(3, 1, shape%drive%acts)), self%filled, self%fixed)
         else
            shape%full = new_full_film(shape%pad, shape%drive, shape%supplied, self%full_tolerance)
            shape%cavitation = new_cavitated_film(shape%pad, shape%drive, gumbel, self%tolerance)
         end if
      end associate
   end subroutine set_tables

   !> Which tables hold the films of a pad with a law; 0: none. One that varies stays what it is in a march: where its
   !> numbers are others than before, its tables begin anew.
   integer function tables_of(self, i, oil) result(k)
      class(table_film_type), intent(inout) :: self
      integer, intent(in) :: i
      class(film_law_type), intent(in) :: oil
      associate (pad => self%tabulated(i))
         k = pad%shape
         if (k == 0 .or. .not. oil%varies) return
         k = 0
         if (.not. self%in_tables .or. abs(pad%rise) > 0) return
         if (oil%slides_unevenly() .and. self%condition == cavitation_gumbel) return
         k = size(self%shapes) - size(self%tabulated) + i
         associate (shape => self%shapes(k))
            if (oil%has_numbers(shape%numbers)) return
            shape%pad = self%shapes(pad%shape)%pad
            call set_tables(self, oil, shape)
         end associate
      end associate
   end function tables_of

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

   subroutine solve(self, i, motion, oil, speed, want_derivatives, response)
      class(table_film_type), intent(inout) :: self
      integer, intent(in) :: i
      type(film_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: speed
      logical, intent(in) :: want_derivatives
      type(film_response), intent(inout) :: response
      integer(i8) :: solved
      integer :: k
      if (self%wide_arcs(i)%shape > 0) then
         call solve_wide_arc(self, i, motion, oil, speed, want_derivatives, response)
         return
      end if
      solved = self%counters%fourier
      k = tables_of(self, i, oil)
      if (k > 0) call self%tabulated(i)%look_up(self%shapes(k), motion, oil, speed, self%cavitates(), &
         & want_derivatives, self%counters, response)
      if (response%from_tables) then
         if (self%counters%fourier == solved) self%counters%looked_up = self%counters%looked_up + 1
      else
         response%lacks_pressures = .false.
         call self%direct_film_type%solve(i, motion, oil, speed, want_derivatives, response)
      end if
   end subroutine solve

   !> The same for a pad of a wide arc.
   subroutine solve_wide_arc(self, i, motion, oil, speed, want_derivatives, response)
      class(table_film_type), intent(inout) :: self
      integer, intent(in) :: i
      type(film_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: speed
      logical, intent(in) :: want_derivatives
      type(film_response), intent(inout) :: response
      associate (pad => self%wide_arcs(i), tables => self%wide_shapes(self%wide_arcs(i)%shape)%table)
         if (.not. oil%varies .and. self%condition == self%own_condition) call pad%look_up(tables, motion, oil, speed, &
            & want_derivatives, self%counters, response)
      end associate
      if (response%from_tables) then
         self%counters%looked_up = self%counters%looked_up + 1
      else
         call self%direct_film_type%solve(i, motion, oil, speed, want_derivatives, response)
      end if
   end subroutine solve_wide_arc

   !> The pressures of films from the tables.
   subroutine take_pressures(self, motion, oil, speed, response)
      class(table_film_type), intent(inout) :: self
      type(film_motion), intent(in) :: motion(:)
      class(film_law_type), intent(in) :: oil(:)
      real(wp), intent(in) :: speed
      type(film_response), intent(inout) :: response(:)
      integer :: i, k
      do i = 1, size(motion)
         if (.not. response(i)%lacks_pressures .or. response(i)%status /= film_ok) cycle
         k = self%wide_arcs(i)%shape
         if (k > 0) then
            call self%wide_arcs(i)%look_up_pressures(self%wide_shapes(k)%table, motion(i), oil(i), speed, &
               & self%counters, response(i))
         else
            k = tables_of(self, i, oil(i))
            call self%tabulated(i)%look_up_pressures(self%shapes(k), motion(i), oil(i), speed, self%cavitates(), &
               & self%counters, response(i))
         end if
         if (.not. response(i)%from_tables) call self%direct_film_type%solve(i, motion(i), oil(i), speed, .false., &
            & response(i))
      end do
   end subroutine take_pressures

   !> Fields are solved.
   subroutine field_of_pad(self, i, motion, oil, speed, phi, z, pressure)
      class(table_film_type), intent(inout) :: self
      integer, intent(in) :: i
      type(film_motion), intent(in) :: motion
      class(film_law_type), intent(in) :: oil
      real(wp), intent(in) :: speed, phi(:), z(:)
      real(wp), intent(out) :: pressure(:, :)
      associate (pad => self%tabulated(i))
         call self%rebuild(i, max(pad%shape, self%wide_arcs(i)%shape) > 0 .and. pad%even_pressure, motion, oil, speed, &
            & phi, z, pressure)
      end associate
   end subroutine field_of_pad
end module table_film
