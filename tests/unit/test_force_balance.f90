!> Forces, their derivatives and the masses against the equations of motion: the masses times the rates of the rates
!> are the forces, and so are their derivatives over positions and rates.
program test_force_balance
   use kinds, only: wp
   use text, only: to_text
   use scene, only: scene_type
   use kinematics, only: journal_motion, pad_state
   use equations_of_motion, only: bearing_model, new_bearing_model
   use force_balance, only: forces, force_derivatives, masses
   use check, only: runs, expect, expect_close, between, report
   implicit none (type, external)

   character(len=*), parameter :: motions(3) = [character(len=14) :: 'tilting_radial', 'tilting_only', 'fixed']
   character(len=*), parameter :: frictions(3) = [character(len=12) :: 'none', 'bengisu_akay', 'lugre']
   integer :: i, k

   do i = 1, size(motions)
      do k = 1, size(frictions)
         if (motions(i) == 'fixed' .and. k > 1) cycle
         if (runs('against_motion')) call against_motion(motions(i), frictions(k))
      end do
   end do
   call report()

contains

   !> Sums of some ten numbers, and a pad's masses, whose inverse loses a digit or two: 1e-12 of each row's largest
   !> entry.
   subroutine against_motion(motion, friction)
      character(len=*), intent(in) :: motion, friction
      type(scene_type) :: scene
      type(bearing_model) :: model
      real(wp), allocatable :: y(:), rates(:), jacobian(:, :), expected(:), matrix(:, :), over_positions(:, :)
      real(wp), allocatable :: over_rates(:, :)
      real(wp), parameter :: t = 0.0123_wp
      character(len=:), allocatable :: what
      logical :: ok
      integer :: n, i
      what = trim(motion)//', '//trim(friction)
      scene = scene_type()
      scene%pads%motion = trim(motion)
      scene%friction%model = trim(friction)
      scene%pads%centre_tangential = [3e-3_wp, -6e-3_wp]
      scene%pads%mass = [0.8_wp, 0.6_wp]
      model = new_bearing_model(scene)
      y = model%state(journal_motion([-4e-5_wp, 2e-6_wp], [1e-3_wp, -2e-3_wp]), &
         & [(pad_state(4e-4_wp*(i - 1), between(0.3_wp, 0.6_wp), 7e-6_wp, 1e-3_wp, 1e-7_wp), i=1, 2)])
      n = model%layout%n_positions()
      allocate (rates(model%n), jacobian(model%n, model%n), over_positions(n, n), over_rates(n, n))
      call model%rhs(t, y, rates, ok)
      call expect(ok, 'a state with films, '//what)
      expected = forces(model, t)
      associate (x => model%layout%positions(), v => model%layout%rates())
         call expect(size(expected) == size(x), 'a force for each position, '//what)
         call compare(spread(matmul(masses(model), rates(v)), 2, 1), spread(expected, 2, 1), 'forces, '//what)
         call model%rhs_and_jacobian(t, y, rates, jacobian, ok)
         call force_derivatives(model, over_positions, over_rates)
         matrix = matmul(masses(model), jacobian(v, x))
         call compare(matrix, over_positions, 'derivatives over positions, '//what)
         matrix = matmul(masses(model), jacobian(v, v))
         call compare(matrix, over_rates, 'derivatives over rates, '//what)
      end associate
   end subroutine against_motion

   subroutine compare(found, expected, what)
      real(wp), intent(in) :: found(:, :), expected(:, :)
      character(len=*), intent(in) :: what
      integer :: row
      do row = 1, size(found, 1)
         call expect_close(maxval(abs(found(row, :) - expected(row, :))), 0.0_wp, &
            & 1e-12_wp*maxval(abs(expected(row, :))), 'row '//to_text(row)//', '//what)
      end do
   end subroutine compare
end program test_force_balance
