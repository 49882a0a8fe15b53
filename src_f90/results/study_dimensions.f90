!> A dimension of a study: its labels, numbers or texts, which become more as runs come that have others.
module study_dimensions
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan, ieee_is_nan
   use kinds, only: wp
   use record, only: dataset_type, of_texts
   use hdf5_file, only: hdf5_type
   use hdf5_scales, only: read_about
   use hdf5_rows, only: hdf5_rows_type
   use hdf5_texts, only: hdf5_texts_type, text_type
   implicit none (type, external)
   private
   public :: dimension_type, dimension_of, open_dimension, list_type, positions

   !> Most labels; only a damaged file says more.
   integer, parameter :: most_labels = 1000000

   !> A number, or a text where it is allocated.
   type :: label_type
      real(wp) :: number = 0
      character(len=:), allocatable :: text
   end type label_type

   type :: dimension_type
      character(len=:), allocatable :: name, units, long_name
      logical, private :: has_texts = .false.
      type(label_type), allocatable, private :: labels(:)
   contains
      procedure :: length
      procedure :: take_labels
      procedure :: places
      !> Writes its dataset, a new one or in place of the old.
      procedure :: write => write_dimension
   end type dimension_type

   !> Places of the labels along a dimension.
   type :: list_type
      integer, allocatable :: at(:)
   end type list_type

contains

   !> The dimension that a scale of a record is.
   function dimension_of(scale) result(found)
      type(dataset_type), intent(in) :: scale
      type(dimension_type) :: found
      integer :: i, first, length
      found%name = scale%path
      found%units = scale%units
      found%long_name = scale%long_name
      found%has_texts = scale%kind == of_texts
      allocate (found%labels(product(scale%extents)))
      first = 1
      do i = 1, size(found%labels)
         if (found%has_texts) then
            length = index(scale%texts(first:), achar(10)) - 1
            found%labels(i)%text = scale%texts(first:first + length - 1)
            first = first + length + 1
         else
            found%labels(i)%number = scale%values(i)
         end if
      end do
   end function dimension_of

   pure integer function length(self)
      class(dimension_type), intent(in) :: self
      length = size(self%labels)
   end function length

   !> Place of a label; 0 where it is none of them.
   pure integer function place_of(label, labels) result(at)
      type(label_type), intent(in) :: label, labels(:)
      at = 0
      ! of a scale that the run does not have
      if (ieee_is_nan(label%number)) return
      do at = 1, size(labels)
         if (allocated(label%text) .neqv. allocated(labels(at)%text)) cycle
         if (allocated(label%text)) then
            if (label%text == labels(at)%text) return
         else if (abs(label%number - labels(at)%number) <= 0) then
            return
         end if
      end do
      at = 0
   end function place_of

   !> Adds the labels of another that it lacks: numbers where they rise, a text behind the one that it follows there.
   !> True where there were any.
   logical function take_labels(self, other) result(grown)
      class(dimension_type), intent(inout) :: self
      type(dimension_type), intent(in) :: other
      integer :: i, before
      grown = .false.
      do i = 1, other%length()
         if (ieee_is_nan(other%labels(i)%number) .or. place_of(other%labels(i), self%labels) > 0) cycle
         if (self%has_texts) then
            before = 0
            if (i > 1) before = place_of(other%labels(i - 1), self%labels)
         else
            before = count(self%labels%number < other%labels(i)%number)
         end if
         call insert(self, before, other%labels(i))
         grown = .true.
      end do
   end function take_labels

   !> Adds a label behind the first `before` ones.
   subroutine insert(self, before, label)
      class(dimension_type), intent(inout) :: self
      integer, intent(in) :: before
      type(label_type), intent(in) :: label
      type(label_type), allocatable :: more(:)
      allocate (more(self%length() + 1))
      more(:before) = self%labels(:before)
      more(before + 1) = label
      more(before + 2:) = self%labels(before + 1:)
      call move_alloc(more, self%labels)
   end subroutine insert

   !> The places of another's labels; 0 where it lacks one.
   pure function places(self, other)
      class(dimension_type), intent(in) :: self
      type(dimension_type), intent(in) :: other
      integer :: places(other%length()), i
      places = [(place_of(other%labels(i), self%labels), i=1, other%length())]
   end function places

   !> Places of an array's values within an array of these extents, the fastest first, by the places of its labels, the
   !> slowest dimension first. All are 0 where a label has no place.
   pure function positions(lists, extents) result(at)
      type(list_type), intent(in) :: lists(:)
      integer, intent(in) :: extents(:)
      integer, allocatable :: at(:)
      integer :: i, d, rest, stride, n, j
      n = 1
      do d = 1, size(lists)
         n = n*size(lists(d)%at)
      end do
      allocate (at(n), source=1)
      do d = 1, size(lists)
         if (any(lists(d)%at == 0)) at = 0
      end do
      if (any(at == 0)) return
      do i = 1, n
         rest = i - 1
         stride = 1
         do d = size(lists), 1, -1
            j = mod(rest, size(lists(d)%at))
            rest = rest/size(lists(d)%at)
            at(i) = at(i) + (lists(d)%at(j + 1) - 1)*stride
            stride = stride*extents(size(lists) + 1 - d)
         end do
      end do
   end function positions

   subroutine write_dimension(self, file)
      class(dimension_type), intent(in) :: self
      class(hdf5_type), intent(inout) :: file
      type(hdf5_texts_type) :: list
      type(hdf5_rows_type) :: column
      type(text_type), allocatable :: texts(:)
      logical :: new
      integer :: i
      new = .not. file%has(self%name)
      if (self%has_texts) then
         allocate (texts(self%length()))
         do i = 1, self%length()
            texts(i)%text = self%labels(i)%text
         end do
         if (new) then
            call list%create(file, self%name, self%length())
            call file%describe(list%id, self%units, self%long_name, self%name, self%name)
         else
            call list%open(file, self%name)
            call list%resize(file, self%length())
         end if
         call list%write(file, 1, texts)
         call list%close(file)
      else
         if (new) then
            call column%create(file, self%name, [integer ::], self%length(), ieee_value(1.0_wp, ieee_quiet_nan), &
               & .false.)
            call file%describe(column%id, self%units, self%long_name, self%name, self%name)
         else
            call column%open(file, self%name)
            call column%resize(file, [integer ::], self%length())
         end if
         call column%write(file, 1, reshape(self%labels%number, [1, self%length()]))
         call column%close(file)
      end if
   end subroutine write_dimension

   !> The dimension that a scale of a study's file is.
   subroutine open_dimension(file, name, of_texts, found)
      class(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: name
      logical, intent(in) :: of_texts
      type(dimension_type), intent(out) :: found
      type(hdf5_texts_type) :: list
      type(hdf5_rows_type) :: column
      type(text_type), allocatable :: texts(:)
      real(wp), allocatable :: values(:, :)
      integer :: i
      found%name = name
      found%has_texts = of_texts
      call read_about(file, name, found%units, found%long_name)
      if (of_texts) then
         call list%open(file, name)
         if (list%length > most_labels) call file%check_read(-1, 'take memory for '//name)
         call list%read(file, 1, min(list%length, most_labels), texts)
         call list%close(file)
         allocate (found%labels(size(texts)))
         do i = 1, size(texts)
            found%labels(i)%text = texts(i)%text
         end do
      else
         call column%open(file, name)
         if (column%rows > most_labels) call file%check_read(-1, 'take memory for '//name)
         call column%read(file, 1, min(column%rows, most_labels), values)
         call column%close(file)
         allocate (found%labels(size(values)))
         if (size(values) > 0) found%labels%number = values(1, :)
      end if
   end subroutine open_dimension
end module study_dimensions
