!> Rows of numbers that are filled up to whole vectors of the processor, so that loops over them have no rest.
module whole_vectors
   implicit none (type, external)
   private
   public :: lanes, padded

   integer, parameter :: lanes = 8

contains

   !> So many numbers, filled up to whole vectors.
   elemental integer function padded(numbers)
      integer, intent(in) :: numbers
      padded = lanes*((numbers + lanes - 1)/lanes)
   end function padded
end module whole_vectors
