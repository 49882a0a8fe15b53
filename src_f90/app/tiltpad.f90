!> The command: what it does, messages, exit status. The only place that stops.
program tiltpad
   use, intrinsic :: iso_c_binding, only: c_int
   use, intrinsic :: iso_fortran_env, only: error_unit, output_unit
   use text, only: printable, to_text
   use errors, only: error_type, raise, require, add_context, input_error, numerics_error, system_error
   use case_inputs, only: case_type
   use parameter_study, only: study_type, run_tag, read_study
   use namelist_writer, only: namelist_of, reference_text
   use read_files, only: read_tables
   use rotor_file, only: read_rotor
   use files, only: real_path
   use processes, only: write_output
   use build_info, only: program_version, program_commit
   use restart, only: restart_type, read_restart
   use stop_signals, only: catch_signals, ignore_file_limit
   use arguments, only: arguments_type, read_arguments, print_help
   use run_case, only: run_task, computed_in
   use record, only: record_type
   use study_folder, only: result_path, prepare_folder, check_neighbours
   use study_runs, only: check_runs
   use table_of_log, only: write_table_of
   use whole_study, only: perform_study, mark_study, refuse_large
   implicit none (type, external)

   interface
      subroutine c_exit(status) bind(c, name='exit')
         import :: c_int
         integer(c_int), value :: status
      end subroutine c_exit
   end interface

   type(arguments_type) :: given
   type(error_type), allocatable :: error
   call ignore_file_limit()
   call read_arguments(given, error)
   if (.not. allocated(error)) then
      select case (given%task)
      case ('help')
         call print_help()
      case ('version')
         print '(a)', 'tiltpad '//program_version//' ('//program_commit//')'
      case ('reference')
         call put(reference_text(), error)
      case ('table')
         call write_table_of(given%log_file, given%output, error)
      case default
         call catch_signals()
         if (given%case_file == '') then
            call resume_run(given, error)
         else
            call treat_case(given, error)
         end if
      end select
   end if
   flush (output_unit)
   if (allocated(error)) then
      call complain(error)
      call c_exit(int(error%status, c_int))
   end if

contains

   !> Goes on with a result file, or prints its case.
   subroutine resume_run(given, error)
      type(arguments_type), intent(in) :: given
      type(error_type), allocatable, intent(out) :: error
      type(restart_type) :: found
      type(run_tag) :: none
      type(record_type) :: results
      call read_restart(given%resumed, found, error)
      if (allocated(error)) return
      if (given%task == 'check') then
         call put(namelist_of(found%inputs), error)
      else
         call read_named(given%resumed, found%inputs, error)
         if (allocated(error)) return
         call run_task(found%inputs, given%resumed, none, given%verify, .true., .false., given%quiet, results, error)
      end if
   end subroutine resume_run

   !> Runs, checks or counts what a case file says.
   subroutine treat_case(given, error)
      type(arguments_type), intent(in) :: given
      type(error_type), allocatable, intent(out) :: error
      type(study_type) :: study
      type(case_type) :: inputs
      type(run_tag) :: tag
      character(len=:), allocatable :: output
      type(record_type) :: results
      type(error_type), allocatable :: failures(:)
      logical :: whole_study
      integer :: i

      call read_study(given%case_file, given%overrides, study, error)
      if (allocated(error)) return
      call check_use(given, study, error)
      if (allocated(error)) return
      whole_study = study%given .and. given%run == 0
      if (whole_study .and. given%task /= 'count') then
         call check_runs(study, given%share, error)
      else
         call study%inputs(max(1, given%run), inputs, error)
      end if
      if (allocated(error)) return
      select case (given%task)
      case ('count')
         call put(to_text(study%runs)//new_line('a'), error)
         return
      case ('check')
         call print_case(study, whole_study, given%run, error)
         return
      case default
         call choose_output(given, study%given, output, error)
      end select
      if (allocated(error)) return
      if (study%given) call mark_study(study, output, error)
      if (allocated(error)) return
      if (whole_study) then
         call perform_study(study, given%share, output, given%jobs, given%verify, given%overwrite, given%quiet, &
            & failures, error)
         do i = 1, size(failures)
            call complain(failures(i))
         end do
         return
      end if
      if (study%given) then
         call prepare_folder(output, error)
         if (allocated(error)) return
         call study%tag(given%run, tag)
         if (.not. given%overwrite) call check_neighbours(study, output, given%run, error)
         output = result_path(output, given%run, study%runs)
      end if
      if (.not. allocated(error)) call run_task(inputs, output, tag, given%verify, study%given .or. &
         & given%resumed /= '', given%overwrite, given%quiet, results, error)
      if (.not. allocated(error) .or. .not. study%given) return
      if (error%status == numerics_error) error%message = error%message//computed_in//output
   end subroutine treat_case

   !> Reads the files that the input of a result names. Of one that cannot be read nothing is said of what is in it: the
   !> result may come from somebody else, and name any file.
   subroutine read_named(path, inputs, error)
      character(len=*), intent(in) :: path
      type(case_type), intent(inout) :: inputs
      type(error_type), allocatable, intent(out) :: error
      type(error_type), allocatable :: reason
      call read_rotor(inputs%rotor, reason)
      if (.not. allocated(reason)) call read_tables(inputs, reason)
      if (allocated(reason)) call raise(error, system_error, path//': its input names a file that is not there, or ' &
         & //'not what the run has read; name the case, too: tiltpad --resume '//path//' CASE.nml')
   end subroutine read_named

   !> Prints the case of a study, or of one run (0: the first), whose tables are read as a run reads them.
   subroutine print_case(study, whole_study, run, error)
      type(study_type), intent(in) :: study
      logical, intent(in) :: whole_study
      integer, intent(in) :: run
      type(error_type), allocatable, intent(out) :: error
      type(case_type) :: inputs
      character(len=:), allocatable :: text
      if (whole_study) then
         call study%inputs(max(1, run), inputs, error)
         if (.not. allocated(error)) call read_tables(inputs, error)
         if (.not. allocated(error)) call study%resolved(text, error)
      else
         call study%checked(max(1, run), text, error)
      end if
      if (.not. allocated(error)) call put(text, error)
   end subroutine print_case

   !> Refuses options that the case is not for.
   subroutine check_use(given, study, error)
      type(arguments_type), intent(in) :: given
      type(study_type), intent(in) :: study
      type(error_type), allocatable, intent(out) :: error
      call require(study%given .or. given%run == 0 .and. given%jobs == 0 .and. .not. given%blocks, given%case_file &
         & //': no group &sweep in it, which --run, --block and --jobs are for', error)
      call require(.not. study%given .or. given%resumed == '', '--resume goes on with one run; the runs of ' &
         & //given%case_file//' go on when it is run again', error)
      call require(given%run <= study%runs, '--run '//to_text(given%run)//': must be 1 to '//to_text(study%runs) &
         & //', the runs of '//given%case_file, error)
      if (allocated(error) .or. given%task /= 'run' .or. given%run > 0 .or. .not. study%given .or. given%yes) return
      call refuse_large(study, given%share, error)
      call add_context(error, given%case_file)
   end subroutine check_use

   !> The result file, as given, or named like the case; for a study without .h5: so its folder is called.
   subroutine choose_output(given, is_study, output, error)
      type(arguments_type), intent(in) :: given
      logical, intent(in) :: is_study
      character(len=:), allocatable, intent(out) :: output
      type(error_type), allocatable, intent(out) :: error
      if (given%resumed /= '') then
         output = given%resumed
      else if (given%output /= '') then
         output = given%output
      else
         output = given%case_file(index(given%case_file, '/', back=.true.) + 1:)
         if (index(output, '.', back=.true.) > 1) output = output(:index(output, '.', back=.true.) - 1)
         if (.not. is_study) output = output//'.h5'
      end if
      if (is_study) output = without_ending(output)
      if (real_path(output) == real_path(given%case_file)) call raise(error, input_error, output &
         & //': the result would replace the case; name another with --output')
   end subroutine choose_output

   !> The name of a study's file or folder, without its ending or the slash behind it.
   function without_ending(name)
      character(len=*), intent(in) :: name
      character(len=:), allocatable :: without_ending
      integer :: last
      last = len(name)
      do while (last > 1 .and. name(last:last) == '/')
         last = last - 1
      end do
      if (last > 3) then
         if (name(last - 2:last) == '.h5') last = last - 3
      end if
      without_ending = name(:last)
   end function without_ending

   !> An error's line.
   subroutine complain(error)
      type(error_type), intent(in) :: error
      write (error_unit, '(a)') 'tiltpad: error: '//printable(error%message)
      flush (error_unit)
   end subroutine complain

   !> Writes text to standard output.
   subroutine put(text, error)
      character(len=*), intent(in) :: text
      type(error_type), allocatable, intent(out) :: error
      if (.not. write_output(text)) call raise(error, system_error, 'standard output cannot be written')
   end subroutine put
end program tiltpad
