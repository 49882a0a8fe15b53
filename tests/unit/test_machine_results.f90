!> The results of a machine: each bearing's in its group, with the names and values that one bearing has at the root;
!> stations and shaft at the root.
program test_machine_results
   use kinds, only: wp
   use errors, only: error_type
   use case_inputs, only: case_type
   use parameter_study, only: run_tag
   use record, only: record_type
   use record_file, only: read_record
   use hdf5_file, only: hdf5_type
   use hdf5_rows, only: hdf5_rows_type
   use run_case, only: run_task
   use machine_cases, only: symmetric_rotor, disc_station
   use scratch, only: scratch_path, for_shell
   use check, only: runs, expect, expect_close, expect_no_error, report
   implicit none (type, external)

   !> What the printed digits of the independent program leave (docs/theory/machines.md).
   real(wp), parameter :: printed = 1e-5_wp
   !> Rounding alone stands between a file and what is calculated from it.
   real(wp), parameter :: rounding = 1e-12_wp

   if (runs('equilibrium')) call equilibrium()
   if (runs('march')) call march()
   if (runs('kept')) call kept()
   call report()

contains

   !> A value to the printed digits of the independent program.
   subroutine expect_part(value, expected, what)
      real(wp), intent(in) :: value, expected
      character(len=*), intent(in) :: what
      call expect_close(value, expected, printed*abs(expected), what)
   end subroutine expect_part

   !> The independent program's rotor at rest, in a file: written and read back.
   subroutine equilibrium()
      type(record_type) :: results
      type(case_type) :: inputs
      type(error_type), allocatable :: error
      type(hdf5_type) :: file
      real(wp) :: stations(13), loads(2), film
      character(len=:), allocatable :: path
      integer :: version
      inputs = symmetric_rotor('none', 4100.0_wp, 0.0_wp)
      inputs%about%task = 'equilibrium'
      path = scratch_path('equilibrium.h5')
      call run_task(inputs, path, run_tag(), 0, .false., .true., .true., results, error)
      call expect_no_error(error, 'equilibrium')
      if (allocated(error)) return
      call file%open(path, writing=.false.)
      call file%get_flag('format_version', version)
      call expect(version == 4, 'a format of its own')
      call read_record(file, results)
      call file%close()
      call execute_command_line('rm '//for_shell(path))
      call expect(.not. allocated(file%failure), 'the file can be read')
      call expect_part(results%get_real('bearings/left/equilibrium/journal_y'), -67.1872e-6_wp, 'journal y')
      call expect_part(results%get_real('bearings/right/equilibrium/journal_y'), -67.1872e-6_wp, 'other side')
      call expect(.not. results%has('equilibrium/journal_y'), 'no journal at the root')
      call expect(results%list_size('bearings/left/pad') == 2, 'pads of bearings')
      call expect(.not. results%has('pad'), 'no pads of the machine')
      call results%get_list('equilibrium/station_y', stations)
      call expect_part(stations(disc_station), -98.0403e-6_wp, 'disc')
      call expect_part(stations(2), -67.1872e-6_wp, 'journals are at their stations')
      call results%get_list('equilibrium/station_slope_y', stations)
      ! one digit is published
      call expect_close(stations(2), -7e-5_wp, 0.5e-5_wp, 'slope of the shaft in the first bearing')
      call expect_part(stations(12), -stations(2), 'and in the second')
      film = results%get_real('bearings/left/summary/equilibrium_min_film_thickness')
      call expect_part(results%get_real('bearings/left/summary/misalignment'), abs(stations(2))*0.05_wp/film, &
         & 'its part of the film at the end of the bearing')
      call results%get_list('equilibrium/bearing_load_y', loads)
      call expect_part(loads(1), -19620.0_wp, 'half the weight')
      call expect_close(loads(2), -19620.0_wp, printed, 'the other half')
      call expect_close(results%get_real('rotor/total_mass'), 4000.0_wp, printed, 'mass')
      call results%get_list('rotor/station_position', stations)
      call expect_close(stations(disc_station), 0.9_wp, rounding, 'the middle of the shaft')
   end subroutine equilibrium

   !> Figures and samples of a march with other bearings on either side: those of the bearings are in their groups, and
   !> figures of the stations follow from their series.
   subroutine march()
      type(record_type) :: results
      type(case_type) :: inputs
      type(error_type), allocatable :: error
      type(hdf5_type) :: file
      real(wp), allocatable :: stations(:, :), journal(:, :), tilt(:, :)
      real(wp) :: sizes(13)
      character(len=:), allocatable :: path
      inputs = short_march()
      path = scratch_path('march.h5')
      call run_task(inputs, path, run_tag(), 0, .false., .true., .true., results, error)
      call expect_no_error(error, 'march')
      if (allocated(error)) return
      call file%open(path, writing=.false.)
      stations = series(file, 'station_y')
      journal = series(file, 'bearings/left/journal_y')
      tilt = series(file, 'bearings/right/pad_tilt')
      call expect(.not. file%has('journal_y'), 'no journal at the root')
      call expect(.not. file%has('bearings/left/time'), 'one time')
      call file%close()
      call execute_command_line('rm '//for_shell(path))
      call expect(.not. allocated(file%failure), 'the file can be read')
      call expect(all(shape(stations) == [13, size(journal, 2)]) .and. size(tilt, 1) == 2, 'series and their widths')
      call expect(all(abs(stations(2, :) - journal(1, :)) <= rounding*maxval(abs(journal))), &
         & 'a journal is where its station is')
      call results%get_list('summary/station_y_size', sizes)
      associate (last => stations(:, size(stations, 2) - inputs%output%samples_per_revolution:))
         call expect(all(abs(sizes - (maxval(last, dim=2) - minval(last, dim=2))) <= rounding*maxval(sizes)), &
            & 'orbits of the stations')
         call expect_close(results%get_real('bearings/left/summary/orbit_y'), sizes(2), rounding, 'orbit of a journal')
      end associate
      call expect(results%has('bearings/left/spectrum/journal_y'), 'spectra of bearings')
      call expect(results%has('bearings/right/by_revolution'), 'revolutions of bearings')
   end subroutine march

   !> The last revolutions alone: the same figures.
   subroutine kept()
      type(record_type) :: whole, last
      type(case_type) :: inputs
      type(error_type), allocatable :: error
      character(len=:), allocatable :: path
      integer :: k, j
      inputs = short_march()
      path = scratch_path('kept.h5')
      call run_task(inputs, path, run_tag(), 0, .false., .true., .true., whole, error)
      call expect_no_error(error, 'all samples')
      inputs%output%keep = 'last_revolutions'
      if (.not. allocated(error)) call run_task(inputs, path, run_tag(), 0, .false., .true., .true., last, error)
      call execute_command_line('rm '//for_shell(path))
      call expect_no_error(error, 'last revolutions')
      if (allocated(error)) return
      do k = 1, whole%count
         if (index(whole%datasets(k)%path, 'summary/') == 0) cycle
         j = findloc([(last%datasets(j)%path == whole%datasets(k)%path, j=1, last%count)], .true., dim=1)
         call expect(j > 0, whole%datasets(k)%path//' is there')
         if (j == 0) cycle
         call expect(all(transfer(whole%datasets(k)%values, [0]) == transfer(last%datasets(j)%values, [0])), &
            & whole%datasets(k)%path//' is the same')
      end do
   end subroutine kept

   !> Six revolutions on pads with LuGre friction.
   type(case_type) function short_march() result(inputs)
      inputs = symmetric_rotor('lugre', 4100.0_wp, 0.02_wp)
      inputs%operation%duration = 6*60/4100.0_wp
      inputs%output%samples_per_revolution = 60
      inputs%output%spectrum_revolutions = 2
   end function short_march

   !> All samples of a series, (width, sample).
   function series(file, name) result(values)
      type(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: name
      real(wp), allocatable :: values(:, :)
      type(hdf5_rows_type) :: data
      call data%open(file, name)
      call data%read(file, 1, data%rows, values)
      call data%close(file)
   end function series
end program test_machine_results
