!> The last samples of a run, and its first one, in memory: what the figures of a run need that does not keep all.
module recent_samples
   use kinds, only: wp, i8
   use text, only: replaced
   use record, only: record_type
   use record_file, only: lines
   implicit none (type, external)
   private
   public :: recent_samples_type

   type :: series_type
      character(len=:), allocatable :: name, units, long_name
      !> The scale of its values; empty where a sample has one alone.
      character(len=:), allocatable :: across
      !> Values of a sample before its own; its own.
      integer :: before = 0, width = 0
   end type series_type

   type :: recent_samples_type
      type(series_type), allocatable :: series(:)
      !> All samples added, also those that are not kept any more.
      integer(i8) :: count = 0
      !> The first sample (:, 0), and the last ones, each at its number modulo `room` (:, 1:).
      real(wp), allocatable, private :: values(:, :)
      integer, private :: room = 0
   contains
      procedure :: begin
      procedure :: declare
      procedure :: has
      procedure :: add
      !> Number of the sample, from 0, from which on all are kept.
      procedure :: first
      procedure :: part
      procedure :: sample
      !> Into the checkpoint of a record, and out of it.
      procedure :: save => save_samples
      procedure :: restore
   end type recent_samples_type

   character(len=*), parameter :: group = 'checkpoint/samples', first_sample = 'checkpoint/first_sample', &
      & samples = 'checkpoint/sample_count', names = 'checkpoint/series'

   !> Characters before the name of a series that is saved; most of a name with that of a scale.
   integer, parameter :: digits = 3, longest_names = 160

contains

   !> Series follow, of which this number of samples is kept.
   subroutine begin(self, room)
      class(recent_samples_type), intent(inout) :: self
      integer, intent(in) :: room
      if (allocated(self%values)) deallocate (self%values)
      self%series = [series_type ::]
      self%room = max(1, room)
      self%count = 0
   end subroutine begin

   !> A series with this number of values a sample; all before the first sample.
   subroutine declare(self, name, width, across, units, long_name)
      class(recent_samples_type), intent(inout) :: self
      character(len=*), intent(in) :: name, across, units, long_name
      integer, intent(in) :: width
      self%series = [self%series, series_type(name, units, long_name, across, sum(self%series%width), width)]
   end subroutine declare

   pure logical function has(self, name)
      class(recent_samples_type), intent(in) :: self
      character(len=*), intent(in) :: name
      integer :: k
      has = .false.
      if (.not. allocated(self%series)) return
      do k = 1, size(self%series)
         if (self%series(k)%name == name) has = .true.
      end do
   end function has

   !> A sample: the values of all series, in the order in which they were declared.
   subroutine add(self, values)
      class(recent_samples_type), intent(inout) :: self
      real(wp), intent(in) :: values(:)
      if (.not. allocated(self%values)) allocate (self%values(size(values), 0:self%room))
      if (self%count == 0) self%values(:, 0) = values
      self%values(:, place(self, self%count)) = values
      self%count = self%count + 1
   end subroutine add

   !> Where the sample of this number, from 0, is.
   pure integer function place(self, number)
      class(recent_samples_type), intent(in) :: self
      integer(i8), intent(in) :: number
      place = 1 + int(modulo(number, int(self%room, i8)))
   end function place

   pure integer(i8) function first(self)
      class(recent_samples_type), intent(in) :: self
      first = max(0_i8, self%count - self%room)
   end function first

   !> The n samples of a series behind the first `skip` ones, (width, n): all of them kept, or the very first one.
   subroutine part(self, name, skip, n, values)
      class(recent_samples_type), intent(in) :: self
      character(len=*), intent(in) :: name
      integer(i8), intent(in) :: skip
      integer, intent(in) :: n
      real(wp), allocatable, intent(out) :: values(:, :)
      integer :: k, at, up_to_end
      do k = 1, size(self%series)
         if (self%series(k)%name == name) exit
      end do
      associate (first => self%series(k)%before + 1, last => self%series(k)%before + self%series(k)%width)
         allocate (values(self%series(k)%width, n))
         if (skip < self%first()) then
            values = self%values(first:last, :n - 1)
         else
            at = place(self, skip)
            up_to_end = min(n, self%room + 1 - at)
            values(:, :up_to_end) = self%values(first:last, at:at + up_to_end - 1)
            values(:, up_to_end + 1:) = self%values(first:last, 1:n - up_to_end)
         end if
      end associate
   end subroutine part

   !> All values of the sample of this number, from 0, which is kept.
   pure function sample(self, number) result(values)
      class(recent_samples_type), intent(in) :: self
      integer(i8), intent(in) :: number
      real(wp), allocatable :: values(:)
      values = self%values(:, place(self, number))
   end function sample

   subroutine save_samples(self, results)
      class(recent_samples_type), intent(in) :: self
      class(record_type), intent(inout) :: results
      real(wp), allocatable :: values(:, :)
      integer :: k
      if (self%count == 0) return
      if (in_groups(self)) call results%put_labels(names, scaled_names(self), 'series, and the scale of its values')
      do k = 1, size(self%series)
         associate (own => self%series(k))
            call self%part(own%name, self%first(), int(self%count - self%first()), values)
            if (own%across == '') then
               call results%put_list(path_of(self, k), values(1, :), own%units, own%long_name, '')
            else
               call results%put_table(path_of(self, k), values, own%units, own%long_name, '')
            end if
         end associate
      end do
      call results%put_list(first_sample, self%values(:, 0), 'SI', 'the first sample', '')
      call results%put_count(samples, self%count, 'samples so far')
   end subroutine save_samples

   !> Whether series belong to groups, or have other scales than pads: paths cannot say this.
   pure logical function in_groups(self)
      class(recent_samples_type), intent(in) :: self
      integer :: k
      in_groups = .false.
      do k = 1, size(self%series)
         associate (own => self%series(k))
            if (index(own%name, '/') > 0 .or. own%across /= '' .and. own%across /= 'pad') in_groups = .true.
         end associate
      end do
   end function in_groups

   !> Of each series its name and that of its scale, with a blank between them.
   pure function scaled_names(self) result(texts)
      class(recent_samples_type), intent(in) :: self
      character(len=longest_names) :: texts(size(self%series))
      integer :: k
      do k = 1, size(texts)
         texts(k) = self%series(k)%name//' '//self%series(k)%across
      end do
   end function scaled_names

   !> Where a series is saved: a file has names in alphabetical order, and these keep that of the series.
   function path_of(self, k) result(path)
      class(recent_samples_type), intent(in) :: self
      integer, intent(in) :: k
      character(len=:), allocatable :: path
      character(len=digits) :: number
      write (number, '(i0.2,a)') k, '_'
      path = group//'/'//number//replaced(self%series(k)%name, '/', '_')
   end function path_of

   !> Takes up what was saved; `ok` is false where it does not fit together. Nothing where nothing was.
   subroutine restore(self, results, ok)
      class(recent_samples_type), intent(inout) :: self
      class(record_type), intent(in) :: results
      logical, intent(out) :: ok
      integer :: k, n, kept
      ok = .true.
      if (.not. results%has(samples)) return
      kept = 0
      do k = 1, results%count
         associate (own => results%datasets(k))
            if (.not. own%there .or. own%group() /= group) cycle
            ok = ok .and. (size(own%extents) == 1 .or. size(own%extents) == 2)
            if (.not. ok) return
            n = size(own%extents)
            kept = own%extents(n)
            associate (name => own%path(len(group) + 2 + digits:))
               if (n == 1) then
                  call self%declare(name, 1, '', own%units, own%long_name)
               else
                  call self%declare(name, own%extents(1), 'pad', own%units, own%long_name)
               end if
            end associate
         end associate
      end do
      call take_names(self, results, ok)
      if (.not. ok) return
      self%count = nint(results%get_real(samples), i8)
      ok = kept > 0 .and. kept == self%count - self%first() .and. results%list_size(first_sample) == &
         & sum(self%series%width)
      if (.not. ok) return
      allocate (self%values(sum(self%series%width), 0:self%room))
      call results%get_list(first_sample, self%values(:, 0))
      do k = 1, size(self%series)
         associate (own => self%series(k))
            call restore_series(results, path_of(self, k), own, ok)
            if (.not. ok) return
         end associate
      end do

   contains

      subroutine restore_series(results, path, own, ok)
         class(record_type), intent(in) :: results
         character(len=*), intent(in) :: path
         type(series_type), intent(in) :: own
         logical, intent(out) :: ok
         real(wp) :: values(own%width*kept)
         integer :: i
         ok = results%list_size(path) == size(values)
         if (.not. ok) return
         call results%get_list(path, values)
         do i = 1, kept
            self%values(own%before + 1:own%before + own%width, place(self, self%first() + i - 1)) = &
               & values((i - 1)*own%width + 1:i*own%width)
         end do
      end subroutine restore_series
   end subroutine restore

   !> The names that paths do not say, and the scales.
   subroutine take_names(self, results, ok)
      class(recent_samples_type), intent(inout) :: self
      class(record_type), intent(in) :: results
      logical, intent(out) :: ok
      character(len=:), allocatable :: texts(:)
      integer :: k, blank
      ok = .true.
      if (.not. results%has(names)) return
      do k = 1, results%count
         if (results%datasets(k)%path == names) texts = lines(results%datasets(k)%texts)
      end do
      ok = size(texts) == size(self%series)
      if (.not. ok) return
      do k = 1, size(texts)
         blank = index(texts(k)//' ', ' ')
         self%series(k)%name = texts(k)(:blank - 1)
         self%series(k)%across = trim(texts(k)(blank + 1:))
      end do
   end subroutine take_names
end module recent_samples
