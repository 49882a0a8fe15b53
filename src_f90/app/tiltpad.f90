!> The command: arguments, messages, exit status. The only place that stops.
program tiltpad
   use, intrinsic :: iso_c_binding, only: c_int
   use, intrinsic :: iso_fortran_env, only: error_unit, output_unit
   use errors, only: error_type, raise, input_error, system_error
   use text, only: printable, shortened, to_text
   use scene, only: scene_type
   use sweep, only: sweep_type, member_tag, read_sweep
   use namelist_writer, only: scene_text
   use input_reference, only: reference_text
   use posix, only: real_path, write_output, keep_file_size_quiet
   use processes, only: processors
   use build_info, only: program_version, program_commit
   use restart, only: restart_type, read_restart
   use signals, only: catch_signals
   use run_case, only: run_scene
   use run_sweep, only: run_members, check_members, prepare_folder, member_file
   implicit none (type, external)

   interface
      subroutine c_exit(status) bind(c, name='exit')
         import :: c_int
         integer(c_int), value :: status
      end subroutine c_exit
   end interface

   !> Longest override, and how many there may be.
   integer, parameter :: longest = 4096, most = 1000

   type(error_type), allocatable :: error
   call keep_file_size_quiet()
   call command(error)
   flush (output_unit)
   if (allocated(error)) then
      call complain(error)
      call c_exit(int(error%status, c_int))
   end if

contains

   !> Does what the command line says.
   subroutine command(error)
      type(error_type), allocatable, intent(out) :: error
      type(scene_type) :: scene
      type(sweep_type) :: sweep
      type(member_tag) :: tag
      type(restart_type) :: found
      character(len=:), allocatable :: word, value, case_file, output, resumed, text
      character(len=longest), allocatable :: overrides(:)
      logical :: check, quiet, counting
      integer :: member, jobs, sets, i

      member = 0
      jobs = 0
      counting = .false.
      check = .false.
      quiet = .false.
      case_file = ''
      output = ''
      resumed = ''
      allocate (overrides(most))
      sets = 0
      i = 0
      do while (i < command_argument_count())
         i = i + 1
         word = argument(i)
         select case (word)
         case ('--help', '-h')
            call print_help()
            return
         case ('--version')
            print '(a)', 'tiltpad '//program_version//' ('//program_commit//')'
            return
         case ('--reference')
            call put(reference_text(), error)
            return
         case ('--check')
            check = .true.
         case ('--count')
            counting = .true.
         case ('--quiet', '-q')
            quiet = .true.
         case ('--output', '-o', '--resume', '--set', '--member', '--jobs')
            if (i == command_argument_count()) then
               call raise(error, input_error, word//': a value must follow; see tiltpad --help')
               return
            end if
            i = i + 1
            value = argument(i)
            select case (word)
            case ('--set')
               sets = sets + 1
               if (len(value) > longest) call raise(error, input_error, '--set '//shortened(value) &
                  & //': the value is too long, '//to_text(len(value))//' characters; at most '//to_text(longest))
               if (sets > most) call raise(error, input_error, '--set '//shortened(value)//': given more than ' &
                  & //to_text(most)//' times')
               if (.not. allocated(error)) overrides(sets) = value
            case ('--member')
               call read_whole(word, value, member, error)
            case ('--jobs')
               call read_whole(word, value, jobs, error)
            case default
               if (value == '') call raise(error, input_error, word//': the file name is empty')
               if (word == '--resume') then
                  resumed = value
               else
                  output = value
               end if
            end select
            if (allocated(error)) return
         case default
            if (len(word) == 0) then
               call raise(error, input_error, 'an empty argument; see tiltpad --help')
            else if (word(1:1) == '-') then
               call raise(error, input_error, 'unknown option '//word//'; see tiltpad --help')
            else if (case_file /= '') then
               call raise(error, input_error, 'one case at a time: '//case_file//' and '//word//' given')
            else
               case_file = word
            end if
            if (allocated(error)) return
         end select
      end do
      if (resumed /= '' .and. output /= '') then
         call raise(error, input_error, '--resume goes on with its file; --output cannot name another')
         return
      end if
      if (count([counting, jobs > 0, check .or. member > 0]) > 1) then
         call raise(error, input_error, '--count, --jobs, and --check or --member: one of them at a time')
         return
      end if
      call catch_signals()
      if (resumed /= '' .and. case_file == '') then
         if (counting .or. jobs > 0 .or. member > 0) call raise(error, input_error, &
            & '--count, --jobs and --member: are for a case with a sweep, and --resume for one run')
         if (sets > 0) call raise(error, input_error, '--set changes the case; a resumed run keeps its own')
         if (.not. allocated(error)) call read_restart(resumed, found, error)
         if (.not. allocated(error) .and. check) call put(scene_text(found%scene), error)
         if (.not. allocated(error) .and. .not. check) call run_scene(found%scene, resumed, tag, .true., quiet, error)
         return
      end if
      if (case_file == '') then
         call raise(error, input_error, 'no case given; usage: tiltpad [options] CASE.nml, see tiltpad --help')
         return
      end if
      call read_sweep(case_file, overrides(:sets), sweep, error)
      if (allocated(error)) return
      if (.not. sweep%given .and. (member > 0 .or. jobs > 0)) then
         call raise(error, input_error, case_file//': no group &sweep in it, which --member and --jobs are for')
      else if (sweep%given .and. resumed /= '') then
         call raise(error, input_error, '--resume goes on with one run; the members of '//case_file &
            & //' go on when it is run again')
      else if (member > sweep%members) then
         call raise(error, input_error, '--member '//to_text(member)//': must be 1 to '//to_text(sweep%members) &
            & //', the members of '//case_file)
      else if (member > 0 .or. counting .or. .not. sweep%given) then
         call sweep%scene(max(1, member), scene, error)
      else
         call check_members(sweep, error)
      end if
      if (allocated(error)) return
      if (counting) then
         call put(to_text(sweep%members)//new_line('a'), error)
         return
      else if (check) then
         if (sweep%given .and. member == 0) then
            call sweep%resolved(text, error)
         else
            text = scene_text(scene)
         end if
         if (.not. allocated(error)) call put(text, error)
         return
      end if
      if (resumed /= '') then
         output = resumed
      else if (output == '') then
         output = case_file(index(case_file, '/', back=.true.) + 1:)
         if (index(output, '.', back=.true.) > 1) output = output(:index(output, '.', back=.true.) - 1)
         if (.not. sweep%given) output = output//'.h5'
      end if
      if (real_path(output) == real_path(case_file)) then
         call raise(error, input_error, output//': the result would replace the case; name another with --output')
         return
      end if
      if (sweep%given .and. member == 0) then
         call run_sweep_members(sweep, output, jobs, quiet, error)
         return
      end if
      if (sweep%given) then
         call sweep%tag(member, tag)
         call prepare_folder(output, error)
         output = member_file(output, member, sweep%members)
      end if
      if (.not. allocated(error)) call run_scene(scene, output, tag, resumed /= '' .or. sweep%given, quiet, error)
   end subroutine command

   !> Runs all members of a sweep.
   subroutine run_sweep_members(sweep, folder, jobs, quiet, error)
      type(sweep_type), intent(in) :: sweep
      character(len=*), intent(in) :: folder
      !> At a time; 0 for as many as there are processors.
      integer, intent(in) :: jobs
      logical, intent(in) :: quiet
      type(error_type), allocatable, intent(out) :: error
      type(error_type), allocatable :: failures(:)
      integer :: i
      call prepare_folder(folder, error)
      if (allocated(error)) return
      call run_members(sweep, folder, merge(jobs, processors(), jobs > 0), quiet, run_member, failures, error)
      do i = 1, size(failures)
         call complain(failures(i))
      end do
   end subroutine run_sweep_members

   !> Runs a member of a sweep, or what is left of it, without a word.
   subroutine run_member(scene, path, tag, error)
      type(scene_type), intent(in) :: scene
      character(len=*), intent(in) :: path
      type(member_tag), intent(in) :: tag
      type(error_type), allocatable, intent(out) :: error
      call run_scene(scene, path, tag, .true., .true., error)
   end subroutine run_member

   !> The value of an option that takes a whole number from 1.
   subroutine read_whole(option, value, number, error)
      character(len=*), intent(in) :: option, value
      integer, intent(out) :: number
      type(error_type), allocatable, intent(out) :: error
      number = 0
      if (value /= '' .and. len(value) < 10 .and. verify(value, '0123456789') == 0) read (value, *) number
      if (number == 0) call raise(error, input_error, option//' '//value//': must be a whole number, 1 or more')
   end subroutine read_whole

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

   !> The i-th word of the command line, of any length.
   function argument(i)
      integer, intent(in) :: i
      character(len=:), allocatable :: argument
      integer :: length
      call get_command_argument(i, length=length)
      allocate (character(len=length) :: argument)
      call get_command_argument(i, argument)
   end function argument

   subroutine print_help()
      print '(a)', 'usage: tiltpad [options] CASE.nml', &
         & '', &
         & 'Marches the tilting pad journal bearing of a namelist case and writes an HDF5 result file.', &
         & 'A case with a group &sweep is many, its members; each writes a file of its own.', &
         & '', &
         & '  --output FILE           result file; default: the case''s name with .h5, in this directory', &
         & '                          (of a sweep: the folder of the results 0001.h5, ...; the case''s name)', &
         & '  --resume FILE           goes on with a run that was stopped or killed, from its last checkpoint;', &
         & '                          with a CASE: starts it if FILE is not there', &
         & '  --set group%name=value  overrides one value of the case; may be repeated', &
         & '  --check                 reads, checks and prints the resolved case; runs nothing', &
         & '  --jobs N                members of a sweep that run at a time; default: the processors there are', &
         & '  --member K              runs (or with --check, prints) the K-th member of a sweep alone', &
         & '  --count                 prints how many members the case has; 1 without a group &sweep', &
         & '  --quiet                 prints nothing but errors', &
         & '  --reference             prints the input reference (Markdown)', &
         & '  --version, --help', &
         & '', &
         & 'Exit status: 0 done; 1 usage or input; 2 the numerics failed (what was computed is kept);', &
         & '3 file or system; 4 stopped by a signal (SIGTERM, SIGUSR1, SIGINT) after a checkpoint.'
   end subroutine print_help
end program tiltpad
