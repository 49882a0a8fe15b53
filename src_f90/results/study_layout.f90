!> What the rows of a study have: columns, over dimensions with labels, numbers or texts.
module study_layout
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_is_nan
   use kinds, only: wp, i8
   use text, only: checksum, is_first
   use packet, only: packet_type, text_type
   implicit none (type, external)
   private
   public :: layout_type, dimension_type, column_type, most_labels

   !> Most labels of a dimension, and values of a row in one column; only a damaged file says more.
   integer, parameter :: most_labels = 1000000, widest = 10000000

   !> A dimension, with its labels: texts, or numbers.
   type :: dimension_type
      character(len=:), allocatable :: name, units, long_name
      logical :: has_texts = .false.
      real(wp), allocatable :: numbers(:)
      type(text_type), allocatable :: texts(:)
   contains
      procedure :: length
      !> Place of the i-th label of another; 0 where it is none of these.
      procedure :: place_of
      procedure :: has_twice
   end type dimension_type

   type :: column_type
      character(len=:), allocatable :: name, units, long_name
      !> Its dimensions after the run, the slowest first.
      integer, allocatable :: over(:)
      !> Values of a row before its own; its own.
      integer :: before = 0, width = 1
   end type column_type

   type :: layout_type
      type(dimension_type), allocatable :: dimensions(:)
      type(column_type), allocatable :: columns(:)
      !> Values of a row.
      integer :: width = 0
   contains
      !> Number of a column or dimension by its name; 0 where there is none.
      procedure :: find
      procedure :: find_dimension
      !> Sizes of a column's dimensions, the fastest first.
      procedure :: extents
      !> Finds where the values of columns stand in a row.
      procedure :: place
      procedure :: exchange
      procedure :: mark
      !> Adds a column of another layout, or what it lacks of one that is there: dimensions and labels.
      procedure :: take_column
      procedure :: take_dimension
      !> Places in a row of this layout of the values of a column of another.
      procedure :: places_of
   end type layout_type

contains

   pure integer function length(self)
      class(dimension_type), intent(in) :: self
      if (self%has_texts) then
         length = size(self%texts)
      else
         length = size(self%numbers)
      end if
   end function length

   pure integer function place_of(self, other, i) result(at)
      class(dimension_type), intent(in) :: self
      type(dimension_type), intent(in) :: other
      integer, intent(in) :: i
      at = 0
      if (self%has_texts .neqv. other%has_texts) return
      if (self%has_texts) then
         do at = size(self%texts), 1, -1
            if (self%texts(at)%text == other%texts(i)%text) return
         end do
      else if (.not. ieee_is_nan(other%numbers(i))) then
         do at = size(self%numbers), 1, -1
            if (ieee_is_nan(self%numbers(at))) cycle
            if (abs(self%numbers(at) - other%numbers(i)) <= 0) return
         end do
      end if
   end function place_of

   !> Whether a label is there twice, or is none, so that values of one would be lost.
   pure logical function has_twice(self)
      class(dimension_type), intent(in) :: self
      integer(i8) :: sums(self%length())
      integer :: i
      has_twice = .not. all(ieee_is_finite(self%numbers))
      if (has_twice) return
      do i = 1, size(sums)
         if (self%has_texts) then
            sums(i) = checksum(self%texts(i)%text, 0_i8)
         else
            ! 0 and -0 are one
            sums(i) = checksum(transfer(self%numbers(i) + 0, repeat(' ', 8)), 0_i8)
         end if
      end do
      has_twice = .not. all(is_first(sums))
   end function has_twice

   pure integer function find(self, name)
      class(layout_type), intent(in) :: self
      character(len=*), intent(in) :: name
      do find = size(self%columns), 1, -1
         if (self%columns(find)%name == name) return
      end do
   end function find

   pure integer function find_dimension(self, name) result(found)
      class(layout_type), intent(in) :: self
      character(len=*), intent(in) :: name
      do found = size(self%dimensions), 1, -1
         if (self%dimensions(found)%name == name) return
      end do
   end function find_dimension

   pure function extents(self, c)
      class(layout_type), intent(in) :: self
      integer, intent(in) :: c
      integer, allocatable :: extents(:)
      integer :: i
      associate (over => self%columns(c)%over)
         extents = [(self%dimensions(over(i))%length(), i=size(over), 1, -1)]
      end associate
   end function extents

   pure subroutine place(self)
      class(layout_type), intent(inout) :: self
      integer :: c
      self%width = 0
      do c = 1, size(self%columns)
         self%columns(c)%before = self%width
         self%columns(c)%width = product(self%extents(c))
         self%width = self%width + self%columns(c)%width
      end do
   end subroutine place

   !> Adds the labels of another dimension that are lacking, and itself where it is not there: numbers where they rise,
   !> a text behind the one that it follows there. A label that is not a number is none.
   pure subroutine take_dimension(self, other)
      class(layout_type), intent(inout) :: self
      type(dimension_type), intent(in) :: other
      type(dimension_type) :: new
      integer :: d, i, before
      d = self%find_dimension(other%name)
      if (d == 0) then
         new%name = other%name
         new%units = other%units
         new%long_name = other%long_name
         new%has_texts = other%has_texts
         allocate (new%numbers(0), new%texts(0))
         self%dimensions = [self%dimensions, new]
         d = size(self%dimensions)
      end if
      associate (own => self%dimensions(d))
         if (own%has_texts .neqv. other%has_texts) return
         do i = 1, other%length()
            if (own%place_of(other, i) > 0) cycle
            if (own%has_texts) then
               before = 0
               if (i > 1) before = own%place_of(other, i - 1)
               own%texts = [own%texts(:before), other%texts(i), own%texts(before + 1:)]
            else if (.not. ieee_is_nan(other%numbers(i))) then
               before = count(own%numbers < other%numbers(i))
               own%numbers = [own%numbers(:before), other%numbers(i), own%numbers(before + 1:)]
            end if
         end do
      end associate
   end subroutine take_dimension

   !> Adds column c of another layout with its dimensions and their labels. Nothing is added where there is a column of
   !> the name over other dimensions.
   pure subroutine take_column(self, other, c)
      class(layout_type), intent(inout) :: self
      type(layout_type), intent(in) :: other
      integer, intent(in) :: c
      type(column_type) :: new
      integer :: i
      if (.not. same_dimensions(self, other, c)) return
      new = other%columns(c)
      do i = 1, size(new%over)
         call self%take_dimension(other%dimensions(new%over(i)))
         new%over(i) = self%find_dimension(other%dimensions(new%over(i))%name)
      end do
      if (self%find(new%name) == 0) self%columns = [self%columns, new]
   end subroutine take_column

   !> Whether column c of another layout can be one here: there is none of its name, or one over the same dimensions.
   pure logical function same_dimensions(self, other, c) result(same)
      type(layout_type), intent(in) :: self, other
      integer, intent(in) :: c
      integer :: i, own
      own = self%find(other%columns(c)%name)
      same = own == 0
      if (same) return
      associate (here => self%columns(own)%over, there => other%columns(c)%over)
         same = size(here) == size(there)
         if (.not. same) return
         do i = 1, size(here)
            same = same .and. self%dimensions(here(i))%name == other%dimensions(there(i))%name &
               & .and. (self%dimensions(here(i))%has_texts .eqv. other%dimensions(there(i))%has_texts)
         end do
      end associate
   end function same_dimensions

   !> They are 0 where a label has no place, and all where the column has none.
   pure function places_of(self, other, c) result(at)
      class(layout_type), intent(in) :: self
      type(layout_type), intent(in) :: other
      integer, intent(in) :: c
      integer :: at(other%columns(c)%width)
      integer :: own, d, i, k, inner, stride
      integer, allocatable :: places(:)
      own = self%find(other%columns(c)%name)
      at = 0
      if (own == 0) return
      if (.not. same_dimensions(self, other, c)) return
      at = self%columns(own)%before + 1
      ! from the fastest dimension to the slowest: values in one of its labels, in theirs and in ours
      inner = 1
      stride = 1
      associate (over => other%columns(c)%over, here => self%columns(own)%over)
         do d = size(over), 1, -1
            associate (theirs => other%dimensions(over(d)), ours => self%dimensions(here(d)))
               places = [(ours%place_of(theirs, i), i=1, theirs%length())]
               do k = 1, size(at)
                  i = places(1 + mod((k - 1)/inner, size(places)))
                  if (at(k) > 0) at(k) = merge(at(k) + (i - 1)*stride, 0, i > 0)
               end do
               inner = inner*theirs%length()
               stride = stride*ours%length()
            end associate
         end do
      end associate
   end function places_of

   !> All of it, into a packet or out of it; `ok` of the packet is false where it has no layout.
   pure subroutine exchange(self, packed)
      class(layout_type), intent(inout) :: self
      type(packet_type), intent(inout) :: packed
      integer :: i, k, n
      if (.not. packed%reading) n = size(self%dimensions)
      call packed%count(n)
      if (packed%reading) allocate (self%dimensions(n))
      do i = 1, n
         call exchange_dimension(self%dimensions(i), packed)
      end do
      if (.not. packed%reading) n = size(self%columns)
      call packed%count(n)
      if (packed%reading) allocate (self%columns(n))
      do i = 1, size(self%columns)
         associate (own => self%columns(i))
            call packed%text(own%name)
            call packed%text(own%units)
            call packed%text(own%long_name)
            if (.not. packed%reading) n = size(own%over)
            call packed%count(n)
            if (packed%reading) allocate (own%over(n))
            do k = 1, n
               call packed%whole(own%over(k))
            end do
            packed%ok = packed%ok .and. all(own%over >= 1 .and. own%over <= size(self%dimensions))
            if (.not. packed%ok) return
            packed%ok = product([(real(self%dimensions(own%over(k))%length(), wp), k=1, n)]) <= widest
            if (.not. packed%ok) return
         end associate
      end do
      call self%place()
   end subroutine exchange

   !> A checksum of all columns with their dimensions and labels, in whatever order they stand.
   pure integer(i8) function mark(self)
      class(layout_type), intent(in) :: self
      type(layout_type) :: single
      type(packet_type) :: packed
      integer :: c, i
      mark = 0
      do c = 1, size(self%columns)
         associate (over => self%columns(c)%over)
            single = layout_type()
            single%columns = self%columns(c:c)
            allocate (single%dimensions(size(over)))
            do i = 1, size(over)
               single%dimensions(i) = self%dimensions(over(i))
               single%columns(1)%over(i) = i
            end do
         end associate
         packed = packet_type()
         call single%exchange(packed)
         mark = ieor(mark, checksum(packed%bytes(), 0_i8))
      end do
   end function mark

   pure subroutine exchange_dimension(self, packed)
      type(dimension_type), intent(inout) :: self
      type(packet_type), intent(inout) :: packed
      integer :: n, k
      call packed%text(self%name)
      call packed%text(self%units)
      call packed%text(self%long_name)
      if (.not. packed%reading) n = merge(size(self%texts), -1, self%has_texts)
      call packed%whole(n)
      self%has_texts = n >= 0
      if (packed%reading) allocate (self%texts(max(0, merge(n, 0, n <= most_labels))), self%numbers(0))
      if (.not. self%has_texts) call packed%reals(self%numbers)
      do k = 1, size(self%texts)
         call packed%text(self%texts(k)%text)
      end do
   end subroutine exchange_dimension
end module study_layout
