!> Statistics of a run: a list that adds, writes and reads itself; older names of its figures in files.
program test_run_statistics
   use kinds, only: wp, i8
   use files, only: delete_file
   use hdf5_file, only: hdf5_type
   use run_statistics, only: run_statistics_type
   use file_format, only: format_version, upgrade
   use scratch, only: scratch_path
   use check, only: runs, expect, expect_close, report
   implicit none (type, external)
   character(len=:), allocatable :: path

   path = scratch_path('run.h5')
   if (runs('adding')) call adding()
   if (runs('file')) call file_round_trip()
   if (runs('version_1')) call version_1()
   call delete_file(path)
   call report()

contains

   type(run_statistics_type) function figures(steps, films, seconds) result(list)
      integer(i8), intent(in) :: steps, films
      real(wp), intent(in) :: seconds
      call list%put('steps', steps, 'time steps')
      call list%put('film_volumes', films, 'films on finite volumes')
      call list%put('wall_seconds', seconds, 'wall time')
   end function figures

   subroutine adding()
      type(run_statistics_type) :: total, other, empty
      total = figures(10_i8, 2_i8, 1.5_wp)
      call total%add(empty)
      call total%add(figures(100_i8, 20_i8, 0.25_wp))
      call other%put('steps', 1_i8, 'time steps')
      call other%put('unknown', 7_i8, 'of nobody')
      call total%add(other)
      call expect(total%count('steps') == 111 .and. total%count('film_volumes') == 22, 'counts are added by name')
      call expect_close(total%seconds('wall_seconds'), 1.75_wp, 0.0_wp, 'seconds are')
      call expect(total%count('unknown') == 0 .and. empty%count('steps') == 0, 'what is not on the list counts 0')
   end subroutine adding

   subroutine file_round_trip()
      type(run_statistics_type) :: list
      type(hdf5_type) :: file
      call file%create(path)
      list = figures(1_i8, 2_i8, 3.0_wp)
      call list%write(file)
      list = figures(2_i8**40, 0_i8, 0.1_wp)
      call list%write(file)
      call file%close()
      call file%open(path, writing=.false.)
      list = figures(0_i8, 5_i8, 0.0_wp)
      call list%read(file)
      call expect(list%count('steps') == 2_i8**40 .and. list%count('film_volumes') == 0, 'counts are those in the file')
      call expect_close(list%seconds('wall_seconds'), 0.1_wp, 0.0_wp, 'seconds are')
      call list%put('missing', 0_i8, 'not in the file')
      call list%read(file)
      call expect(file%damaged, 'a figure that the file lacks is a failure')
      call file%close()
      call expect(allocated(file%failure), 'which is kept')
   end subroutine file_round_trip

   !> A file of version 1 gets the present names and version; one of the present version stays as it is.
   subroutine version_1()
      type(run_statistics_type) :: list
      type(hdf5_type) :: file
      integer :: version, k
      call file%create(path)
      call file%put_flag('format_version', 1)
      call file%make_group('statistics')
      call file%put_count('statistics/film_sor', 5_i8, 'films')
      call file%put_count('statistics/sor_sweeps', 9_i8, 'sweeps')
      call list%put('film_volumes', 0_i8, '')
      call list%put('film_passes', 0_i8, '')
      do k = 1, 2
         call upgrade(file)
         call file%get_flag('format_version', version)
         call expect(version == format_version, 'the present version')
         call list%read(file)
         call expect(list%count('film_volumes') == 5 .and. list%count('film_passes') == 9, 'the present names')
         call expect(.not. any([file%has('statistics/film_sor'), file%has('statistics/sor_sweeps')]), 'and no others')
      end do
      call expect(.not. allocated(file%failure), 'all is well')
      call file%close()
   end subroutine version_1
end program test_run_statistics
