!> Losses and flows of films: against sums over finite volumes that share only the pressure with them, analytic limits,
!> balances of oil and power, and the values of an independent program.
program test_losses
   use kinds, only: wp, pi, degree
   use errors, only: error_type
   use case_inputs, only: case_type
   use case_completion, only: complete_case
   use film_solver, only: film_oil, film_motion, film_response, film_counters, film_ok, film_closed, cavitation_none, &
      & cavitation_gumbel, cavitation_reynolds
   use pad_gap, only: pad_gap_type
   use film_grid, only: film_grid_type
   use elimination_film, only: elimination_film_type, new_elimination_film
   use film_losses, only: film_losses_type, film_loss, new_film_losses
   use random_films, only: film_state, random_film, shown, shaft_speed
   use equations_of_motion, only: machine_model, new_machine_model
   use equilibrium_record, only: equilibrium_type, static_figures_type, find_static_figures
   use equilibrium, only: find_equilibrium
   use paper_bearing, only: paper_oil, paper_pad, offset_pad
   use check, only: runs, expect, expect_close, expect_no_error, between, report
   implicit none (type, external)

   if (runs('independent_program')) call independent_program()
   if (runs('petroff')) call petroff()
   if (runs('closed')) call closed()
   if (runs('whole_by_volumes')) call whole_by_volumes()
   if (runs('cavitated_by_volumes')) call cavitated_by_volumes()
   if (runs('clipped')) call clipped()
   if (runs('under_pressure')) call under_pressure()
   if (runs('oil_is_kept')) call oil_is_kept()
   if (runs('power_is_kept')) call power_is_kept()
   if (runs('raimondi_boyd')) call raimondi_boyd()
   if (runs('even_strip_under_pressure')) call even_strip_under_pressure()
   if (runs('supply_by_volumes')) call supply_by_volumes()
   if (runs('onset_of_cavitation')) call onset_of_cavitation()
   call report()

contains

   !> Loss and flows of a film on a grid by the plain sums: q = U h/2 + h^3/(12 mu) dp/dX over the edges, the square of
   !> the pressure's gradient and 1/h over the area. With cavitation a row of the film leaves off at its first empty
   !> cell downstream, and the oil that crosses there goes on to the trailing edge; heat of sliding by its share of the
   !> gap.
   type(film_loss) function by_volumes(gap, motion, speed, columns, rows, cavitates) result(loss)
      type(pad_gap_type), intent(in) :: gap
      type(film_motion), intent(in) :: motion
      real(wp), intent(in) :: speed
      integer, intent(in) :: columns, rows
      logical, intent(in) :: cavitates
      type(elimination_film_type) :: film
      type(film_grid_type) :: grid
      type(film_response) :: response
      type(film_counters) :: unused
      real(wp), allocatable :: p(:, :), cells(:, :)
      real(wp) :: to_flow, width, surface, drop, carried, filled
      integer :: i, k
      film = new_elimination_film(gap, columns, rows)
      call film%evaluate(motion, paper_oil, speed, cavitates, .false., unused, response)
      call film%cells(grid, p, cells)
      surface = speed*gap%journal_radius
      to_flow = grid%d_phi/(12*paper_oil%viscosity*gap%pad_radius())
      loss%force = response%force
      if (cavitates) p(:rows, :) = p(:rows, :)*cells(:rows, :)
      do k = 1, rows
         width = 2*grid%d_z*grid%height(k)
         drop = grid%supply - p(k, columns)
         carried = surface*grid%h_face(columns)/2 + to_flow*grid%along(columns)*drop
         loss%inlet = loss%inlet + width*carried
         loss%pressure = loss%pressure + width*to_flow*grid%along(columns)*drop**2
         do i = columns, 1, -1
            drop = p(k, i) - grid%ambient
            if (i > 1) drop = p(k, i) - p(k, i - 1)
            filled = 1
            if (cavitates .and. .not. cells(k, i) > 0) then
               if (k > 1) carried = carried + to_flow*grid%beside(i)*grid%inward(k)*p(k - 1, i)
               if (k < rows) carried = carried + to_flow*grid%beside(i)*grid%outward(k)*p(k + 1, i)
               filled = min(1.0_wp, 2*carried/(surface*grid%h_cell(i)))
            else
               carried = surface*grid%h_face(i - 1)/2 + to_flow*grid%along(i - 1)*drop
            end if
            loss%pressure = loss%pressure + width*to_flow*grid%along(i - 1)*drop**2
            loss%couette = loss%couette + width*gap%pad_radius()*grid%d_phi*paper_oil%viscosity*surface**2*filled &
               & /grid%h_cell(i)
            drop = p(k, i) - grid%ambient
            if (k < rows) drop = p(k, i) - p(k + 1, i)
            loss%pressure = loss%pressure + width*to_flow*grid%beside(i)*grid%outward(k)*drop**2
            if (k == rows) loss%side = loss%side + width*to_flow*grid%beside(i)*grid%outward(k)*drop
         end do
         loss%outlet = loss%outlet + width*carried
      end do
   end function by_volumes

   !> What two grids tell of one that is infinitely fine.
   type(film_loss) function extrapolated(gap, motion, speed, columns, rows, cavitates) result(loss)
      type(pad_gap_type), intent(in) :: gap
      type(film_motion), intent(in) :: motion
      real(wp), intent(in) :: speed
      integer, intent(in) :: columns, rows
      logical, intent(in) :: cavitates
      type(film_loss) :: coarse
      coarse = by_volumes(gap, motion, speed, columns, rows, cavitates)
      loss = by_volumes(gap, motion, speed, 2*columns, 2*rows, cavitates)
      loss%couette = (4*loss%couette - coarse%couette)/3
      loss%pressure = (4*loss%pressure - coarse%pressure)/3
      loss%inlet = (4*loss%inlet - coarse%inlet)/3
      loss%outlet = (4*loss%outlet - coarse%outlet)/3
      loss%side = (4*loss%side - coarse%side)/3
   end function extrapolated

   !> With the paper's oil or another.
   type(film_loss) function found(gap, motion, speed, condition, oil) result(loss)
      type(pad_gap_type), intent(in) :: gap
      type(film_motion), intent(in) :: motion
      real(wp), intent(in) :: speed
      integer, intent(in) :: condition
      type(film_oil), intent(in), optional :: oil
      type(film_losses_type) :: losses
      type(film_oil) :: used
      used = paper_oil
      if (present(oil)) used = oil
      losses = new_film_losses(gap, condition)
      call losses%find(motion, used, speed, loss)
   end function found

   !> Largest error of losses over both, and of flows over U h L/2 at the thicker edge and the largest of them.
   real(wp) function difference(gap, motion, speed, a, b)
      type(pad_gap_type), intent(in) :: gap
      type(film_motion), intent(in) :: motion
      real(wp), intent(in) :: speed
      type(film_loss), intent(in) :: a, b
      real(wp) :: flow
      associate (d => gap%directions())
         flow = max(speed*gap%journal_radius*gap%axial_length/2*maxval(gap%thickness(motion, [d%leading(1), &
            & d%trailing(1)], [d%leading(2), d%trailing(2)])), abs(b%inlet), abs(b%outlet), abs(b%side))
      end associate
      difference = max(abs(a%couette - b%couette)/b%couette, abs(a%pressure - b%pressure)/(b%couette + b%pressure), &
         & abs(a%inlet - b%inlet)/flow, abs(a%outlet - b%outlet)/flow, abs(a%side - b%side)/flow)
   end function difference

   !> The paper's bearing with rigid pivots at 6500 rpm, figures of a program that shares no code with this one, to
   !> the digits given.
   subroutine independent_program()
      type(case_type) :: inputs
      type(equilibrium_type) :: static
      type(static_figures_type) :: figures
      type(error_type), allocatable :: error
      type(machine_model) :: model
      inputs = case_type()
      inputs%bearings(1)%pads%motion = 'tilting_only'
      call complete_case(inputs, error)
      model = new_machine_model(inputs)
      call find_equilibrium(model, static, error)
      call expect_no_error(error, 'equilibrium')
      call find_static_figures(model, static, figures)
      associate (pad => figures%pads(1))
         call expect_close(pad%couette, 2684.97_wp, 1.5e-5_wp*2684.97_wp, 'Couette loss')
         call expect_close(pad%pressure, 124.15_wp, 0.005_wp + 1e-5_wp*124.15_wp, 'pressure loss')
         call expect_close(1e6_wp*pad%inlet, 91.06_wp, 0.005_wp + 1e-5_wp*91.06_wp, 'inflow')
         call expect_close(1e6_wp*pad%outlet, 76.22_wp, 0.005_wp + 1e-5_wp*76.22_wp, 'outflow')
         call expect_close(pad%load, static%pivot_load(1) - 0.8108_wp*9.81_wp*sin(45*degree), 1.0_wp, &
            & 'the pivot carries load and pad')
      end associate
      call expect_close(figures%eccentricity_ratio, 0.56951_wp, 2e-5_wp, 'eccentricity ratio, -45.561 um')
      ! to the side of +z, while the journal at the bottom moves towards -z
      call expect_close(figures%attitude_angle, -0.0234_wp/45.561_wp, 2e-6_wp, 'attitude angle')
      call expect(figures%rise_fresh > maxval(figures%temperature_rise)*0.8_wp .and. figures%rise_side > &
         & 5*figures%rise_fresh, 'warming')
   end subroutine independent_program

   !> Petroff: journal in the middle of the arc, no pressure.
   subroutine petroff()
      type(pad_gap_type) :: gap
      type(film_loss) :: loss
      real(wp) :: surface
      gap = offset_pad()
      loss = found(gap, film_motion(), shaft_speed, cavitation_reynolds)
      surface = shaft_speed*gap%journal_radius
      associate (area => gap%pad_radius()*gap%arc()*gap%axial_length, c => gap%machined_clearance)
         call expect_close(loss%couette, paper_oil%viscosity*surface**2*area/c, 1e-12_wp*loss%couette, 'Petroff')
         call expect_close(loss%inlet, surface*c*gap%axial_length/2, 1e-12_wp*loss%inlet, 'in')
         call expect_close(loss%outlet, loss%inlet, 1e-12_wp*loss%inlet, 'out')
      end associate
      call expect(abs(loss%pressure) + abs(loss%wedge) < 1e-12_wp*loss%couette, 'no pressure')
      call expect(abs(loss%side) < 1e-12_wp*loss%inlet, 'nothing at the sides')
   end subroutine petroff

   subroutine closed()
      type(film_loss) :: loss
      loss = found(paper_pad(), film_motion([0.0_wp, 101e-6_wp]), shaft_speed, cavitation_reynolds)
      call expect(loss%status == film_closed, 'a closed film has no loss')
   end subroutine closed

   !> Modes against volumes on uniform columns, extrapolated from 96 x 12 and 192 x 24.
   subroutine whole_by_volumes()
      type(film_state) :: state
      type(film_loss) :: loss
      real(wp) :: error, worst
      integer :: i
      worst = 0
      do i = 1, 40
         state = random_film(1.0_wp, 4.0_wp, .false., .false.)
         loss = found(state%gap, state%motion, shaft_speed, cavitation_none)
         call expect(loss%status == film_ok, 'open')
         error = difference(state%gap, state%motion, shaft_speed, loss, extrapolated(state%gap, state%motion, &
            & shaft_speed, 96, 12, .false.))
         call expect(error < 2e-4_wp, 'whole: '//shown(state))
         worst = max(worst, error)
      end do
      print '(a, es9.2)', 'full films, largest error ', worst
   end subroutine whole_by_volumes

   !> Film-adapted volumes against four times as many uniform ones: both are of first order where the film
   !> ends, and the flow at the trailing edge of a film that is squeezed is more so, as it is cut off at whole cells.
   subroutine cavitated_by_volumes()
      type(film_state) :: state
      type(film_loss) :: loss, fine
      real(wp) :: error, worst(2)
      integer :: i
      worst = 0
      do i = 1, 40
         state = random_film(1.0_wp, 4.0_wp, .true., .false.)
         if (state%t > 0.95_wp) cycle
         if (mod(i, 2) == 0) state%motion%velocity = 0
         loss = found(state%gap, state%motion, shaft_speed, cavitation_reynolds)
         fine = by_volumes(state%gap, state%motion, shaft_speed, 192, 24, .true.)
         ! a film that reforms takes up more than arrives: the plain sums do not follow it
         if (abs(loss%unfed) > 1e-3_wp*loss%inlet) cycle
         if (mod(i, 2) == 1) fine%outlet = loss%outlet
         error = difference(state%gap, state%motion, shaft_speed, loss, fine)
         worst(1 + mod(i, 2)) = max(worst(1 + mod(i, 2)), error)
         call expect(error < 5e-3_wp, 'cavitated: '//shown(state))
      end do
      print '(a, 2es9.2)', 'cavitated films, largest errors at rest and squeezed ', worst
   end subroutine cavitated_by_volumes

   !> Guembel's condition leaves the field and the flow across the film's edge as they are without cavitation; the
   !> force, and with it the heat of the pressure flow, is that of the clipped pressure.
   subroutine clipped()
      type(film_loss) :: whole, cavitated
      type(pad_gap_type) :: gap
      type(film_motion) :: motion
      gap = paper_pad()
      motion = film_motion([-5e-6_wp, 60e-6_wp])
      whole = found(gap, motion, shaft_speed, cavitation_none)
      cavitated = found(gap, motion, shaft_speed, cavitation_gumbel)
      call expect(cavitated%couette < 0.999_wp*whole%couette, 'less oil, less shear')
      call expect(cavitated%side > whole%side, 'nothing is sucked in at the sides')
      call expect_close(cavitated%inlet, whole%inlet, 1e-3_wp*whole%inlet, 'the film begins at the leading edge')
      call expect_close(cavitated%outlet + cavitated%side, cavitated%inlet + cavitated%unfed, 1e-10_wp*whole%inlet, &
         & 'no oil is lost')
      call expect_close(cavitated%wedge, cavitated%pressure, 1e-10_wp*cavitated%pressure, 'no power is lost')
      ! the same film under a cavitation pressure that it does not reach
      gap%cavitation_pressure = -1e9_wp
      cavitated = found(gap, motion, shaft_speed, cavitation_gumbel)
      call expect(all(abs([cavitated%couette - whole%couette, cavitated%inlet - whole%inlet, &
         & cavitated%side - whole%side]) <= 0), 'whole')
   end subroutine clipped

   !> Edges under pressure drive oil into the cavitation: their work is heat as well. By the plain sums.
   subroutine under_pressure()
      real(wp), parameter :: edges = 3e5_wp
      type(film_loss) :: loss, fine, without
      type(pad_gap_type) :: gap
      type(film_motion) :: motion
      gap = paper_pad([edges, edges, 0.0_wp])
      motion = film_motion([10e-6_wp, 70e-6_wp])
      loss = found(gap, motion, shaft_speed, cavitation_reynolds)
      fine = by_volumes(gap, motion, shaft_speed, 384, 48, .true.)
      call expect_close(loss%pressure, fine%pressure, 1.5e-2_wp*fine%pressure, 'heat of the pressure flow')
      call expect_close(loss%couette, fine%couette, 2e-3_wp*fine%couette, 'heat of sliding')
      gap%ambient_pressure = 0
      gap%supply_pressure = 0
      without = found(gap, motion, shaft_speed, cavitation_reynolds)
      call expect(loss%pressure - without%pressure > 0.02_wp*without%pressure, 'the edges matter')
      call expect(loss%wedge > 1.2_wp*loss%pressure, 'the shaft pumps oil through the cavitation to the edges')
   end subroutine under_pressure

   !> What flows in flows out, less what the growing gap holds back; where a film reforms it takes up more than
   !> arrives. For full films test whole_by_volumes has it, whose side flow is a sum of its own.
   subroutine oil_is_kept()
      type(film_state) :: state
      type(film_loss) :: loss
      integer :: i, again
      again = 0
      do i = 1, 60
         state = random_film(1.0_wp, 10.0_wp, .true., .false.)
         state%motion%velocity = 0
         loss = found(state%gap, state%motion, shaft_speed, cavitation_reynolds)
         call expect_close(loss%outlet + loss%side, loss%inlet + loss%unfed, 1e-9_wp*loss%inlet, 'cavitated: ' &
            & //shown(state))
         if (abs(loss%unfed) > 1e-3_wp*loss%inlet) again = again + 1
      end do
      call expect(again < 30, 'most films do not reform')
   end subroutine oil_is_kept

   !> The journal's rotation, its motion and the pumps bring what becomes heat.
   subroutine power_is_kept()
      type(film_state) :: state
      type(film_loss) :: loss
      real(wp) :: brought, forced
      integer :: i
      do i = 1, 60
         state = random_film(1.0_wp, 10.0_wp, .true., mod(i, 3) == 0)
         loss = found(state%gap, state%motion, shaft_speed, merge(cavitation_reynolds, cavitation_none, mod(i, 2) == 0))
         forced = -dot_product(state%motion%velocity, loss%force)
         brought = loss%couette + loss%wedge + forced + state%gap%supply_pressure*loss%inlet
         call expect_close(loss%couette + loss%pressure, brought, 1e-10_wp*(loss%couette + abs(forced) &
            & + abs(loss%wedge)), 'power: '//shown(state))
         call expect(loss%pressure > 0, 'heat is positive: '//shown(state))
      end do
   end subroutine power_is_kept

   !> Full bearings that draw oil at the thickest place: tables of Raimondi and Boyd, ASLE Transactions 1 (1958), which
   !> come from differences on a coarse grid and count a full gap in the cavitated part: Sommerfeld number, attitude
   !> angle, friction R/c, flow over R c N L, share of it that leaves at the sides.
   subroutine raimondi_boyd()
      real(wp), parameter :: tables(7, 8) = reshape([ &
         & 1.0_wp, 0.2_wp, 0.631_wp, 74.02_wp, 12.8_wp, 3.59_wp, 0.280_wp, &
         & 1.0_wp, 0.4_wp, 0.264_wp, 63.10_wp, 5.79_wp, 3.99_wp, 0.497_wp, &
         & 1.0_wp, 0.6_wp, 0.121_wp, 50.58_wp, 3.22_wp, 4.33_wp, 0.680_wp, &
         & 1.0_wp, 0.8_wp, 0.0446_wp, 36.24_wp, 1.70_wp, 4.62_wp, 0.842_wp, &
         & 0.5_wp, 0.2_wp, 2.03_wp, 74.94_wp, 40.9_wp, 3.72_wp, 0.318_wp, &
         & 0.5_wp, 0.4_wp, 0.779_wp, 61.45_wp, 17.0_wp, 4.29_wp, 0.552_wp, &
         & 0.5_wp, 0.6_wp, 0.319_wp, 48.14_wp, 8.10_wp, 4.85_wp, 0.730_wp, &
         & 0.5_wp, 0.8_wp, 0.0923_wp, 33.31_wp, 3.26_wp, 5.41_wp, 0.874_wp], [7, 8])
      real(wp), parameter :: radius = 50e-3_wp, clearance = 10e-6_wp, speed = 300, viscosity = 0.02_wp
      type(film_loss) :: loss, whole
      real(wp) :: load, length, friction
      integer :: i
      do i = 1, size(tables, 2)
         length = 2*radius*tables(1, i)
         associate (gap => pad_gap_type(radius, clearance, length, 0.9999999_wp*pi, 0.9999999_wp*pi, 0.0_wp, &
            & 0.0_wp, 0.0_wp), motion => film_motion([0.0_wp, clearance*tables(2, i)]))
            loss = found(gap, motion, speed, cavitation_reynolds, film_oil(viscosity))
            whole = found(gap, motion, speed, cavitation_none, film_oil(viscosity))
         end associate
         load = norm2(loss%force)
         friction = (whole%couette + loss%wedge)/(speed*radius*load)*radius/clearance
         call within(viscosity*speed/pi*radius*length/load*(radius/clearance)**2, tables(3, i), 0.015_wp, &
            & 'Sommerfeld number')
         call within(atan2(abs(loss%force(1)), abs(loss%force(2)))/degree, tables(4, i), 0.012_wp, 'attitude angle')
         call within(friction, tables(5, i), 0.01_wp, 'friction of a full gap')
         call expect(loss%couette < whole%couette, 'streamers shear less')
         call within(loss%inlet/(radius*clearance*speed/(2*pi)*length), tables(6, i), 0.002_wp, 'inlet flow')
         call within(loss%side/loss%inlet, tables(7, i), 0.004_wp, 'side flow')
         print '(a, 2f4.1, a, 5f9.4)', 'L/D, e/c', tables(1:2, i), ': S, Q_in, side share, friction, with streamers', &
            & viscosity*speed/pi*radius*length/load*(radius/clearance)**2, loss%inlet/(radius*clearance*speed/(2*pi) &
            & *length), loss%side/loss%inlet, friction, friction*(loss%couette + loss%wedge) &
            & /(whole%couette + loss%wedge)
      end do
   end subroutine raimondi_boyd

   !> Relative error below a limit.
   subroutine within(value, expected, limit, what)
      real(wp), intent(in) :: value, expected, limit
      character(len=*), intent(in) :: what
      call expect_close(value, expected, limit*expected, what)
   end subroutine within

   !> An even film at rest under pressure: every mode is a hyperbolic sine, and their sum without the corners, a film
   !> thickness wide, is an integral in closed form.
   subroutine even_strip_under_pressure()
      real(wp), parameter :: rise = 3e5_wp
      type(pad_gap_type) :: gap
      type(film_loss) :: loss
      real(wp) :: unit, wave, weight, inlet, outlet
      integer :: k
      gap = paper_pad([rise, 0.0_wp, 0.0_wp])
      loss = found(gap, film_motion(), 0.0_wp, cavitation_none)
      associate (c => gap%machined_clearance, r => gap%pad_radius(), l => gap%axial_length)
         unit = rise*c**3/(12*paper_oil%viscosity*r)
         inlet = r*4/pi*log(1/tan(pi*c/(2*l)))
         outlet = 0
         do k = 1, 60
            wave = (2*k - 1)*pi*r/l
            weight = 8*l/((2*k - 1)*pi)**2
            inlet = inlet + weight*wave*(1/tanh(wave*gap%arc()) - 1)
            outlet = outlet + weight*wave/sinh(wave*gap%arc())
         end do
         call expect_close(loss%inlet, unit*inlet, 1e-3_wp*unit*inlet, 'in')
         call expect_close(loss%outlet, unit*outlet, 1e-4_wp*unit*outlet, 'out')
      end associate
      call expect_close(loss%side, loss%inlet - loss%outlet, 1e-12_wp*loss%inlet, 'sides')
      call expect_close(loss%pressure, rise*loss%inlet, 1e-12_wp*loss%pressure, 'the pump heats')
   end subroutine even_strip_under_pressure

   !> Volumes let more oil through the corners the smaller they are, by the same amount whatever the film does
   !> elsewhere: what a film differs by from an even one that is as thick at its leading edge is the same by both.
   subroutine supply_by_volumes()
      real(wp), parameter :: rise = 3e5_wp
      type(pad_gap_type) :: gap, even
      type(film_motion) :: motion
      type(film_loss) :: loss, of_even, fine, fine_of_even
      real(wp) :: unit
      integer :: i
      do i = 1, 6
         gap = offset_pad([rise, 0.0_wp, 0.0_wp])
         motion = film_motion([between(-40e-6_wp, 40e-6_wp), between(-40e-6_wp, 50e-6_wp)])
         even = gap
         associate (d => gap%directions())
            even%machined_clearance = gap%thickness(motion, d%leading(1), d%leading(2))
         end associate
         loss = found(gap, motion, 0.0_wp, cavitation_none)
         of_even = found(even, film_motion(), 0.0_wp, cavitation_none)
         fine = extrapolated(gap, motion, 0.0_wp, 192, 24, .false.)
         fine_of_even = extrapolated(even, film_motion(), 0.0_wp, 192, 24, .false.)
         unit = of_even%inlet
         call expect_close(loss%inlet - of_even%inlet, fine%inlet - fine_of_even%inlet, 4e-3_wp*unit, 'in')
         call expect_close(loss%outlet, fine%outlet, 1e-4_wp*unit, 'out')
      end do
   end subroutine supply_by_volumes

   !> Nothing leaps where a film begins to cavitate.
   subroutine onset_of_cavitation()
      type(pad_gap_type) :: gap
      type(film_motion) :: motion
      type(film_loss) :: whole, cavitated
      real(wp) :: low, high
      integer :: i
      gap = paper_pad()
      low = -40e-6_wp
      high = 40e-6_wp
      do i = 1, 60
         motion = film_motion([0.5_wp*(low + high), 40e-6_wp])
         cavitated = found(gap, motion, shaft_speed, cavitation_reynolds)
         whole = found(gap, motion, shaft_speed, cavitation_none)
         if (abs(cavitated%pressure - whole%pressure) > 0) then
            high = motion%position(1)
         else
            low = motion%position(1)
         end if
      end do
      call expect(low > -40e-6_wp .and. high < 40e-6_wp .and. high - low < 1e-15_wp, 'there is an onset')
      call expect(abs(cavitated%pressure - whole%pressure) < 1e-6_wp*whole%couette .and. abs(cavitated%couette &
         & - whole%couette) < 1e-4_wp*whole%couette, 'losses')
      call expect(maxval(abs([cavitated%inlet - whole%inlet, cavitated%outlet - whole%outlet, cavitated%side &
         & - whole%side])) < 1e-4_wp*whole%inlet, 'flows')
   end subroutine onset_of_cavitation
end program test_losses
