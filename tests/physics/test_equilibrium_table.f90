!> Static equilibria: against values that independent programs agree on, against their own balance,
!> and over a wide range of speeds and loads.
program test_equilibrium_table
   use kinds, only: wp, degree
   use text, only: to_text
   use errors, only: error_type, numerics_error
   use case_inputs, only: case_type
   use film_solver, only: film_oil, film_motion, film_response, cavitation_reynolds
   use pad_gap, only: pad_gap_type
   use sor_film, only: sor_film_type, sor_options, new_sor_film
   use state_layout, only: tilt, pivot_deflection
   use equations_of_motion, only: new_machine_model
   use equilibrium_record, only: equilibrium_type
   use equilibrium, only: find_equilibrium
   use input_cases, only: case_of
   use check, only: runs, expect, expect_close, expect_no_error, expect_error, report
   implicit none (type, external)

   !> 0.1 % of the bearing clearance.
   real(wp), parameter :: small = 0.08e-6_wp

   if (runs('tilting_radial_table')) call tilting_radial_table()
   if (runs('tilting_only_table')) then
      call tilting_only_table(6500.0_wp, [-45.561_wp, 0.0234_wp], [-0.0920_wp, 0.9159_wp], 41.514_wp)
      call tilting_only_table(3000.0_wp, [-64.229_wp, 0.0174_wp], [-0.2848_wp, 1.1362_wp], 29.154_wp)
      call tilting_only_table(1500.0_wp, [-77.619_wp, 0.0129_wp], [-0.4295_wp, 1.2879_wp], 20.261_wp)
   end if
   if (runs('grid_convergence')) call grid_convergence()
   if (runs('independent_balance')) then
      call independent_balance('tilting_radial')
      call independent_balance('tilting_only')
   end if
   if (runs('wide_range')) then
      call wide_range('tilting_radial')
      call wide_range('tilting_only')
   end if
   if (runs('floating_pads')) call floating_pads()
   if (runs('no_equilibrium')) then
      call no_equilibrium('tilting_radial')
      call no_equilibrium('tilting_only')
   end if
   call report()

contains

   type(case_type) function paper_case(motion, speed_rpm) result(inputs)
      character(len=*), intent(in) :: motion
      real(wp), intent(in) :: speed_rpm
      inputs = case_type()
      inputs%bearings(1)%pads%motion = motion
      inputs%operation%speed_rpm = speed_rpm
      inputs%operation%final_speed_rpm = speed_rpm
   end function paper_case

   type(equilibrium_type) function found_in(inputs) result(found)
      type(case_type), intent(in) :: inputs
      type(error_type), allocatable :: error
      call find_equilibrium(new_machine_model(inputs), found, error)
      call expect_no_error(error, 'found: '//inputs%bearings(1)%pads%motion//', '//to_text(inputs%operation%speed_rpm) &
         & //' rpm')
   end function found_in

   !> Places of the journal, um, tilts, mrad, and films, um, in the units of the table; a tilt of 0.1 % of the
   !> clearance at the pad's edge is 2.6e-3 mrad.
   subroutine expect_place(found, journal, angles, film, what)
      type(equilibrium_type), intent(in) :: found
      real(wp), intent(in) :: journal(2), angles(2), film
      character(len=*), intent(in) :: what
      call expect_close(found%rotor(1), journal(1)*1e-6_wp, small, 'journal y, '//what)
      call expect_close(found%rotor(2), journal(2)*1e-6_wp, small, 'journal z, '//what)
      call expect_close(maxval(abs(found%pads%x(tilt) - angles*1e-3_wp)), 0.0_wp, 2.6e-6_wp, 'tilts, '//what)
      call expect_close(minval(found%min_film_thickness), film*1e-6_wp, small, 'minimum film thickness, '//what)
      call expect(found%residual <= 1e-8_wp, 'residual, '//what)
   end subroutine expect_place

   subroutine tilting_radial_table()
      type(equilibrium_type) :: found
      type(case_type) :: inputs
      integer :: k
      character(len=4), parameter :: solvers(2) = ['auto', 'sor ']
      inputs = paper_case('tilting_radial', 6500.0_wp)
      do k = 1, 2
         inputs%bearings(1)%film%solver = trim(solvers(k))
         found = found_in(inputs)
         call expect_place(found, [-55.595_wp, 0.0266_wp], [-0.2029_wp, 1.0269_wp], 41.512_wp, 'TR 6500 '//solvers(k))
         ! the pivots are 2 MN/mm stiff: their pivot deflection follows the load, to its 1e-4, and not the film
         call expect_close(found%pads(1)%x(pivot_deflection), 7.0915e-6_wp, 1e-9_wp, 'pivot deflection 1, '//solvers(k))
         call expect_close(found%pads(2)%x(pivot_deflection), 7.0870e-6_wp, 1e-9_wp, 'pivot deflection 2, '//solvers(k))
      end do
   end subroutine tilting_radial_table

   subroutine tilting_only_table(speed_rpm, journal, tilt, film)
      real(wp), intent(in) :: speed_rpm, journal(2), tilt(2), film
      type(case_type) :: inputs
      inputs = paper_case('tilting_only', speed_rpm)
      call expect_place(found_in(inputs), journal, tilt, film, 'TO '//to_text(speed_rpm))
      inputs%bearings(1)%film%solver = 'sor'
      call expect_place(found_in(inputs), journal, tilt, film, 'TO sor '//to_text(speed_rpm))
   end subroutine tilting_only_table

   !> The over-relaxed film is of second order, so the journal's place is too: errors against the converged
   !> value, known to 0.001 um, fall fourfold from 30 x 8 to 60 x 16 and to 120 x 32 cells (to a third or less), and
   !> extrapolation from the two finest meets it within its last digit.
   subroutine grid_convergence()
      type(case_type) :: inputs
      type(equilibrium_type) :: found
      real(wp) :: off(0:2)
      integer :: k
      inputs = paper_case('tilting_only', 6500.0_wp)
      inputs%bearings(1)%film%solver = 'sor'
      do k = 0, 2
         inputs%bearings(1)%film%circumferential_cells = 30*2**k
         inputs%bearings(1)%film%axial_cells = 8*2**k
         found = found_in(inputs)
         off(k) = found%rotor(1) + 45.561e-6_wp
      end do
      call expect(abs(off(1)) < 0.35_wp*abs(off(0)), 'closer on 60 x 16 cells: '//to_text(off(0))//' '//to_text(off(1)))
      call expect(abs(off(2)) < 0.35_wp*abs(off(1)), 'closer on 120 x 32 cells: '//to_text(off(1))//' ' &
         & //to_text(off(2)))
      call expect_close((4*off(2) - off(1))/3, 0.0_wp, 1e-9_wp, 'extrapolated journal')
      inputs = paper_case('tilting_only', 6500.0_wp)
      found = found_in(inputs)
      call expect_close(found%rotor(1), -45.561e-6_wp, 1e-9_wp, 'axial modes are there already')
   end subroutine grid_convergence

   !> Forces at the place found, from films set up and measured anew: gaps from the plane geometry of the pad
   !> and a film solution of its own, converged to 1e-10 (amplified by 1e3: 1e-7 of a film force).
   subroutine independent_balance(motion)
      character(len=*), intent(in) :: motion
      type(case_type) :: inputs
      type(equilibrium_type) :: found
      type(sor_film_type) :: solver
      type(pad_gap_type) :: film
      type(film_response) :: r
      real(wp) :: total(2), a, theta, pivot(2), centre(2), e(2), load, along(2), outward(2), weight
      integer :: pad
      inputs = paper_case(motion, 4000.0_wp)
      inputs%bearings(1)%film%solver = 'sor'
      inputs%bearings(1)%film%cavitation = 'reynolds'
      inputs%rotor%static_load = [1e3_wp, 5e3_wp]
      inputs%bearings(1)%pads%pivot_ratio = 0.55_wp
      inputs%bearings(1)%pads%centre_tangential = 3e-3_wp
      found = found_in(inputs)
      associate (b => inputs%bearings(1), p => inputs%bearings(1)%pads)
         film = pad_gap_type(b%journal_radius, b%machined_clearance(1), b%axial_length(1), 0.55_wp*69.3_wp*degree, &
            & 0.45_wp*69.3_wp*degree, 0.0_wp, 0.0_wp, 0.0_wp)
         solver = new_sor_film([film, film], sor_options(tolerance=1e-10_wp, max_sweeps=100000, &
            & cavitation=cavitation_reynolds))
         total = [-2000*9.81_wp + 1e3_wp, 5e3_wp]
         load = norm2(total)
         do pad = 1, 2
            theta = p%pivot_angle_deg(pad)*degree
            a = theta - found%pads(pad)%x(tilt)
            along = [cos(a), -sin(a)]
            outward = [sin(a), cos(a)]
            pivot = (b%journal_radius + b%assembled_clearance(pad) + p%pivot_distance(pad) &
               & + found%pads(pad)%x(pivot_deflection))*[sin(theta), cos(theta)]
            centre = pivot - (b%journal_radius + b%machined_clearance(pad) + p%pivot_distance(pad))*outward
            e = found%rotor - centre
            call solver%evaluate_pad(pad, film_motion([dot_product(e, along), dot_product(e, outward)]), &
               & film_oil(b%viscosity), inputs%highest_speed(), .false., r)
            total = total + r%force(1)*along + r%force(2)*outward
            weight = p%mass(pad)*9.81_wp
            ! moments about the pivot over its distance; forces along the pad's radius
            call expect_close(r%force(1) + weight*(3e-3_wp*sin(a) - p%centre_radial(pad)*cos(a)) &
               & /(b%journal_radius + b%machined_clearance(pad) + p%pivot_distance(pad)), 0.0_wp, 1e-6_wp*load, &
               & 'moments on pad '//to_text(pad)//', '//motion)
            call expect_close(-r%force(2) - weight*sin(a), found%pivot_load(pad), 1e-6_wp*load, &
               & 'contact of pad '//to_text(pad)//', '//motion)
            call expect_close(found%max_pressure(pad), r%max_pressure, 1e-6_wp*r%max_pressure, 'highest pressure')
         end do
      end associate
      call expect_close(norm2(total), 0.0_wp, 1e-6_wp*load, 'forces on the journal, '//motion)
   end subroutine independent_balance

   !> 300 to 15000 rpm, 0.1 to 3 times the load: the journal is found everywhere, on films that are open, and
   !> higher with speed and lower with load.
   subroutine wide_range(motion)
      character(len=*), intent(in) :: motion
      real(wp), parameter :: speeds(*) = [300.0_wp, 1000.0_wp, 3500.0_wp, 15000.0_wp], loads(*) = [0.1_wp, 0.5_wp, &
         & 3.0_wp]
      type(case_type) :: inputs
      type(equilibrium_type) :: found
      real(wp) :: height(size(speeds), size(loads))
      integer :: i, k
      height = 0
      do i = 1, size(speeds)
         do k = 1, size(loads)
            inputs = paper_case(motion, speeds(i))
            inputs%rotor%static_load = [-(loads(k) - 1)*2000*9.81_wp, 0.0_wp]
            found = found_in(inputs)
            height(i, k) = found%rotor(1)
            if (allocated(found%min_film_thickness)) call expect(minval(found%min_film_thickness) > 0, 'films are open')
         end do
      end do
      call expect(all(height(2:, :) > height(:size(speeds) - 1, :)), 'higher with speed, '//motion)
      call expect(all(height(:, 2:) < height(:, :size(loads) - 1)), 'lower with load, '//motion)
   end subroutine wide_range

   !> Two light pads above the journal float off their pivots, pads tighter than the clearance: their rest is found.
   subroutine floating_pads()
      type(equilibrium_type) :: found
      found = found_in(case_of('&bearing journal_radius = 0.074, machined_clearance = 74e-6, ' &
         & //'assembled_clearance = 89e-6, axial_length = 0.1, viscosity = 0.023 / &rotor mass = 46 / ' &
         & //'&operation speed_rpm = 1000 / &pivot socket_radius = 0.026, radius_difference = 17e-6 / ' &
         & //'&pads pivot_angle_deg = 126, 198, 270, 342, 54, arc_deg = 44, 56, 52, 66, 26, pivot_ratio = 0.52, ' &
         & //'mass = 0.88, 0.73, 0.53, 0.91, 0.69, inertia = 0.38e-3, 0.43e-3, 0.28e-3, 0.68e-3, 0.17e-3, ' &
         & //'centre_tangential = 0, centre_radial = -0.012 /'))
      if (.not. allocated(found%pads)) return
      call expect(found%residual <= 1e-8_wp, 'at rest')
      call expect(found%stability%name /= 'static instability', 'where a motion can start')
      call expect(any(found%pads%x(pivot_deflection) < 0), 'with a pad that floats')
   end subroutine floating_pads

   !> A load away from the two lower pads is carried by nothing: that is told, in words.
   subroutine no_equilibrium(motion)
      character(len=*), intent(in) :: motion
      type(case_type) :: inputs
      type(equilibrium_type) :: found
      type(error_type), allocatable :: error
      inputs = paper_case(motion, 3000.0_wp)
      inputs%rotor%static_load = [3*2000*9.81_wp, 0.0_wp]
      call find_equilibrium(new_machine_model(inputs), found, error)
      call expect_error(error, numerics_error, 'no equilibrium found', 'a load away from the pads, '//motion)
   end subroutine no_equilibrium
end program test_equilibrium_table
