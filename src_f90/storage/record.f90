!> The results of a run in memory: datasets by path with units, meaning and scales, and texts and numbers that are root
!> attributes. The file of a run is written from it, and the row of a study is made of it.
!>
!> A record may be used again for another run: its datasets are not there then, but they keep their places, so that
!> nothing is described anew.
module record
   use kinds, only: wp, i8
   implicit none (type, external)
   private
   public :: record_type, dataset_type, move_record, lines

   !> What a dataset holds: numbers, a whole number, or texts.
   integer, parameter, public :: of_reals = 1, of_counts = 2, of_texts = 3

   type :: dataset_type
      character(len=:), allocatable :: path, units, long_name
      !> Names of its scales as in hdf5_file: slowest dimension first, separated by blanks; its own path where it is a
      !> scale.
      character(len=:), allocatable :: scales
      integer :: kind = of_reals
      !> Its size in each dimension, the fastest first; empty for a single number.
      integer, allocatable :: extents(:)
      !> The numbers; none of a dataset of texts, which are each followed by a new line.
      real(wp), allocatable :: values(:)
      character(len=:), allocatable :: texts
      !> Whether the run has it, and whether its file has not.
      logical :: there = .false., unwritten = .false.
   contains
      procedure :: group
   end type dataset_type

   type :: attribute_type
      character(len=:), allocatable :: name, text
      integer :: flag = 0
      logical :: is_flag = .false., there = .false., unwritten = .false.
   end type attribute_type

   type :: record_type
      !> The first `count` of them are in use.
      type(dataset_type), allocatable :: datasets(:)
      integer :: count = 0
      !> Rises with every change of what the datasets are; their numbers do not count.
      integer :: version = 0
      !> Where the next dataset is looked for first.
      integer, private :: next = 1
      type(attribute_type), allocatable :: attributes(:)
      !> Groups and datasets that were ever deleted, each followed by a new line: the file may still have them.
      character(len=:), allocatable :: deleted
   contains
      !> Datasets by path, of numbers, a whole number or texts; one of the name is replaced.
      generic :: put => put_numbers, put_count, put_labels
      procedure :: put_numbers
      procedure :: put_count
      procedure :: put_labels
      !> A scale that counts n things.
      procedure :: put_scale
      !> A dataset with all that it has.
      procedure :: put_dataset
      !> Root attributes; one of the name is replaced.
      procedure :: put_text
      procedure :: put_flag
      !> Whether there is a dataset, or a group with one.
      procedure :: has
      !> What was put; 0 or empty where there is none.
      procedure :: get_all
      procedure :: get_real
      procedure :: get_list
      procedure :: list_size
      procedure :: get_text
      procedure :: get_flag
      !> Its file has all of it.
      procedure :: note_written
      !> Forgets a dataset or all of a group; forgets everything.
      procedure :: delete
      procedure :: clear
   end type record_type

   integer, parameter :: first_room = 64
   character(len=*), parameter :: newline = achar(10)

contains

   !> The part of its path before the last slash.
   pure function group(self)
      class(dataset_type), intent(in) :: self
      character(len=:), allocatable :: group
      group = self%path(:index(self%path, '/', back=.true.) - 1)
   end function group

   !> A number, or an array of numbers over these scales.
   subroutine put_numbers(self, path, values, units, long_name, scales)
      class(record_type), intent(inout) :: self
      character(len=*), intent(in) :: path, units, long_name
      real(wp), intent(in) :: values(..)
      character(len=*), intent(in), optional :: scales
      character(len=:), allocatable :: over
      over = ''
      if (present(scales)) over = scales
      if (size(values) <= 0) then
         ! gfortran 12 takes an expression without numbers for an array of unknown size
         call self%put_dataset(path, of_reals, [real(wp) ::], max(shape(values), 0), units, long_name, over, '')
         return
      end if
      select rank (values)
      rank (0)
         call self%put_dataset(path, of_reals, [values], [integer ::], units, long_name, '', '')
      rank (1)
         call self%put_dataset(path, of_reals, values, shape(values), units, long_name, over, '')
      rank (2)
         call self%put_dataset(path, of_reals, [values], shape(values), units, long_name, over, '')
      rank (3)
         call self%put_dataset(path, of_reals, [values], shape(values), units, long_name, over, '')
      rank (4)
         call self%put_dataset(path, of_reals, [values], shape(values), units, long_name, over, '')
      end select
   end subroutine put_numbers

   subroutine put_scale(self, path, n, long_name)
      class(record_type), intent(inout) :: self
      character(len=*), intent(in) :: path, long_name
      integer, intent(in) :: n
      integer :: i
      call self%put(path, [(real(i, wp), i=1, n)], '1', long_name, path)
   end subroutine put_scale

   subroutine put_count(self, path, value, long_name)
      class(record_type), intent(inout) :: self
      character(len=*), intent(in) :: path, long_name
      integer(i8), intent(in) :: value
      call self%put_dataset(path, of_counts, [real(value, wp)], [integer ::], '1', long_name, '', '')
   end subroutine put_count

   !> A scale of texts, or texts over scales, in the order of Fortran and with this size in each dimension.
   subroutine put_labels(self, path, texts, long_name, extents, scales)
      class(record_type), intent(inout) :: self
      character(len=*), intent(in) :: path, texts(:), long_name
      integer, intent(in), optional :: extents(:)
      character(len=*), intent(in), optional :: scales
      character(len=:), allocatable :: joined
      integer :: i
      joined = ''
      do i = 1, size(texts)
         joined = joined//trim(texts(i))//newline
      end do
      if (present(scales)) then
         call self%put_dataset(path, of_texts, [real(wp) ::], extents, '1', long_name, scales, joined)
      else
         call self%put_dataset(path, of_texts, [real(wp) ::], [size(texts)], '1', long_name, path, joined)
      end if
   end subroutine put_labels

   subroutine put_dataset(self, path, kind, values, extents, units, long_name, scales, texts)
      class(record_type), intent(inout) :: self
      character(len=*), intent(in) :: path, units, long_name, scales, texts
      integer, intent(in) :: kind, extents(:)
      real(wp), intent(in) :: values(:)
      integer :: k
      logical :: same
      k = find(self, path)
      same = k > 0
      if (.not. same) then
         call add_dataset(self)
         k = self%count
      end if
      self%next = k + 1
      associate (own => self%datasets(k))
         if (same) same = size(own%extents) == size(extents)
         if (same) same = all(own%extents == extents) .and. own%kind == kind .and. own%scales == scales
         if (same .and. kind == of_texts) same = own%texts == texts
         ! the file has no room for another size
         if (.not. same .and. own%there) call self%delete(path)
         own%there = .true.
         own%unwritten = .true.
         own%values = values
         if (same) return
         own%path = path
         own%kind = kind
         own%extents = extents
         own%units = units
         own%long_name = long_name
         own%scales = scales
         own%texts = texts
      end associate
      self%version = self%version + 1
   end subroutine put_dataset

   !> Room for one more dataset, behind the others.
   subroutine add_dataset(self)
      class(record_type), intent(inout) :: self
      type(dataset_type), allocatable :: more(:)
      real(wp), allocatable :: values(:)
      integer :: k
      if (.not. allocated(self%datasets)) allocate (self%datasets(first_room))
      if (self%count == size(self%datasets)) then
         allocate (more(2*self%count))
         do k = 1, self%count
            ! they may be many
            call move_alloc(self%datasets(k)%values, values)
            more(k) = self%datasets(k)
            call move_alloc(values, more(k)%values)
         end do
         call move_alloc(more, self%datasets)
      end if
      self%count = self%count + 1
   end subroutine add_dataset

   !> The place of a dataset, whether it is there or was in an earlier run; 0 for an unknown one. They come in the same
   !> order again and again.
   pure integer function find(self, path)
      class(record_type), intent(in) :: self
      character(len=*), intent(in) :: path
      integer :: k
      find = 0
      do k = self%next, self%next + self%count - 1
         find = 1 + modulo(k - 1, self%count)
         if (self%datasets(find)%path == path) return
      end do
      find = 0
   end function find

   subroutine put_text(self, name, text)
      class(record_type), intent(inout) :: self
      character(len=*), intent(in) :: name, text
      call put_attribute(self, attribute_type(name, text, 0, .false., .true., .true.))
   end subroutine put_text

   subroutine put_flag(self, name, value)
      class(record_type), intent(inout) :: self
      character(len=*), intent(in) :: name
      integer, intent(in) :: value
      call put_attribute(self, attribute_type(name, '', value, .true., .true., .true.))
   end subroutine put_flag

   subroutine put_attribute(self, new)
      class(record_type), intent(inout) :: self
      type(attribute_type), intent(in) :: new
      integer :: k
      k = place_of_attribute(self, new%name)
      if (k > 0) then
         self%attributes(k) = new
      else if (allocated(self%attributes)) then
         self%attributes = [self%attributes, new]
      else
         self%attributes = [new]
      end if
   end subroutine put_attribute

   pure integer function place_of_attribute(self, name) result(k)
      class(record_type), intent(in) :: self
      character(len=*), intent(in) :: name
      if (allocated(self%attributes)) then
         do k = 1, size(self%attributes)
            if (self%attributes(k)%name == name) return
         end do
      end if
      k = 0
   end function place_of_attribute

   logical function has(self, path)
      class(record_type), intent(in) :: self
      character(len=*), intent(in) :: path
      integer :: k
      k = find(self, path)
      has = k > 0
      if (has) has = self%datasets(k)%there
      if (k > 0) return
      do k = 1, self%count
         if (self%datasets(k)%there .and. index(self%datasets(k)%path, path//'/') == 1) has = .true.
      end do
   end function has

   !> All numbers of a dataset.
   pure function get_all(self, path) result(values)
      class(record_type), intent(in) :: self
      character(len=*), intent(in) :: path
      real(wp), allocatable :: values(:)
      integer :: k
      values = [real(wp) ::]
      k = find(self, path)
      if (k == 0) return
      if (self%datasets(k)%there) values = self%datasets(k)%values
   end function get_all

   pure real(wp) function get_real(self, path)
      class(record_type), intent(in) :: self
      character(len=*), intent(in) :: path
      real(wp), allocatable :: values(:)
      get_real = 0
      values = self%get_all(path)
      if (size(values) > 0) get_real = values(1)
   end function get_real

   !> A list of this size.
   subroutine get_list(self, path, values)
      class(record_type), intent(in) :: self
      character(len=*), intent(in) :: path
      real(wp), intent(out) :: values(:)
      real(wp), allocatable :: all_values(:)
      values = 0
      all_values = self%get_all(path)
      if (size(all_values) == size(values)) values = all_values
   end subroutine get_list

   pure integer function list_size(self, path)
      class(record_type), intent(in) :: self
      character(len=*), intent(in) :: path
      list_size = size(self%get_all(path))
   end function list_size

   subroutine get_text(self, name, text)
      class(record_type), intent(in) :: self
      character(len=*), intent(in) :: name
      character(len=:), allocatable, intent(out) :: text
      integer :: k
      text = ''
      k = place_of_attribute(self, name)
      if (k == 0) return
      if (self%attributes(k)%there) text = self%attributes(k)%text
   end subroutine get_text

   subroutine get_flag(self, name, value)
      class(record_type), intent(in) :: self
      character(len=*), intent(in) :: name
      integer, intent(out) :: value
      integer :: k
      value = 0
      k = place_of_attribute(self, name)
      if (k == 0) return
      if (self%attributes(k)%there) value = self%attributes(k)%flag
   end subroutine get_flag

   subroutine note_written(self)
      class(record_type), intent(inout) :: self
      if (self%count > 0) self%datasets(:self%count)%unwritten = .false.
      if (allocated(self%attributes)) self%attributes%unwritten = .false.
   end subroutine note_written

   subroutine delete(self, path)
      class(record_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      integer :: k
      if (.not. allocated(self%deleted)) self%deleted = newline
      if (index(self%deleted, newline//path//newline) == 0) self%deleted = self%deleted//path//newline
      do k = 1, self%count
         if (index(self%datasets(k)%path//'/', path//'/') == 1) self%datasets(k)%there = .false.
      end do
   end subroutine delete

   !> Gives all that one record has to another, which loses its own.
   subroutine move_record(from, to)
      type(record_type), intent(inout) :: from, to
      to%count = from%count
      to%version = from%version
      to%next = from%next
      call move_alloc(from%datasets, to%datasets)
      call move_alloc(from%attributes, to%attributes)
      call move_alloc(from%deleted, to%deleted)
      from%count = 0
   end subroutine move_record

   subroutine clear(self)
      class(record_type), intent(inout) :: self
      if (self%count > 0) self%datasets(:self%count)%there = .false.
      if (allocated(self%attributes)) self%attributes%there = .false.
      if (allocated(self%deleted)) deallocate (self%deleted)
      self%next = 1
   end subroutine clear

   !> The lines of a text, each of which ends with a new line, filled up with blanks.
   pure function lines(text)
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: lines(:)
      integer, allocatable :: ends(:), starts(:)
      integer :: k
      ends = pack([(k, k=1, len(text))], [(text(k:k) == newline, k=1, len(text))])
      starts = [1, ends + 1]
      allocate (character(len=max(1, maxval(ends - starts(:size(ends))))) :: lines(size(ends)))
      do k = 1, size(ends)
         lines(k) = text(starts(k):ends(k) - 1)
      end do
   end function lines
end module record
