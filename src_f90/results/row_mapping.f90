!> Where the numbers of a record stand in a row of a study. Records that come from one place are mostly alike, so that
!> this is found once for many of them.
module row_mapping
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use kinds, only: wp, i8
   use record, only: record_type, dataset_type
   use hdf5_scales, only: scale_name, scale_count
   use study_dimensions, only: dimension_type, dimension_of, list_type, positions
   use study_columns, only: study_columns_type, new_column_type
   use record_columns, only: record_column_type, columns_of
   implicit none (type, external)
   private
   public :: row_mapping_type

   !> The scale that every study has, of a machine in the group of each bearing.
   character(len=*), parameter :: pads = 'pad'

   !> Where the numbers of a dataset of a record stand in a row.
   type :: mapping_type
      type(record_column_type) :: own
      !> Whether they can have a place.
      logical :: possible = .false.
      !> Empty where the study has no place for them yet; the scales of the record along its dimensions.
      integer, allocatable :: at(:), over(:)
   end type mapping_type

   type :: row_mapping_type
      private
      !> The versions of the record and of the columns for which it holds.
      integer :: of_record = -1, of_columns = -1
      type(mapping_type), allocatable :: mappings(:)
      !> Scales of the record, which datasets they are, and their numbers one after another.
      type(dimension_type), allocatable :: scales(:)
      integer, allocatable :: datasets(:)
      real(wp), allocatable :: labels(:)
   contains
      procedure :: find
      procedure :: find_lacking
      procedure :: fill
   end type row_mapping_type

contains


   !> Finds the places of a record's numbers in a row of these columns, unless they are known. A name that is `taken`
   !> (separated by blanks) no column may have.
   subroutine find(self, record, columns, taken)
      class(row_mapping_type), intent(inout) :: self
      type(record_type), intent(in) :: record
      type(study_columns_type), intent(in) :: columns
      character(len=*), intent(in) :: taken
      type(record_column_type), allocatable :: found(:)
      integer :: i
      if (self%of_record == record%version .and. self%of_columns == columns%version) then
         ! bit for bit: a label that is not a number has not changed
         if (all(transfer(self%labels, [0_i8]) == transfer(labels_of(record, self%datasets), [0_i8]))) return
      end if
      self%of_record = record%version
      self%of_columns = columns%version
      self%datasets = pack([(i, i=1, record%count)], [(record%datasets(i)%scales == record%datasets(i)%path, &
         & i=1, record%count)])
      self%labels = labels_of(record, self%datasets)
      if (allocated(self%scales)) deallocate (self%scales, self%mappings)
      allocate (self%scales(size(self%datasets)))
      do i = 1, size(self%datasets)
         self%scales(i) = dimension_of(record%datasets(self%datasets(i)))
      end do
      found = columns_of(record, taken)
      allocate (self%mappings(size(found)))
      do i = 1, size(found)
         self%mappings(i)%own = found(i)
         call find_place(self%mappings(i), self%scales, columns)
      end do
   end subroutine find

   !> The numbers of scales, one after another.
   pure function labels_of(record, datasets) result(labels)
      type(record_type), intent(in) :: record
      integer, intent(in) :: datasets(:)
      real(wp), allocatable :: labels(:)
      integer :: i, n
      allocate (labels(sum([(size(record%datasets(datasets(i))%values), i=1, size(datasets))])))
      n = 0
      do i = 1, size(datasets)
         associate (own => record%datasets(datasets(i)))
            labels(n + 1:n + size(own%values)) = own%values
            n = n + size(own%values)
         end associate
      end do
   end function labels_of

   !> Finds the places of a dataset's numbers, if its column and all labels are there. It has none where the record
   !> lacks a scale of it, or the study has the column over other dimensions.
   subroutine find_place(mapping, scales, columns)
      type(mapping_type), intent(inout) :: mapping
      type(dimension_type), intent(in) :: scales(:)
      type(study_columns_type), intent(in) :: columns
      type(list_type), allocatable :: lists(:)
      integer :: c, d, i
      associate (own => mapping%own%column)
         mapping%over = [(place_of(scales, scale_name(own%scales, i)), i=1, scale_count(own%scales))]
         mapping%at = [integer ::]
         mapping%possible = all(mapping%over > 0)
         c = columns%find(own%name)
         if (c == 0 .or. .not. mapping%possible) return
         associate (column => columns%columns(c))
            mapping%possible = size(mapping%over) == size(column%over)
            if (.not. mapping%possible) return
            allocate (lists(size(mapping%over)))
            do i = 1, size(lists)
               d = column%over(i)
               if (columns%dimensions(d)%name /= scales(mapping%over(i))%name) mapping%possible = .false.
               lists(i)%at = columns%dimensions(d)%places(scales(mapping%over(i)))
            end do
            mapping%at = positions(lists, columns%extents(column%over))
            if (any(mapping%at == 0) .or. .not. mapping%possible) mapping%at = [integer ::]
            mapping%at = mapping%at + column%before
         end associate
      end associate
   end subroutine find_place

   pure integer function place_of(scales, name) result(at)
      type(dimension_type), intent(in) :: scales(:)
      character(len=*), intent(in) :: name
      do at = size(scales), 1, -1
         if (scales(at)%name == name) return
      end do
   end function place_of

   !> What the columns lack for a record of a run that was done, or was not: columns, new or with more labels, and
   !> which of the scales have these labels. None where all its numbers have places.
   subroutine find_lacking(self, record, done, new, scales, used)
      class(row_mapping_type), intent(in) :: self
      type(record_type), intent(in) :: record
      logical, intent(in) :: done
      type(new_column_type), allocatable, intent(out) :: new(:)
      type(dimension_type), allocatable, intent(out) :: scales(:)
      logical, allocatable, intent(out) :: used(:)
      logical :: wanted(size(self%mappings))
      integer :: i, n
      do i = 1, size(wanted)
         wanted(i) = lacks(self%mappings(i), record%datasets(self%mappings(i)%own%dataset), done)
      end do
      allocate (new(count(wanted)))
      if (size(new) == 0) return
      scales = self%scales
      allocate (used(size(scales)), source=.false.)
      n = 0
      do i = 1, size(wanted)
         if (.not. wanted(i)) cycle
         n = n + 1
         new(n) = self%mappings(i)%own%column
         used(self%mappings(i)%over) = .true.
      end do
      do i = 1, size(scales)
         associate (name => scales(i)%name)
            if (name(index(name, '/', back=.true.) + 1:) == pads) used(i) = .true.
         end associate
      end do
   end subroutine find_lacking

   !> Whether a dataset has numbers but no place.
   pure logical function lacks(mapping, dataset, done)
      type(mapping_type), intent(in) :: mapping
      type(dataset_type), intent(in) :: dataset
      logical, intent(in) :: done
      lacks = mapping%possible .and. size(mapping%at) == 0 .and. dataset%there &
         & .and. (done .or. .not. mapping%own%of_done)
      if (lacks) lacks = .not. all(ieee_is_nan(dataset%values))
   end function lacks

   !> Puts a record's numbers into a row.
   pure subroutine fill(self, record, done, row)
      class(row_mapping_type), intent(in) :: self
      type(record_type), intent(in) :: record
      logical, intent(in) :: done
      real(wp), intent(inout) :: row(:)
      integer :: i
      do i = 1, size(self%mappings)
         associate (own => self%mappings(i)%own, dataset => record%datasets(self%mappings(i)%own%dataset))
            if (size(self%mappings(i)%at) == 0 .or. .not. dataset%there .or. own%of_done .and. .not. done) cycle
            row(self%mappings(i)%at) = dataset%values
         end associate
      end do
   end subroutine fill
end module row_mapping
