!> Cases from text and back: defaults, one value for all pads, ranges, round trip to the last bit.
program test_case_namelist
   use, intrinsic :: ieee_exceptions, only: ieee_set_halting_mode, ieee_overflow
   use kinds, only: wp, i8
   use errors, only: error_type, input_error
   use case_groups, only: bearing_type, is_set
   use case_inputs, only: case_type
   use variable_table, only: variable_table_type
   use case_fields, only: list_variables, put_variables
   use assignments, only: namelist_type
   use namelist_text, only: parse_case
   use case_namelist, only: case_from_text, case_from_namelist
   use namelist_writer, only: namelist_of
   use input_cases, only: case_of, expect_refused
   use check, only: runs, expect, expect_close, expect_no_error, expect_error, report
   implicit none (type, external)

   character(len=*), parameter :: newline = achar(10)
   integer :: i

   if (runs('paper_tables')) call paper_tables()
   if (runs('one_value_for_all_pads')) call one_value_for_all_pads()
   if (runs('each_pad_its_own')) call each_pad_its_own()
   if (runs('words_and_numbers')) call words_and_numbers()
   if (runs('overrides')) call overrides()
   do i = 1, 10
      if (runs('round_trip')) call round_trip()
   end do
   if (runs('lists')) call lists()
   if (runs('awkward_titles')) call awkward_titles()
   if (runs('refused_values')) call refused_values()
   if (runs('hints')) call hints()
   if (runs('no_shaft')) call no_shaft()
   if (runs('branches')) call branches()
   call report()

contains

   !> Where a branch ends and with which step it starts where the case leaves it out: twice the first value, a twentieth
   !> of the way.
   subroutine branches()
      character(len=*), parameter :: over = '&case task = ''branch'' / &branch parameter = '
      type(case_type) :: s
      s = case_of(over//'''operation%speed_rpm'' /')
      call expect_list([s%branch%last, s%branch%step], [13000.0_wp, 325.0_wp], 'speed')
      s = case_of(over//'''rotor%mass'', last = 1000 /')
      call expect_list([s%branch%last, s%branch%step], [1000.0_wp, -50.0_wp], 'downwards')
      s = case_of(over//'''rotor%mass'', step = 7 /')
      call expect_list([s%branch%last, s%branch%step], [4000.0_wp, 7.0_wp], 'with a step')
      s = case_of(over//'''pivot%poisson_ratio(1)'' /')
      call expect_list([s%branch%last, s%branch%step], [0.5_wp, 0.01_wp], 'up to what is allowed')
      call expect_refused(over//'''rotor%static_load(1)'' /', 'branch%last: must be given, as twice')
      call expect_refused(over//'''rotor%mas'' /', 'did you mean mass')
   end subroutine branches

   !> What a refusal says of units, of names as data sheets have them, and of commas in numbers.
   subroutine hints()
      call expect_refused('&bearing journal_radius = 50.8 /', 'must be 1e-4 to 10 m; 50.8 mm are 0.0508')
      call expect_refused('&bearing axial_length = 60 /', '(both in m; pad 1); 60 mm are 0.06; 60 in are 1.524')
      call expect_refused('&bearing assembled_clearance = 0.076, preload = 0.3 /', &
         & 'bearing%assembled_clearance = 0.076: must be at most 0.1 of bearing%journal_radius = 0.0499 (both in m; ' &
         & //'pad 1); 0.076 mm are 7.6e-5; 0.076 in are 0.0019304')
      call expect_refused('&bearing assembled_clearance = 0.0035, preload = 0.3 /', &
         & '(all in m; pad 1); 0.0035 in are 8.89e-5')
      call expect_refused('&bearing machined_clearance = 0.1 /', '(both in m; pad 1); 0.1 mm are 1e-4')
      call expect_refused('&bearing viscosity = 19 /', 'must be 1e-6 to 10 Pa s; 19 mPa s are 0.019')
      call expect_refused('&oil kinematic_viscosity = 46, 6.8 /', 'must be 5e-7 to 1 m^2/s; 46 mm^2/s are 4.6e-5')
      call expect_refused('&pads density = 7.85 /', 'must be 1000 to 100000 kg/m^3; 7.85 g/cm^3 are 7850')
      call expect_refused('&pads density = 0.283 /', '0.283 lb/in^3 are 7833.41')
      call expect_refused('&oil grade = 32, density = 0.87 /', 'kg/m^3; 0.87 g/cm^3 are 870')
      call expect_refused('&oil grade = 32, density_at_15 = 54 /', 'kg/m^3; 54 lb/ft^3 are 864.999')
      call expect_refused('&oil specific_heat = 1.95 /', 'J/(kg K); 1.95 kJ/(kg K) are 1950')
      call expect_refused('&pads young_modulus = 210 /', 'Pa; 210 GPa are 2.1e11')
      call expect_refused('&asperity roughness = 0.5 /', 'm; 0.5 um are 5e-7')
      call expect_refused('&pads mass = 1500 /', '0.153015 (pad 1); 1500 g are 1.5')
      call expect_refused('&rotor weight = 1500 /', '(did you mean rotor%mass in kg?)')
      call expect_refused('&pads pivot_offset = 0.5 /', '(did you mean pads%pivot_ratio?)')
      call expect_refused('&pads offset = 0.5 /', '(did you mean pads%pivot_ratio?)')
      call expect_refused('&pads stiffness = 1e9 /', '(did you mean pivot%stiffness?)')
      call expect_refused('&oil vg = 46 /', '(did you mean oil%grade?)')
      call expect_refused('&bearing radial_clearance = 1e-4 /', '(did you mean bearing%assembled_clearance?)')
      call expect_refused('&bearing diameter = 0.1 /', '(did you mean bearing%journal_radius, half of it?)')
      call expect_refused('&pads arc_deg(0) = 60 /', 'pads%arc_deg(0): elements count from 1')
      call expect_refused('&operation speed_rpm = 9,000 /', 'a decimal has a point (9.000), and thousands have no ' &
         & //'comma (9000)')
      call expect_refused('&bearing viscosity = 0,019 /', 'a decimal has a point (0.019)')
      call expect_refused('&operation speed_rpm = 1000-6000 /', 'must be a number, 0.001 to 1e6 rpm; for one run of ' &
         & //'each value: sweep%operation%speed_rpm = 1000:6000:500')
      call expect_refused('&operation speed_rpm = 1000..6000 /', 'sweep%operation%speed_rpm = 1000:6000:500')
      call expect_refused('&operation speed_rpm = 3000, 5000 /', 'for one run of each value: sweep%operation%speed_rpm')
   end subroutine hints

   !> Groups of machines in a case of one bearing, where they stand.
   subroutine no_shaft()
      call expect_refused(newline//'&support mass = 100 /', 'case.nml line 2: &support: needs a shaft (&shaft)')
      call expect_refused('&case /'//newline//'&disc station = 1 /', 'case.nml line 2: &disc: needs a shaft')
      call expect_refused('&pads bearing = ''left'', arc_deg = 60 /', 'case.nml line 1: &pads: needs a shaft')
      call expect_refused('&shaft length = 1, diameter = 0.1 / &support mass = 100 /', 'two or more groups &bearing')
   end subroutine no_shaft

   subroutine expect_list(found, expected, what)
      real(wp), intent(in) :: found(:), expected(:)
      character(len=*), intent(in) :: what
      call expect(size(found) == size(expected), 'how many: '//what)
      if (size(found) == size(expected)) call expect_close(maxval(abs(found - expected)), 0.0_wp, 0.0_wp, what)
   end subroutine expect_list

   !> An empty group gives Tables 1 and 2 of the paper.
   subroutine paper_tables()
      type(case_type) :: s
      type(bearing_type) :: b
      s = case_of('&case /')
      b = s%bearings(1)
      call expect_list([b%journal_radius, b%viscosity], [49.9e-3_wp, 19e-3_wp], 'Table 1: bearing')
      call expect_list(b%machined_clearance, [100e-6_wp, 100e-6_wp], 'Table 1: pad clearance')
      call expect_list(b%assembled_clearance, [80e-6_wp, 80e-6_wp], 'Table 1: bearing clearance')
      call expect_list(b%axial_length, [100e-3_wp, 100e-3_wp], 'Table 1: pad length')
      call expect_list([b%supply_pressure, b%ambient_pressure, b%cavitation_pressure], &
         & [0.0_wp, 0.0_wp, 0.0_wp], 'pressures')
      call expect_list(b%pads%pivot_angle_deg, [-45.0_wp, 225.0_wp], 'load between the two lower pads')
      call expect_list(b%pads%arc_deg, [69.3_wp, 69.3_wp], 'Table 1: angular pad length')
      call expect_list(b%pads%pivot_ratio, [0.5_wp, 0.5_wp], 'Table 1: pivot offset')
      call expect_list(b%pads%pivot_distance, [14e-3_wp, 14e-3_wp], 'Table 1: kappa')
      call expect_list(b%pads%mass, [0.8108_wp, 0.8108_wp], 'Table 1: pad mass')
      call expect_list(b%pads%inertia, [4.055e-4_wp, 4.055e-4_wp], 'Table 1: pad inertia')
      call expect_list(b%pads%centre_tangential, [0.0_wp, 0.0_wp], 'Table 1: C_xi')
      call expect_list(b%pads%centre_radial, [-10.1e-3_wp, -10.1e-3_wp], 'Table 1: C_eta')
      call expect_list([s%rotor%mass, s%rotor%unbalance, s%rotor%gravity, s%unbalance()], &
         & [2000.0_wp, 0.01_wp, 9.81_wp, 0.01_wp], 'Table 1: rotor')
      call expect_list([b%pivot%socket_radius(1), b%pivot%radius_difference(1), b%pivot%deflection_factor], &
         & [13e-3_wp, 15e-6_wp, 4.0_wp], 'Table 2: pivot')
      call expect_list([b%pivot%young_modulus, b%pivot%poisson_ratio], [2.1e11_wp, 2.1e11_wp, 0.3_wp, 0.3_wp], &
         & 'Table 2: steel')
      call expect_list([b%friction%decay, b%friction%critical_velocity, b%friction%stribeck_velocity, &
         & b%friction%stribeck_exponent, b%friction%bristle_stiffness, b%friction%viscous_coefficient, &
         & b%friction%characteristic_load], [1000.0_wp, 1e-5_wp, 1e-3_wp, 1.0_wp, 1e6_wp, 0.0_wp, 1e4_wp], &
         & 'Table 2: friction')
      call expect_list([s%operation%speed_rpm, s%operation%final_speed_rpm, s%operation%duration], &
         & [6500.0_wp, 6500.0_wp, 2.0_wp], 'steady running for 2 s')
      call expect(b%pads%motion == 'tilting_radial' .and. b%pivot%law == 'fang' .and. s%about%task == 'march', 'words')
   end subroutine paper_tables

   subroutine one_value_for_all_pads()
      type(case_type) :: s
      s = case_of('&pads pivot_angle_deg = -45, 45, 135, 225, mass = 0.9, arc_deg = 4*60. pivot_ratio = 1*0.6 /')
      call expect(s%bearings(1)%pad_count() == 4, 'as many pads as angles')
      call expect_list(s%bearings(1)%pads%mass, spread(0.9_wp, 1, 4), 'one value for all pads')
      call expect_list(s%bearings(1)%pads%arc_deg, spread(60.0_wp, 1, 4), 'a repeat for all pads')
      call expect_list(s%bearings(1)%pads%pivot_ratio, spread(0.6_wp, 1, 4), 'a repeat of one')
      call expect_list(s%bearings(1)%pads%pivot_distance, spread(14e-3_wp, 1, 4), 'defaults for all pads')
      s = case_of('&pads pivot_angle_deg = -90 /')
      call expect(s%bearings(1)%pad_count() == 1 .and. size(s%bearings(1)%pads%centre_radial) == 1, 'a single pad')
   end subroutine one_value_for_all_pads

   subroutine each_pad_its_own()
      type(case_type) :: s
      s = case_of('&pads mass(2) = 0.7, pivot_distance(2) = 15e-3 arc_deg(1) = 50, 55, pivot_ratio = 0.5, 0.6, ' &
         & //'centre_tangential = 1e-3 centre_tangential(2) = -1e-3 /')
      call expect_list(s%bearings(1)%pads%pivot_distance, [14e-3_wp, 15e-3_wp], 'one pad by its subscript')
      call expect_list(s%bearings(1)%pads%mass(2:), [0.7_wp], 'one that is given only there')
      call expect_list(s%bearings(1)%pads%arc_deg, [50.0_wp, 55.0_wp], 'values from a subscript on')
      call expect_list(s%bearings(1)%pads%pivot_ratio, [0.5_wp, 0.6_wp], 'one value a pad')
      call expect_list(s%bearings(1)%pads%centre_tangential, [1e-3_wp, -1e-3_wp], 'all pads, then one of them')
   end subroutine each_pad_its_own

   subroutine words_and_numbers()
      type(case_type) :: s
      s = case_of('&Friction MODEL = "LuGre" decay=1.D3/'//achar(13) &
         & //newline//'&rotor static_load(2) = +1.5e+3, mass=1e3,/' &
         & //newline//'&film circumferential_cells = 40 solver='' sor ''/')
      call expect(s%bearings(1)%friction%model == 'lugre' .and. s%bearings(1)%film%solver == 'sor', &
         & 'words in capitals and with blanks')
      call expect_list([s%bearings(1)%friction%decay, s%rotor%static_load, s%rotor%mass], [1000.0_wp, 0.0_wp, &
         & 1500.0_wp, &
         & 1000.0_wp], 'numbers in several forms')
      call expect(s%bearings(1)%film%circumferential_cells == 40, 'a whole number')
      s = case_of('&operation speed_rpm = 1500, final_speed_rpm = 6500, duration = 10/ &rotor balance_grade = 6.3/')
      call expect_list([s%operation%final_speed_rpm], [6500.0_wp], 'a run-up')
      ! eq (26): 9549*6.3*2000/6500 g mm
      call expect_close(s%unbalance(), 0.0185104_wp, 1e-7_wp, 'unbalance by grade')
   end subroutine words_and_numbers

   subroutine overrides()
      type(case_type) :: s
      type(error_type), allocatable :: error
      call override('&rotor mass = 1/', [character(len=30) :: 'rotor%mass=1500', &
         & 'case%title=''a b''', 'rotor%mass=1600'], s, error)
      call expect_no_error(error, 'overrides')
      call expect_list([s%rotor%mass], [1600.0_wp], 'the last override stands')
      call expect(s%about%title == 'a b', 'a group the file lacks')
      call override('&rotor mass = 1/', ['rotor%mass=-1'], s, error)
      call expect_error(error, input_error, '--set: rotor%mass = -1', 'an override is checked')
      call override('&rotor balance_grade = 2.5/ &oil grade = 46/ &pads mass = 1, 2/ &friction bristle_damping = 10/', &
         & [character(len=30) :: 'rotor%balance_grade=-1', 'oil%grade=0', 'pads%mass(2)=-1', &
         & 'friction%bristle_damping=-1', 'operation%final_speed_rpm=-1'], s, error)
      call expect_no_error(error, 'what the file gives is taken back')
      call expect(.not. (is_set(s%rotor%balance_grade) .or. is_set(s%bearings(1)%friction%bristle_damping)), 'not set')
      call expect(s%bearings(1)%oil%law == 'constant', 'no oil')
      call expect_list([s%bearings(1)%pads%mass, s%operation%final_speed_rpm], [1.0_wp, 0.8108_wp, 6500.0_wp], &
         & 'found again')
      call override('&rotor /', ['rotor%balance_grade=-0.5'], s, error)
      call expect_error(error, input_error, 'rotor%balance_grade = -0.5: must be 1e-6 to 100000', 'but for -1')
      call override('&rotor static_load(1) = 1, 2 mass = 1/', [character(len=30) :: &
         & 'rotor%static_load(2)=3', 'rotor%mass(1)=4', 'rotor%static_load(1)=5, 6'], s, error)
      call expect_no_error(error, 'an override of an element')
      call expect_list([s%rotor%static_load, s%rotor%mass], [5.0_wp, 6.0_wp, 4.0_wp], 'the last one stands')
   end subroutine overrides

   !> The case of a text with overrides in place.
   subroutine override(text, settings, inputs, error)
      character(len=*), intent(in) :: text, settings(:)
      type(case_type), intent(out) :: inputs
      type(error_type), allocatable, intent(out) :: error
      type(namelist_type) :: parsed
      call parse_case(text, 'case.nml', settings, parsed, error)
      if (.not. allocated(error)) call case_from_namelist(parsed, inputs, error)
   end subroutine override

   !> Every real with random last bits: text and back gives the same bits, whatever the writer thinks.
   subroutine round_trip()
      type(case_type) :: inputs, back
      type(variable_table_type) :: before, after
      type(error_type), allocatable :: error
      real(wp) :: share
      integer :: k
      inputs = case_of('&pads pivot_angle_deg = -45, 45, 135, 225 /')
      inputs%rotor%static_load = [1.0_wp/3, -1e7_wp/7]
      inputs%about%title = 'a/b ! it''s "quoted" & more, x = 1  '
      call list_variables(inputs, before)
      do k = 1, before%count
         associate (v => before%variables(k))
            ! up to a thousandth less, so that all bits count; some groups belong to tasks of their own
            if (v%is_text .or. v%whole .or. v%group == 'periodic' .or. v%group == 'coefficients') cycle
            call random_number(share)
            where (is_set(v%values)) v%values = v%values*(1 - 1e-3_wp*share)
         end associate
      end do
      call put_variables(before, inputs)
      call case_from_text(namelist_of(inputs), 'case', back, error)
      call expect_no_error(error, 'the text of a case is accepted')
      call list_variables(back, after)
      do k = 1, before%count
         associate (v => before%variables(k), w => after%variables(k))
            if (v%is_text) then
               call expect(v%word == w%word .and. len(v%word) == len(w%word), v%name//' comes back: '//w%word)
            else if (size(v%values) /= size(w%values)) then
               call expect(.false., 'as many values come back: '//v%name)
            else
               call expect(all(transfer(v%values, [1_i8]) == transfer(w%values, [1_i8])), v%name//': the same bits')
            end if
         end associate
      end do
      call expect(namelist_of(back) == namelist_of(inputs), 'the same text comes back')
   end subroutine round_trip

   !> As many values as there are, and back to the same bits.
   subroutine lists()
      character(len=*), parameter :: task = '&case task = ''coefficients'' / &coefficients frequency_ratio = '
      type(case_type) :: inputs, back
      type(error_type), allocatable :: error
      inputs = case_of(task//'0, 0.1 2*0.5, 1e6 /')
      call expect(size(inputs%coefficients%frequency_ratio) == 5, 'five of them')
      call expect_close(maxval(abs(inputs%coefficients%frequency_ratio - [0.0_wp, 0.1_wp, 0.5_wp, 0.5_wp, 1e6_wp])), &
         & 0.0_wp, 0.0_wp, 'the values')
      call case_from_text(namelist_of(inputs), 'case', back, error)
      call expect_no_error(error, 'the text of a list is accepted')
      call expect(all(transfer(inputs%coefficients%frequency_ratio, [1_i8]) &
         & == transfer(back%coefficients%frequency_ratio, [1_i8])), 'the same bits come back')
      inputs = case_of(task//'1000*0.5 /')
      call expect(size(inputs%coefficients%frequency_ratio) == 1000, 'a thousand')
      call expect_refused(task//'1001*0.5 /', 'at most 1000 values')
      call expect_refused(task//'1, -0.5 /', 'coefficients%frequency_ratio = 1, -0.5: must be 0 to 1e6')
      call expect_refused(task//'nan /', 'must be finite')
      call expect_refused(task//'fast /', 'must be a number')
      call expect_refused('&case task = ''coefficients'' / &coefficients frequency_ratio(2) = 0.5 /', &
         & 'give all of it without subscript')
   end subroutine lists

   subroutine awkward_titles()
      character(len=*), parameter :: titles(*) = [character(len=12) :: '''', '''''', '/', '! no', '&end', ' a', '"', &
         & '=']
      type(case_type) :: inputs, back
      type(error_type), allocatable :: error
      integer :: k
      inputs = case_type()
      do k = 1, size(titles)
         inputs%about%title = trim(titles(k))
         call case_from_text(namelist_of(inputs), 'case', back, error)
         call expect_no_error(error, 'title '//trim(titles(k)))
         if (.not. allocated(error)) call expect(back%about%title == inputs%about%title .and. &
            & len(back%about%title) == len(inputs%about%title), 'title '//trim(titles(k))//' comes back')
      end do
   end subroutine awkward_titles

   subroutine refused_values()
      character(len=*), parameter :: no_numbers(*) = [character(len=7) :: 'heavy', '''1''', '1+2', '1e', '1.2.3', &
         & '0*1', '3*', '0x10', '1_8', '1q3', '.', '--1', '.true.', '(1)', '2000kg']
      integer :: k
      call expect_refused('&roter /', 'unknown group &roter')
      call expect_refused('&rotor /'//newline//'&sweep rotor%mass = 1, 2/', 'line 2: a study, where one case')
      call expect_refused('&rotor'//newline//'m#ss = 1/', 'line 2')
      call expect_refused('&rotor mas = 1/', 'unknown variable rotor%mas (did you mean mass?); known: mass')
      do k = 1, size(no_numbers)
         call expect_refused('&rotor mass = '//trim(no_numbers(k))//'/', 'rotor%mass = '//trim(no_numbers(k)) &
            & //': must be a number')
      end do
      call expect_refused('&rotor mass = 1 2/', &
         & 'takes one value; for one run of each value: sweep%rotor%mass = 1, 2')
      call expect_refused('&rotor mass = 1:2:1/', 'must be a number, 1e-6 to 1e9 kg; for one run of each value: ' &
         & //'sweep%rotor%mass = 1:2:1')
      call expect_refused('&friction model = lugree/', '''lugre'' (did you mean lugre?)')
      call expect_refused('&rotor mass = nan/', 'must be finite')
      call expect_refused('&rotor mass = -Infinity/', 'must be finite')
      call expect_refused('&rotor mass = 0/', 'rotor%mass = 0: must be')
      call expect_refused('&rotor static_load = 1/', 'takes 2 values')
      call expect_refused('&rotor static_load = 1 2 3/', 'at most 2')
      call expect_refused('&film axial_cells = 15.5/', 'whole number')
      call expect_refused('&film axial_cells = 1/', 'must be 2 or more')
      call expect_refused('&friction model = ''coulomb''/', 'must be one of ''none'', ''bengisu_akay'', ''lugre''')
      call expect_refused('&friction model = ''lugre'' ''none''/', 'takes one text')
      call expect_refused('&friction model = ''none lugre''/', 'must be one of')
      call expect_refused('&case title = bare/', 'must stand in quotes')
      call expect_refused('&case title = ''a'' ''b''/', 'takes one text, in quotes where it has blanks')
      call expect_refused('&case title = ''a'//char(255)//'b''/', 'must be UTF-8')
      call expect_refused('&rotor mass = 1 mass(1) = 2/', 'rotor%mass(1) = 2: given twice')
      call expect_refused('&film axial_cells = 8 axial_cells(1) = 9/', 'given twice')
      call expect_refused('&rotor static_load(1) = 1, 2 static_load(2) = 3/', 'static_load(2) = 3: given twice')
      call expect_refused('&pads arc_deg(1) = 50, 55 arc_deg(2) = 60/', 'arc_deg(2) = 60: given twice')
      call expect_refused('&rotor mass = '//repeat('1', 5000)//'/', repeat('1', 70)//'...: must be a number')
      call expect_refused('&pads mass = 1 1 1/', 'at most 2')
      call expect_refused('&pads pivot_angle_deg = 0 120 240 mass = 1 1/', 'one value for all pads or one each (3)')
      call expect_refused('&pads mass(3) = 1/', 'at most 2')
      call expect_refused('&pads pivot_angle_deg(2) = 200/', 'without subscript')
      call expect_refused('&pads pivot_angle_deg = 25*0/', 'at most 24')
      ! a number beyond the largest: reading it must not stop the test where traps are on
      call ieee_set_halting_mode(ieee_overflow, .false.)
      call expect_refused('&rotor mass = 1e999/', 'must be')
      call ieee_set_halting_mode(ieee_overflow, .true.)
   end subroutine refused_values
end program test_case_namelist
