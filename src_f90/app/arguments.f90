!> The words of the command line.
module arguments
   use text, only: shortened, to_text, lower_case, whole_number
   use case_parameter, only: meant_variable, meant_word
   use errors, only: error_type, raise, require, input_error
   use study_blocks, only: block_type
   implicit none (type, external)
   private
   public :: arguments_type, read_arguments, print_help

   !> Longest override, and how many there may be.
   integer, parameter :: longest = 4096, most = 1000
   character(len=*), parameter :: options = '--output --overwrite --resume --set --check --verify --jobs --run ' &
      & //'--block --count --table --quiet --yes --reference --version --help'

   type :: arguments_type
      !> 'run', 'check', 'count', 'table', 'help', 'version' or 'reference'.
      character(len=:), allocatable :: task
      !> Files; empty where none is given.
      character(len=:), allocatable :: case_file, output, resumed, log_file
      !> "group%name=value".
      character(len=longest), allocatable :: overrides(:)
      !> Run of a study, and how many at a time; 0 where not given.
      integer :: run = 0, jobs = 0
      !> Block of the runs of a study; all, where it is not given.
      type(block_type) :: share
      logical :: blocks = .false.
      !> States whose films are solved closely after a run; 0: none.
      integer :: verify = 0
      logical :: quiet = .false., overwrite = .false.
      !> Whether a study may be large, without being asked for on a terminal.
      logical :: yes = .false.
   end type arguments_type

contains

   subroutine read_arguments(given, error)
      type(arguments_type), intent(out) :: given
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: word, value
      integer :: i

      given%task = 'run'
      given%case_file = ''
      given%output = ''
      given%resumed = ''
      given%log_file = ''
      allocate (given%overrides(0))
      i = 0
      do while (i < command_argument_count())
         i = i + 1
         word = argument(i)
         select case (word)
         case ('--help', '-h')
            given%task = 'help'
            return
         case ('--version', '--reference')
            given%task = word(3:)
            return
         case ('--check', '--count')
            if (given%task /= 'run' .and. given%task /= word(3:)) call raise(error, input_error, &
               & '--check and --count: one of them at a time')
            given%task = word(3:)
         case ('--quiet', '-q')
            given%quiet = .true.
         case ('--overwrite')
            given%overwrite = .true.
         case ('--yes')
            given%yes = .true.
         case ('--output', '-o', '--resume', '--table', '--set', '--verify', '--run', '--block', '--jobs')
            call require(i < command_argument_count(), word//': a value must follow; see tiltpad --help', error)
            if (allocated(error)) return
            i = i + 1
            value = argument(i)
            call take_option(given, word, value, error)
         case default
            if (len(word) == 0) then
               call raise(error, input_error, 'an empty argument; see tiltpad --help')
            else if (word(1:1) == '-') then
               call raise(error, input_error, 'unknown option '//word//meant_option(word)//'; see tiltpad --help')
            else if (is_assignment(word)) then
               call raise(error, input_error, word//': a value is given by --set group%name=value'//meant_variable &
                  & ('', lower_case(word(:index(word, '=') - 1))))
            else if (given%case_file /= '') then
               call raise(error, input_error, 'one case at a time: '//given%case_file//' and '//word//' given')
            else
               given%case_file = word
            end if
         end select
         if (allocated(error)) return
      end do
      call check_arguments(given, error)
   end subroutine read_arguments

   !> An option with its value.
   subroutine take_option(given, word, value, error)
      type(arguments_type), intent(inout) :: given
      character(len=*), intent(in) :: word, value
      type(error_type), allocatable, intent(out) :: error
      select case (word)
      case ('--set')
         call require(len(value) <= longest, '--set '//shortened(value)//': the value is too long, ' &
            & //to_text(len(value))//' characters; at most '//to_text(longest), error)
         call require(size(given%overrides) < most, '--set '//shortened(value)//': given more than '//to_text(most) &
            & //' times', error)
         if (.not. allocated(error)) given%overrides = [character(len=longest) :: given%overrides, value]
      case ('--verify')
         call read_whole(word, value, given%verify, error)
      case ('--run')
         call read_whole(word, value, given%run, error)
      case ('--block')
         call read_block(value, given%share, error)
         given%blocks = .true.
      case ('--jobs')
         call read_whole(word, value, given%jobs, error)
      case default
         call require(value /= '', word//': the file name is empty', error)
         ! Fortran leaves blanks at the end of a name away
         call require(len_trim(value) == len(value), word//' '//value//': the name of a file must not end in a blank', &
            & error)
         if (word == '--resume') then
            given%resumed = value
         else if (word == '--table') then
            given%log_file = value
            given%task = 'table'
         else
            given%output = value
         end if
      end select
   end subroutine take_option

   !> Refuses what does not go together.
   subroutine check_arguments(given, error)
      type(arguments_type), intent(in) :: given
      type(error_type), allocatable, intent(out) :: error
      logical :: resumes, runs
      if (given%task == 'table') then
         call require(given%case_file == '' .and. given%resumed == '' .and. size(given%overrides) == 0, '--table: ' &
            & //'makes the file of a study from its log; not with a case, --resume or --set', error)
         return
      end if
      resumes = given%resumed /= ''
      runs = given%task == 'run'
      call require(.not. resumes .or. given%output == '', '--resume goes on with its file; --output cannot ' &
         & //'name another', error)
      call require(.not. given%overwrite .or. runs .and. .not. resumes, '--overwrite: is for runs; not with ' &
         & //'--resume, --check or --count', error)
      call require(given%verify == 0 .or. runs, '--verify: is for runs and their results; not with --check or ' &
         & //'--count', error)
      call require(given%jobs == 0 .or. runs .and. given%run == 0, '--jobs: is for all runs of a study; not with ' &
         & //'--run, --check or --count', error)
      call require(.not. given%blocks .or. runs .and. given%run == 0, '--block: is for many runs of a study; not ' &
         & //'with --run, --check or --count', error)
      call require(given%task /= 'count' .or. given%run == 0, '--count and --run: one of them at a time', error)
      if (given%case_file /= '') return
      call require(resumes, 'no case given; usage: tiltpad [options] CASE.nml, see tiltpad --help', error)
      call require(given%task /= 'count' .and. given%jobs == 0 .and. given%run == 0 .and. .not. given%blocks, &
         & '--count, --jobs, --run and --block: are for a case with a study, and --resume for one run', error)
      call require(size(given%overrides) == 0, '--set changes the case; a resumed run keeps its own', error)
   end subroutine check_arguments

   !> What an unknown option may stand for: another one, or "--option value" where "--option=value" is given.
   function meant_option(word) result(text)
      character(len=*), intent(in) :: word
      character(len=:), allocatable :: text
      integer :: equals
      equals = index(word, '=')
      text = meant_word(word, options, '')
      if (equals == 0) return
      if (index(' '//options//' ', ' '//word(:equals - 1)//' ') > 0) then
         text = ' (did you mean '//word(:equals - 1)//' '//word(equals + 1:)//'?)'
      end if
   end function meant_option

   !> True for "group%name=value" or "name=value" that is no file.
   logical function is_assignment(word)
      character(len=*), intent(in) :: word
      logical :: exists
      inquire (file=word, exist=exists)
      is_assignment = index(word, '=') > 1 .and. .not. exists
   end function is_assignment

   !> The value of an option that takes a whole number from 1.
   subroutine read_whole(option, value, number, error)
      character(len=*), intent(in) :: option, value
      integer, intent(out) :: number
      type(error_type), allocatable, intent(out) :: error
      number = whole_number(value)
      if (number == 0) call raise(error, input_error, option//' '//value//': must be a whole number, 1 or more')
   end subroutine read_whole

   !> A block, "I/N".
   subroutine read_block(value, share, error)
      character(len=*), intent(in) :: value
      type(block_type), intent(out) :: share
      type(error_type), allocatable, intent(out) :: error
      integer :: slash
      slash = index(value, '/')
      share%number = whole_number(value(:slash - 1))
      share%of = whole_number(value(slash + 1:))
      call require(share%number >= 1 .and. share%number <= share%of, '--block '//value//': must be I/N, the I-th of ' &
         & //'N blocks, with I from 1 to N', error)
   end subroutine read_block

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
         & 'Calculates a journal bearing with tilting or fixed pads, which a namelist case describes, and writes', &
         & 'an HDF5 result file: by case%task a march in time, the static equilibrium, stiffness and damping', &
         & '(coefficients), a periodic orbit, or branches of equilibria or orbits.', &
         & 'A case with a group &sweep describes the runs of a study; the result file has a row for each.', &
         & '', &
         & 'options:', &
         & '  --output FILE           names the result file; default: the case''s name with .h5, in this folder', &
         & '                          (of a study with its rows; runs that keep samples have files of their own', &
         & '                          in the folder of this name, 0001.h5, ...)', &
         & '  --overwrite             replaces a checkpoint, or the result of another case: refused without it', &
         & '  --resume FILE           continues a run that was stopped or killed, from its last checkpoint;', &
         & '                          with a CASE, starts the run if FILE does not exist', &
         & '  --set group%name=value  overrides one value of the case; may be repeated', &
         & '  --check                 reads, checks and prints the resolved case; runs nothing', &
         & '  --verify N              solves the films in N states of the complete run closely, and says how far', &
         & '                          its own are from them; with --resume also those of a complete result', &
         & '  --block I/N             performs the I-th of N blocks of the runs of a study, for instance as a', &
         & '                          task of an array job; the last that ends joins them', &
         & '  --jobs N                performs N runs of a study at a time; default: one for each processor', &
         & '  --run K                 performs (with --check: prints) only run K of a study', &
         & '  --table FILE            makes the file of a study of its log, FILE (NAME.h5.rows); runs nothing', &
         & '  --count                 prints the number of runs of the case; 1 without a group &sweep', &
         & '  --yes                   performs a study of more than a gigabyte from a terminal, too', &
         & '  --quiet                 prints errors only', &
         & '  --reference             prints the input reference (Markdown)', &
         & '  --version, --help       prints the version, or this help', &
         & '', &
         & 'Exit status: 0 done; 1 usage or input; 2 the numerics failed (results up to this point are kept);', &
         & '3 file or system; 4 stopped by a signal (SIGTERM, SIGUSR1, SIGINT, SIGXCPU) after a checkpoint.'
   end subroutine print_help
end module arguments
