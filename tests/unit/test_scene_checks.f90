!> What no single value of a scene can tell: each check lets pass what is just allowed and names what is not.
program test_scene_checks
   use kinds, only: wp
   use errors, only: error_type, input_error
   use scene, only: scene_type, unset
   use scene_checks, only: check_scene
   use check, only: runs, expect, expect_no_error, expect_error, report
   implicit none (type, external)

   if (runs('paper')) call paper()
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
   if (runs('first_of_several')) call first_of_several()
   call report()

contains

   subroutine expect_allowed(s, what)
      type(scene_type), intent(in) :: s
      character(len=*), intent(in) :: what
      type(error_type), allocatable :: error
      call check_scene(s, error)
      call expect_no_error(error, what)
   end subroutine expect_allowed

   !> The message begins with the variable and says the words.
   subroutine expect_refused(s, variable, words)
      type(scene_type), intent(in) :: s
      character(len=*), intent(in) :: variable, words
      type(error_type), allocatable :: error
      call check_scene(s, error)
      call expect_error(error, input_error, words, variable//' is refused')
      if (allocated(error)) call expect(index(error%message, variable//' = ') == 1, variable//' in '//error%message)
   end subroutine expect_refused

   subroutine paper()
      call expect_allowed(scene_type(), 'the paper''s bearing')
   end subroutine paper

   subroutine film()
      type(scene_type) :: s
      s = scene_type()
      s%film%circumferential_cells = 8
      call expect_allowed(s, '8 cells')
      s%film%circumferential_cells = 6
      call expect_refused(s, 'film%circumferential_cells', 'must be even, and 0 or at least 8')
      s%film%circumferential_cells = 41
      call expect_refused(s, 'film%circumferential_cells', 'must be even')
      s = scene_type()
      s%film%axial_cells = 2
      call expect_allowed(s, 'two cells across half the width')
      s%film%axial_cells = 1
      call expect_refused(s, 'film%axial_cells', 'must be 2 or more')
      s = scene_type()
      s%film%solver = 'modal'
      call expect_refused(s, 'film%solver', 'needs film%cavitation = ''gumbel'' or ''none''')
      s%film%cavitation = 'gumbel'
      call expect_allowed(s, 'modes, clipped')
      s%film%cavitation = 'none'
      call expect_allowed(s, 'modes without rupture')
   end subroutine film

   !> (axial cells/2)^2 values a column and pad, 5e7 at most; where films rupture, by `auto` alone.
   subroutine memory()
      type(scene_type) :: s
      s = scene_type()
      s%film%circumferential_cells = 2000
      s%film%axial_cells = 223
      call expect_allowed(s, 'two pads of 2000 columns and 223 rows')
      s%film%axial_cells = 224
      call expect_refused(s, 'film%axial_cells', 'at most 223 with film%circumferential_cells = 2000 and 2 pads')
      s%film%cavitation = 'none'
      call expect_allowed(s, 'as many without rupture')
      s%film%cavitation = 'reynolds'
      s%film%solver = 'sor'
      call expect_allowed(s, 'as many by over-relaxation')
      s%film%solver = 'auto'
      s%film%circumferential_cells = 0
      s%film%axial_cells = 1000
      call expect_allowed(s, '1000 rows with as many columns as are enough')
   end subroutine memory

   subroutine clearances()
      type(scene_type) :: s
      s = scene_type()
      s%bearing%machined_clearance = 0.0501_wp*s%bearing%journal_radius
      call expect_refused(s, 'bearing%machined_clearance', '1e-5 to 0.05 of bearing%journal_radius')
      s%bearing%machined_clearance = 0.0499_wp*s%bearing%journal_radius
      call expect_allowed(s, 'a wide clearance')
      s = scene_type()
      s%bearing%machined_clearance = 0.99e-5_wp*s%bearing%journal_radius
      s%bearing%assembled_clearance = s%bearing%machined_clearance
      call expect_refused(s, 'bearing%machined_clearance', '1e-5 to 0.05 of bearing%journal_radius')
      s%bearing%machined_clearance = 1.01e-5_wp*s%bearing%journal_radius
      call expect_allowed(s, 'a narrow clearance')
      s = scene_type()
      s%bearing%assembled_clearance = 2*s%bearing%machined_clearance
      call expect_allowed(s, 'twice the machined clearance')
      s%bearing%assembled_clearance = 2.01_wp*s%bearing%machined_clearance
      call expect_refused(s, 'bearing%assembled_clearance', 'at most twice bearing%machined_clearance')
      s = scene_type()
      s%bearing%axial_length = 0.021_wp*s%bearing%journal_radius
      call expect_allowed(s, 'a short pad')
      s%bearing%axial_length = 0.019_wp*s%bearing%journal_radius
      call expect_refused(s, 'bearing%axial_length', '0.02 to 50 times bearing%journal_radius')
      s%bearing%axial_length = 49*s%bearing%journal_radius
      call expect_allowed(s, 'a long pad')
      s%bearing%axial_length = 51*s%bearing%journal_radius
      call expect_refused(s, 'bearing%axial_length', '0.02 to 50 times bearing%journal_radius')
   end subroutine clearances

   subroutine pressures()
      type(scene_type) :: s
      s = scene_type()
      s%bearing%cavitation_pressure = 1e4_wp
      s%bearing%supply_pressure = 1e4_wp
      s%bearing%ambient_pressure = 1e4_wp
      call expect_allowed(s, 'all pressures alike')
      s%bearing%supply_pressure = 0.9e4_wp
      call expect_refused(s, 'bearing%cavitation_pressure', 'must not exceed bearing%supply_pressure = 9000')
      s%bearing%supply_pressure = 1e4_wp
      s%bearing%ambient_pressure = 0.9e4_wp
      call expect_refused(s, 'bearing%cavitation_pressure', 'bearing%ambient_pressure = 9000')
      s%film%cavitation = 'none'
      call expect_allowed(s, 'a film that cannot rupture')
   end subroutine pressures

   subroutine speeds()
      type(scene_type) :: s
      s = scene_type()
      s%integration%stop_when_periodic = 1e-3_wp
      call expect_allowed(s, 'periodic at one speed')
      s%operation%final_speed_rpm = 7000
      call expect_refused(s, 'integration%stop_when_periodic', 'must be 0 where operation%final_speed_rpm differs')
      s%integration%stop_when_periodic = 0
      call expect_allowed(s, 'a run-up')
      s%rotor%balance_speed_rpm = 1
      call expect_allowed(s, 'balanced at 1 rpm')
      s%rotor%balance_speed_rpm = 0.5_wp
      call expect_refused(s, 'rotor%balance_speed_rpm', 'must be < 0 (the highest of the run) or >= 1')
      s%rotor%balance_speed_rpm = 0
      call expect_refused(s, 'rotor%balance_speed_rpm', 'must be < 0')
   end subroutine speeds

   subroutine friction()
      type(scene_type) :: s
      s = scene_type()
      s%friction%dynamic_coefficient = s%friction%static_coefficient
      call expect_allowed(s, 'one coefficient for both')
      s%friction%dynamic_coefficient = 1.01_wp*s%friction%static_coefficient
      call expect_refused(s, 'friction%dynamic_coefficient', 'must not exceed friction%static_coefficient')
      s%friction%dynamic_coefficient = 0
      s%friction%model = 'bengisu_akay'
      call expect_allowed(s, 'no dynamic friction, Bengisu-Akay')
      s%friction%model = 'lugre'
      call expect_refused(s, 'friction%dynamic_coefficient', 'must be > 0 for model = ''lugre''')
   end subroutine friction

   subroutine pivots()
      type(scene_type) :: s
      s = scene_type()
      s%pivot%radius_difference = 0.5_wp*s%pivot%socket_radius
      call expect_allowed(s, 'a ball of half the socket''s radius')
      s%pivot%radius_difference = 0.51_wp*s%pivot%socket_radius
      call expect_refused(s, 'pivot%radius_difference', 'at most half of pivot%socket_radius')
      s%pivot%radius_difference = 0
      call expect_allowed(s, 'a ball that fits')
      s%pivot%law = 'hertz'
      call expect_refused(s, 'pivot%radius_difference', 'must be > 0 for law = ''hertz''')
   end subroutine pivots

   subroutine starts()
      type(scene_type) :: s
      s = scene_type()
      s%start%from = 'file'
      call expect_refused(s, 'start%file', 'must name a result')
      s%start%file = 'other.h5'
      call expect_allowed(s, 'a start from a file')
      s%start%from = 'centred'
      call expect_refused(s, 'start%file', 'needs start%from = ''file'', not ''centred''')
      s = scene_type()
      s%start%pad_penetration = [0.0_wp, 1e-6_wp]
      call expect_allowed(s, 'a penetration')
      s%pads%motion = 'tilting_only'
      call expect_refused(s, 'start%pad_penetration', 'must be 0 for pads%motion = ''tilting_only''')
      s%start%pad_penetration = 0
      s%start%pad_tilt = 1e-3_wp
      call expect_allowed(s, 'a tilt of pads that only tilt')
      s%pads%motion = 'fixed'
      call expect_refused(s, 'start%pad_tilt', 'must be 0 for pads%motion = ''fixed''')
      s%start%pad_tilt = 0
      s%start%pad_tilt_rate = [0.0_wp, 1.0_wp]
      call expect_refused(s, 'start%pad_tilt', 'must be 0 for pads%motion = ''fixed''')
      s%start%pad_tilt_rate = 0
      s%start%pad_penetration = 1e-6_wp
      call expect_refused(s, 'start%pad_penetration', 'must be 0 for pads%motion = ''fixed''')
   end subroutine starts

   !> No friction in pivots that are not there; arcs all around; masses do not matter.
   subroutine fixed_pads()
      type(scene_type) :: s
      s = scene_type()
      s%pads%motion = 'fixed'
      s%pads%inertia = unset
      s%pads%mass = unset
      call expect_allowed(s, 'fixed pads without masses')
      s%friction%model = 'lugre'
      call expect_refused(s, 'friction%model', 'must be ''none'' for pads%motion = ''fixed''')
      s = scene_type()
      s%pads%pivot_angle_deg = s%pads%pivot_angle_deg(:1)
      s%pads%arc_deg(1) = 360
      call expect_refused(s, 'pads%arc_deg', 'must be at most 350 for pads that tilt')
      s%pads%motion = 'fixed'
      call expect_allowed(s, 'a fixed pad all around')
   end subroutine fixed_pads

   subroutine samples()
      type(scene_type) :: s
      s = scene_type()
      s%output%start_time = s%operation%duration
      call expect_allowed(s, 'one sample at the end')
      s%output%start_time = 1.001_wp*s%operation%duration
      call expect_refused(s, 'output%start_time', 'must not exceed operation%duration = 2')
      s = scene_type()
      s%operation%speed_rpm = 6000
      s%operation%final_speed_rpm = 6000
      ! 100 revolutions a second
      s%output%samples_per_revolution = 1000
      s%operation%duration = 0.99e4_wp
      call expect_allowed(s, 'almost 1e9 samples')
      s%operation%duration = 1.01e4_wp
      call expect_refused(s, 'operation%duration', 'more than 1e9 samples at output%samples_per_revolution = 1000')
   end subroutine samples

   !> The inertia about the pivot is more than that of the mass in its centre.
   subroutine centre_of_gravity()
      type(scene_type) :: s
      real(wp) :: least
      s = scene_type()
      s%pads%centre_tangential(2) = 3e-3_wp
      least = s%pads%mass(2)*(3e-3_wp**2 + s%pads%centre_radial(2)**2)
      s%pads%inertia(2) = 1.01_wp*least
      call expect_allowed(s, 'almost a point')
      s%pads%inertia(2) = 0.99_wp*least
      call expect_refused(s, 'pads%inertia', 'must exceed mass times')
      call expect_refused(s, 'pads%inertia', '(pad 2)')
   end subroutine centre_of_gravity

   !> Pads reach from theta - theta_2 to theta + theta_1, with the pivot at its part of the arc from the leading edge.
   subroutine room_for_pads()
      type(scene_type) :: s
      s = scene_type()
      s%pads%arc_deg = 60
      s%pads%pivot_angle_deg = [-45.0_wp, 16.0_wp]
      call expect_allowed(s, 'one degree between pads')
      s%pads%pivot_angle_deg = [-45.0_wp, 14.0_wp]
      call expect_refused(s, 'pads%pivot_angle_deg', 'pads 1 and 2 overlap')
      s%pads%pivot_angle_deg = [14.0_wp, -45.0_wp]
      call expect_refused(s, 'pads%pivot_angle_deg', 'overlap')
      s%pads%pivot_angle_deg = [-45.0_wp, -45.0_wp + 299]
      call expect_allowed(s, 'one degree on the other side')
      s%pads%pivot_angle_deg = [-45.0_wp, -45.0_wp + 301]
      call expect_refused(s, 'pads%pivot_angle_deg', 'overlap')
      ! the first pad reaches 42 degrees on from its pivot, the second 18 degrees back from its own
      s%pads%pivot_ratio = [0.7_wp, 0.7_wp]
      s%pads%pivot_angle_deg = [0.0_wp, 61.0_wp]
      call expect_allowed(s, 'pivots behind the middle')
      s%pads%pivot_ratio = [0.7_wp, 0.5_wp]
      s%pads%pivot_angle_deg = [0.0_wp, 71.0_wp]
      call expect_refused(s, 'pads%pivot_angle_deg', 'pads 1 and 2 overlap')
      s%pads%pivot_angle_deg = [0.0_wp, 73.0_wp]
      call expect_allowed(s, 'one pivot behind the middle')
   end subroutine room_for_pads

   !> The group coefficients belongs to its task, and what belongs to a march does not.
   subroutine coefficients()
      type(scene_type) :: s
      s = scene_type()
      s%coefficients%frequency_ratio = [1.0_wp, 0.5_wp]
      call expect_refused(s, 'coefficients%frequency_ratio', 'has no effect but with case%task = ''coefficients''')
      s%coefficients%frequency_ratio = [0.5_wp]
      call expect_refused(s, 'coefficients%frequency_ratio', 'has no effect but with')
      s%about%task = 'coefficients'
      call expect_allowed(s, 'half the speed')
      s%coefficients%threshold_up_to_rpm = 6501
      call expect_allowed(s, 'a threshold above the speed')
      s%coefficients%threshold_up_to_rpm = 6500
      call expect_refused(s, 'coefficients%threshold_up_to_rpm', 'must be 0 or above operation%speed_rpm = 6500')
      s%coefficients%threshold_up_to_rpm = 0
      s%coefficients%cross_stiffness = -1e6_wp
      call expect_allowed(s, 'a cross-coupled stiffness of either sign')
      s%operation%final_speed_rpm = 7000
      call expect_refused(s, 'operation%final_speed_rpm', 'must be operation%speed_rpm = 6500')
      s = scene_type()
      s%coefficients%cross_stiffness = 1
      call expect_refused(s, 'coefficients%cross_stiffness', 'has no effect but with')
      s%coefficients%cross_stiffness = 0
      s%coefficients%threshold_up_to_rpm = 7000
      s%about%task = 'equilibrium'
      call expect_refused(s, 'coefficients%threshold_up_to_rpm', 'has no effect but with')
      s = scene_type()
      s%about%task = 'coefficients'
      s%start%from = 'centred'
      call expect_refused(s, 'start%from', 'has no effect with case%task = ''coefficients''')
      s%start%from = 'equilibrium'
      s%start%journal(2) = 1e-6_wp
      call expect_refused(s, 'start%journal', 'a disturbance: has no effect with')
   end subroutine coefficients

   subroutine first_of_several()
      type(scene_type) :: s
      s = scene_type()
      s%film%circumferential_cells = 41
      s%friction%dynamic_coefficient = 1
      call expect_refused(s, 'film%circumferential_cells', 'must be even')
   end subroutine first_of_several
end program test_scene_checks
