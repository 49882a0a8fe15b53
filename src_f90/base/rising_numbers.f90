!> Numbers in rising order, as times and places in a table.
module rising_numbers
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: number_up_to

contains

   !> How many of some rising numbers are not above a limit, found by halving.
   pure integer function number_up_to(numbers, limit) result(number)
      real(wp), intent(in) :: numbers(:), limit
      integer :: above, middle
      number = 0
      above = size(numbers) + 1
      do while (above - number > 1)
         middle = (number + above)/2
         if (numbers(middle) <= limit) then
            number = middle
         else
            above = middle
         end if
      end do
   end function number_up_to
end module rising_numbers
