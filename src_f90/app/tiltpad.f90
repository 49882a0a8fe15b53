!> The command: arguments, messages, exit status. The only place that stops.
program tiltpad
   use, intrinsic :: iso_c_binding, only: c_int
   use, intrinsic :: iso_fortran_env, only: error_unit, output_unit
   use errors, only: error_type, raise, input_error, system_error
   use text, only: printable, shortened, to_text
   use scene, only: scene_type
   use scene_namelist, only: read_scene
   use namelist_writer, only: scene_text
   use input_reference, only: reference_text
   use posix, only: real_path, write_output, keep_file_size_quiet
   use build_info, only: program_version, program_commit
   use run_case, only: run_scene
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
      write (error_unit, '(a)') 'tiltpad: error: '//printable(error%message)
      flush (error_unit)
      call c_exit(int(error%status, c_int))
   end if

contains

   !> Does what the command line says.
   subroutine command(error)
      type(error_type), allocatable, intent(out) :: error
      type(scene_type) :: scene
      character(len=:), allocatable :: word, value, case_file, output, stem
      character(len=longest), allocatable :: overrides(:)
      logical :: check, quiet
      integer :: i, count

      check = .false.
      quiet = .false.
      case_file = ''
      output = ''
      allocate (overrides(most))
      count = 0
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
         case ('--output', '-o', '--set')
            if (i == command_argument_count()) then
               call raise(error, input_error, word//': a value must follow; see tiltpad --help')
               return
            end if
            i = i + 1
            value = argument(i)
            if (word == '--set') then
               count = count + 1
               if (len(value) > longest) call raise(error, input_error, '--set '//shortened(value) &
                  & //': the value is too long, '//to_text(len(value))//' characters; at most '//to_text(longest))
               if (count > most) call raise(error, input_error, '--set '//shortened(value)//': given more than ' &
                  & //to_text(most)//' times')
               if (.not. allocated(error)) overrides(count) = value
            else
               if (value == '') call raise(error, input_error, word//': the file name is empty')
               output = value
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
      if (case_file == '') then
         call raise(error, input_error, 'no case given; usage: tiltpad [options] CASE.nml, see tiltpad --help')
         return
      end if

      call read_scene(case_file, overrides(:count), scene, error)
      if (allocated(error)) return
      if (check) then
         call put(scene_text(scene), error)
         return
      end if
      if (output == '') then
         stem = case_file(index(case_file, '/', back=.true.) + 1:)
         if (index(stem, '.', back=.true.) > 1) stem = stem(:index(stem, '.', back=.true.) - 1)
         output = stem//'.h5'
      end if
      if (real_path(output) == real_path(case_file)) then
         call raise(error, input_error, output//': the result would replace the case; name another with --output')
         return
      end if
      call run_scene(scene, output, quiet, error)
   end subroutine command

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
         & '  --set group%name=value  overrides one value of the case; may be repeated', &
         & '  --check                 reads, checks and prints the resolved case; runs nothing', &
         & '  --quiet                 prints nothing but errors', &
         & '  --reference             prints the input reference (Markdown)', &
         & '  --version, --help', &
         & '', &
         & 'Exit status: 0 done; 1 usage or input; 2 the numerics failed (what was computed is kept);', &
         & '3 file or system.'
   end subroutine print_help
end program tiltpad
