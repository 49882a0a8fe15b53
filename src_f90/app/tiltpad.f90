!> The command: arguments, messages, exit status. The only place that stops.
program tiltpad
   use, intrinsic :: iso_c_binding, only: c_int
   use, intrinsic :: iso_fortran_env, only: error_unit, output_unit
   use errors, only: error_type, raise, input_error, system_error
   use scene, only: scene_type
   use scene_namelist, only: read_scene
   use namelist_writer, only: scene_text
   use input_reference, only: reference_text
   use posix, only: real_path, write_output, keep_file_size_quiet
   use build_info, only: program_version, program_commit
   use restart, only: restart_type, read_restart
   use signals, only: catch_signals
   use run_case, only: run_scene
   implicit none (type, external)

   interface
      subroutine c_exit(status) bind(c, name='exit')
         import :: c_int
         integer(c_int), value :: status
      end subroutine c_exit
   end interface

   !> Longest override.
   integer, parameter :: longest = 4096

   type(error_type), allocatable :: error
   call keep_file_size_quiet()
   call command(error)
   flush (output_unit)
   if (allocated(error)) then
      write (error_unit, '(a)') 'tiltpad: error: '//printable(error%message)
      flush (error_unit)
      call c_exit(int(error%status, c_int))
   end if

contains

   !> Does what the command line says.
   subroutine command(error)
      type(error_type), allocatable, intent(out) :: error
      type(scene_type) :: scene
      character(len=:), allocatable :: word, value, case_file, output, resumed, stem
      character(len=longest), allocatable :: overrides(:)
      type(restart_type) :: found
      logical :: check, quiet, exists
      integer :: i

      check = .false.
      quiet = .false.
      case_file = ''
      output = ''
      resumed = ''
      allocate (overrides(0))
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
         case ('--quiet', '-q')
            quiet = .true.
         case ('--output', '-o', '--resume', '--set')
            if (i == command_argument_count()) then
               call raise(error, input_error, word//': a value must follow; see tiltpad --help')
               return
            end if
            i = i + 1
            value = argument(i)
            if (word == '--set') then
               if (len(value) > longest) call raise(error, input_error, '--set: the value is too long')
               overrides = [character(len=longest) :: overrides, value]
            else
               if (value == '') call raise(error, input_error, word//': the file name is empty')
               if (word == '--resume') then
                  resumed = value
               else
                  output = value
               end if
            end if
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
      call catch_signals()
      if (resumed /= '' .and. case_file == '') then
         if (size(overrides) > 0) call raise(error, input_error, '--set changes the case; a resumed run keeps its own')
         if (.not. allocated(error)) call read_restart(resumed, found, error)
         if (.not. allocated(error) .and. check) call put(scene_text(found%scene), error)
         if (.not. allocated(error) .and. .not. check) call run_scene(found%scene, resumed, .true., quiet, error)
         return
      end if
      if (case_file == '') then
         call raise(error, input_error, 'no case given; usage: tiltpad [options] CASE.nml, see tiltpad --help')
         return
      end if

      call read_scene(case_file, overrides, scene, error)
      if (allocated(error)) return
      if (check) then
         call put(scene_text(scene), error)
         return
      end if
      if (resumed /= '') then
         output = resumed
      else if (output == '') then
         stem = case_file(index(case_file, '/', back=.true.) + 1:)
         if (index(stem, '.', back=.true.) > 1) stem = stem(:index(stem, '.', back=.true.) - 1)
         output = stem//'.h5'
      end if
      if (real_path(output) == real_path(case_file)) then
         call raise(error, input_error, output//': the result would replace the case; name another with --output')
         return
      end if
      call run_scene(scene, output, resumed /= '', quiet, error)
   end subroutine command

   !> The text with a question mark for every control character, so that an error stays one line.
   pure function printable(text)
      character(len=*), intent(in) :: text
      character(len=len(text)) :: printable
      integer :: i
      printable = text
      do i = 1, len(text)
         if (iachar(text(i:i)) < 32 .or. iachar(text(i:i)) == 127) printable(i:i) = '?'
      end do
   end function printable

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
         & '', &
         & '  --output FILE           result file; default: the case''s name with .h5, in this directory', &
         & '  --resume FILE           goes on with a run that was stopped or killed, from its last checkpoint;', &
         & '                          with a CASE: starts it if FILE is not there', &
         & '  --set group%name=value  overrides one value of the case; may be repeated', &
         & '  --check                 reads, checks and prints the resolved case; runs nothing', &
         & '  --quiet                 prints nothing but errors', &
         & '  --reference             prints the input reference (Markdown)', &
         & '  --version, --help', &
         & '', &
         & 'Exit status: 0 done; 1 usage or input; 2 the numerics failed (what was computed is kept);', &
         & '3 file or system; 4 stopped by a signal (SIGTERM, SIGUSR1, SIGINT) after a checkpoint.'
   end subroutine print_help
end program tiltpad
