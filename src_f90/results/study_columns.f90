!> The columns of a study: datasets over its runs and over dimensions with labels. A column and a dimension come into
!> the file with the first run that has them, and a dimension grows where a run has other labels; what was written then
!> moves to where its labels are.
module study_columns
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use kinds, only: wp
   use hdf5_file, only: hdf5_type
   use hdf5_rows, only: hdf5_rows_type, rows_a_chunk
   use hdf5_scales, only: item_type, list_items, scales_of, read_about, scale_name, scale_count
   use study_dimensions, only: dimension_type, open_dimension, list_type, positions
   implicit none (type, external)
   private
   public :: study_columns_type, column_type, new_column_type, run_scale

   !> The scale of the runs.
   character(len=*), parameter :: run_scale = 'run'

   !> A column that a study is to have; `scales` are those after the run, separated by blanks.
   type :: new_column_type
      character(len=:), allocatable :: name, units, long_name, scales
   end type new_column_type

   type :: column_type
      character(len=:), allocatable :: name, units, long_name
      !> Its dimensions after the run, the slowest first.
      integer, allocatable :: over(:)
      !> How many values a row has before its own; its own.
      integer :: before = 0, width = 1
      type(hdf5_rows_type) :: data
   end type column_type

   type :: study_columns_type
      type(dimension_type), allocatable :: dimensions(:)
      type(column_type), allocatable :: columns(:)
      !> Runs; values of a run in all columns.
      integer :: runs = 0, width = 0
      !> Rises with every change of columns and dimensions.
      integer :: version = 0
      !> Names of the parameters, which all columns have as their coordinates.
      character(len=:), allocatable :: coordinates
   contains
      procedure :: begin
      procedure :: find
      !> A column of one value a run, with the value of the runs that were not written.
      procedure :: add_single
      procedure :: extend
      procedure :: extents
      procedure :: write => write_runs
      procedure :: resize
      procedure :: read_layout
      procedure :: open => open_columns
      procedure :: close => close_columns
   end type study_columns_type

contains

   !> A study without columns.
   subroutine begin(self, runs, coordinates)
      class(study_columns_type), intent(inout) :: self
      integer, intent(in) :: runs
      character(len=*), intent(in) :: coordinates
      self%runs = runs
      self%coordinates = coordinates
      self%width = 0
      self%version = self%version + 1
      if (allocated(self%columns)) deallocate (self%columns, self%dimensions)
      allocate (self%columns(0), self%dimensions(0))
   end subroutine begin

   !> Number of a column; 0 where there is none of the name.
   pure integer function find(self, name)
      class(study_columns_type), intent(in) :: self
      character(len=*), intent(in) :: name
      do find = size(self%columns), 1, -1
         if (self%columns(find)%name == name) return
      end do
   end function find

   pure integer function find_dimension(self, name) result(found)
      class(study_columns_type), intent(in) :: self
      character(len=*), intent(in) :: name
      do found = size(self%dimensions), 1, -1
         if (self%dimensions(found)%name == name) return
      end do
   end function find_dimension

   !> Sizes of dimensions, the slowest of which stands first; in the order of hdf5_rows.
   pure function extents(self, over)
      class(study_columns_type), intent(in) :: self
      integer, intent(in) :: over(:)
      integer :: extents(size(over)), i
      extents = [(self%dimensions(over(i))%length(), i=size(over), 1, -1)]
   end function extents

   subroutine add_single(self, file, name, long_name, fill, whole)
      class(study_columns_type), intent(inout) :: self
      class(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: name, long_name
      real(wp), intent(in) :: fill
      logical, intent(in) :: whole
      call add(self, file, new_column_type(name, '1', long_name, ''), fill, whole)
   end subroutine add_single

   subroutine add(self, file, new, fill, whole)
      class(study_columns_type), intent(inout) :: self
      class(hdf5_type), intent(inout) :: file
      type(new_column_type), intent(in) :: new
      real(wp), intent(in) :: fill
      logical, intent(in) :: whole
      type(column_type) :: column
      column%name = new%name
      column%units = new%units
      column%long_name = new%long_name
      column%over = over_of(self, new%scales)
      call column%data%create(file, new%name, self%extents(column%over), self%runs, fill, whole)
      call file%describe(column%data%id, new%units, new%long_name, trim(run_scale//' '//new%scales), new%name)
      if (self%coordinates /= '') call file%write_attribute(column%data%id, 'coordinates', self%coordinates)
      call append(self, column)
   end subroutine add

   !> One more column, behind the others in a row.
   subroutine append(self, column)
      class(study_columns_type), intent(inout) :: self
      type(column_type), intent(in) :: column
      type(column_type), allocatable :: more(:)
      allocate (more(size(self%columns) + 1))
      more(:size(self%columns)) = self%columns
      more(size(more)) = column
      call move_alloc(more, self%columns)
      call place(self)
   end subroutine append

   !> Where each column is in a row.
   subroutine place(self)
      class(study_columns_type), intent(inout) :: self
      integer :: i
      self%width = 0
      do i = 1, size(self%columns)
         associate (own => self%columns(i))
            own%before = self%width
            own%width = product(self%extents(own%over))
            self%width = self%width + own%width
         end associate
      end do
      self%version = self%version + 1
   end subroutine place

   !> The numbers of dimensions by their names, separated by blanks.
   function over_of(self, names) result(over)
      class(study_columns_type), intent(in) :: self
      character(len=*), intent(in) :: names
      integer, allocatable :: over(:)
      integer :: i
      over = [(find_dimension(self, scale_name(names, i)), i=1, scale_count(names))]
   end function over_of

   !> Makes room for the labels of those of the scales that are used, and for new columns over them. `written` tells
   !> which runs have values in the file; they move with their labels.
   subroutine extend(self, file, written, scales, used, new)
      class(study_columns_type), intent(inout) :: self
      class(hdf5_type), intent(inout) :: file
      logical, intent(in) :: written(:), used(:)
      type(dimension_type), intent(in) :: scales(:)
      type(new_column_type), intent(in) :: new(:)
      type(dimension_type), allocatable :: before(:)
      logical, allocatable :: grown(:)
      integer :: i, d
      before = self%dimensions
      allocate (grown(size(before)), source=.false.)
      do i = 1, size(scales)
         if (.not. used(i)) cycle
         d = find_dimension(self, scales(i)%name)
         if (d == 0) then
            call add_dimension(self, scales(i))
            call scales(i)%write(file)
         else if (d <= size(grown)) then
            if (.not. self%dimensions(d)%take_labels(scales(i))) cycle
            grown(d) = .true.
            call self%dimensions(d)%write(file)
         end if
      end do
      do i = 1, size(self%columns)
         associate (own => self%columns(i))
            if (any(grown(pack(own%over, own%over <= size(grown))))) call move(self, file, own, before, written)
         end associate
      end do
      do i = 1, size(new)
         if (self%find(new(i)%name) == 0) call add(self, file, new(i), ieee_value(1.0_wp, ieee_quiet_nan), .false.)
      end do
      call place(self)
   end subroutine extend

   subroutine add_dimension(self, new)
      class(study_columns_type), intent(inout) :: self
      type(dimension_type), intent(in) :: new
      type(dimension_type), allocatable :: more(:)
      allocate (more(size(self%dimensions) + 1))
      more(:size(self%dimensions)) = self%dimensions
      more(size(more)) = new
      call move_alloc(more, self%dimensions)
   end subroutine add_dimension

   !> Enlarges a column, and moves its values to the places of their labels.
   subroutine move(self, file, column, before, written)
      class(study_columns_type), intent(in) :: self
      class(hdf5_type), intent(inout) :: file
      type(column_type), intent(inout) :: column
      type(dimension_type), intent(in) :: before(:)
      logical, intent(in) :: written(:)
      type(hdf5_rows_type) :: old
      type(list_type) :: lists(size(column%over))
      real(wp), allocatable :: from(:, :), to(:, :)
      integer, allocatable :: at(:)
      integer :: i, first, last, block
      do i = 1, size(lists)
         lists(i)%at = self%dimensions(column%over(i))%places(before(column%over(i)))
      end do
      old = column%data
      call column%data%resize(file, self%extents(column%over), self%runs)
      at = positions(lists, self%extents(column%over))
      block = rows_a_chunk(self%runs, column%data%width())
      do first = 1, self%runs, block
         last = min(first + block - 1, self%runs)
         if (allocated(file%failure)) return
         if (.not. any(written(first:last))) cycle
         call old%read(file, first, last - first + 1, from)
         if (allocated(file%failure)) return
         allocate (to(column%data%width(), last - first + 1), source=ieee_value(1.0_wp, ieee_quiet_nan))
         to(at, :) = from
         call column%data%write(file, first, to)
         deallocate (to)
      end do
   end subroutine move

   !> Writes all columns of runs from the `first` on, values(width, runs).
   subroutine write_runs(self, file, first, values)
      class(study_columns_type), intent(in) :: self
      class(hdf5_type), intent(inout) :: file
      integer, intent(in) :: first
      real(wp), intent(in) :: values(:, :)
      integer :: i
      do i = 1, size(self%columns)
         associate (own => self%columns(i))
            call own%data%write(file, first, values(own%before + 1:own%before + own%width, :))
         end associate
      end do
   end subroutine write_runs

   !> Gives the columns more runs.
   subroutine resize(self, file, runs)
      class(study_columns_type), intent(inout) :: self
      class(hdf5_type), intent(inout) :: file
      integer, intent(in) :: runs
      integer :: i
      self%runs = runs
      do i = 1, size(self%columns)
         call self%columns(i)%data%resize(file, self%columns(i)%data%extents, runs)
      end do
   end subroutine resize

   !> Reads and opens the columns that are in a file, all but the parameters and texts.
   subroutine read_layout(self, file, coordinates)
      class(study_columns_type), intent(inout) :: self
      class(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: coordinates
      type(item_type), allocatable :: found(:)
      type(dimension_type) :: new
      type(column_type) :: column
      character(len=:), allocatable :: names
      integer :: i
      call self%begin(0, coordinates)
      call list_items(file, found)
      do i = 1, size(found)
         if (.not. found(i)%is_scale) cycle
         if (found(i)%path == run_scale) then
            if (found(i)%extents(1) > huge(1)) call file%check_read(-1, 'take memory for its runs')
            self%runs = int(min(real(found(i)%extents(1), wp), real(huge(1), wp)))
            cycle
         end if
         call open_dimension(file, found(i)%path, found(i)%of_texts, new)
         call add_dimension(self, new)
      end do
      do i = 1, size(found)
         if (.not. found(i)%is_dataset .or. found(i)%is_scale .or. found(i)%of_texts) cycle
         if (index(' '//coordinates//' ', ' '//found(i)%path//' ') > 0) cycle
         names = scales_of(file, found(i), found)
         if (allocated(file%failure)) return
         if (scale_name(names, 1) /= run_scale) cycle
         column%name = found(i)%path
         call read_about(file, column%name, column%units, column%long_name)
         column%over = over_of(self, names(len(run_scale) + 2:))
         column%data%id = -1
         call column%data%open(file, column%name)
         call append(self, column)
      end do
   end subroutine read_layout

   subroutine open_columns(self, file)
      class(study_columns_type), intent(inout) :: self
      class(hdf5_type), intent(inout) :: file
      integer :: i
      do i = 1, size(self%columns)
         call self%columns(i)%data%open(file, self%columns(i)%name)
      end do
   end subroutine open_columns

   subroutine close_columns(self, file)
      class(study_columns_type), intent(inout) :: self
      class(hdf5_type), intent(inout) :: file
      integer :: i
      if (.not. allocated(self%columns)) return
      do i = 1, size(self%columns)
         call self%columns(i)%data%close(file)
      end do
   end subroutine close_columns
end module study_columns
