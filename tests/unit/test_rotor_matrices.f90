!> Reduced rotors of machines: check values, textbook rotors, errors of the reduction, invariants, static forces.
program test_rotor_matrices
   use kinds, only: wp, pi, rpm
   use text, only: to_text
   use errors, only: error_type, input_error
   use case_inputs, only: case_type
   use rotor_reduction, only: rotor_matrices_type
   use rotor_factory, only: find_rotor
   use example_machine, only: turbine, plain_shaft, put_bearings, put_disc, put_unbalance, rotor_of, all_modes, &
      & unbalance_response, response_error, static_stations, whirl_frequencies
   use check, only: runs, expect, expect_close, expect_error, report
   implicit none (type, external)
   real(wp), parameter :: gravity = 9.81_wp

   if (runs('check values')) call try_check_values()
   if (runs('textbook rotors')) call try_textbook_rotors()
   if (runs('error of the reduction')) call try_reduction()
   if (runs('damping of high modes')) call try_damping()
   if (runs('invariants')) call try_invariants()
   if (runs('bearing loads')) call try_bearing_loads()
   if (runs('offsets')) call try_offsets()
   if (runs('supports')) call try_supports()
   if (runs('unbalances')) call try_unbalances()
   if (runs('many stations')) call try_many_stations()
   if (runs('refusals')) call try_refusals()
   call report()

contains

   !> The rotor of an independent program: whirl with pinned journals, Hz, and mass.
   subroutine try_check_values()
      type(rotor_matrices_type) :: rotor
      real(wp), allocatable :: frequencies(:)
      real(wp), parameter :: at_rest(3) = [91.8029_wp, 263.5415_wp, 947.0458_wp]
      integer :: i
      rotor = rotor_of(turbine(), 6500*rpm)
      call expect_close(rotor%total_mass, 4000.0_wp, 1e-6_wp, 'mass of the rotor')
      do i = 1, 3
         call expect_close(rotor%mode_frequency(i), at_rest(i), 0.5e-4_wp, 'frequency at rest')
      end do
      rotor = rotor_of(turbine(), 6500*rpm, all_modes)
      associate (i => 2*rotor%journals + 1)
         frequencies = whirl_frequencies(rotor%mass(i:, i:), 6000*rpm*rotor%gyroscopic(i:, i:), rotor%stiffness(i:, i:))
      end associate
      call expect_close(frequencies(3), 192.061_wp, 0.5e-3_wp, 'backward whirl of the conical mode')
      call expect_close(frequencies(4), 360.685_wp, 0.5e-3_wp, 'forward whirl of the conical mode')
   end subroutine try_check_values

   !> Examples of Friswell, Penny, Garvey and Lees, Dynamics of Rotating Machines (2010), at 4000 rpm, rad/s; numbers as
   !> printed there and in the tests of ROSS.
   subroutine try_textbook_rotors()
      call expect_rotor(two_discs(), [1e6_wp, 1e6_wp], [85.39_wp, 87.80_wp, 251.78_wp, 294.71_wp, 600.18_wp, &
         & 827.08_wp], 'example 5.9.1')
      call expect_rotor(two_discs(), [1e6_wp, 8e5_wp], [82.33_wp, 86.86_wp, 239.64_wp, 287.25_wp, 583.49_wp, &
         & 806.89_wp], 'example 5.9.2')
      call expect_rotor(overhung_disc(), [1e7_wp, 1e7_wp], [76.19_wp, 103.91_wp, 565.99_wp, 634.23_wp, 647.75_wp, &
         & 1174.2_wp], 'example 5.9.9')
   end subroutine try_textbook_rotors

   !> Bearings have a stiffness along y and z, N/m.
   subroutine expect_rotor(machine, bearing, frequencies, what)
      type(case_type), intent(in) :: machine
      real(wp), intent(in) :: bearing(2), frequencies(6)
      character(len=*), intent(in) :: what
      type(rotor_matrices_type) :: rotor
      type(case_type) :: undamped
      real(wp), allocatable :: found(:), stiffness(:, :)
      integer :: i
      undamped = machine
      undamped%rotor%elastic%reduction%damping_ratio = 0
      rotor = rotor_of(undamped, 4000*rpm, all_modes)
      stiffness = rotor%stiffness
      do i = 1, 4
         stiffness(i, i) = stiffness(i, i) + bearing(2 - mod(i, 2))
      end do
      found = 2*pi*whirl_frequencies(rotor%mass, rotor%damping + 4000*rpm*rotor%gyroscopic, stiffness)
      print '(a,6f9.2)', what//':', found(:6)
      do i = 1, 6
         call expect_close(found(i), frequencies(i), merge(0.05_wp, 0.005_wp, frequencies(i) > 1000), what)
      end do
   end subroutine expect_rotor

   !> The book's steel, shaft of 1.5 m in six sections.
   function textbook_shaft() result(machine)
      type(case_type) :: machine
      integer :: i
      machine = plain_shaft([(0.25_wp, i=1, 6)], 0.05_wp)
      machine%rotor%elastic%shaft%young_modulus = 211e9_wp
      machine%rotor%elastic%shaft%poisson_ratio = 211e9_wp/(2*81.2e9_wp) - 1
      machine%rotor%elastic%shaft%density = 7810
   end function textbook_shaft

   function two_discs() result(machine)
      type(case_type) :: machine
      machine = textbook_shaft()
      call put_ring(machine, 3, 0.28_wp)
      call put_ring(machine, 5, 0.35_wp)
      call put_bearings(machine, [1, 7])
   end function two_discs

   function overhung_disc() result(machine)
      type(case_type) :: machine
      machine = textbook_shaft()
      call put_ring(machine, 7, 0.35_wp)
      call put_bearings(machine, [1, 5])
   end function overhung_disc

   !> A disc of 70 mm on the shaft.
   subroutine put_ring(machine, station, diameter)
      type(case_type), intent(inout) :: machine
      integer, intent(in) :: station
      real(wp), intent(in) :: diameter
      real(wp) :: mass, squares
      real(wp), parameter :: width = 0.07_wp, bore = 0.05_wp
      squares = diameter**2 + bore**2
      mass = machine%rotor%elastic%shaft%density*pi/4*(diameter**2 - bore**2)*width
      call put_disc(machine, station, mass, mass*squares/8, mass*(squares/16 + width**2/12))
   end subroutine put_ring

   !> A turbine with its disc off the middle and an overhung one.
   function unsymmetric() result(machine)
      type(case_type) :: machine
      machine = turbine()
      machine%rotor%elastic%discs(1)%station = 5
      call put_disc(machine, 13, 300.0_wp, 20.0_wp, 12.0_wp)
      call put_unbalance(machine, 13, 0.003_wp, 70.0_wp)
   end function unsymmetric

   !> Four times as many stations take little more than four times the time, where full matrices took fifty times.
   subroutine try_many_stations()
      real(wp) :: ratio
      ratio = seconds(400)/seconds(100)
      print '(a, f0.1)', '400 stations, time over that of 100: ', ratio
      call expect(ratio < 12, '400 stations take '//to_text(ratio)//' times the time of 100')
   end subroutine try_many_stations

   !> The shortest processor time of three times in which a rotor of this many stations is found, s.
   real(wp) function seconds(stations)
      integer, intent(in) :: stations
      type(case_type) :: machine
      type(rotor_matrices_type) :: rotor
      real(wp) :: begun, ended
      integer :: i
      machine = plain_shaft([(3.0_wp/(stations - 1), i=2, stations)], 0.2_wp)
      call put_disc(machine, stations/2, 800.0_wp, 60.0_wp, 35.0_wp)
      call put_bearings(machine, [2, stations - 1])
      seconds = huge(seconds)
      do i = 1, 3
         call cpu_time(begun)
         rotor = rotor_of(machine, 6000*rpm)
         call cpu_time(ended)
         seconds = min(seconds, ended - begun)
      end do
   end function seconds

   !> Modes are chosen for errors of amplitudes of 1e-4.
   subroutine try_reduction()
      type(case_type) :: machine
      type(rotor_matrices_type) :: rotor
      real(wp), parameter :: springs(4) = [6e8_wp, 3e8_wp, 5e8_wp, 2e8_wp], dampers(4) = 1e6_wp
      real(wp) :: error
      integer :: i
      do i = 1, 2
         machine = turbine()
         if (i == 2) machine = unsymmetric()
         rotor = rotor_of(machine, 6500*rpm)
         call expect(rotor%truncation_error <= 1e-4_wp .and. rotor%truncation_error > 0, 'the estimated error')
         error = response_error(machine, 6500*rpm, springs, dampers)
         call expect(error > 0 .and. error < 2*rotor%truncation_error, 'the error is near the estimate')
         call expect(size(rotor%mode_frequency) <= 8, 'few modes')
         call expect(response_error(machine, 6500*rpm, springs, dampers, 1) > 1e-3_wp, 'one mode is not enough')
         call expect(rotor%left_out_frequency > rotor%mode_frequency(size(rotor%mode_frequency)), 'frequency left out')
      end do
      machine%rotor%elastic%reduction%frequency = 1000
      rotor = rotor_of(machine, 6500*rpm)
      call expect(rotor%mode_frequency(size(rotor%mode_frequency)) <= 1000 .and. rotor%left_out_frequency > 1000, &
         & 'modes up to a frequency')
      rotor = rotor_of(machine, 6500*rpm, 3)
      call expect(size(rotor%mode_frequency) == 3 .and. size(rotor%load) == 4 + 6, 'a given number of modes')
   end subroutine try_reduction

   !> Modes above a frequency have a damping ratio, the others and the journals no damping.
   subroutine try_damping()
      type(case_type) :: machine
      type(rotor_matrices_type) :: rotor
      integer :: i
      machine = turbine()
      rotor = rotor_of(machine, 6500*rpm)
      do i = 1, size(rotor%load)
         if (i <= 4 + 4) then
            call expect_close(rotor%damping(i, i), 0.0_wp, 0.0_wp, 'no damping below 500 Hz')
         else
            call expect_close(rotor%damping(i, i), 2*0.3_wp*sqrt(rotor%stiffness(i, i)), 1e-6_wp, 'damping ratio 0.3')
         end if
      end do
      call expect(rotor%damping_error > 0 .and. rotor%damping_error < 1e-3_wp, 'its error')
      machine%rotor%elastic%reduction%damp_above = 50
      rotor = rotor_of(machine, 6500*rpm)
      call expect(rotor%damping_error > 1e-2_wp, 'damping of the first modes is no small error')
   end subroutine try_damping

   !> The same rotor told in other ways has the same response.
   subroutine try_invariants()
      type(case_type) :: machine, other
      type(rotor_matrices_type) :: rotor
      complex(wp), allocatable :: expected(:), found(:)
      real(wp), parameter :: springs(4) = [6e8_wp, 3e8_wp, 5e8_wp, 2e8_wp]
      real(wp), parameter :: dampers(4) = [1e6_wp, 2e6_wp, 3e6_wp, 4e6_wp]
      real(wp), parameter :: speed = 5000*rpm
      integer :: i
      machine = unsymmetric()
      rotor = rotor_of(machine, 6500*rpm)
      expected = unbalance_response(rotor, speed, springs, dampers)
      ! bearings in another order
      call put_bearings(machine, [12, 2])
      rotor = rotor_of(machine, 6500*rpm)
      found = unbalance_response(rotor, speed, springs([3, 4, 1, 2]), dampers([3, 4, 1, 2]))
      call expect(maxval(abs(found - expected)) < 1e-9_wp*maxval(abs(expected)), 'bearings in another order')
      ! stations counted from the other end
      other = machine
      other%rotor%elastic%shaft%length = machine%rotor%elastic%shaft%length(12:1:-1)
      other%rotor%elastic%shaft%diameter = machine%rotor%elastic%shaft%diameter(12:1:-1)
      other%rotor%elastic%discs%station = 14 - machine%rotor%elastic%discs%station
      other%rotor%elastic%unbalances%station = 14 - machine%rotor%elastic%unbalances%station
      other%bearings%station = 14 - machine%bearings%station
      rotor = rotor_of(other, 6500*rpm)
      found = unbalance_response(rotor, speed, springs([3, 4, 1, 2]), dampers([3, 4, 1, 2]))
      found = [(found(2*(14 - i) - 1), found(2*(14 - i)), i=1, 13)]
      call expect(maxval(abs(found - expected)) < 1e-9_wp*maxval(abs(expected)), 'stations from the other end')
      ! a section of the thick part divided in two: but for the error of the mesh
      call divide_last_thick_section(machine)
      rotor = rotor_of(machine, 6500*rpm)
      found = unbalance_response(rotor, speed, springs([3, 4, 1, 2]), dampers([3, 4, 1, 2]))
      found = [found(:20), found(23:)]
      call expect(maxval(abs(found - expected)) < 1e-3_wp*maxval(abs(expected)), 'a section divided in two')
      call expect(maxval(abs(found - expected)) > 1e-13_wp*maxval(abs(expected)), 'which refines the mesh')
   end subroutine try_invariants

   subroutine divide_last_thick_section(machine)
      type(case_type), intent(inout) :: machine
      associate (s => machine%rotor%elastic%shaft)
         s%length = [s%length(:9), s%length(10)/2, s%length(10)/2, s%length(11:)]
         s%diameter = [s%diameter(:10), s%diameter(10:)]
         s%bore = [s%bore(:10), s%bore(10:)]
      end associate
      associate (discs => machine%rotor%elastic%discs, unbalances => machine%rotor%elastic%unbalances)
         where (discs%station > 10) discs%station = discs%station + 1
         where (unbalances%station > 10) unbalances%station = unbalances%station + 1
      end associate
      where (machine%bearings%station > 10) machine%bearings%station = machine%bearings%station + 1
   end subroutine divide_last_thick_section

   !> Weight and static loads on two bearings by the balance of forces and moments; the shaft sags by beam theory.
   subroutine try_bearing_loads()
      type(case_type) :: machine
      type(rotor_matrices_type) :: rotor
      real(wp), allocatable :: stations(:), x(:)
      real(wp), parameter :: spring = 1e8_wp
      integer :: i
      machine = plain_shaft([(0.25_wp, i=1, 6)], 0.1_wp)
      call put_bearings(machine, [1, 5])
      deallocate (machine%rotor%elastic%loads)
      allocate (machine%rotor%elastic%loads(2))
      machine%rotor%elastic%loads(1)%station = 7
      machine%rotor%elastic%loads(1)%force = [300.0_wp, -500.0_wp]
      machine%rotor%elastic%loads(2)%station = 3
      machine%rotor%elastic%loads(2)%force = [0.0_wp, 700.0_wp]
      rotor = rotor_of(machine, 100.0_wp)
      stations = static_stations(rotor, [spring, spring, spring, spring], x)
      associate (weight => rotor%total_mass*gravity)
         ! the centre of gravity is at 0.75 m, the second bearing at 1 m, the loads at 1.5 m and 0.5 m
         call expect_close(x(3)*spring, -0.75_wp*weight + 1.5_wp*300, 1e-6_wp, 'vertical load of the second bearing')
         call expect_close(x(1)*spring, -0.25_wp*weight - 0.5_wp*300, 1e-6_wp, 'vertical load of the first bearing')
      end associate
      call expect_close(x(4)*spring, -1.5_wp*500 + 0.5_wp*700, 1e-6_wp, 'horizontal load of the second bearing')
      call expect_close(x(2)*spring, 0.5_wp*500 + 0.5_wp*700, 1e-6_wp, 'horizontal load of the first bearing')
      call expect_close(stations(9), x(3), 1e-15_wp, 'the journal is where its station is')
   end subroutine try_bearing_loads

   !> A shaft on three stiff bearings under its weight, the middle one raised: its load is 5/8 of the weight and
   !> 48 E I/L^3 of what it is raised by, where shear does not matter.
   subroutine try_offsets()
      type(case_type) :: machine
      type(rotor_matrices_type) :: rotor
      real(wp), allocatable :: stations(:), x(:)
      real(wp), parameter :: raised = 1e-4_wp, aside = -3e-5_wp, spring = 1e13_wp, span = 4.0_wp, diameter = 0.04_wp
      real(wp) :: bending, weight
      integer :: i
      machine = plain_shaft([(span/8, i=1, 8)], diameter)
      call put_bearings(machine, [1, 5, 9])
      machine%bearings(2)%offset = [raised, aside]
      rotor = rotor_of(machine, 100.0_wp)
      stations = static_stations(rotor, [(spring, i=1, 6)], x)
      bending = 48*machine%rotor%elastic%shaft%young_modulus*pi/64*diameter**4/span**3
      weight = rotor%total_mass*gravity
      call expect_close(-x(3)*spring, 0.625_wp*weight + raised*bending, 1e-3_wp*weight, 'load of the raised bearing')
      call expect_close(-x(1)*spring, 0.1875_wp*weight - raised*bending/2, 1e-3_wp*weight, 'load of the first bearing')
      call expect_close(-x(4)*spring, aside*bending, 1e-3_wp*abs(aside)*bending, 'load along z')
      call expect_close(stations(9), raised, 1e-9_wp, 'the raised station')
      call expect_close(stations(10), aside, 1e-9_wp, 'the station aside')
      call expect_close(dot_product(rotor%slope(9, :), x) + rotor%slope_offset(9), 0.0_wp, 1e-9_wp, 'slope there')
      ! bearings that are all raised alike bear what they bore
      machine%bearings%offset(1) = 1e-3_wp
      machine%bearings%offset(2) = 0
      rotor = rotor_of(machine, 100.0_wp)
      stations = static_stations(rotor, [(spring, i=1, 6)], x)
      call expect_close(-x(3)*spring, 0.625_wp*weight, 1e-3_wp*weight, 'a line that is raised as a whole')
      call expect_close(stations(1), 1e-3_wp, 1e-9_wp, 'a station of this line')
   end subroutine try_offsets

   !> A bearing on a support: springs in series, the weight of the housing on the support alone.
   subroutine try_supports()
      type(case_type) :: machine
      type(rotor_matrices_type) :: rotor
      real(wp), allocatable :: stations(:), x(:)
      real(wp), parameter :: spring = 1e8_wp, base(2) = [2e8_wp, 5e7_wp]
      integer :: i
      machine = plain_shaft([(0.25_wp, i=1, 4)], 0.1_wp)
      call put_bearings(machine, [1, 5])
      allocate (machine%bearings(2)%support)
      machine%bearings(2)%support%mass = 80
      machine%bearings(2)%support%stiffness = base
      machine%bearings(2)%support%damping = [3e4_wp, 4e4_wp]
      deallocate (machine%rotor%elastic%loads)
      allocate (machine%rotor%elastic%loads(1))
      machine%rotor%elastic%loads(1)%station = 5
      machine%rotor%elastic%loads(1)%force = [0.0_wp, 900.0_wp]
      rotor = rotor_of(machine, 100.0_wp)
      stations = static_stations(rotor, [(spring, i=1, 4)], x)
      associate (half => rotor%total_mass*gravity/2)
         call expect_close(x(3)*spring, -half, 1e-6_wp, 'load of the bearing')
         call expect_close(x(5)*base(1), -half - 80*gravity, 1e-6_wp, 'load of its support')
      end associate
      call expect_close(x(4)*spring, 900.0_wp, 1e-6_wp, 'load of the bearing along z')
      call expect_close(x(6)*base(2), 900.0_wp, 1e-6_wp, 'load of its support along z')
      call expect_close(stations(9), x(3) + x(5), 1e-14_wp, 'the station is where journal and housing are')
      call expect_close(rotor%damping(5, 5), 3e4_wp, 0.0_wp, 'damper along y')
      call expect_close(rotor%damping(6, 6), 4e4_wp, 0.0_wp, 'damper along z')
      call expect_close(rotor%mass(5, 5) - rotor%mass(3, 3), 80.0_wp, 1e-9_wp, 'the housing moves with the journal')
      call expect(maxval(abs(rotor%mass(5, 7:) - rotor%mass(3, 7:))) <= 0, 'and shakes the modes as the journal does')
   end subroutine try_supports

   !> Unbalances at angles: a station is at the angle of its unbalance, where the shaft is stiff.
   subroutine try_unbalances()
      type(case_type) :: machine
      type(rotor_matrices_type) :: rotor
      complex(wp), allocatable :: response(:), turned(:)
      real(wp), parameter :: springs(4) = [6e8_wp, 3e8_wp, 5e8_wp, 2e8_wp], dampers(4) = 1e6_wp, angle = 40*pi/180
      integer :: i
      machine = unsymmetric()
      rotor = rotor_of(machine, 6500*rpm)
      response = unbalance_response(rotor, 300.0_wp, springs, dampers)
      machine%rotor%elastic%unbalances%angle_deg = machine%rotor%elastic%unbalances%angle_deg + 40
      rotor = rotor_of(machine, 6500*rpm)
      turned = unbalance_response(rotor, 300.0_wp, springs, dampers)
      call expect(maxval(abs(turned - response*exp(cmplx(0.0_wp, angle, wp)))) < 1e-12_wp*maxval(abs(response)), &
         & 'unbalances that are turned turn the response')
      ! far below the critical speeds, in bearings alike in both planes: y = r cos(phi + angle), z = r sin(phi + angle)
      machine = turbine()
      machine%rotor%elastic%unbalances%angle_deg = 40
      rotor = rotor_of(machine, 6500*rpm)
      response = unbalance_response(rotor, 1.0_wp, [(1e9_wp, i=1, 4)], [(0.0_wp, i=1, 4)])
      call expect_close(atan2(response(13)%im, response(13)%re), angle, 1e-6_wp, 'phase of y')
      call expect(abs(response(14) + (0.0_wp, 1.0_wp)*response(13)) < 1e-6_wp*abs(response(13)), 'z follows y')
   end subroutine try_unbalances

   subroutine try_refusals()
      type(case_type) :: machine
      type(rotor_matrices_type) :: rotor
      type(error_type), allocatable :: error
      machine = turbine()
      call put_bearings(machine, [2])
      call find_rotor(machine, 600.0_wp, rotor, error)
      call expect_error(error, input_error, 'do not hold the shaft', 'one bearing')
      machine = turbine()
      machine%rotor%elastic%shaft%bore(4) = machine%rotor%elastic%shaft%diameter(4)
      call find_rotor(machine, 600.0_wp, rotor, error)
      call expect_error(error, input_error, 'do not hold the shaft', 'a section without stiffness')
   end subroutine try_refusals
end program test_rotor_matrices
