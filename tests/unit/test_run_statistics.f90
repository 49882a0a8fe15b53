!> Statistics of a run: a list that adds, writes and reads itself.
program test_run_statistics
   use kinds, only: wp, i8
   use files, only: delete_file
   use hdf5_file, only: hdf5_type
   use run_statistics, only: run_statistics_type
   use scratch, only: scratch_path
   use check, only: runs, expect, expect_close, report
   implicit none (type, external)
   character(len=:), allocatable :: path

   path = scratch_path('run.h5')
   if (runs('adding')) call adding()
   if (runs('file')) call file_round_trip()
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
end program test_run_statistics
