!> Pressure fields of the film solvers: solvers agree, cavitation, layers at the edges. That their integral is the force
!> is for test_film_accuracy.
program test_film_field
   use kinds, only: wp, pi, degree
   use text, only: to_text
   use film_solver, only: film_solver_type, film_motion, cavitation_none, cavitation_reynolds
   use pad_gap, only: pad_gap_type
   use fourier_film, only: fourier_film_type, new_fourier_film
   use sor_film, only: sor_film_type, new_sor_film, sor_options
   use direct_film, only: direct_film_type, new_direct_film
   use paper_bearing, only: paper_oil, offset_pad, speed
   use check, only: runs, expect, expect_close, report
   implicit none (type, external)

   real(wp), parameter :: theta_1 = 40*degree, theta_2 = 30*degree
   real(wp), parameter :: length = 0.1_wp, um = 1e-6_wp
   !> Points along the arc and across half the width, in the middle of equal parts.
   integer, parameter :: along = 400, across = 200
   type(film_motion), parameter :: whole = film_motion([-30*um, 50*um], [0.0_wp, 2e-3_wp])
   type(film_motion), parameter :: slight = film_motion([-10*um, 50*um], [0.0_wp, 0.0_wp])
   type(film_motion), parameter :: torn = film_motion([10*um, 50*um], [0.0_wp, 0.0_wp])
   type(film_motion), parameter :: unloaded = film_motion([10*um, -30*um], [0.0_wp, 0.0_wp])

   if (runs('solvers_agree')) call solvers_agree()
   if (runs('uniform_pressure')) call uniform_pressure()
   if (runs('heated_edge')) call heated_edge()
   if (runs('pads_apart')) call pads_apart()
   call report()

contains

   !> Angles in the middle of equal parts of the arc, (angle, 1).
   pure function angles()
      real(wp) :: angles(along, 1)
      integer :: i
      angles(:, 1) = [((i - 0.5_wp)/along*(theta_1 + theta_2) - theta_2, i=1, along)]
   end function angles

   pure function places()
      real(wp) :: places(across)
      integer :: i
      places = [((i - 0.5_wp)/across*length/2, i=1, across)]
   end function places

   !> A pad's field on these points, (axial place, angle).
   function field_of(solver, motion) result(p)
      class(film_solver_type), intent(inout) :: solver
      type(film_motion), intent(in) :: motion
      real(wp), allocatable :: p(:, :), all(:, :, :)
      allocate (all(across, along, 1))
      call solver%field([motion], [paper_oil], speed, angles(), spread(places(), 2, 1), all)
      p = all(:, :, 1)
   end function field_of

   !> Modes, and the solver that chooses, against fine over-relaxation in every point, over the highest pressure;
   !> with a pressure at the leading edge but for a cell of the latter around the corner where the pressure jumps.
   subroutine solvers_agree()
      real(wp), parameter :: tolerances(3) = [2e-3_wp, 1e-2_wp, 3e-2_wp]
      type(fourier_film_type) :: modes
      type(sor_film_type) :: volumes
      type(direct_film_type) :: direct
      real(wp), allocatable :: p(:, :), q(:, :)
      type(film_motion) :: motions(3)
      integer :: i
      modes = new_fourier_film([offset_pad()], 24, 8, gumbel=.false.)
      volumes = new_sor_film([offset_pad()], fine(cavitation_none))
      p = field_of(modes, whole)
      q = field_of(volumes, whole)
      call expect_close(maxval(abs(p - q)), 0.0_wp, 1e-3_wp*maxval(q), 'modes against over-relaxation')
      modes = new_fourier_film([offset_pad([4e6_wp, 1e6_wp, 0.0_wp])], 36, 16, .false.)
      volumes = new_sor_film([offset_pad([4e6_wp, 1e6_wp, 0.0_wp])], fine(cavitation_none))
      p = field_of(modes, whole)
      q = field_of(volumes, whole)
      p(175:, 392:) = q(175:, 392:)
      call expect_close(maxval(abs(p - q)), 0.0_wp, 3e-3_wp*maxval(q), 'modes against over-relaxation, flooded')
      direct = new_direct_film([offset_pad()], 24, 8, 80, 8, cavitation_reynolds)
      volumes = new_sor_film([offset_pad()], fine(cavitation_reynolds))
      motions = [slight, torn, unloaded]
      do i = 1, size(motions)
         p = field_of(direct, motions(i))
         q = field_of(volumes, motions(i))
         call expect(minval(p) >= 0 .and. any(p <= 0), 'cavitation and no tension, '//to_text(i))
         call expect_close(maxval(abs(p - q)), 0.0_wp, tolerances(i)*maxval(q), 'direct against volumes, ' &
            & //to_text(i))
      end do
   end subroutine solvers_agree

   pure type(sor_options) function fine(cavitation)
      integer, intent(in) :: cavitation
      fine = sor_options(160, 40, tolerance=1e-10_wp, cavitation=cavitation)
   end function fine

   !> At rest in one pressure every solver has that pressure, at the edges too.
   subroutine uniform_pressure()
      type(fourier_film_type) :: modes
      type(sor_film_type) :: volumes
      type(direct_film_type) :: direct
      modes = new_fourier_film([offset_pad([3e5_wp, 3e5_wp, 0.0_wp])], 24, 8, gumbel=.false.)
      volumes = new_sor_film([offset_pad([3e5_wp, 3e5_wp, 0.0_wp])], sor_options(24, 8, tolerance=1e-13_wp))
      direct = new_direct_film([offset_pad([3e5_wp, 3e5_wp, 0.0_wp])], 24, 8, 24, 8, cavitation_reynolds)
      call expect_close(unevenness(modes), 0.0_wp, 1e-9_wp, 'uniform pressure, modes')
      call expect_close(unevenness(volumes), 0.0_wp, 1e-9_wp, 'uniform pressure, volumes')
      call expect_close(unevenness(direct), 0.0_wp, 1e-9_wp, 'uniform pressure, direct')
   end subroutine uniform_pressure

   real(wp) function unevenness(solver)
      class(film_solver_type), intent(inout) :: solver
      real(wp) :: p(3, 3, 1), phi(3, 1)
      phi(:, 1) = [-theta_2, 0.1_wp, theta_1]
      call solver%field([film_motion([-20*um, 40*um])], [paper_oil], 0.0_wp, phi, &
         & reshape([0.0_wp, length/3, length/2], [3, 1]), p)
      unevenness = maxval(abs(p/3e5_wp - 1))
   end function unevenness

   !> A higher pressure at the leading edge, nothing else, on an even film: like heat in a long plate, in closed form
   !> with its images in both edges. Some points lie closer to the edge than any node.
   subroutine heated_edge()
      real(wp), parameter :: rise = 3e5_wp, z(3) = [0.0_wp, 0.3_wp*length, 0.499_wp*length]
      type(fourier_film_type) :: solver
      real(wp) :: p(3, 4, 1), phi(4, 1), x(4), exact(3), arc
      integer :: i, k
      arc = theta_1 + theta_2
      x = [0.0_wp, 1e-4_wp, 0.01_wp, 0.2_wp]*arc
      phi(:, 1) = theta_1 - x
      solver = new_fourier_film([offset_pad([rise, 0.0_wp, 0.0_wp])], 24, 16, gumbel=.false.)
      call solver%field([film_motion([0.0_wp, 0.0_wp])], [paper_oil], 0.0_wp, phi, spread(z, 2, 1), p)
      do i = 1, 4
         exact = rise*plate(z, x(i))
         do k = 1, 5
            exact = exact - rise*(plate(z, 2*k*arc - x(i)) - plate(z, 2*k*arc + x(i)))
         end do
         call expect_close(maxval(abs(p(:, i, 1) - exact)), 0.0_wp, 3e-4_wp*rise, 'beside the edge, '//to_text(i))
      end do
   end subroutine heated_edge

   !> The long plate: 1 at x = 0, 0 at the sides.
   elemental real(wp) function plate(z, x)
      real(wp), intent(in) :: z, x
      plate = 2/pi*atan2(cos(pi*z/length), sinh(pi*50e-3_wp*x/length))
   end function plate

   !> Every pad at its own motion and angles.
   subroutine pads_apart()
      type(direct_film_type) :: solver, alone
      type(pad_gap_type) :: films(2)
      real(wp), allocatable :: p(:, :, :)
      real(wp) :: phi(along, 2)
      allocate (p(across, along, 2))
      films = offset_pad()
      films(2)%leading_angle = theta_2
      films(2)%trailing_angle = theta_1
      phi(:, 1) = reshape(angles(), [along])
      phi(:, 2) = -phi(along:1:-1, 1)
      solver = new_direct_film(films, 24, 8, 80, 8, cavitation_reynolds)
      call solver%field([whole, whole], [paper_oil, paper_oil], speed, phi, spread(places(), 2, 2), p)
      call expect(maxval(abs(p(:, :, 1) - p(:, :, 2))) > 0.01_wp*maxval(p), 'two pads, two fields')
      alone = new_direct_film(films(:1), 24, 8, 80, 8, cavitation_reynolds)
      call expect_close(maxval(abs(p(:, :, 1) - field_of(alone, whole))), 0.0_wp, 0.0_wp, 'the first pad''s own')
   end subroutine pads_apart
end program test_film_field
