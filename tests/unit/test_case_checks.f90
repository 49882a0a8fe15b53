!> What no single value of a case can tell: each check lets pass what is just allowed and names what is not.
program test_case_checks
   use case_inputs, only: case_type
   use input_cases, only: case_of, expect_refused
   use check, only: runs, report
   implicit none (type, external)

   if (runs('film')) call film()
   if (runs('memory')) call memory()
   if (runs('clearances')) call clearances()
   if (runs('pressures')) call pressures()
   if (runs('speeds')) call speeds()
   if (runs('friction')) call friction()
   if (runs('pivots')) call pivots()
   if (runs('samples')) call samples()
   if (runs('starts')) call starts()
   if (runs('fixed_pads')) call fixed_pads()
   if (runs('centre_of_gravity')) call centre_of_gravity()
   if (runs('room_for_pads')) call room_for_pads()
   if (runs('coefficients')) call coefficients()
   if (runs('first_of_several')) call expect_refused('&film circumferential_cells = 41 / ' &
      & //'&friction dynamic_coefficient = 1 /', 'film%circumferential_cells = 41: must be even')
   call report()

contains

   subroutine expect_allowed(text)
      character(len=*), intent(in) :: text
      type(case_type) :: ignored
      ignored = case_of(text)
   end subroutine expect_allowed

   subroutine film()
      call expect_allowed('&case /')
      call expect_allowed('&film circumferential_cells = 8 /')
      call expect_refused('&film circumferential_cells = 6 /', 'cells = 6: must be even, and 0 or at least 8')
      call expect_refused('&film circumferential_cells = 41 /', 'film%circumferential_cells = 41: must be even')
      call expect_allowed('&film axial_cells = 2 /')
      call expect_refused('&film axial_cells = 1 /', 'film%axial_cells = 1: must be 2 or more')
      call expect_refused('&film solver = ''fourier'' /', 'needs film%cavitation = ''gumbel'' or ''none''')
      call expect_allowed('&film solver = ''fourier'', cavitation = ''gumbel'' /')
      call expect_allowed('&film solver = ''fourier'', cavitation = ''none'' /')
   end subroutine film

   !> (axial cells/2)^2 values a column and pad, 5e7 at most; where films cavitate, by `auto` alone.
   subroutine memory()
      character(len=*), parameter :: columns = '&film circumferential_cells = 2000, '
      call expect_allowed(columns//'axial_cells = 223 /')
      call expect_refused(columns//'axial_cells = 224 /', &
         & 'film%axial_cells = 224: must be at most 223 with film%circumferential_cells = 2000 and 2 pads')
      call expect_allowed(columns//'axial_cells = 224, cavitation = ''none'' /')
      call expect_allowed(columns//'axial_cells = 224, solver = ''sor'' /')
      call expect_allowed('&film axial_cells = 1000 /')
   end subroutine memory

   !> Of a journal of 49.9 mm.
   subroutine clearances()
      character(len=*), parameter :: range = ': must be 1e-5 to 0.05 of bearing%journal_radius'
      character(len=*), parameter :: lengths = ': must be 0.02 to 50 times bearing%journal_radius'
      call expect_refused('&bearing machined_clearance = 2.5e-3 /', 'bearing%machined_clearance = 0.0025'//range)
      call expect_allowed('&bearing machined_clearance = 2.49e-3 /')
      call expect_refused('&bearing machined_clearance = 4.94e-7, assembled_clearance = 4.94e-7 /', '4.94e-7'//range)
      call expect_allowed('&bearing machined_clearance = 5.04e-7, assembled_clearance = 4.94e-7 /')
      call expect_allowed('&bearing assembled_clearance = 200e-6 /')
      call expect_refused('&bearing assembled_clearance = 201e-6 /', &
         & 'bearing%assembled_clearance = 2.01e-4: must be at most twice bearing%machined_clearance')
      call expect_allowed('&bearing axial_length = 1.05e-3 /')
      call expect_refused('&bearing axial_length = 9.5e-4 /', 'bearing%axial_length = 9.5e-4'//lengths)
      call expect_allowed('&bearing axial_length = 2.45 /')
      call expect_refused('&bearing axial_length = 2.55 /', 'bearing%axial_length = 2.55'//lengths)
   end subroutine clearances

   subroutine pressures()
      character(len=*), parameter :: cavitation = '&bearing cavitation_pressure = 1e4, '
      call expect_allowed(cavitation//'supply_pressure = 1e4, ambient_pressure = 1e4 /')
      call expect_refused(cavitation//'supply_pressure = 9e3, ambient_pressure = 1e4 /', &
         & 'bearing%cavitation_pressure = 10000: must not exceed bearing%supply_pressure = 9000')
      call expect_refused(cavitation//'supply_pressure = 1e4, ambient_pressure = 9e3 /', &
         & 'bearing%ambient_pressure = 9000')
      call expect_allowed(cavitation//'supply_pressure = 9e3 / &film cavitation = ''none'' /')
   end subroutine pressures

   subroutine speeds()
      call expect_allowed('&integration stop_when_periodic = 1e-3 /')
      call expect_refused('&integration stop_when_periodic = 1e-3 / &operation final_speed_rpm = 7000 /', &
         & 'integration%stop_when_periodic = 0.001: must be 0 where operation%final_speed_rpm differs')
      call expect_allowed('&operation final_speed_rpm = 7000 /')
      call expect_allowed('&rotor balance_grade = 2.5, balance_speed_rpm = 1 /')
      call expect_refused('&rotor balance_grade = 2.5, balance_speed_rpm = 0.5 /', &
         & 'rotor%balance_speed_rpm = 0.5: must be 1 to 1e6')
   end subroutine speeds

   subroutine friction()
      call expect_allowed('&friction dynamic_coefficient = 0.1 /')
      call expect_refused('&friction dynamic_coefficient = 0.101 /', &
         & 'friction%dynamic_coefficient = 0.101: must not exceed friction%static_coefficient')
      call expect_allowed('&friction dynamic_coefficient = 0, model = ''bengisu_akay'' /')
      call expect_refused('&friction dynamic_coefficient = 0, model = ''lugre'' /', &
         & 'friction%dynamic_coefficient = 0: must be > 0 for model = ''lugre''')
   end subroutine friction

   !> In a socket of 13 mm.
   subroutine pivots()
      character(len=*), parameter :: rocker = '&pivot law = ''rocker'', socket_radius = 0.08, ' &
         & //'radius_difference = 0.06, '
      call expect_allowed('&pivot radius_difference = 6.5e-3 /')
      call expect_refused('&pivot radius_difference = 6.6e-3 /', &
         & 'pivot%radius_difference = 0.0066: must be at most half of pivot%socket_radius')
      call expect_allowed('&pivot radius_difference = 0 /')
      call expect_refused('&pivot radius_difference = 0, law = ''hertz'' /', &
         & 'pivot%radius_difference = 0: must be > 0 for law = ''hertz''')
      call expect_allowed('&pivot law = ''linear'', stiffness = 1e9 /')
      call expect_allowed('&pivot law = ''linear'', stiffness = 1e9, 2e9 /')
      call expect_refused('&pivot law = ''linear'' /', 'pivot%stiffness: must be given for pivot%law = ''linear''')
      call expect_refused('&pivot law = ''linear'', stiffness(2) = 1e9 /', &
         & 'pivot%stiffness: must be given for pivot%law = ''linear'' (pad 1)')
      call expect_refused('&pivot stiffness = 1e9 /', &
         & 'pivot%stiffness = 1e9: needs pivot%law = ''linear'', not ''fang''')
      call expect_refused('&pivot law = ''linear'', stiffness = 3*1e9 /', 'pivot%stiffness')
      call expect_allowed(rocker//'contact_length = 0.1 /')
      call expect_refused(rocker//'contact_length = 0.09, 0.11 /', &
         & 'pivot%contact_length = 0.11: must be at most bearing%axial_length = 0.1 (both in m; pad 2)')
      call expect_refused('&pivot law = ''rocker'' /', 'pivot%radius_difference = 1.5e-5: must be 0.01 to 0.9999 of ' &
         & //'pivot%socket_radius = 0.013 for pivot%law = ''rocker'' (pad 1)')
      call expect_refused('&pivot contact_length = 0.05 /', 'contact_length = 0.05: needs pivot%law = ''rocker''')
      call expect_refused(rocker//'/ &friction model = ''lugre'' /', 'must be ''none'' for pivot%law = ''rocker''')
      call expect_refused(rocker//'wear_coefficient = 1e-15 /', 'must be 0 for pivot%law = ''rocker''')
      call expect_allowed('&pivot rotational_stiffness = 1e3, 0 / &pads motion = ''tilting_only'' /')
      call expect_refused('&pivot rotational_stiffness = 0, 1e3 / &pads motion = ''fixed'' /', &
         & 'pivot%rotational_stiffness = 1000: must be 0 for pads%motion = ''fixed''')
      call expect_refused('&pivot rotational_stiffness = -1 /', 'must be 0 to 1e15 N m/rad')
   end subroutine pivots

   subroutine starts()
      character(len=*), parameter :: fixed = '&pads motion = ''fixed'' / &start '
      call expect_refused('&start from = ''file'' /', 'start%file = '''': must name a result')
      call expect_allowed('&start from = ''file'', file = ''other.h5'' /')
      call expect_refused('&start from = ''centred'', file = ''other.h5'' /', &
         & 'start%file = ''other.h5'': needs start%from = ''file'', not ''centred''')
      call expect_allowed('&start pivot_deflection = 0, 1e-6 /')
      call expect_refused('&start pivot_deflection = 0, 1e-6 / &pads motion = ''tilting_only'' /', &
         & 'must be 0 for pads%motion = ''tilting_only''')
      call expect_allowed('&start pad_tilt = 1e-3 / &pads motion = ''tilting_only'' /')
      call expect_allowed('&start pad_pitch = 1e-4 / &pads motion = ''tilting_pitch'' /')
      call expect_refused('&start pad_yaw = 0, 1e-4 / &pads motion = ''tilting_pitch'' /', &
         & 'start%pad_yaw = 0, pad_yaw_rate = 0: must be 0 for pads%motion = ''tilting_pitch''')
      call expect_refused('&start pad_pitch_rate = 1 /', 'must be 0 for pads%motion = ''tilting_radial''')
      call expect_refused(fixed//'pad_tilt = 1e-3 /', 'start%pad_tilt = 0.001, pad_tilt_rate = 0: must be 0')
      call expect_refused(fixed//'pad_tilt_rate = 0, 1 /', 'must be 0 for pads%motion = ''fixed''')
      call expect_refused(fixed//'pivot_deflection = 1e-6 /', 'must be 0 for pads%motion = ''fixed''')
   end subroutine starts

   !> No friction in pivots that are not there; arcs all around; masses do not matter.
   subroutine fixed_pads()
      call expect_allowed('&pads motion = ''fixed'' /')
      call expect_refused('&pads motion = ''fixed'' / &friction model = ''lugre'' /', &
         & 'friction%model = ''lugre'': must be ''none'' for pads%motion = ''fixed''')
      call expect_refused('&pads pivot_angle_deg = -45, arc_deg = 360 /', &
         & 'pads%arc_deg = 360: must be at most 350 for pads that tilt')
      call expect_allowed('&pads pivot_angle_deg = -45, arc_deg = 360, motion = ''fixed'' /')
   end subroutine fixed_pads

   !> At 6000 rpm there are 100 revolutions a second.
   subroutine samples()
      character(len=*), parameter :: many = '&output samples_per_revolution = 1000 / &operation speed_rpm = 6000, '
      call expect_allowed('&output start_time = 2 /')
      call expect_refused('&output start_time = 2.002 /', &
         & 'output%start_time = 2.002: must not exceed operation%duration = 2')
      call expect_allowed(many//'duration = 0.99e4 /')
      call expect_refused(many//'duration = 1.01e4 /', &
         & 'operation%duration = 10100: more than 1e9 samples at output%samples_per_revolution = 1000')
   end subroutine samples

   !> The inertia about the pivot is more than that of the mass in its centre, here 9.0007e-5 kg m^2.
   subroutine centre_of_gravity()
      call expect_allowed('&pads centre_tangential(2) = 3e-3, inertia(2) = 9.09e-5 /')
      call expect_refused('&pads centre_tangential(2) = 3e-3, inertia(2) = 8.91e-5 /', &
         & 'must exceed pads%mass = 0.8108 times')
      call expect_refused('&pads centre_tangential(2) = 3e-3, inertia(2) = 8.91e-5 /', '(pad 2)')
   end subroutine centre_of_gravity

   !> Pads reach from theta - theta_2 to theta + theta_1, with the pivot at its part of the arc from the leading edge.
   subroutine room_for_pads()
      character(len=*), parameter :: pads = '&pads arc_deg = 60, pivot_angle_deg = '
      call expect_allowed(pads//'-45, 16 /')
      call expect_refused(pads//'-45, 14 /', 'pads%pivot_angle_deg = -45, 14: pads 1 and 2 overlap')
      call expect_refused(pads//'14, -45 /', 'overlap')
      call expect_refused(pads//'0, 360 /', 'overlap')
      call expect_refused('&pads arc_deg = 200 /', 'overlap')
      call expect_allowed(pads//'-45, 254 /')
      call expect_refused(pads//'-45, 256 /', 'overlap')
      ! the first pad reaches 42 degrees on from its pivot, the second 18 degrees back from its own
      call expect_allowed(pads//'0, 61, pivot_ratio = 0.7 /')
      call expect_refused(pads//'0, 71, pivot_ratio = 0.7, 0.5 /', 'pads 1 and 2 overlap')
      call expect_allowed(pads//'0, 73, pivot_ratio = 0.7, 0.5 /')
   end subroutine room_for_pads

   !> Speeds of the task coefficients; the threshold speed is of no other task.
   subroutine coefficients()
      character(len=*), parameter :: task = '&case task = ''coefficients'' / '
      call expect_allowed(task//'&coefficients frequency_ratio = 0.5 /')
      call expect_allowed(task//'&coefficients threshold_up_to_rpm = 6501 /')
      call expect_refused(task//'&coefficients threshold_up_to_rpm = 6500 /', &
         & 'coefficients%threshold_up_to_rpm = 6500: must be 0 or above operation%speed_rpm = 6500')
      call expect_allowed(task//'&coefficients cross_stiffness = -1e6 /')
      call expect_allowed('&coefficients threshold_up_to_rpm = 6500 /')
      call expect_allowed(task//'&start from = ''centred'', journal = 0, 1e-6 /')
      call expect_refused(task//'&operation final_speed_rpm = 7000 /', &
         & 'operation%final_speed_rpm = 7000: must be operation%speed_rpm = 6500')
   end subroutine coefficients
end program test_case_checks
