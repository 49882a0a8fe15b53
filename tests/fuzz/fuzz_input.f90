!> The reader of cases behind a pipe, for the fuzzer: many cases in one process.
!>
!> A request on standard input is what to do, a count and as many texts, each behind its length: the text of a case,
!> then the arguments of --set. The reply on standard output is the length of what follows, the exit status, what the
!> case was the first to reach (0 without instrumentation), and a text: what the program would print, the resolved
!> case or the error. Every number has four bytes. A resolved case that does not read back to itself, where that is
!> asked for, gives the status `not_itself` and both texts. Of a study the text is the number of runs, the resolved
!> case and some runs, the first ones and the last, with a zero byte behind each.
!> Of a table of values it is the number of rows, the names, and the values of the same rows, with a zero byte behind
!> each.
program fuzz_input
   use, intrinsic :: iso_c_binding, only: c_char, c_int, c_size_t
   use errors, only: error_type
   use text, only: printable, to_text
   use case_inputs, only: case_type
   use assignments, only: token_type, target_text, value_text
   use study_variables, only: study_table_type, read_table
   use scratch, only: scratch_path, write_bytes
   use files, only: delete_file
   use parameter_study, only: study_type, study_from_text
   use namelist_writer, only: namelist_of, reference_text
   use processes, only: write_output
   implicit none (type, external)

   interface
      integer(c_size_t) function c_read(descriptor, bytes, count) bind(c, name='read')
         import :: c_int, c_char, c_size_t
         integer(c_int), value :: descriptor
         integer(c_size_t), value :: count
         character(kind=c_char), intent(inout) :: bytes(count)
      end function c_read

      !> Edges of the flow that were taken for the first time, or more often than ever, since the last call.
      integer(c_int) function coverage_news() bind(c, name='coverage_news')
         import :: c_int
      end function coverage_news

      subroutine coverage_start() bind(c, name='coverage_start')
      end subroutine coverage_start
   end interface

   type :: text_type
      character(len=:), allocatable :: text
   end type text_type

   !> What to do, and the status that no error has.
   integer, parameter :: to_read = 0, to_read_back = 1, to_give_reference = 2, to_read_table = 3
   integer, parameter :: not_itself = 99
   !> Runs of a study that are looked at, with the last.
   integer, parameter :: most_runs = 3
   character(len=*), parameter :: name = 'case.nml'
   type(text_type), allocatable :: parts(:)
   integer :: task, count, i

   do
      if (.not. got_number(task)) exit
      if (.not. got_number(count)) exit
      if (allocated(parts)) deallocate (parts)
      allocate (parts(count))
      do i = 1, count
         call get_text(parts(i)%text)
      end do
      select case (task)
      case (to_read, to_read_back)
         call answer(parts(1)%text, parts(2:), task == to_read_back)
      case (to_give_reference)
         call reply(0, 0, reference_text())
      case (to_read_table)
         call answer_table(parts(1)%text)
      case default
         stop 3
      end select
   end do
   ! what is left here would count as a leak
   if (allocated(parts)) deallocate (parts)

contains

   !> Reads one case and says what came of it.
   subroutine answer(case_text, overrides, read_back)
      character(len=*), intent(in) :: case_text
      type(text_type), intent(in) :: overrides(:)
      logical, intent(in) :: read_back
      character(len=:), allocatable :: set(:)
      character(len=:), allocatable :: resolved, said, again, said_again
      type(error_type), allocatable :: error
      integer :: i, longest, news
      longest = 1
      do i = 1, size(overrides)
         longest = max(longest, len(overrides(i)%text))
      end do
      allocate (character(len=longest) :: set(size(overrides)))
      do i = 1, size(overrides)
         set(i) = overrides(i)%text
      end do
      call coverage_start()
      call resolve(case_text, set, resolved, said, error)
      news = coverage_news()
      if (allocated(error)) then
         call reply(error%status, news, printable(error%message))
         return
      end if
      if (read_back) then
         call resolve(resolved, [character(len=1) ::], again, said_again, error)
         if (allocated(error)) then
            call reply(not_itself, news, resolved//error%message)
            return
         else if (again /= resolved .or. len(again) /= len(resolved) .or. said_again /= said) then
            call reply(not_itself, news, resolved//again)
            return
         end if
      end if
      call reply(0, news, said)
   end subroutine answer

   !> The resolved case, and what is to be said of it: the same, or what a study makes of it.
   subroutine resolve(case_text, overrides, resolved, said, error)
      character(len=*), intent(in) :: case_text, overrides(:)
      character(len=:), allocatable, intent(out) :: resolved, said
      type(error_type), allocatable, intent(out) :: error
      type(study_type) :: study
      type(case_type) :: inputs
      integer :: k
      call study_from_text(case_text, name, overrides, study, error)
      if (allocated(error)) return
      said = ''
      do k = 1, study%runs
         if (k > most_runs .and. k < study%runs) cycle
         call study%inputs(k, inputs, error)
         if (allocated(error)) return
         said = said//namelist_of(inputs)//achar(0)
      end do
      if (study%given) then
         call study%resolved(resolved, error)
         if (.not. allocated(error)) said = to_text(study%runs)//achar(0)//resolved//achar(0)//said
      else
         resolved = namelist_of(inputs)
         said = resolved
      end if
   end subroutine resolve

   !> Reads one table and says what is in it.
   subroutine answer_table(text)
      character(len=*), intent(in) :: text
      type(study_table_type) :: table
      type(error_type), allocatable :: error
      type(token_type) :: token
      character(len=:), allocatable :: said
      integer :: i, k, news
      call write_bytes(scratch_path('members.csv'), text)
      call coverage_start()
      call read_table(scratch_path('members.csv'), table, error)
      news = coverage_news()
      call delete_file(scratch_path('members.csv'))
      if (allocated(error)) then
         ! without the folder
         call reply(error%status, news, printable(error%message(max(1, index(error%message, 'members.csv')):)))
         return
      end if
      said = to_text(table%rows)//achar(0)
      do i = 1, size(table%columns)
         said = said//target_text(table%columns(i))//achar(0)
      end do
      do k = 1, table%rows
         if (k > most_runs .and. k < table%rows) cycle
         do i = 1, size(table%columns)
            call table%value(k, i, token)
            said = said//value_text(token)//achar(0)
         end do
      end do
      call reply(0, news, said)
   end subroutine answer_table

   subroutine reply(status, news, text)
      integer, intent(in) :: status, news
      character(len=*), intent(in) :: text
      if (.not. write_output(bytes(8 + len(text))//bytes(status)//bytes(news)//text)) stop 3
   end subroutine reply

   !> The four bytes of a number.
   pure character(len=4) function bytes(number)
      integer, intent(in) :: number
      bytes = transfer(number, bytes)
   end function bytes

   !> False at the end of the input.
   logical function got_number(number)
      integer, intent(out) :: number
      character(len=:), allocatable :: found
      number = 0
      allocate (character(len=4) :: found)
      got_number = filled(found)
      if (got_number) number = transfer(found, number)
   end function got_number

   subroutine get_text(text)
      character(len=:), allocatable, intent(out) :: text
      integer :: length
      if (.not. got_number(length)) stop 3
      allocate (character(len=length) :: text)
      if (.not. filled(text)) stop 3
   end subroutine get_text

   !> Reads as many bytes as the text has; false at the end of the input.
   logical function filled(text)
      character(len=:), allocatable, intent(inout) :: text
      integer(c_size_t) :: done, now
      done = 0
      do while (done < len(text))
         now = c_read(0_c_int, text(done + 1:), len(text, c_size_t) - done)
         if (now <= 0) exit
         done = done + now
      end do
      filled = done == len(text)
   end function filled
end program fuzz_input
