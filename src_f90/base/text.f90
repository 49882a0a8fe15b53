!> Small text helpers for messages and input.
module text
   use kinds, only: wp, i8
   implicit none (type, external)
   private
   public :: to_text, exact_text, fixed_text, lower_case, printable, shortened, on_one_line, is_utf8
   public :: checksum

   !> A number as short text, for messages: `to_text(3)`, `to_text(0.1_wp)`.
   interface to_text
      module procedure integer_text, long_text, real_text
   end interface to_text

contains

   pure function integer_text(i) result(string)
      integer, intent(in) :: i
      character(len=:), allocatable :: string
      string = long_text(int(i, i8))
   end function integer_text

   pure function long_text(i) result(string)
      integer(i8), intent(in) :: i
      character(len=:), allocatable :: string
      character(len=24) :: buffer
      write (buffer, '(i0)') i
      string = trim(buffer)
   end function long_text

   !> Six significant digits, without needless zeros: 0.019, 1e-4, -1.25e9.
   pure function real_text(x) result(string)
      real(wp), intent(in) :: x
      character(len=:), allocatable :: string
      string = of_digits(x, 6)
   end function real_text

   !> A number with this number of significant digits, without needless zeros.
   pure function of_digits(x, digits) result(string)
      real(wp), intent(in) :: x
      integer, intent(in) :: digits
      character(len=:), allocatable :: string
      character(len=32) :: buffer
      integer :: exponent, e
      if (abs(x) >= 1e-3_wp .and. abs(x) < 1e6_wp) then
         string = without_zeros(fixed_text(x, max(0, digits - 1 - floor(log10(abs(x))))))
         return
      end if
      if (.not. abs(x) > 0) then
         string = '0'
         return
      end if
      write (buffer, '(es32.'//integer_text(digits - 1)//'e3)') x
      buffer = adjustl(buffer)
      e = scan(buffer, 'E')
      if (e == 0) then
         ! not a number, or infinite
         string = trim(buffer)
         return
      end if
      read (buffer(e + 1:), *) exponent
      string = without_zeros(buffer(:e - 1))//'e'//integer_text(exponent)
   end function of_digits

   !> "0.0190" to "0.019", "10.0" to "10".
   pure function without_zeros(digits) result(string)
      character(len=*), intent(in) :: digits
      character(len=:), allocatable :: string
      integer :: last
      last = len(digits)
      if (index(digits, '.') > 0) last = verify(digits, '0', back=.true.)
      if (digits(last:last) == '.') last = last - 1
      string = digits(:last)
   end function without_zeros

   !> Six significant digits or as many more, up to seventeen, as reading them back takes to give the same bits.
   pure function exact_text(x) result(string)
      real(wp), intent(in) :: x
      character(len=:), allocatable :: string
      real(wp) :: back
      integer :: digits
      ! rounded to fewer digits the largest numbers would be infinite
      do digits = merge(17, 6, abs(x) > 0.1_wp*huge(x)), 17
         string = of_digits(x, digits)
         read (string, *) back
         if (transfer(back, 1_i8) == transfer(x, 1_i8)) return
      end do
      ! a zero below zero
      if (.not. abs(x) > 0) string = '-0'
   end function exact_text

   !> A number with this number of decimals, and a digit before the point.
   pure function fixed_text(x, decimals) result(string)
      real(wp), intent(in) :: x
      integer, intent(in) :: decimals
      character(len=:), allocatable :: string
      character(len=40) :: buffer
      write (buffer, '(f40.'//integer_text(decimals)//')') x
      string = trim(adjustl(buffer))
   end function fixed_text

   pure function lower_case(string) result(lower)
      character(len=*), intent(in) :: string
      character(len=len(string)) :: lower
      integer :: i, code
      lower = string
      do i = 1, len(string)
         code = iachar(string(i:i))
         if (code >= iachar('A') .and. code <= iachar('Z')) lower(i:i) = achar(code + 32)
      end do
   end function lower_case

   !> The text with question marks for control characters and for bytes that are not UTF-8, so that an error stays
   !> one line that any terminal shows as it is.
   pure function printable(text)
      character(len=*), intent(in) :: text
      character(len=len(text)) :: printable
      integer :: i, length
      printable = text
      i = 1
      do while (i <= len(text))
         length = utf8_length(text(i:))
         if (length == 0) then
            printable(i:i) = '?'
         else if (is_control(text(i:i + length - 1))) then
            printable(i:i + length - 1) = repeat('?', length)
         end if
         i = i + max(length, 1)
      end do
   end function printable

   !> True for the control characters of ASCII and Latin-1 and for the separators of lines and paragraphs.
   pure logical function is_control(character)
      character(len=*), intent(in) :: character
      is_control = character < ' ' .or. character == achar(127) &
         & .or. character >= char(194)//char(128) .and. character <= char(194)//char(159) &
         & .or. character == char(226)//char(128)//char(168) .or. character == char(226)//char(128)//char(169)
   end function is_control

   !> The text, or its beginning and three points where it is too long for a message.
   pure function shortened(text)
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: shortened
      integer, parameter :: most = 80
      shortened = text
      if (len(text) > most) shortened = text(:most - 3)//'...'
   end function shortened

   !> True where all of the text is UTF-8.
   pure logical function is_utf8(text)
      character(len=*), intent(in) :: text
      integer :: i, length
      is_utf8 = .false.
      i = 1
      do while (i <= len(text))
         length = utf8_length(text(i:))
         if (length == 0) return
         i = i + length
      end do
      is_utf8 = .true.
   end function is_utf8

   !> Bytes of the character that the text starts with; 0 where that is not UTF-8.
   pure integer function utf8_length(text) result(length)
      character(len=*), intent(in) :: text
      integer :: first, second, i
      first = ichar(text(1:1))
      length = merge(1, 0, first < 128)
      if (first < 194 .or. first > 244) return
      length = 2 + merge(1, 0, first >= 224) + merge(1, 0, first >= 240)
      if (len(text) < length) length = 0
      do i = 2, length
         if (ichar(text(i:i)) < 128 .or. ichar(text(i:i)) > 191) length = 0
      end do
      if (length < 3) return
      ! longer than need be, the halves of a surrogate pair, beyond the last character
      second = ichar(text(2:2))
      if (first == 224 .and. second < 160 .or. first == 237 .and. second > 159 &
         & .or. first == 240 .and. second < 144 .or. first == 244 .and. second > 143) length = 0
   end function utf8_length

   !> Lines as a list.
   pure function on_one_line(lines)
      character(len=*), intent(in) :: lines
      character(len=:), allocatable :: on_one_line
      integer :: i
      on_one_line = ''
      do i = 1, len(lines)
         if (lines(i:i) == achar(10)) then
            on_one_line = on_one_line//', '
         else
            on_one_line = on_one_line//lines(i:i)
         end if
      end do
   end function on_one_line

   !> A number from 0 to 2**62 that tells a text from another, though not against intent: two remainders of 31 bits.
   !> With `before`, the checksum of what comes before the text, it is that of both together.
   pure integer(i8) function checksum(text, before)
      character(len=*), intent(in) :: text
      integer(i8), intent(in) :: before
      integer(i8), parameter :: prime = 2_i8**31 - 1, factors(2) = [48271_i8, 69621_i8]
      integer(i8) :: remainders(2)
      integer :: i
      remainders = [before/2_i8**31, mod(before, 2_i8**31)]
      do i = 1, len(text)
         remainders = mod(remainders*factors + ichar(text(i:i)) + 1, prime)
      end do
      checksum = remainders(1)*2_i8**31 + remainders(2)
   end function checksum
end module text
