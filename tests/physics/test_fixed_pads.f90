!> Bearings of fixed pads: the limits of Ocvirk and Sommerfeld, the table of Lund and Thomsen, the threshold speed of
!> oil whirl and the marches on both sides of it.
program test_fixed_pads
   use kinds, only: wp, pi, rpm, degree
   use text, only: to_text
   use errors, only: error_type
   use case_inputs, only: case_type
   use equations_of_motion, only: machine_model, new_machine_model
   use force_balance, only: force_derivatives
   use film_solver, only: film_solver_type, film_motion, film_response
   use pad_gap, only: pad_gap_type
   use factories, only: make_film, march_films
   use paper_bearing, only: paper_oil
   use random_films, only: film_state, volumes_type, new_volumes, extrapolated, shaft_speed
   use rigid_rotor, only: journal_motion
   use state_layout, only: pad_state
   use kinematics, only: frame_of, motion_of
   use equilibrium_record, only: equilibrium_type
   use equilibrium, only: find_equilibrium
   use pad_behaviour, only: whirl_of
   use sampled_march, only: march_samples
   use input_cases, only: case_of, listed
   use check, only: runs, expect, expect_close, expect_no_error, between, report
   implicit none (type, external)

   !> Samples of a revolution.
   integer, parameter :: samples = 60

   !> A state of rest in numbers without dimension: Sommerfeld number, eccentricity ratio, attitude angle, deg, and
   !> K c/W and C c omega/W along the load (x) and across it (y), xx xy yx yy.
   type :: static_state_type
      real(wp) :: sommerfeld = 0, eccentricity = 0, attitude = 0, stiffness(4) = 0, damping(4) = 0
   end type static_state_type

   if (runs('short_bearing')) call short_bearing()
   if (runs('long_bearing')) call long_bearing()
   if (runs('lobes')) call lobes()
   if (runs('lund_thomsen')) call lund_thomsen()
   if (runs('wide_films')) call wide_films()
   if (runs('threshold')) call threshold()
   if (runs('whirl')) call whirl()
   call report()

contains

   !> A bearing of fixed pads with a diameter of 100 mm and a clearance of 1 per mille at 3000 rpm that carries 5 kN
   !> downwards.
   type(case_type) function fixed_case(pivots, arcs, length_ratio) result(inputs)
      real(wp), intent(in) :: pivots(:), arcs(:), length_ratio
      inputs = case_of('&pads motion = ''fixed'', pivot_angle_deg = '//listed(pivots)//', arc_deg = '//listed(arcs) &
         & //' / &bearing journal_radius = 50e-3, assembled_clearance = 50e-6, preload = 0, viscosity = 0.02, ' &
         & //'axial_length = '//listed([0.1_wp*length_ratio])//' / &operation speed_rpm = 3000 / ' &
         & //'&rotor unbalance = 0, mass = '//listed([5e3_wp/9.81_wp])//' /')
   end function fixed_case

   !> Forces, N, of a bearing of one fixed pad all around, its groove where the film is thickest, on a journal that is
   !> off its middle, downwards, by a part of the clearance: towards the middle and in the sense of the rotation.
   function forces_of(length_ratio, eccentricity, cavitation, solver) result(force)
      real(wp), intent(in) :: length_ratio, eccentricity
      character(len=*), intent(in) :: cavitation, solver
      real(wp) :: force(2)
      type(case_type) :: inputs
      type(machine_model) :: model
      logical :: ok
      inputs = fixed_case([-90.0_wp], [360.0_wp], length_ratio)
      inputs%bearings(1)%film%cavitation = cavitation
      inputs%bearings(1)%film%solver = solver
      model = new_machine_model(inputs)
      call model%evaluate(0.0_wp, model%static_state([-eccentricity*inputs%bearings(1)%clearance(), 0.0_wp], &
         & [pad_state()]), .false., ok)
      call expect(ok, 'a film at '//to_text(eccentricity))
      force = model%bearings(1)%loads(1)%journal*[1, -1]
   end function forces_of

   !> Narrow bearings: half of the oil film, Ocvirk's forces. The flow along the arc, which they leave out, is of the
   !> order of the square of L/D: errors fall fourfold with L/D halved, but for what is left of the fourth order, most
   !> where the film is thin: a tenth. With the condition of Reynolds the film is the same, and volumes err by 2e-3.
   subroutine short_bearing()
      real(wp), parameter :: e(3) = [0.2_wp, 0.5_wp, 0.8_wp]
      type(case_type) :: inputs
      real(wp) :: exact(2), off(0:2), ratio
      integer :: i, k
      do i = 1, size(e)
         do k = 0, 2
            inputs = fixed_case([-90.0_wp], [360.0_wp], 0.1_wp/2**k)
            associate (b => inputs)
               exact = b%bearings(1)%viscosity*b%operation%speed_rpm*rpm*b%bearings(1)%journal_radius &
                  & *b%bearings(1)%axial_length(1)**3/b%bearings(1)%clearance()**2 &
                  & *e(i)/(1 - e(i)**2)**2*[e(i), pi/4*sqrt(1 - e(i)**2)]
            end associate
            off(k) = norm2(forces_of(0.1_wp/2**k, e(i), 'gumbel', 'fourier') - exact)/norm2(exact)
         end do
         do k = 1, 2
            ratio = off(k - 1)/off(k)
            call expect_close(ratio, 4.0_wp, 0.4_wp, 'order two, '//to_text(e(i)))
         end do
         call expect(off(2) < 5e-3_wp, 'close to Ocvirk: '//to_text(off(2)))
         off(0) = norm2(forces_of(0.025_wp, e(i), 'reynolds', 'direct') - exact)/norm2(exact)
         call expect_close(off(0), 0.0_wp, off(2) + 2e-3_wp, 'with the condition of Reynolds')
      end do
   end subroutine short_bearing

   !> Long bearings: Sommerfeld's force, without cavitation, and half of the film, Guembel's. The ends cost a length
   !> that does not grow with the bearing, and what they do beyond that falls off exponentially: errors fall by half
   !> with L/D doubled, and the extrapolated force errs as the modes do, 1e-4 (docs/theory/film.md).
   subroutine long_bearing()
      real(wp), parameter :: e(3) = [0.2_wp, 0.5_wp, 0.8_wp]
      type(case_type) :: inputs
      real(wp) :: exact(2), forces(2, 0:2), found(2), unit
      integer :: i, k, whole
      do i = 1, size(e)
         do whole = 0, 1
            do k = 0, 2
               inputs = fixed_case([-90.0_wp], [360.0_wp], 6.0_wp*2**k)
               associate (b => inputs)
                  unit = 12*b%bearings(1)%viscosity*b%operation%speed_rpm*rpm*b%bearings(1)%journal_radius &
                     & *((b%bearings(1)%journal_radius + b%bearings(1)%clearance())/b%bearings(1)%clearance())**2 &
                     & *b%bearings(1)%axial_length(1)
               end associate
               if (whole == 1) forces(:, k) = forces_of(6.0_wp*2**k, e(i), 'none', 'fourier')/unit
               if (whole == 0) forces(:, k) = forces_of(6.0_wp*2**k, e(i), 'gumbel', 'fourier')/unit
            end do
            exact = e(i)/(2 + e(i)**2)*[0.0_wp, pi/sqrt(1 - e(i)**2)]
            if (whole == 0) exact = e(i)/(2 + e(i)**2)*[e(i)/(1 - e(i)**2), 0.5_wp*pi/sqrt(1 - e(i)**2)]
            do k = 1, 2
               call expect_close(norm2(forces(:, k - 1) - exact)/norm2(forces(:, k) - exact), 2.0_wp, 0.01_wp, &
                  & 'the ends, '//to_text(e(i)))
            end do
            found = 2*forces(:, 2) - forces(:, 1)
            call expect_close(norm2(found - exact), 0.0_wp, 1e-4_wp*norm2(exact), 'without ends, '//to_text(e(i)))
         end do
      end do
   end subroutine long_bearing

   !> The bearing of Lund and Thomsen: two pads of 160 degrees, grooves at the horizontal split.
   type(case_type) function two_grooves(length_ratio) result(inputs)
      real(wp), intent(in) :: length_ratio
      inputs = fixed_case([-90.0_wp, 90.0_wp], [160.0_wp, 160.0_wp], length_ratio)
   end function two_grooves

   !> The equilibrium at a Sommerfeld number mu N L D/W (R/c)^2: by the viscosity.
   subroutine rest_at(inputs, sommerfeld, rest, model)
      type(case_type), intent(inout) :: inputs
      real(wp), intent(in) :: sommerfeld
      type(static_state_type), intent(out) :: rest
      type(machine_model), intent(out) :: model
      type(equilibrium_type) :: found
      type(error_type), allocatable :: error
      real(wp) :: load, k(2, 2), c(2, 2)
      logical :: ok
      load = inputs%rotor%mass*inputs%rotor%gravity
      associate (b => inputs%bearings(1))
         b%viscosity = sommerfeld*load*(inputs%bearings(1)%clearance()/b%journal_radius)**2 &
            & /(inputs%operation%speed_rpm/60*b%axial_length(1)*2*b%journal_radius)
      end associate
      model = new_machine_model(inputs)
      call find_equilibrium(model, found, error)
      call expect_no_error(error, 'an equilibrium at S = '//to_text(sommerfeld))
      if (allocated(error)) return
      rest%sommerfeld = sommerfeld
      rest%eccentricity = norm2(found%rotor)/inputs%bearings(1)%clearance()
      rest%attitude = atan2(-found%rotor(2), -found%rotor(1))/degree
      call model%evaluate(0.0_wp, model%static_state(found%rotor, found%pads), .true., ok)
      call expect(ok, 'derivatives at S = '//to_text(sommerfeld))
      call force_derivatives(model, k, c)
      ! along the load is -y, across it, in the sense of the rotation, -z: both turn the signs of no coefficient
      associate (scale => inputs%bearings(1)%clearance()/load)
         rest%stiffness = -scale*[k(1, 1), k(1, 2), k(2, 1), k(2, 2)]
         rest%damping = -scale*inputs%operation%speed_rpm*rpm*[c(1, 1), c(1, 2), c(2, 1), c(2, 2)]
      end associate
   end subroutine rest_at

   !> Lund and Thomsen (1978), two pads of 160 degrees with a load between the grooves, as Nicholas, Barrett and Leader
   !> (1980) use them. Their numbers come from a grid of finite differences and are rounded; this program's own grid
   !> errs by 1 % of a coefficient at most. So 3 % of each number, and half a unit of its last digit.
   subroutine lund_thomsen()
      call compare_with(0.5_wp, static_state_type(1.656_wp, 0.244_wp, 65.85_wp, [1.69_wp, 5.06_wp, -2.20_wp, 1.95_wp], &
         & [9.93_wp, 2.15_wp, 2.15_wp, 4.80_wp]))
      call compare_with(0.5_wp, static_state_type(0.244_wp, 0.655_wp, 40.25_wp, [4.21_wp, 3.74_wp, -0.13_wp, 1.64_wp], &
         & [6.87_wp, 1.82_wp, 1.82_wp, 1.54_wp]))
      call compare_with(1.0_wp, static_state_type(0.235_wp, 0.460_wp, 49.27_wp, [2.19_wp, 3.57_wp, -0.80_wp, 1.55_wp], &
         & [7.36_wp, 1.89_wp, 1.89_wp, 2.19_wp]))
   end subroutine lund_thomsen

   subroutine compare_with(length_ratio, table)
      real(wp), intent(in) :: length_ratio
      type(static_state_type), intent(in) :: table
      type(case_type) :: inputs
      type(static_state_type) :: rest
      type(machine_model) :: model
      integer :: k
      character(len=:), allocatable :: what
      inputs = two_grooves(length_ratio)
      call rest_at(inputs, table%sommerfeld, rest, model)
      what = ', L/D '//to_text(length_ratio)//', S = '//to_text(table%sommerfeld)
      call expect_close(rest%eccentricity, table%eccentricity, 3e-3_wp*table%eccentricity + 5e-4_wp, &
         & 'eccentricity'//what)
      call expect_close(rest%attitude, table%attitude, 3e-3_wp*table%attitude, 'attitude angle'//what)
      do k = 1, 4
         call expect_close(rest%stiffness(k), table%stiffness(k), 0.03_wp*abs(table%stiffness(k)) + 0.01_wp, &
            & 'stiffness '//to_text(k)//what)
         call expect_close(rest%damping(k), table%damping(k), 0.03_wp*abs(table%damping(k)) + 0.005_wp, &
            & 'damping '//to_text(k)//what)
      end do
      call expect_close(rest%damping(2), rest%damping(3), 1e-3_wp*rest%damping(1), 'damping is symmetric'//what)
   end subroutine compare_with

   !> The bore by plane geometry: around each pivot the circle of radius R_J + c_m whose middle is c_m - c_r beyond that
   !> of the bearing, away from the pivot. Where a bore is cylindrical it does not matter where it is anchored.
   subroutine lobes()
      type(case_type) :: inputs
      type(machine_model) :: model
      type(static_state_type) :: rest, elsewhere
      type(film_motion) :: motion
      type(pad_state) :: still
      real(wp) :: journal(2), middle(2), phi, direction(2), found, expected
      integer :: i, k
      inputs = fixed_case([-100.0_wp, 80.0_wp], [160.0_wp, 150.0_wp], 0.5_wp)
      inputs%bearings(1)%pads%pivot_ratio = [0.9_wp, 0.3_wp]
      inputs%bearings(1)%machined_clearance(:) = 2*inputs%bearings(1)%clearance()
      model = new_machine_model(inputs)
      journal = [1.1e-5_wp, -2.3e-5_wp]
      do i = 1, 2
         associate (pad => model%bearings(1)%pads(i), b => inputs%bearings(1), &
            & angle => inputs%bearings(1)%pads%pivot_angle_deg(i)*degree)
            motion = motion_of(pad%position, frame_of(pad%position, journal_motion(journal), still), &
               & journal_motion(journal), still)
            middle = -(b%machined_clearance(i) - b%assembled_clearance(i))*[sin(angle), cos(angle)]
            do k = 0, 6
               phi = -pad%gap%trailing_angle + k*pad%gap%arc()/6
               direction = [sin(angle + phi), cos(angle + phi)]
               found = pad%gap%thickness(motion, sin(phi), cos(phi))
               expected = b%machined_clearance(i) + dot_product(middle - journal, direction)
               call expect_close(found, expected, 1e-15_wp, 'film thickness of pad '//to_text(i))
            end do
         end associate
      end do
      inputs = two_grooves(0.5_wp)
      call rest_at(inputs, 0.5_wp, rest, model)
      inputs%bearings(1)%pads%pivot_ratio = [0.25_wp, 0.75_wp]
      inputs%bearings(1)%pads%pivot_angle_deg = [-50.0_wp, 50.0_wp]
      call rest_at(inputs, 0.5_wp, elsewhere, model)
      call expect_close(elsewhere%eccentricity, rest%eccentricity, 1e-8_wp, 'anchored elsewhere')
      call expect_close(norm2(elsewhere%stiffness - rest%stiffness), 0.0_wp, 1e-6_wp*norm2(rest%stiffness), &
         & 'its stiffness')
   end subroutine lobes

   !> `direct` and `sor` at their default resolution on arcs of 150 to 360 degrees, which all cavitation, against
   !> film-adapted volumes, extrapolated; and `auto`, whose tables are closer. Errors are over the force
   !> that the full film gives per velocity, times the velocity that drives it. Volumes are of second order: twice as
   !> many err a quarter, or half where cells that cavitate one by one make it rough.
   subroutine wide_films()
      character(len=*), parameter :: solvers(3) = [character(len=6) :: 'direct', 'sor', 'auto']
      real(wp), parameter :: allowed(3) = [1e-3_wp, 5e-3_wp, 2e-4_wp]
      type(case_type) :: inputs
      real(wp) :: worst(3), finer, place(2), drive(2)
      integer :: i, k
      worst = 0
      finer = 0
      do i = 1, 16
         inputs = fixed_case([-90.0_wp], [between(150.0_wp, 360.0_wp)], between(0.3_wp, 1.2_wp))
         place = [between(0.1_wp, 0.93_wp), between(-pi, pi)]
         drive = [between(0.0_wp, 0.3_wp), between(-pi, pi)]
         do k = 1, size(solvers)
            worst(k) = max(worst(k), error_of(inputs, solvers(k), 1, place, drive))
         end do
         finer = max(finer, error_of(inputs, solvers(1), 2, place, drive))
      end do
      do k = 1, size(solvers)
         print '(2a, es9.1)', 'wide films, largest error of the force, ', solvers(k), worst(k)
         call expect(worst(k) < allowed(k), trim(solvers(k))//': '//to_text(worst(k)))
      end do
      call expect(worst(3) < worst(1), 'tables are closer')
      call expect(finer < 0.5_wp*worst(1), 'twice as fine: '//to_text(finer)//' after '//to_text(worst(1)))
   end subroutine wide_films

   !> Error of the force of a solver with this many times its volumes, with the journal off the middle by a part of the
   !> clearance, towards an angle, and a velocity of a part of clearance times shaft speed, towards another.
   real(wp) function error_of(bearing, solver, finer, place, drive)
      type(case_type), intent(in) :: bearing
      character(len=*), intent(in) :: solver
      integer, intent(in) :: finer
      real(wp), intent(in) :: place(2), drive(2)
      type(case_type) :: inputs
      class(film_solver_type), allocatable :: film
      type(film_response) :: found(1)
      type(film_state) :: state
      type(volumes_type) :: expected, whole
      real(wp) :: surface
      inputs = bearing
      inputs%bearings(1)%film%solver = trim(solver)
      if (finer > 1) then
         inputs%bearings(1)%film%circumferential_cells = finer*80*max(1, nint(inputs%bearings(1)%pads%arc_deg(1)/120))
         inputs%bearings(1)%film%axial_cells = finer*8
      end if
      call make_film(inputs%bearings(1), inputs%integration%relative_tolerance, march_films, film)
      associate (b => inputs%bearings(1), arc => inputs%bearings(1)%pads%arc_deg(1)*degree)
         surface = b%machined_clearance(1)*shaft_speed
         state%gap = pad_gap_type(b%journal_radius, b%machined_clearance(1), b%axial_length(1), 0.5_wp*arc, &
            & 0.5_wp*arc, 0.0_wp, 0.0_wp, 0.0_wp)
         state%motion = film_motion(b%machined_clearance(1)*place(1)*[sin(place(2)), cos(place(2))], &
            & surface*drive(1)*[sin(drive(2)), cos(drive(2))])
      end associate
      expected = extrapolated(new_volumes(state, 16, .true.), new_volumes(state, 32, .true.))
      whole = new_volumes(state, 16, .false.)
      call film%evaluate([state%motion], [paper_oil], shaft_speed, .false., found)
      error_of = norm2(found(1)%force - expected%force) &
         & /(norm2(whole%derivatives(:, 3:))*surface*(place(1)/2 + drive(1)))
   end function error_of

   !> The bearing of Lund and Thomsen with L/D = 1 at S = 0.235 and a rigid rotor, at omega sqrt(c/g).
   subroutine rotor_at(speed, rest, model, found)
      real(wp), intent(in) :: speed
      type(static_state_type), intent(out) :: rest
      type(machine_model), intent(out) :: model
      type(equilibrium_type), intent(out) :: found
      type(case_type) :: inputs
      type(error_type), allocatable :: error
      inputs = two_grooves(1.0_wp)
      inputs%operation%speed_rpm = speed*sqrt(inputs%rotor%gravity/inputs%bearings(1)%clearance())/rpm
      inputs%operation%final_speed_rpm = inputs%operation%speed_rpm
      call rest_at(inputs, 0.235_wp, rest, model)
      call find_equilibrium(model, found, error)
      call expect_no_error(error, 'an equilibrium')
   end subroutine rotor_at

   !> Nicholas, Barrett and Leader (1980): the rotor whirls from omega sqrt(c/g) = 2.1 on, here within half of the last
   !> digit; by the coefficients' own criterion (Lund's), and by the eigenvalues, which cross the axis there at the same
   !> frequency, half the shaft speed.
   subroutine threshold()
      type(static_state_type) :: rest
      type(machine_model) :: model
      type(equilibrium_type) :: found
      real(wp) :: critical, stiffness, ratio
      integer :: i
      call rotor_at(2.1_wp, rest, model, found)
      associate (k => rest%stiffness, c => rest%damping)
         stiffness = (k(1)*c(4) + k(4)*c(1) - k(2)*c(3) - k(3)*c(2))/(c(1) + c(4))
         ratio = sqrt(((k(1) - stiffness)*(k(4) - stiffness) - k(2)*k(3))/(c(1)*c(4) - c(2)*c(3)))
         critical = sqrt(stiffness)/ratio
      end associate
      call expect_close(critical, 2.1_wp, 0.05_wp, 'threshold '//to_text(critical))
      do i = -1, 1, 2
         call rotor_at(critical*(1 + i*1e-3_wp), rest, model, found)
         associate (value => found%stability%eigenvalue, omega => model%point%speed(0.0_wp))
            call expect(i*value%re > 0, 'growth on either side of the threshold speed: '//to_text(value%re))
            call expect_close(value%im/omega, ratio, 1e-3_wp, 'whirl at '//to_text(value%im/omega))
            call expect((found%stability%name == 'oscillatory instability') .eqv. i > 0, 'and its name: ' &
               & //found%stability%name)
         end associate
      end do
   end subroutine threshold

   !> Marches from a little beside the equilibrium, 10 % below and above the threshold speed. Beside that from the
   !> equilibrium itself, at which the films of a march do not quite rest, the whirl dies away, or grows, as its
   !> eigenvalue says, whose slopes are those of other films: growth over shaft speed is uncertain by 1e-3. Above the
   !> threshold speed it ends as an orbit of half the shaft's frequency within the clearance.
   subroutine whirl()
      real(wp), parameter :: beside = 1e-3_wp
      integer, parameter :: revolutions = 150, last = 40
      type(static_state_type) :: rest
      type(machine_model) :: model
      type(equilibrium_type) :: found
      real(wp), allocatable :: places(:, :), still(:, :), size_of(:)
      real(wp) :: growth, order, amplitude
      integer :: i
      logical :: whirls
      do i = -1, 1, 2
         call rotor_at(2.1_wp*(1 + i*0.1_wp), rest, model, found)
         call march_from(model, found, 0.0_wp, 20, still)
         call march_from(model, found, beside, 20, places)
         size_of = sizes(model, places - still)
         growth = log(size_of(20)/size_of(5))/15/(2*pi)
         call expect_close(growth, found%stability%eigenvalue%re/model%point%speed(0.0_wp), 1e-3_wp, &
            & 'growth in a radian')
         call expect(i*growth > 2e-3_wp, 'beyond doubt: '//to_text(growth))
      end do
      call march_from(model, found, beside, revolutions, places)
      size_of = sizes(model, places - spread(found%rotor, 2, size(places, 2)))
      associate (cycle => size_of(revolutions - last + 1:))
         call expect(minval(cycle) > 0.9_wp*maxval(cycle), 'a limit cycle: '//to_text(minval(cycle))//' to ' &
            & //to_text(maxval(cycle))//' clearances')
         call expect(maxval(cycle) < 0.8_wp .and. minval(cycle) > 0.2_wp, 'within the clearance, and large')
      end associate
      associate (end => places(:, (revolutions - last)*samples + 1:))
         call whirl_of(end(1, :), end(2, :), real(last, wp), model%inputs%bearings(1)%clearance(), &
            & order, amplitude, whirls)
      end associate
      call expect(whirls .and. order > 0.4_wp .and. order < 0.52_wp, 'of half the frequency: '//to_text(order))
   end subroutine whirl

   !> Lengths of displacements at most, in clearances, in each revolution.
   pure function sizes(model, displacements)
      type(machine_model), intent(in) :: model
      real(wp), intent(in) :: displacements(:, :)
      real(wp) :: sizes(size(displacements, 2)/samples)
      integer :: i
      do i = 1, size(sizes)
         sizes(i) = maxval(norm2(displacements(:, (i - 1)*samples + 1:i*samples), 1)) &
            & /model%inputs%bearings(1)%clearance()
      end do
   end function sizes

   !> The places of the journal, (y or z, sample), m, of this many revolutions, from a part of the clearance beside its
   !> rest.
   subroutine march_from(model, found, beside, revolutions, places)
      type(machine_model), intent(inout) :: model
      type(equilibrium_type), intent(in) :: found
      real(wp), intent(in) :: beside
      integer, intent(in) :: revolutions
      real(wp), allocatable, intent(out) :: places(:, :)
      real(wp), allocatable :: y(:)
      y = model%static_state(found%rotor + [beside*model%inputs%bearings(1)%clearance(), 0.0_wp], found%pads)
      allocate (places(2, samples*revolutions))
      call march_samples(model, model%scale, [1e-7_wp, 1e-7_wp], y, 0.0_wp, &
         & 2*pi/model%point%speed(0.0_wp)/samples, places)
   end subroutine march_from
end program test_fixed_pads
