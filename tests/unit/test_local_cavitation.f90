!> What the cavitation of a few cells adds to the force, against the same finite volumes relaxed cell by cell.
program test_local_cavitation
   use kinds, only: wp
   use text, only: to_text
   use film_solver, only: film_motion
   use film_grid, only: film_grid_type, new_film_grid
   use volume_equations, only: grid_modes_type, new_grid_modes
   use local_cavitation, only: force_of_few
   use paper_bearing, only: paper_oil, paper_pad, speed, clearance
   use check, only: runs, expect, expect_close, between, report
   implicit none (type, external)

   integer, parameter :: columns = 24, rows = 6

   if (runs('against_relaxation')) call against_relaxation()
   if (runs('any_start')) call any_start()
   if (runs('flooded')) call flooded()
   if (runs('full_film')) call full_film()
   if (runs('not_few')) call not_few()
   call report()

contains

   !> A loaded film of the dry pad, its grid at that motion, and a start without cavitated cells.
   subroutine loaded_film(grid, basis, film)
      type(film_grid_type), intent(out) :: grid
      type(grid_modes_type), intent(out) :: basis
      real(wp), allocatable, intent(out) :: film(:, :)
      type(film_motion) :: motion
      motion%position = clearance*[between(-0.15_wp, -0.04_wp), between(0.2_wp, 0.6_wp)]
      motion%velocity = clearance*speed*[between(-0.01_wp, 0.01_wp), between(-0.01_wp, 0.01_wp)]
      call film_at(motion, 0.0_wp, grid, basis, film)
   end subroutine loaded_film

   !> The grid of the pad at a motion, with an ambient pressure above that of cavitation, Pa.
   subroutine film_at(motion, ambient, grid, basis, film)
      type(film_motion), intent(in) :: motion
      real(wp), intent(in) :: ambient
      type(film_grid_type), intent(out) :: grid
      type(grid_modes_type), intent(out) :: basis
      real(wp), allocatable, intent(out) :: film(:, :)
      grid = new_film_grid(paper_pad([ambient, ambient, 0.0_wp]), columns, rows)
      basis = new_grid_modes(grid)
      call grid%set_motion(motion, paper_oil, speed)
      allocate (film(basis%m, columns), source=0.0_wp)
      film(:rows, :) = 1
   end subroutine film_at

   !> The pressure of the finite volumes, (row, column), with cavitation or without, by over-relaxation of each cell
   !> until nothing changes.
   function relaxed(grid, cavitates) result(p)
      type(film_grid_type), intent(in) :: grid
      logical, intent(in) :: cavitates
      real(wp) :: p(rows, columns)
      real(wp) :: flow, total, new, change
      integer :: round, column, row
      p = 0
      do round = 1, 20000
         change = 0
         do column = 1, columns
            do row = 1, rows
               associate (inward => grid%beside(column)*grid%inward(row), &
                  & outward => grid%beside(column)*grid%outward(row))
                  flow = -grid%source(column)
                  ! nothing flows from outside; the compiler would take the index there for one that is used
                  if (column > 1) flow = flow + grid%along(column - 1)*p(row, max(1, column - 1))
                  if (column < columns) flow = flow + grid%along(column)*p(row, min(columns, column + 1))
                  if (row > 1) flow = flow + inward*p(max(1, row - 1), column)
                  if (row < rows) flow = flow + outward*p(min(rows, row + 1), column)
                  if (row == rows) flow = flow - grid%edge_source(column)
                  total = grid%along(column - 1) + grid%along(column) + inward + outward
               end associate
               new = p(row, column) + 1.5_wp*(flow/total - p(row, column))
               if (cavitates) new = max(0.0_wp, new)
               change = max(change, abs(new - p(row, column)))
               p(row, column) = new
            end do
         end do
         if (change <= 1e-15_wp*maxval(p)) exit
      end do
   end function relaxed

   !> Force with cavitation less force without, N.
   function expected_force(grid) result(force)
      type(film_grid_type), intent(in) :: grid
      real(wp) :: force(2)
      force = grid%force(matmul(grid%height, relaxed(grid, .true.) - relaxed(grid, .false.)))
   end function expected_force

   subroutine against_relaxation()
      type(film_grid_type) :: grid
      type(grid_modes_type) :: basis
      real(wp), allocatable :: film(:, :)
      real(wp) :: force(2), expected(2), p(rows, columns), all_of_it
      logical :: is_local
      integer :: trial, compared
      compared = 0
      do trial = 1, 60
         call loaded_film(grid, basis, film)
         p = relaxed(grid, .true.)
         call force_of_few(grid, basis, film, force, is_local)
         if (.not. (is_local .and. any(p <= 0))) cycle
         compared = compared + 1
         expected = expected_force(grid)
         all_of_it = norm2(grid%force(matmul(grid%height, p)))
         call expect_close(norm2(force - expected), 0.0_wp, 1e-10_wp*all_of_it, 'force, film '//to_text(trial))
         call expect(norm2(expected) > 1e-7_wp*all_of_it, 'which is no rounding, film '//to_text(trial))
         call expect(all((film(:rows, :) > 0) .eqv. p > 0), 'the cells that cavitate, film '//to_text(trial))
      end do
      call expect(compared >= 40, 'most of these films cavitate slightly: '//to_text(compared))
   end subroutine against_relaxation

   !> The answer does not depend on the cells that were cavitated before.
   subroutine any_start()
      type(film_grid_type) :: grid
      type(grid_modes_type) :: basis
      real(wp), allocatable :: film(:, :), other(:, :)
      real(wp) :: force(2), again(2), draw(rows, columns)
      logical :: is_local, still_local
      integer :: trial, compared
      compared = 0
      do trial = 1, 60
         call loaded_film(grid, basis, film)
         other = film
         call force_of_few(grid, basis, film, force, is_local)
         call random_number(draw)
         other(:rows, :) = nint(draw)
         call force_of_few(grid, basis, other, again, still_local)
         if (.not. (is_local .and. still_local .and. norm2(force) > 0)) cycle
         compared = compared + 1
         call expect_close(norm2(again - force), 0.0_wp, 1e-12_wp*norm2(force), 'the same force, film '//to_text(trial))
         call expect(all(nint(other(:rows, :)) == nint(film(:rows, :))), 'the same cells, film '//to_text(trial))
      end do
      call expect(compared >= 40, 'most of these films cavitate slightly: '//to_text(compared))
   end subroutine any_start

   !> In a flooded pad cavitate begins inside, away from the edge: that is left to others, or told right.
   subroutine flooded()
      type(film_grid_type) :: grid
      type(grid_modes_type) :: basis
      real(wp), allocatable :: film(:, :)
      real(wp) :: force(2), p(rows, columns)
      logical :: is_local
      integer :: trial, inside
      inside = 0
      do trial = 1, 300
         call film_at(film_motion(clearance*[between(-0.15_wp, 0.0_wp), between(0.2_wp, 0.6_wp)], [0.0_wp, 0.0_wp]), &
            & between(1e3_wp, 1e6_wp), grid, basis, film)
         p = relaxed(grid, .true.)
         if (any(p <= 0) .and. all(p(:, 1) > 0)) inside = inside + 1
         call force_of_few(grid, basis, film, force, is_local)
         if (is_local) call expect_close(norm2(force - expected_force(grid)), 0.0_wp, &
            & 1e-10_wp*norm2(grid%force(matmul(grid%height, p))), 'force, film '//to_text(trial))
      end do
      call expect(inside >= 20, 'films that cavitate inside: '//to_text(inside))
   end subroutine flooded

   !> Squeezed everywhere, with no wedge: nothing cavitates.
   subroutine full_film()
      type(film_motion), parameter :: squeezed = film_motion(clearance*[-0.3_wp, 0.2_wp], &
         & clearance*speed*[0.0_wp, 0.1_wp])
      type(film_grid_type) :: grid
      type(grid_modes_type) :: basis
      real(wp), allocatable :: film(:, :)
      real(wp) :: force(2)
      logical :: is_local
      call film_at(squeezed, 0.0_wp, grid, basis, film)
      call expect(minval(relaxed(grid, .false.)) >= 0, 'a film that does not cavitate')
      call force_of_few(grid, basis, film, force, is_local)
      call expect(is_local, 'is slight cavitation')
      call expect_close(norm2(force), 0.0_wp, 0.0_wp, 'without a force')
   end subroutine full_film

   !> A film that opens over much of the pad, at the leading edge, or all over.
   subroutine not_few()
      type(film_motion), parameter :: motions(3) = [film_motion([20e-6_wp, 30e-6_wp], [0.0_wp, 0.0_wp]), &
         & film_motion([-10e-6_wp, 30e-6_wp], [-20e-3_wp, 0.0_wp]), film_motion([0.0_wp, 0.0_wp], [0.0_wp, -1.0_wp])]
      type(film_grid_type) :: grid
      type(grid_modes_type) :: basis
      real(wp), allocatable :: film(:, :)
      real(wp) :: force(2)
      logical :: is_local
      integer :: k
      do k = 1, size(motions)
         call film_at(motions(k), 0.0_wp, grid, basis, film)
         call expect(any(relaxed(grid, .true.) <= 0), 'a film that cavitates, '//to_text(k))
         call force_of_few(grid, basis, film, force, is_local)
         call expect(.not. is_local, 'far or wide, '//to_text(k))
      end do
   end subroutine not_few
end program test_local_cavitation
