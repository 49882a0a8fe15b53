!> A small test frame. A program calls its cases by name, each behind `if (runs('name'))`, and ends with `report`.
!> The environment variable ONLY chooses: cases are run whose `program:case` contains it.
module check
   use, intrinsic :: iso_fortran_env, only: error_unit
   use kinds, only: wp
   use errors, only: error_type
   implicit none (type, external)
   private
   public :: runs, expect, expect_close, expect_no_error, expect_error, between, report

   integer :: passed = 0, failed = 0, calls = 0
   !> "test_parameter_study:ranges", for messages.
   character(len=300) :: this_case = 'outside a case'

contains

   !> True where the case is wanted. What is checked from here on is its; its random numbers are the same in every
   !> run, whatever runs before it, and others in every call.
   logical function runs(name)
      character(len=*), intent(in) :: name
      character(len=200) :: text
      real(wp) :: first(100)
      integer :: length, i
      call get_command_argument(0, text)
      this_case = trim(text(index(text, '/', back=.true.) + 1:))//':'//name
      call get_environment_variable('ONLY', text)
      runs = text == '' .or. index(this_case, trim(text)) > 0
      calls = calls + 1
      call random_seed(size=length)
      call random_seed(put=[(1000*calls + i, i=1, length)])
      ! the first ones of seeds that are alike are alike
      call random_number(first)
   end function runs

   !> What must hold.
   subroutine expect(holds, what)
      logical, intent(in) :: holds
      character(len=*), intent(in) :: what
      if (holds) then
         passed = passed + 1
      else
         failed = failed + 1
         write (error_unit, '(a)') 'FAILED: '//trim(this_case)//': '//what
      end if
   end subroutine expect

   !> |value - expected| <= tolerance.
   subroutine expect_close(value, expected, tolerance, what)
      real(wp), intent(in) :: value, expected, tolerance
      character(len=*), intent(in) :: what
      call expect(abs(value - expected) <= tolerance, what)
      if (.not. abs(value - expected) <= tolerance) write (error_unit, '(3(a,es23.15))') &
         & '   value ', value, ' expected ', expected, ' tolerance ', tolerance
   end subroutine expect_close

   !> No error is set.
   subroutine expect_no_error(error, what)
      type(error_type), allocatable, intent(in) :: error
      character(len=*), intent(in) :: what
      call expect(.not. allocated(error), what)
      if (allocated(error)) write (error_unit, '(a)') '   but: '//error%message
   end subroutine expect_no_error

   !> An error is set, of that exit status, and its message contains the words.
   subroutine expect_error(error, status, words, what)
      type(error_type), allocatable, intent(in) :: error
      integer, intent(in) :: status
      character(len=*), intent(in) :: words, what
      call expect(allocated(error), what)
      if (.not. allocated(error)) return
      call expect(error%status == status, what//': exit status')
      call expect(index(error%message, words) > 0, what//': "'//words//'" in "'//error%message//'"')
   end subroutine expect_error

   !> A random number of the interval.
   real(wp) function between(low, high)
      real(wp), intent(in) :: low, high
      call random_number(between)
      between = low + (high - low)*between
   end function between

   !> The last line of every test program.
   subroutine report()
      print '(i0,a,i0,a)', passed, ' passed, ', failed, ' failed'
      if (failed > 0) error stop 1, quiet=.true.
   end subroutine report
end module check
