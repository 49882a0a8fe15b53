!> Values of a swept variable: single ones as they stand, ranges to the last bit, and what is refused.
program test_swept_values
   use kinds, only: wp
   use text, only: to_text, exact_text
   use errors, only: error_type, input_error
   use assignments, only: token_type
   use swept_values, only: swept_values_type, read_swept_values
   use check, only: runs, expect, expect_close, expect_no_error, expect_error, between, report
   implicit none (type, external)
   integer :: i

   if (runs('single_values')) call single_values()
   if (runs('strides')) call strides()
   if (runs('factors')) call factors()
   if (runs('mixed')) call mixed()
   do i = 1, 20
      if (runs('to_the_last_bit')) call to_the_last_bit()
   end do
   if (runs('longest')) call longest()
   if (runs('refused')) call refused()
   call report()

contains

   !> Tokens of words between blanks; those that begin with a quote are quoted.
   subroutine read_values(words, values, error)
      character(len=*), intent(in) :: words
      type(swept_values_type), intent(out) :: values
      type(error_type), allocatable, intent(out) :: error
      type(token_type), allocatable :: tokens(:)
      type(token_type) :: token
      character(len=:), allocatable :: rest
      integer :: blank
      allocate (tokens(0))
      rest = words//' '
      do while (rest /= '')
         blank = index(rest, ' ')
         token%text = rest(:blank - 1)
         token%quoted = rest(1:1) == ''''
         if (token%quoted) token%text = rest(2:blank - 2)
         tokens = [tokens, token]
         rest = rest(blank + 1:)
      end do
      call read_swept_values(tokens, 'a%x', values, error)
   end subroutine read_values

   !> The values are these, separated by blanks.
   subroutine expect_values(words, expected)
      character(len=*), intent(in) :: words, expected
      type(swept_values_type) :: values
      type(error_type), allocatable :: error
      type(token_type) :: token
      character(len=:), allocatable :: found
      integer :: k
      call read_values(words, values, error)
      call expect_no_error(error, words)
      if (allocated(error)) return
      found = ''
      do k = 1, values%count()
         call values%value(k, token)
         found = found//' '//token%text
      end do
      call expect(found == ' '//expected, words//' are '//expected//', not'//found)
   end subroutine expect_values

   subroutine single_values()
      type(swept_values_type) :: values
      type(error_type), allocatable :: error
      type(token_type) :: token
      call expect_values('1 2.50 -3e5', '1 2.50 -3e5')
      call read_values('none ''1:2:1''', values, error)
      call expect_no_error(error, 'texts')
      call expect(values%count() == 2, 'a quoted text is no range')
      call values%value(2, token)
      call expect(token%quoted .and. token%text == '1:2:1', 'and stays as it is')
      call expect(values%text() == 'none, ''1:2:1''', 'as they stand in a case: '//values%text())
   end subroutine single_values

   subroutine strides()
      call expect_values('1:3:1', '1 2 3')
      call expect_values('1:3.9:1', '1 2 3')
      call expect_values('3:1:-1', '3 2 1')
      call expect_values('5:5:1', '5')
      call expect_values('0:2e6:1e6', '0 1000000 2000000')
      ! ten strides of 0.1 make a last value that 1 exceeds by its rounding alone
      call expect_count('0:1:0.1', 11)
      call expect_count('0:0.99999:0.1', 10)
      call expect_count('0:0.99999999:0.1', 11)
   end subroutine strides

   subroutine factors()
      call expect_values('1:1000:*10', '1 10 100 1000')
      call expect_values('1:999:*10', '1 10 100')
      call expect_values('8:1:*0.5', '8 4 2 1')
      call expect_values('-1:-4:*2', '-1 -2 -4')
      call expect_values('7:7:*2', '7')
   end subroutine factors

   subroutine expect_count(words, expected)
      character(len=*), intent(in) :: words
      integer, intent(in) :: expected
      type(swept_values_type) :: values
      type(error_type), allocatable :: error
      call read_values(words, values, error)
      call expect_no_error(error, words)
      if (allocated(error)) return
      call expect(values%count() == expected, words//' are '//to_text(expected)//', not '//to_text(values%count()))
   end subroutine expect_count

   subroutine mixed()
      type(swept_values_type) :: values
      type(error_type), allocatable :: error
      call expect_values('7 1:3:1 9 10:1000:*10 11', '7 1 2 3 9 10 100 1000 11')
      call read_values('7 1:3:1 9', values, error)
      call expect(values%text() == '7, 1:3:1, 9', 'as they stand in a case: '//values%text())
   end subroutine mixed

   !> first + i*stride, the product rounded by itself; first*factor**i, not a product of products.
   subroutine to_the_last_bit()
      type(swept_values_type) :: values
      type(error_type), allocatable :: error
      type(token_type) :: token
      real(wp), volatile :: product
      real(wp) :: first, step, x
      integer :: k
      first = between(1.0_wp, 2.0_wp)
      step = between(1e-3_wp, 2e-3_wp)
      call read_values(exact_text(first)//':'//exact_text(first + 1)//':'//exact_text(step), values, error)
      do k = 1, values%count()
         call values%value(k, token)
         read (token%text, *) x
         product = (k - 1)*step
         call expect_close(x, first + product, 0.0_wp, 'value '//to_text(k)//' of a stride')
      end do
      step = between(1.01_wp, 1.02_wp)
      call read_values(exact_text(first)//':'//exact_text(10*first)//':*'//exact_text(step), values, error)
      call expect(values%count() == 1 + floor(log(10.0_wp)/log(step)), 'as many as the logarithms say')
      do k = 1, values%count()
         call values%value(k, token)
         read (token%text, *) x
         call expect_close(x, first*step**real(k - 1, wp), 0.0_wp, 'value '//to_text(k)//' of a factor')
      end do
   end subroutine to_the_last_bit

   subroutine longest()
      call expect_count('1:100000:1', 100000)
      call expect_refused('1:100001:1', 'more than 100000 values')
      call expect_refused('0:1:1e-100', 'more than 100000 values')
      call expect_refused('-1e100:1e100:1e-100', 'more than 100000 values')
      call expect_refused('1:1e99:*1.0000001', 'more than 100000 values')
   end subroutine longest

   subroutine expect_refused(words, reason)
      character(len=*), intent(in) :: words, reason
      type(swept_values_type) :: values
      type(error_type), allocatable :: error
      call read_values(words, values, error)
      call expect_error(error, input_error, reason, 'refused: '//words)
      if (allocated(error)) call expect(index(error%message, 'a%x = ') == 1, 'says what is assigned: '//error%message)
   end subroutine expect_refused

   subroutine refused()
      call expect_refused('3*1', 'not for a sweep')
      call expect_refused('1:2', 'a range is first:last:stride')
      call expect_refused('1:2:3:4', 'a range is')
      call expect_refused('1:', 'a range is')
      call expect_refused('::', 'a range is')
      call expect_refused('1::3', 'a range is')
      call expect_refused('1:2:*', 'a range is')
      call expect_refused('1:2:', 'a range is')
      call expect_refused('1:2:**3', 'a range is')
      call expect_refused('1:a:3', 'a range is')
      call expect_refused('1:nan:3', 'a range is')
      call expect_refused('1:1e101:1', '1e-100 to 1e100 in size')
      call expect_refused('1e-101:1:1', '1e-100 to 1e100 in size')
      call expect_refused('1:1e999:1', '1e-100 to 1e100 in size')
      call expect_refused('1:2:1e-200', '1e-100 to 1e100 in size')
      call expect_refused('1:2:0', 'must not be 0')
      call expect_refused('1:2:-1', 'must be > 0')
      call expect_refused('2:1:1', 'must be < 0')
      call expect_refused('-1:2:*2', 'of one sign')
      call expect_refused('0:2:*2', 'of one sign')
      call expect_refused('2:0:*0.5', 'of one sign, and not 0')
      call expect_refused('1:2:*-2', 'must be > 0, and not 1')
      call expect_refused('1:2:*1', 'must be > 0, and not 1')
      call expect_refused('1:2:*0', 'must be > 0, and not 1')
      call expect_refused('1:2:*0.5', 'must be > 1')
      call expect_refused('2:1:*2', 'must be < 1')
   end subroutine refused
end program test_swept_values
