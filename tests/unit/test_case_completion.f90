!> What follows from a case: clearance by preload, the pads' bodies by density and thickness, samples and size of the
!> result.
program test_case_completion
   use kinds, only: wp, degree
   use case_groups, only: is_set
   use case_inputs, only: case_type
   use input_cases, only: case_of, expect_refused
   use errors, only: error_type
   use case_namelist, only: case_from_text
   use case_completion, only: annular_sector_type, new_annular_sector, fill_replaced
   use bearing_numbers, only: preload, clearance_ratio, length_over_diameter, load, specific_load, sommerfeld_number
   use namelist_writer, only: derived_text, namelist_of
   use case_remarks, only: remarks_on_case
   use result_size, only: sample_count, result_bytes, bytes_text, size_note
   use check, only: runs, expect, expect_close, expect_no_error, between, report
   implicit none (type, external)
   integer :: i

   do i = 1, 5
      if (runs('quadrature')) call quadrature()
   end do
   if (runs('ring')) call ring()
   if (runs('paper_pads')) call paper_pads()
   if (runs('rockers')) call rockers()
   if (runs('other_pads')) call other_pads()
   if (runs('given_in_part')) call given_in_part()
   if (runs('each_pad')) call each_pad()
   if (runs('preloads')) call preloads()
   if (runs('refused')) call refused()
   if (runs('replaced')) call replaced()
   if (runs('numbers')) call numbers()
   if (runs('samples')) call samples()
   if (runs('sizes')) call sizes()
   if (runs('notes')) call size_notes()
   call report()

contains

   !> The sums over the points in the middle of n x n parts of the sector, whose error falls as 1/n^2: that of two such
   !> sums, extrapolated.
   subroutine quadrature()
      type(annular_sector_type) :: sector
      real(wp) :: bore, thickness, leading, trailing, length, distance, sums(4)
      bore = between(0.02_wp, 0.5_wp)
      thickness = bore*between(0.05_wp, 1.0_wp)
      leading = between(0.01_wp, 2.8_wp)
      trailing = between(0.01_wp, 2.8_wp)
      length = between(0.01_wp, 0.5_wp)
      distance = thickness*between(0.1_wp, 2.0_wp)
      sector = new_annular_sector(bore, thickness, leading, trailing, length, distance)
      sums = (4*sums_of(400, bore, thickness, leading, trailing, length, distance) &
         & - sums_of(200, bore, thickness, leading, trailing, length, distance))/3
      call expect_close(sector%volume/sums(1), 1.0_wp, 1e-8_wp, 'volume')
      call expect_close(sector%centre_tangential, sums(2)/sums(1), 1e-8_wp*bore, 'centre along the pad')
      call expect_close(sector%centre_radial, sums(3)/sums(1), 1e-8_wp*bore, 'centre outward')
      call expect_close(sector%squared_radius, sums(4)/sums(1), 1e-8_wp*bore**2, 'inertia')
   end subroutine quadrature

   !> Volume, first moments and second moment about the pivot, from n x n parts.
   pure function sums_of(n, bore, thickness, leading, trailing, length, distance)
      integer, intent(in) :: n
      real(wp), intent(in) :: bore, thickness, leading, trailing, length, distance
      real(wp) :: sums_of(4), radius, angle, x, y, share
      integer :: j, k
      sums_of = 0
      do j = 1, n
         radius = bore + (j - 0.5_wp)/n*thickness
         do k = 1, n
            angle = -trailing + (k - 0.5_wp)/n*(leading + trailing)
            x = radius*sin(angle)
            y = radius*cos(angle) - (bore + distance)
            share = radius*thickness/n*(leading + trailing)/n*length
            sums_of = sums_of + share*[1.0_wp, x, y, x**2 + y**2]
         end do
      end do
   end function sums_of

   !> A whole ring has its centre of gravity in its middle.
   subroutine ring()
      type(annular_sector_type) :: sector
      real(wp), parameter :: half = 180*degree
      sector = new_annular_sector(0.1_wp, 0.02_wp, half, half, 0.05_wp, 0.03_wp)
      call expect_close(sector%volume, half*(0.12_wp**2 - 0.1_wp**2)*0.05_wp, 1e-17_wp, 'volume')
      call expect_close(sector%centre_tangential, 0.0_wp, 1e-16_wp, 'centre along the pad')
      call expect_close(sector%centre_radial, -0.13_wp, 1e-16_wp, 'centre outward')
      call expect_close(sector%squared_radius, 0.5_wp*(0.1_wp**2 + 0.12_wp**2) + 0.13_wp**2, 1e-16_wp, 'inertia')
   end subroutine ring

   !> Clearances, supply and number of pads leave the paper's pads.
   subroutine paper_pads()
      type(case_type) :: s
      s = case_of('&pads pivot_angle_deg = -90, 0, 90, motion = ''tilting_only'' /' &
         & //' &bearing assembled_clearance = 70e-6, machined_clearance = 90e-6, supply_pressure = 1e5 /')
      call expect_close(maxval(abs(s%bearings(1)%pads%mass - 0.8108_wp)), 0.0_wp, 0.0_wp, 'mass')
      call expect_close(maxval(abs(s%bearings(1)%pads%inertia - 4.055e-4_wp)), 0.0_wp, 0.0_wp, 'inertia')
      call expect_close(maxval(abs(s%bearings(1)%pads%centre_tangential)), 0.0_wp, 0.0_wp, 'C_xi')
      call expect_close(maxval(abs(s%bearings(1)%pads%centre_radial + 10.1e-3_wp)), 0.0_wp, 0.0_wp, 'C_eta')
      s = case_of('&pads mass = 0.9 /')
      call expect_close(s%bearings(1)%pads%mass(2), 0.9_wp, 0.0_wp, 'a mass that is given')
      call expect_close(s%bearings(1)%pads%inertia(2), 4.055e-4_wp, 0.0_wp, 'the paper''s inertia beside it')
   end subroutine paper_pads

   !> The contact of a rocker is as long as the pad, or as given.
   subroutine rockers()
      type(case_type) :: s
      character(len=*), parameter :: rocker = '&bearing axial_length = 0.1, 0.2 / &pivot law = ''rocker'', ' &
         & //'socket_radius = 0.08, radius_difference = 0.02'
      s = case_of(rocker//' /')
      call expect_close(maxval(abs(s%bearings(1)%pivot%contact_length - [0.1_wp, 0.2_wp])), 0.0_wp, 0.0_wp, 'pads')
      s = case_of(rocker//', contact_length(2) = 0.05 /')
      call expect_close(maxval(abs(s%bearings(1)%pivot%contact_length - [0.1_wp, 0.05_wp])), 0.0_wp, 0.0_wp, 'given')
      s = case_of('&case /')
      call expect(.not. any(is_set(s%bearings(1)%pivot%contact_length)), 'balls have none')
   end subroutine rockers

   !> Pads of another size, and those whose density or thickness is given, are annular sectors.
   subroutine other_pads()
      type(case_type) :: s
      type(annular_sector_type) :: sector
      real(wp), parameter :: half = 34.65_wp*degree
      s = case_of('&bearing axial_length = 0.2 /')
      sector = new_annular_sector(0.05_wp, 14e-3_wp, half, half, 0.2_wp, 14e-3_wp)
      call expect_close(s%bearings(1)%pads%mass(1), 7850*sector%volume, 1e-12_wp, &
         & 'steel, as thick as the pivot is away')
      call expect_close(s%bearings(1)%pads%inertia(1), 7850*sector%volume*sector%squared_radius, 1e-14_wp, &
         & 'its inertia')
      call expect_close(s%bearings(1)%pads%centre_radial(1), sector%centre_radial, 1e-15_wp, 'its centre')
      call expect_close(s%bearings(1)%pads%centre_tangential(1), 0.0_wp, 1e-17_wp, 'symmetric')
      s = case_of('&pads density = 8800, thickness = 0.02 /')
      sector = new_annular_sector(0.05_wp, 0.02_wp, half, half, 0.1_wp, 14e-3_wp)
      call expect_close(s%bearings(1)%pads%mass(2), 8800*sector%volume, 1e-12_wp, 'bronze, thicker')
      call expect(.not. any(is_set(s%bearings(1)%pads%density)) &
         & .and. .not. any(is_set(s%bearings(1)%pads%thickness)), 'no more to find')
      s = case_of('&pads pivot_ratio = 0.6 /')
      call expect(s%bearings(1)%pads%centre_tangential(1) > 0, &
         & 'behind the middle: the centre lies towards the leading edge')
      ! steel of the paper's size lies close to the paper's pads
      s = case_of('&pads density = 7850 /')
      call expect_close(s%bearings(1)%pads%mass(1)/0.8108_wp, 1.0_wp, 0.08_wp, 'mass near the paper''s')
      call expect_close(s%bearings(1)%pads%centre_radial(1)/(-10.1e-3_wp), 1.0_wp, 0.08_wp, 'centre near the paper''s')
   end subroutine other_pads

   !> A mass that is given replaces the density.
   subroutine given_in_part()
      type(case_type) :: s, whole
      whole = case_of('&bearing axial_length = 0.2 / &pads density = 7850 /')
      s = case_of('&bearing axial_length = 0.2 / &pads mass = 3 /')
      call expect_close(s%bearings(1)%pads%inertia(1)/s%bearings(1)%pads%mass(1), whole%bearings(1)%pads%inertia(1) &
         & /whole%bearings(1)%pads%mass(1), 1e-15_wp, &
         & 'inertia over mass is that of the size')
      s = case_of('&bearing axial_length = 0.2 / &pads inertia = 1e-2 /')
      call expect_close(s%bearings(1)%pads%mass(1), whole%bearings(1)%pads%mass(1), 0.0_wp, &
         & 'an inertia leaves the mass')
      call expect_close(s%bearings(1)%pads%inertia(1), 1e-2_wp, 0.0_wp, 'and stands')
   end subroutine given_in_part

   !> Each pad by itself.
   subroutine each_pad()
      type(case_type) :: s
      s = case_of('&pads arc_deg = 60, 69.3 /')
      call expect_close(s%bearings(1)%pads%mass(2), 0.8108_wp, 0.0_wp, 'the second is the paper''s')
      call expect(s%bearings(1)%pads%mass(1) < 0.7_wp, 'the first is not')
      s = case_of('&pads arc_deg = 60, mass(2) = 0.7, thickness(1) = 0.01 /')
      call expect_close(s%bearings(1)%pads%mass(2), 0.7_wp, 0.0_wp, 'one mass is given')
      call expect(s%bearings(1)%pads%mass(1) < 0.5_wp, 'one is thinner')
   end subroutine each_pad

   subroutine preloads()
      type(case_type) :: s
      s = case_of('&bearing preload = 0.3 /')
      call expect_close(s%bearings(1)%machined_clearance(1), 80e-6_wp/0.7_wp, 0.0_wp, 'c_m from preload')
      call expect(.not. any(is_set(s%bearings(1)%preload)), 'it is used up')
      call expect_close(maxval(preload(s%bearings(1))), 0.3_wp, 1e-15_wp, 'and comes back')
      s = case_of('&bearing preload = 0 /')
      call expect_close(s%bearings(1)%machined_clearance(1), 80e-6_wp, 0.0_wp, 'none')
      call expect(remarks_on_case(s) == '', 'without a remark')
      s = case_of('&bearing preload = -1 /')
      call expect_close(s%bearings(1)%machined_clearance(1), 40e-6_wp, 0.0_wp, 'the most negative')
      call expect(index(remarks_on_case(s), 'negative preload -1') == 1, 'has a remark')
      call expect(index(derived_text(s), '! remark: negative preload') > 0, 'that --check shows')
      s = case_of('&case /')
      call expect_close(maxval(preload(s%bearings(1))), 0.2_wp, 1e-15_wp, 'the paper''s')
   end subroutine preloads

   subroutine refused()
      call expect_refused('&bearing preload = 0.3, machined_clearance = 1e-4 /', &
         & 'bearing%preload = 0.3: bearing%machined_clearance = 1e-4 is given too; give one of them')
      call expect_refused('&bearing preload = 1 /', 'bearing%preload = 1: must be -1 to 0.999')
      call expect_refused('&bearing preload = 0.999, assembled_clearance = 2e-4 /', 'bearing%machined_clearance = 0.2')
      call expect_refused('&pads mass = 1, density = 7850 /', 'pads%density = 7850: pads%mass = 1 is given too')
      call expect_refused('&pads mass(2) = 1, density = 7850 /', '(pad 2)')
      call expect_refused('&pads mass = 1, inertia = 1, centre_tangential = 0, centre_radial = 0, thickness = 0.1 /', &
         & 'pads%thickness = 0.1: has no effect')
      call expect_refused('&bearing journal_radius = 1e-3, axial_length = 1e-4 /' &
         & //' &pads thickness = 1e-6, density = 1000 /', 'from the size of the pad: must be 1e-9 to 1e9')
      call expect_refused('&rotor balance_grade = 2.5, unbalance = 0.01 /', 'rotor%balance_grade = 2.5: ' &
         & //'rotor%unbalance = 0.01 is given too; give one of them')
      call expect_refused('&rotor balance_speed_rpm = 3000 /', 'rotor%balance_speed_rpm = 3000: has no effect without')
      call expect_refused('&friction bristle_damping = 5, characteristic_load = 1e4 /', 'friction%bristle_damping = ' &
         & //'5: friction%characteristic_load = 10000 is given too; give one of them')
      call expect_refused('&case task = ''branch'' / &rotor balance_grade = 2.5 / &branch parameter = ' &
         & //'''rotor%unbalance'', last = 0.02 /', 'has no value of its own here')
   end subroutine refused

   !> What another variable replaces is not in the text of a case; that of an older result may have it.
   subroutine replaced()
      character(len=*), parameter :: given = '&rotor balance_grade = 2.5 / &friction bristle_damping = 5 /', &
         & older = '&rotor unbalance = 0.01, balance_grade = 2.5 / &friction bristle_damping = 5, ' &
         & //'characteristic_load = 1e4 /'
      type(case_type) :: inputs, found
      type(error_type), allocatable :: error
      inputs = case_of(given)
      call expect(index(namelist_of(inputs), ' unbalance') == 0, 'left out: unbalance')
      call expect(index(namelist_of(inputs), 'characteristic') == 0, 'left out: load')
      call case_from_text(older, 'older.h5', found, error, of_result=.true.)
      call expect_no_error(error, 'an older result')
      call expect(namelist_of(found) == namelist_of(inputs), 'the same case')
      call fill_replaced(found)
      call expect(index(namelist_of(found), '  unbalance = 0.01') > 0, 'the text of an older study: unbalance')
      call expect(index(namelist_of(found), 'characteristic_load = 10000') > 0, 'the text of an older study: load')
      call case_from_text('&rotor balance_speed_rpm = 3000 /', 'older.h5', found, error, of_result=.true.)
      call expect_no_error(error, 'an older result with a speed of no grade')
      call expect(index(namelist_of(case_of('&case /')), '  unbalance = 0.01') > 0, 'the paper''s unbalance')
   end subroutine replaced

   !> The numbers of the five-pad bearing, by hand.
   subroutine numbers()
      type(case_type) :: s
      s = case_of('&bearing journal_radius = 63.5e-3, axial_length = 63.5e-3, preload = 0.3, viscosity = 0.022,' &
         & //' assembled_clearance = 0.2e-3 / &rotor mass = 1500, balance_grade = 2.5 / &operation speed_rpm = 3000 /')
      call expect_close(clearance_ratio(s%bearings(1)), 0.2_wp/63.5_wp, 1e-17_wp, 'c_r/R_J')
      call expect_close(length_over_diameter(s%bearings(1)), 0.5_wp, 0.0_wp, 'L/D')
      call expect_close(load(s), 14715.0_wp, 1e-9_wp, 'load')
      call expect_close(specific_load(s), 14715/(0.127_wp*0.0635_wp), 1e-6_wp, 'specific load')
      call expect_close(sommerfeld_number(s), 0.022_wp*50*0.127_wp*0.0635_wp/14715*(63.5_wp/0.2_wp)**2, 1e-14_wp, &
         & 'Sommerfeld number')
      call expect(index(derived_text(s), '0.0119362  kg m, by rotor%balance_grade') > 0, 'unbalance by grade')
      s = case_of('&rotor gravity = 0 /')
      call expect(index(derived_text(s), 'Sommerfeld') == 0, 'no Sommerfeld number without load')
      call expect(index(derived_text(s), 'kg m') == 0, 'no unbalance without grade')
   end subroutine numbers

   !> 6000 rpm: a hundred revolutions a second.
   subroutine samples()
      character(len=*), parameter :: second = '&operation speed_rpm = 6000, duration = 1 /'
      call expect(sample_count(case_of(second//'&output samples_per_revolution = 10 /')) == 1001, 'both ends')
      call expect(sample_count(case_of(second//'&output samples_per_revolution = 10, start_time = 0.5 /')) == 501, &
         & 'from the middle on')
   end subroutine samples

   !> Of a value 8 bytes: 7 of the journal, and of each pad those that its model has.
   subroutine sizes()
      character(len=*), parameter :: case = '&operation speed_rpm = 6000, duration = 1 / ' &
         & //'&output samples_per_revolution = 1000 / &pads pivot_angle_deg = -90, 0, 90, 180 '
      call expect_values(case//'/ &asperity model = ''none'' /', 7 + 4*10)
      call expect_values(case//'/', 7 + 4*11)
      call expect_values(case//'/ &friction model = ''lugre'' /', 7 + 4*12)
      call expect_values(case//'motion = ''tilting_only'' /', 7 + 4*9)
      call expect_values(case//'motion = ''fixed'', arc_deg = 80 / &friction model = ''none'' /', 7 + 4*5)
      call expect(.not. result_bytes(case_of('&case task = ''equilibrium'' /')) > 0, 'an equilibrium has no samples')
   end subroutine sizes

   subroutine expect_values(text, values)
      character(len=*), intent(in) :: text
      integer, intent(in) :: values
      integer :: found
      found = nint((result_bytes(case_of(text)) - 1e5_wp)/(8*100001))
      call expect(found == values, text//': values a sample')
   end subroutine expect_values

   subroutine size_notes()
      type(case_type) :: inputs
      call expect(bytes_text(5.404e8_wp) == '540 MB', 'megabytes')
      call expect(bytes_text(1.23e9_wp) == '1.2 GB', 'gigabytes')
      inputs = case_of('&operation speed_rpm = 6000, duration = 1 /')
      call expect(size_note(inputs, 1) == '', 'a small one is no news')
      call expect(index(size_note(inputs, 100), ' 36001 samples in each of 100 files; ') > 0, 'together they are')
      inputs = case_of('&operation speed_rpm = 6000, duration = 30 /')
      call expect(index(size_note(inputs, 1), 'note: about 251 MB of results, 1080001 samples; ') == 1, &
         & 'a long run: '//size_note(inputs, 1))
   end subroutine size_notes
end program test_case_completion
