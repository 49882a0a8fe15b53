!> What counts as a number in the input.
module number_syntax
   implicit none (type, external)
   private
   public :: is_number, is_special

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

   !> Not a number, or infinite.
   pure logical function is_special(word)
      character(len=*), intent(in) :: word
      is_special = any(unsigned(word) == [character(len=8) :: 'nan', 'inf', 'infinity'])
   end function is_special

   !> Without its sign.
   pure function unsigned(word)
      character(len=*), intent(in) :: word
      character(len=:), allocatable :: unsigned
      unsigned = word
      if (len(word) > 0) then
         if (index('+-', word(1:1)) > 0) unsigned = word(2:)
      end if
   end function unsigned
end module number_syntax
