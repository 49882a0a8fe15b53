!> Places in a table: the intervals of a piecewise linear logarithm along its axes, and a hash of whole numbers, with
!> open addressing, that finds what is kept of a place.
!>
!> Intervals follow the magnitude of a positive number. An octave, from one power of 2 to the next, is cut into 2^level
!> equal ones, and these are numbered through over all octaves. The bits of a number give its interval; within one,
!> everything is linear in the number itself, so that neither logarithm nor power is ever needed.
module cell_index
   use, intrinsic :: iso_fortran_env, only: int64
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: cell_index_type, cell_key, interval, lower_end

   !> Numbers of entries by their keys. It grows as it fills.
   type :: cell_index_type
      integer :: count = 0
      integer(int64), allocatable, private :: keys(:)
      integer, allocatable, private :: entries(:)
   contains
      procedure :: find
      procedure :: add
      procedure :: clear
   end type cell_index_type

   !> Slots at first, a power of 2; they double once half of them are taken.
   integer, parameter :: first_slots = 256
   !> Bits of a key for the places along the first two axes, the third and the fourth; the rest is left to the level.
   integer, parameter :: axis_bits = 18, third_bits = 11, fourth_bits = 12

contains

   !> The interval of a number > 0 at a level.
   elemental integer function interval(x, level)
      real(wp), intent(in) :: x
      integer, intent(in) :: level
      interval = ishft(exponent(x), level) + int(scale(2*fraction(x) - 1, level))
   end function interval

   !> The lower end of an interval of a level; it belongs to the interval, the upper end to the next.
   elemental real(wp) function lower_end(interval, level)
      integer, intent(in) :: interval, level
      integer :: pieces
      pieces = 2**level
      lower_end = scale(1 + modulo(interval, pieces)/real(pieces, wp), floor(interval/real(pieces, wp)) - 1)
   end function lower_end

   !> The key of a place in up to four dimensions, at a level of 0 to 31.
   pure integer(int64) function cell_key(level, first, second, third, fourth)
      integer, intent(in) :: level, first, second, third, fourth
      cell_key = ior(ior(bits(level, 5, 2*axis_bits + third_bits), bits(first, axis_bits, axis_bits + third_bits)), &
         & ior(bits(second, axis_bits, third_bits), bits(third, third_bits, 0)))
      cell_key = ior(ishft(cell_key, fourth_bits), bits(fourth, fourth_bits, 0))
   contains
      pure integer(int64) function bits(number, width, shift)
         integer, intent(in) :: number, width, shift
         bits = ishft(ibits(int(number, int64), 0, width), shift)
      end function bits
   end function cell_key

   !> The entry of a key; 0: there is none.
   pure integer function find(self, key)
      class(cell_index_type), intent(in) :: self
      integer(int64), intent(in) :: key
      find = 0
      if (self%count > 0) find = self%entries(slot_of(self%keys, self%entries, key))
   end function find

   !> Adds an entry > 0 under a key that has none.
   subroutine add(self, key, entry)
      class(cell_index_type), intent(inout) :: self
      integer(int64), intent(in) :: key
      integer, intent(in) :: entry
      integer(int64), allocatable :: keys(:)
      integer, allocatable :: entries(:)
      integer :: i, slots
      if (.not. allocated(self%entries)) then
         allocate (self%keys(0:first_slots - 1), source=0_int64)
         allocate (self%entries(0:first_slots - 1), source=0)
      else if (2*self%count >= size(self%entries)) then
         call move_alloc(self%keys, keys)
         call move_alloc(self%entries, entries)
         slots = 2*size(entries)
         allocate (self%keys(0:slots - 1), source=0_int64)
         allocate (self%entries(0:slots - 1), source=0)
         do i = 0, size(entries) - 1
            if (entries(i) > 0) call put(keys(i), entries(i))
         end do
      end if
      call put(key, entry)
      self%count = self%count + 1
   contains
      subroutine put(key, entry)
         integer(int64), intent(in) :: key
         integer, intent(in) :: entry
         integer :: slot
         slot = slot_of(self%keys, self%entries, key)
         self%keys(slot) = key
         self%entries(slot) = entry
      end subroutine put
   end subroutine add

   !> Forgets all entries.
   pure subroutine clear(self)
      class(cell_index_type), intent(inout) :: self
      self%count = 0
      if (allocated(self%entries)) deallocate (self%keys, self%entries)
   end subroutine clear

   !> The slot of a key, or the free one where it belongs.
   pure integer function slot_of(keys, entries, key)
      integer(int64), intent(in) :: keys(0:), key
      integer, intent(in) :: entries(0:)
      integer(int64) :: mixed
      ! Marsaglia's xorshift spreads the key over the slots
      mixed = ieor(key, ishft(key, 13))
      mixed = ieor(mixed, ishft(mixed, -7))
      mixed = ieor(mixed, ishft(mixed, 17))
      slot_of = int(iand(ieor(mixed, ishft(mixed, -32)), int(size(entries) - 1, int64)))
      do while (entries(slot_of) > 0)
         if (keys(slot_of) == key) exit
         slot_of = iand(slot_of + 1, size(entries) - 1)
      end do
   end function slot_of
end module cell_index
