!> How many samples a march takes, and how large its file becomes, before it runs.
program test_result_size
   use kinds, only: wp
   use scene, only: scene_type
   use result_size, only: sample_count, result_bytes, bytes_text, size_note
   use case_scenes, only: scene_of
   use check, only: runs, expect, report
   implicit none (type, external)

   if (runs('samples')) call samples()
   if (runs('sizes')) call sizes()
   if (runs('notes')) call notes()
   call report()

contains

   !> 6000 rpm: a hundred revolutions a second.
   subroutine samples()
      character(len=*), parameter :: second = '&operation speed_rpm = 6000, duration = 1 /'
      call expect(sample_count(scene_of(second//'&output samples_per_revolution = 10 /')) == 1001, 'both ends')
      call expect(sample_count(scene_of(second//'&output samples_per_revolution = 10, start_time = 0.5 /')) == 501, &
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
      call expect(.not. result_bytes(scene_of('&case task = ''equilibrium'' /')) > 0, 'an equilibrium has no samples')
   end subroutine sizes

   subroutine expect_values(text, values)
      character(len=*), intent(in) :: text
      integer, intent(in) :: values
      integer :: found
      found = nint((result_bytes(scene_of(text)) - 1e5_wp)/(8*100001))
      call expect(found == values, text//': values a sample')
   end subroutine expect_values

   subroutine notes()
      type(scene_type) :: scene
      call expect(bytes_text(5.404e8_wp) == '540 MB', 'megabytes')
      call expect(bytes_text(1.23e9_wp) == '1.2 GB', 'gigabytes')
      scene = scene_of('&operation speed_rpm = 6000, duration = 1 /')
      call expect(size_note(scene, 1) == '', 'a small one is no news')
      call expect(index(size_note(scene, 100), ' 36001 samples in each of 100 files; ') > 0, 'together they are')
      scene = scene_of('&operation speed_rpm = 6000, duration = 30 /')
      call expect(index(size_note(scene, 1), 'note: about 251 MB of results, 1080001 samples; ') == 1, &
         & 'a long run: '//size_note(scene, 1))
   end subroutine notes
end program test_result_size
