!> Stiffness, damping, modes and thresholds of bearings: against the values of independent programs and against the
!> forces of the films themselves. Turned bearings are for tests/cases/test_invariants.py.
program test_coefficients
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use kinds, only: wp, pi
   use text, only: to_text
   use case_inputs, only: case_type
   use equations_of_motion, only: machine_model
   use force_balance, only: forces
   use state_layout, only: pivot_deflection
   use input_cases, only: case_of
   use linear_analysis, only: analyse
   use equilibrium_record, only: equilibrium_type
   use linear_bearing, only: bearing_coefficients_type
   use check, only: runs, expect, expect_close, report
   implicit none (type, external)

   if (runs('published')) call published()
   if (runs('modes')) call modes()
   if (runs('threshold')) call threshold()
   if (runs('cross_stiffness')) call cross_stiffness()
   if (runs('differences')) call differences()
   if (runs('refinement')) call refinement()
   if (runs('tangent')) call tangent_of_pivots()
   if (runs('flexure')) call flexure()
   if (runs('load')) call change_of_load()
   if (runs('sticking')) call sticking()
   call report()

contains

   !> The paper's bearing with films that do not cavitate.
   type(case_type) function whole(speed_rpm) result(inputs)
      real(wp), intent(in) :: speed_rpm
      inputs = case_type()
      inputs%about%task = 'coefficients'
      inputs%bearings(1)%film%cavitation = 'none'
      inputs%operation%speed_rpm = speed_rpm
      inputs%operation%final_speed_rpm = speed_rpm
   end function whole

   !> Values of independent programs in MN/m and MN s/m, to six digits: to 1e-5 of the largest, which is what their
   !> films and ours differ by and the digits leave.
   subroutine published()
      type(case_type) :: inputs
      type(bearing_coefficients_type) :: found
      inputs = whole(6500.0_wp)
      inputs%bearings(1)%friction%model = 'lugre'
      inputs%coefficients%frequency_ratio = [1.0_wp, 0.5_wp]
      call analyse(inputs, 'tilting and radial', found)
      call expect(all(found%bearings%pivot == ['free  ', 'stuck ', 'locked']), 'three ways of the pivots')
      call compare(found%stiffness(:, :, 1, 1, 1), [521.449_wp, -0.768_wp, -0.200_wp, 522.734_wp], 'free, K')
      call compare(found%damping(:, :, 1, 1, 1), [0.647359_wp, 0.0_wp, 0.0_wp, 0.648953_wp], 'free, C', 1e-3_wp)
      call compare(found%stiffness(1:1, 1:1, 2, 1, 1), [545.403_wp], 'free, half the speed, K')
      call compare(found%damping(1:1, 1:1, 2, 1, 1), [0.524387_wp], 'free, half the speed, C')
      call compare(found%stiffness(:, :, 1, 2, 1), [840.962_wp, 352.514_wp, -354.373_wp, 842.451_wp], 'stuck, K')
      call compare(found%damping(:, :, 1, 2, 1), [0.964977_wp, -0.227835_wp, 0.227328_wp, 0.967452_wp], 'stuck, C')
      call compare(found%stiffness(1:1, 1:1, 1, 3, 1), [873.050_wp], 'locked, K')
      call compare(found%damping(1:1, 1:1, 1, 3, 1), [1.03309_wp], 'locked, C')
      inputs%bearings(1)%pads%motion = 'tilting_only'
      call analyse(inputs, 'tilting only', found)
      call compare(diagonal(found%stiffness(:, :, 1, 1, 1)), [511.106_wp, 512.137_wp], 'tilting only, K')
      call compare(diagonal(found%damping(:, :, 1, 1, 1)), [0.977657_wp, 0.979630_wp], 'tilting only, C')
      inputs = whole(3000.0_wp)
      inputs%bearings(1)%pads%motion = 'tilting_only'
      call analyse(inputs, 'tilting only at 3000 rpm', found)
      call expect(all(found%bearings%pivot == ['free  ', 'locked']), 'nothing sticks without friction')
      call compare(diagonal(found%stiffness(:, :, 1, 1, 1)), [709.094_wp, 711.112_wp], '3000 rpm, K')
      call compare(diagonal(found%damping(:, :, 1, 1, 1)), [2.06450_wp, 2.07038_wp], '3000 rpm, C')
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
      type(case_type) :: inputs
      type(bearing_coefficients_type) :: found
      inputs = whole(6500.0_wp)
      inputs%rotor%mass = 200
      inputs%coefficients%threshold_up_to_rpm = 20000
      call analyse(inputs, 'threshold', found)
      call expect_close(found%thresholds(1), 14945.85_wp, 0.015_wp, 'free')
      call expect(found%thresholds(2) > 6500 .and. found%thresholds(2) < found%thresholds(1), &
         & 'locked pads lose stability before')
      inputs%coefficients%threshold_up_to_rpm = 8000
      call analyse(inputs, 'stable up to 8000 rpm', found)
      call expect(all(ieee_is_nan(found%thresholds)), 'none up to 8000 rpm')
      call expect_close(found%sought_up_to, 8000.0_wp, 0.0_wp, 'all of the range was looked at')
   end subroutine threshold

   !> What is displaced along +y is pushed along +z by Q > 0, in the sense of rotation: forward whirl is damped less,
   !> backward whirl more, and of two modes that are alike otherwise the difference of the real parts is Q/(m omega).
   subroutine cross_stiffness()
      type(case_type) :: inputs
      type(bearing_coefficients_type) :: found
      complex(wp) :: forward
      inputs = whole(6500.0_wp)
      inputs%coefficients%cross_stiffness = 1e8_wp
      call analyse(inputs, 'cross-coupled stiffness', found)
      associate (first => found%modes(1))
         forward = first%shape(2, 1)/first%shape(1, 1)
         call expect_close(abs(forward - cmplx(0.0_wp, -1.0_wp, wp)), 0.0_wp, 0.02_wp, 'z lags y by a quarter')
         call expect(first%damping_ratio(1) < 0.2_wp .and. first%damping_ratio(2) > 0.3_wp, 'one less, one more')
      end associate
      call compare(found%stiffness(:, :, 1, 1, 1), [521.449_wp, -0.768_wp, -0.200_wp, 522.734_wp], 'K is without it')
   end subroutine cross_stiffness

   !> The full matrices against central differences of the forces, to a part of each row's largest element in its
   !> column's scale: of full films to 1e-6; of cavitated films, whose slopes leave out how cells leave the film, to 2
   !> % (pads that carry nothing err most).
   subroutine differences()
      call against_differences(whole(6500.0_wp), 'full films', 1e-4_wp, 1e-6_wp)
      call against_differences(cavitated(), 'cavitated films', 1e-4_wp, 2e-2_wp)
   end subroutine differences

   !> Four pads without preload: the loaded pads' films cavitate at the trailing edges, two pads carry nothing.
   type(case_type) function cavitated() result(inputs)
      inputs = case_of('&case task = ''coefficients''/ &rotor mass = 1000/ &operation speed_rpm = 3000/ &bearing ' &
         & //'journal_radius = 50e-3 axial_length = 50e-3 assembled_clearance = 100e-6 machined_clearance = 100e-6 ' &
         & //'viscosity = 20e-3/ &pads pivot_angle_deg = -45, 45, 135, 225 arc_deg = 80/')
   end function cavitated

   subroutine against_differences(inputs, what, part, tolerance)
      type(case_type), intent(in) :: inputs
      character(len=*), intent(in) :: what
      !> Of the scale of each state that the differences span.
      real(wp), intent(in) :: part, tolerance
      type(bearing_coefficients_type) :: found
      type(machine_model) :: model
      real(wp), allocatable :: y(:)
      call analyse(inputs, what, found, fine=model, y=y)
      associate (x => model%layout%positions(), v => model%layout%rates())
         call agree(-over(model, y, x, part), found%bearings(1)%stiffness, model%scale(x), tolerance, what//', K')
         call agree(-over(model, y, v, part), found%bearings(1)%damping, model%scale(v), tolerance, what//', C')
      end associate
   end subroutine against_differences

   !> Derivatives of the forces over these states.
   function over(model, y, states, part) result(slopes)
      type(machine_model), intent(inout) :: model
      real(wp), intent(in) :: y(:), part
      integer, intent(in) :: states(:)
      real(wp) :: slopes(size(states), size(states)), shifted(size(y))
      integer :: k, side
      logical :: ok
      slopes = 0
      do k = 1, size(states)
         associate (step => part*model%scale(states(k)))
            do side = -1, 1, 2
               shifted = y
               shifted(states(k)) = y(states(k)) + side*step
               call model%evaluate(0.0_wp, shifted, .false., ok)
               call expect(ok, 'a state beside the rest')
               slopes(:, k) = slopes(:, k) + side*forces(model, 0.0_wp, shifted)/(2*step)
            end do
         end associate
      end do
   end function over

   !> Rows, each column times its scale, to a part of the row's largest.
   subroutine agree(found, expected, scale, tolerance, what)
      real(wp), intent(in) :: found(:, :), expected(:, :), scale(:), tolerance
      character(len=*), intent(in) :: what
      integer :: row
      do row = 1, size(scale)
         call expect_close(maxval(abs(found(row, :) - expected(row, :))*scale), 0.0_wp, &
            & tolerance*maxval(abs(expected(row, :))*scale), what//', row '//to_text(row))
      end do
   end subroutine agree

   !> With the defaults the coefficients are those of films that are five times as close at least, to 1e-6
   !> where they are whole and to 2e-4 where they cavitate: slopes of 14 rows of volumes, a pad of 80 degrees.
   subroutine refinement()
      call against_refined(whole(6500.0_wp), 'whole', 1e-6_wp)
      call against_refined(cavitated(), 'cavitated', 2e-4_wp)
   end subroutine refinement

   subroutine against_refined(inputs, what, tolerance)
      type(case_type), intent(in) :: inputs
      character(len=*), intent(in) :: what
      real(wp), intent(in) :: tolerance
      type(case_type) :: refined
      type(bearing_coefficients_type) :: found, expected
      call analyse(inputs, what, found)
      refined = inputs
      refined%bearings(1)%film%table_tolerance = 2.5e-6_wp
      if (tolerance < 1e-5_wp) refined%bearings(1)%film%table_tolerance = 1e-8_wp
      call analyse(refined, what//', refined', expected)
      call expect_close(maxval(abs(found%stiffness - expected%stiffness)), 0.0_wp, &
         & tolerance*maxval(abs(expected%stiffness)), 'K, '//what)
      call expect_close(maxval(abs(found%damping - expected%damping)), 0.0_wp, &
         & tolerance*maxval(abs(expected%damping)), 'C, '//what)
   end subroutine against_refined

   !> Springs with the stiffness of Hertz's law under the load give the coefficients of that law. The pads stand closer
   !> by the difference of the deflections, 3 um, and as two pads move with the journal, that turns their films by 3 um
   !> over the radius of 50 mm: 1e-4.
   subroutine tangent_of_pivots()
      type(case_type) :: inputs
      type(bearing_coefficients_type) :: hertz, linear
      type(equilibrium_type) :: static
      type(machine_model) :: model
      real(wp) :: load, stiffness(2)
      integer :: i
      inputs = whole(6500.0_wp)
      inputs%bearings(1)%pivot%law = 'hertz'
      call analyse(inputs, 'Hertz', hertz, static, model)
      do i = 1, 2
         call model%bearings(1)%pivots(i)%contact%lookup(static%pads(i)%x(pivot_deflection), load, stiffness(i))
      end do
      inputs%bearings(1)%pivot%law = 'linear'
      inputs%bearings(1)%pivot%stiffness = stiffness
      call analyse(inputs, 'tangents', linear)
      call expect_close(maxval(abs(linear%stiffness - hertz%stiffness)), 0.0_wp, 2e-4_wp*maxval(abs( &
         & hertz%stiffness)), 'K of the tangents')
      call expect_close(maxval(abs(linear%damping - hertz%damping)), 0.0_wp, 2e-4_wp*maxval(abs(hertz%damping)), &
         & 'C of the tangents')
      inputs%bearings(1)%pivot%stiffness = 2*stiffness
      call analyse(inputs, 'twice as stiff', linear)
      call expect(maxval(abs(linear%stiffness - hertz%stiffness)) > 1e-2_wp*maxval(abs(hertz%stiffness)), &
         & 'the stiffness of the pivots counts')
   end subroutine tangent_of_pivots

   !> Pads on flexure pivots that become stiffer come to fixed ones: their tilts are moments over the stiffness, so that
   !> the coefficients differ by a tenth where it is ten times as large, but for the second order. Derivatives agree
   !> with differences where the stiffness counts.
   subroutine flexure()
      type(case_type) :: inputs
      type(bearing_coefficients_type) :: fixed, found
      real(wp) :: gap(2, 3)
      integer :: i
      inputs = whole(6500.0_wp)
      inputs%bearings(1)%pads%motion = 'fixed'
      call analyse(inputs, 'fixed pads', fixed)
      inputs%bearings(1)%pads%motion = 'tilting_only'
      do i = 1, 3
         inputs%bearings(1)%pivot%rotational_stiffness = 10.0_wp**(7 + i)
         call analyse(inputs, 'flexure', found)
         associate (k => found%stiffness(:, :, 1, 1, 1), c => found%damping(:, :, 1, 1, 1))
            gap(1, i) = maxval(abs(k - fixed%stiffness(:, :, 1, 1, 1)))/maxval(abs(fixed%stiffness))
            gap(2, i) = maxval(abs(c - fixed%damping(:, :, 1, 1, 1)))/maxval(abs(fixed%damping))
         end associate
      end do
      do i = 1, 2
         call expect(all(gap(:, i) > 1e-5_wp), 'the tilts count')
         call expect_close(maxval(abs(gap(:, i)/gap(:, i + 1) - 10)), 0.0_wp, 100*maxval(gap(:, i)), 'first order')
      end do
      inputs%bearings(1)%pivot%rotational_stiffness = [2e4_wp, 5e4_wp]
      call against_differences(inputs, 'flexure pivots', 1e-4_wp, 1e-6_wp)
   end subroutine flexure

   !> A little more load moves the journal by that over the stiffness at rest, weight of the pads included: differences
   !> over 2e-4 of the load to 1e-6.
   subroutine change_of_load()
      type(case_type) :: inputs
      type(bearing_coefficients_type) :: found
      type(equilibrium_type) :: rest(-1:1)
      real(wp), parameter :: part = 1e-4_wp
      real(wp) :: force(2)
      integer :: axis, side
      inputs = whole(6500.0_wp)
      inputs%bearings(1)%pads%mass = 50
      inputs%bearings(1)%pads%inertia = 0.1_wp
      inputs%bearings(1)%pads%centre_tangential = 5e-3_wp
      inputs%coefficients%frequency_ratio = [0.0_wp]
      call analyse(inputs, 'stiffness at rest', found)
      do axis = 1, 2
         force = 0
         force(axis) = part*inputs%rotor%mass*inputs%rotor%gravity
         do side = -1, 1, 2
            inputs%rotor%static_load = side*force
            call analyse(inputs, 'other load', found, rest(side))
         end do
         inputs%rotor%static_load = 0
         call analyse(inputs, 'stiffness at rest', found)
         associate (moved => 0.5_wp*(rest(1)%rotor - rest(-1)%rotor))
            call expect_close(norm2(matmul(found%stiffness(:, :, 1, 1, 1), moved) - force), 0.0_wp, &
               & 1e-6_wp*norm2(force), 'force along axis '//to_text(axis))
         end associate
      end do
   end subroutine change_of_load

   !> What sticking adds to the tilts is R1^2 F_bs times sigma_0, and sigma_1 + sigma_2, or 2 f_s/v_c; of pads that only
   !> tilt F_bs is the reaction of the pivot.
   subroutine sticking()
      type(case_type) :: inputs
      integer :: i
      inputs = whole(6500.0_wp)
      do i = 1, 2
         if (i == 2) inputs%bearings(1)%pads%motion = 'tilting_only'
         inputs%bearings(1)%friction%model = 'lugre'
         inputs%bearings(1)%friction%bristle_damping = 7
         inputs%bearings(1)%friction%viscous_coefficient = 3
         call adds(inputs, 1e6_wp, 10.0_wp)
         inputs%bearings(1)%friction%model = 'bengisu_akay'
         call adds(inputs, 0.0_wp, 2*0.1_wp/1e-5_wp)
      end do
   end subroutine sticking

   subroutine adds(inputs, stiffness, damping)
      type(case_type), intent(in) :: inputs
      !> Over R1^2 F_bs, 1/m and s/m.
      real(wp), intent(in) :: stiffness, damping
      type(bearing_coefficients_type) :: found
      type(equilibrium_type) :: static
      type(machine_model) :: model
      real(wp), parameter :: radius = 13e-3_wp - 15e-6_wp
      integer :: i
      character(len=:), allocatable :: what
      what = inputs%bearings(1)%friction%model//', '//inputs%bearings(1)%pads%motion
      call analyse(inputs, what, found, static, model)
      associate (free => found%bearings(1), stuck => found%bearings(2), &
         & at => model%layout%tilts())
         do i = 1, 2
            associate (normal => radius**2*static%pivot_load(i))
               free%stiffness(at(i), at(i)) = free%stiffness(at(i), at(i)) + stiffness*normal
               free%damping(at(i), at(i)) = free%damping(at(i), at(i)) + damping*normal
            end associate
         end do
         call expect_close(maxval(abs(free%stiffness - stuck%stiffness)), 0.0_wp, &
            & 1e-12_wp*maxval(abs(stuck%stiffness)), what//', K')
         call expect_close(maxval(abs(free%damping - stuck%damping)), 0.0_wp, 1e-9_wp*maxval(abs(stuck%damping)), &
            & what//', C')
      end associate
   end subroutine adds

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
