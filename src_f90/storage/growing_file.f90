!> An HDF5 file that grows by samples and can be continued: series over one axis (time, or whatever a task follows) grow
!> together, a sample at a time, and are written a chunk at a time. Where not all samples are kept, the last ones and
!> the first one are in memory: what the figures of a run need.
!>
!> It is written beside its final name and published whole, at checkpoints and at the end, so that a crash at any
!> moment leaves the last checkpoint, or before the first one the previous file as it was.
module growing_file
   use kinds, only: wp, i8
   use text, only: replaced
   use errors, only: error_type
   use clock, only: wall_clock
   use record, only: record_type, lines
   use hdf5_file, only: hdf5_type
   use hdf5_rows, only: hdf5_rows_type, chunk_samples
   use working_file, only: working_file_type
   implicit none (type, external)
   private
   public :: growing_file_type

   type :: series_type
      character(len=:), allocatable :: name, units, long_name
      !> The scale of its values; empty where a sample has one alone.
      character(len=:), allocatable :: across
      !> Values of a sample before its own; its own.
      integer :: before = 0, width = 0
      !> In the file, if it is there.
      type(hdf5_rows_type) :: data
   end type series_type

   type, extends(hdf5_type) :: growing_file_type
      type(working_file_type) :: working
      !> Name of the series that is the scale of all; it is declared first.
      character(len=:), allocatable, private :: axis
      !> How many samples there will be, if this is known.
      integer(i8), private :: expected = 0
      !> Whether all samples go to the file; else the last `room` are kept in memory.
      logical, private :: in_file = .true.
      type(series_type), allocatable, private :: series(:)
      !> Whether the series have names.
      logical :: declared = .false.
      !> The first sample (:, 0), and the last ones, each at its number modulo `room` (:, 1:).
      real(wp), allocatable, private :: values(:, :)
      integer, private :: room = 0
      !> Samples as they are written, series by series; its memory is used again.
      real(wp), allocatable, private :: arranged(:)
      !> Samples added, also before the run was resumed, and those of them that are in the file.
      integer(i8) :: samples = 0
      integer(i8), private :: written = 0
      !> Wall time of writing samples, s.
      real(wp) :: writing_seconds = 0
   contains
      !> Locks the name of the file, so that no other run writes it, until `abandon`.
      procedure :: claim
      procedure :: begin
      procedure :: reopen
      procedure :: begin_series
      !> Names a series; all before the first sample.
      procedure :: declare
      procedure :: add
      procedure :: has_series
      !> Number of the sample, from 0, from which on all are kept.
      procedure :: first
      procedure :: part_of_samples
      procedure :: last_samples
      !> Samples in memory: into the checkpoint of a record, out of it, and at the end into the file.
      procedure :: save => save_samples
      procedure :: restore
      procedure :: write_kept
      procedure :: publish
      !> Deletes what was not published, and frees the lock.
      procedure :: abandon
   end type growing_file_type

   character(len=*), parameter :: group = 'checkpoint/samples', first_sample = 'checkpoint/first_sample', &
      & sample_count = 'checkpoint/sample_count', series_names = 'checkpoint/series'
   !> Samples that are arranged together.
   integer, parameter :: together = 64
   !> Characters before the name of a series that is saved; most of a name with that of a scale.
   integer, parameter :: digits = 3, longest_names = 160

contains

   subroutine claim(self, path, error)
      class(growing_file_type), intent(inout) :: self
      character(len=*), intent(in) :: path
      type(error_type), allocatable, intent(out) :: error
      self%series = [series_type ::]
      call self%working%claim(path, error)
   end subroutine claim

   !> Starts a new file under the name claimed.
   subroutine begin(self, error)
      class(growing_file_type), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error
      call self%working%make_part(error)
      if (.not. allocated(error)) call self%create(self%working%part)
   end subroutine begin

   !> Opens a copy of the file of the name claimed, to continue it.
   subroutine reopen(self, error)
      class(growing_file_type), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error
      call self%working%copy_published(error)
      if (.not. allocated(error)) call open_part(self, error)
   end subroutine reopen

   !> Opens the part, unless another run has taken the place of this one, whose part then has the name.
   subroutine open_part(self, error)
      class(growing_file_type), intent(inout) :: self
      type(error_type), allocatable, intent(out) :: error
      call self%working%check_part(error)
      if (.not. allocated(error)) call self%open(self%working%part, writing=.true.)
   end subroutine open_part

   !> Series over an axis, 'time' or another, follow; they start from the samples that are in the file, if any.
   !> `expected`: how many there will be in the end, if this is known. `kept`: how many of the last are kept, in memory;
   !> without it all go to the file.
   subroutine begin_series(self, axis, expected, kept)
      class(growing_file_type), intent(inout) :: self
      character(len=*), intent(in) :: axis
      integer(i8), intent(in) :: expected
      integer, intent(in), optional :: kept
      type(hdf5_rows_type) :: scale
      self%axis = axis
      self%expected = expected
      self%in_file = .not. present(kept)
      self%room = chunk_samples
      if (present(kept)) self%room = max(1, kept)
      if (allocated(self%values)) deallocate (self%values)
      if (allocated(self%arranged)) deallocate (self%arranged)
      self%series = [series_type ::]
      self%declared = .false.
      self%samples = 0
      self%written = 0
      if (.not. self%in_file) return
      if (.not. self%has(axis)) return
      call scale%open(self%hdf5_type, axis)
      self%samples = scale%length
      self%written = self%samples
      call scale%close(self%hdf5_type)
   end subroutine begin_series

   !> A series of this number of values over the axis, or, where `across` names another scale, over both. One that is in
   !> the file must have this width and be as long as all others.
   subroutine declare(self, name, width, units, long_name, across)
      class(growing_file_type), intent(inout) :: self
      character(len=*), intent(in) :: name, units, long_name, across
      integer, intent(in) :: width
      type(series_type) :: new
      new%name = name
      new%units = units
      new%long_name = long_name
      new%across = across
      new%before = sum(self%series%width)
      new%width = width
      new%data%called = 'samples'
      if (self%in_file .and. self%samples == 0) then
         call create_series(self%hdf5_type, self%axis, new, self%expected)
      else if (self%in_file) then
         call new%data%open(self%hdf5_type, name)
         if (new%data%length /= self%samples .or. new%data%width() /= width) call self%check_read(-1, &
            & 'find all samples of '//name)
      end if
      self%series = [self%series, new]
   end subroutine declare

   subroutine create_series(file, axis, own, expected)
      class(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: axis
      type(series_type), intent(inout) :: own
      integer(i8), intent(in) :: expected
      call own%data%create(file, own%name, pack([own%width], own%across /= ''), 0, expected=expected)
      call file%describe(own%data%id, own%units, own%long_name, trim(axis//' '//own%across), own%name)
   end subroutine create_series

   !> A sample: the values of all series, in the order in which they were declared.
   subroutine add(self, values)
      class(growing_file_type), intent(inout) :: self
      real(wp), intent(in), contiguous :: values(:)
      self%declared = .true.
      if (.not. allocated(self%values)) allocate (self%values(sum(self%series%width), 0:self%room))
      if (size(values) /= size(self%values, 1)) call self%check_read(-1, 'find all series')
      if (allocated(self%failure)) return
      if (self%samples == 0) self%values(:, 0) = values
      ! chunks of the file are filled up, also after a checkpoint in the middle of one
      if (mod(self%samples, int(self%room, i8)) == 0) call write_held(self)
      self%values(:, place(self, self%samples)) = values
      self%samples = self%samples + 1
   end subroutine add

   !> Where the sample of this number, from 0, is.
   pure integer function place(self, number)
      class(growing_file_type), intent(in) :: self
      integer(i8), intent(in) :: number
      place = 1 + int(modulo(number, int(self%room, i8)))
   end function place

   !> Writes the samples that the file lacks, which are all in one chunk.
   subroutine write_held(self)
      class(growing_file_type), intent(inout), target :: self
      real(wp), pointer, contiguous :: own_values(:, :)
      real(wp) :: started
      integer :: k, from, to, n
      if (.not. self%in_file .or. self%written == self%samples) return
      started = wall_clock()
      from = place(self, self%written)
      to = place(self, self%samples - 1)
      n = to - from + 1
      call arrange(self, from, to)
      do k = 1, size(self%series)
         associate (own => self%series(k))
            own_values(1:own%width, 1:n) => self%arranged(own%before*n + 1:(own%before + own%width)*n)
            call own%data%append(self%hdf5_type, own_values)
         end associate
      end do
      self%written = self%samples
      self%writing_seconds = self%writing_seconds + wall_clock() - started
   end subroutine write_held

   !> Arranges the samples at these places series by series, each as (value, sample): in parts that stay in the cache
   !> while all series take theirs.
   subroutine arrange(self, from, to)
      class(growing_file_type), intent(inout) :: self
      integer, intent(in) :: from, to
      integer :: first, j, k, m, n, at
      if (.not. allocated(self%arranged)) allocate (self%arranged(size(self%values, 1)*self%room))
      n = to - from + 1
      do first = from, to, together
         do k = 1, size(self%series)
            associate (before => self%series(k)%before, width => self%series(k)%width)
               m = min(together, to - first + 1)
               do j = 1, width
                  at = before*n + (first - from)*width + j
                  self%arranged(at:at + (m - 1)*width:width) = self%values(before + j, first:first + m - 1)
               end do
            end associate
         end do
      end do
   end subroutine arrange

   logical function has_series(self, name) result(has)
      class(growing_file_type), intent(inout) :: self
      character(len=*), intent(in) :: name
      has = place_of(self, name) > 0
      if (.not. has .and. self%in_file) has = self%has(name)
   end function has_series

   !> Number of a series; 0 where this run has declared none of the name.
   pure integer function place_of(self, name) result(k)
      class(growing_file_type), intent(in) :: self
      character(len=*), intent(in) :: name
      do k = size(self%series), 1, -1
         if (self%series(k)%name == name) return
      end do
   end function place_of

   pure integer(i8) function first(self)
      class(growing_file_type), intent(in) :: self
      first = 0
      if (.not. self%in_file) first = max(0_i8, self%samples - self%room)
   end function first

   !> The last n samples of a series, (width, n); n at most those that are kept.
   subroutine last_samples(self, name, n, values)
      class(growing_file_type), intent(inout) :: self
      character(len=*), intent(in) :: name
      integer, intent(in) :: n
      real(wp), allocatable, intent(out) :: values(:, :)
      call self%part_of_samples(name, self%samples - n, n, values)
   end subroutine last_samples

   !> The n samples of a series behind the first `skip` ones, (width, n): all kept, or the first one alone.
   subroutine part_of_samples(self, name, skip, n, values)
      class(growing_file_type), intent(inout) :: self
      character(len=*), intent(in) :: name
      integer(i8), intent(in) :: skip
      integer, intent(in) :: n
      real(wp), allocatable, intent(out) :: values(:, :)
      type(hdf5_rows_type) :: data
      integer :: k, at, up_to_end
      k = place_of(self, name)
      call write_held(self)
      if (self%in_file .and. k > 0) then
         call self%series(k)%data%read_behind(self%hdf5_type, skip, n, values)
      else if (self%in_file) then
         ! not one of this run's own: from before it was resumed
         data%called = 'samples'
         call data%open(self%hdf5_type, name)
         call data%read_behind(self%hdf5_type, skip, n, values)
         call data%close(self%hdf5_type)
      else
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
      end if
   end subroutine part_of_samples

   subroutine save_samples(self, results)
      class(growing_file_type), intent(inout) :: self
      class(record_type), intent(inout) :: results
      real(wp), allocatable :: values(:, :)
      character(len=longest_names) :: names(size(self%series))
      logical :: plain
      integer :: k
      if (self%in_file .or. self%samples == 0) return
      plain = .true.
      do k = 1, size(self%series)
         associate (own => self%series(k))
            names(k) = own%name//' '//own%across
            ! paths say that one has a single value, or one of each pad
            plain = plain .and. index(own%name, '/') == 0 .and. (own%across == '' .or. own%across == 'pad')
            call self%part_of_samples(own%name, self%first(), int(self%samples - self%first()), values)
            if (own%across == '') then
               call results%put(path_of(self, k), values(1, :), own%units, own%long_name)
            else
               call results%put(path_of(self, k), values, own%units, own%long_name)
            end if
         end associate
      end do
      if (.not. plain) call results%put(series_names, names, 'series, and the scale of its values')
      call results%put(first_sample, self%values(:, 0), 'SI', 'the first sample')
      call results%put(sample_count, self%samples, 'samples so far')
   end subroutine save_samples

   !> Where a series is saved: a file has names in alphabetical order, and these keep that of the series.
   function path_of(self, k) result(path)
      class(growing_file_type), intent(in) :: self
      integer, intent(in) :: k
      character(len=:), allocatable :: path
      character(len=digits) :: number
      write (number, '(i0.2,a)') k, '_'
      path = group//'/'//number//replaced(self%series(k)%name, '/', '_')
   end function path_of

   !> Takes up what was saved; a failure where it does not fit together. Nothing where nothing was.
   subroutine restore(self, results)
      class(growing_file_type), intent(inout) :: self
      class(record_type), intent(in) :: results
      character(len=longest_names), allocatable :: names(:)
      integer, allocatable :: saved(:)
      integer :: k, i, kept, blank
      logical :: ok
      if (self%in_file) return
      if (.not. results%has(sample_count)) return
      saved = pack([(k, k=1, results%count)], [(results%datasets(k)%there .and. results%datasets(k)%group() == group, &
         & k=1, results%count)])
      allocate (names(size(saved)))
      do k = 1, size(saved)
         associate (own => results%datasets(saved(k)))
            names(k) = own%path(len(group) + 2 + digits:)//merge(' pad', '    ', size(own%extents) == 2)
         end associate
      end do
      do k = 1, results%count
         associate (own => results%datasets(k))
            if (own%there .and. own%path == series_names) names = lines(own%texts)
         end associate
      end do
      self%samples = nint(results%get_real(sample_count), i8)
      kept = int(self%samples - self%first())
      ok = kept > 0 .and. size(names) == size(saved)
      do k = 1, merge(size(saved), 0, ok)
         associate (own => results%datasets(saved(k)))
            blank = index(names(k), ' ')
            ok = ok .and. mod(size(own%values), kept) == 0
            call self%declare(names(k)(:blank - 1), size(own%values)/kept, own%units, own%long_name, &
               & trim(names(k)(blank + 1:)))
         end associate
      end do
      if (.not. ok .or. results%list_size(first_sample) /= sum(self%series%width)) then
         call self%check_read(-1, 'find all samples of the checkpoint')
         return
      end if
      allocate (self%values(sum(self%series%width), 0:self%room))
      call results%get_list(first_sample, self%values(:, 0))
      do k = 1, size(saved)
         associate (own => self%series(k), values => results%datasets(saved(k))%values)
            do i = 0, kept - 1
               self%values(own%before + 1:own%before + own%width, place(self, self%first() + i)) = &
                  & values(i*own%width + 1:(i + 1)*own%width)
            end do
         end associate
      end do
      self%declared = .true.
   end subroutine restore

   !> Writes the samples that were kept in memory.
   subroutine write_kept(self)
      class(growing_file_type), intent(inout) :: self
      real(wp), allocatable :: values(:, :)
      integer :: k, n
      n = int(self%samples - self%first())
      do k = 1, merge(size(self%series), 0, n > 0)
         associate (own => self%series(k))
            call create_series(self%hdf5_type, self%axis, own, int(n, i8))
            call self%part_of_samples(own%name, self%first(), n, values)
            call own%data%append(self%hdf5_type, values)
         end associate
      end do
   end subroutine write_kept

   !> Publishes what there is. With `continued` the writing continues; otherwise the file is closed and the lock freed.
   !> `behind`: the file that is written on has all samples, but of the rest what it had before the last publication.
   subroutine publish(self, continued, error, behind)
      class(growing_file_type), intent(inout) :: self
      logical, intent(in) :: continued
      type(error_type), allocatable, intent(out) :: error
      logical, intent(out) :: behind
      logical :: exchanged
      behind = .false.
      call write_held(self)
      call close_part(self)
      call self%error_of(self%working%path, error)
      if (.not. allocated(error)) call self%working%publish(exchanged, error)
      if (.not. allocated(error) .and. continued) call catch_up(self, exchanged, error, behind)
      if (allocated(error) .or. .not. continued) call self%abandon()
   end subroutine publish

   !> Makes the part what was just published: adds the last stretch to what was published before, or, where that
   !> cannot be written (a reader has it open), copies it all.
   subroutine catch_up(self, exchanged, error, behind)
      class(growing_file_type), intent(inout) :: self
      logical, intent(in) :: exchanged
      type(error_type), allocatable, intent(out) :: error
      logical, intent(inout) :: behind
      type(hdf5_type) :: published
      if (exchanged) then
         call open_part(self, error)
         if (allocated(error)) return
         call published%open(self%working%path, writing=.false.)
         call open_series(self)
         call copy_missing(self, published)
         call published%close()
         behind = .not. allocated(self%failure) .and. .not. allocated(published%failure)
         if (behind) return
         call close_part(self)
      end if
      call self%working%copy_published(error)
      if (.not. allocated(error)) call open_part(self, error)
      if (allocated(error)) return
      call open_series(self)
      call self%error_of(self%working%path, error)
   end subroutine catch_up

   !> Adds to a file, whose series are open, the samples that it lacks from another that has them all.
   subroutine copy_missing(self, whole)
      class(growing_file_type), intent(inout) :: self
      type(hdf5_type), intent(inout) :: whole
      type(hdf5_rows_type) :: source
      real(wp), allocatable :: values(:, :)
      integer(i8) :: missing
      integer :: k
      source%called = 'samples'
      do k = 1, merge(size(self%series), 0, self%in_file)
         associate (data => self%series(k)%data)
            call source%open(whole, self%series(k)%name)
            do
               missing = source%length - data%length
               if (missing <= 0 .or. allocated(self%failure) .or. allocated(whole%failure)) exit
               ! up to the end of a chunk
               missing = min(missing, chunk_samples - mod(data%length, int(chunk_samples, i8)))
               call source%read_behind(whole, data%length, int(missing), values)
               call data%append(self%hdf5_type, values)
            end do
            call source%close(whole)
         end associate
      end do
   end subroutine copy_missing

   subroutine open_series(self)
      class(growing_file_type), intent(inout) :: self
      integer :: k
      do k = 1, merge(size(self%series), 0, self%in_file)
         call self%series(k)%data%open(self%hdf5_type, self%series(k)%name)
      end do
   end subroutine open_series

   subroutine close_part(self)
      class(growing_file_type), intent(inout) :: self
      integer :: k
      do k = 1, size(self%series)
         call self%series(k)%data%close(self%hdf5_type)
      end do
      call self%close()
   end subroutine close_part

   subroutine abandon(self)
      class(growing_file_type), intent(inout) :: self
      call close_part(self)
      call self%working%release()
   end subroutine abandon
end module growing_file
