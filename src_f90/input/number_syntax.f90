!> What counts as a number in the input.
module number_syntax
   use, intrinsic :: ieee_arithmetic, only: ieee_overflow, ieee_get_halting_mode, ieee_set_flag, ieee_set_halting_mode
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: is_special, read_number

contains

   !> [sign] digits [. digits] [e|d [sign] digits], with a digit before or after the point. Fortran itself
   !> would take more, such as 1+2 for 100.
   pure logical function is_number(word)
      character(len=*), intent(in) :: word
      character(len=:), allocatable :: mantissa, exponent
      integer :: e, point
      is_number = .false.
      if (len(word) == 0 .or. len(word) > 60) return
      e = scan(word, 'ed')
      mantissa = word
      if (e > 0) then
         mantissa = word(:e - 1)
         exponent = unsigned(word(e + 1:))
         if (len(exponent) == 0 .or. verify(exponent, '0123456789') /= 0) return
      end if
      mantissa = unsigned(mantissa)
      point = index(mantissa, '.')
      if (point > 0) mantissa = mantissa(:point - 1)//mantissa(point + 1:)
      is_number = len(mantissa) > 0 .and. verify(mantissa, '0123456789') == 0
   end function is_number

   !> The number that a word in lower case means, infinite where it is too large; `ok` is false where it is no number.
   subroutine read_number(word, x, ok)
      character(len=*), intent(in) :: word
      real(wp), intent(out) :: x
      logical, intent(out) :: ok
      logical :: halting
      integer :: status
      x = 0
      ok = is_number(word)
      if (.not. ok) return
      ! 1e400 overflows in the reading; a build that traps overflow must not stop there
      call ieee_get_halting_mode(ieee_overflow, halting)
      call ieee_set_halting_mode(ieee_overflow, .false.)
      read (word, *, iostat=status) x
      call ieee_set_flag(ieee_overflow, .false.)
      call ieee_set_halting_mode(ieee_overflow, halting)
      ok = status == 0
   end subroutine read_number

   !> True for words that mean infinity or no number.
   pure logical function is_special(word)
      character(len=*), intent(in) :: word
      is_special = any(unsigned(word) == [character(len=8) :: 'nan', 'inf', 'infinity'])
   end function is_special

   !> A word without its sign.
   pure function unsigned(word)
      character(len=*), intent(in) :: word
      character(len=:), allocatable :: unsigned
      unsigned = word
      if (len(word) > 0) then
         if (index('+-', word(1:1)) > 0) unsigned = word(2:)
      end if
   end function unsigned
end module number_syntax
