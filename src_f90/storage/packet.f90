!> Numbers and texts one after another as bytes, for a pipe or a log. The same calls write them and, of a packet of
!> bytes, read them again. What is read that is not there is 0 or empty, and `ok` is false from then on.
module packet
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: packet_type, packet_of, text_type

   type :: text_type
      character(len=:), allocatable :: text
   end type text_type

   !> Bytes of a whole number and of a real one.
   integer, parameter :: whole_bytes = 4, real_bytes = 8

   type :: packet_type
      logical :: reading = .false., ok = .true.
      character(len=:), allocatable, private :: buffer
      !> Bytes in use, and those that have been read.
      integer, private :: length = 0, done = 0
   contains
      procedure :: whole
      !> How many items follow, which have a byte each at least.
      procedure :: count => count_items
      procedure :: text
      procedure :: reals
      !> All bytes; whether all has been read.
      procedure :: bytes
      procedure :: at_end
   end type packet_type

contains

   !> A packet to be read.
   pure function packet_of(bytes) result(self)
      character(len=*), intent(in) :: bytes
      type(packet_type) :: self
      self%reading = .true.
      self%buffer = bytes
      self%length = len(bytes)
   end function packet_of

   pure function bytes(self)
      class(packet_type), intent(in) :: self
      character(len=:), allocatable :: bytes
      bytes = ''
      if (self%length > 0) bytes = self%buffer(:self%length)
   end function bytes

   pure logical function at_end(self)
      class(packet_type), intent(in) :: self
      at_end = self%ok .and. self%done == self%length
   end function at_end

   !> The next bytes begin behind the first `before`: room for n of them, or, in reading, n where they are there.
   pure subroutine go_on(self, n, before)
      class(packet_type), intent(inout) :: self
      integer, intent(inout) :: n
      integer, intent(out) :: before
      character(len=:), allocatable :: more
      if (self%reading) then
         self%ok = self%ok .and. n <= self%length - self%done
         if (.not. self%ok) n = 0
         before = self%done
         self%done = before + n
      else
         before = self%length
         self%length = before + n
         if (.not. allocated(self%buffer)) self%buffer = ''
         if (self%length <= len(self%buffer)) return
         allocate (character(len=2*self%length) :: more)
         more(:before) = self%buffer(:before)
         call move_alloc(more, self%buffer)
      end if
   end subroutine go_on

   pure subroutine whole(self, value)
      class(packet_type), intent(inout) :: self
      integer, intent(inout) :: value
      integer :: n, before
      n = whole_bytes
      call go_on(self, n, before)
      if (.not. self%reading) then
         self%buffer(before + 1:self%length) = transfer(value, repeat(' ', whole_bytes))
      else
         value = 0
         if (n > 0) value = transfer(self%buffer(before + 1:self%done), value)
      end if
   end subroutine whole

   pure subroutine count_items(self, n)
      class(packet_type), intent(inout) :: self
      integer, intent(inout) :: n
      call self%whole(n)
      if (.not. self%reading) return
      self%ok = self%ok .and. n >= 0 .and. n <= self%length - self%done
      if (.not. self%ok) n = 0
   end subroutine count_items

   pure subroutine text(self, value)
      class(packet_type), intent(inout) :: self
      character(len=:), allocatable, intent(inout) :: value
      integer :: n, before
      if (.not. self%reading) n = len(value)
      call self%count(n)
      call go_on(self, n, before)
      if (self%reading) then
         value = self%buffer(before + 1:before + n)
      else
         self%buffer(before + 1:self%length) = value
      end if
   end subroutine text

   pure subroutine reals(self, values)
      class(packet_type), intent(inout) :: self
      real(wp), allocatable, intent(inout) :: values(:)
      integer :: n, before, i
      if (.not. self%reading) n = size(values)
      call self%count(n)
      if (real(n, wp)*real_bytes >= huge(n)) self%ok = .false.
      n = merge(n, 0, self%ok)*real_bytes
      call go_on(self, n, before)
      if (self%reading) then
         values = transfer(self%buffer(before + 1:before + n), [real(wp) ::])
         return
      end if
      do i = 1, size(values)
         self%buffer(before + 1:before + real_bytes) = transfer(values(i), repeat(' ', real_bytes))
         before = before + real_bytes
      end do
   end subroutine reals
end module packet
