!> Remarks on cases: what is seldom meant, what the paper's bearing lends a case, and what has no effect.
program test_case_remarks
   use kinds, only: wp
   use text, only: filled, line_if, behind
   use input_cases, only: case_of
   use case_remarks, only: remarks_on_case
   use check, only: runs, expect, report
   implicit none (type, external)
   character(len=*), parameter :: own = '&bearing journal_radius = 0.05 /', &
      & machine = '&bearing name = ''left'', station = 1 / &bearing name = ''right'', station = 3 / '

   if (runs('units')) call units()
   if (runs('units_of_machines')) call units_of_machines()
   if (runs('frequencies')) call frequencies()
   if (runs('loads')) call loads()
   if (runs('speeds_and_forces')) call speeds_and_forces()
   if (runs('cold_oil')) call cold_oil()
   if (runs('lent_values')) call lent_values()
   if (runs('idle_groups')) call idle_groups()
   if (runs('laminar_films')) call laminar_films()
   if (runs('templates')) then
      call expect(filled('pad {}: {u.3} um, {i} of {M} MPa, {c.1} %', [1.0_wp, 2.5e-6_wp, 1234567.0_wp, 5e6_wp, &
         & 0.125_wp]) == 'pad 1: 2.500 um, 1234567 of 5 MPa, 12.5 %', 'numbers in their places')
      call expect(filled('a {} b {.2}', [-0.019_wp, 2.0_wp]) == 'a -0.019 b 2.00' .and. filled('none') == 'none', &
         & 'short numbers, decimals, and no numbers')
      call expect(line_if(.true., '{ci} %', [0.126_wp], '; more') == '13 %; more'//achar(10) &
         & .and. line_if(.false., '{}', [1.0_wp]) == '', 'a line where its condition holds')
   end if
   if (runs('lines')) call expect(behind('- ', 'a'//achar(10)//'b'//achar(10)) == '- a'//achar(10)//'- b'//achar(10), &
      & 'a mark before each line')
   call report()

contains

   !> A case has one remark with these words, or with none no remark.
   subroutine expect_remark(text, words)
      character(len=*), intent(in) :: text, words
      character(len=:), allocatable :: all
      all = remarks_on_case(case_of(text))
      if (words == '') then
         call expect(all == '', text//': '//all)
      else
         call expect(index(all, words) > 0 .and. index(all, achar(10)) == len(all), text//': '//all)
      end if
   end subroutine expect_remark

   subroutine units()
      character(len=*), parameter :: warm = '&thermal model = ''pad'' / &oil grade = 46, supply_temperature = '
      call expect_remark('&case /', '')
      call expect_remark(warm//'150 /', '')
      call expect_remark(warm//'160 /', &
         & 'oil%supply_temperature = 160: seldom so in C; 160 F are 71.1111')
      call expect_remark(warm//'313.15 /', 'seldom so in C; 313.15 K are 40')
      call expect_remark('&bearing machined_clearance = 4.98e-4, assembled_clearance = 4.98e-4 /', '')
      call expect_remark('&bearing machined_clearance = 2e-3, assembled_clearance = 2e-3 /', 'bearing%assembled_' &
         & //'clearance = 0.002: 0.0400802 of the radius of the journal; usual are 0.001 to 0.003; ' &
         & //'0.002 in are 5.08e-5')
      ! 80 um of 2000 kg are 0.16 kg m
      call expect_remark('&rotor unbalance = 0.159 /', '')
      call expect_remark('&rotor unbalance = 0.161 /', 'um; the unbalance is in kg m; 0.161 g mm are 1.61e-7')
      call expect_remark('&rotor unbalance = 185 /', '185 g mm are 1.85e-4; 185 oz in are 0.133215')
      call expect_remark('&pads arc_deg = 1.309 /', 'pads%arc_deg = 1.309: seldom so in deg; 1.309 rad are 75.0002')
      call expect_remark('&bearing viscosity = 2.2e-6 /', 'bearing%viscosity = 2.2e-6: seldom so in ' &
         & //'Pa s; 2.2e-6 reyn are 0.0151685')
      call expect_remark('&rotor unbalance = 0.161 / &case task = equilibrium /', '')
      call expect_remark('&bearing supply_pressure = 1.5 /', 'seldom so in Pa; 1.5 bar are 150000; 1.5 psi are 10342.1')
      call expect_remark('&bearing supply_pressure = 1.5e5 /', '')
      call expect_remark('&oil conductivity = 130 /', 'seldom so in W/(m K); 130 mW/(m K) are 0.13')
      call expect_remark('&pivot law = ''linear'', stiffness = 500 /', 'pivot%stiffness = 500: seldom so in N/m; 500 ' &
         & //'N/um are 5e8')
      call expect_remark('&pivot young_modulus = 2*3e7 /', 'pivot%young_modulus = 3e7: seldom so in Pa; 3e7 psi are ' &
         & //'2.06843e11')
      call expect_remark('&pads inertia = 2000 /', 'pads%inertia = 2000: more than a pad of this size and mass has; ' &
         & //'2000 kg mm^2 are 0.002')
      call expect_remark('&pads mass = 1500, inertia = 3 /', 'pads%mass = 1500: more than a pad of this size weighs; ' &
         & //'1500 g are 1.5')
      ! a mass that the case derives from a thickness above the paper's
      call expect_remark('&pads density = 7850, thickness = 0.15, pivot_distance = 0.15 /', '')
      call expect_remark('&pads density = 7850, thickness = 0.15 /', '')
   end subroutine units

   !> Of a machine: the density of the shaft, which a case may set to almost nothing, and discs wider than it is long.
   subroutine units_of_machines()
      character(len=*), parameter :: shaft = '&shaft length = 2*0.5, diameter = 2*0.1 / '
      character(len=*), parameter :: disc = '&disc station = 2, mass = 100, polar_inertia = 2e-3, diametral_inertia = '
      call expect_words(machine//'&shaft length = 2*0.5, diameter = 2*0.1, density = 7.85 /', &
         & 'shaft%density = 7.85: seldom so in kg/m^3; 7.85 g/cm^3 are 7850')
      call expect_words(machine//shaft//disc//'1e6 /', &
         & 'disc(1)%diametral_inertia = 1e6: more than a disc of its mass has that is not larger than the shaft is ' &
         & //'long; 1e6 kg cm^2 are 100')
      call expect_words(machine//shaft//disc//'99 / &support bearing = ''left'', mass = 10, ' &
         & //'stiffness = 500, 500 /', 'support:left%stiffness = 500: seldom so in N/m; 500 N/um are 5e8')
      call expect_words(machine//shaft//'&pads bearing = ''right'', mass = 1500, inertia = 3 /', &
         & 'bearing ''right'': pads%mass = 1500: more than a pad of this size weighs; 1500 g are 1.5')
      call expect(index(remarks_on_case(case_of(machine//shaft//disc//'99 /')), &
         & ' are ') == 0, 'a machine without remarks on units')
   end subroutine units_of_machines

   !> A case has one remark with these words, beside others.
   subroutine expect_words(text, words)
      character(len=*), intent(in) :: text, words
      character(len=:), allocatable :: all
      all = remarks_on_case(case_of(text))
      call expect(index(all, words) > 0, text//': '//all)
   end subroutine expect_words

   !> Frequencies beside the speed, 50 Hz or 314.159 rad/s.
   subroutine frequencies()
      character(len=*), parameter :: at = '&operation speed_rpm = 3000 / &excitation amplitude = 1, ', turns = &
         & '; the shaft turns at 50 Hz'
      call expect_remark(at//'frequency_hz = 50 /', '')
      call expect_remark(at//'frequency_hz = 1200 /', '')
      call expect_remark(at//'frequency_hz = 3000 /', 'excitation(1)%frequency_hz = 3000: 60 times the speed of the ' &
         & //'shaft; 3000 rpm are 50'//turns)
      call expect_remark(at//'frequency_hz = 314.2 /', 'frequency_hz = 314.2: the speed of the shaft in rad/s'//turns)
      call expect_remark(at//'frequency_hz = 315 /', '')
      call expect_remark(at//'frequency_ratio = 50 /', 'excitation(1)%frequency_ratio = 50: this many times')
      call expect_remark('&case task = ''coefficients'' / &coefficients frequency_ratio = 0.5, 50 /', &
         & 'coefficients%frequency_ratio = 50: this many times')
      call expect_remark('&operation speed_rpm = 3000 / &rotor balance_grade = 2.5, balance_speed_rpm = 314 /', &
         & 'rotor%balance_speed_rpm = 314: the speed of the shaft in rad/s; it is in rpm')
      call expect_remark('&operation speed_rpm = 3000 / &rotor balance_grade = 2.5, balance_speed_rpm = 320 /', '')
   end subroutine frequencies

   !> Of a bearing of 9.98e-3 m^2, whose fixed pads end at the load or carry it.
   subroutine loads()
      character(len=*), parameter :: bore = '&bearing preload = 0 / &pads motion = ''fixed'', pivot_angle_deg = '
      call expect_remark('&rotor mass = 5080 /', '')
      call expect_remark('&rotor mass = 5090 /', 'specific load 5.00 MPa')
      call expect_remark(bore//'-90, arc_deg = 360 /', '')
      call expect_remark(bore//'90, arc_deg = 360 /', 'the load points to -90.0 deg')
      call expect_remark(bore//'104, arc_deg = 360 /', 'the load points to -90.0 deg')
      ! a journal that is held is so by a load of this direction, unless its attitude is given
      call expect_remark(bore//'90, arc_deg = 360 / &case task = ''equilibrium'' / &held eccentricity_ratio = 0.5 /', &
         & 'the load points to -90.0 deg')
      call expect_remark(bore//'90, arc_deg = 360 / &case task = ''equilibrium'' / &held eccentricity_ratio = 0.5, ' &
         & //'attitude_deg = 50 /', '')
      call expect_remark(bore//'106, arc_deg = 360 /', '')
      call expect_remark(bore//'0, 180, arc_deg = 170 /', 'the load points to -90.0 deg')
      call expect_remark(bore//'0, 180, arc_deg = 170 / &rotor gravity = 0, static_load = 0, 1e4 /', '')
      ! pads that tilt may have the load between them
      call expect_remark('&pads pivot_angle_deg = 0, 180, arc_deg = 100 /', '')
      call expect_remark('&pads motion = ''fixed'', pivot_angle_deg = -90, 90, arc_deg = 160 /', &
         & 'each lobe has a centre')
   end subroutine loads

   !> Speeds in rad/s or Hz, loads in kN, t or lb, where the surface of the journal, of 49.9 mm, or the load would be
   !> unusual.
   subroutine speeds_and_forces()
      character(len=*), parameter :: weightless = '&rotor gravity = 0, static_load = '
      call expect_remark('&operation speed_rpm = 383 /', '')
      call expect_remark('&operation speed_rpm = 382 /', 'seldom so low; 382 rad/s are 3647.83; 382 Hz are 22920')
      call expect_remark('&operation speed_rpm = 50 /', 'surface speed 0.261276 m/s at 50 rpm: seldom so low; 50 ' &
         & //'rad/s are 477.465; 50 Hz are 3000')
      ! of a run-up the highest speed counts
      call expect_remark('&operation speed_rpm = 50, final_speed_rpm = 3000 /', '')
      call expect_remark('&rotor mass = 6000 /', 'MPa; 6000 lb are 2721.55')
      call expect_remark('&rotor mass = 2, unbalance = 0 /', 'specific load 0.00196593 MPa: seldom so low; most ' &
         & //'bearings carry 1 to 3 MPa; 2 t are 2000')
      call expect_remark('&rotor mass = 6, unbalance = 0 /', '')
      call expect_remark(weightless//'-20, 0 /', '3 MPa; 20 kN are 20000')
      call expect_remark(weightless//'-50, 0 /', '')
      call expect_remark(weightless//'0, 0 /', '')
      call expect_remark('&rotor static_load = -3, 4 /', &
         & 'rotor%static_load: 5 N are nothing beside the weight of 19620 N; 5 kN are 5000')
      call expect_remark('&rotor static_load = -20, 0 /', '')
      call expect_words(machine//'&shaft length = 2*0.5, diameter = 2*0.1 / &load station = 2, force = 0, -0.5 /', &
         & 'load(1)%force: 0.5 N are nothing beside the weight of 604.823 N; 0.5 kN are 500'//achar(10))
   end subroutine speeds_and_forces

   !> Oil that no film heats, where its viscosity over the temperature is given.
   subroutine cold_oil()
      ! by the law, 0.05 Pa s halved at 40 C + ln 2/0.02
      call expect_remark('&oil reference_viscosity = 0.05, temperature_exponent = 0.02, supply_temperature = ' &
         & //'74.6573590279973 /', 'thermal%model = ''none'': all oil has oil%supply_temperature = 74.6574 C and ' &
         & //'0.0250 Pa s, as if no film heated it')
      call expect_remark('&oil grade = 46 / &thermal model = ''film'' /', '')
      call expect_remark('&bearing viscosity = 0.03 /', '')
   end subroutine cold_oil

   !> What another bearing than the paper's does not give.
   subroutine lent_values()
      character(len=*), parameter :: begin = 'not given, and so as in the paper''s bearing: ', &
         & rotor = '&rotor mass = 100, unbalance = 0 / ', &
         & pads = rotor//'&operation speed_rpm = 3000 / &pads pivot_angle_deg = 0, 180, arc_deg = 80', &
         & bearing = ' / &bearing journal_radius = 0.05, axial_length = 0.05, preload = 0, ', rest = pads//bearing, &
         & thick = ', density = 7850, thickness = 0.02'
      call expect_remark(own, begin//'rotor%mass = 2000 kg, rotor%unbalance = 0.01 kg m, operation%speed_rpm = ' &
         & //'6500 rpm, bearing%machined_clearance = 1e-4 m, bearing%assembled_clearance = 8e-5 m, ' &
         & //'bearing%axial_length = 0.1 m, bearing%viscosity = 0.019 Pa s, pads%pivot_angle_deg = -45, 225 deg, ' &
         & //'pads%arc_deg = 69.3 deg')
      call expect_remark(rest//'assembled_clearance = 6e-5 /', begin//'bearing%viscosity = 0.019 Pa s'//achar(10))
      call expect_remark(rest//'viscosity = 0.019 /', begin//'bearing%assembled_clearance = 8e-5 m'//achar(10))
      call expect_remark(rest//'assembled_clearance = 6e-5, viscosity = 0.019 /', '')
      call expect_remark(rest//'assembled_clearance = 6e-5 / &oil grade = 32 / &thermal model = ''pad'' /', '')
      ! an unbalance by its grade is given
      call expect_remark('&rotor mass = 100, balance_grade = 2.5 / '//rest(len(rotor) + 1:)//'assembled_clearance = ' &
         & //'6e-5, viscosity = 0.019 /', '')
      ! equilibria know no unbalance
      call expect_remark('&rotor mass = 100 / '//rest(len(rotor) + 1:)//'assembled_clearance = 6e-5, viscosity = ' &
         & //'0.019 / &case task = ''coefficients'' /', '')
      call expect_remark('&pivot socket_radius = 0.02 /', '')
      ! how far the pivots are behind pads of another thickness
      call expect_remark(pads//thick//bearing//'assembled_clearance = 6e-5, viscosity = 0.019 /', &
         & begin//'pads%pivot_distance = 0.014 m'//achar(10))
      call expect_remark(pads//thick//', pivot_distance = 0.02'//bearing//'assembled_clearance = 6e-5, ' &
         & //'viscosity = 0.019 /', '')
   end subroutine lent_values

   subroutine idle_groups()
      character(len=*), parameter :: several = '&coefficients frequency_ratio = 0.5, threshold_up_to_rpm = 9000 / ' &
         & //'&periodic revolutions = 2 / &branch step = 3 / &integration stop_when_periodic = 1e-3 / ' &
         & //'&output start_time = 1 / &start journal = 0, 1e-6, pad_tilt = 1e-4 /'
      call expect_idle(several, 'march', [character(len=60) :: 'coefficients (frequency_ratio, threshold_up_to_rpm)', &
         & 'periodic (revolutions)', 'branch (step)'])
      call expect_idle(several, 'coefficients', [character(len=60) :: 'start (journal, pad_tilt)', &
         & 'integration (stop_when_periodic)', 'output (start_time)', 'periodic (revolutions)', 'branch (step)'])
      call expect_idle(several, 'periodic', [character(len=60) :: 'integration (stop_when_periodic)', &
         & 'output (start_time)', 'coefficients (frequency_ratio, threshold_up_to_rpm)', 'branch (step)'])
      call expect_idle('&start from = ''partial'' /', 'equilibrium', [character(len=60) :: 'start (from)'])
      ! what has its default says nothing
      call expect_remark('&periodic revolutions = 1 / &start pad_tilt = 0 /', '')
   end subroutine idle_groups

   !> What turbulent films alone have, of a bearing and of one of a machine.
   subroutine laminar_films()
      character(len=*), parameter :: laminar = ': has no effect with film%turbulence = ''none''', &
         & limits = '&film laminar_below = 400, turbulent_above = 1500', eddies = '&oil turbulent_prandtl = 0.8', &
         & warm = ', grade = 46 / &thermal model = ''pad'' /'
      call expect_remark(limits//' /', 'film (laminar_below, turbulent_above)'//laminar)
      call expect_remark(limits//', turbulence = ''ng_pan'' /', '')
      call expect_remark(eddies//' /', 'oil (turbulent_prandtl)'//laminar)
      call expect_remark(eddies//warm, 'oil (turbulent_prandtl)'//laminar)
      call expect_remark(eddies//' / &film turbulence = ''ng_pan'' /', &
         & 'oil (turbulent_prandtl): has no effect with thermal%model = ''none''')
      call expect_remark(eddies//warm//' &film turbulence = ''ng_pan'' /', '')
      call expect_remark(machine//'&shaft length = 2*0.5, diameter = 2*0.1 / &film bearing = ''left'', ' &
         & //'laminar_below = 400 / &film bearing = ''right'', laminar_below = 400, turbulence = ''ng_pan'' /', &
         & 'film:left (laminar_below): has no effect with film:left%turbulence = ''none'''//achar(10))
   end subroutine laminar_films

   subroutine expect_idle(text, task, idle)
      character(len=*), intent(in) :: text, task, idle(:)
      character(len=:), allocatable :: lines, all
      integer :: i
      lines = ''
      do i = 1, size(idle)
         lines = lines//trim(idle(i))//': has no effect with case%task = '''//task//''''//achar(10)
      end do
      all = remarks_on_case(case_of('&case task = '''//task//''' / '//text))
      call expect(all == lines, task//': '//all)
   end subroutine expect_idle
end program test_case_remarks
