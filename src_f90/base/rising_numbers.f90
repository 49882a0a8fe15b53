!> Numbers in rising order, as times and places in a table.
module rising_numbers
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: number_up_to, rising_order

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

   !> Places of some numbers in rising order, by merging parts that are in order already.
   pure recursive function rising_order(numbers) result(order)
      real(wp), intent(in) :: numbers(:)
      integer :: order(size(numbers))
      integer, allocatable :: low(:), high(:)
      integer :: k, i, j
      order = 1
      if (size(numbers) < 2) return
      associate (middle => size(numbers)/2)
         low = rising_order(numbers(:middle))
         high = middle + rising_order(numbers(middle + 1:))
      end associate
      i = 1
      j = 1
      do k = 1, size(order)
         if (j > size(high)) then
            order(k) = low(i)
            i = i + 1
         else if (i > size(low)) then
            order(k) = high(j)
            j = j + 1
         else if (numbers(low(i)) <= numbers(high(j))) then
            order(k) = low(i)
            i = i + 1
         else
            order(k) = high(j)
            j = j + 1
         end if
      end do
   end function rising_order
end module rising_numbers
