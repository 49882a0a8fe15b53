!> The rows of a study: the results of its runs, which come as records in any order, and are held back until there are
!> many of them.
module study_rows
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use kinds, only: wp
   use errors, only: system_error
   use text, only: printable
   use record, only: record_type
   use hdf5_file, only: hdf5_type
   use hdf5_texts, only: hdf5_texts_type, text_type
   use study_dimensions, only: dimension_type
   use study_columns, only: study_columns_type, new_column_type, run_scale
   use row_mapping, only: row_mapping_type
   implicit none (type, external)
   private
   public :: study_rows_type, not_run, stays

   !> The status of a run that has no row.
   integer, parameter :: not_run = -2
   character(len=*), parameter :: status_name = 'status', reason_name = 'reason', file_name = 'file'
   !> Remarks of a run, and where a record has them.
   character(len=*), parameter :: remarks_name = 'remarks', remarks_path = 'summary/remarks'
   character(len=*), parameter :: status_meaning = 'exit status: 0 done, 2 numerics, 3 system, 4 stopped, ' &
      & //'-1 not ended, -2 not run yet; nan: its file cannot be read'
   !> Columns that every study has, one value a run.
   character(len=*), parameter :: complete_name = 'complete'
   !> Most rows held back, and most numbers of them.
   integer, parameter :: most_held = 512, most_numbers = 1000000

   type :: study_rows_type
      type(study_columns_type) :: table
      !> Reasons of failures, remarks on the runs, and the results' own files; the last two are no column where no run
      !> has any.
      type(hdf5_texts_type) :: reasons, remarks, files
      !> Exit status of each run; `not_run` where it has no row.
      integer, allocatable :: status(:)
      !> Names that no column may have, separated by blanks.
      character(len=:), allocatable :: taken
      type(row_mapping_type), allocatable, private :: sources(:)
      !> Rows held back, their runs, reasons and remarks, and whether the run had a row before; how many there are.
      real(wp), allocatable, private :: held(:, :)
      integer, allocatable, private :: numbers(:)
      type(text_type), allocatable, private :: texts(:), remarked(:)
      logical, allocatable, private :: again(:)
      integer, private :: count = 0
      !> Places of status and `complete` in a row.
      integer, private :: singles(2) = 0
   contains
      procedure :: begin
      procedure :: read_layout
      procedure :: add
      procedure :: put_remarks
      procedure :: put_files
      procedure :: flush => write_held
      procedure :: open => open_rows
      procedure :: close => close_rows
      procedure :: resize
   end type study_rows_type

contains

   !> A study of this number of runs, none of which has a row. Its file has the scale of the runs and the parameters,
   !> whose names are `coordinates`.
   subroutine begin(self, file, runs, coordinates)
      class(study_rows_type), intent(inout) :: self
      class(hdf5_type), intent(inout) :: file
      integer, intent(in) :: runs
      character(len=*), intent(in) :: coordinates
      real(wp) :: nan
      nan = ieee_value(nan, ieee_quiet_nan)
      call self%table%begin(runs, coordinates)
      call self%table%add_single(file, status_name, status_meaning, &
         & real(not_run, wp), .true.)
      call self%table%add_single(file, complete_name, '1 where the run reached its end', nan, .false.)
      call create_texts(self, file, reason_name, 'reason of the failure', self%reasons)
      if (allocated(self%status)) deallocate (self%status)
      allocate (self%status(runs), source=not_run)
      call forget(self)
   end subroutine begin

   !> A column of texts.
   subroutine create_texts(self, file, name, long_name, texts)
      class(study_rows_type), intent(in) :: self
      class(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: name, long_name
      type(hdf5_texts_type), intent(out) :: texts
      call texts%create(file, name, self%table%runs)
      if (allocated(file%failure)) return
      call file%describe(texts%id, '', long_name, run_scale, name)
      if (self%table%coordinates /= '') call file%write_attribute(texts%id, 'coordinates', self%table%coordinates)
   end subroutine create_texts

   !> No row is held back, and no source known.
   subroutine forget(self)
      type(study_rows_type), intent(inout) :: self
      self%count = 0
      self%taken = run_scale//' '//reason_name//' '//remarks_name//' '//file_name//' runs '//self%table%coordinates
      if (allocated(self%sources)) deallocate (self%sources)
      if (allocated(self%held)) deallocate (self%held, self%numbers, self%texts, self%remarked, self%again)
      allocate (self%sources(0))
   end subroutine forget

   !> Reads which rows and columns a file has, and opens them. One that lacks what every study has is damaged.
   subroutine read_layout(self, file, coordinates)
      class(study_rows_type), intent(inout) :: self
      class(hdf5_type), intent(inout) :: file
      character(len=*), intent(in) :: coordinates
      real(wp), allocatable :: values(:, :)
      call self%table%read_layout(file, coordinates)
      call open_texts(self, file)
      call forget(self)
      if (allocated(file%failure)) return
      if (self%table%find(status_name)*self%table%find(complete_name) == 0) call file%check_read(-1, &
         & 'find the columns of a study')
      if (allocated(file%failure)) return
      call self%table%columns(self%table%find(status_name))%data%read(file, 1, self%table%runs, values)
      self%status = nint(values(1, :))
   end subroutine read_layout

   !> The row of run k: its exit status, the reason where it failed, and its results. Records of one `source`, a number
   !> from 1, have the same datasets one time after another.
   subroutine add(self, file, k, status, reason, record, source)
      class(study_rows_type), intent(inout) :: self
      class(hdf5_type), intent(inout) :: file
      integer, intent(in) :: k, status, source
      character(len=*), intent(in) :: reason
      type(record_type), intent(in) :: record
      call make_room(self, file, record, source, status == 0)
      if (allocated(file%failure)) return
      if (.not. allocated(self%held)) call allocate_held(self)
      if (self%count == size(self%numbers) .or. any(self%numbers(:self%count) == k)) call self%flush(file)
      self%count = self%count + 1
      self%numbers(self%count) = k
      self%texts(self%count)%text = trim(printable(reason))
      self%remarked(self%count)%text = remarks_in(record)
      self%again(self%count) = self%status(k) /= not_run
      self%status(k) = status
      associate (row => self%held(:, self%count))
         row = ieee_value(1.0_wp, ieee_quiet_nan)
         call self%sources(source)%fill(record, status == 0, row)
         row(self%singles) = [real(status, wp), merge(1.0_wp, 0.0_wp, status == 0)]
      end associate
   end subroutine add

   !> The remarks in a record, a line each.
   function remarks_in(record) result(lines)
      type(record_type), intent(in) :: record
      character(len=:), allocatable :: lines
      integer :: i
      lines = ''
      do i = 1, record%count
         associate (own => record%datasets(i))
            if (own%path == remarks_path .and. own%there) lines = own%texts(:len(own%texts) - 1)
         end associate
      end do
   end function remarks_in

   !> The remarks on runs, from run k on; they become a column with the first.
   subroutine put_remarks(self, file, k, remarks)
      class(study_rows_type), intent(inout) :: self
      class(hdf5_type), intent(inout) :: file
      integer, intent(in) :: k
      type(text_type), intent(in) :: remarks(:)
      if (self%remarks%id < 0) call create_texts(self, file, remarks_name, &
         & 'what is unusual in the run, or leaves the range of the model, a line each', self%remarks)
      call self%remarks%write(file, k, remarks)
   end subroutine put_remarks

   !> The names of runs' own files, from run k on.
   subroutine put_files(self, file, k, names)
      class(study_rows_type), intent(inout) :: self
      class(hdf5_type), intent(inout) :: file
      integer, intent(in) :: k
      type(text_type), intent(in) :: names(:)
      if (self%files%id < 0) call create_texts(self, file, file_name, &
         & 'result file, relative to the folder of this file', self%files)
      call self%files%write(file, k, names)
   end subroutine put_files

   !> Room for rows of all columns that there are.
   subroutine allocate_held(self)
      type(study_rows_type), intent(inout) :: self
      integer :: rows
      rows = max(1, min(most_held, most_numbers/self%table%width))
      allocate (self%held(self%table%width, rows), self%numbers(rows), self%texts(rows), self%remarked(rows), &
         & self%again(rows))
      associate (columns => self%table%columns)
         self%singles = [columns(self%table%find(status_name))%before, &
            & columns(self%table%find(complete_name))%before] + 1
      end associate
   end subroutine allocate_held

   !> Finds where a record's numbers stand in a row, and gives the study the columns and labels that it lacks.
   subroutine make_room(self, file, record, source, done)
      class(study_rows_type), intent(inout) :: self
      class(hdf5_type), intent(inout) :: file
      type(record_type), intent(in) :: record
      integer, intent(in) :: source
      logical, intent(in) :: done
      type(row_mapping_type), allocatable :: more(:)
      type(new_column_type), allocatable :: new(:)
      type(dimension_type), allocatable :: scales(:)
      logical, allocatable :: used(:)
      if (source > size(self%sources)) then
         allocate (more(source))
         more(:size(self%sources)) = self%sources
         call move_alloc(more, self%sources)
      end if
      associate (own => self%sources(source))
         call own%find(record, self%table, self%taken)
         call own%find_lacking(record, done, new, scales, used)
         if (size(new) == 0) return
         call self%flush(file)
         call self%table%extend(file, self%status /= not_run, scales, used, new)
         if (allocated(self%held)) deallocate (self%held, self%numbers, self%texts, self%remarked, self%again)
         call own%find(record, self%table, self%taken)
      end associate
   end subroutine make_room

   !> Writes the rows that are held back, runs that follow each other together.
   subroutine write_held(self, file)
      class(study_rows_type), intent(inout) :: self
      class(hdf5_type), intent(inout) :: file
      integer, allocatable :: order(:)
      integer :: first, last
      order = rising(self%numbers, self%count)
      first = 1
      do while (first <= self%count)
         last = first
         do while (last < self%count)
            if (self%numbers(order(last + 1)) /= self%numbers(order(last)) + 1) exit
            last = last + 1
         end do
         call self%table%write(file, self%numbers(order(first)), self%held(:, order(first:last)))
         first = last + 1
      end do
      do last = 1, self%count
         if (self%texts(last)%text /= '' .or. self%again(last)) call self%reasons%write(file, self%numbers(last), &
            & self%texts(last:last))
         if (self%remarked(last)%text /= '' .or. self%again(last) .and. self%remarks%id >= 0) then
            call self%put_remarks(file, self%numbers(last), self%remarked(last:last))
         end if
      end do
      self%count = 0
   end subroutine write_held

   !> The order in which the first n numbers rise; they nearly do.
   pure function rising(numbers, n) result(order)
      integer, allocatable, intent(in) :: numbers(:)
      integer, intent(in) :: n
      integer :: order(n), i, k
      do i = 1, n
         k = i
         do while (k > 1)
            if (numbers(order(k - 1)) < numbers(i)) exit
            order(k) = order(k - 1)
            k = k - 1
         end do
         order(k) = i
      end do
   end function rising

   !> Gives the study more runs.
   subroutine resize(self, file, runs)
      class(study_rows_type), intent(inout) :: self
      class(hdf5_type), intent(inout) :: file
      integer, intent(in) :: runs
      integer, allocatable :: more(:)
      call self%table%resize(file, runs)
      call self%reasons%resize(file, runs)
      if (self%remarks%id >= 0) call self%remarks%resize(file, runs)
      if (self%files%id >= 0) call self%files%resize(file, runs)
      allocate (more(runs), source=not_run)
      more(:size(self%status)) = self%status
      call move_alloc(more, self%status)
   end subroutine resize

   !> Opens the columns again after the file was closed.
   subroutine open_rows(self, file)
      class(study_rows_type), intent(inout) :: self
      class(hdf5_type), intent(inout) :: file
      call self%table%open(file)
      call open_texts(self, file)
   end subroutine open_rows

   subroutine open_texts(self, file)
      class(study_rows_type), intent(inout) :: self
      class(hdf5_type), intent(inout) :: file
      call self%reasons%open(file, reason_name)
      if (file%has(remarks_name)) call self%remarks%open(file, remarks_name)
      if (file%has(file_name)) call self%files%open(file, file_name)
   end subroutine open_texts

   subroutine close_rows(self, file)
      class(study_rows_type), intent(inout) :: self
      class(hdf5_type), intent(inout) :: file
      call self%table%close(file)
      call self%reasons%close(file)
      call self%remarks%close(file)
      call self%files%close(file)
   end subroutine close_rows

   !> Whether the row of a run that ended so is to stay. The row of one that the system failed is to be written again.
   elemental logical function stays(status)
      integer, intent(in) :: status
      stays = status /= not_run .and. status /= system_error
   end function stays
end module study_rows
