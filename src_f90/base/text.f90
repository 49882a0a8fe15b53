!> Small text helpers for messages and input.
module text
   use kinds, only: wp, i8
   implicit none (type, external)
   private
   public :: to_text, exact_text, fixed_text, lower_case

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
      character(len=32) :: buffer
      integer :: exponent, e
      if (abs(x) >= 1e-3_wp .and. abs(x) < 1e6_wp) then
         string = without_zeros(fixed_text(x, max(0, 5 - floor(log10(abs(x))))))
         return
      end if
      if (.not. abs(x) > 0) then
         string = '0'
         return
      end if
      write (buffer, '(es14.5e3)') x
      buffer = adjustl(buffer)
      e = scan(buffer, 'E')
      if (e == 0) then
         ! not a number, or infinite
         string = trim(buffer)
         return
      end if
      read (buffer(e + 1:), *) exponent
      string = without_zeros(buffer(:e - 1))//'e'//integer_text(exponent)
   end function real_text

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

   !> Seventeen significant digits: reading them back gives the same bits.
   pure function exact_text(x) result(string)
      real(wp), intent(in) :: x
      character(len=:), allocatable :: string
      character(len=32) :: buffer
      real(wp) :: back
      string = real_text(x)
      read (string, *) back
      if (transfer(back, 1_i8) == transfer(x, 1_i8)) return
      write (buffer, '(es24.16e3)') x
      string = trim(adjustl(buffer))
   end function exact_text

   !> So many decimals, with a digit before the point.
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
end module text
