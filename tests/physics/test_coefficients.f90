!> Stiffness, damping, modes and thresholds of bearings: against the values of independent programs, against the forces
!> of the films themselves, and by symmetry.
program test_coefficients
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use kinds, only: wp, pi
   use errors, only: error_type
   use scene, only: scene_type
   use equations_of_motion, only: bearing_model, new_bearing_model
   use equilibrium, only: equilibrium_type, find_equilibrium
   use static_model, only: make_fine
   use bearing_coefficients, only: bearing_coefficients_type, settle, find_coefficients
   use check, only: runs, expect, expect_close, expect_no_error, report
   implicit none (type, external)

   if (runs('published')) call published()
   if (runs('modes')) call modes()
   if (runs('threshold')) call threshold()
   call report()

contains

   !> The coefficients of a scene, and the model at whose rest y they are.
   subroutine analyse(scene, what, found, static, fine, y)
      type(scene_type), intent(in) :: scene
      character(len=*), intent(in) :: what
      type(bearing_coefficients_type), intent(out) :: found
      type(equilibrium_type), intent(out), optional :: static
      type(bearing_model), intent(out), optional :: fine
      real(wp), allocatable, intent(out), optional :: y(:)
      type(bearing_model) :: model, converged
      type(equilibrium_type) :: rest
      type(error_type), allocatable :: error
      real(wp), allocatable :: state(:)
      model = new_bearing_model(scene)
      call find_equilibrium(model, rest, error)
      if (.not. allocated(error)) then
         call make_fine(model, converged)
         call settle(converged, rest, state, error)
      end if
      if (.not. allocated(error)) call find_coefficients(converged, state, found, error)
      call expect_no_error(error, what)
      if (present(static)) static = rest
      if (present(fine)) fine = converged
      if (present(y)) y = state
   end subroutine analyse

   !> The paper's bearing with films that do not rupture.
   type(scene_type) function whole(speed_rpm) result(scene)
      real(wp), intent(in) :: speed_rpm
      scene = scene_type()
      scene%about%task = 'coefficients'
      scene%film%cavitation = 'none'
      scene%operation%speed_rpm = speed_rpm
      scene%operation%final_speed_rpm = speed_rpm
   end function whole

   !> Values of independent programs in MN/m and MN s/m, to six digits: to 1e-5 of the largest, which is what their
   !> films and ours differ by and the digits leave.
   subroutine published()
      type(scene_type) :: scene
      type(bearing_coefficients_type) :: found
      scene = whole(6500.0_wp)
      scene%friction%model = 'lugre'
      scene%coefficients%frequency_ratio = [1.0_wp, 0.5_wp]
      call analyse(scene, 'tilting and radial', found)
      call expect(all(found%bearings%pivot == ['free  ', 'stuck ', 'locked']), 'three ways of the pivots')
      call compare(found%stiffness(:, :, 1, 1), [521.449_wp, -0.768_wp, -0.200_wp, 522.734_wp], 'free, K')
      call compare(found%damping(:, :, 1, 1), [0.647359_wp, 0.0_wp, 0.0_wp, 0.648953_wp], 'free, C', 1e-3_wp)
      call compare(found%stiffness(1:1, 1:1, 2, 1), [545.403_wp], 'free, half the speed, K')
      call compare(found%damping(1:1, 1:1, 2, 1), [0.524387_wp], 'free, half the speed, C')
      call compare(found%stiffness(:, :, 1, 2), [840.962_wp, 352.514_wp, -354.373_wp, 842.451_wp], 'stuck, K')
      call compare(found%damping(:, :, 1, 2), [0.964977_wp, -0.227835_wp, 0.227328_wp, 0.967452_wp], 'stuck, C')
      call compare(found%stiffness(1:1, 1:1, 1, 3), [873.050_wp], 'locked, K')
      call compare(found%damping(1:1, 1:1, 1, 3), [1.03309_wp], 'locked, C')
      scene%pads%motion = 'tilting_only'
      call analyse(scene, 'tilting only', found)
      call compare(diagonal(found%stiffness(:, :, 1, 1)), [511.106_wp, 512.137_wp], 'tilting only, K')
      call compare(diagonal(found%damping(:, :, 1, 1)), [0.977657_wp, 0.979630_wp], 'tilting only, C')
      scene = whole(3000.0_wp)
      scene%pads%motion = 'tilting_only'
      call analyse(scene, 'tilting only at 3000 rpm', found)
      call expect(all(found%bearings%pivot == ['free  ', 'locked']), 'nothing sticks without friction')
      call compare(diagonal(found%stiffness(:, :, 1, 1)), [709.094_wp, 711.112_wp], '3000 rpm, K')
      call compare(diagonal(found%damping(:, :, 1, 1)), [2.06450_wp, 2.07038_wp], '3000 rpm, C')
   end subroutine published

   !> The rotor's two modes, to the digits given.
   subroutine modes()
      type(bearing_coefficients_type) :: found
      call analyse(whole(6500.0_wp), 'modes', found)
      associate (values => found%modes(1)%eigenvalue(1:2), ratios => found%modes(1)%damping_ratio(1:2))
         call expect_close(values(1)%im/(2*pi), 76.4228_wp, 1e-5_wp*76, 'first frequency')
         call expect_close(values(2)%im/(2*pi), 76.5063_wp, 1e-5_wp*76, 'second frequency')
         call expect_close(ratios(1), 0.26381_wp, 1e-5_wp, 'first damping ratio')
         call expect_close(ratios(2), 0.26421_wp, 1e-5_wp, 'second damping ratio')
      end associate
   end subroutine modes

   subroutine threshold()
      type(scene_type) :: scene
      type(bearing_coefficients_type) :: found
      scene = whole(6500.0_wp)
      scene%rotor%mass = 200
      scene%coefficients%threshold_up_to_rpm = 20000
      call analyse(scene, 'threshold', found)
      call expect_close(found%thresholds(1), 14945.85_wp, 0.015_wp, 'free')
      call expect(found%thresholds(2) > 6500 .and. found%thresholds(2) < found%thresholds(1), &
         & 'locked pivots lose stability before')
      scene%coefficients%threshold_up_to_rpm = 8000
      call analyse(scene, 'no threshold', found)
      call expect(all(ieee_is_nan(found%thresholds)), 'none up to 8000 rpm')
      call expect_close(found%sought_up_to, 8000.0_wp, 0.0_wp, 'all of the range was looked at')
   end subroutine threshold

   !> Row by row, in millions; 1e-5 of the largest element, or a tolerance of one's own.
   subroutine compare(found, expected, what, tolerance)
      real(wp), intent(in) :: found(:, :), expected(:)
      character(len=*), intent(in) :: what
      real(wp), intent(in), optional :: tolerance
      real(wp) :: allowed
      allowed = 1e-5_wp*maxval(abs(expected))
      if (present(tolerance)) allowed = tolerance*maxval(abs(expected))
      call expect_close(maxval(abs(1e-6_wp*[transpose(found)] - expected)), 0.0_wp, allowed, what)
   end subroutine compare

   pure function diagonal(matrix)
      real(wp), intent(in) :: matrix(2, 2)
      real(wp) :: diagonal(1, 2)
      diagonal(1, :) = [matrix(1, 1), matrix(2, 2)]
   end function diagonal
end program test_coefficients
