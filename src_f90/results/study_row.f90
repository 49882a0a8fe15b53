!> The row of a run in a study: the results of its record that are columns, and what it says of itself. Records that
!> come one after another are mostly alike, so that what their rows have is found once for many of them.
module study_row
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use kinds, only: wp, i8
   use packet, only: packet_type
   use record, only: record_type, dataset_type, of_texts
   use hdf5_scales, only: scale_name, scale_count
   use study_layout, only: layout_type, dimension_type, column_type
   implicit none (type, external)
   private
   public :: study_row_type

   !> Groups whose datasets are columns, and what stands before their names there.
   character(len=*), parameter :: groups(*) = [character(len=13) :: 'summary', 'by_revolution', 'coefficients', &
      & 'modes', 'statistics', 'equilibrium', 'periodic', 'response', 'synchronous']
   character(len=*), parameter :: prefixes(*) = [character(len=12) :: '', '', '', '', '', 'equilibrium_', 'periodic_', &
      & 'response_', 'synchronous_']
   !> Groups that a run has which was not done, but for the figures of its equilibrium and its speed.
   character(len=*), parameter :: of_motion = ' summary by_revolution '
   character(len=*), parameter :: of_any(*) = [character(len=12) :: 'speed', 'time_reached', 'equilibrium_']
   !> The scale of the pads, and what the names of their columns begin with.
   character(len=*), parameter :: pads = 'pad', of_pads = 'pad_'
   !> Above the groups of a machine's bearings.
   character(len=*), parameter :: bearings = 'bearings/'
   !> Where a record has its remarks.
   character(len=*), parameter :: remarks_path = 'summary/remarks'

   type :: study_row_type
      !> Its layout as bytes (study_layout).
      character(len=:), allocatable :: description
      !> Its numbers, column after column, and its remarks, a line each.
      real(wp), allocatable :: numbers(:)
      character(len=:), allocatable :: remarks
      !> The version of the record for which this holds; its scales, with their numbers; its datasets that are columns,
      !> and which of them only a run that was done has.
      integer, private :: version = -1
      integer, allocatable, private :: scales(:), datasets(:)
      real(wp), allocatable, private :: labels(:)
      logical, allocatable, private :: of_done(:)
      !> Names that no column may have, separated by blanks; whether the description has been sent.
      character(len=:), allocatable, private :: taken
      logical, private :: sent = .false.
   contains
      !> The row of a run without results. Columns whose names are `taken` (separated by blanks) get their group before.
      procedure :: begin
      procedure :: make
      procedure :: exchange
   end type study_row_type

contains

   subroutine begin(self, taken)
      class(study_row_type), intent(inout) :: self
      character(len=*), intent(in) :: taken
      type(record_type) :: nothing
      self%taken = taken
      allocate (nothing%datasets(0))
      call self%make(nothing, .false.)
   end subroutine begin

   !> Becomes the row of a run, done or not, from its record.
   subroutine make(self, record, done)
      class(study_row_type), intent(inout) :: self
      type(record_type), intent(in) :: record
      logical, intent(in) :: done
      logical :: known
      integer :: i, n
      known = self%version == record%version
      ! bit for bit: a label that is not a number has not changed
      if (known) known = all(transfer(self%labels, [0_i8]) == transfer(labels_of(record, self%scales), [0_i8]))
      if (.not. known) call describe(self, record)
      self%numbers(1) = merge(1.0_wp, 0.0_wp, done)
      n = 1
      do i = 1, size(self%datasets)
         associate (own => record%datasets(self%datasets(i)))
            if (own%there .and. (done .or. .not. self%of_done(i))) then
               self%numbers(n + 1:n + size(own%values)) = own%values
            else
               self%numbers(n + 1:n + size(own%values)) = ieee_value(1.0_wp, ieee_quiet_nan)
            end if
            n = n + size(own%values)
         end associate
      end do
      self%remarks = ''
      do i = 1, record%count
         associate (own => record%datasets(i))
            if (own%path == remarks_path .and. own%there) self%remarks = own%texts(:len(own%texts) - 1)
         end associate
      end do
   end subroutine make

   !> The numbers of scales, one after another; not a number of one that the run has not.
   pure function labels_of(record, datasets) result(labels)
      type(record_type), intent(in) :: record
      integer, intent(in) :: datasets(:)
      real(wp), allocatable :: labels(:)
      integer :: i, n
      allocate (labels(sum([(size(record%datasets(datasets(i))%values), i=1, size(datasets))])), &
         & source=ieee_value(1.0_wp, ieee_quiet_nan))
      n = 0
      do i = 1, size(datasets)
         associate (own => record%datasets(datasets(i)))
            if (own%there) labels(n + 1:n + size(own%values)) = own%values
            n = n + size(own%values)
         end associate
      end do
   end function labels_of

   !> Into a packet for another process, or out of it. The description is only there where it has changed since.
   subroutine exchange(self, packed)
      class(study_row_type), intent(inout) :: self
      type(packet_type), intent(inout) :: packed
      character(len=:), allocatable :: description
      description = ''
      if (.not. (packed%reading .or. self%sent)) description = self%description
      call packed%text(description)
      if (packed%reading .and. description /= '') self%description = description
      self%sent = .true.
      call packed%text(self%remarks)
      call packed%reals(self%numbers)
   end subroutine exchange

   !> Finds what the rows of such records have.
   subroutine describe(self, record)
      type(study_row_type), intent(inout) :: self
      type(record_type), intent(in) :: record
      type(layout_type) :: layout
      type(packet_type) :: packed
      integer :: i
      self%version = record%version
      self%scales = pack([(i, i=1, record%count)], [(record%datasets(i)%scales == record%datasets(i)%path, &
         & i=1, record%count)])
      self%labels = labels_of(record, self%scales)
      allocate (layout%dimensions(size(self%scales)))
      do i = 1, size(self%scales)
         layout%dimensions(i) = dimension_of(record%datasets(self%scales(i)), labels_of(record, self%scales(i:i)))
      end do
      self%datasets = pack([(i, i=1, record%count)], [(is_column(record%datasets(i), layout), i=1, record%count)])
      allocate (layout%columns(1 + size(self%datasets)))
      layout%columns(1) = column_type('complete', '1', '1 where the run reached its end')
      allocate (layout%columns(1)%over(0))
      do i = 1, size(self%datasets)
         associate (own => record%datasets(self%datasets(i)), column => layout%columns(1 + i))
            column%name = column_name(own, self%taken)
            column%units = own%units
            column%long_name = own%long_name
            column%over = dimensions_of(own, layout)
         end associate
      end do
      self%of_done = [(is_of_done(record%datasets(self%datasets(i))), i=1, size(self%datasets))]
      call layout%place()
      if (allocated(self%numbers)) deallocate (self%numbers)
      allocate (self%numbers(layout%width))
      call layout%exchange(packed)
      self%description = packed%bytes()
      self%sent = .false.
   end subroutine describe

   !> The dimension that a scale of a record is.
   function dimension_of(scale, labels) result(found)
      type(dataset_type), intent(in) :: scale
      real(wp), intent(in) :: labels(:)
      type(dimension_type) :: found
      integer :: i, first, length
      found%name = scale%path
      found%units = scale%units
      found%long_name = scale%long_name
      found%has_texts = scale%kind == of_texts
      found%numbers = labels
      allocate (found%texts(merge(product(scale%extents), 0, found%has_texts)))
      first = 1
      do i = 1, size(found%texts)
         length = index(scale%texts(first:), achar(10)) - 1
         found%texts(i)%text = scale%texts(first:first + length - 1)
         first = first + length + 1
      end do
   end function dimension_of

   !> Whether a dataset is a column; each of its dimensions has a scale.
   pure logical function is_column(dataset, layout)
      type(dataset_type), intent(in) :: dataset
      type(layout_type), intent(in) :: layout
      is_column = group_of(dataset) > 0 .and. dataset%kind /= of_texts &
         & .and. size(dataset%extents) == scale_count(dataset%scales)
      if (is_column) is_column = all(dimensions_of(dataset, layout) > 0)
   end function is_column

   !> The numbers of its dimensions; 0 for one that has no scale.
   pure function dimensions_of(dataset, layout) result(over)
      type(dataset_type), intent(in) :: dataset
      type(layout_type), intent(in) :: layout
      integer :: over(scale_count(dataset%scales)), k
      over = [(layout%find_dimension(scale_name(dataset%scales, k)), k=1, size(over))]
   end function dimensions_of

   !> The name of its column. Those of a bearing of a machine are in its group and have the names of those of one
   !> bearing there.
   pure function column_name(dataset, taken) result(name)
      type(dataset_type), intent(in) :: dataset
      character(len=*), intent(in) :: taken
      character(len=:), allocatable :: name, own, bearing
      integer :: g
      g = group_of(dataset)
      bearing = bearing_of(dataset)
      own = dataset%path(index(dataset%path, '/', back=.true.) + 1:)
      name = trim(prefixes(g))//own
      if (dataset%scales == bearing//pads .and. index(own, of_pads) /= 1) name = of_pads//name
      name = bearing//name
      if (index(' '//taken//' ', ' '//name//' ') > 0) name = trim(groups(g))//'_'//name
   end function column_name

   !> Whether only a run that was done has a dataset.
   pure logical function is_of_done(dataset)
      type(dataset_type), intent(in) :: dataset
      character(len=:), allocatable :: own
      integer :: i
      own = dataset%path(index(dataset%path, '/', back=.true.) + 1:)
      is_of_done = index(of_motion, ' '//trim(groups(group_of(dataset)))//' ') > 0 &
         & .and. .not. any([(index(own, trim(of_any(i))) == 1, i=1, size(of_any))])
   end function is_of_done

   !> Which of the groups a dataset is in, of the whole run or of a bearing; 0 for another.
   pure integer function group_of(dataset) result(g)
      type(dataset_type), intent(in) :: dataset
      character(len=:), allocatable :: group
      group = dataset%group()
      group = group(min(len(bearing_of(dataset)), len(group)) + 1:)
      do g = size(groups), 1, -1
         if (groups(g) == group) return
      end do
   end function group_of

   !> The group of the bearing of a machine that a dataset is in, with a slash at its end; empty for others.
   pure function bearing_of(dataset) result(bearing)
      type(dataset_type), intent(in) :: dataset
      character(len=:), allocatable :: bearing
      integer :: slash
      bearing = ''
      if (index(dataset%path, bearings) /= 1) return
      slash = index(dataset%path(len(bearings) + 1:), '/')
      bearing = dataset%path(:len(bearings) + slash)
   end function bearing_of
end module study_row
